// SPDX-License-Identifier: GPL-3.0-or-later
#include "seamwire/seams/seam_planner.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <optional>
#include <string>
#include <utility>

#include "detail/index.hpp"
#include "detail/poll.hpp"
#include "seams/carried_slits.hpp"
#include "seams/neck_rings.hpp"
#include "seams/parting_cuts.hpp"
#include "seams/planned_wires.hpp"
#include "seams/simplified_mesh.hpp"
#include "seams/slit_search.hpp"
#include "seams/slit_solver.hpp"
#include "seams/visibility.hpp"
#include "seamwire/seams/missing_cuts.hpp"
#include "seamwire/surface/segments.hpp"
#include "surface/real_edges.hpp"

namespace seamwire {

using namespace detail;

namespace {

/// A mesh with more triangles is planned on a simplified one with about so many.
constexpr std::size_t kMostTriangles = 9000, kSimplified = 7000;
/// Faces may be cut for a bound on the energy below this.
constexpr double kLowStretch = 4.15;
constexpr double kBudget = 4000.0;
/// How often planning is repeated because the original mesh distorts more than the simplified one.
constexpr int kRounds = 2;
constexpr double kNearBound = 0.02;  // a map whose energy is this far below the bound may have too many seams
constexpr double kMargin = 3e-3;
constexpr int kHalvings = 4;  // how often pieces without a map are parted
constexpr double kLaterBudget = 0.5;  // of a repetition, as a share of the one before

void check_options(const Surface& surface, const SeamPlannerOptions& options) {
  check_strength(options.strength);
  if (options.mirror < -1 || options.mirror > 2) {
    throw InvalidInput("mirror is " + std::to_string(options.mirror) + ", not an axis from 0 to 2, or -1");
  }
  if (options.front && !(options.front->allFinite() && options.front->norm() > 0.0)) {
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

/// Marks the edges of a mesh that are seams.
std::vector<std::uint8_t> marked_edges(const PlanMesh& mesh, const std::vector<Edge>& seams) {
  std::vector<Edge> sorted;
  sorted.reserve(seams.size());
  for (const auto& [a, b] : seams) sorted.push_back({std::min(a, b), std::max(a, b)});
  std::ranges::sort(sorted);
  std::vector<std::uint8_t> is_seam;
  for (const std::int32_t h : mesh.half_edge_of) {
    const std::int32_t a = mesh.sources[mesh.start(h)], b = mesh.sources[mesh.end(h)];
    const bool is_inner = mesh.twins[h] >= 0;
    is_seam.push_back(is_inner && std::ranges::binary_search(sorted, Edge{std::min(a, b), std::max(a, b)}) ? 1 : 0);
  }
  return is_seam;
}

/// For each vertex the nearest of some vertices, along edges: its place among them; -1 if none can be reached.
std::vector<std::int32_t> nearest_of(const PlanMesh& mesh, std::span<const std::int32_t> vertices) {
  std::vector<std::int32_t> nearest(mesh.vertex_count(), -1);
  std::vector<std::int32_t> open;
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    nearest[vertices[i]] = static_cast<std::int32_t>(i);
    open.push_back(vertices[i]);
  }
  for (std::size_t i = 0; i < open.size(); ++i) {
    for (const PlanNeighbor& next : mesh.all_neighbors[open[i]]) {
      if (nearest[next.vertex] >= 0) continue;
      nearest[next.vertex] = nearest[open[i]];
      open.push_back(next.vertex);
    }
  }
  return nearest;
}

}  // namespace

struct SeamPlanner::Impl {
  Impl(const SurfaceContext& on, SeamPlannerOptions with, const Task& task)
      : context(on), surface(on.surface(task)), options(std::move(with)) {}

  SurfaceContext context;
  std::shared_ptr<const Surface> surface;
  SeamPlannerOptions options;
  SlitProblem original;
  std::optional<SimplifiedMesh> simplified_mesh;  // of the original, if that is large
  SlitProblem simple;                             // on that
  std::unique_ptr<const PlannedWires> wires;

