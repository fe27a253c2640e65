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
  std::vector<Vector> points;       ///< in the caller's coordinates, both ends among them; empty: no curve leads there
  std::vector<std::int32_t> faces;  ///< the caller's face that each segment lies in, one fewer than points
  double length = std::numeric_limits<double>::infinity();  ///< in the caller's units
};

/// Finds the curve in which a plane cuts the surface between two points. The plane leads through both points and along
/// a direction. With the direction of a view, the curve is straight in that view. It is straight in each triangle, and
/// exact up to rounding.
///
/// If several curves lead there, around a closed surface or over edges with three or more faces, the result is the
/// shortest one. The result has no points if the curve through one point ends at a boundary, or closes, before it
/// reaches the other point.
///
/// Throws InvalidInput if a point is not on the surface, or if the direction is not finite. Throws InvalidInput, too,
/// if there is no such plane: the points are the same, or one lies behind the other along the direction.
SEAMWIRE_API PlaneSection plane_section(const Surface& surface, const SurfacePoint& from, const SurfacePoint& to,
                                        const Vector& direction);

}  // namespace seamwire
