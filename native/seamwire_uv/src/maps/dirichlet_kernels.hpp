// SPDX-License-Identifier: GPL-3.0-or-later
//
// The symmetric Dirichlet energy of many triangles at once.
//
// A triangle's map is written in complex numbers: f(z) = p z + q conj(z), with z in the plane of the rest triangle.
// The singular values of its Jacobian are |p| + |q| and |p| - |q|. Let P_k be the complex derivative of the hat
// function of corner k, and u_k the corner's UV. Then p is the sum of P_k u_k, and q the sum of conj(P_k) u_k. The rest
// shape is known by P_1 and P_2, because the three derivatives add up to zero.
#pragma once

#include <cstddef>

#include "numeric/instruction_sets.hpp"

namespace seamwire::detail {

/// How many triangles a kernel is called for, at most.
inline constexpr std::size_t kTrianglesAtOnce = 64;

/// Rest shapes, array by array: P_1, P_2 and the area's share of the whole.
struct RestShapes {
  const double *p1x, *p1y, *p2x, *p2y, *weight;
};

/// UVs of corners 1 and 2, minus those of corner 0.
struct Sides {
  double e1x[kTrianglesAtOnce], e1y[kTrianglesAtOnce], e2x[kTrianglesAtOnce], e2y[kTrianglesAtOnce];
};

/// Gradients and projected Hessians with respect to corners 1 and 2. What belongs to corner 0 follows from the sums
/// being zero. In h12 the first index is corner 1.
struct Derivatives {
  double g1x[kTrianglesAtOnce], g1y[kTrianglesAtOnce], g2x[kTrianglesAtOnce], g2y[kTrianglesAtOnce];
  double h11xx[kTrianglesAtOnce], h11xy[kTrianglesAtOnce], h11yy[kTrianglesAtOnce];
  double h12xx[kTrianglesAtOnce], h12xy[kTrianglesAtOnce], h12yx[kTrianglesAtOnce], h12yy[kTrianglesAtOnce];
  double h22xx[kTrianglesAtOnce], h22xy[kTrianglesAtOnce], h22yy[kTrianglesAtOnce];
};

struct DirichletKernels {
  /// Writes each triangle's energy, not weighted; infinite for a triangle that is not counter-clockwise.
  void (*energies)(const RestShapes& rest, const Sides& sides, std::size_t count, double* energies);
  /// All triangles have to be counter-clockwise.
  void (*derivatives)(const RestShapes& rest, const Sides& sides, std::size_t count, Derivatives& out);
  /// Writes the least positive step along `moves` at which each triangle has no area; infinite if it always has (Smith
  /// and Schaefer 2015, Section 3.3).
  void (*first_flips)(const Sides& sides, const Sides& moves, std::size_t count, double* steps);
};

const InstructionSets<DirichletKernels>& dirichlet_kernels();

}  // namespace seamwire::detail
