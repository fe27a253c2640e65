// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <memory>
#include <utility>

#include "lazy.hpp"
#include "seamwire/edges/fit_chain.hpp"
#include "seamwire/surface/surface.hpp"
#include "seamwire/task.hpp"
#include "seamwire/wires/snap.hpp"

namespace seamwire::python {

/// A surface, with what is built from it once, when it is first needed.
struct SurfaceObject {
  explicit SurfaceObject(std::shared_ptr<const Surface> built) : surface(std::move(built)) {}

  const SnapGraph& snap_graph(const Task& task) const {
    return snap_graph_.get(task, [&] { return SnapGraph(*surface, task); });
  }
  const EdgeAdjacency& edge_adjacency(const Task& task) const {
    return *edge_adjacency_.get(task, [&] { return make_edge_adjacency(*surface, task); });
  }

  std::shared_ptr<const Surface> surface;

 private:
  Lazy<SnapGraph> snap_graph_;
  Lazy<std::shared_ptr<const EdgeAdjacency>> edge_adjacency_;
};

/// Throws InvalidInput unless `what`, with `size` vertices, fits the surface.
void check_size(const char* what, std::size_t size, const Surface& surface);

}  // namespace seamwire::python
