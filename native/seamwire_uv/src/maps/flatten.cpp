// SPDX-License-Identifier: GPL-3.0-or-later
#include "seamwire_uv/maps/flatten.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <atomic>
#include <cmath>
#include <numeric>
#include <optional>
#include <string>
#include <utility>

#include "detail/half_edge.hpp"
#include "detail/index.hpp"
#include "detail/poll.hpp"
#include "detail/run_on_threads.hpp"
#include "maps/cut_open.hpp"
#include "maps/island_map.hpp"
#include "maps/left_out_uvs.hpp"
#include "maps/open_island.hpp"
#include "maps/straight_strip.hpp"
#include "maps/upright.hpp"
#include "seamwire/surface/segments.hpp"
#include "surface/corner_fans.hpp"
#include "surface/cuts.hpp"
#include "surface/real_edges.hpp"

namespace seamwire {

using namespace detail;

namespace {

/// How often an island is opened further because numbers cannot hold its map.
constexpr int kMostOpenings = 32;

/// An island of the corner fans, its map, and which of the caller's corners its own corners are.
struct MappedIsland {
  OpenedIsland opened;  ///< its faces are those of the corner fans
  IslandMap map;
  bool is_straight = false;
};

/// The caller's corner of each corner of a triangle. A triangle that was turned over has two of them swapped.
std::size_t caller_corner(const Surface& surface, std::int32_t face, std::size_t i) {
  const Triangle& given = surface.triangles()[index(corner_fans(surface).faces[face])];
  const bool is_turned = corner_fans(surface).vertices[corner_fans(surface).triangles[face][1]] != given[1];
  return is_turned && i > 0 ? 3 - i : i;
}

double area_of(const Island& island, std::span<const Vector> points) {
  double area = 0.0;
  for (const Triangle& t : island.triangles) {
    const auto corner = [&](std::size_t i) -> const Vector& { return points[index(island.vertices[t[i]])]; };
    area += 0.5 * (corner(1) - corner(0)).cross(corner(2) - corner(0)).stableNorm();
  }
  return area;
}

/// Scales a map to about the area of its island: by a power of two, so that no triangle flips by rounding.
void scale_to_island(const Island& island, std::span<const Vector> points, std::vector<Point2>& uvs) {
  double largest = 0.0;
  for (const Point2& uv : uvs) largest = std::max(largest, uv.cwiseAbs().maxCoeff());
  if (!(largest > 0.0)) return;
  const double unit = std::ldexp(1.0, std::ilogb(largest));
  for (Point2& uv : uvs) uv /= unit;
  double area = 0.0;
  for (const auto& [a, b, c] : island.triangles) {
    const Point2 ab = uvs[b] - uvs[a], ac = uvs[c] - uvs[a];
    area += 0.5 * (ab.x() * ac.y() - ab.y() * ac.x());
  }
  const double squared_scale = area_of(island, points) / area;
  if (!(squared_scale > 0.0 && std::isfinite(squared_scale))) return;
  for (Point2& uv : uvs) uv *= std::exp2(std::round(0.5 * std::log2(squared_scale)));
}

class Flattener {
 public:
  Flattener(const Surface& surface, const FlattenOptions& options) : surface_(surface), options_(options) {
    if (options.up && !(options.up->allFinite() && options.up->stableNorm() > 0.0)) {
      throw InvalidInput("up is no direction: it is zero or not finite");
    }
    if (!(options.tolerance >= 0.0)) throw InvalidInput("tolerance is negative or not a number");
    if (options.straighten && !(std::isfinite(*options.straighten) && *options.straighten >= 0.0)) {
      throw InvalidInput("straighten is negative or not finite");
    }
    if (options.start.empty()) return;
    if (options.start.size() != surface.face_count()) {
      throw InvalidInput("start has " + std::to_string(options.start.size()) + " items: there are " +
                         std::to_string(surface.face_count()) + " triangles");
    }
    for (std::size_t f = 0; f < options.start.size(); ++f) {
      if (std::ranges::all_of(options.start[f], [](const auto& uv) { return uv.allFinite(); })) continue;
      throw InvalidInput("start: triangle " + std::to_string(f) + " has a UV that is not finite");
    }
  }

  /// The island's map, straight and upright as the options say.
  MappedIsland map(const Island& island, const Task& task) const {
    MappedIsland result = flattened(island, task);
    if (options_.straighten) straighten(result);
    if (options_.up) {
      turn_upright(result.opened.island, surface_.points(), *options_.up, result.is_straight, result.map.uvs);
    }
    return result;
  }

