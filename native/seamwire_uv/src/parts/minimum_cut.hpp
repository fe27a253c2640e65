// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "seamwire/task.hpp"

namespace seamwire::detail {

/// A network of nodes joined by links that can be cut for a price.
class MinimumCut {
 public:
  explicit MinimumCut(std::size_t nodes) : first_(nodes, -1) {}

  /// A link between two nodes. Its price is 0 or more.
  void add(std::int32_t a, std::int32_t b, double price);

  /// The cheapest set of links that parts two nodes: 1 for each node on the side of the source. By maximum flow (Dinic
  /// 1970). Throws Cancelled.
  std::vector<std::uint8_t> source_side(std::int32_t source, std::int32_t sink, const Task& task);

 private:
  struct Arc {
    std::int32_t to = -1;
    std::int32_t next = -1;  ///< the next arc from the same node
    double left = 0.0;       ///< how much more may flow
  };
  bool find_levels(std::int32_t source, std::int32_t sink, const Task& task);
  double push(std::int32_t source, std::int32_t sink);

  std::vector<Arc> arcs_;  // arc i ^ 1 leads back
  std::vector<std::int32_t> first_, level_, next_;
};

}  // namespace seamwire::detail
