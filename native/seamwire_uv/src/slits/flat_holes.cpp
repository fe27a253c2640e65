// SPDX-License-Identifier: GPL-3.0-or-later
#include "slits/flat_holes.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <map>
#include <numbers>
#include <queue>
#include <unordered_map>
#include <unordered_set>
#include <utility>

#include "detail/csr.hpp"
#include "detail/index.hpp"
#include "detail/poll.hpp"
#include "detail/rounded.hpp"
#include "tuning/constants.hpp"

namespace seamwire::detail {
namespace {

class HoleTest {
 public:
  HoleTest(const Island& island, std::span<const Vector> points,
           const std::vector<std::vector<std::int32_t>>& boundaries, const Task& task)
      : island_(island),
        points_(points),
        poll_(task),
        angles_(island.vertices.size(), 0.0),
        loop_of_(island.vertices.size(), -1),
        neighbors_(island.vertices.size(), [&](const auto& visit) {
          for (std::int32_t h = 0; index(h) < island.twins.size(); ++h) {
            if (island.twins[h] >= 0 && island.twins[h] < h) continue;
            visit(island.tail(h), island.tip(h));
            visit(island.tip(h), island.tail(h));
          }
        }) {
    for (std::size_t loop = 0; loop < boundaries.size(); ++loop) {
      for (const std::int32_t v : boundaries[loop]) loop_of_[v] = static_cast<std::int32_t>(loop);
    }
    for (std::int32_t h = 0; index(h) < island.twins.size(); ++h) {
      poll_.next();
      const Vector to = point(island.tip(h)) - point(island.tail(h)),
                   back = point(island.apex(h)) - point(island.tail(h));
      angles_[island.tail(h)] += std::atan2(to.cross(back).norm(), to.dot(back));
    }
  }

  /// Of a loop.
  double length(const std::vector<std::int32_t>& loop) const {
    double sum = 0.0;
    for (std::size_t i = 0; i < loop.size(); ++i) sum += (point(loop[i]) - point(loop[(i + 1) % loop.size()])).norm();
    return rounded(sum);
  }

  /// Of a loop, without the edges that it passes on both sides. An open seam has no outline.
  double outline(const std::vector<std::int32_t>& loop) const {
    std::map<std::array<std::int32_t, 2>, int> times;
    for (std::size_t i = 0; i < loop.size(); ++i) {
      const std::int32_t a = island_.vertices[loop[i]], b = island_.vertices[loop[(i + 1) % loop.size()]];
      ++times[{std::min(a, b), std::max(a, b)}];
    }
    double sum = 0.0;
    for (const auto& [edge, count] : times) sum += count == 1 ? (points_[edge[0]] - points_[edge[1]]).norm() : 0.0;
    return rounded(sum);
  }

  bool is_flat(const std::vector<std::int32_t>& loop) {
    const double most = rounded_share(tuning::kLeastTubeTurn);
    double turn = 0.0;
    for (const std::int32_t v : loop) turn += std::numbers::pi - angles_[v];
    if (rounded_share(turn) > most) return false;  // it turns like an outline, as at the flaring end of a neck
    const double around = curvature_around(loop, tuning::kCollar * outline(loop));
    return rounded_share(std::abs(2.0 * std::numbers::pi + turn + around)) < most;
  }

 private:
  const Vector& point(std::int32_t v) const { return points_[island_.vertices[v]]; }

  /// The curvature of the inner vertices that are nearer to a loop than `reach`, and nearer than any other loop is.
  double curvature_around(const std::vector<std::int32_t>& loop, double reach) {
    using Entry = std::pair<double, std::int32_t>;
    std::priority_queue<Entry, std::vector<Entry>, std::greater<>> open;
    std::unordered_map<std::int32_t, double> least;  // only of vertices where the search comes
    std::unordered_set<std::int32_t> is_done;
    for (const std::int32_t v : loop) {
      if (least.emplace(v, 0.0).second) open.emplace(0.0, v);
    }
    double sum = 0.0;
    while (!open.empty() && rounded(open.top().first) < rounded(reach)) {
      poll_.next();
      const auto [away, v] = open.top();
      open.pop();
      if (!is_done.insert(v).second) continue;
      if (loop_of_[v] < 0) sum += 2.0 * std::numbers::pi - angles_[v];
      if (loop_of_[v] >= 0 && away > 0.0) reach = std::min(reach, away);
      for (const std::int32_t next : neighbors_[v]) {
        const double further = away + (point(next) - point(v)).norm();
        const auto [known, is_new] = least.emplace(next, further);
        if (!is_new && !(further < known->second)) continue;
        known->second = further;
        open.emplace(further, next);
      }
    }
    return sum;
  }

  const Island& island_;
  std::span<const Vector> points_;
  Poll poll_;
  std::vector<double> angles_;         // the sum of the corners around each own vertex
  std::vector<std::int32_t> loop_of_;  // of each own vertex, -1 inside
  Csr<std::int32_t> neighbors_;
};

}  // namespace

std::vector<std::uint8_t> flat_holes(const Island& island, std::span<const Vector> points,
                                     const std::vector<std::vector<std::int32_t>>& boundaries, const Task& task) {
  std::vector<std::uint8_t> flags(boundaries.size(), 0);
  if (boundaries.size() < 2) return flags;
  HoleTest test(island, points, boundaries, task);
  std::size_t longest = 0;
  for (std::size_t loop = 1; loop < boundaries.size(); ++loop) {
    if (test.length(boundaries[loop]) > test.length(boundaries[longest])) longest = loop;
  }
  // Two loops with a common mesh vertex are the sides of a seam around a tube or a handle.
  std::unordered_map<std::int32_t, std::size_t> loop_at;  // by mesh vertex
  std::vector<std::uint8_t> is_side(boundaries.size(), 0);
  for (std::size_t loop = 0; loop < boundaries.size(); ++loop) {
    for (const std::int32_t v : boundaries[loop]) {
      const std::size_t other = loop_at.emplace(island.vertices[v], loop).first->second;
      if (other != loop) is_side[loop] = is_side[other] = 1;
    }
  }
  for (std::size_t loop = 0; loop < boundaries.size(); ++loop) {
    if (loop != longest && is_side[loop] == 0 && test.is_flat(boundaries[loop])) flags[loop] = 1;
  }
  return flags;
}

}  // namespace seamwire::detail
