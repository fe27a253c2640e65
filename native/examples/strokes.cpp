// SPDX-License-Identifier: GPL-3.0-or-later
// The snippets of docs/library/strokes.md.
#include <cstdio>
#include <memory>
#include <utility>
#include <vector>

#include "mesh.hpp"
#include "seamwire/context/embedded_surface.hpp"
#include "seamwire/metric/scribble.hpp"

using namespace seamwire;

int main() {
  auto [points, triangles] = sheet();
  const SurfaceContext context(points, triangles);
  const std::int32_t start = 10 * 101 + 44, end = 140 * 101 + 56;
  //! [stroke]
  // With a max_error, a stroke would embed the whole surface again.
  const EmbeddedSurface embedded(context, MetricSpec::feature(Follow::kMin, {.max_anisotropy = 20.0}),
                                 {.max_error = 0});
  Scribble stroke;
  for (int i = 20; i < 140; i += 10) stroke.vertices.push_back(i * 101 + 50);  // across the bends of the ridge
  for (const std::int32_t v : stroke.vertices) stroke.points.push_back(points[static_cast<std::size_t>(v)]);
  const auto stroked =
      std::make_shared<const Metric>(apply_scribbles(embedded.surface(), embedded.metric(), std::vector{stroke}));
  const EmbeddedSurface changed = embedded.with_metric(stroked);  // embeds only what the stroke has changed
  const Wire wire = changed.field(start).trace(end).value();
  //! [stroke]
  std::printf("length %g after the stroke\n", wire.length);
}
