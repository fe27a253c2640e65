// SPDX-License-Identifier: GPL-3.0-or-later
#include "seams/planned_wires.hpp"

#include <algorithm>
#include <cstdint>
#include <functional>
#include <iterator>
#include <map>
#include <set>
#include <span>
#include <tuple>
#include <unordered_map>
#include <utility>
#include <vector>

#include "detail/index.hpp"
#include "detail/infinity.hpp"
#include "detail/poll.hpp"
#include "seams/candidate_wires.hpp"
#include "seamwire/context/surface_context.hpp"
#include "seamwire/task.hpp"
#include "surface/point_segment.hpp"
#include "surface/real_edges.hpp"
#include "tuning/constants.hpp"

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
  Poll poll(task, Poll::kFewSteps);
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

namespace {

static_assert(tuning::kNearSlit.size() == SlitChains::kClosest);

using Chain = SlitChains::Chain;

/// The place of the vertex of a chain that is farthest from a line, and how far.
std::pair<std::size_t, double> farthest_from(const PlanMesh& mesh, std::span<const std::int32_t> chain,
                                             std::span<const Vector> line) {
  std::pair<std::size_t, double> farthest{0, 0.0};
  for (std::size_t i = 1; i + 1 < chain.size(); ++i) {
    double least = kInfinity;
    for (std::size_t k = 1; k < line.size(); ++k) {
      least = std::min(least, distance_to_segment(mesh.points[chain[i]], line[k - 1], line[k]));
    }
    if (least > farthest.second) farthest = {i, least};
  }
  return farthest;
}

/// A chain in two, at one of its vertices.
std::pair<Chain, Chain> split(const Chain& chain, std::size_t at) {
  const auto middle = chain.begin() + static_cast<std::ptrdiff_t>(at);
  return {Chain(chain.begin(), middle + 1), Chain(middle, chain.end())};
}

/// A slit that gets a wire across the surface.
struct Open {
  Chain chain;
  double most_away;  // how far the wire may be from the chain
};

/// A slit with its wire.
struct Laid {
  Open slit;
  PlannedWire wire;
  double away;
};

void add_split(const Open& slit, std::size_t at, std::vector<Open>& parts) {
  auto [first, second] = split(slit.chain, at);
  parts.push_back({std::move(first), slit.most_away});
  parts.push_back({std::move(second), slit.most_away});
}

/// Takes out wires that touch others or the rim. Returns their slits, split where they touch. A slit of a single edge
/// cannot be split: its wire is laid by `along_edges`.
std::vector<Open> take_touching(const PlanMesh& mesh, const Surface& surface, const Rim& rim,
                                std::span<const PlannedWire> others, std::vector<Laid>& laid,
                                const std::function<PlannedWire(const Chain&)>& along_edges, const Task& task) {
  std::vector<MarkedChain> marked;
  marked.reserve(laid.size() + others.size());
  for (const Laid& one : laid) marked.push_back({one.wire.vertices, one.away});
  for (const PlannedWire& wire : others) marked.push_back({wire.vertices, 0.0});
  std::vector<Open> parts;
  bool is_again = false;
  for (const auto& [wire, vertex] : find_touches(marked, rim, task)) {
    if (wire >= laid.size()) continue;
    const Chain& chain = laid[wire].slit.chain;
    if (chain.size() < 3) {
      if (laid[wire].wire.vertices.size() < 3) continue;
      laid[wire].wire = along_edges(chain);
      is_again = true;
      continue;
    }
    const Vector point = mesh.scale * surface.points()[vertex];
    const auto away = [&](std::int32_t v) { return (mesh.points[v] - point).norm(); };
    const auto at = std::ranges::min_element(chain.begin() + 1, chain.end() - 1, {}, away);
    add_split(laid[wire].slit, static_cast<std::size_t>(at - chain.begin()), parts);
    laid[wire].slit.chain.clear();
  }
  std::erase_if(laid, [](const Laid& one) { return one.slit.chain.empty(); });
  if (parts.empty() && is_again) return take_touching(mesh, surface, rim, others, laid, along_edges, task);
  return parts;
}

/// Splits a chain where it bends away from the straight line between its ends (Douglas and Peucker 1973).
void add_straight(const PlanMesh& mesh, const Chain& chain, double most_away, std::vector<Chain>& found) {
  const std::vector<Vector> line = {mesh.points[chain.front()], mesh.points[chain.back()]};
  const auto [at, distance] = farthest_from(mesh, chain, line);
  if (distance <= most_away) {
    found.push_back(chain);
    return;
  }
  const auto [one, other] = split(chain, at);
  add_straight(mesh, one, most_away, found);
  add_straight(mesh, other, most_away, found);
}

}  // namespace

