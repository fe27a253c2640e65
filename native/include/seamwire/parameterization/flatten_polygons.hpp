// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <vector>

#include "seamwire/api.hpp"
#include "seamwire/parameterization/unwrap_mesh.hpp"
#include "seamwire/task.hpp"

namespace seamwire {

/// Some islands of polygons, mapped to the plane.
struct FlatPolygons {
  std::vector<std::int32_t> corners;  ///< the corners that have a place, ascending
  std::vector<Eigen::Vector2d> uvs;   ///< per such corner: its place, in the points' unit of length
  /// Per such corner: its island in Flattening. An island of the mesh has several of them if it is connected only where
  /// it is no surface.
  std::vector<std::int32_t> islands;
  std::vector<std::uint8_t> straight;  ///< per island of the mesh: whether all of it was laid out straight
};

/// Map islands of polygons to the plane.
///
/// \param mesh the polygons
/// \param is_chosen per island: whether it is mapped
/// \param start per corner: its place in a former map, of any scale. Empty, or if a place is not finite: no former map.
/// \param straighten as FlattenOptions::straighten
/// \param up as FlattenOptions::up
/// \param task progress and cancellation
/// \returns the map
/// \throws InvalidInput if an array has the wrong size, or flatten() throws it
/// \throws Cancelled if the task is cancelled
SEAMWIRE_API FlatPolygons flatten_polygons(const UnwrapMesh& mesh, const std::vector<std::uint8_t>& is_chosen,
                                           const std::vector<Eigen::Vector2d>& start = {},
                                           std::optional<double> straighten = std::nullopt,
                                           std::optional<Vector> up = std::nullopt, const Task& task = {});

}  // namespace seamwire
