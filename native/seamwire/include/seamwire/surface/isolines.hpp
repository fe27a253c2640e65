// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "seamwire/api.hpp"
#include "seamwire/surface/surface.hpp"

namespace seamwire {

/// The curves where a function on a surface has given values, as straight segments across one triangle each.
///
/// Together the segments form closed curves, or curves that end on the boundary and at triangles that are left out.
/// Segments have a length, so a triangle that only touches a curve with a corner has none.
struct Isolines {
  std::vector<std::array<Vector, 2>> segments;  ///< both ends, in the caller's coordinates
  std::vector<std::int32_t> faces;              ///< the caller's triangle of each segment
  std::vector<std::int32_t> levels;             ///< the level of each segment, an index
};

/// Find the isolines of a function that is linear on each triangle.
///
/// A vertex exactly at a level counts as above it. The higher values lie to the left of a segment, seen from where its
/// triangle is counterclockwise.
///
/// \param surface the surface
/// \param values one for each of the caller's vertices. An infinite value leaves out the triangles around its vertex.
/// \param levels finite, ascending
/// \returns the segments of all levels
/// \throws InvalidInput if there is not one value for each vertex, or a value is not a number
/// \throws InvalidInput if the levels are not finite and ascending
SEAMWIRE_API Isolines isolines(const Surface& surface, std::span<const double> values, std::span<const double> levels);

}  // namespace seamwire
