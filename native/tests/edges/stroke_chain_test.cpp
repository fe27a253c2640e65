// SPDX-License-Identifier: GPL-3.0-or-later
//
// Wires along edges that follow strokes, whichever way the edges run.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <vector>

#include "edges/edge_graph.hpp"
#include "seamwire/edges/edge_wires.hpp"
#include "seamwire/metric/scribble.hpp"
#include "shapes.hpp"

namespace seamwire {
namespace {

constexpr int kSquares = 40;
constexpr double kEdge = 1.0 / kSquares;

std::int32_t vertex_at(double x, double y) {
  return static_cast<std::int32_t>(std::lround(y * kSquares) * (kSquares + 1) + std::lround(x * kSquares));
}

/// A stroke over the grid, each point at the nearest vertex.
Scribble stroke(const std::vector<Vector>& points, bool attracts = true) {
  Scribble scribble;
  scribble.points = points;
  for (const Vector& p : points) scribble.vertices.push_back(vertex_at(p.x(), p.y()));
  scribble.attracts = attracts;
  return scribble;
}

std::vector<Vector> arc(double radius, double from, double to, int count = 100) {
  std::vector<Vector> points;
  for (int i = 0; i <= count; ++i) {
    const double a = from + (to - from) * i / count;
    points.push_back(Vector(0.5, 0.5, 0) + radius * Vector(std::cos(a), std::sin(a), 0));
  }
  return points;
}

std::vector<Vector> line(const Vector& from, const Vector& to, int count = 100) {
  std::vector<Vector> points;
  for (int i = 0; i <= count; ++i) points.push_back(from + (to - from) * i / count);
  return points;
}

/// How far a chain is from a line of points, at the most, in edges.
double off(const Surface& surface, const std::vector<std::int32_t>& chain, const std::vector<Vector>& points) {
  double most = 0;
  for (const std::int32_t v : chain) {
    double least = std::numeric_limits<double>::infinity();
    for (const Vector& p : points) least = std::min(least, (surface.points()[static_cast<std::size_t>(v)] - p).norm());
    most = std::max(most, least);
  }
  return most / kEdge;
}

/// The vertices of a wire; empty if no edges lead to its end.
std::vector<std::int32_t> wire(const Surface& surface, const std::vector<Scribble>& scribbles, std::int32_t from,
                               std::int32_t to, std::optional<MetricKind> kind = std::nullopt) {
  const Metric plain = euclidean_metric(surface, principal_curvatures(surface));
  const Metric metric = apply_scribbles(surface, plain, scribbles, kind);
  const EdgeWires wires = edge_wires(make_edge_graph(surface, metric, nullptr, scribbles, kind), {from});
  const std::optional<EdgeChain> chain = wires.trace({to});
  return chain ? chain->vertices : std::vector<std::int32_t>{};
}

std::vector<std::int32_t> wire_between_ends(const Surface& surface, const Scribble& scribble) {
  return wire(surface, {scribble}, scribble.vertices.front(), scribble.vertices.back());
}

// A line has a vertex within .71 of an edge everywhere; the chain may round the corners of its stairs by another half.
constexpr double kBesideTheLine = 1.25;

TEST(StrokesAlongEdges, AreFollowedInAnyDirection) {
  const Surface surface = shapes::quad_grid(kSquares).surface();
  for (const double degrees : {0.0, 10.0, 20.0, 30.0, 45.0, 60.0, 90.0}) {
    const double a = degrees * std::numbers::pi / 180;
    const Vector half = 0.4 * Vector(std::cos(a), std::sin(a), 0), middle(0.5, 0.5, 0);
    const auto points = line(middle - half, middle + half);
    EXPECT_LT(off(surface, wire_between_ends(surface, stroke(points)), points), kBesideTheLine) << degrees;
  }
}

TEST(StrokesAlongEdges, AreFollowedAroundAHalfCircleThatIsLongerThanTheStraightWay) {
  for (const bool triangles : {false, true}) {
    const Surface surface = triangles ? shapes::grid(kSquares).surface() : shapes::quad_grid(kSquares).surface();
    const auto points = arc(0.3, std::numbers::pi, 0);
    const auto chain = wire_between_ends(surface, stroke(points));
    EXPECT_LT(off(surface, chain, points), kBesideTheLine);
    const bool over_the_top = std::ranges::any_of(
        chain, [&](std::int32_t v) { return surface.points()[static_cast<std::size_t>(v)].y() > 0.77; });
    EXPECT_TRUE(over_the_top);
  }
}

TEST(StrokesAlongEdges, DoNotWindBetweenTwoRowsOfEdges) {
  const Surface surface = shapes::quad_grid(kSquares).surface();
  std::vector<Vector> points = line({0.1, 0.5 + kEdge / 2, 0}, {0.9, 0.5 + kEdge / 2, 0});
  for (std::size_t i = 0; i < points.size(); ++i) points[i].y() += 0.2 * kEdge * std::sin(1.7 * static_cast<double>(i));
  const auto chain = wire_between_ends(surface, stroke(points));
  int rises = 0;
  for (std::size_t i = 0; i + 1 < chain.size(); ++i) rises += std::abs(chain[i] - chain[i + 1]) > 1;
  EXPECT_LE(rises, 2);
}

TEST(StrokesAlongEdges, OfTwoPointsFarApartAreFollowedBetweenThem) {
  const Surface surface = shapes::quad_grid(kSquares).surface();
  const std::vector<Vector> ends{{0.1, 0.2, 0}, {0.9, 0.7, 0}};
  EXPECT_LT(off(surface, wire_between_ends(surface, stroke(ends)), line(ends[0], ends[1], 400)), kBesideTheLine);
}

TEST(StrokesAlongEdges, ThatCloseAreFollowedAllTheWayRound) {
  const Surface surface = shapes::quad_grid(kSquares).surface();
  std::vector<Vector> points = arc(0.3, 0, 2 * std::numbers::pi, 200);
  points.back() = points.front();
  const Scribble scribble = stroke(points);
  const Metric metric =
      apply_scribbles(surface, euclidean_metric(surface, principal_curvatures(surface)), std::vector{scribble});
  const auto graph = make_edge_graph(surface, metric, nullptr, std::vector{scribble});
  const EdgeWires wires = edge_wires(graph, {scribble.vertices[0]});
  for (const std::size_t i : {50u, 99u, 150u}) {
    EXPECT_LT(off(surface, wires.trace({scribble.vertices[i]})->vertices, points), kBesideTheLine) << i;
  }
}

TEST(StrokesAlongEdges, AreTakenBackByOnesThatRepelLater) {
  const Surface surface = shapes::quad_grid(kSquares).surface();
  const auto points = arc(0.3, std::numbers::pi, 0);
  const std::int32_t from = vertex_at(0.2, 0.5), to = vertex_at(0.8, 0.5);
  const Scribble here = stroke(points), away = stroke(points, false);
  const auto chain = wire(surface, {here, away}, from, to);
  EXPECT_EQ(chain, wire(surface, {away}, from, to));
  EXPECT_LT(off(surface, wire(surface, {away, here}, from, to), points), kBesideTheLine) << "the later one counts";
}

TEST(StrokesAlongEdges, LeadOnlyTheMetricThatTheyAreMeantFor) {
  const Surface surface = shapes::quad_grid(kSquares).surface();
  Scribble scribble = stroke(arc(0.3, std::numbers::pi, 0));
  scribble.acts_on = MetricKind::kMin;
  const std::int32_t from = vertex_at(0.2, 0.5), to = vertex_at(0.8, 0.5);
  EXPECT_LT(off(surface, wire(surface, {scribble}, from, to, MetricKind::kMin), scribble.points), kBesideTheLine);
  EXPECT_EQ(wire(surface, {scribble}, from, to, MetricKind::kMax), wire(surface, {}, from, to));
}

// A hub beside the line has many neighbors. They are too far from the line for edges as short as those to the hub.
TEST(StrokesAlongEdges, PassAVertexWithManyNeighbors) {
  constexpr std::int32_t kHub = 8, kNeighbors = 60'000;
  std::vector<Vector> points{{0, -0.3, 0}, {1, -0.3, 0}, {2, -0.3, 0}, {3, -0.3, 0},
                             {0, 0.3, 0},  {1, 0.3, 0},  {2, 0.3, 0},  {3, 0.3, 0}};
  std::vector<Triangle> triangles{{0, 1, kHub}, {1, 5, kHub}, {5, 4, kHub}, {4, 0, kHub},
                                  {1, 2, 6},    {1, 6, 5},    {2, 3, 7},    {2, 7, 6}};
  points.emplace_back(0.5, 0.1, 0);
  for (std::int32_t i = 0; i < kNeighbors; ++i) {
    const double a = 2 * std::numbers::pi * i / kNeighbors;
    points.push_back(points[kHub] + 1e-3 * Vector(std::cos(a), std::sin(a), 0));
    triangles.push_back({kHub, kHub + 1 + i, kHub + 1 + (i + 1) % kNeighbors});
  }
  const Surface surface(points, triangles);
  const Metric plain = euclidean_metric(surface, principal_curvatures(surface));
  const std::vector<Scribble> along{{.points = {{0.05, 0, 0}, {2.95, 0, 0}}, .faces = {3, 6}, .vertices = {}}};
  const auto length_of_last_edge = [&](const std::vector<Scribble>& scribbles) {
    const auto graph = make_edge_graph(surface, plain, nullptr, scribbles);
    return graph->length(graph->find(2, 3));
  };
  EXPECT_LT(length_of_last_edge(along), 0.5 * length_of_last_edge({})) << "edges along the stroke are cheap";
}

TEST(StrokesAlongEdges, HaveAGapWhereNoEdgesLeadAndEndWhereThereIsNoMovement) {
  std::vector<Vector> points = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {3, 0, 0}, {4, 0, 0}, {4, 1, 0}};
  const Surface surface(points, {{0, 1, 2}, {3, 4, 5}});
  Scribble across;
  across.points = {{0, 0, 0}, {1, 0, 0}, {3, 0, 0}, {4, 0, 0}};
  across.vertices = {0, 1, 3, 4};
  EXPECT_EQ(wire(surface, {across}, 0, 1), (std::vector<std::int32_t>{0, 1}));
  EXPECT_TRUE(wire(surface, {across}, 0, 4).empty());
  Scribble still;
  still.points = {{0, 0, 0}, {0, 0, 0}};
  still.vertices = {0, 0};
  EXPECT_EQ(wire(surface, {still}, 0, 2), wire(surface, {}, 0, 2));
  EXPECT_EQ(wire(surface, {Scribble{}}, 0, 2), wire(surface, {}, 0, 2));
}

}  // namespace
}  // namespace seamwire
