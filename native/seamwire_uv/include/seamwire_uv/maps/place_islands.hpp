// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstdint>
#include <vector>

#include "seamwire/surface/types.hpp"
#include "seamwire/task.hpp"
#include "seamwire_uv/api.hpp"

namespace seamwire {

/// Islands that were unwrapped, in a map where other islands stay.
struct NewIslands {
  /// Per corner: its UV in the old map. An island with a UV that is not finite had no place.
  std::vector<Eigen::Vector2d> before;
  /// Per corner: its place now, finite, of any scale, as the image shows it: u is multiplied by the aspect.
  std::vector<Eigen::Vector2d> after;
  std::vector<Triangle> triangles;          ///< corners
  std::vector<std::int32_t> islands;        ///< the island of each triangle, from 0
  std::vector<double> areas;                ///< per island: the wanted area in the map; 0 keeps the scale
  std::vector<double> aspects = {};         ///< per island: as in PackOptions
  std::vector<std::uint8_t> straight = {};  ///< per island: whether its sides stay along the axes; empty: none does
};

/// Find a place for new islands among parts of a map that stay.
///
/// Each island is turned as it was, as its image shows it. A straight island is turned along the axes, as near to its
/// former rotation as possible. It gets the nearest free place of its former unit square, or a place to the right of
/// everything if that square is full. Places are sought in a raster of 512 x 512 cells.
///
/// \param islands the new islands
/// \param taken boxes around what stays
/// \returns per island, the map P to its place: a point (x, y) of `after` lies at P * (x, y, 1). Zero for an island
///   without triangles.
/// \throws InvalidInput if an array has the wrong size, or a value is out of range or not finite
SEAMWIRE_UV_API std::vector<Eigen::Matrix<double, 2, 3>> place_islands(const NewIslands& islands,
                                                                       const std::vector<Eigen::AlignedBox2d>& taken,
                                                                       const Task& = {});

}  // namespace seamwire
