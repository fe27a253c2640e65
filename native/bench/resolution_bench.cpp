// SPDX-License-Identifier: GPL-3.0-or-later
//
// How exact distances on an embedding are, and what a max_error costs: a line a mesh, metric, maximum anisotropy and
// max_error, columns apart by tabs:
//   resolution_bench [--seeds N] [--most-faces N] MESH...
// Metrics: M_min and M_max of eq. 5. The reference is the exact solver on the embedding of the mesh cut into fours in
// its planes (refined()) as often as --most-faces (1,400,000) allows. Errors: mean and 95 % over the vertices, of these
// the medians over the seeds. Triangles are multiples of the mesh's, times of those without a max_error. Times are of
// the processor, one thread: of embedding, the lowest of three runs, of building the solver, and of a solve, the median
// over the seeds.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numeric>
#include <string>
#include <vector>

#include "direct_methods.hpp"
#include "mesh_input.hpp"
#include "seamwire/geodesics/exact_geodesics.hpp"

namespace seamwire::bench {
namespace {

struct Options {
  int seeds = 3, most_faces = 1'400'000;
};

struct Result {
  double triangles = 0, seconds = 0;
  std::vector<double> means{}, most{};  // errors, one a seed
  Resolution resolution{};
};

using Distances = std::vector<std::vector<double>>;  // a seed

Result measure(const Surface& surface, const Metric& metric, double max_error,
               const std::vector<std::int32_t>& seed_vertices, const Distances& references) {
  Embedding embedding;
  double embedding_time = std::numeric_limits<double>::infinity();
  for (int run = 0; run < 3; ++run) {
    const double time = seconds([&] { embedding = embed(surface, metric, {.max_error = max_error}); });
    embedding_time = std::min(embedding_time, time);
  }
  std::optional<ExactGeodesics> geodesics;
  const double building_time = seconds([&] { geodesics.emplace(embedding.mesh); });
  Result result{.triangles = static_cast<double>(embedding.mesh.face_count()),
                .resolution = embedding.resolution.value_or(Resolution{})};
  std::vector<double> solving_times;
  for (std::size_t i = 0; i < seed_vertices.size(); ++i) {
    std::vector<double> distances, errors;
    solving_times.push_back(seconds([&] { distances = geodesics->solve(seed_vertices[i]).distances(); }));
    for (std::size_t v = 0; v < surface.vertex_count(); ++v) {
      const double truth = references[i][v];
      if (truth > 0 && std::isfinite(truth)) errors.push_back(std::abs(distances[v] / truth - 1));
    }
    result.means.push_back(std::accumulate(errors.begin(), errors.end(), 0.0) / static_cast<double>(errors.size()));
    result.most.push_back(quantile(errors, 0.95));
  }
  result.seconds = embedding_time + building_time + median(solving_times);
  return result;
}

Distances solve(const Surface& surface, const Metric& metric, int levels, const std::vector<std::int32_t>& seeds) {
  const auto [fine, fine_metric] = refined(surface, metric, levels);
  const ExactGeodesics geodesics(embed(fine, fine_metric, {.max_error = 0}).mesh);
  Distances distances;
  for (const std::int32_t seed : seeds) distances.push_back(geodesics.solve(seed).distances());
  return distances;
}

void measure_mesh(const std::string& file, const Options& options) {
  const Surface surface = read_surface(file, 0);
  const Curvature curvature = principal_curvatures(surface);
  std::vector<std::int32_t> seeds;
  for (int i = 0; i < options.seeds; ++i) {
    const double part = (i + 0.5) / options.seeds;
    seeds.push_back(static_cast<std::int32_t>(part * static_cast<double>(surface.vertex_count())));
  }
  int levels = 0;
  for (std::size_t faces = 4 * surface.face_count(); faces <= std::size_t(options.most_faces); faces *= 4) ++levels;
  for (const double anisotropy : {20.0, 10.0, 5.0}) {
    for (const Follow follow : {Follow::kMin, Follow::kMax}) {
      const Metric metric = feature_metric(surface, curvature, follow, {.max_anisotropy = anisotropy});
      const Distances references = solve(surface, metric, levels, seeds);
      Result plain;
      for (const double max_error : {0.0, 0.02, 0.01}) {
        const Result result = measure(surface, metric, max_error, seeds, references);
        if (max_error == 0) plain = result;
        std::printf("%s\t%s\t%g\t%g\t%.3f\t%.3f\t%.2f\t%.2f\t%.4f\t%zu\n", mesh_name(file, 0).c_str(),
                    follow == Follow::kMin ? "min" : "max", anisotropy, max_error, 100 * median(result.means),
                    100 * median(result.most), result.triangles / static_cast<double>(surface.face_count()),
                    result.seconds / plain.seconds, result.resolution.estimated_error, result.resolution.unmet);
        std::fflush(stdout);
      }
    }
  }
}

int measure_all(int argc, char** argv) {
  Options options;
  return run(argc, argv, {{"--seeds", set_count(options.seeds, 1)}, {"--most-faces", set_count(options.most_faces, 1)}},
             [&](const std::string& mesh) { measure_mesh(mesh, options); });
}

}  // namespace
}  // namespace seamwire::bench

int main(int argc, char** argv) { return seamwire::bench::measure_all(argc, argv); }
