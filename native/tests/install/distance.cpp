// SPDX-License-Identifier: GPL-3.0-or-later
#include <cstdio>
#include <seamwire/wires/wire.hpp>

int main() {
  const seamwire::Surface square({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, {{0, 1, 3}, {1, 2, 3}});
  const auto metric = seamwire::euclidean_metric(square, seamwire::principal_curvatures(square));
  const auto embedding = seamwire::embed(square, metric);
  const auto field = seamwire::ExactGeodesics(embedding.mesh).solve(0);
  const auto wire = seamwire::map_wire(square, embedding, field.trace(2));
  std::printf("%.6f over %zu faces\n", wire.length, wire.faces.size());
}
