// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "seamwire/api.hpp"
#include "seamwire/context/surface_context.hpp"
#include "seamwire/edges/edge_loop.hpp"
#include "seamwire/edges/edge_wires.hpp"
#include "seamwire/edges/fit_chain.hpp"
#include "seamwire/metric/metric_spec.hpp"
#include "seamwire/metric/scribble.hpp"
#include "seamwire/surface/surface.hpp"
#include "seamwire/surface/surface_point.hpp"
#include "seamwire/wires/closed_wires.hpp"

namespace seamwire {

/// The metrics of live wires.
struct LiveMetrics {
  /// One or more metrics. One wire is computed in each. The shortest of the wires in the first metric and in its
  /// counterparts (is_counterpart()) is offered first.
  std::vector<MetricSpec> wires;
  /// One or more indices into `wires`: the metrics whose closed cuts are offered, in this order.
  std::vector<std::size_t> cuts = {0};

  /// Compare member by member.
  friend bool operator==(const LiveMetrics&, const LiveMetrics&) = default;
};

/// Choose the metrics of a family for live wires.
///
/// - kFeature: M_min and M_max. Across the surface, the concave metric comes first.
/// - kCampen, kPottmannKovacs: M_min and M_max.
/// - kConcave: the concave metric, then the Euclidean metric. Closed cuts of the latter help where nothing is concave.
/// - kEuclidean: the Euclidean metric. The strength has no effect.
///
/// \param family the family
/// \param strength the strength of the metrics
/// \param along where wires run
/// \returns the metrics
/// \throws InvalidInput if check_strength() rejects the strength
SEAMWIRE_API LiveMetrics live_metrics(MetricFamily family, const Strength& strength, Along along = Along::kSurface);

/// How live wires run.
struct LiveWireOptions {
  Along along = Along::kSurface;  ///< where wires run
  /// The metrics in which wires are short.
  LiveMetrics metrics = live_metrics(MetricFamily::kFeature, {.parameter = 0.1}, along);
  double turning = 3.0;  ///< q of edge_wires(): finite, 0 or more
  /// q of shortest_cycle(): finite, 0 or more. nullopt: 20, or a quarter of the square root of the number of edges if
  /// that is more. With a fixed q, a circle around one quad, which costs 4 q edges, would be cheaper than a long ring
  /// of a dense mesh.
  std::optional<double> loop_turning = std::nullopt;
  /// The mean relative error of a wire's length to aim for, across the surface, in [0, 1]. A wire is final once the
  /// faces around it resolve the metric that well (EmbedOptions::max_error) and it is the shortest there. 0: a wire is
  /// final in the embedding of Section 4.1.
  double max_error = 0.01;
};

/// One of the wires from the seed to a target.
struct LiveCandidate {
  MetricSpec metric;           ///< the metric in which it is short
  std::vector<Vector> points;  ///< in the caller's coordinates; empty if there is no such wire, or not yet
  /// Per segment: the caller's face. Across the surface only.
  std::vector<std::int32_t> faces;
  /// The chain of vertices whose edges would be marked. Along edges it is the wire itself. Across the surface it is the
  /// chain to which the wire snaps. If the wire ends inside a face, the chain ends at the corner with the largest
  /// barycentric coordinate.
  std::vector<std::int32_t> vertices;
  /// In its metric, in the caller's unit.
  double length = std::numeric_limits<double>::infinity();
  /// Whether it is the shortest wire along edges, or in the embedding of the whole surface. True if it is final.
  bool solved = false;
  /// Whether it stays as it is. If not, it is still being computed and will be replaced.
  bool final = false;
};

/// The wires to a target.
struct LiveWires {
  std::vector<LiveCandidate> wires;  ///< one for each metric, in the order of LiveMetrics::wires
  /// Index of the wire to offer first, see LiveMetrics. If no wire that comes first reaches the target, it is the
  /// shortest of all wires.
  int active = 0;
  bool settled = false;  ///< whether `active` stays the active wire
  /// Return whether all wires are final.
  bool final() const { return std::ranges::all_of(wires, &LiveCandidate::final); }
  /// Return whether all wires are solved. A preview that follows the cursor need not wait for more.
  bool solved() const { return std::ranges::all_of(wires, &LiveCandidate::solved); }
};

/// A closed chain of edges, as from shortest_cycle(). Across the surface, LiveClosedWire is its counterpart.
struct LiveLoop {
  /// The chain, which does not repeat its first vertex. Empty if there is no chain, or not yet.
  std::vector<std::int32_t> vertices;
  double length = std::numeric_limits<double>::infinity();  ///< as in EdgeChain
  std::int32_t corners = 0;                                 ///< count_corners() of the chain
  bool final = false;                                       ///< whether the search has finished
};

/// A closed cut through a point of the surface, in pieces of about the same length.
///
/// The pieces follow each other from the point around to it. Each is the shortest wire between its ends, except at the
/// place where the cut's halves meet. A cut that was bent to a second point has four pieces, two from each point to the
/// other. Each of these is the shortest among wires that lead around in the same way.
struct LiveClosedWire {
  /// Three pieces, or four of a bent cut. There are fewer if a piece would begin on an edge without a face.
  std::vector<LiveCandidate> pieces;
  /// Where one piece ends and the next one begins: points inside faces, or the second point.
  std::vector<SurfacePoint> joints;
  bool separates = true;  ///< as in ClosedWire
  /// As in ClosedWire. A bent cut keeps the value of the original cut.
  double turn = 0.0;
  /// In its metric, in the caller's unit.
  double length = std::numeric_limits<double>::infinity();
  /// Identifies the cut for LiveWire::bent_wire(). Its metric is an index into LiveMetrics::cuts. It may change until
  /// the answer is final.
  ClosedCutId id;
};

/// The closed cuts through a point.
struct LiveClosedWires {
  /// Best first. Empty if nothing suggests a cut, or no cut is found yet.
  std::vector<LiveClosedWire> cuts;
  bool final = false;  ///< whether the search has finished
};

/// Describes one metric's embedding, see Embedding. Wires across the surface lead around invalid triangles, as around
/// holes.
struct LiveEmbedding {
  std::size_t invalid_left = 0;   ///< number of invalid triangles
  bool hit_cap = false;           ///< whether the largest number of added triangles ended the subdivision
  std::size_t clamped_edges = 0;  ///< number of edges whose length differs from the metric
  double worst_clamp = 1.0;       ///< the largest factor between these lengths, 1 or more
};

/// Computes wires from a seed to any target in the background, one in each of several metrics of a surface.
///
/// Each metric has its own thread. If there are fewer processors than metrics, the last ones wait until the work on the
/// leading one is done.
///
/// Any number of threads may call the members at once, except while an object is moved or destroyed. Only wait() and
/// wait_for_surface() wait for the computation. Results belong to the newest metrics, strokes and seed.
///
/// While the surface is being built, the members keep what they are given. They answer that nothing is there yet and
/// nothing is final. An edge that is not part of the surface is then rejected at a later call. If the surface cannot be
/// built, each member throws what the constructor of Surface threw.
///
/// \see Zhuang et al. 2014, Section 5
class SEAMWIRE_API LiveWire {
 public:
  /// Start on a surface, and return at once. A surface that is not built yet is built on a background thread.
  ///
  /// \param context the surface, or what SurfaceContext is made of
  /// \param options how wires run
  /// \throws InvalidInput if an option is out of range, or check_metric() rejects a metric
  explicit LiveWire(const SurfaceContext& context, const LiveWireOptions& options = {});
  LiveWire(LiveWire&& other) noexcept;             ///< the other object may then only be destroyed or assigned to
  LiveWire& operator=(LiveWire&& other) noexcept;  ///< stops the work that was running
  ~LiveWire();                                     ///< stops the work that was running

