// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "seamwire/api.hpp"
#include "seamwire/edges/edge_adjacency.hpp"
#include "seamwire/surface/surface.hpp"
#include "seamwire/task.hpp"

namespace seamwire {

/// A line drawn on a surface. The arrays belong to the caller.
struct DrawnLine {
  std::span<const Vector> points;       ///< finite, in the caller's coordinates, in drawing order
  std::span<const std::int32_t> faces;  ///< the caller's triangle of each point
};

/// The chain of real edges that fits a line.
struct FittedChain {
  std::vector<std::int32_t> vertices;  ///< two or more, in the line's order; empty if no edge fits
  /// Where each vertex is on the line: i + x is the fraction x of the way from point i to the next point.
  std::vector<double> places;
};

/// Find the chain of real edges that fits a line best.
///
/// The chain goes along the line, from the vertex nearest to its first point to the vertex nearest to its last point.
/// Of all such chains, it has the least sum over its edges of
///
///     l (1 + 32 d^2 / h^2) + h / 4 (1 - cos kappa)
///
/// - l is the length of the edge.
/// - d^2 is the mean square distance of its ends and its middle to the line.
/// - kappa is the turn onto the edge (EdgeAdjacency).
/// - h is the median length of the edges at the faces that the line crosses.
///
/// Ends of the line that reach less than half an edge beyond the chain do not count. A step along an edge may go back
/// by h + l / 2 on the line, and ahead by 2 h + 3 l / 2. Only that part of the line counts for the step. So a line may
/// cross itself, and return beside itself. If a line turns back over itself, so does the chain, and edges that it
/// passes both ways are dropped.
///
/// If the line ends where it began, the chain is closed, and repeats its first vertex at the end. If no edges lead all
/// along the line, as at a gap between components or a hole, the chain ends there. A line shorter than half an edge
/// fits no edge. A line inside one face fits the border of the face, or nothing.
///
/// The time is proportional to the length of the line, times the squared number of edges at a vertex near the line. It
/// does not depend on the size of the surface.
///
/// \param surface the surface
/// \param adjacency its adjacency
/// \param line the line
/// \param begin a vertex where the chain begins instead, near the line's first point
/// \param end a vertex where the chain ends instead, near the line's last point
/// \returns the chain, without vertices if no edge fits
/// \throws InvalidInput if points and faces differ in number, or a coordinate is not finite
/// \throws InvalidInput if the adjacency is of another surface, or a face or a vertex is out of range
SEAMWIRE_API FittedChain fit_chain(const Surface& surface, const EdgeAdjacency& adjacency, const DrawnLine& line,
                                   std::optional<std::int32_t> begin = std::nullopt,
                                   std::optional<std::int32_t> end = std::nullopt, const Task& = {});

}  // namespace seamwire
