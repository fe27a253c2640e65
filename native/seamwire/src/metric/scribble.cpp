// SPDX-License-Identifier: GPL-3.0-or-later
//
// Section 5 of Zhuang, Zou, Carr, Ju, "Anisotropic geodesics for live-wire mesh segmentation" (2014).
#include "seamwire/metric/scribble.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "detail/index.hpp"
#include "detail/infinity.hpp"
#include "detail/poll.hpp"
#include "detail/text.hpp"
#include "metric/metric_check.hpp"
#include "metric/scribble_points.hpp"
#include "metric/tangent_frame.hpp"
#include "surface/corner_fans.hpp"
#include "surface/exact_unit.hpp"
#include "surface/point_segment.hpp"

namespace seamwire {

using namespace detail;

namespace {

/// Values for some of the numbers below `size`, all of which can be forgotten at once, in constant time.
class EpochMap {
 public:
  explicit EpochMap(std::size_t size) : slots_(size) {}
  void clear() { ++epoch_; }
  bool has(std::int32_t i) const { return slots_[i].epoch == epoch_; }
  std::uint32_t at(std::int32_t i) const { return slots_[i].value; }
  void set(std::int32_t i, std::size_t value) { slots_[i] = {epoch_, static_cast<std::uint32_t>(value)}; }

 private:
  struct Slot {
    std::uint32_t epoch = 0, value = 0;
  };
  std::vector<Slot> slots_;
  std::uint32_t epoch_ = 1;
};

// A point may be this far from its face, as a fraction of the model's longest side: a smoothed stroke leaves the faces
// a little, coordinates of another space are far off.
constexpr double kOffMesh = 0.05;
// The chain of vertices between two points may leave the line by that line's length, and by this many edges.
constexpr double kCorridor = 4.0;
// A segment that stays this close to a triangle's edge, in barycentric coordinates, is not inside.
constexpr double kInside = 1e-6;
// A projected direction shorter than this fraction of the original does not count as a direction.
constexpr double kNoDirection = 1e-6;

std::string name(std::size_t scribble) { return "scribble " + std::to_string(scribble); }

/// The surroundings of a vertex.
class Neighbors {
 public:
  explicit Neighbors(const Surface& surface) : surface_(surface) {
    for (const auto& [a, b] : surface.loose_edges()) loose_.insert(loose_.end(), {{a, b}, {b, a}});
    std::sort(loose_.begin(), loose_.end());
  }

  /// The vertices that an edge joins to it, of a triangle or without one.
  template <class Visit>
  void vertices(std::int32_t v, const Visit& visit) const {
    const CornerFans& mesh = corner_fans(surface_);
    fans(v, [&](std::int32_t fan) {
      mesh.for_each_leaving_clockwise(
          fan, [&](std::int32_t h) { visit(mesh.vertices[mesh.tip(h)]); },
          [&](std::int32_t last) { visit(mesh.vertices[last]); });
    });
    for (auto edge = std::lower_bound(loose_.begin(), loose_.end(), Edge{v, -1});
         edge != loose_.end() && (*edge)[0] == v; ++edge) {
      visit((*edge)[1]);
    }
  }
  /// The triangles of which it is a corner.
  template <class Visit>
  void triangles(std::int32_t v, const Visit& visit) const {
    const CornerFans& mesh = corner_fans(surface_);
    fans(v, [&](std::int32_t fan) {
      const auto visit_triangle = [&](std::int32_t h) {
        const auto& [a, b, c] = mesh.triangles[h / 3];
        visit(Triangle{mesh.vertices[a], mesh.vertices[b], mesh.vertices[c]});
      };
      mesh.for_each_leaving_clockwise(fan, visit_triangle, [](std::int32_t) {});
    });
  }

 private:
  template <class Visit>
  void fans(std::int32_t v, const Visit& visit) const {
    const auto& vertex_of_fan = corner_fans(surface_).vertices;
    const auto [first, last] = std::equal_range(vertex_of_fan.begin(), vertex_of_fan.end(), v);
    for (auto fan = first; fan != last; ++fan) {
      visit(static_cast<std::int32_t>(fan - vertex_of_fan.begin()));
    }
  }

