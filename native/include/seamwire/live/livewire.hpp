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

#include "seamwire/edges/edge_loop.hpp"
#include "seamwire/edges/edge_wires.hpp"
#include "seamwire/edges/fit_chain.hpp"
#include "seamwire/metric/metric.hpp"
#include "seamwire/metric/scribble.hpp"
#include "seamwire/surface/surface.hpp"
#include "seamwire/surface/surface_point.hpp"
#include "seamwire/wires/snap.hpp"
#include "seamwire/wires/wire.hpp"

namespace seamwire {

/// Where wires run: across the surface, as exact geodesics, or along its real edges.
enum class Along { kSurface, kEdges };

/// Which of the metrics of metric.hpp wires are short in: a wire in M_min and one in M_max of that name. kFeature,
/// across the surface: a third one in concave_metric(), on curvatures smoothed over 0.01. kConcave: the first wire in
/// that metric, the second one in the Euclidean metric. kEuclidean: one wire, in that metric.
enum class MetricFamily { kFeature, kCampen, kPottmannKovacs, kConcave, kEuclidean };
/// What concave_metric() takes a max_anisotropy A for, a strength of (A - 1) / (kConcaveUnit - 1), and, beside
/// kFeature, a gamma: gamma / kConcaveGamma; so that one setting serves all wires.
inline constexpr double kConcaveUnit = 20.0, kConcaveGamma = 0.1;

/// How live wires run.
struct LiveWireOptions {
  Along along = Along::kSurface;                 ///< where
  MetricFamily family = MetricFamily::kFeature;  ///< in which metric
  Strength strength = {.parameter = 0.1};        ///< of that metric; the Euclidean one has none
  double turning = 3.0;                          ///< q of edge_wires()
  /// q of shortest_cycle(). nullopt: 20, and a quarter of the root of the number of edges where that is more. A circle
  /// around one quad costs four turns, 4 q edges, so with a fixed q a ring of a dense mesh, which may have as many
  /// edges as that root, would be dearer.
  std::optional<double> loop_turning = std::nullopt;
};

/// One of the wires from the seed to a target. `vertices` are the ends of the edges that would be marked: along
/// edges the wire itself, across the surface the chain it snaps to. Where the wire begins or ends within a face, the
/// chain does so at the corner of the face that has the largest barycentric coordinate.
struct LiveCandidate {
  Follow follow = Follow::kMin;                             ///< whose metric it is the shortest in
  std::vector<Vector> points;                               ///< in the caller's coordinates; empty: no such wire
  std::vector<std::int32_t> faces;                          ///< per segment, across the surface only
  std::vector<std::int32_t> vertices;                       ///< the chain of edges, as said above
  double length = std::numeric_limits<double>::infinity();  ///< in its metric, of the model scaled to the unit cube
  bool final = false;  ///< false: still being computed; what is here, if anything, will be replaced
};

/// The wires to a target.
struct LiveWires {
  std::vector<LiveCandidate> wires;  ///< one for each metric, in the order of Follow
  /// The one to be offered first: that of the concave metric, unless it turns out not to reach the target; where there
  /// is none the one shorter in its own metric (Section 5).
  int active = 0;
  bool settled = false;  ///< whether `active` is final, and stays the active one whatever the others will be
  /// Whether all are.
  bool final() const { return std::ranges::all_of(wires, &LiveCandidate::final); }
};

/// A closed chain of edges.
struct LiveLoop {
  std::vector<std::int32_t> vertices;  ///< the first one is not given twice; empty: there is none, or not yet
  double length = std::numeric_limits<double>::infinity();  ///< as an EdgeChain has it
  bool final = false;                                       ///< false: still being computed
};

/// A closed cut through a point of the surface, in pieces of about the same length that follow each other from the
/// point around to it. Each is the shortest wire between its ends, but for the place at which the cut's halves meet.
/// One through a second point as well is in four pieces, two from either point to the other, each the shortest among
/// wires that lead around as it does.
struct LiveClosedWire {
  std::vector<LiveCandidate> pieces;  ///< three or four, or fewer where one would begin on an edge without a face
  std::vector<SurfacePoint>
      joints;             ///< where one piece ends and the next one begins: within faces, or the second point
  bool separates = true;  ///< as ClosedWire has it
  double turn = 0.0;      ///< as ClosedWire has it; of one that was bent what it was before
  double length = std::numeric_limits<double>::infinity();  ///< in its metric, of the model scaled to the unit cube
  std::size_t which = 0;  ///< what bent_wire() calls it; of one that is not final it may become another
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

/// The metrics of one family for a surface, each computed on a thread of its own; seed, then a wire in each to any
/// target (Section 5). Where there are fewer processors than metrics, the last ones wait until the work on the leading
/// one is done. All members may be called from one thread at a time, surface() and wait_for_surface() from
/// others meanwhile; none but wait() and wait_for_surface() waits for the computation.
///
/// Where the surface is still being built, the members keep what they are given and answer that nothing is there yet
/// and nothing final; an edge that turns out not to be part of the surface is refused at a later call. Where it cannot
/// be built, each member throws what the constructor of Surface threw.
class LiveWire {
 public:
  /// Throws InvalidInput for options that are not as said above and in metric.hpp, and where there is no surface.
  explicit LiveWire(std::shared_ptr<const Surface> surface, const LiveWireOptions& options = {});
  /// Builds the surface on its own threads, from the arguments of Surface's constructor, and returns at once.
  LiveWire(std::vector<Vector> points, std::vector<Triangle> triangles,
           std::optional<std::vector<Edge>> edges = std::nullopt, const LiveWireOptions& options = {});
  LiveWire(LiveWire&& other) noexcept;             ///< leaves one that may only be destroyed
  LiveWire& operator=(LiveWire&& other) noexcept;  ///< stops the work that was running
  ~LiveWire();                                     ///< stops the running work

