// SPDX-License-Identifier: GPL-3.0-or-later
//
// A method that the library does not know: everything that takes a field works with it.
#include "seamwire/geodesics/distance_method.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "intrinsic.hpp"
#include "paths.hpp"
#include "seamwire/context/embedded_surface.hpp"
#include "seamwire/wires/closed_wires.hpp"
#include "shapes.hpp"

namespace seamwire {
namespace {

using paths::index;

/// Distances along edges, by Bellman and Ford. A point in a face counts as its nearest corner.
class SolvedAlongEdges final : public SolvedField {
 public:
  double distance(const SurfacePoint& point, const Task& task) const override {
    task.check(0.0);
    return distances[index(vertex_of(point))];
  }
  std::optional<IntrinsicPath> trace(const SurfacePoint& point, const Task& task) const override {
    task.check(0.0);
    const std::int32_t target = vertex_of(point);
    if (std::isinf(distances[index(target)])) return std::nullopt;
    IntrinsicPath path{.points = {{.vertex = target}}, .faces = {}, .length = distances[index(target)]};
    for (std::int32_t v = target; over[index(v)] >= 0;) {
      const std::int32_t h = over[index(v)];
      v = edges->tail(h) == v ? edges->tip(h) : edges->tail(h);
      path.points.push_back({.vertex = v});
      path.faces.push_back(h / 3);
    }
    std::ranges::reverse(path.points);
    std::ranges::reverse(path.faces);
    return path;
  }

  std::int32_t vertex_of(const SurfacePoint& point) const {
    if (point.vertex >= 0) return point.vertex;
    const auto corner = std::ranges::max_element(point.barycentric) - point.barycentric.begin();
    return edges->triangles[index(point.face)][static_cast<std::size_t>(corner)];
  }

  std::shared_ptr<const IntrinsicMesh> edges;
  std::vector<std::int32_t> over;  ///< per vertex the edge that its path arrives by, -1
};

class AlongEdges final : public DistanceMethod {
 public:
  explicit AlongEdges(const IntrinsicMesh& mesh) : mesh_(std::make_shared<const IntrinsicMesh>(mesh)) {}

 private:
  DistanceField solve_checked(std::span<const SurfacePoint> sources, const SolveOptions& options,
                              const Task& task) const override {
    auto solved = std::make_shared<SolvedAlongEdges>();
    solved->sources.assign(sources.begin(), sources.end());
    solved->distances.assign(index(mesh_->vertex_count), std::numeric_limits<double>::infinity());
    solved->radius = options.max_distance;
    solved->face_count = mesh_->face_count();
    solved->mesh = solved->edges = mesh_;
    solved->over.assign(index(mesh_->vertex_count), -1);
    for (const SurfacePoint& source : sources) solved->distances[index(source.vertex)] = 0.0;
    for (bool is_changed = true; is_changed;) {
      task.check(0.0);
      is_changed = false;
      for (std::int32_t h = 0; index(h) < mesh_->lengths.size(); ++h) {
        for (const auto& [from, to] : {std::pair(mesh_->tail(h), mesh_->tip(h)), {mesh_->tip(h), mesh_->tail(h)}}) {
          const double over_edge = solved->distances[index(from)] + mesh_->lengths[index(h)];
          if (!(over_edge < solved->distances[index(to)])) continue;
          solved->distances[index(to)] = over_edge;
          solved->over[index(to)] = h;
          is_changed = true;
        }
      }
    }
    return DistanceField(solved);
  }

  std::shared_ptr<const IntrinsicMesh> mesh_;
};

EmbeddedSurface embedded_torus() {
  const shapes::Mesh mesh = shapes::torus(40, 24);
  return {SurfaceContext(mesh.points, mesh.triangles), MetricSpec::euclidean()};
}

TEST(DistanceMethod, AnotherOneMakesFieldsAndWires) {
  const EmbeddedSurface embedded = embedded_torus();
  const AlongEdges method(embedded.embedding().mesh);
  const EmbeddedField exact = embedded.field(7), field = embedded.field(method, std::array{SurfacePoint(7)});
  EXPECT_EQ(field.distances().seed(), 7);
  EXPECT_TRUE(field.distances().fits(embedded.embedding().mesh));
  for (std::int32_t v = 0; index(v) < embedded.surface().vertex_count(); ++v) {
    EXPECT_GE(field.distance(v), exact.distance(v) * (1 - 1e-12));
  }
  const Wire wire = field.trace(500).value();
  EXPECT_EQ(wire.from, 7);
  EXPECT_EQ(wire.to, 500);
  EXPECT_NEAR(wire.length, field.distance(500), 1e-12);
  EXPECT_NEAR(wire.euclidean_length, wire.length, 1e-9);
  EXPECT_GT(wire.length, exact.trace(500)->length * 1.01);
}

TEST(DistanceMethod, AnotherOneSuggestsClosedWiresThatBend) {
  const EmbeddedSurface embedded = embedded_torus();
  const AlongEdges method(embedded.embedding().mesh);
  const EmbeddedField field = embedded.field(method, std::array{SurfacePoint(100)});
  const std::vector<ClosedWire> cuts = field.closed_wires();
  ASSERT_FALSE(cuts.empty());
  const std::optional<BentWire> bent = field.bend(cuts[0]).through(SurfacePoint(103));
  ASSERT_TRUE(bent);
  EXPECT_EQ(bent->there.points.back(), embedded.surface().points()[103]);
}

template <class Call>
std::string message_of(const Call& call) {
  try {
    call();
  } catch (const InvalidInput& error) {
    return error.what();
  }
  return "nothing was thrown";
}

TEST(DistanceMethod, RefusesWhatNoMethodCanSolve) {
  const IntrinsicMesh mesh = shapes::intrinsic(shapes::grid(3));
  const AlongEdges edges(mesh);
  const ExactGeodesics exact(mesh);
  for (const DistanceMethod* method : std::initializer_list<const DistanceMethod*>{&edges, &exact}) {
    EXPECT_EQ(message_of([&] { method->solve(std::span<const SurfacePoint>()); }), "no source to have distances from");
    EXPECT_EQ(message_of([&] { method->solve(std::array{SurfacePoint(0)}, {.max_distance = -1.0, .targets = {}}); }),
              "max_distance is -1, not 0 or more");
  }
  EXPECT_EQ(message_of([] { DistanceField(nullptr); }), "solved: must not be null");
  const EmbeddedSurface embedded = embedded_torus();
  EXPECT_EQ(message_of([&] { embedded.field(edges, std::array{SurfacePoint(0)}); }),
            "the field is of another embedding: it has 16 vertices, the embedding 960 vertices and 1920 triangles");
}

TEST(DistanceMethod, TheExactOneGivesTheSameBitsThroughTheInterface) {
  const ExactGeodesics exact(shapes::intrinsic(shapes::bumpy(shapes::icosphere(3), 0.1)));
  const DistanceMethod& method = exact;
  const ExactField field = exact.solve(5);
  const DistanceField same = method.solve(5);
  EXPECT_EQ(field.distances(), same.distances());
  EXPECT_EQ(field.trace(77)->length, same.trace(77)->length);
  EXPECT_GT(field.counters().windows, 1000U);
  EXPECT_FALSE(field.mesh_id().owner_before(same.mesh_id()) || same.mesh_id().owner_before(field.mesh_id()));
}

}  // namespace
}  // namespace seamwire
