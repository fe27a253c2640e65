// SPDX-License-Identifier: GPL-3.0-or-later
#include "geodesics/delta_stepping.hpp"

#include <algorithm>

#include "detail/prefetch.hpp"

namespace seamwire::detail {
namespace {

/// Of the ring; where the longest edge is longer than that many mean ones, buckets are wider.
constexpr std::size_t kMostBuckets = 4096;
/// Entries of a bucket that memory is asked for in advance.
constexpr std::size_t kAhead = 8;
/// Vertices between two looks at the task: some 0.1 ms.
constexpr std::size_t kWorkBetweenChecks = 2048;

}  // namespace

DeltaStepping::DeltaStepping(const GeodesicMesh& mesh, std::int32_t seed) : mesh_(mesh), reached_(mesh.vertex_count()) {
  const float longest = mesh.longest_hop();
  width_ = std::max(mesh.mean_hop(), longest / static_cast<float>(kMostBuckets - 2));
  if (!(width_ > 0)) width_ = 1.0F;
  per_width_ = 1.0F / width_;
  buckets_.resize(static_cast<std::size_t>(longest * per_width_) + 3);
  relax(seed, 0.0F, -1);
}

void DeltaStepping::relax(std::int32_t vertex, float distance, std::int32_t from) {
  Reached& known = reached_[vertex];
  if (!(distance < known.distance)) return;
  known = {distance, from};
  bucket(std::max(bucket_of(distance), current_)).push_back({distance, vertex});
  ++waiting_;
}

void DeltaStepping::prefetch_vertex(std::int32_t vertex) const {
  prefetch(&reached_[vertex]);
  prefetch(mesh_.hops(vertex).data());
}

void DeltaStepping::reach(std::int32_t vertex, const Task& task) {
  std::size_t work = 0;
  while (waiting_ > 0 && !(at(vertex) < radius())) {
    std::vector<Entry>& entries = bucket(current_);
    // The bucket may grow while it is read.
    while (done_ < entries.size()) {
      if (done_ + kAhead < entries.size()) prefetch_vertex(entries[done_ + kAhead].vertex);
      const Entry entry = entries[done_++];
      --waiting_;
      if (entry.distance > at(entry.vertex)) continue;
      for (const auto& [to, length] : mesh_.hops(entry.vertex)) {
        relax(to, entry.distance + length, entry.vertex);
      }
      if (++work % kWorkBetweenChecks == 0) task.check(0.0);
    }
    entries.clear();
    done_ = 0;
    ++current_;
  }
}

IntrinsicPath DeltaStepping::chain(std::int32_t vertex) const {
  IntrinsicPath path;
  for (std::int32_t v = vertex; v >= 0; v = reached_[v].from) path.points.push_back({.vertex = v});
  std::reverse(path.points.begin(), path.points.end());
  return path;
}

}  // namespace seamwire::detail
