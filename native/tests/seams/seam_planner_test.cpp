// SPDX-License-Identifier: GPL-3.0-or-later
#include "seamwire_uv/seams/seam_planner.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <cmath>
#include <ctime>
#include <functional>
#include <limits>
#include <map>
#include <memory>
#include <numbers>
#include <optional>
#include <random>
#include <set>
#include <stop_token>
#include <thread>
#include <utility>
#include <vector>

#include "detail/index.hpp"
#include "seam_problems.hpp"
#include "seamwire/surface/segments.hpp"
#include "seamwire_uv/maps/flatten.hpp"
#include "seamwire_uv/parts/part_finder.hpp"
#include "seamwire_uv/seams/missing_cuts.hpp"
#include "thread_sanitizer.hpp"

namespace seamwire {

using namespace detail;

namespace {

constexpr double kAnything = std::numeric_limits<double>::infinity();
using Surfaces = std::vector<std::shared_ptr<const Surface>>;

std::shared_ptr<const Surface> shared(Surface surface) { return std::make_shared<const Surface>(std::move(surface)); }
std::shared_ptr<const Surface> shared(const shapes::Mesh& mesh) { return shared(mesh.surface()); }
std::shared_ptr<const Surface> shared(const shapes::QuadMesh& mesh) { return shared(mesh.surface()); }

SeamPlannerOptions along_edges(int mirror = -1) { return {.along = Along::kEdges, .mirror = mirror}; }

Edge sorted(std::int32_t a, std::int32_t b) { return {std::min(a, b), std::max(a, b)}; }

std::set<Edge> edges_of(const SeamPlan& plan) {
  std::set<Edge> edges;
  for (const PlannedWire& wire : plan.wires) {
    for (std::size_t i = 1; i < wire.vertices.size(); ++i) edges.insert(sorted(wire.vertices[i - 1], wire.vertices[i]));
  }
  return edges;
}

double length_of(const Surface& surface, const SeamPlan& plan) {
  double sum = 0.0;
  for (const auto& [a, b] : edges_of(plan)) sum += (surface.points()[a] - surface.points()[b]).norm();
  return sum;
}

/// Adds a mesh to another one.
void add(shapes::Mesh& mesh, const shapes::Mesh& other, const Vector& by) {
  const auto first = static_cast<std::int32_t>(mesh.points.size());
  for (const Vector& point : other.points) mesh.points.push_back(point + by);
  for (const auto& [a, b, c] : other.triangles) mesh.triangles.push_back({first + a, first + b, first + c});
}

/// Boxes apart from each other, with the sides that `sides` gives for each number.
template <class Sides>
shapes::QuadMesh boxes(int count, const Sides& sides) {
  const shapes::QuadMesh cube = shapes::quad_cube(1);
  shapes::QuadMesh all;
  for (int i = 0; i < count; ++i) {
    const auto first = static_cast<std::int32_t>(all.points.size());
    const Vector own = sides(i);
    for (const Vector& point : cube.points) all.points.push_back(point.cwiseProduct(own) + Vector(3.0 * i, 0, 0));
    for (auto quad : cube.quads) {
      for (std::int32_t& v : quad) v += first;
      all.quads.push_back(quad);
    }
  }
  return all;
}

/// How many seams of a plan lie in each of several copies of a mesh.
std::vector<std::size_t> seams_by_copy(const SeamPlan& plan, std::size_t vertices, std::size_t copies) {
  std::vector<std::size_t> counts(copies, 0);
  for (const Edge& edge : edges_of(plan)) ++counts[static_cast<std::size_t>(edge[0]) / vertices];
  return counts;
}

/// Triangles agree on the UVs of an edge that they share, unless a wire or a seam runs along it.
void expect_cut_along_wires(const Surface& surface, const SeamPlan& plan) {
  const std::set<Edge> cuts = edges_of(plan);
  std::map<Edge, std::array<Eigen::Vector2d, 2>> seen;
  std::size_t torn = 0;
  for (std::size_t f = 0; f < surface.face_count(); ++f) {
    const Triangle& t = surface.triangles()[f];
    for (std::size_t i = 0; i < 3; ++i) {
      std::array<Eigen::Vector2d, 2> ends = {plan.uvs[f][i], plan.uvs[f][(i + 1) % 3]};
      if (t[i] > t[(i + 1) % 3]) std::swap(ends[0], ends[1]);
      const Edge edge = sorted(t[i], t[(i + 1) % 3]);
      const auto [first, is_new] = seen.emplace(edge, ends);
      if (!is_new && !cuts.contains(edge) && first->second != ends) ++torn;
    }
  }
  EXPECT_EQ(torn, 0U) << "edges that are cut in the map only";
}

/// What holds for every plan.
void expect_sound(const Surface& surface, const SeamPlan& plan, const std::vector<Edge>& seams = {}) {
  std::vector<Edge> cuts = seams;
  for (const Edge& edge : edges_of(plan)) {
    EXPECT_TRUE(std::ranges::binary_search(surface.edges(), edge)) << "seams run along real edges";
    cuts.push_back(edge);
  }
  EXPECT_EQ(plan.islands, face_segments(surface, cuts));
  const std::vector<std::int32_t> missing = missing_cuts(surface, cuts, plan.islands);
  EXPECT_EQ(plan.island_count, missing.size());
  EXPECT_EQ(plan.islands_to_cut,
            static_cast<std::size_t>(std::ranges::count_if(missing, [](auto m) { return m > 0; })));
  EXPECT_GE(plan.cost, 0.0);
  for (const PlannedWire& wire : plan.wires) {
    ASSERT_GE(wire.vertices.size(), 2U);
    EXPECT_EQ(wire.from, wire.vertices.front());
    EXPECT_EQ(wire.to, wire.vertices.back());
    ASSERT_GE(wire.points.size(), 2U);
    EXPECT_EQ(wire.points.front(), surface.points()[static_cast<std::size_t>(wire.from)]);
    EXPECT_EQ(wire.points.back(), surface.points()[static_cast<std::size_t>(wire.to)]);
    EXPECT_TRUE(wire.faces.empty() || wire.faces.size() + 1 == wire.points.size());
  }
}

/// No island needs another cut.
void expect_discs(const Surface& surface, const SeamPlan& plan, const std::vector<Edge>& seams = {}) {
  expect_sound(surface, plan, seams);
  EXPECT_EQ(plan.islands_to_cut, 0U);
}

/// The planned map is as good as the plan says.
void expect_map(const Surface& surface, const SeamPlan& plan) {
  ASSERT_EQ(plan.uvs.size(), surface.face_count());
  const MapReport report = measure_map(surface, plan.uvs, plan.islands);
  EXPECT_TRUE(report.flipped.empty());
  EXPECT_TRUE(report.overlapping.empty());
  EXPECT_NEAR(report.energy, plan.energy, 1e-9 * plan.energy);
}

TEST(SeamPlanner, APlaneNeedsNoSeam) {
  for (const auto& surface : {shared(shapes::grid(8)), shared(shapes::quad_grid(8))}) {
    for (const double distortion : {4.001, kAnything}) {
      const SeamPlan plan = SeamPlanner(surface, along_edges()).plan({.distortion = distortion});
      EXPECT_TRUE(plan.wires.empty());
      EXPECT_TRUE(plan.is_reached);
      EXPECT_NEAR(plan.energy, 4.0, 1e-6);
      EXPECT_EQ(plan.cost, 0.0);
      expect_discs(*surface, plan);
      expect_map(*surface, plan);
    }
  }
}

/// A square plate of `side` x `side` quads with holes of 2 x 2 quads, `count` in each row and column.
shapes::QuadMesh plate_with_holes(int count) {
  const int side = 4 * count;
  shapes::QuadMesh plate = shapes::quad_grid(side);
  int quad = 0;
  std::erase_if(plate.quads, [&](const auto&) {
    const int column = quad % side, row = quad++ / side;
    return (column % 4 == 1 || column % 4 == 2) && (row % 4 == 1 || row % 4 == 2);
  });
  return plate;
}

TEST(SeamPlanner, APlateKeepsItsHoles) {
  for (const int count : {1, 2, sized(22, 6)}) {
    const auto surface = shared(plate_with_holes(count));
    for (const int mirror : {-1, 0}) {
      const SeamPlan plan = SeamPlanner(surface, along_edges(mirror)).plan({.distortion = 4.001});
      EXPECT_TRUE(plan.wires.empty());
      EXPECT_TRUE(plan.is_reached);
      EXPECT_NEAR(plan.energy, 4.0, 1e-6);
      EXPECT_EQ(plan.cost, 0.0);
      expect_discs(*surface, plan);
      expect_map(*surface, plan);
    }
    const SeamPlan discs = SeamPlanner(surface, along_edges()).plan({.distortion = kAnything});
    EXPECT_FALSE(discs.wires.empty()) << "only discs are wanted";
  }
}

TEST(SeamPlanner, ASheetNeedsNoSeamsBesideItsFins) {
  // The edge below a fin has three faces, so it is a hole of the sheet.
  constexpr int kSide = 8, kFins = 20;
  shapes::QuadMesh mesh = shapes::quad_grid(kSide);
  for (int i = 0; i < kFins; ++i) {
    const std::int32_t a = (1 + i / (kSide - 1)) * (kSide + 1) + 1 + i % (kSide - 1);
    const auto top = static_cast<std::int32_t>(mesh.points.size());
    for (const std::int32_t v : {a, a + 1}) {
      mesh.points.emplace_back(mesh.points[static_cast<std::size_t>(v)] + Vector(0.0, 0.0, 0.1));
    }
    mesh.quads.push_back({a, a + 1, top + 1, top});
  }
  const auto surface = shared(mesh);
  const SeamPlan plan = SeamPlanner(surface, along_edges()).plan();
  EXPECT_TRUE(plan.wires.empty());
  EXPECT_EQ(plan.island_count, static_cast<std::size_t>(kFins + 1));
  EXPECT_NEAR(plan.energy, 4.0, 1e-6);
  expect_discs(*surface, plan);
  expect_map(*surface, plan);
}

/// A mask: a part of a ball with an eye hole on each side of x = 0.
shapes::QuadMesh mask() {
  constexpr int kSide = 24;
  shapes::QuadMesh mesh = shapes::quad_grid(kSide);
  int quad = 0;
  std::erase_if(mesh.quads, [&](const auto&) {
    const int column = quad % kSide, row = quad++ / kSide;
    return (std::abs(column - 6) < 2 || std::abs(column - 17) < 2) && std::abs(row - 14) < 2;
  });
  for (Vector& point : mesh.points) {
    const double x = 2.0 * point.x() - 1.0, y = 2.0 * point.y() - 1.0;
    point = Vector(x, y, 0.7 * std::sqrt(2.5 - x * x - y * y));
  }
  return mesh;
}

TEST(SeamPlanner, AMaskKeepsItsEyeHoles) {
  const auto surface = shared(mask());
  const SeamPlanner planner(surface, along_edges(0));
  const SeamPlan plan = planner.plan();
  EXPECT_TRUE(plan.wires.empty());
  EXPECT_TRUE(plan.is_reached);
  expect_discs(*surface, plan);
  expect_map(*surface, plan);
}

TEST(SeamPlanner, AConeIsSlitFromItsHoleToItsRimIfTheBoundIsLow) {
  const auto surface = shared(shapes::parametric_quads(32, 6, true, false, [](double u, double v) {
    const double radius = 0.2 + 0.8 * v, a = 2.0 * std::numbers::pi * u;
    return Vector(radius * std::cos(a), radius * std::sin(a), -0.55 * radius);
  }));
  const SeamPlanner planner(surface, along_edges());
  const SeamPlan ring = planner.plan();
  EXPECT_TRUE(ring.wires.empty());
  EXPECT_GT(ring.energy, 4.005);
  EXPECT_TRUE(ring.is_reached);
  const SeamPlan slit = planner.plan({.distortion = 4.005});
  expect_map(*surface, slit);
  EXPECT_TRUE(slit.is_reached);
  EXPECT_NEAR(slit.energy, 4.0, 1e-3);
  EXPECT_EQ(slit.wires.size(), 1U);
  EXPECT_NEAR(length_of(*surface, slit), 0.8 * std::hypot(1.0, 0.55), 1e-6) << "straight, from loop to loop";
}

TEST(SeamPlanner, ACylinderIsCutFromRimToRim) {
  const auto surface = shared(shapes::quad_cylinder(16, 8));
  const SeamPlan plan = SeamPlanner(surface, along_edges()).plan();
  expect_discs(*surface, plan);
  expect_map(*surface, plan);
  EXPECT_TRUE(plan.is_reached);
  EXPECT_NEAR(length_of(*surface, plan), 1.0, 1e-9);
  EXPECT_NEAR(plan.energy, 4.0, 1e-4);
  ASSERT_EQ(plan.wires.size(), 1U);
}

TEST(SeamPlanner, ABallGetsOneIsland) {
  const auto surface = shared(shapes::icosphere(sized(3, 2)));
  const SeamPlanner planner(surface, along_edges());
  const SeamPlan disc = planner.plan({.distortion = kAnything});
  expect_discs(*surface, disc);
  expect_map(*surface, disc);
  EXPECT_EQ(disc.island_count, 1U);
  const SeamPlan plan = planner.plan({.distortion = 4.4});
  expect_discs(*surface, plan);
  expect_map(*surface, plan);
  EXPECT_EQ(plan.island_count, 1U);
  EXPECT_TRUE(plan.is_reached);
  EXPECT_LE(plan.energy, 4.4);
  EXPECT_GT(length_of(*surface, plan), length_of(*surface, disc));
}

TEST(SeamPlanner, SurfacesWithHandlesBecomeDiscs) {
  const Surfaces surfaces = {shared(shapes::quad_torus(sized(24, 12), sized(12, 6))),
                             shared(shapes::plate({"#####", "#.#.#", "#####"}, sized(2, 1)))};
  for (const auto& surface : surfaces) {
    const SeamPlanner planner(surface, along_edges());
    const SeamPlan discs = planner.plan({.distortion = kAnything});
    expect_discs(*surface, discs);
    EXPECT_EQ(discs.island_count, 1U);
    const SeamPlan plan = planner.plan({.distortion = 4.5, .steps = 300});
    expect_discs(*surface, plan);
    expect_map(*surface, plan);
    EXPECT_EQ(plan.is_reached, plan.energy <= 4.5);
  }
}

TEST(SeamPlanner, TheBoundIsReachedOrThePlanSaysThatItIsNot) {
  const auto surface = shared(shapes::bumpy(shapes::icosphere(2), 0.05));
  const SeamPlanner planner(surface, along_edges());
  for (const double distortion : {4.0001, 4.1, 4.3, 5.0, 20.0}) {
    const SeamPlan plan = planner.plan({.distortion = distortion, .steps = 300});
    EXPECT_EQ(plan.is_reached, plan.energy <= distortion) << distortion;
    EXPECT_EQ(plan.is_reached, distortion > 4.05) << distortion;
    expect_discs(*surface, plan);
    expect_map(*surface, plan);
  }
  EXPECT_GT(planner.plan({.distortion = 4.1}).cost, planner.plan({.distortion = 5.0}).cost);
}

TEST(SeamPlanner, EachPlanThatIsFoundIsBetter) {
  const auto surface = shared(shapes::dumbbell(12, 20));
  const SeamPlanner planner(surface, along_edges(0));
  std::vector<SeamPlan> found;
  const auto keep = [&](const SeamPlan& plan) { found.push_back(plan); };
  const SeamPlan plan = planner.plan({.distortion = 4.15}, keep);
  ASSERT_GT(found.size(), 1U);
  for (std::size_t i = 0; i < found.size(); ++i) {
    expect_discs(*surface, found[i]);
    EXPECT_TRUE(found[i].uvs.empty());
    if (i == 0) continue;
    const bool is_cheaper = found[i].is_reached && found[i].cost < found[i - 1].cost;
    const bool is_nearer = !found[i - 1].is_reached && found[i].energy < found[i - 1].energy;
    EXPECT_TRUE(is_cheaper || is_nearer);
  }
  EXPECT_EQ(edges_of(found.back()), edges_of(plan));
  EXPECT_TRUE(plan.is_reached);
}

TEST(SeamPlanner, ASymmetricSurfaceGetsMirroredSeams) {
  const auto surface = shared(shapes::dumbbell(12, 20));
  for (const int axis : {0, 1, 2}) {
    const SeamPlan plan = SeamPlanner(surface, along_edges(axis)).plan({.distortion = 4.2, .steps = 500});
    expect_discs(*surface, plan);
    const PlanMesh mesh = plan_mesh(*surface, {});
    const std::optional<Reflection> reflection = find_reflection(mesh, axis, {});
    ASSERT_TRUE(reflection && reflection->is_exact);
    const std::set<Edge> edges = edges_of(plan);
    EXPECT_FALSE(edges.empty());
    for (const auto& [a, b] : edges) {
      EXPECT_TRUE(edges.contains(sorted(reflection->images[a], reflection->images[b]))) << "axis " << axis;
    }
  }
}

TEST(SeamPlanner, LimbsArePartedAtTheirNecks) {
  const auto surface = shared(shapes::dumbbell(16, 24));
  for (const int mirror : {-1, 0}) {
    const SeamPlanner planner(surface, along_edges(mirror));
    const SeamPlan plan = planner.plan({.distortion = 4.3, .islands = 3, .steps = 300});
    expect_discs(*surface, plan);
    expect_map(*surface, plan);
    EXPECT_EQ(plan.island_count, 3U);
    for (const double x : {-0.78, 0.0, 0.78}) {
      std::set<std::int32_t> islands;
      for (std::size_t f = 0; f < surface->face_count(); ++f) {
        const Triangle& t = surface->triangles()[f];
        const Vector middle = (surface->points()[t[0]] + surface->points()[t[1]] + surface->points()[t[2]]) / 3.0;
        if (std::abs(middle.x() - x) < 0.1) islands.insert(plan.islands[f]);
      }
      EXPECT_EQ(islands.size(), 1U) << "each ball is an island";
    }
    EXPECT_EQ(planner.plan({.distortion = kAnything}).island_count, 1U);
    // A pair of limbs is parted as a whole.
    EXPECT_EQ(planner.plan({.distortion = kAnything, .islands = 2}).island_count, mirror < 0 ? 2U : 3U);
    EXPECT_GE(planner.plan({.distortion = kAnything, .islands = 9}).island_count, 9U) << "halves, after the limbs";
  }
}

TEST(SeamPlanner, GivenSeamsStayAndCount) {
  const auto surface = shared(shapes::quad_cube(4));
  SeamPlannerOptions options = along_edges();
  // The top is an island already.
  for (const Edge& edge : surface->edges()) {
    const Vector &a = surface->points()[edge[0]], &b = surface->points()[edge[1]];
    const auto is_rim = [](const Vector& p) {
      return p.z() == 1.0 && (p.x() * p.y() * (1 - p.x()) * (1 - p.y()) == 0.0);
    };
    const bool is_side = a.x() == b.x() ? std::abs(a.x() - 0.5) == 0.5 : std::abs(a.y() - 0.5) == 0.5;
    if (is_rim(a) && is_rim(b) && is_side) options.seams.push_back({edge[1], edge[0]});
  }
  ASSERT_EQ(options.seams.size(), 16U);
  options.seams.push_back({0, 124 % static_cast<std::int32_t>(surface->vertex_count())});  // no edge
  const SeamPlan plan = SeamPlanner(surface, options).plan();
  expect_discs(*surface, plan, options.seams);
  EXPECT_EQ(plan.island_count, 2U);
  EXPECT_TRUE(plan.is_reached);
  for (const auto& [a, b] : options.seams) EXPECT_FALSE(edges_of(plan).contains(sorted(a, b)));
  EXPECT_LT(plan.cost, SeamPlanner(surface, along_edges()).plan().cost);
}

TEST(SeamPlanner, KeepOutAreasAreNeverCrossed) {
  const auto surface = shared(shapes::dumbbell(12, 20));
  std::vector<double> weights(surface->vertex_count(), 1.0);
  for (std::size_t v = 0; v < surface->vertex_count(); ++v) {
    if (surface->points()[v].x() > 0.3 || surface->points()[v].y() > 0.2) weights[v] = kAnything;
  }
  for (const Along along : {Along::kEdges, Along::kSurface}) {
    const SeamPlanner planner(surface, {.along = along, .weights = weights});
    for (const std::size_t islands : {0U, 3U}) {
      const SeamPlan plan = planner.plan({.distortion = 4.1, .islands = islands, .steps = 200});
      expect_discs(*surface, plan);
      EXPECT_FALSE(plan.wires.empty());
      for (const Edge& edge : edges_of(plan)) {
        for (const std::int32_t v : edge) EXPECT_EQ(weights[v], 1.0);
      }
    }
  }
}

TEST(SeamPlanner, SeamsHideFromTheFront) {
  for (const auto& surface : {shared(shapes::icosphere(sized(3, 2))), shared(shapes::dumbbell(16, 24))}) {
    SeamPlannerOptions options = along_edges();
    options.front = Vector(0.2, 0.1, 5.0);
    const SeamPlan plan = SeamPlanner(surface, options).plan({.distortion = 4.3, .steps = 400});
    expect_discs(*surface, plan);
    const PlanMesh mesh = plan_mesh(*surface, {});
    const Visibility seen = find_visibility(mesh, options.front, {});
    double all = 0.0, area = 0.0, along = 0.0, length = 0.0;
    const std::vector<double> areas = vertex_areas(mesh, face_frames(mesh, {}));
    for (std::size_t v = 0; v < areas.size(); ++v) {
      all += areas[v] * seen.front[v];
      area += areas[v];
    }
    for (const auto& [a, b] : edges_of(plan)) {
      const double own = (surface->points()[a] - surface->points()[b]).norm();
      along += 0.5 * own * (seen.front[a] + seen.front[b]);
      length += own;
    }
    EXPECT_LT(along / length, 0.8 * all / area);
  }
}

TEST(SeamPlanner, ALowBoundNeedsWiresInFullView) {
  std::vector<std::array<double, 2>> half_circle;
  for (int i = 0; i <= 12; ++i) {
    const double angle = std::numbers::pi * (i / 12.0 - 0.5);
    half_circle.push_back({std::sin(angle), std::cos(angle)});
  }
  SeamPlannerOptions options = along_edges();
  options.front = Vector(1, 0, 0);
  const SeamPlanner planner(shared(shapes::lathe(24, half_circle)), options);
  EXPECT_EQ(planner.plan({.distortion = 4.2, .steps = 500}).exposed_wires, 0u);
  EXPECT_GT(planner.plan({.distortion = 4.005, .steps = 500}).exposed_wires, 0u);
}

TEST(SeamPlanner, WiresAcrossTheSurfaceStayNearTheSlits) {
  const auto surface = shared(shapes::bumpy(shapes::dumbbell(16, 24), 0.01));
  const SeamPlan across = SeamPlanner(surface).plan({.distortion = kAnything});
  const SeamPlan edges = SeamPlanner(surface, along_edges()).plan({.distortion = kAnything});
  expect_sound(*surface, across);
  ASSERT_FALSE(across.wires.empty());
  std::set<std::int32_t> on_slits;
  for (const Edge& edge : edges_of(edges)) on_slits.insert(edge.begin(), edge.end());
  const double scale = plan_mesh(*surface, {}).scale;
  for (const PlannedWire& wire : across.wires) {
    EXPECT_EQ(wire.faces.size() + 1, wire.points.size());
    EXPECT_TRUE(on_slits.contains(wire.from) && on_slits.contains(wire.to)) << "seeds are on the slits";
    for (const Vector& point : wire.points) {
      double least = kAnything;
      for (const std::int32_t v : on_slits) least = std::min(least, (surface->points()[v] - point).norm());
      EXPECT_LT(scale * least, 0.1);
    }
  }
  EXPECT_NEAR(across.energy, edges.energy, 0.01 * edges.energy);
  expect_map(*surface, across);
}

TEST(SeamPlanner, WiresAcrossHandlesDoNotFallBackToEdges) {
  const auto surface = shared(shapes::bumpy(shapes::torus(sized(40, 24), sized(20, 12)), 0.01));
  const SeamPlan plan = SeamPlanner(surface).plan({.distortion = 4.5, .steps = 300});
  expect_discs(*surface, plan);
  expect_map(*surface, plan);
  EXPECT_EQ(plan.island_count, 1U);
  std::size_t smooth = 0;
  for (const PlannedWire& wire : plan.wires) smooth += wire.points.size() != wire.vertices.size() ? 1 : 0;
  EXPECT_GT(2 * smooth, plan.wires.size());
}

TEST(SeamPlanner, TheMapIsCutWhereTheWiresAre) {
  const Surfaces surfaces = {shared(shapes::bumpy(shapes::dumbbell(16, 24), 0.01)),
                             shared(shapes::bumpy(shapes::grid(24), 0.02))};
  for (const auto& surface : surfaces) {
    const SeamPlanner planner(surface);
    for (const double distortion : {4.05, 4.3, kAnything}) {
      const SeamPlan plan = planner.plan({.distortion = distortion, .steps = 200});
      expect_sound(*surface, plan);
      expect_map(*surface, plan);
      expect_cut_along_wires(*surface, plan);
      EXPECT_EQ(plan.is_reached, plan.energy <= distortion);
    }
  }
}

TEST(SeamPlanner, LargeSurfacesArePlannedOnASimplifiedMesh) {
  // Handles are the hardest to carry over: a loop that is cut short leaves no disc.
  const auto surface = shared(shapes::torus(80, 60));
  ASSERT_GT(surface->face_count(), 9000U);
  std::vector<SeamPlan> found;
  const SeamPlan plan =
      SeamPlanner(surface, along_edges()).plan({.distortion = 4.4, .steps = 30}, [&](const SeamPlan& one) {
        found.push_back(one);
      });
  expect_discs(*surface, plan);
  expect_map(*surface, plan);
  ASSERT_FALSE(found.empty());
  for (const SeamPlan& one : found) expect_discs(*surface, one);
}

TEST(SeamPlanner, SeveralPiecesArePlannedTogether) {
  shapes::Mesh mesh = shapes::icosphere(1);
  add(mesh, shapes::cylinder(12, 4), {3, 0, 0});
  add(mesh, shapes::grid(3), {0, 3, 0});
  add(mesh, shapes::torus(12, 8), {0, 0, 3});
  const auto surface = shared(mesh);
  std::vector<SeamPlan> found;
  const auto keep = [&](const SeamPlan& plan) { found.push_back(plan); };
  const SeamPlan plan = SeamPlanner(surface, along_edges()).plan({.distortion = 4.6, .steps = 300}, keep);
  expect_discs(*surface, plan);
  expect_map(*surface, plan);
  EXPECT_EQ(plan.island_count, 4U);
  EXPECT_TRUE(plan.is_reached);
  ASSERT_FALSE(found.empty());
  for (const SeamPlan& one : found) expect_discs(*surface, one);
}

TEST(SeamPlanner, ManyUnequalPiecesReachTheBound) {
  const int count = sized(200, 20);
  const auto sides = [](int i) { return Vector(0.4 + 0.05 * (i % 7), 0.5 + 0.07 * (i % 11), 0.6 + 0.03 * (i % 13)); };
  const auto surface = shared(boxes(count, sides));
  const SeamPlan plan = SeamPlanner(surface, along_edges()).plan();
  expect_discs(*surface, plan);
  expect_map(*surface, plan);
  EXPECT_TRUE(plan.is_reached);
  EXPECT_EQ(plan.island_count, static_cast<std::size_t>(count));
  for (const std::size_t seams : seams_by_copy(plan, 8, index(count))) EXPECT_GE(seams, 2U);
}

TEST(SeamPlanner, CongruentPiecesArePlannedOnce) {
  const int count = sized(1000, 50);
  const auto surface = shared(boxes(count, [](int) { return Vector(1, 1, 1); }));
  for (const double distortion : {4.2, kAnything}) {
    const SeamPlan plan = SeamPlanner(surface, along_edges()).plan({.distortion = distortion});
    expect_discs(*surface, plan);
    expect_map(*surface, plan);
    EXPECT_TRUE(plan.is_reached);
    EXPECT_EQ(plan.island_count, static_cast<std::size_t>(count));
    EXPECT_LT(plan.steps, sized(20.0, 200.0)) << "a box alone takes some hundreds";
    for (const std::size_t seams : seams_by_copy(plan, 8, index(count))) EXPECT_GE(seams, 2U);
  }
}

TEST(SeamPlanner, SmallPiecesAreWithinTheBoundToo) {
  const shapes::Mesh ball = shapes::bumpy(shapes::icosphere(1), 0.04);
  shapes::Mesh mesh;
  for (const double size : {1.0, 0.2, 0.04}) {
    shapes::Mesh own = ball;
    for (Vector& point : own.points) point *= size;
    add(mesh, own, {10.0 * size, 0, 0});
  }
  const auto surface = shared(mesh);
  const SeamPlan plan = SeamPlanner(surface, along_edges()).plan({.distortion = 4.3, .steps = 300});
  expect_discs(*surface, plan);
  EXPECT_TRUE(plan.is_reached);
  const MapReport report = measure_map(*surface, plan.uvs, plan.islands);
  for (std::size_t i = 0; i < 3; ++i) {
    double sum = 0.0, area = 0.0;
    for (std::size_t f = i * ball.triangles.size(); f < (i + 1) * ball.triangles.size(); ++f) {
      const Triangle& t = surface->triangles()[f];
      const Vector &a = surface->points()[t[0]], &b = surface->points()[t[1]], &c = surface->points()[t[2]];
      const double own = (b - a).cross(c - a).norm();
      sum += own * report.energies[f];
      area += own;
    }
    EXPECT_LT(sum / area, 4.33) << "piece " << i;
  }
}

TEST(SeamPlanner, FlatPiecesLeaveMoreDistortionToOthers) {
  const shapes::Mesh ball = shapes::icosphere(2);
  shapes::Mesh mesh = ball;
  shapes::Mesh sheet = shapes::grid(4);
  for (Vector& point : sheet.points) point *= 4.0;
  add(mesh, sheet, {5, 0, 0});
  const SeamGoal goal{.distortion = 4.2, .steps = 300};
  const auto alone = shared(ball), both = shared(mesh);
  const SeamPlan one = SeamPlanner(alone, along_edges()).plan(goal), plan = SeamPlanner(both, along_edges()).plan(goal);
  EXPECT_TRUE(one.is_reached && plan.is_reached);
  EXPECT_LT(length_of(*both, plan), length_of(*alone, one));
}

TEST(SeamPlanner, MirroredPiecesGetMirroredSeams) {
  // Two balls that are each other's image, a dumbbell that is its own, and a ball without an image.
  const shapes::Mesh ball = shapes::bumpy(shapes::icosphere(2), 0.05);
  shapes::Mesh image = ball;
  for (Vector& point : image.points) point.x() = -point.x();
  for (Triangle& t : image.triangles) std::swap(t[1], t[2]);
  shapes::Mesh mesh = shapes::dumbbell(12, 20);
  const auto first = static_cast<std::int32_t>(mesh.points.size());
  add(mesh, ball, {3, 2, 0});
  add(mesh, image, {-3, 2, 0});
  shapes::Mesh small = shapes::icosphere(1);
  for (Vector& point : small.points) point *= 0.2;
  const auto lonely = static_cast<std::int32_t>(mesh.points.size());
  add(mesh, small, {2, -2, 0});
  const auto surface = shared(mesh);
  const SeamPlan plan = SeamPlanner(surface, along_edges(0)).plan({.distortion = 4.25, .steps = 300});
  expect_discs(*surface, plan);
  EXPECT_EQ(plan.island_count, 4U);
  EXPECT_TRUE(plan.is_reached);
  const PlanMesh whole = plan_mesh(*surface, {});
  const std::optional<Reflection> reflection = find_reflection(whole, 0, {});
  ASSERT_TRUE(reflection);
  const std::set<Edge> edges = edges_of(plan);
  std::size_t in_balls = 0;
  for (const auto& [a, b] : edges) {
    if (a >= lonely) continue;
    in_balls += a >= first ? 1 : 0;
    EXPECT_TRUE(edges.contains(sorted(reflection->images[a], reflection->images[b])));
  }
  EXPECT_GT(in_balls, 0U);
}

TEST(SeamPlanner, OverlapsThatTheMapHasAreNotReached) {
  // Three sheets at one edge: in whatever way faces are joined there, the plan says what holds for its islands.
  shapes::Mesh mesh = shapes::grid(4);
  const auto on_edge = [](const Vector& point) { return point.x() == 0.0; };
  const shapes::Mesh sheet = mesh;
  for (const Vector& direction : {Vector(-1, 0, 0.2), Vector(-0.2, 0, 1)}) {
    std::vector<std::int32_t> number;
    for (std::size_t v = 0; v < sheet.points.size(); ++v) {
      if (on_edge(sheet.points[v])) {
        number.push_back(static_cast<std::int32_t>(v));
        continue;
      }
      number.push_back(static_cast<std::int32_t>(mesh.points.size()));
      mesh.points.push_back(sheet.points[v].x() * direction + Vector(0, sheet.points[v].y(), 0));
    }
    for (const Triangle& t : sheet.triangles) {
      mesh.triangles.push_back({number[index(t[0])], number[index(t[2])], number[index(t[1])]});
    }
  }
  const auto surface = shared(mesh);
  const SeamPlan plan = SeamPlanner(surface, along_edges()).plan();
  const MapReport report = measure_map(*surface, plan.uvs, plan.islands);
  EXPECT_EQ(plan.is_reached, report.overlapping.empty());
  EXPECT_EQ(plan.island_count, 3U) << "islands end at the edge of three sheets";
}

TEST(SeamPlanner, ProgressGrowsWithTheWork) {
  const auto surface = shared(shapes::bumpy(shapes::torus(80, 60), 0.01));
  ASSERT_GT(surface->face_count(), 9000U);
  // Processor time, because the number of calls depends on how fast the machine is.
  std::optional<std::clock_t> near_the_end;
  const Task watched{.stop = {}, .progress = [&](double fraction) {
                       if (fraction > 0.93 && !near_the_end) near_the_end = std::clock();
                       return true;
                     }};
  const auto share_at_the_end = [&](const std::function<void()>& work) {
    near_the_end = {};
    const std::clock_t begin = std::clock();
    work();
    const std::clock_t end = std::clock();
    return static_cast<double>(end - near_the_end.value_or(end)) / static_cast<double>(end - begin);
  };
  std::optional<SeamPlanner> planner;
  EXPECT_LT(share_at_the_end([&] { planner.emplace(surface, SeamPlannerOptions(), watched); }), 0.2) << "measuring";
  const auto plan = [&] { planner->plan({.distortion = 4.3, .steps = 100}, {}, watched); };
  EXPECT_LT(share_at_the_end(plan), 0.2) << "planning";
}

TEST(SeamPlanner, SizeAndPlaceDoNotMatter) {
  const shapes::Mesh mesh = shapes::dumbbell(12, 20);
  const SeamGoal goal{.distortion = 4.3, .steps = 200};
  const auto surface = shared(mesh);
  const SeamPlan plan = SeamPlanner(surface, along_edges(0)).plan(goal);
  for (const double size : {0x1p-20, 0x1p20, 0x1p-200, 0x1p200}) {
    shapes::Mesh other = mesh;
    for (Vector& point : other.points) point *= size;
    const auto resized = shared(other);
    const SeamPlan same = SeamPlanner(resized, along_edges(0)).plan(goal);
    EXPECT_EQ(edges_of(same), edges_of(plan)) << size;
    EXPECT_NEAR(same.energy, plan.energy, 1e-9);
    EXPECT_NEAR(same.uvs[0][1].x() / size, plan.uvs[0][1].x(), 1e-6);
  }
  for (const double size : {1e-6, 1e6}) {  // with other rounding
    shapes::Mesh other = mesh;
    for (Vector& point : other.points) point *= size;
    const SeamPlan same = SeamPlanner(shared(other), along_edges(0)).plan(goal);
    EXPECT_NEAR(same.cost, plan.cost, 0.2 * plan.cost) << size;
    EXPECT_TRUE(same.is_reached);
  }
}

/// A right prism whose ends are polygons of n corners, or with `has_poles` triangles around a vertex.
shapes::QuadMesh prism(int n, int rows, bool has_poles) {
  shapes::QuadMesh mesh = shapes::quad_cylinder(n, rows);
  for (const int end : {0, rows}) {
    const auto at = [&](int i) { return static_cast<std::int32_t>(end * n + (end == 0 ? n - i : i) % n); };
    const auto pole = static_cast<std::int32_t>(mesh.points.size());
    if (has_poles) mesh.points.emplace_back(0.0, 0.0, static_cast<double>(end) / rows);
    for (int i = has_poles ? 0 : 2; i < n; i += 2) {
      if (has_poles) mesh.quads.push_back({pole, at(i), at(i + 1), at(i + 2)});
      if (!has_poles) mesh.quads.push_back({at(0), at(i - 1), at(i), at(i + 1)});
    }
  }
  return mesh;
}

TEST(SeamPlanner, HowAnObjectIsTurnedDoesNotMatter) {
  std::vector<shapes::QuadMesh> objects = {shapes::quad_cube(1), shapes::quad_cube(3),
                                           shapes::plate({"##.", "#..", "###"}, 1), shapes::plate({"###", "#.#"}, 1)};
  for (const int n : {4, 6, 8, 12, 16, 24, 48}) {
    objects.push_back(prism(n, 1, false));
    objects.push_back(prism(n, 3, true));
  }
  std::mt19937 random(7);
  std::normal_distribution<double> normal;
  for (std::size_t i = 0; i < objects.size(); ++i) {
    std::set<std::size_t> islands;
    std::set<std::vector<std::vector<std::int32_t>>> borders;
    for (int turn = 0; turn < 6; ++turn) {
      shapes::QuadMesh mesh = objects[i];
      const Eigen::Quaterniond turned(normal(random), normal(random), normal(random), normal(random));
      const double scale = std::exp(normal(random));
      const Vector by(normal(random), normal(random), normal(random));
      for (Vector& p : mesh.points) {
        if (turn > 0) p = scale * (turned.normalized() * p + by);
        if (turn > 3) p = p.cast<float>().cast<double>();
      }
      const auto surface = shared(mesh);
      const Parts parts = PartFinder(surface).find(0.3);
      borders.insert(parts.borders);
      SeamPlannerOptions options = along_edges();
      for (const std::vector<std::int32_t>& chain : parts.borders) {
        for (std::size_t k = 1; k < chain.size(); ++k) options.seams.push_back({chain[k - 1], chain[k]});
      }
      islands.insert(SeamPlanner(surface, options).plan().island_count);
    }
    EXPECT_EQ(borders.size(), 1U) << "object " << i;
    EXPECT_EQ(islands.size(), 1U) << "object " << i;
  }
}

TEST(SeamPlanner, RefusesASurfaceWithoutArea) {
  for (const Vector& along : {Vector(0, 0, 0), Vector(1, 0, 0), Vector(0.3, 0.5, 0.81)}) {
    shapes::Mesh ball = shapes::icosphere(3);
    for (Vector& p : ball.points) p = (Vector(7, 1, 2) + p.x() * along).cast<float>().cast<double>();
    EXPECT_THROW(SeamPlanner(shared(ball), along_edges()), InvalidInput);
    EXPECT_EQ(PartFinder(shared(ball)).find(0.3).of_face.size(), ball.triangles.size());
  }
}

TEST(SeamPlanner, PiecesWithoutAreaAreNotSearched) {
  // A ball, and another one with all vertices in one place.
  shapes::Mesh balls = shapes::icosphere(2);
  const auto count = static_cast<std::int32_t>(balls.points.size());
  const std::vector<Triangle> triangles = balls.triangles;
  const SeamPlan alone = SeamPlanner(shared(balls), along_edges()).plan();
  balls.points.resize(2 * balls.points.size(), Vector(3, 0, 0));
  for (const auto& [a, b, c] : triangles) balls.triangles.push_back({count + a, count + b, count + c});
  const SeamPlan plan = SeamPlanner(shared(balls), along_edges()).plan();
  EXPECT_NEAR(plan.energy, alone.energy, 1e-6);
  EXPECT_NEAR(plan.steps, alone.steps, 1e-6 * alone.steps);
}

TEST(SeamPlanner, TheSamePlanComesOutTwice) {
  const auto surface = shared(shapes::bumpy(shapes::icosphere(2), 0.04));
  const SeamPlanner planner(surface, along_edges());
  const SeamGoal goal{.distortion = 4.2, .steps = 300};
  const SeamPlan one = planner.plan(goal), other = planner.plan(goal);
  const SeamPlan third = SeamPlanner(surface, along_edges()).plan(goal);
  std::vector<SeamPlan> at_once(3);
  {
    std::vector<std::jthread> threads;
    for (SeamPlan& plan : at_once) threads.emplace_back([&] { plan = planner.plan(goal); });
  }
  at_once.push_back(other);
  at_once.push_back(third);
  for (const SeamPlan& same : at_once) {
    EXPECT_EQ(edges_of(same), edges_of(one));
    EXPECT_EQ(same.energy, one.energy);
    EXPECT_EQ(same.steps, one.steps);
    EXPECT_EQ(same.cost, one.cost);
    EXPECT_EQ(same.uvs, one.uvs);
  }
}

TEST(SeamPlanner, StopsSoonWhenItIsCancelled) {
  const auto surface = shared(shapes::bumpy(shapes::icosphere(3), 0.04));
  const SeamGoal goal{.distortion = 4.01, .islands = 3};
  for (const int after : {0, 1, 5, 20, 60, 150}) {  // milliseconds: while measuring, and while planning
    std::stop_source stop;
    std::atomic<std::clock_t> stopped = 0;
    const std::jthread timer([&] {
      std::this_thread::sleep_for(std::chrono::milliseconds(after));
      stopped = std::clock();
      stop.request_stop();
    });
    const Task task{.stop = stop.get_token(), .progress = {}};
    EXPECT_THROW(SeamPlanner(surface, {}, task).plan(goal, {}, task), Cancelled);
    const auto late = static_cast<double>(std::clock() - stopped) / CLOCKS_PER_SEC;
    EXPECT_LT(late, 1.0) << "seconds of the processor, of all threads together";
  }
}

TEST(SeamPlanner, ReportsProgressAndIsCancelledByIt) {
  const auto surface = shared(shapes::icosphere(2));
  std::vector<double> fractions;
  const Task watched{.stop = {}, .progress = [&](double fraction) {
                       fractions.push_back(fraction);
                       return true;
                     }};
  const SeamPlanner planner(surface, along_edges(), watched);
  planner.plan({.distortion = 4.2, .steps = 100}, {}, watched);
  ASSERT_FALSE(fractions.empty());
  for (const double fraction : fractions) EXPECT_TRUE(fraction >= 0.0 && fraction <= 1.0);
  for (const std::size_t most : {0U, 1U, 5U, 20U}) {
    std::size_t calls = 0;
    const Task limited{.stop = {}, .progress = [&](double) { return calls++ < most; }};
    EXPECT_THROW(planner.plan({.distortion = 4.01}, {}, limited), Cancelled);
  }
}

TEST(SeamPlanner, BrokenMeshesGiveFinitePlans) {
  const std::vector<Vector> points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}, {0.5, 0.5, 1},
                                      {2, 0, 0}, {3, 0, 0}, {9, 9, 9}, {5, 5, 5}, {0.5, 0, 0}};
  const std::vector<std::vector<Triangle>> all = {
      {{0, 1, 2}},
      {{0, 1, 2}, {0, 1, 2}, {2, 1, 0}},                                   // duplicates
      {{0, 1, 1}, {0, 1, 2}},                                              // two corners are one
      {{0, 1, 9}, {0, 1, 2}, {1, 3, 2}},                                   // no area
      {{0, 1, 2}, {0, 1, 3}, {0, 1, 4}},                                   // three triangles at an edge
      {{0, 1, 2}, {1, 2, 3}, {4, 5, 6}, {0, 1, 4}},                        // two of four are turned over
      {{0, 2, 1}, {0, 1, 4}, {1, 2, 4}, {2, 0, 4}},                        // a tetrahedron
      {{0, 2, 1}, {0, 1, 4}, {1, 2, 4}, {2, 0, 4}, {3, 1, 5}, {3, 5, 8}},  // with a sheet at one of its corners
      {},
  };
  for (const auto& triangles : all) {
    std::vector<Edge> edges = {{7, 8}};  // a loose edge; one vertex is isolated
    for (const Triangle& t : triangles) {
      for (std::size_t i = 0; i < 3; ++i) {
        if (t[i] != t[(i + 1) % 3]) edges.push_back(sorted(t[i], t[(i + 1) % 3]));
      }
    }
    const auto surface = shared(Surface(points, triangles, edges));
    for (const Along along : {Along::kEdges, Along::kSurface}) {
      SeamPlannerOptions options{.along = along, .front = Vector(0, 0, 1), .mirror = 0};
      options.seams = {{0, 1}, {7, 8}};
      const SeamPlanner planner(surface, options);
      for (const double distortion : {4.2, kAnything}) {
        const SeamPlan plan = planner.plan({.distortion = distortion, .islands = 3, .steps = 100});
        expect_sound(*surface, plan, options.seams);
        EXPECT_TRUE(std::isfinite(plan.cost));
        EXPECT_FALSE(std::isnan(plan.energy));
        if (std::isfinite(plan.energy)) expect_map(*surface, plan);
        ASSERT_EQ(plan.uvs.size(), triangles.size());
        for (const auto& corners : plan.uvs) {
          for (const auto& uv : corners) EXPECT_TRUE(uv.allFinite());
        }
      }
    }
  }
}

