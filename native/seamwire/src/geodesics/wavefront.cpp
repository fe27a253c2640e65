// SPDX-License-Identifier: GPL-3.0-or-later
//
// The triangle-oriented wavefront (Qin, Han, Yu, Yu, Zhang, "Fast and Exact Discrete Geodesic Computation Based on
// Triangle-Oriented Wavefront Propagation", 2016). The window filter is by Xin, Wang, "Improving Chen and Han's
// Algorithm on the Discrete Geodesic Problem" (2009).
//
// A window says: through the interval [b0, b1] of this half-edge the source (x, y) is seen in a straight line, when the
// triangles in between are unfolded. The front carries lists of windows from triangle to triangle, vertex by vertex in
// the order of their distance. A shortest path may bend at pseudo-sources only (GeodesicMesh::is_pseudo_source), which
// emit windows themselves, and so do sources, vertices and points in faces. Windows that no shortest path can come
// through are dropped. The remaining windows may overlap, because only neighbors in a list are compared, and only on
// the edge itself. Sources emit windows (window_emission), lists are sorted and pruned (window_pruning) and cross
// triangles (triangle_crossing). The arithmetic is in window_kernels.
//
// A path through what is dropped is longer than another path, or as long up to rounding. In the latter case a sliver
// may be lost, next to a path of the same length.
//
// Over an edge with siblings (IntrinsicMesh::siblings) windows go on into every other face at it. None of the rules
// depends on the number of faces below a list's edge. The filter and the comparison of neighbors look only at points of
// that edge. The rule "one angle, two sides" looks only at paths within the triangle above it. A ray that crosses the
// shortest path to the apex there is no shorter behind the crossing, wherever the two come from. A list is sorted
// before its windows are compared, so they may arrive in any order.
#include "geodesics/wavefront.hpp"

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

#include "detail/index.hpp"
#include "detail/infinity.hpp"
#include "detail/prefetch.hpp"
#include "geodesics/front.hpp"
#include "geodesics/triangle_crossing.hpp"
#include "geodesics/window_emission.hpp"

namespace seamwire::detail {
namespace {

using HalfEdge = GeodesicMesh::HalfEdge;

/// A distance that an edge makes shorter by more than this is not rounding.
constexpr double kLate = 1.0 + 1e-9;

/// Half-edges of the next vertex that memory is asked for in advance. A vertex may stay the next one for long.
constexpr std::size_t kMostPrefetched = 16;

class Wavefront {
 public:
  Wavefront(const GeodesicMesh& mesh, const SourcePoints& sources, const WavefrontOptions& options, const Task& task)
      : mesh_(mesh),
        task_(task),
        sources_(sources),
        options_(options),
        front_(mesh, sources.points().size(), task),
        emission_(front_, sources),
        crossing_(front_, options.windows_kept) {}

  WavefrontResult run() {
    task_.check(0.0);
    const bool may_stop = std::isfinite(options_.max_distance) || !options_.targets.empty();
    if (may_stop) longest_edge_ = longest_edge();
    for (std::int32_t k = 0; index(k) < sources_.points().size(); ++k) emission_.begin_at(k);
    while (!front_.queue().empty() || relax_left_out()) {
      if (may_stop && is_done(front_.queue().least_key())) break;
      const std::int32_t v = front_.queue().pop();
      std::span<const std::int32_t> next;
      if (!front_.queue().empty()) next = mesh_.out(front_.queue().least());
      next = next.first(std::min(next.size(), kMostPrefetched));
      prefetch(next.data());
      expand_vertex(v);
      for (const std::int32_t h : next) mesh_.prefetch_half_edge(h);
      propagate_ready_lists();
    }
    if (may_stop) forget_beyond(std::min(front_.result().radius, options_.max_distance));
    task_.check(1.0);
    return std::move(front_.result());
  }

 private:
  /// Where triangles are so thin that rounding decides, windows may be lost, and a vertex be reached late or not at
  /// all. Then it is reached along an edge. Returns whether the front goes on from there.
  bool relax_left_out() {
    bool is_any = true;
    while (is_any && front_.queue().empty()) {
      is_any = false;
      for (std::size_t h = 0; h < mesh_.half_edge_count(); ++h) {
        front_.check_task(1);
        const HalfEdge edge = mesh_.half_edge(static_cast<std::int32_t>(h));
        const double tail = front_.distance(edge.tail), tip = front_.distance(edge.tip);
        const bool is_tip_late = (tail + edge.length) * kLate < tip, is_tail_late = (tip + edge.length) * kLate < tail;
        if (!is_tip_late && !is_tail_late) [[likely]]
          continue;
        is_any = true;
        front_.relax_neighbors(is_tip_late ? edge.tail : edge.tip);
      }
      emit_again();
      propagate_ready_lists();
    }
    return !front_.queue().empty();
  }

