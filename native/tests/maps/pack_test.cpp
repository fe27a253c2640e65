// SPDX-License-Identifier: GPL-3.0-or-later
#include "seamwire_uv/maps/pack.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <vector>

#include "maps/packed_square.hpp"

namespace seamwire {
namespace {

using Corners = std::array<Eigen::Vector2d, 3>;

/// Islands as triangles.
struct Islands {
  std::vector<Corners> uvs;
  std::vector<std::int32_t> numbers;

  std::int32_t count() const { return numbers.empty() ? 0 : numbers.back() + 1; }
  /// A new island of rectangles, each from a corner to another one, turned about the origin.
  void add(const std::vector<std::array<Eigen::Vector2d, 2>>& rectangles, double angle = 0.0) {
    const std::int32_t number = count();
    const Eigen::Rotation2Dd turn(angle);
    for (const auto& [low, high] : rectangles) {
      const Eigen::Vector2d a = turn * low, b = turn * Eigen::Vector2d(high.x(), low.y()), c = turn * high,
                            d = turn * Eigen::Vector2d(low.x(), high.y());
      uvs.push_back({a, b, c});
      uvs.push_back({a, c, d});
      numbers.insert(numbers.end(), 2, number);
    }
  }
  void add_box(double width, double height) { add({{Eigen::Vector2d(0, 0), Eigen::Vector2d(width, height)}}); }
  /// A square without its middle.
  void add_frame(double side, double thick) {
    const double inner = side - thick;
    add({{Eigen::Vector2d(0, 0), Eigen::Vector2d(side, thick)},
         {Eigen::Vector2d(0, inner), Eigen::Vector2d(side, side)},
         {Eigen::Vector2d(0, thick), Eigen::Vector2d(thick, inner)},
         {Eigen::Vector2d(inner, thick), Eigen::Vector2d(side, inner)}});
  }

  std::vector<Corners> placed(const Packing& packing) const {
    std::vector<Corners> all = uvs;
    for (std::size_t f = 0; f < all.size(); ++f) {
      const auto& place = packing.placements[static_cast<std::size_t>(numbers[f])];
      for (Eigen::Vector2d& p : all[f]) p = Eigen::Vector2d(place.leftCols<2>() * p + place.col(2));
    }
    return all;
  }
};

double distance(const Eigen::Vector2d& p, const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  const Eigen::Vector2d along = b - a;
  const double t = along.isZero() ? 0.0 : std::clamp((p - a).dot(along) / along.squaredNorm(), 0.0, 1.0);
  return (p - a - t * along).norm();
}

bool is_inside(const Eigen::Vector2d& p, const Corners& t) {
  int left = 0, right = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const Eigen::Vector2d along = t[(i + 1) % 3] - t[i], to = p - t[i];
    const double side = along.x() * to.y() - along.y() * to.x();
    left += side >= 0.0 ? 1 : 0;
    right += side <= 0.0 ? 1 : 0;
  }
  return left == 3 || right == 3;
}

/// The distance between triangles, 0 if they overlap. Sides that cross without a corner inside have a corner near.
double distance(const Corners& one, const Corners& other) {
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < 3; ++i) {
    if (is_inside(one[i], other) || is_inside(other[i], one)) return 0.0;
    for (std::size_t k = 0; k < 3; ++k) {
      const Eigen::Vector2d &a = one[k], &b = one[(k + 1) % 3], &c = other[i], &d = other[(i + 1) % 3];
      const auto side = [](const Eigen::Vector2d& p, const Eigen::Vector2d& q, const Eigen::Vector2d& r) {
        return (q.x() - p.x()) * (r.y() - p.y()) - (q.y() - p.y()) * (r.x() - p.x());
      };
      if (side(a, b, c) * side(a, b, d) < 0.0 && side(c, d, a) * side(c, d, b) < 0.0) return 0.0;
      least = std::min({least, distance(one[i], other[k], other[(k + 1) % 3]), distance(other[i], a, b)});
    }
  }
  return least;
}

