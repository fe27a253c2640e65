// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "seamwire/surface/types.hpp"
#include "seamwire/surface/vector.hpp"
#include "seamwire_uv/api.hpp"

namespace seamwire {

/// How much a UV map stretches polygons, per triangle. Octaves are powers of two, at most 5.
///
/// Let s1 >= s2 be the singular values of the map from a triangle to its UVs. Polygons without area have zero.
struct MapStretch {
  std::vector<double> angle;  ///< log2(s1 / s2)
  /// log2(s1 s2), where the mean of all is zero: positive where the map enlarges.
  std::vector<double> area;
};

/// Measure how much a UV map stretches polygons.
///
/// \param points vertices
/// \param triangles vertex numbers
/// \param polygons the polygon of each triangle, ascending
/// \param uvs the UVs of each triangle's corners
/// \returns the stretch
/// \throws InvalidInput if an array has the wrong size, or a vertex is out of range
/// \see Sander, Snyder, Gortler, Hoppe, Texture mapping progressive meshes, 2001
/// \see Hormann, Greiner, MIPS: An efficient global parametrization method, 2000
SEAMWIRE_UV_API MapStretch map_stretch(std::span<const Vector> points, std::span<const Triangle> triangles,
                                       std::span<const std::int32_t> polygons,
                                       std::span<const std::array<Eigen::Vector2d, 3>> uvs);

}  // namespace seamwire
