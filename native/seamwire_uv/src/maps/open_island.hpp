// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "maps/cut_open.hpp"
#include "seamwire/surface/vector.hpp"
#include "seamwire/task.hpp"

namespace seamwire::detail {

/// Whether an island can be mapped to the plane: a disc, or a disc with holes, with a boundary loop of three or more
/// edges. Without such a loop no map without flips exists.
bool is_planar(const Island& island);

/// An island that was cut further but is still in one piece.
struct OpenedIsland {
  Island island;           ///< with the mesh vertices and faces of the island it was made from
  std::size_t opened = 0;  ///< edges of it that were cut
};

/// Opens an island along real edges until is_planar() holds. A closed ball is cut along a shortest path between two
/// vertices far from each other. Handles are cut along a greedy system of paths (Erickson and Whittlesey 2005) from one
/// vertex, or from the boundary if there is one. `is_real`: 1 for half-edges that may be cut. `points`: of mesh
/// vertices. Throws InvalidInput if nothing can be cut; Cancelled.
OpenedIsland open_to_plane(const Island& island, std::span<const std::uint8_t> is_real, std::span<const Vector> points,
                           const Task& task);

/// Cuts a planar island along a shortest path of real edges from its outer_loop() to the vertex farthest from it. That
/// vertex may lie on another boundary loop. If inner vertices have two triangles only, it cuts along paths to them,
/// because one of the two would be flipped in any map. Cuts nothing if no path leaves the loop. Throws Cancelled.
OpenedIsland open_to_farthest(const Island& island, std::span<const std::uint8_t> is_real,
                              std::span<const Vector> points, const Task& task);

/// Cuts an island along some of its half-edges. Returns no triangles if it falls apart.
OpenedIsland open_along(const Island& island, const std::vector<std::uint8_t>& is_cut);

}  // namespace seamwire::detail
