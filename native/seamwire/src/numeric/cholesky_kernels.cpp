// SPDX-License-Identifier: GPL-3.0-or-later
#include "numeric/cholesky_kernels.hpp"

#include <cmath>
#include <cstring>

#include "detail/always_inline.hpp"

namespace seamwire::detail {
namespace {

// Four numbers that are computed with at once. Compilers split them where registers are shorter.
#if defined(__GNUC__)
using Quad = double __attribute__((vector_size(32)));
using QuadInMemory = double __attribute__((vector_size(32), aligned(8), may_alias));
SEAMWIRE_INLINE void set(Quad& q, double value) { q = Quad{value, value, value, value}; }
SEAMWIRE_INLINE void load(Quad& q, const double* from) { q = *reinterpret_cast<const QuadInMemory*>(from); }
SEAMWIRE_INLINE void store(double* to, const Quad& q) { *reinterpret_cast<QuadInMemory*>(to) = q; }
#else
struct Quad {
  double v[4];
  double& operator[](std::size_t i) { return v[i]; }
  Quad operator*(const Quad& o) const { return {v[0] * o.v[0], v[1] * o.v[1], v[2] * o.v[2], v[3] * o.v[3]}; }
  void operator-=(const Quad& o) {
    for (std::size_t i = 0; i < 4; ++i) v[i] -= o.v[i];
  }
  void operator+=(const Quad& o) {
    for (std::size_t i = 0; i < 4; ++i) v[i] += o.v[i];
  }
  void operator*=(const Quad& o) {
    for (std::size_t i = 0; i < 4; ++i) v[i] *= o.v[i];
  }
};
SEAMWIRE_INLINE void set(Quad& q, double value) { q = Quad{{value, value, value, value}}; }
SEAMWIRE_INLINE void load(Quad& q, const double* from) { std::memcpy(&q, from, sizeof(Quad)); }
SEAMWIRE_INLINE void store(double* to, const Quad& q) { std::memcpy(to, &q, sizeof(Quad)); }
#endif
// Loops over few numbers that have to stay in registers. Clang needs no hint.
#if defined(__GNUC__) && !defined(__clang__)
#define SEAMWIRE_UNROLL _Pragma("GCC unroll 4")
#else
#define SEAMWIRE_UNROLL
#endif

/// On 4 x Quads rows of W columns. The sums stay in registers.
template <std::size_t Quads, std::size_t W>
SEAMWIRE_INLINE void subtract_tile(double* c, std::size_t c_stride, const double* a, const double* b,
                                   std::size_t stride, std::size_t depth) {
  Quad sums[W][Quads];
  SEAMWIRE_UNROLL
  for (std::size_t j = 0; j < W; ++j) {
    SEAMWIRE_UNROLL
    for (std::size_t i = 0; i < Quads; ++i) load(sums[j][i], c + j * c_stride + 4 * i);
  }
  for (std::size_t p = 0; p < depth; ++p) {
    Quad rows[Quads];
    SEAMWIRE_UNROLL
    for (std::size_t i = 0; i < Quads; ++i) load(rows[i], a + p * stride + 4 * i);
    SEAMWIRE_UNROLL
    for (std::size_t j = 0; j < W; ++j) {
      Quad factor;
      set(factor, b[p * stride + j]);
      SEAMWIRE_UNROLL
      for (std::size_t i = 0; i < Quads; ++i) sums[j][i] -= rows[i] * factor;
    }
  }
  SEAMWIRE_UNROLL
  for (std::size_t j = 0; j < W; ++j) {
    SEAMWIRE_UNROLL
    for (std::size_t i = 0; i < Quads; ++i) store(c + j * c_stride + 4 * i, sums[j][i]);
  }
}

/// `Quads`: how many fit the registers for 4 columns.
template <std::size_t Quads, std::size_t W>
SEAMWIRE_INLINE void subtract_product_of(double* c, std::size_t c_stride, const double* a, const double* b,
                                         std::size_t stride, std::size_t rows, std::size_t depth) {
  std::size_t i = 0;
  for (; i + 4 * Quads <= rows; i += 4 * Quads) subtract_tile<Quads, W>(c + i, c_stride, a + i, b, stride, depth);
  for (; i < rows; i += 4) subtract_tile<1, W>(c + i, c_stride, a + i, b, stride, depth);
}

template <std::size_t W>
SEAMWIRE_INLINE bool factor_columns_of(double* columns, std::size_t stride, std::size_t rows) {
  double l[W][W];
  bool is_positive = true;
  SEAMWIRE_UNROLL
  for (std::size_t j = 0; j < W; ++j) {
    SEAMWIRE_UNROLL
    for (std::size_t i = j; i < W; ++i) {
      double sum = columns[j * stride + i];
      SEAMWIRE_UNROLL
      for (std::size_t p = 0; p < j; ++p) sum -= l[i][p] * l[j][p];
      if (i == j) {
        is_positive = is_positive && sum > 0.0;
        l[j][j] = 1.0 / std::sqrt(sum);
      } else {
        l[i][j] = sum * l[j][j];
      }
      columns[j * stride + i] = l[i][j];
    }
  }
  // Below the triangle of two columns the rows up to the next multiple of 4 are empty.
  for (std::size_t i = 4; i < rows; i += 4) {
    Quad x[W];
    SEAMWIRE_UNROLL
    for (std::size_t j = 0; j < W; ++j) {
      load(x[j], columns + j * stride + i);
      SEAMWIRE_UNROLL
      for (std::size_t p = 0; p < j; ++p) {
        Quad factor;
        set(factor, l[j][p]);
        x[j] -= x[p] * factor;
      }
      Quad factor;
      set(factor, l[j][j]);
      x[j] *= factor;
      store(columns + j * stride + i, x[j]);
    }
  }
  return is_positive;
}

template <std::size_t Depth>
SEAMWIRE_INLINE void subtract_few_times(double* y, const double* a, std::size_t stride, std::size_t rows,
                                        const double* x) {
  for (std::size_t i = 0; i < rows; i += 4) {
    Quad sum;
    load(sum, y + i);
    SEAMWIRE_UNROLL
    for (std::size_t p = 0; p < Depth; ++p) {
      Quad column, factor;
      load(column, a + p * stride + i);
      set(factor, x[p]);
      sum -= column * factor;
    }
    store(y + i, sum);
  }
}

SEAMWIRE_INLINE void subtract_times_of(double* y, const double* a, std::size_t stride, std::size_t rows,
                                       std::size_t depth, const double* x) {
  std::size_t p = 0;
  for (; p + 4 <= depth; p += 4) subtract_few_times<4>(y, a + p * stride, stride, rows, x + p);
  for (; p < depth; p += 2) subtract_few_times<2>(y, a + p * stride, stride, rows, x + p);
}

template <std::size_t Depth>
SEAMWIRE_INLINE void subtract_few_dots(double* x, const double* a, std::size_t stride, std::size_t rows,
                                       const double* y) {
  Quad sums[Depth]{};
  for (std::size_t i = 0; i < rows; i += 4) {
    Quad values;
    load(values, y + i);
    SEAMWIRE_UNROLL
    for (std::size_t p = 0; p < Depth; ++p) {
      Quad column;
      load(column, a + p * stride + i);
      sums[p] += column * values;
    }
  }
  SEAMWIRE_UNROLL
  for (std::size_t p = 0; p < Depth; ++p) x[p] -= (sums[p][0] + sums[p][1]) + (sums[p][2] + sums[p][3]);
}

SEAMWIRE_INLINE void subtract_transposed_times_of(double* x, const double* a, std::size_t stride, std::size_t rows,
                                                  std::size_t depth, const double* y) {
  std::size_t p = 0;
  for (; p + 4 <= depth; p += 4) subtract_few_dots<4>(x + p, a + p * stride, stride, rows, y);
  for (; p < depth; p += 2) subtract_few_dots<2>(x + p, a + p * stride, stride, rows, y);
}

// NOLINTBEGIN(bugprone-macro-parentheses): an attribute
#define SEAMWIRE_FRONT_KERNELS(TARGET, WIDTH)                                                                         \
  TARGET void subtract_product(double* c, std::size_t c_stride, const double* a, const double* b, std::size_t stride, \
                               std::size_t rows, std::size_t width, std::size_t depth) {                              \
    if (width == 4) {                                                                                                 \
      subtract_product_of<(WIDTH) / 2, 4>(c, c_stride, a, b, stride, rows, depth);                                    \
    } else {                                                                                                          \
      subtract_product_of<(WIDTH) / 2, 2>(c, c_stride, a, b, stride, rows, depth);                                    \
    }                                                                                                                 \
  }                                                                                                                   \
  TARGET bool factor_columns(double* columns, std::size_t stride, std::size_t rows, std::size_t width) {              \
    return width == 4 ? factor_columns_of<4>(columns, stride, rows) : factor_columns_of<2>(columns, stride, rows);    \
  }                                                                                                                   \
  TARGET void subtract_times(double* y, const double* a, std::size_t stride, std::size_t rows, std::size_t depth,     \
                             const double* x) {                                                                       \
    subtract_times_of(y, a, stride, rows, depth, x);                                                                  \
  }                                                                                                                   \
  TARGET void subtract_transposed_times(double* x, const double* a, std::size_t stride, std::size_t rows,             \
                                        std::size_t depth, const double* y) {                                         \
    subtract_transposed_times_of(x, a, stride, rows, depth, y);                                                       \
  }                                                                                                                   \
  constexpr FrontKernels kKernels{subtract_product, factor_columns, subtract_times, subtract_transposed_times};
// NOLINTEND(bugprone-macro-parentheses)

SEAMWIRE_COMPILE_VARIANTS(SEAMWIRE_FRONT_KERNELS)

}  // namespace

const InstructionSets<FrontKernels>& cholesky_kernels() { return kVariants; }

}  // namespace seamwire::detail
