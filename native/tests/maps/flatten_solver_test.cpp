// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>
#include <stop_token>

#include "maps/dirichlet_kernels.hpp"
#include "maps/symmetric_dirichlet.hpp"
#include "numeric/block_cholesky.hpp"
#include "same_bits.hpp"
#include "shapes.hpp"
#include "triangle_edges.hpp"

namespace seamwire {

using namespace detail;

namespace {

/// Some triangles in space and a map of them without flips.
struct Mapped {
  std::vector<Triangle> triangles;
  std::vector<Vector> points;
  std::vector<double> map;
};

Mapped random_map(std::size_t count, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> number(-1.0, 1.0);
  Mapped mapped;
  while (mapped.triangles.size() < count) {
    const auto first = static_cast<std::int32_t>(mapped.points.size());
    std::array<Eigen::Vector2d, 3> uvs;
    for (Eigen::Vector2d& uv : uvs) uv = {number(random), number(random)};
    const Eigen::Vector2d ab = uvs[1] - uvs[0], ac = uvs[2] - uvs[0];
    if (ab.x() * ac.y() - ab.y() * ac.x() < 0.05) continue;
    mapped.triangles.push_back({first, first + 1, first + 2});
    for (const Eigen::Vector2d& uv : uvs) {
      mapped.points.emplace_back(number(random), number(random), number(random));
      mapped.map.insert(mapped.map.end(), {uv.x(), uv.y()});
    }
  }
  return mapped;
}

std::vector<double> numbers_of(const Derivatives& d) {
  std::vector<double> numbers;
  for (const auto* array : {&d.g1x, &d.g1y, &d.g2x, &d.g2y, &d.h11xx, &d.h11xy, &d.h11yy, &d.h12xx, &d.h12xy, &d.h12yx,
                            &d.h12yy, &d.h22xx, &d.h22xy, &d.h22yy}) {
    numbers.insert(numbers.end(), std::begin(*array), std::end(*array));
  }
  return numbers;
}

TEST(DirichletKernels, AllInstructionSetsGiveTheSameBits) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> number(-1.0, 1.0);
  std::array<std::vector<double>, 5> shapes;
  for (auto& array : shapes) {
    for (std::size_t i = 0; i < kTrianglesAtOnce; ++i) array.push_back(number(random));
  }
  const RestShapes rest{shapes[0].data(), shapes[1].data(), shapes[2].data(), shapes[3].data(), shapes[4].data()};
  Sides sides{}, moves{};
  for (Sides* of : {&sides, &moves}) {
    for (auto* array : {&of->e1x, &of->e1y, &of->e2x, &of->e2y}) {
      for (double& value : *array) value = number(random);
    }
  }
  for (const std::size_t count : {kTrianglesAtOnce, std::size_t{7}, std::size_t{1}}) {
    expect_same_bits<DirichletKernels>(dirichlet_kernels(), [&](const DirichletKernels& kernels) {
      std::array<double, kTrianglesAtOnce> energies{}, flips{};
      kernels.energies(rest, sides, count, energies.data());
      kernels.first_flips(sides, moves, count, flips.data());
      Derivatives derivatives{};
      kernels.derivatives(rest, sides, count, derivatives);
      std::vector<double> all = numbers_of(derivatives);
      for (const auto* array : {&energies, &flips}) all.insert(all.end(), array->begin(), array->end());
      return all;
    });
  }
}

TEST(SymmetricDirichlet, IsFourForAnIsometryAndKnowsItsStretch) {
  const SymmetricDirichlet energy({{0, 1, 2}}, std::vector<Vector>{{0, 0, 0}, {3, 0, 4}, {0, 2, 0}});
  const double unit = energy.unit();
  EXPECT_EQ(unit, 2.0) << "a power of two";
  EXPECT_NEAR(unit * unit * energy.area(), 5.0, 1e-12);
  EXPECT_NEAR(energy.energy(std::vector<double>{0, 0, 5 / unit, 0, 0, 2 / unit}), 4.0, 1e-12);
  // Twice as long, half as high: 4 + 1/4 + 1/4 + 4.
  EXPECT_NEAR(energy.energy(std::vector<double>{0, 0, 10 / unit, 0, 0, 1 / unit}), 8.5, 1e-12);
  const auto parts = energy.parts(std::vector<double>{0, 0, 15 / unit, 0, 0, 2 / unit});
  EXPECT_NEAR(parts[0][0], 10.0, 1e-12);
  EXPECT_NEAR(parts[0][1], 1.0 + 1.0 / 9.0, 1e-12);
  EXPECT_EQ(energy.energy(std::vector<double>{0, 0, 0, 1, 1, 0}), std::numeric_limits<double>::infinity());
}

TEST(SymmetricDirichlet, DerivativesAreThoseOfDifferences) {
  Mapped mapped = random_map(70, 4);              // more than a kernel takes at once
  for (double& value : mapped.map) value *= 0.5;  // shrunk triangles have a negative twist
  const SymmetricDirichlet energy(mapped.triangles, mapped.points);
  BlockCholesky solver(mapped.points.size(), edges_of(mapped.triangles), {});
  std::vector<TriangleBlocks> blocks;
  for (const auto& [a, b, c] : mapped.triangles) {
    blocks.push_back({solver.block(a, a), solver.block(b, b), solver.block(c, c), solver.block(a, b),
                      solver.block(b, c), solver.block(c, a)});
  }
  std::vector<double> gradient(mapped.map.size(), 0.0);
  solver.clear();
  energy.add_derivatives(mapped.map, blocks, gradient, solver.values());
  constexpr double kStep = 1e-5;
  std::size_t unchanged = 0;
  for (std::size_t f = 0; f < mapped.triangles.size(); ++f) {
    Eigen::Matrix<double, 6, 6> hessian, differences;
    const auto energy_at = [&](std::size_t i, double di, std::size_t j, double dj) {
      std::vector<double> map = mapped.map;
      map[6 * f + i] += di;
      map[6 * f + j] += dj;
      return energy.weights()[f] * energy.energies(map)[f];
    };
    for (std::uint32_t i = 0; i < 6; ++i) {
      const double slope = (energy_at(i, kStep, i, 0) - energy_at(i, -kStep, i, 0)) / (2 * kStep);
      EXPECT_NEAR(gradient[6 * f + i], slope, 1e-6 * (1.0 + std::abs(slope)));
      for (std::uint32_t j = 0; j < 6; ++j) {
        const auto a = static_cast<std::int32_t>(3 * f + std::max(i, j) / 2);
        const auto b = static_cast<std::int32_t>(3 * f + std::min(i, j) / 2);
        const BlockEntry at = solver.block(a, b);
        hessian(i, j) = solver.values()[at.offset + std::max(i, j) % 2 * at.row + std::min(i, j) % 2 * at.column];
        differences(i, j) = (energy_at(i, kStep, j, kStep) - energy_at(i, kStep, j, -kStep) -
                             energy_at(i, -kStep, j, kStep) + energy_at(i, -kStep, j, -kStep)) /
                            (4 * kStep * kStep);
      }
    }
    using Solver = Eigen::SelfAdjointEigenSolver<Eigen::Matrix<double, 6, 6>>;
    const double tolerance = 1e-4 * differences.norm();  // of second differences with this step
    EXPECT_GT(Solver(hessian).eigenvalues().minCoeff(), -1e-9 * differences.norm()) << "positive semidefinite";
    // Only the twist may be negative: one eigenvalue is raised then, and nothing changes otherwise.
    const Eigen::Matrix<double, 6, 1> added = Solver(hessian - differences).eigenvalues();
    EXPECT_GT(added[0], -tolerance);
    EXPECT_LT(added[4], tolerance);
    if (added[5] > tolerance) continue;
    EXPECT_GT(Solver(differences).eigenvalues().minCoeff(), -2 * tolerance);
    ++unchanged;
  }
  EXPECT_GT(unchanged, 10U);
  EXPECT_LT(unchanged, 60U);
}

TEST(SymmetricDirichlet, FirstFlipIsWhereATriangleHasNoArea) {
  const Mapped mapped = random_map(70, 9);
  const SymmetricDirichlet energy(mapped.triangles, mapped.points);
  std::mt19937 random(2);
  std::uniform_real_distribution<double> number(-1.0, 1.0);
  std::vector<double> direction(mapped.map.size());
  for (double& value : direction) value = number(random);
  const double step = energy.first_flip(mapped.map, direction);
  ASSERT_TRUE(std::isfinite(step));
  const auto moved = [&](double by) {
    std::vector<double> map = mapped.map;
    for (std::size_t i = 0; i < map.size(); ++i) map[i] += by * direction[i];
    return map;
  };
  EXPECT_TRUE(std::isfinite(energy.energy(moved(0.999 * step))));
  EXPECT_TRUE(std::isinf(energy.energy(moved(1.001 * step))));
  // Growing keeps all triangles as they are turned.
  EXPECT_TRUE(std::isinf(energy.first_flip(mapped.map, mapped.map)));
}

TEST(SymmetricDirichlet, MovedRestShapesLimitTheEnergy) {
  Mapped mapped = random_map(70, 6);
  for (std::size_t i = 0; i < mapped.map.size(); ++i) mapped.map[i] *= i % 2 == 0 ? 1e-3 : 1.0;
  SymmetricDirichlet energy(mapped.triangles, mapped.points);
  const double before = energy.energy(mapped.map);
  EXPECT_EQ(energy.move_rest_shapes(mapped.map, 20.0), 70U);
  for (const double value : energy.energies(mapped.map)) {
    EXPECT_GT(value, 10.0 * (1 - 1e-6));
    EXPECT_LT(value, 20.0 * (1 + 1e-6));
  }
  EXPECT_EQ(energy.move_rest_shapes(mapped.map, std::numeric_limits<double>::infinity()), 0U);
  EXPECT_EQ(energy.energy(mapped.map), before);
}

}  // namespace
}  // namespace seamwire
