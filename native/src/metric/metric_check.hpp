// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "seamwire/metric/metric.hpp"

namespace seamwire::detail {

/// Throws InvalidInput where a tensor or a normal is not finite, or an eigenvalue above kLargestEigenvalue.
void check_finite(const Metric& metric);

}  // namespace seamwire::detail
