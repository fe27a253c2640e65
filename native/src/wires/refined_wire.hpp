// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <optional>

#include "seamwire/metric/metric.hpp"
#include "seamwire/surface/surface.hpp"
#include "seamwire/surface/surface_point.hpp"
#include "seamwire/task.hpp"
#include "seamwire/wires/wire.hpp"

namespace seamwire::detail {

/// How exact a wire is to become.
struct WireRefinement {
  double max_error;         ///< EmbedOptions::max_error, above 0
  double mean_edge_length;  ///< EmbedOptions::mean_edge_length: that of the whole surface in the metric
  int rings = 5;            ///< of faces around the wire, where a better way is looked for
};

/// The shortest wire between the ends of `first` in its corridor: the faces that it crosses and some rings of faces
/// around them, embedded so that they resolve the metric. Measured there, it is not longer than `first`, unless length
/// repair or a hole changes the corridor. Takes time proportional to the corridor, but for copying the surface's
/// points.
///
/// `from` and `to` are the ends on the surface. Nothing if `first` crosses no face, all triangles of its corridor
/// resolve the metric as they are, or its ends are not connected in the corridor. Throws what embed() throws;
/// Cancelled.
std::optional<Wire> refined_wire(const std::shared_ptr<const Surface>& surface, const Metric& metric, const Wire& first,
                                 const SurfacePoint& from, const SurfacePoint& to, const WireRefinement& refinement,
                                 const Task& task = {});

}  // namespace seamwire::detail
