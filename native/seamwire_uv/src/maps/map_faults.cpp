// SPDX-License-Identifier: GPL-3.0-or-later
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>
#include <utility>

#include "detail/drop_repeats.hpp"
#include "detail/index.hpp"
#include "detail/poll.hpp"
#include "maps/straight_corners.hpp"
#include "maps/with_repeats.hpp"
#include "seamwire_uv/maps/measure_map.hpp"
#include "seamwire_uv/maps/unwrap_mesh.hpp"

namespace seamwire {

using namespace detail;

namespace {

using Eigen::Vector2d;
using Flags = std::vector<std::uint8_t>;

/// How far a UV may lie beside a line that it should lie on, because UVs are rounded.
constexpr double kOnLine = 1e-6;
/// An island may leave its unit square by so much, because UVs are rounded.
constexpr double kOnBorder = 1e-5;
/// Spacings of numbers: a triangle that is turned over by more was not turned over by rounding.
constexpr double kMostSpacings = 64.0;
/// A corner that moves makes room for others.
constexpr int kPasses = 3;

/// Triangles of meshes that share a map.
struct Soup {
  std::vector<Vector> points;
  std::vector<Triangle> triangles;
  std::vector<Edge> edges;
  std::vector<std::int32_t> islands, polygons;  // of each triangle
  CornerUvs uvs;
  std::int32_t island_count = 0, polygon_count = 0;

  /// Adds the visible triangles of a mesh that a map must have the right way around: all but those that lie on a
  /// straight line in the map and on the model. `size`: what lengths are divided by.
  void add(const UnwrapMesh& mesh, const std::vector<Vector2d>& own_uvs, double size) {
    const auto first = static_cast<std::int32_t>(points.size());
    for (const Vector& point : mesh.points) points.emplace_back(point / size);
    for (const auto& [a, b] : edges_of(mesh, Flags(mesh.island_count, 1))) edges.push_back({first + a, first + b});
    for (const Triangle& t : mesh.triangles) {
      if (mesh.island(t[0]) < 0) continue;
      const Corners2 own = uvs_of(t, own_uvs);
      if (mesh.straight->vanishes(t) && std::abs(doubled_area(own)) <= kOnLine * longest_side(own)) continue;
      const std::vector<std::int32_t>& v = mesh.vertices;
      triangles.push_back({first + v[t[0]], first + v[t[1]], first + v[t[2]]});
      islands.push_back(island_count + mesh.island(t[0]));
      polygons.push_back(polygon_count + mesh.polygons[t[0]]);
      uvs.push_back(own);
    }
    island_count += static_cast<std::int32_t>(mesh.island_count);
    polygon_count += static_cast<std::int32_t>(mesh.sizes.size());
  }
  static double longest_side(const Corners2& own) {
    return std::max({(own[1] - own[0]).norm(), (own[2] - own[1]).norm(), (own[0] - own[2]).norm()});
  }

  /// The flipped triangles, and the islands that overlap themselves or others. Only what is shown and placed counts.
  std::pair<std::vector<std::int32_t>, std::vector<std::int32_t>> measure(const Flags& is_shown,
                                                                          const Task& task) const {
    std::vector<std::int32_t> rows, numbers, flipped, overlapping;
    std::vector<Triangle> own;
    CornerUvs own_uvs;
    for (std::int32_t t = 0; index(t) < triangles.size(); ++t) {
      if (is_shown[t] == 0 || !is_placed(uvs[t])) continue;
      rows.push_back(t);
      numbers.push_back(islands[t]);
      own.push_back(triangles[t]);
      own_uvs.push_back(uvs[t]);
    }
    if (rows.empty()) return {};
    std::vector<std::int32_t> used = numbers;
    std::ranges::sort(used);
    drop_repeats(used);
    for (std::int32_t& number : numbers) {
      number = static_cast<std::int32_t>(std::ranges::lower_bound(used, number) - used.begin());
    }
    const Surface surface = surface_with_repeats(points, std::move(own), edges, part_of(task, 0.0, 0.2));
    const MapReport report = measure_map(surface, own_uvs, numbers, part_of(task, 0.2, 1.0));
    for (const std::int32_t row : report.flipped) flipped.push_back(rows[row]);
    std::ranges::set_union(report.overlapping, report.colliding, std::back_inserter(overlapping));
    for (std::int32_t& number : overlapping) number = used[number];
    return {flipped, overlapping};
  }

