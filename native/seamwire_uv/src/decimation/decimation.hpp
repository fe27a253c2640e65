// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "prices/plan_mesh.hpp"
#include "seamwire/task.hpp"
#include "slits/slit_plan.hpp"

namespace seamwire::detail {

/// A mesh with fewer triangles, and where its vertices come from.
struct DecimatedMesh {
  PlanMesh mesh;
  std::vector<std::int32_t> vertices;  ///< the vertex of the original mesh at the same place, for each vertex
  std::vector<std::uint8_t> is_seam;   ///< of each edge
};

/// Collapses edges onto one of their ends, until a number of triangles is left or no further collapse is possible
/// without a change of topology or a fold. Edges whose collapse changes the shape least come first (Garland and
/// Heckbert 1997). Boundaries and seams stay boundaries and seams. The mesh stays symmetric if the reflection is exact.
/// `is_seam`: of each edge. Throws Cancelled.
DecimatedMesh decimate(const PlanMesh& mesh, std::span<const std::uint8_t> is_seam, const Reflection* reflection,
                       std::size_t triangles, const Task& task);

/// Slits on a simplified mesh, as slits on the original one: chains of its real edges that run along them closely.
/// Slits that start on others start at the same vertices. The image of a slit on an exactly symmetric mesh is exact. A
/// slit that the original's edges cannot follow is left out. `vertices`: of the original, for each vertex of the
/// simplified mesh. Throws Cancelled.
std::vector<Slit> carried_slits(const SlitProblem& simple, std::span<const std::int32_t> vertices,
                                const SlitProblem& original, std::span<const Slit> slits, const Task& task);

}  // namespace seamwire::detail
