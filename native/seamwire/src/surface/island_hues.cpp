// SPDX-License-Identifier: GPL-3.0-or-later
#include "seamwire/surface/island_hues.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cstdlib>
#include <functional>
#include <queue>
#include <string>
#include <tuple>
#include <utility>

#include "detail/drop_repeats.hpp"
#include "detail/index.hpp"
#include "seamwire/errors.hpp"

namespace seamwire {

using namespace detail;

namespace {

/// Islands beyond this many are so small that neighbors may share a hue.
constexpr std::size_t kToldApart = 4096;
/// By how many places in the rainbow the hues of neighbors differ wherever that can be: 60 degrees of the circle of
/// hues, where 12 hues share two thirds of it.
constexpr std::int32_t kClear = 3;
constexpr std::uint32_t kAllHues = (1U << kHues) - 1;

constexpr std::int32_t place_of(std::int32_t hue) { return (4 + 5 * hue) % kHues; }

/// The hues that are too near to one, as bits.
std::uint32_t near_hues(std::int32_t hue) {
  std::uint32_t found = 0;
  for (std::int32_t other = 0; other < kHues; ++other) {
    if (std::abs(place_of(hue) - place_of(other)) < kClear) found |= 1U << other;
  }
  return found;
}

/// The islands that each island meets at cut edges.
std::vector<std::vector<std::int32_t>> neighbors_of(std::span<const Triangle> triangles,
                                                    std::span<const std::int32_t> islands, std::span<const Edge> cuts,
                                                    std::size_t vertex_count, std::size_t count) {
  std::vector<std::uint8_t> is_on_cut(vertex_count, 0);
  std::vector<Edge> sorted;
  for (const auto& [a, b] : cuts) {
    if (!is_index(a, vertex_count) || !is_index(b, vertex_count)) continue;
    is_on_cut[a] = is_on_cut[b] = 1;
    sorted.push_back({std::min(a, b), std::max(a, b)});
  }
  std::ranges::sort(sorted);
  std::vector<std::pair<Edge, std::int32_t>> sides;
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    for (std::size_t i = 0; i < 3; ++i) {
      const std::int32_t a = triangles[t][i], b = triangles[t][(i + 1) % 3];
      if (is_on_cut[a] == 0 || is_on_cut[b] == 0) continue;
      const Edge edge{std::min(a, b), std::max(a, b)};
      if (std::ranges::binary_search(sorted, edge)) sides.emplace_back(edge, islands[t]);
    }
  }
  std::ranges::stable_sort(sides, {}, &std::pair<Edge, std::int32_t>::first);
  std::vector<std::vector<std::int32_t>> around(count);
  for (std::size_t i = 1; i < sides.size(); ++i) {
    const std::int32_t one = sides[i - 1].second, two = sides[i].second;
    if (sides[i - 1].first != sides[i].first || one == two) continue;
    around[one].push_back(two);
    around[two].push_back(one);
  }
  for (auto& own : around) {
    std::ranges::sort(own);
    drop_repeats(own);
  }
  return around;
}

/// The hue that each island keeps, or -1 for what was cut off or is new.
std::vector<std::int32_t> inherited(std::span<const std::int32_t> islands, std::size_t count,
                                    const FormerIslands& former) {
  std::vector<std::int32_t> hues(count, -1);
  if (former.islands.empty() || std::max(count, former.hues.size()) > kToldApart) return hues;
  std::vector<Edge> shared;
  for (std::size_t t = 0; t < islands.size(); ++t) shared.push_back({islands[t], former.islands[t]});
  std::ranges::sort(shared);
  struct Part {
    std::int32_t island = -1;
    std::size_t size = 0;
  };
  // Of each island the former one that has most of it, and of each former island the largest part.
  std::vector<Part> main(count), heir(former.hues.size());
  for (std::size_t begin = 0, end = 0; begin < shared.size(); begin = end) {
    while (end < shared.size() && shared[end] == shared[begin]) ++end;
    Part& own = main[shared[begin][0]];
    if (end - begin >= own.size) own = {shared[begin][1], end - begin};
  }
  for (std::int32_t i = 0; index(i) < count; ++i) {
    if (main[i].island < 0) continue;
    Part& own = heir[main[i].island];
    if (main[i].size >= own.size) own = {i, main[i].size};
  }
  for (std::size_t i = 0; i < heir.size(); ++i) {
    if (heir[i].island >= 0) hues[heir[i].island] = former.hues[i];
  }
  return hues;
}

/// Chooses the hues of islands one by one.
class Coloring {
 public:
  explicit Coloring(std::vector<std::vector<std::int32_t>> around)
      : around_(std::move(around)), chosen_(around_.size(), -1), free_(around_.size(), kAllHues) {
    for (std::int32_t hue = 0; hue < kHues; ++hue) near_[index(hue)] = near_hues(hue);
  }

