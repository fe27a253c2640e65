// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "seamwire/api.hpp"
#include "seamwire/context/surface_context.hpp"
#include "seamwire/embedding/embedding.hpp"
#include "seamwire/geodesics/distance_field.hpp"
#include "seamwire/geodesics/distance_method.hpp"
#include "seamwire/geodesics/exact_geodesics.hpp"
#include "seamwire/geodesics/heat_geodesics.hpp"
#include "seamwire/metric/metric_spec.hpp"
#include "seamwire/wires/bent_wires.hpp"
#include "seamwire/wires/closed_wires.hpp"
#include "seamwire/wires/embedded_points.hpp"
#include "seamwire/wires/wire.hpp"

namespace seamwire {

class EmbeddedField;
class EmbeddedSurface;

namespace detail {
EmbeddedSurface embedded_in(const SurfaceContext& context, const MetricSpec& spec, std::shared_ptr<const Metric> metric,
                            const EmbedOptions& options, const Task& task);
}  // namespace detail

/// A surface in a metric: its embedding, the methods for distances on it, and the search for the caller's points on it.
///
/// Methods and search are made when they are first needed. Immutable. Copies share the data, and any number of threads
/// may use them at once. All points are points of the caller's surface.
class SEAMWIRE_API EmbeddedSurface {
 public:
  /// Embed a surface in the metric that a spec describes.
  ///
  /// If the context has that metric embedded already, with the same options, and someone still holds it, they share it.
  ///
  /// \param context the surface
  /// \param spec the metric
  /// \param options how far the subdivision goes
  /// \throws InvalidInput if make_metric() or embed() rejects an argument
  EmbeddedSurface(const SurfaceContext& context, const MetricSpec& spec, const EmbedOptions& options = {},
                  const Task& = {});
  /// Embed a surface in any metric.
  ///
  /// \param context the surface
  /// \param metric a metric of its vertices, not null
  /// \param options how far the subdivision goes
  /// \throws InvalidInput if the metric is null, or embed() rejects an argument
  EmbeddedSurface(const SurfaceContext& context, std::shared_ptr<const Metric> metric, const EmbedOptions& options = {},
                  const Task& = {});
  /// Wrap an existing embedding, with its options.
  ///
  /// \param context the surface
  /// \param metric the metric of the embedding, not null
  /// \param embedding an embedding of the surface
  /// \throws InvalidInput if the metric is null, a tensor is invalid, or metric or embedding are of another surface, as
  ///   far as their sizes tell
  EmbeddedSurface(const SurfaceContext& context, std::shared_ptr<const Metric> metric, Embedding embedding);

  /// Embed the surface in a changed metric with re_embed(). With a `max_error` of 0, that is faster where the metrics
  /// agree.
  ///
  /// \param metric a metric of the surface's vertices, not null
  /// \returns the surface in the changed metric
  /// \throws InvalidInput if the metric is null, or re_embed() rejects an argument
  EmbeddedSurface with_metric(std::shared_ptr<const Metric> metric, const Task& = {}) const;
  /// Find the surface in the metric of a spec, if the context has it already and someone still holds it.
  ///
  /// \param context the surface
  /// \param spec the metric
  /// \param options the options that the embedding was made with
  /// \returns the embedded surface, or nullopt
  static std::optional<EmbeddedSurface> find(const SurfaceContext& context, const MetricSpec& spec,
                                             const EmbedOptions& options = {});

  /// Return the surface with everything that depends on it alone.
  const SurfaceContext& context() const;
  /// Return the caller's surface.
  const Surface& surface() const;
  /// Return the metric.
  const Metric& metric() const { return *shared_metric(); }
  /// Return the metric, to share ownership.
  const std::shared_ptr<const Metric>& shared_metric() const;
  /// Return the spec of the metric, or nullopt if the metric was not made from a spec.
  const std::optional<MetricSpec>& spec() const;
  /// Return the embedding.
  const Embedding& embedding() const { return *shared_embedding(); }
  /// Return the embedding, to share ownership.
  const std::shared_ptr<const Embedding>& shared_embedding() const;
  /// Return the solver on the embedding.
  ///
  /// \throws InvalidInput if the constructor of ExactGeodesics rejects the embedding
  const ExactGeodesics& geodesics(const Task& = {}) const;
  /// Return the heat method on the embedding, for field() with a method.
  ///
  /// \throws InvalidInput if the constructor of HeatGeodesics rejects the embedding
  const HeatGeodesics& heat_geodesics(const Task& = {}) const;
  /// Return the search for points of the surface on the embedding.
  const EmbeddedPoints& points() const;
  /// Find a point of the surface on the embedding.
  ///
  /// \param point a point of the surface
  /// \param what the name of the point, with which error messages begin
  /// \returns the same point as one of the embedding
  /// \throws InvalidInput if the point is not part of the surface, or its face was not embedded or has no area
  /// \throws InvalidInput if the embedding has a hole there
  SurfacePoint locate(const SurfacePoint& point, const std::string& what = "point") const;

