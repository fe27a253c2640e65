// SPDX-License-Identifier: GPL-3.0-or-later
//
// Distances between the vertices, from those at the vertices. A shortest path from a point p is straight until it meets
// a vertex or a source. So the distance of p is the least sum of a straight line to a vertex and that vertex's
// distance. The search sends beams from p over the surface, bounded by the vertices they have passed, nearest first.
//
// The search is short because distances change by no more than one walks. A path from p over the point x is not shorter
// than |px| - |xv| + d(v) for any vertex v. Of the vertices that bound a beam, those beside the shortest path alone
// leave room for a path that is not longer than the best one found. Beams away from it end after a few triangles.
#include "geodesics/point_search.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <queue>
#include <utility>

#include "detail/half_edge.hpp"
#include "detail/infinity.hpp"
#include "geodesics/window_kernels.hpp"

namespace seamwire::detail {
namespace {

using HalfEdge = GeodesicMesh::HalfEdge;

/// Beams between two looks at the task: a fraction of a millisecond.
constexpr std::size_t kWorkBetweenChecks = 2048;
/// Improvements below this fraction of the path's length are ignored.
constexpr double kRounding = 1e-14;

Point2 from_left(const HalfEdge& h, const Point2& p) {
  const double c = h.apex_x / h.left_length, s = h.apex_y / h.left_length;
  return {p.x * c - p.y * s, p.x * s + p.y * c};
}
Point2 from_right(const HalfEdge& h, const Point2& p) {
  const double c = (h.length - h.apex_x) / h.right_length, s = -h.apex_y / h.right_length;
  return {p.x * c - p.y * s + h.apex_x, p.x * s + p.y * c + h.apex_y};
}

/// Where the line from p, below the base, to q meets the base's line.
double meets_base(const Point2& p, const Point2& q) { return p.x + (q.x - p.x) * (-p.y / (q.y - p.y)); }

/// A vertex that bounds a beam, in its frame, and a lower bound of its distance.
struct Bounding {
  Point2 at;
  double distance;
};

/// Straight lines from the point through the interval [begin, end] of a half-edge.
struct Beam {
  std::int32_t half_edge, parent;
  std::int32_t left_over;  ///< the half-edge over which it left the triangle before
  double begin, end;
  Point2 point;
  Bounding near_tail, near_tip;  ///< on either side of it
};

/// Moves a beam into the frame of a sibling that runs the same way as the half-edge left.
void mirror(Beam& beam, double length) {
  beam = {.half_edge = beam.half_edge,
          .parent = beam.parent,
          .left_over = beam.left_over,
          .begin = length - beam.end,
          .end = length - beam.begin,
          .point = {length - beam.point.x, beam.point.y},
          .near_tail = {{length - beam.near_tip.at.x, beam.near_tip.at.y}, beam.near_tip.distance},
          .near_tip = {{length - beam.near_tail.at.x, beam.near_tail.at.y}, beam.near_tail.distance}};
}

class PointSearch {
 public:
  PointSearch(const SolvedDistances& solved, const PlacedPoint& point, const Task& task)
      : solved_(solved), mesh_(solved.mesh), point_(point), task_(task) {}

  StraightStart run() {
    look_within_faces();
    point_.for_each_exit(mesh_, [&](std::int32_t h, const Point2& p, std::int32_t left) {
      const HalfEdge edge = mesh_.half_edge(h);
      add({.half_edge = h,
           .parent = -1,
           .left_over = left,
           .begin = 0.0,
           .end = edge.length,
           .point = p,
           .near_tail = {{0.0, 0.0}, lower_bound(edge.tail)},
           .near_tip = {{edge.length, 0.0}, lower_bound(edge.tip)}});
    });
    while (!queue_.empty() && is_promising(queue_.top().first)) {
      const std::int32_t beam = queue_.top().second;
      queue_.pop();
      follow(beam);
    }
    if (best_.distance <= solved_.radius && best_.distance < kInfinity) {
      list_path();
    } else {
      best_ = {};
    }
    return std::move(best_);
  }

 private:
  /// Whether a path that is not shorter than `bound` may be the best one. Around a spike many beams are as long as the
  /// best one but for rounding; to follow them all takes 1 / the spike's angle steps.
  bool is_promising(double bound) const { return bound < (1.0 - kRounding) * best_.distance; }
  double lower_bound(std::int32_t vertex) const { return std::min(solved_.at(vertex), solved_.radius); }

