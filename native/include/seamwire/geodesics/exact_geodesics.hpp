// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <limits>
#include <memory>
#include <vector>

#include "seamwire/surface/intrinsic_mesh.hpp"
#include "seamwire/task.hpp"

namespace seamwire {

/// A point that a geodesic passes: a vertex (half_edge < 0), or a point on an edge.
struct PathPoint {
  std::int32_t vertex = -1;
  std::int32_t half_edge = -1;
  double t = 0.0;  ///< 0 at the tail of the half-edge, 1 at its tip
};

/// A geodesic over an IntrinsicMesh, from the seed to a target: straight in each triangle.
struct IntrinsicPath {
  std::vector<PathPoint> points;    ///< empty where the target is unreachable; one point where it is the seed
  std::vector<std::int32_t> faces;  ///< the triangle each segment crosses or bounds; -1 along a loose edge
  double length = std::numeric_limits<double>::infinity();  ///< sum of the segments
};

class GeodesicMesh;  // the solver's own, flat form of the mesh

/// Distances from one seed to every vertex, with what it takes to trace the paths; exact, or from a bounded number of
/// windows.
class DistanceField {
 public:
  /// How the shortest path arrives at a vertex, in the solver's own numbering.
  struct TraceRecord {
    double x = 0.0, y = 0.0;  ///< the source unfolded into the frame of `half_edge`; along an edge: x is its length
    std::int32_t half_edge = kNone;  ///< crossed last (>= 0); ~h: straight along half-edge h; kNone: the seed, or none
    std::int32_t source = -1;        ///< the vertex the path runs straight from

    static constexpr std::int32_t kNone = std::numeric_limits<std::int32_t>::min();
    static constexpr std::int32_t kLooseEdge = kNone + 1;  ///< straight along an edge without faces
  };
  DistanceField(std::shared_ptr<const GeodesicMesh> mesh, std::int32_t seed, std::vector<double> distances,
                std::vector<TraceRecord> records, bool is_exact = true);

  std::int32_t seed() const { return seed_; }
  bool is_exact() const { return is_exact_; }
  /// One a vertex; infinite where no path leads. Where the field is not exact they are off to either side.
  const std::vector<double>& distances() const { return distances_; }
  /// The shortest path from the seed to a vertex, in time proportional to the triangles it crosses. Its length is the
  /// distance to rounding. Where the field is not exact, it is a real path all the same, with its true length, the
  /// shortest one within the triangles around the way that the field tells; it may be longer than the geodesic, but not
  /// shorter. Throws InvalidInput for a vertex out of range; Cancelled, where the field is not exact: only then it
  /// takes long enough for `task` to be looked at.
  IntrinsicPath trace(std::int32_t vertex, const Task& task = {}) const;

 private:
  std::shared_ptr<const GeodesicMesh> mesh_;
  std::int32_t seed_;
  std::vector<double> distances_;
  std::vector<TraceRecord> records_;
  bool is_exact_;
};

/// What the work of a solve consisted of; the same for the same input on every machine.
struct GeodesicCounters {
  std::size_t lists = 0;    ///< window lists propagated
  std::size_t windows = 0;  ///< windows propagated
};

/// Solver for repeated seeds on one mesh: the triangle-oriented wavefront of Qin et al., "Fast and Exact Discrete
/// Geodesic Computation Based on Triangle-Oriented Wavefront Propagation" (2016), with the filter of Xin and Wang
/// (2009), on edge lengths alone. solve() may be called from several threads at once.
class ExactGeodesics {
 public:
  /// Throws InvalidInput for a length that is not positive and finite, a triangle that fails the triangle inequality,
  /// or twins that do not match.
  explicit ExactGeodesics(const IntrinsicMesh& mesh);
  /// Throws InvalidInput for a seed out of range; Cancelled.
  DistanceField solve(std::int32_t seed, const Task& task = {}, GeodesicCounters* counters = nullptr) const;

  /// The same with at most `windows` > 0 windows of a list going on: those around the shortest way to the apex,
  /// stretched over what the others covered. The more windows, the longer it takes and the nearer it comes
  /// (docs/benchmarks.md).
  DistanceField solve_bounded(std::int32_t seed, std::uint32_t windows, const Task& task = {},
                              GeodesicCounters* counters = nullptr) const;

  /// The solver's form of the mesh, immutable.
  const std::shared_ptr<const GeodesicMesh>& mesh() const { return mesh_; }

 private:
  DistanceField run(std::int32_t seed, std::uint32_t windows, const Task& task, GeodesicCounters* counters) const;

  std::shared_ptr<const GeodesicMesh> mesh_;
};

}  // namespace seamwire
