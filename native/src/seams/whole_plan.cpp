// SPDX-License-Identifier: GPL-3.0-or-later
#include "seams/whole_plan.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "detail/poll.hpp"
#include "parameterization/measure_islands.hpp"
#include "seamwire/seams/missing_cuts.hpp"
#include "seamwire/surface/segments.hpp"
#include "surface/real_edges.hpp"

namespace seamwire::detail {
namespace {

/// Chains of edges across which triangles cannot be oriented alike. A one-sided surface is cut open there.
std::vector<std::vector<std::int32_t>> one_sided_chains(const Surface& surface, std::vector<Edge> without) {
  std::map<std::int32_t, std::vector<std::int32_t>> next;
  for (Edge& edge : without) edge = {std::min(edge[0], edge[1]), std::max(edge[0], edge[1])};
  std::ranges::sort(without);
  for (const auto& [a, b] : surface.report().unorientable_edges) {
    const Edge edge = ascending(a, b);
    if (std::ranges::binary_search(without, edge)) continue;
    if (!has_edge(surface, edge)) continue;
    next[a].push_back(b);
    next[b].push_back(a);
  }
  std::vector<std::vector<std::int32_t>> chains;
  const auto follow = [&](std::int32_t v) {
    std::vector<std::int32_t> chain{v};
    while (!next[v].empty()) {
      const std::int32_t other = next[v].back();
      next[v].pop_back();
      std::erase(next[other], v);
      chain.push_back(v = other);
      if (next[v].size() > 1) break;  // chains meet here
    }
    chains.push_back(std::move(chain));
  };
  for (const bool is_end : {true, false}) {
    for (auto& [v, others] : next) {
      while (is_end ? others.size() == 1 : !others.empty()) follow(v);
    }
  }
  return chains;
}

/// The edges that are cut: seams, and those that a plan's wires run along.
std::vector<Edge> cuts_of(const SeamPlan& plan, std::vector<Edge> seams) {
  for (const PlannedWire& wire : plan.wires) {
    for (std::size_t i = 1; i < wire.vertices.size(); ++i) seams.push_back({wire.vertices[i - 1], wire.vertices[i]});
  }
  return seams;
}

}  // namespace

WholePlan::WholePlan(const PreparedSurface& prepared, const std::vector<GroupPlanning>& plans, double distortion)
    : prepared_(prepared),
      plans_(plans),
      distortion_(distortion),
      place_of_face_(prepared.mesh().face_count()),
      is_counted_(prepared.mesh().face_count()) {
  for (const FaceFrame& frame : face_frames(prepared.mesh())) areas_.push_back(frame.area);
  for (std::size_t g = 0; g < groups().size(); ++g) {
    const SlitProblem& own = groups()[g].original;
    for (std::size_t k = 0; k < groups()[g].places.size(); ++k) {
      const std::vector<std::int32_t>& faces = groups()[g].places[k].faces;
      for (std::size_t f = 0; f < faces.size(); ++f) {
        place_of_face_[faces[f]] = static_cast<std::int32_t>(places_.size());
        is_counted_[faces[f]] = own.by_piece[own.pieces.of_face[f]].may_be_cut ? 1 : 0;
      }
      places_.push_back({g, k});
    }
  }
}

/// The slits of all places.
std::vector<SlitChains> WholePlan::chains() const {
  std::vector<SlitChains> found;
  for (std::size_t g = 0; g < plans_.size(); ++g) {
    const SlitChains own(plans_[g].result().slits);
    for (const Place& place : groups()[g].places) {
      SlitChains& moved = found.emplace_back(own);
      moved.size = groups()[g].size;
      for (SlitChains::Chain& chain : moved.chains) {
        for (std::int32_t& v : chain) v = place.vertices[v];
      }
    }
  }
  return found;
}

/// A plan with these slits, as good as the groups' plans.
SeamPlan WholePlan::plan_with(std::span<const SlitChains> chains, const Task& task) const {
  const Surface& surface = *prepared_.surface;
  SeamPlan plan;
  plan.wires = prepared_.wires->along(prepared_.mesh(), chains, task);
  for (const std::vector<std::int32_t>& chain : one_sided_chains(surface, prepared_.options.seams)) {
    PlannedWire wire;
    wire.vertices = chain;
    wire.from = chain.front();
    wire.to = chain.back();
    for (const std::int32_t v : chain) wire.points.push_back(surface.points()[v]);
    plan.wires.push_back(std::move(wire));
  }
  double area = 0.0, energy = 0.0;
  bool overlaps = false;
  for (std::size_t g = 0; g < plans_.size(); ++g) {
    const GroupPlanning::Result& own = plans_[g].result();
    const double share = groups()[g].counted_area();
    plan.cost += static_cast<double>(groups()[g].places.size()) * groups()[g].size * own.price;
    plan.steps += groups()[g].size * groups()[g].size * plans_[g].steps();
    overlaps = overlaps || own.overlaps;
    if (!(share > 0.0)) continue;
    area += share;
    energy += share * own.energy;
  }
  plan.energy = area > 0.0 ? energy / area : 4.0;
  plan.is_reached = std::isfinite(plan.energy) && plan.energy <= distortion_ && !overlaps;
  const std::vector<Edge> cuts = cuts_of(plan, prepared_.options.seams);
  plan.islands = face_segments(surface, cuts);
  for (const std::int32_t missing : missing_cuts(surface, cuts, plan.islands)) {
    ++plan.island_count;
    plan.not_discs += missing > 0 ? 1 : 0;
  }
  return plan;
}

SeamPlan WholePlan::finished(double bound, const Task& task) {
  constexpr double kMapBegins = 0.3, kMeasureBegins = 0.95;
  constexpr int kMostTries = SlitChains::kClosest + 1;
  std::vector<SlitChains> slits = chains();
  const PlanMesh& mesh = prepared_.mesh();
  for (int attempt = 0;; ++attempt) {
    const auto place = [&](double share) { return kMeasureBegins * (attempt + share) / kMostTries; };
    SeamPlan plan = plan_with(slits, part_of(task, place(0.0), place(kMapBegins)));
    bool is_again = false;
    plan.uvs.assign(prepared_.surface->face_count(), {Point2::Zero(), Point2::Zero(), Point2::Zero()});
    energies_.clear();
    is_mapped_ = true;
    if (prepared_.wires->are_across()) {
      const std::vector<std::uint8_t> is_cut = marked_edges(mesh, cuts_of(plan, prepared_.options.seams));
      const CutMaps maps = solve_cut(mesh, is_cut, part_of(task, place(kMapBegins), place(1.0)));
      const std::vector<std::uint8_t> is_kept = are_kept(maps, bound);
      for (std::size_t i = 0; i < places_.size(); ++i) {
        if (slits[i].closeness >= SlitChains::kClosest || is_kept[i] != 0) continue;
        ++slits[i].closeness;
        is_again = true;
      }
      if (is_again) continue;
      add_maps(plan, mesh, nullptr, maps);
    } else {
      for (const auto& [group, place] : places_) {
        const GroupProblem& own = groups()[group];
        add_maps(plan, own.original.mesh, &own.places[place], plans_[group].result().maps);
      }
    }
    measure(plan, part_of(task, kMeasureBegins, 1.0));
    return plan;
  }
}

/// Of each place, whether its maps are about as good as those with its slits.
std::vector<std::uint8_t> WholePlan::are_kept(const CutMaps& maps, double bound) const {
  constexpr double kWorse = 1.01;
  struct Found {
    std::size_t islands = 0;
    bool is_mapped = true, overlaps = false;
    std::vector<std::pair<double, double>> energies;
  };
  std::vector<Found> found(places_.size());
  for (std::size_t i = 0; i < maps.maps.size(); ++i) {
    Found& own = found[place_of_face_[maps.first_faces[i]]];
    ++own.islands;
    if (is_counted_[maps.first_faces[i]] == 0) continue;
    const auto& map = maps.maps[i];
    own.is_mapped = own.is_mapped && map;
    if (!map) continue;
    own.overlaps = own.overlaps || map->map.overlaps;
    for (std::size_t k = 0; k < map->energies.size(); ++k) {
      own.energies.emplace_back(map->energies[k], areas_[map->island.faces[k]]);
    }
  }
  std::vector<std::uint8_t> kept;
  for (std::size_t i = 0; i < places_.size(); ++i) {
    const GroupPlanning::Result& planned = plans_[places_[i].group].result();
    const double most = planned.energy <= bound ? bound : kWorse * planned.energy;
    const bool is_good = found[i].is_mapped && (!found[i].overlaps || planned.overlaps) &&
                         found[i].islands <= planned.maps.maps.size() &&
                         mean_energy(std::move(found[i].energies)) <= most;
    kept.push_back(is_good || !std::isfinite(planned.energy) ? 1 : 0);
  }
  return kept;
}

/// Adds UVs. `place`: where the faces and vertices of the maps' mesh are on the whole mesh; null: in the same place.
void WholePlan::add_maps(SeamPlan& plan, const PlanMesh& mesh, const Place* place, const CutMaps& maps) {
  const PlanMesh& whole = prepared_.mesh();
  const auto whole_face = [&](std::int32_t f) { return place != nullptr ? place->faces[f] : f; };
  for (std::size_t i = 0; i < maps.maps.size(); ++i) {
    const auto& map = maps.maps[i];
    const bool is_counted = is_counted_[whole_face(maps.first_faces[i])] != 0;
    is_mapped_ = is_mapped_ && (map || !is_counted);
    if (!map) continue;
    for (std::size_t k = 0; k < map->island.triangles.size(); ++k) {
      const std::int32_t face = whole_face(map->island.faces[k]), own_face = whole.faces[face];
      const Triangle& corners = prepared_.surface->triangles()[own_face];
      for (std::size_t c = 0; c < 3; ++c) {
        const std::int32_t own = map->island.triangles[k][c], v = map->island.vertices[own];
        const std::int32_t vertex = whole.sources[place != nullptr ? place->vertices[v] : v];
        // The triangle may be turned over.
        const auto corner = static_cast<std::size_t>(std::ranges::find(corners, vertex) - corners.begin());
        Point2& uv = plan.uvs[own_face][corner] = map->map.uvs[own] / mesh.scale;
        if (place != nullptr && place->is_mirrored) uv.x() = -uv.x();
      }
      if (is_counted) energies_.emplace_back(map->energies[k], areas_[face]);
    }
  }
}

/// Says what holds for the planned map. measure_map() scales the map first; the search does not.
void WholePlan::measure(SeamPlan& plan, const Task& task) const {
  plan.is_reached = false;
  plan.energy = kInfinity;
  if (!is_mapped_) return;
  const MapReport report = measure_islands(*prepared_.surface, plan.uvs, plan.islands, false, task);
  std::vector<std::uint8_t> is_counted_island(plan.island_count, 0);
  for (std::size_t f = 0; f < is_counted_.size(); ++f) {
    if (is_counted_[f] != 0) is_counted_island[plan.islands[prepared_.mesh().faces[f]]] = 1;
  }
  const bool is_all = std::ranges::all_of(is_counted_, [](std::uint8_t counted) { return counted != 0; });
  plan.energy = is_all ? report.energy : mean_energy(energies_);
  const bool overlaps =
      std::ranges::any_of(report.overlapping, [&](std::int32_t island) { return is_counted_island[island] != 0; });
  plan.is_reached = std::isfinite(plan.energy) && plan.energy <= distortion_ && !overlaps;
}

}  // namespace seamwire::detail
