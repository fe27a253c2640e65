// SPDX-License-Identifier: GPL-3.0-or-later
#include "seams/straightening.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <iterator>
#include <optional>
#include <tuple>
#include <utility>

#include "seams/curve_crossings.hpp"
#include "seams/cut_pieces.hpp"
#include "seams/quality.hpp"

namespace seamwire {
namespace {

/// A seed slides where that makes this part of what meets there cheaper, at least.
constexpr double kLeastGain = 0.01;
/// With more wires seeds stay: of 25 such slides on two models 4 were worth their four and more searches each.
constexpr std::size_t kMostSliding = 3;

/// A wire that meets others at a seed.
struct Meeting {
  std::int32_t other;  ///< its other end
  std::size_t wire;    ///< its number
};
/// Two or more at a seed where nothing else is, in the order of their other ends, all different.
using Junction = std::vector<Meeting>;
using Junctions = std::map<std::int32_t, Junction>;  // by the vertices of the seeds

/// `passed`: vertices where something else is.
Junctions junctions_of(const std::vector<Choice>& wires, std::set<std::int32_t> passed) {
  Junctions junctions;
  for (std::size_t i = 0; i < wires.size(); ++i) {
    const PlannedWire& wire = wires[i].wire;
    junctions[wire.from].push_back({wire.to, i});
    junctions[wire.to].push_back({wire.from, i});
    for (const std::int32_t v : wire.vertices) {
      if (v != wire.from && v != wire.to) passed.insert(v);
    }
  }
  for (auto& [seed, junction] : junctions) std::ranges::sort(junction, {}, &Meeting::other);
  std::erase_if(junctions, [&](const auto& at) {
    const auto& [seed, junction] = at;
    return junction.size() < 2 || passed.contains(seed) ||
           std::ranges::adjacent_find(junction, {}, &Meeting::other) != junction.end();
  });
  return junctions;
}

std::vector<std::int32_t> others_of(const Junction& junction) {
  std::vector<std::int32_t> others;
  for (const Meeting& meeting : junction) others.push_back(meeting.other);
  return others;
}

/// The other ends of two wires that are all that meet at a seed; nullopt: others do.
std::optional<Ends> joint_ends(const Junction& junction) {
  if (junction.size() != 2) return std::nullopt;
  return ends_of(junction[0].other, junction[1].other);
}

class Straightening {
 public:
  Straightening(std::vector<Choice> wires, std::span<const std::int32_t> fixed, const DirectWires& direct,
                const Surface& surface, const SeamPlannerOptions& options, const SeamLimits& limits,
                std::span<const double> max_spreads, const Task& task)
      : wires_(std::move(wires)),
        fixed_(fixed.begin(), fixed.end()),
        known_(direct),
        surface_(surface),
        options_(options),
        limits_(limits),
        max_spreads_(max_spreads),
        task_(task) {
    for (const auto& [a, b] : options.seams) fixed_.insert({a, b});
  }

  std::vector<Choice> done();

 private:
  Junctions junctions() const { return junctions_of(wires_, fixed_); }
  CutPieces pieces(const std::vector<Choice>& of) const {
    return CutPieces(surface_, chains_of(of, options_.seams), max_spreads_);
  }
  void find(const std::set<Ends>& pairs);
  bool is_as_good(const std::vector<Choice>& trial) const;
  bool replace(const Junctions& junctions, std::int32_t seed, const std::vector<Ends>& by, double least_gain);
  void settle();
  bool straighten_one();
  bool slide();
  std::vector<std::int32_t> places_to_slide_to(std::int32_t seed, const Junction& junction) const;
  std::int32_t image(std::int32_t v) const { return options_.images.empty() || v < 0 ? -1 : options_.images[v]; }
  Ends images(const Ends& ends) const { return ends_of(image(ends.first), image(ends.second)); }
  std::optional<std::vector<Choice>> replaced(const Junctions& junctions, std::int32_t seed,
                                              const std::vector<Ends>& by, double least_gain) const;

