// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "detail/poll.hpp"
#include "graph/disjoint_sets.hpp"

namespace seamwire::detail {

/// The second half of a tree-cotree decomposition (Eppstein, "Dynamic generators of topologically embedded graphs",
/// 2003). It splits the edges of a surface that are not in some tree of its vertices.
///
/// Each of these edges closes a loop of the tree of the vertices. If they come in descending length of their loops, the
/// edges of neither tree close the shortest loops that leave discs (Erickson and Whittlesey, "Greedy optimal homotopy
/// and homology generators", 2005).
struct Cotree {
  /// `sides(i)`: the faces on both sides of edge i, a pair. Throws Cancelled.
  template <class Sides>
  Cotree(std::size_t face_count, std::size_t edge_count, const Sides& sides, const Poll& poll) : parts(face_count) {
    for (std::size_t i = 0; i < edge_count; ++i) {
      poll.at(i);
      const auto [one, other] = sides(i);
      (parts.join(one, other) ? crossed : generators).push_back(static_cast<std::int32_t>(i));
    }
  }

  DisjointSets parts;                    ///< of faces that are joined over the edges
  std::vector<std::int32_t> crossed;     ///< the edges of a tree of the faces of each part
  std::vector<std::int32_t> generators;  ///< the edges of neither tree
};

}  // namespace seamwire::detail