  /// The islands whose corners lie exactly where those of an earlier island do, and that island; -1 for the others.
  std::vector<std::int32_t> islands_below() const {
    using Place = std::pair<double, double>;
    std::vector<std::vector<Place>> places(index(island_count));
    for (std::size_t t = 0; t < triangles.size(); ++t) {
      for (const Vector2d& uv : uvs[t]) {
        if (uv.allFinite()) places[islands[t]].emplace_back(uv.x(), uv.y());
      }
    }
    std::map<std::vector<Place>, std::int32_t> firsts;
    std::vector<std::int32_t> below(places.size(), -1);
    for (std::int32_t i = 0; i < island_count; ++i) {
      std::ranges::sort(places[i]);
      drop_repeats(places[i]);
      if (places[i].empty()) continue;
      const auto [found, is_first] = firsts.try_emplace(std::move(places[i]), i);
      if (!is_first) below[i] = found->second;
    }
    return below;
  }
};

/// The longest side of the box around a mesh. All meshes in a map get the same size, because faces that are tiny beside
/// the whole have no shape that can be measured.
double size_of(const UnwrapMesh& mesh) {
  Eigen::AlignedBox3d box;
  for (const Vector& point : mesh.points) box.extend(point);
  return box.isEmpty() || !(box.sizes().maxCoeff() > 0.0) ? 1.0 : box.sizes().maxCoeff();
}

/// The low corners of the unit squares in which islands were, for all meshes.
std::vector<Vector2d> homes_of(std::span<const MappedMesh> maps) {
  std::vector<Vector2d> homes;
  for (const MappedMesh& map : maps) {
    const std::size_t first = homes.size();
    homes.resize(first + map.mesh->island_count, Vector2d::Zero());
    if (map.before.empty()) continue;
    check_corners(*map.mesh, map.before);
    std::vector<double> counts(map.mesh->island_count, 0.0);
    for (const Triangle& t : map.mesh->triangles) {
      const std::int32_t island = map.mesh->island(t[0]);
      if (island < 0) continue;
      for (const Vector2d& uv : uvs_of(t, map.before)) homes[first + index(island)] += uv;
      counts[island] += 3.0;
    }
    for (std::size_t i = 0; i < counts.size(); ++i) {
      homes[first + i] = (homes[first + i] / std::max(counts[i], 1.0)).array().floor();
    }
  }
  return homes;
}

/// A map whose corners move together where they are one point of an island.
class Mending {
 public:
  explicit Mending(const MappedMesh& map) : mesh_(*map.mesh), uvs_(map.uvs), at_vertex_(mesh_.points.size()) {
    std::vector<double> areas(mesh_.island_count, 0.0);
    const auto is_counted = [&](const Triangle& t) {
      return mesh_.island(t[0]) >= 0 && map.is_chosen[mesh_.island(t[0])] != 0 && is_placed(uvs_of(t, uvs_)) &&
             !mesh_.straight->vanishes(t);
    };
    for (const Triangle& t : mesh_.triangles) {
      if (is_counted(t)) areas[mesh_.island(t[0])] += doubled_area(uvs_of(t, uvs_));
    }
    // An island may be mirrored as a whole.
    for (const double area : areas) side_.push_back(area < 0.0 ? -1.0 : 1.0);
    Flags is_near(mesh_.points.size(), 0);
    for (const Triangle& t : mesh_.triangles) {
      if (!is_counted(t) || area(t) > 0.0) continue;
      turned_.push_back(t);
      for (const std::int32_t c : t) is_near[mesh_.vertices[c]] = 1;
    }
    for (const Triangle& t : mesh_.triangles) {
      if (turned_.empty() || !is_counted(t)) continue;
      for (const std::int32_t c : t) {
        if (is_near[mesh_.vertices[c]] != 0) at_vertex_[mesh_.vertices[c]].push_back(t);
      }
    }
  }

