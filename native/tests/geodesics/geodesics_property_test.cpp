// SPDX-License-Identifier: GPL-3.0-or-later
//
// Properties of exact geodesics on any mesh. They agree with a plain solver of another kind, and no path over points on
// the edges is shorter. Traced paths are as long as the distances. Distances are symmetric in their ends.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <queue>
#include <random>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "intrinsic.hpp"
#include "paths.hpp"
#include "reference_geodesics.hpp"
#include "seamwire/geodesics/exact_geodesics.hpp"

namespace seamwire {
namespace {

using paths::index;
using shapes::Mesh;

double uniform(std::mt19937& random, double low, double high) {
  return std::uniform_real_distribution<double>(low, high)(random);
}

Mesh jittered_grid(std::mt19937& random) {
  const int n = 5 + static_cast<int>(random() % 6U);
  Mesh mesh = shapes::grid(n, uniform(random, 0.0, 0.4), static_cast<unsigned>(random()));
  const double height = uniform(random, 0.0, 0.3);  // 0: a plane; else vertices of more and of less than a full turn
  for (Vector& p : mesh.points) p.z() = uniform(random, 0.0, height) / n;
  return mesh;
}

Mesh sphere_with_holes(std::mt19937& random) {
  Mesh mesh = shapes::bumpy(shapes::icosphere(2), uniform(random, 0.0, 0.12), static_cast<unsigned>(random()));
  for (int holes = static_cast<int>(random() % 4U); holes > 0; --holes) {
    const Vector center = mesh.points[random() % mesh.points.size()];
    const double radius = uniform(random, 0.1, 0.3);
    mesh = shapes::without(mesh, [&](const Vector& p) { return (p - center).norm() < radius; });
  }
  return mesh;
}

/// Any triangles of a few points: most edges have three faces or more, and faces turn any way.
Mesh soup(std::mt19937& random) {
  Mesh mesh;
  const auto count = 6 + random() % 6U, triangles = count + random() % (2 * count);
  for (std::size_t v = 0; v < count; ++v) {
    const double x = uniform(random, 0, 1), y = uniform(random, 0, 1), z = uniform(random, 0, 1);
    mesh.points.emplace_back(x, y, z);
  }
  std::set<std::set<std::int32_t>> seen;
  for (std::size_t f = 0; f < triangles; ++f) {
    const auto vertex = [&] { return static_cast<std::int32_t>(random() % count); };
    const Triangle triangle{vertex(), vertex(), vertex()};
    const std::set<std::int32_t> corners(triangle.begin(), triangle.end());
    if (corners.size() == 3 && seen.insert(corners).second) mesh.triangles.push_back(triangle);
  }
  return mesh;
}

/// A jittered grid with fins on some of its edges, and fins on fins; some faces turned over.
Mesh grid_with_fins(std::mt19937& random) {
  Mesh mesh = jittered_grid(random);
  for (std::size_t fins = 5 + random() % 20U; fins > 0; --fins) {
    const Triangle on = mesh.triangles[random() % mesh.triangles.size()];
    const std::size_t side = random() % 3U;
    const double height = uniform(random, 0.05, 0.3), aside = uniform(random, -0.1, 0.1);
    const Vector middle = 0.5 * (mesh.points[index(on[side])] + mesh.points[index(on[(side + 1) % 3])]);
    mesh.triangles.push_back({on[side], on[(side + 1) % 3], static_cast<std::int32_t>(mesh.points.size())});
    mesh.points.emplace_back(middle + Vector(aside, -aside, height));
  }
  for (Triangle& triangle : mesh.triangles) {
    if (random() % 3U == 0) std::swap(triangle[0], triangle[1]);
  }
  return mesh;
}

/// One of several kinds of lengths for a mesh: those of its points, those of its points in stretched space, and lengths
/// that no surface in space has. The latter fulfill the triangle inequality. They lie between 1 and 2, or are sums of
/// two radii, one of each end, which makes needles.
IntrinsicMesh with_lengths(const Mesh& mesh, unsigned kind, std::mt19937& random) {
  switch (kind % 4U) {
    case 0:
      return shapes::intrinsic(mesh);
    case 1:
      return shapes::intrinsic(mesh,
                               Eigen::Matrix3d(Vector(uniform(random, 1, 6), uniform(random, 1, 6), 1).asDiagonal()));
    case 2:
      return shapes::intrinsic(mesh, [&](int, int) { return uniform(random, 1.01, 2.0); });
    default: {
      std::vector<double> radii;
      for (std::size_t v = 0; v < mesh.points.size(); ++v) radii.push_back(std::exp(uniform(random, -1.5, 1.5)));
      return shapes::intrinsic(mesh, [&](int a, int b) { return radii[index(a)] + radii[index(b)]; });
    }
  }
}

/// Lengths of the shortest paths over `m` points on each edge, joined by straight lines in each triangle: never shorter
/// than geodesics, and near them where m is large.
std::vector<double> over_points_on_edges(const IntrinsicMesh& mesh, int m, std::int32_t seed) {
  std::vector<std::vector<std::pair<std::size_t, double>>> links(index(mesh.vertex_count));
  std::map<std::int32_t, std::vector<std::size_t>> on_edge;  // by the edge's first half-edge, in its direction
  const auto points_of = [&](std::int32_t h) {
    std::int32_t first = h;
    paths::for_each_beyond(mesh, h, [&](std::int32_t other) { first = std::min(first, other); });
    const bool is_turned = mesh.tail(first) != mesh.tail(h);
    std::vector<std::size_t>& points = on_edge[first];
    if (points.empty()) {
      for (int i = 0; i < m; ++i) {
        points.push_back(links.size());
        links.emplace_back();
      }
    }
    return is_turned ? std::vector<std::size_t>(points.rbegin(), points.rend()) : points;
  };
  for (std::int32_t f = 0; index(f) < mesh.face_count(); ++f) {
    std::vector<std::pair<std::size_t, Eigen::Vector2d>> places;
    for (std::int32_t h = 3 * f; h < 3 * f + 3; ++h) {
      places.emplace_back(index(mesh.tail(h)), paths::place(mesh, f, {mesh.tail(h), -1, 0.0}));
      double t = 0.0;
      for (const std::size_t point : points_of(h)) {
        t += 1.0 / (m + 1);
        places.emplace_back(point, paths::place(mesh, f, {-1, h, t}));
      }
    }
    for (const auto& [a, at_a] : places) {
      for (const auto& [b, at_b] : places) {
        if (a != b) links[a].emplace_back(b, (at_a - at_b).norm());
      }
    }
  }
  std::vector<double> result(links.size(), std::numeric_limits<double>::infinity());
  using Entry = std::pair<double, std::size_t>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
  result[index(seed)] = 0.0;
  queue.emplace(0.0, index(seed));
  while (!queue.empty()) {
    const auto [distance, from] = queue.top();
    queue.pop();
    if (distance > result[from]) continue;
    for (const auto& [to, length] : links[from]) {
      if (distance + length >= result[to]) continue;
      result[to] = distance + length;
      queue.emplace(result[to], to);
    }
  }
  result.resize(index(mesh.vertex_count));
  return result;
}

/// What "exact" means: rounding is some 1e-14, and grows with the number of triangles and their aspect.
constexpr double kExact = 1e-9;

class OnRandomMeshes : public testing::TestWithParam<unsigned> {
 protected:
  void check(const Mesh& shape, std::mt19937& random) const {
    const IntrinsicMesh mesh = with_lengths(shape, GetParam(), random);
    const ExactGeodesics geodesics(mesh);
    const reference::Geodesics reference(mesh);
    std::vector<DistanceField> fields;
    for (int i = 0; i < 3; ++i) {
      fields.push_back(geodesics.solve(shape.triangles[random() % shape.triangles.size()][0]));
    }
    for (const DistanceField& field : fields) {
      const std::vector<double>& found = field.distances();
      const std::vector<double> expected = reference.distances(field.seed());
      const std::vector<double> longer = over_points_on_edges(mesh, 6, field.seed());
      double excess = 0.0;
      std::size_t reached = 0;
      for (std::int32_t v = 0; v < mesh.vertex_count; ++v) {
        const double d = found[index(v)];
        ASSERT_EQ(std::isinf(d), std::isinf(expected[index(v)]));
        ASSERT_EQ(std::isinf(d), std::isinf(longer[index(v)]));
        if (std::isinf(d) || v == field.seed()) continue;
        EXPECT_NEAR(d, expected[index(v)], kExact * d) << "vertex " << v;
        EXPECT_LE(d, longer[index(v)] * (1 + 1e-12)) << "vertex " << v;
        excess += longer[index(v)] / d - 1;
        ++reached;
        const IntrinsicPath path = field.trace(v).value();
        EXPECT_NEAR(path.length, d, kExact * d) << "vertex " << v;
        EXPECT_NEAR(paths::length_of(mesh, path), d, kExact * d) << "vertex " << v;
      }
      // Six points an edge: directions are off by a few degrees, whose cosine this is.
      EXPECT_LT(excess, 0.02 * static_cast<double>(reached));
      for (const DistanceField& other : fields) {
        const double there = found[index(other.seed())], back = other.distances()[index(field.seed())];
        if (std::isfinite(there)) {
          EXPECT_NEAR(there, back, kExact * there);
        } else {
          EXPECT_EQ(there, back);
        }
      }
    }
  }
};

TEST_P(OnRandomMeshes, ExactIsExactOnJitteredGrids) {
  std::mt19937 random(GetParam());
  check(jittered_grid(random), random);
}

TEST_P(OnRandomMeshes, ExactIsExactOnSpheresWithHoles) {
  std::mt19937 random(1000 + GetParam());
  check(sphere_with_holes(random), random);
}

TEST_P(OnRandomMeshes, ExactIsExactOnTriangleSoups) {
  std::mt19937 random(2000 + GetParam());
  check(soup(random), random);
}

TEST_P(OnRandomMeshes, ExactIsExactOnGridsWithFins) {
  std::mt19937 random(3000 + GetParam());
  check(grid_with_fins(random), random);
}

// Four kinds of lengths, six meshes each.
INSTANTIATE_TEST_SUITE_P(Seeds, OnRandomMeshes, testing::Range(0U, 24U));

}  // namespace
}  // namespace seamwire
