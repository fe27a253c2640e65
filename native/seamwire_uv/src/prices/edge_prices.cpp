// SPDX-License-Identifier: GPL-3.0-or-later
#include "prices/edge_prices.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>

#include "detail/index.hpp"
#include "detail/poll.hpp"
#include "detail/rounded.hpp"
#include "detail/run_on_threads.hpp"
#include "prices/border_odds.hpp"
#include "seamwire/surface/ray_tree.hpp"
#include "tuning/constants.hpp"

namespace seamwire::detail {
namespace {

constexpr std::size_t kBlock = 256;

/// Point i of `count` on a hemisphere around `axis`, spread evenly (Fibonacci spiral).
Vector on_hemisphere(int i, int count, const Vector& axis) {
  const double height = 1.0 - (i + 0.5) / count, turn = i * std::numbers::pi * (3.0 - std::sqrt(5.0));
  const Vector x = axis.unitOrthogonal(), y = axis.cross(x);
  return std::sqrt(1.0 - height * height) * (std::cos(turn) * x + std::sin(turn) * y) + height * axis;
}

/// The same with a density that is proportional to the cosine of the angle to the axis. `x`: a unit vector across the
/// axis, from which the directions are counted.
Vector by_cosine(int i, int count, const Vector& axis, const Vector& x) {
  // No ray has the direction of x or runs across it, where it could lie in the plane of a triangle.
  const double radius = std::sqrt((i + 0.5) / count), turn = (i + 0.5) * std::numbers::pi * (3.0 - std::sqrt(5.0));
  const Vector y = axis.cross(x);
  return radius * (std::cos(turn) * x + std::sin(turn) * y) + std::sqrt(std::max(1.0 - radius * radius, 0.0)) * axis;
}

}  // namespace

std::vector<std::int32_t> nearest_of(const PlanMesh& mesh, std::span<const std::int32_t> vertices, const Task& task) {
  std::vector<std::int32_t> nearest(mesh.vertex_count(), -1);
  std::vector<std::int32_t> open;
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    nearest[vertices[i]] = static_cast<std::int32_t>(i);
    open.push_back(vertices[i]);
  }
  const Poll poll(task);
  for (std::size_t i = 0; i < open.size(); ++i) {
    poll.at(i);
    for (const PlanNeighbor& next : mesh.all_neighbors[open[i]]) {
      if (nearest[next.vertex] >= 0) continue;
      nearest[next.vertex] = nearest[open[i]];
      open.push_back(next.vertex);
    }
  }
  return nearest;
}

