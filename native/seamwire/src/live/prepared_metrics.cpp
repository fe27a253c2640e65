// SPDX-License-Identifier: GPL-3.0-or-later
#include "live/prepared_metrics.hpp"

#include <algorithm>
#include <utility>

#include "context/interactive_embedding.hpp"
#include "embedding/bisected_mesh.hpp"
#include "metric/scribble_points.hpp"
#include "surface/exact_unit.hpp"

namespace seamwire::detail {
namespace {

bool are_same_for(MetricKind kind, const std::vector<Scribble>& these, const std::vector<Scribble>& those) {
  const auto acts = [kind](const Scribble& scribble) { return scribble.changes(kind); };
  auto other = those.begin();
  for (const Scribble& scribble : these) {
    if (!acts(scribble)) continue;
    other = std::find_if(other, those.end(), acts);
    if (other == those.end() || !(*other++ == scribble)) return false;
  }
  return std::none_of(other, those.end(), acts);
}

/// Whether scribbles, which must all be right, change a metric.
bool is_scribbled(const Surface& surface, const std::vector<Scribble>& scribbles, MetricKind kind) {
  bool acts = false;
  for (std::size_t i = 0; i < scribbles.size(); ++i) {
    check_scribble(surface, scribbles[i], i);
    acts |= scribbles[i].changes(kind);
  }
  return acts;
}

/// Embedding::mean_edge_length of a metric.
double mean_edge_length(const Surface& surface, const Metric& metric, const Task& task) {
  const EmbedOptions options{.max_error = 0};
  return BisectedMesh(EmbeddingInput(surface, metric, options), task, 0.0).mean_edge_length() / exact_unit(surface);
}

}  // namespace

MetricSet::MetricSet(LiveMetrics of, std::vector<Scribble> after)
    : metrics(std::move(of)), scribbles(std::move(after)), fractions(count()), former_(count()) {
  prepared.reserve(count());
  for (std::size_t i = 0; i < count(); ++i) prepared.push_back(std::make_shared<ComputedOnce<Prepared>>());
  for (std::shared_ptr<std::atomic<double>>& fraction : fractions)
    fraction = std::make_shared<std::atomic<double>>(0.0);
}

MetricSet::MetricSet(LiveMetrics of, std::vector<Scribble> after, const MetricSet& former)
    : MetricSet(std::move(of), std::move(after)) {
  for (std::size_t i = 0; i < count(); ++i) {
    const MetricSpec& spec = metrics.wires[i];
    const auto same = std::ranges::find(former.metrics.wires, spec);
    if (same == former.metrics.wires.end()) continue;
    const auto at = static_cast<std::size_t>(same - former.metrics.wires.begin());
    // In this order: what is former is forgotten only when the metric is prepared.
    std::shared_ptr<const Prepared> from = former.former(at);
    if (std::shared_ptr<const Prepared> made = former.peek(at)) from = std::move(made);
    const bool may_share = at == i || former.peek(at) != nullptr;
    if (may_share && are_same_for(spec.kind(), scribbles, former.scribbles)) {
      prepared[i] = former.prepared[at];
      fractions[i] = former.fractions[at];
    }
    const MutexLock lock(mutex_);
    former_[i] = std::move(from);
  }
}

bool MetricSet::first_leads() const {
  const MetricSpec& first = metrics.wires.front();
  return std::ranges::none_of(metrics.wires, [&](const MetricSpec& other) { return is_counterpart(first, other); });
}

std::shared_ptr<const Prepared> MetricSet::peek(std::size_t metric) const {
  return metric < count() ? prepared[metric]->peek() : nullptr;
}

double MetricSet::fraction(std::size_t metric) const {
  return metric < count() ? std::clamp(fractions[metric]->load(), 0.0, 1.0) : 0.0;
}

bool MetricSet::shares(const MetricSet& other, std::size_t metric) const {
  return metric < std::min(count(), other.count()) && prepared[metric] == other.prepared[metric];
}

std::shared_ptr<const Prepared> MetricSet::former(std::size_t metric) const {
  const MutexLock lock(mutex_);
  return former_[metric];
}

void MetricSet::forget_former(std::size_t metric) {
  std::shared_ptr<const Prepared> dropped;  // freed without the lock
  const MutexLock lock(mutex_);
  dropped.swap(former_[metric]);
}

Prepared prepare(const SurfaceContext& context, Along along, MetricSet& metrics, std::size_t which,
                 const std::stop_token& stop, const PreparationSteps& steps) {
  const MetricSpec& spec = metrics.metrics.wires[which];
  const bool on_surface = along == Along::kSurface;
  const Task silent{.stop = stop, .progress = {}};
  const std::shared_ptr<const Surface> surface = context.surface(silent);
  std::atomic<double>& fraction = *metrics.fractions[which];
  Prepared prepared{.spec = spec, .surface = surface, .embedded = std::nullopt, .graph = nullptr};
  std::shared_ptr<const EdgeAdjacency> adjacency;
  // The second metric does this while the thread of the first one computes the curvatures.
  if (!on_surface && which == 1) adjacency = context.edge_adjacency(silent);
  context.curvature(silent);
  if (!on_surface && which != 1) adjacency = context.edge_adjacency(silent);
  const bool scribbled = is_scribbled(*surface, metrics.scribbles, spec.kind());
  EmbedOptions options = interactive_options(*surface);
  if (on_surface && !scribbled) prepared.embedded = EmbeddedSurface::find(context, spec, options);
  if (prepared.embedded) {
    prepared.embedded->points();
    prepared.embedded->geodesics(silent);
    fraction = 1.0;
    return prepared;
  }
  std::shared_ptr<const Metric> from_scratch;  // a former embedding is changed at once
  const auto preview = [&] {
    if (from_scratch) steps.preview(prepared, from_scratch);
  };
  const Task task{.stop = stop, .progress = [&](double done) {
                    fraction = (kEmbedBegins + (kSolveBegins - kEmbedBegins) * done) / kSolveBegins;
                    preview();
                    steps.make_way(preview);
                    return true;
                  }};
  Metric own = make_metric(context, spec, silent);
  if (scribbled) {
    // So that wires are the same whether the scribbles came before the metric was prepared or after, see re_embed().
    if (on_surface && !metrics.former(which)) options.mean_edge_length = mean_edge_length(*surface, own, silent);
    own = apply_scribbles(*surface, own, metrics.scribbles, spec.kind(), silent);
  }
  if (!on_surface) {
    prepared.graph = make_edge_graph(*surface, own, std::move(adjacency), metrics.scribbles, spec.kind(), task);
    return prepared;
  }
  const auto metric = std::make_shared<const Metric>(std::move(own));
  const std::shared_ptr<const Prepared> former = metrics.former(which);
  if (!former) from_scratch = metric;
  preview();
  steps.make_way(preview);
  std::optional<EmbeddedSurface> embedded;  // previews get the rest meanwhile
  if (former) {
    embedded = former->embedded->with_metric(metric, task);
  } else if (scribbled) {
    embedded.emplace(context, metric, options, task);
  } else {
    embedded = embedded_in(context, spec, metric, options, task);
  }
  embedded->points();
  // Whoever finds the embedding waits for its geodesics.
  embedded->geodesics({.stop = stop, .progress = [&](double) {
                         preview();
                         return true;
                       }});
  prepared.embedded = std::move(embedded);
  return prepared;
}

}  // namespace seamwire::detail
