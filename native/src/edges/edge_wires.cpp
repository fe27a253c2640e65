// SPDX-License-Identifier: GPL-3.0-or-later
//
// Chains of edges that are short in a metric and turn little. The search is Dijkstra's over
// directed edges, so that the cost of a step may depend on the step before (Caldwell, "On finding minimum routes in a
// network with turn penalties", 1961). Loops are found by the A* search of Hart, Nilsson and Raphael (1968).
#include "seamwire/edges/edge_wires.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <functional>
#include <new>
#include <string>
#include <type_traits>
#include <utility>

#include "detail/text.hpp"
#include "edges/edge_adjacency.hpp"
#include "edges/stroke_chain.hpp"
#include "metric/metric_check.hpp"

namespace seamwire {

namespace {

// Steps between two looks at the task: well under a millisecond.
constexpr std::size_t kPatience = 1024;
// Steps between two times that a search tells others how far it is.
constexpr std::size_t kPublish = 128;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

std::size_t at(std::int32_t i) { return static_cast<std::size_t>(i); }

}  // namespace

/// EdgeFans and a length for each directed edge.
class EdgeGraph {
 public:
  EdgeGraph(const Surface& surface, const Metric& metric, std::shared_ptr<const EdgeFans> fans, const Task& task);

  std::int32_t vertex_count() const { return fans_->vertex_count(); }
  std::size_t directed_count() const { return fans_->directed_count(); }
  std::int32_t begin(std::int32_t v) const { return fans_->begin(v); }
  std::int32_t end(std::int32_t v) const { return fans_->end(v); }
  std::int32_t head(std::int32_t e) const { return fans_->head(e); }
  std::int32_t twin(std::int32_t e) const { return fans_->twin(e); }
  std::int32_t tail(std::int32_t e) const { return fans_->tail(e); }
  std::int32_t find(std::int32_t a, std::int32_t b) const { return fans_->find(a, b); }
  double turn(std::int32_t back, std::int32_t out) const {
    return !drawn_.empty() && drawn_[at(back)] && drawn_[at(out)] ? 0.0 : fans_->turn(back, out);
  }
  double length(std::int32_t e) const { return lengths_[at(e)]; }
  double mean_length() const { return mean_length_; }

  void follow(const Surface& surface, const Metric& metric, const Scribble& scribble);

