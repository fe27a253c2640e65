// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "seamwire_uv/maps/measure_map.hpp"
#include "seamwire_uv/maps/unwrap_mesh.hpp"

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

/// Throws InvalidInput unless there is an item for each corner or island.
void check_corners(const UnwrapMesh& mesh, const std::vector<Eigen::Vector2d>& uvs);
void check_islands(const UnwrapMesh& mesh, const std::vector<std::uint8_t>& flags);

/// The edges of the visible polygons of chosen islands, as pairs of vertices.
std::vector<Edge> edges_of(const UnwrapMesh& mesh, const std::vector<std::uint8_t>& is_chosen, bool only_seams = false);

/// The islands of a map that overlap themselves or others, without triangles that cover nothing. Throws Cancelled.
std::vector<std::int32_t> overlapping_islands(const UnwrapMesh& mesh, const std::vector<Eigen::Vector2d>& uvs,
                                              const Task& task);

using Corners2 = std::array<Eigen::Vector2d, 3>;

inline Corners2 uvs_of(const Triangle& t, const std::vector<Eigen::Vector2d>& uvs) {
  return {uvs[t[0]], uvs[t[1]], uvs[t[2]]};
}

inline bool is_placed(const Corners2& uvs) { return uvs[0].allFinite() && uvs[1].allFinite() && uvs[2].allFinite(); }

/// Twice the area, negative if the corners go clockwise.
inline double doubled_area(const Corners2& uvs) {
  const Eigen::Vector2d a = uvs[1] - uvs[0], b = uvs[2] - uvs[0];
  return a.x() * b.y() - a.y() * b.x();
}

inline const Vector& point_of(const UnwrapMesh& mesh, std::int32_t corner) {
  return mesh.points[mesh.vertices[corner]];
}

/// Twice the area of a triangle on the model.
inline double doubled_area(const UnwrapMesh& mesh, const Triangle& t) {
  const Vector& a = point_of(mesh, t[0]);
  return (point_of(mesh, t[1]) - a).cross(point_of(mesh, t[2]) - a).norm();
}

}  // namespace seamwire::detail
