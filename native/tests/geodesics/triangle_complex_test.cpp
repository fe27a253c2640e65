// SPDX-License-Identifier: GPL-3.0-or-later
//
// Geodesics over edges with three or more faces, and on surfaces that cannot be oriented: what is compared with is
// unfolded by hand, or a double cover.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <numbers>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "embeddings.hpp"
#include "graph/disjoint_sets.hpp"
#include "inserted_point.hpp"
#include "intrinsic.hpp"
#include "paths.hpp"
#include "reference_geodesics.hpp"
#include "seamwire/geodesics/corridor_paths.hpp"
#include "seamwire/geodesics/exact_geodesics.hpp"
#include "shapes.hpp"
#include "surface/corner_fans.hpp"

namespace seamwire {

using namespace detail;

namespace {

using paths::index;
using shapes::Mesh;

/// Relative: sums of some hundred roundings.
constexpr double kExact = 1e-12;

void turn_some_faces(Mesh& mesh, unsigned seed) {
  std::mt19937 random(seed);
  for (Triangle& triangle : mesh.triangles) {
    if (random() % 2U == 0) std::swap(triangle[0], triangle[1]);
  }
}

/// Rectangles of the size 1 x 2, the pages, which share a long side, the spine: x from it, y along it.
struct Book {
  struct Place {
    int page;  ///< -1: on the spine, which all have
    double x, y;
  };
  Mesh mesh;
  std::vector<Place> places;  ///< of the vertices

  Book(int pages, int n, double jitter) {
    std::mt19937 random(static_cast<unsigned>(pages));
    std::uniform_real_distribution<double> move(-jitter / n, jitter / n);
    std::map<std::array<int, 3>, std::int32_t> numbers;
    const auto vertex = [&](int page, int i, int j) {
      const int named = i == 0 ? -1 : page;
      const auto [it, is_new] = numbers.try_emplace({named, i, j}, static_cast<std::int32_t>(places.size()));
      if (is_new) {
        const bool moves = i > 0 && j > 0 && i < n && j < 2 * n;
        const double dx = moves ? move(random) : 0.0, dy = moves ? move(random) : 0.0;
        places.push_back({named, double(i) / n + dx, double(j) / n + dy});
        const double angle = 0.3 + 5.0 * page / pages, x = places.back().x;
        mesh.points.emplace_back(x * std::cos(angle), x * std::sin(angle), places.back().y);
      }
      return it->second;
    };
    for (int page = 0; page < pages; ++page) {
      for (int j = 0; j < 2 * n; ++j) {
        for (int i = 0; i < n; ++i) {
          const std::int32_t a = vertex(page, i, j), b = vertex(page, i + 1, j), c = vertex(page, i + 1, j + 1),
                             d = vertex(page, i, j + 1);
          mesh.triangles.push_back({a, b, c});
          mesh.triangles.push_back({a, c, d});
        }
      }
    }
    turn_some_faces(mesh, static_cast<unsigned>(pages));
  }

