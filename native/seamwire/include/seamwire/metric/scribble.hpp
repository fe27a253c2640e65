// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "seamwire/api.hpp"
#include "seamwire/metric/metric.hpp"
#include "seamwire/surface/surface.hpp"
#include "seamwire/task.hpp"

namespace seamwire {

/// The directions that paths of a metric follow: minimal curvature, maximal curvature, concave creases
/// (concave_metric()), or nothing (euclidean_metric()).
enum class MetricKind { kMin, kMax, kConcave, kEuclidean };

/// A stroke drawn on a surface. Wires near it follow it, or cross it if `attracts` is false.
///
/// \see Zhuang et al. 2014, Section 5
struct Scribble {
  /// The stroke in the caller's coordinates, in drawing order. A closed stroke ends with its first point. Each point
  /// lies in the triangle of `faces`, or at the vertex of `vertices`.
  std::vector<Vector> points;
  /// Per point: the caller's triangle, or -1 if `vertices` has the point. Empty if all points are at vertices.
  std::vector<std::int32_t> faces;
  /// Per point: the caller's vertex, or -1 if `faces` has the point. Empty if all points are in triangles.
  std::vector<std::int32_t> vertices;
  double eta = 20;  ///< at the stroke, the eigenvalues become eta and 1 / eta; finite, 1 or more
  int rings = 10;   ///< k, 1 or more: nothing changes from the k-th ring of vertices around the stroke on
  /// Nothing changes from this distance on; finite, above 0, in the caller's unit. Replaces `rings` if set.
  std::optional<double> radius = std::nullopt;
  bool attracts = true;  ///< false: crossing the stroke becomes short, and following it long
  /// The kind of metrics that the stroke changes. nullopt: all metrics.
  std::optional<MetricKind> acts_on = std::nullopt;

  /// Return whether the stroke changes metrics of a kind.
  ///
  /// \param kind the kind
  bool changes(MetricKind kind) const { return !acts_on || *acts_on == kind; }
  /// Compare member by member.
  friend bool operator==(const Scribble&, const Scribble&) = default;
};

/// Apply scribbles to a metric, in their order.
///
/// A stroke changes the tensors at all corners of the triangles that it crosses, and at the vertices it runs along.
/// There the eigenvalues become eta and 1 / eta. The minor eigenvector points along the drawn line (its chord over two
/// edges), or across it if the stroke repels.
///
/// Ring by ring, that tensor is carried on, and turned by the least rotation from normal to normal. In ring r it is
/// blended with the former tensor, with the weight 1 - r / k. With a radius, the weight is 1 - distance / radius, but 1
/// along the stroke. So if two strokes cross, the later one wins along its own line.
///
/// - Points farther apart than a triangle are joined along the vertices nearest to the straight line between them.
/// - The stroke has a gap where no vertices lead on, as to another component or the far side of a hole.
/// - If a stroke crosses itself, each vertex takes the direction of the nearest part of the stroke. If two parts are
///   equally near, the later one counts.
/// - A stroke without movement has no direction and changes nothing.
/// - Vertices without a normal do not change.
///
/// \param surface the surface
/// \param metric a metric of its vertices
/// \param scribbles the strokes. Without strokes, the result is exactly `metric`.
/// \param kind the kind of the metric, which selects the strokes meant for it; nullopt applies all strokes
/// \returns the changed metric
/// \throws InvalidInput if a point is not finite, or its face or vertex is missing or out of range. The message names
///   stroke and point.
/// \throws InvalidInput if a point is farther from its face or vertex than 1/20 of the model's longest side
/// \throws InvalidInput if lists differ in length, or `eta`, `rings` or `radius` is out of range
/// \throws InvalidInput if the metric differs from the surface in size, or a tensor is invalid (Metric::tensors)
/// \see Zhuang et al. 2014, Section 5
SEAMWIRE_API Metric apply_scribbles(const Surface& surface, const Metric& metric, std::span<const Scribble> scribbles,
                                    std::optional<MetricKind> kind = std::nullopt, const Task& = {});

}  // namespace seamwire
