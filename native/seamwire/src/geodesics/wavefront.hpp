// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "detail/infinity.hpp"
#include "geodesics/geodesic_mesh.hpp"
#include "geodesics/placed_point.hpp"
#include "geodesics/trace_record.hpp"
#include "seamwire/geodesics/exact_geodesics.hpp"

namespace seamwire::detail {

/// The result of a solve, one entry for each vertex of the GeodesicMesh.
struct WavefrontResult {
  std::vector<double> distances;
  std::vector<TraceRecord> records;
  std::vector<SiblingCrossing> crossings;  ///< that records name
  GeodesicCounters counters;
  /// Distances up to it are final, others infinite; infinite where the front was not stopped.
  double radius = kInfinity;
};

/// Which windows go on, and where the front may stop.
struct WavefrontOptions {
  /// The number of windows of a list that go on. 0 keeps all and is exact. Otherwise the windows around the one that is
  /// shortest at the apex are kept, and the outer two are stretched over what the others covered. Then distances are
  /// approximate, and records only tell roughly where the path comes from. But every vertex that is connected to a
  /// source has both.
  std::uint32_t windows_kept = 0;
  double max_distance = kInfinity;
  std::vector<PlacedPoint> targets = {};  ///< none: at max_distance only
};

/// Distances from the nearest of some sources to all vertices. Throws Cancelled.
WavefrontResult propagate_wavefront(const GeodesicMesh& mesh, const SourcePoints& sources,
                                    const WavefrontOptions& options, const Task& task);

}  // namespace seamwire::detail
