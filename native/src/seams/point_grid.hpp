// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <span>
#include <unordered_map>
#include <vector>

#include "seamwire/surface/vector.hpp"

namespace seamwire::detail {

/// Finds the nearest of many points, within a radius.
class PointGrid {
 public:
  /// `radius`: the largest for which nearest() is asked, above zero.
  PointGrid(std::span<const Vector> points, double radius) : points_(points), radius_(radius) {
    for (std::size_t i = 0; i < points.size(); ++i) {
      cells_[key(cell(points[i]))].push_back(static_cast<std::int32_t>(i));
    }
  }

  /// The number of the nearest point, the smallest of several; -1 if none is within the radius.
  std::int32_t nearest(const Vector& to) const {
    std::int32_t found = -1;
    double least = radius_ * radius_;
    const Cell middle = cell(to);
    for (int i = 0; i < 27; ++i) {
      const auto row = cells_.find(key(middle + Cell(i % 3 - 1, i / 3 % 3 - 1, i / 9 - 1)));
      if (row == cells_.end()) continue;
      for (const std::int32_t point : row->second) {
        const double distance = (points_[point] - to).squaredNorm();
        if (distance < least || (distance == least && point < found)) {
          least = distance;
          found = point;
        }
      }
    }
    return found;
  }

 private:
  using Cell = Eigen::Matrix<std::int64_t, 3, 1>;

  Cell cell(const Vector& point) const {
    constexpr double kMost = 1e15;  // farther away, a double does not tell neighboring cells apart
    return (point / radius_).array().floor().max(-kMost).min(kMost).cast<std::int64_t>();
  }
  /// Cells far apart may share a number.
  static std::uint64_t key(const Cell& cell) {
    constexpr std::uint64_t kMost = std::uint64_t{1} << 21U;
    const auto part = [&](Eigen::Index i) { return static_cast<std::uint64_t>(cell[i]); };
    return (part(0) * kMost + part(1)) * kMost + part(2);
  }

  std::span<const Vector> points_;
  double radius_;
  std::unordered_map<std::uint64_t, std::vector<std::int32_t>> cells_;
};

}  // namespace seamwire::detail
