// SPDX-License-Identifier: GPL-3.0-or-later
#include "parts/limb_field.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "tuning/constants.hpp"

namespace seamwire::detail {
namespace {

using Sparse = Eigen::SparseMatrix<double>;

/// How many vectors are iterated: more than are used, because the last ones converge slowly.
constexpr int kColumns = 24;
constexpr int kRounds = 4;
/// Share of the masses that is added before the Laplacian, which is singular, is factored.
constexpr double kShift = 0.01;
/// Lengths below this, on a surface of area 1, count as this.
constexpr double kLeastDistance = 1e-4, kLeastLength = 1e-5;

/// Adds a Laplacian with a weight for each link to a diagonal.
Sparse laplacian(const Eigen::VectorXd& diagonal, std::span<const LimbLink> links, std::span<const double> weights) {
  std::vector<Eigen::Triplet<double>> entries;
  entries.reserve(links.size() * 2 + static_cast<std::size_t>(diagonal.size()));
  Eigen::VectorXd sums = diagonal;
  for (std::size_t i = 0; i < links.size(); ++i) {
    const auto& [one, other, length, distance] = links[i];
    sums[one] += weights[i];
    sums[other] += weights[i];
    entries.emplace_back(one, other, -weights[i]);
    entries.emplace_back(other, one, -weights[i]);
  }
  for (std::int32_t f = 0; f < diagonal.size(); ++f) entries.emplace_back(f, f, sums[f]);
  Sparse matrix(diagonal.size(), diagonal.size());
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

/// Normals without details that are smaller than tuning::kLimbDetail.
Eigen::MatrixX3d smooth_normals(std::span<const LimbFace> faces, std::span<const LimbLink> links,
                                const Eigen::VectorXd& masses) {
  const double half_square = 0.5 * tuning::kLimbDetail * tuning::kLimbDetail;
  std::vector<double> weights;
  for (const LimbLink& link : links) {
    weights.push_back(half_square * link.length / std::max(link.distance, kLeastDistance));
  }
  Eigen::MatrixX3d normals(masses.size(), 3);
  for (Eigen::Index f = 0; f < masses.size(); ++f) normals.row(f) = masses[f] * faces[f].normal.transpose();
  const Eigen::SimplicialLDLT<Sparse> factor(laplacian(masses, links, weights));
  normals = factor.solve(normals).eval();
  normals.rowwise().normalize();
  return normals;
}

/// Makes the columns orthonormal with respect to the masses.
void orthonormalize(Eigen::MatrixXd& columns, const Eigen::VectorXd& masses) {
  // Twice, because the columns of an inverse iteration are nearly dependent at first.
  for (int round = 0; round < 2; ++round) {
    const Eigen::MatrixXd products = columns.transpose() * masses.asDiagonal() * columns;
    Eigen::MatrixXd shifted = products;
    shifted.diagonal() += 1e-14 * products.diagonal();
    const Eigen::LLT<Eigen::MatrixXd> factor(shifted);
    columns = factor.matrixU().solve<Eigen::OnTheRight>(columns);
  }
}

}  // namespace

LimbField limb_field(std::span<const LimbFace> faces, std::span<const LimbLink> links, const Task& task) {
  const auto count = static_cast<Eigen::Index>(faces.size());
  Eigen::VectorXd masses(count);
  for (Eigen::Index f = 0; f < count; ++f) masses[f] = faces[f].area;
  task.check(0.0);
  const Eigen::MatrixX3d normals = smooth_normals(faces, links, masses);
  task.check(0.2);

  LimbField field;
  std::vector<double> conductances;
  for (const auto& [one, other, length, distance] : links) {
    const Eigen::Vector3d a = normals.row(one), b = normals.row(other);
    const double angle = std::atan2(a.cross(b).norm(), a.dot(b));
    const bool is_concave = (a - b).dot(faces[other].center - faces[one].center) > 0.0;
    const double bend = is_concave ? angle : 0.0;
    const double resistance = (distance + tuning::kLimbConcavity * bend) / std::max(length, kLeastLength);
    conductances.push_back(1.0 / resistance);
    const double steepness = bend * tuning::kLimbDetail / std::max(distance, kLeastDistance);
    field.weights.push_back(length * std::max(std::exp(-steepness / tuning::kLimbSteepness), tuning::kLeastLimbWeight));
  }

  const Sparse stiffness = laplacian(Eigen::VectorXd::Zero(count), links, conductances);
  const Eigen::SimplicialLDLT<Sparse> factor(laplacian(kShift * masses, links, conductances));
  task.check(0.5);
  const auto columns = std::min<Eigen::Index>(kColumns, count);
  Eigen::MatrixXd vectors(count, columns);
  for (Eigen::Index j = 0; j < columns; ++j) {
    for (Eigen::Index f = 0; f < count; ++f) {
      vectors(f, j) = j == 0 ? 1.0 : std::sin(static_cast<double>(j) * (static_cast<double>(f) + 1.0));
    }
  }
  orthonormalize(vectors, masses);
  for (int round = 0; round < kRounds; ++round) {
    vectors = factor.solve(masses.asDiagonal() * vectors).eval();
    orthonormalize(vectors, masses);
    task.check(0.5 + 0.5 * (round + 1) / kRounds);
  }
  // Rayleigh-Ritz: the eigenvectors within the space that the columns span.
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> ritz(vectors.transpose() * (stiffness * vectors));
  field.places.setZero(count, LimbField::kCoordinates);
  for (Eigen::Index k = 1; k < std::min<Eigen::Index>(columns, LimbField::kCoordinates + 1); ++k) {
    const double shrink = std::pow(std::max(ritz.eigenvalues()[k], 0.0) + 0.5, -0.75);
    field.places.col(k - 1) = shrink * (vectors * ritz.eigenvectors().col(k));
  }
  return field;
}

}  // namespace seamwire::detail
