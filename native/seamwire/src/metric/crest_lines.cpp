// SPDX-License-Identifier: GPL-3.0-or-later
//
// Yoshizawa, Belyaev, Seidel, "Fast and Robust Detection of Crest Lines on Meshes", Solid and Physical Modeling 2005.
// Rusinkiewicz, "Estimating Curvatures and Their Derivatives on Triangle Meshes", 3DPVT 2004.
// Hildebrandt, Polthier, Wardetzky, "Smooth Feature Lines on Surface Meshes", SGP 2005.
#include "seamwire/metric/crest_lines.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

#include "detail/poll.hpp"
#include "detail/text.hpp"
#include "graph/edge_chains.hpp"
#include "metric/metric_check.hpp"
#include "metric/tangent_frame.hpp"
#include "seamwire/errors.hpp"
#include "surface/corner_fans.hpp"
#include "surface/face_height.hpp"

namespace seamwire {

using namespace detail;

namespace {

// How far at most a walk to the sides leads, in the unit cube: where the surface is almost flat, the radius of
// curvature is larger than the model.
constexpr double kFarthest = 0.25;
// A walk leads at least this far, in lengths of the longest side of its first face: a sharp edge bends within one face.
constexpr double kNearest = 1.5;
// A walk that meets so many faces goes around in slivers.
constexpr int kMostFaces = 500;
// So many segments in a row that do not stand out are part of a line that does on both sides of them.
constexpr std::size_t kBridged = 3;

void check(const Surface& surface, const Curvature& curvature, const CrestLineOptions& options) {
  check_size(surface, curvature);
  if (!(std::isfinite(options.least_strength) && options.least_strength >= 0.0)) {
    throw InvalidInput("least_strength is " + text(options.least_strength) + ", not a finite number of 0 or more");
  }
  if (!(options.least_drop >= 0.0 && options.least_drop < 1.0)) {
    throw InvalidInput("least_drop is " + text(options.least_drop) + ", not in [0, 1)");
  }
}

// The faces of the corner fans with the caller's vertices, as plane triangles in the unit cube.
class Faces {
 public:
  struct Frame {
    Vector u, v, normal;
    double area;
    std::array<Eigen::Vector2d, 3> corners;  // in (u, v), the first at the origin
  };

  explicit Faces(const Surface& surface) : surface_(surface), is_low_(corner_fans(surface).triangles.size(), 0) {
    for (const std::int32_t face : half_edge_faces(surface, surface.report().low_faces)) is_low_[face] = 1;
  }

  std::size_t count() const { return is_low_.size(); }
  // Whether which way it faces is nothing but rounding.
  bool is_low(std::size_t face) const { return is_low_[face] != 0; }

  std::int32_t vertex(std::size_t face, std::size_t corner) const {
    return corner_fans(surface_).vertices[corner_fans(surface_).triangles[face][corner]];
  }
  Triangle corners(std::size_t face) const { return {vertex(face, 0), vertex(face, 1), vertex(face, 2)}; }
  Vector point(std::int32_t v) const { return surface_.scale() * surface_.points()[v]; }

  // Of a face that is not low.
  Frame frame(std::size_t face) const {
    const auto [a, b, c] = corners(face);
    const Vector ab = point(b) - point(a), ac = point(c) - point(a), cross = ab.cross(ac);
    Frame frame;
    frame.normal = cross.normalized();
    frame.u = ab.normalized();
    frame.v = frame.normal.cross(frame.u);
    frame.area = 0.5 * cross.norm();
    frame.corners = {Eigen::Vector2d::Zero(), Eigen::Vector2d(ab.norm(), 0.0),
                     Eigen::Vector2d(ac.dot(frame.u), ac.dot(frame.v))};
    return frame;
  }

