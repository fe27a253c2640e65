// SPDX-License-Identifier: GPL-3.0-or-later
#include "seamwire/picking/picker.hpp"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <future>
#include <iterator>
#include <numbers>
#include <numeric>
#include <span>
#include <string>
#include <unordered_set>
#include <utility>

#include "detail/csr.hpp"
#include "detail/drop_repeats.hpp"
#include "detail/index.hpp"
#include "detail/infinity.hpp"
#include "seamwire/surface/ray_tree.hpp"
#include "surface/point_segment.hpp"

namespace seamwire {

using namespace detail;

namespace {

// Distances in pixels.
constexpr double kReach = 14.0;         ///< beside the mesh: rims and silhouettes are hard to hit
constexpr double kFeatureReach = 10.0;  ///< beside features and preferred vertices
constexpr double kVertexRadius = 12.0;  ///< around a vertex that is picked rather than its edge
constexpr double kVertexShare = 0.25;   ///< of an edge, the most that its vertex takes: every edge can be picked
constexpr double kShortEdge = 12.0;     ///< nobody can point at a shorter edge
constexpr double kInside = 14.0;        ///< farther from the nearest edge, the cursor is inside a face
constexpr double kCrease = 6.0;         ///< a face so little before a place hides nothing: the place may be in a crease

constexpr std::size_t kMostCrests = 24;  ///< pieces under one cursor that are tried
constexpr std::size_t kMostTried = 4;    ///< of the features near the cursor
constexpr std::size_t kMostNear =
    400;  ///< of vertices or pieces: of more in a far view, nobody can tell which is meant
constexpr std::size_t kFewEdges = 50000;       ///< with X-ray all are tried; of more, those at the vertices nearby
constexpr double kSharpCosine = 0.8660254038;  ///< 30 degrees, as for Blender's Select Sharp Edges
constexpr int kCorner = 3;                     ///< so many sharp edges meet at a corner
constexpr double kStraightCosine = 0.9;        ///< an edge that turns off by less does not cross another one...
constexpr double kSameCosine = 0.05;           ///< ...and edges cross equally well if their cosines differ by less

}  // namespace

namespace detail {

struct PickTables {
  Csr<std::int32_t> triangles_at, edges_at;  ///< the rows at each vertex
  PickLayer loose;                           ///< edges without a triangle
};

/// How a sight shows points. Pixels count from the bottom left, and their third coordinate is 0.
struct Projection {
  Eigen::Vector2d size;
  Eigen::Matrix4d to_world, to_clip, from_clip;
  std::vector<Eigen::Vector4d> planes;  ///< in the coordinates of the points

  Projection(const Sight& sight, const Eigen::Matrix3d& to_object) : size(sight.size), to_world(sight.object) {
    to_world.leftCols<3>() = sight.object.leftCols<3>() * to_object;
    to_clip = sight.perspective * to_world;
    from_clip = to_clip.inverse();
    for (const Eigen::Vector4d& plane : sight.clip_planes) planes.emplace_back(to_world.transpose() * plane);
  }

  double world_length(const Vector& v) const { return (to_world.topLeftCorner<3, 3>() * v).norm(); }
  Eigen::Vector4d clip(const Vector& p) const { return to_clip * p.homogeneous(); }

  /// Where a point is seen. NaN if it is behind the viewer or clipped away.
  Vector pixel(const Vector& p) const {
    const Eigen::Vector4d at = clip(p);
    bool is_shown = at.w() > 1e-9;
    for (const Eigen::Vector4d& plane : planes) is_shown = is_shown && plane.dot(p.homogeneous()) >= 0.0;
    if (!is_shown) return Vector::Constant(std::nan(""));
    return {(at.x() / at.w() * 0.5 + 0.5) * size.x(), (at.y() / at.w() * 0.5 + 0.5) * size.y(), 0.0};
  }

