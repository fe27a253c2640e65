// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <random>
#include <vector>

#include "embeddings.hpp"
#include "seamwire/metric/scribble.hpp"
#include "shapes.hpp"

namespace seamwire {
namespace {

using embeddings::at;
using embeddings::expect_sound;
using embeddings::identity_metric;
using embeddings::random_metric;
using embeddings::random_scribble;
using shapes::Mesh;

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
    Embedding embedding = embed(surface, base, {.max_error = 0});
    int local = 0, in_part = 0;
    for (int step = 0; step < 25; ++step) {
      // Mostly added, sometimes one in the middle of the list removed.
      if (scribbles.size() > 2 && random() % 3 == 0) {
        scribbles.erase(scribbles.begin() + static_cast<std::ptrdiff_t>(random() % scribbles.size()));
      } else {
        scribbles.push_back(random_scribble(surface, random, 30, 10));
      }
      Metric metric = apply_scribbles(surface, base, scribbles);
      local += embedding.is_local;
      embedding = re_embed(surface, former, metric, embedding, {.max_error = 0});
      in_part += embedding.faces_embedded < surface.face_count() / 2;
      expect_same(surface, embedding, embed(surface, metric, {.max_error = 0}));
      former = std::move(metric);
    }
    EXPECT_GT(local, 15) << "hardly anything was done locally";
    EXPECT_GT(in_part, 15) << "hardly anything was left as it was";
    const Embedding back = re_embed(surface, former, base, embedding, {.max_error = 0});
    expect_same(surface, back, embed(surface, base, {.max_error = 0}));
  }
}

TEST(ReEmbed, IsEmbeddingFromScratchWhereTheMetricChangesEverywhereAtRandom) {
  const Surface surface = shapes::grid(24, 0.2).surface();
  Metric former = random_metric(surface, 6, 1);
  Embedding embedding = embed(surface, former, {.max_error = 0});
  std::mt19937 random(5);
  for (unsigned step = 0; step < 12; ++step) {
    const Metric other = random_metric(surface, 6, 2 + step);
    Metric metric = former;
    for (std::size_t v = 0; v < metric.size(); ++v) {
      if (random() % 40 == 0) metric.tensors[v] = other.tensors[v];
    }
    EXPECT_TRUE(embedding.is_local);
    embedding = re_embed(surface, former, metric, embedding, {.max_error = 0});
    expect_same(surface, embedding, embed(surface, metric, {.max_error = 0}));
    former = std::move(metric);
  }
}

TEST(ReEmbed, TakesSurfacesThatAreCutOpenAndOtherNormals) {
  Mesh mesh = shapes::moebius(24);
  const Surface surface = mesh.surface();
  const Metric former = euclidean_metric(surface, principal_curvatures(surface));
  Metric metric = former;
  for (std::size_t v = 0; v < 10; ++v) metric.tensors[v] *= 9;
  expect_same(surface, re_embed(surface, former, metric, embed(surface, former, {.max_error = 0}), {.max_error = 0}),
              embed(surface, metric, {.max_error = 0}));
  const Surface grid = shapes::grid(12).surface();
  const Metric random = random_metric(grid, 10, 3);
  const Metric identity = identity_metric(grid);
  expect_same(grid, re_embed(grid, random, identity, embed(grid, random, {.max_error = 0}), {.max_error = 0}),
              embed(grid, identity, {.max_error = 0}));
  Mesh needles = shapes::grid(12);
  needles.points[30] = needles.points[31];
  const Surface degenerate = needles.surface();
  ASSERT_FALSE(degenerate.report().zero_area_faces.empty());
  expect_same(degenerate,
              re_embed(degenerate, random, identity, embed(degenerate, random, {.max_error = 0}), {.max_error = 0}),
              embed(degenerate, identity, {.max_error = 0}));
  EXPECT_THROW(re_embed(grid, random, random, embed(surface, former, {.max_error = 0}), {.max_error = 0}),
               InvalidInput);
  EXPECT_THROW(re_embed(grid, random, former, embed(grid, random, {.max_error = 0}), {.max_error = 0}), InvalidInput);
}

TEST(ReEmbed, IsEmbeddingFromScratchWithAnErrorOrSomeFaces) {
  const Surface grid = shapes::grid(12).surface();
  const Metric former = random_metric(grid, 10, 3), metric = random_metric(grid, 10, 4);
  const Embedding old = embed(grid, former, {.max_error = 0});
  ASSERT_TRUE(old.is_local);
  for (EmbedOptions options :
       {EmbedOptions{.max_error = 0.05}, EmbedOptions{.max_error = 0, .faces = std::vector<std::int32_t>{3, 4, 40}}}) {
    const Embedding made = re_embed(grid, former, metric, old, options);
    options.mean_edge_length = old.mean_edge_length;
    const Embedding fresh = embed(grid, metric, options);
    EXPECT_EQ(placed(made), placed(fresh));
    EXPECT_EQ(made.resolution.has_value(), options.max_error > 0);
  }
  EXPECT_THROW(re_embed(grid, former, metric, old, {.max_error = -1.0}), InvalidInput);
}

// The work, not the time, which other processes share in: a scribble is far smaller than the surface.
TEST(ReEmbed, LeavesWhatIsFarAwayWhereItIs) {
  const Surface surface = shapes::grid(100, 0.2).surface();
  const Metric former = random_metric(surface, 3, 3);
  Embedding old = embed(surface, former, {.max_error = 0});
  Metric metric = former;
  metric.tensors[0] = Vector(40, 0.1, 0).asDiagonal();
  const std::vector<double> before = old.mesh.lengths;
  const Embedding embedding = re_embed(surface, former, metric, old, {.max_error = 0});
  std::size_t changed = 0;
  for (std::size_t h = 0; h < 3 * surface.face_count(); ++h) changed += embedding.mesh.lengths[h] != before[h];
  EXPECT_GT(changed, 0U);
  EXPECT_LT(changed, 100U);
  EXPECT_GE(embedding.faces_embedded, 2U);  // those at the vertex
  EXPECT_LT(embedding.faces_embedded, 100U);
  EXPECT_EQ(embed(surface, metric, {.max_error = 0}).faces_embedded, surface.face_count());
}

}  // namespace
}  // namespace seamwire
