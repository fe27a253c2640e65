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
#include "seamwire/context/along.hpp"
#include "seamwire/context/metric_spec.hpp"
#include "seamwire/context/surface_context.hpp"
#include "seamwire/edges/edge_loop.hpp"
#include "seamwire/edges/edge_wires.hpp"
#include "seamwire/edges/fit_chain.hpp"
#include "seamwire/metric/scribble.hpp"
#include "seamwire/surface/surface.hpp"
#include "seamwire/surface/surface_point.hpp"
#include "seamwire/wires/closed_wires.hpp"

namespace seamwire {

/// The metrics of live wires.
struct LiveMetrics {
  /// One wire is computed for each, at least one. The wire of the first metric is offered first; if some metrics are
  /// counterparts of the first one (is_counterpart()), the shortest wire of these.
  std::vector<MetricSpec> wires;
  /// Indices into `wires`: the metrics whose closed cuts are offered, in this order. At least one.
  std::vector<std::size_t> cuts = {0};

  /// Member by member.
  friend bool operator==(const LiveMetrics&, const LiveMetrics&) = default;
};

/// Returns the metrics of a family, as the tool offers their wires.
///
/// - kFeature: M_min and M_max. Across the surface, the concave metric comes first.
/// - kCampen, kPottmannKovacs: M_min and M_max.
/// - kConcave: The concave metric, then the Euclidean one. Its closed cuts help out where nothing is concave.
/// - kEuclidean: The Euclidean metric. The strength does not matter.
///
/// Throws InvalidInput for a strength that is not as metric.hpp says.
SEAMWIRE_API LiveMetrics live_metrics(MetricFamily family, const Strength& strength, Along along = Along::kSurface);

/// How live wires run.
struct LiveWireOptions {
  Along along = Along::kSurface;                                                          ///< where
  LiveMetrics metrics = live_metrics(MetricFamily::kFeature, {.parameter = 0.1}, along);  ///< in which metrics
  double turning = 3.0;                                                                   ///< q of edge_wires()
  /// q of shortest_cycle(). nullopt: 20, or a quarter of the root of the number of edges if that is more. A fixed q
  /// would make a long ring of a dense mesh more expensive than a circle around one quad, which costs 4 q edges.
  std::optional<double> loop_turning = std::nullopt;
  /// The mean relative error of a wire's length to aim for, in [0, 1], across the surface. A wire becomes final once
  /// the faces around it resolve the metric that well (EmbedOptions::max_error) and it is the shortest there. 0: a wire
  /// is final in the embedding of Section 4.1.
  double max_error = 0.01;
};

/// One of the wires from the seed to a target. `vertices` are the ends of the edges that would be marked: along
/// edges the wire itself, across the surface the chain it snaps to. Where the wire begins or ends within a face, the
/// chain does so at the corner of the face that has the largest barycentric coordinate.
struct LiveCandidate {
  MetricSpec metric;                                        ///< that it is short in
  std::vector<Vector> points;                               ///< in the caller's coordinates; empty: no such wire
  std::vector<std::int32_t> faces;                          ///< per segment, across the surface only
  std::vector<std::int32_t> vertices;                       ///< the chain of edges, as said above
  double length = std::numeric_limits<double>::infinity();  ///< in its metric, of the model scaled to the unit cube
  bool solved = false;  ///< it is the shortest in the embedding of the whole surface, or along edges; or it is final
  bool final = false;   ///< false: still being computed; what is here, if anything, will be replaced
};

/// The wires to a target.
struct LiveWires {
  std::vector<LiveCandidate> wires;  ///< one for each metric, in the order of LiveMetrics::wires
  /// The number of the wire to be offered first, see LiveMetrics. If that wire turns out not to reach the target, it is
  /// the shortest of all wires.
  int active = 0;
  bool settled = false;  ///< whether `active` is final, and stays the active one
  /// Whether all are.
  bool final() const { return std::ranges::all_of(wires, &LiveCandidate::final); }
  /// Whether all are solved: what follows a moving cursor need not wait for more.
  bool solved() const { return std::ranges::all_of(wires, &LiveCandidate::solved); }
};

/// A closed chain of edges.
struct LiveLoop {
  std::vector<std::int32_t> vertices;  ///< the first one is not given twice; empty: no chain, or not yet
  double length = std::numeric_limits<double>::infinity();  ///< as an EdgeChain has it
  bool final = false;                                       ///< false: still being computed
};

/// A closed cut through a point of the surface, in pieces of about the same length that follow each other from the
/// point around to it. Each is the shortest wire between its ends, but for the place at which the cut's halves meet.
/// A cut that was bent to a second point has four pieces: two from each point to the other. Each is the shortest among
/// wires that lead around as it does.
struct LiveClosedWire {
  std::vector<LiveCandidate> pieces;  ///< three or four, or fewer where one would begin on an edge without a face
  std::vector<SurfacePoint>
      joints;             ///< where one piece ends and the next one begins: within faces, or the second point
  bool separates = true;  ///< as ClosedWire has it
  double turn = 0.0;      ///< as ClosedWire has it; of one that was bent what it was before
  double length = std::numeric_limits<double>::infinity();  ///< in its metric, of the model scaled to the unit cube
  ClosedCutId id;  ///< for bent_wire(); it may change until the answer is final
};

/// What closed_wires() finds.
struct LiveClosedWires {
  std::vector<LiveClosedWire> cuts;  ///< best first; empty: nothing suggests one, or they are not found yet
  bool final = false;                ///< false: still being computed
};

/// What became of one metric's embedding: see Embedding. Across the surface wires lead around triangles that are not
/// valid, as around holes.
struct LiveEmbedding {
  std::size_t invalid_left = 0;   ///< triangles
  bool hit_cap = false;           ///< the most triangles that may be added ended the subdivision
  std::size_t clamped_edges = 0;  ///< whose lengths are others than the metric's
  double worst_clamp = 1.0;       ///< by that factor at most, 1 or more
};

/// Wires from a seed to any target, one in each of several metrics of a surface (Section 5). Each metric has its own
/// thread. Where there are fewer processors than metrics, the last ones wait until the work on the leading one is done.
///
/// Any number of threads may call the members at once, except that nobody may use an object while it is moved or
/// destroyed. Only wait() and wait_for_surface() wait for the computation. Metrics, strokes and seed are those that
/// were set last.
///
/// While the surface is being built, the members keep what they are given. They answer that nothing is there yet and
/// nothing is final. An edge that turns out not to be part of the surface is refused at a later call. If the surface
/// cannot be built, each member throws what the constructor of Surface threw.
class SEAMWIRE_API LiveWire {
 public:
  /// Throws InvalidInput for options that are not as said above and in metric.hpp.
  explicit LiveWire(const SurfaceContext& context, const LiveWireOptions& options = {});
  /// On its own context. Throws InvalidInput, too, if there is no surface.
  explicit LiveWire(std::shared_ptr<const Surface> surface, const LiveWireOptions& options = {});
  /// Builds the surface on its own threads, from the arguments of Surface's constructor, and returns at once.
  LiveWire(std::vector<Vector> points, std::vector<Triangle> triangles,
           std::optional<std::vector<Edge>> edges = std::nullopt, const LiveWireOptions& options = {});
  LiveWire(LiveWire&& other) noexcept;             ///< leaves one that may only be destroyed
  LiveWire& operator=(LiveWire&& other) noexcept;  ///< stops the work that was running
  ~LiveWire();                                     ///< stops the running work

