// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <numbers>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "seamwire/surface/surface.hpp"

/// Meshes with known answers, made on the spot.
namespace seamwire::shapes {

struct Mesh {
  std::vector<Vector> points;
  std::vector<Triangle> triangles;

  Surface surface() const { return Surface(points, triangles); }
};

/// The unit square in z = 0, n x n squares of two triangles each; inner vertices moved by up to `jitter` cell widths.
inline Mesh grid(int n, double jitter = 0.0, unsigned seed = 1) {
  Mesh mesh;
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> move(-jitter, jitter);
  for (int j = 0; j <= n; ++j) {
    for (int i = 0; i <= n; ++i) {
      const bool inner = i > 0 && j > 0 && i < n && j < n;
      const double dx = inner && jitter > 0 ? move(random) : 0.0;
      const double dy = inner && jitter > 0 ? move(random) : 0.0;
      mesh.points.emplace_back((i + dx) / n, (j + dy) / n, 0.0);
    }
  }
  for (int j = 0; j < n; ++j) {
    for (int i = 0; i < n; ++i) {
      const int a = j * (n + 1) + i, b = a + 1, c = a + n + 1, d = c + 1;
      mesh.triangles.push_back({a, b, d});
      mesh.triangles.push_back({a, d, c});
    }
  }
  return mesh;
}

/// An icosahedron subdivided `level` times, on the sphere of the given radius about the origin.
inline Mesh icosphere(int level, double radius = 0.5) {
  const double g = std::numbers::phi;
  Mesh mesh;
  mesh.points = {{-1, g, 0},  {1, g, 0},  {-1, -g, 0}, {1, -g, 0}, {0, -1, g},  {0, 1, g},
                 {0, -1, -g}, {0, 1, -g}, {g, 0, -1},  {g, 0, 1},  {-g, 0, -1}, {-g, 0, 1}};
  mesh.triangles = {{0, 11, 5},  {0, 5, 1},  {0, 1, 7},  {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4},
                    {11, 10, 2}, {10, 7, 6}, {7, 1, 8},  {3, 9, 4},  {3, 4, 2},   {3, 2, 6}, {3, 6, 8},
                    {3, 8, 9},   {4, 9, 5},  {2, 4, 11}, {6, 2, 10}, {8, 6, 7},   {9, 8, 1}};
  for (Vector& p : mesh.points) p = radius * p.normalized();
  for (int l = 0; l < level; ++l) {
    std::map<std::pair<int, int>, int> midpoints;
    const auto midpoint = [&](int a, int b) {
      const auto [it, is_new] = midpoints.try_emplace(std::minmax(a, b), static_cast<int>(mesh.points.size()));
      if (is_new) {
        mesh.points.push_back(
            radius *
            (mesh.points[static_cast<std::size_t>(a)] + mesh.points[static_cast<std::size_t>(b)]).normalized());
      }
      return it->second;
    };
    std::vector<Triangle> finer;
    for (const auto& [a, b, c] : mesh.triangles) {
      const int ab = midpoint(a, b), bc = midpoint(b, c), ca = midpoint(c, a);
      finer.insert(finer.end(), {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}});
    }
    mesh.triangles = std::move(finer);
  }
  return mesh;
}

/// A grid of nu x nv cells whose corners are at point(u, v), u and v in [0, 1]; closed in a direction where its flag is
/// set.
template <class PointAt>
Mesh parametric(int nu, int nv, bool closed_u, bool closed_v, const PointAt& point) {
  Mesh mesh;
  const int columns = nu + !closed_u, rows = nv + !closed_v;
  for (int j = 0; j < rows; ++j) {
    for (int i = 0; i < columns; ++i) mesh.points.push_back(point(double(i) / nu, double(j) / nv));
  }
  const auto at = [&](int i, int j) { return (j % rows) * columns + i % columns; };
  for (int j = 0; j < nv; ++j) {
    for (int i = 0; i < nu; ++i) {
      mesh.triangles.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
      mesh.triangles.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
    }
  }
  return mesh;
}

