// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "seamwire/api.hpp"
#include "seamwire/context/metric_spec.hpp"
#include "seamwire/context/surface_context.hpp"
#include "seamwire/embedding/embedding.hpp"
#include "seamwire/geodesics/exact_geodesics.hpp"
#include "seamwire/wires/bent_wires.hpp"
#include "seamwire/wires/closed_wires.hpp"
#include "seamwire/wires/embedded_points.hpp"
#include "seamwire/wires/wire.hpp"

namespace seamwire {

class EmbeddedField;

/// A surface in a metric: its embedding, the solver for geodesics on it, and what finds the caller's points on it.
/// Solver and point location are made when they are first needed.
///
/// Immutable. Copies share the data, and any number of threads may use them at once. All points are those of the
/// caller's surface.
class SEAMWIRE_API EmbeddedSurface {
 public:
  /// Embeds a surface in the metric that a spec describes. If the context has that metric embedded already, with the
  /// same options, and someone still holds it, they share it. Throws what make_metric() and embed() throw; Cancelled.
  EmbeddedSurface(const SurfaceContext& context, const MetricSpec& spec, const EmbedOptions& options = {},
                  const Task& task = {});
  /// Embeds a surface in any metric. Throws what embed() throws; Cancelled.
  EmbeddedSurface(const SurfaceContext& context, std::shared_ptr<const Metric> metric, const EmbedOptions& options = {},
                  const Task& task = {});
  /// A surface with an existing embedding, and with its options. Throws InvalidInput if metric or embedding are not of
  /// the surface, as far as their sizes tell.
  EmbeddedSurface(const SurfaceContext& context, std::shared_ptr<const Metric> metric, Embedding embedding);

  /// The surface in another metric, made from this one by re_embed() and in less time where the metrics agree. Throws
  /// what re_embed() throws; Cancelled.
  EmbeddedSurface with_metric(std::shared_ptr<const Metric> metric, const Task& task = {}) const;
  /// The surface in the metric of a spec, if the context has it embedded with these options and someone still holds it.
  static std::optional<EmbeddedSurface> find(const SurfaceContext& context, const MetricSpec& spec,
                                             const EmbedOptions& options = {});

  /// The surface with all that depends on it alone.
  const SurfaceContext& context() const;
  /// The surface that the caller gave.
  const Surface& surface() const;
  /// The metric.
  const Metric& metric() const { return *shared_metric(); }
  /// The metric, to share ownership.
  const std::shared_ptr<const Metric>& shared_metric() const;
  /// The spec of the metric, nullopt if the metric was not made from one.
  const std::optional<MetricSpec>& spec() const;
  /// The embedding.
  const Embedding& embedding() const { return *shared_embedding(); }
  /// The embedding, to share ownership.
  const std::shared_ptr<const Embedding>& shared_embedding() const;
  /// The solver on the embedding. Throws what its constructor throws; Cancelled.
  const ExactGeodesics& geodesics(const Task& task = {}) const;
  /// Finds points of the surface on the embedding.
  const EmbeddedPoints& points() const;
  /// A point of the surface as one of the embedding. Throws InvalidInput, beginning with `what`, for a point that is
  /// not part of the surface, a face without area, and a hole of the embedding.
  SurfacePoint locate(const SurfacePoint& point, const std::string& what = "point") const;

  /// Exact distances from a vertex. Throws InvalidInput for a vertex out of range; Cancelled.
  EmbeddedField field(std::int32_t seed, const Task& task = {}) const;
  /// Exact distances from the nearest of several points. Throws as locate() and ExactGeodesics::solve() do; Cancelled.
  EmbeddedField field(std::span<const SurfacePoint> sources, const SolveOptions& options = {},
                      const Task& task = {}) const;
  /// Distances from a vertex by ExactGeodesics::solve_bounded(), which throws.
  EmbeddedField bounded_field(std::int32_t seed, std::uint32_t windows, const Task& task = {}) const;

  /// Whether two embedded surfaces are copies of each other.
  friend bool operator==(const EmbeddedSurface&, const EmbeddedSurface&) = default;

 private:
  friend class SurfaceContext;
  friend class EmbeddedField;
  struct Data;
  explicit EmbeddedSurface(std::shared_ptr<Data> data) : data_(std::move(data)) {}
  std::shared_ptr<Data> data_;
};

/// Distances over an embedded surface, and the wires that lead from their sources. Immutable; copies share the data.
class SEAMWIRE_API EmbeddedField {
 public:
  /// The embedded surface that the distances belong to.
  const EmbeddedSurface& on() const { return on_; }
  /// The distances, with the vertices and faces of the embedding: the first vertices are those of the surface.
  const DistanceField& distances() const { return distances_; }

  /// The distance of any point of the surface. Throws as EmbeddedSurface::locate() does; Cancelled.
  double distance(const SurfacePoint& point, const Task& task = {}) const;
  /// The shortest wire to a vertex. Throws InvalidInput for a vertex out of range; Cancelled.
  Wire wire(std::int32_t vertex, const Task& task = {}) const;
  /// The shortest wire to any point. Throws as EmbeddedSurface::locate() does; Cancelled.
  Wire wire(const SurfacePoint& point, const Task& task = {}) const;
  /// The closed wires through the seed, see seamwire::closed_wires(), which throws.
  std::vector<ClosedWire> closed_wires(std::size_t count = 3, const Task& task = {}) const;
  /// What bends one of the closed wires, see BentWires, which throws. A cut of another embedded surface is refused.
  BentWires bend(const ClosedWire& cut, const Task& task = {}) const;

 private:
  friend class EmbeddedSurface;
  EmbeddedField(EmbeddedSurface on, DistanceField distances) : on_(std::move(on)), distances_(std::move(distances)) {}

  EmbeddedSurface on_;
  DistanceField distances_;
};

}  // namespace seamwire
