// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "seamwire/api.hpp"
#include "seamwire/surface/types.hpp"

namespace seamwire {

/// How many hues there are. Hue h is the color at (4 + 5 h) mod 12 twelfths of the rainbow, so that hues with numbers
/// next to each other look different.
inline constexpr std::int32_t kHues = 12;

/// Islands that had hues before.
struct FormerIslands {
  std::vector<std::int32_t> islands = {};  ///< per triangle: its island, from 0; empty if there were no islands
  std::vector<std::uint8_t> hues = {};     ///< per island
};

/// Choose a hue for each island, far in the rainbow from those of its neighbors.
///
/// Islands are neighbors if they meet at a cut edge. The hues of neighbors are 3 twelfths apart where possible. An
/// island keeps the hue of the former island to which most of it belonged, unless a larger neighbor has one that is
/// too near. If there are more than 4096 islands, neighbors may have equal hues.
///
/// \param triangles vertices of triangles
/// \param islands the island of each triangle, from 0; the largest island comes first
/// \param cuts pairs of vertices
/// \param former the islands whose hues should stay
/// \returns per island, its hue from 0 to 11
/// \throws InvalidInput if an array has the wrong size, or a number is negative
/// \see Brelaz, New methods to color the vertices of a graph, 1979
SEAMWIRE_API std::vector<std::uint8_t> island_hues(std::span<const Triangle> triangles,
                                                   std::span<const std::int32_t> islands, std::span<const Edge> cuts,
                                                   const FormerIslands& former = {});

}  // namespace seamwire
