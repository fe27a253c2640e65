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

/// The directions that paths of a metric follow: least curvature, most curvature, concave creases (concave_metric()),
/// or nothing (euclidean_metric()).
enum class MetricKind { kMin, kMax, kConcave, kEuclidean };

/// A stroke drawn on a surface: wires near it run as it does (Section 5 of the paper).
struct Scribble {
  /// In the caller's coordinates, in drawing order; the first again at the end: closed. Each lies in the triangle of
  /// `faces` or at the vertex of `vertices` (the caller's numbers, one a point; where one is -1, or all are left out,
  /// the other counts).
  std::vector<Vector> points;
  std::vector<std::int32_t> faces;              ///< per point, or none at all
  std::vector<std::int32_t> vertices;           ///< per point, or none at all
  double eta = 20;                              ///< the eigenvalues along the stroke are eta and 1 / eta; >= 1
  int rings = 10;                               ///< k: from the k-th ring of vertices around it on nothing changes
  std::optional<double> radius = std::nullopt;  ///< instead of `rings`: from this distance on, caller's units
  bool attracts = true;                         ///< false: crossing becomes short, and following long
  std::optional<MetricKind> meant_for = std::nullopt;  ///< metrics of one kind only; nullopt: all metrics

  /// Whether it changes metrics of a kind.
  bool acts_on(MetricKind kind) const { return !meant_for || *meant_for == kind; }
  /// Member by member.
  friend bool operator==(const Scribble&, const Scribble&) = default;
};

/// Applies scribbles to a metric, in their order. A stroke changes the tensors at all corners of the triangles that it
/// crosses, and at the vertices it runs along. There the eigenvalues become (eta, 1 / eta), with the minor eigenvector
/// along the drawn line (its chord over two edges). That tensor is carried on, ring by ring, and turned by the least
/// rotation from normal to normal. It is blended with the former tensor with the weight 1 - r / k in ring r. With a
/// radius, the weight is 1 - distance / radius, but 1 along the stroke. So of two strokes that cross, the later one
/// wins along its own line. Without scribbles the result is `metric`, bit for bit.
///
/// Points further apart than a triangle are joined along the vertices nearest to the straight line between them. The
/// stroke has a gap where no vertices lead there, as to another component or the far side of a hole. A stroke that
/// crosses itself takes at each vertex the direction of its nearest part, of equal ones the later. A stroke without
/// movement has no direction and changes nothing, and vertices without a normal are left as they are. `kind`: that of
/// the metric; takes only the scribbles meant for it. nullopt: takes all. (The paper changes the metric of the active
/// wire.)
///
/// Throws InvalidInput, naming scribble and point, for a point that is not finite, or whose face or vertex is missing
/// or out of range. A point may also be too far from the mesh: farther from its face or vertex than a twentieth of the
/// model's longest side. Throws InvalidInput, too, for lists of different lengths, if eta, rings or a radius is out of
/// range, and for a metric of another size; Cancelled.
SEAMWIRE_API Metric apply_scribbles(const Surface& surface, const Metric& metric, std::span<const Scribble> scribbles,
                                    std::optional<MetricKind> kind = std::nullopt, const Task& task = {});

}  // namespace seamwire
