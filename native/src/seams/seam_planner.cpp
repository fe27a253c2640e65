// SPDX-License-Identifier: GPL-3.0-or-later
#include "seamwire/seams/seam_planner.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <tuple>
#include <utility>

#include "detail/index.hpp"
#include "detail/text.hpp"
#include "seams/candidate_wires.hpp"
#include "seams/cut_pieces.hpp"
#include "seams/quality.hpp"
#include "seams/seam_choices.hpp"
#include "seams/seeding.hpp"
#include "seams/straightening.hpp"
#include "seams/thinning.hpp"
#include "seamwire/seams/missing_cuts.hpp"
#include "seamwire/surface/segments.hpp"
#include "wires/curve_check.hpp"

namespace seamwire {
namespace {

/// How much more the worst piece may be bent for fewer crumbs.
constexpr double kBentForCrumbs = 0.02;

/// What does not depend on seeds.
struct Wires {
  Wires(std::shared_ptr<const Surface> on, const SeamPlannerOptions& options, const Task& task)
      : found(std::move(on), options.along, options.strength, task),
        seclusion(found.surface(), found.curvature()),
        direct(found, seclusion) {}

  const CandidateWires found;
  const Seclusion seclusion;
  const DirectWires direct;
};

/// Throws what the constructor throws for options.
void check_options(const Surface& surface, const SeamPlannerOptions& options) {
  check_strength(options.strength);
  if (options.seeds < 1) throw InvalidInput("seeds is 0, not 1 or more");
  if (options.most_seeds < options.seeds) {
    throw InvalidInput("most_seeds is " + std::to_string(options.most_seeds) + ", less than seeds, " +
                       std::to_string(options.seeds));
  }
  const std::size_t count = surface.vertex_count();
  if (!options.images.empty() && options.images.size() != count) {
    throw InvalidInput("images has " + std::to_string(options.images.size()) + " items: there are " +
                       std::to_string(count) + " vertices");
  }
  if (!options.density.empty() && options.density.size() != count) {
    throw InvalidInput("density has " + std::to_string(options.density.size()) + " items: there are " +
                       std::to_string(count) + " vertices");
  }
  for (std::size_t v = 0; v < options.density.size(); ++v) {
    if (!(options.density[v] >= 0.0)) {
      throw InvalidInput("density[" + std::to_string(v) + "] is " + text(options.density[v]) +
                         ", not a number of at least 0");
    }
  }
  for (const std::int32_t v : options.seeds_at) check_index(v, count, "seeds_at: vertex");
  for (const std::int32_t v : options.images) {
    if (v != -1) check_index(v, count, "images: vertex");
  }
  for (std::int32_t v = 0; index(v) < options.images.size(); ++v) {
    const std::int32_t image = options.images[v];
    if (image == -1 || options.images[image] == v) continue;
    throw InvalidInput("images: the image of vertex " + std::to_string(v) + " is " + std::to_string(image) +
                       ", but the image of that is " + std::to_string(options.images[image]));
  }
  for (const Edge& edge : options.seams) {
    for (const std::int32_t v : edge) check_index(v, count, "seams: vertex");
  }
}

/// Throws what plan() throws for limits; returns those of triangles.
std::vector<double> checked_spreads(const Surface& surface, const SeamLimits& limits) {
  const auto check = [](double spread, const std::string& name) {
    if (!(spread >= 0.0)) throw InvalidInput(name + " is " + text(spread) + ", not a number of at least 0");
  };
  check(limits.max_spread, "max_spread");
  for (const auto& [crumb, name] : {std::pair(limits.crumb, "crumb"), {limits.crumb_of_island, "crumb_of_island"}}) {
    if (crumb >= 0.0 && crumb <= 1.0) continue;
    throw InvalidInput(std::string(name) + " is " + text(crumb) + ", not between 0 and 1");
  }
  std::vector<double> max_spreads = limits.max_spreads;
  if (max_spreads.empty()) max_spreads.assign(surface.face_count(), limits.max_spread);
  if (max_spreads.size() != surface.face_count()) {
    throw InvalidInput("max_spreads has " + std::to_string(max_spreads.size()) + " items: there are " +
                       std::to_string(surface.face_count()) + " triangles");
  }
  for (std::size_t f = 0; f < max_spreads.size(); ++f) check(max_spreads[f], "max_spreads[" + std::to_string(f) + "]");
  return max_spreads;
}

/// Throws InvalidInput where a wire is not one of the surface.
void check_wire(const Surface& surface, const PlannedWire& wire, const std::string& name) {
  const std::vector<std::int32_t>& chain = wire.vertices;
  for (const std::int32_t v : chain) check_index(v, surface.vertex_count(), name + ": vertex");
  if (chain.size() < 2 || chain.front() != wire.from || chain.back() != wire.to) {
    throw InvalidInput(name + ": the edges of a wire do not lead from " + std::to_string(wire.from) + " to " +
                       std::to_string(wire.to));
  }
  for (std::size_t i = 1; i < chain.size(); ++i) {
    const auto [a, b] = std::minmax(chain[i - 1], chain[i]);
    if (std::ranges::binary_search(surface.edges(), Edge{a, b})) continue;
    throw InvalidInput(name + ": the surface has no edge between the vertices " + std::to_string(a) + " and " +
                       std::to_string(b));
  }
  const auto check_place = [&](std::int32_t v, const Vector& point) {
    if (is_same_place(surface, surface.points()[v], point)) return;
    throw InvalidInput(name + ": a wire is of another surface: it does not pass vertex " + std::to_string(v));
  };
  if (wire.faces.empty() && wire.points.size() == chain.size()) {
    for (std::size_t i = 0; i < chain.size(); ++i) check_place(chain[i], wire.points[i]);
  } else {
    check_curve(surface, wire.points, wire.faces, name + ": a wire is of another surface: ");
    check_place(wire.from, wire.points.front());
    check_place(wire.to, wire.points.back());
  }
  if (!(wire.worth > 0.0 && std::isfinite(wire.worth))) {
    throw InvalidInput(name + ": the worth of a wire is " + text(wire.worth) + ", not a finite number above 0");
  }
}

/// Wires of a plan as wires to choose from. Throws InvalidInput where they are not wires of the surface.
std::vector<Choice> choices_of(const Surface& surface, std::span<const PlannedWire> wires, const std::string& name) {
  std::vector<Choice> choices;
  choices.reserve(wires.size());
  for (const PlannedWire& wire : wires) {
    check_wire(surface, wire, name);
    choices.push_back({.wire = wire, .strength = wire.worth});
  }
  return choices;
}

}  // namespace

struct SeamPlanner::Impl {
  Impl(std::shared_ptr<const Wires> among, SeamPlannerOptions with, const Task& task)
      : options(std::move(with)),
        wires(std::move(among)),
        choices(wires_between_seeds(wires->found, wires->seclusion, options, task)) {}

