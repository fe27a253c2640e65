// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <functional>
#include <vector>

namespace seamwire::detail {

/// Keeps the first of items with equal keys that follow each other. It does not call std::ranges::unique, because Clang
/// 14 cannot compile that with GCC 12's library.
template <class T, class KeyOf = std::identity>
void drop_repeats(std::vector<T>& items, const KeyOf& key_of = {}) {
  const auto have_equal_keys = [&](const T& one, const T& other) {
    return std::invoke(key_of, one) == std::invoke(key_of, other);
  };
  items.erase(std::unique(items.begin(), items.end(), have_equal_keys), items.end());
}

}  // namespace seamwire::detail