  std::vector<std::pair<std::int32_t, Vector2d>> mend() {
    for (int pass = 0; pass < kPasses; ++pass) {
      std::erase_if(turned_, [&](const Triangle& t) { return turn_back(t); });
    }
    std::vector<std::pair<std::int32_t, Vector2d>> found;
    for (const std::int32_t c : moved_) found.emplace_back(c, uvs_[c]);
    return found;
  }

 private:
  /// Positive if the triangle is not turned over.
  double area(const Triangle& t) const { return side_[mesh_.island(t[0])] * doubled_area(uvs_of(t, uvs_)); }

  /// Turns a triangle back, and returns whether it lies right.
  bool turn_back(const Triangle& t) {
    if (area(t) > 0.0) return true;
    const Corners2 places = uvs_of(t, uvs_);
    double largest = 0.0;
    for (const Vector2d& place : places) largest = std::max(largest, place.cwiseAbs().maxCoeff());
    const auto number = static_cast<float>(largest);
    const double spacing = static_cast<double>(std::nextafter(number, HUGE_VALF)) - static_cast<double>(number);
    const auto opposite = [&](std::size_t i) -> Vector2d { return places[(i + 2) % 3] - places[(i + 1) % 3]; };
    std::array<std::size_t, 3> order{0, 1, 2};
    std::ranges::stable_sort(order, std::ranges::greater(), [&](std::size_t i) { return opposite(i).norm(); });
    for (const std::size_t i : order) {
      const double length = opposite(i).norm();
      if (!(length > 0.0)) continue;
      const Vector2d across = side_[mesh_.island(t[0])] * Vector2d(-opposite(i).y(), opposite(i).x()) / length;
      const double height = across.dot(places[i] - places[(i + 1) % 3]);
      if (-height > kMostSpacings * spacing) return false;
      for (const double step : {1.0, 2.0, 4.0, 8.0, 16.0}) {
        if (move(t[i], places[i] + (step * spacing - height) * across, t)) return true;
      }
    }
    return false;
  }

  /// Moves a point if that turns a triangle back and turns over no other.
  bool move(std::int32_t corner, const Vector2d& place, const Triangle& turned) {
    const Vector2d old = uvs_[corner];
    std::set<std::int32_t> together;
    std::vector<Triangle> right;
    for (const Triangle& t : at_vertex_[mesh_.vertices[corner]]) {
      bool has_point = false;
      for (const std::int32_t c : t) {
        if (mesh_.vertices[c] != mesh_.vertices[corner] || mesh_.island(c) != mesh_.island(corner)) continue;
        if (uvs_[c] != old) continue;
        together.insert(c);
        has_point = true;
      }
      if (has_point && (t == turned || area(t) > 0.0)) right.push_back(t);
    }
    const auto put = [&](const Vector2d& to) {
      for (const std::int32_t c : together) uvs_[c] = to;
    };
    put(place.cast<float>().cast<double>());
    if (std::ranges::all_of(right, [&](const Triangle& t) { return area(t) > 0.0; })) {
      moved_.insert(together.begin(), together.end());
      return true;
    }
    put(old);
    return false;
  }

