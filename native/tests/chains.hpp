// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <functional>
#include <limits>
#include <map>
#include <memory>
#include <set>
#include <utility>
#include <vector>

#include "seamwire/edges/edge_loop.hpp"
#include "seamwire/edges/edge_wires.hpp"
#include "seamwire/edges/shortest_cycle.hpp"

/// What tests of wires along edges share: a metric of plain lengths, so that answers are known without curvatures, and
/// chains found by other means than the library's.
namespace seamwire::chains {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
/// Sums of a few dozen lengths and turns, all about 1.
constexpr double kRounding = 1e-12;

using Chain = std::vector<std::int32_t>;

inline Metric plain_metric(const Surface& surface) {
  Metric metric;
  metric.normals.assign(surface.vertex_count(), Vector::Zero());
  metric.tensors.assign(surface.vertex_count(), Eigen::Matrix3d::Identity());
  return metric;
}

inline std::shared_ptr<const EdgeGraph> plain_graph(const Surface& surface) {
  return make_edge_graph(surface, plain_metric(surface));
}

inline double plain_length(const Surface& surface, std::int32_t a, std::int32_t b) {
  return (surface.points()[static_cast<std::size_t>(a)] - surface.points()[static_cast<std::size_t>(b)]).norm();
}

inline double mean_plain_length(const Surface& surface) {
  double sum = 0;
  for (const auto& [a, b] : surface.edges()) sum += plain_length(surface, a, b);
  return sum / static_cast<double>(surface.edges().size());
}

/// 1 - cos kappa at v of the chain a, v, b, read off a wire's length. The turning is so small that no detour pays.
inline double turn(const Surface& surface, std::int32_t a, std::int32_t v, std::int32_t b) {
  constexpr double kTurning = 1e-3;
  const EdgeChain chain = edge_wires(plain_graph(surface), {a, v}, kTurning, true).trace({v, b}).value();
  EXPECT_EQ(chain.vertices, Chain({a, v, b}));
  return (chain.length - plain_length(surface, a, v) - plain_length(surface, v, b)) /
         (kTurning * mean_plain_length(surface));
}

/// What rounding in a length of about 1 makes of turn().
constexpr double kTurnRounding = 1e-9;

inline Chain sorted(Chain chain) {
  std::ranges::sort(chain);
  return chain;
}

inline bool has_repeated_vertex(Chain chain) {
  std::ranges::sort(chain);
  return std::ranges::adjacent_find(chain) != chain.end();
}

inline bool same_loop(const Chain& a, const Chain& b) {
  const auto sides = [](const Chain& loop) {
    std::set<Edge> result;
    for (std::size_t i = 0; i < loop.size(); ++i) {
      const auto [p, q] = std::minmax(loop[i], loop[(i + 1) % loop.size()]);
      result.insert({p, q});
    }
    return result;
  };
  return a.size() == b.size() && sides(a) == sides(b);
}

/// Turns and lengths as a table, from wires of two edges; and from it, chains by other means than the library's.
class Table {
 public:
  explicit Table(const Surface& surface)
      : surface_(surface), mean_(mean_plain_length(surface)), graph_(plain_graph(surface)) {
    for (const auto& [a, b] : surface.edges()) {
      near_[a].push_back(b);
      near_[b].push_back(a);
    }
    for (const auto& [v, neighbors] : near_) {
      for (const std::int32_t a : neighbors) {
        for (const std::int32_t b : neighbors) {
          if (a < b) turns_[{a, v, b}] = turns_[{b, v, a}] = turn(surface, a, v, b);
        }
      }
    }
  }

  const std::shared_ptr<const EdgeGraph>& graph() const { return graph_; }

  double step(std::int32_t a, std::int32_t v, std::int32_t b, double turning) const {
    return turning * mean_ * turns_.at({a, v, b}) + plain_length(surface_, v, b);
  }

