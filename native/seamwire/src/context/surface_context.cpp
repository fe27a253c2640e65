// SPDX-License-Identifier: GPL-3.0-or-later
#include "context/surface_context.hpp"

#include <exception>
#include <utility>

#include "detail/poll.hpp"

namespace seamwire {

using namespace detail;

namespace {

/// As a share of the longest side of the box: as concave_metric() is best given curvatures.
constexpr double kSmoothingRadius = 0.01;
/// The maximum anisotropy that goes with a strength of 1 of the concave metric.
constexpr double kAnisotropyOfConcave = 20.0;
/// Of the work for what needs the curvature, or the surface: the part that these take.
constexpr double kBefore = 0.8;
/// Of the work for the curvature: the part that the surface takes.
constexpr double kSurface = 0.5;

/// The parts of a task for what comes first, and for the work itself.
Task first_part(const Task& task) { return part_of(task, 0.0, kBefore); }
Task last_part(const Task& task) { return part_of(task, kBefore, 1.0); }

double concave_strength(const Strength& strength) {
  return strength.parameter ? *strength.parameter : (*strength.max_anisotropy - 1.0) / (kAnisotropyOfConcave - 1.0);
}

}  // namespace

SurfaceContext::SurfaceContext(std::shared_ptr<const Surface> surface) {
  if (!surface) throw InvalidInput("surface: there is none");
  data_ = std::make_shared<Data>(surface->vertex_count(), surface->face_count());
  data_->surface.get({}, [&](const Task&) { return std::move(surface); });
}

SurfaceContext::SurfaceContext(std::vector<Vector> points, std::vector<Triangle> triangles,
                               std::optional<std::vector<Edge>> edges)
    : data_(std::make_shared<Data>(points.size(), triangles.size())) {
  data_->input = {.points = std::move(points), .triangles = std::move(triangles), .edges = std::move(edges)};
}

std::size_t SurfaceContext::vertex_count() const { return data_->vertex_count; }
std::size_t SurfaceContext::face_count() const { return data_->face_count; }

std::shared_ptr<const Surface> SurfaceContext::surface(const Task& task) const {
  return *data_->surface.get(task, [&](const Task& own) {
    // Copied: if this is stopped, another thread may build the surface.
    const Data::Input& input = *data_->input;
    auto surface = std::make_shared<const Surface>(input.points, input.triangles, input.edges, own);
    data_->input.reset();
    return surface;
  });
}

std::shared_ptr<const SurfaceContext::Data::Curvatures> SurfaceContext::Data::curvatures(const SurfaceContext& context,
                                                                                         const Task& task) {
  const std::shared_ptr<const Surface> on = context.surface(part_of(task, 0.0, kSurface));
  return made_curvatures.get(part_of(task, kSurface, 1.0), [&](const Task& own) {
    Curvatures made{.curvature = principal_curvatures(*on, own), .difference = {}};
    made.difference = made.curvature.difference();
    return made;
  });
}

std::shared_ptr<const Curvature> SurfaceContext::curvature(const Task& task) const {
  const auto made = data_->curvatures(*this, task);
  return {made, &made->curvature};
}

std::shared_ptr<const std::vector<double>> SurfaceContext::feature_strength(const Task& task) const {
  const auto made = data_->curvatures(*this, task);
  return {made, &made->difference};
}

std::shared_ptr<const Curvature> SurfaceContext::smoothed_curvature(const Task& task) const {
  const std::shared_ptr<const Curvature> from = curvature(first_part(task));
  const std::shared_ptr<const Surface> on = surface();
  return data_->smoothed_curvature.get(
      last_part(task), [&](const Task& own) { return smoothed_curvatures(*on, *from, kSmoothingRadius, own); });
}

std::shared_ptr<const EdgeAdjacency> SurfaceContext::edge_adjacency(const Task& task) const {
  const std::shared_ptr<const Surface> on = surface(first_part(task));
  return *data_->edge_adjacency.get(last_part(task), [&](const Task& own) { return make_edge_adjacency(*on, own); });
}

std::shared_ptr<const Surface> SurfaceContext::peek_surface() const {
  if (const std::exception_ptr error = data_->surface.error()) std::rethrow_exception(error);
  const auto held = data_->surface.peek();
  return held ? *held : nullptr;
}

std::shared_ptr<const std::vector<double>> SurfaceContext::peek_feature_strength() const {
  const auto made = data_->made_curvatures.peek();
  return made ? std::shared_ptr<const std::vector<double>>(made, &made->difference) : nullptr;
}

std::shared_ptr<const EdgeAdjacency> SurfaceContext::peek_edge_adjacency() const {
  const auto held = data_->edge_adjacency.peek();
  return held ? *held : nullptr;
}

bool SurfaceContext::wait_for_surface(double seconds) const {
  data_->surface.wait(deadline_after(seconds));
  return peek_surface() != nullptr;
}

Metric make_metric(const SurfaceContext& context, const MetricSpec& spec, const Task& task) {
  check_metric(spec);
  const bool is_smoothed = spec.family == MetricFamily::kConcave;
  const Task first = first_part(task), last = last_part(task);
  const std::shared_ptr<const Curvature> curvature =
      is_smoothed ? context.smoothed_curvature(first) : context.curvature(first);
  const std::shared_ptr<const Surface> surface = context.surface();
  switch (spec.family) {
    case MetricFamily::kFeature:
      return feature_metric(*surface, *curvature, *spec.follow, spec.strength, last);
    case MetricFamily::kCampen:
      return campen_metric(*surface, *curvature, *spec.follow, spec.strength, last);
    case MetricFamily::kPottmannKovacs:
      return pottmann_kovacs_metric(*surface, *curvature, *spec.follow, spec.strength, last);
    case MetricFamily::kConcave:
      return concave_metric(*surface, *curvature, concave_strength(spec.strength), last);
    case MetricFamily::kEuclidean:
      break;
  }
  return euclidean_metric(*surface, *curvature, last);
}

}  // namespace seamwire
