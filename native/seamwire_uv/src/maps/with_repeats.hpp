// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <optional>
#include <utility>
#include <vector>

#include "detail/index.hpp"
#include "detail/poll.hpp"
#include "seamwire/surface/surface.hpp"

namespace seamwire::detail {

/// A surface of triangles, of which those that repeat others have separate vertices: otherwise it would leave them out.
/// Throws what Surface throws.
inline Surface surface_with_repeats(std::vector<Vector> points, std::vector<Triangle> triangles,
                                    std::optional<std::vector<Edge>> edges, const Task& task) {
  std::vector<std::pair<Triangle, std::size_t>> sorted;
  sorted.reserve(triangles.size());
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    sorted.emplace_back(triangles[t], t);
    std::ranges::sort(sorted.back().first);
  }
  polled_sort(sorted, Poll(task));
  const std::size_t count = points.size();
  for (std::size_t i = 1; i < sorted.size(); ++i) {
    const Triangle& own = sorted[i].first;
    if (own != sorted[i - 1].first || !is_index(own[0], count) || !is_index(own[2], count)) continue;
    Triangle& triangle = triangles[sorted[i].second];
    for (std::int32_t& v : triangle) {
      points.push_back(Vector(points[v]));
      v = static_cast<std::int32_t>(points.size()) - 1;
    }
    for (std::size_t k = 0; edges && k < 3; ++k) edges->push_back({triangle[k], triangle[(k + 1) % 3]});
  }
  return {std::move(points), std::move(triangles), std::move(edges), task};
}

}  // namespace seamwire::detail
