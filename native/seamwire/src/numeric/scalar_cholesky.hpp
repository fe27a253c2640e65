// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "numeric/block_cholesky.hpp"
#include "seamwire/task.hpp"

namespace seamwire::detail {

/// Solves symmetric positive definite systems with one number for each vertex and each edge of a graph.
///
/// Vertices joined by an edge are paired as far as possible, and each pair is a vertex of a BlockCholesky. So the
/// arithmetic is that of the small dense matrices. Copies are independent: analyze once, then copy for each matrix of
/// the same graph.
class ScalarCholesky {
 public:
  /// Analyzes a graph. `edges`: pairs of different vertices; the same pair may occur several times. Throws InvalidInput
  /// if the factor would need 2^32 numbers or more; Cancelled.
  ScalarCholesky(std::size_t vertex_count, std::span<const std::array<std::int32_t, 2>> edges, const Task& task);

  /// Adds to the number of an edge, or to that of a vertex where both are the same. Before factor().
  void add(std::int32_t a, std::int32_t b, double value);
  /// Replaces the matrix by its factor. Returns false if the matrix is not positive definite. Throws Cancelled.
  bool factor(const Task& task);
  /// Solves for a right side of one number for each vertex, which the solution replaces. Throws Cancelled.
  void solve(std::span<double> right_side, const Task& task) const;

 private:
  /// Of a vertex: its pair, and whether it is the first or the second of it.
  struct Place {
    std::int32_t pair = -1;
    std::uint32_t slot = 0;
  };
  struct Pairs {
    std::vector<Place> places;
    std::vector<std::int32_t> alone;  // pairs of one vertex
    std::vector<std::array<std::int32_t, 2>> edges;
    std::int32_t count = 0;
  };
  static Pairs paired(std::size_t vertex_count, std::span<const std::array<std::int32_t, 2>> edges);
  ScalarCholesky(Pairs pairs, const Task& task);

  std::vector<Place> places_;
  std::size_t pair_count_;
  BlockCholesky blocks_;
};

}  // namespace seamwire::detail
