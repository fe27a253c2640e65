// SPDX-License-Identifier: GPL-3.0-or-later
//
// Rusinkiewicz, "Estimating Curvatures and Their Derivatives on Triangle Meshes", 3DPVT 2004.
// Max, "Weights for Computing Vertex Normals from Facet Normals", Journal of Graphics Tools 4(2), 1999.
// Meyer, Desbrun, Schroeder, Barr, "Discrete Differential-Geometry Operators for Triangulated 2-Manifolds", 2003.
#include "seamwire/curvature.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace seamwire {
namespace {

// A triangle lower than this, on the unit cube's scale, tells nothing of the surface's direction: so high does storing
// coordinates as 32-bit floats make triangles whose corners are in line. Fits to them make curvatures of any size.
constexpr double kLeastHeight = 0x1p-22;

struct FaceShape {
  std::array<int, 3> fans;
  std::array<Vector, 3> edges;  // opposite the corners, in the face's direction
  std::array<double, 3> squared_lengths;
  Vector cross;  // along the normal, twice the area long
  double twice_area;

  double longest() const { return std::sqrt(*std::ranges::max_element(squared_lengths)); }
  bool is_usable() const { return twice_area >= kLeastHeight * longest(); }
};

FaceShape face_shape(const Surface& surface, int face) {
  const HalfEdgeMesh& mesh = surface.half_edges();
  const auto h0 = mesh.halfedge_handle(OpenMesh::FaceHandle(face));
  const auto h1 = mesh.next_halfedge_handle(h0);
  const auto h2 = mesh.next_halfedge_handle(h1);
  const std::array corners{mesh.to_vertex_handle(h0), mesh.to_vertex_handle(h1), mesh.to_vertex_handle(h2)};
  FaceShape shape;
  for (std::size_t i = 0; i < 3; ++i) {
    shape.fans[i] = corners[i].idx();
    shape.edges[i] = surface.scale() * (mesh.point(corners[(i + 2) % 3]) - mesh.point(corners[(i + 1) % 3]));
    shape.squared_lengths[i] = shape.edges[i].squaredNorm();
  }
  shape.cross = shape.edges[0].cross(shape.edges[1]);
  shape.twice_area = shape.cross.norm();
  return shape;
}

Vector normalized_or_zero(const Vector& v) {
  const double length = v.norm();
  return length > 0.0 ? Vector(v / length) : Vector(Vector::Zero());
}

// The normals of the corner fans, each on its own side of the surface; zero where a fan has no area at all.
std::vector<Vector> fan_normals(const Surface& surface) {
  std::vector<Vector> normals(surface.half_edges().n_vertices(), Vector::Zero());
  std::vector<FaceShape> flat;
  for (int f = 0; f < static_cast<int>(surface.half_edges().n_faces()); ++f) {
    const FaceShape shape = face_shape(surface, f);
    if (!shape.is_usable()) {
      if (shape.twice_area > 0.0) flat.push_back(shape);
      continue;
    }
    for (std::size_t i = 0; i < 3; ++i) {
      const double adjacent = shape.squared_lengths[(i + 1) % 3] * shape.squared_lengths[(i + 2) % 3];
      normals[shape.fans[i]] += shape.cross / adjacent;
    }
  }
  for (Vector& normal : normals) normal = normalized_or_zero(normal);
  // A fan of none but flat triangles takes the direction of the widest of them.
  std::ranges::stable_sort(flat, std::ranges::greater{}, &FaceShape::twice_area);
  for (const FaceShape& shape : flat) {
    for (const int fan : shape.fans) {
      if (normals[fan].isZero(0.0)) normals[fan] = normalized_or_zero(shape.cross);
    }
  }
  return normals;
}

// For each fan 1 or -1: fans of one vertex need not agree on which side of the surface is outside (where a one-sided
// surface is cut they cannot), so the vertex takes the side of the first that has a normal.
struct VertexNormals {
  std::vector<Vector> normals;
  std::vector<signed char> side_of_fan;
};

VertexNormals combine(const Surface& surface, const std::vector<Vector>& fans) {
  const auto& vertex_of_fan = surface.vertex_of_fan();
  VertexNormals result;
  result.normals.assign(surface.vertex_count(), Vector::Zero());
  result.side_of_fan.assign(fans.size(), 1);
  for (std::size_t first = 0; first < fans.size();) {
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

// A tangent plane: u, v, normal orthonormal and right-handed.
struct Frame {
  Vector u, v, normal;
};

// Duff et al., "Building an Orthonormal Basis, Revisited", 2017.
Frame frame_of(const Vector& n) {
  const double sign = std::copysign(1.0, n.z());
  const double a = -1.0 / (sign + n.z());
  const double b = n.x() * n.y() * a;
  return {.u = {1.0 + sign * n.x() * n.x() * a, sign * b, -sign * n.x()},
          .v = {b, sign + n.y() * n.y() * a, -n.y()},
          .normal = n};
}

// The second fundamental form in a frame: uu u^2 + 2 uv u v + vv v^2.
struct Form {
  double uu = 0.0, uv = 0.0, vv = 0.0;

  Form& operator+=(const Form& other) {
    uu += other.uu;
    uv += other.uv;
    vv += other.vv;
    return *this;
  }
};

Form operator*(double factor, const Form& form) { return {factor * form.uu, factor * form.uv, factor * form.vv}; }

// A form seen from another tangent plane, turned onto it by the least rotation.
Form carried(const Form& form, const Frame& from, const Frame& to) {
  // The rotation that takes to.normal to from.normal moves a vector x of the plane `to` along the sum of the normals.
  // Where these are opposite it is not defined, and any direction is as good: leave x.
  const Vector sum = to.normal + from.normal;
  const double denominator = 1.0 + to.normal.dot(from.normal);
  const auto turned = [&](const Vector& x) -> Vector {
    return denominator > 1e-12 ? Vector(x - x.dot(from.normal) / denominator * sum) : x;
  };
  const Vector u = turned(to.u);
  const Vector v = turned(to.v);
  const double u1 = u.dot(from.u), u2 = u.dot(from.v);
  const double v1 = v.dot(from.u), v2 = v.dot(from.v);
  return {.uu = form.uu * u1 * u1 + 2.0 * form.uv * u1 * u2 + form.vv * u2 * u2,
          .uv = form.uu * u1 * v1 + form.uv * (u1 * v2 + u2 * v1) + form.vv * u2 * v2,
          .vv = form.uu * v1 * v1 + 2.0 * form.uv * v1 * v2 + form.vv * v2 * v2};
}

// The form that fits the differences of the corner normals along the three edges best, in the face's frame.
bool fit(const FaceShape& shape, const std::array<Vector, 3>& corner_normals, Frame& frame, Form& form) {
  // With u along the longest edge the equations are graded, so that Cholesky's method needs no pivots on slivers.
  const auto longest = std::ranges::max_element(shape.squared_lengths) - shape.squared_lengths.begin();
  frame.normal = shape.cross / shape.twice_area;
  frame.u = shape.edges[longest] / std::sqrt(shape.squared_lengths[longest]);
  frame.v = frame.normal.cross(frame.u);
  double uu = 0.0, uv = 0.0, vv = 0.0;
  Eigen::Vector3d right = Eigen::Vector3d::Zero();
  for (std::size_t i = 0; i < 3; ++i) {
    const double u = shape.edges[i].dot(frame.u);
    const double v = shape.edges[i].dot(frame.v);
    const Vector turn = corner_normals[(i + 2) % 3] - corner_normals[(i + 1) % 3];
    const double turn_u = turn.dot(frame.u);
    const double turn_v = turn.dot(frame.v);
    uu += u * u;
    uv += u * v;
    vv += v * v;
    right += Eigen::Vector3d(turn_u * u, turn_u * v + turn_v * u, turn_v * v);
  }
  Eigen::Matrix3d matrix;
  matrix << uu, uv, 0.0, uv, uu + vv, uv, 0.0, uv, vv;
  const Eigen::LLT<Eigen::Matrix3d> solver(matrix);
  if (solver.info() != Eigen::Success) return false;
  const Eigen::Vector3d solution = solver.solve(right);
  form = {.uu = solution[0], .uv = solution[1], .vv = solution[2]};
  return solution.allFinite();
}

// The share of the face's area that is nearest to each corner (the Voronoi area of Meyer et al., exact for obtuse
// triangles too).
std::array<double, 3> corner_areas(const FaceShape& shape) {
  const double area = 0.5 * shape.twice_area;
  std::array<double, 3> dots;  // of the two edges that leave each corner
  for (std::size_t i = 0; i < 3; ++i) dots[i] = -shape.edges[(i + 1) % 3].dot(shape.edges[(i + 2) % 3]);
  std::array<double, 3> areas;
  for (std::size_t i = 0; i < 3; ++i) {
    if (dots[i] > 0.0) continue;
    // Obtuse at i: each other corner j keeps the right triangle cut off by the bisector of its edge to i, whose area
    // is l^2 / 8 tan(angle at j).
    const std::size_t j = (i + 1) % 3;
    const std::size_t k = (i + 2) % 3;
    areas[j] = shape.squared_lengths[k] / 8.0 * shape.twice_area / dots[j];
    areas[k] = shape.squared_lengths[j] / 8.0 * shape.twice_area / dots[k];
    areas[i] = area - areas[j] - areas[k];
    return areas;
  }
  // l^2 / 8 cot(opposite angle) on either side of each edge.
  std::array<double, 3> halves;
  for (std::size_t i = 0; i < 3; ++i) halves[i] = shape.squared_lengths[i] / 8.0 * dots[i] / shape.twice_area;
  for (std::size_t i = 0; i < 3; ++i) areas[i] = halves[(i + 1) % 3] + halves[(i + 2) % 3];
  return areas;
}

// Per fan, with the fan's own normal: sums of form times area, and of the areas.
struct Fit {
  Form form;
  double area = 0.0;
};

std::vector<Fit> fit_fans(const Surface& surface, const std::vector<Vector>& fan_normals) {
  std::vector<Frame> frames;
  frames.reserve(fan_normals.size());
  for (const Vector& normal : fan_normals) frames.push_back(frame_of(normal));
  std::vector<Fit> fits(fan_normals.size());
  for (int f = 0; f < static_cast<int>(surface.half_edges().n_faces()); ++f) {
    const FaceShape shape = face_shape(surface, f);
    if (!shape.is_usable()) continue;
    const auto& [a, b, c] = shape.fans;
    Frame frame;
    Form form;
    if (!fit(shape, {fan_normals[a], fan_normals[b], fan_normals[c]}, frame, form)) continue;
    const std::array<double, 3> areas = corner_areas(shape);
    for (std::size_t i = 0; i < 3; ++i) {
      Fit& at_fan = fits[shape.fans[i]];
      at_fan.form += areas[i] * carried(form, frame, frames[shape.fans[i]]);
      at_fan.area += areas[i];
    }
  }
  return fits;
}

}  // namespace

std::vector<double> Curvature::difference() const {
  std::vector<double> s(k1.size());
  std::ranges::transform(k1, k2, s.begin(), [](double a, double b) { return std::abs(a) - std::abs(b); });
  return s;
}

std::vector<Vector> vertex_normals(const Surface& surface) { return combine(surface, fan_normals(surface)).normals; }

Curvature principal_curvatures(const Surface& surface) {
  const std::vector<Vector> fans = fan_normals(surface);
  const std::vector<Fit> fits = fit_fans(surface, fans);
  VertexNormals vertices = combine(surface, fans);
  const std::size_t count = surface.vertex_count();
  Curvature curvature;
  curvature.normals = std::move(vertices.normals);
  curvature.k1.assign(count, 0.0);
  curvature.k2.assign(count, 0.0);
  curvature.d1.assign(count, Vector::UnitX());
  curvature.d2.assign(count, Vector::UnitY());

  const auto& vertex_of_fan = surface.vertex_of_fan();
  for (std::size_t first = 0; first < fans.size();) {
    const std::int32_t vertex = vertex_of_fan[first];
    const Vector& normal = curvature.normals[vertex];
    const Frame frame = frame_of(normal);
    Fit sum;
    std::size_t fan = first;
    for (; fan < fans.size() && vertex_of_fan[fan] == vertex; ++fan) {
      // Seen from the other side of the surface, curvatures change their sign.
      const double side = vertices.side_of_fan[fan];
      Frame own = frame_of(fans[fan]);
      own.normal *= side;
      sum.form += side * carried(fits[fan].form, own, frame);
      sum.area += fits[fan].area;
    }
    first = fan;
    if (normal.isZero(0.0)) continue;
    curvature.d1[vertex] = frame.u;
    curvature.d2[vertex] = frame.v;
    if (!(sum.area > 0.0)) continue;

    const Form form = 1.0 / sum.area * sum.form;
    Eigen::Matrix2d matrix;
    matrix << form.uu, form.uv, form.uv, form.vv;
    if (!matrix.allFinite()) continue;
    Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> solver;
    solver.computeDirect(matrix);
    const int larger = std::abs(solver.eigenvalues()[0]) > std::abs(solver.eigenvalues()[1]) ? 0 : 1;
    const Eigen::Vector2d direction = solver.eigenvectors().col(larger);
    curvature.k1[vertex] = solver.eigenvalues()[larger];
    curvature.k2[vertex] = solver.eigenvalues()[1 - larger];
    curvature.d1[vertex] = (direction.x() * frame.u + direction.y() * frame.v).normalized();
    curvature.d2[vertex] = normal.cross(curvature.d1[vertex]);
  }
  return curvature;
}

}  // namespace seamwire
