// SPDX-License-Identifier: GPL-3.0-or-later
//
// Paths from one record a vertex. A record says over which half-edge the shortest path arrives, and where its source
// lies when unfolded into that half-edge's frame. That is all a straight line needs: unfold triangle after triangle
// towards the source and see on which side of the line each apex lies. At the source its own record takes over.
#include "geodesics/path_tracing.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <queue>
#include <unordered_map>
#include <unordered_set>
#include <utility>
#include <vector>

#include "detail/infinity.hpp"
#include "geodesics/wavefront.hpp"

namespace seamwire::detail {
namespace {

using HalfEdge = GeodesicMesh::HalfEdge;

/// A line that passes a vertex this close (in parts of the triangle's base) may as well go through it, ...
constexpr double kSnapWidth = 1e-7;
/// ... if the distances say so, up to this part of the whole. The other side of such a vertex would be a guess.
constexpr double kSnapDistance = 1e-11;
/// How far (in parts of the triangle's longest side) unfolding may have moved the source from its vertex.
constexpr double kSameVertex = 1e-6;
/// A vertex is as near to a source as another one up to this factor.
constexpr double kAsNear = 1.0 + 1e-6;

/// Triangles that a path crosses, or vertices that a detour reaches, between two looks at the task: about a millisecond
/// at most. Most paths are shorter.
constexpr std::size_t kCrossingsBetweenChecks = 4096;

Point2 to_twin(const HalfEdge& h, const Point2& p) { return {h.length - p.x, -p.y}; }

/// Where the segment from p (below) to q (above) meets the base.
double crossing(const HalfEdge& h, const Point2& p, const Point2& q) {
  return std::clamp(p.x + (q.x - p.x) * (-p.y / (q.y - p.y)), 0.0, h.length);
}

/// Walks from a vertex back to a source, and lists what it passes.
class Tracer {
 public:
  Tracer(const SolvedDistances& solved, const std::vector<TraceRecord>& records,
         const std::vector<SiblingCrossing>& crossings, const Task& task)
      : mesh_(solved.mesh),
        distances_(solved.distances),
        sources_(solved.sources),
        records_(records),
        crossings_(crossings),
        task_(task) {}

  /// On from a path that ends at the vertex.
  IntrinsicPath run(std::int32_t vertex, IntrinsicPath path) {
    path_ = std::move(path);
    while (!is_point(vertex)) {
      look_at_task();
      const TraceRecord& record = records_[static_cast<std::size_t>(vertex)];
      if (record.half_edge == TraceRecord::kNone) break;
      if (record.half_edge >= 0 && record.y >= 0) {
        add_source(record.source, record.half_edge, at(vertex));
        break;
      }
      if (record.half_edge >= 0) {
        vertex = follow(vertex, record);
      } else {
        const bool is_loose = record.half_edge == TraceRecord::kLooseEdge;
        add_vertex(record.source, is_loose ? -1 : ~record.half_edge, record.x);
        vertex = record.source;
      }
    }
    std::reverse(path_.points.begin(), path_.points.end());
    std::reverse(path_.faces.begin(), path_.faces.end());
    return std::move(path_);
  }

 private:
  /// What to do about vertices beside the line. They are asked for rarely, and their distances lie all over memory.
  enum class Beside : std::uint8_t { kSkip, kRemember };

  /// A vertex beside the line, from which to go on if the line leads nowhere; with the path's state when it was passed.
  struct Passed {
    /// Of the whole path over it.
    double length = kInfinity;
    std::int32_t vertex = -1, half_edge = -1;
    double segment = 0.0, path_length = 0.0;
    std::size_t points = 0;
  };

  /// A chain of edges, on which the path goes on, and the length of the whole path along it; without edges, infinite.
  struct Detour {
    struct Edge {
      std::int32_t to = -1, half_edge = -1;
      double length = 0.0;
    };
    double length = kInfinity;
    std::vector<Edge> edges;
  };