  /// The line that a pixel shows: from the near plane to the far plane, without what is clipped away.
  std::array<Vector, 2> line(const Vector& at) const {
    const double x = 2.0 * at.x() / size.x() - 1.0, y = 2.0 * at.y() / size.y() - 1.0;
    Vector near = (from_clip * Eigen::Vector4d(x, y, -1.0, 1.0)).hnormalized();
    Vector far = (from_clip * Eigen::Vector4d(x, y, 1.0, 1.0)).hnormalized();
    for (const Eigen::Vector4d& plane : planes) {
      const double first = plane.dot(near.homogeneous()), last = plane.dot(far.homogeneous());
      if ((first < 0.0) == (last < 0.0)) continue;
      (first < 0.0 ? near : far) = Vector(near + first / (first - last) * (far - near));
    }
    return {near, far};
  }

  /// How far apart two points are, in world units, that are seen a pixel apart at the depth of a point.
  double pixel_size(const Vector& p) const {
    Eigen::Vector4d at = clip(p);
    at.x() += 2.0 / size.x() * at.w();
    return world_length((from_clip * at).hnormalized() - p);
  }
};

/// A vertex or a piece, and where it is nearest to the cursor.
struct Near {
  std::int32_t number;
  double gap;  ///< in pixels
  Vector place;
  double part = 0.0;  ///< of a piece, how far along it the place is
};

inline void make_unique(std::vector<std::int32_t>& numbers) {
  std::ranges::sort(numbers);
  drop_repeats(numbers);
}

}  // namespace detail

struct Picker::Parts {
  std::vector<Vector> points;
  std::vector<Triangle> triangles;
  std::vector<std::int32_t> polygons;
  std::vector<Edge> edges;
  Eigen::Matrix3d to_object;
  RayTree rays;
  std::shared_future<PickTables> tables{};  ///< last, so that its thread ends first

  struct Search;
  PickTables make_tables() const {
    const auto rows_at = [this](const auto& rows) {
      return Csr<std::int32_t>(points.size(), [&rows](const auto& visit) {
        for (std::size_t row = 0; row < rows.size(); ++row) {
          for (const std::int32_t v : rows[row]) visit(v, static_cast<std::int32_t>(row));
        }
      });
    };
    PickTables made{.triangles_at = rows_at(triangles),
                    .edges_at = rows_at(edges),
                    .loose = {.ends = {}, .owners = {}, .reach = kReach}};
    for (std::size_t e = 0; e < edges.size(); ++e) {
      const Edge& edge = edges[e];
      const auto has_end = [&](std::int32_t t) { return std::ranges::count(triangles[t], edge[1]) > 0; };
      if (std::ranges::any_of(made.triangles_at[edge[0]], has_end)) continue;
      made.loose.ends.insert(made.loose.ends.end(), {points[edge[0]], points[edge[1]]});
      made.loose.owners.push_back(static_cast<std::int32_t>(e));
    }
    return made;
  }
};

/// One query.
struct Picker::Parts::Search {
  const Parts& mesh;
  const Sight& sight;
  const PickTargets& targets;
  const PickTables& tables = mesh.tables.get();
  Projection view{sight, mesh.to_object};
  Vector cursor{sight.cursor.x(), sight.cursor.y(), 0.0};

  Vector pixel(std::int32_t vertex) const { return view.pixel(mesh.points[vertex]); }
  double gap_to(const Vector& at) const { return (at - cursor).norm(); }
  double gap_to_edge(const Edge& edge) const { return distance_to_segment(cursor, pixel(edge[0]), pixel(edge[1])); }
  bool reaches(double gap, double reach) const { return gap <= reach * sight.scale; }
  /// In pixels, around the end of an edge of some length.
  double vertex_radius(double length) const { return std::min(kVertexRadius * sight.scale, kVertexShare * length); }
  std::int32_t other_end(std::int32_t row, std::int32_t vertex) const {
    return mesh.edges[row][mesh.edges[row][0] == vertex ? 1 : 0];
  }

