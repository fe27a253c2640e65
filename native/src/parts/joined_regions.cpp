// SPDX-License-Identifier: GPL-3.0-or-later
#include "parts/joined_regions.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <numeric>
#include <queue>
#include <tuple>
#include <utility>

#include "detail/index.hpp"
#include "detail/poll.hpp"

namespace seamwire::detail {
namespace {

/// What lies between two regions.
struct Link {
  double gain = 0.0, length = 0.0, bend = 0.0;
  bool is_kept = false;

  void add(const Link& other) {
    gain += other.gain;
    length += other.length;
    bend += other.bend;
    is_kept = is_kept || other.is_kept;
  }
};

class Joining {
 public:
  Joining(std::span<const Region> regions, std::span<const RegionBorder> borders, const RegionRules& rules,
          const Task& task)
      : regions_(regions.begin(), regions.end()),
        parents_(regions.size()),
        links_(regions.size()),
        rules_(rules),
        poll_(task, 0.0, 1.0, borders.size() + 2 * regions.size(), Poll::kFewSteps) {
    std::iota(parents_.begin(), parents_.end(), 0);
    for (const RegionBorder& border : borders) {
      poll_.next();
      for (const auto& [a, b] : {std::pair(border.one, border.other), std::pair(border.other, border.one)}) {
        links_[a][b].add({border.gain, border.length, border.bend, border.is_kept});
      }
    }
  }

  std::vector<std::int32_t> run() {
    join_gainful();
    join_small();
    std::vector<std::int32_t> found;
    for (std::size_t r = 0; r < parents_.size(); ++r) found.push_back(root(static_cast<std::int32_t>(r)));
    return found;
  }

 private:
  std::int32_t root(std::int32_t r) {
    while (parents_[r] != r) r = parents_[r] = parents_[parents_[r]];
    return r;
  }

  void offer(std::int32_t a, std::int32_t b, const Link& link) {
    const double lost = link.gain - rules_.region_price;
    if (lost < 0.0) open_.emplace(lost, std::min(a, b), std::max(a, b));
  }

  void join_gainful() {
    for (std::int32_t a = 0; index(a) < links_.size(); ++a) {
      for (const auto& [b, link] : links_[a]) {
        if (a < b) offer(a, b, link);
      }
    }
    while (!open_.empty()) {
      poll_.next();
      const auto [lost, a, b] = open_.top();
      open_.pop();
      if (parents_[a] != a || parents_[b] != b) continue;
      const auto found = links_[a].find(b);
      if (found == links_[a].end() || found->second.gain - rules_.region_price != lost) continue;
      join_both(a, b);
    }
  }

  /// Whether two regions are of one size, as mirror images are.
  bool are_alike(std::int32_t one, std::int32_t other) const {
    constexpr double kSame = 0.01;
    return std::abs(regions_[one].area - regions_[other].area) <= kSame * regions_[one].area;
  }

  /// Joins two regions, and their mirror images.
  void join_both(std::int32_t a, std::int32_t b) {
    const std::int32_t a_image = image(a), b_image = image(b);
    const bool are_mirrored = a_image >= 0 && b_image >= 0 && are_alike(a, a_image) && are_alike(b, b_image);
    std::int32_t joined = join(a, b);
    if (!are_mirrored) return;
    const std::int32_t one = root(a_image), other = root(b_image);
    if (one != other && links_[one].contains(other)) {
      const std::int32_t mirrored = join(one, other);
      joined = root(joined);
      regions_[joined].image = mirrored;
      regions_[mirrored].image = joined;
    } else if (one == other) {
      regions_[joined].image = one;
      regions_[one].image = joined;
    }
  }
  std::int32_t image(std::int32_t r) { return regions_[r].image < 0 ? -1 : root(regions_[r].image); }

  std::int32_t join(std::int32_t a, std::int32_t b) {
    if (links_[a].size() < links_[b].size()) std::swap(a, b);
    parents_[b] = a;
    regions_[a].area += regions_[b].area;
    for (const auto& [c, link] : links_[b]) {
      if (c == a) continue;
      links_[c].erase(b);
      Link& sum = links_[a][c];
      sum.add(link);
      links_[c][a] = sum;
      offer(a, c, sum);
    }
    links_[a].erase(b);
    links_[b] = {};
    return a;
  }

  /// Whether a region is too small to stay, or a step of a chamfer.
  bool is_small(std::int32_t r) const {
    Link rim;
    for (const auto& [c, link] : links_[r]) rim.add(link);
    if (!(rim.length > 0.0)) return false;
    if (regions_[r].area < regions_[r].least_area && rim.gain < rules_.sharp_rim * rim.length) return true;
    const bool is_step = rim.bend > rules_.least_step * rim.length && rim.bend < rules_.most_step * rim.length;
    return is_step && 2.0 * regions_[r].area < rules_.least_width * rim.length;
  }

  /// The neighbor that a small region joins: the one with the least likely border.
  std::int32_t neighbor_of_small(std::int32_t r) const {
    if (!is_small(r)) return -1;
    std::int32_t best = -1;
    std::tuple<double, double> least;
    for (const auto& [c, link] : links_[r]) {
      if (link.is_kept || !(link.length > 0.0)) continue;
      const std::tuple own(link.gain / link.length, -regions_[c].area);
      if (best < 0 || own < least || (own == least && c < best)) {
        best = c;
        least = own;
      }
    }
    return best;
  }

  void join_small() {
    using Small = std::pair<double, std::int32_t>;
    std::priority_queue<Small, std::vector<Small>, std::greater<>> small;
    const auto add = [&](std::int32_t r) {
      if (neighbor_of_small(r) >= 0) small.emplace(regions_[r].area, r);
    };
    for (std::int32_t r = 0; index(r) < parents_.size(); ++r) {
      if (parents_[r] == r) add(r);
    }
    while (!small.empty()) {
      poll_.next();
      const auto [area, r] = small.top();
      small.pop();
      if (parents_[r] != r || regions_[r].area != area) continue;
      const std::int32_t neighbor = neighbor_of_small(r);
      if (neighbor < 0) continue;
      join_both(r, neighbor);
      const std::int32_t joined = root(r), mirrored = image(joined);
      add(joined);
      if (mirrored >= 0 && mirrored != joined) add(mirrored);
    }
  }

  std::vector<Region> regions_;
  std::vector<std::int32_t> parents_;
  std::vector<std::map<std::int32_t, Link>> links_;
  RegionRules rules_;
  Poll poll_;
  using Offer = std::tuple<double, std::int32_t, std::int32_t>;
  std::priority_queue<Offer, std::vector<Offer>, std::greater<>> open_;
};

}  // namespace

std::vector<std::int32_t> joined_regions(std::span<const Region> regions, std::span<const RegionBorder> borders,
                                         const RegionRules& rules, const Task& task) {
  return Joining(regions, borders, rules, task).run();
}

}  // namespace seamwire::detail
