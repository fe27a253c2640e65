// SPDX-License-Identifier: GPL-3.0-or-later
#include "maps/open_island.hpp"

#include <algorithm>
#include <string>
#include <utility>

#include "detail/csr.hpp"
#include "detail/index.hpp"
#include "detail/infinity.hpp"
#include "detail/poll.hpp"
#include "graph/cotree.hpp"
#include "graph/shortest_paths.hpp"
#include "seamwire/errors.hpp"

namespace seamwire::detail {
namespace {

/// Shortest paths along the real edges of an island.
class Paths {
 public:
  Paths(const Island& island, std::span<const std::uint8_t> is_real, std::span<const Vector> points)
      : island_(island), is_real_(is_real), points_(points), leaving_(island.vertices.size(), [&](const auto& visit) {
          for (std::int32_t h = 0; index(h) < island.twins.size(); ++h) {
            if (can_be_cut(h)) visit(tail(h), h);
          }
        }) {}

  std::int32_t tail(std::int32_t h) const { return island_.tail(h); }
  std::int32_t tip(std::int32_t h) const { return island_.tip(h); }
  double length(std::int32_t h) const {
    return (points_[index(island_.vertices[tail(h)])] - points_[index(island_.vertices[tip(h)])]).norm();
  }

  /// Whether an edge is a real one inside the island.
  bool can_be_cut(std::int32_t h) const { return island_.twins[h] >= 0 && is_real_[index(h)] != 0; }

  /// Distances from the nearest of some vertices. Paths do not run along the boundary. `holes`: loops that paths cross
  /// at no length. A path enters each of them once, so a cut along the path and the loops leaves one piece.
  void search(std::span<const std::int32_t> from, const Task& task,
              std::span<const std::vector<std::int32_t>> holes = {}) {
    distance_.assign(island_.vertices.size(), kInfinity);
    towards_.assign(island_.vertices.size(), -1);
    across_.assign(island_.vertices.size(), -1);
    std::vector<std::int32_t> hole_of(island_.vertices.size(), -1);
    for (std::int32_t hole = 0; index(hole) < holes.size(); ++hole) {
      for (const std::int32_t v : holes[index(hole)]) hole_of[index(v)] = hole;
    }
    for (const std::int32_t v : from) hole_of[index(v)] = -1;
    std::vector<std::uint8_t> is_entered(holes.size(), 0);
    std::size_t count = 0;
    find_shortest_paths(from, distance_, [&](std::int32_t v, const auto& step) {
      if (count++ % 1024 == 0) task.check(0.0);
      if (const std::int32_t hole = hole_of[index(v)]; hole >= 0 && std::exchange(is_entered[index(hole)], 1) == 0) {
        for (const std::int32_t other : holes[index(hole)]) {
          if (other == v) continue;
          step(other, 0.0);
          towards_[other] = -1;  // even if another path is as short
          across_[other] = v;
        }
      }
      for (const std::int32_t h : leaving_[v]) {
        if (step(tip(h), length(h))) towards_[tip(h)] = h;
      }
    });
  }
  /// The vertex with the greatest distance; of equals, the first one.
  std::int32_t farthest() const {
    std::int32_t far = -1;
    for (std::int32_t v = 0; index(v) < distance_.size(); ++v) {
      if (distance_[v] < kInfinity && (far < 0 || distance_[v] > distance_[far])) far = v;
    }
    return far;
  }
  double distance(std::int32_t v) const { return distance_[v]; }
  /// Whether an edge is the last one of the path to one of its ends.
  bool is_on_path(std::int32_t h) const {
    return towards_[tip(h)] == h || (island_.twins[h] >= 0 && towards_[tail(h)] == island_.twins[h]);
  }
  /// Marks both half-edges of each edge on the path to a vertex.
  void mark(std::int32_t v, std::vector<std::uint8_t>& is_cut) const {
    while (v >= 0) {
      const std::int32_t h = towards_[v];
      if (h >= 0) is_cut[h] = is_cut[island_.twins[h]] = 1;
      v = h >= 0 ? tail(h) : across_[v];
    }
  }
  std::span<const std::int32_t> leaving(std::int32_t v) const { return leaving_[v]; }

