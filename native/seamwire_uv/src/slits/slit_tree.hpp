// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "detail/csr.hpp"
#include "maps/cut_open.hpp"
#include "seamwire/surface/vector.hpp"
#include "seamwire/task.hpp"
#include "slits/slit_plan.hpp"

namespace seamwire::detail {

/// The vertices and edges of an island, for distances along edges within it. Throws Cancelled.
struct IslandGraph {
  struct Neighbor {
    std::int32_t vertex = -1;
    double length = 0.0;
  };
  IslandGraph(const Island& island, std::span<const Vector> points, const Task& task);

  /// Distances along edges from a vertex.
  std::vector<double> distances_from(std::int32_t vertex, const Task& task) const;
  /// The mean geodesic distance of each vertex to the surface (Hilaga et al. 2001), from samples that are spread over
  /// the area. On several threads.
  std::vector<double> mean_distances(const Task& task) const;
  /// The local maxima of a function that stand out from their surroundings by `prominence` or more, highest first.
  std::vector<std::int32_t> peaks(std::span<const double> heights, double prominence) const;

  Csr<Neighbor> neighbors;
  std::vector<double> areas;  ///< a third of that of the triangles around each vertex
};

/// One piece of a problem before slits cut it. Throws Cancelled.
struct PieceBody {
  PieceBody(const SlitProblem& problem, std::int32_t piece, const Task& task);

  /// How many handles the piece has.
  std::int64_t genus() const;

  double size;  ///< the root of the area
  Island island;
  IslandGraph graph;
  std::vector<std::vector<std::int32_t>> loops;  ///< boundary loops, vertices of the mesh
};

/// Moves a vertex that is near the mirror plane onto it. The problem has a reflection.
std::int32_t onto_plane(const SlitProblem& problem, const PieceBody& body, std::int32_t vertex);

/// The tips of a piece's limbs, one of each mirrored pair: where the mean geodesic distance is largest.
/// `distances`: IslandGraph::mean_distances().
std::vector<std::int32_t> find_tips(const SlitProblem& problem, const PieceBody& body,
                                    std::span<const double> distances);

/// The first slits of a plan.
struct SlitTree {
  std::vector<Slit> slits;
  std::vector<std::int32_t> roots;  ///< where slits start in pieces without a boundary
};

/// Where a tree leads.
struct TreeGoal {
  bool has_tips = true;     ///< to the tips of limbs
  bool keeps_holes = true;  ///< not to flat_holes(); otherwise every piece becomes a disc
};

/// Slits that make every piece a disc, or a disc with holes.
///
/// Tips are local maxima of the mean geodesic distance (Hilaga et al. 2001). Handles are cut along the shortest loops
/// (Erickson and Whittlesey 2005). Slits start at the boundary, or at a hidden vertex in the middle of a closed piece.
/// They lead to further boundary loops and tips, each time to the one that is cheapest to reach. It uses several
/// threads. Throws Cancelled.
SlitTree grow_tree(const SlitProblem& problem, const TreeGoal& goal, const Task& task);

}  // namespace seamwire::detail
