// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <vector>

#include "detail/index.hpp"
#include "seamwire/surface/vector.hpp"

namespace seamwire::detail {

using Box = Eigen::AlignedBox3d;

/// A tree of boxes around items, such as triangles, points, or the segments of a line.
struct BoxTree {
  /// A node holds a few items, or two nodes that follow each other in `nodes`.
  struct Node {
    Box box;
    std::int32_t first = 0;  ///< in `order`, or in `nodes` where `count` is 0
    std::int32_t count = 0;
  };
  /// Halves are never empty, so the tree is no deeper than a number has bits.
  static constexpr std::size_t kMostDepth = 64;
  /// A part of a squared distance from a box that is more than rounding may add to it.
  static constexpr double kRounded = 1.0 - 1e-12;

  std::vector<std::int32_t> order;  ///< the items, node by node; those with an empty box are left out
  std::vector<Node> nodes;          ///< the first node holds all items; empty without items

  /// Builds it for `count` items. It parts items in halves by the middles of their boxes, along the axis on which these
  /// lie farthest apart. `box_of(i)`: the box of an item. `goes_on()` is asked now and then, and ends the building by
  /// returning false. Returns whether the tree is built.
  template <class BoxOf, class GoesOn>
  bool build(std::size_t count, const BoxOf& box_of, const GoesOn& goes_on) {
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
    const auto part = [&](std::int32_t first, std::int32_t size) {
      const auto begin = middles.begin() + first, middle = begin + size / 2, end = begin + size;
      Box spread;
      for (auto item = begin; item != end; ++item) spread.extend(item->at);
      Eigen::Index axis = 0;
      spread.sizes().maxCoeff(&axis);
      std::nth_element(begin, middle, end, [&](const Middle& s, const Middle& t) { return s.at[axis] < t.at[axis]; });
    };
    if (!halve(middles.size(), part, goes_on)) return false;
    order.reserve(middles.size());
    for (const Middle& item : middles) order.push_back(item.item);
    return enclose(box_of, goes_on);
  }

  /// Builds it for `count` items that follow each other. It parts them in their order.
  template <class BoxOf>
  void build_in_order(std::size_t count, const BoxOf& box_of) {
    constexpr auto kGoesOn = [] { return true; };
    halve(
        count, [](std::int32_t, std::int32_t) {}, kGoesOn);
    order.resize(count);
    std::iota(order.begin(), order.end(), 0);
    enclose(box_of, kGoesOn);
  }

  /// Calls visit(i, least) for the items order[i] that may be near a place: those in boxes whose squared distance times
  /// `rounded` is no more than `least`, which `visit` may lower. Nearer boxes come first. `rounded`: kRounded, or 1 if
  /// items may be missed that are nearer than their box by rounding.
  template <class Visit>
  void visit_near(const Vector& place, double least, double rounded, const Visit& visit) const {
    struct Waiting {
      std::int32_t node;
      double off;
    };
    const auto waiting_at = [&](std::int32_t node) {
      return Waiting{.node = node, .off = rounded * squared_distance(nodes[node].box, place)};
    };
    std::array<Waiting, kMostDepth> waiting;
    std::size_t count = 0;
    if (!nodes.empty()) waiting[count++] = waiting_at(0);
    while (count > 0) {
      const Waiting next = waiting[--count];
      if (next.off > least) continue;
      const Node& node = nodes[next.node];
      for (std::int32_t i = node.first; i < node.first + node.count; ++i) visit(i, least);
      if (node.count > 0) continue;
      const Waiting one = waiting_at(node.first), other = waiting_at(node.first + 1);
      const bool one_is_near = one.off <= other.off;
      waiting[count++] = one_is_near ? other : one;
      waiting[count++] = one_is_near ? one : other;
    }
  }

  /// Calls visit(i) for the items order[i] in boxes that meet a box, until visit returns false. Returns false if it
  /// did.
  template <class Visit>
  bool visit_in(const Box& within, const Visit& visit) const {
    std::array<std::int32_t, kMostDepth> waiting;
    std::size_t count = 0;
    if (!nodes.empty()) waiting[count++] = 0;
    while (count > 0) {
      const Node& node = nodes[waiting[--count]];
      if (!within.intersects(node.box)) continue;
      for (std::int32_t i = node.first; i < node.first + node.count; ++i) {
        if (!visit(i)) return false;
      }
      if (node.count > 0) continue;
      waiting[count++] = node.first;
      waiting[count++] = node.first + 1;
    }
    return true;
  }

 private:
  static constexpr std::int32_t kMostInANode = 4;
  static constexpr std::size_t kWorkBetweenChecks = 16384;

  /// As AlignedBox::squaredExteriorDistance(), without its branches.
  static double squared_distance(const Box& box, const Vector& place) {
    double sum = 0.0;
    for (int axis = 0; axis < 3; ++axis) {
      const double off = std::max({box.min()[axis] - place[axis], place[axis] - box.max()[axis], 0.0});
      sum += off * off;
    }
    return sum;
  }

  /// Makes nodes without boxes. `part(first, size)` moves the items of a node to the half that they belong in.
  template <class Part, class GoesOn>
  bool halve(std::size_t count, const Part& part, const GoesOn& goes_on) {
    if (count == 0) return true;
    nodes.reserve(count);
    nodes.push_back({.box = {}, .first = 0, .count = static_cast<std::int32_t>(count)});
    for (std::size_t n = 0; n < nodes.size(); ++n) {
      const std::int32_t first = nodes[n].first, size = nodes[n].count;
      if ((n % kWorkBetweenChecks == 0 || index(size) > kWorkBetweenChecks) && !goes_on()) return false;
      if (size <= kMostInANode) continue;
      part(first, size);
      nodes[n].first = static_cast<std::int32_t>(nodes.size());
      nodes[n].count = 0;
      nodes.push_back({.box = {}, .first = first, .count = size / 2});
      nodes.push_back({.box = {}, .first = first + size / 2, .count = size - size / 2});
    }
    return true;
  }

  template <class BoxOf, class GoesOn>
  bool enclose(const BoxOf& box_of, const GoesOn& goes_on) {
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
