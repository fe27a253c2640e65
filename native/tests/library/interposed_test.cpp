// SPDX-License-Identifier: GPL-3.0-or-later
//
// Live wires where threads cannot be made, and the places where they free their memory. This is a separate program,
// because it puts functions in the place of the system's.
#include <dlfcn.h>
#include <gtest/gtest.h>
#include <pthread.h>

#include <atomic>
#include <cerrno>
#include <chrono>
#include <cstdlib>
#include <limits>
#include <new>
#include <system_error>
#include <thread>

#include "seamwire/live/livewire.hpp"
#include "shapes.hpp"

namespace {

using namespace std::chrono_literals;

/// How many threads can still be made; negative: any number.
std::atomic<int> threads_left = -1;

/// More than this at once cannot be had.
std::atomic<std::size_t> memory_left = std::numeric_limits<std::size_t>::max();

/// Memory of this size is that of results, not of a call's small change.
constexpr std::size_t kLarge = 32 * 1024;

std::atomic<bool> watches = false;     // what is freed
std::atomic<bool> is_polling = false;  // the caller asks for progress again and again
std::atomic<std::int64_t> answers = 0, freed_by_caller = 0, freed_by_workers = 0, freed_with_the_lock = 0;
std::atomic<std::thread::id> caller;

/// The caller gets answers while a worker is in here, unless the worker holds the lock that answers need.
void note(std::size_t size) noexcept {
  if (size < kLarge || !watches || freed_with_the_lock > 0) return;
  if (caller.load() == std::this_thread::get_id()) {
    ++freed_by_caller;
    return;
  }
  ++freed_by_workers;
  const std::int64_t before = answers;
  for (int i = 0; is_polling && answers < before + 2; ++i) {
    if (i == 10'000) {
      ++freed_with_the_lock;
      return;
    }
    std::this_thread::sleep_for(1ms);
  }
}

}  // namespace

/// Takes the place of pthread_create().
extern "C" int make_thread(pthread_t* thread, const pthread_attr_t* attributes, void* (*start)(void*),
                           void* value) __asm__("pthread_create");
extern "C" int make_thread(pthread_t* thread, const pthread_attr_t* attributes, void* (*start)(void*), void* value) {
  if (threads_left == 0) return EAGAIN;
  if (threads_left > 0) --threads_left;
  using Create = int (*)(pthread_t*, const pthread_attr_t*, void* (*)(void*), void*);
  static const auto create = reinterpret_cast<Create>(dlsym(RTLD_NEXT, "pthread_create"));
  return create(thread, attributes, start, value);
}

// Not inlined: GCC takes malloc() and delete, or new and free(), seen side by side, for a mistake.
[[gnu::noinline]] void* operator new(std::size_t size) {
  if (size > memory_left) throw std::bad_alloc();
  if (void* memory = std::malloc(size == 0 ? 1 : size)) return memory;
  throw std::bad_alloc();
}
[[gnu::noinline]] void* operator new(std::size_t size, std::align_val_t alignment) {
  const auto multiple = static_cast<std::size_t>(alignment);
  if (void* memory = std::aligned_alloc(multiple, (size + multiple - 1) / multiple * multiple)) return memory;
  throw std::bad_alloc();
}
[[gnu::noinline]] void operator delete(void* memory) noexcept { std::free(memory); }
[[gnu::noinline]] void operator delete(void* memory, std::align_val_t) noexcept { std::free(memory); }
[[gnu::noinline]] void operator delete(void* memory, std::size_t size) noexcept {
  note(size);
  std::free(memory);
}
[[gnu::noinline]] void operator delete(void* memory, std::size_t size, std::align_val_t) noexcept {
  note(size);
  std::free(memory);
}