  std::vector<Choice> wires_;
  std::set<std::int32_t> fixed_;  // and what is on the seams that are there
  const DirectWires& known_;
  const Surface& surface_;
  const SeamPlannerOptions& options_;
  const SeamLimits& limits_;
  const std::span<const double> max_spreads_;
  const Task& task_;

  std::size_t piece_count_ = 0;
  std::size_t crossings_ = 0;       // where curves are cut
  std::optional<Quality> quality_;  // of what there was at first; nullopt: done() has not begun
  std::map<Ends, Choice> direct_;
  std::set<std::pair<std::int32_t, Ends>> tried_;
  std::set<std::tuple<std::int32_t, std::int32_t, std::vector<std::int32_t>>> slid_;  // from, to, the other ends
};

bool Straightening::is_as_good(const std::vector<Choice>& trial) const {
  // What is cut is the curves: they are to have in common what their chains of edges have.
  if (!limits_.may_start_on_others &&
      (meeting_at_seeds(trial).size() != trial.size() || curve_crossings(surface_, trial) > crossings_)) {
    return false;
  }
  const CutPieces cut = pieces(trial);
  const Quality now(cut, limits_);
  return cut.piece_count() == piece_count_ && now.crumbs <= quality_->crumbs && now.not_discs <= quality_->not_discs &&
         now.bent <= quality_->bent;
}

/// Finds wires between pairs that are not known here, to see what they are good for, on several threads.
void Straightening::find(const std::set<Ends>& pairs) {
  std::set<Ends> missing;
  std::ranges::copy_if(pairs, std::inserter(missing, missing.end()),
                       [this](const Ends& ends) { return !direct_.contains(ends); });
  if (!missing.empty()) direct_.merge(known_.find(missing, task_, CandidateWires::Effort::kQuick));
}

bool Straightening::straighten_one() {
  const Junctions now = junctions();
  for (const auto& [seed, junction] : now) {
    task_.check(0.0);
    const std::optional<Ends> ends = joint_ends(junction);
    if (!ends || !direct_.contains(*ends) || !tried_.insert({seed, *ends}).second) continue;
    if (replace(now, seed, {*ends}, 0.0)) return true;
  }
  return false;
}

/// Vertices half and a quarter of the way along the wires that the others pull a seed along, each with what it costs
/// for its length; those first that give way the most.
std::vector<std::int32_t> Straightening::places_to_slide_to(std::int32_t seed, const Junction& junction) const {
  struct Way {
    std::vector<std::int32_t> chain;  // from the seed
    Vector direction;
    double pull;
  };
  std::vector<Way> ways;
  Vector pull = Vector::Zero();
  for (const Meeting& meeting : junction) {
    const Choice& choice = wires_[meeting.wire];
    std::vector<std::int32_t> chain = choice.wire.vertices;
    if (chain.front() != seed) std::ranges::reverse(chain);
    const Vector to = surface_.points()[chain[chain.size() / 2]] - surface_.points()[seed];
    ways.push_back({std::move(chain), to.stableNormalized(), 0.0});
    pull += ways.back().direction / choice.worth();
  }
  for (Way& way : ways) way.pull = pull.dot(way.direction);
  std::ranges::sort(ways, std::greater<>(), &Way::pull);
  std::vector<std::int32_t> places;
  for (const std::size_t part : {2, 4}) {
    for (const Way& way : ways) {
      const std::size_t place = way.chain.size() / part;
      if (way.pull > 0.0 && place > 0 && place + 1 < way.chain.size()) places.push_back(way.chain[place]);
    }
  }
  return places;
}

/// Lets seeds slide along one of the wires that meet there, half or a quarter of its way, where direct wires from there
/// to the other ends cost less; returns whether one did.
bool Straightening::slide() {
  struct Slide {
    std::int32_t seed;
    std::vector<std::int32_t> others;
    std::vector<Ends> by;
  };
  std::vector<Slide> slides;
  std::set<Ends> pairs;
  for (const auto& [seed, junction] : junctions()) {
    // From the plane of symmetry it would slide away.
    if (junction.size() > kMostSliding || image(seed) == seed) continue;
    const std::vector<std::int32_t> places = places_to_slide_to(seed, junction), others = others_of(junction);
    const auto to = std::ranges::find_if(places, [&, at = seed](std::int32_t v) {
      return slid_.insert({at, v, others}).second;
    });
    if (to == places.end()) continue;
    std::vector<Ends> by;
    for (const std::int32_t other : others) {
      by.push_back(ends_of(*to, other));
      pairs.insert(by.back());
      if (const Ends opposite = images(by.back()); opposite.first >= 0) pairs.insert(opposite);
    }
    slides.push_back({seed, others, std::move(by)});
  }
  find(pairs);
  bool has_slid = false;
  for (const Slide& slide : slides) {
    task_.check(0.0);
    const Junctions now = junctions();
    const auto junction = now.find(slide.seed);
    if (junction == now.end() || others_of(junction->second) != slide.others) continue;
    has_slid |= replace(now, slide.seed, slide.by, kLeastGain);
  }
  return has_slid;
}

/// Lets direct wires be the shortest ones, all of them, or those with which the pieces stay as good.
void Straightening::settle() {
  std::map<Ends, std::vector<std::size_t>> quick;
  for (std::size_t i = 0; i < wires_.size(); ++i) {
    if (wires_[i].is_quick) quick[ends_of(wires_[i].wire.from, wires_[i].wire.to)].push_back(i);
  }
  std::set<Ends> pairs;
  for (const auto& [ends, numbers] : quick) pairs.insert(ends);
  const std::map<Ends, Choice> shortest = known_.find(pairs, task_);
  const auto settle_those = [&](const std::set<Ends>& those) {
    std::vector<Choice> trial = wires_;
    for (const Ends& ends : those) {
      if (is_barred(shortest.at(ends), options_.density)) return false;
      for (const std::size_t i : quick.at(ends)) trial[i] = shortest.at(ends);
    }
    if (!is_as_good(trial)) return false;
    wires_ = std::move(trial);
    return true;
  };
  if (pairs.empty() || settle_those(pairs)) return;
  for (const Ends& ends : pairs) settle_those({ends});
}

/// Puts direct wires in the place of those that meet at a seed, where that is as good and costs less; returns whether
/// it does.
bool Straightening::replace(const Junctions& junctions, std::int32_t seed, const std::vector<Ends>& by,
                            double least_gain) {
  std::optional<std::vector<Choice>> trial = replaced(junctions, seed, by, least_gain);
  if (!trial || !is_as_good(*trial)) return false;
  wires_ = std::move(*trial);
  return true;
}

/// All that can be tried with the wires that are known, before more are found.
std::vector<Choice> Straightening::done() {
  if (junctions().empty()) return std::move(wires_);
  {
    const CutPieces cut = pieces(wires_);
    piece_count_ = cut.piece_count();
    quality_.emplace(cut, limits_);
    crossings_ = limits_.may_start_on_others ? 0 : curve_crossings(surface_, wires_);
  }
  do {
    std::set<Ends> pairs;
    do {
      while (straighten_one()) continue;
      pairs.clear();
      for (const auto& [seed, junction] : junctions()) {
        if (const std::optional<Ends> ends = joint_ends(junction); ends && !direct_.contains(*ends))
          pairs.insert(*ends);
      }
      find(pairs);
    } while (!pairs.empty());
  } while (slide());
  settle();
  return std::move(wires_);
}

/// The wires with direct ones in place of those that meet at a seed, and at its image; nullopt where less than a part
/// of their price is gained.
std::optional<std::vector<Choice>> Straightening::replaced(const Junctions& junctions, std::int32_t seed,
                                                           const std::vector<Ends>& by, double least_gain) const {
  const Junction& own = junctions.at(seed);
  std::vector<std::size_t> gone;
  std::vector<Choice> come;
  come.reserve(2 * by.size());
  for (const Meeting& meeting : own) gone.push_back(meeting.wire);
  for (const Ends& ends : by) come.push_back(direct_.at(ends));
  if (const std::int32_t opposite = image(seed); opposite >= 0 && opposite != seed) {
    const auto other = junctions.find(opposite);
    if (other == junctions.end()) return std::nullopt;
    std::vector<std::int32_t> expected;
    for (const Meeting& meeting : own) expected.push_back(image(meeting.other));
    std::ranges::sort(expected);
    if (expected != others_of(other->second)) return std::nullopt;
    for (const Meeting& meeting : other->second) {
      if (std::ranges::find(gone, meeting.wire) != gone.end()) return std::nullopt;  // one after the other then
      gone.push_back(meeting.wire);
    }
    for (const Ends& ends : by) {
      const auto direct = direct_.find(images(ends));
      if (direct == direct_.end()) return std::nullopt;
      come.push_back(mirrored(direct_.at(ends), surface_, options_).value_or(direct->second));
    }
  }
  double before = 0.0, after = 0.0;
  for (const std::size_t wire : gone) before += price(surface_, wires_[wire]);
  for (const Choice& choice : come) {
    if (choice.wire.vertices.size() < 2 || is_barred(choice, options_.density)) return std::nullopt;
    after += price(surface_, choice);
  }
  if (!(after < (1.0 - least_gain) * before)) return std::nullopt;
  std::vector<Choice> trial;
  for (std::size_t i = 0; i < wires_.size(); ++i) {
    if (std::ranges::find(gone, i) == gone.end()) trial.push_back(wires_[i]);
  }
  trial.insert(trial.end(), come.begin(), come.end());
  return trial;
}

}  // namespace

std::map<Ends, Choice> DirectWires::find(const std::set<Ends>& pairs, const Task& task,
                                         CandidateWires::Effort effort) const {
  if (wires_.along() == Along::kEdges) effort = CandidateWires::Effort::kExact;  // which is as quick
  std::map<Ends, Choice> out;
  std::vector<Ends> missing;
  {
    const MutexLock lock(mutex_);
    const std::map<Ends, Choice>& all_known = known_[static_cast<std::size_t>(effort)];
    for (const Ends& ends : pairs) {
      if (const auto known = all_known.find(ends); known != all_known.end()) {
        out.insert(*known);
      } else {
        missing.push_back(ends);
      }
    }
  }
  // What begins at one vertex is found at once.
  std::map<std::int32_t, std::size_t> ending;
  for (const auto& [a, b] : missing) {
    ++ending[a];
    ++ending[b];
  }
  std::map<std::int32_t, std::vector<std::int32_t>> beginning;
  for (const auto& [a, b] : missing) {
    const bool is_turned = ending[b] > ending[a];
    beginning[is_turned ? b : a].push_back(is_turned ? a : b);
  }
  std::vector<CandidateWires::Fan> fans;
  fans.reserve(beginning.size());
  for (auto& [from, to] : beginning) fans.push_back({from, std::move(to)});
  std::vector<std::vector<CandidateWire>> found = wires_.find(fans, task, effort);
  for (std::size_t i = 0; i < fans.size(); ++i) {
    const std::int32_t from = fans[i].from;
    for (std::size_t k = 0; k < fans[i].to.size(); ++k) {
      const std::int32_t to = fans[i].to[k];
      Choice choice = make_choice(from, to, std::move(found[i][k]), seclusion_);
      choice.is_quick = effort == CandidateWires::Effort::kQuick;
      out.insert({ends_of(from, to), std::move(choice)});
    }
  }
  const MutexLock lock(mutex_);
  known_[static_cast<std::size_t>(effort)].insert(out.begin(), out.end());
  return out;
}

std::vector<Choice> straightened(std::vector<Choice> wires, std::span<const std::int32_t> fixed,
                                 const DirectWires& direct, const Surface& surface, const SeamPlannerOptions& options,
                                 const SeamLimits& limits, std::span<const double> max_spreads, const Task& task) {
  return Straightening(std::move(wires), fixed, direct, surface, options, limits, max_spreads, task).done();
}

}  // namespace seamwire
