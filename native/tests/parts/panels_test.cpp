// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <numbers>
#include <random>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "seamwire_uv/parts/part_finder.hpp"
#include "shapes.hpp"
#include "surface/real_edges.hpp"

namespace seamwire {
namespace {

constexpr int kFine = 8;

/// Two layers, in front (z > 0) and behind, over the cells that are '#'. They meet in round sides, and are open beside
/// cells that are 'o'. Mirrored in x if the rows are.
shapes::QuadMesh pillow(const std::vector<std::string>& rows) {
  const int height = static_cast<int>(rows.size()), width = static_cast<int>(rows.front().size());
  const auto cell = [&](int i, int j) {
    const int x = i < 0 ? -1 : i / kFine, y = j < 0 ? -1 : j / kFine;
    if (x < 0 || x >= width || y < 0 || y >= height) return ' ';
    return rows[static_cast<std::size_t>(y)][static_cast<std::size_t>(x)];
  };
  std::vector<std::array<int, 2>> sides;  // where the layers meet
  const auto beside = [&](int i, int j, char what) {
    return cell(i - 1, j - 1) == what || cell(i, j - 1) == what || cell(i - 1, j) == what || cell(i, j) == what;
  };
  for (int j = 0; j <= height * kFine; ++j) {
    for (int i = 0; i <= width * kFine; ++i) {
      if (beside(i, j, '#') && beside(i, j, ' ')) sides.push_back({i, j});
    }
  }
  shapes::QuadMesh mesh;
  std::map<std::array<int, 3>, std::int32_t> numbers;
  const auto vertex = [&](int i, int j, int layer) {
    double away = 1.0;
    for (const auto& [x, y] : sides) away = std::min(away, std::hypot(i - x, j - y) / kFine);
    if (away == 0.0) layer = 0;
    const auto [it, is_new] = numbers.try_emplace({i, j, layer}, static_cast<std::int32_t>(mesh.points.size()));
    if (is_new) {
      const double round = std::sqrt(1.0 - (1.0 - away) * (1.0 - away));
      mesh.points.emplace_back(static_cast<double>(i) / kFine - width / 2.0, -static_cast<double>(j) / kFine,
                               0.8 * layer * round);
    }
    return it->second;
  };
  for (int j = 0; j < height * kFine; ++j) {
    for (int i = 0; i < width * kFine; ++i) {
      if (cell(i, j) != '#') continue;
      mesh.quads.push_back({vertex(i, j, 1), vertex(i, j + 1, 1), vertex(i + 1, j + 1, 1), vertex(i + 1, j, 1)});
      mesh.quads.push_back({vertex(i, j, -1), vertex(i + 1, j, -1), vertex(i + 1, j + 1, -1), vertex(i, j + 1, -1)});
    }
  }
  return mesh;
}

const std::vector<std::string> kShirt{"    oo    ", "o########o", "o########o", "   ####   ",
                                      "   ####   ", "   ####   ", "   oooo   "};
const std::vector<std::string> kTrousers{"ooooo", "#####", "#####", "## ##", "## ##", "## ##", "## ##", "oo oo"};
const std::vector<std::string> kHeart{" ##  ## ", "########", "########", " ###### ", "  ####  ", "   ##   "};

Parts parts_of(const shapes::QuadMesh& mesh, const PartOptions& options, PartsBy expected,
               const PartEdits& edits = {}) {
  const PartFinder finder(std::make_shared<const Surface>(mesh.surface()), options);
  EXPECT_EQ(finder.by(), expected);
  return finder.find(0.5, edits);
}

Vector center(const shapes::QuadMesh& mesh, std::size_t quad) {
  Vector sum = Vector::Zero();
  for (const std::int32_t v : mesh.quads[quad]) sum += mesh.points[static_cast<std::size_t>(v)];
  return sum / 4.0;
}

/// Whether all borders run where the layers meet, so that they are straight and mirrored.
void expect_front_and_back(const shapes::QuadMesh& mesh, const Parts& parts) {
  EXPECT_EQ(parts.count, 2u);
  for (std::size_t q = 0; q < mesh.quads.size(); ++q) {
    EXPECT_EQ(parts.of_face[2 * q] == parts.of_face[0], center(mesh, q).z() > 0.0) << "quad " << q;
  }
}

TEST(Panels, AreTheFrontAndTheBackOfClothes) {
  for (const auto& rows : {kShirt, kTrousers}) {
    const shapes::QuadMesh mesh = pillow(rows);
    expect_front_and_back(mesh, parts_of(mesh, {.by = PartsBy::kShape, .mirror = 0}, PartsBy::kPanels));
    EXPECT_EQ(parts_of(mesh, {.by = PartsBy::kRims}, PartsBy::kRims).count, 1u);
  }
}

TEST(Panels, AreForClothesOnlyUnlessAskedFor) {
  const shapes::QuadMesh heart = pillow(kHeart);
  EXPECT_EQ(parts_of(heart, {.by = PartsBy::kShape}, PartsBy::kRims).count, 1u);
  expect_front_and_back(heart, parts_of(heart, {.by = PartsBy::kPanels}, PartsBy::kPanels));
  EXPECT_EQ(parts_of(shapes::quad_cylinder(24, 12), {.by = PartsBy::kShape}, PartsBy::kLimbs).count, 1u)
      << "two open boundaries";
  EXPECT_EQ(parts_of(shapes::quad_cube(4), {.by = PartsBy::kShape}, PartsBy::kRims).count, 1u) << "a net";
}

TEST(Panels, FaceTheFrontThatIsGiven) {
  const shapes::QuadMesh tube = shapes::quad_cylinder(24, 12);
  for (const double turn : {0.0, 0.5, 2.0}) {
    const Vector front(std::cos(turn), std::sin(turn), 0.0);
    const Parts parts = parts_of(tube, {.by = PartsBy::kPanels, .front = front}, PartsBy::kPanels);
    EXPECT_EQ(parts.count, 2u);
    for (std::size_t q = 0; q < tube.quads.size(); ++q) {
      const Vector at = center(tube, q) - Vector(0, 0, center(tube, q).z());
      for (std::size_t other = 0; other < tube.quads.size(); ++other) {
        const Vector opposite = center(tube, other) - Vector(0, 0, center(tube, other).z());
        if (at.dot(front) < 0.1 || opposite.dot(front) > -0.1) continue;
        EXPECT_NE(parts.of_face[2 * q], parts.of_face[2 * other]);
      }
    }
  }
}

TEST(Panels, BordersFollowLinesOfEdges) {
  for (unsigned seed = 0; seed < 8; ++seed) {  // the sides of a rough tube face front and back at random
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> factor(0.98, 1.02);
    shapes::QuadMesh tube = shapes::quad_cylinder(24, 16);
    for (Vector& p : tube.points) p.head<2>() *= factor(random);
    const Parts parts = parts_of(tube, {.by = PartsBy::kPanels, .front = Vector(1, 0, 0)}, PartsBy::kPanels);
    ASSERT_EQ(parts.borders.size(), 2u);
    for (const std::vector<std::int32_t>& chain : parts.borders) {
      EXPECT_EQ(chain.size(), 17u) << "seed " << seed;
      for (const std::int32_t v : chain) EXPECT_EQ(v % 24, chain.front() % 24);
    }
  }
}

TEST(Panels, LiningsBelongToTheSideAroundThem) {
  // A tube whose lower half is lined. A round hem joins both layers.
  constexpr int kAround = 24;
  std::vector<std::array<double, 2>> profile;  // radius and height
  for (int i = 0; i <= 12; ++i) profile.push_back({0.5, 1.0 - i / 12.0});
  for (int i = 1; i < 6; ++i) {
    const double a = std::numbers::pi * i / 6.0;
    profile.push_back({0.4 + 0.1 * std::cos(a), -0.1 * std::sin(a)});
  }
  for (int i = 0; i <= 6; ++i) profile.push_back({0.3, i / 12.0});
  std::ranges::reverse(profile);  // so that it looks outwards
  const int rings = static_cast<int>(profile.size());
  const shapes::QuadMesh tube = shapes::parametric_quads(kAround, rings - 1, true, false, [&](double u, double v) {
    const auto [radius, height] = profile[static_cast<std::size_t>(std::lround(v * (rings - 1)))];
    const double a = 2.0 * std::numbers::pi * (u + 0.5 / kAround);
    return Vector(radius * std::cos(a), radius * std::sin(a), height);
  });
  const PartFinder finder(std::make_shared<const Surface>(tube.surface()),
                          {.by = PartsBy::kPanels, .front = Vector(1, 0, 0)});
  const Parts parts = finder.find(0.2);  // without a border at the hem
  EXPECT_EQ(parts.count, 2u);
  for (std::size_t q = 0; q < tube.quads.size(); ++q) {
    const std::size_t outside = tube.quads.size() - kAround + q % kAround;
    EXPECT_EQ(parts.of_face[2 * q], parts.of_face[2 * outside]) << "as in the uppermost ring";
  }
}

TEST(Panels, EditsOutweighThem) {
  const shapes::QuadMesh shirt = pillow(kShirt);
  const PartFinder finder(std::make_shared<const Surface>(shirt.surface()), {.by = PartsBy::kShape});
  const Parts before = finder.find();
  ASSERT_FALSE(before.borders.empty());
  PartEdits edits;
  for (const std::vector<std::int32_t>& chain : before.borders) {
    for (std::size_t i = 1; i < chain.size(); ++i) edits.dropped.push_back({chain[i - 1], chain[i]});
  }
  EXPECT_EQ(finder.find(0.5, edits).count, 1u);
  EXPECT_EQ(finder.find(0.5, {.parted = {0}}).count, 3u);
  EXPECT_EQ(finder.find(0.0).count, 1u);
}

TEST(Panels, AreCutAlikeOnMirroredPieces) {
  // A pair of tubes that lean to the sides; without a front each has its own.
  const shapes::QuadMesh one = shapes::quad_cylinder(20, 12, 0.2);
  shapes::QuadMesh both;
  for (const double side : {1.0, -1.0}) {
    const auto first = static_cast<std::int32_t>(both.points.size());
    for (const Vector& p : one.points) both.points.emplace_back(side * (1.0 + p.x() + 0.4 * p.z()), 0.5 * p.y(), p.z());
    for (auto [a, b, c, d] : one.quads) {
      if (side < 0.0) std::swap(b, d);
      both.quads.push_back({first + a, first + b, first + c, first + d});
    }
  }
  const Parts parts = parts_of(both, {.by = PartsBy::kPanels, .mirror = 0}, PartsBy::kPanels);
  EXPECT_EQ(parts.count, 4u);
  std::set<std::array<std::int32_t, 2>> pairs;
  for (std::size_t q = 0; q < one.quads.size(); ++q) {
    pairs.insert({parts.of_face[2 * q], parts.of_face[2 * (q + one.quads.size())]});
  }
  EXPECT_EQ(pairs.size(), 2u);
}

}  // namespace
}  // namespace seamwire
