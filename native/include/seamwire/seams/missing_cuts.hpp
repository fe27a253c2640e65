// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "seamwire/api.hpp"
#include "seamwire/surface/surface.hpp"

namespace seamwire {

/// How many more cuts each segment needs to become a disc. That is 0 for a disc, 1 for a tube or a closed ball,
/// and 3 for a torus. Each cut leads from border to border. A segment without a border needs another cut
/// first to get one.
///
/// Triangles that share only a vertex are not joined. Non-manifold and unorientable edges are borders of their
/// triangles, as in face_segments(): a Moebius strip is a disc.
///
/// `cut_edges`: as in face_segments(). `segments`: what that returns for them. Throws InvalidInput for a vertex out of
/// range, and for segments of another surface or of other cuts.
SEAMWIRE_API std::vector<std::int32_t> missing_cuts(const Surface& surface, std::span<const Edge> cut_edges,
                                                    std::span<const std::int32_t> segments);

}  // namespace seamwire
