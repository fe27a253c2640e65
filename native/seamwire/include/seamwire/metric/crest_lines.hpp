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
  /// Least integral of |k1| along a line, in radians, 0 or more. It does not depend on the size of the model.
  double least_strength = 1.0;
  /// Least fraction by which curvature falls across a line, in [0, 1). It compares the curvature on the line with the
  /// mean one radius of curvature away, on both sides. This rejects lines that noise draws on a sphere, cylinder or
  /// torus, where curvature does not fall.
  double least_drop = 0.15;
};

/// Ridges and valleys: curves along which the surface bends most sharply across.
struct CrestLines {
  /// All lines one after another, in the caller's coordinates. Each point is on an edge. A closed line ends with its
  /// first point.
  std::vector<Vector> points;
  std::vector<Edge> edges;  ///< per point: its edge, in the caller's vertices
  std::vector<double> t;    ///< per point: its place on the edge, 0 at the first vertex, 1 at the second
  /// Per point: k1, in the unit of Curvature. Above 0 on ridges and below 0 on valleys, except where a gap is bridged.
  std::vector<double> curvatures;
  /// Line i has the points starts[i] to starts[i + 1] - 1. There is one more start than lines.
  std::vector<std::int32_t> starts;
  std::vector<double> strengths;    ///< per line: the integral of |k1| along it; descending
  std::vector<std::int32_t> faces;  ///< per point: the caller's face to the next point; -1 for the last point of a line
};

/// Find crest lines, where the larger curvature k1 has an extremum along its own direction d1.
///
/// There, e = dk1 / dd1 is 0. The derivative of the curvature tensor in each face gives e, averaged over the faces
/// around a vertex by their areas. Lines follow from the signs of e in each triangle. Ridges have k1 > 0, valleys have
/// k1 < 0. The second threshold of Yoshizawa et al., the distance from a cyclide of Dupin, is replaced by
/// CrestLineOptions::least_drop.
///
/// The method is described in docs/method/curvature.md.
///
/// \param surface the surface
/// \param curvature of principal_curvatures(), preferably smoothed
/// \param options which lines are kept
/// \returns the lines, the strongest first
/// \throws InvalidInput if the curvatures differ from the surface in size, or an option is out of range
/// \see Yoshizawa, Belyaev, Seidel 2005, "Fast and robust detection of crest lines on meshes"
/// \see Rusinkiewicz 2004, Section 4, for the derivative
/// \see Hildebrandt, Polthier, Wardetzky 2005, "Smooth feature lines on surface meshes", for the lines in triangles
SEAMWIRE_API CrestLines crest_lines(const Surface& surface, const Curvature& curvature,
                                    const CrestLineOptions& options = {}, const Task& = {});

}  // namespace seamwire
