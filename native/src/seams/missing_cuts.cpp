// SPDX-License-Identifier: GPL-3.0-or-later
#include "seamwire/seams/missing_cuts.hpp"

#include <algorithm>
#include <string>
#include <utility>

#include "detail/disjoint_sets.hpp"
#include "detail/half_edge.hpp"
#include "detail/index.hpp"
#include "surface/corner_fans.hpp"
#include "surface/real_edges.hpp"

namespace seamwire {

using namespace detail;

namespace {

/// A connected part of a cut surface.
struct Part {
  std::int64_t euler = 0;     ///< its Euler characteristic
  std::int64_t border = 0;    ///< how many sides of triangles lie on its border
  std::int32_t segment = -1;  ///< its number, -1 if that is not known yet

  std::int64_t missing_cuts() const { return border > 0 ? 1 - euler : 3 - euler; }
};

/// The vertices of a half-edge, the smaller one first.
Edge edge_of(const Surface& surface, std::int32_t half_edge) {
  const Triangle& fans = corner_fans(surface).triangles[half_edge / 3];
  const std::int32_t a = corner_fans(surface).vertices[fans[half_edge % 3]];
  const std::int32_t b = corner_fans(surface).vertices[fans[(half_edge + 1) % 3]];
  return ascending(a, b);
}

/// The real edges among `cut_edges`, sorted.
std::vector<Edge> real_cuts(const Surface& surface, std::span<const Edge> cut_edges) {
  std::vector<Edge> cuts;
  for (const auto& [a, b] : cut_edges) {
    for (const std::int32_t v : {a, b}) check_index(v, surface.vertex_count(), "cut_edges: vertex");
    if (has_edge(surface, {a, b})) cuts.push_back(ascending(a, b));
  }
  std::ranges::sort(cuts);
  return cuts;
}

/// The parts of a cut surface. Each is listed at its first face in the half-edge mesh. `faces`: joins the faces of a
/// part. Cut open, the surface has a vertex for each set of corners that are joined.
std::vector<Part> find_parts(const Surface& surface, std::span<const Edge> cuts, DisjointSets& faces) {
  const std::size_t count = corner_fans(surface).triangles.size();
  DisjointSets corners(3 * count);
  std::vector<std::int32_t> joined;  // one half-edge of each edge inside a part
  for (std::int32_t h = 0; index(h) < corner_fans(surface).twins.size(); ++h) {
    const std::int32_t twin = corner_fans(surface).twins[h];
    if (twin < h || std::ranges::binary_search(cuts, edge_of(surface, h))) continue;
    joined.push_back(h);
    faces.join(h / 3, twin / 3);
    corners.join(h, next_in_face(twin));
    corners.join(next_in_face(h), twin);
  }
  std::vector<Part> parts(count);
  for (std::int32_t c = 0; index(c) < 3 * count; ++c) {
    Part& part = parts[faces.find(c / 3)];
    ++part.border;
    --part.euler;  // its own side of an edge
    if (c % 3 == 0) ++part.euler;
    if (corners.find(c) == c) ++part.euler;
  }
  for (const std::int32_t h : joined) {
    Part& part = parts[faces.find(h / 3)];
    ++part.euler;
    part.border -= 2;
  }
  return parts;
}

}  // namespace

std::vector<std::int32_t> missing_cuts(const Surface& surface, std::span<const Edge> cut_edges,
                                       std::span<const std::int32_t> segments) {
  if (segments.size() != surface.face_count()) {
    throw InvalidInput("segments has " + std::to_string(segments.size()) + " items: there are " +
                       std::to_string(surface.face_count()) + " triangles");
  }
  std::int32_t count = 0;
  for (const std::int32_t segment : segments) {
    check_index(segment, segments.size(), "segments: number", "triangles");
    count = std::max(count, segment + 1);
  }
  DisjointSets faces(corner_fans(surface).triangles.size());
  std::vector<Part> parts = find_parts(surface, real_cuts(surface, cut_edges), faces);
  std::vector<std::int32_t> missing(index(count), 0);
  for (std::int32_t f = 0; index(f) < parts.size(); ++f) {
    const std::int32_t segment = segments[corner_fans(surface).faces[f]];
    Part& part = parts[faces.find(f)];
    if (part.segment < 0) {
      part.segment = segment;
      missing[segment] += static_cast<std::int32_t>(part.missing_cuts());
    } else if (part.segment != segment) {
      throw InvalidInput("segments: they are those of other cuts");
    }
  }
  return missing;
}

}  // namespace seamwire
