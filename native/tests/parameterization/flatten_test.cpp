// SPDX-License-Identifier: GPL-3.0-or-later
#include "seamwire/parameterization/flatten.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <random>
#include <set>
#include <stop_token>

#include "seamwire/surface/segments.hpp"
#include "shapes.hpp"
#include "surface/corner_fans.hpp"

namespace seamwire {
namespace {

/// What holds for each map, and its report.
MapReport expect_sound(const Surface& surface, const Flattening& flat) {
  EXPECT_EQ(flat.uvs.size(), surface.face_count());
  EXPECT_EQ(flat.islands.size(), surface.face_count());
  for (const auto& corners : flat.uvs) {
    for (const Eigen::Vector2d& uv : corners) EXPECT_TRUE(uv.allFinite());
  }
  const MapReport report = measure_map(surface, flat.uvs, flat.islands);
  EXPECT_TRUE(report.flipped.empty()) << "triangle " << report.flipped.front();
  EXPECT_NEAR(report.energy, flat.energy, 1e-9 * flat.energy);
  std::vector<std::int32_t> overlapping;
  for (std::size_t i = 0; i < flat.by_island.size(); ++i) {
    if (flat.by_island[i].overlaps) overlapping.push_back(static_cast<std::int32_t>(i));
  }
  EXPECT_EQ(report.overlapping, overlapping);
  return report;
}

/// The same vertex has the same UVs in triangles on both sides of an edge; the number of edges where that does not
/// hold.
std::size_t seams_in(const Surface& surface, const CornerUvs& uvs) {
  std::size_t seams = 0;
  for (std::size_t h = 0; h < detail::corner_fans(surface).twins.size(); ++h) {
    const std::int32_t twin = detail::corner_fans(surface).twins[h];
    if (twin < static_cast<std::int32_t>(h)) continue;
    const auto uv_of = [&](std::size_t half_edge, std::int32_t fan) -> const Eigen::Vector2d& {
      const auto face = static_cast<std::size_t>(detail::corner_fans(surface).faces[half_edge / 3]);
      const Triangle& given = surface.triangles()[face];
      const std::int32_t v = detail::corner_fans(surface).vertices[static_cast<std::size_t>(fan)];
      return uvs[face][static_cast<std::size_t>(std::ranges::find(given, v) - given.begin())];
    };
    for (std::size_t end = 0; end < 2; ++end) {
      const std::int32_t fan = detail::corner_fans(surface).triangles[h / 3][(h + end) % 3];
      if (uv_of(h, fan) == uv_of(static_cast<std::size_t>(twin), fan)) continue;
      ++seams;
      break;
    }
  }
  return seams;
}

TEST(Flatten, SquaresStayThemselves) {
  const Surface surface = shapes::grid(6).surface();
  const Flattening flat = flatten(surface, {});
  expect_sound(surface, flat);
  ASSERT_EQ(flat.by_island.size(), 1U);
  EXPECT_NEAR(flat.energy, 4.0, 1e-6);
  EXPECT_NEAR(flat.by_island[0].area, 1.0, 1e-12);
  EXPECT_EQ(seams_in(surface, flat.uvs), 0U);
}

TEST(Flatten, IslandsHaveTheNumbersOfSegments) {
  const int nu = 16, nv = 10;
  const Surface surface = shapes::quad_torus(nu, nv).surface();
  std::vector<Edge> cuts;
  for (const int u : {0, 3}) {
    for (int v = 0; v < nv; ++v) cuts.push_back({v * nu + u, (v + 1) % nv * nu + u});
  }
  for (int u = 0; u < nu; ++u) cuts.push_back({u, (u + 1) % nu});
  const Flattening flat = flatten(surface, cuts);
  expect_sound(surface, flat);
  EXPECT_EQ(flat.islands, face_segments(surface, cuts));
  ASSERT_EQ(flat.by_island.size(), 2U);
  EXPECT_GT(flat.by_island[0].area, flat.by_island[1].area);
  for (const FlatIsland& island : flat.by_island) {
    EXPECT_EQ(island.opened, 0U);
    EXPECT_EQ(flat.islands[static_cast<std::size_t>(island.worst)], &island - flat.by_island.data());
  }
  EXPECT_EQ(seams_in(surface, flat.uvs), cuts.size());
  EXPECT_LT(flat.energy, 4.3);
  // Diagonals of quads are no edges.
  EXPECT_EQ(flatten(surface, std::vector<Edge>{{0, nu + 1}}).by_island.size(), 1U);
}

TEST(Flatten, ClosedIslandsAndHandlesAreOpened) {
  for (const shapes::Mesh& mesh : {shapes::icosphere(2), shapes::torus(16, 10)}) {
    const Surface surface = mesh.surface();
    const Flattening flat = flatten(surface, {});
    expect_sound(surface, flat);
    EXPECT_GT(flat.by_island[0].opened, 1U);
    EXPECT_EQ(seams_in(surface, flat.uvs), flat.by_island[0].opened);
  }
}

TEST(Flatten, AClosedTubeTooLongForDoublePrecisionIsOpened) {
  shapes::Mesh mesh = shapes::cylinder(8, 120, 0.05, 4.0);
  const auto top = static_cast<std::int32_t>(mesh.points.size());
  mesh.points.emplace_back(0, 0, 4.0);
  for (std::int32_t i = 0; i < 8; ++i) mesh.triangles.push_back({top - 9 + i + 1, top - 9 + (i + 1) % 8 + 1, top});
  const Surface surface = mesh.surface();
  const Flattening flat = flatten(surface, {});
  expect_sound(surface, flat);
  EXPECT_GT(flat.by_island[0].opened, 100U);
  EXPECT_LT(flat.energy, 4.1);
}

TEST(Flatten, OneSidedAndNonManifoldSurfacesAreCutOpen) {
  const Surface band = shapes::moebius(12).surface();
  const Flattening flat = flatten(band, {});
  expect_sound(band, flat);
  EXPECT_NEAR(flat.energy, 4.0, 0.01) << "nearly flat triangles in a row";
  // Three squares around one edge: one segment, three islands.
  shapes::Mesh book;
  book.points = {{0, 0, 0}, {0, 0, 1}, {1, 0, 0}, {1, 0, 1}, {0, 1, 0}, {0, 1, 1}, {-1, 0, 0}, {-1, 0, 1}};
  for (const std::int32_t page : {2, 4, 6}) {
    book.triangles.push_back({0, page, page + 1});
    book.triangles.push_back({0, page + 1, 1});
  }
  const Surface surface = book.surface();
  const Flattening pages = flatten(surface, {});
  expect_sound(surface, pages);
  EXPECT_EQ(pages.islands, (std::vector<std::int32_t>{0, 0, 1, 1, 2, 2}));
  for (const FlatIsland& island : pages.by_island) EXPECT_NEAR(island.energy, 4.0, 1e-6);
}

TEST(Flatten, TrianglesThatTheSurfaceLeftOutHaveUvs) {
  shapes::Mesh mesh = shapes::grid(3);
  mesh.triangles.push_back(mesh.triangles[4]);                                                   // twice
  mesh.triangles.push_back({mesh.triangles[7][0], mesh.triangles[7][0], mesh.triangles[7][1]});  // no triangle
  mesh.points.emplace_back(5, 5, 5);
  mesh.points.emplace_back(6, 5, 5);
  mesh.triangles.push_back({16, 16, 17});  // an island of nothing
  const Surface surface = mesh.surface();
  const Flattening flat = flatten(surface, {});
  expect_sound(surface, flat);
  EXPECT_EQ(flat.uvs[18], flat.uvs[4]);
  EXPECT_EQ(flat.uvs[19][0], flat.uvs[7][0]);
  EXPECT_EQ(flat.uvs[19][2], flat.uvs[7][1]);
  EXPECT_EQ(flat.by_island[static_cast<std::size_t>(flat.islands[20])].worst, -1);
  // Nothing but such triangles.
  const Surface nothing({{0, 0, 0}, {1, 0, 0}}, {{0, 0, 1}});
  EXPECT_EQ(flatten(nothing, {}).uvs.size(), 1U);
}

TEST(Flatten, TrianglesGivenTheOtherWayRoundKeepTheirCorners) {
  shapes::Mesh mesh = shapes::grid(5);
  for (std::size_t f = 0; f < mesh.triangles.size(); f += 3) std::swap(mesh.triangles[f][1], mesh.triangles[f][2]);
  const Surface surface = mesh.surface();
  const Flattening flat = flatten(surface, {});
  expect_sound(surface, flat);
  EXPECT_EQ(seams_in(surface, flat.uvs), 0U);
  EXPECT_NEAR(flat.energy, 4.0, 1e-6);
}

TEST(Flatten, AStartKeepsWhatIsFinished) {
  const shapes::Mesh bumps = shapes::bumpy(shapes::grid(10), 0.04);
  shapes::Mesh mesh = bumps;
  for (const Vector& p : bumps.points) mesh.points.push_back(p + Vector(3, 0, 0));
  for (const auto& [a, b, c] : bumps.triangles) mesh.triangles.push_back({a + 121, b + 121, c + 121});
  const Surface surface = mesh.surface();
  const Flattening first = flatten(surface, {});
  // The second island gets a cut and changes; the first one stays where it is.
  std::vector<Edge> cuts;
  for (std::int32_t j = 0; j < 5; ++j) cuts.push_back({121 + 11 * j + 5, 121 + 11 * (j + 1) + 5});
  FlattenOptions options;
  options.start = first.uvs;
  const Flattening second = flatten(surface, cuts, options);
  expect_sound(surface, second);
  double moved = 0.0, changed = 0.0;
  for (std::size_t f = 0; f < surface.face_count(); ++f) {
    double& most = f < bumps.triangles.size() ? moved : changed;
    for (std::size_t i = 0; i < 3; ++i) most = std::max(most, (second.uvs[f][i] - first.uvs[f][i]).norm());
  }
  EXPECT_LT(moved, 1e-3);
  EXPECT_GT(changed, 1e-2);
  EXPECT_LT(second.by_island[1].energy, first.by_island[1].energy);
}

TEST(Flatten, AStartKeepsWhereAnIslandWasOpened) {
  const Surface surface = shapes::torus(16, 10).surface();
  const Flattening first = flatten(surface, {});
  FlattenOptions options;
  options.start = first.uvs;
  const Flattening second = flatten(surface, {}, options);
  EXPECT_EQ(second.by_island[0].opened, first.by_island[0].opened);
  for (std::size_t f = 0; f < surface.face_count(); ++f) {
    EXPECT_LT((second.uvs[f][0] - first.uvs[f][0]).norm(), 1e-3);
  }
}

TEST(Flatten, AStartThatOverlapsIsGivenUp) {
  // A flat staircase that turns one and a half times.
  const Surface surface = shapes::parametric(40, 3, false, false, [](double u, double v) {
                            const double angle = 3 * std::numbers::pi * u, radius = 0.5 + 0.5 * v;
                            return Vector(radius * std::cos(angle), radius * std::sin(angle), 0.1 * angle);
                          }).surface();
  FlattenOptions options;
  options.keep_apart = false;
  options.start = flatten(surface, {}, options).uvs;
  EXPECT_TRUE(flatten(surface, {}, options).by_island[0].overlaps);
  options.keep_apart = true;
  EXPECT_FALSE(flatten(surface, {}, options).by_island[0].overlaps);
}

TEST(Flatten, AStartThatIsNoMapIsNotUsed) {
  const Surface surface = shapes::grid(4).surface();
  FlattenOptions options;
  options.start.assign(surface.face_count(), {Eigen::Vector2d(0, 0), Eigen::Vector2d(0, 1), Eigen::Vector2d(1, 0)});
  EXPECT_NEAR(flatten(surface, {}, options).energy, 4.0, 1e-6);
  options.start[3][1].x() = std::nan("");
  EXPECT_THROW(flatten(surface, {}, options), InvalidInput);
  options.start.pop_back();
  EXPECT_THROW(flatten(surface, {}, options), InvalidInput);
  EXPECT_THROW(flatten(surface, std::vector<Edge>{{0, 99}}), InvalidInput);
}

TEST(Flatten, CanBeCancelled) {
  const Surface surface = shapes::torus(40, 30).surface();
  std::stop_source stop;
  stop.request_stop();
  EXPECT_THROW(flatten(surface, {}, {}, {.stop = stop.get_token(), .progress = {}}), Cancelled);
  EXPECT_THROW(flatten(surface, {}, {}, {.stop = {}, .progress = [](double) { return false; }}), Cancelled);
}

TEST(Flatten, AnyMeshWithAnyCutsHasASoundMap) {
  std::mt19937 random(11);
  std::size_t straightened = 0;
  for (int round = 0; round < 12; ++round) {
    shapes::Mesh mesh = round % 3 == 0   ? shapes::bumpy(shapes::icosphere(2), 0.03, static_cast<unsigned>(round))
                        : round % 3 == 1 ? shapes::bumpy(shapes::torus(14, 9), 0.02, static_cast<unsigned>(round))
                                         : shapes::bumpy(shapes::moebius(15), 0.02, static_cast<unsigned>(round));
    const auto count = static_cast<std::int32_t>(mesh.points.size());
    const auto any = [&] { return static_cast<std::int32_t>(random() % static_cast<unsigned>(count)); };
    for (int i = 0; i < round; ++i) {
      // Fins, slivers, points in one place, triangles turned over.
      if (round % 2 == 0) mesh.triangles.push_back({any(), any(), any()});
      mesh.points[static_cast<std::size_t>(any())] = mesh.points[static_cast<std::size_t>(any())];
      std::ranges::reverse(mesh.triangles[random() % mesh.triangles.size()]);
    }
    const Surface surface = mesh.surface();
    std::bernoulli_distribution is_cut(0.08 * (round % 4));
    std::vector<Edge> cuts;
    for (const Edge& edge : surface.edges()) {
      if (is_cut(random)) cuts.push_back(edge);
    }
    SCOPED_TRACE(round);
    expect_sound(surface, flatten(surface, cuts, {.max_steps = 30}));
    // Straight at any cost, and turned.
    const Flattening straight = flatten(surface, cuts, {.max_steps = 30, .straighten = 1e9, .up = Vector(1, 2, 3)});
    expect_sound(surface, straight);
    for (const FlatIsland& island : straight.by_island) straightened += island.is_straight ? 1 : 0;
  }
  EXPECT_GT(straightened, 0U);
}

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

TEST(MeasureMap, IslandsStackedExactlyTakeTimeInProportion) {
  const auto looks_at = [](std::size_t count) {
    std::vector<Eigen::Vector2d> places(count, Eigen::Vector2d(0.25, 0.0));
    places.emplace_back(0.5, 0.5);  // in the stack
    places.emplace_back(3.0, 0.0);
    const Squares squares = squares_at(places);
    std::vector<std::int32_t> islands, colliding;
    for (std::int32_t i = 0; i < static_cast<std::int32_t>(places.size()); ++i) islands.insert(islands.end(), {i, i});
    for (std::int32_t i = 0; i <= static_cast<std::int32_t>(count); ++i) colliding.push_back(i);
    std::size_t looks = 0;
    const Task task{.stop = {}, .progress = [&](double) { return ++looks > 0; }};
    EXPECT_EQ(measure_map(squares.surface, squares.uvs, islands, task).colliding, colliding);
    return looks;
  };
  // It looks at the task after each 4096 pairs of sides.
  EXPECT_LE(looks_at(4000), 5 * looks_at(1000));
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
  const Task task{.stop = {}, .progress = [&](double) { return ++asked < 50; }};
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
