// SPDX-License-Identifier: GPL-3.0-or-later
#include "seamwire/surface/triangulate.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cstddef>
#include <string>

#include "detail/index.hpp"
#include "seamwire/errors.hpp"

namespace seamwire {

using namespace detail;

namespace {

/// How near to its longest side a triangle's corner is where the triangle has no area, as part of that side: vertices
/// are placed on edges in single precision.
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

}  // namespace

Triangulation triangulate(std::span<const Vector> points, std::span<const std::int32_t> corners,
                          std::span<const std::int32_t> sizes) {
  for (const std::int32_t v : corners) {
    check_index(v, points.size(), "corners: vertex", "points");
  }
  std::size_t total = 0;
  for (std::size_t p = 0; p < sizes.size(); ++p) {
    total += static_cast<std::size_t>(sizes[p]);
    if (sizes[p] == 3 || sizes[p] == 4) continue;
    throw InvalidInput("sizes: polygon " + std::to_string(p) + " has " + std::to_string(sizes[p]) +
                       " corners, neither 3 nor 4");
  }
  if (total != corners.size()) {
    throw InvalidInput("sizes: they add up to " + std::to_string(total) + ", but there are " +
                       std::to_string(corners.size()) + " corners");
  }
  Triangulation out;
  out.triangles.reserve(total - 2 * sizes.size());
  out.polygons.reserve(total - 2 * sizes.size());
  const std::int32_t* corner = corners.data();
  for (std::size_t p = 0; p < sizes.size(); corner += sizes[p++]) {
    const std::int32_t a = corner[0], b = corner[1], c = corner[2];
    if (sizes[p] == 3) {
      out.triangles.push_back({a, b, c});
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
