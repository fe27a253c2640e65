// SPDX-License-Identifier: GPL-3.0-or-later
#include "seamwire/surface/surface.hpp"
#include "surface/half_edge_mesh.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <random>
#include <set>
#include <string>

#include "shapes.hpp"
#include "surface/corner_fans.hpp"

namespace seamwire {

using namespace detail;

namespace {

using shapes::Mesh;
using Numbers = std::vector<std::int32_t>;
using Edges = std::vector<Edge>;

// Siblings are the half-edges without a twin of the edges that the report lists, in one cycle an edge.
void expect_sound_siblings(const Surface& surface) {
  std::map<Edge, std::set<std::int32_t>> half_edges_of;
  const auto vertex = [&](std::int32_t h) {
    return corner_fans(surface).vertices[corner_fans(surface).triangles[h / 3][h % 3]];
  };
  for (std::int32_t h = 0; h < static_cast<std::int32_t>(corner_fans(surface).twins.size()); ++h) {
    const auto [a, b] = std::minmax({vertex(h), vertex(h % 3 == 2 ? h - 2 : h + 1)});
    if (corner_fans(surface).twins[h] < 0) half_edges_of[{a, b}].insert(h);
  }
  std::erase_if(half_edges_of, [](const auto& item) { return item.second.size() == 1; });
  std::vector<Edge> odd = surface.report().nonmanifold_edges;
  odd.insert(odd.end(), surface.report().unorientable_edges.begin(), surface.report().unorientable_edges.end());
  ASSERT_EQ(half_edges_of.size(), odd.size());
  ASSERT_EQ(corner_fans(surface).siblings.size(), odd.empty() ? 0U : corner_fans(surface).twins.size());
  std::size_t count = 0;
  for (const Edge& edge : odd) {
    std::set<std::int32_t> cycle;
    ASSERT_TRUE(half_edges_of.contains(edge));
    for (std::int32_t h = *half_edges_of[edge].begin(); cycle.insert(h).second;) h = corner_fans(surface).siblings[h];
    EXPECT_EQ(cycle, half_edges_of[edge]);
    count += cycle.size();
  }
  EXPECT_EQ(
      static_cast<std::size_t>(std::ranges::count_if(corner_fans(surface).siblings, [](auto h) { return h >= 0; })),
      count);
}

// Every surface must be a manifold, consistently linked half-edge mesh of the caller's faces, with nothing lost and
// nothing twice.
void expect_sound(const Surface& surface) {
  expect_sound_siblings(surface);
  const HalfEdgeMesh mesh = half_edge_mesh(surface);
  const auto& vertex_of_fan = corner_fans(surface).vertices;
  const auto& source = corner_fans(surface).faces;
  ASSERT_EQ(mesh.n_vertices(), vertex_of_fan.size());
  ASSERT_EQ(mesh.n_faces(), source.size());
  EXPECT_TRUE(std::ranges::is_sorted(vertex_of_fan));
  EXPECT_TRUE(std::ranges::is_sorted(source));
  EXPECT_EQ(mesh.n_faces() + surface.report().degenerate_faces.size() + surface.report().duplicate_faces.size(),
            surface.face_count());

  std::set<Edge> carried;
  for (const auto h : mesh.halfedges()) {
    ASSERT_TRUE(h.next().is_valid());
    EXPECT_EQ(h.next().from(), h.to());
    EXPECT_EQ(h.next().face(), h.face());
    EXPECT_EQ(h.opp().from(), h.to());
    EXPECT_NE(h.from(), h.to());
    const auto [a, b] = std::minmax(vertex_of_fan[h.from().idx()], vertex_of_fan[h.to().idx()]);
    carried.insert({a, b});
  }
  for (const auto e : mesh.edges()) EXPECT_FALSE(e.h0().is_boundary() && e.h1().is_boundary());
  for (const auto v : mesh.vertices()) {
    EXPECT_EQ(v.halfedge().from(), v);
    EXPECT_EQ(mesh.point(v), surface.points()[vertex_of_fan[v.idx()]]);
    // One turn about the vertex meets all of its half-edges, and the boundary at most once.
    std::size_t outgoing = 0;
    std::size_t boundary = 0;
    for (const auto h : mesh.voh_range(v)) {
      ++outgoing;
      boundary += h.is_boundary();
    }
    EXPECT_LE(boundary, 1U);
    EXPECT_EQ(boundary == 1, v.halfedge().is_boundary());
    std::size_t all = 0;
    if (mesh.n_halfedges() < 1000) {
      for (const auto h : mesh.halfedges()) all += h.from() == v;
      EXPECT_EQ(outgoing, all);
    }
  }
  for (const auto f : mesh.faces()) {
    std::vector<std::int32_t> corners;
    for (const auto v : mesh.fv_range(f)) corners.push_back(vertex_of_fan[v.idx()]);
    const Triangle given = surface.triangles()[source[f.idx()]];
    if (std::ranges::binary_search(surface.report().flipped_faces, source[f.idx()])) {
      EXPECT_EQ(corners, (Numbers{given[0], given[2], given[1]}));
    } else {
      EXPECT_EQ(corners, (Numbers{given[0], given[1], given[2]}));
    }
    EXPECT_EQ(f.halfedge().face(), f);
  }
  // The flat arrays say the same.
  ASSERT_EQ(corner_fans(surface).triangles.size(), mesh.n_faces());
  ASSERT_EQ(corner_fans(surface).twins.size(), 3 * mesh.n_faces());
  std::map<int, std::int32_t> number;  // of a half-edge with a face
  for (const auto f : mesh.faces()) {
    std::int32_t h = 3 * f.idx();
    for (auto side = f.halfedge().next(); !number.contains(side.idx()); side = side.next()) {
      EXPECT_EQ(side.from().idx(), corner_fans(surface).triangles[f.idx()][h % 3]);
      number[side.idx()] = h++;
    }
  }
  for (const auto& [side, h] : number) {
    const auto beyond = mesh.opposite_halfedge_handle(OpenMesh::HalfedgeHandle(side));
    EXPECT_EQ(corner_fans(surface).twins[h], mesh.is_boundary(beyond) ? -1 : number.at(beyond.idx()));
  }

  // Vertices that the input's edges connect stay reachable: every edge either has a face or is loose.
  std::set<Edge> input(surface.edges().begin(), surface.edges().end());
  for (const Triangle& t : surface.triangles()) {
    for (int i = 0; i < 3; ++i) {
      const auto [a, b] = std::minmax(t[i], t[(i + 1) % 3]);
      if (a != b) input.insert({a, b});
    }
  }
  std::set<Edge> found = carried;
  for (const Edge& edge : surface.loose_edges()) EXPECT_TRUE(found.insert(edge).second);
  EXPECT_EQ(found, input);
  EXPECT_TRUE(std::ranges::is_sorted(surface.edges()));
  EXPECT_TRUE(std::ranges::is_sorted(surface.loose_edges()));
}

std::size_t boundary_edges_of_half_edges(const Surface& surface) {
  std::size_t count = 0;
  const HalfEdgeMesh mesh = half_edge_mesh(surface);
  for (const auto& edge : mesh.edges()) count += edge.is_boundary() ? 1 : 0;
  return count;
}

bool is_untouched(const SurfaceReport& report) {
  return report.nonmanifold_edges.empty() && report.unorientable_edges.empty() && report.flipped_faces.empty() &&
         report.zero_area_faces.empty() && report.degenerate_faces.empty() && report.duplicate_faces.empty() &&
         report.isolated_vertices.empty();
}

std::string message_of(const std::function<void()>& make) {
  try {
    make();
  } catch (const InvalidInput& error) {
    return error.what();
  }
  return "nothing was thrown";
}

bool says(const std::string& message, const std::string& part) { return message.find(part) != std::string::npos; }

Mesh tetrahedron() {
  return {.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}},
          .triangles = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}}};
}

