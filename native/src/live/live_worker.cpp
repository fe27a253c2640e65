// SPDX-License-Identifier: GPL-3.0-or-later
#include "live/live_worker.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "seamwire/edges/shortest_cycle.hpp"
#include "surface/real_edges.hpp"

namespace seamwire::detail {
namespace {

double loop_turning_for(std::size_t edges) { return std::max(20.0, std::sqrt(static_cast<double>(edges)) / 4.0); }

}  // namespace

LiveWorker::LiveWorker(std::size_t which, std::shared_ptr<SurfaceCache> surface_cache,
                       std::shared_ptr<MetricSet> metrics, const LiveSettings& settings,
                       std::shared_ptr<RightOfWay> right_of_way)
    : which_(which),
      surface_cache_(std::move(surface_cache)),
      settings_(settings),
      has_right_of_way_(which + 1 == kMostMetrics),
      right_of_way_(std::move(right_of_way)),
      solver_(which, surface_cache_, settings, right_of_way_, targets_) {
  seeds_.post({.metrics = std::move(metrics), .preparing = {}, .seed = std::nullopt});
  tell_right_of_way();
  thread_ = std::jthread([this] { run(); });
}

LiveWorker::~LiveWorker() {
  request_stop();
  thread_.join();
}

void LiveWorker::request_stop() {
  quit_.request_stop();
  std::stop_source preparing = seeds_.newest()->preparing;
  preparing.request_stop();
  seeds_.close();
  loops_.close();
  tell_right_of_way();
  events_.add();
}

void LiveWorker::change_metric(std::shared_ptr<MetricSet> metrics) {
  const std::shared_ptr<const SeedRequest> before = seeds_.newest();
  SeedRequest request = *before;
  if (metrics->prepared[which_] != before->metrics->prepared[which_]) {
    request.preparing.request_stop();
    request.preparing = std::stop_source();
  }
  request.metrics = std::move(metrics);
  seeds_.post(std::move(request), SeedBox::Former::kKeep);
  loops_.withdraw();  // what is found in the former metric answers nothing
  tell_right_of_way();
  discards_.add(before);
}

void LiveWorker::seed(const WireEnd& seed, bool forward) {
  const std::shared_ptr<const SeedRequest> before = seeds_.newest();
  targets_.withdraw();
  seeds_.post({.metrics = before->metrics, .preparing = before->preparing, .seed = seed, .is_forward = forward});
  loops_.interrupt();
  tell_right_of_way();
}

LiveWorker::Snapshot LiveWorker::snapshot(const WireEnd& target) {
  const std::shared_ptr<const WireEnd> before = targets_.newest();
  if (!before || *before != target) targets_.post(target);
  const SeedBox::Reading found = seeds_.read();
  Snapshot now{.solution = found.answer, .is_newest = found.is_newest, .preview = nullptr};
  if (now.is_newest) return now;
  const TargetBox::Reading preview = targets_.read();
  if (preview.is_newest && preview.answer->seed_number == seeds_.number()) {
    now.preview = {preview.answer, &preview.answer->candidate};
  }
  return now;
}

void LiveWorker::find_loop(const LoopPlace& through) {
  const std::shared_ptr<const LoopPlace> newest = loops_.newest();
  if (newest && *newest == through) return;
  // What takes time is what they have in common: it goes on, however fast the second point moves.
  const auto *before = std::get_if<BendPlace>(newest.get()), *now = std::get_if<BendPlace>(&through);
  const bool is_same_cut =
      before != nullptr && now != nullptr && before->through == now->through && before->which == now->which;
  loops_.post(through, LoopBox::Former::kDrop, is_same_cut ? LoopBox::Running::kGoOn : LoopBox::Running::kStop);
}

std::optional<EdgeChain> LiveWorker::loop() const {
  const LoopBox::Reading found = loops_.read();
  if (!found.is_finished) return std::nullopt;
  return found.answer ? std::get<EdgeChain>(*found.answer) : EdgeChain{};
}

LiveClosedWires LiveWorker::closed_wires() const {
  const LoopBox::Reading found = loops_.read();
  if (!found.is_newest) return {.cuts = {}, .final = found.is_finished};
  return std::get<LiveClosedWires>(*found.answer);
}

double LiveWorker::progress() const { return seeds_.is_finished() ? 1.0 : solver_.progress(*seeds_.newest()); }

std::exception_ptr LiveWorker::loop_error() const {
  const std::exception_ptr error = seeds_.error();
  return error ? error : loops_.error();
}

bool LiveWorker::wait_until_idle(const Deadline& deadline) const {
  for (;;) {
    const std::uint64_t seen = events_.count();
    if (is_idle()) return true;
    if (!events_.wait_beyond(seen, deadline)) return is_idle();
  }
}

void LiveWorker::run() {
  if (!build_surface()) return;
  while (!quit_.stop_requested()) {
    const std::uint64_t seen = events_.count();
    if (!work() && !quit_.stop_requested()) events_.wait_beyond(seen);
  }
}

/// Or waits for the thread that does; false if there is no surface, or no more time for it.
bool LiveWorker::build_surface() {
  try {
    surface_cache_->surface_now(quit_.get_token());
    return true;
  } catch (...) {
    // Cancelled, to end; the cache has all other errors.
    has_failed_ = true;
    tell_right_of_way();
    events_.add();
    return false;
  }
}

/// Does one job; false if there is none.
bool LiveWorker::work() {
  if (!discards_.take().empty()) return true;
  if (const std::optional<SeedBox::Job> job = seeds_.take()) {
    work_on(*job);
    return true;
  }
  const std::optional<LoopBox::Job> job = loops_.take();
  if (!job) return false;
  // A seed that came before the loop was taken did not interrupt it.
  if (seeds_.is_finished()) work_on(*job);
  return true;
}

void LiveWorker::work_on(const SeedBox::Job& job) {
  closed_cuts_ = std::nullopt;  // which may hold a former metric
  seeds_.answer(job, [&] { return solver_.solve(job, seeds_.read().answer, seeds_); });
  tell_right_of_way();
}

void LiveWorker::work_on(const LoopBox::Job& job) {
  loops_.answer(job, [&] { return std::make_shared<const LoopAnswer>(find_closed(job)); });
}

LoopAnswer LiveWorker::find_closed(const LoopBox::Job& job) {
  if (const auto* edge = std::get_if<Edge>(job.request.get())) return find_cycle(*edge, job.stop);
  if (!closed_cuts_) closed_cuts_.emplace(surface_cache_, seeds_.newest()->metrics);
  if (const auto* place = std::get_if<BendPlace>(job.request.get())) return closed_cuts_->bent(*place, job.stop);
  const auto show = [&](LiveClosedWires found) {
    loops_.show(job, std::make_shared<const LoopAnswer>(std::move(found)));
  };
  return closed_cuts_->through(std::get<WireEnd>(*job.request), job.stop, show);
}

EdgeChain LiveWorker::find_cycle(const Edge& edge, const std::stop_token& stop) const {
  const Surface& surface = surface_cache_->surface();
  const std::shared_ptr<const Prepared> prepared = seeds_.newest()->metrics->prepared[which_]->peek();
  if (!prepared || !has_edge(surface, edge)) return {};  // error() says why, or LiveWire::loop() refuses the edge
  const double turning = settings_.loop_turning.value_or(loop_turning_for(surface.edges().size()));
  return shortest_cycle(*prepared->graph, edge, turning, {.stop = stop, .progress = {}});
}

/// To be called after each change of what it tells. Then the last call tells what is true.
void LiveWorker::tell_right_of_way() {
  if (!has_right_of_way_) return;
  const MutexLock lock(right_of_way_mutex_);
  const bool has_metric = which_ < seeds_.newest()->metrics->count;
  right_of_way_->set_busy(has_metric && !has_failed_ && !quit_.stop_requested() && !seeds_.is_finished());
}

}  // namespace seamwire::detail
