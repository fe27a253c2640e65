// SPDX-License-Identifier: GPL-3.0-or-later
#include "parts/smoothed.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "shapes.hpp"

namespace seamwire {
namespace {

using namespace detail;

/// The smoothed shape of quads, and its points in the coordinates of the quads.
struct Made {
  Smoothed shape;
  std::vector<Vector> points;

  explicit Made(const shapes::QuadMesh& quads) {
    const PlanMesh mesh = plan_mesh(quads.surface(), {});
    shape = smoothed(mesh, find_polygons(mesh, {}, {}), {});
    for (const Vector& point : shape.surface->points()) points.emplace_back(point / mesh.scale);
  }

  /// How many corners of triangles are at a point.
  std::size_t corners_at(const Vector& point) const {
    std::size_t count = 0;
    for (const Triangle& triangle : shape.surface->triangles()) {
      for (const std::int32_t v : triangle) count += (points[v] - point).norm() < 1e-12 ? 1 : 0;
    }
    return count;
  }
};

TEST(Smoothed, ACubeBecomesRound) {
  const Made cube(shapes::quad_cube(1));
  EXPECT_EQ(cube.shape.surface->face_count(), 48u);
  EXPECT_EQ(cube.shape.surface->edges().size(), 48u) << "of 24 quads";
  // In a cube from -1 to 1, the rules of Catmull and Clark move a corner to 5/9 and the middle of an edge to 3/4.
  const auto at = [](double x, double y, double z) { return Vector(0.5 + 0.5 * x, 0.5 + 0.5 * y, 0.5 + 0.5 * z); };
  EXPECT_EQ(cube.corners_at(at(5.0 / 9.0, -5.0 / 9.0, 5.0 / 9.0)), 6u);
  EXPECT_EQ(cube.corners_at(at(0.75, 0.0, -0.75)), 4u);
  EXPECT_EQ(cube.corners_at(at(0.0, 1.0, 0.0)), 8u);
  std::array<int, 6> of_polygon{};
  for (const std::int32_t polygon : cube.shape.polygons) ++of_polygon.at(static_cast<std::size_t>(polygon));
  EXPECT_EQ(of_polygon, (std::array<int, 6>{8, 8, 8, 8, 8, 8}));
}

TEST(Smoothed, ABoundaryBecomesASpline) {
  const Made sheet(shapes::quad_grid(1));
  EXPECT_EQ(sheet.shape.surface->report().boundary_edges, 8u);
  EXPECT_EQ(sheet.corners_at({0.125, 0.125, 0.0}), 2u);
  EXPECT_EQ(sheet.corners_at({0.5, 0.0, 0.0}), 2u);
  EXPECT_EQ(sheet.corners_at({0.5, 0.5, 0.0}), 8u);
}

}  // namespace
}  // namespace seamwire
