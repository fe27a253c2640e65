// SPDX-License-Identifier: GPL-3.0-or-later
//
// Rusinkiewicz, "Estimating Curvatures and Their Derivatives on Triangle Meshes", 3DPVT 2004.
// Max, "Weights for Computing Vertex Normals from Facet Normals", Journal of Graphics Tools 4(2), 1999.
// Meyer, Desbrun, Schroeder, Barr, "Discrete Differential-Geometry Operators for Triangulated 2-Manifolds", 2003.
#include "seamwire/metric/curvature.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <span>
#include <utility>
#include <vector>

#include "detail/index.hpp"
#include "detail/poll.hpp"
#include "detail/prefetch.hpp"
#include "detail/text.hpp"
#include "metric/metric_check.hpp"
#include "metric/tangent_frame.hpp"
#include "seamwire/errors.hpp"
#include "surface/corner_fans.hpp"
#include "surface/exact_unit.hpp"
#include "surface/face_height.hpp"

namespace seamwire {

using namespace detail;

namespace {

/// The second fundamental form in a frame: (mean + difference) u^2 + 2 mixed u v + (mean - difference) v^2. Turning the
/// frame by an angle leaves the mean, and turns (difference, mixed) back by twice that angle.
struct Form {
  double mean = 0.0, difference = 0.0, mixed = 0.0;
};

/// Gives a vertex the curvatures and directions of a form; where both curvatures are equal, directions stay.
void decompose(const TangentFrame& frame, const Form& form, std::size_t vertex, Curvature& curvature) {
  const double d = form.difference, m = form.mixed, radius = std::sqrt(d * d + m * m);
  const double signed_radius = form.mean < 0.0 ? -radius : radius;
  curvature.k1[vertex] = form.mean + signed_radius;
  curvature.k2[vertex] = form.mean - signed_radius;
  if (!(radius > 0.0)) return;
  // The direction of k1 is at half the angle of (d, m), or of (-d, -m) where the mean is negative.
  const double along = form.mean < 0.0 ? -d : d, across = form.mean < 0.0 ? -m : m;
  const double large = radius + std::abs(along), inverse = 1.0 / std::sqrt(2.0 * radius * large);
  const double c = (along < 0.0 ? across : large) * inverse, s = (along < 0.0 ? large : across) * inverse;
  const Vector v = frame.v();
  curvature.d1[vertex] = c * frame.u + s * v;
  curvature.d2[vertex] = c * v - s * frame.u;
}

constexpr double kMostRounds = 400;

// A side of faces between two of the caller's vertices, and what turns forms from the one's frame into the other's: the
// cosine and sine of twice the angle.
struct Side {
  std::int32_t a, b;
  double c, s;
};

Form turned(const Form& form, double c, double s) {
  return {.mean = form.mean,
          .difference = c * form.difference - s * form.mixed,
          .mixed = c * form.mixed + s * form.difference};
}

struct Neighborhood {
  std::vector<TangentFrame> frames;
  std::vector<double> areas;  // a third of those of the faces around
  std::vector<Side> sides;    // but for those where one has no normal, or the normals are opposite
  double median_side = 0.0;   // 0 where there is none
};

Neighborhood neighborhood(const Surface& surface, const std::vector<Vector>& normals, const Task& task) {
  Neighborhood out;
  out.frames.reserve(normals.size());
  for (const Vector& normal : normals) out.frames.push_back(fast_tangent_frame(normal));
  out.areas.assign(normals.size(), 0.0);
  const std::vector<Triangle>& faces = corner_fans(surface).triangles;
  const std::vector<std::int32_t>& twins = corner_fans(surface).twins;
  std::vector<double> lengths;
  out.sides.reserve(twins.size() / 2 + 1);
  lengths.reserve(twins.size() / 2 + 1);
  const Poll poll(task, 0.0, 0.2, faces.size());
  for (std::size_t f = 0; f < faces.size(); ++f) {
    poll.at(f);
    Triangle corners;
    for (std::size_t i = 0; i < 3; ++i) corners[i] = corner_fans(surface).vertices[faces[f][i]];
    const auto point = [&](std::size_t i) -> const Vector& { return surface.points()[corners[i]]; };
    const double scale = surface.scale(), unit = exact_unit(surface), units = scale / unit;
    const Vector one = unit * (point(1) - point(0)), two = unit * (point(2) - point(0));
    const double area = units * units * one.cross(two).norm() / 6.0;
    for (const std::int32_t v : corners) out.areas[v] += area;
    for (std::size_t i = 0; i < 3; ++i) {
      const auto half_edge = static_cast<std::int32_t>(3 * f + i);
      if (twins[half_edge] != -1 && twins[half_edge] < half_edge) continue;
      const std::size_t j = (i + 1) % 3;
      const std::int32_t a = corners[i], b = corners[j];
      lengths.push_back(units * (unit * (point(j) - point(i))).norm());
      const Vector &from = normals[a], &to = normals[b];
      if (from.isZero(0.0) || to.isZero(0.0) || 1.0 + from.dot(to) < kOppositeNormals) continue;
      const Vector u = turned_by_least_rotation(out.frames[a].u, from, to);
      const double x = u.dot(out.frames[b].u), y = u.dot(out.frames[b].v());
      out.sides.push_back({.a = a, .b = b, .c = x * x - y * y, .s = 2.0 * x * y});
    }
  }
  if (!lengths.empty()) {
    const auto middle = lengths.begin() + static_cast<std::ptrdiff_t>(lengths.size() / 2);
    std::nth_element(lengths.begin(), middle, lengths.end());
    out.median_side = *middle;
  }
  return out;
}

// Faces whose corners memory is asked for in advance.
constexpr std::size_t kAhead = 8;

struct FaceShape {
  std::array<Vector, 3> edges;  // opposite the corners, in the face's direction
  std::array<double, 3> squared_lengths;
  Vector cross;  // along the normal, twice the area long
  double squared_cross;
};

// Low faces, met one by one in a pass over all faces: fits to them would make curvatures of any size.
class LowFaces {
 public:
  explicit LowFaces(const Surface& surface)
      : faces_(half_edge_faces(surface, surface.report().low_faces)), next_(faces_.begin()) {}

