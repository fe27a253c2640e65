// SPDX-License-Identifier: GPL-3.0-or-later
//
// Who calls Task::progress, and what becomes of an exception that it throws.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <functional>
#include <memory>
#include <optional>
#include <stdexcept>
#include <stop_token>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "detail/poll.hpp"
#include "detail/run_on_threads.hpp"
#include "seamwire/context/embedded_surface.hpp"
#include "seamwire/context/surface_context.hpp"
#include "seamwire/edges/edge_graph.hpp"
#include "seamwire/edges/edge_wires.hpp"
#include "seamwire_uv/maps/flatten.hpp"
#include "seamwire_uv/maps/pack.hpp"
#include "seamwire_uv/parts/part_finder.hpp"
#include "seamwire_uv/seams/seam_planner.hpp"
#include "shapes.hpp"

namespace seamwire {

using namespace detail;

namespace {

using Work = std::pair<std::string, std::function<void(const Task&)>>;

/// Functions of each room, those that work on several threads among them.
std::vector<Work> all_work() {
  const shapes::Mesh mesh = shapes::torus(60, 40);
  const auto surface = std::make_shared<const Surface>(mesh.points, mesh.triangles);
  const SurfaceContext context(surface);
  const auto metric = std::make_shared<const Metric>(make_metric(context, MetricSpec::concave()));
  const EmbeddedSurface embedded(context, metric, {.max_error = 0});
  shapes::Mesh with_fin = mesh;  // one more triangle at an edge
  with_fin.points.push_back(1.3 * mesh.points[0]);
  with_fin.triangles.push_back({0, 1, static_cast<std::int32_t>(mesh.points.size())});
  const SurfaceContext complex(std::make_shared<const Surface>(with_fin.points, with_fin.triangles));
  const EmbeddedSurface embedded_complex(complex, MetricSpec::euclidean(), {.max_error = 0});
  return {
      {"Surface", [=](const Task& task) { Surface(mesh.points, mesh.triangles, std::nullopt, task); }},
      {"SurfaceContext",
       [=](const Task& task) { SurfaceContext(mesh.points, mesh.triangles).smoothed_curvature(task); }},
      {"SurfaceContext's edges",
       [=](const Task& task) { SurfaceContext(mesh.points, mesh.triangles).edge_adjacency(task); }},
      {"make_metric on a new surface",
       [=](const Task& task) {
         make_metric(SurfaceContext(mesh.points, mesh.triangles), MetricSpec::concave(), task);
       }},
      {"make_metric", [=](const Task& task) { make_metric(context, MetricSpec::concave(), task); }},
      {"EmbeddedSurface", [=](const Task& task) { EmbeddedSurface(context, metric, {.max_error = 0}, task); }},
      {"its field", [=](const Task& task) { embedded.field(0, task); }},
      {"its field by the heat method",
       [=](const Task& task) {
         const EmbeddedSurface fresh(context, metric, {.max_error = 0});
         fresh.field(fresh.heat_geodesics(part_of(task, 0.0, 0.5)), std::array{SurfacePoint(0)}, {},
                     part_of(task, 0.5, 1.0));
       }},
      {"its closed wires", [=](const Task& task) { embedded.field(0).closed_wires(3, task); }},
      {"closed wires over an edge of three faces",
       [=](const Task& task) { embedded_complex.field(300).closed_wires(3, task); }},
      {"EdgeWires", [=](const Task& task) { edge_wires(make_edge_graph(*surface, *metric), {0}, 3.0, false, task); }},
      {"flatten", [=](const Task& task) { flatten(*surface, {}, {}, task); }},
      {"pack_islands",
       [=](const Task& task) {
         const Flattening flat = flatten(*surface, {});
         pack_islands(flat.uvs, flat.islands, {}, task);
       }},
      {"limbs", [=](const Task& task) { PartFinder(surface, {.by = PartsBy::kLimbs}, task); }},
      {"panels", [=](const Task& task) { PartFinder(surface, {.by = PartsBy::kPanels}, task); }},
      {"PartFinder", [=](const Task& task) { PartFinder(surface, {}, task); }},
      {"SeamPlanner", [=](const Task& task) { SeamPlanner(context, {}, task); }},
      {"its plan", [=](const Task& task) { SeamPlanner(context).plan({.distortion = 6.0, .steps = 5}, {}, task); }},
      {"run_on_threads", [](const Task& task) {
         const auto wait = [](std::size_t, const Task& own) {
           for (int i = 0; i < 500 && !own.stop.stop_requested(); ++i) {
             std::this_thread::sleep_for(std::chrono::milliseconds(1));
           }
         };
         detail::run_on_threads(
             8, task, [](std::size_t done) { return static_cast<double>(done) / 8; }, wait);
       }}};
}

TEST(Progress, IsReportedOnTheThreadThatCalls) {
  for (const auto& [name, work] : all_work()) {
    SCOPED_TRACE(name);
    const std::thread::id caller = std::this_thread::get_id();
    int calls = 0;
    work({.stop = {}, .progress = [&](double fraction) {
            EXPECT_EQ(std::this_thread::get_id(), caller);
            EXPECT_TRUE(fraction >= 0.0 && fraction <= 1.0) << fraction;
            ++calls;
            return true;
          }});
    EXPECT_GT(calls, 0);
  }
}

TEST(Progress, WorkOnThreadsThatIsSharedAgainStaysOnItsThread) {
  const std::thread::id caller = std::this_thread::get_id();
  std::atomic<int> done = 0;
  const auto fraction = [](std::size_t) { return 0.0; };
  detail::run_on_threads(4, {}, fraction, [&](std::size_t, const Task& own) {
    const std::thread::id outer = std::this_thread::get_id();
    EXPECT_NE(outer, caller);
    detail::run_on_threads(5, own, fraction, [&](std::size_t, const Task&) {
      EXPECT_EQ(std::this_thread::get_id(), outer);
      ++done;
    });
  });
  EXPECT_EQ(done, 20);
}

TEST(Progress, WhatItThrowsComesOutThoughWorkOnThreadsIsCancelledAtOnce) {
  std::atomic<bool> has_ended = false;
  const auto work = [&](std::size_t, const Task& own) {
    // It holds up whoever stops the work, until the cancelled work has ended.
    static thread_local std::optional<std::stop_callback<std::function<void()>>> on_stop;
    on_stop.emplace(own.stop, [&] {
      for (int i = 0; i < 500 && !has_ended; ++i) std::this_thread::sleep_for(std::chrono::milliseconds(1));
      std::this_thread::sleep_for(std::chrono::milliseconds(50));
    });
    while (!own.stop.stop_requested()) std::this_thread::yield();
    has_ended = true;
    throw Cancelled();
  };
  const Task task{.stop = {}, .progress = [](double) -> bool { throw std::logic_error("enough"); }};
  EXPECT_THROW(detail::run_on_threads(
                   1, task, [](std::size_t) { return 0.0; }, work),
               std::logic_error);
}

TEST(Progress, NeverFalls) {
  for (const auto& [name, work] : all_work()) {
    SCOPED_TRACE(name);
    double most = 0.0;
    work({.stop = {}, .progress = [&](double fraction) {
            EXPECT_GE(fraction, most);
            most = std::max(most, fraction);
            return true;
          }});
  }
}

TEST(Progress, WhatItThrowsComesOutOfTheFunction) {
  for (const auto& [name, work] : all_work()) {
    SCOPED_TRACE(name);
    int calls = 0;
    const Task task{.stop = {}, .progress = [&](double) -> bool {
                      ++calls;
                      throw std::logic_error("enough");
                    }};
    EXPECT_THROW(work(task), std::logic_error);
    EXPECT_EQ(calls, 1) << "it went on";
  }
}

}  // namespace
}  // namespace seamwire
