// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "seamwire/api.hpp"
#include "seamwire/surface/surface.hpp"
#include "seamwire/task.hpp"
#include "seamwire/wires/wire.hpp"

namespace seamwire {

namespace detail {
struct SnapData;  // snap.cpp
}

/// What snapping needs to know of a surface: its polygons (triangles joined across what is not a real edge) and the
/// real edges around them. Immutable, so wires may be snapped on several threads.
class SEAMWIRE_API SnapGraph {
 public:
  /// Takes time proportional to the surface. Throws Cancelled.
  explicit SnapGraph(const Surface& surface, const Task& task = {});

 private:
  friend std::vector<std::int32_t> snap_to_edges(const Surface& surface, const SnapGraph& graph, const Wire& wire,
                                                 const Task& task);

  std::shared_ptr<const detail::SnapData> data_;
};

/// Finds a path of real edges (Surface::edges()) from wire.from to wire.to that stays close to the wire and hardly
/// zigzags. Its edges are those of the polygons that the wire crosses, and of the polygons that share an edge with
/// these. If they do not connect the ends, the polygons around them are added, ring by ring. The path minimizes a sum:
/// its integral of the distance to the wire, and 1/2 (|u| |v| - u v) for any two consecutive edges u and v. It is
/// connected and repeats no vertex. It is empty if the wire is empty, or if no path of edges leads there. Takes time
/// proportional to the faces crossed. Throws InvalidInput for a wire whose points do not lie in its faces of the
/// surface, and a graph of a surface with other numbers of vertices, faces or edges; Cancelled.
SEAMWIRE_API std::vector<std::int32_t> snap_to_edges(const Surface& surface, const SnapGraph& graph, const Wire& wire,
                                                     const Task& task = {});

}  // namespace seamwire
