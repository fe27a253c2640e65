// SPDX-License-Identifier: GPL-3.0-or-later
#include "seamwire/live/livewire.hpp"

#include <algorithm>
#include <numeric>
#include <span>
#include <string>
#include <utility>

#include "detail/deadline.hpp"
#include "detail/index.hpp"
#include "detail/infinity.hpp"
#include "detail/text.hpp"
#include "detail/thread_safety.hpp"
#include "edges/edge_graph.hpp"
#include "geodesics/placed_point.hpp"
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
void check_end(const Surface* surface, const SurfaceContext& context, Along along, const WireEnd& end,
               const std::string& what) {
  if (const auto* pick = std::get_if<Pick>(&end)) return check_pick(surface, context.vertex_count(), along, *pick);
  if (along == Along::kEdges) {
    throw InvalidInput(what + ": along edges, wires connect vertices and edges, not points in faces");
  }
  const auto& point = std::get<SurfacePoint>(end);
  check_index(point.face, context.face_count(), what + ": face", "faces");
  checked_barycentric(point.barycentric, what);
}

/// A vertex is one, whichever way it is given.
WireEnd end_at(const SurfacePoint& point) {
  return point.vertex >= 0 ? WireEnd(Pick{.a = point.vertex}) : WireEnd(point);
}

void check_metrics(const LiveMetrics& metrics) {
  if (metrics.wires.empty()) throw InvalidInput("metrics: there is none");
  if (metrics.cuts.empty()) throw InvalidInput("metrics: there is none for closed cuts");
  for (const MetricSpec& spec : metrics.wires) check_metric(spec);
  for (const std::size_t metric : metrics.cuts) {
    if (metric < metrics.wires.size()) continue;
    throw InvalidInput("metric " + std::to_string(metric) + " for closed cuts is out of range: there are " +
                       std::to_string(metrics.wires.size()));
  }
}

void check_options(const LiveWireOptions& options) {
  check_metrics(options.metrics);
  for (const double turning : {options.turning, options.loop_turning.value_or(0.0)}) {
    check_turning(turning);
  }
  if (!(options.max_error >= 0 && options.max_error <= 1)) {
    throw InvalidInput("max_error is " + text(options.max_error) + ", not between 0 and 1");
  }
}

std::shared_ptr<MetricSet> new_metrics(const LiveWireOptions& options) {
  return std::make_shared<MetricSet>(options.metrics, std::vector<Scribble>());
}

/// Whether it is known that a metric has no wire to the target.
bool is_missing(const LiveCandidate& wire) { return wire.final && wire.points.empty(); }

/// `first_lengths`: of the wires before they were refined. Until all are refined, these are compared, because a refined
/// wire is measured in another embedding.
void choose_active(LiveWires& found, const std::vector<double>& first_lengths, const LiveMetrics& metrics) {
  const std::vector<LiveCandidate>& wires = found.wires;
  std::vector<std::size_t> first = {0};
  for (std::size_t i = 1; i < wires.size(); ++i) {
    if (is_counterpart(metrics.wires[0], metrics.wires[i])) first.push_back(i);
  }
  const bool are_missing = std::ranges::all_of(first, [&](std::size_t i) { return is_missing(wires[i]); });
  found.settled = found.final() || (first.size() == 1 && wires[0].final && !are_missing);
  if (are_missing) {
    first.resize(wires.size());
    std::iota(first.begin(), first.end(), std::size_t{0});
  }
  const auto length = [&](std::size_t i) { return found.final() ? wires[i].length : first_lengths[i]; };
  found.active = static_cast<int>(*std::ranges::min_element(first, {}, length));
}

void check_along_edges(const LiveSettings& settings, const std::string& what) {
  if (settings.along != Along::kEdges) throw InvalidInput(what + " along edges, not across the surface");
}

LiveSettings settings_of(const LiveWireOptions& options) {
  return {.along = options.along,
          .turning = options.turning,
          .loop_turning = options.loop_turning,
          .max_error = options.max_error};
}

}  // namespace

/// The state that the members of a LiveWire share.
struct LiveWire::Impl {
  using Workers = std::vector<std::shared_ptr<LiveWorker>>;

  /// The settings that were made last.
  struct State {
    std::shared_ptr<MetricSet> metrics;
    Workers workers;  // one for each metric, or more: metrics may have become fewer
    std::optional<WireEnd> seed = std::nullopt;
    bool is_forward = false;
  };

