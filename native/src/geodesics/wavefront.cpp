// SPDX-License-Identifier: GPL-3.0-or-later
//
// The triangle-oriented wavefront of Qin, Han, Yu, Yu, Zhang, "Fast and Exact Discrete Geodesic Computation Based on
// Triangle-Oriented Wavefront Propagation" (2016), with the window filter of Xin, Wang, "Improving Chen and Han's
// Algorithm on the Discrete Geodesic Problem" (2009).
//
// A window says: through the interval [b0, b1] of this half-edge the source (x, y) is seen in a straight line, when the
// triangles in between are unfolded. The front carries lists of windows from triangle to triangle, vertex by vertex in
// the order of their distance. A shortest path may bend at certain vertices only (GeodesicMesh::bends_paths), which
// become sources themselves. Windows that cannot matter are dropped; those that stay may overlap, so only neighbours in
// a list are compared, and only on the edge itself. The arithmetic is in window_kernels. What is dropped loses strictly
// to another path, or ties with it up to rounding, in which case a sliver is lost whose border lies next to a path of
// the same length.
#include "geodesics/wavefront.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <span>
#include <utility>

#include "detail/indexed_heap.hpp"
#include "geodesics/window_kernels.hpp"
#include "geodesics/window_lists.hpp"

namespace seamwire {
namespace {

std::size_t index(std::int32_t i) { return static_cast<std::size_t>(i); }

using HalfEdge = GeodesicMesh::HalfEdge;
using TraceRecord = DistanceField::TraceRecord;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// A path arrives at a vertex in a direction known up to this angle: ties, and gains too small to count, are within it.
constexpr double kShadowMargin = 1e-3;
/// A source whose distance falls by less than this part of it does not send out windows again: that is rounding.
constexpr double kLeastGain = 1e-13;
/// Windows (a list counts as some) between two looks at the task: a fraction of a millisecond.
constexpr std::size_t kWorkBetweenChecks = 8192;
constexpr std::size_t kWorkOfAList = 8;

/// A vertex: not met, met, passed by the front.
enum class Status : std::uint8_t { kOut, kFront, kInside };
/// A half-edge's list: without windows, with windows that wait for the front, in the queue of those that go on.
enum class Gathered : std::uint8_t { kNothing, kSome, kGoesOn };

class Wavefront {
 public:
  Wavefront(const GeodesicMesh& mesh, std::int32_t seed, const Task& task, std::uint32_t windows_kept)
      : mesh_(mesh),
        task_(task),
        seed_(seed),
        windows_kept_(windows_kept),
        status_(mesh.vertex_count(), Status::kOut),
        queue_(mesh.vertex_count()),
        lists_(mesh.half_edge_count()),
        gathered_(mesh.half_edge_count(), Gathered::kNothing) {
    result_.distances.assign(mesh.vertex_count(), kInfinity);
    result_.records.resize(mesh.vertex_count());
  }

  WavefrontResult run() {
    task_.check(0.0);
    lower(seed_, 0.0, {});
    while (!queue_.empty()) {
      const std::int32_t v = queue_.pop();
      const auto next = queue_.empty() ? std::span<const std::int32_t>() : mesh_.out(queue_.least());
      prefetch(next.data());
      advance(v);
      ++vertices_done_;
      for (const std::int32_t h : next) prefetch(&mesh_.half_edge(h));
      drain();
    }
    task_.check(1.0);
    return std::move(result_);
  }

 private:
  double distance(std::int32_t v) const { return result_.distances[index(v)]; }

  /// A path to v was found; keeps it if it is shorter than what is known.
  void lower(std::int32_t v, double distance, const TraceRecord& record) {
    const double before = result_.distances[index(v)];
    if (!(distance < before)) return;
    result_.distances[index(v)] = distance;
    result_.records[index(v)] = record;
    if (status_[index(v)] != Status::kInside) {
      status_[index(v)] = Status::kFront;
      queue_.lower(v, distance);
    } else if ((mesh_.bends_paths(v) || v == seed_) && distance < before * (1 - kLeastGain)) {
      sources_again_.emplace_back(distance, v);
      std::push_heap(sources_again_.begin(), sources_again_.end(), std::greater<>());
    }
  }

