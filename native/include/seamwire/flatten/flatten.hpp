// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "seamwire/api.hpp"
#include "seamwire/flatten/measure_map.hpp"
#include "seamwire/surface/surface.hpp"
#include "seamwire/task.hpp"

namespace seamwire {

/// How flatten() maps islands.
struct FlattenOptions {
  /// A former map: UVs of the caller's corners. An island starts from it if none of its triangles is flipped there, and
  /// if it is continuous across the island's inner edges, except where the island has to be opened. If that map is not
  /// finished after `max_steps`, or still overlaps although `keep_apart` is set, the island is solved from Tutte's
  /// embedding as well, and the better map is kept. Other islands start from Tutte's embedding.
  CornerUvs start = {};
  /// Whether islands whose outline crosses itself are solved again with a barrier that keeps the outline apart.
  bool keep_apart = true;
  std::size_t max_steps = 100;  ///< Newton steps for each island at most
  double tolerance = 1e-6;      ///< the predicted decrease of the mean energy below which an island is finished
  /// Islands that are rectangles of quads are laid out straight along the axes if that adds at most this to their mean
  /// energy. Rows and columns get the sizes with the least energy. nullopt: islands stay as they are flattened.
  std::optional<double> straighten = std::nullopt;
  /// A direction of the model, not zero. Each island is turned such that the mean of its projection to the surface
  /// points to +v. An island without a clear up lies with its longer side along v. Straight islands stay along the
  /// axes. nullopt: islands are not turned.
  std::optional<Vector> up = std::nullopt;
};

/// One island of a Flattening.
struct FlatIsland {
  double area = 0.0;         ///< on the surface, in the caller's unit squared
  double energy = 0.0;       ///< symmetric Dirichlet energy E_d at scale 1, mean over the area; 4 for an isometry
  std::size_t steps = 0;     ///< Newton steps that the map took
  bool overlaps = false;     ///< whether it covers a part of the plane twice
  bool is_straight = false;  ///< whether it is a rectangle of quads that was laid out straight
  std::size_t opened = 0;    ///< edges along which the map was opened in addition to the cuts
  std::int32_t worst = -1;   ///< the caller's triangle with the highest energy; -1 if the island has no proper triangle
};

/// A UV map of a surface.
struct Flattening {
  CornerUvs uvs;                      ///< in the caller's unit of length; each island lies around the origin
  std::vector<std::int32_t> islands;  ///< the island of each of the caller's triangles
  std::vector<FlatIsland> by_island;  ///< by island number
  double energy = 0.0;                ///< as MapReport::energy
};

/// Maps each island of a surface to the plane: without flips, with as little stretch as possible, and without overlaps
/// where possible. The symmetric Dirichlet energy (Smith and Schaefer 2015) is minimized from Tutte's embedding
/// (1963) by projected Newton steps. Islands are solved on several threads; the result does not depend on the number of
/// threads.
///
/// `cuts`: vertex pairs of either order; pairs that are not real edges of the surface cut nothing. Islands are the
/// segments of face_segments().
///
/// An island without a boundary or with handles is opened along short additional paths of real edges, which FlatIsland
/// counts. So is an island whose map would be lost in rounding, such as a long tube. So each
/// corner of a polygon has one UV. A triangle that the surface left out (degenerate or duplicate) gets the UVs that its
/// vertices have in its island. A vertex that is not in the island gets the island's center.
///
/// Throws InvalidInput for a vertex out of range, and for a start of the wrong size or with numbers that are not
/// finite. Throws it, too, for an up direction that is zero or not finite, and for an island that no opening makes
/// possible to map. Throws Cancelled within about 20 ms at 100,000 triangles, and within 50 ms at the beginning.
SEAMWIRE_API Flattening flatten(const Surface& surface, std::span<const Edge> cuts, const FlattenOptions& options = {},
                                const Task& task = {});

}  // namespace seamwire
