// SPDX-License-Identifier: GPL-3.0-or-later
#include "seamwire_uv/maps/measure_map.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "detail/csr.hpp"
#include "detail/half_edge.hpp"
#include "detail/index.hpp"
#include "detail/infinity.hpp"
#include "detail/poll.hpp"
#include "maps/coverage.hpp"
#include "maps/cut_open.hpp"
#include "maps/measure_islands.hpp"
#include "maps/symmetric_dirichlet.hpp"
#include "maps/worst_area.hpp"
#include "surface/corner_fans.hpp"
#include "surface/joined_faces.hpp"

namespace seamwire {

using namespace detail;

namespace {

using Corners = std::array<Eigen::Vector2d, 3>;

/// Outlines that cross by less than this part of the map's size, or of its largest coordinate, only touch. UVs are
/// rounded to single precision, more than once where islands are moved, and the largest one tells by how much.
constexpr double kTouching = 1e-6;

void check_map(const Surface& surface, std::span<const Corners> uvs, std::span<const std::int32_t> islands,
               const Task& task) {
  const auto check_size = [&](const char* what, std::size_t size) {
    if (size == surface.face_count()) return;
    throw InvalidInput(std::string(what) + " has " + std::to_string(size) + " items: there are " +
                       std::to_string(surface.face_count()) + " triangles");
  };
  check_size("uvs", uvs.size());
  if (!islands.empty()) check_size("islands", islands.size());
  const Poll poll(task, 0.0, 0.0, uvs.size());
  for (std::size_t f = 0; f < uvs.size(); ++f) {
    poll.at(f);
    if (!std::ranges::all_of(uvs[f], [](const Eigen::Vector2d& uv) { return uv.allFinite(); })) {
      throw InvalidInput("triangle " + std::to_string(f) + " has a UV that is not finite");
    }
    if (!islands.empty()) check_index(islands[f], uvs.size(), "islands: number", "triangles");
  }
}

/// A map of the triangles of a surface's corner fans, scaled such that the largest coordinate is about 1.
class HalfEdgeMap {
 public:
  HalfEdgeMap(const Surface& surface, std::span<const Corners> uvs, std::span<const std::int32_t> islands,
              const Task& task)
      : surface_(surface), uvs_(corner_fans(surface).triangles.size()), island_(uvs_.size()) {
    const Poll poll(task, 0.0, 0.1, uvs_.size());
    for (std::size_t f = 0; f < uvs_.size(); ++f) {
      poll.at(f);
      const std::int32_t source = corner_fans(surface).faces[f];
      uvs_[f] = uvs[index(source)];
      // Fans are listed from the caller's first corner on; a triangle that was turned over has the others swapped.
      const std::int32_t second = corner_fans(surface).vertices[corner_fans(surface).triangles[f][1]];
      if (second != surface.triangles()[index(source)][1]) std::swap(uvs_[f][1], uvs_[f][2]);
    }
    scale();
    task.check(0.1);
    find_islands(islands);
    task.check(0.1);
    turn_islands();
  }

  std::size_t size() const { return uvs_.size(); }
  std::int32_t island(std::size_t face) const { return island_[face]; }
  std::int32_t island_count() const { return island_.empty() ? 0 : std::ranges::max(island_) + 1; }
  /// Of all triangles, those of mirrored islands turned over.
  const std::vector<Corners>& uvs() const { return uvs_; }
  bool is_mirrored(std::int32_t island) const { return is_mirrored_[island] != 0; }
  /// Of a triangle, as they lie in the map.
  Corners placed_uvs(std::size_t face) const {
    Corners corners = uvs_[face];
    if (!is_mirrored(island_[face])) return corners;
    for (Eigen::Vector2d& uv : corners) uv.x() = -uv.x();
    return corners;
  }
  /// Twice the area.
  double cross(std::size_t face) const {
    const auto& [a, b, c] = uvs_[face];
    return (b.x() - a.x()) * (c.y() - a.y()) - (b.y() - a.y()) * (c.x() - a.x());
  }
  /// Whether the triangles on both sides of an edge agree on its UVs.
  bool is_continuous(std::int32_t h) const {
    const std::int32_t twin = corner_fans(surface_).twins[h];
    return uv(h) == uv(next_in_face(twin)) && uv(next_in_face(h)) == uv(twin);
  }
  const Eigen::Vector2d& uv(std::int32_t corner) const { return uvs_[corner / 3][corner % 3]; }

