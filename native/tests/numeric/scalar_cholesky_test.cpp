// SPDX-License-Identifier: GPL-3.0-or-later
#include "numeric/scalar_cholesky.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cstdint>
#include <random>
#include <vector>

#include "seamwire/surface/types.hpp"
#include "shapes.hpp"

namespace seamwire {
namespace {

TEST(ScalarCholesky, SolvesAsDenseMatricesDo) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> number(-1.0, 1.0);
  for (const shapes::Mesh& mesh : {shapes::grid(1), shapes::grid(4), shapes::grid(13), shapes::icosphere(2),
                                   shapes::torus(12, 7), shapes::moebius(9)}) {
    std::vector<Edge> edges;
    for (const Triangle& t : mesh.triangles) {
      for (std::size_t i = 0; i < 3; ++i) edges.push_back({t[i], t[(i + 1) % 3]});
    }
    const std::size_t count = mesh.points.size() + 1;  // one without edges
    detail::ScalarCholesky solver(count, edges, {});
    detail::ScalarCholesky copy = solver;
    Eigen::MatrixXd dense = Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(count), static_cast<Eigen::Index>(count));
    for (const auto& [a, b] : edges) {
      const double value = number(random);
      solver.add(a, b, value);
      dense(a, b) += value;
      dense(b, a) += value;
    }
    for (std::int32_t v = 0; static_cast<std::size_t>(v) < count; ++v) {
      solver.add(v, v, 10.0 + v % 3);
      dense(v, v) += 10.0 + v % 3;
      copy.add(v, v, 2.0);
    }
    const Eigen::VectorXd right = Eigen::VectorXd::Random(dense.rows());
    ASSERT_TRUE(solver.factor({}));
    Eigen::VectorXd solution = right;
    solver.solve({solution.data(), count}, {});
    EXPECT_LT((dense * solution - right).norm(), 1e-11 * right.norm()) << count << " vertices";
    ASSERT_TRUE(copy.factor({}));
    solution = right;
    copy.solve({solution.data(), count}, {});
    EXPECT_LT((2.0 * solution - right).norm(), 1e-14 * right.norm());
  }
}

TEST(ScalarCholesky, SaysWhereAMatrixIsNotPositiveDefinite) {
  detail::ScalarCholesky solver(3, std::vector<Edge>{{0, 1}, {1, 2}}, {});
  for (std::int32_t v = 0; v < 3; ++v) solver.add(v, v, 1.0);
  solver.add(1, 2, 1.5);
  EXPECT_FALSE(solver.factor({}));
}

}  // namespace
}  // namespace seamwire
