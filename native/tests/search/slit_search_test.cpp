// SPDX-License-Identifier: GPL-3.0-or-later
#include "search/slit_search.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <utility>

#include "seam_problems.hpp"
#include "search/slit_solver.hpp"
#include "slits/slit_tree.hpp"

namespace seamwire {

using namespace detail;

namespace {

TEST(SlitSearch, ExposedPlacesAreCutIfTheBoundIsOutOfReachOtherwise) {
  SlitProblem problem = problem_on(shapes::icosphere(2).surface());
  std::ranges::fill(problem.prices.is_exposed, 1);
  SlitTree tree = grow_tree(problem, {.has_tips = true, .keeps_holes = false}, {});
  SlitPlan start = SlitSolver(problem, tree.roots).solve(std::move(tree.slits), {});
  const SlitGoal goal{.energy = 4.1};
  ASSERT_GT(start.energy, goal.energy);
  const SlitPlan plan = search_slits(problem, std::move(start), tree.roots, goal, {}, {});
  EXPECT_LE(plan.energy, goal.energy);
  EXPECT_FALSE(plan.overlaps);
}

}  // namespace
}  // namespace seamwire
