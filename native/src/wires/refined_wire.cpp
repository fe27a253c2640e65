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
#include "surface/face_rings.hpp"
#include "wires/embedded_faces.hpp"

namespace seamwire::detail {
namespace {

/// The corridor may get so many triangles at most, so that a metric that no triangle resolves delays no wire for long.
constexpr std::size_t kMostFacesAdded = 400'000;

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
  const EmbeddedFaces on(surface, embedding, silent);
  const std::optional<SurfacePoint> source = on.find(from), target = on.find(to);
  if (!source || !target) return std::nullopt;
  const DistanceField field = on.geodesics().solve(std::array{*source}, {.targets = {*target}}, silent);
  Wire wire = on.wire(field.trace(*target, silent));
  if (wire.points.empty()) return std::nullopt;
  return wire;
}

}  // namespace seamwire::detail
