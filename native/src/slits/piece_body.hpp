// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "slits/island_graph.hpp"
#include "slits/slit_plan.hpp"

namespace seamwire::detail {

/// One piece of a problem before slits cut it.
struct PieceBody {
  PieceBody(const SlitProblem& problem, std::int32_t piece);

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

}  // namespace seamwire::detail
