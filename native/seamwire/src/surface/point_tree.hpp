// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "seamwire/surface/vector.hpp"
#include "seamwire/task.hpp"
#include "surface/box_tree.hpp"

namespace seamwire::detail {

/// Finds the nearest of many points, within a radius.
class PointTree {
 public:
  /// The points must be finite. Throws Cancelled.
  PointTree(std::span<const Vector> points, const Task& task) {
    tree_.build(
        points.size(), [&](std::int32_t i) { return Box(points[i]); },
        [&task] {
          task.check(0.0);
          return true;
        });
    points_.reserve(points.size());
    for (const std::int32_t i : tree_.order) points_.push_back(points[i]);
  }

  /// The nearest point, the smallest of several at the same distance; -1 if no point is within the radius. `radius`:
  /// points at this distance and farther away are ignored.
  std::int32_t nearest(const Vector& to, double radius) const {
    std::int32_t found = -1;
    tree_.visit_near(to, radius * radius, BoxTree::kRounded, [&](std::int32_t i, double& least) {
      const double distance = (points_[i] - to).squaredNorm();
      const std::int32_t point = tree_.order[i];
      if (!(distance < least || (distance == least && found >= 0 && point < found))) return;
      least = distance;
      found = point;
    });
    return found;
  }

 private:
  BoxTree tree_;
  std::vector<Vector> points_;  // in the order of the tree
};

}  // namespace seamwire::detail
