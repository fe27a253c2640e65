// SPDX-License-Identifier: GPL-3.0-or-later
#include "seamwire/picking/picker.hpp"

#include <gtest/gtest.h>

#include <array>
#include <numeric>
#include <thread>
#include <vector>

#include "shapes.hpp"

namespace seamwire {
namespace {

/// A grid of triangles in the unit square, all of whose sides are edges.
Picker grid_picker(int side) {
  const shapes::Mesh mesh = shapes::grid(side);
  std::vector<std::int32_t> polygons(mesh.triangles.size());
  std::iota(polygons.begin(), polygons.end(), 0);
  std::vector<Edge> edges;
  for (const auto& [a, b, c] : mesh.triangles) edges.insert(edges.end(), {{a, b}, {b, c}, {c, a}});
  return Picker(mesh.points, mesh.triangles, polygons, edges);
}

/// A view down on the unit square, whose side is 100 pixels long.
Sight sight_at(double x, double y) {
  Sight sight;
  sight.perspective.diagonal() << 2.0, 2.0, -0.1, 1.0;
  sight.perspective.topRightCorner<2, 1>().setConstant(-1.0);
  sight.size = {100.0, 100.0};
  sight.cursor = {x, y};
  return sight;
}

TEST(Picker, finds_a_vertex_an_edge_and_a_place) {
  const Picker picker = grid_picker(2);
  const auto vertex = picker.pick(sight_at(51.0, 52.0), {}, {});
  ASSERT_TRUE(vertex);
  EXPECT_EQ(vertex->vertex, 4);
  const auto edge = picker.pick(sight_at(75.0, 51.0), {}, {});
  ASSERT_TRUE(edge);
  EXPECT_EQ(edge->vertex, -1);
  EXPECT_EQ(std::minmax(edge->edge[0], edge->edge[1]), std::minmax(4, 5));
  const auto place = picker.pick(sight_at(60.0, 20.0), {}, {.layers = {}, .surface_only = true});
  ASSERT_TRUE(place);
  EXPECT_NEAR((place->place - Vector(0.6, 0.2, 0.0)).norm(), 0.0, 1e-12);
  EXPECT_NEAR(place->depth, 10.0, 1e-9);
  EXPECT_FALSE(picker.pick(sight_at(150.0, 20.0), {}, {}));
}

TEST(Picker, refuses_numbers_that_do_not_exist) {
  const std::vector<Vector> points{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  EXPECT_THROW(Picker(points, {{0, 1, 3}}, {0}, {}), InvalidInput);
  EXPECT_THROW(Picker(points, {{0, 1, 2}}, {0}, {{0, 3}}), InvalidInput);
  EXPECT_THROW(Picker(points, {{0, 1, 2}}, {}, {}), InvalidInput);
  const Picker picker(points, {{0, 1, 2}}, {0}, {{0, 1}, {1, 2}, {0, 2}});
  const Sight sight = sight_at(30.0, 30.0);
  EXPECT_THROW(picker.pick(sight, {}, {.layers = {0}}), InvalidInput);
  PickTargets targets;
  targets.layers.push_back({.ends = {{0, 0, 0}}, .owners = {0}, .reach = 1.0});
  targets.strengths = {1.0, 2.0};
  EXPECT_THROW(picker.pick(sight, targets, {.layers = {0}}), InvalidInput);
  EXPECT_THROW(picker.pick(sight, targets, {.layers = {}, .features = true}), InvalidInput);
}

TEST(Picker, takes_whatever_numbers_a_view_has) {
  const Picker picker = grid_picker(2);
  for (const double x : {std::nan(""), std::numeric_limits<double>::infinity(), 0.0, 1e300}) {
    for (int i = 0; i < 4; ++i) {
      std::array<Sight, 4> sights;
      sights.fill(sight_at(50.0, 50.0));
      sights[0].perspective(i, i) = x;
      sights[1].object(i, i) = x;
      sights[2].cursor[i % 2] = x;
      sights[3].scale = x;
      for (Sight& sight : sights) {
        for (sight.xray = false;; sight.xray = true) {
          picker.pick(sight, {}, {.layers = {}, .edges_only = i % 2 == 1, .features = true});
          picker.pick(sight, {}, {.layers = {}, .vertices_only = true, .anywhere = i % 2 == 1});
          if (sight.xray) break;
        }
      }
    }
  }
}

TEST(Picker, answers_several_threads_before_and_after_it_is_ready) {
  const Picker picker = grid_picker(100);
  std::vector<std::jthread> threads;
  for (int i = 0; i < 4; ++i) {
    threads.emplace_back([&picker, i] {
      PickTargets targets;
      targets.layers.push_back({.ends = {{0, 0, 0}, {1, 0, 0}}, .owners = {i}, .reach = 4.0});
      for (int y = 0; y < 100; ++y) {
        const auto found = picker.pick(sight_at(50.2, y), targets, {.layers = {0}});
        ASSERT_TRUE(found);
        EXPECT_EQ(found->owner, y <= 4 ? i : -1);
      }
    });
  }
  picker.wait();
  EXPECT_TRUE(picker.ready());
}

}  // namespace
}  // namespace seamwire