  bool is_simplified() const { return simplified_mesh.has_value(); }
  const SlitProblem& searched() const { return is_simplified() ? simple : original; }

  void prepare(const Task& task);
  std::vector<double> weights_of(const PlanMesh& mesh) const;
  SeamPlan seam_plan(std::span<const Slit> slits, const SlitPlan& planned, const SeamGoal& goal,
                     const Task& task) const;
  void add_map(SeamPlan& plan, const SlitPlan& solved, const SeamGoal& goal) const;
};

std::vector<double> SeamPlanner::Impl::weights_of(const PlanMesh& mesh) const {
  std::vector<double> weights;
  if (options.weights.empty()) return weights;
  for (const std::int32_t v : mesh.sources) weights.push_back(options.weights[v]);
  return weights;
}

void SeamPlanner::Impl::prepare(const Task& task) {
  original.mesh = plan_mesh(*surface);
  original.is_seam = marked_edges(original.mesh, options.seams);
  if (options.mirror >= 0) original.reflection = find_reflection(original.mesh, options.mirror);
  if (original.mesh.face_count() > kMostTriangles) {
    simplified_mesh = simplified(original.mesh, original.is_seam, original.mirror(), kSimplified, task);
    simple.mesh = simplified_mesh->mesh;
    simple.is_seam = simplified_mesh->is_seam;
    if (original.reflection) simple.reflection = find_reflection(simple.mesh, options.mirror);
  }
  const PlanMesh& mesh = searched().mesh;
  Visibility visibility = find_visibility(mesh, options.front, task);
  if (is_simplified()) {
    simple.prices = find_prices(mesh, visibility, simple.reflection, weights_of(mesh));
    const std::vector<std::int32_t> nearest = nearest_of(original.mesh, simplified_mesh->vertices);
    Visibility all;
    for (const std::int32_t v : nearest) {
      all.ambient.push_back(v < 0 ? 0.0 : visibility.ambient[v]);
      if (options.front) all.front.push_back(v < 0 ? 0.0 : visibility.front[v]);
    }
    visibility = std::move(all);
  }
  original.prices = find_prices(original.mesh, visibility, original.reflection, weights_of(original.mesh));
  find_pieces_of(original);
  if (is_simplified()) find_pieces_of(simple);
  wires = std::make_unique<const PlannedWires>(context, options.along, options.strength, task);
}

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

SeamPlan SeamPlanner::Impl::seam_plan(std::span<const Slit> slits, const SlitPlan& planned, const SeamGoal& goal,
                                      const Task& task) const {
  SeamPlan plan;
  plan.wires = wires->along(original, slits, task);
  for (const std::vector<std::int32_t>& chain : one_sided_chains(*surface, options.seams)) {
    PlannedWire wire;
    wire.vertices = chain;
    wire.from = chain.front();
    wire.to = chain.back();
    for (const std::int32_t v : chain) wire.points.push_back(surface->points()[v]);
    plan.wires.push_back(std::move(wire));
  }
  plan.cost = planned.price;
  plan.energy = planned.energy;
  plan.is_reached = std::isfinite(planned.energy) && planned.energy <= goal.distortion && !planned.overlaps;
  std::vector<Edge> cuts = options.seams;
  for (const PlannedWire& wire : plan.wires) {
    for (std::size_t i = 1; i < wire.vertices.size(); ++i) cuts.push_back({wire.vertices[i - 1], wire.vertices[i]});
  }
  plan.islands = face_segments(*surface, cuts);
  for (const std::int32_t missing : missing_cuts(*surface, cuts, plan.islands)) {
    ++plan.island_count;
    plan.not_discs += missing > 0 ? 1 : 0;
  }
  return plan;
}

/// Adds the map and the energy that measure_map() reports. measure_map() scales the map first; the search does not.
void SeamPlanner::Impl::add_map(SeamPlan& plan, const SlitPlan& solved, const SeamGoal& goal) const {
  const Point2 none = Point2::Zero();
  plan.uvs.assign(surface->face_count(), {none, none, none});
  for (const auto& map : solved.maps) {
    if (!map) continue;
    for (std::size_t k = 0; k < map->island.triangles.size(); ++k) {
      const std::int32_t face = original.mesh.faces[map->island.faces[k]];
      for (const std::int32_t own : map->island.triangles[k]) {
        // The triangle may be turned over.
        const std::int32_t vertex = original.mesh.sources[map->island.vertices[own]];
        const auto corner = std::ranges::find(surface->triangles()[face], vertex) - surface->triangles()[face].begin();
        plan.uvs[face][static_cast<std::size_t>(corner)] = map->map.uvs[own] / original.mesh.scale;
      }
    }
  }
  const bool is_whole =
      std::ranges::all_of(original.by_piece, [](const SlitProblem::Piece& piece) { return piece.may_be_cut; });
  if (!std::isfinite(plan.energy) || !is_whole) return;
  plan.energy = measure_map(*surface, plan.uvs, plan.islands).energy;
  plan.is_reached = plan.energy <= goal.distortion && !solved.overlaps;
}

SeamPlanner::SeamPlanner(std::shared_ptr<const Surface> surface, const SeamPlannerOptions& options, const Task& task)
    : SeamPlanner(SurfaceContext(std::move(surface)), options, task) {}

SeamPlanner::SeamPlanner(const SurfaceContext& context, const SeamPlannerOptions& options, const Task& task) {
  const RisingProgress rising(task);
  auto impl = std::make_shared<Impl>(context, options, rising.task());
  check_options(*impl->surface, options);
  impl->prepare(rising.task());
  impl_ = std::move(impl);
}

/// One call of SeamPlanner::plan().
class Planning {
 public:
  Planning(const SeamPlanner::Impl& planner, const SeamGoal& goal, const std::function<void(const SeamPlan&)>& found,
           const Task& task)
      : planner_(planner), goal_(goal), found_(found), task_(task), problem_(planner.searched()) {
    part_limbs();
  }