  /// A path was found: straight to `end` in the frame of a half-edge (of `beam`'s, or of the point's own face), and on
  /// from there.
  void offer(double straight, std::int32_t vertex, std::int32_t source, std::int32_t beam, std::int32_t half_edge,
             const Point2& end) {
    const double distance = straight + (vertex >= 0 ? solved_.at(vertex) : 0.0);
    if (!(distance < best_.distance)) return;
    best_.distance = distance;
    best_.path.length = straight;
    best_.vertex = vertex;
    best_.source = source;
    beam_ = beam;
    half_edge_ = half_edge;
    end_ = end;
  }

  void look_within_faces() {
    point_.for_each_corner(mesh_, [&](std::int32_t h, const Point2&, double straight) {
      offer(straight, mesh_.half_edge(h).apex, -1, -1, h, {});
    });
    for (const auto& [face, weights] : point_.faces) {
      for (const SourcePoints::InFace& source : solved_.sources.in_face(face)) {
        std::array<double, 3> apart{};
        for (std::size_t i = 0; i < 3; ++i) apart[i] = source.weights[i] - weights[i];
        offer(norm(position(mesh_, 3 * face, apart)), -1, source.source, -1, 3 * face, {});
      }
    }
  }

  /// No path through the beam to a source is shorter.
  double lower_bound(const Beam& beam) const {
    const HalfEdge edge = mesh_.half_edge(beam.half_edge);
    // Where the path meets the base, x from its tail, |px| is behind it, and no less than d(tail) - x and
    // d(tip) - (length - x) ahead of it. The sum with the larger of the two falls up to where they are equal, and then
    // rises.
    const double tail = lower_bound(edge.tail), tip = lower_bound(edge.tip);
    const double x = std::clamp((tail - tip + edge.length) / 2, beam.begin, beam.end);
    double bound = distance(beam.point, {x, 0.0}) + std::max(tail - x, tip - (edge.length - x));
    const Point2 begin{beam.begin, 0.0}, end{beam.end, 0.0};
    const double to_begin = distance(beam.point, begin), to_end = distance(beam.point, end);
    for (const Bounding& vertex : {beam.near_tail, beam.near_tip}) {
      // On a line |px| - |xv| has one stationary point at most, where the line meets that through p and v. If p lies
      // between v and that point, it is the least value, -|pv|. Otherwise the least value on a segment is at an end.
      double detour = std::min(to_begin - distance(vertex.at, begin), to_end - distance(vertex.at, end));
      if (vertex.at.y < beam.point.y) {
        const double stationary = meets_base(vertex.at, beam.point);
        if (stationary > beam.begin && stationary < beam.end) detour = -distance(beam.point, vertex.at);
      }
      bound = std::max(bound, vertex.distance + detour);
    }
    return std::max(bound, -beam.point.y);
  }

  void add(const Beam& beam) {
    if (!(beam.point.y < 0) || !(beam.end - beam.begin > kLeastWidth * mesh_.half_edge(beam.half_edge).length)) return;
    const double bound = lower_bound(beam);
    if (!is_promising(bound) || bound > solved_.radius) return;
    queue_.emplace(bound, static_cast<std::int32_t>(beams_.size()));
    beams_.push_back(beam);
  }

  /// Lets a beam into the triangle behind its half-edge.
  void follow(std::int32_t number) {
    if (++work_ % kWorkBetweenChecks == 0) task_.check(0.0);
    const Beam beam = beams_[number];
    const HalfEdge edge = mesh_.half_edge(beam.half_edge);
    for (const SourcePoints::InFace& source : solved_.sources.in_face(beam.half_edge / 3)) {
      const Point2 at = position(mesh_, beam.half_edge, source.weights);
      const double through = meets_base(beam.point, at);
      if (through < beam.begin || through > beam.end) continue;
      offer(distance(beam.point, at), -1, source.source, number, beam.half_edge, at);
    }
    const Point2 apex{edge.apex_x, edge.apex_y};
    const double split = meets_base(beam.point, apex);
    if (split > beam.begin && split < beam.end) {
      offer(distance(beam.point, apex), edge.apex, -1, number, beam.half_edge, apex);
    }
    const Bounding at_apex{apex, lower_bound(edge.apex)};
    if (split > beam.begin) {
      const bool reaches_apex = split <= beam.end;
      hand_on(number, previous_in_face(beam.half_edge), edge.left_length, beam.begin,
              reaches_apex ? kInfinity : beam.end, beam.near_tail, reaches_apex ? at_apex : beam.near_tip,
              [&](const Point2& p) { return to_left(edge, p); });
    }
    if (split < beam.end) {
      const bool reaches_apex = split >= beam.begin;
      hand_on(number, next_in_face(beam.half_edge), edge.right_length, reaches_apex ? -kInfinity : beam.begin, beam.end,
              reaches_apex ? at_apex : beam.near_tail, beam.near_tip,
              [&](const Point2& p) { return to_right(edge, p); });
    }
  }

