// SPDX-License-Identifier: GPL-3.0-or-later
#include "seamwire/seams/missing_cuts.hpp"

#include <algorithm>
#include <limits>
#include <string>

#include "detail/index.hpp"
#include "seams/cut_pieces.hpp"

namespace seamwire {

std::vector<std::int32_t> missing_cuts(const Surface& surface, std::span<const Edge> cut_edges,
                                       std::span<const std::int32_t> segments) {
  if (segments.size() != surface.face_count()) {
    throw InvalidInput("segments has " + std::to_string(segments.size()) + " items: there are " +
                       std::to_string(surface.face_count()) + " triangles");
  }
  std::int32_t count = 0;
  for (const std::int32_t segment : segments) {
    check_index(segment, segments.size(), "segments: number", "triangles");
    count = std::max(count, segment + 1);
  }
  std::vector<std::vector<std::int32_t>> chains;
  chains.reserve(cut_edges.size());
  for (const auto& [a, b] : cut_edges) {
    for (const std::int32_t v : {a, b}) check_index(v, surface.vertex_count(), "cut_edges: vertex");
    if (std::ranges::binary_search(surface.edges(), Edge{std::min(a, b), std::max(a, b)})) chains.push_back({a, b});
  }
  const std::vector<double> no_limits(surface.face_count(), std::numeric_limits<double>::infinity());
  const CutPieces cut(surface, chains, no_limits);
  const std::vector<Piece> pieces = cut.pieces();
  const std::vector<std::int32_t> piece_of_faces = cut.piece_of_faces();
  std::vector<std::int32_t> missing(index(count), 0), segment_of(pieces.size(), -1);
  for (std::size_t f = 0; f < piece_of_faces.size(); ++f) {
    const std::int32_t segment = segments[index(surface.face_of_half_edge_face()[f])];
    std::int32_t& known = segment_of[piece_of_faces[f]];
    if (known < 0) {
      known = segment;
      missing[segment] += static_cast<std::int32_t>(pieces[piece_of_faces[f]].missing_cuts());
    } else if (known != segment) {
      throw InvalidInput("segments: they are those of other cuts");
    }
  }
  return missing;
}

}  // namespace seamwire
