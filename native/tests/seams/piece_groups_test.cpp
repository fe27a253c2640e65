// SPDX-License-Identifier: GPL-3.0-or-later
#include "seams/prepared_surface.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

#include "seam_problems.hpp"

namespace seamwire {

using namespace detail;

namespace {

/// Two cylinders side by side, at the given places.
shapes::Mesh cylinders(const std::vector<Vector>& places, const std::vector<double>& sizes) {
  shapes::Mesh mesh;
  for (std::size_t i = 0; i < places.size(); ++i) {
    const shapes::Mesh own = shapes::cylinder(12, 4);
    const auto first = static_cast<std::int32_t>(mesh.points.size());
    for (const Vector& point : own.points) mesh.points.push_back(sizes[i] * point + places[i]);
    for (const auto& [a, b, c] : own.triangles) mesh.triangles.push_back({first + a, first + b, first + c});
  }
  return mesh;
}

SlitProblem part_problem(const MeshPart& part) {
  SlitProblem problem;
  problem.mesh = std::make_shared<const PlanMesh>(part.mesh);
  problem.is_seam = part.is_seam;
  problem.prices = find_prices(part.mesh, find_visibility(part.mesh, std::nullopt, {}), std::nullopt, {}, {});
  return problem;
}

TEST(MeshParts, HaveAreaOneAndKnowWhereTheyLie) {
  const Surface surface = cylinders({{0, 0, 0}, {5, 0, 0}}, {1.0, 0.25}).surface();
  const PlanMesh whole = plan_mesh(surface, {});
  const std::vector<std::uint8_t> is_seam(whole.edge_count(), 0);
  MeshParts parts(whole, is_seam, surface.edges());
  const std::vector<PieceGroup> groups = find_groups(whole, is_seam, nullptr, parts, {});
  ASSERT_EQ(groups.size(), 2U);
  for (const PieceGroup& group : groups) {
    const MeshPart part = parts.part(group.faces, {});
    double area = 0.0;
    for (const FaceFrame& frame : face_frames(part.mesh, {})) area += frame.area;
    EXPECT_NEAR(area, 1.0, 1e-12);
    EXPECT_EQ(part.mesh.face_count(), whole.face_count() / 2);
    for (std::size_t v = 0; v < part.vertices.size(); ++v) {
      EXPECT_LT((part.size * part.mesh.points[v] - whole.points[part.vertices[v]]).norm(), 1e-12);
      EXPECT_EQ(part.mesh.sources[v], whole.sources[part.vertices[v]]);
    }
    EXPECT_EQ(find_pieces(part.mesh, part.is_seam, {}).count, 1);
  }
}

TEST(MeshParts, EndAtSeamsToOtherFaces) {
  const Surface surface = shapes::grid(4).surface();
  const PlanMesh whole = plan_mesh(surface, {});
  std::vector<std::uint8_t> is_seam;
  for (const std::int32_t h : whole.half_edge_of) {
    is_seam.push_back(whole.points[whole.tail(h)].x() == whole.points[whole.tip(h)].x() &&
                              std::abs(whole.points[whole.tail(h)].x() - 0.5 * whole.points.back().x()) < 1e-12
                          ? 1
                          : 0);
  }
  MeshParts parts(whole, is_seam, surface.edges());
  const std::vector<PieceGroup> groups = find_groups(whole, is_seam, nullptr, parts, {});
  ASSERT_EQ(groups.size(), 2U);
  const MeshPart part = parts.part(groups.front().faces, {});
  EXPECT_EQ(part.mesh.face_count(), 16U);
  EXPECT_EQ(std::ranges::count(part.mesh.twins, -1), 12);
  EXPECT_EQ(std::ranges::count(part.is_seam, 1), 0);
}

TEST(PieceGroups, KnowTheMirrorImagesOfPieces) {
  const Surface surface = cylinders({{3, 0, 0}, {-3, 0, 0}, {0, 4, 0}, {3, 9, 0}}, {1.0, 1.0, 1.0, 0.3}).surface();
  const PlanMesh whole = plan_mesh(surface, {});
  const std::vector<std::uint8_t> is_seam(whole.edge_count(), 0);
  const std::optional<Reflection> reflection = find_reflection(whole, 0, {});
  ASSERT_TRUE(reflection);
  MeshParts parts(whole, is_seam, surface.edges());
  const std::vector<PieceGroup> groups = find_groups(whole, is_seam, &*reflection, parts, {});
  std::size_t faces = 0, across = 0, lonely = 0;
  for (const PieceGroup& group : groups) {
    faces += group.faces.size() + (group.image ? group.image->faces.size() : 0);
    across += group.reflection && group.faces.size() == whole.face_count() / 4 ? 1 : 0;
    lonely += !group.reflection && !group.image ? 1 : 0;
  }
  EXPECT_EQ(faces, whole.face_count());
  EXPECT_EQ(across, 1U) << "one lies across the plane";
  EXPECT_EQ(lonely, 1U) << "one has no image";
}

TEST(PieceGroups, HaveAnExactImageIfTheTrianglesAreMirrored) {
  shapes::Mesh mesh = shapes::bumpy(shapes::icosphere(2), 0.05);
  const std::size_t count = mesh.points.size(), triangles = mesh.triangles.size();
  for (std::size_t v = 0; v < count; ++v) {
    mesh.points[v].x() += 3.0;
    mesh.points.push_back(mesh.points[v].cwiseProduct(Vector(-1, 1, 1)));
  }
  const auto shift = static_cast<std::int32_t>(count);
  for (std::size_t f = 0; f < triangles; ++f) {
    const auto [a, b, c] = mesh.triangles[f];
    mesh.triangles.push_back({shift + c, shift + b, shift + a});
  }
  const Surface surface = mesh.surface();
  const PlanMesh whole = plan_mesh(surface, {});
  const std::vector<std::uint8_t> is_seam(whole.edge_count(), 0);
  const std::optional<Reflection> reflection = find_reflection(whole, 0, {});
  ASSERT_TRUE(reflection);
  MeshParts parts(whole, is_seam, surface.edges());
  const std::vector<PieceGroup> groups = find_groups(whole, is_seam, &*reflection, parts, {});
  ASSERT_EQ(groups.size(), 1U);
  ASSERT_TRUE(groups[0].image);
  EXPECT_TRUE(groups[0].image->is_mirrored);
  const MeshPart part = parts.part(groups[0].faces, {});
  for (std::size_t v = 0; v < part.vertices.size(); ++v) {
    EXPECT_EQ(groups[0].image->vertices[v], reflection->images[part.vertices[v]]);
  }
}

TEST(PieceGroups, AreAlikeIfOneIsMovedOrScaled) {
  const Surface surface = cylinders({{0, 0, 0}, {90, 40, 7}, {0, 200, 0}, {0, 0, 300}}, {1.0, 1.0, 0.5, 1.0}).surface();
  PlanMesh whole = plan_mesh(surface, {});
  const std::vector<std::uint8_t> is_seam(whole.edge_count(), 0);
  for (std::size_t v = 3 * whole.vertex_count() / 4; v < whole.vertex_count(); ++v) whole.points[v].z() *= 1.001;
  MeshParts parts(whole, is_seam, surface.edges());
  const std::vector<PieceGroup> groups = find_groups(whole, is_seam, nullptr, parts, {});
  ASSERT_EQ(groups.size(), 4U);
  std::vector<SlitProblem> problems;
  for (const PieceGroup& group : groups) problems.push_back(part_problem(parts.part(group.faces, {})));
  for (const std::size_t other : {1U, 2U}) {
    EXPECT_TRUE(are_alike(problems[0], problems[other])) << other;
    EXPECT_EQ(likeness(problems[0]), likeness(problems[other])) << other;
  }
  EXPECT_FALSE(are_alike(problems[0], problems[3])) << "it is longer";
  problems[1].prices.of_edge[3] *= 1.5;
  EXPECT_FALSE(are_alike(problems[0], problems[1])) << "it is seen elsewhere";
}

}  // namespace
}  // namespace seamwire
