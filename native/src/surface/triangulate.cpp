// SPDX-License-Identifier: GPL-3.0-or-later
#include "seamwire/surface/triangulate.hpp"

#include <cstddef>
#include <string>
#include <utility>

#include "seamwire/errors.hpp"

namespace seamwire {
namespace {

/// Whether the triangles abc and acd look away from each other, by more than a right angle.
bool is_folded(const Vector& a, const Vector& b, const Vector& c, const Vector& d) {
  const Vector diagonal = c - a;
  return (b - a).cross(diagonal).dot((d - a).cross(diagonal)) > 0;
}

}  // namespace

CutPolygons cut_polygons(std::span<const Vector> points, std::span<const std::int32_t> corners,
                         std::span<const std::int32_t> sizes) {
  for (const std::int32_t v : corners) {
    if (v >= 0 && std::cmp_less(v, points.size())) continue;
    throw InvalidInput("corners: vertex " + std::to_string(v) + " is out of range: there are " +
                       std::to_string(points.size()) + " points");
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
  CutPolygons cut;
  cut.triangles.reserve(total - 2 * sizes.size());
  cut.polygons.reserve(total - 2 * sizes.size());
  const auto at = [&](std::int32_t v) -> const Vector& { return points[static_cast<std::size_t>(v)]; };
  const std::int32_t* corner = corners.data();
  for (std::size_t p = 0; p < sizes.size(); corner += sizes[p++]) {
    const std::int32_t a = corner[0], b = corner[1], c = corner[2];
    if (sizes[p] == 3) {
      cut.triangles.push_back({a, b, c});
    } else if (const std::int32_t d = corner[3]; is_folded(at(a), at(b), at(c), at(d))) {
      cut.triangles.push_back({a, b, d});
      cut.triangles.push_back({b, c, d});
    } else {
      cut.triangles.push_back({a, b, c});
      cut.triangles.push_back({a, c, d});
    }
    cut.polygons.resize(cut.triangles.size(), static_cast<std::int32_t>(p));
  }
  return cut;
}

}  // namespace seamwire
