// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
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
  explicit CurvatureObject(Curvature computed) : curvature(std::move(computed)), difference(curvature.difference()) {}

  Curvature curvature;
  std::vector<double> difference;
};

struct MetricObject {
  explicit MetricObject(Metric computed) : metric(std::move(computed)) {}

  /// Returns the graph of a surface's edges in this metric, and keeps that of the last surface. Call without the GIL.
  std::shared_ptr<const EdgeGraph> edge_graph(const std::shared_ptr<const Surface>& surface, const Task& task) const {
    return graph_.get(surface, task, [&] { return make_edge_graph(*surface, metric, nullptr, task); });
  }

  Metric metric;

 private:
  OfLastSurface<EdgeGraph> graph_;
};

}  // namespace seamwire::python
