// SPDX-License-Identifier: GPL-3.0-or-later
#include "slits/piece_body.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <utility>

#include "detail/disjoint_sets.hpp"
#include "detail/index.hpp"
#include "detail/infinity.hpp"
#include "detail/run_on_threads.hpp"
#include "detail/shortest_paths.hpp"
#include "tuning/constants.hpp"

namespace seamwire::detail {
IslandGraph::IslandGraph(const Island& island, std::span<const Vector> points) : areas(island.vertices.size(), 0.0) {
  std::vector<std::pair<std::int32_t, Neighbor>> pairs;
  for (std::size_t k = 0; k < island.triangles.size(); ++k) {
    const Triangle& t = island.triangles[k];
    const auto point = [&](std::size_t i) { return points[island.vertices[t[i % 3]]]; };
    const double area = 0.5 * (point(1) - point(0)).cross(point(2) - point(0)).norm();
    for (std::size_t i = 0; i < 3; ++i) {
      areas[t[i]] += area / 3.0;
      const std::int32_t twin = island.twins[3 * k + i];
      if (twin >= 0 && index(twin) < 3 * k + i) continue;
      const double length = (point(i + 1) - point(i)).norm();
      pairs.push_back({t[i], {t[(i + 1) % 3], length}});
      pairs.push_back({t[(i + 1) % 3], {t[i], length}});
    }
  }
  neighbors = Csr<Neighbor>(island.vertices.size(), pairs);
}

std::vector<double> IslandGraph::distances_from(std::int32_t vertex) const {
  std::vector<double> least(areas.size(), kInfinity);
  find_shortest_paths(std::array{vertex}, least, [&](std::int32_t v, const auto& step) {
    for (const auto& [next, length] : neighbors[v]) step(next, length);
  });
  return least;
}

std::vector<double> IslandGraph::mean_distances(const Task& task) const {
  constexpr std::size_t kSamples = 48;
  constexpr std::size_t kSmall = 1000;  // fewer vertices are measured sooner than threads are started
  constexpr double kGolden = 0.6180339887498949;
  std::vector<double> until(areas.size());
  std::partial_sum(areas.begin(), areas.end(), until.begin());
  std::vector<std::vector<double>> distances(kSamples);
  const auto measure = [&](std::size_t i, const Task& own) {
    own.check(0.0);
    const double place = std::fmod((static_cast<double>(i) + 0.5) * kGolden, 1.0) * until.back();
    const auto at = std::min(until.end() - 1, std::lower_bound(until.begin(), until.end(), place));
    distances[i] = distances_from(static_cast<std::int32_t>(at - until.begin()));
  };
  if (areas.size() < kSmall) {
    for (std::size_t i = 0; i < kSamples; ++i) measure(i, task);
  } else {
    run_on_threads(
        kSamples, task, [](std::size_t done) { return static_cast<double>(done) / kSamples; }, measure);
  }
  std::vector<double> mean(areas.size(), 0.0);
  for (const std::vector<double>& one : distances) {
    for (std::size_t v = 0; v < mean.size(); ++v) mean[v] += one[v] / kSamples;
  }
  return mean;
}

std::vector<std::int32_t> IslandGraph::peaks(std::span<const double> heights, double prominence) const {
  std::vector<std::int32_t> order(heights.size());
  std::iota(order.begin(), order.end(), 0);
  std::ranges::stable_sort(order, std::ranges::greater(), [&](std::int32_t v) { return heights[v]; });
  // Flood from above: where two hills meet, the lower one's prominence is known.
  DisjointSets sets(heights.size());
  std::vector<std::int32_t> summit(heights.size(), -1);
  std::vector<std::pair<double, std::int32_t>> found;
  for (const std::int32_t v : order) {
    std::int32_t highest = v;
    for (const Neighbor& next : neighbors[v]) {
      const std::int32_t other = summit[sets.find(next.vertex)];
      if (other < 0 || sets.find(next.vertex) == sets.find(v)) continue;
      const std::int32_t lower = heights[other] > heights[highest] ? highest : other;
      if (lower != v && heights[lower] - heights[v] >= prominence) found.push_back({heights[lower], lower});
      highest = lower == highest ? other : highest;
      sets.join(v, next.vertex);
    }
    summit[sets.find(v)] = highest;
  }
  if (!order.empty() && heights[order.front()] - heights[order.back()] >= prominence) {
    found.push_back({heights[order.front()], order.front()});
  }
  std::ranges::sort(
      found, [](const auto& a, const auto& b) { return a.first != b.first ? a.first > b.first : a.second < b.second; });
  std::vector<std::int32_t> peaks;
  peaks.reserve(found.size());
  for (const auto& [height, v] : found) peaks.push_back(v);
  return peaks;
}

PieceBody::PieceBody(const SlitProblem& problem, std::int32_t piece)
    : size(std::sqrt(problem.by_piece[piece].area)),
      island(std::move(islands_of(problem, problem.is_seam, piece).front())),
      graph(island, problem.mesh.points) {
  for (const std::vector<std::int32_t>& loop : island.boundaries()) {
    std::vector<std::int32_t> vertices;
    for (const std::int32_t own : loop) vertices.push_back(island.vertices[own]);
    loops.push_back(std::move(vertices));
  }
}

std::int64_t PieceBody::genus() const { return (2 - island.euler_characteristic() - std::ssize(loops)) / 2; }

std::int32_t onto_plane(const SlitProblem& problem, const PieceBody& body, std::int32_t tip) {
  const Reflection& reflection = *problem.reflection;
  if (reflection.sides[tip] == 0) return tip;
  std::int32_t nearest = tip;
  double least = tuning::kTipToPlane * body.size;
  for (const std::int32_t v : body.island.vertices) {
    if (reflection.sides[v] != 0) continue;
    const double distance = (problem.mesh.points[v] - problem.mesh.points[tip]).norm();
    if (distance < least) {
      least = distance;
      nearest = v;
    }
  }
  return nearest;
}

std::vector<std::int32_t> find_tips(const SlitProblem& problem, const PieceBody& body,
                                    std::span<const double> distances) {
  std::vector<std::int32_t> vertices = body.island.vertices;
  std::ranges::sort(vertices);
  std::vector<std::int32_t> tips;
  for (const std::int32_t own : body.graph.peaks(distances, tuning::kTipProminence * body.size)) {
    std::int32_t tip = body.island.vertices[own];
    if (problem.reflection) {
      tip = onto_plane(problem, body, tip);
      const std::int32_t image = problem.reflection->images[tip];
      if (problem.reflection->sides[tip] < 0 && std::ranges::binary_search(vertices, image)) tip = image;
    }
    if (std::ranges::find(tips, tip) == tips.end()) tips.push_back(tip);
  }
  return tips;
}

}  // namespace seamwire::detail