  const Surface& surface_;
  std::vector<Edge> loose_;
};

double distance_to_triangle(const Vector& p, const Vector& a, const Vector& b, const Vector& c) {
  const Vector normal = (b - a).cross(c - a);
  const double height = normal.norm();
  const bool is_above = height > 0 && (b - a).cross(p - a).dot(normal) >= 0 && (c - b).cross(p - b).dot(normal) >= 0 &&
                        (a - c).cross(p - c).dot(normal) >= 0;
  if (is_above) return std::abs((p - a).dot(normal)) / height;
  return std::min({to_segment(p, a, b).norm(), to_segment(p, b, c).norm(), to_segment(p, c, a).norm()});
}

// Whether a segment, seen from above a triangle and no further from it than it is wide, runs through its inside.
bool crosses(const std::array<Vector, 2>& segment, const std::array<Vector, 3>& triangle) {
  const Vector normal = (triangle[1] - triangle[0]).cross(triangle[2] - triangle[0]);
  const double squared = normal.squaredNorm();
  if (!(squared > 0)) return false;
  // Barycentric coordinates of the segment's ends, and the part of it where none is negative.
  std::array<std::array<double, 3>, 2> at;
  for (std::size_t end = 0; end < 2; ++end) {
    for (std::size_t i = 0; i < 3; ++i) {
      const Vector &a = triangle[(i + 1) % 3], &b = triangle[(i + 2) % 3];
      at[end][i] = (b - a).cross(segment[end] - a).dot(normal) / squared;
    }
  }
  double first = 0, last = 1;
  for (std::size_t i = 0; i < 3; ++i) {
    const double from = at[0][i], to = at[1][i];
    if (from < 0 && to < 0) return false;
    if (from < 0) first = std::max(first, from / (from - to));
    if (to < 0) last = std::min(last, from / (from - to));
  }
  if (!(first < last)) return false;
  const double middle = (first + last) / 2;
  for (std::size_t i = 0; i < 3; ++i) {
    if (!((1 - middle) * at[0][i] + middle * at[1][i] > kInside)) return false;
  }
  const Vector p = (1 - middle) * segment[0] + middle * segment[1] - triangle[0];
  const double wide = std::max({(triangle[1] - triangle[0]).squaredNorm(), (triangle[2] - triangle[1]).squaredNorm(),
                                (triangle[0] - triangle[2]).squaredNorm()});
  const double off = p.dot(normal);
  return off * off <= wide * squared;
}

class DrawnLine {
 public:
  explicit DrawnLine(const std::vector<Vector>& points) : points_(points), at_(points.size(), 0.0) {
    for (std::size_t i = 1; i < points.size(); ++i) at_[i] = at_[i - 1] + (points[i] - points[i - 1]).norm();
    is_closed_ = points.size() > 2 && points.front() == points.back();
  }

  struct Foot {
    double distance = kInfinity;
    double at = 0;  ///< length along the line
    std::size_t segment = 0;
  };

  std::size_t segment_count() const { return points_.empty() ? 0 : points_.size() - 1; }
  double length() const { return at_.empty() ? 0 : at_.back(); }
  Foot foot(const Vector& p, std::size_t segment) const {
    const Vector &a = points_[segment], &b = points_[segment + 1];
    const double t = nearest_on_segment(p, a, b);
    return {(p - (a + t * (b - a))).norm(), at_[segment] + t * (at_[segment + 1] - at_[segment]), segment};
  }
  /// The nearest point near a segment: downhill from there.
  Foot foot_near(const Vector& p, std::size_t segment) const {
    Foot best = foot(p, segment);
    for (const bool forward : {true, false}) {
      const auto next = [&](std::size_t i) -> std::size_t {
        if (forward) return i + 1 < segment_count() ? i + 1 : is_closed_ ? 0 : i;
        return i > 0 ? i - 1 : is_closed_ ? segment_count() - 1 : i;
      };
      for (std::size_t i = next(segment); i != segment; i = next(i)) {
        const Foot there = foot(p, i);
        if (!(there.distance < best.distance)) break;
        best = there;
      }
    }
    return best;
  }
  /// From `half` before to `half` behind a point of the line: its direction there, without the hand's trembling.
  Vector chord(double at, double half) const {
    if (is_closed_) half = std::min(half, length() / 4);
    return point(at + half) - point(at - half);
  }

