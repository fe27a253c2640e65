// SPDX-License-Identifier: GPL-3.0-or-later
#include "wires/nearby_wires.hpp"

#include <algorithm>
#include <utility>

#include "seamwire/embedding/embedding.hpp"

namespace seamwire::detail {
namespace {

/// The radius of the faces that are embedded for a target, and the least one that serves another target, both of the
/// straight distance.
constexpr double kRadius = 1.3, kLeastRadius = 1.1;
/// So many triangles at most are added for each face, so that a metric that no triangle resolves delays no wire for
/// long.
constexpr std::size_t kMostAddedPerFace = 4;

}  // namespace

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
  Wire wire = on_->wire(paths_->path(*to, task));
  if (wire.points.empty()) return std::nullopt;
  return wire;
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
      embed(*surface_, *metric_, {.max_faces_added = most_added, .faces = std::move(faces)}, task));
  paths_.reset();
  on_.emplace(surface_, std::move(embedding), task);
  radius_ = radius;
  too_far_ = too_far;
  if (const std::optional<SurfacePoint> from = on_->find(seed_)) paths_.emplace(on_->geodesics(), *from);
}

}  // namespace seamwire::detail