 private:
  const Surface& surface_;
  std::vector<char> is_low_;
};

// The gradient of the function that is linear on a triangle with the given values at its corners.
Eigen::Vector2d gradient(const Faces::Frame& frame, const std::array<double, 3>& values) {
  const Eigen::Vector2d &b = frame.corners[1], &c = frame.corners[2];
  const double db = values[1] - values[0], dc = values[2] - values[0], twice = b.x() * c.y();
  return {db * c.y() / twice, (dc * b.x() - db * c.x()) / twice};
}

// A vertex's tangent vector in the plane of a face.
Eigen::Vector2d turned_into(const Faces::Frame& frame, const Vector& tangent, const Vector& normal) {
  const Vector d = turned_by_least_rotation(tangent, normal, frame.normal);
  return {d.dot(frame.u), d.dot(frame.v)};
}

// The form k1 d1^2 + k2 d2^2 of a vertex in the plane of a face: at uu, uv, vv.
std::array<double, 3> form_in(const Eigen::Vector2d& d, double k1, double k2) {
  const double x = d.x(), y = d.y();
  return {k1 * x * x + k2 * y * y, (k1 - k2) * x * y, k1 * y * y + k2 * x * x};
}

// At each vertex the derivatives of k1 along d1 and of k2 along d2. They are the derivatives of the form with the same
// principal direction in all three arguments: the change of d1 itself lies along d2, and the form of both is zero.
struct Extremalities {
  std::vector<double> e1, e2;
};

Extremalities extremalities(const Faces& faces, const Curvature& curvature, const Task& task) {
  const std::size_t count = curvature.k1.size();
  Extremalities out{.e1 = std::vector<double>(count, 0.0), .e2 = std::vector<double>(count, 0.0)};
  std::vector<double> areas(count, 0.0);
  const Poll poll(task, 0.0, 0.4, faces.count());
  for (std::size_t f = 0; f < faces.count(); ++f) {
    poll.at(f);
    if (faces.is_low(f)) continue;
    const Faces::Frame frame = faces.frame(f);
    const Triangle corners = faces.corners(f);
    std::array<Eigen::Vector2d, 3> directions;
    std::array<double, 3> uu, uv, vv;
    for (std::size_t i = 0; i < 3; ++i) {
      const std::int32_t v = corners[i];
      directions[i] = turned_into(frame, curvature.d1[v], curvature.normals[v]);
      const auto [at_uu, at_uv, at_vv] = form_in(directions[i], curvature.k1[v], curvature.k2[v]);
      uu[i] = at_uu;
      uv[i] = at_uv;
      vv[i] = at_vv;
    }
    const Eigen::Vector2d g_uu = gradient(frame, uu), g_uv = gradient(frame, uv), g_vv = gradient(frame, vv);
    // Of a smooth surface it is symmetric in all three arguments (Codazzi): the nearest one that is.
    const double uuu = g_uu.x(), uuv = (2.0 * g_uv.x() + g_uu.y()) / 3.0;
    const double uvv = (2.0 * g_uv.y() + g_vv.x()) / 3.0, vvv = g_vv.y();
    const auto along = [&](double x, double y) {
      return uuu * x * x * x + 3.0 * uuv * x * x * y + 3.0 * uvv * x * y * y + vvv * y * y * y;
    };
    for (std::size_t i = 0; i < 3; ++i) {
      const double x = directions[i].x(), y = directions[i].y();
      out.e1[corners[i]] += frame.area * along(x, y);
      out.e2[corners[i]] += frame.area * along(-y, x);
      areas[corners[i]] += frame.area;
    }
  }
  for (std::size_t v = 0; v < count; ++v) {
    if (!(areas[v] > 0.0)) continue;
    out.e1[v] /= areas[v];
    out.e2[v] /= areas[v];
  }
  return out;
}

// What ridges are found by: the greatest curvature; and valleys, with all signs changed.
struct Greatest {
  double sign;                // 1 for ridges, -1 for valleys
  std::vector<double> k;      // times the sign
  std::vector<double> other;  // times the sign
  std::vector<Vector> d;      // the direction of k
  std::vector<double> e;      // the derivative of k along d
};

Greatest greatest(const Curvature& curvature, const Extremalities& extremalities, double sign) {
  const std::size_t count = curvature.k1.size();
  Greatest out{.sign = sign, .k = {}, .other = {}, .d = {}, .e = {}};
  out.k.reserve(count);
  out.other.reserve(count);
  out.d.reserve(count);
  out.e.reserve(count);
  for (std::size_t v = 0; v < count; ++v) {
    const double k1 = sign * curvature.k1[v], k2 = sign * curvature.k2[v];
    out.k.push_back(std::max(k1, k2));
    out.other.push_back(std::min(k1, k2));
    out.d.push_back(k1 >= k2 ? curvature.d1[v] : curvature.d2[v]);
    out.e.push_back(sign * (k1 >= k2 ? extremalities.e1[v] : extremalities.e2[v]));
  }
  return out;
}

// Where the surface bends, sideways of a point, as a straight walk over its faces meets it.
class Walk {
 public:
  Walk(const Surface& surface, const Faces& faces, const Curvature& curvature)
      : surface_(surface), faces_(faces), curvature_(curvature) {}