  const std::vector<std::int32_t>& all() const { return faces_; }
  // Whether a face is low; each is asked for once, in their order.
  bool meets(std::size_t face) {
    if (next_ == faces_.end() || static_cast<std::size_t>(*next_) != face) return false;
    ++next_;
    return true;
  }

 private:
  std::vector<std::int32_t> faces_;
  std::vector<std::int32_t>::const_iterator next_;
};

// The places of corner fans: the surface's points, gathered only if the fans are numbered otherwise.
class FanPoints {
 public:
  explicit FanPoints(const Surface& surface) : points_(surface.points()) {
    const std::vector<std::int32_t>& vertices = corner_fans(surface).vertices;
    std::int32_t fan = 0;
    if (std::ranges::all_of(vertices, [&](std::int32_t v) { return v == fan++; })) return;
    gathered_.reserve(vertices.size());
    for (const std::int32_t v : vertices) gathered_.push_back(surface.points()[v]);
    points_ = gathered_;
  }
  FanPoints(const FanPoints&) = delete;
  FanPoints& operator=(const FanPoints&) = delete;

  const Vector& operator[](std::int32_t fan) const { return points_[index(fan)]; }

 private:
  std::vector<Vector> gathered_;
  std::span<const Vector> points_;
};

// Of the face whose corners are the given points.
inline FaceShape face_shape(const FanPoints& points, const Triangle& fans, double scale) {
  const Vector &a = points[fans[0]], &b = points[fans[1]], &c = points[fans[2]];
  FaceShape shape;
  shape.edges = {Vector(scale * (c - b)), Vector(scale * (a - c)), Vector(scale * (b - a))};
  for (std::size_t i = 0; i < 3; ++i) shape.squared_lengths[i] = shape.edges[i].squaredNorm();
  shape.cross = shape.edges[0].cross(shape.edges[1]);
  shape.squared_cross = shape.cross.squaredNorm();
  return shape;
}

Vector normalized_or_zero(const Vector& v) {
  const double length = v.norm();
  return length > 0.0 ? Vector(v / length) : Vector(Vector::Zero());
}

// Gives fans of none but low triangles the direction of the widest of them.
void complete(const Surface& surface, const FanPoints& points, const std::vector<std::int32_t>& low,
              std::vector<Vector>& normals) {
  struct Wide {
    std::int32_t face;
    Vector cross;
  };
  std::vector<Wide> wide;
  for (const std::int32_t f : low) {
    const Vector cross = face_shape(points, corner_fans(surface).triangles[f], surface.scale()).cross;
    if (cross.norm() > 0.0) wide.push_back({f, cross});
  }
  std::ranges::stable_sort(wide, std::ranges::greater{}, [](const Wide& w) { return w.cross.norm(); });
  for (const auto& [face, cross] : wide) {
    for (const std::int32_t fan : corner_fans(surface).triangles[face]) {
      if (normals[fan].isZero(0.0)) normals[fan] = normalized_or_zero(cross);
    }
  }
}

// The normals of the corner fans, each on its own side of the surface; zero where a fan has no area at all.
std::vector<Vector> fan_normals(const Surface& surface, const Task& task) {
  std::vector<Vector> normals(corner_fans(surface).vertices.size(), Vector::Zero());
  const std::vector<Triangle>& faces = corner_fans(surface).triangles;
  const FanPoints points(surface);
  LowFaces low(surface);
  const Poll summing(task, 0.0, 0.2, faces.size());
  for (std::size_t f = 0; f < faces.size(); ++f) {
    summing.at(f);
    if (f + kAhead < faces.size()) {
      for (const std::int32_t fan : faces[f + kAhead]) {
        prefetch(&points[fan]);
        prefetch(&normals[fan]);
      }
    }
    if (low.meets(f)) continue;
    const FaceShape shape = face_shape(points, faces[f], surface.scale());
    // One over the squared lengths of the two edges at each corner.
    const auto& [a, b, c] = shape.squared_lengths;
    const Vector weighted = shape.cross / (a * b * c);
    normals[faces[f][0]] += a * weighted;
    normals[faces[f][1]] += b * weighted;
    normals[faces[f][2]] += c * weighted;
  }
  Poll normalizing(task, 0.2, 0.25, normals.size());
  for (Vector& normal : normals) {
    normalizing.next();
    normal = normalized_or_zero(normal);
  }
  if (!low.all().empty()) complete(surface, points, low.all(), normals);
  return normals;
}

// For each fan 1 or -1. Fans of one vertex need not agree on which side of the surface is outside, and where a
// one-sided surface is cut they cannot. So the vertex takes the side of the first fan that has a normal.
struct VertexNormals {
  std::vector<Vector> normals;
  std::vector<signed char> side_of_fan;
};

VertexNormals combine(const Surface& surface, const std::vector<Vector>& fans, const Task& task) {
  const auto& vertex_of_fan = corner_fans(surface).vertices;
  VertexNormals result;
  result.normals.assign(surface.vertex_count(), Vector::Zero());
  result.side_of_fan.assign(fans.size(), 1);
  Poll poll(task, 0.8, 0.85, fans.size());
  for (std::size_t first = 0; first < fans.size();) {
    poll.next();
    std::size_t end = first;
    while (end < fans.size() && vertex_of_fan[end] == vertex_of_fan[first]) ++end;
    Vector& normal = result.normals[vertex_of_fan[first]];
    Vector reference = Vector::Zero();
    for (std::size_t fan = first; fan < end; ++fan) {
      if (reference.isZero(0.0)) reference = fans[fan];
      if (reference.dot(fans[fan]) < 0.0) result.side_of_fan[fan] = -1;
      normal += result.side_of_fan[fan] * fans[fan];
    }
    if (end - first > 1) normal = normalized_or_zero(normal);
    first = end;
  }
  return result;
}

// Per fan, with the fan's own normal: sums of form times area, and of the areas.
struct Fit {
  Form form;
  double area = 0.0;

