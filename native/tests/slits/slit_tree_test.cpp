// SPDX-License-Identifier: GPL-3.0-or-later
#include "slits/slit_tree.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <numbers>
#include <optional>
#include <set>
#include <vector>

#include "seam_problems.hpp"
#include "search/slit_search.hpp"
#include "search/slit_solver.hpp"
#include "slits/slit_plan.hpp"

namespace seamwire {

using namespace detail;

namespace {

/// All pieces are discs, or discs with holes if `loops` allows for more boundary loops, and chains are joined by real
/// edges between the seams.
void expect_discs(const SlitProblem& problem, const SlitTree& tree, std::size_t loops = 1) {
  const Cut cut = cut_of(problem, tree.slits, tree.roots);
  for (std::int32_t p = 0; p < problem.pieces.count; ++p) {
    const std::optional<Island> island = open_piece(problem, cut, p, {});
    ASSERT_TRUE(island) << "piece " << p;
    EXPECT_EQ(island->boundaries().size(), loops) << "piece " << p;
  }
  for (const Slit& slit : tree.slits) {
    for (const auto* chain : {&slit.path, &slit.image}) {
      for (std::size_t i = 1; i < chain->size(); ++i) {
        const std::int32_t edge = problem.mesh->edge_between((*chain)[i - 1], (*chain)[i]);
        ASSERT_GE(edge, 0);
        EXPECT_EQ(problem.is_seam[edge], 0);
      }
    }
  }
}

double length_of(const SlitProblem& problem, const SlitTree& tree) {
  double sum = 0.0;
  for (const Slit& slit : tree.slits) {
    sum += chain_length(*problem.mesh, slit.path) + chain_length(*problem.mesh, slit.image);
  }
  return sum / problem.mesh->scale;
}

TEST(SlitTree, LengthensASeamOfOneEdge) {
  // Its two sides are an outline of two edges, which has no map.
  const Surface ball = shapes::icosphere(2).surface();
  const Triangle& triangle = ball.triangles()[0];
  const SlitProblem problem = problem_on(ball, {.seams = {Edge{triangle[0], triangle[1]}}});
  for (const bool has_tips : {false, true}) {
    const SlitTree tree = grow_tree(problem, {.has_tips = has_tips, .keeps_holes = has_tips}, {});
    EXPECT_FALSE(tree.slits.empty());
    EXPECT_TRUE(std::isfinite(SlitSolver(problem, tree.roots).solve(tree.slits, {}).energy));
  }
}

TEST(SlitTree, MakesEverySurfaceADisc) {
  const std::vector<Surface> surfaces = {
      shapes::grid(6).surface(),
      shapes::icosphere(2).surface(),
      shapes::cylinder(16, 8).surface(),
      shapes::torus(24, 12).surface(),
      shapes::quad_torus(24, 12).surface(),
      shapes::quad_cube(4).surface(),
      shapes::moebius(20).surface(),
      shapes::plate({"#####", "#.#.#", "#####"}, 2).surface(),
      shapes::plate({"###", "#.#", "###"}, 1).surface(),
      shapes::dumbbell(12, 20).surface(),
      shapes::dumbbell(12, 21).surface(),  // no vertex on the mirror plane
      shapes::without(shapes::icosphere(3),
                      [](const Vector& p) { return std::abs(p.z()) > 0.4 || std::abs(p.x()) > 0.4; })
          .surface(),
  };
  for (const Surface& surface : surfaces) {
    for (const bool has_tips : {true, false}) {
      for (const int mirror : {-1, 0}) {
        SCOPED_TRACE(testing::Message() << "surface " << &surface - surfaces.data() << ", mirror " << mirror);
        const SlitProblem problem = problem_on(surface, {.mirror = mirror});
        expect_discs(problem, grow_tree(problem, {.has_tips = has_tips, .keeps_holes = false}, {}));
      }
    }
  }
}

TEST(SlitTree, MakesTheSmallestBallsDiscs) {
  const Surface tetrahedron({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}});
  const Surface octahedron({{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}},
                           {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4}, {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}});
  for (const Surface& surface : {tetrahedron, octahedron, shapes::quad_cube(1).surface()}) {
    for (const bool has_tips : {true, false}) {
      const SlitProblem problem = problem_on(surface);
      expect_discs(problem, grow_tree(problem, {.has_tips = has_tips, .keeps_holes = false}, {}));
    }
  }
}

