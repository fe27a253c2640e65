// SPDX-License-Identifier: GPL-3.0-or-later
#include "maps/left_out_uvs.hpp"

#include <algorithm>
#include <map>
#include <utility>
#include <vector>

#include "detail/index.hpp"
#include "surface/corner_fans.hpp"

namespace seamwire::detail {

void fill_left_out(const Surface& surface, std::span<const std::int32_t> islands, CornerUvs& uvs) {
  std::vector<std::int32_t> left_out = surface.report().degenerate_faces;
  left_out.insert(left_out.end(), surface.report().duplicate_faces.begin(), surface.report().duplicate_faces.end());
  if (left_out.empty()) return;
  std::map<std::pair<std::int32_t, std::int32_t>, Eigen::Vector2d> wanted;  // by island and vertex
  for (const std::int32_t f : left_out) {
    for (const std::int32_t v : surface.triangles()[f]) {
      wanted.emplace(std::pair(islands[f], v), Eigen::Vector2d::Zero());
    }
  }
  const std::size_t count = index(std::ranges::max(islands)) + 1;
  std::vector<Eigen::Vector2d> center(count, Eigen::Vector2d::Zero());
  std::vector<double> corners(count, 0.0);
  for (const std::int32_t f : corner_fans(surface).faces) {
    const std::int32_t island = islands[f];
    for (const Eigen::Vector2d& uv : uvs[f]) {
      corners[island] += 1.0;
      center[island] += (uv - center[island]) / corners[island];
    }
  }
  for (auto& [key, uv] : wanted) uv = center[key.first];
  for (const std::int32_t f : corner_fans(surface).faces) {
    for (std::size_t i = 0; i < 3; ++i) {
      const auto found = wanted.find({islands[f], surface.triangles()[f][i]});
      if (found != wanted.end()) found->second = uvs[f][i];
    }
  }
  for (const std::int32_t f : left_out) {
    for (std::size_t i = 0; i < 3; ++i) uvs[f][i] = wanted.at({islands[f], surface.triangles()[f][i]});
  }
}

}  // namespace seamwire::detail
