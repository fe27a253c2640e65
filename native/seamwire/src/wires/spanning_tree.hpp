// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "seamwire/surface/intrinsic_mesh.hpp"
#include "seamwire/task.hpp"

namespace seamwire::detail {

/// The edges of a mesh's triangles, each as its lowest half-edge, and the faces on both sides. Beyond a boundary lies
/// the hole that it surrounds, as one more face, numbered after the triangles. A boundary goes on over an edge with two
/// triangles that cannot be oriented alike, and ends at an edge with three or more.
struct MeshEdges {
  /// `task` is told of a tenth.
  MeshEdges(const IntrinsicMesh& mesh, const Task& task);
  std::size_t count() const { return half_edges.size(); }
  /// The edge of that half-edge; -1 if it is not the lowest of its edge.
  std::int32_t edge_of(std::int32_t half_edge) const;

  std::size_t face_count, hole_count = 0;
  std::vector<std::int32_t> half_edges;  ///< ascending
  /// The face of each edge's half-edge, and the face or the hole on the other side. With siblings, the same face twice.
  std::vector<std::array<std::int32_t, 2>> faces;
};

/// Tells of each edge whether it is in the tree of the vertices. The tree joins each vertex to the seed of the
/// distances, over vertices that are nearer and nearer to the seed. A vertex may have no nearer neighbor, because a
/// wire may reach it through a triangle whose other corners are farther away. Such a vertex is joined to another one
/// nearby. `task` is told of a tenth to a quarter.
std::vector<std::uint8_t> spanning_tree(const IntrinsicMesh& mesh, const MeshEdges& edges,
                                        const std::vector<double>& distances, const Task& task);

}  // namespace seamwire::detail
