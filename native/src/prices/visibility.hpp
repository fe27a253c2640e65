// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "prices/plan_mesh.hpp"
#include "seamwire/surface/vector.hpp"
#include "seamwire/task.hpp"

namespace seamwire::detail {

/// How much of the surface around it sees each vertex of a mesh.
struct Visibility {
  std::vector<double> front;    ///< the share of the views from the front that see the vertex; empty without a front
  std::vector<double> ambient;  ///< the share of the sky above the vertex that the mesh does not cover, cosine-weighted
};

/// `front`: the direction towards the viewer; nullopt if no side is the front. `sizes`: of each vertex the size of its
/// part, the root of the area; empty: 1. `most`: how many vertices to sample at most; the others get the values of
/// the nearest sample, along edges. On several threads. Throws Cancelled.
Visibility find_visibility(const PlanMesh& mesh, const std::optional<Vector>& front, const Task& task,
                           std::span<const double> sizes = {},
                           std::size_t most = std::numeric_limits<std::size_t>::max());

/// For each vertex the nearest of some vertices, along edges: its place among them; -1 if no edges lead there. Throws
/// Cancelled.
std::vector<std::int32_t> nearest_of(const PlanMesh& mesh, std::span<const std::int32_t> vertices, const Task& task);

}  // namespace seamwire::detail
