// SPDX-License-Identifier: GPL-3.0-or-later
#include "seamwire/embedding/embedding.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <set>
#include <string>
#include <vector>

#include "embedding/bisection.hpp"
#include "embeddings.hpp"
#include "shapes.hpp"

namespace seamwire {

using namespace detail;

namespace {

using embeddings::at;
using embeddings::expect_sound;
using embeddings::identity_metric;
using embeddings::plane_metric;
using embeddings::random_metric;
using shapes::Mesh;

// Which vertices triangles and loose edges connect to the first.
std::vector<bool> connected_to(const IntrinsicMesh& mesh, std::int32_t first) {
  std::vector<std::vector<std::int32_t>> neighbors(at(mesh.vertex_count));
  const auto join = [&](std::int32_t a, std::int32_t b) {
    neighbors[at(a)].push_back(b);
    neighbors[at(b)].push_back(a);
  };
  for (const auto& [a, b, c] : mesh.triangles) join(a, b), join(b, c);
  for (const LooseEdge& edge : mesh.loose_edges) join(edge.a, edge.b);
  std::vector<bool> reached(at(mesh.vertex_count), false);
  std::vector<std::int32_t> todo{first};
  reached[at(first)] = true;
  while (!todo.empty()) {
    const std::int32_t v = todo.back();
    todo.pop_back();
    for (const std::int32_t w : neighbors[at(v)]) {
      if (!reached[at(w)]) todo.push_back(w);
      reached[at(w)] = true;
    }
  }
  return reached;
}

TEST(Embed, AConstantTensorOnAPlaneLeavesNothingToBisect) {
  const Surface surface = shapes::grid(24, 0.3).surface();
  for (const double a : {1.0, 5.0, 20.0, 100.0}) {
    for (const double angle : {0.0, 0.4, 1.1, 2.9}) {
      const Metric metric = plane_metric(surface, a, 1 / a, angle);
      const Embedding embedding = embed(surface, metric, {.max_error = 0});
      EXPECT_EQ(embedding.invalid_before, 0U);
      EXPECT_EQ(embedding.faces_added, 0U);
      EXPECT_EQ(embedding.invalid_left, 0U);
      EXPECT_FALSE(embedding.hit_cap);
      EXPECT_TRUE(embedding.unreachable.empty());
      EXPECT_TRUE(embedding.mesh.loose_edges.empty());
      expect_sound(surface, embedding);
      for (std::int32_t h = 0; h < static_cast<std::int32_t>(embedding.mesh.lengths.size()); ++h) {
        const Vector e = surface.points()[at(embedding.mesh.tip(h))] - surface.points()[at(embedding.mesh.tail(h))];
        const double expected = std::sqrt(e.dot(metric.tensors[0] * e));
        // sqrt(v^T M v) to 1e-9, as distances are to be; rounding is A^2 of a last place.
        EXPECT_NEAR(embedding.mesh.lengths[at(h)], expected, 1e-9 * expected);
      }
    }
  }
}

TEST(Embed, RefinesUntilEveryTriangleIsValid) {
  const Surface surface = shapes::grid(12, 0.2).surface();
  for (const double a : {3.0, 10.0, 30.0}) {
    const Embedding embedding = embed(surface, random_metric(surface, a, 3), {.max_error = 0});
    EXPECT_GT(embedding.invalid_before, 0U);
    EXPECT_GT(embedding.faces_added, 0U);
    EXPECT_EQ(embedding.invalid_left, 0U);
    EXPECT_EQ(embedding.mesh.face_count(), surface.face_count() + embedding.faces_added);
    EXPECT_TRUE(embedding.mesh.loose_edges.empty());
    expect_sound(surface, embedding);
  }
}

// A surface in a metric that makes many of its triangles invalid.
struct Strong {
  explicit Strong(const Mesh& mesh, double a = 40) : surface(mesh.surface()) {
    const Curvature curvature = principal_curvatures(surface);
    metric = feature_metric(surface, curvature, Follow::kMax, {.max_anisotropy = a});
  }

