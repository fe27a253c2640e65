// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <vector>

namespace seamwire::detail {

/// Sets of the numbers below `count`, at first of one number each (union-find). A set is named after its least number,
/// so that names do not depend on the order in which sets are joined.
class DisjointSets {
 public:
  explicit DisjointSets(std::size_t count) : parent_(count) { std::iota(parent_.begin(), parent_.end(), 0); }

  /// Adds the next number as a new set, and returns it.
  std::int32_t add() {
    parent_.push_back(static_cast<std::int32_t>(parent_.size()));
    return parent_.back();
  }
  /// The name of the set that has `i`.
  std::int32_t find(std::int32_t i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  /// Joins the sets of two numbers; false if they are in one set already.
  bool join(std::int32_t a, std::int32_t b) {
    a = find(a);
    b = find(b);
    if (a == b) return false;
    parent_[std::max(a, b)] = std::min(a, b);
    return true;
  }

  /// The number of the set that has each number. Sets are numbered in the order of their names.
  struct Numbering {
    std::vector<std::int32_t> of;
    std::int32_t count = 0;
  };
  Numbering numbering() {
    Numbering sets{.of = std::vector<std::int32_t>(parent_.size())};
    for (std::int32_t i = 0; static_cast<std::size_t>(i) < parent_.size(); ++i) {
      const std::int32_t name = find(i);
      sets.of[i] = name == i ? sets.count++ : sets.of[name];
    }
    return sets;
  }

 private:
  std::vector<std::int32_t> parent_;
};

}  // namespace seamwire::detail
