// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "seamwire/surface/surface.hpp"
#include "seamwire/task.hpp"
#include "seamwire_uv/api.hpp"

namespace seamwire {

/// Count how many more cuts each segment needs before it can lie flat with little stretch.
///
/// A disc needs 0, a tube or a closed ball needs 1, and a torus needs 3. Each cut leads from border to border. A
/// segment without a border needs another cut first to get one. A hole in a nearly flat place needs no cut: if
/// it were filled, it would have less than 60 degrees of curvature.
///
/// Triangles that share only a vertex are not joined. Non-manifold and unorientable edges are borders of their
/// triangles, as in face_segments(). So a Moebius strip is a disc.
///
/// \param surface the surface
/// \param cut_edges as in face_segments()
/// \param segments the result of face_segments() for these cuts
/// \returns the number of cuts for each segment
/// \throws InvalidInput if a vertex is out of range, or the segments are of another surface or of other cuts
SEAMWIRE_UV_API std::vector<std::int32_t> missing_cuts(const Surface& surface, std::span<const Edge> cut_edges,
                                                       std::span<const std::int32_t> segments, const Task& = {});

}  // namespace seamwire