/// An open cylinder about the z axis: n cells around, `rows` along its height.
inline Mesh cylinder(int n, int rows, double radius = 0.25, double height = 1.0) {
  return parametric(n, rows, true, false, [=](double u, double v) {
    const double a = 2 * std::numbers::pi * u;
    return Vector(radius * std::cos(a), radius * std::sin(a), height * v);
  });
}

/// A torus about the z axis: nu cells around the axis, nv around the tube; v = 0 on the outer equator.
inline Mesh torus(int nu, int nv, double large = 0.35, double small = 0.15) {
  return parametric(nu, nv, true, true, [=](double u, double v) {
    const double a = 2 * std::numbers::pi * u, b = 2 * std::numbers::pi * v;
    const double ring = large + small * std::cos(b);
    return Vector(ring * std::cos(a), ring * std::sin(a), small * std::sin(b));
  });
}

/// A band of n squares of two triangles each. Its end is glued to its start after half a turn, at the edge (0, 1), the
/// only edge where its faces do not agree on a side.
inline Mesh moebius(int n) {
  Mesh mesh;
  for (int i = 0; i < n; ++i) {
    const double a = 2 * std::numbers::pi * i / n;
    for (const double w : {-0.1, 0.1}) {
      const double ring = 0.5 + w * std::cos(a / 2);
      mesh.points.emplace_back(ring * std::cos(a), ring * std::sin(a), w * std::sin(a / 2));
    }
  }
  for (int i = 0; i < n; ++i) {
    const bool last = i == n - 1;
    const int a = 2 * i, b = a + 1, c = last ? 1 : a + 2, d = last ? 0 : a + 3;
    mesh.triangles.push_back({a, c, b});
    mesh.triangles.push_back({c, d, b});
  }
  return mesh;
}

/// Every point moved by a smooth wave and by a random part, each up to `amount`: hills, dents and saddles.
inline Mesh bumpy(Mesh mesh, double amount, unsigned seed = 1) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> move(-amount, amount);
  for (Vector& p : mesh.points) {
    const double wave = amount * std::sin(17 * p.x()) * std::sin(13 * p.y() + 1) * std::cos(11 * p.z());
    const double dx = move(random), dy = move(random), dz = move(random);
    p = (1 + 4 * wave) * p + 0.3 * Vector(dx, dy, dz);
  }
  return mesh;
}

/// Without the triangles for which remove(center) holds; the points stay.
template <class Remove>
Mesh without(Mesh mesh, const Remove& remove) {
  std::erase_if(mesh.triangles, [&](const Triangle& t) {
    const auto point = [&](std::size_t i) -> const Vector& { return mesh.points[static_cast<std::size_t>(t[i])]; };
    return remove(Vector((point(0) + point(1) + point(2)) / 3));
  });
  return mesh;
}

/// A mesh of quads, with their sides as its real edges. The diagonals of its triangles are not real edges.
struct QuadMesh {
  std::vector<Vector> points;
  std::vector<std::array<std::int32_t, 4>> quads;

  std::vector<Triangle> triangles() const {
    std::vector<Triangle> result;
    for (const auto& [a, b, c, d] : quads) result.insert(result.end(), {{a, b, c}, {a, c, d}});
    return result;
  }
  std::vector<Edge> edges() const {
    std::vector<Edge> result;
    for (const auto& q : quads) {
      for (std::size_t i = 0; i < 4; ++i) {
        const auto [a, b] = std::minmax(q[i], q[(i + 1) % 4]);
        result.push_back({a, b});
      }
    }
    std::sort(result.begin(), result.end());
    result.erase(std::unique(result.begin(), result.end()), result.end());
    return result;
  }
  Surface surface() const { return Surface(points, triangles(), edges()); }
};

