// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "seamwire/api.hpp"
#include "seamwire/metric/curvature.hpp"
#include "seamwire/task.hpp"

namespace seamwire {

/// The largest eigenvalue of a tensor that is accepted. The smallest one is its inverse.
///
/// Beyond these, the square of a triangle's area would overflow or underflow.
inline constexpr double kLargestEigenvalue = 1e150;

/// An anisotropic metric: a tensor on the tangent plane at each of the caller's vertices.
///
/// A tangent vector x has the length sqrt(x^T M x), in the unit of x. Lengths scale by the square roots of the
/// eigenvalues.
///
/// \see Zhuang et al. 2014, Section 2.1, eq. 1
struct Metric {
  /// Unit normals. Zero at vertices without a face that has an area. There the metric is Euclidean.
  std::vector<Vector> normals;
  /// l1 e1 e1^T + l2 e2 e2^T, which maps the normal to zero. Whoever takes a metric throws InvalidInput for a tensor
  /// that is not finite, not symmetric, or has an eigenvalue that is not positive or above kLargestEigenvalue.
  std::vector<Eigen::Matrix3d> tensors;

  /// Return the number of vertices.
  std::size_t size() const { return tensors.size(); }
};

/// The principal direction that paths follow: minimal curvature (M_min, along ridges and valleys) or maximal curvature
/// (M_max).
enum class Follow { kMin, kMax };

/// How strong a metric is: its own parameter, or its maximum anisotropy. Exactly one of the two is set.
///
/// The maximum anisotropy is sup sqrt(l1 / l2) over the surface.
struct Strength {
  std::optional<double> parameter = std::nullopt;       ///< gamma, alpha or beta: finite, 0 or more; alpha is 1 or more
  std::optional<double> max_anisotropy = std::nullopt;  ///< A: finite, 1 or more
  /// Percentile p of the values of s, in (0, 100]. Larger values of s count as the value at this percentile. So single
  /// noisy vertices do not decide. nullopt: no clamping.
  std::optional<double> clamp_percentile = std::nullopt;

