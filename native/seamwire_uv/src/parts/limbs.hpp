// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "graph/disjoint_sets.hpp"
#include "prices/plan_mesh.hpp"
#include "seamwire/task.hpp"

namespace seamwire::detail {

/// One step of joining triangles: two regions, each named after one of its triangles, and what joining them costs.
struct LimbJoin {
  double cost = 0.0;
  std::int32_t one = -1, other = -1;
};

/// The limbs of a mesh. Each connected piece is divided separately. Sizes are relative to the piece.
class Limbs {
 public:
  /// Searches a mesh, once for all amounts. The mesh must outlive this. Throws Cancelled.
  Limbs(const PlanMesh& mesh, std::span<const FaceFrame> frames, const Pieces& pieces, const Task& task);

  /// The limb of each triangle, numbered from 0. Joins that cost up to `most` are made. Throws Cancelled.
  std::vector<std::int32_t> find(double most, const Task& task) const;

 private:
  void join_up_to(double most, std::span<const LimbJoin> joins, DisjointSets& sets) const;

  const PlanMesh& mesh_;
  std::vector<double> areas_;                 // of each triangle, in areas of its piece
  std::vector<double> weights_;               // of each edge
  std::vector<double> distances_;             // between the triangles at each edge, in roots of the area of their piece
  std::vector<std::vector<LimbJoin>> joins_;  // for each piece, in their order
};

/// Joins limbs whose common border is in full view for the most part, as around a face. `open`: how visible each vertex
/// is, as from openness(). `of_face`: the limb of each triangle, by any numbers. Throws Cancelled.
void join_exposed(const PlanMesh& mesh, std::span<const double> open, std::vector<std::int32_t>& of_face,
                  const Task& task);

}  // namespace seamwire::detail
