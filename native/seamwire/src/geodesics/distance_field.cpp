// SPDX-License-Identifier: GPL-3.0-or-later
#include "seamwire/geodesics/distance_field.hpp"

#include <optional>
#include <utility>

#include "detail/index.hpp"
#include "geodesics/solve_check.hpp"
#include "seamwire/geodesics/distance_method.hpp"

namespace seamwire {

using namespace detail;

SolvedField::~SolvedField() = default;
DistanceMethod::~DistanceMethod() = default;

DistanceField::DistanceField(std::shared_ptr<const SolvedField> solved) : solved_(std::move(solved)) {
  if (!solved_) throw InvalidInput("solved: must not be null");
}

std::int32_t DistanceField::seed() const {
  const std::vector<SurfacePoint>& sources = solved_->sources;
  return sources.size() == 1 ? sources.front().vertex : -1;
}

bool DistanceField::fits(const IntrinsicMesh& mesh) const {
  return solved_->distances.size() == index(mesh.vertex_count) && solved_->face_count == mesh.face_count();
}

double DistanceField::distance(const SurfacePoint& point, const Task& task) const {
  return solved_->distance(point, task);
}

std::optional<IntrinsicPath> DistanceField::trace(const SurfacePoint& point, const Task& task) const {
  return solved_->trace(point, task);
}

DistanceField DistanceMethod::solve(const SurfacePoint& seed, const Task& task) const {
  return solve({&seed, 1}, {}, task);
}

DistanceField DistanceMethod::solve(std::span<const SurfacePoint> sources, const SolveOptions& options,
                                    const Task& task) const {
  check_solve(sources, options);
  return solve_checked(sources, options, task);
}

}  // namespace seamwire
