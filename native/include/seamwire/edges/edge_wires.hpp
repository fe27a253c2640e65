// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "seamwire/metric/metric.hpp"
#include "seamwire/metric/scribble.hpp"
#include "seamwire/surface/surface.hpp"
#include "seamwire/task.hpp"

namespace seamwire {

/// What was picked: a vertex `a` (b = -1), or the edge between `a` and `b`.
struct Pick {
  std::int32_t a = -1;
  std::int32_t b = -1;

  bool is_edge() const { return b >= 0; }
  friend bool operator==(const Pick&, const Pick&) = default;
};

/// A chain of real edges. It repeats no vertex, except that one from a forward seed may end where it began.
struct EdgeChain {
  std::vector<std::int32_t> vertices;                       ///< in order, picked edges included; empty: there is none
  double length = std::numeric_limits<double>::infinity();  ///< metric lengths plus turning cost
};

/// The real edges around each vertex of a surface, and what it costs to turn from one to another: 1 - cos kappa, where
/// kappa is the discrete geodesic curvature, pi |left - right| / (left + right) of the face angles on either side
/// (Polthier and Schmies, "Straightest Geodesics", 1998). On a boundary it is zero along the boundary, else pi minus
/// the angle between the edges; where the faces at a vertex are no single fan (an edge with three faces, a bow-tie, a
/// loose edge) it is the turn in space. Immutable, so any number of threads may use it.
class EdgeFans;

/// Throws Cancelled.
std::shared_ptr<const EdgeFans> make_edge_fans(const Surface& surface, const Task& task = {});

/// The straightest way on from edge.b, having come from edge.a: at each vertex over the edge that turns least. It ends
/// at a vertex of `stops` (edge.b itself is none), at a boundary (a way along a boundary goes on along it), at a vertex
/// it has been at, edge.a among them, and where nothing turns less than 60 degrees. Begins with edge.b; only its last
/// vertex may be an earlier one. Throws InvalidInput where that is no edge of the surface.
std::vector<std::int32_t> run_on(const EdgeFans& fans, const Edge& edge, std::span<const std::int32_t> stops);

/// A run of edges straight through a mesh.
struct EdgeStrip {
  std::vector<std::int32_t> vertices;  ///< in order; where it is closed, the first one is not given twice
  bool closed = false;
};

/// The strip of edges through an edge, both ways, as modellers select an edge loop: on over the opposite edge at a
/// vertex of four edges whose faces are not all triangles, and of six whose faces all are; from an edge of the boundary
/// along it. It ends at other vertices (poles, boundaries, corners of a single face, where faces are no fan), at a
/// vertex of `stops` (an end of the edge itself too), and where it meets itself: closed where its ends are one vertex,
/// else, where it crosses itself, its first or last vertex is also an inner one. `edge` may be given either way round
/// and has its direction in the strip. Throws InvalidInput where that is no edge of the surface.
EdgeStrip edge_strip(const EdgeFans& fans, const Edge& edge, std::span<const std::int32_t> stops);

/// EdgeFans with the lengths of the edges in a metric: cost of a chain = sum of metric lengths + q * (mean metric edge
/// length) * sum over its inner vertices of (1 - cos kappa). Immutable, so searches may run on several threads.
class EdgeGraph;

/// `fans`: those of the surface, where they are there already. Throws Cancelled.
///
/// `scribbles`: those that `metric` has been through, `follow`: as apply_scribbles() has it. Tensors alone lead no
/// chain along a stroke that runs askew to the edges: each of them is neither along it nor across, and dear. So the
/// edges that stay nearest to a stroke that attracts have their Euclidean length / sqrt(eta), as the line itself has
/// it, and turning from one of them to the next costs nothing. A later stroke that repels takes that from the edges it
/// runs along.
std::shared_ptr<const EdgeGraph> make_edge_graph(const Surface& surface, const Metric& metric,
                                                 std::shared_ptr<const EdgeFans> fans = nullptr, const Task& task = {},
                                                 std::span<const Scribble> scribbles = {},
                                                 std::optional<Follow> follow = std::nullopt);

/// The cheapest chains from one pick to every edge and vertex. While run() is at work on one thread, another may ask
/// for those found so far. Copies share the search.
class EdgeWires {
 public:
  /// `turning`: q, not negative. `forward`: the seed edge has just been drawn from seed.a to seed.b, so the chain
  /// leaves it over b (a directed seed counts its turn there too). Throws InvalidInput where the seed is not a vertex
  /// or an edge of the surface.
  EdgeWires(std::shared_ptr<const EdgeGraph> graph, const Pick& seed, double turning = 3.0, bool forward = false);

  /// Searches, nearest first; once. Throws Cancelled, after which there is no more than what was found.
  void run(const Task& task = {});

  /// Whether trace() gives the cheapest chain already, or tells for sure that there is none. Throws InvalidInput where
  /// the target is not a vertex or an edge of the surface.
  bool is_final(const Pick& target) const;

  /// The cheapest chain to a target, both picks included. A picked edge has no direction: the better of both. The seed
  /// itself is a chain of its own. Behind a forward seed, a target at the seed's first vertex closes the chain there.
  /// Takes time in proportion to the chain. Throws InvalidInput where the target is not a vertex or an edge of the
  /// surface.
  ///
  /// The cheapest walk may cross itself, where it can turn more cheaply in a small circle of short edges than at once.
  /// The chain is then another one, without repeated vertices, though not always the cheapest of those: that is
  /// NP-hard.
  EdgeChain trace(const Pick& target) const;

 private:
  struct Run;  // edge_wire.cpp
  std::shared_ptr<Run> run_;
};

/// Those of a search that has run to its end. Throws as its parts do.
EdgeWires edge_wires(std::shared_ptr<const EdgeGraph> graph, const Pick& seed, double turning = 3.0,
                     bool forward = false, const Task& task = {});

/// The cheapest closed chain through an edge, without repeated vertices (found as edge_wires() finds its chains; the
/// first vertex is not given twice); empty where there is none. Nothing dearer than the way around a face beside the
/// edge is found, some 4 `turning` edges: for larger rings on finer meshes take a larger `turning`.
EdgeChain edge_loop(const EdgeGraph& graph, const Edge& edge, double turning = 20.0, const Task& task = {});

}  // namespace seamwire