 private:
  std::shared_ptr<const EdgeFans> fans_;
  std::vector<double> lengths_;
  std::vector<bool> drawn_;  // whether a stroke runs along a directed edge; empty: there is none
  double mean_length_ = 0.0;
};

EdgeGraph::EdgeGraph(const Surface& surface, const Metric& metric, std::shared_ptr<const EdgeFans> fans,
                     const Task& task) {
  if (metric.size() != surface.vertex_count()) {
    throw InvalidInput("the metric has " + std::to_string(metric.size()) + " tensors, the surface " +
                       std::to_string(surface.vertex_count()) + " vertices");
  }
  check_finite(metric);
  const std::size_t edges = surface.edges().size();
  fans_ = fans ? std::move(fans) : make_edge_fans(surface, task);
  if (at(vertex_count()) != surface.vertex_count() || directed_count() != 2 * edges) {
    throw InvalidInput("the fans are of another surface: they have " + std::to_string(vertex_count()) +
                       " vertices and " + std::to_string(directed_count() / 2) + " edges");
  }
  lengths_.resize(directed_count());
  std::vector<std::int32_t> next(at(vertex_count()));
  for (std::int32_t v = 0; v < vertex_count(); ++v) next[at(v)] = begin(v);
  std::size_t count = 0;
  for (const auto& [a, b] : surface.edges()) {  // in the order in which the rows were filled
    const double length = edge_length(surface, metric, a, b);
    lengths_[at(next[at(a)]++)] = lengths_[at(next[at(b)]++)] = length;
    mean_length_ += length / static_cast<double>(edges);
    if (++count % kPatience == 0) task.check(static_cast<double>(count) / static_cast<double>(edges));
  }
}

void EdgeGraph::follow(const Surface& surface, const Metric& metric, const Scribble& scribble) {
  if (drawn_.empty()) drawn_.assign(directed_count(), false);
  for (const std::vector<std::int32_t>& chain : stroke_chains(surface, *fans_, scribble)) {
    for (std::size_t i = 0; i + 1 < chain.size(); ++i) {
      const std::int32_t a = chain[i], b = chain[i + 1], e = find(a, b);
      const double straight = surface.scale() * (surface.points()[at(b)] - surface.points()[at(a)]).norm();
      const double length = scribble.attracts ? straight / std::sqrt(scribble.eta) : edge_length(surface, metric, a, b);
      lengths_[at(e)] = lengths_[at(twin(e))] = length;
      drawn_[at(e)] = drawn_[at(twin(e))] = scribble.attracts;
    }
  }
}

std::shared_ptr<const EdgeGraph> make_edge_graph(const Surface& surface, const Metric& metric,
                                                 std::shared_ptr<const EdgeFans> fans, const Task& task,
                                                 std::span<const Scribble> scribbles, std::optional<Follow> follow) {
  auto graph = std::make_shared<EdgeGraph>(surface, metric, std::move(fans), task);
  for (const Scribble& scribble : scribbles) {
    task.check(1.0);
    if (!follow || scribble.acts_on(*follow)) graph->follow(surface, metric, scribble);
  }
  return graph;
}

namespace {

/// A queue for searches whose keys only grow: buckets of equal width, after Dial, "Algorithm 360: Shortest-path forest
/// with topological ordering" (1969). A state that no step reaches for less than a bucket's width cannot get better
/// once its bucket is the lowest, so it may come out in any order (Goldberg, "A simple shortest path algorithm with
/// linear average time", 2001, calls that width its caliber). The few others of the lowest bucket are kept as a heap,
/// and come out last. Keys beyond the last bucket wait in a list. The order depends on the calls alone.
class Queue {
 public:
  struct Entry {
    double key;
    std::int32_t state;
    bool in_order;
    bool operator>(const Entry& o) const { return key > o.key || (key == o.key && state > o.state); }
  };

  /// `step`: the most that a step often adds to a key. Only the speed depends on it.
  explicit Queue(double step)
      : width_(step / kBucketsPerStep),
        per_width_(std::isfinite(1.0 / width_) ? 1.0 / width_ : 0.0),
        buckets_(kBuckets) {}

  bool empty() const { return size_ == 0; }

  /// No key that is still in the queue is less.
  double floor() const { return (base_ + static_cast<double>(lowest_) * width_) * (1.0 - kRounding); }

  /// `least`: no step to the state costs less.
  void push(double key, std::int32_t state, double least) {
    ++size_;
    place({key, state, !(least > kRoom * width_)});
  }

  /// Not on an empty queue.
  Entry pop() {
    while (buckets_[lowest_].empty() && heap_.empty()) advance();
    std::vector<Entry>& from = buckets_[lowest_].empty() ? heap_ : buckets_[lowest_];
    if (&from == &heap_) std::pop_heap(heap_.begin(), heap_.end(), std::greater<>());
    const Entry entry = from.back();
    from.pop_back();
    --size_;
    return entry;
  }

 private:
  static constexpr std::size_t kBuckets = 1024;
  static constexpr double kBucketsPerStep = 128.0;
  static constexpr double kRoom = 1.001, kRounding = 1e-9;  // much more than keys are rounded by

  void place(const Entry& entry) {
    const double number = (entry.key - base_) * per_width_;
    if (!(number < static_cast<double>(kBuckets))) {
      beyond_.push_back(entry);
    } else if (number < static_cast<double>(lowest_ + 1)) {
      heap_.push_back(entry);
      std::push_heap(heap_.begin(), heap_.end(), std::greater<>());
    } else {
      buckets_[static_cast<std::size_t>(number)].push_back(entry);
    }
  }

