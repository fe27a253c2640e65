// SPDX-License-Identifier: GPL-3.0-or-later
#include "seams/candidate_wires.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <memory>
#include <vector>

#include "shapes.hpp"

namespace seamwire::detail {
namespace {

using Ends = CandidateWires::Ends;

CandidateWires wires_of_torus() {
  const SurfaceContext context(std::make_shared<const Surface>(shapes::bumpy(shapes::torus(24, 12), 0.02).surface()));
  return {context, {.max_anisotropy = 10.0}, {}};
}

void expect_same(const std::vector<PlannedWire>& found, const std::vector<PlannedWire>& expected) {
  ASSERT_EQ(found.size(), expected.size());
  for (std::size_t i = 0; i < found.size(); ++i) {
    EXPECT_EQ(found[i].from, expected[i].from);
    EXPECT_EQ(found[i].to, expected[i].to);
    EXPECT_EQ(found[i].follow, expected[i].follow);
    EXPECT_EQ(found[i].vertices, expected[i].vertices);
    EXPECT_EQ(found[i].points, expected[i].points);
    EXPECT_EQ(found[i].faces, expected[i].faces);
  }
}

TEST(CandidateWires, KeptWiresAreThoseThatWouldBeFound) {
  const std::vector<Ends> first = {{0, 100}, {7, 150}, {200, 30}};
  // Some of the first ones, in another order and backwards, between new ones.
  const std::vector<Ends> second = {{200, 30}, {100, 0}, {0, 100}, {0, 150}, {0, 100}};
  const CandidateWires used = wires_of_torus(), fresh = wires_of_torus();
  used.find(first, {});
  expect_same(used.find(second, {}), fresh.find(second, {}));
}

TEST(CandidateWires, AWireIsKeptOnce) {
  const std::vector<Ends> ends = {{0, 100}, {7, 150}};
  const CandidateWires wires = wires_of_torus();
  std::size_t points = 0;
  for (const PlannedWire& wire : wires.find(ends, {})) points += wire.points.size();
  EXPECT_EQ(wires.kept_points(), points);
  wires.find(ends, {});
  EXPECT_EQ(wires.kept_points(), points);
}

TEST(CandidateWires, KeptWiresHaveNoMorePointsThanTheSurfaceHasVertices) {
  const CandidateWires wires = wires_of_torus();
  const std::int32_t count = 24 * 12;
  std::size_t points = 0;
  for (std::int32_t v = 1; v < count; v += 5) {
    const std::vector<PlannedWire> found = wires.find(std::vector<Ends>{{0, v}}, {});
    points += found[0].points.size();
    EXPECT_GE(wires.kept_points(), found[0].points.size()) << "the last one is kept";
    EXPECT_LE(wires.kept_points(), static_cast<std::size_t>(count));
  }
  EXPECT_GT(points, static_cast<std::size_t>(count)) << "too few to reach the limit";
}

}  // namespace
}  // namespace seamwire::detail
