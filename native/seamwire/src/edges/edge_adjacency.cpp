// SPDX-License-Identifier: GPL-3.0-or-later
//
// The real edges around each vertex. The turn from one to another is the discrete geodesic curvature of Polthier and
// Schmies, "Straightest Geodesics on Polyhedral Surfaces" (1998).
#include "edges/edge_adjacency.hpp"

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

#include "detail/index.hpp"
#include "detail/poll.hpp"
#include "surface/corner_fans.hpp"

namespace seamwire {

using namespace detail;

namespace {

// Steps between two looks at the task: well under a millisecond.
constexpr std::size_t kEdgesBetweenChecks = 1024;

}  // namespace

EdgeAdjacency::EdgeAdjacency(const Surface& surface, const Task& task) {
  const std::vector<Edge>& edges = surface.edges();
  first_.assign(surface.vertex_count() + 1, 0);
  for (const auto& [a, b] : edges) {
    ++first_[a + 1];
    ++first_[b + 1];
  }
  for (std::size_t v = 1; v < first_.size(); ++v) first_[v] += first_[v - 1];
  resize(head_, 2 * edges.size(), task, 0.0);
  resize(twin_, 2 * edges.size(), task, 0.0);
  resize(directions_, 2 * edges.size(), task, 0.0);
  opposite_.assign(2 * edges.size(), -1);
  boundary_edges_.assign(surface.vertex_count(), {-1, -1});
  is_open_.assign(surface.vertex_count(), false);
  std::vector<std::int32_t> next(first_.begin(), first_.end() - 1);
  Poll filling(task, 0.0, 0.0, edges.size());
  for (const auto& [a, b] : edges) {  // sorted, so each row is
    filling.next();
    const std::int32_t there = next[a]++, back = next[b]++;
    head_[there] = b;
    head_[back] = a;
    twin_[there] = back;
    twin_[back] = there;
  }

  const std::vector<std::int32_t>& vertex_of_fan = corner_fans(surface).vertices;
  std::vector<std::int32_t> umbrellas(surface.vertex_count(), 0);
  for (const std::int32_t v : vertex_of_fan) ++umbrellas[v];
  const std::size_t total = surface.vertex_count() + vertex_of_fan.size();
  std::size_t count = 0;
  const auto look = [&] {
    if (++count % kEdgesBetweenChecks == 0) task.check(static_cast<double>(count) / static_cast<double>(total));
  };
  for (std::int32_t v = 0; v < vertex_count(); ++v, look()) {
    if (umbrellas[v] != 1) set_directions_in_space(surface, v);
  }
  for (std::int32_t fan = 0; index(fan) < vertex_of_fan.size(); ++fan, look()) {
    if (umbrellas[vertex_of_fan[fan]] == 1) set_umbrella(surface, fan);
  }
}

void EdgeAdjacency::set_umbrella(const Surface& surface, std::int32_t fan) {
  const CornerFans& mesh = corner_fans(surface);
  const std::int32_t v = mesh.vertices[fan];
  const auto edge_vector = [&](std::int32_t neighbor) -> Vector {
    return surface.scale() * (surface.points()[neighbor] - surface.points()[v]);
  };

  std::vector<StarEdge> star;  // of real edges; diagonals of polygons only add their angles
  std::int32_t first_edge = -1, last_edge = -1, last = -1;
  double total = 0.0;
  const auto add = [&](std::int32_t neighbor) {
    last_edge = find(v, neighbor);
    if (last < 0) first_edge = last_edge;
    if (last_edge >= 0) star.push_back({last_edge, total, false});
  };
  const bool open = mesh.for_each_leaving(fan, [&](std::int32_t h) {
    const std::int32_t neighbor = mesh.vertices[mesh.tip(h)], following = mesh.vertices[mesh.apex(h)];
    add(neighbor);
    last = following;
    const Vector p = edge_vector(neighbor), r = edge_vector(following);
    total += std::atan2(p.cross(r).norm(), p.dot(r));
    if (last_edge >= 0 && find(v, following) >= 0) star.back().triangle = find(neighbor, following) >= 0;
  });
  if (open) add(last);

  // An umbrella that has an edge of the vertex twice (it was cut open there) or lacks one (a loose edge) is not single.
  std::vector<std::int32_t> distinct(star.size());
  std::ranges::transform(star, distinct.begin(), &StarEdge::edge);
  std::ranges::sort(distinct);
  const bool twice = std::ranges::adjacent_find(distinct) != distinct.end();
  if (twice || distinct.size() != static_cast<std::size_t>(end(v) - begin(v)) || !(total > 0.0))
    return set_directions_in_space(surface, v);

  const double scale = open ? 1.0 : 2.0 * std::numbers::pi / total;
  for (const auto& [edge, angle, triangle] : star) {
    directions_[edge] = {std::cos(scale * angle), std::sin(scale * angle), 0.0};
  }
  if (!open) return set_opposites(star);
  boundary_edges_[v] = {first_edge, last_edge};
  is_open_[v] = true;
  if (first_edge >= 0 && last_edge >= 0) {
    directions_[first_edge][2] = std::sqrt(std::max(0.0, 1.0 + std::cos(total)));
    directions_[last_edge][2] = -directions_[first_edge][2];
    if (star.size() > 2) {  // else it is the corner of a single face
      opposite_[first_edge] = last_edge;
      opposite_[last_edge] = first_edge;
    }
  }
}

void EdgeAdjacency::set_opposites(const std::vector<StarEdge>& star) {
  const bool only_triangles = std::ranges::all_of(star, &StarEdge::triangle);
  const std::size_t n = star.size();
  if (n != (only_triangles ? 6U : 4U)) return;
  for (std::size_t i = 0; i < n; ++i) opposite_[star[i].edge] = star[(i + n / 2) % n].edge;
}

void EdgeAdjacency::set_directions_in_space(const Surface& surface, std::int32_t v) {
  const Vector& from = surface.points()[v];
  for (std::int32_t e = begin(v); e < end(v); ++e) {
    // Zero for an edge of length zero: it has no direction, and every turn there counts as a right angle.
    const Vector direction = (surface.scale() * (surface.points()[head(e)] - from)).stableNormalized();
    directions_[e] = {direction.x(), direction.y(), direction.z()};
  }
}

std::int32_t EdgeAdjacency::find(std::int32_t a, std::int32_t b) const {
  const auto row_begin = head_.begin() + begin(a), row_end = head_.begin() + end(a);
  const auto it = std::lower_bound(row_begin, row_end, b);
  return it != row_end && *it == b ? static_cast<std::int32_t>(it - head_.begin()) : -1;
}

std::int32_t EdgeAdjacency::checked(const Edge& edge, const std::string& what) const {
  for (const std::int32_t v : edge) check_index(v, index(vertex_count()), what + ": vertex");
  const std::int32_t e = find(edge[0], edge[1]);
  if (e >= 0) return e;
  throw InvalidInput(what + ": there is no edge between the vertices " + std::to_string(edge[0]) + " and " +
                     std::to_string(edge[1]));
}

void EdgeAdjacency::check_size(const Surface& surface) const {
  if (index(vertex_count()) == surface.vertex_count() && directed_count() == 2 * surface.edges().size()) return;
  throw InvalidInput("the adjacency is of another surface: it has " + std::to_string(vertex_count()) +
                     " vertices and " + std::to_string(directed_count() / 2) + " edges");
}

std::shared_ptr<const EdgeAdjacency> make_edge_adjacency(const Surface& surface, const Task& task) {
  return std::make_shared<const EdgeAdjacency>(surface, task);
}

}  // namespace seamwire
