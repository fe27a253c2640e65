// SPDX-License-Identifier: GPL-3.0-or-later
#include "seams/seam_choices.hpp"

#include <Eigen/Geometry>
#include <cmath>
#include <functional>
#include <map>
#include <numbers>

#include "surface/exact_unit.hpp"

namespace seamwire {
namespace {

/// A wire in a deep hollow, and one that nobody sees, is worth so many times more than one on a bare ridge.
constexpr double kHollow = 1.0, kHidden = 1.0;
/// Concave curvature that is halfway to the deepest hollow, of the model scaled to the unit cube.
constexpr double kDeep = 8.0;

/// In the caller's units.
double length(const Surface& surface, const std::vector<std::int32_t>& chain) {
  const double unit = exact_unit(surface);
  double sum = 0.0;
  for (std::size_t i = 1; i < chain.size(); ++i) {
    sum += (unit * (surface.points()[chain[i]] - surface.points()[chain[i - 1]])).norm();
  }
  return sum / unit;
}

/// How many vertices two chains have in common from an end on that both have.
std::size_t common_at_ends(std::vector<std::int32_t> one, std::vector<std::int32_t> other) {
  std::size_t count = 0;
  for (int i = 0; i < 4; ++i) {
    const auto differ = std::ranges::mismatch(one, other);
    count += static_cast<std::size_t>(differ.in1 - one.begin());
    std::ranges::reverse(i % 2 == 0 ? one : other);
  }
  return count;
}

}  // namespace

Seclusion::Seclusion(const Surface& surface, const Curvature& curvature)
    : surface_(surface), curvature_(curvature), rays_(surface.points(), surface.triangles()) {
  rays_.wait();
}

double Seclusion::of(const std::vector<std::int32_t>& vertices) const {
  constexpr std::size_t kSamples = 24;
  const std::size_t step = std::max<std::size_t>(vertices.size() / kSamples, 1);
  double hollow = 0.0, hidden = 0.0, count = 0.0;
  for (std::size_t i = 0; i < vertices.size(); i += step, ++count) {
    hollow += hollow_at(vertices[i]);
    hidden += hidden_at(vertices[i]);
  }
  return (1.0 + kHollow * hollow / count) * (1.0 + kHidden * hidden / count);
}

double Seclusion::hollow_at(std::int32_t v) const {
  // Normals point outwards where k > 0 is convex.
  const double k1 = curvature_.k1[v], k2 = curvature_.k2[v];
  const double concave = std::max(-std::min(k1, k2), 0.0), convex = std::max({k1, k2, 0.0});
  return concave / (concave + convex + kDeep);
}

double Seclusion::hidden_at(std::int32_t v) const {
  constexpr int kRays = 24;
  constexpr double kAbove = 1e-3;  // of the model's size: away from the faces around the vertex
  const Vector& normal = curvature_.normals[v];
  if (normal.isZero()) return 0.0;
  const Vector x = normal.unitOrthogonal(), y = normal.cross(x);
  const Vector origin = surface_.points()[v] + kAbove / surface_.scale() * normal;
  int hits = 0;
  for (int i = 0; i < kRays; ++i) {
    // Points of a Fibonacci spiral on the disc, lifted to the hemisphere.
    const double radius = std::sqrt((i + 0.5) / kRays);
    const double turn = i * std::numbers::pi * (3.0 - std::sqrt(5.0));
    const Vector direction =
        radius * (std::cos(turn) * x + std::sin(turn) * y) + std::sqrt(std::max(1.0 - radius * radius, 0.0)) * normal;
    hits += rays_.first_hit(origin, direction).triangle >= 0 ? 1 : 0;
  }
  return static_cast<double>(hits) / kRays;
}

Choice make_choice(std::int32_t from, std::int32_t to, CandidateWire found, const Seclusion& seclusion) {
  const double secluded = found.vertices.empty() ? 1.0 : seclusion.of(found.vertices);
  return {.wire = {.from = from,
                   .to = to,
                   .follow = found.follow,
                   .vertices = std::move(found.vertices),
                   .points = std::move(found.points),
                   .faces = std::move(found.faces)},
          .strength = found.strength,
          .seclusion = secluded};
}

double price(const Surface& surface, const Choice& choice) {
  return length(surface, choice.wire.vertices) / choice.worth();
}

bool is_barred(const Choice& choice, const std::vector<double>& density) {
  return !density.empty() &&
         std::ranges::any_of(choice.wire.vertices, [&](std::int32_t v) { return !(density[v] > 0.0); });
}

std::optional<Choice> mirrored(const Choice& choice, const Surface& surface, const SeamPlannerOptions& options) {
  if (options.images.empty() || options.along != Along::kEdges) return std::nullopt;
  Choice out = choice;
  const auto is_edge = [&](std::int32_t a, std::int32_t b) {
    return std::ranges::binary_search(surface.edges(), Edge{std::min(a, b), std::max(a, b)});
  };
  std::vector<std::int32_t>& chain = out.wire.vertices;
  for (std::size_t i = 0; i < chain.size(); ++i) {
    chain[i] = options.images[chain[i]];
    if (chain[i] < 0 || (i > 0 && !is_edge(chain[i - 1], chain[i]))) return std::nullopt;
    out.wire.points[i] = surface.points()[chain[i]];
  }
  out.wire.from = options.images[choice.wire.from];
  out.wire.to = options.images[choice.wire.to];
  return out;
}

std::vector<std::vector<std::int32_t>> chains_of(const std::vector<Choice>& choices, const std::vector<Edge>& seams) {
  std::vector<std::vector<std::int32_t>> chains;
  chains.reserve(choices.size() + seams.size());
  for (const Choice& choice : choices) chains.push_back(choice.wire.vertices);
  for (const auto& [a, b] : seams) chains.push_back({a, b});
  return chains;
}

std::vector<Choice> meeting_at_seeds(std::vector<Choice> choices) {
  std::ranges::stable_sort(choices, std::greater<>(),
                           [](const Choice& choice) { return std::pair(choice.is_kept, choice.worth()); });
  std::vector<Choice> taken;
  std::map<std::int32_t, std::vector<std::size_t>> through;
  for (Choice& choice : choices) {
    const std::vector<std::int32_t>& chain = choice.wire.vertices;
    std::map<std::size_t, std::size_t> contacts;
    for (const std::int32_t v : chain) {
      for (const std::size_t other : through[v]) ++contacts[other];
    }
    const bool meets_between = std::ranges::any_of(contacts, [&](const auto& contact) {
      return contact.second > common_at_ends(chain, taken[contact.first].wire.vertices);
    });
    if (meets_between && !choice.is_kept) continue;
    for (const std::int32_t v : chain) through[v].push_back(taken.size());
    taken.push_back(std::move(choice));
  }
  return taken;
}

}  // namespace seamwire
