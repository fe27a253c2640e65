// SPDX-License-Identifier: GPL-3.0-or-later
#include "seamwire/live/livewire.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <deque>
#include <span>
#include <string>
#include <utility>

#include "detail/index.hpp"
#include "detail/text.hpp"
#include "detail/thread_safety.hpp"
#include "geodesics/placed_point.hpp"
#include "live/deadline.hpp"
#include "live/live_worker.hpp"
#include "surface/real_edges.hpp"

namespace seamwire {

using namespace detail;

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
  } else {
    check_index(pick.a, vertex_count, "vertex");
  }
}

/// Throws where an end is not part of the surface, null where that is not known yet.
void check_end(const Surface* surface, const SurfaceCache& cache, Along along, const WireEnd& end,
               const std::string& what) {
  if (const auto* pick = std::get_if<Pick>(&end)) return check_pick(surface, cache.vertex_count, along, *pick);
  if (along == Along::kEdges) {
    throw InvalidInput(what + ": along edges wires lead from vertices and edges, not from other points");
  }
  const auto& point = std::get<SurfacePoint>(end);
  check_index(point.face, cache.face_count, what + ": face", "faces");
  checked_barycentric(point.barycentric, what);
}

/// A vertex is one, whichever way it is given.
WireEnd end_at(const SurfacePoint& point) {
  return point.vertex >= 0 ? WireEnd(Pick{.a = point.vertex}) : WireEnd(point);
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

std::shared_ptr<MetricSet> new_metrics(const LiveWireOptions& options) {
  return std::make_shared<MetricSet>(options.family, options.along, options.strength, std::vector<Scribble>());
}

void choose_active(LiveWires& found, const std::optional<std::size_t>& leader) {
  const std::vector<LiveCandidate>& wires = found.wires;
  const bool it_leads = leader && (!wires[*leader].final || !wires[*leader].points.empty());
  const auto shortest = std::ranges::min_element(wires, {}, &LiveCandidate::length) - wires.begin();
  found.active = static_cast<int>(it_leads ? *leader : static_cast<std::size_t>(shortest));
  found.settled = found.final() || (it_leads && wires[*leader].final);
}

LiveSettings settings_of(const LiveWireOptions& options) {
  return {.along = options.along, .turning = options.turning, .loop_turning = options.loop_turning};
}

}  // namespace

/// What the members of a LiveWire have in common. The mutex is held only for a look at what it guards, never while a
/// worker is asked, which has one of its own.
struct LiveWire::Impl {
  Impl(const std::shared_ptr<SurfaceCache>& on, const std::shared_ptr<MetricSet>& by, const LiveSettings& with)
      : surface_cache(on), settings(with), metrics_(by) {
    const auto right_of_way = std::make_shared<RightOfWay>();
    const std::size_t most = with.along == Along::kSurface ? kMostMetrics : 2;
    for (std::size_t which = 0; which < most; ++which) workers.emplace_back(which, on, by, with, right_of_way);
  }
  ~Impl() {
    for (LiveWorker& worker : workers) worker.request_stop();  // all, before the first of them is waited for
  }
  Impl(const Impl&) = delete;
  Impl& operator=(const Impl&) = delete;

  /// Null until it is built. Throws why there will be none.
  std::shared_ptr<const Surface> surface_if_built() const {
    surface_cache->rethrow_failure();
    return surface_cache->peek_surface();
  }
  /// Why wires, or with `loops` loops, cannot be had.
  void rethrow(bool loops = false) const {
    surface_cache->rethrow_failure();
    for (const LiveWorker& worker : workers) {
      if (const std::exception_ptr error = loops ? worker.loop_error() : worker.error()) std::rethrow_exception(error);
    }
  }
  std::shared_ptr<MetricSet> metrics() const {
    const MutexLock lock(mutex_);
    return metrics_;
  }
  void change_metrics(const std::shared_ptr<MetricSet>& to) {
    {
      const MutexLock lock(mutex_);
      metrics_ = to;  // the workers have the former ones still, so they are not freed here
    }
    for (LiveWorker& worker : workers) worker.change_metric(to);
  }
  void seed(const WireEnd& seed, bool forward) {
    check_end(surface_if_built().get(), *surface_cache, settings.along, seed, "seed");
    {
      const MutexLock lock(mutex_);
      seed_ = seed;
    }
    for (LiveWorker& worker : workers) worker.seed(seed, forward);
  }
  LiveWires wires(const WireEnd& target);
  void check_closed(const WireEnd& end, const std::string& what) const {
    if (settings.along != Along::kSurface) throw InvalidInput("closed wires run across the surface, not along edges");
    check_end(surface_if_built().get(), *surface_cache, Along::kSurface, end, what);
  }
  LiveClosedWires closed_wires(const LoopPlace& place) {
    const bool is_built = surface_if_built() != nullptr;
    workers[0].find_loop(place);
    rethrow(true);
    return is_built ? workers[0].closed_wires() : LiveClosedWires{};
  }

