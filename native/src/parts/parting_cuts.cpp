// SPDX-License-Identifier: GPL-3.0-or-later
#include "parts/parting_cuts.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <utility>

#include "detail/disjoint_sets.hpp"
#include "detail/edge_chains.hpp"
#include "detail/index.hpp"
#include "detail/poll.hpp"
#include "parts/halving.hpp"
#include "surface/joined_faces.hpp"
#include "tuning/constants.hpp"

namespace seamwire::detail {
namespace {

/// Marked edges as slits that have to stay. Chains end where more or fewer than two of the edges meet. Closed chains
/// are divided into parts that can be carried to another mesh.
std::vector<Slit> slits_along(const PlanMesh& mesh, std::span<const std::uint8_t> is_marked) {
  constexpr std::size_t kParts = 4;
  std::vector<Edge> marked;
  for (std::int32_t e = 0; index(e) < mesh.edge_count(); ++e) {
    if (is_marked[e] == 0 || mesh.is_real[e] == 0) continue;
    marked.push_back({mesh.tail(mesh.half_edge_of[e]), mesh.tip(mesh.half_edge_of[e])});
  }
  std::vector<Slit> slits;
  EdgeChains chains(mesh.vertex_count(), marked);
  for (const std::vector<std::int32_t>& chain : chains.all([](std::int32_t) { return false; })) {
    const std::size_t edges = chain.size() - 1;
    const std::size_t parts = chain.front() == chain.back() ? std::min(kParts, edges) : 1;
    for (std::size_t part = 0; part < parts; ++part) {
      const auto at = [&](std::size_t i) { return chain.begin() + static_cast<std::ptrdiff_t>(i * edges / parts); };
      slits.push_back({.path = {at(part), at(part + 1) + 1}, .image = {}, .is_needed = true});
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
        if (is_smooth || problem.prices.of_edge[edge] == kInfinity) regions.join(f, twin / 3);
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
      return corners[region] >= tuning::kManyCorners && areas[region] >= tuning::kLeastRimmed * piece.area;
    };
    for (const std::int32_t h : inner) {
      const std::int32_t one = regions.find(h / 3), other = regions.find(mesh.twins[h] / 3);
      if (one != other && (is_large(one) || is_large(other))) is_marked[mesh.edge_of[h]] = 1;
    }
  }
}

}  // namespace

std::vector<Slit> rim_cuts(const SlitProblem& problem, std::span<const std::int32_t> pieces) {
  std::vector<std::uint8_t> is_marked(problem.mesh.edge_count(), 0);
  for (const double degrees : {tuning::kFlatBelow, tuning::kHardSharp}) mark_rims(problem, pieces, degrees, is_marked);
  return slits_along(problem.mesh, is_marked);
}

std::size_t count_blocks(const SlitProblem& problem) {
  DisjointSets blocks = joined_faces(problem.mesh, [&](std::int32_t h) {
    const std::int32_t edge = problem.mesh.edge_of[h];
    return problem.is_seam[edge] == 0 && problem.prices.of_edge[edge] == kInfinity;
  });
  return index(blocks.numbering().count);
}

std::vector<Slit> halving_cuts(SlitProblem problem, std::size_t count, const Task& task) {
  std::vector<std::uint8_t> is_marked(problem.mesh.edge_count(), 0);
  const Task own = part_of(task, 0.0, 0.0);
  while (index(problem.pieces.count) < count) {
    std::vector<std::int32_t> order(problem.by_piece.size());
    std::iota(order.begin(), order.end(), 0);
    std::ranges::stable_sort(order, std::ranges::greater(), [&](std::int32_t p) { return problem.by_piece[p].area; });
    if (std::ranges::none_of(order, [&](std::int32_t p) { return mark_half(problem, p, is_marked, own); })) break;
    for (std::size_t e = 0; e < is_marked.size(); ++e) problem.is_seam[e] |= is_marked[e];
    find_pieces_of(problem);
  }
  return slits_along(problem.mesh, is_marked);
}

}  // namespace seamwire::detail
