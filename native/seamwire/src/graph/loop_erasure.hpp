// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <unordered_map>
#include <vector>

namespace seamwire::detail {

/// A walk without its loops, which are left out in the order in which the walk closes them (Lawler, "A self-avoiding
/// random walk", 1980). Searches that pay for turns find walks that go round a loop to turn more gently.
inline std::vector<std::int32_t> without_loops(std::span<const std::int32_t> walk) {
  std::vector<std::int32_t> path;
  path.reserve(walk.size());
  std::unordered_map<std::int32_t, std::size_t> place;  // in the path
  place.reserve(walk.size());
  for (const std::int32_t vertex : walk) {
    const auto [known, is_new] = place.try_emplace(vertex, path.size());
    if (is_new) {
      path.push_back(vertex);
      continue;
    }
    for (; path.size() > known->second + 1; path.pop_back()) place.erase(path.back());
  }
  return path;
}

}  // namespace seamwire::detail
