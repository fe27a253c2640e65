// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>

#include "detail/index.hpp"
#include "graph/disjoint_sets.hpp"
#include "seamwire/surface/triangle_connectivity.hpp"

namespace seamwire::detail {

/// Joins the triangles on both sides of each edge for which are_joined(half_edge) returns true. It is called with one
/// half-edge of each edge between two triangles.
template <class AreJoined>
DisjointSets joined_faces(const TriangleConnectivity& mesh, const AreJoined& are_joined) {
  DisjointSets sets(mesh.face_count());
  for (std::int32_t h = 0; index(h) < mesh.twins.size(); ++h) {
    if (mesh.twins[h] > h && are_joined(h)) sets.join(h / 3, mesh.twins[h] / 3);
  }
  return sets;
}

}  // namespace seamwire::detail