  const Surface& surface() const { return wires->found.surface(); }
  CutPieces pieces(const std::vector<Choice>& of, std::span<const double> max_spreads) const {
    return CutPieces(surface(), chains_of(of, options.seams), max_spreads);
  }
  std::vector<Choice> straightened(std::vector<Choice> of, std::span<const std::int32_t> fixed,
                                   const SeamLimits& limits, std::span<const double> max_spreads,
                                   const Task& task) const {
    return seamwire::straightened(std::move(of), fixed, wires->direct, surface(), options, limits, max_spreads, task);
  }
  SeamPlan plan_of(std::vector<Choice> taken) const;
  std::vector<Choice> swept(std::vector<Choice> best, const SeamLimits& limits, std::span<const double> max_spreads,
                            const Task& task) const;
  std::vector<std::vector<Choice>> shortened(const Choice& wire, const std::vector<Choice>& others,
                                             const Task& task) const;

  const SeamPlannerOptions options;
  const std::shared_ptr<const Wires> wires;
  const std::vector<Choice> choices;
};

/// Lets wires start on others where they ran beside them, as long as that leaves fewer crumbs and pieces as good.
std::vector<Choice> SeamPlanner::Impl::swept(std::vector<Choice> best, const SeamLimits& limits,
                                             std::span<const double> max_spreads, const Task& task) const {
  CutPieces cut = pieces(best, max_spreads);
  Quality quality(cut, limits);
  std::vector<Choice> order = best;
  std::stable_sort(order.begin(), order.end(),
                   [](const Choice& a, const Choice& b) { return a.strength < b.strength; });
  for (const Choice& wire : order) {
    if (quality.crumbs == 0) break;
    if (wire.is_kept) continue;
    const auto place = std::ranges::find(best, wire.wire.vertices, [](const Choice& c) { return c.wire.vertices; });
    if (place == best.end() || !cut.has_beside(static_cast<std::int32_t>(place - best.begin()), quality.crumb))
      continue;
    std::vector<Choice> others = best;
    others.erase(others.begin() + (place - best.begin()));
    // An image that runs as the wire does is shortened with it.
    const std::optional<Choice> image = mirrored(wire, surface(), options);
    const auto has_course = [](const Choice& choice, const std::vector<std::int32_t>& course) {
      const std::vector<std::int32_t>& own = choice.wire.vertices;
      return own == course || std::equal(own.begin(), own.end(), course.rbegin(), course.rend());
    };
    const bool has_image =
        image && !has_course(wire, image->wire.vertices) &&
        std::erase_if(others, [&](const Choice& other) { return has_course(other, image->wire.vertices); }) > 0;
    for (const std::vector<Choice>& parts : shortened(wire, others, task)) {
      std::vector<Choice> trial = others;
      trial.insert(trial.end(), parts.begin(), parts.end());
      for (const Choice& part : parts) {
        if (!has_image) break;
        if (const std::optional<Choice> other = mirrored(part, surface(), options)) trial.push_back(*other);
      }
      CutPieces trial_cut = pieces(trial, max_spreads);
      const Quality now(trial_cut, limits);
      if (trial_cut.piece_count() >= limits.islands && now.crumbs < quality.crumbs &&
          now.not_discs <= quality.not_discs && now.bent <= quality.bent + kBentForCrumbs) {
        quality = now;
        cut = std::move(trial_cut);
        best = std::move(trial);
        break;
      }
    }
  }
  return best;
}

/// A wire between the vertices where it meets others, each time without one of these stretches.
std::vector<std::vector<Choice>> SeamPlanner::Impl::shortened(const Choice& wire, const std::vector<Choice>& others,
                                                              const Task& task) const {
  std::set<std::int32_t> drawn;
  std::set<Ends> shared;
  for (const auto& [a, b] : options.seams) {
    drawn.insert({a, b});
    shared.insert(ends_of(a, b));
  }
  for (const Choice& other : others) {
    const std::vector<std::int32_t>& chain = other.wire.vertices;
    drawn.insert(chain.begin(), chain.end());
    for (std::size_t i = 1; i < chain.size(); ++i) shared.insert(ends_of(chain[i - 1], chain[i]));
  }
  const std::vector<std::int32_t>& chain = wire.wire.vertices;
  std::vector<std::size_t> contacts;
  for (std::size_t i = 0; i < chain.size(); ++i) {
    if (i == 0 || i + 1 == chain.size() || drawn.contains(chain[i])) contacts.push_back(i);
  }
  if (contacts.size() < 3) return {};
  std::vector<CandidateWires::Fan> fans;
  for (std::size_t i = 1; i < contacts.size(); ++i) {
    const std::size_t a = contacts[i - 1], b = contacts[i];
    if (b - a == 1 && shared.contains(ends_of(chain[a], chain[b]))) continue;
    fans.push_back({chain[a], {chain[b]}});
  }
  std::vector<Choice> stretches;
  std::vector<std::vector<CandidateWire>> found = wires->found.find(fans, task);
  stretches.reserve(fans.size());
  for (std::size_t i = 0; i < fans.size(); ++i) {
    stretches.push_back(make_choice(fans[i].from, fans[i].to.front(), std::move(found[i].front()), wires->seclusion));
  }
  std::vector<std::vector<Choice>> ways;
  for (std::size_t left_out = 0; left_out < stretches.size(); ++left_out) {
    std::vector<Choice> parts;
    for (std::size_t i = 0; i < stretches.size(); ++i) {
      if (i != left_out && stretches[i].wire.vertices.size() > 1) parts.push_back(stretches[i]);
    }
    ways.push_back(std::move(parts));
  }
  return ways;
}

SeamPlan SeamPlanner::Impl::plan_of(std::vector<Choice> taken) const {
  SeamPlan plan;
  std::vector<Edge> cuts = options.seams;
  for (Choice& choice : taken) {
    const std::vector<std::int32_t>& chain = choice.wire.vertices;
    for (std::size_t i = 1; i < chain.size(); ++i) cuts.push_back({chain[i - 1], chain[i]});
    plan.cost += price(surface(), choice);
    choice.wire.worth = choice.worth();
    plan.wires.push_back(std::move(choice.wire));
  }
  plan.islands = face_segments(surface(), cuts);
  const std::vector<std::int32_t> missing = missing_cuts(surface(), cuts, plan.islands);
  plan.island_count = missing.size();
  plan.not_discs = static_cast<std::size_t>(std::ranges::count_if(missing, [](std::int32_t more) { return more > 0; }));
  return plan;
}

SeamPlanner::SeamPlanner(std::shared_ptr<const Surface> surface, const SeamPlannerOptions& options, const Task& task) {
  if (!surface) throw InvalidInput("surface: there is none");
  check_options(*surface, options);
  impl_ = std::make_shared<const Impl>(std::make_shared<const Wires>(std::move(surface), options, task), options, task);
}

SeamPlanner SeamPlanner::with(const SeamPlannerOptions& options, const Task& task) const {
  const SeamPlannerOptions& own = impl_->options;
  const auto strength_of = [](const SeamPlannerOptions& of) {
    return std::tie(of.strength.parameter, of.strength.max_anisotropy, of.strength.clamp_percentile);
  };
  if (options.along != own.along || strength_of(options) != strength_of(own)) {
    throw InvalidInput("along, strength: others than those of the planner");
  }
  check_options(impl_->surface(), options);
  SeamPlanner other(*this);
  other.impl_ = std::make_shared<const Impl>(impl_->wires, options, task);
  return other;
}

SeamPlan SeamPlanner::plan(const SeamLimits& limits, std::span<const PlannedWire> kept, const Task& task) const {
  const Surface& surface = impl_->surface();
  const std::vector<double> max_spreads = checked_spreads(surface, limits);
  std::vector<Choice> among = choices_of(surface, kept, "kept");
  std::vector<std::int32_t> fixed;
  for (Choice& choice : among) {
    choice.is_kept = true;
    fixed.insert(fixed.end(), choice.wire.vertices.begin(), choice.wire.vertices.end());
  }
  among.insert(among.end(), impl_->choices.begin(), impl_->choices.end());
  if (!limits.may_start_on_others) among = meeting_at_seeds(std::move(among));
  CutPieces all = impl_->pieces(among, max_spreads);
  std::vector<Choice> taken = thinned(surface, impl_->options.images, among, std::move(all), limits, task);
  if (limits.may_start_on_others) taken = impl_->swept(std::move(taken), limits, max_spreads, task);
  if (limits.are_straightened) taken = impl_->straightened(std::move(taken), fixed, limits, max_spreads, task);
  return impl_->plan_of(std::move(taken));
}

SeamPlan SeamPlanner::straightened(std::span<const PlannedWire> wires, const SeamLimits& limits,
                                   std::span<const std::int32_t> fixed, const Task& task) const {
  const Surface& surface = impl_->surface();
  const std::vector<double> max_spreads = checked_spreads(surface, limits);
  for (const std::int32_t v : fixed) check_index(v, surface.vertex_count(), "fixed: vertex");
  return impl_->plan_of(impl_->straightened(choices_of(surface, wires, "wires"), fixed, limits, max_spreads, task));
}

}  // namespace seamwire
