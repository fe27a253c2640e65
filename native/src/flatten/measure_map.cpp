// SPDX-License-Identifier: GPL-3.0-or-later
#include "seamwire/flatten/measure_map.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <string>

#include "detail/csr.hpp"
#include "detail/disjoint_sets.hpp"
#include "detail/half_edge.hpp"
#include "detail/index.hpp"
#include "flatten/box_grid.hpp"
#include "flatten/cut_open.hpp"
#include "flatten/outline.hpp"
#include "flatten/symmetric_dirichlet.hpp"

namespace seamwire {

using namespace detail;

namespace {

using Corners = std::array<Eigen::Vector2d, 3>;

/// The part of the area whose worst triangles do not count.
constexpr double kLeftOut = 1e-3;
/// Parts of an outline that cross by less than this part of the island's size only touch.
constexpr double kTouching = 1e-6;

void check_map(const Surface& surface, std::span<const Corners> uvs, std::span<const std::int32_t> islands) {
  const auto check_size = [&](const char* what, std::size_t size) {
    if (size == surface.face_count()) return;
    throw InvalidInput(std::string(what) + " has " + std::to_string(size) + " items: there are " +
                       std::to_string(surface.face_count()) + " triangles");
  };
  check_size("uvs", uvs.size());
  if (!islands.empty()) check_size("islands", islands.size());
  for (std::size_t f = 0; f < uvs.size(); ++f) {
    const auto is_fine = [](const Eigen::Vector2d& uv) { return uv.allFinite() && uv.cwiseAbs().maxCoeff() < 1e152; };
    if (!std::ranges::all_of(uvs[f], is_fine)) {
      throw InvalidInput("triangle " + std::to_string(f) + " has a UV that is not finite or above 1e152 in size");
    }
    if (!islands.empty()) check_index(islands[f], uvs.size(), "islands: number", "triangles");
  }
}

/// A map of the triangles of a surface's half-edge mesh.
class HalfEdgeMap {
 public:
  HalfEdgeMap(const Surface& surface, std::span<const Corners> uvs, std::span<const std::int32_t> islands)
      : surface_(surface), uvs_(surface.face_fans().size()), island_(uvs_.size()) {
    for (std::size_t f = 0; f < uvs_.size(); ++f) {
      const std::int32_t source = surface.face_of_half_edge_face()[f];
      uvs_[f] = uvs[index(source)];
      // Fans are listed from the caller's first corner on; a triangle that was turned over has the others swapped.
      const std::int32_t second = surface.vertex_of_fan()[surface.face_fans()[f][1]];
      if (second != surface.triangles()[index(source)][1]) std::swap(uvs_[f][1], uvs_[f][2]);
    }
    find_islands(islands);
    turn_islands();
  }

  std::size_t size() const { return uvs_.size(); }
  std::int32_t island(std::size_t face) const { return island_[face]; }
  std::int32_t island_count() const { return island_.empty() ? 0 : std::ranges::max(island_) + 1; }
  const std::vector<Corners>& uvs() const { return uvs_; }
  /// Twice the area.
  double cross(std::size_t face) const {
    const auto& [a, b, c] = uvs_[face];
    return (b.x() - a.x()) * (c.y() - a.y()) - (b.y() - a.y()) * (c.x() - a.x());
  }
  /// Whether the triangles on both sides of an edge agree on its UVs.
  bool is_continuous(std::int32_t h) const {
    const std::int32_t twin = surface_.twins()[h];
    return uv(h) == uv(next_in_face(twin)) && uv(next_in_face(h)) == uv(twin);
  }
  const Eigen::Vector2d& uv(std::int32_t corner) const { return uvs_[corner / 3][corner % 3]; }

 private:
  void find_islands(std::span<const std::int32_t> islands) {
    if (!islands.empty()) {
      for (std::size_t f = 0; f < size(); ++f) island_[f] = islands[index(surface_.face_of_half_edge_face()[f])];
      return;
    }
    DisjointSets sets(size());
    for (std::int32_t h = 0; index(h) < surface_.twins().size(); ++h) {
      if (surface_.twins()[h] > h && is_continuous(h)) sets.join(h / 3, surface_.twins()[h] / 3);
    }
    std::int32_t count = 0;
    for (std::int32_t f = 0; index(f) < size(); ++f) island_[f] = sets.find(f) == f ? count++ : island_[sets.find(f)];
  }
  /// Mirrors the islands of which more area is clockwise.
  void turn_islands() {
    std::vector<double> area(index(island_count()), 0.0);
    for (std::size_t f = 0; f < size(); ++f) area[island_[f]] += cross(f);
    for (std::size_t f = 0; f < size(); ++f) {
      if (area[island_[f]] >= 0.0) continue;
      for (Eigen::Vector2d& uv : uvs_[f]) uv.x() = -uv.x();
    }
  }

