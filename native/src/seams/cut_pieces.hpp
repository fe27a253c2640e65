// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "detail/csr.hpp"
#include "detail/disjoint_sets.hpp"
#include "seamwire/surface/surface.hpp"

namespace seamwire {

/// A piece of a surface: what it takes to tell whether it is a disc, and a flat one.
struct Piece {
  std::int64_t euler = 0;          ///< Euler characteristic; 1: it is a disc
  double area = 0.0;               ///< in the caller's units squared
  Vector normal = Vector::Zero();  ///< sum of the triangles' area normals
  double max_spread = 0.0;         ///< the least that is allowed to one of its triangles

  bool is_disc() const { return euler == 1; }
  /// How far its normals spread, see SeamLimits.
  double spread() const { return area > 0.0 ? 1.0 - normal.norm() / area : 0.0; }
};

/// The pieces into which chains of edges cut a surface, and what becomes of them where a chain is taken away.
///
/// Cut open, the surface has a vertex for each set of corners that hang together. Gluing two sides of an edge takes one
/// edge away, and the vertices that it unites; so the Euler characteristic follows without walking over the piece.
class CutPieces {
 public:
  /// `chains`: vertices, none twice in a row; edges that are not of two triangles of the half-edge mesh cut nothing.
  /// `max_spreads`: one a triangle of the caller's.
  CutPieces(const Surface& surface, std::span<const std::vector<std::int32_t>> chains,
            std::span<const double> max_spreads);

  /// Pieces that a chain parts, joined.
  struct Joined {
    Piece piece;
    std::size_t pieces = 0;  ///< how many; 1: the chain is a cut that ends within it
    double smallest = 0.0;   ///< the area of the smallest of them
    std::int32_t name = -1;  ///< for touches(), once the chain is removed
  };
  /// What comes about where a chain that is still there is taken away: several where the pieces along it do not hang
  /// together, none where other chains cover all that it cuts.
  std::vector<Joined> joined_without(std::int32_t chain) const;
  /// Takes it away, and returns what came about.
  std::vector<Joined> remove(std::int32_t chain);
  /// Whether joined_without(chain) may be another since `other` was removed.
  bool touches(std::int32_t chain, std::int32_t other, std::span<const Joined> joined) const;

  /// Whether a piece of less than an area lies beside a chain.
  bool has_beside(std::int32_t chain, double less_than) const;

  /// All pieces.
  std::vector<Piece> pieces() const;
  std::size_t piece_count() const { return piece_count_; }
  /// For each vertex of the surface whether it lies in the piece of most area that is no disc, of those with a triangle
  /// whose vertices are all `among` some; empty: all these are.
  std::vector<std::uint8_t> vertices_of_worst(const Surface& surface, std::span<const std::uint8_t> among) const;

 private:
  /// An edge that chains cut: the pieces on both sides, and the sets of corners at its ends, one side's first.
  struct CutEdge {
    std::array<std::int32_t, 2> pieces;
    std::array<std::int32_t, 2> tails, tips;
    std::int32_t covered;  ///< how many chains cut it
  };
  /// What is glued where a chain goes: cut edges that no other chain covers.
  std::vector<std::int32_t> glued_without(std::int32_t chain) const;

  std::vector<CutEdge> edges_;
  Csr<std::int32_t> edges_of_chain_;         ///< each once, ascending
  std::vector<std::int32_t> piece_of_face_;  ///< of the half-edge mesh, as cut at first
  std::vector<Piece> pieces_;                ///< valid for the names of sets
  std::size_t piece_count_ = 0;
  // Looking a name up shortens the way to it, which changes nothing that can be seen.
  mutable DisjointSets piece_sets_, corner_sets_;
};

}  // namespace seamwire
