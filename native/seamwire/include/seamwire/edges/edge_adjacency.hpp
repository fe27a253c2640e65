// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>

#include "seamwire/api.hpp"
#include "seamwire/surface/surface.hpp"
#include "seamwire/task.hpp"

namespace seamwire {

/// The real edges around each vertex of a surface, and the cost of turning from one edge to another.
///
/// The cost of a turn is 1 - cos kappa. Here kappa is the discrete geodesic curvature, pi |left - right| / (left +
/// right) of the face angles on either side. On a boundary, kappa is zero along the boundary, and otherwise pi minus
/// the angle between the edges.
///
/// If the faces at a vertex are not a single umbrella, kappa is the angle by which the chain turns in space. Examples
/// are an edge with three faces, a bow-tie and a loose edge.
///
/// Immutable. Any number of threads may use it at once.
///
/// \see Polthier and Schmies 1998, "Straightest Geodesics on Polyhedral Surfaces"
class EdgeAdjacency;

/// Make the edge adjacency of a surface.
///
/// \param surface the surface
/// \returns the adjacency, never null
SEAMWIRE_API std::shared_ptr<const EdgeAdjacency> make_edge_adjacency(const Surface& surface, const Task& = {});

}  // namespace seamwire
