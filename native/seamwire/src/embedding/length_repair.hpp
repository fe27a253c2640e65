// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "embedding/bisected_mesh.hpp"
#include "seamwire/embedding/embedding.hpp"
#include "seamwire/task.hpp"

namespace seamwire::detail {

/// What length repair has done.
struct LengthRepair {
  bool is_complete = true;  ///< false: triangles that need repair are left, because of the cap or of rounding
  bool hit_cap = false;
  std::size_t clamped_edges = 0;    ///< whose length is not what the metric says
  double worst_clamp = 1.0;         ///< the largest factor, up or down, between the two lengths
  std::vector<std::int32_t> faces;  ///< those of the surface's corner fans that such edges lie in, each once or more
};

/// Bisects each triangle that needs it once more, at its longest edge. Clamps the lengths of the new edges so that its
/// parts are valid (docs/method/embedding.md, "Why it ends"). Throws Cancelled.
LengthRepair repair_lengths(BisectedMesh& mesh, const EmbedOptions& options, const Task& task, double progress);

}  // namespace seamwire::detail
