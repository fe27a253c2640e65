// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "prices/plan_mesh.hpp"
#include "prices/polygons.hpp"
#include "prices/reflection.hpp"

namespace seamwire::detail {

/// How a surface bends over each edge, in degrees; 0 on the boundary and inside polygons.
struct EdgeBends {
  std::vector<double> own;   ///< between the two triangles; negative where concave
  std::vector<double> wide;  ///< between places a little away on both sides; it spans the steps of a chamfer
};

/// A connected piece of the surface.
struct PieceSize {
  double diagonal = 0.0, area = 0.0;
};
struct PieceSizes {
  Pieces pieces;
  std::vector<PieceSize> of_piece;

  std::int32_t piece_of(const PlanMesh& mesh, std::int32_t edge) const {
    return pieces.of_face[mesh.half_edge_of[edge] / 3];
  }
};
PieceSizes measure_pieces(const PlanMesh& mesh, std::span<const FaceFrame> frames);

EdgeBends bends_over_edges(const PlanMesh& mesh, std::span<const FaceFrame> frames, const Polygons& polygons,
                           const PieceSizes& sizes);

/// The log odds of each edge of being a border between parts, up to a constant that says how many parts there are;
/// -infinity inside polygons.
///
/// `ambient`: of each vertex, as in Visibility. `is_marked`: of each edge, 1 where an artist expects a border.
/// `reflection`: null if the mesh is not symmetric. `on_plane`: added where the surface bends over the mirror plane.
std::vector<double> border_odds(const PlanMesh& mesh, const Polygons& polygons, const PieceSizes& sizes,
                                const EdgeBends& bends, std::span<const double> ambient,
                                std::span<const std::uint8_t> is_marked, const Reflection* reflection, double on_plane);

/// Returns the price of a cut along an edge with these log odds, for each unit of length. It is minus the logarithm of
/// the probability that the edge is a border, and a little more. Edges inside polygons cost the most.
double price_of_cut(double odds);

}  // namespace seamwire::detail
