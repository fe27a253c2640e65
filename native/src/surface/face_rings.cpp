// SPDX-License-Identifier: GPL-3.0-or-later
#include "surface/face_rings.hpp"

#include <algorithm>
#include <cstddef>

#include "detail/half_edge.hpp"
#include "detail/insertion_map.hpp"
#include "detail/poll.hpp"
#include "surface/corner_fans.hpp"
#include "surface/face_height.hpp"

namespace seamwire::detail {
namespace {

/// Adds all faces of the corner fan at the tail of a half-edge.
void insert_fan(const Surface& surface, std::int32_t half_edge, InsertionMap& faces) {
  const std::vector<std::int32_t>& twins = corner_fans(surface).twins;
  std::int32_t h = half_edge;
  do {
    faces.insert(h / 3);
    h = twins[previous_in_face(h)];
  } while (h >= 0 && h != half_edge);
  if (h == half_edge) return;
  // A boundary: the rest of the fan lies on the other side of the first half-edge.
  for (h = twins[half_edge]; h >= 0; h = twins[h]) {
    h = next_in_face(h);
    faces.insert(h / 3);
  }
}

/// Adds all other faces at an edge where more than two faces meet, or two that cannot be oriented alike.
void insert_siblings(const Surface& surface, std::int32_t half_edge, InsertionMap& faces) {
  const std::vector<std::int32_t>& siblings = corner_fans(surface).siblings;
  if (siblings.empty()) return;
  for (std::int32_t h = siblings[half_edge]; h >= 0 && h != half_edge; h = siblings[h]) faces.insert(h / 3);
}

}  // namespace

std::vector<std::int32_t> faces_within_rings(const Surface& surface, const std::vector<std::int32_t>& faces, int rings,
                                             const Task& task) {
  InsertionMap found, fans;
  for (const std::int32_t face : half_edge_faces(surface, faces)) found.insert(face);
  Poll poll(task, 0, 1, 1, Poll::kFewSteps);
  std::size_t begin = 0;
  for (int ring = 0; ring < rings; ++ring) {
    const std::size_t end = found.numbers().size();
    for (; begin < end; ++begin) {
      poll.next();
      const std::int32_t face = found.numbers()[begin];
      for (std::int32_t i = 0; i < 3; ++i) {
        insert_siblings(surface, 3 * face + i, found);
        if (fans.insert(corner_fans(surface).triangles[face][i]).second) insert_fan(surface, 3 * face + i, found);
      }
    }
  }
  std::vector<std::int32_t> all;
  all.reserve(found.numbers().size());
  for (const std::int32_t face : found.numbers()) all.push_back(corner_fans(surface).faces[face]);
  std::ranges::sort(all);
  return all;
}

}  // namespace seamwire::detail
