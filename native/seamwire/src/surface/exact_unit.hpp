// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>

#include "seamwire/surface/surface.hpp"

namespace seamwire::detail {

/// A power of two by which the model becomes about as large as the unit cube. Products with it are exact. Products of
/// several lengths in this unit neither overflow nor vanish, however large or small the model is.
inline double exact_unit(const Surface& surface) { return std::ldexp(1.0, std::ilogb(surface.scale())); }

}  // namespace seamwire::detail
