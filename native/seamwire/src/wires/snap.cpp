// SPDX-License-Identifier: GPL-3.0-or-later
#include "seamwire/wires/snap.hpp"

#include <algorithm>
#include <array>
#include <functional>
#include <numeric>
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
#include "wires/curve_check.hpp"
#include "wires/polyline.hpp"

namespace seamwire {

using namespace detail;

struct detail::SnapData {
  std::vector<std::int32_t> polygon_of_face;
  Csr<std::int32_t> edges_of_polygon;  // numbers of Surface::edges()
  Csr<std::int32_t> polygons_of_edge;
  Csr<std::int32_t> edges_of_vertex;
  std::vector<std::int32_t> first_edge;  // per vertex: its first edge in Surface::edges() as the smaller of the two

  /// The number of a real edge, or -1.
  std::int32_t find_edge(const Surface& surface, std::int32_t a, std::int32_t b) const {
    const Edge edge = {std::min(a, b), std::max(a, b)};
    const auto begin = surface.edges().begin() + first_edge[edge[0]];
    const auto end = surface.edges().begin() + first_edge[edge[0] + 1];
    const auto found = std::lower_bound(begin, end, edge);
    return found != end && *found == edge ? static_cast<std::int32_t>(found - surface.edges().begin()) : -1;
  }
};

SnapGraph::SnapGraph(const Surface& surface, const Task& task) {
  auto data = std::make_shared<SnapData>();
  const std::size_t vertices = surface.vertex_count(), faces = surface.face_count();
  const std::vector<Edge>& edges = surface.edges();

  data->first_edge.assign(vertices + 1, 0);
  std::vector<std::pair<std::int32_t, std::int32_t>> pairs;
  pairs.reserve(2 * edges.size());
  const Poll listing(task, 0.0, 0.1, edges.size());
  for (std::size_t e = 0; e < edges.size(); ++e) {
    listing.at(e);
    ++data->first_edge[edges[e][0] + 1];
    for (const std::int32_t v : edges[e]) pairs.push_back({v, static_cast<std::int32_t>(e)});
  }
  std::partial_sum(data->first_edge.begin(), data->first_edge.end(), data->first_edge.begin());
  const auto rows = [&](std::size_t row_count, double begin, double end) {
    Poll poll(task, begin, end, 2 * pairs.size());
    return Csr<std::int32_t>(row_count, [&](const auto& visit) {
      for (const auto& [row, item] : pairs) {
        poll.next();
        visit(row, item);
      }
    });
  };
  data->edges_of_vertex = rows(vertices, 0.1, 0.3);

  pairs.clear();  // (face, real edge)
  std::vector<std::tuple<Edge, std::int32_t>> diagonals;
  const Poll looking(task, 0.3, 0.5, faces);
  for (std::size_t f = 0; f < faces; ++f) {
    looking.at(f);
    for (std::size_t i = 0; i < 3; ++i) {
      const std::int32_t a = surface.triangles()[f][i], b = surface.triangles()[f][(i + 1) % 3];
      if (a == b) continue;
      const std::int32_t edge = data->find_edge(surface, a, b);
      const auto face = static_cast<std::int32_t>(f);
      if (edge >= 0) {
        pairs.push_back({face, edge});
      } else {
        diagonals.push_back({{std::min(a, b), std::max(a, b)}, face});
      }
    }
  }
  Poll sorting(task, 0.5, 0.6, 32 * diagonals.size());
  std::sort(diagonals.begin(), diagonals.end(), [&](const auto& a, const auto& b) {
    sorting.next();
    return a < b;
  });
  DisjointSets joined(faces);
  const Poll joining(task, 0.6, 0.65, diagonals.size());
  for (std::size_t i = 1; i < diagonals.size(); ++i) {
    joining.at(i);
    if (std::get<0>(diagonals[i]) == std::get<0>(diagonals[i - 1])) {
      joined.join(std::get<1>(diagonals[i]), std::get<1>(diagonals[i - 1]));
    }
  }
  data->polygon_of_face.resize(faces);
  const Poll naming(task, 0.65, 0.7, faces);
  for (std::size_t f = 0; f < faces; ++f) {
    naming.at(f);
    data->polygon_of_face[f] = joined.find(static_cast<std::int32_t>(f));
  }
  for (auto& [face, edge] : pairs) face = data->polygon_of_face[face];
  data->edges_of_polygon = rows(faces, 0.7, 0.85);
  for (auto& [polygon, edge] : pairs) std::swap(polygon, edge);
  data->polygons_of_edge = rows(edges.size(), 0.85, 1.0);
  data_ = std::move(data);
}

namespace {

/// The edges that a snapped path may take, growing.
class Band {
 public:
  Band(const Surface& surface, const SnapData& graph) : surface_(surface), graph_(graph) {}

  const std::vector<std::int32_t>& edges() const { return edges_.numbers(); }