  /// Whether what a record names is a point in a face, no vertex.
  bool is_point(std::int32_t source) const { return source >= static_cast<std::int32_t>(mesh_.vertex_count()); }
  /// The crossing that a path last came over; nullptr where it came over none.
  const SiblingCrossing* last_crossing(std::int32_t source) const {
    const std::size_t before = mesh_.vertex_count() + sources_.points().size();
    return static_cast<std::size_t>(source) < before ? nullptr : &crossings_[static_cast<std::size_t>(source) - before];
  }
  /// The vertex or the point where a path began, whichever crossings it came over.
  std::int32_t origin(std::int32_t source) const {
    while (const SiblingCrossing* last = last_crossing(source)) source = last->source;
    return source;
  }
  /// The sibling of h over which the face left is entered, back towards `source`; -1 if the line leads nowhere.
  /// `source` becomes what the path came from before.
  std::int32_t sibling_entered(std::int32_t h, std::int32_t& source) const {
    const SiblingCrossing* last = last_crossing(source);
    std::int32_t entered = -1;
    if (last != nullptr) {
      mesh_.for_each_beyond(h, [&](std::int32_t other) { entered = other == last->half_edge ? other : entered; });
    }
    if (entered >= 0) source = last->source;
    return entered;
  }
  const PlacedPoint& point(std::int32_t source) const {
    return sources_[source - static_cast<std::int32_t>(mesh_.vertex_count())];
  }
  /// Whether the source at `place` in the frame of h is a point of that half-edge's face, and not another one's image.
  bool is_in_face(std::int32_t source, std::int32_t h, const Point2& place) const {
    if (!is_point(source)) return false;
    const HalfEdge edge = mesh_.half_edge(h);
    return std::ranges::any_of(point(source).faces, [&](const PlacedPoint::InFace& in) {
      return in.face == h / 3 &&
             distance(position(mesh_, h, in.weights), place) <= kSameVertex * std::max(edge.length, edge.left_length);
    });
  }

  void look_at_task() {
    if (++work_ % kCrossingsBetweenChecks == 0) task_.check(0.0);
  }

  double at(std::int32_t vertex) const { return distances_[static_cast<std::size_t>(mesh_.external_vertex(vertex))]; }

  void add_segment(std::int32_t half_edge, double length) {
    path_.faces.push_back(half_edge < 0 ? -1 : half_edge / 3);
    path_.length += length;
  }
  void add_vertex(std::int32_t vertex, std::int32_t half_edge, double length) {
    add_segment(half_edge, length);
    path_.points.push_back({.vertex = vertex});
  }
  void add_source(std::int32_t source, std::int32_t half_edge, double length) {
    add_segment(half_edge, length);
    path_.points.push_back(point(source).path_point());
  }
  void add_crossing(std::int32_t half_edge, double x, std::int32_t behind, double length) {
    add_segment(behind, length);
    path_.points.push_back({.half_edge = half_edge, .t = x / mesh_.half_edge(half_edge).length});
  }

  /// From `vertex` towards its source, to the vertex that is returned, or to the source if that is a point in a face.
  /// Where the line leads nowhere, over a vertex beside it or along edges, whichever way is shorter.
  std::int32_t follow(std::int32_t vertex, const TraceRecord& record) {
    const auto length = path_.length;
    const auto points = path_.points.size(), faces = path_.faces.size();
    const auto go_back = [&] {
      path_.points.resize(points);
      path_.faces.resize(faces);
      path_.length = length;
    };
    if (const std::int32_t next = follow_line(vertex, record, Beside::kSkip); next >= 0) return next;
    go_back();
    const Detour along_edges = find_detour(vertex);
    if (const std::int32_t next = follow_line(vertex, record, Beside::kRemember);
        next >= 0 && best_.length - length <= along_edges.length) {
      return next;
    }
    go_back();
    if (along_edges.edges.empty()) return end_line(vertex, record);
    for (const Detour::Edge& edge : along_edges.edges) add_vertex(edge.to, edge.half_edge, edge.length);
    return along_edges.edges.back().to;
  }