SlitChains::SlitChains(std::span<const Slit> slits) {
  std::set<Edge> edges;
  std::map<std::int32_t, int> edges_at;
  std::vector<const Chain*> whole;
  for (const Slit& slit : slits) {
    for (const Chain* chain : {&slit.path, &slit.image}) {
      if (chain->size() < 2) continue;
      whole.push_back(chain);
      for (std::size_t i = 1; i < chain->size(); ++i) {
        const std::int32_t a = (*chain)[i - 1], b = (*chain)[i];
        if (!edges.insert(ascending(a, b)).second) continue;
        ++edges_at[a];
        ++edges_at[b];
      }
    }
  }
  std::set<Chain> known;
  for (const Chain* chain : whole) {
    std::size_t begin = 0;
    for (std::size_t i = 1; i < chain->size(); ++i) {
      if (i + 1 < chain->size() && edges_at[(*chain)[i]] == 2) continue;
      Chain one(chain->begin() + static_cast<std::ptrdiff_t>(begin),
                chain->begin() + static_cast<std::ptrdiff_t>(i) + 1);
      begin = i;
      // Slits may share a part of their way.
      if (!known.insert(one.front() < one.back() ? one : Chain(one.rbegin(), one.rend())).second) continue;
      chains.push_back(std::move(one));
    }
  }
}

PlannedWires::PlannedWires(const SurfaceContext& context, Along along, const Strength& strength, Rim rim,
                           std::vector<double> weights, const Task& task)
    : surface_(context.surface(task)), rim_(std::move(rim)), weights_(std::move(weights)) {
  if (along == Along::kSurface) across_ = std::make_unique<const CandidateWires>(context, strength, task);
}

PlannedWires::~PlannedWires() = default;

PlannedWire PlannedWires::along_edges(const PlanMesh& mesh, const Chain& chain) const {
  PlannedWire wire;
  wire.from = mesh.sources[chain.front()];
  wire.to = mesh.sources[chain.back()];
  for (std::size_t i = 0; i < chain.size(); ++i) {
    wire.vertices.push_back(mesh.sources[chain[i]]);
    wire.points.push_back(surface_->points()[mesh.sources[chain[i]]]);
    if (!across_ || i == 0) continue;
    const std::int32_t edge = mesh.edge_between(chain[i - 1], chain[i]);
    wire.faces.push_back(edge < 0 ? -1 : mesh.faces[mesh.half_edge_of[edge] / 3]);
  }
  return wire;
}

std::vector<PlannedWire> PlannedWires::along_edges(const PlanMesh& mesh, const SlitChains& slits) const {
  std::vector<Chain> straight;
  for (const Chain& chain : slits.chains) add_straight(mesh, chain, tuning::kStraight * slits.size, straight);
  std::vector<PlannedWire> wires;
  wires.reserve(straight.size());
  for (const Chain& chain : straight) wires.push_back(along_edges(mesh, chain));
  return wires;
}

/// Whether a wire comes to where no wire may run: its chain to a vertex with an infinite weight, or its curve to a
/// point whose nearest vertex has one.
bool PlannedWires::is_barred(const PlannedWire& wire) const {
  if (weights_.empty()) return false;
  const auto is_infinite = [&](std::int32_t v) { return weights_[v] == kInfinity; };
  if (std::ranges::any_of(wire.vertices, is_infinite)) return true;
  for (std::size_t i = 0; i < wire.faces.size(); ++i) {
    if (wire.faces[i] < 0) continue;
    const Triangle& corners = surface_->triangles()[wire.faces[i]];
    for (const Vector& point : {wire.points[i], wire.points[i + 1]}) {
      const auto away = [&](std::int32_t v) { return (surface_->points()[v] - point).squaredNorm(); };
      if (is_infinite(*std::ranges::min_element(corners, {}, away))) return true;
    }
  }
  return false;
}

std::vector<PlannedWire> PlannedWires::along(const PlanMesh& mesh, std::span<const SlitChains> slits,
                                             const Task& task) const {
  std::vector<PlannedWire> wires;
  std::vector<Open> open;
  for (const SlitChains& own : slits) {
    if (!across_ || own.closeness >= SlitChains::kClosest) {
      std::ranges::move(along_edges(mesh, own), std::back_inserter(wires));
      continue;
    }
    for (const Chain& chain : own.chains) open.push_back({chain, tuning::kNearSlit[index(own.closeness)] * own.size});
  }
  std::vector<Laid> laid;
  while (!open.empty()) {
    std::vector<CandidateWires::Ends> ends;
    ends.reserve(open.size());
    for (const Open& one : open) ends.push_back({mesh.sources[one.chain.front()], mesh.sources[one.chain.back()]});
    std::vector<PlannedWire> found = across_->find(ends, task);
    std::vector<Open> again;
    for (std::size_t i = 0; i < open.size(); ++i) {
      const Chain& chain = open[i].chain;
      PlannedWire& one = found[i];
      std::vector<Vector> line;
      line.reserve(one.points.size());
      for (const Vector& point : one.points) line.push_back(mesh.scale * point);
      const auto [at, away] = farthest_from(mesh, chain, line);
      const bool is_without = one.vertices.empty() || is_barred(one);
      if (chain.size() > 2 && (is_without || away > open[i].most_away)) {
        add_split(open[i], at > 0 ? at : chain.size() / 2, again);
        continue;
      }
      PlannedWire wire = is_without ? along_edges(mesh, chain) : std::move(one);
      laid.push_back({std::move(open[i]), std::move(wire), is_without ? 0.0 : away});
    }
    const auto on_edges = [&](const Chain& chain) { return along_edges(mesh, chain); };
    open = again.empty() ? take_touching(mesh, *surface_, rim_, wires, laid, on_edges, task) : std::move(again);
  }
  for (Laid& one : laid) wires.push_back(std::move(one.wire));
  return wires;
}

}  // namespace seamwire::detail
