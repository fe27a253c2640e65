// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "seamwire/surface/surface.hpp"
#include "seamwire/task.hpp"
#include "seamwire_uv/api.hpp"

namespace seamwire {

/// The UVs of each triangle's corners, in the order of its vertices.
using CornerUvs = std::vector<std::array<Eigen::Vector2d, 3>>;

/// Measures of a UV map of a surface.
struct MapReport {
  /// The symmetric Dirichlet energy E_d, mean over the area of the surface. The whole map is first scaled uniformly
  /// such that this is lowest. Flipped triangles are left out, and then the 0.1 % of the area where the energy is
  /// highest. Of the triangle at that limit, the rest counts. 4 for an isometry; infinite if no triangle remains.
  double energy = 0.0;
  /// E_d of each triangle at that scale, infinite for flipped triangles. 0 for triangles that the surface left out. For
  /// a triangle that is lower than 1e-4 of its longest side, E_d is that of a triangle with this height.
  std::vector<double> energies;
  /// Triangles that the map turns over, compared with their island, or that have no area in it; ascending.
  std::vector<std::int32_t> flipped;
  /// Islands that cover a part of the plane twice, or flip a triangle; ascending.
  std::vector<std::int32_t> overlapping;
  /// Islands that cover a part of another island, and those other islands; ascending.
  std::vector<std::int32_t> colliding;
};

/// Measure any UV map of a surface.
///
/// Islands and parts of islands may touch. Outlines that cross by less than 1e-6 of the map's size, or of its largest
/// coordinate, only touch, because UVs are rounded to single precision. An island may be mirrored as a whole. Triangles
/// that the surface left out are not measured.
///
/// The time is n log n for most maps with n triangles. Two kinds of maps take longer:
///
/// - Parts of islands that lie in each other's holes are compared in pairs.
/// - Edges of outlines that touch each other are compared in pairs, as those of islands with a common corner.
///
/// \param surface the surface
/// \param uvs UVs of each of the caller's triangles, finite. Sides shorter than 1e-150 of the largest coordinate may
///   count as having no length.
/// \param islands the island of each triangle, from 0. Empty: triangles are in one island if they agree on the UVs of a
///   shared edge.
/// \returns the measures
/// \throws InvalidInput if an array has the wrong size, a UV is not finite, or an island number is not below the
///   number of triangles
SEAMWIRE_UV_API MapReport measure_map(const Surface& surface, std::span<const std::array<Eigen::Vector2d, 3>> uvs,
                                      std::span<const std::int32_t> islands = {}, const Task& = {});

/// Compute MapReport::energy alone, in less time.
///
/// \param surface the surface
/// \param uvs as in measure_map()
/// \param islands as in measure_map()
/// \returns the energy: 4 for an isometry, infinite if no triangle remains
/// \throws InvalidInput if measure_map() rejects an argument
SEAMWIRE_UV_API double map_energy(const Surface& surface, std::span<const std::array<Eigen::Vector2d, 3>> uvs,
                                  std::span<const std::int32_t> islands = {}, const Task& = {});

}  // namespace seamwire
