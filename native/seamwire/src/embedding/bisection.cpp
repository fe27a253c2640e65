// SPDX-License-Identifier: GPL-3.0-or-later
#include "embedding/bisection.hpp"

#include <algorithm>
#include <utility>

#include "detail/drop_repeats.hpp"
#include "detail/half_edge.hpp"
#include "detail/poll.hpp"
#include "embedding/deviation.hpp"

namespace seamwire::detail {
namespace {

// Lengths that differ by less than this fraction are equal, so that rounding, which depends on the scale of the input,
// does not choose which edge to bisect.
constexpr double kEqual = 1e-9;
// Bisections of an original face, one of a part of a part, until newest-vertex bisection begins.
constexpr std::uint8_t kNewestDepth = BisectedMesh::kMostDepth;
// Bisections of an original face where the rest is left to length repair: few enough that no edge gets too short for
// it.
constexpr std::uint8_t kShallowDepth = 8;
// Triangles to bisect before another one, of kResolving. Where the halves of an edge measure longer than the edge, as
// between normals that are nearly opposite, a chain of ever longer edges need not end.
constexpr int kMostBefore = 12;

}  // namespace

ActiveFaces::ActiveFaces(const BisectedMesh& mesh) : states_(mesh.given_face_count(), State::kGiven) {
  keep_bisected(mesh);
}

void ActiveFaces::keep_bisected(const BisectedMesh& mesh) {
  for (std::size_t f = mesh.given_face_count(); f < mesh.face_count(); ++f) states_[mesh.origins[f]] = State::kKept;
}

bool ActiveFaces::activate(BisectedMesh& mesh, std::int32_t face) {
  State& state = states_[face];
  if (state == State::kKept) return false;
  if (state == State::kGiven) {
    for (const std::int32_t fan : mesh.triangles[face]) mesh.set_node(fan);
    state = State::kActive;
    active_.push_back(face);
    ++activations_;
  }
  return true;
}

void ActiveFaces::reset(const std::vector<std::int32_t>& faces) {
  for (const std::int32_t face : faces) states_[face] = State::kGiven;
}

void ActiveFaces::add_conflict(std::int32_t one, std::int32_t other) {
  conflicts_.insert(conflicts_.end(), {one, other});
}

std::vector<std::int32_t> ActiveFaces::take_conflicts(const BisectedMesh& mesh) {
  reset(active_);
  active_.clear();
  keep_bisected(mesh);
  return std::exchange(conflicts_, {});
}

Bisection::Bisection(BisectedMesh mesh, const EmbedOptions& options, Scheme scheme, ActiveFaces* active)
    : mesh_(std::move(mesh)),
      options_(options),
      scheme_(scheme),
      active_(active),
      invalid_before_(mesh_.degenerate_faces_removed) {}

std::int32_t Bisection::longest_edge(std::int32_t f) const {
  std::int32_t best = 3 * f;
  for (const std::int32_t h : {3 * f + 1, 3 * f + 2}) {
    if (mesh_.lengths[h] > mesh_.lengths[best] * (1 + kEqual)) best = h;
  }
  return best;
}

void Bisection::queue(std::int32_t f, double priority) {
  const std::uint64_t place = std::uint64_t(mesh_.origins[f]) << 32 | mesh_.branches[f];
  queue_.push({static_cast<float>(priority), f, place});
}

void Bisection::consider(std::int32_t f) {
  if (scheme_ == Scheme::kResolving && mesh_.depths[f] >= BisectedMesh::kMostDepth) return;
  if (mesh_.is_valid(f)) {
    if (scheme_ != Scheme::kResolving) return;
    if (const double score = error_score(mesh_, f); score > kScorePerError * options_.max_error) queue(f, -1 / score);
    return;
  }
  if (mesh_.is_degenerate(f)) {
    has_decayed_ = has_decayed_ || !mesh_.is_of_degenerate_face(f);
    return;
  }
  if (scheme_ == Scheme::kNone) return;
  if (scheme_ == Scheme::kShallowPropagation && mesh_.depths[f] >= kShallowDepth) return;
  if (scheme_ == Scheme::kPropagation && first_newest_ == 0 && mesh_.depths[f] >= kNewestDepth) {
    deferred_.push_back(f);
  } else {
    queue(f, mesh_.perimeter(f));
  }
}

// The mesh as it stands becomes the starting triangulation.
void Bisection::begin_newest_vertex_bisection() {
  first_newest_ = mesh_.vertex_count();
  std::vector<std::int32_t> deferred;
  deferred.swap(deferred_);
  std::sort(deferred.begin(), deferred.end());
  drop_repeats(deferred);
  for (const std::int32_t f : deferred) consider(f);
}

// Where a triangle is to be bisected. Once newest-vertex bisection has begun: opposite its newest vertex; else, and for
// triangles of the starting triangulation, at its longest edge. Edges are in one strict order, that of their rounded
// lengths and then of their numbers, so a chain of neighbors with ever longer edges ends.
std::int32_t Bisection::refinement_edge(std::int32_t f) const {
  if (scheme_ == Scheme::kLongestEdge) return longest_edge(f);
  if (first_newest_ > 0) {
    const Triangle& corners = mesh_.triangles[f];
    const auto newest = static_cast<std::int32_t>(std::ranges::max_element(corners) - corners.begin());
    if (index(corners[newest]) >= first_newest_) return next_in_face(3 * f + newest);
  }
  const auto key = [&](std::int32_t h) {
    return std::pair(static_cast<float>(mesh_.lengths[h]), first_of_edge(mesh_, h));
  };
  std::int32_t best = 3 * f;
  for (const std::int32_t h : {3 * f + 1, 3 * f + 2}) {
    if (key(h) > key(best)) best = h;
  }
  return best;
}

// Bisects a face, and before it those that the scheme wants bisected first; false where that takes too many triangles.
bool Bisection::refine(std::int32_t f, std::size_t most) {
  chain_.assign(1, f);
  for (int before = 0; !chain_.empty();) {
    const std::int32_t h = refinement_edge(chain_.back()), beyond = mesh_.twins[h];
    std::int32_t next = -1;  // a triangle to bisect first, at another edge
    std::size_t parts = 1;
    mesh_.for_each_beyond(h, [&](std::int32_t o) {
      ++parts;
      if (scheme_ != Scheme::kLongestEdge && next < 0 && refinement_edge(o / 3) != o) next = o / 3;
    });
    const bool is_forced = scheme_ == Scheme::kResolving && before == kMostBefore;
    if (is_forced && chain_.size() > 1) {
      chain_.assign(1, f);
      continue;
    }
    if (next >= 0 && !is_forced) {
      chain_.push_back(next);
      ++before;
      continue;
    }
    if (mesh_.faces_added() + parts > most) return false;
    newest_bisections_ += first_newest_ > 0;
    if (active_ == nullptr || beyond < 0 || active_->activate(mesh_, mesh_.origins[beyond / 3])) {
      bisect(h);
    } else {
      active_->add_conflict(mesh_.origins[beyond / 3], mesh_.origins[h / 3]);
    }
    chain_.pop_back();
  }
  return true;
}

void Bisection::bisect(std::int32_t h) {
  parts_.assign(1, h / 3);
  mesh_.for_each_beyond(h, [&](std::int32_t o) { parts_.push_back(o / 3); });
  const std::size_t halved = parts_.size();
  auto count = static_cast<std::int32_t>(mesh_.face_count());
  mesh_.bisect(h);
  for (std::size_t i = 0; i < halved; ++i) parts_.insert(parts_.begin() + std::ptrdiff_t(2 * i + 1), count++);
  for (const std::int32_t part : parts_) consider(part);
}

bool Bisection::run(const Task& task, std::size_t most, double& progress) {
  const Poll poll(task, progress, progress, mesh_.given_face_count());
  for (std::int32_t f = 0; index(f) < mesh_.given_face_count(); ++f) {
    poll.at(index(f));
    const bool is_valid = mesh_.is_valid(f);
    if (!is_valid) ++invalid_before_;
    if (!is_valid || scheme_ == Scheme::kResolving) consider(f);
  }
  task.check(progress);
  return work_off(task, most, progress);
}

// A face changes when a neighbor is bisected, and is queued again if it is still to be bisected.
bool Bisection::is_stale(const Candidate& candidate) const {
  const std::int32_t f = candidate.face;
  if (scheme_ == Scheme::kResolving) return static_cast<std::uint32_t>(candidate.place) != mesh_.branches[f];
  const auto perimeter = static_cast<float>(mesh_.perimeter(f));
  return perimeter != candidate.priority || mesh_.is_valid(f);
}

bool Bisection::work_off(const Task& task, std::size_t most, double& progress) {
  for (std::size_t steps = 0;;) {
    if (queue_.empty()) {
      if (deferred_.empty()) return true;
      begin_newest_vertex_bisection();
      continue;
    }
    const Candidate next = queue_.top();
    queue_.pop();
    if (is_stale(next)) continue;
    if (next.priority <= 0) were_all_valid_ = true;
    if (!refine(next.face, most)) {
      queue_.push(next);
      hit_cap_ = most == options_.max_faces_added;
      return false;
    }
    if (++steps % kBisectionsBetweenChecks == 0) {
      // How many are still to come is not known; each queued triangle needs one at least.
      const auto done = static_cast<double>(steps);
      progress = std::max(progress, done / (done + static_cast<double>(queue_.size())));
      task.check(progress);
    }
  }
}

Embedding Bisection::to_embedding() && {
  Embedding out = std::move(mesh_).to_embedding(scheme_ == Scheme::kLongestEdge);
  out.invalid_before = invalid_before_;
  out.hit_cap = hit_cap_;
  out.newest_bisections = newest_bisections_;
  out.options = options_;
  return out;
}

}  // namespace seamwire::detail
