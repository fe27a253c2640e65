// SPDX-License-Identifier: GPL-3.0-or-later
#include "seamwire_uv/maps/flatten.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
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

TEST(Flatten, AStartThatIsSolvedIsUsedThoughBothSolvesTogetherTakeMoreStepsThanOneMay) {
  // A flat staircase that turns one and a half times is solved without the barrier, and then with it.
  const Surface surface = shapes::parametric(40, 3, false, false, [](double u, double v) {
                            const double angle = 3 * std::numbers::pi * u, radius = 0.5 + 0.5 * v;
                            return Vector(radius * std::cos(angle), radius * std::sin(angle), 0.1 * angle);
                          }).surface();
  FlattenOptions options;
  options.start = flatten(surface, {}).uvs;
  for (auto& corners : options.start) {
    for (Eigen::Vector2d& uv : corners) uv = {-uv.y(), uv.x()};  // Tutte's embedding lies otherwise
  }
  const std::size_t needed = flatten(surface, {}, options).by_island[0].steps;
  options.max_steps = needed - 1;
  const Flattening again = flatten(surface, {}, options);
  EXPECT_EQ(again.by_island[0].steps, needed);
  for (std::size_t f = 0; f < surface.face_count(); ++f) {
    EXPECT_LT((again.uvs[f][0] - options.start[f][0]).norm(), 0.05);
  }
}

TEST(Flatten, AStartIsEnoughWhereNumbersCannotHoldTuttesEmbedding) {
  // A tube that is one polygon with inner vertices: it cannot be opened further.
  constexpr std::int32_t kRings = 900;
  std::vector<Vector> points;
  std::vector<Eigen::Vector2d> flat;
  std::vector<Triangle> triangles;
  for (std::int32_t ring = 0; ring < kRings; ++ring) {
    for (std::int32_t i = 0; i < 3; ++i) {
      const double angle = 2.0 * std::numbers::pi * i / 3.0;
      points.emplace_back(std::cos(angle), std::sin(angle), -ring);
      flat.emplace_back((kRings - ring) * std::cos(angle), (kRings - ring) * std::sin(angle));
      if (ring == 0) continue;
      const std::int32_t a = 3 * ring + i, b = 3 * ring + (i + 1) % 3;
      triangles.insert(triangles.end(), {{a - 3, b - 3, b}, {a - 3, b, a}});
    }
  }
  triangles.push_back({3 * kRings - 3, 3 * kRings - 2, 3 * kRings - 1});
  const Surface surface(points, triangles, std::vector<Edge>{{0, 1}, {1, 2}, {0, 2}});
  FlattenOptions options;
  options.max_steps = 2;
  EXPECT_THROW(flatten(surface, {}, options), InvalidInput);
  for (const Triangle& t : triangles) options.start.push_back({flat[t[0]], flat[t[1]], flat[t[2]]});
  const Flattening found = flatten(surface, {}, options);
  EXPECT_EQ(found.by_island[0].steps, 2U) << "it is not finished";
  EXPECT_TRUE(std::isfinite(found.energy));
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

TEST(Flatten, AStartMayHaveAnyScale) {
  const Surface surface = shapes::bumpy(shapes::grid(10), 0.04).surface();
  const Flattening first = flatten(surface, {});
  for (const double scale : {1e-300, 1e-90, 1e-8, 0.3, 1.0, 7.0, 1e16, 1e100, 1e300}) {
    FlattenOptions options;
    options.start = first.uvs;
    for (auto& corners : options.start) {
      for (Eigen::Vector2d& uv : corners) uv *= scale;
    }
    const Flattening second = flatten(surface, {}, options);
    EXPECT_NEAR(second.by_island[0].energy, first.by_island[0].energy, 1e-5) << scale;
    EXPECT_LT(second.by_island[0].steps, first.by_island[0].steps) << scale << ": it is used";
  }
}

TEST(Flatten, AStartThatIsLostInRoundingIsNotUsed) {
  const Surface surface({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0.2}}, {{0, 1, 2}, {0, 2, 3}});
  const double expected = flatten(surface, {}).energy;
  for (const double height : {1e-10, 1e-70, 1e-100, 1e-200, 1e-300}) {
    FlattenOptions options;
    options.start = {{{{0, 0}, {1, 0}, {1, height}}}, {{{0, 0}, {1, height}, {0, 1}}}};
    EXPECT_NEAR(flatten(surface, {}, options).energy, expected, 1e-6) << height;
  }
}

TEST(Flatten, RefusesOptionsOutOfRange) {
  const Surface surface = shapes::grid(2).surface();
  for (const double wrong : {-1.0, std::nan("")}) {
    EXPECT_THROW(flatten(surface, {}, {.tolerance = wrong}), InvalidInput);
    EXPECT_THROW(flatten(surface, {}, {.straighten = wrong}), InvalidInput);
  }
  EXPECT_THROW(flatten(surface, {}, {.straighten = std::numeric_limits<double>::infinity()}), InvalidInput);
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

}  // namespace
}  // namespace seamwire
