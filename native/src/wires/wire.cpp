// SPDX-License-Identifier: GPL-3.0-or-later
#include "seamwire/wires/wire.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <numeric>
#include <queue>
#include <span>
#include <string>
#include <tuple>
#include <utility>

namespace seamwire {

namespace {

std::size_t index(std::int32_t i) { return static_cast<std::size_t>(i); }

/// Sine of the largest angle between pieces of one line. What is left out changes the length by its square, which is
/// nothing in double precision.
constexpr double kCollinear = 1e-11;

Vector position(const Embedding& embedding, const PathPoint& point) {
  if (point.half_edge < 0) return embedding.points[index(point.vertex)];
  const Vector& tail = embedding.points[index(embedding.mesh.tail(point.half_edge))];
  const Vector& tip = embedding.points[index(embedding.mesh.tip(point.half_edge))];
  return (1.0 - point.t) * tail + point.t * tip;
}

bool straight(const Vector& a, const Vector& b, const Vector& c) {
  const Vector u = b - a, v = c - b;
  return u.dot(v) > 0 && u.cross(v).norm() <= kCollinear * u.norm() * v.norm();
}

void check_embedding(const Surface& surface, const Embedding& embedding) {
  const std::size_t vertices = surface.vertex_count();
  if (embedding.points.size() < vertices ||
      (vertices > 0 && (embedding.points.front() != surface.points().front() ||
                        embedding.points[vertices - 1] != surface.points().back()))) {
    throw InvalidInput("the embedding is of another surface");
  }
}

void check_path(const Surface& surface, const Embedding& embedding, const IntrinsicPath& path) {
  const auto check = [](bool is_there) {
    if (!is_there) throw InvalidInput("the path is of another embedding");
  };
  check(path.faces.size() + 1 == path.points.size());
  for (const PathPoint& point : path.points) {
    if (point.half_edge < 0) {
      check(point.vertex >= 0 && index(point.vertex) < embedding.points.size());
    } else {
      check(index(point.half_edge / 3) < embedding.source_face.size());
    }
  }
  for (const std::int32_t face : path.faces) {
    if (face < 0) continue;
    check(index(face) < embedding.source_face.size());
    check(index(embedding.source_face[index(face)]) < surface.face_count());
  }
}

}  // namespace

Wire map_wire(const Surface& surface, const Embedding& embedding, const IntrinsicPath& path) {
  Wire wire;
  check_embedding(surface, embedding);
  if (path.points.empty()) return wire;
  check_path(surface, embedding, path);
  wire.length = path.length;
  for (std::size_t i = 0; i < path.points.size(); ++i) {
    const PathPoint& at = path.points[i];
    const Vector point = position(embedding, at);
    const bool is_callers = at.half_edge < 0 && index(at.vertex) < surface.vertex_count();
    const std::int32_t vertex = is_callers ? at.vertex : -1;
    if (i > 0) {
      const std::int32_t refined = path.faces[i - 1];
      const std::int32_t face = refined < 0 ? -1 : embedding.source_face[index(refined)];
      const bool free_end = wire.vertices.back() < 0;  // not one of the caller's vertices, so it may go
      if (point == wire.points.back() && (free_end || vertex < 0)) {
        if (free_end) wire.vertices.back() = vertex;
        continue;
      }
      const std::size_t n = wire.points.size();
      if (n > 1 && free_end && face >= 0 && wire.faces.back() == face &&
          straight(wire.points[n - 2], wire.points[n - 1], point)) {
        wire.points.back() = point;
        wire.vertices.back() = vertex;
        continue;
      }
      wire.faces.push_back(face);
    }
    wire.points.push_back(point);
    wire.vertices.push_back(vertex);
  }
  wire.from = wire.vertices.front();
  wire.to = wire.vertices.back();
  wire.euclidean_length = 0.0;
  for (std::size_t i = 1; i < wire.points.size(); ++i) {
    wire.euclidean_length += (wire.points[i] - wire.points[i - 1]).norm() * surface.scale();
  }
  return wire;
}

Wire trace_wire(const Surface& surface, const Embedding& embedding, const DistanceField& field, std::int32_t vertex,
                const Task& task) {
  if (vertex < 0 || index(vertex) >= surface.vertex_count()) {
    throw InvalidInput("vertex " + std::to_string(vertex) + " is out of range: the surface has " +
                       std::to_string(surface.vertex_count()) + " vertices");
  }
  if (field.distances().size() != embedding.points.size()) {
    throw InvalidInput("the field is of another embedding: it has " + std::to_string(field.distances().size()) +
                       " vertices, the embedding " + std::to_string(embedding.points.size()));
  }
  Wire wire = map_wire(surface, embedding, field.trace(vertex, task));
  wire.from = index(field.seed()) < surface.vertex_count() ? field.seed() : -1;
  wire.to = vertex;
  return wire;
}

// ---------------------------------------------------------------------------------------------------------------------
// Snapping

namespace {

/// Lists of numbers, one for each of the keys 0, 1, ...
struct Lists {
  std::vector<std::int32_t> offsets, values;

