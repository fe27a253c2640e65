// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "slits/slit_plan.hpp"

namespace seamwire::detail {

/// Slits on a simplified mesh, as slits on the original one: chains of its real edges that run along them closely.
/// Slits that start on others start at the same vertices. The image of a slit on an exactly symmetric mesh is exact. A
/// slit that the original's edges cannot follow is left out. `vertices`: of the original, for each vertex of the
/// simplified mesh.
std::vector<Slit> carried_slits(const SlitProblem& simple, std::span<const std::int32_t> vertices,
                                const SlitProblem& original, std::span<const Slit> slits);

}  // namespace seamwire::detail
