// SPDX-License-Identifier: GPL-3.0-or-later
#include "decimation/decimation.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "parts/neck_rings.hpp"
#include "seam_problems.hpp"
#include "slits/slit_plan.hpp"
#include "slits/slit_tree.hpp"

namespace seamwire {

using namespace detail;

namespace {

/// A surface, simplified.
struct Simplified {
  Simplified(const Surface& surface, std::size_t triangles, const ProblemOptions& options = {})
      : original(problem_on(surface, options)),
        mesh(decimate(*original.mesh, original.is_seam, original.mirror(), triangles, {})) {
    simple.mesh = std::make_shared<const PlanMesh>(mesh.mesh);
    simple.is_seam = mesh.is_seam;
    if (options.mirror >= 0) simple.reflection = find_reflection(*simple.mesh, options.mirror, {});
    simple.prices =
        find_prices(*simple.mesh, find_visibility(*simple.mesh, options.front, {}), simple.reflection, {}, {});
    find_pieces_of(simple, {});
  }
  std::vector<Slit> carried(const std::vector<Slit>& slits) const {
    return carried_slits(simple, mesh.vertices, original, slits, {});
  }

  SlitProblem original;
  DecimatedMesh mesh;
  SlitProblem simple;
};

double distance(const Vector& point, const PlanMesh& mesh, const std::vector<std::int32_t>& chain) {
  double least = kInfinity;
  for (std::size_t i = 1; i < chain.size(); ++i) {
    const Vector &a = mesh.points[chain[i - 1]], along = mesh.points[chain[i]] - a;
    const double t = std::clamp((point - a).dot(along) / along.squaredNorm(), 0.0, 1.0);
    least = std::min(least, (point - a - t * along).norm());
  }
  return least;
}

/// The island of a piece with slits; whether it is a disc.
bool is_disc(const SlitProblem& problem, const std::vector<Slit>& slits) {
  return open_piece(problem, cut_of(problem, slits, {}), 0, {}).has_value();
}

TEST(CarriedSlits, RunAlongWhatTheyComeFrom) {
  for (const shapes::Mesh& shape : {shapes::icosphere(4), shapes::dumbbell(32, 60), shapes::torus(60, 30)}) {
    const Simplified pair(shape.surface(), 400);
    const SlitTree tree = grow_tree(pair.simple, {.has_tips = true, .keeps_holes = false}, {});
    const std::vector<Slit> carried = pair.carried(tree.slits);
    ASSERT_EQ(carried.size(), tree.slits.size());
    for (std::size_t k = 0; k < carried.size(); ++k) {
      const Slit &slit = tree.slits[k], &one = carried[k];
      EXPECT_EQ(one.is_needed, slit.is_needed);
      EXPECT_EQ(one.path.back(), pair.mesh.vertices[slit.path.back()]);
      for (std::size_t i = 1; i < one.path.size(); ++i) {
        EXPECT_GE(pair.original.mesh->edge_between(one.path[i - 1], one.path[i]), 0);
      }
      for (const std::int32_t v : one.path) {
        EXPECT_LT(distance(pair.original.mesh->points[v], *pair.simple.mesh, slit.path),
                  1.5 * pair.simple.mesh->median_length);
      }
      const double length = chain_length(*pair.simple.mesh, slit.path);
      EXPECT_LT(chain_length(*pair.original.mesh, one.path), 1.6 * length);
    }
    ASSERT_TRUE(is_disc(pair.simple, tree.slits));
    EXPECT_TRUE(is_disc(pair.original, carried)) << "what was a disc is one";
  }
}

TEST(CarriedSlits, ComeInExactPairs) {
  const Simplified pair(shapes::dumbbell(32, 60).surface(), 500, {.mirror = 0, .front = Vector(0, 0, 1)});
  ASSERT_TRUE(pair.simple.reflection && pair.simple.reflection->is_exact);
  const SlitTree tree = grow_tree(pair.simple, {.has_tips = true, .keeps_holes = false}, {});
  const std::vector<Slit> carried = pair.carried(tree.slits);
  std::size_t pairs = 0;
  for (const Slit& slit : carried) {
    if (slit.image.empty()) continue;
    ++pairs;
    const auto& images = pair.original.reflection->images;
    const std::size_t on_plane = slit.path.size() - slit.image.size();
    for (std::size_t i = 0; i < slit.image.size(); ++i) EXPECT_EQ(slit.image[i], images[slit.path[on_plane + i]]);
  }
  EXPECT_GT(pairs, 0U);
}

TEST(CarriedSlits, RingsStayClosed) {
  const Simplified pair(shapes::dumbbell(32, 60).surface(), 600);
  const std::vector<NeckRing> rings = find_necks(pair.simple, {});
  ASSERT_FALSE(rings.empty());
  SlitProblem parted = pair.original;
  parted.is_seam = cut_of(parted, pair.carried(slits_of(rings.front())), {}).is_cut;
  find_pieces_of(parted, {});
  EXPECT_EQ(parted.pieces.count, 2);
}

TEST(CarriedSlits, LookAtTheTaskForEachChain) {
  const Simplified pair(shapes::icosphere(4).surface(), 400);
  const SlitTree tree = grow_tree(pair.simple, {.has_tips = true, .keeps_holes = false}, {});
  const auto carry = [&](const Task& task) {
    carried_slits(pair.simple, pair.mesh.vertices, pair.original, tree.slits, task);
  };
  std::size_t looks = 0;
  carry({.stop = {}, .progress = [&](double) { return ++looks > 0; }});
  ASSERT_FALSE(tree.slits.empty());
  EXPECT_GE(looks, tree.slits.size());
  EXPECT_THROW(carry({.stop = {}, .progress = [&](double) { return --looks > 0; }}), Cancelled);
}

}  // namespace
}  // namespace seamwire