  /// Compare member by member.
  friend bool operator==(const Strength&, const Strength&) = default;
};

/// Check a strength.
///
/// \param strength the strength
/// \param smallest_parameter the smallest parameter that is allowed: 1 for Campen's metric, 0 for others
/// \throws InvalidInput if not exactly one of `parameter` and `max_anisotropy` is set
/// \throws InvalidInput if a value is not finite or out of range
SEAMWIRE_API void check_strength(const Strength& strength, double smallest_parameter = 0.0);

/// Make the paper's metric, with l1 = 1 + gamma s and l2 = 1 / l1.
///
/// Here and in the other metrics, k1, k2 and s are those of Curvature times the longest side of the box around the
/// surface. So the strength does not depend on the unit.
///
/// The parameter is gamma. A maximum anisotropy A means gamma = (A - 1) / max s. It means 0 if max s is only rounding,
/// as on planes and spheres.
///
/// \param surface the surface
/// \param curvature curvatures at its vertices
/// \param follow the direction that paths follow
/// \param strength gamma or A
/// \returns the metric
/// \throws InvalidInput if the curvatures differ from the surface in size or are not finite
/// \throws InvalidInput if check_strength() rejects the strength, or the metric is too strong (kLargestEigenvalue)
/// \see Zhuang et al. 2014, Section 3, eq. 5
SEAMWIRE_API Metric feature_metric(const Surface& surface, const Curvature& curvature, Follow follow,
                                   const Strength& strength, const Task& = {});
/// Make Campen's metric, with l1 = alpha and l2 = 1.
///
/// The parameter is alpha. A maximum anisotropy A means alpha = A^2. The percentile has no effect.
///
/// \param surface the surface
/// \param curvature curvatures at its vertices
/// \param follow the direction that paths follow
/// \param strength alpha or A
/// \returns the metric
/// \throws InvalidInput if the curvatures differ from the surface in size or are not finite
/// \throws InvalidInput if check_strength() rejects the strength, or the metric is too strong (kLargestEigenvalue)
/// \see Zhuang et al. 2014, Section 2.2, eq. 3; Campen et al.
SEAMWIRE_API Metric campen_metric(const Surface& surface, const Curvature& curvature, Follow follow,
                                  const Strength& strength, const Task& = {});
/// Make the metric of Pottmann and Kovacs, with l1 = k1^2 + beta and l2 = k2^2 + beta.
///
/// The parameter is beta. A beta below 1e-12 of the largest k1^2 counts as that value, so that the norm is nowhere
/// zero. A maximum anisotropy of 1, and flat surfaces, give the Euclidean metric.
///
/// \param surface the surface
/// \param curvature curvatures at its vertices
/// \param follow the direction that paths follow
/// \param strength beta or A
/// \returns the metric
/// \throws InvalidInput if the curvatures differ from the surface in size or are not finite
/// \throws InvalidInput if check_strength() rejects the strength, or the metric is too strong (kLargestEigenvalue)
/// \see Zhuang et al. 2014, Section 2.2, eq. 4; Pottmann et al.; Kovacs et al.
SEAMWIRE_API Metric pottmann_kovacs_metric(const Surface& surface, const Curvature& curvature, Follow follow,
                                           const Strength& strength, const Task& = {});
/// Make a metric that is short along concave creases and, less so, along ridges.
///
///     M = l1 c(k2)^2 d1 d1^T + l2 c(k1)^2 d2 d2^T
///     l1 = 1 + 0.03 t s,  l2 = 1 / l1
///     s = |k1| - |k2|, halved where k1 > 0 (convex)
///     c(k) = 1 / (1 + t (1 / (0.3 + 0.7 exp(-max(0, -k) / 16)) - 1))
///
/// Normals must point outwards. docs/method/metric.md describes how the metric was chosen.
///
/// \param surface the surface
/// \param curvature preferably of smoothed_curvatures() with a radius of 0.01
/// \param strength t: finite, 0 or more; 0 gives the Euclidean metric, 1 is the usual strength
/// \returns the metric
/// \throws InvalidInput if the curvatures differ from the surface in size or are not finite
/// \throws InvalidInput if the strength is negative, not finite, or too strong (kLargestEigenvalue)
SEAMWIRE_API Metric concave_metric(const Surface& surface, const Curvature& curvature, double strength = 1.0,
                                   const Task& = {});
/// Make the Euclidean metric: the identity on every tangent plane.
///
/// \param surface the surface
/// \param curvature curvatures at its vertices, of which only the normals are used
/// \returns the metric
/// \throws InvalidInput if the curvatures differ from the surface in size or are not finite
SEAMWIRE_API Metric euclidean_metric(const Surface& surface, const Curvature& curvature, const Task& = {});

/// A tensor with its normal.
struct TensorAt {
  Vector normal;           ///< unit, or zero
  Eigen::Matrix3d tensor;  ///< as in Metric::tensors
};
/// Compute the norm g of a vector that need not be tangent, with g(e)^2 = e^T M e + sqrt(l1 l2) (n.e)^2.
///
/// This is the *ambient* reading of the norm of an edge. docs/method/metric.md gives the reason.
///
/// \param at the tensor M with its normal n
/// \param e the vector
/// \returns the norm, 0 or more
SEAMWIRE_API double ambient_norm(const TensorAt& at, const Vector& e);
/// Compute sqrt(l1 l2), the weight of the normal part in ambient_norm().
///
/// \param m a tensor, as in Metric::tensors
/// \returns the weight, 0 or more
SEAMWIRE_API double normal_weight(const Eigen::Matrix3d& m);
/// Compute the anisotropy sqrt(l1 / l2) of a tensor.
///
/// \param at the tensor
/// \returns 1 or more; 1 if the normal is zero
SEAMWIRE_API double anisotropy(const TensorAt& at);
/// Compute the largest anisotropy over the vertices of a metric.
///
/// \param metric the metric
/// \returns 1 or more
SEAMWIRE_API double max_anisotropy(const Metric& metric);
/// The eigenvalues and eigenvectors of a tensor in its tangent plane. (e1, e2, normal) is right-handed.
///
/// \see Zhuang et al. 2014, Section 2.1, eq. 2
struct PrincipalAxes {
  double l1 = 1.0;             ///< the larger eigenvalue
  double l2 = 1.0;             ///< the smaller eigenvalue, above 0
  Vector e1 = Vector::Zero();  ///< direction of l1: unit, or zero
  Vector e2 = Vector::Zero();  ///< direction of l2: unit, or zero
};
/// Find the principal axes of a tensor.
///
/// \param at the tensor
/// \returns the axes. If the eigenvalues are equal, the directions are arbitrary. If the normal is zero, the
///   eigenvalues are 1 and the directions are zero.
SEAMWIRE_API PrincipalAxes principal_axes(const TensorAt& at);
/// Interpolate the tensor in the middle between two.
///
/// The normal is the normalized mean of both normals, or the first normal if they are opposite. The tensor is the mean
/// of both tensors, each turned onto that normal by the least rotation. Its anisotropy is at most that of the ends.
///
/// \param a the tensor at one end
/// \param b the tensor at the other end
/// \returns the tensor in the middle
SEAMWIRE_API TensorAt midpoint_tensor(const TensorAt& a, const TensorAt& b);
/// Compute the length of a straight edge along which the quadratic form varies linearly.
///
/// With the norms a and b of the edge at its ends, it is (2/3) (a^2 + a b + b^2) / (a + b).
///
/// \param norm_at_start a, 0 or more
/// \param norm_at_end b, 0 or more
/// \returns the length; 0 if both norms are 0
SEAMWIRE_API double integrated_length(double norm_at_start, double norm_at_end);
/// Compute the length of the straight edge between two vertices.
///
/// \param surface the surface
/// \param metric a metric of its vertices
/// \param a a vertex of the surface, not checked
/// \param b another vertex of the surface, not checked
/// \returns the length, in the caller's unit; exactly the same if `a` and `b` are swapped
SEAMWIRE_API double edge_length(const Surface& surface, const Metric& metric, std::int32_t a, std::int32_t b);

}  // namespace seamwire
