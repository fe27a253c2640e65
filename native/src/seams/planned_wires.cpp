// SPDX-License-Identifier: GPL-3.0-or-later
#include "seams/planned_wires.hpp"

#include <algorithm>
#include <limits>
#include <map>
#include <set>
#include <utility>

#include "detail/index.hpp"

namespace seamwire::detail {
namespace {

constexpr double kNearSlit = 0.04;  // wires across a surface of area 1 stay as near as this to their slits
constexpr double kStraight = 0.1;   // seeds along edges are where a slit bends by more than this

using Chain = PlannedWires::Chain;

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
    double least = std::numeric_limits<double>::infinity();
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

/// The chains of slits, split at the vertices where other slits start.
std::vector<Chain> sections(std::span<const Slit> slits) {
  std::set<std::int32_t> starts;
  std::vector<Chain> chains;
  for (const Slit& slit : slits) {
    for (const Chain* chain : {&slit.path, &slit.image}) {
      if (chain->size() < 2) continue;
      starts.insert(chain->front());
      chains.push_back(*chain);
    }
  }
  std::vector<Chain> found;
  for (const Chain& chain : chains) {
    std::size_t begin = 0;
    for (std::size_t i = 1; i < chain.size(); ++i) {
      if (i + 1 < chain.size() && !starts.contains(chain[i])) continue;
      found.emplace_back(chain.begin() + static_cast<std::ptrdiff_t>(begin),
                         chain.begin() + static_cast<std::ptrdiff_t>(i) + 1);
      begin = i;
    }
  }
  return found;
}

/// Splits a chain where it bends away from the straight line between its ends (Douglas and Peucker 1973).
void add_straight(const PlanMesh& mesh, const Chain& chain, std::vector<Chain>& found) {
  const std::vector<Vector> line = {mesh.points[chain.front()], mesh.points[chain.back()]};
  const auto [at, distance] = farthest_from(mesh, chain, line);
  if (distance <= kStraight) {
    found.push_back(chain);
    return;
  }
  const auto [one, other] = split(chain, at);
  add_straight(mesh, one, found);
  add_straight(mesh, other, found);
}

}  // namespace

PlannedWires::PlannedWires(const SurfaceContext& context, Along along, const Strength& strength, const Task& task)
    : surface_(context.surface(task)) {
  if (along == Along::kSurface) across_ = std::make_unique<const CandidateWires>(context, strength, task);
}

std::vector<PlannedWire> PlannedWires::along(const SlitProblem& problem, std::span<const Slit> slits,
                                             const Task& task) const {
  return across_ ? across_surface(problem.mesh, sections(slits), task) : along_edges(problem.mesh, sections(slits));
}

std::vector<PlannedWire> PlannedWires::along_edges(const PlanMesh& mesh, const std::vector<Chain>& sections) const {
  std::vector<Chain> chains;
  for (const Chain& section : sections) add_straight(mesh, section, chains);
  std::vector<PlannedWire> wires;
  for (const Chain& chain : chains) {
    PlannedWire wire;
    wire.from = mesh.sources[chain.front()];
    wire.to = mesh.sources[chain.back()];
    for (const std::int32_t v : chain) {
      wire.vertices.push_back(mesh.sources[v]);
      wire.points.push_back(surface_->points()[mesh.sources[v]]);
    }
    wires.push_back(std::move(wire));
  }
  return wires;
}

std::vector<PlannedWire> PlannedWires::across_surface(const PlanMesh& mesh, std::vector<Chain> chains,
                                                      const Task& task) const {
  std::vector<PlannedWire> wires;
  while (!chains.empty()) {
    std::vector<CandidateWires::Ends> ends;
    ends.reserve(chains.size());
    for (const Chain& chain : chains) ends.push_back({mesh.sources[chain.front()], mesh.sources[chain.back()]});
    std::vector<CandidateWire> found = across_->find(ends, task);
    std::vector<Chain> again;
    for (std::size_t i = 0; i < chains.size(); ++i) {
      CandidateWire& one = found[i];
      std::vector<Vector> line;
      line.reserve(one.points.size());
      for (const Vector& point : one.points) line.push_back(mesh.scale * point);
      const auto [at, distance] = farthest_from(mesh, chains[i], line);
      if (chains[i].size() > 2 && (one.vertices.empty() || distance > kNearSlit)) {
        auto [first, second] = split(chains[i], at > 0 ? at : chains[i].size() / 2);
        again.push_back(std::move(first));
        again.push_back(std::move(second));
        continue;
      }
      if (one.vertices.empty()) continue;
      wires.push_back({.from = ends[i].from,
                       .to = ends[i].to,
                       .follow = one.follow,
                       .vertices = std::move(one.vertices),
                       .points = std::move(one.points),
                       .faces = std::move(one.faces)});
    }
    chains = std::move(again);
  }
  return wires;
}

}  // namespace seamwire::detail
