// SPDX-License-Identifier: GPL-3.0-or-later
#include "seamwire/embedding/embedding.hpp"

#include <algorithm>
#include <string>
#include <utility>

#include "detail/index.hpp"
#include "detail/text.hpp"
#include "embedding/bisection.hpp"
#include "metric/metric_check.hpp"

namespace seamwire {
namespace {

// The paper's scheme may add this many triangles for each of the surface's, and this many in any case. Where it ends,
// it mostly ends below one for each.
constexpr std::size_t kBudget = 4, kLeastBudget = 20'000;
// And propagation and newest-vertex bisection this many. Nearly all that end at all end far below.
constexpr std::size_t kLaterBudget = 16, kLeastLaterBudget = 200'000;

void check_size(const Surface& surface, const Metric& metric) {
  const std::size_t n = surface.vertex_count();
  if (metric.tensors.size() != n || metric.normals.size() != n) {
    throw InvalidInput("metric of " + std::to_string(metric.size()) + " vertices for a surface of " +
                       std::to_string(n));
  }
}

void check_metric(const Surface& surface, const Metric& metric) {
  check_size(surface, metric);
  check_finite(metric);
}

std::size_t budget(const Surface& surface) { return std::max(kLeastBudget, kBudget * surface.face_count()); }
// Leaves room for fitting below the cap.
std::size_t later_budget(const Surface& surface, std::size_t cap) {
  return std::min(std::max(kLeastLaterBudget, kLaterBudget * surface.face_count()), cap / 4);
}

}  // namespace

Embedding embed(const Surface& surface, const Metric& metric, const EmbedOptions& options, const Task& task) {
  check_metric(surface, metric);
  if (!(options.sigma >= 0)) throw InvalidInput("sigma is " + text(options.sigma) + ", not 0 or more");
  task.check(0);
  double progress = 0;
  const auto done = [&](Refinement&& refinement) {
    Embedding out = std::move(refinement).result();
    task.check(1);
    return out;
  };
  Refinement paper(surface, metric, options, Scheme::kPaper);
  const std::size_t first_most = std::min(budget(surface), options.max_faces_added);
  const bool ends = paper.run(task, first_most, progress);
  if (ends && !paper.has_decayed()) return done(std::move(paper));

  const std::size_t most = later_budget(surface, options.max_faces_added);
  for (const Scheme scheme : {Scheme::kPropagate, Scheme::kShallow}) {
    Refinement refinement(surface, metric, options, scheme);
    if (!refinement.run(task, most, progress) || !refinement.fit(task, progress)) continue;
    // It may take half as many triangles again as the paper's scheme, which, had it been let, might have ended by now.
    const std::size_t papers_share = refinement.faces_added() * 2 / 3;
    if (!ends && papers_share > first_most && paper.work_off(task, papers_share, progress) && !paper.has_decayed()) {
      return done(std::move(paper));
    }
    return done(std::move(refinement));
  }
  Refinement fitting(surface, metric, options, Scheme::kFitAlone);
  fitting.run(task, most, progress);
  if (!fitting.fit(task, progress)) {
    // Each bisection that fits leaves fewer invalid triangles, those of the paper's scheme now more, now fewer. So that
    // a larger cap never leaves more, what counts is where the latter has left fewest.
    Refinement again(surface, metric, options, Scheme::kPaper);
    again.watch_unfit();
    again.run(task, first_most, progress);
    if (again.least_unfit() < fitting.count_unfit()) {
      Refinement best(surface, metric, options, Scheme::kPaper);
      best.run(task, again.least_unfit_at(), progress);
      Embedding out = done(std::move(best));
      out.hit_cap = fitting.hit_cap();
      return out;
    }
  }
  return done(std::move(fitting));
}

Embedding re_embed(const Surface& surface, const Metric& former, const Metric& metric, Embedding old,
                   const EmbedOptions& options, const Task& task) {
  check_size(surface, former);
  check_metric(surface, metric);
  const std::size_t faces = surface.face_count();
  const bool fits = old.points.size() >= surface.vertex_count() &&
                    old.mesh.face_count() + old.invalid_left >= surface.face_fans().size() + old.faces_added &&
                    std::ranges::all_of(old.source_face, [&](std::int32_t f) { return f >= 0 && index(f) < faces; });
  if (!fits) throw InvalidInput("the former embedding is of another surface");
  if (!old.is_local || former.normals != metric.normals) return embed(surface, metric, options, task);
  task.check(0);
  {
    Refinement changes(surface, metric, options, std::move(old));
    if (changes.run_changes(former, task, std::min(budget(surface), options.max_faces_added)) &&
        !changes.has_decayed()) {
      Embedding out = std::move(changes).result();
      task.check(1);
      return out;
    }
  }
  return embed(surface, metric, options, task);
}

}  // namespace seamwire
