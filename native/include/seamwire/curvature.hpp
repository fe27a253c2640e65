// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "seamwire/surface.hpp"

namespace seamwire {

/// Principal curvatures at the caller's vertices, of the model scaled to the unit cube (unit: 1 / side of the cube).
/// Vertices without a usable face have curvature 0, and a zero normal if they have none.
struct Curvature {
  std::vector<double> k1, k2;   ///< |k1| >= |k2|
  std::vector<Vector> d1, d2;   ///< their directions: unit, orthogonal, in the tangent plane
  std::vector<Vector> normals;  ///< unit

  /// s of eq. 5: |k1| - |k2|, the strength of a ridge or valley.
  std::vector<double> difference() const;
};

/// Vertex normals weighted as in Max, "Weights for Computing Vertex Normals from Facet Normals" (1999).
std::vector<Vector> vertex_normals(const Surface& surface);

/// Rusinkiewicz, "Estimating Curvatures and Their Derivatives on Triangle Meshes" (2004), on vertex_normals().
Curvature principal_curvatures(const Surface& surface);

}  // namespace seamwire
