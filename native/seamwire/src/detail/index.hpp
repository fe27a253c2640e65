// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

#include "seamwire/errors.hpp"

namespace seamwire::detail {

/// An element's number as a size, to compare it with one. Subscripts take numbers as they are.
constexpr std::size_t index(std::int32_t i) { return static_cast<std::size_t>(i); }

/// Whether there is an element of this number among `count`.
constexpr bool is_index(std::int32_t i, std::size_t count) { return i >= 0 && index(i) < count; }

/// Throws InvalidInput where there is no element `i` among `count` of a kind: "WHAT i is out of range: there are COUNT
/// KIND". `what` says where the number was given, and what of: "seed", "triangle 3: vertex".
inline void check_index(std::int32_t i, std::size_t count, const std::string& what, const char* kind = "vertices") {
  if (is_index(i, count)) return;
  throw InvalidInput(what + " " + std::to_string(i) + " is out of range: there are " + std::to_string(count) + " " +
                     kind);
}

}  // namespace seamwire::detail
