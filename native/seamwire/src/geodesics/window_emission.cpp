// SPDX-License-Identifier: GPL-3.0-or-later
#include "geodesics/window_emission.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <numbers>
#include <queue>
#include <utility>
#include <vector>

#include "detail/csr.hpp"
#include "detail/drop_repeats.hpp"
#include "detail/half_edge.hpp"
#include "detail/index.hpp"
#include "detail/infinity.hpp"
#include "geodesics/geodesic_mesh.hpp"
#include "geodesics/window_kernels.hpp"

namespace seamwire::detail {
namespace {

/// A corner of a vertex, and the angles from a direction at that vertex to both sides of the corner.
struct CornerAngles {
  std::int32_t half_edge;  ///< leaves the vertex; the corner is on its left
  double at_right;         ///< to that half-edge; infinite where no corners lead there
  double at_left;          ///< to the corner's other side
};

/// The angles from a direction at a vertex to the sides of all its corners, on the shortest way through the corners and
/// over all edges between them, those with siblings too. The direction is in the corner on the left of the half-edge
/// `corner`, at `angle` from that half-edge.
std::vector<CornerAngles> angles_around(const GeodesicMesh& mesh, std::int32_t vertex, std::int32_t corner,
                                        double angle) {
  // The corners join the edges at the vertex; the angles are distances in this graph.
  const auto corners = mesh.out(vertex);
  std::vector<std::int32_t> edges;
  for (const std::int32_t h : corners) {
    edges.push_back(first_of_edge(mesh, h));
    edges.push_back(first_of_edge(mesh, previous_in_face(h)));
  }
  std::vector<std::int32_t> names = edges;
  std::ranges::sort(names);
  drop_repeats(names);
  for (std::int32_t& edge : edges) {
    edge = static_cast<std::int32_t>(std::ranges::lower_bound(names, edge) - names.begin());
  }
  struct Way {
    std::int32_t to;
    double angle;
  };
  const Csr<Way> ways(names.size(), [&](const auto& visit) {
    for (std::size_t i = 0; i < corners.size(); ++i) {
      visit(edges[2 * i], Way{edges[2 * i + 1], mesh.angle(corners[i])});
      visit(edges[2 * i + 1], Way{edges[2 * i], mesh.angle(corners[i])});
    }
  });

  std::vector<double> angles(names.size(), kInfinity);
  using Entry = std::pair<double, std::int32_t>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
  const auto lower = [&](std::int32_t edge, double to) {
    if (!(to < angles[index(edge)])) return;
    angles[index(edge)] = to;
    queue.emplace(to, edge);
  };
  for (std::size_t i = 0; i < corners.size(); ++i) {
    if (corners[i] != corner) continue;
    lower(edges[2 * i], angle);
    lower(edges[2 * i + 1], mesh.angle(corner) - angle);
  }
  while (!queue.empty()) {
    const auto [so_far, edge] = queue.top();
    queue.pop();
    if (so_far > angles[index(edge)]) continue;
    for (const Way& way : ways[edge]) lower(way.to, so_far + way.angle);
  }

  std::vector<CornerAngles> out;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    out.push_back({corners[i], angles[index(edges[2 * i])], angles[index(edges[2 * i + 1])]});
  }
  return out;
}

using HalfEdge = GeodesicMesh::HalfEdge;

/// A path arrives at a vertex in a direction known up to this angle: ties, and gains too small to count, are within it.
constexpr double kShadowMargin = 1e-3;
constexpr double kShadow = std::numbers::pi - kShadowMargin;
/// A source is next to a corner of its face below this part of a side.
constexpr double kNextToCorner = 1e-2;

}  // namespace

void WindowEmission::emit(std::int32_t v) {
  front_.relax_neighbors(v);
  const auto [arrival, angle] = arrival_at(v);
  if (arrival >= 0 && mesh_.is_branching(v)) {
    emit_shadow_windows_branching(v, arrival, angle);
    return;
  }
  std::size_t corners = 0;
  if (arrival >= 0) corners = emit_shadow_windows(v, arrival, angle);
  if (corners == mesh_.out(v).size()) return;
  // All of the umbrellas that the path did not arrive in can be seen from v.
  umbrella_.resize(corners);
  std::ranges::sort(umbrella_, {}, &Corner::half_edge);
  for (const std::int32_t h : mesh_.out(v)) {
    if (!std::ranges::binary_search(umbrella_, h, {}, &Corner::half_edge)) {
      const double whole = mesh_.angle(h);
      emit_window(v, h, whole, 0.0, whole);
    }
  }
}

/// The corner in which the shortest path arrives at v, named by the half-edge that leaves v there, and its angle from
/// that half-edge. -1 at a source, and if the path comes along a loose edge.
std::pair<std::int32_t, double> WindowEmission::arrival_at(std::int32_t v) const {
  const TraceRecord& record = front_.record(v);
  if (is_next_to_source(v, record)) return {-1, 0.0};
  if (record.half_edge >= 0) {
    const HalfEdge edge = mesh_.half_edge(record.half_edge);
    const double x = record.x - edge.apex_x, y = record.y - edge.apex_y;
    const double turn = std::atan2(edge.apex_y * x - edge.apex_x * y, -edge.apex_x * x - edge.apex_y * y);
    const std::int32_t corner = previous_in_face(record.half_edge);
    return {corner, std::clamp(turn, 0.0, mesh_.angle(corner))};
  }
  if (record.half_edge == TraceRecord::kNone || record.half_edge == TraceRecord::kLooseEdge) return {-1, 0.0};
  const std::int32_t along = ~record.half_edge;
  const HalfEdge edge = mesh_.half_edge(along);
  if (edge.tail == edge.tip) return {-1, 0.0};
  if (edge.tail == v) return {along, 0.0};
  return {next_in_face(along), mesh_.angle(next_in_face(along))};
}

