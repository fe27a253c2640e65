// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "detail/poll.hpp"
#include "maps/strip_tree.hpp"

namespace seamwire::detail {

/// A side of an outline in a map. The outlined part of the plane lies to its left.
struct OutlineSide {
  Eigen::Vector2d from, to;
  std::int32_t tail,
      tip;  ///< the vertices at its ends, by their numbers in one piece: sides with a common vertex do not cross
};

/// The outline of a piece of a map, and which part of the plane the piece covers.
///
/// Without flips, a piece covers a point as often as its outline winds around it. Where the plane is covered twice,
/// there is a side that crosses or touches another one, a whole loop that is turned inside out, or a piece inside
/// another one. So the number is looked up beside each part of each side that touches something, beside one side of
/// each loop, and at one point inside each piece.
class PieceOutline {
 public:
  /// `loop_sizes`: the number of sides of each loop. Their sides follow each other. `inner`: a point inside the piece
  /// with a distance of at least `inner_reach` from its sides.
  PieceOutline(std::vector<OutlineSide> sides, std::span<const std::size_t> loop_sizes, const Eigen::Vector2d& inner,
               double inner_reach, Poll& poll);

  /// Whether the piece covers a part of what another piece covers, or covers a part of the plane twice if the other one
  /// is itself. Sides that cross by less than `tolerance` only touch. Throws Cancelled.
  bool overlaps(const PieceOutline& other, double tolerance, Poll& poll) const;

  /// A rectangle that holds it.
  const Strip& strip() const { return tree_.strip(tree_.root()); }

 private:
  struct Touch;
  using Touches = std::vector<Touch>;

  static void add_touches(const OutlineSide& one, std::int32_t number, const OutlineSide& other, double tolerance,
                          Touches& touches);
  /// `covers_twice(point)`: whether this piece or two of them cover a point twice. `touches`: where sides touch.
  template <class CoversTwice>
  bool is_any_double(Touches touches, double tolerance, Poll& poll, const CoversTwice& covers_twice) const;
  /// How often the outline winds around a point. Parts of it that are farther than `reach` are looked at as a whole.
  int winding(const Eigen::Vector2d& point, double reach) const { return winding(tree_.root(), point, reach); }
  int winding(const StripTree::Part& part, const Eigen::Vector2d& point, double reach) const;

  std::vector<OutlineSide> sides_;
  std::vector<std::int32_t> first_;    // of each side: the first side of its loop
  std::vector<std::int32_t> longest_;  // sides of each loop
  Eigen::Vector2d inner_;
  double inner_reach_;
  StripTree tree_;
};

/// A piece of an island.
struct IslandPiece {
  const PieceOutline* outline;
  std::int32_t island;
};

/// Whether any two different pieces overlap. Sorts them. Throws Cancelled.
bool do_any_overlap(std::span<IslandPiece> pieces, double tolerance, Poll& poll);

/// Sets the items of islands of which a piece overlaps a piece of another island. Sorts the pieces. Throws Cancelled.
void mark_colliding(std::span<IslandPiece> pieces, double tolerance, std::vector<std::uint8_t>& is_colliding,
                    Poll& poll);

}  // namespace seamwire::detail
