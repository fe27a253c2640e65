// SPDX-License-Identifier: GPL-3.0-or-later
#include "prices/plan_mesh.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <stop_token>
#include <vector>

#include "shapes.hpp"

namespace seamwire {

using namespace detail;

namespace {

PlanMesh moved(shapes::Mesh mesh, const Vector& by) {
  for (Vector& point : mesh.points) point += by;
  return plan_mesh(mesh.surface(), {});
}

TEST(Reflection, OfASymmetricMeshIsExact) {
  const PlanMesh mesh = plan_mesh(shapes::dumbbell(12, 20).surface(), {});
  const std::optional<Reflection> found = find_reflection(mesh, 0, {});
  ASSERT_TRUE(found);
  EXPECT_TRUE(found->is_exact);
  for (std::size_t v = 0; v < mesh.vertex_count(); ++v) {
    const std::int32_t image = found->images[v];
    ASSERT_GE(image, 0);
    EXPECT_LT((mesh.points[image] - found->mirrored(mesh.points[v])).norm(), 1e-12);
    EXPECT_EQ(found->images[image], static_cast<std::int32_t>(v));
    EXPECT_EQ(found->sides[v], -found->sides[image]);
    EXPECT_EQ(found->sides[v] == 0, std::abs(mesh.points[v].x()) < 1e-12);
  }
}

TEST(Reflection, OfASymmetricShapeWithOtherTrianglesIsNotExact) {
  shapes::Mesh ball = shapes::icosphere(3);
  for (Vector& point : ball.points) point = Eigen::AngleAxisd(0.4, Vector(1, 2, 3).normalized()) * point;
  const std::optional<Reflection> found = find_reflection(plan_mesh(ball.surface(), {}), 0, {});
  ASSERT_TRUE(found);
  EXPECT_FALSE(found->is_exact);
}

TEST(Reflection, IsInTheMiddleOfAShapeThatIsNotAtTheOrigin) {
  for (const double far : {2.0, 1e5}) {
    const PlanMesh mesh = moved(shapes::icosphere(2), {far, 0, 0});
    const std::optional<Reflection> found = find_reflection(mesh, 0, {});
    ASSERT_TRUE(found);
    EXPECT_NEAR(found->offset, mesh.scale * far, 1e-6);
    EXPECT_TRUE(found->is_exact);
    EXPECT_EQ(find_reflection(mesh, 1, {})->offset, 0.0);
  }
  // The cells of far points have numbers that no integer holds.
  EXPECT_NO_THROW(find_reflection(moved(shapes::icosphere(2), {1e25, 0, 0}), 0, {}));
}

TEST(Reflection, DoesNotExistForAShapeWithoutSymmetry) {
  shapes::Mesh mesh = shapes::dumbbell(12, 20);
  for (Vector& point : mesh.points) point.y() += 0.4 * point.x() * point.x() * (point.x() > 0.0 ? 1.0 : 0.0);
  EXPECT_FALSE(find_reflection(plan_mesh(mesh.surface(), {}), 0, {}));
  EXPECT_FALSE(find_reflection(plan_mesh(mesh.surface(), {}), 1, {}));
  EXPECT_TRUE(find_reflection(plan_mesh(mesh.surface(), {}), 2, {}));
}

TEST(Reflection, DoesNotExistWithoutVertices) { EXPECT_FALSE(find_reflection({}, 0, {})); }

TEST(Reflection, SurvivesAnotherSmallPart) {
  // An eye patch: 5 % of the area has no image.
  shapes::Mesh mesh = shapes::dumbbell(12, 20);
  const auto first = static_cast<std::int32_t>(mesh.points.size());
  for (const Vector& point : {Vector(1.5, 0, 0), Vector(1.8, 0, 0), Vector(1.5, 0.3, 0)}) mesh.points.push_back(point);
  mesh.triangles.push_back({first, first + 1, first + 2});
  const std::optional<Reflection> found = find_reflection(plan_mesh(mesh.surface(), {}), 0, {});
  ASSERT_TRUE(found);
  EXPECT_EQ(found->images[first], -1);
  EXPECT_TRUE(found->is_exact);
}

TEST(Reflection, CanBeCancelled) {
  const PlanMesh mesh = plan_mesh(shapes::dumbbell(12, 20).surface(), {});
  std::stop_source stop;
  stop.request_stop();
  EXPECT_THROW(find_reflection(mesh, 0, {.stop = stop.get_token(), .progress = {}}), Cancelled);
}

}  // namespace
}  // namespace seamwire
