// SPDX-License-Identifier: GPL-3.0-or-later
#include "seamwire/parameterization/unwrap_mesh.hpp"

#include <algorithm>
#include <string>
#include <utility>

#include "detail/index.hpp"
#include "parameterization/straight_corners.hpp"
#include "seamwire/errors.hpp"

namespace seamwire {

using namespace detail;

UnwrapMesh::UnwrapMesh(UnwrapArrays arrays) : arrays_(std::move(arrays)) {
  const std::size_t count = arrays_.vertices.size();
  if (arrays_.edges.size() != count) {
    throw InvalidInput("edges has " + std::to_string(arrays_.edges.size()) + " items: there are " +
                       std::to_string(count) + " corners");
  }
  if (arrays_.islands.size() != arrays_.sizes.size()) {
    throw InvalidInput("islands has " + std::to_string(arrays_.islands.size()) + " items: there are " +
                       std::to_string(arrays_.sizes.size()) + " polygons");
  }
  for (std::size_t v = 0; v < arrays_.points.size(); ++v) {
    if (!arrays_.points[v].allFinite()) throw InvalidInput("point " + std::to_string(v) + " is not finite");
  }
  for (std::size_t c = 0; c < count; ++c) {
    check_index(arrays_.vertices[c], arrays_.points.size(), "vertices: vertex");
    check_index(arrays_.edges[c], arrays_.seams.size(), "edges: edge", "edges");
  }
  for (std::size_t p = 0; p < arrays_.sizes.size(); ++p) {
    const auto first = static_cast<std::int32_t>(polygons_.size());
    const std::int32_t size = arrays_.sizes[p];
    if (size < 1 || index(size) > count - polygons_.size()) {
      throw InvalidInput("polygon " + std::to_string(p) + " has a wrong size");
    }
    for (std::int32_t i = 0; i < size; ++i) {
      polygons_.push_back(static_cast<std::int32_t>(p));
      following_.push_back(first + (i + 1) % size);
      preceding_.push_back(first + (i + size - 1) % size);
    }
    const std::int32_t island = arrays_.islands[p];
    if (island >= 0) check_index(island, arrays_.sizes.size(), "islands: island", "polygons");
    island_count_ = std::max(island_count_, index(island + 1));
  }
  if (polygons_.size() != count) throw InvalidInput("sizes do not add up to the number of corners");
  for (const Triangle& triangle : arrays_.triangles) {
    for (const std::int32_t c : triangle) check_index(c, count, "triangles: corner", "corners");
    const bool is_inside = polygon(triangle[0]) == polygon(triangle[1]) && polygon(triangle[0]) == polygon(triangle[2]);
    if (!is_inside) throw InvalidInput("triangles: a triangle has corners of several polygons");
  }
  straight_ = std::make_shared<StraightCorners>(find_straight_corners(*this));
}

const StraightCorners& detail::straight_corners(const UnwrapMesh& mesh) { return *mesh.straight_; }

}  // namespace seamwire
