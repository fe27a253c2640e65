// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <vector>

#include "detail/computed_once.hpp"
#include "detail/thread_safety.hpp"
#include "seamwire/context/embedded_surface.hpp"
#include "seamwire/context/surface_context.hpp"

namespace seamwire {

struct EmbeddedSurface::Data {
  /// Throws InvalidInput if there is no metric; what SurfaceContext::surface() throws.
  Data(const SurfaceContext& of, std::shared_ptr<const Metric> in, const EmbedOptions& with, const Task& task);

  const SurfaceContext context;
  const std::shared_ptr<const Surface> surface;
  const std::shared_ptr<const Metric> metric;
  const EmbedOptions options;
  std::optional<MetricSpec> spec;              // set before others know of this
  std::shared_ptr<const Embedding> embedding;  // set before others know of this
  detail::ComputedOnce<ExactGeodesics> geodesics;
  detail::ComputedOnce<HeatGeodesics> heat;
  detail::ComputedOnce<EmbeddedPoints> points;
};

namespace detail {
/// The surface in the metric of a spec, filed in the context under that spec. `metric` must be make_metric() of it.
/// Throws what the constructor of EmbeddedSurface throws.
EmbeddedSurface embedded_in(const SurfaceContext& context, const MetricSpec& spec, std::shared_ptr<const Metric> metric,
                            const EmbedOptions& options, const Task& task);
}  // namespace detail

struct SurfaceContext::Data {
  /// The arguments of Surface's constructor.
  struct Input {
    std::vector<Vector> points;
    std::vector<Triangle> triangles;
    std::optional<std::vector<Edge>> edges;
  };
  struct Curvatures {
    Curvature curvature;
    std::vector<double> difference;
  };

  Data(std::size_t vertices, std::size_t faces) : vertex_count(vertices), face_count(faces) {}

  std::shared_ptr<const Curvatures> curvatures(const SurfaceContext& context, const Task& task);

  const std::size_t vertex_count, face_count;
  std::optional<Input> input;  // until the surface is built; only the thread that builds it looks at it
  detail::ComputedOnce<std::shared_ptr<const Surface>> surface;
  detail::ComputedOnce<Curvatures> made_curvatures;
  detail::ComputedOnce<Curvature> smoothed_curvature;
  detail::ComputedOnce<std::shared_ptr<const EdgeAdjacency>> edge_adjacency;

  detail::Mutex mutex;
  std::vector<std::weak_ptr<EmbeddedSurface::Data>> embedded SEAMWIRE_GUARDED_BY(mutex);  // of specs
};

}  // namespace seamwire
