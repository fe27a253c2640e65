// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "detail/computed_once.hpp"
#include "detail/thread_safety.hpp"
#include "seamwire/edges/edge_graph.hpp"
#include "seamwire/metric/curvature.hpp"
#include "seamwire/metric/metric.hpp"
#include "seamwire/surface/surface.hpp"
#include "seamwire/task.hpp"

namespace seamwire::python {

struct CurvatureObject {
  CurvatureObject(std::shared_ptr<const Curvature> computed, std::shared_ptr<const std::vector<double>> strength)
      : shared(std::move(computed)), curvature(*shared), held(std::move(strength)), difference(*held) {}
  explicit CurvatureObject(Curvature computed)
      : CurvatureObject(std::make_shared<const Curvature>(computed),
                        std::make_shared<const std::vector<double>>(computed.difference())) {}

  std::shared_ptr<const Curvature> shared;
  const Curvature& curvature;
  std::shared_ptr<const std::vector<double>> held;
  const std::vector<double>& difference;
};

struct MetricObject {
  explicit MetricObject(Metric computed)
      : shared(std::make_shared<const Metric>(std::move(computed))), metric(*shared) {}

  /// Returns the graph of a surface's edges in this metric, and keeps that of the last surface. Call without the GIL.
  std::shared_ptr<const EdgeGraph> edge_graph(const std::shared_ptr<const Surface>& surface, const Task& task) const {
    std::shared_ptr<Graph> graph;
    {
      const detail::MutexLock lock(mutex_);
      if (!graph_ || graph_->surface.lock() != surface) graph_ = std::make_shared<Graph>(surface);
      graph = graph_;
    }
    return *graph->made.get(
        task, [&](const Task& own) { return make_edge_graph(*surface, metric, nullptr, {}, std::nullopt, own); });
  }

  std::shared_ptr<const Metric> shared;
  const Metric& metric;

 private:
  struct Graph {
    explicit Graph(const std::shared_ptr<const Surface>& of) : surface(of) {}

    std::weak_ptr<const Surface> surface;
    detail::ComputedOnce<std::shared_ptr<const EdgeGraph>> made;
  };

  mutable detail::Mutex mutex_;
  mutable std::shared_ptr<Graph> graph_ SEAMWIRE_GUARDED_BY(mutex_);
};

}  // namespace seamwire::python
