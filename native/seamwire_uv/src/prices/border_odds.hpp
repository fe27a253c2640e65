// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "prices/plan_mesh.hpp"
#include "seamwire/task.hpp"

namespace seamwire::detail {

/// The polygons that the triangles of a mesh belong to.
struct Polygons {
  std::vector<std::int32_t> of_face;      ///< of each triangle
  std::vector<std::uint8_t> is_diagonal;  ///< of each edge: 1 inside a polygon
  std::size_t count = 0;
};

/// Finds the polygons: those that were triangulated, and pairs of other triangles that look like a quad, the best pairs
/// first. `is_border`: of each edge, 1 if it cannot lie inside a quad; empty: all can. Throws Cancelled.
Polygons find_polygons(const PlanMesh& mesh, std::span<const std::uint8_t> is_border, const Task& task);

/// Takes pairs of triangles apart at edges that are 1 in `is_apart`. Polygons that were triangulated stay whole.
/// Returns whether there were such pairs. Throws Cancelled.
bool take_apart(const PlanMesh& mesh, std::span<const std::uint8_t> is_apart, Polygons& polygons, const Task& task);

/// The lines that edges form, without diagonals: the edges of each line, from end to end. An edge goes on over a vertex
/// to the edge on the other side if that is nearly straight and neither has a better continuation. Throws Cancelled.
std::vector<std::vector<std::int32_t>> find_lines(const PlanMesh& mesh, const Polygons& polygons, const Task& task);

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
PieceSizes measure_pieces(const PlanMesh& mesh, std::span<const FaceFrame> frames, const Task& task);

EdgeBends bends_over_edges(const PlanMesh& mesh, std::span<const FaceFrame> frames, const Polygons& polygons,
                           const PieceSizes& sizes, const Task& task);

/// The share of all bending that is in sharp edges; 0 on a surface that does not bend.
double sharp_share(const PlanMesh& mesh, const EdgeBends& bends);

/// The log odds of each edge of being a border between parts, up to a constant that says how many parts there are;
/// -infinity inside polygons.
///
/// `ambient`: of each vertex, as in Visibility. `is_marked`: of each edge, 1 where an artist expects a border.
/// `reflection`: null if the mesh is not symmetric. `on_plane`: log odds that edges on the mirror plane get
/// besides, unless the surface is round there.
/// Throws Cancelled.
std::vector<double> border_odds(const PlanMesh& mesh, const Polygons& polygons, const PieceSizes& sizes,
                                const EdgeBends& bends, std::span<const double> ambient,
                                std::span<const std::uint8_t> is_marked, const Reflection* reflection, double on_plane,
                                const Task& task);

/// Returns the price of a cut along an edge with these log odds, for each unit of length. It is minus the logarithm of
/// the probability that the edge is a border. Edges inside polygons cost the most.
double price_of_cut(double odds);

}  // namespace seamwire::detail
