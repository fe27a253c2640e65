// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "seamwire/api.hpp"
#include "seamwire/edges/edge_adjacency.hpp"
#include "seamwire/surface/surface.hpp"

namespace seamwire {

/// A line drawn on a surface.
struct DrawnLine {
  std::span<const Vector> points;       ///< in the caller's coordinates, in drawing order
  std::span<const std::int32_t> faces;  ///< the triangle that each lies in, the caller's numbers
};

/// The chain of real edges that fits a line.
struct FittedChain {
  std::vector<std::int32_t> vertices;  ///< in the line's order, two at least; empty: no edge fits
  /// Where on the line each vertex is: i + x is the part x of the way from point i to the next.
  std::vector<double> places;
};

/// Finds the chain of real edges that fits a line best. It leads from the vertex nearest to the line's first point to
/// the vertex nearest to its last point. Parts of the line beyond half an edge do not count. Of all chains that go
/// along the line from its beginning to its end it has the least sum of
///   l (1 + 32 d^2 / h^2) + h / 4 (1 - cos kappa).
///
/// In it, l is an edge's length, and d^2 the mean square distance of its ends and its middle to the line. The turn onto
/// the edge is kappa (EdgeAdjacency). Of the edges at the faces that the line crosses, h is the median length. A step
/// along an edge may go back by h + l / 2 on the line and ahead by 2 h + 3 l / 2. Only that part of the line counts for
/// the step. So lines may cross themselves and come back beside themselves. Where a line turns back over itself, so
/// does the chain, and edges that it passes both ways are dropped. A line that ends where it began gives a closed
/// chain, its first vertex given again at the end.
///
/// `begin`, `end`: vertices where it begins and ends instead, which should be near the line's. Where no edges lead all
/// along the line (a gap between components, a hole) the chain ends where they end. A line shorter than half an edge
/// fits none, and one within a face fits its border, or nothing.
///
/// Takes time in proportion to the line, not to the surface. Throws InvalidInput where points and faces differ in
/// number, the adjacency is of another surface, a coordinate is not finite, or a face or a vertex is not part of the
/// surface.
SEAMWIRE_API FittedChain fit_chain(const Surface& surface, const EdgeAdjacency& adjacency, const DrawnLine& line,
                                   std::optional<std::int32_t> begin = std::nullopt,
                                   std::optional<std::int32_t> end = std::nullopt);

}  // namespace seamwire
