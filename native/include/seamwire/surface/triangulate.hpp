// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "seamwire/api.hpp"
#include "seamwire/errors.hpp"
#include "seamwire/surface/types.hpp"
#include "seamwire/surface/vector.hpp"

namespace seamwire {

/// Polygons as triangles.
struct Triangulation {
  std::vector<Triangle> triangles;     ///< in the order of the polygons, turned the same way
  std::vector<std::int32_t> polygons;  ///< the polygon of each triangle
};

/// Triangulates triangles and quads as Blender does. A quad is cut from its first corner to its third. It is cut from
/// the second to the fourth if one of the two triangles would lie on the other, or would have no area. `corners`:
/// vertices, polygon by polygon; `sizes`: how many each polygon has, 3 or 4. Throws InvalidInput for other sizes, where
/// they do not add up to the number of corners, and for a vertex out of range.
SEAMWIRE_API Triangulation triangulate(std::span<const Vector> points, std::span<const std::int32_t> corners,
                                       std::span<const std::int32_t> sizes);

}  // namespace seamwire