namespace seamwire {
namespace {

shapes::Mesh some_mesh() { return shapes::bumpy(shapes::torus(60, 40), 0.02); }

std::shared_ptr<const Surface> some_surface() {
  const shapes::Mesh mesh = some_mesh();
  return std::make_shared<const Surface>(mesh.points, mesh.triangles);
}

TEST(WithoutThreads, ALiveWireThatCannotBeMadeSaysSo) {
  const auto surface = some_surface();
  const LiveWire origin(surface);
  for (const int some : {0, 1}) {
    threads_left = some;
    EXPECT_THROW(LiveWire{surface}, std::system_error) << some;
    threads_left = some;
    EXPECT_THROW(static_cast<void>(origin.fork()), std::system_error) << some;
  }
  threads_left = -1;
  LiveWire live = origin.fork();
  live.seed({0});
  EXPECT_TRUE(live.wait());
}

TEST(WithoutMemory, ALiveWireThatBuildsItsSurfaceSaysSo) {
  shapes::Mesh mesh = some_mesh();
  memory_left = kLarge;
  LiveWire live({std::move(mesh.points), std::move(mesh.triangles)});
  EXPECT_THROW(live.wait(), std::bad_alloc);
  memory_left = std::numeric_limits<std::size_t>::max();
  EXPECT_THROW(live.seed({0}), std::bad_alloc) << "for good";
}

LiveMetrics features(double max_anisotropy, Along along) {
  return live_metrics(MetricFamily::kFeature, {.max_anisotropy = max_anisotropy}, along);
}

/// Calls `change`, and asks for progress until all is done and what was dropped is freed.
template <class Change>
void change_under_watch(LiveWire& live, const Change& change) {
  watches = is_polling = true;
  caller = std::this_thread::get_id();
  change();
  // A machine with other work may let the workers wait: what they free is waited for, if not for ever.
  for (int quiet = 0, turns = 0; quiet < 100 || (freed_by_workers == 0 && turns < 100'000); ++turns) {
    const std::int64_t freed = freed_by_workers;
    static_cast<void>(live.progress());
    ++answers;
    const bool is_done = live.wait(0);
    std::this_thread::sleep_for(100us);
    quiet = is_done && freed_by_workers == freed ? quiet + 1 : 0;
  }
  watches = is_polling = false;
}

TEST(FreeingInput, OfASurfaceThatIsBuiltIsDoneByAWorkerWithoutTheLock) {
  freed_by_caller = freed_by_workers = freed_with_the_lock = 0;
  shapes::Mesh mesh = some_mesh();
  LiveWire live({std::move(mesh.points), std::move(mesh.triangles)});
  change_under_watch(live, [&] { live.seed({7}); });
  EXPECT_GT(freed_by_workers, 0);
  EXPECT_EQ(freed_by_caller, 0);
  EXPECT_EQ(freed_with_the_lock, 0);
}

class Freeing : public testing::TestWithParam<Along> {
 protected:
  Freeing() { freed_by_caller = freed_by_workers = freed_with_the_lock = 0; }

  std::shared_ptr<const Surface> surface_ = some_surface();
  LiveWire live_{surface_, {.along = GetParam(), .metrics = features(5.0, GetParam())}};

  static void expect_freed_by_workers() {
    EXPECT_GT(freed_by_workers, 0);
    EXPECT_EQ(freed_by_caller, 0);
    EXPECT_EQ(freed_with_the_lock, 0);
  }
};

TEST_P(Freeing, OfAFormerMetricIsDoneByTheWorkersWithoutTheLock) {
  live_.wait();
  change_under_watch(live_, [&] { live_.set_metrics(features(7.0, GetParam())); });
  expect_freed_by_workers();
}

TEST_P(Freeing, OfAFormerMetricAndItsFieldsToo) {
  live_.seed({7});
  live_.wait();
  change_under_watch(live_, [&] {
    live_.set_metrics(live_metrics(MetricFamily::kCampen, {.max_anisotropy = 3}));
    static_cast<void>(live_.wires({100}));
    live_.seed({70});
    static_cast<void>(live_.wires({100}));
  });
  expect_freed_by_workers();
}

TEST_P(Freeing, OfAFormerMetricWhoseWiresAreStillSoughtIsDoneWithoutTheLock) {
  live_.wait();
  for (const int i : {1, 2, 3, 4, 5, 6}) {
    change_under_watch(live_, [&] {
      live_.seed({100 * i});
      std::this_thread::sleep_for(2ms);  // the workers are at it, and the last to hold the metric
      live_.set_metrics(features(2.0 + i, GetParam()));
    });
  }
  expect_freed_by_workers();
}

TEST_P(Freeing, OfWhatAStrokeReplaces) {
  live_.seed({7});
  live_.wait();
  const auto& points = surface_->points();
  const Scribble stroke{
      .points = {points[10], points[11], points[12]}, .faces = {}, .vertices = {10, 11, 12}, .eta = 20.0};
  for (const auto& strokes : {std::vector<Scribble>{stroke}, std::vector<Scribble>{}}) {
    change_under_watch(live_, [&] { live_.set_scribbles(strokes); });
  }
  expect_freed_by_workers();
}

TEST_P(Freeing, OfMetricsThatAreReplacedWhileTheyAreMade) {
  live_.seed({7});
  change_under_watch(live_, [&] {
    for (const double a : {2.0, 3.0, 4.0, 5.0}) {
      live_.set_metrics(features(a, GetParam()));
      std::this_thread::sleep_for(2ms);
      static_cast<void>(live_.wires({100}));
    }
  });
  expect_freed_by_workers();
}

INSTANTIATE_TEST_SUITE_P(LiveWire, Freeing, testing::Values(Along::kSurface, Along::kEdges));

TEST(FreeingLoops, OfAFormerMetricWhileALoopIsSearchedForIsDoneWithoutTheLock) {
  freed_by_caller = freed_by_workers = freed_with_the_lock = 0;
  LiveWire live(some_surface(), {.along = Along::kEdges, .metrics = features(5.0, Along::kEdges)});
  live.wait();
  change_under_watch(live, [&] {
    for (std::int32_t v = 0; v < 5; ++v) {
      static_cast<void>(live.loop({v, v + 1}));
      live.set_metrics(features(2.0 + v, Along::kEdges));
    }
  });
  EXPECT_GT(freed_by_workers, 0);
  EXPECT_EQ(freed_by_caller, 0);
  EXPECT_EQ(freed_with_the_lock, 0);
}

}  // namespace
}  // namespace seamwire
