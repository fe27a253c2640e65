// SPDX-License-Identifier: GPL-3.0-or-later
#include "seamwire/wires/embedded_points.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "detail/csr.hpp"
#include "detail/index.hpp"
#include "geodesics/placed_point.hpp"
#include "surface/exact_unit.hpp"

namespace seamwire {

using namespace detail;

namespace {

using Weights = std::array<double, 3>;  // barycentric coordinates in one of the caller's faces

/// A point is in a part of its face if no coordinate there is further below 0: rounding, in parts of the part.
constexpr double kOutside = 1e-9;

/// The area of the triangle a, b, c in parts of the face's. Exactly 0 where all three are on one edge of the face.
double signed_area(const Weights& a, const Weights& b, const Weights& c) {
  return a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0]) + a[2] * (b[0] * c[1] - b[1] * c[0]);
}

/// Vertices of an embedding are reached by halving edges, so their coordinates in the caller's face are multiples of a
/// power of two. Takes the nearest one if the error of `weight` does not tell them apart.
double rounded(double weight, double error) {
  constexpr double kSteps = 1 << 30;
  const double nearest = std::round(weight * kSteps) / kSteps;
  return error < 0.1 / kSteps && std::abs(weight - nearest) <= error ? nearest : weight;
}

}  // namespace

struct EmbeddedPoints::Impl {
  Weights weights_in(std::int32_t face, std::int32_t vertex) const;

  std::shared_ptr<const Surface> surface;
  std::shared_ptr<const Embedding> embedding;
  Csr<std::int32_t> parts_of;  // of the caller's faces
};

Weights EmbeddedPoints::Impl::weights_in(std::int32_t face, std::int32_t vertex) const {
  const Triangle& corners = surface->triangles()[face];
  Weights weights{};
  for (std::size_t i = 0; i < 3; ++i) {
    if (corners[i] != vertex) continue;
    weights[i] = 1.0;
    return weights;
  }
  const double unit = exact_unit(*surface);
  const Vector a = unit * surface->points()[corners[0]], b = unit * surface->points()[corners[1]],
               c = unit * surface->points()[corners[2]], p = unit * embedding->points[vertex];
  const Vector ab = b - a, ac = c - a, ap = p - a, normal = ab.cross(ac);
  const double area = normal.norm(), longest = std::max({ab.norm(), ac.norm(), (c - b).norm()});
  const Vector up = normal / area;
  // Coordinates are rounded to parts of the largest one; an error counts in parts of the face's height.
  const double largest = std::max({a.cwiseAbs().maxCoeff(), b.cwiseAbs().maxCoeff(), c.cwiseAbs().maxCoeff()});
  const double error = 16 * std::numeric_limits<double>::epsilon() * largest * longest / area;
  weights[1] = rounded(ap.cross(ac).dot(up) / area, error);
  weights[2] = rounded(ab.cross(ap).dot(up) / area, error);
  weights[0] = rounded(1 - weights[1] - weights[2], error);
  return weights;
}

EmbeddedPoints::EmbeddedPoints(std::shared_ptr<const Surface> surface, std::shared_ptr<const Embedding> embedding) {
  if (!surface || !embedding) throw InvalidInput("surface or embedding: there is none");
  const std::vector<std::int32_t>& faces = embedding->source_face;
  if (faces.size() != embedding->mesh.face_count() ||
      !std::ranges::all_of(faces, [&](std::int32_t f) { return is_index(f, surface->face_count()); }) ||
      embedding->points.size() < surface->vertex_count()) {
    throw InvalidInput("the embedding is of another surface");
  }
  Csr<std::int32_t> parts_of(surface->face_count(), [&](const auto& visit) {
    for (std::size_t f = 0; f < faces.size(); ++f) visit(faces[f], static_cast<std::int32_t>(f));
  });
  impl_ = std::make_unique<const Impl>(Impl{std::move(surface), std::move(embedding), std::move(parts_of)});
}

EmbeddedPoints::~EmbeddedPoints() = default;
EmbeddedPoints::EmbeddedPoints(EmbeddedPoints&&) noexcept = default;
EmbeddedPoints& EmbeddedPoints::operator=(EmbeddedPoints&&) noexcept = default;

std::optional<SurfacePoint> EmbeddedPoints::find(const SurfacePoint& point, const std::string& what) const {
  const Surface& surface = *impl_->surface;
  if (point.vertex >= 0) {
    check_index(point.vertex, surface.vertex_count(), what + ": vertex");
    return point;
  }
  check_index(point.face, surface.face_count(), what + ": face", "faces");
  const Weights at = checked_barycentric(point.barycentric, what);
  for (std::size_t i = 0; i < 3; ++i) {
    if (at[(i + 1) % 3] == 0 && at[(i + 2) % 3] == 0) {
      return SurfacePoint(surface.triangles()[point.face][i]);
    }
  }
  SurfacePoint best;
  double best_inside = -kOutside;
  for (const std::int32_t part : impl_->parts_of[point.face]) {
    std::array<Weights, 3> corners;
    for (std::size_t i = 0; i < 3; ++i) {
      corners[i] = impl_->weights_in(point.face, impl_->embedding->mesh.triangles[part][i]);
    }
    const double whole = signed_area(corners[0], corners[1], corners[2]);
    Weights within;
    for (std::size_t i = 0; i < 3; ++i) {
      within[i] = signed_area(at, corners[(i + 1) % 3], corners[(i + 2) % 3]) / whole;
    }
    const double inside = std::min({within[0], within[1], within[2]});
    if (!(inside > best_inside)) continue;
    best_inside = inside;
    best = {part, within};
  }
  if (best.face < 0) return std::nullopt;
  double sum = 0.0;
  for (double& weight : best.barycentric) sum += weight = std::max(weight, 0.0);
  for (double& weight : best.barycentric) weight /= sum;
  return best;
}

}  // namespace seamwire