  /// From (key, value) pairs; the order of pairs is kept in each list.
  Lists(std::size_t keys, const std::vector<std::array<std::int32_t, 2>>& pairs)
      : offsets(keys + 1, 0), values(pairs.size()) {
    for (const auto& [key, value] : pairs) ++offsets[index(key) + 1];
    std::partial_sum(offsets.begin(), offsets.end(), offsets.begin());
    std::vector<std::int32_t> next(offsets.begin(), offsets.end() - 1);
    for (const auto& [key, value] : pairs) values[index(next[index(key)]++)] = value;
  }
  Lists() = default;

  std::span<const std::int32_t> operator[](std::int32_t key) const {
    const auto begin = index(offsets[index(key)]), end = index(offsets[index(key) + 1]);
    return std::span(values).subspan(begin, end - begin);
  }
};

/// Sets of the numbers below `count`, at first of one each.
class DisjointSets {
 public:
  explicit DisjointSets(std::size_t count) : parent_(count) { std::iota(parent_.begin(), parent_.end(), 0); }
  std::int32_t find(std::int32_t i) {
    while (parent_[index(i)] != i) i = parent_[index(i)] = parent_[index(parent_[index(i)])];
    return i;
  }
  void join(std::int32_t a, std::int32_t b) { parent_[index(find(a))] = find(b); }

 private:
  std::vector<std::int32_t> parent_;
};

}  // namespace

struct SnapGraph::Data {
  std::vector<std::int32_t> polygon_of_face;
  Lists edges_of_polygon;  // numbers of Surface::edges()
  Lists polygons_of_edge;
  Lists edges_of_vertex;
  std::vector<std::int32_t> first_edge;  // per vertex: its first edge in Surface::edges() as the smaller of the two

