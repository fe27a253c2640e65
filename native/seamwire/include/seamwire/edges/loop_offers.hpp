// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "seamwire/api.hpp"
#include "seamwire/edges/edge_adjacency.hpp"
#include "seamwire/surface/surface.hpp"

namespace seamwire {

/// The kinds of chains through an edge.
enum class LoopKind : std::uint8_t {
  kClosed,    ///< the cheapest closed chain in the metric
  kPast,      ///< straight on both ways, past poles
  kStrip,     ///< the edge loop up to stops
  kWhole,     ///< the edge loop without stops
  kFlat,      ///< the border of a part or of a flat face
  kCrossing,  ///< a loop through the edge that crosses the picked edge at the cursor
};

/// A chain of edges that a click on an edge may take.
struct LoopOffer {
  LoopKind kind = LoopKind::kClosed;
  std::vector<std::int32_t> vertices;  ///< in order; a closed chain does not repeat its first vertex
  bool closed = false;                 ///< whether an edge joins the last vertex to the first
  Edge through{-1, -1};                ///< the picked edge, or the edge of the chain that stands for it; ascending
  std::vector<LoopOffer> beside = {};  ///< other chains that the same click takes
};

/// An edge, and the closed chain through it that is cheapest in a metric.
struct LoopThrough {
  Edge edge{-1, -1};                       ///< two vertices, in either order
  std::span<const std::int32_t> vertices;  ///< as from shortest_cycle(); it may be empty
  std::int32_t corners = 0;                ///< count_corners() of the chain
};

/// A question for LoopOffers.
struct LoopQuery {
  LoopThrough picked;                     ///< the edge under the cursor
  std::optional<LoopThrough> crossing;    ///< the edge that crosses it at the cursor
  std::span<const Edge> kept;             ///< the edges of seams and wires. Straight ways end at their vertices.
  std::span<const std::int32_t> plane;    ///< vertices where straight ways end unless both ends of their edge are here
  std::optional<LoopKind> last;           ///< the kind of the loop that was taken last
  std::int32_t triangle = -1;             ///< the triangle under the cursor, or -1
  bool is_inside = false;                 ///< whether the cursor is inside a face, and does not point at the edge
  bool is_close_call = false;             ///< whether edges are so short that the crossing edge may be meant
  std::span<const std::int32_t> shown{};  ///< the loop that was shown last; a closed loop repeats its first vertex
  bool is_chosen = false;                 ///< whether the user asked for that loop in place of the first one
};

/// Finds the loops that a click on an edge may take: loops in the metric, strips, ways past poles, and borders of
/// parts.
///
/// Several threads may ask at once, but not while parts are added.
///
/// \see docs/method/edges.md
class SEAMWIRE_API LoopOffers {
 public:
  /// Make it for a surface.
  ///
  /// \param surface the surface
  /// \param adjacency its adjacency
  /// \throws InvalidInput if the adjacency is of another surface
  LoopOffers(std::shared_ptr<const Surface> surface, std::shared_ptr<const EdgeAdjacency> adjacency);

  /// Add one way to divide the surface into parts. The borders of the first way come first.
  ///
  /// \param labels the part of each of the caller's triangles, from 0 on
  /// \throws InvalidInput if there are not as many labels as triangles, or a label is not below their number
  void add_parts(std::span<const std::int32_t> labels);

  /// Find what a click may take.
  ///
  /// \param query the edge, and what else is known
  /// \returns the offers, no two along the same edges, the likeliest first
  /// \throws InvalidInput if an edge is not part of the surface, or a vertex or a triangle is out of range
  std::vector<LoopOffer> find(const LoopQuery& query) const;

  /// Find the borders of parts beside an edge that lead through it.
  ///
  /// \param edge two vertices of the surface
  /// \returns the borders for each way to divide the surface, the shortest of each first
  std::vector<std::vector<std::int32_t>> borders(const Edge& edge) const;

 private:
  struct Impl;
  std::shared_ptr<Impl> impl_;
};

}  // namespace seamwire
