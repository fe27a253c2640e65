// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "seamwire/api.hpp"
#include "seamwire/surface/surface.hpp"
#include "seamwire/task.hpp"

namespace seamwire {

/// Principal curvatures at the caller's vertices, of the model scaled to the unit cube (unit: 1 / side of the cube).
/// Never infinite or NaN. Triangles lower than 2^-22 of the cube (SurfaceReport::low_faces) are skipped;
/// a vertex with no other has curvature 0, and a zero normal if none has any area. A vertex of several corner fans
/// takes the side of its first fan: fans that face the other way count turned over, each fitted with its own normals.
struct Curvature {
  std::vector<double> k1;       ///< the one larger in size
  std::vector<double> k2;       ///< the other one
  std::vector<Vector> d1;       ///< direction of k1: unit, in the tangent plane; any without a normal
  std::vector<Vector> d2;       ///< direction of k2, orthogonal to that of k1
  std::vector<Vector> normals;  ///< unit

  /// s of eq. 5: |k1| - |k2|, the strength of a ridge or valley.
  std::vector<double> difference() const;
};

/// Vertex normals weighted as in Max, "Weights for Computing Vertex Normals from Facet Normals" (1999).
SEAMWIRE_API std::vector<Vector> vertex_normals(const Surface& surface);

/// Rusinkiewicz, "Estimating Curvatures and Their Derivatives on Triangle Meshes" (2004), on vertex_normals().
/// Throws Cancelled.
SEAMWIRE_API Curvature principal_curvatures(const Surface& surface, const Task& task = {});

/// Averages curvatures over about `radius` (unit: the side of the cube). Curvature tensors are averaged over 1-rings
/// max(1, (radius / median edge)^2) times, 400 times at most. The tensors of neighbors are turned by the least rotation
/// between their normals, and weighted by the area around them. The normals stay. Throws InvalidInput for curvatures of
/// another size and a radius that is not positive and finite; Cancelled.
SEAMWIRE_API Curvature smoothed_curvatures(const Surface& surface, const Curvature& curvature, double radius,
                                           const Task& task = {});

}  // namespace seamwire