  // The curvature along the walk where it has gone `distance` from a point of a face, or at the boundary.
  double curvature_at(std::size_t face, const Eigen::Vector2d& from, const Eigen::Vector2d& direction,
                      double distance) const {
    Faces::Frame frame = faces_.frame(face);
    Eigen::Vector2d at = from, along = direction.normalized();
    int entered = -1;
    for (int step = 0; step < kMostFaces; ++step) {
      // The side through which it leaves: the nearest of those that it goes towards.
      double ahead = distance;
      int side = -1;
      for (int i = 0; i < 3; ++i) {
        if (i == entered) continue;
        const Eigen::Vector2d &a = frame.corners[i], e = frame.corners[(i + 1) % 3] - a;
        const Eigen::Vector2d outward(e.y(), -e.x());
        const double speed = outward.dot(along);
        if (!(speed > 0.0)) continue;
        const double way = std::max(0.0, outward.dot(a - at) / speed);
        if (way < ahead) {
          ahead = way;
          side = i;
        }
      }
      at += ahead * along;
      distance -= ahead;
      if (side == -1) break;
      const std::int32_t twin = corner_fans(surface_).twins[3 * face + side];
      if (twin == -1 || faces_.is_low(twin / 3)) break;
      // Unfolded about the side, which the other face has in the other direction.
      const Eigen::Vector2d a = frame.corners[side], b = frame.corners[(side + 1) % 3];
      const Eigen::Vector2d e = (b - a).normalized();
      const double part = (at - a).dot(e), forward = along.dot(e), over = along.dot(Eigen::Vector2d(e.y(), -e.x()));
      face = static_cast<std::size_t>(twin / 3);
      entered = twin % 3;
      frame = faces_.frame(face);
      const Eigen::Vector2d start = frame.corners[(entered + 1) % 3];
      const Eigen::Vector2d same = (frame.corners[entered] - start).normalized();
      at = start + part * same;
      // Inward of the new face is to the right of the side as the old face has it.
      along = forward * same + over * Eigen::Vector2d(same.y(), -same.x());
    }
    return normal_curvature(face, frame, at, along);
  }

 private:
  double normal_curvature(std::size_t face, const Faces::Frame& frame, const Eigen::Vector2d& at,
                          const Eigen::Vector2d& along) const {
    const Triangle corners = faces_.corners(face);
    const Eigen::Vector2d &b = frame.corners[1], &c = frame.corners[2];
    const double third = std::clamp(at.y() / c.y(), 0.0, 1.0);
    const double second = std::clamp((at.x() - third * c.x()) / b.x(), 0.0, 1.0 - third);
    const std::array<double, 3> weights{1.0 - second - third, second, third};
    double sum = 0.0;
    for (std::size_t i = 0; i < 3; ++i) {
      const Eigen::Vector2d d = turned_into(frame, curvature_.d1[corners[i]], curvature_.normals[corners[i]]);
      const auto [uu, uv, vv] = form_in(d, curvature_.k1[corners[i]], curvature_.k2[corners[i]]);
      sum += weights[i] * (uu * along.x() * along.x() + 2.0 * uv * along.x() * along.y() + vv * along.y() * along.y());
    }
    return sum;
  }

