// SPDX-License-Identifier: GPL-3.0-or-later
#include "wires/loop_parts.hpp"

#include "detail/index.hpp"
#include "detail/poll.hpp"

namespace seamwire::detail {

LoopParts::LoopParts(const IntrinsicMesh& mesh, const std::vector<double>& distances, const Task& task)
    : mesh_(mesh), edges_(mesh, task) {
  Poll poll(task, 0.1, 0.1, 1);
  faces_of_edge_ = Csr<std::int32_t>(edges_.edge_count(), [&](const auto& visit) {
    for (std::int32_t e = 0; index(e) < edges_.edge_count(); ++e) {
      poll.next();
      const auto [face, beyond] = edges_.faces[e];
      const std::int32_t h = edges_.half_edge_of[e];
      visit(e, face);
      if (!mesh.has_siblings(h)) visit(e, beyond);
      if (mesh.has_siblings(h)) mesh.for_each_beyond(h, [&](std::int32_t other) { visit(e, other / 3); });
    }
  });
  edges_of_face_ = Csr<std::int32_t>(edges_.face_count + edges_.hole_count, [&](const auto& visit) {
    for (std::int32_t e = 0; index(e) < edges_.edge_count(); ++e) {
      poll.next();
      for (const std::int32_t f : faces_of_edge_[e]) visit(f, e);
    }
  });
  const std::vector<std::uint8_t> is_in_tree = spanning_tree(mesh, edges_, distances, task);
  tree_ = Csr<Step>(index(mesh.vertex_count), [&](const auto& visit) {
    for (std::int32_t e = 0; index(e) < edges_.edge_count(); ++e) {
      poll.next();
      const std::int32_t h = edges_.half_edge_of[e];
      if (is_in_tree[e] == 0) continue;
      visit(mesh.tail(h), Step{mesh.tip(h), e});
      visit(mesh.tip(h), Step{mesh.tail(h), e});
    }
    for (const LooseEdge& edge : mesh.loose_edges) {
      visit(edge.a, Step{edge.b, -1});
      visit(edge.b, Step{edge.a, -1});
    }
  });
}

/// Whether each edge is on the loop that an edge closes.
std::vector<std::uint8_t> LoopParts::loop_edges(std::int32_t edge, const Task& task) const {
  const std::int32_t from = mesh_.tail(edges_.half_edge_of[edge]), to = mesh_.tip(edges_.half_edge_of[edge]);
  std::vector<Step> back(index(mesh_.vertex_count), {-1, -1});
  std::vector<std::int32_t> front{from};
  back[from].to = from;
  const Poll poll(task, 0.9, 0.9, 1);
  for (std::size_t next = 0; next < front.size() && back[to].to < 0; ++next) {
    poll.at(next);
    for (const Step& step : tree_[front[next]]) {
      if (back[step.to].to >= 0) continue;
      back[step.to] = {front[next], step.edge};
      front.push_back(step.to);
    }
  }
  std::vector<std::uint8_t> is_on_loop(edges_.edge_count(), 0);
  is_on_loop[edge] = 1;
  if (back[to].to < 0) return is_on_loop;
  for (std::int32_t v = to; v != from; v = back[v].to) {
    if (back[v].edge >= 0) is_on_loop[back[v].edge] = 1;
  }
  return is_on_loop;
}

std::vector<std::uint8_t> LoopParts::side_of(std::int32_t half_edge, const Task& task) const {
  const std::int32_t edge = edges_.edge_of[half_edge];
  const std::vector<std::uint8_t> is_on_loop = loop_edges(edge, task);
  std::vector<std::uint8_t> side(edges_of_face_.row_count(), kElsewhere);
  std::vector<std::int32_t> front;
  std::uint8_t current = kLeft;
  Poll poll(task, 0.9, 0.9, 1);
  for (const std::int32_t first : faces_of_edge_[edge]) {
    if (side[first] != kElsewhere) continue;
    side[first] = current;
    front.push_back(first);
    while (!front.empty()) {
      poll.next();
      const std::int32_t face = front.back();
      front.pop_back();
      for (const std::int32_t e : edges_of_face_[face]) {
        if (is_on_loop[e] != 0) continue;
        for (const std::int32_t other : faces_of_edge_[e]) {
          if (side[other] != kElsewhere) continue;
          side[other] = current;
          front.push_back(other);
        }
      }
    }
    current = kRight;
  }
  return side;
}

}  // namespace seamwire::detail
