// SPDX-License-Identifier: GPL-3.0-or-later
#include "seamwire/surface/triangulate.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cstddef>
#include <numeric>
#include <vector>

#include "detail/index.hpp"
#include "surface/check_polygons.hpp"

namespace seamwire {

using namespace detail;

namespace {

/// A triangle counts as one without an area if it is lower than this part of its longest side: vertices are placed on
/// edges in single precision.
constexpr double kFlat = 1e-4;

/// Whether a quad abcd can be cut from a to c, into abc and acd: neither lies on the other, nor has no area.
bool can_be_cut(const Vector& a, const Vector& b, const Vector& c, const Vector& d) {
  const Vector diagonal = c - a, one = (b - a).cross(diagonal), other = (d - a).cross(diagonal);
  const double flat = kFlat * diagonal.squaredNorm();
  return one.dot(other) <= 0 && std::min(one.squaredNorm(), other.squaredNorm()) > flat * flat;
}

/// Whether the triangles abc and acd look away from each other, by more than a right angle.
bool is_folded(const Vector& a, const Vector& b, const Vector& c, const Vector& d) {
  const Vector diagonal = c - a;
  return (b - a).cross(diagonal).dot((d - a).cross(diagonal)) > 0;
}

/// Twice the signed area of a triangle in the plane.
double area_of(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& c) {
  return (b.x() - a.x()) * (c.y() - a.y()) - (b.y() - a.y()) * (c.x() - a.x());
}

/// The corners of a polygon, projected to the plane of two axes that is nearest to the polygon's plane (Newell's
/// normal). They run counterclockwise.
std::vector<Eigen::Vector2d> in_plane(std::span<const Vector> points, std::span<const std::int32_t> corners) {
  Vector normal = Vector::Zero();
  for (std::size_t i = 0; i < corners.size(); ++i) {
    normal +=
        (points[corners[i]] - points[corners[0]]).cross(points[corners[(i + 1) % corners.size()]] - points[corners[0]]);
  }
  Eigen::Index axis = 0;
  normal.cwiseAbs().maxCoeff(&axis);
  const Eigen::Index first = (axis + 1) % 3, second = (axis + 2) % 3;
  std::vector<Eigen::Vector2d> placed;
  placed.reserve(corners.size());
  for (const std::int32_t v : corners) {
    placed.emplace_back(points[v][first], normal[axis] < 0 ? -points[v][second] : points[v][second]);
  }
  return placed;
}

/// Cuts a polygon into triangles by taking away one convex corner after another that contains no other corner
/// (Meisters, "Polygons have ears", 1975). Corners at the place of one of its corners do not count, because a polygon
/// with a hole passes twice along the edge that joins the hole. If rounding or a polygon that crosses itself leaves no
/// such corner, the next one is taken.
void cut_ears(std::span<const Vector> points, std::span<const std::int32_t> corners, std::vector<Triangle>& triangles) {
  const std::vector<Eigen::Vector2d> at = in_plane(points, corners);
  std::vector<std::size_t> left(corners.size());
  std::iota(left.begin(), left.end(), std::size_t{0});
  const auto is_ear = [&](std::size_t before, std::size_t i, std::size_t after) {
    const Eigen::Vector2d &a = at[before], &b = at[i], &c = at[after];
    if (area_of(a, b, c) <= 0) return false;
    return std::ranges::none_of(left, [&](std::size_t other) {
      const Eigen::Vector2d& p = at[other];
      return p != a && p != b && p != c && area_of(a, b, p) >= 0 && area_of(b, c, p) >= 0 && area_of(c, a, p) >= 0;
    });
  };
  // The search goes on where the last ear was cut.
  std::size_t ear = 1;
  while (left.size() > 3) {
    const std::size_t count = left.size();
    const auto corner = [&](std::size_t i) { return left[i % count]; };
    std::size_t tried = 0;
    while (tried < count && !is_ear(corner(ear + count - 1), corner(ear), corner(ear + 1))) {
      ++ear;
      ++tried;
    }
    ear %= count;
    triangles.push_back({corners[corner(ear + count - 1)], corners[corner(ear)], corners[corner(ear + 1)]});
    left.erase(left.begin() + static_cast<std::ptrdiff_t>(ear));
  }
  triangles.push_back({corners[left[0]], corners[left[1]], corners[left[2]]});
}

}  // namespace

Triangulation triangulate(std::span<const Vector> points, std::span<const std::int32_t> corners,
                          std::span<const std::int32_t> sizes) {
  check_polygons(points.size(), corners, sizes);
  Triangulation out;
  out.triangles.reserve(corners.size() - 2 * sizes.size());
  out.polygons.reserve(corners.size() - 2 * sizes.size());
  const std::int32_t* corner = corners.data();
  for (std::size_t p = 0; p < sizes.size(); corner += sizes[p++]) {
    const std::int32_t a = corner[0], b = corner[1], c = corner[2];
    if (sizes[p] == 3) {
      out.triangles.push_back({a, b, c});
    } else if (sizes[p] > 4) {
      cut_ears(points, {corner, index(sizes[p])}, out.triangles);
    } else if (const std::int32_t d = corner[3]; is_folded(points[a], points[b], points[c], points[d]) ||
                                                 (!can_be_cut(points[a], points[b], points[c], points[d]) &&
                                                  can_be_cut(points[b], points[c], points[d], points[a]))) {
      out.triangles.push_back({a, b, d});
      out.triangles.push_back({b, c, d});
    } else {
      out.triangles.push_back({a, b, c});
      out.triangles.push_back({a, c, d});
    }
    out.polygons.resize(out.triangles.size(), static_cast<std::int32_t>(p));
  }
  return out;
}

}  // namespace seamwire
