// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>
#include <vector>

#include "maps/cut_open.hpp"
#include "maps/island_map.hpp"
#include "seamwire/surface/vector.hpp"

namespace seamwire::detail {

/// The corners of the convex hull, counter-clockwise (Andrew 1979).
std::vector<Point2> convex_hull(std::vector<Point2> points);

/// The direction of the longer side of the smallest rectangle around points. The rectangle has a side along an edge of
/// the convex hull. Zero if the points have no area.
Point2 longest_direction(const std::vector<Point2>& points);

/// Turns the map of an island such that the direction `up` of the model points to +v: the mean of its projection to
/// the surface. If the island has no such direction, the smallest rectangle around the map is turned instead: its sides
/// run along the axes, and the longer side along v.
///
/// `is_straight`: the map's rows run along the axes, and stay so. Then the map is turned by a multiple of 90 degrees.
/// So is a map in which any other turn would flip a triangle by rounding.
void turn_upright(const Island& island, std::span<const Vector> points, const Vector& up, bool is_straight,
                  std::vector<Point2>& map);

/// Turns a map by the multiple of 90 degrees that brings it nearest to another map of the same vertices. The center of
/// `map` is the origin.
void turn_by_quarters(const std::vector<Point2>& other, std::vector<Point2>& map);

}  // namespace seamwire::detail
