// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>

#include "seamwire/surface/surface.hpp"
#include "seamwire/task.hpp"
#include "surface/corner_fans.hpp"

namespace seamwire::detail {

/// Removes degenerate faces (SurfaceReport::zero_area_faces) in OpenMesh's half-edge mesh. They have no area, so no
/// path can cross them. The surface keeps the result, for the next call. Throws Cancelled.
///
/// Needles are removed by collapsing their shortest edge, which has no length. Caps are removed by flipping their
/// longest edge. An edge is collapsed in all corner fans of the vertex that goes, so edges of three or more faces stay
/// joined. Faces that allow neither stay. Returns null if the surface has no degenerate face.
std::shared_ptr<const CleanedFans> cleaned_fans(const Surface& surface, const Task& task);

}  // namespace seamwire::detail
