// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "geodesics/geodesic_mesh.hpp"
#include "seamwire/geodesics/exact_geodesics.hpp"

namespace seamwire {

/// What a solve leaves behind, one entry a vertex in the numbering of the GeodesicMesh.
struct WavefrontResult {
  std::vector<double> distances;
  std::vector<DistanceField::TraceRecord> records;
  GeodesicCounters counters;
};

/// At most `windows_kept` windows of a list go on, those around the one that is shortest at the apex, stretched over
/// what the others covered (0: all, which is exact). Distances are then approximate, and records only say about where
/// the path comes from; every vertex that is connected to the seed has both.
WavefrontResult propagate_wavefront(const GeodesicMesh& mesh, std::int32_t seed, const Task& task,
                                    std::uint32_t windows_kept = 0);

}  // namespace seamwire