  /// Another one with the same metrics, those still being computed too, and no seed. A later set_metrics() of
  /// either does not change the other.
  LiveWire fork() const;
  /// Another one on the same surface, which is built once, with the curvatures and whatever else does not depend on the
  /// options. It has its own metrics, no strokes and no seed. Throws InvalidInput as the constructors do.
  LiveWire sibling(const LiveWireOptions& options) const;

  /// The surface with all that depends on it alone.
  const SurfaceContext& context() const;
  /// Null until it is built.
  std::shared_ptr<const Surface> surface() const;
  /// Waits until the surface is built, at most `seconds`; whether it is.
  bool wait_for_surface(double seconds = std::numeric_limits<double>::infinity()) const;

  /// Changes the metrics in the background, and then seeds again: until then wires are those of the former metrics, and
  /// not final. A metric that stays is not prepared again. Throws InvalidInput as the constructors do.
  void set_metrics(const LiveMetrics& metrics);
  /// The strokes that change the metric from here on, instead of those before; as set_metrics(). What apply_scribbles()
  /// throws for them comes out of the calls that ask for results.
  void set_scribbles(std::vector<Scribble> scribbles);

  /// Starts the wires from a pick, dropping those of an earlier one. Across the surface the pick must be a vertex.
  /// `forward` as in edge_wires(). Throws InvalidInput where the pick is not part of the surface; an edge that is given
  /// before the surface is there is refused by wires().
  void seed(const Pick& pick, bool forward = false);
  /// Starts the wires from any point of the surface; along edges only from a vertex (SurfacePoint::at_vertex()).
  ///
  /// A vertex is the same as seed({vertex}). Where the metric's embedding has a hole, or the face has no area, no wire
  /// begins. Throws InvalidInput if the point is not part of the surface, or if it lies in a face and wires run along
  /// edges.
  void seed_at(const SurfacePoint& point);
  /// Returns the wires from the seed to a target, as far as they are computed. Ask again until they are final.
  ///
  /// Along edges, wires near the seed are final first. Across the surface, work goes on for the target that was asked
  /// for last. Its first answer is a path that may be a little longer than the shortest one. The next answer is the
  /// shortest path in the embedding. The last answer, which is final, is the shortest path in refined faces around it
  /// (LiveWireOptions::max_error). Until the wires to the newest target are final, progress() is below 1.
  ///
  /// Throws InvalidInput if the target is not part of the surface, or if no seed on the surface is set.
  LiveWires wires(const Pick& target) const;
  /// Returns the wires to any point of the surface; along edges only to a vertex. As wires() otherwise, and throws as
  /// seed_at() does.
  LiveWires wires_to(const SurfacePoint& target) const;