  /// The first triangle along the line that a pixel shows.
  std::optional<Picked> cast(const Vector& at) const {
    const auto [near, far] = view.line(at);
    const RayHit hit = mesh.rays.first_hit(near, far - near);
    if (hit.triangle < 0 || !(hit.distance <= 1.0)) return std::nullopt;  // nothing, or behind the far plane
    const Vector way = hit.distance * (far - near);
    return Picked{.triangle = hit.triangle, .place = near + way, .depth = view.world_length(way)};
  }

  bool can_pick(const Vector& place) const {
    const Vector at = view.pixel(place);
    if (sight.xray || at.hasNaN()) return sight.xray;
    const std::optional<Picked> hit = cast(at);
    return !hit || view.world_length(place - view.line(at)[0]) - hit->depth <= kCrease * view.pixel_size(place);
  }

  /// The nearest of some that can be picked. Only so many are tried.
  std::optional<Near> visible(std::vector<Near> some, std::size_t most = kMostNear) const {
    std::ranges::stable_sort(some, {}, &Near::gap);
    some.resize(std::min(some.size(), most), Near{});
    const auto found = std::ranges::find_if(some, [this](const Near& one) { return can_pick(one.place); });
    return found == some.end() ? std::nullopt : std::optional(*found);
  }

  /// The pieces within reach. Halves on the screen are not halves in space where there is perspective, but near enough
  /// for a few pixels.
  std::vector<Near> pieces_near(const PickLayer& layer) const {
    if (layer.ends.size() != 2 * layer.owners.size()) throw InvalidInput("ends: expected two for each owner");
    std::vector<Near> found;
    for (std::int32_t i = 0; index(i) < layer.owners.size(); ++i) {
      const Vector &one = layer.ends[2 * i], &two = layer.ends[2 * i + 1];
      const Vector start = view.pixel(one), end = view.pixel(two);
      const double part = nearest_on_segment(cursor, start, end), gap = gap_to(start + part * (end - start));
      if (reaches(gap, layer.reach)) found.push_back({i, gap, one + part * (two - one), part});
    }
    return found;
  }

  const PickLayer& layer_at(std::int32_t number) const {
    check_index(number, targets.layers.size(), "layer", "layers");
    return targets.layers[number];
  }

  std::optional<Picked> in_layers(const std::vector<std::int32_t>& layers) const {
    for (const std::int32_t number : layers) {
      const PickLayer& layer = layer_at(number);
      const auto found = visible(pieces_near(layer));
      if (!found) continue;
      const double depth = view.world_length(found->place - view.line(cursor)[0]);
      return Picked{.layer = number, .owner = layer.owners[found->number], .place = found->place, .depth = depth};
    }
    return std::nullopt;
  }

  // The plain mesh

  std::optional<Picked> plain(const PickOptions& options) const {
    if (sight.xray) return through(options.vertices_only);
    if (options.anywhere) {
      if (const auto found = point()) return found;
    }
    const std::vector<std::int32_t> rows = edges_near(!options.vertices_only);
    if (!options.vertices_only) return nearest_edge(rows, kInfinity, options.edges_only);
    std::pair best(kInfinity, -1);
    for (const std::int32_t row : rows) {
      for (const std::int32_t v : mesh.edges[row]) best = std::min(best, std::pair(gap_to(pixel(v)), v));
    }
    return best.second < 0 ? std::nullopt : std::optional(Picked{.vertex = best.second});
  }

  /// The edge within reach that is nearest to the cursor, or its end that is meant.
  std::optional<Picked> nearest_edge(std::span<const std::int32_t> rows, double reach, bool edges_only) const {
    std::pair best(kInfinity, -1);
    for (const std::int32_t row : rows) best = std::min(best, std::pair(gap_to_edge(mesh.edges[row]), row));
    if (best.second < 0 || !reaches(best.first, reach)) return std::nullopt;
    const Edge& edge = mesh.edges[best.second];
    const std::int32_t end = edge[gap_to(pixel(edge[1])) < gap_to(pixel(edge[0])) ? 1 : 0];
    const bool is_end = !edges_only && gap_to(pixel(end)) <= vertex_radius((pixel(edge[1]) - pixel(edge[0])).norm());
    return is_end ? Picked{.vertex = end} : Picked{.edge = edge};
  }

