// SPDX-License-Identifier: GPL-3.0-or-later
#include "seamwire/edges/shortest_cycle.hpp"

#include <algorithm>
#include <array>
#include <vector>

#include "detail/index.hpp"
#include "detail/poll.hpp"
#include "edges/edge_search.hpp"
#include "graph/shortest_paths.hpp"

namespace seamwire {

using namespace detail;

namespace {

/// The least cost of a closed chain a -> b -> c (-> d) -> a over all c and d. The search for a cycle may stop there.
double cheapest_small_cycle(const EdgeGraph& graph, std::int32_t ab, double turn_cost) {
  const std::int32_t a = graph.tail(ab), b = graph.head(ab);
  const auto turn = [&](std::int32_t from, std::int32_t to) { return turn_cost * graph.turn(graph.twin(from), to); };
  double best = kInfinity;
  for (std::int32_t bc = graph.begin(b); bc < graph.end(b); ++bc) {
    const std::int32_t c = graph.head(bc);
    if (c == a) continue;
    const double up_to_c = graph.length(ab) + turn(ab, bc) + graph.length(bc);
    if (const std::int32_t ca = graph.find(c, a); ca >= 0) {
      best = std::min(best, up_to_c + turn(bc, ca) + graph.length(ca) + turn(ca, ab));
    }
    for (std::int32_t cd = graph.begin(c); cd < graph.end(c); ++cd) {
      const std::int32_t d = graph.head(cd);
      const std::int32_t da = d == a || d == b ? -1 : graph.find(d, a);
      if (da < 0) continue;
      best = std::min(best, up_to_c + turn(bc, cd) + graph.length(cd) + turn(cd, da) + graph.length(da) + turn(da, ab));
    }
  }
  return best;
}

/// Metric distance along edges to `target`, without turns; infinity beyond `radius`.
std::vector<double> distances(const EdgeGraph& graph, std::int32_t target, double radius, const Task& task) {
  std::vector<double> distance(index(graph.vertex_count()), kInfinity);
  Poll poll(task, 0.0, 0.0, 1);
  find_shortest_paths(std::array{target}, distance, [&](std::int32_t v, const auto& step) {
    for (std::int32_t e = graph.begin(v); e < graph.end(v); ++e) {
      poll.next();
      if (distance[v] + graph.length(e) <= radius) step(graph.head(e), graph.length(e));
    }
  });
  return distance;
}

}  // namespace

std::optional<EdgeChain> shortest_cycle(const EdgeGraph& graph, const Edge& edge, double turning, const Task& task) {
  graph.checked(edge, "cycle");
  check_turning(turning);
  task.check(0.0);
  const std::int32_t a = std::min(edge[0], edge[1]), b = std::max(edge[0], edge[1]);
  const std::int32_t ab = graph.find(a, b);

  // No vertex of the cycle is further from a than half its length. A little room for rounding.
  const double bound = (1.0 + 1e-9) * cheapest_small_cycle(graph, ab, turning * graph.mean_length());
  const std::vector<double> way_back = distances(graph, a, 0.5 * bound, task);
  EdgeSearch search(graph, turning);
  search.block(b);
  search.end_at(a, ab);
  search.start(ab);
  const std::int32_t last =
      search.run([&](std::int32_t v) { return way_back[v]; }, [&](std::int32_t e) { return graph.head(e) == a; }, task);
  if (last < 0) return std::nullopt;
  EdgeChain cycle = chain_to(graph, search, last);
  cycle.vertices.pop_back();  // a, once more
  return cycle;
}

}  // namespace seamwire
