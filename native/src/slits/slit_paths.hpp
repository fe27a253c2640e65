// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "detail/indexed_heap.hpp"
#include "detail/poll.hpp"
#include "prices/edge_prices.hpp"
#include "prices/plan_mesh.hpp"
#include "slits/slit_plan.hpp"

namespace seamwire::detail {

/// Where paths may go on a symmetric mesh.
enum class Half : std::int8_t {
  kNegative = -1,  ///< along the mirror plane, then off it to the negative side, and not back
  kPlane = 0,      ///< along the mirror plane alone
  kPositive = 1,   ///< along the mirror plane, then off it to the positive side
  kAny = 2,        ///< anywhere
};

/// Cheapest paths over edges that also pay for their turns.
class TurningPaths {
 public:
  explicit TurningPaths(const PlanMesh& mesh)
      : mesh_(mesh),
        before_(2 * mesh.edge_count(), -1),
        arrival_(mesh.vertex_count(), -1),
        price_(mesh.vertex_count(), kInfinity) {}

  /// Finds the paths from all vertices that are marked 1 in `from`, to a vertex, or with -1 to all. `edge_price(e, a,
  /// b)`: what edge e costs from vertex a to b, or kInfinity. `turning`: what a turn by 90 degrees costs. Throws
  /// Cancelled.
  template <class EdgePrice>
  void find(std::span<const std::uint8_t> from, const EdgePrice& edge_price, double turning, std::int32_t until,
            const Task& task);

  /// The price of the path to a vertex: 0 at a start, infinite if no path leads there.
  double price(std::int32_t vertex) const { return price_[vertex]; }
  /// The vertices of the path to a vertex; empty if no path leads there.
  std::vector<std::int32_t> path(std::int32_t vertex) const;

 private:
  std::int32_t tail(std::int32_t d) const {
    const std::int32_t h = mesh_.half_edge_of[d / 2];
    return d % 2 == 0 ? mesh_.tail(h) : mesh_.tip(h);
  }

