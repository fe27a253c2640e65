// SPDX-License-Identifier: GPL-3.0-or-later
#include "wires/spanning_tree.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "detail/half_edge.hpp"
#include "detail/index.hpp"
#include "detail/infinity.hpp"
#include "detail/poll.hpp"
#include "graph/disjoint_sets.hpp"

namespace seamwire::detail {
namespace {

/// One end of a half-edge.
struct End {
  std::int32_t half_edge;
  bool is_tip;
};

/// The next edge of the boundary around the vertex at the end of one. Nothing where an edge with three or more
/// triangles comes first.
std::optional<End> next_of_boundary(const IntrinsicMesh& mesh, End at) {
  while (true) {
    at = {at.is_tip ? next_in_face(at.half_edge) : previous_in_face(at.half_edge), !at.is_tip};
    const std::int32_t h = at.half_edge, twin = mesh.twins[h];
    if (twin >= 0) {
      at = {twin, !at.is_tip};
    } else if (mesh.has_siblings(h)) {
      const std::int32_t sibling = mesh.siblings[h];
      if (mesh.siblings[sibling] != h) return std::nullopt;
      at = {sibling, mesh.tail(sibling) == mesh.tail(h) ? at.is_tip : !at.is_tip};
    } else {
      return at;
    }
  }
}

/// Calls visit(half_edge) for each edge of a boundary, which may be closed or not.
template <class Visit>
void walk_boundary(const IntrinsicMesh& mesh, std::int32_t first, const Visit& visit) {
  visit(first);
  for (const bool is_tip : {true, false}) {
    std::optional<End> at = next_of_boundary(mesh, {first, is_tip});
    for (; at && at->half_edge != first; at = next_of_boundary(mesh, {at->half_edge, !at->is_tip})) {
      visit(at->half_edge);
    }
    if (at) return;  // it is closed
  }
}

}  // namespace

EdgesAndHoles::EdgesAndHoles(const IntrinsicMesh& mesh, const Task& task)
    : NumberedEdges(numbered_edges(mesh, Poll(task, 0.0, 0.05, 3 * mesh.face_count()))), face_count(mesh.face_count()) {
  std::vector<std::int32_t> hole_of(3 * face_count, -1);
  faces.reserve(edge_count());
  Poll poll(task, 0.05, 0.1, edge_count());
  for (const std::int32_t h : half_edge_of) {
    poll.next();
    if (const std::int32_t twin = mesh.twins[h]; twin >= 0 || mesh.has_siblings(h)) {
      faces.push_back({h / 3, twin >= 0 ? twin / 3 : h / 3});
      continue;
    }
    if (hole_of[h] < 0) {
      const auto hole = static_cast<std::int32_t>(face_count + hole_count++);
      walk_boundary(mesh, h, [&](std::int32_t at) { hole_of[at] = hole; });
    }
    faces.push_back({h / 3, hole_of[h]});
  }
}

std::vector<std::uint8_t> spanning_tree(const IntrinsicMesh& mesh, const EdgesAndHoles& edges,
                                        const std::vector<double>& distances, const Task& task) {
  struct Up {
    double length = kInfinity;
    std::int32_t to = -1, edge = -1;
  };
  std::vector<Up> up(index(mesh.vertex_count));
  const auto see = [&](std::int32_t a, std::int32_t b, double length, std::int32_t edge) {
    if (distances[b] < distances[a]) std::swap(a, b);
    if (!(distances[a] < distances[b])) return;
    if (distances[a] + length < up[b].length) up[b] = {distances[a] + length, a, edge};
  };
  const Poll seeing(task, 0.1, 0.2, edges.edge_count());
  for (std::size_t e = 0; e < edges.edge_count(); ++e) {
    seeing.at(e);
    const std::int32_t h = edges.half_edge_of[e];
    see(mesh.tail(h), mesh.tip(h), mesh.lengths[h], static_cast<std::int32_t>(e));
  }
  for (const LooseEdge& edge : mesh.loose_edges) see(edge.a, edge.b, edge.length, -1);

  std::vector<std::uint8_t> is_in(edges.edge_count(), 0);
  DisjointSets parts(up.size());
  const Poll joining(task, 0.2, 0.2, up.size());
  for (std::int32_t v = 0; v < mesh.vertex_count; ++v) {
    joining.at(index(v));
    if (up[v].to < 0) continue;
    parts.join(v, up[v].to);
    if (up[v].edge >= 0) is_in[up[v].edge] = 1;
  }
  struct Bridge {
    double length;
    std::int32_t edge, a, b;
  };
  std::vector<Bridge> bridges;
  const auto see_bridge = [&](std::int32_t a, std::int32_t b, double length, std::int32_t edge) {
    const double whole = distances[a] + distances[b] + length;
    if (std::isfinite(whole) && parts.find(a) != parts.find(b)) bridges.push_back({whole, edge, a, b});
  };
  for (const LooseEdge& edge : mesh.loose_edges) see_bridge(edge.a, edge.b, edge.length, -1);
  const Poll bridging(task, 0.2, 0.25, edges.edge_count());
  for (std::size_t e = 0; e < edges.edge_count(); ++e) {
    bridging.at(e);
    const std::int32_t h = edges.half_edge_of[e];
    see_bridge(mesh.tail(h), mesh.tip(h), mesh.lengths[h], static_cast<std::int32_t>(e));
  }
  std::ranges::sort(bridges, {}, [](const Bridge& bridge) { return std::pair(bridge.length, bridge.edge); });
  for (const Bridge& bridge : bridges) {
    if (parts.join(bridge.a, bridge.b) && bridge.edge >= 0) is_in[bridge.edge] = 1;
  }
  task.check(0.25);
  return is_in;
}

}  // namespace seamwire::detail
