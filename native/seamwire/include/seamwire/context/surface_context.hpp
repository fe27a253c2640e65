// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <concepts>
#include <cstddef>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "seamwire/api.hpp"
#include "seamwire/edges/edge_adjacency.hpp"
#include "seamwire/metric/curvature.hpp"
#include "seamwire/metric/metric.hpp"
#include "seamwire/metric/metric_spec.hpp"
#include "seamwire/surface/surface.hpp"
#include "seamwire/task.hpp"

namespace seamwire {

class EmbeddedSurface;

/// A surface with everything that depends on it alone: curvatures and edge adjacency.
///
/// Each of these is computed once, on the thread that first needs it. Copies share the surface and everything computed.
/// Any number of threads may use them at once. If several threads need the same thing, one computes it and the others
/// wait. If that thread is cancelled, one of the others continues in its place.
///
/// If the surface cannot be built, every call that needs it tries again, because memory may be free then, and throws
/// what the constructor of Surface throws.
class SEAMWIRE_API SurfaceContext {
 public:
  /// Make the context of a surface.
  ///
  /// \param surface the surface, not null
  /// \throws InvalidInput if the surface is null
  SurfaceContext(std::shared_ptr<const Surface> surface);
  /// The same from any pointer that converts, such as std::shared_ptr<Surface>. What takes a SurfaceContext takes these
  /// pointers too.
  ///
  /// \param surface the surface, not null
  /// \throws InvalidInput if the surface is null
  template <std::convertible_to<std::shared_ptr<const Surface>> Shared>
  SurfaceContext(Shared surface) : SurfaceContext(std::shared_ptr<const Surface>(std::move(surface))) {}
  /// Make the context of a surface that only the context has.
  ///
  /// \param surface the surface
  explicit SurfaceContext(Surface surface) : SurfaceContext(std::make_shared<const Surface>(std::move(surface))) {}
  /// Make the context of a surface that is built when it is first needed.
  ///
  /// \param points as in the constructor of Surface
  /// \param triangles as in the constructor of Surface
  /// \param edges as in the constructor of Surface
  SurfaceContext(std::vector<Vector> points, std::vector<Triangle> triangles,
                 std::optional<std::vector<Edge>> edges = std::nullopt);

  /// Return the number of vertices, which is known before the surface is built.
  std::size_t vertex_count() const;
  /// Return the number of triangles, as given. It is known before the surface is built.
  std::size_t face_count() const;

  /// Return the surface, and build it if necessary.
  ///
  /// \throws InvalidInput if the constructor of Surface rejects its arguments
  std::shared_ptr<const Surface> surface(const Task& = {}) const;
  /// Return the principal_curvatures() of the surface.
  std::shared_ptr<const Curvature> curvature(const Task& = {}) const;
  /// Return Curvature::difference() of the surface.
  std::shared_ptr<const std::vector<double>> feature_strength(const Task& = {}) const;
  /// Return the smoothed curvatures (radius 0.01) that the concave metric uses.
  std::shared_ptr<const Curvature> smoothed_curvature(const Task& = {}) const;
  /// Return the EdgeAdjacency of the surface.
  std::shared_ptr<const EdgeAdjacency> edge_adjacency(const Task& = {}) const;

  /// Return the surface, or null if it is not built yet. Does not wait.
  ///
  /// \throws InvalidInput if the constructor of Surface rejected its arguments
  std::shared_ptr<const Surface> peek_surface() const;
  /// Return feature_strength(), or null if it is not computed yet. Does not wait.
  std::shared_ptr<const std::vector<double>> peek_feature_strength() const;
  /// Return edge_adjacency(), or null if it is not computed yet. Does not wait.
  std::shared_ptr<const EdgeAdjacency> peek_edge_adjacency() const;
  /// Wait until another thread has built the surface, by calling surface().
  ///
  /// \param seconds the longest time to wait
  /// \returns whether the surface is built
  /// \throws InvalidInput if the constructor of Surface rejected its arguments
  bool wait_for_surface(double seconds) const;

  /// Return whether two contexts are copies of each other.
  friend bool operator==(const SurfaceContext&, const SurfaceContext&) = default;

 private:
  friend class EmbeddedSurface;
  struct Data;
  std::shared_ptr<Data> data_;
};

/// Compute the metric that a spec describes.
///
/// \param context the surface
/// \param spec the metric
/// \returns the metric
/// \throws InvalidInput if check_metric() rejects the spec, or the metric is too strong (kLargestEigenvalue)
SEAMWIRE_API Metric make_metric(const SurfaceContext& context, const MetricSpec& spec, const Task& = {});

}  // namespace seamwire