  const PlanMesh& mesh_;
  // A path arrives at a vertex by a directed edge: 2 e from the start of the edge's half-edge to its end, 2 e + 1 back.
  std::vector<std::int32_t> before_;   // of each directed edge: the one before it, -1 if it leaves a start
  std::vector<std::int32_t> arrival_;  // of each vertex: the directed edge by which the cheapest path arrives
  std::vector<double> price_;
};

template <class EdgePrice>
void TurningPaths::find(std::span<const std::uint8_t> from, const EdgePrice& edge_price, double turning,
                        std::int32_t until, const Task& task) {
  Poll poll(task);
  IndexedHeap open(before_.size());
  std::vector<double> least(before_.size(), kInfinity);
  const auto relax = [&](std::int32_t v, std::int32_t arrived_by, double price) {
    Vector direction = Vector::Zero();
    if (arrived_by >= 0) direction = (mesh_.points[v] - mesh_.points[tail(arrived_by)]).normalized();
    for (const PlanNeighbor& next : mesh_.neighbors[v]) {
      double total = price + edge_price(next.edge, v, next.vertex);
      if (total == kInfinity) continue;
      if (arrived_by >= 0) {
        const Vector ahead = (mesh_.points[next.vertex] - mesh_.points[v]).normalized();
        total += turning * (1.0 - direction.dot(ahead));
      }
      const std::int32_t d = 2 * next.edge + (mesh_.tail(mesh_.half_edge_of[next.edge]) == v ? 0 : 1);
      if (!(total < least[d])) continue;
      least[d] = total;
      before_[d] = arrived_by;
      open.lower(d, total);
    }
  };
  for (std::size_t v = 0; v < from.size(); ++v) {
    if (from[v] == 0) continue;
    price_[v] = 0.0;
    relax(static_cast<std::int32_t>(v), -1, 0.0);
  }
  while (!open.empty()) {
    poll.next();
    const std::int32_t d = open.pop();
    const std::int32_t v = tail(d ^ 1);
    if (arrival_[v] < 0 && price_[v] > 0.0) {
      arrival_[v] = d;
      price_[v] = least[d];
    }
    if (v == until) return;
    relax(v, d, least[d]);
  }
}

/// Which paths slit_paths() finds.
struct PathRules {
  Half half = Half::kAny;
  /// Exponent of the price for a unit of length: 1 for the cheapest path, 0 for the shortest.
  double exponent = 1.0;
  std::span<const std::uint8_t> barred_edges = {};  ///< of each edge: 1 where no path may run; empty: no edge is barred
};

/// The cheapest paths over edges from a cut to every vertex of a mesh. A path pays for its edges and its turns.
///
/// An edge along the mirror plane costs half, because an edge elsewhere is cut a second time at its mirror image. A
/// mesh whose edges are not mirrored has no edges on the plane. There, paths along the plane pay for their distance
/// from it.
///
/// `from`: 1 at the vertices of the cut. `ends`: 1 where paths may end but not go on. `reflection`: null if the mesh is
/// not symmetric; then `rules.half` is kAny. Throws Cancelled.
TurningPaths slit_paths(const PlanMesh& mesh, const EdgePrices& prices, const Reflection* reflection,
                        std::span<const std::uint8_t> from, std::span<const std::uint8_t> ends, const PathRules& rules,
                        const Task& task);

/// The cheapest chain of edges from one vertex to another along a line of points: at `spread` from the line an edge
/// costs twice its price, farther away still more. Except at its ends the chain avoids `barred` vertices. Empty if no
/// chain exists. Throws Cancelled.
std::vector<std::int32_t> chain_along(const PlanMesh& mesh, std::span<const Vector> line, double spread,
                                      std::int32_t from, std::int32_t to, std::span<const std::uint8_t> barred,
                                      const EdgePrices& prices, const Task& task);

/// Edge distances from the nearest of some vertices over all triangles' edges, polygons' diagonals included; infinite
/// if unreachable. Throws Cancelled.
std::vector<double> edge_distances(const PlanMesh& mesh, std::span<const std::int32_t> from, const Task& task);

/// Finds slits that lead from a cut to places on the mesh, in mirrored pairs on a symmetric mesh. Throws Cancelled.
class SlitFinder {
 public:
  /// `from`: 1 at the vertices from which slits may start. `is_on_cut`: the same for mirror images. `exponent`: as
  /// PathRules. `barred_edges`: the same, for slits but not for their images.
  SlitFinder(const SlitProblem& problem, std::span<const std::uint8_t> from, std::span<const std::uint8_t> is_on_cut,
             Task task, double exponent = 1.0, std::vector<std::uint8_t> barred_edges = {});

  /// The price of the slit to a vertex, without its mirror image; infinite if no edges lead there.
  double price_to(std::int32_t vertex) const;
  /// The slit to a vertex; nullopt if no edges lead there from the cut, or it lies on the cut.
  std::optional<Slit> slit_to(std::int32_t vertex) const;

 private:
  const TurningPaths& paths_to(std::int32_t vertex) const;
  const TurningPaths& paths_in(Half half) const;

  const SlitProblem& problem_;
  std::vector<std::uint8_t> from_, is_on_cut_;
  Task task_;
  double exponent_;
  std::vector<std::uint8_t> barred_edges_;
  mutable std::array<std::optional<TurningPaths>, 4> paths_;  // by half, found when first asked for
};

/// The mirror image of the part of a path that leaves the mirror plane; empty if it has none. `is_on_cut`: where it may
/// start. Throws Cancelled.
std::vector<std::int32_t> mirrored_path(const SlitProblem& problem, std::span<const std::int32_t> path,
                                        std::span<const std::uint8_t> is_on_cut, const Task& task);

}  // namespace seamwire::detail
