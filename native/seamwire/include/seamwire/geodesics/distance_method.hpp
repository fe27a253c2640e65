// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <limits>
#include <span>
#include <vector>

#include "seamwire/api.hpp"
#include "seamwire/geodesics/distance_field.hpp"
#include "seamwire/surface/surface_point.hpp"
#include "seamwire/task.hpp"

namespace seamwire {

/// When a solve may stop.
struct SolveOptions {
  /// Largest distance to compute, 0 or more, in the unit of the mesh's lengths. Larger distances are infinite in the
  /// result.
  double max_distance = std::numeric_limits<double>::infinity();
  /// Points whose distances and paths are needed. The solve may stop once all are known, or are beyond `max_distance`.
  /// DistanceField::radius() tells how far it came. Empty: the whole mesh.
  std::vector<SurfacePoint> targets;
};

/// Computes distances on one mesh. It is prepared once and then used for many seeds.
///
/// ExactGeodesics and HeatGeodesics are such methods. To add one, derive a class from DistanceMethod and another one
/// from SolvedField. Any number of threads may call the members at once.
class SEAMWIRE_API DistanceMethod {
 public:
  virtual ~DistanceMethod();
  /// Compute distances from a point.
  ///
  /// \param seed a point of the mesh
  /// \returns the distances, and the paths
  /// \throws InvalidInput if DistanceField::distance() rejects the seed
  DistanceField solve(const SurfacePoint& seed, const Task& = {}) const;
  /// Compute distances from the nearest of several points.
  ///
  /// \param sources one or more points of the mesh
  /// \param options when the solve may stop
  /// \returns the distances, and the paths
  /// \throws InvalidInput if there is no source, or DistanceField::distance() rejects a source or a target
  /// \throws InvalidInput if the largest distance is negative or not a number
  DistanceField solve(std::span<const SurfacePoint> sources, const SolveOptions& options = {}, const Task& = {}) const;

 protected:
  DistanceMethod() = default;
  DistanceMethod(const DistanceMethod&) = default;
  DistanceMethod(DistanceMethod&&) = default;
  DistanceMethod& operator=(const DistanceMethod&) = default;
  DistanceMethod& operator=(DistanceMethod&&) = default;

 private:
  /// Solve as solve() promises, which has checked that there is a source and that the largest distance is valid.
  virtual DistanceField solve_checked(std::span<const SurfacePoint> sources, const SolveOptions& options,
                                      const Task& task) const = 0;
};

}  // namespace seamwire
