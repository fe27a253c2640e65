// SPDX-License-Identifier: GPL-3.0-or-later
// The snippets of docs/library/live.md.
#include <cstdio>
#include <utility>

#include "mesh.hpp"
#include "seamwire/live/livewire.hpp"

using namespace seamwire;

int main() {
  auto [points, triangles] = sheet();
  const std::int32_t start = 10 * 101 + 44, end = 140 * 101 + 56;
  //! [live]
  LiveWire live({std::move(points), std::move(triangles)});  // returns at once, and builds the surface itself
  live.seed({.a = start});
  LiveWires found = live.wires({.a = end});  // returns at once
  live.wait();
  found = live.wires({.a = end});
  const LiveCandidate& chosen = found.wires[static_cast<std::size_t>(found.active)];
  std::printf("length %g, %zu vertices\n", chosen.length, chosen.vertices.size());
  //! [live]

  //! [edges]
  LiveWire edges = live.sibling({.along = Along::kEdges});  // shares the surface
  edges.seed({.a = start});
  edges.wait();
  std::printf("%zu vertices along edges\n", edges.wires({.a = end}).wires.front().vertices.size());
  //! [edges]

  //! [change]
  live.set_metrics(live_metrics(MetricFamily::kFeature, {.max_anisotropy = 5.0}));
  live.wait();
  //! [change]

  //! [loops]
  auto [ring, ring_triangles] = torus();
  LiveWire tube({std::move(ring), std::move(ring_triangles)}, {.along = Along::kEdges});
  tube.wait();
  tube.loop({0, 1});  // starts the search
  tube.wait();
  std::printf("a ring of %zu vertices\n", tube.loop({0, 1}).vertices.size());
  //! [loops]
}
