// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "seams/cut_pieces.hpp"
#include "seams/seam_choices.hpp"
#include "seamwire/surface/surface.hpp"
#include "seamwire/task.hpp"

namespace seamwire {

/// Takes wires away until each that is left is needed, mirror images together: the longest for its worth first, as
/// Kruskal's algorithm turned round finds a shortest tree. `images`: as SeamPlannerOptions. `pieces`: those of the
/// choices and of the seams that stay.
std::vector<Choice> thinned(const Surface& surface, const std::vector<std::int32_t>& images,
                            const std::vector<Choice>& choices, CutPieces pieces, const SeamLimits& limits,
                            const Task& task);

}  // namespace seamwire
