// SPDX-License-Identifier: GPL-3.0-or-later
#include "seamwire/live/livewire.hpp"

#include <algorithm>
#include <cmath>
#include <span>
#include <string>
#include <utility>

#include "detail/text.hpp"
#include "live/live_worker.hpp"

namespace seamwire {
namespace {

/// Where there is no surface yet any edge may be one.
void check_edge(const Surface* surface, const Edge& edge) {
  if (surface == nullptr || has_edge(*surface, edge)) return;
  throw InvalidInput("the surface has no edge between the vertices " + std::to_string(edge[0]) + " and " +
                     std::to_string(edge[1]));
}

void check_pick(const Surface* surface, std::size_t vertex_count, Along along, const Pick& pick) {
  if (pick.is_edge()) {
    if (along == Along::kSurface) throw InvalidInput("across the surface wires lead from vertex to vertex, not edge");
    check_edge(surface, {pick.a, pick.b});
  } else if (pick.a < 0 || static_cast<std::size_t>(pick.a) >= vertex_count) {
    throw InvalidInput("vertex " + std::to_string(pick.a) + " is out of range: the surface has " +
                       std::to_string(vertex_count) + " vertices");
  }
}

void check_metric(MetricFamily family, const Strength& strength) {
  if (family != MetricFamily::kEuclidean) check_strength(strength, family == MetricFamily::kCampen ? 1.0 : 0.0);
}

void check_options(const LiveWireOptions& options) {
  check_metric(options.family, options.strength);
  for (const double turning : {options.turning, options.loop_turning.value_or(0.0)}) {
    if (!(std::isfinite(turning) && turning >= 0)) {
      throw InvalidInput("turning is " + text(turning) + ", not a finite number of at least 0");
    }
  }
}

std::shared_ptr<MetricPair> new_metrics(const LiveWireOptions& options) {
  return std::make_shared<MetricPair>(options.family, options.strength, std::vector<Scribble>());
}

}  // namespace

LiveWire::LiveWire(std::shared_ptr<const Surface> surface, const LiveWireOptions& options) {
  check_options(options);
  impl_ = std::make_unique<Impl>(std::make_shared<SurfaceCache>(std::move(surface)), new_metrics(options), options);
}

LiveWire::LiveWire(std::vector<Vector> points, std::vector<Triangle> triangles, std::optional<std::vector<Edge>> edges,
                   const LiveWireOptions& options) {
  check_options(options);
  impl_ =
      std::make_unique<Impl>(std::make_shared<SurfaceCache>(std::move(points), std::move(triangles), std::move(edges)),
                             new_metrics(options), options);
}

LiveWire::LiveWire(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
LiveWire::LiveWire(LiveWire&& other) noexcept = default;
LiveWire& LiveWire::operator=(LiveWire&& other) noexcept = default;
LiveWire::~LiveWire() = default;

LiveWire LiveWire::fork() const {
  impl_->check_surface();
  const LiveWireOptions options{.along = impl_->along, .turning = impl_->turning, .loop_turning = impl_->loop_turning};
  return LiveWire(std::make_unique<Impl>(impl_->surface_cache, impl_->metrics_now(), options));
}

LiveWire LiveWire::sibling(const LiveWireOptions& options) const {
  check_options(options);
  impl_->check_surface();
  return LiveWire(std::make_unique<Impl>(impl_->surface_cache, new_metrics(options), options));
}

std::shared_ptr<const Surface> LiveWire::surface() const { return impl_->surface_if_built(); }

void LiveWire::set_metric(MetricFamily family, const Strength& strength) {
  check_metric(family, strength);
  impl_->check_surface();
  auto to = std::make_shared<MetricPair>(family, strength, impl_->metrics_now()->scribbles);
  impl_->change_metrics(std::move(to));  // the former metric is held here no longer, so it is not freed here
}

void LiveWire::set_scribbles(std::vector<Scribble> scribbles) {
  impl_->check_surface();
  std::shared_ptr<MetricPair> now = impl_->metrics_now();
  if (scribbles == now->scribbles) return;
  auto to = std::make_shared<MetricPair>(now->family, now->strength, std::move(scribbles));
  to->go_on_from(*now);
  now = nullptr;  // before the workers may free it, so that this is not the thread that does
  impl_->change_metrics(std::move(to));
}

void LiveWire::seed(const Pick& pick, bool forward) {
  check_pick(impl_->surface_if_built().get(), impl_->surface_cache->vertex_count, impl_->along, pick);
  const std::scoped_lock lock(impl_->mutex);
  ++impl_->request;
  impl_->seed = pick;
  impl_->forward = forward;
  impl_->target = {};
  for (Impl::Worker& worker : impl_->workers) {
    worker.solving.request_stop();
    worker.error = nullptr;
    worker.preview = nullptr;
    if (worker.solution) worker.dropped.push_back(std::exchange(worker.solution, nullptr));
  }
  impl_->changed.notify_all();
}

LiveWires LiveWire::wires(const Pick& target) const {
  const std::shared_ptr<const Surface> surface = impl_->surface_if_built();
  check_pick(surface.get(), impl_->surface_cache->vertex_count, impl_->along, target);
  std::array<std::shared_ptr<const SeedSolution>, 2> solution;
  std::array<std::shared_ptr<const Preview>, 2> previews;
  std::array<bool, 2> is_newest{};
  {
    const std::scoped_lock lock(impl_->mutex);
    if (!impl_->seed) throw InvalidInput("there is no seed that wires could start from");
    check_pick(surface.get(), impl_->surface_cache->vertex_count, impl_->along, *impl_->seed);
    impl_->rethrow();
    if (impl_->target != target) {
      impl_->target = target;
      ++impl_->targets;
    }
    for (std::size_t which = 0; surface && which < kFollow.size(); ++which) {
      const Impl::Worker& worker = impl_->workers[which];
      solution[which] = worker.solution;
      is_newest[which] = worker.solution != nullptr && worker.solution_for == impl_->request;
      const bool fits = worker.preview && worker.preview->request == impl_->request && worker.preview->target == target;
      if (!is_newest[which] && fits) previews[which] = worker.preview;
    }
  }
  LiveWires result;
  for (std::size_t which = 0; which < kFollow.size(); ++which) {
    LiveCandidate& wire = result.wires[which];
    wire.follow = kFollow[which];
    if (previews[which]) {
      wire = previews[which]->candidate;
    } else if (solution[which]) {
      const bool is_final = is_newest[which] && solution[which]->is_final(target);  // before it is looked up
      wire = impl_->candidate(which, *solution[which], target);
      wire.final = is_final;
    }
  }
  result.shorter = result.wires[1].length < result.wires[0].length ? 1 : 0;
  // What a worker has dropped meanwhile is freed by it, not here.
  const std::scoped_lock lock(impl_->mutex);
  for (std::size_t which = 0; which < kFollow.size(); ++which) {
    Impl::Worker& worker = impl_->workers[which];
    if (!solution[which] || solution[which] == worker.solution) continue;
    worker.dropped.push_back(std::move(solution[which]));
    impl_->changed.notify_all();
  }
  return result;
}

LiveLoop LiveWire::loop(const Edge& edge) {
  if (impl_->along != Along::kEdges) throw InvalidInput("loops run along edges, not across the surface");
  const std::shared_ptr<const Surface> surface = impl_->surface_if_built();
  check_edge(surface.get(), edge);
  const Edge sorted = {std::min(edge[0], edge[1]), std::max(edge[0], edge[1])};
  const std::scoped_lock lock(impl_->mutex);
  impl_->rethrow();
  auto& workers = impl_->workers;
  if (impl_->loop_edge != sorted) {
    ++impl_->loop_request;
    impl_->loop_edge = sorted;
    for (Impl::Worker& worker : workers) {
      if (worker.is_at_loop) worker.solving.request_stop();
    }
    impl_->changed.notify_all();
  }
  const auto is_handled = [&](const Impl::Worker& w) { return w.loop_handled == impl_->loop_request; };
  if (!surface || !std::ranges::all_of(workers, is_handled)) return {};
  const EdgeChain& cheaper = workers[1].loop.length < workers[0].loop.length ? workers[1].loop : workers[0].loop;
  return {.vertices = cheaper.vertices, .length = cheaper.length, .final = true};
}

EdgeChain LiveWire::run_on(const Edge& edge, std::span<const std::int32_t> stops) const {
  const std::shared_ptr<const Surface> surface = impl_->surface_if_built();
  check_edge(surface.get(), edge);
  const auto fans = surface ? impl_->surface_cache->fans.peek() : nullptr;
  if (!fans) return {};
  EdgeChain way{.vertices = extend_straight(**fans, edge, stops), .length = 0.0};
  const auto point = [&](std::int32_t v) -> const Vector& { return surface->points()[static_cast<std::size_t>(v)]; };
  for (std::size_t i = 1; i < way.vertices.size(); ++i) {
    way.length += surface->scale() * (point(way.vertices[i]) - point(way.vertices[i - 1])).norm();
  }
  return way;
}

EdgeLoop LiveWire::strip(const Edge& edge, std::span<const std::int32_t> stops) const {
  const std::shared_ptr<const Surface> surface = impl_->surface_if_built();
  check_edge(surface.get(), edge);
  const auto fans = surface ? impl_->surface_cache->fans.peek() : nullptr;
  return fans ? edge_loop(**fans, edge, stops) : EdgeLoop{};
}

std::shared_ptr<const std::vector<double>> LiveWire::feature_strength() const {
  impl_->check_surface();
  std::shared_ptr<const CurvatureCache> curvatures = impl_->surface_cache->curvatures.peek();
  return curvatures ? std::shared_ptr<const std::vector<double>>(curvatures, &curvatures->difference) : nullptr;
}

double LiveWire::progress() const {
  const std::scoped_lock lock(impl_->mutex);
  impl_->rethrow_failure();
  double sum = 0.0;
  for (std::size_t which = 0; which < kFollow.size(); ++which) {
    const Impl::Worker& worker = impl_->workers[which];
    if (worker.handled == impl_->request) {
      sum += 1.0;
      continue;
    }
    const double solved = std::clamp(worker.fraction.load(), 0.0, 1.0);
    const double prepared = std::clamp(impl_->metrics->fractions[which].load(), 0.0, 1.0);
    sum += worker.was_prepared ? solved : kSolveBegins * prepared + (1.0 - kSolveBegins) * solved;
  }
  return sum / static_cast<double>(kFollow.size());
}

bool LiveWire::wait(double seconds) const {
  std::unique_lock lock(impl_->mutex);
  impl_->wait_until(lock, seconds, [&] { return impl_->idle(); });
  impl_->rethrow();
  return impl_->idle();
}

bool LiveWire::wait_for_surface(double seconds) const {
  std::unique_lock lock(impl_->mutex);
  const auto built = [&] { return impl_->failure || impl_->surface_cache->peek_surface() != nullptr; };
  impl_->wait_until(lock, seconds, built);
  impl_->rethrow_failure();
  return built();
}

}  // namespace seamwire
