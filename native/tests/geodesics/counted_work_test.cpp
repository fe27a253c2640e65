// SPDX-License-Identifier: GPL-3.0-or-later
//
// A check on speed that no other program on the machine disturbs: the algorithms' counts of their work on meshes made
// here. Where a change makes the numbers better, or worse on purpose, set them anew: a failing test prints
// the row to put in place of the old one. Two per cent are for compilers that round differently.
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "intrinsic.hpp"
#include "seamwire/embedding/embedding.hpp"
#include "seamwire/geodesics/exact_geodesics.hpp"
#include "seamwire/metric/curvature.hpp"

namespace seamwire {
namespace {

constexpr double kMargin = 0.02;

struct Work {
  std::size_t lists, windows, added;
};

void expect_work(const std::string& name, const Work& counted, const Work& recorded) {
  const auto near = [](std::size_t a, std::size_t b) {
    return std::abs(static_cast<double>(a) - static_cast<double>(b)) <= kMargin * static_cast<double>(b);
  };
  EXPECT_TRUE(near(counted.lists, recorded.lists) && near(counted.windows, recorded.windows) &&
              near(counted.added, recorded.added))
      << name << ": {" << counted.lists << ", " << counted.windows << ", " << counted.added << "} and not {"
      << recorded.lists << ", " << recorded.windows << ", " << recorded.added << "}";
}

Work seeding(const IntrinsicMesh& mesh) {
  const GeodesicCounters counters = ExactGeodesics(mesh).solve(0).counters();
  return {counters.lists, counters.windows, 0};
}

TEST(CountedWork, OfSeedingIsWhatItWas) {
  expect_work("grid", seeding(shapes::intrinsic(shapes::grid(100))), {29705, 416676, 0});
  expect_work("jittered grid", seeding(shapes::intrinsic(shapes::grid(100, 0.2))), {30243, 683186, 0});
  expect_work("sphere", seeding(shapes::intrinsic(shapes::icosphere(5))), {31037, 491971, 0});
  expect_work("bumpy torus", seeding(shapes::intrinsic(shapes::bumpy(shapes::torus(120, 60), 0.02))),
              {23588, 114129, 0});
}

TEST(CountedWork, OnEmbeddedMeshesIsWhatItWas) {
  const Surface surface = shapes::bumpy(shapes::torus(120, 60), 0.02).surface();
  const Curvature curvature = principal_curvatures(surface);
  const auto work = [&](Follow follow) {
    const Embedding embedding =
        embed(surface, feature_metric(surface, curvature, follow, {.max_anisotropy = 20}), {.max_error = 0});
    Work counted = seeding(embedding.mesh);
    counted.added = embedding.faces_added;
    return counted;
  };
  expect_work("M_min", work(Follow::kMin), {31272, 73151, 2104});
  expect_work("M_max", work(Follow::kMax), {51629, 107467, 10060});
}

}  // namespace
}  // namespace seamwire
