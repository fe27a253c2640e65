// SPDX-License-Identifier: GPL-3.0-or-later
//
// Embeddings that resolve the metric (EmbedOptions::max_error), and embeddings of some faces (EmbedOptions::faces).
#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <optional>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "direct_methods.hpp"
#include "embeddings.hpp"
#include "seamwire/embedding/embedding.hpp"
#include "seamwire/geodesics/exact_geodesics.hpp"
#include "shapes.hpp"

namespace seamwire {

using namespace detail;

namespace {

using embeddings::at;
using embeddings::expect_sound;
using embeddings::identity_metric;
using embeddings::plane_metric;
using embeddings::random_metric;
using shapes::Mesh;

// On the unit square, with l1 along x from 1 to `most` and back from each column of vertices to the next, and 1 along
// y. Between the columns the form is linear, so the metric depends on x alone: with u the integral of sqrt(l1), it is
// du^2 + dy^2.
struct Accordion {
  Accordion(int n, double most) : surface(shapes::grid(n).surface()), metric(plane_metric(surface, 1, 1, 0)) {
    for (std::size_t v = 0; v < metric.size(); ++v) {
      const bool is_odd = std::lround(surface.points()[v].x() * n) % 2 == 1;
      metric.tensors[v] = Vector(is_odd ? most : 1.0, 1.0, 0.0).asDiagonal();
    }
    // The integral of sqrt(1 + (most - 1) t) for t from 0 to 1, of every column.
    stretch = 2.0 / 3.0 * (std::pow(most, 1.5) - 1) / (most - 1);
  }

  double distance(std::int32_t a, std::int32_t b) const {
    const Vector e = surface.points()[at(a)] - surface.points()[at(b)];
    return std::hypot(stretch * e.x(), e.y());
  }

  Surface surface;
  Metric metric;
  double stretch = 1.0;
};

TEST(MaxError, NeedsNothingMoreForAConstantTensorOnAPlane) {
  const Surface surface = shapes::grid(24, 0.3).surface();
  for (const double a : {1.0, 5.0, 100.0}) {
    for (const double angle : {0.0, 0.4, 2.9}) {
      for (const double wanted : {1.0, 0.01, 1e-8}) {
        const Embedding embedding = embed(surface, plane_metric(surface, a, 1 / a, angle), {.max_error = wanted});
        EXPECT_EQ(embedding.faces_added, 0U) << a;
        EXPECT_EQ(embedding.resolution->unmet, 0U);
        EXPECT_LT(embedding.resolution->estimated_error, 1e-9);
      }
    }
  }
}

// Directions that wave within few edges. The wave is its own mirror image, so each edge sees the same error on both of
// its sides.
struct Waves {
  Waves(int n, double a, double periods) : surface(shapes::grid(n).surface()), metric(plane_metric(surface, 1, 1, 0)) {
    for (std::size_t v = 0; v < metric.size(); ++v) {
      const Vector p = 2 * std::numbers::pi * periods * surface.points()[v];
      const double angle = std::numbers::pi / 4 * (1 + std::cos(p.x()) * std::cos(p.y()));
      const Vector e1(std::cos(angle), std::sin(angle), 0), e2(-e1.y(), e1.x(), 0);
      metric.tensors[v] = a * e1 * e1.transpose() + e2 * e2.transpose() / a;
    }
  }

