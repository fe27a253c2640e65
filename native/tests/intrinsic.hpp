// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "seamwire/surface/intrinsic_mesh.hpp"
#include "shapes.hpp"

/// Meshes known by their edge lengths, made from shapes.
namespace seamwire::shapes {

/// Glues triangles along the edges that exactly two of them share in opposite directions, makes all half-edges of other
/// edges siblings, and gives every edge the length length(a, b), a < b.
template <class Length>
IntrinsicMesh intrinsic(const Mesh& mesh, const Length& length) {
  IntrinsicMesh result;
  result.vertex_count = static_cast<std::int32_t>(mesh.points.size());
  result.triangles = mesh.triangles;
  const auto count = static_cast<std::int32_t>(3 * mesh.triangles.size());
  std::map<std::pair<int, int>, std::vector<std::int32_t>> half_edges_of;
  for (std::int32_t h = 0; h < count; ++h) {
    half_edges_of[std::minmax({result.tail(h), result.tip(h)})].push_back(h);
  }
  result.twins.assign(3 * mesh.triangles.size(), -1);
  result.lengths.assign(3 * mesh.triangles.size(), 0.0);
  for (const auto& [edge, half_edges] : half_edges_of) {
    const double its_length = length(edge.first, edge.second);
    for (const std::int32_t h : half_edges) result.lengths[static_cast<std::size_t>(h)] = its_length;
    if (half_edges.size() == 2 && result.tail(half_edges[0]) == result.tip(half_edges[1])) {
      result.twins[static_cast<std::size_t>(half_edges[0])] = half_edges[1];
      result.twins[static_cast<std::size_t>(half_edges[1])] = half_edges[0];
    } else if (half_edges.size() > 1) {
      result.siblings.resize(result.twins.size(), -1);
      for (std::size_t i = 0; i < half_edges.size(); ++i) {
        result.siblings[static_cast<std::size_t>(half_edges[i])] = half_edges[(i + 1) % half_edges.size()];
      }
    }
  }
  return result;
}

/// The lengths that the points have after a linear map.
inline IntrinsicMesh intrinsic(const Mesh& mesh, const Eigen::Matrix3d& map = Eigen::Matrix3d::Identity()) {
  return intrinsic(mesh, [&](int a, int b) {
    return (map * (mesh.points[static_cast<std::size_t>(a)] - mesh.points[static_cast<std::size_t>(b)])).norm();
  });
}

/// Closed and open ones, with and without vertices of more than a full turn.
struct Named {
  std::string name;
  Mesh mesh;
};

/// `detail`: 1 or 2; the reference solver's time grows with the square of the number of faces and with the stretch.
inline std::vector<Named> exactness_meshes(int detail) {
  const auto ring = [](const Vector& p) { return (p - Vector(0.5, 0.5, 0)).norm() < 0.23; };
  const auto cut = [](const Vector& p) { return p.x() > 0.1 && p.y() > 0.05 && p.z() > -0.1; };
  return {{"icosphere", icosphere(2)},
          {"bumpy sphere", bumpy(icosphere(1 + detail), 0.12)},
          {"torus", torus(12 * detail, 6 * detail)},
          {"bumpy torus", bumpy(torus(12 * detail, 7 * detail), 0.08, 2)},
          {"cylinder", cylinder(8 * detail, 5 * detail)},
          {"plane with a hole", without(grid(8 * detail, 0.2), ring)},
          {"bumpy sphere with a hole", without(bumpy(icosphere(1 + detail), 0.1, 3), cut)}};
}

}  // namespace seamwire::shapes
