// SPDX-License-Identifier: GPL-3.0-or-later
#include "geodesics/descent.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <queue>
#include <utility>

#include "detail/half_edge.hpp"
#include "detail/index.hpp"
#include "detail/infinity.hpp"
#include "detail/poll.hpp"
#include "geodesics/triangle_area.hpp"

namespace seamwire::detail {
namespace {

/// A crossing this close to a vertex, in parts of the edge, is the vertex.
constexpr double kAtVertex = 1e-9;
/// A straight line to an end is taken if it is at most this much longer than the value says. Else another end or
/// another way is likely to be nearer.
constexpr double kStraightEnough = 1.1;

bool is_mirrored(const IntrinsicMesh& mesh, std::int32_t h, std::int32_t beyond) {
  return mesh.twins[h] < 0 && mesh.tail(h) == mesh.tail(beyond);
}

/// Where a line leaves a triangle.
struct Exit {
  std::size_t side = 3;  ///< from corner `side` to the next one; 3 if it does not leave
  double t = 0.0, length = 0.0;
};

/// Of the line from a point of the triangle, over any side but those that `skipped` names.
Exit exit_of(const TracingMesh::Corners& corners, const Point2& from, const Point2& direction,
             const std::array<bool, 3>& skipped) {
  Exit exit;
  double soonest = kInfinity;
  for (std::size_t i = 0; i < 3; ++i) {
    if (skipped[i]) continue;
    const Point2 &a = corners[i], &b = corners[(i + 1) % 3];
    const Point2 side{b.x - a.x, b.y - a.y}, to{a.x - from.x, a.y - from.y};
    const double towards = cross(direction, side);
    if (!(towards > 0)) continue;
    const double time = std::max(cross(to, side) / towards, 0.0);
    if (!(time < soonest)) continue;
    soonest = time;
    exit = {.side = i, .t = cross(to, direction) / towards, .length = time * norm(direction)};
  }
  return exit;
}

class Walker {
 public:
  Walker(const TracingMesh& mesh, const std::vector<double>& values, const PathEnds& ends, const Task& task)
      : mesh_(mesh), connectivity_(mesh.mesh()), values_(values), ends_(ends), task_(task) {}

  IntrinsicPath run(const PlacedPoint& from) {
    path_.points.push_back(from.path_point());
    path_.length = 0.0;
    if (from.vertex >= 0) {
      arrive(from.vertex);
    } else {
      start_in_faces(from);
    }
    while (!is_done_) {
      if (++steps_ % Poll::kFewSteps == 0) task_.check(0.0);
      if (at_vertex_ >= 0) {
        leave_vertex();
      } else {
        leave_edge();
      }
    }
    std::ranges::reverse(path_.points);
    std::ranges::reverse(path_.faces);
    return std::move(path_);
  }

 private:
  /// How the path goes on: over a face to a point of an edge, or along an edge to a vertex.
  struct Move {
    double slope = 0.0;  ///< of the descent
    std::int32_t face = -1, half_edge = -1;
    double t = 0.0, length = 0.0;
    std::int32_t vertex = -1;  ///< -1: to `half_edge`
  };

  double at(std::int32_t vertex) const { return values_[index(vertex)]; }
  std::size_t face_of(std::int32_t h) const { return index(h / 3); }

  /// Down the gradient in a face.
  Point2 down(std::int32_t face, const TracingMesh::Corners& corners) const {
    const auto& [a, b, c] = connectivity_.triangles[face];
    const double x = (at(b) - at(a)) / corners[1].x;
    return {-x, -(at(c) - at(a) - x * corners[2].x) / corners[2].y};
  }
  double value_in(std::int32_t face, const std::array<double, 3>& weights) const {
    double sum = 0.0;
    for (std::size_t i = 0; i < 3; ++i) {
      if (weights[i] > 0) sum += weights[i] * at(connectivity_.triangles[face][i]);
    }
    return sum;
  }

