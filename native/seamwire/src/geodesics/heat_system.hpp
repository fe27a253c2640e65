// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "numeric/scalar_cholesky.hpp"
#include "seamwire/surface/intrinsic_mesh.hpp"
#include "seamwire/task.hpp"

namespace seamwire::detail {

/// Where heat begins: the corners of a triangle with barycentric coordinates, and their distances from the source. For
/// a vertex, the first coordinate is 1, and the other corners are -1.
struct HeatSource {
  std::array<std::int32_t, 3> vertices{-1, -1, -1};
  std::array<double, 3> weights{}, distances{};
};

/// The linear systems of the heat method on a mesh.
///
/// Vertices that a loose edge without length joins share an unknown. Each other loose edge conducts heat too, as a
/// strip of the width of the mean edge.
class HeatSystem {
 public:
  /// The mesh must be valid. Throws InvalidInput if it has too many triangles; Cancelled.
  HeatSystem(const IntrinsicMesh& mesh, const Task& task);

  /// The distance of each vertex from the nearest source, infinite on parts of the mesh without one. Throws Cancelled.
  std::vector<double> distances(std::span<const HeatSource> sources, const Task& task) const;

 private:
  /// A triangle in the plane: corners at (0, 0), (base, 0) and (x, y). Lengths are in mean edges.
  struct Face {
    std::array<std::int32_t, 3> unknowns;
    double base, x, y;
  };
  struct Strip {
    std::int32_t a, b;
    double length;
  };

  void number_unknowns(const IntrinsicMesh& mesh, double mean);
  void find_components();
  double diffusion_time(const Task& task) const;
  void fill(double time, const Task& task);
  std::vector<double> divergence(const std::vector<double>& heat, const Task& task) const;

  std::vector<std::int32_t> unknown_of_;    // by vertex
  std::vector<std::int32_t> component_of_;  // by unknown
  std::vector<std::int32_t> pinned_;        // by component: the unknown whose potential is 0
  std::vector<Face> faces_;
  std::vector<Strip> strips_;
  std::optional<ScalarCholesky> heat_, poisson_;
  std::size_t unknown_count_ = 0;
  double unit_ = 1.0;  // the mean edge
};

}  // namespace seamwire::detail
