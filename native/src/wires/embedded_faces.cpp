// SPDX-License-Identifier: GPL-3.0-or-later
#include "wires/embedded_faces.hpp"

#include <algorithm>
#include <utility>

#include "seamwire/surface/intrinsic_mesh.hpp"

namespace seamwire::detail {

EmbeddedFaces::EmbeddedFaces(std::shared_ptr<const Surface> surface, std::shared_ptr<const Embedding> embedding,
                             const Task& task)
    : surface_(std::move(surface)), embedding_(std::move(embedding)), points_(surface_, embedding_) {
  IntrinsicMesh mesh = embedding_->mesh;
  for (const Triangle& corners : mesh.triangles) vertices_.insert(vertices_.end(), corners.begin(), corners.end());
  for (const LooseEdge& edge : mesh.loose_edges) vertices_.insert(vertices_.end(), {edge.a, edge.b});
  std::ranges::sort(vertices_);
  vertices_.erase(std::unique(vertices_.begin(), vertices_.end()), vertices_.end());
  for (Triangle& corners : mesh.triangles) {
    for (std::int32_t& v : corners) v = compact(v);
  }
  for (LooseEdge& edge : mesh.loose_edges) {
    edge.a = compact(edge.a);
    edge.b = compact(edge.b);
  }
  mesh.vertex_count = static_cast<std::int32_t>(vertices_.size());
  geodesics_.emplace(mesh, task);
}

/// -1 if nothing uses the vertex.
std::int32_t EmbeddedFaces::compact(std::int32_t vertex) const {
  const auto at = std::ranges::lower_bound(vertices_, vertex);
  return at != vertices_.end() && *at == vertex ? static_cast<std::int32_t>(at - vertices_.begin()) : -1;
}

std::optional<SurfacePoint> EmbeddedFaces::find(const SurfacePoint& point) const {
  std::optional<SurfacePoint> at = points_.find(point);
  if (at && at->vertex >= 0) at->vertex = compact(at->vertex);
  return at && (at->vertex >= 0 || at->face >= 0) ? at : std::nullopt;
}

Wire EmbeddedFaces::wire(IntrinsicPath path) const {
  if (path.points.empty()) return {};
  for (PathPoint& point : path.points) {
    if (point.vertex >= 0) point.vertex = vertices_[point.vertex];
  }
  return map_wire(*surface_, *embedding_, path);
}

}  // namespace seamwire::detail