  std::vector<std::uint8_t> choose(const std::vector<std::int32_t>& old) {
    // Old hues stay, the largest islands first. The other islands get new hues when all old ones are known.
    for (std::int32_t i = 0; index(i) < old.size(); ++i) {
      if (old[i] >= 0 && (free_[i] >> old[i] & 1) != 0) settle(i, old[i]);
    }
    // The island with the fewest hues left is next.
    using Turn = std::pair<int, std::int32_t>;
    std::priority_queue<Turn, std::vector<Turn>, std::greater<>> waiting;
    for (std::int32_t i = 0; index(i) < old.size(); ++i) {
      if (chosen_[i] < 0) waiting.emplace(std::popcount(free_[i]), i);
    }
    while (!waiting.empty()) {
      const auto [left, island] = waiting.top();
      waiting.pop();
      if (chosen_[island] >= 0 || left != std::popcount(free_[island])) continue;
      settle(island, best_hue(island));
      for (const std::int32_t other : around_[island]) {
        if (chosen_[other] < 0) waiting.emplace(std::popcount(free_[other]), other);
      }
    }
    return {chosen_.begin(), chosen_.end()};
  }

 private:
  void settle(std::int32_t island, std::int32_t hue) {
    chosen_[island] = hue;
    ++used_[index(hue)];
    for (const std::int32_t other : around_[island]) free_[other] &= ~near_[index(hue)];
  }

  std::int32_t best_hue(std::int32_t island) const {
    using Merit = std::tuple<std::int32_t, int, int, std::int32_t>;
    std::int32_t best = 0;
    Merit most{-1, 0, 0, 0};
    for (std::int32_t hue = 0; hue < kHues; ++hue) {
      std::int32_t gap = kHues;
      int taken = 0;
      for (const std::int32_t other : around_[island]) {
        if (chosen_[other] < 0) {
          taken += std::popcount(free_[other] & near_[index(hue)]);
        } else {
          gap = std::min(gap, std::abs(place_of(hue) - place_of(chosen_[other])));
        }
      }
      const Merit merit{std::min(gap, kClear), -taken, -used_[index(hue)], gap};
      if (merit <= most) continue;
      most = merit;
      best = hue;
    }
    return best;
  }

  std::vector<std::vector<std::int32_t>> around_;
  std::vector<std::int32_t> chosen_;
  std::vector<std::uint32_t> free_;  // of each island: the hues that are not too near to a neighbor's, as bits
  std::array<std::uint32_t, kHues> near_{};
  std::array<int, kHues> used_{};
};

}  // namespace

std::vector<std::uint8_t> island_hues(std::span<const Triangle> triangles, std::span<const std::int32_t> islands,
                                      std::span<const Edge> cuts, const FormerIslands& former) {
  const auto check_size = [&](const char* what, std::size_t size) {
    if (size == triangles.size()) return;
    throw InvalidInput(std::string(what) + " has " + std::to_string(size) + " items: there are " +
                       std::to_string(triangles.size()) + " triangles");
  };
  check_size("islands", islands.size());
  if (!former.islands.empty()) check_size("former islands", former.islands.size());
  std::size_t vertex_count = 0, count = 0;
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    check_index(islands[t], triangles.size(), "islands: number", "triangles");
    count = std::max(count, index(islands[t]) + 1);
    if (!former.islands.empty()) check_index(former.islands[t], former.hues.size(), "former islands: number", "hues");
    for (const std::int32_t v : triangles[t]) {
      if (v < 0) throw InvalidInput("triangle " + std::to_string(t) + " has a negative vertex");
      vertex_count = std::max(vertex_count, index(v) + 1);
    }
  }
  if (std::ranges::any_of(former.hues, [](std::uint8_t hue) { return hue >= kHues; })) {
    throw InvalidInput("former hues: a hue is not below " + std::to_string(kHues));
  }
  const std::vector<std::int32_t> old = inherited(islands, count, former);
  if (count <= kToldApart) return Coloring(neighbors_of(triangles, islands, cuts, vertex_count, count)).choose(old);
  std::vector<std::uint8_t> hues;
  for (std::size_t i = 0; i < count; ++i) hues.push_back(static_cast<std::uint8_t>(i % kHues));
  return hues;
}

}  // namespace seamwire
