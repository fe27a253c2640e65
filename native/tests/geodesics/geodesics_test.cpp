// SPDX-License-Identifier: GPL-3.0-or-later
#include "seamwire/geodesics/exact_geodesics.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <chrono>
#include <cmath>
#include <numbers>
#include <optional>
#include <set>
#include <string>
#include <thread>

#include "geodesics/geodesic_mesh.hpp"
#include "intrinsic.hpp"
#include "paths.hpp"
#include "reference_geodesics.hpp"
#include "seamwire/embedding/embedding.hpp"
#include "seamwire/metric/curvature.hpp"
#include "seamwire/metric/metric.hpp"

namespace seamwire {
namespace {

using paths::length_of;
using shapes::exactness_meshes;
using shapes::intrinsic;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

std::size_t index(std::int32_t i) { return static_cast<std::size_t>(i); }

/// Every path starts at the seed, ends at its vertex, and is as long as the distance says. 1e-9: crossings are found by
/// unfolding, whose rounding grows with the number of triangles.
void expect_paths_as_long_as_distances(const IntrinsicMesh& mesh, const DistanceField& field) {
  for (std::int32_t v = 0; v < mesh.vertex_count; ++v) {
    const double distance = field.distances()[index(v)];
    const std::optional<IntrinsicPath> found = field.trace(v);
    ASSERT_EQ(found.has_value(), !std::isinf(distance));
    if (!found) continue;
    const IntrinsicPath& path = *found;
    EXPECT_EQ(path.points.front().vertex, field.seed());
    EXPECT_EQ(path.points.back().vertex, v);
    EXPECT_NEAR(path.length, distance, 1e-9 * distance) << "vertex " << v;
    EXPECT_NEAR(length_of(mesh, path), distance, 1e-9 * distance) << "vertex " << v;
  }
}

/// 1e-9 is what "exact" means here; both solvers are off by rounding, some 1e-14.
void expect_distances(const std::vector<double>& found, const std::vector<double>& expected, double tolerance = 1e-9) {
  ASSERT_EQ(found.size(), expected.size());
  for (std::size_t v = 0; v < found.size(); ++v) {
    if (std::isinf(expected[v])) {
      EXPECT_TRUE(std::isinf(found[v])) << "vertex " << v;
    } else {
      EXPECT_NEAR(found[v], expected[v], tolerance * expected[v]) << "vertex " << v;
    }
  }
}

void expect_exact(const IntrinsicMesh& mesh, const std::vector<std::int32_t>& seeds) {
  const ExactGeodesics geodesics(mesh);
  const reference::Geodesics reference(mesh);
  for (const std::int32_t seed : seeds) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const DistanceField field = geodesics.solve(seed);
    EXPECT_EQ(field.seed(), seed);
    expect_distances(field.distances(), reference.distances(seed));
    expect_paths_as_long_as_distances(mesh, field);
  }
}

/// The plane: distances are those of the mapped points.
void expect_plane(const shapes::Mesh& mesh, const Eigen::Matrix3d& map, std::int32_t seed, double tolerance) {
  const IntrinsicMesh plane = intrinsic(mesh, map);
  const DistanceField field = ExactGeodesics(plane).solve(seed);
  std::vector<double> expected;
  for (const Vector& p : mesh.points) expected.push_back((map * (p - mesh.points[index(seed)])).norm());
  expect_distances(field.distances(), expected, tolerance);
  expect_paths_as_long_as_distances(plane, field);
}

Eigen::Matrix3d stretch(double factor, double angle) {
  const Eigen::AngleAxisd turn(angle, Vector::UnitZ());
  return turn.toRotationMatrix() * Vector(factor, 1 / factor, 1).asDiagonal() * turn.toRotationMatrix().transpose();
}

/// Paths bend at vertices of more than a full turn. Triangles around a vertex, each with the same angle there.
TEST(GeodesicMesh, FindsAnglesBeyondAFullTurn) {
  constexpr double kTurn = 2 * std::numbers::pi;
  for (const int count : {3, 4, 6, 7, 13, 200}) {
    IntrinsicMesh mesh;
    mesh.vertex_count = count + 1;
    for (std::int32_t f = 0; f < count; ++f) {
      const std::int32_t next = (f + 1) % count, before = (f + count - 1) % count;
      mesh.triangles.push_back({0, f + 1, next + 1});
      mesh.twins.insert(mesh.twins.end(), {3 * before + 2, -1, 3 * next});
    }
    const auto may_bend = [&](double angle) {
      const double opposite = std::min(2.0 - 1e-12, 2 * std::sin(angle / count / 2));
      mesh.lengths.clear();
      for (int f = 0; f < count; ++f) mesh.lengths.insert(mesh.lengths.end(), {1.0, opposite, 1.0});
      const detail::GeodesicMesh made(mesh, {});
      return made.is_pseudo_source(made.internal_vertex(0));
    };
    const double most = std::numbers::pi * count;  // where the triangles have hardly any height
    for (const double turns : {0.3, 0.5, 0.9, 1.0, 1.1, 1.5, 1.9, 2.0, 2.1, 2.6, 3.0, 50.3}) {
      if (turns * kTurn >= most) continue;
      EXPECT_EQ(may_bend(turns * kTurn), turns > 1) << count << " triangles, " << turns << " turns";
    }
    EXPECT_FALSE(may_bend(kTurn + 1e-8)) << "by rounding alone";
    EXPECT_TRUE(may_bend(kTurn + 1e-6));
    EXPECT_TRUE(may_bend(most)) << count << " needles";
  }
}

// Equal distances everywhere: a queue or a filter that mishandles ties loses vertices here.
TEST(Geodesics, RegularGridHasEuclideanDistances) {
  const shapes::Mesh grid = shapes::grid(32);
  for (const std::int32_t seed : {0, 16 * 33 + 16, 5 * 33 + 30, 33 * 33 - 1}) {
    expect_plane(grid, Eigen::Matrix3d::Identity(), seed, 1e-12);
  }
}

TEST(Geodesics, JitteredGridHasEuclideanDistances) {
  const shapes::Mesh grid = shapes::grid(24, 0.3);
  for (const std::int32_t seed : {0, 12 * 25 + 12, 100}) {
    expect_plane(grid, Eigen::Matrix3d::Identity(), seed, 1e-12);
  }
}

// Needles of up to 1 : 1e4; rounding of the angles grows with that.
TEST(Geodesics, StretchedPlaneHasTheMappedDistances) {
  for (const double factor : {3.0, 10.0}) {
    for (const double angle : {0.0, 0.3, 1.0}) {
      expect_plane(shapes::grid(16, 0.25), stretch(factor, angle), 8 * 17 + 8, 1e-9);
      expect_plane(shapes::grid(16), stretch(factor, angle), 40, 1e-9);
    }
  }
}

class ExactOn : public testing::TestWithParam<int> {};

TEST_P(ExactOn, EuclideanLengths) {
  const auto [name, mesh] = exactness_meshes(2)[static_cast<std::size_t>(GetParam())];
  SCOPED_TRACE(name);
  expect_exact(intrinsic(mesh), {0, mesh.triangles[7][1], mesh.triangles.back()[2]});
}

TEST_P(ExactOn, StretchedSpace) {
  const auto [name, mesh] = exactness_meshes(1)[static_cast<std::size_t>(GetParam())];
  SCOPED_TRACE(name);
  for (const double factor : {2.0, 100.0}) {
    const Eigen::Matrix3d map = Vector(std::sqrt(factor), 1, 1 / std::sqrt(factor)).asDiagonal();
    expect_exact(intrinsic(mesh, map), {mesh.triangles[5][0]});
  }
}

// Lengths that no surface in space need have: each triangle fulfils the triangle inequality, as no edge is longer than
// twice another one.
TEST_P(ExactOn, RandomLengths) {
  const auto [name, mesh] = exactness_meshes(2)[static_cast<std::size_t>(GetParam())];
  SCOPED_TRACE(name);
  std::mt19937 random(4);
  std::uniform_real_distribution<double> length(1.02, 2.0);
  expect_exact(intrinsic(mesh, [&](int, int) { return length(random); }), {mesh.triangles[3][0]});
}

// The lengths that the tool works on: anisotropic, on a refined mesh.
TEST_P(ExactOn, EmbeddedLengths) {
  const auto [name, mesh] = exactness_meshes(1)[static_cast<std::size_t>(GetParam())];
  SCOPED_TRACE(name);
  const Surface surface = mesh.surface();
  const Curvature curvature = principal_curvatures(surface);
  for (const Follow follow : {Follow::kMin, Follow::kMax}) {
    const Metric metric = feature_metric(surface, curvature, follow, {.max_anisotropy = 8.0});
    const Embedding embedding = embed(surface, metric, {.max_error = 0});
    // Plane and sphere have no feature to follow.
    if (name.starts_with("bumpy")) {
      EXPECT_GT(max_anisotropy(metric), 4.0);
    }
    expect_exact(embedding.mesh, {0, embedding.mesh.triangles.back()[1]});
  }
}

INSTANTIATE_TEST_SUITE_P(Geodesics, ExactOn, testing::Range(0, 7));

TEST(Geodesics, SingleTriangle) {
  shapes::Mesh mesh;
  mesh.points = {{0, 0, 0}, {3, 0, 0}, {0, 4, 0}};
  mesh.triangles = {{0, 1, 2}};
  const IntrinsicMesh triangle = intrinsic(mesh);
  const DistanceField field = ExactGeodesics(triangle).solve(1);
  EXPECT_EQ(field.distances(), (std::vector<double>{3, 0, 5}));
  const IntrinsicPath path = field.trace(2).value();
  EXPECT_EQ(path.faces, std::vector<std::int32_t>{0});
  const IntrinsicPath to_seed = field.trace(1).value();
  EXPECT_EQ(to_seed.points.size(), 1u);
  EXPECT_EQ(to_seed.length, 0.0);
}

TEST(Geodesics, ConeUnrollsToAPlane) {
  // Six equilateral triangles less one. The angle at the tip is 300 degrees. So two rim vertices three apart see each
  // other over the tip at 150 degrees, in a straight line of length 2 sin(75 degrees).
  shapes::Mesh mesh;
  mesh.points.assign(6, Vector::Zero());
  for (int i = 0; i < 5; ++i) mesh.triangles.push_back({5, i, (i + 1) % 5});
  const IntrinsicMesh cone = intrinsic(mesh, [](int, int) { return 1.0; });
  const DistanceField field = ExactGeodesics(cone).solve(0);
  expect_distances(field.distances(), {0, 1, std::numbers::sqrt3, std::numbers::sqrt3, 1, 1}, 1e-14);
  expect_paths_as_long_as_distances(cone, field);
}

TEST(Geodesics, GoesAroundAHole) {
  // A square hole of side 1/2 in the middle of the unit square: from corner to corner the path touches its corner.
  const shapes::Mesh mesh = shapes::without(
      shapes::grid(8), [](const Vector& p) { return std::abs(p.x() - 0.5) < 0.25 && std::abs(p.y() - 0.5) < 0.25; });
  const IntrinsicMesh holed = intrinsic(mesh);
  const DistanceField field = ExactGeodesics(holed).solve(0);
  EXPECT_NEAR(field.distances()[80], 2 * std::hypot(0.75, 0.25), 1e-14);
  EXPECT_TRUE(std::isinf(field.distances()[40]));
  expect_exact(holed, {0, 8, 30});
}

TEST(Geodesics, CrossesAnEdgeOfThreeFacesStraight) {
  // Three half planes on one line: two of them make a plane.
  shapes::Mesh mesh;
  for (int page = 0; page < 3; ++page) {
    const double a = 2.1 * page;
    for (int j = 0; j <= 8; ++j) {
      for (int i = page == 0 ? 0 : 1; i <= 6; ++i) {
        mesh.points.emplace_back(i * std::cos(a), i * std::sin(a), j);
      }
    }
  }
  const auto at = [](int page, int i, int j) {
    return page == 0 || i == 0 ? 7 * j + i : 63 + 54 * (page - 1) + 6 * j + i - 1;
  };
  for (int page = 0; page < 3; ++page) {
    for (int j = 0; j < 8; ++j) {
      for (int i = 0; i < 6; ++i) {
        mesh.triangles.push_back({at(page, i, j), at(page, i + 1, j), at(page, i + 1, j + 1)});
        mesh.triangles.push_back({at(page, i, j), at(page, i + 1, j + 1), at(page, i, j + 1)});
      }
    }
  }
  const IntrinsicMesh book = intrinsic(mesh);
  EXPECT_EQ(std::count(book.twins.begin(), book.twins.end(), -1), 3 * (8 + 8 + 6 + 6));
  const DistanceField field = ExactGeodesics(book).solve(at(1, 3, 2));
  EXPECT_NEAR(field.distances()[index(at(2, 3, 2))], 6.0, 1e-14);
  EXPECT_NEAR(field.distances()[index(at(2, 3, 3))], std::hypot(6, 1), 1e-14);
  expect_exact(book, {at(1, 3, 2), at(0, 0, 4), at(2, 6, 8)});
}

TEST(Geodesics, PassesFromFanToFanThroughOneVertex) {
  // Two icospheres that share a vertex: all distances on the second go through it.
  const shapes::Mesh ball = shapes::icosphere(1);
  shapes::Mesh mesh = ball;
  const int shift = static_cast<int>(ball.points.size());
  const auto moved = [&](int v) { return v == 0 ? 0 : v + shift; };
  for (const Vector& p : ball.points) mesh.points.push_back(p + 2 * ball.points[0]);
  for (const auto& [a, b, c] : ball.triangles) mesh.triangles.push_back({moved(a), moved(b), moved(c)});
  const IntrinsicMesh two = intrinsic(mesh);
  const DistanceField field = ExactGeodesics(two).solve(20);
  const DistanceField from_knot = ExactGeodesics(two).solve(0);
  for (int v = shift + 1; v < 2 * shift; ++v) {
    EXPECT_NEAR(field.distances()[index(v)], field.distances()[0] + from_knot.distances()[index(v)], 1e-12);
  }
  EXPECT_TRUE(std::isinf(field.distances()[index(shift)]));  // the point left over
  expect_exact(two, {20, 0});
}

TEST(Geodesics, RunsAlongLooseEdges) {
  // Two separate squares and a chain of loose edges between them, one of length zero, and a bridge over the first.
  shapes::Mesh mesh = shapes::grid(6);
  const auto half = static_cast<std::int32_t>(mesh.points.size());
  const shapes::Mesh other = shapes::grid(6);
  for (const Vector& p : other.points) mesh.points.push_back(p + Vector(3, 0, 0));
  for (const auto& [a, b, c] : other.triangles) mesh.triangles.push_back({a + half, b + half, c + half});
  mesh.points.emplace_back(2, 0, 0);
  IntrinsicMesh joined = intrinsic(mesh);
  const std::int32_t middle = 2 * half;
  joined.vertex_count = middle + 2;
  joined.loose_edges = {{24, middle, 1.5}, {middle, middle + 1, 0.0}, {half + 24, middle + 1, 0.5}, {0, 48, 0.25}};
  const DistanceField field = ExactGeodesics(joined).solve(0);
  EXPECT_NEAR(field.distances()[48], 0.25, 0);
  const double to_24 = std::hypot(0.5, 0.5);
  EXPECT_NEAR(field.distances()[index(half + 24)], std::min(to_24, 0.25 + to_24) + 2.0, 1e-14);
  const IntrinsicPath path = field.trace(half + 24).value();
  EXPECT_EQ(std::count(path.faces.begin(), path.faces.end(), -1), 3);
  expect_exact(joined, {0, middle, middle + 1, half + 3, 20});
}

TEST(Geodesics, UnreachableIsInfinitelyFar) {
  shapes::Mesh mesh = shapes::icosphere(1);
  const auto count = static_cast<int>(mesh.points.size());
  for (int i = 0; i < count; ++i) mesh.points.push_back(mesh.points[index(i)] + Vector(2, 0, 0));
  const shapes::Mesh one = shapes::icosphere(1);
  for (const auto& [a, b, c] : one.triangles) mesh.triangles.push_back({a + count, b + count, c + count});
  mesh.points.emplace_back(9, 9, 9);
  const IntrinsicMesh two = intrinsic(mesh);
  const DistanceField field = ExactGeodesics(two).solve(3);
  for (int v = 0; v <= 2 * count; ++v) EXPECT_EQ(std::isinf(field.distances()[index(v)]), v >= count);
  EXPECT_FALSE(field.trace(count));
  expect_exact(two, {3, count + 5, 2 * count});
}

TEST(Geodesics, MeshWithoutFacesIsItsLooseEdges) {
  IntrinsicMesh wire;
  wire.vertex_count = 4;
  wire.loose_edges = {{0, 1, 1.0}, {1, 2, 2.0}, {0, 2, 5.0}};
  const DistanceField field = ExactGeodesics(wire).solve(0);
  EXPECT_EQ(field.distances(), (std::vector<double>{0, 1, 3, kInfinity}));
  EXPECT_EQ(field.trace(2)->points.size(), 3u);
  EXPECT_EQ(field.trace(2)->length, 3.0);
}

TEST(Geodesics, MoebiusStripCutOpenIsABentStrip) {
  // The last column is glued to the first one upside down, cut open for want of an orientation: through vertices only.
  shapes::Mesh mesh = shapes::grid(10);
  const auto wrap = [](std::int32_t v) { return v % 11 == 10 ? (10 - v / 11) * 11 : v; };
  for (Triangle& t : mesh.triangles) t = {wrap(t[0]), wrap(t[1]), wrap(t[2])};
  for (int j = 0; j <= 10; ++j) {
    for (int i = 0; i <= 10; ++i) {
      const double u = 2 * std::numbers::pi * i / 10, w = 0.06 * (j - 5);
      mesh.points[index(11 * j + i)] = {(1 + w * std::cos(u / 2)) * std::cos(u),
                                        (1 + w * std::cos(u / 2)) * std::sin(u), w * std::sin(u / 2)};
    }
  }
  const IntrinsicMesh strip = intrinsic(mesh);
  EXPECT_GT(std::count(strip.twins.begin(), strip.twins.end(), -1), 20);
  expect_exact(strip, {0, 5 * 11 + 5, 3 * 11 + 9});
}

TEST(Geodesics, DistancesAreSymmetricInTheirEnds) {
  const shapes::Mesh mesh = shapes::bumpy(shapes::torus(30, 16), 0.08);
  const ExactGeodesics geodesics(intrinsic(mesh));
  const std::vector<std::int32_t> seeds = {0, 77, 251, 400};
  std::vector<DistanceField> fields;
  for (const std::int32_t seed : seeds) fields.push_back(geodesics.solve(seed));
  for (std::size_t i = 0; i < seeds.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      const double there = fields[i].distances()[index(seeds[j])];
      EXPECT_NEAR(there, fields[j].distances()[index(seeds[i])], 1e-12 * there);
    }
  }
}

