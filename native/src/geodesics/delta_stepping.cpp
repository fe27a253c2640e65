// SPDX-License-Identifier: GPL-3.0-or-later
#include "geodesics/delta_stepping.hpp"

#include <algorithm>

namespace seamwire {
namespace {

std::size_t index(std::int32_t i) { return static_cast<std::size_t>(i); }

/// Of the ring; where the longest edge is longer than that many mean ones, buckets are wider.
constexpr std::size_t kMostBuckets = 4096;
/// Entries of a bucket that memory is asked for in advance.
constexpr std::size_t kAhead = 8;
/// Vertices between two looks at the task: some 0.1 ms.
constexpr std::size_t kWorkBetweenChecks = 2048;

}  // namespace

EdgeDistances::EdgeDistances(const GeodesicMesh& mesh, std::int32_t seed) : mesh_(mesh), reached_(mesh.vertex_count()) {
  const float longest = mesh.longest_step();
  width_ = std::max(mesh.mean_step(), longest / static_cast<float>(kMostBuckets - 2));
  if (!(width_ > 0)) width_ = 1.0F;
  per_width_ = 1.0F / width_;
  buckets_.resize(static_cast<std::size_t>(longest * per_width_) + 3);
  lower(seed, 0.0F, -1);
}

void EdgeDistances::lower(std::int32_t vertex, float distance, std::int32_t from) {
  Reached& known = reached_[index(vertex)];
  if (!(distance < known.distance)) return;
  known = {distance, from};
  bucket(std::max(bucket_of(distance), current_)).push_back({distance, vertex});
  ++waiting_;
}

void EdgeDistances::prefetch(std::int32_t vertex) const {
#if defined(__GNUC__)
  __builtin_prefetch(&reached_[index(vertex)]);
  __builtin_prefetch(mesh_.steps(vertex).data());
#else
  static_cast<void>(vertex);
#endif
}

void EdgeDistances::reach(std::int32_t vertex, const Task& task) {
  std::size_t work = 0;
  while (waiting_ > 0 && !(at(vertex) < radius())) {
    std::vector<Entry>& entries = bucket(current_);
    // The bucket may grow while it is read.
    while (done_ < entries.size()) {
      if (done_ + kAhead < entries.size()) prefetch(entries[done_ + kAhead].vertex);
      const Entry entry = entries[done_++];
      --waiting_;
      if (entry.distance > at(entry.vertex)) continue;
      for (const auto& [to, length] : mesh_.steps(entry.vertex)) {
        lower(to, entry.distance + length, entry.vertex);
      }
      if (++work % kWorkBetweenChecks == 0) task.check(0.0);
    }
    entries.clear();
    done_ = 0;
    ++current_;
  }
}

IntrinsicPath EdgeDistances::chain(std::int32_t vertex) const {
  IntrinsicPath path;
  for (std::int32_t v = vertex; v >= 0; v = reached_[index(v)].from) path.points.push_back({.vertex = v});
  std::reverse(path.points.begin(), path.points.end());
  return path;
}

}  // namespace seamwire
