// SPDX-License-Identifier: GPL-3.0-or-later
#include "seamwire/wires/snap.hpp"

#include <algorithm>
#include <array>
#include <functional>
#include <queue>
#include <string>
#include <tuple>
#include <utility>

#include "detail/csr.hpp"
#include "detail/index.hpp"
#include "detail/infinity.hpp"
#include "detail/insertion_map.hpp"
#include "detail/poll.hpp"
#include "graph/disjoint_sets.hpp"
#include "graph/loop_erasure.hpp"
#include "surface/corner_fans.hpp"
#include "surface/real_edges.hpp"
#include "wires/curve_check.hpp"
#include "wires/polyline.hpp"

namespace seamwire {

using namespace detail;

namespace {

/// The edges that a snapped path may take, growing. Edges are numbered as in Surface::edges().
class Band {
 public:
  explicit Band(const Surface& surface) : surface_(surface), fans_(corner_fans(surface)) {}

  const std::vector<std::int32_t>& edges() const { return edges_.numbers(); }

  /// Adds the polygons that the wire crosses, the edges it follows, and the polygons that share an edge with these.
  void add(const Wire& wire) {
    std::vector<Edge> followed;
    for (std::size_t i = 0; i < wire.faces.size(); ++i) {
      if (wire.faces[i] >= 0) {
        const auto found = std::ranges::lower_bound(fans_.faces, wire.faces[i]);
        const bool is_there = found != fans_.faces.end() && *found == wire.faces[i];
        if (is_there) add_polygon(static_cast<std::int32_t>(found - fans_.faces.begin()));
        continue;
      }
      const std::int32_t a = wire.vertices[i], b = wire.vertices[i + 1];
      if (a >= 0 && b >= 0 && add_edge(a, b)) {
        followed.push_back({a, b});
      } else {  // along the boundary of a hole that the embedding left
        if (a >= 0) add_vertex(a);
        if (b >= 0) add_vertex(b);
      }
    }
    const std::size_t before = triangles_.numbers().size();
    for (std::size_t i = 0; i < before; ++i) {
      const std::int32_t begin = 3 * triangles_.numbers()[i];
      for (std::int32_t h = begin; h < begin + 3; ++h) {
        fans_.for_each_beyond(h, [&](std::int32_t other) { add_polygon(other / 3); });
      }
    }
    for (const auto& [a, b] : followed) add_polygons_beside(a, b);
  }
  /// All around the vertices of what is there. False where that is nothing new.
  bool widen() {
    const std::size_t n = edges().size();
    for (; widened_ < n; ++widened_) {
      for (const std::int32_t v : surface_.edges()[edges()[widened_]]) add_vertex(v);
    }
    return edges().size() > n;
  }
  void add_vertex(std::int32_t vertex) {
    if (vertices_.numbers().empty()) list_loose_edges();
    if (!vertices_.insert(vertex).second) return;
    for_each_leaving(vertex, [&](std::int32_t h) { add_polygon(h / 3); });
    for (auto next = std::ranges::lower_bound(loose_, Edge{vertex, -1}); next != loose_.end() && (*next)[0] == vertex;
         ++next) {
      add_edge(vertex, (*next)[1]);
    }
  }

 private:
  /// Returns false if the edge is not real.
  bool add_edge(std::int32_t a, std::int32_t b) {
    const Edge edge = ascending(a, b);
    const auto found = std::ranges::lower_bound(surface_.edges(), edge);
    if (found == surface_.edges().end() || *found != edge) return false;
    edges_.insert(static_cast<std::int32_t>(found - surface_.edges().begin()));
    return true;
  }

  void list_loose_edges() {
    for (const auto& [a, b] : surface_.loose_edges()) {
      loose_.push_back({a, b});
      loose_.push_back({b, a});
    }
    std::ranges::sort(loose_);
  }

  /// Adds the edges of the polygon that a triangle belongs to: all triangles joined across edges that are not real.
  void add_polygon(std::int32_t triangle) {
    std::size_t next = triangles_.numbers().size();
    triangles_.insert(triangle);
    for (; next < triangles_.numbers().size(); ++next) {
      const std::int32_t begin = 3 * triangles_.numbers()[next];
      for (std::int32_t h = begin; h < begin + 3; ++h) {
        if (add_edge(fans_.vertices[fans_.tail(h)], fans_.vertices[fans_.tip(h)])) continue;
        fans_.for_each_beyond(h, [&](std::int32_t other) { triangles_.insert(other / 3); });
      }
    }
  }

  void add_polygons_beside(std::int32_t a, std::int32_t b) {
    for_each_leaving(a, [&](std::int32_t h) {
      if (fans_.vertices[fans_.tip(h)] == b || fans_.vertices[fans_.apex(h)] == b) add_polygon(h / 3);
    });
  }

  template <class Visit>
  void for_each_leaving(std::int32_t vertex, const Visit& visit) const {
    const auto [first, last] = std::equal_range(fans_.vertices.begin(), fans_.vertices.end(), vertex);
    for (auto fan = first; fan != last; ++fan) {
      fans_.for_each_leaving(static_cast<std::int32_t>(fan - fans_.vertices.begin()), visit);
    }
  }

