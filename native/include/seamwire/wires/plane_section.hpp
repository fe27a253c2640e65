// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include "seamwire/surface/surface.hpp"
#include "seamwire/surface/surface_point.hpp"

namespace seamwire {

/// A curve over a surface in one plane, from one point to another.
struct PlaneSection {
  std::vector<Vector> points;       ///< in the caller's coordinates, both ends among them; empty: no curve leads there
  std::vector<std::int32_t> faces;  ///< the caller's face that each segment lies in, one fewer than points
  double length = std::numeric_limits<double>::infinity();  ///< in the caller's units
};

/// Where the plane through two points of a surface and along a direction cuts the surface between them: with the
/// direction of a view, what is straight in that view. Exact but for rounding: straight in each triangle. Where two
/// ways lead there, around a closed surface or over edges with three or more faces, it is the shortest one; there is
/// none where the plane's curve through one point ends at a boundary, or is closed, before it comes to the other.
///
/// Throws InvalidInput for a point that is none of the surface, a direction that is not finite, and where there is no
/// such plane: the points are the same, or one lies behind the other along the direction.
PlaneSection plane_section(const Surface& surface, const SurfacePoint& from, const SurfacePoint& to,
                           const Vector& direction);

}  // namespace seamwire
