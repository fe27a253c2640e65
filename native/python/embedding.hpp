// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "detail/computed_once.hpp"
#include "seamwire/context/embedded_surface.hpp"
#include "seamwire/embedding/embedding.hpp"
#include "seamwire/geodesics/exact_geodesics.hpp"
#include "seamwire/geodesics/heat_geodesics.hpp"
#include "seamwire/surface/surface.hpp"
#include "seamwire/surface/surface_point.hpp"
#include "seamwire/task.hpp"

namespace seamwire::python {

/// An embedding, with what is built from it once, when it is first needed. Call all members without the GIL.
struct EmbeddingObject {
  /// Each edge once, as its two vertices and its length.
  struct Edges {
    std::vector<Edge> vertices;
    std::vector<double> lengths;
  };

  explicit EmbeddingObject(EmbeddedSurface made)
      : embedded(std::move(made)), surface(embedded.context().peek_surface()), embedding(embedded.embedding()) {}

  const ExactGeodesics& geodesics(const Task& task) const { return embedded.geodesics(task); }
  const HeatGeodesics& heat_geodesics(const Task& task) const { return embedded.heat_geodesics(task); }
  const Edges& edges() const;

  /// Finds a point of the surface on the embedding. Throws InvalidInput, which begins with `name`, if the embedding has
  /// a hole there.
  SurfacePoint find(const SurfacePoint& point, const std::string& name) const { return embedded.locate(point, name); }
  /// Returns a copy with other lengths of edges(). Throws InvalidInput if they make no triangles.
  std::shared_ptr<EmbeddingObject> with_lengths(const std::vector<double>& lengths) const;

  EmbeddedSurface embedded;
  std::shared_ptr<const Surface> surface;
  const Embedding& embedding;

 private:
  mutable detail::ComputedOnce<Edges> edges_;
};

}  // namespace seamwire::python
