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
  std::string_view parameter;  ///< the name of Strength::parameter; empty if the family has no strength
  double least_parameter;      ///< the smallest parameter that is allowed
  Strength initial;            ///< the default strength
  bool has_directions;         ///< whether a metric follows one of the principal directions
  bool has_clamp;              ///< whether Strength::clamp_percentile has an effect
};

/// Return all families, in the order of MetricFamily.
SEAMWIRE_API std::span<const MetricFamilyInfo> metric_families();
/// Return the description of a family.
///
/// \param family the family
/// \throws InvalidInput if there is no such family
SEAMWIRE_API const MetricFamilyInfo& info_of(MetricFamily family);
/// Find a family by its name.
///
/// \param name as in MetricFamilyInfo::name
/// \returns the family
/// \throws InvalidInput if there is no family of this name. The message begins with "metric".
SEAMWIRE_API MetricFamily metric_family(std::string_view name);

/// Describes a metric as a value that can be computed on any surface. Equal specs give equal metrics.
struct SEAMWIRE_API MetricSpec {
  MetricFamily family = MetricFamily::kEuclidean;  ///< the family
  std::optional<Follow> follow = std::nullopt;     ///< only set in families that have directions
  /// The strength. For kConcave, the parameter is the strength of concave_metric(), and a max_anisotropy A gives (A -
  /// 1) / 19. For kEuclidean, nothing is set.
  Strength strength = {};

  /// Describe the feature metric.
  ///
  /// \param follow the principal directions that are short
  /// \param strength the strength
  /// \see Zhuang et al. 2014, eq. 5
  static MetricSpec feature(Follow follow, const Strength& strength = {.parameter = 0.1});
  /// Describe the metric of concave creases, on curvatures smoothed over 0.01.
  ///
  /// \param strength the strength
  static MetricSpec concave(const Strength& strength = {.parameter = 1.0});
  /// Describe the metric of concave creases that is as strong as a feature metric.
  ///
  /// \param feature the strength of a feature metric
  /// \returns the description, with the parameter gamma / 0.1 or the same maximum anisotropy
  static MetricSpec concave_like(const Strength& feature);
  /// Describe the Euclidean metric.
  static MetricSpec euclidean() { return {}; }

  /// Return what the paths of the metric follow.
  MetricKind kind() const;
  /// Compare member by member.
  friend bool operator==(const MetricSpec&, const MetricSpec&) = default;
};

/// Return whether two metrics differ only in the direction that they follow. Lengths in both can then be compared.
///
/// \param one a metric
/// \param other another metric
/// \see Zhuang et al. 2014, Section 5
SEAMWIRE_API bool is_counterpart(const MetricSpec& one, const MetricSpec& other);
/// Check a spec.
///
/// \param spec the spec
/// \throws InvalidInput if the spec has a direction although its family has none, or the reverse
/// \throws InvalidInput if check_strength() rejects the strength, or a Euclidean metric has a strength
SEAMWIRE_API void check_metric(const MetricSpec& spec);

}  // namespace seamwire
