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

#include "seamwire/surface/surface.hpp"
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
/// OpenMesh's half-edge mesh, for edits: removing degenerate faces collapses and flips edges.
struct HalfEdgeMesh : OpenMesh::TriMesh_ArrayKernelT<HalfEdgeTraits> {};

/// The corner fans of a surface as vertices of such a mesh, with the same numbers, and the same triangles.
HalfEdgeMesh half_edge_mesh(const Surface& surface);

}  // namespace seamwire::detail