 private:
  void scale() {
    double largest = 0.0;
    for (const Corners& corners : uvs_) {
      for (const Eigen::Vector2d& uv : corners) largest = std::max(largest, uv.cwiseAbs().maxCoeff());
    }
    if (!(largest > 0.0)) return;
    // A power of two, so that no triangle flips by rounding.
    const double unit = std::ldexp(1.0, std::ilogb(largest));
    for (Corners& corners : uvs_) {
      for (Eigen::Vector2d& uv : corners) uv /= unit;
    }
  }
  void find_islands(std::span<const std::int32_t> islands) {
    if (!islands.empty()) {
      for (std::size_t f = 0; f < size(); ++f) island_[f] = islands[index(corner_fans(surface_).faces[f])];
      return;
    }
    island_ = joined_faces(corner_fans(surface_), [&](std::int32_t h) { return is_continuous(h); }).numbering().of;
  }
  /// Mirrors the islands of which more area is clockwise.
  void turn_islands() {
    std::vector<double> area(index(island_count()), 0.0);
    for (std::size_t f = 0; f < size(); ++f) area[island_[f]] += cross(f);
    for (const double sum : area) is_mirrored_.push_back(sum < 0.0 ? 1 : 0);
    for (std::size_t f = 0; f < size(); ++f) {
      if (is_mirrored_[island_[f]] == 0) continue;
      for (Eigen::Vector2d& uv : uvs_[f]) uv.x() = -uv.x();
    }
  }

  const Surface& surface_;
  std::vector<Corners> uvs_;
  std::vector<std::int32_t> island_;
  std::vector<std::uint8_t> is_mirrored_;  // of each island
};

/// The energies at the scale at which their mean is lowest, without the worst area.
class ScaledEnergies {
 public:
  ScaledEnergies(std::vector<std::array<double, 2>> parts, const std::vector<double>& weights, double squared_scale,
                 const Task& task)
      : parts_(std::move(parts)), weights_(weights), squared_scale_(squared_scale) {
    for (std::int32_t f = 0; index(f) < parts_.size(); ++f) {
      if (std::isfinite(of(f))) order_.push_back(f);
    }
    // Which triangles are worst depends on the scale, and the scale on them.
    Poll poll(task, 0.3, 0.3, 1);
    for (int round = 0; round < 4; ++round) find_scale(poll);
  }
  double of(std::int32_t f) const { return squared_scale_ * parts_[f][0] + parts_[f][1] / squared_scale_; }
  double mean() const { return mean_; }

 private:
  void find_scale(Poll& poll) {
    std::ranges::stable_sort(order_, std::ranges::greater(), [&](std::int32_t f) {
      poll.next();
      return of(f);
    });
    double all = 0.0, area = 0.0, stretched = 0.0, shrunk = 0.0;
    for (const std::int32_t f : order_) all += weights_[f];
    WorstArea worst(all);
    for (const std::int32_t f : order_) {
      const double counted = worst.counted(weights_[f]);
      area += counted;
      stretched += counted * parts_[f][0];
      shrunk += counted * parts_[f][1];
    }
    if (!(area > 0.0)) return;
    squared_scale_ = std::sqrt(shrunk / stretched);
    mean_ = 2.0 * std::sqrt(shrunk) * std::sqrt(stretched) / area;
  }

