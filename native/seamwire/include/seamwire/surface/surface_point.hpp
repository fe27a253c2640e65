// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>

namespace seamwire {

/// A point of a triangle mesh: a vertex, or a point of a face with barycentric coordinates.
///
/// Coordinate i belongs to corner i of the face. If one coordinate is exactly 0, the point is on the edge opposite to
/// that corner. If two are 0, the point is the third corner. A coordinate below 2^-53 counts as 0, because adding it to
/// the others does not change their sum.
///
/// A vertex number converts to a point, so functions that take a point take a vertex too.
struct SurfacePoint {
  std::int32_t face = -1;               ///< ignored if `vertex` is set
  std::array<double, 3> barycentric{};  ///< each 0 or more; their sum is 1 within 1e-9, and they are divided by it
  std::int32_t vertex = -1;  ///< a vertex, with or without a face; -1 if the point is given by `face` and `barycentric`

  SurfacePoint() = default;
  /// Make the point of a vertex.
  ///
  /// \param v the vertex
  SurfacePoint(std::int32_t v) : vertex(v) {}
  /// Make a point of a face.
  ///
  /// \param in the face
  /// \param at the barycentric coordinates
  SurfacePoint(std::int32_t in, const std::array<double, 3>& at) : face(in), barycentric(at) {}

  /// Compare the numbers. Points at the same place may have different numbers.
  bool operator==(const SurfacePoint&) const = default;
};

}  // namespace seamwire
