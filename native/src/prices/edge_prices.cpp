// SPDX-License-Identifier: GPL-3.0-or-later
#include "prices/edge_prices.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "detail/index.hpp"
#include "detail/poll.hpp"
#include "prices/border_odds.hpp"
#include "tuning/constants.hpp"

namespace seamwire::detail {
namespace {

double ramp(double value, double from, double width) { return std::clamp((value - from) / width, 0.0, 1.0); }

/// Values divided by their mean over the area.
std::vector<double> normalized(std::vector<double> values, std::span<const double> areas) {
  double sum = 0.0, total = 0.0;
  for (std::size_t v = 0; v < values.size(); ++v) {
    sum += areas[v] * values[v];
    total += areas[v];
  }
  const double mean = total > 0.0 ? sum / total : 0.0;
  for (double& value : values) value = mean > 0.0 ? value / mean : 1.0;
  return values;
}

/// How visible each vertex is, the same on both sides of a symmetric mesh.
std::vector<double> openness(const PlanMesh& mesh, const Visibility& visibility,
                             const std::optional<Reflection>& reflection, std::span<const FaceFrame> frames) {
  const std::vector<double> areas = vertex_areas(mesh, frames);
  std::vector<double> open = normalized(visibility.ambient, areas);
  if (!visibility.front.empty()) {
    const std::vector<double> front = normalized(visibility.front, areas);
    for (std::size_t v = 0; v < open.size(); ++v) {
      open[v] = tuning::kFrontShare * front[v] + (1.0 - tuning::kFrontShare) * open[v];
    }
  }
  if (!reflection) return open;
  std::vector<double> both = open;
  for (std::size_t v = 0; v < open.size(); ++v) {
    const std::int32_t image = reflection->images[v];
    if (image >= 0) both[v] = 0.5 * (open[v] + open[image]);
  }
  return both;
}

/// The price of a place, by its visibility.
double price_at(double open) {
  const double seen = tuning::kHidden + (1.0 - tuning::kHidden) * std::pow(open, 3);
  const double exposed = ramp(open, tuning::kExposed, tuning::kExposedWidth);
  return seen * (1.0 + tuning::kExposedPrice * exposed * exposed);
}

/// The price of a seam along each edge for its length, by the shape of the surface. It is 1 in a flat place.
std::vector<double> shape_prices(const PlanMesh& mesh, const EdgeBends& bends, std::span<const double> odds,
                                 const Task& task) {
  const auto middle = [&](std::int32_t h) {
    const auto& [a, b, c] = mesh.triangles[h / 3];
    return Vector((mesh.points[a] + mesh.points[b] + mesh.points[c]) / 3.0);
  };
  std::vector<double> prices;
  const Poll poll(task, 0.0, 0.0, 1);
  for (std::int32_t e = 0; index(e) < mesh.edge_count(); ++e) {
    poll.at(index(e));
    const std::int32_t h = mesh.half_edge_of[e], twin = mesh.twins[h];
    const double width = twin < 0 ? 0.0 : (middle(twin) - middle(h)).norm();
    const double curvature = width > 0.0 ? std::abs(bends.own[e]) * std::numbers::pi / 180.0 / width : 0.0;
    const double ridge = 1.0 - tuning::kRidgeSaving * std::clamp(curvature / tuning::kRidgeCurvature, 0.0, 1.0);
    prices.push_back(ridge * price_of_cut(std::max(odds[e], tuning::kFlatOdds)) / price_of_cut(tuning::kFlatOdds));
  }
  return prices;
}

/// From 0 for an organic surface to 1 for a machine part: how much of its bending is in sharp edges, where most other
/// edges hardly bend. The latter tells machine parts from organic surfaces of few triangles.
double hardness(const PlanMesh& mesh, std::span<const double> bends) {
  double sharp = 0.0, bending = 0.0, flat = 0.0, length = 0.0;
  for (std::size_t e = 0; e < bends.size(); ++e) {
    const double amount = mesh.lengths[e] * std::abs(bends[e]);
    bending += amount;
    length += mesh.lengths[e];
    if (std::abs(bends[e]) > tuning::kHardSharp) sharp += amount;
    if (std::abs(bends[e]) < tuning::kHardFlat) flat += mesh.lengths[e];
  }
  if (!(bending > 0.0)) return 0.0;
  return ramp(sharp / bending, tuning::kHardFrom, tuning::kHardWidth) *
         ramp(flat / length, tuning::kHardFlatFrom, tuning::kHardFlatWidth);
}

}  // namespace

EdgePrices find_prices(const PlanMesh& mesh, const Visibility& visibility, const std::optional<Reflection>& reflection,
                       std::span<const double> weights, const Task& task) {
  const std::vector<FaceFrame> frames = face_frames(mesh, task);
  EdgePrices prices{.of_edge = {}, .visibility = openness(mesh, visibility, reflection, frames), .is_exposed = {}};
  const Polygons polygons = find_polygons(mesh, frames, {}, task);
  const PieceSizes sizes = measure_pieces(mesh, frames, task);
  const EdgeBends bends = bends_over_edges(mesh, frames, polygons, sizes, task);
  // Openness is in the price of a place, so it must not count twice.
  const std::vector<double> even(mesh.vertex_count(), 1.0);
  const std::vector<std::uint8_t> none(mesh.edge_count(), 0);
  const std::vector<double> odds = border_odds(mesh, polygons, sizes, bends, even, none,
                                               reflection ? &*reflection : nullptr, tuning::kSlitOnPlane, task);
  const std::vector<double> shapes = shape_prices(mesh, bends, odds, task);
  // On machine parts sharp edges hide seams on every side, and no place is exposed.
  const double hard = hardness(mesh, bends.own);
  for (const double open : prices.visibility) {
    prices.is_exposed.push_back(open >= tuning::kExposed + tuning::kExposedWidth && hard < 0.5 ? 1 : 0);
  }
  double sum = 0.0, length = 0.0;
  const Poll poll(task, 0.0, 0.0, 1);
  for (std::int32_t e = 0; index(e) < mesh.edge_count(); ++e) {
    poll.at(index(e));
    const std::int32_t a = mesh.tail(mesh.half_edge_of[e]), b = mesh.tip(mesh.half_edge_of[e]);
    const double seen = 0.5 * (price_at(prices.visibility[a]) + price_at(prices.visibility[b]));
    const double weight = weights.empty() ? 1.0 : 0.5 * (weights[a] + weights[b]);
    const double sharpness = ramp(std::abs(bends.own[e]), tuning::kSharpFrom, tuning::kSharpWidth);
    const double price = mesh.lengths[e] * std::pow(seen, 1.0 - hard * sharpness) * shapes[e] * weight;
    prices.of_edge.push_back(mesh.is_real[e] == 0 || !std::isfinite(price) ? kInfinity : price);
    if (prices.of_edge.back() == kInfinity) continue;
    sum += price;
    length += mesh.lengths[e];
  }
  if (reflection && reflection->is_exact) {
    const std::vector<double> own = prices.of_edge;
    for (std::int32_t e = 0; index(e) < mesh.edge_count(); ++e) {
      poll.at(index(e));
      const std::int32_t image = image_of_edge(mesh, *reflection, e);
      if (image < 0) continue;
      const bool is_barred = own[e] == kInfinity || own[image] == kInfinity;
      prices.of_edge[e] = is_barred ? kInfinity : std::sqrt(own[e] * own[image]);
    }
  }
  if (hard > 0.0) prices.bargain = tuning::kBargain / hard;
  prices.of_slit = tuning::kSlitPrice * (1.0 - tuning::kHardSaving * hard);
  prices.turning = length > 0.0 ? tuning::kTurnPrice * median_length(mesh) * sum / length : 0.0;
  return prices;
}

}  // namespace seamwire::detail
