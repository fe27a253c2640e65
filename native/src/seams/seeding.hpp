// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "seams/candidate_wires.hpp"
#include "seams/seam_choices.hpp"
#include "seamwire/seams/seam_planner.hpp"
#include "seamwire/task.hpp"

namespace seamwire {

/// Places seeds and joins them by wires until these cut the surface into discs, or there are as many as there may be.
std::vector<Choice> wires_between_seeds(const CandidateWires& wires, const Seclusion& seclusion,
                                        const SeamPlannerOptions& options, const Task& task);

}  // namespace seamwire
