// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "detail/csr.hpp"
#include "detail/index.hpp"

namespace seamwire::detail {

/// Follows chains of edges, which are pairs of different nodes. Each edge is in one chain.
class EdgeChains {
 public:
  using Edge = std::array<std::int32_t, 2>;
  struct Chain {
    std::vector<std::int32_t> nodes;  ///< a closed chain ends with its first node
    std::vector<std::int32_t> edges;  ///< one less
  };

  /// For nodes below `node_count`. The edges must outlive this.
  EdgeChains(std::size_t node_count, std::span<const Edge> edges)
      : edges_(edges), is_taken_(edges.size(), 0), at_(node_count, [&](const auto& visit) {
          for (std::int32_t e = 0; index(e) < edges.size(); ++e) {
            for (const std::int32_t node : edges[e]) visit(node, e);
          }
        }) {}

  /// The edges at a node, ascending.
  std::span<const std::int32_t> at(std::int32_t node) const { return at_[node]; }
  bool is_taken(std::int32_t edge) const { return is_taken_[edge] != 0; }

  /// Takes the edges from a node on, beginning with one of its edges that is not taken. A chain ends where other than
  /// two edges meet, where is_end(node) returns true, and where it is closed.
  template <class IsEnd>
  Chain follow(std::int32_t node, std::int32_t edge, const IsEnd& is_end) {
    Chain chain{.nodes = {node}, .edges = {}};
    do {
      is_taken_[edge] = 1;
      chain.edges.push_back(edge);
      node = edges_[edge][0] == node ? edges_[edge][1] : edges_[edge][0];
      chain.nodes.push_back(node);
      if (at(node).size() != 2 || is_end(node)) break;
      edge = at(node)[0] == edge ? at(node)[1] : at(node)[0];
    } while (!is_taken(edge));
    return chain;
  }

  /// The nodes of all chains, by their first nodes: those that begin at an end, then closed ones.
  template <class IsEnd>
  std::vector<std::vector<std::int32_t>> all(const IsEnd& is_end) {
    std::vector<std::vector<std::int32_t>> chains;
    for (const bool is_open : {true, false}) {
      for (std::int32_t node = 0; index(node) < at_.row_count(); ++node) {
        if (is_open && at(node).size() == 2 && !is_end(node)) continue;
        for (const std::int32_t edge : at(node)) {
          if (!is_taken(edge)) chains.push_back(std::move(follow(node, edge, is_end).nodes));
        }
      }
    }
    return chains;
  }

 private:
  std::span<const Edge> edges_;
  std::vector<std::uint8_t> is_taken_;
  Csr<std::int32_t> at_;
};

}  // namespace seamwire::detail
