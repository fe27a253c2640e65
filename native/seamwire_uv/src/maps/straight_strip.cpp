// SPDX-License-Identifier: GPL-3.0-or-later
#include "maps/straight_strip.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>

#include "detail/half_edge.hpp"
#include "detail/index.hpp"
#include "detail/infinity.hpp"
#include "maps/quad_skew.hpp"

namespace seamwire::detail {

namespace {

/// Triangles lower than this part of their longest side do not decide how wide a row or column is.
constexpr double kLowest = 1e-4;

/// The half-edges along the sides of a quad, counter-clockwise.
using Quad = std::array<std::int32_t, 4>;

/// A column and a row.
using Place = std::array<std::int32_t, 2>;

Quad quad_around(std::int32_t half_edge, std::int32_t twin) {
  return {next_in_face(half_edge), previous_in_face(half_edge), next_in_face(twin), previous_in_face(twin)};
}

/// Pairs the triangles of an island such that each pair is a quad.
class QuadFinder {
 public:
  QuadFinder(const Island& island, std::span<const std::uint8_t> is_real, std::span<const Vector> points)
      : island_(island), is_real_(is_real), points_(points), partner_(island.triangles.size(), -1) {}

  /// The quads; empty if triangles are left over.
  std::vector<Quad> quads() {
    std::vector<std::uint8_t> is_free(island_.triangles.size(), 1);
    for (std::int32_t h = 0; index(h) < island_.twins.size(); ++h) {
      const std::int32_t twin = island_.twins[h];
      if (twin < 0 || is_real_[h] != 0) continue;
      if (partner_[h / 3] >= 0) return {};  // a polygon with more than four corners
      partner_[h / 3] = h;
      is_free[h / 3] = 0;
    }
    if (!pair_free(is_free)) return {};
    std::vector<Quad> found;
    for (const std::int32_t h : partner_) {
      if (h < island_.twins[h]) found.push_back(quad_around(h, island_.twins[h]));
    }
    return found;
  }

 private:
  const Vector& point(std::int32_t half_edge) const {
    return points_[index(island_.vertices[island_.tail(half_edge)])];
  }

  /// Pairs the triangles that have real edges only. Triangles with one possible partner get it first, because each
  /// complete pairing contains that pair (Karp and Sipser 1981). Then the pair that looks most like a quad follows.
  bool pair_free(const std::vector<std::uint8_t>& is_free) {
    std::vector<std::pair<double, std::int32_t>> pairs;
    for (std::int32_t h = 0; index(h) < island_.twins.size(); ++h) {
      const std::int32_t twin = island_.twins[h];
      if (twin < h || is_free[h / 3] == 0 || is_free[twin / 3] == 0) continue;
      const double skew = quad_skew({point(h), point(previous_in_face(twin)), point(twin), point(previous_in_face(h))});
      if (skew != kInfinity) pairs.emplace_back(skew, h);
    }
    std::ranges::sort(pairs);
    may_pair_.assign(island_.twins.size(), 0);
    for (const auto& [skew, h] : pairs) may_pair_[h] = may_pair_[island_.twins[h]] = 1;
    for (std::int32_t f = 0; index(f) < is_free.size(); ++f) {
      if (is_free[f] != 0) forced_.push_back(f);
    }
    if (!pair_forced()) return false;
    for (const auto& [skew, h] : pairs) {
      if (partner_[h / 3] >= 0 || partner_[island_.twins[h] / 3] >= 0) continue;
      pair(h);
      if (!pair_forced()) return false;
    }
    return std::ranges::all_of(partner_, [](std::int32_t h) { return h >= 0; });
  }

  /// Whether every triangle whose partners were taken still has a partner.
  bool pair_forced() {
    while (!forced_.empty()) {
      const std::int32_t f = forced_.back();
      forced_.pop_back();
      if (partner_[f] >= 0) continue;
      std::int32_t possible = 0, only = -1;
      for (std::int32_t h = 3 * f; h < 3 * f + 3; ++h) {
        if (may_pair_[h] == 0 || partner_[island_.twins[h] / 3] >= 0) continue;
        ++possible;
        only = h;
      }
      if (possible == 0) return false;
      if (possible == 1) pair(only);
    }
    return true;
  }

  void pair(std::int32_t half_edge) {
    const std::int32_t twin = island_.twins[half_edge];
    partner_[half_edge / 3] = half_edge;
    partner_[twin / 3] = twin;
    for (const std::int32_t side : quad_around(half_edge, twin)) {
      if (may_pair_[side] != 0) forced_.push_back(island_.twins[side] / 3);
    }
  }

