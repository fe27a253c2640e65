// SPDX-License-Identifier: GPL-3.0-or-later
#include "seamwire/wires/snap.hpp"

#include <algorithm>
#include <array>
#include <functional>
#include <limits>
#include <numeric>
#include <queue>
#include <string>
#include <tuple>
#include <utility>

#include "detail/csr.hpp"
#include "detail/disjoint_sets.hpp"
#include "detail/index.hpp"
#include "detail/insertion_map.hpp"
#include "detail/poll.hpp"
#include "wires/polyline.hpp"

namespace seamwire {

struct SnapData {
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

  /// What the wire runs over: the polygons it crosses, the edges it follows.
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

/// Dijkstra's algorithm on a band. Empty where it does not connect the ends.
///
/// Nearly all of the time goes into the integrals that are the edges' costs, so an edge waits in the queue with a lower
/// bound of its cost, which the distances of its ends give, and the integral is taken when it comes out and may still
/// count.
class BandSearch {
 public:
  BandSearch(const Surface& surface, const std::vector<std::int32_t>& edges, const Wire& wire)
      : surface_(surface),
        edges_(edges),
        polyline_(wire.points),
        // Edges along the wire are for free, all but this: it decides among them by length.
        per_length_(1e-6 * wire.euclidean_length / surface.scale()) {
    std::vector<std::pair<std::int32_t, std::int32_t>> pairs;  // (vertex, edge of the band)
    pairs.reserve(2 * edges.size());
    ends_.reserve(edges.size());
    for (const std::int32_t e : edges) {
      const Edge& edge = surface.edges()[e];
      ends_.push_back({vertices_.insert(edge[0]).first, vertices_.insert(edge[1]).first});
      for (const std::int32_t v : ends_.back()) pairs.push_back({v, static_cast<std::int32_t>(ends_.size()) - 1});
    }
    edges_of_ = Csr<std::int32_t>(vertices_.numbers().size(), pairs);
  }

  std::vector<std::int32_t> path(std::int32_t from_vertex, std::int32_t to_vertex) {
    const std::int32_t from = vertices_.find(from_vertex), to = vertices_.find(to_vertex);
    if (from < 0 || to < 0) return {};
    states_.assign(vertices_.numbers().size(), {});
    weights_.assign(edges_.size(), -1.0);
    states_[from].cost = 0.0;
    push(0.0, from, -1);
    State& goal = states_[to];
    while (!queue_.empty() && !goal.is_settled) {
      const Waiting next = queue_.top();
      queue_.pop();
      State& state = states_[next.vertex];
      if (state.is_settled) continue;
      if (next.edge >= 0) {
        reach(next.vertex, next.edge);
      } else {
        settle(next.vertex);
      }
    }
    std::vector<std::int32_t> path;
    if (!goal.is_settled) return path;
    for (std::int32_t v = to; v >= 0; v = states_[v].previous) path.push_back(vertices_.numbers()[v]);
    std::reverse(path.begin(), path.end());
    return path;
  }

 private:
  struct State {
    double cost = std::numeric_limits<double>::infinity();
    double distance = -1.0;  // from the wire; negative: not known yet
    std::int32_t previous = -1;
    bool is_settled = false;
  };
  /// A vertex at its cost, or with an edge: not known to cost less by that edge.
  struct Waiting {
    double cost;
    std::int32_t number;  // the surface's, so that the order is the same whatever the band's
    std::int32_t vertex, edge;
    bool operator>(const Waiting& other) const {
      return std::tie(cost, number, edge) > std::tie(other.cost, other.number, other.edge);
    }
  };

  const Vector& point(std::int32_t vertex) const { return surface_.points()[vertices_.numbers()[vertex]]; }

  void push(double cost, std::int32_t vertex, std::int32_t edge) {
    queue_.push({cost, vertices_.numbers()[vertex], vertex, edge});
  }

  double distance(std::int32_t vertex, double bound) {
    double& known = states_[vertex].distance;
    if (known < 0) known = polyline_.distance(point(vertex), bound);
    return known;
  }

