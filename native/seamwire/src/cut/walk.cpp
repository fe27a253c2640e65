// SPDX-License-Identifier: GPL-3.0-or-later
#include "cut/walk.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>
#include <queue>
#include <set>
#include <span>
#include <tuple>
#include <utility>

#include "cut/tolerances.hpp"
#include "detail/index.hpp"
#include "detail/infinity.hpp"
#include "surface/point_segment.hpp"

namespace seamwire::detail {
namespace {

/// The cost of a step over a triangle in a single point, which is how a curve passes triangles without area. Costs are
/// added to how far points are from triangles, as part of their longest sides.
constexpr double kHop = 1e-3;
/// The cost of a step over a triangle in which the curve has no point. Curves found on other triangles need such steps.
constexpr double kStraight = 1e-2;
/// The cost of a step from one triangle of a polygon to another: between them, the polygon may not be there.
constexpr double kLeap = 0.25;
/// The extra cost allowed for a walk that ends at the requested vertex instead of another point in the same place.
constexpr double kReach = 0.1;

double longest_side(const std::array<Vector, 3>& corners) {
  return std::sqrt(std::max({(corners[1] - corners[0]).squaredNorm(), (corners[2] - corners[1]).squaredNorm(),
                             (corners[0] - corners[2]).squaredNorm()}));
}

/// A node where a place lies.
struct Found {
  double off = 0.0;  ///< how far the triangle is from the place, as part of its longest side, beyond rounding
  std::int32_t polygon = -1, row = -1;
  CutNode on;
};

/// Adds what a place lies on in a triangle: vertices, edges between whose ends it lies, or otherwise the place inside.
void find_in_triangle(const CutMesh& mesh, std::int32_t row, const Vector& place, std::vector<Found>& found) {
  const std::array<Vector, 3> corners = mesh.corners_of_triangle(row);
  const double longest = longest_side(corners);
  const Barycentric inside = barycentric_in(corners, place);
  std::array<double, 3> gaps{};
  for (std::size_t i = 0; i < 3; ++i) gaps[i] = to_segment(place, corners[i], corners[(i + 1) % 3]).norm();
  double away = std::ranges::min(gaps);
  if (std::isfinite(inside.off)) away = std::min(away, inside.off * longest);
  if (!(away <= kOff * longest)) return;
  const double reach = away + kOn * longest;
  const double off = longest > 0.0 ? std::max(0.0, away / longest - kOn) : 0.0;
  const std::int32_t polygon = mesh.polygon_of(row);
  const Triangle& triangle = mesh.triangle(row);
  const auto add = [&](const CutNode& node) {
    found.push_back({.off = off, .polygon = polygon, .row = row, .on = in_polygon(mesh, polygon, node, kOn)});
  };
  std::array<bool, 3> is_at{};
  bool is_on_rim = false;
  for (std::size_t i = 0; i < 3; ++i) {
    is_at[i] = (corners[i] - place).norm() <= reach;
    if (is_at[i]) add(node_at_vertex(triangle[i]));
    is_on_rim = is_on_rim || is_at[i];
  }
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t j = (i + 1) % 3;
    if (!(gaps[i] <= reach) || is_at[i] || is_at[j]) continue;
    const double part = nearest_on_segment(place, corners[i], corners[j]);
    add(node_between(std::array{triangle[i], triangle[j]}, std::array{1.0 - part, part}));
    is_on_rim = true;
  }
  if (!is_on_rim) add(node_between(triangle, inside.weights));
}

std::vector<Found> find_in(const CutMesh& mesh, std::span<const std::int32_t> polygons, const Vector& place) {
  std::vector<Found> found;
  for (const std::int32_t polygon : polygons) {
    const Rows rows = mesh.rows_of(polygon);
    for (std::int32_t row = rows.first; row < rows.last; ++row) find_in_triangle(mesh, row, place, found);
  }
  return found;
}

/// A node as the vertex, or on the edge, that it is near to.
CutNode moved(const CutMesh& mesh, const CutNode& on) {
  const CutNode node = node_between(vertices_of(on), on.weights, kCutNear);
  return on.polygon < 0 ? node : in_polygon(mesh, on.polygon, node, kCutNear);
}

std::vector<std::int32_t> polygons_beside(const CutMesh& mesh, const CutNode& on) {
  if (on.polygon >= 0) return {on.polygon};
  std::vector<std::int32_t> around = mesh.polygons_at(on.vertices[0]);
  if (on.vertices[1] >= 0) {
    std::erase_if(around, [&](std::int32_t one) { return !mesh.is_side(one, on.vertices[0], on.vertices[1]); });
  }
  return around;
}

bool has_vertices(std::span<const std::int32_t> corners, const CutNode& node) {
  return std::ranges::all_of(vertices_of(node),
                             [&corners](std::int32_t v) { return std::ranges::find(corners, v) != corners.end(); });
}

/// The node of a curve's end. nullopt if only a vertex beside it is known.
std::optional<CutNode> end_node(const CutMesh& mesh, const SurfacePoint& end, const Vector& place) {
  if (end.vertex < 0) {
    const std::int32_t polygon = mesh.polygon_of(end.face);
    return in_polygon(mesh, polygon, node_between(mesh.triangle(end.face), end.barycentric, kOn), kOn);
  }
  const CutNode own = node_at_vertex(end.vertex);
  const std::vector<Found> found = find_in(mesh, mesh.polygons_at(end.vertex), place);
  const bool is_there = std::ranges::any_of(found, [&own](const Found& at) { return at.off == 0.0 && at.on == own; });
  return is_there ? std::optional(own) : std::nullopt;
}

/// A vertex that is, or is near, the point of a surface.
std::int32_t vertex_near(const CutMesh& mesh, const SurfacePoint& point) {
  if (point.vertex >= 0) return point.vertex;
  const auto most = std::ranges::max_element(point.barycentric) - point.barycentric.begin();
  return mesh.triangle(point.face)[static_cast<std::size_t>(most)];
}

/// Where the way from a place in a triangle towards another place leaves the triangle. nullopt if it does not cross it.
std::optional<Vector> exit_of(const std::array<Vector, 3>& corners, const Vector& place, const Vector& goal) {
  using Weights = Eigen::Array3d;
  const Vector u = corners[1] - corners[0], v = corners[2] - corners[0], normal = u.cross(v);
  const double square = normal.squaredNorm();
  const double longest = std::max({u.squaredNorm(), v.squaredNorm(), (u - v).squaredNorm()});
  if (square <= kFlat * longest * kFlat * longest) return std::nullopt;
  const auto coordinates = [&](const Vector& w) -> Weights {
    const double s = w.cross(v).dot(normal) / square, t = u.cross(w).dot(normal) / square;
    return {-s - t, s, t};
  };
  const auto at = [&corners](const Weights& weights) -> Vector {
    return weights[0] * corners[0] + weights[1] * corners[1] + weights[2] * corners[2];
  };
  const Weights raw = Weights(1.0, 0.0, 0.0) + coordinates(place - corners[0]);
  const Weights slope = coordinates(goal - place), own = raw.max(0.0);
  if (raw.minCoeff() < -kOff || (at(own) - place).norm() > kOff * std::sqrt(longest)) return std::nullopt;
  double part = 1.0;
  for (int i = 0; i < 3; ++i) {
    if (!(slope[i] < -kOn)) continue;
    if (own[i] <= kOn) return std::nullopt;
    part = std::min(part, own[i] / -slope[i]);
  }
  if (part >= 1.0) return std::nullopt;
  const Weights there = (own + part * slope).max(0.0);
  return at(there / there.sum());
}

/// How far a walk along a curve has come.
struct Step {
  std::size_t number = 0;  ///< the curve's point that it heads for
  CutNode on;              ///< where it is: a vertex, on an edge or inside a polygon
  Vector place;            ///< the same in space
  /// The node there, which may have been moved away from the place. nullopt before the first point.
  std::optional<CutNode> here;
  std::int32_t trail = -1;  ///< the last piece up to there
};

class Walker {
 public:
  Walker(const CutMesh& mesh, const CutCurve& curve, NodeTable& nodes, const Task& task)
      : mesh_(mesh), curve_(curve), nodes_(nodes), task_(task) {}