void expect_apart(const Islands& islands, const std::vector<Corners>& placed, double margin) {
  double gap = std::numeric_limits<double>::infinity(), low = gap, high = 0.0;
  for (std::size_t i = 0; i < placed.size(); ++i) {
    for (const Eigen::Vector2d& p : placed[i]) {
      low = std::min(low, p.minCoeff());
      high = std::max(high, p.maxCoeff());
    }
    for (std::size_t k = 0; k < i; ++k) {
      if (islands.numbers[i] != islands.numbers[k]) gap = std::min(gap, distance(placed[i], placed[k]));
    }
  }
  EXPECT_GE(gap, margin - 1e-9);
  EXPECT_GE(low, 0.5 * margin - 1e-9);
  EXPECT_LE(high, 1.0 - 0.5 * margin + 1e-9);
}

Islands some_islands(unsigned seed, int count) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> size(0.05, 1.0), angle(0.0, 6.0);
  Islands islands;
  for (int i = 0; i < count; ++i) {
    const double w = size(random), h = size(random);
    if (i % 3 == 0) {
      islands.add_frame(w, 0.2 * w);
    } else if (i % 3 == 1) {  // an L
      islands.add({{Eigen::Vector2d(0, 0), Eigen::Vector2d(w, 0.2 * h)},
                   {Eigen::Vector2d(0, 0.2 * h), Eigen::Vector2d(0.2 * w, h)}},
                  angle(random));
    } else {
      islands.add({{Eigen::Vector2d(0, 0), Eigen::Vector2d(w, 0.3 * h)}}, angle(random));
    }
  }
  return islands;
}

TEST(PackIslands, KeepsIslandsApartInTheSquareAtOneScale) {
  for (const PackTurns turns : {PackTurns::kNone, PackTurns::kQuarters, PackTurns::kAny}) {
    for (const double margin : {0.0, 0.003, 0.02}) {
      const Islands islands = some_islands(3, 25);
      const Packing packing = pack_islands(islands.uvs, islands.numbers, {.margin = margin, .turns = turns});
      const auto placed = islands.placed(packing);
      expect_apart(islands, placed, margin);
      double used = 0.0;
      for (std::size_t f = 0; f < placed.size(); ++f) {
        for (std::size_t i = 0; i < 3; ++i) {
          const double before = (islands.uvs[f][(i + 1) % 3] - islands.uvs[f][i]).norm();
          EXPECT_NEAR((placed[f][(i + 1) % 3] - placed[f][i]).norm(), packing.scale * before, 1e-12);
        }
        const Eigen::Vector2d one = placed[f][1] - placed[f][0], two = placed[f][2] - placed[f][0];
        const double area = 0.5 * (one.x() * two.y() - one.y() * two.x());
        EXPECT_GT(area, 0.0) << "not mirrored";
        used += area;
      }
      EXPECT_NEAR(packing.used, used, 1e-9);
      EXPECT_GT(used, 0.3);
    }
  }
}

TEST(PackIslands, FillsHoles) {
  Islands islands;
  islands.add_frame(1.0, 0.1);
  islands.add_frame(0.75, 0.1);
  islands.add_box(0.5, 0.5);
  const Packing packing = pack_islands(islands.uvs, islands.numbers, {.margin = 0.01});
  EXPECT_GT(packing.scale, 0.98) << "as if the frame were alone";
  expect_apart(islands, islands.placed(packing), 0.01);
}

TEST(PackIslands, TurnsByQuartersWhereThatSavesSpace) {
  Islands beside;  // two of these fill the square only if one is turned
  beside.add_box(0.5, 1.0);
  beside.add_box(1.0, 0.5);
  const Packing turned = pack_islands(beside.uvs, beside.numbers);
  EXPECT_GT(turned.scale, 0.97);
  EXPECT_LT(pack_islands(beside.uvs, beside.numbers, {.turns = PackTurns::kNone}).scale, 0.68);
  Islands upright;
  for (int i = 0; i < 4; ++i) upright.add_box(0.25, 1.0);
  for (const auto& placement : pack_islands(upright.uvs, upright.numbers).placements) {
    EXPECT_GT(placement(0, 0), 0.0) << "no turn is needed";
    EXPECT_EQ(placement(0, 1), 0.0);
  }
}