  /// The point of the surface under the cursor, or the vertex that is meant.
  std::optional<Picked> point() const {
    std::optional<Picked> found = cast(cursor);
    if (!found) return std::nullopt;
    const Triangle& corners = mesh.triangles[found->triangle];
    const auto gap_of = [this](std::int32_t v) { return gap_to(pixel(v)); };
    const std::int32_t nearest = *std::ranges::min_element(corners, {}, gap_of);
    double shorter = kInfinity;
    for (const std::int32_t v : corners) {
      const double length = (pixel(v) - pixel(nearest)).norm();
      if (std::isnan(length)) return found;
      if (v != nearest) shorter = std::min(shorter, length);
    }
    return gap_of(nearest) <= vertex_radius(shorter) ? Picked{.vertex = nearest} : found;
  }

  /// The vertex or edge that is nearest on the screen, however much lies before it.
  std::optional<Picked> through(bool vertices_only) const {
    // Most points are told apart without a division: near the cursor, the first two numbers are small beside w.
    Eigen::Matrix<double, 3, 4> test;
    test << view.to_clip.topRows<2>(), view.to_clip.row(3);
    for (int i = 0; i < 2; ++i) test.row(i) += (1.0 - 2.0 * cursor[i] / view.size[i]) * test.row(2);
    const Eigen::Array2d room = 12.0 * kReach * sight.scale / view.size.array();
    std::vector<Near> near, around;
    for (std::int32_t v = 0; index(v) < mesh.points.size(); ++v) {
      const Vector quick = test * mesh.points[v].homogeneous();
      if (!(quick.head<2>().array().abs() <= room * quick.z()).all()) continue;
      const Vector off = pixel(v) - cursor;
      const double away = std::max(std::abs(off.x()), std::abs(off.y()));  // both are NaN, or none
      if (!reaches(away, 5.0 * kReach) || tables.edges_at[v].empty()) continue;
      (reaches(away, kReach) ? near : around).push_back({v, off.norm(), mesh.points[v]});
    }
    if (near.empty()) near = std::move(around);
    std::ranges::stable_sort(near, {}, &Near::gap);
    if (vertices_only) {
      std::pair front(static_cast<float>(kInfinity), -1);  // of vertices at the same place
      for (const auto& [v, gap, place, part] : near) {
        const Eigen::Vector4d clip = view.clip(place);
        const auto depth = static_cast<float>(clip.z() / clip.w());
        if (gap <= near.front().gap + 1.0) front = std::min(front, std::pair(depth, v));
      }
      return front.second < 0 ? std::nullopt : std::optional(Picked{.vertex = front.second});
    }
    std::vector<std::int32_t> rows(mesh.edges.size() <= kFewEdges ? mesh.edges.size() : 0);
    std::iota(rows.begin(), rows.end(), 0);
    for (std::size_t i = 0; rows.size() != mesh.edges.size() && i < std::min(near.size(), kMostNear); ++i) {
      std::ranges::copy(tables.edges_at[near[i].number], std::back_inserter(rows));
    }
    return nearest_edge(rows, 5.0 * kReach, false);
  }

  /// The edges that may be meant: of the polygons near the cursor and those around them, and edges without a polygon.
  std::vector<std::int32_t> edges_near(bool loose_too) const {
    std::vector<std::int32_t> rows;
    for (const std::int32_t polygon : polygons_near()) add_surroundings(polygon, rows);
    if (!loose_too) return rows;
    for (const Near& one : pieces_near(tables.loose)) {
      if (can_pick(one.place)) rows.push_back(tables.loose.owners[one.number]);
    }
    return rows;
  }

