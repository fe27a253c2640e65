// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "seamwire/surface/types.hpp"
#include "seamwire/task.hpp"

namespace seamwire::detail {

/// The boundary loops of an island in a map: where they cross each other or themselves, and a barrier that keeps them
/// apart (Smith and Schaefer 2015). Maps are arrays of two numbers for each own vertex.
class Outline {
 public:
  /// `reach`: the distance at which the barrier begins, in the unit of maps.
  Outline(const std::vector<std::vector<std::int32_t>>& boundaries, double reach);

  /// Whether the outline of a map without flips covers a part of the plane twice. Edges that cross by less than
  /// `tolerance` only touch. Throws Cancelled.
  bool covers_twice(std::span<const double> map, double tolerance, const Task& task) const;

  /// A vertex of the outline that is close to one of its edges: three own vertices.
  struct Pair {
    std::int32_t vertex, a, b;
  };
  /// The pairs that are closer than `factor` times the reach.
  std::vector<Pair> close_pairs(std::span<const double> map, double factor) const;

  /// The barrier: the sum of (reach / distance - 1)^2 over all close pairs, times .001; infinite if a pair touches.
  double energy(std::span<const double> map) const;
  /// The barrier's gradient for the three vertices of a pair, and its Hessian, approximated by c g g^T + t t^T with the
  /// gradient g of the distance. The second term is the positive part of what the distance's own Hessian adds: it slows
  /// a vertex that slides along an edge while the edge turns towards it.
  struct Slope {
    std::array<double, 6> of_distance;  // g, of the vertex, a, b
    double first, second;               // derivatives of the energy with respect to the distance; second >= 0
    std::array<double, 6> turning;      // t, the same
  };
  Slope slope(const Pair& pair, std::span<const double> map) const;

  /// The least step in (0, most] along a direction at which a vertex meets an edge; `most` if they do not meet.
  double first_contact(std::span<const double> map, std::span<const double> direction, double most) const;

 private:
  template <class Visit>
  void for_each_close(std::span<const double> map, std::span<const double> direction, double most, double reach,
                      const Visit& visit) const;

  std::vector<Edge> edges_;  // own vertices, in the direction of the loops
  std::vector<std::size_t> loop_sizes_;
  double reach_;
};

}  // namespace seamwire::detail
