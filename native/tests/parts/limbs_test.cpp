// SPDX-License-Identifier: GPL-3.0-or-later
#include "seamwire_uv/parts/part_finder.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <map>
#include <memory>
#include <numbers>
#include <random>
#include <set>
#include <utility>
#include <vector>

#include "detail/infinity.hpp"
#include "parts/limbs.hpp"
#include "prices/plan_mesh.hpp"
#include "seamwire/errors.hpp"
#include "seamwire_uv/parts/scanned_edges.hpp"
#include "shapes.hpp"
#include "surface/real_edges.hpp"

namespace seamwire {
namespace {

/// A ball with six limbs, along the axes.
shapes::Mesh star(int level) {
  shapes::Mesh mesh = shapes::icosphere(level, 1.0);
  for (Vector& p : mesh.points) {
    const double nearest = std::acos(std::min(1.0, p.cwiseAbs().maxCoeff()));
    p *= 1.0 + 2.0 * std::exp(-std::pow(nearest / 0.35, 4.0));
  }
  return mesh;
}

PartFinder finder_of(const shapes::Mesh& mesh, const PartOptions& options = {.by = PartsBy::kLimbs}) {
  return PartFinder(std::make_shared<const Surface>(mesh.points, mesh.triangles), options);
}

/// The part of the vertex farthest along each direction of an axis.
std::set<std::int32_t> parts_of_tips(const shapes::Mesh& mesh, const Parts& parts) {
  std::set<std::int32_t> found;
  for (int axis = 0; axis < 3; ++axis) {
    for (const double sign : {-1.0, 1.0}) {
      const auto tip = std::ranges::max_element(mesh.triangles, {}, [&](const Triangle& t) {
        return sign * (mesh.points[t[0]] + mesh.points[t[1]] + mesh.points[t[2]])[axis];
      });
      found.insert(parts.of_face[tip - mesh.triangles.begin()]);
    }
  }
  return found;
}

TEST(Limbs, AreThoseOfAStarAndItsBody) {
  for (const int level : {3, 4, 5}) {
    const shapes::Mesh mesh = star(level);
    const Parts parts = finder_of(mesh).find();
    EXPECT_EQ(parts.count, 7u) << level;
    EXPECT_EQ(parts_of_tips(mesh, parts).size(), 6u) << level;
    EXPECT_EQ(parts.borders.size(), 6u) << level;
    for (const std::vector<std::int32_t>& border : parts.borders) EXPECT_EQ(border.front(), border.back()) << level;
  }
}

TEST(Limbs, AreFoundInNoise) {
  shapes::Mesh mesh = star(4);
  const double edge = (mesh.points[mesh.triangles[0][0]] - mesh.points[mesh.triangles[0][1]]).norm();
  std::mt19937 random(1);
  std::normal_distribution<double> noise(0.0, 0.1 * edge);
  for (Vector& p : mesh.points) p += Vector(noise(random), noise(random), noise(random));
  const Parts parts = finder_of(mesh).find();
  EXPECT_EQ(parts.count, 7u);
  EXPECT_EQ(parts_of_tips(mesh, parts).size(), 6u);
}

TEST(Limbs, AreDividedByALargerAmount) {
  const PartFinder finder = finder_of(shapes::bumpy(star(4), 0.05));
  Parts coarse = finder.find(0.0);
  EXPECT_EQ(coarse.count, 1u);
  for (const double amount : {0.2, 0.4, 0.6, 0.8, 1.0}) {
    const Parts fine = finder.find(amount);
    EXPECT_GE(fine.count, coarse.count);
    // Borders move a little, so that each is short.
    std::vector<std::map<std::int32_t, std::size_t>> within(fine.count);
    for (std::size_t f = 0; f < fine.of_face.size(); ++f) ++within[fine.of_face[f]][coarse.of_face[f]];
    for (const auto& counts : within) {
      std::size_t all = 0, most = 0;
      for (const auto& [part, count] : counts) {
        all += count;
        most = std::max(most, count);
      }
      EXPECT_GE(2 * most, all) << amount << ": a part lies in two parts of the amount before";
    }
    coarse = fine;
  }
  EXPECT_GT(coarse.count, 7u);
}

TEST(Limbs, StayWhereAMeshIsTurnedMovedAndScaled) {
  const shapes::Mesh mesh = star(3);
  const Parts parts = finder_of(mesh).find(0.7);
  shapes::Mesh turned = mesh;
  const Eigen::AngleAxisd turn(1.0, Vector(1.0, 2.0, 3.0).normalized());
  for (Vector& p : turned.points) p = 1e4 * (turn * p) + Vector(3e4, 0.0, 1e4);
  EXPECT_EQ(finder_of(turned).find(0.7).of_face, parts.of_face);
}

TEST(Limbs, OfEachPieceAreFoundByThemselves) {
  shapes::Mesh both = star(3);
  const std::size_t own = both.triangles.size();
  const auto shift = static_cast<std::int32_t>(both.points.size());
  for (const Vector& p : star(3).points) both.points.emplace_back(0.01 * p + Vector(9.0, 0.0, 0.0));
  for (std::size_t f = 0; f < own; ++f) {
    const auto [a, b, c] = both.triangles[f];
    both.triangles.push_back({a + shift, b + shift, c + shift});
  }
  // A single triangle and a flat strip of two.
  const auto next = static_cast<std::int32_t>(both.points.size());
  for (int i = 0; i < 7; ++i) both.points.emplace_back(i, 20.0 + i % 2, i < 3 ? 0.0 : 5.0);
  both.triangles.insert(both.triangles.end(), {{next, next + 1, next + 2}, {next + 3, next + 4, next + 5}});
  both.triangles.push_back({next + 5, next + 4, next + 6});
  EXPECT_EQ(finder_of(both).find().count, 16u);
}

TEST(Limbs, EndAtRealEdgesOnly) {
  const shapes::Mesh mesh = star(4);
  std::vector<Edge> real = mesh.surface().edges();
  std::mt19937 random(1);
  std::ranges::shuffle(real, random);
  real.resize(real.size() * 3 / 4);
  const auto surface = std::make_shared<const Surface>(mesh.points, mesh.triangles, real);
  for (const int mirror : {-1, 0}) {
    const Parts parts = PartFinder(surface, {.by = PartsBy::kLimbs, .mirror = mirror}).find();
    EXPECT_GE(parts.count, 6u);
    for (const std::vector<std::int32_t>& border : parts.borders) {
      for (std::size_t i = 1; i < border.size(); ++i) {
        EXPECT_TRUE(detail::has_edge(*surface, {border[i - 1], border[i]}));
      }
    }
  }
}

TEST(Limbs, GoOnOverTrianglesWithoutArea) {
  // A cancelled extrusion leaves such a ring.
  const shapes::Mesh drum = shapes::lathe(24, {{-1, 0}, {-1, 0.5}, {0, 0.5}, {0, 0.5}, {1, 0.5}, {1, 0}});
  EXPECT_EQ(finder_of(drum).find(0.0).count, 1u);
}

TEST(Limbs, AreOneWhereTheSurfaceHasNone) {
  for (const shapes::Mesh& mesh : {shapes::icosphere(3), shapes::grid(12), shapes::torus(32, 16)}) {
    EXPECT_EQ(finder_of(mesh).find().count, 1u);
  }
  EXPECT_EQ(finder_of({{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}, {{0, 1, 2}}}).find().count, 1u) << "no area";
}

TEST(Limbs, ShapeTellsFiguresFromMachineParts) {
  const PartOptions by_shape{.by = PartsBy::kShape, .is_scan = true};
  EXPECT_EQ(finder_of(star(4), by_shape).by(), PartsBy::kLimbs);
  EXPECT_EQ(finder_of(star(4), {.by = PartsBy::kShape, .is_scan = false}).by(), PartsBy::kRims)
      << "5,000 edges of an artist";
  EXPECT_EQ(finder_of(star(5), {.by = PartsBy::kShape}).by(), PartsBy::kLimbs) << "20,000 triangles";
  EXPECT_EQ(finder_of(shapes::grid(8), by_shape).by(), PartsBy::kRims);
  const PartFinder cube(std::make_shared<const Surface>(shapes::quad_cube(8).surface()), by_shape);
  EXPECT_EQ(cube.by(), PartsBy::kRims);
  EXPECT_EQ(cube.find(1.0).count, 6u);
}

TEST(Limbs, ShapeDecidesItselfWhatAScanIs) {
  const shapes::Mesh mesh = star(4);
  const bool is_scan = has_scanned_edges(mesh.points, mesh.triangles);
  EXPECT_EQ(finder_of(mesh, {.by = PartsBy::kShape}).by(), is_scan ? PartsBy::kLimbs : PartsBy::kRims);
}

TEST(Limbs, ShapeOfASoftBodyHasNoRims) {
  // A ball, and an eye with a sharp rim at its pole.
  constexpr double kEye = 0.3, kHigh = 1.03;
  std::vector<std::array<double, 2>> profile;
  for (int i = 0; i <= 32; ++i) {
    const double angle = std::numbers::pi * i / 32;
    const double radius = angle < kEye ? kHigh : 1.0;
    if (i > 0 && angle >= kEye && angle - std::numbers::pi / 32 < kEye) {
      for (const double rim : {kHigh, 1.0}) profile.push_back({rim * std::cos(kEye), rim * std::sin(kEye)});
    }
    profile.push_back({radius * std::cos(angle), i == 0 || i == 32 ? 0.0 : radius * std::sin(angle)});
  }
  const shapes::Mesh mesh = shapes::lathe(32, profile);
  EXPECT_GE(finder_of(mesh, {.by = PartsBy::kRims}).find().count, 2u);
  const PartFinder by_shape = finder_of(mesh, {.by = PartsBy::kShape});
  EXPECT_EQ(by_shape.by(), PartsBy::kLimbs);
  EXPECT_EQ(by_shape.find().count, 1u);
}

TEST(Limbs, AreJoinedOverExposedBorders) {
  const shapes::Mesh grid = shapes::grid(8);
  const detail::PlanMesh mesh = detail::plan_mesh(Surface(grid.points, grid.triangles), {});
  double left = detail::kInfinity, right = -detail::kInfinity, low = left, high = right;
  for (const Vector& p : mesh.points) {
    left = std::min(left, p.x());
    right = std::max(right, p.x());
    low = std::min(low, p.y());
    high = std::max(high, p.y());
  }
  std::vector<std::int32_t> halves;
  for (const auto& [a, b, c] : mesh.triangles) {
    const double x = (mesh.points[a].x() + mesh.points[b].x() + mesh.points[c].x()) / 3.0;
    halves.push_back(x < 0.5 * (left + right) ? 3 : 5);
  }
  const auto count = [&](const auto& open_at) {
    std::vector<double> open;
    for (const Vector& p : mesh.points) open.push_back(open_at(p));
    std::vector<std::int32_t> of_face = halves;
    detail::join_exposed(mesh, open, of_face, {});
    return std::set<std::int32_t>(of_face.begin(), of_face.end()).size();
  };
  EXPECT_EQ(count([](const Vector&) { return 2.0; }), 1u) << "a face";
  EXPECT_EQ(count([](const Vector&) { return 0.5; }), 2u) << "a place that nobody sees";
  EXPECT_EQ(count([&](const Vector& p) { return p.y() > 0.5 * (low + high) ? 2.0 : 0.0; }), 2u) << "a ring";
}

TEST(Limbs, AreMirrored) {
  const shapes::Mesh mesh = star(4);
  for (const int axis : {0, 1, 2}) {
    const Parts parts = finder_of(mesh, {.by = PartsBy::kLimbs, .mirror = axis}).find();
    EXPECT_EQ(parts.count, 7u);
    std::map<std::array<double, 3>, std::int32_t> part_at;
    const auto place = [&](const Triangle& t, double sign) {
      Vector center = mesh.points[t[0]] + mesh.points[t[1]] + mesh.points[t[2]];
      center[axis] *= sign;
      return std::array{std::round(1e6 * center.x()), std::round(1e6 * center.y()), std::round(1e6 * center.z())};
    };
    for (std::size_t f = 0; f < mesh.triangles.size(); ++f) part_at[place(mesh.triangles[f], 1.0)] = parts.of_face[f];
    std::set<std::array<std::int32_t, 2>> pairs;
    for (std::size_t f = 0; f < mesh.triangles.size(); ++f) {
      pairs.insert({parts.of_face[f], part_at.at(place(mesh.triangles[f], -1.0))});
    }
    EXPECT_EQ(pairs.size(), 7u) << "each limb has one image";
  }
}

TEST(Limbs, EditsOutweighThem) {
  const PartFinder finder = finder_of(star(4));
  const Parts before = finder.find();
  std::vector<Edge> first;
  const std::vector<std::int32_t>& border = before.borders.front();
  for (std::size_t i = 1; i < border.size(); ++i) first.push_back({border[i - 1], border[i]});
  EXPECT_EQ(finder.find(0.5, {.dropped = {first.front()}}).count, 6u);
  EXPECT_EQ(finder.find(0.0, {.kept = first}).count, 2u);
  EXPECT_EQ(finder.find(0.5, {.parted = {0}}).count, 8u);
}

TEST(Limbs, RefuseAnAmountOutOfRange) {
  const PartFinder finder = finder_of(shapes::grid(2));
  for (const double wrong : {-0.1, 1.1, std::numeric_limits<double>::quiet_NaN()}) {
    EXPECT_THROW(finder.find(wrong), InvalidInput);
  }
}

}  // namespace
}  // namespace seamwire
