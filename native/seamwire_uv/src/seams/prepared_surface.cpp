// SPDX-License-Identifier: GPL-3.0-or-later
#include "seams/prepared_surface.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <numeric>
#include <optional>
#include <unordered_map>
#include <utility>

#include "decimation/decimation.hpp"
#include "detail/index.hpp"
#include "detail/poll.hpp"
#include "prices/edge_prices.hpp"
#include "seamwire/errors.hpp"
#include "tuning/constants.hpp"

namespace seamwire::detail {
namespace {

constexpr double kSameLength = 1e-6;  // of edges in parts of area 1
constexpr double kSamePrice = 1e-6;   // of edges, as a share
constexpr double kSamePlace = 1e-5;   // of an exact mirror image, in roots of a part's area

/// The face whose corners are the mirror images of a face's corners; -1 without one.
std::int32_t exact_image(const PlanMesh& mesh, const Reflection& reflection, std::int32_t f) {
  const auto& [a, b, c] = mesh.triangles[f];
  std::int32_t one = reflection.images[a], two = reflection.images[b];
  const std::int32_t three = reflection.images[c];
  if (one < 0 || two < 0 || three < 0) return -1;
  if (mesh.all_neighbors[two].size() < mesh.all_neighbors[one].size()) std::swap(one, two);
  for (const PlanNeighbor& next : mesh.all_neighbors[one]) {
    if (next.vertex != two) continue;
    const std::int32_t h = mesh.half_edge_of[next.edge];
    for (const std::int32_t side : {h, mesh.twins[h]}) {
      if (side >= 0 && mesh.apex(side) == three) return side / 3;
    }
  }
  return -1;
}

/// How often the mirror images of one piece lie in another.
class Votes {
 public:
  Votes(const PlanMesh& mesh, const Pieces& pieces, const Reflection& reflection, const Task& task)
      : mesh_(mesh), pieces_(pieces), reflection_(reflection), counts_(index(pieces.count)) {
    const Poll poll(task);
    for (std::int32_t f = 0; index(f) < mesh.face_count(); ++f) {
      poll.at(index(f));
      const std::int32_t image = image_of(f);
      if (image >= 0) ++counts_[pieces.of_face[f]][pieces.of_face[image]];
    }
  }

  /// The piece in which most images of a piece lie; -1 without one.
  std::int32_t image_of_piece(std::int32_t piece) const {
    std::int32_t best = -1, most = 0;
    for (const auto& [other, count] : counts_[piece]) {
      if (count > most) {
        most = count;
        best = other;
      }
    }
    return best;
  }

 private:
  /// A face at the mirror image of a face.
  std::int32_t image_of(std::int32_t f) const {
    const std::int32_t exact = exact_image(mesh_, reflection_, f);
    const std::int32_t corner = reflection_.images[mesh_.triangles[f][0]];
    if (exact >= 0 || corner < 0 || mesh_.all_neighbors[corner].empty()) return exact;
    return mesh_.half_edge_of[mesh_.all_neighbors[corner].begin()->edge] / 3;
  }

