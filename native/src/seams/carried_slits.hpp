// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>
#include <vector>

#include "seams/decimation.hpp"
#include "seams/slit_plan.hpp"

namespace seamwire::detail {

/// Slits on a simplified mesh, as slits on the original one: chains of its real edges that run along them closely.
/// Slits that start on others start at the same vertices. The image of a slit on an exactly symmetric mesh is exact. A
/// slit that the original's edges cannot follow is left out.
std::vector<Slit> carried_slits(const SlitProblem& simple, const DecimatedMesh& mesh, const SlitProblem& original,
                                std::span<const Slit> slits);

}  // namespace seamwire::detail