  const Surface& surface_;
  const CornerFans& fans_;
  InsertionMap edges_, triangles_, vertices_;
  std::vector<Edge> loose_;  // in both directions, ascending; empty until a vertex is added
  std::size_t widened_ = 0;  // edges whose surroundings are there
};

/// The cost of a turn, as a factor of 1 - its cosine and of the lengths of the edges on both sides of it. See
/// docs/method/wires.md.
constexpr double kTurning = 0.5;

/// Dijkstra's algorithm over the directed edges of a band, since a turn belongs to two edges.
///
/// The costs of edges are integrals, and nearly all of the time goes into them. So an edge waits in the queue with a
/// lower bound of its cost, from the distances of its ends. The integral is computed when the edge comes out and may
/// still count.
class BandSearch {
 public:
  BandSearch(const Surface& surface, std::vector<std::int32_t> edges, const Wire& wire)
      : surface_(surface),
        polyline_(wire.points),
        // Edges along the wire are for free, all but this: it decides among them by length.
        per_length_(1e-6 * wire.euclidean_length) {
    std::vector<std::pair<std::int32_t, std::int32_t>> pairs;  // (vertex, directed edge that leaves it)
    pairs.reserve(2 * edges.size());
    heads_.reserve(2 * edges.size());
    along_.reserve(edges.size());
    std::ranges::sort(edges);  // so that it finds the same path among equal ones, whatever their order
    for (const std::int32_t e : edges) {
      const auto& [tail, head] = surface.edges()[e];
      const std::int32_t a = vertices_.insert(tail).first, b = vertices_.insert(head).first;
      const Vector vector = surface.points()[head] - surface.points()[tail];
      along_.push_back({vector, vector.norm()});
      for (const auto& [from, to] : {std::pair(a, b), std::pair(b, a)}) {
        pairs.push_back({from, static_cast<std::int32_t>(heads_.size())});
        heads_.push_back(to);
      }
    }
    leaving_ = Csr<std::int32_t>(vertices_.numbers().size(), pairs);
  }

  /// Empty where the band does not connect the ends. `done`: how much of the task was done before; this is half of it.
  std::vector<std::int32_t> path(std::int32_t from_vertex, std::int32_t to_vertex, const Task& task, double done) {
    const std::int32_t from = vertices_.find(from_vertex), to = vertices_.find(to_vertex);
    if (from < 0 || to < 0) return {};
    states_.assign(heads_.size(), {});
    distances_.assign(vertices_.numbers().size(), -1.0);
    weights_.assign(heads_.size() / 2, -1.0);
    leave(from, -1);
    Poll poll(task, done, done + 0.5, heads_.size(), Poll::kFewSteps);
    while (!queue_.empty()) {
      poll.next();
      const Waiting next = queue_.top();
      queue_.pop();
      if (states_[next.edge].is_settled) continue;
      if (next.before != kReached) {
        reach(next.edge, next.before);
        continue;
      }
      states_[next.edge].is_settled = true;
      if (heads_[next.edge] == to) return chain(next.edge);
      leave(heads_[next.edge], next.edge);
    }
    return {};
  }

 private:
  static constexpr std::int32_t kReached = -2;

  /// Of a directed edge: the least cost of a path that ends with it.
  struct State {
    double cost = kInfinity;
    double least_before = kInfinity;  // of reaching the edge, and of the turn onto it
    std::int32_t before = -1;         // the directed edge before it in that path; -1: none
    bool is_settled = false;
  };
  /// A directed edge at its cost, or behind `before`: not known to cost less that way.
  struct Waiting {
    double cost;
    std::array<std::int32_t, 2>
        numbers;  // of its ends on the surface, so that the order is the same whatever the band's
    std::int32_t edge, before;
    bool operator>(const Waiting& other) const {
      return std::tie(cost, numbers, before) > std::tie(other.cost, other.numbers, other.before);
    }
  };

  /// An edge from its first end to its second.
  struct Along {
    Vector vector;
    double length;
  };

  /// Directed edges come in pairs, in opposite directions.
  std::int32_t tail(std::int32_t edge) const { return heads_[edge ^ 1]; }
  const Vector& point(std::int32_t vertex) const { return surface_.points()[vertices_.numbers()[vertex]]; }

  void push(double cost, std::int32_t edge, std::int32_t before) {
    queue_.push({cost, {vertices_.numbers()[heads_[edge]], vertices_.numbers()[tail(edge)]}, edge, before});
  }

  double distance(std::int32_t vertex, double bound) {
    double& known = distances_[vertex];
    if (known < 0) known = polyline_.distance(point(vertex), bound);
    return known;
  }

