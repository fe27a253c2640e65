// SPDX-License-Identifier: GPL-3.0-or-later
#include "edges/part_borders.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <set>
#include <vector>

#include "seamwire/edges/edge_loop.hpp"
#include "shapes.hpp"

namespace seamwire::detail {
namespace {

using Vertices = std::set<std::int32_t>;

constexpr double kPi = std::numbers::pi;
constexpr int kQuads = 5;
/// Vertices along a side of the plate. Vertex kSide * row + column.
constexpr int kSide = kQuads + 1;

struct Borders {
  explicit Borders(const Surface& of)
      : surface(of), adjacency(make_edge_adjacency(surface)), borders(surface, *adjacency) {}
  Borders(const Borders&) = delete;
  Borders& operator=(const Borders&) = delete;

  /// Divides a plate between its columns up to a bound and those beyond.
  Borders& parted(int bound) {
    Numbers labels;
    for (const Triangle& t : surface.triangles()) {
      labels.push_back(std::ranges::max(t, {}, [](std::int32_t v) { return v % kSide; }) % kSide > bound ? 1 : 0);
    }
    borders.add_parts(labels);
    return *this;
  }

  Surface surface;
  std::shared_ptr<const EdgeAdjacency> adjacency;
  PartBorders borders;
};

/// The vertices around all rows of some columns.
Vertices around(int first, int last) {
  Vertices found;
  for (int row = 0; row < kSide; ++row) {
    for (int column = first; column <= last; ++column) {
      if (row == 0 || row == kQuads || column == first || column == last) found.insert(kSide * row + column);
    }
  }
  return found;
}

Vertices set_of(const VertexChain& chain) { return {chain.begin(), chain.end()}; }

std::vector<Vertices> sets_of(const std::vector<VertexChain>& chains) {
  std::vector<Vertices> found;
  for (const VertexChain& chain : chains) found.push_back(set_of(chain));
  return found;
}

/// A plate without the face in its middle.
Surface plate_with_hole() {
  shapes::QuadMesh plate = shapes::quad_grid(kQuads);
  std::erase(plate.quads, std::array<std::int32_t, 4>{14, 15, 21, 20});
  return plate.surface();
}

TEST(PartBorders, LeadAroundThePartsBesideAnEdge) {
  const Surface plate = shapes::quad_grid(kQuads).surface();
  Borders one(plate);
  one.parted(2);
  EXPECT_EQ(sets_of(one.borders.borders({2 + kSide, 2})), (std::vector{around(0, 2), around(2, 5)})) << "shorter first";
  EXPECT_EQ(sets_of(one.borders.borders({4, 5})), std::vector{around(2, 5)});
  EXPECT_TRUE(one.borders.borders({7, 8}).empty()) << "inside of a part";
  EXPECT_EQ(sets_of(one.parted(3).borders.borders({4, 5})), (std::vector{around(2, 5), around(3, 5)}));
  EXPECT_EQ(sets_of(one.borders.around(0)[0]), std::vector{around(0, 2)});
  EXPECT_EQ(sets_of(one.borders.around(0)[1]), std::vector{around(0, 3)});
}

TEST(PartBorders, OfAWholePieceAreOnlyItsBoundary) {
  const Surface plate = shapes::quad_grid(kQuads).surface();
  Borders whole(plate);
  whole.parted(kSide);
  EXPECT_TRUE(whole.borders.borders({0, 1}).empty());
  EXPECT_TRUE(whole.borders.around(0).front().empty());
  EXPECT_EQ(Tubes(whole.borders).rims({7, 8}), nullptr) << "a plate is no tube";
  EXPECT_EQ(Tubes(Borders(plate).borders).rims({7, 8}), nullptr) << "no parts are known";
}

TEST(PartBorders, EndBesideFacesThatAreTurnedInsideOut) {
  shapes::QuadMesh plate = shapes::quad_grid(kQuads);
  for (auto& quad : plate.quads) {
    if (quad[1] % kSide <= 2) std::ranges::reverse(quad);
  }
  Borders turned(plate.surface());
  EXPECT_EQ(sets_of(turned.parted(2).borders.borders({2, 2 + kSide})), (std::vector{around(0, 2), around(2, 5)}));
}

TEST(PartBorders, RefuseLabelsThatDoNotFit) {
  Borders plate(shapes::quad_grid(kQuads).surface());
  EXPECT_THROW(plate.borders.add_parts(Numbers(3, 0)), InvalidInput);
  EXPECT_THROW(plate.borders.add_parts(Numbers(plate.surface.face_count(), -1)), InvalidInput);
}

TEST(Tubes, ARingIsATubeWhoseInnerEdgesLeadOnFromEachOther) {
  Borders ring(plate_with_hole());
  ring.parted(kSide);
  Tubes tubes(ring.borders);
  ASSERT_NE(tubes.rims({7, 8}), nullptr);
  const std::vector<Vertices> rims = sets_of(*tubes.rims({7, 8}));
  EXPECT_EQ(std::set(rims.begin(), rims.end()), (std::set{Vertices{14, 15, 20, 21}, around(0, 5)}));
  EXPECT_EQ(tubes.rims({0, 1}), nullptr) << "edges of the rims do not lie inside";
  EXPECT_EQ(tubes.rims({14, 15}), nullptr);
  const std::vector<Edge> beside = tubes.beside({7, 8});
  EXPECT_EQ(std::set(beside.begin(), beside.end()), (std::set<Edge>{{7, 1}, {7, 6}, {7, 13}, {8, 2}, {8, 9}, {8, 14}}));
  Borders half(plate_with_hole());
  EXPECT_EQ(Tubes(half.parted(2).borders).rims({10, 16}), nullptr) << "half a ring is no tube";
}

TEST(FlatFace, EndsWhereThePlateIsBent) {
  shapes::QuadMesh plate = shapes::quad_grid(kQuads);
  EXPECT_EQ(set_of(Borders(plate.surface()).borders.flat_face(7)), around(0, 5));
  for (Vector& p : plate.points) {
    const double right = std::max(p.x() - 0.4, 0.0);
    p += Vector(right * (std::cos(kPi / 9) - 1.0), 0.0, right * std::sin(kPi / 9));
  }
  const Borders bent(plate.surface());
  EXPECT_EQ(set_of(bent.borders.flat_face(0)), around(0, 2));
  EXPECT_EQ(set_of(bent.borders.flat_face(2 * (kQuads - 1))), around(2, 5));
}

TEST(FlatFace, HasItsOuterBorderUnlessThatIsTooLong) {
  EXPECT_EQ(set_of(Borders(plate_with_hole()).borders.flat_face(0)), around(0, 5));
  const int count = 20'100;
  shapes::Mesh disc;
  disc.points.emplace_back(0, 0, 0);
  std::vector<Edge> rim;
  for (std::int32_t i = 0; i < count; ++i) {
    disc.points.emplace_back(std::cos(2 * kPi * i / count), std::sin(2 * kPi * i / count), 0);
    disc.triangles.push_back({0, 1 + i, 1 + (i + 1) % count});
    rim.push_back({1 + i, 1 + (i + 1) % count});
  }
  EXPECT_TRUE(Borders(Surface(disc.points, disc.triangles, rim)).borders.flat_face(0).empty());
}

/// The vertices around a box of quads of a grid, counterclockwise.
VertexChain box(int quads, int left, int low, int width, int height) {
  VertexChain found;
  const auto add = [&](int x, int y) { found.push_back((quads + 1) * y + x); };
  for (int x = 0; x < width; ++x) add(left + x, low);
  for (int y = 0; y < height; ++y) add(left + width, low + y);
  for (int x = width; x > 0; --x) add(left + x, low + height);
  for (int y = height; y > 0; --y) add(left, low + y);
  return found;
}

void expect_turns(const PartBorders& borders, const VertexChain& chain, const std::vector<double>& degrees) {
  const std::vector<double> turns = borders.turns(chain);
  ASSERT_EQ(turns.size(), degrees.size());
  for (std::size_t i = 0; i < turns.size(); ++i) EXPECT_NEAR(turns[i] * 180 / kPi, degrees[i], 1e-9) << i;
}

TEST(Turns, OfABoxAreRightAnglesAtItsCorners) {
  const Borders sheet(shapes::quad_grid(8).surface());
  expect_turns(sheet.borders, box(8, 2, 2, 3, 2), {90, 0, 0, 90, 0, 90, 0, 0, 90, 0});
  expect_turns(sheet.borders, box(8, 2, 0, 3, 2), {90, 0, 0, 90, 0, 90, 0, 0, 90, 0});
  expect_turns(sheet.borders, box(8, 0, 0, 8, 8), std::vector<double>(32, 0.0));  // along the boundary
  VertexChain back = box(8, 2, 2, 3, 2);
  std::ranges::reverse(back);
  const std::vector<double> turns = sheet.borders.turns(back);
  EXPECT_NEAR(std::accumulate(turns.begin(), turns.end(), 0.0), -2 * kPi, 1e-12);
}

TEST(Turns, AreZeroOverTheRimsOfAThinPlateAndInTheMiddleOfALargeFan) {
  shapes::QuadMesh cube = shapes::quad_cube(2);
  VertexChain ring;
  for (Vector& p : cube.points) p.z() *= 0.01;
  const auto number = [&](double x, double z) {
    const auto at = std::ranges::find_if(cube.points, [&](const Vector& p) { return p.isApprox(Vector(x, 0.5, z)); });
    return static_cast<std::int32_t>(at - cube.points.begin());
  };
  for (const auto& [x, z] : {std::pair{0, 0}, {0, 1}, {0, 2}, {1, 2}, {2, 2}, {2, 1}, {2, 0}, {1, 0}}) {
    ring.push_back(number(0.5 * x, 0.005 * z));
  }
  const Borders plate(cube.surface());
  expect_turns(plate.borders, ring, std::vector<double>(8, 0.0));
  EXPECT_FALSE(plate.borders.is_hairpin(ring));
  shapes::Mesh fan;
  const int count = 2000;
  for (std::int32_t i = 0; i < count; ++i) {
    fan.points.emplace_back(std::cos(2 * kPi * i / count), std::sin(2 * kPi * i / count), 0);
    fan.triangles.push_back({i, (i + 1) % count, count});
  }
  fan.points.emplace_back(0, 0, 0);
  const Borders large(fan.surface());
  EXPECT_NEAR(large.borders.turns(VertexChain{count, 0, 1})[0], kPi - 2 * kPi / count, 1e-12);
  EXPECT_EQ(large.borders.turns(VertexChain{0, count, count / 2})[1], 0.0);
}

TEST(Hairpin, IsANarrowBoxOrATinyCircle) {
  const Borders sheet(shapes::quad_grid(8).surface());
  for (const auto& [width, height, is_hairpin] : std::vector<std::tuple<int, int, bool>>{
           {1, 6, true}, {6, 1, true}, {3, 1, true}, {2, 1, false}, {6, 3, false}, {1, 1, false}}) {
    VertexChain chain = box(8, 1, 1, width, height);
    EXPECT_EQ(sheet.borders.is_hairpin(chain), is_hairpin) << width << " x " << height;
    std::ranges::reverse(chain);
    EXPECT_EQ(sheet.borders.is_hairpin(chain), is_hairpin) << width << " x " << height;
  }
  EXPECT_TRUE(Borders(shapes::quad_grid(40).surface()).borders.is_hairpin(box(40, 1, 1, 1, 1)));
}

TEST(CountCorners, CountsWhereStraightWaysLeaveALoop) {
  const int n = 16;
  const Surface tube = shapes::quad_cylinder(n, 8).surface();
  const auto corners = [&](std::vector<std::pair<int, int>> places) {
    VertexChain loop;
    for (const auto& [x, row] : places) loop.push_back(n * row + x);
    return count_corners(tube, *make_edge_adjacency(tube), loop);
  };
  std::vector<std::pair<int, int>> ring;
  for (int x = 0; x < n; ++x) ring.emplace_back(x, 4);
  EXPECT_EQ(corners(ring), 0);
  std::ranges::reverse(ring);
  EXPECT_EQ(corners(ring), 0);
  EXPECT_EQ(corners({{0, 3}, {1, 3}, {2, 3}, {2, 4}, {2, 5}, {1, 5}, {0, 5}, {0, 4}}), 4);
  EXPECT_EQ(corners({{0, 0}, {1, 0}, {2, 0}, {2, 1}, {1, 1}, {0, 1}}), 2) << "no way leads straight across the rim";
}

TEST(CountCorners, CountsNoneWhereThreeEdgesMeet) {
  const shapes::QuadMesh cube = shapes::quad_cube(1);
  const Surface surface = cube.surface();
  for (auto quad : cube.quads) {
    EXPECT_EQ(count_corners(surface, *make_edge_adjacency(surface), quad), 0);
    std::ranges::reverse(quad);
    EXPECT_EQ(count_corners(surface, *make_edge_adjacency(surface), quad), 0);
  }
}

}  // namespace
}  // namespace seamwire::detail
