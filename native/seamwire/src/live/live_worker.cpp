// SPDX-License-Identifier: GPL-3.0-or-later
#include "live/live_worker.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <mutex>
#include <utility>

#include "seamwire/edges/shortest_cycle.hpp"
#include "surface/real_edges.hpp"

namespace seamwire::detail {
namespace {

/// Fraction of a wire's work, that of its seed included, at which its refinement begins.
constexpr double kRefinementBegins = 0.99;

/// Over so many faces a wire is traced and snapped to edges within a few milliseconds.
constexpr std::size_t kMostFacesAtOnce = 100'000;

double loop_turning_for(std::size_t edges) { return std::max(20.0, std::sqrt(static_cast<double>(edges)) / 4.0); }

}  // namespace

LiveWorker::LiveWorker(std::size_t which, const SurfaceContext& context, std::shared_ptr<MetricSet> metrics,
                       const LiveSettings& settings, std::shared_ptr<RightOfWay> right_of_way)
    : which_(which),
      context_(context),
      settings_(settings),
      is_large_(settings.along == Along::kSurface && context.face_count() > kMostFacesAtOnce),
      right_of_way_(std::move(right_of_way)),
      solver_(which, context, settings, right_of_way_, targets_) {
  seeds_.post({.metrics = std::move(metrics), .preparing = {}, .seed = std::nullopt});
  tell_right_of_way();
  thread_ = std::jthread([this] { run(); });
}

LiveWorker::~LiveWorker() {
  request_stop();
  thread_.join();
  if (tracer_) tracer_->join();
}

void LiveWorker::request_stop() {
  quit_.request_stop();
  std::stop_source preparing = seeds_.newest()->preparing;
  preparing.request_stop();
  seeds_.close();
  targets_.close();
  loops_.close();
  traces_.close();
  tell_right_of_way();
  events_.add();
}

void LiveWorker::change_metric(std::shared_ptr<MetricSet> metrics) {
  const std::shared_ptr<const SeedRequest> before = seeds_.newest();
  SeedRequest request = *before;
  if (!metrics->shares(*before->metrics, which_)) {
    request.preparing.request_stop();
    request.preparing = std::stop_source();
  }
  request.metrics = std::move(metrics);
  seeds_.post(std::move(request), SeedBox::Former::kKeep);
  targets_.withdraw();  // until it is asked for again; after the post, so that no work for the former metric is left
  loops_.withdraw();    // what is found in the former metric answers nothing
  traces_.withdraw();
  tell_right_of_way();
  events_.add(before);
}

void LiveWorker::seed(const WireEnd& seed, bool forward) {
  const std::shared_ptr<const SeedRequest> before = seeds_.newest();
  seeds_.post({.metrics = before->metrics, .preparing = before->preparing, .seed = seed, .is_forward = forward});
  targets_.withdraw();  // after the post, so that no work for the former seed is left
  traces_.withdraw();
  loops_.interrupt();
  tell_right_of_way();
}

LiveWorker::Known LiveWorker::wire(const WireEnd& target) {
  const std::shared_ptr<const WireEnd> before = targets_.newest();
  if (!before || *before != target) targets_.post(target);
  const bool needs_refining = refines();  // before the answer is read, which may be of a metric that needs it
  SeedBox::Reading found = seeds_.read();
  if (found.is_newest && traces_.newest()) traces_.withdraw();  // with the former solution
  const TargetBox::Reading known = targets_.read();
  // Another thread may have asked for another target meanwhile.
  const bool is_known = known.is_newest && known.answer->target == target &&
                        known.answer->seed_number == seeds_.number() &&
                        (known.answer->candidate.solved || !found.is_newest);
  if (is_known) {
    seeds_.give_back(std::move(found.answer));
    return {.candidate = known.answer->candidate, .first_length = known.answer->first_length};
  }
  if (!found.answer) return {};
  const bool is_solved = found.is_newest && found.answer->is_final(target);  // before it is looked up
  std::optional<LiveCandidate> candidate;
  if (!is_large_) {
    candidate = candidate_of(*found.answer, target, {});
  } else if (!found.is_newest) {
    candidate = traced(found.answer, target);
  }
  seeds_.give_back(std::move(found.answer));
  if (!candidate) {  // a preview will do meanwhile
    const bool is_previewed =
        known.is_newest && known.answer->target == target && known.answer->seed_number == seeds_.number();
    return is_previewed ? Known{known.answer->candidate, known.answer->first_length} : Known{};
  }
  candidate->solved = is_solved;
  candidate->final = is_solved && !needs_refining;
  const double length = candidate->length;
  return {.candidate = std::move(candidate), .first_length = length};
}

/// The candidate of a former solution, which the second thread traces; nullopt until then.
std::optional<LiveCandidate> LiveWorker::traced(const std::shared_ptr<const SeedSolution>& solution,
                                                const WireEnd& target) {
  TraceRequest request{.solution = solution, .target = target};
  if (const auto newest = traces_.newest(); !newest || *newest != request) {
    traces_.post(request);
    std::call_once(begin_tracing_, [this] { tracer_.emplace([this] { run_tracer(); }); });
  }
  const TraceBox::Reading found = traces_.read();
  return found.answers(request) ? std::optional(*found.answer) : std::nullopt;
}

void LiveWorker::run_tracer() {
  while (!quit_.stop_requested()) {
    const std::uint64_t seen = events_.count();
    if (const std::optional<TraceBox::Job> job = traces_.take()) {
      traces_.answer(*job, [&] {
        const Task task{.stop = job->stop, .progress = {}};
        return std::make_shared<const LiveCandidate>(candidate_of(*job->request->solution, job->request->target, task));
      });
    } else if (!quit_.stop_requested()) {
      events_.wait_beyond(seen);
    }
  }
}

/// Euclidean lengths are exact in any embedding, and wires along edges have no embedding.
bool LiveWorker::refines() const {
  if (settings_.along != Along::kSurface || settings_.max_error == 0) return false;
  const std::shared_ptr<const SeedRequest> newest = seeds_.newest();
  const std::vector<MetricSpec>& metrics = newest->metrics->metrics.wires;
  return which_ < metrics.size() && metrics[which_].family != MetricFamily::kEuclidean;
}

bool LiveWorker::works_on_targets() const {
  return refines() || (is_large_ && which_ < seeds_.newest()->metrics->count());
}

void LiveWorker::find_loop(const LoopPlace& through) {
  const std::shared_ptr<const LoopPlace> newest = loops_.newest();
  if (newest && *newest == through) return;
  // What takes time is what they have in common: it goes on, however fast the second point moves.
  const auto *before = std::get_if<BendPlace>(newest.get()), *now = std::get_if<BendPlace>(&through);
  const bool is_same_cut =
      before != nullptr && now != nullptr && before->through == now->through && before->cut == now->cut;
  loops_.post(through, LoopBox::Former::kDrop, is_same_cut ? LoopBox::Running::kGoOn : LoopBox::Running::kStop);
}

std::optional<EdgeChain> LiveWorker::loop(const Edge& through) const {
  const LoopBox::Reading found = loops_.read();
  return found.answers(through) ? std::optional(std::get<EdgeChain>(*found.answer)) : std::nullopt;
}

LiveClosedWires LiveWorker::closed_wires(const LoopPlace& through) const {
  const LoopBox::Reading found = loops_.read();
  return found.answers(through) ? std::get<LiveClosedWires>(*found.answer) : LiveClosedWires{};
}

double LiveWorker::progress() const {
  if (!seeds_.is_finished()) return solver_.progress(*seeds_.newest());
  return is_wire_finished() ? 1.0 : kRefinementBegins;
}

std::exception_ptr LiveWorker::error() const {
  for (const std::exception_ptr& error : {seeds_.error(), targets_.error(), traces_.error()}) {
    if (error) return error;
  }
  return nullptr;
}

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
  while (!quit_.stop_requested()) {
    const std::uint64_t seen = events_.count();
    if (!work() && !quit_.stop_requested()) events_.wait_beyond(seen);
  }
}