  void add(const PathPoint& point, std::int32_t face, double length) {
    path_.points.push_back(point);
    path_.faces.push_back(face);
    path_.length += length;
  }
  void go(const Move& move) {
    if (move.vertex >= 0) {
      add({.vertex = move.vertex}, move.face, move.length);
      arrive(move.vertex);
      return;
    }
    const double t = std::clamp(move.t, 0.0, 1.0);
    const std::int32_t tail = connectivity_.tail(move.half_edge), tip = connectivity_.tip(move.half_edge);
    // So many faces in a row are a mistake of rounding.
    const bool is_lost = ++faces_in_a_row_ > 4 * connectivity_.face_count() + 16;
    if (t <= kAtVertex || t >= 1 - kAtVertex || is_lost) {
      const bool is_tail = is_lost ? at(tail) < at(tip) : t <= kAtVertex;
      const double beyond = is_lost ? (is_tail ? t : 1 - t) * connectivity_.lengths[index(move.half_edge)] : 0.0;
      add({.half_edge = move.half_edge, .t = t}, move.face, move.length);
      if (is_lost) {
        add({.vertex = is_tail ? tail : tip}, move.face, beyond);
      } else {
        path_.points.back() = {.vertex = is_tail ? tail : tip};
      }
      arrive(is_tail ? tail : tip);
      return;
    }
    add({.half_edge = move.half_edge, .t = t}, move.face, move.length);
    at_vertex_ = -1;
    edge_ = move.half_edge;
    t_ = t;
  }
  void finish(const PathEnds::Straight& straight, std::int32_t face) {
    add(straight.end, face, straight.length);
    is_done_ = true;
  }

  /// The path has come to a vertex. If the vertex is not the lowest one so far, the path goes on along edges to a lower
  /// one.
  void arrive(std::int32_t vertex) {
    faces_in_a_row_ = 0;
    at_vertex_ = vertex;
    if (ends_.has_vertex(vertex)) {
      is_done_ = true;
    } else if (at(vertex) < lowest_) {
      lowest_ = at(vertex);
    } else {
      detour();
    }
  }

  /// Along the shortest chain of edges to a vertex below the lowest one, or to one with an end beside it.
  void detour() {
    struct Reached {
      double length;
      std::int32_t from, half_edge;
      double edge;
    };
    std::unordered_map<std::int32_t, Reached> reached{{at_vertex_, {0.0, -1, -1, 0.0}}};
    std::unordered_set<std::int32_t> done;
    using Entry = std::pair<double, std::int32_t>;
    std::priority_queue<Entry, std::vector<Entry>, std::greater<>> open;
    open.emplace(0.0, at_vertex_);
    while (!open.empty()) {
      if (++steps_ % Poll::kFewSteps == 0) task_.check(0.0);
      const auto [length, v] = open.top();
      open.pop();
      if (!done.insert(v).second) continue;
      const bool is_lower = at(v) < lowest_;
      if (is_lower || ends_.has_vertex(v) || ends_.are_around(mesh_, v)) {
        std::vector<std::int32_t> chain;
        for (std::int32_t on = v; on != at_vertex_; on = reached.at(on).from) chain.push_back(on);
        for (auto on = chain.rbegin(); on != chain.rend(); ++on) {
          const Reached& by = reached.at(*on);
          add({.vertex = *on}, by.half_edge < 0 ? -1 : by.half_edge / 3, by.edge);
        }
        at_vertex_ = v;
        lowest_ = std::min(lowest_, at(v));
        is_done_ = ends_.has_vertex(v);
        must_finish_ = !is_lower;
        return;
      }
      const auto see = [&, from = v, so_far = length](std::int32_t to, std::int32_t half_edge, double edge) {
        const Reached by{so_far + edge, from, half_edge, edge};
        const auto [known, is_new] = reached.try_emplace(to, by);
        if (!is_new && !(by.length < known->second.length)) return;
        known->second = by;
        open.emplace(by.length, to);
      };
      for (const std::int32_t h : mesh_.leaving(v)) {
        const std::int32_t back = previous_in_face(h);
        see(connectivity_.tip(h), h, connectivity_.lengths[index(h)]);
        see(connectivity_.tail(back), back, connectivity_.lengths[index(back)]);
      }
      for (const auto& [to, edge] : mesh_.loose(v)) see(to, -1, edge);
    }
    // The value of each vertex of a part with an end is finite, so this is reached by no path.
    path_ = {};
    is_done_ = true;
  }

