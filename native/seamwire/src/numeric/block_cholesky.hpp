// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "detail/csr.hpp"
#include "seamwire/api.hpp"
#include "seamwire/task.hpp"

namespace seamwire::detail {

/// Where a block of 2 x 2 numbers is in an array: entry (r, c) is at offset + r * row + c * column.
struct BlockEntry {
  std::uint32_t offset, row, column;
};

/// Solves symmetric positive definite systems with a block of 2 x 2 numbers for each vertex and each edge of a graph.
///
/// The vertices are eliminated in an approximate minimum degree order (Amestoy, Davis and Duff 1996). The factorization
/// is multifrontal with relaxed supernodes (Liu 1992, "The multifrontal method for sparse matrix solution"): nearly all
/// arithmetic is on small dense matrices.
class SEAMWIRE_API BlockCholesky {
 public:
  /// Analyses a graph. `edges`: pairs of different vertices; the same pair may occur several times. Throws InvalidInput
  /// if the factor would need 2^32 numbers or more; Cancelled.
  BlockCholesky(std::size_t vertex_count, std::span<const std::array<std::int32_t, 2>> edges, const Task& task);

  /// Where values() holds the block in the rows of vertex a and the columns of vertex b: an edge of the graph, or the
  /// same vertex twice.
  BlockEntry block(std::int32_t a, std::int32_t b) const;
  /// The numbers of the matrix, to be filled after clear(). Of diagonal blocks only the lower triangle is read.
  std::vector<double>& values() { return values_; }
  /// Sets all blocks to zero.
  void clear();

  /// Replaces the matrix by its factor. Returns false if the matrix is not positive definite. Throws Cancelled within
  /// some milliseconds.
  bool factor(const Task& task);
  /// Solves for a right side of two numbers for each vertex, which the solution replaces. Throws Cancelled; the right
  /// side is then unchanged.
  void solve(std::span<double> right_side, const Task& task = {}) const;

  /// Numbers in the factor, zeros that were added for speed included.
  std::size_t factor_size() const { return values_.size(); }

 private:
  /// Columns that are eliminated together. Their front has `pivots` rows, some of them empty to fill groups of 4, then
  /// two for each vertex in `rows`, then empty ones.
  struct Supernode {
    std::int32_t begin = 0, end = 0;                       // its vertices, by their place in the elimination order
    std::int32_t parent = -1;                              // the supernode that its update goes to
    std::uint32_t rows_begin = 0, rows_end = 0;            // in rows_ and places_
    std::size_t panel = 0;                                 // where its columns begin in values_
    std::uint32_t pivots = 0, pivot_rows = 0, stride = 0;  // in numbers, not vertices

    std::uint32_t update_rows() const { return stride - pivot_rows; }
  };

  void find_supernodes(const std::vector<std::int32_t>& parent, const std::vector<std::int32_t>& count);
  void find_rows(const Csr<std::int32_t>& later);
  void lay_out();
  void add_to_parent(const Supernode& child, const double* update, const Supernode& parent, double* parent_update);
  bool factor_front(const Supernode& node, double* update, std::size_t& work, const Task& task);

  std::vector<std::int32_t> order_, place_of_;  // vertex by place, place by vertex
  std::vector<Supernode> nodes_;                // children before their parents
  std::vector<std::int32_t> node_of_;           // by place
  std::vector<std::int32_t> rows_;              // places of vertices, ascending for each supernode
  std::vector<std::uint32_t> places_;           // for each of them, the row in the parent's front
  std::vector<double> values_;                  // of each supernode, the columns that it eliminates
  std::vector<double> updates_;                 // a stack of updates that parents have not taken yet
};

}  // namespace seamwire::detail