TEST(Surface, KeepsNumbersAndFindsNothingOddOnCleanMeshes) {
  for (const Mesh& mesh : {shapes::grid(7, 0.3), shapes::icosphere(2), shapes::cylinder(9, 4), shapes::torus(12, 8)}) {
    const Surface surface = mesh.surface();
    expect_sound(surface);
    EXPECT_TRUE(is_untouched(surface.report()));
    EXPECT_EQ(surface.report().components, 1U);
    EXPECT_EQ(surface.report().boundary_edges, boundary_edges_of_half_edges(surface));
    EXPECT_EQ(surface.points(), mesh.points);
    EXPECT_EQ(surface.triangles(), mesh.triangles);
    EXPECT_EQ(surface.edges().size(), half_edge_mesh(surface).n_edges());
    EXPECT_TRUE(surface.loose_edges().empty());
    ASSERT_EQ(half_edge_mesh(surface).n_vertices(), mesh.points.size());
    for (std::size_t v = 0; v < mesh.points.size(); ++v) EXPECT_EQ(corner_fans(surface).vertices[v], v);
    for (std::size_t f = 0; f < mesh.triangles.size(); ++f) EXPECT_EQ(corner_fans(surface).faces[f], f);
  }
}

TEST(Surface, CountsTheBoundary) {
  EXPECT_EQ(shapes::grid(7).surface().report().boundary_edges, 28U);
  EXPECT_EQ(shapes::cylinder(9, 4).surface().report().boundary_edges, 18U);
  EXPECT_EQ(shapes::torus(12, 8).surface().report().boundary_edges, 0U);
}

