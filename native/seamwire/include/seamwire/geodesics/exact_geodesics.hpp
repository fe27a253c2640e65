// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <limits>
#include <memory>
#include <span>
#include <vector>

#include "seamwire/api.hpp"
#include "seamwire/geodesics/distance_field.hpp"
#include "seamwire/surface/intrinsic_mesh.hpp"
#include "seamwire/surface/surface_point.hpp"
#include "seamwire/task.hpp"

namespace seamwire {

namespace detail {
class GeodesicMesh;  // the solver's own form of the mesh
}

/// When a solve may stop.
///
/// A distance is final once the front has passed it by the length of the mesh's longest edge. So stopping early saves
/// less on a mesh with a long edge.
struct SolveOptions {
  /// Largest distance to compute, 0 or more. Larger distances are infinite in the result.
  double max_distance = std::numeric_limits<double>::infinity();
  /// Points whose distances and paths are needed. The solve stops once all are known, or are beyond `max_distance`.
  /// DistanceField::radius() tells how far it came. Empty: the whole mesh.
  std::vector<SurfacePoint> targets;
};

/// Computes geodesic distances on one mesh, from edge lengths alone. It is prepared once and then used for many seeds.
///
/// Copies share the prepared mesh. Any number of threads may call the members at once.
///
/// \see Qin et al. 2016, "Fast and Exact Discrete Geodesic Computation Based on Triangle-Oriented Wavefront
///   Propagation", for the wavefront
/// \see Xin and Wang 2009, for the filter
class SEAMWIRE_API ExactGeodesics {
 public:
  /// Prepare a mesh.
  ///
  /// \param mesh the mesh. Lengths are at most 1e76, and the longest one is at least 1e-76.
  /// \param task progress and cancellation
  /// \throws InvalidInput if a vertex or a length is out of range, or a triangle's lengths leave it no area
  /// \throws InvalidInput if arrays have the wrong size, or twins or siblings do not match
  /// \throws Cancelled if the task is cancelled
  explicit ExactGeodesics(const IntrinsicMesh& mesh, const Task& task = {});
  /// Prepare a mesh that mostly equals another one, in less time.
  ///
  /// The result is the same as that of the other constructor. Equal parts, including their numbers, are shared with
  /// `former`. re_embed() makes meshes that mostly equal the former ones.
  ///
  /// \param former the solver that was made from `former_mesh`
  /// \param former_mesh the mesh of `former`
  /// \param mesh the new mesh
  /// \param task progress and cancellation
  /// \throws InvalidInput if the other constructor rejects the new mesh, or `former_mesh` differs in size from the mesh
  ///   of `former`
  /// \throws Cancelled if the task is cancelled
  ExactGeodesics(const ExactGeodesics& former, const IntrinsicMesh& former_mesh, const IntrinsicMesh& mesh,
                 const Task& task = {});
  /// Compute exact distances from a point.
  ///
  /// \param seed a point of the mesh
  /// \param task progress and cancellation
  /// \returns the distances, and the paths
  /// \throws InvalidInput if DistanceField::distance() rejects the seed
  /// \throws Cancelled if the task is cancelled
  DistanceField solve(const SurfacePoint& seed, const Task& task = {}) const;

  /// Compute exact distances from the nearest of several points.
  ///
  /// \param sources one or more points of the mesh
  /// \param options when the solve may stop
  /// \param task progress and cancellation
  /// \returns the distances, and the paths
  /// \throws InvalidInput if there is no source, or DistanceField::distance() rejects a source or a target
  /// \throws InvalidInput if the largest distance is negative or not a number
  /// \throws Cancelled if the task is cancelled
  DistanceField solve(std::span<const SurfacePoint> sources, const SolveOptions& options = {},
                      const Task& task = {}) const;

 private:
  friend class CorridorPaths;

  std::shared_ptr<const detail::GeodesicMesh> mesh_;
};

}  // namespace seamwire