  const UnwrapMesh& mesh_;
  std::vector<Vector2d> uvs_;
  std::vector<std::vector<Triangle>> at_vertex_;  // at the vertices of triangles that are turned over
  std::vector<double> side_;                      // of each island
  std::vector<Triangle> turned_;
  std::set<std::int32_t> moved_;
};

}  // namespace

std::vector<std::int32_t> detail::overlapping_islands(const UnwrapMesh& mesh, const std::vector<Vector2d>& uvs,
                                                      const Task& task) {
  Soup soup;
  soup.add(mesh, uvs, 1.0);
  Flags is_shown;
  for (const Corners2& own : soup.uvs) {
    const double longest = Soup::longest_side(own);
    is_shown.push_back(std::abs(doubled_area(own)) > kOnLine * longest * longest ? 1 : 0);
  }
  return soup.measure(is_shown, task).second;
}

MapFaults map_faults(std::span<const MappedMesh> maps, bool may_stack, const Task& task) {
  Soup soup;
  Flags is_chosen;
  for (const MappedMesh& map : maps) {
    check_corners(*map.mesh, map.uvs);
    check_islands(*map.mesh, map.is_chosen);
    soup.add(*map.mesh, map.uvs, maps.size() > 1 ? size_of(*map.mesh) : 1.0);
    is_chosen.insert(is_chosen.end(), map.is_chosen.begin(), map.is_chosen.end());
  }
  const std::vector<Vector2d> homes = homes_of(maps);
  const std::vector<std::int32_t> below =
      may_stack ? soup.islands_below() : std::vector<std::int32_t>(is_chosen.size(), -1);
  const std::size_t size = soup.triangles.size();
  std::vector<double> areas(is_chosen.size(), 0.0);
  std::vector<Eigen::AlignedBox2d> boxes(is_chosen.size());
  Flags has_size(size, 0), is_shown(size, 0), is_bad(size, 0);
  for (std::size_t t = 0; t < size; ++t) {
    const auto [a, b, c] = soup.triangles[t];
    const std::int32_t island = soup.islands[t];
    // Otherwise it has no shape that its UVs could keep.
    has_size[t] = soup.points[a] != soup.points[b] || soup.points[a] != soup.points[c] ? 1 : 0;
    is_shown[t] = has_size[t] != 0 && below[island] < 0 ? 1 : 0;
    is_bad[t] = is_placed(soup.uvs[t]) ? 0 : 1;
    if (is_bad[t] != 0) continue;
    areas[island] += doubled_area(soup.uvs[t]);
    for (const Vector2d& uv : soup.uvs[t]) boxes[island].extend(uv);
  }
  const auto [flipped, overlapping] = soup.measure(is_shown, task);
  for (const std::int32_t t : flipped) is_bad[t] = 1;
  MapFaults faults;
  std::set<std::int32_t> polygons;
  for (std::size_t t = 0; t < size; ++t) {
    const std::int32_t island = soup.islands[t];
    const bool is_turned = below[island] >= 0 && has_size[t] != 0 && doubled_area(soup.uvs[t]) * areas[island] < 0.0;
    if ((is_bad[t] != 0 || is_turned) && is_chosen[island] != 0) polygons.insert(soup.polygons[t]);
  }
  faults.flipped = polygons.size();
  for (std::int32_t i = 0; index(i) < is_chosen.size(); ++i) {
    if (is_chosen[i] == 0) continue;
    if (std::ranges::binary_search(overlapping, below[i] < 0 ? i : below[i])) ++faults.overlapping;
    const auto is_in = [&](const Vector2d& low) {
      return Eigen::AlignedBox2d(low.array() - kOnBorder, low.array() + 1.0 + kOnBorder).contains(boxes[i]);
    };
    if (!boxes[i].isEmpty() && !is_in(Vector2d::Zero()) && !is_in(homes[i])) ++faults.outside;
  }
  return faults;
}

std::vector<std::pair<std::int32_t, Vector2d>> turned_back(const MappedMesh& map) {
  check_corners(*map.mesh, map.uvs);
  check_islands(*map.mesh, map.is_chosen);
  return Mending(map).mend();
}

}  // namespace seamwire