  const Surface& surface_;
  std::vector<Corners> uvs_;
  std::vector<std::int32_t> island_;
};

/// The energies at the scale at which their mean is lowest, without the worst triangles.
class ScaledEnergies {
 public:
  ScaledEnergies(std::vector<std::array<double, 2>> parts, const std::vector<double>& weights, double squared_scale)
      : parts_(std::move(parts)), weights_(weights), squared_scale_(squared_scale) {
    for (std::int32_t f = 0; index(f) < parts_.size(); ++f) {
      if (std::isfinite(of(f))) order_.push_back(f);
    }
    // Which triangles are worst depends on the scale, and the scale on them.
    for (int round = 0; round < 4; ++round) find_scale();
  }
  double of(std::int32_t f) const { return squared_scale_ * parts_[f][0] + parts_[f][1] / squared_scale_; }
  double mean() const { return mean_; }

 private:
  void find_scale() {
    std::ranges::stable_sort(order_, {}, [&](std::int32_t f) { return of(f); });
    double all = 0.0, area = 0.0, stretched = 0.0, shrunk = 0.0;
    for (const std::int32_t f : order_) all += weights_[f];
    for (const std::int32_t f : order_) {
      if (area > 0.0 && area + weights_[f] > (1.0 - kLeftOut) * all) break;
      area += weights_[f];
      stretched += weights_[f] * parts_[f][0];
      shrunk += weights_[f] * parts_[f][1];
    }
    if (!(area > 0.0)) return;
    squared_scale_ = std::sqrt(shrunk / stretched);
    mean_ = 2.0 * std::sqrt(shrunk) * std::sqrt(stretched) / area;
  }

  std::vector<std::array<double, 2>> parts_;
  const std::vector<double>& weights_;
  double squared_scale_;
  std::vector<std::int32_t> order_;  // of the triangles that are not flipped, by energy
  double mean_ = std::numeric_limits<double>::infinity();
};

ScaledEnergies scaled_energies(const Surface& surface, const HalfEdgeMap& map, std::vector<double>& weights) {
  std::vector<Triangle> triangles(map.size());
  std::vector<Vector> points;
  std::vector<double> flat;
  double largest = 0.0;
  for (const Corners& corners : map.uvs()) {
    for (const Eigen::Vector2d& uv : corners) largest = std::max(largest, uv.cwiseAbs().maxCoeff());
  }
  // A power of two, so that no triangle flips by rounding.
  const double unit = largest > 0.0 ? std::ldexp(1.0, std::ilogb(largest)) : 1.0;
  const Vector origin = surface.points()[index(surface.vertex_of_fan()[0])];
  double area = 0.0;
  for (std::size_t f = 0; f < map.size(); ++f) {
    for (std::size_t i = 0; i < 3; ++i) {
      triangles[f][i] = static_cast<std::int32_t>(points.size());
      const std::int32_t v = surface.vertex_of_fan()[surface.face_fans()[f][i]];
      points.emplace_back(surface.scale() * (surface.points()[index(v)] - origin));
      for (const double value : map.uvs()[f][i]) flat.push_back(value / unit);
    }
    area += std::max(0.0, map.cross(f) / unit / unit);
  }
  const SymmetricDirichlet energy(std::move(triangles), points);
  weights = energy.weights();
  // To begin with, the whole map has the area of the surface.
  return {energy.parts(flat), weights, area > 0.0 ? 2.0 * energy.area() / area : 1.0};
}

/// Finds islands that cover a part of the plane twice.
class OverlapTest {
 public:
  OverlapTest(const Surface& surface, const HalfEdgeMap& map) : map_(map) {
    std::vector<std::uint8_t> is_cut(surface.twins().size(), 0);
    for (std::int32_t h = 0; index(h) < is_cut.size(); ++h) {
      const std::int32_t twin = surface.twins()[h];
      if (twin < 0) continue;
      is_cut[h] = map.island(index(h / 3)) != map.island(index(twin / 3)) || !map.is_continuous(h) ? 1 : 0;
    }
    pieces_ = cut_open(surface.face_fans(), surface.twins(), is_cut);
  }

  std::vector<std::int32_t> overlapping(std::vector<std::uint8_t> is_bad, const Task& task) const {
    std::vector<std::vector<const Island*>> by_island(is_bad.size());
    for (const Island& piece : pieces_) by_island[map_.island(index(piece.faces.front()))].push_back(&piece);
    std::vector<std::int32_t> found;
    for (std::size_t i = 0; i < by_island.size(); ++i) {
      task.check(0.5 + 0.5 * static_cast<double>(i) / static_cast<double>(by_island.size()));
      if (is_bad[i] != 0 || overlaps(by_island[i])) found.push_back(static_cast<std::int32_t>(i));
    }
    return found;
  }

