// SPDX-License-Identifier: GPL-3.0-or-later
#include "seamwire/parameterization/map_faults.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>
#include <optional>
#include <set>
#include <string>
#include <tuple>

#include "detail/index.hpp"
#include "detail/poll.hpp"
#include "parameterization/overlaps.hpp"
#include "parameterization/straight_corners.hpp"

namespace seamwire {

using namespace detail;

namespace {

using Eigen::Vector2d;
using Flags = std::vector<std::uint8_t>;

/// An island may leave its unit square by so much, because UVs are rounded.
constexpr double kOnBorder = 1e-5;
/// Spacings of numbers: a triangle that is turned over by more was not turned over by rounding.
constexpr double kMostSpacings = 64.0;
/// A corner that moves makes room for others.
constexpr int kPasses = 3;

void check_fit(const char* what, std::size_t size, std::size_t count, const char* kind) {
  if (size == count) return;
  throw InvalidInput(std::string(what) + " has " + std::to_string(size) + " items: there are " + std::to_string(count) +
                     " " + kind);
}

/// The islands whose corners lie exactly where those of an earlier island do, and that island; -1 for the others.
std::vector<std::int32_t> islands_below(const MappedTriangles& map, std::size_t count) {
  using Place = std::pair<double, double>;
  std::vector<std::vector<Place>> places(count);
  for (std::size_t t = 0; t < map.triangles.size(); ++t) {
    for (const Vector2d& uv : map.uvs[t]) {
      if (uv.allFinite()) places[map.islands[t]].emplace_back(uv.x(), uv.y());
    }
  }
  std::map<std::vector<Place>, std::int32_t> firsts;
  std::vector<std::int32_t> below(count, -1);
  for (std::int32_t i = 0; index(i) < count; ++i) {
    std::vector<Place>& own = places[i];
    if (own.empty()) continue;
    std::ranges::sort(own);
    own.erase(std::ranges::unique(own).begin(), own.end());
    const auto [found, is_first] = firsts.try_emplace(std::move(own), i);
    if (!is_first) below[i] = found->second;
  }
  return below;
}

/// A map whose corners move together where they are one point of an island.
class Mending {
 public:
  /// `rows`: triangles with finite UVs.
  Mending(const UnwrapMesh& mesh, const std::vector<Vector2d>& uvs, const std::vector<std::int32_t>& rows) {
    std::vector<double> areas(mesh.island_count(), 0.0);
    const auto area_of = [&](const Triangle& t) { return doubled_area(uvs_of(t, uvs)); };
    for (const std::int32_t row : rows) {
      const Triangle& t = mesh.arrays().triangles[row];
      areas[mesh.island(t[0])] += area_of(t);
    }
    // An island may be mirrored as a whole.
    for (const double area : areas) side_.push_back(area < 0.0 ? -1.0 : 1.0);
    using Key = std::tuple<std::int32_t, std::int32_t, double, double>;
    const auto key_of = [&](std::int32_t c) {
      return Key(mesh.island(c), mesh.arrays().vertices[c], uvs[c].x(), uvs[c].y());
    };
    // Only points of triangles that are turned over move.
    std::set<Key> moving;
    std::map<Key, std::int32_t> numbers;
    for (const std::int32_t row : rows) {
      const Triangle& t = mesh.arrays().triangles[row];
      if (side_[mesh.island(t[0])] * area_of(t) > 0.0) continue;
      for (const std::int32_t c : t) moving.insert(key_of(c));
    }
    for (const std::int32_t row : rows) {
      const Triangle& t = mesh.arrays().triangles[row];
      if (std::ranges::none_of(t, [&](std::int32_t c) { return moving.contains(key_of(c)); })) continue;
      Triangle own{};
      for (std::size_t i = 0; i < 3; ++i) {
        std::int32_t& number = numbers.try_emplace(key_of(t[i]), -1).first->second;
        if (number < 0) {
          number = static_cast<std::int32_t>(points_.size());
          points_.push_back({.place = uvs[t[i]], .corners = {}, .triangles = {}});
        }
        own[i] = number;
        points_[number].corners.push_back(t[i]);
        points_[number].triangles.push_back(static_cast<std::int32_t>(triangles_.size()));
      }
      triangles_.push_back(own);
      islands_.push_back(mesh.island(t[0]));
    }
  }

