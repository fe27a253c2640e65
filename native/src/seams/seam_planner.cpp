// SPDX-License-Identifier: GPL-3.0-or-later
#include "seamwire/seams/seam_planner.hpp"

#include <algorithm>
#include <array>
#include <iterator>
#include <limits>
#include <map>
#include <mutex>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <utility>

#include "detail/index.hpp"
#include "detail/text.hpp"
#include "seams/candidate_wires.hpp"
#include "seams/cut_pieces.hpp"
#include "seams/seam_choices.hpp"
#include "seams/seeding.hpp"
#include "seams/thinning.hpp"
#include "seamwire/surface/segments.hpp"

namespace seamwire {
namespace {

/// How much more the worst piece may be bent for fewer crumbs.
constexpr double kBentForCrumbs = 0.02;

/// How good a set of wires is, but for their length.
struct Quality {
  explicit Quality(const CutPieces& pieces) {
    for (const Piece& piece : pieces.pieces()) crumb += kCrumb * piece.area;
    for (const Piece& piece : pieces.pieces()) {
      if (piece.area < crumb) {
        ++crumbs;
      } else {
        bent = std::max(bent, piece.spread() - piece.max_spread);
      }
      not_discs += piece.is_disc() ? 0 : 1;
    }
  }

  double crumb = 0.0;  ///< the area below which a piece is one
  std::size_t crumbs = 0, not_discs = 0;
  double bent = 0.0;  ///< by how much the spread of normals exceeds what is allowed, at most
};

/// A seed where two wires meet and nothing else is.
struct Joint {
  std::array<std::size_t, 2> wires;  ///< by their numbers
  Ends ends;                         ///< their other ends, which differ
};
using Joints = std::map<std::int32_t, Joint>;  // by the vertices of the seeds

Joints joints_of(const std::vector<Choice>& wires, const std::vector<Edge>& seams) {
  std::map<std::int32_t, std::vector<std::size_t>> ending;
  std::set<std::int32_t> passed;
  for (const auto& [a, b] : seams) passed.insert({a, b});
  for (std::size_t i = 0; i < wires.size(); ++i) {
    const PlannedWire& wire = wires[i].wire;
    ending[wire.from].push_back(i);
    ending[wire.to].push_back(i);
    for (const std::int32_t v : wire.vertices) {
      if (v != wire.from && v != wire.to) passed.insert(v);
    }
  }
  const auto other_end = [](const PlannedWire& wire, std::int32_t end) {
    return wire.from == end ? wire.to : wire.from;
  };
  Joints joints;
  for (const auto& [seed, meeting] : ending) {
    if (meeting.size() != 2 || passed.contains(seed)) continue;
    const Ends ends = ends_of(other_end(wires[meeting[0]].wire, seed), other_end(wires[meeting[1]].wire, seed));
    if (ends.first != ends.second) joints.insert({seed, {{meeting[0], meeting[1]}, ends}});
  }
  return joints;
}

}  // namespace

struct SeamPlanner::Impl {
  Impl(std::shared_ptr<const Surface> on, const SeamPlannerOptions& with, const Task& task)
      : options(with),
        wires(std::move(on), with.along, with.strength, task),
        seclusion(wires.surface(), wires.curvature()),
        choices(wires_between_seeds(wires, seclusion, options, task)) {}

  const Surface& surface() const { return wires.surface(); }
  CutPieces pieces(const std::vector<Choice>& of, std::span<const double> max_spreads) const {
    return CutPieces(surface(), chains_of(of, options.seams), max_spreads);
  }
  std::vector<Choice> swept(std::vector<Choice> best, const SeamLimits& limits, std::span<const double> max_spreads,
                            const Task& task) const;
  std::vector<std::vector<Choice>> shortened(const Choice& wire, const std::vector<Choice>& others,
                                             const Task& task) const;
  std::map<Ends, Choice> direct_wires(const std::set<Ends>& pairs, const Task& task) const;
  std::vector<Choice> straightened(std::vector<Choice> best, const SeamLimits& limits,
                                   std::span<const double> max_spreads, const Task& task) const;
  std::optional<std::vector<Choice>> without_joint(const std::vector<Choice>& present, const Joints& joints,
                                                   std::int32_t joint, const std::map<Ends, Choice>& direct) const;

  const SeamPlannerOptions options;
  const CandidateWires wires;
  const Seclusion seclusion;
  const std::vector<Choice> choices;

