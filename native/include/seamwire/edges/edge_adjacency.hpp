// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>

#include "seamwire/surface/surface.hpp"
#include "seamwire/task.hpp"

namespace seamwire {

/// The real edges around each vertex of a surface, and what it costs to turn from one to another: 1 - cos kappa, where
/// kappa is the discrete geodesic curvature, pi |left - right| / (left + right) of the face angles on either side
/// (Polthier and Schmies, "Straightest Geodesics on Polyhedral Surfaces", 1998). On a boundary it is zero along the
/// boundary, else pi minus the angle between the edges; where the faces at a vertex are no single umbrella (an edge
/// with three faces, a bow-tie, a loose edge) it is the angle by which the chain turns in space. Immutable, so any
/// number of threads may use it.
class EdgeAdjacency;

/// Throws Cancelled.
std::shared_ptr<const EdgeAdjacency> make_edge_adjacency(const Surface& surface, const Task& task = {});

}  // namespace seamwire