  /// Of all before an edge, and the turn onto it.
  double cost_before(std::int32_t edge, std::int32_t before) const {
    if (before < 0) return 0.0;
    const Along &u = along_[before / 2], &v = along_[edge / 2];
    const double dot = ((before ^ edge) & 1) != 0 ? -u.vector.dot(v.vector) : u.vector.dot(v.vector);
    return states_[before].cost + kTurning * std::max(0.0, u.length * v.length - dot);
  }

  /// Goes on from a vertex that is reached over `before`.
  void leave(std::int32_t vertex, std::int32_t before) {
    const double here = distance(vertex, kInfinity);
    for (const std::int32_t edge : leaving_[vertex]) {
      State& state = states_[edge];
      if (state.is_settled || edge == (before ^ 1)) continue;
      const double so_far = cost_before(edge, before);
      if (so_far > state.least_before) continue;
      state.least_before = so_far;
      const double length = along_[edge / 2].length;
      const double there = distance(heads_[edge], (here + length) * (1.0 + 1e-12));
      const double least = Polyline::least_integral(length, here, there) + per_length_ * length;
      const double cost = so_far + (weights_[edge / 2] < 0 ? least : weights_[edge / 2]);
      if (cost < state.cost) push(cost, edge, before);
    }
  }

  void reach(std::int32_t edge, std::int32_t before) {
    double& weight = weights_[edge / 2];
    if (weight < 0) {
      // In the same direction for both, so that both have the same.
      const std::int32_t one = edge & ~1;
      const Vector &a = point(tail(one)), &b = point(heads_[one]);
      weight = polyline_.integral(a, b, distances_[tail(one)], distances_[heads_[one]]) +
               per_length_ * along_[edge / 2].length;
    }
    const double cost = cost_before(edge, before) + weight;
    State& state = states_[edge];
    if (!(cost < state.cost)) return;
    state.cost = cost;
    state.before = before;
    push(cost, edge, kReached);
  }

  /// The vertices of the path that ends with an edge.
  std::vector<std::int32_t> chain(std::int32_t last) const {
    std::vector<std::int32_t> back{heads_[last]};
    for (std::int32_t edge = last; edge >= 0; edge = states_[edge].before) back.push_back(tail(edge));
    std::vector<std::int32_t> path = without_loops(back);
    std::ranges::reverse(path);
    for (std::int32_t& vertex : path) vertex = vertices_.numbers()[vertex];
    return path;
  }

  const Surface& surface_;
  const Polyline polyline_;
  const double per_length_;
  InsertionMap vertices_;            // of the band, which are numbered in it by their places
  std::vector<std::int32_t> heads_;  // of directed edges, each next to the opposite one
  std::vector<Along> along_;         // of undirected edges
  Csr<std::int32_t> leaving_;        // the directed edges that leave each vertex
  std::vector<State> states_;
  std::vector<double> distances_;  // of vertices from the wire; negative: not known yet
  std::vector<double> weights_;    // of undirected edges; negative: not known yet
  std::priority_queue<Waiting, std::vector<Waiting>, std::greater<>> queue_;
};

void check_wire(const Surface& surface, const Wire& wire) {
  if (wire.points.empty()) throw InvalidInput("the wire has no points");
  const std::string not_on_it = "the wire is not on this surface: ";
  const auto check_vertex = [&](std::int32_t v) { check_index(v, surface.vertex_count(), not_on_it + "vertex"); };
  check_vertex(wire.from);
  check_vertex(wire.to);
  if (wire.vertices.size() != wire.points.size()) {
    throw InvalidInput("the wire has " + std::to_string(wire.points.size()) + " points, but " +
                       std::to_string(wire.vertices.size()) + " vertex numbers");
  }
  check_curve(surface, wire.points, wire.faces, not_on_it);
  for (std::size_t i = 0; i < wire.vertices.size(); ++i) {
    const std::int32_t v = wire.vertices[i];
    if (v == -1) continue;
    check_vertex(v);
    if (is_same_place(surface, surface.points()[v], wire.points[i])) continue;
    throw InvalidInput(not_on_it + "point " + std::to_string(i) + " is not at vertex " + std::to_string(v));
  }
}

}  // namespace

std::vector<std::int32_t> snap_to_edges(const Surface& surface, const Wire& wire, const Task& task) {
  check_wire(surface, wire);
  if (wire.from == wire.to) return {wire.from};
  Band band(surface);
  const auto closest_path = [&](double done) {
    return BandSearch(surface, band.edges(), wire).path(wire.from, wire.to, task, done);
  };
  band.add(wire);
  std::vector<std::int32_t> path = closest_path(0.0);
  if (!path.empty()) return path;
  // Polygons whose edges are not connected (one with a hole in it), or a wire over what is no real edge.
  DisjointSets connected(surface.vertex_count());
  std::size_t joined = 0;
  band.add_vertex(wire.from);
  do {
    task.check(0.5);
    for (; joined < band.edges().size(); ++joined) {
      const auto& [a, b] = surface.edges()[band.edges()[joined]];
      connected.join(a, b);
    }
    if (connected.find(wire.from) == connected.find(wire.to)) return closest_path(0.5);
  } while (band.widen());
  return {};
}

}  // namespace seamwire