TEST(Geodesics, NumberingDoesNotMatter) {
  const shapes::Mesh mesh = shapes::bumpy(shapes::icosphere(3), 0.1);
  std::mt19937 random(3);
  std::vector<std::int32_t> new_number(mesh.points.size());
  for (std::size_t v = 0; v < new_number.size(); ++v) new_number[v] = static_cast<std::int32_t>(v);
  std::shuffle(new_number.begin(), new_number.end(), random);
  shapes::Mesh shuffled = mesh;
  for (std::size_t v = 0; v < new_number.size(); ++v) shuffled.points[index(new_number[v])] = mesh.points[v];
  for (Triangle& t : shuffled.triangles) {
    t = {new_number[index(t[1])], new_number[index(t[2])], new_number[index(t[0])]};
  }
  std::shuffle(shuffled.triangles.begin(), shuffled.triangles.end(), random);
  const DistanceField field = ExactGeodesics(intrinsic(mesh)).solve(11);
  const IntrinsicMesh other_mesh = intrinsic(shuffled);
  const DistanceField other = ExactGeodesics(other_mesh).solve(new_number[11]);
  std::vector<double> expected(mesh.points.size());
  for (std::size_t v = 0; v < expected.size(); ++v) expected[index(new_number[v])] = field.distances()[v];
  expect_distances(other.distances(), expected, 1e-12);
  expect_paths_as_long_as_distances(other_mesh, other);
}

