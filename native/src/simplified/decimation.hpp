// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "prices/plan_mesh.hpp"
#include "prices/reflection.hpp"
#include "seamwire/task.hpp"

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

}  // namespace seamwire::detail
