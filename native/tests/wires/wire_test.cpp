// SPDX-License-Identifier: GPL-3.0-or-later
#include "seamwire/wires/wire.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <queue>
#include <set>

#include "seamwire/geodesics/exact_geodesics.hpp"
#include "seamwire/metric/metric.hpp"
#include "seamwire/wires/snap.hpp"
#include "shapes.hpp"

namespace seamwire {
namespace {

std::size_t index(std::int32_t i) { return static_cast<std::size_t>(i); }

Embedding embed_features(const Surface& surface, Follow follow, double max_anisotropy) {
  return embed(surface,
               feature_metric(surface, principal_curvatures(surface), follow,
                              {.parameter = {}, .max_anisotropy = max_anisotropy}),
               {.max_error = 0});
}

Embedding embed_euclidean(const Surface& surface) {
  return embed(surface, euclidean_metric(surface, principal_curvatures(surface)), {.max_error = 0});
}

double distance_to_segment(const Vector& p, const Vector& a, const Vector& b) {
  const Vector along = b - a;
  const double length2 = along.squaredNorm();
  const double t = length2 > 0 ? std::clamp((p - a).dot(along) / length2, 0.0, 1.0) : 0.0;
  return (p - a - t * along).norm();
}

double distance_to_triangle(const Vector& p, const Vector& a, const Vector& b, const Vector& c) {
  const Vector normal = (b - a).cross(c - a).normalized();
  const Vector q = p - (p - a).dot(normal) * normal;
  const bool inside = (b - a).cross(q - a).dot(normal) >= 0 && (c - b).cross(q - b).dot(normal) >= 0 &&
                      (a - c).cross(q - c).dot(normal) >= 0;
  const double to_rim =
      std::min({distance_to_segment(p, a, b), distance_to_segment(p, b, c), distance_to_segment(p, c, a)});
  return inside ? std::min((p - q).norm(), to_rim) : to_rim;
}

double distance_to_face(const Surface& surface, std::int32_t face, const Vector& p) {
  const auto& [a, b, c] = surface.triangles()[index(face)];
  return distance_to_triangle(p, surface.points()[index(a)], surface.points()[index(b)], surface.points()[index(c)]);
}

double distance_to_wire(const Wire& wire, const Vector& p) {
  double least = (p - wire.points[0]).norm();
  for (std::size_t i = 1; i < wire.points.size(); ++i) {
    least = std::min(least, distance_to_segment(p, wire.points[i - 1], wire.points[i]));
  }
  return least;
}

/// What snapping minimises beside turns, by brute force.
double closeness(const Surface& surface, const Wire& wire, std::int32_t a, std::int32_t b) {
  constexpr int kSamples = 400;
  const Vector &p = surface.points()[index(a)], &q = surface.points()[index(b)];
  double sum = 0;
  for (int i = 0; i < kSamples; ++i) {
    const double t = (i + 0.5) / kSamples;
    sum += distance_to_wire(wire, (1 - t) * p + t * q);
  }
  return sum * (q - p).norm() / kSamples;
}

/// The edges of the faces that a wire crosses and of the faces that share an edge with those. Every edge of a triangle
/// must be real.
std::set<Edge> band_of(const Surface& surface, const Wire& wire) {
  const auto sides = [&](std::int32_t face) {
    const auto& [a, b, c] = surface.triangles()[index(face)];
    return std::array<Edge, 3>{Edge{std::min(a, b), std::max(a, b)}, Edge{std::min(b, c), std::max(b, c)},
                               Edge{std::min(c, a), std::max(c, a)}};
  };
  std::set<Edge> crossed;
  for (const std::int32_t face : wire.faces) {
    for (const Edge& edge : sides(face)) crossed.insert(edge);
  }
  std::set<Edge> band = crossed;
  for (std::int32_t f = 0; index(f) < surface.face_count(); ++f) {
    const auto edges = sides(f);
    if (std::any_of(edges.begin(), edges.end(), [&](const Edge& e) { return crossed.contains(e); })) {
      band.insert(edges.begin(), edges.end());
    }
  }
  return band;
}

Edge sorted(std::int32_t a, std::int32_t b) { return {std::min(a, b), std::max(a, b)}; }

void expect_chain(const Surface& surface, const std::vector<std::int32_t>& path, std::int32_t from, std::int32_t to) {
  ASSERT_FALSE(path.empty());
  EXPECT_EQ(path.front(), from);
  EXPECT_EQ(path.back(), to);
  for (std::size_t i = 1; i < path.size(); ++i) {
    EXPECT_TRUE(std::binary_search(surface.edges().begin(), surface.edges().end(), sorted(path[i - 1], path[i])))
        << path[i - 1] << " " << path[i];
  }
  EXPECT_EQ(std::set<std::int32_t>(path.begin(), path.end()).size(), path.size()) << "a vertex twice";
}

/// One triangle of the caller's, in an embedding bisected at the midpoint 3 of its edge 0 1.
struct Bisected {
  Surface surface{{{0, 0, 0}, {2, 0, 0}, {1, 1, 0}}, {{0, 1, 2}}};
  Embedding embedding;

