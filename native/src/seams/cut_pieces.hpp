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
  std::int64_t euler = 0;          ///< Euler characteristic
  std::int64_t border = 0;         ///< how many sides of triangles lie on its border
  double area = 0.0;               ///< in the unit of exact_unit(), squared
  Vector normal = Vector::Zero();  ///< sum of the triangles' area normals, all turned to the same side if it has two
  double max_spread = 0.0;         ///< the least that is allowed to one of its triangles

  /// How many cuts make it a disc: 0 for a disc, 1 for a tube or a Moebius strip, 3 for a torus. Each cut leads from
  /// border to border. A piece without a border, like a ball, needs another cut first to get one.
  std::int64_t missing_cuts() const { return border > 0 ? 1 - euler : 3 - euler; }
  bool is_disc() const { return missing_cuts() == 0; }
  /// How far its normals spread, see SeamLimits.
  double spread() const { return area > 0.0 ? 1.0 - normal.norm() / area : 0.0; }
};

/// The pieces into which chains of edges cut a surface, and what becomes of them where a chain is taken away.
///
/// Cut open, the surface has a vertex for each set of corners that hang together. Gluing two sides of an edge takes one
/// edge away, and the vertices that it unites; so the Euler characteristic follows without walking over the piece.
///
/// A one-sided surface is whole here, although the half-edge mesh is cut open where its faces do not agree on a side.
/// Edges with three or more triangles stay open, as they do in any UV map.
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
  /// The piece of each triangle of the half-edge mesh, by its place in pieces().
  std::vector<std::int32_t> piece_of_faces() const;
  /// For each vertex of the surface whether it lies in the piece of most area that is no disc, of those with a triangle
  /// whose vertices are all `among` some; empty: all these are.
  std::vector<std::uint8_t> vertices_of_worst(const Surface& surface, std::span<const std::uint8_t> among) const;

 private:
  /// An edge that chains cut: the pieces on both sides, and the sets of corners at its ends, one side's first.
  struct CutEdge {
    std::array<std::int32_t, 2> pieces;
    std::array<std::int32_t, 2> tails, tips;
    bool is_turned;        ///< whether the triangles on both sides face opposite ways
    std::int32_t covered;  ///< how many chains cut it
  };
  CutEdge edge_between(std::int32_t half_edge, std::int32_t twin, bool is_turned,
                       std::span<const std::int32_t> set_of_corner) const;
  /// What is glued where a chain goes: cut edges that no other chain covers.
  std::vector<std::int32_t> glued_without(std::int32_t chain) const;
  /// The pieces that arise when edges are glued.
  std::vector<Joined> joined_by(std::span<const std::int32_t> glued) const;
  /// Glues edges. `joined`: what joined_by() returns for them.
  void glue(std::span<const std::int32_t> glued, std::span<const Joined> joined);
  /// The name of the set of pieces that has one of the first pieces.
  std::int32_t set_of(std::int32_t piece) const { return piece_sets_.find(2 * piece) / 2; }

  std::vector<CutEdge> edges_;
  Csr<std::int32_t> edges_of_chain_;         ///< each once, ascending
  std::vector<std::int32_t> piece_of_face_;  ///< of the half-edge mesh, as cut at first
  std::vector<Piece> pieces_;                ///< valid for the names of sets
  std::size_t piece_count_ = 0;
  // Looking a name up shortens the way to it, which changes nothing that can be seen. Each piece p has two
  // entries: 2 p with its own orientation, 2 p + 1 with the opposite one. So a set also tells how its pieces are
  // oriented.
  mutable DisjointSets piece_sets_, corner_sets_;
};

}  // namespace seamwire
