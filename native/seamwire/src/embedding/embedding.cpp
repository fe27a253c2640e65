// SPDX-License-Identifier: GPL-3.0-or-later
#include "seamwire/embedding/embedding.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "detail/drop_repeats.hpp"
#include "detail/index.hpp"
#include "detail/text.hpp"
#include "embedding/bisection.hpp"
#include "embedding/deviation.hpp"
#include "embedding/length_repair.hpp"
#include "metric/metric_check.hpp"
#include "surface/corner_fans.hpp"
#include "surface/exact_unit.hpp"
#include "surface/face_height.hpp"

namespace seamwire {

using namespace detail;

namespace {

// The faces at the vertices where two metrics differ, ascending. The surface's fans have the numbers of its vertices.
std::vector<std::int32_t> changed_faces(const Surface& surface, const Metric& former, const Metric& metric) {
  std::vector<std::int32_t> faces;
  for (std::int32_t v = 0; index(v) < surface.vertex_count(); ++v) {
    if (former.tensors[v] == metric.tensors[v]) continue;
    corner_fans(surface).for_each_leaving(v, [&](std::int32_t h) { faces.push_back(h / 3); });
  }
  std::sort(faces.begin(), faces.end());
  drop_repeats(faces);
  return faces;
}

/// Whether a face of the surface's corner fans is valid in a metric as it is.
bool is_valid_as_given(const Surface& surface, const Metric& metric, std::int32_t face) {
  Triangle corners = corner_fans(surface).triangles[face];
  for (std::int32_t& v : corners) v = corner_fans(surface).vertices[v];
  const auto [a, b, c] = corners;
  const double unit = exact_unit(surface);
  const std::array lengths{unit * edge_length(surface, metric, a, b), unit * edge_length(surface, metric, b, c),
                           unit * edge_length(surface, metric, c, a)};
  const auto side = [&](std::int32_t from, std::int32_t to) {
    return Vector((surface.points()[to] - surface.points()[from]) * unit);
  };
  return has_valid_lengths(lengths.data()) || are_lengths_of(lengths.data(), {side(a, b), side(b, c), side(c, a)});
}

/// re_embed() for an embedding that is local; normals of the two metrics must be equal. At most `most` triangles are
/// added to the surface's. Nothing where that is not enough, or longest-edge bisection does not end well. Throws
/// Cancelled.
std::optional<Embedding> re_embed_locally(const Surface& surface, const Metric& former, const Metric& metric,
                                          const Embedding& old, const EmbedOptions& options, const Task& task,
                                          std::size_t most) {
  std::vector<std::int32_t> seeds = changed_faces(surface, former, metric);
  std::size_t invalid_before = old.invalid_before;
  for (const std::int32_t face : seeds) {
    invalid_before += is_valid_as_given(surface, former, face);
    invalid_before -= is_valid_as_given(surface, metric, face);
  }
  BisectedMesh former_mesh(surface, metric, old, task);
  ActiveFaces active(former_mesh);
  Bisection bisection(std::move(former_mesh), options, Scheme::kLongestEdge, &active);
  BisectedMesh& mesh = bisection.mesh();
  double progress = 0;
  while (true) {
    const std::vector<std::int32_t> faces = mesh.undo(seeds);
    active.reset(faces);
    for (const std::int32_t face : faces) active.activate(mesh, face);
    for (const std::int32_t face : faces) {
      for (std::int32_t h = 3 * face; h < 3 * face + 3; ++h) mesh.set_length(h, mesh.measure(h));
    }
    for (const std::int32_t face : faces) bisection.consider(face);
    if (!bisection.work_off(task, most, progress)) return std::nullopt;
    if (!active.has_conflicts()) break;
    // All else is done. What took part in a conflict begins anew, both sides of it together.
    seeds = active.take_conflicts(mesh);
  }
  if (bisection.has_decayed()) return std::nullopt;
  Embedding out = std::move(bisection).to_embedding();
  out.invalid_before = invalid_before;
  out.faces_embedded = active.activations();
  return out;
}

// Longest-edge bisection, the paper's scheme, may add this many triangles for each of the surface's, and this many in
// any case. Where it ends, it mostly ends below one for each.
constexpr std::size_t kBudget = 4, kLeastBudget = 20'000;
// And propagation and newest-vertex bisection this many. Nearly all that end at all end far below.
constexpr std::size_t kLaterBudget = 16, kLeastLaterBudget = 200'000;
// A smaller max_error than this may take more triangles, in proportion.
constexpr double kErrorOfBudget = 0.005;

void check_metric(const Surface& surface, const Metric& metric) {
  check_size(surface, metric);
  check_tensors(metric);
}

void check(const EmbeddingInput& input) {
  const EmbedOptions& options = input.options;
  check_size(input.surface, input.metric);
  if (input.faces) {
    for (const std::int32_t f : *input.callers_faces) {
      for (const std::int32_t v : input.surface.triangles()[f]) check_tensor(input.metric, index(v));
    }
    for (const Edge& edge : input.surface.loose_edges()) {
      for (const std::int32_t v : edge) check_tensor(input.metric, index(v));
    }
  } else {
    check_tensors(input.metric);
  }
  if (!(options.max_error >= 0 && options.max_error <= 1)) {
    throw InvalidInput("max_error is " + text(options.max_error) + ", not between 0 and 1");
  }
  if (!(options.mean_edge_length >= 0 && std::isfinite(options.mean_edge_length))) {
    throw InvalidInput("mean_edge_length is " + text(options.mean_edge_length) + ", not a finite number of 0 or more");
  }
}

std::size_t budget(std::size_t faces) { return std::max(kLeastBudget, kBudget * faces); }
// Leaves room for length repair below the cap.
std::size_t later_budget(const EmbeddingInput& input) {
  return std::min(std::max(kLeastLaterBudget, kLaterBudget * input.face_count()), input.options.max_faces_added / 4);
}
std::size_t below_cap(const EmbedOptions& options) { return options.max_faces_added - options.max_faces_added / 4; }
std::size_t resolving_budget(const EmbeddingInput& input) {
  const double finer = std::max(1.0, kErrorOfBudget / input.options.max_error);
  const auto budget =
      std::max(static_cast<double>(kLeastLaterBudget), finer * static_cast<double>(kLaterBudget * input.face_count()));
  const std::size_t most = below_cap(input.options);
  return budget < static_cast<double>(most) ? static_cast<std::size_t>(budget) : most;
}

void sort_and_unify(std::vector<std::int32_t>& numbers) {
  std::ranges::sort(numbers);
  drop_repeats(numbers);
}

// The result of bisection, and of length repair after it.
Embedding finished(Bisection&& bisection, const LengthRepair& repair, const Task& task) {
  const std::vector<std::int32_t>& face_of = corner_fans(bisection.mesh().surface).faces;
  std::optional<Resolution> resolution;
  if (const double error = bisection.options().max_error; error > 0) {
    resolution = measure_resolution(bisection.mesh(), kScorePerError * error, task, 1.0);
  }
  Embedding out = std::move(bisection).to_embedding();
  out.resolution = resolution;
  if (resolution) out.is_local = false;
  out.hit_cap = out.hit_cap || repair.hit_cap;
  out.clamped_edges = repair.clamped_edges;
  out.worst_clamp = repair.worst_clamp;
  for (const std::int32_t f : repair.faces) out.repaired_faces.push_back(face_of[f]);
  sort_and_unify(out.repaired_faces);
  task.check(1);
  return out;
}

// Each bisection of length repair leaves fewer invalid triangles, so a larger cap never leaves more.
Embedding embed_by_repair(const EmbeddingInput& input, const Task& task, double progress) {
  Bisection none(BisectedMesh(input, task, progress), input.options, Scheme::kNone);
  none.run(task, 0, progress);
  const LengthRepair repair = repair_lengths(none.mesh(), input.options, task, progress);
  return finished(std::move(none), repair, task);
}

// With triangles that resolve the metric, as far as the budget goes. Nothing if invalid ones use it up.
std::optional<Embedding> embed_resolving(const EmbeddingInput& input, const Task& task, double& progress) {
  Bisection bisection(BisectedMesh(input, task, progress, EdgeRule::kMiddle), input.options, Scheme::kResolving);
  const std::size_t most = resolving_budget(input);
  const bool ends = bisection.run(task, most, progress);
  if (!ends && !bisection.were_all_valid()) return std::nullopt;
  LengthRepair repair = repair_lengths(bisection.mesh(), input.options, task, progress);
  if (!repair.is_complete) return std::nullopt;
  if (!ends && most == below_cap(input.options)) repair.hit_cap = true;
  return finished(std::move(bisection), repair, task);
}

}  // namespace

Embedding embed(const Surface& surface, const Metric& metric, const EmbedOptions& options, const Task& task) {
  const EmbeddingInput input(surface, metric, options);
  check(input);
  task.check(0);
  double progress = 0;
  if (options.max_error > 0) {
    if (std::optional<Embedding> out = embed_resolving(input, task, progress)) return std::move(*out);
  }
  Bisection paper(BisectedMesh(input, task, progress), options, Scheme::kLongestEdge);
  const std::size_t first_most = std::min(budget(input.face_count()), options.max_faces_added);
  const bool ends = paper.run(task, first_most, progress);
  if (ends && !paper.has_decayed()) return finished(std::move(paper), {}, task);

  const std::size_t most = later_budget(input);
  for (const Scheme scheme : {Scheme::kPropagation, Scheme::kShallowPropagation}) {
    Bisection bisection(BisectedMesh(input, task, progress), options, scheme);
    if (!bisection.run(task, most, progress)) continue;
    const LengthRepair repair = repair_lengths(bisection.mesh(), options, task, progress);
    if (!repair.is_complete) continue;
    // It may take half as many triangles again as the paper's scheme, which, had it been let, might have ended by now.
    const std::size_t papers_share = bisection.mesh().faces_added() * 2 / 3;
    if (!ends && papers_share > first_most && paper.work_off(task, papers_share, progress) && !paper.has_decayed()) {
      return finished(std::move(paper), {}, task);
    }
    return finished(std::move(bisection), repair, task);
  }
  return embed_by_repair(input, task, progress);
}

Embedding re_embed(const Surface& surface, const Metric& former, const Metric& metric, const Embedding& old,
                   const EmbedOptions& options, const Task& task) {
  check_size(surface, former);
  check(EmbeddingInput(surface, metric, options));
  const std::size_t faces = surface.face_count();
  const bool has_all_faces = old.mesh.face_count() == faces + old.faces_added;
  const bool is_of_surface =
      options.faces ||
      (old.points.size() >= surface.vertex_count() && (has_all_faces || !old.is_local) &&
       std::ranges::all_of(old.source_face, [&](std::int32_t f) { return f >= 0 && index(f) < faces; }));
  if (!is_of_surface) throw InvalidInput("the former embedding is of another surface");
  const auto embedded_anew = [&] {
    EmbedOptions same_size = options;
    if (same_size.mean_edge_length == 0) same_size.mean_edge_length = old.mean_edge_length;
    Embedding out = embed(surface, metric, same_size, task);
    out.options = options;
    return out;
  };
  if (!old.is_local || options.faces || options.max_error > 0 || former.normals != metric.normals) {
    return embedded_anew();
  }
  task.check(0);
  const std::size_t most = std::min(budget(faces), options.max_faces_added);
  std::optional<Embedding> out = re_embed_locally(surface, former, metric, old, options, task, most);
  if (!out) return embedded_anew();
  task.check(1);
  return std::move(*out);
}

std::vector<std::int32_t> invalid_faces(const Surface& surface, const Metric& metric) {
  check_metric(surface, metric);
  std::vector<std::int32_t> out;
  for (std::size_t f = 0; f < corner_fans(surface).triangles.size(); ++f) {
    const std::int32_t face = corner_fans(surface).faces[f];
    const auto& [a, b, c] = surface.triangles()[face];
    const auto side = [&](std::int32_t from, std::int32_t to) {
      return Vector((surface.points()[to] - surface.points()[from]) * exact_unit(surface));
    };
    if (!has_area(side(a, b), side(b, c), side(c, a)) ||
        !is_valid_as_given(surface, metric, static_cast<std::int32_t>(f))) {
      out.push_back(face);
    }
  }
  return out;
}

}  // namespace seamwire
