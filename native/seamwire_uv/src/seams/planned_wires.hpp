// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <unordered_set>
#include <vector>

#include "seamwire/context/surface_context.hpp"
#include "seamwire/surface/surface.hpp"
#include "seamwire/task.hpp"
#include "seamwire_uv/seams/seam_planner.hpp"
#include "slits/slit_plan.hpp"

namespace seamwire::detail {

/// Edges on the boundary and along seams.
class Rim {
 public:
  explicit Rim(std::vector<Edge> edges);
  bool has_edge(std::int32_t a, std::int32_t b) const;
  bool has_vertex(std::int32_t v) const { return vertices_.contains(v); }

 private:
  std::vector<Edge> edges_;  // sorted, the smaller vertex first
  std::unordered_set<std::int32_t> vertices_;
};

/// The chain of edges that a wire marks.
struct MarkedChain {
  std::span<const std::int32_t> vertices;
  double away = 0.0;  ///< how far the wire strays from its slit
};

/// A place where a wire touches another one, itself, or the rim, although their slits do not.
struct WireTouch {
  std::size_t wire;     ///< the one that has to stay nearer to its slit
  std::int32_t vertex;  ///< where
};

/// Finds places where wires touch, at most one for each wire. Slits touch only at their ends. Wires may also share some
/// edges from a common end, because that changes no island. Anything else would cut off a crumb, or leave a handle
/// uncut. Throws Cancelled.
std::vector<WireTouch> find_touches(std::span<const MarkedChain> wires, const Rim& rim, const Task& task);

/// Slits as chains between the vertices where slits meet and end.
struct SlitChains {
  using Chain = std::vector<std::int32_t>;  ///< vertices joined by edges

  explicit SlitChains(std::span<const Slit> slits = {});

  std::vector<Chain> chains;
  double size = 1.0;  ///< the root of the share of the surface's area that these slits cut
  /// How near wires across the surface stay to the slits. Wires at kClosest run along the slits' edges.
  int closeness = 0;
  static constexpr int kClosest = 2;
};

class CandidateWires;

/// Makes wires of slits: between seeds where slits meet, end, and bend.
class PlannedWires {
 public:
  /// Prepares the metrics of wires across the surface. `weights`: of each vertex, infinite where no wire may run;
  /// empty: wires may run everywhere. Throws InvalidInput for a strength; Cancelled.
  PlannedWires(const SurfaceContext& context, Along along, const Strength& strength, Rim rim,
               std::vector<double> weights, const Task& task);

  ~PlannedWires();

  bool are_across() const { return across_ != nullptr; }
  /// Along edges, wires are the slits. Across the surface, they are the shortest curves between seeds of the slits,
  /// with as many seeds as it takes to stay near them and away from infinite weights. Where no such curve exists, they
  /// run along the slits' edges. `mesh`: of the whole surface. Throws Cancelled.
  std::vector<PlannedWire> along(const PlanMesh& mesh, std::span<const SlitChains> slits, const Task& task) const;

 private:
  using Chain = SlitChains::Chain;

  PlannedWire along_edges(const PlanMesh& mesh, const Chain& chain) const;
  std::vector<PlannedWire> along_edges(const PlanMesh& mesh, const SlitChains& slits) const;
  bool is_barred(const PlannedWire& wire) const;

  std::shared_ptr<const Surface> surface_;
  Rim rim_;
  std::vector<double> weights_;
  std::unique_ptr<const CandidateWires> across_;  // null along edges
};

}  // namespace seamwire::detail
