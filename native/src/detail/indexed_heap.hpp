// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace seamwire {

/// Vertices by distance, least first; of equal ones the one with the lower number, so that the order is the same
/// everywhere. A heap of four children a node, whose entries know their place: a vertex is in it once.
class VertexQueue {
 public:
  explicit VertexQueue(std::size_t vertex_count) : place_(vertex_count, -1) {}

  bool empty() const { return heap_.empty(); }

  std::int32_t least() const { return heap_.front().second; }

  /// Puts a vertex in, or moves it to a lesser distance than it has.
  void lower(std::int32_t vertex, double distance) {
    std::int32_t& place = place_[static_cast<std::size_t>(vertex)];
    if (place < 0) {
      place = static_cast<std::int32_t>(heap_.size());
      heap_.emplace_back();
    }
    rise(static_cast<std::size_t>(place), {distance, vertex});
  }

  std::int32_t pop() {
    const std::int32_t least = heap_.front().second;
    place_[static_cast<std::size_t>(least)] = -1;
    const Entry last = heap_.back();
    heap_.pop_back();
    if (!heap_.empty()) sink(last);
    return least;
  }

 private:
  using Entry = std::pair<double, std::int32_t>;

  void put(std::size_t at, const Entry& entry) {
    heap_[at] = entry;
    place_[static_cast<std::size_t>(entry.second)] = static_cast<std::int32_t>(at);
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
  std::vector<std::int32_t> place_;
};

}  // namespace seamwire
