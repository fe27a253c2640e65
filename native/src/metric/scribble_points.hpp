// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "seamwire/metric/scribble.hpp"
#include "seamwire/surface/surface.hpp"
#include "surface/exact_unit.hpp"

namespace seamwire::detail {

/// Throws InvalidInput where a scribble is not one on the surface, see apply_scribbles(). `number`: names it.
void check_scribble(const Surface& surface, const Scribble& scribble, std::size_t number);

/// The vertex at which a point of a scribble lies, or the nearest corner of its face.
inline std::int32_t nearest_vertex(const Surface& surface, const Scribble& scribble, std::size_t i) {
  if (!scribble.vertices.empty() && scribble.vertices[i] >= 0) return scribble.vertices[i];
  return *std::ranges::min_element(surface.triangles()[scribble.faces[i]], {}, [&](std::int32_t v) {
    return (exact_unit(surface) * (surface.points()[v] - scribble.points[i])).squaredNorm();
  });
}

}  // namespace seamwire::detail
