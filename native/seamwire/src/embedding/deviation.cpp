// SPDX-License-Identifier: GPL-3.0-or-later
#include "embedding/deviation.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "detail/poll.hpp"

namespace seamwire::detail {
namespace {

// A quadratic form on the plane of a triangle, in the basis of its first two sides.
struct PlaneForm {
  double uu, uv, vv;
  double determinant;
};

// The constant form that gives a triangle's sides their lengths. The determinant is 4 times the squared area, after
// Kahan, "Miscalculating Area and Angles of a Needle-like Triangle".
PlaneForm form_of_lengths(const BisectedMesh& mesh, std::int32_t f) {
  const double* l = &mesh.lengths[3 * index(f)];
  double a = l[0], b = l[1], c = l[2];
  if (a < b) std::swap(a, b);
  if (b < c) std::swap(b, c);
  if (a < b) std::swap(a, b);
  const double squared_area_16 = (a + (b + c)) * (c - (a - b)) * (c + (a - b)) * (a + (b - c));
  return {.uu = l[0] * l[0],
          .uv = (l[2] * l[2] - l[0] * l[0] - l[1] * l[1]) / 2,
          .vv = l[1] * l[1],
          .determinant = squared_area_16 / 4};
}

// The plane of a triangle, by its first two sides and their cross product.
struct Plane {
  Plane(const BisectedMesh& mesh, std::int32_t f) : u(mesh.vector(3 * f)), v(mesh.vector(3 * f + 1)), n(u.cross(v)) {}
  Vector u, v, n;
};

// A form in space on a plane. Its determinant is the value of the adjugate form for the cross product: as a difference
// of products it would be lost for thin triangles.
PlaneForm restricted(const SpaceForm& form, const Plane& plane) {
  const auto& [u, v, n] = plane;
  const double xx = form[0], yy = form[1], zz = form[2], xy = form[3] / 2, xz = form[4] / 2, yz = form[5] / 2;
  const Vector of_u(xx * u.x() + xy * u.y() + xz * u.z(), xy * u.x() + yy * u.y() + yz * u.z(),
                    xz * u.x() + yz * u.y() + zz * u.z());
  const Vector of_v(xx * v.x() + xy * v.y() + xz * v.z(), xy * v.x() + yy * v.y() + yz * v.z(),
                    xz * v.x() + yz * v.y() + zz * v.z());
  const double determinant = (yy * zz - yz * yz) * n.x() * n.x() + (xx * zz - xz * xz) * n.y() * n.y() +
                             (xx * yy - xy * xy) * n.z() * n.z() + 2 * (xz * yz - xy * zz) * n.x() * n.y() +
                             2 * (xy * yz - xz * yy) * n.x() * n.z() + 2 * (xy * xz - yz * xx) * n.y() * n.z();
  return {.uu = u.dot(of_u), .uv = u.dot(of_v), .vv = v.dot(of_v), .determinant = determinant};
}

// The largest factor, up or down, between the squared lengths of one vector in two forms: of the eigenvalues of
// g^-1 h and their inverses the largest. With the Cholesky factor L of g, the eigenvalues are those of the symmetric
// matrix L^-1 h L^-T, with the entries p, q; q, r.
double largest_ratio(const PlaneForm& g, const PlaneForm& h) {
  const double product = h.determinant / g.determinant;
  const double p = h.uu / g.uu, q = (h.uv - p * g.uv) / std::sqrt(g.determinant), r = (product + q * q) / p;
  const double high = (p + r + std::sqrt((p - r) * (p - r) + 4 * q * q)) / 2;
  return std::max(high, high / product);
}

}  // namespace

double error_score(const BisectedMesh& mesh, std::int32_t f) {
  const PlaneForm g = form_of_lengths(mesh, f);
  const Triangle& corners = mesh.triangles[f];
  const SpaceForm &a = mesh.form(corners[0]), &b = mesh.form(corners[1]), &c = mesh.form(corners[2]);
  SpaceForm mean;
  for (std::size_t i = 0; i < mean.size(); ++i) mean[i] = (a[i] + b[i] + c[i]) / 3;
  const double deviation = std::log(largest_ratio(g, restricted(mean, Plane(mesh, f)))) / 2;
  const double area = std::sqrt(g.determinant) / 2;
  return deviation * std::sqrt(area) / mesh.mean_edge_length();
}

Resolution measure_resolution(const BisectedMesh& mesh, double tolerance, const Task& task, double progress) {
  double highest = 0;
  Resolution resolution;
  const Poll poll(task, progress, progress, mesh.face_count());
  for (std::int32_t f = 0; index(f) < mesh.face_count(); ++f) {
    poll.at(index(f));
    if (!mesh.is_valid(f)) continue;
    const double score = error_score(mesh, f);
    highest = std::max(highest, score);
    if (score > tolerance) ++resolution.unmet;
  }
  resolution.estimated_error = highest / kScorePerError;
  return resolution;
}

}  // namespace seamwire::detail
