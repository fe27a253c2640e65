// SPDX-License-Identifier: GPL-3.0-or-later
//
// The search behind wires along edges and shortest cycles. It is Dijkstra's algorithm over directed edges, so that the
// cost of a step may depend on the step before (Caldwell, "On finding minimum routes in a network with turn penalties",
// 1961). With a lower bound of the remaining cost it is the A* search of Hart, Nilsson and Raphael (1968).
#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <type_traits>
#include <unordered_map>
#include <utility>
#include <vector>

#include "detail/index.hpp"
#include "detail/infinity.hpp"
#include "detail/zeroed_array.hpp"
#include "edges/edge_graph.hpp"
#include "graph/arrival_tree.hpp"
#include "graph/bucket_queue.hpp"
#include "seamwire/task.hpp"

namespace seamwire::detail {

/// Steps from edge to edge between two looks at the task: well under a millisecond.
inline constexpr std::size_t kStepsBetweenChecks = 1024;
/// And between two times that a search tells other threads how far it is.
inline constexpr std::size_t kStepsBetweenReports = 128;

/// A search that goes in all directions alike.
struct Unguided {
  double operator()(std::int32_t) const { return 0.0; }
};

/// A directed edge in a search. All bits zero: no chain has reached it.
struct EdgeState {
  static constexpr std::int32_t kUnreached = 0, kFirst = 1, kBlocked = -1, kWaiting = -2;

  double cost;          // of the cheapest chain up to and with it
  std::int32_t before;  // 2 + the directed edge before it in that chain; kFirst: none; or one of the others
  std::int32_t head;    // as in the graph: a copy here makes following a chain back touch less memory

  std::int32_t previous() const { return before - 2; }  // negative: it is the chain's first
  double best() const { return before == kUnreached ? kInfinity : cost; }
};

/// Dijkstra's search over directed edges for chains that repeat no vertex.
///
/// The cheapest walk may cross itself: where edges are much shorter than the mean, going round a small circle is
/// cheaper than a sharp turn. A step to a vertex that the chain has already visited is therefore refused, and the next
/// best way into that directed edge is taken. The first chain to arrive at a vertex is never refused, and it goes on
/// over all the vertex's other edges. So a chain to every edge in reach is found. If the cheapest walk repeats no
/// vertex, the chain is that walk. Otherwise its beginnings are the search's own chains, because finding the cheapest
/// of all simple chains is NP-hard.
///
/// A vertex with many edges would take the square of their number in steps. So there a chain that arrives is only kept
/// in a tree. Each edge that leaves waits in the queue with a lower bound of its cost. When it comes out, the tree
/// gives its cheapest chain, and the edge is settled or waits again.
///
/// One thread runs it; what is settled does not change any more, and others may read that meanwhile.
class EdgeSearch {
 public:
  /// At vertices with fewer edges than `many_edges` it looks at each pair of edges, which is quicker there.
  EdgeSearch(const EdgeGraph& graph, double turning, std::int32_t many_edges = 64)
      : graph_(graph),
        turn_cost_(turning * graph.mean_length()),
        many_edges_(many_edges),
        states_(graph.directed_count()),
        settled_(graph.directed_count()),
        arrival_(index(graph.vertex_count()), kInfinity),
        queue_((1.0 + 2.0 * turning) * graph.mean_length()) {}

  /// No chain may enter this vertex.
  void block(std::int32_t v) {
    for (std::int32_t e = graph_.begin(v); e < graph_.end(v); ++e) {
      states_[graph_.twin(e)] = {kNothing, EdgeState::kBlocked, v};
    }
  }
  /// Chains may enter this vertex, but not leave it; if `onto` is a directed edge from it, they pay for the turn onto
  /// it.
  void end_at(std::int32_t v, std::int32_t onto) {
    end_ = v;
    onto_ = onto;
  }
  /// Chains begin with this directed edge, or another one that is given so.
  void start(std::int32_t e) {
    states_[e] = {graph_.length(e), EdgeState::kFirst, graph_.head(e)};
    roots_.push_back(e);
  }

  /// Settles directed edges by ascending cost + remaining(head) until `done(edge)`; returns that edge, or -1.
  /// `remaining` must be a lower bound that no step lowers by more than its cost; infinity keeps chains out.
  template <class Remaining, class Done>
  std::int32_t run(const Remaining& remaining, const Done& done, const Task& task);

  /// From any thread: what an unguided run() has settled costs what state() says, and everything that costs less than
  /// settled_below() is settled.
  bool is_settled(std::int32_t e) const { return settled_[e].load(std::memory_order_acquire) != 0; }
  double settled_below() const { return floor_.load(std::memory_order_acquire); }
  const EdgeState& state(std::int32_t e) const { return states_[e]; }