Visibility find_visibility(const PlanMesh& mesh, const std::optional<Vector>& front, const Task& task,
                           std::span<const double> sizes, std::size_t most) {
  constexpr double kAbove = 2e-3;  // start this far above a part of area 1, to miss the faces around the vertex
  const RayTree rays(mesh.points, mesh.triangles);
  rays.wait(task);
  const std::vector<Vector> normals = vertex_normals(mesh, face_frames(mesh, task), task);
  // Rays are counted from an edge of the mesh, so that they turn with it.
  std::vector<std::int32_t> beside(mesh.vertex_count(), -1);
  for (const Triangle& t : mesh.triangles) {
    for (std::size_t i = 0; i < 3; ++i) {
      if (beside[t[i]] < 0) beside[t[i]] = t[(i + 1) % 3];
    }
  }
  std::vector<Vector> views;
  for (int i = 0; front && i < tuning::kViews; ++i) {
    views.push_back(on_hemisphere(i, tuning::kViews, front->stableNormalized()));
  }
  Visibility found;
  found.ambient.assign(mesh.vertex_count(), 1.0);
  if (front) found.front.assign(mesh.vertex_count(), 1.0);
  const auto look = [&](std::size_t v) {
    const Vector& normal = normals[v];
    if (normal.isZero()) return;
    const Vector origin = mesh.points[v] + kAbove * (sizes.empty() ? 1.0 : sizes[v]) * normal;
    const auto is_free = [&](const Vector& direction) {
      return direction.dot(normal) > 0.0 && !rays.is_met(origin, direction);
    };
    const Vector along = mesh.points[beside[v]] - mesh.points[v];
    Vector across = along - along.dot(normal) * normal;
    across = across.squaredNorm() > 1e-12 * along.squaredNorm() ? Vector(across.normalized()) : normal.unitOrthogonal();
    int seen = 0;
    for (int i = 0; i < tuning::kSkyRays; ++i) seen += is_free(by_cosine(i, tuning::kSkyRays, normal, across)) ? 1 : 0;
    found.ambient[v] = static_cast<double>(seen) / tuning::kSkyRays;
    if (!front) return;
    const auto views_that_see = std::ranges::count_if(views, is_free);
    found.front[v] = static_cast<double>(views_that_see) / tuning::kViews;
  };
  std::vector<std::int32_t> chosen;
  const std::size_t step = (mesh.vertex_count() - 1) / std::max<std::size_t>(most, 1) + 1;
  for (std::size_t v = 0; v < mesh.vertex_count(); v += step) chosen.push_back(static_cast<std::int32_t>(v));
  const std::size_t blocks = (chosen.size() + kBlock - 1) / kBlock;
  run_on_threads(
      blocks, task, [&](std::size_t done) { return static_cast<double>(done) / static_cast<double>(blocks); },
      [&](std::size_t block, const Task& own) {
        own.check(0.0);
        const std::size_t end = std::min(chosen.size(), (block + 1) * kBlock);
        for (std::size_t i = block * kBlock; i < end; ++i) look(index(chosen[i]));
      });
  if (step == 1) return found;
  const std::vector<std::int32_t> nearest = nearest_of(mesh, chosen, task);
  for (std::vector<double>* values : {&found.front, &found.ambient}) {
    for (std::size_t v = 0; v < values->size(); ++v) {
      if (nearest[v] >= 0) (*values)[v] = (*values)[chosen[nearest[v]]];
    }
  }
  return found;
}

namespace {

/// Values divided by their mean over the area.
std::vector<double> normalized(std::vector<double> values, std::span<const double> areas) {
  double sum = 0.0, total = 0.0;
  for (std::size_t v = 0; v < values.size(); ++v) {
    sum += areas[v] * values[v];
    total += areas[v];
  }
  const double mean = total > 0.0 ? sum / total : 0.0;
  for (double& value : values) value = mean > 0.0 ? value / mean : 1.0;
  return values;
}

}  // namespace

std::vector<double> openness(const PlanMesh& mesh, const Visibility& visibility,
                             const std::optional<Reflection>& reflection, std::span<const FaceFrame> frames) {
  const std::vector<double> areas = vertex_areas(mesh, frames);
  std::vector<double> open = normalized(visibility.ambient, areas);
  if (!visibility.front.empty()) {
    const std::vector<double> front = normalized(visibility.front, areas);
    for (std::size_t v = 0; v < open.size(); ++v) {
      open[v] = tuning::kFrontShare * front[v] + (1.0 - tuning::kFrontShare) * open[v];
    }
  }
  if (!reflection) return open;
  std::vector<double> both = open;
  for (std::size_t v = 0; v < open.size(); ++v) {
    const std::int32_t image = reflection->images[v];
    if (image >= 0) both[v] = 0.5 * (open[v] + open[image]);
  }
  return both;
}

namespace {

/// The price of a place, by its visibility.
double price_at(double open) {
  const double seen = tuning::kHidden + (1.0 - tuning::kHidden) * std::pow(open, 3);
  return open >= tuning::kExposed ? tuning::kExposedPrice * seen : seen;
}

/// The price of a seam along each edge for its length, by the shape of the surface. It is 1 in a flat place.
std::vector<double> shape_prices(const PlanMesh& mesh, const EdgeBends& bends, std::span<const double> odds,
                                 const Task& task) {
  const auto middle = [&](std::int32_t h) {
    const auto& [a, b, c] = mesh.triangles[h / 3];
    return Vector((mesh.points[a] + mesh.points[b] + mesh.points[c]) / 3.0);
  };
  std::vector<double> prices;
  const Poll poll(task);
  for (std::int32_t e = 0; index(e) < mesh.edge_count(); ++e) {
    poll.at(index(e));
    const std::int32_t h = mesh.half_edge_of[e], twin = mesh.twins[h];
    const double width = twin < 0 ? 0.0 : rounded((middle(twin) - middle(h)).norm());
    const double curvature = width > 0.0 ? std::abs(bends.own[e]) * std::numbers::pi / 180.0 / width : 0.0;
    const double ridge = 1.0 - tuning::kRidgeSaving * std::clamp(curvature / tuning::kRidgeCurvature, 0.0, 1.0);
    prices.push_back(ridge * price_of_cut(std::max(odds[e], tuning::kFlatOdds)) / price_of_cut(tuning::kFlatOdds));
  }
  return prices;
}

/// Whether most edges of a surface hardly bend, by length. On a low-poly animal most edges bend more.
bool is_mostly_flat(const PlanMesh& mesh, const EdgeBends& bends) {
  double flat = 0.0, length = 0.0;
  for (std::size_t e = 0; e < mesh.edge_count(); ++e) {
    length += mesh.lengths[e];
    if (std::abs(bends.own[e]) < tuning::kFlatDegrees) flat += mesh.lengths[e];
  }
  return 2.0 * flat > length;
}

}  // namespace

