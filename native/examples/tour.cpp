// SPDX-License-Identifier: GPL-3.0-or-later
// One example a concept, as docs/api/concepts.md shows them; it is built and run by the tests.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <memory>
#include <numbers>
#include <stop_token>
#include <utility>
#include <vector>

#include "seamwire/context/embedded_surface.hpp"
#include "seamwire/context/surface_context.hpp"
#include "seamwire/edges/edge_loop.hpp"
#include "seamwire/edges/edge_wires.hpp"
#include "seamwire/edges/shortest_cycle.hpp"
#include "seamwire/embedding/embedding.hpp"
#include "seamwire/flatten/flatten.hpp"
#include "seamwire/flatten/measure_map.hpp"
#include "seamwire/geodesics/corridor_paths.hpp"
#include "seamwire/geodesics/exact_geodesics.hpp"
#include "seamwire/live/livewire.hpp"
#include "seamwire/metric/curvature.hpp"
#include "seamwire/metric/metric.hpp"
#include "seamwire/metric/scribble.hpp"
#include "seamwire/seams/seam_planner.hpp"
#include "seamwire/surface/ray_tree.hpp"
#include "seamwire/surface/segments.hpp"
#include "seamwire/surface/surface.hpp"
#include "seamwire/wires/snap.hpp"
#include "seamwire/wires/wire.hpp"

using namespace seamwire;  // NOLINT(google-build-using-namespace): for the examples' sake

namespace {

constexpr int kAround = 24;
constexpr int kTube = 12;

/// A bumpy torus; vertex kTube * i + j is the j-th around the tube at the i-th of the places around the axis.
std::pair<std::vector<Vector>, std::vector<Triangle>> bumpy_torus() {
  std::vector<Vector> points;
  std::vector<Triangle> triangles;
  for (int i = 0; i < kAround; ++i) {
    for (int j = 0; j < kTube; ++j) {
      const double u = 2.0 * std::numbers::pi * i / kAround;
      const double v = 2.0 * std::numbers::pi * j / kTube;
      const double tube = 1.0 + 0.2 * std::cos(3.0 * u);
      points.emplace_back((3.0 + tube * std::cos(v)) * std::cos(u), (3.0 + tube * std::cos(v)) * std::sin(u),
                          tube * std::sin(v));
      const auto at = [](int a, int b) { return a % kAround * kTube + b % kTube; };
      triangles.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
      triangles.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
    }
  }
  return {points, triangles};
}

void say(const char* what, double number) { std::printf("%-44s %.4g\n", what, number); }

}  // namespace