 private:
  static constexpr double kNothing = -1.0;  // below every cost, so nothing improves on it

  double cost_of_step(std::int32_t from, std::int32_t to) const {
    double turns = graph_.turn(graph_.twin(from), to);
    if (onto_ >= 0 && graph_.head(to) == end_) turns += graph_.turn(graph_.twin(to), onto_);
    return graph_.length(to) + turn_cost_ * turns;
  }

  /// A vertex with many edges.
  struct Crossing {
    std::int32_t first;                 // of the directed edges that leave it
    ArrivalTree arrivals;               // of settled edges, named by their twins
    std::vector<std::int32_t> numbers;  // of arrivals in their order; -1: none
    std::vector<std::uint8_t> waits;    // how often each edge came out of the queue without being settled
    std::vector<std::int32_t> relaxed;  // edges that wait no longer: each chain that arrives goes on over them
    std::int32_t arrived = 0;
  };
  static constexpr std::uint8_t kMostWaits = 16;

  Crossing& crossing_at(std::int32_t v);
  template <class Look>
  std::pair<double, std::int32_t> cheapest(const Crossing& crossing, std::int32_t to, const Look& look) const;

  bool has_settled(std::int32_t e) const { return settled_[e].load(std::memory_order_relaxed) != 0; }

  /// Whether the chain that ends with `e` visits `v` (its very first vertex is not looked at). Costs rise along a
  /// chain, so no part of it that is cheaper than the first arrival at v matters.
  bool visits(std::int32_t e, std::int32_t v) const {
    const double first = arrival_[v];
    if (first == kInfinity) return false;
    while (e >= 0) {
      const EdgeState& state = states_[e];
      if (state.cost < first) return false;
      if (state.head == v) return true;
      e = state.previous();
    }
    return false;
  }

