// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "detail/csr.hpp"
#include "detail/infinity.hpp"

namespace seamwire::detail {

/// An axis-aligned box in the plane.
struct Box {
  std::array<double, 2> low{kInfinity, kInfinity};
  std::array<double, 2> high{-kInfinity, -kInfinity};

  /// Grows to contain a point and what is closer to it than `reach` along both axes.
  void add(const double* point, double reach = 0.0) {
    for (std::size_t k = 0; k < 2; ++k) {
      low[k] = std::min(low[k], point[k] - reach);
      high[k] = std::max(high[k], point[k] + reach);
    }
  }
  /// The longer side.
  double size() const { return std::max(high[0] - low[0], high[1] - low[1]); }
  bool meets(const Box& other) const {
    return low[0] <= other.high[0] && other.low[0] <= high[0] && low[1] <= other.high[1] && other.low[1] <= high[1];
  }
};

/// Finds the boxes that meet a box: about as many cells as boxes, each listing the boxes in it.
class BoxGrid {
 public:
  explicit BoxGrid(std::span<const Box> boxes) : boxes_(boxes.begin(), boxes.end()) {
    for (const Box& box : boxes) {
      all_.add(box.low.data());
      all_.add(box.high.data());
    }
    const double width = all_.high[0] - all_.low[0], height = all_.high[1] - all_.low[1];
    const double cell = std::max({std::sqrt(width * height / static_cast<double>(boxes.size())),
                                  std::max(width, height) / static_cast<double>(boxes.size())});
    for (std::size_t k = 0; k < 2; ++k) {
      const double extent = all_.high[k] - all_.low[k];
      counts_[k] = cell > 0.0 ? std::clamp(static_cast<std::int32_t>(extent / cell), 1, 1 << 15) : 1;
      scale_[k] = extent > 0.0 ? counts_[k] / extent : 0.0;
    }
    cells_ = Csr<std::int32_t>(
        static_cast<std::size_t>(counts_[0]) * static_cast<std::size_t>(counts_[1]), [&](const auto& visit) {
          for (std::size_t i = 0; i < boxes_.size(); ++i) {
            for_each_cell(boxes_[i],
                          [&](std::int32_t cell_number) { visit(cell_number, static_cast<std::int32_t>(i)); });
          }
        });
  }

  /// visit(i) for each box that meets `box`, once.
  template <class Visit>
  void for_each_meeting(const Box& box, const Visit& visit) const {
    if (boxes_.empty() || !all_.meets(box)) return;
    for_each_cell(box, [&](std::int32_t cell) {
      for (const std::int32_t i : cells_[cell]) {
        const Box& other = boxes_[i];
        if (!other.meets(box)) continue;
        // Both may share several cells: only the first of these counts.
        const std::int32_t column = std::max(cell_of(box.low[0], 0), cell_of(other.low[0], 0));
        const std::int32_t row = std::max(cell_of(box.low[1], 1), cell_of(other.low[1], 1));
        if (row * counts_[0] + column == cell) visit(i);
      }
    });
  }

 private:
  std::int32_t cell_of(double value, std::size_t axis) const {
    const double cell = (value - all_.low[axis]) * scale_[axis];
    return static_cast<std::int32_t>(std::clamp(cell, 0.0, static_cast<double>(counts_[axis] - 1)));
  }
  template <class Visit>
  void for_each_cell(const Box& box, const Visit& visit) const {
    const std::int32_t begin = cell_of(box.low[0], 0), end = cell_of(box.high[0], 0);
    for (std::int32_t row = cell_of(box.low[1], 1); row <= cell_of(box.high[1], 1); ++row) {
      for (std::int32_t column = begin; column <= end; ++column) visit(row * counts_[0] + column);
    }
  }

  std::vector<Box> boxes_;
  Box all_;
  std::array<std::int32_t, 2> counts_{1, 1};
  std::array<double, 2> scale_{};
  Csr<std::int32_t> cells_;
};

}  // namespace seamwire::detail
