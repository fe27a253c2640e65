// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
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

/// When a solve may stop. The front looks back by no more than the mesh's longest edge, so what it saves is less where
/// that is long.
struct SolveOptions {
  /// Distances beyond it are not wanted: they are given as infinite. 0 or more.
  double max_distance = std::numeric_limits<double>::infinity();
  /// Distances and paths are wanted here only: where this is not empty, the solve stops when all are known (or are
  /// beyond max_distance). DistanceField::radius() tells how far it came.
  std::vector<SurfacePoint> targets;
};

/// Solver for repeated seeds on one mesh, from edge lengths alone. Its wavefront is that of Qin et al., "Fast and Exact
/// Discrete Geodesic Computation Based on Triangle-Oriented Wavefront Propagation" (2016). Its filter is that of Xin
/// and Wang (2009). solve() may be called from several threads at once.
class SEAMWIRE_API ExactGeodesics {
 public:
  /// Throws InvalidInput for a length that is not positive and finite, for a triangle that fails the triangle
  /// inequality, or for twins without match. Throws Cancelled.
  explicit ExactGeodesics(const IntrinsicMesh& mesh, const Task& task = {});
  /// The same as from `mesh` alone, in less time if most of it equals `former_mesh`, including the numbers. `former`
  /// was made from `former_mesh`. The mesh of an embedding made by re_embed() is such a mesh. Equal parts are shared
  /// with `former`. Throws what the other constructor throws. Throws InvalidInput if `former_mesh` differs in size from
  /// the mesh that `former` was made from.
  ExactGeodesics(const ExactGeodesics& former, const IntrinsicMesh& former_mesh, const IntrinsicMesh& mesh,
                 const Task& task = {});
  /// Throws InvalidInput for a seed out of range; Cancelled.
  DistanceField solve(std::int32_t seed, const Task& task = {}) const;

  /// Distances from the nearest of one or several sources, each any point of the mesh. Throws InvalidInput for no
  /// source, for sources and targets as DistanceField::distance() does, and for a max_distance that is negative or not
  /// a number; Cancelled.
  DistanceField solve(std::span<const SurfacePoint> sources, const SolveOptions& options = {},
                      const Task& task = {}) const;

  /// The same as from a seed, with at most `windows` > 0 windows of a list going on: those around the shortest way to
  /// the apex, stretched over what the others covered. The more windows, the longer it takes and the nearer it comes.
  DistanceField solve_bounded(std::int32_t seed, std::uint32_t windows, const Task& task = {}) const;

 private:
  friend class CorridorPaths;

  DistanceField run(std::span<const SurfacePoint> sources, const SolveOptions& options, std::uint32_t windows,
                    const Task& task) const;

  std::shared_ptr<const detail::GeodesicMesh> mesh_;
};

}  // namespace seamwire
