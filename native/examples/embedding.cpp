// SPDX-License-Identifier: GPL-3.0-or-later
// The snippets of docs/library/embedding.md.
#include <cstdint>
#include <cstdio>
#include <numeric>
#include <utility>
#include <vector>

#include "mesh.hpp"
#include "seamwire/context/embedded_surface.hpp"

using namespace seamwire;

int main() {
  auto [points, triangles] = sheet();
  const SurfaceContext context(std::move(points), std::move(triangles));
  //! [embed]
  const MetricSpec spec = MetricSpec::feature(Follow::kMin, {.max_anisotropy = 20.0, .clamp_percentile = 99.0});
  const EmbeddedSurface embedded(context, spec, {.max_error = 0});  // only invalid triangles, as in the paper
  const Embedding& embedding = embedded.embedding();
  std::printf("%zu triangles were invalid, %zu were added\n", embedding.invalid_before, embedding.faces_added);
  //! [embed]

  //! [error]
  const EmbeddedSurface refined(context, spec);  // a max_error of 0.01
  const Resolution resolution = *refined.embedding().resolution;
  std::printf("%zu were added for an error of %g; %zu triangles miss it\n", refined.embedding().faces_added,
              resolution.estimated_error, resolution.unmet);
  //! [error]

  //! [intrinsic]
  IntrinsicMesh tetrahedron;
  tetrahedron.vertex_count = 4;
  tetrahedron.triangles = {{0, 1, 2}, {0, 3, 1}, {1, 3, 2}, {2, 3, 0}};
  tetrahedron.twins = {5, 8, 11, 10, 6, 0, 4, 9, 1, 7, 3, 2};
  tetrahedron.lengths = std::vector<double>(12, 1.0);
  const ExactGeodesics geodesics(tetrahedron);
  std::printf("an edge is %g long\n", geodesics.solve(0).distances()[3]);
  //! [intrinsic]

  //! [faces]
  std::vector<std::int32_t> patch(500);
  std::iota(patch.begin(), patch.end(), 0);
  const EmbeddedSurface part(context, spec, {.faces = patch});
  std::printf("%zu triangles\n", part.embedding().mesh.face_count());
  //! [faces]
}