  std::int32_t caller_face(const Island& island, std::size_t f) const {
    return corner_fans(surface_).faces[island.faces[f]];
  }

 private:
  MappedIsland flattened(const Island& island, const Task& task) const {
    const MapOptions options{
        .max_steps = options_.max_steps, .tolerance = options_.tolerance, .keep_apart = options_.keep_apart};
    std::optional<MappedIsland> started = continued(island, options, task);
    if (!started) return from_tutte(island, options, task);
    if (started->map.is_finished && !(started->map.overlaps && options.keep_apart)) return std::move(*started);
    const auto rank = [](const IslandMap& map) { return std::pair(map.overlaps, map.energy); };
    try {
      MappedIsland result = from_tutte(island, options, task);
      return rank(started->map) < rank(result.map) ? std::move(*started) : std::move(result);
    } catch (const InvalidInput&) {  // double precision cannot hold the embedding
      return std::move(*started);
    }
  }

  /// A straight map neither flips a triangle nor covers itself, because each quad is a rectangle of a grid.
  void straighten(MappedIsland& mapped) const {
    const Island& island = mapped.opened.island;
    std::optional<std::vector<Point2>> straight = straight_map(island, real_half_edges(island), surface_.points());
    if (!straight) return;
    const double energy = mean_energy(island, surface_.points(), *straight);
    if (!(energy <= mapped.map.energy + *options_.straighten)) return;
    turn_by_quarters(mapped.map.uvs, *straight);
    mapped.map.uvs = std::move(*straight);
    mapped.map.energy = energy;
    mapped.map.overlaps = false;
    mapped.is_straight = true;
  }

  const Eigen::Vector2d& start_of(const Island& island, std::int32_t h) const {
    const std::int32_t face = island.faces[h / 3];
    return options_.start[index(caller_face(island, index(h / 3)))][caller_corner(surface_, face, index(h % 3))];
  }

  /// Whether each half-edge of an island is a real edge.
  std::vector<std::uint8_t> real_half_edges(const Island& island) const {
    std::vector<std::uint8_t> is_real;
    is_real.reserve(island.twins.size());
    for (std::int32_t h = 0; index(h) < island.twins.size(); ++h) {
      is_real.push_back(has_edge(surface_, {island.vertices[island.tail(h)], island.vertices[island.tip(h)]}) ? 1 : 0);
    }
    return is_real;
  }

  /// The island is opened further until double precision can hold the embedding, and single precision the map.
  MappedIsland from_tutte(const Island& island, const MapOptions& options, const Task& task) const {
    const std::vector<std::uint8_t> is_real = real_half_edges(island);
    MappedIsland result{.opened = open_to_plane(island, is_real, surface_.points(), task), .map = {}};
    for (int opening = 0;; ++opening) {
      result.map = map_island(result.opened.island, surface_.points(), options, task);
      if (result.map.energy < kLostEnergy) return result;
      OpenedIsland further;
      if (opening < kMostOpenings) further = open_to_farthest(result.opened.island, is_real, surface_.points(), task);
      if (further.opened == 0) {
        if (!result.map.uvs.empty()) return result;
        throw InvalidInput("the island with triangle " + std::to_string(caller_face(island, 0)) +
                           " cannot be flattened in double precision; cut it further");
      }
      further.opened += result.opened.opened;
      result.opened = std::move(further);
    }
  }

  /// The island's map from the start; nullopt if it cannot start there.
  std::optional<MappedIsland> continued(const Island& island, const MapOptions& options, const Task& task) const {
    if (options_.start.empty()) return std::nullopt;
    std::vector<std::uint8_t> is_cut(island.twins.size(), 0);
    for (std::int32_t h = 0; index(h) < island.twins.size(); ++h) {
      const std::int32_t twin = island.twins[h];
      if (twin < h) continue;
      const bool agrees = start_of(island, h) == start_of(island, next_in_face(twin)) &&
                          start_of(island, next_in_face(h)) == start_of(island, twin);
      if (agrees) continue;
      if (!has_edge(surface_, {island.vertices[island.tail(h)], island.vertices[island.tip(h)]})) {
        return std::nullopt;  // a polygon has two UVs at a corner
      }
      is_cut[h] = is_cut[twin] = 1;
    }
    MappedIsland result{.opened = open_along(island, is_cut), .map = {}};
    const Island& own = result.opened.island;
    if (own.triangles.empty() || (result.opened.opened > 0 && is_planar(island)) || !is_planar(own))
      return std::nullopt;
    std::vector<Point2> uvs(own.vertices.size());
    for (std::int32_t h = 0; index(h) < own.twins.size(); ++h) uvs[own.tail(h)] = start_of(own, h);
    scale_to_island(own, surface_.points(), uvs);
    // Infinite if a triangle is flipped.
    if (!(mean_energy(own, surface_.points(), uvs) < kLostEnergy)) return std::nullopt;
    result.map = continue_map(own, surface_.points(), uvs, options, task);
    return result;
  }

