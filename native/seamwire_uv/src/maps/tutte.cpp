// SPDX-License-Identifier: GPL-3.0-or-later
#include "maps/tutte.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <tuple>
#include <utility>

#include "detail/csr.hpp"
#include "detail/index.hpp"
#include "detail/infinity.hpp"
#include "graph/shortest_paths.hpp"

namespace seamwire::detail {
namespace {

constexpr double kLeastWeight = 0.1, kGreatestWeight = 10.0;
/// An outline edge takes at least this part of the mean edge's share of the outline.
constexpr double kLeastShareOfOutline = 0.01;
/// An island is long if the square of its length is more than so many times its area.
constexpr double kLong = 100.0;
/// How far the sides of a rectangle are curved outwards, in half its width. No three of its points lie in a line.
constexpr double kBulge = 0.1;

struct Spring {
  std::int32_t a, b;
  double weight;
};

double cotangent(const Vector& at, const Vector& one, const Vector& other) {
  const Vector a = one - at, b = other - at;
  const double sine = a.cross(b).norm();
  return sine > 0.0 ? a.dot(b) / sine : kGreatestWeight;
}

/// One for each edge of the island, and for the virtual vertices that fill all loops but the outer one.
std::vector<Spring> make_springs(const Island& island, std::span<const Vector> points,
                                 const std::vector<std::vector<std::int32_t>>& boundaries, std::size_t outer,
                                 bool has_equal_weights) {
  std::vector<Spring> springs;
  springs.reserve(2 * island.triangles.size());
  const auto cotangent_opposite = [&](std::int32_t h) {
    return cotangent(points[island.apex(h)], points[island.tail(h)], points[island.tip(h)]);
  };
  for (std::int32_t h = 0; index(h) < island.twins.size(); ++h) {
    const std::int32_t twin = island.twins[h];
    if (twin >= 0 && twin < h) continue;
    double weight = 1.0;
    if (!has_equal_weights) {
      const double sum = cotangent_opposite(h) + (twin >= 0 ? cotangent_opposite(twin) : 0.0);
      weight = std::clamp(0.5 * sum, kLeastWeight, kGreatestWeight);
    }
    springs.push_back({island.tail(h), island.tip(h), weight});
  }
  auto virtual_vertex = static_cast<std::int32_t>(island.vertices.size());
  for (std::size_t loop = 0; loop < boundaries.size(); ++loop) {
    if (loop == outer) continue;
    for (const std::int32_t v : boundaries[loop]) springs.push_back({v, virtual_vertex, 1.0});
    ++virtual_vertex;
  }
  return springs;
}

/// The length that each edge of a closed loop takes on the outline, and their sum.
std::pair<std::vector<double>, double> outline_lengths(std::span<const Vector> points,
                                                       std::span<const std::int32_t> loop) {
  std::vector<double> lengths;
  double sum = 0.0;
  for (std::size_t i = 0; i < loop.size(); ++i) {
    lengths.push_back((points[index(loop[i])] - points[index(loop[(i + 1) % loop.size()])]).norm());
    sum += lengths.back();
  }
  const double least = sum > 0.0 ? kLeastShareOfOutline * sum / static_cast<double>(loop.size()) : 1.0;
  sum = 0.0;
  for (double& length : lengths) sum += length = std::max(length, least);
  return {std::move(lengths), sum};
}

/// On a circle of an area, counter-clockwise.
void place_on_circle(double area, std::span<const Vector> points, std::span<const std::int32_t> loop,
                     std::vector<double>& map) {
  const auto [lengths, sum] = outline_lengths(points, loop);
  const double radius = std::sqrt(area / std::numbers::pi);
  double before = 0.0;
  for (std::size_t i = 0; i < loop.size(); ++i) {
    const double angle = 2.0 * std::numbers::pi * before / sum;
    map[2 * index(loop[i])] = radius * std::cos(angle);
    map[2 * index(loop[i]) + 1] = radius * std::sin(angle);
    before += lengths[i];
  }
}

/// On a rectangle of an area, counter-clockwise: the ends of the island in the middle of its short sides.
void place_on_rectangle(double area, const LongEnds& ends, std::span<const Vector> points,
                        std::span<const std::int32_t> loop, std::vector<double>& map) {
  const auto [lengths, sum] = outline_lengths(points, loop);
  const double a = 0.5 * ends.length, b = 0.5 * area / ends.length;
  // From the middle of the left side to the middle of the right one, half around the rectangle.
  const auto place = [&](double share) {
    const double way = share * (2.0 * a + 2.0 * b);
    if (way < b) return Eigen::Vector2d(-a, -way);
    if (way > 2.0 * a + b) return Eigen::Vector2d(a, way - 2.0 * a - 2.0 * b);
    return Eigen::Vector2d(way - b - a, -b);
  };
  for (const bool is_back : {false, true}) {
    const std::size_t begin = is_back ? ends.last : ends.first, end = is_back ? ends.first : ends.last;
    double half = 0.0, before = 0.0;
    for (std::size_t i = begin; i != end; i = (i + 1) % loop.size()) half += lengths[i];
    for (std::size_t i = begin; i != end; i = (i + 1) % loop.size()) {
      const Eigen::Vector2d at = place(before / half);
      const double x = at.x() / a, y = at.y() / b, turn = is_back ? -1.0 : 1.0;
      map[2 * index(loop[i])] = turn * (at.x() + kBulge * b * x * (1.0 - y * y));
      map[2 * index(loop[i]) + 1] = turn * (at.y() + kBulge * b * y * (1.0 - x * x));
      before += lengths[i];
    }
  }
}

/// Moves all vertices that are not fixed into the equilibrium of the springs.
bool relax(std::span<const Spring> springs, const std::vector<std::uint8_t>& is_fixed, BlockCholesky& solver,
           std::vector<double>& map, const Task& task) {
  std::vector<double> right_side(map.size(), 0.0), diagonal(is_fixed.size(), 0.0);
  solver.clear();
  std::vector<double>& values = solver.values();
  for (const auto& [a, b, weight] : springs) {
    for (const auto& [v, other] : {Edge{a, b}, Edge{b, a}}) {
      if (is_fixed[v] != 0) continue;
      diagonal[v] += weight;
      if (is_fixed[other] == 0) continue;
      right_side[2 * index(v)] += weight * map[2 * index(other)];
      right_side[2 * index(v) + 1] += weight * map[2 * index(other) + 1];
    }
    if (is_fixed[a] != 0 || is_fixed[b] != 0) continue;
    const BlockEntry at = solver.block(a, b);
    values[at.offset] -= weight;
    values[at.offset + at.row + at.column] -= weight;
  }
  for (std::int32_t v = 0; index(v) < is_fixed.size(); ++v) {
    const BlockEntry at = solver.block(v, v);
    const double value = is_fixed[v] != 0 ? 1.0 : diagonal[v];
    values[at.offset] = values[at.offset + at.row + at.column] = value;
    if (is_fixed[v] == 0) continue;
    right_side[2 * index(v)] = map[2 * index(v)];
    right_side[2 * index(v) + 1] = map[2 * index(v) + 1];
  }
  task.check(0.0);
  if (!solver.factor(task)) return false;
  solver.solve(right_side);
  map = std::move(right_side);
  return true;
}

bool is_embedding(const Island& island, std::span<const double> map) {
  return std::ranges::all_of(island.triangles, [&](const Triangle& t) {
    const double* a = map.data() + 2 * index(t[0]);
    const double* b = map.data() + 2 * index(t[1]);
    const double* c = map.data() + 2 * index(t[2]);
    return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]) > 0.0;
  });
}

}  // namespace

