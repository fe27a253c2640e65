// SPDX-License-Identifier: GPL-3.0-or-later
#include "seamwire/edges/edge_loop.hpp"

#include <algorithm>
#include <unordered_set>

#include "edges/edge_adjacency.hpp"
#include "edges/straight_ways.hpp"

namespace seamwire {

using namespace detail;

namespace {

auto any_of(std::span<const std::int32_t> stops) {
  return [at = std::unordered_set<std::int32_t>(stops.begin(), stops.end())](std::int32_t v) { return at.contains(v); };
}

}  // namespace

std::int32_t detail::straight_on(const EdgeAdjacency& adjacency, std::int32_t edge) {
  // 1 - cos 60 degrees, a little less: a vertex of three equal angles offers two ways of 60 degrees and no way on.
  constexpr double kMostTurn = 0.5 - 1e-9;
  const std::int32_t v = adjacency.head(edge), back = adjacency.twin(edge);
  if (adjacency.is_open(v) && !adjacency.is_on_boundary(back, v)) return -1;
  std::int32_t best = -1;
  double least = kMostTurn;
  for (std::int32_t out = adjacency.begin(v); out < adjacency.end(v); ++out) {
    const double turn = adjacency.turn(back, out);
    if (out == back || !(turn < least)) continue;
    least = turn;
    best = out;
  }
  return best;
}

std::vector<std::int32_t> extend_straight(const EdgeAdjacency& adjacency, const Edge& edge,
                                          std::span<const std::int32_t> stops) {
  return detail::extend_straight(adjacency, adjacency.checked(edge, "edge"), any_of(stops));
}

EdgeLoop edge_loop(const EdgeAdjacency& adjacency, const Edge& edge, std::span<const std::int32_t> stops) {
  return detail::edge_loop(adjacency, adjacency.checked(edge, "edge"), any_of(stops));
}

std::int32_t count_corners(const Surface& surface, const EdgeAdjacency& adjacency, std::span<const std::int32_t> loop) {
  constexpr double kCosine = 0.5;
  const std::size_t n = loop.size();
  const auto next = [&](std::int32_t a, std::int32_t b) {
    const std::int32_t edge = adjacency.find(a, b), on = edge < 0 ? -1 : straight_on(adjacency, edge);
    return on < 0 ? -1 : adjacency.head(on);
  };
  std::int32_t count = 0;
  for (std::size_t i = 0; i < n; ++i) {
    const std::int32_t before = loop[(i + n - 1) % n], here = loop[i], after = loop[(i + 1) % n];
    const std::int32_t forth = next(before, here), back = next(after, here);
    if (forth < 0 || forth == after || back < 0 || back == before || back == forth) continue;
    const auto turns = [&](std::int32_t one, std::int32_t two) {
      const Vector u = surface.points()[one] - surface.points()[here],
                   v = surface.points()[two] - surface.points()[here];
      return u.dot(v) <= kCosine * (u.norm() * v.norm());
    };
    if (turns(forth, after) && turns(back, before)) ++count;
  }
  return count;
}

}  // namespace seamwire
