// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <vector>

#include "detail/infinity.hpp"
#include "seamwire/geodesics/corridor_paths.hpp"
#include "seamwire/metric/metric.hpp"
#include "seamwire/surface/surface.hpp"
#include "seamwire/surface/surface_point.hpp"
#include "seamwire/task.hpp"
#include "seamwire/wires/wire.hpp"
#include "wires/embedded_faces.hpp"

namespace seamwire::detail {

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

}  // namespace seamwire::detail
