// SPDX-License-Identifier: GPL-3.0-or-later
#include "seams/cut_pieces.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <limits>
#include <tuple>
#include <utility>

#include "detail/half_edge.hpp"
#include "detail/index.hpp"

namespace seamwire {
namespace {

Edge sorted(std::int32_t a, std::int32_t b) { return {std::min(a, b), std::max(a, b)}; }

/// The edges of all chains, each once, in order.
std::vector<Edge> edges_of(std::span<const std::vector<std::int32_t>> chains) {
  std::vector<Edge> edges;
  for (const std::vector<std::int32_t>& chain : chains) {
    for (std::size_t i = 1; i < chain.size(); ++i) edges.push_back(sorted(chain[i - 1], chain[i]));
  }
  std::sort(edges.begin(), edges.end());
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
  return edges;
}

/// A number for each set, in the order of their names, and per element.
std::pair<std::vector<std::int32_t>, std::size_t> numbered(DisjointSets& sets, std::size_t count) {
  std::vector<std::int32_t> numbers(count);
  std::int32_t next = 0;
  // A set is named after its least number, which comes first.
  for (std::int32_t i = 0; index(i) < count; ++i) {
    const std::int32_t name = sets.find(i);
    numbers[i] = name == i ? next++ : numbers[name];
  }
  return {std::move(numbers), index(next)};
}

/// Sets of some numbers only.
class FewSets {
 public:
  explicit FewSets(std::vector<std::int32_t> numbers) : numbers_(std::move(numbers)), sets_(0) {
    std::sort(numbers_.begin(), numbers_.end());
    numbers_.erase(std::unique(numbers_.begin(), numbers_.end()), numbers_.end());
    sets_ = DisjointSets(numbers_.size());
  }
  bool join(std::int32_t a, std::int32_t b) { return sets_.join(at(a), at(b)); }
  /// Ascending.
  const std::vector<std::int32_t>& numbers() const { return numbers_; }
  /// Where one of them is there.
  std::size_t place(std::int32_t number) const { return index(at(number)); }
  /// The place of the first one that is in a set with that at a place.
  std::size_t find(std::size_t place) { return index(sets_.find(static_cast<std::int32_t>(place))); }

 private:
  std::int32_t at(std::int32_t number) const {
    return static_cast<std::int32_t>(std::lower_bound(numbers_.begin(), numbers_.end(), number) - numbers_.begin());
  }