  /// The front passes the vertex v.
  void advance(std::int32_t v) {
    status_[index(v)] = Status::kInside;
    const auto leaving = mesh_.out(v);
    for (const std::int32_t h : leaving) {
      const HalfEdge& edge = mesh_.half_edge(h);
      if (status_[index(edge.tip)] == Status::kOut) status_[index(edge.tip)] = Status::kFront;
      if (status_[index(edge.apex)] == Status::kOut) status_[index(edge.apex)] = Status::kFront;
    }
    if (mesh_.bends_paths(v) || v == seed_) {
      send_out(v);
    } else if (windows_kept_ > 0) {
      lower_neighbours(v);  // stretched windows need not cover all; this bounds what is lost
    }
    for (const std::int32_t h : leaving) {
      enqueue(h);
      enqueue(GeodesicMesh::previous(h));
      enqueue(GeodesicMesh::next(h));
      const std::int32_t opposite = mesh_.half_edge(h).right;
      if (opposite >= 0 && gathered_[index(opposite)] == Gathered::kSome &&
          status_[index(mesh_.half_edge(opposite).apex)] != Status::kOut) {
        enqueue(opposite);
      }
    }
  }

  /// Paths along the edges at v.
  void lower_neighbours(std::int32_t v) {
    const double from = distance(v);
    for (const std::int32_t h : mesh_.out(v)) {
      const HalfEdge& edge = mesh_.half_edge(h);
      lower(edge.tip, from + edge.length, {.x = edge.length, .half_edge = ~h, .source = v});
      if (edge.left >= 0) continue;  // the edge to the apex is that to the tip in the corner beside
      const std::int32_t before = GeodesicMesh::previous(h);
      lower(edge.apex, from + edge.left_length, {.x = edge.left_length, .half_edge = ~before, .source = v});
    }
    for (const auto& [to, length] : mesh_.loose(v)) {
      lower(to, from + length, {.x = length, .half_edge = TraceRecord::kLooseEdge, .source = v});
    }
  }

  /// v becomes a source: paths run from it along its edges, and straight on over its triangles.
  void send_out(std::int32_t v) {
    lower_neighbours(v);
    const auto [arrival, angle] = arrival_at(v);
    std::size_t corners = 0;
    if (arrival >= 0) corners = send_into_shadow(v, arrival, angle);
    if (corners == mesh_.out(v).size()) return;
    // Fans that the path did not arrive in see all of it.
    for (const std::int32_t h : mesh_.out(v)) {
      if (corners == 0 || std::find(fan_.begin(), fan_.end(), h) == fan_.end()) {
        send_window(v, h, 0.0, mesh_.angle(h));
      }
    }
  }

  /// The corner in which the shortest path arrives at v, named by the half-edge that leaves v there, and its angle from
  /// that half-edge; -1 at the seed and where it comes along a loose edge.
  std::pair<std::int32_t, double> arrival_at(std::int32_t v) const {
    const TraceRecord& record = result_.records[index(v)];
    if (record.half_edge >= 0) {
      const HalfEdge& edge = mesh_.half_edge(record.half_edge);
      const double x = record.x - edge.apex_x, y = record.y - edge.apex_y;
      const double turn = std::atan2(edge.apex_y * x - edge.apex_x * y, -edge.apex_x * x - edge.apex_y * y);
      const std::int32_t corner = GeodesicMesh::previous(record.half_edge);
      return {corner, std::clamp(turn, 0.0, mesh_.angle(corner))};
    }
    if (record.half_edge == TraceRecord::kNone || record.half_edge == TraceRecord::kLooseEdge) return {-1, 0.0};
    const std::int32_t along = ~record.half_edge;
    const HalfEdge& edge = mesh_.half_edge(along);
    if (edge.tail == edge.tip) return {-1, 0.0};
    if (edge.tail == v) return {along, 0.0};
    return {GeodesicMesh::next(along), mesh_.angle(GeodesicMesh::next(along))};
  }

