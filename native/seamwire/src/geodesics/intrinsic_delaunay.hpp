// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "seamwire/surface/intrinsic_mesh.hpp"
#include "seamwire/task.hpp"

namespace seamwire::detail {

/// Flips edges until both angles opposite to each edge add up to at most pi. Only edges of two triangles that are
/// oriented alike are flipped. See Fisher et al. 2007, "An Algorithm for the Construction of Intrinsic Delaunay
/// Triangulations".
///
/// Before that, all lengths grow by the same amount, at most 1e-5 of the mean length. So no triangle is thinner than
/// rounding. See Sharp and Crane 2020, "A Laplacian for Nonmanifold Triangle Meshes".
///
/// The result has no siblings, loose edges or areas. Two corners of a triangle may be the same vertex.
/// Throws Cancelled.
IntrinsicMesh intrinsic_delaunay(const IntrinsicMesh& mesh, const Task& task);

}  // namespace seamwire::detail