TEST(SlitTree, NeedsNothingInADisc) {
  const SlitProblem problem = problem_on(shapes::grid(6).surface());
  EXPECT_TRUE(grow_tree(problem, {.has_tips = false, .keeps_holes = false}, {}).slits.empty());
}

TEST(SlitTree, CutsACylinderAlongItsHeight) {
  const SlitProblem problem = problem_on(shapes::quad_cylinder(16, 8).surface());
  EXPECT_NEAR(length_of(problem, grow_tree(problem, {.has_tips = false, .keeps_holes = false}, {})), 1.0, 1e-9);
}

TEST(SlitTree, OpensATorusAlongItsShortestLoops) {
  const SlitProblem problem = problem_on(shapes::quad_torus(32, 16).surface());
  const double around_tube = 2 * std::numbers::pi * 0.15, around_hole = 2 * std::numbers::pi * 0.2;
  EXPECT_LT(length_of(problem, grow_tree(problem, {.has_tips = false, .keeps_holes = false}, {})),
            1.15 * (around_tube + around_hole));
}

TEST(SlitTree, OpensATorusAlongWholeLinesOfEdges) {
  const SlitProblem problem = problem_on(shapes::quad_torus(32, 16).surface());
  const SlitTree tree = grow_tree(problem, {.has_tips = false, .keeps_holes = true}, {});
  std::map<std::int32_t, std::vector<Vector>> directions;  // of the slits' edges at each vertex
  std::size_t edges = 0;
  for (const Slit& slit : tree.slits) {
    for (std::size_t i = 1; i < slit.path.size(); ++i) {
      const Vector along = problem.mesh->points[slit.path[i]] - problem.mesh->points[slit.path[i - 1]];
      directions[slit.path[i - 1]].push_back(along.normalized());
      directions[slit.path[i]].push_back(-along.normalized());
      ++edges;
    }
  }
  EXPECT_EQ(edges, 48U);
  std::size_t crossings = 0;
  for (const auto& [v, own] : directions) {
    crossings += own.size() == 4 ? 1 : 0;
    if (own.size() == 2) {
      EXPECT_LT(own[0].dot(own[1]), -0.8) << "a turn at vertex " << v;
    } else {
      EXPECT_EQ(own.size(), 4U);
    }
  }
  EXPECT_EQ(crossings, 1U);
}

TEST(SlitTree, KeepsGivenSeamsOutOfItsSlits) {
  // A ring around the tube of one of two handles, and a slit that ends within the surface.
  const shapes::QuadMesh plate = shapes::plate({"#####", "#.#.#", "#####"}, 2);
  const Surface surface = plate.surface();
  std::vector<Edge> seams;
  for (const Edge& edge : surface.edges()) {
    const Vector &a = surface.points()[edge[0]], &b = surface.points()[edge[1]];
    if (std::abs(a.x() - 0.5) + std::abs(b.x() - 0.5) < 1e-9 && std::max(a.y(), b.y()) <= 1.0) seams.push_back(edge);
    if (a.z() == 1.0 && b.z() == 1.0 && std::abs(a.y() - 2.5) + std::abs(b.y() - 2.5) < 1e-9) seams.push_back(edge);
  }
  ASSERT_GT(seams.size(), 8U);
  for (const bool has_tips : {true, false}) {
    const SlitProblem problem = problem_on(surface, {.seams = seams});
    expect_discs(problem, grow_tree(problem, {.has_tips = has_tips, .keeps_holes = false}, {}));
  }
}

