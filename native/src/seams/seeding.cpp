// SPDX-License-Identifier: GPL-3.0-or-later
#include "seams/seeding.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <map>
#include <numeric>
#include <set>
#include <utility>

#include "detail/csr.hpp"
#include "detail/index.hpp"
#include "detail/indexed_heap.hpp"
#include "seams/cut_pieces.hpp"
#include "seamwire/metric/metric.hpp"

namespace seamwire {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// Seeds lie far from each other in the metric of this anisotropy, whatever the wires' own: where wires are drawn to
/// features strongly, seeds would gather on flat faces.
constexpr double kSeedAnisotropy = 10.0, kSeedClamp = 99.0;
/// A vertex without any feature is as good a seed as one on the strongest that is this much nearer.
constexpr double kPlainSeed = 0.3;
/// A wire counts as this much weaker where it strays through the cells of other seeds, beside wires of theirs.
constexpr double kStray = 5.0;

/// The rank of each value, 0 to 1: not its size, for one sharp corner must not outweigh all soft ridges.
std::vector<double> ranks(const std::vector<double>& values) {
  std::vector<std::int32_t> order(values.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&](auto a, auto b) { return values[a] < values[b]; });
  std::vector<double> out(values.size());
  const auto last = static_cast<double>(std::max<std::size_t>(values.size(), 2) - 1);
  for (std::size_t i = 0; i < order.size(); ++i) out[order[i]] = static_cast<double>(i) / last;
  return out;
}

/// The seeds, and which of them each vertex is nearest to (Dijkstra, a seed at a time, as far as it is nearer than
/// those before). Steps are the sides of triangles, diagonals of polygons among them, and from a triangle's corner to
/// that behind the side opposite to it: near enough to distances to say where seeds go.
class SeedCells {
 public:
  SeedCells(const Surface& surface, const Metric& metric)
      : steps_(surface.vertex_count(),
               [&](const auto& visit) {
                 for_each_step(surface, [&](std::int32_t a, std::int32_t b) {
                   const double length = edge_length(surface, metric, a, b);
                   visit(a, Step{b, length});
                   visit(b, Step{a, length});
                 });
               }),
        distance_(surface.vertex_count(), kInfinity),
        cell_(surface.vertex_count(), -1),
        queue_(surface.vertex_count()) {}

  void add(std::int32_t seed) {
    const auto cell = static_cast<std::int32_t>(seeds_.size());
    seeds_.push_back(seed);
    relax(seed, 0.0, cell);
    while (!queue_.empty()) {
      const std::int32_t v = queue_.pop();
      for (const Step& step : steps_[v]) relax(step.to, distance_[v] + step.length, cell);
    }
  }
  const std::vector<std::int32_t>& seeds() const { return seeds_; }
  bool has(std::int32_t vertex) const { return std::ranges::find(seeds_, vertex) != seeds_.end(); }
  double distance(std::int32_t v) const { return distance_[v]; }
  std::int32_t cell(std::int32_t v) const { return cell_[v]; }

 private:
  struct Step {
    std::int32_t to;
    double length;
  };
  template <class Visit>
  static void for_each_step(const Surface& surface, const Visit& visit) {
    const auto corner = [&](std::int32_t h, std::int32_t i) {
      return surface.vertex_of_fan()[surface.face_fans()[h / 3][(h % 3 + i) % 3]];
    };
    for (std::int32_t h = 0; index(h) < surface.twins().size(); ++h) {
      const std::int32_t twin = surface.twins()[h];
      if (twin > h || twin < 0) visit(corner(h, 0), corner(h, 1));
      if (twin > h) visit(corner(h, 2), corner(twin, 2));
    }
    for (const auto& [a, b] : surface.loose_edges()) visit(a, b);
  }
  void relax(std::int32_t v, double distance, std::int32_t cell) {
    if (!(distance < distance_[v])) return;
    distance_[v] = distance;
    cell_[v] = cell;
    queue_.lower(v, distance);
  }

  Csr<Step> steps_;
  std::vector<double> distance_;
  std::vector<std::int32_t> cell_, seeds_;
  IndexedHeap queue_;
};

/// Places seeds and joins them by wires until these cut the surface into discs.
class Seeding {
 public:
  Seeding(const CandidateWires& wires, const Seclusion& seclusion, const SeamPlannerOptions& options, const Task& task)
      : wires_(wires),
        seclusion_(seclusion),
        options_(options),
        cells_(wires.surface(),
               feature_metric(wires.surface(), wires.curvature(), Follow::kMin,
                              {.max_anisotropy = kSeedAnisotropy, .clamp_percentile = kSeedClamp}, task)),
        feature_(ranks(wires.feature_strength())),
        is_used_(wires.surface().vertex_count(), 0) {
    for (const Triangle& t : wires.surface().face_fans()) {
      for (const std::int32_t fan : t) is_used_[wires.surface().vertex_of_fan()[fan]] = 1;
    }
    may_have_seeds_ = is_used_;
    for (std::size_t v = 0; v < options.density.size(); ++v) {
      if (!(options.density[v] > 0.0)) may_have_seeds_[v] = 0;
    }
  }

