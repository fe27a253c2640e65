// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "geodesics/geodesic_mesh.hpp"
#include "seamwire/geodesics/distance_field.hpp"
#include "seamwire/surface/surface_point.hpp"

namespace seamwire::detail {

/// A position in the frame of a half-edge.
struct Point2 {
  double x, y;
};

inline double norm(const Point2& a) { return std::sqrt(a.x * a.x + a.y * a.y); }
inline double distance(const Point2& a, const Point2& b) { return norm({a.x - b.x, a.y - b.y}); }
inline double cross(const Point2& a, const Point2& b) { return a.x * b.y - a.y * b.x; }

/// From the frame of a half-edge into that of the half-edge entered over the left or the right side.
inline Point2 to_left(const GeodesicMesh::HalfEdge& h, const Point2& p) {
  const double c = h.apex_x / h.left_length, s = h.apex_y / h.left_length;
  return {p.x * c + p.y * s, p.y * c - p.x * s};
}
inline Point2 to_right(const GeodesicMesh::HalfEdge& h, const Point2& p) {
  const double c = (h.length - h.apex_x) / h.right_length, s = -h.apex_y / h.right_length;
  const double x = p.x - h.apex_x, y = p.y - h.apex_y;
  return {x * c + y * s, y * c - x * s};
}

/// Barycentric coordinates in the frame of a half-edge of their face; also differences of such coordinates.
inline Point2 position(const GeodesicMesh& mesh, std::int32_t h, const std::array<double, 3>& weights) {
  const GeodesicMesh::HalfEdge edge = mesh.half_edge(h);
  const double tip = weights[next_in_face(h) % 3], apex = weights[previous_in_face(h) % 3];
  return {tip * edge.length + apex * edge.apex_x, apex * edge.apex_y};
}

/// Barycentric coordinates with the sum 1. Throws InvalidInput, which begins with `what`, if they are invalid.
std::array<double, 3> checked_barycentric(const std::array<double, 3>& barycentric, const std::string& what);

/// A SurfacePoint in internal numbers: a vertex, or a point in one face, or in all faces of an edge. Where faces have
/// no height, in all those whose edges it is on.
struct PlacedPoint {
  struct InFace {
    std::int32_t face;
    std::array<double, 3> weights;
  };

  std::int32_t vertex = -1;   ///< -1: in `faces`
  std::vector<InFace> faces;  ///< empty for a vertex

  static PlacedPoint at_vertex(std::int32_t v) { return {.vertex = v, .faces = {}}; }
  /// A point of one face, and of those on the other side of what edges it is on.
  static PlacedPoint in_face(const GeodesicMesh& mesh, const InFace& first);
  /// Throws InvalidInput, which begins with `what`, for a vertex or a face out of range and for invalid coordinates.
  static PlacedPoint of(const GeodesicMesh& mesh, const SurfacePoint& point, const std::string& what);

  PathPoint path_point() const;

  /// Straight lines within its faces: calls see(h, p, distance) for each corner, the apex of the half-edge h, in whose
  /// frame the point is p.
  template <class See>
  void for_each_corner(const GeodesicMesh& mesh, const See& see) const {
    for (const auto& [face, weights] : faces) {
      for (std::int32_t h = 3 * face; h < 3 * face + 3; ++h) {
        // From the corner, not to it: lengths near it are exact to their own size.
        see(h, position(mesh, h, weights), norm(position(mesh, previous_in_face(h), weights)));
      }
    }
  }
  /// Follows straight lines out of its faces. Calls enter(h, p, left) for each half-edge h over which they enter a next
  /// face. In the frame of h the point is p, below it. The lines leave their face over the half-edge `left`.
  template <class Enter>
  void for_each_exit(const GeodesicMesh& mesh, const Enter& enter) const {
    for (const InFace& in : faces) {
      const std::array<double, 3>& weights = in.weights;
      for (std::int32_t h = 3 * in.face; h < 3 * in.face + 3; ++h) {
        const GeodesicMesh::HalfEdge edge = mesh.half_edge(h);
        const double apex = weights[previous_in_face(h) % 3], y = apex * edge.apex_y;
        if (!(y > 0)) continue;
        mesh.for_each_beyond(h, [&](std::int32_t entered) {
          const double x = mesh.is_mirrored(h, entered)
                               ? weights[next_in_face(h) % 3] * edge.length + apex * edge.apex_x
                               : weights[h % 3] * edge.length + apex * (edge.length - edge.apex_x);
          enter(entered, Point2{x, -y}, h);
        });
      }
    }
  }
};

/// What distances are from: vertices and points in faces, the latter found by their faces.
class SourcePoints {
 public:
  SourcePoints() = default;
  explicit SourcePoints(std::vector<PlacedPoint> points);

  const std::vector<PlacedPoint>& points() const { return points_; }
  const PlacedPoint& operator[](std::int32_t k) const { return points_[static_cast<std::size_t>(k)]; }

  struct InFace {
    std::int32_t face, source;
    std::array<double, 3> weights;
  };
  std::span<const InFace> in_face(std::int32_t face) const;

 private:
  std::vector<PlacedPoint> points_;
  std::vector<InFace> in_faces_;  ///< by their faces
};

}  // namespace seamwire::detail