  Bisected() {
    embedding.mesh = {{.triangles = {{0, 3, 2}, {3, 1, 2}}, .twins = {-1, 5, -1, -1, -1, 1}},
                      4,
                      {1, 1, std::numbers::sqrt2, 1, std::numbers::sqrt2, 1},
                      {{1, 3, 1}}};
    embedding.points = {{0, 0, 0}, {2, 0, 0}, {1, 1, 0}, {1, 0, 0}};
    embedding.source_face = {0, 0};
  }
};

TEST(MapWire, LeavesOutPointsOnAStraightLineInOneFace) {
  const Bisected on;
  const IntrinsicPath straight{.points = {{.vertex = 0}, {.vertex = 3}, {.vertex = 1}}, .faces = {0, 1}, .length = 2};
  const Wire wire = map_wire(on.surface, on.embedding, straight);
  ASSERT_EQ(wire.points.size(), 2u);
  EXPECT_EQ(wire.points[1], Vector(2, 0, 0));
  EXPECT_EQ(wire.vertices, (std::vector<std::int32_t>{0, 1}));
  EXPECT_EQ(wire.faces, (std::vector<std::int32_t>{0}));
  EXPECT_EQ(wire.length, 2);
  EXPECT_DOUBLE_EQ(wire.euclidean_length, 2);
  EXPECT_EQ(wire.from, 0);
  EXPECT_EQ(wire.to, 1);
}

TEST(MapWire, KeepsTurnsInsideAFace) {
  const Bisected on;
  const IntrinsicPath bent{.points = {{.vertex = 0}, {.half_edge = 1, .t = 0.25}, {.vertex = 1}}, .faces = {0, 1}};
  const Wire wire = map_wire(on.surface, on.embedding, bent);
  ASSERT_EQ(wire.points.size(), 3u);
  EXPECT_EQ(wire.points[1], Vector(1, 0.25, 0));
  EXPECT_EQ(wire.vertices, (std::vector<std::int32_t>{0, -1, 1}));
  EXPECT_EQ(wire.faces, (std::vector<std::int32_t>{0, 0}));
  EXPECT_NEAR(wire.euclidean_length, 2 * std::hypot(1, 0.25), 1e-15);
}

TEST(MapWire, LeavesOutPointsThatAreOne) {
  const Bisected on;
  const IntrinsicPath path{.points = {{.vertex = 0}, {.half_edge = 1, .t = 1}, {.vertex = 2}}, .faces = {0, 1}};
  const Wire wire = map_wire(on.surface, on.embedding, path);
  EXPECT_EQ(wire.vertices, (std::vector<std::int32_t>{0, 2}));
  EXPECT_EQ(wire.faces, (std::vector<std::int32_t>{0}));
}

TEST(MapWire, AnEdgeWithoutAFaceHasNone) {
  const Bisected on;
  const IntrinsicPath path{.points = {{.vertex = 2}, {.vertex = 3}, {.vertex = 1}}, .faces = {1, -1}};
  EXPECT_EQ(map_wire(on.surface, on.embedding, path).faces, (std::vector<std::int32_t>{0, -1}));
}

TEST(TraceWire, IsTheSeedAloneOrNothingWhereThereIsNoPath) {
  const auto two = [] {
    shapes::Mesh mesh = shapes::grid(2);
    const auto n = static_cast<std::int32_t>(mesh.points.size());
    for (std::size_t i = 0, end = mesh.points.size(); i < end; ++i) mesh.points.emplace_back(mesh.points[i] * 2);
    for (std::size_t f = 0, end = mesh.triangles.size(); f < end; ++f) {
      const auto [a, b, c] = mesh.triangles[f];
      mesh.triangles.push_back({a + n, b + n, c + n});
    }
    return mesh.surface();
  }();
  const Embedding embedding = embed_euclidean(two);
  const DistanceField field = ExactGeodesics(embedding.mesh).solve(4);
  const Wire here = trace_wire(two, embedding, field, 4).value();
  EXPECT_EQ(here.points, (std::vector<Vector>{two.points()[4]}));
  EXPECT_EQ(here.length, 0);
  EXPECT_EQ(here.euclidean_length, 0);
  EXPECT_EQ(snap_to_edges(two, here), (std::vector<std::int32_t>{4}));
  EXPECT_FALSE(trace_wire(two, embedding, field, 10));
  EXPECT_THROW(snap_to_edges(two, Wire{}), InvalidInput);
  EXPECT_THROW(trace_wire(two, embedding, field, 18), InvalidInput);
  EXPECT_THROW(trace_wire(two, embedding, field, -1), InvalidInput);
}

TEST(TraceWire, MayStartAtANewVertexOfTheEmbedding) {
  const Bisected on;
  const DistanceField field = ExactGeodesics(on.embedding.mesh).solve(3);
  for (const std::int32_t to : {0, 1, 2}) {
    const Wire wire = trace_wire(on.surface, on.embedding, field, to).value();
    EXPECT_EQ(wire.points, (std::vector<Vector>{{1, 0, 0}, on.surface.points()[index(to)]}));
    EXPECT_EQ(wire.vertices, (std::vector<std::int32_t>{-1, to}));
    EXPECT_EQ(wire.faces, (std::vector<std::int32_t>{0}));
    EXPECT_EQ(wire.from, -1);
    EXPECT_EQ(wire.to, to);
    EXPECT_EQ(wire.length, 1);
  }
}

TEST(TraceWire, RefusesWhatDoesNotBelongTogether) {
  const Bisected on;
  const DistanceField field = ExactGeodesics(on.embedding.mesh).solve(0);
  const Surface other = shapes::grid(3).surface();
  const Embedding of_other = embed_euclidean(other);
  EXPECT_THROW(trace_wire(other, on.embedding, field, 1).value(), InvalidInput) << "a surface of more vertices";
  EXPECT_THROW(trace_wire(Surface({{0, 1, 0}, {2, 0, 0}, {1, 1, 0}}, {{0, 1, 2}}), on.embedding, field, 1).value(),
               InvalidInput)
      << "of vertices elsewhere";
  EXPECT_THROW(trace_wire(on.surface, on.embedding, ExactGeodesics(of_other.mesh).solve(0), 1).value(), InvalidInput);
  const auto map = [&](const IntrinsicPath& path) { return map_wire(on.surface, on.embedding, path); };
  EXPECT_THROW(map({}), InvalidInput) << "no points";
  EXPECT_THROW(map({.points = {{.vertex = 0}, {.vertex = 4}}, .faces = {0}}), InvalidInput) << "a vertex too far";
  EXPECT_THROW(map({.points = {{.vertex = 0}, {.half_edge = 6, .t = 0.5}}, .faces = {0}}), InvalidInput) << "an edge";
  EXPECT_THROW(map({.points = {{.vertex = 0}, {.vertex = 3}}, .faces = {2}}), InvalidInput) << "a face";
  EXPECT_THROW(map({.points = {{.vertex = 0}, {.vertex = 3}}, .faces = {}}), InvalidInput) << "no faces";
}

TEST(TraceWire, OnAPlaneIsTheStraightLine) {
  const Surface surface = shapes::grid(12, 0.3).surface();
  const Embedding embedding = embed_euclidean(surface);
  const DistanceField field = ExactGeodesics(embedding.mesh).solve(0);
  for (std::int32_t v = 1; index(v) < surface.vertex_count(); ++v) {
    const Wire wire = trace_wire(surface, embedding, field, v).value();
    const double expected = surface.points()[index(v)].norm();
    EXPECT_NEAR(wire.length, expected, 1e-9 * expected);
    EXPECT_NEAR(wire.euclidean_length, expected, 1e-9 * expected);
    for (const Vector& p : wire.points) {
      EXPECT_LT(distance_to_segment(p, {0, 0, 0}, surface.points()[index(v)]), 1e-7) << v;
    }
  }
}

struct Case {
  const char* name;
  shapes::Mesh mesh;
  Follow follow;
  double max_anisotropy;
};

/// Meshes in metrics so strong that some of their embeddings are refined.
std::vector<Case> strong_cases() {
  return {{"torus, min", shapes::torus(40, 24), Follow::kMin, 8},
          {"torus, max", shapes::torus(40, 24), Follow::kMax, 15},
          {"cylinder, max", shapes::cylinder(24, 10), Follow::kMax, 6},
          {"sphere", shapes::icosphere(3), Follow::kMin, 5}};
}

TEST(TraceWire, LiesOnTheFacesItNamesAndIsAsLongAsTheDistance) {
  std::size_t faces_added = 0;
  for (const Case& c : strong_cases()) {
    const Surface surface = c.mesh.surface();
    const Embedding embedding = embed_features(surface, c.follow, c.max_anisotropy);
    faces_added += embedding.faces_added;
    const DistanceField field = ExactGeodesics(embedding.mesh).solve(3);
    for (std::int32_t v = 0; index(v) < surface.vertex_count(); ++v) {
      const Wire wire = trace_wire(surface, embedding, field, v).value();
      ASSERT_FALSE(wire.points.empty()) << c.name << " " << v;
      ASSERT_EQ(wire.faces.size() + 1, wire.points.size());
      ASSERT_EQ(wire.vertices.size(), wire.points.size());
      EXPECT_EQ(wire.points.front(), surface.points()[3]);
      EXPECT_EQ(wire.points.back(), surface.points()[index(v)]);
      EXPECT_NEAR(wire.length, field.distances()[index(v)], 1e-9 * wire.length) << c.name << " " << v;
      double length = 0;
      for (std::size_t i = 0; i < wire.faces.size(); ++i) {
        ASSERT_GE(wire.faces[i], 0);
        // Both ends in the face, so all of the segment; rounding of midpoints of coordinates below 1.
        for (const Vector& p : {wire.points[i], wire.points[i + 1]}) {
          ASSERT_LT(distance_to_face(surface, wire.faces[i], p), 1e-12) << c.name << " " << v << " " << i;
        }
        length += (wire.points[i + 1] - wire.points[i]).norm();
      }
      EXPECT_NEAR(wire.euclidean_length, length, 1e-12);
      for (std::size_t i = 0; i < wire.points.size(); ++i) {
        if (wire.vertices[i] < 0) continue;
        EXPECT_EQ(wire.points[i], surface.points()[index(wire.vertices[i])]);
      }
    }
  }
  EXPECT_GT(faces_added, 1000u) << "or no wire ran over refined faces";
}

/// A wire through the given points of a flat grid, of which the ends are vertices.
Wire polyline(std::int32_t from, std::vector<Vector> points, std::int32_t to, std::vector<std::int32_t> faces) {
  Wire wire{.from = from, .to = to, .points = std::move(points), .vertices = {}, .faces = std::move(faces)};
  wire.vertices.assign(wire.points.size(), -1);
  wire.vertices.front() = from;
  wire.vertices.back() = to;
  wire.euclidean_length = 0;
  for (std::size_t i = 1; i < wire.points.size(); ++i) {
    wire.euclidean_length += (wire.points[i] - wire.points[i - 1]).norm();
  }
  return wire;
}

TEST(SnapToEdges, AWireAlongEdgesSnapsToThem) {
  const Surface surface = shapes::grid(8).surface();
  const Embedding embedding = embed_euclidean(surface);
  const DistanceField field = ExactGeodesics(embedding.mesh).solve(4 * 9);  // half way up the left side
  const auto path = snap_to_edges(surface, trace_wire(surface, embedding, field, 4 * 9 + 8).value());
  std::vector<std::int32_t> row;
  for (std::int32_t i = 0; i <= 8; ++i) row.push_back(4 * 9 + i);
  EXPECT_EQ(path, row);
}

TEST(SnapToEdges, GivesAChainInTheBandOfTheWireThatIsCloseToItAndTurnsLittle) {
  for (const Case& c : strong_cases()) {
    const Surface surface = c.mesh.surface();
    const Embedding embedding = embed_features(surface, c.follow, c.max_anisotropy);
    const DistanceField field = ExactGeodesics(embedding.mesh).solve(0);
    for (std::int32_t v = 5; index(v) < surface.vertex_count(); v += 97) {
      const Wire wire = trace_wire(surface, embedding, field, v).value();
      const auto path = snap_to_edges(surface, wire);
      expect_chain(surface, path, 0, v);
      const std::set<Edge> band = band_of(surface, wire);
      std::map<Edge, double> weights;
      for (const Edge& e : band) weights[e] = closeness(surface, wire, e[0], e[1]);
      // A turn by a right angle costs half of the product of both edges' lengths.
      const auto turn = [&](std::int32_t a, std::int32_t b, std::int32_t to) {
        const Vector u = surface.points()[index(b)] - surface.points()[index(a)];
        const Vector w = surface.points()[index(to)] - surface.points()[index(b)];
        return 0.5 * (u.norm() * w.norm() - u.dot(w));
      };
      double cost = 0;
      for (std::size_t i = 1; i < path.size(); ++i) {
        const Edge edge = sorted(path[i - 1], path[i]);
        EXPECT_TRUE(band.contains(edge)) << c.name << " to " << v;
        cost += weights[edge];
        if (i > 1) cost += turn(path[i - 2], path[i - 1], path[i]);
      }
      // Bellman and Ford's relaxation of the whole band with finely sampled weights: costs of arriving over an edge.
      std::map<std::pair<std::int32_t, std::int32_t>, double> costs;
      std::map<std::int32_t, std::vector<std::int32_t>> beside;
      for (const Edge& e : band) {
        beside[e[0]].push_back(e[1]);
        beside[e[1]].push_back(e[0]);
      }
      for (const std::int32_t to : beside[0]) costs[{0, to}] = weights[sorted(0, to)];
      for (bool changed = true; changed;) {
        changed = false;
        for (const auto& [edge, before] : std::map(costs)) {
          const auto& [a, b] = edge;
          for (const std::int32_t to : beside[b]) {
            const double through = before + turn(a, b, to) + weights[sorted(b, to)];
            const auto found = costs.find({b, to});
            if (to == a || (found != costs.end() && found->second <= through)) continue;
            costs[{b, to}] = through;
            changed = true;
          }
        }
      }
      double least = std::numeric_limits<double>::infinity();
      for (const auto& [edge, through] : costs) {
        if (edge.second == v) least = std::min(least, through);
      }
      // The library takes 8 samples an edge; a kink between two of them is an error of at most 1/64 of the edge's part.
      EXPECT_LE(cost, 1.02 * least + 1e-9) << c.name << " to " << v;
    }
  }
}

TEST(SnapToEdges, NeverTakesADiagonalOfAPolygon) {
  const int n = 10;
  const shapes::Mesh mesh = shapes::grid(n, 0.2);
  std::vector<Edge> edges;
  for (std::int32_t j = 0; j <= n; ++j) {
    for (std::int32_t i = 0; i <= n; ++i) {
      const std::int32_t v = j * (n + 1) + i;
      if (i < n) edges.push_back({v, v + 1});
      if (j < n) edges.push_back({v, v + n + 1});
    }
  }
  const Surface surface(mesh.points, mesh.triangles, edges);
  const Embedding embedding = embed_euclidean(surface);
  const DistanceField field = ExactGeodesics(embedding.mesh).solve(0);
  for (std::int32_t v = 1; index(v) < surface.vertex_count(); ++v) {
    const auto path = snap_to_edges(surface, trace_wire(surface, embedding, field, v).value());
    expect_chain(surface, path, 0, v);
    EXPECT_GE(path.size(), index(v % (n + 1) + v / (n + 1) + 1)) << "steps along two directions only";
  }
}

/// A square ring of which nothing but the outer and the inner outline is a real edge: one polygon with a hole.
struct Ring {
  std::vector<Vector> points = {{0, 0, 0}, {3, 0, 0}, {3, 3, 0}, {0, 3, 0}, {1, 1, 0}, {2, 1, 0}, {2, 2, 0}, {1, 2, 0}};
  std::vector<Triangle> triangles;
  std::vector<Edge> edges;

