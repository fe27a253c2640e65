// SPDX-License-Identifier: GPL-3.0-or-later
#include "seamwire/embedding.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <numbers>
#include <queue>
#include <random>
#include <set>
#include <string>
#include <vector>

#include "embeddings.hpp"
#include "intrinsic.hpp"
#include "reference_geodesics.hpp"
#include "seamwire/geodesics.hpp"
#include "seamwire/scribble.hpp"
#include "shapes.hpp"

namespace seamwire {
namespace {

using embeddings::expect_sound;
using shapes::Mesh;

std::size_t at(std::int32_t i) { return static_cast<std::size_t>(i); }

// The same tensor everywhere on a plane z = const: stretched by the roots of l1 along (cos, sin)(angle) and l2 across.
Metric plane_metric(const Surface& surface, double l1, double l2, double angle) {
  const Vector e1(std::cos(angle), std::sin(angle), 0), e2(-std::sin(angle), std::cos(angle), 0);
  const Eigen::Matrix3d tensor = l1 * e1 * e1.transpose() + l2 * e2 * e2.transpose();
  return {std::vector<Vector>(surface.vertex_count(), Vector::UnitZ()),
          std::vector<Eigen::Matrix3d>(surface.vertex_count(), tensor)};
}

// The identity as a quadratic form on space, for surfaces whose normals do not matter.
Metric identity_metric(const Surface& surface) {
  return {std::vector<Vector>(surface.vertex_count(), Vector::Zero()),
          std::vector<Eigen::Matrix3d>(surface.vertex_count(), Eigen::Matrix3d::Identity())};
}

// A metric that no smooth surface has: at each vertex a direction of its own, at anisotropy A.
Metric random_metric(const Surface& surface, double a, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> angle(0, std::numbers::pi);
  Metric metric = plane_metric(surface, 1, 1, 0);
  for (Eigen::Matrix3d& tensor : metric.tensors) {
    const double t = angle(random);
    const Vector e1(std::cos(t), std::sin(t), 0), e2(-std::sin(t), std::cos(t), 0);
    tensor = a * e1 * e1.transpose() + 1 / a * e2 * e2.transpose();
  }
  return metric;
}

// Which vertices triangles and loose edges connect to the first.
std::vector<bool> connected_to(const IntrinsicMesh& mesh, std::int32_t first) {
  std::vector<std::vector<std::int32_t>> neighbours(at(mesh.vertex_count));
  const auto join = [&](std::int32_t a, std::int32_t b) {
    neighbours[at(a)].push_back(b);
    neighbours[at(b)].push_back(a);
  };
  for (const auto& [a, b, c] : mesh.triangles) join(a, b), join(b, c);
  for (const LooseEdge& edge : mesh.loose_edges) join(edge.a, edge.b);
  std::vector<bool> reached(at(mesh.vertex_count), false);
  std::vector<std::int32_t> todo{first};
  reached[at(first)] = true;
  while (!todo.empty()) {
    const std::int32_t v = todo.back();
    todo.pop_back();
    for (const std::int32_t w : neighbours[at(v)]) {
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
      const Embedding embedding = embed(surface, metric);
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
    const Embedding embedding = embed(surface, random_metric(surface, a, 3));
    EXPECT_GT(embedding.invalid_before, 0U);
    EXPECT_GT(embedding.faces_added, 0U);
    EXPECT_EQ(embedding.invalid_left, 0U);
    EXPECT_EQ(embedding.mesh.face_count(), surface.face_count() + embedding.faces_added);
    EXPECT_TRUE(embedding.mesh.loose_edges.empty());
    expect_sound(surface, embedding);
  }
}

TEST(Embed, NewVerticesAreInTheCallersCoordinates) {
  Mesh mesh = shapes::grid(6);
  for (Vector& p : mesh.points) p = Vector(100, 200, 300) + 50 * p;
  const Surface surface = mesh.surface();
  const Embedding embedding = embed(surface, random_metric(surface, 10, 3));
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
  const Embedding expected = embed(one, metric);
  ASSERT_GT(expected.faces_added, 100U);
  for (const double scale : {1e-3, 0.7, 3.0, 12345.678}) {
    Mesh scaled = mesh;
    for (Vector& p : scaled.points) p *= scale;
    const Embedding embedding = embed(scaled.surface(), metric);
    ASSERT_EQ(embedding.mesh.triangles, expected.mesh.triangles) << scale;
    EXPECT_EQ(embedding.mesh.twins, expected.mesh.twins);
    for (std::size_t h = 0; h < embedding.mesh.lengths.size(); ++h) {
      ASSERT_NEAR(embedding.mesh.lengths[h], expected.mesh.lengths[h], 1e-12 * expected.mesh.lengths[h]);
    }
  }
}

TEST(Embed, GivesTheSameEveryTime) {
  const Surface surface = shapes::grid(12).surface();
  const Metric metric = random_metric(surface, 10, 3);
  const Embedding a = embed(surface, metric), b = embed(surface, metric);
  EXPECT_EQ(a.mesh.triangles, b.mesh.triangles);
  EXPECT_EQ(a.mesh.lengths, b.mesh.lengths);
}

TEST(MidpointTensor, IsNeverMoreAnisotropicThanTheEnds) {
  std::mt19937 random(2);
  std::uniform_real_distribution<double> uniform(-1, 1);
  const auto vector = [&] { return Vector(uniform(random), uniform(random), uniform(random)); };
  const auto tensor = [&] {
    const Vector n = vector().normalized(), e1 = n.cross(vector()).normalized(), e2 = n.cross(e1);
    const double a = 1 + 30 * std::abs(uniform(random)), scale = 1.5 + uniform(random);
    return TensorAt{n, scale * (a * e1 * e1.transpose() + 1 / a * e2 * e2.transpose())};
  };
  for (int trial = 0; trial < 1000; ++trial) {
    std::vector<TensorAt> all{tensor(), tensor(), tensor(), tensor()};
    double largest = 0;
    for (const TensorAt& t : all) largest = std::max(largest, anisotropy(t));
    while (all.size() < 24) {
      const std::size_t i = random() % all.size(), j = random() % all.size();
      all.push_back(midpoint_tensor(all[i], all[j]));
      EXPECT_NEAR(all.back().normal.norm(), 1, 1e-14);
      EXPECT_LE((all.back().tensor * all.back().normal).norm(), 1e-13 * all.back().tensor.norm());
      EXPECT_LE(anisotropy(all.back()), largest * (1 + 1e-9));
    }
  }
}

TEST(MidpointTensor, TurnsTensorsWithTheirNormals) {
  // A quarter turn of the plane about the direction of the minor eigenvector leaves that one, and takes e1 along.
  const auto bent = [](double angle) {
    const Vector n(std::sin(angle), 0, std::cos(angle)), e1(std::cos(angle), 0, -std::sin(angle));
    return TensorAt{n, 9 * e1 * e1.transpose() + Vector::UnitY() * Vector::UnitY().transpose()};
  };
  const TensorAt middle = midpoint_tensor(bent(0), bent(std::numbers::pi / 2)), expected = bent(std::numbers::pi / 4);
  EXPECT_TRUE(middle.normal.isApprox(expected.normal, 1e-14));
  EXPECT_TRUE(middle.tensor.isApprox(expected.tensor, 1e-14));
}

TEST(MidpointTensor, KeepsOneOfOppositeNormals) {
  const TensorAt a{Vector::UnitZ(), Vector(4, 1, 0).asDiagonal()}, b{-Vector::UnitZ(), Vector(1, 4, 0).asDiagonal()};
  const TensorAt middle = midpoint_tensor(a, b);
  EXPECT_EQ(middle.normal, a.normal);
  EXPECT_TRUE(middle.tensor.isApprox(Eigen::Matrix3d(Vector(2.5, 2.5, 0).asDiagonal()), 1e-14));
}

TEST(Embed, StopsAtTheCapAndLeavesHolesWithEdgesToRunAlong) {
  const Surface surface = shapes::grid(12).surface();
  const Metric metric = random_metric(surface, 10, 3);
  const std::size_t needed = embed(surface, metric).faces_added;
  for (const std::size_t cap : {std::size_t{0}, std::size_t{1}, needed / 3, needed - 1}) {
    const Embedding embedding = embed(surface, metric, {.max_faces_added = cap});
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
  const Embedding enough = embed(surface, metric, {.max_faces_added = needed});
  EXPECT_FALSE(enough.hit_cap);
  EXPECT_EQ(enough.invalid_left, 0U);
}

TEST(Embed, LeavesInvalidTrianglesSmallerThanSigma) {
  const Surface surface = shapes::grid(12).surface();
  const Metric metric = random_metric(surface, 10, 3);
  const Embedding all = embed(surface, metric);
  for (const Perimeter perimeter : {Perimeter::kMetric, Perimeter::kEuclidean}) {
    for (const double sigma : {1e-3, 0.05, 0.2, 100.0}) {
      const Embedding embedding = embed(surface, metric, {.sigma = sigma, .perimeter = perimeter});
      EXPECT_EQ(embedding.faces_added > 0, sigma < 100);
      // The longest edge of an invalid triangle is half of its perimeter or more, the perimeter less than sigma.
      if (perimeter == Perimeter::kMetric) {
        for (const LooseEdge& edge : embedding.mesh.loose_edges) EXPECT_LT(edge.length, sigma);
      }
      EXPECT_FALSE(embedding.hit_cap);
      EXPECT_EQ(embedding.mesh.face_count() + embedding.invalid_left, surface.face_count() + embedding.faces_added);
      expect_sound(surface, embedding);
    }
  }
  // In Euclid's measure a cell has perimeter (2 + sqrt 2) / 12 = .2845: above it nothing is bisected, below it all are.
  EXPECT_EQ(embed(surface, metric, {.sigma = 0.285, .perimeter = Perimeter::kEuclidean}).faces_added, 0U);
  EXPECT_GE(embed(surface, metric, {.sigma = 0.284, .perimeter = Perimeter::kEuclidean}).faces_added,
            all.invalid_before / 2);
}

// The triangles of an embedding, each by the places of its corners and its lengths, whatever their numbers.
using PlacedTriangle = std::array<double, 12>;
std::vector<PlacedTriangle> placed(const Embedding& embedding) {
  std::vector<PlacedTriangle> all;
  for (std::size_t f = 0; f < embedding.mesh.face_count(); ++f) {
    const Triangle& t = embedding.mesh.triangles[f];
    std::size_t first = 0;
    const auto before = [&](std::size_t i, std::size_t j) {
      const Vector &p = embedding.points[at(t[i])], &q = embedding.points[at(t[j])];
      return std::lexicographical_compare(p.begin(), p.end(), q.begin(), q.end());
    };
    for (std::size_t i = 1; i < 3; ++i) {
      if (before(i, first)) first = i;
    }
    PlacedTriangle row{};
    for (std::size_t i = 0; i < 3; ++i) {
      const std::size_t corner = (first + i) % 3;
      std::ranges::copy(embedding.points[at(t[corner])], row.begin() + static_cast<std::ptrdiff_t>(3 * i));
      row[9 + i] = embedding.mesh.lengths[3 * f + corner];
    }
    all.push_back(row);
  }
  std::sort(all.begin(), all.end());
  return all;
}

void expect_same(const Surface& surface, const Embedding& a, const Embedding& b) {
  EXPECT_EQ(a.invalid_before, b.invalid_before);
  EXPECT_EQ(a.faces_added, b.faces_added);
  EXPECT_EQ(a.invalid_left, b.invalid_left);
  EXPECT_EQ(a.is_local, b.is_local);
  EXPECT_EQ(a.unreachable, b.unreachable);
  ASSERT_EQ(a.mesh.vertex_count, b.mesh.vertex_count);
  ASSERT_EQ(placed(a), placed(b));  // bit for bit
  expect_sound(surface, a);
}

// A stroke along a random walk over the vertices.
Scribble random_scribble(const Surface& surface, std::mt19937& random) {
  Scribble scribble;
  auto v = static_cast<std::int32_t>(random() % surface.vertex_count());
  const HalfEdgeMesh& mesh = surface.half_edges();
  for (int steps = 2 + static_cast<int>(random() % 30); steps > 0; --steps) {
    scribble.vertices.push_back(v);
    scribble.points.push_back(surface.points()[at(v)]);
    std::vector<std::int32_t> around;
    for (const auto w : mesh.vv_range(OpenMesh::VertexHandle(v))) around.push_back(w.idx());
    v = around[random() % around.size()];
  }
  scribble.rings = 1 + static_cast<int>(random() % 10);
  scribble.eta = 2 + static_cast<double>(random() % 29);
  scribble.attracts = random() % 4 != 0;
  return scribble;
}

TEST(ReEmbed, IsEmbeddingFromScratchAfterEveryScribble) {
  std::mt19937 random(11);
  // A torus has many triangles of the same size, which only a local order tells apart in the same way.
  const Mesh meshes[] = {shapes::grid(40, 0.3), shapes::torus(60, 30), shapes::bumpy(shapes::icosphere(4), 0.05)};
  for (const Mesh& mesh : meshes) {
    const Surface surface = mesh.surface();
    const Curvature curvature = principal_curvatures(surface);
    const Metric base = feature_metric(surface, curvature, Follow::kMax, {.max_anisotropy = 8});
    std::vector<Scribble> scribbles;
    Metric former = base;
    Embedding embedding = embed(surface, base);
    int local = 0;
    for (int step = 0; step < 25; ++step) {
      // Mostly added, sometimes one in the middle of the list removed.
      if (scribbles.size() > 2 && random() % 3 == 0) {
        scribbles.erase(scribbles.begin() + static_cast<std::ptrdiff_t>(random() % scribbles.size()));
      } else {
        scribbles.push_back(random_scribble(surface, random));
      }
      Metric metric = apply_scribbles(surface, base, scribbles);
      local += embedding.is_local;
      embedding = re_embed(surface, former, metric, std::move(embedding));
      expect_same(surface, embedding, embed(surface, metric));
      former = std::move(metric);
    }
    EXPECT_GT(local, 15) << "hardly anything was done locally";
    const Embedding back = re_embed(surface, former, base, std::move(embedding));
    expect_same(surface, back, embed(surface, base));
  }
}

TEST(ReEmbed, IsEmbeddingFromScratchWhereTheMetricChangesEverywhereAtRandom) {
  const Surface surface = shapes::grid(24, 0.2).surface();
  Metric former = random_metric(surface, 6, 1);
  Embedding embedding = embed(surface, former);
  std::mt19937 random(5);
  for (unsigned step = 0; step < 12; ++step) {
    const Metric other = random_metric(surface, 6, 2 + step);
    Metric metric = former;
    for (std::size_t v = 0; v < metric.size(); ++v) {
      if (random() % 40 == 0) metric.tensors[v] = other.tensors[v];
    }
    EXPECT_TRUE(embedding.is_local);
    embedding = re_embed(surface, former, metric, std::move(embedding));
    expect_same(surface, embedding, embed(surface, metric));
    former = std::move(metric);
  }
}

TEST(ReEmbed, TakesSurfacesThatAreCutOpenAndOtherNormals) {
  Mesh mesh = shapes::moebius(24);
  const Surface surface = mesh.surface();
  const Metric former = euclidean_metric(surface, principal_curvatures(surface));
  Metric metric = former;
  for (std::size_t v = 0; v < 10; ++v) metric.tensors[v] *= 9;
  expect_same(surface, re_embed(surface, former, metric, embed(surface, former)), embed(surface, metric));
  const Surface grid = shapes::grid(12).surface();
  const Metric random = random_metric(grid, 10, 3);
  const Metric identity = identity_metric(grid);
  expect_same(grid, re_embed(grid, random, identity, embed(grid, random)), embed(grid, identity));
  EXPECT_THROW(re_embed(grid, random, random, embed(surface, former)), InvalidInput);
  EXPECT_THROW(re_embed(grid, random, former, embed(grid, random)), InvalidInput);
}

// The work, not the time, which other processes share in: a scribble is far smaller than the surface.
TEST(ReEmbed, LeavesWhatIsFarAwayWhereItIs) {
  const Surface surface = shapes::grid(100, 0.2).surface();
  const Metric former = random_metric(surface, 3, 3);
  Embedding old = embed(surface, former);
  Metric metric = former;
  metric.tensors[0] = Vector(40, 0.1, 0).asDiagonal();
  const std::vector<double> before = old.mesh.lengths;
  const Embedding embedding = re_embed(surface, former, metric, std::move(old));
  std::size_t changed = 0;
  for (std::size_t h = 0; h < 3 * surface.face_count(); ++h) changed += embedding.mesh.lengths[h] != before[h];
  EXPECT_GT(changed, 0U);
  EXPECT_LT(changed, 100U);
}

TEST(Embed, SplitsLargestPerimeterFirst) {
  const Surface surface = shapes::grid(12).surface();
  const Metric metric = random_metric(surface, 10, 3);
  // After a few splits no invalid triangle is larger than the largest that is bisected next.
  const Embedding few = embed(surface, metric, {.max_faces_added = 2});
  const Embedding none = embed(surface, metric, {.max_faces_added = 0});
  const auto longest_loose = [](const Embedding& e) {
    double longest = 0;
    for (const LooseEdge& edge : e.mesh.loose_edges) longest = std::max(longest, edge.length);
    return longest;
  };
  EXPECT_LE(longest_loose(few), longest_loose(none));
  EXPECT_EQ(few.faces_added, 2U);
}

// Neighbours agree on their edges, and no vertex lies within an edge, also where a chain of neighbours was bisected.
TEST(Embed, StaysConformingWhereItLeavesThePapersScheme) {
  const Surface surface = shapes::torus(24, 40).surface();
  const Embedding embedding =
      embed(surface, feature_metric(surface, principal_curvatures(surface), Follow::kMax, {.max_anisotropy = 20}));
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
  const Embedding embedding = embed(surface, metric);
  EXPECT_EQ(embedding.invalid_left, 0U);
  EXPECT_EQ(embedding.mesh.face_count(), 1 + embedding.faces_added);
  expect_sound(surface, embedding);
  metric.tensors[0] *= 1e-4;
  metric.tensors[2] *= 1e-4;
  const Embedding another = embed(surface, metric);
  EXPECT_GT(another.faces_added, 0U);
  expect_sound(surface, another);
}

TEST(Embed, KeepsOneNumberForAVertexOfSeveralFans) {
  // Three squares on one edge, and a bow tie on vertex 1.
  const Surface surface({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {2, 1, 0}, {2, 0, 0}},
                        {{0, 1, 2}, {1, 0, 3}, {0, 1, 4}, {1, 5, 6}});
  ASSERT_EQ(surface.report().nonmanifold_edges.size(), 1U);
  Metric metric = identity_metric(surface);
  const Embedding plain = embed(surface, metric);
  EXPECT_EQ(plain.mesh.triangles, surface.triangles());
  EXPECT_EQ(plain.mesh.twins, std::vector<std::int32_t>(12, -1));
  // Strong enough that faces of every fan are bisected.
  metric.tensors[1] *= 1e4;
  const Embedding embedding = embed(surface, metric);
  for (std::int32_t f = 0; f < 4; ++f) EXPECT_GE(std::ranges::count(embedding.source_face, f), 2);
  EXPECT_EQ(embedding.invalid_left, 0U);
  expect_sound(surface, embedding);
  const std::vector<bool> reached = connected_to(embedding.mesh, 6);
  EXPECT_EQ(std::ranges::count(reached, false), 0);
}

TEST(Embed, TakesTheSidesOfAOneSidedSurfaceForOne) {
  // A Moebius strip, and the same strip cut open where the faces' orientation breaks.
  const int n = 24, rows = 4;
  const auto point = [&](int i, int j) {
    const double t = 2 * std::numbers::pi * i / n, w = 0.4 * (double(j) / rows - 0.5);
    return Vector((1 + w * std::cos(t / 2)) * std::cos(t), (1 + w * std::cos(t / 2)) * std::sin(t),
                  w * std::sin(t / 2));
  };
  const auto normal_and_tensor = [&](int i, int j) {
    const double t = 2 * std::numbers::pi * i / n;
    const Vector across(std::cos(t / 2) * std::cos(t), std::cos(t / 2) * std::sin(t), std::sin(t / 2));
    const Vector along = (point(i + 1, j) - point(i - 1, j)).normalized(), normal = along.cross(across).normalized();
    const double a = 1 + 20 * ((7 * (i % n) + 3 * (i < n ? j : rows - j)) % 11) / 10.0;
    return TensorAt{normal,
                    a * across * across.transpose() + across.cross(normal) * across.cross(normal).transpose() / a};
  };
  const auto strip = [&](bool closed) {
    Mesh mesh;
    Metric metric;
    const auto number = [&](int i, int j) { return closed && i == n ? rows - j : i * (rows + 1) + j; };
    for (int i = 0; i < (closed ? n : n + 1); ++i) {
      for (int j = 0; j <= rows; ++j) {
        mesh.points.push_back(point(i, j));
        metric.normals.push_back(normal_and_tensor(i, j).normal);
        metric.tensors.push_back(normal_and_tensor(i, j).tensor);
      }
    }
    for (int i = 0; i < n; ++i) {
      for (int j = 0; j < rows; ++j) {
        mesh.triangles.push_back({number(i, j), number(i + 1, j), number(i + 1, j + 1)});
        mesh.triangles.push_back({number(i, j), number(i + 1, j + 1), number(i, j + 1)});
      }
    }
    const Surface surface = mesh.surface();
    EXPECT_EQ(surface.report().unorientable_edges.size(), closed ? std::size_t{rows} : 0U);
    Embedding embedding = embed(surface, metric);
    expect_sound(surface, embedding);
    return embedding;
  };
  const Embedding closed = strip(true), open = strip(false);
  EXPECT_GT(open.faces_added, 20U);
  EXPECT_EQ(closed.faces_added, open.faces_added);
  ASSERT_EQ(closed.mesh.lengths.size(), open.mesh.lengths.size());
  std::vector<double> a = closed.mesh.lengths, b = open.mesh.lengths;
  std::ranges::sort(a);
  std::ranges::sort(b);
  for (std::size_t i = 0; i < a.size(); ++i) EXPECT_NEAR(a[i], b[i], 1e-12);
}

TEST(Embed, CarriesEdgesWithoutFaces) {
  const Surface surface({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {2, 0, 0}, {3, 3, 3}}, {{0, 1, 2}},
                        std::vector<Edge>{{0, 1}, {1, 3}});
  const Embedding embedding = embed(surface, identity_metric(surface));
  ASSERT_EQ(embedding.mesh.loose_edges.size(), 1U);
  EXPECT_EQ(embedding.mesh.loose_edges[0].a, 1);
  EXPECT_EQ(embedding.mesh.loose_edges[0].b, 3);
  EXPECT_DOUBLE_EQ(embedding.mesh.loose_edges[0].length, surface.scale());
  EXPECT_TRUE(embedding.unreachable.empty());  // vertex 4 is isolated in the input already
}

TEST(Embed, FlipsFacesWithACornerOnTheOppositeEdge) {
  // A square cut along its diagonal 0-2, with vertex 4 on the diagonal, on one side only: face 1 has no area.
  for (const double t : {0.5, 0.3, 1e-3}) {
    const Surface surface({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {t, t, 0}},
                          {{0, 1, 2}, {0, 2, 4}, {0, 4, 3}, {4, 2, 3}});
    ASSERT_EQ(surface.report().zero_area_faces, std::vector<std::int32_t>{1});
    const Embedding embedding = embed(surface, identity_metric(surface));
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

TEST(Embed, MergesVerticesAtTheSamePlace) {
  // A fan about (0.5, 0.5), where vertices 4 and 5 are both: faces 4 and 5 between them have no area.
  const Surface surface({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {.5, .5, 0}, {.5, .5, 0}},
                        {{0, 1, 4}, {1, 2, 5}, {2, 3, 5}, {3, 0, 4}, {1, 5, 4}, {3, 4, 5}});
  ASSERT_EQ(surface.report().zero_area_faces.size(), 2U);
  const Embedding embedding = embed(surface, identity_metric(surface));
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
  const Embedding embedding = embed(surface, identity_metric(surface));
  EXPECT_EQ(embedding.invalid_before, static_cast<std::size_t>(n - 1));
  EXPECT_EQ(embedding.invalid_left, 0U);
  EXPECT_EQ(std::ranges::count(embedding.mesh.twins, -1), 4);
  EXPECT_EQ(std::ranges::count(embedding.source_face, 0), n);
  expect_sound(surface, embedding);
}

TEST(Embed, EndsOnFacesWithoutAnAreaThatNothingMends) {
  // A face in line on its own, one point three times, and two faces back to back.
  const Surface surface({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {5, 5, 5}, {5, 5, 5}, {5, 5, 5}}, {{0, 1, 2}, {3, 4, 5}});
  const Embedding embedding = embed(surface, identity_metric(surface));
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
  EXPECT_EQ(embed(surface, identity_metric(surface)).unreachable, std::vector<std::int32_t>{3});
}

TEST(Embed, TakesTensorsThatDifferByManyOrders) {
  const Surface surface = shapes::grid(4).surface();
  Metric metric = random_metric(surface, 1000, 1);
  metric.tensors[12] *= 1e12;
  const Embedding embedding = embed(surface, metric, {.max_faces_added = 20'000});
  expect_sound(surface, embedding);
  EXPECT_EQ(std::ranges::count(connected_to(embedding.mesh, 0), false), 0);
}

TEST(Embed, RefusesAMetricThatDoesNotFit) {
  const Surface surface = shapes::grid(3).surface();
  Metric metric = plane_metric(surface, 1, 1, 0);
  metric.tensors[5](1, 2) = std::numeric_limits<double>::quiet_NaN();
  try {
    embed(surface, metric);
    ADD_FAILURE() << "nothing thrown";
  } catch (const InvalidInput& error) {
    EXPECT_NE(std::string(error.what()).find("vertex 5 "), std::string::npos) << error.what();
  }
  metric.tensors.pop_back();
  EXPECT_THROW(embed(surface, metric), InvalidInput);
  const Metric good = plane_metric(surface, 1, 1, 0);
  EXPECT_THROW(embed(surface, good, {.sigma = -1}), InvalidInput);
  EXPECT_THROW(embed(surface, good, {.sigma = std::numeric_limits<double>::quiet_NaN()}), InvalidInput);
}

TEST(Embed, ReportsProgressAndStopsWhenTold) {
  const Surface surface = shapes::grid(40).surface();
  const Metric metric = random_metric(surface, 30, 3);
  std::vector<double> seen;
  embed(surface, metric, {}, {.stop = {}, .progress = [&](double done) { return seen.push_back(done), true; }});
  ASSERT_GE(seen.size(), 4U);
  EXPECT_TRUE(std::ranges::is_sorted(seen));
  EXPECT_GE(seen.front(), 0);
  EXPECT_EQ(seen.back(), 1);
  std::size_t calls = 0;
  EXPECT_THROW(embed(surface, metric, {}, {.stop = {}, .progress = [&](double) { return ++calls < 3; }}), Cancelled);
  EXPECT_EQ(calls, 3U);
  std::stop_source source;
  source.request_stop();
  EXPECT_THROW(embed(surface, metric, {}, {.stop = source.get_token(), .progress = {}}), Cancelled);
}

// Distances in an embedding, from one of the caller's vertices to all of them.
std::vector<double> distances(const Surface& surface, const Embedding& embedding, std::int32_t seed) {
  std::vector<double> all = ExactGeodesics(embedding.mesh).solve(seed).distances();
  all.resize(surface.vertex_count());
  return all;
}

std::vector<double> distances(const Surface& surface, const Metric& metric, std::int32_t seed) {
  return distances(surface, embed(surface, metric), seed);
}

// Largest relative difference, the seed left out.
double largest_error(const std::vector<double>& is, const std::function<double(std::size_t)>& expected) {
  double largest = 0;
  for (std::size_t v = 0; v < is.size(); ++v) {
    const double e = expected(v);
    if (e > 0) largest = std::max(largest, std::abs(is[v] - e) / e);
  }
  return largest;
}

// Distance from an angle to another one.
double turn(double from, double to) { return std::abs(std::remainder(to - from, 2 * std::numbers::pi)); }

TEST(EmbeddedDistance, OnAPlaneWithAConstantTensorIsTheNormOfTheVector) {
  const Surface surface = shapes::grid(24, 0.3).surface();
  for (const double a : {1.0, 5.0, 20.0, 100.0}) {
    for (const double angle : {0.0, 0.4, 2.0}) {
      const Metric metric = plane_metric(surface, a, 1 / a, angle);
      for (const std::int32_t seed : {0, 12 * 25 + 12}) {
        const std::vector<double> d = distances(surface, metric, seed);
        const auto expected = [&](std::size_t v) {
          const Vector e = surface.points()[v] - surface.points()[at(seed)];
          return std::sqrt(e.dot(metric.tensors[0] * e));
        };
        EXPECT_LT(largest_error(d, expected), 1e-9) << "A = " << a << ", angle " << angle;
      }
    }
  }
}

TEST(EmbeddedDistance, AtGammaZeroIsEuclidean) {
  for (const Mesh& mesh : {shapes::grid(9, 0.3), shapes::icosphere(3), shapes::cylinder(20, 12), shapes::torus(24, 12),
                           shapes::bumpy(shapes::icosphere(3), 0.05)}) {
    const Surface surface = mesh.surface();
    const Metric metric = feature_metric(surface, principal_curvatures(surface), Follow::kMax, {.parameter = 0});
    const Embedding embedding = embed(surface, metric);
    EXPECT_EQ(embedding.faces_added, 0U);
    const std::vector<double> euclidean = ExactGeodesics(shapes::intrinsic(mesh)).solve(5).distances();
    EXPECT_LT(
        largest_error(distances(surface, embedding, 5), [&](std::size_t v) { return euclidean[v] * surface.scale(); }),
        1e-12);
  }
}

TEST(EmbeddedDistance, OnASphereIsTheArcAtAnyGamma) {
  for (const auto& [level, bound] : {std::pair(3, 4e-3), {4, 1e-3}, {5, 2.5e-4}}) {
    const Surface surface = shapes::icosphere(level).surface();
    const Curvature curvature = principal_curvatures(surface);
    for (const Follow follow : {Follow::kMin, Follow::kMax}) {
      const std::vector<double> d =
          distances(surface, feature_metric(surface, curvature, follow, {.parameter = 50}), 0);
      const Vector from = surface.points()[0].normalized();
      EXPECT_LT(largest_error(d,
                              [&](std::size_t v) {
                                const Vector to = surface.points()[v].normalized();
                                return 0.5 * std::atan2(from.cross(to).norm(), from.dot(to));
                              }),
                bound)
          << "level " << level;
    }
  }
}

TEST(EmbeddedDistance, OnACylinderConvergesToThatOfItsUnrolledPlane) {
  const double r = 0.25, gamma = 1, l1 = 1 + gamma / r;
  struct Row {
    int n;
    double min, max;
  };
  for (const auto& [n, min, max] :
       {Row{32, 8e-3, 2.6e-2}, Row{64, 2e-3, 6.6e-3}, Row{128, 5e-4, 1.7e-3}, Row{256, 1.3e-4, 4.2e-4}}) {
    const int rows = n / 2;
    const Surface surface = shapes::cylinder(n, rows, r).surface();
    ASSERT_DOUBLE_EQ(surface.scale(), 1);
    const Curvature curvature = principal_curvatures(surface);
    const std::int32_t seed = rows / 2 * n;
    for (const Follow follow : {Follow::kMin, Follow::kMax}) {
      const double around = follow == Follow::kMin ? l1 : 1 / l1;
      const std::vector<double> d =
          distances(surface, feature_metric(surface, curvature, follow, {.parameter = gamma}), seed);
      const Vector& from = surface.points()[at(seed)];
      EXPECT_LT(
          largest_error(d,
                        [&](std::size_t v) {
                          const Vector& to = surface.points()[v];
                          const double du = turn(std::atan2(from.y(), from.x()), std::atan2(to.y(), to.x()));
                          return std::sqrt(around * std::pow(r * du, 2) + std::pow(to.z() - from.z(), 2) / around);
                        }),
          follow == Follow::kMin ? min : max)
          << "n = " << n;
    }
  }
}

// Geodesics on a torus of radii R and r from the point v = pi of its inner equator, after Clairaut. The metric is
// E dv^2 + G du^2. Geodesics that leave the groove where G is least have c^2 < min G, so they run on in v and never
// turn: the distance to a point beyond the groove is the least over its images under full turns, of one geodesic each.
struct ClairautTorus {
  double large, small, gamma;
  Follow follow;
  double groove = 0;  // w at which G(pi + w) is least

  double around_tube(double v) const {
    const double l1 = 1 + gamma * (1 / small - std::abs(std::cos(v)) / (large + small * std::cos(v)));
    return follow == Follow::kMin ? l1 : 1 / l1;
  }
  double g(double w) const {
    const double v = std::numbers::pi + w;
    return std::pow(large + small * std::cos(v), 2) / around_tube(v);
  }

  void find_groove() {
    for (int i = 0; i < 100'000; ++i) {
      const double w = std::numbers::pi * i / 100'000;
      if (g(w) < g(groove)) groove = w;
    }
  }

  // u and length between pi + w0 and pi + w1, on one side of the groove, along the geodesic with Clairaut's constant
  // c^2 = (1 - delta) min G.
  Eigen::Vector2d shoot(double w0, double w1, double delta) const {
    const double c2 = (1 - delta) * g(groove), root = std::sqrt(delta), side = w1 > groove ? 1 : -1;
    // The integrand is like 1 / sqrt(delta + x^2), x away from the groove: smooth in y, x = sqrt(delta) sinh y.
    const double first = std::asinh(side * (w0 - groove) / root), last = std::asinh(side * (w1 - groove) / root);
    const int n = 400;
    Eigen::Vector2d sum(0, 0);
    for (int i = 0; i < n; ++i) {
      const double y = first + (last - first) * (i + 0.5) / n, w = groove + side * root * std::sinh(y);
      const double e = around_tube(std::numbers::pi + w) * small * small, gap = std::sqrt(g(w) - c2);
      sum += std::abs(last - first) / n * root * std::cosh(y) / gap *
             Eigen::Vector2d(std::sqrt(c2 * e / g(w)), std::sqrt(e * g(w)));
    }
    return sum;
  }

  // For du and w within half a turn; the other images are farther, as the length grows with both.
  double distance(double du, double w) const {
    const auto along = [&](double delta) { return Eigen::Vector2d(shoot(0, groove, delta) + shoot(groove, w, delta)); };
    double low = 1e-13, high = 1;  // delta: u falls with it
    for (int i = 0; i < 50; ++i) {
      const double middle = std::sqrt(low * high);
      (along(middle).x() > du ? low : high) = middle;
    }
    return along(high).y();
  }
};

TEST(EmbeddedDistance, OnATorusConvergesToClairautsIntegral) {
  for (const Follow follow : {Follow::kMin, Follow::kMax}) {
    ClairautTorus exact{.large = 0.35, .small = 0.15, .gamma = 0.3, .follow = follow};
    exact.find_groove();
    ASSERT_LT(exact.groove, 0.9 * std::numbers::pi / 5);
    struct Target {
      int i, j;  // in fortieths of a turn of u, twentieths of one of v
      double distance;
    };
    std::vector<Target> targets;
    for (int j = 2; j <= 10; j += 2) {
      for (int i = 1; i <= 20; i += 3) {
        targets.push_back({i, j, exact.distance(i * std::numbers::pi / 20, j * std::numbers::pi / 10)});
      }
    }
    for (const auto& [n, bound] : {std::pair(40, 6e-3), {80, 1.5e-3}, {160, 4e-4}}) {
      const Surface surface = shapes::torus(n, n / 2).surface();
      ASSERT_DOUBLE_EQ(surface.scale(), 1);
      const Metric metric = feature_metric(surface, principal_curvatures(surface), follow, {.parameter = exact.gamma});
      const std::vector<double> d = distances(surface, metric, n / 4 * n);
      double sum = 0;
      for (const Target& t : targets) {
        const int row = (n / 4 + t.j * n / 40) % (n / 2), column = t.i * n / 40;
        sum += std::abs(d[at(row * n + column)] - t.distance) / t.distance;
      }
      // M_max stretches the chords of the tube more; on the cylinder, too, it is off by three times as much.
      const double factor = follow == Follow::kMin ? 1 : 3;
      EXPECT_LT(sum / static_cast<double>(targets.size()), factor * bound) << "n = " << n;
    }
  }
}

// Shortest paths over a surface with m points on each edge, joined within each face by straight lines, whose length is
// that of the ambient norm interpolated along the edges. The embedding is no part of this.
std::vector<double> steiner_distances(const Surface& surface, const Metric& metric, int m, std::int32_t seed) {
  struct Node {
    Vector point;
    Eigen::Matrix3d form;
  };
  std::vector<Node> nodes;
  for (std::size_t v = 0; v < surface.vertex_count(); ++v) {
    const Eigen::Matrix3d& tensor = metric.tensors[v];
    nodes.push_back({surface.points()[v] * surface.scale(),
                     tensor + normal_weight(tensor) * metric.normals[v] * metric.normals[v].transpose()});
  }
  std::map<Edge, std::vector<std::size_t>> on_edge;
  for (const Edge& edge : surface.edges()) {
    std::vector<std::size_t>& list = on_edge[edge];
    list.push_back(at(edge[0]));
    for (int i = 1; i <= m; ++i) {
      const double t = double(i) / (m + 1);
      const Node &a = nodes[at(edge[0])], &b = nodes[at(edge[1])];
      list.push_back(nodes.size());
      nodes.push_back({(1 - t) * a.point + t * b.point, (1 - t) * a.form + t * b.form});
    }
    list.push_back(at(edge[1]));
  }
  std::vector<std::vector<std::pair<std::size_t, double>>> links(nodes.size());
  const auto join = [&](std::size_t a, std::size_t b) {
    const Vector e = nodes[b].point - nodes[a].point;
    const double length = integrated_length(std::sqrt(e.dot(nodes[a].form * e)), std::sqrt(e.dot(nodes[b].form * e)));
    links[a].emplace_back(b, length);
    links[b].emplace_back(a, length);
  };
  for (const auto& [edge, list] : on_edge) {
    for (std::size_t i = 1; i < list.size(); ++i) join(list[i - 1], list[i]);
  }
  for (const auto& [a, b, c] : surface.triangles()) {
    const std::array sides{Edge{std::min(a, b), std::max(a, b)}, Edge{std::min(b, c), std::max(b, c)},
                           Edge{std::min(c, a), std::max(c, a)}};
    for (std::size_t i = 0; i < 3; ++i) {
      for (const std::size_t p : on_edge[sides[i]]) {
        for (const std::size_t q : on_edge[sides[(i + 1) % 3]]) {
          if (p != q) join(p, q);
        }
      }
    }
  }
  std::vector<double> result(nodes.size(), std::numeric_limits<double>::infinity());
  using Entry = std::pair<double, std::size_t>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
  result[at(seed)] = 0;
  queue.emplace(0, at(seed));
  while (!queue.empty()) {
    const auto [distance, node] = queue.top();
    queue.pop();
    if (distance > result[node]) continue;
    for (const auto& [to, length] : links[node]) {
      if (distance + length >= result[to]) continue;
      result[to] = distance + length;
      queue.emplace(result[to], to);
    }
  }
  result.resize(surface.vertex_count());
  return result;
}

TEST(EmbeddedDistance, IsWhatPathsOverPointsOnTheEdgesFallTowards) {
  const Surface surface = shapes::torus(48, 24).surface();
  const Metric metric = feature_metric(surface, principal_curvatures(surface), Follow::kMin, {.max_anisotropy = 5});
  const std::vector<double> d = distances(surface, metric, 0);
  double last = 1;
  for (const auto& [m, bound] : {std::pair(3, 2e-2), {6, 7e-3}, {12, 2e-3}}) {
    const std::vector<double> steiner = steiner_distances(surface, metric, m, 0);
    double above = 0;
    for (std::size_t v = 1; v < d.size(); ++v) above += (steiner[v] - d[v]) / d[v];
    above /= static_cast<double>(d.size() - 1);
    EXPECT_LT(above, bound) << m;
    EXPECT_LT(above, last) << m;
    // They fall towards the distance of their own interpolation of the norm, which differs by the order of h^2.
    EXPECT_GT(above, -1e-3) << m;
    last = above;
  }
}

TEST(EmbeddedDistance, IsExactOnTheEmbeddedLengths) {
  const Surface surface = shapes::bumpy(shapes::icosphere(2), 0.05).surface();
  const Curvature curvature = principal_curvatures(surface);
  const Strength strength{.max_anisotropy = 20};
  std::size_t added = 0;
  for (const Metric& metric : {feature_metric(surface, curvature, Follow::kMin, strength),
                               feature_metric(surface, curvature, Follow::kMax, strength),
                               campen_metric(surface, curvature, Follow::kMin, {.max_anisotropy = 8}),
                               pottmann_kovacs_metric(surface, curvature, Follow::kMin, strength)}) {
    const Embedding embedding = embed(surface, metric, {.sigma = 1e-3});
    added += embedding.faces_added;
    const ExactGeodesics solver(embedding.mesh);
    const DistanceField field = solver.solve(3);
    const std::vector<double> expected = reference::Geodesics(embedding.mesh).distances(3);
    EXPECT_LT(largest_error(field.distances(), [&](std::size_t v) { return expected[v]; }), 1e-9);
    for (std::int32_t v = 0; v < embedding.mesh.vertex_count; ++v) {
      const double distance = field.distances()[at(v)];
      EXPECT_NEAR(field.trace(v).length, distance, 1e-9 * distance);
    }
  }
  EXPECT_GT(added, 200U);
}

TEST(EmbeddedDistance, DoesNotDependOnTheScaleOfTheInput) {
  const Mesh mesh = shapes::bumpy(shapes::torus(32, 16), 0.03);
  const auto along = [](const Mesh& scaled) {
    const Surface surface = scaled.surface();
    const Metric metric = feature_metric(surface, principal_curvatures(surface), Follow::kMax, {.max_anisotropy = 10});
    const Embedding embedding = embed(surface, metric);
    EXPECT_GT(embedding.faces_added, 100U);
    return distances(surface, embedding, 7);
  };
  const std::vector<double> expected = along(mesh);
  for (const double scale : {1e-3, 0.3, 7.0, 1e5}) {
    Mesh scaled = mesh;
    for (Vector& p : scaled.points) p *= scale;
    EXPECT_LT(largest_error(along(scaled), [&](std::size_t v) { return expected[v]; }), 1e-12) << scale;
  }
}

TEST(EmbeddedDistance, GoesStraightOverFacesWithoutAnArea) {
  // A jittered grid where one vertex more lies on an edge, for one of the edge's two faces only, and another one at the
  // place of a vertex: distances are those of the plane.
  Mesh mesh = shapes::grid(8, 0.3);
  std::vector<Triangle> triangles;
  const std::int32_t on_edge = static_cast<std::int32_t>(mesh.points.size()), twin = on_edge + 1;
  // The first face of cell (3, 3) has corners 30, 31, 40; its diagonal 30-40 gets the new vertex.
  mesh.points.push_back((mesh.points[30] + mesh.points[40]) / 2);
  std::erase(mesh.triangles, Triangle{30, 31, 40});
  for (const Triangle& t : {Triangle{30, 31, on_edge}, Triangle{31, 40, on_edge}, Triangle{30, on_edge, 40}}) {
    mesh.triangles.push_back(t);
  }
  // Vertex 20 is one for its faces below and right of it, and another one for those above and left.
  mesh.points.push_back(mesh.points[20]);
  for (Triangle& t : mesh.triangles) {
    for (std::int32_t& v : t) {
      if (v == 20 && std::ranges::count(t, 30) + std::ranges::count(t, 29) + std::ranges::count(t, 19) > 0) v = twin;
    }
  }
  std::vector<std::int32_t> rim;
  for (const Triangle& t : mesh.triangles) {
    if (std::ranges::count(t, twin) > 0) rim.insert(rim.end(), t.begin(), t.end());
  }
  // The two fans part along the two edges that have one vertex of each: close the gaps.
  std::set<std::int32_t> shared;
  for (const Triangle& t : mesh.triangles) {
    if (std::ranges::count(t, 20) == 0) continue;
    for (const std::int32_t v : t) {
      if (v != 20 && std::ranges::count(rim, v) > 0) shared.insert(v);
    }
  }
  ASSERT_EQ(shared.size(), 2U);
  for (const std::int32_t v : shared) mesh.triangles.push_back({20, twin, v});
  const Surface surface = mesh.surface();
  ASSERT_EQ(surface.report().zero_area_faces.size(), 3U);
  ASSERT_EQ(surface.report().boundary_edges, 32U);
  const Embedding embedding = embed(surface, plane_metric(surface, 1, 1, 0));
  EXPECT_EQ(embedding.invalid_before, 3U);
  EXPECT_EQ(embedding.invalid_left, 0U);
  for (const std::int32_t seed : {0, 10, 20, twin, on_edge, 44}) {
    const std::vector<double> d = distances(surface, embedding, seed);
    for (std::size_t v = 0; v < d.size(); ++v) {
      EXPECT_NEAR(d[v], (surface.points()[v] - surface.points()[at(seed)]).norm(), 1e-12);
    }
  }
}

TEST(EmbeddedDistance, IsFiniteOverHoles) {
  const Surface surface = shapes::grid(12).surface();
  const Metric metric = random_metric(surface, 10, 3);
  for (const std::size_t cap : {0, 40}) {
    const Embedding embedding = embed(surface, metric, {.max_faces_added = cap});
    ASSERT_GT(embedding.invalid_left, 0U);
    for (const double d : distances(surface, embedding, 0)) EXPECT_TRUE(std::isfinite(d));
  }
}

}  // namespace
}  // namespace seamwire
