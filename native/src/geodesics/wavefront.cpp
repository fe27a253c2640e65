// SPDX-License-Identifier: GPL-3.0-or-later
//
// The triangle-oriented wavefront of Qin, Han, Yu, Yu, Zhang, "Fast and Exact Discrete Geodesic Computation Based on
// Triangle-Oriented Wavefront Propagation" (2016), with the window filter of Xin, Wang, "Improving Chen and Han's
// Algorithm on the Discrete Geodesic Problem" (2009).
//
// A window says: through the interval [b0, b1] of this half-edge the source (x, y) is seen in a straight line, when the
// triangles in between are unfolded. The front carries lists of windows from triangle to triangle, vertex by vertex in
// the order of their distance. A shortest path may bend at pseudo-sources only (GeodesicMesh::is_pseudo_source), which
// emit windows themselves, and so do sources, vertices and points in faces. Windows that no shortest path can come
// through are dropped. Those that stay may overlap: only neighbors in a list are compared, and only on the edge itself.
// The arithmetic is in window_kernels.
//
// A path through what is dropped is longer than another path, or as long up to rounding. In the latter case a sliver
// may be lost, next to a path of the same length.
//
// Over an edge with siblings (IntrinsicMesh::siblings) windows go on into every other face at it. None of the rules
// depends on the number of faces below a list's edge. The filter and the comparison of neighbors look only at points of
// that edge. "One angle, two sides" looks only at paths within the triangle above it: a ray that crosses the shortest
// path to the apex there is no shorter behind the crossing, wherever the two come from. A list is sorted before its
// windows are compared, so they may arrive in any order.
#include "geodesics/wavefront.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <span>
#include <unordered_map>
#include <utility>

#include "detail/index.hpp"
#include "detail/indexed_heap.hpp"
#include "detail/poll.hpp"
#include "detail/prefetch.hpp"
#include "geodesics/corner_angles.hpp"
#include "geodesics/window_kernels.hpp"
#include "geodesics/window_lists.hpp"

namespace seamwire::detail {
namespace {

using HalfEdge = GeodesicMesh::HalfEdge;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// A path arrives at a vertex in a direction known up to this angle: ties, and gains too small to count, are within it.
constexpr double kShadowMargin = 1e-3;
constexpr double kShadow = std::numbers::pi - kShadowMargin;
/// A source whose distance falls by less than this part of it does not emit windows again: that is rounding.
constexpr double kLeastGain = 1e-13;
/// A distance that an edge makes shorter by more than this is not rounding.
constexpr double kLate = 1.0 + 1e-9;
/// A source is next to a corner of its face below this part of a side.
constexpr double kNextToCorner = 1e-2;
/// Windows (a list counts as some) between two looks at the task: a fraction of a millisecond.
constexpr std::size_t kWorkBetweenChecks = 8192;
constexpr std::size_t kWorkOfAList = 8;

/// Of a vertex: not reached, reached, passed by the front.
enum class Status : std::uint8_t { kUnreached, kOnFront, kPassed };
/// Of a half-edge's list: it has no windows; its windows wait for the front; it is one of ready_lists_.
enum class ListState : std::uint8_t { kEmpty, kWaiting, kReady };

class Wavefront {
 public:
  Wavefront(const GeodesicMesh& mesh, const SourcePoints& sources, const Task& task, std::uint32_t windows_kept,
            const WavefrontEnd& end)
      : mesh_(mesh),
        task_(task),
        sources_(sources),
        end_(end),
        windows_kept_(windows_kept),
        status_(mesh.vertex_count(), Status::kUnreached),
        queue_(mesh.vertex_count()),
        list_state_(mesh.half_edge_count(), ListState::kEmpty),
        improved_sources_(mesh.vertex_count()) {
    result_.distances.assign(mesh.vertex_count(), kInfinity);
    resize(result_.records, mesh.vertex_count(), task, 0.0);
    resize(lists_, mesh.half_edge_count(), task, 0.0);
  }

