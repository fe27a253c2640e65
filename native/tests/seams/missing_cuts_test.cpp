// SPDX-License-Identifier: GPL-3.0-or-later
#include "seamwire_uv/seams/missing_cuts.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <map>
#include <numeric>
#include <random>
#include <set>
#include <utility>
#include <vector>

#include "graph/disjoint_sets.hpp"
#include "maps/cut_open.hpp"
#include "seamwire/surface/segments.hpp"
#include "shapes.hpp"
#include "surface/corner_fans.hpp"
#include "surface/cuts.hpp"

namespace seamwire {

using namespace detail;

namespace {

using Numbers = std::vector<std::int32_t>;

Edge sorted(std::int32_t a, std::int32_t b) { return {std::min(a, b), std::max(a, b)}; }

Numbers missing(const Surface& surface, const std::vector<Edge>& cuts = {}) {
  return missing_cuts(surface, cuts, face_segments(surface, cuts));
}

/// Points that lie nowhere in particular: only the triangles matter.
Surface complex_of(const std::vector<Triangle>& triangles) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> anywhere(0.0, 1.0);
  std::int32_t last = 0;
  for (const Triangle& t : triangles) last = std::max({last, t[0], t[1], t[2]});
  std::vector<Vector> points;
  for (std::int32_t v = 0; v <= last; ++v) points.emplace_back(anywhere(random), anywhere(random), anywhere(random));
  return {points, triangles};
}

/// The same for each segment, by cutting and without any formula. Triangles are glued where exactly two share an edge
/// that is neither cut nor unorientable. A tree of triangles is one disc. Every other glued edge is cut then, but those
/// that form a forest on the border close again without harm: only an edge that closes a cycle in it is needed. Without
/// a border the tree's own border is missing, which costs one more cut.
Numbers by_cutting(const Surface& surface, const std::set<Edge>& cuts, const Numbers& segments) {
  const std::vector<Triangle>& triangles = surface.triangles();
  const auto vertex = [&](std::int32_t corner) { return triangles[corner / 3][corner % 3]; };
  const auto next = [](std::int32_t corner) { return corner % 3 == 2 ? corner - 2 : corner + 1; };
  std::map<Edge, Numbers> sides;
  for (std::int32_t h = 0; h < static_cast<std::int32_t>(3 * triangles.size()); ++h) {
    sides[sorted(vertex(h), vertex(next(h)))].push_back(h);
  }
  const auto is_glued = [&](const Edge& edge, const Numbers& at) {
    return at.size() == 2 && !cuts.contains(edge) &&
           !std::ranges::binary_search(surface.report().unorientable_edges, edge);
  };
  DisjointSets corners(3 * triangles.size()), parts(triangles.size());
  std::vector<std::int32_t> left;  // sides of glued edges that the trees of triangles do not pass
  for (const auto& [edge, at] : sides) {
    if (!is_glued(edge, at)) continue;
    const std::int32_t other = vertex(at[0]) == vertex(at[1]) ? at[1] : next(at[1]);
    corners.join(at[0], other);
    corners.join(next(at[0]), other == at[1] ? next(at[1]) : at[1]);
    if (!parts.join(at[0] / 3, at[1] / 3)) left.push_back(at[0]);
  }
  // The border of each part counts as one vertex, which the first corner on it stands for.
  std::map<std::int32_t, std::int32_t> border;
  for (const auto& [edge, at] : sides) {
    if (is_glued(edge, at)) continue;
    for (const std::int32_t h : at) {
      const auto [first, is_new] = border.try_emplace(parts.find(h / 3), h);
      corners.join(first->second, h);
      corners.join(first->second, next(h));
    }
  }
  Numbers needed(static_cast<std::size_t>(*std::ranges::max_element(segments)) + 1, 0);
  for (const std::int32_t h : left) {
    if (!corners.join(h, next(h))) ++needed[segments[h / 3]];
  }
  for (std::int32_t f = 0; f < static_cast<std::int32_t>(triangles.size()); ++f) {
    if (parts.find(f) == f && !border.contains(f)) ++needed[segments[f]];
  }
  return needed;
}

/// The same as missing_cuts() if no hole may stay.
Numbers without_holes(const Surface& surface, const std::vector<Edge>& edges, const Numbers& segments) {
  const Cuts cuts(surface, edges, "edges", {});
  Numbers missing(static_cast<std::size_t>(*std::ranges::max_element(segments)) + 1, 0);
  for (const Island& island : cut_open(corner_fans(surface), cut_half_edges(surface, cuts, {}))) {
    missing[segments[corner_fans(surface).faces[island.faces.front()]]] =
        static_cast<std::int32_t>(island.missing_cuts());
  }
  return missing;
}

TEST(MissingCuts, OfKnownShapes) {
  EXPECT_EQ(missing(shapes::grid(4).surface()), Numbers{0});
  EXPECT_EQ(missing(shapes::cylinder(8, 3).surface()), Numbers{1});
  EXPECT_EQ(missing(shapes::icosphere(1).surface()), Numbers{1});
  EXPECT_EQ(missing(shapes::torus(12, 8).surface()), Numbers{3});
  const shapes::Mesh plate = shapes::without(shapes::grid(9), [](const Vector& p) {
    return std::abs(p.y() - 0.5) < 0.1 && std::abs(std::abs(p.x() - 0.5) - 0.2) < 0.1;
  });
  EXPECT_EQ(missing(plate.surface()), Numbers{0}) << "a flat plate keeps its holes";
  // A one-sided surface is open where its faces do not agree.
  EXPECT_EQ(missing(shapes::moebius(9).surface()), Numbers{0});
  EXPECT_EQ(missing(shapes::moebius(9).surface(), {{6, 7}}), (Numbers{0, 0})) << "cut across, where its faces agree";
  EXPECT_EQ(missing(shapes::moebius(9).surface(), {{0, 1}}), Numbers{0}) << "cut across, where its faces do not";
  // The projective plane of six vertices: closed, and with the Euler characteristic of a disc.
  const Surface plane = complex_of(
      {{0, 1, 4}, {0, 1, 5}, {0, 2, 3}, {0, 2, 5}, {0, 3, 4}, {1, 2, 3}, {1, 2, 4}, {1, 3, 5}, {2, 4, 5}, {3, 4, 5}});
  EXPECT_EQ(missing(plane), Numbers{0});
}

TEST(MissingCuts, OfShellsThatMeetInAVertexAndOfFacesOnOneEdge) {
  const std::vector<Triangle> shell = {{0, 1, 2}, {0, 3, 1}, {1, 3, 2}, {0, 2, 3}};
  std::vector<Triangle> two = shell;
  for (const Triangle& t : shell) two.push_back({t[0] + 3, t[1] + 3, t[2] + 3});  // both have vertex 3
  EXPECT_EQ(missing(complex_of(two)), (Numbers{1, 1}));
  std::vector<Triangle> beside = shell;
  beside.insert(beside.end(), {{4, 5, 6}, {4, 5, 7}, {4, 5, 8}});
  EXPECT_EQ(missing(complex_of(beside)), (Numbers{1, 0, 0, 0}));
}

TEST(MissingCuts, AreThoseFoundByCuttingOnRandomComplexes) {
  std::mt19937 random(11);
  std::vector<Triangle> all;
  for (std::int32_t a = 0; a < 7; ++a) {
    for (std::int32_t b = a + 1; b < 7; ++b) {
      for (std::int32_t c = b + 1; c < 7; ++c) all.push_back({a, b, c});
    }
  }
  std::set<std::int32_t> seen;
  std::size_t one_sided = 0, nonmanifold = 0;
  for (int round = 0; round < 4000; ++round) {
    std::ranges::shuffle(all, random);
    // In every second round no edge gets a third triangle, so that larger and closed surfaces arise.
    const std::size_t most_at_edge = round % 2 == 0 ? 2 : 7, most = 1 + random() % 16;
    std::map<Edge, std::size_t> at_edge;
    std::vector<Triangle> triangles;
    for (const auto& [a, b, c] : all) {
      const std::array<Edge, 3> edges = {Edge{a, b}, Edge{b, c}, Edge{a, c}};
      if (std::ranges::any_of(edges, [&](const Edge& edge) { return at_edge[edge] == most_at_edge; })) continue;
      for (const Edge& edge : edges) ++at_edge[edge];
      triangles.push_back(random() % 2 == 0 ? Triangle{a, b, c} : Triangle{b, a, c});
      if (triangles.size() == most) break;
    }
    const Surface surface = complex_of(triangles);
    std::vector<Edge> cuts;
    for (const Edge& edge : surface.edges()) {
      if (random() % 16 == 0) cuts.push_back(edge);
    }
    const Numbers segments = face_segments(surface, cuts);
    const Numbers found = missing_cuts(surface, cuts, segments);
    const Numbers all_cuts = without_holes(surface, cuts, segments);
    ASSERT_EQ(all_cuts, by_cutting(surface, {cuts.begin(), cuts.end()}, segments)) << "round " << round;
    for (std::size_t i = 0; i < found.size(); ++i) {
      ASSERT_LE(found[i], all_cuts[i]) << "round " << round;
      ASSERT_GE(found[i], 0) << "round " << round;
    }
    seen.insert(found.begin(), found.end());
    one_sided += surface.report().unorientable_edges.empty() ? 0 : 1;
    nonmanifold += surface.report().nonmanifold_edges.empty() ? 0 : 1;
  }
  EXPECT_GE(*seen.begin(), 0);
  EXPECT_GE(seen.size(), 4U);
  EXPECT_GT(one_sided, 400U);
  EXPECT_GT(nonmanifold, 1000U);
}

TEST(MissingCuts, DiagonalsOfPolygonsCutNothing) {
  const Surface surface = shapes::quad_cylinder(8, 3).surface();
  const Triangle& t = surface.triangles()[0];
  EXPECT_EQ(missing(surface, {{t[0], t[2]}, {t[1], t[2]}, {t[0], t[1]}}), Numbers{1});
}

TEST(MissingCuts, RefuseWhatDoesNotBelongTogether) {
  const Surface surface = shapes::grid(2).surface();
  const std::vector<Edge> across = {{1, 4}, {4, 7}};
  const Numbers halves = face_segments(surface, across);
  EXPECT_THROW(missing_cuts(surface, std::vector<Edge>{{0, 9}}, halves), InvalidInput);
  EXPECT_THROW(missing_cuts(surface, across, Numbers{0}), InvalidInput);
  EXPECT_THROW(missing_cuts(surface, across, Numbers(8, -1)), InvalidInput);
  EXPECT_THROW(missing_cuts(surface, {}, halves), InvalidInput);
  EXPECT_THROW(missing_cuts(surface, across, Numbers(8, 0)), InvalidInput) << "of no cuts";
  EXPECT_EQ(missing_cuts(surface, across, halves), (Numbers{0, 0}));
}

}  // namespace
}  // namespace seamwire
