// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <cstdint>
#include <vector>

#include "seamwire/surface/surface.hpp"
#include "surface/corner_fans.hpp"

namespace seamwire::detail {

/// A triangle lower than this fraction of its longest side has no area: so are all parts of it, so bisecting it never
/// ends. SurfaceReport::zero_area_faces lists those of a surface.
inline constexpr double kNoArea = 1e-9;

/// A triangle lower than this, on the unit cube's scale, tells nothing of the surface's direction: so high does storing
/// coordinates as 32-bit floats make triangles whose corners are in line. SurfaceReport::low_faces lists those of a
/// surface.
inline constexpr double kLeastHeight = 0x1p-22;

/// The area of a triangle with these sides: of the two shorter ones, so that it does not matter which side is first.
inline double area(const Vector& a, const Vector& b, const Vector& c) {
  const double aa = a.squaredNorm(), bb = b.squaredNorm(), cc = c.squaredNorm(), longest = std::max({aa, bb, cc});
  return (aa == longest ? b.cross(c) : bb == longest ? c.cross(a) : a.cross(b)).norm() / 2;
}

/// Whether a triangle with these sides, in the unit cube, has an area.
inline bool has_area(const Vector& a, const Vector& b, const Vector& c) {
  return 2 * area(a, b, c) > kNoArea * std::max({a.squaredNorm(), b.squaredNorm(), c.squaredNorm()});
}

/// The triangles of corner_fans(surface) that are those of the caller's in a list, ascending as that is.
inline std::vector<std::int32_t> half_edge_faces(const Surface& surface, const std::vector<std::int32_t>& of_caller) {
  const std::vector<std::int32_t>& source = corner_fans(surface).faces;
  if (source.size() == surface.face_count()) return of_caller;
  std::vector<std::int32_t> faces;
  for (const std::int32_t face : of_caller) {
    const auto at = std::ranges::lower_bound(source, face);
    if (at != source.end() && *at == face) faces.push_back(static_cast<std::int32_t>(at - source.begin()));
  }
  return faces;
}

}  // namespace seamwire::detail
