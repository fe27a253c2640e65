// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "detail/index.hpp"
#include "detail/poll.hpp"
#include "seamwire/surface/surface.hpp"
#include "surface/corner_fans.hpp"
#include "surface/real_edges.hpp"

namespace seamwire::detail {

/// The real edges along which a surface is cut. Answers quickly for edges between vertices that no cut touches, which
/// are nearly all.
class Cuts {
 public:
  /// Throws InvalidInput for a vertex out of range, under the name of `what`; Cancelled.
  Cuts(const Surface& surface, std::span<const Edge> edges, const std::string& what, const Task& task)
      : touched_(surface.vertex_count(), 0) {
    Poll poll(task);
    for (const auto& [a, b] : edges) {
      poll.next();
      for (const std::int32_t v : {a, b}) {
        check_index(v, surface.vertex_count(), what + ": vertex");
      }
      if (!has_edge(surface, {a, b})) continue;
      edges_.push_back(ascending(a, b));
      touched_[a] = touched_[b] = 1;
    }
    polled_sort(edges_, Poll(task));
  }
  bool contains(std::int32_t a, std::int32_t b) const {
    return touched_[a] != 0 && touched_[b] != 0 && std::binary_search(edges_.begin(), edges_.end(), ascending(a, b));
  }

 private:
  std::vector<std::uint8_t> touched_;
  std::vector<Edge> edges_;
};

/// For each half-edge of the corner fans, whether its edge is cut. Throws Cancelled.
inline std::vector<std::uint8_t> cut_half_edges(const Surface& surface, const Cuts& cuts, const Task& task = {}) {
  const Poll poll(task);
  const CornerFans& fans = corner_fans(surface);
  std::vector<std::uint8_t> is_cut;
  is_cut.reserve(fans.twins.size());
  for (std::int32_t h = 0; index(h) < fans.twins.size(); ++h) {
    poll.at(index(h));
    is_cut.push_back(cuts.contains(fans.vertices[fans.tail(h)], fans.vertices[fans.tip(h)]) ? 1 : 0);
  }
  return is_cut;
}

}  // namespace seamwire::detail
