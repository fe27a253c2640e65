// SPDX-License-Identifier: GPL-3.0-or-later
#include "seamwire_uv/maps/unwrap_mesh.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "detail/index.hpp"
#include "graph/disjoint_sets.hpp"
#include "maps/straight_corners.hpp"
#include "seamwire/errors.hpp"

namespace seamwire {

using namespace detail;

namespace {

using Eigen::Vector2d;
using Flags = std::vector<std::uint8_t>;

/// UVs nearer than this are one place: unwrapping gives corners that belong together the same numbers, packing rounds
/// them.
constexpr double kOnePlace = 1e-5;
/// A face with less area, as a part of its squared length, lies on a line.
constexpr double kThin = 1e-6;
/// The part of an island's faces that must be turned over for the island to count as folded.
constexpr double kFolded = 0.25;

/// One of the mesh's joints in a map.
struct Joint {
  std::int32_t one, two;
  bool is_torn;
};

std::vector<Joint> joints_in(const UnwrapMesh& mesh, const std::vector<Vector2d>& uvs) {
  const auto is_apart = [&](std::int32_t a, std::int32_t b) {
    const Vector2d gap = uvs[a] - uvs[b];
    return !(std::abs(gap.x()) <= kOnePlace && std::abs(gap.y()) <= kOnePlace);
  };
  std::vector<Joint> joints;
  for (const auto& [one, two] : mesh.joints) {
    // Neighbors go along their edge in opposite ways, unless one is flipped.
    std::int32_t begin = two, end = mesh.following[two];
    if (mesh.vertices[one] == mesh.vertices[end]) std::swap(begin, end);
    joints.push_back({one, two, is_apart(one, begin) || is_apart(mesh.following[one], end)});
  }
  return joints;
}

/// How polygons lie in a map.
struct Lie {
  Flags is_flat;           // whether a polygon with an area on the model has none in the map
  std::vector<int> turns;  // 1 against the clock, -1 with it, 0 if it lies on a line or has no triangles
};

Lie lie_of(const UnwrapMesh& mesh, const std::vector<Vector2d>& uvs) {
  const std::size_t count = mesh.sizes.size();
  std::vector<double> in_map(count, 0.0), on_model(count, 0.0);
  for (const Triangle& t : mesh.triangles) {
    in_map[mesh.polygons[t[0]]] += 0.5 * doubled_area(uvs_of(t, uvs));
    on_model[mesh.polygons[t[0]]] += 0.5 * doubled_area(mesh, t);
  }
  Lie lie{.is_flat = Flags(count, 0), .turns = std::vector<int>(count, 0)};
  std::int32_t c = 0;
  for (std::size_t p = 0; p < count; ++p) {
    Eigen::AlignedBox2d map_box;
    Eigen::AlignedBox3d model_box;
    bool is_finite = true;
    for (std::int32_t i = 0; i < mesh.sizes[p]; ++i, ++c) {
      is_finite = is_finite && uvs[c].allFinite();
      map_box.extend(uvs[c]);
      model_box.extend(point_of(mesh, c));
    }
    const bool has_area = is_finite && std::abs(in_map[p]) > kThin * map_box.sizes().squaredNorm();
    if (has_area) lie.turns[p] = in_map[p] > 0.0 ? 1 : -1;
    if (!has_area && on_model[p] > kThin * model_box.sizes().squaredNorm()) lie.is_flat[p] = 1;
  }
  return lie;
}

/// For each polygon 1 or -1, such that polygons at a joint go around in one way after multiplying.
std::vector<int> one_way_around(const UnwrapMesh& mesh, const std::vector<Joint>& joints) {
  const std::size_t count = mesh.sizes.size();
  std::vector<std::vector<std::pair<std::int32_t, int>>> beside(count);
  for (const Joint& joint : joints) {
    const int sign = mesh.vertices[joint.one] == mesh.vertices[mesh.following[joint.two]] ? 1 : -1;
    const std::int32_t one = mesh.polygons[joint.one], two = mesh.polygons[joint.two];
    beside[one].emplace_back(two, sign);
    beside[two].emplace_back(one, sign);
  }
  std::vector<int> signs(count, 0);
  std::vector<std::int32_t> waiting;
  for (std::int32_t start = 0; index(start) < count; ++start) {
    if (signs[start] != 0) continue;
    signs[start] = 1;
    waiting.push_back(start);
    while (!waiting.empty()) {
      const std::int32_t polygon = waiting.back();
      waiting.pop_back();
      for (const auto& [other, sign] : beside[polygon]) {
        if (signs[other] != 0) continue;
        signs[other] = sign * signs[polygon];
        waiting.push_back(other);
      }
    }
  }
  return signs;
}

class ChangeFinder {
 public:
  ChangeFinder(const UnwrapMesh& mesh, const std::vector<Vector2d>& uvs, const std::vector<EdgeMemory>& memory)
      : mesh_(mesh), uvs_(uvs), memory_(memory), joints_(joints_in(mesh, uvs)), is_changed_(mesh.island_count, 0) {}

