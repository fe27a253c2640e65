// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

#include "seamwire/geodesics/exact_geodesics.hpp"

/// Properties of a path over an intrinsic mesh, computed without the solver's help.
namespace seamwire::paths {

inline std::size_t index(std::int32_t i) { return static_cast<std::size_t>(i); }

/// Calls see(other) for each other half-edge of an edge.
template <class See>
void for_each_beyond(const IntrinsicMesh& mesh, std::int32_t h, const See& see) {
  if (mesh.twins[index(h)] >= 0) see(mesh.twins[index(h)]);
  if (mesh.siblings.empty() || mesh.siblings[index(h)] < 0) return;
  for (std::int32_t other = mesh.siblings[index(h)]; other != h; other = mesh.siblings[index(other)]) see(other);
}

/// Where a point of a path lies in a triangle laid into the plane; fails if it lies in another triangle.
inline Eigen::Vector2d place(const IntrinsicMesh& mesh, std::int32_t face, const PathPoint& point) {
  const double a = mesh.lengths[index(3 * face)], b = mesh.lengths[index(3 * face + 1)],
               c = mesh.lengths[index(3 * face + 2)];
  const double x = (a * a + c * c - b * b) / (2 * a);
  const Eigen::Vector2d corners[3] = {{0, 0}, {a, 0}, {x, std::sqrt(std::max(c * c - x * x, 0.0))}};
  if (point.face >= 0) {
    EXPECT_EQ(point.face, face);
    const auto& w = point.barycentric;
    return w[0] * corners[0] + w[1] * corners[1] + w[2] * corners[2];
  }
  if (point.half_edge < 0) {
    for (std::size_t i = 0; i < 3; ++i) {
      if (mesh.triangles[index(face)][i] == point.vertex) return corners[i];
    }
    ADD_FAILURE() << "vertex " << point.vertex << " is no corner of triangle " << face;
    return {};
  }
  EXPECT_GE(point.t, 0.0);
  EXPECT_LE(point.t, 1.0);
  std::int32_t h = point.half_edge;
  for_each_beyond(mesh, point.half_edge, [&](std::int32_t other) { h = other / 3 == face ? other : h; });
  if (h / 3 != face) {
    ADD_FAILURE() << "half-edge " << point.half_edge << " is no edge of triangle " << face;
    return {};
  }
  const double t = mesh.tail(h) == mesh.tail(point.half_edge) ? point.t : 1 - point.t;
  const auto i = index(h % 3);
  return (1 - t) * corners[i] + t * corners[(i + 1) % 3];
}

/// The path's length, summed over its segments from nothing but the mesh's lengths.
inline double length_of(const IntrinsicMesh& mesh, const IntrinsicPath& path) {
  double sum = 0.0;
  EXPECT_EQ(path.faces.size() + 1, path.points.size());
  for (std::size_t i = 0; i < path.faces.size(); ++i) {
    const PathPoint &a = path.points[i], &b = path.points[i + 1];
    if (path.faces[i] >= 0) {
      sum += (place(mesh, path.faces[i], a) - place(mesh, path.faces[i], b)).norm();
      continue;
    }
    double shortest = std::numeric_limits<double>::infinity();
    for (const LooseEdge& edge : mesh.loose_edges) {
      const bool is_it = (edge.a == a.vertex && edge.b == b.vertex) || (edge.a == b.vertex && edge.b == a.vertex);
      if (is_it) shortest = std::min(shortest, edge.length);
    }
    sum += shortest;
  }
  return sum;
}

}  // namespace seamwire::paths