TEST(SlitTree, CutsEachOfTwoTubesWithTheSameRims) {
  const Surface surface = shapes::torus(24, 12).surface();
  std::vector<Edge> seams;
  for (std::int32_t v = 0; v < 12; ++v) {
    for (const std::int32_t column : {0, 11}) {
      const std::int32_t next = (v + 1) % 12;
      seams.push_back({24 * v + column, 24 * next + column});
    }
  }
  for (const int mirror : {-1, 1}) {
    const SlitProblem problem = problem_on(surface, {.mirror = mirror, .seams = seams});
    ASSERT_EQ(problem.pieces.count, 2);
    for (const bool has_tips : {true, false})
      expect_discs(problem, grow_tree(problem, {.has_tips = has_tips, .keeps_holes = false}, {}));
  }
}

TEST(SlitTree, CutsATubeWhoseRimsAreOneSeam) {
  const Surface surface = shapes::torus(24, 12).surface();
  std::vector<Edge> seams;
  for (std::int32_t i = 0; i < 24; ++i) seams.push_back({72 + i, 72 + (i + 1) % 24});
  const SlitProblem problem = problem_on(surface, {.seams = seams});
  ASSERT_EQ(problem.pieces.count, 1);
  for (const bool has_tips : {true, false})
    expect_discs(problem, grow_tree(problem, {.has_tips = has_tips, .keeps_holes = false}, {}));
}

TEST(SlitTree, ReachesThousandsOfHolesInAboutOneSearch) {
  constexpr std::int32_t kSide = 160;
  shapes::QuadMesh sieve = shapes::quad_grid(kSide);
  std::int32_t quad = 0;
  std::size_t holes = 0;
  std::erase_if(sieve.quads, [&](const auto&) {
    const std::int32_t column = quad % kSide, row = quad++ / kSide;
    const bool is_hole = column % 3 == 1 && row % 3 == 1;
    holes += is_hole ? 1 : 0;
    return is_hole;
  });
  SlitProblem problem;
  problem.mesh = std::make_shared<const PlanMesh>(plan_mesh(sieve.surface(), {}));
  problem.is_seam.assign(problem.mesh->edge_count(), 0);
  problem.prices.of_edge = problem.mesh->lengths;
  for (std::size_t e = 0; e < problem.mesh->edge_count(); ++e) {
    if (problem.mesh->is_real[e] == 0) problem.prices.of_edge[e] = kInfinity;
  }
  problem.prices.visibility.assign(problem.mesh->vertex_count(), 1.0);
  // Holes stay holes where the surface between them is exposed, and this is looked up for each hole.
  for (const double exposed_from : {2.0, 0.9}) {
    problem.prices.is_exposed.clear();
    for (const Vector& point : problem.mesh->points) {
      problem.prices.is_exposed.push_back(point.x() > exposed_from * problem.mesh->scale ? 1 : 0);
    }
    find_pieces_of(problem, {});
    const SlitTree with_holes = grow_tree(problem, {}, {});
    EXPECT_TRUE(with_holes.slits.empty()) << "flat holes stay";
    expect_discs(problem, with_holes, holes + 1);
    const SlitTree tree = grow_tree(problem, {.has_tips = true, .keeps_holes = false}, {});
    EXPECT_GT(tree.slits.size(), holes / 2);
    if (exposed_from > 1.0) {
      EXPECT_EQ(tree.slits.size(), holes);
      expect_discs(problem, tree);
      EXPECT_LE(length_of(problem, tree), 2.0 * static_cast<double>(holes) / kSide + 1e-9);
    }
  }
}

TEST(SlitTree, CutsTubesAndHandlesEvenIfHolesMayStay) {
  for (const shapes::Mesh& mesh : {shapes::cylinder(16, 8), shapes::cylinder(32, 2, 0.5, 0.1), shapes::torus(24, 12)}) {
    const SlitProblem problem = problem_on(mesh.surface());
    const SlitTree tree = grow_tree(problem, {}, {});
    expect_discs(problem, tree);
    EXPECT_TRUE(std::ranges::none_of(tree.slits, &Slit::is_join));
  }
}