EdgePrices find_prices(const PlanMesh& mesh, const Visibility& visibility, const std::optional<Reflection>& reflection,
                       std::span<const double> weights, const Task& task) {
  const std::vector<FaceFrame> frames = face_frames(mesh, task);
  EdgePrices prices{.of_edge = {}, .visibility = openness(mesh, visibility, reflection, frames), .is_exposed = {}};
  for (double& open : prices.visibility) open = rounded(open);
  const Polygons polygons = find_polygons(mesh, {}, task);
  const PieceSizes sizes = measure_pieces(mesh, frames, task);
  const EdgeBends bends = bends_over_edges(mesh, frames, polygons, sizes, task);
  // Openness is in the price of a place, so it must not count twice.
  const std::vector<double> even(mesh.vertex_count(), 1.0);
  const std::vector<std::uint8_t> none(mesh.edge_count(), 0);
  const std::vector<double> odds = border_odds(mesh, polygons, sizes, bends, even, none,
                                               reflection ? &*reflection : nullptr, tuning::kSlitOnPlane, task);
  const std::vector<double> shapes = shape_prices(mesh, bends, odds, task);
  // On machine parts sharp edges hide seams on every side, and seams may run through exposed places.
  prices.is_machine_part = sharp_share(mesh, bends) > tuning::kMostSharp && is_mostly_flat(mesh, bends);
  for (const double open : prices.visibility) {
    prices.is_exposed.push_back(open >= tuning::kExposed && !prices.is_machine_part ? 1 : 0);
  }
  double sum = 0.0, length = 0.0;
  const Poll poll(task);
  for (std::int32_t e = 0; index(e) < mesh.edge_count(); ++e) {
    poll.at(index(e));
    const std::int32_t a = mesh.tail(mesh.half_edge_of[e]), b = mesh.tip(mesh.half_edge_of[e]);
    const bool hides_seam = prices.is_machine_part && std::abs(bends.own[e]) > tuning::kSharpDegrees;
    const double seen = hides_seam ? 1.0 : 0.5 * (price_at(prices.visibility[a]) + price_at(prices.visibility[b]));
    const double weight = weights.empty() ? 1.0 : 0.5 * (weights[a] + weights[b]);
    const double price = mesh.lengths[e] * seen * shapes[e] * weight;
    prices.of_edge.push_back(mesh.is_real[e] == 0 || !std::isfinite(price) ? kInfinity : price);
    if (prices.of_edge.back() == kInfinity) continue;
    sum += price;
    length += mesh.lengths[e];
  }
  if (reflection && reflection->is_exact) {
    const std::vector<double> own = prices.of_edge;
    for (std::int32_t e = 0; index(e) < mesh.edge_count(); ++e) {
      poll.at(index(e));
      const std::int32_t image = image_of_edge(mesh, *reflection, e);
      if (image < 0) continue;
      const bool is_barred = own[e] == kInfinity || own[image] == kInfinity;
      prices.of_edge[e] = is_barred ? kInfinity : std::sqrt(own[e] * own[image]);
    }
  }
  prices.turning = length > 0.0 ? tuning::kTurnPrice * mesh.median_length * sum / length : 0.0;
  return prices;
}

}  // namespace seamwire::detail