  Surface surface;
  Metric metric;
};

// The mean error at all vertices, from one near the middle.
double mean_error(const DistanceField& field, const DistanceField& reference, std::size_t count) {
  double sum = 0;
  for (std::size_t v = 0; v < count; ++v) {
    if (reference.distances()[v] > 0) sum += std::abs(field.distances()[v] / reference.distances()[v] - 1);
  }
  return sum / static_cast<double>(count - 1);
}

TEST(MaxError, IsMetWhereTheMetricVariesWithinEdges) {
  for (const double a : {5.0, 10.0}) {
    const Waves waves(16, a, 2);
    const std::size_t count = waves.surface.vertex_count();
    const auto seed = static_cast<std::int32_t>(count / 2);
    const auto [fine, fine_metric] = bench::refined(waves.surface, waves.metric, 4);
    const DistanceField reference = ExactGeodesics(embed(fine, fine_metric, {.max_error = 0}).mesh).solve(seed);
    const auto error = [&](const Embedding& embedding) {
      return mean_error(ExactGeodesics(embedding.mesh).solve(seed), reference, count);
    };
    EXPECT_GT(error(embed(waves.surface, waves.metric, {.max_error = 0})), 0.012) << a;
    const Embedding embedding = embed(waves.surface, waves.metric, {.max_error = 0.01});
    EXPECT_LT(error(embedding), 0.01) << a;
    EXPECT_EQ(embedding.resolution->unmet, 0U);
    EXPECT_LE(embedding.resolution->estimated_error, 0.01);
    EXPECT_LT(embedding.faces_added, 3000U);
    expect_sound(waves.surface, embedding);
    const Embedding finer = embed(waves.surface, waves.metric, {.max_error = 0.001});
    EXPECT_LT(error(finer), error(embedding)) << a;
    EXPECT_LE(finer.resolution->estimated_error, 0.001);
  }
}

// The forms at the corners of refined faces, on a plane, where they are linear within a given face; by Eigen.
struct ByHand {
  double score = 0, deviation = 0;
};

Eigen::Matrix2d form_at(const Surface& surface, const Metric& metric, std::int32_t face, const Vector& p) {
  const Triangle& t = surface.triangles()[at(face)];
  const Vector &a = surface.points()[at(t[0])], &b = surface.points()[at(t[1])], &c = surface.points()[at(t[2])];
  const auto twice_area = [](const Vector& x, const Vector& y, const Vector& z) { return (y - x).cross(z - x).z(); };
  const double whole = twice_area(a, b, c);
  const Eigen::Matrix3d form = twice_area(p, b, c) / whole * metric.tensors[at(t[0])] +
                               twice_area(a, p, c) / whole * metric.tensors[at(t[1])] +
                               twice_area(a, b, p) / whole * metric.tensors[at(t[2])];
  return form.topLeftCorner<2, 2>();
}

double largest_log(const Eigen::Matrix2d& g, const Eigen::Matrix2d& h) {
  const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::Matrix2d> solver(h, g);
  return std::max(std::abs(std::log(solver.eigenvalues()[0])), std::abs(std::log(solver.eigenvalues()[1]))) / 2;
}

// Refined face f. The form of its lengths is what makes them those of its sides in the plane.
ByHand by_hand(const Surface& surface, const Metric& metric, const Embedding& embedding, std::size_t f) {
  const Triangle& t = embedding.mesh.triangles[f];
  Eigen::Matrix3d rows;
  Eigen::Vector3d squares;
  for (std::size_t i = 0; i < 3; ++i) {
    const Vector e = embedding.points[at(t[(i + 1) % 3])] - embedding.points[at(t[i])];
    const auto row = static_cast<Eigen::Index>(i);
    rows.row(row) << e.x() * e.x(), 2 * e.x() * e.y(), e.y() * e.y();
    squares[row] = std::pow(embedding.mesh.lengths[3 * f + i], 2);
  }
  const Eigen::Vector3d entries = rows.fullPivLu().solve(squares);
  Eigen::Matrix2d g, mean = Eigen::Matrix2d::Zero();
  g << entries[0], entries[1], entries[1], entries[2];
  ByHand result;
  for (const std::int32_t v : t) {
    const Eigen::Matrix2d form = form_at(surface, metric, embedding.source_face[f], embedding.points[at(v)]);
    result.deviation = std::max(result.deviation, largest_log(g, form));
    mean += form / 3;
  }
  const Vector &a = embedding.points[at(t[0])], &b = embedding.points[at(t[1])], &c = embedding.points[at(t[2])];
  const double area = embeddings::area(a, b, c) * std::sqrt(g.determinant());
  result.score = largest_log(g, mean) * std::sqrt(area) / embedding.mean_edge_length;
  return result;
}

TEST(MaxError, BoundsDistancesByTheLargestDeviation) {
  const Accordion accordion(6, 50);
  for (const double wanted : {0.2, 0.02, 0.002}) {
    const Embedding embedding = embed(accordion.surface, accordion.metric, {.max_error = wanted});
    const ExactGeodesics geodesics(embedding.mesh);
    double bound = 0, largest = 0;
    for (std::size_t f = 0; f < embedding.mesh.face_count(); ++f) {
      bound = std::max(bound, by_hand(accordion.surface, accordion.metric, embedding, f).deviation);
    }
    for (std::int32_t seed = 0; seed < 49; seed += 5) {
      const DistanceField field = geodesics.solve(seed);
      for (std::int32_t v = 0; v < 49; ++v) {
        if (v == seed) continue;
        largest = std::max(largest, std::abs(std::log(field.distances()[at(v)] / accordion.distance(seed, v))));
      }
    }
    EXPECT_LE(largest, bound) << wanted;
    EXPECT_GT(bound, 0) << wanted;
  }
}

TEST(MaxError, ReportsWhatIsThereInMetricsOfEveryKind) {
  for (unsigned seed = 0; seed < 24; ++seed) {
    const Surface surface = shapes::grid(3 + static_cast<int>(seed) % 5, 0.3, seed).surface();
    const Metric metric = random_metric(surface, 1.5 + 0.8 * seed, seed);
    const double wanted = seed % 3 == 0 ? 0.02 : seed % 3 == 1 ? 0.01 : 0.1;
    const EmbedOptions options{.max_faces_added = seed % 4 == 3 ? 400U : 4'000'000U, .max_error = wanted};
    const Embedding embedding = embed(surface, metric, options);
    expect_sound(surface, embedding);
    EXPECT_EQ(embedding.invalid_left, 0U);
    double sum = 0;
    std::size_t edges = 0, unmet = 0;
    for (const Edge& edge : surface.edges()) sum += edge_length(surface, metric, edge[0], edge[1]), ++edges;
    EXPECT_NEAR(embedding.mean_edge_length, sum / static_cast<double>(edges), 1e-12);
    double worst = 0;
    for (std::size_t f = 0; f < embedding.mesh.face_count(); ++f) {
      const double of = by_hand(surface, metric, embedding, f).score;
      worst = std::max(worst, of);
      unmet += of > 10 * wanted;
    }
    ASSERT_TRUE(embedding.resolution);
    EXPECT_NEAR(embedding.resolution->estimated_error, worst / 10, 1e-6 * worst);
    EXPECT_EQ(embedding.resolution->unmet, unmet);
    if (seed % 4 != 3) {
      EXPECT_EQ(unmet, 0U) << seed;
    }
  }
}

TEST(MaxError, OfZeroIsNotMeasured) {
  const Surface surface = shapes::grid(4).surface();
  EXPECT_FALSE(embed(surface, random_metric(surface, 10, 3), {.max_error = 0}).resolution);
}

TEST(MaxError, EndsAtTheCap) {
  const Surface surface = shapes::grid(12).surface();
  const Metric metric = random_metric(surface, 10, 3);
  const Embedding all = embed(surface, metric, {.max_error = 0.01});
  ASSERT_FALSE(all.hit_cap);
  double estimate = std::numeric_limits<double>::infinity();
  for (const std::size_t cap : {all.faces_added / 3, all.faces_added / 2, all.faces_added}) {
    const Embedding embedding = embed(surface, metric, {.max_faces_added = cap, .max_error = 0.01});
    EXPECT_LE(embedding.faces_added, cap);
    EXPECT_GE(embedding.faces_added, cap / 2);
    EXPECT_TRUE(embedding.hit_cap);
    EXPECT_EQ(embedding.invalid_left, 0U);
    EXPECT_GT(embedding.resolution->unmet, 0U);
    // The worst ones come first.
    EXPECT_LT(embedding.resolution->estimated_error, estimate);
    estimate = embedding.resolution->estimated_error;
    expect_sound(surface, embedding);
  }
  // Where the cap does not even allow all triangles to be valid, the result is what it is without a max_error.
  for (const std::size_t cap : {std::size_t{0}, std::size_t{1}, std::size_t{100}}) {
    const Embedding embedding = embed(surface, metric, {.max_faces_added = cap, .max_error = 0.01});
    const Embedding without = embed(surface, metric, {.max_faces_added = cap, .max_error = 0});
    EXPECT_EQ(embedding.hit_cap, without.hit_cap);
    EXPECT_EQ(embedding.invalid_left, without.invalid_left);
    EXPECT_EQ(embedding.mesh.triangles, without.mesh.triangles);
    EXPECT_EQ(embedding.mesh.lengths, without.mesh.lengths);
    EXPECT_TRUE(embedding.resolution);
  }
}

// The halves of an edge between nearly opposite normals may measure longer than the edge.
TEST(MaxError, EndsWhereNormalsAreOpposite) {
  const Surface surface = shapes::grid(10, 0.2).surface();
  std::mt19937 random(4);
  std::uniform_real_distribution<double> number(-1, 1);
  for (const double a : {5.0, 30.0}) {
    Metric metric = random_metric(surface, a, 7);
    for (std::size_t v = 0; v < metric.size(); v += 3) {
      const Vector n = Vector(number(random), number(random), number(random)).normalized();
      const Vector e = n.unitOrthogonal();
      metric.normals[v] = n;
      metric.tensors[v] = a * e * e.transpose() + n.cross(e) * n.cross(e).transpose() / a;
    }
    metric.normals[36] = -Vector::UnitZ();
    const Embedding embedding = embed(surface, metric, {.max_error = 0.02});
    EXPECT_FALSE(embedding.hit_cap);
    EXPECT_EQ(embedding.invalid_left, 0U);
    EXPECT_LT(embedding.faces_added, 200'000U);
    expect_sound(surface, embedding);
  }
}

TEST(MaxError, IsRefusedBelow0AndAbove1) {
  const Surface surface = shapes::grid(3).surface();
  const Metric metric = plane_metric(surface, 1, 1, 0);
  for (const double wrong : {-0.1, 1.1, std::numeric_limits<double>::quiet_NaN()}) {
    try {
      embed(surface, metric, {.max_error = wrong});
      ADD_FAILURE() << "nothing thrown";
    } catch (const InvalidInput& error) {
      EXPECT_TRUE(std::string(error.what()).starts_with("max_error is ")) << error.what();
    }
  }
  EXPECT_THROW(embed(surface, metric, {.max_error = 0, .mean_edge_length = -1}), InvalidInput);
  EXPECT_THROW(embed(surface, metric, {.max_error = 0, .mean_edge_length = std::numeric_limits<double>::infinity()}),
               InvalidInput);
}

TEST(MaxError, ReportsProgressAndStopsWhenTold) {
  const Surface surface = shapes::grid(20).surface();
  const Metric metric = random_metric(surface, 10, 3);
  const EmbedOptions options{.max_error = 0.01};
  std::vector<double> seen;
  embed(surface, metric, options, {.stop = {}, .progress = [&](double done) { return seen.push_back(done), true; }});
  EXPECT_TRUE(std::ranges::is_sorted(seen));
  EXPECT_EQ(seen.back(), 1);
  for (std::size_t most = 1; most < seen.size(); most += 3) {
    std::size_t calls = 0;
    EXPECT_THROW(embed(surface, metric, options, {.stop = {}, .progress = [&](double) { return ++calls < most; }}),
                 Cancelled);
  }
}

TEST(MaxError, ComparesWithTheLengthThatIsGiven) {
  const Surface surface = shapes::grid(12).surface();
  const Metric metric = random_metric(surface, 5, 3);
  const Embedding embedding = embed(surface, metric, {.max_error = 0.02});
  const double length = embedding.mean_edge_length;
  const Embedding same = embed(surface, metric, {.max_error = 0.02, .mean_edge_length = length});
  EXPECT_EQ(same.mesh.lengths, embedding.mesh.lengths);
  const Embedding finer = embed(surface, metric, {.max_error = 0.02, .mean_edge_length = length / 2});
  EXPECT_EQ(finer.mean_edge_length, length / 2);
  EXPECT_GT(finer.faces_added, embedding.faces_added);
}

TEST(MaxError, IsMeasuredInTheFirstLengthAfterAStroke) {
  const Surface surface = shapes::grid(12, 0.2).surface();
  const Metric former = random_metric(surface, 4, 3);
  Metric metric = former;
  for (std::size_t v = 0; v < 40; ++v) metric.tensors[v] *= 9;
  for (const double wanted : {0.0, 0.02}) {
    const Embedding old = embed(surface, former, {.max_error = wanted});
    const double length = old.mean_edge_length;
    const Embedding embedding = re_embed(surface, former, metric, old, {.max_error = wanted});
    EXPECT_EQ(embedding.mean_edge_length, length);
    const Embedding from_scratch = embed(surface, metric, {.max_error = wanted, .mean_edge_length = length});
    EXPECT_EQ(embedding.faces_added, from_scratch.faces_added);
    std::vector<double> a = embedding.mesh.lengths, b = from_scratch.mesh.lengths;
    std::ranges::sort(a);
    std::ranges::sort(b);
    EXPECT_EQ(a, b);
  }
}

// Some faces of a surface as a separate surface, in the same unit cube because of an edge.
struct Part {
  Part(const Mesh& mesh, const Metric& by, const std::vector<std::int32_t>& faces) : mesh(mesh) {
    std::vector<Triangle> triangles;
    for (const std::int32_t f : faces) triangles.push_back(mesh.triangles[at(f)]);
    std::vector<Edge> edges;
    for (std::int32_t v = 0; at(v) + 1 < mesh.points.size(); ++v) edges.push_back({v, v + 1});
    surface.emplace(mesh.points, triangles, edges);
    metric = by;
  }
  Mesh mesh;
  std::optional<Surface> surface;
  Metric metric;
};

TEST(EmbedFaces, IsEmbeddingTheSurfaceOfTheseFaces) {
  std::mt19937 random(3);
  const Mesh meshes[] = {shapes::grid(10, 0.2), shapes::bumpy(shapes::icosphere(3), 0.05), shapes::torus(24, 12)};
  for (const Mesh& mesh : meshes) {
    const Surface whole = mesh.surface();
    const Curvature curvature = principal_curvatures(whole);
    const Metric metric = whole.vertex_count() == 121
                              ? random_metric(whole, 8, 2)
                              : feature_metric(whole, curvature, Follow::kMax, {.max_anisotropy = 20});
    for (const double wanted : {0.0, 0.01}) {
      std::vector<std::int32_t> faces(whole.face_count());
      std::iota(faces.begin(), faces.end(), 0);
      std::ranges::shuffle(faces, random);
      faces.resize(faces.size() / 3);
      const Embedding embedding = embed(whole, metric, {.max_error = wanted, .faces = faces});
      std::ranges::sort(faces);
      const Part part(mesh, metric, faces);
      ASSERT_EQ(part.surface->scale(), whole.scale());
      const Embedding expected = embed(*part.surface, metric, {.max_error = wanted});
      EXPECT_EQ(embedding.faces_added, expected.faces_added);
      EXPECT_EQ(embedding.mean_edge_length, expected.mean_edge_length);
      EXPECT_EQ(embedding.faces_embedded, faces.size());
      EXPECT_EQ(embedding.invalid_before, expected.invalid_before);
      EXPECT_TRUE(embedding.unreachable.empty());
      EXPECT_FALSE(embedding.is_local);
      // A separate face may be turned over, so its sides may come in another order.
      std::vector<double> a = embedding.mesh.lengths, b = expected.mesh.lengths;
      std::ranges::sort(a);
      std::ranges::sort(b);
      EXPECT_EQ(a, b);
      ASSERT_EQ(embedding.points.size(), at(embedding.mesh.vertex_count));
      for (const std::int32_t f : embedding.source_face) EXPECT_TRUE(std::ranges::binary_search(faces, f));
      for (std::int32_t h = 0; at(h) < embedding.mesh.twins.size(); ++h) {
        const std::int32_t twin = embedding.mesh.twins[at(h)];
        if (twin >= 0) {
          ASSERT_EQ(embedding.mesh.tail(twin), embedding.mesh.tip(h));
        }
      }
    }
  }
}

TEST(EmbedFaces, OfAllFacesIsTheEmbedding) {
  const Surface surface = shapes::bumpy(shapes::icosphere(3), 0.05).surface();
  const Metric metric = feature_metric(surface, principal_curvatures(surface), Follow::kMax, {.max_anisotropy = 30});
  std::vector<std::int32_t> faces(surface.face_count());
  std::iota(faces.rbegin(), faces.rend(), 0);
  const Embedding all = embed(surface, metric, {.max_error = 0}),
                  listed = embed(surface, metric, {.max_error = 0, .faces = faces});
  EXPECT_EQ(listed.mesh.triangles, all.mesh.triangles);
  EXPECT_EQ(listed.mesh.twins, all.mesh.twins);
  EXPECT_EQ(listed.mesh.lengths, all.mesh.lengths);
  EXPECT_EQ(listed.source_face, all.source_face);
}

TEST(EmbedFaces, AreTheCallersAndKeepTheirNumbers) {
  // Face 0 is degenerate and left out, face 2 has no area and is flipped with face 1 or 3.
  const Surface surface({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {.5, .5, 0}, {2, 0, 0}},
                        {{0, 0, 1}, {0, 1, 2}, {0, 2, 4}, {0, 4, 3}, {4, 2, 3}, {1, 5, 2}});
  const Metric metric = identity_metric(surface);
  const Embedding embedding = embed(surface, metric, {.max_error = 0, .faces = std::vector<std::int32_t>{5, 5, 0}});
  EXPECT_EQ(embedding.source_face, std::vector<std::int32_t>{5});
  EXPECT_EQ(embedding.mesh.triangles, std::vector<Triangle>({{1, 5, 2}}));
  const Embedding flipped = embed(surface, metric, {.max_error = 0, .faces = std::vector<std::int32_t>{1, 2, 3, 4}});
  EXPECT_EQ(flipped.invalid_left, 0U);
  EXPECT_EQ(flipped.mesh.face_count(), 4U);
  EXPECT_EQ(std::ranges::count(flipped.mesh.twins, -1), 4);
  const Embedding none = embed(surface, metric, {.max_error = 0, .faces = std::vector<std::int32_t>{}});
  EXPECT_EQ(none.mesh.face_count(), 0U);
  EXPECT_TRUE(none.unreachable.empty());
  try {
    embed(surface, metric, {.max_error = 0, .faces = std::vector<std::int32_t>{1, 6}});
    ADD_FAILURE() << "nothing thrown";
  } catch (const InvalidInput& error) {
    EXPECT_STREQ(error.what(), "faces: face 6 is out of range: there are 6 faces");
  }
}

// Tensors of other faces do not matter, and are not looked at.
TEST(EmbedFaces, LeavesOtherFacesAlone) {
  const Surface surface = shapes::grid(10).surface();
  Metric metric = plane_metric(surface, 1, 1, 0);
  metric.tensors[120](0, 0) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(embed(surface, metric, {.max_error = 0, .faces = std::vector<std::int32_t>{0, 1, 2}}).mesh.face_count(),
            3U);
  EXPECT_THROW(embed(surface, metric, {.max_error = 0, .faces = std::vector<std::int32_t>{0, 199}}), InvalidInput);
}

}  // namespace
}  // namespace seamwire