  SeamPlan run() {
    SeamPlan plan = planned();
    // Pieces that miss the bound are tried again with cuts along their rims, and without any map also in halves.
    const auto retry = [&](std::vector<Slit> cuts) {
      if (cuts.empty()) return;
      add_rings(std::move(cuts));
      SeamPlan other = planned();
      const bool is_better = other.is_reached ? !plan.is_reached : !(plan.energy <= other.energy);
      if (is_better) plan = std::move(other);
    };
    if (!plan.is_reached) retry(rim_cuts(problem_, missed_));
    for (int round = 0; round < kHalvings && !std::isfinite(plan.energy); ++round) {
      retry(halving_cuts(problem_, 2 * index(problem_.pieces.count), task_));
    }
    return plan;
  }

 private:
  SeamPlan planned() {
    const bool is_bounded = std::isfinite(goal_.distortion);
    SlitTree tree = grow_tree(problem_, is_bounded, task_);
    const std::vector<std::int32_t> roots = tree.roots;
    SlitGoal aim;
    aim.energy = goal_.distortion;
    aim.may_cross_faces = (goal_.distortion < kLowStretch);
    aim.budget = (goal_.steps > 0) ? static_cast<double>(goal_.steps) : kBudget;
    std::vector<Slit> best_slits;
    SlitPlan best;
    double steps = 0.0;
    for (int round = 0;; ++round) {
      const auto tell = [&](const SlitPlan& plan) {
        if (found_ && round == 0) found_(planner_.seam_plan(on_original(plan.slits), plan, goal_, task_));
      };
      const SlitPlan plan = search_slits(problem_, {std::move(tree.slits), roots}, aim, tell, task_);
      steps += plan.work;
      if (round == 0) find_missed(plan);
      std::vector<Slit> slits = on_original(plan.slits);
      SlitPlan solved = solved_on_original(slits);
      // The simplified mesh distorts less or more than the original one. The bound is moved by as much.
      const double excess = solved.energy - goal_.distortion;
      const bool is_near = excess <= 0.0 && (excess > -kNearBound || plan.slits.empty());
      if (round == 0 || rank(solved) < rank(best)) {
        best = std::move(solved);
        best_slits = std::move(slits);
      }
      const double energy = plan.energy - excess - kMargin;
      const bool is_last = !planner_.is_simplified() || !is_bounded || round == kRounds || is_near ||
                           plan.energy > aim.energy || !(energy > 4.0);
      if (is_last) break;
      aim.energy = energy;
      aim.budget *= kLaterBudget;
      tree.slits = plan.slits;
    }
    SeamPlan result = planner_.seam_plan(best_slits, best, goal_, task_);
    result.steps = steps;
    planner_.add_map(result, best, goal_);
    return result;
  }