  /// Hands what a beam has between two points of its base on over a side; infinite: as far as the side goes.
  /// `left_over` is the side's half-edge in the triangle that the beam leaves.
  template <class Move>
  void hand_on(std::int32_t parent, std::int32_t left_over, double length, double begin, double end, Bounding near_tail,
               Bounding near_tip, const Move& move) {
    const Point2 p = move(beams_[parent].point);
    const auto meets_side = [&](double base) {
      if (std::isinf(base)) return base < 0 ? 0.0 : length;
      const Point2 through = move({base, 0.0});
      if (!(through.y > p.y)) return std::numeric_limits<double>::quiet_NaN();
      return std::clamp(meets_base(p, through), 0.0, length);
    };
    if (mesh_.twin(left_over) < 0 && mesh_.sibling(left_over) < 0) return;
    begin = meets_side(begin);
    end = meets_side(end);
    near_tail.at = move(near_tail.at);
    near_tip.at = move(near_tip.at);
    mesh_.for_each_beyond(left_over, [&](std::int32_t entered) {
      Beam beam{.half_edge = entered,
                .parent = parent,
                .left_over = left_over,
                .begin = begin,
                .end = end,
                .point = p,
                .near_tail = near_tail,
                .near_tip = near_tip};
      if (mesh_.is_mirrored(left_over, entered)) mirror(beam, length);
      add(beam);
    });
  }

  /// Lists what the best line passes, from its end to the point and then the other way.
  void list_path() {
    IntrinsicPath& path = best_.path;
    path.points.push_back(best_.vertex >= 0 ? PathPoint{.vertex = best_.vertex}
                                            : solved_.sources[best_.source].path_point());
    if (best_.vertex < 0 && best_.path.length == 0) return;  // the point is the source
    Point2 end = end_;
    std::int32_t last = half_edge_;
    for (std::int32_t b = beam_; b >= 0; b = beams_[b].parent) {
      const Beam& beam = beams_[b];
      const double length = mesh_.half_edge(beam.half_edge).length;
      path.faces.push_back(beam.half_edge / 3);
      path.points.push_back(
          {.half_edge = beam.half_edge, .t = std::clamp(meets_base(beam.point, end), beam.begin, beam.end) / length});
      last = beam.left_over;
      if (beam.parent < 0) break;
      if (mesh_.is_mirrored(beam.left_over, beam.half_edge)) end.x = length - end.x;
      const std::int32_t entered = beams_[beam.parent].half_edge;
      const HalfEdge before = mesh_.half_edge(entered);
      end = beam.left_over == previous_in_face(entered) ? from_left(before, end) : from_right(before, end);
    }
    path.faces.push_back(last / 3);
    path.points.push_back(point_.path_point());
    std::ranges::reverse(path.points);
    std::ranges::reverse(path.faces);
  }

  const SolvedDistances& solved_;
  const GeodesicMesh& mesh_;
  const PlacedPoint& point_;
  const Task& task_;
  StraightStart best_;
  std::int32_t beam_ = -1, half_edge_ = -1;  ///< of the best path, where its straight part ends
  Point2 end_{};
  std::vector<Beam> beams_;
  using Entry = std::pair<double, std::int32_t>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue_;  ///< beams, by their lower bounds
  std::size_t work_ = 0;
};

}  // namespace

StraightStart find_straight_start(const SolvedDistances& solved, const PlacedPoint& point, const Task& task) {
  return PointSearch(solved, point, task).run();
}

}  // namespace seamwire::detail
