// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "seamwire/api.hpp"
#include "seamwire/surface/surface.hpp"
#include "seamwire/task.hpp"

namespace seamwire {

/// The UVs of each triangle's corners, in the order of its vertices.
using CornerUvs = std::vector<std::array<Eigen::Vector2d, 3>>;

/// Measures of a UV map of a surface.
struct MapReport {
  /// The symmetric Dirichlet energy E_d: its mean over the area of the surface after the whole map has been scaled
  /// uniformly such that this is lowest. The worst triangles, .1 % of the area, and flipped ones are left out. 4 for an
  /// isometry; infinite if no triangle remains.
  double energy = 0.0;
  std::vector<double> energies;           ///< E_d of each triangle at that scale; infinite for flipped ones
  std::vector<std::int32_t> flipped;      ///< triangles turned over or without an area in the map, against their island
  std::vector<std::int32_t> overlapping;  ///< islands that cover a part of the plane twice, or flip a triangle
  std::vector<std::int32_t> colliding;    ///< islands that cover a part of another island, and those other islands
};

/// Measures any UV map of a surface. `uvs`: for each of the caller's triangles. `islands`: the island of each triangle,
/// numbered from 0. If that is empty, triangles are in one island if they agree on the UVs of an edge that they share.
/// An island may be mirrored as a whole. Triangles that the surface left out are not measured; their energy is 0.
///
/// Islands and parts of islands may touch. Outlines that cross by less than 1e-6 of an island's size only touch.
/// Between islands, the limit is 1e-6 of the largest coordinate. All lists ascend.
///
/// Throws InvalidInput for arrays of the wrong size, UVs that are not finite or above 1e152 in size, and island numbers
/// that are negative or not below the number of triangles; Cancelled.
SEAMWIRE_API MapReport measure_map(const Surface& surface, std::span<const std::array<Eigen::Vector2d, 3>> uvs,
                                   std::span<const std::int32_t> islands = {}, const Task& task = {});

/// Returns MapReport::energy alone. This takes a part of the time.
SEAMWIRE_API double map_energy(const Surface& surface, std::span<const std::array<Eigen::Vector2d, 3>> uvs,
                               std::span<const std::int32_t> islands = {}, const Task& task = {});

}  // namespace seamwire