  Ring() {
    for (std::int32_t i = 0; i < 4; ++i) {
      const std::int32_t j = (i + 1) % 4;
      triangles.insert(triangles.end(), {{i, j, j + 4}, {i, j + 4, i + 4}});
      edges.insert(edges.end(), {{i, j}, {i + 4, j + 4}});
    }
  }
  Surface surface() const { return {points, triangles, edges}; }
};

TEST(SnapToEdges, WidensTheBandWhereItDoesNotConnectTheEnds) {
  Ring ring;
  ring.points.emplace_back(4, 4, 0);
  ring.edges.insert(ring.edges.end(), {{2, 8}, {8, 6}});  // round about, without a face
  const Surface surface = ring.surface();
  const Wire wire = polyline(0, {{0, 0, 0}, {1, 1, 0}}, 4, {0});
  const auto path = snap_to_edges(surface, wire);
  expect_chain(surface, path, 0, 4);
  EXPECT_NE(std::find(path.begin(), path.end(), 8), path.end());
}

TEST(SnapToEdges, IsEmptyWhereNoPathOfEdgesLeads) {
  const Surface surface = Ring().surface();
  const Wire wire = polyline(0, {{0, 0, 0}, {1, 1, 0}}, 4, {0});
  EXPECT_TRUE(snap_to_edges(surface, wire).empty());
}

TEST(SnapToEdges, StaysOnTheSheetOfTheWire) {
  // A strip folded back onto itself, so close that the other sheet is nearer to the wire than the next edge is.
  const int n = 20, rows = 6;
  const shapes::Mesh mesh = shapes::parametric(2 * n, rows, false, false, [](double u, double v) {
    return u <= 0.5 ? Vector(2 * u, 0.3 * v, 0) : Vector(2 - 2 * u, 0.3 * v, 1e-6);
  });
  const Surface surface = mesh.surface();
  const Embedding embedding = embed_euclidean(surface);
  const std::int32_t columns = 2 * n + 1, from = columns, to = 4 * columns + n - 2;
  const DistanceField field = ExactGeodesics(embedding.mesh).solve(from);
  const auto path = snap_to_edges(surface, trace_wire(surface, embedding, field, to).value());
  expect_chain(surface, path, from, to);
  for (const std::int32_t v : path) EXPECT_LE(v % columns, n) << "on the other sheet";
}

TEST(SnapToEdges, RefusesAWireOfAnotherSurface) {
  const Surface surface = shapes::grid(2).surface();
  const Wire wire = polyline(0, {{0, 0, 0}, {0.5, 0, 0}}, 1, {0});
  EXPECT_EQ(snap_to_edges(surface, wire), (std::vector<std::int32_t>{0, 1}));
  for (const auto& spoil : std::vector<void (*)(Wire&)>{
           [](Wire& w) { w.from = 9; }, [](Wire& w) { w.to = -1; }, [](Wire& w) { w.faces[0] = 8; },
           [](Wire& w) { w.vertices[0] = 9; }, [](Wire& w) { w.vertices.clear(); }, [](Wire& w) { w.faces.clear(); },
           [](Wire& w) { w.vertices[1] = 2; }, [](Wire& w) { w.faces[0] = 7; },
           [](Wire& w) { w.points[1].z() = 0.1; }}) {
    Wire wrong = wire;
    spoil(wrong);
    EXPECT_THROW(snap_to_edges(surface, wrong), InvalidInput);
  }
}

}  // namespace
}  // namespace seamwire
