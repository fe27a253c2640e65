// SPDX-License-Identifier: GPL-3.0-or-later
#include "prices/plan_mesh.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <utility>

#include "detail/index.hpp"
#include "detail/poll.hpp"
#include "surface/corner_fans.hpp"
#include "surface/joined_faces.hpp"
#include "surface/real_edges.hpp"

namespace seamwire::detail {

std::int32_t PlanMesh::edge_between(std::int32_t a, std::int32_t b) const {
  std::int32_t found = -1;
  for (const PlanNeighbor& next : neighbors[a]) {
    if (next.vertex == b && (found < 0 || next.edge < found)) found = next.edge;
  }
  return found;
}

void connect(PlanMesh& mesh, std::optional<std::span<const Edge>> real_edges, const Task& task) {
  Poll poll(task, 0.0, 0.0, 1);
  const std::size_t half_edges = mesh.twins.size();
  mesh.edge_of.assign(half_edges, -1);
  mesh.half_edge_of.clear();
  for (std::int32_t h = 0; index(h) < half_edges; ++h) {
    poll.next();
    if (mesh.edge_of[h] >= 0) continue;
    mesh.edge_of[h] = static_cast<std::int32_t>(mesh.half_edge_of.size());
    if (mesh.twins[h] >= 0) mesh.edge_of[mesh.twins[h]] = mesh.edge_of[h];
    mesh.half_edge_of.push_back(h);
  }
  mesh.lengths.clear();
  mesh.is_real.clear();
  std::vector<std::pair<std::int32_t, PlanNeighbor>> neighbors, all_neighbors;
  for (std::int32_t e = 0; index(e) < mesh.edge_count(); ++e) {
    poll.next();
    const std::int32_t a = mesh.tail(mesh.half_edge_of[e]), b = mesh.tip(mesh.half_edge_of[e]);
    mesh.lengths.push_back((mesh.points[b] - mesh.points[a]).norm());
    const std::int32_t one = mesh.sources[a], other = mesh.sources[b];
    const Edge edge{std::min(one, other), std::max(one, other)};
    const bool is_real = a != b && (!real_edges || std::ranges::binary_search(*real_edges, edge));
    mesh.is_real.push_back(is_real ? 1 : 0);
    for (auto* list : {&neighbors, &all_neighbors}) {
      if (list == &neighbors && !is_real) continue;
      list->push_back({a, {b, e}});
      list->push_back({b, {a, e}});
    }
  }
  const auto by_vertex = [&](const std::vector<std::pair<std::int32_t, PlanNeighbor>>& pairs) {
    return Csr<PlanNeighbor>(mesh.vertex_count(), [&](const auto& visit) {
      for (const auto& [vertex, neighbor] : pairs) {
        poll.next();
        visit(vertex, neighbor);
      }
    });
  };
  mesh.neighbors = by_vertex(neighbors);
  mesh.all_neighbors = by_vertex(all_neighbors);
}

PlanMesh plan_mesh(const Surface& surface, const Task& task) {
  task.check(0.0);
  PlanMesh mesh;
  mesh.triangles = corner_fans(surface).triangles;
  mesh.twins = corner_fans(surface).twins;
  mesh.faces = corner_fans(surface).faces;
  mesh.sources = corner_fans(surface).vertices;
  // The model's size first, so that no square overflows.
  mesh.scale = surface.scale();
  const auto put_points = [&] {
    mesh.points.clear();
    for (const std::int32_t v : mesh.sources) mesh.points.push_back(mesh.scale * surface.points()[v]);
  };
  put_points();
  double area = 0.0;
  for (const FaceFrame& frame : face_frames(mesh, task)) area += frame.area;
  if (area > 0.0) {
    mesh.scale /= std::sqrt(area);
    put_points();
  }
  connect(mesh, surface.edges(), task);
  return mesh;
}

std::vector<std::uint8_t> marked_edges(const PlanMesh& mesh, std::vector<Edge> edges, const Task& task) {
  Poll poll(task, 0.0, 0.0, 1);
  for (Edge& edge : edges) edge = ascending(edge[0], edge[1]);
  std::ranges::sort(edges);
  std::vector<std::uint8_t> is_marked;
  for (const std::int32_t h : mesh.half_edge_of) {
    poll.next();
    const Edge edge = ascending(mesh.sources[mesh.tail(h)], mesh.sources[mesh.tip(h)]);
    is_marked.push_back(mesh.twins[h] >= 0 && std::ranges::binary_search(edges, edge) ? 1 : 0);
  }
  return is_marked;
}

FaceFrame face_frame(const PlanMesh& mesh, const Triangle& triangle) {
  const auto& [a, b, c] = triangle;
  const Vector doubled = (mesh.points[b] - mesh.points[a]).cross(mesh.points[c] - mesh.points[a]);
  const double size = doubled.norm();
  return {size > 0.0 ? Vector(doubled / size) : Vector(Vector::Zero()), 0.5 * size};
}

std::vector<FaceFrame> face_frames(const PlanMesh& mesh, const Task& task) {
  std::vector<FaceFrame> frames;
  frames.reserve(mesh.face_count());
  Poll poll(task, 0.0, 0.0, 1);
  for (const Triangle& triangle : mesh.triangles) {
    poll.next();
    frames.push_back(face_frame(mesh, triangle));
  }
  return frames;
}

std::vector<Vector> vertex_normals(const PlanMesh& mesh, std::span<const FaceFrame> frames, const Task& task) {
  std::vector<Vector> normals(mesh.vertex_count(), Vector::Zero());
  const Poll poll(task, 0.0, 0.0, 1);
  for (std::size_t f = 0; f < mesh.face_count(); ++f) {
    poll.at(f);
    const Triangle& t = mesh.triangles[f];
    for (std::size_t i = 0; i < 3; ++i) {
      const Vector one = mesh.points[t[(i + 1) % 3]] - mesh.points[t[i]];
      const Vector other = mesh.points[t[(i + 2) % 3]] - mesh.points[t[i]];
      normals[t[i]] += std::atan2(one.cross(other).norm(), one.dot(other)) * frames[f].normal;
    }
  }
  for (Vector& normal : normals) {
    const double size = normal.norm();
    if (size > 0.0) normal /= size;
  }
  return normals;
}

std::vector<double> vertex_areas(const PlanMesh& mesh, std::span<const FaceFrame> frames) {
  std::vector<double> areas(mesh.vertex_count(), 0.0);
  for (std::size_t f = 0; f < mesh.face_count(); ++f) {
    for (const std::int32_t v : mesh.triangles[f]) areas[v] += frames[f].area / 3.0;
  }
  return areas;
}

double median_length(const PlanMesh& mesh) {
  std::vector<double> lengths = mesh.lengths;
  if (lengths.empty()) return 0.0;
  const auto middle = lengths.begin() + static_cast<std::ptrdiff_t>(lengths.size() / 2);
  std::nth_element(lengths.begin(), middle, lengths.end());
  return *middle;
}

Pieces find_pieces(const PlanMesh& mesh, std::span<const std::uint8_t> is_cut, const Task& task) {
  Poll poll(task, 0.0, 0.0, 1);
  DisjointSets sets = joined_faces(mesh, [&](std::int32_t h) {
    poll.next();
    return is_cut[mesh.edge_of[h]] == 0;
  });
  auto [of_face, count] = sets.numbering();
  return {std::move(of_face), count};
}

}  // namespace seamwire::detail
