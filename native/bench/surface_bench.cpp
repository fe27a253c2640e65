// SPDX-License-Identifier: GPL-3.0-or-later
//
// From triangles to an embedding: one line for each mesh and metric, with the milliseconds of each step. The columns
// are those of Fig. 8 of the paper: invalid triangles before, triangles added, and invalid ones left. Then follows the
// tree for rays: the milliseconds of building it, and the microseconds of a ray.
//   surface_bench [--anisotropy=A]... [MESH[+LEVELS]]... [Google Benchmark's options]
// MESH is a file that OpenMesh reads; +2 subdivides it twice, after Loop. Without a mesh: a bumpy torus of 20 000
// faces, and the same subdivided once. A is 20 if not given. --benchmark_counters_tabular=true makes it a table.
#include <benchmark/benchmark.h>

#include <Eigen/Geometry>
#include <OpenMesh/Core/IO/MeshIO.hh>
#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>
#include <OpenMesh/Tools/Subdivider/Uniform/LoopT.hh>
#include <cmath>
#include <cstdlib>
#include <ctime>
#include <iostream>
#include <memory>
#include <numbers>
#include <random>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "seamwire/embedding/embedding.hpp"
#include "seamwire/surface/ray_tree.hpp"

namespace {

using namespace seamwire;

struct Traits : OpenMesh::DefaultTraits {
  using Point = OpenMesh::Vec3d;
};
using LoopMesh = OpenMesh::TriMesh_ArrayKernelT<Traits>;

LoopMesh bumpy_torus(int nu, int nv) {
  LoopMesh mesh;
  for (int j = 0; j < nv; ++j) {
    for (int i = 0; i < nu; ++i) {
      const double u = 2 * std::numbers::pi * i / nu, v = 2 * std::numbers::pi * j / nv;
      const double tube = 0.15 * (1 + 0.1 * std::sin(5 * u) * std::sin(3 * v)), ring = 0.35 + tube * std::cos(v);
      mesh.add_vertex({ring * std::cos(u), ring * std::sin(u), tube * std::sin(v)});
    }
  }
  const auto vertex = [&](int i, int j) { return OpenMesh::VertexHandle(j % nv * nu + i % nu); };
  for (int j = 0; j < nv; ++j) {
    for (int i = 0; i < nu; ++i) {
      mesh.add_face(vertex(i, j), vertex(i + 1, j), vertex(i + 1, j + 1));
      mesh.add_face(vertex(i, j), vertex(i + 1, j + 1), vertex(i, j + 1));
    }
  }
  return mesh;
}

struct Triangles {
  std::vector<Vector> points;
  std::vector<Triangle> triangles;
};

Triangles subdivided(LoopMesh mesh, std::size_t levels) {
  if (levels > 0) {
    OpenMesh::Subdivider::Uniform::LoopT<LoopMesh> loop;
    loop.attach(mesh);
    loop(levels);
    loop.detach();
  }
  Triangles result;
  for (const auto v : mesh.vertices()) {
    const OpenMesh::Vec3d& p = mesh.point(v);
    result.points.emplace_back(p[0], p[1], p[2]);
  }
  for (const auto f : mesh.faces()) {
    Triangle triangle;
    std::size_t i = 0;
    for (const auto v : f.vertices()) triangle.at(i++) = v.idx();
    result.triangles.push_back(triangle);
  }
  return result;
}

/// Milliseconds of processor time since it was asked last: other work on the machine counts little.
class Watch {
 public:
  double lap() {
    const std::clock_t now = std::clock();
    return 1e3 * static_cast<double>(now - std::exchange(last_, now)) / CLOCKS_PER_SEC;
  }

