// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "edge_fans.hpp"
#include "seamwire/scribble.hpp"
#include "seamwire/surface.hpp"

namespace seamwire {

/// The real edges that stay nearest to a scribble, as chains of vertices in its order; more than one where no edges
/// lead on. The scribble must be one that apply_scribbles() takes.
std::vector<std::vector<std::int32_t>> stroke_chains(const Surface& surface, const EdgeFans& fans,
                                                     const Scribble& scribble);

}  // namespace seamwire
