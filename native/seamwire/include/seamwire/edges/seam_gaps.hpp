// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "seamwire/api.hpp"
#include "seamwire/edges/edge_adjacency.hpp"
#include "seamwire/surface/surface.hpp"
#include "seamwire/task.hpp"

namespace seamwire {

/// Join edges to chains. A chain ends where other than two edges meet, at a vertex of `ends`, and where it is closed.
///
/// \param edges pairs of different vertices in either order; repeated ones count once
/// \param ends vertices where chains end as well
/// \returns the vertices of each chain; a closed chain ends with its first vertex. Open chains come first.
/// \throws InvalidInput if a vertex is negative, or an edge joins a vertex to itself
SEAMWIRE_API std::vector<std::vector<std::int32_t>> edge_chains(std::span<const Edge> edges,
                                                                std::span<const std::int32_t> ends = {});

/// Where a cut ends just before it meets another cut or the boundary, so that two islands stay joined.
struct SeamGap {
  std::vector<std::int32_t> path;  ///< vertices along edges, from the end of the cut to what it nearly meets
  double length = 0.0;             ///< of the path, in the caller's unit
};

/// What counts as a gap.
struct SeamGapOptions {
  double longest = 0.5;  ///< the longest gap, in lengths of the cut that ends there, up to where it meets other cuts
  double longest_of_several = std::numeric_limits<double>::infinity();  ///< the same for gaps of more than one edge
  std::size_t most_looked_at = 50'000;  ///< how many vertices around an end are looked at
  std::span<const std::int32_t> meant;  ///< vertices where cuts end on purpose
  std::span<const Edge> partly_hidden;  ///< edges where the mesh goes on, though no triangle here does
};

/// Find the gaps of seams.
///
/// A gap leads from the end of a cut to the nearest vertex of a cut or of the boundary. If cuts and the boundary lead
/// there within four times that distance, there is no gap. Two ends that face each other have one gap.
///
/// \param surface the surface
/// \param adjacency its adjacency
/// \param seams the cut edges. Pairs that are not real edges are ignored.
/// \param options what counts as a gap
/// \returns the gaps, shortest first
/// \throws InvalidInput if a vertex is out of range, or the adjacency is of another surface
SEAMWIRE_API std::vector<SeamGap> find_gaps(const Surface& surface, const EdgeAdjacency& adjacency,
                                            std::span<const Edge> seams, const SeamGapOptions& options = {},
                                            const Task& = {});

}  // namespace seamwire
