// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "prices/plan_mesh.hpp"
#include "seamwire/task.hpp"

namespace seamwire::detail {

/// One step of joining triangles: two regions, each named after one of its triangles, and what joining them costs.
struct LimbJoin {
  double cost = 0.0;
  std::int32_t one = -1, other = -1;
};

/// The share of the area in triangles that hardly bend to their neighbors; 1 without area. Throws Cancelled.
double flat_share(const PlanMesh& mesh, std::span<const FaceFrame> frames, const Pieces& pieces, const Task& task);

/// The limbs of a mesh. Each connected piece is divided separately. Sizes are relative to the piece.
class Limbs {
 public:
  /// Searches a mesh, once for all amounts. The mesh must outlive this. Throws Cancelled.
  Limbs(const PlanMesh& mesh, std::span<const FaceFrame> frames, const Pieces& pieces, const Task& task);

  /// The limb of each triangle, numbered from 0. `amount`: from 0, which joins each piece, to 1. Throws Cancelled.
  std::vector<std::int32_t> find(double amount, const Task& task) const;

 private:
  const PlanMesh& mesh_;
  std::vector<double> areas_;                 // of each triangle, in areas of its piece
  std::vector<double> weights_;               // of each edge
  std::vector<double> distances_;             // between the triangles at each edge, in roots of the area of their piece
  std::vector<std::vector<LimbJoin>> joins_;  // for each piece, in their order
};

}  // namespace seamwire::detail
