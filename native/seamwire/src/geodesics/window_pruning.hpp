// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "detail/always_inline.hpp"
#include "geodesics/window_kernels.hpp"
#include "geodesics/window_lists.hpp"

namespace seamwire::detail {

/// Cuts the windows of a list back to where they are nearer than others of it.
class WindowPruning {
 public:
  /// Sorts a list in place, cuts windows back to where they are nearer than their neighbors, and drops those of which
  /// nothing is left. Returns how many there still are.
  SEAMWIRE_INLINE std::size_t prune(const Windows& w, std::size_t size, double length);
  /// Compares all pairs of windows, not neighbors alone. Windows multiply where they go on into several faces at each
  /// edge: around needles there would be no end of them. Returns how many there still are.
  std::size_t prune_all(const Windows& w, std::size_t size, double length);

 private:
  static void sort(const Windows& w, std::size_t size);
  SEAMWIRE_INLINE std::size_t list_overlapping_pairs(const Windows& w, std::size_t size);
  template <class PairAt>
  SEAMWIRE_INLINE void compare_pairs(const Windows& w, std::size_t count, const PairAt& pair_at);

  const WindowKernels& kernels_ = window_kernels().fastest();
  Scratch<double> pairs_;
  Scratch<std::int64_t> flags_;
  Scratch<std::size_t> lefts_;
  std::vector<std::size_t> nearest_first_, kept_;
};

// Used for each list, and so inline.

/// Cuts the windows of pairs, the left and the right one, back to where they are nearer than the other. Parts that are
/// cut off are reached sooner by an existing path, even if its own window is cut. So all pairs can be compared at once.
template <class PairAt>
inline void WindowPruning::compare_pairs(const Windows& w, std::size_t count, const PairAt& pair_at) {
  const std::size_t stride = count + kPadding;
  const Pairs pairs = Pairs::in(pairs_.room_for(Pairs::kColumns * stride), stride);
  for (std::size_t k = 0; k < count; ++k) {
    const auto [i, j] = pair_at(k);
    pairs.begin[k] = std::max(w.b0[i], w.b0[j]);
    pairs.end[k] = std::min(w.b1[i], w.b1[j]);
    pairs.left.set(k, w, i);
    pairs.right.set(k, w, j);
  }
  kernels_.compare(pairs, count);
  for (std::size_t k = 0; k < count; ++k) {
    const auto [i, j] = pair_at(k);
    if (pairs.left_until[k] < pairs.end[k] && w.b1[i] <= pairs.end[k]) w.b1[i] = pairs.left_until[k];
    if (pairs.right_from[k] > pairs.begin[k] && w.b0[j] >= pairs.begin[k]) w.b0[j] = pairs.right_from[k];
  }
}

/// Sorts a list in place and writes to lefts_ each window that overlaps the next one so much that comparing the two
/// pays; returns how many there are.
inline std::size_t WindowPruning::list_overlapping_pairs(const Windows& w, std::size_t size) {
  std::int64_t* overlaps = flags_.room_for(size);
  if (!kernels_.find_overlaps(w, size, overlaps)) {
    sort(w, size);
    kernels_.find_overlaps(w, size, overlaps);
  }
  std::size_t* lefts = lefts_.room_for(size);
  std::size_t count = 0;
  for (std::size_t i = 0; i + 1 < size; ++i) {
    lefts[count] = i;
    count += static_cast<std::size_t>(overlaps[i]);
  }
  return count;
}

inline std::size_t WindowPruning::prune(const Windows& w, std::size_t size, double length) {
  const std::size_t count = list_overlapping_pairs(w, size);
  if (count == 0) return size;
  const std::size_t* lefts = lefts_.room_for(size);
  compare_pairs(w, count, [&](std::size_t k) { return std::pair(lefts[k], lefts[k] + 1); });
  const double narrow = kLeastWidth * length;
  const auto is_left_over = [&](std::size_t i) { return w.b1[i] - w.b0[i] > narrow; };
  bool are_all = true;
  for (std::size_t k = 0; k < count; ++k) {
    are_all &= is_left_over(lefts[k]);
    are_all &= is_left_over(lefts[k] + 1);
  }
  if (are_all) return size;
  std::size_t kept = 0;
  for (std::size_t i = 0; i < size; ++i) {
    const bool is_kept = is_left_over(i);
    w.set(kept, w.b0[i], w.b1[i], w.x[i], w.y[i], w.distance[i], w.source[i]);
    kept += is_kept;
  }
  return kept;
}

}  // namespace seamwire::detail
