// SPDX-License-Identifier: GPL-3.0-or-later
#include "seamwire/metric/metric.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <memory>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include "metric/tangent_frame.hpp"
#include "seamwire/context/embedded_surface.hpp"
#include "seamwire/context/surface_context.hpp"
#include "seamwire/edges/edge_graph.hpp"
#include "seamwire/embedding/embedding.hpp"
#include "seamwire/metric/curvature.hpp"
#include "seamwire/metric/scribble.hpp"
#include "shapes.hpp"

namespace seamwire {

using namespace detail;

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

// A square in z = 0 whose vertices have the given curvatures, the larger along x.
struct Patch {
  Surface surface = shapes::grid(4).surface();
  Curvature curvature;

  explicit Patch(const std::function<std::pair<double, double>(std::size_t)>& k) {
    for (std::size_t v = 0; v < surface.vertex_count(); ++v) {
      const auto [k1, k2] = k(v);
      curvature.k1.push_back(k1);
      curvature.k2.push_back(k2);
      curvature.d1.push_back(Vector::UnitX());
      curvature.d2.push_back(Vector::UnitY());
      curvature.normals.push_back(Vector::UnitZ());
    }
  }
};

// s = 1, 2, ... 25.
Patch rising() {
  return Patch([](std::size_t v) { return std::pair(3.0 + static_cast<double>(v), -2.0); });
}

TensorAt at(const Metric& metric, std::size_t v) { return {metric.normals[v], metric.tensors[v]}; }

void expect_isotropic(const Metric& metric) {
  for (std::size_t v = 0; v < metric.size(); ++v) {
    for (const Vector& e : {Vector(1, 0, 0), Vector(.3, -.4, 0), Vector(.2, .5, .7)}) {
      EXPECT_NEAR(ambient_norm(at(metric, v), e), e.norm(), 1e-15);
    }
  }
  EXPECT_EQ(max_anisotropy(metric), 1);
}

std::string message(const std::function<void()>& call) {
  try {
    call();
  } catch (const InvalidInput& error) {
    return error.what();
  }
  return "nothing thrown";
}

TEST(FeatureMetric, HasTheEigenvaluesOfEquation5AndFollowsTheDirectionAskedFor) {
  const Patch patch = rising();
  const double gamma = 0.1;
  const Metric min = feature_metric(patch.surface, patch.curvature, Follow::kMin, {.parameter = gamma});
  const Metric max = feature_metric(patch.surface, patch.curvature, Follow::kMax, {.parameter = gamma});
  for (std::size_t v = 0; v < min.size(); ++v) {
    const double l1 = 1 + gamma * (1 + static_cast<double>(v));
    // Along ridges, the direction of minimal curvature (y), the way is short under M_min, and long across.
    EXPECT_NEAR(ambient_norm(at(min, v), Vector::UnitX()), std::sqrt(l1), 1e-14);
    EXPECT_NEAR(ambient_norm(at(min, v), Vector::UnitY()), std::sqrt(1 / l1), 1e-14);
    EXPECT_NEAR(ambient_norm(at(max, v), Vector::UnitX()), std::sqrt(1 / l1), 1e-14);
    EXPECT_NEAR(ambient_norm(at(max, v), Vector::UnitY()), std::sqrt(l1), 1e-14);
    EXPECT_NEAR(anisotropy(at(min, v)), l1, 1e-13);
  }
  EXPECT_NEAR(max_anisotropy(min), 1 + gamma * 25, 1e-13);
}

TEST(FeatureMetric, IsEuclideanAtGammaZero) {
  const Patch patch = rising();
  expect_isotropic(feature_metric(patch.surface, patch.curvature, Follow::kMin, {.parameter = 0}));
  expect_isotropic(feature_metric(patch.surface, patch.curvature, Follow::kMax, {.max_anisotropy = 1}));
}

TEST(FeatureMetric, IsEuclideanWhereThereIsNoFeatureToScaleBy) {
  const Patch plane([](std::size_t) { return std::pair(0.0, 0.0); });
  // A sphere whose curvatures differ by rounding.
  const Patch sphere([](std::size_t v) { return std::pair(2 + 1e-12 * static_cast<double>(v), 2.0); });
  expect_isotropic(feature_metric(plane.surface, plane.curvature, Follow::kMin, {.max_anisotropy = 30}));
  expect_isotropic(feature_metric(sphere.surface, sphere.curvature, Follow::kMin, {.max_anisotropy = 30}));
  expect_isotropic(pottmann_kovacs_metric(plane.surface, plane.curvature, Follow::kMin, {.max_anisotropy = 30}));
}

TEST(FeatureMetric, ClampsSingleStrongVerticesAtAPercentile) {
  const Patch patch([](std::size_t v) { return std::pair(v == 7 ? 7219.0 : static_cast<double>(v), 0.0); });
  // s is 0..24 but for one; its 25 values have their 75th percentile at the 19th of them: 0..6, 8..19.
  const Strength strength{.parameter = 1, .max_anisotropy = std::nullopt, .clamp_percentile = 75};
  const Metric metric = feature_metric(patch.surface, patch.curvature, Follow::kMin, strength);
  EXPECT_NEAR(anisotropy(at(metric, 7)), 1 + 19, 1e-12);
  EXPECT_NEAR(anisotropy(at(metric, 24)), 1 + 19, 1e-12);
  EXPECT_NEAR(anisotropy(at(metric, 18)), 1 + 18, 1e-12);
  // Between two values it is interpolated: position 24 * .76 = 18.24.
  const Strength between{.parameter = 1, .max_anisotropy = std::nullopt, .clamp_percentile = 76};
  EXPECT_NEAR(max_anisotropy(feature_metric(patch.surface, patch.curvature, Follow::kMin, between)), 1 + 19.24, 1e-12);
  const Strength all{.parameter = 1, .max_anisotropy = std::nullopt, .clamp_percentile = 100};
  EXPECT_NEAR(max_anisotropy(feature_metric(patch.surface, patch.curvature, Follow::kMin, all)), 7220, 1e-8);
}

TEST(Metrics, ReachTheMaximumAnisotropyAskedForAndNoMore) {
  const Patch patch = rising();
  for (const double a : {1.5, 10.0, 100.0}) {
    for (const Follow follow : {Follow::kMin, Follow::kMax}) {
      const Strength strength{.max_anisotropy = a};
      // lambda2 is computed to rounding relative to lambda1 = A^2 lambda2, at most.
      EXPECT_NEAR(max_anisotropy(feature_metric(patch.surface, patch.curvature, follow, strength)), a, 1e-11 * a);
      EXPECT_NEAR(max_anisotropy(campen_metric(patch.surface, patch.curvature, follow, strength)), a, 1e-11 * a);
    }
  }
  // Pottmann-Kovacs cannot exceed |k1 / k2| = 27 / 2 here.
  for (const double a : {1.0, 1.5, 10.0}) {
    const Metric metric = pottmann_kovacs_metric(patch.surface, patch.curvature, Follow::kMin, {.max_anisotropy = a});
    EXPECT_NEAR(max_anisotropy(metric), a, 1e-11 * a);
  }
  const Metric metric = pottmann_kovacs_metric(patch.surface, patch.curvature, Follow::kMin, {.max_anisotropy = 100});
  EXPECT_NEAR(max_anisotropy(metric), 27 / 2.0, 1e-8);  // beta is 1e-12 of the largest k1^2, not 0
}

TEST(CampenMetric, HasTheEigenvaluesOfEquation3Everywhere) {
  const Patch patch([](std::size_t v) { return std::pair(v % 2 == 0 ? 5.0 : 0.0, 0.0); });
  const Metric metric = campen_metric(patch.surface, patch.curvature, Follow::kMin, {.parameter = 400});
  for (std::size_t v = 0; v < metric.size(); ++v) {
    EXPECT_NEAR(ambient_norm(at(metric, v), Vector::UnitX()), 20, 1e-13);
    EXPECT_NEAR(ambient_norm(at(metric, v), Vector::UnitY()), 1, 1e-13);
    EXPECT_NEAR(ambient_norm(at(metric, v), Vector::UnitZ()), std::sqrt(20), 1e-13);
  }
}

TEST(PottmannKovacsMetric, HasTheEigenvaluesOfEquation4) {
  const Patch patch = rising();
  const Metric metric = pottmann_kovacs_metric(patch.surface, patch.curvature, Follow::kMax, {.parameter = 0.5});
  for (std::size_t v = 0; v < metric.size(); ++v) {
    const double k1 = 3.0 + static_cast<double>(v);
    EXPECT_NEAR(ambient_norm(at(metric, v), Vector::UnitY()), std::sqrt(k1 * k1 + 0.5), 1e-13);
    EXPECT_NEAR(ambient_norm(at(metric, v), Vector::UnitX()), std::sqrt(4 + 0.5), 1e-13);
  }
}

TEST(PottmannKovacsMetric, VanishesNowhere) {
  // Flat on one side: with beta = 0 lengths there would be zero.
  const Patch patch([](std::size_t v) { return v < 10 ? std::pair(0.0, 0.0) : std::pair(4.0, 4.0); });
  for (const Strength& strength : {Strength{.parameter = 0}, Strength{.max_anisotropy = 5}}) {
    const Metric metric = pottmann_kovacs_metric(patch.surface, patch.curvature, Follow::kMin, strength);
    for (std::size_t v = 0; v < metric.size(); ++v) EXPECT_GT(ambient_norm(at(metric, v), Vector(1, 1, 0)), 0);
    EXPECT_NEAR(max_anisotropy(metric), 1, 1e-12);
  }
}

TEST(Metrics, AreEuclideanAtVerticesWithoutANormal) {
  Patch patch = rising();
  patch.curvature.normals[24] = patch.curvature.d1[24] = patch.curvature.d2[24] = Vector::Zero();
  for (const Metric& metric : {feature_metric(patch.surface, patch.curvature, Follow::kMin, {.parameter = 1}),
                               campen_metric(patch.surface, patch.curvature, Follow::kMin, {.parameter = 9}),
                               euclidean_metric(patch.surface, patch.curvature)}) {
    EXPECT_DOUBLE_EQ(ambient_norm(at(metric, 24), Vector(1, 2, 3)), Vector(1, 2, 3).norm());
  }
  // Nor do such vertices decide how strong it is elsewhere: the largest s is that of vertex 23.
  const Metric metric = feature_metric(patch.surface, patch.curvature, Follow::kMin, {.max_anisotropy = 9});
  EXPECT_NEAR(anisotropy(at(metric, 23)), 9, 1e-12);
}

TEST(EuclideanMetric, GivesEveryVectorItsLength) {
  const Patch patch = rising();
  expect_isotropic(euclidean_metric(patch.surface, patch.curvature));
}

TEST(Metrics, RefuseWhatMakesNoSense) {
  const Patch patch = rising();
  const auto feature = [&](const Strength& strength) {
    return message([&] { feature_metric(patch.surface, patch.curvature, Follow::kMin, strength); });
  };
  EXPECT_NE(feature({}).find("either"), std::string::npos);
  EXPECT_NE(feature({.parameter = 1, .max_anisotropy = 2}).find("either"), std::string::npos);
  for (const double bad : {-1.0, kInfinity, kNan}) {
    EXPECT_NE(feature({.parameter = bad}).find("parameter"), std::string::npos) << bad;
    EXPECT_NE(feature({.max_anisotropy = bad}).find("anisotropy"), std::string::npos) << bad;
  }
  EXPECT_NE(feature({.max_anisotropy = 0.9}).find("anisotropy"), std::string::npos);
  for (const double bad : {0.0, -1.0, 100.1, kNan}) {
    const Strength strength{.parameter = 1, .max_anisotropy = std::nullopt, .clamp_percentile = bad};
    EXPECT_NE(feature(strength).find("percentile"), std::string::npos) << bad;
  }
  // A finite gamma can still be too much for numbers.
  EXPECT_NE(feature({.parameter = 1e308}).find("vertex"), std::string::npos);
  EXPECT_THROW(campen_metric(patch.surface, patch.curvature, Follow::kMin, {.parameter = 0.5}), InvalidInput);
  EXPECT_THROW(pottmann_kovacs_metric(patch.surface, patch.curvature, Follow::kMin, {.parameter = -0.5}), InvalidInput);
}

TEST(ConcaveMetric, IsShortAlongValleysLessSoAlongRidgesAndNotAcrossThem) {
  const auto of = [](double k1, double k2, double strength) {
    const Patch patch([&](std::size_t) { return std::pair(k1, k2); });
    return at(concave_metric(patch.surface, patch.curvature, strength), 0);
  };
  for (const double t : {1.0, 2.5}) {
    const double l1 = 1 + 0.03 * t * 12, half = 1 + 0.03 * t * 6;
    const auto c = [t](double k) { return 1 / (1 + t * (1 / (0.3 + 0.7 * std::exp(k / 16)) - 1)); };
    // A valley along y.
    EXPECT_NEAR(ambient_norm(of(-16, 4, t), Vector::UnitY()), c(-16) / std::sqrt(l1), 1e-14);
    EXPECT_NEAR(ambient_norm(of(-16, 4, t), Vector::UnitX()), std::sqrt(l1), 1e-14);
    // A ridge along y, itself bent downwards.
    EXPECT_NEAR(ambient_norm(of(16, -4, t), Vector::UnitY()), 1 / std::sqrt(half), 1e-14);
    EXPECT_NEAR(ambient_norm(of(16, -4, t), Vector::UnitX()), std::sqrt(half) * c(-4), 1e-14);
  }
  EXPECT_NEAR(ambient_norm(of(-1e6, 0, 0), Vector(3, 4, 0)), 5, 1e-14);  // no strength
  EXPECT_NEAR(ambient_norm(of(0, 0, 1), Vector(3, 4, 0)), 5, 1e-14);     // no curvature
}

TEST(ConcaveMetric, RefusesWhatIsNoStrength) {
  const Patch patch = rising();
  for (const double strength : {-1.0, kNan, kInfinity}) {
    EXPECT_NE(message([&] { concave_metric(patch.surface, patch.curvature, strength); }).find("strength"),
              std::string::npos);
  }
  EXPECT_NE(message([&] { concave_metric(shapes::grid(2).surface(), patch.curvature); }).find("vertices"),
            std::string::npos);
  EXPECT_NE(message([&] { concave_metric(patch.surface, patch.curvature, 1e300); }).find("too strong"),
            std::string::npos);
}

TEST(Metrics, AreRefusedByNameIfATensorIsNotSymmetricAndPositive) {
  const Surface surface = shapes::grid(3).surface();
  const Metric good = euclidean_metric(surface, principal_curvatures(surface));
  const std::vector<std::int32_t> faces{0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 16, 17};
  const auto expect_refused = [&](const Metric& bad, const std::string& why) {
    const std::vector<std::string> messages{
        message([&] { embed(surface, bad, {.max_error = 0}); }),
        message([&] { embed(surface, bad, {.max_error = 0, .faces = faces}); }),
        message([&] { re_embed(surface, good, bad, embed(surface, good, {.max_error = 0}), {.max_error = 0}); }),
        message([&] { invalid_faces(surface, bad); }),
        message([&] { apply_scribbles(surface, bad, {}); }),
        message([&] { make_edge_graph(surface, bad); }),
        message([&] {
          EmbeddedSurface(SurfaceContext(std::make_shared<const Surface>(surface)), std::make_shared<const Metric>(bad),
                          embed(surface, good, {.max_error = 0}));
        })};
    for (const std::string& each : messages) EXPECT_EQ(each, "the metric at vertex 6 " + why);
  };
  const auto with = [&](const Eigen::Matrix3d& tensor, const Vector& normal = Vector::UnitZ()) {
    Metric metric = good;
    metric.tensors[6] = tensor;
    metric.normals[6] = normal;
    return metric;
  };
  const auto diagonal = [](double x, double y, double z) { return Eigen::Matrix3d(Vector(x, y, z).asDiagonal()); };
  const std::string not_positive = "is invalid: its tensor has an eigenvalue that is not positive";
  expect_refused(with(Eigen::Matrix3d::Zero()), not_positive);
  expect_refused(with(diagonal(1, 0, 0)), not_positive);
  expect_refused(with(diagonal(1, -1, 0)), not_positive);
  expect_refused(with(diagonal(1e8, -1e8, 0)), not_positive);
  expect_refused(with(diagonal(-1, -1, 0)), not_positive);
  expect_refused(with(diagonal(1e-200, 1e-200, 0)), not_positive);
  expect_refused(with(diagonal(1, 1, 0), Vector::Zero()), not_positive);
  expect_refused(with(diagonal(-1, -1, 1), Vector::Zero()), not_positive);
  expect_refused(with(diagonal(5, 5, -1)), not_positive);
  Eigen::Matrix3d skew = diagonal(1, 1, 0);
  skew(0, 1) = 0.5;
  expect_refused(with(skew), "is invalid: its tensor is not symmetric");
  expect_refused(with(diagonal(1, kNan, 0)), "is not finite");
  expect_refused(with(diagonal(kInfinity, 1, 0)), "is not finite");
  expect_refused(with(diagonal(1, 1, 0), Vector(0, 0, kNan)), "is not finite");
  // Positive, although rounding leaves little of the smaller eigenvalue.
  for (const double l1 : {1.0, 20.0, 1e5, 1e9, 1e100}) {
    const Vector e1 = Vector(0.6, 0.8, 0), e2 = Vector(-0.8, 0.6, 0);
    const Metric strong = with(l1 * e1 * e1.transpose() + 1 / l1 * e2 * e2.transpose());
    EXPECT_EQ(message([&] { make_edge_graph(surface, strong); }), "nothing thrown") << l1;
  }
}

TEST(Metrics, RefuseEigenvaluesWhoseSquaresAreNoNumbers) {
  const Patch patch = rising();
  const auto too_strong = [&](auto family, const Strength& strength) {
    return message([&] { family(patch.surface, patch.curvature, Follow::kMin, strength, Task{}); });
  };
  EXPECT_NE(too_strong(pottmann_kovacs_metric, {.parameter = 1e160}).find("too strong"), std::string::npos);
  EXPECT_NE(too_strong(campen_metric, {.parameter = 1e160}).find("1e+160"), std::string::npos);
  EXPECT_NE(too_strong(campen_metric, {.max_anisotropy = 1e100}).find("too strong"), std::string::npos);
  // Whatever is let through has lengths.
  for (const Metric& metric :
       {pottmann_kovacs_metric(patch.surface, patch.curvature, Follow::kMin, {.parameter = 1e149}),
        feature_metric(patch.surface, patch.curvature, Follow::kMin, {.max_anisotropy = 1e100})}) {
    for (const auto& [a, b] : patch.surface.edges()) {
      const double length = edge_length(patch.surface, metric, a, b);
      EXPECT_TRUE(std::isfinite(length) && length > 0) << length;
    }
  }
}

TEST(Metrics, SayNumbersInMessagesWithTheDigitsThatTellThemApart) {
  const Patch patch = rising();
  const auto said = [&](auto family, const Strength& strength) {
    return message([&] { family(patch.surface, patch.curvature, Follow::kMin, strength, Task{}); });
  };
  EXPECT_NE(said(feature_metric, {.parameter = -1e-9}).find("-1e-09, not a finite number of at least 0"),
            std::string::npos);
  EXPECT_NE(said(feature_metric, {.max_anisotropy = 1 - 1e-16}).find("0.99999999999999989,"), std::string::npos);
  EXPECT_NE(said(campen_metric, {.parameter = 0.1}).find("is 0.1, not"), std::string::npos);
}

TEST(Metrics, NameTheVertexWhoseCurvatureIsNotFinite) {
  Patch patch = rising();
  patch.curvature.k2[11] = kNan;
  const std::string said =
      message([&] { feature_metric(patch.surface, patch.curvature, Follow::kMin, {.parameter = 1}); });
  EXPECT_NE(said.find("vertex 11 "), std::string::npos) << said;
  patch.curvature.k2.pop_back();
  EXPECT_THROW(euclidean_metric(patch.surface, patch.curvature), InvalidInput);
}

TEST(AmbientNorm, IsAQuadraticFormOnSpaceThatGivesTheNormalTheGeometricMean) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> uniform(-1, 1);
  for (int trial = 0; trial < 100; ++trial) {
    const auto vector = [&] { return Vector(uniform(random), uniform(random), uniform(random)); };
    const Vector n = vector().normalized(), e1 = n.cross(vector()).normalized(), e2 = n.cross(e1);
    const double l1 = 1 + 50 * std::abs(uniform(random)), l2 = 1 / (1 + 20 * std::abs(uniform(random)));
    const TensorAt tensor{n, l1 * e1 * e1.transpose() + l2 * e2 * e2.transpose()};
    const Vector e = vector();
    const double expected =
        l1 * std::pow(e.dot(e1), 2) + l2 * std::pow(e.dot(e2), 2) + std::sqrt(l1 * l2) * std::pow(e.dot(n), 2);
    EXPECT_NEAR(std::pow(ambient_norm(tensor, e), 2), expected, 1e-12 * expected);
    EXPECT_DOUBLE_EQ(ambient_norm(tensor, e), ambient_norm(tensor, -e));
    EXPECT_NEAR(anisotropy(tensor), std::sqrt(l1 / l2), 1e-11 * std::sqrt(l1 / l2));
  }
}