 private:
  const Island& island_;
  std::span<const std::uint8_t> is_real_;
  std::span<const Vector> points_;
  Csr<std::int32_t> leaving_;  // half-edges that start at each vertex and can be cut
  std::vector<double> distance_;
  std::vector<std::int32_t> towards_;  // the half-edge that ends at each vertex on the path to it, -1 without one
  std::vector<std::int32_t> across_;   // the vertex from which the path to each vertex crosses a hole, -1 without one
};

std::vector<std::int32_t> boundary_vertices(const std::vector<std::vector<std::int32_t>>& boundaries) {
  std::vector<std::int32_t> all;
  for (const std::vector<std::int32_t>& loop : boundaries) all.insert(all.end(), loop.begin(), loop.end());
  return all;
}

/// Cuts that leave a disc: the edges that neither the paths nor a spanning tree of the triangles take, each with the
/// paths to both of its ends. The tree takes edges inside polygons first, and then prefers edges whose closed curve is
/// long.
std::vector<std::uint8_t> greedy_system(const Island& island, const Paths& paths, const Task& task) {
  std::vector<std::int32_t> order, real;
  for (std::int32_t h = 0; index(h) < island.twins.size(); ++h) {
    if (island.twins[h] < h) continue;
    if (!paths.can_be_cut(h)) order.push_back(h);
    if (paths.can_be_cut(h) && !paths.is_on_path(h)) real.push_back(h);
  }
  const auto curve = [&](std::int32_t h) {
    return paths.distance(paths.tail(h)) + paths.length(h) + paths.distance(paths.tip(h));
  };
  std::ranges::stable_sort(real, std::ranges::greater(), curve);
  order.insert(order.end(), real.begin(), real.end());
  const auto sides = [&](std::size_t i) { return std::pair(order[i] / 3, island.twins[order[i]] / 3); };
  const Cotree cotree(island.triangles.size(), order.size(), sides, Poll(task));
  std::vector<std::uint8_t> is_cut(island.twins.size(), 0);
  for (const std::int32_t i : cotree.generators) {
    const std::int32_t h = order[i];
    if (!paths.can_be_cut(h)) continue;
    is_cut[h] = is_cut[island.twins[h]] = 1;
    paths.mark(paths.tail(h), is_cut);
    paths.mark(paths.tip(h), is_cut);
  }
  return is_cut;
}

/// A path of two edges or more between vertices far from each other.
std::vector<std::uint8_t> slit_in_ball(const Island& island, Paths& paths, const Task& task) {
  std::vector<std::uint8_t> is_cut(island.twins.size(), 0);
  paths.search(std::array<std::int32_t, 1>{0}, task);
  const std::int32_t start = paths.farthest();
  paths.search(std::array<std::int32_t, 1>{start}, task);
  const std::int32_t end = paths.farthest();
  paths.mark(end, is_cut);
  if (std::ranges::count(is_cut, 1) > 2) return is_cut;
  for (const std::int32_t h : paths.leaving(end)) {
    if (paths.tip(h) == start) continue;
    is_cut[h] = is_cut[island.twins[h]] = 1;
    break;
  }
  return is_cut;
}

/// One more edge at the end of a slit of one edge: to an inner vertex or to another slit.
std::vector<std::uint8_t> longer_slit(const Island& island, const Paths& paths,
                                      const std::vector<std::vector<std::int32_t>>& boundaries) {
  std::vector<std::uint8_t> is_cut(island.twins.size(), 0);
  std::vector<std::int32_t> loop_of(island.vertices.size(), -1);
  for (std::size_t loop = 0; loop < boundaries.size(); ++loop) {
    for (const std::int32_t v : boundaries[loop]) loop_of[v] = static_cast<std::int32_t>(loop);
  }
  for (const std::int32_t v : boundaries.front()) {
    for (const std::int32_t h : paths.leaving(v)) {
      if (loop_of[paths.tip(h)] == 0) continue;
      is_cut[h] = is_cut[island.twins[h]] = 1;
      return is_cut;
    }
  }
  return is_cut;
}

[[noreturn]] void fail(const Island& island) {
  throw InvalidInput("the island with triangle " + std::to_string(island.faces.front()) +
                     " cannot be opened to a disc");
}

}  // namespace

bool is_planar(const Island& island) {
  const std::vector<std::vector<std::int32_t>> boundaries = island.boundaries();
  return island.euler_characteristic() == 2 - static_cast<std::int64_t>(boundaries.size()) &&
         std::ranges::any_of(boundaries, [](const auto& loop) { return loop.size() >= 3; });
}

OpenedIsland open_along(const Island& island, const std::vector<std::uint8_t>& is_cut) {
  std::vector<Island> parts = cut_open(island, is_cut);
  if (parts.size() != 1) return {};
  OpenedIsland opened{.island = std::move(parts.front()), .opened = 0};
  for (std::int32_t& v : opened.island.vertices) v = island.vertices[v];
  opened.island.faces = island.faces;
  for (std::int32_t h = 0; index(h) < island.twins.size(); ++h) {
    opened.opened += is_cut[h] != 0 && h < island.twins[h] ? 1 : 0;
  }
  return opened;
}

OpenedIsland open_to_plane(const Island& island, std::span<const std::uint8_t> is_real, std::span<const Vector> points,
                           const Task& task) {
  OpenedIsland result{.island = island, .opened = 0};
  // One round for handles or a closed ball, and one for each slit of a single edge.
  for (int round = 0; round < 3 && !is_planar(result.island); ++round) {
    const std::vector<std::vector<std::int32_t>> boundaries = result.island.boundaries();
    Paths paths(result.island, is_real, points);
    std::vector<std::uint8_t> is_cut;
    if (result.island.euler_characteristic() == 2 - static_cast<std::int64_t>(boundaries.size())) {
      is_cut =
          boundaries.empty() ? slit_in_ball(result.island, paths, task) : longer_slit(result.island, paths, boundaries);
    } else {
      paths.search(boundaries.empty() ? std::vector<std::int32_t>{0} : boundary_vertices(boundaries), task);
      is_cut = greedy_system(result.island, paths, task);
    }
    OpenedIsland opened = open_along(result.island, is_cut);
    if (opened.opened == 0) fail(island);
    opened.opened += result.opened;
    result = std::move(opened);
  }
  if (!is_planar(result.island)) fail(island);
  return result;
}

OpenedIsland open_to_farthest(const Island& island, std::span<const std::uint8_t> is_real,
                              std::span<const Vector> points, const Task& task) {
  const std::vector<std::vector<std::int32_t>> boundaries = island.boundaries();
  Paths paths(island, is_real, points);
  paths.search(boundary_vertices(boundaries), task);
  std::vector<std::uint8_t> is_cut(island.twins.size(), 0);
  std::vector<std::int32_t> triangles(island.vertices.size(), 0);
  for (const Triangle& t : island.triangles) {
    for (const std::int32_t v : t) ++triangles[v];
  }
  bool is_pinched = false;
  for (std::int32_t v = 0; index(v) < triangles.size(); ++v) {
    const double distance = paths.distance(v);
    if (triangles[v] != 2 || !(distance > 0.0 && distance < kInfinity)) continue;
    paths.mark(v, is_cut);
    is_pinched = true;
  }
  if (!is_pinched) {
    std::vector<Vector> own;
    for (const std::int32_t v : island.vertices) own.push_back(points[index(v)]);
    paths.search(boundaries[index(outer_loop(boundaries, own))], task, boundaries);
    paths.mark(paths.farthest(), is_cut);
  }
  return open_along(island, is_cut);
}

}  // namespace seamwire::detail