  WavefrontResult run() {
    task_.check(0.0);
    const bool may_stop = std::isfinite(end_.max_distance) || !end_.targets.empty();
    if (may_stop) longest_edge_ = longest_edge();
    for (std::int32_t k = 0; index(k) < sources_.points().size(); ++k) emit_source(k);
    while (!queue_.empty() || relax_left_out()) {
      if (may_stop && is_done(queue_.least_key())) break;
      const std::int32_t v = queue_.pop();
      const auto next = queue_.empty() ? std::span<const std::int32_t>() : mesh_.out(queue_.least());
      prefetch(next.data());
      expand_vertex(v);
      ++vertices_done_;
      for (const std::int32_t h : next) prefetch(&mesh_.half_edge(h));
      propagate_ready_lists();
    }
    if (may_stop) forget_beyond(std::min(result_.radius, end_.max_distance));
    task_.check(1.0);
    return std::move(result_);
  }

 private:
  double distance(std::int32_t v) const { return result_.distances[v]; }
  /// Of a vertex that the front has reached.
  bool is_source(std::int32_t v) const {
    const TraceRecord& record = result_.records[v];
    return record.half_edge == TraceRecord::kNone || is_next_to_source(v, record);
  }
  /// A path from a point that close to a corner is as long over the corner, up to rounding, in directions in which it
  /// may be dropped for that. So the corner emits windows too, all around.
  bool is_next_to_source(std::int32_t v, const TraceRecord& record) const {
    return record.half_edge >= 0 && record.y >= 0 &&
           distance(v) < kNextToCorner * mesh_.half_edge(record.half_edge).left_length;
  }

  /// Where triangles are so thin that rounding decides, windows may be lost, and a vertex be reached late or not at
  /// all. Then it is reached along an edge. Returns whether the front goes on from there.
  bool relax_left_out() {
    bool is_any = true;
    while (is_any && queue_.empty()) {
      is_any = false;
      for (std::size_t h = 0; h < mesh_.half_edge_count(); ++h) {
        check_task(1);
        const HalfEdge& edge = mesh_.half_edge(static_cast<std::int32_t>(h));
        const double tail = distance(edge.tail), tip = distance(edge.tip);
        const bool is_tip_late = (tail + edge.length) * kLate < tip, is_tail_late = (tip + edge.length) * kLate < tail;
        if (!is_tip_late && !is_tail_late) [[likely]]
          continue;
        is_any = true;
        relax_neighbors(is_tip_late ? edge.tail : edge.tip);
      }
      emit_again();
      propagate_ready_lists();
    }
    return !queue_.empty();
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
    if (final > end_.max_distance) {
      result_.radius = end_.max_distance;
      return true;
    }
    if (end_.targets.empty()) return false;
    while (targets_done_ < end_.targets.size() && upper_bound(end_.targets[targets_done_]) <= final) ++targets_done_;
    if (targets_done_ < end_.targets.size()) return false;
    result_.radius = final;
    return true;
  }

  /// Of the distance of a point: over the corners of its faces.
  double upper_bound(const PlacedPoint& point) const {
    if (point.vertex >= 0) return distance(point.vertex);
    double bound = kInfinity;
    point.for_each_corner(mesh_, [&](std::int32_t h, const Point2&, double straight) {
      bound = std::min(bound, distance(mesh_.half_edge(h).apex) + straight);
    });
    return bound;
  }

  void forget_beyond(double radius) {
    result_.radius = radius;
    for (std::size_t v = 0; v < result_.distances.size(); ++v) {
      if (result_.distances[v] <= radius) continue;
      result_.distances[v] = kInfinity;
      result_.records[v] = {};
    }
  }

