// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "seamwire/live/livewire.hpp"
#include "seamwire/surface/surface.hpp"
#include "seamwire/task.hpp"

namespace seamwire {

/// Which wires a SeamPlanner has to choose from.
struct SeamPlannerOptions {
  Along along = Along::kSurface;  ///< where they run
  /// Of the two feature metrics that they are short in.
  Strength strength = {.max_anisotropy = 20.0, .clamp_percentile = 99.0};
  std::vector<std::int32_t> seeds_at = {};  ///< vertices that are seeds whatever else is
  std::size_t seeds = 24;                   ///< to begin with, those included, 1 or more
  std::size_t most_seeds = 120;             ///< at most, where the surface is not cut into discs yet; `seeds` or more
  /// How many times denser seeds are at each vertex than elsewhere; empty: as dense everywhere. Where it is 0 there are
  /// those of `seeds_at` alone, and no wire comes there.
  std::vector<double> density = {};
  /// The mirror image of each vertex, itself or -1 where it has none: seeds come and wires go in pairs. The image of a
  /// vertex' image is the vertex. Empty: the surface is not symmetric.
  std::vector<std::int32_t> images = {};
  /// Seams that are there already, and stay: vertex pairs; those that are no edges of two triangles cut nothing.
  std::vector<Edge> seams = {};
};

/// What islands may be like.
struct SeamLimits {
  /// By how much the normals of an island may spread: 1 - |sum of area normals| / area, 0 in a plane, 0.5 for a half
  /// sphere. Not negative.
  double max_spread = 0.42;
  /// The same for each of the caller's triangles, the least in an island counts; empty: `max_spread` for all.
  std::vector<double> max_spreads = {};
  /// Islands are joined until there are so many, however far their normals spread then, or no two can be joined to a
  /// disc. 0: as few as the spread allows.
  std::size_t islands = 0;
  /// A piece of less than this part of the surface, and of the island that it becomes part of, is joined to another one
  /// wherever that makes a disc, however far normals spread then. 0 to 1.
  double crumb = 0.004;
  double crumb_of_island = 1.0;  ///< see `crumb`
  /// Whether wires may start on the edges of others, where they ran beside them and left crumbs between. Where curves
  /// are cut, not edges marked, they have to run from seed to seed: these alone their curves have in common.
  bool may_start_on_others = true;
  /// Whether direct wires take the place of those that meet at a seed, and seeds slide, where that costs less. Where
  /// islands are to be small for another reason than how they bend, detours may be what they need.
  bool are_straightened = true;
};

/// One wire of a plan.
struct PlannedWire {
  std::int32_t from = -1;              ///< a seed, or where one slid to
  std::int32_t to = -1;                ///< another one
  Follow follow = Follow::kMin;        ///< whose metric it is the shortest in
  std::vector<std::int32_t> vertices;  ///< the chain of edges that it marks, from `from` to `to`
  std::vector<Vector> points;          ///< its curve, in the caller's coordinates
  /// The caller's face that each segment of it lies in, -1 along an edge without one; none of a wire along edges.
  std::vector<std::int32_t> faces;
  double worth = 1.0;  ///< what its length is divided by in SeamPlan::cost
};

/// Seams that cut a surface into islands.
struct SeamPlan {
  std::vector<PlannedWire> wires;     ///< without the seams that were there
  std::vector<std::int32_t> islands;  ///< of each of the caller's triangles, as face_segments() numbers them
  std::size_t island_count = 0;       ///< how many
  /// How many islands are not discs, see missing_cuts(): there were too few seeds to cut them.
  std::size_t not_discs = 0;
  /// The lengths of the wires in the caller's units, each over its worth: what is the less of two plans for the same.
  double cost = 0.0;
};

/// Plans a network of wires that cuts a surface into discs.
///
/// Seeds are placed far from each other and on features: farthest-point sampling along edges in the metric, weighted by
/// the rank of |k1| - |k2|. Those whose cells touch are joined by the wire that LiveWire would show, the shorter one of
/// the two metrics. Where a piece is no disc it gets another seed. Then wires are taken away, as long as what they part
/// joins to discs within the limits: first the longest for its worth, which is more where a wire follows features, runs
/// in hollows, and out of sight (ambient occlusion). At last, where two wires run side by side and leave crumbs between
/// them, the weaker one starts on the other instead; and where just two wires meet, a direct one takes their place,
/// where two or three do, the seed slides along one of them, if that costs less and leaves islands as good.
class SeamPlanner {
 public:
  /// Finds the wires to choose from, on several threads. Throws InvalidInput for options that are not as said above or
  /// in metric.hpp; Cancelled.
  explicit SeamPlanner(std::shared_ptr<const Surface> surface, const SeamPlannerOptions& options = {},
                       const Task& task = {});
  /// One with other seeds, images or seams on the same surface, in less time, for the metrics are there. Throws as that
  /// does, and InvalidInput where wires would run elsewhere or in other metrics.
  SeamPlanner with(const SeamPlannerOptions& options, const Task& task = {}) const;
  /// The wires that are needed for islands within limits; no wires where the surface is a disc within them. Throws
  /// InvalidInput for limits that are not as said above; Cancelled.
  /// `kept`: wires of another plan of the same surface that this one has as well, whatever the limits. Throws
  /// InvalidInput for a wire whose edges or points are not those of the surface.
  SeamPlan plan(const SeamLimits& limits = {}, std::span<const PlannedWire> kept = {}, const Task& task = {}) const;
  /// The wires of a plan of the same surface and seams, straightened as the end of plan() does it: islands stay as many
  /// and as good within the limits. `fixed`: vertices; a seed there stays, and what meets there. Throws as plan() does.
  SeamPlan straightened(std::span<const PlannedWire> wires, const SeamLimits& limits = {},
                        std::span<const std::int32_t> fixed = {}, const Task& task = {}) const;

 private:
  struct Impl;
  std::shared_ptr<const Impl> impl_;
};

}  // namespace seamwire
