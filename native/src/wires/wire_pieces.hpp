// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <vector>

#include "seamwire/surface/surface.hpp"
#include "seamwire/surface/surface_point.hpp"
#include "seamwire/wires/wire.hpp"

namespace seamwire::detail {

/// A part of a wire, to the place where the next one begins.
struct WirePiece {
  Wire wire;         ///< from and to vertices: at a place between vertices, the corner of its face that is nearest
  SurfacePoint end;  ///< of the last piece not looked at
};

/// A wire cut into `count` pieces of about the same length, which begin and end within faces. There are fewer pieces if
/// the wire runs along edges without a face, or has no length. Its ends must be vertices.
std::vector<WirePiece> cut_in_pieces(const Surface& surface, const Wire& wire, std::size_t count);

}  // namespace seamwire::detail