TEST(SeamPlanner, ATetrahedronHasAMap) {
  const auto surface =
      shared(Surface({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}}));
  const SeamPlan plan = SeamPlanner(surface, along_edges()).plan({.distortion = kAnything});
  expect_discs(*surface, plan);
  EXPECT_TRUE(std::isfinite(plan.energy));
  expect_map(*surface, plan);
}

TEST(SeamPlanner, TurnedTrianglesKeepTheirCorners) {
  shapes::Mesh mesh = shapes::cylinder(12, 4);
  for (std::size_t f = 0; f < mesh.triangles.size(); f += 3) std::swap(mesh.triangles[f][1], mesh.triangles[f][2]);
  const auto surface = shared(mesh);
  ASSERT_FALSE(surface->report().flipped_faces.empty());
  const SeamPlan plan = SeamPlanner(surface, along_edges()).plan();
  expect_map(*surface, plan);
}

TEST(SeamPlanner, TrianglesThatTheSurfaceLeftOutHaveUvs) {
  shapes::Mesh mesh = shapes::cylinder(12, 4);
  mesh.triangles.push_back(mesh.triangles[3]);                                                   // twice
  mesh.triangles.push_back({mesh.triangles[5][0], mesh.triangles[5][1], mesh.triangles[5][1]});  // no triangle
  const auto surface = shared(mesh);
  const std::size_t count = mesh.triangles.size();
  for (const Along along : {Along::kEdges, Along::kSurface}) {
    const SeamPlan plan = SeamPlanner(surface, {.along = along}).plan({.steps = 20});
    EXPECT_EQ(plan.uvs[count - 2], plan.uvs[3]);
    EXPECT_EQ(plan.uvs[count - 1][2], plan.uvs[count - 1][1]);
    EXPECT_NE(plan.uvs[count - 1][0], plan.uvs[count - 1][1]);
  }
}