  double longest_edge() const {
    double longest = 0.0;
    for (std::size_t h = 0; h < mesh_.half_edge_count(); ++h) {
      longest = std::max(longest, mesh_.half_edge(static_cast<std::int32_t>(h)).length);
    }
    return longest;
  }

  /// Whether what is to be reached has its final distance, when `next` is the least distance on the front. A window
  /// that waits does so on an edge whose ends the front has not passed, and both are reached at its distance at most,
  /// and along the edge. So whatever may still come is not nearer than `next`, less an edge.
  bool is_done(double next) {
    constexpr double kRounding = 1e-12;
    const double final = next - longest_edge_ - kRounding * next;
    if (final > options_.max_distance) {
      front_.result().radius = options_.max_distance;
      return true;
    }
    if (options_.targets.empty()) return false;
    while (targets_done_ < options_.targets.size() && upper_bound(options_.targets[targets_done_]) <= final)
      ++targets_done_;
    if (targets_done_ < options_.targets.size()) return false;
    front_.result().radius = final;
    return true;
  }

  /// Of the distance of a point: over the corners of its faces.
  double upper_bound(const PlacedPoint& point) const {
    if (point.vertex >= 0) return front_.distance(point.vertex);
    double bound = kInfinity;
    point.for_each_corner(mesh_, [&](std::int32_t h, const Point2&, double straight) {
      bound = std::min(bound, front_.distance(mesh_.half_edge(h).apex) + straight);
    });
    return bound;
  }

  void forget_beyond(double radius) {
    front_.result().radius = radius;
    for (std::size_t v = 0; v < front_.result().distances.size(); ++v) {
      if (front_.result().distances[v] <= radius) continue;
      front_.result().distances[v] = kInfinity;
      front_.result().records[v] = {};
    }
  }

  /// The front passes the vertex v.
  void expand_vertex(std::int32_t v) {
    front_.pass(v);
    if (mesh_.is_pseudo_source(v) || emission_.is_source(v)) {
      emission_.emit(v);
    } else if (options_.windows_kept > 0) {
      front_.relax_neighbors(v);  // stretched windows need not cover everything; this bounds what is lost
    }
    for (const std::int32_t h : mesh_.out(v)) {
      front_.make_ready(h);
      front_.make_ready(previous_in_face(h));
      front_.make_ready(next_in_face(h));
      if (const std::int32_t opposite = mesh_.half_edge(h).right; opposite >= 0) {
        front_.make_ready_beyond(opposite);
      } else {
        mesh_.for_each_beyond(next_in_face(h), [&](std::int32_t sibling) { front_.make_ready_beyond(sibling); });
      }
    }
  }
  /// First in, first out: a list that comes later has gathered more windows, and finds better distances.
  ///
  /// They come in layers: the windows of a layer's lists crossed one triangle more than those of the layer before. No
  /// shortest path crosses a triangle twice, so after as many layers as there are triangles, what is left is not
  /// needed. Where one triangle is far longer than all others, what circles around a needle is no longer than what
  /// goes straight, up to rounding, and would not end before.
  void propagate_ready_lists() {
    std::vector<std::int32_t>& ready = front_.ready_lists();
    std::size_t layer_end = ready.size(), layers_left = mesh_.half_edge_count() / 3;
    for (std::size_t i = 0; i < ready.size(); ++i) {
      const std::int32_t h = ready[i];
      if (i == layer_end) {
        layer_end = ready.size();
        --layers_left;
      }
      if (layers_left == 0) {
        front_.drop(h);
        continue;
      }
      front_.begin(h);
      crossing_.propagate(h);
      emit_again();
    }
    ready.clear();
  }
  /// Nearest first, so that of sources that lie behind each other each emits once. In another order many sources may
  /// relax the same source in turn, and it would then relax all sources behind it each time.
  void emit_again() {
    while (!front_.improved_sources().empty()) {
      const std::int32_t v = front_.improved_sources().pop();
      emission_.emit(v);
      front_.check_task(mesh_.out(v).size() + mesh_.loose(v).size());
    }
  }

  const GeodesicMesh& mesh_;
  const Task& task_;
  const SourcePoints& sources_;
  const WavefrontOptions& options_;
  double longest_edge_ = 0.0;     ///< known where the front may stop
  std::size_t targets_done_ = 0;  ///< of the targets, so many have their final distances
  Front front_;
  WindowEmission emission_;
  TriangleCrossing crossing_;
};

}  // namespace

WavefrontResult propagate_wavefront(const GeodesicMesh& mesh, const SourcePoints& sources,
                                    const WavefrontOptions& options, const Task& task) {
  return Wavefront(mesh, sources, options, task).run();
}

}  // namespace seamwire::detail
