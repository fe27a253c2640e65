// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "parts/polygons.hpp"
#include "seams/plan_mesh.hpp"
#include "seams/reflection.hpp"
#include "seamwire/task.hpp"

namespace seamwire::detail {

/// The log odds of each edge of being a border between parts, for a mesh of which about as many edges are borders as
/// artists make. Diagonals of polygons have none and are -infinity. Throws Cancelled.
///
/// `is_marked`: of each edge, 1 where an artist expects a border. `reflection`: null if the mesh is not symmetric.
std::vector<double> border_odds(const PlanMesh& mesh, std::span<const FaceFrame> frames, const Polygons& polygons,
                                std::span<const std::uint8_t> is_marked, const Reflection* reflection,
                                const Task& task);

}  // namespace seamwire::detail
