// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <vector>

#include "seamwire/api.hpp"
#include "seamwire/surface/intrinsic_mesh.hpp"
#include "seamwire/surface/surface_point.hpp"
#include "seamwire/task.hpp"

namespace seamwire {

/// A point that a geodesic passes: a vertex, a point on an edge, or, at its ends, a point within a face. One of
/// `vertex`, `half_edge` and `face` is not -1.
struct PathPoint {
  std::int32_t vertex = -1;             ///< -1: no vertex
  std::int32_t half_edge = -1;          ///< -1: not on an edge
  double t = 0.0;                       ///< 0 at the tail of the half-edge, 1 at its tip
  std::int32_t face = -1;               ///< -1: not within a face
  std::array<double, 3> barycentric{};  ///< in `face`
};

/// A geodesic over an IntrinsicMesh, from a source to a target: straight in each triangle.
struct IntrinsicPath {
  std::vector<PathPoint> points;    ///< empty where the target is unreachable; one point where it is the source
  std::vector<std::int32_t> faces;  ///< the triangle each segment crosses or bounds; -1 along a loose edge
  double length = std::numeric_limits<double>::infinity();  ///< sum of the segments' lengths
};

/// Counts the work of a solve. The counts are the same for the same input on every machine.
struct GeodesicCounters {
  std::size_t lists = 0;    ///< window lists propagated
  std::size_t windows = 0;  ///< windows propagated
};

/// Distances from a seed, or from the nearest of several sources, to every point of an IntrinsicMesh. It also traces
/// the paths. ExactGeodesics makes exact fields, and fields from a bounded number of windows. Immutable; copies share
/// the data.
class SEAMWIRE_API DistanceField {
 public:
  std::int32_t seed() const;  ///< the vertex that distances are from; -1: several, or another point
  /// What distances are from, as given.
  const std::vector<SurfacePoint>& sources() const;
  bool is_exact() const;                     ///< or from a bounded number of windows
  const GeodesicCounters& counters() const;  ///< the work that it took
  /// Distances beyond it are given as infinite: that at which the solve stopped, or infinity.
  double radius() const;
  /// Whether the field may be one over a mesh, as far as the numbers of vertices and triangles tell.
  bool fits(const IntrinsicMesh& mesh) const;
  /// Stands for the mesh: the same for all fields of one ExactGeodesics and its copies, and for no other field.
  std::weak_ptr<const void> mesh() const;
  /// One a vertex; infinite where no path leads. Where the field is not exact they may be too long or too short.
  const std::vector<double>& distances() const;

  /// The shortest path from the seed to a vertex, in time proportional to the triangles it crosses. Its length is the
  /// distance to rounding (1e-9 of it in the tests). If the field is not exact, it is still a real path, with its true
  /// length. It is the shortest path within the triangles around the path that the field tells. It may be longer than
  /// the geodesic, but not shorter.
  ///
  /// Throws InvalidInput for a vertex out of range; Cancelled, where the path takes long.
  IntrinsicPath trace(std::int32_t vertex, const Task& task = {}) const;

  /// The distance of any point: exact too, not interpolated from the vertices; in time about proportional to the
  /// triangles that the path crosses. Where the field is not exact, the length of trace(). Infinite where no path
  /// leads, or beyond radius().
  ///
  /// Throws InvalidInput for a vertex or a face out of range, and for barycentric coordinates that are not finite, less
  /// than 0, or whose sum is not 1; Cancelled.
  double distance(const SurfacePoint& point, const Task& task = {}) const;
  /// The shortest path from the source nearest to a point to that point, as to a vertex. Throws as distance().
  IntrinsicPath trace(const SurfacePoint& point, const Task& task = {}) const;

 private:
  friend class ExactGeodesics;  // which makes them
  struct Data;
  explicit DistanceField(std::shared_ptr<const Data> data);

  std::shared_ptr<const Data> data_;
};

}  // namespace seamwire