TEST(PackIslands, AnyTurnsLayRectanglesAlongTheAxesAndLongIslandsAcross) {
  Islands boxes;
  for (const double angle : {0.3, 1.0, 2.0, 5.0}) {
    boxes.add({{Eigen::Vector2d(0, 0), Eigen::Vector2d(0.25, 1.0)}}, angle);
  }
  const Packing packing = pack_islands(boxes.uvs, boxes.numbers, {.turns = PackTurns::kAny});
  EXPECT_GT(packing.used, 0.94);
  Islands bent;  // an arrow along an axis is 1.4 times as large along the diagonal
  bent.add({{Eigen::Vector2d(0, 0), Eigen::Vector2d(1, 0.02)}, {Eigen::Vector2d(0, 0.02), Eigen::Vector2d(0.1, 0.1)}});
  const double straight = pack_islands(bent.uvs, bent.numbers).scale;
  EXPECT_GT(pack_islands(bent.uvs, bent.numbers, {.turns = PackTurns::kAny}).scale, 1.3 * straight);
}

TEST(PackIslands, TurnsIslandsAsTheImageShowsThem) {
  Islands islands;
  islands.add_box(0.5, 1.0);
  islands.add_box(1.0, 0.5);
  // The image is twice as wide as high: both lie side by side without a turn.
  const Packing wide = pack_islands(islands.uvs, islands.numbers, {.margin = 0.0, .aspects = {2.0, 2.0}});
  EXPECT_GT(wide.scale, 0.98);
  for (const auto& placement : wide.placements) {
    const Eigen::Matrix2d on_image = Eigen::Vector2d(2.0, 1.0).asDiagonal() * placement.leftCols<2>();
    EXPECT_NEAR((on_image * on_image.transpose() - wide.scale * wide.scale * Eigen::Matrix2d::Identity()).norm(), 0.0,
                1e-12);
    EXPECT_GT(on_image.determinant(), 0.0);
  }
  EXPECT_NEAR(wide.used, 0.5 * wide.scale * wide.scale, 1e-12);
}

TEST(PackIslands, ManyCopiesFillTheSquare) {
  Islands islands;
  for (int i = 0; i < 2500; ++i) islands.add_box(1.0, 0.8);
  const Packing packing = pack_islands(islands.uvs, islands.numbers);
  EXPECT_GT(packing.used, 0.55);
  EXPECT_EQ(packing.placements.size(), 2500U);
}

TEST(PackIslands, FindsTheSamePlacesAgain) {
  const Islands islands = some_islands(7, 30);
  const Packing one = pack_islands(islands.uvs, islands.numbers, {.turns = PackTurns::kAny});
  const Packing two = pack_islands(islands.uvs, islands.numbers, {.turns = PackTurns::kAny});
  EXPECT_EQ(one.scale, two.scale);
  EXPECT_EQ(one.placements, two.placements);
}

TEST(PackIslands, TakesIslandsWithoutSizeAndNumbersWithoutTriangles) {
  EXPECT_TRUE(pack_islands({}, {}).placements.empty());
  const Corners point{Eigen::Vector2d(3, 4), Eigen::Vector2d(3, 4), Eigen::Vector2d(3, 4)};
  const Corners line{Eigen::Vector2d(0, 0), Eigen::Vector2d(1, 0), Eigen::Vector2d(2, 0)};
  for (const PackTurns turns : {PackTurns::kNone, PackTurns::kQuarters, PackTurns::kAny}) {
    const std::vector<Corners> uvs{point, line, line};
    const std::vector<std::int32_t> numbers{2, 0, 2};
    const Packing packing = pack_islands(uvs, numbers, {.turns = turns});
    EXPECT_TRUE(packing.placements[1].isZero()) << "it has no triangles";
    EXPECT_EQ(packing.used, 0.0);
    const Packing alone = pack_islands(std::vector{point}, std::vector<std::int32_t>{0}, {.turns = turns});
    EXPECT_TRUE(std::isfinite(alone.scale));
    const Eigen::Vector2d place = alone.placements[0] * Eigen::Vector3d(3, 4, 1);
    EXPECT_GE(place.minCoeff(), 0.0);
    EXPECT_LE(place.maxCoeff(), 1.0);
  }
}