  /// Compute exact distances from a point.
  ///
  /// \param seed a point of the surface
  /// \returns the distances, and the wires
  /// \throws InvalidInput if locate() rejects the seed, or the constructor of ExactGeodesics rejects the embedding
  EmbeddedField field(const SurfacePoint& seed, const Task& = {}) const;
  /// Compute exact distances from the nearest of several points.
  ///
  /// \param sources one or more points of the surface
  /// \param options when the solve may stop; its targets are points of the surface
  /// \returns the distances, and the wires
  /// \throws InvalidInput if locate() rejects a source or a target, or ExactGeodesics::solve() rejects an argument
  EmbeddedField field(std::span<const SurfacePoint> sources, const SolveOptions& options = {}, const Task& = {}) const;
  /// Compute distances with any method.
  ///
  /// \param method a method that is prepared on the mesh of this embedding
  /// \param sources one or more points of the surface
  /// \param options when the solve may stop; its targets are points of the surface
  /// \returns the distances, and the wires
  /// \throws InvalidInput if locate() rejects a source or a target, or DistanceMethod::solve() rejects an argument
  /// \throws InvalidInput if the method is prepared on another mesh, as far as sizes tell
  EmbeddedField field(const DistanceMethod& method, std::span<const SurfacePoint> sources,
                      const SolveOptions& options = {}, const Task& = {}) const;
  /// Return whether two embedded surfaces are copies of each other.
  friend bool operator==(const EmbeddedSurface&, const EmbeddedSurface&) = default;

 private:
  friend class SurfaceContext;
  friend class EmbeddedField;
  friend EmbeddedSurface detail::embedded_in(const SurfaceContext& context, const MetricSpec& spec,
                                             std::shared_ptr<const Metric> metric, const EmbedOptions& options,
                                             const Task& task);
  struct Data;
  EmbeddedSurface(const SurfaceContext& context, const MetricSpec& spec, std::shared_ptr<const Metric> metric,
                  const EmbedOptions& options, const Task& task);
  explicit EmbeddedSurface(std::shared_ptr<Data> data) : data_(std::move(data)) {}
  std::shared_ptr<Data> data_;
};

/// Distances over an embedded surface, and the wires that lead from their sources. Immutable. Copies share the data.
class SEAMWIRE_API EmbeddedField {
 public:
  /// Return the embedded surface of the distances.
  const EmbeddedSurface& on() const { return on_; }
  /// Return the distances, with the vertices and faces of the embedding. The first vertices are those of the surface.
  const DistanceField& distances() const { return distances_; }

  /// Compute the distance of any point of the surface.
  ///
  /// \param point a point of the surface
  /// \returns the distance in the metric, infinite if no path leads there
  /// \throws InvalidInput if EmbeddedSurface::locate() rejects the point
  double distance(const SurfacePoint& point, const Task& = {}) const;
  /// Trace the wire to any point. It is the shortest one if the distances are exact.
  ///
  /// \param point a point of the surface
  /// \returns the wire, or nullopt if the point is unreachable
  /// \throws InvalidInput if EmbeddedSurface::locate() rejects the point
  std::optional<Wire> trace(const SurfacePoint& point, const Task& = {}) const;
  /// Find the closed wires through the seed, with seamwire::closed_wires().
  ///
  /// \param count the largest number of wires
  /// \returns the closed wires, best first
  /// \throws InvalidInput if the field has several sources
  std::vector<ClosedWire> closed_wires(std::size_t count = 3, const Task& = {}) const;
  /// Prepare the bending of one of the closed wires.
  ///
  /// \param cut a wire of closed_wires()
  /// \returns the object that bends it
  /// \throws InvalidInput if the constructor of BentWires rejects the cut, such as a cut of another embedded surface
  BentWires bend(const ClosedWire& cut, const Task& = {}) const;

 private:
  friend class EmbeddedSurface;
  EmbeddedField(EmbeddedSurface on, DistanceField distances) : on_(std::move(on)), distances_(std::move(distances)) {}

  EmbeddedSurface on_;
  DistanceField distances_;
};

}  // namespace seamwire