  /// Begins at source k. From a point in a face paths run straight to its corners, and over its edges.
  void emit_source(std::int32_t k) {
    const PlacedPoint& source = sources_[k];
    if (source.vertex >= 0) {
      relax(source.vertex, 0.0, {});
      return;
    }
    const std::int32_t number = static_cast<std::int32_t>(mesh_.vertex_count()) + k;
    source.for_each_corner(mesh_, [&](std::int32_t h, const Point2& p, double straight) {
      relax(mesh_.half_edge(h).apex, straight, {.x = p.x, .y = p.y, .half_edge = h, .source = number});
    });
    source.for_each_exit(mesh_, [&](std::int32_t h, const Point2& p, std::int32_t left) {
      add_window(h, 0.0, mesh_.half_edge(h).length, p, 0.0, mesh_.sibling(left) < 0 ? number : crossing(left, number));
    });
  }

  /// Adds a window to the list of h.
  void add_window(std::int32_t h, double b0, double b1, const Point2& from, double distance, std::int32_t source) {
    const HalfEdge& edge = mesh_.half_edge(h);
    WindowList& list = lists_[h];
    list.reserve_back(1, blocks_).set(0, b0, b1, from.x, from.y, distance, source);
    list.grew_back(1);
    queue_list(h, edge.tail, edge.tip);
  }

  /// The name of a source for windows that leave a face over the half-edge `left`, which has siblings.
  std::int32_t crossing(std::int32_t left, std::int32_t source) {
    const auto key = static_cast<std::uint64_t>(left) << 32U | static_cast<std::uint32_t>(source);
    const std::size_t first = mesh_.vertex_count() + sources_.points().size();
    const auto next = static_cast<std::int32_t>(first + result_.crossings.size());
    const auto [entry, is_new] = crossings_.try_emplace(key, next);
    if (is_new) result_.crossings.push_back({left, source});
    return entry->second;
  }

  /// A path to v was found; keeps it if it is shorter than what is known.
  void relax(std::int32_t v, double distance, const TraceRecord& record) {
    const double before = result_.distances[v];
    if (!(distance < before)) return;
    result_.distances[v] = distance;
    result_.records[v] = record;
    if (status_[v] != Status::kPassed) {
      status_[v] = Status::kOnFront;
      queue_.lower(v, distance);
    } else if (mesh_.is_pseudo_source(v) && distance < before * (1 - kLeastGain)) {
      improved_sources_.lower(v, distance);
    }
  }

  /// The front passes the vertex v.
  void expand_vertex(std::int32_t v) {
    status_[v] = Status::kPassed;
    const auto leaving = mesh_.out(v);
    for (const std::int32_t h : leaving) {
      const HalfEdge& edge = mesh_.half_edge(h);
      if (status_[edge.tip] == Status::kUnreached) status_[edge.tip] = Status::kOnFront;
      if (status_[edge.apex] == Status::kUnreached) status_[edge.apex] = Status::kOnFront;
    }
    if (mesh_.is_pseudo_source(v) || is_source(v)) {
      emit_windows(v);
    } else if (windows_kept_ > 0) {
      relax_neighbors(v);  // stretched windows need not cover everything; this bounds what is lost
    }
    for (const std::int32_t h : leaving) {
      make_ready(h);
      make_ready(previous_in_face(h));
      make_ready(next_in_face(h));
      if (const std::int32_t opposite = mesh_.half_edge(h).right; opposite >= 0) {
        make_ready_beyond(opposite);
      } else {
        mesh_.for_each_beyond(next_in_face(h), [&](std::int32_t sibling) { make_ready_beyond(sibling); });
      }
    }
  }
  /// Lets the list of h go on if it waits and the apex of h is reached. The front passes a vertex opposite to h.
  void make_ready_beyond(std::int32_t h) {
    if (list_state_[h] != ListState::kWaiting) return;
    if (status_[mesh_.half_edge(h).apex] != Status::kUnreached) make_ready(h);
  }

  /// Relaxes the ends of the edges at v.
  void relax_neighbors(std::int32_t v) {
    const double from = distance(v);
    mesh_.for_each_edge(v, [&](std::int32_t to, std::int32_t h, double length) {
      relax(to, from + length, {.x = length, .half_edge = h < 0 ? TraceRecord::kLooseEdge : ~h, .source = v});
    });
  }

