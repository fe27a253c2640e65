// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <utility>
#include <vector>

#include "detail/infinity.hpp"

namespace seamwire::detail {

/// The edges at one vertex, for searches that pay for turns. Paths arrive over edges, each at a cost. The tree finds
/// the arrival from which another edge is reached most cheaply, without a look at every pair of edges.
///
/// A turn costs `1 + a . b`, where a and b are vectors of the two edges. So a box around the vectors of some edges
/// bounds the turns from all of them.
class ArrivalTree {
 public:
  using Direction = std::array<double, 3>;

  /// `count` edges, numbered from 0. `direction(i)`: the vector of an edge.
  template <class DirectionOf>
  ArrivalTree(std::size_t count, const DirectionOf& direction) : order_(count), leaf_(count) {
    std::iota(order_.begin(), order_.end(), 0);
    std::vector<Direction> directions(count);
    for (std::size_t i = 0; i < count; ++i) directions[i] = direction(static_cast<std::int32_t>(i));
    if (count > 0) build(directions, 0, count, -1);
  }

  /// A path has arrived over an edge, for the first time.
  void arrive(std::int32_t edge, double cost) {
    for (std::int32_t n = leaf_[static_cast<std::size_t>(edge)]; n >= 0;) {
      Node& node = nodes_[static_cast<std::size_t>(n)];
      node.least = std::min(node.least, cost);
      --node.missing;
      n = node.above;
    }
  }

  /// A lower bound of the turn onto an edge from those over which no path has arrived. Infinite once paths have arrived
  /// over all of them.
  /// `direction`: the vector of the edge.
  double least_turn_missing(const Direction& direction) const {
    double best = kInfinity;
    if (!nodes_.empty() && nodes_.front().missing > 0) find_missing(0, direction, best);
    return best * (1.0 - kRounding);
  }

  /// Calls `visit(edge)` for arrivals from which an edge may cost less than all that were visited: `visit` returns the
  /// least cost so far. `direction`: the vector of that edge. `weight`: what a turn of 1 costs. `rest`: what is paid in
  /// any case.
  template <class Visit>
  void visit_best(const Direction& direction, double weight, double rest, const Visit& visit) const {
    double best = kInfinity;
    if (!nodes_.empty()) descend(0, direction, weight, rest, best, visit);
  }

 private:
  static constexpr std::size_t kLeafSize = 4;
  static constexpr double kRounding = 1e-9;  // much more than costs are rounded by

  struct Node {
    Direction low, high;  // the box around the vectors
    double least;         // the least cost of an arrival
    std::size_t missing;  // edges over which no path has arrived
    std::int32_t above, left, right;
    std::size_t begin, end;  // in order_
  };

  std::int32_t build(const std::vector<Direction>& directions, std::size_t begin, std::size_t end, std::int32_t above) {
    const auto number = static_cast<std::int32_t>(nodes_.size());
    Node node{.low = {kInfinity, kInfinity, kInfinity},
              .high = {-kInfinity, -kInfinity, -kInfinity},
              .least = kInfinity,
              .missing = end - begin,
              .above = above,
              .left = -1,
              .right = -1,
              .begin = begin,
              .end = end};
    const auto at = [&](std::int32_t edge) -> const Direction& { return directions[static_cast<std::size_t>(edge)]; };
    for (std::size_t i = begin; i < end; ++i) {
      for (std::size_t k = 0; k < 3; ++k) {
        node.low[k] = std::min(node.low[k], at(order_[i])[k]);
        node.high[k] = std::max(node.high[k], at(order_[i])[k]);
      }
    }
    nodes_.push_back(node);
    if (end - begin <= kLeafSize) {
      for (std::size_t i = begin; i < end; ++i) leaf_[static_cast<std::size_t>(order_[i])] = number;
      return number;
    }
    std::size_t widest = 0;
    for (std::size_t k = 1; k < 3; ++k) {
      if (node.high[k] - node.low[k] > node.high[widest] - node.low[widest]) widest = k;
    }
    const std::size_t middle = begin + (end - begin) / 2;
    const auto from = order_.begin();
    std::nth_element(from + static_cast<std::ptrdiff_t>(begin), from + static_cast<std::ptrdiff_t>(middle),
                     from + static_cast<std::ptrdiff_t>(end),
                     [&](std::int32_t a, std::int32_t b) { return at(a)[widest] < at(b)[widest]; });
    const std::int32_t left = build(directions, begin, middle, number);
    const std::int32_t right = build(directions, middle, end, number);
    nodes_[static_cast<std::size_t>(number)].left = left;
    nodes_[static_cast<std::size_t>(number)].right = right;
    return number;
  }

  static double least_turn(const Node& node, const Direction& direction) {
    double turn = 1.0;
    for (std::size_t k = 0; k < 3; ++k) turn += std::min(node.low[k] * direction[k], node.high[k] * direction[k]);
    return std::max(0.0, turn);
  }
  static double bound(const Node& node, const Direction& direction, double weight) {
    return node.least == kInfinity ? kInfinity : node.least + weight * least_turn(node, direction);
  }

  /// Of a node that is split no further, the bound of its box will do.
  void find_missing(std::int32_t number, const Direction& direction, double& best) const {
    const Node& node = nodes_[static_cast<std::size_t>(number)];
    if (node.left < 0) {
      best = std::min(best, least_turn(node, direction));
      return;
    }
    std::array<std::int32_t, 2> below{node.left, node.right};
    std::array<double, 2> turns{};
    for (std::size_t k = 0; k < 2; ++k) {
      const Node& half = nodes_[static_cast<std::size_t>(below[k])];
      turns[k] = half.missing == 0 ? kInfinity : least_turn(half, direction);
    }
    if (turns[1] < turns[0]) {
      std::swap(below[0], below[1]);
      std::swap(turns[0], turns[1]);
    }
    for (std::size_t k = 0; k < 2; ++k) {
      if (turns[k] < best) find_missing(below[k], direction, best);
    }
  }

  template <class Visit>
  void descend(std::int32_t number, const Direction& direction, double weight, double rest, double& best,
               const Visit& visit) const {
    const Node& node = nodes_[static_cast<std::size_t>(number)];
    if (node.left < 0) {
      for (std::size_t i = node.begin; i < node.end; ++i) best = visit(order_[i]);
      return;
    }
    std::array<std::int32_t, 2> below{node.left, node.right};
    std::array<double, 2> bounds{bound(nodes_[static_cast<std::size_t>(below[0])], direction, weight),
                                 bound(nodes_[static_cast<std::size_t>(below[1])], direction, weight)};
    if (bounds[1] < bounds[0]) {
      std::swap(below[0], below[1]);
      std::swap(bounds[0], bounds[1]);
    }
    for (std::size_t k = 0; k < 2; ++k) {
      if (bounds[k] < kInfinity && (bounds[k] + rest) * (1.0 - kRounding) <= best) {
        descend(below[k], direction, weight, rest, best, visit);
      }
    }
  }

  std::vector<std::int32_t> order_;  // the edges, such that those of each node follow each other
  std::vector<std::int32_t> leaf_;   // of each edge: the node that is split no further
  std::vector<Node> nodes_;
};

}  // namespace seamwire::detail