TEST(IntegratedLength, IsTheIntegralOfANormWhoseSquareIsLinear) {
  for (const auto& [a, b] : {std::pair(1.0, 1.0), {0.2, 3.0}, {5.0, 0.0}, {1e-3, 1e3}}) {
    const int n = 20000;
    double sum = 0;
    for (int i = 0; i < n; ++i) sum += std::sqrt(a * a + (b * b - a * a) * (i + 0.5) / n) / n;
    // The midpoint rule is off by about n^-1.5 where the norm starts at zero.
    EXPECT_NEAR(integrated_length(a, b), sum, 1e-6 * sum);
    EXPECT_EQ(integrated_length(a, b), integrated_length(b, a));
  }
  EXPECT_EQ(integrated_length(0, 0), 0);
  EXPECT_DOUBLE_EQ(integrated_length(0.7, 0.7), 0.7);
}

TEST(EdgeLength, IsInTheCallersUnitAndTheSameBothWays) {
  shapes::Mesh mesh = shapes::grid(4);
  for (Vector& p : mesh.points) p *= 8;
  const Surface surface = mesh.surface();
  const Patch patch = rising();
  const Metric metric = feature_metric(patch.surface, patch.curvature, Follow::kMin, {.parameter = 1});
  // Vertices 0 and 1 are a quarter of the square apart, across the direction to follow; l1 there is 2 and 3.
  EXPECT_NEAR(edge_length(surface, metric, 0, 1), integrated_length(std::sqrt(2.0), std::sqrt(3.0)) * 2, 1e-15);
  EXPECT_EQ(edge_length(surface, metric, 0, 6), edge_length(surface, metric, 6, 0));
}

