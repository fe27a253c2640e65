// SPDX-License-Identifier: GPL-3.0-or-later
//
// Embeddings of surfaces with edges of three or more faces, and of surfaces that have one side only.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <numbers>
#include <optional>
#include <random>
#include <vector>

#include "embeddings.hpp"
#include "seamwire/embedding/embedding.hpp"
#include "seamwire/metric/curvature.hpp"
#include "shapes.hpp"

namespace seamwire {

using namespace detail;

namespace {

using embeddings::at;
using embeddings::expect_sound;
using embeddings::identity_metric;
using shapes::Mesh;

// All half-edges with the same ends are one edge: twins, or one cycle of siblings, of one length.
void expect_joined(const IntrinsicMesh& mesh) {
  std::map<Edge, std::vector<std::int32_t>> edges;
  const auto count = static_cast<std::int32_t>(mesh.twins.size());
  for (std::int32_t h = 0; h < count; ++h) {
    const auto [a, b] = std::minmax({mesh.tail(h), mesh.tip(h)});
    edges[{a, b}].push_back(h);
  }
  ASSERT_TRUE(mesh.siblings.empty() || mesh.siblings.size() == mesh.twins.size());
  for (const auto& [edge, half_edges] : edges) {
    for (const std::int32_t h : half_edges) {
      std::vector<std::int32_t> others{h};
      mesh.for_each_beyond(h, [&](std::int32_t other) { others.push_back(other); });
      std::ranges::sort(others);
      ASSERT_EQ(others, half_edges) << edge[0] << " " << edge[1];
      ASSERT_EQ(mesh.lengths[at(h)], mesh.lengths[at(half_edges[0])]);
      if (mesh.twins[at(h)] >= 0) {
        ASSERT_EQ(mesh.tail(mesh.twins[at(h)]), mesh.tip(h));
      } else if (half_edges.size() == 2) {
        ASSERT_EQ(mesh.tail(half_edges[0]), mesh.tail(half_edges[1]));
      }
    }
  }
}

// `pages` half planes around the z axis, of n cells across and n cells along it, three times as long; every other one
// is turned over.
Mesh book(int pages, int n) {
  Mesh mesh;
  for (int j = 0; j <= n; ++j) mesh.points.emplace_back(0, 0, 3.0 * j / n);
  for (int page = 0; page < pages; ++page) {
    const double angle = 2 * std::numbers::pi * (page + 0.1 * page * page) / pages / 1.5;
    const auto first = static_cast<std::int32_t>(mesh.points.size());
    const auto number = [&](int i, int j) { return i == 0 ? j : first + (i - 1) * (n + 1) + j; };
    for (int i = 1; i <= n; ++i) {
      for (int j = 0; j <= n; ++j) {
        mesh.points.emplace_back(double(i) / n * std::cos(angle), double(i) / n * std::sin(angle), 3.0 * j / n);
      }
    }
    for (int i = 0; i < n; ++i) {
      for (int j = 0; j < n; ++j) {
        Triangle a{number(i, j), number(i + 1, j), number(i + 1, j + 1)};
        Triangle b{number(i, j), number(i + 1, j + 1), number(i, j + 1)};
        if (page % 2 == 1) std::swap(a[1], a[2]), std::swap(b[1], b[2]);
        mesh.triangles.insert(mesh.triangles.end(), {a, b});
      }
    }
  }
  return mesh;
}

// At each vertex another direction, in the plane of its normal.
Metric random_metric_on(const Surface& surface, double a, unsigned seed) {
  Metric metric = euclidean_metric(surface, principal_curvatures(surface));
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> number(-1, 1);
  for (std::size_t v = 0; v < metric.size(); ++v) {
    Vector& n = metric.normals[v];
    if (n.isZero(0)) n = Vector(number(random), number(random), number(random)).normalized();
    const Vector e1 = n.cross(Vector(number(random), number(random), number(random))).normalized();
    metric.tensors[v] = a * e1 * e1.transpose() + n.cross(e1) * n.cross(e1).transpose() / a;
  }
  return metric;
}

TEST(EmbedSiblings, AreBisectedTogether) {
  for (int pages = 2; pages <= 6; ++pages) {
    const Surface surface = book(pages, 6).surface();
    std::size_t on_spine = 0;
    for (const double a : {2.0, 10.0, 50.0}) {
      const Metric metric = random_metric_on(surface, a, 3);
      for (const EmbedOptions& options : {EmbedOptions{}, EmbedOptions{.max_error = 0.02}}) {
        const Embedding embedding = embed(surface, metric, options);
        EXPECT_EQ(embedding.invalid_left, 0U);
        EXPECT_EQ(embedding.mesh.siblings.empty(), pages == 2);
        expect_sound(surface, embedding);
        expect_joined(embedding.mesh);
        ASSERT_EQ(embedding.points.size(), at(embedding.mesh.vertex_count));
        EXPECT_EQ(embedding.mesh.face_count(), surface.face_count() + embedding.faces_added);
        for (const Vector& p : embedding.points) on_spine += p.x() == 0 && p.y() == 0;
      }
    }
    EXPECT_GT(on_spine, std::size_t{6 * 7}) << "the spine is not bisected";
  }
}

TEST(EmbedSiblings, StayJoinedInEveryScheme) {
  // A torus with a fin all around, on which the paper's scheme does not end; and pages that only length repair ends on.
  Mesh mesh = shapes::torus(24, 40);
  const std::size_t on_torus = mesh.triangles.size();
  const auto first = static_cast<std::int32_t>(mesh.points.size());
  for (std::size_t i = 0; i < 24; ++i) mesh.points.emplace_back(1.3 * mesh.points[i]);  // the outer equator
  for (std::int32_t i = 0; i < 24; ++i) {
    const std::int32_t j = (i + 1) % 24;
    mesh.triangles.push_back({i, j, first + i});
    mesh.triangles.push_back({first + i, j, first + j});
  }
  const Surface surface = mesh.surface();
  ASSERT_EQ(surface.report().nonmanifold_edges.size(), 24U);
  const Curvature curvature = principal_curvatures(surface);
  for (const double a : {15.0, 100.0}) {
    const Metric metric = feature_metric(surface, curvature, Follow::kMax, {.max_anisotropy = a});
    const Embedding embedding = embed(surface, metric, {.max_error = 0});
    EXPECT_GT(embedding.faces_added, on_torus);
    EXPECT_EQ(embedding.invalid_left, 0U);
    expect_sound(surface, embedding);
    expect_joined(embedding.mesh);
  }
  const Surface pages = book(4, 5).surface();
  const Embedding repaired = embed(pages, random_metric_on(pages, 100, 1), {.max_faces_added = 200, .max_error = 0});
  EXPECT_GT(repaired.clamped_edges, 0U);
  expect_joined(repaired.mesh);
}

TEST(EmbedSiblings, AreThoseWithoutTheHoles) {
  const Surface surface = book(4, 5).surface();
  const Metric metric = random_metric_on(surface, 20, 2);
  for (const std::size_t cap : {0U, 3U, 20U, 50U}) {
    const Embedding embedding = embed(surface, metric, {.max_faces_added = cap, .max_error = 0});
    EXPECT_LE(embedding.faces_added, cap);
    EXPECT_GT(embedding.invalid_left, 0U);
    expect_joined(embedding.mesh);
    // No edge of a triangle is a loose one too.
    for (const LooseEdge& edge : embedding.mesh.loose_edges) {
      for (std::int32_t h = 0; at(h) < embedding.mesh.twins.size(); ++h) {
        const bool is_it =
            std::minmax({embedding.mesh.tail(h), embedding.mesh.tip(h)}) == std::minmax({edge.a, edge.b});
        EXPECT_FALSE(is_it) << edge.a << " " << edge.b;
      }
    }
  }
}

TEST(EmbedSiblings, OfSomeFacesAreAmongThem) {
  const Surface surface = book(3, 4).surface();
  const Metric metric = random_metric_on(surface, 10, 2);
  std::vector<std::int32_t> faces(64);
  for (std::size_t i = 0; i < 64; ++i) faces[i] = static_cast<std::int32_t>(i);
  const Embedding two_pages = embed(surface, metric, {.max_error = 0, .faces = faces});
  EXPECT_TRUE(two_pages.mesh.siblings.empty());
  expect_joined(two_pages.mesh);
  for (std::int32_t f = 64; f < 80; ++f) faces.push_back(f);
  const Embedding embedding = embed(surface, metric, {.max_error = 0, .faces = faces});
  EXPECT_FALSE(embedding.mesh.siblings.empty());
  expect_joined(embedding.mesh);
}

TEST(EmbedSiblings, AreOfOneEdgeWhereDegenerateFacesAreRemoved) {
  // A fin over the middle of a square; a needle and a cap beside it. Vertices 6 and 1 are in one place.
  const Surface surface({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {.5, .5, 1}, {.5, .5, 0}, {1, 0, 0}},
                        {{0, 1, 2}, {0, 2, 3}, {0, 2, 4}, {0, 5, 2}, {0, 6, 1}, {1, 6, 4}, {1, 4, 2}});
  ASSERT_FALSE(surface.report().zero_area_faces.empty());
  ASSERT_FALSE(surface.report().nonmanifold_edges.empty());
  const Embedding embedding = embed(surface, identity_metric(surface), {.max_error = 0});
  const IntrinsicMesh& mesh = embedding.mesh;
  for (std::int32_t h = 0; at(h) < mesh.siblings.size(); ++h) {
    mesh.for_each_beyond(h, [&](std::int32_t other) {
      EXPECT_EQ(std::minmax({mesh.tail(h), mesh.tip(h)}), std::minmax({mesh.tail(other), mesh.tip(other)}));
      EXPECT_EQ(mesh.lengths[at(h)], mesh.lengths[at(other)]);
    });
  }
  EXPECT_FALSE(mesh.siblings.empty());
}

// A surface with one side only and its double cover: a band of `columns` columns of `rows` cells, which closes after
// one lap with its rows in opposite order, or after two laps.
struct OneSided {
  using PointAt = std::function<Vector(double u, double v)>;  // u: laps