TEST(Surface, ScalesTheLongestSideOfTheVerticesInUseToOne) {
  Mesh mesh = shapes::grid(2);
  for (Vector& p : mesh.points) p = Vector(10 + 4 * p.x(), -3 * p.y(), 7);
  mesh.points.emplace_back(1000, 1000, 1000);  // in no face and no edge
  EXPECT_DOUBLE_EQ(mesh.surface().scale(), 0.25);
  const auto isolated = static_cast<std::int32_t>(mesh.points.size() - 1);
  EXPECT_EQ(mesh.surface().report().isolated_vertices, (Numbers{isolated}));
  const Surface with_edge(mesh.points, mesh.triangles, std::vector<Edge>{{0, isolated}});
  EXPECT_DOUBLE_EQ(with_edge.scale(), 1.0 / 1003.0);
  EXPECT_TRUE(with_edge.report().isolated_vertices.empty());
}

TEST(Surface, HasScaleOneWhereAllPointsAreOne) {
  const Surface surface({{3, 3, 3}, {3, 3, 3}, {3, 3, 3}}, {{0, 1, 2}});
  expect_sound(surface);
  EXPECT_EQ(surface.scale(), 1.0);
  EXPECT_EQ(surface.report().zero_area_faces, (Numbers{0}));
}

TEST(Surface, CountsComponentsConnectedByEdgesButNotIsolatedVertices) {
  Mesh mesh = shapes::grid(2);
  const auto second = static_cast<std::int32_t>(mesh.points.size());
  for (const Vector& p : tetrahedron().points) mesh.points.push_back(p + Vector(5, 0, 0));
  for (const auto& [a, b, c] : tetrahedron().triangles) {
    mesh.triangles.push_back({a + second, b + second, c + second});
  }
  mesh.points.emplace_back(9, 9, 9);
  const Surface surface = mesh.surface();
  expect_sound(surface);
  EXPECT_EQ(surface.report().components, 2U);
  // A single edge between them makes them one.
  const Surface joined(mesh.points, mesh.triangles, std::vector<Edge>{{second, 0}});
  expect_sound(joined);
  EXPECT_EQ(joined.report().components, 1U);
  EXPECT_EQ(joined.loose_edges(), (Edges{{0, second}}));
}

TEST(Surface, TurnsTheFewerFacesOver) {
  Mesh mesh = shapes::icosphere(2);
  const std::vector<std::int32_t> turned = {3, 50, 51, 200};
  for (const std::int32_t f : turned) std::swap(mesh.triangles[f][1], mesh.triangles[f][2]);
  const Surface surface = mesh.surface();
  expect_sound(surface);
  EXPECT_EQ(surface.report().flipped_faces, turned);
  EXPECT_EQ(surface.triangles(), mesh.triangles);  // as given
  EXPECT_TRUE(surface.report().unorientable_edges.empty());
}

TEST(Surface, JudgesTheMajorityByArea) {
  // Two large faces, and a strip of four small ones on the other side of an edge that are all turned the other way.
  const Surface surface(
      {{0, 0, 0}, {10, 0, 0}, {10, 10, 0}, {0, 10, 0}, {0, -1, 0}, {2, -1, 0}, {4, -1, 0}, {6, -1, 0}},
      {{0, 4, 5}, {0, 5, 6}, {0, 6, 7}, {0, 7, 1}, {0, 2, 1}, {0, 3, 2}});
  expect_sound(surface);
  EXPECT_EQ(surface.report().flipped_faces, (Numbers{0, 1, 2, 3}));
}

