// SPDX-License-Identifier: GPL-3.0-or-later
#include "seams/cut_pieces.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <limits>
#include <numeric>
#include <tuple>
#include <utility>

#include "detail/half_edge.hpp"
#include "detail/index.hpp"
#include "surface/exact_unit.hpp"

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

/// Both sides of each edge where the half-edge mesh is cut open because its triangles do not agree on a side.
std::vector<std::pair<std::int32_t, std::int32_t>> unorientable_sides(const Surface& surface) {
  const std::vector<Edge>& edges = surface.report().unorientable_edges;
  std::vector<std::pair<std::int32_t, std::int32_t>> sides(edges.size(), {-1, -1});
  if (edges.empty()) return sides;
  for (std::int32_t h = 0; index(h) < surface.twins().size(); ++h) {
    if (surface.twins()[h] >= 0) continue;
    const Triangle& fans = surface.face_fans()[h / 3];
    const Edge edge = sorted(surface.vertex_of_fan()[fans[h % 3]], surface.vertex_of_fan()[fans[(h + 1) % 3]]);
    const auto found = std::ranges::lower_bound(edges, edge);
    if (found == edges.end() || *found != edge) continue;
    auto& [one, other] = sides[static_cast<std::size_t>(found - edges.begin())];
    (one < 0 ? one : other) = h;
  }
  return sides;
}

