// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "seamwire/task.hpp"
#include "seamwire_uv/api.hpp"

namespace seamwire {

/// How pack_islands() may turn islands.
enum class PackTurns {
  kNone,  ///< not at all
  /// By multiples of 90 degrees. An island is turned only if it has no place without a turn in the packing that was
  /// found. Of more than 64 turned islands, this holds for the largest 64.
  kQuarters,
  /// In several directions, for islands with at least 1/40 of the area. Other islands, and islands that nearly fill the
  /// smallest rectangle around them, lie along the axes.
  kAny
};

/// How pack_islands() fills the unit square.
struct PackOptions {
  /// The least distance between islands, in parts of the square's side: 0 to 0.25. The sides of the square keep half of
  /// it. It is at most 0.15 over the square root of the number of islands.
  double margin = 1.0 / 256.0;
  PackTurns turns = PackTurns::kQuarters;
  /// Per island, the width over the height of the image on which it lies: 0.001 to 1000. Empty: all images
  /// are square.
  std::vector<double> aspects = {};
};

/// Places of islands in the unit square.
struct Packing {
  /// Per island, the map P to the square: a point (x, y) of the island lies at P * (x, y, 1). Zero for an island
  /// without triangles.
  std::vector<Eigen::Matrix<double, 2, 3>> placements;
  /// The factor from lengths of the islands to heights in the square, the same for all islands.
  double scale = 0.0;
  /// The covered share of the square. An island's area is the sum of its triangles' areas.
  double used = 0.0;
};

/// Pack islands into the unit square, at one scale that is as large as possible.
///
/// Islands do not overlap, and they may lie in notches and holes of others. The scale is found by search: each attempt
/// places the islands one by one, large ones first, in a raster of about 510 x 510 cells. The work is bounded, so the
/// scale is not the largest possible one. The result does not depend on the number of threads.
///
/// \param uvs the corners of triangles in the plane, in one unit of length for all islands, at most 1e100
/// \param islands the island of each triangle, from 0, below the number of triangles
/// \param options margin and turns
/// \returns the places
/// \throws InvalidInput if an array has the wrong size, or a value is out of range or not finite
SEAMWIRE_UV_API Packing pack_islands(std::span<const std::array<Eigen::Vector2d, 3>> uvs,
                                     std::span<const std::int32_t> islands, const PackOptions& options = {},
                                     const Task& = {});

}  // namespace seamwire
