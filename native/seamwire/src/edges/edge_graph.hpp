// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "edges/edge_adjacency.hpp"
#include "seamwire/edges/edge_graph.hpp"
#include "seamwire/metric/metric.hpp"
#include "seamwire/metric/scribble.hpp"

namespace seamwire {

/// EdgeAdjacency and a length for each directed edge.
class EdgeGraph {
 public:
  EdgeGraph(const Surface& surface, const Metric& metric, std::shared_ptr<const EdgeAdjacency> adjacency,
            const Task& task);

  std::int32_t vertex_count() const { return adjacency_->vertex_count(); }
  std::size_t directed_count() const { return adjacency_->directed_count(); }
  std::int32_t begin(std::int32_t v) const { return adjacency_->begin(v); }
  std::int32_t end(std::int32_t v) const { return adjacency_->end(v); }
  std::int32_t head(std::int32_t e) const { return adjacency_->head(e); }
  std::int32_t twin(std::int32_t e) const { return adjacency_->twin(e); }
  std::int32_t tail(std::int32_t e) const { return adjacency_->tail(e); }
  std::int32_t find(std::int32_t a, std::int32_t b) const { return adjacency_->find(a, b); }
  std::int32_t checked(const Edge& edge, const std::string& what) const { return adjacency_->checked(edge, what); }
  double turn(std::int32_t back, std::int32_t out) const {
    return is_drawn(back) && is_drawn(out) ? 0.0 : adjacency_->turn(back, out);
  }
  const EdgeAdjacency::Direction& direction(std::int32_t e) const { return adjacency_->direction(e); }
  /// Whether a scribble runs along it: turns between two such edges cost nothing.
  bool is_drawn(std::int32_t e) const { return !drawn_.empty() && drawn_[e]; }
  double length(std::int32_t e) const { return lengths_[e]; }
  double mean_length() const { return mean_length_; }

  /// Makes the edges nearest to a scribble cheap to follow. If it repels, they cost what the metric says.
  void follow(const Surface& surface, const Metric& metric, const Scribble& scribble);

 private:
  std::shared_ptr<const EdgeAdjacency> adjacency_;
  std::vector<double> lengths_;
  std::vector<bool> drawn_;  // per directed edge: whether a scribble runs along it; empty: there is no scribble
  double mean_length_ = 0.0;
};

/// Throws InvalidInput if it is not a finite number of at least 0.
void check_turning(double turning);

}  // namespace seamwire
