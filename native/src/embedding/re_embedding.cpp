// SPDX-License-Identifier: GPL-3.0-or-later
//
// Embedding again after a change of the metric: the faces where it has changed are made what they were before any
// bisection, and bisected anew.
#include "embedding/re_embedding.hpp"

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

#include "embedding/bisection.hpp"
#include "surface/corner_fans.hpp"

namespace seamwire::detail {
namespace {

// The faces at the vertices where two metrics differ, ascending. The surface's fans have the numbers of its vertices.
std::vector<std::int32_t> changed_faces(const Surface& surface, const Metric& former, const Metric& metric) {
  std::vector<std::int32_t> faces;
  for (std::int32_t v = 0; index(v) < surface.vertex_count(); ++v) {
    if (former.tensors[v] == metric.tensors[v]) continue;
    corner_fans(surface).for_each_leaving(v, [&](std::int32_t h) { faces.push_back(h / 3); });
  }
  std::sort(faces.begin(), faces.end());
  faces.erase(std::unique(faces.begin(), faces.end()), faces.end());
  return faces;
}

}  // namespace

bool is_valid_as_given(const Surface& surface, const Metric& metric, std::int32_t face) {
  Triangle corners = corner_fans(surface).triangles[face];
  for (std::int32_t& v : corners) v = corner_fans(surface).vertices[v];
  const auto [a, b, c] = corners;
  std::array lengths{edge_length(surface, metric, a, b), edge_length(surface, metric, b, c),
                     edge_length(surface, metric, c, a)};
  std::ranges::sort(lengths);
  return lengths[2] < (lengths[0] + lengths[1]) * (1 - kValidityMargin);
}

std::optional<Embedding> re_embed_locally(const Surface& surface, const Metric& former, const Metric& metric,
                                          Embedding&& old, const EmbedOptions& options, const Task& task,
                                          std::size_t most) {
  std::vector<std::int32_t> seeds = changed_faces(surface, former, metric);
  std::size_t invalid_before = old.invalid_before;
  for (const std::int32_t face : seeds) {
    invalid_before += is_valid_as_given(surface, former, face);
    invalid_before -= is_valid_as_given(surface, metric, face);
  }
  BisectedMesh former_mesh(surface, metric, std::move(old));
  ActiveFaces active(former_mesh);
  Bisection bisection(std::move(former_mesh), options, Scheme::kLongestEdge, &active);
  BisectedMesh& mesh = bisection.mesh();
  double progress = 0;
  while (true) {
    const std::vector<std::int32_t> faces = mesh.undo(seeds);
    active.reset(faces);
    for (const std::int32_t face : faces) active.activate(mesh, face);
    for (const std::int32_t face : faces) {
      for (std::int32_t h = 3 * face; h < 3 * face + 3; ++h) mesh.set_length(h, mesh.measure(h));
    }
    for (const std::int32_t face : faces) bisection.consider(face);
    if (!bisection.work_off(task, most, progress)) return std::nullopt;
    if (!active.has_conflicts()) break;
    // All else is done. What took part in a conflict begins anew, both sides of it together.
    seeds = active.take_conflicts(mesh);
  }
  if (bisection.has_decayed()) return std::nullopt;
  Embedding out = std::move(bisection).to_embedding();
  out.invalid_before = invalid_before;
  out.faces_embedded = active.activations();
  return out;
}

}  // namespace seamwire::detail
