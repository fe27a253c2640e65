// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "seamwire/api.hpp"
#include "seamwire/surface/types.hpp"
#include "seamwire/surface/vector.hpp"
#include "seamwire/task.hpp"

namespace seamwire {

/// Find the nearest vertex of each place, within a separate distance for each.
///
/// \param points the vertices. Vertices with a coordinate that is not finite, or not below 1e100, are never found.
/// \param places the places. Such places have no nearest vertex.
/// \param reach for each place, how far away a vertex may be
/// \returns the number of the nearest vertex, usually the smallest of several at the same distance, or -1
SEAMWIRE_API std::vector<std::int32_t> nearest_vertices(std::span<const Vector> points, std::span<const Vector> places,
                                                        std::span<const double> reach, const Task& = {});

/// How the mirror images of vertices are found.
struct MirrorOptions {
  std::array<bool, 3> axes{true, false, false};  ///< the coordinates that change their sign
  /// The edges of the mesh. A vertex may be as far from its partner's image as half of (sum of 1 / l^2)^(-1/2), over
  /// the lengths l of its edges. nullopt: as far as 2e-5, which is Blender's limit.
  std::optional<std::vector<Edge>> edges;
  /// Triangles with one orientation. If given, partners are grown over the polygons that the edges bound, from edges
  /// whose ends have partners by place. This finds the partners of a mesh in a pose.
  std::optional<std::vector<Triangle>> triangles;
};

/// Find the vertex that is the mirror image of each vertex.
///
/// Partners are one to one: each vertex is the partner of its partner. By place, each is the nearest to the mirror
/// image of the other. Vertices in one place have different partners. Over the mesh, the image of a half-edge from a to
/// b runs from the partner of b to that of a. So the image of the next half-edge of its polygon is the one before its
/// image.
///
/// \param points the vertices. Vertices without a place (nearest_vertices()) have no partners.
/// \param options the plane, and the mesh
/// \returns the partner of each vertex, or -1
/// \throws InvalidInput if a vertex number is out of range
SEAMWIRE_API std::vector<std::int32_t> mirror_partners(std::span<const Vector> points, const MirrorOptions& options,
                                                       const Task& = {});

}  // namespace seamwire
