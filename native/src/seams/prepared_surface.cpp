// SPDX-License-Identifier: GPL-3.0-or-later
#include "seams/prepared_surface.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numeric>
#include <optional>
#include <unordered_map>
#include <utility>

#include "detail/index.hpp"
#include "detail/poll.hpp"
#include "prices/visibility.hpp"
#include "seams/piece_groups.hpp"
#include "simplified/decimation.hpp"
#include "tuning/constants.hpp"

namespace seamwire::detail {
namespace {

/// The values at some vertices; 0 in the place of -1.
Visibility at_places(const Visibility& from, std::span<const std::int32_t> vertices) {
  Visibility found;
  for (const std::int32_t v : vertices) {
    found.ambient.push_back(v < 0 ? 0.0 : from.ambient[v]);
    if (!from.front.empty()) found.front.push_back(v < 0 ? 0.0 : from.front[v]);
  }
  return found;
}

/// The edges on the boundary and along seams, vertices of the surface.
Rim rim_of(const PlanMesh& mesh, const std::vector<Edge>& seams, const Task& task) {
  const std::vector<std::uint8_t> is_seam = marked_edges(mesh, seams, task);
  std::vector<Edge> rim;
  for (std::int32_t e = 0; index(e) < mesh.edge_count(); ++e) {
    const std::int32_t h = mesh.half_edge_of[e];
    if (is_seam[e] != 0 || mesh.is_boundary(e)) rim.push_back({mesh.sources[mesh.tail(h)], mesh.sources[mesh.tip(h)]});
  }
  return Rim(std::move(rim));
}

}  // namespace

PreparedSurface::PreparedSurface(const SurfaceContext& context, SeamPlannerOptions with, const Task& task)
    : surface(context.surface(task)), options(std::move(with)) {
  const double meshes_end = (options.along == Along::kSurface) ? 0.25 : 0.5;
  find_meshes(part_of(task, 0.0, meshes_end));
  const Visibility visibility = visibility_of_all(part_of(task, meshes_end, 2.0 * meshes_end));
  const Task rest = part_of(task, 2.0 * meshes_end, 1.0);
  find_prices_of_all(visibility, rest);
  join_copies(rest);
  wires = std::make_unique<const PlannedWires>(context, options.along, options.strength,
                                               rim_of(mesh(), options.seams, rest), rest);
}

std::vector<double> PreparedSurface::weights_of(const PlanMesh& mesh) const {
  std::vector<double> weights;
  if (options.weights.empty()) return weights;
  for (const std::int32_t v : mesh.sources) weights.push_back(options.weights[v]);
  return weights;
}

/// Finds the groups and their meshes.
void PreparedSurface::find_meshes(const Task& task) {
  whole = plan_mesh(*surface, task);
  std::vector<std::uint8_t> is_seam = marked_edges(whole, options.seams, task);
  std::optional<Reflection> reflection;
  if (options.mirror >= 0) reflection = find_reflection(whole, options.mirror, part_of(task, 0.0, 0.2));
  MeshParts parts(whole, is_seam, surface->edges());
  std::vector<PieceGroup> found =
      find_groups(whole, is_seam, reflection ? &*reflection : nullptr, parts, part_of(task, 0.2, 0.3));
  const std::size_t all = whole.face_count();
  std::size_t done = 0;
  for (PieceGroup& piece_group : found) {
    GroupProblem& group = groups.emplace_back();
    const std::size_t count = piece_group.faces.size();
    group.original.reflection = std::move(piece_group.reflection);
    if (count == all) {
      std::vector<std::int32_t> vertices(whole.vertex_count());
      std::iota(vertices.begin(), vertices.end(), 0);
      group.places.push_back({std::move(vertices), std::move(piece_group.faces)});
      group.original.mesh = std::move(whole);
      group.original.is_seam = std::move(is_seam);
      whole = {};
    } else {
      MeshPart part = parts.part(piece_group.faces);
      group.size = part.size;
      group.places.push_back({std::move(part.vertices), std::move(piece_group.faces)});
      group.original.mesh = std::move(part.mesh);
      group.original.is_seam = std::move(part.is_seam);
    }
    if (piece_group.image) group.places.push_back(std::move(*piece_group.image));
    const Task own = part_of(task, 0.3 + 0.7 * static_cast<double>(done) / static_cast<double>(all),
                             0.3 + 0.7 * static_cast<double>(done + count) / static_cast<double>(all));
    done += count;
    const std::size_t share = std::max(tuning::kSimplified * count / all, tuning::kLeastSimplified);
    group.is_large = all > tuning::kMostTriangles && count * tuning::kSimplified > share * tuning::kMostTriangles;
    if (group.is_large) add_simplified(group, share, part_of(own, 0.0, 0.7));
    const std::size_t half = group.searched().mesh.face_count() / 2;
    if (half >= tuning::kLeastSimplified) add_simplified(group, half, part_of(own, 0.7, 1.0));
  }
}

/// Adds a level with about so many triangles to a group, without prices.
void PreparedSurface::add_simplified(GroupProblem& group, std::size_t triangles, const Task& task) const {
  const SlitProblem& original = group.original;
  const SlitProblem& finer = group.level_count() > 0 ? group.searched(group.level_count() - 1) : original;
  DecimatedMesh decimated = decimate(finer.mesh, finer.is_seam, finer.mirror(), triangles, task);
  GroupProblem::Simplified simple{.problem = {}, .vertices = std::move(decimated.vertices)};
  simple.problem.mesh = std::move(decimated.mesh);
  simple.problem.is_seam = std::move(decimated.is_seam);
  if (original.reflection) {
    simple.problem.reflection = reflection_in(simple.problem.mesh, options.mirror, original.reflection->offset,
                                              diagonal_of(simple.problem.mesh), task);
  }
  if (!group.simplified.empty()) {
    for (std::int32_t& v : simple.vertices) v = group.simplified.back().vertices[v];
  }
  group.simplified.push_back(std::move(simple));
}

/// The visibility of the vertices of the finest mesh on which each group is searched, one group after another, then of
/// mirror images.
Visibility PreparedSurface::visibility_of_all(const Task& task) const {
  if (whole.triangles.empty()) {
    return groups.empty() ? Visibility() : find_visibility(groups.front().searched().mesh, options.front, task);
  }
  PlanMesh all;
  std::vector<double> sizes;
  const auto add = [&](const PlanMesh& own, double size, const auto& at) {
    const auto first = static_cast<std::int32_t>(all.points.size());
    for (std::int32_t v = 0; index(v) < own.vertex_count(); ++v) all.points.push_back(at(v));
    for (const auto& [a, b, c] : own.triangles) all.triangles.push_back({first + a, first + b, first + c});
    sizes.resize(all.points.size(), size);
  };
  for (const GroupProblem& group : groups) {
    const PlanMesh& own = group.searched().mesh;
    add(own, group.size, [&](std::int32_t v) { return Vector(group.size * own.points[v]); });
  }
  // Copies and mirror images hide others, but need no prices.
  for (const GroupProblem& group : groups) {
    const PlanMesh& own = group.searched().mesh;
    for (std::size_t k = 1; k < group.places.size(); ++k) {
      const GroupProblem::Simplified* simple = group.simplified_at(0);
      const auto vertex = [&](std::int32_t v) { return simple != nullptr ? simple->vertices[v] : v; };
      add(own, group.size, [&](std::int32_t v) { return whole.points[group.places[k].vertices[vertex(v)]]; });
    }
  }
  return find_visibility(all, options.front, task, sizes);
}

void PreparedSurface::find_prices_of_all(const Visibility& visibility, const Task& task) {
  std::size_t begin = 0;
  const auto part = [&](const std::vector<double>& values, std::size_t count) {
    if (values.empty()) return values;
    const auto first = values.begin() + static_cast<std::ptrdiff_t>(begin);
    return std::vector<double>(first, first + static_cast<std::ptrdiff_t>(count));
  };
  for (GroupProblem& group : groups) {
    const PlanMesh& mesh = group.searched().mesh;
    Visibility own{.front = part(visibility.front, mesh.vertex_count()),
                   .ambient = part(visibility.ambient, mesh.vertex_count())};
    begin += mesh.vertex_count();
    SlitProblem& original = group.original;
    if (group.is_large) own = at_places(own, nearest_of(original.mesh, group.simplified.front().vertices, task));
    for (GroupProblem::Simplified& simple : group.simplified) {
      SlitProblem& problem = simple.problem;
      problem.prices = find_prices(problem.mesh, at_places(own, simple.vertices), problem.reflection,
                                   weights_of(problem.mesh), task);
    }
    original.prices = find_prices(original.mesh, own, original.reflection, weights_of(original.mesh), task);
  }
}

/// Makes one group of those that are alike, and finds the pieces of each.
void PreparedSurface::join_copies(const Task& task) {
  constexpr double kSameSize = 1e-6;
  const auto is_same_size = [](double one, double other) { return std::abs(one - other) <= kSameSize * one; };
  std::unordered_map<std::uint64_t, std::vector<std::size_t>> by_likeness;
  std::vector<GroupProblem> joined;
  for (GroupProblem& group : groups) {
    task.check(0.0);
    std::vector<std::size_t>& candidates = by_likeness[groups.size() > 1 ? likeness(group.original) : 0];
    const auto like = std::ranges::find_if(candidates, [&](std::size_t other) {
      return is_same_size(joined[other].size, group.size) && are_alike(joined[other].original, group.original);
    });
    if (like != candidates.end()) {
      std::ranges::move(group.places, std::back_inserter(joined[*like].places));
      continue;
    }
    candidates.push_back(joined.size());
    joined.push_back(std::move(group));
  }
  groups = std::move(joined);
  for (GroupProblem& group : groups) {
    find_pieces_of(group.original, task);
    for (GroupProblem::Simplified& simple : group.simplified) find_pieces_of(simple.problem, task);
  }
}

}  // namespace seamwire::detail