  Surface surface;
  Metric metric;
};

TEST(InvalidFaces, AreTheOnesThatAreBisected) {
  const Strong on(shapes::bumpy(shapes::icosphere(3), 0.05));
  const Embedding embedding = embed(on.surface, on.metric, {.max_error = 0});
  const std::vector<std::int32_t> faces = invalid_faces(on.surface, on.metric);
  EXPECT_GT(faces.size(), 20U);
  EXPECT_EQ(faces.size(), embedding.invalid_before);
  for (const std::int32_t face : faces) EXPECT_GT(std::ranges::count(embedding.source_face, face), 1);
  EXPECT_TRUE(embedding.hole_faces.empty());
}

TEST(InvalidFaces, HaveTheCallersNumbersWhereFacesAreLeftOutOrHaveNoArea) {
  // Face 0 is degenerate and left out, face 2 has no area.
  const Surface surface({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {.5, .5, 0}},
                        {{0, 0, 1}, {0, 1, 2}, {0, 2, 4}, {0, 4, 3}, {4, 2, 3}});
  EXPECT_EQ(invalid_faces(surface, identity_metric(surface)), std::vector<std::int32_t>{2});
  EXPECT_EQ(embed(surface, identity_metric(surface), {.max_error = 0}).invalid_before, 1U);
}

TEST(Embed, NamesTheFacesThatHolesAreIn) {
  const Strong on(shapes::bumpy(shapes::icosphere(3), 0.05));
  const Embedding embedding = embed(on.surface, on.metric, {.max_faces_added = 4, .max_error = 0});
  ASSERT_GT(embedding.invalid_left, 0U);
  EXPECT_FALSE(embedding.hole_faces.empty());
  EXPECT_LE(embedding.hole_faces.size(), embedding.invalid_left);
  // Missing area of a face is a hole.
  std::map<std::int32_t, double> areas;
  const auto area = [](const std::vector<Vector>& points, const Triangle& t) {
    return (points[at(t[1])] - points[at(t[0])]).cross(points[at(t[2])] - points[at(t[0])]).norm() / 2;
  };
  for (std::size_t t = 0; t < embedding.mesh.face_count(); ++t) {
    areas[embedding.source_face[t]] += area(embedding.points, embedding.mesh.triangles[t]);
  }
  for (std::int32_t f = 0; at(f) < on.surface.face_count(); ++f) {
    const bool is_whole = areas[f] > 0.999 * area(on.surface.points(), on.surface.triangles()[at(f)]);
    EXPECT_EQ(is_whole, !std::ranges::binary_search(embedding.hole_faces, f)) << f;
  }
}

TEST(Embed, NewVerticesAreInTheCallersCoordinates) {
  Mesh mesh = shapes::grid(6);
  for (Vector& p : mesh.points) p = Vector(100, 200, 300) + 50 * p;
  const Surface surface = mesh.surface();
  const Embedding embedding = embed(surface, random_metric(surface, 10, 3), {.max_error = 0});
  ASSERT_GT(embedding.mesh.vertex_count, 49);
  expect_sound(surface, embedding);
}

TEST(Embed, DoesNotDependOnTheScaleOfTheInput) {
  const Mesh mesh = shapes::torus(24, 12);
  const Surface one = mesh.surface();
  std::mt19937 random(5);
  std::normal_distribution<double> normal;
  Metric metric;
  for (const Vector& p : mesh.points) {
    const Vector ring = 0.35 * Vector(p.x(), p.y(), 0).normalized();
    const Vector n = (p - ring).normalized(), e1 = n.cross(Vector(normal(random), normal(random), 1)).normalized();
    metric.normals.push_back(n);
    metric.tensors.push_back(12 * e1 * e1.transpose() + n.cross(e1) * n.cross(e1).transpose() / 12);
  }
  const Embedding expected = embed(one, metric, {.max_error = 0});
  ASSERT_GT(expected.faces_added, 100U);
  for (const double scale : {1e-3, 0.7, 3.0, 12345.678}) {
    Mesh scaled = mesh;
    for (Vector& p : scaled.points) p *= scale;
    const Embedding embedding = embed(scaled.surface(), metric, {.max_error = 0});
    ASSERT_EQ(embedding.mesh.triangles, expected.mesh.triangles) << scale;
    EXPECT_EQ(embedding.mesh.twins, expected.mesh.twins);
    for (std::size_t h = 0; h < embedding.mesh.lengths.size(); ++h) {
      ASSERT_NEAR(embedding.mesh.lengths[h] / scale, expected.mesh.lengths[h], 1e-12 * expected.mesh.lengths[h]);
    }
  }
}

TEST(Embed, GivesTheSameEveryTime) {
  const Surface surface = shapes::grid(12).surface();
  const Metric metric = random_metric(surface, 10, 3);
  const Embedding a = embed(surface, metric, {.max_error = 0}), b = embed(surface, metric, {.max_error = 0});
  EXPECT_EQ(a.mesh.triangles, b.mesh.triangles);
  EXPECT_EQ(a.mesh.lengths, b.mesh.lengths);
}

TEST(Embed, StopsAtTheCapAndLeavesHolesWithEdgesToRunAlong) {
  const Surface surface = shapes::grid(12).surface();
  const Metric metric = random_metric(surface, 10, 3);
  const std::size_t needed = embed(surface, metric, {.max_error = 0}).faces_added;
  for (const std::size_t cap : {std::size_t{0}, std::size_t{1}, needed / 3}) {
    const Embedding embedding = embed(surface, metric, {.max_faces_added = cap, .max_error = 0});
    EXPECT_LE(embedding.faces_added, cap);
    EXPECT_TRUE(embedding.hit_cap);
    EXPECT_GT(embedding.invalid_left, 0U);
    EXPECT_EQ(embedding.mesh.face_count() + embedding.invalid_left, surface.face_count() + embedding.faces_added);
    EXPECT_TRUE(embedding.unreachable.empty());
    expect_sound(surface, embedding);
    const std::vector<bool> reached = connected_to(embedding.mesh, 0);
    EXPECT_EQ(std::ranges::count(reached, false), 0);
    for (const LooseEdge& edge : embedding.mesh.loose_edges) EXPECT_GT(edge.length, 0);
  }
  // Where the cap is all that this scheme lacks, the others are tried.
  const Embedding otherwise = embed(surface, metric, {.max_faces_added = needed - 1, .max_error = 0});
  EXPECT_LT(otherwise.faces_added, needed);
  EXPECT_FALSE(otherwise.hit_cap);
  EXPECT_EQ(otherwise.invalid_left, 0U);
  const Embedding enough = embed(surface, metric, {.max_faces_added = needed, .max_error = 0});
  EXPECT_FALSE(enough.hit_cap);
  EXPECT_EQ(enough.invalid_left, 0U);
}

// Step by step: of the invalid triangles, the one bisected next has the largest perimeter.
TEST(Embed, SplitsLargestPerimeterFirst) {
  const Surface surface = shapes::grid(12, 0.2).surface();
  const Metric metric = random_metric(surface, 10, 3);
  const EmbedOptions options{.max_error = 0};
  Bisection bisection(BisectedMesh({surface, metric, options}, {}, 0.0), options, Scheme::kLongestEdge);
  const BisectedMesh& mesh = bisection.mesh();
  double progress = 0;
  ASSERT_FALSE(bisection.run({}, 0, progress));
  int steps = 0;
  for (bool is_done = false; !is_done && steps < 200; ++steps) {
    float largest = 0;  // as rounded as the order is
    for (std::int32_t f = 0; at(f) < mesh.face_count(); ++f) {
      if (!mesh.is_valid(f)) largest = std::max(largest, static_cast<float>(mesh.perimeter(f)));
    }
    std::vector<std::int32_t> first;
    for (std::int32_t f = 0; at(f) < mesh.face_count(); ++f) {
      if (!mesh.is_valid(f) && static_cast<float>(mesh.perimeter(f)) == largest) first.push_back(f);
    }
    const std::vector<Triangle> before = mesh.triangles;
    is_done = bisection.work_off({}, mesh.faces_added() + 2, progress);
    const bool is_first =
        std::ranges::any_of(first, [&](std::int32_t f) { return mesh.triangles[at(f)] != before[at(f)]; });
    ASSERT_TRUE(is_first) << "step " << steps;
  }
  EXPECT_GT(steps, 50);
}

// Neighbors agree on their edges, and no vertex lies within an edge, also where a chain of neighbors was bisected.
TEST(Embed, StaysConformingWhereItLeavesThePapersScheme) {
  const Surface surface = shapes::torus(24, 40).surface();
  const Embedding embedding =
      embed(surface, feature_metric(surface, principal_curvatures(surface), Follow::kMax, {.max_anisotropy = 20}),
            {.max_error = 0});
  ASSERT_GT(embedding.faces_added, 20'000U);  // more than the paper's scheme may add here
  EXPECT_EQ(std::ranges::count_if(embedding.mesh.twins, [](std::int32_t twin) { return twin < 0; }), 0);
  // A closed surface of genus 1: a vertex within an edge would leave gaps.
  EXPECT_EQ(2 * at(embedding.mesh.vertex_count), embedding.mesh.face_count());
}

TEST(Embed, BisectsBoundaryEdges) {
  // One triangle, whose long edge in the metric is on the boundary: splits add one face each.
  const Surface surface({{0, 0, 0}, {1, 0, 0}, {0.5, 0.4, 0}}, {{0, 1, 2}});
  Metric metric = plane_metric(surface, 1, 1, 0);
  metric.tensors[0] *= 100;
  const Embedding embedding = embed(surface, metric, {.max_error = 0});
  EXPECT_EQ(embedding.invalid_left, 0U);
  EXPECT_EQ(embedding.mesh.face_count(), 1 + embedding.faces_added);
  expect_sound(surface, embedding);
  metric.tensors[0] *= 1e-4;
  metric.tensors[2] *= 1e-4;
  const Embedding another = embed(surface, metric, {.max_error = 0});
  EXPECT_GT(another.faces_added, 0U);
  expect_sound(surface, another);
}

TEST(Embed, KeepsOneNumberForAVertexOfSeveralFans) {
  // Three squares on one edge, and a bow tie on vertex 1.
  const Surface surface({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {2, 1, 0}, {2, 0, 0}},
                        {{0, 1, 2}, {1, 0, 3}, {0, 1, 4}, {1, 5, 6}});
  ASSERT_EQ(surface.report().nonmanifold_edges.size(), 1U);
  Metric metric = identity_metric(surface);
  const Embedding plain = embed(surface, metric, {.max_error = 0});
  EXPECT_EQ(plain.mesh.triangles, surface.triangles());
  EXPECT_EQ(plain.mesh.twins, std::vector<std::int32_t>(12, -1));
  // Strong enough that faces of every fan are bisected.
  metric.tensors[1] *= 1e4;
  const Embedding embedding = embed(surface, metric, {.max_error = 0});
  for (std::int32_t f = 0; f < 4; ++f) EXPECT_GE(std::ranges::count(embedding.source_face, f), 2);
  EXPECT_EQ(embedding.invalid_left, 0U);
  expect_sound(surface, embedding);
  const std::vector<bool> reached = connected_to(embedding.mesh, 6);
  EXPECT_EQ(std::ranges::count(reached, false), 0);
}

TEST(Embed, CarriesEdgesWithoutFaces) {
  const Surface surface({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {2, 0, 0}, {3, 3, 3}}, {{0, 1, 2}},
                        std::vector<Edge>{{0, 1}, {1, 3}});
  const Embedding embedding = embed(surface, identity_metric(surface), {.max_error = 0});
  ASSERT_EQ(embedding.mesh.loose_edges.size(), 1U);
  EXPECT_EQ(embedding.mesh.loose_edges[0].a, 1);
  EXPECT_EQ(embedding.mesh.loose_edges[0].b, 3);
  EXPECT_DOUBLE_EQ(embedding.mesh.loose_edges[0].length, 1.0);
  EXPECT_TRUE(embedding.unreachable.empty());  // vertex 4 is isolated in the input already
}

TEST(Embed, FlipsFacesWithACornerOnTheOppositeEdge) {
  // A square cut along its diagonal 0-2, with vertex 4 on the diagonal, on one side only: face 1 has no area.
  for (const double t : {0.5, 0.3, 1e-3}) {
    const Surface surface({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {t, t, 0}},
                          {{0, 1, 2}, {0, 2, 4}, {0, 4, 3}, {4, 2, 3}});
    ASSERT_EQ(surface.report().zero_area_faces, std::vector<std::int32_t>{1});
    const Embedding embedding = embed(surface, identity_metric(surface), {.max_error = 0});
    EXPECT_EQ(embedding.invalid_before, 1U);
    EXPECT_EQ(embedding.invalid_left, 0U);
    EXPECT_EQ(embedding.mesh.face_count(), 4U);
    EXPECT_TRUE(embedding.mesh.loose_edges.empty());
    EXPECT_EQ(std::ranges::count(embedding.source_face, 0), 2);
    expect_sound(surface, embedding);
    // The vertex on the diagonal is an inner one now: all four of its half-edges have twins.
    for (std::int32_t h = 0; h < 12; ++h) {
      if (embedding.mesh.tail(h) == 4) {
        EXPECT_GE(embedding.mesh.twins[at(h)], 0);
      }
    }
  }
}

// As above, with vertex 4 off the diagonal by a part of its length. A face is flipped away if the report lists it, and
// otherwise bisected as any other, from whichever corner it is given.
TEST(Embed, RemovesTheFacesThatTheReportListsAndNoOthers) {
  int listed = 0, others = 0;
  for (const double part : {1e-13, 1e-11, 1e-10, 0.9e-9, 1.1e-9, 1e-8, 1e-7}) {
    const double t = 0.3, off = part;  // the diagonal is sqrt 2 long, and (off, -off) off * sqrt 2
    for (const Triangle& corners : {Triangle{0, 2, 4}, Triangle{2, 4, 0}, Triangle{4, 0, 2}, Triangle{2, 0, 4}}) {
      const Surface surface({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {t - off, t + off, 0}},
                            {{0, 1, 2}, corners, {0, 4, 3}, {4, 2, 3}});
      const bool is_listed = !surface.report().zero_area_faces.empty();
      EXPECT_EQ(is_listed, part < 1e-9) << part;
      ++(is_listed ? listed : others);
      const Embedding embedding = embed(surface, identity_metric(surface), {.max_error = 0});
      EXPECT_EQ(std::ranges::count(embedding.source_face, 1) == 0, is_listed) << part;
      EXPECT_EQ(embedding.invalid_left, 0U) << part;
    }
  }
  EXPECT_GT(listed, 0);
  EXPECT_GT(others, 0);
}

TEST(Embed, MergesVerticesAtTheSamePlace) {
  // A fan about (0.5, 0.5), where vertices 4 and 5 are both: faces 4 and 5 between them have no area.
  const Surface surface({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {.5, .5, 0}, {.5, .5, 0}},
                        {{0, 1, 4}, {1, 2, 5}, {2, 3, 5}, {3, 0, 4}, {1, 5, 4}, {3, 4, 5}});
  ASSERT_EQ(surface.report().zero_area_faces.size(), 2U);
  const Embedding embedding = embed(surface, identity_metric(surface), {.max_error = 0});
  EXPECT_EQ(embedding.invalid_before, 2U);
  EXPECT_EQ(embedding.invalid_left, 0U);
  EXPECT_EQ(embedding.mesh.face_count(), 4U);
  EXPECT_TRUE(embedding.unreachable.empty());
  ASSERT_EQ(embedding.mesh.loose_edges.size(), 1U);
  const LooseEdge& edge = embedding.mesh.loose_edges[0];
  EXPECT_EQ(std::set<std::int32_t>({edge.a, edge.b}), std::set<std::int32_t>({4, 5}));
  EXPECT_EQ(edge.length, 0);
  // The four faces close up around the one that is left.
  EXPECT_EQ(std::ranges::count(embedding.mesh.twins, -1), 4);
  expect_sound(surface, embedding);
}

TEST(Embed, CountsOnlyFacesWithoutAnAreaThatItIsAskedFor) {
  // Two squares with a needle between their triangles, and a triangle between the squares.
  Mesh mesh;
  for (std::int32_t i = 0; i < 2; ++i) {
    const std::int32_t first = 5 * i;
    const double x = 2 * i;
    mesh.points.insert(mesh.points.end(), {{x, 0, 0}, {x + 1, 0, 0}, {x + 1, 1, 0}, {x, 1, 0}, {x, 0, 0}});
    mesh.triangles.insert(
        mesh.triangles.end(),
        {{first, first + 1, first + 2}, {first, first + 2, first + 4}, {first + 4, first + 2, first + 3}});
  }
  mesh.triangles.push_back({1, 5, 2});
  const Surface surface = mesh.surface();
  ASSERT_EQ(surface.report().zero_area_faces, (std::vector<std::int32_t>{1, 4}));
  const auto invalid = [&](const std::vector<std::int32_t>& faces) {
    const Embedding embedding = embed(surface, identity_metric(surface), {.max_error = 0, .faces = faces});
    EXPECT_EQ(embedding.invalid_left, 0U);
    return embedding.invalid_before;
  };
  EXPECT_EQ(embed(surface, identity_metric(surface), {.max_error = 0}).invalid_before, 2U);
  EXPECT_EQ(invalid({0, 1, 2, 3, 4, 5, 6}), 2U);
  EXPECT_EQ(invalid({0, 1, 2}), 1U);
  EXPECT_EQ(invalid({1, 6}), 1U);
  EXPECT_EQ(invalid({3, 5, 6}), 0U);
  EXPECT_EQ(invalid({1, 4}), 2U);
}

TEST(Embed, MendsManyFacesWithoutAnAreaAtOnce) {
  // A row of vertices on the long edge of one triangle, joined to it by a fan without an area, with faces below.
  Mesh mesh;
  const int n = 9;
  mesh.points = {{0, 0, 0}, {1, 0, 0}, {.5, 1, 0}, {.5, -1, 0}};
  for (int i = 1; i < n; ++i) mesh.points.emplace_back(double(i) / n, 0, 0);
  const auto row = [&](int i) { return i == 0 ? 0 : i == n ? 1 : i + 3; };
  mesh.triangles.push_back({0, 1, 2});
  for (int i = 0; i < n; ++i) {
    mesh.triangles.push_back({row(i), 3, row(i + 1)});
    if (i > 0) mesh.triangles.push_back({0, row(i), row(i + 1)});
  }
  const Surface surface = mesh.surface();
  ASSERT_EQ(surface.report().boundary_edges, 4U);
  const Embedding embedding = embed(surface, identity_metric(surface), {.max_error = 0});
  EXPECT_EQ(embedding.invalid_before, static_cast<std::size_t>(n - 1));
  EXPECT_EQ(embedding.invalid_left, 0U);
  EXPECT_EQ(std::ranges::count(embedding.mesh.twins, -1), 4);
  EXPECT_EQ(std::ranges::count(embedding.source_face, 0), n);
  expect_sound(surface, embedding);
}

TEST(Embed, EndsOnFacesWithoutAnAreaThatNothingMends) {
  // A face in line on its own, one point three times, and two faces back to back.
  const Surface surface({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {5, 5, 5}, {5, 5, 5}, {5, 5, 5}}, {{0, 1, 2}, {3, 4, 5}});
  const Embedding embedding = embed(surface, identity_metric(surface), {.max_error = 0});
  EXPECT_EQ(embedding.invalid_before, 2U);
  EXPECT_EQ(embedding.faces_added, 0U);
  EXPECT_EQ(embedding.mesh.face_count(), 0U);
  EXPECT_TRUE(embedding.unreachable.empty());
  const std::vector<bool> line = connected_to(embedding.mesh, 0), point = connected_to(embedding.mesh, 3);
  EXPECT_TRUE(line[1] && line[2] && !line[3]);
  EXPECT_TRUE(point[4] && point[5] && !point[0]);
}

TEST(Embed, NamesVerticesThatNothingLeadsTo) {
  // Face 1 is one vertex three times: it has no edge.
  const Surface surface({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}}, {{0, 1, 2}, {3, 3, 3}});
  EXPECT_EQ(embed(surface, identity_metric(surface), {.max_error = 0}).unreachable, std::vector<std::int32_t>{3});
}

TEST(Embed, TakesTensorsThatDifferByManyOrders) {
  const Surface surface = shapes::grid(4).surface();
  Metric metric = random_metric(surface, 1000, 1);
  metric.tensors[12] *= 1e12;
  const Embedding embedding = embed(surface, metric, {.max_faces_added = 20'000, .max_error = 0});
  expect_sound(surface, embedding);
  EXPECT_EQ(std::ranges::count(connected_to(embedding.mesh, 0), false), 0);
}

TEST(Embed, RefusesAMetricThatDoesNotFit) {
  const Surface surface = shapes::grid(3).surface();
  Metric metric = plane_metric(surface, 1, 1, 0);
  metric.tensors[5](1, 2) = std::numeric_limits<double>::quiet_NaN();
  try {
    embed(surface, metric, {.max_error = 0});
    ADD_FAILURE() << "nothing thrown";
  } catch (const InvalidInput& error) {
    EXPECT_NE(std::string(error.what()).find("vertex 5 "), std::string::npos) << error.what();
  }
  metric.tensors[5] = 1e151 * Eigen::Matrix3d::Identity();
  EXPECT_THROW(embed(surface, metric, {.max_error = 0}), InvalidInput) << "areas of its triangles would not be numbers";
  metric.tensors.pop_back();
  EXPECT_THROW(embed(surface, metric, {.max_error = 0}), InvalidInput);
  const Metric good = plane_metric(surface, 1, 1, 0);
  EXPECT_THROW(embed(surface, good, {.max_error = -1}), InvalidInput);
  EXPECT_THROW(embed(surface, good, {.max_error = std::numeric_limits<double>::quiet_NaN()}), InvalidInput);
}

TEST(Embed, ReportsProgressAndStopsWhenTold) {
  const Surface surface = shapes::grid(40).surface();
  const Metric metric = random_metric(surface, 30, 3);
  std::vector<double> seen;
  embed(surface, metric, {.max_error = 0},
        {.stop = {}, .progress = [&](double done) { return seen.push_back(done), true; }});
  ASSERT_GE(seen.size(), 4U);
  EXPECT_TRUE(std::ranges::is_sorted(seen));
  EXPECT_GE(seen.front(), 0);
  EXPECT_EQ(seen.back(), 1);
  std::size_t calls = 0;
  EXPECT_THROW(embed(surface, metric, {.max_error = 0}, {.stop = {}, .progress = [&](double) { return ++calls < 3; }}),
               Cancelled);
  EXPECT_EQ(calls, 3U);
  std::stop_source source;
  source.request_stop();
  EXPECT_THROW(embed(surface, metric, {.max_error = 0}, {.stop = source.get_token(), .progress = {}}), Cancelled);
}

TEST(Embed, RepairsTheDegenerateFacesOfASurfaceOnce) {
  shapes::Mesh mesh = shapes::grid(8, 0.2);
  mesh.points[30] = mesh.points[31];  // two needles
  const Surface surface = mesh.surface();
  const Metric metric = euclidean_metric(surface, principal_curvatures(surface));
  const Surface copy = surface;
  const std::vector<std::int32_t> needle = surface.report().zero_area_faces;
  ASSERT_FALSE(needle.empty());
  const auto& cleaned = *detail::corner_fans(surface).cleaned;
  EXPECT_FALSE(cleaned.peek());
  const Embedding whole = embed(surface, metric, {.max_error = 0});
  const auto made = cleaned.peek();
  ASSERT_TRUE(made);
  std::vector<std::int32_t> around = needle;
  for (const std::int32_t f : {needle.front() - 1, needle.front() + 1}) around.push_back(f);
  const Embedding some = embed(copy, metric, {.max_error = 0, .faces = around});
  EXPECT_EQ(detail::corner_fans(copy).cleaned->peek(), made) << "copies of a surface share it";
  // The same triangles as in the whole.
  std::set<Triangle> all(whole.mesh.triangles.begin(), whole.mesh.triangles.end());
  EXPECT_FALSE(some.mesh.triangles.empty());
  for (const Triangle& triangle : some.mesh.triangles) EXPECT_TRUE(all.contains(triangle));
}

}  // namespace
}  // namespace seamwire