TEST(Surface, DoesNotTurnAClosedComponentInsideOutOrNot) {
  Mesh mesh = tetrahedron();
  for (Triangle& t : mesh.triangles) std::swap(t[1], t[2]);  // inward
  EXPECT_TRUE(mesh.surface().report().flipped_faces.empty());
}

TEST(Surface, OrientsEachComponentByItself) {
  Mesh mesh = shapes::icosphere(1);
  const auto count = static_cast<std::int32_t>(mesh.points.size());
  const std::size_t faces = mesh.triangles.size();
  for (int v = 0; v < count; ++v) mesh.points.emplace_back(mesh.points[v] + Vector(2, 0, 0));
  for (std::size_t f = 0; f < faces; ++f) {
    const auto [a, b, c] = mesh.triangles[f];
    mesh.triangles.push_back({a + count, c + count, b + count});  // all inward: nothing to agree with
  }
  const Surface surface = mesh.surface();
  expect_sound(surface);
  EXPECT_TRUE(surface.report().flipped_faces.empty());
}

TEST(Surface, CutsAMoebiusStripWhereItsOrientationBreaks) {
  const Surface surface = shapes::moebius(12).surface();
  expect_sound(surface);
  EXPECT_EQ(surface.report().unorientable_edges, (Edges{{0, 1}}));
  EXPECT_TRUE(surface.report().flipped_faces.empty());
  EXPECT_EQ(surface.report().boundary_edges, 24U);  // the cut has two faces, and is not one of them
  EXPECT_EQ(boundary_edges_of_half_edges(surface), 26U);
  EXPECT_EQ(half_edge_mesh(surface).n_vertices(), 24U + 2U);  // both ends of the cut have two fans
  EXPECT_EQ(surface.report().components, 1U);
}

TEST(Surface, CutsAOneSidedSurfaceOfAnyOrientation) {
  std::mt19937 random(3);
  for (int trial = 0; trial < 20; ++trial) {
    Mesh mesh = shapes::moebius(9);
    for (Triangle& t : mesh.triangles) {
      if (random() % 2 == 0) std::swap(t[1], t[2]);
    }
    std::ranges::shuffle(mesh.triangles, random);
    const Surface surface = mesh.surface();
    expect_sound(surface);
    EXPECT_EQ(surface.report().unorientable_edges.size(), 1U);
    EXPECT_EQ(surface.report().components, 1U);
  }
}

TEST(Surface, CutsOpenAnEdgeWithThreeFaces) {
  const Surface surface({{0, 0, 0}, {0, 0, 1}, {1, 0, 0}, {0, 1, 0}, {-1, 0, 0}}, {{0, 1, 2}, {0, 1, 3}, {0, 1, 4}});
  expect_sound(surface);
  EXPECT_EQ(surface.report().nonmanifold_edges, (Edges{{0, 1}}));
  EXPECT_TRUE(surface.report().flipped_faces.empty());
  EXPECT_EQ(surface.report().boundary_edges, 6U);
  EXPECT_EQ(half_edge_mesh(surface).n_edges(), 9U);
  EXPECT_EQ(corner_fans(surface).vertices, (Numbers{0, 0, 0, 1, 1, 1, 2, 3, 4}));
  EXPECT_EQ(surface.report().components, 1U);
  EXPECT_EQ(surface.edges().size(), 7U);
}

TEST(Surface, HoldsASlitOneEdgeLong) {
  // A fin on one edge of a closed surface: cut open, both sides of the slit join the same two fans.
  Mesh mesh = shapes::icosphere(1);
  const Triangle& t = mesh.triangles[0];
  mesh.points.emplace_back(2, 2, 2);
  mesh.triangles.push_back({t[0], t[1], static_cast<std::int32_t>(mesh.points.size() - 1)});
  const Surface surface = mesh.surface();
  expect_sound(surface);
  EXPECT_EQ(surface.report().nonmanifold_edges.size(), 1U);
  EXPECT_EQ(half_edge_mesh(surface).n_vertices(), mesh.points.size() + 2);  // the fin has its own fan at both ends
  EXPECT_EQ(boundary_edges_of_half_edges(surface), 2U + 3U);
  EXPECT_EQ(half_edge_mesh(surface).n_faces(), mesh.triangles.size());
}

