// SPDX-License-Identifier: GPL-3.0-or-later
// The first program of docs/library.md.
//! [first]
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <memory>

#include "mesh.hpp"
#include "seamwire/context/embedded_surface.hpp"

using namespace seamwire;

int main(int count, char** arguments) {
  const auto [points, triangles] = count == 4 ? read_obj(arguments[1]) : sheet();
  const int start = count == 4 ? std::atoi(arguments[2]) : 10 * 101 + 44;
  const int end = count == 4 ? std::atoi(arguments[3]) : 140 * 101 + 56;

  std::ofstream file("geodesics.obj");
  for (const Vector& p : points) file << "v " << p.x() << ' ' << p.y() << ' ' << p.z() << '\n';
  for (const auto& [a, b, c] : triangles) file << "f " << a + 1 << ' ' << b + 1 << ' ' << c + 1 << '\n';

  const SurfaceContext context(std::make_shared<const Surface>(points, triangles));
  const Strength strength{.max_anisotropy = 20.0, .clamp_percentile = 99.0};
  for (const MetricSpec& metric : {MetricSpec::euclidean(), MetricSpec::feature(Follow::kMin, strength)}) {
    const EmbeddedSurface embedded(context, metric, {.max_error = 0.01});
    const Wire wire = embedded.field(start).wire(end);
    std::printf("%s: %.3f long, distances are off by about %.1f %% on average\n", info_of(metric.family).name.data(),
                wire.euclidean_length / embedded.surface().scale(),
                100.0 * embedded.embedding().resolution->estimated_error);
    for (const Vector& p : wire.points) file << "v " << p.x() << ' ' << p.y() << ' ' << p.z() << '\n';
    file << 'l';
    for (std::size_t i = wire.points.size(); i > 0; --i) file << " -" << i;
    file << '\n';
  }
}
//! [first]
