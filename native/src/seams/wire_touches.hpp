// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <unordered_set>
#include <vector>

#include "seamwire/surface/surface.hpp"
#include "seamwire/task.hpp"

namespace seamwire::detail {

/// Edges on the boundary and along seams.
class Rim {
 public:
  explicit Rim(std::vector<Edge> edges);
  bool has_edge(std::int32_t a, std::int32_t b) const;
  bool has_vertex(std::int32_t v) const { return vertices_.contains(v); }

 private:
  std::vector<Edge> edges_;  // sorted, the smaller vertex first
  std::unordered_set<std::int32_t> vertices_;
};

/// The chain of edges that a wire marks.
struct MarkedChain {
  std::span<const std::int32_t> vertices;
  double away = 0.0;  ///< how far the wire strays from its slit
};

/// A place where a wire touches another one, itself, or the rim, although their slits do not.
struct WireTouch {
  std::size_t wire;     ///< the one that has to stay nearer to its slit
  std::int32_t vertex;  ///< where
};

/// Finds places where wires touch, at most one for each wire. Slits touch only at their ends. Wires may also share some
/// edges from a common end, because that changes no island. Anything else would cut off a crumb, or leave a handle
/// uncut. Throws Cancelled.
std::vector<WireTouch> find_touches(std::span<const MarkedChain> wires, const Rim& rim, const Task& task);

}  // namespace seamwire::detail