  const PlanMesh& mesh_;
  const Pieces& pieces_;
  const Reflection& reflection_;
  std::vector<std::map<std::int32_t, std::int32_t>> counts_;
};

std::vector<std::vector<std::int32_t>> faces_by(std::span<const std::int32_t> labels, std::int32_t count) {
  std::vector<std::vector<std::int32_t>> faces(index(count));
  for (std::int32_t f = 0; index(f) < labels.size(); ++f) faces[labels[f]].push_back(f);
  return faces;
}

/// The mirror image of a part of a mesh, if it has the same triangles, seams and shape.
std::optional<Place> image_of_part(const PlanMesh& whole, std::span<const std::uint8_t> is_seam,
                                   const Reflection& reflection, const MeshPart& part,
                                   std::span<const std::int32_t> faces, std::span<const std::int32_t> image_faces,
                                   const Task& task) {
  if (faces.size() != image_faces.size()) return std::nullopt;
  Poll poll(task);
  Place place{.vertices = {}, .faces = {}, .is_mirrored = true};
  for (const std::int32_t v : part.vertices) {
    const std::int32_t image = reflection.images[v];
    if (image < 0 || reflection.images[image] != v) return std::nullopt;
    const double away = (reflection.mirrored(whole.points[v]) - whole.points[image]).norm();
    if (!(away <= kSamePlace * part.size)) return std::nullopt;
    place.vertices.push_back(image);
  }
  for (const std::int32_t f : faces) {
    poll.next();
    const std::int32_t image = exact_image(whole, reflection, f);
    if (!std::ranges::binary_search(image_faces, image)) return std::nullopt;
    place.faces.push_back(image);
  }
  for (std::int32_t e = 0; index(e) < part.mesh.edge_count(); ++e) {
    poll.next();
    const std::int32_t h = part.mesh.half_edge_of[e];
    const std::int32_t image = whole.edge_between(place.vertices[part.mesh.tail(h)], place.vertices[part.mesh.tip(h)]);
    if (part.mesh.is_real[e] == 0 || image < 0) {
      if (part.mesh.is_real[e] != 0 || image >= 0) return std::nullopt;
      continue;
    }
    if (part.mesh.twins[h] >= 0 && part.is_seam[e] != is_seam[image]) return std::nullopt;
  }
  return place;
}

bool is_same_price(double one, double other) {
  return one == other || std::abs(one - other) <= kSamePrice * std::max(std::abs(one), std::abs(other));
}

}  // namespace

MeshParts::MeshParts(const PlanMesh& whole, std::span<const std::uint8_t> is_seam, std::span<const Edge> real_edges)
    : whole_(whole),
      is_seam_(is_seam),
      real_edges_(real_edges),
      vertex_(whole.vertex_count(), -1),
      face_(whole.face_count(), -1) {}

MeshPart MeshParts::part(std::span<const std::int32_t> faces, const Task& task) {
  const Poll poll(task);
  MeshPart part;
  PlanMesh& mesh = part.mesh;
  for (std::size_t k = 0; k < faces.size(); ++k) face_[faces[k]] = static_cast<std::int32_t>(k);
  double area = 0.0;
  for (std::size_t k = 0; k < faces.size(); ++k) {
    poll.at(k);
    const std::int32_t f = faces[k];
    Triangle own{};
    const Triangle& given = whole_.triangles[f];
    for (std::size_t i = 0; i < 3; ++i) {
      std::int32_t& number = vertex_[given[i]];
      if (number < 0) {
        number = static_cast<std::int32_t>(part.vertices.size());
        part.vertices.push_back(given[i]);
        mesh.sources.push_back(whole_.sources[given[i]]);
      }
      own[i] = number;
    }
    mesh.triangles.push_back(own);
    mesh.faces.push_back(whole_.faces[f]);
    for (std::int32_t i = 0; i < 3; ++i) {
      const std::int32_t twin = whole_.twins[3 * f + i];
      const bool is_inside = twin >= 0 && face_[twin / 3] >= 0;
      mesh.twins.push_back(is_inside ? 3 * face_[twin / 3] + twin % 3 : -1);
    }
    const auto corner = [&](std::size_t i) -> const Vector& { return whole_.points[given[i]]; };
    area += 0.5 * (corner(1) - corner(0)).cross(corner(2) - corner(0)).norm();
  }
  if (area > 0.0) part.size = std::sqrt(area);
  mesh.scale = whole_.scale / part.size;
  for (const std::int32_t v : part.vertices) mesh.points.push_back(whole_.points[v] / part.size);
  connect(mesh, real_edges_, task);
  for (const std::int32_t h : mesh.half_edge_of) {
    const std::int32_t edge = whole_.edge_of[3 * faces[index(h / 3)] + h % 3];
    part.is_seam.push_back(mesh.twins[h] >= 0 ? is_seam_[edge] : std::uint8_t{0});
  }
  for (const std::int32_t f : faces) face_[f] = -1;
  for (const std::int32_t v : part.vertices) vertex_[v] = -1;
  return part;
}

std::vector<PieceGroup> find_groups(const PlanMesh& whole, std::span<const std::uint8_t> is_seam,
                                    const Reflection* reflection, MeshParts& parts, const Task& task) {
  const Pieces pieces = find_pieces(whole, is_seam, task);
  const std::vector<std::vector<std::int32_t>> by_piece = faces_by(pieces.of_face, pieces.count);
  std::vector<PieceGroup> groups;
  if (reflection == nullptr || pieces.count < 2) {
    for (const auto& faces : by_piece) groups.push_back({.faces = faces});
    if (reflection != nullptr && !groups.empty()) groups.front().reflection = *reflection;
    return groups;
  }
  const Votes votes(whole, pieces, *reflection, task);
  const Poll poll(task, 0.0, 1.0, index(pieces.count), Poll::kFewSteps);
  for (std::int32_t p = 0; p < pieces.count; ++p) {
    poll.at(index(p));
    const std::int32_t image = votes.image_of_piece(p);
    const bool is_pair = image >= 0 && image != p && votes.image_of_piece(image) == p;
    if (is_pair && image < p) continue;  // comes with its image
    PieceGroup group{.faces = by_piece[p]};
    const MeshPart own = parts.part(by_piece[p], task);
    double diagonal = diagonal_of(own.mesh) * own.size;
    if (is_pair) {
      group.image = image_of_part(whole, is_seam, *reflection, own, by_piece[p], by_piece[image], task);
      if (group.image) {
        groups.push_back(std::move(group));
        continue;
      }
      const MeshPart other = parts.part(by_piece[image], task);
      diagonal = std::max(diagonal, diagonal_of(other.mesh) * other.size);
      group.faces.insert(group.faces.end(), by_piece[image].begin(), by_piece[image].end());
      std::ranges::sort(group.faces);
    }
    if ((is_pair || image == p) && diagonal > 0.0) {
      const MeshPart part = parts.part(group.faces, task);
      group.reflection =
          reflection_in(part.mesh, reflection->axis, reflection->offset / part.size, diagonal / part.size, task);
    }
    if (is_pair && !group.reflection) {
      groups.push_back({.faces = by_piece[p]});
      groups.push_back({.faces = by_piece[image]});
    } else {
      groups.push_back(std::move(group));
    }
  }
  std::ranges::sort(groups, {}, [](const PieceGroup& group) { return group.faces.front(); });
  return groups;
}

bool are_alike(const SlitProblem& one, const SlitProblem& other) {
  if (one.mesh->triangles != other.mesh->triangles || one.mesh->twins != other.mesh->twins) return false;
  if (one.is_seam != other.is_seam || one.mesh->is_real != other.mesh->is_real) return false;
  if (one.prices.is_exposed != other.prices.is_exposed || one.reflection.has_value() != other.reflection.has_value()) {
    return false;
  }
  if (one.reflection &&
      (one.reflection->images != other.reflection->images || one.reflection->sides != other.reflection->sides ||
       one.reflection->is_exact != other.reflection->is_exact)) {
    return false;
  }
  for (std::size_t e = 0; e < one.mesh->edge_count(); ++e) {
    if (!(std::abs(one.mesh->lengths[e] - other.mesh->lengths[e]) <= kSameLength)) return false;
    if (!is_same_price(one.prices.of_edge[e], other.prices.of_edge[e])) return false;
  }
  return true;
}

std::uint64_t likeness(const SlitProblem& problem) {
  constexpr double kCoarse =
      1e3;  // like problems with a value near the limit between two numbers are told apart, which only costs time
  std::uint64_t hash = 14695981039346656037U;
  const auto add = [&](std::uint64_t value) { hash = (hash ^ value) * 1099511628211U; };
  add(problem.mesh->face_count());
  for (const Triangle& t : problem.mesh->triangles) {
    for (const std::int32_t v : t) add(static_cast<std::uint64_t>(v));
  }
  for (const double length : problem.mesh->lengths) {
    add(static_cast<std::uint64_t>(std::floor(kCoarse * std::min(length, 1e12) + 0.31)));
  }
  for (const double price : problem.prices.of_edge) {
    add(price == kInfinity ? 0 : static_cast<std::uint64_t>(std::floor(kCoarse * std::min(price, 1e12) + 0.31)));
  }
  return hash;
}

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
                                               rim_of(*mesh, options.seams, rest), options.weights, rest);
}