  /// Returns the pieces if the curve runs in the triangles that it names. Two segments meet in a node of both
  /// triangles.
  std::optional<std::vector<Piece>> in_named_triangles() {
    const std::vector<std::int32_t>& faces = curve_.faces;
    const auto is_row = [this](std::int32_t row) { return is_index(row, mesh_.triangle_count()); };
    if (faces.empty() || !std::ranges::all_of(faces, is_row)) return std::nullopt;
    std::vector<CutNode> passed;
    std::vector<Found> before, here;
    for (std::size_t i = 0; i < curve_.points.size(); ++i) {
      task_.check(0.0);
      const bool is_last = i == faces.size();
      const std::int32_t row = faces[is_last ? i - 1 : i];
      std::optional<CutNode> on;
      if (i == 0 || is_last) {
        if (i == 0 || curve_.end) on = end_node(mesh_, i == 0 ? curve_.start : *curve_.end, curve_.points[i]);
        const std::int32_t polygon = mesh_.polygon_of(row);
        if (on && !(on->polygon < 0 ? has_vertices(mesh_.corners(polygon), *on) : on->polygon == polygon)) {
          return std::nullopt;
        }
      }
      here.clear();
      find_in_triangle(mesh_, row, curve_.points[i], here);
      std::erase_if(here, [](const Found& at) { return at.off > 0.0; });
      if (i > 0 && !is_last && faces[i - 1] != row) {
        before.clear();
        find_in_triangle(mesh_, faces[i - 1], curve_.points[i], before);
        std::erase_if(here, [&before](const Found& at) {
          return std::ranges::none_of(before, [&at](const Found& other) {
            return other.off == 0.0 && other.on.vertices == at.on.vertices && other.on.polygon == at.on.polygon;
          });
        });
      }
      if (here.empty()) return std::nullopt;
      passed.push_back(moved(mesh_, on ? *on : here.front().on));
    }
    std::vector<Piece> found;
    for (std::size_t i = 0; i < faces.size(); ++i) {
      if (passed[i] == passed[i + 1]) continue;
      found.push_back({nodes_.add(passed[i]), nodes_.add(passed[i + 1]), mesh_.polygon_of(faces[i])});
    }
    return found;
  }

