// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>

#include "seamwire/api.hpp"
#include "seamwire/geodesics/exact_geodesics.hpp"
#include "seamwire/surface/surface_point.hpp"
#include "seamwire/task.hpp"

namespace seamwire {

/// Limits of the search for a path.
struct CorridorPathOptions {
  /// Number of vertices in the corridor that is searched for a path. 0: 1000 + 8 sqrt(number of vertices).
  std::size_t corridor_vertices = 0;
  /// How many windows of a list are propagated in the corridor. They are those around the shortest way to the apex,
  /// stretched over the part that the others covered. 0 propagates all, which finds the shortest path in the corridor.
  std::uint32_t windows = 8;
};

/// Finds paths from one seed to any point, without a DistanceField.
///
/// Each path is a real path over the surface, with its true length. It is locally shortest in a corridor of triangles
/// around the shortest chains of edges. So it is never shorter than the geodesic, and mostly it is the geodesic. The
/// result does not depend on earlier calls.
///
/// Distances along edges are computed outwards from the seed, only as far as the targets need them, and kept. Only one
/// thread at a time may use an object. Several objects may share an ExactGeodesics.
class SEAMWIRE_API CorridorPaths {
 public:
  /// Prepare paths from any point.
  ///
  /// \param geodesics the solver of the mesh
  /// \param seed a point of the mesh
  /// \param options limits of the search
  /// \throws InvalidInput if DistanceField::distance() rejects the seed
  CorridorPaths(const ExactGeodesics& geodesics, const SurfacePoint& seed, const CorridorPathOptions& options = {});
  ~CorridorPaths();
  CorridorPaths(CorridorPaths&&) noexcept;             ///< the other object may then only be destroyed or assigned to
  CorridorPaths& operator=(CorridorPaths&&) noexcept;  ///< the other object may then only be destroyed or assigned to

  /// Return the vertex where paths begin, -1 if it is another point.
  std::int32_t seed() const;
  /// Find a path to any point.
  ///
  /// After a cancellation, the object is still usable.
  ///
  /// \param target a point of the mesh
  /// \returns a path like those of DistanceField::trace(), or nullopt if the target is unreachable
  /// \throws InvalidInput if DistanceField::distance() rejects the target
  std::optional<IntrinsicPath> path(const SurfacePoint& target, const Task& = {});

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace seamwire
