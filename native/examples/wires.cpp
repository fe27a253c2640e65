// SPDX-License-Identifier: GPL-3.0-or-later
// The snippets of docs/library/wires.md.
#include <cstdio>
#include <numeric>
#include <optional>
#include <utility>
#include <vector>

#include "mesh.hpp"
#include "seamwire/context/embedded_surface.hpp"
#include "seamwire/cut/plan_cuts.hpp"
#include "seamwire/wires/plane_section.hpp"
#include "seamwire/wires/snap.hpp"

using namespace seamwire;

int main() {
  auto [points, triangles] = sheet();
  const SurfaceContext context(std::move(points), std::move(triangles));
  const EmbeddedSurface embedded(context, MetricSpec::feature(Follow::kMin, {.max_anisotropy = 20.0}));
  const std::int32_t start = 10 * 101 + 44, end = 140 * 101 + 56;
  //! [snap]
  const Wire wire = embedded.field(start).trace(end).value();
  const std::vector<std::int32_t> chain = snap_to_edges(embedded.surface(), wire);
  std::printf("%zu vertices from %d to %d\n", chain.size(), chain.front(), chain.back());
  //! [snap]

  //! [closed]
  auto [ring, ring_triangles] = torus();
  const EmbeddedSurface tube(SurfaceContext(ring, ring_triangles), MetricSpec::concave());
  const EmbeddedField field = tube.field(0);
  const std::vector<ClosedWire> cuts = field.closed_wires();
  for (const ClosedWire& cut : cuts)
    std::printf("%g long, %s\n", cut.wire.length, cut.separates ? "separates" : "around");
  //! [closed]

  //! [bent]
  const BentWires bent = field.bend(cuts.front());
  const std::optional<BentWire> through = bent.through(12);
  //! [bent]
  if (through) std::printf("%g there, %g back\n", through->there.length, through->back.length);

  //! [section]
  const PlaneSection section = plane_section(embedded.surface(), start, end, Vector(0, 0, 1));
  //! [section]
  std::printf("a straight cut of length %g\n", section.length);

  const Surface& surface = embedded.surface();
  //! [cut]
  std::vector<std::int32_t> polygons(surface.face_count());
  std::iota(polygons.begin(), polygons.end(), 0);  // each triangle is a polygon
  const std::vector<CutCurve> curves{{.points = wire.points, .start = start, .end = end, .faces = wire.faces}};
  const CutPlan plan =
      plan_cuts({.points = surface.points(), .triangles = surface.triangles(), .polygons = polygons}, curves);
  std::printf("%zu edges and %zu polygons are cut\n", plan.splits.size(), plan.across.size());
  //! [cut]
}
