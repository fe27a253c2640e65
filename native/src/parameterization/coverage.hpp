// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "detail/csr.hpp"
#include "parameterization/box_grid.hpp"
#include "seamwire/task.hpp"

namespace seamwire::detail {

/// A side of an outline in a map. The outlined part of the plane lies to its left.
struct OutlineSide {
  Eigen::Vector2d from, to;
  std::int32_t tail, tip;   ///< the vertices at its ends: sides with a common vertex do not cross each other
  std::int32_t group;       ///< the island that it is a side of
  bool is_longest = false;  ///< of its loop
};

void mark_longest(std::span<OutlineSide> loop);

/// A point inside a piece of a group.
struct InnerPoint {
  Eigen::Vector2d place;
  std::int32_t group;
  double reach;  ///< its distance from the sides of the piece, at least
};

/// How often the closed outlines of islands cover the points of a plane, and where they cover it twice.
///
/// Without flips, a point is covered as often as the outlines wind around it. Where that number is two, there is an
/// outline that crosses or touches another one, a whole loop that is turned inside out, or a piece inside another one.
/// So the number is looked up beside each part of each side that touches something, beside one side of each loop, and
/// at one point inside each piece.
class Coverage {
 public:
  /// `tolerance`: sides that cross by less than this only touch. `inner`: one point inside each piece.
  Coverage(std::vector<OutlineSide> sides, std::vector<InnerPoint> inner, double tolerance, const Task& task);

  /// Whether a part of the plane is covered twice. Throws Cancelled.
  bool is_double() const;
  /// Sets the items of groups that cover a part of another group; it sees only groups whose items are not set. Throws
  /// Cancelled.
  void mark_colliding(std::vector<std::uint8_t>& is_colliding) const;

  /// How often the outlines wind around a point.
  int winding(const Eigen::Vector2d& point) const;

 private:
  enum class Meeting : std::uint8_t { kApart, kTouching, kCrossing };

  Meeting meeting(const OutlineSide& one, const OutlineSide& other) const;
  std::array<std::int32_t, 2> cell_of(const Eigen::Vector2d& point) const;
  Eigen::Vector2d reference(std::int32_t column, std::int32_t row) const;
  template <class Visit>
  void for_each_cell(const OutlineSide& side, const Visit& visit) const;
  void sum_up_references();
  /// Looks at all pairs that `is_relevant(one, other)`, and at all points beside sides that touch another one, until
  /// `crossing(one, other)` or `look(points)` returns true.
  template <class IsRelevant, class Crossing, class Look>
  bool find(const IsRelevant& is_relevant, const Crossing& crossing, const Look& look) const;
  std::vector<std::int32_t> groups_at(const Eigen::Vector2d& point) const;

  std::vector<OutlineSide> sides_;
  std::vector<InnerPoint> inner_;
  double tolerance_;
  const Task& task_;
  std::array<double, 2> low_{}, cell_{1.0, 1.0};
  std::array<std::int32_t, 2> counts_{1, 1};
  Csr<std::int32_t> cells_;      // the sides in each cell
  std::vector<int> references_;  // the winding number at a point of each cell
};

}  // namespace seamwire::detail
