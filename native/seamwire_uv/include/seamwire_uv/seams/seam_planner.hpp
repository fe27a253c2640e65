// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "seamwire/context/surface_context.hpp"
#include "seamwire/metric/metric.hpp"
#include "seamwire/surface/surface.hpp"
#include "seamwire/task.hpp"
#include "seamwire/wires/wire.hpp"
#include "seamwire_uv/api.hpp"
#include "seamwire_uv/maps/measure_map.hpp"

namespace seamwire {

/// Options of a SeamPlanner.
struct SeamPlannerOptions {
  Along along = Along::kSurface;  ///< where wires run
  /// Strength of the two feature metrics that wires across the surface minimize.
  Strength strength = {.max_anisotropy = 20.0, .clamp_percentile = 99.0};
  /// The direction from the surface towards a viewer, in the caller's coordinates: finite, not zero. Seams hide from
  /// there. nullopt: seams hide from ambient light only.
  std::optional<Vector> front = std::nullopt;
  /// The axis, 0 (x) to 2 (z), in whose direction the surface is mirrored. The mirror plane passes through the origin,
  /// or else through the middle of the surface's box. A surface that is not symmetric is planned as with -1. -1: seams
  /// need not be symmetric.
  int mirror = -1;
  /// The cost of a seam at each vertex, as a factor of 0 or more. Infinity keeps seams away. Empty: 1 everywhere.
  std::vector<double> weights = {};
  /// Existing seams, as vertex pairs. They stay. Pairs that are not edges of two triangles cut nothing.
  std::vector<Edge> seams = {};
};

/// What seams have to achieve.
struct SeamGoal {
  /// The bound on SeamPlan::energy; above 4, the energy of an isometry. Each piece is planned within this bound. If
  /// pieces without new seams distort less, the others may distort more. Infinity: islands only have to be discs.
  double distortion = 4.2;
  /// Smallest number of islands. Limbs are separated first, then large islands are cut into halves. There are fewer
  /// islands only if no seam may run inside any of them.
  std::size_t islands = 0;
  /// The number of Newton steps after which the search in a piece ends. It finishes what it has begun, so the first map
  /// and the first trials may take many times a small number. A piece that misses the bound is searched again, with as
  /// many steps. 0: 4000, or 0.04 for each triangle of a surface of 9,000 to 100,000.
  std::size_t steps = 0;
};

/// One wire of a plan.
struct PlannedWire {
  std::int32_t from = -1;              ///< a seed: a vertex
  std::int32_t to = -1;                ///< another seed
  Follow follow = Follow::kMin;        ///< the metric in which a wire across the surface is short
  std::vector<std::int32_t> vertices;  ///< the chain of edges that it marks, from `from` to `to`
  std::vector<Vector> points;          ///< its curve, in the caller's coordinates
  /// The caller's face of each segment of the curve, -1 along an edge without a face. Empty along edges.
  std::vector<std::int32_t> faces;
};

/// Seams that cut a surface into islands.
///
/// In the plan that SeamPlanner::plan() returns, the cuts run along `vertices` of all wires and along the given seams.
/// `islands`, `uvs`, `energy` and `is_reached` belong to these cuts.
///
/// A plan that is only shown has the energy of the slits that the search works on. Its wires may be some distance away
/// from these slits.
struct SeamPlan {
  std::vector<PlannedWire> wires;     ///< without the existing seams
  std::vector<std::int32_t> islands;  ///< the island of each of the caller's triangles, numbered as in face_segments()
  std::size_t island_count = 0;       ///< number of islands
  std::size_t islands_to_cut = 0;     ///< number of islands that need more cuts, see missing_cuts()
  /// Number of wires through exposed places, such as the eyes, nose and lips of a head. There are some only if an
  /// island needs them to lie flat within the bound, or if the bound is below 4.15.
  std::size_t exposed_wires = 0;
  /// The price of the slits that the search worked on, for a surface of area 1. Lower is better. Each slit costs the
  /// prices of its edges, plus a fixed amount unless the island needs it to lie flat. Wires across the surface may
  /// run beside their slits, and are not priced again.
  double cost = 0.0;
  /// The symmetric Dirichlet energy E_d of the planned map, as in MapReport::energy; infinite if an island has no map.
  /// Pieces in which no seam may run do not count. If there are such pieces, the map is not scaled before it is
  /// measured. 4 if no piece counts.
  double energy = 0.0;
  /// Whether the energy is within the bound, and no island that counts overlaps itself.
  bool is_reached = false;
  /// Newton steps that planning took, each times its fraction of the surface.
  double steps = 0.0;
  /// The planned map: UVs of the caller's corners, in the caller's unit of length. Triangles that the surface left out
  /// get theirs as in flatten(). Empty for a plan that is shown during the search.
  CornerUvs uvs;
};

/// Plans seams like an artist's: few, short, and hidden.
///
/// A seam is a crack that costs its length times its visibility, and pays by lowering the distortion of the map. The
/// planner starts with a tree of slits to the tips of limbs. Holes in nearly flat places stay, unless that distorts.
/// Then it adds slits where the map is distorted. It shortens and exchanges them while the distortion stays within a
/// bound.
///
/// Slits follow sharp edges, creases and thin rims that are near. On a symmetric surface, most slits run along the
/// mirror plane or come in mirrored pairs. A slit stays alone if its image would part an island. So does a slit
/// to a place on the plane to which no edges in the plane lead. Large surfaces are planned on a simplified mesh.
///
/// Existing seams divide the surface into pieces. Each piece is planned by itself, and together with its mirror image
/// if it has one. Congruent pieces that are equally visible are planned once.
///
/// Copies share the surface and everything computed from it. Several threads may call the methods at once.
class SEAMWIRE_UV_API SeamPlanner {
 public:
  /// Measure a surface, on several threads.
  ///
  /// \param context the surface
  /// \param options how seams are planned
  /// \throws InvalidInput if an option is out of range, or check_strength() rejects the strength
  /// \throws InvalidInput if the surface has no area
  explicit SeamPlanner(const SurfaceContext& context, const SeamPlannerOptions& options = {}, const Task& = {});

  /// Plan seams.
  ///
  /// \param goal what the seams have to achieve
  /// \param found called on this thread with each better plan. The first one has the trees of all pieces. May be empty.
  /// \returns the best plan
  /// \throws InvalidInput if the distortion is not above 4
  SeamPlan plan(const SeamGoal& goal = {}, const std::function<void(const SeamPlan&)>& found = {},
                const Task& = {}) const;

 private:
  struct Impl;
  std::shared_ptr<const Impl> impl_;
};

}  // namespace seamwire
