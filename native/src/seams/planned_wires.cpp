// SPDX-License-Identifier: GPL-3.0-or-later
#include "seams/planned_wires.hpp"

#include <algorithm>
#include <array>
#include <iterator>
#include <set>
#include <utility>

#include "detail/index.hpp"
#include "detail/infinity.hpp"
#include "tuning/constants.hpp"

namespace seamwire::detail {
namespace {

static_assert(tuning::kNearSlit.size() == SlitChains::kClosest);

using Chain = SlitChains::Chain;

double distance_to(const Vector& point, const Vector& a, const Vector& b) {
  const Vector along = b - a;
  const double square = along.squaredNorm();
  const double t = square > 0.0 ? std::clamp((point - a).dot(along) / square, 0.0, 1.0) : 0.0;
  return (point - a - t * along).norm();
}

/// The place of the vertex of a chain that is farthest from a line, and how far.
std::pair<std::size_t, double> farthest_from(const PlanMesh& mesh, std::span<const std::int32_t> chain,
                                             std::span<const Vector> line) {
  std::pair<std::size_t, double> farthest{0, 0.0};
  for (std::size_t i = 1; i + 1 < chain.size(); ++i) {
    double least = kInfinity;
    for (std::size_t k = 1; k < line.size(); ++k) {
      least = std::min(least, distance_to(mesh.points[chain[i]], line[k - 1], line[k]));
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
  std::set<std::int32_t> starts;
  std::vector<const Chain*> whole;
  for (const Slit& slit : slits) {
    for (const Chain* chain : {&slit.path, &slit.image}) {
      if (chain->size() < 2) continue;
      starts.insert(chain->front());
      whole.push_back(chain);
    }
  }
  for (const Chain* chain : whole) {
    std::size_t begin = 0;
    for (std::size_t i = 1; i < chain->size(); ++i) {
      if (i + 1 < chain->size() && !starts.contains((*chain)[i])) continue;
      chains.emplace_back(chain->begin() + static_cast<std::ptrdiff_t>(begin),
                          chain->begin() + static_cast<std::ptrdiff_t>(i) + 1);
      begin = i;
    }
  }
}

PlannedWires::PlannedWires(const SurfaceContext& context, Along along, const Strength& strength, const Task& task)
    : surface_(context.surface(task)) {
  if (along == Along::kSurface) across_ = std::make_unique<const CandidateWires>(context, strength, task);
}

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

std::vector<PlannedWire> PlannedWires::along(const PlanMesh& mesh, std::span<const SlitChains> slits,
                                             const Task& task) const {
  struct Open {
    Chain chain;
    double most_away;
  };
  std::vector<PlannedWire> wires;
  std::vector<Open> open;
  for (const SlitChains& own : slits) {
    if (!across_ || own.closeness >= SlitChains::kClosest) {
      std::ranges::move(along_edges(mesh, own), std::back_inserter(wires));
      continue;
    }
    for (const Chain& chain : own.chains) open.push_back({chain, tuning::kNearSlit[index(own.closeness)] * own.size});
  }
  while (!open.empty()) {
    std::vector<CandidateWires::Ends> ends;
    ends.reserve(open.size());
    for (const Open& one : open) ends.push_back({mesh.sources[one.chain.front()], mesh.sources[one.chain.back()]});
    std::vector<CandidateWire> found = across_->find(ends, task);
    std::vector<Open> again;
    for (std::size_t i = 0; i < open.size(); ++i) {
      const auto& [chain, most_away] = open[i];
      CandidateWire& one = found[i];
      std::vector<Vector> line;
      line.reserve(one.points.size());
      for (const Vector& point : one.points) line.push_back(mesh.scale * point);
      const auto [at, distance] = farthest_from(mesh, chain, line);
      if (chain.size() > 2 && (one.vertices.empty() || distance > most_away)) {
        auto [first, second] = split(chain, at > 0 ? at : chain.size() / 2);
        again.push_back({std::move(first), most_away});
        again.push_back({std::move(second), most_away});
        continue;
      }
      if (one.vertices.empty()) {
        wires.push_back(along_edges(mesh, chain));
        continue;
      }
      wires.push_back({.from = ends[i].from,
                       .to = ends[i].to,
                       .follow = one.follow,
                       .vertices = std::move(one.vertices),
                       .points = std::move(one.points),
                       .faces = std::move(one.faces)});
    }
    open = std::move(again);
  }
  return wires;
}

}  // namespace seamwire::detail
