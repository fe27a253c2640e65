// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <queue>
#include <unordered_map>
#include <vector>

#include "detail/infinity.hpp"
#include "seamwire/metric/scribble.hpp"
#include "seamwire/surface/surface.hpp"
#include "surface/exact_unit.hpp"

namespace seamwire::detail {

/// Throws InvalidInput where a scribble is not one on the surface, see apply_scribbles(). `number`: names it.
void check_scribble(const Surface& surface, const Scribble& scribble, std::size_t number);

/// The vertex at which a point of a scribble lies, or the nearest corner of its face.
inline std::int32_t nearest_vertex(const Surface& surface, const Scribble& scribble, std::size_t i) {
  if (!scribble.vertices.empty() && scribble.vertices[i] >= 0) return scribble.vertices[i];
  return *std::ranges::min_element(surface.triangles()[scribble.faces[i]], {}, [&](std::int32_t v) {
    return (exact_unit(surface) * (surface.points()[v] - scribble.points[i])).squaredNorm();
  });
}

/// How far a chain along a line may be from it: `slack`, and so many times the length of the edge that it leaves over.
struct Corridor {
  double slack, edges;
};

/// The chain of vertices from one to another that stays nearest to a line, by A*. It is empty if no chain leads there
/// within the corridor.
///
/// `point(v)`: where a vertex is. `neighbors(v, visit)`: visits the vertices beside one. `off(v)`: how far a vertex is
/// from the line.
template <class PointOf, class Neighbors, class Off>
std::vector<std::int32_t> chain_along(std::int32_t from, std::int32_t to, const Corridor& corridor,
                                      const PointOf& point, const Neighbors& neighbors, const Off& off) {
  // How much more it costs to be off the line than to be long.
  constexpr double kOffLine = 4.0;
  // Vertices within the corridor, so that a line from one component to another is not searched for long.
  constexpr std::size_t kMostReached = 50'000;
  struct Node {
    std::int32_t before;
    double cost, off;
    bool is_done = false;
  };
  struct Open {
    double bound;
    std::int32_t vertex;
    bool operator>(const Open& o) const { return bound != o.bound ? bound > o.bound : vertex > o.vertex; }
  };
  std::unordered_map<std::int32_t, Node> nodes{{from, {-1, 0.0, 0.0}}};
  std::priority_queue<Open, std::vector<Open>, std::greater<>> open;
  open.push({0.0, from});
  std::size_t reached = 1;
  while (!open.empty() && reached < kMostReached) {
    const std::int32_t v = open.top().vertex;
    open.pop();
    Node& here = nodes.at(v);
    if (here.is_done) continue;
    here.is_done = true;
    if (v == to) {
      std::vector<std::int32_t> chain;
      for (std::int32_t u = v; u >= 0; u = nodes.at(u).before) chain.push_back(u);
      std::ranges::reverse(chain);
      return chain;
    }
    const double cost = here.cost;
    neighbors(v, [&](std::int32_t w) {
      const double length = (point(w) - point(v)).norm();
      const auto [known, is_new] = nodes.try_emplace(w, Node{v, kInfinity, 0.0});
      Node& node = known->second;
      if (is_new) node.off = off(w);
      const double there = cost + length + kOffLine * node.off;
      if (node.is_done || node.off > corridor.slack + corridor.edges * length || !(there < node.cost)) return;
      if (node.cost == kInfinity) ++reached;
      node.before = v;
      node.cost = there;
      open.push({there + (point(to) - point(w)).norm(), w});
    });
  }
  return {};
}

}  // namespace seamwire::detail
