// SPDX-License-Identifier: GPL-3.0-or-later
#include "slits/slit_finder.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "detail/index.hpp"
#include "detail/infinity.hpp"

namespace seamwire::detail {
namespace {

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
    if (next < 0 || (!image.empty() && problem.mesh.edge_between(image.back(), next) < 0)) return {};
    image.push_back(next);
  }
  return image;
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

std::vector<std::int32_t> mirrored_path(const SlitProblem& problem, std::span<const std::int32_t> path,
                                        std::span<const std::uint8_t> is_on_cut) {
  constexpr double kSpread = 0.02;  // in a mesh of area 1: edges farther from the mirrored line are long
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
  for (const std::int32_t v : part) line.push_back(reflection.mirrored(problem.mesh.points[v]));
  const std::int32_t from = starts_on_plane ? part.front() : nearest_on_cut(problem.mesh, is_on_cut, line.front());
  const std::int32_t to = reflection.images[part.back()];
  if (from < 0 || to < 0 || from == to || barred[to] != 0) return {};
  const double most_away = 2.0 * std::max(kSpread, median_length(problem.mesh));
  if ((problem.mesh.points[from] - line.front()).norm() > most_away) return {};  // the cut is elsewhere
  std::vector<std::int32_t> image = chain_along(problem.mesh, line, kSpread, from, to, barred, problem.prices);
  if (is_clear(image)) return image;
  return {};
}

SlitFinder::SlitFinder(const SlitProblem& problem, std::span<const std::uint8_t> from,
                       std::span<const std::uint8_t> is_on_cut, double exponent, std::vector<std::uint8_t> barred_edges)
    : problem_(problem),
      from_(from.begin(), from.end()),
      is_on_cut_(is_on_cut.begin(), is_on_cut.end()),
      exponent_(exponent),
      barred_edges_(std::move(barred_edges)) {}

const SlitPaths& SlitFinder::paths_in(Half half) const {
  std::optional<SlitPaths>& paths = paths_[index(static_cast<std::int32_t>(half) + 1)];
  if (!paths) {
    paths.emplace(problem_.mesh, problem_.prices, half == Half::kAny ? nullptr : problem_.mirror(), from_,
                  problem_.is_rim,
                  SlitPaths::Rules{.half = half, .exponent = exponent_, .barred_edges = barred_edges_});
  }
  return *paths;
}

const SlitPaths& SlitFinder::paths_to(std::int32_t vertex) const {
  if (!problem_.reflection) return paths_in(Half::kAny);
  const SlitPaths& paths = paths_in(static_cast<Half>(problem_.reflection->sides[vertex]));
  // Edges across the mirror plane leave places on it without a path in it. Pieces that are not symmetric themselves
  // have places without a path on their side.
  return std::isfinite(paths.price(vertex)) ? paths : paths_in(Half::kAny);
}

double SlitFinder::price_to(std::int32_t vertex) const { return paths_to(vertex).price(vertex); }

std::optional<Slit> SlitFinder::slit_to(std::int32_t vertex) const {
  const SlitPaths& paths = paths_to(vertex);
  Slit slit{.path = paths.path(vertex), .image = {}};
  if (slit.path.size() < 2) return std::nullopt;
  const std::optional<SlitPaths>& anywhere = paths_.back();
  const bool is_any = anywhere && &paths == &*anywhere;
  if (!is_any) slit.image = mirrored_path(problem_, slit.path, is_on_cut_);
  return slit;
}

}  // namespace seamwire::detail
