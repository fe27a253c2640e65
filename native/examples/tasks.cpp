// SPDX-License-Identifier: GPL-3.0-or-later
// The snippets of docs/library/tasks.md.
#include <cstdio>
#include <stop_token>
#include <thread>
#include <utility>
#include <vector>

#include "mesh.hpp"
#include "seamwire/context/embedded_surface.hpp"

using namespace seamwire;

int main() {
  auto [points, triangles] = sheet();
  const SurfaceContext context(points, triangles);
  const EmbeddedSurface embedded(context, MetricSpec::euclidean());
  //! [task]
  std::stop_source stop;  // stop.request_stop() cancels from any thread
  const Task task{.stop = stop.get_token(), .progress = [](double fraction) { return fraction < 0.5; }};
  try {
    embedded.field(0, task);
  } catch (const Cancelled&) {
    std::puts("stopped");
  }
  //! [task]

  //! [threads]
  std::vector<double> distances(2);
  {
    const std::jthread first([&] { distances[0] = embedded.field(0).distances().distances().back(); });
    const std::jthread second([&] { distances[1] = embedded.field(1010).distances().distances().back(); });
  }
  //! [threads]
  std::printf("%g %g\n", distances[0], distances[1]);

  //! [errors]
  try {
    const Surface broken(points, {{0, 1, 99999}});
  } catch (const InvalidInput& error) {
    std::puts(error.what());  // ... vertex 99999 is out of range ...
  }
  //! [errors]
}