/// As parametric(), of quads. The corner (i, j) is vertex j * columns + i, with nu columns where u is closed, else
/// nu + 1.
template <class PointAt>
QuadMesh parametric_quads(int nu, int nv, bool closed_u, bool closed_v, const PointAt& point) {
  QuadMesh mesh;
  const int columns = nu + !closed_u, rows = nv + !closed_v;
  for (int j = 0; j < rows; ++j) {
    for (int i = 0; i < columns; ++i) mesh.points.push_back(point(double(i) / nu, double(j) / nv));
  }
  const auto at = [&](int i, int j) { return (j % rows) * columns + i % columns; };
  for (int j = 0; j < nv; ++j) {
    for (int i = 0; i < nu; ++i) mesh.quads.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)});
  }
  return mesh;
}

/// The unit square in z = 0, n x n quads.
inline QuadMesh quad_grid(int n) {
  return parametric_quads(n, n, false, false, [](double u, double v) { return Vector(u, v, 0.0); });
}

/// An open cylinder about the z axis: n quads around, `rows` along its height.
inline QuadMesh quad_cylinder(int n, int rows, double radius = 0.25, double height = 1.0) {
  return parametric_quads(n, rows, true, false, [=](double u, double v) {
    const double a = 2 * std::numbers::pi * u;
    return Vector(radius * std::cos(a), radius * std::sin(a), height * v);
  });
}

/// A torus about the z axis: nu quads around the axis, nv around the tube; v = 0 on the outer equator.
inline QuadMesh quad_torus(int nu, int nv, double large = 0.35, double small = 0.15) {
  return parametric_quads(nu, nv, true, true, [=](double u, double v) {
    const double a = 2 * std::numbers::pi * u, b = 2 * std::numbers::pi * v;
    const double ring = large + small * std::cos(b);
    return Vector(ring * std::cos(a), ring * std::sin(a), small * std::sin(b));
  });
}

/// The unit cube [0, 1]^3, each side n x n quads.
inline QuadMesh quad_cube(int n) {
  QuadMesh mesh;
  std::map<std::array<int, 3>, std::int32_t> numbers;
  const auto vertex = [&](const std::array<int, 3>& p) {
    const auto [it, is_new] = numbers.try_emplace(p, static_cast<std::int32_t>(mesh.points.size()));
    if (is_new) mesh.points.emplace_back(double(p[0]) / n, double(p[1]) / n, double(p[2]) / n);
    return it->second;
  };
  for (std::size_t axis = 0; axis < 3; ++axis) {
    for (const int side : {0, n}) {
      const auto corner = [&](int i, int j) {
        std::array<int, 3> p{};
        p[axis] = side;
        p[(axis + 1) % 3] = side == 0 ? j : i;  // so that all quads look outwards
        p[(axis + 2) % 3] = side == 0 ? i : j;
        return vertex(p);
      };
      for (int j = 0; j < n; ++j) {
        for (int i = 0; i < n; ++i) {
          mesh.quads.push_back({corner(i, j), corner(i + 1, j), corner(i + 1, j + 1), corner(i, j + 1)});
        }
      }
    }
  }
  return mesh;
}

