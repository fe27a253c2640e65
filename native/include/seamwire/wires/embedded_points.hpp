// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "seamwire/api.hpp"
#include "seamwire/embedding/embedding.hpp"
#include "seamwire/surface/surface.hpp"
#include "seamwire/surface/surface_point.hpp"

namespace seamwire {

/// Finds points of the caller's faces on an embedding of the surface, whose triangles are parts of them. Several
/// threads may ask at once.
class SEAMWIRE_API EmbeddedPoints {
 public:
  /// Takes time proportional to the embedding. Throws InvalidInput where the embedding is not one of the surface, as
  /// far as its faces tell.
  EmbeddedPoints(std::shared_ptr<const Surface> surface, std::shared_ptr<const Embedding> embedding);
  ~EmbeddedPoints();
  EmbeddedPoints(EmbeddedPoints&&) noexcept;             ///< leaves one that may only be destroyed
  EmbeddedPoints& operator=(EmbeddedPoints&&) noexcept;  ///< as moving

  /// The same point as one of the embedding, in time proportional to the parts of its face. A point on an edge of the
  /// surface is on an edge of the embedding. Vertices keep their numbers. Nothing where the embedding has a hole, or
  /// the face no area.
  ///
  /// Throws InvalidInput, which begins with `what`, for a vertex or a face out of range, and for barycentric
  /// coordinates that are not finite, less than 0, or whose sum is not 1.
  std::optional<SurfacePoint> find(const SurfacePoint& point, const std::string& what = "point") const;

 private:
  struct Impl;
  std::unique_ptr<const Impl> impl_;
};

}  // namespace seamwire
