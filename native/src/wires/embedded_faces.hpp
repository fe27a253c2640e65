// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "seamwire/embedding/embedding.hpp"
#include "seamwire/geodesics/distance_field.hpp"
#include "seamwire/geodesics/exact_geodesics.hpp"
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
  /// A path of geodesics() on the surface; without points if the path has none.
  Wire wire(IntrinsicPath path) const;

 private:
  std::int32_t compact(std::int32_t vertex) const;

  std::shared_ptr<const Surface> surface_;
  std::shared_ptr<const Embedding> embedding_;
  EmbeddedPoints points_;
  std::vector<std::int32_t> vertices_;  ///< for each vertex of geodesics(), ascending: its number in the embedding
  std::optional<ExactGeodesics> geodesics_;
};

}  // namespace seamwire::detail
