// SPDX-License-Identifier: GPL-3.0-or-later
#include "seams/straightening.hpp"

#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <numbers>
#include <set>
#include <utility>
#include <vector>

#include "seams/curve_crossings.hpp"
#include "shapes.hpp"
#include "thread_sanitizer.hpp"

namespace seamwire {
namespace {

constexpr std::int32_t kCells = 12;

/// A vertex of the square.
std::int32_t at(std::int32_t column, std::int32_t row) { return row * (kCells + 1) + column; }

/// Wires over the unit square that cost their length.
struct Sheet {
  std::shared_ptr<const Surface> surface = std::make_shared<const Surface>(shapes::grid(kCells).surface());
  CandidateWires wires{surface, Along::kSurface, {.max_anisotropy = 1.0}, {}};
  Seclusion seclusion{*surface, wires.curvature()};
  DirectWires direct{wires, seclusion};

  std::vector<Choice> between(const std::set<Ends>& pairs) const {
    std::vector<Choice> choices;
    for (auto& [ends, choice] : direct.find(pairs, {})) choices.push_back(choice);
    return choices;
  }
  std::vector<Choice> straightened(std::vector<Choice> choices, std::vector<std::int32_t> images = {},
                                   const std::vector<std::int32_t>& fixed = {}) const {
    const SeamPlannerOptions options{.strength = {.max_anisotropy = 1.0}, .images = std::move(images)};
    const std::vector<double> max_spreads(surface->face_count(), 1.0);
    return seamwire::straightened(std::move(choices), fixed, direct, *surface, options, {.max_spread = 1.0},
                                  max_spreads, {});
  }
};

/// Of the curves.
double length(const std::vector<Choice>& choices) {
  double sum = 0.0;
  for (const Choice& choice : choices) {
    const std::vector<Vector>& curve = choice.wire.points;
    for (std::size_t i = 1; i < curve.size(); ++i) sum += (curve[i] - curve[i - 1]).norm();
  }
  return sum;
}

TEST(Straightening, WhereThreeWiresMeetTheSeedSlidesToWhereTheyBalance) {
  const Sheet sheet;
  const std::int32_t top = at(6, 12), left = at(0, 0), right = at(12, 0), seed = at(6, 10);
  const std::vector<Choice> before = sheet.between({ends_of(seed, top), ends_of(seed, left), ends_of(seed, right)});
  const std::vector<Choice> after = sheet.straightened(before);
  ASSERT_EQ(after.size(), 3U);
  const double shortest = 1.0 + std::numbers::sqrt3 / 2;  // a Steiner tree: 120 degrees between any two
  EXPECT_GT(length(before), 1.12 * shortest);
  EXPECT_LT(length(after), 1.05 * shortest);
  EXPECT_GT(length(after), shortest - 1e-9);
}

TEST(Straightening, OnASymmetricSheetSeedsSlideInPairs) {
  const Sheet sheet;
  std::vector<std::int32_t> images;
  for (std::int32_t v = 0; v < (kCells + 1) * (kCells + 1); ++v) {
    images.push_back(at(kCells - v % (kCells + 1), v / (kCells + 1)));
  }
  const std::int32_t middle = at(6, 0), corner = at(0, 0), top = at(3, 12), seed = at(3, 10);
  std::set<Ends> pairs;
  for (const std::int32_t other : {middle, corner, top}) {
    pairs.insert({ends_of(seed, other), ends_of(images[seed], images[other])});
  }
  const std::vector<Choice> before = sheet.between(pairs), after = sheet.straightened(before, images);
  ASSERT_EQ(after.size(), 6U);
  EXPECT_LT(length(after), 0.98 * length(before));
  std::set<Ends> found, mirrored;
  for (const Choice& choice : after) {
    found.insert(ends_of(choice.wire.from, choice.wire.to));
    mirrored.insert(ends_of(images[choice.wire.from], images[choice.wire.to]));
  }
  EXPECT_EQ(found, mirrored);
  EXPECT_FALSE(found.contains(ends_of(seed, top)));
}

TEST(Straightening, WhatIsFixedStaysOnASymmetricSheetWithItsImage) {
  const Sheet sheet;
  const std::int32_t top = at(6, 12), left = at(0, 0), right = at(12, 0), seed = at(6, 10);
  const std::vector<Choice> before = sheet.between({ends_of(seed, top), ends_of(seed, left), ends_of(seed, right)});
  EXPECT_EQ(length(sheet.straightened(before, {}, {seed})), length(before));
  EXPECT_LT(length(sheet.straightened(before, {}, {top})), length(before));
  // Detours on both sides, one of them fixed.
  std::vector<std::int32_t> images;
  for (std::int32_t v = 0; v < (kCells + 1) * (kCells + 1); ++v) {
    images.push_back(at(kCells - v % (kCells + 1), v / (kCells + 1)));
  }
  const std::int32_t bottom = at(2, 0), detour = at(4, 6), up = at(2, 12);
  const std::vector<Choice> pairs =
      sheet.between({ends_of(bottom, detour), ends_of(detour, up), ends_of(images[bottom], images[detour]),
                     ends_of(images[detour], images[up])});
  EXPECT_LT(length(sheet.straightened(pairs, images)), length(pairs));
  EXPECT_EQ(length(sheet.straightened(pairs, images, {images[detour]})), length(pairs));
}

TEST(CurveCrossings, AreCountedWithinFaces) {
  const Sheet sheet;
  const std::int32_t a = at(0, 1), b = at(12, 10), c = at(2, 12), d = at(11, 0);
  EXPECT_EQ(curve_crossings(*sheet.surface, sheet.between({ends_of(a, b), ends_of(c, d)})), 1U);
  EXPECT_EQ(curve_crossings(*sheet.surface, sheet.between({ends_of(a, b), ends_of(b, c), ends_of(a, d)})), 0U);
  EXPECT_EQ(curve_crossings(*sheet.surface, sheet.between({ends_of(a, d), ends_of(c, b)})), 0U);
}

TEST(Straightening, CurvesThatAreCutCrossNoMoreOftenThanBefore) {
  for (const unsigned seed : {3U, 7U, 12U, 18U}) {
    const auto surface = std::make_shared<const Surface>(
        shapes::bumpy(seed % 2 ? shapes::torus(sized(48, 16), sized(24, 8)) : shapes::icosphere(sized(4, 2)), 0.05,
                      seed)
            .surface());
    const SeamPlannerOptions options;
    const CandidateWires wires(surface, options.along, options.strength, {});
    const Seclusion seclusion(*surface, wires.curvature());
    const DirectWires direct(wires, seclusion);
    const SeamPlanner planner(surface, options);
    for (const double spread : {0.2, 0.3, 0.4}) {
      const SeamLimits limits{.max_spread = spread, .may_start_on_others = false, .are_straightened = false};
      std::vector<Choice> before;
      for (const PlannedWire& wire : planner.plan(limits).wires) {
        const Ends ends = ends_of(wire.from, wire.to);
        before.push_back(direct.find({ends}, {}).at(ends));
      }
      const std::vector<double> max_spreads(surface->face_count(), spread);
      const std::vector<Choice> after = straightened(before, {}, direct, *surface, options, limits, max_spreads, {});
      EXPECT_LE(curve_crossings(*surface, after), curve_crossings(*surface, before)) << seed << " " << spread;
    }
  }
}

}  // namespace
}  // namespace seamwire
