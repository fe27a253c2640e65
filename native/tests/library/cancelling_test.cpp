// SPDX-License-Identifier: GPL-3.0-or-later
//
// What takes long can be stopped, and looks often enough whether it is to be: counted, not timed.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "detail/poll.hpp"
#include "geodesics/path_tracing.hpp"
#include "intrinsic.hpp"
#include "seamwire/edges/edge_graph.hpp"
#include "seamwire/embedding/embedding.hpp"
#include "seamwire/geodesics/corridor_paths.hpp"
#include "seamwire/geodesics/exact_geodesics.hpp"
#include "seamwire/geodesics/heat_geodesics.hpp"
#include "seamwire/metric/scribble.hpp"
#include "seamwire/surface/nearest_points.hpp"
#include "seamwire/surface/segments.hpp"
#include "seamwire/wires/closed_wires.hpp"
#include "seamwire/wires/snap.hpp"
#include "seamwire/wires/wire.hpp"
#include "seamwire_uv/maps/measure_map.hpp"
#include "seamwire_uv/parts/part_finder.hpp"
#include "seamwire_uv/seams/missing_cuts.hpp"
#include "seamwire_uv/seams/seam_planner.hpp"
#include "shapes.hpp"

namespace seamwire {

using namespace detail;

namespace {

/// `steps`: of the work's loops that take long, together.
void expect_stops(std::size_t steps, const std::function<void(const Task&)>& work) {
  std::stop_source stop;
  stop.request_stop();
  EXPECT_THROW(work({.stop = stop.get_token(), .progress = {}}), Cancelled);

  std::size_t checks = 0;
  double last = 0.0;
  work({.stop = {}, .progress = [&](double fraction) {
          EXPECT_GE(fraction, last);
          EXPECT_LE(fraction, 1.0);
          last = fraction;
          ++checks;
          return true;
        }});
  EXPECT_GE(checks, steps / Poll::kSteps);

  for (std::size_t n = 1; n <= checks; ++n) {
    std::size_t asked = 0;
    const Task task{.stop = {}, .progress = [&](double) { return ++asked < n; }};
    EXPECT_THROW(work(task), Cancelled) << "at check " << n << " of " << checks;
    EXPECT_EQ(asked, n) << "it went on";
  }
}

/// How many times some work looks at its task.
std::size_t looks_of(const std::function<void(const Task&)>& work) {
  std::size_t looks = 0;
  work({.stop = {}, .progress = [&](double) { return ++looks > 0; }});
  return looks;
}

class Cancelling : public testing::Test {
 protected:
  const shapes::Mesh mesh = shapes::torus(160, 120);
  const Surface surface{mesh.points, mesh.triangles};
  const std::size_t vertices = surface.vertex_count(), faces = surface.face_count(), edges = surface.edges().size();
};

TEST_F(Cancelling, CuttingAPartInTwo) {
  const PartFinder finder(std::make_shared<const Surface>(surface));
  const std::size_t finding = looks_of([&](const Task& task) { finder.find(0.5, {}, task); });
  // Each of the fifteen cuts has some dozens of paths.
  const auto cut = [&](const Task& task) { finder.find(0.5, {.parted = {0}}, task); };
  EXPECT_GE(looks_of(cut), finding + 100);
  double last = 0.0;
  finder.find(0.5, {.parted = {0, 0}}, {.stop = {}, .progress = [&](double fraction) {
                                          EXPECT_GE(fraction, last);
                                          last = fraction;
                                          return fraction <= 1.0;
                                        }});
  EXPECT_GT(last, 0.8);
  for (const double share : {0.35, 0.5, 0.7, 0.85}) {
    std::size_t after = 0;
    const Task task{.stop = {}, .progress = [&](double fraction) { return fraction < share || ++after == 0; }};
    EXPECT_THROW(cut(task), Cancelled) << share;
    EXPECT_EQ(after, 1u) << "it went on";
  }
}

TEST_F(Cancelling, MeasuringWhatPartsAndSeamsNeed) {
  const auto shared = std::make_shared<const Surface>(surface);
  // Over the triangles and the edges, each more than once.
  const std::size_t preparing = 3 * faces + 17 * edges;
  EXPECT_GE(looks_of([&](const Task& task) { PartFinder(shared, {}, task); }),
            (preparing + 9 * edges + 3 * faces) / Poll::kSteps + edges / Poll::kFewSteps);
  const SeamPlannerOptions along_edges{.along = Along::kEdges};
  EXPECT_GE(looks_of([&](const Task& task) { SeamPlanner(shared, along_edges, task); }),
            (preparing + 9 * edges + 3 * faces) / Poll::kSteps + edges / Poll::kFewSteps);
}

TEST_F(Cancelling, CountingIslandsAndTheirCuts) {
  const std::vector<std::int32_t> segments = face_segments(surface, {});
  expect_stops(3 * faces, [&](const Task& task) { face_segments(surface, {}, task); });
  expect_stops(8 * faces, [&](const Task& task) { missing_cuts(surface, {}, segments, task); });
}

TEST_F(Cancelling, NearestPointsOfManyTriangles) {
  // The build of the tree looks once in four times as many steps.
  EXPECT_GE(looks_of([&](const Task& task) { NearestPoints(mesh.points, mesh.triangles, task); }),
            (vertices + 2 * faces) / Poll::kSteps);
  const NearestPoints nearest(mesh.points, mesh.triangles);
  EXPECT_GE(looks_of([&](const Task& task) { nearest.find(mesh.points, {}, task); }), 10 * vertices / Poll::kSteps);
}

TEST_F(Cancelling, MeasuringAMap) {
  std::vector<std::array<Eigen::Vector2d, 3>> uvs;
  for (const Triangle& corners : mesh.triangles) {
    auto& own = uvs.emplace_back();
    for (std::size_t i = 0; i < 3; ++i) own[i] = mesh.points[corners[i]].head<2>();
  }
  // Triangles are checked, turned and measured, and then sorted.
  std::size_t before_sorting = 0, after = 0;
  map_energy(surface, uvs, {}, {.stop = {}, .progress = [&](double fraction) {
                                  ++(fraction < 0.2 ? before_sorting : after);
                                  return true;
                                }});
  EXPECT_GE(before_sorting, 3 * faces / Poll::kSteps);
  EXPECT_GE(after, 4 * faces / Poll::kSteps);
}

TEST_F(Cancelling, BuildingASurface) {
  const std::size_t half_edges = 3 * faces;
  expect_stops(6 * vertices + 4 * faces + 2 * edges + 5 * half_edges,
               [&](const Task& task) { const Surface again(mesh.points, mesh.triangles, std::nullopt, task); });
}

TEST_F(Cancelling, Curvatures) {
  expect_stops(2 * faces + 4 * vertices, [&](const Task& task) { principal_curvatures(surface, task); });
}

TEST_F(Cancelling, SmoothingCurvatures) {
  const Curvature curvature = principal_curvatures(surface);
  expect_stops(faces + edges + vertices,
               [&](const Task& task) { smoothed_curvatures(surface, curvature, 1e-9, task); });
}

TEST_F(Cancelling, EachMetric) {
  const Curvature curvature = principal_curvatures(surface);
  const Strength strength{.max_anisotropy = 5, .clamp_percentile = 99};
  for (const Follow follow : {Follow::kMin, Follow::kMax}) {
    expect_stops(4 * vertices, [&](const Task& task) { feature_metric(surface, curvature, follow, strength, task); });
    expect_stops(2 * vertices, [&](const Task& task) { campen_metric(surface, curvature, follow, strength, task); });
    expect_stops(4 * vertices,
                 [&](const Task& task) { pottmann_kovacs_metric(surface, curvature, follow, strength, task); });
  }
  expect_stops(2 * vertices, [&](const Task& task) { concave_metric(surface, curvature, 1.0, task); });
  expect_stops(2 * vertices, [&](const Task& task) { euclidean_metric(surface, curvature, task); });
}

TEST_F(Cancelling, Scribbles) {
  const Metric metric = euclidean_metric(surface, principal_curvatures(surface));
  Scribble scribble;
  for (std::int32_t v = 0; v < 100; ++v) {
    scribble.vertices.push_back(v);
    scribble.points.push_back(surface.points()[v]);
  }
  scribble.rings = 50;
  // Each vertex looked at is several steps long.
  expect_stops(100 * 50 * Poll::kSteps / Poll::kFewSteps,
               [&](const Task& task) { apply_scribbles(surface, metric, std::vector{scribble}, std::nullopt, task); });
}

TEST_F(Cancelling, Snapping) {
  const Embedding embedding =
      embed(surface, euclidean_metric(surface, principal_curvatures(surface)), {.max_error = 0});
  const ExactGeodesics geodesics(embedding.mesh);
  const auto target = static_cast<std::int32_t>(vertices / 2);
  const Wire wire = trace_wire(surface, embedding, geodesics.solve(0), target).value();
  // Each edge of the chain was taken from the queue, and an integral is several steps long.
  const std::size_t chain = snap_to_edges(surface, wire).size();
  expect_stops(chain * Poll::kSteps / Poll::kFewSteps, [&](const Task& task) { snap_to_edges(surface, wire, task); });
}

TEST_F(Cancelling, Embedding) {
  const Metric metric = euclidean_metric(surface, principal_curvatures(surface));
  // Looking for degenerate ones, lengths, and looking for invalid ones.
  expect_stops(faces + vertices + 3 * faces + faces,
               [&](const Task& task) { embed(surface, metric, {.max_error = 0}, task); });
}

TEST_F(Cancelling, TheMeshOfTheGeodesics) {
  const Embedding embedding =
      embed(surface, euclidean_metric(surface, principal_curvatures(surface)), {.max_error = 0});
  expect_stops(faces + 3 * faces + faces + 2 * faces + vertices + faces + 2 * faces + vertices + vertices,
               [&](const Task& task) { ExactGeodesics(embedding.mesh, task); });
}

TEST_F(Cancelling, TheHeatMethod) {
  const IntrinsicMesh mesh =
      embed(surface, euclidean_metric(surface, principal_curvatures(surface)), {.max_error = 0}).mesh;
  // The mesh is checked, its edges are flipped, and its equations are set up.
  expect_stops(5 * faces + 2 * faces + 3 * faces / 2 + 2 * faces, [&](const Task& task) { HeatGeodesics(mesh, task); });
  const HeatGeodesics heat(mesh);
  expect_stops(faces, [&](const Task& task) { heat.solve(0, task); });
  const DistanceField field = heat.solve(0);
  const auto farthest =
      static_cast<std::int32_t>(std::ranges::max_element(field.distances()) - field.distances().begin());
  const std::size_t crossed = field.trace(farthest)->faces.size();
  ASSERT_GT(crossed, Poll::kFewSteps);
  expect_stops(crossed * Poll::kSteps / Poll::kFewSteps, [&](const Task& task) { field.trace(farthest, task); });
}

TEST_F(Cancelling, APathAtOnce) {
  const Embedding embedding =
      embed(surface, euclidean_metric(surface, principal_curvatures(surface)), {.max_error = 0});
  const ExactGeodesics geodesics(embedding.mesh);
  // In a corridor as wide as the mesh, with all windows, the front looks at the task as often as in a field.
  const CorridorPathOptions all{.corridor_vertices = vertices, .windows = 0};
  const auto target = static_cast<std::int32_t>(vertices / 2);
  const GeodesicCounters counters = geodesics.solve(0).counters();
  expect_stops(counters.windows / 4, [&](const Task& task) { CorridorPaths(geodesics, 0, all).path(target, task); });
}

TEST_F(Cancelling, TheLoopsOfClosedWires) {
  const Embedding embedding =
      embed(surface, euclidean_metric(surface, principal_curvatures(surface)), {.max_error = 0});
  const DistanceField field = ExactGeodesics(embedding.mesh).solve(0);
  // The tree of the faces is taken apart, areas are added up, and the loops are rated.
  std::size_t looks = 0;
  closed_wires(surface, embedding, field, 3, {.stop = {}, .progress = [&](double fraction) {
                                                looks += fraction >= 0.55 && fraction < 0.6;
                                                return true;
                                              }});
  EXPECT_GE(looks, 3 * faces / Poll::kSteps);
}

TEST_F(Cancelling, ADetourOfATracedPath) {
  const GeodesicMesh plane(shapes::intrinsic(shapes::grid(100)), {});
  std::int32_t border = 0;
  while (plane.twin(border) >= 0) ++border;
  // The line from the target leaves the mesh, and the only nearer vertex is far away.
  const auto last = static_cast<std::int32_t>(plane.vertex_count()) - 1;
  const std::int32_t target = plane.half_edge(border).apex;
  const std::int32_t seed = plane.external_vertex(target) < last / 2 ? last : 0;
  std::vector<double> distances(plane.vertex_count(), 2.0);
  std::vector<TraceRecord> records(plane.vertex_count(), {.half_edge = TraceRecord::kLooseEdge});
  distances[plane.external_vertex(target)] = 1.0;
  records[target] = {.x = 0.0, .y = -1.0, .half_edge = border, .source = plane.half_edge(border).tail};
  for (std::int32_t v = 0; v <= last; ++v) {
    if (plane.external_vertex(v) != seed) continue;
    distances[seed] = 0.0;
    records[v] = {};
  }
  const SourcePoints sources;
  const auto trace = [&](const Task& task) {
    return trace_records({plane, distances, sources}, records, {}, PlacedPoint::at_vertex(target), task);
  };
  EXPECT_EQ(plane.external_vertex(trace({}).points.front().vertex), seed);
  EXPECT_THROW(trace({.stop = {}, .progress = [](double) { return false; }}), Cancelled);
}

TEST_F(Cancelling, TheEdgesAroundEachVertexAndTheirLengths) {
  // It looks at each vertex, and each fan, four times as often.
  expect_stops(edges + 4 * 2 * vertices, [&](const Task& task) { make_edge_adjacency(surface, task); });
  const auto adjacency = make_edge_adjacency(surface);
  const Metric metric = euclidean_metric(surface, principal_curvatures(surface));
  expect_stops(edges, [&](const Task& task) { make_edge_graph(surface, metric, adjacency, {}, std::nullopt, task); });
}

}  // namespace
}  // namespace seamwire
