// SPDX-License-Identifier: GPL-3.0-or-later
#include "slits/piece_body.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "tuning/constants.hpp"

namespace seamwire::detail {
namespace {

Island first_island(const SlitProblem& problem, std::int32_t number) {
  const SlitProblem::Piece& piece = problem.by_piece[number];
  std::vector<std::uint8_t> is_cut(piece.twins.size(), 0);
  for (std::size_t k = 0; k < piece.faces.size(); ++k) {
    for (std::size_t i = 0; i < 3; ++i) {
      is_cut[3 * k + i] = problem.is_seam[problem.mesh.edge_of[3 * static_cast<std::size_t>(piece.faces[k]) + i]];
    }
  }
  Island island = std::move(cut_open(piece, is_cut).front());
  for (std::int32_t& face : island.faces) face = piece.faces[face];
  return island;
}

}  // namespace

PieceBody::PieceBody(const SlitProblem& problem, std::int32_t piece)
    : size(std::sqrt(problem.by_piece[piece].area)),
      island(first_island(problem, piece)),
      graph(island, problem.mesh.points) {
  for (const std::vector<std::int32_t>& loop : island.boundaries()) {
    std::vector<std::int32_t> vertices;
    for (const std::int32_t own : loop) vertices.push_back(island.vertices[own]);
    loops.push_back(std::move(vertices));
  }
}

std::int64_t PieceBody::genus() const { return (2 - island.euler_characteristic() - std::ssize(loops)) / 2; }

std::int32_t onto_plane(const SlitProblem& problem, const PieceBody& body, std::int32_t tip) {
  const Reflection& reflection = *problem.reflection;
  if (reflection.sides[tip] == 0) return tip;
  std::int32_t nearest = tip;
  double least = tuning::kTipToPlane * body.size;
  for (const std::int32_t v : body.island.vertices) {
    if (reflection.sides[v] != 0) continue;
    const double distance = (problem.mesh.points[v] - problem.mesh.points[tip]).norm();
    if (distance < least) {
      least = distance;
      nearest = v;
    }
  }
  return nearest;
}

std::vector<std::int32_t> find_tips(const SlitProblem& problem, const PieceBody& body,
                                    std::span<const double> distances) {
  std::vector<std::int32_t> vertices = body.island.vertices;
  std::ranges::sort(vertices);
  std::vector<std::int32_t> tips;
  for (const std::int32_t own : body.graph.peaks(distances, tuning::kTipProminence * body.size)) {
    std::int32_t tip = body.island.vertices[own];
    if (problem.reflection) {
      tip = onto_plane(problem, body, tip);
      const std::int32_t image = problem.reflection->images[tip];
      if (problem.reflection->sides[tip] < 0 && std::ranges::binary_search(vertices, image)) tip = image;
    }
    if (std::ranges::find(tips, tip) == tips.end()) tips.push_back(tip);
  }
  return tips;
}

}  // namespace seamwire::detail
