// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "detail/infinity.hpp"
#include "seamwire/embedding/embedding.hpp"
#include "seamwire/geodesics/corridor_paths.hpp"
#include "seamwire/geodesics/distance_field.hpp"
#include "seamwire/geodesics/exact_geodesics.hpp"
#include "seamwire/metric/metric.hpp"
#include "seamwire/surface/surface.hpp"
#include "seamwire/surface/surface_point.hpp"
#include "seamwire/task.hpp"
#include "seamwire/wires/embedded_points.hpp"
#include "seamwire/wires/wire.hpp"

namespace seamwire::detail {

/// An embedding of some faces of a surface (EmbedOptions::faces), with the solver for wires on them.
class EmbeddedFaces {
 public:
  /// Throws Cancelled.
  EmbeddedFaces(std::shared_ptr<const Surface> surface, std::shared_ptr<const Embedding> embedding, const Task& task);

  /// On the embedding's mesh without the vertices that nothing uses.
  const ExactGeodesics& geodesics() const { return *geodesics_; }
  /// A point of the surface as one of geodesics(); nothing if it is not on these faces.
  std::optional<SurfacePoint> find(const SurfacePoint& point) const;
  /// A path of geodesics() as a wire on the surface.
  Wire wire(IntrinsicPath path) const;

 private:
  std::int32_t compact(std::int32_t vertex) const;

  std::shared_ptr<const Surface> surface_;
  std::shared_ptr<const Embedding> embedding_;
  EmbeddedPoints points_;
  std::vector<std::int32_t> vertices_;  ///< for each vertex of geodesics(), ascending: its number in the embedding
  std::optional<ExactGeodesics> geodesics_;
};

/// Finds wires from one seed before the surface is embedded. Only the faces around the seed are, as far as a target is
/// away and a third as far again. So a wire is a real one, but not the shortest one if that leaves these faces.
class NearbyWires {
 public:
  /// The seed must be a point of the surface. `most_faces`: of the surface, that are embedded for a wire.
  NearbyWires(std::shared_ptr<const Surface> surface, std::shared_ptr<const Metric> metric, const SurfacePoint& seed,
              std::size_t most_faces);

  /// The wire to a point of the surface; nothing if it would take too many faces, or no wire leads there. Throws what
  /// embed() throws; Cancelled.
  std::optional<Wire> wire(const SurfacePoint& target, const Task& task);

 private:
  void embed_within(double radius, const Task& task);
  std::vector<std::int32_t> faces_within(double radius, const Task& task) const;
  Vector place(const SurfacePoint& point) const;

  std::shared_ptr<const Surface> surface_;
  std::shared_ptr<const Metric> metric_;
  SurfacePoint seed_;
  std::size_t most_faces_;
  double radius_ = 0.0;         ///< of the embedded faces around the seed, in the caller's coordinates
  double too_far_ = kInfinity;  ///< a radius for which faces could not be embedded
  std::optional<EmbeddedFaces> on_;
  std::optional<CorridorPaths> paths_;  ///< nullopt if the seed is not on these faces
};

/// How exact a wire is to become.
struct WireRefinement {
  double max_error;         ///< EmbedOptions::max_error, above 0
  double mean_edge_length;  ///< EmbedOptions::mean_edge_length: that of the whole surface in the metric
  int rings = 5;            ///< of faces around the wire, where a better way is looked for
};

/// The shortest wire between the ends of `first` in its corridor: the faces that it crosses and some rings of faces
/// around them, embedded so that they resolve the metric. Measured there, it is not longer than `first`, unless length
/// repair or a hole changes the corridor. Takes time proportional to the corridor, but for copying the surface's
/// points.
///
/// `from` and `to` are the ends on the surface. Nothing if `first` crosses no face, all triangles of its corridor
/// resolve the metric as they are, or its ends are not connected in the corridor. Throws what embed() throws;
/// Cancelled.
std::optional<Wire> refined_wire(const std::shared_ptr<const Surface>& surface, const Metric& metric, const Wire& first,
                                 const SurfacePoint& from, const SurfacePoint& to, const WireRefinement& refinement,
                                 const Task& task);

}  // namespace seamwire::detail
