// SPDX-License-Identifier: GPL-3.0-or-later
// The snippets of docs/library/metrics.md.
#include <cstdio>

#include "mesh.hpp"
#include "seamwire/context/embedded_surface.hpp"
#include "seamwire/metric/crest_lines.hpp"

using namespace seamwire;

int main() {
  const auto [points, triangles] = sheet();
  const Surface surface(points, triangles);
  //! [curvature]
  const Curvature curvature = principal_curvatures(surface);
  const Curvature smooth = smoothed_curvatures(surface, curvature, 0.01);  // for noisy scans
  //! [curvature]

  //! [families]
  const Strength strength{.max_anisotropy = 20.0, .clamp_percentile = 99.0};
  const Metric along = feature_metric(surface, curvature, Follow::kMin, strength);
  const Metric across = feature_metric(surface, curvature, Follow::kMax, strength);
  const Metric concave = concave_metric(surface, smooth);
  std::printf("anisotropies %g, %g, %g\n", max_anisotropy(along), max_anisotropy(across), max_anisotropy(concave));
  //! [families]

  //! [spec]
  const SurfaceContext context(std::make_shared<const Surface>(surface));
  const MetricSpec spec = MetricSpec::feature(Follow::kMin, strength);
  const Metric same = make_metric(context, spec);
  //! [spec]
  std::printf("%zu tensors\n", same.size());

  //! [own]
  Metric own = euclidean_metric(surface, curvature);
  for (std::size_t v = 0; v < own.size(); ++v) {
    const Vector& n = own.normals[v];
    const Vector down = Vector(0, 0, 1) - n.z() * n;  // the vertical direction, in the tangent plane
    own.tensors[v] += 9.0 * down * down.transpose();  // climbing is up to sqrt(10) times as long
  }
  const EmbeddedSurface in_own(context, std::make_shared<const Metric>(own));
  //! [own]
  std::printf("anisotropy %g\n", max_anisotropy(in_own.metric()));

  //! [crests]
  const CrestLines lines = crest_lines(surface, smooth);
  std::printf("%zu ridges and valleys\n", lines.strengths.size());
  //! [crests]
}
