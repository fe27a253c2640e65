// SPDX-License-Identifier: GPL-3.0-or-later
#include "wires/refined_wire.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <iterator>
#include <memory>
#include <utility>
#include <vector>

#include "seamwire/embedding/embedding.hpp"
#include "seamwire/geodesics/exact_geodesics.hpp"
#include "seamwire/wires/embedded_points.hpp"
#include "surface/face_rings.hpp"

namespace seamwire::detail {
namespace {

/// The corridor may get so many triangles at most, so that a metric that no triangle resolves delays no wire for long.
constexpr std::size_t kMostFacesAdded = 400'000;

/// A mesh without the vertices that nothing uses. Triangles keep their numbers.
struct CompactMesh {
  explicit CompactMesh(const IntrinsicMesh& of) : mesh(of) {
    for (const Triangle& corners : mesh.triangles) vertices.insert(vertices.end(), corners.begin(), corners.end());
    for (const LooseEdge& edge : mesh.loose_edges) vertices.insert(vertices.end(), {edge.a, edge.b});
    std::ranges::sort(vertices);
    vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
    for (Triangle& corners : mesh.triangles) {
      for (std::int32_t& v : corners) v = find(v);
    }
    for (LooseEdge& edge : mesh.loose_edges) {
      edge.a = find(edge.a);
      edge.b = find(edge.b);
    }
    mesh.vertex_count = static_cast<std::int32_t>(vertices.size());
  }
  /// The new number of a vertex; -1 if nothing uses it.
  std::int32_t find(std::int32_t vertex) const {
    const auto at = std::ranges::lower_bound(vertices, vertex);
    return at != vertices.end() && *at == vertex ? static_cast<std::int32_t>(at - vertices.begin()) : -1;
  }

  IntrinsicMesh mesh;
  std::vector<std::int32_t> vertices;  // the former number of each, ascending
};

std::vector<std::int32_t> faces_of(const Wire& wire) {
  std::vector<std::int32_t> faces;
  std::ranges::copy_if(wire.faces, std::back_inserter(faces), [](std::int32_t face) { return face >= 0; });
  return faces;
}

}  // namespace

std::optional<Wire> refined_wire(const std::shared_ptr<const Surface>& surface, const Metric& metric, const Wire& first,
                                 const SurfacePoint& from, const SurfacePoint& to, const WireRefinement& refinement,
                                 const Task& task) {
  std::vector<std::int32_t> corridor = faces_within_rings(*surface, faces_of(first), refinement.rings, task);
  if (corridor.empty()) return std::nullopt;
  const Task silent{.stop = task.stop, .progress = {}};
  const auto embedding = std::make_shared<const Embedding>(embed(*surface, metric,
                                                                 {.max_faces_added = kMostFacesAdded,
                                                                  .max_error = refinement.max_error,
                                                                  .faces = std::move(corridor),
                                                                  .mean_edge_length = refinement.mean_edge_length},
                                                                 silent));
  if (embedding->faces_added == 0) return std::nullopt;
  const EmbeddedPoints points(surface, embedding);
  const CompactMesh compact(embedding->mesh);
  const auto find = [&](const SurfacePoint& point) -> std::optional<SurfacePoint> {
    std::optional<SurfacePoint> at = points.find(point);
    if (at && at->vertex >= 0) at->vertex = compact.find(at->vertex);
    return at && (at->vertex >= 0 || at->face >= 0) ? at : std::nullopt;
  };
  const std::optional<SurfacePoint> source = find(from), target = find(to);
  if (!source || !target) return std::nullopt;
  const ExactGeodesics geodesics(compact.mesh, silent);
  const DistanceField field = geodesics.solve(std::array{*source}, {.targets = {*target}}, silent);
  IntrinsicPath path = field.trace(*target, silent);
  if (path.points.empty()) return std::nullopt;
  for (PathPoint& point : path.points) {
    if (point.vertex >= 0) point.vertex = compact.vertices[point.vertex];
  }
  return map_wire(*surface, *embedding, path);
}

}  // namespace seamwire::detail
