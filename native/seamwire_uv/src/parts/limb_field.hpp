// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "seamwire/surface/vector.hpp"
#include "seamwire/task.hpp"

namespace seamwire::detail {

/// A triangle of a connected surface whose area is 1.
struct LimbFace {
  Vector center = Vector::Zero();
  Vector normal = Vector::Zero();
  double area = 0.0;
};

/// Where two triangles meet.
struct LimbLink {
  std::int32_t one = -1, other = -1;
  double length = 0.0;    ///< of the common edge
  double distance = 0.0;  ///< between the centers, over the middle of the edge
};

/// What tells the limbs of a surface apart.
struct LimbField {
  static constexpr int kCoordinates = 16;
  /// Coordinates of each face in which faces are far apart if it is hard to get from one to the other.
  Eigen::Matrix<double, Eigen::Dynamic, kCoordinates, Eigen::RowMajor> places;
  std::vector<double> weights;  ///< of each link: its length, and less where the surface is concave
};

/// The field of a connected surface: eigenvectors of a Laplacian over its faces that resists concave edges. Throws
/// Cancelled.
LimbField limb_field(std::span<const LimbFace> faces, std::span<const LimbLink> links, const Task& task);

}  // namespace seamwire::detail
