// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <span>
#include <vector>

#include "detail/infinity.hpp"
#include "maps/cut_open.hpp"
#include "seamwire/errors.hpp"
#include "seamwire/surface/vector.hpp"
#include "seamwire/task.hpp"

namespace seamwire::detail {

/// A point of a UV map.
using Point2 = Eigen::Vector2d;

/// When to stop, and whether the outline may cross itself.
struct MapOptions {
  std::size_t max_steps = 60;  ///< Newton steps at most, and as many again with a barrier
  /// Stop after a step whose predicted decrease of the energy (half the Newton decrement) is below this.
  double tolerance = 1e-4;
  /// Whether to solve again with a barrier along the outline if the map overlaps itself.
  bool keep_apart = true;
  /// Stop once the energy is certain to stay above this: the quadratic model's minimum, with a reserve, is above it.
  double worse_than = kInfinity;
};

/// A map with this mean energy shrinks triangles by more than a million. Programs store UVs in single precision, which
/// leaves no area of them. Maps that people can use have less than 1e7.
inline constexpr double kLostEnergy = 1e12;

/// A map of an island to the plane in which no triangle is flipped.
struct IslandMap {
  std::vector<Point2> uvs;  ///< one for each own vertex; empty if double precision cannot hold Tutte's embedding
  double energy = 0.0;  ///< symmetric Dirichlet energy E_d, mean over the area, 4 for an isometry; infinite without uvs
  bool overlaps = false;  ///< whether the outline crosses itself, so that the map overlaps itself
  std::size_t steps = 0;  ///< Newton steps taken
  /// Whether the last solve ended before MapOptions::max_steps.
  bool is_finished = false;
};

/// Maps an island to the plane. A flat island starts from its own shape, and others from Tutte's embedding (1963) on a
/// circle. Then it minimizes the symmetric Dirichlet energy (Smith and Schaefer 2015) by projected Newton steps (Smith,
/// de Goes and Kim 2019). While triangles are strongly distorted, their rest shapes are moved towards the map (Liu et
/// al. 2018).
///
/// `points`: of the mesh vertices, of any unit; the map has the same unit. Triangles lower than 1e-4 of their longest
/// side are treated as if they were that high. Throws InvalidInput if the island is neither a disc nor a disc with
/// holes, or if its only boundary loops have two edges, because then no map without flips exists; Cancelled.
IslandMap map_island(const Island& island, std::span<const Vector> points, const MapOptions& options, const Task& task);

/// Continues from a map without flips: one for each own vertex. After a cut has become longer, both sides of the new
/// part start at the same place. If the outline of the start crosses itself, the result may overlap as well. Throws
/// InvalidInput for a start with a flipped triangle or of another size; Cancelled.
IslandMap continue_map(const Island& island, std::span<const Vector> points, std::span<const Point2> uvs,
                       const MapOptions& options, const Task& task);

/// The mean energy of a map, as in IslandMap.
double mean_energy(const Island& island, std::span<const Vector> points, std::span<const Point2> uvs);

/// The symmetric Dirichlet energy of each triangle, at the scale that is given; infinite where it is flipped or has no
/// area in the map. Low triangles are treated as in map_island().
std::vector<double> triangle_energies(const Island& island, std::span<const Vector> points,
                                      std::span<const Point2> uvs);

}  // namespace seamwire::detail
