// SPDX-License-Identifier: GPL-3.0-or-later
//
// The real edges around each vertex. The turn from one to another is the discrete geodesic curvature of Polthier and
// Schmies, "Straightest Geodesics on Polyhedral Surfaces" (1998).
#include "edges/edge_adjacency.hpp"

#include <cmath>
#include <numbers>
#include <string>
#include <unordered_set>

namespace seamwire {

namespace {

// Steps between two looks at the task: well under a millisecond.
constexpr std::size_t kPatience = 1024;

}  // namespace

EdgeFans::EdgeFans(const Surface& surface, const Task& task) {
  const std::vector<Edge>& edges = surface.edges();
  first_.assign(surface.vertex_count() + 1, 0);
  for (const auto& [a, b] : edges) {
    ++first_[at(a) + 1];
    ++first_[at(b) + 1];
  }
  for (std::size_t v = 1; v < first_.size(); ++v) first_[v] += first_[v - 1];
  head_.resize(2 * edges.size());
  twin_.resize(2 * edges.size());
  directions_.resize(2 * edges.size());
  opposite_.assign(2 * edges.size(), -1);
  rims_.assign(surface.vertex_count(), {-1, -1});
  is_open_.assign(surface.vertex_count(), false);
  std::vector<std::int32_t> next(first_.begin(), first_.end() - 1);
  for (const auto& [a, b] : edges) {  // sorted, so each row is
    const std::int32_t there = next[at(a)]++, back = next[at(b)]++;
    head_[at(there)] = b;
    head_[at(back)] = a;
    twin_[at(there)] = back;
    twin_[at(back)] = there;
  }

  const std::vector<std::int32_t>& vertex_of_fan = surface.vertex_of_fan();
  std::vector<std::int32_t> fans(surface.vertex_count(), 0);
  for (const std::int32_t v : vertex_of_fan) ++fans[at(v)];
  const std::size_t total = surface.vertex_count() + vertex_of_fan.size();
  std::size_t count = 0;
  const auto look = [&] {
    if (++count % kPatience == 0) task.check(static_cast<double>(count) / static_cast<double>(total));
  };
  for (std::int32_t v = 0; v < vertex_count(); ++v, look()) {
    if (fans[at(v)] != 1) set_directions_in_space(surface, v);
  }
  for (const auto fan : surface.half_edges().vertices()) {
    if (fans[at(vertex_of_fan[at(fan.idx())])] == 1) set_fan(surface, fan);
    look();
  }
}

void EdgeFans::set_fan(const Surface& surface, HalfEdgeMesh::VertexHandle fan) {
  const HalfEdgeMesh& mesh = surface.half_edges();
  const std::vector<std::int32_t>& vertex_of_fan = surface.vertex_of_fan();
  const std::int32_t v = vertex_of_fan[at(fan.idx())];
  const auto neighbor = [&](HalfEdgeMesh::HalfedgeHandle h) {
    return vertex_of_fan[at(mesh.to_vertex_handle(h).idx())];
  };
  const auto spoke = [&](HalfEdgeMesh::HalfedgeHandle h) -> Vector {
    return surface.scale() * (surface.points()[at(neighbor(h))] - surface.points()[at(v)]);
  };

  HalfEdgeMesh::HalfedgeHandle start = mesh.halfedge_handle(fan);
  if (!start.is_valid()) return set_directions_in_space(surface, v);
  bool open = false;
  for (auto h = start; !open;) {  // backwards, to the fan's first edge if it has one
    const auto opposite = mesh.opposite_halfedge_handle(h);
    if (mesh.is_boundary(opposite)) {
      open = true;
      start = h;
    } else if ((h = mesh.next_halfedge_handle(opposite)) == start) {
      break;
    }
  }

  std::vector<Spoke> spokes;  // of real edges; diagonals of polygons only add their angles
  std::int32_t first_edge = -1, last_edge = -1;
  double total = 0.0;
  for (auto h = start;;) {
    last_edge = find(v, neighbor(h));
    if (h == start) first_edge = last_edge;
    if (last_edge >= 0) spokes.push_back({last_edge, total, false});
    if (mesh.is_boundary(h)) break;
    const auto before = mesh.next_halfedge_handle(mesh.next_halfedge_handle(h));
    const auto following = mesh.opposite_halfedge_handle(before);
    const Vector p = spoke(h), r = spoke(following);
    total += std::atan2(p.cross(r).norm(), p.dot(r));
    if (last_edge >= 0 && find(v, neighbor(following)) >= 0) {
      spokes.back().triangle = find(neighbor(h), neighbor(following)) >= 0;
    }
    h = following;
    if (h == start) break;
  }

  // A fan that holds one of the edges twice (it was cut open there) or not at all (a loose one) is broken as well.
  std::vector<std::int32_t> distinct(spokes.size());
  std::ranges::transform(spokes, distinct.begin(), &Spoke::edge);
  std::ranges::sort(distinct);
  const bool twice = std::ranges::adjacent_find(distinct) != distinct.end();
  if (twice || distinct.size() != at(end(v) - begin(v)) || !(total > 0.0)) return set_directions_in_space(surface, v);

  const double scale = open ? 1.0 : 2.0 * std::numbers::pi / total;
  for (const auto& [edge, angle, triangle] : spokes) {
    directions_[at(edge)] = {std::cos(scale * angle), std::sin(scale * angle), 0.0};
  }
  if (!open) return set_opposites(spokes);
  rims_[at(v)] = {first_edge, last_edge};
  is_open_[at(v)] = true;
  if (first_edge >= 0 && last_edge >= 0) {
    directions_[at(first_edge)].z = std::sqrt(std::max(0.0, 1.0 + std::cos(total)));
    directions_[at(last_edge)].z = -directions_[at(first_edge)].z;
    if (spokes.size() > 2) {  // else it is the corner of a single face
      opposite_[at(first_edge)] = last_edge;
      opposite_[at(last_edge)] = first_edge;
    }
  }
}

void EdgeFans::set_opposites(const std::vector<Spoke>& spokes) {
  const bool only_triangles = std::ranges::all_of(spokes, &Spoke::triangle);
  const std::size_t n = spokes.size();
  if (n != (only_triangles ? 6U : 4U)) return;
  for (std::size_t i = 0; i < n; ++i) opposite_[at(spokes[i].edge)] = spokes[(i + n / 2) % n].edge;
}

void EdgeFans::set_directions_in_space(const Surface& surface, std::int32_t v) {
  const Vector& from = surface.points()[at(v)];
  for (std::int32_t e = begin(v); e < end(v); ++e) {
    // Zero for an edge of length zero: it has no direction, and every turn there counts as a right angle.
    const Vector direction = (surface.scale() * (surface.points()[at(head(e))] - from)).stableNormalized();
    directions_[at(e)] = {direction.x(), direction.y(), direction.z()};
  }
}

std::int32_t EdgeFans::find(std::int32_t a, std::int32_t b) const {
  const auto row_begin = head_.begin() + begin(a), row_end = head_.begin() + end(a);
  const auto it = std::lower_bound(row_begin, row_end, b);
  return it != row_end && *it == b ? static_cast<std::int32_t>(it - head_.begin()) : -1;
}

std::shared_ptr<const EdgeFans> make_edge_fans(const Surface& surface, const Task& task) {
  return std::make_shared<const EdgeFans>(surface, task);
}

namespace {

std::int32_t find_edge(const EdgeFans& fans, const Edge& edge) {
  const auto is_vertex = [&](std::int32_t v) { return v >= 0 && v < fans.vertex_count(); };
  const std::int32_t e = is_vertex(edge[0]) && is_vertex(edge[1]) ? fans.find(edge[0], edge[1]) : -1;
  if (e >= 0) return e;
  throw InvalidInput("there is no edge between the vertices " + std::to_string(edge[0]) + " and " +
                     std::to_string(edge[1]));
}

}  // namespace

std::vector<std::int32_t> run_on(const EdgeFans& fans, const Edge& edge, std::span<const std::int32_t> stops) {
  // 1 - cos 60 degrees, a little less: a vertex of three equal angles offers two ways of 60 degrees and no way on.
  constexpr double kMostTurn = 0.5 - 1e-9;
  std::int32_t e = find_edge(fans, edge);
  const std::unordered_set<std::int32_t> stop_at(stops.begin(), stops.end());
  std::unordered_set<std::int32_t> visited{edge[0], edge[1]};
  std::vector<std::int32_t> chain{edge[1]};
  for (std::int32_t v = edge[1];;) {
    const std::int32_t back = fans.twin(e);
    if (fans.is_open(v) && !fans.is_rim(back, v)) break;
    std::int32_t best = -1;
    double least = kMostTurn;
    for (std::int32_t out = fans.begin(v); out < fans.end(v); ++out) {
      if (out == back) continue;
      const double turn = fans.turn(back, out);
      if (turn < least) {
        least = turn;
        best = out;
      }
    }
    if (best < 0) break;
    e = best;
    v = fans.head(e);
    chain.push_back(v);
    if (stop_at.contains(v) || !visited.insert(v).second) break;
  }
  return chain;
}

EdgeStrip edge_strip(const EdgeFans& fans, const Edge& edge, std::span<const std::int32_t> stops) {
  const std::int32_t start = find_edge(fans, edge);
  const std::unordered_set<std::int32_t> stop_at(stops.begin(), stops.end());
  std::unordered_set<std::int32_t> visited{edge[0], edge[1]};
  // On from the head of a directed edge; whether the way comes round to the edge that it started from.
  const auto walk = [&](std::int32_t e, std::vector<std::int32_t>& way) {
    while (!stop_at.contains(fans.head(e))) {
      e = fans.opposite(fans.twin(e));
      if (e < 0) break;
      way.push_back(fans.head(e));
      if (!visited.insert(way.back()).second) return fans.opposite(fans.twin(e)) == start;
    }
    return false;
  };

  std::vector<std::int32_t> ahead{edge[1]}, behind{edge[0]};
  if (!walk(start, ahead)) walk(fans.twin(start), behind);
  EdgeStrip strip{{behind.rbegin(), behind.rend()}};
  strip.vertices.insert(strip.vertices.end(), ahead.begin(), ahead.end());
  // Not where both ends cross the strip at one of its inner vertices.
  strip.closed = strip.vertices.front() == strip.vertices.back() &&
                 std::ranges::count(strip.vertices, strip.vertices.front()) == 2;
  if (strip.closed) strip.vertices.pop_back();
  return strip;
}

}  // namespace seamwire
