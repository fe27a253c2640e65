// SPDX-License-Identifier: GPL-3.0-or-later
//
// Measures the waiting times of an artist besides seeding:
//   live_bench [--loop LEVELS] [--anisotropy A] [--repeats N] MESH...
//
// Prints some lines for each mesh.
//
// - Cancel: from the request to stop, at a random moment, until the work has ended. It measures geodesics, wires along
//   edges, embedding and quick paths, in processor time of the working thread and on the clock.
//
// - Two metrics: seeding both on two threads, compared with the slower one alone.
//
// - A wire: tracing one path. Also tracing both, mapping them to the surface and snapping them to edges.
//
// - Embedding, and embedding again after a stroke of 1, 4, 16 and 64 edges. Also all work between the end of a stroke
//   and the first wire, part by part on one thread, and on the clock in a live wire. The same work is measured once
//   more with the embedding and the geodesics' own mesh made anew.
//
// - A live wire made and seeded, and seeded again. It measures the time until a wire is shown, until the wire that a
//   click keeps is settled, and until all are final, on the clock and in processor time of all threads.
#include <pthread.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <limits>
#include <memory>
#include <random>
#include <thread>

#include "mesh_input.hpp"
#include "seamwire/edges/edge_wires.hpp"
#include "seamwire/geodesics/corridor_paths.hpp"
#include "seamwire/geodesics/exact_geodesics.hpp"
#include "seamwire/live/livewire.hpp"
#include "seamwire/metric/scribble.hpp"
#include "seamwire/wires/snap.hpp"
#include "seamwire/wires/wire.hpp"

