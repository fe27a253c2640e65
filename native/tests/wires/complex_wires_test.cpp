// SPDX-License-Identifier: GPL-3.0-or-later
//
// Wires over edges with three or more faces, and on one-sided surfaces.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <vector>

#include "seamwire/geodesics/exact_geodesics.hpp"
#include "seamwire/wires/bent_wires.hpp"
#include "seamwire/wires/closed_wires.hpp"
#include "seamwire/wires/embedded_points.hpp"
#include "seamwire/wires/plane_section.hpp"
#include "seamwire/wires/snap.hpp"
#include "seamwire/wires/wire.hpp"
#include "shapes.hpp"
#include "surface/corner_fans.hpp"
#include "unowned.hpp"

namespace seamwire {
namespace {

using shapes::Mesh;

std::size_t index(std::int32_t i) { return static_cast<std::size_t>(i); }

/// A surface with its own lengths, as an embedding.
Embedding as_it_is(const Surface& surface) {
  Embedding out;
  out.points = surface.points();
  out.source_face = detail::corner_fans(surface).faces;
  out.mesh.vertex_count = static_cast<std::int32_t>(surface.vertex_count());
  out.mesh.twins = detail::corner_fans(surface).twins;
  out.mesh.siblings = detail::corner_fans(surface).siblings;
  for (const Triangle& fans : detail::corner_fans(surface).triangles) {
    const auto vertex = [&](std::size_t i) { return detail::corner_fans(surface).vertices[index(fans[i % 3])]; };
    out.mesh.triangles.push_back({vertex(0), vertex(1), vertex(2)});
    for (std::size_t i = 0; i < 3; ++i) {
      const auto [a, b] = std::minmax({vertex(i), vertex(i + 1)});
      out.mesh.lengths.push_back((out.points[index(a)] - out.points[index(b)]).norm());
    }
  }
  return out;
}

struct Solved {
  explicit Solved(const Mesh& mesh) : surface(mesh.surface()), embedding(as_it_is(surface)), solver(embedding.mesh) {}

  std::vector<ClosedWire> loops(std::int32_t seed, std::size_t count = 3) const {
    return closed_wires(surface, embedding, solver.solve(seed), count);
  }

