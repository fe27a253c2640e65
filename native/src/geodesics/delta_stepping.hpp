// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "geodesics/geodesic_mesh.hpp"
#include "seamwire/geodesics/distance_field.hpp"
#include "seamwire/task.hpp"

namespace seamwire::detail {

/// Distances along hops (GeodesicMesh::hops) from a seed, computed outwards as far as they are asked for.
/// Delta-stepping keeps buckets of distances instead of a heap. The vertices of a bucket are settled in any order, and
/// again if necessary (Meyer, Sanders, "Delta-stepping: a parallelizable shortest path algorithm", 2003). Single
/// precision is enough, because distances only tell where to look for a path.
class DeltaStepping {
 public:
  DeltaStepping(const GeodesicMesh& mesh, std::int32_t seed);

  /// Goes on until the distance of `vertex` is final, or nothing is left to be reached.
  void reach(std::int32_t vertex, const Task& task);

  /// Final where it is below radius(), else an upper bound; infinite where nothing led yet.
  float at(std::int32_t vertex) const { return reached_[vertex].distance; }
  /// A shortest chain of hops from the seed to a vertex whose distance is final. Of the path only the points are set, a
  /// vertex each.
  IntrinsicPath chain(std::int32_t vertex) const;
  float radius() const { return static_cast<float>(current_) * width_; }

 private:
  struct Reached {
    float distance = std::numeric_limits<float>::infinity();
    std::int32_t from = -1;
  };
  struct Entry {
    float distance;
    std::int32_t vertex;
  };

  std::vector<Entry>& bucket(std::size_t number) { return buckets_[number % buckets_.size()]; }
  std::size_t bucket_of(float distance) const { return static_cast<std::size_t>(distance * per_width_); }
  void relax(std::int32_t vertex, float distance, std::int32_t from);
  void prefetch_vertex(std::int32_t vertex) const;

  const GeodesicMesh& mesh_;
  std::vector<Reached> reached_;
  std::vector<std::vector<Entry>> buckets_;  ///< a ring: no hop is longer than all but one of them
  float width_ = 1.0F, per_width_ = 1.0F;
  std::size_t current_ = 0,
              done_ = 0;     ///< the first bucket that may not be empty, and how many of its entries are done
  std::size_t waiting_ = 0;  ///< entries not done
};

}  // namespace seamwire::detail
