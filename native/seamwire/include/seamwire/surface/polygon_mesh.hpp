// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "seamwire/api.hpp"
#include "seamwire/surface/surface.hpp"
#include "seamwire/surface/types.hpp"
#include "seamwire/surface/vector.hpp"
#include "seamwire/task.hpp"

namespace seamwire {

/// Points and polygons, as a mesh file has them.
struct PolygonMesh {
  std::vector<Vector> points;         ///< coordinates
  std::vector<std::int32_t> corners;  ///< vertex numbers, polygon by polygon
  std::vector<std::int32_t> sizes;    ///< the number of corners of each polygon, at least 3
  std::vector<Vector> colors;         ///< red, green and blue of each vertex, in [0, 1]; empty without colors
};

/// Check that the arrays of a mesh fit together.
///
/// \param mesh the mesh
/// \throws InvalidInput if a vertex is out of range, a size is less than 3, or the sizes do not add up to the number of
///   corners
/// \throws InvalidInput if there are colors for another number of points
SEAMWIRE_API void check(const PolygonMesh& mesh);

/// List the edges of polygons.
///
/// \param mesh the mesh
/// \returns each edge once, the smaller vertex first, in ascending order. An edge from a vertex to itself is left out.
/// \throws InvalidInput if check() rejects the mesh
SEAMWIRE_API std::vector<Edge> polygon_edges(const PolygonMesh& mesh);

/// Build the surface of a polygon mesh.
///
/// Its edges are those of the polygons, without the diagonals of triangulate().
///
/// \param mesh the mesh
/// \returns the surface, whose vertices have the mesh's numbers
/// \throws InvalidInput if triangulate() or Surface rejects the mesh
SEAMWIRE_API Surface make_surface(const PolygonMesh& mesh, const Task& = {});

}  // namespace seamwire
