// SPDX-License-Identifier: GPL-3.0-or-later
#include "wires/wire_pieces.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "surface/exact_unit.hpp"

namespace seamwire::detail {
namespace {

/// A place that lies in a face up to rounding; nothing where the face has no area.
std::optional<SurfacePoint> point_in_face(const Surface& surface, std::int32_t face, const Vector& place) {
  const auto& [a, b, c] = surface.triangles()[face];
  const std::vector<Vector>& points = surface.points();
  const Vector& origin = points[a];
  const auto from_a = [&](const Vector& p) { return Vector(exact_unit(surface) * (p - origin)); };
  const Vector u = from_a(points[b]), v = from_a(points[c]), w = from_a(place), normal = u.cross(v);
  const double area2 = normal.squaredNorm();
  if (!(area2 > 0)) return std::nullopt;
  const double at_b = w.cross(v).dot(normal) / area2, at_c = u.cross(w).dot(normal) / area2;
  std::array<double, 3> weights = {1.0 - at_b - at_c, at_b, at_c};
  double sum = 0.0;
  for (double& weight : weights) sum += weight = std::max(weight, 0.0);
  for (double& weight : weights) weight /= sum;
  return SurfacePoint{.face = face, .barycentric = weights};
}

std::int32_t nearest_corner(const Surface& surface, const SurfacePoint& point) {
  const auto most = std::ranges::max_element(point.barycentric) - point.barycentric.begin();
  return surface.triangles()[point.face][static_cast<std::size_t>(most)];
}

}  // namespace

std::vector<WirePiece> cut_in_pieces(const Surface& surface, const Wire& wire, std::size_t count) {
  std::vector<WirePiece> pieces;
  if (wire.points.size() < 2) return pieces;
  std::vector<double> steps;
  double whole = 0.0;
  for (std::size_t i = 1; i < wire.points.size(); ++i) {
    whole += (wire.points[i] - wire.points[i - 1]).norm();
    steps.push_back(whole);
  }
  Wire piece{.from = wire.from, .points = {wire.points[0]}, .vertices = {wire.vertices[0]}, .faces = {}};
  double begin = 0.0;
  const auto end_piece = [&](std::int32_t to, double at, const SurfacePoint& end) {
    piece.to = to;
    piece.length = whole > 0 ? wire.length * (at - begin) / whole : 0.0;
    piece.euclidean_length = (at - begin) * surface.scale();
    begin = at;
    pieces.push_back({std::exchange(piece, Wire{.from = to, .points = {}, .vertices = {}, .faces = {}}), end});
  };
  for (std::size_t i = 1; i < wire.points.size(); ++i) {
    const double from = i > 1 ? steps[i - 2] : 0.0, to = steps[i - 1];
    const std::int32_t face = wire.faces[i - 1];
    // At the first place at or after the one wanted: what is wanted may be along an edge without a face.
    const double wanted = whole * static_cast<double>(pieces.size() + 1) / static_cast<double>(count);
    if (pieces.size() + 1 < count && to > wanted && face >= 0) {
      const double t = std::clamp((wanted - from) / (to - from), 0.25, 0.75);  // within the face, not at its border
      const Vector place = (1.0 - t) * wire.points[i - 1] + t * wire.points[i];
      if (const std::optional<SurfacePoint> end = point_in_face(surface, face, place)) {
        piece.points.push_back(place);
        piece.vertices.push_back(-1);
        piece.faces.push_back(face);
        end_piece(nearest_corner(surface, *end), from + t * (to - from), *end);
        piece.points.push_back(place);
        piece.vertices.push_back(-1);
      }
    }
    piece.points.push_back(wire.points[i]);
    piece.vertices.push_back(wire.vertices[i]);
    piece.faces.push_back(face);
  }
  end_piece(wire.to, whole, {});
  return pieces;
}

}  // namespace seamwire::detail
