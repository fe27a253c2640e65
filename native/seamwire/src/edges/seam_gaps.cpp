// SPDX-License-Identifier: GPL-3.0-or-later
#include "seamwire/edges/seam_gaps.hpp"

#include <algorithm>
#include <functional>
#include <queue>
#include <string>
#include <unordered_map>
#include <utility>

#include "detail/drop_repeats.hpp"
#include "detail/index.hpp"
#include "detail/poll.hpp"
#include "edges/edge_adjacency.hpp"
#include "edges/part_borders.hpp"
#include "graph/edge_chains.hpp"
#include "surface/corner_fans.hpp"
#include "surface/real_edges.hpp"

namespace seamwire {

using namespace detail;

namespace {

/// If cuts lead to a place within so many lengths of a gap, there is no gap.
constexpr double kDetour = 4.0;

/// Calls reach(v, distance) for vertices around one, nearest first (Dijkstra 1959), until it returns false. Ways of one
/// edge and of several edges have their own limits. Ways run along directed edges for which runs_along(e) returns true.
/// Returns the vertex before each.
template <class RunsAlong, class Reach>
std::unordered_map<std::int32_t, std::int32_t> walk_from(const Surface& surface, const EdgeAdjacency& adjacency,
                                                         std::int32_t start, double longest, double longest_of_several,
                                                         const RunsAlong& runs_along, const Reach& reach) {
  using Way = std::pair<double, std::int32_t>;
  std::priority_queue<Way, std::vector<Way>, std::greater<>> open;
  std::unordered_map<std::int32_t, double> least{{start, 0.0}};
  std::unordered_map<std::int32_t, std::int32_t> before{{start, -1}};
  open.emplace(0.0, start);
  while (!open.empty()) {
    const auto [distance, v] = open.top();
    open.pop();
    if (distance > least[v]) continue;
    if (!reach(v, distance)) break;
    const double most = v == start ? longest : longest_of_several;
    for (std::int32_t e = adjacency.begin(v); e < adjacency.end(v); ++e) {
      if (!runs_along(e)) continue;
      const std::int32_t next = adjacency.head(e);
      const double so_far = distance + (surface.points()[next] - surface.points()[v]).norm();
      if (!(so_far <= most)) continue;
      const auto [at, is_new] = least.try_emplace(next, so_far);
      if (!is_new && !(so_far < at->second)) continue;
      at->second = so_far;
      before[next] = v;
      open.emplace(so_far, next);
    }
  }
  return before;
}

}  // namespace

std::vector<std::vector<std::int32_t>> edge_chains(std::span<const Edge> edges, std::span<const std::int32_t> ends) {
  std::vector<Edge> distinct;
  std::size_t count = 0;
  for (const auto& [a, b] : edges) {
    if (a < 0 || b < 0) throw InvalidInput("edges: vertex " + std::to_string(std::min(a, b)) + " is negative");
    if (a == b) throw InvalidInput("edges: an edge joins vertex " + std::to_string(a) + " to itself");
    distinct.push_back(ascending(a, b));
    count = std::max({count, index(a) + 1, index(b) + 1});
  }
  std::ranges::sort(distinct);
  drop_repeats(distinct);
  std::vector<bool> is_end(count);
  for (const std::int32_t v : ends) {
    if (is_index(v, count)) is_end[v] = true;
  }
  return EdgeChains(count, distinct).all([&](std::int32_t v) { return is_end[v]; });
}

std::vector<SeamGap> find_gaps(const Surface& surface, const EdgeAdjacency& adjacency, std::span<const Edge> seams,
                               const SeamGapOptions& options, const Task& task) {
  adjacency.check_size(surface);
  const Poll poll(task, 0.0, 0.0, 1, 1);
  std::vector<bool> is_cut(adjacency.directed_count()), is_hidden(is_cut.size());
  std::vector<bool> is_left_out(surface.vertex_count());  // cuts that end there have no gap
  std::vector<Edge> own;
  for (const auto& [a, b] : seams) {
    for (const std::int32_t v : {a, b}) check_index(v, surface.vertex_count(), "seams: vertex");
    const std::int32_t e = adjacency.find(a, b);
    if (e < 0) continue;
    is_cut[e] = is_cut[adjacency.twin(e)] = true;
    own.push_back({a, b});
  }
  const auto leave_out = [&](std::int32_t v, const char* what) {
    check_index(v, surface.vertex_count(), what);
    is_left_out[v] = true;
  };
  for (const std::int32_t v : options.meant) leave_out(v, "meant: vertex");
  for (const auto& [a, b] : options.partly_hidden) {
    for (const std::int32_t v : {a, b}) leave_out(v, "partly_hidden: vertex");
    const std::int32_t e = adjacency.find(a, b);
    if (e >= 0) is_hidden[e] = is_hidden[adjacency.twin(e)] = true;
  }
  const CornerFans& mesh = corner_fans(surface);
  for (std::int32_t h = 0; index(h) < mesh.twins.size(); ++h) {
    if (mesh.twins[h] >= 0 || mesh.has_siblings(h)) continue;
    const std::int32_t e = adjacency.find(mesh.vertices[mesh.tail(h)], mesh.vertices[mesh.tip(h)]);
    if (e < 0 || is_hidden[e]) continue;
    is_cut[e] = is_cut[adjacency.twin(e)] = true;
    is_left_out[adjacency.tail(e)] = is_left_out[adjacency.head(e)] = true;
  }
  const auto cuts_at = [&](std::int32_t v) {
    return std::count(is_cut.begin() + adjacency.begin(v), is_cut.begin() + adjacency.end(v), true);
  };
  const auto gap_at = [&](std::int32_t end, double length) -> SeamGap {
    const double longest = options.longest * length;
    const double of_several = std::min(options.longest, options.longest_of_several) * length;
    std::unordered_map<std::int32_t, double> along;
    walk_from(
        surface, adjacency, end, kDetour * longest, kDetour * longest, [&](std::int32_t e) { return is_cut[e]; },
        [&](std::int32_t v, double distance) { return along.emplace(v, distance).second; });
    SeamGap gap;
    std::size_t looked_at = 0;
    const auto before = walk_from(
        surface, adjacency, end, longest, of_several, [](std::int32_t) { return true; },
        [&](std::int32_t v, double distance) {
          if (++looked_at > options.most_looked_at) return false;
          const auto known = along.find(v);
          if (cuts_at(v) == 0 || (known != along.end() && known->second <= kDetour * distance)) return true;
          gap = {{v}, distance};
          return false;
        });
    while (!gap.path.empty() && gap.path.back() != end) gap.path.push_back(before.at(gap.path.back()));
    std::ranges::reverse(gap.path);
    return gap;
  };
  std::vector<SeamGap> found;
  std::size_t count = 0;
  for (const std::vector<std::int32_t>& chain : edge_chains(own)) {
    const double length = length_of(surface.points(), sides_of(chain, false));
    for (const std::int32_t end : {chain.front(), chain.back()}) {
      poll.at(count++);
      if (is_left_out[end] || cuts_at(end) != 1) continue;
      SeamGap gap = gap_at(end, length);
      const auto is_same = [&](const SeamGap& other) {
        return other.path.front() == gap.path.back() && other.path.back() == gap.path.front();
      };
      if (!gap.path.empty() && std::ranges::none_of(found, is_same)) found.push_back(std::move(gap));
    }
  }
  std::ranges::sort(found, {}, [](const SeamGap& gap) { return std::pair(gap.length, gap.path.front()); });
  return found;
}

}  // namespace seamwire
