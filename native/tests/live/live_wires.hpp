// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <gtest/gtest.h>

#include <array>
#include <memory>
#include <vector>

#include "seamwire/live/livewire.hpp"
#include "seamwire/metric/curvature.hpp"
#include "seamwire/metric/metric.hpp"
#include "shapes.hpp"

/// What tests of live wires share.
namespace seamwire::live_wires {

inline std::shared_ptr<const Surface> shared(const shapes::Mesh& mesh) {
  return std::make_shared<const Surface>(mesh.points, mesh.triangles);
}

inline Metric metric_of(const Surface& surface, Follow follow, const Strength& strength) {
  return feature_metric(surface, principal_curvatures(surface), follow, strength);
}

/// Wires are final in the embedding of the whole surface (live_refinement_test.cpp has the others).
inline const LiveWireOptions kPlain = {.max_error = 0.0};

inline const Strength kEdgeStrength = {.max_anisotropy = 10, .clamp_percentile = 99};
inline const LiveWireOptions kAlongEdges = {
    .along = Along::kEdges, .metrics = live_metrics(MetricFamily::kFeature, kEdgeStrength, Along::kEdges)};

inline LiveWireOptions in(MetricFamily family, const Strength& strength = {}, Along along = Along::kSurface) {
  return {.along = along, .metrics = live_metrics(family, strength, along), .max_error = 0.0};
}

inline const LiveWireOptions kConcave = in(MetricFamily::kConcave, {.parameter = 1.0});

/// Both wires to a vertex from a live wire that has just been made.
inline LiveWires fresh_wires(const std::shared_ptr<const Surface>& surface, const LiveWireOptions& options,
                             const Pick& from, const Pick& to) {
  LiveWireOptions plain = options;
  plain.max_error = 0.0;
  LiveWire live(surface, plain);
  live.seed(from);
  live.wait();
  return live.wires(to);
}

inline void expect_equal(const LiveWires& got, const LiveWires& expected) {
  EXPECT_TRUE(got.final());
  EXPECT_TRUE(got.settled);
  EXPECT_EQ(got.active, expected.active);
  ASSERT_EQ(got.wires.size(), expected.wires.size());
  for (std::size_t which = 0; which < got.wires.size(); ++which) {
    EXPECT_EQ(got.wires[which].points, expected.wires[which].points);
    EXPECT_EQ(got.wires[which].vertices, expected.wires[which].vertices);
    EXPECT_EQ(got.wires[which].length, expected.wires[which].length);
  }
}

/// The kinds of metrics that a live wire across the surface has if it is told nothing.
inline constexpr std::array kKinds = {MetricKind::kConcave, MetricKind::kMin, MetricKind::kMax};

/// In the library's default strength.
inline Metric default_metric_of(const Surface& surface, MetricKind kind) {
  if (kind != MetricKind::kConcave) {
    return metric_of(surface, kind == MetricKind::kMin ? Follow::kMin : Follow::kMax, {.parameter = 0.1});
  }
  return concave_metric(surface, smoothed_curvatures(surface, principal_curvatures(surface), 0.01));
}

}  // namespace seamwire::live_wires
