// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "seamwire/api.hpp"
#include "seamwire/embedding/embedding.hpp"
#include "seamwire/surface/surface.hpp"
#include "seamwire/surface/surface_point.hpp"

namespace seamwire {

/// Finds points of the caller's faces on an embedding of the surface, whose triangles are parts of these faces.
///
/// Several threads may use it at once.
class SEAMWIRE_API EmbeddedPoints {
 public:
  /// Prepare the search, in time proportional to the size of the embedding.
  ///
  /// \param surface the surface, not null
  /// \param embedding an embedding of the surface, not null
  /// \throws InvalidInput if an argument is null, or the embedding is of another surface, as far as its faces and
  ///   points tell
  EmbeddedPoints(std::shared_ptr<const Surface> surface, std::shared_ptr<const Embedding> embedding);
  ~EmbeddedPoints();
  EmbeddedPoints(EmbeddedPoints&&) noexcept;             ///< the other object may then only be destroyed or assigned to
  EmbeddedPoints& operator=(EmbeddedPoints&&) noexcept;  ///< the other object may then only be destroyed or assigned to

  /// Find a point of the surface on the embedding.
  ///
  /// A point on an edge of the surface is on an edge of the embedding. Vertices keep their numbers. The time is
  /// proportional to the number of triangles in its face.
  ///
  /// \param point a point of the surface
  /// \param what the name of the point, with which error messages begin
  /// \returns the same point as one of the embedding. nullopt if the embedding has a hole there, or the face has no
  ///   area.
  /// \throws InvalidInput if a vertex or a face is out of range
  /// \throws InvalidInput if barycentric coordinates are not finite, or below 0, or their sum is not 1
  std::optional<SurfacePoint> find(const SurfacePoint& point, const std::string& what = "point") const;

 private:
  struct Impl;
  std::unique_ptr<const Impl> impl_;
};

}  // namespace seamwire
