// SPDX-License-Identifier: GPL-3.0-or-later
//
// Measures how long a LiveWire still takes if it is destroyed in the middle of its work:
//   live_stop_bench [--loop LEVELS] [--repeats N] [--seconds S] MESH...
// A LiveWire is made, seeded, and destroyed at a random moment up to S seconds later, for wires across the surface and
// along edges. Its surface is still to be built. Prints a line each, and two for all: time on the clock until the
// destructor has returned, which other programs lengthen, and processor time of the whole process until then.
#include <chrono>
#include <cstdio>
#include <optional>
#include <random>
#include <thread>

#include "mesh_input.hpp"
#include "seamwire/live/livewire.hpp"

namespace seamwire::bench {
namespace {

using Clock = std::chrono::steady_clock;

struct Options {
  int loop = 0, repeats = 20;
  double seconds = 4.0;
};

double process_seconds() {
  timespec time{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

void print(const char* name, const std::vector<double>& times) {
  std::printf("  %-28s median %7.2f ms, 90%% %7.2f, most %7.2f\n", name, 1e3 * median(times),
              1e3 * quantile(times, 0.9), 1e3 * quantile(times, 1.0));
}

void measure(const std::string& file, const Options& options) {
  const Surface surface = read_surface(file, options.loop);
  std::printf("%s  %zu faces\n", mesh_name(file, options.loop).c_str(), surface.face_count());
  for (const Along along : {Along::kSurface, Along::kEdges}) {
    std::mt19937 random(1);
    std::uniform_real_distribution<double> moment(0.0, options.seconds);
    std::vector<double> clock, processor;
    for (int i = 0; i < options.repeats; ++i) {
      std::optional<LiveWire> live(
          std::in_place, SurfaceContext(surface.points(), surface.triangles()),
          LiveWireOptions{.along = along,
                          .metrics = live_metrics(MetricFamily::kFeature, {.max_anisotropy = 20.0}, along)});
      live->seed({0});
      const double when = moment(random);
      std::this_thread::sleep_for(std::chrono::duration<double>(when));
      const double progress = live->progress(), before = process_seconds();
      const Clock::time_point asked = Clock::now();
      live.reset();
      clock.push_back(std::chrono::duration<double>(Clock::now() - asked).count());
      processor.push_back(process_seconds() - before);
      std::printf("    after %4.2f s, at %3.0f %%: %7.2f ms, processor %7.2f ms\n", when, 100 * progress,
                  1e3 * clock.back(), 1e3 * processor.back());
    }
    const bool is_surface = along == Along::kSurface;
    print(is_surface ? "across the surface, clock" : "along edges, clock", clock);
    print(is_surface ? "across the surface, processor" : "along edges, processor", processor);
    std::fflush(stdout);
  }
}

int measure_all(int argc, char** argv) {
  Options options;
  return run(argc, argv,
             {{"--loop", set_count(options.loop, 0)},
              {"--repeats", set_count(options.repeats, 1)},
              {"--seconds", set_number(options.seconds)}},
             [&](const std::string& mesh) { measure(mesh, options); });
}

}  // namespace
}  // namespace seamwire::bench

int main(int argc, char** argv) { return seamwire::bench::measure_all(argc, argv); }
