// SPDX-License-Identifier: GPL-3.0-or-later
//
// The subdivision ends, with nothing left and below the cap, on slivers and at any strength; and costs little where the
// paper's own scheme ends.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <map>
#include <numbers>
#include <optional>
#include <queue>
#include <random>
#include <string>
#include <tuple>

#include "embeddings.hpp"
#include "intrinsic.hpp"
#include "seamwire/geodesics/exact_geodesics.hpp"
#include "seamwire/metric/curvature.hpp"

namespace seamwire {
namespace {

using embeddings::at;
using embeddings::expect_sound;
using shapes::Mesh;

Mesh squeezed(Mesh mesh, double factor, int axis) {
  for (Vector& p : mesh.points) p[axis] *= factor;
  return mesh;
}

Mesh wave() {
  Mesh mesh = shapes::grid(12, 0.2);
  for (Vector& p : mesh.points) p.z() = 0.05 * std::sin(9 * p.x() + 5 * p.y());
  return mesh;
}

/// Shapes whose triangles are `aspect` times as long as they are high.
std::vector<shapes::Named> slivers(double aspect) {
  const int around = static_cast<int>(std::min(aspect, 300.0));
  return {{"jittered grid", squeezed(shapes::grid(8, 0.3), 1 / aspect, 1)},
          {"wave", squeezed(wave(), 1 / aspect, 1)},
          {"disc", squeezed(shapes::icosphere(2), 1 / aspect, 2)},
          {"cigar", squeezed(shapes::bumpy(shapes::icosphere(2), 0.05), aspect, 0)},
          {"staves", shapes::cylinder(around, 2)},
          {"hoops", shapes::cylinder(8, 2 * around, 0.4, 4 / aspect)},
          {"flat torus", shapes::bumpy(squeezed(shapes::torus(24, 12), 1 / aspect, 2), 0.002)}};
}

/// A random direction at each vertex, at anisotropy `a`.
Metric random_metric(const Surface& surface, const Curvature& curvature, double a) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> angle(0, std::numbers::pi);
  Metric metric{curvature.normals, {}};
  for (std::size_t v = 0; v < surface.vertex_count(); ++v) {
    const Vector& n = curvature.normals[v];
    const Vector e = n.unitOrthogonal(), f = n.cross(e);
    const double t = angle(random);
    const Vector e1 = std::cos(t) * e + std::sin(t) * f, e2 = std::cos(t) * f - std::sin(t) * e;
    metric.tensors.emplace_back(a * e1 * e1.transpose() + 1 / a * e2 * e2.transpose());
  }
  return metric;
}

/// Section 4.1 of the paper and nothing more: the triangles it adds, or nullopt where they are more than `most`.
std::optional<std::size_t> added_by_papers_scheme(const Surface& surface, const Metric& metric, std::size_t most) {
  std::vector<Vector> points;
  std::vector<TensorAt> tensors;
  for (std::size_t v = 0; v < surface.vertex_count(); ++v) {
    points.emplace_back(surface.points()[v]);
    tensors.push_back({metric.normals[v], metric.tensors[v]});
  }
  std::vector<Triangle> faces = surface.triangles();
  std::map<Edge, std::vector<std::size_t>> faces_at;
  const auto sides = [&](std::size_t f) {
    const auto& [a, b, c] = faces[f];
    return std::array{Edge{std::min(a, b), std::max(a, b)}, Edge{std::min(b, c), std::max(b, c)},
                      Edge{std::min(c, a), std::max(c, a)}};
  };
  const auto length = [&](const Edge& edge) {
    const Vector e = points[at(edge[1])] - points[at(edge[0])];
    return integrated_length(ambient_norm(tensors[at(edge[0])], e), ambient_norm(tensors[at(edge[1])], e));
  };
  std::priority_queue<std::pair<double, std::size_t>> queue;
  const auto perimeter = [&](std::size_t f) {
    const auto [a, b, c] = sides(f);
    return length(a) + length(b) + length(c);
  };
  const auto longest = [&](std::size_t f) {
    const auto all = sides(f);
    return *std::ranges::max_element(all, {}, length);
  };
  const auto consider = [&](std::size_t f) {
    const double whole = perimeter(f), most_of_it = length(longest(f));
    if (most_of_it >= (whole - most_of_it) * (1 - 1e-10)) queue.emplace(whole, f);
  };
  for (std::size_t f = 0; f < faces.size(); ++f) {
    for (const Edge& side : sides(f)) faces_at[side].push_back(f);
    consider(f);
  }
  std::size_t added = 0;
  while (!queue.empty()) {
    const auto [key, face] = queue.top();
    queue.pop();
    if (key != perimeter(face)) continue;
    if (added >= most) return std::nullopt;
    const Edge edge = longest(face);
    const auto middle = static_cast<std::int32_t>(points.size());
    points.emplace_back((points[at(edge[0])] + points[at(edge[1])]) / 2);
    tensors.push_back(midpoint_tensor(tensors[at(edge[0])], tensors[at(edge[1])]));
    for (const std::size_t f : std::vector<std::size_t>(faces_at[edge])) {
      const std::size_t g = faces.size();
      for (const Edge& side : sides(f)) std::erase(faces_at[side], f);
      faces.push_back(faces[f]);
      std::ranges::replace(faces[f], edge[1], middle);
      std::ranges::replace(faces[g], edge[0], middle);
      for (const std::size_t part : {f, g}) {
        for (const Edge& side : sides(part)) faces_at[side].push_back(part);
        consider(part);
      }
      ++added;
    }
  }
  return added;
}

// Under M_max the paper's scheme alone adds over four million triangles here.
TEST(EmbeddingEnds, WhereThePapersSchemeDoesNot) {
  const Surface surface = shapes::torus(24, 40).surface();
  const Curvature curvature = principal_curvatures(surface);
  for (const double a : {15.0, 20.0, 30.0, 100.0, 1000.0}) {
    for (const Follow follow : {Follow::kMin, Follow::kMax}) {
      const Embedding embedding =
          embed(surface, feature_metric(surface, curvature, follow, {.max_anisotropy = a}), {.max_error = 0});
      EXPECT_FALSE(embedding.hit_cap) << a;
      EXPECT_EQ(embedding.invalid_left, 0U) << a;
      EXPECT_LT(embedding.faces_added, 200'000U) << a;
      expect_sound(surface, embedding);
    }
  }
}

// The paper's scheme left 476 triangles at a cap of 10 000, and 104 at one of 20 000, which is as many as it may add
// here before the others are tried.
TEST(EmbeddingEnds, WithFewerHolesTheMoreTrianglesItMayAdd) {
  for (const auto& [name, mesh, a] : {std::tuple("torus", shapes::torus(24, 40), 15.0),
                                      std::tuple("bumpy", shapes::bumpy(shapes::torus(20, 10), 0.05), 100.0),
                                      std::tuple("slivers", slivers(30)[1].mesh, 30.0)}) {
    SCOPED_TRACE(name);
    const Surface surface = mesh.surface();
    const Metric metric = feature_metric(surface, principal_curvatures(surface), Follow::kMax, {.max_anisotropy = a});
    std::size_t before = std::numeric_limits<std::size_t>::max();
    for (const std::size_t cap :
         {0,     1,     2,     5,     10,    30,     100,    200,    300,    500,    700,   1'000,
          1'500, 2'000, 3'000, 5'000, 7'000, 10'000, 19'999, 20'000, 20'001, 40'000, 80'000}) {
      const Embedding embedding = embed(surface, metric, {.max_faces_added = cap, .max_error = 0});
      EXPECT_LE(embedding.faces_added, cap);
      EXPECT_LE(embedding.invalid_left, before) << cap;
      EXPECT_EQ(embedding.hit_cap, embedding.invalid_left > 0) << cap;
      before = embedding.invalid_left;
      if (cap % 1000 == 0) expect_sound(surface, embedding);
      if (cap >= 10'000) {
        EXPECT_EQ(embedding.invalid_left, 0U) << cap;
      }
    }
  }
}

TEST(EmbeddingEnds, ByNewestVertexBisectionWherePropagationGoesTooDeep) {
  const Surface surface = shapes::torus(24, 40).surface();
  const Curvature curvature = principal_curvatures(surface);
  const Embedding embedding =
      embed(surface, feature_metric(surface, curvature, Follow::kMax, {.max_anisotropy = 1000}), {.max_error = 0});
  EXPECT_GT(embedding.newest_bisections, 100U);
  EXPECT_FALSE(embedding.hit_cap);
  EXPECT_EQ(embedding.invalid_left, 0U);
  expect_sound(surface, embedding);
  // Where the paper's scheme ends there is no need of it.
  const Embedding mild =
      embed(surface, feature_metric(surface, curvature, Follow::kMax, {.max_anisotropy = 10}), {.max_error = 0});
  EXPECT_GT(mild.faces_added, 0U);
  EXPECT_EQ(mild.newest_bisections, 0U);
}

TEST(EmbeddingEnds, OnBumpyShapesAtAnyAnisotropy) {
  for (const Mesh& mesh : {shapes::bumpy(shapes::icosphere(3), 0.05), shapes::bumpy(shapes::torus(40, 20), 0.05)}) {
    const Surface surface = mesh.surface();
    const Curvature curvature = principal_curvatures(surface);
    for (const double a : {100.0, 1000.0}) {
      for (const Follow follow : {Follow::kMin, Follow::kMax}) {
        const Embedding embedding =
            embed(surface, feature_metric(surface, curvature, follow, {.max_anisotropy = a}), {.max_error = 0});
        EXPECT_FALSE(embedding.hit_cap) << a;
        EXPECT_EQ(embedding.invalid_left, 0U) << a;
        expect_sound(surface, embedding);
      }
    }
  }
}

class EmbeddingEndsOn : public testing::TestWithParam<int> {};

TEST_P(EmbeddingEndsOn, SliversAtAnyStrength) {
  const double aspect = GetParam();
  for (const auto& [name, mesh] : slivers(aspect)) {
    const Surface surface = mesh.surface();
    const Curvature curvature = principal_curvatures(surface);
    for (const double a : {10.0, 100.0, 1000.0}) {
      for (const auto& [kind, metric] :
           {std::pair("M_min", feature_metric(surface, curvature, Follow::kMin, {.max_anisotropy = a})),
            std::pair("M_max", feature_metric(surface, curvature, Follow::kMax, {.max_anisotropy = a})),
            std::pair("random", random_metric(surface, curvature, a))}) {
        SCOPED_TRACE(name + ", " + kind + ", A = " + std::to_string(a));
        const Embedding embedding = embed(surface, metric, {.max_error = 0});
        EXPECT_FALSE(embedding.hit_cap);
        EXPECT_EQ(embedding.invalid_left, 0U);
        EXPECT_TRUE(embedding.unreachable.empty());
        EXPECT_LT(embedding.faces_added, 600'000U);
        if (embedding.faces_added < 20'000) expect_sound(surface, embedding);
      }
    }
  }
}

/// How many lengths are not the metric's there, in all, as part of the triangles added; and the largest factor between
/// the two. Length repair alone, without the bisections before it, clamps more.
TEST_P(EmbeddingEndsOn, SliversWithABoundOnClampedLengths) {
  const double aspect = GetParam();
  // As measured, with a tenth more.
  const std::map<std::pair<int, int>, std::pair<double, double>> bounds{
      {{10, 10}, {0, 1}},        {{10, 100}, {0.072, 30}},    {{10, 1000}, {0.22, 384}},
      {{100, 10}, {0.33, 38}},   {{100, 100}, {0.28, 146}},   {{100, 1000}, {0.343, 2100}},
      {{1000, 10}, {0.42, 166}}, {{1000, 100}, {0.392, 716}}, {{1000, 1000}, {0.404, 17900}}};
  for (const int a : {10, 100, 1000}) {
    std::size_t added = 0, clamped = 0;
    double worst = 1;
    for (const auto& [name, mesh] : slivers(aspect)) {
      const Surface surface = mesh.surface();
      const Curvature curvature = principal_curvatures(surface);
      for (const Follow follow : {Follow::kMin, Follow::kMax}) {
        const Metric metric = feature_metric(surface, curvature, follow, {.max_anisotropy = double(a)});
        const Embedding embedding = embed(surface, metric, {.max_error = 0});
        added += embedding.faces_added;
        clamped += embedding.clamped_edges;
        worst = std::max(worst, embedding.worst_clamp);
      }
    }
    const auto [part, factor] = bounds.at({GetParam(), a});
    EXPECT_LE(static_cast<double>(clamped), part * static_cast<double>(added)) << a;
    EXPECT_LE(worst, factor) << a;
  }
}

INSTANTIATE_TEST_SUITE_P(Aspects, EmbeddingEndsOn, testing::Values(10, 100, 1000));

/// On slivers nothing is left because lengths are clamped, which says how far they are from the metric's; on meshes as
/// people make them few are.
TEST(EmbeddingEnds, SayingHowManyLengthsAreNotTheMetrics) {
  const Surface torus = shapes::torus(24, 40).surface();
  const Curvature of_torus = principal_curvatures(torus);
  for (const double a : {2.0, 5.0, 10.0, 15.0, 20.0, 30.0}) {
    for (const Follow follow : {Follow::kMin, Follow::kMax}) {
      const Embedding embedding =
          embed(torus, feature_metric(torus, of_torus, follow, {.max_anisotropy = a}), {.max_error = 0});
      EXPECT_EQ(embedding.clamped_edges, 0U) << a;
      EXPECT_EQ(embedding.worst_clamp, 1.0) << a;
      EXPECT_TRUE(embedding.repaired_faces.empty()) << a;
    }
  }
  const Surface bumpy = shapes::bumpy(shapes::icosphere(3), 0.05).surface();
  const Curvature of_bumpy = principal_curvatures(bumpy);
  for (const double a : {10.0, 30.0, 100.0}) {
    const Embedding embedding =
        embed(bumpy, feature_metric(bumpy, of_bumpy, Follow::kMax, {.max_anisotropy = a}), {.max_error = 0});
    EXPECT_EQ(embedding.clamped_edges, 0U) << a;
  }
  for (const double aspect : {1.0, 3.0, 10.0}) {
    for (const auto& [name, mesh] : slivers(aspect)) {
      const Surface surface = mesh.surface();
      const Curvature curvature = principal_curvatures(surface);
      for (const double a : {10.0, 30.0, 100.0, 1000.0}) {
        if (aspect > 3 && a > 30) continue;
        for (const Follow follow : {Follow::kMin, Follow::kMax}) {
          const Embedding embedding =
              embed(surface, feature_metric(surface, curvature, follow, {.max_anisotropy = a}), {.max_error = 0});
          EXPECT_EQ(embedding.clamped_edges, 0U) << name << ", aspect " << aspect << ", A = " << a;
        }
      }
    }
  }
  for (const auto& [name, mesh] : shapes::exactness_meshes(2)) {
    const Surface surface = mesh.surface();
    const Curvature curvature = principal_curvatures(surface);
    for (const double a : {5.0, 20.0, 100.0, 1000.0}) {
      for (const Follow follow : {Follow::kMin, Follow::kMax}) {
        const Embedding embedding =
            embed(surface, feature_metric(surface, curvature, follow, {.max_anisotropy = a}), {.max_error = 0});
        EXPECT_LE(embedding.clamped_edges, a > 100 ? 300U : 0U) << name << ", A = " << a;
        EXPECT_LE(embedding.worst_clamp, a > 100 ? 5.5 : 1.0) << name << ", A = " << a;
      }
    }
  }
  const Surface sliver = slivers(100)[3].mesh.surface();
  const Embedding embedding =
      embed(sliver, feature_metric(sliver, principal_curvatures(sliver), Follow::kMin, {.max_anisotropy = 1000}),
            {.max_error = 0});
  EXPECT_GT(embedding.clamped_edges, 10U);
  // An edge has two triangles, of one face.
  EXPECT_FALSE(embedding.repaired_faces.empty());
  EXPECT_LE(embedding.repaired_faces.size(), embedding.clamped_edges);
  for (const std::int32_t f : embedding.repaired_faces) EXPECT_GT(std::ranges::count(embedding.source_face, f), 1);
  EXPECT_GT(embedding.worst_clamp, 1.1);
}

TEST(EmbeddingEnds, WithDistancesThatPathsHave) {
  // Where lengths had to be fitted, geodesics are those of the fitted lengths all the same.
  const Surface surface = slivers(10)[3].mesh.surface();
  const Curvature curvature = principal_curvatures(surface);
  const Embedding embedding =
      embed(surface, feature_metric(surface, curvature, Follow::kMin, {.max_anisotropy = 1000}), {.max_error = 0});
  ASSERT_GT(embedding.faces_added, 0U);
  expect_sound(surface, embedding);
  const DistanceField field = ExactGeodesics(embedding.mesh).solve(0);
  for (std::int32_t v = 0; v < embedding.mesh.vertex_count; ++v) {
    const double distance = field.distances()[at(v)];
    ASSERT_TRUE(std::isfinite(distance));
    EXPECT_NEAR(field.trace(v)->length, distance, 1e-9 * distance);
  }
}

TEST(EmbeddingEnds, WithAtMostHalfAsManyTrianglesAgainWhereThePapersSchemeEnds) {
  std::vector<shapes::Named> meshes = slivers(3);
  for (auto& mesh : slivers(30)) meshes.push_back(std::move(mesh));
  meshes.push_back({"torus", shapes::torus(24, 40)});
  meshes.push_back({"bumpy torus", shapes::bumpy(shapes::torus(30, 16), 0.05)});
  int ended = 0, did_not = 0;
  for (const auto& [name, mesh] : meshes) {
    const Surface surface = mesh.surface();
    const Curvature curvature = principal_curvatures(surface);
    for (const double a : {10.0, 30.0, 100.0}) {
      for (const Follow follow : {Follow::kMin, Follow::kMax}) {
        const Metric metric = feature_metric(surface, curvature, follow, {.max_anisotropy = a});
        const auto papers = added_by_papers_scheme(surface, metric, 40'000);
        ++(papers ? ended : did_not);
        if (papers) {
          EXPECT_LE(static_cast<double>(embed(surface, metric, {.max_error = 0}).faces_added),
                    1.5 * static_cast<double>(*papers))
              << name << ", A = " << a;
        }
      }
    }
  }
  EXPECT_GT(ended, 40);
  EXPECT_GT(did_not, 5);
}

}  // namespace
}  // namespace seamwire
