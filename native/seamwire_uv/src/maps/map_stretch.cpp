// SPDX-License-Identifier: GPL-3.0-or-later
#include "seamwire_uv/maps/map_stretch.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "detail/index.hpp"

namespace seamwire {

using namespace detail;

namespace {

/// Octaves that count at most: a face without any UV area does not outweigh all others.
constexpr double kMostOctaves = 5.0;

/// Sums over the triangles of a polygon.
struct PolygonSums {
  double area = 0.0, uv_area = 0.0;
  double energy = 0.0;  // (s1 / s2 + s2 / s1) / 2, weighted by areas
};

PolygonSums sums_of(const Vector& one, const Vector& two, const std::array<Eigen::Vector2d, 3>& uvs) {
  static const double most = std::cosh(kMostOctaves * std::numbers::ln2);
  const double e = one.squaredNorm(), f = one.dot(two), g = two.squaredNorm();  // the first fundamental form
  const double twice = std::sqrt(std::max(e * g - f * f, 0.0));
  if (!(twice > 1e-12 * std::max(e, g))) return {};  // rounding decides
  const Eigen::Vector2d u = uvs[1] - uvs[0], v = uvs[2] - uvs[0];
  const double doubled = std::abs(u.x() * v.y() - u.y() * v.x());
  // trace / (2 det) of the map's squared lengths
  double energy = (g * u.squaredNorm() - 2.0 * f * u.dot(v) + e * v.squaredNorm()) / (2.0 * twice * doubled);
  if (!(energy < most)) energy = most;
  return {.area = 0.5 * twice, .uv_area = 0.5 * doubled, .energy = 0.5 * twice * energy};
}

}  // namespace

MapStretch map_stretch(std::span<const Vector> points, std::span<const Triangle> triangles,
                       std::span<const std::int32_t> polygons, std::span<const std::array<Eigen::Vector2d, 3>> uvs) {
  const std::size_t count = triangles.size();
  if (polygons.size() != count || uvs.size() != count) {
    throw InvalidInput("polygons and uvs have " + std::to_string(polygons.size()) + " and " +
                       std::to_string(uvs.size()) + " items: there are " + std::to_string(count) + " triangles");
  }
  std::vector<PolygonSums> sums;
  PolygonSums all;
  for (std::size_t t = 0; t < count; ++t) {
    for (const std::int32_t v : triangles[t]) check_index(v, points.size(), "triangles: vertex");
    const Vector& a = points[index(triangles[t][0])];
    const PolygonSums own = sums_of(points[index(triangles[t][1])] - a, points[index(triangles[t][2])] - a, uvs[t]);
    if (t == 0 || polygons[t] != polygons[t - 1]) sums.emplace_back();
    for (PolygonSums* to : {&sums.back(), &all}) {
      to->area += own.area;
      to->uv_area += own.uv_area;
      to->energy += own.energy;
    }
  }
  const double mean = all.uv_area > 0.0 ? all.area / all.uv_area : 1.0;
  MapStretch result{.angle = std::vector<double>(count, 0.0), .area = std::vector<double>(count, 0.0)};
  for (std::size_t t = 0, p = 0; t < count; ++t) {
    const bool is_first = t == 0 || polygons[t] != polygons[t - 1];
    const PolygonSums& own = sums[is_first ? p++ : p - 1];
    if (!is_first) {
      result.angle[t] = result.angle[t - 1];
      result.area[t] = result.area[t - 1];
    } else if (own.area > 0.0) {
      const double angle = std::acosh(std::max(own.energy / own.area, 1.0)) / std::numbers::ln2;
      result.angle[t] = std::min(angle, kMostOctaves);
      result.area[t] = std::clamp(std::log2(own.uv_area * mean / own.area), -kMostOctaves, kMostOctaves);
    }
  }
  return result;
}

}  // namespace seamwire