TEST(SlitTree, AnOpenSeamInAnExposedPlaceStaysAHole) {
  // Slits from a seam around half the ball would all begin in the exposed part. The tree grows where the ball is
  // hidden.
  const Surface surface = shapes::icosphere(3).surface();
  std::vector<Edge> seams;
  for (const Edge& edge : surface.edges()) {
    const Vector &a = surface.points()[edge[0]], &b = surface.points()[edge[1]];
    if (std::max(std::abs(a.y()), std::abs(b.y())) < 1e-9 && std::min(a.x(), b.x()) > -1e-9) seams.push_back(edge);
  }
  ASSERT_GE(seams.size(), 8U);
  SlitProblem problem = problem_on(surface, {.seams = seams});
  for (std::size_t v = 0; v < problem.mesh->vertex_count(); ++v) {
    problem.prices.is_exposed[v] = problem.mesh->points[v].x() > -0.1 ? 1 : 0;
    problem.prices.visibility[v] = problem.prices.is_exposed[v] != 0 ? 1.5 : 0.5;
  }
  const SlitTree tree = grow_tree(problem, {.has_tips = true, .keeps_holes = false}, {});
  EXPECT_EQ(tree.roots.size(), 1U);
  EXPECT_FALSE(tree.slits.empty());
  for (const std::int32_t root : tree.roots) EXPECT_EQ(problem.prices.is_exposed[root], 0);
}

TEST(SlitTree, ReachesTips) {
  const SlitProblem problem = problem_on(shapes::dumbbell(12, 24).surface());
  const SlitTree tree = grow_tree(problem, {.has_tips = true, .keeps_holes = false}, {});
  const Cut cut = cut_of(problem, tree.slits, tree.roots);
  for (const double side : {-1.0, 1.0}) {
    double farthest = 0.0;
    for (std::size_t v = 0; v < cut.is_on_cut.size(); ++v) {
      if (cut.is_on_cut[v] != 0)
        farthest = std::max(farthest, side * problem.mesh->points[v].x() / problem.mesh->scale);
    }
    EXPECT_GT(farthest, 0.95);
  }
}

TEST(SlitTree, AvoidsKeepOutAreas) {
  const Surface surface = shapes::dumbbell(12, 24).surface();
  std::vector<double> weights(surface.vertex_count(), 1.0);
  for (std::size_t v = 0; v < weights.size(); ++v) {
    if (surface.points()[v].x() > 0.6) weights[v] = kInfinity;
  }
  const SlitProblem problem = problem_on(surface, {.weights = weights});
  const SlitTree tree = grow_tree(problem, {.has_tips = true, .keeps_holes = false}, {});
  expect_discs(problem, tree);
  for (const Slit& slit : tree.slits) {
    for (const std::int32_t v : slit.path) EXPECT_LE(problem.mesh->points[v].x() / problem.mesh->scale, 0.6);
  }
}

TEST(SlitTree, OpensABallOutsideOfKeepOutAreas) {
  const Surface surface = shapes::icosphere(3).surface();
  std::vector<double> weights;
  for (const Vector& point : surface.points()) weights.push_back(point.z() > -0.2 ? kInfinity : 1.0);
  for (const int mirror : {-1, 0}) {
    const SlitProblem problem = problem_on(surface, {.mirror = mirror, .weights = weights});
    for (const bool has_tips : {true, false})
      expect_discs(problem, grow_tree(problem, {.has_tips = has_tips, .keeps_holes = false}, {}));
  }
}

