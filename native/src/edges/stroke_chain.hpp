// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "edges/edge_adjacency.hpp"
#include "seamwire/metric/scribble.hpp"
#include "seamwire/surface/surface.hpp"

namespace seamwire::detail {

/// The real edges that stay nearest to a scribble, as chains of vertices in its order; more than one where no edges
/// lead on. The scribble must be one that apply_scribbles() takes.
std::vector<std::vector<std::int32_t>> stroke_chains(const Surface& surface, const EdgeAdjacency& adjacency,
                                                     const Scribble& scribble);

}  // namespace seamwire::detail
