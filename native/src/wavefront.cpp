// SPDX-License-Identifier: GPL-3.0-or-later
//
// The triangle-oriented wavefront of Qin, Han, Yu, Yu, Zhang, "Fast and Exact Discrete Geodesic Computation Based on
// Triangle-Oriented Wavefront Propagation" (2016), with the window filter of Xin, Wang, "Improving Chen and Han's
// Algorithm on the Discrete Geodesic Problem" (2009).
//
// A window says: through the interval [b0, b1] of this half-edge the source (x, y) is seen in a straight line, when the
// triangles in between are unfolded. The front carries lists of windows from triangle to triangle, vertex by vertex in
// the order of their distance. A shortest path may bend at certain vertices only (GeodesicMesh::bends_paths), which
// become sources themselves. Windows that cannot matter are dropped; those that stay may overlap, so that no
// equation for the border between two of them needs solving. What is dropped loses strictly to another path, or ties
// with it up to rounding, in which case a sliver is lost whose border lies next to a path of the same length.
#include "wavefront.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "vertex_queue.hpp"
#include "window_lists.hpp"

namespace seamwire {
namespace {

std::size_t index(std::int32_t i) { return static_cast<std::size_t>(i); }

using HalfEdge = GeodesicMesh::HalfEdge;
using TraceRecord = DistanceField::TraceRecord;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// A window narrower than this part of its edge is dropped: what is missed next to it is of second order in the width.
constexpr double kLeastWidth = 1e-12;
/// Two windows are compared once their overlap is this part of the narrower one: less is not worth the roots.
constexpr double kLeastOverlap = 0.25;
/// Where a window's way to the apex is closer to an end of the base than this part of it and not straight, it is the
/// way over that end, which is known better from the end itself.
constexpr double kCornerWidth = 1e-9;
/// A path arrives at a vertex in a direction known up to this angle: ties, and gains too small to count, are within it.
constexpr double kShadowMargin = 1e-3;
/// A source whose distance falls by less than this part of it does not send out windows again: that is rounding.
constexpr double kLeastGain = 1e-13;
/// Windows (a list counts as some) between two looks at the task: a fraction of a millisecond.
constexpr std::size_t kWorkBetweenChecks = 8192;
constexpr std::size_t kWorkOfAList = 8;

enum class Status : std::uint8_t { kOut, kFront, kInside };

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
        is_waiting_(mesh.half_edge_count(), 0) {
    result_.distances.assign(mesh.vertex_count(), kInfinity);
    result_.records.resize(mesh.vertex_count());
  }

  WavefrontResult run() {
    task_.check(0.0);
    lower(seed_, 0.0, {});
    while (!queue_.empty()) {
      advance(queue_.pop());
      ++vertices_done_;
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
      sources_again_.push_back(v);
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
      if (opposite >= 0 && status_[index(mesh_.half_edge(opposite).apex)] != Status::kOut) enqueue(opposite);
    }
  }

