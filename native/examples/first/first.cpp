// SPDX-License-Identifier: GPL-3.0-or-later
// The first program of docs/library.md.
//! [first]
#include <cstdio>
#include <exception>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "mesh.hpp"
#include "seamwire/seamwire.hpp"

using namespace seamwire;

void connect(Surface surface, int start, int end) {
  const SurfaceContext context(std::make_shared<const Surface>(std::move(surface)));
  std::vector<std::vector<Vector>> lines;
  const Strength strength{.max_anisotropy = 20.0, .clamp_percentile = 99.0};
  for (const MetricSpec& metric : {MetricSpec::euclidean(), MetricSpec::feature(Follow::kMin, strength)}) {
    const EmbeddedSurface embedded(context, metric, {.max_error = 0.01});
    const std::optional<Wire> wire = embedded.field(start).trace(end);
    if (!wire) throw std::runtime_error("no path connects the two vertices");
    const double scale = embedded.surface().scale();
    std::printf("%s: %.3f long, %.3f in the metric, distances are off by about %.1f %% on average\n",
                info_of(metric.family).name.data(), wire->euclidean_length / scale, wire->length / scale,
                100.0 * embedded.embedding().resolution->estimated_error);
    lines.push_back(wire->points);
  }
  write_lines("geodesics.obj", lines);
}

int main(int count, char** arguments) try {
  if (count == 1) {
    const auto [points, triangles] = sheet();
    connect(Surface(points, triangles), 10 * 101 + 44, 140 * 101 + 56);
  } else if (count == 4) {
    connect(make_surface(read_mesh(arguments[1])), std::stoi(arguments[2]), std::stoi(arguments[3]));
  } else {
    std::fprintf(stderr, "usage: %s [MESH START END]\n", arguments[0]);
    return 1;
  }
} catch (const std::exception& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 1;
}
//! [first]