  std::vector<std::int32_t> turned_over() const {
    std::vector<std::int32_t> found;
    for (std::int32_t t = 0; index(t) < triangles_.size(); ++t) {
      if (area(t) <= 0.0) found.push_back(t);
    }
    return found;
  }

  /// Turns a triangle back, and returns whether it lies right.
  bool turn_back(std::int32_t t) {
    if (area(t) > 0.0) return true;
    const Triangle& own = triangles_[t];
    const std::array<Vector2d, 3> places{points_[own[0]].place, points_[own[1]].place, points_[own[2]].place};
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
      const Vector2d across = side_[islands_[t]] * Vector2d(-opposite(i).y(), opposite(i).x()) / length;
      const double height = across.dot(places[i] - places[(i + 1) % 3]);
      if (-height > kMostSpacings * spacing) return false;
      for (const double step : {1.0, 2.0, 4.0, 8.0, 16.0}) {
        if (move(own[i], places[i] + (step * spacing - height) * across, t)) return true;
      }
    }
    return false;
  }

  std::vector<std::pair<std::int32_t, Eigen::Vector2f>> moved() const {
    std::map<std::int32_t, Eigen::Vector2f> found;
    for (const Point& point : points_) {
      if (!point.has_moved) continue;
      for (const std::int32_t c : point.corners) found[c] = point.place.cast<float>();
    }
    return {found.begin(), found.end()};
  }

 private:
  struct Point {
    Vector2d place;
    std::vector<std::int32_t> corners, triangles;
    bool has_moved = false;
  };

  /// Positive if the triangle is not turned over.
  double area(std::int32_t t) const {
    const auto& [a, b, c] = triangles_[t];
    return side_[islands_[t]] * doubled_area({points_[a].place, points_[b].place, points_[c].place});
  }

  /// Moves a point if that turns a triangle back and turns over no other.
  bool move(std::int32_t p, const Vector2d& place, std::int32_t turned) {
    Point& point = points_[p];
    std::vector<std::int32_t> right;
    for (const std::int32_t t : point.triangles) {
      if (t == turned || area(t) > 0.0) right.push_back(t);
    }
    const Vector2d old = point.place;
    point.place = place.cast<float>().cast<double>();
    if (std::ranges::all_of(right, [&](std::int32_t t) { return area(t) > 0.0; })) return point.has_moved = true;
    point.place = old;
    return false;
  }

  std::vector<Point> points_;
  std::vector<Triangle> triangles_;
  std::vector<std::int32_t> islands_;  // of each triangle
  std::vector<double> side_;           // of each island
};

}  // namespace

Surface surface_with_repeats(std::vector<Vector> points, std::vector<Triangle> triangles,
                             std::optional<std::vector<Edge>> edges, const Task& task) {
  std::vector<std::pair<Triangle, std::size_t>> sorted;
  sorted.reserve(triangles.size());
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    Triangle own = triangles[t];
    std::ranges::sort(own);
    sorted.emplace_back(own, t);
  }
  polled_sort(sorted, Poll(task));
  const std::size_t count = points.size();
  for (std::size_t i = 1; i < sorted.size(); ++i) {
    const Triangle& own = sorted[i].first;
    if (own != sorted[i - 1].first || own[0] < 0 || index(own[2]) >= count) continue;
    Triangle& triangle = triangles[sorted[i].second];
    for (std::int32_t& v : triangle) {
      points.push_back(points[v]);
      v = static_cast<std::int32_t>(points.size()) - 1;
    }
    if (!edges) continue;
    for (std::size_t k = 0; k < 3; ++k) edges->push_back({triangle[k], triangle[(k + 1) % 3]});
  }
  return {std::move(points), std::move(triangles), std::move(edges), task};
}

void detail::check_uvs(const UnwrapMesh& mesh, const std::vector<Vector2d>& uvs) {
  check_fit("uvs", uvs.size(), mesh.corner_count(), "corners");
}