  const Surface& surface_;
  const Faces& faces_;
  const Curvature& curvature_;
};

// A piece of a line across a face, from the middle of one side to that of another.
struct Segment {
  std::array<std::int32_t, 2> sides;  // half-edges, each the lower one of its edge
  std::int32_t face;                  // of the corner fans
  bool stands_out;                    // k is greatest here, and falls on both sides
};

struct Crossing {
  Edge edge;
  double part;
};

struct LinePoint {
  Crossing at;
  Vector place;
  double curvature;
  std::int32_t face;  // to the next point; -1 for the last one
};

struct Line {
  std::vector<LinePoint> points;
  double strength;
};

class Tracer {
 public:
  Tracer(const Surface& surface, const Faces& faces, const Curvature& curvature, const CrestLineOptions& options,
         const Greatest& greatest)
      : surface_(surface),
        faces_(faces),
        curvature_(curvature),
        options_(options),
        greatest_(greatest),
        walk_(surface, faces, curvature) {}

  // Adds the lines that are strong enough.
  void trace(Poll poll, std::vector<Line>& lines) {
    for (std::size_t f = 0; f < faces_.count(); ++f) {
      poll.next();
      if (const auto segment = segment_in(f)) segments_.push_back(*segment);
    }
    link(lines);
  }

 private:
  // The lower half-edge of the edge that one belongs to.
  std::int32_t edge_of(std::int32_t half_edge) const {
    const std::int32_t twin = corner_fans(surface_).twins[half_edge];
    return twin == -1 ? half_edge : std::min(half_edge, twin);
  }

  // Where e vanishes on an edge between whose ends it changes its sign.
  Crossing crossing(std::int32_t half_edge) const {
    std::int32_t a = faces_.vertex(half_edge / 3, half_edge % 3);
    std::int32_t b = faces_.vertex(half_edge / 3, (half_edge + 1) % 3);
    if (b < a) std::swap(a, b);
    const double at_a = std::abs(greatest_.e[a]), at_b = std::abs(greatest_.e[b]), sum = at_a + at_b;
    return {.edge = {a, b}, .part = sum > 0.0 ? at_a / sum : 0.5};
  }

  static double interpolated(const Crossing& at, const std::vector<double>& values) {
    return (1.0 - at.part) * values[at.edge[0]] + at.part * values[at.edge[1]];
  }

  // Whether d at two vertices point against each other, the one turned to the other's normal: the same both ways round.
  bool are_opposite(std::int32_t a, std::int32_t b) const {
    if (b < a) std::swap(a, b);
    const Vector d = turned_by_least_rotation(greatest_.d[a], curvature_.normals[a], curvature_.normals[b]);
    return d.dot(greatest_.d[b]) < 0.0;
  }

  // Where e, made continuous by turning d around, changes its sign within a face.
  std::optional<Segment> segment_in(std::size_t f) const {
    if (faces_.is_low(f)) return std::nullopt;
    const Triangle t = faces_.corners(f);
    if (std::ranges::all_of(t, [&](std::int32_t v) { return greatest_.k[v] <= 0.0; })) return std::nullopt;
    const std::array<bool, 3> opposite{are_opposite(t[0], t[1]), are_opposite(t[1], t[2]), are_opposite(t[2], t[0])};
    // Around an umbilic point d comes back turned around.
    if (opposite[0] != (opposite[1] != opposite[2])) return std::nullopt;
    const std::array<bool, 3> is_turned{false, opposite[0], opposite[2]};
    std::array<double, 3> e;
    std::array<bool, 3> is_above;
    for (std::size_t i = 0; i < 3; ++i) {
      const double own = greatest_.e[t[i]];
      e[i] = is_turned[i] ? -own : own;
      // Zero counts as above in the vertex's own direction, so that both faces at an edge agree.
      is_above[i] = (own >= 0.0) != is_turned[i];
    }
    Segment segment{.sides = {-1, -1}, .face = static_cast<std::int32_t>(f), .stands_out = false};
    for (std::size_t i = 0; i < 3; ++i) {
      if (is_above[i] == is_above[(i + 1) % 3]) continue;
      segment.sides[segment.sides[0] == -1 ? 0 : 1] = edge_of(static_cast<std::int32_t>(3 * f + i));
    }
    if (segment.sides[1] == -1) return std::nullopt;

    const Faces::Frame frame = faces_.frame(f);
    Eigen::Vector2d direction = Eigen::Vector2d::Zero();
    for (std::size_t i = 0; i < 3; ++i) {
      const Eigen::Vector2d d = turned_into(frame, greatest_.d[t[i]], curvature_.normals[t[i]]);
      direction += is_turned[i] ? Eigen::Vector2d(-d) : d;
    }
    segment.stands_out = gradient(frame, e).dot(direction) < 0.0 && stands_out(f, frame, segment, direction);
    return segment;
  }

