// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "seamwire/api.hpp"
#include "seamwire/surface/surface.hpp"
#include "seamwire/task.hpp"

namespace seamwire {

/// Principal curvatures at the caller's vertices, in 1 / unit of the caller's coordinates.
///
/// Values are never infinite or NaN. Triangles lower than 2^-22 of the longest side of the box around the surface
/// (SurfaceReport::low_faces) are ignored. A
/// vertex without other triangles has curvature 0. Its normal is zero if none of its triangles has an area. If a vertex
/// has several corner fans, the first fan decides which side is up. Fans that face the other way count turned over.
/// Each fan is fitted with its own normals.
struct SEAMWIRE_API Curvature {
  std::vector<double> k1;       ///< the curvature that is larger in size
  std::vector<double> k2;       ///< the other curvature
  std::vector<Vector> d1;       ///< direction of k1: unit, in the tangent plane; arbitrary without a normal
  std::vector<Vector> d2;       ///< direction of k2, orthogonal to d1
  std::vector<Vector> normals;  ///< unit, or zero

  /// Return |k1| - |k2| at each vertex, the strength of a ridge or valley. Times the longest side of the box around
  /// the surface, it is s of eq. 5.
  ///
  /// \see Zhuang et al. 2014, Section 3
  std::vector<double> difference() const;
};

/// Compute vertex normals, weighted as by Max.
///
/// \param surface the surface
/// \returns a unit normal for each of the caller's vertices, zero if none of its triangles has an area
/// \see Max 1999, "Weights for Computing Vertex Normals from Facet Normals"
SEAMWIRE_API std::vector<Vector> vertex_normals(const Surface& surface);

/// Compute principal curvatures on vertex_normals().
///
/// \param surface the surface
/// \returns the curvatures at the caller's vertices
/// \see Rusinkiewicz 2004, "Estimating Curvatures and Their Derivatives on Triangle Meshes"
SEAMWIRE_API Curvature principal_curvatures(const Surface& surface, const Task& = {});

/// Average curvatures over about a radius.
///
/// Curvature tensors are averaged over 1-rings, max(1, (radius / median edge)^2) times but at most 400 times. The
/// radius and the median edge are fractions of the longest side of the box. Tensors of neighbors are turned by the
/// least rotation between their normals, and weighted by the area around them. Normals do not change.
///
/// \param surface the surface
/// \param curvature curvatures at its vertices
/// \param radius as a share of the longest side of the box around the surface, such as 0.01; finite, above 0
/// \returns the averaged curvatures
/// \throws InvalidInput if the curvatures differ from the surface in size, or the radius is not positive and finite
SEAMWIRE_API Curvature smoothed_curvatures(const Surface& surface, const Curvature& curvature, double radius,
                                           const Task& = {});

}  // namespace seamwire