std::vector<Edge> detail::visible_edges(const UnwrapMesh& mesh, const Flags& is_chosen) {
  std::vector<Edge> edges;
  for (std::int32_t c = 0; index(c) < mesh.corner_count(); ++c) {
    const std::int32_t island = mesh.island(c);
    if (island < 0 || (!is_chosen.empty() && is_chosen[island] == 0)) continue;
    const std::vector<std::int32_t>& vertices = mesh.arrays().vertices;
    if (vertices[c] != vertices[mesh.following(c)]) edges.push_back({vertices[c], vertices[mesh.following(c)]});
  }
  return edges;
}

MappedTriangles detail::mapped_triangles(const UnwrapMesh& mesh, const std::vector<Vector2d>& uvs,
                                         const std::vector<std::int32_t>& rows) {
  MappedTriangles map{.points = mesh.arrays().points,
                      .triangles = {},
                      .polygons = {},
                      .islands = {},
                      .uvs = {},
                      .edges = visible_edges(mesh)};
  for (const std::int32_t row : rows) {
    const Triangle& t = mesh.arrays().triangles[row];
    const std::vector<std::int32_t>& vertices = mesh.arrays().vertices;
    map.triangles.push_back({vertices[t[0]], vertices[t[1]], vertices[t[2]]});
    map.polygons.push_back(mesh.polygon(t[0]));
    map.islands.push_back(mesh.island(t[0]));
    map.uvs.push_back(uvs_of(t, uvs));
  }
  return map;
}

Overlaps detail::find_overlaps(const MappedTriangles& map, const Flags& is_shown, const Task& task) {
  std::vector<std::int32_t> rows, numbers;
  std::vector<Triangle> triangles;
  CornerUvs uvs;
  for (std::int32_t t = 0; index(t) < map.triangles.size(); ++t) {
    if (is_shown[t] == 0 || !is_placed(map.uvs[t])) continue;
    rows.push_back(t);
    numbers.push_back(map.islands[t]);
    triangles.push_back(map.triangles[t]);
    uvs.push_back(map.uvs[t]);
  }
  Overlaps found;
  if (rows.empty()) return found;
  found.is_measured = true;
  std::vector<std::int32_t> islands = numbers;
  std::ranges::sort(islands);
  islands.erase(std::ranges::unique(islands).begin(), islands.end());
  for (std::int32_t& number : numbers) {
    number = static_cast<std::int32_t>(std::ranges::lower_bound(islands, number) - islands.begin());
  }
  const Surface surface = surface_with_repeats(map.points, std::move(triangles), map.edges, part_of(task, 0.0, 0.2));
  const MapReport report = measure_map(surface, uvs, numbers, part_of(task, 0.2, 1.0));
  for (const std::int32_t row : report.flipped) found.flipped.push_back(rows[row]);
  std::vector<std::int32_t> both;
  std::ranges::set_union(report.overlapping, report.colliding, std::back_inserter(both));
  for (const std::int32_t number : both) found.overlapping.push_back(islands[number]);
  return found;
}

