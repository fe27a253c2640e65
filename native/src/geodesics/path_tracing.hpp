// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "geodesics/geodesic_mesh.hpp"
#include "seamwire/geodesics/exact_geodesics.hpp"

namespace seamwire {

/// The path that the records give, in the mesh's own numbers; nothing where they lead nowhere, which those of an exact
/// field never do. `distances` are in the caller's numbers.
std::optional<IntrinsicPath> trace_records(const GeodesicMesh& mesh, const std::vector<double>& distances,
                                           const std::vector<DistanceField::TraceRecord>& records, std::int32_t vertex);

/// The shortest path within the triangles at the vertices of a path and at the ends of the edges it crosses; both in
/// the mesh's own numbers. Of `path` only the points count.
IntrinsicPath shorten(const GeodesicMesh& mesh, MeshCutter& cutter, const IntrinsicPath& path, const Task& task);

/// A path over a part in the whole mesh's own numbers, ...
void number_as_whole(const MeshPart& part, IntrinsicPath& path);
/// ... and a path in its own numbers in the caller's.
void number_as_caller(const GeodesicMesh& mesh, IntrinsicPath& path);

}  // namespace seamwire