  Surface surface;
  Embedding embedding;
  ExactGeodesics solver;
};

void add(Mesh& mesh, const Mesh& other) {
  const auto start = static_cast<std::int32_t>(mesh.points.size());
  mesh.points.insert(mesh.points.end(), other.points.begin(), other.points.end());
  for (const auto& [a, b, c] : other.triangles) mesh.triangles.push_back({a + start, b + start, c + start});
}

/// Vertices at the same place become one.
Mesh welded(const Mesh& mesh) {
  Mesh out;
  std::vector<std::int32_t> number;
  for (const Vector& p : mesh.points) {
    const auto same = std::ranges::find_if(out.points, [&](const Vector& q) { return (p - q).norm() < 1e-9; });
    number.push_back(static_cast<std::int32_t>(same - out.points.begin()));
    if (same == out.points.end()) out.points.push_back(p);
  }
  for (const auto& [a, b, c] : mesh.triangles)
    out.triangles.push_back({number[index(a)], number[index(b)], number[index(c)]});
  return out;
}

/// n x n cells between four corners.
Mesh sheet(int n, const Vector& a, const Vector& b, const Vector& c, const Vector& d) {
  return shapes::parametric(n, n, false, false, [&](double u, double v) {
    return Vector((1 - v) * ((1 - u) * a + u * b) + v * ((1 - u) * d + u * c));
  });
}

/// Three unit squares that share the edge from (0, 0, 0) to (0, 0, 1).
Mesh book(int n) {
  Mesh mesh;
  for (const double angle : {0.0, 2.0, 4.0}) {
    const Vector out(std::cos(angle), std::sin(angle), 0), up(0, 0, 1);
    add(mesh, sheet(n, Vector::Zero(), out, out + up, up));
  }
  return welded(mesh);
}

std::int32_t vertex_at(const Mesh& mesh, const Vector& place) {
  const auto nearest = std::ranges::min_element(mesh.points, {}, [&](const Vector& p) { return (p - place).norm(); });
  return static_cast<std::int32_t>(nearest - mesh.points.begin());
}

Vector on_page(double angle, double x, double z) { return {x * std::cos(angle), x * std::sin(angle), z}; }

TEST(ComplexWires, AWireCrossesTheSpineOfABookStraight) {
  const Mesh mesh = book(8);
  const Solved solved(mesh);
  const std::int32_t from = vertex_at(mesh, on_page(0, 0.5, 0)), to = vertex_at(mesh, on_page(2, 0.75, 1));
  const Wire wire = trace_wire(solved.surface, solved.embedding, solved.solver.solve(from), to).value();
  EXPECT_NEAR(wire.length, std::hypot(1.25, 1.0), 1e-12);
  EXPECT_NEAR(wire.euclidean_length, wire.length, 1e-12);
  // It crosses the spine once, at the height of a straight line.
  const auto on_spine = [](const Vector& p) { return std::hypot(p.x(), p.y()) < 1e-9; };
  EXPECT_EQ(std::ranges::count_if(wire.points, on_spine), 1);
  EXPECT_NEAR(std::ranges::find_if(wire.points, on_spine)->z(), 0.4, 1e-12);
  // And each segment lies in its face.
  for (std::size_t i = 0; i < wire.faces.size(); ++i) {
    const auto& [a, b, c] = mesh.triangles[index(wire.faces[i])];
    const Vector normal =
        (mesh.points[index(b)] - mesh.points[index(a)]).cross(mesh.points[index(c)] - mesh.points[index(a)]);
    for (const Vector& p : {wire.points[i], wire.points[i + 1]}) {
      EXPECT_NEAR(normal.normalized().dot(p - mesh.points[index(a)]), 0.0, 1e-12);
    }
  }
  const std::vector<std::int32_t> chain = snap_to_edges(solved.surface, wire);
  ASSERT_GT(chain.size(), 2U);
  EXPECT_EQ(chain.front(), from);
  EXPECT_EQ(chain.back(), to);
}

TEST(ComplexWires, APointOnTheSpineIsReachedFromEachPage) {
  const Mesh mesh = book(4);
  const Solved solved(mesh);
  const EmbeddedPoints points(unowned(solved.surface), unowned(solved.embedding));
  for (std::int32_t f = 0; index(f) < mesh.triangles.size(); ++f) {
    for (std::size_t i = 0; i < 3; ++i) {
      const Vector &a = mesh.points[index(mesh.triangles[index(f)][i])],
                   &b = mesh.points[index(mesh.triangles[index(f)][(i + 1) % 3])];
      if (std::hypot(a.x(), a.y()) > 1e-9 || std::hypot(b.x(), b.y()) > 1e-9) continue;
      SurfacePoint point;
      point.face = f;
      point.barycentric[i] = 0.25;
      point.barycentric[(i + 1) % 3] = 0.75;
      const std::optional<SurfacePoint> found = points.find(point);
      ASSERT_TRUE(found);
      for (const double angle : {0.0, 2.0, 4.0}) {
        const Vector place = on_page(angle, 0.5, 0.25);
        const double expected = (0.25 * a + 0.75 * b - place).norm();
        EXPECT_NEAR(solved.solver.solve(vertex_at(mesh, place)).distance(*found), expected, 1e-12);
      }
    }
  }
}

TEST(ComplexWires, APlaneSectionForksAtTheSpine) {
  const Mesh mesh = book(6);
  const Surface surface = mesh.surface();
  for (const double angle : {2.0, 4.0}) {
    const std::int32_t from = vertex_at(mesh, on_page(0, 0.5, 0.5)), to = vertex_at(mesh, on_page(angle, 1, 0.5));
    const PlaneSection section = plane_section(surface, SurfacePoint(from), SurfacePoint(to), Vector(0.01, 0, 0.005));
    ASSERT_FALSE(section.points.empty());
    EXPECT_EQ(section.points.back(), mesh.points[index(to)]);
    EXPECT_GE(section.length, 1.5 - 1e-12);
    EXPECT_LE(section.length, 2.0);
  }
}

/// A tube about the z axis from z = -1 to 1, narrow in the middle.
Mesh hourglass(int n) {
  Mesh mesh = shapes::cylinder(n, n, 1.0, 2.0);
  for (Vector& p : mesh.points) {
    p.z() -= 1;
    const double radius = 0.1 + 0.4 * p.z() * p.z();
    p.x() *= radius;
    p.y() *= radius;
  }
  return mesh;
}

TEST(ComplexWires, AClosedCutAroundATubeSeparatesUnlessAnotherSheetJoinsItsSides) {
  const int n = 24;
  const Mesh tube = hourglass(n);
  const std::int32_t seed = n / 2 * n;  // at the waist
  const std::vector<ClosedWire> around = Solved(tube).loops(seed);
  ASSERT_FALSE(around.empty());
  EXPECT_TRUE(around.front().separates);

  // A fin on one side.
  Mesh with_fin = tube;
  const Vector a = tube.points[8], b = tube.points[index(n + 8)];
  const auto outwards = [](const Vector& p) { return Vector(1.5 * p.x(), 1.5 * p.y(), p.z()); };
  add(with_fin, sheet(1, a, b, outwards(b), outwards(a)));
  with_fin = welded(with_fin);
  const std::vector<ClosedWire> past_fin = Solved(with_fin).loops(seed);
  ASSERT_FALSE(past_fin.empty());
  EXPECT_TRUE(past_fin.front().separates);
  EXPECT_NEAR(past_fin.front().wire.length, around.front().wire.length, 0.05 * around.front().wire.length);

  // A handle of a sheet from one end to the other: the tube is still in one piece.
  Mesh with_handle = tube;
  const Vector c = tube.points[index(n * n + 8)], d = tube.points[index(n * (n - 1) + 8)];
  add(with_handle, sheet(1, a, b, d, c));
  with_handle = welded(with_handle);
  const std::vector<ClosedWire> past_handle = Solved(with_handle).loops(seed);
  ASSERT_FALSE(past_handle.empty());
  EXPECT_FALSE(past_handle.front().separates);
}

TEST(ComplexWires, TheCutAroundAMoebiusStripDoesNotSeparateIt) {
  const Mesh mesh = shapes::moebius(40);
  const Solved solved(mesh);
  const std::vector<ClosedWire> loops = solved.loops(20);
  ASSERT_FALSE(loops.empty());
  for (const ClosedWire& loop : loops) {
    EXPECT_FALSE(loop.separates);
    EXPECT_EQ(loop.wire.points.front(), loop.wire.points.back());
  }
}

TEST(ComplexWires, ABentCutPassesEdgesOfThreeFaces) {
  const int n = 24;
  Mesh mesh = hourglass(n);
  // A disc within the waist: every cut around the tube crosses or follows its rim.
  const auto center = static_cast<std::int32_t>(mesh.points.size());
  mesh.points.emplace_back(0, 0, 0);
  for (int i = 0; i < n; ++i) mesh.triangles.push_back({n / 2 * n + i, n / 2 * n + (i + 1) % n, center});
  const Solved solved(mesh);
  const std::int32_t seed = (n / 2 + 2) * n, second = (n / 2 - 2) * n + n / 2;
  const DistanceField field = solved.solver.solve(seed);
  for (const ClosedWire& loop : closed_wires(solved.surface, solved.embedding, field)) {
    const BentWires bent(unowned(solved.surface), unowned(solved.embedding), solved.solver, field, loop);
    const std::optional<BentWire> wire = bent.through(SurfacePoint(second));
    if (!wire) continue;
    EXPECT_EQ(wire->there.points.back(), wire->back.points.front());
    EXPECT_EQ(wire->back.points.back(), wire->there.points.front());
    EXPECT_GE(wire->there.length, field.distances()[index(second)] - 1e-12);
    EXPECT_GE(wire->back.length, field.distances()[index(second)] - 1e-12);
  }
}

}  // namespace
}  // namespace seamwire