  const std::shared_ptr<SurfaceCache> surface_cache;
  const LiveSettings settings;

 private:
  mutable Mutex mutex_;
  std::shared_ptr<MetricSet> metrics_ SEAMWIRE_GUARDED_BY(mutex_);
  std::optional<WireEnd> seed_ SEAMWIRE_GUARDED_BY(mutex_);

 public:
  std::deque<LiveWorker> workers;  // of the metrics; last, so that they end first
};

LiveWire::LiveWire(std::shared_ptr<const Surface> surface, const LiveWireOptions& options) {
  if (!surface) throw InvalidInput("surface: there is none");
  check_options(options);
  impl_ = std::make_unique<Impl>(std::make_shared<SurfaceCache>(std::move(surface)), new_metrics(options),
                                 settings_of(options));
}

LiveWire::LiveWire(std::vector<Vector> points, std::vector<Triangle> triangles, std::optional<std::vector<Edge>> edges,
                   const LiveWireOptions& options) {
  check_options(options);
  auto cache = std::make_shared<SurfaceCache>(std::move(points), std::move(triangles), std::move(edges));
  impl_ = std::make_unique<Impl>(cache, new_metrics(options), settings_of(options));
}

LiveWire::LiveWire(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
LiveWire::LiveWire(LiveWire&& other) noexcept = default;
LiveWire& LiveWire::operator=(LiveWire&& other) noexcept = default;
LiveWire::~LiveWire() = default;

LiveWire LiveWire::fork() const {
  impl_->surface_cache->rethrow_failure();
  return LiveWire(std::make_unique<Impl>(impl_->surface_cache, impl_->metrics(), impl_->settings));
}

LiveWire LiveWire::sibling(const LiveWireOptions& options) const {
  check_options(options);
  impl_->surface_cache->rethrow_failure();
  return LiveWire(std::make_unique<Impl>(impl_->surface_cache, new_metrics(options), settings_of(options)));
}

std::shared_ptr<const Surface> LiveWire::surface() const { return impl_->surface_if_built(); }

void LiveWire::set_metric(MetricFamily family, const Strength& strength) {
  check_metric(family, strength);
  impl_->surface_cache->rethrow_failure();
  auto to = std::make_shared<MetricSet>(family, impl_->settings.along, strength, impl_->metrics()->scribbles);
  impl_->change_metrics(to);  // the former metric is held here no longer, so it is not freed here
}

void LiveWire::set_scribbles(std::vector<Scribble> scribbles) {
  impl_->surface_cache->rethrow_failure();
  std::shared_ptr<MetricSet> now = impl_->metrics();
  if (scribbles == now->scribbles) return;
  auto to = std::make_shared<MetricSet>(now->family, impl_->settings.along, now->strength, std::move(scribbles));
  to->go_on_from(*now);
  now = nullptr;  // before the workers may free it, so that this is not the thread that does
  impl_->change_metrics(to);
}

void LiveWire::seed(const Pick& pick, bool forward) { impl_->seed(pick, forward); }
void LiveWire::seed_at(const SurfacePoint& point) { impl_->seed(end_at(point), false); }
LiveWires LiveWire::wires(const Pick& target) const { return impl_->wires(target); }
LiveWires LiveWire::wires_to(const SurfacePoint& target) const { return impl_->wires(end_at(target)); }

LiveWires LiveWire::Impl::wires(const WireEnd& target) {
  const std::shared_ptr<const Surface> surface = surface_if_built();
  check_end(surface.get(), *surface_cache, settings.along, target, "target");
  std::optional<WireEnd> seed;
  {
    const MutexLock lock(mutex_);
    seed = seed_;
  }
  if (!seed) throw InvalidInput("there is no seed that wires could start from");
  check_end(surface.get(), *surface_cache, settings.along, *seed, "seed");  // it may have been too early before
  rethrow();
  const std::shared_ptr<MetricSet> metrics = this->metrics();
  LiveWires result;
  result.wires.resize(metrics->count);
  for (std::size_t which = 0; which < metrics->count; ++which) {
    LiveWorker& worker = workers[which];
    LiveCandidate& wire = result.wires[which];
    wire.follow = kFollow[which];
    auto [solution, is_newest, preview] = worker.snapshot(target);
    if (!surface) {
      // It may be there by now, but the target was not looked for on it.
    } else if (preview) {
      wire = *preview;
    } else if (solution) {
      const bool is_final = is_newest && solution->is_final(target);  // before it is looked up
      wire = worker.candidate(*solution, *seed, target);
      wire.final = is_final;
    }
    if (solution) worker.release(std::move(solution));
  }
  choose_active(result, metrics->leader());
  return result;
}

LiveLoop LiveWire::loop(const Edge& edge) {
  if (impl_->settings.along != Along::kEdges) throw InvalidInput("loops run along edges, not across the surface");
  const std::shared_ptr<const Surface> surface = impl_->surface_if_built();
  check_edge(surface.get(), edge);
  for (LiveWorker& worker : impl_->workers)
    worker.find_loop(Edge{std::min(edge[0], edge[1]), std::max(edge[0], edge[1])});
  impl_->rethrow(true);
  if (!surface) return {};
  EdgeChain cheapest;
  for (const LiveWorker& worker : impl_->workers) {
    std::optional<EdgeChain> loop = worker.loop();
    if (!loop) return {};
    if (loop->length < cheapest.length) cheapest = std::move(*loop);
  }
  return {.vertices = std::move(cheapest.vertices), .length = cheapest.length, .final = true};
}

LiveClosedWires LiveWire::closed_wires(const SurfacePoint& through) {
  const WireEnd end = end_at(through);
  impl_->check_closed(end, "through");
  return impl_->closed_wires(end);
}

LiveClosedWires LiveWire::bent_wire(const SurfacePoint& through, const SurfacePoint& second, std::size_t which) {
  const BendPlace place{.through = end_at(through), .second = end_at(second), .which = which};
  impl_->check_closed(place.through, "through");
  impl_->check_closed(place.second, "second");
  return impl_->closed_wires(place);
}

EdgeChain LiveWire::extend_straight(const Edge& edge, std::span<const std::int32_t> stops) const {
  const std::shared_ptr<const Surface> surface = impl_->surface_if_built();
  check_edge(surface.get(), edge);
  const auto fans = surface ? impl_->surface_cache->fans.peek() : nullptr;
  if (!fans) return {};
  EdgeChain way{.vertices = seamwire::extend_straight(**fans, edge, stops), .length = 0.0};
  const auto point = [&](std::int32_t v) -> const Vector& { return surface->points()[v]; };
  for (std::size_t i = 1; i < way.vertices.size(); ++i) {
    way.length += surface->scale() * (point(way.vertices[i]) - point(way.vertices[i - 1])).norm();
  }
  return way;
}

EdgeLoop LiveWire::edge_loop(const Edge& edge, std::span<const std::int32_t> stops) const {
  const std::shared_ptr<const Surface> surface = impl_->surface_if_built();
  check_edge(surface.get(), edge);
  const auto fans = surface ? impl_->surface_cache->fans.peek() : nullptr;
  return fans ? seamwire::edge_loop(**fans, edge, stops) : EdgeLoop{};
}

FittedChain LiveWire::fit_chain(const DrawnLine& line, std::optional<std::int32_t> begin,
                                std::optional<std::int32_t> end) const {
  if (impl_->settings.along != Along::kEdges)
    throw InvalidInput("lines are fitted along edges, not across the surface");
  const std::shared_ptr<const Surface> surface = impl_->surface_if_built();
  const auto fans = surface ? impl_->surface_cache->fans.peek() : nullptr;
  return fans ? seamwire::fit_chain(*surface, **fans, line, begin, end) : FittedChain{};
}

std::shared_ptr<const std::vector<double>> LiveWire::feature_strength() const {
  impl_->surface_cache->rethrow_failure();
  std::shared_ptr<const CurvatureCache> curvatures = impl_->surface_cache->curvatures.peek();
  return curvatures ? std::shared_ptr<const std::vector<double>>(curvatures, &curvatures->difference) : nullptr;
}

std::vector<std::optional<LiveEmbedding>> LiveWire::embeddings() const {
  impl_->surface_cache->rethrow_failure();
  const std::shared_ptr<MetricSet> metrics = impl_->metrics();
  std::vector<std::optional<LiveEmbedding>> found(metrics->count);
  for (std::size_t which = 0; which < found.size(); ++which) {
    const std::shared_ptr<const Prepared> prepared = metrics->prepared[which]->peek();
    if (!prepared || !prepared->embedding) continue;
    const Embedding& embedding = *prepared->embedding;
    found[which] = {.invalid_left = embedding.invalid_left,
                    .hit_cap = embedding.hit_cap,
                    .clamped_edges = embedding.clamped_edges,
                    .worst_clamp = embedding.worst_clamp};
  }
  return found;
}

double LiveWire::progress() const {
  impl_->surface_cache->rethrow_failure();
  const std::size_t count = impl_->metrics()->count;
  double sum = 0.0;
  for (std::size_t which = 0; which < count; ++which) sum += impl_->workers[which].progress();
  return sum / static_cast<double>(count);
}

bool LiveWire::wait(double seconds) const {
  const Deadline deadline = deadline_after(seconds);
  // One after the other: what is idle stays so, as only the caller gives them something to do.
  bool are_idle = true;
  for (const LiveWorker& worker : impl_->workers) are_idle = worker.wait_until_idle(deadline) && are_idle;
  impl_->rethrow(true);
  return are_idle;
}

bool LiveWire::wait_for_surface(double seconds) const {
  impl_->surface_cache->wait_for_surface(deadline_after(seconds));
  return impl_->surface_if_built() != nullptr;
}

}  // namespace seamwire
