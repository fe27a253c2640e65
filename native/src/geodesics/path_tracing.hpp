// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "geodesics/geodesic_mesh.hpp"
#include "geodesics/submesh.hpp"
#include "geodesics/trace_record.hpp"
#include "seamwire/geodesics/distance_field.hpp"
#include "seamwire/task.hpp"

namespace seamwire {

/// The path to a vertex that the records tell, in internal numbers; nothing where following them fails, which those of
/// an exact field never do. `distances` are in external numbers.
std::optional<IntrinsicPath> trace_records(const GeodesicMesh& mesh, const std::vector<double>& distances,
                                           const std::vector<TraceRecord>& records, std::int32_t vertex);

/// The shortest path within the triangles at the vertices of a path and at the ends of the edges it crosses; both in
/// internal numbers. Of `path` only the points count.
IntrinsicPath shorten(const GeodesicMesh& mesh, SubmeshCutter& cutter, const IntrinsicPath& path, const Task& task);

/// Renumbers a path over a submesh as one over the whole mesh, in internal numbers.
void to_whole_mesh(const Submesh& part, IntrinsicPath& path);
/// Renumbers a path from internal to external numbers.
void to_external(const GeodesicMesh& mesh, IntrinsicPath& path);

}  // namespace seamwire
