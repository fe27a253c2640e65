// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// OpenMesh wants its IO before any mesh type.
#include <OpenMesh/Core/IO/MeshIO.hh>
#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>
#include <OpenMesh/Tools/Subdivider/Uniform/LoopT.hh>

#include <algorithm>
#include <cstddef>
#include <cstdio>
#include <ctime>
#include <exception>
#include <functional>
#include <map>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "seamwire/embedding/embedding.hpp"
#include "seamwire/metric/curvature.hpp"
#include "seamwire/metric/metric.hpp"

/// Functions that the benchmarks on files share.
namespace seamwire::bench {

struct DoubleTraits : OpenMesh::DefaultTraits {
  using Point = OpenMesh::Vec3d;
  using Normal = OpenMesh::Vec3d;
};
using FileMesh = OpenMesh::TriMesh_ArrayKernelT<DoubleTraits>;

/// A file that OpenMesh reads, subdivided `loop` times after Loop.
inline Surface read_surface(const std::string& file, int loop) {
  FileMesh mesh;
  if (!OpenMesh::IO::read_mesh(mesh, file)) throw std::runtime_error("cannot read " + file);
  if (loop > 0) {
    OpenMesh::Subdivider::Uniform::LoopT<FileMesh, double> subdivider;
    subdivider.attach(mesh);
    subdivider(static_cast<std::size_t>(loop));
    subdivider.detach();
    mesh.garbage_collection();
  }
  std::vector<Vector> points;
  std::vector<Triangle> triangles;
  for (const auto v : mesh.vertices()) {
    const OpenMesh::Vec3d& p = mesh.point(v);
    points.emplace_back(p[0], p[1], p[2]);
  }
  for (const auto f : mesh.faces()) {
    Triangle& triangle = triangles.emplace_back();
    std::transform(mesh.cfv_begin(f), mesh.cfv_end(f), triangle.begin(), [](auto v) { return v.idx(); });
  }
  return {std::move(points), std::move(triangles)};
}

inline std::string mesh_name(const std::string& file, int loop) {
  return file.substr(file.rfind('/') + 1) + (loop > 0 ? " loop" + std::to_string(loop) : "");
}

/// "euclidean", or "min" or "max": ours at the given strength.
inline Embedding embed_by_name(const Surface& surface, const std::string& metric, const Strength& strength) {
  const Curvature curvature = principal_curvatures(surface);
  if (metric == "euclidean") return embed(surface, euclidean_metric(surface, curvature), {.max_error = 0});
  return embed(surface, feature_metric(surface, curvature, metric == "min" ? Follow::kMin : Follow::kMax, strength),
               {.max_error = 0});
}
inline void check_metric_name(const std::string& metric) {
  if (metric != "euclidean" && metric != "min" && metric != "max") {
    throw std::runtime_error("--metric is euclidean, min or max");
  }
}

/// What work() takes of this thread's time, so that other programs count only where they take caches and memory.
inline double seconds(const std::function<void()>& work) {
  const auto now = [] {
    timespec time{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
    return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
  };
  const double start = now();
  work();
  return now() - start;
}

/// The value that `part` of the values do not exceed; 0.5: the median.
inline double quantile(std::vector<double> values, double part) {
  std::sort(values.begin(), values.end());
  return values[std::min(values.size() - 1, static_cast<std::size_t>(part * static_cast<double>(values.size())))];
}
inline double median(std::vector<double> values) { return quantile(std::move(values), 0.5); }

/// What each option "--name VALUE" does with its value.
using Setters = std::map<std::string, std::function<void(const std::string&)>>;
inline auto set_count(int& count, int least) {
  return [&count, least](const std::string& value) { count = std::max(least, std::stoi(value)); };
}
inline auto set_number(double& number) {
  return [&number](const std::string& value) { number = std::stod(value); };
}
inline auto set_metric(std::string& metric) {
  return [&metric](const std::string& value) { check_metric_name(metric = value); };
}

/// The main() of a benchmark whose command line is options and meshes: measure() for each mesh, once all options are
/// set.
inline int run(int argc, char** argv, const Setters& setters, const std::function<void(const std::string&)>& measure) {
  try {
    std::vector<std::string> meshes;
    for (int i = 1; i < argc; ++i) {
      const std::string argument = argv[i];
      if (!argument.starts_with("--")) {
        meshes.push_back(argument);
        continue;
      }
      const auto setter = setters.find(argument);
      if (setter == setters.end()) throw std::runtime_error("no such option: " + argument);
      if (++i == argc) throw std::runtime_error(argument + " needs a value");
      setter->second(argv[i]);
    }
    if (meshes.empty()) throw std::runtime_error("no mesh given");
    for (const std::string& mesh : meshes) measure(mesh);
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s: %s\n", argv[0], error.what());
    return 1;
  }
}

}  // namespace seamwire::bench
