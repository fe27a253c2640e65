// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "detail/index.hpp"

namespace seamwire::detail {

/// Different numbers, each with its position in the order in which they were inserted. An open hash table: the nodes of
/// std::unordered_map would take longer than all the rest of what it is used for here.
class InsertionMap {
 public:
  /// The number's position, and whether it is new.
  std::pair<std::int32_t, bool> insert(std::int32_t number) {
    if (2 * (numbers_.size() + 1) > table_.size()) grow();
    std::int32_t& slot = table_[slot_of(number)];
    if (slot >= 0) return {slot, false};
    slot = static_cast<std::int32_t>(numbers_.size());
    numbers_.push_back(number);
    return {slot, true};
  }
  /// The number's position, or -1.
  std::int32_t find(std::int32_t number) const { return table_.empty() ? -1 : table_[slot_of(number)]; }
  /// By position.
  const std::vector<std::int32_t>& numbers() const { return numbers_; }

 private:
  std::size_t slot_of(std::int32_t number) const {
    const std::size_t mask = table_.size() - 1;
    std::size_t slot = (index(number) * 0x9E3779B97F4A7C15ull >> 32) & mask;
    while (table_[slot] >= 0 && numbers_[table_[slot]] != number) slot = (slot + 1) & mask;
    return slot;
  }
  void grow() {
    table_.assign(std::max<std::size_t>(64, 4 * table_.size()), -1);
    for (std::size_t i = 0; i < numbers_.size(); ++i) table_[slot_of(numbers_[i])] = static_cast<std::int32_t>(i);
  }

  std::vector<std::int32_t> numbers_;
  std::vector<std::int32_t> table_;  // positions, -1: free; the size is a power of two, and at least half is free
};

}  // namespace seamwire::detail
