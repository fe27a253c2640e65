// SPDX-License-Identifier: GPL-3.0-or-later
//
// A path at once, in three steps:
// 1. Compute distances d from the seed along hops, as far as the target.
// 2. Search back from the target for the corridor: the vertices v with the least d(v) + (distance along hops to the
//    target). This is A* (Hart, Nilsson, Raphael, "A Formal Basis for the Heuristic Determination of Minimum Cost
//    Paths", 1968). The estimate is exact here, so the search visits only the corridor and its neighbors.
// 3. Run the exact wavefront over the triangles at those vertices, as a separate mesh.
// If the seed or the target lies within a face, the first two steps use the nearest corner of that face. If only few
// windows of a list are kept, the third step gives paths to all corners, and the path is the shortest one around these.
#include "seamwire/geodesics/corridor_paths.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

#include "detail/drop_repeats.hpp"
#include "detail/index.hpp"
#include "detail/poll.hpp"
#include "detail/prefetch.hpp"
#include "detail/zeroed_array.hpp"
#include "geodesics/geodesic_mesh.hpp"
#include "geodesics/path_tracing.hpp"
#include "geodesics/wavefront.hpp"
#include "graph/indexed_heap.hpp"
#include "seamwire/geodesics/distance_field.hpp"
#include "seamwire/task.hpp"

namespace seamwire {

using namespace detail;

namespace detail {

/// Distances along hops (GeodesicMesh::for_each_hop) from a seed, computed outwards as far as they are asked for.
/// Delta-stepping keeps buckets of distances instead of a heap. The vertices of a bucket are settled in any order, and
/// again if necessary (Meyer, Sanders, "Delta-stepping: a parallelizable shortest path algorithm", 2003). Single
/// precision is enough, because distances only tell where to look for a path.
class DeltaStepping {
 public:
  DeltaStepping(const GeodesicMesh& mesh, std::int32_t seed) : mesh_(mesh), reached_(mesh.vertex_count()) {
    const float longest = mesh.longest_hop();
    width_ = std::max(mesh.mean_edge(), longest / static_cast<float>(kMostBuckets - 2));
    if (!(width_ > 0)) width_ = 1.0F;
    per_width_ = 1.0F / width_;
    buckets_.resize(static_cast<std::size_t>(longest * per_width_) + 3);
    relax(seed, 0.0F, -1);
  }

  /// Goes on until the distance of `vertex` is final, or nothing is left to be reached.
  void reach(std::int32_t vertex, const Task& task) {
    std::size_t work = 0;
    while (waiting_ > 0 && !(at(vertex) < radius())) {
      std::vector<Entry>& entries = bucket(current_);
      // The bucket may grow while it is read.
      while (done_ < entries.size()) {
        if (done_ + 2 * kAhead < entries.size()) prefetch_vertex(entries[done_ + 2 * kAhead].vertex);
        if (done_ + kAhead < entries.size()) prefetch_faces(entries[done_ + kAhead].vertex);
        const Entry entry = entries[done_++];
        --waiting_;
        if (entry.distance > at(entry.vertex)) continue;
        mesh_.for_each_hop(entry.vertex,
                           [&](std::int32_t to, float length) { relax(to, entry.distance + length, entry.vertex); });
        if (++work % kStepsBetweenChecks == 0) task.check(0.0);
      }
      entries.clear();
      done_ = 0;
      ++current_;
    }
  }

  /// Final where it is below radius(), else an upper bound; infinite where nothing led yet.
  float at(std::int32_t vertex) const {
    const Reached& known = reached_[vertex];
    return known.before == kUnknown ? std::numeric_limits<float>::infinity() : known.distance;
  }

  /// A shortest chain of hops from the seed to a vertex whose distance is final. Of the path only the points are set, a
  /// vertex each.
  IntrinsicPath chain(std::int32_t vertex) const {
    IntrinsicPath path;
    for (std::int32_t v = vertex; v >= 0; v = reached_[v].before - kBefore) path.points.push_back({.vertex = v});
    std::reverse(path.points.begin(), path.points.end());
    return path;
  }

  float radius() const { return static_cast<float>(current_) * width_; }

 private:
  /// Of the ring; where the longest edge is longer than that many mean ones, buckets are wider.
  static constexpr std::size_t kMostBuckets = 4096;
  /// Entries of a bucket that memory is asked for in advance.
  static constexpr std::size_t kAhead = 8;
  /// Vertices between two looks at the task: some 0.1 ms.
  static constexpr std::size_t kStepsBetweenChecks = 2048;

