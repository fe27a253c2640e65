// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <span>

#include "seams/seam_choices.hpp"
#include "seamwire/surface/surface.hpp"

namespace seamwire {

/// How often the curves of two choices cross within faces: what they are cut along encloses more there than their
/// chains of edges do. Where they only meet, or run along the same edge, they do not cross.
std::size_t curve_crossings(const Surface& surface, std::span<const Choice> choices);

}  // namespace seamwire