  Place place(const SurfacePoint& point) const {
    if (point.vertex >= 0) return places[index(point.vertex)];
    Place sum{-1, 0.0, 0.0};
    for (std::size_t i = 0; i < 3; ++i) {
      const Place& corner = places[index(mesh.triangles[index(point.face)][i])];
      if (corner.page >= 0) sum.page = corner.page;
      sum.x += point.barycentric[i] * corner.x;
      sum.y += point.barycentric[i] * corner.y;
    }
    return sum;
  }
  /// Two pages make a plane: straight.
  double distance(const SurfacePoint& from, const SurfacePoint& to) const {
    const Place a = place(from), b = place(to);
    return std::hypot(a.page == b.page ? a.x - b.x : a.x + b.x, a.y - b.y);
  }
};

/// Points of all kinds, those on edges with three or more faces among them.
std::vector<SurfacePoint> points_of(const IntrinsicMesh& mesh, unsigned seed) {
  std::vector<SurfacePoint> points;
  for (const points::Named& named : points::all_kinds(mesh, seed)) points.push_back(named.point);
  std::mt19937 random(seed);
  for (std::int32_t h = 0; index(h) < mesh.siblings.size(); ++h) {
    if (mesh.siblings[index(h)] < 0 || random() % 16U != 0) continue;
    const double t = points::draw(random, 0.1, 0.9);
    SurfacePoint point;
    point.face = h / 3;
    point.barycentric[index(h % 3)] = 1 - t;
    point.barycentric[index((h % 3 + 1) % 3)] = t;
    points.push_back(point);
  }
  return points;
}

void expect_path(const IntrinsicMesh& mesh, const IntrinsicPath& path, double expected) {
  EXPECT_NEAR(path.length, expected, kExact * (expected + 1));
  EXPECT_NEAR(paths::length_of(mesh, path), expected, kExact * (expected + 1));
}

TEST(TriangleComplexes, PathsOverTheSpineOfABookAreStraightLines) {
  for (const int pages : {2, 3, 4, 7}) {
    SCOPED_TRACE(pages);
    const Book book(pages, 6, 0.3);
    const IntrinsicMesh mesh = shapes::intrinsic(book.mesh);
    ASSERT_EQ(mesh.siblings.empty(), false);
    const ExactGeodesics geodesics(mesh);
    for (const std::int32_t seed : {0, mesh.vertex_count / 2 + 3, mesh.vertex_count - 1}) {
      const DistanceField field = geodesics.solve(seed);
      for (std::int32_t v = 0; v < mesh.vertex_count; ++v) {
        const double expected = book.distance(SurfacePoint(seed), SurfacePoint(v));
        EXPECT_NEAR(field.distances()[index(v)], expected, kExact) << seed << " to " << v;
        expect_path(mesh, field.trace(v).value(), expected);
      }
      for (const SurfacePoint& point : points_of(mesh, 3)) {
        const double expected = book.distance(SurfacePoint(seed), point);
        EXPECT_NEAR(field.distance(point), expected, 1e-11);
        EXPECT_NEAR(paths::length_of(mesh, field.trace(point).value()), expected, 1e-11);
      }
    }
  }
}

/// Splits a vertex on the spine into two at one place, with a needle in each page between the faces below and above.
void split_in_all_pages(Book& book, std::int32_t vertex) {
  const auto added = static_cast<std::int32_t>(book.places.size());
  const Book::Place place = book.places[index(vertex)];
  book.mesh.points.push_back(book.mesh.points[index(vertex)]);
  book.places.push_back(place);
  std::map<std::int32_t, int> below_or_above;  // of a face at the vertex each other corner; a corner of both: 3
  for (Triangle& triangle : book.mesh.triangles) {
    const auto corner = std::ranges::find(triangle, vertex);
    if (corner == triangle.end()) continue;
    double y = 0.0;
    for (const std::int32_t v : triangle) y += book.places[index(v)].y / 3.0;
    for (const std::int32_t v : triangle) below_or_above[v] |= y > place.y ? 1 : 2;
    if (y > place.y) *corner = added;
  }
  for (const auto& [other, sides] : below_or_above) {
    if (other != vertex && sides == 3) book.mesh.triangles.push_back({vertex, other, added});
  }
}

/// Gives one face at the spine another vertex at the place of one on the spine, with a needle on each side.
void split_in_one_face(Book& book, std::size_t face) {
  Triangle& triangle = book.mesh.triangles[face];
  std::ranges::sort(triangle, {}, [&](std::int32_t v) { return book.places[index(v)].x; });
  const auto [vertex, other, apex] = triangle;
  ASSERT_TRUE(book.places[index(other)].page < 0 && book.places[index(apex)].page >= 0);
  const auto added = static_cast<std::int32_t>(book.places.size());
  book.mesh.points.push_back(book.mesh.points[index(vertex)]);
  book.places.push_back(Book::Place(book.places[index(vertex)]));
  triangle[0] = added;
  book.mesh.triangles.push_back({vertex, added, other});
  book.mesh.triangles.push_back({apex, vertex, added});
}

/// Which vertices and faces there are with needles: all of them are removed, and all distances stay.
void expect_no_needle_matters(const Book& book, std::size_t needles) {
  const Surface surface = book.mesh.surface();
  ASSERT_EQ(surface.report().zero_area_faces.size(), needles);
  ASSERT_FALSE(surface.report().nonmanifold_edges.empty());
  const Embedding embedding = embed(surface, embeddings::identity_metric(surface), {.max_error = 0});
  ASSERT_EQ(embedding.invalid_left, 0U);
  EXPECT_EQ(embedding.invalid_before, needles);
  EXPECT_EQ(embedding.mesh.face_count(), book.mesh.triangles.size() - needles);
  const ExactGeodesics geodesics(embedding.mesh);
  for (std::int32_t seed = 0; seed < embedding.mesh.vertex_count; seed += 7) {
    const DistanceField field = geodesics.solve(seed);
    for (std::int32_t v = 0; v < embedding.mesh.vertex_count; ++v) {
      const double expected = book.distance(SurfacePoint(seed), SurfacePoint(v));
      ASSERT_NEAR(field.distances()[index(v)], expected, kExact) << seed << " to " << v;
    }
  }
}

TEST(TriangleComplexes, NeedlesInAllPagesOpenNoSpine) {
  for (const int pages : {3, 4, 5}) {
    Book book(pages, 4, 0.3);
    const std::vector<Book::Place> places = book.places;
    std::size_t splits = 0;
    for (std::int32_t v = 0; index(v) < places.size(); ++v) {
      if (places[index(v)].page >= 0 || places[index(v)].y == 0.0 || places[index(v)].y == 2.0) continue;
      split_in_all_pages(book, v);
      ++splits;
      turn_some_faces(book.mesh, static_cast<unsigned>(v));
      SCOPED_TRACE(std::to_string(pages) + " pages, " + std::to_string(splits) + " vertices");
      expect_no_needle_matters(book, splits * static_cast<std::size_t>(pages));
    }
    EXPECT_EQ(splits, 7U);
  }
}

TEST(TriangleComplexes, NeedlesInOnePageOpenNoSpine) {
  for (const int pages : {3, 4}) {
    Book book(pages, 4, 0.3);
    const std::size_t faces = book.mesh.triangles.size();
    std::size_t splits = 0;
    for (std::size_t f = 0; f < faces; ++f) {
      const auto is_on_spine = [&](std::int32_t v) { return book.places[index(v)].page < 0; };
      if (std::ranges::count_if(book.mesh.triangles[f], is_on_spine) != 2) continue;
      split_in_one_face(book, f);
      ++splits;
      turn_some_faces(book.mesh, static_cast<unsigned>(f));
      SCOPED_TRACE(std::to_string(pages) + " pages, " + std::to_string(splits) + " faces");
      expect_no_needle_matters(book, 2 * splits);
    }
    EXPECT_EQ(splits, 8U * static_cast<std::size_t>(pages));
  }
}

TEST(TriangleComplexes, PathsFromPointsOnAndOffTheSpineOfABookAreStraightLines) {
  const Book book(4, 5, 0.2);
  const IntrinsicMesh mesh = shapes::intrinsic(book.mesh);
  const ExactGeodesics geodesics(mesh);
  const std::vector<SurfacePoint> points = points_of(mesh, 5);
  for (const SurfacePoint& from : points) {
    const DistanceField field = geodesics.solve(std::array{from});
    for (std::int32_t v = 0; v < mesh.vertex_count; ++v) {
      const double expected = book.distance(from, SurfacePoint(v));
      EXPECT_NEAR(field.distances()[index(v)], expected, 1e-11) << v;
      EXPECT_NEAR(paths::length_of(mesh, field.trace(v).value()), expected, 1e-11) << v;
    }
    for (const SurfacePoint& to : points) {
      const double expected = book.distance(from, to);
      EXPECT_NEAR(field.distance(to), expected, 1e-11);
      EXPECT_NEAR(paths::length_of(mesh, field.trace(to).value()), expected, 1e-11);
    }
  }
}

TEST(TriangleComplexes, TheNearestOfSeveralSourcesIsFoundOverTheSpineOfABook) {
  const Book book(3, 5, 0.2);
  const IntrinsicMesh mesh = shapes::intrinsic(book.mesh);
  std::vector<SurfacePoint> sources = points_of(mesh, 9);
  sources.push_back(SurfacePoint(mesh.vertex_count - 1));
  const DistanceField field = ExactGeodesics(mesh).solve(sources);
  for (std::int32_t v = 0; v < mesh.vertex_count; ++v) {
    double expected = reference::kInfinity;
    for (const SurfacePoint& source : sources) {
      expected = std::min(expected, book.distance(source, SurfacePoint(v)));
    }
    EXPECT_NEAR(field.distances()[index(v)], expected, 1e-11);
  }
}

TEST(TriangleComplexes, ASolveThatStopsEarlyKnowsWhatItWasAskedForOverTheSpine) {
  const Book book(3, 12, 0.2);
  const IntrinsicMesh mesh = shapes::intrinsic(book.mesh);
  const ExactGeodesics geodesics(mesh);
  const SurfacePoint seed = SurfacePoint(12), target = SurfacePoint(mesh.vertex_count - 40);
  const DistanceField near = geodesics.solve(std::array{seed}, {.max_distance = 0.7, .targets = {}});
  for (std::int32_t v = 0; v < mesh.vertex_count; ++v) {
    const double expected = book.distance(seed, SurfacePoint(v));
    if (expected < 0.7 - 1e-9) {
      EXPECT_NEAR(near.distances()[index(v)], expected, kExact);
    }
  }
  const DistanceField aimed = geodesics.solve(std::array{seed}, {.targets = {target}});
  EXPECT_NEAR(aimed.distance(target), book.distance(seed, target), kExact);
}

TEST(TriangleComplexes, PathsAtOnceAreRealAndNoShorter) {
  const Book book(3, 12, 0.3);
  const IntrinsicMesh mesh = shapes::intrinsic(book.mesh);
  const ExactGeodesics geodesics(mesh);
  const std::int32_t seed = 30;
  CorridorPaths quick(geodesics, seed), narrow(geodesics, seed, {.corridor_vertices = 30, .windows = 0});
  for (std::int32_t v = 0; v < mesh.vertex_count; v += 5) {
    const double distance = book.distance(SurfacePoint(seed), SurfacePoint(v));
    for (const IntrinsicPath& path : {quick.path(v).value(), narrow.path(v).value()}) {
      EXPECT_NEAR(paths::length_of(mesh, path), path.length, kExact);
      EXPECT_GE(path.length, distance - kExact);
      EXPECT_LE(path.length, 1.1 * distance + kExact);
    }
    EXPECT_LE(quick.path(v)->length, 1.001 * distance + kExact);  // the corridor holds half of the book
  }
  for (const SurfacePoint& point : points_of(mesh, 4)) {
    const IntrinsicPath path = quick.path(point).value();
    EXPECT_NEAR(paths::length_of(mesh, path), path.length, kExact);
    EXPECT_GE(path.length, book.distance(SurfacePoint(seed), point) - 1e-11);
  }
}

TEST(TriangleComplexes, AFlatBookSendsHardlyMoreWindowsThanItsPages) {
  // Where two pages make a plane no path bends on the spine, so its vertices send out next to nothing.
  const auto windows = [](int pages) {
    const ExactGeodesics geodesics(shapes::intrinsic(Book(pages, 24, 0.2).mesh));
    return static_cast<double>(geodesics.solve(24).counters().windows);
  };
  const double two = windows(2), four = windows(4), eight = windows(8);
  EXPECT_LT(four, 2.5 * two);
  EXPECT_LT(eight, 2.5 * four);
}

/// A plane, -1 to 1 in x and y, and a fin of the height 1 on its line x = 0 from y = -1/2 to 1/2.
struct FinOnPlane {
  Mesh mesh;
  int n;

