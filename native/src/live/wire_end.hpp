// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cstdint>
#include <variant>

#include "seamwire/edges/edge_wires.hpp"
#include "seamwire/surface/surface.hpp"
#include "seamwire/surface/surface_point.hpp"

namespace seamwire::detail {

/// Where a live wire begins or ends: across the surface a vertex or another point, along edges a pick.
using WireEnd = std::variant<Pick, SurfacePoint>;

/// The point of an end across the surface.
inline SurfacePoint point_of(const WireEnd& end) {
  const auto* pick = std::get_if<Pick>(&end);
  return pick != nullptr ? SurfacePoint::at_vertex(pick->a) : std::get<SurfacePoint>(end);
}

/// A vertex itself; of another point the corner of its face with the largest barycentric coordinate.
inline std::int32_t nearest_vertex(const Surface& surface, const WireEnd& end) {
  const SurfacePoint point = point_of(end);
  if (point.vertex >= 0) return point.vertex;
  const auto most = std::ranges::max_element(point.barycentric) - point.barycentric.begin();
  return surface.triangles()[point.face][static_cast<std::size_t>(most)];
}

}  // namespace seamwire::detail
