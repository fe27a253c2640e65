// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "maps/cut_open.hpp"
#include "numeric/block_cholesky.hpp"
#include "seamwire/surface/vector.hpp"
#include "seamwire/task.hpp"

namespace seamwire::detail {

/// The edges of an island between different own vertices, each once.
std::vector<Edge> island_edges(const Island& island);

/// The two ends of a long and thin island.
struct LongEnds {
  std::size_t first = 0, last = 0;  ///< places in its outer boundary loop
  double length = 0.0;              ///< of the way between them
};

/// The ends of an island: vertices of its outer loop, far from each other along edges. nullopt if the way between them
/// is so short that a circle is a good start. `outer`: the loop. `area`: of the island.
std::optional<LongEnds> long_ends(const Island& island, std::span<const Vector> points,
                                  std::span<const std::int32_t> outer, double area);

/// The convex outline that an island is put on: a circle, or for a long island a rectangle with curved sides.
struct TutteOutline {
  std::size_t outer = 0;  ///< the boundary loop that becomes the outline
  double area = 1.0;
  std::optional<LongEnds> ends = std::nullopt;  ///< in the unit of the map
};

/// Tutte's embedding (1963, "How to draw a graph"). A boundary loop lies on a convex outline around the origin, with
/// its vertices spaced as its edges are long. Every other vertex is at the weighted mean of its neighbors. Other loops
/// are filled with a virtual vertex each. Weights are cotangents (Pinkall and Polthier 1993) clamped to [.1, 10]. If
/// rounding spoils the result, all weights are equal instead. Returns two numbers for each own vertex. Returns nothing
/// if a triangle is not counter-clockwise, because double precision cannot hold the embedding.
///
/// `points`: of own vertices. `boundaries`: Island::boundaries(). `solver`: of the graph of island_edges(); its values
/// are overwritten. Throws Cancelled.
std::vector<double> tutte_embedding(const Island& island, std::span<const Vector> points,
                                    const std::vector<std::vector<std::int32_t>>& boundaries,
                                    const TutteOutline& outline, BlockCholesky& solver, const Task& task);

}  // namespace seamwire::detail
