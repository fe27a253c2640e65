// SPDX-License-Identifier: GPL-3.0-or-later
#include "seams/wire_touches.hpp"

#include <algorithm>
#include <tuple>
#include <unordered_map>
#include <utility>
#include <vector>

#include "detail/poll.hpp"
#include "surface/real_edges.hpp"

namespace seamwire::detail {
namespace {

/// How many edges two chains share from the start of the first one, if the second one starts or ends there.
std::size_t shared_edges(std::span<const std::int32_t> chain, std::span<const std::int32_t> other) {
  const auto count = [&](auto begin, auto end) {
    const auto differs = std::mismatch(chain.begin(), chain.end(), begin, end).first;
    return static_cast<std::size_t>(std::max<std::ptrdiff_t>(differs - chain.begin() - 1, 0));
  };
  return std::max(count(other.begin(), other.end()), count(other.rbegin(), other.rend()));
}

/// How many edges at the start of a chain are on the rim.
std::size_t rim_edges(std::span<const std::int32_t> chain, const Rim& rim) {
  std::size_t count = 0;
  while (count + 1 < chain.size() && rim.has_edge(chain[count], chain[count + 1])) ++count;
  return count;
}

/// The range of inner places of a chain, if so many edges at its ends may touch something. A chain that touches it
/// everywhere has one place: its middle.
struct Inner {
  Inner(std::size_t edges, std::size_t at_start, std::size_t at_end) : begin(at_start + 1), end(edges - at_end) {
    if (at_start == edges) begin = edges / 2, end = begin + 1;
  }
  bool has(std::size_t place) const { return begin <= place && place < end; }
  std::size_t begin, end;
};

}  // namespace

Rim::Rim(std::vector<Edge> edges) : edges_(std::move(edges)) {
  for (Edge& edge : edges_) {
    edge = ascending(edge[0], edge[1]);
    vertices_.insert(edge.begin(), edge.end());
  }
  std::ranges::sort(edges_);
}

bool Rim::has_edge(std::int32_t a, std::int32_t b) const { return std::ranges::binary_search(edges_, ascending(a, b)); }

std::vector<WireTouch> find_touches(std::span<const MarkedChain> wires, const Rim& rim, const Task& task) {
  Poll poll(task, 0.0, 0.0, 1, Poll::kFewSteps);
  std::unordered_map<std::int32_t, std::vector<std::size_t>> wires_at;
  for (std::size_t i = 0; i < wires.size(); ++i) {
    for (const std::int32_t v : wires[i].vertices) wires_at[v].push_back(i);
  }
  // Of two wires that pass through a vertex, the one farther from its slit is at fault. An end is on its slit.
  const auto is_at_fault = [&](std::size_t i, std::size_t other, std::int32_t v) {
    const auto rank = [&](std::size_t w) { return std::tuple(wires[w].away, wires[w].vertices.size(), w); };
    const std::span<const std::int32_t> chain = wires[other].vertices;
    return chain.front() == v || chain.back() == v || rank(i) > rank(other);
  };
  std::vector<WireTouch> touches;
  for (std::size_t i = 0; i < wires.size(); ++i) {
    const std::span<const std::int32_t> chain = wires[i].vertices;
    const std::size_t edges = chain.size() - 1;
    const std::vector<std::int32_t> backwards(chain.rbegin(), chain.rend());
    const Inner off_rim(edges, rim_edges(chain, rim), rim_edges(backwards, rim));
    for (std::size_t k = 0; k < chain.size(); ++k) {
      poll.next();
      const std::int32_t v = chain[k];
      const bool is_touch =
          (off_rim.has(k) && rim.has_vertex(v)) || std::ranges::any_of(wires_at[v], [&](std::size_t j) {
            if (i == j) return std::ranges::count(wires_at[v], i) > 1 && 0 < k && k < edges;
            const std::span<const std::int32_t> other = wires[j].vertices;
            const bool is_same = other.size() == chain.size();
            const std::size_t at_start = shared_edges(chain, other), at_end = shared_edges(backwards, other);
            // A wire that runs along the start of a longer one ends there.
            if (at_start == edges && !is_same) return false;
            return Inner(edges, at_start, at_end).has(k) && is_at_fault(i, j, v);
          });
      if (!is_touch) continue;
      touches.push_back({i, v});
      break;
    }
  }
  return touches;
}

}  // namespace seamwire::detail
