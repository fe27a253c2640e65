// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Geometry>
#include <cmath>

#include "seamwire/surface/vector.hpp"

namespace seamwire::detail {

/// A tangent plane by its normal and an orthonormal basis (u, v): u, v and the normal are right-handed.
struct TangentFrame {
  Vector normal, u;

  Vector v() const { return normal.cross(u); }
};

/// Some frame of the plane with a unit normal: u is across the coordinate axis least aligned with the normal, which is
/// safely independent of it.
inline TangentFrame tangent_frame(const Vector& normal) {
  Eigen::Index axis = 0;
  normal.cwiseAbs().minCoeff(&axis);
  return {normal, normal.cross(Vector::Unit(axis)).normalized()};
}

/// Another one without a root: Duff et al., "Building an Orthonormal Basis, Revisited" (2017).
inline TangentFrame fast_tangent_frame(const Vector& n) {
  const double sign = std::copysign(1.0, n.z());
  const double a = -1.0 / (sign + n.z());
  return {.normal = n, .u = {1.0 + sign * n.x() * n.x() * a, sign * n.x() * n.y() * a, -sign * n.x()}};
}

// The least rotation from one unit normal m to another, n, turns about m x n. It takes a vector d of m's plane to
//   d - (d.n) / (1 + m.n) (m + n).
// It is not defined where the normals are opposite; the tangent planes are the same then.

/// Normals with 1 + m.n = |m + n|^2 / 2 below this are opposite: rounding of 1e-16 is then 1e-4 of it.
inline constexpr double kOppositeNormals = 1e-12;

/// A tangent vector after the least rotation from one normal to another; as it is where they are opposite.
inline Vector turned_by_least_rotation(const Vector& d, const Vector& from, const Vector& to) {
  const double c = 1 + from.dot(to);
  return c < kOppositeNormals ? d : Vector(d - d.dot(to) / c * (from + to));
}

/// A symmetric tangent tensor after the least rotation from one normal to another. Where they are opposite, or `from`
/// is zero, it is projected onto the plane of `to`; where `to` is zero, it is left as it is.
inline Eigen::Matrix3d turned_by_least_rotation(const Eigen::Matrix3d& tensor, const Vector& from, const Vector& to) {
  const double c = from.dot(to);
  if (to.isZero(0)) return tensor;
  if (from.isZero(0) || 1 + c < kOppositeNormals) {
    const Eigen::Matrix3d onto = Eigen::Matrix3d::Identity() - to * to.transpose();
    return onto * tensor * onto;
  }
  const Vector v = from.cross(to);
  Eigen::Matrix3d r = v * v.transpose() / (1 + c);
  r.diagonal().array() += c;
  r(0, 1) -= v.z();
  r(1, 0) += v.z();
  r(0, 2) += v.y();
  r(2, 0) -= v.y();
  r(1, 2) -= v.x();
  r(2, 1) += v.x();
  return r * tensor * r.transpose();
}

}  // namespace seamwire::detail
