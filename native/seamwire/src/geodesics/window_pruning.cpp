// SPDX-License-Identifier: GPL-3.0-or-later
#include "geodesics/window_pruning.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace seamwire::detail {
/// Sorts a list by the middles of its windows: those that came over different sides of a triangle are mixed, and
/// only neighbors are compared. Few are out of place.
void WindowPruning::sort(const Windows& w, std::size_t size) {
  for (std::size_t i = 1; i < size; ++i) {
    const double b0 = w.b0[i], b1 = w.b1[i], x = w.x[i], y = w.y[i], d = w.distance[i];
    const std::int32_t source = w.source[i];
    std::size_t to = i;
    for (; to > 0 && w.b0[to - 1] + w.b1[to - 1] > b0 + b1; --to) {
      w.set(to, w.b0[to - 1], w.b1[to - 1], w.x[to - 1], w.y[to - 1], w.distance[to - 1], w.source[to - 1]);
    }
    if (to < i) w.set(to, b0, b1, x, y, d, source);
  }
}

std::size_t WindowPruning::prune_all(const Windows& w, std::size_t size, double length) {
  const double narrow = kLeastWidth * length;
  const auto is_left_over = [&](std::size_t i) { return w.b1[i] - w.b0[i] > narrow; };
  const auto distance_of_middle = [&](std::size_t i) {
    const double x = (w.b0[i] + w.b1[i]) / 2 - w.x[i];
    return w.distance[i] + std::sqrt(x * x + w.y[i] * w.y[i]);
  };
  nearest_first_.resize(size);
  std::iota(nearest_first_.begin(), nearest_first_.end(), std::size_t{0});
  std::ranges::sort(nearest_first_, {}, [&](std::size_t i) { return std::pair(distance_of_middle(i), i); });
  kept_.clear();
  for (const std::size_t i : nearest_first_) {
    std::size_t* lefts = lefts_.room_for(2 * kept_.size());
    std::size_t* rights = lefts + kept_.size();
    std::size_t count = 0;
    for (const std::size_t k : kept_) {
      if (!(std::min(w.b1[i], w.b1[k]) - std::max(w.b0[i], w.b0[k]) > narrow)) continue;
      const bool is_left = w.b0[i] + w.b1[i] < w.b0[k] + w.b1[k];
      lefts[count] = is_left ? i : k;
      rights[count++] = is_left ? k : i;
    }
    compare_pairs(w, count, [&](std::size_t k) { return std::pair(lefts[k], rights[k]); });
    std::erase_if(kept_, [&](std::size_t k) { return !is_left_over(k); });
    if (is_left_over(i)) kept_.push_back(i);
  }
  std::ranges::sort(kept_);
  for (std::size_t k = 0; k < kept_.size(); ++k) {
    const std::size_t i = kept_[k];
    w.set(k, w.b0[i], w.b1[i], w.x[i], w.y[i], w.distance[i], w.source[i]);
  }
  return kept_.size();
}

}  // namespace seamwire::detail
