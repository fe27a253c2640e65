// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <span>
#include <utility>
#include <vector>

#include "detail/index.hpp"

namespace seamwire::detail {

/// Rows of items, one row after the other in one array (compressed sparse rows).
template <class T>
class Csr {
 public:
  /// No rows; to be filled with push() and end_row().
  Csr() : offsets_(1, 0) {}

  /// `for_each(visit)` calls visit(row, item) for each item, and is called twice: once to count, once to fill. Items of
  /// a row stay in the order in which they come.
  template <class ForEach>
  Csr(std::size_t row_count, const ForEach& for_each) : offsets_(row_count + 1, 0) {
    for_each([&](std::int32_t row, const T&) { ++offsets_[row + 1]; });
    std::partial_sum(offsets_.begin(), offsets_.end(), offsets_.begin());
    items_.resize(index(offsets_.back()));
    std::vector<std::int32_t> next(offsets_.begin(), offsets_.end() - 1);
    for_each([&](std::int32_t row, const T& item) { items_[next[row]++] = item; });
  }

  /// From pairs of a row and an item.
  Csr(std::size_t row_count, const std::vector<std::pair<std::int32_t, T>>& pairs)
      : Csr(row_count, [&pairs](const auto& visit) {
          for (const auto& [row, item] : pairs) visit(row, item);
        }) {}

  std::span<const T> operator[](std::int32_t row) const {
    return {items_.data() + offsets_[row], static_cast<std::size_t>(offsets_[row + 1] - offsets_[row])};
  }
  /// Where a row begins in items(); for the number of rows, where the last one ends.
  std::size_t row_count() const { return offsets_.size() - 1; }
  const std::vector<T>& items() const { return items_; }

  /// The same with another number of rows, new ones empty, and with some rows, ascending, filled anew:
  /// `fill(row, add)` calls add(item) for each of its items.
  template <class Fill>
  Csr with_rows(std::size_t row_count, std::span<const std::int32_t> rows, const Fill& fill) const {
    Csr out;
    out.reserve(row_count, items_.size() + items_.size() / 8);
    const auto copy_until = [&](std::size_t end) {
      const std::size_t first = out.row_count(), kept = std::min(end, this->row_count());
      if (first < kept) {
        const auto shift = static_cast<std::int32_t>(out.items_.size()) - offsets_[first];
        out.items_.insert(out.items_.end(), items_.begin() + offsets_[first], items_.begin() + offsets_[kept]);
        for (std::size_t row = first; row < kept; ++row) out.offsets_.push_back(offsets_[row + 1] + shift);
      }
      while (out.row_count() < end) out.end_row();
    };
    for (const std::int32_t row : rows) {
      copy_until(index(row));
      fill(row, [&out](const T& item) { out.push(item); });
      out.end_row();
    }
    copy_until(row_count);
    return out;
  }

  void reserve(std::size_t row_count, std::size_t item_count) {
    offsets_.reserve(row_count + 1);
    items_.reserve(item_count);
  }
  void push(const T& item) { items_.push_back(item); }
  void end_row() { offsets_.push_back(static_cast<std::int32_t>(items_.size())); }

 private:
  std::vector<std::int32_t> offsets_;
  std::vector<T> items_;
};

}  // namespace seamwire::detail