  // Whether k is the larger curvature in a segment's middle, and falls on both sides of it.
  bool stands_out(std::size_t f, const Faces::Frame& frame, const Segment& segment,
                  const Eigen::Vector2d& direction) const {
    const Crossing a = crossing(segment.sides[0]), b = crossing(segment.sides[1]);
    const double here = 0.5 * (interpolated(a, greatest_.k) + interpolated(b, greatest_.k));
    const double other = 0.5 * (interpolated(a, greatest_.other) + interpolated(b, greatest_.other));
    if (!(here > std::abs(other))) return false;
    if (options_.least_drop == 0.0) return true;
    const Vector middle = 0.5 * (place(a) + place(b)) * surface_.scale() - faces_.point(faces_.vertex(f, 0));
    const Eigen::Vector2d from(middle.dot(frame.u), middle.dot(frame.v));
    const double longest =
        std::max({frame.corners[1].norm(), frame.corners[2].norm(), (frame.corners[2] - frame.corners[1]).norm()});
    const double distance = std::max(std::min(1.0 / here, kFarthest), kNearest * longest);
    const double there =
        0.5 * greatest_.sign *
        (walk_.curvature_at(f, from, direction, distance) + walk_.curvature_at(f, from, -direction, distance));
    return there <= (1.0 - options_.least_drop) * here;
  }

  Vector place(const Crossing& at) const {
    const Vector &a = surface_.points()[at.edge[0]], &b = surface_.points()[at.edge[1]];
    return a + at.part * (b - a);
  }

  // Lines are chains of segments that share an edge: each edge has two faces, each face one segment at most.
  void link(std::vector<Line>& lines) const {
    std::vector<EdgeChains::Edge> sides_of;
    sides_of.reserve(segments_.size());
    for (const Segment& segment : segments_) sides_of.push_back(segment.sides);
    EdgeChains chains(corner_fans(surface_).twins.size(), sides_of);
    for (const bool is_open : {true, false}) {
      for (std::int32_t s = 0; index(s) < segments_.size(); ++s) {
        for (const std::int32_t side : segments_[s].sides) {
          if (chains.is_taken(s) || (is_open && chains.at(side).size() > 1)) continue;
          add_lines(chains.follow(side, s, [](std::int32_t) { return false; }), lines);
        }
      }
    }
  }

  // Adds the parts of a chain of segments that stand out. Its nodes are half-edges.
  void add_lines(EdgeChains::Chain chain, std::vector<Line>& lines) const {
    std::vector<std::int32_t>&sides = chain.nodes, &segments = chain.edges;
    const std::size_t size = segments.size();
    std::vector<char> stands_out(size);
    const auto look = [&] {
      std::ranges::transform(segments, stands_out.begin(), [&](std::int32_t s) { return segments_[s].stands_out; });
    };
    const auto end_of_run = [&](std::size_t first) {
      std::size_t end = first;
      while (end < size && stands_out[end] == stands_out[first]) ++end;
      return end;
    };
    const auto begin_at = [&](std::size_t begin) {
      const auto by = static_cast<std::ptrdiff_t>(begin % size);
      // Not std::ranges::rotate, which Clang 14 cannot read with GCC 12's library.
      std::rotate(segments.begin(), segments.begin() + by, segments.end());
      sides.pop_back();
      std::rotate(sides.begin(), sides.begin() + by, sides.end());
      sides.push_back(sides.front());
      look();
    };
    look();
    if (std::ranges::count(stands_out, 1) == 0) return;
    if (sides.front() == sides.back()) {
      // Begun at the end of a part that does not stand out, no part is in two; at that of the longest, a closed chain
      // is one as any other.
      for (std::size_t i = 0; i < size; ++i) {
        if (stands_out[i] == 0 || stands_out[i == 0 ? size - 1 : i - 1] != 0) continue;
        begin_at(i);
        break;
      }
      std::size_t begin = 0, longest = 0;
      for (std::size_t first = 0, end = 0; first < size; first = end) {
        end = end_of_run(first);
        if (stands_out[first] == 0 && end - first > longest) {
          longest = end - first;
          begin = end;
        }
      }
      begin_at(begin);
      // Nothing long between its ends: it is closed.
      if (longest > 0 && longest <= kBridged)
        std::fill(stands_out.end() - static_cast<std::ptrdiff_t>(longest), stands_out.end(), 1);
    }
    for (std::size_t first = 0, end = 0; first < size; first = end) {
      end = end_of_run(first);
      if (stands_out[first] == 0 && first > 0 && end < size && end - first <= kBridged) {
        std::fill(stands_out.begin() + static_cast<std::ptrdiff_t>(first),
                  stands_out.begin() + static_cast<std::ptrdiff_t>(end), 1);
      }
    }
    for (std::size_t first = 0, end = 0; first < size; first = end) {
      end = end_of_run(first);
      if (stands_out[first] != 0) add_line(chain, first, end, lines);
    }
  }

