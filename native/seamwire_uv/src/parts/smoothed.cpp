// SPDX-License-Identifier: GPL-3.0-or-later
#include "parts/smoothed.hpp"

#include <cstddef>
#include <utility>

#include "detail/index.hpp"
#include "detail/poll.hpp"

namespace seamwire::detail {
namespace {

/// A sum of points.
struct Mean {
  Vector sum = Vector::Zero();
  double count = 0.0;

  void add(const Vector& point) {
    sum += point;
    count += 1.0;
  }
  Vector value() const { return count > 0.0 ? Vector(sum / count) : sum; }
};

}  // namespace

Smoothed smoothed(const PlanMesh& mesh, const Polygons& polygons, const Task& task) {
  Poll poll(task);
  const std::size_t vertices = mesh.vertex_count(), edges = mesh.edge_count();
  std::vector<Mean> of_polygon(polygons.count);
  for (std::int32_t h = 0; index(h) < mesh.twins.size(); ++h) {
    poll.next();
    if (polygons.is_diagonal[mesh.edge_of[h]] == 0) of_polygon[polygons.of_face[h / 3]].add(mesh.points[mesh.tail(h)]);
  }
  // The new points are those of vertices, edges and polygons, in this order.
  std::vector<Vector> points(mesh.points);
  points.reserve(vertices + edges + polygons.count);
  std::vector<Mean> around(vertices), rims(vertices);  // of each vertex: points around it, and on the boundary
  for (std::int32_t e = 0; index(e) < edges; ++e) {
    poll.next();
    const std::int32_t h = mesh.half_edge_of[e], twin = mesh.twins[h], a = mesh.tail(h), b = mesh.tip(h);
    const Vector middle = 0.5 * (mesh.points[a] + mesh.points[b]);
    points.push_back(middle);
    if (polygons.is_diagonal[e] != 0) continue;
    if (twin < 0) {
      rims[a].add(mesh.points[b]);
      rims[b].add(mesh.points[a]);
      continue;
    }
    const Vector sides = of_polygon[polygons.of_face[h / 3]].value() + of_polygon[polygons.of_face[twin / 3]].value();
    points.back() = 0.5 * middle + 0.25 * sides;
    // Each polygon at a vertex is met at two edges, so half of it counts.
    for (const std::int32_t v : {a, b}) {
      around[v].sum += 2.0 * middle + 0.5 * sides;
      around[v].count += 1.0;
    }
  }
  for (std::size_t v = 0; v < vertices; ++v) {
    const double count = around[v].count;
    if (rims[v].count > 0.0) {
      points[v] = 0.75 * mesh.points[v] + 0.25 * rims[v].value();
    } else if (count > 0.0) {
      points[v] = (around[v].value() + (count - 3.0) * mesh.points[v]) / count;
    }
  }
  for (const Mean& mean : of_polygon) points.push_back(mean.value());

  std::vector<Triangle> triangles;
  std::vector<Edge> real;
  Smoothed made;
  for (std::int32_t h = 0; index(h) < mesh.twins.size(); ++h) {
    poll.next();
    const std::int32_t edge = mesh.edge_of[h], polygon = polygons.of_face[h / 3];
    if (polygons.is_diagonal[edge] != 0) continue;
    const auto middle = static_cast<std::int32_t>(vertices) + edge;
    const auto center = static_cast<std::int32_t>(vertices + edges) + polygon;
    triangles.push_back({center, mesh.tail(h), middle});
    triangles.push_back({center, middle, mesh.tip(h)});
    made.polygons.insert(made.polygons.end(), 2, polygon);
    real.push_back({center, middle});
    real.push_back({mesh.tail(h), middle});
    real.push_back({middle, mesh.tip(h)});
  }
  made.surface = std::make_shared<const Surface>(std::move(points), std::move(triangles), std::move(real), task);
  return made;
}

}  // namespace seamwire::detail
