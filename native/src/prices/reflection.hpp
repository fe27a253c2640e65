// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "prices/plan_mesh.hpp"
#include "seamwire/task.hpp"

namespace seamwire::detail {

/// How a mesh corresponds to its mirror image in a plane.
struct Reflection {
  int axis = 0;         ///< the plane's normal: 0 is x
  double offset = 0.0;  ///< where the plane meets this axis
  /// The vertex nearest to each vertex' mirror image; -1 if the image is farther than 1.2 % of the mesh's diagonal from
  /// the surface there.
  std::vector<std::int32_t> images;
  /// On which side of the plane each vertex lies: -1, 1, or 0 for a vertex that is its own image.
  std::vector<std::int8_t> sides;
  /// Whether nearly all edges are the mirror images of edges. The shape may deviate a little.
  bool is_exact = false;

  Vector mirrored(const Vector& point) const {
    Vector image = point;
    image[axis] = 2.0 * offset - image[axis];
    return image;
  }
};

/// The reflection in the plane through the origin whose normal is an axis, or in the one through the middle of the
/// mesh; nullopt if the mesh has no such symmetry. Throws Cancelled.
std::optional<Reflection> find_reflection(const PlanMesh& mesh, int axis, const Task& task = {});

/// The reflection in a plane that is known; nullopt if the mesh is not symmetric there. `diagonal`: of the shape whose
/// size decides what counts as near. Throws Cancelled.
std::optional<Reflection> reflection_in(const PlanMesh& mesh, int axis, double offset, double diagonal,
                                        const Task& task = {});

/// The mirror image of an edge; -1 without an image.
std::int32_t image_of_edge(const PlanMesh& mesh, const Reflection& reflection, std::int32_t edge);

/// The diagonal of the box around a mesh; 0 without vertices.
double diagonal_of(const PlanMesh& mesh);

}  // namespace seamwire::detail