  Impl(const SurfaceContext& on, const std::shared_ptr<MetricSet>& by, const LiveSettings& with)
      : context(on), settings(with), right_of_way_(std::make_shared<RightOfWay>()) {
    State state{.metrics = by, .workers = {}};
    add_workers(state);
    const MutexLock lock(mutex_);
    state_ = std::move(state);
  }
  ~Impl() {
    const Workers workers = now().workers;
    for (const auto& worker : workers) worker->request_stop();  // all, before the first of them is waited for
  }
  Impl(const Impl&) = delete;
  Impl& operator=(const Impl&) = delete;

  State now() const {
    const MutexLock lock(mutex_);
    return state_;
  }
  /// Throws why wires, or with `loops` loops, cannot be had.
  void rethrow(const State& state, bool loops = false) const {
    context.peek_surface();
    for (const auto& worker : state.workers) {
      if (const std::exception_ptr error = loops ? worker->loop_error() : worker->error()) {
        std::rethrow_exception(error);
      }
    }
  }
  /// Goes on with the metrics that make(former) returns, unless that is null.
  template <class Make>
  void change_metrics(const Make& make) {
    context.peek_surface();
    const MutexLock lock(changing_);
    State state = now();
    const std::shared_ptr<MetricSet> to = make(*state.metrics);
    if (!to) return;
    state.metrics = to;  // the workers have the former ones still, so that they are not freed here
    const std::size_t before = state.workers.size();
    add_workers(state);
    set(state);
    for (std::size_t i = 0; i < before; ++i) state.workers[i]->change_metric(to);
  }
  void seed(const WireEnd& seed, bool forward) {
    check_end(context.peek_surface().get(), context, settings.along, seed, "seed");
    const MutexLock lock(changing_);
    State state = now();
    state.seed = seed;
    state.is_forward = forward;
    set(state);
    for (const auto& worker : state.workers) worker->seed(seed, forward);
  }
  LiveWires wires(const WireEnd& target) const;
  void check_closed(const WireEnd& end, const std::string& what) const {
    if (settings.along != Along::kSurface) throw InvalidInput("closed wires run across the surface, not along edges");
    check_end(context.peek_surface().get(), context, Along::kSurface, end, what);
  }
  LiveClosedWires closed_wires(const LoopPlace& place) const {
    const bool is_built = context.peek_surface() != nullptr;
    const State state = now();
    LiveWorker& worker = *state.workers[state.metrics->metrics.cuts.front()];
    worker.find_loop(place);
    rethrow(state, true);
    return is_built ? worker.closed_wires(place) : LiveClosedWires{};
  }

  const SurfaceContext context;
  const LiveSettings settings;

 private:
  void add_workers(State& state) const {
    while (state.workers.size() < state.metrics->count()) {
      auto worker = std::make_shared<LiveWorker>(state.workers.size(), context, state.metrics, settings, right_of_way_);
      if (state.seed) worker->seed(*state.seed, state.is_forward);
      state.workers.push_back(std::move(worker));
    }
  }
  void set(const State& state) {
    const MutexLock lock(mutex_);
    state_ = state;
  }

  const std::shared_ptr<RightOfWay> right_of_way_;
  Mutex changing_;  // held until all workers were told of a change, so that they are told of all in one order
  mutable Mutex mutex_;
  State state_ SEAMWIRE_GUARDED_BY(mutex_);  // changes with changing_ held
};

LiveMetrics live_metrics(MetricFamily family, const Strength& strength, Along along) {
  const MetricFamilyInfo& info = info_of(family);
  if (!info.parameter.empty()) check_strength(strength, info.least_parameter);
  const Strength own{.parameter = strength.parameter,
                     .max_anisotropy = strength.max_anisotropy,
                     .clamp_percentile = info.has_clamp ? strength.clamp_percentile : std::nullopt};
  if (family == MetricFamily::kEuclidean) return {.wires = {MetricSpec::euclidean()}};
  if (family == MetricFamily::kConcave) {
    return {.wires = {MetricSpec::concave(own), MetricSpec::euclidean()}, .cuts = {0, 1}};
  }
  LiveMetrics metrics;
  if (family == MetricFamily::kFeature && along == Along::kSurface) {
    metrics = {.wires = {MetricSpec::concave_like(own)}, .cuts = {1}};
  }
  for (const Follow follow : {Follow::kMin, Follow::kMax}) {
    metrics.wires.push_back({.family = family, .follow = follow, .strength = own});
  }
  return metrics;
}