TEST(Geodesics, RepeatedSolvesAgreeToTheBit) {
  const ExactGeodesics geodesics(intrinsic(shapes::bumpy(shapes::icosphere(4), 0.1)));
  const ExactField field = geodesics.solve(5);
  ExactField again = field;
  std::jthread([&] { again = geodesics.solve(5); }).join();
  EXPECT_EQ(field.distances(), again.distances());
  const GeodesicCounters &counters = field.counters(), &counters_again = again.counters();
  EXPECT_GT(counters.lists, 5120u);
  EXPECT_GT(counters.windows, counters.lists);
  EXPECT_EQ(counters.lists, counters_again.lists);
  EXPECT_EQ(counters.windows, counters_again.windows);
}

// The filter and the two-sides rule keep the windows to some twenty a triangle on meshes of this size. Without one of
// them there are several times as many, and without both the search never ends.
TEST(Geodesics, WindowsStayFew) {
  for (const shapes::Mesh& mesh : {shapes::grid(100, 0.2), shapes::grid(100)}) {
    EXPECT_LT(ExactGeodesics(intrinsic(mesh)).solve(5000).counters().windows, 32u * 20000u);
  }
}

TEST(Geodesics, ProgressRisesAndCancelEndsTheWork) {
  const ExactGeodesics geodesics(intrinsic(shapes::bumpy(shapes::icosphere(5), 0.1)));
  std::vector<double> fractions;
  Task task;
  task.progress = [&](double fraction) {
    fractions.push_back(fraction);
    return true;
  };
  const DistanceField field = geodesics.solve(0, task);
  EXPECT_GT(fractions.size(), 10u);
  EXPECT_TRUE(std::is_sorted(fractions.begin(), fractions.end()));
  EXPECT_GE(fractions.front(), 0.0);
  EXPECT_EQ(fractions.back(), 1.0);

  task.progress = [&](double fraction) { return fraction < 0.5; };
  EXPECT_THROW(geodesics.solve(0, task), Cancelled);
  std::stop_source stop;
  stop.request_stop();
  task = {.stop = stop.get_token(), .progress = {}};
  EXPECT_THROW(geodesics.solve(0, task), Cancelled);
}