  std::vector<std::int32_t> numbers_;
  DisjointSets sets_;
};

}  // namespace

CutPieces::CutPieces(const Surface& surface, std::span<const std::vector<std::int32_t>> chains,
                     std::span<const double> max_spreads)
    : piece_sets_(0), corner_sets_(0) {
  const std::vector<Triangle>& fans = surface.face_fans();
  const std::vector<std::int32_t>& twins = surface.twins();
  const auto vertex = [&](std::int32_t h) { return surface.vertex_of_fan()[fans[h / 3][h % 3]]; };

  const std::vector<Edge> cuts = edges_of(chains);
  std::vector<std::uint8_t> is_touched(surface.vertex_count(), 0);
  for (const auto& [a, b] : cuts) is_touched[a] = is_touched[b] = 1;
  const auto find_cut = [&](std::int32_t h) {
    const std::int32_t a = vertex(h), b = vertex(next_in_face(h));
    if (is_touched[a] == 0 || is_touched[b] == 0) return cuts.end();
    const auto found = std::lower_bound(cuts.begin(), cuts.end(), sorted(a, b));
    return found != cuts.end() && *found == sorted(a, b) ? found : cuts.end();
  };

  DisjointSets faces(fans.size()), corners(3 * fans.size());
  std::vector<std::pair<std::int32_t, std::int32_t>> cut_sides;  // a cut's number and one of its half-edges
  std::vector<std::int32_t> inner;                               // half-edges of edges glued at first, one each
  for (std::int32_t h = 0; index(h) < twins.size(); ++h) {
    const std::int32_t twin = twins[h];
    if (twin < h) continue;
    if (const auto cut = find_cut(h); cut != cuts.end()) {
      cut_sides.emplace_back(static_cast<std::int32_t>(cut - cuts.begin()), h);
      continue;
    }
    inner.push_back(h);
    faces.join(h / 3, twin / 3);
    corners.join(h, next_in_face(twin));
    corners.join(next_in_face(h), twin);
  }
  std::size_t corner_count = 0;
  std::vector<std::int32_t> set_of_corner;
  std::tie(piece_of_face_, piece_count_) = numbered(faces, fans.size());
  std::tie(set_of_corner, corner_count) = numbered(corners, 3 * fans.size());
  piece_sets_ = DisjointSets(piece_count_);
  corner_sets_ = DisjointSets(corner_count);

  pieces_.assign(piece_count_, Piece{.max_spread = std::numeric_limits<double>::infinity()});
  std::vector<std::uint8_t> is_counted(corner_count, 0);
  for (std::size_t f = 0; f < fans.size(); ++f) {
    Piece& piece = pieces_[piece_of_face_[f]];
    const std::int32_t face = surface.face_of_half_edge_face()[f];
    const Triangle& t = fans[f];
    const auto point = [&](std::size_t i) -> const Vector& { return surface.points()[surface.vertex_of_fan()[t[i]]]; };
    const Vector normal = 0.5 * (point(1) - point(0)).cross(point(2) - point(0));
    piece.area += normal.norm();
    piece.normal += normal;
    piece.max_spread = std::min(piece.max_spread, max_spreads[face]);
    piece.euler += 1 - 3;  // a face with three sides of its own
    for (std::size_t i = 0; i < 3; ++i) {
      std::uint8_t& counted = is_counted[set_of_corner[3 * f + i]];
      if (counted == 0) ++piece.euler;
      counted = 1;
    }
  }
  for (const std::int32_t h : inner) ++pieces_[piece_of_face_[h / 3]].euler;

  std::sort(cut_sides.begin(), cut_sides.end());
  for (const auto& [cut, h] : cut_sides) {
    const std::int32_t twin = twins[h];
    const auto corner = [&](std::int32_t of) { return set_of_corner[of]; };
    edges_.push_back({.pieces = {piece_of_face_[h / 3], piece_of_face_[twin / 3]},
                      .tails = {corner(h), corner(next_in_face(twin))},
                      .tips = {corner(next_in_face(h)), corner(twin)},
                      .covered = 0});
  }
  // Two edges may join the same two vertices, so a cut may have several.
  edges_of_chain_.reserve(chains.size(), edges_.size());
  for (const std::vector<std::int32_t>& chain : chains) {
    std::vector<std::int32_t> own;
    for (std::size_t i = 1; i < chain.size(); ++i) {
      const auto cut = static_cast<std::int32_t>(
          std::lower_bound(cuts.begin(), cuts.end(), sorted(chain[i - 1], chain[i])) - cuts.begin());
      auto side = std::lower_bound(cut_sides.begin(), cut_sides.end(), std::pair(cut, std::int32_t{-1}));
      for (; side != cut_sides.end() && side->first == cut; ++side) {
        own.push_back(static_cast<std::int32_t>(side - cut_sides.begin()));
      }
    }
    std::sort(own.begin(), own.end());
    own.erase(std::unique(own.begin(), own.end()), own.end());
    for (const std::int32_t e : own) {
      edges_of_chain_.push(e);
      ++edges_[e].covered;
    }
    edges_of_chain_.end_row();
  }
}

std::vector<std::int32_t> CutPieces::glued_without(std::int32_t chain) const {
  std::vector<std::int32_t> glued;
  for (const std::int32_t e : edges_of_chain_[chain]) {
    if (edges_[e].covered == 1) glued.push_back(e);
  }
  return glued;
}

std::vector<CutPieces::Joined> CutPieces::joined_without(std::int32_t chain) const {
  const std::vector<std::int32_t> glued = glued_without(chain);
  std::vector<std::int32_t> sides, ends;
  for (const std::int32_t e : glued) {
    const CutEdge& edge = edges_[e];
    for (std::size_t i = 0; i < 2; ++i) {
      sides.push_back(piece_sets_.find(edge.pieces[i]));
      ends.push_back(corner_sets_.find(edge.tails[i]));
      ends.push_back(corner_sets_.find(edge.tips[i]));
    }
  }
  FewSets groups(sides), corners(ends);
  for (std::size_t i = 0; i < sides.size(); i += 2) groups.join(sides[i], sides[i + 1]);
  std::vector<Joined> all;
  std::vector<std::size_t> place(groups.numbers().size());
  for (std::size_t i = 0; i < groups.numbers().size(); ++i) {
    const std::size_t first = groups.find(i);
    if (first == i) {
      place[i] = all.size();
      all.push_back({.piece = {.max_spread = std::numeric_limits<double>::infinity()},
                     .smallest = std::numeric_limits<double>::infinity(),
                     .name = groups.numbers()[i]});
    }
    Joined& joined = all[place[first]];
    const Piece& piece = pieces_[groups.numbers()[i]];
    ++joined.pieces;
    joined.piece.euler += piece.euler;
    joined.piece.area += piece.area;
    joined.piece.normal += piece.normal;
    joined.piece.max_spread = std::min(joined.piece.max_spread, piece.max_spread);
    joined.smallest = std::min(joined.smallest, piece.area);
  }
  for (std::size_t i = 0; i < glued.size(); ++i) {
    std::int64_t& euler = all[place[groups.find(groups.place(sides[2 * i]))]].piece.euler;
    ++euler;
    for (const std::size_t end : {4 * i, 4 * i + 1}) euler -= corners.join(ends[end], ends[end + 2]) ? 1 : 0;
  }
  return all;
}

std::vector<CutPieces::Joined> CutPieces::remove(std::int32_t chain) {
  std::vector<Joined> all = joined_without(chain);
  const std::vector<std::int32_t> glued = glued_without(chain);
  for (const std::int32_t e : edges_of_chain_[chain]) --edges_[e].covered;
  for (const std::int32_t e : glued) {
    const CutEdge& edge = edges_[e];
    if (piece_sets_.join(edge.pieces[0], edge.pieces[1])) --piece_count_;
    corner_sets_.join(edge.tails[0], edge.tails[1]);
    corner_sets_.join(edge.tips[0], edge.tips[1]);
  }
  for (const Joined& joined : all) pieces_[piece_sets_.find(joined.name)] = joined.piece;
  return all;
}

bool CutPieces::touches(std::int32_t chain, std::int32_t other, std::span<const Joined> joined) const {
  const std::span<const std::int32_t> others = edges_of_chain_[other];
  const auto is_joined = [&](std::int32_t piece) {
    return std::ranges::any_of(
        joined, [&](const Joined& one) { return piece_sets_.find(one.name) == piece_sets_.find(piece); });
  };
  return std::ranges::any_of(edges_of_chain_[chain], [&](std::int32_t e) {
    return std::ranges::any_of(edges_[e].pieces, is_joined) || std::ranges::binary_search(others, e);
  });
}

bool CutPieces::has_beside(std::int32_t chain, double less_than) const {
  return std::ranges::any_of(edges_of_chain_[chain], [&](std::int32_t e) {
    return std::ranges::any_of(edges_[e].pieces,
                               [&](std::int32_t p) { return pieces_[piece_sets_.find(p)].area < less_than; });
  });
}

std::vector<Piece> CutPieces::pieces() const {
  std::vector<Piece> all;
  for (std::int32_t p = 0; index(p) < pieces_.size(); ++p) {
    if (piece_sets_.find(p) == p) all.push_back(pieces_[p]);
  }
  return all;
}

std::vector<std::uint8_t> CutPieces::vertices_of_worst(const Surface& surface,
                                                       std::span<const std::uint8_t> among) const {
  const auto corners_of = [&](std::size_t f) {
    Triangle corners = surface.face_fans()[f];
    for (std::int32_t& corner : corners) corner = surface.vertex_of_fan()[corner];
    return corners;
  };
  std::int32_t worst = -1;
  for (std::size_t f = 0; f < piece_of_face_.size(); ++f) {
    const std::int32_t piece = piece_sets_.find(piece_of_face_[f]);
    if (pieces_[piece].is_disc() || (worst >= 0 && !(pieces_[piece].area > pieces_[worst].area))) continue;
    if (std::ranges::all_of(corners_of(f), [&](std::int32_t v) { return among[v] != 0; })) worst = piece;
  }
  if (worst < 0) return {};
  std::vector<std::uint8_t> is_inside(surface.vertex_count(), 0);
  for (std::size_t f = 0; f < piece_of_face_.size(); ++f) {
    if (piece_sets_.find(piece_of_face_[f]) != worst) continue;
    for (const std::int32_t v : corners_of(f)) is_inside[v] = 1;
  }
  return is_inside;
}

}  // namespace seamwire
