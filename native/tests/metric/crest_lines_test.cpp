// SPDX-License-Identifier: GPL-3.0-or-later
#include "seamwire/metric/crest_lines.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "shapes.hpp"

namespace seamwire {
namespace {

CrestLines lines_of(const Surface& surface, const CrestLineOptions& options = {}) {
  return crest_lines(surface, principal_curvatures(surface), options);
}

std::size_t count(const CrestLines& lines) { return lines.strengths.size(); }

bool is_closed(const CrestLines& lines, std::size_t i) {
  return lines.points[lines.starts[i]] == lines.points[lines.starts[i + 1] - 1];
}

bool is_ridge(const CrestLines& lines, std::size_t i) { return lines.curvatures[lines.starts[i]] > 0.0; }

double length(const CrestLines& lines, std::size_t i) {
  double sum = 0.0;
  for (std::int32_t p = lines.starts[i] + 1; p < lines.starts[i + 1]; ++p) {
    sum += (lines.points[p] - lines.points[p - 1]).norm();
  }
  return sum;
}

// An ellipsoid about the origin, whose mesh has no vertices in its planes of symmetry.
shapes::Mesh ellipsoid(int level, const Vector& axes) {
  shapes::Mesh mesh = shapes::icosphere(level, 1.0);
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(0.3, Vector(1, 2, 3).normalized()).toRotationMatrix();
  for (Vector& p : mesh.points) p = axes.cwiseProduct(turn * p);
  return mesh;
}

void turn_over(shapes::Mesh& mesh) {
  for (Triangle& t : mesh.triangles) std::swap(t[1], t[2]);
}

// A sheet of waves along x, three to its width.
constexpr double kHeight = 0.03, kWaves = 3.0;
double wave(double x) { return kHeight * std::cos(2 * std::numbers::pi * kWaves * x); }

shapes::Mesh waves(int n, double jitter) {
  shapes::Mesh mesh = shapes::grid(n, jitter);
  for (Vector& p : mesh.points) p.z() = wave(p.x());
  return mesh;
}

// The only one is where the section of the longest two axes cuts: |k1| > |k2| there, greatest by symmetry.
TEST(CrestLines, OfAnEllipsoidAreItsRim) {
  const double a = 0.5, b = 0.4, c = 0.2;
  for (const int level : {4, 5}) {
    const Surface surface = ellipsoid(level, {a, b, c}).surface();
    const CrestLines lines = crest_lines(surface, smoothed_curvatures(surface, principal_curvatures(surface), 0.06));
    ASSERT_EQ(count(lines), 1U);
    EXPECT_TRUE(is_closed(lines, 0));
    EXPECT_TRUE(is_ridge(lines, 0));
    double off = 0.0;
    for (std::size_t i = 0; i < lines.points.size(); ++i) {
      off = std::max(off, std::abs(lines.points[i].z()));
      // Of the section across, c^-2 / |grad|; the mean over .06 around is less.
      const double x = lines.points[i].x(), y = lines.points[i].y();
      EXPECT_NEAR(lines.curvatures[i] * c * c * std::hypot(x / (a * a), y / (b * b)), 1.0, 0.15);
    }
    EXPECT_LT(off, level == 4 ? 0.005 : 0.004);
    // Perimeter of the ellipse, by Ramanujan.
    const double h = std::pow((a - b) / (a + b), 2);
    EXPECT_NEAR(length(lines, 0) / (std::numbers::pi * (a + b) * (1 + 3 * h / (10 + std::sqrt(4 - 3 * h)))), 1.0, 0.02);
  }
}

// Over the poles the derivative vanishes along the middle of the longest section too, where curvature is least.
TEST(CrestLines, AreNotWhereCurvatureIsLeast) {
  const Surface surface = ellipsoid(5, {0.5, 0.4, 0.2}).surface();
  const CrestLines lines = crest_lines(surface, smoothed_curvatures(surface, principal_curvatures(surface), 0.06),
                                       {.least_strength = 0.2, .least_drop = 0.0});
  ASSERT_GE(count(lines), 1U);
  for (const Vector& p : lines.points) EXPECT_LT(std::abs(p.z()), 0.05);
}

TEST(CrestLines, OfAnEllipsoidTurnedInsideOutAreAValley) {
  shapes::Mesh mesh = ellipsoid(4, {0.5, 0.4, 0.2});
  turn_over(mesh);
  const CrestLines lines = lines_of(mesh.surface());
  ASSERT_EQ(count(lines), 1U);
  EXPECT_TRUE(is_closed(lines, 0));
  for (const double k : lines.curvatures) EXPECT_LT(k, 0.0);
}

TEST(CrestLines, OfWavesRunAlongTheirTopsAndBottoms) {
  const CrestLines lines = lines_of(waves(60, 0.2).surface());
  // Tops inside at 1/3 and 2/3, bottoms at 1/6, 1/2, 5/6; at the border the curvature of the last row decides.
  std::array<int, 5> found{};
  for (std::size_t i = 0; i < count(lines); ++i) {
    const double place = 6 * lines.points[(lines.starts[i] + lines.starts[i + 1]) / 2].x();
    const auto number = static_cast<int>(std::round(place));
    if (number < 1 || number > 5) continue;
    ++found[number - 1];
    EXPECT_EQ(is_ridge(lines, i), number % 2 == 0);
    // Within half an edge, from one border to the other.
    for (std::int32_t p = lines.starts[i]; p < lines.starts[i + 1]; ++p) {
      EXPECT_NEAR(6 * lines.points[p].x(), number, 6 * 0.4 / 60);
    }
    EXPECT_GT(length(lines, i), 0.9);
  }
  for (const int one : found) EXPECT_EQ(one, 1);
}

TEST(CrestLines, HaveTheStrengthOfTheCurvatureAlongThem) {
  const Surface surface = waves(60, 0.0).surface();
  const CrestLines lines = lines_of(surface);
  const double k = kHeight * std::pow(2 * std::numbers::pi * kWaves, 2);
  for (std::size_t i = 0; i < count(lines); ++i) {
    const double x = lines.points[lines.starts[i]].x();
    if (x < 0.1 || x > 0.9) continue;
    // Curvature from normals is the mean over some edges, 60 to three waves.
    EXPECT_NEAR(lines.strengths[i] / (k * length(lines, i)), 1.0, 0.07);
  }
  EXPECT_TRUE(std::ranges::is_sorted(lines.strengths, std::ranges::greater{}));
  const double between = 0.5 * (lines.strengths.front() + lines.strengths.back());
  const CrestLines strong = lines_of(surface, {.least_strength = between});
  EXPECT_EQ(count(strong), std::ranges::count_if(lines.strengths, [&](double s) { return s >= between; }));
}

// The size of the model, and where it lies, does not matter.
TEST(CrestLines, AreThoseOfTheModelAtAnySize) {
  shapes::Mesh mesh = ellipsoid(3, {0.5, 0.4, 0.2});
  const CrestLines lines = lines_of(mesh.surface());
  ASSERT_EQ(count(lines), 1U);
  for (Vector& p : mesh.points) p *= 1024.0;
  const CrestLines larger = lines_of(mesh.surface());
  ASSERT_EQ(count(larger), 1U);
  EXPECT_EQ(larger.edges, lines.edges);
  EXPECT_NEAR(larger.strengths[0], lines.strengths[0], 1e-9);
  EXPECT_NEAR((larger.points[3] - 1024.0 * lines.points[3]).norm(), 0.0, 1e-6);
}

// Curvature is the same all along its direction there (cyclides of Dupin): what signs of e there are is noise.
TEST(CrestLines, AreNotSeenOnPlanesSpheresCylindersAndTori) {
  EXPECT_EQ(count(lines_of(shapes::grid(20, 0.3).surface())), 0U);
  EXPECT_EQ(count(lines_of(shapes::icosphere(4).surface())), 0U);
  EXPECT_EQ(count(lines_of(shapes::cylinder(48, 40).surface())), 0U);
  EXPECT_EQ(count(lines_of(shapes::torus(96, 48).surface())), 0U);
  // Without the test of the fall there are some.
  EXPECT_GT(count(lines_of(shapes::torus(96, 48).surface(), {.least_strength = 0.0, .least_drop = 0.0})), 0U);
}

TEST(CrestLines, OfARoundedCubeAreItsTwelveEdges) {
  shapes::Mesh mesh = shapes::icosphere(5, 1.0);
  for (Vector& p : mesh.points) p *= 0.4 / std::pow(p.array().pow(8).sum(), 0.125);
  const CrestLines lines = lines_of(mesh.surface());
  std::map<int, double> covered;  // by edge of the cube
  for (std::size_t i = 0; i < count(lines); ++i) {
    EXPECT_TRUE(is_ridge(lines, i));
    for (std::int32_t p = lines.starts[i] + 1; p < lines.starts[i + 1]; ++p) {
      const Vector middle = 0.5 * (lines.points[p] + lines.points[p - 1]), size = middle.cwiseAbs();
      Eigen::Index along = 0;
      size.minCoeff(&along);
      const Eigen::Index one = (along + 1) % 3, other = (along + 2) % 3;
      // Around the corners lines meet in other ways.
      if (size[along] > 0.25) continue;
      EXPECT_NEAR(size[one], size[other], 0.02);
      const int key = static_cast<int>(along) * 4 + (middle[one] > 0.0) * 2 + (middle[other] > 0.0);
      covered[key] += std::abs(lines.points[p][along] - lines.points[p - 1][along]);
    }
  }
  EXPECT_EQ(covered.size(), 12U);
  for (const auto& [edge, length] : covered) EXPECT_GT(length, 0.45) << edge;
}

TEST(CrestLines, OfSmoothedCurvatureStandNoise) {
  shapes::Mesh mesh = waves(120, 0.2);
  std::mt19937 random(5);
  std::normal_distribution<double> off(0.0, 0.05 / 120);
  for (Vector& p : mesh.points) p.z() += off(random);
  const Surface surface = mesh.surface();
  const CrestLines lines =
      crest_lines(surface, smoothed_curvatures(surface, principal_curvatures(surface), 0.04), {.least_strength = 5.0});
  std::array<double, 7> covered{};
  for (std::size_t i = 0; i < count(lines); ++i) {
    for (std::int32_t p = lines.starts[i] + 1; p < lines.starts[i + 1]; ++p) {
      const Vector middle = 0.5 * (lines.points[p] + lines.points[p - 1]);
      if (std::min({middle.x(), middle.y(), 1 - middle.x(), 1 - middle.y()}) < 0.1) continue;
      const double place = 6 * middle.x();
      const auto number = static_cast<int>(std::round(place));
      EXPECT_NEAR(place, number, 0.15);
      EXPECT_EQ(is_ridge(lines, i), number % 2 == 0);
      covered[number] += std::abs(lines.points[p].y() - lines.points[p - 1].y());
    }
  }
  for (int number = 1; number <= 5; ++number) EXPECT_GT(covered[number], 0.7) << number;
}

// Where a line leaves one face it enters the next: points are where they say, faces have both edges.
TEST(CrestLines, RunAcrossFacesFromEdgeToEdge) {
  const Surface surface = shapes::bumpy(shapes::icosphere(4), 0.02).surface();
  const CrestLines lines = lines_of(surface, {.least_strength = 0.1, .least_drop = 0.0});
  ASSERT_GT(count(lines), 5U);
  ASSERT_EQ(lines.starts.size(), count(lines) + 1);
  EXPECT_EQ(lines.starts.front(), 0);
  EXPECT_EQ(lines.starts.back(), static_cast<std::int32_t>(lines.points.size()));
  for (std::size_t i = 0; i < count(lines); ++i) {
    const std::int32_t last = lines.starts[i + 1] - 1;
    ASSERT_GT(last, lines.starts[i]);
    EXPECT_EQ(lines.faces[last], -1);
    for (std::int32_t p = lines.starts[i]; p <= last; ++p) {
      const auto& [a, b] = lines.edges[p];
      EXPECT_LT(a, b);
      EXPECT_TRUE(std::ranges::binary_search(surface.edges(), lines.edges[p]));
      const Vector there = (1 - lines.t[p]) * surface.points()[a] + lines.t[p] * surface.points()[b];
      EXPECT_NEAR((there - lines.points[p]).norm(), 0.0, 1e-14);
      if (p == last) break;
      const Triangle& face = surface.triangles()[lines.faces[p]];
      for (const std::int32_t v : {a, b, lines.edges[p + 1][0], lines.edges[p + 1][1]}) {
        EXPECT_NE(std::ranges::find(face, v), face.end());
      }
    }
  }
}

TEST(CrestLines, OfMeshesAsPeopleHaveThemAreFinite) {
  // Three faces at an edge, one turned over, slivers, a face without area, a one-sided band, a vertex without a face.
  shapes::Mesh mesh = waves(12, 0.3);
  mesh.points.emplace_back(0.5, 0.5, 0.4);
  mesh.triangles.push_back({70, 71, static_cast<std::int32_t>(mesh.points.size() - 1)});
  std::swap(mesh.triangles[40][0], mesh.triangles[40][1]);
  mesh.triangles.push_back({3, 4, 5});
  mesh.points.emplace_back(2, 2, 2);
  for (const Surface& surface : {mesh.surface(), shapes::moebius(40).surface()}) {
    const CrestLines lines = lines_of(surface, {.least_strength = 0.0, .least_drop = 0.0});
    for (const Vector& p : lines.points) EXPECT_TRUE(p.allFinite());
    for (const double s : lines.strengths) EXPECT_TRUE(std::isfinite(s));
    lines_of(surface);
  }
}

TEST(CrestLines, NameWhatIsWrong) {
  const Surface surface = shapes::grid(2).surface();
  const Curvature curvature = principal_curvatures(surface);
  const auto message = [&](const Curvature& of, const CrestLineOptions& options) -> std::string {
    try {
      crest_lines(surface, of, options);
    } catch (const InvalidInput& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_EQ(message({}, {}), "curvature of 0 vertices for a surface of 9");
  EXPECT_EQ(message(curvature, {.least_strength = -1.0}), "least_strength is -1, not a finite number of 0 or more");
  EXPECT_EQ(message(curvature, {.least_drop = 1.0}), "least_drop is 1, not in [0, 1)");
}

TEST(CrestLines, EndWhereTheCallerWantsNoMore) {
  const Surface surface = shapes::icosphere(4).surface();
  const Curvature curvature = principal_curvatures(surface);
  Task task;
  task.progress = [](double done) { return done < 0.5; };
  EXPECT_THROW(crest_lines(surface, curvature, {}, task), Cancelled);
}

}  // namespace
}  // namespace seamwire