/// A strip of needles over the seed, 0, with a chain of loose edges above it. The front has passed the chain before it
/// meets the first vertex of the chain, 4, from below. Straight over the needles this vertex is at 2, and it was taken
/// to be at 3. From each vertex of the chain two ways lead to the next, which are nearly as long.
struct ChainOverNeedles {
  static constexpr int kLinks = 34, kLeaves = 20'000;
  IntrinsicMesh mesh;
  std::int32_t last = 4;  ///< of the chain

  ChainOverNeedles() {
    const shapes::Mesh needles{{{0, 0, 0}, {-100, 1, 0}, {100, 1, 0}, {100, 1.5, 0}, {0, 2, 0}, {-1, 1, 0}},
                               {{0, 2, 1}, {1, 2, 3}, {1, 3, 4}}};
    mesh = intrinsic(needles);
    mesh.loose_edges = {{0, 5, 1.5}, {5, 4, 1.5}};
    std::int32_t next = 6;
    double more = 0.5;
    for (int i = 0; i < kLinks; ++i, more /= 2) {
      const std::int32_t one = next++, two = next++, end = next++;
      mesh.loose_edges.insert(mesh.loose_edges.end(),
                              {{last, one, 1}, {last, two, 1}, {one, end, 1}, {two, end, 1 + more}});
      last = end;
    }
    for (int i = 0; i < kLeaves; ++i) mesh.loose_edges.push_back({4, next++, 1});
    mesh.vertex_count = next;
  }
};

