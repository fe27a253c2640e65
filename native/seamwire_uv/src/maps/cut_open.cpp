// SPDX-License-Identifier: GPL-3.0-or-later
#include "maps/cut_open.hpp"

#include <algorithm>
#include <cstddef>

#include "detail/half_edge.hpp"
#include "detail/index.hpp"
#include "detail/poll.hpp"
#include "graph/disjoint_sets.hpp"

namespace seamwire::detail {

double loop_length(std::span<const std::int32_t> loop, std::span<const Vector> points) {
  double length = 0.0;
  for (std::size_t i = 0; i < loop.size(); ++i) {
    length += (points[index(loop[i])] - points[index(loop[(i + 1) % loop.size()])]).norm();
  }
  return length;
}

std::int32_t outer_loop(const std::vector<std::vector<std::int32_t>>& boundaries, std::span<const Vector> points) {
  std::int32_t outer = -1;
  double longest = -1.0;
  for (std::int32_t loop = 0; index(loop) < boundaries.size(); ++loop) {
    if (boundaries[index(loop)].size() < 3) continue;
    const double length = loop_length(boundaries[index(loop)], points);
    if (length <= longest) continue;
    longest = length;
    outer = loop;
  }
  return outer;
}

std::int64_t Island::missing_cuts() const {
  const bool is_closed = std::ranges::none_of(twins, [](std::int32_t twin) { return twin < 0; });
  return (is_closed ? 3 : 1) - euler_characteristic();
}

std::vector<Island> cut_open(const TriangleConnectivity& mesh, std::span<const std::uint8_t> is_cut, const Task& task) {
  Poll poll(task);
  const std::vector<Triangle>& triangles = mesh.triangles;
  const std::vector<std::int32_t>& twins = mesh.twins;
  const auto count = static_cast<std::int32_t>(triangles.size());
  DisjointSets faces(triangles.size()), corners(3 * triangles.size());
  for (std::int32_t h = 0; h < 3 * count; ++h) {
    poll.next();
    const std::int32_t twin = twins[h];
    if (twin < h || is_cut[h] != 0) continue;
    faces.join(h / 3, twin / 3);
    // Where a half-edge starts, its twin ends.
    corners.join(h, next_in_face(twin));
    corners.join(next_in_face(h), twin);
  }
  std::vector<std::int32_t> place(triangles.size()), vertex_of(3 * triangles.size(), -1);
  const auto [island_of, island_count] = faces.numbering();
  std::vector<Island> islands(index(island_count));
  for (std::int32_t f = 0; f < count; ++f) {
    poll.next();
    Island& island = islands[index(island_of[f])];
    Triangle own{};
    for (std::int32_t i = 0; i < 3; ++i) {
      std::int32_t& vertex = vertex_of[corners.find(3 * f + i)];
      if (vertex < 0) {
        vertex = static_cast<std::int32_t>(island.vertices.size());
        island.vertices.push_back(triangles[f][i]);
      }
      own[index(i)] = vertex;
    }
    place[f] = static_cast<std::int32_t>(island.faces.size());
    island.triangles.push_back(own);
    island.faces.push_back(f);
  }
  for (Island& island : islands) {
    island.twins.reserve(3 * island.faces.size());
    for (const std::int32_t f : island.faces) {
      poll.next();
      for (std::int32_t h = 3 * f; h < 3 * f + 3; ++h) {
        const bool is_border = twins[h] < 0 || is_cut[h] != 0;
        island.twins.push_back(is_border ? -1 : 3 * place[twins[h] / 3] + twins[h] % 3);
      }
    }
  }
  return islands;
}

}  // namespace seamwire::detail