  const Island& island_;
  std::span<const std::uint8_t> is_real_;
  std::span<const Vector> points_;
  std::vector<std::int32_t> partner_;   ///< of each triangle the half-edge inside its quad
  std::vector<std::uint8_t> may_pair_;  ///< whether the two triangles at a half-edge look like a quad
  std::vector<std::int32_t> forced_;    ///< triangles that may have one possible partner
};

/// The steps to the quads below, right, above and left.
constexpr std::array<Place, 4> kSteps{{{0, -1}, {1, 0}, {0, 1}, {-1, 0}}};
/// Where these sides begin, counter-clockwise, from the quad's lower left corner.
constexpr std::array<Place, 4> kBegins{{{0, 0}, {1, 0}, {1, 1}, {0, 1}}};

/// The columns and rows of the vertices, if the quads are a whole rectangle; empty otherwise.
std::vector<Place> places_in_grid(const Island& island, const std::vector<Quad>& quads) {
  const auto count = static_cast<std::int32_t>(quads.size());
  std::vector<std::int32_t> at(island.twins.size(), -1);  // 4 * quad + side of each half-edge
  for (std::int32_t q = 0; q < count; ++q) {
    for (std::int32_t k = 0; k < 4; ++k) at[quads[q][index(k)]] = 4 * q + k;
  }
  std::vector<Place> place(quads.size());
  std::vector<std::int32_t> turn(quads.size(), -1);  // side k looks in direction (k + turn) % 4
  std::vector<std::int32_t> waiting{0};
  turn[0] = 0;
  Place low{0, 0}, high{0, 0};
  for (std::size_t next = 0; next < waiting.size(); ++next) {
    const std::int32_t q = waiting[next];
    for (std::size_t i = 0; i < 2; ++i) {
      low[i] = std::min(low[i], place[q][i]);
      high[i] = std::max(high[i], place[q][i]);
    }
    for (std::int32_t k = 0; k < 4; ++k) {
      const std::int32_t twin = island.twins[quads[q][index(k)]];
      if (twin < 0) continue;
      const std::int32_t other = at[twin] / 4, direction = (k + turn[q]) % 4;
      const Place& step = kSteps[index(direction)];
      const Place found{place[q][0] + step[0], place[q][1] + step[1]};
      const std::int32_t turned = (direction + 6 - at[twin] % 4) % 4;
      if (turn[other] < 0) {
        turn[other] = turned;
        place[other] = found;
        waiting.push_back(other);
      } else if (turn[other] != turned || place[other] != found) {
        return {};
      }
    }
  }
  const std::int64_t columns = high[0] - low[0] + 1, rows = high[1] - low[1] + 1;
  if (columns * rows != count) return {};
  std::vector<std::uint8_t> is_taken(quads.size(), 0);
  std::vector<Place> vertices(island.vertices.size());
  for (std::int32_t q = 0; q < count; ++q) {
    const Place own{place[q][0] - low[0], place[q][1] - low[1]};
    std::uint8_t& taken = is_taken[static_cast<std::size_t>(own[1] * columns + own[0])];
    if (taken != 0) return {};
    taken = 1;
    for (std::int32_t k = 0; k < 4; ++k) {
      const std::size_t direction = index((k + turn[q]) % 4);
      const std::int32_t half_edge = quads[q][index(k)];
      const Place to{own[0] + kSteps[direction][0], own[1] + kSteps[direction][1]};
      const bool is_outside = to[0] < 0 || to[1] < 0 || to[0] >= columns || to[1] >= rows;
      if (!is_outside && island.twins[half_edge] < 0) return {};  // a slit in the rectangle
      vertices[index(island.tail(half_edge))] = {own[0] + kBegins[direction][0], own[1] + kBegins[direction][1]};
    }
  }
  return vertices;
}

/// Where the lines between columns (0) or rows (1) lie. Scaling the map of a triangle along the axes scales four
/// terms of its energy, two for each axis. So each column and row has its own minimum.
std::vector<double> lines(const Island& island, std::span<const Vector> points, const std::vector<Place>& places,
                          std::size_t axis) {
  std::int32_t count = 0;
  for (const Place& place : places) count = std::max(count, place[axis]);
  std::vector<double> along(index(count), 0.0), against(index(count), 0.0);
  for (const Triangle& t : island.triangles) {
    const auto point = [&](std::size_t i) -> const Vector& { return points[index(island.vertices[index(t[i])])]; };
    const auto step = [&](std::size_t i, std::size_t k) {
      return static_cast<double>(places[index(t[i])][k] - places[index(t[0])][k]);
    };
    const Vector one = point(1) - point(0), two = point(2) - point(0);
    const double area = one.cross(two).norm();
    const double longest = std::max({one.squaredNorm(), two.squaredNorm(), (two - one).squaredNorm()});
    if (!(area > kLowest * longest)) continue;
    // The gradients of column and row, turned by 90 degrees and times the doubled area.
    const auto gradient = [&](std::size_t k) { return (step(2, k) * one - step(1, k) * two).squaredNorm(); };
    const std::int32_t line =
        std::min({places[index(t[0])][axis], places[index(t[1])][axis], places[index(t[2])][axis]});
    along[index(line)] += gradient(axis) / area;
    against[index(line)] += gradient(1 - axis) * area;
  }
  std::vector<double> result{0.0};
  for (std::size_t i = 0; i < along.size(); ++i)
    result.push_back(result.back() + std::pow(against[i] / along[i], 0.25));
  const double middle = 0.5 * result.back();
  for (double& line : result) line -= middle;
  return result;
}

}  // namespace

std::optional<std::vector<Point2>> straight_map(const Island& island, std::span<const std::uint8_t> is_real,
                                                std::span<const Vector> points) {
  if (island.triangles.size() % 2 != 0) return std::nullopt;
  const std::vector<Quad> quads = QuadFinder(island, is_real, points).quads();
  if (quads.empty()) return std::nullopt;
  const std::vector<Place> places = places_in_grid(island, quads);
  if (places.empty()) return std::nullopt;
  const std::vector<double> columns = lines(island, points, places, 0), rows = lines(island, points, places, 1);
  if (!std::isfinite(columns.back()) || !std::isfinite(rows.back())) return std::nullopt;
  std::vector<Point2> map;
  map.reserve(places.size());
  for (const Place& place : places) map.emplace_back(columns[index(place[0])], rows[index(place[1])]);
  return map;
}

}  // namespace seamwire::detail
