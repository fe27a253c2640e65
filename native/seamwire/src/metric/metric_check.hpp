// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>

#include "seamwire/metric/metric.hpp"

namespace seamwire::detail {

/// Throws InvalidInput unless there are as many curvatures, or tensors and normals, as the surface has vertices.
void check_size(const Surface& surface, const Curvature& curvature);
void check_size(const Surface& surface, const Metric& metric);

/// Throws InvalidInput where a tensor or a normal is not finite, a tensor is not symmetric, its eigenvalues are not
/// positive, or one is above kLargestEigenvalue.
void check_tensors(const Metric& metric);
/// The same for one vertex.
void check_tensor(const Metric& metric, std::size_t v);

}  // namespace seamwire::detail
