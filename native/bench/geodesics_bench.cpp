// SPDX-License-Identifier: GPL-3.0-or-later
//
// Exact geodesics from one seed to all vertices, one line a mesh:
//   geodesics_bench [--loop LEVELS] [--metric euclidean|min|max] [--gamma G] [--seed VERTEX] [--repeats N] MESH...
// Times are medians. The sum of the distances tells whether two builds agree.

// OpenMesh wants its IO before any mesh type.
#include <OpenMesh/Core/IO/MeshIO.hh>
#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>
#include <OpenMesh/Tools/Subdivider/Uniform/LoopT.hh>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <functional>
#include <string>
#include <vector>

#include "seamwire/curvature.hpp"
#include "seamwire/embedding.hpp"
#include "seamwire/geodesics.hpp"
#include "seamwire/metric.hpp"

namespace {

using seamwire::Surface;

struct Options {
  int loop = 0, repeats = 5;
  std::int32_t seed = 0;
  std::string metric = "euclidean";
  double gamma = 0.1;
  std::vector<std::string> meshes;
};

struct DoubleTraits : OpenMesh::DefaultTraits {
  using Point = OpenMesh::Vec3d;
  using Normal = OpenMesh::Vec3d;
};
using FileMesh = OpenMesh::TriMesh_ArrayKernelT<DoubleTraits>;

Surface read(const std::string& file, int loop) {
  FileMesh mesh;
  if (!OpenMesh::IO::read_mesh(mesh, file)) throw std::runtime_error("cannot read " + file);
  if (loop > 0) {
    OpenMesh::Subdivider::Uniform::LoopT<FileMesh, double> subdivider;
    subdivider.attach(mesh);
    subdivider(static_cast<std::size_t>(loop));
    subdivider.detach();
    mesh.garbage_collection();
  }
  std::vector<seamwire::Vector> points;
  std::vector<seamwire::Triangle> triangles;
  for (const auto v : mesh.vertices()) {
    const OpenMesh::Vec3d& p = mesh.point(v);
    points.emplace_back(p[0], p[1], p[2]);
  }
  for (const auto f : mesh.faces()) {
    seamwire::Triangle& triangle = triangles.emplace_back();
    std::transform(mesh.cfv_begin(f), mesh.cfv_end(f), triangle.begin(), [](auto v) { return v.idx(); });
  }
  return {std::move(points), std::move(triangles)};
}

seamwire::Embedding embed(const Surface& surface, const Options& options) {
  const seamwire::Curvature curvature = seamwire::principal_curvatures(surface);
  if (options.metric == "euclidean") return seamwire::embed(surface, seamwire::euclidean_metric(surface, curvature));
  const auto follow = options.metric == "min" ? seamwire::Follow::kMin : seamwire::Follow::kMax;
  return seamwire::embed(surface, seamwire::feature_metric(surface, curvature, follow, {.parameter = options.gamma}));
}

double seconds(const std::function<void()>& work) {
  const auto start = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

/// Memory of this process in MB: the most since the last forget_peak() (field VmHWM) or now (VmRSS). Linux.
double memory(const std::string& field) {
  std::ifstream status("/proc/self/status");
  for (std::string line; std::getline(status, line);) {
    if (line.starts_with(field)) return std::stod(line.substr(field.size() + 1)) / 1024;
  }
  return std::nan("");
}
void forget_peak() { std::ofstream("/proc/self/clear_refs") << "5"; }

void measure(const std::string& file, const Options& options) {
  const Surface surface = read(file, options.loop);
  const seamwire::Embedding embedding = embed(surface, options);
  std::vector<double> building, solving, tracing;
  seamwire::GeodesicCounters counters;
  double checksum = 0.0, peak = 0.0;
  std::size_t crossings = 0;
  for (int i = 0; i < options.repeats; ++i) {
    std::unique_ptr<seamwire::ExactGeodesics> geodesics;
    building.push_back(seconds([&] { geodesics = std::make_unique<seamwire::ExactGeodesics>(embedding.mesh); }));
    std::unique_ptr<seamwire::DistanceField> field;
    forget_peak();
    const double before = memory("VmRSS");
    solving.push_back(seconds(
        [&] { field = std::make_unique<seamwire::DistanceField>(geodesics->solve(options.seed, {}, &counters)); }));
    peak = memory("VmHWM") - before;
    checksum = 0.0;
    for (const double d : field->distances()) checksum += std::isinf(d) ? 0.0 : d;
    const std::int32_t step = std::max(1, embedding.mesh.vertex_count / 1000);
    crossings = 0;
    const double traces = seconds([&] {
      for (std::int32_t v = 0; v < embedding.mesh.vertex_count; v += step) crossings += field->trace(v).points.size();
    });
    tracing.push_back(traces * step / embedding.mesh.vertex_count);
  }
  const double time = median(solving);
  std::printf(
      "%-28s %8zu faces %8.4f s  %9zu lists %10zu windows %6.1f ns/window  built %.4f s  %5.1f us/path  %6.1f MB  sum "
      "%.12g\n",
      (file.substr(file.rfind('/') + 1) + (options.loop > 0 ? " loop" + std::to_string(options.loop) : "")).c_str(),
      embedding.mesh.face_count(), time, counters.lists, counters.windows,
      1e9 * time / static_cast<double>(counters.windows), median(building), 1e6 * median(tracing), peak, checksum);
  std::fflush(stdout);
}

Options parse(int argc, char** argv) {
  Options options;
  for (int i = 1; i < argc; ++i) {
    const std::string argument = argv[i];
    const auto value = [&]() -> std::string {
      if (i + 1 == argc) throw std::runtime_error(argument + " needs a value");
      return argv[++i];
    };
    if (argument == "--loop") {
      options.loop = std::stoi(value());
    } else if (argument == "--repeats") {
      options.repeats = std::max(1, std::stoi(value()));
    } else if (argument == "--seed") {
      options.seed = std::stoi(value());
    } else if (argument == "--gamma") {
      options.gamma = std::stod(value());
    } else if (argument == "--metric") {
      options.metric = value();
      if (options.metric != "euclidean" && options.metric != "min" && options.metric != "max") {
        throw std::runtime_error("--metric is euclidean, min or max");
      }
    } else if (argument.starts_with("--")) {
      throw std::runtime_error("no such option: " + argument);
    } else {
      options.meshes.push_back(argument);
    }
  }
  if (options.meshes.empty()) throw std::runtime_error("no mesh given");
  return options;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    const Options options = parse(argc, argv);
    for (const std::string& mesh : options.meshes) measure(mesh, options);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "geodesics_bench: %s\n", error.what());
    return 1;
  }
}
