// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "detail/poll.hpp"
#include "detail/text.hpp"
#include "metric/curvature_form.hpp"
#include "metric/tangent_frame.hpp"
#include "seamwire/errors.hpp"
#include "seamwire/metric/curvature.hpp"
#include "surface/corner_fans.hpp"
#include "surface/exact_unit.hpp"

namespace seamwire {

using namespace detail;

namespace {

constexpr double kMostRounds = 400;

// A side of faces between two of the caller's vertices, and what turns forms from the one's frame into the other's: the
// cosine and sine of twice the angle.
struct Side {
  std::int32_t a, b;
  double c, s;
};

Form turned(const Form& form, double c, double s) {
  return {.mean = form.mean,
          .difference = c * form.difference - s * form.mixed,
          .mixed = c * form.mixed + s * form.difference};
}

struct Neighborhood {
  std::vector<TangentFrame> frames;
  std::vector<double> areas;  // a third of those of the faces around
  std::vector<Side> sides;    // but for those where one has no normal, or the normals are opposite
  double median_side = 0.0;   // 0 where there is none
};

Neighborhood neighborhood(const Surface& surface, const std::vector<Vector>& normals, const Task& task) {
  Neighborhood out;
  out.frames.reserve(normals.size());
  for (const Vector& normal : normals) out.frames.push_back(fast_tangent_frame(normal));
  out.areas.assign(normals.size(), 0.0);
  const std::vector<Triangle>& faces = corner_fans(surface).triangles;
  const std::vector<std::int32_t>& twins = corner_fans(surface).twins;
  std::vector<double> lengths;
  out.sides.reserve(twins.size() / 2 + 1);
  lengths.reserve(twins.size() / 2 + 1);
  const Poll poll(task, 0.0, 0.2, faces.size());
  for (std::size_t f = 0; f < faces.size(); ++f) {
    poll.at(f);
    Triangle corners;
    for (std::size_t i = 0; i < 3; ++i) corners[i] = corner_fans(surface).vertices[faces[f][i]];
    const auto point = [&](std::size_t i) -> const Vector& { return surface.points()[corners[i]]; };
    const double scale = surface.scale(), unit = exact_unit(surface), units = scale / unit;
    const Vector one = unit * (point(1) - point(0)), two = unit * (point(2) - point(0));
    const double area = units * units * one.cross(two).norm() / 6.0;
    for (const std::int32_t v : corners) out.areas[v] += area;
    for (std::size_t i = 0; i < 3; ++i) {
      const auto half_edge = static_cast<std::int32_t>(3 * f + i);
      if (twins[half_edge] != -1 && twins[half_edge] < half_edge) continue;
      const std::size_t j = (i + 1) % 3;
      const std::int32_t a = corners[i], b = corners[j];
      lengths.push_back(units * (unit * (point(j) - point(i))).norm());
      const Vector &from = normals[a], &to = normals[b];
      if (from.isZero(0.0) || to.isZero(0.0) || 1.0 + from.dot(to) < kOppositeNormals) continue;
      const Vector u = turned_by_least_rotation(out.frames[a].u, from, to);
      const double x = u.dot(out.frames[b].u), y = u.dot(out.frames[b].v());
      out.sides.push_back({.a = a, .b = b, .c = x * x - y * y, .s = 2.0 * x * y});
    }
  }
  if (!lengths.empty()) {
    const auto middle = lengths.begin() + static_cast<std::ptrdiff_t>(lengths.size() / 2);
    std::nth_element(lengths.begin(), middle, lengths.end());
    out.median_side = *middle;
  }
  return out;
}

}  // namespace

Curvature smoothed_curvatures(const Surface& surface, const Curvature& curvature, double radius, const Task& task) {
  const std::size_t count = surface.vertex_count();
  if (curvature.k1.size() != count || curvature.k2.size() != count || curvature.d1.size() != count ||
      curvature.normals.size() != count) {
    throw InvalidInput("curvature of " + std::to_string(curvature.k1.size()) + " vertices for a surface of " +
                       std::to_string(count));
  }
  if (!(std::isfinite(radius) && radius > 0.0)) {
    throw InvalidInput("radius is " + text(radius) + ", not a finite number above 0");
  }
  const Neighborhood near = neighborhood(surface, curvature.normals, task);
  if (near.median_side == 0.0) return curvature;
  std::vector<Form> forms(count);
  std::vector<double> weights = near.areas;
  for (const Side& side : near.sides) {
    weights[side.a] += near.areas[side.b];
    weights[side.b] += near.areas[side.a];
  }
  for (std::size_t v = 0; v < count; ++v) {
    const TangentFrame& frame = near.frames[v];
    const double x = curvature.d1[v].dot(frame.u), y = curvature.d1[v].dot(frame.v());
    const double half = 0.5 * (curvature.k1[v] - curvature.k2[v]);
    forms[v] = {.mean = 0.5 * (curvature.k1[v] + curvature.k2[v]),
                .difference = half * (x * x - y * y),
                .mixed = half * 2.0 * x * y};
  }
  const double wanted = std::round(radius * radius / (near.median_side * near.median_side));
  const auto rounds = static_cast<std::size_t>(std::clamp(wanted, 1.0, kMostRounds));
  std::vector<Form> sums(count);
  Poll poll(task, 0.2, 1.0, rounds * (near.sides.size() + count));
  const auto add = [](Form& sum, const Form& form, double weight) {
    sum.mean += weight * form.mean;
    sum.difference += weight * form.difference;
    sum.mixed += weight * form.mixed;
  };
  for (std::size_t round = 0; round < rounds; ++round) {
    for (std::size_t v = 0; v < count; ++v) {
      poll.next();
      sums[v] = {};
      add(sums[v], forms[v], near.areas[v]);
    }
    for (const auto& [a, b, c, s] : near.sides) {
      poll.next();
      add(sums[b], turned(forms[a], c, s), near.areas[a]);
      add(sums[a], turned(forms[b], c, -s), near.areas[b]);
    }
    for (std::size_t v = 0; v < count; ++v) {
      if (!(weights[v] > 0.0)) continue;
      forms[v] = {};
      add(forms[v], sums[v], 1.0 / weights[v]);
    }
  }
  Curvature smoothed = curvature;
  for (std::size_t v = 0; v < count; ++v) {
    if (!curvature.normals[v].isZero(0.0)) decompose(near.frames[v], forms[v], v, smoothed);
  }
  return smoothed;
}

}  // namespace seamwire
