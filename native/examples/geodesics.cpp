// SPDX-License-Identifier: GPL-3.0-or-later
// The snippets of docs/library/geodesics.md.
#include <cstdio>
#include <initializer_list>
#include <utility>
#include <vector>

#include "mesh.hpp"
#include "seamwire/context/embedded_surface.hpp"
#include "seamwire/geodesics/corridor_paths.hpp"

using namespace seamwire;

int main() {
  auto [points, triangles] = sheet();
  const SurfaceContext context(std::move(points), std::move(triangles));
  const EmbeddedSurface embedded(context, MetricSpec::feature(Follow::kMin, {.max_anisotropy = 20.0}));
  const std::int32_t start = 10 * 101 + 44, end = 140 * 101 + 56;
  //! [field]
  const EmbeddedField field = embedded.field(start);
  const Wire wire = field.trace(end).value();
  std::printf("length %g, %zu points\n", wire.length, wire.points.size());
  //! [field]

  //! [points]
  const SurfacePoint inside{15000, {0.2, 0.3, 0.5}};
  std::printf("distance of a point in a face: %g\n", field.distance(inside));
  const Wire to_it = field.trace(inside).value();
  //! [points]
  std::printf("its wire has the length %g\n", to_it.length);

  //! [seeds]
  const std::vector<SurfacePoint> seeds{start, inside};
  const EmbeddedField nearest = embedded.field(seeds);
  //! [seeds]
  std::printf("distance from the nearest seed: %g\n", nearest.distance(end));

  //! [early]
  const EmbeddedField near = embedded.field(seeds, {.targets = {start + 9}});
  const EmbeddedField limited = embedded.field(seeds, {.max_distance = 0.1, .targets = {}});
  //! [early]
  std::printf("complete up to %g and %g\n", near.distances().radius(), limited.distances().radius());

  //! [corridor]
  CorridorPaths paths(embedded.geodesics(), start);    // needs no distance field
  const IntrinsicPath path = paths.path(end).value();  // at least as long as the geodesic
  //! [corridor]
  std::printf("length of a path found at once: %g\n", path.length);

  //! [heat]
  const HeatGeodesics& heat = embedded.heat_geodesics();  // factors two matrices, once
  const EmbeddedField approximate = embedded.field(heat, seeds);
  //! [heat]
  std::printf("approximate distance from the nearest seed: %g\n", approximate.distance(end));

  //! [method]
  const ExactGeodesics& exact = embedded.geodesics();
  for (const DistanceMethod* method : std::initializer_list<const DistanceMethod*>{&exact, &heat}) {
    const EmbeddedField from_start = embedded.field(*method, {&seeds.front(), 1});
    std::printf("%g away, over a wire of %g\n", from_start.distance(end), from_start.trace(end)->length);
  }
  //! [method]
}