  /// Emits windows from v, a source: paths run from it along its edges, and straight over its triangles.
  void emit_windows(std::int32_t v) {
    relax_neighbors(v);
    const auto [arrival, angle] = arrival_at(v);
    if (arrival >= 0 && mesh_.is_branching(v)) {
      emit_shadow_windows_branching(v, arrival, angle);
      return;
    }
    std::size_t corners = 0;
    if (arrival >= 0) corners = emit_shadow_windows(v, arrival, angle);
    if (corners == mesh_.out(v).size()) return;
    // All of the umbrellas that the path did not arrive in can be seen from v.
    for (const std::int32_t h : mesh_.out(v)) {
      if (corners == 0 || std::find(umbrella_.begin(), umbrella_.end(), h) == umbrella_.end()) {
        emit_window(v, h, 0.0, mesh_.angle(h));
      }
    }
  }

  /// The corner in which the shortest path arrives at v, named by the half-edge that leaves v there, and its angle from
  /// that half-edge; -1 at a source and where it comes along a loose edge.
  std::pair<std::int32_t, double> arrival_at(std::int32_t v) const {
    const TraceRecord& record = result_.records[v];
    if (is_next_to_source(v, record)) return {-1, 0.0};
    if (record.half_edge >= 0) {
      const HalfEdge& edge = mesh_.half_edge(record.half_edge);
      const double x = record.x - edge.apex_x, y = record.y - edge.apex_y;
      const double turn = std::atan2(edge.apex_y * x - edge.apex_x * y, -edge.apex_x * x - edge.apex_y * y);
      const std::int32_t corner = previous_in_face(record.half_edge);
      return {corner, std::clamp(turn, 0.0, mesh_.angle(corner))};
    }
    if (record.half_edge == TraceRecord::kNone || record.half_edge == TraceRecord::kLooseEdge) return {-1, 0.0};
    const std::int32_t along = ~record.half_edge;
    const HalfEdge& edge = mesh_.half_edge(along);
    if (edge.tail == edge.tip) return {-1, 0.0};
    if (edge.tail == v) return {along, 0.0};
    return {next_in_face(along), mesh_.angle(next_in_face(along))};
  }

  /// A shortest path that bends at v has an angle of at least pi on every way around v. Emits windows where that is so,
  /// at a vertex whose umbrellas meet at edges with siblings.
  void emit_shadow_windows_branching(std::int32_t v, std::int32_t arrival, double angle) {
    for (const CornerAngles& corner : angles_around(mesh_, v, arrival, angle)) {
      const std::int32_t h = corner.half_edge;
      const double begin = kShadow - corner.at_right, end = mesh_.angle(h) - (kShadow - corner.at_left);
      if (h != arrival) {
        emit_window(v, h, begin, end);
      } else {  // within the corner itself, on either side of the path
        emit_window(v, h, begin, std::min(end, angle - kShadow));
        emit_window(v, h, std::max(begin, angle + kShadow), end);
      }
    }
  }

  /// A shortest path that bends at v has an angle of at least pi on both sides. Emits windows where that is so, in the
  /// umbrella of the corner where the path arrives; returns how many corners it has, and leaves them in umbrella_.
  std::size_t emit_shadow_windows(std::int32_t v, std::int32_t arrival, double angle) {
    umbrella_.clear();
    double turned = -angle;
    std::int32_t h = arrival;
    do {
      umbrella_.push_back(h);
      turned += mesh_.angle(h);
      h = mesh_.half_edge(h).left;
    } while (h >= 0 && h != arrival);
    const double shadow_end = h == arrival ? turned + angle - kShadow : std::numeric_limits<double>::infinity();
    turned = -angle;
    for (const std::int32_t corner : umbrella_) {
      emit_window(v, corner, kShadow - turned, shadow_end - turned);
      turned += mesh_.angle(corner);
    }
    if (h == arrival) return umbrella_.size();
    // An open umbrella: the other way round to its other end.
    turned = angle;
    for (h = mesh_.twin(arrival); h >= 0; h = mesh_.twin(h)) {
      h = next_in_face(h);
      umbrella_.push_back(h);
      const double whole = mesh_.angle(h);
      emit_window(v, h, -1.0, whole - (kShadow - turned));
      turned += whole;
    }
    return umbrella_.size();
  }