  /// Paths along the edges at v.
  void lower_neighbours(std::int32_t v) {
    const double from = distance(v);
    for (const std::int32_t h : mesh_.out(v)) {
      const std::int32_t before = GeodesicMesh::previous(h);
      const double tip_length = mesh_.half_edge(h).length, apex_length = mesh_.half_edge(before).length;
      lower(mesh_.half_edge(h).tip, from + tip_length, {.x = tip_length, .half_edge = ~h, .source = v});
      lower(mesh_.half_edge(h).apex, from + apex_length, {.x = apex_length, .half_edge = ~before, .source = v});
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
    const HalfEdge& edge = mesh_.half_edge(h);
    if (edge.right < 0 || !(begin < end) || end <= 0 || begin >= mesh_.angle(h)) return;
    const double cosine = (edge.length - edge.apex_x) * edge.right_inverse;
    const double sine = -edge.apex_y * edge.right_inverse;
    const double x = -edge.apex_x * cosine - edge.apex_y * sine, y = edge.apex_x * sine - edge.apex_y * cosine;
    if (!(y < 0)) return;
    // Where the line from v in a direction meets the opposite edge, from its tip (the apex here).
    const double length = mesh_.half_edge(edge.right).length;
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
    list.grew_back(1, blocks_);
    enqueue_if_passed(edge.right);
  }

  void enqueue(std::int32_t h) {
    if (is_waiting_[index(h)] || lists_[index(h)].size == 0) return;
    is_waiting_[index(h)] = 1;
    waiting_.push_back(h);
  }
  /// A list goes on as soon as the front has passed an end of its edge; until then it gathers.
  void enqueue_if_passed(std::int32_t h) {
    const HalfEdge& edge = mesh_.half_edge(h);
    if (status_[index(edge.tail)] == Status::kInside || status_[index(edge.tip)] == Status::kInside) enqueue(h);
  }

  /// First in, first out: a list that comes later finds more windows gathered, and better distances.
  void drain() {
    // NOLINTNEXTLINE(modernize-loop-convert): the list grows while it is read.
    for (std::size_t i = 0; i < waiting_.size(); ++i) {
      const std::int32_t h = waiting_[i];
      is_waiting_[index(h)] = 0;
      propagate(h);
      while (!sources_again_.empty()) {
        const std::int32_t v = sources_again_.back();
        sources_again_.pop_back();
        send_out(v);
      }
    }
    waiting_.clear();
  }

  void count(std::size_t windows) {
    ++result_.counters.lists;
    result_.counters.windows += windows;
    work_ += windows + kWorkOfAList;
    if (work_ < kWorkBetweenChecks) return;
    work_ = 0;
    task_.check(static_cast<double>(vertices_done_) / static_cast<double>(mesh_.vertex_count()));
  }

  /// The filter of Xin and Wang: the window cannot matter if the ends of the edge, walked along it, do better at the
  /// window's far end. Compared in squares: no root.
  static bool is_useless(double at_tail, double at_tip, double length, double b0, double b1, double x, double y,
                         double distance) {
    const double over_tail = at_tail + b1 - distance, over_tip = at_tip + (length - b0) - distance;
    const double square0 = (b0 - x) * (b0 - x) + y * y, square1 = (b1 - x) * (b1 - x) + y * y;
    return over_tail < 0 || over_tip < 0 || over_tail * over_tail < square1 || over_tip * over_tip < square0;
  }

  static double distance_at(const Windows& w, std::size_t i, double b) {
    return w.distance[i] + std::sqrt((b - w.x[i]) * (b - w.x[i]) + w.y[i] * w.y[i]);
  }

  /// Where on the base the windows i and j are equally far, between begin and end, at which different ones are nearer:
  /// the root of d_i + |s_i - b| = d_j + |s_j - b|, squared twice.
  static double border(const Windows& w, std::size_t i, std::size_t j, double begin, double end) {
    const double gap = w.distance[j] - w.distance[i], gap2 = gap * gap;
    const double xi = w.x[i] - begin, xj = w.x[j] - begin;
    const double norm_i = xi * xi + w.y[i] * w.y[i], norm_j = xj * xj + w.y[j] * w.y[j];
    const double p = xj - xi, q = 0.5 * (norm_i - norm_j - gap2);
    const double a = p * p - gap2, b = p * q + gap2 * xj, c = q * q - gap2 * norm_j;
    const double root = std::sqrt(std::max(b * b - a * c, 0.0));
    const double sum = b < 0 ? root - b : -root - b;
    const double r0 = sum / a, r1 = c / sum;
    const double width = end - begin;
    const bool is_r0_inside = r0 >= 0 && r0 <= width, is_r1_inside = r1 >= 0 && r1 <= width;
    if (is_r0_inside != is_r1_inside) return begin + (is_r0_inside ? r0 : r1);
    // One of the two belongs to the equation's mirror image, d_i - |s_i - b|.
    const auto miss = [&](double r) { return std::abs(distance_at(w, i, begin + r) - distance_at(w, j, begin + r)); };
    if (is_r0_inside) return begin + (miss(r0) < miss(r1) ? r0 : r1);
    return std::nan("");
  }

  /// Drops what is useless from a list, in place, and cuts back windows where the one beside them is nearer. Returns
  /// how many are left.
  std::uint32_t prune(const Windows& w, std::uint32_t size, double at_tail, double at_tip, double length) {
    std::uint32_t kept = 0;
    const double narrow = kLeastWidth * length;
    for (std::uint32_t next = 0; next < size; ++next) {
      if (is_useless(at_tail, at_tip, length, w.b0[next], w.b1[next], w.x[next], w.y[next], w.distance[next])) continue;
      if (kept != next) w.set(kept, w.b0[next], w.b1[next], w.x[next], w.y[next], w.distance[next], w.source[next]);
      bool is_alive = true;
      while (kept > 0) {
        const std::size_t i = kept - 1, j = kept;
        const double begin = std::max(w.b0[i], w.b0[j]), end = std::min(w.b1[i], w.b1[j]);
        if (!(end - begin > kLeastOverlap * std::min(w.b1[i] - w.b0[i], w.b1[j] - w.b0[j]))) break;
        const double at_begin = distance_at(w, i, begin) - distance_at(w, j, begin);
        const double at_end = distance_at(w, i, end) - distance_at(w, j, end);
        // The difference of the two distances rises or falls all along the overlap if the line through both sources
        // does not meet it.
        const double side_begin = (w.x[i] - begin) * w.y[j] - (w.x[j] - begin) * w.y[i];
        const double side_end = (w.x[i] - end) * w.y[j] - (w.x[j] - end) * w.y[i];
        if (side_begin * side_end < 0) break;
        double i_until = end, j_from = begin;  // i is the nearer one up to here; j from here on
        if (at_begin <= 0 && at_end <= 0) {
          j_from = end;
        } else if (at_begin >= 0 && at_end >= 0) {
          i_until = begin;
        } else if (at_begin < 0) {
          const double b = border(w, i, j, begin, end);
          if (!std::isnan(b)) i_until = j_from = b;
        } else {
          break;
        }
        if (i_until < end && w.b1[i] <= end) w.b1[i] = i_until;
        if (j_from > begin && w.b0[j] >= begin) w.b0[j] = j_from;
        if (!(w.b1[j] - w.b0[j] > narrow)) {
          is_alive = false;
          break;
        }
        if (w.b1[i] - w.b0[i] > narrow) break;
        w.set(i, w.b0[j], w.b1[j], w.x[j], w.y[j], w.distance[j], w.source[j]);
        --kept;
      }
      kept += is_alive;
    }
    return kept;
  }

  /// Carries the list of h through the triangle it enters.
  void propagate(std::int32_t h) {
    WindowList list = std::exchange(lists_[index(h)], {});
    Windows in = list.windows();
    count(list.size);
    const HalfEdge& edge = mesh_.half_edge(h);
    const double at_tail = distance(edge.tail), at_tip = distance(edge.tip);

    // One angle, two sides: of all ways through the triangle to its apex find the shortest, and the point of the base
    // it passes. No ray on its left reaches the right side first, none on its right the left side.
    const double left_length = mesh_.half_edge(GeodesicMesh::previous(h)).length;
    const double right_length = mesh_.half_edge(GeodesicMesh::next(h)).length;
    double split = 0.0, shortest = at_tail + left_length;
    TraceRecord record{.x = left_length, .half_edge = ~GeodesicMesh::previous(h), .source = edge.tail};
    if (at_tip + right_length < shortest) {
      shortest = at_tip + right_length;
      split = edge.length;
      record = {.x = right_length, .half_edge = ~GeodesicMesh::next(h), .source = edge.tip};
    }
    std::uint32_t kept = prune(in, list.size, at_tail, at_tip, edge.length), winner = 0;
    if (split > 0 && kept > 0) winner = kept - 1;
    feet_.resize(std::max<std::size_t>(feet_.size(), kept));
    double* feet = feet_.data();
    for (std::uint32_t i = 0; i < kept; ++i) {
      const double b0 = in.b0[i], b1 = in.b1[i], x = in.x[i], y = in.y[i], d = in.distance[i];
      const double foot = x + (edge.apex_x - x) * -y / (edge.apex_y - y);
      feet[i] = foot;
      const double through = std::clamp(foot, b0, b1);
      const double to_apex = d + std::sqrt((through - x) * (through - x) + y * y) +
                             std::sqrt((through - edge.apex_x) * (through - edge.apex_x) + edge.apex_y * edge.apex_y);
      const bool is_over_corner =
          through != foot && (through < kCornerWidth * edge.length || through > (1 - kCornerWidth) * edge.length);
      if (to_apex < shortest && !is_over_corner) {
        shortest = to_apex;
        split = through;
        record = {.x = x, .y = y, .half_edge = h, .source = in.source[i]};
        winner = i;
      }
    }
    if (windows_kept_ > 0 && kept > windows_kept_) {
      const std::uint32_t first =
          std::min(winner > windows_kept_ / 2 ? winner - windows_kept_ / 2 : 0, kept - windows_kept_);
      in.b0[first] = std::min(in.b0[first], in.b0[0]);
      in.b1[first + windows_kept_ - 1] = std::max(in.b1[first + windows_kept_ - 1], in.b1[kept - 1]);
      in = in + first;
      feet = feet_.data() + first;
      kept = windows_kept_;
    }
    lower(edge.apex, shortest, record);
    const double at_apex = distance(edge.apex);

    if (edge.left >= 0 && kept > 0 && split > 0) {
      WindowList& to = lists_[index(edge.left)];
      const double cosine = edge.apex_x * edge.left_inverse, sine = edge.apex_y * edge.left_inverse;
      const Windows out = to.reserve_front(kept, blocks_);
      std::ptrdiff_t made = 0;
      for (std::uint32_t i = kept; i-- > 0;) {
        const double b0 = in.b0[i], x = in.x[i], y = in.y[i], d = in.distance[i];
        const double b1 = std::min(in.b1[i], split);
        if (!(b0 < b1) || !(b0 < feet[i])) continue;
        // Where the rays over b0 and b1 meet the side, from the tail. The further right a ray, the smaller its
        // denominator; where that is not positive, the ray never gets to the side.
        const double denominator0 = -y * cosine - sine * (b0 - x);
        if (!(denominator0 > 0)) continue;
        const double t0 = -y * b0 / denominator0;
        double t1 = left_length;
        if (b1 < feet[i]) {
          const double denominator1 = -y * cosine - sine * (b1 - x);
          if (denominator1 > 0) t1 = std::min(-y * b1 / denominator1, left_length);
        }
        if (!(t1 - t0 > kLeastWidth * left_length)) continue;
        const double child_x = x * cosine + y * sine, child_y = y * cosine - x * sine;
        if (!(child_y < 0) || is_useless(at_tail, at_apex, left_length, t0, t1, child_x, child_y, d)) continue;
        ++made;
        const Windows slot = {out.b0 - made, out.b1 - made,       out.x - made,
                              out.y - made,  out.distance - made, out.source - made};
        slot.set(0, t0, t1, child_x, child_y, d, in.source[i]);
      }
      to.grew_front(static_cast<std::size_t>(made), blocks_);
      enqueue_if_passed(edge.left);
    }
    if (edge.right >= 0 && kept > 0 && split < edge.length) {
      WindowList& to = lists_[index(edge.right)];
      // The side runs from the apex to the tip; seen from its next triangle the apex is its tail.
      const double cosine = (edge.length - edge.apex_x) * edge.right_inverse, sine = -edge.apex_y * edge.right_inverse;
      const Windows out = to.reserve_back(kept, blocks_);
      std::size_t made = 0;
      for (std::uint32_t i = 0; i < kept; ++i) {
        const double b1 = in.b1[i], x = in.x[i], y = in.y[i], d = in.distance[i];
        const double b0 = std::max(in.b0[i], split);
        if (!(b0 < b1) || !(feet[i] < b1)) continue;
        // As on the left, mirrored: distances from the tip.
        const double denominator1 = -y * cosine - sine * (b1 - x);
        if (!(denominator1 > 0)) continue;
        const double t1 = right_length - -y * (edge.length - b1) / denominator1;
        double t0 = 0.0;
        if (b0 > feet[i]) {
          const double denominator0 = -y * cosine - sine * (b0 - x);
          if (denominator0 > 0) t0 = std::max(right_length - -y * (edge.length - b0) / denominator0, 0.0);
        }
        if (!(t1 - t0 > kLeastWidth * right_length)) continue;
        const double from_apex_x = x - edge.apex_x, from_apex_y = y - edge.apex_y;
        const double child_x = from_apex_x * cosine + from_apex_y * sine;
        const double child_y = from_apex_y * cosine - from_apex_x * sine;
        if (!(child_y < 0) || is_useless(at_apex, at_tip, right_length, t0, t1, child_x, child_y, d)) continue;
        out.set(made++, t0, t1, child_x, child_y, d, in.source[i]);
      }
      to.grew_back(made, blocks_);
      enqueue_if_passed(edge.right);
    }
    blocks_.give_back(list.block);
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
  std::vector<std::uint8_t> is_waiting_;
  std::vector<std::int32_t> waiting_, sources_again_, fan_;
  std::vector<double> feet_;
  std::size_t vertices_done_ = 0, work_ = 0;
};

}  // namespace

WavefrontResult propagate_wavefront(const GeodesicMesh& mesh, std::int32_t seed, const Task& task,
                                    std::uint32_t windows_kept) {
  return Wavefront(mesh, seed, task, windows_kept).run();
}

}  // namespace seamwire
