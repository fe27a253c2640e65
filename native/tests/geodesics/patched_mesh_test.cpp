// SPDX-License-Identifier: GPL-3.0-or-later
//
// The geodesics' own mesh after a change, patched: what one made from scratch is.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <tuple>
#include <vector>

#include "embeddings.hpp"
#include "geodesics/geodesic_mesh.hpp"
#include "intrinsic.hpp"
#include "seamwire/geodesics/corridor_paths.hpp"
#include "seamwire/geodesics/exact_geodesics.hpp"
#include "shapes.hpp"

namespace seamwire {

using namespace detail;

namespace {

using embeddings::at;
using embeddings::random_scribble;
using shapes::Mesh;

std::int32_t external(const GeodesicMesh& mesh, std::int32_t half_edge) {
  return half_edge < 0 ? -1 : mesh.external_half_edge(half_edge);
}
std::int32_t internal(const GeodesicMesh& mesh, std::int32_t half_edge) {
  return 3 * mesh.internal_face(half_edge / 3) + half_edge % 3;
}

// All that a half-edge says, in external numbers.
auto said_by(const GeodesicMesh& mesh, std::int32_t h) {
  const GeodesicMesh::HalfEdge edge = mesh.half_edge(h);
  return std::tuple(edge.length, edge.apex_x, edge.apex_y, edge.left_length, edge.right_length,
                    mesh.external_vertex(edge.tail), mesh.external_vertex(edge.tip), mesh.external_vertex(edge.apex),
                    external(mesh, edge.left), external(mesh, edge.right), mesh.angle(h));
}

// The entries of a row of a vertex, in external numbers, without their order.
auto sorted(auto row) {
  std::sort(row.begin(), row.end());
  return row;
}
auto said_at(const GeodesicMesh& mesh, std::int32_t vertex) {
  std::vector<std::int32_t> out;
  for (const std::int32_t h : mesh.out(vertex)) out.push_back(external(mesh, h));
  std::vector<std::pair<std::int32_t, double>> loose;
  for (const auto& [to, length] : mesh.loose(vertex)) loose.emplace_back(mesh.external_vertex(to), length);
  std::vector<std::pair<std::int32_t, float>> hops;
  mesh.for_each_hop(vertex,
                    [&](std::int32_t to, float length) { hops.emplace_back(mesh.external_vertex(to), length); });
  return std::tuple(sorted(out), sorted(loose), sorted(hops));
}

void expect_same(const GeodesicMesh& patched, const GeodesicMesh& made) {
  ASSERT_EQ(patched.vertex_count(), made.vertex_count());
  ASSERT_EQ(patched.half_edge_count(), made.half_edge_count());
  for (std::int32_t e = 0; at(e) < made.half_edge_count(); ++e) {
    const std::int32_t h = internal(patched, e);
    ASSERT_EQ(external(patched, h), e);
    ASSERT_EQ(said_by(patched, h), said_by(made, internal(made, e))) << "half-edge " << e;
  }
  for (std::int32_t e = 0; at(e) < made.vertex_count(); ++e) {
    const std::int32_t v = patched.internal_vertex(e), w = made.internal_vertex(e);
    ASSERT_EQ(patched.external_vertex(v), e);
    ASSERT_EQ(said_at(patched, v), said_at(made, w)) << "vertex " << e;
    ASSERT_TRUE(std::ranges::is_sorted(patched.out(v)));
    // Around a flat vertex the sum of angles is near 2 pi and depends on their order by rounding alone: no threshold.
    ASSERT_EQ(patched.is_pseudo_source(v), made.is_pseudo_source(w)) << "vertex " << e;
  }
  EXPECT_EQ(patched.longest_hop(), made.longest_hop());
  EXPECT_FLOAT_EQ(patched.mean_edge(), made.mean_edge());  // sums of the same numbers, in another order
}

void expect_same_distances(const ExactGeodesics& patched, const ExactGeodesics& made, std::int32_t seed) {
  const std::vector<double> a = patched.solve(seed).distances(), b = made.solve(seed).distances();
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t v = 0; v < a.size(); ++v) ASSERT_NEAR(a[v], b[v], 1e-12 * (1 + b[v])) << "vertex " << v;
  const auto target = static_cast<std::int32_t>(a.size() / 2);
  const auto length = [&](const ExactGeodesics& on) { return CorridorPaths(on, seed, {}).path(target)->length; };
  EXPECT_NEAR(length(patched), length(made), 1e-12 * (1 + b[at(target)]));
}

TEST(PatchedMesh, IsTheMeshFromScratchAfterEveryStroke) {
  std::mt19937 random(7);
  const Mesh meshes[] = {shapes::grid(40, 0.3), shapes::torus(60, 30), shapes::bumpy(shapes::icosphere(4), 0.05)};
  for (const Mesh& mesh : meshes) {
    const Surface surface = mesh.surface();
    const Metric base = feature_metric(surface, principal_curvatures(surface), Follow::kMax, {.max_anisotropy = 8});
    std::vector<Scribble> scribbles;
    Metric former = base;
    Embedding embedding = embed(surface, base, {.max_error = 0});
    ExactGeodesics geodesics(embedding.mesh);
    GeodesicMesh own(embedding.mesh, {});
    int patches = 0, more = 0, fewer = 0;
    for (int step = 0; step < 25; ++step) {
      if (scribbles.size() > 2 && random() % 2 == 0) {
        scribbles.erase(scribbles.begin() + static_cast<std::ptrdiff_t>(random() % scribbles.size()));
      } else {
        scribbles.push_back(random_scribble(surface, random, 12, 4));
      }
      Metric metric = apply_scribbles(surface, base, scribbles);
      Embedding next = re_embed(surface, former, metric, embedding, {.max_error = 0});
      more += next.mesh.face_count() > embedding.mesh.face_count();
      fewer += next.mesh.face_count() < embedding.mesh.face_count();
      std::optional<GeodesicMesh> patched = own.patched(embedding.mesh, next.mesh, {});
      GeodesicMesh made(next.mesh, {});
      if (patched) {
        ASSERT_NO_FATAL_FAILURE(expect_same(*patched, made));
      }
      patches += patched.has_value();
      // Numbered from scratch now and then: what a patch adds comes last, and then goes without a gap.
      own = patched && step % 3 != 0 ? std::move(*patched) : std::move(made);
      geodesics = step % 3 != 0 ? ExactGeodesics(geodesics, embedding.mesh, next.mesh)
                                : ExactGeodesics(ExactGeodesics(embedding.mesh), embedding.mesh, next.mesh);
      const auto seed = static_cast<std::int32_t>(random() % surface.vertex_count());
      ASSERT_NO_FATAL_FAILURE(expect_same_distances(geodesics, ExactGeodesics(next.mesh), seed));
      embedding = std::move(next);
      former = std::move(metric);
    }
    EXPECT_GT(patches, 15) << "hardly ever patched";
    EXPECT_GT(more, 3);
    EXPECT_GT(fewer, 3);
    // All strokes taken back.
    const Embedding back = re_embed(surface, former, base, embedding, {.max_error = 0});
    if (const auto patched = own.patched(embedding.mesh, back.mesh, {})) {
      expect_same(*patched, GeodesicMesh(back.mesh, {}));
    }
  }
}

// Lengths of some edges grow and shrink; numbers are all kept, and with them the order of all work.
TEST(PatchedMesh, GivesTheSameDistancesBitForBitWhereOnlyLengthsChange) {
  std::mt19937 random(3);
  for (const shapes::Named& named : shapes::exactness_meshes(1)) {
    SCOPED_TRACE(named.name);
    const IntrinsicMesh before = shapes::intrinsic(named.mesh);
    ExactGeodesics former(before);
    IntrinsicMesh last = before;
    for (int step = 0; step < 4; ++step) {
      IntrinsicMesh mesh = last;
      for (int edges = 0; edges < 3; ++edges) {
        const std::size_t h = random() % mesh.lengths.size();
        mesh.lengths[h] *= 1 + 1e-3 * (static_cast<double>(random() % 100) / 50 - 1);
        if (const std::int32_t twin = mesh.twins[h]; twin >= 0) mesh.lengths[at(twin)] = mesh.lengths[h];
      }
      const GeodesicMesh own(last, {});
      const auto patched = own.patched(last, mesh, {});
      ASSERT_TRUE(patched);
      expect_same(*patched, GeodesicMesh(mesh, {}));
      former = ExactGeodesics(former, last, mesh);
      EXPECT_EQ(former.solve(0).distances(), ExactGeodesics(mesh).solve(0).distances());
      last = std::move(mesh);
    }
  }
}

// A grid, and a triangle beside it.
Mesh grid_and_triangle() {
  Mesh mesh = shapes::grid(12);
  const auto first = static_cast<std::int32_t>(mesh.points.size());
  mesh.points.insert(mesh.points.end(), {{2, 0, 0}, {3, 0, 0}, {2, 1, 0}});
  mesh.triangles.push_back({first, first + 1, first + 2});
  return mesh;
}

IntrinsicMesh with_last_triangle_scaled(IntrinsicMesh mesh, double factor) {
  for (std::size_t h = mesh.lengths.size() - 3; h < mesh.lengths.size(); ++h) mesh.lengths[h] *= factor;
  return mesh;
}

TEST(PatchedMesh, WhatWasLongLeavesNoTraceInTheMeanOfEdges) {
  const IntrinsicMesh after = shapes::intrinsic(grid_and_triangle());
  // So long that short ones are lost in a sum with them.
  const IntrinsicMesh before = with_last_triangle_scaled(after, 1e18);
  const auto patched = GeodesicMesh(before, {}).patched(before, after, {});
  ASSERT_TRUE(patched);
  expect_same(*patched, GeodesicMesh(after, {}));
}

TEST(PatchedMesh, SharesWhatIsFarFromTheChange) {
  const IntrinsicMesh before = shapes::intrinsic(shapes::grid(100));
  IntrinsicMesh mesh = before;
  mesh.lengths[0] *= 1.001;
  if (const std::int32_t twin = mesh.twins[0]; twin >= 0) mesh.lengths[at(twin)] = mesh.lengths[0];
  const GeodesicMesh former(before, {});
  const auto patched = former.patched(before, mesh, {});
  ASSERT_TRUE(patched);
  std::size_t shared = 0;
  for (std::int32_t h = 0; at(h) < former.half_edge_count(); ++h) shared += patched->shares(former, h);
  EXPECT_GT(shared, former.half_edge_count() * 8 / 10);
  EXPECT_LT(shared, former.half_edge_count());
  expect_same(former, GeodesicMesh(before, {}));  // which is not written to
}

TEST(PatchedMesh, ChecksWhatHasChanged) {
  const IntrinsicMesh before = shapes::intrinsic(shapes::grid(12));
  const GeodesicMesh former(before, {});
  const auto throws = [&](const auto& spoil) {
    IntrinsicMesh mesh = before;
    spoil(mesh);
    EXPECT_THROW(former.patched(before, mesh, {}), InvalidInput);
  };
  const std::size_t inner = static_cast<std::size_t>(
      std::ranges::find_if(before.twins, [](std::int32_t twin) { return twin >= 0; }) - before.twins.begin());
  throws([&](IntrinsicMesh& mesh) { mesh.lengths[inner] *= 1.01; });  // not its twin's
  throws([&](IntrinsicMesh& mesh) { mesh.lengths[inner] = -1; });
  throws([&](IntrinsicMesh& mesh) { mesh.lengths[inner] = mesh.lengths[at(mesh.twins[inner])] = 100; });
  throws([&](IntrinsicMesh& mesh) { mesh.twins[inner] = -1; });  // its twin still names it
  throws([&](IntrinsicMesh& mesh) { mesh.triangles[5][0] = 1000; });
  throws([&](IntrinsicMesh& mesh) { mesh.lengths.pop_back(); });
  EXPECT_THROW(former.patched(shapes::intrinsic(shapes::grid(11)), before, {}), InvalidInput);
}

TEST(PatchedMesh, RefusesEdgesThatAreAllTooShort) {
  const IntrinsicMesh after =
      shapes::intrinsic(grid_and_triangle(), Eigen::Matrix3d(1e-78 * Eigen::Matrix3d::Identity()));
  const GeodesicMesh former(with_last_triangle_scaled(after, 1e3), {});
  EXPECT_THROW(former.patched(with_last_triangle_scaled(after, 1e3), after, {}), InvalidInput);
}

TEST(PatchedMesh, IsNotMadeWhereItWouldNotPay) {
  const IntrinsicMesh before = shapes::intrinsic(shapes::grid(12));
  const GeodesicMesh former(before, {});
  EXPECT_FALSE(former.patched(
      before, shapes::intrinsic(shapes::grid(12), Eigen::Matrix3d(2 * Eigen::Matrix3d::Identity())), {}));
  IntrinsicMesh mesh = before;
  mesh.loose_edges.push_back({0, 5, 1.0});
  EXPECT_FALSE(former.patched(before, mesh, {}));
  expect_same_distances(ExactGeodesics(ExactGeodesics(before), before, mesh), ExactGeodesics(mesh), 0);
}

}  // namespace
}  // namespace seamwire
