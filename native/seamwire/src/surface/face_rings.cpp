// SPDX-License-Identifier: GPL-3.0-or-later
#include "surface/face_rings.hpp"

#include <algorithm>
#include <cstddef>

#include "detail/insertion_map.hpp"
#include "detail/poll.hpp"
#include "surface/corner_fans.hpp"
#include "surface/face_height.hpp"

namespace seamwire::detail {

std::vector<std::int32_t> faces_within_rings(const Surface& surface, const std::vector<std::int32_t>& faces, int rings,
                                             const Task& task) {
  const CornerFans& mesh = corner_fans(surface);
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
        const auto insert = [&](std::int32_t half_edge) { found.insert(half_edge / 3); };
        mesh.for_each_beyond(3 * face + i, insert);
        const std::int32_t fan = mesh.triangles[face][i];
        if (fans.insert(fan).second) mesh.for_each_leaving(fan, insert);
      }
    }
  }
  std::vector<std::int32_t> all;
  all.reserve(found.numbers().size());
  for (const std::int32_t face : found.numbers()) all.push_back(mesh.faces[face]);
  std::ranges::sort(all);
  return all;
}

}  // namespace seamwire::detail
