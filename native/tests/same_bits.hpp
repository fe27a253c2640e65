// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "numeric/instruction_sets.hpp"

namespace seamwire {

inline bool same_bits(std::span<const double> one, std::span<const double> other) {
  return std::ranges::equal(one, other, {}, std::bit_cast<std::uint64_t, double>, std::bit_cast<std::uint64_t, double>);
}

/// What each usable variant of some kernels computes has the bits of what the first one does.
template <class Kernels>
void expect_same_bits(const detail::InstructionSets<Kernels>& sets,
                      const std::function<std::vector<double>(const Kernels&)>& results) {
  const std::vector<double> plain = results(*sets.usable().front());
  for (const Kernels* variant : sets.usable()) EXPECT_TRUE(same_bits(plain, results(*variant)));
}

}  // namespace seamwire
