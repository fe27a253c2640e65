// SPDX-License-Identifier: GPL-3.0-or-later
#include "seamwire_uv/parts/scanned_edges.hpp"

#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "seamwire/errors.hpp"
#include "shapes.hpp"

namespace seamwire {
namespace {

bool is_scanned(const shapes::Mesh& mesh) { return has_scanned_edges(mesh.points, mesh.triangles); }

TEST(ScannedEdges, FollowNothingOnANoisyBall) {
  EXPECT_TRUE(is_scanned(shapes::bumpy(shapes::icosphere(4), 0.02)));
  EXPECT_FALSE(is_scanned(shapes::bumpy(shapes::icosphere(3), 0.02))) << "too few triangles";
}

TEST(ScannedEdges, AreFoundInPartsOfLargeMeshes) {
  EXPECT_TRUE(is_scanned(shapes::bumpy(shapes::icosphere(6), 0.005)));
  EXPECT_FALSE(is_scanned(shapes::torus(400, 200)));
}

TEST(ScannedEdges, AreNotThoseOfRevolvedShapes) {
  EXPECT_FALSE(is_scanned(shapes::cylinder(40, 40)));
  EXPECT_FALSE(is_scanned(shapes::torus(60, 30)));
  EXPECT_FALSE(is_scanned(shapes::grid(40))) << "nothing bends";
}

TEST(ScannedEdges, AreNotThoseOfQuads) {
  const shapes::Mesh mesh = shapes::bumpy(shapes::icosphere(4), 0.02);
  std::vector<std::int32_t> polygons;
  for (std::size_t f = 0; f < mesh.triangles.size(); ++f) polygons.push_back(static_cast<std::int32_t>(f / 2));
  EXPECT_FALSE(has_scanned_edges(mesh.points, mesh.triangles, polygons));
}

TEST(ScannedEdges, AreFewInMeshesWithoutNeighborsOrArea) {
  shapes::Mesh apart;
  for (std::int32_t v = 0; v < 9000; ++v)
    apart.points.push_back({v % 3 == 1 ? 1.0 : 0.0, v % 3 == 2 ? 1.0 : 0.0, v / 3.0});
  for (std::int32_t v = 0; v < 9000; v += 3) apart.triangles.push_back({v, v + 1, v + 2});
  EXPECT_FALSE(is_scanned(apart));
  for (Vector& point : apart.points) point.setZero();
  EXPECT_FALSE(is_scanned(apart));
}

TEST(ScannedEdges, RefusesWhatDoesNotFit) {
  const shapes::Mesh mesh = shapes::grid(4);
  EXPECT_THROW(has_scanned_edges(mesh.points, mesh.triangles, std::vector<std::int32_t>{0}), InvalidInput);
  EXPECT_THROW(has_scanned_edges(std::span(mesh.points).first(3), mesh.triangles), InvalidInput);
}

}  // namespace
}  // namespace seamwire
