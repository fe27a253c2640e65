// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "seams/candidate_wires.hpp"
#include "seamwire/metric/curvature.hpp"
#include "seamwire/seams/seam_planner.hpp"
#include "seamwire/surface/ray_tree.hpp"
#include "seamwire/surface/surface.hpp"

namespace seamwire {

/// How much a wire is worth for where it runs: in hollows, and where nobody looks.
class Seclusion {
 public:
  explicit Seclusion(const Surface& surface, const Curvature& curvature);
  /// 1, and more the more hollow and hidden the wire is.
  double of(const std::vector<std::int32_t>& vertices) const;

 private:
  double hollow_at(std::int32_t v) const;
  /// The part of the hemisphere above a vertex that the surface itself covers, weighted by the cosine.
  double hidden_at(std::int32_t v) const;

  const Surface& surface_;
  const Curvature& curvature_;
  RayTree rays_;
};

/// A wire to choose from.
struct Choice {
  PlannedWire wire;
  double strength = 0.0;   ///< how well it follows features
  double seclusion = 1.0;  ///< Seclusion::of()
  bool is_kept = false;    ///< whether it stays whatever the limits
  bool is_quick = false;   ///< whether CandidateWires found it quickly

  double worth() const { return strength * seclusion; }
};

Choice make_choice(std::int32_t from, std::int32_t to, CandidateWire found, const Seclusion& seclusion);
/// What a wire costs: its length, in the caller's units, for its worth.
double price(const Surface& surface, const Choice& choice);

using Ends = std::pair<std::int32_t, std::int32_t>;
inline Ends ends_of(std::int32_t a, std::int32_t b) { return {std::min(a, b), std::max(a, b)}; }

/// Whether a wire comes where `density`, see SeamPlannerOptions, is 0.
bool is_barred(const Choice& choice, const std::vector<double>& density);
/// The image of a wire along edges; nullopt where it has none, or runs across the surface.
std::optional<Choice> mirrored(const Choice& choice, const Surface& surface, const SeamPlannerOptions& options);
/// The chains of choices, then the seams that stay, an edge each.
std::vector<std::vector<std::int32_t>> chains_of(const std::vector<Choice>& choices, const std::vector<Edge>& seams);
/// Those whose chains of edges meet where their curves do, at seeds; of two others the one that is kept, or worth more.
/// What edges enclose, curves then enclose too.
std::vector<Choice> meeting_at_seeds(std::vector<Choice> choices);

}  // namespace seamwire
