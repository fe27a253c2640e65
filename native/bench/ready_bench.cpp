// SPDX-License-Identifier: GPL-3.0-or-later
//
// Measures time and memory from arrays to the first wires, for an artist who clicks at once.
//
//   ready_bench [--loop LEVELS] [--noise SHARE] [--anisotropy A] [--repeats N] [--seeds N] MESH...
// A mesh is a file, or "torus": a bumpy torus of a million triangles. With noise it is like a scan: each coordinate of
// a vertex moves by a normal deviate times SHARE of the mean edge length. A LiveWire across the surface is made and
// seeded at vertex 0. Then its wires to a vertex near the seed, a twelfth of the diagonal away, are requested every 2
// ms.
//
// Prints a line for each run:
// - For each wire, the time until it is first seen, and the processor time of all threads until then. In parentheses,
//   how much longer that wire is than the final one.
// - Both times until all metrics are prepared.
// - The memory of the process above that of the arrays, when all wires are final, and at most until then. The first run
//   also has both after N seeds (20 by default), whose wires lead to vertices nearby.
// - Both times until all metrics of another live wire are prepared, which has no seed.
#include <Eigen/Geometry>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <numbers>
#include <optional>
#include <random>
#include <thread>

#include "mesh_input.hpp"
#include "seamwire/live/livewire.hpp"