  /// Adds the parts of the mesh that the wire runs over: the polygons it crosses, and the edges it follows.
  void add(const Wire& wire) {
    for (std::size_t i = 0; i < wire.faces.size(); ++i) {
      if (wire.faces[i] >= 0) {
        add_polygon(graph_.polygon_of_face[wire.faces[i]]);
        continue;
      }
      const std::int32_t a = wire.vertices[i], b = wire.vertices[i + 1];
      const std::int32_t edge = a >= 0 && b >= 0 ? graph_.find_edge(surface_, a, b) : -1;
      if (edge >= 0) {
        add_edge(edge);
      } else {  // along the boundary of a hole that the embedding left
        if (a >= 0) add_vertex(a);
        if (b >= 0) add_vertex(b);
      }
    }
  }
  /// The polygons that share an edge with what is there.
  void add_neighbors() {
    const std::size_t before = edges().size();
    for (std::size_t i = 0; i < before; ++i) add_polygons_of(edges()[i]);
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
    if (!vertices_.insert(vertex).second) return;
    for (const std::int32_t e : graph_.edges_of_vertex[vertex]) {
      add_edge(e);
      add_polygons_of(e);
    }
  }

 private:
  void add_edge(std::int32_t edge) { edges_.insert(edge); }
  void add_polygon(std::int32_t polygon) {
    if (!polygons_.insert(polygon).second) return;
    for (const std::int32_t e : graph_.edges_of_polygon[polygon]) add_edge(e);
  }
  void add_polygons_of(std::int32_t edge) {
    for (const std::int32_t polygon : graph_.polygons_of_edge[edge]) add_polygon(polygon);
  }

  const Surface& surface_;
  const SnapData& graph_;
  InsertionMap edges_, polygons_, vertices_;
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
  BandSearch(const Surface& surface, const std::vector<std::int32_t>& edges, const Wire& wire)
      : surface_(surface),
        polyline_(wire.points),
        // Edges along the wire are for free, all but this: it decides among them by length.
        per_length_(1e-6 * wire.euclidean_length) {
    std::vector<std::pair<std::int32_t, std::int32_t>> pairs;  // (vertex, directed edge that leaves it)
    pairs.reserve(2 * edges.size());
    heads_.reserve(2 * edges.size());
    along_.reserve(edges.size());
    for (const std::int32_t e : edges) {
      const Edge& edge = surface.edges()[e];
      const std::int32_t a = vertices_.insert(edge[0]).first, b = vertices_.insert(edge[1]).first;
      const Vector vector = surface.points()[edge[1]] - surface.points()[edge[0]];
      along_.push_back({vector, vector.norm()});
      for (const auto& [tail, head] : {std::pair(a, b), std::pair(b, a)}) {
        pairs.push_back({tail, static_cast<std::int32_t>(heads_.size())});
        heads_.push_back(head);
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
    std::int32_t before = -1;  // the directed edge before it in that path; -1: none
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
      if (states_[edge].is_settled || edge == (before ^ 1)) continue;
      const double length = along_[edge / 2].length;
      const double there = distance(heads_[edge], (here + length) * (1.0 + 1e-12));
      const double least = Polyline::least_integral(length, here, there) + per_length_ * length;
      const double cost = cost_before(edge, before) + (weights_[edge / 2] < 0 ? least : weights_[edge / 2]);
      if (cost < states_[edge].cost) push(cost, edge, before);
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

std::vector<std::int32_t> closest_path(const Surface& surface, const std::vector<std::int32_t>& edges, const Wire& wire,
                                       const Task& task, double done) {
  return BandSearch(surface, edges, wire).path(wire.from, wire.to, task, done);
}

void check_wire(const Surface& surface, const Wire& wire) {
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

std::vector<std::int32_t> snap_to_edges(const Surface& surface, const SnapGraph& graph, const Wire& wire,
                                        const Task& task) {
  if (wire.points.empty()) return {};
  check_wire(surface, wire);
  const SnapData& data = *graph.data_;
  if (data.polygon_of_face.size() != surface.face_count() || data.first_edge.size() != surface.vertex_count() + 1 ||
      index(data.first_edge.back()) != surface.edges().size()) {
    throw InvalidInput("what to snap to is of another surface");
  }
  if (wire.from == wire.to) return {wire.from};
  Band band(surface, data);
  band.add(wire);
  band.add_neighbors();
  std::vector<std::int32_t> path = closest_path(surface, band.edges(), wire, task, 0.0);
  if (!path.empty()) return path;
  // Polygons whose edges are not connected (one with a hole in it), or a wire over what is no real edge.
  DisjointSets connected(surface.vertex_count());
  std::size_t joined = 0;
  band.add_vertex(wire.from);
  do {
    task.check(0.5);
    for (; joined < band.edges().size(); ++joined) {
      const Edge& edge = surface.edges()[band.edges()[joined]];
      connected.join(edge[0], edge[1]);
    }
    if (connected.find(wire.from) == connected.find(wire.to)) {
      return closest_path(surface, band.edges(), wire, task, 0.5);
    }
  } while (band.widen());
  return {};
}

}  // namespace seamwire
