// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include "seamwire/embedding.hpp"
#include "seamwire/geodesics.hpp"
#include "seamwire/surface.hpp"

namespace seamwire {

/// A geodesic on the caller's surface, from `from` to `to`.
struct Wire {
  std::int32_t from = -1, to = -1;  ///< the caller's vertices
  std::vector<Vector> points;       ///< in the caller's coordinates; empty where `to` is unreachable
  std::vector<std::int32_t> faces;  ///< the caller's face that each segment lies in; -1 along an edge without a face
  double length = std::numeric_limits<double>::infinity();  ///< in the metric, of the model scaled to the unit cube
  double euclidean_length =
      std::numeric_limits<double>::infinity();  ///< of the points, of the model scaled to the unit cube
};

/// Maps a path over an embedding to the caller's surface. New vertices of an embedding are midpoints of edges, so a
/// path is straight in each of the caller's faces it crosses or turns on points of those faces.
Wire map_wire(const Surface& surface, const Embedding& embedding, const IntrinsicPath& path);

/// The path of real edges (Surface::edges()) from wire.from to wire.to that stays closest to the wire: of all paths
/// along the edges of the (polygon) faces that the wire crosses, and of their neighbours, the one with the least
/// integral of its distance to the wire. Connected, without a repeated vertex. Empty where the wire is, or where no
/// such path exists.
std::vector<std::int32_t> snap_to_edges(const Surface& surface, const Wire& wire);

}  // namespace seamwire
