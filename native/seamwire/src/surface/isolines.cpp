// SPDX-License-Identifier: GPL-3.0-or-later
#include "seamwire/surface/isolines.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "detail/text.hpp"

namespace seamwire {

using namespace detail;

namespace {

void check(const Surface& surface, std::span<const double> values, std::span<const double> levels) {
  if (values.size() != surface.vertex_count()) {
    throw InvalidInput("values of " + std::to_string(values.size()) + " vertices given for a surface of " +
                       std::to_string(surface.vertex_count()));
  }
  for (std::size_t v = 0; v < values.size(); ++v) {
    if (std::isnan(values[v])) throw InvalidInput("the value of vertex " + std::to_string(v) + " is not a number");
  }
  for (std::size_t i = 0; i < levels.size(); ++i) {
    if (!std::isfinite(levels[i])) throw InvalidInput("level " + std::to_string(i) + " is not finite");
    if (i > 0 && !(levels[i - 1] < levels[i])) {
      throw InvalidInput("levels are not ascending: level " + std::to_string(i) + " is " + text(levels[i]) +
                         ", after " + text(levels[i - 1]));
    }
  }
}

}  // namespace

Isolines isolines(const Surface& surface, std::span<const double> values, std::span<const double> levels) {
  check(surface, values, levels);
  Isolines out;
  const std::vector<Triangle>& triangles = surface.triangles();
  const std::vector<std::int32_t>& duplicates = surface.report().duplicate_faces;
  for (std::size_t f = 0; f < triangles.size(); ++f) {
    if (std::ranges::binary_search(duplicates, static_cast<std::int32_t>(f))) continue;
    const Triangle& t = triangles[f];
    const std::array<double, 3> at{values[t[0]], values[t[1]], values[t[2]]};
    if (!std::ranges::all_of(at, [](double value) { return std::isfinite(value); })) continue;
    const auto [low, high] = std::ranges::minmax(at);
    const auto first = std::ranges::upper_bound(levels, low);
    for (auto level = first; level != levels.end() && *level <= high; ++level) {
      const auto is_above = [&](std::size_t i) { return at[i] >= *level; };
      // Always from the lower to the higher end, so that neighbors compute the same point.
      const auto crossing = [&](std::size_t i, std::size_t j) {
        const std::size_t below = is_above(i) ? j : i, above = is_above(i) ? i : j;
        const double half = std::isfinite(at[above] - at[below]) ? 1.0 : 0.5;  // of large values, lest they overflow
        const double part = (half * *level - half * at[below]) / (half * at[above] - half * at[below]);
        const Vector &p = surface.points()[t[below]], &q = surface.points()[t[above]];
        return Vector(p + part * (q - p));
      };
      // The corner that is alone on its side of the level.
      std::size_t alone = 0;
      while (is_above(alone) == is_above((alone + 1) % 3) || is_above(alone) == is_above((alone + 2) % 3)) ++alone;
      const std::size_t i = (alone + 1) % 3, j = (alone + 2) % 3;
      const std::array<Vector, 2> ends{crossing(alone, i), crossing(alone, j)};
      if (ends[0] == ends[1]) continue;  // at a corner
      out.segments.push_back(is_above(alone) ? ends : std::array{ends[1], ends[0]});
      out.faces.push_back(static_cast<std::int32_t>(f));
      out.levels.push_back(static_cast<std::int32_t>(level - levels.begin()));
    }
  }
  return out;
}

}  // namespace seamwire
