// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <random>
#include <vector>

#include "seamwire/embedding/embedding.hpp"
#include "seamwire/metric/scribble.hpp"
#include "surface/corner_fans.hpp"

/// What tests of embeddings share.
namespace seamwire::embeddings {

inline std::size_t at(std::int32_t i) { return static_cast<std::size_t>(i); }

/// The same tensor everywhere on a plane z = const: stretched by the roots of l1 along (cos, sin)(angle) and l2 across.
inline Metric plane_metric(const Surface& surface, double l1, double l2, double angle) {
  const Vector e1(std::cos(angle), std::sin(angle), 0), e2(-std::sin(angle), std::cos(angle), 0);
  const Eigen::Matrix3d tensor = l1 * e1 * e1.transpose() + l2 * e2 * e2.transpose();
  return {std::vector<Vector>(surface.vertex_count(), Vector::UnitZ()),
          std::vector<Eigen::Matrix3d>(surface.vertex_count(), tensor)};
}

/// The identity as a quadratic form on space, for surfaces whose normals do not matter.
inline Metric identity_metric(const Surface& surface) {
  return {std::vector<Vector>(surface.vertex_count(), Vector::Zero()),
          std::vector<Eigen::Matrix3d>(surface.vertex_count(), Eigen::Matrix3d::Identity())};
}

/// A stroke along a random walk over the vertices of a clean mesh.
inline Scribble random_scribble(const Surface& surface, std::mt19937& random, unsigned most_edges,
                                unsigned most_rings) {
  Scribble scribble;
  auto v = static_cast<std::int32_t>(random() % surface.vertex_count());
  for (std::size_t steps = 2 + random() % most_edges; steps > 0; --steps) {
    scribble.vertices.push_back(v);
    scribble.points.push_back(surface.points()[at(v)]);
    std::vector<std::int32_t> around;
    const detail::CornerFans& mesh = detail::corner_fans(surface);
    const bool is_open = mesh.for_each_leaving(v, [&](std::int32_t h) { around.push_back(mesh.tip(h)); });
    if (is_open) mesh.for_each_leaving(v, [&](std::int32_t h) { around.push_back(mesh.apex(h)); });
    v = around[random() % around.size()];
  }
  scribble.rings = 1 + static_cast<int>(random() % most_rings);
  scribble.eta = 2 + static_cast<double>(random() % 29);
  scribble.attracts = random() % 4 != 0;
  return scribble;
}

/// A metric that no smooth surface has: a random direction at each vertex, at anisotropy A.
inline Metric random_metric(const Surface& surface, double a, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> angle(0, std::numbers::pi);
  Metric metric = plane_metric(surface, 1, 1, 0);
  for (Eigen::Matrix3d& tensor : metric.tensors) {
    const double t = angle(random);
    const Vector e1(std::cos(t), std::sin(t), 0), e2(-std::sin(t), std::cos(t), 0);
    tensor = a * e1 * e1.transpose() + 1 / a * e2 * e2.transpose();
  }
  return metric;
}

inline double area(const Vector& a, const Vector& b, const Vector& c) { return (b - a).cross(c - a).norm() / 2; }

/// What every embedding must be. `left` is the area of its holes, if it may have any.
inline void expect_sound(const Surface& surface, const Embedding& embedding) {
  const IntrinsicMesh& mesh = embedding.mesh;
  const std::size_t n = mesh.face_count();
  ASSERT_EQ(mesh.lengths.size(), 3 * n);
  ASSERT_EQ(mesh.twins.size(), 3 * n);
  ASSERT_EQ(embedding.source_face.size(), n);
  ASSERT_EQ(embedding.points.size(), at(mesh.vertex_count));
  ASSERT_TRUE(std::equal(surface.points().begin(), surface.points().end(), embedding.points.begin()));
  for (std::size_t f = 0; f < n; ++f) {
    double sum = 0, longest = 0;
    for (std::size_t h = 3 * f; h < 3 * f + 3; ++h) {
      ASSERT_GT(mesh.lengths[h], 0);
      ASSERT_TRUE(std::isfinite(mesh.lengths[h]));
      sum += mesh.lengths[h];
      longest = std::max(longest, mesh.lengths[h]);
      const std::int32_t i = static_cast<std::int32_t>(h), twin = mesh.twins[h];
      if (twin < 0) continue;
      ASSERT_EQ(mesh.twins[at(twin)], i);
      ASSERT_EQ(mesh.lengths[at(twin)], mesh.lengths[h]);
      ASSERT_EQ(mesh.tail(twin), mesh.tip(i));
      ASSERT_EQ(mesh.tip(twin), mesh.tail(i));
    }
    ASSERT_LT(longest, (sum - longest) * (1 - 1e-10));
  }

  // Each refined face lies in its source face: its corners have barycentric coordinates there that are not negative.
  std::vector<double> covered(surface.face_count(), 0.0);
  for (std::size_t f = 0; f < n; ++f) {
    const Triangle& source = surface.triangles()[at(embedding.source_face[f])];
    const Vector &a = surface.points()[at(source[0])], &b = surface.points()[at(source[1])],
                 &c = surface.points()[at(source[2])];
    const double whole = area(a, b, c);
    for (const std::int32_t v : mesh.triangles[f]) {
      const Vector& p = embedding.points[at(v)];
      ASSERT_NEAR(area(p, b, c) + area(a, p, c) + area(a, b, p), whole, 1e-8 * whole) << "refined face " << f;
    }
    const Triangle& t = mesh.triangles[f];
    covered[at(embedding.source_face[f])] +=
        area(embedding.points[at(t[0])], embedding.points[at(t[1])], embedding.points[at(t[2])]);
  }
  if (embedding.invalid_left > 0 || !surface.report().duplicate_faces.empty()) return;
  for (std::size_t f = 0; f < surface.face_count(); ++f) {
    const auto& [a, b, c] = surface.triangles()[f];
    const double whole = area(surface.points()[at(a)], surface.points()[at(b)], surface.points()[at(c)]);
    EXPECT_NEAR(covered[f], whole, 1e-12 + 1e-9 * whole) << "face " << f;
  }
}

}  // namespace seamwire::embeddings
