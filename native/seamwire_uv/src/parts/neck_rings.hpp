// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "seamwire/task.hpp"
#include "slits/slit_plan.hpp"

namespace seamwire::detail {

/// A closed cut around a limb, with its mirror image.
struct NeckRing {
  std::vector<std::int32_t> loop;   ///< vertices in order, each once
  std::vector<std::int32_t> image;  ///< empty without a mirror image
  double narrowness = 0.0;          ///< how many times longer a ring a little farther on, either way, is
  double area = 0.0;                ///< what it parts, as a share of the surface
};

/// Closed cuts at the necks of limbs: hands at the wrist, heads at the neck. Around the tip of a limb, rings at equal
/// distance become longer, then shorter to the neck, then longer again. At each neck it is the cheapest ring of edges.
/// The narrowest come first.
std::vector<NeckRing> find_necks(const SlitProblem& problem, const Task& task);

/// A ring as slits that have to stay, in parts that can be carried to another mesh.
std::vector<Slit> slits_of(const NeckRing& ring);

}  // namespace seamwire::detail
