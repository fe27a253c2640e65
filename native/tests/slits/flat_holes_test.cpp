// SPDX-License-Identifier: GPL-3.0-or-later
#include "slits/flat_holes.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "maps/cut_open.hpp"
#include "shapes.hpp"
#include "surface/corner_fans.hpp"
#include "surface/cuts.hpp"

namespace seamwire {

using namespace detail;

namespace {

/// A ring of revolution about the z axis, with edges along a profile of points (radius, height).
Surface ring(const std::vector<std::array<double, 2>>& profile) {
  const int rows = static_cast<int>(profile.size()) - 1;
  return shapes::parametric(48, rows, true, false,
                            [&](double u, double v) {
                              const auto [radius, height] = profile[static_cast<std::size_t>(std::lround(v * rows))];
                              const double a = 2.0 * std::numbers::pi * u;
                              return Vector(radius * std::cos(a), radius * std::sin(a), height);
                            })
      .surface();
}

/// Points on straight lines between the corners of a profile.
std::vector<std::array<double, 2>> lines(const std::vector<std::array<double, 2>>& corners) {
  constexpr int kParts = 6;
  std::vector<std::array<double, 2>> profile = {corners.front()};
  for (std::size_t i = 1; i < corners.size(); ++i) {
    for (int k = 1; k <= kParts; ++k) {
      const double t = static_cast<double>(k) / kParts;
      profile.push_back(
          {std::lerp(corners[i - 1][0], corners[i][0], t), std::lerp(corners[i - 1][1], corners[i][1], t)});
    }
  }
  return profile;
}

struct Counts {
  std::size_t loops = 0;
  std::ptrdiff_t flat = 0;
  bool operator==(const Counts&) const = default;
};

Counts counts(const Surface& surface, const std::vector<Edge>& seams = {}) {
  const Cuts cuts(surface, seams, "seams", {});
  Island island = cut_open(corner_fans(surface), cut_half_edges(surface, cuts)).front();
  for (std::int32_t& v : island.vertices) v = corner_fans(surface).vertices[v];
  const auto boundaries = island.boundaries();
  const std::vector<std::uint8_t> is_flat = flat_holes(island, surface.points(), boundaries, {});
  EXPECT_EQ(is_flat.size(), boundaries.size());
  return {boundaries.size(), std::ranges::count(is_flat, 1)};
}

TEST(FlatHoles, LieInPlanesAndWideCones) {
  EXPECT_EQ(counts(ring(lines({{0.5, 0.0}, {1.0, 0.0}}))), (Counts{2, 1}));
  EXPECT_EQ(counts(ring(lines({{0.95, 0.0}, {1.0, 0.0}}))), (Counts{2, 1})) << "a thin washer";
  EXPECT_EQ(counts(ring(lines({{0.2, 0.4}, {1.0, 0.0}}))), (Counts{2, 1}));
  EXPECT_EQ(counts(ring(lines({{0.2, 0.8}, {1.0, 0.0}}))), (Counts{2, 0})) << "a steep cone";
}

TEST(FlatHoles, AreNotTheEndsOfTubes) {
  EXPECT_EQ(counts(ring(lines({{1.0, 0.0}, {1.0, 2.0}}))), (Counts{2, 0}));
  EXPECT_EQ(counts(ring(lines({{1.0, 0.0}, {1.0, 0.2}}))), (Counts{2, 0})) << "a belt";
  EXPECT_EQ(counts(ring(lines({{1.0, 0.0}, {1.0, 2.0}, {0.9, 2.0}}))), (Counts{2, 0})) << "with a narrow flange";
  EXPECT_EQ(counts(ring(lines({{0.2, 0.0}, {0.2, 1.0}, {2.0, 1.0}}))), (Counts{2, 0})) << "a pipe on a plate";
}

TEST(FlatHoles, AreNotTheFlaringEndsOfANeck) {
  std::vector<std::array<double, 2>> neck;
  for (int i = 0; i <= 12; ++i) {
    const double a = std::numbers::pi * i / 12.0;
    neck.push_back({0.35 - 0.15 * std::sin(a), 0.15 * std::cos(a)});
  }
  EXPECT_EQ(counts(ring(neck)), (Counts{2, 0}));
}

TEST(FlatHoles, AreNotTheSidesOfASeamAroundAHandle) {
  // Around the top of the torus, where it is horizontal.
  std::vector<Edge> seam;
  for (std::int32_t i = 0; i < 24; ++i) seam.push_back({72 + i, 72 + (i + 1) % 24});
  EXPECT_EQ(counts(shapes::torus(24, 12).surface(), seam), (Counts{2, 0}));
}

TEST(FlatHoles, AreOpenSeamsWithoutCurvatureOnThem) {
  constexpr int kSide = 32;
  const auto hill = [](auto height) {
    return shapes::parametric(kSide, kSide, false, false,
                              [&](double u, double v) {
                                const double x = 2.0 * u - 1.0, y = 2.0 * v - 1.0;
                                return Vector(x, y, height(std::hypot(x, y)));
                              })
        .surface();
  };
  std::vector<Edge> seam;
  for (std::int32_t i = 10; i < 22; ++i) seam.push_back({16 * (kSide + 1) + i, 16 * (kSide + 1) + i + 1});
  EXPECT_EQ(counts(hill([](double r) { return -r * r; }), seam), (Counts{2, 1})) << "the dome around it is curved";
  EXPECT_EQ(counts(hill([](double r) { return -1.5 * r; }), seam), (Counts{2, 0})) << "over the tip of a cone";
}

TEST(FlatHoles, MayHaveACollar) {
  EXPECT_EQ(counts(ring(lines({{0.2, 0.1}, {0.2, 0.0}, {1.0, 0.0}}))), (Counts{2, 1}));
  EXPECT_EQ(counts(ring(lines({{0.2, 0.2}, {0.2, 0.0}, {1.0, 0.0}}))), (Counts{2, 1}));
}

TEST(FlatHoles, NeedAnOuterLoop) {
  EXPECT_EQ(counts(shapes::icosphere(1).surface()), (Counts{0, 0}));
  EXPECT_EQ(counts(shapes::grid(4).surface()), (Counts{1, 0}));
}

TEST(FlatHoles, MayBeMany) {
  constexpr int kSide = 64;
  shapes::QuadMesh sieve = shapes::quad_grid(kSide);
  int quad = 0;
  std::erase_if(sieve.quads, [&](const auto&) {
    const int column = quad % kSide, row = quad++ / kSide;
    return column % 3 == 1 && row % 3 == 1;
  });
  EXPECT_EQ(counts(sieve.surface()), (Counts{442, 441}));
}

}  // namespace
}  // namespace seamwire
