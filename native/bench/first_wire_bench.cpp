// SPDX-License-Identifier: GPL-3.0-or-later
//
// Measures how long the first path after a click takes, and how much longer than the geodesic it is:
//   first_wire_bench [--loop LEVELS] [--metric euclidean|min|max] [--anisotropy A] [--targets N] [--seeds N]
//   [--corridor VERTICES] [--windows N] MESH...
// Prints a line for each mesh. Paths lead from vertex 0 and other seeds (5 by default) to N targets each, the farthest
// among them. `first` paths come right after the click, each from a new object. `next` paths come from one object that
// is asked for one target after the other.
#include <cmath>
#include <cstdio>
#include <optional>
#include <random>

#include "mesh_input.hpp"
#include "seamwire/geodesics/corridor_paths.hpp"
#include "seamwire/geodesics/exact_geodesics.hpp"

namespace seamwire::bench {
namespace {

struct Options {
  int loop = 0, targets = 40, seeds = 5;
  std::size_t corridor = 0;
  std::uint32_t windows = CorridorPathOptions{}.windows;
  std::string metric = "euclidean";
  double anisotropy = 20.0;
};

void measure(const std::string& file, const Options& options) {
  const Surface surface = read_surface(file, options.loop);
  const Embedding embedding = embed_by_name(surface, options.metric, {.max_anisotropy = options.anisotropy});
  const ExactGeodesics geodesics(embedding.mesh);
  std::mt19937 random(1);
  std::uniform_int_distribution<std::int32_t> any(0, static_cast<std::int32_t>(surface.vertex_count()) - 1);
  const CorridorPathOptions quick{.corridor_vertices = options.corridor, .windows = options.windows};
  std::vector<double> first, next, excess;
  double sum = 0.0, worst = 0.0;
  for (int s = 0; s < options.seeds; ++s) {
    const std::int32_t seed = s == 0 ? 0 : any(random);
    const DistanceField field = geodesics.solve(seed);
    std::int32_t farthest = seed;
    for (std::int32_t v = 0; v < static_cast<std::int32_t>(surface.vertex_count()); ++v) {
      const double d = field.distances()[static_cast<std::size_t>(v)];
      if (std::isfinite(d) && d > field.distances()[static_cast<std::size_t>(farthest)]) farthest = v;
    }
    CorridorPaths kept(geodesics, seed, quick);
    for (int t = 0; t < options.targets; ++t) {
      const std::int32_t target = t == 0 ? farthest : any(random);
      const double exact = field.distances()[static_cast<std::size_t>(target)];
      if (target == seed || std::isinf(exact)) continue;
      std::optional<IntrinsicPath> path;
      const double taken = seconds([&] { path = CorridorPaths(geodesics, seed, quick).path(target); });
      first.push_back(taken);
      next.push_back(seconds([&] { path = kept.path(target); }));
      excess.push_back(path->length / exact - 1);
      sum += excess.back();
      worst = std::max(worst, excess.back());
    }
  }
  std::printf(
      "%-24s %8zu faces  first: median %6.2f ms, 95%% %6.2f, most %6.2f  next: median %6.2f ms  longer than the "
      "geodesic: mean "
      "%.4f %%, 95%% %.3f %%, most %.2f %%\n",
      mesh_name(file, options.loop).c_str(), embedding.mesh.face_count(), 1e3 * median(first),
      1e3 * quantile(first, 0.95), 1e3 * quantile(first, 1), 1e3 * median(next),
      100 * sum / static_cast<double>(excess.size()), 100 * quantile(excess, 0.95), 100 * worst);
  std::fflush(stdout);
}

int measure_all(int argc, char** argv) {
  Options options;
  return run(argc, argv,
             {{"--loop", set_count(options.loop, 0)},
              {"--targets", set_count(options.targets, 1)},
              {"--seeds", set_count(options.seeds, 1)},
              {"--windows",
               [&](const std::string& value) { options.windows = static_cast<std::uint32_t>(std::stoul(value)); }},
              {"--corridor", [&](const std::string& value) { options.corridor = std::stoul(value); }},
              {"--anisotropy", set_number(options.anisotropy)},
              {"--metric", set_metric(options.metric)}},
             [&](const std::string& mesh) { measure(mesh, options); });
}

}  // namespace
}  // namespace seamwire::bench

int main(int argc, char** argv) { return seamwire::bench::measure_all(argc, argv); }
