// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace seamwire::detail {

/// Which vertex or edge a curve's point is on, as part of a triangle's longest side: stored curves are rounded.
inline constexpr double kOn = 1e-4;

/// How far from the mesh a curve's points may be, as part of the longest side of the triangle beside. Mirror images of
/// curves are off if the halves of a mesh are cut into other triangles. So are the curves of slid wires. The cuts lie
/// on the mesh all the same.
inline constexpr double kOff = 0.25;

/// A polygon's side has no length below this part of its longest one. Two sides lie on each other below this sine of
/// the angle between them. A triangle has no area below this part of the square of its longest side.
inline constexpr double kFlat = 1e-3;

/// The least cosine between the normal of a triangle and the direction along which its polygon is seen.
inline constexpr double kSide = 0.05;

/// The part of its length by which a cut may leave the straight line within a polygon and be straight.
inline constexpr double kBend = 0.1;

/// Two cuts that part and meet again are merged if they are nowhere farther apart than this fraction of the heights of
/// the triangles that they cross. Otherwise curves that run side by side would enclose tiny islands.
inline constexpr double kWide = 0.25;

}  // namespace seamwire::detail
