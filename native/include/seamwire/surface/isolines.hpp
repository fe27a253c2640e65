// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "seamwire/api.hpp"
#include "seamwire/surface/surface.hpp"

namespace seamwire {

/// Where a function on a surface has given values: straight segments, each across one triangle. Together they are
/// closed curves, or end on the boundary and at triangles that are left out.
struct Isolines {
  std::vector<std::array<Vector, 2>> segments;  ///< both ends, in the caller's coordinates
  std::vector<std::int32_t> faces;              ///< the caller's triangle that each lies in
  std::vector<std::int32_t> levels;             ///< which of the levels each is at
};

/// The isolines of a function that is linear on each triangle. `values`: one for each of the caller's vertices;
/// infinite ones leave out the triangles around. `levels`: finite, ascending. A vertex exactly at a level counts as
/// above it. The higher values lie to the left of a segment, as seen from where its triangle is counterclockwise.
///
/// Throws InvalidInput where the values are of another number of vertices or one is no number, and where levels are not
/// finite and ascending.
SEAMWIRE_API Isolines isolines(const Surface& surface, std::span<const double> values, std::span<const double> levels);

}  // namespace seamwire