 private:
  Vector point(double at) const {
    if (is_closed_ && at < 0) at += length();
    if (is_closed_ && at > length()) at -= length();
    at = std::clamp(at, 0.0, length());
    const auto after = std::upper_bound(at_.begin(), at_.end(), at);
    if (after == at_.end()) return points_.back();
    const auto i = static_cast<std::size_t>(after - at_.begin());
    return points_[i - 1] + (at - at_[i - 1]) / (at_[i] - at_[i - 1]) * (points_[i] - points_[i - 1]);
  }

  const std::vector<Vector>& points_;
  std::vector<double> at_;  // length of the line up to each point
  bool is_closed_ = false;
};

/// A vertex near the stroke.
struct Reached {
  std::int32_t vertex;
  DrawnLine::Foot foot;
  Vector direction;  // unit, tangent
};

class Scribbler {
 public:
  Scribbler(const Surface& surface, Metric& metric, const Task& task)
      : surface_(surface),
        metric_(metric),
        unit_(exact_unit(surface)),
        neighbors_(surface),
        marks_(surface.vertex_count()),
        poll_(task, 1.0, 1.0, 1, Poll::kFewSteps) {}

  void apply(const Scribble& given) {
    Scribble scribble = given;
    for (Vector& p : scribble.points) p *= unit_;
    if (scribble.radius) *scribble.radius *= unit_;
    const DrawnLine line(scribble.points);
    if (!(line.length() > 0)) return;
    std::vector<Reached> ring = along(given, scribble.points, line);
    marks_.clear();
    std::size_t known = 0;
    for (const Reached& reached : ring) {
      marks_.set(reached.vertex, known++);
      set(scribble, reached, 1);
    }
    for (int r = 1; !ring.empty() && (scribble.radius || r < scribble.rings); ++r) {
      ring = next_ring(ring, line, known);
      known += ring.size();
      if (scribble.radius) std::erase_if(ring, [&](const Reached& v) { return v.foot.distance >= *scribble.radius; });
      for (const Reached& reached : ring) {
        set(scribble, reached,
            1 - (scribble.radius ? reached.foot.distance / *scribble.radius : static_cast<double>(r) / scribble.rings));
      }
    }
  }

 private:
  /// In the unit of exact_unit(), as all lengths here.
  Vector point(std::int32_t v) const { return unit_ * surface_.points()[v]; }

  std::vector<std::int32_t> join(std::int32_t from, std::int32_t to, const DrawnLine& line, std::size_t segment) {
    const auto neighbors = [this](std::int32_t v, const auto& visit) {
      poll_.next();
      neighbors_.vertices(v, visit);
    };
    return chain_along(
        from, to, {.slack = (point(to) - point(from)).norm(), .edges = kCorridor},
        [this](std::int32_t v) { return point(v); }, neighbors,
        [&](std::int32_t v) { return line.foot(point(v), segment).distance; });
  }