TEST(Surface, KeepsFansOfABowTieApartAndTheirVertexOne) {
  const Surface surface({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {-1, 0, 0}, {-1, -1, 0}}, {{0, 1, 2}, {0, 3, 4}});
  expect_sound(surface);
  EXPECT_EQ(corner_fans(surface).vertices, (Numbers{0, 0, 1, 2, 3, 4}));
  EXPECT_EQ(surface.report().components, 1U);
  EXPECT_TRUE(is_untouched(surface.report()));
}

TEST(Surface, LeavesOutDuplicateFacesInAnyOrderOfCorners) {
  Mesh mesh = tetrahedron();
  mesh.triangles.insert(mesh.triangles.begin() + 1, {1, 0, 2});  // face 0 turned over
  mesh.triangles.push_back({3, 1, 2});
  const Surface surface = mesh.surface();
  expect_sound(surface);
  EXPECT_EQ(surface.report().duplicate_faces, (Numbers{1, 5}));
  EXPECT_EQ(corner_fans(surface).faces, (Numbers{0, 2, 3, 4}));
  EXPECT_TRUE(surface.report().nonmanifold_edges.empty());
  EXPECT_EQ(surface.report().boundary_edges, 0U);
}

TEST(Surface, KeepsTheEdgesOfDegenerateFaces) {
  // The second face is but the edge (2, 3); the third a point.
  const std::vector<Vector> points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 2, 0}};
  const std::vector<Triangle> triangles = {{0, 1, 2}, {2, 3, 3}, {1, 1, 1}};
  const Surface surface(points, triangles);
  expect_sound(surface);
  EXPECT_EQ(surface.report().degenerate_faces, (Numbers{1, 2}));
  EXPECT_EQ(surface.loose_edges(), (Edges{{2, 3}}));
  EXPECT_EQ(surface.edges(), (Edges{{0, 1}, {0, 2}, {1, 2}, {2, 3}}));
  EXPECT_EQ(surface.report().components, 1U);
  // Not among the real edges, but what it connects stays connected.
  const Surface polygons(points, triangles, std::vector<Edge>{{0, 1}, {1, 2}, {2, 0}});
  expect_sound(polygons);
  EXPECT_EQ(polygons.edges().size(), 3U);
  EXPECT_EQ(polygons.loose_edges(), (Edges{{2, 3}}));
  EXPECT_EQ(polygons.report().components, 1U);
}

TEST(Surface, KeepsZeroAreaFacesAndNamesThem) {
  const Surface surface({{0, 0, 0}, {0.1, 0.1, 0.1}, {0.3, 0.3, 0.3}, {1, 0, 0}}, {{0, 1, 2}, {0, 2, 3}});
  expect_sound(surface);
  EXPECT_EQ(surface.report().zero_area_faces, (Numbers{0}));  // in line but for rounding
  EXPECT_EQ(half_edge_mesh(surface).n_faces(), 2U);
}

TEST(Surface, TakesTheRealEdgesOfPolygons) {
  const Mesh square = shapes::grid(1);  // vertices 0, 1 / 2, 3; the diagonal (0, 3) is not real
  const Surface surface(square.points, square.triangles,
                        std::vector<Edge>{{1, 0}, {0, 2}, {3, 2}, {1, 3}, {0, 1}, {2, 0}});
  EXPECT_EQ(surface.edges(), (Edges{{0, 1}, {0, 2}, {1, 3}, {2, 3}}));
  EXPECT_TRUE(surface.loose_edges().empty());
  EXPECT_EQ(half_edge_mesh(surface).n_edges(), 5U);
}

TEST(Surface, MayBeEdgesAlone) {
  const Surface surface({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}, {}, std::vector<Edge>{{2, 1}, {0, 1}});
  expect_sound(surface);
  EXPECT_EQ(surface.loose_edges(), (Edges{{0, 1}, {1, 2}}));
  EXPECT_EQ(surface.report().components, 1U);
  EXPECT_DOUBLE_EQ(surface.scale(), 0.5);
  EXPECT_EQ(half_edge_mesh(surface).n_vertices(), 0U);
}

