// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <atomic>
#include <exception>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <stop_token>
#include <utility>
#include <vector>

#include "detail/thread_safety.hpp"
#include "live/computed_once.hpp"
#include "seamwire/embedding/embedding.hpp"
#include "seamwire/geodesics/exact_geodesics.hpp"
#include "seamwire/live/livewire.hpp"
#include "seamwire/wires/embedded_points.hpp"

/// What a live wire computes before there is a seed, each part once, whoever asks for it first.
namespace seamwire::detail {

inline constexpr std::array kFollow = {Follow::kMin, Follow::kMax, Follow::kConcave};
/// How many metrics a live wire may have at once.
inline constexpr std::size_t kMostMetrics = kFollow.size();

/// Fractions of the first seed's work, preparation included, at which its parts begin.
inline constexpr double kEmbedBegins = 0.1, kSolveBegins = 0.5;

struct CurvatureCache {
  Curvature curvature;
  std::vector<double> difference;
};

/// The surface, and what it alone decides. Shared by forks and siblings.
struct SurfaceCache {
  explicit SurfaceCache(std::shared_ptr<const Surface> on);
  /// Of a surface that is still to be built: the arguments of its constructor.
  SurfaceCache(std::vector<Vector> points, std::vector<Triangle> triangles, std::optional<std::vector<Edge>> edges);

  /// The surface, built if need be; throws what its constructor throws. The other functions need it built.
  std::shared_ptr<const Surface> surface_now(const std::stop_token& stop);
  /// Null until it is built.
  std::shared_ptr<const Surface> peek_surface() const {
    const auto held = built_.peek();
    return held ? *held : nullptr;
  }
  const Surface& surface() const { return **built_.peek(); }
  /// Throws why there will be no surface, where that is known.
  void rethrow_failure() const {
    if (const std::exception_ptr error = built_.error()) std::rethrow_exception(error);
  }
  /// Until the surface is there, or known to be impossible.
  void wait_for_surface(const Deadline& deadline) const { built_.wait(deadline); }

  std::shared_ptr<const CurvatureCache> curvatures_now(const std::stop_token& stop) {
    return curvatures.get(stop, [&] {
      CurvatureCache made{.curvature = principal_curvatures(surface(), {.stop = stop, .progress = {}}),
                          .difference = {}};
      made.difference = made.curvature.difference();
      return made;
    });
  }
  /// Over a hundredth of the unit cube, as concave_metric() is best given them.
  std::shared_ptr<const Curvature> smoothed_curvatures_now(const std::stop_token& stop) {
    return smoothed_curvatures.get(stop, [&] {
      return seamwire::smoothed_curvatures(surface(), curvatures_now(stop)->curvature, 0.01,
                                           {.stop = stop, .progress = {}});
    });
  }
  std::shared_ptr<const SnapGraph> snap_graph_now(const std::stop_token& stop) {
    return snap_graph.get(stop, [&] { return SnapGraph(surface(), {.stop = stop, .progress = {}}); });
  }
  std::shared_ptr<const EdgeAdjacency> fans_now(const std::stop_token& stop) {
    const auto held = fans.get(stop, [&] { return make_edge_adjacency(surface(), {.stop = stop, .progress = {}}); });
    return *held;
  }

  const std::size_t vertex_count, face_count;
  ComputedOnce<CurvatureCache> curvatures;
  ComputedOnce<Curvature> smoothed_curvatures;
  ComputedOnce<SnapGraph> snap_graph;
  ComputedOnce<std::shared_ptr<const EdgeAdjacency>> fans;

 private:
  struct Input {
    std::vector<Vector> points;
    std::vector<Triangle> triangles;
    std::optional<std::vector<Edge>> edges;
  };

  std::optional<Input> input_;  // until the surface is built; only what builds it looks at it
  ComputedOnce<std::shared_ptr<const Surface>> built_;
};

/// What one metric needs for any seed: along edges the last, across the surface the others.
struct Prepared {
  Metric metric;
  std::shared_ptr<const Embedding> embedding;
  std::optional<EmbeddedPoints> points;
  std::optional<ExactGeodesics> geodesics;
  std::shared_ptr<const SnapGraph> snap_graph;
  std::shared_ptr<const EdgeGraph> graph;
};

/// How many metrics a family has: the Euclidean metric is the same whatever is followed.
constexpr std::size_t metric_count(MetricFamily of, Along along) {
  if (of == MetricFamily::kEuclidean) return 1;
  return of == MetricFamily::kFeature && along == Along::kSurface ? 3 : 2;
}

/// The metrics of one family and strength, after the scribbles; the first `count` of kFollow. Shared by forks.
struct MetricSet {
  MetricSet(MetricFamily of, Along along, const Strength& with, std::vector<Scribble> after)
      : family(of), strength(with), scribbles(std::move(after)), count(metric_count(of, along)) {
    for (auto& metric : prepared) metric = std::make_shared<ComputedOnce<Prepared>>();
  }

  /// Which of the metrics has the wire that is offered first, whichever is shorter.
  std::optional<std::size_t> leader() const {
    if (count == kMostMetrics) return kMostMetrics - 1;
    return family == MetricFamily::kConcave ? std::optional<std::size_t>(0) : std::nullopt;
  }
  /// The metrics whose closed wires are offered, those of the first one first: those of the Euclidean metric help out
  /// where nothing is concave.
  std::span<const std::size_t> closing() const {
    static constexpr std::array<std::size_t, 2> kBoth = {0, 1};
    return std::span(kBoth).first(family == MetricFamily::kConcave ? 2 : 1);
  }
  /// After other scribbles than these metrics, of one family and strength: a metric for which they are the same is
  /// shared. Embeddings of the other are made from those of `metrics`, or, where these are not there yet, from what
  /// they would have been made from: scribbles change little.
  void go_on_from(const MetricSet& metrics);
  std::shared_ptr<const Prepared> former(std::size_t which) const {
    const MutexLock lock(mutex_);
    return former_[which];
  }
  /// Once the metric is prepared.
  void forget_former(std::size_t which) {
    std::shared_ptr<const Prepared> dropped;  // freed without the lock
    const MutexLock lock(mutex_);
    dropped.swap(former_[which]);
  }

  const MetricFamily family;
  const Strength strength;
  const std::vector<Scribble> scribbles;
  const std::size_t count;
  std::array<std::shared_ptr<ComputedOnce<Prepared>>, kMostMetrics> prepared;
  std::array<std::atomic<double>, kMostMetrics> fractions = {};  // of the preparation

 private:
  mutable Mutex mutex_;
  std::array<std::shared_ptr<const Prepared>, kMostMetrics> former_ SEAMWIRE_GUARDED_BY(mutex_);
};

/// Makes what one of the metrics needs; throws Cancelled where `stop` tells it to. The metric's fractions of
/// progress are told to `metrics`. `make_way` is called now and then while nobody waits for what is being made, and may
/// take its time.
Prepared prepare(
    SurfaceCache& surface_cache, Along along, MetricSet& metrics, std::size_t which, const std::stop_token& stop,
    const std::function<void()>& make_way = [] {});

}  // namespace seamwire::detail