int main() {
  const auto [points, triangles] = bumpy_torus();

  //! [surface]
  const auto surface = std::make_shared<const Surface>(points, triangles);
  say("edges", static_cast<double>(surface->edges().size()));
  say("boundary edges", static_cast<double>(surface->report().boundary_edges));
  //! [surface]

  //! [metric]
  const Curvature curvature = principal_curvatures(*surface);
  const Metric metric = feature_metric(*surface, curvature, Follow::kMax, {.max_anisotropy = 20.0});
  say("largest anisotropy", max_anisotropy(metric));
  //! [metric]

  //! [stroke]
  Scribble stroke;
  for (const std::int32_t vertex : {0, 1, 2, 3}) {
    stroke.points.push_back(points[static_cast<std::size_t>(vertex)]);
    stroke.vertices.push_back(vertex);
  }
  const Metric drawn = apply_scribbles(*surface, metric, std::vector{stroke});
  //! [stroke]
  say("vertices with a metric", static_cast<double>(drawn.size()));

  //! [embedding]
  const Embedding embedding = embed(*surface, metric);
  say("triangles added", static_cast<double>(embedding.faces_added));
  //! [embedding]

  //! [geodesics]
  const ExactGeodesics geodesics(embedding.mesh);
  const std::int32_t seed = 0;
  const std::int32_t target = kTube * (kAround / 2) + kTube / 2;
  const DistanceField field = geodesics.solve(seed);
  say("distance across the torus", field.distances()[static_cast<std::size_t>(target)]);
  //! [geodesics]

  //! [surface points]
  const SurfaceContext context(surface);  // curvature and all else that depends on the surface alone, computed once
  const EmbeddedSurface embedded(context, MetricSpec::feature(Follow::kMax, {.max_anisotropy = 20.0}));
  const auto on_face = [](std::int32_t face) { return SurfacePoint{.face = face, .barycentric = {0.2, 0.3, 0.5}}; };
  const std::vector<SurfacePoint> sources{on_face(0), on_face(40)};
  const SurfacePoint point = on_face(100);
  const EmbeddedField nearest = embedded.field(sources, {.targets = {point}});  // stops when that is known
  say("distance of a point of a face", nearest.distance(point));
  say("the same, along its wire", nearest.wire(point).length);
  //! [surface points]

  //! [first path]
  CorridorPaths paths(geodesics, seed);  // at once, without a field, and a little longer now and then
  say("length of a path found at once", paths.path(target).length);
  //! [first path]

  //! [wire]
  const Wire wire = trace_wire(*surface, embedding, field, target);
  const SnapGraph graph(*surface);
  const std::vector<std::int32_t> chain = snap_to_edges(*surface, graph, wire);
  say("edges to be marked as seams", static_cast<double>(chain.size() - 1));
  //! [wire]

  //! [edges]
  const auto edges = make_edge_graph(*surface, metric);
  const EdgeWires wires = edge_wires(edges, {.a = seed});
  say("edges of the best chain", static_cast<double>(wires.trace({.a = target}).vertices.size() - 1));
  //! [edges]

  //! [loops]
  const Edge edge{0, kTube};
  say("edges of the shortest cycle through an edge", static_cast<double>(shortest_cycle(*edges, edge).vertices.size()));
  const auto adjacency = make_edge_adjacency(*surface);
  say("vertices of its edge loop", static_cast<double>(edge_loop(*adjacency, edge, {}).vertices.size()));
  //! [loops]

  //! [live]
  LiveWire live(context, {.along = Along::kEdges,
                          .metrics = live_metrics(MetricFamily::kFeature, {.max_anisotropy = 10.0}, Along::kEdges)});
  live.seed({.a = seed});
  LiveWires both = live.wires({.a = target});  // returns at once, with what is there so far
  live.wait();
  both = live.wires({.a = target});
  say("the shorter of two live wires, edges",
      static_cast<double>(both.wires[static_cast<std::size_t>(both.active)].vertices.size() - 1));
  //! [live]

  //! [islands]
  const std::vector<std::int32_t> segments = face_segments(*surface, surface->edges());
  say("segments, were every edge a seam", static_cast<double>(1 + *std::ranges::max_element(segments)));
  //! [islands]

  //! [flatten]
  std::vector<Edge> cuts;
  for (std::int32_t j = 0; j < kTube; ++j) cuts.push_back({j, (j + 1) % kTube});  // around the tube
  for (std::int32_t i = 0; i < kAround; ++i) cuts.push_back({kTube * i, kTube * ((i + 1) % kAround)});  // and the axis
  const Flattening flat = flatten(*surface, cuts);
  say("energy of a UV map, 4 for an isometry", flat.energy);
  const MapReport report = measure_map(*surface, flat.uvs, flat.islands);
  say("flipped triangles", static_cast<double>(report.flipped.size()));
  //! [flatten]

  //! [seams]
  SeamPlannerOptions hidden{.along = Along::kEdges};
  hidden.front = Vector(0.0, 0.0, 1.0);  // towards the viewer
  const SeamPlanner planner(surface, hidden);
  const SeamPlan plan = planner.plan({.distortion = 4.2});  // the bound on the symmetric Dirichlet energy
  say("wires of a plan", static_cast<double>(plan.wires.size()));
  say("energy of its UV map", plan.energy);
  //! [seams]

  //! [rays]
  const RayTree rays(points, triangles);
  say("triangle under the cursor", rays.first_hit({3.0, 0.0, 9.0}, {0.0, 0.0, -1.0}).triangle);
  //! [rays]

  //! [task]
  std::stop_source stop;
  const Task task{.stop = stop.get_token(), .progress = [](double fraction) { return fraction < 2.0; }};
  say("distances, watched and to be stopped", static_cast<double>(geodesics.solve(seed, task).distances().size()));
  //! [task]
  return 0;
}