TEST(SeamPlanner, OneSidedSurfacesAreCut) {
  const auto surface = shared(shapes::moebius(20));
  const SeamPlan plan = SeamPlanner(surface, along_edges()).plan();
  EXPECT_FALSE(plan.wires.empty());
  expect_discs(*surface, plan);
  expect_map(*surface, plan);
}

TEST(SeamPlanner, MapsThatTakeManyStepsAreSolvedToTheirEnd) {
  // A test tube: Tutte's embedding makes its bottom smaller with each of the rings.
  std::vector<std::array<double, 2>> profile{{0.0, 0.0}, {0.0, 3.0}, {0.0, 2.0}};
  for (int ring = 0; ring <= 120; ++ring) profile.push_back({0.5 * ring, 1.0});
  profile.push_back({60.5, 0.0});
  const auto at_first_pole = [](const Vector& p) { return p.x() == 0.0 && p.norm() > 1.8 && p.norm() < 2.1; };
  const auto surface = shared(shapes::without(shapes::lathe(12, profile), at_first_pole));
  const SeamPlan plan = SeamPlanner(surface, along_edges()).plan({.distortion = kAnything});
  ASSERT_TRUE(plan.wires.empty());
  const Flattening solved = flatten(*surface, {}, {.max_steps = 1000});
  const double energy = measure_map(*surface, solved.uvs).energy;
  EXPECT_NEAR(plan.energy, energy, 0.01 * energy);
}

TEST(SeamPlanner, RefusesWrongOptions) {
  const auto surface = shared(shapes::grid(2));
  const auto expect_refused = [&](const SeamPlannerOptions& options) {
    EXPECT_THROW(SeamPlanner(surface, options), InvalidInput);
  };
  expect_refused({.mirror = 3});
  expect_refused({.mirror = -2});
  expect_refused({.front = Vector(0, 0, 0)});
  expect_refused({.front = Vector(0, NAN, 1)});
  expect_refused({.weights = {1.0, 2.0}});
  expect_refused({.weights = std::vector<double>(9, -1.0)});
  expect_refused({.weights = std::vector<double>(9, NAN)});
  expect_refused({.seams = {{0, 9}}});
  expect_refused({.strength = {.max_anisotropy = 0.5}});
  const SeamPlanner planner(surface);
  for (const double distortion : {4.0, 0.0, -kAnything, static_cast<double>(NAN)}) {
    EXPECT_THROW(planner.plan({.distortion = distortion}), InvalidInput);
  }
}

}  // namespace
}  // namespace seamwire