  /// Return another object with the same metrics and no seed.
  ///
  /// They share metrics that are still being computed. A later set_metrics() of one does not change the other.
  LiveWire fork() const;
  /// Return another object on the same surface, with other options.
  ///
  /// They share the surface, the curvatures, and whatever else does not depend on the options. The new object has its
  /// own metrics, no strokes and no seed.
  ///
  /// \param options how its wires run
  /// \throws InvalidInput if an option is out of range, or check_metric() rejects a metric
  LiveWire sibling(const LiveWireOptions& options) const;

  /// Return the surface with everything that depends on it alone.
  const SurfaceContext& context() const;
  /// Return the surface, or null if it is not built yet.
  std::shared_ptr<const Surface> surface() const;
  /// Wait until the surface is built.
  ///
  /// \param seconds the longest time to wait
  /// \returns whether the surface is built
  bool wait_for_surface(double seconds = std::numeric_limits<double>::infinity()) const;

  /// Change the metrics in the background, and then seed again.
  ///
  /// Until then, wires are those of the former metrics, and not final. Metrics that stay are not prepared again.
  ///
  /// \param metrics the new metrics
  /// \throws InvalidInput if there is no metric, an index is out of range, or check_metric() rejects a metric
  void set_metrics(const LiveMetrics& metrics);
  /// Replace the strokes that change the metric, in the background, as set_metrics() does.
  ///
  /// Invalid strokes do not throw here. Later calls that ask for results throw what apply_scribbles() threw.
  ///
  /// \param scribbles the new strokes
  void set_scribbles(std::vector<Scribble> scribbles);

