// SPDX-License-Identifier: GPL-3.0-or-later
#include "seamwire/metric/curvature.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "shapes.hpp"

namespace seamwire {
namespace {

using shapes::Mesh;

// Properties of every result on any surface.
void expect_sound(const Surface& surface, const Curvature& curvature) {
  ASSERT_EQ(curvature.k1.size(), surface.vertex_count());
  ASSERT_EQ(curvature.k2.size(), surface.vertex_count());
  ASSERT_EQ(curvature.d1.size(), surface.vertex_count());
  ASSERT_EQ(curvature.d2.size(), surface.vertex_count());
  ASSERT_EQ(curvature.normals.size(), surface.vertex_count());
  const std::vector<double> difference = curvature.difference();
  for (std::size_t v = 0; v < surface.vertex_count(); ++v) {
    EXPECT_TRUE(std::isfinite(curvature.k1[v]));
    EXPECT_TRUE(std::isfinite(curvature.k2[v]));
    EXPECT_GE(std::abs(curvature.k1[v]), std::abs(curvature.k2[v]));
    EXPECT_EQ(difference[v], std::abs(curvature.k1[v]) - std::abs(curvature.k2[v]));
    // A few roundings.
    EXPECT_NEAR(curvature.d1[v].norm(), 1.0, 1e-14);
    EXPECT_NEAR(curvature.d2[v].norm(), 1.0, 1e-14);
    EXPECT_NEAR(curvature.d1[v].dot(curvature.d2[v]), 0.0, 1e-14);
    const Vector& n = curvature.normals[v];
    if (n.isZero(0.0)) {
      EXPECT_EQ(curvature.k1[v], 0.0);
      continue;
    }
    EXPECT_NEAR(n.norm(), 1.0, 1e-14);
    EXPECT_NEAR(n.dot(curvature.d1[v]), 0.0, 1e-14);
    EXPECT_NEAR(n.dot(curvature.d2[v]), 0.0, 1e-14);
  }
}

Mesh transformed(Mesh mesh, const Eigen::Affine3d& by) {
  for (Vector& p : mesh.points) p = by * p;
  return mesh;
}

// Largest error over the vertices in proportion to 1 / r; n cells around the tube and twice as many around the axis, so
// that they are about as long as wide.
double torus_error(int n) {
  const double large = 0.35;
  const double small = 0.15;
  const Surface surface = shapes::torus(2 * n, n, large, small).surface();
  const Curvature curvature = principal_curvatures(surface);
  expect_sound(surface, curvature);
  double error = 0.0;
  for (std::size_t v = 0; v < surface.vertex_count(); ++v) {
    const Vector& p = surface.points()[v];
    const double ring = std::hypot(p.x(), p.y());
    const double k1 = 1.0 / small;
    const double k2 = (ring - large) / small / ring;
    error = std::max({error, std::abs(curvature.k1[v] - k1) / k1, std::abs(curvature.k2[v] - k2) / k1});
  }
  return error;
}

TEST(Curvature, OfASphereIsExactWithTheNormalsOfMax) {
  for (const int level : {1, 2, 3, 4}) {
    const Surface surface = shapes::icosphere(level).surface();
    const Curvature curvature = principal_curvatures(surface);
    expect_sound(surface, curvature);
    for (std::size_t v = 0; v < surface.vertex_count(); ++v) {
      EXPECT_NEAR(curvature.k1[v], 2.0, 1e-9);
      EXPECT_NEAR(curvature.k2[v], 2.0, 1e-9);
      EXPECT_NEAR((curvature.normals[v] - surface.points()[v].normalized()).norm(), 0.0, 1e-12);
    }
  }
}

TEST(Curvature, OfATorusFallsWithTheSquareOfTheEdge) {
  EXPECT_LT(torus_error(48), 3.5e-3);
  EXPECT_LT(torus_error(96), 9e-4);
  EXPECT_LT(torus_error(192), 2.3e-4);
}

TEST(Curvature, OfACylinderPointsAroundAndAlong) {
  const double radius = 0.25;
  const Surface surface = shapes::cylinder(64, 32, radius, 1.0).surface();
  const Curvature curvature = principal_curvatures(surface);
  expect_sound(surface, curvature);
  for (std::size_t v = 0; v < surface.vertex_count(); ++v) {
    const Vector& p = surface.points()[v];
    const Vector around = Vector(-p.y(), p.x(), 0).normalized();
    // The normals are radial by symmetry, so the fit sees two of a circle's chords: exact along the axis, and up to
    // O(h^2), h = 2 pi / 64, around it.
    const double h2 = std::pow(2 * std::numbers::pi / 64, 2);
    EXPECT_NEAR(curvature.k1[v], 1.0 / radius, h2 / radius);
    EXPECT_NEAR(curvature.k2[v], 0.0, h2 / radius);
    EXPECT_GT(std::abs(curvature.d1[v].dot(around)), 1.0 - h2);
    EXPECT_GT(std::abs(curvature.d2[v].z()), 1.0 - h2);
  }
}

TEST(Curvature, OfASaddleHasBothSigns) {
  // z = x^2 / 2 - y^2 about the origin.
  Mesh mesh = shapes::grid(64);
  for (Vector& p : mesh.points) {
    const double x = p.x() - 0.5;
    const double y = p.y() - 0.5;
    p = Vector(x, y, 0.5 * (x * x - 2 * y * y));
  }
  const Surface surface = mesh.surface();
  const Curvature curvature = principal_curvatures(surface);
  expect_sound(surface, curvature);
  const std::size_t centre = 32 * 65 + 32;
  // The surface falls away from its upward normal along y: positive there.
  EXPECT_NEAR(curvature.k1[centre], 2.0, 2e-3);
  EXPECT_NEAR(curvature.k2[centre], -1.0, 2e-3);
  EXPECT_NEAR(std::abs(curvature.d1[centre].y()), 1.0, 1e-6);
}

TEST(Curvature, OfAPlaneIsZero) {
  const Surface surface = shapes::grid(16, 0.3).surface();
  const Curvature curvature = principal_curvatures(surface);
  expect_sound(surface, curvature);
  for (std::size_t v = 0; v < surface.vertex_count(); ++v) {
    EXPECT_EQ(curvature.k1[v], 0.0);
    EXPECT_EQ(curvature.k2[v], 0.0);
    EXPECT_EQ(curvature.normals[v], Vector(0, 0, 1));
  }
}

TEST(Curvature, IsInTheCallersUnit) {
  const Mesh mesh = shapes::torus(48, 32);
  const Curvature expected = principal_curvatures(mesh.surface());
  for (const double c : {1e-6, 0.3, 1024.0, 7e9}) {
    const Curvature found = principal_curvatures(transformed(mesh, Eigen::Affine3d(Eigen::Scaling(c))).surface());
    for (std::size_t v = 0; v < mesh.points.size(); ++v) {
      EXPECT_NEAR(found.k1[v] * c, expected.k1[v], 1e-12 * std::abs(expected.k1[v]));
      EXPECT_NEAR(found.k2[v] * c, expected.k2[v], 1e-12 * std::abs(expected.k1[v]));
    }
  }
}

TEST(Curvature, TurnsWithTheModel) {
  Mesh mesh = shapes::torus(24, 16);
  const Eigen::AngleAxisd turn(1.0, Vector(1, 2, 3).normalized());
  const Surface before = mesh.surface();
  const Surface after = transformed(mesh, Eigen::Affine3d(turn)).surface();
  const Curvature expected = principal_curvatures(before);
  const Curvature found = principal_curvatures(after);
  for (std::size_t v = 0; v < mesh.points.size(); ++v) {
    EXPECT_NEAR(found.k1[v], expected.k1[v], 1e-10);
    EXPECT_NEAR(std::abs(found.d1[v].dot(turn * expected.d1[v])), 1.0, 1e-10);
  }
}

TEST(Curvature, DoesNotDependOnHowFacesAreTurned) {
  Mesh mesh = shapes::torus(24, 16);
  const Curvature expected = principal_curvatures(mesh.surface());
  std::mt19937 random(5);
  for (Triangle& t : mesh.triangles) {
    if (random() % 4 == 0) std::swap(t[1], t[2]);
  }
  const Curvature found = principal_curvatures(mesh.surface());
  for (std::size_t v = 0; v < mesh.points.size(); ++v) {
    EXPECT_NEAR(found.k1[v], expected.k1[v], 1e-10);
    EXPECT_NEAR((found.normals[v] - expected.normals[v]).norm(), 0.0, 1e-12);
  }
}

TEST(Curvature, IsSmoothAcrossTheCutOfAOneSidedSurface) {
  // A Moebius strip: wherever it is cut, strips of the same shape elsewhere say what the curvature there must be.
  const int n = 64;
  const Mesh mesh = shapes::moebius(n);
  const Surface surface = mesh.surface();
  ASSERT_EQ(surface.report().unorientable_edges.size(), 1U);
  const Curvature curvature = principal_curvatures(surface);
  expect_sound(surface, curvature);
  Mesh turned = mesh;  // cut elsewhere
  for (std::size_t f = 0; f < turned.triangles.size() / 2; ++f) {
    std::swap(turned.triangles[f][1], turned.triangles[f][2]);
  }
  const Surface elsewhere = turned.surface();
  ASSERT_NE(elsewhere.report().unorientable_edges, surface.report().unorientable_edges);
  const Curvature other = principal_curvatures(elsewhere);
  for (const Edge& cut : surface.report().unorientable_edges) {
    for (const std::int32_t v : cut) {
      EXPECT_GT(std::abs(curvature.normals[v].dot(other.normals[v])), 0.999);
      // Each side of the cut is fitted with one-sided normals, as on any boundary: first order.
      EXPECT_NEAR(std::abs(curvature.k1[v]), std::abs(other.k1[v]), 0.1 * std::abs(other.k1[v]));
    }
  }
}

TEST(Curvature, SkipsFacesThatAreInLineButForRounding) {
  // A plane askew, with coordinates in 32 bits, and each square's middle on its diagonal in a separate face.
  Mesh mesh = shapes::grid(8);
  const std::size_t count = mesh.triangles.size();
  for (std::size_t f = 0; f < count; f += 2) {
    const auto [a, b, d] = mesh.triangles[f];
    const auto middle = static_cast<std::int32_t>(mesh.points.size());
    mesh.points.push_back(0.5 * (mesh.points[a] + mesh.points[d]));
    mesh.triangles.push_back({a, middle, d});
    mesh.triangles[f] = {a, b, middle};
    mesh.triangles.push_back({b, d, middle});
  }
  mesh = transformed(mesh, Eigen::Affine3d(Eigen::AngleAxisd(0.7, Vector(1, 2, 3).normalized())));
  for (Vector& p : mesh.points) p = p.cast<float>().cast<double>();
  const Surface surface = mesh.surface();
  const Curvature curvature = principal_curvatures(surface);
  expect_sound(surface, curvature);
  for (std::size_t v = 0; v < surface.vertex_count(); ++v) {
    EXPECT_LT(std::abs(curvature.k1[v]), 1e-3);  // normals to 1e-6 over edges of .1, and some
    EXPECT_GT(curvature.normals[v].dot(curvature.normals[0]), 1.0 - 1e-9);
  }
}

TEST(Curvature, OfVerticesWithoutAUsableFaceIsZero) {
  // A face in line, an edge without a face, and an isolated vertex.
  const Surface surface({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {0, 5, 0}, {0, 6, 0}, {9, 9, 9}}, {{0, 1, 2}},
                        std::vector<Edge>{{3, 4}});
  const Curvature curvature = principal_curvatures(surface);
  expect_sound(surface, curvature);
  for (std::size_t v = 0; v < surface.vertex_count(); ++v) {
    EXPECT_TRUE(curvature.normals[v].isZero(0.0));
    EXPECT_EQ(curvature.k1[v], 0.0);
  }
}

TEST(Curvature, DisregardsFacesOfOnePoint) {
  Mesh mesh = shapes::icosphere(2);
  const Triangle face = mesh.triangles[7];
  for (const std::int32_t v : face) mesh.points[v] = mesh.points[face[0]];
  const Surface surface = mesh.surface();
  const Curvature curvature = principal_curvatures(surface);
  expect_sound(surface, curvature);
  // The other faces there turn away from the sphere by some 20 degrees.
  for (const std::int32_t v : face) EXPECT_GT(curvature.normals[v].dot(mesh.points[v].normalized()), 0.9);
}

TEST(Curvature, IsFiniteOnRandomTriangles) {
  std::mt19937 random(17);
  for (int trial = 0; trial < 200; ++trial) {
    const auto up_to = [&](unsigned n) { return static_cast<std::int32_t>(random() % n); };
    const unsigned n = 4 + static_cast<unsigned>(up_to(12));
    Mesh mesh;
    for (unsigned v = 0; v < n; ++v) {
      const double tiny = std::pow(10.0, -up_to(20));
      mesh.points.emplace_back(up_to(3) + tiny, up_to(3), up_to(3) - tiny);
    }
    mesh.triangles.push_back({0, 1, 2});
    for (int f = 0; f < 30; ++f) mesh.triangles.push_back({up_to(n), up_to(n), up_to(n)});
    const Surface surface = mesh.surface();
    expect_sound(surface, principal_curvatures(surface));
  }
}

TEST(Curvature, IsFiniteAtTheEndsOfTheRange) {
  const Mesh mesh = shapes::icosphere(1);
  for (const double c : {1e-149, 1e149}) {
    const Surface surface = transformed(mesh, Eigen::Affine3d(Eigen::Scaling(c))).surface();
    EXPECT_TRUE(std::isfinite(surface.scale()));
    expect_sound(surface, principal_curvatures(surface));
  }
}

TEST(Curvature, IsFiniteWhereNormalsCancel) {
  // Two faces back to back along an edge: folded flat, their normals at it cancel.
  const Surface surface({{0, 0, 0}, {1, 0, 0}, {0.5, 1, 0}, {0.5, 1, 0}}, {{0, 1, 2}, {1, 0, 3}});
  const Curvature curvature = principal_curvatures(surface);
  expect_sound(surface, curvature);
}

// A square, and a low triangle that stands upright on its side: left out, the normals are the square's to the last bit.
TEST(Curvature, LeavesOutTheFacesThatTheReportCallsLowAndNoOthers) {
  for (const double height : {1e-30, 1e-12, 1e-8, 0.99 * 0x1p-22, 1.01 * 0x1p-22, 1e-6}) {
    for (const Triangle& corners : {Triangle{1, 0, 4}, Triangle{0, 4, 1}, Triangle{4, 1, 0}, Triangle{0, 1, 4}}) {
      // After a face that is left out of the corner fans, so that numbers there are others.
      const Surface surface({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0.3, 0, height}},
                            {{0, 0, 1}, {0, 1, 2}, {0, 2, 3}, corners});
      const bool is_low = !surface.report().low_faces.empty();
      EXPECT_EQ(is_low, height < 0x1p-22) << height;
      if (is_low) {
        EXPECT_EQ(surface.report().low_faces, std::vector<std::int32_t>{3});
      }
      const Curvature curvature = principal_curvatures(surface);
      EXPECT_EQ(curvature.normals[0].head<2>().isZero(0.0), is_low) << height;
      EXPECT_EQ(curvature.k1[0] == 0.0, is_low) << height;
    }
  }
}

TEST(SmoothedCurvatures, OfACylinderStayWhatTheyAre) {
  const Surface surface = shapes::cylinder(48, 40).surface();
  const Curvature curvature = principal_curvatures(surface);
  const Curvature smoothed = smoothed_curvatures(surface, curvature, 0.2);
  expect_sound(surface, smoothed);
  // Unless they were turned, tensors from around it would shorten each other.
  for (std::size_t v = 0; v < surface.vertex_count(); ++v) {
    EXPECT_NEAR(smoothed.k1[v], curvature.k1[v], 0.02 * std::abs(curvature.k1[v]));
    EXPECT_NEAR(std::abs(smoothed.d2[v].z()), 1.0, 1e-6);
    EXPECT_EQ(smoothed.normals[v], curvature.normals[v]);
  }
}

TEST(SmoothedCurvatures, LoseTheNoiseAndKeepTheMean) {
  const Surface surface = shapes::icosphere(4).surface();
  Curvature curvature = principal_curvatures(surface);
  std::mt19937 random(1);
  std::normal_distribution<double> noise(0.0, 1.0);
  for (std::size_t v = 0; v < surface.vertex_count(); ++v) {
    const double k = curvature.k1[v] + noise(random);
    curvature.k1[v] = curvature.k2[v] = k;
  }
  const auto deviation = [&](const Curvature& of) {
    double sum = 0.0;
    for (std::size_t v = 0; v < surface.vertex_count(); ++v) sum += std::pow(0.5 * (of.k1[v] + of.k2[v]) - 2.0, 2.0);
    return std::sqrt(sum / static_cast<double>(surface.vertex_count()));
  };
  EXPECT_NEAR(deviation(curvature), 1.0, 0.1);
  double last = deviation(curvature);
  for (const double radius : {0.02, 0.1, 0.3}) {
    const double now = deviation(smoothed_curvatures(surface, curvature, radius));
    EXPECT_LT(now, 0.6 * last) << radius;
    last = now;
  }
}

TEST(SmoothedCurvatures, AreSoundOnWhateverThereIs) {
  for (Mesh mesh : {shapes::bumpy(shapes::torus(24, 12), 0.05), shapes::moebius(12), shapes::grid(1)}) {
    mesh.points.emplace_back(5.0, 5.0, 5.0);  // in no face
    const Surface surface = mesh.surface();
    expect_sound(surface, smoothed_curvatures(surface, principal_curvatures(surface), 0.1));
  }
}

TEST(SmoothedCurvatures, AreInTheCallersUnit) {
  const Mesh mesh = shapes::bumpy(shapes::icosphere(2), 0.1);
  const auto smoothed = [](const Mesh& of) {
    const Surface surface = of.surface();
    return smoothed_curvatures(surface, principal_curvatures(surface), 0.1).k1;
  };
  const std::vector<double> expected = smoothed(mesh);
  for (const int exponent : {-490, -300, 300, 490}) {
    const Mesh scaled = transformed(mesh, Eigen::Affine3d(Eigen::Scaling(std::ldexp(1.0, exponent))));
    const std::vector<double> found = smoothed(scaled);
    for (std::size_t v = 0; v < found.size(); ++v)
      ASSERT_NEAR(std::ldexp(found[v], exponent), expected[v], 1e-9) << exponent;
  }
}

TEST(SmoothedCurvatures, RefuseWhatIsNoRadiusAndCurvaturesOfAnotherSurface) {
  const Surface surface = shapes::grid(3).surface();
  const Curvature curvature = principal_curvatures(surface);
  for (const double radius : {0.0, -1.0, std::nan("")}) {
    EXPECT_THROW(smoothed_curvatures(surface, curvature, radius), InvalidInput);
  }
  EXPECT_THROW(smoothed_curvatures(shapes::grid(4).surface(), curvature, 0.1), InvalidInput);
}

TEST(VertexNormals, AreThoseOfTheCurvature) {
  const Surface surface = shapes::torus(24, 16).surface();
  EXPECT_EQ(vertex_normals(surface), principal_curvatures(surface).normals);
}

}  // namespace
}  // namespace seamwire
