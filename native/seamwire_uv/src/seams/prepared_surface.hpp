// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "prices/plan_mesh.hpp"
#include "seams/group_planning.hpp"
#include "seams/planned_wires.hpp"
#include "seamwire/task.hpp"
#include "seamwire_uv/seams/seam_planner.hpp"
#include "slits/slit_plan.hpp"

namespace seamwire::detail {

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

  /// Seams between the part and other faces become its boundary. Throws Cancelled.
  MeshPart part(std::span<const std::int32_t> faces, const Task& task);

 private:
  const PlanMesh& whole_;
  std::span<const std::uint8_t> is_seam_;
  std::span<const Edge> real_edges_;
  std::vector<std::int32_t> vertex_, face_;  // own numbers in the present part; -1 elsewhere
};

/// The groups into which a mesh is parted, by their first faces. `reflection`: of the whole mesh, or null. Throws
/// Cancelled.
std::vector<PieceGroup> find_groups(const PlanMesh& whole, std::span<const std::uint8_t> is_seam,
                                    const Reflection* reflection, MeshParts& parts, const Task& task);

/// Whether a plan of one problem is a plan of another: the same triangles, lengths, prices, seams and mirror images, up
/// to rounding. The shapes may lie apart.
bool are_alike(const SlitProblem& one, const SlitProblem& other);

/// A number that problems which are alike share.
std::uint64_t likeness(const SlitProblem& problem);

/// A surface prepared for planning: groups of pieces, each with its meshes and their prices.
struct PreparedSurface {
  /// Throws InvalidInput for a strength; Cancelled.
  PreparedSurface(const SurfaceContext& context, SeamPlannerOptions with, const Task& task);

  std::shared_ptr<const Surface> surface;
  SeamPlannerOptions options;
  std::shared_ptr<const PlanMesh> mesh;  ///< of the whole surface
  std::vector<GroupProblem> groups;
  std::unique_ptr<const PlannedWires> wires;

 private:
  void find_meshes(const Task& task);
  void add_simplified(GroupProblem& group, std::size_t triangles, const Task& task) const;
  Visibility visibility_of_all(const Task& task) const;
  void find_prices_of_all(const Visibility& visibility, const Task& task);
  void join_copies(const Task& task);
  std::vector<double> weights_at(std::span<const std::int32_t> vertices) const;
};

}  // namespace seamwire::detail
