// SPDX-License-Identifier: GPL-3.0-or-later
#include "search/distortion_peaks.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "detail/index.hpp"
#include "slits/slit_paths.hpp"
#include "tuning/constants.hpp"

namespace seamwire::detail {
namespace {

/// How much more than an isometry the triangles around each vertex have, by area.
std::vector<double> excess_at_vertices(const SlitProblem& problem, const SlitPlan& plan) {
  const PlanMesh& mesh = problem.mesh;
  std::vector<double> excess(mesh.vertex_count(), 0.0);
  for (const auto& map : plan.maps) {
    if (!map) continue;
    for (std::size_t k = 0; k < map->energies.size(); ++k) {
      const std::int32_t f = map->island.faces[k];
      const double above = std::clamp(map->energies[k] - 4.0, 0.0, tuning::kMostExcess);
      for (const std::int32_t v : mesh.triangles[f]) excess[v] += problem.areas[f] / 3.0 * above;
    }
  }
  return excess;
}

/// Spreads amounts at vertices over about a radius, as heat spreads. The total stays.
std::vector<double> spread(const PlanMesh& mesh, std::vector<double> amounts, double radius) {
  const double median = median_length(mesh);
  if (!(median > 0.0)) return amounts;
  const auto rounds = static_cast<int>(std::clamp(radius * radius / (median * median), 1.0, 200.0));
  std::vector<double> next(amounts.size());
  for (int round = 0; round < rounds; ++round) {
    std::ranges::fill(next, 0.0);
    for (std::int32_t v = 0; index(v) < amounts.size(); ++v) {
      const auto around = mesh.all_neighbors[v];
      if (around.empty()) continue;
      next[v] += 0.5 * amounts[v];
      const double share = 0.5 * amounts[v] / static_cast<double>(around.size());
      for (const PlanNeighbor& neighbor : around) next[neighbor.vertex] += share;
    }
    amounts.swap(next);
  }
  return amounts;
}

/// Adds the vertices with the largest values that are local maxima and apart from those chosen before.
void add_peaks(const PlanMesh& mesh, std::span<const double> values, std::span<const double> from_cut,
               std::size_t count, std::vector<std::int32_t>& chosen) {
  std::vector<std::int32_t> maxima;
  for (std::int32_t v = 0; index(v) < values.size(); ++v) {
    if (!(values[v] > 0.0) || !(from_cut[v] > tuning::kNearCut) || !std::isfinite(from_cut[v])) continue;
    const bool is_highest = std::ranges::all_of(
        mesh.all_neighbors[v], [&](const PlanNeighbor& next) { return values[next.vertex] <= values[v]; });
    if (is_highest) maxima.push_back(v);
  }
  std::ranges::stable_sort(maxima, std::ranges::greater(), [&](std::int32_t v) { return values[v]; });
  for (const std::int32_t v : maxima) {
    if (count == 0) return;
    const bool is_apart = std::ranges::all_of(
        chosen, [&](std::int32_t other) { return (mesh.points[v] - mesh.points[other]).norm() > tuning::kPeaksApart; });
    if (!is_apart) continue;
    chosen.push_back(v);
    --count;
  }
}

/// Distances along edges from the cut; infinite if unreachable.
std::vector<double> distances_from_cut(const PlanMesh& mesh, std::span<const std::uint8_t> is_on_cut) {
  std::vector<std::int32_t> cut;
  for (std::int32_t v = 0; index(v) < is_on_cut.size(); ++v) {
    if (is_on_cut[v] != 0) cut.push_back(v);
  }
  return edge_distances(mesh, cut);
}

/// Adds the most distorted vertex around the end of each slit.
void add_ahead(const PlanMesh& mesh, const SlitPlan& plan, std::span<const double> values,
               std::span<const double> from_cut, std::vector<std::int32_t>& chosen) {
  for (const Slit& slit : plan.slits) {
    if (slit.is_needed) continue;
    const Vector& end = mesh.points[slit.path.back()];
    std::int32_t best = -1;
    for (std::int32_t v = 0; index(v) < values.size(); ++v) {
      const bool is_ahead = from_cut[v] > tuning::kAheadOfCut && std::isfinite(from_cut[v]) &&
                            (mesh.points[v] - end).norm() < tuning::kAheadOfEnd;
      if (is_ahead && (best < 0 || values[v] > values[best])) best = v;
    }
    if (best >= 0) chosen.push_back(best);
  }
}

}  // namespace

std::vector<std::int32_t> distortion_peaks(const SlitProblem& problem, const SlitPlan& plan,
                                           std::span<const std::uint8_t> is_on_cut) {
  const PlanMesh& mesh = problem.mesh;
  const std::vector<double> from_cut = distances_from_cut(mesh, is_on_cut);
  const std::vector<double> excess = excess_at_vertices(problem, plan);
  const std::vector<double> areas = vertex_areas(mesh, face_frames(mesh));
  const auto density = [&](double radius) {
    std::vector<double> amounts = spread(mesh, excess, radius);
    const std::vector<double> around = spread(mesh, areas, radius);
    for (std::size_t v = 0; v < amounts.size(); ++v) amounts[v] = around[v] > 0.0 ? amounts[v] / around[v] : 0.0;
    return amounts;
  };
  const std::vector<double> close = density(tuning::kClosePeak), wide = density(tuning::kWidePeak);
  std::vector<double> finite(from_cut), weighted(from_cut.size());
  for (std::size_t v = 0; v < finite.size(); ++v) {
    if (!std::isfinite(finite[v])) finite[v] = 0.0;
    weighted[v] = finite[v] * wide[v];
  }
  std::vector<std::int32_t> chosen;
  add_peaks(mesh, close, from_cut, tuning::kClosePeaks, chosen);
  add_peaks(mesh, wide, from_cut, tuning::kWidePeaks, chosen);
  add_peaks(mesh, weighted, from_cut, tuning::kFarPeaks, chosen);
  add_peaks(mesh, finite, from_cut, tuning::kFarthest, chosen);
  add_ahead(mesh, plan, close, from_cut, chosen);
  return chosen;
}

std::vector<std::int32_t> spread_vertices(const SlitProblem& problem, std::span<const std::uint8_t> is_on_cut,
                                          std::size_t count) {
  std::vector<double> away = distances_from_cut(problem.mesh, is_on_cut);
  for (double& distance : away) distance = std::isfinite(distance) ? distance : 0.0;
  std::vector<std::int32_t> chosen;
  while (chosen.size() < count) {
    const auto farthest = std::ranges::max_element(away);
    if (farthest == away.end() || *farthest <= 0.0) break;
    chosen.push_back(static_cast<std::int32_t>(farthest - away.begin()));
    const std::vector<double> from_it = edge_distances(problem.mesh, {&chosen.back(), 1});
    for (std::size_t v = 0; v < away.size(); ++v) away[v] = std::min(away[v], from_it[v]);
  }
  return chosen;
}

}  // namespace seamwire::detail
