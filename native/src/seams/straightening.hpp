// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <map>
#include <set>
#include <span>
#include <vector>

#include "detail/thread_safety.hpp"
#include "seams/candidate_wires.hpp"
#include "seams/seam_choices.hpp"
#include "seamwire/seams/seam_planner.hpp"
#include "seamwire/task.hpp"

namespace seamwire {

/// Wires between pairs of vertices, each kept once it is found; from several threads.
class DirectWires {
 public:
  DirectWires(const CandidateWires& wires, const Seclusion& seclusion) : wires_(wires), seclusion_(seclusion) {}
  std::map<Ends, Choice> find(const std::set<Ends>& pairs, const Task& task,
                              CandidateWires::Effort effort = CandidateWires::Effort::kExact) const;

 private:
  const CandidateWires& wires_;
  const Seclusion& seclusion_;
  mutable Mutex mutex_;
  mutable std::array<std::map<Ends, Choice>, 2> known_ SEAMWIRE_GUARDED_BY(mutex_);  // by the effort
};

/// Makes chosen wires cost less, as long as the pieces stay as many and as good: a direct one takes the place of two
/// that meet at a seed where nothing else is, and seeds slide along wires that end there. `fixed`: vertices where all
/// stays. `options` and `limits`: those of the plan; `max_spreads`: one a triangle.
std::vector<Choice> straightened(std::vector<Choice> wires, std::span<const std::int32_t> fixed,
                                 const DirectWires& direct, const Surface& surface, const SeamPlannerOptions& options,
                                 const SeamLimits& limits, std::span<const double> max_spreads, const Task& task);

}  // namespace seamwire
