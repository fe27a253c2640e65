// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "geodesics/geodesic_mesh.hpp"
#include "geodesics/placed_point.hpp"
#include "geodesics/trace_record.hpp"
#include "seamwire/geodesics/distance_field.hpp"

namespace seamwire {

struct DistanceField::Data {
  std::shared_ptr<const detail::GeodesicMesh> mesh;
  std::vector<SurfacePoint> given_sources;
  detail::SourcePoints sources;              ///< the same in internal numbers
  std::vector<double> distances;             ///< in external numbers
  std::vector<detail::TraceRecord> records;  ///< in internal numbers
  std::vector<detail::SiblingCrossing> crossings;
  bool is_exact;
  GeodesicCounters counters;
  double radius;  ///< distances beyond it are infinite
};

}  // namespace seamwire
