// SPDX-License-Identifier: GPL-3.0-or-later
#include "seamwire/context/embedded_surface.hpp"

#include <algorithm>
#include <string>
#include <utility>

#include "context/surface_context.hpp"
#include "detail/index.hpp"
#include "detail/poll.hpp"
#include "metric/metric_check.hpp"
#include "wires/path_position.hpp"

namespace seamwire {

using namespace detail;

EmbeddedSurface::Data::Data(const SurfaceContext& of, std::shared_ptr<const Metric> in, const EmbedOptions& with,
                            const Task& task)
    : context(of), surface(of.surface(task)), metric(std::move(in)), options(with) {
  if (!metric) throw InvalidInput("metric: there is none");
}

EmbeddedSurface::EmbeddedSurface(const SurfaceContext& context, const MetricSpec& spec, const EmbedOptions& options,
                                 const Task& task) {
  if (std::optional<EmbeddedSurface> found = find(context, spec, options)) {
    data_ = std::move(found->data_);
    return;
  }
  auto metric = std::make_shared<const Metric>(make_metric(context, spec, part_of(task, 0.0, 0.0)));
  *this = EmbeddedSurface(context, spec, std::move(metric), options, task);
}

EmbeddedSurface::EmbeddedSurface(const SurfaceContext& context, const MetricSpec& spec,
                                 std::shared_ptr<const Metric> metric, const EmbedOptions& options, const Task& task)
    : EmbeddedSurface(context, std::move(metric), options, task) {
  data_->spec = spec;  // nobody else has it yet
  SurfaceContext::Data& known = *context.data_;
  const MutexLock lock(known.mutex);
  std::erase_if(known.embedded, [](const auto& each) { return each.expired(); });
  known.embedded.push_back(data_);
}

EmbeddedSurface detail::embedded_in(const SurfaceContext& context, const MetricSpec& spec,
                                    std::shared_ptr<const Metric> metric, const EmbedOptions& options,
                                    const Task& task) {
  return {context, spec, std::move(metric), options, task};
}

EmbeddedSurface::EmbeddedSurface(const SurfaceContext& context, std::shared_ptr<const Metric> metric,
                                 const EmbedOptions& options, const Task& task)
    : data_(std::make_shared<Data>(context, std::move(metric), options, task)) {
  data_->embedding = std::make_shared<const Embedding>(embed(*data_->surface, *data_->metric, options, task));
}

EmbeddedSurface::EmbeddedSurface(const SurfaceContext& context, std::shared_ptr<const Metric> metric,
                                 Embedding embedding)
    : data_(std::make_shared<Data>(context, std::move(metric), embedding.options, Task{})) {
  check_size(*data_->surface, *data_->metric);
  check_tensors(*data_->metric);
  data_->embedding = std::make_shared<const Embedding>(std::move(embedding));
  points();  // it says what embedding is not of the surface
}

EmbeddedSurface EmbeddedSurface::with_metric(std::shared_ptr<const Metric> metric, const Task& task) const {
  EmbeddedSurface made(std::make_shared<Data>(context(), std::move(metric), data_->options, task));
  made.data_->embedding = std::make_shared<const Embedding>(
      re_embed(surface(), this->metric(), made.metric(), embedding(), data_->options, task));
  if (const auto former = data_->geodesics.peek()) {
    made.data_->geodesics.get(part_of(task, 1.0, 1.0), [&](const Task& own) {
      return ExactGeodesics(*former, embedding().mesh, made.embedding().mesh, own);
    });
  }
  return made;
}

std::optional<EmbeddedSurface> EmbeddedSurface::find(const SurfaceContext& context, const MetricSpec& spec,
                                                     const EmbedOptions& options) {
  SurfaceContext::Data& known = *context.data_;
  const MutexLock lock(known.mutex);
  for (const std::weak_ptr<Data>& each : known.embedded) {
    std::shared_ptr<Data> data = each.lock();
    if (data && data->spec == spec && data->options == options) return EmbeddedSurface(std::move(data));
  }
  return std::nullopt;
}

const SurfaceContext& EmbeddedSurface::context() const { return data_->context; }
const Surface& EmbeddedSurface::surface() const { return *data_->surface; }
const std::shared_ptr<const Metric>& EmbeddedSurface::shared_metric() const { return data_->metric; }
const std::optional<MetricSpec>& EmbeddedSurface::spec() const { return data_->spec; }
const std::shared_ptr<const Embedding>& EmbeddedSurface::shared_embedding() const { return data_->embedding; }

const ExactGeodesics& EmbeddedSurface::geodesics(const Task& task) const {
  return *data_->geodesics.get(task, [&](const Task& own) { return ExactGeodesics(embedding().mesh, own); });
}

const HeatGeodesics& EmbeddedSurface::heat_geodesics(const Task& task) const {
  return *data_->heat.get(task, [&](const Task& own) { return HeatGeodesics(embedding().mesh, own); });
}

const EmbeddedPoints& EmbeddedSurface::points() const {
  return *data_->points.get({}, [&](const Task&) { return EmbeddedPoints(data_->surface, data_->embedding); });
}

SurfacePoint EmbeddedSurface::locate(const SurfacePoint& point, const std::string& what) const {
  if (point.vertex >= 0) {
    check_index(point.vertex, surface().vertex_count(), what + ": vertex");
    return point;
  }
  if (const std::optional<SurfacePoint> found = points().find(point, what)) return *found;
  const std::string face = what + ": face " + std::to_string(point.face);
  if (std::ranges::binary_search(embedding().hole_faces, point.face)) {
    throw InvalidInput(face + " is a hole of the embedding there");
  }
  if (const auto& only = data_->options.faces; only && std::ranges::find(*only, point.face) == only->end()) {
    throw InvalidInput(face + " is not among the faces that were embedded");
  }
  throw InvalidInput(face + " has no area, so the embedding leaves it out: name a vertex or another face");
}

EmbeddedField EmbeddedSurface::field(const SurfacePoint& seed, const Task& task) const {
  return field({&seed, 1}, {}, task);
}

EmbeddedField EmbeddedSurface::field(std::span<const SurfacePoint> sources, const SolveOptions& options,
                                     const Task& task) const {
  return field(geodesics(part_of(task, 0.0, 0.0)), sources, options, task);
}

EmbeddedField EmbeddedSurface::field(const DistanceMethod& method, std::span<const SurfacePoint> sources,
                                     const SolveOptions& options, const Task& task) const {
  std::vector<SurfacePoint> seeds;
  for (const SurfacePoint& source : sources) seeds.push_back(locate(source, "seed"));
  SolveOptions own{.max_distance = options.max_distance, .targets = {}};
  for (const SurfacePoint& target : options.targets) own.targets.push_back(locate(target, "target"));
  DistanceField distances = method.solve(seeds, own, task);
  check_field(embedding(), distances);
  return {*this, std::move(distances)};
}

double EmbeddedField::distance(const SurfacePoint& point, const Task& task) const {
  return distances_.distance(on_.locate(point), task);
}

std::optional<Wire> EmbeddedField::trace(const SurfacePoint& point, const Task& task) const {
  return trace_wire(on_.surface(), on_.embedding(), distances_, on_.locate(point), task);
}

std::vector<ClosedWire> EmbeddedField::closed_wires(std::size_t count, const Task& task) const {
  return seamwire::closed_wires(on_.surface(), on_.embedding(), distances_, count, task);
}

BentWires EmbeddedField::bend(const ClosedWire& cut, const Task& task) const {
  return {on_.data_->surface, on_.data_->embedding, on_.geodesics(part_of(task, 0.0, 0.0)), distances_, cut, task};
}

}  // namespace seamwire