  /// Emits a window from v over the corner between h and the edge on its left, for the directions from `begin` to
  /// `end`, as angles from h.
  void emit_window(std::int32_t v, std::int32_t h, double begin, double end) {
    if (!(begin < end) || end <= 0 || begin >= mesh_.angle(h)) return;
    const HalfEdge& edge = mesh_.half_edge(h);
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
    const double b0 = end < mesh_.angle(h) ? meets(end) : 0.0;
    const double b1 = begin > 0 ? meets(begin) : length;
    if (!(b1 - b0 > kLeastWidth * length)) return;
    if (edge.right >= 0) {
      add_window(edge.right, b0, b1, {x, y}, distance(v), v);
      return;
    }
    const std::int32_t source = crossing(opposite, v);
    mesh_.for_each_beyond(opposite, [&](std::int32_t entered) {
      if (mesh_.is_mirrored(opposite, entered)) {
        add_window(entered, length - b1, length - b0, {length - x, y}, distance(v), source);
      } else {
        add_window(entered, b0, b1, {x, y}, distance(v), source);
      }
    });
  }

  void make_ready(std::int32_t h) {
    if (list_state_[h] != ListState::kWaiting) return;
    list_state_[h] = ListState::kReady;
    ready_lists_.push_back(h);
    prefetch(&mesh_.half_edge(h));
    prefetch(&lists_[h]);
  }
  /// The list of h, from tail to tip, has got windows. It is ready to be propagated as soon as the front has passed an
  /// end of its edge; until then it waits for more windows.
  void queue_list(std::int32_t h, std::int32_t tail, std::int32_t tip) {
    if (list_state_[h] == ListState::kEmpty) list_state_[h] = ListState::kWaiting;
    if (status_[tail] == Status::kPassed || status_[tip] == Status::kPassed) make_ready(h);
  }

  /// First in, first out: a list that comes later has gathered more windows, and finds better distances.
  ///
  /// They come in layers: the windows of a layer's lists crossed one triangle more than those of the layer before. No
  /// shortest path crosses a triangle twice, so after as many layers as there are triangles, what is left is not
  /// needed. Where one triangle is far longer than all others, what circles around a needle is no longer than what
  /// goes straight, up to rounding, and would not end before.
  void propagate_ready_lists() {
    std::size_t layer_end = ready_lists_.size(), layers_left = mesh_.half_edge_count() / 3;
    for (std::size_t i = 0; i < ready_lists_.size(); ++i) {
      const std::int32_t h = ready_lists_[i];
      if (i == layer_end) {
        layer_end = ready_lists_.size();
        --layers_left;
      }
      if (layers_left == 0) {
        drop(h);
        continue;
      }
      list_state_[h] = ListState::kEmpty;
      propagate(h);
      emit_again();
    }
    ready_lists_.clear();
  }
  void drop(std::int32_t h) {
    list_state_[h] = ListState::kEmpty;
    blocks_.give_back(std::exchange(lists_[h], {}).block);
  }

  /// Nearest first, so that of sources that lie behind each other each emits once; in another order a source that is
  /// relaxed by many others in turn would relax as many behind it each time, and so on.
  void emit_again() {
    while (!improved_sources_.empty()) {
      const std::int32_t v = improved_sources_.pop();
      emit_windows(v);
      check_task(mesh_.out(v).size() + mesh_.loose(v).size());
    }
  }

  void count(std::size_t windows) {
    ++result_.counters.lists;
    result_.counters.windows += windows;
    check_task(windows + kWorkOfAList);
  }