  OneSided(const PointAt& point, int columns, int rows, bool is_tube, double a, int laps) {
    const int lines = is_tube ? rows : rows + 1;
    const auto turned = [&](int j) { return is_tube ? (rows - j) % rows : rows - j; };
    Mesh mesh;
    const auto number = [&](int i, int j) {
      if (is_tube) j %= rows;
      if (i >= laps * columns) i -= laps * columns, j = laps == 1 ? turned(j) : j;
      return i * lines + j;
    };
    for (int i = 0; i < laps * columns; ++i) {
      for (int j = 0; j < lines; ++j) {
        const bool is_second = i >= columns;
        const double u = double(i % columns) / columns, v = double(is_second ? turned(j) : j) / rows, h = 1e-4;
        const Vector along = (point(u + h, v) - point(u - h, v)).normalized();
        const Vector n = along.cross(point(u, v + h) - point(u, v - h)).normalized();
        const double angle = 5 * u + 4 * std::sin(2 * std::numbers::pi * v);
        const Vector e1 = std::cos(angle) * along + std::sin(angle) * n.cross(along), e2 = n.cross(e1);
        mesh.points.push_back(point(u, v));
        metric.normals.push_back(is_second ? Vector(-n) : n);
        metric.tensors.push_back(a * e1 * e1.transpose() + e2 * e2.transpose() / a);
      }
    }
    for (int i = 0; i < laps * columns; ++i) {
      for (int j = 0; j < rows; ++j) {
        // The diagonals of the second lap are those of the first.
        Triangle one{number(i, j), number(i + 1, j), number(i + 1, j + 1)};
        Triangle two{number(i, j), number(i + 1, j + 1), number(i, j + 1)};
        if (i >= columns) {
          one = {number(i, j), number(i + 1, j), number(i, j + 1)};
          two = {number(i + 1, j), number(i + 1, j + 1), number(i, j + 1)};
        }
        mesh.triangles.insert(mesh.triangles.end(), {one, two});
      }
    }
    surface.emplace(mesh.surface());
  }

