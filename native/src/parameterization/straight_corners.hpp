// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "seamwire/parameterization/unwrap_mesh.hpp"

namespace seamwire::detail {

/// Corners of polygons that are left out of a map.
struct StraightCorners {
  /// A corner between two others that stay in the map.
  struct LeftOut {
    std::int32_t corner;
    std::array<std::int32_t, 2> ends;  // the next corners on both sides that stay
    double share;                      // where it lies between the ends, from 0 to 1
    bool is_cut;                       // whether all edges between the ends are seams
  };
  std::vector<LeftOut> left_out;
  std::vector<std::int32_t> onto;   // per corner: the end that replaces it, or itself
  std::vector<std::uint8_t> stays;  // per corner: whether it is straight, but has a triangle with an area

  Triangle without(const Triangle& t) const { return {onto[t[0]], onto[t[1]], onto[t[2]]}; }
  /// Whether a triangle has a corner twice without the corners that are left out.
  bool vanishes(const Triangle& triangle) const {
    const auto [a, b, c] = without(triangle);
    return a == b || b == c || c == a;
  }
};

StraightCorners find_straight_corners(const UnwrapMesh& mesh);

/// The triangles from which a map is made: without the corners that are left out, and convex at other straight corners.
/// There the face gets the flat triangle of the corner and its neighbors. A map that has this triangle the right way
/// around has all triangles right into which the face may be cut there.
std::vector<Triangle> triangles_to_map(const UnwrapMesh& mesh, std::span<const Triangle> triangles);

inline const Vector& point_of(const UnwrapMesh& mesh, std::int32_t corner) {
  return mesh.arrays().points[mesh.arrays().vertices[corner]];
}

/// Twice the area of a triangle on the model.
inline double doubled_area(const UnwrapMesh& mesh, const Triangle& t) {
  const Vector& a = point_of(mesh, t[0]);
  return (point_of(mesh, t[1]) - a).cross(point_of(mesh, t[2]) - a).norm();
}

}  // namespace seamwire::detail