TEST(PrincipalAxes, AreThoseThatATensorIsMadeOf) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> coordinate(-1, 1), exponent(-4, 4);
  for (int i = 0; i < 100; ++i) {
    const Vector n = Vector(coordinate(random), coordinate(random), coordinate(random)).normalized();
    const Vector e1 = n.cross(Vector(coordinate(random), coordinate(random), coordinate(random))).normalized();
    const Vector e2 = n.cross(e1);
    const double l2 = std::exp(exponent(random)), l1 = l2 * (1 + std::exp(exponent(random)));
    const PrincipalAxes axes = principal_axes({n, l1 * e1 * e1.transpose() + l2 * e2 * e2.transpose()});
    EXPECT_NEAR(axes.l1 / l1, 1, 1e-12);
    EXPECT_NEAR(axes.l2 / l2, 1, 1e-9);
    EXPECT_NEAR(std::abs(axes.e1.dot(e1)), 1, 1e-12);
    EXPECT_NEAR((axes.e1.cross(axes.e2) - n).norm(), 0, 1e-12);
  }
  EXPECT_TRUE(principal_axes({Vector::Zero(), Eigen::Matrix3d::Identity()}).e1.isZero(0));
}

TEST(MidpointTensor, IsNeverMoreAnisotropicThanTheEnds) {
  std::mt19937 random(2);
  std::uniform_real_distribution<double> uniform(-1, 1);
  const auto vector = [&] { return Vector(uniform(random), uniform(random), uniform(random)); };
  const auto tensor = [&] {
    const Vector n = vector().normalized(), e1 = n.cross(vector()).normalized(), e2 = n.cross(e1);
    const double a = 1 + 30 * std::abs(uniform(random)), scale = 1.5 + uniform(random);
    return TensorAt{n, scale * (a * e1 * e1.transpose() + 1 / a * e2 * e2.transpose())};
  };
  for (int trial = 0; trial < 1000; ++trial) {
    std::vector<TensorAt> all{tensor(), tensor(), tensor(), tensor()};
    double largest = 0;
    for (const TensorAt& t : all) largest = std::max(largest, anisotropy(t));
    while (all.size() < 24) {
      const std::size_t i = random() % all.size(), j = random() % all.size();
      all.push_back(midpoint_tensor(all[i], all[j]));
      EXPECT_NEAR(all.back().normal.norm(), 1, 1e-14);
      EXPECT_LE((all.back().tensor * all.back().normal).norm(), 1e-13 * all.back().tensor.norm());
      EXPECT_LE(anisotropy(all.back()), largest * (1 + 1e-9));
    }
  }
}

