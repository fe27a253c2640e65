// SPDX-License-Identifier: GPL-3.0-or-later
#include "decimation/decimation.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <numbers>
#include <optional>
#include <set>
#include <stop_token>
#include <tuple>
#include <utility>
#include <vector>

#if defined(__GLIBC__) && !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
#include <malloc.h>
#define HAS_MALLINFO2 __GLIBC_PREREQ(2, 33)
#endif

#include "seam_problems.hpp"

namespace seamwire {

using namespace detail;

namespace {

DecimatedMesh simplify(const SlitProblem& problem, std::size_t triangles) {
  return decimate(*problem.mesh, problem.is_seam, problem.mirror(), triangles, {});
}

std::int64_t euler(const PlanMesh& mesh) {
  return static_cast<std::int64_t>(mesh.vertex_count()) - static_cast<std::int64_t>(mesh.edge_count()) +
         static_cast<std::int64_t>(mesh.face_count());
}

/// Half-edges are twins of each other, and run in opposite directions.
void expect_manifold(const PlanMesh& mesh) {
  for (std::int32_t h = 0; h < static_cast<std::int32_t>(mesh.twins.size()); ++h) {
    const std::int32_t twin = mesh.twins[h];
    if (twin < 0) continue;
    ASSERT_EQ(mesh.twins[twin], h);
    ASSERT_EQ(mesh.tail(twin), mesh.tip(h));
    ASSERT_EQ(mesh.tip(twin), mesh.tail(h));
  }
  for (const Triangle& t : mesh.triangles) ASSERT_TRUE(t[0] != t[1] && t[1] != t[2] && t[2] != t[0]);
}

TEST(Decimation, KeepsShapeAndTopology) {
  for (const shapes::Mesh& shape : {shapes::icosphere(3), shapes::torus(40, 20), shapes::cylinder(24, 16)}) {
    const SlitProblem problem = problem_on(shape.surface());
    const DecimatedMesh simple = simplify(problem, 300);
    EXPECT_LE(simple.mesh.face_count(), 301U);
    EXPECT_GE(simple.mesh.face_count(), 250U);
    expect_manifold(simple.mesh);
    EXPECT_EQ(euler(simple.mesh), euler(*problem.mesh));
    double area = 0.0;
    for (const FaceFrame& frame : face_frames(simple.mesh, {})) area += frame.area;
    EXPECT_NEAR(area, 1.0, 0.05);
    for (std::size_t v = 0; v < simple.mesh.vertex_count(); ++v) {
      EXPECT_EQ(simple.mesh.points[v], problem.mesh->points[simple.vertices[v]]);
      EXPECT_EQ(simple.mesh.sources[v], problem.mesh->sources[simple.vertices[v]]);
    }
  }
}

TEST(Decimation, SpendsTrianglesWhereTheShapeBends) {
  // A flat square needs few triangles, and its outline stays.
  const SlitProblem problem = problem_on(shapes::grid(16).surface());
  const DecimatedMesh simple = simplify(problem, 8);
  EXPECT_LE(simple.mesh.face_count(), 8U);
  double area = 0.0;
  for (const FaceFrame& frame : face_frames(simple.mesh, {})) area += frame.area;
  EXPECT_NEAR(area, 1.0, 1e-12);
}

TEST(Decimation, KeepsSeams) {
  const shapes::Mesh shape = shapes::torus(40, 20);
  std::vector<Edge> seams;
  for (std::int32_t i = 0; i < 40; ++i) seams.push_back({i, (i + 1) % 40});
  const SlitProblem problem = problem_on(shape.surface(), {.seams = seams});
  const DecimatedMesh simple = simplify(problem, 300);
  double length = 0.0;
  std::vector<std::size_t> at(simple.mesh.vertex_count(), 0);
  for (std::size_t e = 0; e < simple.mesh.edge_count(); ++e) {
    if (simple.is_seam[e] == 0) continue;
    length += simple.mesh.lengths[e] / simple.mesh.scale;
    ++at[simple.mesh.tail(simple.mesh.half_edge_of[e])];
    ++at[simple.mesh.tip(simple.mesh.half_edge_of[e])];
  }
  EXPECT_NEAR(length, 2 * std::numbers::pi * 0.5, 0.1) << "the outer equator";
  for (const std::size_t count : at) EXPECT_TRUE(count == 0 || count == 2) << "it is closed";
}

TEST(Decimation, StaysSymmetric) {
  const SlitProblem problem = problem_on(shapes::dumbbell(24, 40).surface(), {.mirror = 0});
  ASSERT_TRUE(problem.reflection && problem.reflection->is_exact);
  const DecimatedMesh simple = simplify(problem, 500);
  EXPECT_LE(simple.mesh.face_count(), 520U);
  const std::optional<Reflection> found = find_reflection(simple.mesh, 0, {});
  ASSERT_TRUE(found);
  EXPECT_TRUE(found->is_exact);
  for (std::size_t v = 0; v < simple.mesh.vertex_count(); ++v) {
    ASSERT_GE(found->images[v], 0);
    const Vector image = found->mirrored(simple.mesh.points[v]);
    EXPECT_LT((simple.mesh.points[found->images[v]] - image).norm(), 1e-12);
  }
}

/// A fan around a vertex, or a cone over it: the vertex is the last one.
Surface fan(int count, double height) {
  std::vector<Vector> points;
  std::vector<Triangle> triangles;
  for (std::int32_t i = 0; i < count; ++i) {
    const double angle = 2 * std::numbers::pi * i / count;
    points.emplace_back(std::cos(angle), std::sin(angle), 0.0);
    triangles.push_back({i, (i + 1) % count, count});
  }
  points.emplace_back(0.0, 0.0, height);
  return {points, triangles};
}

TEST(Decimation, AVertexMayHaveManyTriangles) {
  // With work that grows with the square of their number, this test would not end.
  for (const double height : {0.0, 2.0}) {
    const PlanMesh mesh = plan_mesh(fan(100'000, height), {});
    const DecimatedMesh simple = decimate(mesh, std::vector<std::uint8_t>(mesh.edge_count(), 0), nullptr, 7000, {});
    EXPECT_LE(simple.mesh.face_count(), 7000U);
    EXPECT_EQ(euler(simple.mesh), 1);
    double area = 0.0;
    for (const FaceFrame& frame : face_frames(simple.mesh, {})) area += frame.area;
    EXPECT_NEAR(area, 1.0, 1e-3);
  }
}

/// Edges collapsed one by one as decimate() says, without its lists and its queue: each step looks at all triangles.
class PlainCollapsing {
 public:
  explicit PlainCollapsing(const SlitProblem& problem)
      : mesh_(*problem.mesh),
        reflection_(problem.reflection && problem.reflection->is_exact ? problem.mirror() : nullptr),
        triangles_(problem.mesh->triangles),
        quadrics_(problem.mesh->vertex_count()) {
    for (const Triangle& t : triangles_) {
      const FaceFrame frame = face_frame(mesh_, t);
      for (const std::int32_t v : t) quadrics_[v].add(frame.normal, mesh_.points[t[0]], frame.area);
    }
    for (std::int32_t e = 0; e < static_cast<std::int32_t>(mesh_.edge_count()); ++e) {
      if (problem.is_seam[e] == 0 && !mesh_.is_boundary(e)) continue;
      const std::int32_t h = mesh_.half_edge_of[e], a = mesh_.tail(h), b = mesh_.tip(h);
      features_.insert({{a, b}, {b, a}});
      const Vector along = mesh_.points[b] - mesh_.points[a];
      const Vector across = along.cross(face_frame(mesh_, mesh_.triangles[h / 3]).normal).normalized();
      for (const std::int32_t v : {a, b}) quadrics_[v].add(across, mesh_.points[a], 10.0 * along.squaredNorm());
    }
  }

  /// The triangles that are left.
  std::vector<Triangle> run(std::size_t goal) {
    while (triangles_.size() > goal) {
      std::optional<std::tuple<double, std::int32_t, std::int32_t>> next;
      for (const Triangle& t : triangles_) {
        for (std::size_t i = 0; i < 6; ++i) {
          const std::int32_t from = t[i % 3], to = t[(i + 1 + i / 3) % 3];
          if (tried_.contains({from, to})) continue;
          const std::tuple own(error(from, to), from, to);
          if (!next || own < *next) next = own;
        }
      }
      if (!next) break;
      tried_.insert({std::get<1>(*next), std::get<2>(*next)});
      collapse_with_image(std::get<1>(*next), std::get<2>(*next));
    }
    return triangles_;
  }

 private:
  struct Quadric {
    Eigen::Matrix3d a = Eigen::Matrix3d::Zero();
    Vector b = Vector::Zero();
    double c = 0.0;
    void add(const Vector& normal, const Vector& through, double weight) {
      const double d = -normal.dot(through);
      a += weight * normal * normal.transpose();
      b += weight * d * normal;
      c += weight * d * d;
    }
  };
  using Pair = std::pair<std::int32_t, std::int32_t>;

  static bool has(const Triangle& t, std::int32_t v) { return std::ranges::find(t, v) != t.end(); }
  std::vector<Triangle> around(std::int32_t v) const {
    std::vector<Triangle> found;
    std::ranges::copy_if(triangles_, std::back_inserter(found), [&](const Triangle& t) { return has(t, v); });
    return found;
  }
  std::set<std::int32_t> neighbors(std::int32_t v) const {
    std::set<std::int32_t> found;
    for (const Triangle& t : around(v)) found.insert(t.begin(), t.end());
    found.erase(v);
    return found;
  }
  std::int32_t feature_count(std::int32_t v) const {
    return static_cast<std::int32_t>(std::ranges::count(features_, v, &Pair::first));
  }
  double error(std::int32_t from, std::int32_t to) const {
    const Quadric &one = quadrics_[from], &other = quadrics_[to];
    const Vector& at = mesh_.points[to];
    return std::max(at.dot((one.a + other.a) * at) + 2.0 * (one.b + other.b).dot(at) + (one.c + other.c), 0.0);
  }

  bool may_collapse(std::int32_t from, std::int32_t to) const {
    const auto is_on_plane = [&](std::int32_t v) { return reflection_ != nullptr && reflection_->sides[v] == 0; };
    if (is_on_plane(from) && !is_on_plane(to)) return false;
    const bool is_at_feature = feature_count(from) > 0;
    if (is_at_feature && (feature_count(from) != 2 || !features_.contains({from, to}))) return false;
    if (around(from).size() > 64 || around(to).size() > 64) return false;
    const std::set<std::int32_t> one = neighbors(from), other = neighbors(to);
    std::vector<std::int32_t> common;
    std::ranges::set_intersection(one, other, std::back_inserter(common));
    const auto shared =
        std::ranges::count_if(triangles_, [&](const Triangle& t) { return has(t, from) && has(t, to); });
    if (shared == 0 || std::ssize(common) != shared) return false;
    for (const std::int32_t v : common) {
      if (features_.contains({from, v}) && features_.contains({to, v})) return false;
      if (!is_at_feature && neighbors(v).size() <= 3) return false;
    }
    return std::ranges::none_of(around(from), [&](const Triangle& t) { return !has(t, to) && folds(t, from, to); });
  }

  bool folds(const Triangle& t, std::int32_t from, std::int32_t to) const {
    std::array<Vector, 3> before, after;
    for (std::size_t i = 0; i < 3; ++i) {
      before[i] = mesh_.points[t[i]];
      after[i] = mesh_.points[t[i] == from ? to : t[i]];
    }
    const auto doubled = [](const std::array<Vector, 3>& p) { return Vector((p[1] - p[0]).cross(p[2] - p[0])); };
    const auto shape = [&](const std::array<Vector, 3>& p) {
      const double most =
          std::max({(p[1] - p[0]).squaredNorm(), (p[2] - p[1]).squaredNorm(), (p[0] - p[2]).squaredNorm()});
      return doubled(p).norm() / most;
    };
    const Vector was = doubled(before), is = doubled(after);
    return (shape(after) <= 0.02 && shape(after) <= shape(before)) || was.dot(is) < 0.2 * was.norm() * is.norm();
  }

  void collapse(std::int32_t from, std::int32_t to) {
    std::erase_if(triangles_, [&](const Triangle& t) { return has(t, from) && has(t, to); });
    for (Triangle& t : triangles_) std::ranges::replace(t, from, to);
    std::set<Pair> kept;
    for (auto [a, b] : features_) {
      a = a == from ? to : a;
      b = b == from ? to : b;
      if (a != b) kept.emplace(a, b);
    }
    features_ = std::move(kept);
    quadrics_[to].a += quadrics_[from].a;
    quadrics_[to].b += quadrics_[from].b;
    quadrics_[to].c += quadrics_[from].c;
  }

  void collapse_with_image(std::int32_t from, std::int32_t to) {
    const auto image = [&](std::int32_t v) { return reflection_ != nullptr ? reflection_->images[v] : v; };
    const std::int32_t from_image = image(from), to_image = image(to);
    const auto has_few = [&](std::int32_t v) { return neighbors(v).size() < 5; };
    if (!may_collapse(from, to)) return;
    if (from_image != from) {
      if (neighbors(from).contains(from_image) || (to == to_image && (has_few(from) || has_few(from_image)))) return;
      if (!may_collapse(from_image, to_image)) return;
    }
    collapse(from, to);
    if (from_image != from && may_collapse(from_image, to_image)) collapse(from_image, to_image);
    for (const std::int32_t v : {to, to_image}) {
      std::erase_if(tried_, [&](const Pair& pair) { return pair.first == v || pair.second == v; });
    }
  }

  const PlanMesh& mesh_;
  const Reflection* reflection_;
  std::vector<Triangle> triangles_;
  std::vector<Quadric> quadrics_;
  std::set<Pair> features_, tried_;
};

TEST(Decimation, IsThatOfAPlainQueue) {
  std::vector<Edge> equator;
  for (std::int32_t i = 0; i < 20; ++i) equator.push_back({i, (i + 1) % 20});
  const std::vector<SlitProblem> problems{
      problem_on(shapes::bumpy(shapes::icosphere(2), 0.05).surface()),
      problem_on(shapes::grid(12, 0.3).surface()),
      problem_on(shapes::bumpy(shapes::cylinder(16, 8), 0.02).surface()),
      problem_on(shapes::bumpy(shapes::torus(20, 10), 0.02).surface(), {.seams = equator}),
      problem_on(shapes::dumbbell(10, 20).surface(), {.mirror = 0}),
  };
  ASSERT_TRUE(problems.back().reflection && problems.back().reflection->is_exact);
  for (const SlitProblem& problem : problems) {
    for (const std::size_t goal : {problem.mesh->face_count() / 2, std::size_t{1}}) {
      const DecimatedMesh simple = simplify(problem, goal);
      std::vector<Triangle> found;
      for (Triangle t : simple.mesh.triangles) {
        for (std::int32_t& v : t) v = simple.vertices[v];
        found.push_back(t);
      }
      EXPECT_EQ(found, PlainCollapsing(problem).run(goal));
    }
  }
}

#if HAS_MALLINFO2
TEST(Decimation, HoldsFewBytesForEachTriangle) {
  const PlanMesh mesh = plan_mesh(shapes::icosphere(6).surface(), {});
  const std::vector<std::uint8_t> is_seam(mesh.edge_count(), 0);
  const auto in_use = [] {
    const struct mallinfo2 info = mallinfo2();
    return info.uordblks + info.hblkhd;
  };
  const std::size_t before = in_use();
  std::size_t most = before;
  const Task task{.stop = {}, .progress = [&](double) {
                    most = std::max(most, in_use());
                    return true;
                  }};
  decimate(mesh, is_seam, nullptr, mesh.face_count() / 10, task);
  EXPECT_GE(most - before, 50 * mesh.face_count()) << "it is not measured";
  EXPECT_LE(most - before, 150 * mesh.face_count());
}
#endif

TEST(Decimation, IsTheMeshIfThatIsSmall) {
  const SlitProblem problem = problem_on(shapes::icosphere(1).surface());
  const DecimatedMesh simple = simplify(problem, 100);
  EXPECT_EQ(simple.mesh.triangles, problem.mesh->triangles);
  EXPECT_EQ(simple.mesh.twins, problem.mesh->twins);
}

TEST(Decimation, ATetrahedronStaysOne) {
  const Surface surface({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}});
  EXPECT_EQ(simplify(problem_on(surface), 1).mesh.face_count(), 4U);
}

TEST(Decimation, IsCancelled) {
  const SlitProblem problem = problem_on(shapes::icosphere(3).surface());
  std::stop_source stop;
  stop.request_stop();
  const Task task{.stop = stop.get_token(), .progress = {}};
  EXPECT_THROW(decimate(*problem.mesh, problem.is_seam, nullptr, 100, task), Cancelled);
}

TEST(Decimation, AsksItsTaskWhileItStarts) {
  const PlanMesh mesh = plan_mesh(shapes::icosphere(6).surface(), {});
  std::size_t looks = 0;
  const Task task{.stop = {}, .progress = [&](double) { return ++looks > 0; }};
  decimate(mesh, std::vector<std::uint8_t>(mesh.edge_count(), 0), nullptr, mesh.face_count(), task);
  // Over its triangles, edges and vertices, with a look at the task once in 4096 steps.
  EXPECT_GE(looks, (mesh.face_count() + mesh.edge_count() + mesh.vertex_count()) / 4096);
}

}  // namespace
}  // namespace seamwire