TEST(PackIslands, RefusesWrongInput) {
  const std::vector<Corners> uvs(1, {Eigen::Vector2d(0, 0), Eigen::Vector2d(1, 0), Eigen::Vector2d(0, 1)});
  const std::vector<std::int32_t> zero{0}, far{1}, two{0, 0};
  EXPECT_THROW(pack_islands(uvs, two), InvalidInput);
  EXPECT_THROW(pack_islands(uvs, far), InvalidInput);
  EXPECT_THROW(pack_islands(uvs, zero, {.margin = 0.3}), InvalidInput);
  EXPECT_THROW(pack_islands(uvs, zero, {.margin = std::nan("")}), InvalidInput);
  EXPECT_THROW(pack_islands(uvs, zero, {.aspects = {1.0, 1.0}}), InvalidInput);
  EXPECT_THROW(pack_islands(uvs, zero, {.aspects = {0.0}}), InvalidInput);
  for (const double bad : {std::numeric_limits<double>::infinity(), std::nan(""), 1e101}) {
    std::vector<Corners> wrong = uvs;
    wrong[0][1].y() = bad;
    EXPECT_THROW(pack_islands(wrong, zero), InvalidInput);
  }
}

TEST(PackIslands, CanBeCancelled) {
  const Islands islands = some_islands(11, 60);
  int calls = 0;
  const Task task{.stop = {}, .progress = [&](double) { return ++calls < 5; }};
  EXPECT_THROW(pack_islands(islands.uvs, islands.numbers, {}, task), Cancelled);
}

TEST(PackedSquare, FindsTheFirstFreeColumn) {
  // Against a plain search, for shapes across the borders of words.
  std::mt19937 random(5);
  const std::int32_t size = 150;
  detail::PackedSquare square(size);
  std::vector<std::vector<bool>> taken(size, std::vector<bool>(size));
  for (int round = 0; round < 60; ++round) {
    detail::CellShape shape;
    shape.width = 1 + static_cast<std::int32_t>(random() % 90);
    shape.height = 2;
    shape.runs = {{0, 0, shape.width}, {1, shape.width / 2, shape.width / 2 + 1}};
    shape.around = shape.runs;
    for (std::int32_t y = 0; y + shape.height <= size; y += 1 + static_cast<std::int32_t>(random() % 9)) {
      std::int32_t expected = 0;
      const auto is_free = [&](std::int32_t x) {
        return std::ranges::all_of(shape.runs, [&](const detail::CellRun& run) {
          for (std::int32_t i = run.begin; i < run.end; ++i) {
            if (taken[static_cast<std::size_t>(y + run.row)][static_cast<std::size_t>(x + i)]) return false;
          }
          return true;
        });
      };
      while (expected + shape.width <= size && !is_free(expected)) ++expected;
      const auto found = square.free_column(shape, y);
      ASSERT_EQ(found.has_value(), expected + shape.width <= size);
      if (!found) continue;
      ASSERT_EQ(*found, expected);
      if (random() % 8 != 0) continue;
      square.take(shape, {*found, y});
      for (const detail::CellRun& run : shape.runs) {
        for (std::int32_t i = run.begin; i < run.end; ++i) {
          taken[static_cast<std::size_t>(y + run.row)][static_cast<std::size_t>(*found + i)] = true;
        }
      }
    }
  }
}

}  // namespace
}  // namespace seamwire