TEST(MidpointTensor, TurnsTensorsWithTheirNormals) {
  // A quarter turn of the plane about the direction of the minor eigenvector leaves that one, and takes e1 along.
  const auto bent = [](double angle) {
    const Vector n(std::sin(angle), 0, std::cos(angle)), e1(std::cos(angle), 0, -std::sin(angle));
    return TensorAt{n, 9 * e1 * e1.transpose() + Vector::UnitY() * Vector::UnitY().transpose()};
  };
  const TensorAt middle = midpoint_tensor(bent(0), bent(std::numbers::pi / 2)), expected = bent(std::numbers::pi / 4);
  EXPECT_TRUE(middle.normal.isApprox(expected.normal, 1e-14));
  EXPECT_TRUE(middle.tensor.isApprox(expected.tensor, 1e-14));
}

// Normals that are opposite but for an angle: as long as that is not rounding, the least rotation turns about the axis
// that it says, whatever is turned.
TEST(LeastRotation, IsThatOfNormalsWhichAreNotQuiteOpposite) {
  for (const double angle : {1e-1, 1e-3, 1e-4, 1e-5}) {
    const Vector from = Vector::UnitZ(), to(std::sin(angle), 0, -std::cos(angle)), x(1, 0, 0), y(0, 1, 0);
    const Vector turned(-std::cos(angle), 0, -std::sin(angle));
    // The rounding of 1 + m.n = angle^2 / 2.
    const double tolerance = 1e-15 / (angle * angle);
    EXPECT_NEAR((turned_by_least_rotation(x, from, to) - turned).norm(), 0, tolerance);
    EXPECT_EQ(turned_by_least_rotation(y, from, to), y);
    const Vector d = 0.6 * x + 0.8 * y, turned_d = 0.6 * turned + 0.8 * y;
    const Eigen::Matrix3d dd = d * d.transpose(), tensor = turned_by_least_rotation(dd, from, to);
    EXPECT_NEAR((tensor - turned_d * turned_d.transpose()).norm(), 0, tolerance);
    const TensorAt middle = midpoint_tensor({from, x * x.transpose()}, {to, turned * turned.transpose()});
    EXPECT_NEAR((middle.normal - Vector(1, 0, 0)).norm(), 0, angle);
    EXPECT_NEAR(middle.tensor(2, 2), 1, angle);
  }
  for (const double angle : {0.0, 1e-8, 1e-6}) {  // opposite
    const Vector from = Vector::UnitZ(), to(std::sin(angle), 0, -std::cos(angle)), x(1, 0, 0);
    EXPECT_EQ(turned_by_least_rotation(x, from, to), x);
    EXPECT_EQ(midpoint_tensor({from, x * x.transpose()}, {to, x * x.transpose()}).normal, from);
  }
}

TEST(MidpointTensor, KeepsOneOfOppositeNormals) {
  const TensorAt a{Vector::UnitZ(), Vector(4, 1, 0).asDiagonal()}, b{-Vector::UnitZ(), Vector(1, 4, 0).asDiagonal()};
  const TensorAt middle = midpoint_tensor(a, b);
  EXPECT_EQ(middle.normal, a.normal);
  EXPECT_TRUE(middle.tensor.isApprox(Eigen::Matrix3d(Vector(2.5, 2.5, 0).asDiagonal()), 1e-14));
}

}  // namespace
}  // namespace seamwire