  IslandChanges find(const Task& task) {
    std::vector<double> densities = compare_areas();
    Flags is_known(is_changed_.size(), 0), is_new(is_changed_.size(), 0);
    bool any_known = false;
    for (const Joint& joint : joints_) {
      const EdgeMemory memory = memory_[edge(joint)];
      const bool is_seam = mesh_.seams[edge(joint)] != 0;
      const bool agrees = memory == (is_seam ? EdgeMemory::kSeam : EdgeMemory::kPlain);
      const bool is_odd = (joint.is_torn != is_seam && !agrees) || memory == EdgeMemory::kJoined;
      const bool known = memory == EdgeMemory::kSeam || memory == EdgeMemory::kPlain;
      any_known = any_known || known;
      for (const std::int32_t c : {joint.one, joint.two}) {
        if (is_odd) is_changed_[mesh_.island(c)] = 1;
        (known ? is_known : is_new)[mesh_.island(c)] = 1;
      }
    }
    find_bad_faces(is_known);
    if (any_known) find_overlapping(is_new, task);
    return {.changed = is_changed_, .densities = std::move(densities)};
  }

 private:
  std::int32_t edge(const Joint& joint) const { return mesh_.edges[joint.one]; }

  /// Islands without an area in the map have changed. Returns the densities.
  std::vector<double> compare_areas() {
    const std::size_t count = is_changed_.size();
    std::vector<double> in_map(count, 0.0), on_model(count, 0.0), map_sums(count, 0.0), model_sums(count, 0.0);
    for (const Triangle& t : mesh_.triangles) {
      const std::int32_t island = mesh_.island(t[0]);
      if (island < 0) continue;
      in_map[island] += std::abs(doubled_area(uvs_of(t, uvs_)));
      on_model[island] += doubled_area(mesh_, t);
    }
    DisjointSets families(count);
    for (const Joint& joint : joints_) {
      if (!joint.is_torn) families.join(mesh_.island(joint.one), mesh_.island(joint.two));
    }
    for (std::int32_t i = 0; index(i) < count; ++i) {
      map_sums[families.find(i)] += in_map[i];
      model_sums[families.find(i)] += on_model[i];
      // An island without area on the model cannot have one in the map.
      if (in_map[i] <= 0.0 && on_model[i] > 0.0) is_changed_[i] = 1;
    }
    std::vector<double> densities(count, 0.0);
    for (std::int32_t i = 0; index(i) < count; ++i) {
      const double map = map_sums[families.find(i)], model = model_sums[families.find(i)];
      if (map > 0.0 && model > 0.0) densities[i] = std::sqrt(map / model);
    }
    return densities;
  }

  /// Finds islands with polygons that no map of them would have: without area, or turned over.
  void find_bad_faces(const Flags& is_known) {
    Lie lie = lie_of(mesh_, uvs_);
    std::vector<Joint> whole;
    for (const Joint& joint : joints_) {
      if (!joint.is_torn && mesh_.seams[edge(joint)] == 0) whole.push_back(joint);
    }
    const std::vector<int> signs = one_way_around(mesh_, whole);
    const std::size_t count = is_changed_.size();
    std::vector<double> sizes(count, 0.0), clockwise(count, 0.0);
    for (std::size_t p = 0; p < signs.size(); ++p) {
      lie.turns[p] *= signs[p];
      const std::int32_t island = mesh_.islands[p];
      if (island < 0) continue;
      if (lie.is_flat[p] != 0) is_changed_[island] = 1;
      if (lie.turns[p] != 0) sizes[island] += 1.0;
      if (lie.turns[p] < 0) clockwise[island] += 1.0;
    }
    for (const Joint& joint : whole) {
      if (lie.turns[mesh_.polygons[joint.one]] * lie.turns[mesh_.polygons[joint.two]] >= 0) continue;
      const std::int32_t island = mesh_.island(joint.one);
      const bool are_few = std::min(clockwise[island], sizes[island] - clockwise[island]) < kFolded * sizes[island];
      if (is_known[island] != 0 || are_few) is_changed_[island] = 1;
    }
  }

  void find_overlapping(const Flags& is_new, const Task& task) {
    if (std::ranges::count(is_new, 1) == 0) return;
    for (const std::int32_t island : overlapping_islands(mesh_, uvs_, task)) {
      if (is_new[island] != 0) is_changed_[island] = 1;
    }
  }

  const UnwrapMesh& mesh_;
  const std::vector<Vector2d>& uvs_;
  const std::vector<EdgeMemory>& memory_;
  std::vector<Joint> joints_;
  Flags is_changed_;
};

}  // namespace

IslandChanges changed_islands(const UnwrapMesh& mesh, const std::vector<Vector2d>& uvs,
                              const std::vector<EdgeMemory>& memory, const Task& task) {
  check_corners(mesh, uvs);
  if (memory.size() != mesh.seams.size()) {
    throw InvalidInput("memory has " + std::to_string(memory.size()) + " items: there are " +
                       std::to_string(mesh.seams.size()) + " edges");
  }
  return ChangeFinder(mesh, uvs, memory).find(task);
}

std::size_t count_unmapped(const UnwrapMesh& mesh, const std::vector<Vector2d>& uvs) {
  check_corners(mesh, uvs);
  const Lie lie = lie_of(mesh, uvs);
  std::size_t count = 0;
  for (std::size_t p = 0; p < lie.is_flat.size(); ++p) {
    if (lie.is_flat[p] != 0 && mesh.islands[p] < 0) ++count;
  }
  return count;
}

}  // namespace seamwire
