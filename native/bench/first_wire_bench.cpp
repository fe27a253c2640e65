// SPDX-License-Identifier: GPL-3.0-or-later
//
// How long the first path after a click takes, and how much longer than the geodesic it is; a line a mesh:
//   first_wire_bench [--loop LEVELS] [--metric euclidean|min|max] [--anisotropy A] [--targets N] [--seeds N]
//   [--corridor VERTICES] MESH...
// From vertex 0 and others (5 seeds unless told) to N targets each, the farthest among them. `first` are paths right
// after the click, each by an object of its own; `next` those of one object that is asked for one target after the
// other.
#include <cmath>
#include <cstdio>
#include <exception>
#include <random>

#include "mesh_input.hpp"
#include "seamwire/geodesics.hpp"
#include "seamwire/quick_paths.hpp"

namespace {

using namespace seamwire;
using namespace seamwire::bench;

struct Options {
  int loop = 0, targets = 40, seeds = 5;
  std::size_t corridor = 0;
  std::uint32_t windows = QuickPathOptions{}.windows;
  std::string metric = "euclidean";
  double anisotropy = 20.0;
  std::vector<std::string> meshes;
};

void measure(const std::string& file, const Options& options) {
  const Surface surface = read_surface(file, options.loop);
  const Embedding embedding = embed_by_name(surface, options.metric, {.max_anisotropy = options.anisotropy});
  const ExactGeodesics geodesics(embedding.mesh);
  std::mt19937 random(1);
  std::uniform_int_distribution<std::int32_t> any(0, static_cast<std::int32_t>(surface.vertex_count()) - 1);
  const QuickPathOptions quick{.corridor_vertices = options.corridor, .windows = options.windows};
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
    QuickPaths kept(geodesics, seed, quick);
    for (int t = 0; t < options.targets; ++t) {
      const std::int32_t target = t == 0 ? farthest : any(random);
      const double exact = field.distances()[static_cast<std::size_t>(target)];
      if (target == seed || std::isinf(exact)) continue;
      IntrinsicPath path;
      const double taken = seconds([&] { path = QuickPaths(geodesics, seed, quick).path(target); });
      first.push_back(taken);
      next.push_back(seconds([&] { path = kept.path(target); }));
      excess.push_back(path.length / exact - 1);
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
    } else if (argument == "--targets") {
      options.targets = std::max(1, std::stoi(value()));
    } else if (argument == "--seeds") {
      options.seeds = std::max(1, std::stoi(value()));
    } else if (argument == "--windows") {
      options.windows = static_cast<std::uint32_t>(std::stoul(value()));
    } else if (argument == "--corridor") {
      options.corridor = std::stoul(value());
    } else if (argument == "--anisotropy") {
      options.anisotropy = std::stod(value());
    } else if (argument == "--metric") {
      options.metric = value();
      check_metric_name(options.metric);
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
    std::fprintf(stderr, "first_wire_bench: %s\n", error.what());
    return 1;
  }
}
