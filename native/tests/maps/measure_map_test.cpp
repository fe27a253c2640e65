// SPDX-License-Identifier: GPL-3.0-or-later
#include "seamwire_uv/maps/measure_map.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <numbers>
#include <random>
#include <set>

#include "shapes.hpp"

namespace seamwire {
namespace {

TEST(MeasureMap, KnowsTheBestScaleAndLeavesTheWorstOut) {
  const Surface surface = shapes::grid(40).surface();
  CornerUvs uvs;
  for (const Triangle& t : surface.triangles()) {
    uvs.emplace_back();
    for (std::size_t i = 0; i < 3; ++i)
      uvs.back()[i] = 7.0 * surface.points()[static_cast<std::size_t>(t[i])].head<2>();
  }
  const MapReport same = measure_map(surface, uvs);
  EXPECT_NEAR(same.energy, 4.0, 1e-12) << "seven times as large";
  EXPECT_TRUE(same.flipped.empty() && same.overlapping.empty());
  // One corner is moved: 3 of 3,200 triangles, less than a thousandth.
  uvs[0][0] = {0.1, 0.08};
  const MapReport one = measure_map(surface, uvs);
  EXPECT_NEAR(one.energy, 4.0, 1e-3);
  EXPECT_GT(one.energies[0], 4.1);
  // Half of the triangles stretched by 2 along u: s^2 (5 + 2) / 2 + (1.25 + 2) / (2 s^2) at its lowest.
  for (std::size_t f = 0; f < uvs.size() / 2; ++f) {
    for (std::size_t i = 0; i < 3; ++i) {
      uvs[f][i] = surface.points()[static_cast<std::size_t>(surface.triangles()[f][i])].head<2>();
      uvs[f][i].x() *= 2.0;
    }
  }
  for (std::size_t f = uvs.size() / 2; f < uvs.size(); ++f) {
    for (std::size_t i = 0; i < 3; ++i) {
      uvs[f][i] = surface.points()[static_cast<std::size_t>(surface.triangles()[f][i])].head<2>();
    }
  }
  EXPECT_NEAR(measure_map(surface, uvs).energy, 2.0 * std::sqrt(3.5 * 1.625), 0.01);
}

TEST(MeasureMap, LeavesOutOneThousandthOfTheAreaOfAnyTriangles) {
  const Surface surface({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, {{0, 1, 2}, {0, 2, 3}});
  // The second triangle is stretched by 10 across the common edge.
  const CornerUvs uvs{{{{0, 0}, {1, 0}, {1, 1}}}, {{{0, 0}, {1, 1}, {-4.5, 5.5}}}};
  const double stretched = 0.5 * 2.0 + 0.499 * 101.0, shrunk = 0.5 * 2.0 + 0.499 * 1.01;
  const double expected = 2.0 * std::sqrt(stretched * shrunk) / 0.999;
  EXPECT_NEAR(measure_map(surface, uvs).energy, expected, 1e-12 * expected);
  EXPECT_NEAR(map_energy(surface, uvs), expected, 1e-12 * expected);
}

TEST(MeasureMap, MapsMayBeTinyOrHuge) {
  const Surface surface = shapes::grid(4).surface();
  for (const double size : {1e-320, 1e-300, 1e-170, 1e160, 1e300}) {
    CornerUvs uvs;
    for (const Triangle& t : surface.triangles()) {
      uvs.emplace_back();
      for (std::size_t i = 0; i < 3; ++i) {
        uvs.back()[i] = size * surface.points()[static_cast<std::size_t>(t[i])].head<2>();
      }
    }
    const MapReport report = measure_map(surface, uvs);
    EXPECT_NEAR(report.energy, 4.0, 1e-2) << size << ": numbers of 1e-320 have four digits";
    EXPECT_TRUE(report.flipped.empty() && report.overlapping.empty()) << size;
    std::swap(uvs[5][0], uvs[5][1]);
    EXPECT_EQ(measure_map(surface, uvs, std::vector<std::int32_t>(uvs.size(), 0)).flipped, std::vector<std::int32_t>{5})
        << size;
  }
}

TEST(MeasureMap, FindsFlipsAndOverlaps) {
  const Surface surface = shapes::grid(4).surface();
  CornerUvs uvs;
  for (const Triangle& t : surface.triangles()) {
    uvs.emplace_back();
    for (std::size_t i = 0; i < 3; ++i) uvs.back()[i] = surface.points()[static_cast<std::size_t>(t[i])].head<2>();
  }
  const CornerUvs flat = uvs;
  for (auto& corners : uvs) {
    for (Eigen::Vector2d& uv : corners) uv.x() = -uv.x();
  }
  EXPECT_TRUE(measure_map(surface, uvs).flipped.empty()) << "an island may be mirrored as a whole";
  uvs = flat;
  std::swap(uvs[5][0], uvs[5][1]);
  const MapReport flipped = measure_map(surface, uvs, std::vector<std::int32_t>(uvs.size(), 2));
  EXPECT_EQ(flipped.flipped, std::vector<std::int32_t>{5});
  EXPECT_EQ(flipped.overlapping, std::vector<std::int32_t>{2});
  EXPECT_TRUE(std::isinf(flipped.energies[5]));
  // Two halves of one island on top of each other, and each by itself.
  uvs = flat;
  std::vector<std::int32_t> halves(uvs.size(), 0);
  for (std::size_t f = 16; f < uvs.size(); ++f) {
    halves[f] = 1;
    for (Eigen::Vector2d& uv : uvs[f]) uv.y() -= 0.5;
  }
  EXPECT_TRUE(measure_map(surface, uvs, halves).overlapping.empty());
  EXPECT_EQ(measure_map(surface, uvs, std::vector<std::int32_t>(uvs.size(), 0)).overlapping.size(), 1U);
  for (std::size_t f = 16; f < uvs.size(); ++f) {
    for (Eigen::Vector2d& uv : uvs[f]) uv = 0.1 * uv + Eigen::Vector2d(0.4, 0.2);
  }
  EXPECT_EQ(measure_map(surface, uvs, std::vector<std::int32_t>(uvs.size(), 0)).overlapping.size(), 1U)
      << "one inside the other";
}

/// A strip of squares.
struct Strip {
  Surface surface;
  CornerUvs uvs;
};
/// Unit squares around a ring of 3 x 3, the ninth on the first, and so on. Their sides to the squares before and after
/// meet at the corners of the ring.
Strip around_a_ring(std::size_t count, double angle) {
  constexpr std::array<std::array<int, 2>, 8> kPlaces{{{0, 0}, {1, 0}, {2, 0}, {2, 1}, {2, 2}, {1, 2}, {0, 2}, {0, 1}}};
  shapes::Mesh mesh;
  CornerUvs uvs;
  std::vector<std::map<std::array<int, 2>, std::int32_t>> vertices(count);
  const Eigen::Rotation2Dd turn(angle);
  for (std::size_t i = 0; i < count; ++i) {
    const auto [x, y] = kPlaces[i % 8];
    std::array<std::int32_t, 4> quad{};
    std::array<Eigen::Vector2d, 4> uv;
    constexpr std::array<std::array<int, 2>, 4> kCorners{{{0, 0}, {1, 0}, {1, 1}, {0, 1}}};
    for (std::size_t k = 0; k < 4; ++k) {
      const std::array<int, 2> corner{x + kCorners[k][0], y + kCorners[k][1]};
      // Shared with the square before.
      if (i > 0 && vertices[i - 1].contains(corner)) {
        vertices[i][corner] = vertices[i - 1][corner];
      } else {
        vertices[i][corner] = static_cast<std::int32_t>(mesh.points.size());
        mesh.points.emplace_back(corner[0], corner[1], 0.3 * static_cast<double>(i));
      }
      quad[k] = vertices[i][corner];
      uv[k] = turn * Eigen::Vector2d(corner[0], corner[1]);
    }
    mesh.triangles.push_back({quad[0], quad[1], quad[2]});
    uvs.push_back({uv[0], uv[1], uv[2]});
    mesh.triangles.push_back({quad[0], quad[2], quad[3]});
    uvs.push_back({uv[0], uv[2], uv[3]});
  }
  return {mesh.surface(), uvs};
}

TEST(MeasureMap, FindsSquaresThatLieOnOthersExactly) {
  for (const double angle : {0.0, 0.3, 1.0, std::numbers::pi / 4}) {
    for (const std::size_t count : {4U, 7U, 8U}) {
      const Strip strip = around_a_ring(count, angle);
      const std::vector<std::int32_t> islands(strip.uvs.size(), 0);
      EXPECT_TRUE(measure_map(strip.surface, strip.uvs, islands).overlapping.empty()) << count << ", " << angle;
    }
    for (const std::size_t count : {9U, 10U, 11U, 12U, 16U, 17U}) {
      const Strip strip = around_a_ring(count, angle);
      const std::vector<std::int32_t> islands(strip.uvs.size(), 0);
      EXPECT_EQ(measure_map(strip.surface, strip.uvs, islands).overlapping, std::vector<std::int32_t>{0})
          << count << ", " << angle;
    }
  }
}

/// Separate unit squares at places, and their map to these places.
struct Squares {
  Surface surface;
  CornerUvs uvs;
};
Squares squares_at(const std::vector<Eigen::Vector2d>& places, double size = 1.0) {
  shapes::Mesh mesh;
  CornerUvs uvs;
  for (const Eigen::Vector2d& place : places) {
    const auto v = static_cast<std::int32_t>(mesh.points.size());
    std::array<Eigen::Vector2d, 4> uv;
    for (std::size_t k = 0; k < 4; ++k) {
      uv[k] = place + size * Eigen::Vector2d(k == 1 || k == 2 ? 1.0 : 0.0, k > 1 ? 1.0 : 0.0);
      mesh.points.emplace_back(uv[k].x(), uv[k].y(), static_cast<double>(v));
    }
    mesh.triangles.push_back({v, v + 1, v + 2});
    uvs.push_back({uv[0], uv[1], uv[2]});
    mesh.triangles.push_back({v, v + 2, v + 3});
    uvs.push_back({uv[0], uv[2], uv[3]});
  }
  return {mesh.surface(), uvs};
}

TEST(MeasureMap, IslandsThatTouchDoNotCollide) {
  std::vector<Eigen::Vector2d> places;
  for (int i = 0; i < 6; ++i) {
    for (int j = 0; j < 6; ++j) places.emplace_back(i + 0.5 * (j % 2), j);
  }
  const Squares squares = squares_at(places);
  std::vector<std::int32_t> islands;
  for (std::int32_t i = 0; i < 36; ++i) islands.insert(islands.end(), {i, i});
  const MapReport report = measure_map(squares.surface, squares.uvs, islands);
  EXPECT_TRUE(report.overlapping.empty() && report.colliding.empty());
  // All as one island.
  EXPECT_TRUE(measure_map(squares.surface, squares.uvs, std::vector<std::int32_t>(72, 0)).overlapping.empty());
  // As single precision rounds them.
  CornerUvs rounded = squares.uvs;
  for (auto& corners : rounded) {
    for (Eigen::Vector2d& uv : corners) uv = (Eigen::Rotation2Dd(0.7) * uv / 7.0).cast<float>().cast<double>();
  }
  EXPECT_TRUE(measure_map(squares.surface, rounded, islands).colliding.empty());
}

TEST(MeasureMap, WhatTouchesToSinglePrecisionDoesNotOverlap) {
  // Eight squares around a hole, and a ninth square that is joined to one of them and fills the hole of the map.
  shapes::QuadMesh ring = shapes::quad_grid(3);
  ring.points.insert(ring.points.end(), {{1.0 / 3, 2.0 / 3, 1.0 / 3}, {2.0 / 3, 2.0 / 3, 1.0 / 3}});
  ring.quads[4] = {16, 17, 10, 9};
  const Surface surface = ring.surface();
  std::vector<Eigen::Vector2d> places;
  for (const Vector& p : ring.points) places.push_back(p.head<2>());
  places[16] = places[5];
  places[17] = places[6];
  std::mt19937 random(1);
  std::uniform_real_distribution<double> shift(0.0, 0.9);
  const auto map = [&](double deeper) {
    const Eigen::Vector2d corner(shift(random), shift(random));
    CornerUvs uvs;
    for (const Triangle& t : surface.triangles()) {
      uvs.emplace_back();
      for (std::size_t i = 0; i < 3; ++i) {
        const Eigen::Vector2d at = corner + 0.059 * places[static_cast<std::size_t>(t[i])] +
                                   (t[i] >= 16 ? Eigen::Vector2d(0.0, -deeper) : Eigen::Vector2d(0.0, 0.0));
        for (Eigen::Index k = 0; k < 2; ++k) uvs.back()[i][k] = static_cast<double>(static_cast<float>(at[k]));
      }
    }
    return measure_map(surface, uvs);
  };
  for (int i = 0; i < 100; ++i) {
    const MapReport touching = map(0.0);
    ASSERT_TRUE(touching.flipped.empty());
    ASSERT_TRUE(touching.overlapping.empty());
    ASSERT_EQ(map(1e-5).overlapping.size(), 1U) << "deeper than rounding";
  }
}

TEST(MeasureMap, FindsIslandsOnOthers) {
  struct Case {
    Eigen::Vector2d place;
    double size;
    const char* what;
  };
  for (const auto& [place, size, what] :
       {Case{{0, 0}, 1.0, "exactly on it"}, Case{{0.25, 0.25}, 0.5, "inside it"},
        Case{{0.5, 0}, 1.0, "half on it, sides in line"}, Case{{0.5, 0.5}, 1.0, "corner in it"},
        Case{{0, 0}, 0.5, "in its corner"}, Case{{-1, -1}, 3.0, "around it"}, Case{{0.25, 0}, 0.5, "at its side"}}) {
    for (const double mirror : {1.0, -1.0}) {
      Squares squares = squares_at({{5, 5}, {0, 0}, {0, 0}, {-4, 0}});
      for (std::size_t f = 4; f < 6; ++f) {
        for (Eigen::Vector2d& uv : squares.uvs[f]) {
          uv = place + size * uv;
          if (mirror < 0.0) uv.x() = 2 * place.x() + size - uv.x();
        }
      }
      const std::vector<std::int32_t> islands{0, 0, 1, 1, 2, 2, 3, 3};
      const MapReport report = measure_map(squares.surface, squares.uvs, islands);
      EXPECT_EQ(report.colliding, (std::vector<std::int32_t>{1, 2})) << what;
      EXPECT_TRUE(report.overlapping.empty() && report.flipped.empty()) << what;
      if (mirror < 0.0) continue;
      const MapReport as_one =
          measure_map(squares.surface, squares.uvs, std::vector<std::int32_t>{0, 0, 1, 1, 1, 1, 2, 2});
      EXPECT_EQ(as_one.overlapping, std::vector<std::int32_t>{1}) << what;
      EXPECT_TRUE(as_one.colliding.empty()) << what;
    }
  }
}

/// Pieces of rectangles that share their corners, turned in the map.
struct Pieces {
  shapes::Mesh mesh;
  CornerUvs uvs;
  std::vector<std::int32_t> islands;
  double angle = 0.4;

  /// `rectangles`: left, bottom, width, height.
  void add(const std::vector<std::array<double, 4>>& rectangles, std::int32_t island) {
    std::map<std::array<double, 2>, std::int32_t> vertices;
    for (const auto& [x, y, width, height] : rectangles) {
      std::array<std::int32_t, 4> quad{};
      std::array<Eigen::Vector2d, 4> uv;
      for (std::size_t k = 0; k < 4; ++k) {
        const std::array<double, 2> at{x + (k == 1 || k == 2 ? width : 0.0), y + (k > 1 ? height : 0.0)};
        const auto [vertex, is_new] = vertices.try_emplace(at, static_cast<std::int32_t>(mesh.points.size()));
        if (is_new) mesh.points.emplace_back(at[0], at[1], static_cast<double>(islands.size()));
        quad[k] = vertex->second;
        uv[k] = Eigen::Rotation2Dd(angle) * Eigen::Vector2d(at[0], at[1]);
      }
      mesh.triangles.push_back({quad[0], quad[1], quad[2]});
      uvs.push_back({uv[0], uv[1], uv[2]});
      mesh.triangles.push_back({quad[0], quad[2], quad[3]});
      uvs.push_back({uv[0], uv[2], uv[3]});
      islands.insert(islands.end(), {island, island});
    }
  }
  MapReport measured(const Task& task = {}) const { return measure_map(mesh.surface(), uvs, islands, task); }
};

TEST(MeasureMap, FindsWhatCountingSquaresFinds) {
  std::mt19937 random(3);
  const auto below = [&](int count) { return std::uniform_int_distribution(0, count - 1)(random); };
  int overlapping_count = 0, colliding_count = 0;
  for (int round = 0; round < 500; ++round) {
    Pieces pieces;
    pieces.angle = round % 2 * below(100) * 0.0628;
    const int count = 2 + below(12), island_count = 1 + below(count), size = 6 + below(12);
    std::map<std::array<int, 2>, std::vector<std::int32_t>> islands_at;
    for (int i = 0; i < count; ++i) {
      const int width = 1 + below(4), height = 1 + below(4), left = below(size), bottom = below(size);
      // With a hole, on both sides of which squares are left.
      const bool has_hole = width > 2 && height > 2;
      std::vector<std::array<double, 4>> squares;
      const std::int32_t island = i % island_count;
      for (int x = 0; x < width; ++x) {
        for (int y = 0; y < height; ++y) {
          if (has_hole && x == 1 && y == 1) continue;
          squares.push_back({static_cast<double>(left + x), static_cast<double>(bottom + y), 1.0, 1.0});
          islands_at[{left + x, bottom + y}].push_back(island);
        }
      }
      pieces.add(squares, island);
    }
    std::set<std::int32_t> overlapping, colliding;
    for (const auto& [place, islands] : islands_at) {
      const std::set<std::int32_t> distinct(islands.begin(), islands.end());
      if (distinct.size() > 1) colliding.insert(distinct.begin(), distinct.end());
      for (const std::int32_t island : distinct) {
        if (std::ranges::count(islands, island) > 1) overlapping.insert(island);
      }
    }
    const MapReport report = pieces.measured();
    ASSERT_EQ(report.overlapping, std::vector<std::int32_t>(overlapping.begin(), overlapping.end())) << round;
    ASSERT_EQ(report.colliding, std::vector<std::int32_t>(colliding.begin(), colliding.end())) << round;
    overlapping_count += overlapping.empty() ? 0 : 1;
    colliding_count += colliding.empty() ? 0 : 1;
  }
  EXPECT_TRUE(overlapping_count > 50 && overlapping_count < 450) << overlapping_count;
  EXPECT_TRUE(colliding_count > 50 && colliding_count < 450) << colliding_count;
}

/// `measured(count, task)` measures a map of so many parts. It looks at its task once in 4096 pairs of parts.
void expect_in_proportion(const std::function<void(int count, const Task& task)>& measured) {
  const auto looks_at = [&](int count) {
    std::size_t looks = 0;
    measured(count, {.stop = {}, .progress = [&](double) { return ++looks > 0; }});
    return looks;
  };
  EXPECT_LE(looks_at(8000), 5 * looks_at(2000));
}

TEST(MeasureMap, AStripManyTimesAroundARingTakesTimeInProportion) {
  expect_in_proportion([](int count, const Task& task) {
    const Strip strip = around_a_ring(static_cast<std::size_t>(count), 0.3);
    EXPECT_EQ(measure_map(strip.surface, strip.uvs, {}, task).overlapping, std::vector<std::int32_t>{0});
  });
}

TEST(MeasureMap, IslandsOnEachOtherTakeTimeInProportion) {
  using Rectangle = std::array<double, 4>;
  const std::array<std::function<Rectangle(double)>, 4> places{[](double) -> Rectangle {
                                                                 return {0.25, 0.0, 1.0, 1.0};
                                                               },  // exactly
                                                               [](double t) -> Rectangle {
                                                                 return {t / 2, 0.0, 1.0, 1.0};
                                                               },  // with sides in line
                                                               [](double t) -> Rectangle {
                                                                 return {std::cos(99 * t), t, 3.0, 2.0};
                                                               },  // crossing each other
                                                               [](double t) -> Rectangle {
                                                                 return {-1 - t, -1 - t, 2 + 2 * t, 2 + 2 * t};
                                                               }};  // inside each other
  for (const auto& place : places) {
    expect_in_proportion([&](int count, const Task& task) {
      Pieces pieces;
      for (int i = 0; i < count; ++i) pieces.add({place(1.0 * i / count)}, i);
      EXPECT_EQ(pieces.measured(task).colliding.size(), static_cast<std::size_t>(count));
    });
  }
}

TEST(MeasureMap, LongIslandsSideBySideTakeTimeInProportion) {
  expect_in_proportion([](int count, const Task& task) {
    Pieces pieces;
    for (int i = 0; i < count; ++i) pieces.add({{0.0, 2.0 * i, 1.0 * count, 1.0}}, i);
    EXPECT_TRUE(pieces.measured(task).colliding.empty());
  });
}

TEST(MeasureMap, CombsInEachOtherTakeTimeInProportion) {
  expect_in_proportion([](int count, const Task& task) {
    std::vector<std::array<double, 4>> lower, upper;
    for (int i = 0; i < count; ++i) {
      const double x = i, height = count;
      lower.push_back({x, 0.0, 1.0, 1.0});
      upper.push_back({x + 0.5, height + 1.0, 1.0, 1.0});
      if (i % 4 == 0) lower.push_back({x, 1.0, 1.0, height - 1.0});
      if (i % 4 == 2) upper.push_back({x + 0.5, 2.0, 1.0, height - 1.0});
    }
    Pieces pieces;
    pieces.add(lower, 0);
    pieces.add(upper, 1);
    const MapReport report = pieces.measured(task);
    EXPECT_TRUE(report.overlapping.empty() && report.colliding.empty());
  });
}

TEST(MeasureMap, AHundredThousandPiecesAreMeasuredAndCanBeCancelled) {
  std::vector<Eigen::Vector2d> places;
  for (int i = 0; i < 316; ++i) {
    for (int j = 0; j < 316; ++j) places.emplace_back(i, j);
  }
  const Squares squares = squares_at(places);
  const std::vector<std::int32_t> islands(squares.uvs.size(), 0);
  EXPECT_TRUE(measure_map(squares.surface, squares.uvs, islands).overlapping.empty());
  int asked = 0;
  const Task task{.stop = {}, .progress = [&](double fraction) { return fraction < 0.5 || ++asked < 50; }};
  EXPECT_THROW(measure_map(squares.surface, squares.uvs, islands, task), Cancelled);
}

TEST(MeasureMap, SeesThatAMapWindsAroundAVertexTwice) {
  // A fan of ten triangles around vertex 0 that turns twice in the map: no triangle is flipped.
  shapes::Mesh mesh;
  mesh.points = {{0, 0, 0.3}};
  CornerUvs uvs;
  const auto around = [](int i, double turns) {
    const double a = 2 * std::numbers::pi * turns * i / 10;
    return Eigen::Vector2d(std::cos(a), std::sin(a));
  };
  for (int i = 0; i < 10; ++i) {
    mesh.points.emplace_back(around(i, 1).x(), around(i, 1).y(), 0.0);
    mesh.triangles.push_back({0, 1 + i, 1 + (i + 1) % 10});
    uvs.push_back({Eigen::Vector2d(0, 0), around(i % 10, 2), around((i + 1) % 10, 2)});
  }
  const MapReport report = measure_map(mesh.surface(), uvs);
  EXPECT_TRUE(report.flipped.empty());
  EXPECT_EQ(report.overlapping, std::vector<std::int32_t>{0});
}

TEST(MeasureMap, RefusesWrongArrays) {
  const Surface surface = shapes::grid(1).surface();
  CornerUvs uvs(2, {Eigen::Vector2d(0, 0), Eigen::Vector2d(1, 0), Eigen::Vector2d(0, 1)});
  EXPECT_THROW(measure_map(surface, uvs, std::vector<std::int32_t>{0}), InvalidInput);
  EXPECT_THROW(measure_map(surface, uvs, std::vector<std::int32_t>{0, -1}), InvalidInput);
  EXPECT_THROW(measure_map(surface, uvs, std::vector<std::int32_t>{0, 2}), InvalidInput);
  uvs[1][2].y() = std::nan("");
  EXPECT_THROW(measure_map(surface, uvs), InvalidInput);
  uvs.pop_back();
  EXPECT_THROW(measure_map(surface, uvs), InvalidInput);
}

}  // namespace
}  // namespace seamwire