  /// The polygon under the cursor, or those just beside a cursor that is over no polygon, by their first triangles.
  std::vector<std::int32_t> polygons_near() const {
    std::vector<std::int32_t> found;
    const auto look = [&](const Vector& at) {
      if (const auto hit = cast(at)) found.push_back(polygon_of(hit->triangle)[0]);
    };
    look(cursor);
    for (double radius = 0.5; radius <= 1.0 && found.empty(); radius += 0.5) {
      for (int turn = 0; turn < 8; ++turn) {
        const double angle = turn * (std::numbers::pi / 4.0);
        look(cursor + radius * kReach * sight.scale * Vector(std::cos(angle), std::sin(angle), 0.0));
      }
    }
    make_unique(found);
    return found;
  }

  /// The first triangle of a triangle's polygon, and the one after its last.
  std::array<std::int32_t, 2> polygon_of(std::int32_t triangle) const {
    const auto is_same = [&](std::int32_t t) { return mesh.polygons[t] == mesh.polygons[triangle]; };
    std::array<std::int32_t, 2> found{triangle, triangle + 1};
    while (found[0] > 0 && is_same(found[0] - 1)) --found[0];
    while (index(found[1]) < mesh.polygons.size() && is_same(found[1])) ++found[1];
    return found;
  }

  /// Adds the edges of a polygon and of those around it that turn the same side to the viewer.
  void add_surroundings(std::int32_t polygon, std::vector<std::int32_t>& rows) const {
    std::vector<std::int32_t> around;
    for (std::int32_t t = polygon, end = polygon_of(polygon)[1]; t < end; ++t) {
      for (const std::int32_t v : mesh.triangles[t]) {
        for (const std::int32_t other : tables.triangles_at[v]) around.push_back(polygon_of(other)[0]);
      }
    }
    make_unique(around);
    const double own = facing(polygon);
    for (const std::int32_t other : around) {
      if (other == polygon || own * facing(other) > 0.0) add_sides(other, rows);
    }
  }

  /// The volume between the viewer's eye and a polygon: below 0 if one side is seen, above 0 for the other side.
  double facing(std::int32_t polygon) const {
    double volume = 0.0;
    for (std::int32_t t = polygon, end = polygon_of(polygon)[1]; t < end; ++t) {
      Eigen::Matrix3d corners;
      for (int i = 0; i < 3; ++i) corners.col(i) = view.clip(mesh.points[mesh.triangles[t][i]])({0, 1, 3});
      volume += corners.determinant();
    }
    return volume;
  }

  /// Adds the edges of a polygon. A side that two of its triangles share is a diagonal.
  void add_sides(std::int32_t polygon, std::vector<std::int32_t>& rows) const {
    std::vector<Edge> sides;
    for (std::int32_t t = polygon, end = polygon_of(polygon)[1]; t < end; ++t) {
      const auto [a, b, c] = mesh.triangles[t];
      for (const auto& [one, two] : {Edge{a, b}, Edge{b, c}, Edge{c, a}}) {
        sides.push_back({std::min(one, two), std::max(one, two)});
      }
    }
    std::ranges::sort(sides);
    for (std::size_t i = 0; i < sides.size(); ++i) {
      if (i + 1 < sides.size() && sides[i] == sides[i + 1]) {
        ++i;
        continue;
      }
      for (const std::int32_t row : tables.edges_at[sides[i][0]]) {
        if (other_end(row, sides[i][0]) == sides[i][1]) rows.push_back(row);
      }
    }
  }