  void advance() {
    if (++lowest_ == kBuckets) {
      lowest_ = 0;
      base_ = std::ranges::min(beyond_, {}, &Entry::key).key;
      std::vector<Entry> waiting;
      waiting.swap(beyond_);
      for (const Entry& entry : waiting) place(entry);
    }
    std::vector<Entry>& bucket = buckets_[lowest_];
    const auto rest = std::partition(bucket.begin(), bucket.end(), [](const Entry& e) { return !e.in_order; });
    heap_.insert(heap_.end(), rest, bucket.end());
    bucket.erase(rest, bucket.end());
    std::make_heap(heap_.begin(), heap_.end(), std::greater<>());
  }

  double width_, per_width_, base_ = 0.0;
  std::vector<std::vector<Entry>> buckets_;
  std::size_t lowest_ = 0, size_ = 0;
  std::vector<Entry> heap_;    // of the lowest bucket, what must come out in order
  std::vector<Entry> beyond_;  // keys past the last bucket
};

/// A search that goes in all directions alike.
struct Unguided {
  double operator()(std::int32_t) const { return 0.0; }
};

/// A directed edge in a search. All bits zero: no chain has reached it.
struct State {
  static constexpr std::int32_t kUnreached = 0, kFirst = 1, kBlocked = -1;

  double cost;          // of the cheapest chain up to and with it
  std::int32_t before;  // 2 + the directed edge before it in that chain; kFirst: none; or one of the others
  std::int32_t head;    // as in the graph; here so that following a chain back touches one place a step

  std::int32_t previous() const { return before - 2; }  // negative: it is the chain's first
  double best() const { return before == kUnreached ? kInfinity : cost; }
};

/// An array of zeros that the system hands out page by page as they are touched, so that a search takes no more memory,
/// or time for it, than it goes far.
template <class T>
class ZeroedArray {
 public:
  static_assert(std::is_trivial_v<T>);
  explicit ZeroedArray(std::size_t size)
      : values_(static_cast<T*>(std::calloc(std::max<std::size_t>(size, 1), sizeof(T)))) {
    if (!values_) throw std::bad_alloc();
  }
  T& operator[](std::size_t i) { return values_.get()[i]; }
  const T& operator[](std::size_t i) const { return values_.get()[i]; }

 private:
  struct Free {
    void operator()(T* values) const { std::free(values); }
  };
  std::unique_ptr<T, Free> values_;
};

/// Dijkstra's search over directed edges for chains that repeat no vertex.
///
/// The cheapest walk may cross itself: where edges are much shorter than the mean, going round a small circle is
/// cheaper than a sharp turn. A step to a vertex that the chain has already visited is therefore refused, and the next
/// best way into that directed edge is taken. The first chain to arrive at a vertex is never refused, and it goes on
/// over all the vertex's other edges, so a chain to every edge in reach is found: the cheapest walk's where that has no
/// repeated vertex, else one whose beginnings are the search's own chains (the cheapest of all simple chains is
/// NP-hard).
///
/// One thread runs it; what is settled does not change any more, and others may read that meanwhile.
class Search {
 public:
  Search(const EdgeGraph& graph, double turning)
      : graph_(graph),
        turn_cost_(turning * graph.mean_length()),
        states_(graph.directed_count()),
        settled_(graph.directed_count()),
        arrival_(at(graph.vertex_count()), kInfinity),
        queue_((1.0 + 2.0 * turning) * graph.mean_length()) {}