  Walk cheapest() {
    const std::vector<Vector>& points = curve_.points;
    const std::optional<CutNode> first = end_node(mesh_, curve_.start, points.front());
    std::optional<CutNode> goal;
    if (curve_.end) goal = end_node(mesh_, *curve_.end, points.back());
    Step begin{.number = first ? 1U : 0U,
               .on = first ? *first : node_at_vertex(vertex_near(mesh_, curve_.start)),
               .place = points.front(),
               .here = std::nullopt};
    if (first) begin.here = moved(mesh_, *first);
    steps_.push_back(begin);
    push(0.0, 0, 0);
    std::int32_t farthest = 0, arrived = -1;
    double most = kInfinity;
    std::set<std::tuple<std::size_t, std::array<std::int32_t, 3>, std::int32_t>> done;
    while (!queue_.empty()) {
      task_.check(0.0);
      const Waiting next = queue_.top();
      queue_.pop();
      if (next.cost > most) break;
      const Step step = steps_[next.step];
      if (next.way == 0) {
        if (!done.emplace(step.number, step.on.vertices, step.on.polygon).second) continue;
        if (step.number > steps_[farthest].number) farthest = next.step;
        if (step.number == points.size()) {
          if (!goal || step.on.vertices == goal->vertices) return {.pieces = pieces(step.trail)};
          // Several vertices and edges may lie in one place: the requested one may be found a little later, or never.
          if (arrived < 0) {
            arrived = next.step;
            most = next.cost + kReach;
          }
        }
      }
      go_on(next.cost, step, next.way);
      // Most walks need only the first way on. The others are tried only when the walk has come to their cost.
      if (next.way < 2 && step.here) push(next.cost + (next.way == 0 ? kHop : kStraight), next.step, next.way + 1);
    }
    if (arrived < 0) return {.pieces = {}, .left_near = steps_[farthest].on.vertices[0]};
    return {.pieces = pieces(steps_[arrived].trail)};
  }

 private:
  struct Trail {
    CutNode one, two;
    std::int32_t polygon, before;
  };
  struct Waiting {
    double cost;
    std::size_t number;
    std::int32_t order, step;
    int way;  ///< the next way on to try; see go_on()
    bool operator>(const Waiting& other) const {
      return std::tuple(cost, other.number, order) > std::tuple(other.cost, number, other.order);
    }
  };

  void push(double cost, std::int32_t step, int way) { queue_.push({cost, steps_[step].number, order_++, step, way}); }

  void push_step(double cost, const Step& from, std::size_t number, std::int32_t polygon, const CutNode& on,
                 const Vector& place) {
    Step step{.number = number, .on = on, .place = place, .here = moved(mesh_, on), .trail = from.trail};
    if (from.here && *step.here != *from.here) {
      step.trail = static_cast<std::int32_t>(trails_.size());
      trails_.push_back({.one = *from.here, .two = *step.here, .polygon = polygon, .before = from.trail});
    }
    steps_.push_back(std::move(step));
    push(cost, static_cast<std::int32_t>(steps_.size()) - 1, 0);
  }

  void go_on(double cost, const Step& step, int way) {
    if (way == 0) {
      forward(cost, step);
    } else if (way == 1) {
      in_place(cost, step);
    } else {
      straight_on(cost, step);
    }
  }

