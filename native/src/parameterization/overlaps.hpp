// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include "seamwire/parameterization/map_faults.hpp"

namespace seamwire::detail {

/// Some triangles of a map, measured.
struct Overlaps {
  std::vector<std::int32_t> flipped;      // triangles
  std::vector<std::int32_t> overlapping;  // islands that overlap themselves or others
  bool is_measured = false;               // whether any triangle was
};

/// Measures those of some triangles whose UVs are finite. Throws Cancelled.
Overlaps find_overlaps(const MappedTriangles& map, const std::vector<std::uint8_t>& is_shown, const Task& task);

inline bool is_placed(const std::array<Eigen::Vector2d, 3>& uvs) {
  return uvs[0].allFinite() && uvs[1].allFinite() && uvs[2].allFinite();
}

/// Twice the area, negative if the corners go clockwise.
inline double doubled_area(const std::array<Eigen::Vector2d, 3>& uvs) {
  const Eigen::Vector2d a = uvs[1] - uvs[0], b = uvs[2] - uvs[0];
  return a.x() * b.y() - a.y() * b.x();
}

inline double longest_side(const std::array<Eigen::Vector2d, 3>& uvs) {
  return std::max({(uvs[1] - uvs[0]).norm(), (uvs[2] - uvs[1]).norm(), (uvs[0] - uvs[2]).norm()});
}

inline std::array<Eigen::Vector2d, 3> uvs_of(const Triangle& t, const std::vector<Eigen::Vector2d>& uvs) {
  return {uvs[t[0]], uvs[t[1]], uvs[t[2]]};
}

/// Throws InvalidInput unless there is a UV for each corner.
void check_uvs(const UnwrapMesh& mesh, const std::vector<Eigen::Vector2d>& uvs);

/// Some triangles of a mesh in a map.
MappedTriangles mapped_triangles(const UnwrapMesh& mesh, const std::vector<Eigen::Vector2d>& uvs,
                                 const std::vector<std::int32_t>& rows);

/// How far a UV may lie beside a line that it should lie on, because UVs are rounded.
inline constexpr double kOnLine = 1e-6;

/// The edges of the visible polygons of some islands, as pairs of vertices. Empty `is_chosen`: of all.
std::vector<Edge> visible_edges(const UnwrapMesh& mesh, const std::vector<std::uint8_t>& is_chosen = {});

}  // namespace seamwire::detail
