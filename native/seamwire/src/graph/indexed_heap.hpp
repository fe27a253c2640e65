// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "detail/zeroed_array.hpp"

namespace seamwire::detail {

/// A priority queue of numbers, each in it once at most: least key first; of equal keys, the lesser number, so that the
/// order is the same everywhere. A heap of four children a node that knows where each number is.
class IndexedHeap {
 public:
  /// For the numbers below `size`.
  explicit IndexedHeap(std::size_t size) : place_(size) {}

  bool empty() const { return heap_.empty(); }

  std::int32_t least() const { return heap_.front().second; }
  double least_key() const { return heap_.front().first; }

  /// Puts a number in, or gives it a key that is not greater than the one it has.
  void lower(std::int32_t number, double key) {
    std::int32_t& place = place_[number];
    if (place == 0) {
      heap_.emplace_back();
      place = static_cast<std::int32_t>(heap_.size());
    }
    rise(static_cast<std::size_t>(place - 1), {key, number});
  }

  void clear() {
    for (const Entry& entry : heap_) place_[entry.second] = 0;
    heap_.clear();
  }

  std::int32_t pop() {
    const std::int32_t least = heap_.front().second;
    place_[least] = 0;
    const Entry last = heap_.back();
    heap_.pop_back();
    if (!heap_.empty()) sink(last);
    return least;
  }

 private:
  using Entry = std::pair<double, std::int32_t>;

  void put(std::size_t at, const Entry& entry) {
    heap_[at] = entry;
    place_[entry.second] = static_cast<std::int32_t>(at) + 1;
  }
  void rise(std::size_t at, const Entry& entry) {
    while (at > 0) {
      const std::size_t parent = (at - 1) / 4;
      if (!(entry < heap_[parent])) break;
      put(at, heap_[parent]);
      at = parent;
    }
    put(at, entry);
  }
  void sink(const Entry& entry) {
    std::size_t at = 0;
    for (;;) {
      const std::size_t first = 4 * at + 1, end = std::min(first + 4, heap_.size());
      if (first >= end) break;
      std::size_t least = first;
      for (std::size_t child = first + 1; child < end; ++child) {
        if (heap_[child] < heap_[least]) least = child;
      }
      if (!(heap_[least] < entry)) break;
      put(at, heap_[least]);
      at = least;
    }
    put(at, entry);
  }

  std::vector<Entry> heap_;
  ZeroedArray<std::int32_t> place_;  ///< of each number in the heap, plus one; 0: it is not there
};

}  // namespace seamwire::detail