  std::optional<Surface> surface;
  Metric metric;
};

Vector on_moebius_strip(double u, double v) {
  const double t = 2 * std::numbers::pi * u, w = 0.5 * (v - 0.5);
  return {(1 + w * std::cos(t / 2)) * std::cos(t), (1 + w * std::cos(t / 2)) * std::sin(t), w * std::sin(t / 2)};
}

// A figure of eight that makes half a turn on its way around.
Vector on_klein_bottle(double u, double v) {
  const double t = 2 * std::numbers::pi * u, w = 2 * std::numbers::pi * v;
  const double x = std::sin(w), y = std::sin(2 * w), c = std::cos(t / 2), s = std::sin(t / 2);
  return {(3 + c * x - s * y) * std::cos(t), (3 + c * x - s * y) * std::sin(t), s * x + c * y};
}

TEST(EmbedSiblings, OfAOneSidedSurfaceAreHalfOfItsDoubleCover) {
  struct Case {
    OneSided::PointAt point;
    int rows;
    bool is_tube;
  };
  for (const Case& shape : {Case{&on_moebius_strip, 5, false}, Case{&on_klein_bottle, 24, true}}) {
    for (const double a : {4.0, 20.0}) {
      const OneSided single(shape.point, 28, shape.rows, shape.is_tube, a, 1);
      const OneSided cover(shape.point, 28, shape.rows, shape.is_tube, a, 2);
      ASSERT_FALSE(single.surface->report().unorientable_edges.empty());
      ASSERT_TRUE(cover.surface->report().unorientable_edges.empty());
      for (const double max_error : {0.0, 0.02}) {
        const Embedding half = embed(*single.surface, single.metric, {.max_error = max_error});
        const Embedding whole = embed(*cover.surface, cover.metric, {.max_error = max_error});
        EXPECT_GT(half.faces_added, 50U);
        EXPECT_FALSE(half.mesh.siblings.empty());
        expect_sound(*single.surface, half);
        expect_joined(half.mesh);
        EXPECT_EQ(whole.faces_added, 2 * half.faces_added);
        ASSERT_EQ(whole.mesh.lengths.size(), 2 * half.mesh.lengths.size());
        std::vector<double> lengths = half.mesh.lengths, twice = whole.mesh.lengths;
        lengths.insert(lengths.end(), half.mesh.lengths.begin(), half.mesh.lengths.end());
        std::ranges::sort(lengths);
        std::ranges::sort(twice);
        for (std::size_t i = 0; i < twice.size(); ++i) ASSERT_NEAR(lengths[i], twice[i], 1e-12 * twice[i]);
      }
    }
  }
}

}  // namespace
}  // namespace seamwire
