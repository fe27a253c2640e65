// SPDX-License-Identifier: GPL-3.0-or-later
#include "seamwire/seams/seam_planner.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <memory>
#include <numbers>
#include <random>
#include <set>
#include <stop_token>
#include <tuple>
#include <utility>
#include <vector>

#include "detail/disjoint_sets.hpp"
#include "seams/cut_pieces.hpp"
#include "shapes.hpp"
#include "thread_sanitizer.hpp"

namespace seamwire {
namespace {

using Chains = std::vector<std::vector<std::int32_t>>;

Edge sorted(std::int32_t a, std::int32_t b) { return {std::min(a, b), std::max(a, b)}; }

std::set<Edge> edges_of(const Chains& chains) {
  std::set<Edge> edges;
  for (const auto& chain : chains) {
    for (std::size_t i = 1; i < chain.size(); ++i) edges.insert(sorted(chain[i - 1], chain[i]));
  }
  return edges;
}

/// Euler characteristics of the pieces of a manifold mesh that edges cut: the corners of the cut mesh are
/// glued one by one, and its vertices and edges counted.
std::multiset<std::int64_t> euler_by_gluing(const std::vector<Triangle>& triangles, const std::set<Edge>& cuts) {
  DisjointSets corners(3 * triangles.size()), faces(triangles.size());
  std::map<Edge, std::vector<std::int32_t>> sides;
  for (std::size_t h = 0; h < 3 * triangles.size(); ++h) {
    const Triangle& t = triangles[h / 3];
    sides[sorted(t[h % 3], t[(h + 1) % 3])].push_back(static_cast<std::int32_t>(h));
  }
  const auto next = [](std::int32_t h) { return h % 3 == 2 ? h - 2 : h + 1; };
  for (const auto& [edge, both] : sides) {
    if (both.size() < 2 || cuts.contains(edge)) continue;
    const auto vertex = [&](std::int32_t h) { return triangles[h / 3][h % 3]; };
    const bool agree = vertex(both[0]) != vertex(both[1]);  // on a side
    corners.join(both[0], agree ? next(both[1]) : both[1]);
    corners.join(next(both[0]), agree ? both[1] : next(both[1]));
    faces.join(both[0] / 3, both[1] / 3);
  }
  std::map<std::int32_t, std::int64_t> euler;
  for (std::int32_t f = 0; f < static_cast<std::int32_t>(triangles.size()); ++f) ++euler[faces.find(f)];
  for (std::int32_t c = 0; c < static_cast<std::int32_t>(3 * triangles.size()); ++c) {
    if (corners.find(c) == c) ++euler[faces.find(c / 3)];
  }
  for (const auto& [edge, both] : sides) {
    const bool is_glued = both.size() == 2 && !cuts.contains(edge);
    --euler[faces.find(both[0] / 3)];
    if (both.size() == 2 && !is_glued) --euler[faces.find(both[1] / 3)];
  }
  std::multiset<std::int64_t> all;
  for (const auto& [piece, characteristic] : euler) all.insert(characteristic);
  return all;
}

Chains chains_of(const SeamPlan& plan) {
  Chains chains;
  for (const PlannedWire& wire : plan.wires) chains.push_back(wire.vertices);
  return chains;
}

void expect_discs(const Surface& surface, const SeamPlan& plan) {
  const std::multiset<std::int64_t> euler = euler_by_gluing(surface.triangles(), edges_of(chains_of(plan)));
  EXPECT_EQ(euler.count(1), euler.size());
  EXPECT_EQ(plan.island_count, euler.size());
  EXPECT_EQ(plan.not_discs, 0U);
  const auto most = std::ranges::max_element(plan.islands);
  EXPECT_EQ(static_cast<std::size_t>(*most) + 1, euler.size());
}

std::shared_ptr<const Surface> shared(Surface surface) { return std::make_shared<const Surface>(std::move(surface)); }

SeamPlannerOptions along_edges() {
  return {.along = Along::kEdges, .strength = {.max_anisotropy = 10.0, .clamp_percentile = 99.0}};
}

/// By how much the normals of each island spread.
std::vector<double> spreads(const Surface& surface, const std::vector<std::int32_t>& islands) {
  std::map<std::int32_t, std::pair<double, Vector>> sums;
  for (std::size_t f = 0; f < surface.face_count(); ++f) {
    const Triangle& t = surface.triangles()[f];
    const Vector &a = surface.points()[t[0]], &b = surface.points()[t[1]], &c = surface.points()[t[2]];
    const Vector normal = (b - a).cross(c - a);
    auto& [area, sum] = sums.try_emplace(islands[f], 0.0, Vector::Zero()).first->second;
    area += normal.norm();
    sum += normal;
  }
  std::vector<double> out;
  for (const auto& [island, sum] : sums) out.push_back(1.0 - sum.second.norm() / sum.first);
  return out;
}

/// A torus whose tube is turned over before it is closed.
Surface klein_bottle(int nu, int nv) {
  shapes::Mesh mesh = shapes::torus(nu, nv);
  const auto turned = [&](std::int32_t v) { return (nv - v / nu) % nv * nu + v % nu; };
  for (std::size_t f = 0; f < mesh.triangles.size(); ++f) {
    Triangle& t = mesh.triangles[f];
    const bool is_last = f / 2 % static_cast<std::size_t>(nu) == static_cast<std::size_t>(nu) - 1;
    for (std::int32_t& v : t) {
      if (is_last && v % nu == 0) v = turned(v);
    }
  }
  return mesh.surface();
}

TEST(SeamPlanner, CutsIntoDiscs) {
  const shapes::QuadMesh cube = shapes::quad_cube(8);
  const std::vector<std::pair<std::shared_ptr<const Surface>, Along>> cases = {
      {shared(cube.surface()), Along::kEdges},
      {shared(shapes::quad_torus(24, 12).surface()), Along::kEdges},
      {shared(shapes::quad_cylinder(16, 12).surface()), Along::kEdges},
      {shared(shapes::bumpy(shapes::icosphere(3), 0.05).surface()), Along::kSurface},
      {shared(shapes::torus(32, 16).surface()), Along::kSurface},
      {shared(shapes::cylinder(24, 16).surface()), Along::kSurface}};
  for (const auto& [surface, along] : cases) {
    SeamPlannerOptions options = along_edges();
    options.along = along;
    const SeamPlan plan = SeamPlanner(surface, options).plan();
    EXPECT_FALSE(plan.wires.empty());
    expect_discs(*surface, plan);
  }
}

double length_of(const std::vector<Vector>& curve) {
  double sum = 0.0;
  for (std::size_t i = 1; i < curve.size(); ++i) sum += (curve[i] - curve[i - 1]).norm();
  return sum;
}

/// The length of a plan's chains.
double length_of(const SeamPlan& plan, const Surface& surface) {
  double length = 0.0;
  for (const PlannedWire& wire : plan.wires) {
    std::vector<Vector> chain;
    for (const std::int32_t v : wire.vertices) chain.push_back(surface.points()[v]);
    length += length_of(chain);
  }
  return length;
}

TEST(SeamPlanner, ACutGraphTakesFewDetoursOverSeeds) {
  const auto torus = shared(shapes::torus(sized(32, 16), sized(16, 8)).surface());
  // Two loops, around the tube and around the hole, and nothing else.
  const double shortest = 2 * std::numbers::pi * (0.15 + 0.2);
  for (const std::size_t seeds : {24, 40, 60, 90}) {
    const SeamPlannerOptions options{.strength = {.max_anisotropy = 1.0}, .seeds = seeds};
    const SeamPlanner planner(torus, options);
    const SeamPlan straight = planner.plan({.max_spread = 1.0});
    const SeamPlan wound = planner.plan({.max_spread = 1.0, .are_straightened = false});
    expect_discs(*torus, straight);
    expect_discs(*torus, wound);
    EXPECT_LT(straight.cost, wound.cost) << seeds << " seeds";
    EXPECT_LT(straight.wires.size(), wound.wires.size()) << seeds << " seeds";
    EXPECT_LT(length_of(straight, *torus), 2.0 * shortest) << seeds << " seeds";
  }
}

TEST(SeamPlanner, WhereNothingIsFollowedOrHiddenAPlanCostsItsLength) {
  const auto cylinder = shared(shapes::cylinder(24, 16).surface());
  const SeamPlannerOptions options{.strength = {.max_anisotropy = 1.0}, .seeds = 2};
  const SeamPlan plan = SeamPlanner(cylinder, options).plan({.max_spread = 1.0});
  ASSERT_FALSE(plan.wires.empty());
  const double length = length_of(plan, *cylinder);
  EXPECT_NEAR(plan.cost, length, 1e-9 * length);
}

TEST(SeamPlanner, ADiscThatIsFlatEnoughNeedsNoSeam) {
  const auto grid = shared(shapes::grid(12).surface());
  EXPECT_TRUE(SeamPlanner(grid).plan().wires.empty());
  // Nor does it where images go together, and none may be taken away without leaving a hole for the moment.
  SeamPlannerOptions options = along_edges();
  for (std::int32_t v = 0; v < 49; ++v) options.images.push_back(v / 7 * 7 + 6 - v % 7);
  EXPECT_TRUE(SeamPlanner(shared(shapes::quad_grid(6).surface()), options).plan().wires.empty());
}

TEST(SeamPlanner, SeedsAreAddedUntilAllPiecesAreDiscs) {
  const auto torus = shared(shapes::torus(32, 16).surface());
  SeamPlannerOptions few{.seeds = 1, .most_seeds = 1};
  EXPECT_GT(SeamPlanner(torus, few).plan().not_discs, 0U);
  few.most_seeds = 120;
  expect_discs(*torus, SeamPlanner(torus, few).plan());
}

TEST(SeamPlanner, NormalsOfIslandsSpreadNoFurtherThanAllowed) {
  const auto sphere = shared(shapes::icosphere(sized(4, 3)).surface());
  const SeamPlanner planner(sphere);
  for (const double most : {0.6, 0.42, 0.2}) {
    const SeamPlan plan = planner.plan({.max_spread = most});
    // Crumbs, and what joins to them, may bend a little more.
    for (const double spread : spreads(*sphere, plan.islands)) EXPECT_LT(spread, most + 0.05);
  }
  EXPECT_LT(planner.plan({.max_spread = 0.6}).island_count, planner.plan({.max_spread = 0.2}).island_count);
}

TEST(SeamPlanner, LimitsOfTrianglesHoldWhereTheyAre) {
  const auto sphere = shared(shapes::icosphere(sized(4, 3)).surface());
  const SeamPlanner planner(sphere);
  std::vector<double> limits(sphere->face_count());
  const auto is_above = [&](std::size_t f) { return sphere->points()[sphere->triangles()[f][0]].z() > 0.1; };
  for (std::size_t f = 0; f < limits.size(); ++f) limits[f] = is_above(f) ? 0.12 : 0.6;
  const SeamPlan plan = planner.plan({.max_spreads = limits});
  std::set<std::int32_t> above, all(plan.islands.begin(), plan.islands.end());
  for (std::size_t f = 0; f < limits.size(); ++f) {
    if (is_above(f)) above.insert(plan.islands[f]);
  }
  EXPECT_GT(2 * above.size(), all.size());
  const std::vector<double> spread = spreads(*sphere, plan.islands);
  for (const std::int32_t island : above) EXPECT_LT(spread[island], 0.12 + 0.05);
}

TEST(SeamPlanner, MakesAsManyIslandsAsAreAskedFor) {
  const auto sphere = shared(shapes::bumpy(shapes::icosphere(sized(4, 3)), 0.03).surface());
  const SeamPlanner planner(sphere);
  for (const std::size_t islands : {1U, 2U, 5U, 9U}) {
    const SeamPlan plan = planner.plan({.islands = islands});
    EXPECT_EQ(plan.island_count, islands);
    expect_discs(*sphere, plan);
  }
}

/// To find more wires within an island of a plan.
SeamPlannerOptions within_island(const Surface& surface, const SeamPlan& plan, std::int32_t island) {
  SeamPlannerOptions options;
  options.density.assign(surface.vertex_count(), 0.0);
  for (std::size_t f = 0; f < surface.face_count(); ++f) {
    if (plan.islands[f] != island) continue;
    for (const std::int32_t v : surface.triangles()[f]) options.density[v] = 1.0;
  }
  for (const PlannedWire& wire : plan.wires) {
    options.seeds_at.insert(options.seeds_at.end(), {wire.from, wire.to});
    for (std::size_t i = 1; i < wire.vertices.size(); ++i) {
      options.seams.push_back({wire.vertices[i - 1], wire.vertices[i]});
    }
  }
  return options;
}

TEST(SeamPlanner, KeptWiresStayAndOnlyWhatIsToBeSmallerIsParted) {
  const auto sphere = shared(shapes::icosphere(sized(4, 3)).surface());
  const SeamPlanner planner(sphere);
  for (const bool may_start_on_others : {true, false}) {
    const SeamLimits wide{.max_spread = 0.6, .may_start_on_others = may_start_on_others};
    const SeamPlan first = planner.plan(wide);
    ASSERT_GT(first.island_count, 1U);
    // The first island is to be parted, by wires between seeds in it.
    SeamLimits narrow = wide;
    narrow.max_spreads.assign(sphere->face_count(), 2.0);
    for (std::size_t f = 0; f < sphere->face_count(); ++f) {
      if (first.islands[f] == 0) narrow.max_spreads[f] = 0.2;
    }
    SeamPlannerOptions within = within_island(*sphere, first, 0);
    within.seeds = 40;
    const SeamPlan second = planner.with(within).plan(narrow, first.wires);
    expect_discs(*sphere, second);
    EXPECT_GT(second.island_count, first.island_count);
    for (const PlannedWire& wire : first.wires) {
      EXPECT_EQ(std::ranges::count(second.wires, wire.vertices, &PlannedWire::vertices), 1);
    }
    std::map<std::int32_t, std::set<std::int32_t>> parts;
    for (std::size_t f = 0; f < sphere->face_count(); ++f) parts[first.islands[f]].insert(second.islands[f]);
    for (const auto& [island, now] : parts) EXPECT_EQ(now.size() > 1, island == 0);
    for (const PlannedWire& wire : second.wires) {
      for (const std::int32_t seed : {wire.from, wire.to}) {
        EXPECT_TRUE(within.density[seed] > 0.0 || std::ranges::count(within.seeds_at, seed) > 0);
      }
      if (std::ranges::count(first.wires, wire.vertices, &PlannedWire::vertices) > 0) continue;
      for (const std::int32_t v : wire.vertices) EXPECT_GT(within.density[v], 0.0);
    }
  }
}

TEST(SeamPlanner, APlanIsStraightenedAfterwardsAsAtItsEnd) {
  const auto surface = shared(shapes::bumpy(shapes::torus(sized(48, 36), sized(24, 18)), 0.05, 3).surface());
  const SeamPlanner planner(surface);
  for (const bool may_start_on_others : {true, false}) {
    SeamLimits limits{.max_spread = 0.3, .may_start_on_others = may_start_on_others};
    const SeamPlan at_once = planner.plan(limits);
    limits.are_straightened = false;
    const SeamPlan before = planner.plan(limits);
    const SeamPlan after = planner.straightened(before.wires, limits);
    EXPECT_LT(after.cost, 0.95 * before.cost);
    EXPECT_NEAR(after.cost, at_once.cost, 1e-9 * after.cost);
    EXPECT_EQ(after.islands, at_once.islands);
    expect_discs(*surface, after);
    std::vector<std::int32_t> seeds;
    for (const PlannedWire& wire : before.wires) seeds.insert(seeds.end(), {wire.from, wire.to});
    const SeamPlan same = planner.straightened(before.wires, limits, seeds);
    EXPECT_EQ(same.islands, before.islands);
    EXPECT_NEAR(same.cost, before.cost, 1e-9 * before.cost);
  }
}

TEST(SeamPlanner, WithOtherSeedsIsAsOneMadeAnew) {
  const auto surface = shared(shapes::bumpy(shapes::icosphere(sized(3, 2)), 0.05).surface());
  const SeamPlanner planner(surface);
  const SeamPlannerOptions more{.seeds = 60};
  const SeamPlan plan = planner.with(more).plan(), anew = SeamPlanner(surface, more).plan();
  EXPECT_NE(plan.cost, planner.plan().cost);
  EXPECT_EQ(plan.islands, anew.islands);
  EXPECT_EQ(plan.cost, anew.cost);
  EXPECT_THROW(planner.with({.along = Along::kEdges}), InvalidInput);
  EXPECT_THROW(planner.with({.strength = {.max_anisotropy = 5.0}}), InvalidInput);
  EXPECT_THROW(planner.with({.seeds = 0}), InvalidInput);
}

TEST(SeamPlanner, PiecesThatAreCrumbsBesideAnIslandJoinIt) {
  const auto sphere = shared(shapes::icosphere(sized(4, 3)).surface());
  const SeamPlanner planner(sphere, {.seeds = 200, .most_seeds = 200});
  const auto islands = [&](double crumb, double crumb_of_island) {
    const SeamLimits limits{
        .max_spread = 0.01, .crumb = crumb, .crumb_of_island = crumb_of_island, .may_start_on_others = false};
    return planner.plan(limits).island_count;
  };
  // Islands have half a percent of the sphere.
  EXPECT_GT(islands(0.0, 1.0), 100U);
  EXPECT_LT(islands(0.02, 1.0), 40U);
  EXPECT_EQ(islands(0.02, 0.0), islands(0.0, 1.0));
}

TEST(SeamPlanner, WhereSmallIslandsArePartedOneBelowACrumbIsToo) {
  const auto surface = shared(shapes::bumpy(shapes::icosphere(sized(4, 3)), 0.05, 4).surface());
  const SeamPlanner planner(surface);
  const SeamPlan first = planner.plan({.max_spread = 0.4, .are_straightened = false});
  const std::vector<double> own = spreads(*surface, first.islands);
  for (std::int32_t island = 0; island < static_cast<std::int32_t>(first.island_count); ++island) {
    SeamPlannerOptions within = within_island(*surface, first, island);
    within.seeds = 30;
    SeamLimits narrow{.crumb = 0.5, .crumb_of_island = 0.1, .are_straightened = false};
    for (const std::int32_t of : first.islands) narrow.max_spreads.push_back(of == island ? 0.8 * own[of] : 2.0);
    EXPECT_GT(planner.with(within).plan(narrow, first.wires).island_count, first.island_count) << island;
  }
}

TEST(SeamPlanner, SeedsAreAsDenseAsAskedFor) {
  const auto sphere = shared(shapes::icosphere(sized(4, 3)).surface());
  SeamPlannerOptions options{.seeds = 60, .most_seeds = 60};
  const auto above = [&](const SeamPlannerOptions& with) {
    std::set<std::int32_t> all, upper;
    for (const PlannedWire& wire : SeamPlanner(sphere, with).plan({.max_spread = 0.0, .crumb = 0.0}).wires) {
      for (const std::int32_t seed : {wire.from, wire.to}) {
        all.insert(seed);
        if (sphere->points()[seed].z() > 0.0) upper.insert(seed);
      }
    }
    return static_cast<double>(upper.size()) / static_cast<double>(all.size());
  };
  EXPECT_NEAR(above(options), 0.5, 0.1);
  for (const Vector& point : sphere->points()) options.density.push_back(point.z() > 0.0 ? 4.0 : 1.0);
  EXPECT_NEAR(above(options), 0.8, 0.1);
}

TEST(SeamPlanner, WiresAreThoseThatLiveWireShows) {
  const auto surface = shared(shapes::bumpy(shapes::icosphere(3), 0.05).surface());
  for (const Along along : {Along::kSurface, Along::kEdges}) {
    SeamPlannerOptions options = along_edges();
    options.along = along;
    LiveWire live(surface, {.along = along, .strength = options.strength});
    std::size_t compared = 0;
    for (const PlannedWire& wire : SeamPlanner(surface, options).plan().wires) {
      live.seed({wire.from});
      live.wait();
      const LiveWires found = live.wires({wire.to});
      const LiveCandidate& shown = found.wires[found.wires[1].length < found.wires[0].length ? 1 : 0];
      EXPECT_EQ(wire.follow, shown.follow);
      EXPECT_EQ(wire.vertices, shown.vertices);
      EXPECT_EQ(wire.points, shown.points);
      ++compared;
    }
    EXPECT_GT(compared, 5U);
  }
}

TEST(SeamPlanner, WiresMeetAtSeedsAloneWhereTheyMayNotStartOnOthers) {
  for (const auto& surface :
       {shared(shapes::bumpy(shapes::icosphere(3), 0.05).surface()), shared(shapes::torus(32, 16).surface())}) {
    const SeamPlan plan = SeamPlanner(surface).plan({.may_start_on_others = false});
    expect_discs(*surface, plan);
    std::map<std::int32_t, std::vector<const PlannedWire*>> through;
    for (const PlannedWire& wire : plan.wires) {
      for (const std::int32_t v : wire.vertices) through[v].push_back(&wire);
    }
    for (const auto& [v, wires] : through) {
      for (const PlannedWire* one : wires) {
        // Those that leave a seed along the same edges at first have it in common.
        const bool has_common_seed = std::ranges::all_of(wires, [&](const PlannedWire* other) {
          return other->from == one->from || other->to == one->to || other->from == one->to || other->to == one->from;
        });
        EXPECT_TRUE(has_common_seed);
      }
    }
  }
}

TEST(SeamPlanner, GoesOnFromSeamsThatAreThere) {
  // A cube whose lid is cut off already.
  const auto cube = shared(shapes::quad_cube(8).surface());
  SeamPlannerOptions options = along_edges();
  const auto height = [&](std::int32_t v) { return cube->points()[v].z(); };
  const auto is_side = [&](std::int32_t v) {
    const Vector& p = cube->points()[v];
    return std::min({p.x(), p.y(), 1.0 - p.x(), 1.0 - p.y()}) < 1e-9;
  };
  for (const auto& [a, b] : cube->edges()) {
    if (height(a) > 0.99 && height(b) > 0.99 && is_side(a) && is_side(b)) options.seams.push_back({a, b});
  }
  ASSERT_EQ(options.seams.size(), 32U);
  const SeamPlanner planner(cube, options);
  const SeamPlan plan = planner.plan();
  Chains chains = chains_of(plan);
  for (const auto& [a, b] : options.seams) chains.push_back({a, b});
  const std::multiset<std::int64_t> euler = euler_by_gluing(cube->triangles(), edges_of(chains));
  EXPECT_EQ(euler.count(1), euler.size());
  EXPECT_EQ(plan.island_count, euler.size());
  // The lid is flat: no wire crosses it, and no island is on both sides of its border.
  std::set<std::int32_t> lid, rest;
  for (std::size_t f = 0; f < cube->face_count(); ++f) {
    const auto is_high = [&](std::int32_t v) { return height(v) > 0.99; };
    (std::ranges::all_of(cube->triangles()[f], is_high) ? lid : rest).insert(plan.islands[f]);
  }
  EXPECT_EQ(lid.size(), 1U);
  EXPECT_FALSE(rest.contains(*lid.begin()));
  options.seams = {{0, 1000000}};
  EXPECT_THROW(SeamPlanner(cube, options), InvalidInput);
}

/// A cube with bumps that are the same on both sides of x = 0.
struct SymmetricCube {
  SymmetricCube() {
    shapes::QuadMesh mesh = shapes::quad_cube(10);
    for (Vector& p : mesh.points) p -= Vector::Constant(0.5);
    for (Vector& p : mesh.points) p *= 1.0 + 0.2 * std::abs(p.x()) + 0.1 * p.y() * p.z();
    for (const Vector& p : mesh.points) {
      const Vector mirrored(-p.x(), p.y(), p.z());
      const auto image =
          std::ranges::min_element(mesh.points, {}, [&](const Vector& q) { return (q - mirrored).squaredNorm(); });
      options.images.push_back(static_cast<std::int32_t>(image - mesh.points.begin()));
    }
    surface = shared(mesh.surface());
  }