  /// No chain may enter this vertex.
  void block(std::int32_t v) {
    for (std::int32_t e = graph_.begin(v); e < graph_.end(v); ++e) {
      states_[at(graph_.twin(e))] = {kNothing, State::kBlocked, v};
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
    states_[at(e)] = {graph_.length(e), State::kFirst, graph_.head(e)};
    roots_.push_back(e);
  }

  /// Settles directed edges by ascending cost + remaining(head) until `done(edge)`; returns that edge, or -1.
  /// `remaining` must be a lower bound that no step lowers by more than its cost; infinity keeps chains out.
  template <class Remaining, class Done>
  std::int32_t run(const Remaining& remaining, const Done& done, const Task& task);

  /// From any thread: what an unguided run() has settled costs what state() says, and everything that costs less than
  /// settled_below() is settled.
  bool is_settled(std::int32_t e) const { return settled_[at(e)].load(std::memory_order_acquire) != 0; }
  double settled_below() const { return floor_.load(std::memory_order_acquire); }
  const State& state(std::int32_t e) const { return states_[at(e)]; }

 private:
  static constexpr double kNothing = -1.0;  // below every cost, so nothing improves on it

  double cost_of_step(std::int32_t from, std::int32_t to) const {
    double turns = graph_.turn(graph_.twin(from), to);
    if (onto_ >= 0 && graph_.head(to) == end_) turns += graph_.turn(graph_.twin(to), onto_);
    return graph_.length(to) + turn_cost_ * turns;
  }

  bool has_settled(std::int32_t e) const { return settled_[at(e)].load(std::memory_order_relaxed) != 0; }

  /// Whether the chain that ends with `e` visits `v` (its very first vertex is not looked at). Costs rise along a
  /// chain, so no part of it that is cheaper than the first arrival at v matters.
  bool visits(std::int32_t e, std::int32_t v) const {
    const double first = arrival_[at(v)];
    if (first == kInfinity) return false;
    while (e >= 0) {
      const State& state = states_[at(e)];
      if (state.cost < first) return false;
      if (state.head == v) return true;
      e = state.previous();
    }
    return false;
  }

  const EdgeGraph& graph_;
  double turn_cost_;
  std::int32_t end_ = -1, onto_ = -1;
  ZeroedArray<State> states_;
  std::vector<std::atomic<std::uint8_t>> settled_;
  std::atomic<double> floor_ = -kInfinity;
  std::vector<double> arrival_;  // cost of the first chain that arrived at each vertex
  std::vector<std::int32_t> roots_;
  Queue queue_;
};

template <class Remaining, class Done>
std::int32_t Search::run(const Remaining& remaining, const Done& done, const Task& task) {
  const auto least = [&](std::int32_t e) {
    return std::is_same_v<Remaining, Unguided> ? graph_.length(e) : 0.0;  // a guide may take back all of a step
  };
  const auto relax = [&](std::int32_t from, std::int32_t to) {
    const double cost = states_[at(from)].cost + cost_of_step(from, to);
    State& state = states_[at(to)];
    if (!(cost < state.best())) return;
    const std::int32_t head = graph_.head(to);
    const double key = cost + remaining(head);
    if (key == kInfinity) return;
    state = {cost, from + 2, head};
    queue_.push(key, to, least(to));
  };
  for (const std::int32_t e : roots_) queue_.push(states_[at(e)].cost + remaining(graph_.head(e)), e, least(e));
  for (std::size_t count = 0; !queue_.empty();) {
    const auto [key, e, in_order] = queue_.pop();
    State& state = states_[at(e)];
    const std::int32_t v = state.head;
    if (has_settled(e) || key != state.cost + remaining(v)) continue;  // a better one came in between
    if (state.previous() >= 0 && visits(state.previous(), v)) {
      state.cost = kInfinity;
      const std::int32_t u = graph_.tail(e);
      for (std::int32_t back = graph_.begin(u); back < graph_.end(u); ++back) {
        const std::int32_t other = graph_.twin(back);
        if (has_settled(other) && back != e && !visits(other, v)) relax(other, e);
      }
      continue;
    }
    settled_[at(e)].store(1, std::memory_order_release);
    arrival_[at(v)] = std::min(arrival_[at(v)], state.cost);
    if (done(e)) return e;
    if (++count % kPublish == 0) floor_.store(queue_.floor(), std::memory_order_release);
    if (count % kPatience == 0) {
      task.check(static_cast<double>(count) / static_cast<double>(graph_.directed_count()));
    }
    if (v == end_) continue;
    const std::int32_t back = graph_.twin(e);
    for (std::int32_t to = graph_.begin(v); to < back; ++to) relax(e, to);
    for (std::int32_t to = back + 1; to < graph_.end(v); ++to) relax(e, to);
  }
  floor_.store(kInfinity, std::memory_order_release);
  return -1;
}

/// The chain that ends with `e`, which is settled.
EdgeChain chain_to(const EdgeGraph& graph, const Search& search, std::int32_t e) {
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

void check_vertex(const EdgeGraph& graph, std::int32_t v, const std::string& what) {
  if (v >= 0 && v < graph.vertex_count()) return;
  throw InvalidInput(what + ": vertex " + std::to_string(v) + " does not exist, the surface has " +
                     std::to_string(graph.vertex_count()) + " vertices");
}

void check_edge(const EdgeGraph& graph, std::int32_t a, std::int32_t b, const std::string& what) {
  check_vertex(graph, a, what);
  check_vertex(graph, b, what);
  if (graph.find(a, b) >= 0) return;
  throw InvalidInput(what + ": there is no edge between the vertices " + std::to_string(a) + " and " +
                     std::to_string(b));
}

void check_pick(const EdgeGraph& graph, const Pick& pick, const std::string& what) {
  if (pick.b == -1) {
    check_vertex(graph, pick.a, what);
  } else {
    check_edge(graph, pick.a, pick.b, what);
  }
}

void check_turning(double turning) {
  if (!(turning >= 0.0) || turning == kInfinity) {
    throw InvalidInput("turning must be a number that is not negative, not " + text(turning));
  }
}

}  // namespace

struct EdgeWires::Run {
  Run(std::shared_ptr<const EdgeGraph> on, const Pick& from, double turning)
      : graph(std::move(on)), seed(from), search(*graph, turning) {}

