// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>

#include "prices/border_odds.hpp"
#include "prices/plan_mesh.hpp"
#include "seamwire/task.hpp"

namespace seamwire::detail {

/// Whether hardly any of a mesh is flat. Throws Cancelled.
bool is_round(const PlanMesh& mesh, std::span<const FaceFrame> frames, const PieceSizes& sizes, const Task& task);

/// Whether most of the bending is in soft edges, and rims take off details only, such as eyes and lips: nearly all of
/// each piece is one part. `rims`: the part of each triangle by rims. Throws Cancelled.
bool is_soft(const PlanMesh& mesh, std::span<const FaceFrame> frames, const PieceSizes& sizes, const EdgeBends& bends,
             std::span<const std::int32_t> rims, const Task& task);

}  // namespace seamwire::detail