  /// The number of a real edge, or -1.
  std::int32_t find_edge(const Surface& surface, std::int32_t a, std::int32_t b) const {
    const Edge edge = {std::min(a, b), std::max(a, b)};
    const auto begin = surface.edges().begin() + first_edge[index(edge[0])];
    const auto end = surface.edges().begin() + first_edge[index(edge[0]) + 1];
    const auto found = std::lower_bound(begin, end, edge);
    return found != end && *found == edge ? static_cast<std::int32_t>(found - surface.edges().begin()) : -1;
  }
};

SnapGraph::SnapGraph(const Surface& surface) {
  auto data = std::make_shared<Data>();
  const std::size_t vertices = surface.vertex_count(), faces = surface.face_count();
  const std::vector<Edge>& edges = surface.edges();

  data->first_edge.assign(vertices + 1, 0);
  std::vector<std::array<std::int32_t, 2>> pairs;
  pairs.reserve(2 * edges.size());
  for (std::size_t e = 0; e < edges.size(); ++e) {
    ++data->first_edge[index(edges[e][0]) + 1];
    for (const std::int32_t v : edges[e]) pairs.push_back({v, static_cast<std::int32_t>(e)});
  }
  std::partial_sum(data->first_edge.begin(), data->first_edge.end(), data->first_edge.begin());
  data->edges_of_vertex = Lists(vertices, pairs);

  pairs.clear();  // (face, real edge)
  std::vector<std::tuple<Edge, std::int32_t>> diagonals;
  for (std::size_t f = 0; f < faces; ++f) {
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
  std::sort(diagonals.begin(), diagonals.end());
  DisjointSets joined(faces);
  for (std::size_t i = 1; i < diagonals.size(); ++i) {
    if (std::get<0>(diagonals[i]) == std::get<0>(diagonals[i - 1])) {
      joined.join(std::get<1>(diagonals[i]), std::get<1>(diagonals[i - 1]));
    }
  }
  data->polygon_of_face.resize(faces);
  for (std::size_t f = 0; f < faces; ++f) data->polygon_of_face[f] = joined.find(static_cast<std::int32_t>(f));
  for (auto& [face, edge] : pairs) face = data->polygon_of_face[index(face)];
  data->edges_of_polygon = Lists(faces, pairs);
  for (auto& [polygon, edge] : pairs) std::swap(polygon, edge);
  data->polygons_of_edge = Lists(edges.size(), pairs);
  data_ = std::move(data);
}

namespace {

/// Numbers, each with its place in the order in which they came. An open hash table: the nodes of std::unordered_map
/// would take longer than all the rest of finding a band.
class Numbering {
 public:
  /// The number's place, and whether it is new.
  std::pair<std::int32_t, bool> insert(std::int32_t number) {
    if (2 * (numbers_.size() + 1) > table_.size()) grow();
    std::int32_t& slot = slot_of(number);
    if (slot >= 0) return {slot, false};
    slot = static_cast<std::int32_t>(numbers_.size());
    numbers_.push_back(number);
    return {slot, true};
  }
  /// The number's place, or -1.
  std::int32_t find(std::int32_t number) const { return table_.empty() ? -1 : table_[slot_index(number)]; }
  const std::vector<std::int32_t>& numbers() const { return numbers_; }

 private:
  std::size_t slot_index(std::int32_t number) const {
    const std::size_t mask = table_.size() - 1;
    std::size_t at = (index(number) * 0x9E3779B97F4A7C15ull >> 32) & mask;
    while (table_[at] >= 0 && numbers_[index(table_[at])] != number) at = (at + 1) & mask;
    return at;
  }
  std::int32_t& slot_of(std::int32_t number) { return table_[slot_index(number)]; }
  void grow() {
    table_.assign(std::max<std::size_t>(64, 4 * table_.size()), -1);
    for (std::size_t i = 0; i < numbers_.size(); ++i) slot_of(numbers_[i]) = static_cast<std::int32_t>(i);
  }

  std::vector<std::int32_t> numbers_, table_;  // of the table the size is a power of two, half of it free at the least
};

/// Distance to a polyline, by a tree of boxes over its segments.
class Polyline {
 public:
  /// In which an edge's distance is integrated. The distance has kinks, so many points serve better than a high order.
  static constexpr std::size_t kSamples = 8;

  explicit Polyline(const std::vector<Vector>& points) {
    segments_.reserve(points.size());
    for (std::size_t i = 0; i + 1 < points.size(); ++i) {
      const Vector along = points[i + 1] - points[i];
      const double length2 = along.squaredNorm();
      segments_.push_back({points[i], along, length2 > 0 ? 1.0 / length2 : 0.0});
    }
    build(points, 0, segments_.size());
  }

  /// Distance from p, which is known to be at most `bound`.
  double distance(const Vector& p, double bound) const {
    double best = bound * bound;
    std::array<std::int32_t, 64> stack;  // the tree is balanced: 64 levels hold any number of segments
    std::size_t size = 0;
    stack[size++] = 0;
    while (size > 0) {
      const Node& node = nodes_[index(stack[--size])];
      if (node.box.squaredExteriorDistance(p) > best) continue;
      if (node.left < 0) {
        for (std::size_t s = node.begin; s < node.end; ++s) best = std::min(best, squared_distance(p, segments_[s]));
        continue;
      }
      const std::int32_t left = node.left, right = node.right;
      const bool left_first =
          nodes_[index(left)].box.squaredExteriorDistance(p) <= nodes_[index(right)].box.squaredExteriorDistance(p);
      stack[size++] = left_first ? right : left;
      stack[size++] = left_first ? left : right;
    }
    return std::sqrt(best);
  }

  /// Integral of the distance along the edge from a to b, at which it is `at_a` and `at_b`.
  double integral(const Vector& a, const Vector& b, double at_a, double at_b) const {
    std::array<double, kSamples> x, y, z, best;
    for (std::size_t i = 0; i < kSamples; ++i) {
      const double t = fraction(i);
      x[i] = (1.0 - t) * a.x() + t * b.x();
      y[i] = (1.0 - t) * a.y() + t * b.y();
      z[i] = (1.0 - t) * a.z() + t * b.z();
      best[i] = std::numeric_limits<double>::infinity();
    }
    // Distances change no faster than their points move, so none on the edge is more than this.
    const double length = (b - a).norm(), most = 0.5 * (at_a + at_b + length) * kRoom;
    Eigen::AlignedBox3d reach(a.cwiseMin(b).array() - most, a.cwiseMax(b).array() + most);
    std::array<std::int32_t, 64> stack;
    std::size_t size = 0;
    stack[size++] = 0;
    while (size > 0) {
      const Node& node = nodes_[index(stack[--size])];
      if (!reach.intersects(node.box)) continue;
      if (node.left >= 0) {
        stack[size++] = node.left;
        stack[size++] = node.right;
        continue;
      }
      for (std::size_t s = node.begin; s < node.end; ++s) {
        const auto& [from, along, per_length2] = segments_[s];
        for (std::size_t i = 0; i < kSamples; ++i) {  // a loop that compilers make vectors of
          const double px = x[i] - from.x(), py = y[i] - from.y(), pz = z[i] - from.z();
          double t = (px * along.x() + py * along.y() + pz * along.z()) * per_length2;
          t = t < 0.0 ? 0.0 : t;
          t = t > 1.0 ? 1.0 : t;
          const double dx = px - t * along.x(), dy = py - t * along.y(), dz = pz - t * along.z();
          const double squared = dx * dx + dy * dy + dz * dz;
          best[i] = squared < best[i] ? squared : best[i];
        }
      }
    }
    double sum = 0.0;
    for (const double squared : best) sum += std::sqrt(squared);
    return sum * length / kSamples;
  }

  /// No more than integral() of an edge of that length.
  static double least_integral(double length, double at_a, double at_b) {
    double sum = 0.0;
    for (std::size_t i = 0; i < kSamples; ++i) {
      const double t = fraction(i) * length;
      sum += std::max({0.0, at_a - t, at_b - (length - t)});
    }
    return sum * length / kSamples / kRoom;
  }

 private:
  struct Segment {
    Vector from, along;
    double per_length2;  // 0: it is a point
  };
  struct Node {
    Eigen::AlignedBox3d box;
    std::size_t begin, end;
    std::int32_t left = -1, right = -1;
  };
  static constexpr std::size_t kLeaf = 4;
  static constexpr double kRoom = 1.0 + 1e-9;  // much more than distances are rounded by

  static double fraction(std::size_t sample) { return (static_cast<double>(sample) + 0.5) / kSamples; }

  static double squared_distance(const Vector& p, const Segment& s) {
    const double t = std::clamp((p - s.from).dot(s.along) * s.per_length2, 0.0, 1.0);
    return (p - s.from - t * s.along).squaredNorm();
  }

  std::int32_t build(const std::vector<Vector>& points, std::size_t begin, std::size_t end) {
    const auto number = static_cast<std::int32_t>(nodes_.size());
    Node node{.box = {}, .begin = begin, .end = end};
    for (std::size_t i = begin; i <= end; ++i) node.box.extend(points[i]);
    nodes_.push_back(node);
    if (end - begin > kLeaf) {
      const std::size_t middle = begin + (end - begin) / 2;
      const std::int32_t left = build(points, begin, middle), right = build(points, middle, end);
      nodes_[index(number)].left = left;
      nodes_[index(number)].right = right;
    }
    return number;
  }

  std::vector<Segment> segments_;
  std::vector<Node> nodes_;
};

/// The edges that a snapped path may take, growing.
class Band {
 public:
  Band(const Surface& surface, const SnapGraph::Data& graph) : surface_(surface), graph_(graph) {}

  const std::vector<std::int32_t>& edges() const { return edges_.numbers(); }

  /// What the wire runs over: the polygons it crosses, the edges it follows.
  void add(const Wire& wire) {
    for (std::size_t i = 0; i < wire.faces.size(); ++i) {
      if (wire.faces[i] >= 0) {
        add_polygon(graph_.polygon_of_face[index(wire.faces[i])]);
        continue;
      }
      const std::int32_t a = wire.vertices[i], b = wire.vertices[i + 1];
      const std::int32_t edge = a >= 0 && b >= 0 ? graph_.find_edge(surface_, a, b) : -1;
      if (edge >= 0) {
        add_edge(edge);
      } else {  // along the rim of a hole that the embedding left
        if (a >= 0) add_vertex(a);
        if (b >= 0) add_vertex(b);
      }
    }
  }
  /// The polygons that share an edge with what is there.
  void add_neighbours() {
    const std::size_t before = edges().size();
    for (std::size_t i = 0; i < before; ++i) add_polygons_of(edges()[i]);
  }
  /// All around the vertices of what is there. False where that is nothing new.
  bool widen() {
    const std::size_t n = edges().size();
    for (; widened_ < n; ++widened_) {
      for (const std::int32_t v : surface_.edges()[index(edges()[widened_])]) add_vertex(v);
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
  const SnapGraph::Data& graph_;
  Numbering edges_, polygons_, vertices_;
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
    std::vector<std::array<std::int32_t, 2>> pairs;  // (vertex, edge of the band)
    pairs.reserve(2 * edges.size());
    ends_.reserve(edges.size());
    for (const std::int32_t e : edges) {
      const Edge& edge = surface.edges()[index(e)];
      ends_.push_back({vertices_.insert(edge[0]).first, vertices_.insert(edge[1]).first});
      for (const std::int32_t v : ends_.back()) pairs.push_back({v, static_cast<std::int32_t>(ends_.size()) - 1});
    }
    edges_of_ = Lists(vertices_.numbers().size(), pairs);
  }

  std::vector<std::int32_t> path(std::int32_t from_vertex, std::int32_t to_vertex) {
    const std::int32_t from = vertices_.find(from_vertex), to = vertices_.find(to_vertex);
    if (from < 0 || to < 0) return {};
    states_.assign(vertices_.numbers().size(), {});
    weights_.assign(edges_.size(), -1.0);
    states_[index(from)].cost = 0.0;
    push(0.0, from, -1);
    State& goal = states_[index(to)];
    while (!queue_.empty() && !goal.is_settled) {
      const Waiting next = queue_.top();
      queue_.pop();
      State& state = states_[index(next.vertex)];
      if (state.is_settled) continue;
      if (next.edge >= 0) {
        reach(next.vertex, next.edge);
      } else {
        settle(next.vertex);
      }
    }
    std::vector<std::int32_t> path;
    if (!goal.is_settled) return path;
    for (std::int32_t v = to; v >= 0; v = states_[index(v)].previous) path.push_back(vertices_.numbers()[index(v)]);
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

  const Vector& point(std::int32_t vertex) const {
    return surface_.points()[index(vertices_.numbers()[index(vertex)])];
  }

  void push(double cost, std::int32_t vertex, std::int32_t edge) {
    queue_.push({cost, vertices_.numbers()[index(vertex)], vertex, edge});
  }

  double distance(std::int32_t vertex, double bound) {
    double& known = states_[index(vertex)].distance;
    if (known < 0) known = polyline_.distance(point(vertex), bound);
    return known;
  }

  std::int32_t other_end(std::int32_t edge, std::int32_t vertex) const {
    return ends_[index(edge)][ends_[index(edge)][0] == vertex ? 1 : 0];
  }

  void settle(std::int32_t vertex) {
    State& state = states_[index(vertex)];
    state.is_settled = true;
    const double here = distance(vertex, std::numeric_limits<double>::infinity());
    for (const std::int32_t e : edges_of_[vertex]) {
      const std::int32_t other = other_end(e, vertex);
      if (states_[index(other)].is_settled) continue;
      const double length = (point(other) - point(vertex)).norm();
      const double there = distance(other, (here + length) * (1.0 + 1e-12));
      const double least = Polyline::least_integral(length, here, there) + per_length_ * length;
      if (state.cost + least < states_[index(other)].cost) push(state.cost + least, other, e);
    }
  }

  void reach(std::int32_t vertex, std::int32_t edge) {
    State& state = states_[index(vertex)];
    const std::int32_t before = other_end(edge, vertex);
    double& weight = weights_[index(edge)];
    if (weight < 0) {
      const Vector &a = point(before), &b = point(vertex);
      weight = polyline_.integral(a, b, states_[index(before)].distance, state.distance) + per_length_ * (b - a).norm();
    }
    const double through = states_[index(before)].cost + weight;
    if (!(through < state.cost)) return;
    state.cost = through;
    state.previous = before;
    push(through, vertex, -1);
  }

  const Surface& surface_;
  const std::vector<std::int32_t>& edges_;
  const Polyline polyline_;
  const double per_length_;
  Numbering vertices_;                             // of the band, which are numbered in it by their places
  std::vector<std::array<std::int32_t, 2>> ends_;  // of the band's edges
  Lists edges_of_;
  std::vector<State> states_;
  std::vector<double> weights_;  // of the band's edges; negative: not known yet
  std::priority_queue<Waiting, std::vector<Waiting>, std::greater<>> queue_;
};

std::vector<std::int32_t> closest_path(const Surface& surface, const std::vector<std::int32_t>& edges,
                                       const Wire& wire) {
  return BandSearch(surface, edges, wire).path(wire.from, wire.to);
}

void check_wire(const Surface& surface, const Wire& wire) {
  const auto fail = [](const char* what, std::int32_t number) {
    throw InvalidInput(std::string("the wire is not on this surface, which has no ") + what + " " +
                       std::to_string(number));
  };
  const auto is_vertex = [&](std::int32_t v) { return v >= 0 && index(v) < surface.vertex_count(); };
  if (!is_vertex(wire.from)) fail("vertex", wire.from);
  if (!is_vertex(wire.to)) fail("vertex", wire.to);
  if (wire.vertices.size() != wire.points.size() || wire.faces.size() + 1 != wire.points.size()) {
    throw InvalidInput("the wire has " + std::to_string(wire.points.size()) + " points, but " +
                       std::to_string(wire.vertices.size()) + " vertex numbers and " +
                       std::to_string(wire.faces.size()) + " faces");
  }
  for (const std::int32_t v : wire.vertices) {
    if (v != -1 && !is_vertex(v)) fail("vertex", v);
  }
  for (const std::int32_t f : wire.faces) {
    if (f < -1 || (f >= 0 && index(f) >= surface.face_count())) fail("face", f);
  }
}

}  // namespace

std::vector<std::int32_t> snap_to_edges(const Surface& surface, const SnapGraph& graph, const Wire& wire) {
  if (wire.points.empty()) return {};
  check_wire(surface, wire);
  if (graph.data().polygon_of_face.size() != surface.face_count() ||
      graph.data().first_edge.size() != surface.vertex_count() + 1 ||
      index(graph.data().first_edge.back()) != surface.edges().size()) {
    throw InvalidInput("what to snap to is of another surface");
  }
  if (wire.from == wire.to) return {wire.from};
  Band band(surface, graph.data());
  band.add(wire);
  band.add_neighbours();
  std::vector<std::int32_t> path = closest_path(surface, band.edges(), wire);
  if (!path.empty()) return path;
  // Polygons whose edges are not connected (one with a hole in it), or a wire over what is no real edge.
  DisjointSets connected(surface.vertex_count());
  std::size_t joined = 0;
  band.add_vertex(wire.from);
  do {
    for (; joined < band.edges().size(); ++joined) {
      const Edge& edge = surface.edges()[index(band.edges()[joined])];
      connected.join(edge[0], edge[1]);
    }
    if (connected.find(wire.from) == connected.find(wire.to)) {
      return closest_path(surface, band.edges(), wire);
    }
  } while (band.widen());
  return {};
}

}  // namespace seamwire