  /// A shortest path that bends at v has an angle of at least pi on both sides. Sends windows to where that is so, in
  /// the fan of the corner where the path arrives; returns how many corners this fan has, and leaves them in fan_.
  std::size_t send_into_shadow(std::int32_t v, std::int32_t arrival, double angle) {
    constexpr double kShadow = std::numbers::pi - kShadowMargin;
    fan_.clear();
    double turned = -angle;
    std::int32_t h = arrival;
    do {
      fan_.push_back(h);
      turned += mesh_.angle(h);
      h = mesh_.half_edge(h).left;
    } while (h >= 0 && h != arrival);
    const double shadow_end = h == arrival ? turned + angle - kShadow : std::numeric_limits<double>::infinity();
    turned = -angle;
    for (const std::int32_t corner : fan_) {
      send_window(v, corner, kShadow - turned, shadow_end - turned);
      turned += mesh_.angle(corner);
    }
    if (h == arrival) return fan_.size();
    // An open fan: the other way round to its other end.
    turned = angle;
    for (h = mesh_.twin(arrival); h >= 0; h = mesh_.twin(h)) {
      h = GeodesicMesh::next(h);
      fan_.push_back(h);
      const double whole = mesh_.angle(h);
      send_window(v, h, -1.0, whole - (kShadow - turned));
      turned += whole;
    }
    return fan_.size();
  }

  /// A window from v over the corner between h and the edge on its left, for the directions from `begin` to `end`, as
  /// angles from h.
  void send_window(std::int32_t v, std::int32_t h, double begin, double end) {
    if (!(begin < end) || end <= 0 || begin >= mesh_.angle(h)) return;
    const HalfEdge& edge = mesh_.half_edge(h);
    if (edge.right < 0) return;
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
    WindowList& list = lists_[index(edge.right)];
    list.reserve_back(1, blocks_).set(0, b0, b1, x, y, distance(v), v);
    list.grew_back(1);
    gather(edge.right, edge.apex, edge.tip);
  }

  void enqueue(std::int32_t h) {
    if (gathered_[index(h)] != Gathered::kSome) return;
    gathered_[index(h)] = Gathered::kGoesOn;
    going_on_.push_back(h);
    prefetch(&mesh_.half_edge(h));
    prefetch(&lists_[index(h)]);
  }
  /// The list of h, from tail to tip, has got windows. It goes on as soon as the front has passed an end of its edge;
  /// until then it gathers.
  void gather(std::int32_t h, std::int32_t tail, std::int32_t tip) {
    if (gathered_[index(h)] == Gathered::kNothing) gathered_[index(h)] = Gathered::kSome;
    if (status_[index(tail)] == Status::kInside || status_[index(tip)] == Status::kInside) enqueue(h);
  }

  /// First in, first out: a list that comes later finds more windows gathered, and better distances.
  void drain() {
    // NOLINTNEXTLINE(modernize-loop-convert): the list grows while it is read.
    for (std::size_t i = 0; i < going_on_.size(); ++i) {
      const std::int32_t h = going_on_[i];
      gathered_[index(h)] = Gathered::kNothing;
      propagate(h);
      send_out_again();
    }
    going_on_.clear();
  }

  /// Nearest first, so that of those that lie behind each other each goes once; in another order one that is lowered by
  /// many others in turn would lower as many behind it each time, and so on.
  void send_out_again() {
    while (!sources_again_.empty()) {
      std::pop_heap(sources_again_.begin(), sources_again_.end(), std::greater<>());
      const auto [distance_then, v] = sources_again_.back();
      sources_again_.pop_back();
      if (distance_then != distance(v)) continue;  // it is there once more, nearer
      send_out(v);
      look_up(mesh_.out(v).size() + mesh_.loose(v).size());
    }
  }

