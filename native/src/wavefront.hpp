// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "geodesic_mesh.hpp"
#include "seamwire/geodesics.hpp"

namespace seamwire {

/// What a solve leaves behind, one entry a vertex in the numbering of the GeodesicMesh.
struct WavefrontResult {
  std::vector<double> distances;
  std::vector<DistanceField::TraceRecord> records;
  GeodesicCounters counters;
};

WavefrontResult propagate_wavefront(const GeodesicMesh& mesh, std::int32_t seed, const Task& task);

}  // namespace seamwire