  /// Of the directed edges that lead to a target, the settled one that costs least; -1: there is none.
  std::int32_t best(const Pick& target) const {
    std::int32_t found = -1;
    const auto consider = [&](std::int32_t e) {
      if (!search.is_settled(e)) return;
      if (found < 0 || search.state(e).cost < search.state(found).cost) found = e;
    };
    if (target.is_edge()) {
      const std::int32_t e = graph->find(std::min(target.a, target.b), std::max(target.a, target.b));
      consider(e);
      consider(graph->twin(e));
    } else {
      for (std::int32_t e = graph->begin(target.a); e < graph->end(target.a); ++e) consider(graph->twin(e));
    }
    return found;
  }

  std::shared_ptr<const EdgeGraph> graph;
  Pick seed;
  Search search;
};

EdgeWires::EdgeWires(std::shared_ptr<const EdgeGraph> graph, const Pick& seed, double turning, bool forward) {
  check_pick(*graph, seed, "seed");
  check_turning(turning);
  run_ = std::make_shared<Run>(std::move(graph), seed, turning);
  const EdgeGraph& on = *run_->graph;
  Search& search = run_->search;
  if (!seed.is_edge()) {
    search.block(seed.a);
    for (std::int32_t e = on.begin(seed.a); e < on.end(seed.a); ++e) search.start(e);
  } else {
    const std::int32_t e = on.find(seed.a, seed.b);
    search.block(seed.b);
    if (forward) {
      search.end_at(seed.a, -1);
    } else {
      search.block(seed.a);
      search.start(on.twin(e));
    }
    search.start(e);
  }
}

void EdgeWires::run(const Task& task) {
  run_->search.run(
      Unguided(), [](std::int32_t) { return false; }, task);
}

bool EdgeWires::is_final(const Pick& target) const {
  check_pick(*run_->graph, target, "target");
  const double below = run_->search.settled_below();  // first, so that what it speaks of is seen
  if (below == kInfinity || (!target.is_edge() && target == run_->seed)) return true;
  const std::int32_t best = run_->best(target);
  return best >= 0 && run_->search.state(best).cost < below;
}

EdgeChain EdgeWires::trace(const Pick& target) const {
  check_pick(*run_->graph, target, "target");
  if (!target.is_edge() && target == run_->seed) return {{target.a}, 0.0};
  const std::int32_t best = run_->best(target);
  if (best < 0) return {};
  return chain_to(*run_->graph, run_->search, best);
}

EdgeWires edge_wires(std::shared_ptr<const EdgeGraph> graph, const Pick& seed, double turning, bool forward,
                     const Task& task) {
  EdgeWires wires(std::move(graph), seed, turning, forward);
  wires.run(task);
  return wires;
}

namespace {

/// What the closed chain a -> b -> c (-> d) -> a costs at the least, over all c and d: where to stop searching for a
/// loop.
double cheapest_small_loop(const EdgeGraph& graph, std::int32_t ab, double turn_cost) {
  const std::int32_t a = graph.tail(ab), b = graph.head(ab);
  const auto turn = [&](std::int32_t from, std::int32_t to) { return turn_cost * graph.turn(graph.twin(from), to); };
  double best = kInfinity;
  for (std::int32_t bc = graph.begin(b); bc < graph.end(b); ++bc) {
    const std::int32_t c = graph.head(bc);
    if (c == a) continue;
    const double up_to_c = graph.length(ab) + turn(ab, bc) + graph.length(bc);
    if (const std::int32_t ca = graph.find(c, a); ca >= 0) {
      best = std::min(best, up_to_c + turn(bc, ca) + graph.length(ca) + turn(ca, ab));
    }
    for (std::int32_t cd = graph.begin(c); cd < graph.end(c); ++cd) {
      const std::int32_t d = graph.head(cd);
      const std::int32_t da = d == a || d == b ? -1 : graph.find(d, a);
      if (da < 0) continue;
      best = std::min(best, up_to_c + turn(bc, cd) + graph.length(cd) + turn(cd, da) + graph.length(da) + turn(da, ab));
    }
  }
  return best;
}

/// Metric distance along edges to `target`, without turns; infinity beyond `radius`.
std::vector<double> distances(const EdgeGraph& graph, std::int32_t target, double radius, const Task& task) {
  std::vector<double> distance(at(graph.vertex_count()), kInfinity);
  Queue queue(graph.mean_length());
  distance[at(target)] = 0.0;
  queue.push(0.0, target, 0.0);
  std::size_t count = 0;
  while (!queue.empty()) {
    const auto [d, v, in_order] = queue.pop();
    if (d != distance[at(v)]) continue;
    if (++count % kPatience == 0) task.check(0.0);
    for (std::int32_t e = graph.begin(v); e < graph.end(v); ++e) {
      const double there = d + graph.length(e);
      if (!(there <= radius && there < distance[at(graph.head(e))])) continue;
      distance[at(graph.head(e))] = there;
      queue.push(there, graph.head(e), 0.0);
    }
  }
  return distance;
}

}  // namespace

EdgeChain edge_loop(const EdgeGraph& graph, const Edge& edge, double turning, const Task& task) {
  check_edge(graph, edge[0], edge[1], "loop");
  check_turning(turning);
  const std::int32_t a = std::min(edge[0], edge[1]), b = std::max(edge[0], edge[1]);
  const std::int32_t ab = graph.find(a, b);

  // No vertex of a loop is further from a than half its length. A little room for rounding.
  const double bound = (1.0 + 1e-9) * cheapest_small_loop(graph, ab, turning * graph.mean_length());
  const std::vector<double> way_back = distances(graph, a, 0.5 * bound, task);
  Search search(graph, turning);
  search.block(b);
  search.end_at(a, ab);
  search.start(ab);
  const std::int32_t last = search.run([&](std::int32_t v) { return way_back[at(v)]; },
                                       [&](std::int32_t e) { return graph.head(e) == a; }, task);
  if (last < 0) return {};
  EdgeChain loop = chain_to(graph, search, last);
  loop.vertices.pop_back();  // a, once more
  return loop;
}

}  // namespace seamwire