  void leave_vertex() {
    const std::int32_t v = at_vertex_;
    PathEnds::Straight best_end{kInfinity, {}};
    std::int32_t end_face = -1;
    Move best;
    const auto along = [&](std::int32_t to, std::int32_t face, std::int32_t half_edge, double length) {
      const double slope = (at(v) - at(to)) / length;
      if (length > 0 && slope > best.slope) {
        best = {.slope = slope, .face = face, .half_edge = half_edge, .length = length, .vertex = to};
      }
    };
    for (const std::int32_t h : mesh_.leaving(v)) {
      const std::int32_t face = h / 3, back = previous_in_face(h), across = next_in_face(h);
      const TracingMesh::Corners corners = mesh_.corners(face);
      const auto corner = index(h % 3);
      if (const auto end = ends_.nearest(mesh_, face, corners[corner]); end.length < best_end.length) {
        best_end = end;
        end_face = face;
      }
      along(connectivity_.tip(h), face, h, connectivity_.lengths[index(h)]);
      along(connectivity_.tail(back), face, back, connectivity_.lengths[index(back)]);
      const Point2 direction = down(face, corners);
      const double slope = norm(direction);
      if (!(slope > best.slope) || !std::isfinite(slope)) continue;
      std::array<bool, 3> skipped{true, true, true};
      skipped[index(across % 3)] = false;
      const Exit exit = exit_of(corners, corners[corner], direction, skipped);
      if (exit.side == 3 || !(exit.t > 0 && exit.t < 1)) continue;
      best = {.slope = slope, .face = face, .half_edge = across, .t = exit.t, .length = exit.length};
    }
    for (const auto& [to, length] : mesh_.loose(v)) along(to, -1, -1, length);
    if (best_end.length < kInfinity && (must_finish_ || best_end.length <= kStraightEnough * at(v))) {
      finish(best_end, end_face);
    } else if (best.slope > 0) {
      go(best);
    } else {
      detour();
    }
  }

  /// From the start, a point inside a face or on an edge.
  void start_in_faces(const PlacedPoint& from) {
    at_vertex_ = -1;
    lowest_ = value_in(from.faces.front().face, from.faces.front().weights);
    PathEnds::Straight best_end{kInfinity, {}};
    std::int32_t end_face = -1;
    Move best;
    for (const auto& [face, weights] : from.faces) {
      const TracingMesh::Corners corners = mesh_.corners(face);
      const Point2 here = between(corners, weights);
      if (const auto end = ends_.nearest(mesh_, face, here); end.length < best_end.length) {
        best_end = end;
        end_face = face;
      }
      const Point2 direction = down(face, corners);
      const double slope = norm(direction);
      if (!std::isfinite(slope) || (best.face >= 0 && !(slope > best.slope))) continue;
      std::array<bool, 3> skipped{};
      for (std::size_t i = 0; i < 3; ++i) skipped[i] = weights[(i + 2) % 3] == 0;
      const Exit exit = exit_of(corners, here, direction, skipped);
      if (exit.side == 3 || leaves_at_once(corners, skipped, direction)) continue;
      best = {.slope = slope,
              .face = face,
              .half_edge = 3 * face + static_cast<std::int32_t>(exit.side),
              .t = exit.t,
              .length = exit.length};
    }
    if (best_end.length <= kStraightEnough * lowest_) {
      finish(best_end, end_face);
    } else if (best.face >= 0) {
      go(best);
    } else {
      go(to_lowest_corner(from));
    }
  }

  /// Whether the line leaves the face over a side that its start is on.
  static bool leaves_at_once(const TracingMesh::Corners& corners, const std::array<bool, 3>& sides,
                             const Point2& direction) {
    for (std::size_t i = 0; i < 3; ++i) {
      const Point2 &a = corners[i], &b = corners[(i + 1) % 3];
      if (sides[i] && !(cross(direction, {b.x - a.x, b.y - a.y}) < 0)) return true;
    }
    return false;
  }

