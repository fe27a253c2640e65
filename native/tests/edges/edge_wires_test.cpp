// SPDX-License-Identifier: GPL-3.0-or-later
#include "seamwire/edges/edge_wires.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <map>
#include <numbers>
#include <optional>
#include <random>
#include <string>
#include <thread>

#include "chains.hpp"
#include "edges/edge_search.hpp"
#include "shapes.hpp"

namespace seamwire::chains {
namespace {

template <class Call>
std::string message_of(const Call& call) {
  try {
    call();
  } catch (const InvalidInput& error) {
    return error.what();
  }
  return "no error";
}

testing::AssertionResult contains(const std::string& message, const std::string& part) {
  if (message.find(part) != std::string::npos) return testing::AssertionSuccess();
  return testing::AssertionFailure() << "\"" << message << "\" does not say \"" << part << "\"";
}

TEST(EdgeWires, KeepStraightOnAQuadGrid) {
  const Surface surface = shapes::quad_grid(10).surface();
  const auto graph = plain_graph(surface);
  const EdgeChain across = edge_wires(graph, {33, -1}).trace({43, -1}).value();
  EXPECT_EQ(across.vertices, Chain({33, 34, 35, 36, 37, 38, 39, 40, 41, 42, 43}));
  EXPECT_NEAR(across.length, 1.0, kRounding);

  const EdgeChain between = edge_wires(graph, {35, 36}).trace({39, 40}).value();
  EXPECT_EQ(between.vertices, Chain({35, 36, 37, 38, 39, 40}));
  EXPECT_NEAR(between.length, 0.5, kRounding);
}

TEST(EdgeWires, PayForTurningInMeanEdgeLengths) {
  const Surface surface = shapes::quad_grid(10).surface();
  // From the middle of the left side to the middle of the bottom: ten edges of length .1 and one right angle.
  const EdgeChain chain = edge_wires(plain_graph(surface), {5 * 11 + 1, -1}, 3.0).trace({11 + 5, -1}).value();
  EXPECT_NEAR(chain.length, 0.8 + 3.0 * 0.1, kRounding);
  EXPECT_EQ(chain.vertices.size(), 9u);
}

TEST(EdgeWires, FollowTheEdgeLoopOverTheEdgesOfACube) {
  const shapes::QuadMesh cube = shapes::quad_cube(8);
  const Surface surface = cube.surface();
  const auto number = [&](const Vector& point) {
    const auto it = std::ranges::find_if(cube.points, [&](const Vector& p) { return p.isApprox(point, 1e-9); });
    return static_cast<std::int32_t>(it - cube.points.begin());
  };
  // Up the side x = 0 in the plane y = 3/8, over the top, and down the other side; the metric is the one of the tool.
  Chain loop;
  for (int k = 4; k <= 8; ++k) loop.push_back(number({0, 3 / 8.0, k / 8.0}));
  for (int i = 1; i <= 8; ++i) loop.push_back(number({i / 8.0, 3 / 8.0, 1}));
  for (int k = 7; k >= 5; --k) loop.push_back(number({1, 3 / 8.0, k / 8.0}));
  const Curvature curvature = principal_curvatures(surface);
  for (const Follow follow : {Follow::kMin, Follow::kMax}) {
    const Metric metric = feature_metric(surface, curvature, follow, {.max_anisotropy = 10, .clamp_percentile = 99});
    const EdgeWires wires = edge_wires(make_edge_graph(surface, metric), {loop[0], loop[1]});
    EXPECT_EQ(wires.trace({loop[loop.size() - 2], loop.back()})->vertices, loop);
  }
}

TEST(EdgeWires, ContainThePickedEdgesWhichHaveNoDirection) {
  const Surface surface = shapes::quad_grid(6).surface();
  const auto graph = plain_graph(surface);
  for (const Pick seed : {Pick{9, 10}, Pick{10, 9}}) {
    const EdgeWires wires = edge_wires(graph, seed);
    for (const bool turned : {false, true}) {
      const auto target = [&](std::int32_t a, std::int32_t b) { return turned ? Pick{b, a} : Pick{a, b}; };
      EXPECT_EQ(wires.trace(target(12, 13))->vertices, Chain({9, 10, 11, 12, 13}));
      EXPECT_EQ(wires.trace(target(7, 8))->vertices, Chain({10, 9, 8, 7}));
      EXPECT_EQ(wires.trace(target(10, 17))->vertices, Chain({9, 10, 17})) << "neighbors";
      EXPECT_EQ(wires.trace(target(8, 9))->vertices, Chain({10, 9, 8})) << "neighbors";
    }
    EXPECT_EQ(wires.trace({12, -1})->vertices, Chain({9, 10, 11, 12}));
    EXPECT_EQ(wires.trace({8, -1})->vertices, Chain({10, 9, 8}));
  }
}

TEST(EdgeWires, ToTheSeedItselfAreTheSeedAlone) {
  const Surface surface = shapes::quad_grid(6).surface();
  const auto graph = plain_graph(surface);
  const EdgeChain vertex = edge_wires(graph, {9, -1}).trace({9, -1}).value();
  EXPECT_EQ(vertex.vertices, Chain({9}));
  EXPECT_EQ(vertex.length, 0.0);
  for (const bool forward : {false, true}) {
    const EdgeChain edge = edge_wires(graph, {9, 10}, 3.0, forward).trace({10, 9}).value();
    EXPECT_EQ(sorted(edge.vertices), Chain({9, 10}));
    EXPECT_NEAR(edge.length, 1 / 6.0, kRounding);
  }
  EXPECT_EQ(edge_wires(graph, {9, 10}).trace({9, -1})->vertices, Chain({10, 9}));
  EXPECT_EQ(edge_wires(graph, {9, -1}).trace({9, 10})->vertices, Chain({9, 10}));
}

TEST(EdgeWires, OfAForwardSeedLeaveOverItsSecondVertex) {
  const Surface surface = shapes::quad_grid(10).surface();
  const auto graph = plain_graph(surface);
  // The target lies behind the seed: the chain has to go round, and past the seed's first vertex.
  const EdgeChain back = edge_wires(graph, {60, 61}, 3.0, true).trace({57, 58}).value();
  ASSERT_GE(back.vertices.size(), 6u);
  EXPECT_EQ(back.vertices[0], 60);
  EXPECT_EQ(back.vertices[1], 61);
  EXPECT_FALSE(has_repeated_vertex(back.vertices));
  EXPECT_EQ(edge_wires(graph, {60, 61}, 3.0, false).trace({57, 58})->vertices, Chain({61, 60, 59, 58, 57}));
  EXPECT_EQ(edge_wires(graph, {60, 61}, 3.0, true).trace({62, 63})->vertices, Chain({60, 61, 62, 63}));
}

TEST(EdgeWires, OfAForwardSeedCloseOnItsFirstVertexOnly) {
  const Surface surface = shapes::quad_cylinder(8, 4).surface();
  const auto graph = plain_graph(surface);
  // Vertices 16 to 23 are the ring in the middle.
  const EdgeWires wires = edge_wires(graph, {16, 17}, 3.0, true);
  EXPECT_EQ(wires.trace({23, 16})->vertices, Chain({16, 17, 18, 19, 20, 21, 22, 23, 16}));
  EXPECT_EQ(wires.trace({16, -1})->vertices, Chain({16, 17, 18, 19, 20, 21, 22, 23, 16}));
  EXPECT_EQ(wires.trace({17, -1})->vertices, Chain({16, 17}));
  EXPECT_EQ(edge_wires(graph, {16, 17}).trace({23, 16})->vertices, Chain({17, 16, 23}));
}

TEST(EdgeWires, CostTheSameInBothDirections) {
  const Surface surface = shapes::torus(12, 8).surface();
  const auto graph = make_edge_graph(
      surface, feature_metric(surface, principal_curvatures(surface), Follow::kMin, {.max_anisotropy = 10}));
  const std::vector<Edge>& edges = surface.edges();
  std::mt19937 random(3);
  std::uniform_int_distribution<std::size_t> pick(0, edges.size() - 1);
  for (int i = 0; i < 100; ++i) {
    const Pick from{edges[pick(random)][0], -1};
    const Edge& edge = edges[pick(random)];
    const Pick to{edge[0], edge[1]};
    EXPECT_NEAR(edge_wires(graph, from).trace(to)->length, edge_wires(graph, to).trace(from)->length, kRounding);
  }
}

TEST(EdgeWires, DoNotDependOnTheScaleOfTheModel) {
  shapes::Mesh mesh = shapes::grid(6, 0.3);
  const Surface surface = mesh.surface();
  for (Vector& p : mesh.points) p = 1e7 * p + Vector(3e6, 0, 0);
  const Surface large = mesh.surface();
  const EdgeWires wires = edge_wires(plain_graph(surface), {0, 1}),
                  large_wires = edge_wires(plain_graph(large), {0, 1});
  for (const auto& [a, b] : surface.edges()) {
    EXPECT_EQ(wires.trace({a, b})->vertices, large_wires.trace({a, b})->vertices);
    EXPECT_NEAR(wires.trace({a, b})->length, large_wires.trace({a, b})->length / 1e7, 1e-9)
        << "digits lost by the shift";
  }
}

/// A grid of 16 vertices whose columns and rows are so uneven that going round a small circle may be cheaper than a
/// sharp turn.
shapes::Mesh uneven_grid(unsigned seed) {
  shapes::Mesh mesh = shapes::grid(3, 0.45, seed);
  for (Vector& p : mesh.points) p = {std::pow(p.x(), 4), std::pow(p.y(), 4), 0.3 * p.x() * p.y()};
  return mesh;
}

TEST(EdgeWires, AreTheCheapestSimpleChainsOnSmallRandomMeshes) {
  constexpr double kTurning = 3.0;
  int targets = 0;
  for (unsigned seed = 1; seed <= 6; ++seed) {
    const Surface surface = shapes::grid(3, 0.4, seed).surface();
    const Table table(surface);
    const auto& edges = surface.edges();
    const Edge from = edges[(7 * seed) % edges.size()];
    const EdgeWires forward = edge_wires(table.graph(), {from[0], from[1]}, kTurning, true);
    const EdgeWires either = edge_wires(table.graph(), {from[0], from[1]}, kTurning);
    double limit = 0;
    for (const auto& [a, b] : edges) {
      const double length = forward.trace({a, b})->length;
      if (a != from[0] && b != from[0]) limit = std::max(limit, length);
    }
    const auto there = table.cheapest_simple(from, kTurning, limit + kTableRounding);
    const auto back = table.cheapest_simple({from[1], from[0]}, kTurning, limit + kTableRounding);
    const auto best = [&](const std::map<Edge, double>& costs, const Edge& e) {
      const auto it = costs.find(e);
      return it == costs.end() ? kInfinity : it->second;
    };
    for (const auto& [a, b] : edges) {
      const double one_way = std::min(best(there, {a, b}), best(there, {b, a}));
      const double other_way = std::min(best(back, {a, b}), best(back, {b, a}));
      const EdgeChain chain = either.trace({a, b}).value();
      EXPECT_NEAR(chain.length, std::min(one_way, other_way), kTableRounding);
      EXPECT_NEAR(chain.length, table.cost(chain.vertices, kTurning), kTableRounding);
      EXPECT_FALSE(has_repeated_vertex(chain.vertices));
      if (a == from[0] || b == from[0]) continue;  // closed: not among the simple ones
      EXPECT_NEAR(forward.trace({a, b})->length, one_way, kTableRounding);
      ++targets;
    }
  }
  EXPECT_GT(targets, 150);
}

TEST(EdgeWires, NeverRepeatAVertexWhereTheCheapestWalkDoes) {
  constexpr double kTurning = 20.0;
  int crossing_walks = 0, dearer = 0, chains = 0;
  for (unsigned seed = 1; seed <= 6; ++seed) {
    const Surface surface = uneven_grid(seed).surface();
    const Table table(surface);
    for (const Edge& from : surface.edges()) {
      const EdgeWires wires = edge_wires(table.graph(), {from[0], from[1]}, kTurning, true);
      const auto walks = table.walks(from, kTurning);
      double limit = 0;
      for (const auto& [a, b] : surface.edges()) {
        if (a != from[0] && b != from[0]) limit = std::max(limit, wires.trace({a, b})->length);
      }
      ASSERT_LT(limit, kInfinity) << "a chain to every edge";
      const auto simple = table.cheapest_simple(from, kTurning, limit + kTableRounding);
      for (const auto& [a, b] : surface.edges()) {
        if (a == from[0] || b == from[0]) continue;
        const EdgeChain chain = wires.trace({a, b}).value();
        ASSERT_FALSE(has_repeated_vertex(chain.vertices));
        ASSERT_NEAR(chain.length, table.cost(chain.vertices, kTurning), kTableRounding);
        const Edge e = walks.at({a, b}).cost < walks.at({b, a}).cost ? Edge{a, b} : Edge{b, a};
        const bool crossing = has_repeated_vertex(Table::chain_of(walks, e));
        if (!crossing) {
          EXPECT_NEAR(chain.length, walks.at(e).cost, kTableRounding);
        }
        const auto best = [&](const Edge& to) { return simple.contains(to) ? simple.at(to) : kInfinity; };
        const double cheapest = std::min(best({a, b}), best({b, a}));
        EXPECT_GE(chain.length, cheapest - kTableRounding);
        ++chains;
        crossing_walks += crossing;
        dearer += chain.length > cheapest + kTableRounding;
      }
    }
  }
  EXPECT_GT(crossing_walks, 20) << "the meshes must make walks cross themselves";
  // The cheapest simple chain is NP-hard; what is found instead is rarely another one.
  EXPECT_LT(dearer, chains / 100);
  RecordProperty("chains", chains);
  RecordProperty("crossing_walks", crossing_walks);
  RecordProperty("dearer", dearer);
}

TEST(EdgeWires, PreferTheMetricsDirection) {
  // Steps along x are short in this metric.
  const Surface surface = shapes::quad_grid(8).surface();
  Metric metric = plain_metric(surface);
  for (Eigen::Matrix3d& tensor : metric.tensors) tensor = Vector(1e-2, 1, 1).asDiagonal();
  const EdgeChain chain = edge_wires(make_edge_graph(surface, metric), {0, -1}, 0.0).trace({9 * 8 + 8, -1}).value();
  EXPECT_NEAR(chain.length, 1.0 + 0.1, kRounding);
}

TEST(EdgeWires, AreThereForNoUnreachableTarget) {
  shapes::QuadMesh mesh = shapes::quad_grid(2);
  const auto shift = static_cast<std::int32_t>(mesh.points.size());
  for (std::int32_t v = 0; v < shift; ++v) {
    mesh.points.push_back(mesh.points[static_cast<std::size_t>(v)] + Vector(0, 0, 1));
  }
  mesh.points.emplace_back(0.5, 0.5, 0.5);  // and an isolated vertex, 18
  mesh.quads.push_back({shift, shift + 1, shift + 4, shift + 3});
  const Surface surface = mesh.surface();
  const auto graph = plain_graph(surface);
  const EdgeWires wires = edge_wires(graph, {0, 1});
  for (const Pick target : {Pick{9, 10}, Pick{13, -1}, Pick{17, -1}, Pick{18, -1}}) {
    EXPECT_FALSE(wires.trace(target));
  }
  const EdgeWires isolated = edge_wires(graph, {18, -1});
  EXPECT_EQ(isolated.trace({18, -1})->vertices, Chain({18}));
  EXPECT_FALSE(isolated.trace({0, -1}));
}

TEST(EdgeWires, CrossEdgesOfLengthZeroAndTrianglesWithoutArea) {
  shapes::QuadMesh mesh = shapes::quad_grid(4);
  mesh.points[12] = mesh.points[13];  // a quad beside the middle becomes a triangle, two others degenerate
  mesh.points[7] = mesh.points[8];
  const Surface surface = mesh.surface();
  const auto graph = plain_graph(surface);
  for (const bool forward : {false, true}) {
    const EdgeWires wires = edge_wires(graph, {12, 13}, 3.0, forward);
    for (const auto& [a, b] : surface.edges()) {
      const EdgeChain chain = wires.trace({a, b}).value();
      ASSERT_GE(chain.vertices.size(), 2u);
      EXPECT_TRUE(std::isfinite(chain.length));
      Chain open(chain.vertices.begin(), chain.vertices.end() - 1);
      EXPECT_FALSE(has_repeated_vertex(open));
    }
  }
}

TEST(EdgeWires, RefuseWrongInputWithItsNumbers) {
  const Surface surface = shapes::quad_grid(2).surface();
  const auto graph = plain_graph(surface);
  EXPECT_TRUE(contains(message_of([&] { edge_wires(graph, {9, -1}); }), "vertex 9 is out of range"));
  EXPECT_TRUE(contains(message_of([&] { edge_wires(graph, {-3, -1}); }), "vertex -3"));
  EXPECT_TRUE(contains(message_of([&] { edge_wires(graph, {0, -2}); }), "vertex -2"));
  EXPECT_TRUE(contains(message_of([&] { edge_wires(graph, {0, 70}); }), "vertex 70"));
  EXPECT_TRUE(contains(message_of([&] {
                         edge_wires(graph, {0, 4});
                       }),
                       "no edge between the vertices 0 and 4"))
      << "a diagonal";
  EXPECT_TRUE(contains(message_of([&] { edge_wires(graph, {4, 4}); }), "4 and 4"));
  EXPECT_TRUE(contains(message_of([&] { edge_wires(graph, {0, 1}).trace({1, 3}); }), "1 and 3"));
  EXPECT_TRUE(contains(message_of([&] { edge_wires(graph, {0, 1}).trace({11, -1}); }), "vertex 11"));
  EXPECT_TRUE(contains(message_of([&] { edge_wires(graph, {0, 1}, -1.0); }), "-1"));
  EXPECT_TRUE(contains(message_of([&] { edge_wires(graph, {0, 1}, std::nan("")); }), "nan"));
  EXPECT_TRUE(contains(message_of([&] { shortest_cycle(*graph, {0, 4}); }), "0 and 4"));
  EXPECT_TRUE(contains(message_of([&] { shortest_cycle(*graph, {0, -1}); }), "vertex -1"));
  Metric metric = plain_metric(surface);
  metric.tensors.pop_back();
  EXPECT_TRUE(contains(message_of([&] { make_edge_graph(surface, metric); }), "metric of 8 vertices"));
  const std::vector<Scribble> elsewhere = {{.points = {{0, 0, 0}, {1, 0, 0}}, .faces = {0, 100'000}, .vertices = {}}};
  EXPECT_TRUE(contains(message_of([&] { make_edge_graph(surface, plain_metric(surface), nullptr, elsewhere); }),
                       "face 100000"));
  EXPECT_THROW(EdgeWires(nullptr, {0}), InvalidInput);
  const auto adjacency = make_edge_adjacency(shapes::quad_grid(3).surface());
  EXPECT_TRUE(
      contains(message_of([&] { make_edge_graph(surface, plain_metric(surface), adjacency); }), "another surface"));
  EXPECT_TRUE(contains(message_of([&] { edge_wires(graph, {0, 1}, -1e-9); }), "not -1e-09"));
}

TEST(EdgeWires, RefuseAMetricTooStrongForItsLengthsToBeNumbers) {
  const Surface surface = shapes::quad_grid(2).surface();
  Metric metric = plain_metric(surface);
  metric.tensors[4] *= 1e160;  // the square of which is no number
  EXPECT_TRUE(contains(message_of([&] { make_edge_graph(surface, metric); }), "the metric at vertex 4 is too strong"));
}

TEST(EdgeWires, StopWhenToldTo) {
  const Surface surface = shapes::quad_grid(100).surface();
  const auto graph = plain_graph(surface);
  EXPECT_THROW(edge_wires(graph, {0, -1}, 3.0, false, {.stop = {}, .progress = [](double) { return false; }}),
               Cancelled);
  double last = 0;
  edge_wires(graph, {0, -1}, 3.0, false, {.stop = {}, .progress = [&](double fraction) {
                                            EXPECT_GE(fraction, last);
                                            EXPECT_LE(fraction, 1.0);
                                            last = fraction;
                                            return true;
                                          }});
  EXPECT_GT(last, 0.5);
}

/// A vertex in the middle of `sides` others at about one distance.
Surface pole(std::int32_t sides) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> about(-0.3, 0.3);
  std::vector<Vector> points{{0, 0, 0}};
  std::vector<Triangle> triangles;
  for (std::int32_t i = 0; i < sides; ++i) {
    const double angle = 2.0 * std::numbers::pi * (i + about(random)) / sides, radius = 1.0 + 0.1 * about(random);
    points.emplace_back(radius * std::cos(angle), radius * std::sin(angle), 0.0);
    triangles.push_back({0, 1 + i, 1 + (i + 1) % sides});
  }
  return {points, triangles};
}

TEST(EdgeWires, TakeStepsInProportionToTheEdgesAtAVertex) {
  const auto steps = [](std::int32_t sides) {
    const auto graph = plain_graph(pole(sides));
    std::size_t looks = 0;
    edge_wires(graph, {1, -1}, 3.0, false, {.stop = {}, .progress = [&](double) { return ++looks > 0; }});
    return static_cast<double>(looks * detail::kStepsBetweenChecks);
  };
  const double few = steps(2000), many = steps(8000);
  EXPECT_GT(few, 2000.0) << "the task is asked";
  EXPECT_LT(many, 5.0 * few);
}

TEST(EdgeWires, AreTheSameHoweverManyEdgesCountAsMany) {
  const auto expect_same = [](const Surface& surface, const std::vector<Scribble>& scribbles) {
    const auto graph = make_edge_graph(surface, plain_metric(surface), nullptr, scribbles);
    const auto directed = static_cast<std::int32_t>(graph->directed_count());
    for (const double turning : {0.0, 0.5, 3.0, 40.0}) {
      detail::EdgeSearch pairs(*graph, turning, directed + 1), trees(*graph, turning, 1);
      for (detail::EdgeSearch* search : {&pairs, &trees}) {
        search->block(5);
        for (std::int32_t e = graph->begin(5); e < graph->end(5); ++e) search->start(e);
        search->run(detail::Unguided(), [](std::int32_t) { return false; }, {});
      }
      for (std::int32_t e = 0; e < directed; ++e) {
        ASSERT_EQ(trees.is_settled(e), pairs.is_settled(e)) << e;
        if (!pairs.is_settled(e)) continue;
        EXPECT_EQ(trees.state(e).cost, pairs.state(e).cost) << e;
        EXPECT_EQ(trees.state(e).before, pairs.state(e).before) << e;
      }
      // Towards one vertex, with a bound of what remains.
      const std::int32_t goal = 9;
      detail::EdgeSearch to_goal(*graph, turning, 1);
      to_goal.block(5);
      for (std::int32_t e = graph->begin(5); e < graph->end(5); ++e) to_goal.start(e);
      const auto straight = [&](std::int32_t v) { return scribbles.empty() ? plain_length(surface, v, goal) : 0.0; };
      const std::int32_t last = to_goal.run(straight, [&](std::int32_t e) { return graph->head(e) == goal; }, {});
      ASSERT_GE(last, 0);
      EXPECT_EQ(to_goal.state(last).cost, pairs.state(last).cost);
    }
  };
  expect_same(pole(120), {});
  expect_same(shapes::grid(12, 0.3).surface(), {});
  const Surface ball = shapes::bumpy(shapes::torus(24, 12), 0.05).surface();
  expect_same(ball, {});
  Scribble stroke;
  stroke.vertices = {20, 60, 100};
  for (const std::int32_t v : stroke.vertices) stroke.points.push_back(ball.points()[static_cast<std::size_t>(v)]);
  expect_same(ball, {stroke});
}

// ---------------------------------------------------------------------------------------------------------------------
// While a search runs

TEST(EdgeWires, WhatIsFinalDuringTheSearchIsItsResult) {
  const shapes::Mesh mesh = shapes::bumpy(shapes::torus(220, 140), 0.01);
  const Surface surface = mesh.surface();
  const auto graph = make_edge_graph(surface, plain_metric(surface));
  const Pick seed{5};
  const EdgeWires expected = edge_wires(graph, seed);
  EdgeWires wires(graph, seed);
  const EdgeWires same = wires;
  EXPECT_FALSE(same.is_final({900}));
  EXPECT_FALSE(same.trace({900}));
  EXPECT_TRUE(same.is_final(seed)) << "the seed itself";
  std::atomic<bool> done = false;
  std::jthread search([&] {
    wires.run();
    done = true;
  });
  for (std::int32_t i = 0; !done; ++i) {
    const auto v = static_cast<std::int32_t>(i * 7919LL % static_cast<long long>(surface.vertex_count()));
    const Edge& edge =
        surface.edges()[static_cast<std::size_t>(i * 104729LL % static_cast<long long>(surface.edges().size()))];
    for (const Pick& target : {Pick{v}, Pick{edge[0], edge[1]}}) {
      const bool is_final = same.is_final(target);
      const std::optional<EdgeChain> chain = same.trace(target);
      if (is_final) {
        EXPECT_EQ(chain->vertices, expected.trace(target)->vertices);
      } else if (chain) {
        EXPECT_GE(chain->length, expected.trace(target)->length);
      }
    }
  }
  search.join();
  for (std::int32_t v = 0; v < 500; ++v) EXPECT_EQ(same.trace({v})->vertices, expected.trace({v})->vertices);
}

TEST(EdgeWires, AfterCancellingWhatWasFoundIsStillRight) {
  const Surface surface = shapes::torus(220, 140).surface();
  const auto graph = make_edge_graph(surface, plain_metric(surface));
  const EdgeWires expected = edge_wires(graph, {5});
  EdgeWires wires(graph, {5});
  EXPECT_THROW(wires.run({.stop = {}, .progress = [](double done) { return done < 0.3; }}), Cancelled);
  int found = 0;
  for (std::int32_t v = 0; v < static_cast<std::int32_t>(surface.vertex_count()); v += 7) {
    if (!wires.is_final({v})) continue;
    ++found;
    EXPECT_EQ(wires.trace({v})->vertices, expected.trace({v})->vertices);
  }
  EXPECT_GT(found, 100);
}

}  // namespace
}  // namespace seamwire::chains
