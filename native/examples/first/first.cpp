// SPDX-License-Identifier: GPL-3.0-or-later
// The first program of docs/library.md.
//! [first]
#include <cstdio>
#include <exception>
#include <string>

#include "seamwire/seamwire.hpp"

using namespace seamwire;

int main(int count, char** arguments) try {
  if (count != 4) throw InvalidInput("usage: first MESH START END");
  const SurfaceContext context(make_surface(read_mesh(arguments[1])));
  const MetricSpec metric = MetricSpec::feature(Follow::kMin, {.max_anisotropy = 20.0, .clamp_percentile = 99.0});
  const EmbeddedSurface embedded(context, metric);
  const auto wire = embedded.field(std::stoi(arguments[2])).trace(std::stoi(arguments[3]));
  if (!wire) throw InvalidInput("no path connects the two vertices");
  std::printf("%.3f long, %.3f in the metric\n", wire->euclidean_length, wire->length);
  write_lines("wire.obj", {wire->points});
} catch (const std::exception& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 1;
}
//! [first]
