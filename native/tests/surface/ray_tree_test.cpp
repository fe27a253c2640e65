// SPDX-License-Identifier: GPL-3.0-or-later
#include "seamwire/surface/ray_tree.hpp"

#include <gtest/gtest.h>

#include <deque>
#include <limits>
#include <random>
#include <stop_token>

#include "shapes.hpp"

namespace seamwire {
namespace {

TEST(Rays, meet_a_sphere_at_its_near_side) {
  const shapes::Mesh mesh = shapes::icosphere(4, 0.5);
  const RayTree tree(mesh.points, mesh.triangles);
  tree.wait();
  for (const Vector& p : mesh.points) {
    const RayHit hit = tree.first_hit(3.0 * p, -p);
    ASSERT_GE(hit.triangle, 0);
    EXPECT_NEAR(hit.distance, 2.0, 1e-12);
  }
  EXPECT_EQ(tree.first_hit({0, 0, 3}, {0, 0, 1}).triangle, -1) << "it lies behind";
  EXPECT_EQ(tree.first_hit({0.6, 0, 3}, {0, 0, -1}).triangle, -1) << "beside it";
  EXPECT_NEAR(tree.first_hit({0, 0, 0}, {0, 0, 1}).distance, 0.5, 1e-2) << "from inside, the far side of a face";
}

TEST(Rays, waiting_for_the_tree_can_be_cancelled) {
  const shapes::Mesh mesh = shapes::icosphere(2);
  std::stop_source stop;
  stop.request_stop();
  EXPECT_THROW(RayTree(mesh.points, mesh.triangles).wait({.stop = stop.get_token(), .progress = {}}), Cancelled);
}

TEST(Rays, pass_between_no_two_triangles_of_a_flat_grid) {
  const shapes::Mesh mesh = shapes::grid(16);
  const RayTree tree(mesh.points, mesh.triangles);
  tree.wait();
  // Through every vertex and every middle of a side, where neighbors meet.
  for (int j = 0; j <= 32; ++j) {
    for (int i = 0; i <= 32; ++i) {
      const RayHit hit = tree.first_hit({i / 32.0, j / 32.0, 1.0}, {0, 0, -1});
      ASSERT_GE(hit.triangle, 0) << i << " " << j;
      EXPECT_DOUBLE_EQ(hit.distance, 1.0);
    }
  }
  EXPECT_EQ(tree.first_hit({-1, 0.5, 0.0}, {1, 0, 0}).triangle, -1) << "in its plane: seen edgewise";
}

/// The tree answers what looking at every triangle answers; a tree is asked before and after it is ready.
TEST(Rays, are_the_same_before_and_after_the_tree_is_built) {
  const shapes::Mesh mesh = shapes::icosphere(5, 0.5);
  const RayTree tree(mesh.points, mesh.triangles);
  std::mt19937 random(7);
  std::normal_distribution<double> place;
  std::vector<std::pair<Vector, Vector>> rays;
  std::vector<RayHit> before;
  for (int i = 0; i < 200; ++i) {
    const Vector from(place(random), place(random), place(random));
    rays.emplace_back(from, 0.5 * Vector(place(random), place(random), place(random)) - from);
    before.push_back(tree.first_hit(rays.back().first, rays.back().second));
  }
  tree.wait();
  ASSERT_TRUE(tree.ready());
  int met = 0;
  for (std::size_t i = 0; i < rays.size(); ++i) {
    const RayHit after = tree.first_hit(rays[i].first, rays[i].second);
    EXPECT_EQ(after.triangle, before[i].triangle);
    EXPECT_EQ(after.distance, before[i].distance);
    met += after.triangle >= 0 ? 1 : 0;
  }
  EXPECT_GT(met, 20);
  EXPECT_LT(met, 180);
}

/// What every single triangle says, asked one by one, is what the tree says of all.
TEST(Rays, find_the_nearest_of_all_triangles) {
  std::mt19937 random(3);
  std::normal_distribution<double> place;
  shapes::Mesh mesh;
  for (std::int32_t t = 0; t < 300; ++t) {
    for (int i = 0; i < 3; ++i) mesh.points.emplace_back(place(random), place(random), place(random));
    mesh.triangles.push_back({3 * t, 3 * t + 1, 3 * t + 2});
  }
  const RayTree tree(mesh.points, mesh.triangles);
  tree.wait();
  std::deque<RayTree> alone;
  for (const Triangle& triangle : mesh.triangles) alone.emplace_back(mesh.points, std::vector<Triangle>{triangle});
  for (int i = 0; i < 100; ++i) {
    const Vector origin(3 * place(random), 3 * place(random), 3 * place(random));
    RayHit best;
    for (std::size_t t = 0; t < alone.size(); ++t) {
      const RayHit hit = alone[t].first_hit(origin, -origin);
      if (hit.triangle == 0 && (best.triangle < 0 || hit.distance < best.distance)) {
        best = {static_cast<std::int32_t>(t), hit.distance};
      }
    }
    EXPECT_EQ(tree.first_hit(origin, -origin).triangle, best.triangle);
  }
}

TEST(Rays, leave_out_what_has_no_area_or_is_not_finite) {
  const double inf = std::numeric_limits<double>::infinity();
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const std::vector<Vector> points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0.5, 0, 0}, {inf, 0, 0}, {0, nan, 0}};
  for (const bool built : {false, true}) {
    const RayTree tree(points, {{0, 1, 3}, {0, 0, 1}, {0, 1, 4}, {0, 1, 5}, {0, 1, 2}});
    if (built) tree.wait();
    EXPECT_EQ(tree.first_hit({0.2, 0.2, 1.0}, {0, 0, -1}).triangle, 4);
    EXPECT_EQ(tree.first_hit({0.2, 0.2, nan}, {0, 0, -1}).triangle, -1);
    EXPECT_EQ(tree.first_hit({0.2, 0.2, 1.0}, {0, 0, 0}).triangle, -1);
  }
}

