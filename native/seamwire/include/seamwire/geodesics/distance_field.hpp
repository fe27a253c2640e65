// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <vector>

#include "seamwire/api.hpp"
#include "seamwire/surface/intrinsic_mesh.hpp"
#include "seamwire/surface/surface_point.hpp"
#include "seamwire/task.hpp"

namespace seamwire {

/// A point that a geodesic passes: a vertex, a point on an edge, or, at its ends, a point inside a face.
///
/// Exactly one of `vertex`, `half_edge` and `face` is set.
struct PathPoint {
  std::int32_t vertex = -1;             ///< -1 if the point is not a vertex
  std::int32_t half_edge = -1;          ///< -1 if the point is not on an edge
  double t = 0.0;                       ///< in [0, 1]: 0 at the tail of the half-edge, 1 at its tip
  std::int32_t face = -1;               ///< -1 if the point is not inside a face
  std::array<double, 3> barycentric{};  ///< in `face`
};

/// A path over an IntrinsicMesh, from a source to a target. It is straight in each triangle.
struct IntrinsicPath {
  std::vector<PathPoint> points;    ///< one point if the target is the source
  std::vector<std::int32_t> faces;  ///< the triangle that each segment crosses or bounds; -1 along a loose edge
  double length = std::numeric_limits<double>::infinity();  ///< sum of the lengths of the segments
};

/// The result of a method for distances, from which a DistanceField is made.
///
/// A method derives its own class from it, sets the members and implements the functions. Several threads may call the
/// functions at once.
class SEAMWIRE_API SolvedField {
 public:
  std::vector<SurfacePoint> sources;  ///< the points that distances start from, as given
  std::vector<double> distances;      ///< per vertex: 0 or more, infinite if no path leads there or beyond `radius`
  double radius = std::numeric_limits<double>::infinity();  ///< the distance at which the solve stopped
  std::size_t face_count = 0;                               ///< the number of triangles of the mesh
  std::shared_ptr<const void> mesh;                         ///< identifies the mesh: see DistanceField::mesh_id()

  virtual ~SolvedField();
  /// Compute the distance of any point, as DistanceField::distance() promises.
  ///
  /// \param point a point of the mesh, not yet checked
  virtual double distance(const SurfacePoint& point, const Task& task) const = 0;
  /// Trace the path to any point, as DistanceField::trace() promises.
  ///
  /// \param point a point of the mesh, not yet checked
  virtual std::optional<IntrinsicPath> trace(const SurfacePoint& point, const Task& task) const = 0;

 protected:
  SolvedField() = default;
  SolvedField(const SolvedField&) = default;
  SolvedField(SolvedField&&) = default;
  SolvedField& operator=(const SolvedField&) = default;
  SolvedField& operator=(SolvedField&&) = default;
};

/// Distances from a seed, or from the nearest of several sources, to every point of an IntrinsicMesh.
///
/// It also traces the paths. A DistanceMethod makes it, and determines whether distances are exact. Immutable. Copies
/// share the data.
class SEAMWIRE_API DistanceField {
 public:
  /// Make a field of what a method has solved.
  ///
  /// \param solved the result of the method, not null
  /// \throws InvalidInput if `solved` is null
  explicit DistanceField(std::shared_ptr<const SolvedField> solved);

  /// Return the vertex that distances start from, -1 if there are several sources or the source is not a vertex.
  std::int32_t seed() const;
  /// Return the points that distances start from, as given.
  const std::vector<SurfacePoint>& sources() const { return solved_->sources; }
  /// Return the distance at which the solve stopped, or infinity. Larger distances are infinite.
  double radius() const { return solved_->radius; }
  /// Return whether a mesh has as many vertices and triangles as the field's mesh.
  ///
  /// \param mesh the mesh
  bool fits(const IntrinsicMesh& mesh) const;
  /// Return a handle that identifies the mesh. All fields of one DistanceMethod and its copies have the same handle,
  /// and no other field has it.
  std::weak_ptr<const void> mesh_id() const { return solved_->mesh; }
  /// Return the distance of each vertex in the unit of the mesh's lengths, infinite if no path leads there.
  const std::vector<double>& distances() const { return solved_->distances; }

  /// Compute the distance of any point.
  ///
  /// ExactGeodesics computes it exactly, and does not interpolate it from the vertices.
  ///
  /// \param point a point of the mesh
  /// \returns the distance, infinite if no path leads there or it is beyond radius()
  /// \throws InvalidInput if the vertex or the face is out of range
  /// \throws InvalidInput if barycentric coordinates are not finite, or below 0, or their sum is not 1
  double distance(const SurfacePoint& point, const Task& = {}) const;
  /// Trace the path from the nearest source to any point.
  ///
  /// The path of ExactGeodesics is the shortest one, and its length is the distance, up to rounding. Tracing takes time
  /// about proportional to the number of triangles that the path crosses.
  ///
  /// \param point a point of the mesh
  /// \returns the path, or nullopt if the point is unreachable or beyond radius()
  /// \throws InvalidInput if distance() rejects the point
  std::optional<IntrinsicPath> trace(const SurfacePoint& point, const Task& = {}) const;

 protected:
  /// Return what the method has solved.
  const SolvedField& solved() const { return *solved_; }

 private:
  std::shared_ptr<const SolvedField> solved_;
};

}  // namespace seamwire