  /// Looks at the task now and then; `work` is what was done since the last call.
  void check_task(std::size_t work) {
    work_ += work;
    if (work_ < kWorkBetweenChecks) return;
    work_ = 0;
    task_.check(static_cast<double>(vertices_done_) / static_cast<double>(mesh_.vertex_count()));
  }

  /// Sorts a list by the middles of its windows: those that came over different sides of a triangle are mixed, and
  /// only neighbors are compared. Few are out of place.
  static void sort(const Windows& w, std::size_t size) {
    for (std::size_t i = 1; i < size; ++i) {
      const double b0 = w.b0[i], b1 = w.b1[i], x = w.x[i], y = w.y[i], d = w.distance[i];
      const std::int32_t source = w.source[i];
      std::size_t to = i;
      for (; to > 0 && w.b0[to - 1] + w.b1[to - 1] > b0 + b1; --to) {
        w.set(to, w.b0[to - 1], w.b1[to - 1], w.x[to - 1], w.y[to - 1], w.distance[to - 1], w.source[to - 1]);
      }
      if (to < i) w.set(to, b0, b1, x, y, d, source);
    }
  }

  /// Sorts a list in place, cuts windows back to where they are nearer than their neighbors, and drops those of which
  /// nothing is left. Returns how many there still are.
  std::size_t prune(const Windows& w, std::size_t size, double length) {
    const std::size_t count = list_overlapping_pairs(w, size);
    if (count == 0) return size;
    const std::size_t* lefts = lefts_.room_for(size);
    compare_pairs(w, count, [&](std::size_t k) { return std::pair(lefts[k], lefts[k] + 1); });
    const double narrow = kLeastWidth * length;
    const auto is_left_over = [&](std::size_t i) { return w.b1[i] - w.b0[i] > narrow; };
    bool are_all = true;
    for (std::size_t k = 0; k < count; ++k) {
      are_all &= is_left_over(lefts[k]);
      are_all &= is_left_over(lefts[k] + 1);
    }
    if (are_all) return size;
    std::size_t kept = 0;
    for (std::size_t i = 0; i < size; ++i) {
      const bool is_kept = is_left_over(i);
      w.set(kept, w.b0[i], w.b1[i], w.x[i], w.y[i], w.distance[i], w.source[i]);
      kept += is_kept;
    }
    return kept;
  }

  /// Sorts a list in place and writes to lefts_ each window that overlaps the next one so much that comparing the two
  /// pays; returns how many there are.
  std::size_t list_overlapping_pairs(const Windows& w, std::size_t size) {
    std::int64_t* overlaps = flags_.room_for(size);
    if (!kernels_.find_overlaps(w, size, overlaps)) {
      sort(w, size);
      kernels_.find_overlaps(w, size, overlaps);
    }
    std::size_t* lefts = lefts_.room_for(size);
    std::size_t count = 0;
    for (std::size_t i = 0; i + 1 < size; ++i) {
      lefts[count] = i;
      count += static_cast<std::size_t>(overlaps[i]);
    }
    return count;
  }

  /// The windows of a list on their way through the triangle that they enter.
  struct Crossing {
    std::int32_t half_edge;
    const HalfEdge& edge;    ///< the triangle's base
    double at_tail, at_tip;  ///< distances known at its ends
    Windows windows;
    std::size_t count;
    const double* projections = nullptr;  ///< of the apex onto the base, from each window's source
    /// Where the shortest path to the apex passes the base. No ray on its left reaches the right side first, none on
    /// its right the left side ("one angle, two sides").
    double split = 0.0;
  };

  /// The shortest path to the apex of a triangle over its base.
  struct ApexPath {
    double distance;
    TraceRecord record;
    std::size_t window;  ///< the one it comes through, or the one next to the end of the base that it comes over
  };

