// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "prices/border_odds.hpp"
#include "prices/plan_mesh.hpp"
#include "seamwire/surface/surface.hpp"
#include "seamwire/task.hpp"

namespace seamwire::detail {

/// The smooth surface that a coarse mesh of polygons stands for.
struct Smoothed {
  std::shared_ptr<const Surface> surface;
  std::vector<std::int32_t> polygons;  ///< the polygon of each triangle of the surface
};

/// One step of the subdivision of Catmull and Clark ("Recursively generated B-spline surfaces on arbitrary topological
/// meshes", 1978). A boundary becomes a B-spline curve. Throws Cancelled.
Smoothed smoothed(const PlanMesh& mesh, const Polygons& polygons, const Task& task);

}  // namespace seamwire::detail
