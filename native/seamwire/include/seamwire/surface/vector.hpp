// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>

namespace seamwire {

/// A point or a direction in space.
using Vector = Eigen::Vector3d;

}  // namespace seamwire