/// A shortest path that bends at v has an angle of at least pi on every way around v. Emits windows where that is so,
/// at a vertex whose umbrellas meet at edges with siblings.
void WindowEmission::emit_shadow_windows_branching(std::int32_t v, std::int32_t arrival, double angle) {
  for (const CornerAngles& corner : angles_around(mesh_, v, arrival, angle)) {
    const std::int32_t h = corner.half_edge;
    const double whole = mesh_.angle(h);
    const double begin = kShadow - corner.at_right, end = whole - (kShadow - corner.at_left);
    if (h != arrival) {
      emit_window(v, h, whole, begin, end);
    } else {  // within the corner itself, on either side of the path
      emit_window(v, h, whole, begin, std::min(end, angle - kShadow));
      emit_window(v, h, whole, std::max(begin, angle + kShadow), end);
    }
  }
}

/// A shortest path that bends at v has an angle of at least pi on both sides. Emits windows where that is so, in the
/// umbrella of the corner where the path arrives; returns how many corners it has, and leaves them in umbrella_.
std::size_t WindowEmission::emit_shadow_windows(std::int32_t v, std::int32_t arrival, double angle) {
  umbrella_.clear();
  double turned = -angle;
  std::int32_t h = arrival;
  do {
    umbrella_.push_back({h, mesh_.angle(h)});
    turned += umbrella_.back().angle;
    h = mesh_.half_edge(h).left;
  } while (h >= 0 && h != arrival);
  const double shadow_end = h == arrival ? turned + angle - kShadow : kInfinity;
  turned = -angle;
  for (const auto& [corner, whole] : umbrella_) {
    emit_window(v, corner, whole, kShadow - turned, shadow_end - turned);
    turned += whole;
  }
  if (h == arrival) return umbrella_.size();
  // An open umbrella: the other way round to its other end.
  turned = angle;
  for (h = mesh_.twin(arrival); h >= 0; h = mesh_.twin(h)) {
    h = next_in_face(h);
    const double whole = mesh_.angle(h);
    umbrella_.push_back({h, whole});
    emit_window(v, h, whole, -1.0, whole - (kShadow - turned));
    turned += whole;
  }
  return umbrella_.size();
}

/// Emits a window from v over the corner between h and the edge on its left, whose angle is `whole`, for the directions
/// from `begin` to `end`, as angles from h.
void WindowEmission::emit_window(std::int32_t v, std::int32_t h, double whole, double begin, double end) {
  if (!(begin < end) || end <= 0 || begin >= whole) return;
  const HalfEdge edge = mesh_.half_edge(h);
  const std::int32_t opposite = next_in_face(h);
  if (edge.right < 0 && mesh_.sibling(opposite) < 0) return;
  const double cosine = (edge.length - edge.apex_x) / edge.right_length;
  const double sine = -edge.apex_y / edge.right_length;
  const double x = -edge.apex_x * cosine - edge.apex_y * sine, y = edge.apex_x * sine - edge.apex_y * cosine;
  if (!(y < 0)) return;
  // Where the line from v in a direction meets the opposite edge, from its tip (the apex here).
  const double length = edge.right_length;
  const auto meets = [&](double direction) {
    const double dx = std::cos(direction), dy = std::sin(direction);
    const double rx = dx * cosine + dy * sine, ry = dy * cosine - dx * sine;
    return ry > 0 ? std::clamp(x - y * rx / ry, 0.0, length) : rx < 0 ? 0.0 : length;
  };
  const double b0 = end < whole ? meets(end) : 0.0;
  const double b1 = begin > 0 ? meets(begin) : length;
  if (!(b1 - b0 > kLeastWidth * length)) return;
  if (edge.right >= 0) {
    front_.add_window(edge.right, b0, b1, {x, y}, front_.distance(v), v);
    return;
  }
  const std::int32_t source = front_.crossing(opposite, v);
  mesh_.for_each_beyond(opposite, [&](std::int32_t entered) {
    if (mesh_.is_mirrored(opposite, entered)) {
      front_.add_window(entered, length - b1, length - b0, {length - x, y}, front_.distance(v), source);
    } else {
      front_.add_window(entered, b0, b1, {x, y}, front_.distance(v), source);
    }
  });
}

void WindowEmission::begin_at(std::int32_t k) {
  const PlacedPoint& source = sources_[k];
  if (source.vertex >= 0) {
    front_.relax(source.vertex, 0.0, {});
    return;
  }
  const std::int32_t number = static_cast<std::int32_t>(mesh_.vertex_count()) + k;
  source.for_each_corner(mesh_, [&](std::int32_t h, const Point2& p, double straight) {
    front_.relax(mesh_.half_edge(h).apex, straight, {.x = p.x, .y = p.y, .half_edge = h, .source = number});
  });
  source.for_each_exit(mesh_, [&](std::int32_t h, const Point2& p, std::int32_t left) {
    front_.add_window(h, 0.0, mesh_.half_edge(h).length, p, 0.0,
                      mesh_.sibling(left) < 0 ? number : front_.crossing(left, number));
  });
}

bool WindowEmission::is_source(std::int32_t v) const {
  const TraceRecord& record = front_.record(v);
  return record.half_edge == TraceRecord::kNone || is_next_to_source(v, record);
}
/// A path from a point that close to a corner is as long over the corner, up to rounding, in directions in which it
/// may be dropped for that. So the corner emits windows too, all around.
bool WindowEmission::is_next_to_source(std::int32_t v, const TraceRecord& record) const {
  return record.half_edge >= 0 && record.y >= 0 &&
         front_.distance(v) < kNextToCorner * mesh_.half_edge(record.half_edge).left_length;
}

}  // namespace seamwire::detail
