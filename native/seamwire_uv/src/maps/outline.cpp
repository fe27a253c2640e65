// SPDX-License-Identifier: GPL-3.0-or-later
#include "maps/outline.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "detail/index.hpp"
#include "detail/poll.hpp"
#include "maps/coverage.hpp"
#include "maps/strip_tree.hpp"

namespace seamwire::detail {
namespace {

constexpr double kBarrierWeight = 1e-3;

const double* at(std::span<const double> map, std::int32_t v) { return map.data() + 2 * index(v); }

/// A point's distance from an edge, and how far along the edge its nearest point is, from 0 to 1.
struct Nearest {
  double distance, along, x, y;  // x, y: from the nearest point to the point
};
Nearest nearest_on_edge(const double* point, const double* a, const double* b) {
  const double dx = b[0] - a[0], dy = b[1] - a[1], px = point[0] - a[0], py = point[1] - a[1];
  const double squared = dx * dx + dy * dy;
  const double along = squared > 0.0 ? std::clamp((px * dx + py * dy) / squared, 0.0, 1.0) : 0.0;
  const double x = px - along * dx, y = py - along * dy;
  return {std::sqrt(x * x + y * y), along, x, y};
}

}  // namespace

Outline::Outline(const std::vector<std::vector<std::int32_t>>& boundaries, double reach) : reach_(reach) {
  for (const std::vector<std::int32_t>& loop : boundaries) {
    for (std::size_t i = 0; i < loop.size(); ++i) edges_.push_back({loop[i], loop[(i + 1) % loop.size()]});
    loop_sizes_.push_back(loop.size());
  }
}

bool Outline::covers_twice(std::span<const double> map, double tolerance, const Task& task) const {
  std::vector<OutlineSide> sides;
  sides.reserve(edges_.size());
  for (const auto& [a, b] : edges_) {
    sides.push_back({{at(map, a)[0], at(map, a)[1]}, {at(map, b)[0], at(map, b)[1]}, a, b});
  }
  Poll poll(task, 0.0, 0.0, 1);
  const PieceOutline piece(std::move(sides), loop_sizes_, {0.0, 0.0}, 0.0, poll);
  return piece.overlaps(piece, tolerance, poll);
}

/// Calls visit(vertex, edge) for the vertices and edges that may be closer than `reach`, on their ways by `most` times
/// a direction.
template <class Visit>
void Outline::for_each_close(std::span<const double> map, std::span<const double> direction, double most, double reach,
                             const Visit& visit) const {
  std::vector<Eigen::Vector2d> points;
  for (const Edge& edge : edges_) {
    for (const std::int32_t v : edge) {
      points.emplace_back(at(map, v)[0], at(map, v)[1]);
      if (most > 0.0)
        points.emplace_back(points.back() + most * Eigen::Vector2d(at(direction, v)[0], at(direction, v)[1]));
    }
  }
  const Task task;
  Poll poll(task, 0.0, 0.0, 1);
  const StripTree tree(points, most > 0.0 ? 4 : 2, poll);
  constexpr auto kSkipsNothing = [](const StripTree::Part&, const StripTree::Part&) { return false; };
  const auto visit_vertex = [&](const Edge& one, const Edge& other) {
    const Pair pair{one[0], other[0], other[1]};
    if (pair.vertex != pair.a && pair.vertex != pair.b) visit(pair);
  };
  ClosePairs(tree, tree, reach, kSkipsNothing, poll).any([&](std::int32_t e, std::int32_t other) {
    visit_vertex(edges_[index(e)], edges_[index(other)]);
    visit_vertex(edges_[index(other)], edges_[index(e)]);
    return false;
  });
}

std::vector<Outline::Pair> Outline::close_pairs(std::span<const double> map, double factor) const {
  std::vector<Pair> pairs;
  for_each_close(map, {}, 0.0, factor * reach_, [&](const Pair& pair) {
    const double distance = nearest_on_edge(at(map, pair.vertex), at(map, pair.a), at(map, pair.b)).distance;
    if (distance < factor * reach_) pairs.push_back(pair);
  });
  return pairs;
}

double Outline::energy(std::span<const double> map) const {
  double sum = 0.0;
  for (const Pair& pair : close_pairs(map, 1.0)) {
    const double distance = nearest_on_edge(at(map, pair.vertex), at(map, pair.a), at(map, pair.b)).distance;
    const double excess = reach_ / distance - 1.0;
    sum += excess * excess;
  }
  return kBarrierWeight * sum;
}

Outline::Slope Outline::slope(const Pair& pair, std::span<const double> map) const {
  const Nearest near = nearest_on_edge(at(map, pair.vertex), at(map, pair.a), at(map, pair.b));
  const double x = near.x / near.distance, y = near.y / near.distance, back = 1.0 - near.along;
  const double ratio = reach_ / near.distance;
  Slope slope{{x, y, -back * x, -back * y, -near.along * x, -near.along * y}, 0.0, 0.0, {}};
  if (ratio <= 1.0) return slope;
  slope.first = -2.0 * kBarrierWeight * (ratio - 1.0) * ratio / near.distance;
  slope.second = kBarrierWeight * (6.0 * ratio - 4.0) * ratio / (near.distance * near.distance);
  if (!(near.along > 0.0 && near.along < 1.0)) return slope;
  // If the vertex slides by s along the edge, and the edge turns by u towards the vertex's other side, the distance d
  // changes by -s u - d u^2 / 2 in second order. In the unit vectors of s and u, the energy's Hessian is [0 b; b c].
  const double dx = at(map, pair.b)[0] - at(map, pair.a)[0], dy = at(map, pair.b)[1] - at(map, pair.a)[1];
  const double length = std::sqrt(dx * dx + dy * dy), way = std::sqrt(1.0 + back * back + near.along * near.along);
  const double b = -slope.first * way * std::numbers::sqrt2 / length;
  const double c = -slope.first * 2.0 * near.distance / (length * length);
  const double eigenvalue = 0.5 * (c + std::sqrt(c * c + 4.0 * b * b));
  const double scale = std::sqrt(eigenvalue / (b * b + eigenvalue * eigenvalue));
  const double slide = scale * b / way, turn = scale * eigenvalue / std::numbers::sqrt2;
  // The direction of the edge for which the normal (x, y) is to its left.
  const double tx = y, ty = -x, sign = tx * dx + ty * dy > 0.0 ? 1.0 : -1.0;
  slope.turning = {slide * tx,
                   slide * ty,
                   -back * slide * tx - sign * turn * x,
                   -back * slide * ty - sign * turn * y,
                   -near.along * slide * tx + sign * turn * x,
                   -near.along * slide * ty + sign * turn * y};
  return slope;
}

double Outline::first_contact(std::span<const double> map, std::span<const double> direction, double most) const {
  double least = most;
  const auto try_pair = [&](const Pair& pair) {
    const auto& [vertex, a, b] = pair;
    const auto difference = [](const double* to, const double* from) {
      return std::array<double, 2>{to[0] - from[0], to[1] - from[1]};
    };
    const auto cross = [](const std::array<double, 2>& m, const std::array<double, 2>& n) {
      return m[0] * n[1] - m[1] * n[0];
    };
    const auto side = difference(at(map, b), at(map, a)), off = difference(at(map, vertex), at(map, a));
    const auto side_move = difference(at(direction, b), at(direction, a));
    const auto off_move = difference(at(direction, vertex), at(direction, a));
    // The vertex is in line with the edge at the roots of a quadratic polynomial.
    const double c0 = cross(side, off), c2 = cross(side_move, off_move);
    const double c1 = cross(side, off_move) + cross(side_move, off);
    const double discriminant = c1 * c1 - 4.0 * c0 * c2;
    if (discriminant < 0.0) return;
    const double sum = -0.5 * (c1 + std::copysign(std::sqrt(discriminant), c1));
    for (const double root : {sum / c2, c0 / sum}) {
      if (!(root > 0.0 && root < least)) continue;
      const std::array<double, 2> s{side[0] + root * side_move[0], side[1] + root * side_move[1]};
      const std::array<double, 2> o{off[0] + root * off_move[0], off[1] + root * off_move[1]};
      const double along = s[0] * o[0] + s[1] * o[1], squared = s[0] * s[0] + s[1] * s[1];
      constexpr double kSlack = 1e-6;  // of the edge's length, for rounding
      if (along >= -kSlack * squared && along <= (1.0 + kSlack) * squared) least = root;
    }
  };
  for_each_close(map, direction, most, 0.0, try_pair);
  return least;
}

}  // namespace seamwire::detail
