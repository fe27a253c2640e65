// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <iterator>
#include <optional>
#include <span>
#include <vector>

#include "detail/poll.hpp"
#include "detail/rounded.hpp"
#include "graph/indexed_heap.hpp"
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
///
/// At vertices with many edges only the first paths to arrive go on over every edge, so that the work stays in
/// proportion to the number of edges. Each later path could only save a part of a turn.
class TurningPaths {
 public:
  explicit TurningPaths(const PlanMesh& mesh)
      : mesh_(mesh),
        open_(2 * mesh.edge_count()),
        least_(2 * mesh.edge_count(), kInfinity),
        before_(2 * mesh.edge_count(), -1),
        arrival_(mesh.vertex_count(), -1),
        arrived_(mesh.vertex_count(), 0),
        price_(mesh.vertex_count(), kInfinity) {}

  /// Finds the paths from some vertices, to a vertex, or with -1 to all. `edge_price(e, a, b)`: what edge e costs from
  /// vertex a to b, or kInfinity. `turning`: what a turn by 90 degrees costs. After a call with -1 it can be called
  /// again with the same prices, for paths from more vertices. Returns the vertices to which paths have become cheaper.
  /// Throws Cancelled.
  template <class EdgePrice>
  std::vector<std::int32_t> add(std::span<const std::int32_t> from, const EdgePrice& edge_price, double turning,
                                std::int32_t until, const Task& task);

  /// The price of the path to a vertex: 0 at a start, infinite if no path leads there.
  double price(std::int32_t vertex) const { return price_[vertex]; }
  /// The vertices of the path to a vertex; empty if no path leads there.
  std::vector<std::int32_t> path(std::int32_t vertex) const;

 private:
  std::int32_t tail(std::int32_t d) const {
    const std::int32_t h = mesh_.half_edge_of[d / 2];
    return d % 2 == 0 ? mesh_.tail(h) : mesh_.tip(h);
  }

  static constexpr std::int32_t kMostArrivals = 32;  // at a vertex, that go on over all its edges

  const PlanMesh& mesh_;
  IndexedHeap open_;
  std::vector<double> least_;  // of each directed edge: the price of the cheapest path that ends with it
  // A path arrives at a vertex by a directed edge: 2 e from the start of the edge's half-edge to its end, 2 e + 1 back.
  std::vector<std::int32_t> before_;   // of each directed edge: the one before it, -1 if it leaves a start
  std::vector<std::int32_t> arrival_;  // of each vertex: the directed edge by which the cheapest path arrives
  // Of each vertex with many edges: the paths that have come since the cheapest one.
  std::vector<std::int32_t> arrived_;
  std::vector<double> price_;
};

template <class EdgePrice>
std::vector<std::int32_t> TurningPaths::add(std::span<const std::int32_t> from, const EdgePrice& edge_price,
                                            double turning, std::int32_t until, const Task& task) {
  Poll poll(task);
  std::vector<std::int32_t> cheaper;
  const auto relax = [&](std::int32_t v, std::int32_t arrived_by, double price) {
    Vector direction = Vector::Zero();
    if (arrived_by >= 0) direction = (mesh_.points[v] - mesh_.points[tail(arrived_by)]).normalized();
    for (const PlanNeighbor& next : mesh_.neighbors[v]) {
      double total = price + edge_price(next.edge, v, next.vertex);
      if (total == kInfinity) continue;
      if (arrived_by >= 0) {
        const Vector ahead = (mesh_.points[next.vertex] - mesh_.points[v]).normalized();
        total += turning * rounded_share(1.0 - direction.dot(ahead));
      }
      const std::int32_t d = 2 * next.edge + (mesh_.tail(mesh_.half_edge_of[next.edge]) == v ? 0 : 1);
      // A path that starts here replaces one that only passes, at the same price too.
      if (!(total < least_[d] || (arrived_by < 0 && total == least_[d]))) continue;
      least_[d] = total;
      before_[d] = arrived_by;
      open_.lower(d, total);
    }
  };
  for (const std::int32_t v : from) {
    poll.next();
    if (price_[v] > 0.0) cheaper.push_back(v);
    price_[v] = 0.0;
    arrival_[v] = -1;
    relax(v, -1, 0.0);
  }
  while (!open_.empty()) {
    poll.next();
    const std::int32_t d = open_.pop();
    const std::int32_t v = tail(d ^ 1);
    if (least_[d] < price_[v]) {
      arrival_[v] = d;
      price_[v] = least_[d];
      arrived_[v] = 0;
      cheaper.push_back(v);
    }
    if (v == until) break;
    // No turn costs more than two by 90 degrees, so the cheapest path to the vertex goes on at least as cheaply.
    if (least_[d] > price_[v] + 2.0 * turning) continue;
    if (std::ssize(mesh_.neighbors[v]) > kMostArrivals && arrived_[v]++ >= kMostArrivals) continue;
    relax(v, d, least_[d]);
  }
  return cheaper;
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

/// Lets the paths start from more vertices, which are marked in `from` too. Returns the vertices to which paths have
/// become cheaper. Throws Cancelled.
std::vector<std::int32_t> add_slit_paths(TurningPaths& paths, const PlanMesh& mesh, const EdgePrices& prices,
                                         const Reflection* reflection, std::span<const std::int32_t> vertices,
                                         std::span<const std::uint8_t> from, std::span<const std::uint8_t> ends,
                                         const PathRules& rules, const Task& task);

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
  /// `from`: 1 at the vertices from which slits may start. `is_on_cut`: the same for mirror images. It must outlive
  /// this object, and may change. `exponent`: as PathRules. `barred_edges`: the same, for slits but not for their
  /// images.
  SlitFinder(const SlitProblem& problem, std::span<const std::uint8_t> from, std::span<const std::uint8_t> is_on_cut,
             Task task, double exponent = 1.0, std::vector<std::uint8_t> barred_edges = {});

  /// The price of the slit to a vertex, without its mirror image; infinite if no edges lead there.
  double price_to(std::int32_t vertex) const;
  /// The slit to a vertex; nullopt if no edges lead there from the cut, or it lies on the cut.
  std::optional<Slit> slit_to(std::int32_t vertex) const;
  /// Lets slits start from more vertices. Returns the vertices to which slits may have become cheaper. All searches
  /// together cost about as much as one, because each only looks at places that are nearer to the new vertices.
  std::vector<std::int32_t> start_from(std::span<const std::int32_t> vertices);

 private:
  const TurningPaths& paths_to(std::int32_t vertex) const;
  const TurningPaths& paths_in(Half half) const;
  std::vector<std::int32_t> add(TurningPaths& paths, Half half, std::span<const std::int32_t> vertices) const;

  const SlitProblem& problem_;
  std::vector<std::uint8_t> from_;
  std::span<const std::uint8_t> is_on_cut_;
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
