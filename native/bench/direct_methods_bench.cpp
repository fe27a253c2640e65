// SPDX-License-Identifier: GPL-3.0-or-later
//
// The methods of Section 2.3 of the paper beside exact geodesics on the embedding: error and time, a line a method,
// mesh and maximum anisotropy, columns apart by tabs:
//   direct_methods_bench [--seeds N] [--most-faces N] MESH...
// MESH is a file or "torus", "sphere": made here, with 20,000 triangles. Metric: M_min of eq. 5; on the sphere, which
// has no curvature lines, along the parallels. The reference is the exact solver on the embedding of the mesh cut into
// fours as often as --most-faces (1,000,000) allows; its own error is told by the one cut once less. Times are of the
// processor, one thread, medians over the seeds; what is built once a metric is told apart.
#include <Eigen/Geometry>
#include <cmath>
#include <cstdio>
#include <memory>

#include "../tests/shapes.hpp"
#include "direct_methods.hpp"
#include "mesh_input.hpp"
#include "seamwire/geodesics/exact_geodesics.hpp"

namespace seamwire::bench {
namespace {

struct Options {
  int seeds = 1, most_faces = 1'000'000;
};

Surface surface_of(const std::string& mesh) {
  if (mesh == "torus") return shapes::torus(140, 72).surface();
  if (mesh == "sphere") return shapes::icosphere(5).surface();
  return read_surface(mesh, 0);
}

Metric metric_of(const std::string& mesh, const Surface& surface, double anisotropy) {
  const Curvature curvature = principal_curvatures(surface);
  if (mesh != "sphere") return feature_metric(surface, curvature, Follow::kMin, {.max_anisotropy = anisotropy});
  Metric metric = euclidean_metric(surface, curvature);
  for (std::size_t v = 0; v < metric.size(); ++v) {
    const Vector& n = metric.normals[v];
    const Vector along = Vector::UnitZ().cross(n);  // its square falls to zero at the poles
    const double l1 = 1 + (anisotropy - 1) * along.squaredNorm();
    if (along.norm() < 1e-9) continue;
    const Vector e2 = along.normalized(), e1 = e2.cross(n);
    metric.tensors[v] = l1 * e1 * e1.transpose() + e2 * e2.transpose() / l1;
  }
  return metric;
}

std::vector<double> exact(const Surface& surface, const Metric& metric, std::int32_t seed) {
  return ExactGeodesics(embed(surface, metric).mesh).solve(seed).distances();
}

// Relative errors at the vertices that the reference reaches.
std::vector<double> errors(const std::vector<double>& distances, const std::vector<double>& reference,
                           std::size_t count) {
  std::vector<double> result;
  for (std::size_t v = 0; v < count; ++v) {
    if (reference[v] > 0 && std::isfinite(reference[v])) {
      result.push_back(std::abs(distances[v] - reference[v]) / reference[v]);
    }
  }
  return result;
}

void measure(const std::string& file, const Options& options) {
  const Surface surface = surface_of(file);
  const std::size_t count = surface.vertex_count();
  int levels = 0;
  for (std::size_t faces = 4 * surface.face_count(); faces <= std::size_t(options.most_faces); faces *= 4) ++levels;
  for (const double anisotropy : {2.0, 5.0, 10.0, 20.0}) {
    const Metric metric = metric_of(file, surface, anisotropy);
    const auto fine = refined(surface, metric, levels), coarser = refined(surface, metric, std::max(0, levels - 1));
    const MetricSurface input = metric_surface(surface, metric);
    std::vector<std::int32_t> seeds;
    std::vector<std::vector<double>> references;
    std::vector<double> own;
    for (int s = 0; s < options.seeds; ++s) {
      seeds.push_back(static_cast<std::int32_t>(count * std::size_t(s) / std::size_t(options.seeds)));
      references.push_back(exact(fine.first, fine.second, seeds.back()));
      const auto difference = errors(exact(coarser.first, coarser.second, seeds.back()), references.back(), count);
      own.insert(own.end(), difference.begin(), difference.end());
    }
    const auto line = [&](const char* method, double building, const std::vector<double>& solving,
                          const std::vector<double>& all) {
      double mean = 0.0;
      for (const double error : all) mean += error / static_cast<double>(all.size());
      std::printf("%s\t%zu\t%g\t%s\t%.2f\t%.2f\t%.3f\t%.3f\n", mesh_name(file, 0).c_str(), surface.face_count(),
                  anisotropy, method, 1e3 * building, 1e3 * median(solving), 100 * mean, 100 * quantile(all, 0.95));
      std::fflush(stdout);
    };
    const auto row = [&](const char* method, double building, const auto& solve) {
      std::vector<double> solving, all;
      for (std::size_t s = 0; s < seeds.size(); ++s) {
        std::vector<double> distances;
        solving.push_back(seconds([&] { distances = solve(seeds[s]); }));
        const auto error = errors(distances, references[s], count);
        all.insert(all.end(), error.begin(), error.end());
      }
      line(method, building, solving, all);
    };
    line("reference, once less", 0.0, {0.0}, own);
    row("Dijkstra", 0.0, [&](std::int32_t seed) { return edge_dijkstra(input, seed); });
    row("Steiner points, 5", 0.0, [&](std::int32_t seed) { return steiner_dijkstra(input, seed, 5); });
    row("STVD, 10", 0.0, [&](std::int32_t seed) { return short_term_vector_dijkstra(input, seed, 10); });
    row("ordered upwind", 0.0, [&](std::int32_t seed) { return ordered_upwind(input, seed); });
    std::unique_ptr<HeatMethod> heat;
    const double factoring = seconds([&] { heat = std::make_unique<HeatMethod>(input); });
    row("heat", factoring, [&](std::int32_t seed) { return heat->solve(seed); });
    Embedding embedding;
    const double embedding_time = seconds([&] { embedding = embed(surface, metric); });
    std::unique_ptr<FastMarching> marching;
    const double unfolding = seconds([&] { marching = std::make_unique<FastMarching>(embedding.mesh); });
    row("fast marching, embedded", embedding_time + unfolding,
        [&](std::int32_t seed) { return marching->solve(seed); });
    std::unique_ptr<ExactGeodesics> ours;
    const double building = seconds([&] { ours = std::make_unique<ExactGeodesics>(embedding.mesh); });
    row("ours", embedding_time + building, [&](std::int32_t seed) { return ours->solve(seed).distances(); });
  }
}

int measure_all(int argc, char** argv) {
  Options options;
  return run(argc, argv, {{"--seeds", set_count(options.seeds, 1)}, {"--most-faces", set_count(options.most_faces, 1)}},
             [&](const std::string& mesh) { measure(mesh, options); });
}

}  // namespace
}  // namespace seamwire::bench

int main(int argc, char** argv) { return seamwire::bench::measure_all(argc, argv); }