MapFaults map_faults(const MappedTriangles& map, const FaultOptions& options, const Task& task) {
  const std::size_t size = map.triangles.size();
  check_fit("polygons", map.polygons.size(), size, "triangles");
  check_fit("islands", map.islands.size(), size, "triangles");
  check_fit("uvs", map.uvs.size(), size, "triangles");
  std::size_t count = std::max(options.chosen.size(), options.homes.size());
  if (count == 0) {
    for (const std::int32_t island : map.islands) count = std::max(count, index(std::max(island, -1) + 1));
  }
  if (!options.chosen.empty()) check_fit("chosen", options.chosen.size(), count, "islands");
  if (!options.homes.empty()) check_fit("homes", options.homes.size(), count, "islands");
  for (std::size_t t = 0; t < size; ++t) {
    check_index(map.islands[t], count, "islands: number", "islands");
    for (const std::int32_t v : map.triangles[t]) check_index(v, map.points.size(), "triangles: vertex");
  }
  const auto is_chosen = [&](std::int32_t island) { return options.chosen.empty() || options.chosen[island] != 0; };
  const std::vector<std::int32_t> below =
      options.may_stack ? islands_below(map, count) : std::vector<std::int32_t>(count, -1);
  std::vector<double> areas(count, 0.0);
  std::vector<Eigen::AlignedBox2d> boxes(count);
  Flags has_size(size, 0), is_shown(size, 0), is_bad(size, 0);
  for (std::size_t t = 0; t < size; ++t) {
    const auto [a, b, c] = map.triangles[t];
    // Otherwise it has no shape that its UVs could keep.
    has_size[t] = map.points[a] != map.points[b] || map.points[a] != map.points[c] ? 1 : 0;
    const std::int32_t island = map.islands[t];
    is_shown[t] = has_size[t] != 0 && below[island] < 0 ? 1 : 0;
    is_bad[t] = is_placed(map.uvs[t]) ? 0 : 1;
    if (is_bad[t] != 0) continue;
    areas[island] += doubled_area(map.uvs[t]);
    for (const Vector2d& uv : map.uvs[t]) boxes[island].extend(uv);
  }
  const Overlaps found = find_overlaps(map, is_shown, task);
  for (const std::int32_t t : found.flipped) is_bad[t] = 1;
  MapFaults faults;
  std::vector<std::int32_t> polygons;
  for (std::size_t t = 0; t < size; ++t) {
    const std::int32_t island = map.islands[t];
    const bool is_turned = below[island] >= 0 && has_size[t] != 0 && doubled_area(map.uvs[t]) * areas[island] < 0.0;
    if ((is_bad[t] != 0 || is_turned) && is_chosen(island)) polygons.push_back(map.polygons[t]);
  }
  std::ranges::sort(polygons);
  faults.flipped = static_cast<std::size_t>(std::ranges::unique(polygons).begin() - polygons.begin());
  for (std::int32_t i = 0; index(i) < count; ++i) {
    if (!is_chosen(i)) continue;
    const std::int32_t seen = below[i] < 0 ? i : below[i];
    if (std::ranges::binary_search(found.overlapping, seen)) ++faults.overlapping;
    const auto is_in = [&](const Vector2d& low) {
      const Eigen::AlignedBox2d tile(low.array() - kOnBorder, low.array() + 1.0 + kOnBorder);
      return tile.contains(boxes[i]);
    };
    const bool is_inside =
        boxes[i].isEmpty() || is_in(Vector2d::Zero()) || (!options.homes.empty() && is_in(options.homes[i]));
    if (!is_inside && found.is_measured) ++faults.outside;
  }
  return faults;
}

std::vector<std::int32_t> proper_triangles(const UnwrapMesh& mesh, const std::vector<Vector2d>& uvs) {
  check_uvs(mesh, uvs);
  std::vector<std::int32_t> rows;
  for (std::int32_t row = 0; index(row) < mesh.arrays().triangles.size(); ++row) {
    const Triangle& t = mesh.arrays().triangles[row];
    if (mesh.island(t[0]) < 0) continue;
    const std::array<Vector2d, 3> own = uvs_of(t, uvs);
    const bool is_line = std::abs(doubled_area(own)) <= kOnLine * longest_side(own);
    if (!is_line || !straight_corners(mesh).vanishes(t)) rows.push_back(row);
  }
  return rows;
}

std::vector<std::pair<std::int32_t, Eigen::Vector2f>> turned_back(const UnwrapMesh& mesh,
                                                                  const std::vector<Vector2d>& uvs,
                                                                  const Flags& is_chosen) {
  check_fit("is_chosen", is_chosen.size(), mesh.island_count(), "islands");
  std::vector<std::int32_t> rows = proper_triangles(mesh, uvs);
  std::erase_if(rows, [&](std::int32_t row) {
    const Triangle& t = mesh.arrays().triangles[row];
    return is_chosen[mesh.island(t[0])] == 0 || !is_placed(uvs_of(t, uvs));
  });
  Mending mending(mesh, uvs, rows);
  std::vector<std::int32_t> turned = mending.turned_over();
  for (int pass = 0; pass < kPasses; ++pass) {
    std::erase_if(turned, [&](std::int32_t t) { return mending.turn_back(t); });
  }
  return mending.moved();
}

}  // namespace seamwire
