// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <random>
#include <string>
#include <vector>

#include "seamwire/surface/intrinsic_mesh.hpp"
#include "seamwire/surface/surface_point.hpp"

/// Points of intrinsic meshes, and meshes that have them as vertices.
namespace seamwire::points {

inline std::size_t index(std::int32_t i) { return static_cast<std::size_t>(i); }

/// Barycentric coordinates, or differences of them, in the plane of a face.
inline Eigen::Vector2d in_plane(const IntrinsicMesh& mesh, std::int32_t face, const std::array<double, 3>& weights) {
  const double a = mesh.lengths[index(3 * face)], b = mesh.lengths[index(3 * face + 1)],
               c = mesh.lengths[index(3 * face + 2)];
  const double x = (a * a + (c - b) * (c + b)) / (2 * a);
  return {weights[1] * a + weights[2] * x, weights[2] * std::sqrt(std::max((c - x) * (c + x), 0.0))};
}

/// How far a point is from a corner of its face.
inline double to_corner(const IntrinsicMesh& mesh, const SurfacePoint& point, std::size_t corner) {
  std::array<double, 3> apart = point.barycentric;
  apart[corner] = -(apart[(corner + 1) % 3] + apart[(corner + 2) % 3]);
  return in_plane(mesh, point.face, apart).norm();
}

/// The mesh with one vertex more, the last one: at a point within a face, which becomes three, or on an edge, whose
/// faces become two each. Other faces keep their numbers.
inline IntrinsicMesh insert(const IntrinsicMesh& mesh, const SurfacePoint& point) {
  IntrinsicMesh out = mesh;
  const std::int32_t v = out.vertex_count++;
  const auto face_count = [&] { return static_cast<std::int32_t>(out.triangles.size()); };
  const auto add_face = [&] {
    out.triangles.emplace_back();
    out.twins.resize(out.twins.size() + 3, -1);
    out.lengths.resize(out.lengths.size() + 3);
    return face_count() - 1;
  };
  const auto glue = [&](std::int32_t h, std::int32_t twin) {
    out.twins[index(h)] = twin;
    if (twin >= 0) out.twins[index(twin)] = h;
  };
  const auto set = [&](std::int32_t f, const Triangle& corners, const std::array<double, 3>& lengths) {
    out.triangles[index(f)] = corners;
    for (std::size_t i = 0; i < 3; ++i) out.lengths[index(3 * f) + i] = lengths[i];
  };
  const std::int32_t f = point.face;
  std::int32_t on = -1;
  for (std::int32_t i = 0; i < 3; ++i) {
    if (point.barycentric[index((i + 2) % 3)] == 0) on = i;
  }
  const auto length = [&](std::int32_t h) { return mesh.lengths[index(h)]; };
  const std::array away{to_corner(mesh, point, 0), to_corner(mesh, point, 1), to_corner(mesh, point, 2)};
  if (on < 0) {
    const auto [a, b, c] = mesh.triangles[index(f)];
    const std::int32_t g = add_face(), e = add_face();
    const std::int32_t over_b = mesh.twins[index(3 * f + 1)], over_c = mesh.twins[index(3 * f + 2)];
    set(f, {a, b, v}, {length(3 * f), away[1], away[0]});
    set(g, {b, c, v}, {length(3 * f + 1), away[2], away[1]});
    set(e, {c, a, v}, {length(3 * f + 2), away[0], away[2]});
    glue(3 * g, over_b == 3 * f + 2 ? 3 * e : over_b);
    glue(3 * e, over_c == 3 * f + 1 ? 3 * g : over_c);
    glue(3 * f + 1, 3 * g + 2);
    glue(3 * g + 1, 3 * e + 2);
    glue(3 * e + 1, 3 * f + 2);
    return out;
  }
  const std::int32_t twin = mesh.twins[index(3 * f + on)];
  const double to_tail = away[index(on)], to_tip = away[index((on + 1) % 3)];
  // The half of a face at the tail of its half-edge i keeps the number, that at the tip is new.
  const auto split = [&](std::int32_t face, std::int32_t i, double tail, double tip, double across) {
    const Triangle corners = mesh.triangles[index(face)];
    const std::int32_t a = corners[index(i)], b = corners[index((i + 1) % 3)], c = corners[index((i + 2) % 3)];
    const std::int32_t after = 3 * face + (i + 1) % 3, before = 3 * face + (i + 2) % 3;
    const std::int32_t over_after = mesh.twins[index(after)], over_before = mesh.twins[index(before)];
    const std::int32_t g = add_face();
    set(face, {a, v, c}, {tail, across, length(before)});
    set(g, {v, b, c}, {tip, length(after), across});
    glue(3 * face + 2, over_before);
    glue(3 * g + 1, over_after);
    glue(3 * face + 1, 3 * g + 2);
    return g;
  };
  const std::int32_t g = split(f, on, to_tail, to_tip, away[index((on + 2) % 3)]);
  out.twins[index(3 * f)] = out.twins[index(3 * g)] = -1;
  if (twin < 0) return out;
  SurfacePoint beyond;
  beyond.face = twin / 3;
  beyond.barycentric[index(twin % 3)] = point.barycentric[index((on + 1) % 3)];
  beyond.barycentric[index((twin % 3 + 1) % 3)] = point.barycentric[index(on)];
  const double across = to_corner(mesh, beyond, index((twin % 3 + 2) % 3));
  const std::int32_t e = split(twin / 3, twin % 3, to_tip, to_tail, across);
  glue(3 * f, 3 * e);
  glue(3 * g, 3 * (twin / 3));
  return out;
}

/// A number from [from, to), the same with every C++ library: only its generators are told by the standard, not what
/// its distributions make of them.
inline double draw(std::mt19937& random, double from, double to) {
  const auto low = static_cast<double>(random()), high = static_cast<double>(random());
  return (low + high * 0x1p32) * 0x1p-64 * (to - from) + from;
}
inline std::int32_t draw_below(std::mt19937& random, std::size_t count) {
  return static_cast<std::int32_t>(std::uint64_t{random()} * count >> 32);
}

struct Named {
  std::string name;
  SurfacePoint point;
};

/// Points of all kinds: within faces, close to corners and edges, on edges, on the boundary where there is one.
inline std::vector<Named> all_kinds(const IntrinsicMesh& mesh, unsigned seed) {
  std::mt19937 random(seed);
  const auto any_face = [&] { return draw_below(random, mesh.face_count()); };
  const auto at = [](std::int32_t face, double a, double b, double c) { return SurfacePoint{face, {a, b, c}}; };
  const double s = draw(random, 0.05, 0.95), t = draw(random, 0.05, 0.95);
  std::vector<Named> out{{"within a face", at(any_face(), s * t, s * (1 - t), 1 - s)},
                         {"close to a corner", at(any_face(), 1 - 3e-6, 1e-6, 2e-6)},
                         // Closer, and the lengths of a triangle between the two could not tell how close.
                         {"close to an edge", at(any_face(), 2e-3, t * 0.998, 0.998 * (1 - t))},
                         {"on an edge", at(any_face(), t, 0, 1 - t)},
                         {"on an edge, close to its end", at(any_face(), 1e-7, 1 - 1e-7, 0)}};
  for (std::int32_t h = 0; index(h) < mesh.twins.size(); ++h) {
    if (mesh.twins[index(h)] >= 0 || mesh.twins.size() < 60) continue;
    SurfacePoint point;
    point.face = h / 3;
    point.barycentric[index(h % 3)] = s;
    point.barycentric[index((h % 3 + 1) % 3)] = 1 - s;
    out.push_back({"on the boundary", point});
    break;
  }
  return out;
}

}  // namespace seamwire::points
