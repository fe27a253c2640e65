// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include "seamwire/api.hpp"
#include "seamwire/embedding/embedding.hpp"
#include "seamwire/geodesics/exact_geodesics.hpp"
#include "seamwire/surface/surface.hpp"

namespace seamwire {

/// A geodesic on the caller's surface, from `from` to `to`.
struct Wire {
  std::int32_t from = -1;              ///< the caller's vertex; -1: another point
  std::int32_t to = -1;                ///< the caller's vertex; -1: another point
  std::vector<Vector> points;          ///< in the caller's coordinates; empty where `to` is unreachable
  std::vector<std::int32_t> vertices;  ///< per point: the caller's vertex it is, or -1
  std::vector<std::int32_t> faces;     ///< the caller's face that each segment lies in; -1 along an edge without a face
  double length = std::numeric_limits<double>::infinity();  ///< in the metric, of the model scaled to the unit cube
  double euclidean_length =
      std::numeric_limits<double>::infinity();  ///< of the points, of the model scaled to the unit cube
};

/// Maps a path over an embedding to the caller's surface. New vertices of an embedding are midpoints of edges, so each
/// segment of a path lies in one of the caller's faces. Points on a straight line in one face are left out. Throws
/// InvalidInput where the embedding is not one of the surface, or the path not one over the embedding, as far as their
/// sizes and the surface's first and last vertex tell.
SEAMWIRE_API Wire map_wire(const Surface& surface, const Embedding& embedding, const IntrinsicPath& path);

/// The shortest wire from the seed of a field over `embedding` to one of the caller's vertices. Throws InvalidInput for
/// a vertex out of range, as map_wire() does, and where the field is of another embedding, as far as sizes tell; and
/// Cancelled, as DistanceField::trace().
SEAMWIRE_API Wire trace_wire(const Surface& surface, const Embedding& embedding, const DistanceField& field,
                             std::int32_t vertex, const Task& task = {});

/// The shortest wire from the source that is nearest to a point of the embedding, to that point (EmbeddedPoints finds
/// it). Throws as trace_wire() to a vertex.
SEAMWIRE_API Wire trace_wire(const Surface& surface, const Embedding& embedding, const DistanceField& field,
                             const SurfacePoint& point, const Task& task = {});

}  // namespace seamwire
