// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <span>
#include <vector>

#include "seamwire/surface/vector.hpp"
#include "seamwire/task.hpp"

namespace seamwire::detail {

/// Finds the nearest of many points, within a radius: a balanced k-d tree (Bentley 1975).
class PointTree {
 public:
  /// The points must outlive the tree. Throws Cancelled.
  explicit PointTree(std::span<const Vector> points, const Task& task) : points_(points), order_(points.size()) {
    std::iota(order_.begin(), order_.end(), 0);
    axes_.resize(points.size());
    build(0, order_.size(), task);
  }

  struct Nearest {
    std::int32_t point = -1;    ///< the smallest of several at the same distance; -1 if no point is within the radius
    std::size_t looked_at = 0;  ///< how many points the search looked at
  };
  /// `radius`: points at this distance and farther away are ignored.
  Nearest nearest(const Vector& to, double radius) const {
    Nearest found;
    double least = radius * radius;
    look(0, order_.size(), to, least, found);
    return found;
  }

 private:
  /// A range of the order is a node. Its middle point parts the others along an axis.
  void build(std::size_t begin, std::size_t end, const Task& task) {
    constexpr std::size_t kPolled = 4096;
    if (end - begin < 2) return;
    if (end - begin > kPolled) task.check(0.0);
    Vector low = points_[order_[begin]], high = low;
    for (std::size_t i = begin; i < end; ++i) {
      low = low.cwiseMin(points_[order_[i]]);
      high = high.cwiseMax(points_[order_[i]]);
    }
    Eigen::Index axis = 0;
    (high - low).maxCoeff(&axis);
    const std::size_t middle = begin + (end - begin) / 2;
    const auto at = [&](std::size_t i) { return order_.begin() + static_cast<std::ptrdiff_t>(i); };
    std::nth_element(at(begin), at(middle), at(end),
                     [&](std::int32_t a, std::int32_t b) { return points_[a][axis] < points_[b][axis]; });
    axes_[middle] = static_cast<std::uint8_t>(axis);
    build(begin, middle, task);
    build(middle + 1, end, task);
  }

  void look(std::size_t begin, std::size_t end, const Vector& to, double& least, Nearest& found) const {
    while (begin < end) {
      const std::size_t middle = begin + (end - begin) / 2;
      const std::int32_t point = order_[middle];
      const double distance = (points_[point] - to).squaredNorm();
      ++found.looked_at;
      if (distance < least || (distance == least && found.point >= 0 && point < found.point)) {
        least = distance;
        found.point = point;
      }
      const double away = to[axes_[middle]] - points_[point][axes_[middle]];
      const bool is_low = away < 0.0;
      if (is_low) {
        look(begin, middle, to, least, found);
      } else {
        look(middle + 1, end, to, least, found);
      }
      if (away * away > least) return;
      if (is_low) {
        begin = middle + 1;
      } else {
        end = middle;
      }
    }
  }

  std::span<const Vector> points_;
  std::vector<std::int32_t> order_;
  std::vector<std::uint8_t> axes_;  // by place in the order
};

}  // namespace seamwire::detail
