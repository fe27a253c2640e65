// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>

#include "seamwire/embedding/embedding.hpp"

namespace seamwire::detail {

/// re_embed() for an embedding that is local; normals of the two metrics must be equal. At most `most` triangles are
/// added to the surface's. Nothing where that is not enough, or longest-edge bisection does not end well. Throws
/// Cancelled.
std::optional<Embedding> re_embed_locally(const Surface& surface, const Metric& former, const Metric& metric,
                                          Embedding&& old, const EmbedOptions& options, const Task& task,
                                          std::size_t most);

/// Whether a face of the surface's corner fans is valid in a metric as it is.
bool is_valid_as_given(const Surface& surface, const Metric& metric, std::int32_t face);

}  // namespace seamwire::detail