  std::int32_t other_end(std::int32_t edge, std::int32_t vertex) const {
    return ends_[edge][ends_[edge][0] == vertex ? 1 : 0];
  }

  void settle(std::int32_t vertex) {
    State& state = states_[vertex];
    state.is_settled = true;
    const double here = distance(vertex, std::numeric_limits<double>::infinity());
    for (const std::int32_t e : edges_of_[vertex]) {
      const std::int32_t other = other_end(e, vertex);
      if (states_[other].is_settled) continue;
      const double length = (point(other) - point(vertex)).norm();
      const double there = distance(other, (here + length) * (1.0 + 1e-12));
      const double least = Polyline::least_integral(length, here, there) + per_length_ * length;
      if (state.cost + least < states_[other].cost) push(state.cost + least, other, e);
    }
  }

  void reach(std::int32_t vertex, std::int32_t edge) {
    State& state = states_[vertex];
    const std::int32_t before = other_end(edge, vertex);
    double& weight = weights_[edge];
    if (weight < 0) {
      const Vector &a = point(before), &b = point(vertex);
      weight = polyline_.integral(a, b, states_[before].distance, state.distance) + per_length_ * (b - a).norm();
    }
    const double through = states_[before].cost + weight;
    if (!(through < state.cost)) return;
    state.cost = through;
    state.previous = before;
    push(through, vertex, -1);
  }

  const Surface& surface_;
  const std::vector<std::int32_t>& edges_;
  const Polyline polyline_;
  const double per_length_;
  InsertionMap vertices_;                          // of the band, which are numbered in it by their places
  std::vector<std::array<std::int32_t, 2>> ends_;  // of the band's edges
  Csr<std::int32_t> edges_of_;
  std::vector<State> states_;
  std::vector<double> weights_;  // of the band's edges; negative: not known yet
  std::priority_queue<Waiting, std::vector<Waiting>, std::greater<>> queue_;
};

std::vector<std::int32_t> closest_path(const Surface& surface, const std::vector<std::int32_t>& edges,
                                       const Wire& wire) {
  return BandSearch(surface, edges, wire).path(wire.from, wire.to);
}

void check_wire(const Surface& surface, const Wire& wire) {
  const std::string not_on_it = "the wire is not on this surface: ";
  const auto check_vertex = [&](std::int32_t v) { check_index(v, surface.vertex_count(), not_on_it + "vertex"); };
  check_vertex(wire.from);
  check_vertex(wire.to);
  if (wire.vertices.size() != wire.points.size() || wire.faces.size() + 1 != wire.points.size()) {
    throw InvalidInput("the wire has " + std::to_string(wire.points.size()) + " points, but " +
                       std::to_string(wire.vertices.size()) + " vertex numbers and " +
                       std::to_string(wire.faces.size()) + " faces");
  }
  for (const std::int32_t v : wire.vertices) {
    if (v != -1) check_vertex(v);
  }
  for (const std::int32_t f : wire.faces) {
    if (f != -1) check_index(f, surface.face_count(), not_on_it + "face", "faces");
  }
}

}  // namespace

std::vector<std::int32_t> snap_to_edges(const Surface& surface, const SnapGraph& graph, const Wire& wire) {
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
  std::vector<std::int32_t> path = closest_path(surface, band.edges(), wire);
  if (!path.empty()) return path;
  // Polygons whose edges are not connected (one with a hole in it), or a wire over what is no real edge.
  DisjointSets connected(surface.vertex_count());
  std::size_t joined = 0;
  band.add_vertex(wire.from);
  do {
    for (; joined < band.edges().size(); ++joined) {
      const Edge& edge = surface.edges()[band.edges()[joined]];
      connected.join(edge[0], edge[1]);
    }
    if (connected.find(wire.from) == connected.find(wire.to)) {
      return closest_path(surface, band.edges(), wire);
    }
  } while (band.widen());
  return {};
}

}  // namespace seamwire
