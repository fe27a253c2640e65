// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "graph/indexed_heap.hpp"

namespace seamwire::detail {

/// Finds the lengths of the shortest paths from any of some nodes of a graph (Dijkstra 1959).
///
/// `least` has an upper bound for each node, which the length replaces. `visit(v, step)` is called once for each node
/// that is reached, nearest first; of equals, the smallest number first. It calls step(next, length) for each edge that
/// leaves v. step() returns whether that makes the path to `next` shorter. If it does, v is the node before `next`.
template <class Visit>
void find_shortest_paths(std::span<const std::int32_t> from, std::vector<double>& least, const Visit& visit) {
  IndexedHeap open(least.size());
  for (const std::int32_t v : from) {
    least[v] = 0.0;
    open.lower(v, 0.0);
  }
  while (!open.empty()) {
    const std::int32_t v = open.pop();
    visit(v, [&](std::int32_t next, double length) {
      const double total = least[v] + length;
      if (!(total < least[next])) return false;
      least[next] = total;
      open.lower(next, total);
      return true;
    });
  }
}

}  // namespace seamwire::detail