 private:
  bool overlaps(const std::vector<const Island*>& pieces) const {
    std::vector<double> map;
    std::vector<Edge> edges;
    std::vector<std::size_t> first_edge;
    Box box;
    for (const Island* piece : pieces) {
      const auto offset = static_cast<std::int32_t>(map.size() / 2);
      first_edge.push_back(edges.size());
      map.resize(map.size() + 2 * piece->vertices.size());
      double* own = map.data() + 2 * index(offset);
      for (std::size_t f = 0; f < piece->faces.size(); ++f) {
        for (std::size_t i = 0; i < 3; ++i) {
          const Eigen::Vector2d& uv = map_.uvs()[index(piece->faces[f])][i];
          own[2 * index(piece->triangles[f][i])] = uv.x();
          own[2 * index(piece->triangles[f][i]) + 1] = uv.y();
          box.add(uv.data());
        }
      }
      if (winds_around_a_vertex(*piece, own)) return true;
      for (const std::vector<std::int32_t>& loop : piece->boundaries()) {
        for (std::size_t i = 0; i < loop.size(); ++i) {
          edges.push_back({loop[i] + offset, loop[(i + 1) % loop.size()] + offset});
        }
      }
    }
    first_edge.push_back(edges.size());
    if (edges.empty()) return !pieces.empty();
    const double size = std::max(box.high[0] - box.low[0], box.high[1] - box.low[1]);
    if (Outline(edges).crosses_itself(map, kTouching * size)) return true;
    return pieces.size() > 1 && is_one_in_another(pieces, map, edges, first_edge);
  }

  /// Whether the triangles around an inner vertex go around it more than once.
  static bool winds_around_a_vertex(const Island& piece, const double* own) {
    std::vector<double> angle(piece.vertices.size(), 0.0);
    std::vector<std::uint8_t> is_border(piece.vertices.size(), 0);
    for (std::int32_t h = 0; index(h) < piece.twins.size(); ++h) {
      const Triangle& t = piece.triangles[h / 3];
      const double* at = own + 2 * index(t[h % 3]);
      const double* to = own + 2 * index(t[(h + 1) % 3]);
      const double* back = own + 2 * index(t[(h + 2) % 3]);
      const double ax = to[0] - at[0], ay = to[1] - at[1], bx = back[0] - at[0], by = back[1] - at[1];
      angle[t[h % 3]] += std::atan2(ax * by - ay * bx, ax * bx + ay * by);
      if (piece.twins[h] < 0) is_border[t[h % 3]] = 1;
    }
    for (std::size_t v = 0; v < angle.size(); ++v) {
      if (is_border[v] == 0 && angle[v] > 3.0 * std::numbers::pi) return true;
    }
    return false;
  }

  /// Whether a piece lies inside another one, whose outlines do not cross: the outline winds around its first triangle.
  static bool is_one_in_another(const std::vector<const Island*>& pieces, const std::vector<double>& map,
                                const std::vector<Edge>& edges, const std::vector<std::size_t>& first_edge) {
    std::size_t offset = 0;
    for (std::size_t i = 0; i < pieces.size(); ++i) {
      std::array<double, 2> center{0.0, 0.0};
      for (const std::int32_t v : pieces[i]->triangles.front()) {
        for (std::size_t k = 0; k < 2; ++k) center[k] += map[2 * (offset + index(v)) + k] / 3.0;
      }
      offset += pieces[i]->vertices.size();
      for (std::size_t j = 0; j < pieces.size(); ++j) {
        if (j == i) continue;
        int winding = 0;
        for (std::size_t e = first_edge[j]; e < first_edge[j + 1]; ++e) {
          const double* a = map.data() + 2 * index(edges[e][0]);
          const double* b = map.data() + 2 * index(edges[e][1]);
          if ((a[1] > center[1]) == (b[1] > center[1])) continue;
          const double side = (b[0] - a[0]) * (center[1] - a[1]) - (b[1] - a[1]) * (center[0] - a[0]);
          if (a[1] <= center[1] && side > 0.0) ++winding;
          if (a[1] > center[1] && side < 0.0) --winding;
        }
        if (winding != 0) return true;
      }
    }
    return false;
  }

  const HalfEdgeMap& map_;
  std::vector<Island> pieces_;
};

}  // namespace

MapReport measure_map(const Surface& surface, std::span<const Corners> uvs, std::span<const std::int32_t> islands,
                      const Task& task) {
  check_map(surface, uvs, islands);
  task.check(0.0);
  MapReport report;
  report.energy = std::numeric_limits<double>::infinity();
  report.energies.assign(surface.face_count(), 0.0);
  const HalfEdgeMap map(surface, uvs, islands);
  if (map.size() == 0) return report;
  std::vector<double> weights;
  const ScaledEnergies energies = scaled_energies(surface, map, weights);
  task.check(0.4);
  report.energy = energies.mean();
  std::vector<std::uint8_t> is_bad(index(map.island_count()), 0);
  for (std::size_t f = 0; f < map.size(); ++f) {
    const std::int32_t source = surface.face_of_half_edge_face()[f];
    report.energies[index(source)] = energies.of(static_cast<std::int32_t>(f));
    if (map.cross(f) > 0.0) continue;
    report.flipped.push_back(source);
    is_bad[map.island(f)] = 1;
  }
  report.overlapping = OverlapTest(surface, map).overlapping(std::move(is_bad), task);
  return report;
}

}  // namespace seamwire
