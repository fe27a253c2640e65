// SPDX-License-Identifier: GPL-3.0-or-later
//
// Measures the gain and the cost of refining the corridor of a live wire, one line for each mesh and metric:
//   live_refinement_bench [--loop LEVELS] [--anisotropy A] [--max-error E] [--wires N] MESH...
//
// - Regret: how much longer a wire is than the shortest distance. The wire's length is integrated in the metric,
//   interpolated in each given face as an embedding does it. The distance comes from an embedding of the whole surface
//   with a max_error of 0.001.
//
// - Time on the clock from the request for a wire to a target until it is final, if the field is ready.
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <map>
#include <memory>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "mesh_input.hpp"
#include "seamwire/geodesics/exact_geodesics.hpp"
#include "seamwire/live/livewire.hpp"

namespace seamwire::bench {
namespace {

struct Options {
  int loop = 0, wires = 30;
  double anisotropy = 20.0, max_error = 0.01;
};

using Weights = std::array<double, 3>;

/// The norm of a vector at a point of a triangle whose corners have tensors: the triangle is cut into fours as an
/// embedding does it, then forms vary linearly.
double norm_at(std::array<TensorAt, 3> corners, Weights at, const Vector& e) {
  constexpr int kLevels = 4;
  for (int level = 0; level < kLevels; ++level) {
    const std::array middles{midpoint_tensor(corners[1], corners[2]), midpoint_tensor(corners[2], corners[0]),
                             midpoint_tensor(corners[0], corners[1])};
    const auto most = static_cast<std::size_t>(std::ranges::max_element(at) - at.begin());
    if (at[most] > 0.5) {
      for (std::size_t i = 0; i < 3; ++i) {
        if (i != most) corners[i] = middles[3 - i - most];
        at[i] = 2 * at[i] - (i == most ? 1 : 0);
      }
    } else {
      corners = middles;
      for (double& weight : at) weight = 1 - 2 * weight;
    }
  }
  double square = 0.0;
  for (std::size_t i = 0; i < 3; ++i) square += at[i] * std::pow(ambient_norm(corners[i], e), 2);
  return std::sqrt(std::max(square, 0.0));
}

Weights weights_in(const Surface& surface, std::int32_t face, const Vector& point) {
  const auto& [i, j, k] = surface.triangles()[static_cast<std::size_t>(face)];
  const auto at = [&](std::int32_t v) -> const Vector& { return surface.points()[static_cast<std::size_t>(v)]; };
  const Vector ab = at(j) - at(i), ac = at(k) - at(i), ap = point - at(i), normal = ab.cross(ac);
  const double area = normal.squaredNorm(), b = ap.cross(ac).dot(normal) / area, c = ab.cross(ap).dot(normal) / area;
  return {1 - b - c, b, c};
}

/// The length of a wire in the metric.
double integrated(const Surface& surface, const Metric& metric, const LiveCandidate& wire) {
  constexpr int kSamples = 16;
  double length = 0.0;
  for (std::size_t i = 0; i < wire.faces.size(); ++i) {
    const Vector step = 1.0 / kSamples * (wire.points[i + 1] - wire.points[i]);
    std::array<TensorAt, 3> corners;
    for (std::size_t c = 0; c < 3; ++c) {
      const auto v = static_cast<std::size_t>(surface.triangles()[static_cast<std::size_t>(wire.faces[i])][c]);
      corners[c] = {metric.normals[v], metric.tensors[v]};
    }
    for (int k = 0; k < kSamples; ++k) {
      const double t = (k + 0.5) / kSamples;
      const Vector point = (1 - t) * wire.points[i] + t * wire.points[i + 1];
      length += norm_at(corners, weights_in(surface, wire.faces[i], point), step);
    }
  }
  return length;
}

/// A surface in a metric, cut into fours in its planes: each edge at its middle.
std::pair<Surface, Metric> cut_into_fours(const Surface& surface, const Metric& metric) {
  std::vector<Vector> points = surface.points();
  Metric finer = metric;
  std::map<std::pair<std::int32_t, std::int32_t>, std::int32_t> middles;
  const auto middle = [&](std::int32_t a, std::int32_t b) {
    const auto [at, is_new] = middles.try_emplace(std::minmax(a, b), static_cast<std::int32_t>(points.size()));
    if (is_new) {
      const auto i = static_cast<std::size_t>(std::min(a, b)), j = static_cast<std::size_t>(std::max(a, b));
      points.emplace_back((points[i] + points[j]) / 2);
      const TensorAt between =
          midpoint_tensor({metric.normals[i], metric.tensors[i]}, {metric.normals[j], metric.tensors[j]});
      finer.normals.push_back(between.normal);
      finer.tensors.push_back(between.tensor);
    }
    return at->second;
  };
  std::vector<Triangle> triangles;
  for (const auto& [a, b, c] : surface.triangles()) {
    const std::int32_t ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
    for (const Triangle& part : {Triangle{a, ab, ca}, Triangle{ab, b, bc}, Triangle{ca, bc, c}, Triangle{ab, bc, ca}}) {
      triangles.push_back(part);
    }
  }
  return {Surface(std::move(points), std::move(triangles)), std::move(finer)};
}

/// The solver for the distances that regrets are measured against.
ExactGeodesics reference_of(const Surface& surface, const Metric& metric) {
  const auto once = cut_into_fours(surface, metric);
  const auto [finest, finest_metric] = cut_into_fours(once.first, once.second);
  return ExactGeodesics(embed(finest, finest_metric, {.max_faces_added = 8'000'000, .max_error = 0.01}).mesh);
}

const LiveCandidate& of(const LiveWires& found, Follow follow) {
  return *std::ranges::find_if(found.wires, [&](const LiveCandidate& wire) { return wire.metric.follow == follow; });
}

/// Asks until the wire is final.
LiveWires final_wires(const LiveWire& live, std::int32_t target) {
  LiveWires found = live.wires({target});
  while (!found.final()) {
    live.wait();
    found = live.wires({target});
  }
  return found;
}

/// Regrets and seconds of the wires in one metric, without and with refinement.
struct Series {
  std::array<std::vector<double>, 2> regrets;
  std::array<std::vector<double>, 2> clock;
};

void print(const std::string& name, Follow follow, std::size_t faces, const Series& series) {
  std::printf("%-24s %s %8zu faces  regret median %.2f -> %.2f %%, 90%% %.2f -> %.2f %%  all final %.1f -> %.1f ms\n",
              name.c_str(), follow == Follow::kMin ? "M_min" : "M_max", faces, 100 * median(series.regrets[0]),
              100 * median(series.regrets[1]), 100 * quantile(series.regrets[0], 0.9),
              100 * quantile(series.regrets[1], 0.9), 1e3 * median(series.clock[0]), 1e3 * median(series.clock[1]));
  std::fflush(stdout);
}

void measure(const std::string& file, const Options& options) {
  const auto surface = std::make_shared<const Surface>(read_surface(file, options.loop));
  const Strength strength{.max_anisotropy = options.anisotropy, .clamp_percentile = 99.0};
  const Curvature curvature = principal_curvatures(*surface);
  LiveWire plain(surface, {.metrics = live_metrics(MetricFamily::kFeature, strength), .max_error = 0.0});
  LiveWire refining(surface,
                    {.metrics = live_metrics(MetricFamily::kFeature, strength), .max_error = options.max_error});
  std::array<LiveWire*, 2> lives{&plain, &refining};
  std::mt19937 random(1);
  std::uniform_int_distribution<std::int32_t> any(0, static_cast<std::int32_t>(surface->vertex_count()) - 1);
  constexpr std::array kFollows{Follow::kMin, Follow::kMax};
  std::array<Series, 2> series;
  std::vector<Metric> metrics;
  std::vector<ExactGeodesics> references;
  for (const Follow follow : kFollows) {
    metrics.push_back(feature_metric(*surface, curvature, follow, strength));
    references.push_back(reference_of(*surface, metrics.back()));
  }
  for (int i = 0; i < options.wires; i += 10) {
    const std::int32_t seed = any(random);
    std::vector<DistanceField> fields;
    for (const ExactGeodesics& reference : references) fields.push_back(reference.solve(seed));
    for (LiveWire* live : lives) {
      live->seed({seed});
      live->wait();
    }
    for (int k = 0; k < std::min(10, options.wires - i); ++k) {
      const std::int32_t target = any(random);
      for (std::size_t l = 0; l < 2; ++l) {
        const auto start = std::chrono::steady_clock::now();
        const LiveWires found = final_wires(*lives[l], target);
        const double clock = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
        for (std::size_t m = 0; m < 2; ++m) {
          const double distance = fields[m].distances()[static_cast<std::size_t>(target)];
          const double length = integrated(*surface, metrics[m], of(found, kFollows[m]));
          if (distance > 0) series[m].regrets[l].push_back(length / distance - 1);
          series[m].clock[l].push_back(clock);
        }
      }
    }
  }
  for (std::size_t m = 0; m < 2; ++m)
    print(mesh_name(file, options.loop), kFollows[m], surface->face_count(), series[m]);
}

int measure_all(int argc, char** argv) {
  Options options;
  return run(argc, argv,
             {{"--loop", set_count(options.loop, 0)},
              {"--wires", set_count(options.wires, 1)},
              {"--anisotropy", set_number(options.anisotropy)},
              {"--max-error", set_number(options.max_error)}},
             [&](const std::string& mesh) { measure(mesh, options); });
}

}  // namespace
}  // namespace seamwire::bench

int main(int argc, char** argv) { return seamwire::bench::measure_all(argc, argv); }
