// SPDX-License-Identifier: GPL-3.0-or-later
#include "seams/curve_crossings.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "surface/exact_unit.hpp"

namespace seamwire {
namespace {

/// A part of the face within which a point counts as on a segment, by areas.
constexpr double kRounding = 1e-9;

struct Segment {
  std::int32_t face;
  std::size_t choice;
  const Vector* from;
  const Vector* to;
};

bool cross(const Surface& surface, const Segment& one, const Segment& two) {
  const Triangle& corners = surface.triangles()[one.face];
  const Vector& origin = surface.points()[corners[0]];
  const double unit = exact_unit(surface);
  const auto scaled = [&](const Vector& from, const Vector& to) { return Vector(unit * (to - from)); };
  const Vector normal =
      scaled(origin, surface.points()[corners[1]]).cross(scaled(origin, surface.points()[corners[2]]));
  const double twice_area = normal.norm();
  if (!(twice_area > 0.0)) return false;
  // Twice the area of a triangle of three points, by which side the third one lies on.
  const auto side = [&](const Vector& a, const Vector& b, const Vector& c) {
    return normal.dot(scaled(a, b).cross(scaled(a, c))) / twice_area;
  };
  const auto are_apart = [&](const Segment& line, const Segment& ends) {
    const double from = side(*line.from, *line.to, *ends.from), to = side(*line.from, *line.to, *ends.to);
    return std::min(std::abs(from), std::abs(to)) > kRounding * twice_area && (from > 0.0) != (to > 0.0);
  };
  return are_apart(one, two) && are_apart(two, one);
}

}  // namespace

std::size_t curve_crossings(const Surface& surface, std::span<const Choice> choices) {
  std::vector<Segment> segments;
  for (std::size_t i = 0; i < choices.size(); ++i) {
    const PlannedWire& wire = choices[i].wire;
    for (std::size_t k = 0; k < wire.faces.size(); ++k) {
      if (wire.faces[k] < 0) continue;
      segments.push_back({.face = wire.faces[k], .choice = i, .from = &wire.points[k], .to = &wire.points[k + 1]});
    }
  }
  std::ranges::sort(segments, {}, &Segment::face);
  std::size_t count = 0;
  for (std::size_t i = 0; i < segments.size(); ++i) {
    for (std::size_t k = i + 1; k < segments.size() && segments[k].face == segments[i].face; ++k) {
      if (segments[i].choice != segments[k].choice && cross(surface, segments[i], segments[k])) ++count;
    }
  }
  return count;
}

}  // namespace seamwire