/// The weights at vertices of the surface.
std::vector<double> PreparedSurface::weights_at(std::span<const std::int32_t> vertices) const {
  std::vector<double> weights;
  if (options.weights.empty()) return weights;
  for (const std::int32_t v : vertices) weights.push_back(options.weights[v]);
  return weights;
}

/// Finds the groups and their meshes.
void PreparedSurface::find_meshes(const Task& task) {
  mesh = std::make_shared<const PlanMesh>(plan_mesh(*surface, task));
  const PlanMesh& whole = *mesh;
  if (!whole.triangles.empty() && !have_area(whole, whole.triangles)) {
    throw InvalidInput("the surface has no area: all its triangles are points or lines");
  }
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
      group.original.mesh = mesh;
      group.original.is_seam = std::move(is_seam);
    } else {
      MeshPart part = parts.part(piece_group.faces, task);
      group.size = part.size;
      group.places.push_back({std::move(part.vertices), std::move(piece_group.faces)});
      group.original.mesh = std::make_shared<const PlanMesh>(std::move(part.mesh));
      group.original.is_seam = std::move(part.is_seam);
    }
    if (piece_group.image) group.places.push_back(std::move(*piece_group.image));
    const Task own = part_of(task, 0.3 + 0.7 * static_cast<double>(done) / static_cast<double>(all),
                             0.3 + 0.7 * static_cast<double>(done + count) / static_cast<double>(all));
    done += count;
    const std::size_t share = std::max(tuning::kSimplified * count / all, tuning::kLeastSimplified);
    group.is_large = all > tuning::kMostTriangles && count * tuning::kSimplified > share * tuning::kMostTriangles;
    if (group.is_large) add_simplified(group, share, part_of(own, 0.0, 0.7));
    const std::size_t half = group.searched().mesh->face_count() / 2;
    // On a large surface the maps of the original mesh would take most of the time of a second search.
    if (!group.is_large && half >= tuning::kLeastSimplified) add_simplified(group, half, part_of(own, 0.7, 1.0));
  }
}

