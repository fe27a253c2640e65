// SPDX-License-Identifier: GPL-3.0-or-later
#include "cut/polygon_shape.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "cut/joined_pieces.hpp"
#include "cut/tolerances.hpp"
#include "cut/walk.hpp"
#include "detail/infinity.hpp"

namespace seamwire::detail {
namespace {

/// Whether a side has no length, or two sides lie on each other.
bool has_spike(std::span<const Vector> rim) {
  const std::size_t count = rim.size();
  double shortest = kInfinity, longest = 0.0;
  for (std::size_t i = 0; i < count; ++i) {
    const double length = (rim[(i + 1) % count] - rim[i]).norm();
    shortest = std::min(shortest, length);
    longest = std::max(longest, length);
  }
  if (shortest <= kFlat * longest) return true;
  for (std::size_t i = 0; i < count; ++i) {
    const Vector back = rim[(i + count - 1) % count] - rim[i], on = rim[(i + 1) % count] - rim[i];
    if (back.cross(on).norm() <= kFlat * back.norm() * on.norm() && back.dot(on) > 0.0) return true;
  }
  return false;
}

/// Whether a triangle that has an area is seen from behind or from the side along an axis, or none has an area.
bool is_seen_folded(const CutMesh& mesh, Rows rows, Eigen::Index axis, double sign) {
  bool any = false;
  for (std::int32_t row = rows.first; row < rows.last; ++row) {
    const std::array<Vector, 3> corners = mesh.corners_of_triangle(row);
    const Vector normal = (corners[1] - corners[0]).cross(corners[2] - corners[0]);
    const double seen = sign * normal[axis];
    if (seen < kSide * normal.norm()) return true;
    any = any || seen != 0.0;
  }
  return !any;
}

bool are_on(std::array<std::int32_t, 2> side, const CutNode& node) {
  return std::ranges::all_of(vertices_of(node), [&side](std::int32_t v) { return v == side[0] || v == side[1]; });
}

}  // namespace

std::optional<std::array<double, 2>> crossing_of(const Vector& a, const Vector& b, const Vector& c, const Vector& d) {
  const Vector u = b - a, v = d - c, w = c - a;
  const double area = u.x() * v.y() - u.y() * v.x();
  if (area == 0.0) return std::nullopt;
  const double s = (w.x() * v.y() - w.y() * v.x()) / area, t = (w.x() * u.y() - w.y() * u.x()) / area;
  if (!(0.0 <= s && s <= 1.0 && 0.0 <= t && t <= 1.0)) return std::nullopt;
  return std::array{s, t};
}

PolygonShape::PolygonShape(const CutMesh& mesh, const NodeTable& nodes, std::int32_t polygon)
    : mesh_(mesh), nodes_(nodes), polygon_(polygon), corners_(mesh.corners(polygon)) {
  for (const std::int32_t v : corners_) places_.push_back(mesh.points()[v]);
  const std::size_t count = places_.size();
  Vector normal = Vector::Zero();
  for (std::size_t i = 0; i < count; ++i) {
    normal += (places_[i] - places_[0]).cross(places_[(i + 1) % count] - places_[0]);
  }
  Eigen::Index axis = 0;
  normal.cwiseAbs().maxCoeff(&axis);
  const double sign = normal[axis] > 0.0 ? 1.0 : normal[axis] < 0.0 ? -1.0 : 0.0;
  is_folded_ = has_spike(places_) || is_seen_folded(mesh, mesh.rows_of(polygon), axis, sign);
  for (std::size_t i = 0; i < count; ++i) {
    if (is_folded_) {
      const double angle = 2.0 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(count);
      places_[i] = Vector(std::cos(angle), std::sin(angle), 0.0);
    } else {
      const Vector place = places_[i];
      places_[i] = Vector(place[axis == 0 ? 1 : 0], place[axis == 2 ? 1 : 2], 0.0);
    }
  }
}

bool PolygonShape::is_on_rim(std::int32_t node) const {
  const std::span<const std::int32_t> vertices = vertices_of(nodes_[node]);
  return vertices.size() == 1 || (vertices.size() == 2 && mesh_.is_side(polygon_, vertices[0], vertices[1]));
}

Vector PolygonShape::seen(std::int32_t node) const {
  return place_of(nodes_[node], [this](std::int32_t v) -> const Vector& { return place_of_corner(v); });
}

CutNode PolygonShape::node_at(const Vector& place) const {
  const Rows rows = mesh_.rows_of(polygon_);
  std::int32_t best = rows.first;
  Barycentric at{.weights = {}, .off = kInfinity};
  for (std::int32_t row = rows.first; row < rows.last; ++row) {
    const auto& [a, b, c] = mesh_.triangle(row);
    const Barycentric own = barycentric_in({place_of_corner(a), place_of_corner(b), place_of_corner(c)}, place);
    if (own.off < at.off) {
      at = own;
      best = row;
    }
  }
  return in_polygon(mesh_, polygon_, node_between(mesh_.triangle(best), at.weights, kCutNear), kCutNear);
}

std::ptrdiff_t PolygonShape::farthest(std::span<const std::int32_t> chain) const {
  const Vector begin = seen(chain.front()), along = seen(chain.back()) - begin;
  const double length = along.norm();
  std::ptrdiff_t worst = -1;
  double most = -1.0;
  for (std::size_t i = 1; i + 1 < chain.size(); ++i) {
    const Vector to = seen(chain[i]) - begin;
    const double off = std::abs(along.x() * to.y() - along.y() * to.x());
    if (off > most) {
      most = off;
      worst = static_cast<std::ptrdiff_t>(i);
    }
  }
  return most < kBend * length * length ? -1 : worst;
}

bool PolygonShape::holds_line(std::int32_t one, std::int32_t two) const {
  if (is_along_side(mesh_, nodes_, {one, two, polygon_})) return false;
  const Vector a = seen(one), b = seen(two);
  for (std::size_t i = 0; i < corners_.size(); ++i) {
    if (are_on(side(i), nodes_[one]) || are_on(side(i), nodes_[two])) continue;
    if (crossing_of(a, b, places_[i], places_[(i + 1) % places_.size()])) return false;
  }
  return holds(0.5 * (a + b));
}

bool PolygonShape::holds(const Vector& place) const {
  bool is_inside = false;
  for (std::size_t i = 0; i < places_.size(); ++i) {
    const Vector &a = places_[i], &b = places_[(i + 1) % places_.size()];
    if ((a.y() > place.y()) != (b.y() > place.y()) &&
        place.x() < a.x() + (place.y() - a.y()) * (b.x() - a.x()) / (b.y() - a.y())) {
      is_inside = !is_inside;
    }
  }
  return is_inside;
}

}  // namespace seamwire::detail