  std::vector<std::array<double, 2>> parts_;
  const std::vector<double>& weights_;
  double squared_scale_;
  std::vector<std::int32_t> order_;  // of the triangles that are not flipped, by energy
  double mean_ = kInfinity;
};

ScaledEnergies scaled_energies(const Surface& surface, const HalfEdgeMap& map, std::vector<double>& weights,
                               const Task& task) {
  std::vector<Triangle> triangles(map.size());
  std::vector<Vector> points;
  std::vector<double> flat;
  const Vector origin = surface.points()[index(corner_fans(surface).vertices[0])];
  double area = 0.0;
  const Poll poll(task, 0.1, 0.2, map.size());
  for (std::size_t f = 0; f < map.size(); ++f) {
    poll.at(f);
    for (std::size_t i = 0; i < 3; ++i) {
      triangles[f][i] = static_cast<std::int32_t>(points.size());
      const std::int32_t v = corner_fans(surface).vertices[corner_fans(surface).triangles[f][i]];
      points.emplace_back(surface.scale() * (surface.points()[index(v)] - origin));
      for (const double value : map.uvs()[f][i]) flat.push_back(value);
    }
    area += std::max(0.0, map.cross(f));
  }
  const SymmetricDirichlet energy(std::move(triangles), points);
  task.check(0.2);
  weights = energy.weights();
  // To begin with, the whole map has the area of the surface.
  return {energy.parts(flat), weights, area > 0.0 ? 2.0 * energy.area() / area : 1.0, task};
}

/// Finds islands that cover a part of the plane twice, and islands that cover a part of another one.
class OverlapTest {
 public:
  OverlapTest(const Surface& surface, const HalfEdgeMap& map, const Task& task)
      : map_(map),
        poll_(task, 0.5, 0.5, 1, Poll::kFewSteps),
        pair_poll_(task, 0.5, 0.5, 1),
        islands_(index(map.island_count())) {
    std::vector<std::uint8_t> is_cut(corner_fans(surface).twins.size(), 0);
    for (std::int32_t h = 0; index(h) < is_cut.size(); ++h) {
      const std::int32_t twin = corner_fans(surface).twins[h];
      if (twin < 0) continue;
      is_cut[h] = map.island(index(h / 3)) != map.island(index(twin / 3)) || !map.is_continuous(h) ? 1 : 0;
    }
    for (const Island& piece : cut_open(corner_fans(surface), is_cut, part_of(task, 0.5, 0.5))) {
      poll_.next();
      add_piece(piece);
    }
  }

  /// `is_bad`: islands that are known to overlap.
  std::vector<std::int32_t> overlapping(const std::vector<std::uint8_t>& is_bad) {
    std::vector<std::int32_t> found;
    for (std::int32_t i = 0; index(i) < islands_.size(); ++i) {
      poll_.next();
      std::vector<IslandPiece> pieces = pieces_of(i);
      const auto is_double = [&](const IslandPiece& piece) {
        return piece.outline->overlaps(*piece.outline, tolerance(), pair_poll_);
      };
      if (is_bad[i] != 0 || islands_[index(i)].is_wound || std::ranges::any_of(pieces, is_double) ||
          do_any_overlap(pieces, tolerance(), pair_poll_)) {
        found.push_back(i);
      }
    }
    return found;
  }

  std::vector<std::int32_t> colliding() {
    std::vector<IslandPiece> pieces;
    for (std::int32_t i = 0; index(i) < islands_.size(); ++i) {
      const std::vector<IslandPiece> own = pieces_of(i);
      pieces.insert(pieces.end(), own.begin(), own.end());
    }
    std::vector<std::uint8_t> is_colliding(islands_.size(), 0);
    mark_colliding(pieces, tolerance(), is_colliding, pair_poll_);
    std::vector<std::int32_t> found;
    for (std::int32_t i = 0; index(i) < is_colliding.size(); ++i) {
      if (is_colliding[index(i)] != 0) found.push_back(i);
    }
    return found;
  }

 private:
  struct IslandOutline {
    std::vector<PieceOutline> pieces;
    bool is_wound = false;  // closed, or around an inner vertex twice
  };

  double tolerance() const {
    if (box_.isEmpty()) return 0.0;
    return kTouching * box_.min().cwiseAbs().cwiseMax(box_.max().cwiseAbs()).cwiseMax(box_.sizes()).maxCoeff();
  }

  std::vector<IslandPiece> pieces_of(std::int32_t island) const {
    std::vector<IslandPiece> pieces;
    for (const PieceOutline& piece : islands_[index(island)].pieces) pieces.push_back({&piece, island});
    return pieces;
  }