std::vector<Edge> island_edges(const Island& island) {
  std::vector<Edge> edges;
  edges.reserve(2 * island.triangles.size());
  for (std::int32_t h = 0; index(h) < island.twins.size(); ++h) {
    if (island.twins[h] >= 0 && island.twins[h] < h) continue;
    edges.push_back({island.tail(h), island.tip(h)});
  }
  return edges;
}

std::optional<LongEnds> long_ends(const Island& island, std::span<const Vector> points,
                                  std::span<const std::int32_t> outer, double area) {
  const double around = outline_lengths(points, outer).second;
  if (!(0.25 * around * around > kLong * area)) return std::nullopt;
  std::vector<std::pair<std::int32_t, std::int32_t>> pairs;
  for (const auto& [a, b] : island_edges(island)) pairs.insert(pairs.end(), {{a, b}, {b, a}});
  const Csr<std::int32_t> neighbors(island.vertices.size(), pairs);
  const auto farthest_from = [&](std::size_t place) {
    std::vector<double> distance(island.vertices.size(), kInfinity);
    find_shortest_paths(std::array{outer[place]}, distance, [&](std::int32_t v, const auto& step) {
      for (const std::int32_t next : neighbors[v]) step(next, (points[index(v)] - points[index(next)]).norm());
    });
    const auto far = std::ranges::max_element(outer, {}, [&](std::int32_t v) { return distance[v]; });
    return std::pair(static_cast<std::size_t>(far - outer.begin()), distance[*far]);
  };
  LongEnds ends{.first = farthest_from(0).first};
  std::tie(ends.last, ends.length) = farthest_from(ends.first);
  if (ends.first == ends.last || !(ends.length * ends.length > kLong * area)) return std::nullopt;
  return ends;
}

std::vector<double> tutte_embedding(const Island& island, std::span<const Vector> points,
                                    const std::vector<std::vector<std::int32_t>>& boundaries,
                                    const TutteOutline& outline, BlockCholesky& solver, const Task& task) {
  const std::size_t count = island.vertices.size() + boundaries.size() - 1;
  std::vector<std::uint8_t> is_fixed(count, 0);
  for (const std::int32_t v : boundaries[outline.outer]) is_fixed[v] = 1;
  std::optional<BlockCholesky> filled;
  for (const bool has_equal_weights : {false, true}) {
    const std::vector<Spring> springs = make_springs(island, points, boundaries, outline.outer, has_equal_weights);
    if (boundaries.size() > 1 && !filled) {
      std::vector<Edge> edges;
      edges.reserve(springs.size());
      for (const auto& [a, b, weight] : springs) edges.push_back({a, b});
      filled.emplace(count, edges, task);
    }
    std::vector<double> map(2 * count, 0.0);
    const std::vector<std::int32_t>& loop = boundaries[outline.outer];
    if (outline.ends) {
      place_on_rectangle(outline.area, *outline.ends, points, loop, map);
    } else {
      place_on_circle(outline.area, points, loop, map);
    }
    if (!relax(springs, is_fixed, filled ? *filled : solver, map, task)) continue;
    map.resize(2 * island.vertices.size());
    if (is_embedding(island, map)) return map;
  }
  return {};
}

}  // namespace seamwire::detail
