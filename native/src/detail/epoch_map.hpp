// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace seamwire::detail {

/// Values for some of the numbers below `size`, all of which can be forgotten at once, in constant time.
class EpochMap {
 public:
  explicit EpochMap(std::size_t size) : slots_(size) {}
  void clear() { ++epoch_; }
  bool has(std::int32_t i) const { return slots_[i].epoch == epoch_; }
  std::uint32_t at(std::int32_t i) const { return slots_[i].value; }
  void set(std::int32_t i, std::size_t value) { slots_[i] = {epoch_, static_cast<std::uint32_t>(value)}; }

 private:
  struct Slot {
    std::uint32_t epoch = 0, value = 0;
  };
  std::vector<Slot> slots_;
  std::uint32_t epoch_ = 1;
};

}  // namespace seamwire::detail
