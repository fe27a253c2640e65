// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "seamwire/api.hpp"
#include "seamwire/parameterization/measure_map.hpp"
#include "seamwire/parameterization/unwrap_mesh.hpp"
#include "seamwire/task.hpp"

namespace seamwire {

/// All that lies in a UV map.
struct MappedTriangles {
  std::vector<Vector> points;
  std::vector<Triangle> triangles;
  std::vector<std::int32_t> polygons;  ///< per triangle
  std::vector<std::int32_t> islands;   ///< per triangle: its island, from 0
  CornerUvs uvs;                       ///< a triangle with a UV that is not finite has no place
  std::vector<Edge> edges;             ///< the edges of the polygons
};

/// Which islands map_faults() looks at.
struct FaultOptions {
  /// Per island: whether its faults count. The others are what these may overlap. Empty: all.
  std::vector<std::uint8_t> chosen = {};
  /// Per island: the low corner of the unit square where it may lie, besides the UV square. Empty: (0, 0).
  std::vector<Eigen::Vector2d> homes = {};
  bool may_stack = false;  ///< whether islands may lie exactly on each other
};

/// What is wrong with islands in a UV map.
struct MapFaults {
  std::size_t flipped = 0;      ///< polygons that are turned over against their island, or have no area or no place
  std::size_t overlapping = 0;  ///< islands that cover a part of themselves or of another island
  std::size_t outside = 0;      ///< islands that lie neither in the UV square nor in their home
};

/// Count what is wrong with islands in a UV map.
///
/// A triangle whose corners lie in one place on the model is never flipped. Triangles that repeat others count, too.
///
/// \param map all that lies in the map
/// \param options which islands count
/// \param task progress and cancellation
/// \returns the faults
/// \throws InvalidInput if arrays do not fit together, or a number is out of range
/// \throws Cancelled if the task is cancelled
SEAMWIRE_API MapFaults map_faults(const MappedTriangles& map, const FaultOptions& options = {}, const Task& task = {});

/// Build the surface of triangles, of which those that repeat others have separate vertices.
///
/// A Surface would leave them out.
///
/// \param points as for a Surface
/// \param triangles as for a Surface
/// \param edges as for a Surface
/// \param task progress and cancellation
/// \returns the surface
/// \throws InvalidInput if the arguments are no surface
/// \throws Cancelled if the task is cancelled
SEAMWIRE_API Surface surface_with_repeats(std::vector<Vector> points, std::vector<Triangle> triangles,
                                          std::optional<std::vector<Edge>> edges, const Task& task = {});

/// Turn back triangles that rounding to single precision has turned over.
///
/// Corners of an island with one vertex and the same UV move together, by a few spacings of numbers, if that turns
/// over no other triangle.
///
/// \param mesh the polygons
/// \param uvs per corner: its UV, of single precision
/// \param is_chosen per island: whether its triangles are looked at
/// \returns the corners that move, ascending, and their new UVs
/// \throws InvalidInput if an array has the wrong size
SEAMWIRE_API std::vector<std::pair<std::int32_t, Eigen::Vector2f>> turned_back(
    const UnwrapMesh& mesh, const std::vector<Eigen::Vector2d>& uvs, const std::vector<std::uint8_t>& is_chosen);

/// Find the visible triangles that a map must have the right way around.
///
/// \param mesh the polygons
/// \param uvs per corner: its UV
/// \returns their numbers, ascending: all but those that lie on a straight line both in the map and on the model
/// \throws InvalidInput if an array has the wrong size
SEAMWIRE_API std::vector<std::int32_t> proper_triangles(const UnwrapMesh& mesh,
                                                        const std::vector<Eigen::Vector2d>& uvs);

}  // namespace seamwire
