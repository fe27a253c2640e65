// SPDX-License-Identifier: GPL-3.0-or-later
#include "seams/group_planning.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>
#include <vector>

#include "decimation/decimation.hpp"
#include "seam_problems.hpp"

namespace seamwire {

using namespace detail;

namespace {

constexpr double kBound = 4.2;

GroupProblem::Simplified simplified(const SlitProblem& original, std::size_t triangles) {
  DecimatedMesh decimated = decimate(*original.mesh, original.is_seam, original.mirror(), triangles, {});
  GroupProblem::Simplified simple{.problem = {}, .vertices = std::move(decimated.vertices)};
  simple.problem.mesh = std::make_shared<const PlanMesh>(std::move(decimated.mesh));
  simple.problem.is_seam = std::move(decimated.is_seam);
  simple.problem.prices =
      find_prices(*simple.problem.mesh, find_visibility(*simple.problem.mesh, std::nullopt, {}), std::nullopt, {}, {});
  find_pieces_of(simple.problem, {});
  return simple;
}

/// A group whose seams are searched on the surface itself if it is not large, and on simplified meshes.
GroupProblem group_on(const Surface& surface, bool is_large, const std::vector<std::size_t>& sizes) {
  GroupProblem group;
  group.original = problem_on(surface);
  group.is_large = is_large;
  for (const std::size_t triangles : sizes) group.simplified.push_back(simplified(group.original, triangles));
  return group;
}

GroupPlanning::Result planned(const GroupProblem& group, double budget) {
  GroupPlanning planning(group);
  planning.grow(true, {});
  planning.search({.energy = kBound, .may_be_exposed = false, .budget = budget}, {}, {});
  return planning.result();
}

/// A ball with hills and hollows, so that there are many plans to choose from.
Surface bumpy_ball(double waves) {
  shapes::Mesh ball = shapes::icosphere(3);
  for (Vector& p : ball.points)
    p *= 1.0 + 0.35 * std::sin(waves * p[0] + 1.0) * std::sin(4.0 * p[1]) * std::cos(3.0 * p[2]);
  return ball.surface();
}

TEST(GroupPlanning, TheBetterPlanOfTwoMeshesCounts) {
  int finer = 0, coarser = 0;
  for (const double waves : {4.0, 5.0}) {
    for (const std::size_t triangles : {300, 600}) {
      const Surface surface = bumpy_ball(waves);
      const double fine = planned(group_on(surface, false, {}), 300.0).price;
      const double coarse = planned(group_on(surface, true, {triangles}), 300.0).price;
      const GroupPlanning::Result both = planned(group_on(surface, false, {triangles}), 600.0);
      EXPECT_TRUE(both.is_within(kBound));
      EXPECT_EQ(both.price, std::min(fine, coarse));
      ++(fine <= coarse ? finer : coarser);
    }
  }
  EXPECT_GT(finer, 0);
  EXPECT_GT(coarser, 0);
}

}  // namespace
}  // namespace seamwire
