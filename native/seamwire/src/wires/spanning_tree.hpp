// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "seamwire/surface/intrinsic_mesh.hpp"
#include "seamwire/task.hpp"
#include "surface/numbered_edges.hpp"

namespace seamwire::detail {

/// The edges of a mesh, and the faces on both sides of each. Beyond a boundary lies the hole that it surrounds, as one
/// more face, numbered after the triangles. A boundary goes on over an edge with two triangles that cannot be oriented
/// alike, and ends at an edge with three or more.
struct EdgesAndHoles : NumberedEdges {
  /// Reports the first tenth of the progress. Throws Cancelled.
  EdgesAndHoles(const IntrinsicMesh& mesh, const Task& task);

  std::size_t face_count, hole_count = 0;
  /// The face of each edge's half-edge, and the face or the hole on the other side. With siblings, the same face twice.
  std::vector<std::array<std::int32_t, 2>> faces;
};

/// Tells of each edge whether it is in the tree of the vertices. The tree joins each vertex to the seed of the
/// distances, over vertices that are nearer and nearer to the seed. A vertex may have no nearer neighbor, because a
/// wire may reach it through a triangle whose other corners are farther away. Such a vertex is joined to another one
/// nearby. `task` is told of a tenth to a quarter.
std::vector<std::uint8_t> spanning_tree(const IntrinsicMesh& mesh, const EdgesAndHoles& edges,
                                        const std::vector<double>& distances, const Task& task);

}  // namespace seamwire::detail
