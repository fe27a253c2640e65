// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include "seamwire/api.hpp"
#include "seamwire/surface/surface.hpp"
#include "seamwire/surface/surface_point.hpp"

namespace seamwire {

/// A curve over a surface in one plane, from one point to another.
struct PlaneSection {
  std::vector<Vector> points;       ///< in the caller's coordinates, including both ends; empty if there is no curve
  std::vector<std::int32_t> faces;  ///< per segment: the caller's face that it lies in; one fewer than points
  double length = std::numeric_limits<double>::infinity();  ///< in the caller's unit
};

/// Find the curve in which a plane cuts the surface between two points.
///
/// The plane contains both points and the direction. With the direction of a view, the curve is straight in that view.
/// The curve is straight in each triangle, and exact up to rounding. If there are several curves, around a closed
/// surface or over edges with three or more faces, the result is the shortest.
///
/// \param surface the surface
/// \param from where the curve begins
/// \param to where the curve ends
/// \param direction finite, not zero, of any length
/// \returns the curve. It has no points if the curve through one point reaches a boundary, or closes, before it reaches
///   the other point.
/// \throws InvalidInput if a point is not on the surface, or the direction is not finite
/// \throws InvalidInput if there is no such plane, because the points are the same or one lies behind the other along
///   the direction
SEAMWIRE_API PlaneSection plane_section(const Surface& surface, const SurfacePoint& from, const SurfacePoint& to,
                                        const Vector& direction);

}  // namespace seamwire
