// SPDX-License-Identifier: GPL-3.0-or-later
#include "seamwire_uv/parts/part_finder.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <memory>
#include <numbers>
#include <random>
#include <set>
#include <stop_token>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "prices/border_odds.hpp"
#include "seamwire/surface/segments.hpp"
#include "shapes.hpp"
#include "surface/real_edges.hpp"

namespace seamwire {

using namespace detail;

namespace {

using Chains = std::vector<std::vector<std::int32_t>>;

std::shared_ptr<const Surface> shared(Surface surface) { return std::make_shared<const Surface>(std::move(surface)); }

/// A surface of revolution; `chamfer`: the width of a step between the wall and each lid.
std::shared_ptr<const Surface> drum(int n, double chamfer = 0.0) {
  std::vector<std::array<double, 2>> profile{{-0.5, 0.0}, {-0.5, 0.2}};
  for (const double side : {-1.0, 1.0}) {
    if (chamfer > 0.0 && side < 0.0) profile.push_back({-0.5, 0.4 - chamfer});
    profile.push_back({side * (0.5 - chamfer), 0.4});
    if (side < 0.0) {
      for (const double x : {-0.25, 0.0, 0.25}) profile.push_back({x, 0.4});
    }
    if (chamfer > 0.0 && side > 0.0) profile.push_back({0.5, 0.4 - chamfer});
  }
  profile.push_back({0.5, 0.2});
  profile.push_back({0.5, 0.0});
  return shared(shapes::lathe(n, profile).surface());
}

std::vector<Edge> edges_of(const Parts& parts) {
  std::vector<Edge> edges;
  for (const std::vector<std::int32_t>& chain : parts.borders) {
    for (std::size_t i = 1; i < chain.size(); ++i) edges.push_back({chain[i - 1], chain[i]});
  }
  return edges;
}

/// The area of each part, as a share of the whole.
std::vector<double> shares(const Surface& surface, const Parts& parts) {
  std::vector<double> areas(parts.count, 0.0);
  double all = 0.0;
  for (std::size_t f = 0; f < parts.of_face.size(); ++f) {
    const auto& [a, b, c] = surface.triangles()[f];
    const auto& points = surface.points();
    const double area = (points[b] - points[a]).cross(points[c] - points[a]).norm();
    areas[parts.of_face[f]] += area;
    all += area;
  }
  for (double& area : areas) area /= all;
  std::ranges::sort(areas, std::ranges::greater());
  return areas;
}

TEST(PartFinder, parts_a_cube_into_its_sides) {
  const PartFinder finder(shared(shapes::quad_cube(4).surface()));
  const Parts parts = finder.find(1.0);
  EXPECT_EQ(parts.count, 6u);
  EXPECT_EQ(parts.borders.size(), 12u);  // from corner to corner
  for (const std::vector<std::int32_t>& chain : parts.borders) EXPECT_EQ(chain.size(), 5u);
}

/// A box with corners at 0 and at `size`.
shapes::QuadMesh box(int n, const Vector& size) {
  shapes::QuadMesh mesh = shapes::quad_cube(n);
  for (Vector& point : mesh.points) point = point.cwiseProduct(size);
  return mesh;
}

TEST(PartFinder, opens_a_box_as_a_cross) {
  for (const Vector& size : {Vector(1, 1, 1), Vector(2, 1.2, 0.6), Vector(0.4, 0.4, 3)}) {
    for (const int n : {1, 3}) {
      for (const int mirror : {-1, 0, 1}) {
        const Parts parts = PartFinder(shared(box(n, size).surface()), {.mirror = mirror}).find();
        EXPECT_EQ(parts.count, 1u);
        EXPECT_EQ(edges_of(parts).size(), static_cast<std::size_t>(7 * n)) << "5 of 12 rims fold";
      }
    }
  }
}

TEST(PartFinder, parts_a_box_into_its_sides_if_there_are_no_nets) {
  EXPECT_EQ(PartFinder(shared(shapes::quad_cube(4).surface()), {.has_nets = false}).find().count, 6U);
}

TEST(PartFinder, opens_each_of_many_boxes_alike) {
  shapes::QuadMesh boxes;
  const shapes::QuadMesh one = box(1, Vector(1, 1, 1));
  for (int i = 0; i < 8; ++i) {
    const auto first = static_cast<std::int32_t>(boxes.points.size());
    for (const Vector& point : one.points) boxes.points.push_back(point + 2.0 * Vector(i % 4, i / 4, 0));
    for (const auto& [a, b, c, d] : one.quads) boxes.quads.push_back({first + a, first + b, first + c, first + d});
  }
  for (const int mirror : {-1, 0}) {
    const Parts parts = PartFinder(shared(boxes.surface()), {.mirror = mirror}).find();
    EXPECT_EQ(parts.count, 8u);
    std::array<std::set<Edge>, 8> own;
    for (const Edge& edge : edges_of(parts)) own[edge[0] / 8].insert(ascending(edge[0] % 8, edge[1] % 8));
    for (const std::set<Edge>& edges : own) EXPECT_EQ(edges, own[0]);
  }
}

TEST(PartFinder, opens_a_symmetric_box_alike_on_both_sides) {
  const auto surface = shared(box(2, Vector(1.5, 1, 2)).surface());
  for (const int mirror : {0, 1}) {
    std::set<std::pair<double, double>> places;  // of the middles of edges: away from the plane, and along z
    std::map<std::array<double, 3>, int> sides;
    for (const Edge& edge : edges_of(PartFinder(surface, {.mirror = mirror}).find())) {
      Vector middle = 0.5 * (surface->points()[edge[0]] + surface->points()[edge[1]]);
      const double away = middle[mirror] - (mirror == 0 ? 0.75 : 0.5);
      middle[mirror] = std::round(1e6 * std::abs(away));
      sides[{middle.x(), middle.y(), middle.z()}] += away > 1e-9 ? 1 : away < -1e-9 ? -1 : 0;
    }
    for (const auto& [place, sum] : sides) EXPECT_EQ(sum, 0);
  }
}

TEST(PartFinder, parts_a_net_at_kept_edges) {
  const auto surface = shared(box(1, Vector(1, 1, 1)).surface());
  const std::vector<Edge> cross = edges_of(PartFinder(surface).find());
  std::size_t folds = 0;
  for (const Edge& edge : surface->edges()) {
    const auto is_same = [&](const Edge& other) { return ascending(other[0], other[1]) == edge; };
    if (std::ranges::any_of(cross, is_same)) continue;
    ++folds;
    EXPECT_EQ(PartFinder(surface).find(0.5, {.kept = {edge}}).count, 2u);
  }
  EXPECT_EQ(folds, 5u);
}

TEST(PartFinder, does_not_fold_marked_edges) {
  const auto surface = shared(box(1, Vector(1, 1, 1)).surface());
  std::vector<Edge> around;  // of the side at z = 1
  for (const Edge& edge : surface->edges()) {
    if (surface->points()[edge[0]].z() > 0.5 && surface->points()[edge[1]].z() > 0.5) around.push_back(edge);
  }
  ASSERT_EQ(around.size(), 4u);
  const Parts parts = PartFinder(surface, {.marked = {around}}).find();
  EXPECT_EQ(parts.count, 2u);
  const std::vector<Edge> borders = edges_of(parts);
  for (const Edge& edge : around) {
    EXPECT_TRUE(std::ranges::any_of(borders, [&](const Edge& own) { return ascending(own[0], own[1]) == edge; }));
  }
}

TEST(PartFinder, opens_no_net_around_a_round_wall) {
  EXPECT_EQ(PartFinder(drum(24)).find().count, 3u);
  // The sides of a prism that lie on the mirror plane do not part its wall.
  std::vector<std::array<double, 2>> profile{{-0.5, 0.0}, {-0.5, 0.5}, {0.5, 0.5}, {0.5, 0.0}};
  EXPECT_EQ(PartFinder(shared(shapes::lathe(8, profile).surface()), {.mirror = 2}).find().count, 3u);
}

TEST(PartFinder, keeps_a_cap_whose_rim_is_short) {
  const auto rod =
      shared(shapes::lathe(12, {{-0.5, 0.0}, {-0.5, 0.012}, {0.0, 0.012}, {0.5, 0.012}, {0.5, 0.0}}).surface());
  EXPECT_EQ(PartFinder(rod).find().count, 3u);
}

TEST(PartFinder, parts_a_drum_into_a_wall_and_two_lids) {
  for (const int n : {12, 24, 64}) {
    const auto surface = drum(n);
    const Parts parts = PartFinder(surface).find();
    EXPECT_EQ(parts.count, 3u) << n;
    ASSERT_EQ(parts.borders.size(), 2u) << n;
    for (const std::vector<std::int32_t>& chain : parts.borders) {
      EXPECT_EQ(chain.front(), chain.back());
      EXPECT_EQ(chain.size(), static_cast<std::size_t>(n) + 1);
    }
  }
}

TEST(PartFinder, leaves_each_step_of_a_chamfer_with_one_neighbor) {
  const auto surface = drum(32, 0.008);
  EXPECT_EQ(PartFinder(surface).find().count, 3u);
}

TEST(PartFinder, keeps_a_smooth_body_whole) {
  for (const shapes::Mesh& mesh :
       {shapes::icosphere(3), shapes::torus(32, 24), shapes::bumpy(shapes::icosphere(4), 0.002)}) {
    const Parts parts = PartFinder(shared(mesh.surface())).find();
    EXPECT_EQ(parts.count, 1u);
    EXPECT_TRUE(parts.borders.empty());
  }
}

TEST(PartFinder, has_a_scale_from_pieces_to_sharp_regions) {
  const PartFinder finder(drum(24));
  EXPECT_EQ(finder.find(0.0).count, 1u);
  EXPECT_EQ(finder.find(1.0).count, 3u);
  // Sides of a prism that bend by 45 degrees are one wall in the middle of the scale, and parts at its end.
  const PartFinder prism(drum(8));
  EXPECT_EQ(prism.find(0.5).count, 3u);
  EXPECT_EQ(prism.find(1.0).count, 10u);
}

TEST(PartFinder, finds_the_same_parts_on_triangles_as_on_quads) {
  // The quads of a drum's wall, with diagonals of either direction.
  std::mt19937 random(7);
  shapes::Mesh mesh = shapes::lathe(16, {{-0.5, 0.0}, {-0.5, 0.4}, {0.0, 0.4}, {0.5, 0.4}, {0.5, 0.0}});
  const Surface whole = mesh.surface();
  for (std::size_t f = 16; f + 17 < mesh.triangles.size(); f += 2) {
    // Two triangles of a quad, in the order of lathe().
    std::set<std::int32_t> one(mesh.triangles[f].begin(), mesh.triangles[f].end());
    std::vector<std::int32_t> common, tips;
    for (const std::int32_t v : mesh.triangles[f + 1]) (one.contains(v) ? common : tips).push_back(v);
    ASSERT_EQ(common.size(), 2u);
    if (random() % 2 == 0) continue;
    const auto& t = mesh.triangles[f];
    for (std::size_t i = 0; i < 3; ++i) {
      if (std::ranges::find(common, t[i]) != common.end()) continue;
      const std::int32_t tip = t[i], next = t[(i + 1) % 3], last = t[(i + 2) % 3], other = tips[0];
      mesh.triangles[f] = {tip, next, other};
      mesh.triangles[f + 1] = {tip, other, last};
      break;
    }
  }
  EXPECT_EQ(PartFinder(shared(mesh.surface())).find().borders, PartFinder(shared(whole)).find().borders);
}

TEST(PartFinder, numbers_parts_as_face_segments_does) {
  const auto surface = drum(24);
  const Parts parts = PartFinder(surface).find();
  EXPECT_EQ(parts.of_face, face_segments(*surface, edges_of(parts)));
}

TEST(PartFinder, leaves_out_seams_that_are_there) {
  const auto surface = drum(24);
  const Parts all = PartFinder(surface).find();
  std::vector<Edge> seams;
  for (std::size_t i = 1; i < all.borders[0].size(); ++i) seams.push_back({all.borders[0][i], all.borders[0][i - 1]});
  const Parts rest = PartFinder(surface, {.seams = seams}).find();
  EXPECT_EQ(rest.count, 3u);
  ASSERT_EQ(rest.borders.size(), 1u);
  EXPECT_EQ(rest.borders[0], all.borders[1]);
  EXPECT_EQ(PartFinder(surface, {.seams = seams}).find(0.0).count, 2u);
}

TEST(PartFinder, parts_at_marked_edges) {
  // A ring around the middle of a drum, where the surface does not bend.
  const auto surface = drum(24);
  std::vector<Edge> ring;
  for (const Edge& edge : surface->edges()) {
    if (std::abs(surface->points()[edge[0]].x()) + std::abs(surface->points()[edge[1]].x()) < 1e-9)
      ring.push_back(edge);
  }
  ASSERT_EQ(ring.size(), 24u);
  EXPECT_EQ(PartFinder(surface, {.marked = {ring}}).find().count, 4u);
}

TEST(PartFinder, ignores_marks_that_are_everywhere) {
  // Two drums. All edges of one are marked, and a ring around the middle of the other.
  const auto drum_alone = drum(24);
  const auto count = static_cast<std::int32_t>(drum_alone->vertex_count());
  std::vector<Vector> points = drum_alone->points();
  std::vector<Triangle> triangles = drum_alone->triangles();
  std::vector<Edge> edges = drum_alone->edges(), ring;
  const std::vector<Edge> everywhere = edges;
  for (std::int32_t v = 0; v < count; ++v) points.push_back(points[v] + Vector(0, 0, 3));
  for (const auto& [a, b, c] : drum_alone->triangles()) triangles.push_back({count + a, count + b, count + c});
  for (const auto& [a, b] : everywhere) {
    edges.push_back({count + a, count + b});
    if (std::abs(points[a].x()) + std::abs(points[b].x()) < 1e-9) ring.push_back(edges.back());
  }
  ASSERT_EQ(ring.size(), 24u);
  const auto both = std::make_shared<const Surface>(points, triangles, edges);
  const std::size_t without = PartFinder(both).find().count;
  EXPECT_EQ(PartFinder(both, {.marked = {edges}}).find().count, without);
  std::vector<Edge> marked = everywhere;
  marked.insert(marked.end(), ring.begin(), ring.end());
  EXPECT_EQ(PartFinder(both, {.marked = {marked}}).find().count, without + 1);
  EXPECT_EQ(PartFinder(both, {.marked = {edges, ring}}).find().count, without + 1) << "another kind of mark counts";
  std::vector<Edge> nearly = everywhere;
  for (std::size_t i = 0; i < nearly.size(); i += 10) nearly[i] = nearly.back();
  EXPECT_EQ(PartFinder(both, {.marked = {nearly}}).find().count, without);
}

TEST(PartFinder, follows_edits) {
  const auto surface = drum(24);
  const PartFinder finder(surface);
  const Parts parts = finder.find();
  std::vector<Edge> ring;
  for (std::size_t i = 1; i < parts.borders[0].size(); ++i)
    ring.push_back({parts.borders[0][i - 1], parts.borders[0][i]});
  EXPECT_EQ(finder.find(0.5, {.dropped = ring}).borders, Chains(1, parts.borders[1]));
  EXPECT_EQ(finder.find(0.0, {.kept = ring}).borders, Chains(1, parts.borders[0]));
}

TEST(PartFinder, does_not_part_along_dropped_edges) {
  const auto surface = drum(24);
  const PartFinder finder(surface);
  std::vector<Edge> rings;
  for (const std::vector<std::int32_t>& chain : finder.find().borders) {
    for (std::size_t i = 1; i < chain.size(); ++i) {
      rings.push_back({std::min(chain[i - 1], chain[i]), std::max(chain[i - 1], chain[i])});
    }
  }
  const Parts halves = finder.find(0.5, {.dropped = rings, .parted = {0}});
  EXPECT_EQ(halves.count, 2u);
  for (const auto& [a, b] : edges_of(halves)) {
    EXPECT_EQ(std::ranges::find(rings, Edge{std::min(a, b), std::max(a, b)}), rings.end());
  }
}

TEST(PartFinder, keeps_a_step_of_a_chamfer_if_asked_to) {
  const auto surface = drum(32, 0.008);
  std::vector<Edge> rings;  // both sides of the step at one end
  for (const Edge& edge : surface->edges()) {
    const Vector &a = surface->points()[edge[0]], &b = surface->points()[edge[1]];
    const bool is_ring = std::abs(a.x() - b.x()) < 1e-9 && std::abs(a.tail<2>().norm() - b.tail<2>().norm()) < 1e-9;
    if (is_ring && a.x() > 0.4 && a.tail<2>().norm() > 0.3) rings.push_back(edge);
  }
  ASSERT_EQ(rings.size(), 64u);
  EXPECT_EQ(PartFinder(surface).find(0.5, {.kept = rings}).count, 4u);
}

TEST(PartFinder, parts_at_marked_edges_that_look_like_diagonals) {
  // A line across the squares of a grid, each of two triangles.
  const auto surface = shared(shapes::grid(6).surface());
  std::vector<Edge> line;
  for (const Edge& edge : surface->edges()) {
    const Vector &a = surface->points()[edge[0]], &b = surface->points()[edge[1]];
    if (std::abs(a.x() - a.y()) < 1e-9 && std::abs(b.x() - b.y()) < 1e-9) line.push_back(edge);
  }
  ASSERT_EQ(line.size(), 6u) << "the diagonals of shapes::grid() run this way";
  EXPECT_EQ(PartFinder(surface, {.marked = {line}}).find().count, 2u);
  EXPECT_EQ(PartFinder(surface, {.seams = line}).find().count, 2u);
  EXPECT_TRUE(PartFinder(surface, {.seams = line}).find().borders.empty());
}

TEST(PartFinder, parts_at_kept_edges_that_look_like_diagonals) {
  const Surface quads = shapes::quad_grid(4).surface();
  const auto triangles = shared(Surface(quads.points(), quads.triangles()));
  for (const Triangle& t : quads.triangles()) {
    const std::array<Edge, 3> sides{ascending(t[0], t[1]), ascending(t[1], t[2]), ascending(t[2], t[0])};
    const auto diagonal = std::ranges::find_if(sides, [&](const Edge& side) { return !has_edge(quads, side); });
    ASSERT_NE(diagonal, sides.end());
    const std::vector<Edge> borders = edges_of(PartFinder(triangles).find(0.5, {.kept = {*diagonal}}));
    const auto is_kept = [&](const Edge& edge) { return ascending(edge[0], edge[1]) == *diagonal; };
    EXPECT_TRUE(std::ranges::any_of(borders, is_kept));
    EXPECT_EQ(PartFinder(shared(quads)).find(0.5, {.kept = {*diagonal}}).count, 1u) << "inside a polygon";
  }
}

TEST(PartFinder, has_no_borders_inside_a_part) {
  // The right half of a square is two strips. Each strip has half of the left half as its mirror image, so the image of
  // a cut across a strip ends inside of the left half.
  const auto surface = shared(shapes::quad_grid(8).surface());
  std::vector<Edge> seams;
  for (const Edge& edge : surface->edges()) {
    const double one = surface->points()[edge[0]].x(), other = surface->points()[edge[1]].x();
    if (one == other && (one == 0.5 || one == 0.75)) seams.push_back(edge);
  }
  const PartFinder finder(surface, {.mirror = 0, .seams = seams});
  EXPECT_TRUE(finder.find().borders.empty());
  const auto is_in_strip = [&](const Triangle& t) {
    const double x = (surface->points()[t[0]] + surface->points()[t[1]] + surface->points()[t[2]]).x() / 3.0;
    return 0.5 < x && x < 0.75;
  };
  const auto face = std::ranges::find_if(surface->triangles(), is_in_strip) - surface->triangles().begin();
  const Parts parts = finder.find(0.5, {.parted = {static_cast<std::int32_t>(face)}});
  EXPECT_EQ(parts.count, 4u);
  for (const Edge& edge : edges_of(parts)) {
    for (const std::int32_t v : edge) EXPECT_GE(surface->points()[v].x(), 0.5);
  }
}

TEST(PartFinder, ends_borders_at_existing_seams) {
  // A seam along the wall from lid to lid meets both rims.
  const auto surface = drum(24);
  std::vector<Edge> seam;
  for (const Edge& edge : surface->edges()) {
    const Vector &a = surface->points()[edge[0]], &b = surface->points()[edge[1]];
    const auto is_on_line = [](const Vector& p) { return p.y() > 0.39 && std::abs(p.z()) < 1e-9; };
    if (is_on_line(a) && is_on_line(b)) seam.push_back(edge);
  }
  ASSERT_EQ(seam.size(), 4u);
  const Parts parts = PartFinder(surface, {.seams = seam}).find();
  ASSERT_EQ(parts.borders.size(), 2u);
  for (const std::vector<std::int32_t>& chain : parts.borders) {
    EXPECT_EQ(chain.front(), chain.back());
    EXPECT_NEAR(surface->points()[chain.front()].z(), 0.0, 1e-9) << "the ring begins where the seam meets it";
    EXPECT_GT(surface->points()[chain.front()].y(), 0.0);
  }
}

TEST(PartFinder, leaves_alone_seams_on_the_other_side) {
  // A slit that ends halfway, on one side of a symmetric box, is not mirrored by parting that side.
  shapes::QuadMesh mesh = shapes::plate({"####"}, 4);
  for (Vector& point : mesh.points) point -= Vector(2.0, 0.5, 0.5);
  const auto surface = shared(mesh.surface());
  std::vector<Edge> slit;
  for (const Edge& edge : surface->edges()) {
    const Vector &a = surface->points()[edge[0]], &b = surface->points()[edge[1]];
    const auto is_on = [](const Vector& p) {
      return std::abs(p.z() - 0.5) < 1e-9 && std::abs(p.y()) < 1e-9 && p.x() > 0.9 && p.x() < 1.6;
    };
    if (is_on(a) && is_on(b)) slit.push_back(edge);
  }
  ASSERT_EQ(slit.size(), 2u);
  std::vector<Edge> middle;
  for (const Edge& edge : surface->edges()) {
    if (std::abs(surface->points()[edge[0]].x()) + std::abs(surface->points()[edge[1]].x()) < 1e-9) {
      middle.push_back(edge);
    }
  }
  std::vector<Edge> seams = slit;
  seams.insert(seams.end(), middle.begin(), middle.end());
  std::int32_t right = 0;
  while (surface->points()[surface->triangles()[right][0]].x() < 0.5) ++right;
  for (const Edge& edge : edges_of(PartFinder(surface, {.mirror = 0, .seams = seams}).find(0.0, {.parted = {right}}))) {
    for (const std::int32_t v : edge) {
      const Vector& p = surface->points()[v];
      EXPECT_FALSE(std::abs(p.z() - 0.5) < 1e-9 && std::abs(p.y()) < 1e-9 && p.x() < -1.1 && p.x() > -1.4);
    }
  }
}

TEST(PartFinder, takes_a_fan_of_many_triangles) {
  const Parts parts =
      PartFinder(shared(shapes::lathe(20000, {{-0.5, 0.0}, {-0.5, 0.4}, {0.5, 0.4}, {0.5, 0.0}}).surface())).find();
  EXPECT_EQ(parts.count, 3u);
}

/// The length of all borders.
double border_length(const Surface& surface, const Parts& parts) {
  double length = 0.0;
  for (const auto& [a, b] : edges_of(parts)) length += (surface.points()[a] - surface.points()[b]).norm();
  return length;
}

TEST(PartFinder, parts_a_part_into_two) {
  for (const int level : {3, 5}) {  // the cut of the large ball is found among blocks of its triangles, and refined
    const auto ball = shared(shapes::icosphere(level).surface());
    const PartFinder finder(ball);
    const Parts halves = finder.find(0.5, {.parted = {0}});
    EXPECT_EQ(halves.count, 2u);
    EXPECT_GT(shares(*ball, halves)[1], 0.4);
    EXPECT_LT(border_length(*ball, halves), 1.22 * std::numbers::pi) << "hardly longer than a great circle";
    EXPECT_EQ(finder.find(0.5, {.parted = {0, 0, 0}}).count, 4u);
  }
}

TEST(PartFinder, parts_bodies_into_halves_of_comparable_size) {
  const std::vector<std::vector<std::string>> bodies{
      {".#..........", "############", "############", "############"},  // a long box with a bump
      {"#.......", "#.......", "#.......", "########"},                  // an L
      {"###.....", "###.....", "########", "###.....", "###....."},      // a block with a thin rod
      {"#.#.#.#.#", "#########"},                                        // a comb
  };
  for (const std::vector<std::string>& rows : bodies) {
    for (const int n : {1, 2, 3}) {
      const auto body = shared(shapes::plate(rows, n).surface());
      const auto face_count = static_cast<std::int32_t>(body->triangles().size());
      for (const std::int32_t face : {0, face_count / 2, face_count - 1}) {
        const Parts halves = PartFinder(body).find(0.0, {.parted = {face}});
        ASSERT_EQ(halves.count, 2u) << rows[0] << " " << n;
        EXPECT_GE(shares(*body, halves)[1], 0.2) << rows[0] << " " << n;
      }
    }
  }
}

TEST(PartFinder, parts_a_flat_l_across) {
  // Both arms are one unit wide and three long.
  shapes::QuadMesh mesh = shapes::quad_grid(9);
  for (Vector& point : mesh.points) point *= 3.0;
  std::erase_if(mesh.quads, [&](const auto& quad) {
    const Vector middle = 0.5 * (mesh.points[index(quad[0])] + mesh.points[index(quad[2])]);
    return middle.x() > 1.0 && middle.y() > 1.0;
  });
  const auto sheet = shared(mesh.surface());
  const Parts halves = PartFinder(sheet).find(0.0, {.parted = {0}});
  ASSERT_EQ(halves.count, 2u);
  EXPECT_GE(shares(*sheet, halves)[1], 0.3);
  EXPECT_NEAR(border_length(*sheet, halves), 1.0, 1e-9);
}

TEST(PartFinder, parts_the_wall_of_a_cylinder) {
  // A flat one is cut along two lines, a long one around.
  for (const auto& [rows, height, shortest] : {std::tuple(4, 0.2, 0.4), std::tuple(40, 5.0, 0.5 * std::numbers::pi)}) {
    const auto wall = shared(shapes::quad_cylinder(24, rows, 0.25, height).surface());
    const Parts halves = PartFinder(wall).find(0.0, {.parted = {0}});
    ASSERT_EQ(halves.count, 2u) << height;
    EXPECT_GE(shares(*wall, halves)[1], 0.4) << height;
    EXPECT_LT(border_length(*wall, halves), 1.01 * shortest) << height;
  }
}

TEST(PartFinder, parts_a_lid_of_spokes) {
  const auto lid = drum(64);
  const Parts parts = PartFinder(lid).find();
  std::int32_t face = 0;
  while (parts.of_face[face] != parts.of_face.back()) ++face;
  const Parts halves = PartFinder(lid).find(0.5, {.parted = {face}});
  ASSERT_EQ(halves.count, 4u);
  std::vector<double> own(halves.count, 0.0);
  double all = 0.0;
  for (std::size_t f = 0; f < parts.of_face.size(); ++f) {
    if (parts.of_face[f] != parts.of_face[face]) continue;
    const auto& [a, b, c] = lid->triangles()[f];
    const auto& points = lid->points();
    const double area = (points[b] - points[a]).cross(points[c] - points[a]).norm();
    own[halves.of_face[f]] += area;
    all += area;
  }
  std::ranges::sort(own, std::ranges::greater());
  EXPECT_GT(own[1], 0.2 * all);
}

TEST(PartFinder, parts_what_lies_across_the_mirror_plane_symmetrically) {
  // Edges lie on the plane x = 0 where the number of columns is even, otherwise faces cross it.
  for (const std::vector<std::string>& rows : std::vector<std::vector<std::string>>{
           {"##########"}, {"#########"}, {"#.....#", "#.....#", "#######"}, {"..##..", "######"}}) {
    for (const int n : {1, 3}) {
      shapes::QuadMesh mesh = shapes::plate(rows, n);
      for (Vector& point : mesh.points) point.x() -= 0.5 * static_cast<double>(rows[0].size());
      const auto surface = shared(mesh.surface());
      const Parts halves = PartFinder(surface, {.mirror = 0}).find(0.0, {.parted = {0}});
      ASSERT_EQ(halves.count, 2u) << rows[0];
      EXPECT_GE(shares(*surface, halves)[1], 0.2) << rows[0];
      std::set<std::array<long, 3>> own, images;
      for (const auto& [a, b] : edges_of(halves)) {
        const Vector middle = 0.5 * (surface->points()[a] + surface->points()[b]);
        const auto key = [&](double x) {
          return std::array{std::lround(x * 1e4), std::lround(middle.y() * 1e4), std::lround(middle.z() * 1e4)};
        };
        own.insert(key(middle.x()));
        images.insert(key(-middle.x()));
      }
      EXPECT_EQ(own, images) << rows[0] << " " << n;
    }
  }
}

TEST(PartFinder, parts_along_the_mirror_plane_where_that_is_the_shortest_cut) {
  std::vector<std::array<double, 2>> profile;
  for (int i = -8; i <= 8; ++i) profile.push_back({i / 8.0, 0.3 * std::sqrt(1.0 - i * i / 64.0)});
  const auto egg = shared(shapes::lathe(24, profile).surface());
  const Parts halves = PartFinder(egg, {.mirror = 0}).find(0.0, {.parted = {0}});
  ASSERT_EQ(halves.count, 2u);
  for (const auto& [a, b] : edges_of(halves)) EXPECT_NEAR(egg->points()[a].x(), 0.0, 1e-9);
}

TEST(PartFinder, joins_small_regions_unless_a_sharp_rim_encloses_them) {
  // A plate with a knob of .1 % of its area: a dome that starts gently, or a plug.
  const auto plate = [](const std::vector<std::array<double, 2>>& top) {
    std::vector<std::array<double, 2>> profile{{-0.2, 0.0}, {-0.2, 0.5}, {0.0, 0.5}, {0.0, 0.25}};
    profile.insert(profile.end(), top.begin(), top.end());
    return shared(shapes::lathe(24, profile).surface());
  };
  const auto without = plate({{0.0, 0.02}, {0.0, 0.0}});
  const auto dome = plate({{0.0, 0.02}, {0.008, 0.012}, {0.009, 0.0}});
  const auto plug = plate({{0.0, 0.02}, {0.03, 0.02}, {0.03, 0.0}});
  EXPECT_EQ(PartFinder(without).find().count, 3u);
  EXPECT_EQ(PartFinder(dome).find().count, 3u);
  EXPECT_GT(PartFinder(plug).find().count, 3u);
}

TEST(PartFinder, finds_symmetric_parts) {
  // A row of cubes with a hole, symmetric in x after a shift.
  shapes::QuadMesh mesh = shapes::plate({"#####", "#.#.#", "#####"}, 2);
  for (Vector& point : mesh.points) point -= Vector(2.5, 1.5, 0.5);
  const auto surface = shared(mesh.surface());
  std::map<std::array<long, 3>, std::int32_t> at;
  const auto key = [](const Vector& p) {
    return std::array{std::lround(p.x() * 1e4), std::lround(p.y() * 1e4), std::lround(p.z() * 1e4)};
  };
  for (std::size_t v = 0; v < mesh.points.size(); ++v) at[key(mesh.points[v])] = static_cast<std::int32_t>(v);
  for (const double amount : {0.2, 0.5, 0.8}) {
    std::set<Edge> own, images;
    for (const auto& [a, b] : edges_of(PartFinder(surface, {.mirror = 0}).find(amount))) {
      const auto image = [&](std::int32_t v) {
        const Vector& p = mesh.points[static_cast<std::size_t>(v)];
        return at.at(key(Vector(-p.x(), p.y(), p.z())));
      };
      own.insert({std::min(a, b), std::max(a, b)});
      images.insert({std::min(image(a), image(b)), std::max(image(a), image(b))});
    }
    EXPECT_EQ(own, images) << amount;
  }
}

/// The triangle at the mirror image of each triangle. The mesh has one for each.
std::vector<std::int32_t> mirrored_triangles(const shapes::Mesh& mesh, int axis) {
  const auto corners = [&](const Triangle& triangle, bool is_mirrored) {
    std::array<std::array<double, 3>, 3> found{};
    for (std::size_t i = 0; i < 3; ++i) {
      Vector point = mesh.points[triangle[i]];
      if (is_mirrored) point[axis] = 0.0 - point[axis];
      for (int k = 0; k < 3; ++k) found[i][static_cast<std::size_t>(k)] = std::round(1e6 * point[k]) + 0.0;
    }
    std::ranges::sort(found);
    return found;
  };
  std::map<std::array<std::array<double, 3>, 3>, std::int32_t> by_corners;
  std::vector<std::int32_t> images;
  for (const Triangle& triangle : mesh.triangles) {
    by_corners.emplace(corners(triangle, false), static_cast<std::int32_t>(by_corners.size()));
  }
  for (const Triangle& triangle : mesh.triangles) images.push_back(by_corners.at(corners(triangle, true)));
  return images;
}

TEST(PartFinder, finds_symmetric_parts_where_triangles_could_be_paired_in_several_ways) {
  for (const double waves : {3.0, 3.3, 3.6, 3.9, 4.2}) {
    shapes::Mesh mesh = shapes::icosphere(2, 1.0);
    for (Vector& p : mesh.points) {
      p *= 1.0 + 0.6 * std::sin(waves * std::abs(p.x())) + 0.2 * std::cos(4.0 * p.y());
      for (double& x : p) x = std::copysign(std::pow(std::abs(x), 0.3), x);  // as a box is
    }
    const std::vector<std::int32_t> images = mirrored_triangles(mesh, 0);
    const Parts parts = PartFinder(shared(mesh.surface()), {.mirror = 0}).find(0.8);
    std::set<std::pair<std::int32_t, std::int32_t>> pairs;
    for (std::size_t f = 0; f < images.size(); ++f) pairs.emplace(parts.of_face[f], parts.of_face[images[f]]);
    EXPECT_EQ(pairs.size(), parts.count) << waves;
  }
}

TEST(PartFinder, finds_the_parts_of_pieces_by_themselves) {
  shapes::Mesh mesh = shapes::icosphere(2);
  const auto first = static_cast<std::int32_t>(mesh.points.size());
  const shapes::Mesh other = shapes::torus(16, 8);
  for (const Vector& point : other.points) mesh.points.emplace_back(point + Vector(3.0, 0.0, 0.0));
  for (const auto& [a, b, c] : other.triangles) mesh.triangles.push_back({first + a, first + b, first + c});
  EXPECT_EQ(PartFinder(shared(mesh.surface())).find(0.0).count, 2u);
}

TEST(PartFinder, can_be_cancelled) {
  const auto surface = shared(shapes::torus(120, 80).surface());
  const auto until = [](double most) {
    return Task{.stop = {}, .progress = [most](double done) { return done < most; }};
  };
  for (const double most : {0.0, 0.1, 0.5, 0.9}) EXPECT_THROW(PartFinder(surface, {}, until(most)), Cancelled);
  const PartFinder finder(surface);
  for (const double most : {0.0, 0.1, 0.5, 0.7}) EXPECT_THROW(finder.find(0.5, {}, until(most)), Cancelled);
  EXPECT_THROW(finder.find(0.5, {.parted = {0}}, until(0.6)), Cancelled);
  std::stop_source source;
  source.request_stop();
  EXPECT_THROW(finder.find(0.5, {}, {.stop = source.get_token(), .progress = {}}), Cancelled);
  double last = 0.0;
  const auto rises = [&](double done) { return std::exchange(last, done) <= done; };
  EXPECT_EQ(finder.find(0.5, {.parted = {0, 0}}, {.stop = {}, .progress = rises}).count, 3u);
  EXPECT_GT(last, 0.7);
}

TEST(PartFinder, refuses_bad_arguments) {
  const auto surface = drum(12);
  EXPECT_THROW(PartFinder(nullptr), InvalidInput);
  EXPECT_THROW(PartFinder(surface, {.mirror = 3}), InvalidInput);
  EXPECT_THROW(PartFinder(surface, {.marked = {{{0, 100000}}}}), InvalidInput);
  EXPECT_THROW(PartFinder(surface, {.seams = {{-1, 0}}}), InvalidInput);
  for (const double size : {0.0, std::nan("")}) {
    EXPECT_THROW(PartFinder(surface, {.by = PartsBy::kPanels, .front = Vector(0.0, size, 0.0)}), InvalidInput);
  }
  const PartFinder finder(surface);
  EXPECT_THROW(finder.find(1.5), InvalidInput);
  EXPECT_THROW(finder.find(std::nan("")), InvalidInput);
  EXPECT_THROW(finder.find(0.5, {.kept = {{0, 100000}}}), InvalidInput);
  EXPECT_THROW(finder.find(0.5, {.parted = {100000}}), InvalidInput);
}

TEST(Polygons, joins_the_triangles_of_quads) {
  const Surface surface = shapes::grid(4).surface();
  const PlanMesh mesh = plan_mesh(surface, {});
  const Polygons polygons = find_polygons(mesh, {}, {});
  EXPECT_EQ(polygons.count, 16u);
  EXPECT_EQ(std::ranges::count(polygons.is_diagonal, 1), 16);
}

TEST(Polygons, has_lines_that_go_on_over_crossings) {
  const Surface surface = shapes::quad_grid(4).surface();
  const PlanMesh mesh = plan_mesh(surface, {});
  const Polygons polygons = find_polygons(mesh, {}, {});
  const std::vector<std::vector<std::int32_t>> lines = find_lines(mesh, polygons, {});
  EXPECT_EQ(lines.size(), 10u);
  for (const std::vector<std::int32_t>& line : lines) EXPECT_EQ(line.size(), 4u);
}

}  // namespace
}  // namespace seamwire
