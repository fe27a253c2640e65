// SPDX-License-Identifier: GPL-3.0-or-later
//
// The methods of Section 2.3 of the paper beside exact geodesics on the embedding:
//   direct_methods_bench [--seeds N] [--most-faces N] [--only NAME]... [--anisotropy A]... MESH...
// Prints error and time, a line for each method, mesh and maximum anisotropy, with tabs between columns. MESH is a
// file, or "torus" or "sphere", which are made here with 20,000 triangles. With --only, it measures methods whose names
// begin with one of the given ones. The anisotropies are 2, 5, 10 and 20, unless others are given.
//
// The metric is M_min of eq. 5. On the sphere, which has no curvature lines, it runs along the parallels. All methods
// approximate the same problem: the mesh's polyhedron, with forms between vertices as repeated halving of edges gives
// them (refined()).
//
// The reference is the exact solver on the embedding of a finer mesh: the mesh cut into fours as often as --most-faces
// (1,400,000) allows. Two checks show how good the reference is. The first is the same solver with one cut less. The
// second is Dijkstra over 7 and 15 Steiner points for each edge of the mesh cut once, extrapolated, from the first
// seed. It shares nothing with the embedding.
//
// The saddle vertex graph is made on the embedding. Lines that end in "beside ours" have its error against exact
// distances on the embedding.
//
// Errors are the mean and the 95th percentile over the vertices, as medians over the seeds. Times are processor time of
// one thread, as medians over the seeds. The time to build what each metric needs once is separate.
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

#include "../tests/shapes.hpp"
#include "direct_methods.hpp"
#include "mesh_input.hpp"
#include "seamwire/geodesics/exact_geodesics.hpp"

namespace seamwire::bench {
namespace {

struct Options {
  int seeds = 5, most_faces = 1'400'000;
  std::vector<std::string> only{};  ///< beginnings of names; empty: all methods
  std::vector<double> anisotropies{};

