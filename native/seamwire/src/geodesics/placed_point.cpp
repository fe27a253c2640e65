// SPDX-License-Identifier: GPL-3.0-or-later
#include "geodesics/placed_point.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>

#include "detail/index.hpp"
#include "detail/text.hpp"

namespace seamwire::detail {
namespace {

/// The sum of barycentric coordinates may miss 1 by this much.
constexpr double kSumTolerance = 1e-9;
/// A coordinate below it changes no sum with the others. It counts as 0: squares of less might vanish.
constexpr double kLeastWeight = std::numeric_limits<double>::epsilon() / 2;

}  // namespace

std::array<double, 3> checked_barycentric(const std::array<double, 3>& barycentric, const std::string& what) {
  double sum = 0.0;
  for (const double b : barycentric) {
    if (!(b >= 0) || !std::isfinite(b)) {
      throw InvalidInput(what + ": a barycentric coordinate is " + text(b) + ", not finite and 0 or more");
    }
    sum += b;
  }
  if (!(std::abs(sum - 1) <= kSumTolerance)) {
    throw InvalidInput(what + ": the barycentric coordinates' sum is " + text(sum) + ", not 1");
  }
  std::array<double, 3> weights{};
  for (std::size_t i = 0; i < 3; ++i) {
    const double weight = barycentric[i] / sum;
    if (weight >= kLeastWeight) weights[i] = weight;
  }
  return weights;
}

PlacedPoint PlacedPoint::in_face(const GeodesicMesh& mesh, const InFace& first) {
  PlacedPoint point{.vertex = -1, .faces = {first}};
  for (std::size_t i = 0; i < point.faces.size(); ++i) {
    const std::int32_t face = point.faces[i].face;
    const std::array<double, 3> weights = point.faces[i].weights;
    for (std::int32_t h = 3 * face; h < 3 * face + 3; ++h) {
      const Point2 at = position(mesh, h, weights);
      const double length = mesh.half_edge(h).length;
      if (at.y > 0 || !(at.x >= 0 && at.x <= length)) continue;
      mesh.for_each_beyond(h, [&](std::int32_t other) {
        const bool is_known = std::ranges::any_of(point.faces, [&](const InFace& f) { return f.face == other / 3; });
        if (is_known) return;
        const bool is_on_edge = weights[previous_in_face(h) % 3] == 0;
        double at_tail = is_on_edge ? weights[h % 3] : 1 - at.x / length;
        double at_tip = is_on_edge ? weights[next_in_face(h) % 3] : at.x / length;
        if (!mesh.is_mirrored(h, other)) std::swap(at_tail, at_tip);
        std::array<double, 3> beyond{};
        beyond[other % 3] = at_tail;
        beyond[next_in_face(other) % 3] = at_tip;
        point.faces.push_back({other / 3, beyond});
      });
    }
  }
  return point;
}

PlacedPoint PlacedPoint::of(const GeodesicMesh& mesh, const SurfacePoint& point, const std::string& what) {
  if (point.vertex >= 0) {
    check_index(point.vertex, mesh.vertex_count(), what + ": vertex");
    return at_vertex(mesh.internal_vertex(point.vertex));
  }
  check_index(point.face, mesh.half_edge_count() / 3, what + ": face", "faces");
  const std::array<double, 3> weights = checked_barycentric(point.barycentric, what);
  const std::int32_t face = mesh.internal_face(point.face);
  for (std::int32_t i = 0; i < 3; ++i) {
    if (weights[(i + 1) % 3] == 0 && weights[(i + 2) % 3] == 0) return at_vertex(mesh.half_edge(3 * face + i).tail);
  }
  return in_face(mesh, {face, weights});
}

PathPoint PlacedPoint::path_point() const {
  if (vertex >= 0) return {.vertex = vertex};
  const auto& [face, weights] = faces.front();
  for (std::int32_t h = 3 * face; h < 3 * face + 3; ++h) {
    if (weights[previous_in_face(h) % 3] == 0) return {.half_edge = h, .t = weights[next_in_face(h) % 3]};
  }
  return {.face = face, .barycentric = weights};
}

SourcePoints::SourcePoints(std::vector<PlacedPoint> points) : points_(std::move(points)) {
  for (std::size_t k = 0; k < points_.size(); ++k) {
    for (const auto& [face, weights] : points_[k].faces) {
      in_faces_.push_back({face, static_cast<std::int32_t>(k), weights});
    }
  }
  std::ranges::stable_sort(in_faces_, {}, &InFace::face);
}

std::span<const SourcePoints::InFace> SourcePoints::in_face(std::int32_t face) const {
  const auto begin = std::ranges::lower_bound(in_faces_, face, {}, &InFace::face);
  return {begin, std::ranges::upper_bound(begin, in_faces_.end(), face, {}, &InFace::face)};
}

}  // namespace seamwire::detail
