// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "prices/plan_mesh.hpp"
#include "prices/reflection.hpp"
#include "seamwire/task.hpp"
#include "slits/slit_plan.hpp"

namespace seamwire::detail {

/// Where a copy of some faces lies on the whole mesh: its vertices and faces, in the order of the faces' own ones.
struct Place {
  std::vector<std::int32_t> vertices, faces;
  bool is_mirrored = false;
};

/// Faces that are planned together: a piece into which seams part the mesh, or a piece and its mirror image if they do
/// not have the same triangles.
struct PieceGroup {
  std::vector<std::int32_t> faces;                      ///< of the whole mesh, ascending
  std::optional<Reflection> reflection = std::nullopt;  ///< of the group's own mesh, if that is symmetric
  std::optional<Place> image = std::nullopt;  ///< the mirror image, triangle by triangle, if it lies elsewhere
};

/// The part of a mesh with some faces, scaled so that it has area 1.
struct MeshPart {
  PlanMesh mesh;
  std::vector<std::int32_t> vertices;  ///< the whole mesh's vertex of each vertex
  std::vector<std::uint8_t> is_seam;   ///< of each edge
  double size = 1.0;                   ///< the root of the part's share of the whole area
};

/// Takes parts out of a mesh, each in time proportional to its size.
class MeshParts {
 public:
  /// `is_seam`: of each edge of the whole mesh. `real_edges`: as connect(). All must outlive this object.
  MeshParts(const PlanMesh& whole, std::span<const std::uint8_t> is_seam, std::span<const Edge> real_edges);

  /// Seams between the part and other faces become its boundary.
  MeshPart part(std::span<const std::int32_t> faces);

 private:
  const PlanMesh& whole_;
  std::span<const std::uint8_t> is_seam_;
  std::span<const Edge> real_edges_;
  std::vector<std::int32_t> vertex_, face_;  // own numbers in the present part; -1 elsewhere
};

/// The groups into which a mesh is parted, by their first faces. `reflection`: of the whole mesh, or null.
std::vector<PieceGroup> find_groups(const PlanMesh& whole, std::span<const std::uint8_t> is_seam,
                                    const Reflection* reflection, MeshParts& parts, const Task& task);

/// Whether a plan of one problem is a plan of another: the same triangles, lengths, prices, seams and mirror images, up
/// to rounding. The shapes may lie apart.
bool are_alike(const SlitProblem& one, const SlitProblem& other);

/// A number that problems which are alike share.
std::uint64_t likeness(const SlitProblem& problem);

}  // namespace seamwire::detail