  // The corners of the triangles that the stroke crosses, and the vertices it runs along, each once. All corners count,
  // not only the nearest ones. If the tensors at the corners of a triangle differ, the metric in it follows neither of
  // them, and the wire would leave the stroke by most of an edge.
  std::vector<Reached> along(const Scribble& given, const std::vector<Vector>& points, const DrawnLine& line) {
    std::vector<Reached> reached;
    std::vector<std::pair<std::int32_t, std::size_t>> found;  // a vertex and the segment it was found for
    for (std::size_t i = 0; i < line.segment_count(); ++i) {
      const std::int32_t from = nearest_vertex(surface_, given, i), to = nearest_vertex(surface_, given, i + 1);
      std::vector<std::int32_t> chain = join(from, to, line, i);
      if (chain.empty()) chain = {from, to};
      const std::array segment{points[i], points[i + 1]};
      for (const std::int32_t v : chain) {
        poll_.next();
        found.emplace_back(v, i);
        neighbors_.triangles(v, [&](const Triangle& t) {
          if (!crosses(segment, {point(t[0]), point(t[1]), point(t[2])})) return;
          for (const std::int32_t corner : t) found.emplace_back(corner, i);
        });
      }
    }
    marks_.clear();
    for (const auto& [v, segment] : found) {
      poll_.next();
      const DrawnLine::Foot foot = line.foot_near(point(v), segment);
      if (!marks_.has(v)) {
        marks_.set(v, reached.size());
        reached.push_back({v, foot, Vector::Zero()});
      } else if (Reached& known = reached[marks_.at(v)]; foot.distance <= known.foot.distance) {
        known.foot = foot;
      }
    }
    std::erase_if(reached, [&](Reached& r) { return !direct(line, r); });
    return reached;
  }

  // The stroke's direction at a vertex, over a chord as long as two edges there; false where it has none.
  bool direct(const DrawnLine& line, Reached& reached) const {
    const Vector& normal = metric_.normals[reached.vertex];
    if (normal.isZero(0)) return false;
    double sum = 0;
    int count = 0;
    neighbors_.vertices(reached.vertex, [&](std::int32_t w) {
      sum += (point(w) - point(reached.vertex)).norm();
      ++count;
    });
    const Vector chord = line.chord(reached.foot.at, count > 0 ? sum / count : 0);
    const Vector tangent = chord - chord.dot(normal) * normal;
    const double length = tangent.norm();
    if (!(length > kNoDirection * chord.norm())) return false;
    reached.direction = tangent / length;
    return true;
  }

  void set(const Scribble& scribble, const Reached& reached, double weight) {
    const Vector& along = reached.direction;
    const Vector across = metric_.normals[reached.vertex].cross(along);
    const double l_along = scribble.attracts ? 1 / scribble.eta : scribble.eta;
    const Eigen::Matrix3d drawn = l_along * along * along.transpose() + 1 / l_along * across * across.transpose();
    Eigen::Matrix3d& tensor = metric_.tensors[reached.vertex];
    tensor = weight < 1 ? Eigen::Matrix3d(weight * drawn + (1 - weight) * tensor) : drawn;
  }

  // The vertices next to a ring, with the mean of the directions there. Directions are lines without a sense, turned
  // onto the tangent plane of each vertex. marks_ numbers the `known` vertices of all rings so far.
  std::vector<Reached> next_ring(const std::vector<Reached>& ring, const DrawnLine& line, std::size_t known) {
    struct Sum {
      Vector u, v;                    // basis of the tangent plane
      double uu = 0, uv = 0, vv = 0;  // sum of the directions' squares
    };
    std::vector<Reached> next;
    std::vector<Sum> sums;
    for (const Reached& from : ring) {
      poll_.next();
      const Vector& m = metric_.normals[from.vertex];
      neighbors_.vertices(from.vertex, [&](std::int32_t w) {
        const Vector& n = metric_.normals[w];
        if (n.isZero(0) || (marks_.has(w) && marks_.at(w) < known)) return;
        const DrawnLine::Foot foot = line.foot_near(point(w), from.foot.segment);
        if (!marks_.has(w)) {
          marks_.set(w, known + next.size());
          next.push_back({w, foot, Vector::Zero()});
          const TangentFrame frame = tangent_frame(n);
          sums.push_back({frame.u, frame.v()});
        }
        Reached& to = next[marks_.at(w) - known];
        Sum& sum = sums[marks_.at(w) - known];
        if (foot.distance < to.foot.distance) to.foot = foot;
        const Vector d = turned_by_least_rotation(from.direction, m, n);
        const double x = d.dot(sum.u), y = d.dot(sum.v);
        sum.uu += x * x;
        sum.uv += x * y;
        sum.vv += y * y;
      });
    }
    for (std::size_t i = 0; i < next.size(); ++i) {
      const double angle = std::atan2(2 * sums[i].uv, sums[i].uu - sums[i].vv) / 2;
      next[i].direction = std::cos(angle) * sums[i].u + std::sin(angle) * sums[i].v;
    }
    return next;
  }