  /// Another one with the same metrics, those still being computed too, and no seed. A later set_metric() of either
  /// does not change the other.
  LiveWire fork() const;
  /// Another one on the same surface, which is built once, with the curvatures and whatever else does not depend on the
  /// options. It has metrics of its own, no strokes and no seed. Throws InvalidInput as the constructors do.
  LiveWire sibling(const LiveWireOptions& options) const;

  /// Null until it is built.
  std::shared_ptr<const Surface> surface() const;
  /// Waits until the surface is built, at most `seconds`; whether it is.
  bool wait_for_surface(double seconds = std::numeric_limits<double>::infinity()) const;

  /// Changes the metric in the background, and then seeds again: until then wires are those of the former metric, and
  /// not final. Throws InvalidInput where the strength is not as said in metric.hpp.
  void set_metric(MetricFamily family, const Strength& strength);
  /// The strokes that change the metric from here on, instead of those before; as set_metric(). What apply_scribbles()
  /// throws for them comes out of the calls that ask for results.
  void set_scribbles(std::vector<Scribble> scribbles);

  /// Starts the wires from a pick, dropping those of an earlier one. Across the surface the pick must be a vertex.
  /// `forward` as in edge_wires(). Throws InvalidInput where the pick is not part of the surface; an edge that is given
  /// before the surface is there is refused by wires().
  void seed(const Pick& pick, bool forward = false);
  /// Starts the wires from any point of the surface, across the surface only. Throws InvalidInput where the point is
  /// none. Where the metric's embedding has a hole, or the face no area, no wire begins.
  void seed_at(const SurfacePoint& point);
  /// The wires from the seed to a target now, as far as they are computed: along edges those near the seed are final
  /// first; across the surface a path that may be a little longer than the shortest one is computed for the target
  /// asked for last, and is there at one of the next calls for it. Throws InvalidInput for a target that is not part of
  /// the surface or where there is no seed that is.
  LiveWires wires(const Pick& target) const;
  /// To any point of the surface, across the surface only.
  LiveWires wires_to(const SurfacePoint& target) const;

  /// The closed chain through an edge, the cheapest of the metrics'; along edges only. The first call for an edge
  /// starts the search, in place of that for another edge; ask again until the answer is final. A seed goes first.
  LiveLoop loop(const Edge& edge);
  /// The closed cuts through a point, at most three, in M_min, or what the metric's family has in its place; across the
  /// surface only. In the family kConcave the second one is the best in the Euclidean metric, unless it is like the
  /// first one (choose_closed_wires()). Of M_min's thread; asked for as loop(). Those of the first metric are there
  /// before, and on a large surface what a bounded number of windows tells of them, not final. Throws InvalidInput
  /// where the point is none.
  LiveClosedWires closed_wires(const SurfacePoint& through);
  /// Of the closed cuts through a point the one with that `which`, bent to a second point (BentWires) in the metric
  /// that it is of; none where there is none, or none leads there. Asked for as the others, and never there before it
  /// is final.
  LiveClosedWires bent_wire(const SurfacePoint& through, const SurfacePoint& second, std::size_t which = 0);
  /// seamwire::extend_straight(), with the way's length in the unit cube; no vertices where it cannot be told yet.
  EdgeChain extend_straight(const Edge& edge, std::span<const std::int32_t> stops) const;
  /// seamwire::edge_loop(); no vertices where it cannot be told yet.
  EdgeLoop edge_loop(const Edge& edge, std::span<const std::int32_t> stops) const;
  /// seamwire::fit_chain(); no vertices, too, where it cannot be told yet. Along edges only.
  FittedChain fit_chain(const DrawnLine& line, std::optional<std::int32_t> begin = std::nullopt,
                        std::optional<std::int32_t> end = std::nullopt) const;
  /// s of eq. 5 at each vertex; null while it is being computed.
  std::shared_ptr<const std::vector<double>> feature_strength() const;

  /// One for each metric, in the order of the wires: across the surface, as far as they are prepared; along edges none.
  std::vector<std::optional<LiveEmbedding>> embeddings() const;

  /// Fraction of the preparation and the seed's work that is done, 0 until the surface is there, 1 when all is.
  double progress() const;
  /// Waits for all running work, loops too, at most `seconds`; whether it is done.
  bool wait(double seconds = std::numeric_limits<double>::infinity()) const;

 private:
  struct Impl;
  explicit LiveWire(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace seamwire
