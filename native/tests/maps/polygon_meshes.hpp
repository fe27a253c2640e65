// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <random>
#include <vector>

#include "seamwire/surface/surface.hpp"
#include "shapes.hpp"

namespace seamwire::shapes {

/// How polygons become triangles: from their first corner, or as a strip between two of their sides.
enum class Cutting : std::uint8_t { kFan, kStrip };

/// A mesh of polygons of any size, with their sides as its real edges.
struct PolygonMesh {
  std::vector<Vector> points;
  std::vector<std::vector<std::int32_t>> polygons;

  std::vector<Edge> edges() const {
    std::vector<Edge> result;
    for (const auto& polygon : polygons) {
      for (std::size_t i = 0; i < polygon.size(); ++i) {
        const auto [a, b] = std::minmax(polygon[i], polygon[(i + 1) % polygon.size()]);
        result.push_back({a, b});
      }
    }
    std::ranges::sort(result);
    result.erase(std::unique(result.begin(), result.end()), result.end());
    return result;
  }
  std::vector<Triangle> triangles(Cutting cutting) const {
    std::vector<Triangle> result;
    for (const auto& p : polygons) {
      std::size_t low = 0, high = p.size() - 1;
      for (bool is_low = true; low + 1 < high; is_low = cutting == Cutting::kFan ? is_low : !is_low) {
        if (cutting == Cutting::kFan) {
          result.push_back({p[0], p[low + 1], p[low + 2]});
          if (++low + 2 >= p.size()) break;
        } else if (is_low) {
          result.push_back({p[low], p[low + 1], p[high]});
          ++low;
        } else {
          result.push_back({p[low], p[high - 1], p[high]});
          --high;
        }
      }
    }
    return result;
  }
  /// The polygon of each triangle.
  std::vector<std::size_t> polygon_of_triangles() const {
    std::vector<std::size_t> result;
    for (std::size_t i = 0; i < polygons.size(); ++i) result.insert(result.end(), polygons[i].size() - 2, i);
    return result;
  }
  Surface surface(Cutting cutting = Cutting::kFan) const { return Surface(points, triangles(cutting), edges()); }
};

inline PolygonMesh of_quads(const QuadMesh& mesh) {
  PolygonMesh result{mesh.points, {}};
  for (const auto& quad : mesh.quads) result.polygons.emplace_back(quad.begin(), quad.end());
  return result;
}

/// A closed cylinder: `rows` rows of n quads, and a polygon of n corners at each end.
inline PolygonMesh closed_cylinder(int n, int rows, double radius = 0.25, double height = 1.0) {
  PolygonMesh mesh = of_quads(quad_cylinder(n, rows, radius, height));
  std::vector<std::int32_t> bottom, top;
  for (int i = 0; i < n; ++i) {
    bottom.push_back(n - 1 - i);
    top.push_back(rows * n + i);
  }
  mesh.polygons.push_back(bottom);
  mesh.polygons.push_back(top);
  return mesh;
}

/// A ball: triangles at its poles, quads between.
inline PolygonMesh uv_ball(int n, int rings) {
  PolygonMesh mesh;
  for (int j = 0; j < rings; ++j) {
    const double b = std::numbers::pi * (j + 1) / (rings + 1);
    for (int i = 0; i < n; ++i) {
      const double a = 2 * std::numbers::pi * i / n;
      mesh.points.emplace_back(std::sin(b) * std::cos(a), std::sin(b) * std::sin(a), std::cos(b));
    }
  }
  const auto top = static_cast<std::int32_t>(mesh.points.size()), bottom = top + 1;
  mesh.points.emplace_back(0, 0, 1);
  mesh.points.emplace_back(0, 0, -1);
  for (int i = 0; i < n; ++i) {
    const int next = (i + 1) % n;
    mesh.polygons.push_back({top, i, next});
    for (int j = 0; j + 1 < rings; ++j) {
      mesh.polygons.push_back({j * n + i, (j + 1) * n + i, (j + 1) * n + next, j * n + next});
    }
    mesh.polygons.push_back({(rings - 1) * n + i, bottom, (rings - 1) * n + next});
  }
  return mesh;
}

/// A band of quads that meets itself turned over (a Moebius strip), or is closed across too (a Klein bottle).
inline PolygonMesh one_sided(int n, int across, bool is_closed) {
  PolygonMesh mesh;
  const int columns = is_closed ? across : across + 1;
  for (int j = 0; j < n; ++j) {
    for (int i = 0; i < columns; ++i) {
      const double a = 2 * std::numbers::pi * j / n, t = static_cast<double>(i) / across;
      if (is_closed) {
        const double b = 2 * std::numbers::pi * t;
        const double w = std::cos(a / 2) * std::sin(b) - std::sin(a / 2) * std::sin(2 * b);
        mesh.points.emplace_back((2 + w) * std::cos(a), (2 + w) * std::sin(a),
                                 std::sin(a / 2) * std::sin(b) + std::cos(a / 2) * std::sin(2 * b));
      } else {
        const double w = t - 0.5;
        mesh.points.emplace_back((1 + w * std::cos(a / 2)) * std::cos(a), (1 + w * std::cos(a / 2)) * std::sin(a),
                                 w * std::sin(a / 2));
      }
    }
  }
  const auto at = [&](int j, int i) {
    if (is_closed) i = (i + columns) % columns;
    if (j < n) return j * columns + i;
    return is_closed ? (columns - i) % columns : columns - 1 - i;
  };
  for (int j = 0; j < n; ++j) {
    for (int i = 0; i < across; ++i) mesh.polygons.push_back({at(j, i), at(j + 1, i), at(j + 1, i + 1), at(j, i + 1)});
  }
  return mesh;
}

}  // namespace seamwire::shapes
