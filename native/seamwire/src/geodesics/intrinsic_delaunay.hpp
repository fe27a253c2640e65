// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "seamwire/surface/intrinsic_mesh.hpp"
#include "seamwire/surface/types.hpp"
#include "seamwire/task.hpp"

namespace seamwire::detail {

/// Triangles over the vertices of an IntrinsicMesh. Two corners of a triangle may be the same vertex.
struct IntrinsicTriangles {
  std::vector<Triangle> corners;
  std::vector<std::int32_t> twins;  ///< as TriangleConnectivity::twins
  std::vector<double> lengths;      ///< per half-edge
  std::size_t flips = 0;            ///< edges that were flipped to get there
};

/// Flips edges until both angles opposite to each edge add up to at most pi. Only edges of two triangles that are
/// oriented alike are flipped. See Fisher et al. 2007, "An Algorithm for the Construction of Intrinsic Delaunay
/// Triangulations".
///
/// Before that, all lengths grow by the same amount, at most 1e-5 of the mean length. So no triangle is thinner than
/// rounding. See Sharp and Crane 2020, "A Laplacian for Nonmanifold Triangle Meshes". Throws Cancelled.
IntrinsicTriangles intrinsic_delaunay(const IntrinsicMesh& mesh, const Task& task);

}  // namespace seamwire::detail
