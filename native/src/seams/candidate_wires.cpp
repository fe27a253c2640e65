// SPDX-License-Identifier: GPL-3.0-or-later
#include "seams/candidate_wires.hpp"

#include <algorithm>
#include <utility>

#include "detail/run_on_threads.hpp"
#include "seamwire/geodesics/corridor_paths.hpp"
#include "seamwire/wires/snap.hpp"
#include "seamwire/wires/wire.hpp"

namespace seamwire::detail {

CandidateWires::CandidateWires(std::shared_ptr<const Surface> surface, const Strength& strength, const Task& task)
    : surfaces_(std::make_unique<SurfaceCache>(std::move(surface))) {
  surfaces_->curvatures_now(task.stop);  // both metrics need them
  MetricSet metrics(MetricFamily::kFeature, Along::kSurface, strength, {});
  run_on_threads(
      metrics_.size(), task, [&](std::size_t) { return 0.5 * (metrics.fractions[0] + metrics.fractions[1]); },
      [&](std::size_t which, const Task& own) {
        metrics_[which] = prepare(*surfaces_, Along::kSurface, metrics, which, own.stop);
      });
}

std::vector<CandidateWire> CandidateWires::find(std::span<const Ends> ends, const Task& task) const {
  std::vector<std::array<Found, 2>> found(ends.size());
  const auto all = static_cast<double>(std::max<std::size_t>(2 * ends.size(), 1));
  run_on_threads(
      2 * ends.size(), task, [&](std::size_t done) { return static_cast<double>(done) / all; },
      [&](std::size_t i, const Task& own) { found[i / 2][i % 2] = find_in(i % 2, ends[i / 2], own); });
  std::vector<CandidateWire> wires;
  wires.reserve(found.size());
  for (auto& [one, other] : found) wires.push_back(std::move(other.length < one.length ? other.wire : one.wire));
  return wires;
}

CandidateWires::Found CandidateWires::find_in(std::size_t metric, const Ends& ends, const Task& task) const {
  const Prepared& prepared = metrics_[metric];
  CorridorPaths paths(*prepared.geodesics, ends.from);
  Wire wire = map_wire(surfaces_->surface(), *prepared.embedding, paths.path(ends.to, task));
  wire.from = ends.from;
  wire.to = ends.to;
  std::vector<std::int32_t> vertices = snap_to_edges(surfaces_->surface(), *prepared.snap_graph, wire, task);
  return {{.follow = kFollow[metric],
           .vertices = std::move(vertices),
           .points = std::move(wire.points),
           .faces = std::move(wire.faces)},
          wire.length};
}

}  // namespace seamwire::detail
