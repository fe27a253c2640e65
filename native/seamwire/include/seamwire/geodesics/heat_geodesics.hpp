// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <span>

#include "seamwire/api.hpp"
#include "seamwire/geodesics/distance_field.hpp"
#include "seamwire/geodesics/distance_method.hpp"
#include "seamwire/surface/intrinsic_mesh.hpp"
#include "seamwire/surface/surface_point.hpp"
#include "seamwire/task.hpp"

namespace seamwire {

/// Computes approximate distances on one mesh with the heat method, from edge lengths alone.
///
/// The constructor factors two matrices. Each solve then takes about the same time, wherever the seeds are. The error
/// is of the order of the mean edge length. docs/benchmarks/exactness.md has numbers.
///
/// - Heat flows over intrinsic Delaunay triangles, which the constructor makes by flipping edges. Vertices stay.
/// - The distance of a point in a face is interpolated from the corners of the face. On the face of a source it is the
///   straight one, or the smaller one of both if there are several sources.
/// - Paths descend the distance, and are then shortened. They are real paths with their true length, which is not the
///   distance. They are the shortest ones in the triangles around them, and never shorter than the geodesic. The first
///   path prepares more.
/// - SolveOptions::targets do not shorten a solve. Beyond SolveOptions::max_distance, distances are infinite.
///
/// Copies share the matrices.
///
/// \see Crane, Weischedel and Wardetzky 2013, "Geodesics in Heat", for the method
/// \see Sharp, Soliman and Crane 2019, "Navigating Intrinsic Triangulations", for the use of intrinsic triangles
class SEAMWIRE_API HeatGeodesics final : public DistanceMethod {
 public:
  /// Prepare a mesh.
  ///
  /// \param mesh a mesh that ExactGeodesics accepts
  /// \throws InvalidInput if the constructor of ExactGeodesics rejects the mesh, the mesh has too many
  ///   triangles, or its lengths differ too much for the matrices
  explicit HeatGeodesics(const IntrinsicMesh& mesh, const Task& = {});

 private:
  struct Prepared;
  class Solved;
  DistanceField solve_checked(std::span<const SurfacePoint> sources, const SolveOptions& options,
                              const Task& task) const override;

  std::shared_ptr<const Prepared> prepared_;
};

}  // namespace seamwire
