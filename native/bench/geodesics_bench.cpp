// SPDX-License-Identifier: GPL-3.0-or-later
//
// Exact geodesics from a seed to all vertices, one line a mesh:
//   geodesics_bench [--loop LEVELS] [--metric euclidean|min|max] [--anisotropy A] [--seeds N] [--repeats N] MESH...
// From vertex 0 and N - 1 others (5 unless told); medians of processor time, so that other programs count only where
// they take caches and memory. Lists, windows and the sum of the distances are of vertex 0: the sum tells whether two
// builds agree.
#include <cmath>
#include <cstdio>
#include <fstream>
#include <memory>
#include <random>

#include "mesh_input.hpp"
#include "seamwire/geodesics/exact_geodesics.hpp"

namespace seamwire::bench {
namespace {

struct Options {
  int loop = 0, repeats = 1, seeds = 5;
  std::string metric = "euclidean";
  double anisotropy = 20.0;
};

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
  const Surface surface = read_surface(file, options.loop);
  const Embedding embedding = embed_by_name(surface, options.metric, {.max_anisotropy = options.anisotropy});
  std::unique_ptr<ExactGeodesics> geodesics;
  const double building = seconds([&] { geodesics = std::make_unique<ExactGeodesics>(embedding.mesh); });
  std::mt19937 random(1);
  std::uniform_int_distribution<std::int32_t> any(0, static_cast<std::int32_t>(surface.vertex_count()) - 1);
  std::vector<double> solving, tracing;
  GeodesicCounters first;
  double checksum = 0.0, peak = 0.0;
  for (int s = 0; s < options.seeds; ++s) {
    const std::int32_t seed = s == 0 ? 0 : any(random);
    for (int i = 0; i < options.repeats; ++i) {
      std::unique_ptr<ExactField> field;
      forget_peak();
      const double before = memory("VmRSS");
      solving.push_back(seconds([&] { field = std::make_unique<ExactField>(geodesics->solve(seed)); }));
      peak = std::max(peak, memory("VmHWM") - before);
      const std::int32_t step = std::max(1, embedding.mesh.vertex_count / 1000);
      for (std::int32_t v = 0; v < embedding.mesh.vertex_count; v += step) {
        tracing.push_back(seconds([&] { field->trace(v); }));
      }
      if (s > 0 || i > 0) continue;
      first = field->counters();
      for (const double d : field->distances()) checksum += std::isinf(d) ? 0.0 : d;
    }
  }
  std::printf(
      "%-24s %8zu faces %8.4f s  %9zu lists %10zu windows %6.1f ns/window  built %.4f s  path: median %5.1f us, 95%% "
      "%5.1f  %6.1f MB  sum %.12g\n",
      mesh_name(file, options.loop).c_str(), embedding.mesh.face_count(), median(solving), first.lists, first.windows,
      1e9 * solving.front() / static_cast<double>(first.windows), building, 1e6 * median(tracing),
      1e6 * quantile(tracing, 0.95), peak, checksum);
  std::fflush(stdout);
}

int measure_all(int argc, char** argv) {
  Options options;
  return run(argc, argv,
             {{"--loop", set_count(options.loop, 0)},
              {"--repeats", set_count(options.repeats, 1)},
              {"--seeds", set_count(options.seeds, 1)},
              {"--anisotropy", set_number(options.anisotropy)},
              {"--metric", set_metric(options.metric)}},
             [&](const std::string& mesh) { measure(mesh, options); });
}

}  // namespace
}  // namespace seamwire::bench

int main(int argc, char** argv) { return seamwire::bench::measure_all(argc, argv); }
