// SPDX-License-Identifier: GPL-3.0-or-later
#include "parts/neck_rings.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <map>
#include <numbers>
#include <optional>
#include <utility>

#include "detail/index.hpp"
#include "parts/minimum_cut.hpp"
#include "slits/slit_tree.hpp"
#include "tuning/constants.hpp"

namespace seamwire::detail {
namespace {

constexpr std::size_t kLevels = 96;

/// Rings at equal distances from the tip of a limb.
struct Rings {
  double step = 0.0;            ///< between two levels
  std::vector<double> lengths;  ///< of the ring at each level
  std::vector<double> areas;    ///< within each level
};

Rings measure_rings(const SlitProblem& problem, const PieceBody& body, std::span<const double> distances) {
  Rings rings{.step = tuning::kLimbReach * *std::ranges::max_element(distances) / kLevels,
              .lengths = std::vector<double>(kLevels, 0.0),
              .areas = std::vector<double>(kLevels, 0.0)};
  for (std::size_t k = 0; k < body.island.triangles.size(); ++k) {
    std::array<std::pair<double, Vector>, 3> corners;
    for (std::size_t i = 0; i < 3; ++i) {
      const std::int32_t own = body.island.triangles[k][i];
      corners[i] = {distances[own], problem.mesh->points[body.island.vertices[own]]};
    }
    std::ranges::sort(corners, {}, &std::pair<double, Vector>::first);
    const auto& [low, middle, high] = corners;
    const auto at = [](const auto& a, const auto& b, double level) {
      return Vector(a.second + (level - a.first) / (b.first - a.first) * (b.second - a.second));
    };
    const double mean = (low.first + middle.first + high.first) / 3.0;
    for (auto level = static_cast<std::size_t>(std::max(mean / rings.step, 0.0)); level < kLevels; ++level) {
      rings.areas[level] += problem.areas[body.island.faces[k]];
    }
    for (auto i = static_cast<std::size_t>(std::ceil(low.first / rings.step)); i < kLevels; ++i) {
      const double level = static_cast<double>(i) * rings.step;
      if (level >= high.first) break;
      const Vector other = level < middle.first ? at(low, middle, level) : at(middle, high, level);
      rings.lengths[i] += (at(low, high, level) - other).norm();
    }
  }
  return rings;
}

/// The level of the narrowest neck, and how narrow it is.
std::optional<std::pair<std::size_t, double>> narrowest(const Rings& rings) {
  std::vector<double> before(kLevels), after(kLevels);
  double most = 0.0;
  for (std::size_t i = 0; i < kLevels; ++i) before[i] = most = std::max(most, rings.lengths[i]);
  most = 0.0;
  for (std::size_t i = kLevels; i-- > 0;) after[i] = most = std::max(most, rings.lengths[i]);
  std::optional<std::pair<std::size_t, double>> best;
  for (std::size_t i = 1; i + 1 < kLevels; ++i) {
    const double length = rings.lengths[i];
    if (!(length > 0.0) || rings.areas[i] < tuning::kLeastPart || rings.areas[i] > tuning::kMostLimb) continue;
    const double narrow = std::min(before[i], after[i]) / length;
    if (narrow >= tuning::kNeckNarrow && (!best || narrow > best->second)) best = {i, narrow};
  }
  return best;
}

/// Whether a seam may run along a closed chain of vertices.
bool is_possible(const SlitProblem& problem, std::span<const std::int32_t> loop) {
  for (std::size_t i = 0; i < loop.size(); ++i) {
    const std::int32_t edge = problem.mesh->edge_between(loop[i], loop[(i + 1) % loop.size()]);
    if (edge < 0 || problem.prices.of_edge[edge] == kInfinity) return false;
  }
  return true;
}

/// The cheapest closed chain of edges around a neck, as vertices; empty if it is not one loop.
std::vector<std::int32_t> cheapest_ring(const SlitProblem& problem, const PieceBody& body,
                                        std::span<const double> distances, double level, double width,
                                        const Task& task) {
  constexpr double kClosed = 1e6;  // the price of edges that cannot be cut
  const Island& island = body.island;
  const auto count = static_cast<std::int32_t>(island.triangles.size());
  const std::int32_t source = count, sink = count + 1;
  MinimumCut network(island.triangles.size() + 2);
  for (std::int32_t k = 0; k < count; ++k) {
    const Triangle& t = island.triangles[k];
    const auto [least, most] = std::minmax({distances[t[0]], distances[t[1]], distances[t[2]]});
    if (most < level - width) network.add(source, k, kClosed);
    if (least > level + width) network.add(k, sink, kClosed);
    for (std::int32_t i = 0; i < 3; ++i) {
      const std::int32_t twin = island.twins[3 * k + i];
      if (twin < 3 * k + i) continue;
      const double price = problem.prices.of_edge[problem.mesh->edge_of[3 * island.faces[k] + i]];
      network.add(k, twin / 3, std::min(price, kClosed));
    }
  }
  const std::vector<std::uint8_t> side = network.source_side(source, sink, task);
  std::map<std::int32_t, std::int32_t> next;  // vertices of the mesh, along the source's side
  for (std::int32_t h = 0; index(h) < island.twins.size(); ++h) {
    const std::int32_t twin = island.twins[h];
    if (twin < 0 || side[h / 3] == 0 || side[twin / 3] != 0) continue;
    if (!next.emplace(island.vertices[island.tail(h)], island.vertices[island.tip(h)]).second) return {};
  }
  std::vector<std::int32_t> loop;
  if (next.empty()) return loop;
  std::int32_t v = next.begin()->first;
  do {
    loop.push_back(v);
    const auto following = next.find(v);
    if (following == next.end()) return {};
    v = following->second;
  } while (v != loop.front() && loop.size() <= next.size());
  if (loop.size() != next.size() || loop.size() < 3 || !is_possible(problem, loop)) loop.clear();
  return loop;
}

std::vector<std::int32_t> mirrored_loop(const SlitProblem& problem, const std::vector<std::int32_t>& loop) {
  std::vector<std::int32_t> image;
  if (!problem.reflection || !problem.reflection->is_exact) return image;
  for (std::size_t i = 0; i < loop.size(); ++i) {
    const std::int32_t a = problem.reflection->images[loop[i]];
    const std::int32_t b = problem.reflection->images[loop[(i + 1) % loop.size()]];
    if (a < 0 || b < 0 || problem.mesh->edge_between(a, b) < 0) return {};
    image.push_back(a);
  }
  return image;
}

bool have_common_vertices(std::vector<std::int32_t> one, std::vector<std::int32_t> other) {
  std::ranges::sort(one);
  std::ranges::sort(other);
  std::vector<std::int32_t> common;
  std::ranges::set_intersection(one, other, std::back_inserter(common));
  return !common.empty();
}

}  // namespace

std::vector<NeckRing> find_necks(const SlitProblem& problem, const Task& task) {
  std::vector<NeckRing> found;
  for (std::int32_t p = 0; index(p) < problem.by_piece.size(); ++p) {
    task.check(0.0);
    if (problem.by_piece[p].area < tuning::kLeastPart) continue;
    const PieceBody body(problem, p, task);
    std::vector<std::int32_t> tips = find_tips(problem, body, body.graph.mean_distances(task));
    if (problem.reflection && !problem.reflection->is_exact) {
      for (const std::int32_t tip : std::vector<std::int32_t>(tips)) {
        const std::int32_t image = problem.reflection->images[tip];
        if (image >= 0 && image != tip) tips.push_back(image);
      }
    }
    for (const std::int32_t tip : tips) {
      const auto own = std::ranges::find(body.island.vertices, tip);
      if (own == body.island.vertices.end()) continue;
      const std::vector<double> distances =
          body.graph.distances_from(static_cast<std::int32_t>(own - body.island.vertices.begin()), task);
      const Rings rings = measure_rings(problem, body, distances);
      const auto neck = narrowest(rings);
      if (!neck) continue;
      const double width = 0.7 * rings.lengths[neck->first] / (2.0 * std::numbers::pi);
      NeckRing ring{
          .loop = cheapest_ring(problem, body, distances, static_cast<double>(neck->first) * rings.step, width, task),
          .image = {},
          .narrowness = neck->second,
          .area = rings.areas[neck->first]};
      if (ring.loop.empty()) continue;
      // A ring around a limb on the mirror plane is about its own image.
      if (problem.reflection && problem.reflection->sides[tip] != 0) ring.image = mirrored_loop(problem, ring.loop);
      if (have_common_vertices(ring.loop, ring.image)) continue;
      found.push_back(std::move(ring));
    }
  }
  std::ranges::stable_sort(found, std::ranges::greater(), &NeckRing::narrowness);
  return found;
}

std::vector<Slit> slits_of(const NeckRing& ring) {
  std::vector<Slit> slits;
  for (std::vector<std::int32_t> chain : {ring.loop, ring.image}) {
    if (chain.empty()) continue;
    chain.push_back(chain.front());
    std::ranges::move(needed_slits(chain), std::back_inserter(slits));
  }
  return slits;
}

}  // namespace seamwire::detail