// Vertices that become nearer after the front has passed them send out anew. Last in, first out, the end of the chain
// would do so 2^34 times.
TEST(Geodesics, WhatIsFoundNearerLaterIsHandedOnNearestFirst) {
  const ChainOverNeedles chain;
  const DistanceField field = ExactGeodesics(chain.mesh).solve(0);
  EXPECT_NEAR(field.distances()[4], 2, 1e-12);
  EXPECT_NEAR(field.distances()[index(chain.last)], 2 + 2 * ChainOverNeedles::kLinks, 1e-9);
  EXPECT_NEAR(field.distances().back(), 3, 1e-12);
}

TEST(Geodesics, CancelIsHeardWhileThatIsHandedOn) {
  const ChainOverNeedles chain;
  const ExactGeodesics geodesics(chain.mesh);
  int asked = 0;
  const Task counting{.stop = {}, .progress = [&](double) { return ++asked > 0; }};
  geodesics.solve(0, counting);
  EXPECT_GT(asked, 3) << "at the start, at the end, and for each 8192 vertices of the 20 000 that are nearer";
  int more = 2;
  const Task cancelled{.stop = {}, .progress = [&](double) { return --more > 0; }};
  EXPECT_THROW(geodesics.solve(0, cancelled), Cancelled);
}

