// SPDX-License-Identifier: GPL-3.0-or-later
#include "seamwire/seams/seam_planner.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <map>
#include <numeric>
#include <optional>
#include <string>
#include <unordered_map>
#include <utility>

#include "detail/index.hpp"
#include "detail/poll.hpp"
#include "detail/run_on_threads.hpp"
#include "parameterization/measure_islands.hpp"
#include "seams/decimation.hpp"
#include "seams/group_planning.hpp"
#include "seams/piece_groups.hpp"
#include "seams/planned_wires.hpp"
#include "seams/visibility.hpp"
#include "seamwire/seams/missing_cuts.hpp"
#include "seamwire/surface/segments.hpp"
#include "surface/real_edges.hpp"

namespace seamwire {

using namespace detail;

namespace {

/// A surface with more triangles is planned on simplified meshes, all of them together with about so many. Each group
/// has at least kLeastSimplified, if it is not smaller itself. Seams are also searched on a mesh of half as many
/// triangles, if that has at least kLeastSimplified.
constexpr std::size_t kMostTriangles = 9000, kSimplified = 7000, kLeastSimplified = 600;
/// Groups with fewer triangles are planned at the same time, on one thread each.
constexpr std::size_t kSmallGroup = 600;
/// Faces may be cut for a bound on the energy below this.
constexpr double kLowStretch = 4.15;
constexpr double kBudget = 4000.0;

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
    const std::int32_t a = mesh.sources[mesh.tail(h)], b = mesh.sources[mesh.tip(h)];
    const bool is_inner = mesh.twins[h] >= 0;
    is_seam.push_back(is_inner && std::ranges::binary_search(sorted, Edge{std::min(a, b), std::max(a, b)}) ? 1 : 0);
  }
  return is_seam;
}

/// The values at some vertices; 0 in the place of -1.
Visibility at_places(const Visibility& from, std::span<const std::int32_t> vertices) {
  Visibility found;
  for (const std::int32_t v : vertices) {
    found.ambient.push_back(v < 0 ? 0.0 : from.ambient[v]);
    if (!from.front.empty()) found.front.push_back(v < 0 ? 0.0 : from.front[v]);
  }
  return found;
}

}  // namespace

struct SeamPlanner::Impl {
  Impl(const SurfaceContext& on, SeamPlannerOptions with, const Task& task)
      : context(on), surface(on.surface(task)), options(std::move(with)) {}

  SurfaceContext context;
  std::shared_ptr<const Surface> surface;
  SeamPlannerOptions options;
  PlanMesh whole;  // empty if one group is the whole surface
  std::vector<GroupProblem> groups;
  std::unique_ptr<const PlannedWires> wires;

  /// The mesh of the whole surface.
  const PlanMesh& mesh() const {
    return whole.triangles.empty() && !groups.empty() ? groups.front().original.mesh : whole;
  }

  void prepare(const Task& task);
  void find_meshes(const Task& task);
  void add_simplified(GroupProblem& group, std::size_t triangles, const Task& task) const;
  Visibility visibility_of_all(const Task& task) const;
  void find_prices_of_all(const Visibility& visibility);
  void join_copies();
  std::vector<double> weights_of(const PlanMesh& mesh) const;
};

std::vector<double> SeamPlanner::Impl::weights_of(const PlanMesh& mesh) const {
  std::vector<double> weights;
  if (options.weights.empty()) return weights;
  for (const std::int32_t v : mesh.sources) weights.push_back(options.weights[v]);
  return weights;
}

void SeamPlanner::Impl::prepare(const Task& task) {
  const double meshes_end = (options.along == Along::kSurface) ? 0.25 : 0.5;
  find_meshes(part_of(task, 0.0, meshes_end));
  find_prices_of_all(visibility_of_all(part_of(task, meshes_end, 2.0 * meshes_end)));
  join_copies();
  wires = std::make_unique<const PlannedWires>(context, options.along, options.strength,
                                               part_of(task, 2.0 * meshes_end, 1.0));
}