/// Does one job; returns false if no job waits.
bool LiveWorker::work() {
  if (!events_.take_discards().empty()) return true;
  if (const std::optional<SeedBox::Job> job = seeds_.take()) {
    work_on(*job);
    return true;
  }
  if (works_on_targets()) {
    if (const std::optional<TargetBox::Job> job = targets_.take()) {
      // A seed that came before the target was taken did not stop it.
      if (seeds_.is_finished()) work_on(*job);
      return true;
    }
  }
  const std::optional<LoopBox::Job> job = loops_.take();
  if (!job) return false;
  if (seeds_.is_finished()) work_on(*job);
  return true;
}

void LiveWorker::work_on(const SeedBox::Job& job) {
  closed_cuts_ = std::nullopt;  // which may hold a former metric
  seeds_.answer(job, [&] {
    context_.surface({.stop = quit_.get_token(), .progress = {}});  // no other seed or metric stops it
    return solver_.solve(job, seeds_.read().answer, seeds_);
  });
  tell_right_of_way();
}

void LiveWorker::work_on(const TargetBox::Job& job) {
  const SeedBox::Reading found = seeds_.read();
  targets_.answer(job, [&]() -> std::shared_ptr<const TargetWire> {
    if (!found.answer) return nullptr;
    std::function<void(TargetWire)> show;
    if (is_large_) {
      show = [&](TargetWire wire) { targets_.show(job, std::make_shared<const TargetWire>(std::move(wire))); };
    }
    return std::make_shared<const TargetWire>(solver_.refine(found, *job.request, refines(), show, job.stop));
  });
}