/// The same piece, facing the other way; see CutPieces::piece_sets_.
std::int32_t turned(std::int32_t side) { return side ^ 1; }

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
  struct CutSide {
    std::int32_t cut, half_edge, twin;
    bool is_turned;
  };
  std::vector<CutSide> cut_sides, glued_sides;  // glued: where no chain cuts, but triangles do not agree on a side
  std::vector<std::int32_t> inner;              // half-edges of edges glued at first, one each
  for (std::int32_t h = 0; index(h) < twins.size(); ++h) {
    const std::int32_t twin = twins[h];
    if (twin < h) continue;
    if (const auto cut = find_cut(h); cut != cuts.end()) {
      cut_sides.push_back({static_cast<std::int32_t>(cut - cuts.begin()), h, twin, false});
      continue;
    }
    inner.push_back(h);
    faces.join(h / 3, twin / 3);
    corners.join(h, next_in_face(twin));
    corners.join(next_in_face(h), twin);
  }
  for (const auto& [h, twin] : unorientable_sides(surface)) {
    const auto cut = find_cut(h);
    (cut != cuts.end() ? cut_sides : glued_sides)
        .push_back({static_cast<std::int32_t>(cut - cuts.begin()), h, twin, true});
  }
  std::size_t corner_count = 0;
  std::vector<std::int32_t> set_of_corner;
  std::tie(piece_of_face_, piece_count_) = numbered(faces, fans.size());
  std::tie(set_of_corner, corner_count) = numbered(corners, 3 * fans.size());
  piece_sets_ = DisjointSets(2 * piece_count_);
  corner_sets_ = DisjointSets(corner_count);

  pieces_.assign(piece_count_, Piece{.max_spread = std::numeric_limits<double>::infinity()});
  const double unit = exact_unit(surface);
  std::vector<std::uint8_t> is_counted(corner_count, 0);
  for (std::size_t f = 0; f < fans.size(); ++f) {
    Piece& piece = pieces_[piece_of_face_[f]];
    const std::int32_t face = surface.face_of_half_edge_face()[f];
    const Triangle& t = fans[f];
    const auto point = [&](std::size_t i) -> const Vector& { return surface.points()[surface.vertex_of_fan()[t[i]]]; };
    const Vector normal = 0.5 * (unit * (point(1) - point(0))).cross(unit * (point(2) - point(0)));
    piece.area += normal.norm();
    piece.normal += normal;
    piece.max_spread = std::min(piece.max_spread, max_spreads[face]);
    piece.euler += 1 - 3;  // a face with three sides of its own
    piece.border += 3;
    for (std::size_t i = 0; i < 3; ++i) {
      std::uint8_t& counted = is_counted[set_of_corner[3 * f + i]];
      if (counted == 0) ++piece.euler;
      counted = 1;
    }
  }
  for (const std::int32_t h : inner) {
    Piece& piece = pieces_[piece_of_face_[h / 3]];
    ++piece.euler;
    piece.border -= 2;
  }

  std::ranges::sort(cut_sides, {}, [](const CutSide& side) { return std::pair(side.cut, side.half_edge); });
  for (const std::vector<CutSide>* sides : {&cut_sides, &glued_sides}) {
    for (const CutSide& side : *sides) {
      edges_.push_back(edge_between(side.half_edge, side.twin, side.is_turned, set_of_corner));
    }
  }
  std::vector<std::int32_t> glued(glued_sides.size());
  std::iota(glued.begin(), glued.end(), static_cast<std::int32_t>(cut_sides.size()));
  glue(glued, joined_by(glued));

  // Two edges may join the same two vertices, so a cut may have several.
  edges_of_chain_.reserve(chains.size(), edges_.size());
  for (const std::vector<std::int32_t>& chain : chains) {
    std::vector<std::int32_t> own;
    for (std::size_t i = 1; i < chain.size(); ++i) {
      const auto cut = static_cast<std::int32_t>(
          std::lower_bound(cuts.begin(), cuts.end(), sorted(chain[i - 1], chain[i])) - cuts.begin());
      auto side = std::ranges::lower_bound(cut_sides, cut, {}, &CutSide::cut);
      for (; side != cut_sides.end() && side->cut == cut; ++side) {
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

CutPieces::CutEdge CutPieces::edge_between(std::int32_t half_edge, std::int32_t twin, bool is_turned,
                                           std::span<const std::int32_t> set_of_corner) const {
  const auto corner = [&](std::int32_t of) { return set_of_corner[index(of)]; };
  const std::int32_t across_tail = is_turned ? twin : next_in_face(twin);
  const std::int32_t across_tip = is_turned ? next_in_face(twin) : twin;
  return {.pieces = {piece_of_face_[half_edge / 3], piece_of_face_[twin / 3]},
          .tails = {corner(half_edge), corner(across_tail)},
          .tips = {corner(next_in_face(half_edge)), corner(across_tip)},
          .is_turned = is_turned,
          .covered = 0};
}

std::vector<CutPieces::Joined> CutPieces::joined_without(std::int32_t chain) const {
  return joined_by(glued_without(chain));
}

std::vector<CutPieces::Joined> CutPieces::joined_by(std::span<const std::int32_t> glued) const {
  std::vector<std::int32_t> sides, ends;  // two sides an edge, as they are and turned over: four numbers
  for (const std::int32_t e : glued) {
    const CutEdge& edge = edges_[e];
    for (std::size_t i = 0; i < 2; ++i) {
      const std::int32_t side = piece_sets_.find(2 * edge.pieces[i] + (i == 1 && edge.is_turned ? 1 : 0));
      sides.insert(sides.end(), {side, turned(side)});
      ends.push_back(corner_sets_.find(edge.tails[i]));
      ends.push_back(corner_sets_.find(edge.tips[i]));
    }
  }
  FewSets groups(sides), corners(ends);
  for (std::size_t i = 0; i < sides.size(); i += 4) {
    groups.join(sides[i], sides[i + 2]);
    groups.join(sides[i + 1], sides[i + 3]);
  }
  std::vector<Joined> all;
  std::vector<std::size_t> place(groups.numbers().size());
  for (std::size_t i = 0; i < groups.numbers().size(); i += 2) {
    const std::int32_t name = groups.numbers()[i] / 2;
    const std::size_t first = groups.find(i);
    if (first == i) {
      place[i] = all.size();
      all.push_back({.piece = {.max_spread = std::numeric_limits<double>::infinity()},
                     .smallest = std::numeric_limits<double>::infinity(),
                     .name = name});
    }
    place[i + 1] = place[i] = place[first - first % 2];
    Joined& joined = all[place[i]];
    const Piece& piece = pieces_[name];
    ++joined.pieces;
    joined.piece.euler += piece.euler;
    joined.piece.border += piece.border;
    joined.piece.area += piece.area;
    joined.piece.normal += first % 2 == 0 ? piece.normal : Vector(-piece.normal);
    joined.piece.max_spread = std::min(joined.piece.max_spread, piece.max_spread);
    joined.smallest = std::min(joined.smallest, piece.area);
  }
  for (std::size_t i = 0; i < glued.size(); ++i) {
    Piece& piece = all[place[groups.place(sides[4 * i])]].piece;
    ++piece.euler;
    piece.border -= 2;
    for (const std::size_t end : {4 * i, 4 * i + 1}) piece.euler -= corners.join(ends[end], ends[end + 2]) ? 1 : 0;
  }
  return all;
}

void CutPieces::glue(std::span<const std::int32_t> glued, std::span<const Joined> joined) {
  for (const std::int32_t e : glued) {
    const CutEdge& edge = edges_[e];
    const std::int32_t one = 2 * edge.pieces[0], other = 2 * edge.pieces[1] + (edge.is_turned ? 1 : 0);
    if (set_of(edge.pieces[0]) != set_of(edge.pieces[1])) --piece_count_;
    piece_sets_.join(one, other);
    piece_sets_.join(turned(one), turned(other));
    corner_sets_.join(edge.tails[0], edge.tails[1]);
    corner_sets_.join(edge.tips[0], edge.tips[1]);
  }
  for (const Joined& one : joined) pieces_[set_of(one.name)] = one.piece;
}

std::vector<CutPieces::Joined> CutPieces::remove(std::int32_t chain) {
  const std::vector<std::int32_t> glued = glued_without(chain);
  std::vector<Joined> all = joined_by(glued);
  for (const std::int32_t e : edges_of_chain_[chain]) --edges_[e].covered;
  glue(glued, all);
  return all;
}

bool CutPieces::touches(std::int32_t chain, std::int32_t other, std::span<const Joined> joined) const {
  const std::span<const std::int32_t> others = edges_of_chain_[other];
  const auto is_joined = [&](std::int32_t piece) {
    return std::ranges::any_of(joined, [&](const Joined& one) { return set_of(one.name) == set_of(piece); });
  };
  return std::ranges::any_of(edges_of_chain_[chain], [&](std::int32_t e) {
    return std::ranges::any_of(edges_[e].pieces, is_joined) || std::ranges::binary_search(others, e);
  });
}

bool CutPieces::has_beside(std::int32_t chain, double less_than) const {
  return std::ranges::any_of(edges_of_chain_[chain], [&](std::int32_t e) {
    return std::ranges::any_of(edges_[e].pieces, [&](std::int32_t p) { return pieces_[set_of(p)].area < less_than; });
  });
}

std::vector<Piece> CutPieces::pieces() const {
  std::vector<Piece> all;
  for (std::int32_t p = 0; index(p) < pieces_.size(); ++p) {
    if (set_of(p) == p) all.push_back(pieces_[p]);
  }
  return all;
}

std::vector<std::int32_t> CutPieces::piece_of_faces() const {
  std::vector<std::int32_t> places(pieces_.size(), -1), found;
  std::int32_t next = 0;
  for (std::int32_t p = 0; index(p) < pieces_.size(); ++p) {
    places[p] = set_of(p) == p ? next++ : places[set_of(p)];  // a set is named after its first piece
  }
  found.reserve(piece_of_face_.size());
  for (const std::int32_t piece : piece_of_face_) found.push_back(places[piece]);
  return found;
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
    const std::int32_t piece = set_of(piece_of_face_[f]);
    if (pieces_[piece].is_disc() || (worst >= 0 && !(pieces_[piece].area > pieces_[worst].area))) continue;
    if (std::ranges::all_of(corners_of(f), [&](std::int32_t v) { return among[v] != 0; })) worst = piece;
  }
  if (worst < 0) return {};
  std::vector<std::uint8_t> is_inside(surface.vertex_count(), 0);
  for (std::size_t f = 0; f < piece_of_face_.size(); ++f) {
    if (set_of(piece_of_face_[f]) != worst) continue;
    for (const std::int32_t v : corners_of(f)) is_inside[v] = 1;
  }
  return is_inside;
}

}  // namespace seamwire
