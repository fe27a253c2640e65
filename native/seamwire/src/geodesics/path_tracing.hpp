// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "geodesics/geodesic_mesh.hpp"
#include "geodesics/placed_point.hpp"
#include "geodesics/point_search.hpp"
#include "geodesics/submesh.hpp"
#include "geodesics/trace_record.hpp"
#include "seamwire/geodesics/distance_field.hpp"
#include "seamwire/task.hpp"

namespace seamwire::detail {

/// The path to a target that the records and the crossings tell, in internal numbers. Where one cannot be followed,
/// which takes triangles thinner than rounding or stretched windows, the path goes along edges for a while. A target
/// that is a vertex must be reachable. If another one is not, the path has no points. Throws Cancelled.
IntrinsicPath trace_records(const SolvedDistances& solved, const std::vector<TraceRecord>& records,
                            const std::vector<SiblingCrossing>& crossings, const PlacedPoint& target, const Task& task);

/// The shortest path from a source to a target within a corridor: the triangles at the vertices of `path`, at the ends
/// of the edges that it crosses, and around the faces of source and target. All numbers are internal. Only the points
/// of `path` count, so it may be several paths, one after the other.
IntrinsicPath shorten(const GeodesicMesh& mesh, SubmeshCutter& cutter, const IntrinsicPath& path,
                      const PlacedPoint& source, const PlacedPoint& target, const Task& task);

/// A point of a mesh as one of the submesh cut last, in which its vertex or its faces are.
PlacedPoint to_part(const SubmeshCutter& cutter, PlacedPoint point);

/// Renumbers a path over a submesh as one over the whole mesh, in internal numbers.
void to_whole_mesh(const Submesh& part, IntrinsicPath& path);
/// Renumbers a path from internal to external numbers.
void to_external(const GeodesicMesh& mesh, IntrinsicPath& path);

}  // namespace seamwire::detail
