// SPDX-License-Identifier: GPL-3.0-or-later
//
// The arithmetic of the block Cholesky factorization on dense columns. Sums are formed in the same order for every
// instruction set.
#pragma once

#include <cstddef>

#include "numeric/instruction_sets.hpp"

namespace seamwire::detail {

/// Matrices are stored by columns, `stride` numbers apart. Numbers of rows and strides are multiples of 4.
struct FrontKernels {
  /// Subtracts A B^T from `rows` x `width` numbers of C: A has `rows` rows, B has `width` rows, and both have `depth`
  /// columns and one stride. `width`: 2 or 4.
  void (*subtract_product)(double* c, std::size_t c_stride, const double* a, const double* b, std::size_t stride,
                           std::size_t rows, std::size_t width, std::size_t depth);
  /// Factors `width` (2 or 4) columns of `rows` rows that earlier columns have been subtracted from: their first
  /// `width` rows hold the lower triangle of a matrix L L^T. With a width of 2, the two rows after these are zero. The
  /// diagonal becomes the reciprocals of L's. Returns whether all pivots were positive.
  bool (*factor_columns)(double* columns, std::size_t stride, std::size_t rows, std::size_t width);
  /// y -= A x, with A of `rows` x `depth`; x may not overlap y.
  void (*subtract_times)(double* y, const double* a, std::size_t stride, std::size_t rows, std::size_t depth,
                         const double* x);
  /// x -= A^T y, with A of `rows` x `depth`.
  void (*subtract_transposed_times)(double* x, const double* a, std::size_t stride, std::size_t rows, std::size_t depth,
                                    const double* y);
};

const InstructionSets<FrontKernels>& cholesky_kernels();

}  // namespace seamwire::detail