/// Corners in line but for rounding: what is computed of a hit is rounding too, and must not depend on when one asks.
TEST(Rays, over_triangles_whose_corners_are_in_line_are_the_same_before_and_after) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> place(-1, 1);
  shapes::Mesh mesh;
  std::vector<std::pair<Vector, Vector>> rays;
  for (std::int32_t t = 0; t < 20'000; ++t) {
    const Vector from(place(random), place(random), place(random));
    const Vector along(place(random), place(random), place(random));
    const std::array<double, 3> steps = {0, place(random), place(random)};
    for (const double step : steps) mesh.points.emplace_back(from + step * along);
    mesh.triangles.push_back({3 * t, 3 * t + 1, 3 * t + 2});
    // Many rays go through the line, where a hit is likely.
    if (t % 10 == 0) rays.emplace_back(Vector(0, 0, 3), from + 0.1 * along - Vector(0, 0, 3));
  }
  const RayTree tree(mesh.points, mesh.triangles);
  tree.wait();
  for (const auto& [origin, direction] : rays) {
    // One by one, without a tree: a tree of one triangle is that triangle.
    const RayHit hit = tree.first_hit(origin, direction);
    if (hit.triangle < 0) continue;
    const Vector at = origin + hit.distance * direction;
    const Vector &a = mesh.points[3 * static_cast<std::size_t>(hit.triangle)],
                 &b = mesh.points[3 * static_cast<std::size_t>(hit.triangle) + 1],
                 &c = mesh.points[3 * static_cast<std::size_t>(hit.triangle) + 2];
    const Vector low = a.cwiseMin(b).cwiseMin(c), high = a.cwiseMax(b).cwiseMax(c);
    EXPECT_LE((low - at).maxCoeff(), 1e-8) << "a hit outside of the triangle's box";
    EXPECT_LE((at - high).maxCoeff(), 1e-8);
  }
  for (int round = 0; round < 4; ++round) {
    const RayTree unbuilt(mesh.points, mesh.triangles);
    for (auto i = static_cast<std::size_t>(round); i < rays.size() && !unbuilt.ready(); i += 4) {
      const RayHit early = unbuilt.first_hit(rays[i].first, rays[i].second);
      const RayHit late = tree.first_hit(rays[i].first, rays[i].second);
      EXPECT_EQ(early.triangle, late.triangle);
      EXPECT_EQ(early.distance, late.distance);
    }
  }
}

TEST(Rays, take_the_smaller_number_of_two_that_lie_in_one_place) {
  const std::vector<Vector> points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  const RayTree tree(points, {{1, 2, 0}, {0, 1, 2}, {2, 1, 0}});
  tree.wait();
  EXPECT_EQ(tree.first_hit({0.25, 0.25, 1.0}, {0, 0, -1}).triangle, 0);
}

TEST(Rays, of_an_empty_mesh_meet_nothing) {
  const RayTree tree({}, {});
  tree.wait();
  EXPECT_EQ(tree.first_hit({0, 0, 1}, {0, 0, -1}).triangle, -1);
  EXPECT_THROW(RayTree({{0, 0, 0}}, {{0, 0, 1}}), InvalidInput);
}

TEST(Rays, of_a_tree_that_is_dropped_before_it_is_built) {
  const shapes::Mesh mesh = shapes::icosphere(6, 0.5);
  for (int i = 0; i < 5; ++i) {
    const RayTree tree(mesh.points, mesh.triangles);
    EXPECT_GE(tree.first_hit({0, 0, 3}, {0, 0, -1}).triangle, 0);
  }
}

}  // namespace
}  // namespace seamwire