void LiveWorker::work_on(const LoopBox::Job& job) {
  loops_.answer(job, [&] { return std::make_shared<const LoopAnswer>(find_closed(job)); });
}

LoopAnswer LiveWorker::find_closed(const LoopBox::Job& job) {
  if (const auto* edge = std::get_if<Edge>(job.request.get())) return find_cycle(*edge, job.stop);
  if (!closed_cuts_) closed_cuts_.emplace(context_, seeds_.newest()->metrics);
  if (const auto* place = std::get_if<BendPlace>(job.request.get())) return closed_cuts_->bent(*place, job.stop);
  const auto show = [&](LiveClosedWires found) {
    loops_.show(job, std::make_shared<const LoopAnswer>(std::move(found)));
  };
  return closed_cuts_->through(std::get<WireEnd>(*job.request), job.stop, show);
}

EdgeChain LiveWorker::find_cycle(const Edge& edge, const std::stop_token& stop) const {
  const std::shared_ptr<const Surface> surface = context_.peek_surface();
  const std::shared_ptr<const Prepared> prepared = seeds_.newest()->metrics->peek(which_);
  if (!prepared || !has_edge(*surface, edge)) return {};  // error() says why, or LiveWire::loop() refuses the edge
  const double turning = settings_.loop_turning.value_or(loop_turning_for(surface->edges().size()));
  return shortest_cycle(*prepared->graph, edge, turning, {.stop = stop, .progress = {}}).value_or(EdgeChain{});
}

/// To be called after each change of what it tells.
void LiveWorker::tell_right_of_way() {
  if (which_ != 0) return;
  right_of_way_->update([this] {
    const std::shared_ptr<const SeedRequest> newest = seeds_.newest();
    const bool leads = newest->seed && newest->metrics->first_leads();
    return leads && !quit_.stop_requested() && !seeds_.is_finished();
  });
}

}  // namespace seamwire::detail
