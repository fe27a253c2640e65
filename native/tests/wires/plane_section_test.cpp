// SPDX-License-Identifier: GPL-3.0-or-later
#include "seamwire/wires/plane_section.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <string>

#include "shapes.hpp"

namespace seamwire {
namespace {

SurfacePoint at(std::int32_t v) { return SurfacePoint(v); }

// Of a point in a face.
Vector place(const Surface& surface, const SurfacePoint& p) {
  Vector sum = Vector::Zero();
  for (std::size_t i = 0; i < 3; ++i) sum += p.barycentric[i] * surface.points()[surface.triangles()[p.face][i]];
  return sum;
}

// The points lie in the plane, and in the faces that they say; each segment is in one of them.
void expect_exact(const Surface& surface, const PlaneSection& section, const Vector& direction) {
  ASSERT_GE(section.points.size(), 2U);
  ASSERT_EQ(section.faces.size(), section.points.size() - 1);
  const Vector from = section.points.front(), to = section.points.back();
  const Vector normal = direction.cross(to - from).normalized();
  double length = 0.0;
  for (std::size_t i = 0; i + 1 < section.points.size(); ++i) {
    const Triangle& t = surface.triangles()[section.faces[i]];
    const Vector &a = surface.points()[t[0]], &b = surface.points()[t[1]], &c = surface.points()[t[2]];
    for (const Vector& p : {section.points[i], section.points[i + 1]}) {
      EXPECT_NEAR(normal.dot(p - from), 0.0, 1e-12);
      const Vector cross = (b - a).cross(c - a), n = cross.normalized();
      EXPECT_NEAR(n.dot(p - a), 0.0, 1e-12);
      for (const auto& [q, r] : {std::pair(a, b), std::pair(b, c), std::pair(c, a)}) {
        EXPECT_GT((r - q).cross(p - q).dot(n), -1e-12);
      }
    }
    length += (section.points[i + 1] - section.points[i]).norm();
  }
  EXPECT_NEAR(length, section.length, 1e-12);
}

TEST(PlaneSection, OnAPlaneIsTheStraightLine) {
  const Surface surface = shapes::grid(12, 0.3).surface();
  std::mt19937 random(2);
  std::uniform_int_distribution<std::int32_t> any(0, static_cast<std::int32_t>(surface.vertex_count()) - 1);
  for (int i = 0; i < 200; ++i) {
    const std::int32_t a = any(random), b = any(random);
    if (a == b) continue;
    const PlaneSection section = plane_section(surface, at(a), at(b), Vector::UnitZ());
    ASSERT_NO_FATAL_FAILURE(expect_exact(surface, section, Vector::UnitZ()));
    EXPECT_EQ(section.points.front(), surface.points()[a]);
    EXPECT_EQ(section.points.back(), surface.points()[b]);
    EXPECT_NEAR(section.length, (surface.points()[b] - surface.points()[a]).norm(), 1e-12);
    // No point twice.
    for (std::size_t s = 1; s < section.points.size(); ++s) {
      EXPECT_GT((section.points[s] - section.points[s - 1]).norm(), 1e-9);
    }
  }
}

// Edges lie in the plane but for rounding.
TEST(PlaneSection, BetweenPointsOnEdgesInThePlaneRunsAlongThem) {
  const int n = 6;
  shapes::Mesh mesh = shapes::grid(n);
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(0.7, Vector(1, 2, 3).normalized()).toRotationMatrix();
  for (Vector& p : mesh.points) p = turn * p;
  const Surface surface = mesh.surface();
  for (int row = 1; row < n; ++row) {
    for (int column = 1; column < n; ++column) {
      // Below a row's edge lies the second triangle of a cell, above it the first one.
      const SurfacePoint below{2 * ((row - 1) * n + column) + 1, {0.0, 0.4, 0.6}};
      const SurfacePoint above{2 * (row * n + column), {0.6, 0.4, 0.0}};
      for (const bool is_far_below : {false, true}) {
        const SurfacePoint far = is_far_below ? SurfacePoint{2 * (row - 1) * n + 1, {0.0, 0.5, 0.5}}
                                              : SurfacePoint{2 * row * n, {0.5, 0.5, 0.0}};
        EXPECT_NEAR(plane_section(surface, below, far, turn * Vector::UnitZ()).length, (column - 0.1) / n, 1e-12);
        EXPECT_NEAR(plane_section(surface, far, above, turn * Vector::UnitZ()).length, (column - 0.1) / n, 1e-12);
      }
    }
  }
}

// All along edges, and through vertices: the plane goes through every second row of the grid.
TEST(PlaneSection, RunsAlongEdgesAndThroughVertices) {
  const int n = 8;
  const Surface surface = shapes::grid(n).surface();
  for (const auto& [a, b] : {std::pair(0, n), std::pair(n, 0), std::pair(3 * (n + 1) + 1, 3 * (n + 1) + 7),
                             std::pair(2, n * (n + 1) + 2), std::pair(0, n * (n + 1) + n), std::pair(n, n * (n + 1)),
                             std::pair(n * (n + 1), n * (n + 1) + n), std::pair(0, 1)}) {
    const PlaneSection section = plane_section(surface, at(a), at(b), Vector::UnitZ());
    EXPECT_NEAR(section.length, (surface.points()[b] - surface.points()[a]).norm(), 1e-12) << a << " to " << b;
  }
}

TEST(PlaneSection, BetweenPointsInsideFacesIsStraightToo) {
  const Surface surface = shapes::grid(7, 0.3).surface();
  std::mt19937 random(4);
  std::uniform_real_distribution<double> part(0.0, 1.0);
  const auto any = [&] {
    SurfacePoint p;
    p.face = static_cast<std::int32_t>(part(random) * static_cast<double>(surface.face_count()));
    const double a = part(random), b = part(random) * (1 - a);
    p.barycentric = {a, b, 1 - a - b};
    if (part(random) < 0.3) p.barycentric = {a, 0.0, 1 - a};
    return p;
  };
  for (int i = 0; i < 300; ++i) {
    const SurfacePoint a = any(), b = any();
    const PlaneSection section = plane_section(surface, a, b, Vector::UnitZ());
    ASSERT_NO_FATAL_FAILURE(expect_exact(surface, section, Vector::UnitZ()));
    EXPECT_NEAR(section.length, (place(surface, b) - place(surface, a)).norm(), 1e-12);
  }
}

TEST(PlaneSection, WithinOneFaceIsTheSegmentAlsoInThePlaneOfAFlatSheet) {
  const Surface surface = shapes::grid(4).surface();
  const SurfacePoint from{9, {0.2, 0.3, 0.5}}, to{9, {0.6, 0.3, 0.1}};
  const double distance = (place(surface, to) - place(surface, from)).norm();
  for (const Vector& direction : {Vector(Vector::UnitZ()), Vector(1.0, 0.3, 0.0)}) {
    const PlaneSection section = plane_section(surface, from, to, direction);
    EXPECT_EQ(section.points.size(), 2U);
    EXPECT_EQ(section.faces, std::vector<std::int32_t>{9});
    EXPECT_NEAR(section.length, distance, 1e-15);
  }
}

TEST(PlaneSection, ThroughTheMiddleOfASphereIsAGreatCircleTheShorterWay) {
  const Surface surface = shapes::icosphere(5, 0.5).surface();
  std::mt19937 random(3);
  std::uniform_int_distribution<std::int32_t> any(0, static_cast<std::int32_t>(surface.vertex_count()) - 1);
  for (int i = 0; i < 50; ++i) {
    const std::int32_t a = any(random), b = any(random);
    const Vector p = surface.points()[a], q = surface.points()[b];
    const double angle = std::acos(std::clamp(4 * p.dot(q), -1.0, 1.0));
    if (angle < 0.2 || angle > 2.9) continue;
    // Seen from along the middle of both, the plane goes through the sphere's.
    const PlaneSection section = plane_section(surface, at(a), at(b), p + q);
    expect_exact(surface, section, p + q);
    EXPECT_NEAR(section.length, 0.5 * angle, 0.002);
  }
}

TEST(PlaneSection, HangsOnThePlaneAloneNotOnTheDirectionInIt) {
  const Surface surface = shapes::bumpy(shapes::icosphere(4), 0.02).surface();
  const Vector p = surface.points()[17], q = surface.points()[900];
  const Vector direction(0.3, -0.2, 0.9);
  const PlaneSection one = plane_section(surface, at(17), at(900), direction);
  const PlaneSection two = plane_section(surface, at(17), at(900), 3.0 * direction + 0.7 * (q - p));
  const PlaneSection back = plane_section(surface, at(900), at(17), -direction);
  expect_exact(surface, one, direction);
  EXPECT_NEAR(one.length, two.length, 1e-9);
  EXPECT_NEAR(one.length, back.length, 1e-9);
}

TEST(PlaneSection, IsNoneWhereTheCurveEndsBefore) {
  // A hole as wide as the sheet is cut between both points.
  const Surface torn =
      shapes::without(shapes::grid(9), [](const Vector& c) { return std::abs(c.x() - 0.5) < 0.1; }).surface();
  const PlaneSection none = plane_section(torn, at(0), at(9), Vector::UnitZ());
  EXPECT_TRUE(none.points.empty());
  EXPECT_TRUE(none.faces.empty());
  EXPECT_EQ(none.length, std::numeric_limits<double>::infinity());
  // Two limbs that the plane cuts in a circle each.
  shapes::Mesh two = shapes::icosphere(2, 0.2);
  const auto count = static_cast<std::int32_t>(two.points.size());
  for (std::int32_t v = 0; v < count; ++v) two.points.push_back(two.points[v] + Vector(1, 0, 0));
  for (std::size_t f = 0, end = two.triangles.size(); f < end; ++f) {
    const Triangle t = two.triangles[f];
    two.triangles.push_back({t[0] + count, t[1] + count, t[2] + count});
  }
  EXPECT_TRUE(plane_section(two.surface(), at(3), at(count + 5), Vector(0, 0.2, 1)).points.empty());
}

TEST(PlaneSection, GoesOnOverAFaceThatIsTurnedOver) {
  shapes::Mesh mesh = shapes::grid(6, 0.2);
  std::swap(mesh.triangles[20][0], mesh.triangles[20][1]);
  const Surface surface = mesh.surface();
  const PlaneSection section = plane_section(surface, at(0), at(48), Vector::UnitZ());
  EXPECT_NEAR(section.length, std::sqrt(2.0), 1e-12);
}

TEST(PlaneSection, BetweenVerticesWithManyFacesTakesLittleTime) {
  // Two tips over a ring: looking at the faces of one tip for each face of the other would take minutes.
  constexpr std::int32_t kSides = 60'000;
  std::vector<Vector> points{{0, 0, 1}, {0, 0, -1}};
  std::vector<Triangle> triangles;
  for (std::int32_t i = 0; i < kSides; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / kSides;
    points.emplace_back(std::cos(angle), std::sin(angle), 0.0);
    const std::int32_t here = 2 + i, next = 2 + (i + 1) % kSides;
    triangles.push_back({0, here, next});
    triangles.push_back({1, next, here});
  }
  const PlaneSection section = plane_section(Surface(points, triangles), at(0), at(1), {1, 0, 0});
  EXPECT_NEAR(section.length, 2.0 * std::sqrt(2.0), 1e-6);
}

TEST(PlaneSection, NamesWhatIsWrong) {
  const Surface surface = shapes::grid(2).surface();
  const auto message = [&](const SurfacePoint& a, const SurfacePoint& b, const Vector& direction) -> std::string {
    try {
      plane_section(surface, a, b, direction);
    } catch (const InvalidInput& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_EQ(message(at(4), at(4), Vector::UnitZ()), "both points are the same");
  EXPECT_EQ(message(at(0), at(1), Vector(0, 0, std::nan(""))), "direction is not finite");
  const std::string none = "direction has no length, or leads from one point to the other: it makes no plane with them";
  EXPECT_EQ(message(at(0), at(1), Vector::Zero()), none);
  EXPECT_EQ(message(at(0), at(1), Vector(-2, 0, 0)), none);
  EXPECT_NE(message(at(0), at(9), Vector::UnitZ()).find("to: vertex"), std::string::npos);
  EXPECT_NE(message({8, {1, 0, 0}}, at(0), Vector::UnitZ()).find("from: face"), std::string::npos);
  EXPECT_NE(message({1, {1, 1, 0}}, at(0), Vector::UnitZ()).find("from: the barycentric"), std::string::npos);
}

}  // namespace
}  // namespace seamwire