 private:
  std::clock_t last_ = std::clock();
};

void register_metrics(const std::string& name, const Triangles& mesh, const std::vector<double>& anisotropies) {
  const auto data = std::make_shared<const Triangles>(mesh);
  for (const double a : anisotropies) {
    for (const Follow follow : {Follow::kMin, Follow::kMax}) {
      const std::string which = follow == Follow::kMin ? "/min/" : "/max/";
      const auto run = [=](benchmark::State& state) {
        double surface_ms = 0, curvature_ms = 0, metric_ms = 0, embed_ms = 0;
        Embedding embedding;
        for (auto _ : state) {
          Watch watch;
          const Surface surface(data->points, data->triangles);
          surface_ms += watch.lap();
          const Curvature curvature = principal_curvatures(surface);
          curvature_ms += watch.lap();
          const Metric metric = feature_metric(surface, curvature, follow, {.max_anisotropy = a});
          metric_ms += watch.lap();
          embedding = embed(surface, metric, {.max_error = 0});
          embed_ms += watch.lap();
        }
        using benchmark::Counter;
        const auto mean = [](double sum) { return Counter(sum, Counter::kAvgIterations); };
        const auto count = [](std::size_t n) { return Counter(static_cast<double>(n)); };
        state.counters["faces"] = count(data->triangles.size());
        state.counters["surface_ms"] = mean(surface_ms);
        state.counters["curvature_ms"] = mean(curvature_ms);
        state.counters["metric_ms"] = mean(metric_ms);
        state.counters["embed_ms"] = mean(embed_ms);
        state.counters["invalid"] = count(embedding.invalid_before);
        state.counters["added"] = count(embedding.faces_added);
        state.counters["left"] = count(embedding.invalid_left);
      };
      benchmark::RegisterBenchmark((name + which + std::to_string(static_cast<int>(a))).c_str(), run)
          ->Unit(benchmark::kMillisecond);
    }
  }
}

void register_rays(const std::string& name, const Triangles& mesh) {
  const auto run = [=](benchmark::State& state) {
    constexpr std::size_t kRays = 100'000;
    Eigen::AlignedBox3d box;
    for (const Vector& p : mesh.points) box.extend(p);
    double build_ms = 0, rays_ms = 0;
    std::size_t hits = 0;
    for (auto _ : state) {
      Watch watch;
      const RayTree tree(mesh.points, mesh.triangles);
      tree.wait();
      build_ms += watch.lap();
      std::mt19937 dice(1);
      std::uniform_real_distribution<double> coordinate(-1.0, 1.0);
      const auto draw = [&] { return Vector(coordinate(dice), coordinate(dice), coordinate(dice)); };
      for (std::size_t ray = 0; ray < kRays; ++ray) {
        const Vector origin = box.center() + draw().cwiseProduct(box.sizes());
        if (tree.first_hit(origin, draw()).triangle >= 0) ++hits;
      }
      rays_ms += watch.lap();
    }
    using benchmark::Counter;
    state.counters["faces"] = static_cast<double>(mesh.triangles.size());
    state.counters["build_ms"] = Counter(build_ms, Counter::kAvgIterations);
    state.counters["ray_us"] = Counter(1e3 * rays_ms / kRays, Counter::kAvgIterations);
    state.counters["hits"] = Counter(static_cast<double>(hits) / kRays, Counter::kAvgIterations);
  };
  benchmark::RegisterBenchmark((name + "/rays").c_str(), run)->Unit(benchmark::kMillisecond);
}

void register_mesh(const std::string& name, const Triangles& mesh, const std::vector<double>& anisotropies) {
  register_metrics(name, mesh, anisotropies);
  register_rays(name, mesh);
}

}  // namespace

int main(int argc, char** argv) {
  benchmark::Initialize(&argc, argv);
  std::vector<double> anisotropies;
  std::vector<std::string> paths;
  for (int i = 1; i < argc; ++i) {
    const std::string_view argument = argv[i], option = "--anisotropy=";
    if (argument.starts_with(option)) {
      anisotropies.push_back(std::strtod(argv[i] + option.size(), nullptr));
    } else {
      paths.emplace_back(argument);
    }
  }
  if (anisotropies.empty()) anisotropies = {20};
  if (paths.empty()) {
    for (const std::size_t levels : {0, 1}) {
      register_mesh("torus+" + std::to_string(levels), subdivided(bumpy_torus(142, 71), levels), anisotropies);
    }
  }
  for (const std::string& path : paths) {
    const std::size_t plus = path.find_last_of('+');
    const bool has_levels = plus != std::string::npos && plus + 1 < path.size() &&
                            path.find_first_not_of("0123456789", plus + 1) == std::string::npos;
    const std::string file = has_levels ? path.substr(0, plus) : path;
    const std::size_t levels = has_levels ? std::stoul(path.substr(plus + 1)) : 0;
    LoopMesh mesh;
    if (!OpenMesh::IO::read_mesh(mesh, file)) {
      std::cerr << "cannot read " << file << "\n";
      return 1;
    }
    register_mesh(path.substr(path.find_last_of('/') + 1), subdivided(std::move(mesh), levels), anisotropies);
  }
  benchmark::RunSpecifiedBenchmarks();
}
