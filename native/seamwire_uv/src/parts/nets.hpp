// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "prices/plan_mesh.hpp"
#include "seamwire/task.hpp"

namespace seamwire::detail {

/// A mesh that is divided into regions, as find_folds() takes it.
struct NetProblem {
  const PlanMesh& mesh;
  const Pieces& pieces;
  std::span<const double> diagonals;         ///< of each piece
  std::span<const std::int32_t> region_of;   ///< of each triangle, named after any number below that of triangles
  std::span<const std::uint8_t> may_fold;    ///< of each edge: 0 if the rim there cannot fold
  std::span<const std::uint8_t> is_parting;  ///< of each edge: 1 if the regions there must lie in separate islands
  const Reflection* reflection = nullptr;    ///< null if the mesh is not symmetric
};

/// Finds the edges over which the faces of a box or of another polyhedron stay together, as in a net of cardboard.
///
/// A piece opens as a net if each of its regions unfolds into the plane without stretch. Regions are attached to the
/// central one, then to its neighbors, and so on. Straight rims attach them, as long as the net does not cover itself.
/// Nets of symmetric pieces are symmetric where that is possible. Returns 1 for each edge that folds. Throws Cancelled.
std::vector<std::uint8_t> find_folds(const NetProblem& problem, const Task& task);

}  // namespace seamwire::detail
