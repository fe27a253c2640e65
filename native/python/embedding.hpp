// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "lazy.hpp"
#include "seamwire/embedding/embedding.hpp"
#include "seamwire/geodesics/exact_geodesics.hpp"
#include "seamwire/surface/surface.hpp"
#include "seamwire/surface/surface_point.hpp"
#include "seamwire/task.hpp"
#include "seamwire/wires/embedded_points.hpp"

namespace seamwire::python {

/// An embedding, with what is built from it once, when it is first needed. Call all members without the GIL.
struct EmbeddingObject {
  /// Each edge once, as its two vertices and its length.
  struct Edges {
    std::vector<Edge> vertices;
    std::vector<double> lengths;
  };

  EmbeddingObject(std::shared_ptr<const Surface> of, Embedding computed)
      : surface(std::move(of)), embedding(std::move(computed)) {}

  const ExactGeodesics& geodesics(const Task& task) const;
  const EmbeddedPoints& points() const;
  const Edges& edges() const;

  /// Finds a point of the surface on the embedding. Throws InvalidInput, which begins with `name`, if the embedding has
  /// a hole there.
  SurfacePoint find(const SurfacePoint& point, const std::string& name) const;
  /// Returns a copy with other lengths of edges(). Throws InvalidInput if they make no triangles.
  std::shared_ptr<EmbeddingObject> with_lengths(const std::vector<double>& lengths) const;

  std::shared_ptr<const Surface> surface;
  Embedding embedding;

 private:
  Lazy<ExactGeodesics> geodesics_;
  Lazy<Edges> edges_;
  Lazy<EmbeddedPoints> points_;
};

}  // namespace seamwire::python