/// Finds the groups and their meshes.
void SeamPlanner::Impl::find_meshes(const Task& task) {
  whole = plan_mesh(*surface);
  std::vector<std::uint8_t> is_seam = marked_edges(whole, options.seams);
  std::optional<Reflection> reflection;
  if (options.mirror >= 0) reflection = find_reflection(whole, options.mirror, part_of(task, 0.0, 0.2));
  MeshParts parts(whole, is_seam, surface->edges());
  std::vector<PieceGroup> found =
      find_groups(whole, is_seam, reflection ? &*reflection : nullptr, parts, part_of(task, 0.2, 0.3));
  const std::size_t all = whole.face_count();
  std::size_t done = 0;
  for (PieceGroup& piece_group : found) {
    GroupProblem& group = groups.emplace_back();
    const std::size_t count = piece_group.faces.size();
    group.original.reflection = std::move(piece_group.reflection);
    if (count == all) {
      std::vector<std::int32_t> vertices(whole.vertex_count());
      std::iota(vertices.begin(), vertices.end(), 0);
      group.places.push_back({std::move(vertices), std::move(piece_group.faces)});
      group.original.mesh = std::move(whole);
      group.original.is_seam = std::move(is_seam);
      whole = {};
    } else {
      MeshPart part = parts.part(piece_group.faces);
      group.size = part.size;
      group.places.push_back({std::move(part.vertices), std::move(piece_group.faces)});
      group.original.mesh = std::move(part.mesh);
      group.original.is_seam = std::move(part.is_seam);
    }
    if (piece_group.image) group.places.push_back(std::move(*piece_group.image));
    const Task own = part_of(task, 0.3 + 0.7 * static_cast<double>(done) / static_cast<double>(all),
                             0.3 + 0.7 * static_cast<double>(done + count) / static_cast<double>(all));
    done += count;
    const std::size_t share = std::max(kSimplified * count / all, kLeastSimplified);
    group.is_large = all > kMostTriangles && count * kSimplified > share * kMostTriangles;
    if (group.is_large) add_simplified(group, share, part_of(own, 0.0, 0.7));
    const std::size_t half = group.searched().mesh.face_count() / 2;
    if (half >= kLeastSimplified) add_simplified(group, half, part_of(own, 0.7, 1.0));
  }
}

/// Adds a level with about so many triangles to a group, without prices.
void SeamPlanner::Impl::add_simplified(GroupProblem& group, std::size_t triangles, const Task& task) const {
  const SlitProblem& original = group.original;
  const SlitProblem& finer = group.level_count() > 0 ? group.searched(group.level_count() - 1) : original;
  DecimatedMesh decimated = decimate(finer.mesh, finer.is_seam, finer.mirror(), triangles, task);
  GroupProblem::Simplified simple{.problem = {}, .vertices = std::move(decimated.vertices)};
  simple.problem.mesh = std::move(decimated.mesh);
  simple.problem.is_seam = std::move(decimated.is_seam);
  if (original.reflection) {
    simple.problem.reflection = reflection_in(simple.problem.mesh, options.mirror, original.reflection->offset,
                                              diagonal_of(simple.problem.mesh), task);
  }
  if (!group.simplified.empty()) {
    for (std::int32_t& v : simple.vertices) v = group.simplified.back().vertices[v];
  }
  group.simplified.push_back(std::move(simple));
}

/// The visibility of the vertices of the finest mesh on which each group is searched, one group after another, then of
/// mirror images.
Visibility SeamPlanner::Impl::visibility_of_all(const Task& task) const {
  if (whole.triangles.empty()) {
    return groups.empty() ? Visibility() : find_visibility(groups.front().searched().mesh, options.front, task);
  }
  PlanMesh all;
  std::vector<double> sizes;
  const auto add = [&](const PlanMesh& own, double size, const auto& at) {
    const auto first = static_cast<std::int32_t>(all.points.size());
    for (std::int32_t v = 0; index(v) < own.vertex_count(); ++v) all.points.push_back(at(v));
    for (const auto& [a, b, c] : own.triangles) all.triangles.push_back({first + a, first + b, first + c});
    sizes.resize(all.points.size(), size);
  };
  for (const GroupProblem& group : groups) {
    const PlanMesh& own = group.searched().mesh;
    add(own, group.size, [&](std::int32_t v) { return Vector(group.size * own.points[v]); });
  }
  // Copies and mirror images hide others, but need no prices.
  for (const GroupProblem& group : groups) {
    const PlanMesh& own = group.searched().mesh;
    for (std::size_t k = 1; k < group.places.size(); ++k) {
      const GroupProblem::Simplified* simple = group.simplified_at(0);
      const auto vertex = [&](std::int32_t v) { return simple != nullptr ? simple->vertices[v] : v; };
      add(own, group.size, [&](std::int32_t v) { return whole.points[group.places[k].vertices[vertex(v)]]; });
    }
  }
  return find_visibility(all, options.front, task, sizes);
}