/// Adds a level with about so many triangles to a group, without prices.
void PreparedSurface::add_simplified(GroupProblem& group, std::size_t triangles, const Task& task) const {
  const SlitProblem& original = group.original;
  const SlitProblem& finer = group.level_count() > 0 ? group.searched(group.level_count() - 1) : original;
  DecimatedMesh decimated = decimate(*finer.mesh, finer.is_seam, finer.mirror(), triangles, task);
  GroupProblem::Simplified simple{.problem = {}, .vertices = std::move(decimated.vertices)};
  simple.problem.mesh = std::make_shared<const PlanMesh>(std::move(decimated.mesh));
  simple.problem.is_seam = std::move(decimated.is_seam);
  if (original.reflection) {
    simple.problem.reflection = reflection_in(*simple.problem.mesh, options.mirror, original.reflection->offset,
                                              diagonal_of(*simple.problem.mesh), task);
  }
  if (!group.simplified.empty()) {
    for (std::int32_t& v : simple.vertices) v = group.simplified.back().vertices[v];
  }
  group.simplified.push_back(std::move(simple));
}

/// The visibility of the vertices of the finest mesh on which each group is searched, one group after another, then of
/// mirror images.
Visibility PreparedSurface::visibility_of_all(const Task& task) const {
  if (groups.empty()) return {};
  if (groups.front().original.mesh == mesh) {
    return find_visibility(*groups.front().searched().mesh, options.front, task);
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
    const PlanMesh& own = *group.searched().mesh;
    add(own, group.size, [&](std::int32_t v) { return Vector(group.size * own.points[v]); });
  }
  // Copies and mirror images hide others, but need no prices.
  for (const GroupProblem& group : groups) {
    const PlanMesh& own = *group.searched().mesh;
    for (std::size_t k = 1; k < group.places.size(); ++k) {
      const GroupProblem::Simplified* simple = group.simplified_at(0);
      const auto vertex = [&](std::int32_t v) { return simple != nullptr ? simple->vertices[v] : v; };
      add(own, group.size, [&](std::int32_t v) { return mesh->points[group.places[k].vertices[vertex(v)]]; });
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
    const std::size_t count = group.searched().mesh->vertex_count();
    Visibility own{.front = part(visibility.front, count), .ambient = part(visibility.ambient, count)};
    begin += count;
    SlitProblem& original = group.original;
    if (group.is_large) own = at_places(own, nearest_of(*original.mesh, group.simplified.front().vertices, task));
    for (GroupProblem::Simplified& simple : group.simplified) {
      SlitProblem& problem = simple.problem;
      problem.prices = find_prices(*problem.mesh, at_places(own, simple.vertices), problem.reflection,
                                   weights_at(problem.mesh->sources), task);
    }
    original.prices = find_prices(*original.mesh, own, original.reflection, weights_at(original.mesh->sources), task);
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
