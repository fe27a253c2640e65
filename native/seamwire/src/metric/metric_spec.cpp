// SPDX-License-Identifier: GPL-3.0-or-later
#include "seamwire/metric/metric_spec.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <string>

namespace seamwire {
namespace {

constexpr std::array<MetricFamilyInfo, 5> kFamilies = {{
    {MetricFamily::kFeature, "feature", "gamma", 0.0, {.parameter = 0.1}, true, true},
    {MetricFamily::kCampen, "campen", "alpha", 1.0, {.max_anisotropy = 10.0}, true, false},
    {MetricFamily::kPottmannKovacs, "pottmann_kovacs", "beta", 0.0, {.max_anisotropy = 10.0}, true, true},
    {MetricFamily::kConcave, "concave", "strength", 0.0, {.parameter = 1.0}, false, false},
    {MetricFamily::kEuclidean, "euclidean", "", 0.0, {}, false, false},
}};

/// The strength 1 of the concave metric goes with this gamma of the feature metric.
constexpr double kGammaOfConcave = 0.1;

}  // namespace

std::span<const MetricFamilyInfo> metric_families() { return kFamilies; }

const MetricFamilyInfo& info_of(MetricFamily family) {
  const auto number = static_cast<std::size_t>(family);
  if (number >= kFamilies.size()) throw InvalidInput("metric: there is no family " + std::to_string(number));
  return kFamilies[number];
}

MetricFamily metric_family(std::string_view name) {
  const auto found = std::ranges::find(kFamilies, name, &MetricFamilyInfo::name);
  if (found != kFamilies.end()) return found->family;
  std::string known;
  for (std::size_t i = 0; i < kFamilies.size(); ++i) {
    known += i == 0 ? "'" : i + 1 == kFamilies.size() ? " or '" : ", '";
    known += std::string(kFamilies[i].name) + "'";
  }
  throw InvalidInput("metric: expected " + known + ", got '" + std::string(name) + "'");
}

MetricSpec MetricSpec::feature(Follow follow, const Strength& strength) {
  return {.family = MetricFamily::kFeature, .follow = follow, .strength = strength};
}

MetricSpec MetricSpec::concave(const Strength& strength) {
  return {.family = MetricFamily::kConcave, .follow = std::nullopt, .strength = strength};
}

MetricSpec MetricSpec::concave_like(const Strength& feature) {
  Strength strength{.parameter = feature.parameter, .max_anisotropy = feature.max_anisotropy};
  if (strength.parameter) *strength.parameter /= kGammaOfConcave;
  return concave(strength);
}

MetricKind MetricSpec::kind() const {
  if (family == MetricFamily::kConcave) return MetricKind::kConcave;
  if (family == MetricFamily::kEuclidean) return MetricKind::kEuclidean;
  return follow == Follow::kMax ? MetricKind::kMax : MetricKind::kMin;
}

bool is_counterpart(const MetricSpec& one, const MetricSpec& other) {
  return one.family == other.family && one.strength == other.strength && one.follow != other.follow;
}

void check_metric(const MetricSpec& spec) {
  const MetricFamilyInfo& info = info_of(spec.family);
  const std::string name = "the metric '" + std::string(info.name) + "'";
  if (spec.follow.has_value() != info.has_directions) {
    throw InvalidInput(name + (info.has_directions ? " needs a direction to follow" : " follows no direction"));
  }
  if (!info.parameter.empty()) {
    check_strength(spec.strength, info.least_parameter);
  } else if (spec.strength != Strength{}) {
    throw InvalidInput(name + " has no strength");
  }
}

}  // namespace seamwire