  // Adds the segments first to end - 1 of a chain as a line, if it is strong enough.
  void add_line(const EdgeChains::Chain& chain, std::size_t first, std::size_t end, std::vector<Line>& lines) const {
    Line line{.points = {}, .strength = 0.0};
    for (std::size_t i = first; i <= end; ++i) {
      const Crossing at = crossing(chain.nodes[i]);
      const std::int32_t face = i == end ? -1 : corner_fans(surface_).faces[segments_[chain.edges[i]].face];
      const double curvature = greatest_.sign * interpolated(at, greatest_.k);
      line.points.push_back({.at = at, .place = place(at), .curvature = curvature, .face = face});
    }
    for (std::size_t i = 1; i < line.points.size(); ++i) {
      const LinePoint &here = line.points[i], &before = line.points[i - 1];
      line.strength += surface_.scale() * (here.place - before.place).norm() * 0.5 *
                       (std::abs(here.curvature) + std::abs(before.curvature));
    }
    if (line.strength >= options_.least_strength) lines.push_back(std::move(line));
  }

  const Surface& surface_;
  const Faces& faces_;
  const Curvature& curvature_;
  const CrestLineOptions& options_;
  const Greatest& greatest_;
  Walk walk_;
  std::vector<Segment> segments_;
};

// The strongest first.
CrestLines ordered(std::vector<Line> lines) {
  std::ranges::stable_sort(lines, std::ranges::greater{}, &Line::strength);
  CrestLines out;
  out.starts.push_back(0);
  for (const Line& line : lines) {
    for (const LinePoint& point : line.points) {
      out.points.push_back(point.place);
      out.edges.push_back(point.at.edge);
      out.t.push_back(point.at.part);
      out.curvatures.push_back(point.curvature);
      out.faces.push_back(point.face);
    }
    out.starts.push_back(static_cast<std::int32_t>(out.points.size()));
    out.strengths.push_back(line.strength);
  }
  return out;
}

}  // namespace

CrestLines crest_lines(const Surface& surface, const Curvature& curvature, const CrestLineOptions& options,
                       const Task& task) {
  check(surface, curvature, options);
  Curvature in_cube = curvature;  // of the model scaled to the unit cube
  for (double& k : in_cube.k1) k /= surface.scale();
  for (double& k : in_cube.k2) k /= surface.scale();
  const Faces faces(surface);
  const Extremalities derivatives = extremalities(faces, in_cube, task);
  std::vector<Line> lines;
  double begin = 0.4;
  for (const double sign : {1.0, -1.0}) {
    const Greatest sheet = greatest(in_cube, derivatives, sign);
    Tracer(surface, faces, in_cube, options, sheet)
        .trace(Poll(task, begin, begin + 0.3, faces.count(), Poll::kFewSteps), lines);
    begin += 0.3;
  }
  CrestLines out = ordered(std::move(lines));
  for (double& k : out.curvatures) k *= surface.scale();
  return out;
}

}  // namespace seamwire
