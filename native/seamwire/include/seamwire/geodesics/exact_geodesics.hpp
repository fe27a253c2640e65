// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <memory>
#include <span>

#include "seamwire/api.hpp"
#include "seamwire/geodesics/distance_field.hpp"
#include "seamwire/geodesics/distance_method.hpp"
#include "seamwire/surface/intrinsic_mesh.hpp"
#include "seamwire/surface/surface_point.hpp"
#include "seamwire/task.hpp"

namespace seamwire {

namespace detail {
class GeodesicMesh;  // the solver's own form of the mesh
}

/// Counts the work of a solve. The counts are the same for the same input on every machine.
struct GeodesicCounters {
  std::size_t lists = 0;    ///< window lists propagated
  std::size_t windows = 0;  ///< windows propagated
};

/// Exact distances, which ExactGeodesics makes.
class SEAMWIRE_API ExactField : public DistanceField {
 public:
  /// Return how much work the solve took.
  const GeodesicCounters& counters() const;

 private:
  friend class ExactGeodesics;  // which makes them
  class Solved;
  explicit ExactField(std::shared_ptr<const Solved> solved);
};

/// Computes exact distances on one mesh, from edge lengths alone. It is prepared once and then used for many seeds.
///
/// A distance is final once the front has passed it by the length of the mesh's longest edge. So stopping early saves
/// less on a mesh with a long edge. Copies share the prepared mesh.
///
/// \see Qin et al. 2016, "Fast and Exact Discrete Geodesic Computation Based on Triangle-Oriented Wavefront
///   Propagation", for the wavefront
/// \see Xin and Wang 2009, for the filter
class SEAMWIRE_API ExactGeodesics final : public DistanceMethod {
 public:
  /// Prepare a mesh.
  ///
  /// \param mesh the mesh. Lengths are at most 1e76, and the longest one is at least 1e-76.
  /// \throws InvalidInput if a vertex or a length is out of range, or a triangle's lengths leave it no area
  /// \throws InvalidInput if arrays have the wrong size, or twins or siblings do not match
  explicit ExactGeodesics(const IntrinsicMesh& mesh, const Task& = {});
  /// Prepare a mesh that mostly equals another one, in less time.
  ///
  /// The result is the same as that of the other constructor. Equal parts, including their numbers, are shared with
  /// `former`. re_embed() makes meshes that mostly equal the former ones.
  ///
  /// \param former the solver that was made from `former_mesh`
  /// \param former_mesh the mesh of `former`
  /// \param mesh the new mesh
  /// \throws InvalidInput if the other constructor rejects the new mesh, or `former_mesh` differs in size from the mesh
  ///   of `former`
  ExactGeodesics(const ExactGeodesics& former, const IntrinsicMesh& former_mesh, const IntrinsicMesh& mesh,
                 const Task& = {});
  /// Compute exact distances from a point.
  ///
  /// \param seed a point of the mesh
  /// \returns the distances, and the paths
  /// \throws InvalidInput if DistanceField::distance() rejects the seed
  ExactField solve(const SurfacePoint& seed, const Task& = {}) const;

  /// Compute exact distances from the nearest of several points.
  ///
  /// \param sources one or more points of the mesh
  /// \param options when the solve may stop
  /// \returns the distances, and the paths
  /// \throws InvalidInput if there is no source, or DistanceField::distance() rejects a source or a target
  /// \throws InvalidInput if the largest distance is negative or not a number
  ExactField solve(std::span<const SurfacePoint> sources, const SolveOptions& options = {}, const Task& = {}) const;

 private:
  friend class CorridorPaths;
  DistanceField solve_checked(std::span<const SurfacePoint> sources, const SolveOptions& options,
                              const Task& task) const override;

  std::shared_ptr<const detail::GeodesicMesh> mesh_;
};

}  // namespace seamwire
