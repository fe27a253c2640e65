// SPDX-License-Identifier: GPL-3.0-or-later
//
// Takes any mesh and any parameters. The library refuses them with InvalidInput, or its answers agree with each other.
// libFuzzer makes the bytes (scripts/fuzz); the test `fuzz_cases` runs those that once found something.

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>
#include <memory>
#include <optional>
#include <random>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "intrinsic.hpp"
#include "seamwire/edges/edge_loop.hpp"
#include "seamwire/edges/edge_wires.hpp"
#include "seamwire/edges/fit_chain.hpp"
#include "seamwire/edges/shortest_cycle.hpp"
#include "seamwire/embedding/embedding.hpp"
#include "seamwire/errors.hpp"
#include "seamwire/files/mesh_file.hpp"
#include "seamwire/geodesics/corridor_paths.hpp"
#include "seamwire/geodesics/exact_geodesics.hpp"
#include "seamwire/metric/crest_lines.hpp"
#include "seamwire/metric/curvature.hpp"
#include "seamwire/metric/metric.hpp"
#include "seamwire/metric/scribble.hpp"
#include "seamwire/surface/polygon_mesh.hpp"
#include "seamwire/surface/ray_tree.hpp"
#include "seamwire/surface/segments.hpp"
#include "seamwire/surface/surface.hpp"
#include "seamwire/task.hpp"
#include "seamwire/wires/bent_wires.hpp"
#include "seamwire/wires/closed_wires.hpp"
#include "seamwire/wires/snap.hpp"
#include "seamwire/wires/wire.hpp"
#include "seamwire_uv/maps/flatten.hpp"
#include "seamwire_uv/maps/measure_map.hpp"
#include "seamwire_uv/maps/pack.hpp"
#include "seamwire_uv/seams/seam_planner.hpp"

namespace seamwire {
namespace {

/// From when on one input's work is told to stop, in seconds of processor time. Meshes of spikes take long; that they
/// hear it is what is tested: what goes on all the same is a timeout of libFuzzer's.
constexpr std::clock_t kPatience = 3;

void require(bool holds, const char* what) {
  if (holds) return;
  std::fprintf(stderr, "does not hold: %s\n", what);
  std::abort();
}

/// Takes decisions from bytes; zeros when they are used up.
class Bytes {
 public:
  Bytes(const std::uint8_t* data, std::size_t size) : at_(data), end_(data + size) {}
  std::uint8_t byte() { return at_ == end_ ? 0 : *at_++; }
  /// In [0, count).
  std::int32_t below(std::size_t count) { return static_cast<std::int32_t>(byte() % count); }
  bool coin() { return (byte() & 1) != 0; }
  /// A number as meshes and people have them, or one of kNumbers.
  double number() {
    const std::uint8_t which = byte();
    return which < kNumbers.size() ? kNumbers[which] : (static_cast<double>(which) - 140.0) / 64.0;
  }
  /// A number of at least `least`, or one of kNumbers. Other numbers below it are moved, so that few inputs are
  /// refused.
  double at_least(double least) {
    const bool is_listed = at_ == end_ || *at_ < kNumbers.size();
    const double drawn = number();
    return is_listed || drawn >= least ? drawn : least + 8.0 * std::abs(drawn);
  }
  /// A number above 0 and up to 1, or one of kNumbers.
  double share() {
    const bool is_listed = at_ == end_ || *at_ < kNumbers.size();
    const double drawn = number();
    return is_listed || (drawn > 0.0 && drawn <= 1.0) ? drawn : 0.03125 + std::abs(drawn) / 2.0;
  }

 private:
  /// Numbers that are likely to break something.
  static constexpr std::array kNumbers{0.0,
                                       1.0,
                                       -1.0,
                                       0.5,
                                       2.0,
                                       1.0 / 3.0,
                                       1e-3,
                                       1e-6,
                                       1e-9,
                                       1e-12,
                                       1e3,
                                       1e6,
                                       1e9,
                                       1e39,
                                       1e-39,
                                       1e150,
                                       1e-150,
                                       1e160,
                                       -0.0,
                                       1.0001,
                                       -1e-7,
                                       5e-8,
                                       0.125,
                                       std::numeric_limits<double>::infinity(),
                                       std::numeric_limits<double>::quiet_NaN()};

