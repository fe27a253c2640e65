// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <vector>

#include "seamwire/api.hpp"
#include "seamwire/context/metric_spec.hpp"
#include "seamwire/edges/edge_adjacency.hpp"
#include "seamwire/embedding/embedding.hpp"
#include "seamwire/metric/curvature.hpp"
#include "seamwire/metric/metric.hpp"
#include "seamwire/surface/surface.hpp"
#include "seamwire/task.hpp"
#include "seamwire/wires/snap.hpp"

namespace seamwire {

class EmbeddedSurface;

/// A surface with everything that depends on it alone: curvatures, edge adjacency, snap graph. Each is computed once,
/// when it is first asked for, on the thread that asks.
///
/// Copies share the surface and what was computed. Any number of threads may use them at once. If several threads ask
/// for the same thing, one computes it and the others wait. If that thread is cancelled, one of the others goes on in
/// its place. If the surface cannot be built, every call that needs it throws what the constructor of Surface threw.
class SEAMWIRE_API SurfaceContext {
 public:
  /// The context of a surface. Throws InvalidInput if it is null.
  explicit SurfaceContext(std::shared_ptr<const Surface> surface);
  /// The context of a surface that is built when it is first asked for. Takes the arguments of Surface's constructor.
  SurfaceContext(std::vector<Vector> points, std::vector<Triangle> triangles,
                 std::optional<std::vector<Edge>> edges = std::nullopt);

  /// The number of vertices, which is known before the surface is built.
  std::size_t vertex_count() const;
  /// The number of triangles, as given.
  std::size_t face_count() const;

  /// The surface, which is built if need be. Throws what the constructor of Surface throws; Cancelled.
  std::shared_ptr<const Surface> surface(const Task& task = {}) const;
  /// principal_curvatures() of the surface. Throws Cancelled.
  std::shared_ptr<const Curvature> curvature(const Task& task = {}) const;
  /// Curvature::difference(), s of eq. 5. Throws Cancelled.
  std::shared_ptr<const std::vector<double>> feature_strength(const Task& task = {}) const;
  /// The smoothed curvatures (radius 0.01) that the concave metric uses. Throws Cancelled.
  std::shared_ptr<const Curvature> smoothed_curvature(const Task& task = {}) const;
  /// make_edge_adjacency() of the surface. Throws Cancelled.
  std::shared_ptr<const EdgeAdjacency> edge_adjacency(const Task& task = {}) const;
  /// The SnapGraph of the surface. Throws Cancelled.
  std::shared_ptr<const SnapGraph> snap_graph(const Task& task = {}) const;

  /// The surface, null until it is built. Does not wait. Throws if it cannot be built.
  std::shared_ptr<const Surface> peek_surface() const;
  /// feature_strength(), null until it is computed. Does not wait.
  std::shared_ptr<const std::vector<double>> peek_feature_strength() const;
  /// edge_adjacency(), null until it is computed. Does not wait.
  std::shared_ptr<const EdgeAdjacency> peek_edge_adjacency() const;
  /// Waits at most `seconds` until another thread has built the surface, which surface() does. Returns whether it is
  /// built; throws if it cannot be.
  bool wait_for_surface(double seconds) const;

  /// Whether two contexts are copies of each other.
  friend bool operator==(const SurfaceContext&, const SurfaceContext&) = default;

 private:
  friend class EmbeddedSurface;
  struct Data;
  std::shared_ptr<Data> data_;
};

/// Computes the metric that a spec describes. Throws what check_metric() and the metrics of metric.hpp throw;
/// Cancelled.
SEAMWIRE_API Metric make_metric(const SurfaceContext& context, const MetricSpec& spec, const Task& task = {});

}  // namespace seamwire