TEST(PieceBody, CountsHandlesAndLoops) {
  EXPECT_EQ(PieceBody(problem_on(shapes::icosphere(1).surface()), 0, {}).genus(), 0);
  EXPECT_EQ(PieceBody(problem_on(shapes::torus(12, 8).surface()), 0, {}).genus(), 1);
  EXPECT_EQ(PieceBody(problem_on(shapes::plate({"#####", "#.#.#", "#####"}, 1).surface()), 0, {}).genus(), 2);
  const PieceBody tube(problem_on(shapes::cylinder(12, 4).surface()), 0, {});
  EXPECT_EQ(tube.genus(), 0);
  ASSERT_EQ(tube.loops.size(), 2U);
  EXPECT_EQ(tube.loops[0].size(), 12U);
}

TEST(IslandGraph, FindsTipsWhereTheMeanDistanceIsLargest) {
  const SlitProblem problem = problem_on(shapes::dumbbell(16, 32).surface());
  const PieceBody body(problem, 0, {});
  const std::vector<std::int32_t> tips = find_tips(problem, body, body.graph.mean_distances({}));
  ASSERT_EQ(tips.size(), 2U);
  for (const std::int32_t tip : tips) {
    EXPECT_GT(std::abs(problem.mesh->points[tip].x()) / problem.mesh->scale, 0.95);
  }
  const SlitProblem mirrored = problem_on(shapes::dumbbell(16, 32).surface(), {.mirror = 0});
  const PieceBody half(mirrored, 0, {});
  EXPECT_EQ(find_tips(mirrored, half, half.graph.mean_distances({})).size(), 1U) << "one of each pair";
}

TEST(IslandGraph, PeaksStandOut) {
  const SlitProblem problem = problem_on(shapes::grid(8).surface());
  const PieceBody body(problem, 0, {});
  std::vector<double> heights(81, 0.0);
  const auto own = [&](std::int32_t v) {
    return static_cast<std::int32_t>(std::ranges::find(body.island.vertices, v) - body.island.vertices.begin());
  };
  heights[own(20)] = 1.0;
  heights[own(22)] = 0.8;
  heights[own(60)] = 0.3;
  EXPECT_EQ(body.graph.peaks(heights, 0.5), (std::vector<std::int32_t>{own(20), own(22)}));
  heights[own(21)] = 0.5;  // the ridge between both
  EXPECT_EQ(body.graph.peaks(heights, 0.5), (std::vector<std::int32_t>{own(20)}));
  EXPECT_EQ(body.graph.peaks(heights, 0.3), (std::vector<std::int32_t>{own(20), own(22), own(60)}));
}

TEST(DistortionPeaks, AreAwayFromTheCut) {
  const SlitProblem problem = problem_on(shapes::icosphere(3).surface());
  const SlitTree tree = grow_tree(problem, {.has_tips = false, .keeps_holes = false}, {});
  const SlitSolver solver(problem, tree.roots);
  const SlitPlan plan = solver.solve(tree.slits, {});
  const Cut cut = solver.cut(plan.slits);
  std::vector<std::int32_t> on_cut;
  for (std::size_t v = 0; v < cut.is_on_cut.size(); ++v) {
    if (cut.is_on_cut[v] != 0) on_cut.push_back(static_cast<std::int32_t>(v));
  }
  const auto away = [&](std::int32_t v) {
    double least = kInfinity;
    for (const std::int32_t other : on_cut) {
      least = std::min(least, (problem.mesh->points[v] - problem.mesh->points[other]).norm());
    }
    return least;
  };
  const std::vector<std::int32_t> peaks = distortion_peaks(problem, plan, cut.is_on_cut, {});
  ASSERT_FALSE(peaks.empty());
  for (const std::int32_t v : peaks) EXPECT_GT(away(v), 0.03);
  const std::vector<std::int32_t> spread = spread_vertices(problem, cut.is_on_cut, 20, {});
  EXPECT_EQ(spread.size(), 20U);
  EXPECT_EQ(std::set<std::int32_t>(spread.begin(), spread.end()).size(), 20U);
  for (const std::int32_t v : spread) EXPECT_EQ(cut.is_on_cut[v], 0);
}

