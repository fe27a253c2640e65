// SPDX-License-Identifier: GPL-3.0-or-later
#include "maps/straight_corners.hpp"

#include <algorithm>
#include <cstddef>
#include <set>
#include <utility>

#include "detail/index.hpp"

namespace seamwire::detail {

namespace {

/// How far a vertex may lie beside the line between its neighbors, as a part of the line.
constexpr double kStraight = 1e-4;
/// The same, if both faces have only the triangle that it makes with these neighbors. Single precision bends short
/// sides so far.
constexpr double kNearlyStraight = 1e-2;

using Flags = std::vector<std::uint8_t>;

/// Whether a place lies on the line between two others, up to a part of its length.
bool is_between(const Vector& before, const Vector& place, const Vector& after, double tolerance) {
  const Vector along = after - before;
  return (place - before).dot(after - place) >= 0.0 &&
         (place - before).cross(along).norm() <= tolerance * along.squaredNorm();
}

/// Whether the smallest height of a triangle is tiny beside its longest side.
bool is_flat(const UnwrapMesh& mesh, const Triangle& t) {
  double longest = 0.0;
  for (std::size_t i = 0; i < 3; ++i) {
    longest = std::max(longest, (point_of(mesh, t[i]) - point_of(mesh, t[(i + 1) % 3])).squaredNorm());
  }
  return doubled_area(mesh, t) <= kStraight * longest;
}

bool is_visible(const UnwrapMesh& mesh, const Triangle& triangle) { return mesh.island(triangle[0]) >= 0; }

/// The pairs of corners at vertices that two corners of visible triangles have.
std::vector<std::array<std::int32_t, 2>> corners_of_two(const UnwrapMesh& mesh, const std::vector<int>& uses) {
  std::vector<std::array<std::int32_t, 2>> pairs(mesh.points.size(), {-1, -1});
  Flags counts(pairs.size(), 0);
  for (std::int32_t c = 0; index(c) < uses.size(); ++c) {
    if (uses[c] == 0) continue;
    const std::int32_t v = mesh.vertices[c];
    if (counts[v] < 2) pairs[v][counts[v]] = c;
    if (counts[v] < 3) ++counts[v];
  }
  std::vector<std::array<std::int32_t, 2>> found;
  for (std::size_t v = 0; v < pairs.size(); ++v) {
    if (counts[v] == 2) found.push_back(pairs[v]);
  }
  return found;
}

/// Finds the ends that stay on both sides of straight corners. A polygon with straight corners only keeps them.
void find_ends(const UnwrapMesh& mesh, const Flags& is_straight, StraightCorners& result) {
  const std::vector<std::int32_t>& vertices = mesh.vertices;
  const auto is_seam = [&](std::int32_t c) { return mesh.seams[mesh.edges[c]] != 0; };
  result.left_out.clear();
  for (std::int32_t c = 0; index(c) < vertices.size(); ++c) result.onto[c] = c;
  for (std::int32_t begin = 0; index(begin) < vertices.size(); ++begin) {
    const std::int32_t low = mesh.preceding[begin];
    if (is_straight[begin] == 0 || is_straight[low] != 0) continue;
    bool is_cut = is_seam(low);
    std::int32_t high = begin;
    for (; is_straight[high] != 0; high = mesh.following[high]) is_cut = is_cut && is_seam(high);
    for (std::int32_t c = begin; c != high; c = mesh.following[c]) {
      const double to_low = (point_of(mesh, c) - point_of(mesh, low)).norm();
      const double to_high = (point_of(mesh, high) - point_of(mesh, c)).norm();
      const double whole = to_low + to_high;
      result.left_out.push_back({c, {low, high}, whole > 0.0 ? to_low / whole : 0.5, is_cut});
      // Both faces of a vertex replace it by the same one.
      const bool is_first = to_low < to_high || (to_low == to_high && vertices[low] < vertices[high]);
      result.onto[c] = is_first ? low : high;
    }
  }
}

}  // namespace

StraightCorners find_straight_corners(const UnwrapMesh& mesh) {
  const std::size_t count = mesh.vertices.size();
  const std::vector<std::int32_t>& vertices = mesh.vertices;
  std::vector<int> uses(count, 0), flat_uses(count, 0);
  for (const Triangle& t : mesh.triangles) {
    if (!is_visible(mesh, t)) continue;
    const bool flat = is_flat(mesh, t);
    for (const std::int32_t c : t) {
      ++uses[c];
      flat_uses[c] += flat ? 1 : 0;
    }
  }
  StraightCorners result{.left_out = {}, .onto = std::vector<std::int32_t>(count), .stays = Flags(count, 0)};
  Flags is_straight(count, 0);
  for (const auto& [one, two] : corners_of_two(mesh, uses)) {
    if (mesh.polygons[one] == mesh.polygons[two]) continue;
    const std::int32_t before = vertices[mesh.preceding[one]], after = vertices[mesh.following[one]];
    const std::pair beyond(vertices[mesh.preceding[two]], vertices[mesh.following[two]]);
    if (beyond != std::pair(before, after) && beyond != std::pair(after, before)) continue;
    const bool are_ears = uses[one] == 1 && uses[two] == 1;
    const std::vector<Vector>& points = mesh.points;
    const double tolerance = are_ears ? kNearlyStraight : kStraight;
    if (!is_between(points[before], point_of(mesh, one), points[after], tolerance)) continue;
    // Otherwise a triangle with an area keeps the vertex in its place.
    const bool is_needed = are_ears || (flat_uses[one] == uses[one] && flat_uses[two] == uses[two]);
    Flags& found = is_needed ? is_straight : result.stays;
    found[one] = found[two] = 1;
  }
  for (bool is_done = false; !is_done;) {
    find_ends(mesh, is_straight, result);
    // A polygon without any triangle would have no place in the map.
    Flags is_drawn(mesh.sizes.size(), 0), is_kept(mesh.points.size(), 0);
    for (const Triangle& t : mesh.triangles) {
      if (!result.vanishes(t)) is_drawn[mesh.polygons[t[0]]] = 1;
    }
    for (const Triangle& t : mesh.triangles) {
      if (!is_visible(mesh, t) || is_drawn[mesh.polygons[t[0]]] != 0) continue;
      std::int32_t c = t[0];
      do {
        if (is_straight[c] != 0) is_kept[vertices[c]] = 1;
        c = mesh.following[c];
      } while (c != t[0]);
    }
    is_done = std::ranges::count(is_kept, 1) == 0;
    for (std::size_t c = 0; c < count; ++c) {
      if (is_kept[vertices[c]] != 0) is_straight[c] = 0;
    }
  }
  return result;
}

std::vector<Triangle> triangles_to_map(const UnwrapMesh& mesh, std::span<const Triangle> given) {
  const StraightCorners& straight = *mesh.straight;
  std::vector<Triangle> triangles;
  for (const Triangle& t : given) {
    if (!straight.vanishes(t)) triangles.push_back(straight.without(t));
  }
  struct Use {
    int count = 0;
    std::array<std::size_t, 2> rows{};
  };
  std::vector<Use> uses(mesh.vertices.size());
  for (std::size_t row = 0; row < triangles.size(); ++row) {
    for (const std::int32_t c : triangles[row]) {
      Use& use = uses[c];
      if (use.count < 2) use.rows[static_cast<std::size_t>(use.count)] = row;
      ++use.count;
    }
  }
  const std::vector<Use> first = uses;
  for (std::int32_t c = 0; index(c) < uses.size(); ++c) {
    if (first[c].count != 2 || uses[c].count != 2 || straight.stays[c] != 0) continue;
    std::int32_t before = mesh.preceding[c], after = mesh.following[c];
    while (straight.onto[before] != before) before = mesh.preceding[before];
    while (straight.onto[after] != after) after = mesh.following[after];
    if (!is_between(point_of(mesh, before), point_of(mesh, c), point_of(mesh, after), kStraight)) continue;
    Triangle &one = triangles[first[c].rows[0]], &other = triangles[first[c].rows[1]];
    std::set<std::int32_t> rest(one.begin(), one.end());
    rest.insert(other.begin(), other.end());
    for (const std::int32_t known : {before, c, after}) rest.erase(known);
    if (rest.size() != 1 || std::ranges::count(one, c) == 0 || std::ranges::count(other, c) == 0) continue;
    const std::int32_t third = *rest.begin();
    one = {before, c, after};
    other = {before, after, third};
    --uses[c].count;
    ++uses[before].count;
    ++uses[after].count;
    --uses[third].count;
  }
  return triangles;
}

}  // namespace seamwire::detail