  const Surface& surface_;
  const FlattenOptions& options_;
};

/// The islands of the corner fans, with vertices of the caller's.
std::vector<Island> islands_of(const Surface& surface, std::span<const Edge> cut_edges, const Task& task) {
  const Cuts cuts(surface, cut_edges, "cuts", task);
  std::vector<Island> islands = cut_open(corner_fans(surface), cut_half_edges(surface, cuts, task), task);
  for (Island& island : islands) {
    for (std::int32_t& v : island.vertices) v = corner_fans(surface).vertices[v];
  }
  return islands;
}

/// Maps all islands, those with the most triangles first.
std::vector<MappedIsland> map_all(const Surface& surface, const std::vector<Island>& islands,
                                  const FlattenOptions& options, const Task& task) {
  const Flattener flattener(surface, options);
  std::vector<MappedIsland> mapped(islands.size());
  std::vector<std::atomic<double>> progress(islands.size());
  std::vector<std::size_t> order(islands.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::stable_sort(order, std::ranges::greater(), [&](std::size_t i) { return islands[i].faces.size(); });
  const auto fraction = [&](std::size_t) {
    double done = 0.0, all = 0.0;
    for (std::size_t i = 0; i < islands.size(); ++i) {
      const auto size = static_cast<double>(islands[i].faces.size());
      done += size * progress[i];
      all += size;
    }
    return all > 0.0 ? 0.9 * done / all : 0.0;
  };
  run_on_threads(islands.size(), task, fraction, [&](std::size_t k, const Task& own) {
    const std::size_t i = order[k];
    const auto report = [&](double done) {
      if (done > progress[i]) progress[i] = done;
      return true;
    };
    mapped[i] = flattener.map(islands[i], {.stop = own.stop, .progress = report});
    progress[i] = 1.0;
  });
  return mapped;
}

FlatIsland describe(const Surface& surface, const MappedIsland& mapped) {
  const Island& island = mapped.opened.island;
  FlatIsland flat{.area = area_of(island, surface.points()),
                  .energy = mapped.map.energy,
                  .steps = mapped.map.steps,
                  .overlaps = mapped.map.overlaps,
                  .is_straight = mapped.is_straight,
                  .opened = mapped.opened.opened};
  const std::vector<double> energies = triangle_energies(island, surface.points(), mapped.map.uvs);
  const auto worst = static_cast<std::size_t>(std::ranges::max_element(energies) - energies.begin());
  flat.worst = corner_fans(surface).faces[island.faces[worst]];
  return flat;
}

}  // namespace

Flattening flatten(const Surface& surface, std::span<const Edge> cuts, const FlattenOptions& options,
                   const Task& task) {
  const Task beginning = part_of(task, 0.0, 0.0);
  const std::vector<Island> islands = islands_of(surface, cuts, beginning);
  Flattening result;
  result.islands = face_segments(surface, cuts, beginning);
  task.check(0.0);
  const std::vector<MappedIsland> mapped = map_all(surface, islands, options, task);
  result.uvs.assign(surface.face_count(), {Point2::Zero(), Point2::Zero(), Point2::Zero()});
  result.by_island.resize(result.islands.empty() ? 0 : index(std::ranges::max(result.islands) + 1));
  Poll poll(task, 0.9, 0.95, surface.face_count());
  for (std::size_t i = 0; i < islands.size(); ++i) {
    const Island& island = mapped[i].opened.island;
    for (std::size_t f = 0; f < island.faces.size(); ++f) {
      poll.next();
      for (std::size_t k = 0; k < 3; ++k) {
        result.uvs[index(corner_fans(surface).faces[island.faces[f]])][caller_corner(surface, island.faces[f], k)] =
            mapped[i].map.uvs[island.triangles[f][k]];
      }
    }
    const std::int32_t first = corner_fans(surface).faces[island.faces.front()];
    result.by_island[result.islands[first]] = describe(surface, mapped[i]);
  }
  fill_left_out(surface, result.islands, result.uvs);
  task.check(0.95);
  result.energy = map_energy(surface, result.uvs, result.islands, part_of(task, 0.95, 1.0));
  return result;
}

}  // namespace seamwire