  struct Reached {
    float distance;
    std::int32_t before;  ///< the vertex before on the chain from the seed, -1 at the seed, plus kBefore; or kUnknown
  };
  static constexpr std::int32_t kUnknown = 0, kBefore = 2;
  struct Entry {
    float distance;
    std::int32_t vertex;
  };

  std::vector<Entry>& bucket(std::size_t number) { return buckets_[number % buckets_.size()]; }
  std::size_t bucket_of(float distance) const { return static_cast<std::size_t>(distance * per_width_); }

  void relax(std::int32_t vertex, float distance, std::int32_t from) {
    Reached& known = reached_[vertex];
    if (!(distance < at(vertex))) return;
    known = {distance, from + kBefore};
    bucket(std::max(bucket_of(distance), current_)).push_back({distance, vertex});
    ++waiting_;
  }

  void prefetch_vertex(std::int32_t vertex) const {
    prefetch(&reached_[vertex]);
    prefetch(mesh_.out(vertex).data());
  }
  void prefetch_faces(std::int32_t vertex) const {
    for (const std::int32_t h : mesh_.out(vertex)) mesh_.prefetch_half_edge(h);
  }

  const GeodesicMesh& mesh_;
  ZeroedArray<Reached> reached_;
  std::vector<std::vector<Entry>> buckets_;  ///< a ring: no hop is longer than all but one of them
  float width_ = 1.0F, per_width_ = 1.0F;
  std::size_t current_ = 0,
              done_ = 0;     ///< the first bucket that may not be empty, and how many of its entries are done
  std::size_t waiting_ = 0;  ///< entries not done
};

}  // namespace detail

namespace {

/// A corridor holds no vertex over which the path is longer than the shortest one by this factor, however short that
/// is.
constexpr double kLongestDetour = 2.0;
constexpr double kCorridorBase = 1000.0, kCorridorGrowth = 8.0;
/// Vertices of the corridor between two looks at the task.
constexpr std::size_t kWorkBetweenChecks = 1024;

std::size_t default_corridor(std::size_t vertex_count) {
  return static_cast<std::size_t>(kCorridorBase + kCorridorGrowth * std::sqrt(static_cast<double>(vertex_count)));
}

/// A vertex itself; of a point, the corner of its faces that has the most of it.
std::int32_t corner_of(const GeodesicMesh& mesh, const PlacedPoint& point) {
  if (point.vertex >= 0) return point.vertex;
  const auto& [face, weights] = point.faces.front();
  return mesh.half_edge(3 * face + static_cast<std::int32_t>(std::ranges::max_element(weights) - weights.begin())).tail;
}

/// A vertex itself; of a point, the corners of its faces.
std::vector<std::int32_t> corners_of(const GeodesicMesh& mesh, const PlacedPoint& point) {
  std::vector<std::int32_t> corners;
  if (point.vertex >= 0) corners.push_back(point.vertex);
  for (const PlacedPoint::InFace& in : point.faces) {
    for (std::int32_t h = 3 * in.face; h < 3 * in.face + 3; ++h) corners.push_back(mesh.half_edge(h).tail);
  }
  std::ranges::sort(corners);
  drop_repeats(corners);
  return corners;
}

/// The longest edge of its faces, 0 for a vertex.
double longest_edge(const GeodesicMesh& mesh, const PlacedPoint& point) {
  double longest = 0.0;
  for (const PlacedPoint::InFace& in : point.faces) {
    for (std::int32_t h = 3 * in.face; h < 3 * in.face + 3; ++h) longest = std::max(longest, mesh.half_edge(h).length);
  }
  return longest;
}

}  // namespace

struct CorridorPaths::Impl {
  Impl(std::shared_ptr<const GeodesicMesh> on, const SurfacePoint& from, const CorridorPathOptions& with)
      : mesh(std::move(on)),
        seed(PlacedPoint::of(*mesh, from, "seed")),
        seed_corner(corner_of(*mesh, seed)),
        options(with),
        corridor_vertices(with.corridor_vertices > 0 ? with.corridor_vertices : default_corridor(mesh->vertex_count())),
        from_seed(*mesh, seed_corner),
        to_target(mesh->vertex_count()),
        queue(mesh->vertex_count()),
        cutter(*mesh) {}

  void find_corridor(const PlacedPoint& to, const Task& task);

  /// The length of a way along hops, if it is known.
  struct Way {
    float length;
    bool is_known;
  };