  Move to_lowest_corner(const PlacedPoint& from) const {
    Move best;
    double lowest = kInfinity;
    for (const auto& [face, weights] : from.faces) {
      const TracingMesh::Corners corners = mesh_.corners(face);
      const bool is_on_edge = std::ranges::count(weights, 0.0) > 0;
      for (std::size_t i = 0; i < 3; ++i) {
        const std::int32_t v = connectivity_.triangles[face][i];
        if ((is_on_edge && weights[i] == 0) || !(at(v) < lowest)) continue;
        lowest = at(v);
        best = {.face = face, .length = distance(between(corners, weights), corners[i]), .vertex = v};
      }
    }
    return best;
  }

  /// From a point of an edge, which the path has come to over the face of `edge_`.
  void leave_edge() {
    const std::int32_t h = edge_;
    const std::int32_t tail = connectivity_.tail(h), tip = connectivity_.tip(h);
    const double value = (1 - t_) * at(tail) + t_ * at(tip), length = connectivity_.lengths[index(h)];
    PathEnds::Straight best_end{kInfinity, {}};
    std::int32_t end_face = -1;
    const bool is_tail = at(tail) < at(tip);
    Move best{.slope = std::abs(at(tail) - at(tip)) / length,
              .face = h / 3,
              .half_edge = h,
              .length = (is_tail ? t_ : 1 - t_) * length,
              .vertex = is_tail ? tail : tip};
    connectivity_.for_each_beyond(h, [&](std::int32_t other) {
      const std::int32_t face = other / 3;
      const TracingMesh::Corners corners = mesh_.corners(face);
      const auto side = index(other % 3);
      const double t = is_mirrored(connectivity_, h, other) ? t_ : 1 - t_;
      const Point2 &a = corners[side], &b = corners[(side + 1) % 3];
      const Point2 here{(1 - t) * a.x + t * b.x, (1 - t) * a.y + t * b.y};
      if (const auto end = ends_.nearest(mesh_, face, here); end.length < best_end.length) {
        best_end = end;
        end_face = face;
      }
      const Point2 direction = down(face, corners);
      const double slope = norm(direction);
      std::array<bool, 3> skipped{};
      skipped[side] = true;
      if (!std::isfinite(slope) || !(slope >= best.slope) || leaves_at_once(corners, skipped, direction)) return;
      const Exit exit = exit_of(corners, here, direction, skipped);
      if (exit.side == 3) return;
      best = {.slope = slope,
              .face = face,
              .half_edge = 3 * face + static_cast<std::int32_t>(exit.side),
              .t = exit.t,
              .length = exit.length};
    });
    if (best_end.length <= kStraightEnough * value) {
      finish(best_end, end_face);
    } else {
      go(best);
    }
  }

  const TracingMesh& mesh_;
  const IntrinsicMesh& connectivity_;
  const std::vector<double>& values_;
  const PathEnds& ends_;
  const Task& task_;