 private:
  mutable std::mutex known_direct_mutex_;
  mutable std::map<Ends, Choice> known_direct_;
};

/// Lets wires start on others where they ran beside them, as long as that leaves fewer crumbs and pieces as good.
std::vector<Choice> SeamPlanner::Impl::swept(std::vector<Choice> best, const SeamLimits& limits,
                                             std::span<const double> max_spreads, const Task& task) const {
  CutPieces cut = pieces(best, max_spreads);
  Quality quality(cut);
  std::vector<Choice> order = best;
  std::stable_sort(order.begin(), order.end(),
                   [](const Choice& a, const Choice& b) { return a.strength < b.strength; });
  for (const Choice& wire : order) {
    if (quality.crumbs == 0) break;
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
      const Quality now(trial_cut);
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
  std::vector<std::vector<CandidateWire>> found = wires.find(fans, task);
  stretches.reserve(fans.size());
  for (std::size_t i = 0; i < fans.size(); ++i) {
    stretches.push_back(make_choice(fans[i].from, fans[i].to.front(), std::move(found[i].front()), seclusion));
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

/// The wires between pairs of seeds; those that former plans needed are known.
std::map<Ends, Choice> SeamPlanner::Impl::direct_wires(const std::set<Ends>& pairs, const Task& task) const {
  std::map<Ends, Choice> out;
  std::vector<CandidateWires::Fan> missing;
  {
    const std::scoped_lock lock(known_direct_mutex_);
    for (const Ends& ends : pairs) {
      if (const auto known = known_direct_.find(ends); known != known_direct_.end()) {
        out.insert(*known);
      } else {
        missing.push_back({ends.first, {ends.second}});
      }
    }
  }
  std::vector<std::vector<CandidateWire>> found = wires.find(missing, task);
  for (std::size_t i = 0; i < missing.size(); ++i) {
    const std::int32_t from = missing[i].from, to = missing[i].to.front();
    out.insert({{from, to}, make_choice(from, to, std::move(found[i].front()), seclusion)});
  }
  const std::scoped_lock lock(known_direct_mutex_);
  known_direct_.insert(out.begin(), out.end());
  return out;
}

/// Lets one direct wire take the place of two that meet at a joint, where it costs less and leaves pieces as good.
std::vector<Choice> SeamPlanner::Impl::straightened(std::vector<Choice> best, const SeamLimits& limits,
                                                    std::span<const double> max_spreads, const Task& task) const {
  std::size_t piece_count = 0;
  std::optional<Quality> quality;
  std::map<Ends, Choice> direct;
  std::set<std::pair<std::int32_t, Ends>> tried;
  const auto is_as_good = [&](const std::vector<Choice>& trial) {
    if (!limits.may_start_on_others && meeting_at_seeds(trial).size() != trial.size()) return false;
    const CutPieces cut = pieces(trial, max_spreads);
    const Quality now(cut);
    return cut.piece_count() == piece_count && now.crumbs <= quality->crumbs && now.not_discs <= quality->not_discs &&
           now.bent <= std::max(quality->bent, 0.0);
  };
  // All that can be tried with the wires that are known, before more are found: those are found on several threads.
  const auto straighten_one = [&] {
    const Joints joints = joints_of(best, options.seams);
    for (const auto& [joint, at] : joints) {
      task.check(0.0);
      if (!direct.contains(at.ends) || !tried.insert({joint, at.ends}).second) continue;
      std::optional<std::vector<Choice>> trial = without_joint(best, joints, joint, direct);
      if (!trial || !is_as_good(*trial)) continue;
      best = std::move(*trial);
      return true;
    }
    return false;
  };
  while (true) {
    std::set<Ends> missing;
    for (const auto& [joint, at] : joints_of(best, options.seams)) {
      if (!direct.contains(at.ends)) missing.insert(at.ends);
    }
    if (missing.empty()) return best;
    direct.merge(direct_wires(missing, task));
    if (!quality) {
      const CutPieces cut = pieces(best, max_spreads);
      piece_count = cut.piece_count();
      quality.emplace(cut);
    }
    while (straighten_one()) continue;
  }
}

/// The wires with direct ones in place of those that meet at a joint, and at its image; nullopt where that costs more.
std::optional<std::vector<Choice>> SeamPlanner::Impl::without_joint(const std::vector<Choice>& present,
                                                                    const Joints& joints, std::int32_t joint,
                                                                    const std::map<Ends, Choice>& direct) const {
  const Joint& own = joints.at(joint);
  std::vector<std::size_t> gone(own.wires.begin(), own.wires.end());
  std::vector<Choice> come{direct.at(own.ends)};
  const std::int32_t image = options.images.empty() ? -1 : options.images[joint];
  if (image >= 0 && image != joint) {
    const auto other = joints.find(image);
    const Ends ends = ends_of(options.images[own.ends.first], options.images[own.ends.second]);
    if (other == joints.end() || other->second.ends != ends || !direct.contains(ends)) return std::nullopt;
    for (const std::size_t wire : other->second.wires) {
      if (std::ranges::find(gone, wire) != gone.end()) return std::nullopt;  // one after the other then
      gone.push_back(wire);
    }
    come.push_back(mirrored(come.front(), surface(), options).value_or(direct.at(ends)));
  }
  double before = 0.0, after = 0.0;
  for (const std::size_t wire : gone) before += price(surface(), present[wire]);
  for (const Choice& choice : come) {
    if (choice.wire.vertices.size() < 2) return std::nullopt;
    after += price(surface(), choice);
  }
  if (!(after < before)) return std::nullopt;
  std::vector<Choice> trial;
  for (std::size_t i = 0; i < present.size(); ++i) {
    if (std::ranges::find(gone, i) == gone.end()) trial.push_back(present[i]);
  }
  trial.insert(trial.end(), come.begin(), come.end());
  return trial;
}

SeamPlanner::SeamPlanner(std::shared_ptr<const Surface> surface, const SeamPlannerOptions& options, const Task& task) {
  if (!surface) throw InvalidInput("surface: there is none");
  check_strength(options.strength);
  if (options.seeds < 1) throw InvalidInput("seeds is 0, not 1 or more");
  if (options.most_seeds < options.seeds) {
    throw InvalidInput("most_seeds is " + std::to_string(options.most_seeds) + ", less than seeds, " +
                       std::to_string(options.seeds));
  }
  const std::size_t count = surface->vertex_count();
  if (!options.images.empty() && options.images.size() != count) {
    throw InvalidInput("images has " + std::to_string(options.images.size()) + " items: there are " +
                       std::to_string(count) + " vertices");
  }
  for (const std::int32_t v : options.images) {
    if (v != -1) check_index(v, count, "images: vertex");
  }
  for (const Edge& edge : options.seams) {
    for (const std::int32_t v : edge) check_index(v, count, "seams: vertex");
  }
  impl_ = std::make_shared<const Impl>(std::move(surface), options, task);
}

SeamPlan SeamPlanner::plan(const SeamLimits& limits, const Task& task) const {
  const auto check = [](double spread, const std::string& name) {
    if (!(spread >= 0.0)) throw InvalidInput(name + " is " + text(spread) + ", not a number of at least 0");
  };
  check(limits.max_spread, "max_spread");
  const Surface& surface = impl_->surface();
  std::vector<double> max_spreads = limits.max_spreads;
  if (max_spreads.empty()) max_spreads.assign(surface.face_count(), limits.max_spread);
  if (max_spreads.size() != surface.face_count()) {
    throw InvalidInput("max_spreads has " + std::to_string(max_spreads.size()) + " items: there are " +
                       std::to_string(surface.face_count()) + " triangles");
  }
  for (std::size_t f = 0; f < max_spreads.size(); ++f) check(max_spreads[f], "max_spreads[" + std::to_string(f) + "]");

  const std::vector<Choice> among = limits.may_start_on_others ? impl_->choices : meeting_at_seeds(impl_->choices);
  CutPieces all = impl_->pieces(among, max_spreads);
  std::vector<Choice> kept = thinned(surface, impl_->options.images, among, std::move(all), limits.islands, task);
  if (limits.may_start_on_others) kept = impl_->swept(std::move(kept), limits, max_spreads, task);
  if (limits.are_straightened) kept = impl_->straightened(std::move(kept), limits, max_spreads, task);
  SeamPlan plan;
  const CutPieces pieces = impl_->pieces(kept, max_spreads);
  plan.not_discs = Quality(pieces).not_discs;
  std::vector<Edge> cuts = impl_->options.seams;
  for (Choice& choice : kept) {
    const std::vector<std::int32_t>& chain = choice.wire.vertices;
    for (std::size_t i = 1; i < chain.size(); ++i) cuts.push_back({chain[i - 1], chain[i]});
    plan.cost += price(surface, choice);
    plan.wires.push_back(std::move(choice.wire));
  }
  plan.islands = face_segments(surface, cuts);
  for (const std::int32_t island : plan.islands) plan.island_count = std::max(plan.island_count, index(island) + 1);
  return plan;
}

}  // namespace seamwire