  double cost(const Chain& chain, double turning) const {
    double sum = chain.size() < 2 ? 0.0 : plain_length(surface_, chain[0], chain[1]);
    for (std::size_t i = 2; i < chain.size(); ++i) sum += step(chain[i - 2], chain[i - 1], chain[i], turning);
    return sum;
  }

  double loop_cost(const Chain& loop, double turning) const {
    const std::size_t n = loop.size();
    double sum = 0;
    for (std::size_t i = 0; i < n; ++i) sum += step(loop[i], loop[(i + 1) % n], loop[(i + 2) % n], turning);
    return sum;
  }

  /// The cheapest walk from the directed edge (a, b) to every directed edge; vertices may repeat, and `repeats` tells
  /// where they do.
  struct Walk {
    double cost = kInfinity;
    Edge previous{-1, -1};
  };
  std::map<Edge, Walk> walks(const Edge& from, double turning) const {
    std::map<Edge, Walk> walks;
    std::set<std::pair<double, Edge>> queue;
    walks[from].cost = plain_length(surface_, from[0], from[1]);
    queue.insert({walks[from].cost, from});
    while (!queue.empty()) {
      const auto [cost, e] = *queue.begin();
      queue.erase(queue.begin());
      for (const std::int32_t next : near_.at(e[1])) {
        if (next == e[0]) continue;
        const double there = cost + step(e[0], e[1], next, turning);
        Walk& walk = walks[{e[1], next}];
        if (!(there < walk.cost)) continue;
        queue.erase({walk.cost, {e[1], next}});
        walk = {there, e};
        queue.insert({there, {e[1], next}});
      }
    }
    return walks;
  }
  static Chain chain_of(const std::map<Edge, Walk>& walks, Edge e) {
    Chain chain{e[1]};
    for (; e[0] >= 0; e = walks.at(e).previous) chain.insert(chain.begin(), e[0]);
    return chain;
  }

  /// The cheapest simple chain from the directed edge (a, b) to every directed edge, by trying all that cost no more
  /// than `limit`; with `closed` also those that end where they began.
  std::map<Edge, double> cheapest_simple(const Edge& from, double turning, double limit) const {
    std::map<Edge, double> best;
    std::set<std::int32_t> used{from[0], from[1]};
    const std::function<void(const Edge&, double)> extend = [&](const Edge& e, double cost) {
      const auto [it, is_new] = best.try_emplace(e, cost);
      if (!is_new) it->second = std::min(it->second, cost);
      for (const std::int32_t next : near_.at(e[1])) {
        const double there = next == e[0] ? kInfinity : cost + step(e[0], e[1], next, turning);
        if (there > limit || !used.insert(next).second) continue;
        extend({e[1], next}, there);
        used.erase(next);
      }
    };
    extend(from, plain_length(surface_, from[0], from[1]));
    return best;
  }

  /// The cheapest loop through the edge, by trying all that cost no more than `limit`.
  double cheapest_loop(const Edge& edge, double turning, double limit) const {
    double best = kInfinity;
    std::set<std::int32_t> used{edge[0], edge[1]};
    const std::function<void(const Edge&, double)> extend = [&](const Edge& e, double cost) {
      for (const std::int32_t next : near_.at(e[1])) {
        const double there = next == e[0] ? kInfinity : cost + step(e[0], e[1], next, turning);
        if (there > std::min(limit, best)) continue;
        if (next == edge[0]) {
          best = std::min(best, there + step(e[1], next, edge[1], turning) - plain_length(surface_, edge[0], edge[1]));
        } else if (used.insert(next).second) {
          extend({e[1], next}, there);
          used.erase(next);
        }
      }
    };
    extend(edge, plain_length(surface_, edge[0], edge[1]));
    return best;
  }

 private:
  const Surface& surface_;
  double mean_;
  std::shared_ptr<const EdgeGraph> graph_;
  std::map<std::int32_t, Chain> near_;
  std::map<std::array<std::int32_t, 3>, double> turns_;
};

/// Errors of turn() times turning and the number of steps.
constexpr double kTableRounding = 1e-7;

}  // namespace seamwire::chains
