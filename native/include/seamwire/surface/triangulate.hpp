// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "seamwire/surface/surface.hpp"

namespace seamwire {

struct CutPolygons {
  std::vector<Triangle> triangles;     ///< in the order of the polygons, turned the same way
  std::vector<std::int32_t> polygons;  ///< the polygon of each triangle
};

/// Triangles and quads cut into triangles as Blender cuts them: a quad from its first corner to its third, unless one
/// of the two triangles would lie on the other, else from the second to the fourth. `corners`: vertices, polygon by
/// polygon; `sizes`: how many each polygon has, 3 or 4. Throws InvalidInput for other sizes, where they do not add up
/// to the number of corners, and for a vertex out of range.
CutPolygons cut_polygons(std::span<const Vector> points, std::span<const std::int32_t> corners,
                         std::span<const std::int32_t> sizes);

}  // namespace seamwire
