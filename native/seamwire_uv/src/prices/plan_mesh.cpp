// SPDX-License-Identifier: GPL-3.0-or-later
#include "prices/plan_mesh.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "detail/index.hpp"
#include "detail/poll.hpp"
#include "detail/rounded.hpp"
#include "graph/disjoint_sets.hpp"
#include "surface/corner_fans.hpp"
#include "surface/joined_faces.hpp"
#include "surface/point_tree.hpp"
#include "surface/real_edges.hpp"
#include "tuning/constants.hpp"

namespace seamwire::detail {

namespace {

/// The edge with the smallest number between two vertices; -1 without one. Of the two, the one with fewer neighbors
/// tells. So asking for every edge of a surface takes a time in proportion to their number, whatever its vertices.
std::int32_t first_edge(const Csr<PlanNeighbor>& neighbors, std::int32_t a, std::int32_t b) {
  if (neighbors[b].size() < neighbors[a].size()) std::swap(a, b);
  std::int32_t found = -1;
  for (const PlanNeighbor& next : neighbors[a]) {
    if (next.vertex == b && (found < 0 || next.edge < found)) found = next.edge;
  }
  return found;
}

/// Takes over the triangles of a surface in an order that depends on their vertices alone, each from its lowest vertex
/// on. Blender's primitives have their faces in another order each time. Seams must not depend on it.
void take_triangles(const CornerFans& fans, PlanMesh& mesh, const Task& task) {
  Poll poll(task);
  std::vector<std::int32_t> order(fans.triangles.size()), first(order.size());
  std::iota(order.begin(), order.end(), 0);
  std::vector<Triangle> turned = fans.triangles;
  for (std::size_t f = 0; f < turned.size(); ++f) {
    poll.next();
    const auto lowest = std::ranges::min_element(turned[f]);
    first[f] = static_cast<std::int32_t>(lowest - turned[f].begin());
    std::rotate(turned[f].begin(), lowest, turned[f].end());  // Clang 14 cannot read std::ranges::rotate
  }
  polled_sort(order, Poll(task), {}, [&](std::int32_t f) { return std::pair(turned[f], f); });
  std::vector<std::int32_t> place(order.size());
  for (std::size_t k = 0; k < order.size(); ++k) place[order[k]] = static_cast<std::int32_t>(k);
  for (const std::int32_t f : order) {
    poll.next();
    mesh.triangles.push_back(turned[f]);
    mesh.faces.push_back(fans.faces[f]);
    for (std::int32_t i = 0; i < 3; ++i) {
      const std::int32_t twin = fans.twins[3 * f + (first[f] + i) % 3];
      const std::int32_t other = twin / 3;
      mesh.twins.push_back(twin < 0 ? -1 : 3 * place[other] + (twin % 3 - first[other] + 3) % 3);
    }
  }
}

double median_of(std::vector<double> values) {
  if (values.empty()) return 0.0;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

}  // namespace

std::int32_t PlanMesh::edge_between(std::int32_t a, std::int32_t b) const { return first_edge(neighbors, a, b); }
std::int32_t PlanMesh::any_edge_between(std::int32_t a, std::int32_t b) const {
  return first_edge(all_neighbors, a, b);
}

void connect(PlanMesh& mesh, std::optional<std::span<const Edge>> real_edges, const Task& task) {
  Poll poll(task);
  static_cast<NumberedEdges&>(mesh) = numbered_edges(mesh, poll);
  mesh.lengths.clear();
  mesh.is_real.clear();
  for (std::int32_t e = 0; index(e) < mesh.edge_count(); ++e) {
    poll.next();
    const std::int32_t a = mesh.tail(mesh.half_edge_of[e]), b = mesh.tip(mesh.half_edge_of[e]);
    mesh.lengths.push_back(rounded((mesh.points[b] - mesh.points[a]).norm()));
    const std::int32_t one = mesh.sources[a], other = mesh.sources[b];
    const Edge edge{std::min(one, other), std::max(one, other)};
    const bool is_real = a != b && (!real_edges || std::ranges::binary_search(*real_edges, edge));
    mesh.is_real.push_back(is_real ? 1 : 0);
  }
  mesh.median_length = median_of(mesh.lengths);
  const auto neighbors = [&](bool are_real) {
    return Csr<PlanNeighbor>(mesh.vertex_count(), [&](const auto& visit) {
      for (std::int32_t e = 0; index(e) < mesh.edge_count(); ++e) {
        poll.next();
        if (are_real && mesh.is_real[e] == 0) continue;
        const std::int32_t a = mesh.tail(mesh.half_edge_of[e]), b = mesh.tip(mesh.half_edge_of[e]);
        visit(a, PlanNeighbor{b, e});
        visit(b, PlanNeighbor{a, e});
      }
    });
  };
  mesh.neighbors = neighbors(true);
  mesh.all_neighbors = neighbors(false);
}

PlanMesh plan_mesh(const Surface& surface, const Task& task) {
  task.check(0.0);
  PlanMesh mesh;
  take_triangles(corner_fans(surface), mesh, task);
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
  Poll poll(task);
  for (Edge& edge : edges) edge = ascending(edge[0], edge[1]);
  polled_sort(edges, Poll(task));
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

bool have_area(const PlanMesh& mesh, std::span<const Triangle> triangles) {
  constexpr double kLeastHeight = 1e-6;  // of the diagonal: coordinates may have been rounded to single precision
  Eigen::AlignedBox3d box;
  for (const Triangle& t : triangles) {
    for (const std::int32_t v : t) box.extend(mesh.points[v]);
  }
  if (box.isEmpty()) return false;
  const double least = kLeastHeight * box.diagonal().norm();
  return std::ranges::any_of(triangles, [&](const Triangle& t) {
    double longest = 0.0;
    for (std::size_t i = 0; i < 3; ++i) {
      longest = std::max(longest, (mesh.points[t[(i + 1) % 3]] - mesh.points[t[i]]).norm());
    }
    return 2.0 * face_frame(mesh, t).area > least * longest;
  });
}

std::vector<FaceFrame> face_frames(const PlanMesh& mesh, const Task& task) {
  std::vector<FaceFrame> frames;
  frames.reserve(mesh.face_count());
  Poll poll(task);
  for (const Triangle& triangle : mesh.triangles) {
    poll.next();
    frames.push_back(face_frame(mesh, triangle));
  }
  return frames;
}

std::vector<Vector> vertex_normals(const PlanMesh& mesh, std::span<const FaceFrame> frames, const Task& task) {
  std::vector<Vector> normals(mesh.vertex_count(), Vector::Zero());
  const Poll poll(task);
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

Pieces find_pieces(const PlanMesh& mesh, std::span<const std::uint8_t> is_cut, const Task& task) {
  Poll poll(task);
  DisjointSets sets = joined_faces(mesh, [&](std::int32_t h) {
    poll.next();
    return is_cut[mesh.edge_of[h]] == 0;
  });
  auto [of_face, count] = sets.numbering();
  return {std::move(of_face), count};
}

namespace {

/// Whether nearly all edges have an edge as their image, and that one the first as its image.
bool maps_edges(const PlanMesh& mesh, const Reflection& reflection, const Task& task) {
  Poll poll(task);
  std::size_t mapped = 0;
  const auto back = [&](std::int32_t v, std::int32_t image) { return image >= 0 && reflection.images[image] == v; };
  for (const std::int32_t h : mesh.half_edge_of) {
    poll.next();
    const std::int32_t a = mesh.tail(h), b = mesh.tip(h);
    const std::int32_t a_image = reflection.images[a], b_image = reflection.images[b];
    if (!back(a, a_image) || !back(b, b_image)) continue;
    mapped += mesh.any_edge_between(a_image, b_image) >= 0 ? 1 : 0;
  }
  return static_cast<double>(mapped) >= tuning::kExactImages * static_cast<double>(mesh.edge_count());
}

Eigen::AlignedBox3d box_of(const PlanMesh& mesh) {
  Eigen::AlignedBox3d box;
  for (const Vector& point : mesh.points) box.extend(point);
  return box;
}

}  // namespace

double diagonal_of(const PlanMesh& mesh) {
  const Eigen::AlignedBox3d box = box_of(mesh);
  return box.isEmpty() ? 0.0 : box.diagonal().norm();
}

std::optional<Reflection> reflection_in(const PlanMesh& mesh, int axis, double offset, double diagonal,
                                        const Task& task) {
  const std::vector<FaceFrame> frames = face_frames(mesh, task);
  const std::vector<double> areas = vertex_areas(mesh, frames);
  const std::vector<Vector> normals = vertex_normals(mesh, frames, task);
  task.check(0.0);
  // On coarse meshes the nearest vertex may be far along the surface, though the surface is near.
  const PointTree tree(mesh.points, task);
  const double radius = std::max(tuning::kNearImage * diagonal, tuning::kCoarseImage * mesh.median_length);
  const auto surface_distance = [&](std::int32_t v, const Vector& point) {
    const Vector away = point - mesh.points[v];
    return normals[v].isZero() ? away.norm() : std::min(away.norm(), std::abs(away.dot(normals[v])));
  };
  Reflection found{.axis = axis, .offset = offset, .images = {}, .sides = {}};
  double corresponding = 0.0, total = 0.0;
  const Poll poll(task, 0.0, 1.0, mesh.vertex_count());
  for (std::int32_t v = 0; index(v) < mesh.vertex_count(); ++v) {
    poll.at(index(v));
    const Vector image = found.mirrored(mesh.points[v]);
    std::int32_t nearest = tree.nearest(image, radius);
    if (nearest >= 0 && surface_distance(nearest, image) > tuning::kNearImage * diagonal) nearest = -1;
    found.images.push_back(nearest);
    total += areas[v];
    corresponding += nearest >= 0 ? areas[v] : 0.0;
    const auto side = static_cast<std::int8_t>(mesh.points[v][axis] < offset ? -1 : 1);
    found.sides.push_back(nearest == v ? std::int8_t{0} : side);
  }
  if (!(total > 0.0) || corresponding < tuning::kLeastSymmetric * total) return std::nullopt;
  found.is_exact = maps_edges(mesh, found, task);
  return found;
}

std::optional<Reflection> find_reflection(const PlanMesh& mesh, int axis, const Task& task) {
  const double diagonal = diagonal_of(mesh);
  if (!(diagonal > 0.0)) return std::nullopt;
  std::optional<Reflection> found = reflection_in(mesh, axis, 0.0, diagonal, task);
  return found ? found : reflection_in(mesh, axis, box_of(mesh).center()[axis], diagonal, task);
}

std::int32_t image_of_edge(const PlanMesh& mesh, const Reflection& reflection, std::int32_t edge) {
  const std::int32_t h = mesh.half_edge_of[edge];
  const std::int32_t a = reflection.images[mesh.tail(h)], b = reflection.images[mesh.tip(h)];
  return a < 0 || b < 0 ? -1 : mesh.edge_between(a, b);
}

}  // namespace seamwire::detail
