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
  std::vector<Triangle> triangles;     ///< in the order and orientation of the polygons
  std::vector<std::int32_t> polygons;  ///< the polygon of each triangle
};

/// Triangulate polygons.
///
/// Quads are cut as in Blender, from the first corner to the third. If one of the two triangles would then lie on the
/// other, or have no area, they are cut from the second corner to the fourth. Larger polygons may have dents. They are
/// cut by removing ears.
///
/// \param points coordinates
/// \param corners vertex numbers in [0, points.size()), polygon by polygon
/// \param sizes the number of corners of each polygon, at least 3
/// \returns the triangles, and the polygon of each
/// \throws InvalidInput if a size is less than 3, or the sizes do not add up to the number of corners
/// \throws InvalidInput if a vertex is out of range
SEAMWIRE_API Triangulation triangulate(std::span<const Vector> points, std::span<const std::int32_t> corners,
                                       std::span<const std::int32_t> sizes);

}  // namespace seamwire