  explicit FinOnPlane(int cells) : n(cells) {
    mesh = shapes::grid(2 * n);
    for (Vector& p : mesh.points) p = 2 * p - Vector(1, 1, 0);
    const auto spine = [&](int j) { return (j + n / 2) * (2 * n + 1) + n; };
    const auto first = static_cast<std::int32_t>(mesh.points.size());
    for (int i = 1; i <= n; ++i) {
      for (int j = 0; j <= n; ++j) mesh.points.emplace_back(0.0, -0.5 + double(j) / n, double(i) / n);
    }
    const auto at = [&](int i, int j) { return i == 0 ? spine(j) : first + (i - 1) * (n + 1) + j; };
    for (int i = 0; i < n; ++i) {
      for (int j = 0; j < n; ++j) {
        mesh.triangles.push_back({at(i, j), at(i, j + 1), at(i + 1, j + 1)});
        mesh.triangles.push_back({at(i, j), at(i + 1, j + 1), at(i + 1, j)});
      }
    }
  }
  static double distance(const Vector& a, const Vector& b) {
    const bool is_on_fin_a = a.z() > 0, is_on_fin_b = b.z() > 0;
    if (is_on_fin_a == is_on_fin_b) return (a - b).norm();
    const Vector &fin = is_on_fin_a ? a : b, &plane = is_on_fin_a ? b : a;
    // Unfolded, straight over the spine, or over one of its ends.
    const double through = fin.z(), aside = std::abs(plane.x());
    const double y = through + aside > 0 ? fin.y() + (plane.y() - fin.y()) * through / (through + aside) : fin.y();
    const Vector over(0, std::clamp(y, -0.5, 0.5), 0);
    return (fin - over).norm() + (plane - over).norm();
  }
};

TEST(TriangleComplexes, PathsRunUpAFinAndThePlaneBelowItIsAPlane) {
  const FinOnPlane shape(6);
  const IntrinsicMesh mesh = shapes::intrinsic(shape.mesh);
  const ExactGeodesics geodesics(mesh);
  for (std::int32_t seed = 0; seed < mesh.vertex_count; seed += 7) {
    const DistanceField field = geodesics.solve(seed);
    for (std::int32_t v = 0; v < mesh.vertex_count; ++v) {
      const double expected = FinOnPlane::distance(shape.mesh.points[index(seed)], shape.mesh.points[index(v)]);
      EXPECT_NEAR(field.distances()[index(v)], expected, kExact * 2) << seed << " to " << v;
      expect_path(mesh, field.trace(v).value(), expected);
    }
  }
}

TEST(TriangleComplexes, PathsOverAFloorWithinATubeAreStraight) {
  // A prism of 16 sides with a floor of triangles around its axis: from the axis to the wall above and below.
  Mesh mesh = shapes::cylinder(16, 8, 0.5, 2.0);
  const auto center = static_cast<std::int32_t>(mesh.points.size());
  mesh.points.emplace_back(0, 0, 1);
  for (int i = 0; i < 16; ++i) mesh.triangles.push_back({4 * 16 + i, 4 * 16 + (i + 1) % 16, center});
  const IntrinsicMesh complex = shapes::intrinsic(mesh);
  const DistanceField field = ExactGeodesics(complex).solve(center);
  const reference::Geodesics reference(complex);
  const std::vector<double> expected = reference.distances(center);
  for (std::int32_t v = 0; v < complex.vertex_count; ++v) {
    const Vector& p = mesh.points[index(v)];
    if (v != center) {
      const double side = 0.5 * std::sin(std::numbers::pi / 16), deep = 0.5 * std::cos(std::numbers::pi / 16);
      EXPECT_NEAR(field.distances()[index(v)], std::hypot(side, deep + std::abs(p.z() - 1)), kExact);
    }
    EXPECT_NEAR(field.distances()[index(v)], expected[index(v)], kExact);
    expect_path(complex, field.trace(v).value(), field.distances()[index(v)]);
  }
  // From a vertex of the floor's rim to the opposite one: through the floor, not around.
  const DistanceField from_rim = ExactGeodesics(complex).solve(4 * 16);
  EXPECT_NEAR(from_rim.distances()[4 * 16 + 8], 1.0, kExact);
}

/// The oriented double cover of a surface: each face twice, as it is and turned over. Returns the vertices of the cover
/// over each corner of the faces, first those of faces as they are.
struct DoubleCover {
  IntrinsicMesh mesh;
  std::vector<std::vector<std::int32_t>> over;  ///< per vertex: both above it

