// SPDX-License-Identifier: GPL-3.0-or-later
#include "seamwire/surface/segments.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <random>
#include <set>

#include "shapes.hpp"

namespace seamwire {
namespace {

/// The same by flooding, triangle by triangle, over any edge that is not cut and has exactly two triangles that can be
/// oriented alike. Labels are as they come. Triangles that the surface left out are in the segment that is expected.
std::vector<std::int32_t> flooded(const Surface& surface, const std::set<Edge>& cuts,
                                  const std::vector<std::int32_t>& expected) {
  std::map<Edge, std::vector<std::size_t>> at_edge;
  const auto side = [](const Triangle& t, std::size_t i) {
    const auto [a, b] = std::minmax(t[i], t[(i + 1) % 3]);
    return Edge{a, b};
  };
  const auto& triangles = surface.triangles();
  const SurfaceReport& report = surface.report();
  std::set<std::size_t> left_out;
  for (const auto* faces : {&report.degenerate_faces, &report.duplicate_faces}) {
    for (const std::int32_t f : *faces) left_out.insert(static_cast<std::size_t>(f));
  }
  for (std::size_t f = 0; f < triangles.size(); ++f) {
    for (std::size_t i = 0; i < 3 && !left_out.contains(f); ++i) at_edge[side(triangles[f], i)].push_back(f);
  }
  for (const Edge& edge : report.unorientable_edges) at_edge.erase(edge);
  std::vector<std::int32_t> labels(triangles.size(), -1);
  std::int32_t count = 0;
  for (std::size_t start = 0; start < triangles.size(); ++start) {
    if (labels[start] >= 0 || left_out.contains(start)) continue;
    std::vector<std::size_t> open{start};
    labels[start] = count;
    while (!open.empty()) {
      const std::size_t f = open.back();
      open.pop_back();
      for (std::size_t i = 0; i < 3; ++i) {
        const Edge edge = side(triangles[f], i);
        if (cuts.contains(edge) || edge[0] == edge[1]) continue;
        if (at_edge[edge].size() != 2) continue;
        for (const std::size_t g : at_edge[edge]) {
          if (labels[g] >= 0) continue;
          labels[g] = count;
          open.push_back(g);
        }
      }
    }
    ++count;
  }
  for (const std::size_t f : left_out) {
    const auto like = std::ranges::find(expected, expected[f]) - expected.begin();
    labels[f] = labels[static_cast<std::size_t>(like)] >= 0 ? labels[static_cast<std::size_t>(like)] : count++;
  }
  return labels;
}

std::vector<int> sizes_of(const std::vector<std::int32_t>& labels) {
  std::vector<int> sizes;
  for (const std::int32_t label : labels) {
    if (static_cast<std::size_t>(label) >= sizes.size()) sizes.resize(static_cast<std::size_t>(label) + 1);
    ++sizes[static_cast<std::size_t>(label)];
  }
  return sizes;
}

void expect_same_parts(const std::vector<std::int32_t>& got, const std::vector<std::int32_t>& expected) {
  ASSERT_EQ(got.size(), expected.size());
  std::map<std::int32_t, std::int32_t> there, back;
  for (std::size_t f = 0; f < got.size(); ++f) {
    EXPECT_EQ(there.emplace(got[f], expected[f]).first->second, expected[f]) << "triangle " << f;
    EXPECT_EQ(back.emplace(expected[f], got[f]).first->second, got[f]) << "triangle " << f;
  }
}

TEST(FaceSegments, WithoutCutsAreTheComponents) {
  shapes::Mesh mesh = shapes::icosphere(1);
  const shapes::Mesh other = shapes::grid(10);
  const auto offset = static_cast<std::int32_t>(mesh.points.size());
  mesh.points.insert(mesh.points.end(), other.points.begin(), other.points.end());
  for (const auto& [a, b, c] : other.triangles) mesh.triangles.push_back({a + offset, b + offset, c + offset});
  const std::vector<std::int32_t> labels = face_segments(mesh.surface(), {});
  EXPECT_EQ(sizes_of(labels), (std::vector{200, 80}));
  EXPECT_EQ(labels.front(), 1) << "the first triangles are of the smaller part";
}

TEST(FaceSegments, RingsPartATorusOfQuadsAndDiagonalsDoNot) {
  const int nu = 12, nv = 8;
  const Surface surface = shapes::quad_torus(nu, nv).surface();
  std::vector<Edge> cuts;
  for (const int u : {0, 3}) {
    for (int v = 0; v < nv; ++v) cuts.push_back({v * nu + u, (v + 1) % nv * nu + u});
  }
  EXPECT_EQ(sizes_of(face_segments(surface, cuts)), (std::vector{9 * nv * 2, 3 * nv * 2}));
  std::vector<Edge> diagonals;
  for (const auto& [a, b, c] : surface.triangles()) diagonals.insert(diagonals.end(), {{a, b}, {b, c}, {c, a}});
  std::erase_if(diagonals, [&](const Edge& edge) {
    const auto [a, b] = std::minmax(edge[0], edge[1]);
    return std::binary_search(surface.edges().begin(), surface.edges().end(), Edge{a, b});
  });
  ASSERT_FALSE(diagonals.empty());
  EXPECT_EQ(sizes_of(face_segments(surface, diagonals)), (std::vector{2 * nu * nv}));
}

TEST(FaceSegments, OneOpenCutPartsNothing) {
  const Surface surface = shapes::quad_torus(12, 8).surface();
  EXPECT_EQ(sizes_of(face_segments(surface, std::vector<Edge>{{0, 1}, {1, 2}, {3, 2}})), (std::vector{192}));
}

TEST(FaceSegments, AreThoseFoundByFloodingForRandomCuts) {
  std::mt19937 random(3);
  shapes::Mesh odd = shapes::icosphere(2);  // with a fin on an edge, a triangle twice and one with two equal corners
  odd.points.emplace_back(1, 1, 1);
  const auto fin = static_cast<std::int32_t>(odd.points.size()) - 1;
  odd.triangles.push_back({odd.triangles[5][0], odd.triangles[5][1], fin});
  odd.triangles.push_back(odd.triangles[7]);
  odd.triangles.push_back({odd.triangles[9][0], odd.triangles[9][0], odd.triangles[9][1]});
  for (const shapes::Mesh& mesh : {shapes::torus(20, 12), shapes::grid(15), shapes::moebius(9), odd}) {
    const Surface surface = mesh.surface();
    for (const double part : {0.1, 0.5, 0.8, 1.0}) {
      std::bernoulli_distribution is_cut(part);
      std::set<Edge> cuts;
      for (const Edge& edge : surface.edges()) {
        if (is_cut(random)) cuts.insert(edge);
      }
      const std::vector<std::int32_t> labels = face_segments(surface, std::vector<Edge>(cuts.begin(), cuts.end()));
      expect_same_parts(labels, flooded(surface, cuts, labels));
      const std::vector<int> sizes = sizes_of(labels);
      EXPECT_TRUE(std::ranges::is_sorted(sizes, std::greater()));
    }
  }
}

TEST(FaceSegments, ATriangleThatTheSurfaceLeftOutJoinsNoSegments) {
  // Two triangles with a cut between them, and a third one with two equal corners at the cut and beside it.
  const std::vector<Vector> points{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}};
  const Surface surface(points, {{0, 1, 2}, {1, 3, 2}, {3, 3, 2}, {0, 0, 1}, {0, 1, 2}});
  const std::vector<std::int32_t> labels = face_segments(surface, std::vector<Edge>{{1, 2}});
  EXPECT_EQ(labels, (std::vector<std::int32_t>{0, 1, 1, 0, 0}));
}

TEST(FaceSegments, ManyTrianglesThatTheSurfaceLeftOutTakeLittleTime) {
  // Looking at all of them again for each one would take minutes.
  constexpr std::int32_t kCount = 60'000;
  std::vector<Vector> points{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  std::vector<Triangle> triangles{{0, 1, 2}};
  for (std::int32_t v = 3; v < kCount + 3; ++v) {
    points.emplace_back(v, 0, 0);
    triangles.push_back({v, v, v});
  }
  EXPECT_EQ(sizes_of(face_segments(Surface(points, triangles), {})), std::vector(kCount + 1, 1));
}

TEST(FaceSegments, EdgesWithThreeTrianglesJoinNothing) {
  const std::vector<Vector> points{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}};
  const Surface fin(points, {{0, 1, 2}, {1, 0, 3}, {0, 1, 4}});
  EXPECT_EQ(face_segments(fin, {}), (std::vector<std::int32_t>{0, 1, 2}));
}

TEST(FaceSegments, RefuseAVertexOutOfRange) {
  const Surface surface = shapes::grid(2).surface();
  EXPECT_THROW(face_segments(surface, std::vector<Edge>{{0, 9}}), InvalidInput);
  EXPECT_THROW(face_segments(surface, std::vector<Edge>{{-1, 1}}), InvalidInput);
  EXPECT_EQ(sizes_of(face_segments(surface, std::vector<Edge>{{0, 0}})), std::vector{8});
}

}  // namespace
}  // namespace seamwire