  const std::uint8_t* at_;
  const std::uint8_t* end_;
};

struct Mesh {
  std::vector<Vector> points;
  std::vector<Triangle> triangles;
  std::optional<std::vector<Edge>> edges;
};

/// A grid of a few cells, bent by the numbers that follow.
Mesh grid(Bytes& from) {
  const std::int32_t columns = 2 + from.below(5);
  const std::int32_t rows = 2 + from.below(5);
  Mesh mesh;
  for (std::int32_t y = 0; y < rows; ++y) {
    for (std::int32_t x = 0; x < columns; ++x) mesh.points.emplace_back(x, y, from.number());
  }
  for (std::int32_t y = 0; y + 1 < rows; ++y) {
    for (std::int32_t x = 0; x + 1 < columns; ++x) {
      const std::int32_t a = y * columns + x;
      mesh.triangles.push_back({a, a + 1, a + columns + 1});
      mesh.triangles.push_back({a, a + columns + 1, a + columns});
    }
  }
  return mesh;
}

/// Triangles around a point, closed or not.
Mesh umbrella(Bytes& from) {
  const std::int32_t spokes = 3 + from.below(30);
  const double height = from.number();
  Mesh mesh;
  mesh.points.emplace_back(0.0, 0.0, height);
  for (std::int32_t i = 0; i < spokes; ++i) {
    const double turn = 6.283185307179586 * i / spokes;
    const double radius = from.coin() ? 1.0 : std::abs(from.number());
    mesh.points.emplace_back(radius * std::cos(turn), radius * std::sin(turn), 0.0);
  }
  const bool closed = from.coin();
  for (std::int32_t i = 0; i + (closed ? 0 : 1) < spokes; ++i)
    mesh.triangles.push_back({0, 1 + i, 1 + (i + 1) % spokes});
  return mesh;
}

/// Any triangles between any points.
Mesh soup(Bytes& from) {
  const std::size_t count = 3 + static_cast<std::size_t>(from.below(20));
  Mesh mesh;
  for (std::size_t i = 0; i < count; ++i) {
    const double x = from.number();
    const double y = from.number();
    mesh.points.emplace_back(x, y, from.number());
  }
  const std::int32_t triangles = 1 + from.below(40);
  for (std::int32_t i = 0; i < triangles; ++i) {
    const std::int32_t a = from.below(count);
    const std::int32_t b = from.below(count);
    mesh.triangles.push_back({a, b, from.below(count)});
  }
  return mesh;
}

/// A band that closes after half a turn or not, and whose sides may close too: a Moebius strip, a Klein bottle, a tube
/// or a torus.
Mesh band(Bytes& from) {
  const std::int32_t columns = 3 + from.below(6), rows = 1 + from.below(4);
  const bool turns = from.coin(), closes = from.coin() && rows > 2;
  const std::int32_t lines = closes ? rows : rows + 1;
  Mesh mesh;
  for (std::int32_t x = 0; x < columns; ++x) {
    const double angle = 6.283185307179586 * x / columns;
    for (std::int32_t y = 0; y < lines; ++y) {
      mesh.points.emplace_back(std::cos(angle) * (2.0 + y), std::sin(angle) * (2.0 + y), from.coin() ? 0.25 * y : 0.0);
    }
  }
  const auto at = [&](std::int32_t x, std::int32_t y) {
    if (x == columns) y = turns ? (closes ? rows : lines - 1) - y : y;
    return x % columns * lines + (y + lines) % lines;
  };
  for (std::int32_t x = 0; x < columns; ++x) {
    for (std::int32_t y = 0; y < rows; ++y) {
      mesh.triangles.push_back({at(x, y), at(x + 1, y), at(x + 1, y + 1)});
      mesh.triangles.push_back({at(x, y), at(x + 1, y + 1), at(x, y + 1)});
    }
  }
  return mesh;
}

/// Another triangle on some edges, and some triangles turned over.
void add_fins(Bytes& from, Mesh& mesh) {
  for (std::int32_t left = 1 + from.below(12); left > 0; --left) {
    const Triangle on = mesh.triangles[static_cast<std::size_t>(from.below(mesh.triangles.size()))];
    const auto side = static_cast<std::size_t>(from.below(3));
    const std::int32_t a = on[side], b = on[(side + 1) % 3];
    if (from.coin()) {
      mesh.triangles.push_back({a, b, from.below(mesh.points.size())});
    } else {
      const Vector middle = 0.5 * (mesh.points[static_cast<std::size_t>(a)] + mesh.points[static_cast<std::size_t>(b)]);
      mesh.triangles.push_back({b, a, static_cast<std::int32_t>(mesh.points.size())});
      mesh.points.emplace_back(middle + Vector(0.125, from.number(), 1.0));
    }
    if (from.coin()) std::swap(mesh.triangles.back()[0], mesh.triangles.back()[1]);
  }
}

/// Gives some triangles another vertex at the place of one of theirs, with needles on both sides.
void add_needles(Bytes& from, Mesh& mesh) {
  for (std::int32_t left = 1 + from.below(6); left > 0; --left) {
    const auto number = static_cast<std::size_t>(from.below(mesh.triangles.size()));
    const auto corner = static_cast<std::size_t>(from.below(3));
    const Triangle whole = mesh.triangles[number];
    const std::int32_t a = whole[corner], b = whole[(corner + 1) % 3], c = whole[(corner + 2) % 3];
    const auto added = static_cast<std::int32_t>(mesh.points.size());
    mesh.points.push_back(Vector(mesh.points[static_cast<std::size_t>(a)]));
    mesh.triangles[number] = {added, b, c};
    mesh.triangles.push_back({a, b, added});
    if (from.coin()) mesh.triangles.push_back({c, a, added});
  }
}

Mesh mesh_from(Bytes& from) {
  const std::uint8_t first = from.byte();
  const std::int32_t kind = first % 4;
  const bool has_needles = first >= 0x80 && first < 0xa0;
  const bool is_complex = has_needles || (first >= 0xb0 && first < 0xf0);
  Mesh mesh = is_complex && kind < 2 ? band(from) : kind == 0 ? soup(from) : kind == 1 ? umbrella(from) : grid(from);
  if (is_complex && kind > 0) add_fins(from, mesh);
  if (has_needles) add_needles(from, mesh);
  const std::size_t count = mesh.points.size();
  for (std::int32_t left = from.below(4); left > 0; --left) {
    mesh.points[static_cast<std::size_t>(from.below(count))][from.below(3)] = from.number();
  }
  for (std::int32_t left = from.below(3); left > 0; --left) {
    mesh.triangles.push_back({from.below(count), from.below(count), from.below(count + 1)});
  }
  if (from.coin()) {
    std::vector<Edge> edges;
    const auto add = [&](std::int32_t a, std::int32_t b) {
      if (a != b) edges.push_back({a, b});
    };
    for (const auto& [a, b, c] : mesh.triangles) {
      add(a, b);
      if (from.coin()) add(b, c);
    }
    for (std::int32_t left = from.below(4); left > 0; --left) {
      const std::int32_t a = from.below(count);
      add(a, from.below(count));
    }
    mesh.edges = std::move(edges);
  }
  return mesh;
}

Metric metric_from(Bytes& from, const Surface& surface, const Curvature& curvature, Follow follow) {
  Strength strength;
  if (from.coin()) {
    strength.parameter = from.at_least(0.0);
  } else {
    strength.max_anisotropy = from.at_least(1.0);
  }
  if (from.coin()) strength.clamp_percentile = 100.0 * from.share();
  switch (from.below(4)) {
    case 0:
      return feature_metric(surface, curvature, follow, strength);
    case 1:
      return campen_metric(surface, curvature, follow, strength);
    case 2:
      return pottmann_kovacs_metric(surface, curvature, follow, strength);
    default:
      if (!strength.parameter) return euclidean_metric(surface, curvature);
      return concave_metric(surface, smoothed_curvatures(surface, curvature, 0.01), *strength.parameter);
  }
}

Scribble scribble_from(Bytes& from, const Surface& surface) {
  Scribble scribble;
  for (std::int32_t left = from.below(6); left > 0; --left) {
    const std::int32_t vertex = from.below(surface.vertex_count());
    scribble.points.push_back(surface.points()[static_cast<std::size_t>(vertex)]);
    scribble.vertices.push_back(vertex);
  }
  scribble.eta = std::abs(from.at_least(1.0));
  scribble.rings = from.below(12);
  if (from.coin()) scribble.radius = from.at_least(0.01);
  scribble.attracts = from.coin();
  return scribble;
}

/// Stops work on this input when it has taken long enough.
class Patience {
 public:
  Task task() const {
    Task task;
    task.progress = [end = end_](double fraction) {
      require(fraction >= 0.0 && fraction <= 1.0, "progress is a fraction");
      return std::clock() < end;
    };
    return task;
  }

