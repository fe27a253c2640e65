// SPDX-License-Identifier: GPL-3.0-or-later
#include "parts/minimum_cut.hpp"

#include <algorithm>

#include "detail/infinity.hpp"
#include "detail/poll.hpp"

namespace seamwire::detail {
namespace {

constexpr double kNothing = 1e-12;  // less than this counts as no flow

}  // namespace

void MinimumCut::add(std::int32_t a, std::int32_t b, double price) {
  arcs_.push_back({b, first_[a], price});
  first_[a] = static_cast<std::int32_t>(arcs_.size()) - 1;
  arcs_.push_back({a, first_[b], price});
  first_[b] = static_cast<std::int32_t>(arcs_.size()) - 1;
}

std::vector<std::uint8_t> MinimumCut::source_side(std::int32_t source, std::int32_t sink, const Task& task) {
  Poll poll(task, Poll::kFewSteps);
  while (find_levels(source, sink, task)) {
    next_ = first_;
    while (push(source, sink) > kNothing) poll.next();
  }
  std::vector<std::uint8_t> side(first_.size());
  for (std::size_t v = 0; v < side.size(); ++v) side[v] = level_[v] >= 0 ? 1 : 0;
  return side;
}

/// How many arcs with room each node is from the source; whether the sink can be reached.
bool MinimumCut::find_levels(std::int32_t source, std::int32_t sink, const Task& task) {
  const Poll poll(task);
  level_.assign(first_.size(), -1);
  level_[source] = 0;
  std::vector<std::int32_t> open{source};
  for (std::size_t i = 0; i < open.size(); ++i) {
    poll.at(i);
    for (std::int32_t a = first_[open[i]]; a >= 0; a = arcs_[a].next) {
      const Arc& arc = arcs_[a];
      if (level_[arc.to] >= 0 || arc.left <= kNothing) continue;
      level_[arc.to] = level_[open[i]] + 1;
      open.push_back(arc.to);
    }
  }
  return level_[sink] >= 0;
}

/// Lets as much flow along one path of rising levels as there is room for.
double MinimumCut::push(std::int32_t source, std::int32_t sink) {
  std::vector<std::int32_t> path;  // arcs
  std::int32_t at = source;
  while (at != sink) {
    std::int32_t& a = next_[at];
    while (a >= 0 && (arcs_[a].left <= kNothing || level_[arcs_[a].to] != level_[at] + 1)) a = arcs_[a].next;
    if (a >= 0) {
      path.push_back(a);
      at = arcs_[a].to;
      continue;
    }
    if (path.empty()) return 0.0;
    level_[at] = -1;  // leads nowhere
    at = arcs_[path.back() ^ 1].to;
    path.pop_back();
  }
  double amount = kInfinity;
  for (const std::int32_t a : path) amount = std::min(amount, arcs_[a].left);
  for (const std::int32_t a : path) {
    arcs_[a].left -= amount;
    arcs_[a ^ 1].left += amount;
  }
  return amount;
}

}  // namespace seamwire::detail
