// SPDX-License-Identifier: GPL-3.0-or-later
#include "seamwire/wires/wire.hpp"

#include <Eigen/Geometry>
#include <string>

#include "detail/index.hpp"
#include "surface/exact_unit.hpp"
#include "wires/path_position.hpp"

namespace seamwire {

using namespace detail;

namespace {

/// Sine of the largest angle between pieces of one line. Omitted turns change the length by their square, which is
/// nothing in double precision.
constexpr double kCollinear = 1e-11;

/// `unit`: see exact_unit().
bool straight(double unit, const Vector& a, const Vector& b, const Vector& c) {
  const Vector u = unit * (b - a), v = unit * (c - b);
  return u.dot(v) > 0 && u.cross(v).norm() <= kCollinear * u.norm() * v.norm();
}

void check_path(const Surface& surface, const Embedding& embedding, const IntrinsicPath& path) {
  const auto check = [](bool is_there) {
    if (!is_there) throw InvalidInput("the path is of another embedding");
  };
  if (path.points.empty()) throw InvalidInput("path: it has no points");
  check(path.faces.size() + 1 == path.points.size());
  for (const PathPoint& point : path.points) {
    if (point.vertex >= 0) {
      check(index(point.vertex) < embedding.points.size());
    } else {
      check(point.half_edge >= 0 || point.face >= 0);
      check(index(point.half_edge >= 0 ? point.half_edge / 3 : point.face) < embedding.source_face.size());
    }
  }
  for (const std::int32_t face : path.faces) {
    if (face < 0) continue;
    check(index(face) < embedding.source_face.size());
    check(index(embedding.source_face[face]) < surface.face_count());
  }
}

}  // namespace

void detail::check_embedding(const Surface& surface, const Embedding& embedding) {
  const std::size_t vertices = surface.vertex_count();
  if (embedding.points.size() < vertices ||
      (vertices > 0 && (embedding.points.front() != surface.points().front() ||
                        embedding.points[vertices - 1] != surface.points().back()))) {
    throw InvalidInput("the embedding is of another surface");
  }
}

Vector detail::position(const Embedding& embedding, const PathPoint& point) {
  if (point.vertex >= 0) return embedding.points[point.vertex];
  if (point.face >= 0) {
    const Triangle& corners = embedding.mesh.triangles[point.face];
    Vector sum = Vector::Zero();
    for (std::size_t i = 0; i < 3; ++i) sum += point.barycentric[i] * embedding.points[corners[i]];
    return sum;
  }
  const Vector& tail = embedding.points[embedding.mesh.tail(point.half_edge)];
  const Vector& tip = embedding.points[embedding.mesh.tip(point.half_edge)];
  return (1.0 - point.t) * tail + point.t * tip;
}

void detail::check_field(const Embedding& embedding, const DistanceField& field) {
  if (field.fits(embedding.mesh)) return;
  throw InvalidInput("the field is of another embedding: it has " + std::to_string(field.distances().size()) +
                     " vertices, the embedding " + std::to_string(embedding.points.size()) + " vertices and " +
                     std::to_string(embedding.mesh.face_count()) + " triangles");
}

Wire map_wire(const Surface& surface, const Embedding& embedding, const IntrinsicPath& path) {
  Wire wire;
  check_embedding(surface, embedding);
  check_path(surface, embedding, path);
  wire.length = path.length;
  for (std::size_t i = 0; i < path.points.size(); ++i) {
    const PathPoint& at = path.points[i];
    const Vector point = position(embedding, at);
    const bool is_external = at.vertex >= 0 && index(at.vertex) < surface.vertex_count();
    const std::int32_t vertex = is_external ? at.vertex : -1;
    if (i > 0) {
      const std::int32_t refined = path.faces[i - 1];
      const std::int32_t face = refined < 0 ? -1 : embedding.source_face[refined];
      const bool free_end = wire.vertices.back() < 0;  // not one of the caller's vertices, so it may go
      if (point == wire.points.back() && (free_end || vertex < 0)) {
        if (free_end) wire.vertices.back() = vertex;
        continue;
      }
      const std::size_t n = wire.points.size();
      if (n > 1 && free_end && face >= 0 && wire.faces.back() == face &&
          straight(exact_unit(surface), wire.points[n - 2], wire.points[n - 1], point)) {
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
  const double unit = exact_unit(surface);
  wire.euclidean_length = 0.0;
  for (std::size_t i = 1; i < wire.points.size(); ++i) {
    wire.euclidean_length += (unit * (wire.points[i] - wire.points[i - 1])).norm() / unit;
  }
  return wire;
}

std::optional<Wire> trace_wire(const Surface& surface, const Embedding& embedding, const DistanceField& field,
                               const SurfacePoint& point, const Task& task) {
  check_field(embedding, field);
  const std::optional<IntrinsicPath> path = field.trace(point, task);
  if (!path) return std::nullopt;
  Wire wire = map_wire(surface, embedding, *path);
  if (const std::int32_t seed = field.seed(); seed >= 0) wire.from = index(seed) < surface.vertex_count() ? seed : -1;
  if (is_index(point.vertex, surface.vertex_count())) wire.to = point.vertex;
  return wire;
}

}  // namespace seamwire
