// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <span>
#include <vector>

#include "cut/cut_mesh.hpp"
#include "cut/nodes.hpp"

namespace seamwire::detail {

/// Where curves begin and end.
class CurveEnds {
 public:
  explicit CurveEnds(const NodeTable& nodes) : nodes_(nodes) {}
  /// Adds the first and the last node of a curve that do not lie inside a polygon.
  void add(std::span<const Piece> pieces);
  /// Whether a node is, or is near, such an end.
  bool contains(std::int32_t node) const;

 private:
  const NodeTable& nodes_;
  std::map<std::array<std::int32_t, 3>, std::vector<std::int32_t>> at_;
};

/// Removes loops that start and end at one node. They come from places near a vertex before and after places that are
/// not.
std::vector<Piece> without_detours(std::span<const Piece> pieces);

/// Joins the pieces of all curves. They are cut where they cross. Nodes that are near each other become one. Pieces
/// along an edge or a diagonal are cut at the nodes of others that they pass. Throws Cancelled.
std::vector<Piece> joined(const CutMesh& mesh, NodeTable& nodes, std::vector<Piece> pieces, const Task& task);

/// Leaves out the longer one of two cuts between the same nodes if they enclose next to nothing. Keeps both if both
/// nodes are ends of curves. Throws Cancelled.
std::vector<Piece> without_slivers(const CutMesh& mesh, const NodeTable& nodes, std::span<const Piece> pieces,
                                   const CurveEnds& ends, const Task& task);

/// Removes pieces that end at neither an end of a curve nor another piece, and ends inside polygons.
std::vector<Piece> without_spurs(const NodeTable& nodes, std::span<const Piece> pieces, const CurveEnds& ends);

/// Whether both ends of a piece lie on one side of its polygon.
bool is_along_side(const CutMesh& mesh, const NodeTable& nodes, const Piece& piece);

}  // namespace seamwire::detail
