// SPDX-License-Identifier: GPL-3.0-or-later
#include "seams/straightening.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>

#include "seams/cut_pieces.hpp"
#include "seams/quality.hpp"

namespace seamwire {
namespace {

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

class Straightening {
 public:
  Straightening(std::vector<Choice> wires, const DirectWires& direct, const Surface& surface,
                const SeamPlannerOptions& options, const SeamLimits& limits, std::span<const double> max_spreads,
                const Task& task)
      : wires_(std::move(wires)),
        known_(direct),
        surface_(surface),
        options_(options),
        limits_(limits),
        max_spreads_(max_spreads),
        task_(task) {}

  std::vector<Choice> done();

 private:
  CutPieces pieces(const std::vector<Choice>& of) const {
    return CutPieces(surface_, chains_of(of, options_.seams), max_spreads_);
  }
  bool is_as_good(const std::vector<Choice>& trial) const;
  bool straighten_one();
  std::optional<std::vector<Choice>> without_joint(const Joints& joints, std::int32_t joint) const;

  std::vector<Choice> wires_;
  const DirectWires& known_;
  const Surface& surface_;
  const SeamPlannerOptions& options_;
  const SeamLimits& limits_;
  const std::span<const double> max_spreads_;
  const Task& task_;

  std::size_t piece_count_ = 0;
  std::optional<Quality> quality_;  // of what there was at first; nullopt: nothing was tried
  std::map<Ends, Choice> direct_;
  std::set<std::pair<std::int32_t, Ends>> tried_;
};

bool Straightening::is_as_good(const std::vector<Choice>& trial) const {
  if (!limits_.may_start_on_others && meeting_at_seeds(trial).size() != trial.size()) return false;
  const CutPieces cut = pieces(trial);
  const Quality now(cut);
  return cut.piece_count() == piece_count_ && now.crumbs <= quality_->crumbs && now.not_discs <= quality_->not_discs &&
         now.bent <= std::max(quality_->bent, 0.0);
}

bool Straightening::straighten_one() {
  const Joints joints = joints_of(wires_, options_.seams);
  for (const auto& [joint, at] : joints) {
    task_.check(0.0);
    if (!direct_.contains(at.ends) || !tried_.insert({joint, at.ends}).second) continue;
    std::optional<std::vector<Choice>> trial = without_joint(joints, joint);
    if (!trial || !is_as_good(*trial)) continue;
    wires_ = std::move(*trial);
    return true;
  }
  return false;
}

/// All that can be tried with the wires that are known, before more are found: those are found on several threads.
std::vector<Choice> Straightening::done() {
  while (true) {
    std::set<Ends> missing;
    for (const auto& [joint, at] : joints_of(wires_, options_.seams)) {
      if (!direct_.contains(at.ends)) missing.insert(at.ends);
    }
    if (missing.empty()) return std::move(wires_);
    direct_.merge(known_.find(missing, task_));
    if (!quality_) {
      const CutPieces cut = pieces(wires_);
      piece_count_ = cut.piece_count();
      quality_.emplace(cut);
    }
    while (straighten_one()) continue;
  }
}

/// The wires with direct ones in place of those that meet at a joint, and at its image; nullopt where that costs more.
std::optional<std::vector<Choice>> Straightening::without_joint(const Joints& joints, std::int32_t joint) const {
  const Joint& own = joints.at(joint);
  std::vector<std::size_t> gone(own.wires.begin(), own.wires.end());
  std::vector<Choice> come{direct_.at(own.ends)};
  const std::int32_t image = options_.images.empty() ? -1 : options_.images[joint];
  if (image >= 0 && image != joint) {
    const auto other = joints.find(image);
    const Ends ends = ends_of(options_.images[own.ends.first], options_.images[own.ends.second]);
    if (other == joints.end() || other->second.ends != ends || !direct_.contains(ends)) return std::nullopt;
    for (const std::size_t wire : other->second.wires) {
      if (std::ranges::find(gone, wire) != gone.end()) return std::nullopt;  // one after the other then
      gone.push_back(wire);
    }
    come.push_back(mirrored(come.front(), surface_, options_).value_or(direct_.at(ends)));
  }
  double before = 0.0, after = 0.0;
  for (const std::size_t wire : gone) before += price(surface_, wires_[wire]);
  for (const Choice& choice : come) {
    if (choice.wire.vertices.size() < 2) return std::nullopt;
    after += price(surface_, choice);
  }
  if (!(after < before)) return std::nullopt;
  std::vector<Choice> trial;
  for (std::size_t i = 0; i < wires_.size(); ++i) {
    if (std::ranges::find(gone, i) == gone.end()) trial.push_back(wires_[i]);
  }
  trial.insert(trial.end(), come.begin(), come.end());
  return trial;
}

}  // namespace

std::map<Ends, Choice> DirectWires::find(const std::set<Ends>& pairs, const Task& task) const {
  std::map<Ends, Choice> out;
  std::vector<CandidateWires::Fan> missing;
  {
    const std::scoped_lock lock(mutex_);
    for (const Ends& ends : pairs) {
      if (const auto known = known_.find(ends); known != known_.end()) {
        out.insert(*known);
      } else {
        missing.push_back({ends.first, {ends.second}});
      }
    }
  }
  std::vector<std::vector<CandidateWire>> found = wires_.find(missing, task);
  for (std::size_t i = 0; i < missing.size(); ++i) {
    const std::int32_t from = missing[i].from, to = missing[i].to.front();
    out.insert({{from, to}, make_choice(from, to, std::move(found[i].front()), seclusion_)});
  }
  const std::scoped_lock lock(mutex_);
  known_.insert(out.begin(), out.end());
  return out;
}

std::vector<Choice> straightened(std::vector<Choice> wires, const DirectWires& direct, const Surface& surface,
                                 const SeamPlannerOptions& options, const SeamLimits& limits,
                                 std::span<const double> max_spreads, const Task& task) {
  return Straightening(std::move(wires), direct, surface, options, limits, max_spreads, task).done();
}

}  // namespace seamwire
