// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>

#include "seamwire/api.hpp"
#include "seamwire/geodesics/exact_geodesics.hpp"
#include "seamwire/surface/surface_point.hpp"
#include "seamwire/task.hpp"

namespace seamwire {

/// How much is looked at for a path.
struct CorridorPathOptions {
  /// Vertices of the corridor that is searched for a path. 0: 1000, and eight times the root of the mesh's number of
  /// vertices.
  std::size_t corridor_vertices = 0;
  /// Windows of a list that go on within it, as ExactGeodesics::solve()'s; 0: all, which finds the shortest path there.
  std::uint32_t windows = 8;
};

/// Paths from one seed to any point at once, before there is a DistanceField. Each is a real path over the surface,
/// with its true length: a locally shortest one within a corridor of triangles around the shortest chains of edges. So
/// it is never shorter than the geodesic, and mostly is the geodesic. The same for the same input, whatever was asked
/// for before.
///
/// Distances along edges are computed outwards from the seed, only as far as the targets asked for, and kept. One
/// thread at a time; several objects may share an ExactGeodesics.
class SEAMWIRE_API CorridorPaths {
 public:
  /// Throws InvalidInput for a seed out of range.
  CorridorPaths(const ExactGeodesics& geodesics, std::int32_t seed, const CorridorPathOptions& options = {});
  /// From any point. Throws InvalidInput as DistanceField::distance() does.
  CorridorPaths(const ExactGeodesics& geodesics, const SurfacePoint& seed, const CorridorPathOptions& options = {});
  ~CorridorPaths();
  CorridorPaths(CorridorPaths&&) noexcept;             ///< leaves one that may only be destroyed
  CorridorPaths& operator=(CorridorPaths&&) noexcept;  ///< as moving

  std::int32_t seed() const;  ///< the vertex that paths begin at; -1: another point
  /// A path as DistanceField::trace() gives one. Throws InvalidInput for a target out of range; Cancelled, after which
  /// the object can be used as before.
  IntrinsicPath path(std::int32_t target, const Task& task = {});
  /// To any point. Throws InvalidInput as DistanceField::distance() does; Cancelled.
  IntrinsicPath path(const SurfacePoint& target, const Task& task = {});

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace seamwire
