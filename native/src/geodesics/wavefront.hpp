// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "geodesics/geodesic_mesh.hpp"
#include "geodesics/trace_record.hpp"
#include "seamwire/geodesics/exact_geodesics.hpp"

namespace seamwire {

/// What a solve finds, one entry for each vertex of the GeodesicMesh.
struct WavefrontResult {
  std::vector<double> distances;
  std::vector<TraceRecord> records;
  GeodesicCounters counters;
};

/// Distances from `seed` to all vertices. `windows_kept`: 0, or the number of windows of a list that go on: those
/// around the one that is shortest at the apex, the outer two stretched over what the others covered. 0 keeps all and
/// is exact; otherwise distances are approximate, and records only say roughly where the path comes from, but every
/// vertex that is connected to the seed has both. Throws Cancelled.
WavefrontResult propagate_wavefront(const GeodesicMesh& mesh, std::int32_t seed, const Task& task,
                                    std::uint32_t windows_kept = 0);

}  // namespace seamwire
