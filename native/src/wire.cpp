// SPDX-License-Identifier: GPL-3.0-or-later
#include "seamwire/wire.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <queue>
#include <span>
#include <string>
#include <tuple>
#include <unordered_set>
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

}  // namespace

Wire map_wire(const Surface& surface, const Embedding& embedding, const IntrinsicPath& path) {
  Wire wire;
  if (path.points.empty()) return wire;
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
      if (free_end && face >= 0 && wire.faces.back() == face &&
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

Wire trace_wire(const Surface& surface, const Embedding& embedding, const DistanceField& field, std::int32_t vertex) {
  if (vertex < 0 || index(vertex) >= surface.vertex_count()) {
    throw InvalidInput("vertex " + std::to_string(vertex) + " is out of range: the surface has " +
                       std::to_string(surface.vertex_count()) + " vertices");
  }
  Wire wire = map_wire(surface, embedding, field.trace(vertex));
  wire.from = field.seed();
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

/// Distance to a polyline, by a tree of boxes over its segments.
class Polyline {
 public:
  explicit Polyline(const std::vector<Vector>& points) : points_(points) { build(0, segment_count()); }

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
        for (std::size_t s = node.begin; s < node.end; ++s) best = std::min(best, squared_distance(p, s));
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

 private:
  struct Node {
    Eigen::AlignedBox3d box;
    std::size_t begin, end;
    std::int32_t left = -1, right = -1;
  };
  static constexpr std::size_t kLeaf = 4;

  std::size_t segment_count() const { return points_.size() - 1; }

  double squared_distance(const Vector& p, std::size_t segment) const {
    const Vector& a = points_[segment];
    const Vector along = points_[segment + 1] - a;
    const double length2 = along.squaredNorm();
    const double t = length2 > 0 ? std::clamp((p - a).dot(along) / length2, 0.0, 1.0) : 0.0;
    return (p - a - t * along).squaredNorm();
  }

  std::int32_t build(std::size_t begin, std::size_t end) {
    const auto number = static_cast<std::int32_t>(nodes_.size());
    Node node{.box = {}, .begin = begin, .end = end};
    for (std::size_t i = begin; i <= end; ++i) node.box.extend(points_[i]);
    nodes_.push_back(node);
    if (end - begin > kLeaf) {
      const std::size_t middle = begin + (end - begin) / 2;
      const std::int32_t left = build(begin, middle), right = build(middle, end);
      nodes_[index(number)].left = left;
      nodes_[index(number)].right = right;
    }
    return number;
  }

  const std::vector<Vector>& points_;
  std::vector<Node> nodes_;
};

/// The edges that a snapped path may take, growing.
class Band {
 public:
  Band(const Surface& surface, const SnapGraph::Data& graph) : surface_(surface), graph_(graph) {}

  const std::vector<std::int32_t>& edges() const { return edges_; }

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
    const std::vector<std::int32_t> before = edges_;
    for (const std::int32_t e : before) add_polygons_of(e);
  }
  /// All around the vertices of what is there. False where that is nothing new.
  bool widen() {
    const std::size_t n = edges_.size();
    for (; widened_ < n; ++widened_) {
      for (const std::int32_t v : surface_.edges()[index(edges_[widened_])]) add_vertex(v);
    }
    return edges_.size() > n;
  }
  void add_vertex(std::int32_t vertex) {
    if (!vertices_.insert(vertex).second) return;
    for (const std::int32_t e : graph_.edges_of_vertex[vertex]) {
      add_edge(e);
      add_polygons_of(e);
    }
  }

 private:
  void add_edge(std::int32_t edge) {
    if (seen_.insert(edge).second) edges_.push_back(edge);
  }
  void add_polygon(std::int32_t polygon) {
    if (!polygons_.insert(polygon).second) return;
    for (const std::int32_t e : graph_.edges_of_polygon[polygon]) add_edge(e);
  }
  void add_polygons_of(std::int32_t edge) {
    for (const std::int32_t polygon : graph_.polygons_of_edge[edge]) add_polygon(polygon);
  }

  const Surface& surface_;
  const SnapGraph::Data& graph_;
  std::vector<std::int32_t> edges_;
  std::size_t widened_ = 0;  // edges whose surroundings are there
  std::unordered_set<std::int32_t> seen_, polygons_, vertices_;
};

/// Integral of an edge's distance to the wire. The distance has kinks, so many points serve better than a high order.
double closeness(const Polyline& wire, const Vector& a, const Vector& b) {
  constexpr int kSamples = 8;
  const double step = (b - a).norm() / kSamples;
  double sum = 0.0, bound = std::numeric_limits<double>::infinity();
  for (int i = 0; i < kSamples; ++i) {
    const double t = (i + 0.5) / kSamples;
    const double distance = wire.distance((1.0 - t) * a + t * b, bound);
    sum += distance;
    bound = (distance + step) * (1.0 + 1e-12);  // distances change no faster than their points move
  }
  return sum * step;
}

/// Dijkstra's algorithm on a band. Empty where it does not connect the ends.
std::vector<std::int32_t> closest_path(const Surface& surface, const std::vector<std::int32_t>& edges,
                                       const Polyline& polyline, const Wire& wire) {
  // Edges along the wire are for free, all but this: it decides among them by length.
  const double per_length = 1e-6 * wire.euclidean_length / surface.scale();

  std::vector<std::int32_t> vertices;
  for (const std::int32_t e : edges) {
    const Edge& edge = surface.edges()[index(e)];
    vertices.insert(vertices.end(), edge.begin(), edge.end());
  }
  std::sort(vertices.begin(), vertices.end());
  vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
  const auto local = [&](std::int32_t vertex) {
    const auto found = std::lower_bound(vertices.begin(), vertices.end(), vertex);
    return found != vertices.end() && *found == vertex ? static_cast<std::int32_t>(found - vertices.begin()) : -1;
  };
  const std::int32_t from = local(wire.from), to = local(wire.to);
  if (from < 0 || to < 0) return {};

  std::vector<std::array<std::int32_t, 2>> ends, pairs;  // local numbers; (vertex, edge of the band)
  for (const std::int32_t e : edges) {
    const Edge& edge = surface.edges()[index(e)];
    ends.push_back({local(edge[0]), local(edge[1])});
    for (const std::int32_t v : ends.back()) pairs.push_back({v, static_cast<std::int32_t>(ends.size()) - 1});
  }
  const Lists edges_of(vertices.size(), pairs);

  struct Reached {
    double cost;
    std::int32_t vertex;
    bool operator>(const Reached& other) const { return std::tie(cost, vertex) > std::tie(other.cost, other.vertex); }
  };
  std::vector<double> weights(edges.size(), -1.0);  // computed where needed
  std::vector<double> costs(vertices.size(), std::numeric_limits<double>::infinity());
  std::vector<std::int32_t> previous(vertices.size(), -1);
  std::priority_queue<Reached, std::vector<Reached>, std::greater<>> queue;
  costs[index(from)] = 0.0;
  queue.push({0.0, from});
  while (!queue.empty()) {
    const auto [cost, vertex] = queue.top();
    queue.pop();
    if (cost > costs[index(vertex)]) continue;
    if (vertex == to) break;
    for (const std::int32_t e : edges_of[vertex]) {
      if (weights[index(e)] < 0) {
        const Edge& edge = surface.edges()[index(edges[index(e)])];
        const Vector &a = surface.points()[index(edge[0])], &b = surface.points()[index(edge[1])];
        weights[index(e)] = closeness(polyline, a, b) + per_length * (b - a).norm();
      }
      const std::int32_t other = ends[index(e)][ends[index(e)][0] == vertex ? 1 : 0];
      const double through = cost + weights[index(e)];
      if (through < costs[index(other)]) {
        costs[index(other)] = through;
        previous[index(other)] = vertex;
        queue.push({through, other});
      }
    }
  }
  std::vector<std::int32_t> path;
  if (std::isinf(costs[index(to)])) return path;
  for (std::int32_t v = to; v >= 0; v = previous[index(v)]) path.push_back(vertices[index(v)]);
  std::reverse(path.begin(), path.end());
  return path;
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
  if (wire.from == wire.to) return {wire.from};
  const Polyline polyline(wire.points);
  Band band(surface, graph.data());
  band.add(wire);
  band.add_neighbours();
  std::vector<std::int32_t> path = closest_path(surface, band.edges(), polyline, wire);
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
      return closest_path(surface, band.edges(), polyline, wire);
    }
  } while (band.widen());
  return {};
}

}  // namespace seamwire
