// SPDX-License-Identifier: GPL-3.0-or-later
#include "seams/candidate_wires.hpp"

#include <algorithm>
#include <atomic>
#include <utility>

#include "context/interactive_embedding.hpp"
#include "detail/infinity.hpp"
#include "detail/poll.hpp"
#include "detail/run_on_threads.hpp"
#include "seamwire/geodesics/corridor_paths.hpp"
#include "seamwire/metric/metric_spec.hpp"
#include "seamwire/wires/snap.hpp"
#include "seamwire/wires/wire.hpp"

namespace seamwire::detail {

CandidateWires::CandidateWires(const SurfaceContext& context, const Strength& strength, const Task& task)
    : context_(context) {
  constexpr double kEmbeddingBegins = 0.2;
  context_.curvature(part_of(task, 0.0, kEmbeddingBegins));  // both metrics need it
  std::array<std::atomic<double>, 2> fractions = {};
  run_on_threads(
      metrics_.size(), part_of(task, kEmbeddingBegins, 1.0),
      [&](std::size_t) { return 0.5 * (fractions[0] + fractions[1]); },
      [&](std::size_t i, const Task& own) {
        const Task whole{.stop = own.stop, .progress = [&, i](double done) {
                           fractions[i] = done;
                           return true;
                         }};
        const MetricSpec spec = MetricSpec::feature(i == 0 ? Follow::kMin : Follow::kMax, strength);
        metrics_[i].emplace(context_, spec, interactive_options(*context_.surface(own)), part_of(whole, 0.0, 0.6));
        metrics_[i]->geodesics(part_of(whole, 0.6, 1.0));
      });
  most_points_ = metrics_[0]->surface().vertex_count();
}

std::vector<PlannedWire> CandidateWires::find(std::span<const Ends> ends, const Task& task) const {
  std::vector<PlannedWire> wires(ends.size());
  std::vector<std::size_t> missing;
  {
    const MutexLock lock(mutex_);
    for (std::size_t i = 0; i < ends.size(); ++i) {
      const auto known = kept_.find(ends[i]);
      if (known != kept_.end()) {
        wires[i] = known->second;
      } else {
        missing.push_back(i);
      }
    }
  }
  std::vector<std::array<Found, 2>> found(missing.size());
  const auto all = static_cast<double>(std::max<std::size_t>(2 * missing.size(), 1));
  run_on_threads(
      2 * missing.size(), task, [&](std::size_t done) { return static_cast<double>(done) / all; },
      [&](std::size_t i, const Task& own) { found[i / 2][i % 2] = find_in(i % 2, ends[missing[i / 2]], own); });
  const MutexLock lock(mutex_);
  for (std::size_t i = 0; i < missing.size(); ++i) {
    auto& [one, other] = found[i];
    wires[missing[i]] = std::move(other.length < one.length ? other.wire : one.wire);
    keep(ends[missing[i]], wires[missing[i]]);
  }
  return wires;
}

std::size_t CandidateWires::kept_points() const {
  const MutexLock lock(mutex_);
  return kept_points_;
}

CandidateWires::Found CandidateWires::find_in(std::size_t metric, const Ends& ends, const Task& task) const {
  const EmbeddedSurface& on = *metrics_[metric];
  CorridorPaths paths(on.geodesics(), ends.from);
  const std::optional<IntrinsicPath> path = paths.path(ends.to, task);
  const Follow follow = metric == 0 ? Follow::kMin : Follow::kMax;
  if (!path) {
    return {{.from = ends.from, .to = ends.to, .follow = follow, .vertices = {}, .points = {}, .faces = {}}, kInfinity};
  }
  Wire wire = map_wire(on.surface(), on.embedding(), *path);
  wire.from = ends.from;
  wire.to = ends.to;
  std::vector<std::int32_t> vertices = snap_to_edges(on.surface(), wire, task);
  return {{.from = ends.from,
           .to = ends.to,
           .follow = follow,
           .vertices = std::move(vertices),
           .points = std::move(wire.points),
           .faces = std::move(wire.faces)},
          wire.length};
}

/// Keeps a wire. All others are dropped if there are too many points otherwise.
void CandidateWires::keep(const Ends& ends, const PlannedWire& wire) const {
  const std::size_t points = std::max<std::size_t>(wire.points.size(), 1);
  if (kept_points_ + points > most_points_) {
    kept_.clear();
    kept_points_ = 0;
  }
  if (points > most_points_ || !kept_.emplace(ends, wire).second) return;
  kept_points_ += points;
}

}  // namespace seamwire::detail
