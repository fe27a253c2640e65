// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "prices/plan_mesh.hpp"
#include "seamwire/surface/surface.hpp"
#include "seamwire/task.hpp"
#include "seamwire_uv/parts/part_finder.hpp"

namespace seamwire::detail {

/// The parts of a surface between borders and existing seams. `is_border`: of each edge of the mesh. `is_rim`: the
/// same, 1 for borders that stay where they end inside of a part. `seams`: vertices of the surface. Throws Cancelled.
Parts parts_between(const Surface& surface, const PlanMesh& mesh, std::span<const std::uint8_t> is_border,
                    std::span<const std::uint8_t> is_rim, std::span<const Edge> seams, const Task& task);

}  // namespace seamwire::detail