  void count(std::size_t windows) {
    ++result_.counters.lists;
    result_.counters.windows += windows;
    look_up(windows + kWorkOfAList);
  }

  /// Looks at the task once in a while, after so much more work.
  void look_up(std::size_t work) {
    work_ += work;
    if (work_ < kWorkBetweenChecks) return;
    work_ = 0;
    task_.check(static_cast<double>(vertices_done_) / static_cast<double>(mesh_.vertex_count()));
  }

  /// Sorts a list by the middles of its windows: those that came over different sides of a triangle are mixed, and
  /// only neighbours are compared. Few are out of place.
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

  /// Sorts a list in place, cuts windows back to where they are nearer than their neighbours, and drops those of which
  /// nothing is left. Returns how many there still are. What is cut off is reached sooner by a path that exists,
  /// whatever becomes of its window, so all pairs can be compared at once.
  std::size_t prune(const Windows& w, std::size_t size, double length) {
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
    if (count == 0) return size;

    const std::size_t stride = count + kPadding;
    const Pairs pairs = Pairs::in(pairs_.room_for(Pairs::kColumns * stride), stride);
    for (std::size_t k = 0; k < count; ++k) {
      const std::size_t i = lefts[k], j = i + 1;
      pairs.begin[k] = std::max(w.b0[i], w.b0[j]);
      pairs.end[k] = std::min(w.b1[i], w.b1[j]);
      pairs.left_x[k] = w.x[i];
      pairs.left_y[k] = w.y[i];
      pairs.left_distance[k] = w.distance[i];
      pairs.right_x[k] = w.x[j];
      pairs.right_y[k] = w.y[j];
      pairs.right_distance[k] = w.distance[j];
    }
    kernels_.compare(pairs, count);
    const double narrow = kLeastWidth * length;
    for (std::size_t k = 0; k < count; ++k) {
      const std::size_t i = lefts[k], j = i + 1;
      if (pairs.left_until[k] < pairs.end[k] && w.b1[i] <= pairs.end[k]) w.b1[i] = pairs.left_until[k];
      if (pairs.right_from[k] > pairs.begin[k] && w.b0[j] >= pairs.begin[k]) w.b0[j] = pairs.right_from[k];
    }
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

  /// Carries the list of h through the triangle it enters.
  void propagate(std::int32_t h) {
    const HalfEdge& edge = mesh_.half_edge(h);
    const WindowList list = std::exchange(lists_[index(h)], {});
    if (edge.left >= 0) prefetch(&lists_[index(edge.left)]);
    if (edge.right >= 0) prefetch(&lists_[index(edge.right)]);
    count(list.size);
    Windows in = list.windows();
    std::size_t kept = prune(in, list.size, edge.length);

    // One angle, two sides: of all ways through the triangle to its apex find the shortest, and the point of the base
    // it passes. No ray on its left reaches the right side first, none on its right the left side.
    const double at_tail = distance(edge.tail), at_tip = distance(edge.tip);
    double split = 0.0, shortest = at_tail + edge.left_length;
    TraceRecord record{.x = edge.left_length, .half_edge = ~GeodesicMesh::previous(h), .source = edge.tail};
    std::size_t winner = 0;
    if (at_tip + edge.right_length < shortest) {
      shortest = at_tip + edge.right_length;
      split = edge.length;
      record = {.x = edge.right_length, .half_edge = ~GeodesicMesh::next(h), .source = edge.tip};
      winner = std::max<std::size_t>(kept, 1) - 1;
    }
    const Entered triangle{edge.length, edge.apex_x, edge.apex_y};
    const double* feet = feet_.room_for(kept);
    const double* ways = ways_.room_for(kept);
    kernels_.find_ways(in, kept, triangle, feet_.room_for(kept), ways_.room_for(kept));
    bool wins = false;
    for (std::size_t i = 0; i < kept; ++i) {
      if (ways[i] < shortest) [[unlikely]] {
        shortest = ways[i];
        winner = i;
        wins = true;
      }
    }
    if (wins) {
      split = std::clamp(feet[winner], in.b0[winner], in.b1[winner]);
      record = {.x = in.x[winner], .y = in.y[winner], .half_edge = h, .source = in.source[winner]};
    }
    if (windows_kept_ > 0 && kept > windows_kept_) {
      const std::size_t before = winner > windows_kept_ / 2 ? winner - windows_kept_ / 2 : 0;
      const std::size_t first = std::min(before, kept - windows_kept_);
      in.b0[first] = std::min(in.b0[first], in.b0[0]);
      in.b1[first + windows_kept_ - 1] = std::max(in.b1[first + windows_kept_ - 1], in.b1[kept - 1]);
      in = in + first;
      feet += first;
      kept = windows_kept_;
    }
    lower(edge.apex, shortest, record);

    const double at_apex = distance(edge.apex);
    const std::size_t stride = kept + kPadding;
    const Children children =
        Children::in(children_.room_for(Children::kColumns * stride), stride, flags_.room_for(kept));
    if (edge.left >= 0 && split > 0) {
      std::size_t end = kept;
      while (end > 0 && !(in.b0[end - 1] < std::min(split, feet[end - 1]))) --end;
      const Side side{.length = edge.left_length,
                      .cosine = edge.apex_x / edge.left_length,
                      .sine = edge.apex_y / edge.left_length,
                      .at_tail = at_tail,
                      .at_tip = at_apex};
      const std::size_t made = kernels_.to_left(in, end, feet, split, side, children);
      if (made > 0) {
        const Windows behind = lists_[index(edge.left)].reserve_front(made, blocks_);
        hand_on(in, children, end, made, behind - made);
        lists_[index(edge.left)].grew_front(made);
        gather(edge.left, edge.tail, edge.apex);
      }
    }
    if (edge.right >= 0 && split < edge.length) {
      std::size_t begin = 0;
      while (begin < kept && !(in.b1[begin] > std::max(split, feet[begin]))) ++begin;
      // The side runs from the apex to the tip; seen from its next triangle the apex is its tail.
      const Side side{.length = edge.right_length,
                      .cosine = (edge.length - edge.apex_x) / edge.right_length,
                      .sine = -edge.apex_y / edge.right_length,
                      .at_tail = at_apex,
                      .at_tip = at_tip};
      const std::size_t made =
          kernels_.to_right(in + begin, kept - begin, feet + begin, split, triangle, side, children);
      if (made > 0) {
        WindowList& to = lists_[index(edge.right)];
        hand_on(in + begin, children, kept - begin, made, to.reserve_back(made, blocks_));
        to.grew_back(made);
        gather(edge.right, edge.apex, edge.tip);
      }
    }
    blocks_.give_back(list.block);
  }

  /// Writes those that are alive, `made` of `count`, side by side.
  static void hand_on(const Windows& from, const Children& children, std::size_t count, std::size_t made,
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
  std::int32_t seed_;
  std::uint32_t windows_kept_;
  WavefrontResult result_;
  std::vector<Status> status_;
  VertexQueue queue_;
  WindowBlocks blocks_;
  std::vector<WindowList> lists_;
  std::vector<Gathered> gathered_;
  std::vector<std::int32_t> going_on_, fan_;
  std::vector<std::pair<double, std::int32_t>> sources_again_;  ///< a heap: at which distance, and which
  const WindowKernels& kernels_ = window_kernels();
  Scratch<double> feet_, ways_, pairs_, children_;
  Scratch<std::int64_t> flags_;
  Scratch<std::size_t> lefts_;
  std::size_t vertices_done_ = 0, work_ = 0;
};

}  // namespace

WavefrontResult propagate_wavefront(const GeodesicMesh& mesh, std::int32_t seed, const Task& task,
                                    std::uint32_t windows_kept) {
  return Wavefront(mesh, seed, task, windows_kept).run();
}

}  // namespace seamwire
