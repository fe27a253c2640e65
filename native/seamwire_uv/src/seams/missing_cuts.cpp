// SPDX-License-Identifier: GPL-3.0-or-later
#include "seamwire_uv/seams/missing_cuts.hpp"

#include <algorithm>
#include <string>
#include <utility>

#include "detail/index.hpp"
#include "maps/cut_open.hpp"
#include "slits/flat_holes.hpp"
#include "surface/corner_fans.hpp"
#include "surface/cuts.hpp"

namespace seamwire {

using namespace detail;

std::vector<std::int32_t> missing_cuts(const Surface& surface, std::span<const Edge> cut_edges,
                                       std::span<const std::int32_t> segments, const Task& task) {
  if (segments.size() != surface.face_count()) {
    throw InvalidInput("segments has " + std::to_string(segments.size()) + " items: there are " +
                       std::to_string(surface.face_count()) + " triangles");
  }
  std::int32_t count = 0;
  for (const std::int32_t segment : segments) {
    check_index(segment, segments.size(), "segments: number", "triangles");
    count = std::max(count, segment + 1);
  }
  const Cuts cuts(surface, cut_edges, "cut_edges", task);
  const std::vector<std::int32_t>& faces = corner_fans(surface).faces;
  std::vector<std::int32_t> missing(index(count), 0);
  std::vector<std::uint8_t> is_known(index(count), 0);
  for (Island& part : cut_open(corner_fans(surface), cut_half_edges(surface, cuts, task), task)) {
    const std::int32_t segment = segments[faces[part.faces.front()]];
    if (std::exchange(is_known[segment], 1) != 0 ||
        std::ranges::any_of(part.faces, [&](std::int32_t f) { return segments[faces[f]] != segment; })) {
      throw InvalidInput("segments: they are those of other cuts");
    }
    for (std::int32_t& v : part.vertices) v = corner_fans(surface).vertices[v];
    const std::vector<std::uint8_t> is_kept = flat_holes(part, surface.points(), part.boundaries(), task);
    missing[segment] = static_cast<std::int32_t>(part.missing_cuts() - std::ranges::count(is_kept, 1));
  }
  return missing;
}

}  // namespace seamwire
