// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <optional>

#include "detail/computed_once.hpp"
#include "seamwire/context/embedded_surface.hpp"

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
  detail::ComputedOnce<EmbeddedPoints> points;
};

}  // namespace seamwire
