// SPDX-License-Identifier: GPL-3.0-or-later
#include "maps/upright.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include "detail/index.hpp"
#include "detail/infinity.hpp"

namespace seamwire::detail {

namespace {

/// The mean projection of the up direction is at least this long where an island has an up. That is a plane that rises
/// by 14 degrees.
constexpr double kLeastUp = 0.25;

/// The mean of a direction's projection to the surface, in the map. It is at most about as long as the direction.
Point2 mean_direction(const Island& island, std::span<const Vector> points, const Vector& up,
                      const std::vector<Point2>& map) {
  Point2 sum = Point2::Zero();
  double area = 0.0;
  for (const Triangle& t : island.triangles) {
    const auto point = [&](std::size_t i) -> const Vector& { return points[index(island.vertices[index(t[i])])]; };
    const Vector one = point(1) - point(0), two = point(2) - point(0), normal = one.cross(two);
    const double doubled = normal.stableNorm();
    if (!(doubled > 0.0)) continue;
    const Vector unit = normal / doubled;
    sum += up.cross(two).dot(unit) * (map[t[1]] - map[t[0]]) + one.cross(up).dot(unit) * (map[t[2]] - map[t[0]]);
    area += doubled;
  }
  return area > 0.0 ? Point2(sum / area) : Point2(Point2::Zero());
}

double cross(const Point2& one, const Point2& other) { return one.x() * other.y() - one.y() * other.x(); }

/// Turns a map such that a direction points to +v.
void turn(std::vector<Point2>& map, const Point2& up) {
  for (Point2& uv : map) uv = Point2(up.y() * uv.x() - up.x() * uv.y(), up.x() * uv.x() + up.y() * uv.y());
}

/// Whether all triangles are counter-clockwise.
bool is_sound(const Island& island, const std::vector<Point2>& map) {
  return std::ranges::all_of(
      island.triangles, [&](const Triangle& t) { return cross(map[t[1]] - map[t[0]], map[t[2]] - map[t[0]]) > 0.0; });
}

Point2 along_axis(const Point2& direction) {
  if (std::abs(direction.x()) > std::abs(direction.y())) return {std::copysign(1.0, direction.x()), 0.0};
  return {0.0, std::copysign(1.0, direction.y())};
}

}  // namespace

std::vector<Point2> convex_hull(std::vector<Point2> points) {
  std::ranges::sort(
      points, [](const Point2& a, const Point2& b) { return a.x() < b.x() || (a.x() == b.x() && a.y() < b.y()); });
  std::vector<Point2> hull;
  for (int half = 0; half < 2; ++half) {
    const std::size_t begin = hull.size();
    for (const Point2& p : points) {
      while (hull.size() >= begin + 2 && cross(hull.back() - hull[hull.size() - 2], p - hull.back()) <= 0.0) {
        hull.pop_back();
      }
      hull.push_back(p);
    }
    hull.pop_back();  // the other half starts with it
    std::ranges::reverse(points);
  }
  return hull;
}

Point2 longest_direction(const std::vector<Point2>& points) {
  const std::vector<Point2> hull = convex_hull(points);
  Point2 best = Point2::Zero();
  double least = kInfinity;
  // Three points go around the hull with each edge: the farthest along it, across it, and back along it.
  std::size_t front = 1, top = 1, back = 1;
  const std::size_t count = hull.size();
  for (std::size_t i = 0; i < count; ++i) {
    const Point2 edge = hull[(i + 1) % count] - hull[i];
    const double length = edge.norm();
    if (!(length > 0.0)) continue;
    const Point2 along = edge / length, across(-along.y(), along.x());
    const auto advance = [&](std::size_t from, const Point2& direction) {
      for (std::size_t k = 0; k < count; ++k, ++from) {
        if (!(direction.dot(hull[(from + 1) % count] - hull[from % count]) > 0.0)) break;
      }
      return from;
    };
    front = advance(std::max(front, i + 1), along);
    top = advance(std::max(top, front), across);
    back = advance(std::max(back, top), -along);
    const double width = along.dot(hull[front % count] - hull[back % count]);
    const double height = across.dot(hull[top % count] - hull[i]);
    if (!(width * height < least * (1.0 - 1e-9))) continue;
    least = width * height;
    best = width >= height ? along : across;
  }
  return best;
}

void turn_upright(const Island& island, std::span<const Vector> points, const Vector& up, bool is_straight,
                  std::vector<Point2>& map) {
  Point2 direction = mean_direction(island, points, up.stableNormalized(), map);
  if (!(direction.norm() >= kLeastUp)) direction = longest_direction(map);
  if (!(direction.norm() > 0.0)) return;
  if (!is_straight) {
    std::vector<Point2> turned = map;
    turn(turned, direction.normalized());
    // Rounding may turn tiny triangles over. Turns by 90 degrees are exact.
    if (is_sound(island, turned)) {
      map = std::move(turned);
      return;
    }
  }
  turn(map, along_axis(direction));
}

void turn_by_quarters(const std::vector<Point2>& other, std::vector<Point2>& map) {
  Point2 best = Point2::Zero();  // sine and cosine of the best turn (Kabsch 1976, in the plane)
  for (std::size_t i = 0; i < map.size(); ++i) best += Point2(cross(map[i], other[i]), map[i].dot(other[i]));
  turn(map, along_axis(best));
}

}  // namespace seamwire::detail