/// Part of a plane pulled together until it is a speck; what joins it to the rest is thinner than rounding. Unfolding
/// that moves what lies beyond by more than the speck is wide.
IntrinsicMesh with_speck(unsigned seed) {
  shapes::Mesh mesh = shapes::bumpy(shapes::grid(8, 0.3, seed), 0.05, seed);
  const Vector center(0.5, 0.5, 0.0);
  for (Vector& point : mesh.points) {
    if ((point - center).norm() < 0.3) point = center + 1e-9 * (point - center);
  }
  return intrinsic(mesh);
}

// Lines that lead nowhere go on along edges. Unfolding loses most digits here, so the bound is far from rounding.
TEST(Geodesics, PathsOverTrianglesThinnerThanRoundingLeadToTheSeed) {
  for (unsigned seed = 1; seed <= 20; ++seed) {
    const IntrinsicMesh mesh = with_speck(seed);
    const ExactGeodesics geodesics(mesh);
    for (std::int32_t from = 0; from < mesh.vertex_count; from += 5) {
      const DistanceField field = geodesics.solve(from);
      for (std::int32_t v = 0; v < mesh.vertex_count; ++v) {
        const IntrinsicPath path = field.trace(v).value();
        ASSERT_EQ(path.points.front().vertex, from);
        ASSERT_EQ(path.points.back().vertex, v);
        EXPECT_LE(length_of(mesh, path), 1.2 * field.distances()[index(v)] + 1e-8) << from << " to " << v;
      }
    }
  }
}