  bool is_wanted(const std::string& method) const {
    return only.empty() || std::ranges::any_of(only, [&](const std::string& name) { return method.starts_with(name); });
  }
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

ExactGeodesics solver(const Surface& surface, const Metric& metric, int levels) {
  const auto [fine, fine_metric] = refined(surface, metric, levels);
  return ExactGeodesics(embed(fine, fine_metric, {.max_error = 0}).mesh);
}

// Dijkstra over Steiner points errs by the square of their spacing, which is halved here.
std::vector<double> dense_steiner(const Surface& surface, const Metric& metric, std::int32_t seed) {
  const auto [fine, fine_metric] = refined(surface, metric, 1);
  const MetricSurface input = metric_surface(fine, fine_metric);
  const std::vector<double> wide = steiner_dijkstra(input, seed, 7);
  std::vector<double> result = steiner_dijkstra(input, seed, 15);
  for (std::size_t v = 0; v < result.size(); ++v) result[v] -= (wide[v] - result[v]) / 3;
  return result;
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
  for (const double anisotropy : options.anisotropies) {
    const Metric metric = metric_of(file, surface, anisotropy);
    const MetricSurface input = metric_surface(surface, metric);
    std::vector<std::int32_t> seeds(static_cast<std::size_t>(options.seeds));
    for (std::size_t i = 0; i < seeds.size(); ++i) seeds[i] = static_cast<std::int32_t>(count * i / seeds.size());
    const auto solve_all = [&](int cuts) {
      const ExactGeodesics fine = solver(surface, metric, cuts);
      std::vector<std::vector<double>> distances;
      for (const std::int32_t seed : seeds) {
        distances.push_back(fine.solve(seed).distances());
        distances.back().resize(count);
      }
      return distances;
    };
    const std::vector<std::vector<double>> references = solve_all(levels);
    // A row of the first seeds' distances.
    const auto line = [&](const std::string& method, double building, const std::vector<double>& solving,
                          const std::vector<std::vector<double>>& distances,
                          const std::vector<std::vector<double>>& expected) {
      std::vector<double> means, most;
      for (std::size_t i = 0; i < distances.size(); ++i) {
        const std::vector<double> all = errors(distances[i], expected[i], count);
        means.push_back(std::accumulate(all.begin(), all.end(), 0.0) / static_cast<double>(all.size()));
        most.push_back(quantile(all, 0.95));
      }
      std::printf("%s\t%zu\t%g\t%s\t%.2f\t%.2f\t%.3f\t%.3f\n", mesh_name(file, 0).c_str(), surface.face_count(),
                  anisotropy, method.c_str(), 1e3 * building, 1e3 * median(solving), 100 * median(means),
                  100 * median(most));
      std::fflush(stdout);
    };
    const auto row = [&](const std::string& method, double building, const auto& solve) {
      std::vector<double> solving(seeds.size());
      std::vector<std::vector<double>> distances(seeds.size());
      if (!options.is_wanted(method)) return distances;
      for (std::size_t i = 0; i < seeds.size(); ++i) {
        solving[i] = seconds([&] { distances[i] = solve(seeds[i]); });
      }
      line(method, building, solving, distances, references);
      return distances;
    };
    if (options.is_wanted("reference")) {
      line("reference, once less", 0.0, {0.0}, solve_all(std::max(0, levels - 1)), references);
      line("reference, Steiner points", 0.0, {0.0}, {dense_steiner(surface, metric, seeds.front())}, references);
    }
    row("Dijkstra", 0.0, [&](std::int32_t seed) { return edge_dijkstra(input, seed); });
    row("Steiner points, 5", 0.0, [&](std::int32_t seed) { return steiner_dijkstra(input, seed, 5); });
    row("STVD, 3", 0.0, [&](std::int32_t seed) { return short_term_vector_dijkstra(input, seed, 3); });
    row("STVD, 10", 0.0, [&](std::int32_t seed) { return short_term_vector_dijkstra(input, seed, 10); });
    row("ordered upwind", 0.0, [&](std::int32_t seed) { return ordered_upwind(input, seed); });
    for (const auto& [name, steps] : {std::pair("heat", 1.0), std::pair("heat, 64", 64.0)}) {
      std::unique_ptr<HeatMethod> heat;
      const double factoring = seconds([&] { heat = std::make_unique<HeatMethod>(input, steps); });
      row(name, factoring, [&](std::int32_t seed) { return heat->solve(seed); });
    }
    Embedding embedding;
    const double embedding_time = seconds([&] { embedding = embed(surface, metric, {.max_error = 0}); });
    std::unique_ptr<FastMarching> marching;
    const double unfolding = seconds([&] { marching = std::make_unique<FastMarching>(embedding.mesh); });
    row("fast marching, embedded", embedding_time + unfolding,
        [&](std::int32_t seed) { return marching->solve(seed); });
    for (const int disc : {50, 200}) {
      const std::string name = "SVG, " + std::to_string(disc);
      if (!options.is_wanted(name)) continue;
      std::unique_ptr<SaddleVertexGraph> graph;
      const double joining = seconds([&] { graph = std::make_unique<SaddleVertexGraph>(embedding.mesh, disc); });
      const auto distances = row(name, embedding_time + joining, [&](std::int32_t seed) { return graph->solve(seed); });
      const ExactGeodesics exact(embedding.mesh);
      std::vector<std::vector<double>> expected;
      for (const std::int32_t seed : seeds) expected.push_back(exact.solve(seed).distances());
      line(name + " beside ours", 0.0, {0.0}, distances, expected);
    }
    for (const auto& [name, max_error] : {std::pair("ours", 0.0), std::pair("ours, 2 %", 0.02),
                                          std::pair("ours, 1 %", 0.01), std::pair("ours, 0.5 %", 0.005)}) {
      std::unique_ptr<ExactGeodesics> ours;
      const double building = seconds(
          [&] { ours = std::make_unique<ExactGeodesics>(embed(surface, metric, {.max_error = max_error}).mesh); });
      row(name, building, [&](std::int32_t seed) { return ours->solve(seed).distances(); });
    }
  }
}

int measure_all(int argc, char** argv) {
  Options options;
  return run(argc, argv,
             {{"--seeds", set_count(options.seeds, 1)},
              {"--most-faces", set_count(options.most_faces, 1)},
              {"--anisotropy", [&](const std::string& a) { options.anisotropies.push_back(std::stod(a)); }},
              {"--only", [&](const std::string& name) { options.only.push_back(name); }}},
             [&](const std::string& mesh) {
               if (options.anisotropies.empty()) options.anisotropies = {2.0, 5.0, 10.0, 20.0};
               measure(mesh, options);
             });
}

}  // namespace
}  // namespace seamwire::bench

int main(int argc, char** argv) { return seamwire::bench::measure_all(argc, argv); }
