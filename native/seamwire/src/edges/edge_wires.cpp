// SPDX-License-Identifier: GPL-3.0-or-later
#include "seamwire/edges/edge_wires.hpp"

#include <algorithm>
#include <string>
#include <utility>

#include "detail/index.hpp"
#include "edges/edge_search.hpp"

namespace seamwire {

using namespace detail;

namespace {

void check_pick(const EdgeGraph& graph, const Pick& pick, const std::string& what) {
  if (pick.b == -1) {
    check_index(pick.a, index(graph.vertex_count()), what + ": vertex");
  } else {
    graph.checked({pick.a, pick.b}, what);
  }
}

}  // namespace

struct EdgeWires::Run {
  Run(std::shared_ptr<const EdgeGraph> on, const Pick& from, double turning)
      : graph(std::move(on)), seed(from), search(*graph, turning) {}

  /// Of the directed edges that lead to a target, the settled one that costs least; -1 if no edge is settled.
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
  EdgeSearch search;
};

EdgeWires::EdgeWires(std::shared_ptr<const EdgeGraph> graph, const Pick& seed, double turning, bool forward) {
  if (!graph) throw InvalidInput("graph: there is none");
  check_pick(*graph, seed, "seed");
  check_turning(turning);
  run_ = std::make_shared<Run>(std::move(graph), seed, turning);
  const EdgeGraph& on = *run_->graph;
  EdgeSearch& search = run_->search;
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

std::optional<EdgeChain> EdgeWires::trace(const Pick& target) const {
  check_pick(*run_->graph, target, "target");
  if (!target.is_edge() && target == run_->seed) return EdgeChain{{target.a}, 0.0};
  const std::int32_t best = run_->best(target);
  if (best < 0) return std::nullopt;
  return chain_to(*run_->graph, run_->search, best);
}

EdgeWires edge_wires(std::shared_ptr<const EdgeGraph> graph, const Pick& seed, double turning, bool forward,
                     const Task& task) {
  EdgeWires wires(std::move(graph), seed, turning, forward);
  wires.run(task);
  return wires;
}

}  // namespace seamwire
