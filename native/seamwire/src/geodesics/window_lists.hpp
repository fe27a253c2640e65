// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <memory>
#include <vector>

namespace seamwire::detail {

/// Windows side by side, with an array for each field: the interval [b0, b1] of a half-edge through which a source is
/// seen, the source unfolded into the half-edge's frame (y < 0), its distance and its vertex. This is a view of another
/// owner's memory.
struct Windows {
  double *b0, *b1, *x, *y, *distance;
  std::int32_t* source;

  Windows operator+(std::size_t n) const { return {b0 + n, b1 + n, x + n, y + n, distance + n, source + n}; }
  Windows operator-(std::size_t n) const { return {b0 - n, b1 - n, x - n, y - n, distance - n, source - n}; }
  void set(std::size_t i, double begin, double end, double at_x, double at_y, double d, std::int32_t from) const {
    b0[i] = begin;
    b1[i] = end;
    x[i] = at_x;
    y[i] = at_y;
    distance[i] = d;
    source[i] = from;
  }
};

inline void copy(const Windows& from, std::size_t count, const Windows& to) {
  std::memcpy(to.b0, from.b0, count * sizeof(double));
  std::memcpy(to.b1, from.b1, count * sizeof(double));
  std::memcpy(to.x, from.x, count * sizeof(double));
  std::memcpy(to.y, from.y, count * sizeof(double));
  std::memcpy(to.distance, from.distance, count * sizeof(double));
  std::memcpy(to.source, from.source, count * sizeof(std::int32_t));
}

/// A contiguous piece of memory for windows: five arrays of doubles, then one of integers. The memory is an array of
/// `std::byte`, because C++20 implicitly creates the arrays of doubles and integers in it. Capacities are powers of
/// two; blocks in use are few, as only lists on the front have one, so those given back are warm in the cache when they
/// are taken again.
struct WindowBlock {
  std::byte* memory = nullptr;
  std::uint32_t capacity = 0;

  Windows windows() const {
    const std::size_t n = capacity;
    const auto doubles = [&](std::size_t field) {
      return reinterpret_cast<double*>(memory + field * n * sizeof(double));
    };
    return {doubles(0), doubles(1), doubles(2),
            doubles(3), doubles(4), reinterpret_cast<std::int32_t*>(memory + 5 * n * sizeof(double))};
  }
};

class WindowBlocks {
 public:
  static constexpr std::uint32_t kSmallest = 8;
  /// So many entries behind the last window of a list may be read. Their values do not matter.
  static constexpr std::size_t kPadding = 8;

  WindowBlock take(std::size_t at_least) {
    const auto capacity = std::bit_ceil(std::max(static_cast<std::uint32_t>(at_least), kSmallest));
    std::vector<std::byte*>& free = free_[static_cast<std::size_t>(std::countr_zero(capacity))];
    if (free.empty()) return {allocate(capacity), capacity};
    std::byte* const memory = free.back();
    free.pop_back();
    return {memory, capacity};
  }
  void give_back(const WindowBlock& block) {
    free_[static_cast<std::size_t>(std::countr_zero(block.capacity))].push_back(block.memory);
  }

 private:
  static constexpr std::size_t kChunk = std::size_t{1} << 18;  // bytes
  static constexpr std::size_t kLine = 64;                     // of the cache: blocks are whole lines
  static constexpr std::size_t kWindow = 5 * sizeof(double) + sizeof(std::int32_t);

  std::byte* allocate(std::uint32_t capacity) {
    const std::size_t used = kWindow * capacity + kPadding * sizeof(double);
    const std::size_t size = (used + kLine - 1) / kLine * kLine;
    if (size > kChunk / 4) return chunks_.emplace_back(std::make_unique_for_overwrite<std::byte[]>(size)).get();
    if (size > left_) {
      rest_ = chunks_.emplace_back(std::make_unique_for_overwrite<std::byte[]>(kChunk)).get();
      left_ = kChunk;
    }
    std::byte* const memory = rest_;
    rest_ += size;
    left_ -= size;
    return memory;
  }

  std::array<std::vector<std::byte*>, 32> free_;
  std::vector<std::unique_ptr<std::byte[]>> chunks_;
  std::byte* rest_ = nullptr;
  std::size_t left_ = 0;
};

/// The windows that wait on one half-edge, from left to right.
struct WindowList {
  WindowBlock block;
  std::uint32_t begin = 0, size = 0;

  Windows windows() const { return block.windows() + begin; }

  /// Makes room for `count` windows before the first one; returns a view of the first one (maybe none), so that room is
  /// at [-count, 0).
  Windows reserve_front(std::size_t count, WindowBlocks& blocks) {
    if (block.memory == nullptr || begin < count) move(count, 0, blocks);
    return windows();
  }
  /// Makes room for `count` windows behind the last one; returns a view of that room.
  Windows reserve_back(std::size_t count, WindowBlocks& blocks) {
    if (block.memory == nullptr || begin + size + count > block.capacity) move(0, count, blocks);
    return windows() + size;
  }
  /// Tells how much of the reserved room was used.
  void grew_front(std::size_t count) {
    begin -= static_cast<std::uint32_t>(count);
    size += static_cast<std::uint32_t>(count);
  }
  void grew_back(std::size_t count) { size += static_cast<std::uint32_t>(count); }

 private:
  void move(std::size_t front, std::size_t back, WindowBlocks& blocks) {
    const std::size_t needed = front + size + back;
    const WindowBlock larger = blocks.take(needed);
    const auto new_begin = static_cast<std::uint32_t>(front + (larger.capacity - needed) / 2);
    if (size > 0) copy(windows(), size, larger.windows() + new_begin);
    if (block.memory != nullptr) blocks.give_back(block);
    block = larger;
    begin = new_begin;
  }
};

}  // namespace seamwire::detail
