// SPDX-License-Identifier: GPL-3.0-or-later
//
// A path at once, in three steps:
// 1. distances d from the seed along hops, as far as the target;
// 2. from the target back, the vertices v of the corridor, those of the least d(v) + (distance along hops to the
//    target): Hart, Nilsson, Raphael, "A Formal Basis for the Heuristic Determination of Minimum Cost Paths" (A*,
//    1968), whose estimate is exact here, so that no vertex is looked at but those of the corridor and their
//    neighbors;
// 3. the exact wavefront over the triangles at those vertices, as a mesh of their own.
#include "seamwire/geodesics/corridor_paths.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "detail/index.hpp"
#include "detail/indexed_heap.hpp"
#include "geodesics/delta_stepping.hpp"
#include "geodesics/geodesic_mesh.hpp"
#include "geodesics/path_tracing.hpp"
#include "geodesics/wavefront.hpp"

namespace seamwire {
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

}  // namespace

struct CorridorPaths::Impl {
  Impl(std::shared_ptr<const GeodesicMesh> on, std::int32_t from, const CorridorPathOptions& with)
      : mesh(std::move(on)),
        seed(from),
        options(with),
        corridor_vertices(with.corridor_vertices > 0 ? with.corridor_vertices : default_corridor(mesh->vertex_count())),
        from_seed(*mesh, mesh->internal_vertex(from)),
        to_target(mesh->vertex_count(), kUnknown),
        queue(mesh->vertex_count()),
        cutter(*mesh) {}

  void find_corridor(std::int32_t target, const Task& task);

  static constexpr float kUnknown = std::numeric_limits<float>::infinity();

  std::shared_ptr<const GeodesicMesh> mesh;
  std::int32_t seed;  ///< external; all other numbers are internal
  CorridorPathOptions options;
  std::size_t corridor_vertices;
  DeltaStepping from_seed;
  std::vector<float> to_target;        ///< along hops; known of `touched` only
  IndexedHeap queue;                   ///< by the length of the path over a vertex
  std::vector<std::int32_t> touched;   ///< looked at for the current target
  std::vector<std::int32_t> corridor;  ///< its vertices
  SubmeshCutter cutter;
};

/// Until the seed is in the corridor and it is as large as it may be.
void CorridorPaths::Impl::find_corridor(std::int32_t target, const Task& task) {
  for (const std::int32_t v : touched) to_target[v] = kUnknown;
  touched.clear();
  corridor.clear();
  queue.clear();

  // What is farther from the seed than the target may not be known yet; then the rest of the path is at least as long.
  const float reach = from_seed.at(target);
  const auto length_over = [&](std::int32_t v) {
    return static_cast<double>(to_target[v]) + static_cast<double>(std::min(from_seed.at(v), reach));
  };
  const auto relax = [&](std::int32_t v, float distance) {
    float& known = to_target[v];
    if (!(distance < known)) return;
    if (known == kUnknown) touched.push_back(v);
    known = distance;
    queue.lower(v, length_over(v));
  };

  const std::int32_t source = mesh->internal_vertex(seed);
  const double longest = kLongestDetour * static_cast<double>(reach);
  bool has_source = false;
  relax(target, 0.0F);
  while (!queue.empty()) {
    const double length = queue.least_key();
    const std::int32_t v = queue.pop();
    if (has_source && (corridor.size() >= corridor_vertices || length > longest)) break;
    corridor.push_back(v);
    if (corridor.size() % kWorkBetweenChecks == 0) task.check(0.0);
    has_source = has_source || v == source;
    for (const auto& [to, length] : mesh->hops(v)) relax(to, to_target[v] + length);
  }
}

CorridorPaths::CorridorPaths(const ExactGeodesics& geodesics, std::int32_t seed, const CorridorPathOptions& options) {
  check_index(seed, geodesics.mesh_->vertex_count(), "seed");
  impl_ = std::make_unique<Impl>(geodesics.mesh_, seed, options);
}

CorridorPaths::~CorridorPaths() = default;
CorridorPaths::CorridorPaths(CorridorPaths&&) noexcept = default;
CorridorPaths& CorridorPaths::operator=(CorridorPaths&&) noexcept = default;

std::int32_t CorridorPaths::seed() const { return impl_->seed; }

IntrinsicPath CorridorPaths::path(std::int32_t target, const Task& task) {
  const GeodesicMesh& mesh = *impl_->mesh;
  check_index(target, mesh.vertex_count(), "target");
  task.check(0.0);
  const std::int32_t own_target = mesh.internal_vertex(target);
  impl_->from_seed.reach(own_target, task);
  if (std::isinf(impl_->from_seed.at(own_target))) return {};
  impl_->find_corridor(own_target, task);

  const std::int32_t own_seed = mesh.internal_vertex(impl_->seed);
  const Submesh part = impl_->cutter.cut(impl_->corridor);
  const std::int32_t part_seed = impl_->cutter.part_vertex(own_seed);
  const std::int32_t part_target = impl_->cutter.part_vertex(own_target);
  Task part_task{.stop = task.stop, .progress = {}};  // what is done of the part says little of the whole
  if (task.progress) part_task.progress = [&task](double) { return task.progress(0.0); };
  const WavefrontResult result = propagate_wavefront(*part.mesh, part_seed, part_task, impl_->options.windows);
  const SourcePoints sources({PlacedPoint::at_vertex(part_seed)});
  const SolvedDistances solved{*part.mesh, result.distances, sources};
  std::optional<IntrinsicPath> path = trace_records(solved, result.records, PlacedPoint::at_vertex(part_target));
  if (path) to_whole_mesh(part, *path);
  if (!path || impl_->options.windows > 0) {
    path = shorten(mesh, impl_->cutter, path ? *path : impl_->from_seed.chain(own_target),
                   PlacedPoint::at_vertex(own_target), part_task);
  }
  to_external(mesh, *path);
  return std::move(*path);
}

}  // namespace seamwire
