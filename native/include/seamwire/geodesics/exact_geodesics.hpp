// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>

#include "seamwire/geodesics/distance_field.hpp"
#include "seamwire/surface/intrinsic_mesh.hpp"
#include "seamwire/task.hpp"

namespace seamwire {

class GeodesicMesh;  // the solver's own form of the mesh

/// What the work of a solve consisted of; the same for the same input on every machine.
struct GeodesicCounters {
  std::size_t lists = 0;    ///< window lists propagated
  std::size_t windows = 0;  ///< windows propagated
};

/// Solver for repeated seeds on one mesh: the triangle-oriented wavefront of Qin et al., "Fast and Exact Discrete
/// Geodesic Computation Based on Triangle-Oriented Wavefront Propagation" (2016), with the filter of Xin and Wang
/// (2009), on edge lengths alone. solve() may be called from several threads at once.
class ExactGeodesics {
 public:
  /// Throws InvalidInput for a length that is not positive and finite, a triangle that fails the triangle inequality,
  /// or twins that do not match; Cancelled.
  explicit ExactGeodesics(const IntrinsicMesh& mesh, const Task& task = {});
  /// Throws InvalidInput for a seed out of range; Cancelled.
  DistanceField solve(std::int32_t seed, const Task& task = {}, GeodesicCounters* counters = nullptr) const;

  /// The same with at most `windows` > 0 windows of a list going on: those around the shortest way to the apex,
  /// stretched over what the others covered. The more windows, the longer it takes and the nearer it comes
  /// (docs/benchmarks.md).
  DistanceField solve_bounded(std::int32_t seed, std::uint32_t windows, const Task& task = {},
                              GeodesicCounters* counters = nullptr) const;

 private:
  friend class CorridorPaths;

  DistanceField run(std::int32_t seed, std::uint32_t windows, const Task& task, GeodesicCounters* counters) const;

  std::shared_ptr<const GeodesicMesh> mesh_;
};

}  // namespace seamwire
