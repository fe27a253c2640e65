// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "seamwire/api.hpp"
#include "seamwire/metric/curvature.hpp"
#include "seamwire/surface/surface.hpp"
#include "seamwire/task.hpp"

namespace seamwire {

/// Which crest lines are kept.
struct CrestLineOptions {
  /// Of a line, the least integral of |k1| along it. It is in radians, so it does not depend on the size of the model.
  double least_strength = 1.0;
  /// Of its points, the least share by which curvature has fallen one radius of curvature away on both sides. Lines
  /// that noise draws on a sphere, cylinder or torus, where curvature does not fall, have none. In [0, 1).
  double least_drop = 0.15;
};

/// Ridges and valleys: curves along which the surface bends most sharply across.
struct CrestLines {
  /// All lines one after the other, in the caller's coordinates, each point on an edge. A closed line ends with its
  /// first point.
  std::vector<Vector> points;
  std::vector<Edge> edges;    ///< per point: the edge that it lies on, in the caller's vertices
  std::vector<double> parts;  ///< per point: where on it, 0 at its first vertex, 1 at its second
  std::vector<double>
      curvatures;  ///< per point: k1, unit as in Curvature; above 0 on ridges, but where a gap is bridged
  std::vector<std::int32_t> starts;  ///< line i has the points starts[i] to starts[i + 1] - 1; one more than lines
  std::vector<double> strengths;     ///< per line: the integral of |k1| along it; the strongest line is the first
  std::vector<std::int32_t> faces;   ///< per point: the caller's face to the next one; -1 for a line's last point
};

/// Finds crest lines as Yoshizawa, Belyaev, Seidel, "Fast and robust detection of crest lines on meshes" (2005). On
/// them, the larger curvature k1 is largest along its own direction d1, so e = dk1 / dd1 = 0. e comes from the
/// derivative of the curvature tensor in each face (Rusinkiewicz 2004, Section 4). It is averaged over the faces around
/// a vertex by their areas. Lines follow from its signs in each triangle, as in Hildebrandt, Polthier, Wardetzky,
/// "Smooth feature lines on surface meshes" (2005). Ridges have k1 > 0, valleys k1 < 0. Their strength is the paper's
/// integral of curvature. The paper's second threshold is how far the surface is from a cyclide of Dupin. Here,
/// least_drop takes its place (docs/method/curvature.md).
///
/// `curvature`: of principal_curvatures(), or better smoothed. Throws InvalidInput for curvatures of another size and
/// options out of range; Cancelled.
SEAMWIRE_API CrestLines crest_lines(const Surface& surface, const Curvature& curvature,
                                    const CrestLineOptions& options = {}, const Task& task = {});

}  // namespace seamwire
