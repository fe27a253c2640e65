// SPDX-License-Identifier: GPL-3.0-or-later
#include "parts/figure.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <span>
#include <vector>

#include "detail/poll.hpp"
#include "prices/border_odds.hpp"
#include "prices/plan_mesh.hpp"
#include "tuning/constants.hpp"

namespace seamwire::detail {
namespace {

/// The share of the area in triangles that hardly bend to their neighbors; 1 without area.
double flat_share(const PlanMesh& mesh, std::span<const FaceFrame> frames, const PieceSizes& sizes, const Task& task) {
  const Poll poll(task);
  std::vector<Vector> centers(frames.size(), Vector::Zero());
  for (std::size_t f = 0; f < frames.size(); ++f) {
    for (const std::int32_t v : mesh.triangles[f]) centers[f] += mesh.points[v] / 3.0;
  }
  std::vector<std::uint8_t> is_bent(frames.size(), 0);
  for (std::size_t e = 0; e < mesh.edge_count(); ++e) {
    poll.at(e);
    const std::int32_t h = mesh.half_edge_of[e], one = h / 3, other = mesh.twins[h] / 3;
    if (mesh.twins[h] < 0) continue;
    const Vector middle = 0.5 * (mesh.points[mesh.tail(h)] + mesh.points[mesh.tip(h)]);
    const double distance = (centers[one] - middle).norm() + (centers[other] - middle).norm();
    const Vector &a = frames[one].normal, &b = frames[other].normal;
    const double size = std::sqrt(sizes.of_piece[sizes.pieces.of_face[one]].area);
    if (std::atan2(a.cross(b).norm(), a.dot(b)) * size >= tuning::kFlatLimb * distance) {
      is_bent[one] = is_bent[other] = 1;
    }
  }
  double flat = 0.0, all = 0.0;
  for (std::size_t f = 0; f < frames.size(); ++f) {
    all += frames[f].area;
    if (is_bent[f] == 0) flat += frames[f].area;
  }
  return all > 0.0 ? flat / all : 1.0;
}

}  // namespace

bool is_round(const PlanMesh& mesh, std::span<const FaceFrame> frames, const PieceSizes& sizes, const Task& task) {
  return flat_share(mesh, frames, sizes, task) <= tuning::kMostFlat;
}

bool is_soft(const PlanMesh& mesh, std::span<const FaceFrame> frames, const PieceSizes& sizes, const EdgeBends& bends,
             std::span<const std::int32_t> rims, const Task& task) {
  if (sharp_share(mesh, bends) > tuning::kMostSharp) return false;
  Poll poll(task);
  std::map<std::int32_t, double> area_of;
  std::vector<double> largest(sizes.of_piece.size(), 0.0);
  for (std::size_t f = 0; f < frames.size(); ++f) {
    poll.next();
    double& area = area_of[rims[f]];
    area += frames[f].area;
    largest[sizes.pieces.of_face[f]] = std::max(largest[sizes.pieces.of_face[f]], area);
  }
  double all = 0.0, in_largest = 0.0;
  for (std::size_t p = 0; p < largest.size(); ++p) {
    all += sizes.of_piece[p].area;
    in_largest += largest[p];
  }
  return in_largest >= tuning::kLeastBody * all;
}

}  // namespace seamwire::detail
