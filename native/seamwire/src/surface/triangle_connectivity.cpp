// SPDX-License-Identifier: GPL-3.0-or-later
#include "seamwire/surface/triangle_connectivity.hpp"

#include <algorithm>

#include "detail/index.hpp"

namespace seamwire {

std::int64_t TriangleConnectivity::euler_characteristic(std::size_t vertex_count) const {
  const auto paired = std::ranges::count_if(twins, [](std::int32_t twin) { return twin >= 0; });
  const std::int64_t edges = std::ssize(twins) - paired / 2;
  return static_cast<std::int64_t>(vertex_count) - edges + std::ssize(triangles);
}

std::vector<std::vector<std::int32_t>> TriangleConnectivity::boundary_loops(std::size_t vertex_count) const {
  std::vector<std::int32_t> next(vertex_count, -1);
  for (std::int32_t h = 0; detail::index(h) < twins.size(); ++h) {
    if (twins[h] < 0) next[tail(h)] = tip(h);
  }
  std::vector<std::vector<std::int32_t>> loops;
  for (std::int32_t start = 0; detail::index(start) < vertex_count; ++start) {
    if (next[start] < 0) continue;
    loops.emplace_back();
    for (std::int32_t v = start; next[v] >= 0;) {
      loops.back().push_back(v);
      const std::int32_t to = next[v];
      next[v] = -1;
      v = to;
    }
  }
  return loops;
}

}  // namespace seamwire
