// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "detail/index.hpp"
#include "seamwire/surface/vector.hpp"

namespace seamwire::detail {

using Box = Eigen::AlignedBox3d;

/// A tree of boxes around items. It parts items in halves by the middles of their boxes, along the axis on which these
/// lie farthest apart.
struct BoxTree {
  /// Its items, where they are few; else two nodes that hold them, side by side.
  struct Node {
    Box box;
    std::int32_t first = 0;  ///< in `order`, or in `nodes` where `count` is 0
    std::int32_t count = 0;
  };
  /// Halves are never empty, so the tree is no deeper than a number has bits.
  static constexpr std::size_t kMostDepth = 64;

  std::vector<std::int32_t> order;  ///< the items, node by node; those with an empty box are left out
  std::vector<Node> nodes;          ///< the first one holds all; none: there are no items

  /// Builds it for `count` items. `box_of(i)`: the box of an item. `goes_on()` is asked now and then, and ends the
  /// building by returning false. Returns whether the tree is built.
  template <class BoxOf, class GoesOn>
  bool build(std::size_t count, const BoxOf& box_of, const GoesOn& goes_on) {
    constexpr std::int32_t kMostInANode = 4;
    constexpr std::size_t kWorkBetweenChecks = 16384;
    // What moves when a node is parted lies in a row: most of the time here is waiting for memory.
    struct Middle {
      Vector at;
      std::int32_t item;
    };
    std::vector<Middle> middles;
    middles.reserve(count);
    for (std::size_t i = 0; i < count; ++i) {
      if (i % kWorkBetweenChecks == 0 && !goes_on()) return false;
      const Box box = box_of(static_cast<std::int32_t>(i));
      if (!box.isEmpty()) middles.push_back({box.min() / 2 + box.max() / 2, static_cast<std::int32_t>(i)});
    }
    if (middles.empty()) return true;
    nodes.reserve(middles.size());
    nodes.push_back({.box = {}, .first = 0, .count = static_cast<std::int32_t>(middles.size())});
    for (std::size_t n = 0; n < nodes.size(); ++n) {
      const std::int32_t first = nodes[n].first, size = nodes[n].count;
      if ((n % kWorkBetweenChecks == 0 || index(size) > kWorkBetweenChecks) && !goes_on()) return false;
      if (size <= kMostInANode) continue;
      const auto begin = middles.begin() + first, middle = begin + size / 2, end = begin + size;
      Box spread;
      for (auto item = begin; item != end; ++item) spread.extend(item->at);
      Eigen::Index axis = 0;
      spread.sizes().maxCoeff(&axis);
      std::nth_element(begin, middle, end, [&](const Middle& s, const Middle& t) { return s.at[axis] < t.at[axis]; });
      nodes[n].first = static_cast<std::int32_t>(nodes.size());
      nodes[n].count = 0;
      nodes.push_back({.box = {}, .first = first, .count = size / 2});
      nodes.push_back({.box = {}, .first = first + size / 2, .count = size - size / 2});
    }
    order.reserve(middles.size());
    for (const Middle& item : middles) order.push_back(item.item);
    // A node comes before the two that it is parted in.
    for (std::size_t n = nodes.size(); n-- > 0;) {
      Node& node = nodes[n];
      if (n % kWorkBetweenChecks == 0 && !goes_on()) return false;
      for (std::int32_t i = 0; i < node.count; ++i) node.box.extend(box_of(order[node.first + i]));
      if (node.count == 0) node.box = nodes[node.first].box.merged(nodes[node.first + 1].box);
    }
    return true;
  }
};

}  // namespace seamwire::detail
