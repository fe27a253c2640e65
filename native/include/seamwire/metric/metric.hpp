// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "seamwire/api.hpp"
#include "seamwire/metric/curvature.hpp"
#include "seamwire/task.hpp"

namespace seamwire {

/// Larger eigenvalues of a tensor are refused, and smaller ones than its inverse: the square of a triangle's area would
/// not be a number, or be lost.
inline constexpr double kLargestEigenvalue = 1e150;

/// An anisotropic metric: at each of the caller's vertices a tensor on the tangent plane (eq. 1), in coordinates of the
/// model scaled to the unit cube. Lengths scale by the square roots of its eigenvalues.
struct Metric {
  std::vector<Vector> normals;           ///< unit; zero at vertices without a face, where the metric is Euclidean
  std::vector<Eigen::Matrix3d> tensors;  ///< symmetric, l1 e1 e1^T + l2 e2 e2^T; maps the normal to zero

  /// The number of vertices.
  std::size_t size() const { return tensors.size(); }
};

/// The principal direction that paths follow: that of the minimal curvature (M_min: along ridges and valleys), or that
/// of the maximal one (M_max).
enum class Follow { kMin, kMax };

/// How strong a metric is: by its own parameter, or such that its maximum anisotropy, sup sqrt(l1 / l2), is the one
/// given. Exactly one of the two is set. Both must be finite; parameter >= 0 (Campen: >= 1), max_anisotropy >= 1; else
/// InvalidInput.
struct Strength {
  std::optional<double> parameter = std::nullopt;       ///< gamma, alpha or beta
  std::optional<double> max_anisotropy = std::nullopt;  ///< A
  /// s above this percentile (0 < p <= 100) of its values counts as that value, so that single noisy vertices do not
  /// decide.
  std::optional<double> clamp_percentile = std::nullopt;

  /// Member by member.
  friend bool operator==(const Strength&, const Strength&) = default;
};

/// Throws InvalidInput where a strength is not as said there; `smallest_parameter`: 1 for Campen.
SEAMWIRE_API void check_strength(const Strength& strength, double smallest_parameter = 0.0);

/// Each of the metrics throws InvalidInput for curvatures of another size or that are not finite, and for a strength
/// that is not as said above or too strong for them; Cancelled.
///
/// Eq. 5, the paper's metric: l1 = 1 + gamma s, l2 = 1 / l1. Parameter: gamma; max_anisotropy A means gamma =
/// (A - 1) / max s, or 0 where max s is but rounding (planes, spheres).
SEAMWIRE_API Metric feature_metric(const Surface& surface, const Curvature& curvature, Follow follow,
                                   const Strength& strength, const Task& task = {});
/// Eq. 3, Campen et al.: l1 = alpha, l2 = 1. Parameter: alpha; max_anisotropy A means alpha = A^2. Nothing to clamp.
SEAMWIRE_API Metric campen_metric(const Surface& surface, const Curvature& curvature, Follow follow,
                                  const Strength& strength, const Task& task = {});
/// Eq. 4, Pottmann et al., Kovacs et al.: l1 = k1^2 + beta, l2 = k2^2 + beta. Parameter: beta; at least 1e-12 of the
/// largest k1^2 is taken, so that the norm is nowhere zero. max_anisotropy 1, and flat surfaces, give the Euclidean
/// one.
SEAMWIRE_API Metric pottmann_kovacs_metric(const Surface& surface, const Curvature& curvature, Follow follow,
                                           const Strength& strength, const Task& task = {});
/// Short along concave creases and, less so, ridges. Its single wires come nearest to the cuts that people make
/// (docs/method/metric.md). M = l1 c(k2)^2 d1 d1^T + l2 c(k1)^2 d2 d2^T. In it, l1 = 1 + 0.03 t s, l2 = 1 / l1, and
/// s = |k1| - |k2|, halved where k1 > 0 (convex). The factor is c(k) = 1 / (1 + t (1 / (0.3 + 0.7 exp(-max(0, -k) /
/// 16)) - 1)). Normals must point outwards; curvatures are best those of smoothed_curvatures() with a radius of 0.01.
/// `strength`: t, 0 is the Euclidean metric, 1 what was measured; InvalidInput where it is negative or not finite, as
/// above for the rest.
SEAMWIRE_API Metric concave_metric(const Surface& surface, const Curvature& curvature, double strength = 1.0,
                                   const Task& task = {});
/// The Euclidean metric: the identity on every tangent plane.
SEAMWIRE_API Metric euclidean_metric(const Surface& surface, const Curvature& curvature, const Task& task = {});

/// A tensor with its normal. It gives any vector the norm g(e)^2 = e^T M e + sqrt(l1 l2) (n.e)^2. This is the "ambient"
/// reading of the norm of an edge, which need not be tangent (docs/method/metric.md says why).
struct TensorAt {
  Vector normal;           ///< unit, or zero
  Eigen::Matrix3d tensor;  ///< as Metric::tensors
};
/// That norm of an edge.
SEAMWIRE_API double ambient_norm(const TensorAt& at, const Vector& e);
/// sqrt(l1 l2), which the norm above gives to the normal.
SEAMWIRE_API double normal_weight(const Eigen::Matrix3d& m);
/// sqrt(l1 / l2); 1 where the normal is zero.
SEAMWIRE_API double anisotropy(const TensorAt& at);
/// The largest over the vertices.
SEAMWIRE_API double max_anisotropy(const Metric& metric);
/// The eigenvalues and eigenvectors of a tensor in its tangent plane, those of eq. 2: (e1, e2, normal) is right-handed.
struct PrincipalAxes {
  double l1 = 1.0;             ///< the larger eigenvalue
  double l2 = 1.0;             ///< the smaller one, above 0
  Vector e1 = Vector::Zero();  ///< unit, the direction of l1
  Vector e2 = Vector::Zero();  ///< unit, the direction of l2
};
/// Finds the principal axes of a tensor. The directions are any two if the eigenvalues are equal. If the normal is
/// zero, the eigenvalues are 1 and the directions are zero.
SEAMWIRE_API PrincipalAxes principal_axes(const TensorAt& at);
/// In the middle between two: the mean of the normals, normalised (of opposite ones, the first), and of the tensors,
/// each turned by the least rotation onto that normal. Its anisotropy is at most that of the ends.
SEAMWIRE_API TensorAt midpoint_tensor(const TensorAt& a, const TensorAt& b);
/// Length of a straight edge along which the quadratic form varies linearly, so that its squared norm runs from a^2 to
/// b^2: (2/3) (a^2 + a b + b^2) / (a + b); 0 where both are 0.
SEAMWIRE_API double integrated_length(double norm_at_start, double norm_at_end);
/// Length of the straight edge between two of the surface's vertices, which must be in range; symmetric to the last
/// bit.
SEAMWIRE_API double edge_length(const Surface& surface, const Metric& metric, std::int32_t a, std::int32_t b);

}  // namespace seamwire