  SeamPlannerOptions options = along_edges();
  std::shared_ptr<const Surface> surface;
};

TEST(SeamPlanner, MirrorImagesGoTogether) {
  const SymmetricCube cube;
  const std::vector<std::int32_t>& images = cube.options.images;
  const SeamPlan plan = SeamPlanner(cube.surface, cube.options).plan();
  std::multiset<Edge> ends, mirrored;
  for (const PlannedWire& wire : plan.wires) {
    ends.insert(sorted(wire.from, wire.to));
    mirrored.insert(sorted(images[wire.from], images[wire.to]));
  }
  EXPECT_EQ(ends, mirrored);
  EXPECT_GT(ends.size(), 4U);
}

TEST(SeamPlanner, OnASymmetricSurfaceWhatRunsAsAKeptWireDoesGoes) {
  const SymmetricCube cube;
  const SeamPlanner planner(cube.surface, cube.options);
  const SeamPlan plan = planner.plan();
  const SeamPlan again = planner.plan({}, plan.wires);
  EXPECT_EQ(again.wires.size(), plan.wires.size());
  EXPECT_NEAR(again.cost, plan.cost, 1e-9 * plan.cost);
}

/// The part of the vertices of a bumpy sphere's seams that lie in its lower half.
double below(const shapes::Mesh& mesh, std::size_t sphere_vertices) {
  const auto surface = shared(mesh.surface());
  double low = 0.0, all = 0.0;
  for (const PlannedWire& wire : SeamPlanner(surface).plan({.max_spread = 0.6}).wires) {
    for (const std::int32_t v : wire.vertices) {
      if (static_cast<std::size_t>(v) >= sphere_vertices) continue;
      low += surface->points()[v].z() < 0.0 ? 1.0 : 0.0;
      ++all;
    }
  }
  return low / all;
}

TEST(SeamPlanner, PrefersWhatIsOutOfSight) {
  // A sphere in a bowl that hides its lower half, or under one that hides the upper half.
  const shapes::Mesh sphere = shapes::bumpy(shapes::icosphere(4), 0.01);
  const auto in_bowl = [&](double side) {
    const shapes::Mesh bowl =
        shapes::without(shapes::icosphere(4, 0.6), [side](const Vector& p) { return side * p.z() < 0.0; });
    shapes::Mesh both = sphere;
    const auto count = static_cast<std::int32_t>(sphere.points.size());
    both.points.insert(both.points.end(), bowl.points.begin(), bowl.points.end());
    for (const Triangle& t : bowl.triangles) both.triangles.push_back({t[0] + count, t[1] + count, t[2] + count});
    return below(both, sphere.points.size());
  };
  EXPECT_GT(in_bowl(-1.0), in_bowl(1.0) + 0.1);
}

TEST(SeamPlanner, WhereNoSeedMayBeNothingIsCutAndTheRestIs) {
  // Two spheres; the larger one, which is no disc either, is left alone.
  shapes::Mesh both = shapes::icosphere(3);
  const std::size_t large = both.points.size();
  const shapes::Mesh small = shapes::torus(24, 12);
  for (Vector& p : both.points) p *= 4.0;
  for (const Vector& p : small.points) both.points.emplace_back(p + Vector(20.0, 0.0, 0.0));
  for (Triangle t : small.triangles) {
    for (std::int32_t& v : t) v += static_cast<std::int32_t>(large);
    both.triangles.push_back(t);
  }
  const auto surface = shared(both.surface());
  SeamPlannerOptions options;
  options.density.assign(both.points.size(), 1.0);
  std::fill_n(options.density.begin(), large, 0.0);
  options.seeds = 1;
  const SeamPlan plan = SeamPlanner(surface, options).plan({.max_spread = 2.0});
  EXPECT_EQ(plan.not_discs, 1U) << "the sphere";
  EXPECT_FALSE(plan.wires.empty());
  for (const PlannedWire& wire : plan.wires) {
    for (const std::int32_t v : wire.vertices) EXPECT_GE(v, static_cast<std::int32_t>(large));
  }
}

TEST(SeamPlanner, ComponentsAndWhatIsOddAreCutToo) {
  // Two spheres, a loose edge, a vertex of nothing, a face without an area, an edge of three faces.
  shapes::Mesh mesh = shapes::icosphere(2);
  const auto count = static_cast<std::int32_t>(mesh.points.size());
  for (std::int32_t v = 0; v < count; ++v) mesh.points.push_back(mesh.points[v] + Vector(2.0, 0.0, 0.0));
  const std::size_t faces = mesh.triangles.size();
  for (std::size_t f = 0; f < faces; ++f) {
    const Triangle t = mesh.triangles[f];
    mesh.triangles.push_back({t[0] + count, t[1] + count, t[2] + count});
  }
  mesh.points.emplace_back(0.0, 0.0, 2.0);
  mesh.points.emplace_back(0.0, 0.0, 3.0);
  mesh.triangles.push_back({mesh.triangles[0][0], mesh.triangles[0][1], 2 * count});
  mesh.triangles.push_back({mesh.triangles[1][0], mesh.triangles[1][0], mesh.triangles[1][1]});
  const auto surface = shared(mesh.surface());
  const SeamPlan plan = SeamPlanner(surface).plan();
  EXPECT_EQ(plan.not_discs, 0U);
  EXPECT_EQ(plan.islands.size(), mesh.triangles.size());
}

TEST(SeamPlanner, OneSidedSurfacesAreCutToo) {
  for (const Along along : {Along::kEdges, Along::kSurface}) {
    for (const auto& surface : {shared(shapes::moebius(40).surface()), shared(klein_bottle(20, 12))}) {
      const SeamPlan plan = SeamPlanner(surface, {.along = along}).plan({.max_spread = 2.0});
      expect_discs(*surface, plan);
      EXPECT_FALSE(plan.wires.empty());
    }
  }
}

TEST(SeamPlanner, ThePlanDoesNotDependOnTheModelsSize) {
  const shapes::Mesh torus = shapes::torus(24, 16);
  const auto islands = [&](double size) {
    shapes::Mesh mesh = torus;
    for (Vector& p : mesh.points) p *= size;
    const SeamPlanner planner(shared(mesh.surface()), along_edges());
    return std::pair(planner.plan({.max_spread = 0.1}).islands, planner.plan({.max_spread = 0.5}).islands);
  };
  const auto expected = islands(1.0);
  EXPECT_NE(expected.first, expected.second);
  for (const double size : {0x1p-450, 0x1p-300, 0x1p300, 0x1p450}) EXPECT_EQ(islands(size), expected) << size;
}

TEST(SeamPlanner, IsCancelled) {
  const auto sphere = shared(shapes::icosphere(4).surface());
  std::size_t calls = 0;
  const Task never{.stop = {}, .progress = [&](double) { return ++calls < 2; }};
  EXPECT_THROW(SeamPlanner(sphere, {}, never), Cancelled);
  const SeamPlanner planner(sphere);
  EXPECT_THROW(planner.plan({}, {}, {.stop = {}, .progress = [](double) { return false; }}), Cancelled);
  std::stop_source stop;
  stop.request_stop();
  EXPECT_THROW(SeamPlanner(sphere, {}, {.stop = stop.get_token(), .progress = {}}), Cancelled);
}

TEST(SeamPlanner, RefusesWhatMakesNoSense) {
  const auto sphere = shared(shapes::icosphere(1).surface());
  EXPECT_THROW(SeamPlanner(nullptr), InvalidInput);
  EXPECT_THROW(SeamPlanner(sphere, {.strength = {.max_anisotropy = 0.5}}), InvalidInput);
  EXPECT_THROW(SeamPlanner(sphere, {.seeds = 0}), InvalidInput);
  EXPECT_THROW(SeamPlanner(sphere, {.seeds = 5, .most_seeds = 4}), InvalidInput);
  EXPECT_THROW(SeamPlanner(sphere, {.images = std::vector<std::int32_t>(sphere->vertex_count() + 1)}), InvalidInput);
  EXPECT_THROW(SeamPlanner(sphere, {.images = std::vector<std::int32_t>(sphere->vertex_count(), 1000)}), InvalidInput);
  EXPECT_THROW(SeamPlanner(sphere, {.seeds_at = {-1}}), InvalidInput);
  EXPECT_THROW(SeamPlanner(sphere, {.density = {1.0}}), InvalidInput);
  EXPECT_THROW(SeamPlanner(sphere, {.density = std::vector<double>(sphere->vertex_count(), -1.0)}), InvalidInput);
  const SeamPlanner planner(sphere);
  EXPECT_THROW(planner.plan({.max_spread = -0.1}), InvalidInput);
  EXPECT_THROW(planner.plan({.crumb = -0.1}), InvalidInput);
  EXPECT_THROW(planner.plan({.crumb_of_island = std::nan("")}), InvalidInput);
  std::vector<PlannedWire> kept(1);
  kept[0].vertices = {0, 1000};
  EXPECT_THROW(planner.plan({}, kept), InvalidInput);
  EXPECT_THROW(planner.straightened(kept), InvalidInput);
  const shapes::Mesh same = shapes::icosphere(2);
  shapes::Mesh larger = same;
  for (Vector& p : larger.points) p *= 2.0;
  for (const Along along : {Along::kEdges, Along::kSurface}) {
    const SeamPlanner own(shared(same.surface()), {.along = along}), other(shared(larger.surface()), {.along = along});
    const SeamPlan plan = own.plan({.max_spread = 0.2});
    ASSERT_FALSE(plan.wires.empty());
    EXPECT_NO_THROW(own.plan({}, plan.wires));
    for (const SeamPlanner* another : {&planner, &other}) {
      EXPECT_THROW(another->plan({}, plan.wires), InvalidInput);
      EXPECT_THROW(another->straightened(plan.wires, {.may_start_on_others = false}), InvalidInput);
    }
    for (const auto& spoil : std::vector<void (*)(PlannedWire&)>{
             [](PlannedWire& w) { w.vertices.clear(); }, [](PlannedWire& w) { w.from = w.to; },
             [](PlannedWire& w) { w.vertices.insert(w.vertices.begin() + 1, w.vertices[0]); },
             [](PlannedWire& w) { w.points.pop_back(); }, [](PlannedWire& w) { w.worth = 0.0; },
             [](PlannedWire& w) { w.faces.push_back(1000); }, [](PlannedWire& w) { w.points[0].x() = NAN; }}) {
      std::vector<PlannedWire> wrong = plan.wires;
      spoil(wrong[0]);
      EXPECT_THROW(own.plan({}, wrong), InvalidInput);
      EXPECT_THROW(own.straightened(wrong), InvalidInput);
    }
  }
  std::vector<std::int32_t> around(sphere->vertex_count());
  for (std::size_t v = 0; v < around.size(); ++v) around[v] = static_cast<std::int32_t>((v + 1) % around.size());
  EXPECT_THROW(SeamPlanner(sphere, {.images = around}), InvalidInput) << "three images lead elsewhere than one";
  EXPECT_THROW(planner.straightened({}, {.crumb = 2.0}), InvalidInput);
  EXPECT_THROW(planner.straightened({}, {}, std::vector<std::int32_t>{1000}), InvalidInput);
  EXPECT_THROW(planner.plan({.max_spread = std::nan("")}), InvalidInput);
  EXPECT_THROW(planner.plan({.max_spreads = std::vector<double>(1, 0.1)}), InvalidInput);
  EXPECT_THROW(planner.plan({.max_spreads = std::vector<double>(sphere->face_count(), -1.0)}), InvalidInput);
}

/// Random walks along the edges of a mesh.
Chains random_chains(const Surface& surface, std::size_t count, std::mt19937& random) {
  std::vector<std::vector<std::int32_t>> around(surface.vertex_count());
  for (const auto& [a, b] : surface.edges()) {
    around[a].push_back(b);
    around[b].push_back(a);
  }
  Chains chains(count);
  for (auto& chain : chains) {
    chain.push_back(static_cast<std::int32_t>(random() % around.size()));
    for (std::size_t i = random() % 40; i > 0; --i) {
      const auto& next = around[chain.back()];
      chain.push_back(next[random() % next.size()]);
    }
  }
  return chains;
}

TEST(CutPieces, TakingChainsAwayIsAsCuttingWithoutThem) {
  std::mt19937 random(1);
  const std::array surfaces = {shapes::torus(10, 8).surface(), shapes::icosphere(2).surface(),
                               shapes::grid(8).surface(), klein_bottle(10, 8), shapes::moebius(12).surface()};
  for (int round = 0; round < 60; ++round) {
    const Surface& surface = surfaces[round % surfaces.size()];
    const std::vector<double> limits(surface.face_count(), 0.5);
    Chains chains = random_chains(surface, 12, random);
    CutPieces pieces(surface, chains, limits);
    for (std::int32_t i = 0; i < 12; ++i) {
      const std::size_t before = pieces.piece_count();
      const auto cost = [&](std::int32_t k) {
        std::vector<std::tuple<std::size_t, std::int64_t, double>> all;
        for (const auto& one : pieces.joined_without(k)) all.emplace_back(one.pieces, one.piece.euler, one.piece.area);
        return all;
      };
      std::vector<decltype(cost(0))> costs;
      for (std::int32_t k = 0; k < 12; ++k) costs.push_back(cost(k));
      const auto joined = pieces.remove(i);
      std::size_t fewer = 0;
      for (const auto& one : joined) fewer += one.pieces - 1;
      for (std::int32_t k = i + 1; k < 12; ++k) {
        const bool is_same = cost(k) == costs[k];
        ASSERT_TRUE(is_same || pieces.touches(k, i, joined));
      }
      chains[i].clear();
      const CutPieces anew(surface, chains, limits);
      ASSERT_EQ(pieces.piece_count(), anew.piece_count());
      ASSERT_EQ(before - pieces.piece_count(), fewer);
      const std::multiset<std::int64_t> wanted = euler_by_gluing(surface.triangles(), edges_of(chains));
      std::multiset<std::int64_t> found;
      for (const Piece& piece : anew.pieces()) found.insert(piece.euler);
      ASSERT_EQ(found, wanted);
      found.clear();
      for (const Piece& piece : pieces.pieces()) found.insert(piece.euler);
      ASSERT_EQ(found, wanted);
      const auto sums = [](const CutPieces& of) {
        std::vector<std::pair<std::int64_t, double>> all;
        for (const Piece& piece : of.pieces()) all.emplace_back(piece.border, piece.is_disc() ? piece.spread() : 0.0);
        std::ranges::sort(all);
        return all;
      };
      const auto one = sums(pieces), other = sums(anew);
      for (std::size_t p = 0; p < one.size(); ++p) {
        ASSERT_EQ(one[p].first, other[p].first);
        ASSERT_NEAR(one[p].second, other[p].second, 1e-9) << "normals of a disc do not depend on how it came about";
      }
    }
  }
}

TEST(CutPieces, NormalsOfADiscOfAOneSidedSurfaceAllFaceTheSameSide) {
  // Cut across opposite to the edge where its faces do not agree: half of the faces have to be turned over.
  const Surface strip = shapes::moebius(40).surface();
  const CutPieces pieces(strip, std::vector<std::vector<std::int32_t>>{{40, 41}},
                         std::vector<double>(strip.face_count(), 1.0));
  ASSERT_EQ(pieces.pieces().size(), 1U);
  ASSERT_TRUE(pieces.pieces()[0].is_disc());
  // Carried along the strip, the normal at t is (sin(t/2) cos t, sin(t/2) sin t, -cos(t/2)), t from pi to 3 pi.
  Vector sum = Vector::Zero();
  for (int i = 0; i < 4000; ++i) {
    const double t = std::numbers::pi * (1.0 + 2.0 * (i + 0.5) / 4000);
    sum += Vector(std::sin(t / 2) * std::cos(t), std::sin(t / 2) * std::sin(t), -std::cos(t / 2)) / 4000;
  }
  EXPECT_NEAR(pieces.pieces()[0].spread(), 1.0 - sum.norm(), 0.03);  // its width is a fifth of its radius
}

}  // namespace
}  // namespace seamwire
