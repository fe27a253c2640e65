// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// A property of Eigen vectors is grown by values that Eigen leaves uninitialised, on purpose.
#if defined(__GNUC__) && !defined(__clang__)
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wmaybe-uninitialized"
#endif
#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>
#if defined(__GNUC__) && !defined(__clang__)
#pragma GCC diagnostic pop
#endif

// EigenVectorT.hh specialises what the headers above it declare.
#include <OpenMesh/Core/Geometry/EigenVectorT.hh>

#include "seamwire/surface/vector.hpp"

namespace seamwire::detail {

/// \cond
struct HalfEdgeTraits : OpenMesh::DefaultTraits {
  using Point = Vector;
  using Normal = Vector;
  VertexAttributes(0);
  HalfedgeAttributes(0);  // no previous half-edge: triangles do not need it
  EdgeAttributes(0);
  FaceAttributes(0);
};
/// \endcond
/// The half-edge mesh behind a Surface (Surface::half_edges()): manifold, consistently oriented, never changed.
struct HalfEdgeMesh : OpenMesh::TriMesh_ArrayKernelT<HalfEdgeTraits> {};

}  // namespace seamwire::detail