TEST(Geodesics, LongTracesOfAnExactFieldCanBeCancelled) {
  // Along a narrow strip, over 6000 triangles.
  const shapes::Mesh strip =
      shapes::parametric(3000, 1, false, false, [](double u, double v) { return Vector(30.0 * u, v, 0.0); });
  const DistanceField field = ExactGeodesics(intrinsic(strip)).solve(0);
  const auto far = static_cast<std::int32_t>(strip.points.size()) - 1;
  EXPECT_GT(field.trace(far)->faces.size(), 5000U);
  const Task never{.stop = {}, .progress = [](double) { return false; }};
  EXPECT_THROW(field.trace(far, never), Cancelled);
}

void expect_invalid(const IntrinsicMesh& mesh, const std::string& part_of_message) {
  try {
    const ExactGeodesics geodesics(mesh);
    FAIL() << "accepted, expected: " << part_of_message;
  } catch (const InvalidInput& error) {
    EXPECT_NE(std::string(error.what()).find(part_of_message), std::string::npos) << error.what();
  }
}

TEST(Geodesics, LengthsMayBeInAnyUnit) {
  const IntrinsicMesh mesh = intrinsic(shapes::bumpy(shapes::grid(6), 0.05));
  const SurfacePoint point{11, {0.2, 0.3, 0.5}};
  const DistanceField expected = ExactGeodesics(mesh).solve(0);
  for (const int exponent : {-250, 250}) {  // about 1e-75 and 1e75
    IntrinsicMesh scaled = mesh;
    for (double& length : scaled.lengths) length = std::ldexp(length, exponent);
    const DistanceField field = ExactGeodesics(scaled).solve(0);
    EXPECT_DOUBLE_EQ(std::ldexp(field.distance(point), -exponent), expected.distance(point));
    EXPECT_DOUBLE_EQ(std::ldexp(field.distances().back(), -exponent), expected.distances().back());
  }
}

