// SPDX-License-Identifier: GPL-3.0-or-later
#include "wires/local_wires.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <iterator>
#include <memory>
#include <utility>
#include <vector>

#include "detail/drop_repeats.hpp"
#include "detail/poll.hpp"
#include "seamwire/embedding/embedding.hpp"
#include "seamwire/geodesics/exact_geodesics.hpp"
#include "seamwire/surface/intrinsic_mesh.hpp"
#include "surface/face_rings.hpp"

namespace seamwire::detail {
namespace {

/// The radius of the faces that are embedded for a target, and the least one that serves another target, both of the
/// straight distance.
constexpr double kRadius = 1.3, kLeastRadius = 1.1;
/// So many triangles at most are added for each face, so that a metric that no triangle resolves delays no wire for
/// long.
constexpr std::size_t kMostAddedPerFace = 4;

/// The corridor may get so many triangles at most, so that a metric that no triangle resolves delays no wire for long.
constexpr std::size_t kMostFacesAdded = 400'000;

std::vector<std::int32_t> faces_of(const Wire& wire) {
  std::vector<std::int32_t> faces;
  std::ranges::copy_if(wire.faces, std::back_inserter(faces), [](std::int32_t face) { return face >= 0; });
  return faces;
}

}  // namespace

EmbeddedFaces::EmbeddedFaces(std::shared_ptr<const Surface> surface, std::shared_ptr<const Embedding> embedding,
                             const Task& task)
    : surface_(std::move(surface)), embedding_(std::move(embedding)), points_(surface_, embedding_) {
  IntrinsicMesh mesh = embedding_->mesh;
  for (const Triangle& corners : mesh.triangles) vertices_.insert(vertices_.end(), corners.begin(), corners.end());
  for (const LooseEdge& edge : mesh.loose_edges) vertices_.insert(vertices_.end(), {edge.a, edge.b});
  std::ranges::sort(vertices_);
  drop_repeats(vertices_);
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
  for (PathPoint& point : path.points) {
    if (point.vertex >= 0) point.vertex = vertices_[point.vertex];
  }
  return map_wire(*surface_, *embedding_, path);
}

NearbyWires::NearbyWires(std::shared_ptr<const Surface> surface, std::shared_ptr<const Metric> metric,
                         const SurfacePoint& seed, std::size_t most_faces)
    : surface_(std::move(surface)), metric_(std::move(metric)), seed_(seed), most_faces_(most_faces) {}

Vector NearbyWires::place(const SurfacePoint& point) const {
  if (point.vertex >= 0) return surface_->points()[point.vertex];
  const Triangle& corners = surface_->triangles()[point.face];
  Vector sum = Vector::Zero();
  for (std::size_t i = 0; i < 3; ++i) sum += point.barycentric[i] * surface_->points()[corners[i]];
  return sum;
}

std::optional<Wire> NearbyWires::wire(const SurfacePoint& target, const Task& task) {
  const double straight = (place(target) - place(seed_)).norm();
  const auto is_embedded = [&] { return on_ && radius_ >= kLeastRadius * straight; };
  if (!is_embedded() && kRadius * straight < too_far_) embed_within(kRadius * straight, task);
  if (!is_embedded() || !paths_) return std::nullopt;
  const std::optional<SurfacePoint> to = on_->find(target);
  if (!to) return std::nullopt;
  const std::optional<IntrinsicPath> path = paths_->path(*to, task);
  if (!path) return std::nullopt;
  return on_->wire(*path);
}

/// Those with a corner that near to the seed, and the seed's own; none if there are too many.
std::vector<std::int32_t> NearbyWires::faces_within(double radius, const Task& task) const {
  const Vector center = place(seed_);
  std::vector<bool> is_near(surface_->vertex_count());
  for (std::size_t v = 0; v < is_near.size(); ++v) {
    is_near[v] = (surface_->points()[v] - center).squaredNorm() <= radius * radius;
  }
  task.check(0.0);
  std::vector<std::int32_t> faces;
  for (std::size_t f = 0; f < surface_->face_count(); ++f) {
    const auto number = static_cast<std::int32_t>(f);
    const auto& [a, b, c] = surface_->triangles()[f];
    if (is_near[a] || is_near[b] || is_near[c] || number == seed_.face) faces.push_back(number);
    if (faces.size() > most_faces_) return {};
  }
  task.check(0.0);
  return faces;
}

void NearbyWires::embed_within(double radius, const Task& task) {
  std::vector<std::int32_t> faces = faces_within(radius, task);
  const double too_far = std::exchange(too_far_, radius);  // it stays so if this fails
  if (faces.empty()) return;
  const std::size_t most_added = kMostAddedPerFace * faces.size();
  auto embedding = std::make_shared<const Embedding>(
      embed(*surface_, *metric_, {.max_faces_added = most_added, .max_error = 0, .faces = std::move(faces)}, task));
  paths_.reset();
  on_.emplace(surface_, std::move(embedding), task);
  radius_ = radius;
  too_far_ = too_far;
  if (const std::optional<SurfacePoint> from = on_->find(seed_)) paths_.emplace(on_->geodesics(), *from);
}

std::optional<Wire> refined_wire(const std::shared_ptr<const Surface>& surface, const Metric& metric, const Wire& first,
                                 const SurfacePoint& from, const SurfacePoint& to, const WireRefinement& refinement,
                                 const Task& task) {
  std::vector<std::int32_t> corridor = faces_within_rings(*surface, faces_of(first), refinement.rings, task);
  if (corridor.empty()) return std::nullopt;
  const Task own = part_of(task, 0.0, 0.0);
  const auto embedding = std::make_shared<const Embedding>(embed(*surface, metric,
                                                                 {.max_faces_added = kMostFacesAdded,
                                                                  .max_error = refinement.max_error,
                                                                  .faces = std::move(corridor),
                                                                  .mean_edge_length = refinement.mean_edge_length},
                                                                 own));
  if (embedding->faces_added == 0) return std::nullopt;
  const EmbeddedFaces on(surface, embedding, own);
  const std::optional<SurfacePoint> source = on.find(from), target = on.find(to);
  if (!source || !target) return std::nullopt;
  const DistanceField field = on.geodesics().solve(std::array{*source}, {.targets = {*target}}, own);
  const std::optional<IntrinsicPath> path = field.trace(*target, own);
  if (!path) return std::nullopt;
  return on.wire(*path);
}

}  // namespace seamwire::detail