  /// Carries the list of h through the triangle it enters.
  void propagate(std::int32_t h) {
    const HalfEdge& edge = mesh_.half_edge(h);
    const WindowList list = std::exchange(lists_[h], {});
    if (edge.left >= 0) prefetch(&lists_[edge.left]);
    if (edge.right >= 0) prefetch(&lists_[edge.right]);
    count(list.size);
    Crossing crossing{.half_edge = h,
                      .edge = edge,
                      .at_tail = distance(edge.tail),
                      .at_tip = distance(edge.tip),
                      .windows = list.windows(),
                      .count = 0};
    crossing.count = prune(crossing.windows, list.size, edge.length);
    if (mesh_.sibling(h) >= 0) crossing.count = prune_all(crossing.windows, crossing.count, edge.length);
    const ApexPath path = find_apex_path(crossing);
    if (windows_kept_ > 0 && crossing.count > windows_kept_) keep_around(path.window, crossing);
    relax(edge.apex, path.distance, path.record);
    cross_side<true>(crossing);
    cross_side<false>(crossing);
    blocks_.give_back(list.block);
  }

  /// Compares all pairs of windows, not neighbors alone. Windows multiply where they go on into several faces at each
  /// edge: around needles there would be no end of them. Returns how many there still are.
  std::size_t prune_all(const Windows& w, std::size_t size, double length) {
    const double narrow = kLeastWidth * length;
    const auto is_left_over = [&](std::size_t i) { return w.b1[i] - w.b0[i] > narrow; };
    const auto distance_of_middle = [&](std::size_t i) {
      const double x = (w.b0[i] + w.b1[i]) / 2 - w.x[i];
      return w.distance[i] + std::sqrt(x * x + w.y[i] * w.y[i]);
    };
    nearest_first_.resize(size);
    std::iota(nearest_first_.begin(), nearest_first_.end(), std::size_t{0});
    std::ranges::sort(nearest_first_, {}, [&](std::size_t i) { return std::pair(distance_of_middle(i), i); });
    kept_.clear();
    for (const std::size_t i : nearest_first_) {
      std::size_t* lefts = lefts_.room_for(2 * kept_.size());
      std::size_t* rights = lefts + kept_.size();
      std::size_t count = 0;
      for (const std::size_t k : kept_) {
        if (!(std::min(w.b1[i], w.b1[k]) - std::max(w.b0[i], w.b0[k]) > narrow)) continue;
        const bool is_left = w.b0[i] + w.b1[i] < w.b0[k] + w.b1[k];
        lefts[count] = is_left ? i : k;
        rights[count++] = is_left ? k : i;
      }
      compare_pairs(w, count, [&](std::size_t k) { return std::pair(lefts[k], rights[k]); });
      std::erase_if(kept_, [&](std::size_t k) { return !is_left_over(k); });
      if (is_left_over(i)) kept_.push_back(i);
    }
    std::ranges::sort(kept_);
    for (std::size_t k = 0; k < kept_.size(); ++k) {
      const std::size_t i = kept_[k];
      w.set(k, w.b0[i], w.b1[i], w.x[i], w.y[i], w.distance[i], w.source[i]);
    }
    return kept_.size();
  }

  /// Cuts the windows of pairs, the left and the right one, back to where they are nearer than the other. What is cut
  /// off is reached sooner by a path that exists, whatever becomes of its window, so all pairs can be compared at once.
  template <class PairAt>
  void compare_pairs(const Windows& w, std::size_t count, const PairAt& pair_at) {
    const std::size_t stride = count + kPadding;
    const Pairs pairs = Pairs::in(pairs_.room_for(Pairs::kColumns * stride), stride);
    for (std::size_t k = 0; k < count; ++k) {
      const auto [i, j] = pair_at(k);
      pairs.begin[k] = std::max(w.b0[i], w.b0[j]);
      pairs.end[k] = std::min(w.b1[i], w.b1[j]);
      pairs.left.set(k, w, i);
      pairs.right.set(k, w, j);
    }
    kernels_.compare(pairs, count);
    for (std::size_t k = 0; k < count; ++k) {
      const auto [i, j] = pair_at(k);
      if (pairs.left_until[k] < pairs.end[k] && w.b1[i] <= pairs.end[k]) w.b1[i] = pairs.left_until[k];
      if (pairs.right_from[k] > pairs.begin[k] && w.b0[j] >= pairs.begin[k]) w.b0[j] = pairs.right_from[k];
    }
  }

