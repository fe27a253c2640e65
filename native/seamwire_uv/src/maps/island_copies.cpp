// SPDX-License-Identifier: GPL-3.0-or-later
#include "seamwire_uv/maps/unwrap_mesh.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <optional>
#include <set>
#include <utility>

#include "detail/index.hpp"
#include "maps/straight_corners.hpp"

namespace seamwire {

using namespace detail;

namespace {

using Numbers = std::vector<std::int32_t>;

/// Lengths of copies differ by at most this part of the longest edge: coordinates are rounded.
constexpr double kSameLength = 1e-4;

/// The corners of an island's polygons and the lengths between them. They decide how it is flattened.
struct IslandShape {
  Numbers corners;                     // of the mesh, ascending; each stands for the edge to the next corner
  Numbers following;                   // the next edge of the polygon
  Numbers mates;                       // the edge of the neighbor that runs the other way, -1 at the island's border
  Numbers begins;                      // the corner at which each edge begins: itself, unless the shape is mirrored
  std::vector<double> lengths, spans;  // of the edge, and between the corners before and after its beginning
  double whole = 0.0, tolerance = 0.0;

  std::size_t size() const { return corners.size(); }

  /// The mirror image: each edge has its number, and runs the other way.
  IslandShape mirrored() const {
    IslandShape image = *this;
    for (std::int32_t i = 0; index(i) < size(); ++i) {
      image.following[following[i]] = i;
      image.begins[i] = following[i];
      image.spans[i] = spans[following[i]];
    }
    return image;
  }
  /// Whether an edge looks like one of another shape.
  bool agrees(std::int32_t edge, const IslandShape& other, std::int32_t another) const {
    return std::abs(lengths[edge] - other.lengths[another]) <= tolerance &&
           std::abs(spans[edge] - other.spans[another]) <= tolerance && (mates[edge] < 0) == (other.mates[another] < 0);
  }
};

/// The corners' edges to the next ones, seen from the neighbors in the same islands; -1 at seams and borders.
Numbers mates_of(const UnwrapMesh& mesh) {
  Numbers mates(mesh.vertices.size(), -1);
  for (const auto& [one, two] : mesh.joints) {
    if (mesh.seams[mesh.edges[one]] != 0 || mesh.island(one) != mesh.island(two)) continue;
    if (mesh.vertices[one] != mesh.vertices[mesh.following[two]]) continue;
    mates[one] = two;
    mates[two] = one;
  }
  return mates;
}

std::vector<IslandShape> shapes_of(const UnwrapMesh& mesh) {
  const Numbers mates = mates_of(mesh);
  std::vector<IslandShape> shapes(mesh.island_count);
  Numbers own(mesh.vertices.size(), -1);
  for (std::int32_t c = 0; index(c) < mesh.vertices.size(); ++c) {
    if (mesh.island(c) < 0) continue;
    IslandShape& shape = shapes[mesh.island(c)];
    own[c] = static_cast<std::int32_t>(shape.size());
    shape.corners.push_back(c);
    shape.begins.push_back(own[c]);
    shape.lengths.push_back((point_of(mesh, mesh.following[c]) - point_of(mesh, c)).norm());
    shape.spans.push_back((point_of(mesh, mesh.following[c]) - point_of(mesh, mesh.preceding[c])).norm());
  }
  for (IslandShape& shape : shapes) {
    for (const std::int32_t c : shape.corners) {
      shape.following.push_back(own[mesh.following[c]]);
      shape.mates.push_back(mates[c] < 0 ? -1 : own[mates[c]]);
    }
    if (shape.size() == 0) continue;
    shape.whole = std::accumulate(shape.lengths.begin(), shape.lengths.end(), 0.0);
    shape.tolerance = kSameLength * std::ranges::max(shape.lengths);
  }
  return shapes;
}

/// Walks from one pair of edges to all others. nullopt if two edges differ, or some are not reached.
std::optional<Numbers> spread(const IslandShape& shape, const IslandShape& image, std::int32_t start,
                              std::int32_t place) {
  Numbers edges(shape.size(), -1), waiting{start};
  edges[start] = place;
  for (std::size_t i = 0; i < waiting.size(); ++i) {
    const std::int32_t edge = waiting[i];
    for (const auto& [there, target] : {std::pair(shape.following[edge], image.following[edges[edge]]),
                                        std::pair(shape.mates[edge], image.mates[edges[edge]])}) {
      if (there < 0) continue;
      if (target < 0 || !shape.agrees(there, image, target)) return std::nullopt;
      if (edges[there] >= 0 && edges[there] != target) return std::nullopt;
      if (edges[there] < 0) waiting.push_back(there);
      edges[there] = target;
    }
  }
  if (waiting.size() < shape.size()) return std::nullopt;
  Numbers sorted = edges;
  std::ranges::sort(sorted);
  if (std::ranges::adjacent_find(sorted) != sorted.end()) return std::nullopt;
  return edges;
}

/// The edge with the fewest others of its length in an image.
std::int32_t rarest_edge(const IslandShape& shape, const IslandShape& image) {
  std::vector<double> sorted = image.lengths;
  std::ranges::sort(sorted);
  std::int32_t rarest = 0;
  std::ptrdiff_t least = -1;
  for (std::int32_t i = 0; index(i) < shape.size(); ++i) {
    const std::ptrdiff_t count = std::ranges::upper_bound(sorted, shape.lengths[i] + shape.tolerance) -
                                 std::ranges::lower_bound(sorted, shape.lengths[i] - shape.tolerance);
    if (least >= 0 && count >= least) continue;
    rarest = i;
    least = count;
  }
  return rarest;
}

/// The corner of another island that corresponds to each corner. nullopt if the two are no copies of each other.
std::optional<Numbers> corresponding(const IslandShape& shape, const IslandShape& first) {
  const auto agrees_with_itself = [&] {
    for (std::int32_t i = 0; index(i) < shape.size(); ++i) {
      if (!shape.agrees(i, first, i)) return false;
    }
    return true;
  };
  if (shape.following == first.following && shape.mates == first.mates && agrees_with_itself()) return first.begins;
  for (const IslandShape& image : {first, first.mirrored()}) {
    const std::int32_t start = rarest_edge(shape, image);
    Numbers places(shape.size());
    std::iota(places.begin(), places.end(), 0);
    std::rotate(places.begin(), places.begin() + start, places.begin() + start + 1);  // its own number first
    for (const std::int32_t place : places) {
      if (!shape.agrees(start, image, place)) continue;
      const std::optional<Numbers> edges = spread(shape, image, start, place);
      if (!edges) continue;
      Numbers corners;
      for (const std::int32_t edge : *edges) corners.push_back(image.begins[edge]);
      return corners;
    }
  }
  return std::nullopt;
}

}  // namespace

std::vector<IslandCopy> island_copies(std::span<const MappedMesh> meshes) {
  struct First {
    std::size_t mesh;
    IslandShape shape;
  };
  std::vector<First> firsts;
  // By the number of corners: the length of all edges, and the number of the first island with this shape.
  std::map<std::size_t, std::set<std::pair<double, std::size_t>>> alike;
  std::vector<IslandCopy> copies;
  for (std::size_t m = 0; m < meshes.size(); ++m) {
    check_islands(*meshes[m].mesh, meshes[m].is_chosen);
    std::vector<IslandShape> shapes = shapes_of(*meshes[m].mesh);
    for (std::int32_t i = 0; index(i) < shapes.size(); ++i) {
      IslandShape& shape = shapes[i];
      if (meshes[m].is_chosen[i] == 0 || shape.size() == 0) continue;
      auto& known = alike[shape.size()];
      const double reach = shape.tolerance * static_cast<double>(shape.size());
      std::set<std::size_t> candidates;
      for (auto at = known.lower_bound({shape.whole - reach, 0}); at != known.end() && at->first <= shape.whole + reach;
           ++at) {
        candidates.insert(at->second);
      }
      std::optional<Numbers> found;
      for (const std::size_t number : candidates) {
        found = corresponding(shape, firsts[number].shape);
        if (!found) continue;
        for (std::int32_t& corner : *found) corner = firsts[number].shape.corners[corner];
        copies.push_back({m, i, firsts[number].mesh, std::move(shape.corners), std::move(*found)});
        break;
      }
      if (found) continue;
      known.insert({shape.whole, firsts.size()});
      firsts.push_back({m, std::move(shape)});
    }
  }
  return copies;
}

}  // namespace seamwire