  /// Start the wires from a pick, and drop the wires of an earlier one.
  ///
  /// An edge that is given before the surface is built is checked by wires().
  ///
  /// \param pick a vertex, or, along edges, an edge
  /// \param forward as in edge_wires()
  /// \throws InvalidInput if the pick is not part of the surface, or is an edge although wires run across the surface
  void seed(const Pick& pick, bool forward = false);
  /// Start the wires from any point of the surface; along edges only from a vertex.
  ///
  /// A vertex is the same as seed({vertex}). No wire begins where the metric's embedding has a hole, or in a face
  /// without an area.
  ///
  /// \param point a point of the surface
  /// \throws InvalidInput if the point is not part of the surface, or lies in a face although wires run along edges
  void seed_at(const SurfacePoint& point);
  /// Return the wires from the seed to a target, as far as they are computed. Ask again until they are final.
  ///
  /// Along edges, wires near the seed are final first. Across the surface, work continues for the newest target:
  ///
  /// - The first answer is a path that may be a little longer than the shortest one.
  /// - The next answer is the shortest path in the embedding.
  /// - The final answer is the shortest path in refined faces around it (LiveWireOptions::max_error).
  ///
  /// Until the wires to the newest target are final, progress() is below 1.
  ///
  /// \param target a vertex, or, along edges, an edge
  /// \returns one wire for each metric
  /// \throws InvalidInput if the target is not part of the surface, or there is no seed on the surface
  LiveWires wires(const Pick& target) const;
  /// Return the wires to any point of the surface; along edges only to a vertex. Otherwise the same as wires().
  ///
  /// \param target a point of the surface
  /// \returns one wire for each metric
  /// \throws InvalidInput if seed_at() would reject the target, or there is no seed on the surface
  LiveWires wires_to(const SurfacePoint& target) const;

  /// Return the cheapest closed chain through an edge, in any of the metrics. Along edges only.
  ///
  /// The first call for an edge starts the search, and ends the search for another edge. Ask again until the answer is
  /// final. A seed has priority.
  ///
  /// \param edge two vertices in either order
  /// \returns the chain, without vertices until it is final
  /// \throws InvalidInput if there is no such edge, or wires run across the surface
  LiveLoop loop(const Edge& edge);
  /// Return the closed cuts through a point, at most three, in the metrics of LiveMetrics::cuts. Across the surface
  /// only.
  ///
  /// The first call for a point starts the search, and ends the search for another point. Ask again until the answer is
  /// final. The thread of the first of these metrics does the search. Cuts in the first metric are available first, and
  /// are not final.
  ///
  /// \param through a point of the surface
  /// \returns the cuts that choose_closed_wires() chooses
  /// \throws InvalidInput if the point is not part of the surface, or wires run along edges
  LiveClosedWires closed_wires(const SurfacePoint& through);
  /// Bend one of the closed cuts through a point to a second point, in the cut's metric. Across the surface only.
  ///
  /// Ask again until the answer is final. Before that, it contains no cut.
  ///
  /// \param through a point of the surface, as in closed_wires()
  /// \param second another point of the surface
  /// \param cut the LiveClosedWire::id of the cut
  /// \returns one cut. Empty if there is no such cut, or it does not lead to the second point.
  /// \throws InvalidInput if a point is not part of the surface, or wires run along edges
  /// \see BentWires
  LiveClosedWires bent_wire(const SurfacePoint& through, const SurfacePoint& second, const ClosedCutId& cut = {});
  /// Extend a chain straight, with seamwire::extend_straight(). Along edges only.
  ///
  /// \param edge the last edge of the chain, from edge[0] to edge[1]
  /// \param stops vertices where the extension ends
  /// \returns the extension, with its length in space, in the caller's unit. It has no vertices until
  ///   the edge adjacency is computed.
  /// \throws InvalidInput if there is no such edge, or wires run across the surface
  EdgeChain extend_straight(const Edge& edge, std::span<const std::int32_t> stops) const;
  /// Find the edge loop through an edge, with seamwire::edge_loop(). Along edges only.
  ///
  /// \param edge two vertices in either order
  /// \param stops vertices where the loop ends
  /// \returns the loop, without vertices until the edge adjacency is computed
  /// \throws InvalidInput if there is no such edge, or wires run across the surface
  EdgeLoop edge_loop(const Edge& edge, std::span<const std::int32_t> stops) const;
  /// Find the chain of edges that fits a line, with seamwire::fit_chain(). Along edges only.
  ///
  /// \param line the line
  /// \param begin a vertex where the chain begins
  /// \param end a vertex where the chain ends
  /// \returns the chain, without vertices until the edge adjacency is computed
  /// \throws InvalidInput if seamwire::fit_chain() rejects an argument, or wires run across the surface
  FittedChain fit_chain(const DrawnLine& line, std::optional<std::int32_t> begin = std::nullopt,
                        std::optional<std::int32_t> end = std::nullopt, const Task& = {}) const;
  /// Return Curvature::difference() of the surface, or null if it is not computed yet.
  std::shared_ptr<const std::vector<double>> feature_strength() const;

  /// Return a description of each metric's embedding, in the order of the wires.
  ///
  /// It is nullopt until the metric is prepared, and always along edges.
  std::vector<std::optional<LiveEmbedding>> embeddings() const;

  /// Return the fraction of the preparation and of the seed's work that is done.
  ///
  /// It is 0 until the surface is built, and 1 when all work is done, including the wires to the newest target.
  double progress() const;
  /// Wait for all running work, including loops.
  ///
  /// \param seconds the longest time to wait
  /// \returns whether the work is done
  bool wait(double seconds = std::numeric_limits<double>::infinity()) const;

 private:
  struct Impl;
  explicit LiveWire(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace seamwire
