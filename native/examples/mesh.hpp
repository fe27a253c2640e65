// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>
#include <cstdint>
#include <numbers>
#include <utility>
#include <vector>

#include "seamwire/surface/types.hpp"
#include "seamwire/surface/vector.hpp"

/// Meshes for the examples.
using Mesh = std::pair<std::vector<seamwire::Vector>, std::vector<seamwire::Triangle>>;

/// Returns a mesh of a grid of m times n points, with two triangles for each cell. Vertex i n + j is point(i, j).
template <class Point>
Mesh grid(std::int32_t m, std::int32_t n, bool closed, const Point& point) {
  Mesh mesh;
  for (std::int32_t i = 0; i < m; ++i) {
    for (std::int32_t j = 0; j < n; ++j) {
      mesh.first.push_back(point(i, j));
      if (!closed && (i + 1 == m || j + 1 == n)) continue;
      const auto at = [&](std::int32_t a, std::int32_t b) { return a % m * n + b % n; };
      mesh.second.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
      mesh.second.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
    }
  }
  return mesh;
}

/// Returns a sheet of 151 times 101 points with a winding ridge.
inline Mesh sheet() {
  return grid(151, 101, false, [](std::int32_t i, std::int32_t j) {
    const double x = -1.5 + 3.0 * i / 150, y = -1.0 + 2.0 * j / 100;
    return seamwire::Vector(x, y, 0.5 * std::exp(-std::hypot(y - 0.4 * std::sin(2.2 * x), 0.08) / 0.4));
  });
}

/// Returns a torus of 48 times 24 points.
inline Mesh torus() {
  return grid(48, 24, true, [](std::int32_t i, std::int32_t j) {
    const double u = 2 * std::numbers::pi * i / 48, v = 2 * std::numbers::pi * j / 24;
    return seamwire::Vector((3 + std::cos(v)) * std::cos(u), (3 + std::cos(v)) * std::sin(u), std::sin(v));
  });
}
