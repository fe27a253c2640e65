// SPDX-License-Identifier: GPL-3.0-or-later
#include "geodesics/distance_field.hpp"

#include <cmath>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>

#include "detail/index.hpp"
#include "geodesics/delta_stepping.hpp"
#include "geodesics/path_tracing.hpp"
#include "geodesics/submesh.hpp"

namespace seamwire {
namespace {

/// A path along edges and hops, for records that cannot be followed. That has not been seen on any mesh, but nothing
/// excludes it for stretched windows.
IntrinsicPath chain_of_hops(const GeodesicMesh& mesh, std::int32_t seed, std::int32_t vertex, const Task& task) {
  DeltaStepping distances(mesh, seed);
  distances.reach(vertex, task);
  return distances.chain(vertex);
}

}  // namespace

DistanceField::DistanceField(std::shared_ptr<const Data> data) : data_(std::move(data)) {}

std::int32_t DistanceField::seed() const { return data_->seed; }
bool DistanceField::is_exact() const { return data_->is_exact; }
const std::vector<double>& DistanceField::distances() const { return data_->distances; }

IntrinsicPath DistanceField::trace(std::int32_t vertex, const Task& task) const {
  const auto& [mesh, seed, distances, records, is_exact] = *data_;
  check_index(vertex, distances.size(), "vertex");
  if (std::isinf(distances[vertex])) return {};
  const std::int32_t target = mesh->internal_vertex(vertex);
  std::optional<IntrinsicPath> path = trace_records(*mesh, distances, records, target);
  if (!is_exact) {
    if (!path) path = chain_of_hops(*mesh, mesh->internal_vertex(seed), target, task);
    SubmeshCutter cutter(*mesh);
    path = shorten(*mesh, cutter, *path, task);
  } else if (!path) {
    throw std::logic_error("the path to vertex " + std::to_string(vertex) + " cannot be traced");
  }
  to_external(*mesh, *path);
  return std::move(*path);
}

}  // namespace seamwire
