// SPDX-License-Identifier: GPL-3.0-or-later
#include "seamwire/metric/metric.hpp"

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <string>
#include <utility>

#include "detail/infinity.hpp"
#include "detail/poll.hpp"
#include "detail/text.hpp"
#include "metric/metric_check.hpp"
#include "metric/tangent_frame.hpp"
#include "surface/exact_unit.hpp"

namespace seamwire {

using namespace detail;

namespace {

// Differences of curvature up to this fraction of the largest curvature count as rounding. So do differences up to this
// fraction of 1, the curvature of a sphere as wide as the model. Planes and spheres have no features to scale a metric
// by.
constexpr double kNoDifference = 1e-9;

// Smallest beta, as a fraction of the largest k1^2: where k1 = k2 = 0 the norm would vanish without it.
constexpr double kSmallestBeta = 1e-12;

// The concave metric's: gamma, how short the deepest creases become, and the curvature at which they are near to it.
constexpr double kCreaseGamma = 0.03, kDeepest = 0.3, kConcavity = 16;

void check_sizes(const Surface& surface, const std::string& what, std::initializer_list<std::size_t> sizes) {
  for (const std::size_t size : sizes) {
    if (size == surface.vertex_count()) continue;
    throw InvalidInput(what + " of " + std::to_string(size) + " vertices for a surface of " +
                       std::to_string(surface.vertex_count()));
  }
}

void check_curvature(const Surface& surface, const Curvature& curvature, const Task& task) {
  check_size(surface, curvature);
  const std::size_t n = surface.vertex_count();
  const Poll poll(task, 0.0, 0.2, n);
  for (std::size_t v = 0; v < n; ++v) {
    poll.at(v);
    const bool finite = std::isfinite(curvature.k1[v]) && std::isfinite(curvature.k2[v]) &&
                        curvature.d1[v].allFinite() && curvature.d2[v].allFinite() && curvature.normals[v].allFinite();
    if (!finite) throw InvalidInput("curvature of vertex " + std::to_string(v) + " is not finite");
  }
}

bool has_normal(const Curvature& curvature, std::size_t v) { return curvature.normals[v].squaredNorm() > 0; }

// The percentile of values, interpolated linearly between the two nearest.
double percentile(std::vector<double> values, double percent) {
  const double position = percent / 100 * static_cast<double>(values.size() - 1);
  const auto below = values.begin() + static_cast<std::ptrdiff_t>(position);
  std::nth_element(values.begin(), below, values.end());
  const double fraction = position - std::floor(position);
  if (fraction == 0) return *below;
  const double above = *std::min_element(below + 1, values.end());
  return *below + fraction * (above - *below);
}

// Magnitudes of the curvatures of the model scaled to the unit cube, with s = |k1| - |k2| clamped, and the largest of
// each; 0 at vertices without a normal.
struct Features {
  std::vector<double> s, k2;
  double largest_s = 0, largest_k1 = 0;

