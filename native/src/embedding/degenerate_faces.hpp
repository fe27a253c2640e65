// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "seamwire/metric/metric.hpp"
#include "seamwire/surface/intrinsic_mesh.hpp"
#include "seamwire/surface/surface.hpp"
#include "seamwire/task.hpp"
#include "surface/half_edge_mesh.hpp"

namespace seamwire::detail {

/// A surface's half-edge mesh without those degenerate faces that could be removed.
struct CleanMesh {
  HalfEdgeMesh mesh;
  std::vector<std::int32_t> origins;  ///< the surface's half-edge face of each face left, in the order of the faces
  /// Between vertices at one place that were merged: faces have the second one only.
  std::vector<LooseEdge> merged;
  std::size_t removed = 0;  ///< how many fewer degenerate faces there are
};

/// Removes degenerate faces, which have no area (SurfaceReport::zero_area_faces), so no path could go across them, on a
/// copy of the half-edge mesh: needles, whose shortest edge has no length, by collapsing that edge; caps by flipping
/// their longest edge. Faces of which neither is possible stay. Nothing where the surface has no degenerate face.
std::optional<CleanMesh> remove_degenerate_faces(const Surface& surface, const Metric& metric);

}  // namespace seamwire::detail
