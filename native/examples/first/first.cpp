// SPDX-License-Identifier: GPL-3.0-or-later
// The first program of docs/library.md.
//! [first]
#include <cstdio>
#include <exception>
#include <fstream>
#include <memory>
#include <string>

#include "mesh.hpp"
#include "seamwire/context/embedded_surface.hpp"

using namespace seamwire;

void connect(const Mesh& mesh, int start, int end) {
  const auto& [points, triangles] = mesh;
  const SurfaceContext context(std::make_shared<const Surface>(points, triangles));
  std::ofstream file("geodesics.obj");
  for (const Vector& p : points) file << "v " << p.x() << ' ' << p.y() << ' ' << p.z() << '\n';
  for (const auto& [a, b, c] : triangles) file << "f " << a + 1 << ' ' << b + 1 << ' ' << c + 1 << '\n';

  const Strength strength{.max_anisotropy = 20.0, .clamp_percentile = 99.0};
  for (const MetricSpec& metric : {MetricSpec::euclidean(), MetricSpec::feature(Follow::kMin, strength)}) {
    const EmbeddedSurface embedded(context, metric, {.max_error = 0.01});
    const Wire wire = embedded.field(start).wire(end);
    const double scale = embedded.surface().scale();
    std::printf("%s: %.3f long, %.3f in the metric, distances are off by about %.1f %% on average\n",
                info_of(metric.family).name.data(), wire.euclidean_length / scale, wire.length / scale,
                100.0 * embedded.embedding().resolution->estimated_error);
    for (const Vector& p : wire.points) file << "v " << p.x() << ' ' << p.y() << ' ' << p.z() << '\n';
    file << 'l';
    for (std::size_t i = wire.points.size(); i > 0; --i) file << " -" << i;
    file << '\n';
  }
}

int main(int count, char** arguments) try {
  if (count == 1) {
    connect(sheet(), 10 * 101 + 44, 140 * 101 + 56);
  } else if (count == 4) {
    connect(read_obj(arguments[1]), std::stoi(arguments[2]), std::stoi(arguments[3]));
  } else {
    std::fprintf(stderr, "usage: %s [MESH.obj START END]\n", arguments[0]);
    return 1;
  }
} catch (const std::exception& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 1;
}
//! [first]
