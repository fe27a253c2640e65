// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "seamwire/api.hpp"
#include "seamwire/surface/types.hpp"
#include "seamwire/surface/vector.hpp"

namespace seamwire {

class UnwrapMesh;
namespace detail {
struct StraightCorners;  // in src/parameterization/straight_corners.hpp
const StraightCorners& straight_corners(const UnwrapMesh& mesh);
}  // namespace detail

/// The polygons of a mesh, whose corners have UVs. Corners are numbered polygon by polygon.
struct UnwrapArrays {
  std::vector<Vector> points;
  std::vector<std::int32_t> vertices;  ///< per corner
  std::vector<std::int32_t> edges;     ///< per corner: the edge to the next corner of its polygon
  std::vector<std::int32_t> sizes;     ///< per polygon: its number of corners
  std::vector<Triangle> triangles;     ///< corners: how polygons are drawn
  std::vector<std::int32_t> islands;   ///< per polygon: its island, from 0, or -1 if it is hidden
  std::vector<std::uint8_t> seams;     ///< per edge: whether it is a seam
};

/// Polygons with their islands. Immutable.
///
/// A vertex in the middle of a straight side of two polygons may be in a triangle without area on both sides. No map
/// has both triangles the right way around. Maps are made without such a vertex. Then it is put on the straight line
/// between its neighbors.
class SEAMWIRE_API UnwrapMesh {
 public:
  /// Build it.
  ///
  /// \param arrays the polygons
  /// \throws InvalidInput if arrays do not fit together, or a coordinate is not finite
  explicit UnwrapMesh(UnwrapArrays arrays);

  /// Return the polygons.
  const UnwrapArrays& arrays() const { return arrays_; }
  /// Return how many corners there are.
  std::size_t corner_count() const { return arrays_.vertices.size(); }
  /// Return one more than the largest number of an island.
  std::size_t island_count() const { return island_count_; }
  /// Return the polygon of a corner.
  ///
  /// \param corner the corner
  std::int32_t polygon(std::int32_t corner) const { return polygons_[static_cast<std::size_t>(corner)]; }
  /// Return the island of a corner, -1 if its polygon is hidden.
  ///
  /// \param corner the corner
  std::int32_t island(std::int32_t corner) const { return arrays_.islands[static_cast<std::size_t>(polygon(corner))]; }
  /// Return the next corner of the same polygon.
  ///
  /// \param corner the corner
  std::int32_t following(std::int32_t corner) const { return following_[static_cast<std::size_t>(corner)]; }
  /// Return the corner before in the same polygon.
  ///
  /// \param corner the corner
  std::int32_t preceding(std::int32_t corner) const { return preceding_[static_cast<std::size_t>(corner)]; }

 private:
  friend const detail::StraightCorners& detail::straight_corners(const UnwrapMesh& mesh);

  UnwrapArrays arrays_;
  std::vector<std::int32_t> polygons_, following_, preceding_;  // per corner
  std::size_t island_count_ = 0;
  std::shared_ptr<const detail::StraightCorners> straight_;
};

}  // namespace seamwire
