// SPDX-License-Identifier: GPL-3.0-or-later
#include "numeric/block_cholesky.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cstdint>
#include <limits>
#include <random>
#include <stop_token>
#include <vector>

#include "numeric/cholesky_kernels.hpp"
#include "same_bits.hpp"
#include "seamwire/surface/types.hpp"
#include "shapes.hpp"
#include "triangle_edges.hpp"

namespace seamwire {

using namespace detail;

namespace {

/// A random positive definite matrix on a mesh's graph, in the solver and dense.
Eigen::MatrixXd fill(BlockCholesky& solver, const shapes::Mesh& mesh, std::mt19937& random) {
  std::uniform_real_distribution<double> number(-1.0, 1.0);
  const auto count = static_cast<Eigen::Index>(2 * mesh.points.size());
  Eigen::MatrixXd dense = Eigen::MatrixXd::Zero(count, count);
  solver.clear();
  const auto add = [&](std::int32_t a, std::int32_t b, const Eigen::Matrix2d& block) {
    const BlockEntry at = solver.block(a, b);
    for (std::uint32_t r = 0; r < 2; ++r) {
      for (std::uint32_t c = 0; c < 2; ++c) {
        // Of diagonal blocks the upper triangle is not read.
        if (a != b || r >= c) solver.values()[at.offset + r * at.row + c * at.column] += block(r, c);
        dense(2 * a + r, 2 * b + c) += block(r, c);
        if (a != b) dense(2 * b + c, 2 * a + r) += block(r, c);
      }
    }
  };
  for (std::int32_t v = 0; v < count / 2; ++v) add(v, v, 0.1 * Eigen::Matrix2d::Identity());
  for (const Triangle& t : mesh.triangles) {
    Eigen::Matrix<double, 6, 6> half;
    for (double& value : half.reshaped()) value = number(random);
    const Eigen::Matrix<double, 6, 6> block = half * half.transpose();
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < 3; ++j) {
        // Each pair once, in a random direction.
        if (i == j || (i < j) == (random() % 2 == 0)) continue;
        const bool is_taken = dense(2 * t[static_cast<std::size_t>(i)], 2 * t[static_cast<std::size_t>(j)]) != 0.0;
        if (!is_taken)
          add(t[static_cast<std::size_t>(i)], t[static_cast<std::size_t>(j)], block.block<2, 2>(2 * i, 2 * j));
      }
      const std::int32_t v = t[static_cast<std::size_t>(i)];
      add(v, v, block.block<2, 2>(2 * i, 2 * i) + 20.0 * Eigen::Matrix2d::Identity());
    }
  }
  return dense;
}

TEST(BlockCholesky, SolvesAsDenseMatricesDo) {
  std::mt19937 random(5);
  for (const shapes::Mesh& mesh : {shapes::grid(1), shapes::grid(4), shapes::grid(13), shapes::icosphere(2),
                                   shapes::torus(12, 7), shapes::moebius(9)}) {
    BlockCholesky solver(mesh.points.size(), edges_of(mesh.triangles), {});
    const Eigen::MatrixXd dense = fill(solver, mesh, random);
    const Eigen::VectorXd right = Eigen::VectorXd::Random(dense.rows());
    ASSERT_TRUE(solver.factor({}));
    Eigen::VectorXd solution = right;
    solver.solve({solution.data(), static_cast<std::size_t>(solution.size())});
    EXPECT_LT((dense * solution - right).norm(), 1e-11 * right.norm()) << mesh.points.size() << " vertices";
  }
}

TEST(BlockCholesky, TakesVerticesWithoutEdges) {
  BlockCholesky solver(3, std::vector<Edge>{{0, 2}}, {});
  solver.clear();
  for (std::int32_t v = 0; v < 3; ++v) {
    const BlockEntry at = solver.block(v, v);
    solver.values()[at.offset] = solver.values()[at.offset + at.row + at.column] = 2.0;
  }
  ASSERT_TRUE(solver.factor({}));
  std::vector<double> x{2, 4, 6, 8, 10, 12};
  solver.solve(x);
  for (std::size_t i = 0; i < 6; ++i) EXPECT_NEAR(x[i], static_cast<double>(i + 1), 1e-14);
}

TEST(BlockCholesky, SaysWhereAMatrixIsNotPositiveDefinite) {
  const shapes::Mesh mesh = shapes::grid(6);
  std::mt19937 random(1);
  BlockCholesky solver(mesh.points.size(), edges_of(mesh.triangles), {});
  fill(solver, mesh, random);
  solver.values()[solver.block(17, 17).offset] = -1.0;
  EXPECT_FALSE(solver.factor({}));
  fill(solver, mesh, random);
  solver.values()[solver.block(17, 17).offset] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(solver.factor({}));
}

TEST(BlockCholesky, StopsWhenToldTo) {
  std::stop_source stop;
  stop.request_stop();
  const Task task{.stop = stop.get_token(), .progress = {}};
  const shapes::Mesh mesh = shapes::grid(6);
  EXPECT_THROW(BlockCholesky(mesh.points.size(), edges_of(mesh.triangles), task), Cancelled);
  // A dense graph, so that one factorization takes more than the work between two looks at the task.
  constexpr std::int32_t kCount = 300;
  std::vector<Edge> all;
  for (std::int32_t a = 0; a < kCount; ++a) {
    for (std::int32_t b = 0; b < a; ++b) all.push_back({a, b});
  }
  BlockCholesky dense(kCount, all, {});
  dense.clear();
  for (std::int32_t v = 0; v < kCount; ++v) {
    const BlockEntry at = dense.block(v, v);
    dense.values()[at.offset] = dense.values()[at.offset + at.row + at.column] = 1.0;
  }
  EXPECT_THROW(dense.factor(task), Cancelled);
}

TEST(FrontKernels, AllInstructionSetsGiveTheSameBits) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> number(-1.0, 1.0);
  constexpr std::size_t kRows = 44, kStride = 48, kDepth = 10;
  std::vector<double> a(kStride * kDepth), right(kDepth), left(kRows);
  for (std::vector<double>* array : {&a, &right, &left}) {
    for (double& value : *array) value = number(random);
  }
  for (const std::size_t width : {std::size_t{2}, std::size_t{4}}) {
    expect_same_bits<FrontKernels>(cholesky_kernels(), [&](const FrontKernels& kernels) {
      std::vector<double> columns(kStride * 4, 0.5);
      for (std::size_t j = 0; j < 4; ++j) columns[j * kStride + j] = 1e3;
      if (width == 2) {
        for (std::size_t j = 0; j < 2; ++j) columns[j * kStride + 2] = columns[j * kStride + 3] = 0.0;
      }
      kernels.subtract_product(columns.data(), kStride, a.data(), a.data(), kStride, kRows, width, kDepth);
      std::vector<double> all = columns;
      EXPECT_TRUE(kernels.factor_columns(columns.data(), kStride, kRows, width));
      all.insert(all.end(), columns.begin(), columns.end());
      return all;
    });
  }
  expect_same_bits<FrontKernels>(cholesky_kernels(), [&](const FrontKernels& kernels) {
    std::vector<double> x = right, y = left;
    kernels.subtract_times(y.data(), a.data(), kStride, kRows, kDepth, x.data());
    kernels.subtract_transposed_times(x.data(), a.data(), kStride, kRows, kDepth, y.data());
    x.insert(x.end(), y.begin(), y.end());
    return x;
  });
}

}  // namespace

}  // namespace seamwire