  /// The closed chain through an edge, the cheapest of the metrics'; along edges only. The first call for an edge
  /// starts the search, in place of that for another edge; ask again until the answer is final. A seed goes first.
  LiveLoop loop(const Edge& edge);
  /// The closed cuts through a point, at most three, in the metrics of LiveMetrics::cuts (choose_closed_wires());
  /// across the surface only. The thread of the first of these metrics finds them; asked for as loop(). The cuts
  /// of the first metric come first. On a large surface, a rough version of them comes even before. Neither is final.
  /// Throws InvalidInput if the point is not on the surface.
  LiveClosedWires closed_wires(const SurfacePoint& through);
  /// Bends one of the closed cuts through a point to a second point, in the cut's metric (BentWires). `cut` is its
  /// LiveClosedWire::id. The answer is empty if there is no such cut, or if it does not lead there. Asked for as the
  /// others, and never there before it is final.
  LiveClosedWires bent_wire(const SurfacePoint& through, const SurfacePoint& second, const ClosedCutId& cut = {});
  /// seamwire::extend_straight(), with the way's length in the unit cube; no vertices until the edge adjacency is
  /// computed.
  EdgeChain extend_straight(const Edge& edge, std::span<const std::int32_t> stops) const;
  /// seamwire::edge_loop(); no vertices until the edge adjacency is computed.
  EdgeLoop edge_loop(const Edge& edge, std::span<const std::int32_t> stops) const;
  /// seamwire::fit_chain(); no vertices, too, until the edge adjacency is computed. Along edges only.
  FittedChain fit_chain(const DrawnLine& line, std::optional<std::int32_t> begin = std::nullopt,
                        std::optional<std::int32_t> end = std::nullopt) const;
  /// s of eq. 5 at each vertex; null while it is being computed.
  std::shared_ptr<const std::vector<double>> feature_strength() const;

  /// One for each metric, in the order of the wires: across the surface, as far as they are prepared; along edges none.
  std::vector<std::optional<LiveEmbedding>> embeddings() const;

  /// Fraction of the preparation and the seed's work that is done: 0 until the surface is there, 1 when all is, the
  /// wires to the newest target included.
  double progress() const;
  /// Waits for all running work, loops too, at most `seconds`; whether it is done.
  bool wait(double seconds = std::numeric_limits<double>::infinity()) const;

 private:
  struct Impl;
  explicit LiveWire(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace seamwire