  std::shared_ptr<const GeodesicMesh> mesh;
  PlacedPoint seed;
  std::int32_t seed_corner;
  CorridorPathOptions options;
  std::size_t corridor_vertices;
  DeltaStepping from_seed;
  ZeroedArray<Way> to_target;          ///< known of `touched` only
  IndexedHeap queue;                   ///< by the length of the path over a vertex
  std::vector<std::int32_t> touched;   ///< looked at for the current target
  std::vector<std::int32_t> corridor;  ///< its vertices
  SubmeshCutter cutter;
};

/// Until the seed is in the corridor and it is as large as it may be.
void CorridorPaths::Impl::find_corridor(const PlacedPoint& to, const Task& task) {
  const std::int32_t target = corner_of(*mesh, to);
  for (const std::int32_t v : touched) to_target[v] = {};
  touched.clear();
  corridor.clear();
  queue.clear();

  // Distances beyond the target may not be known yet. The rest of the path is then at least as long.
  const float reach = from_seed.at(target);
  const auto length_over = [&](std::int32_t v) {
    return static_cast<double>(to_target[v].length) + static_cast<double>(std::min(from_seed.at(v), reach));
  };
  const auto relax = [&](std::int32_t v, float distance) {
    Way& known = to_target[v];
    if (known.is_known && !(distance < known.length)) return;
    if (!known.is_known) touched.push_back(v);
    known = {distance, true};
    queue.lower(v, length_over(v));
  };

  const double around_ends = std::max(longest_edge(*mesh, seed), longest_edge(*mesh, to));
  const double longest = kLongestDetour * (static_cast<double>(reach) + around_ends);
  bool has_source = false;
  relax(target, 0.0F);
  while (!queue.empty()) {
    const double length = queue.least_key();
    const std::int32_t v = queue.pop();
    if (has_source && (corridor.size() >= corridor_vertices || length > longest)) break;
    corridor.push_back(v);
    if (corridor.size() % kWorkBetweenChecks == 0) task.check(0.0);
    has_source = has_source || v == seed_corner;
    mesh->for_each_hop(v, [&](std::int32_t head, float hop) { relax(head, to_target[v].length + hop); });
  }
  for (const PlacedPoint* end : std::array<const PlacedPoint*, 2>{&seed, &to}) {
    for (const PlacedPoint::InFace& in : end->faces) corridor.push_back(mesh->half_edge(3 * in.face).tail);
  }
}

CorridorPaths::CorridorPaths(const ExactGeodesics& geodesics, const SurfacePoint& seed,
                             const CorridorPathOptions& options)
    : impl_(std::make_unique<Impl>(geodesics.mesh_, seed, options)) {}

CorridorPaths::~CorridorPaths() = default;
CorridorPaths::CorridorPaths(CorridorPaths&&) noexcept = default;
CorridorPaths& CorridorPaths::operator=(CorridorPaths&&) noexcept = default;

std::int32_t CorridorPaths::seed() const {
  return impl_->seed.vertex < 0 ? -1 : impl_->mesh->external_vertex(impl_->seed.vertex);
}

std::optional<IntrinsicPath> CorridorPaths::path(const SurfacePoint& target, const Task& task) {
  const GeodesicMesh& mesh = *impl_->mesh;
  const PlacedPoint end = PlacedPoint::of(mesh, target, "target");
  task.check(0.0);
  const std::int32_t corner = corner_of(mesh, end);
  impl_->from_seed.reach(corner, task);
  if (std::isinf(impl_->from_seed.at(corner))) return std::nullopt;
  impl_->find_corridor(end, task);

  const Submesh part = impl_->cutter.cut(impl_->corridor);
  const Task part_task = part_of(task, 0.0, 0.0);  // what is done of the part says little of the whole
  const bool is_exact = impl_->options.windows == 0;
  const SourcePoints sources({to_part(impl_->cutter, impl_->seed)});
  const WavefrontResult result =
      propagate_wavefront(*part.mesh, sources, {.windows_kept = impl_->options.windows}, part_task);
  const SolvedDistances solved{*part.mesh, result.distances, sources};
  const PlacedPoint in_part = to_part(impl_->cutter, end);
  IntrinsicPath path;
  if (is_exact) {
    path = trace_records(solved, result.records, result.crossings, in_part, part_task);
    to_whole_mesh(part, path);
  } else {
    for (const std::int32_t v : corners_of(*part.mesh, in_part)) {
      IntrinsicPath traced =
          trace_records(solved, result.records, result.crossings, PlacedPoint::at_vertex(v), part_task);
      to_whole_mesh(part, traced);
      path.points.insert(path.points.end(), traced.points.begin(), traced.points.end());
    }
    path = shorten(mesh, impl_->cutter, path, impl_->seed, end, part_task);
  }
  if (path.points.empty()) return std::nullopt;
  to_external(mesh, path);
  return path;
}

}  // namespace seamwire
