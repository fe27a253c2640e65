// SPDX-License-Identifier: GPL-3.0-or-later
#include "slits/slit_paths.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "detail/index.hpp"
#include "detail/infinity.hpp"
#include "graph/loop_erasure.hpp"
#include "graph/shortest_paths.hpp"
#include "surface/point_segment.hpp"
#include "tuning/constants.hpp"

namespace seamwire::detail {
namespace {

/// Whether a path within a half may step from a vertex on one side to a vertex on another.
bool may_step(Half half, std::int8_t from, std::int8_t to) {
  if (half == Half::kAny) return true;
  if (to == 0) return from == 0;
  return half != Half::kPlane && to == static_cast<std::int8_t>(half);
}

double distance_to_line(const Vector& point, std::span<const Vector> line) {
  double least = (point - line[0]).norm();
  for (std::size_t i = 1; i < line.size(); ++i) {
    least = std::min(least, distance_to_segment(point, line[i - 1], line[i]));
  }
  return least;
}

/// Where the part of a path begins that leaves the mirror plane.
std::size_t leaves_plane(const Reflection& reflection, std::span<const std::int32_t> path) {
  std::size_t begin = 0;
  for (std::size_t i = 0; i < path.size(); ++i) {
    if (reflection.sides[path[i]] == 0) begin = i;
  }
  return begin;
}

/// The exact images of vertices; empty if they are not joined by real edges.
std::vector<std::int32_t> exact_image(const SlitProblem& problem, std::span<const std::int32_t> path) {
  std::vector<std::int32_t> image;
  for (const std::int32_t v : path) {
    const std::int32_t next = problem.reflection->images[v];
    if (next < 0 || (!image.empty() && problem.mesh->edge_between(image.back(), next) < 0)) return {};
    image.push_back(next);
  }
  return image;
}

/// The vertices that are marked.
std::vector<std::int32_t> marked(std::span<const std::uint8_t> flags) {
  std::vector<std::int32_t> vertices;
  for (std::int32_t v = 0; index(v) < flags.size(); ++v) {
    if (flags[v] != 0) vertices.push_back(v);
  }
  return vertices;
}

std::int32_t nearest_on_cut(const PlanMesh& mesh, std::span<const std::uint8_t> is_on_cut, const Vector& to) {
  std::int32_t nearest = -1;
  double least = kInfinity;
  for (std::int32_t v = 0; index(v) < mesh.vertex_count(); ++v) {
    if (is_on_cut[v] == 0) continue;
    const double distance = (mesh.points[v] - to).squaredNorm();
    if (distance < least) {
      least = distance;
      nearest = v;
    }
  }
  return nearest;
}

}  // namespace

TurningPaths slit_paths(const PlanMesh& mesh, const EdgePrices& prices, const Reflection* reflection,
                        std::span<const std::uint8_t> from, std::span<const std::uint8_t> ends, const PathRules& rules,
                        const Task& task) {
  TurningPaths paths(mesh);
  add_slit_paths(paths, mesh, prices, reflection, marked(from), from, ends, rules, task);
  return paths;
}

std::vector<std::int32_t> add_slit_paths(TurningPaths& paths, const PlanMesh& mesh, const EdgePrices& prices,
                                         const Reflection* reflection, std::span<const std::int32_t> vertices,
                                         std::span<const std::uint8_t> from, std::span<const std::uint8_t> ends,
                                         const PathRules& rules, const Task& task) {
  const auto side = [&](std::int32_t v) { return reflection->sides[v]; };
  const bool hugs_plane = reflection != nullptr && rules.half == Half::kPlane && !reflection->is_exact;
  const double plane_width = hugs_plane ? 0.5 * mesh.median_length : 0.0;
  const auto edge_price = [&](std::int32_t e, std::int32_t a, std::int32_t b) {
    if (!rules.barred_edges.empty() && rules.barred_edges[e] != 0) return kInfinity;
    if (from[b] != 0 || (ends[a] != 0 && from[a] == 0)) return kInfinity;
    const double unit = mesh.lengths[e] > 0.0 ? prices.of_edge[e] / mesh.lengths[e] : 1.0;
    const double price = rules.exponent == 1.0 ? prices.of_edge[e] : mesh.lengths[e] * std::pow(unit, rules.exponent);
    if (reflection == nullptr) return price;
    if (hugs_plane) {
      const double place = 0.5 * (mesh.points[a] + mesh.points[b])[reflection->axis];
      const double away = (place - reflection->offset) / plane_width;
      return price * (0.5 + away * away);
    }
    if (!may_step(rules.half, side(a), side(b))) return kInfinity;
    return side(a) == 0 && side(b) == 0 ? 0.5 * price : price;
  };
  return paths.add(vertices, edge_price, prices.turning, -1, task);
}

std::vector<std::int32_t> TurningPaths::path(std::int32_t vertex) const {
  std::vector<std::int32_t> vertices;
  if (arrival_[vertex] < 0) return vertices;
  vertices.push_back(vertex);
  for (std::int32_t d = arrival_[vertex]; d >= 0; d = before_[d]) vertices.push_back(tail(d));
  std::ranges::reverse(vertices);
  return without_loops(vertices);
}

std::vector<std::int32_t> chain_along(const PlanMesh& mesh, std::span<const Vector> line, double spread,
                                      std::int32_t from, std::int32_t to, std::span<const std::uint8_t> barred,
                                      const EdgePrices& prices, const Task& task) {
  std::vector<double> away(mesh.vertex_count(), -1.0);
  const auto distance = [&](std::int32_t v) {
    if (away[v] < 0.0) away[v] = distance_to_line(mesh.points[v], line) / spread;
    return away[v];
  };
  const auto edge_price = [&](std::int32_t e, std::int32_t a, std::int32_t b) {
    if (barred[b] != 0 && b != to) return kInfinity;
    const double d = 0.5 * (distance(a) + distance(b));
    return prices.of_edge[e] * (1.0 + d * d * d * d);
  };
  TurningPaths paths(mesh);
  paths.add({&from, 1}, edge_price, prices.turning, to, task);
  return paths.path(to);
}

std::vector<double> edge_distances(const PlanMesh& mesh, std::span<const std::int32_t> from, const Task& task) {
  Poll poll(task);
  std::vector<double> least(mesh.vertex_count(), kInfinity);
  find_shortest_paths(from, least, [&](std::int32_t v, const auto& step) {
    poll.next();
    for (const auto& [next, edge] : mesh.all_neighbors[v]) step(next, mesh.lengths[edge]);
  });
  return least;
}

std::vector<std::int32_t> mirrored_path(const SlitProblem& problem, std::span<const std::int32_t> path,
                                        std::span<const std::uint8_t> is_on_cut, const Task& task) {
  const Reflection& reflection = *problem.reflection;
  const std::span<const std::int32_t> part = path.subspan(leaves_plane(reflection, path));
  if (part.size() < 2) return {};
  // Paths end at a rim, if they come to it.
  std::vector<std::uint8_t> barred(is_on_cut.begin(), is_on_cut.end());
  for (std::size_t v = 0; v < barred.size(); ++v) barred[v] |= problem.is_rim[v];
  const std::int32_t end = reflection.images[part.back()];
  if (end >= 0 && is_on_cut[end] == 0) barred[end] = 0;
  for (const std::int32_t v : path) barred[v] = 1;
  const auto is_clear = [&](const std::vector<std::int32_t>& image) {
    return image.size() > 1 &&
           std::all_of(image.begin() + 1, image.end(), [&](std::int32_t v) { return barred[v] == 0; });
  };
  const bool starts_on_plane = reflection.sides[part.front()] == 0;
  if (reflection.is_exact) {
    std::vector<std::int32_t> image = exact_image(problem, part);
    const bool starts_well =
        !image.empty() && (starts_on_plane ? image.front() == part.front() : is_on_cut[image.front()] != 0);
    if (starts_well && is_clear(image)) return image;
  }
  std::vector<Vector> line;
  for (const std::int32_t v : part) line.push_back(reflection.mirrored(problem.mesh->points[v]));
  const std::int32_t from = starts_on_plane ? part.front() : nearest_on_cut(*problem.mesh, is_on_cut, line.front());
  const std::int32_t to = reflection.images[part.back()];
  if (from < 0 || to < 0 || from == to || barred[to] != 0) return {};
  const double most_away = 2.0 * std::max(tuning::kMirrorSpread, problem.mesh->median_length);
  if ((problem.mesh->points[from] - line.front()).norm() > most_away) return {};  // the cut is elsewhere
  std::vector<std::int32_t> image =
      chain_along(*problem.mesh, line, tuning::kMirrorSpread, from, to, barred, problem.prices, task);
  if (is_clear(image)) return image;
  return {};
}

SlitFinder::SlitFinder(const SlitProblem& problem, std::span<const std::uint8_t> from,
                       std::span<const std::uint8_t> is_on_cut, Task task, double exponent,
                       std::vector<std::uint8_t> barred_edges)
    : problem_(problem),
      from_(from.begin(), from.end()),
      is_on_cut_(is_on_cut),
      task_(std::move(task)),
      exponent_(exponent),
      barred_edges_(std::move(barred_edges)) {}

const TurningPaths& SlitFinder::paths_in(Half half) const {
  std::optional<TurningPaths>& paths = paths_[index(static_cast<std::int32_t>(half) + 1)];
  if (!paths) {
    paths.emplace(*problem_.mesh);
    add(*paths, half, marked(from_));
  }
  return *paths;
}

std::vector<std::int32_t> SlitFinder::add(TurningPaths& paths, Half half,
                                          std::span<const std::int32_t> vertices) const {
  return add_slit_paths(paths, *problem_.mesh, problem_.prices, half == Half::kAny ? nullptr : problem_.mirror(),
                        vertices, from_, problem_.is_rim,
                        {.half = half, .exponent = exponent_, .barred_edges = barred_edges_}, task_);
}

std::vector<std::int32_t> SlitFinder::start_from(std::span<const std::int32_t> vertices) {
  std::vector<std::int32_t> cheaper;
  for (const std::int32_t v : vertices) from_[v] = 1;
  for (std::size_t i = 0; i < paths_.size(); ++i) {
    if (!paths_[i]) continue;
    const std::vector<std::int32_t> own = add(*paths_[i], static_cast<Half>(static_cast<int>(i) - 1), vertices);
    cheaper.insert(cheaper.end(), own.begin(), own.end());
  }
  return cheaper;
}

const TurningPaths& SlitFinder::paths_to(std::int32_t vertex) const {
  if (!problem_.reflection) return paths_in(Half::kAny);
  const TurningPaths& paths = paths_in(static_cast<Half>(problem_.reflection->sides[vertex]));
  // Edges across the mirror plane leave places on it without a path in it. Pieces that are not symmetric themselves
  // have places without a path on their side.
  return std::isfinite(paths.price(vertex)) ? paths : paths_in(Half::kAny);
}

double SlitFinder::price_to(std::int32_t vertex) const { return paths_to(vertex).price(vertex); }

std::optional<Slit> SlitFinder::slit_to(std::int32_t vertex) const {
  const TurningPaths& paths = paths_to(vertex);
  Slit slit{.path = paths.path(vertex), .image = {}};
  if (slit.path.size() < 2) return std::nullopt;
  const std::optional<TurningPaths>& anywhere = paths_.back();
  const bool is_any = anywhere && &paths == &*anywhere;
  if (!is_any) slit.image = mirrored_path(problem_, slit.path, is_on_cut_, task_);
  return slit;
}

}  // namespace seamwire::detail