  /// From `vertex` to its source in one segment, whatever is between them. Used if no vertex is nearer to the source.
  /// The source is then a point in a face, or it is as near as the vertex itself.
  std::int32_t end_line(std::int32_t vertex, const TraceRecord& record) {
    const std::int32_t source = origin(record.source);
    if (is_point(source)) {
      add_source(source, record.half_edge, at(vertex));
    } else {
      add_vertex(source, record.half_edge, at(vertex) - at(source));
    }
    return source;
  }

  /// From `vertex` straight towards its source. Returns the vertex to go on from: the source, or one on the way; where
  /// the line leads nowhere the best one beside it that was remembered, or -1.
  std::int32_t follow_line(std::int32_t vertex, const TraceRecord& record, Beside beside) {
    const HalfEdge first = mesh_.half_edge(record.half_edge);
    Point2 from{first.apex_x, first.apex_y}, source{record.x, record.y};
    best_ = {};
    for (const std::int32_t side : {0, 1}) {
      const Point2 corner{side == 0 ? 0.0 : first.length, 0.0};
      const std::int32_t u = side == 0 ? first.tail : first.tip;
      if (passes(vertex, u, corner, from, source, from, record.half_edge, first.length, beside)) return take_best();
    }

    // `h` is the half-edge entered, `left` the one of the triangle left, and `behind` the one that was entered by;
    // `here` is the last point, in h's frame.
    std::int32_t behind = record.half_edge, left = record.half_edge, coming_from = record.source;
    const std::int32_t begin = origin(record.source);
    std::int32_t h = mesh_.twin(left);
    Point2 here = to_twin(first, from);
    from = here;
    source = to_twin(first, source);
    const auto enter_sibling = [&] {
      h = sibling_entered(left, coming_from);
      if (h < 0 || !mesh_.is_mirrored(left, h)) return;
      for (Point2* p : {&from, &source, &here}) p->x = mesh_.half_edge(h).length - p->x;
    };
    if (h < 0) enter_sibling();
    // A straight line crosses no triangle twice unless it winds around a cone; this many crossings are a mistake.
    std::size_t crossings_left = 16 * mesh_.half_edge_count();
    while (h >= 0 && (source.y > 0 || is_in_face(begin, h, source)) && crossings_left-- > 0) {
      look_at_task();
      const HalfEdge edge = mesh_.half_edge(h);
      if (edge.left >= 0) mesh_.prefetch_half_edge(edge.left);
      if (edge.right >= 0) mesh_.prefetch_half_edge(edge.right);
      const double x = crossing(edge, from, source);
      add_crossing(h, x, behind, distance(here, {x, 0.0}));
      here = {x, 0.0};
      if (is_in_face(begin, h, source)) {
        add_source(begin, h, distance(here, source));
        return begin;
      }
      const Point2 apex{edge.apex_x, edge.apex_y};
      if (edge.apex == begin && distance(apex, source) <= kSameVertex * std::max(edge.length, edge.left_length)) {
        add_vertex(edge.apex, h, distance(here, apex));
        return edge.apex;
      }
      if (passes(vertex, edge.apex, apex, from, source, here, h, edge.length, beside)) return take_best();
      const bool apex_is_left = cross({source.x - from.x, source.y - from.y}, {apex.x - from.x, apex.y - from.y}) > 0;
      behind = h;
      left = apex_is_left ? next_in_face(behind) : previous_in_face(behind);
      h = apex_is_left ? edge.right : edge.left;
      const auto move = [&](const Point2& p) { return apex_is_left ? to_right(edge, p) : to_left(edge, p); };
      from = move(from);
      source = move(source);
      here = move(here);
      if (h < 0) enter_sibling();
    }
    return beside == Beside::kSkip || best_.vertex < 0 ? -1 : take_best();
  }

