// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "seamwire/surface/surface.hpp"
#include "seamwire/task.hpp"
#include "seamwire_uv/api.hpp"
#include "seamwire_uv/maps/measure_map.hpp"

namespace seamwire {

/// How flatten() maps islands.
struct FlattenOptions {
  /// A former map: finite UVs of the caller's corners, of any scale. Empty: every island starts from Tutte's embedding.
  ///
  /// An island starts from the former map if none of its triangles is flipped there, and if the map is continuous
  /// across its inner edges. Edges where the island has to be opened need not be continuous. Other islands start from
  /// Tutte's embedding. So do islands whose former map has a mean energy above 1e12.
  ///
  /// The island is solved from Tutte's embedding as well if `max_steps` are not enough, or if it overlaps although
  /// `keep_apart` is set. Then the map that does not overlap is kept. If both or neither overlap, the one with the
  /// lower energy is kept. The former map is enough for an island that cannot be solved from Tutte's embedding.
  CornerUvs start = {};
  /// Whether to solve islands whose outline crosses itself again, with a barrier that keeps the outline apart.
  bool keep_apart = true;
  /// Largest number of Newton steps of one solve. An island may be solved several times: with the barrier, from Tutte's
  /// embedding after the former map, and after each further opening.
  std::size_t max_steps = 100;
  /// The predicted decrease of the mean energy below which an island is finished, 0 or more.
  double tolerance = 1e-6;
  /// The largest increase of the mean energy that is accepted to lay out a rectangle of quads straight along the axes:
  /// finite, 0 or more. Rows and columns get the sizes with the least energy. nullopt: islands stay as they are
  /// flattened.
  std::optional<double> straighten = std::nullopt;
  /// A direction of the model, finite, not zero. Each island is turned such that the mean projection of this direction
  /// to the surface points to +v. An island without a clear up lies with its longer side along v. Straight islands stay
  /// along the axes. nullopt: islands are not turned.
  std::optional<Vector> up = std::nullopt;
};

/// One island of a Flattening.
struct FlatIsland {
  double area = 0.0;  ///< on the surface, in the caller's unit squared
  /// Symmetric Dirichlet energy E_d at scale 1, mean over the area. 4 for an isometry. A triangle lower than 1e-4 of
  /// its longest side counts as one with this height.
  double energy = 0.0;
  std::size_t steps = 0;  ///< Newton steps that the map took, with and without the barrier
  /// Whether it covers a part of the plane twice. Crossings of the outline by less than 5e-7 of the square root of
  /// `area` may not count.
  bool overlaps = false;
  bool is_straight = false;  ///< whether it is a rectangle of quads that was laid out straight
  std::size_t opened = 0;    ///< edges along which the map was opened, in addition to the cuts
  /// The caller's triangle with the highest energy, -1 if the island has no proper triangle.
  std::int32_t worst = -1;
};

/// A UV map of a surface.
struct Flattening {
  CornerUvs uvs;                      ///< in the caller's unit of length; islands may lie on each other
  std::vector<std::int32_t> islands;  ///< the island of each of the caller's triangles
  std::vector<FlatIsland> by_island;  ///< per island
  double energy = 0.0;                ///< as in MapReport::energy
};

/// Map each island of a surface to the plane, without flips and with little stretch.
///
/// In rare cases, an island overlaps itself in spite of FlattenOptions::keep_apart. FlatIsland::overlaps reports this.
///
/// Islands are the segments of face_segments(). Projected Newton steps lead from Tutte's embedding to a local minimum
/// of the symmetric Dirichlet energy. Islands are solved on several threads. The result does not depend on the number
/// of threads.
///
/// An island without a boundary or with handles is opened along short additional paths of real edges, which
/// FlatIsland::opened counts. So is an island whose map would be lost in rounding, such as a long tube. Because only
/// real edges are opened, each corner of a polygon has one UV.
///
/// A triangle that the surface left out (degenerate or duplicate) gets the UVs that its vertices have in its island. A
/// vertex that is not in the island gets the island's center.
///
/// Cancelling takes effect within about 20 ms at 100,000 triangles, and within 50 ms at the beginning.
///
/// \param surface the surface
/// \param cuts vertex pairs in either order. Pairs that are not real edges of the surface cut nothing.
/// \param options how islands are mapped
/// \returns the map
/// \throws InvalidInput if a vertex is out of range, or the start has the wrong size or is not finite
/// \throws InvalidInput if the up direction is zero or not finite, or `tolerance` or `straighten` is out of range
/// \throws InvalidInput if no opening makes it possible to map an island
/// \see Smith and Schaefer 2015, for the energy
/// \see Tutte 1963, for the embedding
SEAMWIRE_UV_API Flattening flatten(const Surface& surface, std::span<const Edge> cuts,
                                   const FlattenOptions& options = {}, const Task& = {});

}  // namespace seamwire
