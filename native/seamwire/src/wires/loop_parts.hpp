// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "detail/csr.hpp"
#include "seamwire/surface/intrinsic_mesh.hpp"
#include "seamwire/task.hpp"
#include "wires/spanning_tree.hpp"

namespace seamwire::detail {

/// What loops of a vertex tree part a mesh into, whatever edges it has. The mesh has to outlive it.
class LoopParts {
 public:
  static constexpr std::uint8_t kElsewhere = 0, kLeft = 1, kRight = 2;

  /// Takes time proportional to the mesh. Throws Cancelled.
  LoopParts(const IntrinsicMesh& mesh, const std::vector<double>& distances, const Task& task);

  /// Cuts the mesh along the edges of the loop that a half-edge closes. Returns for each face and hole whether it is
  /// connected to the face of the half-edge (kLeft), only to the other side (kRight), or to neither. Nothing is kRight
  /// if the loop does not separate. The half-edge must be the lowest of its edge. Throws Cancelled.
  std::vector<std::uint8_t> side_of(std::int32_t half_edge, const Task& task) const;

 private:
  std::vector<std::uint8_t> loop_edges(std::int32_t edge, const Task& task) const;

  struct Step {
    std::int32_t to, edge;  // -1: an edge without faces
  };

  const IntrinsicMesh& mesh_;
  const EdgesAndHoles edges_;
  Csr<std::int32_t> faces_of_edge_;  // and holes
  Csr<std::int32_t> edges_of_face_;
  Csr<Step> tree_;  // per vertex
};

}  // namespace seamwire::detail