  /// True if the line is as good as through the vertex u. Else u is remembered, if that is asked for and it is the best
  /// so far.
  bool passes(std::int32_t vertex, std::int32_t u, const Point2& at_u, const Point2& from, const Point2& source,
              const Point2& here, std::int32_t half_edge, double base, Beside beside) {
    const Point2 line{source.x - from.x, source.y - from.y}, aside{at_u.x - from.x, at_u.y - from.y};
    const bool is_near = std::abs(cross(line, aside)) <= kSnapWidth * base * norm(line);
    if ((!is_near && beside == Beside::kSkip) || !(at(u) < at(vertex))) return false;
    const double segment = distance(here, at_u);
    const Passed candidate{path_.length + segment + at(u), u, half_edge, segment, path_.length, path_.points.size()};
    if (candidate.length < best_.length) best_ = candidate;
    // By way of `here`: where triangles are thin, the line may have passed a vertex that is near to it already.
    const double over_u = distance(from, here) + segment + at(u);
    if (!is_near || std::abs(over_u - at(vertex)) > kSnapDistance * at(vertex)) return false;
    best_ = candidate;
    return true;
  }

  std::int32_t take_best() {
    path_.points.resize(best_.points);
    path_.faces.resize(best_.points - 1);
    path_.length = best_.path_length;
    add_vertex(best_.vertex, best_.half_edge, best_.segment);
    return best_.vertex;
  }

  /// Whether a vertex is a source, or the corner of a face with one that it is reached from straight.
  bool is_beside_source(std::int32_t vertex) const {
    const TraceRecord& record = records_[static_cast<std::size_t>(vertex)];
    return record.half_edge == TraceRecord::kNone || (record.half_edge >= 0 && record.y >= 0);
  }

  /// Along edges to the next vertex that is nearer to the source, or as near and not yet tried, if there is one. Lines
  /// lead nowhere where triangles are so thin that unfolding one moves the source by more than their width, and perhaps
  /// among stretched windows.
  Detour find_detour(std::int32_t vertex) {
    tried_.insert(vertex);
    struct Reached {
      double length;
      std::int32_t from;
      Detour::Edge edge;
    };
    std::unordered_map<std::int32_t, Reached> reached{{vertex, {0.0, -1, {}}}};
    std::unordered_set<std::int32_t> done;
    using Entry = std::pair<double, std::int32_t>;
    std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;  // by the length of the whole path
    queue.emplace(at(vertex), vertex);
    std::int32_t next = -1;
    while (next < 0) {
      look_at_task();
      if (queue.empty()) return {};
      const auto [whole, v] = queue.top();
      queue.pop();
      if (!done.insert(v).second) continue;
      const bool is_as_near = whole <= kAsNear * at(vertex) && !tried_.contains(v);
      if (at(v) < at(vertex) || is_as_near || is_beside_source(v)) next = v;
      const double so_far = reached.at(v).length;
      mesh_.for_each_edge(v, [&, from = v](std::int32_t to, std::int32_t half_edge, double length) {
        const Reached by_edge{so_far + length, from, {to, half_edge, length}};
        const auto [known, is_new] = reached.try_emplace(to, by_edge);
        if (!is_new && !(by_edge.length < known->second.length)) return;
        known->second = by_edge;
        queue.emplace(by_edge.length + at(to), to);
      });
    }
    tried_.insert(next);
    Detour detour{.length = reached.at(next).length + at(next), .edges = {}};
    for (std::int32_t v = next; v != vertex; v = reached.at(v).from) detour.edges.push_back(reached.at(v).edge);
    std::ranges::reverse(detour.edges);
    return detour;
  }

