// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "seamwire/api.hpp"
#include "seamwire/context/along.hpp"
#include "seamwire/context/surface_context.hpp"
#include "seamwire/flatten/measure_map.hpp"
#include "seamwire/metric/metric.hpp"
#include "seamwire/surface/surface.hpp"
#include "seamwire/task.hpp"

namespace seamwire {

/// Options of a SeamPlanner.
struct SeamPlannerOptions {
  Along along = Along::kSurface;  ///< where wires run
  /// Strength of the two feature metrics that wires across the surface minimize.
  Strength strength = {.max_anisotropy = 20.0, .clamp_percentile = 99.0};
  /// The direction from the surface towards a viewer, in the caller's coordinates. Seams hide from there. nullopt: they
  /// hide from ambient light only.
  std::optional<Vector> front = std::nullopt;
  /// The axis, 0 to 2, along which a plane mirrors the surface: the plane through the origin, or else the one through
  /// the middle of the surface's box. -1 if seams need not be symmetric. A surface that is not symmetric is planned as
  /// with -1.
  int mirror = -1;
  /// The cost of a seam at each vertex, as a factor; infinity keeps seams away. Empty: 1 everywhere.
  std::vector<double> weights = {};
  /// Existing seams, which stay, as vertex pairs. Pairs that are not edges of two triangles cut nothing.
  std::vector<Edge> seams = {};
};

/// What seams have to achieve.
struct SeamGoal {
  /// The bound on the symmetric Dirichlet energy E_d of the surface's map, mean over the area: 4 for an isometry. Each
  /// piece is planned within this bound. If pieces without new seams distort less, the others may distort more.
  /// Infinity: islands only have to be discs.
  double distortion = 4.2;
  /// Minimum number of islands. Limbs are parted first, then large islands are cut into halves. There are fewer islands
  /// only if no seam may run inside of any.
  std::size_t islands = 0;
  /// How many Newton steps the search in each piece may take; 0: 4000.
  std::size_t steps = 0;
};

/// One wire of a plan.
struct PlannedWire {
  std::int32_t from = -1;              ///< a seed: a vertex
  std::int32_t to = -1;                ///< another seed
  Follow follow = Follow::kMin;        ///< the metric in which a wire across the surface is short
  std::vector<std::int32_t> vertices;  ///< the chain of edges that it marks, from `from` to `to`
  std::vector<Vector> points;          ///< its curve, in the caller's coordinates
  /// The caller's face in which each segment of the curve lies, -1 along an edge without one. Empty along edges.
  std::vector<std::int32_t> faces;
};

/// Seams that cut a surface into islands.
///
/// In the plan that SeamPlanner::plan() returns, `islands`, `uvs`, `energy` and `is_reached` belong to the cuts along
/// `vertices` of all wires and along the given seams. A plan that is only shown has the energy of the slits that the
/// search works on, from which its wires may be some way off.
struct SeamPlan {
  std::vector<PlannedWire> wires;     ///< without the seams that were there
  std::vector<std::int32_t> islands;  ///< of each of the caller's triangles, as face_segments() numbers them
  std::size_t island_count = 0;       ///< how many islands there are
  std::size_t not_discs = 0;          ///< how many islands are not discs, see missing_cuts()
  double cost = 0.0;  ///< length times visibility of all wires, for a surface of area 1; lower is better
  /// E_d of the planned map, mean over the area; infinite if some island has no map. Pieces in which no seam may run do
  /// not count.
  double energy = 0.0;
  bool is_reached = false;  ///< whether the energy is within the bound, and no island that counts overlaps itself
  double steps = 0.0;       ///< Newton steps that planning took, each times the share of the surface
  /// The planned map: UVs of the caller's corners, in the caller's unit of length. Empty for a plan that is only shown
  /// while a better one is being looked for.
  CornerUvs uvs;
};

/// Plans seams like an artist's: few, short, and hidden.
///
/// A seam is a crack that costs its length times how visible it is, and pays by lowering the distortion of the map. The
/// planner starts with a tree of slits to the tips of limbs. Then it adds slits where the map is distorted, shortens
/// and exchanges them while the distortion stays within a bound. Where sharp edges, creases and thin rims are near,
/// slits run along them. On a symmetric surface they come in mirrored pairs. Large surfaces are planned on a simplified
/// mesh.
///
/// Each piece of the surface, as the given seams part it, is planned by itself, and together with its mirror image if
/// it has one. Congruent pieces that are equally visible are planned once.
///
/// Copies share the surface and what is known of it. The methods may be called from several threads.
class SEAMWIRE_API SeamPlanner {
 public:
  /// Measures the surface, on several threads. Throws InvalidInput for options that are not as described; Cancelled.
  explicit SeamPlanner(const SurfaceContext& context, const SeamPlannerOptions& options = {}, const Task& task = {});
  /// Measures a surface in its own context.
  explicit SeamPlanner(std::shared_ptr<const Surface> surface, const SeamPlannerOptions& options = {},
                       const Task& task = {});

  /// Plans seams. `found` is called on this thread with each better plan; the first one has the trees of all pieces.
  /// Throws InvalidInput for a distortion that is not above 4; Cancelled, within some tenths of a second on large
  /// surfaces.
  SeamPlan plan(const SeamGoal& goal = {}, const std::function<void(const SeamPlan&)>& found = {},
                const Task& task = {}) const;

 private:
  friend class Planning;
  struct Impl;
  std::shared_ptr<const Impl> impl_;
};

}  // namespace seamwire
