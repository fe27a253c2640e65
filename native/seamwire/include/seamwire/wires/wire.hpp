// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include "seamwire/api.hpp"
#include "seamwire/embedding/embedding.hpp"
#include "seamwire/geodesics/distance_field.hpp"
#include "seamwire/surface/surface.hpp"

namespace seamwire {

/// Where wires run: across the surface, as exact geodesics, or along its real edges.
enum class Along { kSurface, kEdges };

/// A geodesic on the caller's surface, from `from` to `to`.
struct Wire {
  std::int32_t from = -1;              ///< the caller's vertex; -1 if it is another point
  std::int32_t to = -1;                ///< the caller's vertex; -1 if it is another point
  std::vector<Vector> points;          ///< in the caller's coordinates
  std::vector<std::int32_t> vertices;  ///< per point: the caller's vertex, -1 if the point is not a vertex
  std::vector<std::int32_t> faces;  ///< per segment: the caller's face that it lies in; -1 along an edge without a face
  double length = std::numeric_limits<double>::infinity();  ///< in the metric, in the caller's unit
  /// In space, in the caller's unit.
  double euclidean_length = std::numeric_limits<double>::infinity();
};

/// Map a path over an embedding to the caller's surface.
///
/// New vertices of an embedding are midpoints of edges, so each segment of a path lies in one of the caller's faces.
/// Points inside a straight line in one face are left out.
///
/// \param surface the surface
/// \param embedding an embedding of the surface
/// \param path a path over the embedding
/// \returns the wire
/// \throws InvalidInput if the path has no points
/// \throws InvalidInput if the embedding is of another surface, or the path is of another embedding. Sizes, and the
///   first and last vertex of the surface, are compared.
SEAMWIRE_API Wire map_wire(const Surface& surface, const Embedding& embedding, const IntrinsicPath& path);

/// Trace the shortest wire to a point of the embedding, from the nearest source of a field.
///
/// \param surface the surface
/// \param embedding an embedding of the surface
/// \param field distances over the embedding
/// \param point a point of the embedding, which EmbeddedPoints finds. The caller's vertices keep their numbers.
/// \returns the wire, or nullopt if the point is unreachable
/// \throws InvalidInput if DistanceField::trace() rejects the point
/// \throws InvalidInput if the field is of another embedding, or the embedding of another surface, as far as sizes tell
SEAMWIRE_API std::optional<Wire> trace_wire(const Surface& surface, const Embedding& embedding,
                                            const DistanceField& field, const SurfacePoint& point, const Task& = {});

}  // namespace seamwire