  /// Finds the apex projections, the shortest path to the apex, along a side or through a window, and the split.
  ApexPath find_apex_path(Crossing& c) {
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
  void keep_around(std::size_t window, Crossing& c) const {
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
  void cross_side(const Crossing& c) {
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
                    .at_tail = is_left ? c.at_tail : distance(edge.apex),
                    .at_tip = is_left ? distance(edge.apex) : c.at_tip};
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
    WindowList& list = lists_[entered];
    if constexpr (is_left) {
      hand_on(windows, children, count, made, list.reserve_front(made, blocks_) - made);
      list.grew_front(made);
    } else {
      hand_on(windows, children, count, made, list.reserve_back(made, blocks_));
      list.grew_back(made);
    }
    queue_list(entered, tail, tip);
  }

  /// Hands on those of `count` windows that are alive, to each half-edge of the edge but `left`, which they leave over.
  void hand_on_to_siblings(const Windows& from, const ChildWindows& children, std::size_t count, std::int32_t left,
                           double length) {
    for (std::size_t i = 0; i < count; ++i) {
      if (children.alive[i] == 0) continue;
      const std::int32_t source = crossing(left, from.source[i]);
      const double b0 = children.b0[i], b1 = children.b1[i], x = children.x[i], y = children.y[i];
      mesh_.for_each_beyond(left, [&](std::int32_t entered) {
        if (mesh_.is_mirrored(left, entered)) {
          add_window(entered, length - b1, length - b0, {length - x, y}, from.distance[i], source);
        } else {
          add_window(entered, b0, b1, {x, y}, from.distance[i], source);
        }
      });
    }
  }

  /// Writes those that are alive, `made` of `count`, side by side.
  static void hand_on(const Windows& from, const ChildWindows& children, std::size_t count, std::size_t made,
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

  const GeodesicMesh& mesh_;
  const Task& task_;
  const SourcePoints& sources_;
  const WavefrontEnd& end_;
  double longest_edge_ = 0.0;     ///< known where the front may stop
  std::size_t targets_done_ = 0;  ///< of end_.targets, so many have their final distances
  std::uint32_t windows_kept_;
  WavefrontResult result_;
  std::vector<Status> status_;
  IndexedHeap queue_;  ///< vertices on the front
  WindowBlocks blocks_;
  std::vector<WindowList> lists_;
  std::vector<ListState> list_state_;
  std::vector<std::int32_t> ready_lists_, umbrella_;
  IndexedHeap improved_sources_;  ///< passed by the front, and to emit windows once more
  const WindowKernels& kernels_ = window_kernels();
  Scratch<double> projections_, apex_distances_, pairs_, children_;
  Scratch<std::int64_t> flags_;
  Scratch<std::size_t> lefts_;
  std::vector<std::size_t> nearest_first_, kept_;
  std::unordered_map<std::uint64_t, std::int32_t> crossings_;  ///< by the half-edge left and the source
  std::size_t vertices_done_ = 0, work_ = 0;
};

}  // namespace

WavefrontResult propagate_wavefront(const GeodesicMesh& mesh, const SourcePoints& sources, const Task& task,
                                    std::uint32_t windows_kept, const WavefrontEnd& end) {
  return Wavefront(mesh, sources, task, windows_kept, end).run();
}

WavefrontResult propagate_wavefront(const GeodesicMesh& mesh, std::int32_t seed, const Task& task,
                                    std::uint32_t windows_kept) {
  return propagate_wavefront(mesh, SourcePoints({PlacedPoint::at_vertex(seed)}), task, windows_kept);
}

}  // namespace seamwire::detail