  double k1(std::size_t v) const { return k2[v] + s[v]; }
};

Features features(const Surface& surface, const Curvature& curvature, const Strength& strength, const Task& task) {
  const double scale = surface.scale();
  const std::size_t n = curvature.k1.size();
  Features out{.s = std::vector<double>(n, 0.0), .k2 = std::vector<double>(n, 0.0)};
  std::vector<double> used;
  const Poll reading(task, 0.2, 0.3, n);
  for (std::size_t v = 0; v < n; ++v) {
    reading.at(v);
    if (!has_normal(curvature, v)) continue;
    out.k2[v] = std::abs(curvature.k2[v]) / scale;
    out.s[v] = std::max(0.0, std::abs(curvature.k1[v]) / scale - out.k2[v]);
    if (strength.clamp_percentile) used.push_back(out.s[v]);
  }
  const double limit = used.empty() ? kInfinity : percentile(std::move(used), *strength.clamp_percentile);
  const Poll clamping(task, 0.3, 0.4, n);
  for (std::size_t v = 0; v < n; ++v) {
    clamping.at(v);
    out.s[v] = std::min(out.s[v], limit);
    out.largest_s = std::max(out.largest_s, out.s[v]);
    out.largest_k1 = std::max(out.largest_k1, out.k1(v));
  }
  return out;
}

struct Eigenvalues {
  double l1, l2;
};

// Entries of a tensor differ by less than this fraction of the largest one if only rounding makes them differ.
constexpr double kTensorRounding = 1e-14;

// Whether a tensor with this largest entry may be so strong that rounding loses its smaller eigenvalue. It is the
// inverse of the larger one.
bool may_round_away(double largest) { return largest > 1e6 || largest < 1e-6; }

// The sum of the principal minors: of the products of two eigenvalues each.
double sum_of_minors(const Eigen::Matrix3d& m) {
  return m(0, 0) * m(1, 1) - m(0, 1) * m(0, 1) + m(1, 1) * m(2, 2) - m(1, 2) * m(1, 2) + m(2, 2) * m(0, 0) -
         m(2, 0) * m(2, 0);
}

// The metric whose minor eigenvector has the direction to follow, with the eigenvalues that `at` gives for a vertex.
template <class EigenvaluesAt>
Metric aligned_metric(const Curvature& curvature, Follow follow, const Task& task, const EigenvaluesAt& at) {
  const std::size_t n = curvature.normals.size();
  Metric metric{.normals = copied(curvature.normals, task, 0.4), .tensors = {}};
  metric.tensors.reserve(n);
  const Poll poll(task, 0.4, 1.0, n);
  for (std::size_t v = 0; v < n; ++v) {
    poll.at(v);
    metric.tensors.emplace_back(Eigen::Matrix3d::Identity());
    if (!has_normal(curvature, v)) continue;
    const auto [l1, l2] = at(v);
    if (!(std::max(l1, l2) <= kLargestEigenvalue && std::min(l1, l2) * kLargestEigenvalue >= 1)) {
      throw InvalidInput("the metric at vertex " + std::to_string(v) + " is too strong: its eigenvalues are " +
                         text(l1) + " and " + text(l2));
    }
    const Vector& e1 = follow == Follow::kMin ? curvature.d1[v] : curvature.d2[v];
    const Vector& e2 = follow == Follow::kMin ? curvature.d2[v] : curvature.d1[v];
    metric.tensors[v] = l1 * e1 * e1.transpose() + l2 * e2 * e2.transpose();
  }
  return metric;
}

// The tensor as a 2 x 2 matrix (p, q; q, r) in an orthonormal basis of the tangent plane.
struct PlaneTensor {
  double p, q, r;
};

PlaneTensor in_plane(const TensorAt& at) {
  const TangentFrame frame = tangent_frame(at.normal);
  const Vector &u = frame.u, v = frame.v();
  const Vector mu = at.tensor * u;
  return {u.dot(mu), v.dot(mu), v.dot(at.tensor * v)};
}

}  // namespace

void check_strength(const Strength& strength, double smallest_parameter) {
  if (strength.parameter.has_value() == strength.max_anisotropy.has_value()) {
    throw InvalidInput("a metric needs either its parameter or a maximum anisotropy");
  }
  if (strength.parameter && !(std::isfinite(*strength.parameter) && *strength.parameter >= smallest_parameter)) {
    throw InvalidInput("parameter of the metric is " + text(*strength.parameter) +
                       ", not a finite number of at least " + text(smallest_parameter));
  }
  if (strength.max_anisotropy && !(std::isfinite(*strength.max_anisotropy) && *strength.max_anisotropy >= 1)) {
    throw InvalidInput("maximum anisotropy is " + text(*strength.max_anisotropy) +
                       ", not a finite number of at least 1");
  }
  if (strength.clamp_percentile && !(*strength.clamp_percentile > 0 && *strength.clamp_percentile <= 100)) {
    throw InvalidInput("percentile to clamp at is " + text(*strength.clamp_percentile) + ", not in (0, 100]");
  }
}

void detail::check_size(const Surface& surface, const Curvature& curvature) {
  const auto& [k1, k2, d1, d2, normals] = curvature;
  check_sizes(surface, "curvature", {k1.size(), k2.size(), d1.size(), d2.size(), normals.size()});
}

void detail::check_size(const Surface& surface, const Metric& metric) {
  check_sizes(surface, "metric", {metric.normals.size(), metric.tensors.size()});
}

void detail::check_tensors(const Metric& metric) {
  for (std::size_t v = 0; v < metric.size(); ++v) check_tensor(metric, v);
}

void detail::check_tensor(const Metric& metric, std::size_t v) {
  const Eigen::Matrix3d& m = metric.tensors[v];
  const auto fail = [&](const std::string& what) {
    throw InvalidInput("the metric at vertex " + std::to_string(v) + " " + what);
  };
  if (!m.allFinite() || !metric.normals[v].allFinite()) fail("is not finite");
  const double largest = m.cwiseAbs().maxCoeff();
  if (largest > kLargestEigenvalue) {
    fail("is too strong: its tensor has an entry above " + text(kLargestEigenvalue));
  }
  const double skew = std::max({std::abs(m(0, 1) - m(1, 0)), std::abs(m(1, 2) - m(2, 1)), std::abs(m(2, 0) - m(0, 2))});
  if (skew > kTensorRounding * largest) fail("is invalid: its tensor is not symmetric");
  // Sums of the products of one, two and three eigenvalues, of the tensor over its largest entry. They are positive if
  // all eigenvalues are. The third one is zero where there is a normal.
  const Eigen::Matrix3d unit = largest > 0 ? Eigen::Matrix3d(m / largest) : m;
  const double sum = unit.trace(), pairs = sum_of_minors(unit);
  const Vector& normal = metric.normals[v];
  const bool has_two = sum > 0 && pairs > kTensorRounding && normal.dot(unit * normal) >= -kTensorRounding;
  const bool has_all = has_two && (!normal.isZero(0) || unit.determinant() > 0);
  if (largest * kLargestEigenvalue >= 1 &&
      (has_all || (sum > 0 && may_round_away(largest) && pairs >= -kTensorRounding)))
    return;
  fail("is invalid: its tensor has an eigenvalue that is not positive");
}

Metric feature_metric(const Surface& surface, const Curvature& curvature, Follow follow, const Strength& strength,
                      const Task& task) {
  check_curvature(surface, curvature, task);
  check_strength(strength, 0);
  const Features f = features(surface, curvature, strength, task);
  const bool featureless = f.largest_s <= kNoDifference * std::max(1.0, f.largest_k1);
  const double gamma = strength.parameter ? *strength.parameter
                       : featureless      ? 0.0
                                          : (*strength.max_anisotropy - 1) / f.largest_s;
  return aligned_metric(curvature, follow, task, [&](std::size_t v) {
    const double l1 = 1 + gamma * f.s[v];
    return Eigenvalues{l1, 1 / l1};
  });
}

Metric campen_metric(const Surface& surface, const Curvature& curvature, Follow follow, const Strength& strength,
                     const Task& task) {
  check_curvature(surface, curvature, task);
  check_strength(strength, 1);
  const double alpha = strength.parameter ? *strength.parameter : *strength.max_anisotropy * *strength.max_anisotropy;
  return aligned_metric(curvature, follow, task, [&](std::size_t) { return Eigenvalues{alpha, 1}; });
}

Metric pottmann_kovacs_metric(const Surface& surface, const Curvature& curvature, Follow follow,
                              const Strength& strength, const Task& task) {
  check_curvature(surface, curvature, task);
  check_strength(strength, 0);
  const Features f = features(surface, curvature, strength, task);
  double beta = 0;
  if (strength.parameter) {
    beta = *strength.parameter;
  } else {
    // Eq. 4 solved for beta at every vertex. As A goes to 1 beta grows without bound, and the metric, whose scale is
    // arbitrary, becomes the Euclidean one.
    const double a2 = *strength.max_anisotropy * *strength.max_anisotropy;
    if (a2 == 1) return euclidean_metric(surface, curvature, task);
    for (std::size_t v = 0; v < f.s.size(); ++v) {
      beta = std::max(beta, (f.k1(v) * f.k1(v) - a2 * f.k2[v] * f.k2[v]) / (a2 - 1));
    }
  }
  const double largest = f.largest_k1 * f.largest_k1;
  beta = std::max(beta, kSmallestBeta * largest);
  if (beta == 0 || (strength.max_anisotropy && f.largest_k1 <= kNoDifference)) {
    return euclidean_metric(surface, curvature, task);
  }
  return aligned_metric(curvature, follow, task, [&](std::size_t v) {
    return Eigenvalues{f.k1(v) * f.k1(v) + beta, f.k2[v] * f.k2[v] + beta};
  });
}

Metric concave_metric(const Surface& surface, const Curvature& curvature, double strength, const Task& task) {
  check_curvature(surface, curvature, task);
  if (!(std::isfinite(strength) && strength >= 0)) {
    throw InvalidInput("strength of the metric is " + text(strength) + ", not a finite number of at least 0");
  }
  const auto shortened = [strength](double k) {
    const double measured = kDeepest + (1 - kDeepest) * std::exp(std::min(0.0, k) / kConcavity);
    return 1 / (1 + strength * (1 / measured - 1));
  };
  return aligned_metric(curvature, Follow::kMin, task, [&](std::size_t v) {
    const double k1 = curvature.k1[v] / surface.scale(), k2 = curvature.k2[v] / surface.scale();
    const double s = std::max(0.0, std::abs(k1) - std::abs(k2)) * (k1 > 0 ? 0.5 : 1.0);
    const double l1 = 1 + kCreaseGamma * strength * s, c1 = shortened(k1), c2 = shortened(k2);
    return Eigenvalues{l1 * c2 * c2, c1 * c1 / l1};
  });
}

Metric euclidean_metric(const Surface& surface, const Curvature& curvature, const Task& task) {
  check_curvature(surface, curvature, task);
  Metric metric{.normals = copied(curvature.normals, task, 0.4), .tensors = {}};
  metric.tensors.reserve(metric.normals.size());
  Poll poll(task, 0.4, 1.0, metric.normals.size());
  for (const Vector& n : metric.normals) {
    poll.next();
    metric.tensors.push_back(Eigen::Matrix3d::Identity() - n * n.transpose());
  }
  return metric;
}

double anisotropy(const TensorAt& at) {
  if (at.normal.isZero(0)) return 1;
  // hypot keeps what a root of trace^2 - 4 det would lose where the eigenvalues are almost equal.
  const auto [p, q, r] = in_plane(at);
  const double l1 = (p + r + std::hypot(p - r, 2 * q)) / 2;
  return l1 / std::sqrt(p * r - q * q);
}

PrincipalAxes principal_axes(const TensorAt& at) {
  if (at.normal.isZero(0)) return {};
  const TangentFrame frame = tangent_frame(at.normal);
  const auto [p, q, r] = in_plane(at);
  const double l1 = (p + r + std::hypot(p - r, 2 * q)) / 2;
  const double angle = std::atan2(2 * q, p - r) / 2;
  const Vector e1 = (std::cos(angle) * frame.u + std::sin(angle) * frame.v()).normalized();
  // Their product is the determinant: the difference of two large numbers would lose a small eigenvalue.
  return {.l1 = l1, .l2 = (p * r - q * q) / l1, .e1 = e1, .e2 = at.normal.cross(e1)};
}

double max_anisotropy(const Metric& metric) {
  double largest = 1;
  for (std::size_t v = 0; v < metric.size(); ++v) {
    largest = std::max(largest, anisotropy({metric.normals[v], metric.tensors[v]}));
  }
  return largest;
}

double normal_weight(const Eigen::Matrix3d& m) {
  // The third eigenvalue is zero, so this is the product of the other two.
  return std::sqrt(std::max(0.0, sum_of_minors(m)));
}

double ambient_norm(const TensorAt& at, const Vector& e) {
  const double out = at.normal.dot(e);
  return std::sqrt(std::max(0.0, e.dot(at.tensor * e) + normal_weight(at.tensor) * out * out));
}

TensorAt midpoint_tensor(const TensorAt& a, const TensorAt& b) {
  Vector n = a.normal + b.normal;
  const double length = n.norm();
  n = length * length > 2 * kOppositeNormals ? Vector(n / length) : a.normal;
  return {n, (turned_by_least_rotation(a.tensor, a.normal, n) + turned_by_least_rotation(b.tensor, b.normal, n)) / 2};
}

double integrated_length(double norm_at_start, double norm_at_end) {
  const double sum = norm_at_start + norm_at_end;
  if (sum == 0) return 0;
  return 2.0 / 3.0 * (sum - norm_at_start * norm_at_end / sum);
}

double edge_length(const Surface& surface, const Metric& metric, std::int32_t a, std::int32_t b) {
  const auto i = static_cast<std::size_t>(a), j = static_cast<std::size_t>(b);
  const double unit = detail::exact_unit(surface);
  const Vector e = (surface.points()[j] - surface.points()[i]) * unit;
  return integrated_length(ambient_norm({metric.normals[i], metric.tensors[i]}, e),
                           ambient_norm({metric.normals[j], metric.tensors[j]}, e)) /
         unit;
}

}  // namespace seamwire
