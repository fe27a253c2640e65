// SPDX-License-Identifier: GPL-3.0-or-later
#include "geodesics/window_kernels.hpp"

#include <cmath>

#include "detail/always_inline.hpp"
#include "detail/infinity.hpp"

namespace seamwire::detail {
namespace {

// Not those of the standard library, which treat their arguments as places in memory.
SEAMWIRE_INLINE double least(double a, double b) { return a < b ? a : b; }
SEAMWIRE_INLINE double most(double a, double b) { return a > b ? a : b; }

/// A root that misses its condition by less than this part of the squares in it may do so by rounding.
constexpr double kMirrorImage = 1e-9;

/// A number of entries in whole vectors of four.
SEAMWIRE_INLINE std::size_t padded(std::size_t count) { return (count + 3) & ~std::size_t{3}; }

SEAMWIRE_INLINE bool find_overlaps_in(const Windows& w, std::size_t count, std::int64_t* overlaps) {
  std::int64_t falls = 0;
  const std::size_t end = padded(count);
  SEAMWIRE_VECTORIZE
  for (std::size_t i = 0; i < end; ++i) {
    const double begin_i = w.b0[i], end_i = w.b1[i], begin_j = w.b0[i + 1], end_j = w.b1[i + 1];
    const double overlap = least(end_i, end_j) - most(begin_i, begin_j);
    overlaps[i] = overlap > kLeastOverlap * least(end_i - begin_i, end_j - begin_j) ? 1 : 0;
    falls |= ((begin_i + end_i > begin_j + end_j) & (i + 1 < count)) ? 1 : 0;
  }
  return falls == 0;
}

SEAMWIRE_INLINE void compare_all(const Pairs& pairs, std::size_t count) {
  const std::size_t end = padded(count);
  SEAMWIRE_VECTORIZE
  for (std::size_t k = 0; k < end; ++k) {
    // From here on the interval is [0, width].
    const double begin = pairs.begin[k], width = pairs.end[k] - begin;
    const double xi = pairs.left.x[k] - begin, yi = pairs.left.y[k];
    const double xj = pairs.right.x[k] - begin, yj = pairs.right.y[k];
    const double gap = pairs.right.distance[k] - pairs.left.distance[k], gap2 = gap * gap;
    const double norm_i = xi * xi + yi * yi, norm_j = xj * xj + yj * yj;
    const double end_xi = xi - width, end_xj = xj - width;
    // By how much the left one, i, is farther than j, at both ends.
    const double more0 = std::sqrt(norm_i) - std::sqrt(norm_j) - gap;
    const double more1 = std::sqrt(end_xi * end_xi + yi * yi) - std::sqrt(end_xj * end_xj + yj * yj) - gap;
    // The difference rises or falls all along the interval, unless the line through both sources meets it. There the
    // difference is |s_i - s_j| - gap, its maximum, or -|s_i - s_j| - gap, its minimum, if i is the nearer source.
    const double side0 = xi * yj - xj * yi, side1 = end_xi * yj - end_xj * yi;
    const bool is_monotone = !(side0 * side1 < 0);
    const bool is_gap_wide = gap2 >= (xi - xj) * (xi - xj) + (yi - yj) * (yi - yj);
    const bool i_wins = (more0 <= 0) & (more1 <= 0) & (is_monotone | (yi > yj) | ((gap > 0) & is_gap_wide));
    const bool j_wins = (more0 >= 0) & (more1 >= 0) & (is_monotone | (yi < yj) | ((gap < 0) & is_gap_wide)) & !i_wins;
    // Where both are equally far, d_i + |s_i - b| = d_j + |s_j - b|, squared twice. One of the roots belongs to the
    // equation's mirror image. If both lie in the interval, it is the one that does not fulfill p b + q = gap |s_j - b|
    // with gap + |s_j - b| not negative.
    const double p = xj - xi, q = 0.5 * (norm_i - norm_j - gap2);
    const double a = p * p - gap2, b = p * q + gap2 * xj, c = q * q - gap2 * norm_j;
    const double root = std::sqrt(most(b * b - a * c, 0.0));
    const double sum = b < 0 ? root - b : -root - b;
    const double r0 = sum / a, r1 = c / sum;
    const bool is_inside0 = (r0 >= 0) & (r0 <= width), is_inside1 = (r1 >= 0) & (r1 <= width);
    const double miss0 = gap < 0 ? p * r0 + q + gap2 : -(p * r0 + q);
    const double miss1 = gap < 0 ? p * r1 + q + gap2 : -(p * r1 + q);
    // Of two roots that meet it, one is a tie at an end of the interval.
    const double rounding = kMirrorImage * (norm_i + norm_j);
    const bool are_roots = (miss0 <= rounding) & (miss1 <= rounding);
    const bool is_0_farther_in = least(r0, width - r0) >= least(r1, width - r1);
    const bool is_0_better = (are_roots & is_0_farther_in) | (!are_roots & (miss0 <= miss1));
    const bool is_0 = is_inside0 & (!is_inside1 | is_0_better);
    const double inside = is_0 ? r0 : r1, miss = is_0 ? miss0 : miss1;
    const double other = is_0 ? r1 : r0, other_miss = is_0 ? miss1 : miss0;
    // With a tie at an end, rounding may put the root beyond that end, and the one inside is the mirror image's.
    const bool is_mirror_image = (other_miss < miss) & (miss > rounding);
    const double border = is_mirror_image ? most(0.0, least(other, width)) : inside;
    const bool crosses = (more0 < 0) & (more1 > 0) & (is_inside0 | is_inside1);
    pairs.left_until[k] = crosses ? begin + border : j_wins ? begin : pairs.end[k];
    pairs.right_from[k] = crosses ? begin + border : i_wins ? pairs.end[k] : begin;
  }
}

SEAMWIRE_INLINE void apex_distances_of(const Windows& w, std::size_t count, const BaseTriangle& triangle,
                                       double* projections, double* apex_distances) {
  const auto [base, apex_x, apex_y] = triangle;
  const double corner0 = kCornerWidth * base, corner1 = (1 - kCornerWidth) * base;
  const std::size_t end = padded(count);
  SEAMWIRE_VECTORIZE
  for (std::size_t i = 0; i < end; ++i) {
    const double x = w.x[i], y = w.y[i];
    const double projection = x + (apex_x - x) * -y / (apex_y - y);
    const double through = most(w.b0[i], least(projection, w.b1[i]));
    const double below = through - x, above = through - apex_x;
    const double apex_distance =
        w.distance[i] + std::sqrt(below * below + y * y) + std::sqrt(above * above + apex_y * apex_y);
    const bool is_over_corner = (through != projection) & ((through < corner0) | (through > corner1));
    projections[i] = projection;
    apex_distances[i] = is_over_corner ? kInfinity : apex_distance;
  }
}

/// The filter of Xin and Wang: the window cannot matter if the ends of the edge, walked along it, do better at the
/// window's far end. Compared in squares: no root.
SEAMWIRE_INLINE bool is_useless(const Side& side, double b0, double b1, double x, double y, double distance) {
  const double over_tail = side.at_tail + b1 - distance, over_tip = side.at_tip + (side.length - b0) - distance;
  const double square0 = (b0 - x) * (b0 - x) + y * y, square1 = (b1 - x) * (b1 - x) + y * y;
  return (over_tail < 0) | (over_tip < 0) | (over_tail * over_tail < square1) | (over_tip * over_tip < square0);
}

SEAMWIRE_INLINE std::size_t all_to_left(const Windows& w, std::size_t count, const double* projections, double split,
                                        const Side& to, const ChildWindows& children) {
  const Side side = to;
  std::int64_t made = 0;
  const std::size_t end = padded(count);
  SEAMWIRE_VECTORIZE
  for (std::size_t i = 0; i < end; ++i) {
    const double b0 = w.b0[i], b1 = least(w.b1[i], split), x = w.x[i], y = w.y[i], projection = projections[i];
    // Where the rays over b0 and b1 meet the side, from the tail. The further right a ray, the smaller its
    // denominator; where that is not positive, the ray never gets to the side.
    const double denominator0 = -y * side.cosine - side.sine * (b0 - x);
    const double denominator1 = -y * side.cosine - side.sine * (b1 - x);
    const double t0 = -y * b0 / denominator0, meets1 = least(-y * b1 / denominator1, side.length);
    const double t1 = ((b1 < projection) & (denominator1 > 0)) ? meets1 : side.length;
    const double child_x = x * side.cosine + y * side.sine, child_y = y * side.cosine - x * side.sine;
    const bool is_alive = (i < count) & (b0 < b1) & (b0 < projection) & (denominator0 > 0) &
                          (t1 - t0 > kLeastWidth * side.length) & (child_y < 0) &
                          !is_useless(side, t0, t1, child_x, child_y, w.distance[i]);
    children.b0[i] = t0;
    children.b1[i] = t1;
    children.x[i] = child_x;
    children.y[i] = child_y;
    children.alive[i] = is_alive ? 1 : 0;
    made += is_alive ? 1 : 0;
  }
  return static_cast<std::size_t>(made);
}

SEAMWIRE_INLINE std::size_t all_to_right(const Windows& w, std::size_t count, const double* projections, double split,
                                         const BaseTriangle& triangle, const Side& to, const ChildWindows& children) {
  const Side side = to;
  const auto [base, apex_x, apex_y] = triangle;
  std::int64_t made = 0;
  const std::size_t end = padded(count);
  SEAMWIRE_VECTORIZE
  for (std::size_t i = 0; i < end; ++i) {
    const double b0 = most(w.b0[i], split), b1 = w.b1[i], x = w.x[i], y = w.y[i], projection = projections[i];
    // As on the left, mirrored: distances from the tip.
    const double denominator0 = -y * side.cosine - side.sine * (b0 - x);
    const double denominator1 = -y * side.cosine - side.sine * (b1 - x);
    const double t1 = side.length - -y * (base - b1) / denominator1;
    const double meets0 = most(side.length - -y * (base - b0) / denominator0, 0.0);
    const double t0 = ((b0 > projection) & (denominator0 > 0)) ? meets0 : 0.0;
    const double from_apex_x = x - apex_x, from_apex_y = y - apex_y;
    const double child_x = from_apex_x * side.cosine + from_apex_y * side.sine;
    const double child_y = from_apex_y * side.cosine - from_apex_x * side.sine;
    const bool is_alive = (i < count) & (b0 < b1) & (projection < b1) & (denominator1 > 0) &
                          (t1 - t0 > kLeastWidth * side.length) & (child_y < 0) &
                          !is_useless(side, t0, t1, child_x, child_y, w.distance[i]);
    children.b0[i] = t0;
    children.b1[i] = t1;
    children.x[i] = child_x;
    children.y[i] = child_y;
    children.alive[i] = is_alive ? 1 : 0;
    made += is_alive ? 1 : 0;
  }
  return static_cast<std::size_t>(made);
}

// NOLINTBEGIN(bugprone-macro-parentheses): an attribute
#define SEAMWIRE_WINDOW_KERNELS(TARGET, WIDTH)                                                                    \
  TARGET bool find_overlaps(const Windows& windows, std::size_t count, std::int64_t* overlaps) {                  \
    return find_overlaps_in(windows, count, overlaps);                                                            \
  }                                                                                                               \
  TARGET void compare(const Pairs& pairs, std::size_t count) { compare_all(pairs, count); }                       \
  TARGET void find_apex_distances(const Windows& windows, std::size_t count, const BaseTriangle& triangle,        \
                                  double* projections, double* apex_distances) {                                  \
    apex_distances_of(windows, count, triangle, projections, apex_distances);                                     \
  }                                                                                                               \
  TARGET std::size_t to_left(const Windows& windows, std::size_t count, const double* projections, double split,  \
                             const Side& side, const ChildWindows& children) {                                    \
    return all_to_left(windows, count, projections, split, side, children);                                       \
  }                                                                                                               \
  TARGET std::size_t to_right(const Windows& windows, std::size_t count, const double* projections, double split, \
                              const BaseTriangle& triangle, const Side& side, const ChildWindows& children) {     \
    return all_to_right(windows, count, projections, split, triangle, side, children);                            \
  }                                                                                                               \
  constexpr WindowKernels kKernels{find_overlaps, compare, find_apex_distances, to_left, to_right};
// NOLINTEND(bugprone-macro-parentheses)

SEAMWIRE_COMPILE_VARIANTS(SEAMWIRE_WINDOW_KERNELS)

}  // namespace

const InstructionSets<WindowKernels>& window_kernels() { return kVariants; }

}  // namespace seamwire::detail