  void add_piece(const Island& piece) {
    const std::int32_t number = map_.island(index(piece.faces.front()));
    IslandOutline& island = islands_[index(number)];
    std::vector<Eigen::Vector2d> own(piece.vertices.size());
    double largest = -1.0, inner_reach = 0.0;
    Eigen::Vector2d inner(0.0, 0.0);
    for (std::size_t f = 0; f < piece.faces.size(); ++f) {
      const Corners corners = map_.placed_uvs(index(piece.faces[f]));
      double longest = 0.0;
      for (std::size_t i = 0; i < 3; ++i) {
        own[index(piece.triangles[f][i])] = corners[i];
        box_.extend(corners[i]);
        longest = std::max(longest, (corners[(i + 1) % 3] - corners[i]).norm());
      }
      const double doubled = map_.cross(index(piece.faces[f]));
      if (!(doubled > largest)) continue;
      largest = doubled;
      inner = corners[0] + ((corners[1] - corners[0]) + (corners[2] - corners[0])) / 3.0;
      inner_reach = longest > 0.0 ? doubled / longest / 3.0 : 0.0;
    }
    const std::vector<std::vector<std::int32_t>> boundaries = piece.boundaries();
    island.is_wound = island.is_wound || boundaries.empty() || winds_around_a_vertex(piece, own);
    if (boundaries.empty()) return;
    std::vector<OutlineSide> sides;
    std::vector<std::size_t> loop_sizes;
    for (std::vector<std::int32_t> loop : boundaries) {
      if (map_.is_mirrored(number)) std::ranges::reverse(loop);
      for (std::size_t i = 0; i < loop.size(); ++i) {
        const std::int32_t tail = loop[i], tip = loop[(i + 1) % loop.size()];
        sides.push_back({own[index(tail)], own[index(tip)], tail, tip});
      }
      loop_sizes.push_back(loop.size());
    }
    island.pieces.emplace_back(std::move(sides), loop_sizes, inner, inner_reach, pair_poll_);
  }

  /// Whether the triangles around an inner vertex go around it more than once.
  bool winds_around_a_vertex(const Island& piece, const std::vector<Eigen::Vector2d>& own) const {
    std::vector<double> angle(piece.vertices.size(), 0.0);
    std::vector<std::uint8_t> is_border(piece.vertices.size(), 0);
    for (std::int32_t h = 0; index(h) < piece.twins.size(); ++h) {
      const std::int32_t v = piece.tail(h);
      const Eigen::Vector2d to = own[piece.tip(h)] - own[v], back = own[piece.apex(h)] - own[v];
      angle[v] += std::atan2(to.x() * back.y() - to.y() * back.x(), to.dot(back));
      if (piece.twins[h] < 0) is_border[v] = 1;
    }
    for (std::size_t v = 0; v < angle.size(); ++v) {
      if (is_border[v] == 0 && std::abs(angle[v]) > 3.0 * std::numbers::pi) return true;
    }
    return false;
  }

  const HalfEdgeMap& map_;
  Poll poll_, pair_poll_;
  std::vector<IslandOutline> islands_;
  Eigen::AlignedBox2d box_;  // of the map
};

}  // namespace

double map_energy(const Surface& surface, std::span<const Corners> uvs, std::span<const std::int32_t> islands,
                  const Task& task) {
  check_map(surface, uvs, islands, task);
  const HalfEdgeMap map(surface, uvs, islands, task);
  if (map.size() == 0) return kInfinity;
  std::vector<double> weights;
  return scaled_energies(surface, map, weights, task).mean();
}

MapReport detail::measure_islands(const Surface& surface, std::span<const Corners> uvs,
                                  std::span<const std::int32_t> islands, bool are_placed, const Task& given_task) {
  const RisingProgress rising(given_task);
  const Task& task = rising.task();
  check_map(surface, uvs, islands, task);
  MapReport report;
  report.energy = kInfinity;
  report.energies.assign(surface.face_count(), 0.0);
  const HalfEdgeMap map(surface, uvs, islands, task);
  if (map.size() == 0) return report;
  std::vector<double> weights;
  const ScaledEnergies energies = scaled_energies(surface, map, weights, task);
  task.check(0.4);
  report.energy = energies.mean();
  std::vector<std::uint8_t> is_bad(index(map.island_count()), 0);
  for (std::size_t f = 0; f < map.size(); ++f) {
    const std::int32_t source = corner_fans(surface).faces[f];
    report.energies[index(source)] = energies.of(static_cast<std::int32_t>(f));
    if (map.cross(f) > 0.0) continue;
    report.flipped.push_back(source);
    is_bad[map.island(f)] = 1;
  }
  OverlapTest test(surface, map, task);
  report.overlapping = test.overlapping(is_bad);
  if (are_placed) report.colliding = test.colliding();
  return report;
}

MapReport measure_map(const Surface& surface, std::span<const Corners> uvs, std::span<const std::int32_t> islands,
                      const Task& task) {
  return measure_islands(surface, uvs, islands, true, task);
}

}  // namespace seamwire