TEST(Surface, StaysSoundOnRandomTriangles) {
  // Few vertices and many faces: every kind of trouble at once.
  std::mt19937 random(11);
  for (int trial = 0; trial < 200; ++trial) {
    const int n = 4 + static_cast<int>(random() % 12);
    Mesh mesh;
    for (int v = 0; v < n; ++v) {
      mesh.points.emplace_back(random() % 3, random() % 3, random() % 3);  // some coincide, some are in line
    }
    const int faces = 1 + static_cast<int>(random() % 40);
    const auto corner = [&] { return static_cast<std::int32_t>(random() % static_cast<unsigned>(n)); };
    for (int f = 0; f < faces; ++f) mesh.triangles.push_back({corner(), corner(), corner()});
    mesh.triangles.push_back({0, 1, 2});
    const Surface surface = mesh.surface();
    expect_sound(surface);
    EXPECT_TRUE(std::isfinite(surface.scale()));
  }
}

TEST(Surface, CanBeCopiedAndMoved) {
  Surface surface = shapes::icosphere(1).surface();
  const Surface copy = surface;
  expect_sound(copy);
  const Surface moved = std::move(surface);
  expect_sound(moved);
  EXPECT_EQ(copy.edges(), moved.edges());
}

TEST(Surface, CanBeStoppedWhileItIsBuilt) {
  const Mesh mesh = shapes::icosphere(1);
  std::vector<double> fractions;
  const auto build = [&](std::size_t checks) {
    fractions.clear();
    return Surface(mesh.points, mesh.triangles, std::nullopt, {.stop = {}, .progress = [&](double done) {
                                                                 fractions.push_back(done);
                                                                 return fractions.size() < checks;
                                                               }});
  };
  expect_sound(build(1000));
  const std::size_t all = fractions.size();
  EXPECT_GT(all, 3u);
  EXPECT_TRUE(std::ranges::is_sorted(fractions));
  EXPECT_TRUE(fractions.front() >= 0 && fractions.back() <= 1);
  for (std::size_t checks = 1; checks <= all; ++checks) EXPECT_THROW(build(checks), Cancelled);
  std::stop_source stop;
  stop.request_stop();
  EXPECT_THROW(Surface(mesh.points, mesh.triangles, std::nullopt, {.stop = stop.get_token(), .progress = {}}),
               Cancelled);
}

TEST(Surface, NamesTheVertexThatIsNotFinite) {
  for (const double bad : {std::numeric_limits<double>::quiet_NaN(), -std::numeric_limits<double>::infinity(), 1e200}) {
    Mesh mesh = shapes::grid(3);
    mesh.points[13].y() = bad;
    EXPECT_PRED2(says, (message_of([&] { mesh.surface(); })), "vertex 13 ");
  }
}

TEST(Surface, NamesTheTriangleAndTheIndexOutOfRange) {
  Mesh mesh = shapes::grid(3);
  mesh.triangles[7][2] = 16;
  EXPECT_PRED2(says, message_of([&] { mesh.surface(); }), "triangle 7: ");
  EXPECT_PRED2(says, message_of([&] { mesh.surface(); }), "vertex 16 ");
  mesh.triangles[7][2] = -1;
  EXPECT_PRED2(says, message_of([&] { mesh.surface(); }), "triangle 7: ");
  EXPECT_PRED2(says, message_of([&] { mesh.surface(); }), "vertex -1 ");
}

TEST(Surface, NamesTheEdgeThatIsWrong) {
  const Mesh mesh = shapes::grid(3);
  const auto with = [&](Edge edge) {
    return message_of([&] { Surface(mesh.points, mesh.triangles, std::vector<Edge>{{0, 1}, edge}); });
  };
  EXPECT_PRED2(says, with({2, 99}), "edge 1: ");
  EXPECT_PRED2(says, with({2, 99}), "vertex 99 ");
  EXPECT_PRED2(says, with({5, 5}), "edge 1 ");
  EXPECT_PRED2(says, with({5, 5}), "vertex 5 ");
}

TEST(Surface, RefusesAMeshWithoutAnyEdge) {
  EXPECT_PRED2(says, (message_of([] { Surface({}, {}); })), "empty");
  EXPECT_PRED2(says, (message_of([] { Surface({{0, 0, 0}, {1, 1, 1}}, {}); })), "empty");
  EXPECT_PRED2(says, (message_of([] { Surface({{0, 0, 0}, {1, 1, 1}}, {{1, 1, 1}}); })), "empty");
  EXPECT_PRED2(says, (message_of([] { Surface({{0, 0, 0}}, {}, std::vector<Edge>{}); })), "empty");
}

}  // namespace
}  // namespace seamwire