  const Surface& surface_;
  Metric& metric_;
  const double unit_;
  Neighbors neighbors_;
  EpochMap marks_;  // of vertices: their positions in a list
  Poll poll_;       // of vertices looked at
};

}  // namespace

void detail::check_scribble(const Surface& surface, const Scribble& scribble, std::size_t number_of_scribble) {
  const double unit = exact_unit(surface);
  const auto point = [&](std::int32_t v) { return Vector(unit * surface.points()[v]); };
  const std::size_t count = scribble.points.size();
  for (const auto* list : {&scribble.faces, &scribble.vertices}) {
    if (!list->empty() && list->size() != count) {
      throw InvalidInput(name(number_of_scribble) + " has " + std::to_string(count) + " points and " +
                         std::to_string(list->size()) + " faces or vertices for them");
    }
  }
  if (!(std::isfinite(scribble.eta) && scribble.eta >= 1)) {
    throw InvalidInput("eta of " + name(number_of_scribble) + " is " + text(scribble.eta) +
                       ", not a finite number of at least 1");
  }
  if (scribble.rings < 1) {
    throw InvalidInput("rings of " + name(number_of_scribble) + " is " + std::to_string(scribble.rings) +
                       ", not at least 1");
  }
  if (scribble.radius && !(std::isfinite(*scribble.radius) && *scribble.radius > 0)) {
    throw InvalidInput("radius of " + name(number_of_scribble) + " is " + text(*scribble.radius) +
                       ", not a finite number above 0");
  }
  for (std::size_t i = 0; i < count; ++i) {
    const auto fail = [&](const std::string& what) {
      throw InvalidInput("point " + std::to_string(i) + " of " + name(number_of_scribble) + " " + what);
    };
    const Vector p = unit * scribble.points[i];
    const std::int32_t vertex = scribble.vertices.empty() ? -1 : scribble.vertices[i];
    const std::int32_t face = scribble.faces.empty() ? -1 : scribble.faces[i];
    if (!scribble.points[i].allFinite()) fail("is not finite");
    const auto where = [&](const char* kind) {
      return "point " + std::to_string(i) + " of " + name(number_of_scribble) + ": " + kind;
    };
    if (vertex != -1) check_index(vertex, surface.vertex_count(), where("vertex"));
    if (face != -1) check_index(face, surface.face_count(), where("face"), "faces");
    if (vertex < 0 && face < 0) fail("has neither a face nor a vertex");
    double off = 0;
    if (vertex >= 0) {
      off = (p - point(vertex)).norm();
    } else {
      const auto& [a, b, c] = surface.triangles()[face];
      off = distance_to_triangle(p, point(a), point(b), point(c));
    }
    if (!(off / unit * surface.scale() <= kOffMesh)) {
      fail("is off the mesh: " + text(off / unit) + " away from " + (vertex >= 0 ? "vertex " : "face ") +
           std::to_string(vertex >= 0 ? vertex : face));
    }
  }
}

Metric apply_scribbles(const Surface& surface, const Metric& metric, std::span<const Scribble> scribbles,
                       std::optional<MetricKind> kind, const Task& task) {
  check_size(surface, metric);
  check_tensors(metric);
  Metric result{.normals = copied(metric.normals, task, 0.0), .tensors = copied(metric.tensors, task, 0.5)};
  if (scribbles.empty()) return result;
  Scribbler scribbler(surface, result, task);
  for (std::size_t i = 0; i < scribbles.size(); ++i) check_scribble(surface, scribbles[i], i);
  for (const Scribble& scribble : scribbles) {
    task.check(1.0);
    if (!kind || scribble.changes(*kind)) scribbler.apply(scribble);
  }
  return result;
}

}  // namespace seamwire
