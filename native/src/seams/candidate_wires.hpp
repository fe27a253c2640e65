// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "seamwire/context/embedded_surface.hpp"
#include "seamwire/context/surface_context.hpp"
#include "seamwire/task.hpp"

namespace seamwire::detail {

/// A wire across the surface between two seeds, the shorter one of the two metrics.
struct CandidateWire {
  Follow follow = Follow::kMin;
  std::vector<std::int32_t> vertices;  ///< the chain of edges that it marks; empty: there is no wire
  std::vector<Vector> points;          ///< its curve
  std::vector<std::int32_t> faces;     ///< as Wire::faces
};

/// Finds the wires across the surface that LiveWire shows, many at once.
class CandidateWires {
 public:
  /// Prepares both metrics, on two threads. Throws as SeamPlanner does.
  CandidateWires(const SurfaceContext& context, const Strength& strength, const Task& task);

  /// Two seeds: vertices of the surface.
  struct Ends {
    std::int32_t from, to;
  };
  /// The wire between each two seeds. Nearly always it is the shortest one, see CorridorPaths. On several threads.
  std::vector<CandidateWire> find(std::span<const Ends> ends, const Task& task) const;

 private:
  /// A wire in one metric, with its length there.
  struct Found {
    CandidateWire wire;
    double length;
  };
  Found find_in(std::size_t metric, const Ends& ends, const Task& task) const;

  SurfaceContext context_;
  std::array<std::optional<EmbeddedSurface>, 2> metrics_;  // M_min, M_max
};

}  // namespace seamwire::detail