namespace seamwire::bench {
namespace {

using Clock = std::chrono::steady_clock;

struct Options {
  int loop = 0, repeats = 100;
  double anisotropy = 20.0;
};

double processor_seconds(clockid_t clock) {
  timespec time{};
  clock_gettime(clock, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

double since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

/// `work(task)` takes about `duration` of processor time; it is stopped somewhere in it, again and again.
void measure_cancelling(const char* name, double duration, const Options& options,
                        const std::function<void(const Task&)>& work) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> moment(0.05, 0.9);
  std::vector<double> processor, clock;
  for (int i = 0; i < options.repeats; ++i) {
    std::atomic<bool> stopped = false, ready = false, finished = false;
    std::atomic<clockid_t> worker_clock{};
    double used = 0.0;
    Clock::time_point end;
    std::stop_source stop;
    std::jthread worker([&] {
      clockid_t mine{};
      pthread_getcpuclockid(pthread_self(), &mine);
      worker_clock = mine;
      ready = true;
      try {
        work({.stop = stop.get_token(), .progress = {}});
      } catch (const Cancelled&) {
        stopped = true;
      }
      used = processor_seconds(mine);
      end = Clock::now();
      finished = true;
    });
    while (!ready) std::this_thread::yield();
    const double until = moment(random) * duration;
    while (!finished && processor_seconds(worker_clock) < until)
      std::this_thread::sleep_for(std::chrono::microseconds(50));
    const double before = processor_seconds(worker_clock);
    const Clock::time_point asked = Clock::now();
    stop.request_stop();
    // The clock of a thread goes with the thread, so nothing of it is asked for any more.
    worker.join();
    if (!stopped) continue;
    processor.push_back(used - before);
    clock.push_back(std::chrono::duration<double>(end - asked).count());
  }
  if (processor.empty()) return;
  std::printf("  cancel %-12s processor: median %6.3f ms, 95%% %6.3f   clock: median %6.3f ms, 95%% %6.3f   (%zu)\n",
              name, 1e3 * median(processor), 1e3 * quantile(processor, 0.95), 1e3 * median(clock),
              1e3 * quantile(clock, 0.95), processor.size());
  std::fflush(stdout);
}

void measure_two_metrics(const ExactGeodesics& first, const ExactGeodesics& second) {
  std::vector<double> ratios, of_processor;
  // The least of each: what else the machine does only makes it longer.
  double least_alone = std::numeric_limits<double>::infinity(), least_together = least_alone;
  for (int i = 0; i < 15; ++i) {
    const auto timed = [](const ExactGeodesics& solver, double& clock, double& processor) {
      const Clock::time_point start = Clock::now();
      processor = seconds([&] { solver.solve(0); });
      clock = since(start);
    };
    double alone[2], together[2], alone_processor[2], together_processor[2];
    timed(first, alone[0], alone_processor[0]);
    timed(second, alone[1], alone_processor[1]);
    const Clock::time_point start = Clock::now();
    {
      const std::jthread other([&] { timed(first, together[0], together_processor[0]); });
      timed(second, together[1], together_processor[1]);
    }
    const double both = since(start), slower = std::max(alone[0], alone[1]);
    ratios.push_back(both / slower);
    least_alone = std::min(least_alone, slower);
    least_together = std::min(least_together, both);
    of_processor.push_back(std::max(together_processor[0], together_processor[1]) /
                           std::max(alone_processor[0], alone_processor[1]));
  }
  std::printf(
      "  two metrics on two threads: %.2f times the slower one, least to least %.2f (its processor time %.2f times)\n",
      median(ratios), least_together / least_alone, median(of_processor));
  std::fflush(stdout);
}

/// Until a wire is shown, until the active one is settled, until all are final.
struct Waits {
  std::array<std::vector<double>, 3> clock, processor;

  /// Asks as a resting cursor over a vertex would, after a call that began the work at `start`.
  void add(const LiveWire& live, std::int32_t to, Clock::time_point start, double processor_start) {
    for (std::size_t reached = 0; reached < 3;) {
      const LiveWires now = live.wires({to});
      const bool is_shown = std::ranges::any_of(now.wires, [](const auto& wire) { return !wire.points.empty(); });
      const std::array is_reached{is_shown, now.settled, now.final()};
      for (; reached < 3 && is_reached[reached]; ++reached) {
        clock[reached].push_back(since(start));
        processor[reached].push_back(processor_seconds(CLOCK_PROCESS_CPUTIME_ID) - processor_start);
      }
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
  }
  void print(const char* what) const {
    std::printf("  %s, until a wire is shown / the active one is settled / all are final: clock", what);
    for (const auto& times : clock) std::printf(" %.1f (least %.1f)", 1e3 * median(times), 1e3 * quantile(times, 0));
    std::printf(" ms, processor");
    for (const auto& times : processor) {
      std::printf(" %.1f (least %.1f)", 1e3 * median(times), 1e3 * quantile(times, 0));
    }
    std::printf(" ms\n");
    std::fflush(stdout);
  }
};

void measure_waits(const std::shared_ptr<const Surface>& surface, const Options& options) {
  std::mt19937 random(1);
  std::uniform_int_distribution<std::int32_t> any(0, static_cast<std::int32_t>(surface->vertex_count()) - 1);
  Waits anew, again;
  for (int i = 0; i < 9; ++i) {
    double processor = processor_seconds(CLOCK_PROCESS_CPUTIME_ID);
    Clock::time_point start = Clock::now();
    LiveWire live(surface, {.metrics = live_metrics(MetricFamily::kFeature,
                                                    {.max_anisotropy = options.anisotropy, .clamp_percentile = 99.0})});
    live.seed({any(random)});
    anew.add(live, any(random), start, processor);
    live.wait();
    for (int k = 0; k < 3; ++k) {
      processor = processor_seconds(CLOCK_PROCESS_CPUTIME_ID);
      start = Clock::now();
      live.seed({any(random)});
      again.add(live, any(random), start, processor);
    }
  }
  anew.print("a live wire made anew and seeded");
  again.print("seeded again");
}

/// From a vertex on to the neighbour that lies furthest along, in one direction, again and again.
Scribble stroke(const Surface& surface, std::int32_t v, int edges) {
  const Vector direction(0.3, 0.9, 0.3);
  const auto along = [&](std::int32_t u) { return surface.points()[static_cast<std::size_t>(u)].dot(direction); };
  Scribble scribble;
  for (int k = 0; k <= edges; ++k) {
    scribble.points.push_back(surface.points()[static_cast<std::size_t>(v)]);
    scribble.vertices.push_back(v);
    std::int32_t best = v;
    for (const auto& [a, b] : surface.edges()) {
      if (a == v && along(b) > along(best)) best = b;
      if (b == v && along(a) > along(best)) best = a;
    }
    v = best;
  }
  return scribble;
}

/// From the call that adds a stroke until each wire that it is meant for differs, on the clock: the live wire's threads
/// do the work. Seconds from first to last.
std::array<std::vector<double>, 2> strokes_of(const std::shared_ptr<const Surface>& surface, const Options& options,
                                              bool for_both) {
  LiveWire live(surface, {.metrics = live_metrics(MetricFamily::kFeature, {.max_anisotropy = options.anisotropy})});
  std::mt19937 random(1);
  std::uniform_int_distribution<std::int32_t> any(0, static_cast<std::int32_t>(surface->vertex_count()) - 1);
  std::array<std::vector<double>, 2> found;
  for (int i = 0; i < 9; ++i) {
    const std::int32_t from = any(random), to = any(random);
    live.set_scribbles({});
    live.seed({from});
    live.wait();
    const LiveWires before = live.wires({to});
    Scribble scribble = stroke(*surface, from, 16);  // it begins at the seed, so that the wires feel it
    if (!for_both) scribble.acts_on = MetricKind::kMin;
    const Clock::time_point start = Clock::now();
    live.set_scribbles({std::move(scribble)});
    const std::size_t expected = for_both ? 2 : 1;
    for (std::size_t changed = 0; changed < expected;) {
      std::this_thread::sleep_for(std::chrono::milliseconds(2));
      const LiveWires now = live.wires({to});
      const std::size_t was = changed;
      changed = 0;
      for (std::size_t which = 0; which < 2; ++which) changed += now.wires[which].length != before.wires[which].length;
      for (std::size_t k = was; k < changed; ++k) found[k].push_back(since(start));
    }
  }
  return found;
}

void measure_strokes(const std::shared_ptr<const Surface>& surface, const Options& options) {
  std::printf("  live wire, on the clock, from the end of a stroke of 16 edges, ten rings wide");
  const std::vector<double> one = strokes_of(surface, options, false)[0];
  std::printf(", for one wire: to that, median %.1f ms, least %.1f", 1e3 * median(one), 1e3 * quantile(one, 0));
  const auto [first, second] = strokes_of(surface, options, true);
  std::printf("; for both: to the first %.1f ms, least %.1f, to the second %.1f ms, least %.1f\n", 1e3 * median(first),
              1e3 * quantile(first, 0), 1e3 * median(second), 1e3 * quantile(second, 0));
  std::fflush(stdout);
}

void measure(const std::string& file, const Options& options) {
  const auto surface = std::make_shared<const Surface>(read_surface(file, options.loop));
  std::vector<double> norms;
  Curvature curvature;
  std::vector<Metric> metrics;
  for (int i = 0; i < 5; ++i) {
    metrics.clear();
    norms.push_back(seconds([&] {
      curvature = principal_curvatures(*surface);
      metrics.push_back(feature_metric(*surface, curvature, Follow::kMin, {.max_anisotropy = options.anisotropy}));
    }));
  }
  metrics.push_back(feature_metric(*surface, curvature, Follow::kMax, {.max_anisotropy = options.anisotropy}));
  std::printf("%s  %zu faces\n  normals, curvature and tensors of a metric: %.1f ms\n",
              mesh_name(file, options.loop).c_str(), surface->face_count(), 1e3 * median(norms));

  std::vector<Embedding> embeddings(2);
  for (std::size_t which = 0; which < 2; ++which) {
    std::vector<double> times;
    times.reserve(5);
    for (int i = 0; i < 5; ++i)
      times.push_back(seconds([&] { embeddings[which] = embed(*surface, metrics[which], {.max_error = 0}); }));
    std::printf("  embedding %s, A = %g: %.1f ms, %zu invalid, %zu added, %zu left\n", which == 0 ? "M_min" : "M_max",
                options.anisotropy, 1e3 * median(times), embeddings[which].invalid_before,
                embeddings[which].faces_added, embeddings[which].invalid_left);
  }
  std::mt19937 random(1);
  std::uniform_int_distribution<std::int32_t> any(0, static_cast<std::int32_t>(surface->vertex_count()) - 1);
  const ExactGeodesics before(embeddings[0].mesh);
  for (const int edges : {1, 4, 16, 64}) {
    std::vector<double> again, drawing, embedding_again, solver, path, until_wire, anew, until_wire_anew;
    std::size_t touched = 0;
    for (int i = 0; i < 7; ++i) {
      Scribble scribble = stroke(*surface, any(random), edges);
      scribble.rings = 3;
      const Metric changed = apply_scribbles(*surface, metrics[0], std::vector{scribble});
      touched = 0;
      for (std::size_t u = 0; u < changed.size(); ++u) touched += changed.tensors[u] != metrics[0].tensors[u];
      Embedding old = embeddings[0];
      again.push_back(seconds([&] { old = re_embed(*surface, metrics[0], changed, old, {.max_error = 0}); }));
      scribble.rings = 10;
      old = embeddings[0];
      const std::int32_t from = any(random), to = any(random);
      Metric drawn;
      drawing.push_back(seconds([&] { drawn = apply_scribbles(*surface, metrics[0], std::vector{scribble}); }));
      embedding_again.push_back(seconds([&] { old = re_embed(*surface, metrics[0], drawn, old, {.max_error = 0}); }));
      std::unique_ptr<ExactGeodesics> geodesics;
      solver.push_back(
          seconds([&] { geodesics = std::make_unique<ExactGeodesics>(before, embeddings[0].mesh, old.mesh); }));
      path.push_back(seconds([&] { CorridorPaths(*geodesics, from, {}).path(to); }));
      until_wire.push_back(drawing.back() + embedding_again.back() + solver.back() + path.back());
      anew.push_back(seconds([&] { old = embed(*surface, drawn, {.max_error = 0}); }));
      const double own = seconds([&] { geodesics = std::make_unique<ExactGeodesics>(old.mesh); });
      until_wire_anew.push_back(drawing.back() + anew.back() + own + path.back());
    }
    std::printf(
        "  embedding again after a stroke of %2d edges, about %zu vertices: %.2f ms; from a stroke ten rings wide to "
        "the first wire: %.1f ms (metric %.1f, embedding again %.1f, geodesics' own mesh %.1f, quick path %.1f), all "
        "anew %.1f (embedding %.1f)\n",
        edges, touched, 1e3 * median(again), 1e3 * median(until_wire), 1e3 * median(drawing),
        1e3 * median(embedding_again), 1e3 * median(solver), 1e3 * median(path), 1e3 * median(until_wire_anew),
        1e3 * median(anew));
  }
  std::fflush(stdout);

  const ExactGeodesics first(embeddings[0].mesh), second(embeddings[1].mesh);
  std::vector<DistanceField> fields;
  fields.push_back(first.solve(0));
  const double duration = seconds([&] { fields.push_back(second.solve(0)); });
  std::vector<double> traced, both;
  for (int i = 0; i < 500; ++i) {
    const std::int32_t to = any(random);
    traced.push_back(seconds([&] { fields[0].trace(to); }));
    both.push_back(seconds([&] {
      for (std::size_t which = 0; which < 2; ++which) {
        const Wire wire = trace_wire(*surface, embeddings[which], fields[which], to).value();
        snap_to_edges(*surface, wire);
      }
    }));
  }
  std::printf("  tracing: median %.1f us, 95%% %.1f; both wires, mapped and snapped: median %.0f us, 95%% %.0f\n",
              1e6 * median(traced), 1e6 * quantile(traced, 0.95), 1e6 * median(both), 1e6 * quantile(both, 0.95));
  measure_two_metrics(first, second);
  measure_waits(surface, options);
  measure_strokes(surface, options);

  measure_cancelling("geodesics", duration, options, [&](const Task& task) { second.solve(0, task); });
  const auto edges = make_edge_graph(*surface, metrics[0]);
  const double search = seconds([&] { edge_wires(edges, {0}); });
  measure_cancelling("edges", search, options, [&](const Task& task) { edge_wires(edges, {0}, 3.0, false, task); });
  const double embedding = seconds([&] { embed(*surface, metrics[1], {.max_error = 0}); });
  measure_cancelling("embedding", embedding, options,
                     [&](const Task& task) { embed(*surface, metrics[1], {.max_error = 0}, task); });
}

int measure_all(int argc, char** argv) {
  Options options;
  return run(argc, argv,
             {{"--loop", set_count(options.loop, 0)},
              {"--repeats", set_count(options.repeats, 1)},
              {"--anisotropy", set_number(options.anisotropy)}},
             [&](const std::string& mesh) { measure(mesh, options); });
}

}  // namespace
}  // namespace seamwire::bench

int main(int argc, char** argv) { return seamwire::bench::measure_all(argc, argv); }