  std::vector<Choice> choices(const Task& task) {
    task.check(0.0);
    for (const std::int32_t v : options_.seeds_at) {
      if (is_used_[v] != 0 && !cells_.has(v)) cells_.add(v);
    }
    while (cells_.seeds().size() < options_.seeds && add_seed(is_used_)) task.check(0.0);
    const std::vector<double> no_limits(wires_.surface().face_count(), kInfinity);
    while (true) {
      std::vector<Choice> found = join(task);
      const CutPieces pieces(wires_.surface(), chains_of(found, options_.seams), no_limits);
      const std::vector<std::uint8_t> worst = pieces.vertices_of_worst(wires_.surface(), may_have_seeds_);
      if (worst.empty() || cells_.seeds().size() >= options_.most_seeds || !add_seed(worst)) return found;
    }
  }

 private:
  /// Where the farthest feature is, among some vertices, and at its mirror image; false where none is left.
  bool add_seed(const std::vector<std::uint8_t>& among) {
    double reach = 1.0;
    for (std::int32_t v = 0; index(v) < is_used_.size(); ++v) {
      if (std::isfinite(cells_.distance(v))) reach = std::max(reach, cells_.distance(v));
    }
    std::int32_t best = -1;
    double most = 0.0;
    for (std::int32_t v = 0; index(v) < is_used_.size(); ++v) {
      if (among[v] == 0 || is_used_[v] == 0 || cells_.distance(v) <= 0.0) continue;
      // Components without a seed come first.
      const double score =
          std::min(cells_.distance(v), 2.0 * reach) * (kPlainSeed + feature_[v]) * std::sqrt(density(v));
      if (score > most) {
        most = score;
        best = v;
      }
    }
    if (best < 0 || cells_.has(best)) return false;
    cells_.add(best);
    const std::int32_t image = options_.images.empty() ? -1 : options_.images[best];
    if (image >= 0 && image != best && is_used_[image] != 0 && !cells_.has(image)) cells_.add(image);
    return true;
  }

  /// Wires between seeds whose cells touch; those that are known already are not found again.
  std::vector<Choice> join(const Task& task) {
    std::set<Ends> wanted;
    for (const auto& [a, b] : wires_.surface().edges()) {
      const std::int32_t one = cells_.cell(a), other = cells_.cell(b);
      if (one < 0 || other < 0 || one == other || !has_wires(one) || !has_wires(other)) continue;
      wanted.insert({ends_of(one, other), image(ends_of(one, other))});
    }
    std::map<std::int32_t, CandidateWires::Fan> missing;
    for (const auto& [one, other] : wanted) {
      if (known_.contains({one, other})) continue;
      missing.try_emplace(one, CandidateWires::Fan{cells_.seeds()[one], {}})
          .first->second.to.push_back(cells_.seeds()[other]);
    }
    std::vector<CandidateWires::Fan> fans;
    fans.reserve(missing.size());
    for (const auto& [cell, fan] : missing) fans.push_back(fan);
    std::vector<std::vector<CandidateWire>> found = wires_.find(fans, task);
    std::size_t i = 0;
    for (const auto& [cell, fan] : missing) {
      for (std::size_t k = 0; k < fan.to.size(); ++k) {
        const auto other = std::ranges::find(cells_.seeds(), fan.to[k]) - cells_.seeds().begin();
        known_[{cell, static_cast<std::int32_t>(other)}] =
            make_choice(fan.from, fan.to[k], std::move(found[i][k]), seclusion_);
      }
      ++i;
    }
    for (const Ends& pair : wanted) {
      // Of chains of edges that are as short as each other, both sides shall have the same.
      if (image(pair) <= pair) continue;
      if (auto same = mirrored(known_.at(pair), wires_.surface(), options_)) known_.at(image(pair)) = std::move(*same);
    }
    std::vector<Choice> all;
    for (const Ends& pair : wanted) {
      Choice choice = known_.at(pair);
      if (choice.wire.vertices.size() < 2 || is_barred(choice, options_.density)) continue;
      const auto strays = std::ranges::count_if(choice.wire.vertices, [&](std::int32_t v) {
        return cells_.cell(v) != pair.first && cells_.cell(v) != pair.second;
      });
      choice.strength /= 1.0 + kStray * static_cast<double>(strays) / static_cast<double>(choice.wire.vertices.size());
      all.push_back(std::move(choice));
    }
    return all;
  }

  double density(std::int32_t v) const { return options_.density.empty() ? 1.0 : options_.density[v]; }
  bool has_wires(std::int32_t cell) const { return density(cells_.seeds()[cell]) > 0.0; }

  /// The cells of the images of two seeds; those of the seeds themselves where one has none.
  Ends image(const Ends& pair) const {
    if (options_.images.empty()) return pair;
    const auto cell = [&](std::int32_t of) {
      const auto seed = std::ranges::find(cells_.seeds(), options_.images[cells_.seeds()[of]]);
      return seed == cells_.seeds().end() ? -1 : static_cast<std::int32_t>(seed - cells_.seeds().begin());
    };
    const Ends other = ends_of(cell(pair.first), cell(pair.second));
    return other.first < 0 || other.first == other.second ? pair : other;
  }

  const CandidateWires& wires_;
  const Seclusion& seclusion_;
  const SeamPlannerOptions& options_;
  SeedCells cells_;
  std::vector<double> feature_;
  std::vector<std::uint8_t> is_used_;
  std::vector<std::uint8_t> may_have_seeds_;  // is_used_ where density is not 0
  std::map<Ends, Choice> known_;              // by the numbers of their seeds
};

}  // namespace

std::vector<Choice> wires_between_seeds(const CandidateWires& wires, const Seclusion& seclusion,
                                        const SeamPlannerOptions& options, const Task& task) {
  return Seeding(wires, seclusion, options, task).choices(task);
}

}  // namespace seamwire