  /// Adds the edge that crosses a picked edge at its end nearer to the cursor, and the triangle there.
  void add_crossing(Picked& picked) const {
    const bool is_first = !(gap_to(pixel(picked.edge[1])) < gap_to(pixel(picked.edge[0])));
    const std::int32_t end = picked.edge[is_first ? 0 : 1], start = picked.edge[is_first ? 1 : 0];
    if (const auto hit = sight.xray ? std::nullopt : cast(cursor)) {
      picked.triangle = hit->triangle;
      picked.is_inside = !reaches(gap_to_edge(picked.edge), kInside);
    }
    const auto way_to = [&](std::int32_t v) -> Vector { return mesh.to_object * (mesh.points[v] - mesh.points[end]); };
    std::vector<std::pair<double, std::int32_t>> ways;  // how straight each edge goes on
    for (const std::int32_t row : tables.edges_at[end]) {
      const std::int32_t other = other_end(row, end);
      const double lengths = way_to(other).norm() * way_to(start).norm();
      if (!(lengths > 0.0)) return;
      if (other != start) ways.emplace_back(std::abs(way_to(other).dot(way_to(start))) / lengths, other);
    }
    const double least = ways.empty() ? 1.0 : std::ranges::min(ways).first;
    if (least > kStraightCosine) return;
    std::erase_if(ways, [&](const auto& way) { return way.first > least + kSameCosine; });
    const auto gap_of = [&](const auto& way) { return std::min(kInfinity, gap_to_edge({end, way.second})); };
    picked.crossing = {end, std::ranges::min(ways, {}, gap_of).second};
    const auto length = [&](const Edge& edge) { return (pixel(edge[1]) - pixel(edge[0])).norm(); };
    picked.is_close_call = std::min(length(picked.crossing), length(picked.edge)) < kShortEdge * sight.scale;
  }

  // Features

  /// The vertices within reach of the cursor, walking over the mesh from a pick.
  std::vector<Near> vertices_near(const Picked& picked) const {
    std::vector<std::int32_t> front{picked.vertex};
    if (picked.vertex < 0) front.assign(picked.edge.begin(), picked.edge.end());
    if (front[0] < 0) front.assign(mesh.triangles[picked.triangle].begin(), mesh.triangles[picked.triangle].end());
    std::unordered_set<std::int32_t> seen(front.begin(), front.end());
    std::vector<Near> near;
    while (!front.empty() && seen.size() < kMostNear) {
      std::vector<std::int32_t> next;
      make_unique(front);
      for (const std::int32_t v : front) {
        const double gap = gap_to(pixel(v));
        if (!reaches(gap, kFeatureReach)) continue;
        near.push_back({v, gap, mesh.points[v]});
        for (const std::int32_t row : tables.edges_at[v]) {
          if (seen.insert(other_end(row, v)).second) next.push_back(other_end(row, v));
        }
      }
      front = std::move(next);
    }
    return near;
  }

  /// Whether three or more edges meet at a vertex where the mesh ends, faces meet at a sharp angle, or more than two
  /// do.
  bool is_corner(std::int32_t vertex) const {
    const auto is_sharp = [&](std::int32_t row) {
      const std::int32_t other = other_end(row, vertex);
      std::vector<Vector> normals;  // of faces on the left, and those on the right turned over
      for (const std::int32_t t : tables.triangles_at[vertex]) {
        const auto& [a, b, c] = mesh.triangles[t];
        const Vector normal = (mesh.points[b] - mesh.points[a]).cross(mesh.points[c] - mesh.points[a]).normalized();
        for (const Edge& side : {Edge{a, b}, Edge{b, c}, Edge{c, a}}) {
          if (side == Edge{vertex, other}) normals.push_back(normal);
          if (side == Edge{other, vertex}) normals.push_back(-normal);
        }
      }
      return normals.size() != 2 || -normals[0].dot(normals[1]) <= kSharpCosine;
    };
    return std::ranges::count_if(tables.edges_at[vertex], is_sharp) >= kCorner;
  }