TEST(SlitSolver, ALongerSlitLowersTheEnergy) {
  const SlitProblem problem = problem_on(shapes::icosphere(3).surface());
  const SlitTree tree = grow_tree(problem, {.has_tips = false, .keeps_holes = false}, {});
  const SlitSolver solver(problem, tree.roots);
  const SlitPlan whole = solver.solve(tree.slits, {});
  ASSERT_TRUE(std::isfinite(whole.energy));
  const std::vector<std::int32_t>& path = tree.slits.front().path;
  const std::optional<Slit> left = shortened(*problem.mesh, tree.slits.front(), 0.6);
  ASSERT_TRUE(left);
  const Slit tail{.path = {std::ranges::find(path, left->path.back()), path.end()}, .image = {}};
  const SlitPlan less = solver.solve({*left}, {});
  EXPECT_GT(less.energy, whole.energy);
  EXPECT_LT(less.price, whole.price);
  const SlitPlan again = solver.extend(less, tail, {});
  EXPECT_EQ(again.slits.size(), 1U);
  EXPECT_NEAR(again.energy, whole.energy, 0.02 * whole.energy);
  EXPECT_NEAR(again.price, whole.price, 1e-12);
  // A tenth of the gain is enough to tell that a slit helps.
  EXPECT_LT(solver.try_out(less, tail, {}).energy, less.energy);
}

TEST(SlitSolver, RelaxesOnlyMapsThatHaveChanged) {
  shapes::Mesh balls = shapes::icosphere(2);
  const auto count = static_cast<std::int32_t>(balls.points.size());
  for (std::int32_t v = 0; v < count; ++v) balls.points.push_back(balls.points[v] + Vector(3, 0, 0));
  for (const auto& [a, b, c] : shapes::icosphere(2).triangles) {
    balls.triangles.push_back({count + a, count + b, count + c});
  }
  const SlitProblem problem = problem_on(balls.surface());
  const SlitTree tree = grow_tree(problem, {.has_tips = false, .keeps_holes = false}, {});
  const SlitSolver solver(problem, tree.roots);
  SlitPlan plan = solver.solve(tree.slits, {});
  RelaxedMaps known;
  const SlitPlan first = solver.relaxed(plan, known, {}), same = solver.relaxed(plan, known, {});
  ASSERT_EQ(first.maps.size(), 2U);
  EXPECT_EQ(same.maps, first.maps);
  EXPECT_EQ(same.energy, first.energy);
  EXPECT_EQ(same.work, 0.0);
  plan.maps[0] = std::make_shared<const PieceMap>(*plan.maps[0]);
  const SlitPlan other = solver.relaxed(plan, known, {});
  EXPECT_NE(other.maps[0], first.maps[0]);
  EXPECT_EQ(other.maps[1], first.maps[1]);
}

TEST(SlitSolver, StopsEarlyWhereTheEnergyIsTooHigh) {
  const SlitProblem problem = problem_on(shapes::icosphere(3).surface());
  const SlitTree tree = grow_tree(problem, {.has_tips = false, .keeps_holes = false}, {});
  const SlitSolver solver(problem, tree.roots);
  const SlitPlan whole = solver.solve(tree.slits, {});
  const std::vector<std::int32_t> pieces = {0};
  const std::optional<Slit> left = shortened(*problem.mesh, tree.slits.front(), 0.5);
  ASSERT_TRUE(left);
  const SlitPlan given_up = solver.solve_changed({*left}, whole, pieces, whole.energy, {});
  EXPECT_GT(given_up.energy, whole.energy);
  const SlitPlan solved = solver.solve_changed({*left}, whole, pieces, 100.0, {});
  EXPECT_TRUE(std::isfinite(solved.energy));
  EXPECT_LT(given_up.work, solved.work);
  EXPECT_EQ(solver.solve({}, {}).energy, kInfinity) << "a closed ball has no map";
}

}  // namespace
}  // namespace seamwire
