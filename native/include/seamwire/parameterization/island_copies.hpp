// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "seamwire/api.hpp"
#include "seamwire/parameterization/unwrap_mesh.hpp"

namespace seamwire {

/// An island that is a copy of an earlier one.
struct IslandCopy {
  std::size_t mesh = 0;
  std::int32_t island = 0;
  std::size_t first_mesh = 0;         ///< the mesh of the first island of this shape
  std::vector<std::int32_t> corners;  ///< of the island
  std::vector<std::int32_t> below;    ///< the corresponding corners of the first island of this shape
};

/// Islands of a mesh.
struct ChosenIslands {
  const UnwrapMesh* mesh = nullptr;
  std::vector<std::uint8_t> is_chosen;  ///< per island
};

/// Find the islands that are copies of others: the same polygons with the same lengths, mirrored or not.
///
/// Lengths differ by at most 1e-4 of the longest edge, because coordinates are rounded.
///
/// \param chosen the islands, in their order
/// \returns the copies, in that order
/// \throws InvalidInput if an array has the wrong size
SEAMWIRE_API std::vector<IslandCopy> find_island_copies(std::span<const ChosenIslands> chosen);

}  // namespace seamwire