void SeamPlanner::Impl::find_prices_of_all(const Visibility& visibility) {
  std::size_t begin = 0;
  const auto part = [&](const std::vector<double>& values, std::size_t count) {
    if (values.empty()) return values;
    const auto first = values.begin() + static_cast<std::ptrdiff_t>(begin);
    return std::vector<double>(first, first + static_cast<std::ptrdiff_t>(count));
  };
  for (GroupProblem& group : groups) {
    const PlanMesh& mesh = group.searched().mesh;
    Visibility own{.front = part(visibility.front, mesh.vertex_count()),
                   .ambient = part(visibility.ambient, mesh.vertex_count())};
    begin += mesh.vertex_count();
    SlitProblem& original = group.original;
    if (group.is_large) own = at_places(own, nearest_of(original.mesh, group.simplified.front().vertices));
    for (GroupProblem::Simplified& simple : group.simplified) {
      SlitProblem& problem = simple.problem;
      problem.prices =
          find_prices(problem.mesh, at_places(own, simple.vertices), problem.reflection, weights_of(problem.mesh));
    }
    original.prices = find_prices(original.mesh, own, original.reflection, weights_of(original.mesh));
  }
}

/// Makes one group of those that are alike, and finds the pieces of each.
void SeamPlanner::Impl::join_copies() {
  constexpr double kSameSize = 1e-6;
  const auto is_same_size = [](double one, double other) { return std::abs(one - other) <= kSameSize * one; };
  std::unordered_map<std::uint64_t, std::vector<std::size_t>> by_likeness;
  std::vector<GroupProblem> joined;
  for (GroupProblem& group : groups) {
    std::vector<std::size_t>& candidates = by_likeness[groups.size() > 1 ? likeness(group.original) : 0];
    const auto like = std::ranges::find_if(candidates, [&](std::size_t other) {
      return is_same_size(joined[other].size, group.size) && are_alike(joined[other].original, group.original);
    });
    if (like != candidates.end()) {
      std::ranges::move(group.places, std::back_inserter(joined[*like].places));
      continue;
    }
    candidates.push_back(joined.size());
    joined.push_back(std::move(group));
  }
  groups = std::move(joined);
  for (GroupProblem& group : groups) {
    find_pieces_of(group.original);
    for (GroupProblem::Simplified& simple : group.simplified) find_pieces_of(simple.problem);
  }
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

SeamPlanner::SeamPlanner(std::shared_ptr<const Surface> surface, const SeamPlannerOptions& options, const Task& task)
    : SeamPlanner(SurfaceContext(std::move(surface)), options, task) {}

SeamPlanner::SeamPlanner(const SurfaceContext& context, const SeamPlannerOptions& options, const Task& task) {
  const RisingProgress rising(task);
  auto impl = std::make_shared<Impl>(context, options, rising.task());
  check_options(*impl->surface, options);
  impl->prepare(rising.task());
  impl_ = std::move(impl);
}

/// The edges that are cut: seams, and those that a plan's wires run along.
std::vector<Edge> cuts_of(const SeamPlan& plan, std::vector<Edge> seams) {
  for (const PlannedWire& wire : plan.wires) {
    for (std::size_t i = 1; i < wire.vertices.size(); ++i) seams.push_back({wire.vertices[i - 1], wire.vertices[i]});
  }
  return seams;
}

/// One call of SeamPlanner::plan().
class Planning {
 public:
  Planning(const SeamPlanner::Impl& planner, const SeamGoal& goal, const std::function<void(const SeamPlan&)>& found,
           const Task& task);

  SeamPlan run() {
    part_limbs(part_of(task_, 0.0, kLimbsEnd));
    const bool is_bounded = std::isfinite(goal_.distortion);
    const double budget = goal_.steps > 0 ? static_cast<double>(goal_.steps) : kBudget;
    const double search_end = kTreesEnd + (1.0 - kTreesEnd) * share_of_search(budget);
    for_each_group(part_of(task_, kLimbsEnd, kTreesEnd),
                   [&](std::size_t g, const Task& own) { plans_[g].grow(is_bounded, own); });
    tell();
    bound_ = bound_of_groups();
    const SlitGoal aim{.energy = bound_, .may_cross_faces = goal_.distortion < kLowStretch, .budget = budget};
    for_each_group(part_of(task_, kTreesEnd, search_end), [&](std::size_t g, const Task& own) {
      plans_[g].search(
          aim, is_small(g) ? std::function<void()>() : [&] { tell(); }, own);
    });
    return finished(part_of(task_, search_end, 1.0));
  }

 private:
  static constexpr double kLimbsEnd = 0.02, kTreesEnd = 0.06;  // shares of all work

  bool is_small(std::size_t group) const {
    return plans_.size() > 1 && groups()[group].searched().mesh.face_count() < kSmallGroup;
  }
  const std::vector<GroupProblem>& groups() const { return planner_.groups; }
  /// The share of the search in the work of the search and of what follows.
  double share_of_search(double budget) const;
  void part_limbs(const Task& task);
  void halve_groups(const Task& task);
  void for_each_group(const Task& task, const std::function<void(std::size_t, const Task&)>& work) const;
  double bound_of_groups() const;
  std::vector<SlitChains> chains() const;
  SeamPlan plan_with(std::span<const SlitChains> chains, const Task& task) const;
  void tell() const;
  SeamPlan finished(const Task& task);
  std::vector<std::uint8_t> are_kept(const CutMaps& maps) const;
  void add_maps(SeamPlan& plan, const PlanMesh& mesh, const Place* place, const CutMaps& maps);
  void measure(SeamPlan& plan, const Task& task) const;

  const SeamPlanner::Impl& planner_;
  const SeamGoal& goal_;
  const std::function<void(const SeamPlan&)>& found_;
  const Task& task_;
  std::vector<GroupPlanning> plans_;  // by group
  double bound_ = 0.0;                // on the energy of each group
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

Planning::Planning(const SeamPlanner::Impl& planner, const SeamGoal& goal,
                   const std::function<void(const SeamPlan&)>& found, const Task& task)
    : planner_(planner),
      goal_(goal),
      found_(found),
      task_(task),
      place_of_face_(planner.mesh().face_count()),
      is_counted_(planner.mesh().face_count()) {
  for (const FaceFrame& frame : face_frames(planner.mesh())) areas_.push_back(frame.area);
  for (std::size_t g = 0; g < groups().size(); ++g) {
    plans_.emplace_back(groups()[g]);
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

double Planning::share_of_search(double budget) const {
  constexpr double kStepsOfMeasuring = 4.0;  // wires, islands and the measure, in Newton steps on the surface
  double search = 0.0;
  if (std::isfinite(goal_.distortion)) {
    for (const GroupProblem& group : groups()) search += group.work(budget);
  }
  double after = kStepsOfMeasuring;
  if (planner_.wires->are_across()) after += (SlitChains::kClosest + 1) * (kStepsOfMap + kStepsOfMeasuring);
  after *= static_cast<double>(planner_.mesh().face_count());
  return after > 0.0 ? search / (search + after) : 1.0;
}

/// Cuts around limbs at their necks, as many as the goal asks for.
void Planning::part_limbs(const Task& task) {
  std::size_t islands = 0;
  for (std::size_t g = 0; g < plans_.size(); ++g) islands += groups()[g].places.size() * index(plans_[g].piece_count());
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
  for (std::size_t g = 0; g < plans_.size(); ++g) plans_[g].part(chosen[g]);
  halve_groups(task);
}

/// Cuts into halves, in the group whose pieces are the largest, until there are as many islands as the goal asks for.
void Planning::halve_groups(const Task& task) {
  std::vector<std::size_t> counts, most;
  std::size_t islands = 0;
  for (std::size_t g = 0; g < plans_.size(); ++g) {
    counts.push_back(index(plans_[g].piece_count()));
    most.push_back(plans_[g].most_pieces());
    islands += groups()[g].places.size() * counts[g];
  }
  if (islands >= goal_.islands) return;
  const auto size = [&](std::size_t g) { return groups()[g].size * groups()[g].size / static_cast<double>(counts[g]); };
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
void Planning::for_each_group(const Task& task, const std::function<void(std::size_t, const Task&)>& work) const {
  std::vector<std::size_t> small, large;
  for (std::size_t g = 0; g < plans_.size(); ++g) (is_small(g) ? small : large).push_back(g);
  const auto size = [&](std::size_t g) { return static_cast<double>(groups()[g].searched().mesh.face_count()); };
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
double Planning::bound_of_groups() const {
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

/// The slits of all places.
std::vector<SlitChains> Planning::chains() const {
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
SeamPlan Planning::plan_with(std::span<const SlitChains> chains, const Task& task) const {
  const Surface& surface = *planner_.surface;
  SeamPlan plan;
  plan.wires = planner_.wires->along(planner_.mesh(), chains, task);
  for (const std::vector<std::int32_t>& chain : one_sided_chains(surface, planner_.options.seams)) {
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
  plan.is_reached = std::isfinite(plan.energy) && plan.energy <= goal_.distortion && !overlaps;
  const std::vector<Edge> cuts = cuts_of(plan, planner_.options.seams);
  plan.islands = face_segments(surface, cuts);
  for (const std::int32_t missing : missing_cuts(surface, cuts, plan.islands)) {
    ++plan.island_count;
    plan.not_discs += missing > 0 ? 1 : 0;
  }
  return plan;
}

void Planning::tell() const {
  if (found_) found_(plan_with(chains(), {.stop = task_.stop, .progress = {}}));
}

/// The plan with the map that belongs to its wires. Wires that leave a piece without a good map come nearer to the
/// slits.
SeamPlan Planning::finished(const Task& task) {
  constexpr double kMapBegins = 0.3, kMeasureBegins = 0.95;
  constexpr int kMostTries = SlitChains::kClosest + 1;
  std::vector<SlitChains> slits = chains();
  const PlanMesh& mesh = planner_.mesh();
  for (int attempt = 0;; ++attempt) {
    const auto place = [&](double share) { return kMeasureBegins * (attempt + share) / kMostTries; };
    SeamPlan plan = plan_with(slits, part_of(task, place(0.0), place(kMapBegins)));
    bool is_again = false;
    plan.uvs.assign(planner_.surface->face_count(), {Point2::Zero(), Point2::Zero(), Point2::Zero()});
    energies_.clear();
    is_mapped_ = true;
    if (planner_.wires->are_across()) {
      const std::vector<std::uint8_t> is_cut = marked_edges(mesh, cuts_of(plan, planner_.options.seams));
      const CutMaps maps = solve_cut(mesh, is_cut, part_of(task, place(kMapBegins), place(1.0)));
      const std::vector<std::uint8_t> is_kept = are_kept(maps);
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
std::vector<std::uint8_t> Planning::are_kept(const CutMaps& maps) const {
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
    const double most = planned.energy <= bound_ ? bound_ : kWorse * planned.energy;
    const bool is_good = found[i].is_mapped && (!found[i].overlaps || planned.overlaps) &&
                         found[i].islands <= planned.maps.maps.size() &&
                         mean_energy(std::move(found[i].energies)) <= most;
    kept.push_back(is_good || !std::isfinite(planned.energy) ? 1 : 0);
  }
  return kept;
}

/// Adds UVs. `place`: where the faces and vertices of the maps' mesh are on the whole mesh; null: in the same place.
void Planning::add_maps(SeamPlan& plan, const PlanMesh& mesh, const Place* place, const CutMaps& maps) {
  const PlanMesh& whole = planner_.mesh();
  const auto whole_face = [&](std::int32_t f) { return place != nullptr ? place->faces[f] : f; };
  for (std::size_t i = 0; i < maps.maps.size(); ++i) {
    const auto& map = maps.maps[i];
    const bool is_counted = is_counted_[whole_face(maps.first_faces[i])] != 0;
    is_mapped_ = is_mapped_ && (map || !is_counted);
    if (!map) continue;
    for (std::size_t k = 0; k < map->island.triangles.size(); ++k) {
      const std::int32_t face = whole_face(map->island.faces[k]), own_face = whole.faces[face];
      const Triangle& corners = planner_.surface->triangles()[own_face];
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
void Planning::measure(SeamPlan& plan, const Task& task) const {
  plan.is_reached = false;
  plan.energy = kNever;
  if (!is_mapped_) return;
  const MapReport report = measure_islands(*planner_.surface, plan.uvs, plan.islands, false, task);
  std::vector<std::uint8_t> is_counted_island(plan.island_count, 0);
  for (std::size_t f = 0; f < is_counted_.size(); ++f) {
    if (is_counted_[f] != 0) is_counted_island[plan.islands[planner_.mesh().faces[f]]] = 1;
  }
  const bool is_all = std::ranges::all_of(is_counted_, [](std::uint8_t counted) { return counted != 0; });
  plan.energy = is_all ? report.energy : mean_energy(energies_);
  const bool overlaps =
      std::ranges::any_of(report.overlapping, [&](std::int32_t island) { return is_counted_island[island] != 0; });
  plan.is_reached = std::isfinite(plan.energy) && plan.energy <= goal_.distortion && !overlaps;
}

SeamPlan SeamPlanner::plan(const SeamGoal& goal, const std::function<void(const SeamPlan&)>& found,
                           const Task& task) const {
  if (!(goal.distortion > 4.0)) {
    throw InvalidInput("distortion is " + std::to_string(goal.distortion) + ", not above 4, that of an isometry");
  }
  const RisingProgress rising(task);
  return Planning(*impl_, goal, found, rising.task()).run();
}

}  // namespace seamwire
