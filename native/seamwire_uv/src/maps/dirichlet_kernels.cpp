// SPDX-License-Identifier: GPL-3.0-or-later
#include "maps/dirichlet_kernels.hpp"

#include <cmath>

#include "detail/always_inline.hpp"
#include "detail/infinity.hpp"

namespace seamwire::detail {
namespace {

/// Below this, |q| has no direction that matters.
constexpr double kNoDirection = 1e-150;

SEAMWIRE_INLINE double most(double a, double b) { return a > b ? a : b; }

SEAMWIRE_INLINE void energies_of(const RestShapes& rest, const Sides& sides, std::size_t count, double* energies) {
  const RestShapes r = rest;
  SEAMWIRE_VECTORIZE
  for (std::size_t i = 0; i < count; ++i) {
    const double e1x = sides.e1x[i], e1y = sides.e1y[i], e2x = sides.e2x[i], e2y = sides.e2y[i];
    const double px = r.p1x[i] * e1x - r.p1y[i] * e1y + (r.p2x[i] * e2x - r.p2y[i] * e2y);
    const double py = r.p1x[i] * e1y + r.p1y[i] * e1x + (r.p2x[i] * e2y + r.p2y[i] * e2x);
    const double qx = r.p1x[i] * e1x + r.p1y[i] * e1y + (r.p2x[i] * e2x + r.p2y[i] * e2y);
    const double qy = r.p1x[i] * e1y - r.p1y[i] * e1x + (r.p2x[i] * e2y - r.p2y[i] * e2x);
    const double cross = e1x * e2y - e1y * e2x;
    const double determinant = cross * (4.0 * (r.p1y[i] * r.p2x[i] - r.p1x[i] * r.p2y[i]));
    const double frobenius = 2.0 * (px * px + py * py + (qx * qx + qy * qy));
    const double energy = frobenius + frobenius / (determinant * determinant);
    energies[i] = cross > 0.0 ? energy : kInfinity;
  }
}

SEAMWIRE_INLINE void derivatives_of(const RestShapes& rest, const Sides& sides, std::size_t count, Derivatives& out) {
  const RestShapes r = rest;
  SEAMWIRE_VECTORIZE
  for (std::size_t i = 0; i < count; ++i) {
    const double e1x = sides.e1x[i], e1y = sides.e1y[i], e2x = sides.e2x[i], e2y = sides.e2y[i];
    const double p1x = r.p1x[i], p1y = r.p1y[i], p2x = r.p2x[i], p2y = r.p2y[i], weight = r.weight[i];
    const double px = p1x * e1x - p1y * e1y + (p2x * e2x - p2y * e2y);
    const double py = p1x * e1y + p1y * e1x + (p2x * e2y + p2y * e2x);
    const double qx = p1x * e1x + p1y * e1y + (p2x * e2x + p2y * e2y);
    const double qy = p1x * e1y - p1y * e1x + (p2x * e2y - p2y * e2x);
    const double determinant = (e1x * e2y - e1y * e2x) * (4.0 * (p1y * p2x - p1x * p2y));
    const double p_length = std::sqrt(px * px + py * py), q_length = std::sqrt(qx * qx + qy * qy);
    // The singular values, their first and second derivatives of the energy, and the eigenvalues of twist and flip.
    const double s1 = p_length + q_length, s2 = determinant / s1;
    const double i1 = 1.0 / s1, i2 = 1.0 / s2, i1i1 = i1 * i1, i2i2 = i2 * i2;
    const double psi1 = 2.0 * (s1 - i1 * i1i1), psi2 = 2.0 * (s2 - i2 * i2i2);
    const double second1 = 2.0 + 6.0 * i1i1 * i1i1, second2 = 2.0 + 6.0 * i2i2 * i2i2;
    const double squares = s1 * s1 + s2 * s2, cube = i1i1 * i1 * (i2i2 * i2);
    const double twist = weight * most(4.0 - 4.0 * (squares - determinant) * cube, 0.0);
    const double flip = weight * (4.0 + 4.0 * (squares + determinant) * cube);
    const double along = weight * (second1 + second2), across = weight * (second1 - second2);
    const double p_slope = weight * (psi1 + psi2), q_slope = weight * (psi1 - psi2);
    const double p_inverse = 1.0 / p_length, q_inverse = 1.0 / most(q_length, kNoDirection);
    const double pux = px * p_inverse, puy = py * p_inverse;
    const double qux = q_length > kNoDirection ? qx * q_inverse : 1.0,
                 quy = q_length > kNoDirection ? qy * q_inverse : 0.0;
    // conj(P_k) p / |p| and P_k q / |q|.
    const double a1x = p1x * pux + p1y * puy, a1y = p1x * puy - p1y * pux;
    const double a2x = p2x * pux + p2y * puy, a2y = p2x * puy - p2y * pux;
    const double b1x = p1x * qux - p1y * quy, b1y = p1x * quy + p1y * qux;
    const double b2x = p2x * qux - p2y * quy, b2y = p2x * quy + p2y * qux;
    out.g1x[i] = p_slope * a1x + q_slope * b1x;
    out.g1y[i] = p_slope * a1y + q_slope * b1y;
    out.g2x[i] = p_slope * a2x + q_slope * b2x;
    out.g2y[i] = p_slope * a2y + q_slope * b2y;
    // What corner 2 is multiplied with from the left, by direction.
    const double c1ax = along * a1x + across * b1x, c1ay = along * a1y + across * b1y;
    const double c1bx = along * b1x + across * a1x, c1by = along * b1y + across * a1y;
    const double c2ax = along * a2x + across * b2x, c2ay = along * a2y + across * b2y;
    const double c2bx = along * b2x + across * a2x, c2by = along * b2y + across * a2y;
    const double t1x = twist * a1x, t1y = twist * a1y, t2x = twist * a2x, t2y = twist * a2y;
    const double f1x = flip * b1x, f1y = flip * b1y, f2x = flip * b2x, f2y = flip * b2y;
    out.h11xx[i] = c1ax * a1x + c1bx * b1x + (t1y * a1y + f1y * b1y);
    out.h11xy[i] = c1ax * a1y + c1bx * b1y - (t1y * a1x + f1y * b1x);
    out.h11yy[i] = c1ay * a1y + c1by * b1y + (t1x * a1x + f1x * b1x);
    out.h12xx[i] = c1ax * a2x + c1bx * b2x + (t1y * a2y + f1y * b2y);
    out.h12xy[i] = c1ax * a2y + c1bx * b2y - (t1y * a2x + f1y * b2x);
    out.h12yx[i] = c1ay * a2x + c1by * b2x - (t1x * a2y + f1x * b2y);
    out.h12yy[i] = c1ay * a2y + c1by * b2y + (t1x * a2x + f1x * b2x);
    out.h22xx[i] = c2ax * a2x + c2bx * b2x + (t2y * a2y + f2y * b2y);
    out.h22xy[i] = c2ax * a2y + c2bx * b2y - (t2y * a2x + f2y * b2x);
    out.h22yy[i] = c2ay * a2y + c2by * b2y + (t2x * a2x + f2x * b2x);
  }
}

SEAMWIRE_INLINE void first_flips_of(const Sides& sides, const Sides& moves, std::size_t count, double* steps) {
  SEAMWIRE_VECTORIZE
  for (std::size_t i = 0; i < count; ++i) {
    const double e1x = sides.e1x[i], e1y = sides.e1y[i], e2x = sides.e2x[i], e2y = sides.e2y[i];
    const double d1x = moves.e1x[i], d1y = moves.e1y[i], d2x = moves.e2x[i], d2y = moves.e2y[i];
    // Twice the area is a + b t + c t^2, with a > 0. In this form the least positive root loses no digits.
    const double a = e1x * e2y - e1y * e2x, c = d1x * d2y - d1y * d2x;
    const double b = e1x * d2y - e1y * d2x + (d1x * e2y - d1y * e2x);
    const double discriminant = b * b - 4.0 * a * c;
    const double denominator = std::sqrt(most(discriminant, 0.0)) - b;
    const bool flips = (discriminant >= 0.0) & (denominator > 0.0);
    const double step = 2.0 * a / denominator;
    steps[i] = flips ? step : kInfinity;
  }
}

// NOLINTBEGIN(bugprone-macro-parentheses): an attribute
#define SEAMWIRE_DIRICHLET_KERNELS(TARGET, WIDTH)                                                            \
  TARGET void energies(const RestShapes& rest, const Sides& sides, std::size_t count, double* values) {      \
    energies_of(rest, sides, count, values);                                                                 \
  }                                                                                                          \
  TARGET void derivatives(const RestShapes& rest, const Sides& sides, std::size_t count, Derivatives& out) { \
    derivatives_of(rest, sides, count, out);                                                                 \
  }                                                                                                          \
  TARGET void first_flips(const Sides& sides, const Sides& moves, std::size_t count, double* steps) {        \
    first_flips_of(sides, moves, count, steps);                                                              \
  }                                                                                                          \
  constexpr DirichletKernels kKernels{energies, derivatives, first_flips};
// NOLINTEND(bugprone-macro-parentheses)

SEAMWIRE_COMPILE_VARIANTS(SEAMWIRE_DIRICHLET_KERNELS)

}  // namespace

const InstructionSets<DirichletKernels>& dirichlet_kernels() { return kVariants; }

}  // namespace seamwire::detail
