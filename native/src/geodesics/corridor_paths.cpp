// SPDX-License-Identifier: GPL-3.0-or-later
//
// A path at once, in three steps:
// 1. distances d from the seed along edges, as far as the target;
// 2. from the target back, the vertices v of the corridor, those of the least d(v) + (distance along edges to the
//    target): Hart, Nilsson, Raphael, "A Formal Basis for the Heuristic Determination of Minimum Cost Paths" (A*,
//    1968), whose estimate is exact here, so that no vertex is looked at but those of the corridor and their
//    neighbours;
// 3. the exact wavefront over the triangles at those vertices, as a mesh of their own.
#include "seamwire/geodesics/corridor_paths.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "geodesics/delta_stepping.hpp"
#include "geodesics/geodesic_mesh.hpp"
#include "geodesics/path_tracing.hpp"
#include "geodesics/wavefront.hpp"

namespace seamwire {
namespace {

std::size_t index(std::int32_t i) { return static_cast<std::size_t>(i); }

/// A corridor holds no vertex over which the way is longer than the shortest by this factor, however short that is.
constexpr double kLongestDetour = 2.0;
constexpr double kCorridorBase = 1000.0, kCorridorGrowth = 8.0;
/// Vertices of the corridor between two looks at the task.
constexpr std::size_t kWorkBetweenChecks = 1024;

std::size_t default_corridor(std::size_t vertex_count) {
  return static_cast<std::size_t>(kCorridorBase + kCorridorGrowth * std::sqrt(static_cast<double>(vertex_count)));
}

void check_vertex(std::int32_t vertex, std::size_t count, const char* what) {
  if (vertex >= 0 && index(vertex) < count) return;
  throw InvalidInput(std::string(what) + " " + std::to_string(vertex) + " is out of range, there are " +
                     std::to_string(count) + " vertices");
}

}  // namespace

struct QuickPaths::Impl {
  Impl(std::shared_ptr<const GeodesicMesh> on, std::int32_t from, const QuickPathOptions& with)
      : mesh(std::move(on)),
        seed(from),
        options(with),
        corridor_vertices(with.corridor_vertices > 0 ? with.corridor_vertices : default_corridor(mesh->vertex_count())),
        from_seed(*mesh, mesh->own_vertex(from)),
        to_target(mesh->vertex_count(), kUnknown),
        cutter(*mesh) {}

  void find_corridor(std::int32_t target, const Task& task);

  static constexpr float kUnknown = std::numeric_limits<float>::infinity();

  std::shared_ptr<const GeodesicMesh> mesh;
  std::int32_t seed;  ///< the caller's number; all others are the mesh's own
  QuickPathOptions options;
  std::size_t corridor_vertices;
  EdgeDistances from_seed;
  std::vector<float> to_target;        ///< along edges; known of `touched` only
  std::vector<std::int32_t> touched;   ///< looked at for the current target
  std::vector<std::int32_t> corridor;  ///< its vertices
  MeshCutter cutter;
};

/// Until the seed is in the corridor and it is as large as it may be.
void QuickPaths::Impl::find_corridor(std::int32_t target, const Task& task) {
  for (const std::int32_t v : touched) to_target[index(v)] = kUnknown;
  touched.clear();
  corridor.clear();

  // What is farther from the seed than the target may not be known yet; then the way back is at least as long.
  const float reach = from_seed.at(target);
  const auto way_over = [&](std::int32_t v) {
    return static_cast<double>(to_target[index(v)]) + static_cast<double>(std::min(from_seed.at(v), reach));
  };
  using Entry = std::pair<double, std::int32_t>;
  std::vector<Entry> heap;
  const auto later = [](const Entry& a, const Entry& b) { return a > b; };
  const auto lower = [&](std::int32_t v, float distance) {
    float& known = to_target[index(v)];
    if (!(distance < known)) return;
    if (known == kUnknown) touched.push_back(v);
    known = distance;
    heap.emplace_back(way_over(v), v);
    std::push_heap(heap.begin(), heap.end(), later);
  };

  const std::int32_t source = mesh->own_vertex(seed);
  const double longest = kLongestDetour * static_cast<double>(reach);
  bool has_source = false;
  lower(target, 0.0F);
  while (!heap.empty()) {
    const auto [way, v] = heap.front();
    std::pop_heap(heap.begin(), heap.end(), later);
    heap.pop_back();
    if (has_source && (corridor.size() >= corridor_vertices || way > longest)) break;
    if (way > way_over(v)) continue;
    corridor.push_back(v);
    if (corridor.size() % kWorkBetweenChecks == 0) task.check(0.0);
    has_source = has_source || v == source;
    for (const auto& [to, length] : mesh->steps(v)) lower(to, to_target[index(v)] + length);
  }
}

QuickPaths::QuickPaths(const ExactGeodesics& geodesics, std::int32_t seed, const QuickPathOptions& options) {
  check_vertex(seed, geodesics.mesh()->vertex_count(), "seed");
  impl_ = std::make_unique<Impl>(geodesics.mesh(), seed, options);
}

QuickPaths::~QuickPaths() = default;
QuickPaths::QuickPaths(QuickPaths&&) noexcept = default;
QuickPaths& QuickPaths::operator=(QuickPaths&&) noexcept = default;

std::int32_t QuickPaths::seed() const { return impl_->seed; }

IntrinsicPath QuickPaths::path(std::int32_t target, const Task& task) {
  const GeodesicMesh& mesh = *impl_->mesh;
  check_vertex(target, mesh.vertex_count(), "target");
  task.check(0.0);
  const std::int32_t own_target = mesh.own_vertex(target);
  impl_->from_seed.reach(own_target, task);
  if (std::isinf(impl_->from_seed.at(own_target))) return {};
  impl_->find_corridor(own_target, task);

  const std::int32_t own_seed = mesh.own_vertex(impl_->seed);
  const MeshPart part = impl_->cutter.cut(impl_->corridor);
  const std::int32_t part_seed = impl_->cutter.part_vertex(own_seed);
  const std::int32_t part_target = impl_->cutter.part_vertex(own_target);
  const Task silent{.stop = task.stop, .progress = {}};
  const WavefrontResult result = propagate_wavefront(*part.mesh, part_seed, silent, impl_->options.windows);
  std::optional<IntrinsicPath> path = trace_records(*part.mesh, result.distances, result.records, part_target);
  if (path) number_as_whole(part, *path);
  if (!path || impl_->options.windows > 0) {
    path = shorten(mesh, impl_->cutter, path ? *path : impl_->from_seed.chain(own_target), silent);
  }
  number_as_caller(mesh, *path);
  return std::move(*path);
}

}  // namespace seamwire
