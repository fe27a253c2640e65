// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "lazy.hpp"
#include "seamwire/edges/edge_wires.hpp"
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
    return graph_.get(surface, task,
                      [&] { return make_edge_graph(*surface, metric, nullptr, {}, std::nullopt, task); });
  }

  std::shared_ptr<const Metric> shared;
  const Metric& metric;

 private:
  OfLastSurface<EdgeGraph> graph_;
};

}  // namespace seamwire::python