  /// Adds the steps to the curve's next point in a polygon beside.
  void forward(double cost, const Step& step) {
    if (step.number == curve_.points.size()) return;
    const Vector& place = curve_.points[step.number];
    for (const Found& at : find_in(mesh_, polygons_beside(mesh_, step.on), place)) {
      const double leap = step.here && !is_in(at.row, step) ? kLeap : 0.0;
      push_step(cost + at.off + leap, step, step.number + 1, at.polygon, at.on, place);
    }
  }

  /// Adds the steps to other vertices and edges of the polygons beside that lie in the same place.
  void in_place(double cost, const Step& step) {
    for (const Found& at : find_in(mesh_, polygons_beside(mesh_, step.on), step.place)) {
      if (at.on.polygon >= 0 || at.on.vertices == step.on.vertices) continue;
      push_step(cost + at.off, step, step.number, at.polygon, at.on, step.place);
    }
  }

  /// Adds the steps toward the curve's next point to where that way leaves a triangle beside.
  void straight_on(double cost, const Step& step) {
    if (step.number == 0 || step.number == curve_.points.size()) return;
    const Vector &goal = curve_.points[step.number], &before = curve_.points[step.number - 1];
    std::vector<Found> found;
    for (const std::int32_t polygon : polygons_beside(mesh_, step.on)) {
      const Rows rows = mesh_.rows_of(polygon);
      for (std::int32_t row = rows.first; row < rows.last; ++row) {
        const std::array<Vector, 3> corners = mesh_.corners_of_triangle(row);
        const std::optional<Vector> exit = exit_of(corners, step.place, goal);
        if (!exit || (goal - *exit).norm() >= (goal - step.place).norm()) continue;
        const double gap = to_segment(*exit, before, goal).norm(), longest = longest_side(corners);
        if (gap > kOff * longest) continue;
        found.clear();
        find_in_triangle(mesh_, row, *exit, found);
        for (const Found& at : found) {
          push_step(cost + at.off + gap / longest, step, step.number, polygon, at.on, *exit);
        }
      }
    }
  }

  bool is_in(std::int32_t row, const Step& step) const {
    if (has_vertices(mesh_.triangle(row), step.on)) return true;
    std::vector<Found> found;
    find_in_triangle(mesh_, row, step.place, found);
    return std::ranges::any_of(found, [](const Found& at) { return at.off == 0.0; });
  }

  std::vector<Piece> pieces(std::int32_t trail) const {
    std::vector<const Trail*> found;
    for (; trail >= 0; trail = trails_[trail].before) found.push_back(&trails_[trail]);
    std::ranges::reverse(found);
    std::vector<Piece> pieces;
    for (const Trail* one : found) pieces.push_back({nodes_.add(one->one), nodes_.add(one->two), one->polygon});
    return pieces;
  }

  const CutMesh& mesh_;
  const CutCurve& curve_;
  NodeTable& nodes_;
  const Task& task_;
  std::vector<Step> steps_;
  std::vector<Trail> trails_;
  std::priority_queue<Waiting, std::vector<Waiting>, std::greater<>> queue_;
  std::int32_t order_ = 0;  // of steps that cost the same the older one is first
};

}  // namespace

Barycentric barycentric_in(const std::array<Vector, 3>& corners, const Vector& point) {
  const Vector u = corners[1] - corners[0], v = corners[2] - corners[0], w = point - corners[0];
  const double uu = u.dot(u), uv = u.dot(v), vv = v.dot(v), uw = u.dot(w), vw = v.dot(w);
  const double area = uu * vv - uv * uv;
  const double s = (vv * uw - uv * vw) / area, t = (uu * vw - uv * uw) / area;
  Barycentric found{.weights = {1.0 - s - t, s, t}, .off = kInfinity};
  double sum = 0.0;
  for (double& weight : found.weights) {
    if (weight < 0.0) weight = 0.0;
    sum += weight;
  }
  Vector place = Vector::Zero();
  for (std::size_t i = 0; i < 3; ++i) {
    found.weights[i] /= sum;
    place += found.weights[i] * corners[i];
  }
  const double off = (place - point).norm() / std::sqrt(std::max({uu, vv, uu - 2.0 * uv + vv}));
  if (std::isfinite(off)) found.off = off;
  return found;
}

Walk walk_along(const CutMesh& mesh, const CutCurve& curve, NodeTable& nodes, const Task& task) {
  Walker walker(mesh, curve, nodes, task);
  if (std::optional<std::vector<Piece>> found = walker.in_named_triangles()) return {.pieces = std::move(*found)};
  return walker.cheapest();
}

}  // namespace seamwire::detail