TEST(Geodesics, TrianglesWithoutAnAreaAreRefusedAndNeedlesAreExact) {
  // A triangle that the mesh's one interior edge bounds on its longest side: nearly flat, then flat.
  const auto mesh_of = [](double slack) {
    IntrinsicMesh mesh;
    mesh.vertex_count = 4;
    mesh.triangles = {{0, 1, 2}, {2, 1, 3}};
    mesh.twins = {-1, 3, -1, 1, -1, -1};
    mesh.lengths = {2, 3, 1 + slack, 3, 3, 1};
    return mesh;
  };
  for (const double slack : {1e-12, 1e-9, 1e-6}) {
    const ExactGeodesics geodesics(mesh_of(slack));
    const double there = geodesics.solve(0).distances()[3], back = geodesics.solve(3).distances()[0];
    EXPECT_NEAR(there, back, 1e-14);
    EXPECT_NEAR(there, std::sqrt(5.0 / 3.0), 2.0 * std::sqrt(slack));
  }
  for (const double slack : {1e-14, 0.0}) expect_invalid(mesh_of(slack), "no area");
  expect_invalid(mesh_of(-1e-14), "triangle inequality");
}

TEST(Geodesics, WrongInputIsNamed) {
  const IntrinsicMesh good = intrinsic(shapes::grid(3));
  IntrinsicMesh bad = good;
  bad.lengths[4] = std::numeric_limits<double>::quiet_NaN();
  expect_invalid(bad, "half-edge 4 ");
  bad = good;
  bad.lengths[5] = 0;
  expect_invalid(bad, "positive");
  bad = good;
  bad.lengths[4] *= 1.5;
  expect_invalid(bad, "its twin");
  bad = good;
  bad.lengths[0] *= 9;
  expect_invalid(bad, "triangle 0");
  bad = intrinsic(shapes::grid(1), [](int a, int b) { return a == 0 && b == 3 ? 2 + 1e-9 : 1; });
  expect_invalid(bad, "2.000000001");
  bad = good;
  bad.twins[2] = 7;
  expect_invalid(bad, "half-edge 2 ");
  bad = good;
  bad.twins.pop_back();
  expect_invalid(bad, "3 entries");
  bad = good;
  bad.triangles[3][1] = 99;
  expect_invalid(bad, "vertex 99");
  bad = good;
  bad.loose_edges = {{0, 1, 0.0}, {0, 1, -1.0}};
  expect_invalid(bad, "loose edge 1");
  bad.loose_edges = {{0, -4, 1.0}};
  expect_invalid(bad, "vertex -4");
  for (const double factor : {1e200, 1e100, 1e-100, 1e-200}) {
    bad = good;
    for (double& length : bad.lengths) length *= factor;
    expect_invalid(bad, factor > 1.0 ? "at most 1e76" : "at least 1e-76");
  }
  bad = good;
  bad.loose_edges = {{0, 1, 1e200}};
  expect_invalid(bad, "loose edge 0");

  const ExactGeodesics geodesics(good);
  EXPECT_THROW(geodesics.solve(-1), InvalidInput);
  EXPECT_THROW(geodesics.solve(16), InvalidInput);
  const DistanceField field = geodesics.solve(2);
  EXPECT_THROW(field.trace(-1), InvalidInput);
  EXPECT_THROW(field.trace(16), InvalidInput);
}

TEST(ExactGeodesics, PassAVertexOfTwoLargeUmbrellas) {
  // Two open fans around vertex 0. The work at a vertex is in proportion to its triangles: the square of their number
  // would take a minute.
  constexpr std::int32_t kTriangles = 200'000;
  IntrinsicMesh mesh;
  mesh.vertex_count = 1 + 2 * (kTriangles + 1);
  const double side = 2.0 * std::sin(0.5 / kTriangles);
  for (std::int32_t i = 0; i < 2 * kTriangles; ++i) {
    const bool is_first = i % kTriangles == 0, is_last = i % kTriangles == kTriangles - 1;
    const std::int32_t from = 1 + i + i / kTriangles, f = static_cast<std::int32_t>(mesh.triangles.size());
    mesh.triangles.push_back({0, from, from + 1});
    mesh.twins.insert(mesh.twins.end(), {is_first ? -1 : 3 * f - 1, -1, is_last ? -1 : 3 * f + 3});
    mesh.lengths.insert(mesh.lengths.end(), {1.0, side, 1.0});
  }
  const DistanceField field = ExactGeodesics(mesh).solve(1);
  EXPECT_NEAR(field.distances()[index(kTriangles + 1)], 2.0 * std::sin(0.5), 1e-6);  // over an angle of 1
  EXPECT_EQ(field.distances()[index(mesh.vertex_count - 1)], 2.0);
}

}  // namespace
}  // namespace seamwire