namespace seamwire::bench {
namespace {

using Clock = std::chrono::steady_clock;

struct Options {
  int loop = 0, repeats = 2, seeds = 20;
  double noise = 0.0;
  double anisotropy = 20.0;
};

constexpr double kTargetDistance = 1.0 / 12;
constexpr std::chrono::milliseconds kBetweenRequests{2}, kPerSeed{300};

double process_seconds() {
  timespec time{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

/// A line of Linux's status of the process, in bytes.
double memory(const std::string& name) {
  std::ifstream status("/proc/self/status");
  for (std::string line; std::getline(status, line);) {
    if (line.starts_with(name + ":")) return 1024 * std::stod(line.substr(name.size() + 1));
  }
  return std::nan("");
}
void forget_most_memory() { std::ofstream("/proc/self/clear_refs") << "5"; }

Surface bumpy_torus() {
  constexpr int kSide = 707;
  std::vector<Vector> points;
  std::vector<Triangle> triangles;
  const auto vertex = [](int i, int j) { return i % kSide * kSide + j % kSide; };
  for (int i = 0; i < kSide; ++i) {
    for (int j = 0; j < kSide; ++j) {
      const double u = 2 * std::numbers::pi * i / kSide, v = 2 * std::numbers::pi * j / kSide;
      const double ring = 1 + 0.3 * std::cos(v), bumps = 1 + 0.1 * std::sin(20 * u);
      points.emplace_back(ring * std::cos(u), ring * std::sin(u), 0.3 * std::sin(v) * bumps);
      triangles.push_back({vertex(i, j), vertex(i + 1, j), vertex(i + 1, j + 1)});
      triangles.push_back({vertex(i, j), vertex(i + 1, j + 1), vertex(i, j + 1)});
    }
  }
  return {std::move(points), std::move(triangles)};
}

Surface with_noise(const Surface& surface, double noise) {
  std::vector<Vector> points = surface.points();
  double sum = 0.0;
  for (const auto& [a, b] : surface.edges()) sum += (points[a] - points[b]).norm();
  std::mt19937 random(1);
  std::normal_distribution<double> moved(0.0, noise * sum / static_cast<double>(surface.edges().size()));
  for (Vector& point : points) {
    for (double& coordinate : point) coordinate += moved(random);
  }
  return {std::move(points), surface.triangles()};
}

std::int32_t vertex_near(const Surface& surface, std::int32_t seed) {
  Eigen::AlignedBox3d box;
  for (const Vector& p : surface.points()) box.extend(p);
  const auto misses_by = [&](const Vector& p) {
    return std::abs((p - surface.points()[seed]).norm() - kTargetDistance * box.diagonal().norm());
  };
  return static_cast<std::int32_t>(std::ranges::min_element(surface.points(), {}, misses_by) -
                                   surface.points().begin());
}

struct Lap {
  double clock = 0.0, processor = 0.0;
};

/// From the arrays on.
class Stopwatch {
 public:
  Lap lap() const {
    return {std::chrono::duration<double>(Clock::now() - begun_).count(), process_seconds() - worked_};
  }

 private:
  Clock::time_point begun_ = Clock::now();
  double worked_ = process_seconds();
};

bool is_ready(const LiveWire& live) {
  return std::ranges::all_of(live.embeddings(), [](const auto& each) { return each.has_value(); });
}

void measure_without_seed(const Surface& surface, const LiveWireOptions& how) {
  const Stopwatch watch;
  const LiveWire live({surface.points(), surface.triangles()}, how);
  while (!is_ready(live)) std::this_thread::sleep_for(kBetweenRequests);
  const Lap ready = watch.lap();
  std::printf("  ready without a seed %.2f / %.2f s\n", ready.clock, ready.processor);
}

void measure(const Surface& surface, const LiveWireOptions& how, const Options& options, bool with_seeds) {
  const std::int32_t target = vertex_near(surface, 0);
  const auto faces = static_cast<double>(surface.face_count());
  forget_most_memory();
  const double memory_before = memory("VmRSS");
  const Stopwatch watch;
  LiveWire live({surface.points(), surface.triangles()}, how);
  live.seed({0});
  std::vector<std::optional<Lap>> seen(how.metrics.wires.size());
  std::vector<double> lengths(seen.size());
  std::optional<Lap> ready;
  LiveWires found;
  do {
    found = live.wires({target});
    for (std::size_t i = 0; i < seen.size(); ++i) {
      if (seen[i] || found.wires[i].points.empty()) continue;
      seen[i] = watch.lap();
      lengths[i] = found.wires[i].length;
    }
    if (!ready && is_ready(live)) ready = watch.lap();
    std::this_thread::sleep_for(kBetweenRequests);
  } while (!found.final());
  for (std::size_t i = 0; i < seen.size(); ++i) {
    std::printf("  wire %zu %.2f / %.2f s", i + 1, seen[i]->clock, seen[i]->processor);
    std::printf(" (%+.2f %%)", 100 * (lengths[i] / found.wires[i].length - 1));
  }
  std::printf("  ready %.2f / %.2f s", ready->clock, ready->processor);
  std::printf("  bytes a triangle: %.0f, at most %.0f", (memory("VmRSS") - memory_before) / faces,
              (memory("VmHWM") - memory_before) / faces);
  if (with_seeds) {
    std::mt19937 random(1);
    std::uniform_int_distribution<std::int32_t> any(0, static_cast<std::int32_t>(surface.vertex_count()) - 1);
    for (int i = 0; i < options.seeds; ++i) {
      const std::int32_t seed = any(random);
      live.seed({seed});
      live.wires({vertex_near(surface, seed)});
      std::this_thread::sleep_for(kPerSeed);
    }
    std::printf("  after %d seeds %.0f, at most %.0f", options.seeds, (memory("VmRSS") - memory_before) / faces,
                (memory("VmHWM") - memory_before) / faces);
  }
}

void measure_mesh(const std::string& mesh, const Options& options) {
  Surface surface = mesh == "torus" ? bumpy_torus() : read_surface(mesh, options.loop);
  if (options.noise > 0) surface = with_noise(surface, options.noise);
  std::printf("%s  %zu faces; times: clock / processor of all threads\n", mesh_name(mesh, options.loop).c_str(),
              surface.face_count());
  const LiveWireOptions how{.metrics = live_metrics(MetricFamily::kFeature,
                                                    {.max_anisotropy = options.anisotropy, .clamp_percentile = 99.0})};
  for (int i = 0; i < options.repeats; ++i) {
    measure(surface, how, options, i == 0);
    measure_without_seed(surface, how);
    std::fflush(stdout);
  }
}

int measure_all(int argc, char** argv) {
  Options options;
  return run(argc, argv,
             {{"--loop", set_count(options.loop, 0)},
              {"--repeats", set_count(options.repeats, 1)},
              {"--seeds", set_count(options.seeds, 0)},
              {"--noise", set_number(options.noise)},
              {"--anisotropy", set_number(options.anisotropy)}},
             [&](const std::string& mesh) { measure_mesh(mesh, options); });
}

}  // namespace
}  // namespace seamwire::bench

int main(int argc, char** argv) { return seamwire::bench::measure_all(argc, argv); }