 private:
  std::clock_t end_ = std::clock() + kPatience * CLOCKS_PER_SEC;
};

/// Distances are lengths of paths: none is longer than where its edges lead.
void check_field(const IntrinsicMesh& mesh, const DistanceField& field) {
  // The square of a length must be a number with all its digits.
  if (std::ranges::any_of(mesh.lengths, [](double length) { return length < 1e-140; })) return;
  const std::vector<double>& distances = field.distances();
  const auto at = [&](std::int32_t vertex) { return distances[static_cast<std::size_t>(vertex)]; };
  require(at(field.seed()) == 0.0, "the seed's distance is 0");
  for (const double distance : distances) require(distance >= 0.0, "distances are not negative");
  const auto along = [&](std::int32_t a, std::int32_t b, double length) {
    require(std::isinf(at(a)) == std::isinf(at(b)), "what an edge joins is reached or not together");
    if (std::isinf(at(a))) return;
    require(std::abs(at(a) - at(b)) <= length * (1.0 + 1e-6) + 1e-9 * at(a), "no edge is a shorter way");
  };
  for (std::int32_t h = 0; h < static_cast<std::int32_t>(mesh.lengths.size()); ++h) {
    along(mesh.tail(h), mesh.tip(h), mesh.lengths[static_cast<std::size_t>(h)]);
  }
  for (const LooseEdge& edge : mesh.loose_edges) along(edge.a, edge.b, edge.length);
}

/// A pointer to an object that outlives what gets it.
template <class T>
std::shared_ptr<const T> held(const T& object) {
  return std::shared_ptr<const T>(std::shared_ptr<const T>(), &object);
}

/// The surface's own lengths, with all triangles that have an area in their own.
std::optional<IntrinsicMesh> own_lengths(const Surface& surface) {
  const auto length = [&](std::int32_t a, std::int32_t b) {
    return surface.scale() *
           (surface.points()[static_cast<std::size_t>(a)] - surface.points()[static_cast<std::size_t>(b)]).norm();
  };
  for (const auto& [a, b, c] : surface.triangles()) {
    std::array<double, 3> sorted{length(a, b), length(b, c), length(c, a)};
    std::ranges::sort(sorted);
    if (!(sorted[0] > 1e-6) || !(sorted[0] + sorted[1] - sorted[2] > 1e-6 * sorted[2])) return std::nullopt;
  }
  return shapes::intrinsic({.points = surface.points(), .triangles = surface.triangles()}, length);
}

/// Exact geodesics on the triangles as they are, over every edge.
void check_geodesics(const Patience& patience, const Surface& surface) {
  const std::optional<IntrinsicMesh> mesh = own_lengths(surface);
  if (!mesh || mesh->triangles.empty()) throw InvalidInput("the triangles are too thin for a metric of their own");
  const ExactGeodesics solver(*mesh);
  const std::int32_t seed = mesh->triangles.front()[0], other = mesh->triangles.back()[2];
  const DistanceField field = solver.solve(seed, patience.task()), back = solver.solve(other, patience.task());
  check_field(*mesh, field);
  const auto is_near = [](double a, double b) { return a == b || std::abs(a - b) <= 1e-6 * (a + b) + 1e-9; };
  require(is_near(field.distances()[static_cast<std::size_t>(other)], back.distances()[static_cast<std::size_t>(seed)]),
          "it is as far there as back");
  CorridorPaths quick(solver, seed);
  for (std::int32_t v = 0; v < mesh->vertex_count; ++v) {
    const double distance = field.distances()[static_cast<std::size_t>(v)];
    const std::optional<IntrinsicPath> exact = field.trace(v, patience.task()), path = quick.path(v, patience.task());
    require(!exact == std::isinf(distance) && !path == std::isinf(distance), "every reachable vertex has paths");
    if (!exact) continue;
    require(is_near(exact->length, distance), "a path is as long as the distance");
    require(path->length >= distance * (1.0 - 1e-6) - 1e-12, "no path is shorter than the distance");
  }
}

void check_wires(Bytes& from, const Patience& patience, const Surface& surface, const Metric& metric) {
  EmbedOptions options;
  options.max_faces_added = static_cast<std::size_t>(from.byte()) * 40;
  options.max_error = from.coin() ? 0.0 : from.share();
  if (from.coin()) options.max_error = 0.0;  // refined embeddings take longer
  const Embedding embedding = embed(surface, metric, options, patience.task());
  require(embedding.worst_clamp >= 1.0, "a factor is one or more");
  const ExactGeodesics solver(embedding.mesh);
  const std::int32_t seed = from.below(surface.vertex_count());
  const DistanceField field = solver.solve(seed, patience.task());
  check_field(embedding.mesh, field);
  for (const ClosedWire& loop : closed_wires(surface, embedding, field, 3, patience.task())) {
    require(!loop.wire.points.empty() && loop.wire.points.front() == loop.wire.points.back(),
            "a closed wire is closed");
    require(std::isfinite(loop.wire.length), "a closed wire has a length");
    const BentWires bent(held(surface), held(embedding), solver, field, loop, patience.task());
    const SurfacePoint second = SurfacePoint(from.below(surface.vertex_count()));
    if (const std::optional<BentWire> found = bent.through(second, patience.task())) {
      require(found->there.points.back() == found->back.points.front() &&
                  found->back.points.back() == found->there.points.front(),
              "a bent wire is closed");
    }
  }
  CorridorPaths quick(solver, seed);
  for (std::int32_t left = 1 + from.below(3); left > 0; --left) {
    const std::int32_t target = from.below(surface.vertex_count());
    const double distance = field.distances()[static_cast<std::size_t>(target)];
    const std::optional<Wire> wire = trace_wire(surface, embedding, field, target, patience.task());
    require(!wire == std::isinf(distance), "what is reached has a wire");
    if (!wire) continue;
    require(wire->from == seed && wire->to == target, "a wire leads from the seed to the target");
    require(wire->length <= distance * 1.5 + 1e-9, "an exact wire is about as long as the distance");
    const std::optional<IntrinsicPath> path = quick.path(target, patience.task());
    require(path.has_value(), "every reachable vertex has a path at once");
    require(path->length >= distance * (1.0 - 1e-6) - 1e-12, "no path is shorter than the distance");
    const std::vector<std::int32_t> chain = snap_to_edges(surface, *wire);
    require(std::set(chain.begin(), chain.end()).size() == chain.size(), "a snapped wire repeats no vertex");
  }
}

bool is_edge(const Surface& surface, std::int32_t a, std::int32_t b) {
  return std::ranges::binary_search(surface.edges(), Edge{std::min(a, b), std::max(a, b)});
}

void check_chain(const Surface& surface, const std::vector<std::int32_t>& chain) {
  for (std::size_t i = 1; i < chain.size(); ++i) {
    require(is_edge(surface, chain[i - 1], chain[i]), "a chain runs along edges");
  }
}

void check_edge_wires(Bytes& from, const Patience& patience, const Surface& surface, const Metric& metric,
                      const std::vector<Scribble>& scribbles) {
  const auto adjacency = make_edge_adjacency(surface, patience.task());
  const auto graph = make_edge_graph(surface, metric, adjacency, scribbles, std::nullopt, patience.task());
  const auto pick = [&]() -> Pick {
    if (surface.edges().empty() || from.coin()) return {from.below(surface.vertex_count()), -1};
    const Edge& edge = surface.edges()[static_cast<std::size_t>(from.below(surface.edges().size()))];
    return from.coin() ? Pick{edge[0], edge[1]} : Pick{edge[1], edge[0]};
  };
  const double turning = from.coin() ? 3.0 : std::abs(from.number());
  const EdgeWires wires = edge_wires(graph, pick(), turning, from.coin(), patience.task());
  for (std::int32_t left = 1 + from.below(3); left > 0; --left) {
    const Pick target = pick();
    require(wires.is_final(target), "a search that has ended knows all");
    if (const std::optional<EdgeChain> chain = wires.trace(target)) check_chain(surface, chain->vertices);
  }
  if (surface.edges().empty()) return;
  const Edge& edge = surface.edges()[static_cast<std::size_t>(from.below(surface.edges().size()))];
  std::vector<std::int32_t> stops;
  for (std::int32_t left = from.below(3); left > 0; --left) stops.push_back(from.below(surface.vertex_count()));
  check_chain(surface, edge_loop(*adjacency, edge, stops).vertices);
  check_chain(surface, extend_straight(*adjacency, edge, stops));
  const std::vector<std::int32_t> loop =
      shortest_cycle(*graph, edge, turning, patience.task()).value_or(EdgeChain{}).vertices;
  check_chain(surface, loop);
  require(loop.empty() || (loop.size() > 2 && is_edge(surface, loop.front(), loop.back())), "a loop is closed");
  for (const Scribble& scribble : scribbles) {
    const bool in_faces = scribble.faces.size() == scribble.points.size() &&
                          std::ranges::all_of(scribble.faces, [](std::int32_t face) { return face >= 0; });
    if (!in_faces) continue;
    const FittedChain fitted = fit_chain(surface, *adjacency, {scribble.points, scribble.faces});
    check_chain(surface, fitted.vertices);
    require(fitted.places.size() == fitted.vertices.size(), "each vertex of a fitted chain has a place");
  }
}

void check_plan(Bytes& from, const Patience& patience, const Surface& surface) {
  SeamPlannerOptions options{.along = from.coin() ? Along::kSurface : Along::kEdges};
  options.strength = {.max_anisotropy = 1.0 + static_cast<double>(from.byte()) / 8.0};
  options.mirror = from.below(4) - 1;
  if (from.coin()) options.front = Vector(1.0 + std::abs(from.number()), 0.5, 0.25);
  if (from.coin()) {
    for (std::size_t v = 0; v < surface.vertex_count(); ++v) {
      options.weights.push_back(from.below(6) == 0 ? std::numeric_limits<double>::infinity() : 1.0);
    }
  }
  for (std::int32_t left = from.below(4); left > 0; --left) {
    options.seams.push_back({from.below(surface.vertex_count()), from.below(surface.vertex_count())});
  }
  const SeamPlanner planner(std::make_shared<const Surface>(surface), options, patience.task());
  SeamGoal goal;
  const double bound = 4.0 + 0.01 * (1.0 + static_cast<double>(from.byte()));
  goal.distortion = from.coin() ? bound : std::numeric_limits<double>::infinity();
  goal.islands = static_cast<std::size_t>(from.below(6));
  goal.steps = 1 + static_cast<std::size_t>(from.below(60));
  const SeamPlan plan = planner.plan(goal, {}, patience.task());
  require(plan.uvs.size() == surface.face_count(), "each face has UVs");
  for (const auto& corners : plan.uvs) {
    require(std::ranges::all_of(corners, [](const Eigen::Vector2d& uv) { return uv.allFinite(); }), "UVs are finite");
  }
  require(plan.cost >= 0.0 && plan.energy >= 4.0 - 1e-6, "a plan has a cost and an energy");
  require(plan.islands.size() == surface.face_count(), "each face is in an island");
  for (const PlannedWire& wire : plan.wires) {
    check_chain(surface, wire.vertices);
    require(wire.vertices.front() == wire.from && wire.vertices.back() == wire.to, "a wire runs from seed to seed");
  }
}

void check_map(Bytes& from, const Patience& patience, const Surface& surface) {
  std::vector<Edge> cuts;
  for (const Edge& edge : surface.edges()) {
    if (from.below(4) == 0) cuts.push_back(edge);
  }
  FlattenOptions options;
  options.keep_apart = from.coin();
  options.max_steps = static_cast<std::size_t>(from.below(40));
  Flattening flat = flatten(surface, cuts, options, patience.task());
  const auto check_sound = [&] {
    require(flat.uvs.size() == surface.face_count(), "each face has UVs");
    for (const auto& corners : flat.uvs) {
      for (const Eigen::Vector2d& uv : corners) require(uv.allFinite(), "UVs are finite");
    }
    const MapReport report = measure_map(surface, flat.uvs, flat.islands);
    require(report.flipped.empty(), "no triangle is flipped");
  };
  check_sound();
  options.start = flat.uvs;
  flat = flatten(surface, cuts, options, patience.task());
  check_sound();
  const PackOptions packed{.turns = from.coin() ? PackTurns::kQuarters : PackTurns::kAny};
  const Packing packing = pack_islands(flat.uvs, flat.islands, packed, patience.task());
  for (std::size_t f = 0; f < flat.uvs.size(); ++f) {
    const auto& placement = packing.placements[static_cast<std::size_t>(flat.islands[f])];
    for (const Eigen::Vector2d& uv : flat.uvs[f]) {
      const Eigen::Vector2d place = placement * uv.homogeneous();
      require(place.minCoeff() > -1e-6 && place.maxCoeff() < 1.0 + 1e-6, "islands lie in the square");
    }
  }
}

PolygonMesh polygons_of(Bytes& from, const Mesh& mesh) {
  PolygonMesh polygons{.points = mesh.points, .corners = {}, .sizes = {}, .colors = {}};
  for (const Triangle& triangle : mesh.triangles) {
    polygons.corners.insert(polygons.corners.end(), triangle.begin(), triangle.end());
    polygons.sizes.push_back(3);
  }
  if (from.coin()) polygons.colors.assign(mesh.points.size(), {0.0, 0.2, 1.0});
  return polygons;
}

bool is_same(const PolygonMesh& one, const PolygonMesh& other) {
  return one.points == other.points && one.corners == other.corners && one.sizes == other.sizes;
}

/// Changes, removes, repeats or inserts a few characters of a file.
void damage(Bytes& from, std::string& file) {
  static constexpr std::array kWords{"-", ".", "e999", "/", "#", "\\", "\n", "0", "99999999999", " ", "\r", "\xff"};
  for (std::int32_t left = 1 + from.below(4); left > 0 && !file.empty(); --left) {
    const std::size_t place = (256U * from.byte() + from.byte()) % file.size(), length = 1 + from.byte() / 16U;
    const std::int32_t kind = from.below(4);
    if (kind == 0) file[place] = static_cast<char>(from.byte());
    if (kind == 1) file.erase(place, length);
    if (kind == 2) file.insert(place, std::string(file.substr(place, length)));
    if (kind == 3) file.insert(place, kWords[static_cast<std::size_t>(from.below(kWords.size()))]);
  }
}

/// A mesh that is written and read stays the same. A damaged file is refused, or its mesh is valid.
void check_files(Bytes& from, const Mesh& mesh) {
  static constexpr std::array kEndings{".obj", ".ply", ".off", ".stl"};
  static const std::string name = "seamwire-fuzz-" + std::to_string(std::random_device()());
  const auto kind = static_cast<std::size_t>(from.below(kEndings.size()));
  const std::filesystem::path path = std::filesystem::temp_directory_path() / (name + kEndings[kind]);
  const PolygonMesh polygons = polygons_of(from, mesh);
  write_mesh(path, polygons);
  // STL has no vertices that triangles share.
  if (kEndings[kind] != std::string(".stl")) require(is_same(read_mesh(path), polygons), "a file has what was written");
  std::ifstream whole(path, std::ios::binary);
  std::string file{std::istreambuf_iterator<char>(whole), {}};
  whole.close();
  damage(from, file);
  std::ofstream(path, std::ios::binary) << file;
  std::optional<PolygonMesh> found;
  try {
    found = read_mesh(path);
  } catch (const FileError&) {
  }
  std::filesystem::remove(path);
  if (!found) return;
  check(*found);
  polygon_edges(*found);
  make_surface(*found);
}

void check_rays(Bytes& from, const Mesh& mesh) {
  const RayTree tree(mesh.points, mesh.triangles);
  const Vector origin{from.number(), from.number(), from.number()};
  const Vector direction{from.number(), from.number(), from.number()};
  const RayHit before = tree.first_hit(origin, direction);
  tree.wait();
  const RayHit after = tree.first_hit(origin, direction);
  require(before.triangle == after.triangle, "the tree finds what looking at all triangles does");
}

void check_curvature(const Surface& surface) {
  const Curvature curvature = principal_curvatures(surface);
  for (std::size_t v = 0; v < curvature.k1.size(); ++v) {
    require(std::isfinite(curvature.k1[v]) && std::isfinite(curvature.k2[v]), "curvatures are finite");
  }
  for (const double least_drop : {0.0, 0.15}) {
    const CrestLines lines = crest_lines(surface, curvature, {.least_strength = 0.0, .least_drop = least_drop});
    for (std::size_t i = 0; i < lines.strengths.size(); ++i) {
      require(lines.starts[i] + 1 < lines.starts[i + 1] && std::isfinite(lines.strengths[i]),
              "crest lines have a length");
    }
    for (const Vector& point : lines.points) require(point.allFinite(), "crest lines are finite");
  }
  face_segments(surface, surface.edges());
}

/// Each input tries one part of the library on its mesh.
enum class Part : std::uint8_t { kSurface, kFiles, kGeodesics, kEdgeWires, kWires, kMap, kPlan };
constexpr std::array kPartNames{"surface", "files", "geodesics", "edge wires", "wires", "map", "plan"};
/// How many of 32 inputs try each part. A plan takes 60 times as long as the first part.
constexpr std::array kPartShares{7, 3, 8, 8, 3, 2, 1};

Part part_from(Bytes& from) {
  std::int32_t left = from.below(32);
  std::uint8_t part = 0;
  while (left >= kPartShares[part]) left -= kPartShares[part++];
  return static_cast<Part>(part);
}

void try_part(Bytes& from, Part part) {
  const Patience patience;
  const Mesh mesh = mesh_from(from);
  if (part == Part::kSurface) check_rays(from, mesh);
  if (part == Part::kFiles) return check_files(from, mesh);
  const Surface surface(mesh.points, mesh.triangles, mesh.edges);
  if (part == Part::kSurface) return check_curvature(surface);
  if (part == Part::kGeodesics) return check_geodesics(patience, surface);
  if (part == Part::kMap) return check_map(from, patience, surface);
  if (part == Part::kPlan) return check_plan(from, patience, surface);
  const Follow follow = from.coin() ? Follow::kMin : Follow::kMax;
  Metric metric = metric_from(from, surface, principal_curvatures(surface), follow);
  std::vector<Scribble> scribbles;
  for (std::int32_t left = from.below(3); left > 0; --left) scribbles.push_back(scribble_from(from, surface));
  metric = apply_scribbles(surface, metric, scribbles);
  if (part == Part::kEdgeWires) return check_edge_wires(from, patience, surface, metric, scribbles);
  check_wires(from, patience, surface, metric);
}

struct Outcomes {
  std::size_t at_the_end = 0, refused = 0, out_of_time = 0;
  void print(const char* part) const {
    std::fprintf(stderr, "%-10s %8zu inputs: %zu reached the end, %zu were refused, %zu ran out of time\n", part,
                 at_the_end + refused + out_of_time, at_the_end, refused, out_of_time);
  }
};

/// Prints what became of the inputs of each part, and of all, when the program ends.
struct Tally {
  std::array<Outcomes, kPartNames.size()> parts;
  ~Tally() {
    Outcomes all;
    for (std::size_t i = 0; i < parts.size(); ++i) {
      parts[i].print(kPartNames[i]);
      all.at_the_end += parts[i].at_the_end;
      all.refused += parts[i].refused;
      all.out_of_time += parts[i].out_of_time;
    }
    all.print("all");
  }
};

}  // namespace
}  // namespace seamwire

// NOLINTNEXTLINE(readability-identifier-naming): libFuzzer calls it so
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static seamwire::Tally tally;
  seamwire::Bytes bytes(data, size);
  const seamwire::Part part = seamwire::part_from(bytes);
  seamwire::Outcomes& outcomes = tally.parts[static_cast<std::size_t>(part)];
  try {
    seamwire::try_part(bytes, part);
    ++outcomes.at_the_end;
  } catch (const seamwire::InvalidInput&) {
    ++outcomes.refused;
  } catch (const seamwire::Cancelled&) {
    ++outcomes.out_of_time;
  }
  return 0;
}