LiveWire::LiveWire(const SurfaceContext& context, const LiveWireOptions& options) {
  check_options(options);
  impl_ = std::make_unique<Impl>(context, new_metrics(options), settings_of(options));
}

LiveWire::LiveWire(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
LiveWire::LiveWire(LiveWire&& other) noexcept = default;
LiveWire& LiveWire::operator=(LiveWire&& other) noexcept = default;
LiveWire::~LiveWire() = default;

LiveWire LiveWire::fork() const {
  impl_->context.peek_surface();
  return LiveWire(std::make_unique<Impl>(impl_->context, impl_->now().metrics, impl_->settings));
}

LiveWire LiveWire::sibling(const LiveWireOptions& options) const {
  check_options(options);
  impl_->context.peek_surface();
  return LiveWire(impl_->context, options);
}

const SurfaceContext& LiveWire::context() const { return impl_->context; }
std::shared_ptr<const Surface> LiveWire::surface() const { return impl_->context.peek_surface(); }

void LiveWire::set_metrics(const LiveMetrics& metrics) {
  check_metrics(metrics);
  impl_->change_metrics(
      [&](const MetricSet& former) { return std::make_shared<MetricSet>(metrics, former.scribbles, former); });
}

void LiveWire::set_scribbles(std::vector<Scribble> scribbles) {
  impl_->change_metrics([&](const MetricSet& former) {
    if (scribbles == former.scribbles) return std::shared_ptr<MetricSet>();
    return std::make_shared<MetricSet>(former.metrics, std::move(scribbles), former);
  });
}

void LiveWire::seed(const Pick& pick, bool forward) { impl_->seed(pick, forward); }
void LiveWire::seed_at(const SurfacePoint& point) { impl_->seed(end_at(point), false); }
LiveWires LiveWire::wires(const Pick& target) const { return impl_->wires(target); }
LiveWires LiveWire::wires_to(const SurfacePoint& target) const { return impl_->wires(end_at(target)); }

LiveWires LiveWire::Impl::wires(const WireEnd& target) const {
  const std::shared_ptr<const Surface> surface = context.peek_surface();
  check_end(surface.get(), context, settings.along, target, "target");
  const State state = now();
  if (!state.seed) throw InvalidInput("there is no seed that wires could start from");
  check_end(surface.get(), context, settings.along, *state.seed, "seed");  // it may have been too early before
  const LiveMetrics& metrics = state.metrics->metrics;
  LiveWires result;
  result.wires.resize(metrics.wires.size());
  std::vector<double> first_lengths(metrics.wires.size(), kInfinity);
  for (std::size_t i = 0; i < metrics.wires.size(); ++i) {
    result.wires[i].metric = metrics.wires[i];
    if (!surface && settings.along == Along::kEdges) continue;  // a target edge could not be looked up
    LiveWorker::Known known = state.workers[i]->wire(target);
    if (known.candidate) result.wires[i] = *std::move(known.candidate);
    first_lengths[i] = known.first_length;
  }
  rethrow(state);  // after the target was asked for, which clears what went wrong on the way to another one
  choose_active(result, first_lengths, metrics);
  return result;
}

LiveLoop LiveWire::loop(const Edge& edge) {
  if (impl_->settings.along != Along::kEdges) throw InvalidInput("loops run along edges, not across the surface");
  const std::shared_ptr<const Surface> surface = impl_->context.peek_surface();
  check_edge(surface.get(), edge);
  const Impl::State state = impl_->now();
  const auto workers = std::span(state.workers).first(state.metrics->count());
  const Edge through{std::min(edge[0], edge[1]), std::max(edge[0], edge[1])};
  for (const auto& worker : workers) worker->find_loop(through);
  impl_->rethrow(state, true);
  if (!surface) return {};
  EdgeChain cheapest;
  for (const auto& worker : workers) {
    std::optional<EdgeChain> loop = worker->loop(through);
    if (!loop) return {};
    if (loop->length < cheapest.length) cheapest = std::move(*loop);
  }
  const auto adjacency = impl_->context.edge_adjacency();  // the workers have computed it
  const std::int32_t corners = count_corners(*surface, *adjacency, cheapest.vertices);
  return {.vertices = std::move(cheapest.vertices), .length = cheapest.length, .corners = corners, .final = true};
}

LiveClosedWires LiveWire::closed_wires(const SurfacePoint& through) {
  const WireEnd end = end_at(through);
  impl_->check_closed(end, "through");
  return impl_->closed_wires(end);
}

LiveClosedWires LiveWire::bent_wire(const SurfacePoint& through, const SurfacePoint& second, const ClosedCutId& cut) {
  const BendPlace place{.through = end_at(through), .second = end_at(second), .cut = cut};
  impl_->check_closed(place.through, "through");
  impl_->check_closed(place.second, "second");
  return impl_->closed_wires(place);
}

EdgeChain LiveWire::extend_straight(const Edge& edge, std::span<const std::int32_t> stops) const {
  const std::shared_ptr<const Surface> surface = impl_->context.peek_surface();
  check_along_edges(impl_->settings, "chains are extended");
  check_edge(surface.get(), edge);
  const auto adjacency = surface ? impl_->context.peek_edge_adjacency() : nullptr;
  if (!adjacency) return {};
  EdgeChain way{.vertices = seamwire::extend_straight(*adjacency, edge, stops), .length = 0.0};
  const auto point = [&](std::int32_t v) -> const Vector& { return surface->points()[v]; };
  for (std::size_t i = 1; i < way.vertices.size(); ++i) {
    way.length += (point(way.vertices[i]) - point(way.vertices[i - 1])).norm();
  }
  return way;
}

EdgeLoop LiveWire::edge_loop(const Edge& edge, std::span<const std::int32_t> stops) const {
  const std::shared_ptr<const Surface> surface = impl_->context.peek_surface();
  check_along_edges(impl_->settings, "edge loops are found");
  check_edge(surface.get(), edge);
  const auto adjacency = surface ? impl_->context.peek_edge_adjacency() : nullptr;
  return adjacency ? seamwire::edge_loop(*adjacency, edge, stops) : EdgeLoop{};
}

FittedChain LiveWire::fit_chain(const DrawnLine& line, std::optional<std::int32_t> begin,
                                std::optional<std::int32_t> end, const Task& task) const {
  check_along_edges(impl_->settings, "lines are fitted");
  const std::shared_ptr<const Surface> surface = impl_->context.peek_surface();
  const auto adjacency = surface ? impl_->context.peek_edge_adjacency() : nullptr;
  return adjacency ? seamwire::fit_chain(*surface, *adjacency, line, begin, end, task) : FittedChain{};
}

std::shared_ptr<const std::vector<double>> LiveWire::feature_strength() const {
  impl_->context.peek_surface();
  return impl_->context.peek_feature_strength();
}

std::vector<std::optional<LiveEmbedding>> LiveWire::embeddings() const {
  impl_->context.peek_surface();
  const std::shared_ptr<MetricSet> metrics = impl_->now().metrics;
  std::vector<std::optional<LiveEmbedding>> found(metrics->count());
  for (std::size_t i = 0; i < found.size(); ++i) {
    const std::shared_ptr<const Prepared> prepared = metrics->peek(i);
    if (!prepared || !prepared->embedded) continue;
    const Embedding& embedding = prepared->embedded->embedding();
    found[i] = {.invalid_left = embedding.invalid_left,
                .hit_cap = embedding.hit_cap,
                .clamped_edges = embedding.clamped_edges,
                .worst_clamp = embedding.worst_clamp};
  }
  return found;
}

double LiveWire::progress() const {
  impl_->context.peek_surface();
  const Impl::State state = impl_->now();
  const std::size_t count = state.metrics->count();
  double sum = 0.0;
  for (std::size_t i = 0; i < count; ++i) sum += state.workers[i]->progress();
  return sum / static_cast<double>(count);
}

bool LiveWire::wait(double seconds) const {
  const Deadline deadline = deadline_after(seconds);
  const Impl::State state = impl_->now();
  // One after the other: what is idle stays so, unless some thread gives it something to do meanwhile.
  bool are_idle = true;
  for (const auto& worker : state.workers) are_idle = worker->wait_until_idle(deadline) && are_idle;
  impl_->rethrow(state, true);
  return are_idle;
}

bool LiveWire::wait_for_surface(double seconds) const { return impl_->context.wait_for_surface(seconds); }

}  // namespace seamwire
