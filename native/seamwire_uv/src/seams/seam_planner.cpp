// SPDX-License-Identifier: GPL-3.0-or-later
#include "seamwire_uv/seams/seam_planner.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "detail/index.hpp"
#include "detail/poll.hpp"
#include "detail/run_on_threads.hpp"
#include "detail/text.hpp"
#include "graph/edge_chains.hpp"
#include "maps/left_out_uvs.hpp"
#include "maps/measure_islands.hpp"
#include "seams/group_planning.hpp"
#include "seams/planned_wires.hpp"
#include "seams/prepared_surface.hpp"
#include "seamwire/surface/segments.hpp"
#include "seamwire_uv/seams/missing_cuts.hpp"
#include "surface/cuts.hpp"
#include "surface/real_edges.hpp"
#include "tuning/constants.hpp"

namespace seamwire {

using namespace detail;

namespace {

/// Chains of edges across which triangles cannot be oriented alike. A one-sided surface is cut open there.
std::vector<std::vector<std::int32_t>> one_sided_chains(const Surface& surface, const std::vector<Edge>& seams,
                                                        const Task& task) {
  const std::vector<Edge>& unorientable = surface.report().unorientable_edges;
  if (unorientable.empty()) return {};
  const Cuts cuts(surface, seams, "seams", task);
  std::vector<Edge> edges;
  for (const Edge& edge : unorientable) {
    if (has_edge(surface, edge) && !cuts.contains(edge[0], edge[1])) edges.push_back(edge);
  }
  return EdgeChains(surface.vertex_count(), edges).all([](std::int32_t) { return false; });
}

/// The edges that are cut: seams, and those that a plan's wires run along.
std::vector<Edge> cuts_of(const SeamPlan& plan, std::vector<Edge> seams) {
  for (const PlannedWire& wire : plan.wires) {
    for (std::size_t i = 1; i < wire.vertices.size(); ++i) seams.push_back({wire.vertices[i - 1], wire.vertices[i]});
  }
  return seams;
}

/// Makes plans for the whole surface from the plans of its groups.
class WholePlan {
 public:
  /// `distortion`: the bound for the mean over the surface. `prepared` and `plans` must outlive this object.
  WholePlan(const PreparedSurface& prepared, const std::vector<GroupPlanning>& plans, double distortion,
            const Task& task)
      : prepared_(prepared),
        plans_(plans),
        distortion_(distortion),
        place_of_face_(prepared.mesh->face_count()),
        is_counted_(prepared.mesh->face_count()) {
    for (const FaceFrame& frame : face_frames(*prepared.mesh, task)) areas_.push_back(frame.area);
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

  /// The present plan, without a map.
  SeamPlan shown(const Task& task) const { return plan_with(chains(), task); }

  /// The plan with the map that belongs to its wires. Wires that leave a piece without a good map come nearer to the
  /// slits. `bound`: on the energy of each group.
  SeamPlan finished(double bound, const Task& task) {
    constexpr double kMapBegins = 0.3, kMeasureBegins = 0.95;
    constexpr int kMostTries = SlitChains::kClosest + 1;
    std::vector<SlitChains> slits = chains();
    const PlanMesh& mesh = *prepared_.mesh;
    for (int attempt = 0;; ++attempt) {
      const auto place = [&](double share) { return kMeasureBegins * (attempt + share) / kMostTries; };
      SeamPlan plan = plan_with(slits, part_of(task, place(0.0), place(kMapBegins)));
      bool is_again = false;
      plan.uvs.assign(prepared_.surface->face_count(), {Point2::Zero(), Point2::Zero(), Point2::Zero()});
      energies_.clear();
      is_mapped_ = true;
      if (prepared_.wires->are_across()) {
        const std::vector<std::uint8_t> is_cut = marked_edges(mesh, cuts_of(plan, prepared_.options.seams), task);
        const CutMaps maps = solve_cut(mesh, is_cut, part_of(task, place(kMapBegins), place(1.0)));
        const std::vector<std::uint8_t> is_kept = are_kept(maps, bound, task);
        for (std::size_t i = 0; i < places_.size(); ++i) {
          if (slits[i].closeness >= SlitChains::kClosest || is_kept[i] != 0) continue;
          ++slits[i].closeness;
          is_again = true;
        }
        if (is_again) continue;
        add_maps(plan, mesh, nullptr, maps, task);
      } else {
        for (const auto& [group, place] : places_) {
          const GroupProblem& own = groups()[group];
          add_maps(plan, *own.original.mesh, &own.places[place], plans_[group].result().maps, task);
        }
      }
      fill_left_out(*prepared_.surface, plan.islands, plan.uvs);
      measure(plan, part_of(task, kMeasureBegins, 1.0));
      return plan;
    }
  }

 private:
  const std::vector<GroupProblem>& groups() const { return prepared_.groups; }

  /// The slits of all places.
  std::vector<SlitChains> chains() const {
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
  SeamPlan plan_with(std::span<const SlitChains> chains, const Task& task) const {
    const Surface& surface = *prepared_.surface;
    SeamPlan plan;
    plan.wires = prepared_.wires->along(*prepared_.mesh, chains, task);
    for (const std::vector<std::int32_t>& chain : one_sided_chains(surface, prepared_.options.seams, task)) {
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
      for (const Slit& slit : own.slits) {
        if (!is_exposed(groups()[g].original, slit)) continue;
        plan.exposed_wires += groups()[g].places.size() * (slit.image.empty() ? 1 : 2);
      }
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
    plan.islands = face_segments(surface, cuts, task);
    for (const std::int32_t missing : missing_cuts(surface, cuts, plan.islands, task)) {
      ++plan.island_count;
      plan.islands_to_cut += missing > 0 ? 1 : 0;
    }
    return plan;
  }

  /// Of each place, whether its maps are about as good as those with its slits.
  std::vector<std::uint8_t> are_kept(const CutMaps& maps, double bound, const Task& task) const {
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
      const double most = planned.energy <= bound ? bound : tuning::kWorse * planned.energy;
      const bool is_good = found[i].is_mapped && (!found[i].overlaps || planned.overlaps) &&
                           found[i].islands <= planned.maps.maps.size() &&
                           mean_energy(std::move(found[i].energies), task) <= most;
      kept.push_back(is_good || !std::isfinite(planned.energy) ? 1 : 0);
    }
    return kept;
  }

  /// Adds UVs. `place`: where the faces and vertices of the maps' mesh are on the whole mesh; null: in the same place.
  void add_maps(SeamPlan& plan, const PlanMesh& mesh, const Place* place, const CutMaps& maps, const Task& task) {
    Poll poll(task);
    const PlanMesh& whole = *prepared_.mesh;
    const auto whole_face = [&](std::int32_t f) { return place != nullptr ? place->faces[f] : f; };
    for (std::size_t i = 0; i < maps.maps.size(); ++i) {
      const auto& map = maps.maps[i];
      const bool is_counted = is_counted_[whole_face(maps.first_faces[i])] != 0;
      is_mapped_ = is_mapped_ && (map || !is_counted);
      if (!map) continue;
      for (std::size_t k = 0; k < map->island.triangles.size(); ++k) {
        poll.next();
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
  void measure(SeamPlan& plan, const Task& task) const {
    plan.is_reached = false;
    plan.energy = kInfinity;
    if (!is_mapped_) return;
    const MapReport report = measure_islands(*prepared_.surface, plan.uvs, plan.islands, false, task);
    std::vector<std::uint8_t> is_counted_island(plan.island_count, 0);
    for (std::size_t f = 0; f < is_counted_.size(); ++f) {
      if (is_counted_[f] != 0) is_counted_island[plan.islands[prepared_.mesh->faces[f]]] = 1;
    }
    const bool is_all = std::ranges::all_of(is_counted_, [](std::uint8_t counted) { return counted != 0; });
    plan.energy = is_all ? report.energy : mean_energy(energies_, task);
    const bool overlaps =
        std::ranges::any_of(report.overlapping, [&](std::int32_t island) { return is_counted_island[island] != 0; });
    plan.is_reached = std::isfinite(plan.energy) && plan.energy <= distortion_ && !overlaps;
  }

  const PreparedSurface& prepared_;
  const std::vector<GroupPlanning>& plans_;  // by group
  double distortion_;
  /// All places of all groups, one group after another.
  struct Placed {
    std::size_t group, place;
  };
  std::vector<Placed> places_;
  std::vector<std::int32_t> place_of_face_;          // of each face of the whole mesh
  std::vector<std::uint8_t> is_counted_;             // the same: 0 in pieces that may not be cut
  std::vector<double> areas_;                        // the same
  std::vector<std::pair<double, double>> energies_;  // with areas, of the counted triangles of the planned map
  bool is_mapped_ = true;                            // whether all counted triangles have a map
};

void check_options(const Surface& surface, const SeamPlannerOptions& options) {
  check_strength(options.strength);
  if (options.mirror < -1 || options.mirror > 2) {
    throw InvalidInput("mirror is " + std::to_string(options.mirror) + ", not an axis from 0 to 2, or -1");
  }
  if (options.front && !(options.front->allFinite() && !options.front->isZero(0.0))) {
    throw InvalidInput("front is not a direction: it has no length, or is not finite");
  }
  const std::size_t count = surface.vertex_count();
  if (!options.weights.empty() && options.weights.size() != count) {
    throw InvalidInput("weights has " + std::to_string(options.weights.size()) + " items: there are " +
                       std::to_string(count) + " vertices");
  }
  for (std::size_t v = 0; v < options.weights.size(); ++v) {
    if (!(options.weights[v] >= 0.0)) throw InvalidInput("weights: item " + std::to_string(v) + " is not 0 or more");
  }
  for (const auto& [a, b] : options.seams) {
    for (const std::int32_t v : {a, b}) check_index(v, count, "seams: vertex");
  }
}

/// One call of SeamPlanner::plan().
class Planning {
 public:
  Planning(const PreparedSurface& prepared, const SeamGoal& goal, const std::function<void(const SeamPlan&)>& found,
           const Task& task)
      : prepared_(prepared),
        goal_(goal),
        found_(found),
        task_(task),
        plans_(prepared.groups.begin(), prepared.groups.end()),
        whole_(prepared, plans_, goal.distortion, task) {}

  SeamPlan run() {
    part_limbs(part_of(task_, 0.0, kLimbsEnd));
    const bool is_bounded = std::isfinite(goal_.distortion);
    const double budget = goal_.steps > 0 ? static_cast<double>(goal_.steps) : default_budget();
    const double search_end = kTreesEnd + (1.0 - kTreesEnd) * share_of_search(budget);
    for_each_group(part_of(task_, kLimbsEnd, kTreesEnd),
                   [&](std::size_t g, const Task& own) { plans_[g].grow(is_bounded, own); });
    tell();
    const double bound = bound_of_groups();
    const SlitGoal aim{.energy = bound, .may_be_exposed = goal_.distortion < tuning::kLowStretch, .budget = budget};
    for_each_group(part_of(task_, kTreesEnd, search_end), [&](std::size_t g, const Task& own) {
      plans_[g].search(
          aim, is_small(g) ? std::function<void()>() : [&] { tell(); }, own);
    });
    return whole_.finished(bound, part_of(task_, search_end, 1.0));
  }

 private:
  static constexpr double kLimbsEnd = 0.02, kTreesEnd = 0.06;  // shares of all work

  bool is_small(std::size_t group) const {
    return plans_.size() > 1 && groups()[group].searched().mesh->face_count() < tuning::kLeastSimplified;
  }
  const std::vector<GroupProblem>& groups() const { return prepared_.groups; }

  /// How many Newton steps the search may take if the goal leaves that open.
  double default_budget() const {
    const std::size_t faces = prepared_.mesh->face_count();
    if (faces <= tuning::kMostTriangles) return tuning::kBudget;
    return std::min(tuning::kBudget, tuning::kBudgetOfTriangle * static_cast<double>(faces));
  }

  /// The share of the search in the work of the search and of what follows.
  double share_of_search(double budget) const {
    constexpr double kStepsOfMeasuring = 4.0;  // wires, islands and the measure, in Newton steps on the surface
    double search = 0.0;
    if (std::isfinite(goal_.distortion)) {
      for (const GroupProblem& group : groups()) search += group.work(budget);
    }
    double after = kStepsOfMeasuring;
    if (prepared_.wires->are_across()) after += (SlitChains::kClosest + 1) * (kStepsOfMap + kStepsOfMeasuring);
    after *= static_cast<double>(prepared_.mesh->face_count());
    return after > 0.0 ? search / (search + after) : 1.0;
  }

  /// Cuts around limbs at their necks, as many as the goal asks for.
  void part_limbs(const Task& task) {
    std::size_t islands = 0;
    for (std::size_t g = 0; g < plans_.size(); ++g)
      islands += groups()[g].places.size() * index(plans_[g].piece_count());
    if (goal_.islands <= islands) return;
    struct Neck {
      std::size_t group;
      NeckRing ring;
    };
    std::vector<Neck> necks;
    for (std::size_t g = 0; g < plans_.size(); ++g) {
      const auto count = static_cast<double>(plans_.size());
      const Task own = part_of(task, static_cast<double>(g) / count, static_cast<double>(g + 1) / count);
      for (NeckRing& ring : plans_[g].necks(own)) necks.push_back({g, std::move(ring)});
    }
    std::ranges::stable_sort(necks, std::ranges::greater(), [](const Neck& neck) { return neck.ring.narrowness; });
    std::vector<std::vector<NeckRing>> chosen(plans_.size());
    for (Neck& neck : necks) {
      if (islands >= goal_.islands) break;
      islands += groups()[neck.group].places.size() * (neck.ring.image.empty() ? 1 : 2);
      chosen[neck.group].push_back(std::move(neck.ring));
    }
    for (std::size_t g = 0; g < plans_.size(); ++g) plans_[g].part(chosen[g], task);
    halve_groups(task);
  }

  /// Cuts into halves, in the group whose pieces are the largest, until there are as many islands as the goal asks for.
  void halve_groups(const Task& task) {
    std::vector<std::size_t> counts, most;
    std::size_t islands = 0;
    for (std::size_t g = 0; g < plans_.size(); ++g) {
      counts.push_back(index(plans_[g].piece_count()));
      most.push_back(plans_[g].most_pieces());
      islands += groups()[g].places.size() * counts[g];
    }
    if (islands >= goal_.islands) return;
    const auto size = [&](std::size_t g) {
      return groups()[g].size * groups()[g].size / static_cast<double>(counts[g]);
    };
    while (islands < goal_.islands) {
      std::size_t largest = plans_.size();
      for (std::size_t g = 0; g < plans_.size(); ++g) {
        if (counts[g] < most[g] && (largest == plans_.size() || size(g) > size(largest))) largest = g;
      }
      if (largest == plans_.size()) break;
      ++counts[largest];
      islands += groups()[largest].places.size();
    }
    for (std::size_t g = 0; g < plans_.size(); ++g) plans_[g].halve(counts[g], task);
  }

  /// Works on small groups at the same time, then on the others one after another.
  void for_each_group(const Task& task, const std::function<void(std::size_t, const Task&)>& work) const {
    std::vector<std::size_t> small, large;
    for (std::size_t g = 0; g < plans_.size(); ++g) (is_small(g) ? small : large).push_back(g);
    const auto size = [&](std::size_t g) { return static_cast<double>(groups()[g].searched().mesh->face_count()); };
    double all = 0.0, done = 0.0;
    for (std::size_t g = 0; g < plans_.size(); ++g) all += size(g);
    std::vector<double> ends = {0.0};
    for (const std::size_t g : small) ends.push_back(ends.back() + size(g));
    run_on_threads(
        small.size(), task, [&](std::size_t count) { return ends[count] / all; },
        [&](std::size_t i, const Task& own) { work(small[i], own); });
    done = ends.back();
    if (!small.empty() && !large.empty()) tell();
    for (const std::size_t g : large) {
      work(g, part_of(task, done / all, (done + size(g)) / all));
      done += size(g);
    }
  }

  /// The bound on the energy of each group, for the mean over the surface to be within the goal. Groups without seams
  /// that distort less leave more to the others.
  double bound_of_groups() const {
    constexpr double kUsed = 1.0 - 1e-6;  // of what they leave: rounding must not matter
    if (!std::isfinite(goal_.distortion)) return goal_.distortion;
    double left = 0.0, area = 0.0;
    std::vector<std::pair<double, double>> above;  // excess and area
    for (std::size_t g = 0; g < plans_.size(); ++g) {
      const GroupPlanning::Result& plan = plans_[g].result();
      const double own = groups()[g].counted_area(), excess = plan.energy - goal_.distortion;
      if (excess > 0.0) {
        above.emplace_back(excess, own);
        area += own;
      } else if (plan.slits.empty() && !plan.overlaps) {
        left -= kUsed * excess * own;
      }
    }
    std::ranges::sort(above);
    double level = 0.0;
    for (const auto& [excess, own] : above) {
      const double needed = (excess - level) * area;
      if (!(needed < left)) return goal_.distortion + level + (left > 0.0 ? left / area : 0.0);
      left -= needed;
      level = excess;
      area -= own;
    }
    return goal_.distortion + level;
  }

  void tell() const {
    if (found_) found_(whole_.shown(part_of(task_, 0.0, 0.0)));
  }

  const PreparedSurface& prepared_;
  const SeamGoal& goal_;
  const std::function<void(const SeamPlan&)>& found_;
  const Task& task_;
  std::vector<GroupPlanning> plans_;  // by group
  WholePlan whole_;
};

}  // namespace

struct SeamPlanner::Impl {
  PreparedSurface prepared;
};

SeamPlanner::SeamPlanner(const SurfaceContext& context, const SeamPlannerOptions& options, const Task& task) {
  const RisingProgress rising(task);
  check_options(*context.surface(rising.task()), options);
  impl_ = std::make_shared<const Impl>(Impl{PreparedSurface(context, options, rising.task())});
}

SeamPlan SeamPlanner::plan(const SeamGoal& goal, const std::function<void(const SeamPlan&)>& found,
                           const Task& task) const {
  if (!(goal.distortion > 4.0)) {
    throw InvalidInput("distortion is " + text(goal.distortion) + ", not above 4, that of an isometry");
  }
  const RisingProgress rising(task);
  return Planning(impl_->prepared, goal, found, rising.task()).run();
}

}  // namespace seamwire