  /// Which of two plans on the original mesh is better: the cheaper one within the bound, or else the one with less
  /// energy.
  std::pair<double, double> rank(const SlitPlan& solved) const {
    const bool is_within = solved.energy <= goal_.distortion && !solved.overlaps;
    return is_within ? std::pair(0.0, solved.price) : std::pair(1.0, solved.energy);
  }

  /// Cuts around limbs at their necks, as many as the goal asks for.
  void part_limbs() {
    auto islands = index(problem_.pieces.count);
    if (!goal_.parts && goal_.islands <= islands) return;
    std::vector<Slit> rings;
    for (const NeckRing& ring : find_necks(problem_, task_)) {
      if (!goal_.parts && islands >= goal_.islands) break;
      islands += ring.image.empty() ? 1 : 2;
      for (Slit& slit : slits_of(ring)) rings.push_back(std::move(slit));
    }
    add_rings(std::move(rings));
    add_rings(halving_cuts(problem_, goal_.islands, task_));
  }

  void add_rings(std::vector<Slit> rings) {
    std::ranges::move(rings, std::back_inserter(rings_));
    problem_.is_seam = cut_of(problem_, rings_, {}).is_cut;
    find_pieces_of(problem_);
  }

  /// The pieces without a map within the bound.
  void find_missed(const SlitPlan& plan) {
    missed_.clear();
    for (std::int32_t p = 0; index(p) < plan.maps.size(); ++p) {
      const auto& map = plan.maps[p];
      if (!map || map->map.overlaps || !(map->map.energy <= goal_.distortion)) missed_.push_back(p);
    }
  }

  /// Rings and slits on the original mesh, rings first.
  std::vector<Slit> on_original(std::span<const Slit> slits) const {
    std::vector<Slit> all = rings_;
    all.insert(all.end(), slits.begin(), slits.end());
    if (!planner_.is_simplified()) return all;
    all = carried_slits(problem_, *planner_.simplified_mesh, planner_.original, all);
    if (goal_.islands < 2) return all;
    // A closed cut may not have been carried whole.
    SlitProblem original = planner_.original;
    original.is_seam = cut_of(original, all, {}).is_cut;
    find_pieces_of(original);
    std::ranges::move(halving_cuts(std::move(original), goal_.islands, task_), std::back_inserter(all));
    return all;
  }

  /// The map of the original mesh with rings and slits.
  SlitPlan solved_on_original(const std::vector<Slit>& slits) const {
    SlitProblem original = planner_.original;
    original.is_seam = cut_of(original, slits, {}).is_cut;
    find_pieces_of(original);
    const Task own{.stop = task_.stop, .progress = [this](double) { return !task_.progress || task_.progress(1.0); }};
    SlitPlan solved = SlitSolver(original, {}).solve({}, own);
    for (const Slit& slit : slits) solved.price += original.price(slit);
    return solved;
  }

  const SeamPlanner::Impl& planner_;
  const SeamGoal& goal_;
  const std::function<void(const SeamPlan&)>& found_;
  const Task& task_;
  SlitProblem problem_;
  std::vector<Slit> rings_;
  std::vector<std::int32_t> missed_;
};

SeamPlan SeamPlanner::plan(const SeamGoal& goal, const std::function<void(const SeamPlan&)>& found,
                           const Task& task) const {
  if (!(goal.distortion > 4.0)) {
    throw InvalidInput("distortion is " + std::to_string(goal.distortion) + ", not above 4, that of an isometry");
  }
  const RisingProgress rising(task);  // each round of the search counts from 0
  return Planning(*impl_, goal, found, rising.task()).run();
}

}  // namespace seamwire
