// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "seamwire/surface/surface.hpp"
#include "seamwire/task.hpp"

namespace seamwire::detail {

/// Some of the caller's faces and all faces within so many rings of them, ascending. A ring consists of the faces that
/// share a corner fan or an edge with the faces before. Takes time proportional to the result. Throws Cancelled.
std::vector<std::int32_t> faces_within_rings(const Surface& surface, const std::vector<std::int32_t>& faces, int rings,
                                             const Task& task);

}  // namespace seamwire::detail
