// SPDX-License-Identifier: GPL-3.0-or-later
// The snippets of docs/library/edges.md.
#include <cstdio>
#include <memory>
#include <utility>
#include <vector>

#include "mesh.hpp"
#include "seamwire/context/embedded_surface.hpp"
#include "seamwire/edges/edge_loop.hpp"
#include "seamwire/edges/edge_wires.hpp"
#include "seamwire/edges/fit_chain.hpp"
#include "seamwire/edges/shortest_cycle.hpp"

using namespace seamwire;

int main() {
  const auto [points, triangles] = sheet();
  const Surface surface(points, triangles);
  const Curvature curvature = principal_curvatures(surface);
  const std::int32_t start = 10 * 101 + 44, end = 140 * 101 + 56;
  //! [chain]
  const Metric metric = feature_metric(surface, curvature, Follow::kMin, {.max_anisotropy = 20.0});
  const std::shared_ptr<const EdgeGraph> graph = make_edge_graph(surface, metric);
  const EdgeWires chains = edge_wires(graph, {.a = start});
  const EdgeChain chain = chains.trace({.a = end}).value();
  std::printf("%zu vertices, cost %g\n", chain.vertices.size(), chain.length);
  //! [chain]

  //! [cycle]
  const auto [ring, ring_triangles] = torus();
  const Surface tube(ring, ring_triangles);
  const Metric euclidean = euclidean_metric(tube, principal_curvatures(tube));
  const EdgeChain cycle = shortest_cycle(*make_edge_graph(tube, euclidean), Edge{0, 1}).value();
  const EdgeLoop loop = edge_loop(*make_edge_adjacency(tube), Edge{0, 1}, {});
  //! [cycle]
  std::printf("%zu and %zu vertices around the tube\n", cycle.vertices.size(), loop.vertices.size());

  //! [fit]
  std::vector<Vector> line;
  for (int i = 20; i < 140; i += 10) line.push_back(points[static_cast<std::size_t>(i * 101 + 50)]);
  std::vector<std::int32_t> faces;
  for (int i = 20; i < 140; i += 10) faces.push_back(2 * (i * 100 + 50));
  const FittedChain fitted = fit_chain(surface, *make_edge_adjacency(surface), {line, faces});
  //! [fit]
  std::printf("%zu vertices along a line\n", fitted.vertices.size());
}