  const GeodesicMesh& mesh_;
  const std::vector<double>& distances_;
  const SourcePoints& sources_;
  const std::vector<TraceRecord>& records_;
  const std::vector<SiblingCrossing>& crossings_;
  const Task& task_;
  std::size_t work_ = 0;  ///< triangles crossed and vertices passed
  IntrinsicPath path_;
  Passed best_;
  std::unordered_set<std::int32_t> tried_;  ///< vertices that detours began or ended at
};

}  // namespace

IntrinsicPath trace_records(const SolvedDistances& solved, const std::vector<TraceRecord>& records,
                            const std::vector<SiblingCrossing>& crossings, const PlacedPoint& target,
                            const Task& task) {
  if (target.vertex >= 0) {
    return Tracer(solved, records, crossings, task)
        .run(target.vertex, {.points = {{.vertex = target.vertex}}, .faces = {}, .length = 0});
  }
  StraightStart start = find_straight_start(solved, target, task);
  if (start.vertex < 0) {
    std::reverse(start.path.points.begin(), start.path.points.end());
    std::reverse(start.path.faces.begin(), start.path.faces.end());
    return std::move(start.path);
  }
  return Tracer(solved, records, crossings, task).run(start.vertex, std::move(start.path));
}

IntrinsicPath shorten(const GeodesicMesh& mesh, SubmeshCutter& cutter, const IntrinsicPath& path,
                      const PlacedPoint& source, const PlacedPoint& target, const Task& task) {
  std::vector<std::int32_t> vertices;
  for (const PathPoint& point : path.points) {
    if (point.vertex >= 0) vertices.push_back(point.vertex);
    if (point.half_edge < 0) continue;
    vertices.push_back(mesh.half_edge(point.half_edge).tail);
    vertices.push_back(mesh.half_edge(point.half_edge).tip);
  }
  for (const PlacedPoint* end : {&source, &target}) {
    if (end->vertex >= 0) vertices.push_back(end->vertex);
    for (const auto& [face, weights] : end->faces) {
      for (std::int32_t h = 3 * face; h < 3 * face + 3; ++h) vertices.push_back(mesh.half_edge(h).tail);
    }
  }
  const Submesh part = cutter.cut(vertices);
  const SourcePoints sources({to_part(cutter, source)});
  const WavefrontResult result = propagate_wavefront(*part.mesh, sources, {}, task);
  IntrinsicPath shorter = trace_records({*part.mesh, result.distances, sources}, result.records, result.crossings,
                                        to_part(cutter, target), task);
  to_whole_mesh(part, shorter);
  return shorter;
}

PlacedPoint to_part(const SubmeshCutter& cutter, PlacedPoint point) {
  if (point.vertex >= 0) point.vertex = cutter.part_vertex(point.vertex);
  for (PlacedPoint::InFace& in : point.faces) in.face = cutter.part_face(in.face);
  return point;
}

void to_whole_mesh(const Submesh& part, IntrinsicPath& path) {
  for (PathPoint& point : path.points) {
    if (point.vertex >= 0) point.vertex = part.vertices[static_cast<std::size_t>(point.vertex)];
    if (point.face >= 0) point.face = part.faces[static_cast<std::size_t>(point.face)];
    if (point.half_edge < 0) continue;
    point.half_edge = 3 * part.faces[static_cast<std::size_t>(point.half_edge / 3)] + point.half_edge % 3;
  }
  for (std::int32_t& face : path.faces) {
    if (face >= 0) face = part.faces[static_cast<std::size_t>(face)];
  }
}

void to_external(const GeodesicMesh& mesh, IntrinsicPath& path) {
  for (PathPoint& point : path.points) {
    if (point.vertex >= 0) point.vertex = mesh.external_vertex(point.vertex);
    if (point.half_edge >= 0) point.half_edge = mesh.external_half_edge(point.half_edge);
    if (point.face >= 0) point.face = mesh.external_half_edge(3 * point.face) / 3;
  }
  for (std::int32_t& face : path.faces) {
    if (face >= 0) face = mesh.external_half_edge(3 * face) / 3;
  }
}

}  // namespace seamwire::detail