  const EdgeGraph& graph_;
  double turn_cost_;
  std::int32_t many_edges_;
  std::int32_t end_ = -1, onto_ = -1;
  ZeroedArray<EdgeState> states_;
  std::vector<std::atomic<std::uint8_t>> settled_;
  std::atomic<double> floor_ = -kInfinity;
  std::vector<double> arrival_;  // cost of the first chain that arrived at each vertex
  std::vector<std::int32_t> roots_;
  BucketQueue queue_;
  std::unordered_map<std::int32_t, Crossing> crossings_;  // by the vertex
};

inline EdgeSearch::Crossing& EdgeSearch::crossing_at(std::int32_t v) {
  const auto found = crossings_.find(v);
  if (found != crossings_.end()) return found->second;
  const std::int32_t first = graph_.begin(v);
  const auto count = static_cast<std::size_t>(graph_.end(v) - first);
  return crossings_
      .try_emplace(v, Crossing{.first = first,
                               .arrivals = {count, [&](std::int32_t i) { return graph_.direction(first + i); }},
                               .numbers = std::vector<std::int32_t>(count, -1),
                               .waits = std::vector<std::uint8_t>(count, 0),
                               .relaxed = {}})
      .first->second;
}

/// The least cost of a chain that goes on over an edge from a crossing, and the settled edge before it. Of equal ones
/// it is the first. Without such a chain it is infinity, and -1.
template <class Look>
std::pair<double, std::int32_t> EdgeSearch::cheapest(const Crossing& crossing, std::int32_t to,
                                                     const Look& look) const {
  double least = kInfinity;
  std::int32_t before = -1, number = -1;
  const double weight = graph_.is_drawn(to) ? 0.0 : turn_cost_;  // a scribble's own turns cost nothing
  crossing.arrivals.visit_best(graph_.direction(to), weight, graph_.length(to), [&](std::int32_t i) {
    look();
    const std::int32_t back = crossing.first + i, from = graph_.twin(back);
    if (crossing.numbers[i] < 0 || back == to) return least;
    const double cost = states_[from].cost + cost_of_step(from, to);
    const bool is_better = cost < least || (cost == least && crossing.numbers[i] < number);
    if (!is_better || visits(from, graph_.head(to))) return least;
    before = from;
    number = crossing.numbers[i];
    return least = cost;
  });
  return {least, before};
}

template <class Remaining, class Done>
std::int32_t EdgeSearch::run(const Remaining& remaining, const Done& done, const Task& task) {
  const auto least = [&](std::int32_t e) {
    return std::is_same_v<Remaining, Unguided> ? graph_.length(e) : 0.0;  // a guide may take back all of a step
  };
  std::size_t count = 0, looks = 0;
  const auto look = [&] {
    if (++looks % kStepsBetweenChecks == 0) {
      task.check(static_cast<double>(count) / static_cast<double>(graph_.directed_count()));
    }
  };
  const auto relax = [&](std::int32_t from, std::int32_t to) {
    look();
    const double cost = states_[from].cost + cost_of_step(from, to);
    EdgeState& state = states_[to];
    if (!(cost < state.best())) return;
    const std::int32_t head = graph_.head(to);
    const double key = cost + remaining(head);
    if (key == kInfinity) return;
    state = {cost, from + 2, head};
    queue_.push(key, to, least(to));
  };
  const auto arrive_at_crossing = [&](std::int32_t e, std::int32_t v) {
    Crossing& crossing = crossing_at(v);
    const std::int32_t back = graph_.twin(e), place = back - crossing.first;
    crossing.numbers[place] = crossing.arrived++;
    crossing.arrivals.arrive(place, states_[e].cost);
    if (crossing.arrived > 1) {
      for (const std::int32_t to : crossing.relaxed) {
        if (to != back) relax(e, to);
      }
      return;
    }
    for (std::int32_t to = graph_.begin(v); to < graph_.end(v); ++to) {
      if (states_[to].before != EdgeState::kUnreached) continue;
      const std::int32_t head = graph_.head(to);
      const double key = states_[e].cost + graph_.length(to) + remaining(head);
      if (key == kInfinity) continue;
      states_[to] = {kInfinity, EdgeState::kWaiting, head};
      queue_.push(key, to, least(to));
    }
  };
  // Gives an edge that waits its cost; or returns false, and it waits for longer. Chains that arrive later cost at
  // least as much as the queue's floor, the edge, and a turn from an edge over which no chain has arrived.
  const auto ends_waiting = [&](std::int32_t e, double key) {
    const std::int32_t u = graph_.tail(e), v = states_[e].head;
    Crossing& crossing = crossing_at(u);
    const auto [cost, before] = cheapest(crossing, e, look);
    const double known = cost + remaining(v);
    if (known <= key) {
      states_[e] = {cost, before + 2, v};
      return true;
    }
    if (++crossing.waits[e - crossing.first] < kMostWaits) {
      const double step = graph_.length(e) + remaining(v) - remaining(u);
      const double turn = graph_.is_drawn(e) ? 0.0 : crossing.arrivals.least_turn_missing(graph_.direction(e));
      const double turned = turn_cost_ > 0 ? turn_cost_ * turn : 0.0;
      const double next = std::min(known, queue_.floor() + step + turned);
      if (next < kInfinity) {
        queue_.push(next, e, least(e));
        return false;
      }
    }
    crossing.relaxed.push_back(e);
    if (before < 0) {
      states_[e].before = EdgeState::kUnreached;
    } else {
      states_[e] = {cost, before + 2, v};
      queue_.push(known, e, least(e));
    }
    return false;
  };
  for (const std::int32_t e : roots_) queue_.push(states_[e].cost + remaining(graph_.head(e)), e, least(e));
  while (!queue_.empty()) {
    const auto [key, e, in_order] = queue_.pop();
    EdgeState& state = states_[e];
    const std::int32_t v = state.head;
    if (state.before == EdgeState::kWaiting) {
      if (!ends_waiting(e, key)) continue;
    } else if (has_settled(e) || key != state.cost + remaining(v)) {
      continue;  // a better one came in between
    }
    if (state.previous() >= 0 && visits(state.previous(), v)) {
      state.cost = kInfinity;
      const std::int32_t u = graph_.tail(e);
      for (std::int32_t back = graph_.begin(u); back < graph_.end(u); ++back) {
        const std::int32_t other = graph_.twin(back);
        if (has_settled(other) && back != e && !visits(other, v)) relax(other, e);
      }
      continue;
    }
    settled_[e].store(1, std::memory_order_release);
    arrival_[v] = std::min(arrival_[v], state.cost);
    if (done(e)) return e;
    if (++count % kStepsBetweenReports == 0) floor_.store(queue_.floor(), std::memory_order_release);
    if (v == end_) continue;
    if (graph_.end(v) - graph_.begin(v) >= many_edges_) {
      arrive_at_crossing(e, v);
      continue;
    }
    const std::int32_t back = graph_.twin(e);
    for (std::int32_t to = graph_.begin(v); to < back; ++to) relax(e, to);
    for (std::int32_t to = back + 1; to < graph_.end(v); ++to) relax(e, to);
  }
  floor_.store(kInfinity, std::memory_order_release);
  return -1;
}

/// The chain that ends with `e`, which is settled.
inline EdgeChain chain_to(const EdgeGraph& graph, const EdgeSearch& search, std::int32_t e) {
  EdgeChain chain{{}, search.state(e).cost};
  std::int32_t first = e;
  for (; e >= 0; e = search.state(e).previous()) {
    chain.vertices.push_back(search.state(e).head);
    first = e;
  }
  chain.vertices.push_back(graph.tail(first));
  std::ranges::reverse(chain.vertices);
  return chain;
}

}  // namespace seamwire::detail
