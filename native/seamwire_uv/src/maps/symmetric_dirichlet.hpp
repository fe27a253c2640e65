// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "maps/dirichlet_kernels.hpp"
#include "numeric/block_cholesky.hpp"
#include "seamwire/surface/types.hpp"
#include "seamwire/surface/vector.hpp"

namespace seamwire::detail {

/// Where blocks (0, 0), (1, 1), (2, 2), (0, 1), (1, 2) and (2, 0) of a triangle's corners are.
using TriangleBlocks = std::array<BlockEntry, 6>;

/// The symmetric Dirichlet energy of maps of an island: |J|^2 + |J^-1|^2 of each triangle's Jacobian J, averaged over
/// the area (Smith and Schaefer 2015). Maps are arrays of two numbers for each own vertex. Their unit of length is a
/// power of two in that of the points, so that conversion is exact, and the island's area is between 1 and 4.
class SymmetricDirichlet {
 public:
  /// `points`: of own vertices, with coordinates of about 1 in size. A triangle that is lower than 1e-4 of its longest
  /// side gets that height; a triangle much smaller than the island gets a least size.
  SymmetricDirichlet(std::vector<Triangle> triangles, std::span<const Vector> points);

  /// The unit of maps in the unit of the points.
  double unit() const { return unit_; }
  /// The island's area, with the heights and sizes that low and small triangles got, in the unit of maps squared.
  double area() const { return area_; }
  /// Each triangle's part of the area.
  const std::vector<double>& weights() const { return weights_; }

  /// The mean energy; infinite if a triangle is not counter-clockwise.
  double energy(std::span<const double> map) const;
  /// Of each triangle.
  std::vector<double> energies(std::span<const double> map) const;
  /// |J|^2 and |J^-1|^2 of each triangle; both infinite if it is not counter-clockwise.
  std::vector<std::array<double, 2>> parts(std::span<const double> map) const;
  /// Adds the gradient to two numbers for each vertex, and the Hessian, with each triangle's part made positive
  /// semidefinite (Smith, de Goes and Kim 2019), to the values of a matrix.
  void add_derivatives(std::span<const double> map, std::span<const TriangleBlocks> blocks, std::span<double> gradient,
                       std::span<double> values) const;
  /// The least positive step along a direction at which a triangle has no area; infinite if all keep theirs.
  double first_flip(std::span<const double> map, std::span<const double> direction) const;

  /// Moves the rest shapes of strongly distorted triangles towards the map, so that no triangle's energy exceeds
  /// `limit` (Liu et al. 2018, "Progressive parameterizations"). Returns how many were moved. All other
  /// triangles get their own rest shapes back.
  std::size_t move_rest_shapes(std::span<const double> map, double limit);

 private:
  /// P_1 and P_2 of each triangle, see dirichlet_kernels.hpp.
  struct Shapes {
    std::vector<double> p1x, p1y, p2x, p2y;
  };
  RestShapes rest_of(const Shapes& shapes, std::size_t begin) const;
  /// Of the triangles from `begin` on.
  void set_sides(std::span<const double> map, std::size_t begin, std::size_t count, Sides& sides) const;
  /// visit(begin, count, sides) for triangles in groups.
  template <class Visit>
  void for_each_group(std::span<const double> map, const Visit& visit) const;

  std::vector<Triangle> triangles_;
  Shapes own_, current_;
  std::vector<double> weights_;  // add up to 1
  double unit_ = 1.0, area_ = 0.0;
};

}  // namespace seamwire::detail
