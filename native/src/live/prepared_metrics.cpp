// SPDX-License-Identifier: GPL-3.0-or-later
#include "live/prepared_metrics.hpp"

#include <algorithm>
#include <utility>

namespace seamwire::detail {
namespace {

/// An artist waits for an embedding, and one that runs away is better cut short: at most so many times the surface's
/// triangles are added, but no fewer than the first number and no more than the last.
constexpr std::size_t kLeastFacesAdded = 200'000, kFacesAddedPerFace = 12, kMostFacesAdded = 1'000'000;

/// Of concave_metric(), whose parameter is `unit` times its strength.
double concave_strength(const Strength& strength, double unit) {
  return strength.parameter ? *strength.parameter / unit : (*strength.max_anisotropy - 1.0) / (kConcaveUnit - 1.0);
}

Metric make_metric(SurfaceCache& surface_cache, const Curvature& curvature, Follow follow, const MetricSet& metrics,
                   const Task& task) {
  const Surface& surface = surface_cache.surface();
  const auto concave = [&](double unit) {
    return concave_metric(surface, *surface_cache.smoothed_curvatures_now(task.stop),
                          concave_strength(metrics.strength, unit), task);
  };
  switch (metrics.family) {
    case MetricFamily::kFeature:
      if (follow == Follow::kConcave) return concave(kConcaveGamma);
      return feature_metric(surface, curvature, follow, metrics.strength, task);
    case MetricFamily::kCampen:
      return campen_metric(surface, curvature, follow, metrics.strength, task);
    case MetricFamily::kPottmannKovacs:
      return pottmann_kovacs_metric(surface, curvature, follow, metrics.strength, task);
    case MetricFamily::kConcave:
      if (follow == Follow::kMax) break;
      return concave(1.0);
    case MetricFamily::kEuclidean:
      break;
  }
  return euclidean_metric(surface, curvature, task);
}

bool are_same_for(Follow follow, const std::vector<Scribble>& these, const std::vector<Scribble>& those) {
  const auto acts = [follow](const Scribble& scribble) { return scribble.acts_on(follow); };
  auto other = those.begin();
  for (const Scribble& scribble : these) {
    if (!acts(scribble)) continue;
    other = std::find_if(other, those.end(), acts);
    if (other == those.end() || !(*other++ == scribble)) return false;
  }
  return std::none_of(other, those.end(), acts);
}

}  // namespace

SurfaceCache::SurfaceCache(std::shared_ptr<const Surface> on)
    : vertex_count(on->vertex_count()), face_count(on->face_count()) {
  built_.get({}, [&] { return std::move(on); });
}

SurfaceCache::SurfaceCache(std::vector<Vector> points, std::vector<Triangle> triangles,
                           std::optional<std::vector<Edge>> edges)
    : vertex_count(points.size()),
      face_count(triangles.size()),
      input_(Input{.points = std::move(points), .triangles = std::move(triangles), .edges = std::move(edges)}) {}

std::shared_ptr<const Surface> SurfaceCache::surface_now(const std::stop_token& stop) {
  return *built_.get(stop, [&] {
    // Copied: where this is stopped, another live wire may build the surface.
    auto surface = std::make_shared<const Surface>(input_->points, input_->triangles, input_->edges,
                                                   Task{.stop = stop, .progress = {}});
    input_.reset();
    return surface;
  });
}

void MetricSet::go_on_from(const MetricSet& metrics) {
  for (std::size_t which = 0; which < count; ++which) {
    // In this order: what is former is forgotten only when the metric is prepared.
    std::shared_ptr<const Prepared> from = metrics.former(which);
    if (std::shared_ptr<const Prepared> made = metrics.prepared[which]->peek()) from = std::move(made);
    if (are_same_for(kFollow[which], scribbles, metrics.scribbles)) prepared[which] = metrics.prepared[which];
    const MutexLock lock(mutex_);
    former_[which] = std::move(from);
  }
}

Prepared prepare(SurfaceCache& surface_cache, Along along, MetricSet& metrics, std::size_t which,
                 const std::stop_token& stop, const std::function<void()>& make_way) {
  const bool on_surface = along == Along::kSurface;
  const Surface& surface = surface_cache.surface();
  std::atomic<double>& fraction = metrics.fractions[which];
  Prepared prepared;
  std::shared_ptr<const EdgeAdjacency> fans;
  const auto prepare_edges = [&] {
    if (on_surface) prepared.snap_graph = surface_cache.snap_graph_now(stop);
    fans = surface_cache.fans_now(stop);
  };
  if (which == 1) prepare_edges();  // while the other thread is at the curvatures
  const std::shared_ptr<const CurvatureCache> curvatures = surface_cache.curvatures_now(stop);
  if (which != 1) prepare_edges();
  make_way();
  Task task{.stop = stop, .progress = {}};
  Metric metric = make_metric(surface_cache, curvatures->curvature, kFollow[which], metrics, task);
  if (!metrics.scribbles.empty()) {
    metric = apply_scribbles(surface, metric, metrics.scribbles, kFollow[which], task);
  }
  fraction = kEmbedBegins / kSolveBegins;
  task.progress = [&](double done) {
    make_way();
    fraction = (kEmbedBegins + (kSolveBegins - kEmbedBegins) * done) / kSolveBegins;
    return true;
  };
  if (on_surface) {
    const std::size_t most = std::clamp(kFacesAddedPerFace * surface.face_count(), kLeastFacesAdded, kMostFacesAdded);
    const EmbedOptions options{.max_faces_added = most};
    const std::shared_ptr<const Prepared> former = metrics.former(which);
    prepared.embedding = std::make_shared<const Embedding>(
        former ? re_embed(surface, former->metric, metric, *former->embedding, options, task)
               : embed(surface, metric, options, task));
    prepared.points.emplace(surface, *prepared.embedding);
    const IntrinsicMesh& mesh = prepared.embedding->mesh;
    const Task silent{.stop = stop, .progress = {}};
    if (former) {
      prepared.geodesics.emplace(*former->geodesics, former->embedding->mesh, mesh, silent);
    } else {
      prepared.geodesics.emplace(mesh, silent);
    }
    prepared.metric = std::move(metric);
  } else {
    prepared.graph = make_edge_graph(surface, metric, std::move(fans), task, metrics.scribbles, kFollow[which]);
  }
  return prepared;
}

}  // namespace seamwire::detail
