// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <span>
#include <string_view>

#include "seamwire/api.hpp"
#include "seamwire/metric/metric.hpp"
#include "seamwire/metric/scribble.hpp"

namespace seamwire {

/// The families of metrics in metric.hpp.
enum class MetricFamily { kFeature, kCampen, kPottmannKovacs, kConcave, kEuclidean };

/// The name and the parameters of a family of metrics.
struct MetricFamilyInfo {
  MetricFamily family;         ///< the family
  std::string_view name;       ///< "feature", "campen", "pottmann_kovacs", "concave" or "euclidean"
  std::string_view parameter;  ///< the name of Strength::parameter; empty: the family has no strength
  double least_parameter;      ///< the smallest parameter that is allowed
  Strength initial;            ///< the default strength
  bool has_directions;         ///< whether a metric follows one of the principal directions
  bool has_clamp;              ///< whether Strength::clamp_percentile matters
};

/// All families, in the order of MetricFamily.
SEAMWIRE_API std::span<const MetricFamilyInfo> metric_families();
/// The row of one family.
SEAMWIRE_API const MetricFamilyInfo& info_of(MetricFamily family);
/// The family of that name. Throws InvalidInput for any other name; the message begins with "metric".
SEAMWIRE_API MetricFamily metric_family(std::string_view name);

/// A metric as a value: what it takes to compute it on any surface. Two specs that are equal give the same metric.
struct MetricSpec {
  MetricFamily family = MetricFamily::kEuclidean;  ///< which one
  std::optional<Follow> follow = std::nullopt;     ///< in the families that have directions only
  /// kConcave: the parameter is that of concave_metric(), and max_anisotropy A gives (A - 1) / 19. Euclidean: nothing
  /// is set.
  Strength strength = {};

  /// The feature metric (eq. 5).
  static MetricSpec feature(Follow follow, const Strength& strength = {.parameter = 0.1});
  /// Campen et al.'s metric (eq. 3).
  static MetricSpec campen(Follow follow, const Strength& strength);
  /// Pottmann et al.'s and Kovacs et al.'s metric (eq. 4).
  static MetricSpec pottmann_kovacs(Follow follow, const Strength& strength);
  /// The metric of concave creases, on curvatures smoothed over 0.01.
  static MetricSpec concave(const Strength& strength = {.parameter = 1.0});
  /// The metric of concave creases that is as strong as a feature metric: gamma / 0.1, or the same maximum anisotropy.
  static MetricSpec concave_like(const Strength& feature);
  /// The Euclidean metric.
  static MetricSpec euclidean() { return {}; }

  /// What its paths follow.
  MetricKind kind() const;
  /// Member by member.
  friend bool operator==(const MetricSpec&, const MetricSpec&) = default;
};

/// Whether two metrics differ only in the direction that they follow, so that lengths in both can be compared (Section
/// 5 of the paper).
SEAMWIRE_API bool is_counterpart(const MetricSpec& one, const MetricSpec& other);
/// Throws InvalidInput unless the spec has a direction exactly if its family has, and a strength as metric.hpp says.
SEAMWIRE_API void check_metric(const MetricSpec& spec);

}  // namespace seamwire
