// SPDX-License-Identifier: GPL-3.0-or-later
#include "seamwire/wires/bent_wires.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <functional>
#include <numbers>
#include <optional>
#include <vector>

#include "seamwire/metric/metric.hpp"
#include "shapes.hpp"
#include "unowned.hpp"

namespace seamwire {
namespace {

constexpr double kTau = 2 * std::numbers::pi;
constexpr int kAround = 24;

/// The first closed cut through a seed in the Euclidean metric, to be bent.
struct Cut {
  Cut(const shapes::Mesh& mesh, std::int32_t from)
      : surface(mesh.surface()),
        embedding(embed(surface, euclidean_metric(surface, principal_curvatures(surface)), {.max_error = 0})),
        geodesics(embedding.mesh),
        seed(from),
        field(geodesics.solve(from)),
        cuts(closed_wires(surface, embedding, field)) {}

  BentWires bent() const { return {unowned(surface), unowned(embedding), geodesics, field, cuts.at(0)}; }
  const Vector& point(std::int32_t vertex) const { return surface.points()[vertex]; }

  Surface surface;
  Embedding embedding;
  ExactGeodesics geodesics;
  std::int32_t seed;
  DistanceField field;
  std::vector<ClosedWire> cuts;
};

std::vector<Vector> loop(const BentWire& bent) {
  std::vector<Vector> points = bent.there.points;
  points.insert(points.end(), bent.back.points.begin(), bent.back.points.end());
  return points;
}

/// How often a closed line goes around, by the angle of each of its points.
double turns(const std::vector<Vector>& points, const std::function<double(const Vector&)>& angle) {
  double sum = 0.0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    sum += std::remainder(angle(points[(i + 1) % points.size()]) - angle(points[i]), kTau);
  }
  return sum / kTau;
}

double around_axis(const Vector& p) { return std::atan2(p.y(), p.x()); }
double around_tube(const Vector& p) { return std::atan2(p.z(), std::hypot(p.x(), p.y()) - 0.35); }

/// Both ways around a prism of kAround sides, from a corner to one `steps` on and `height` above.
double on_prism(double radius, int steps, double height) {
  const double side = 2 * radius * std::sin(std::numbers::pi / kAround);
  return std::hypot(side * steps, height) + std::hypot(side * (kAround - steps), height);
}

void expect_joined(const Cut& cut, const BentWire& bent, const Vector& second) {
  for (const Wire* wire : {&bent.there, &bent.back}) {
    ASSERT_GE(wire->points.size(), 2U);
    ASSERT_EQ(wire->faces.size() + 1, wire->points.size());
    EXPECT_NEAR(wire->length, wire->euclidean_length, 1e-6 * wire->length);
  }
  EXPECT_EQ(bent.there.points.front(), cut.point(cut.seed));
  EXPECT_EQ(bent.back.points.back(), cut.point(cut.seed));
  EXPECT_LT((bent.there.points.back() - second).norm(), 1e-12);
  EXPECT_LT((bent.back.points.front() - second).norm(), 1e-12);
}

TEST(BentWires, AroundAnOpenTubeBothWaysLeadAsStraightAsTheyCan) {
  const Cut cut(shapes::cylinder(kAround, 30), kAround * 15);
  const BentWires bent = cut.bent();
  for (const int steps : {0, 3, 8, 12, 19}) {
    for (const int row : {12, 15, 19}) {
      if (steps == 0 && row == 15) continue;
      const std::int32_t second = kAround * row + steps;
      const std::optional<BentWire> found = bent.through(SurfacePoint(second));
      ASSERT_TRUE(found) << steps << " " << row;
      expect_joined(cut, *found, cut.point(second));
      const double length = (found->there.euclidean_length + found->back.euclidean_length);
      EXPECT_NEAR(length, on_prism(0.25, steps, std::abs(row - 15) / 30.0), 1e-9) << steps << " " << row;
      EXPECT_NEAR(std::abs(turns(loop(*found), around_axis)), 1.0, 1e-9) << steps << " " << row;
    }
  }
}

TEST(BentWires, AroundAClosedLimbTooAndThroughAPointWithinAFace) {
  // Two balls and a neck between them: the cut is the neck, and what is bent goes around it still.
  const Cut cut(shapes::parametric(kAround, 40, true, false,
                                   [](double u, double v) {
                                     const double z = v - 0.5, r = 0.05 + std::sqrt(0.25 - 0.99 * z * z) * z * z;
                                     return Vector(r * std::cos(kTau * u), r * std::sin(kTau * u), z);
                                   }),
                kAround * 20);
  ASSERT_FALSE(cut.cuts.empty());
  const BentWires bent = cut.bent();
  for (const std::int32_t face : {2 * kAround * 14 + 5, 2 * kAround * 20 + 30, 2 * kAround * 26 + 11}) {
    const auto& [a, b, c] = cut.surface.triangles()[face];
    const Vector second = 0.2 * cut.point(a) + 0.3 * cut.point(b) + 0.5 * cut.point(c);
    const std::optional<BentWire> found = bent.through({face, {0.2, 0.3, 0.5}});
    ASSERT_TRUE(found) << face;
    expect_joined(cut, *found, second);
    EXPECT_NEAR(std::abs(turns(loop(*found), around_axis)), 1.0, 1e-9) << face;
  }
}

TEST(BentWires, AroundAHandleItGoesAroundTheSameHandle) {
  const Cut cut(shapes::torus(60, 30), 0);
  ASSERT_FALSE(cut.cuts.at(0).separates);
  const BentWires bent = cut.bent();
  for (const std::int32_t second : {2 + 60 * 10, 57 + 60 * 15, 5, 60 * 22 + 1}) {
    const std::optional<BentWire> found = bent.through(SurfacePoint(second));
    ASSERT_TRUE(found) << second;
    expect_joined(cut, *found, cut.point(second));
    EXPECT_NEAR(std::abs(turns(loop(*found), around_tube)), 1.0, 1e-9) << second;
    EXPECT_NEAR(turns(loop(*found), around_axis), 0.0, 1e-9) << second;
  }
}

TEST(BentWires, ThroughAPointOfTheCutItIsTheCut) {
  const Cut cut(shapes::cylinder(kAround, 30), kAround * 15);
  const std::optional<BentWire> found = cut.bent().through(SurfacePoint(kAround * 15 + 10));
  ASSERT_TRUE(found);
  EXPECT_NEAR((found->there.euclidean_length + found->back.euclidean_length), on_prism(0.25, 10, 0.0), 1e-9);
}

TEST(BentWires, AHoleBesideTheCutDoesNotKeepItFromLeadingAround) {
  // A tube with a hole in its wall above the cut: the shortest way may lead along the hole's border.
  const auto torn = [](const Vector& p) { return p.x() < -0.15 && std::abs(p.z() - 0.62) < 0.06; };
  const shapes::Mesh mesh = shapes::without(shapes::cylinder(kAround, 30), torn);
  const Cut cut(mesh, kAround * 15);
  ASSERT_FALSE(cut.cuts.empty());
  ASSERT_NEAR(std::abs(turns(cut.cuts[0].wire.points, around_axis)), 1.0, 1e-9);
  const std::int32_t second = kAround * 21 + 13;
  const std::optional<BentWire> found = cut.bent().through(SurfacePoint(second));
  ASSERT_TRUE(found);
  EXPECT_NEAR(std::abs(turns(loop(*found), around_axis)), 1.0, 1e-9);
}

TEST(BentWires, NoneLeadsToAnotherPartOfTheSurface) {
  shapes::Mesh mesh = shapes::cylinder(kAround, 30);
  const auto other = static_cast<std::int32_t>(mesh.points.size());
  for (const Vector& p : {Vector(3, 0, 0), Vector(4, 0, 0), Vector(3, 1, 0)}) mesh.points.push_back(p);
  mesh.triangles.push_back({other, other + 1, other + 2});
  const Cut cut(mesh, kAround * 15);
  EXPECT_FALSE(cut.bent().through(SurfacePoint(other)));
  EXPECT_FALSE(cut.bent().through(SurfacePoint(kAround * 15))) << "the seed itself";
}

TEST(BentWires, WhatIsOfSomethingElseIsRefused) {
  const Cut cut(shapes::cylinder(kAround, 30), kAround * 15);
  EXPECT_THROW(BentWires(unowned(cut.surface), unowned(cut.embedding), cut.geodesics, cut.field, ClosedWire{}),
               InvalidInput);
  const DistanceField two = cut.geodesics.solve(std::vector{SurfacePoint(0), SurfacePoint(5)});
  EXPECT_THROW(BentWires(unowned(cut.surface), unowned(cut.embedding), cut.geodesics, two, cut.cuts[0]), InvalidInput);
  const Cut beside(shapes::cylinder(kAround, 30), kAround * 16), finer(shapes::cylinder(kAround, 31), kAround * 15);
  EXPECT_THROW(BentWires(unowned(cut.surface), unowned(cut.embedding), cut.geodesics, cut.field, beside.cuts[0]),
               InvalidInput);
  EXPECT_THROW(BentWires(unowned(cut.surface), unowned(cut.embedding), cut.geodesics, cut.field, finer.cuts[0]),
               InvalidInput);
  EXPECT_THROW(BentWires(unowned(cut.surface), unowned(cut.embedding), finer.geodesics, cut.field, cut.cuts[0]),
               InvalidInput);
  EXPECT_THROW(BentWires(unowned(cut.surface), unowned(cut.embedding), cut.geodesics, finer.field, cut.cuts[0]),
               InvalidInput);
  EXPECT_THROW(BentWires(unowned(cut.surface), unowned(finer.embedding), finer.geodesics, finer.field, finer.cuts[0]),
               InvalidInput);
  EXPECT_THROW(closed_wires(cut.surface, finer.embedding, finer.field), InvalidInput);
  EXPECT_THROW(closed_wires(cut.surface, cut.embedding, finer.field), InvalidInput);
  EXPECT_THROW(cut.bent().through(SurfacePoint(100'000)), InvalidInput);
  EXPECT_THROW(cut.bent().through({100'000, {1, 0, 0}}), InvalidInput);
  const BentWires bent = cut.bent();
  for (std::int32_t face = 0; face < static_cast<std::int32_t>(cut.embedding.mesh.face_count()); ++face) {
    // Of all faces, those that the deepest places took out too.
    EXPECT_THROW(bent.through({face, {9, 9, 9}}), InvalidInput);
  }
}

TEST(BentWires, TheyCanBeStopped) {
  const Cut cut(shapes::torus(60, 30), 0);
  for (const double until : {0.0, 0.15}) {
    const Task task{.stop = {}, .progress = [until](double fraction) { return fraction < until; }};
    EXPECT_THROW(BentWires(unowned(cut.surface), unowned(cut.embedding), cut.geodesics, cut.field, cut.cuts[0], task),
                 Cancelled);
  }
}

}  // namespace
}  // namespace seamwire