/// A surface of revolution about the x axis: a pole at each end of `profile`, and a ring of n vertices at each other
/// point (x, radius) of it. Mirrored in y or z, triangles become triangles if n is a multiple of four; in x, if the
/// profile becomes itself.
inline Mesh lathe(int n, const std::vector<std::array<double, 2>>& profile) {
  Mesh mesh;
  const int rings = static_cast<int>(profile.size()) - 2;
  mesh.points.emplace_back(profile.front()[0], 0.0, 0.0);
  for (int j = 0; j < rings; ++j) {
    const auto [x, radius] = profile[static_cast<std::size_t>(j) + 1];
    for (int i = 0; i < n; ++i) {
      const double a = 2 * std::numbers::pi * i / n;
      mesh.points.emplace_back(x, radius * std::cos(a), radius * std::sin(a));
    }
  }
  mesh.points.emplace_back(profile.back()[0], 0.0, 0.0);
  const auto at = [&](int i, int j) { return 1 + j * n + i % n; };
  const int last = 1 + rings * n;
  for (int i = 0; i < n; ++i) mesh.triangles.push_back({0, at(i + 1, 0), at(i, 0)});
  for (int j = 0; j + 1 < rings; ++j) {
    for (int i = 0; i < n; ++i) {
      const int a = at(i, j), b = at(i + 1, j), c = at(i + 1, j + 1), d = at(i, j + 1);
      const bool is_first_half = 2 * (j + 1) <= rings - 1, has_y = std::cos(2 * std::numbers::pi * (i + 0.5) / n) > 0.0;
      const bool has_z = 2 * i < n;
      if ((is_first_half != has_y) != has_z) {
        mesh.triangles.insert(mesh.triangles.end(), {{a, b, c}, {a, c, d}});
      } else {
        mesh.triangles.insert(mesh.triangles.end(), {{a, b, d}, {b, c, d}});
      }
    }
  }
  for (int i = 0; i < n; ++i) mesh.triangles.push_back({at(i, rings - 1), at(i + 1, rings - 1), last});
  return mesh;
}

/// A large ball and two smaller ones at its sides, joined by necks; its own mirror image in x.
inline Mesh dumbbell(int n, int rings) {
  const auto ball = [](double x, double radius) { return std::sqrt(std::max(radius * radius - x * x, 0.0)); };
  std::vector<std::array<double, 2>> profile;
  for (int j = 0; j <= rings; ++j) {
    const double x = -std::cos(std::numbers::pi * j / rings);
    const double away = std::abs(x);
    const double neck = away < 0.8 ? 0.08 : 0.0;
    profile.push_back({x, std::max({ball(away, 0.45), ball(away - 0.78, 0.22), neck})});
  }
  return lathe(n, profile);
}

/// The surface of unit cubes in a plane, each side n x n quads. `rows`: which cubes of a plane are
/// there, such as {"###", "#.#", "###"} for a torus.
inline QuadMesh plate(const std::vector<std::string>& rows, int n) {
  QuadMesh mesh;
  std::map<std::array<int, 3>, std::int32_t> numbers;
  const auto vertex = [&](const std::array<int, 3>& p) {
    const auto [it, is_new] = numbers.try_emplace(p, static_cast<std::int32_t>(mesh.points.size()));
    if (is_new) mesh.points.emplace_back(double(p[0]) / n, double(p[1]) / n, double(p[2]) / n);
    return it->second;
  };
  const auto is_full = [&](int x, int y, int z) {
    const int height = static_cast<int>(rows.size());
    return z == 0 && y >= 0 && y < height && x >= 0 && x < static_cast<int>(rows[static_cast<std::size_t>(y)].size()) &&
           rows[static_cast<std::size_t>(y)][static_cast<std::size_t>(x)] == '#';
  };
  for (int y = 0; y < static_cast<int>(rows.size()); ++y) {
    for (int x = 0; x < static_cast<int>(rows[static_cast<std::size_t>(y)].size()); ++x) {
      for (std::size_t axis = 0; is_full(x, y, 0) && axis < 3; ++axis) {
        for (const int side : {0, 1}) {
          std::array<int, 3> cube = {x, y, 0}, neighbor = cube;
          neighbor[axis] += side == 1 ? 1 : -1;
          if (is_full(neighbor[0], neighbor[1], neighbor[2])) continue;
          const auto corner = [&](int i, int j) {
            std::array<int, 3> p = {n * cube[0], n * cube[1], n * cube[2]};
            p[axis] += side * n;
            p[(axis + 1) % 3] += side == 0 ? j : i;
            p[(axis + 2) % 3] += side == 0 ? i : j;
            return vertex(p);
          };
          for (int j = 0; j < n; ++j) {
            for (int i = 0; i < n; ++i) {
              mesh.quads.push_back({corner(i, j), corner(i + 1, j), corner(i + 1, j + 1), corner(i, j + 1)});
            }
          }
        }
      }
    }
  }
  return mesh;
}

}  // namespace seamwire::shapes
