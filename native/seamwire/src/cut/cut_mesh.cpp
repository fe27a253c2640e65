// SPDX-License-Identifier: GPL-3.0-or-later
#include "cut/cut_mesh.hpp"

#include <algorithm>
#include <cstddef>
#include <map>
#include <set>
#include <string>
#include <utility>

#include "detail/index.hpp"

namespace seamwire::detail {
namespace {

const TriangulatedPolygons& checked(const TriangulatedPolygons& mesh) {
  if (mesh.polygons.size() != mesh.triangles.size()) {
    throw InvalidInput("There are " + std::to_string(mesh.triangles.size()) + " triangles, but the polygons of " +
                       std::to_string(mesh.polygons.size()));
  }
  for (std::size_t v = 0; v < mesh.points.size(); ++v) {
    if (!mesh.points[v].allFinite()) throw InvalidInput("vertex " + std::to_string(v) + ": a coordinate is not finite");
  }
  for (std::size_t row = 0; row < mesh.triangles.size(); ++row) {
    for (const std::int32_t v : mesh.triangles[row]) {
      if (!is_index(v, mesh.points.size())) {
        check_index(v, mesh.points.size(), "triangle " + std::to_string(row) + ": vertex");
      }
    }
    if (mesh.polygons[row] < (row == 0 ? 0 : mesh.polygons[row - 1])) {
      throw InvalidInput("triangle " + std::to_string(row) + ": polygons must be 0 or more, and ascending");
    }
  }
  return mesh;
}

}  // namespace

CutMesh::CutMesh(const TriangulatedPolygons& mesh)
    : mesh_(checked(mesh)), rows_at_(mesh.points.size(), [&mesh](const auto& visit) {
        for (std::int32_t row = 0; index(row) < mesh.triangles.size(); ++row) {
          for (const std::int32_t v : mesh.triangles[row]) visit(v, row);
        }
      }) {}

std::array<Vector, 3> CutMesh::corners_of_triangle(std::int32_t row) const {
  const auto& [a, b, c] = mesh_.triangles[row];
  return {mesh_.points[a], mesh_.points[b], mesh_.points[c]};
}

std::vector<std::int32_t> CutMesh::polygons_at(std::int32_t vertex) const {
  std::vector<std::int32_t> found;
  for (const std::int32_t row : rows_at_[vertex]) {
    if (found.empty() || found.back() != mesh_.polygons[row]) found.push_back(mesh_.polygons[row]);
  }
  return found;
}

Rows CutMesh::rows_of(std::int32_t polygon) const {
  const auto [first, last] = std::equal_range(mesh_.polygons.begin(), mesh_.polygons.end(), polygon);
  return {.first = static_cast<std::int32_t>(first - mesh_.polygons.begin()),
          .last = static_cast<std::int32_t>(last - mesh_.polygons.begin())};
}

const CutMesh::Rim& CutMesh::rim(std::int32_t polygon) const {
  Rim& found = rims_[polygon];
  if (!found.corners.empty()) return found;
  const Rows rows = rows_of(polygon);
  // Two triangles pass a diagonal in opposite directions. The others lead around the polygon.
  std::set<std::pair<std::int32_t, std::int32_t>> left;
  for (std::int32_t row = rows.first; row < rows.last; ++row) {
    for (std::size_t i = 0; i < 3; ++i) {
      const std::int32_t from = triangle(row)[i], to = triangle(row)[(i + 1) % 3];
      if (left.erase({to, from}) == 0) left.emplace(from, to);
    }
  }
  const std::map<std::int32_t, std::int32_t> next(left.begin(), left.end());
  const std::int32_t first = triangle(rows.first)[0];
  std::vector<std::int32_t> around;
  std::int32_t v = first;
  do {
    around.push_back(v);
    const auto following = next.find(v);
    v = following == next.end() ? -1 : following->second;
  } while (v >= 0 && v != first && around.size() < left.size());
  if (v != first || around.size() != index(rows.last - rows.first) + 2) {
    rims_.erase(polygon);
    throw InvalidInput("polygon " + std::to_string(polygon) + ": its triangles do not form a polygon");
  }
  for (std::size_t i = 0; i < around.size(); ++i) found.places[around[i]] = i;
  found.corners = std::move(around);
  return found;
}

bool CutMesh::is_side(std::int32_t polygon, std::int32_t one, std::int32_t other) const {
  const Rim& around = rim(polygon);
  const auto first = around.places.find(one), second = around.places.find(other);
  if (first == around.places.end() || second == around.places.end()) return false;
  const std::size_t count = around.corners.size();
  return (first->second + 1) % count == second->second || (second->second + 1) % count == first->second;
}

}  // namespace seamwire::detail
