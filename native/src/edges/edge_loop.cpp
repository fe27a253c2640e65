// SPDX-License-Identifier: GPL-3.0-or-later
#include "seamwire/edges/edge_loop.hpp"

#include <algorithm>
#include <unordered_set>

#include "edges/edge_adjacency.hpp"

namespace seamwire {

using namespace detail;

std::vector<std::int32_t> extend_straight(const EdgeAdjacency& adjacency, const Edge& edge,
                                          std::span<const std::int32_t> stops) {
  // 1 - cos 60 degrees, a little less: a vertex of three equal angles offers two ways of 60 degrees and no way on.
  constexpr double kMostTurn = 0.5 - 1e-9;
  std::int32_t e = adjacency.checked(edge, "edge");
  const std::unordered_set<std::int32_t> stop_at(stops.begin(), stops.end());
  std::unordered_set<std::int32_t> visited{edge[0], edge[1]};
  std::vector<std::int32_t> chain{edge[1]};
  for (std::int32_t v = edge[1];;) {
    const std::int32_t back = adjacency.twin(e);
    if (adjacency.is_open(v) && !adjacency.is_on_boundary(back, v)) break;
    std::int32_t best = -1;
    double least = kMostTurn;
    for (std::int32_t out = adjacency.begin(v); out < adjacency.end(v); ++out) {
      if (out == back) continue;
      const double turn = adjacency.turn(back, out);
      if (turn < least) {
        least = turn;
        best = out;
      }
    }
    if (best < 0) break;
    e = best;
    v = adjacency.head(e);
    chain.push_back(v);
    if (stop_at.contains(v) || !visited.insert(v).second) break;
  }
  return chain;
}

EdgeLoop edge_loop(const EdgeAdjacency& adjacency, const Edge& edge, std::span<const std::int32_t> stops) {
  const std::int32_t start = adjacency.checked(edge, "edge");
  const std::unordered_set<std::int32_t> stop_at(stops.begin(), stops.end());
  std::unordered_set<std::int32_t> visited{edge[0], edge[1]};
  // On from the head of a directed edge; whether the way comes round to the edge that it started from.
  const auto walk = [&](std::int32_t e, std::vector<std::int32_t>& way) {
    while (!stop_at.contains(adjacency.head(e))) {
      e = adjacency.opposite(adjacency.twin(e));
      if (e < 0) break;
      way.push_back(adjacency.head(e));
      if (!visited.insert(way.back()).second) return adjacency.opposite(adjacency.twin(e)) == start;
    }
    return false;
  };

  std::vector<std::int32_t> ahead{edge[1]}, behind{edge[0]};
  if (!walk(start, ahead)) walk(adjacency.twin(start), behind);
  EdgeLoop loop{{behind.rbegin(), behind.rend()}};
  loop.vertices.insert(loop.vertices.end(), ahead.begin(), ahead.end());
  // Not where both ends cross the strip at one of its inner vertices.
  loop.closed =
      loop.vertices.front() == loop.vertices.back() && std::ranges::count(loop.vertices, loop.vertices.front()) == 2;
  if (loop.closed) loop.vertices.pop_back();
  return loop;
}

}  // namespace seamwire
