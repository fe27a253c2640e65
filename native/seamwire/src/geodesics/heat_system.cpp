// SPDX-License-Identifier: GPL-3.0-or-later
//
// Crane, Weischedel and Wardetzky 2013, "Geodesics in Heat". M is the mass matrix, L the stiffness matrix of linear
// finite elements, and t the time. Three steps find the distance d:
//   (M + t L) u = heat at the sources
//   X = -grad u / |grad u|
//   L d = the integrals of X times the gradients of the hat functions
#include "geodesics/heat_system.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "detail/csr.hpp"
#include "detail/half_edge.hpp"
#include "detail/index.hpp"
#include "detail/infinity.hpp"
#include "detail/poll.hpp"
#include "geodesics/intrinsic_delaunay.hpp"
#include "geodesics/triangle_area.hpp"
#include "graph/disjoint_sets.hpp"
#include "graph/shortest_paths.hpp"
#include "seamwire/errors.hpp"

namespace seamwire::detail {
namespace {

/// Loose edges at most as long, in mean edges, join their ends. Triangles have no shorter sides either.
constexpr double kSamePlace = 1e-5;
/// Heat at the sources: 2 to this power. It leaves room for products with lengths.
constexpr int kHeatExponent = 900;
/// Heat falls by a factor of e within the root of the time. It is above the smallest number, 2^-1022, within this many
/// roots of the sources.
constexpr double kMostRoots = 1300.0;

template <class T>
void release(std::vector<T>& vector) {
  vector = std::vector<T>();
}

}  // namespace

HeatSystem::HeatSystem(const IntrinsicMesh& mesh, const Task& task) {
  IntrinsicMesh delaunay = intrinsic_delaunay(mesh, part_of(task, 0.0, 0.3));
  double sum = std::accumulate(delaunay.lengths.begin(), delaunay.lengths.end(), 0.0);
  std::size_t count = delaunay.lengths.size();
  if (count == 0) {
    for (const LooseEdge& edge : mesh.loose_edges) sum += edge.length;
    count = mesh.loose_edges.size();
  }
  if (sum > 0) unit_ = sum / static_cast<double>(count);
  number_unknowns(mesh, unit_);

  std::vector<std::array<std::int32_t, 2>> edges;
  edges.reserve(delaunay.lengths.size() / 2 + strips_.size());
  faces_.reserve(delaunay.triangles.size());
  const Poll poll(task, 0.3, 0.35, delaunay.triangles.size());
  for (std::size_t f = 0; f < delaunay.triangles.size(); ++f) {
    poll.at(f);
    const double *lengths = &delaunay.lengths[3 * f], a = lengths[0] / unit_, b = lengths[1] / unit_,
                 c = lengths[2] / unit_;
    Face face{.unknowns = {}, .base = a, .x = (a * a + c * c - b * b) / (2 * a), .y = four_areas(a, b, c) / (2 * a)};
    for (std::size_t i = 0; i < 3; ++i) face.unknowns[i] = unknown_of_[delaunay.triangles[f][i]];
    faces_.push_back(face);
    for (std::size_t i = 0; i < 3; ++i) {
      const std::int32_t one = face.unknowns[i], other = face.unknowns[(i + 1) % 3];
      if (one != other && delaunay.twins[3 * f + i] < static_cast<std::int32_t>(3 * f + i)) {
        edges.push_back({one, other});
      }
    }
  }
  release(delaunay.lengths);
  release(delaunay.twins);
  release(delaunay.triangles);
  for (const Strip& strip : strips_) edges.push_back({strip.a, strip.b});
  find_components();
  const double time = diffusion_time(part_of(task, 0.35, 0.4));
  heat_.emplace(unknown_count_, edges, part_of(task, 0.4, 0.6));
  release(edges);
  poisson_ = heat_;
  fill(time, part_of(task, 0.6, 0.6));
  if (!heat_->factor(part_of(task, 0.6, 0.8)) || !poisson_->factor(part_of(task, 0.8, 1.0))) {
    throw InvalidInput("the heat method cannot solve its equations: lengths of the mesh differ too much");
  }
}

void HeatSystem::number_unknowns(const IntrinsicMesh& mesh, double mean) {
  DisjointSets same(index(mesh.vertex_count));
  for (const LooseEdge& edge : mesh.loose_edges) {
    if (edge.length <= kSamePlace * mean) same.join(edge.a, edge.b);
  }
  DisjointSets::Numbering numbering = same.numbering();
  unknown_of_ = std::move(numbering.of);
  unknown_count_ = index(numbering.count);
  for (const LooseEdge& edge : mesh.loose_edges) {
    const std::int32_t a = unknown_of_[edge.a], b = unknown_of_[edge.b];
    if (a != b) strips_.push_back({a, b, edge.length / mean});
  }
}

void HeatSystem::find_components() {
  DisjointSets joined(unknown_count_);
  for (const Face& face : faces_) {
    joined.join(face.unknowns[0], face.unknowns[1]);
    joined.join(face.unknowns[1], face.unknowns[2]);
  }
  for (const Strip& strip : strips_) joined.join(strip.a, strip.b);
  DisjointSets::Numbering numbering = joined.numbering();
  component_of_ = std::move(numbering.of);
  pinned_.assign(index(numbering.count), -1);
  for (std::int32_t i = 0; index(i) < unknown_count_; ++i) {
    if (std::int32_t& pinned = pinned_[component_of_[i]]; pinned < 0) pinned = i;
  }
}

/// The time of the method: the square of the mean edge, or as much more as a wide mesh needs, so that some heat arrives
/// everywhere.
double HeatSystem::diffusion_time(const Task& task) const {
  struct Way {
    std::int32_t to;
    double length;
  };
  const Csr<Way> ways(unknown_count_, [&](const auto& visit) {
    const auto both = [&](std::int32_t a, std::int32_t b, double length) {
      visit(a, {b, length});
      visit(b, {a, length});
    };
    for (const Face& face : faces_) {
      const auto [a, b, c] = face.unknowns;
      both(a, b, face.base);
      both(b, c, std::hypot(face.x - face.base, face.y));
      both(c, a, std::hypot(face.x, face.y));
    }
    for (const Strip& strip : strips_) both(strip.a, strip.b, strip.length);
  });
  task.check(0.0);
  std::vector<double> least(unknown_count_, kInfinity);
  double farthest = 0.0;
  Poll poll(task, 0.0, 1.0, unknown_count_);
  find_shortest_paths(pinned_, least, [&](std::int32_t at, const auto& step) {
    poll.next();
    farthest = std::max(farthest, least[at]);
    for (const auto& [to, length] : ways[at]) step(to, length);
  });
  const double root = std::max(1.0, 2 * farthest / kMostRoots);
  return root * root;
}

void HeatSystem::fill(double time, const Task& task) {
  std::vector<double> heat_diagonal(unknown_count_, 0.0), poisson_diagonal(unknown_count_, 0.0);
  const auto is_pinned = [&](std::int32_t i) { return pinned_[component_of_[i]] == i; };
  const auto conduct = [&](std::int32_t a, std::int32_t b, double weight) {
    if (a == b) return;
    heat_->add(a, b, -time * weight);
    if (!is_pinned(a) && !is_pinned(b)) poisson_->add(a, b, -weight);
    for (const std::int32_t i : {a, b}) {
      heat_diagonal[i] += time * weight;
      poisson_diagonal[i] += weight;
    }
  };
  const Poll poll(task, 0.0, 1.0, faces_.size());
  for (std::size_t f = 0; f < faces_.size(); ++f) {
    poll.at(f);
    const auto& [unknowns, base, x, y] = faces_[f];
    // Half the cotangents of the angles at the three corners.
    conduct(unknowns[1], unknowns[2], x / (2 * y));
    conduct(unknowns[2], unknowns[0], (base - x) / (2 * y));
    conduct(unknowns[0], unknowns[1], (y * y - x * (base - x)) / (2 * base * y));
    for (const std::int32_t i : unknowns) heat_diagonal[i] += base * y / 6;
  }
  for (const auto& [a, b, length] : strips_) {
    conduct(a, b, 1 / length);
    heat_diagonal[a] += length / 2;
    heat_diagonal[b] += length / 2;
  }
  for (std::int32_t i = 0; index(i) < unknown_count_; ++i) {
    heat_->add(i, i, heat_diagonal[i] > 0 ? heat_diagonal[i] : 1.0);
    poisson_->add(i, i, is_pinned(i) ? 1.0 : poisson_diagonal[i]);
  }
}

std::vector<double> HeatSystem::divergence(const std::vector<double>& heat, const Task& task) const {
  std::vector<double> out(unknown_count_, 0.0);
  const Poll poll(task, 0.0, 1.0, faces_.size());
  for (std::size_t f = 0; f < faces_.size(); ++f) {
    poll.at(f);
    const auto& [unknowns, base, x, y] = faces_[f];
    // Far from the sources, heat is so little that products of it would vanish.
    const double most = std::max({heat[unknowns[0]], heat[unknowns[1]], heat[unknowns[2]]});
    if (!(most > 0)) continue;
    const double u0 = heat[unknowns[0]] / most, u1 = heat[unknowns[1]] / most, u2 = heat[unknowns[2]] / most;
    const double gx = (u1 - u0) / base, gy = (u2 - u0 - x * gx) / y, norm = std::hypot(gx, gy);
    if (!(norm > 0)) continue;
    const double dx = -gx / norm * y / 2, dy = -gy / norm / 2;
    const double at1 = dx - dy * x, at2 = dy * base;
    out[unknowns[0]] -= at1 + at2;
    out[unknowns[1]] += at1;
    out[unknowns[2]] += at2;
  }
  for (const auto& [a, b, length] : strips_) {
    if (heat[a] == heat[b]) continue;
    const double along = heat[a] > heat[b] ? 1.0 : -1.0;
    out[a] -= along;
    out[b] += along;
  }
  for (const std::int32_t i : pinned_) out[i] = 0.0;
  return out;
}

std::vector<double> HeatSystem::distances(std::span<const HeatSource> sources, const Task& task) const {
  std::vector<double> heat(unknown_count_, 0.0);
  for (const HeatSource& source : sources) {
    for (std::size_t i = 0; i < 3; ++i) {
      if (source.weights[i] > 0) heat[unknown_of_[source.vertices[i]]] += std::ldexp(source.weights[i], kHeatExponent);
    }
  }
  heat_->solve(heat, part_of(task, 0.0, 0.4));
  std::vector<double> potential = divergence(heat, part_of(task, 0.4, 0.5));
  poisson_->solve(potential, part_of(task, 0.5, 0.9));
  task.check(0.9);
  // The potential is known up to a constant for each component. The nearest source fixes it.
  std::vector<double> shift(pinned_.size(), kInfinity);
  for (const HeatSource& source : sources) {
    double at_source = 0.0;
    std::int32_t component = -1;
    for (std::size_t i = 0; i < 3; ++i) {
      if (!(source.weights[i] > 0)) continue;
      const std::int32_t unknown = unknown_of_[source.vertices[i]];
      component = component_of_[unknown];
      at_source += source.weights[i] * (potential[unknown] - source.distances[i] / unit_);
    }
    shift[component] = std::min(shift[component], at_source);
  }
  std::vector<double> distances(unknown_of_.size());
  for (std::size_t v = 0; v < distances.size(); ++v) {
    const std::int32_t unknown = unknown_of_[v];
    const double lowest = shift[component_of_[unknown]];
    distances[v] = lowest == kInfinity ? kInfinity : unit_ * std::max(potential[unknown] - lowest, 0.0);
  }
  // Around a source in a face, straight lines in the face are better, unless another source is nearer. They are exact
  // except where a vertex has so small an angle that a way around it is shorter.
  for (const HeatSource& source : sources) {
    for (std::size_t i = 0; i < 3; ++i) {
      const std::int32_t v = source.vertices[i];
      if (v < 0) continue;
      const bool is_only_one = sources.size() == 1;
      distances[v] = is_only_one ? source.distances[i] : std::min(distances[v], source.distances[i]);
    }
  }
  task.check(1.0);
  return distances;
}

}  // namespace seamwire::detail