  /// The nearest point of a crest line, or the vertex beside it.
  std::optional<Picked> crest(const PickLayer& layer, bool anywhere) const {
    if (layer.vertices.size() != layer.owners.size()) throw InvalidInput("vertices: expected two for each piece");
    const auto vertex_of = [&](const Near& one) { return layer.vertices[one.number][one.part > 0.5 ? 1 : 0]; };
    std::vector<Near> pieces = pieces_near(layer);
    for (const Near& one : pieces) check_index(vertex_of(one), mesh.points.size(), "vertices: vertex");
    const auto is_far = [&](const Near& one) { return !reaches(gap_to(pixel(vertex_of(one))), layer.reach); };
    if (!anywhere) std::erase_if(pieces, is_far);
    const auto found = visible(std::move(pieces), kMostCrests);
    if (!found) return std::nullopt;
    if (!anywhere) return Picked{.vertex = vertex_of(*found), .is_feature = true};
    return Picked{.triangle = layer.owners[found->number], .place = found->place, .is_feature = true};
  }

  std::optional<Picked> pick(const PickOptions& options) const {
    if (options.surface_only) return cast(cursor);
    std::optional<Picked> picked = in_layers(options.layers);
    if (picked || options.layers_only) return picked;
    picked = plain(options);
    if (!picked) return std::nullopt;
    std::vector<Near> near;
    if (options.preferred || options.features) near = vertices_near(*picked);
    const auto nearest = [&](bool is_feature, const auto& is_one) -> std::optional<Picked> {
      std::vector<Near> some;
      std::ranges::copy_if(near, std::back_inserter(some), is_one, &Near::number);
      const auto found = visible(std::move(some), kMostTried);
      return found ? std::optional(Picked{.vertex = found->number, .is_feature = is_feature}) : std::nullopt;
    };
    if (options.preferred) {
      const auto is_one = [&](std::int32_t v) { return std::ranges::binary_search(targets.preferred, v); };
      if (const auto found = nearest(false, is_one)) return found;
    }
    if (options.features) {
      if (const auto found = nearest(true, [this](std::int32_t v) { return is_corner(v); })) return found;
    }
    if (options.crests >= 0) {
      if (const auto found = crest(layer_at(options.crests), options.anywhere)) return found;
    }
    if (options.edges_only && picked->edge[0] >= 0) {
      add_crossing(*picked);
    } else if (options.features && !targets.strengths.empty()) {
      if (targets.strengths.size() != mesh.points.size()) throw InvalidInput("strengths: expected one for each vertex");
      for (Near& one : near) one.gap = -targets.strengths[one.number];  // the strongest comes first
      const auto is_one = [&](std::int32_t v) { return targets.strengths[v] > targets.least_strength; };
      if (const auto found = nearest(true, is_one)) return found;
    }
    return picked;
  }
};

Picker::Picker(std::vector<Vector> points, std::vector<Triangle> triangles, std::vector<std::int32_t> polygons,
               std::vector<Edge> edges, const Eigen::Matrix3d& to_object) {
  if (polygons.size() != triangles.size()) {
    throw InvalidInput("polygons: expected " + std::to_string(triangles.size()) + ", got " +
                       std::to_string(polygons.size()));
  }
  for (const auto& [a, b] : edges) {
    for (const std::int32_t v : {a, b}) check_index(v, points.size(), "edges: vertex");
  }
  RayTree rays(points, triangles);
  const std::shared_ptr<Parts> parts(new Parts{std::move(points), std::move(triangles), std::move(polygons),
                                               std::move(edges), to_object, std::move(rays)});
  parts->tables = std::async(std::launch::async, [made = parts.get()] { return made->make_tables(); });
  parts_ = parts;
}

bool Picker::ready() const {
  return parts_->rays.ready() && parts_->tables.wait_for(std::chrono::seconds(0)) == std::future_status::ready;
}

void Picker::wait() const {
  parts_->rays.wait();
  parts_->tables.wait();
}

std::optional<Picked> Picker::pick(const Sight& sight, const PickTargets& targets, const PickOptions& options) const {
  const Parts::Search search{*parts_, sight, targets};
  const bool is_flat = !(std::abs(sight.object.determinant()) >= 1e-30) || !search.view.from_clip.allFinite();
  return is_flat ? std::nullopt : search.pick(options);
}

}  // namespace seamwire
