// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>

namespace seamwire {

/// Elements are numbered from 0; -1 stands for none.
using Triangle = std::array<std::int32_t, 3>;  ///< vertex numbers
using Edge = std::array<std::int32_t, 2>;      ///< vertex numbers, the smaller one first where it is not directed

}  // namespace seamwire