  IntrinsicPath path_;
  std::int32_t at_vertex_ = -1;  // -1: on `edge_`
  std::int32_t edge_ = -1;
  double t_ = 0.0;
  double lowest_ = kInfinity;  // of the vertices so far
  bool must_finish_ = false;   // straight to an end beside the vertex
  bool is_done_ = false;
  std::size_t faces_in_a_row_ = 0, steps_ = 0;
};

}  // namespace

TracingMesh::TracingMesh(const IntrinsicMesh& mesh, const Task& task) {
  mesh_.vertex_count = mesh.vertex_count;
  mesh_.triangles = copied(mesh.triangles, task, 0.0);
  mesh_.twins = copied(mesh.twins, task, 0.0);
  mesh_.siblings = copied(mesh.siblings, task, 0.0);
  mesh_.lengths = copied(mesh.lengths, task, 0.0);
  mesh_.loose_edges = copied(mesh.loose_edges, task, 0.0);
  mesh_.areas = copied(mesh.areas, task, 0.0);
  Poll poll(task, 0.0, 1.0, 2 * mesh_.triangles.size());
  leaving_ = Csr<std::int32_t>(index(mesh_.vertex_count), [&](const auto& visit) {
    std::int32_t h = 0;
    for (const Triangle& triangle : mesh_.triangles) {
      poll.next();
      for (const std::int32_t v : triangle) visit(v, h++);
    }
  });
  loose_ = Csr<Loose>(index(mesh_.vertex_count), [&](const auto& visit) {
    for (const LooseEdge& edge : mesh_.loose_edges) {
      visit(edge.a, {edge.b, edge.length});
      visit(edge.b, {edge.a, edge.length});
    }
  });
}

TracingMesh::Corners TracingMesh::corners(std::int32_t face) const {
  const double* lengths = &mesh_.lengths[3 * index(face)];
  const double a = lengths[0], b = lengths[1], c = lengths[2];
  const double area = mesh_.areas.empty() ? 0.0 : mesh_.areas[face];
  const double four = area > 0 ? 4 * area : four_areas(a, b, c);
  return {{{0.0, 0.0}, {a, 0.0}, {(a * a + c * c - b * b) / (2 * a), four / (2 * a)}}};
}

PlacedPoint TracingMesh::place(const SurfacePoint& point, const std::string& what) const {
  if (point.vertex >= 0) {
    check_index(point.vertex, index(mesh_.vertex_count), what + ": vertex");
    return PlacedPoint::at_vertex(point.vertex);
  }
  check_index(point.face, mesh_.face_count(), what + ": face", "faces");
  const std::array<double, 3> weights = checked_barycentric(point.barycentric, what);
  PlacedPoint placed{.vertex = -1, .faces = {{point.face, weights}}};
  for (std::int32_t i = 0; i < 3; ++i) {
    const double at_tail = weights[index(i)], at_tip = weights[index((i + 1) % 3)];
    if (weights[index((i + 2) % 3)] > 0) continue;
    const std::int32_t h = 3 * point.face + i;
    if (at_tip == 0) return PlacedPoint::at_vertex(mesh_.tail(h));
    if (at_tail == 0) return PlacedPoint::at_vertex(mesh_.tip(h));
    mesh_.for_each_beyond(h, [&](std::int32_t other) {
      const bool mirrored = is_mirrored(mesh_, h, other);
      std::array<double, 3> beyond{};
      beyond[index(other % 3)] = mirrored ? at_tail : at_tip;
      beyond[index(next_in_face(other) % 3)] = mirrored ? at_tip : at_tail;
      placed.faces.push_back({other / 3, beyond});
    });
  }
  return placed;
}

PathEnds::PathEnds(std::vector<PlacedPoint> points) : points_(std::move(points)) {
  for (std::size_t k = 0; k < points_.size(); ++k) {
    if (points_[k].vertex >= 0) vertices_.insert(points_[k].vertex);
    for (const auto& [face, weights] : points_[k].faces) in_face_[face].push_back(k);
  }
}

PathEnds::Straight PathEnds::nearest(const TracingMesh& mesh, std::int32_t face, const Point2& from) const {
  Straight nearest{kInfinity, {}};
  const TracingMesh::Corners corners = mesh.corners(face);
  const auto see = [&](const Point2& place, const PathPoint& end) {
    if (const double length = distance(from, place); length < nearest.length) nearest = {length, end};
  };
  for (std::size_t i = 0; i < 3; ++i) {
    const std::int32_t v = mesh.mesh().triangles[face][i];
    if (has_vertex(v)) see(corners[i], {.vertex = v});
  }
  if (const auto found = in_face_.find(face); found != in_face_.end()) {
    for (const std::size_t k : found->second) {
      for (const auto& [on, weights] : points_[k].faces) {
        if (on == face) see(between(corners, weights), points_[k].path_point());
      }
    }
  }
  return nearest;
}

bool PathEnds::are_around(const TracingMesh& mesh, std::int32_t vertex) const {
  return std::ranges::any_of(mesh.leaving(vertex), [&](std::int32_t h) {
    return in_face_.contains(h / 3) ||
           std::ranges::any_of(mesh.mesh().triangles[h / 3], [&](std::int32_t v) { return has_vertex(v); });
  });
}

IntrinsicPath descend(const TracingMesh& mesh, const std::vector<double>& values, const PathEnds& ends,
                      const PlacedPoint& from, const Task& task) {
  const std::int32_t any = from.vertex >= 0 ? from.vertex : mesh.mesh().triangles[from.faces.front().face][0];
  if (std::isinf(values[any])) return {};
  return Walker(mesh, values, ends, task).run(from);
}

}  // namespace seamwire::detail
