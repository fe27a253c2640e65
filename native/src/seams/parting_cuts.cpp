// SPDX-License-Identifier: GPL-3.0-or-later
#include "seams/parting_cuts.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <utility>

#include "detail/disjoint_sets.hpp"
#include "detail/index.hpp"
#include "seams/minimum_cut.hpp"
#include "seams/piece_body.hpp"

namespace seamwire::detail {
namespace {

constexpr std::size_t kManyCorners = 16;                // of a rim
constexpr double kLeastRegion = 2e-3;                   // of the area of its piece
constexpr double kFlatBelow = 1.5, kSharpAbove = 30.0;  // degrees
constexpr double kSafeShare = 0.3;                      // of a piece, which a halving cut leaves at each end

/// Marked edges as slits that have to stay. Chains end where more or fewer than two of the edges meet. Closed chains
/// are divided into parts that can be carried to another mesh.
std::vector<Slit> slits_along(const PlanMesh& mesh, std::vector<std::uint8_t> is_marked) {
  constexpr std::size_t kParts = 4;
  const auto degree = [&](std::int32_t v) {
    return std::ranges::count_if(mesh.neighbors[v],
                                 [&](const PlanNeighbor& next) { return is_marked[next.edge] != 0; });
  };
  std::vector<std::uint8_t> is_node(mesh.vertex_count(), 0);
  for (std::int32_t v = 0; index(v) < mesh.vertex_count(); ++v) is_node[v] = degree(v) == 2 ? 0 : 1;
  std::vector<Slit> slits;
  const auto follow = [&](std::int32_t from) {
    std::vector<std::int32_t> chain{from};
    for (bool goes_on = true; goes_on;) {
      goes_on = false;
      for (const PlanNeighbor& next : mesh.neighbors[chain.back()]) {
        if (is_marked[next.edge] == 0) continue;
        is_marked[next.edge] = 0;
        chain.push_back(next.vertex);
        goes_on = is_node[next.vertex] == 0 && next.vertex != from;
        break;
      }
    }
    const std::size_t edges = chain.size() - 1;
    const std::size_t parts = chain.front() == chain.back() ? std::min(kParts, edges) : 1;
    for (std::size_t part = 0; part < parts; ++part) {
      const auto at = [&](std::size_t i) { return chain.begin() + static_cast<std::ptrdiff_t>(i * edges / parts); };
      slits.push_back({.path = {at(part), at(part + 1) + 1}, .image = {}, .is_needed = true});
    }
  };
  for (const bool is_closed : {false, true}) {
    for (std::int32_t v = 0; index(v) < mesh.vertex_count(); ++v) {
      while ((is_closed || is_node[v] != 0) && degree(v) > 0) follow(v);
    }
  }
  return slits;
}

/// Marks the rims of regions in some pieces. Triangles on both sides of an edge belong to the same region if the
/// surface bends there by less than `degrees`.
void mark_rims(const SlitProblem& problem, std::span<const std::int32_t> pieces, double degrees,
               std::vector<std::uint8_t>& is_marked) {
  const PlanMesh& mesh = problem.mesh;
  const std::vector<FaceFrame> frames = face_frames(mesh);
  const double least_cosine = std::cos(degrees * std::numbers::pi / 180.0);
  DisjointSets regions(mesh.face_count());
  for (const std::int32_t p : pieces) {
    const SlitProblem::Piece& piece = problem.by_piece[p];
    std::vector<std::int32_t> inner;  // half-edges between two triangles of the piece
    for (const std::int32_t f : piece.faces) {
      for (std::int32_t h = 3 * f; h < 3 * f + 3; ++h) {
        const std::int32_t twin = mesh.twins[h], edge = mesh.edge_of[h];
        if (twin < h || problem.is_seam[edge] != 0) continue;
        inner.push_back(h);
        const bool is_smooth = frames[f].normal.dot(frames[twin / 3].normal) > least_cosine;
        if (is_smooth || problem.prices.of_edge[edge] == kNever) regions.join(f, twin / 3);
      }
    }
    std::vector<double> areas(mesh.face_count(), 0.0);
    std::vector<std::size_t> corners(mesh.face_count(), 0);
    for (const std::int32_t f : piece.faces) areas[regions.find(f)] += problem.areas[f];
    for (const std::int32_t h : inner) {
      const std::int32_t one = regions.find(h / 3), other = regions.find(mesh.twins[h] / 3);
      if (one == other) continue;
      ++corners[one];
      ++corners[other];
    }
    const auto is_large = [&](std::int32_t region) {
      return corners[region] >= kManyCorners && areas[region] >= kLeastRegion * piece.area;
    };
    for (const std::int32_t h : inner) {
      const std::int32_t one = regions.find(h / 3), other = regions.find(mesh.twins[h] / 3);
      if (one != other && (is_large(one) || is_large(other))) is_marked[mesh.edge_of[h]] = 1;
    }
  }
}

/// The two ends of a piece, own vertices far from each other. On the mirror plane if that crosses the piece, so that a
/// cut between them is symmetric.
std::pair<std::int32_t, std::int32_t> ends_of(const SlitProblem& problem, const PieceBody& body) {
  std::vector<std::int32_t> choice(body.island.vertices.size());
  std::iota(choice.begin(), choice.end(), 0);
  if (problem.reflection) {
    std::vector<std::int32_t> on_plane;
    for (const std::int32_t own : choice) {
      if (problem.reflection->sides[body.island.vertices[own]] == 0) on_plane.push_back(own);
    }
    if (on_plane.size() > 1) choice = std::move(on_plane);
  }
  const auto farthest = [&](std::int32_t from) {
    const std::vector<double> away = body.graph.distances_from(from);
    return *std::ranges::max_element(choice, {}, [&](std::int32_t own) { return away[own]; });
  };
  const std::int32_t first = farthest(choice.front());
  return {first, farthest(first)};
}

/// Marks the mirror images of marked edges that lie in a piece.
void mark_images(const SlitProblem& problem, std::int32_t piece, std::vector<std::uint8_t>& is_marked) {
  const PlanMesh& mesh = problem.mesh;
  const std::vector<std::uint8_t> own = is_marked;
  for (std::int32_t e = 0; index(e) < mesh.edge_count(); ++e) {
    if (own[e] == 0) continue;
    const std::int32_t image = image_of_edge(mesh, *problem.reflection, e);
    if (image >= 0 && problem.pieces.of_face[mesh.half_edge_of[image] / 3] == piece) is_marked[image] = 1;
  }
}

/// The piece that is the mirror image of another one; -1 if the piece has no image or is its own.
std::int32_t image_of(const SlitProblem& problem, std::int32_t piece) {
  if (!problem.reflection || !problem.reflection->is_exact) return -1;
  const PlanMesh& mesh = problem.mesh;
  for (const std::int32_t f : problem.by_piece[piece].faces) {
    for (std::int32_t h = 3 * f; h < 3 * f + 3; ++h) {
      if (mesh.twins[h] < 0 || problem.is_seam[mesh.edge_of[h]] != 0) continue;
      const std::int32_t image = image_of_edge(mesh, *problem.reflection, mesh.edge_of[h]);
      if (image < 0) continue;
      const std::int32_t other = problem.pieces.of_face[mesh.half_edge_of[image] / 3];
      return other == piece ? -1 : other;
    }
  }
  return -1;
}

/// Like mark_half(), but without the mirror image.
bool mark_one_half(const SlitProblem& problem, std::int32_t number, std::vector<std::uint8_t>& is_marked) {
  const PlanMesh& mesh = problem.mesh;
  const PieceBody body(problem, number);
  const Island& island = body.island;
  const auto count = static_cast<std::int32_t>(island.triangles.size());
  const auto edge_of = [&](std::int32_t h) { return mesh.edge_of[3 * island.faces[h / 3] + h % 3]; };
  // Triangles that no seam may part are one block.
  DisjointSets blocks(island.triangles.size());
  for (std::int32_t h = 0; h < 3 * count; ++h) {
    if (island.twins[h] > h && problem.prices.of_edge[edge_of(h)] == kNever) blocks.join(h / 3, island.twins[h] / 3);
  }
  const auto [first, last] = ends_of(problem, body);
  const std::vector<double> from_first = body.graph.distances_from(first), from_last = body.graph.distances_from(last);
  std::vector<double> areas(island.triangles.size(), 0.0), places(island.triangles.size(), 0.0);
  std::vector<std::int32_t> order;
  for (std::int32_t k = 0; k < count; ++k) {
    const std::int32_t block = blocks.find(k);
    if (block == k) order.push_back(k);
    const double area = std::max(problem.areas[island.faces[k]], 1e-12);
    for (const std::int32_t own : island.triangles[k]) places[block] += area / 3.0 * (from_first[own] - from_last[own]);
    areas[block] += area;
  }
  if (order.size() < 2) return false;
  const double all = std::accumulate(areas.begin(), areas.end(), 0.0);
  std::ranges::stable_sort(order, {}, [&](std::int32_t block) { return places[block] / areas[block]; });
  const std::int32_t source = count, sink = count + 1;
  MinimumCut network(island.triangles.size() + 2);
  const double never = 1e6;
  double before = 0.0;
  for (std::size_t i = 0; i < order.size(); ++i) {
    const double after = all - before - areas[order[i]];
    if (i == 0 || (i + 1 < order.size() && before + areas[order[i]] <= kSafeShare * all)) {
      network.add(source, order[i], never);
    } else if (i + 1 == order.size() || after + areas[order[i]] <= kSafeShare * all) {
      network.add(order[i], sink, never);
    }
    before += areas[order[i]];
  }
  for (std::int32_t h = 0; h < 3 * count; ++h) {
    if (island.twins[h] < h) continue;
    const std::int32_t one = blocks.find(h / 3), other = blocks.find(island.twins[h] / 3);
    if (one != other) network.add(one, other, problem.prices.of_edge[edge_of(h)]);
  }
  const std::vector<std::uint8_t> side = network.source_side(source, sink);
  // The largest connected part of the other side. The rest of the piece is connected too.
  DisjointSets parts(island.triangles.size());
  for (std::int32_t h = 0; h < 3 * count; ++h) {
    const std::int32_t twin = island.twins[h];
    if (twin > h && side[blocks.find(h / 3)] == side[blocks.find(twin / 3)]) parts.join(h / 3, twin / 3);
  }
  std::vector<double> sizes(island.triangles.size(), 0.0);
  for (std::int32_t k = 0; k < count; ++k) sizes[parts.find(k)] += problem.areas[island.faces[k]];
  std::int32_t source_part = -1, part = -1;
  for (std::int32_t k = 0; k < count; ++k) {
    std::int32_t& best = side[blocks.find(k)] != 0 ? source_part : part;
    if (parts.find(k) == k && (best < 0 || sizes[k] > sizes[best])) best = k;
  }
  if (source_part < 0 || part < 0) return false;
  DisjointSets rest(island.triangles.size());
  for (std::int32_t h = 0; h < 3 * count; ++h) {
    const std::int32_t twin = island.twins[h];
    if (twin > h && parts.find(h / 3) != source_part && parts.find(twin / 3) != source_part) rest.join(h / 3, twin / 3);
  }
  for (std::int32_t h = 0; h < 3 * count; ++h) {
    const std::int32_t twin = island.twins[h];
    const auto is_in = [&](std::int32_t k) { return rest.find(k) == rest.find(part); };
    if (twin > h && is_in(h / 3) != is_in(twin / 3)) is_marked[edge_of(h)] = 1;
  }
  return true;
}

}  // namespace

std::vector<Slit> rim_cuts(const SlitProblem& problem, std::span<const std::int32_t> pieces) {
  std::vector<std::uint8_t> is_marked(problem.mesh.edge_count(), 0);
  for (const double degrees : {kFlatBelow, kSharpAbove}) mark_rims(problem, pieces, degrees, is_marked);
  return slits_along(problem.mesh, std::move(is_marked));
}

std::size_t count_blocks(const SlitProblem& problem) {
  const PlanMesh& mesh = problem.mesh;
  DisjointSets blocks(mesh.face_count());
  std::size_t count = mesh.face_count();
  for (std::int32_t h = 0; index(h) < mesh.twins.size(); ++h) {
    const std::int32_t edge = mesh.edge_of[h];
    if (mesh.twins[h] < h || problem.is_seam[edge] != 0 || problem.prices.of_edge[edge] != kNever) continue;
    if (blocks.join(h / 3, mesh.twins[h] / 3)) --count;
  }
  return count;
}

bool mark_half(const SlitProblem& problem, std::int32_t piece, std::vector<std::uint8_t>& is_marked) {
  if (!mark_one_half(problem, piece, is_marked)) return false;
  const std::int32_t image = image_of(problem, piece);
  if (image >= 0) mark_images(problem, image, is_marked);
  return true;
}

std::vector<Slit> halving_cuts(SlitProblem problem, std::size_t count, const Task& task) {
  std::vector<std::uint8_t> is_marked(problem.mesh.edge_count(), 0);
  while (index(problem.pieces.count) < count) {
    task.check(0.0);
    std::vector<std::int32_t> order(problem.by_piece.size());
    std::iota(order.begin(), order.end(), 0);
    std::ranges::stable_sort(order, std::ranges::greater(), [&](std::int32_t p) { return problem.by_piece[p].area; });
    if (std::ranges::none_of(order, [&](std::int32_t p) { return mark_half(problem, p, is_marked); })) break;
    for (std::size_t e = 0; e < is_marked.size(); ++e) problem.is_seam[e] |= is_marked[e];
    find_pieces_of(problem);
  }
  return slits_along(problem.mesh, std::move(is_marked));
}

}  // namespace seamwire::detail
