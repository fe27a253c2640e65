// SPDX-License-Identifier: GPL-3.0-or-later
//
// Valid lengths for what bisection leaves: docs/method.md, Section 4, "Why it ends".
#include <algorithm>
#include <array>
#include <utility>

#include "detail/index.hpp"
#include "embedding/bisection.hpp"

namespace seamwire {
namespace {

// Of the room that the triangle inequality leaves for the length of a fitted edge, the part kept free on either side.
constexpr double kRoom = 1.0 / 16;
// A triangle whose shortest edge is shorter than this fraction of its longest one leaves no room in double precision.
constexpr double kNeedle = 1e-8;

}  // namespace

// Edges are in one strict order, that of their lengths and then of their numbers.
std::int32_t Refinement::fitting_edge(std::int32_t f) const {
  const auto key = [&](std::int32_t h) {
    const std::int32_t twin = mesh_.twins[h];
    return std::pair(lengths_[h], twin < 0 ? h : std::min(h, twin));
  };
  return std::ranges::max(std::array{3 * f, 3 * f + 1, 3 * f + 2}, {}, key);
}

// Invalid, and neither left out for sigma nor a part of a face without an area.
bool Refinement::is_unfit(std::int32_t f) const {
  if (is_valid(f) || perimeter(f) < options_.sigma) return false;
  return is_flat_origin_.empty() || !is_flat_origin_[origins_[f]];
}

bool Refinement::can_be_fitted(std::int32_t f) const {
  const double *l = &lengths_[3 * index(f)], least = std::min({l[0], l[1], l[2]});
  return is_unfit(f) && least > kNeedle * std::max({l[0], l[1], l[2]});
}

// The length of the edge h from the middle of an edge to the apex: as measured, but within what the triangle inequality
// leaves between the edge's halves and the other two sides.
double Refinement::fitted(std::int32_t h, double half, double next_side, double last_side) const {
  const double low = std::max(std::abs(half - next_side), std::abs(half - last_side));
  const double high = half + std::min(next_side, last_side), room = kRoom * (high - low), length = measure(h);
  return room > 0 ? std::clamp(length, low + room, high - room) : length;
}

bool Refinement::fit(const Task& task, double progress) {
  std::vector<std::int32_t> todo;
  for (std::int32_t f = 0; index(f) < mesh_.corners.size(); ++f) {
    if (can_be_fitted(f)) todo.push_back(f);
  }
  for (std::size_t i = 0; i < todo.size(); ++i) {
    if ((i + 1) % kReportEvery == 0) task.check(progress);
    if (!can_be_fitted(todo[i])) continue;
    chain_.assign(1, todo[i]);
    while (!chain_.empty()) {
      const std::int32_t h = fitting_edge(chain_.back()), o = mesh_.twins[h];
      // An invalid neighbour can be fitted at its longest edge only, which is longer than this one.
      if (o >= 0 && can_be_fitted(o / 3) && fitting_edge(o / 3) != o) {
        chain_.push_back(o / 3);
        continue;
      }
      if (faces_added_ + 2 > options_.max_faces_added) {
        hit_cap_ = true;
        return false;
      }
      const auto side = [&](std::int32_t from, int steps) {
        for (; steps > 0; --steps) from = next(from);
        return lengths_[from];
      };
      const double half = lengths_[h] / 2, b = side(h, 1), c = side(h, 2);
      const double d = o < 0 ? 0.0 : side(o, 1), e = o < 0 ? 0.0 : side(o, 2);
      const auto count = static_cast<std::int32_t>(mesh_.corners.size());
      bisect(h);
      set_length(h, half);
      set_length(3 * count, half);
      const auto set_fitted = [&](std::int32_t edge, double one, double other) {
        const double length = fitted(edge, half, one, other), measured = measure(edge);
        set_length(edge, length);
        if (length == measured) return;
        ++clamped_edges_;
        worst_clamp_ = std::max({worst_clamp_, length / measured, measured / length});
      };
      set_fitted(3 * count + 2, b, c);
      if (o >= 0) set_fitted(3 * count + 5, d, e);
      // Rounding may leave one of them invalid.
      for (const std::int32_t part : {h / 3, count, o < 0 ? count : o / 3, o < 0 ? count : count + 1}) {
        if (can_be_fitted(part)) todo.push_back(part);
      }
      chain_.pop_back();
    }
  }
  std::int32_t f = 0;
  while (index(f) < mesh_.corners.size() && !is_unfit(f)) ++f;
  return index(f) == mesh_.corners.size();
}

}  // namespace seamwire
