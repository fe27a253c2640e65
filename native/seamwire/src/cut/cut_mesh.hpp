// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <unordered_map>
#include <vector>

#include "detail/csr.hpp"
#include "seamwire/cut/plan_cuts.hpp"

namespace seamwire::detail {

/// Rows of triangles.
struct Rows {
  std::int32_t first = 0, last = 0;  ///< the last one is not included
};

/// The polygons around vertices, and the corners of polygons.
class CutMesh {
 public:
  /// Throws InvalidInput as plan_cuts() does.
  explicit CutMesh(const TriangulatedPolygons& mesh);

  std::span<const Vector> points() const { return mesh_.points; }
  const Triangle& triangle(std::int32_t row) const { return mesh_.triangles[row]; }
  std::array<Vector, 3> corners_of_triangle(std::int32_t row) const;
  std::int32_t polygon_of(std::int32_t row) const { return mesh_.polygons[row]; }
  std::size_t triangle_count() const { return mesh_.triangles.size(); }

  /// The polygons around a vertex, ascending.
  std::vector<std::int32_t> polygons_at(std::int32_t vertex) const;
  Rows rows_of(std::int32_t polygon) const;
  /// The vertices around a polygon.
  const std::vector<std::int32_t>& corners(std::int32_t polygon) const { return rim(polygon).corners; }
  /// The place of a corner in corners().
  std::size_t place_of_corner(std::int32_t polygon, std::int32_t vertex) const {
    return rim(polygon).places.at(vertex);
  }
  /// Whether an edge joins two corners that follow each other. The same edge may be a diagonal of another polygon.
  bool is_side(std::int32_t polygon, std::int32_t one, std::int32_t other) const;

 private:
  struct Rim {
    std::vector<std::int32_t> corners;
    std::unordered_map<std::int32_t, std::size_t> places;  ///< of each corner
  };
  const Rim& rim(std::int32_t polygon) const;

  TriangulatedPolygons mesh_;
  Csr<std::int32_t> rows_at_;
  mutable std::unordered_map<std::int32_t, Rim> rims_;  ///< of the polygons asked for
};

}  // namespace seamwire::detail
