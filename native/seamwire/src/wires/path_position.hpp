// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "seamwire/embedding/embedding.hpp"
#include "seamwire/geodesics/distance_field.hpp"

namespace seamwire::detail {

/// Where a point of a path over an embedding is, in the caller's coordinates.
Vector position(const Embedding& embedding, const PathPoint& point);

/// Throws InvalidInput where an embedding is not one of a surface, as far as sizes and the first and last vertex tell.
void check_embedding(const Surface& surface, const Embedding& embedding);

/// Throws InvalidInput where a field is of another embedding, as far as sizes tell.
void check_field(const Embedding& embedding, const DistanceField& field);

}  // namespace seamwire::detail
