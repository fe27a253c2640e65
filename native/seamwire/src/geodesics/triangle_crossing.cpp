// SPDX-License-Identifier: GPL-3.0-or-later
#include "geodesics/triangle_crossing.hpp"

#include <algorithm>

#include "detail/index.hpp"
#include "detail/prefetch.hpp"

namespace seamwire::detail {
namespace {

using HalfEdge = GeodesicMesh::HalfEdge;

/// Writes those that are alive, `made` of `count`, side by side.
SEAMWIRE_INLINE void hand_on(const Windows& from, const ChildWindows& children, std::size_t count, std::size_t made,
                             const Windows& to) {
  if (made == count) {
    copy({children.b0, children.b1, children.x, children.y, from.distance, from.source}, count, to);
    return;
  }
  std::size_t written = 0;
  for (std::size_t i = 0; written < made; ++i) {
    to.set(written, children.b0[i], children.b1[i], children.x[i], children.y[i], from.distance[i], from.source[i]);
    written += static_cast<std::size_t>(children.alive[i]);
  }
}

}  // namespace

/// Finds the apex projections, the shortest path to the apex, along a side or through a window, and the split.
inline TriangleCrossing::ApexPath TriangleCrossing::find_apex_path(Crossing& c) {
  const HalfEdge& edge = c.edge;
  ApexPath best{.distance = c.at_tail + edge.left_length,
                .record = {.x = edge.left_length, .half_edge = ~previous_in_face(c.half_edge), .source = edge.tail},
                .window = 0};
  if (const double over_tip = c.at_tip + edge.right_length; over_tip < best.distance) {
    best = {.distance = over_tip,
            .record = {.x = edge.right_length, .half_edge = ~next_in_face(c.half_edge), .source = edge.tip},
            .window = std::max<std::size_t>(c.count, 1) - 1};
    c.split = edge.length;
  }
  double* projections = projections_.room_for(c.count);
  double* apex_distances = apex_distances_.room_for(c.count);
  kernels_.find_apex_distances(c.windows, c.count, {edge.length, edge.apex_x, edge.apex_y}, projections,
                               apex_distances);
  c.projections = projections;
  bool is_window = false;
  for (std::size_t i = 0; i < c.count; ++i) {
    if (apex_distances[i] < best.distance) [[unlikely]] {
      best.distance = apex_distances[i];
      best.window = i;
      is_window = true;
    }
  }
  if (is_window) {
    const std::size_t i = best.window;
    const Windows& w = c.windows;
    c.split = std::clamp(projections[i], w.b0[i], w.b1[i]);
    best.record = {.x = w.x[i], .y = w.y[i], .half_edge = c.half_edge, .source = w.source[i]};
  }
  return best;
}

/// Keeps windows_kept_ windows around one, the outer two stretched over what the others covered.
void TriangleCrossing::keep_around(std::size_t window, Crossing& c) const {
  const std::size_t before = window > windows_kept_ / 2 ? window - windows_kept_ / 2 : 0;
  const std::size_t first = std::min(before, c.count - windows_kept_), last = first + windows_kept_ - 1;
  const Windows& w = c.windows;
  w.b0[first] = std::min(w.b0[first], w.b0[0]);
  w.b1[last] = std::max(w.b1[last], w.b1[c.count - 1]);
  c.windows = w + first;
  c.projections += first;
  c.count = windows_kept_;
}

/// Hands windows on over the left or the right side of the triangle. The distance of the apex must be known.
template <bool is_left>
inline void TriangleCrossing::cross_side(const Crossing& c) {
  const HalfEdge& edge = c.edge;
  const std::int32_t entered = is_left ? edge.left : edge.right;
  const std::int32_t left = is_left ? previous_in_face(c.half_edge) : next_in_face(c.half_edge);
  if (entered < 0 && mesh_.sibling(left) < 0) return;
  if (!(is_left ? c.split > 0 : c.split < edge.length)) return;
  // Windows behind the split and behind the apex projection do not reach the side; at the far end they are many.
  std::size_t begin = 0, end = c.count;
  if constexpr (is_left) {
    while (end > 0 && !(c.windows.b0[end - 1] < std::min(c.split, c.projections[end - 1]))) --end;
  } else {
    while (begin < end && !(c.windows.b1[begin] > std::max(c.split, c.projections[begin]))) ++begin;
  }
  const Windows windows = c.windows + begin;
  const double* projections = c.projections + begin;
  const std::size_t count = end - begin, stride = c.count + kPadding;
  const ChildWindows children =
      ChildWindows::in(children_.room_for(ChildWindows::kColumns * stride), stride, flags_.room_for(c.count));
  // The left side runs from the base's tail to the apex, the right one from the apex to the base's tip.
  const std::int32_t tail = is_left ? edge.tail : edge.apex, tip = is_left ? edge.apex : edge.tip;
  const double length = is_left ? edge.left_length : edge.right_length;
  const Side side{.length = length,
                  .cosine = (is_left ? edge.apex_x : edge.length - edge.apex_x) / length,
                  .sine = (is_left ? edge.apex_y : -edge.apex_y) / length,
                  .at_tail = is_left ? c.at_tail : front_.distance(edge.apex),
                  .at_tip = is_left ? front_.distance(edge.apex) : c.at_tip};
  std::size_t made = 0;
  if constexpr (is_left) {
    made = kernels_.to_left(windows, count, projections, c.split, side, children);
  } else {
    const BaseTriangle triangle{edge.length, edge.apex_x, edge.apex_y};
    made = kernels_.to_right(windows, count, projections, c.split, triangle, side, children);
  }
  if (made == 0) return;
  if (entered < 0) {
    hand_on_to_siblings(windows, children, count, left, length);
    return;
  }
  // In the list of the half-edge that they enter, these come before those from the other triangle, or after them.
  WindowList& list = front_.list(entered);
  if constexpr (is_left) {
    hand_on(windows, children, count, made, list.reserve_front(made, front_.blocks()) - made);
    list.grew_front(made);
  } else {
    hand_on(windows, children, count, made, list.reserve_back(made, front_.blocks()));
    list.grew_back(made);
  }
  front_.queue_list(entered, tail, tip);
}

/// Hands on those of `count` windows that are alive, to each half-edge of the edge but `left`, which they leave over.
void TriangleCrossing::hand_on_to_siblings(const Windows& from, const ChildWindows& children, std::size_t count,
                                           std::int32_t left, double length) {
  for (std::size_t i = 0; i < count; ++i) {
    if (children.alive[i] == 0) continue;
    const std::int32_t source = front_.crossing(left, from.source[i]);
    const double b0 = children.b0[i], b1 = children.b1[i], x = children.x[i], y = children.y[i];
    mesh_.for_each_beyond(left, [&](std::int32_t entered) {
      if (mesh_.is_mirrored(left, entered)) {
        front_.add_window(entered, length - b1, length - b0, {length - x, y}, from.distance[i], source);
      } else {
        front_.add_window(entered, b0, b1, {x, y}, from.distance[i], source);
      }
    });
  }
}

void TriangleCrossing::propagate(std::int32_t h) {
  const HalfEdge edge = mesh_.half_edge(h);
  const WindowList list = front_.take(h);
  if (edge.left >= 0) prefetch(&front_.list(edge.left));
  if (edge.right >= 0) prefetch(&front_.list(edge.right));
  front_.count(list.size);
  Crossing crossing{.half_edge = h,
                    .edge = edge,
                    .at_tail = front_.distance(edge.tail),
                    .at_tip = front_.distance(edge.tip),
                    .windows = list.windows(),
                    .count = 0};
  crossing.count = pruning_.prune(crossing.windows, list.size, edge.length);
  if (mesh_.sibling(h) >= 0) crossing.count = pruning_.prune_all(crossing.windows, crossing.count, edge.length);
  const ApexPath path = find_apex_path(crossing);
  if (windows_kept_ > 0 && crossing.count > windows_kept_) keep_around(path.window, crossing);
  front_.relax(edge.apex, path.distance, path.record);
  cross_side<true>(crossing);
  cross_side<false>(crossing);
  front_.blocks().give_back(list.block);
}

}  // namespace seamwire::detail