  explicit DoubleCover(const IntrinsicMesh& below) : over(index(below.vertex_count)) {
    const auto faces = static_cast<std::int32_t>(below.face_count());
    // Half-edge 3 f + i of a face turned over has the number 3 (f + faces) + (2 - i).
    const auto turned = [&](std::int32_t h) { return 3 * (h / 3 + faces) + 2 - h % 3; };
    const auto count = static_cast<std::size_t>(6 * faces);
    std::vector<std::int32_t> tail(count);
    mesh.twins.assign(count, -1);
    mesh.lengths.assign(count, 0.0);
    for (std::int32_t h = 0; h < 3 * faces; ++h) {
      tail[index(h)] = below.tail(h);
      tail[index(turned(h))] = below.tip(h);
      mesh.lengths[index(h)] = mesh.lengths[index(turned(h))] = below.lengths[index(h)];
      paths::for_each_beyond(below, h, [&](std::int32_t other) {
        const bool is_alike = below.tail(h) == below.tip(other);
        mesh.twins[index(h)] = is_alike ? other : turned(other);
        mesh.twins[index(turned(h))] = is_alike ? turned(other) : other;
      });
    }
    const auto next = [](std::int32_t h) { return h % 3 == 2 ? h - 2 : h + 1; };
    detail::DisjointSets corners(count);  // named by the half-edge that begins there
    for (std::int32_t h = 0; index(h) < count; ++h) {
      if (mesh.twins[index(h)] >= 0) corners.join(h, next(mesh.twins[index(h)]));
    }
    std::vector<std::int32_t> number(count, -1);
    mesh.triangles.resize(index(2 * faces));
    for (std::int32_t h = 0; index(h) < count; ++h) {
      std::int32_t& vertex = number[index(corners.find(h))];
      if (vertex < 0) {
        vertex = mesh.vertex_count++;
        over[index(tail[index(h)])].push_back(vertex);
      }
      mesh.triangles[index(h / 3)][index(h % 3)] = vertex;
    }
  }
};

/// A grid of nu x nv cells. A Klein bottle is closed in u, and in v with a reversal of u. A Moebius strip is not closed
/// in v, and closed in u with a reversal of v.
Mesh one_sided(int nu, int nv, bool is_klein) {
  Mesh mesh;
  const auto at = [&](int i, int j) {
    if (is_klein) {
      if (j == nv) i = nu - i, j = 0;
      return j * nu + (i + nu) % nu;
    }
    if (i == nu) i = 0, j = nv - j;
    return j * nu + i;
  };
  mesh.points.resize(static_cast<std::size_t>(nu * (is_klein ? nv : nv + 1)), Vector::Zero());
  for (int j = 0; j < nv; ++j) {
    for (int i = 0; i < nu; ++i) {
      mesh.triangles.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
      mesh.triangles.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
    }
  }
  return mesh;
}

TEST(TriangleComplexes, DistancesOnOneSidedSurfacesAreThoseOnTheirDoubleCover) {
  std::mt19937 random(11);
  std::vector<std::pair<std::string, IntrinsicMesh>> meshes;
  meshes.emplace_back("Moebius strip in space", shapes::intrinsic(shapes::moebius(24)));
  for (const bool is_klein : {false, true}) {
    Mesh mesh = one_sided(9, 6, is_klein);
    for (const bool turns : {false, true}) {
      if (turns) turn_some_faces(mesh, 5);
      // Lengths between 1 and 2 make triangles, but no surface in space.
      meshes.emplace_back(is_klein ? "Klein bottle" : "Moebius strip",
                          shapes::intrinsic(mesh, [&](int, int) { return points::draw(random, 1.01, 2.0); }));
    }
  }
  for (const auto& [name, mesh] : meshes) {
    SCOPED_TRACE(name);
    ASSERT_FALSE(mesh.siblings.empty());
    const DoubleCover cover(mesh);
    ASSERT_TRUE(std::ranges::all_of(cover.over, [](const auto& above) { return above.size() == 2; }));
    const ExactGeodesics geodesics(mesh), above(cover.mesh);
    for (std::int32_t seed = 0; seed < mesh.vertex_count; ++seed) {
      const DistanceField field = geodesics.solve(seed), expected = above.solve(cover.over[index(seed)][0]);
      for (std::int32_t v = 0; v < mesh.vertex_count; ++v) {
        const auto& over = cover.over[index(v)];
        const double distance = std::min(expected.distances()[index(over[0])], expected.distances()[index(over[1])]);
        EXPECT_NEAR(field.distances()[index(v)], distance, kExact * (distance + 1)) << seed << " to " << v;
        if (seed % 7 == 0) expect_path(mesh, field.trace(v).value(), distance);
      }
    }
  }
}

TEST(TriangleComplexes, WindowsDoNotMultiplyAroundNeedles) {
  // Most triangles meet at the vertex 4, which is far away.
  const Mesh mesh{{{-0.046875, 1.53125, 1.703125},
                   {-1.453125, -0.734375, 0.421875},
                   {-0.328125, 1.796875, 0.8125},
                   {0.109375, -1.578125, -0.203125},
                   {1.78125, 1000, 0.1875},
                   {-1.03125, -1.28125, 1.109375},
                   {1.4375, 0.890625, 1.25},
                   {-0.25, 1.28125, -1.65625}},
                  {{6, 7, 0},
                   {4, 5, 6},
                   {4, 2, 3},
                   {7, 6, 4},
                   {4, 0, 7},
                   {1, 2, 4},
                   {6, 0, 4},
                   {6, 1, 4},
                   {7, 3, 6},
                   {0, 1, 4},
                   {5, 0, 6},
                   {5, 4, 1},
                   {4, 6, 3},
                   {4, 7, 3},
                   {4, 1, 3},
                   {3, 5, 7}}};
  const IntrinsicMesh complex = shapes::intrinsic(mesh);
  for (std::int32_t seed = 0; seed < complex.vertex_count; ++seed) {
    const ExactField field = ExactGeodesics(complex).solve(seed);
    EXPECT_LT(field.counters().windows, 20000U);
    for (std::int32_t v = 0; v < complex.vertex_count; ++v) {
      const double distance = field.distances()[index(v)];
      EXPECT_NEAR(field.trace(v)->length, distance, 1e-9 * (1 + distance));
    }
  }
}

TEST(TriangleComplexes, ATieAtTheEndOfAnEdgeIsNoCrossingWithinIt) {
  // Vertices 0, 1, 2, 3 are in line: over a fin and straight it is equally far to 3, but for rounding.
  Mesh mesh{
      {{2, 0, 0},
       {3, 0, 0.25},
       {4, 0, 0.5},
       {5, 0, 0.75},
       {0.61803398874989446, -1.9021130325903073, 0},
       {0.92705098312484169, -2.8531695488854609, 0},
       {1.2360679774997889, -3.8042260651806146, 0},
       {1.5450849718747373, 4.7552825814757673, 0},
       {0.6180339887498949, 1.9021130325903071, 0},
       {1.5450849718747361, -4.7552825814757682, 0.75},
       {3.625, 1.640625, 1.375}},
      {{2, 7, 3}, {3, 8, 0}, {4, 0, 3}, {4, 3, 5}, {5, 3, 2}, {5, 2, 6}, {6, 2, 1}, {9, 1, 0}, {3, 2, 8}, {3, 0, 10}}};
  const Surface surface = mesh.surface();
  for (const double scale : {1.0, surface.scale(), 0.1, 1.0 / 3.0}) {
    const IntrinsicMesh complex = shapes::intrinsic(mesh, Eigen::Matrix3d(scale * Eigen::Matrix3d::Identity()));
    const ExactGeodesics geodesics(complex);
    const reference::Geodesics reference(complex);
    for (std::int32_t seed = 0; seed < complex.vertex_count; ++seed) {
      const std::vector<double> found = geodesics.solve(seed).distances(), expected = reference.distances(seed);
      for (std::size_t v = 0; v < found.size(); ++v) EXPECT_NEAR(found[v], expected[v], kExact * 10);
    }
  }
}

TEST(TriangleComplexes, ASurfaceNamesTheSiblingsThatGeodesicsNeed) {
  // By the surface's own half-edges, whose faces are turned to agree as far as they can.
  for (Mesh mesh : {Book(3, 4, 0.2).mesh, shapes::moebius(15), FinOnPlane(4).mesh}) {
    turn_some_faces(mesh, 2);
    const Surface surface = mesh.surface();
    IntrinsicMesh own;
    own.vertex_count = static_cast<std::int32_t>(surface.vertex_count());
    own.twins = corner_fans(surface).twins;
    own.siblings = corner_fans(surface).siblings;
    for (const Triangle& fans : corner_fans(surface).triangles) {
      const auto vertex = [&](std::size_t i) { return corner_fans(surface).vertices[index(fans[i % 3])]; };
      own.triangles.push_back({vertex(0), vertex(1), vertex(2)});
      for (std::size_t i = 0; i < 3; ++i) {
        const Vector &a = mesh.points[index(vertex(i))], &b = mesh.points[index(vertex(i + 1))];
        own.lengths.push_back(vertex(i) < vertex(i + 1) ? (a - b).norm() : (b - a).norm());
      }
    }
    const std::vector<double> found = ExactGeodesics(own).solve(1).distances();
    const std::vector<double> expected = ExactGeodesics(shapes::intrinsic(mesh)).solve(1).distances();
    for (std::size_t v = 0; v < found.size(); ++v) EXPECT_NEAR(found[v], expected[v], kExact);
  }
}

TEST(TriangleComplexes, SiblingsThatAreNoneAreRefused) {
  const IntrinsicMesh good = shapes::intrinsic(Book(3, 1, 0.0).mesh);
  EXPECT_NO_THROW(ExactGeodesics{good});
  const auto refused = [](IntrinsicMesh mesh, const std::string& message) {
    try {
      const ExactGeodesics geodesics(mesh);
      ADD_FAILURE() << "not refused: " << message;
    } catch (const InvalidInput& error) {
      EXPECT_NE(std::string(error.what()).find(message), std::string::npos) << error.what();
    }
  };
  const auto some = std::ranges::find_if(good.siblings, [](std::int32_t h) { return h >= 0; });
  const auto h = static_cast<std::size_t>(some - good.siblings.begin());
  const auto changed = [&](const auto& change) {
    IntrinsicMesh mesh = good;
    change(mesh);
    return mesh;
  };
  refused(changed([](IntrinsicMesh& m) { m.siblings.pop_back(); }), "3 entries a triangle");
  refused(changed([&](IntrinsicMesh& m) { m.siblings[h] = 1000; }), "is not in a cycle with it");
  refused(changed([&](IntrinsicMesh& m) { m.siblings[h] = static_cast<std::int32_t>(h); }),
          "is not in a cycle with it");
  refused(changed([&](IntrinsicMesh& m) { m.siblings[h] = -1; }), "is not in a cycle with it");
  refused(changed([&](IntrinsicMesh& m) { m.lengths[h] *= 1 + 1e-9; }), "long, its sibling");
  const auto twin = std::ranges::find_if(good.twins, [](std::int32_t t) { return t >= 0; }) - good.twins.begin();
  refused(changed([&](IntrinsicMesh& m) { m.siblings[static_cast<std::size_t>(twin)] = m.siblings[h]; }),
          "it has a twin and a sibling");
}

}  // namespace
}  // namespace seamwire