  void add(const Form& more, double factor) {
    form.mean += factor * more.mean;
    form.difference += factor * more.difference;
    form.mixed += factor * more.mixed;
  }
};

// A frame as seen from another one, whose own vectors are u, v and normal.
struct SeenFrame {
  double normal_u, normal_v, normal_normal, u_u, u_v, u_normal;

  SeenFrame(const TangentFrame& frame, const Vector& u, const Vector& v, const Vector& normal)
      : normal_u(frame.normal.dot(u)),
        normal_v(frame.normal.dot(v)),
        normal_normal(frame.normal.dot(normal)),
        u_u(frame.u.dot(u)),
        u_v(frame.u.dot(v)),
        u_normal(frame.u.dot(normal)) {}

  // A form of the other frame's plane, turned onto this one's by the least rotation (tangent_frame.hpp), which is
  // applied to the components of u here. Where the normals are opposite any rotation is as good: leave u.
  Form carried(const Form& form) const {
    const double sum = 1.0 + normal_normal;
    const bool is_opposite = sum < kOppositeNormals;
    const double part = is_opposite ? 0.0 : u_normal / sum;
    const double c = u_u - part * normal_u, s = u_v - part * normal_v;
    const double c2 = c * c - s * s, s2 = 2.0 * c * s;
    return {.mean = form.mean,
            .difference = c2 * form.difference + s2 * form.mixed,
            .mixed = c2 * form.mixed - s2 * form.difference};
  }
};

// The share of the face's area that is nearest to each corner (the Voronoi area of Meyer et al., exact for obtuse
// triangles too). `dots`: of the two edges that leave each corner.
std::array<double, 3> corner_areas(const FaceShape& shape, const std::array<double, 3>& dots, double twice_area) {
  std::array<double, 3> areas;
  for (std::size_t i = 0; i < 3; ++i) {
    if (dots[i] > 0.0) continue;
    // Obtuse at i: each other corner j keeps the right triangle cut off by the bisector of its edge to i, whose area
    // is l^2 / 8 tan(angle at j).
    const std::size_t j = (i + 1) % 3;
    const std::size_t k = (i + 2) % 3;
    areas[j] = shape.squared_lengths[k] / 8.0 * twice_area / dots[j];
    areas[k] = shape.squared_lengths[j] / 8.0 * twice_area / dots[k];
    areas[i] = 0.5 * twice_area - areas[j] - areas[k];
    return areas;
  }
  // l^2 / 8 cot(opposite angle) on either side of each edge.
  const double factor = 0.125 / twice_area;
  std::array<double, 3> halves;
  for (std::size_t i = 0; i < 3; ++i) halves[i] = shape.squared_lengths[i] * dots[i] * factor;
  for (std::size_t i = 0; i < 3; ++i) areas[i] = halves[(i + 1) % 3] + halves[(i + 2) % 3];
  return areas;
}

// Adds to the corners of a face the form that fits the differences of their normals along its three edges best.
void fit_face(const FaceShape& shape, const std::array<const TangentFrame*, 3>& frames,
              const std::array<Fit*, 3>& fits) {
  // The face's frame: u along the longest edge, so that the equations are graded and need no pivots on slivers.
  const auto& l = shape.squared_lengths;
  const std::size_t i = l[0] >= l[1] ? (l[0] >= l[2] ? 0 : 2) : (l[1] >= l[2] ? 1 : 2);
  const std::size_t j = (i + 1) % 3, k = (i + 2) % 3;
  const double twice_area = std::sqrt(shape.squared_cross), length = std::sqrt(l[i]), inverse = 1.0 / length;
  const Vector normal = 1.0 / twice_area * shape.cross, u = inverse * shape.edges[i], v = normal.cross(u);
  std::array<double, 3> dots;
  for (std::size_t c = 0; c < 3; ++c) dots[c] = -shape.edges[(c + 1) % 3].dot(shape.edges[(c + 2) % 3]);
  // The edges in that frame: (length, 0), (ju, height), (ku, -height).
  const double ju = -dots[k] * inverse, ku = -dots[j] * inverse, height = twice_area * inverse;

  const std::array<SeenFrame, 3> seen{SeenFrame(*frames[i], u, v, normal), SeenFrame(*frames[j], u, v, normal),
                                      SeenFrame(*frames[k], u, v, normal)};
  // Along edge i the normal turns from that of corner j to that of corner k, and so on.
  const double iu_turn = seen[2].normal_u - seen[1].normal_u, iv_turn = seen[2].normal_v - seen[1].normal_v;
  const double ju_turn = seen[0].normal_u - seen[2].normal_u, jv_turn = seen[0].normal_v - seen[2].normal_v;
  const double ku_turn = seen[1].normal_u - seen[0].normal_u, kv_turn = seen[1].normal_v - seen[0].normal_v;
  // The normal equations are those of the matrix (uu, uv, 0; uv, uu + vv, uv; 0, uv, vv), by L D L^T. No pivot comes
  // near zero: |ju - ku| <= length and uu >= 3/2 length^2, so second >= 5/6 length^2 and last >= vv / 6.
  const double uu = length * length + ju * ju + ku * ku, uv = (ju - ku) * height, vv = 2.0 * height * height;
  const double r0 = iu_turn * length + ju_turn * ju + ku_turn * ku;
  const double r1 = (ju_turn - ku_turn) * height + iv_turn * length + jv_turn * ju + kv_turn * ku;
  const double r2 = (jv_turn - kv_turn) * height;
  const double l1 = uv / uu, second = uu + vv - l1 * uv, l2 = uv / second, last = vv - l2 * uv;
  const double y1 = r1 - l1 * r0, y2 = r2 - l2 * y1;
  const double at_vv = y2 / last, at_uv = y1 / second - l2 * at_vv, at_uu = r0 / uu - l1 * at_uv;
  const Form form{.mean = 0.5 * (at_uu + at_vv), .difference = 0.5 * (at_uu - at_vv), .mixed = at_uv};

  const std::array<double, 3> areas = corner_areas(shape, dots, twice_area);
  const std::array corners{i, j, k};
  for (std::size_t c = 0; c < 3; ++c) {
    const double area = areas[corners[c]];
    fits[corners[c]]->add(seen[c].carried(form), area);
    fits[corners[c]]->area += area;
  }
}

std::vector<Fit> fit_fans(const Surface& surface, const std::vector<TangentFrame>& frames, const Task& task) {
  const std::vector<Triangle>& faces = corner_fans(surface).triangles;
  const FanPoints points(surface);
  std::vector<Fit> fits;
  resize(fits, frames.size(), task, 0.3);
  LowFaces low(surface);
  const Poll poll(task, 0.3, 0.8, faces.size());
  for (std::size_t f = 0; f < faces.size(); ++f) {
    poll.at(f);
    if (f + kAhead < faces.size()) {
      for (const std::int32_t fan : faces[f + kAhead]) {
        prefetch(&points[fan]);
        prefetch(&frames[fan]);
        prefetch(&fits[fan]);
      }
    }
    if (low.meets(f)) continue;
    const Triangle& fans = faces[f];
    const FaceShape shape = face_shape(points, fans, surface.scale());
    fit_face(shape, {&frames[fans[0]], &frames[fans[1]], &frames[fans[2]]},
             {&fits[fans[0]], &fits[fans[1]], &fits[fans[2]]});
  }
  return fits;
}

// A fan's form as that of a plane with another normal, its own turned over where `side` is -1.
Form seen_from(const TangentFrame& fan, const Form& form, double side, const TangentFrame& from) {
  if (side > 0.0) return SeenFrame(from, fan.u, fan.v(), fan.normal).carried(form);
  // Seen from the other side, curvatures change their sign, and u and v are no longer in the same order: with -v.
  const Vector v = -fan.v(), normal = -fan.normal;
  return SeenFrame(from, fan.u, v, normal)
      .carried({.mean = -form.mean, .difference = -form.difference, .mixed = form.mixed});
}

}  // namespace

std::vector<double> Curvature::difference() const {
  std::vector<double> s(k1.size());
  std::ranges::transform(k1, k2, s.begin(), [](double a, double b) { return std::abs(a) - std::abs(b); });
  return s;
}

std::vector<Vector> vertex_normals(const Surface& surface) {
  return combine(surface, fan_normals(surface, {}), {}).normals;
}

Curvature principal_curvatures(const Surface& surface, const Task& task) {
  const std::vector<Vector> fans = fan_normals(surface, task);
  std::vector<TangentFrame> frames;
  frames.reserve(fans.size());
  Poll framing(task, 0.25, 0.3, fans.size());
  for (const Vector& normal : fans) {
    framing.next();
    frames.push_back(fast_tangent_frame(normal));
  }
  const std::vector<Fit> fits = fit_fans(surface, frames, task);
  VertexNormals vertices = combine(surface, fans, task);
  const std::size_t count = surface.vertex_count();
  Curvature curvature;
  curvature.normals = std::move(vertices.normals);
  curvature.k1.assign(count, 0.0);
  curvature.k2.assign(count, 0.0);
  task.check(0.85);
  curvature.d1.assign(count, Vector::UnitX());
  curvature.d2.assign(count, Vector::UnitY());

  const auto& vertex_of_fan = corner_fans(surface).vertices;
  Poll poll(task, 0.85, 1.0, fans.size());
  for (std::size_t first = 0, end = 0; first < fans.size(); first = end) {
    poll.next();
    const std::int32_t vertex = vertex_of_fan[first];
    for (end = first + 1; end < fans.size() && vertex_of_fan[end] == vertex;) ++end;
    const Vector& normal = curvature.normals[vertex];
    const TangentFrame frame = end == first + 1 ? frames[first] : fast_tangent_frame(normal);
    Fit sum = fits[first];
    if (end > first + 1) {
      sum = {};
      for (std::size_t fan = first; fan < end; ++fan) {
        sum.add(seen_from(frames[fan], fits[fan].form, vertices.side_of_fan[fan], frame), 1.0);
        sum.area += fits[fan].area;
      }
    }
    if (normal.isZero(0.0)) continue;
    curvature.d1[vertex] = frame.u;
    curvature.d2[vertex] = frame.v();
    if (!(sum.area > 0.0)) continue;
    const double inverse = 1.0 / sum.area;
    const Form form{.mean = inverse * sum.form.mean,
                    .difference = inverse * sum.form.difference,
                    .mixed = inverse * sum.form.mixed};
    if (!std::isfinite(form.mean + form.difference + form.mixed)) continue;
    decompose(frame, form, vertex, curvature);
    curvature.k1[vertex] *= surface.scale();  // the fits are of the unit cube
    curvature.k2[vertex] *= surface.scale();
  }
  return curvature;
}

Curvature smoothed_curvatures(const Surface& surface, const Curvature& curvature, double radius, const Task& task) {
  const std::size_t count = surface.vertex_count();
  check_size(surface, curvature);
  if (!(std::isfinite(radius) && radius > 0.0)) {
    throw InvalidInput("radius is " + text(radius) + ", not a finite number above 0");
  }
  const Neighborhood near = neighborhood(surface, curvature.normals, task);
  if (near.median_side == 0.0) return curvature;
  std::vector<Form> forms(count);
  std::vector<double> weights = near.areas;
  for (const Side& side : near.sides) {
    weights[side.a] += near.areas[side.b];
    weights[side.b] += near.areas[side.a];
  }
  for (std::size_t v = 0; v < count; ++v) {
    const TangentFrame& frame = near.frames[v];
    const double x = curvature.d1[v].dot(frame.u), y = curvature.d1[v].dot(frame.v());
    const double half = 0.5 * (curvature.k1[v] - curvature.k2[v]);
    forms[v] = {.mean = 0.5 * (curvature.k1[v] + curvature.k2[v]),
                .difference = half * (x * x - y * y),
                .mixed = half * 2.0 * x * y};
  }
  const double wanted = std::round(radius * radius / (near.median_side * near.median_side));
  const auto rounds = static_cast<std::size_t>(std::clamp(wanted, 1.0, kMostRounds));
  std::vector<Form> sums(count);
  Poll poll(task, 0.2, 1.0, rounds * (near.sides.size() + count));
  const auto add = [](Form& sum, const Form& form, double weight) {
    sum.mean += weight * form.mean;
    sum.difference += weight * form.difference;
    sum.mixed += weight * form.mixed;
  };
  for (std::size_t round = 0; round < rounds; ++round) {
    for (std::size_t v = 0; v < count; ++v) {
      poll.next();
      sums[v] = {};
      add(sums[v], forms[v], near.areas[v]);
    }
    for (const auto& [a, b, c, s] : near.sides) {
      poll.next();
      add(sums[b], turned(forms[a], c, s), near.areas[a]);
      add(sums[a], turned(forms[b], c, -s), near.areas[b]);
    }
    for (std::size_t v = 0; v < count; ++v) {
      if (!(weights[v] > 0.0)) continue;
      forms[v] = {};
      add(forms[v], sums[v], 1.0 / weights[v]);
    }
  }
  Curvature smoothed = curvature;
  for (std::size_t v = 0; v < count; ++v) {
    if (!curvature.normals[v].isZero(0.0)) decompose(near.frames[v], forms[v], v, smoothed);
  }
  return smoothed;
}

}  // namespace seamwire
