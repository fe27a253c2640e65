// SPDX-License-Identifier: GPL-3.0-or-later
#include "parts/parts_between.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <map>
#include <span>
#include <vector>

#include "detail/index.hpp"
#include "detail/poll.hpp"
#include "graph/edge_chains.hpp"
#include "seamwire/surface/segments.hpp"
#include "surface/real_edges.hpp"

namespace seamwire::detail {
namespace {

/// An edge of the mesh, as vertices of the surface.
Edge edge_of_surface(const PlanMesh& mesh, std::int32_t half_edge) {
  return ascending(mesh.sources[mesh.tail(half_edge)], mesh.sources[mesh.tip(half_edge)]);
}

/// Keeps rims, and edges between two parts. `of_face`: the part of each of the surface's
/// triangles.
void leave_out_inner(const PlanMesh& mesh, std::span<const std::uint8_t> is_rim, std::span<const std::int32_t> of_face,
                     std::vector<Edge>& edges, const Task& task) {
  const Poll poll(task);
  std::map<Edge, std::array<std::int32_t, 2>> parts_at;  // the least and the greatest
  for (const Edge& edge : edges) parts_at[edge] = {std::numeric_limits<std::int32_t>::max(), -1};
  for (std::int32_t h = 0; index(h) < mesh.twins.size(); ++h) {
    poll.at(index(h));
    const auto at = parts_at.find(edge_of_surface(mesh, h));
    if (at == parts_at.end()) continue;
    if (is_rim[mesh.edge_of[h]] != 0) {
      parts_at.erase(at);
      continue;
    }
    auto& [least, greatest] = at->second;
    least = std::min(least, of_face[mesh.faces[h / 3]]);
    greatest = std::max(greatest, of_face[mesh.faces[h / 3]]);
  }
  std::erase_if(edges, [&](const Edge& edge) {
    const auto at = parts_at.find(edge);
    return at != parts_at.end() && at->second[0] == at->second[1];
  });
}

}  // namespace

Parts parts_between(const Surface& surface, const PlanMesh& mesh, std::span<const std::uint8_t> is_border,
                    std::span<const std::uint8_t> is_rim, std::span<const Edge> seams, const Task& task) {
  const Poll poll(task);
  std::vector<Edge> borders;
  for (std::int32_t e = 0; index(e) < mesh.edge_count(); ++e) {
    poll.at(index(e));
    if (is_border[e] != 0) borders.push_back(edge_of_surface(mesh, mesh.half_edge_of[e]));
  }
  polled_sort(borders, Poll(task));
  std::vector<Edge> cuts = borders;
  cuts.insert(cuts.end(), seams.begin(), seams.end());
  Parts parts;
  parts.of_face = face_segments(surface, cuts, task);
  leave_out_inner(mesh, is_rim, parts.of_face, borders, task);
  std::vector<std::uint8_t> is_meeting(surface.vertex_count(), 0);
  for (const Edge& edge : seams) {
    for (const std::int32_t v : edge) is_meeting[v] = 1;
  }
  parts.borders = EdgeChains(is_meeting.size(), borders).all([&](std::int32_t v) { return is_meeting[v] != 0; });
  for (const std::int32_t part : parts.of_face) parts.count = std::max(parts.count, index(part) + 1);
  return parts;
}

}  // namespace seamwire::detail
