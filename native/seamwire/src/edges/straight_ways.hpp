// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <unordered_set>
#include <vector>

#include "edges/edge_adjacency.hpp"
#include "seamwire/edges/edge_loop.hpp"

namespace seamwire::detail {

/// The directed edge that turns least where another one ends, or -1 if every turn is 60 degrees or more. A way along a
/// boundary follows it, and other ways end there.
std::int32_t straight_on(const EdgeAdjacency& adjacency, std::int32_t edge);

/// extend_straight() from the head of a directed edge. `is_stop(v)`: whether the extension ends at a vertex.
template <class IsStop>
std::vector<std::int32_t> extend_straight(const EdgeAdjacency& adjacency, std::int32_t edge, const IsStop& is_stop) {
  std::unordered_set<std::int32_t> visited{adjacency.tail(edge), adjacency.head(edge)};
  std::vector<std::int32_t> chain{adjacency.head(edge)};
  while ((edge = straight_on(adjacency, edge)) >= 0) {
    chain.push_back(adjacency.head(edge));
    if (is_stop(chain.back()) || !visited.insert(chain.back()).second) break;
  }
  return chain;
}

/// edge_loop() through a directed edge.
template <class IsStop>
EdgeLoop edge_loop(const EdgeAdjacency& adjacency, std::int32_t start, const IsStop& is_stop) {
  std::unordered_set<std::int32_t> visited{adjacency.tail(start), adjacency.head(start)};
  // On from the head of a directed edge; whether the way comes round to the edge that it started from.
  const auto walk = [&](std::int32_t e, std::vector<std::int32_t>& way) {
    while (!is_stop(adjacency.head(e))) {
      e = adjacency.opposite(adjacency.twin(e));
      if (e < 0) break;
      way.push_back(adjacency.head(e));
      if (!visited.insert(way.back()).second) return adjacency.opposite(adjacency.twin(e)) == start;
    }
    return false;
  };

  std::vector<std::int32_t> ahead{adjacency.head(start)}, behind{adjacency.tail(start)};
  if (!walk(start, ahead)) walk(adjacency.twin(start), behind);
  EdgeLoop loop{{behind.rbegin(), behind.rend()}};
  loop.vertices.insert(loop.vertices.end(), ahead.begin(), ahead.end());
  // Not where both ends cross the strip at one of its inner vertices.
  loop.closed =
      loop.vertices.front() == loop.vertices.back() && std::ranges::count(loop.vertices, loop.vertices.front()) == 2;
  if (loop.closed) loop.vertices.pop_back();
  return loop;
}

/// The straight way on from both ends of a directed edge, past poles. It has no vertices if it meets itself.
template <class IsStop>
EdgeLoop straight_way(const EdgeAdjacency& adjacency, std::int32_t edge, const IsStop& is_stop) {
  const auto way = [&](std::int32_t e) {
    const std::int32_t end = adjacency.head(e);
    return is_stop(end) ? std::vector<std::int32_t>{end} : extend_straight(adjacency, e, is_stop);
  };
  EdgeLoop found{way(edge)};
  found.closed = found.vertices.size() > 2 && found.vertices.back() == adjacency.tail(edge);
  if (found.closed) found.vertices.pop_back();
  const std::vector<std::int32_t> back =
      found.closed ? std::vector<std::int32_t>{adjacency.tail(edge)} : way(adjacency.twin(edge));
  found.vertices.insert(found.vertices.begin(), back.rbegin(), back.rend());
  const std::unordered_set<std::int32_t> distinct(found.vertices.begin(), found.vertices.end());
  if (!found.closed && distinct.size() < found.vertices.size()) found.vertices.clear();
  return found;
}

}  // namespace seamwire::detail
