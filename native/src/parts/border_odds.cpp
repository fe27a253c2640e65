// SPDX-License-Identifier: GPL-3.0-or-later
#include "parts/border_odds.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <numbers>

#include "detail/index.hpp"
#include "seams/visibility.hpp"

namespace seamwire::detail {
namespace {

double knob(int i, double value) {
  static const std::vector<double> set = [] {
    std::vector<double> v;
    if (const char* s = std::getenv("PARTS_KNOBS")) {
      char* end = nullptr;
      for (;;) {
        const double x = std::strtod(s, &end);
        if (end == s) break;
        v.push_back(x);
        s = *end == ',' ? end + 1 : end;
      }
    }
    return v;
  }();
  return index(i) < set.size() && set[index(i)] > -900 ? set[index(i)] : value;
}


/// How the surface bends over each edge.
struct Bends {
  std::vector<double> degrees;  ///< between the normals on both sides; negative where concave
  std::vector<double> wide;     ///< the same between the surface at some distance on both sides, not negative
};

class BendFinder {
 public:
  BendFinder(const PlanMesh& mesh, std::span<const FaceFrame> frames) : mesh_(mesh), frames_(frames) {}

  double degrees(std::int32_t e) const {
    const std::int32_t h = mesh_.half_edge_of[e], twin = mesh_.twins[h];
    const Vector &one = frames_[h / 3].normal, &other = frames_[twin / 3].normal;
    const double angle = 180.0 / std::numbers::pi * std::atan2(one.cross(other).norm(), one.dot(other));
    const Vector along = mesh_.points[mesh_.end(h)] - mesh_.points[mesh_.start(h)];
    return one.cross(other).dot(along) < 0.0 ? -angle : angle;
  }

  /// Between the normals of the faces that one reaches by going straight away from an edge on both sides.
  double wide_degrees(std::int32_t e, double distance) const {
    const std::int32_t h = mesh_.half_edge_of[e], twin = mesh_.twins[h];
    const Vector one = normal_at(h, distance), other = normal_at(twin, distance);
    return 180.0 / std::numbers::pi * std::atan2(one.cross(other).norm(), one.dot(other));
  }

 private:
  /// The normal at a distance from the middle of a half-edge, in the plane across it.
  Vector normal_at(std::int32_t h, double distance) const {
    const Vector across = (mesh_.points[mesh_.end(h)] - mesh_.points[mesh_.start(h)]).normalized();
    Vector at = 0.5 * (mesh_.points[mesh_.end(h)] + mesh_.points[mesh_.start(h)]);
    const Vector middle = at;
    const auto height = [&](std::int32_t v) { return (mesh_.points[v] - middle).dot(across); };
    constexpr int kMostTriangles = 64;
    double gone = 0.0;
    for (int i = 0; i < kMostTriangles; ++i) {
      const std::int32_t first = 3 * (h / 3), k = h % 3;
      const std::int32_t tip = mesh_.triangles[h / 3][(k + 2) % 3];
      // Leave through the side whose ends lie on both sides of the plane.
      const double own = height(tip);
      const double end = height(mesh_.end(h));
      const bool is_next = (own > 0.0) != (end > 0.0);
      const std::int32_t side = first + (is_next ? (k + 1) % 3 : (k + 2) % 3);
      const double a = height(mesh_.start(side)), b = height(mesh_.end(side));
      const double t = a != b ? std::clamp(a / (a - b), 0.0, 1.0) : 0.5;
      const Vector to = mesh_.points[mesh_.start(side)] + t * (mesh_.points[mesh_.end(side)] - mesh_.points[mesh_.start(side)]);
      gone += (to - at).norm();
      at = to;
      if (gone >= distance || mesh_.twins[side] < 0) break;
      h = mesh_.twins[side];
    }
    return frames_[h / 3].normal;
  }

  const PlanMesh& mesh_;
  std::span<const FaceFrame> frames_;
};

/// The mean of a value along the line of each edge, and up to some edges each way.
struct LineMeans {
  std::vector<double> whole, near;
};
LineMeans means_along(const PlanMesh& mesh, const EdgeLines& lines, std::span<const double> values, std::int64_t reach) {
  LineMeans means{std::vector<double>(values.begin(), values.end()), std::vector<double>(values.begin(), values.end())};
  for (const std::vector<std::int32_t>& line : lines.edges) {
    double sum = 0.0, length = 0.0;
    std::vector<double> sums{0.0}, lengths{0.0};
    for (const std::int32_t e : line) {
      sum += mesh.lengths[e] * values[e];
      length += mesh.lengths[e];
      sums.push_back(sum);
      lengths.push_back(length);
    }
    if (!(length > 0.0)) continue;
    for (std::int64_t i = 0; i < std::ssize(line); ++i) {
      const auto low = static_cast<std::size_t>(std::max<std::int64_t>(i - reach, 0));
      const auto high = static_cast<std::size_t>(std::min<std::int64_t>(i + reach + 1, std::ssize(line)));
      means.whole[line[index(static_cast<std::int32_t>(i))]] = sum / length;
      const double own = lengths[high] - lengths[low];
      if (own > 0.0) means.near[line[index(static_cast<std::int32_t>(i))]] = (sums[high] - sums[low]) / own;
    }
  }
  return means;
}

}  // namespace

std::vector<double> border_odds(const PlanMesh& mesh, std::span<const FaceFrame> frames, const Polygons& polygons,
                                std::span<const std::uint8_t> is_marked, const Reflection* reflection,
                                const Task& task) {
  const Visibility visibility = find_visibility(mesh, std::nullopt, task);
  const EdgeLines lines = find_lines(mesh, polygons);
  const double diagonal = diagonal_of(mesh);
  const BendFinder bends(mesh, frames);
  std::vector<double> degrees(mesh.edge_count(), 0.0), sharp(mesh.edge_count(), 0.0), wide(mesh.edge_count(), 0.0);
  for (std::int32_t e = 0; index(e) < mesh.edge_count(); ++e) {
    if (mesh.is_boundary(e) || polygons.is_diagonal[e] != 0) continue;
    degrees[e] = bends.degrees(e);
    sharp[e] = std::abs(degrees[e]);
    wide[e] = bends.wide_degrees(e, knob(0, 0.015) * diagonal);
  }
  const LineMeans means = means_along(mesh, lines, sharp, 3);
  // The sharpest other edge of the polygons on both sides.
  std::vector<std::array<double, 2>> sharpest(polygons.count, {0.0, 0.0});
  const auto for_sides = [&](std::int32_t e, const auto& visit) {
    const std::int32_t h = mesh.half_edge_of[e];
    visit(polygons.of_face[h / 3]);
    if (mesh.twins[h] >= 0) visit(polygons.of_face[mesh.twins[h] / 3]);
  };
  for (std::int32_t e = 0; index(e) < mesh.edge_count(); ++e) {
    if (polygons.is_diagonal[e] != 0) continue;
    for_sides(e, [&](std::int32_t p) {
      auto& [most, second] = sharpest[p];
      if (sharp[e] > most) {
        second = std::exchange(most, sharp[e]);
      } else {
        second = std::max(second, sharp[e]);
      }
    });
  }
  double open = 0.0, length = 0.0;
  const auto openness = [&](std::int32_t e) {
    const std::int32_t h = mesh.half_edge_of[e];
    return 0.5 * (visibility.ambient[mesh.start(h)] + visibility.ambient[mesh.end(h)]);
  };
  for (std::int32_t e = 0; index(e) < mesh.edge_count(); ++e) {
    open += mesh.lengths[e] * openness(e);
    length += mesh.lengths[e];
  }
  const double mean_open = length > 0.0 ? open / length : 1.0;
  std::vector<double> odds(mesh.edge_count(), -kNever);
  for (std::int32_t e = 0; index(e) < mesh.edge_count(); ++e) {
    if (polygons.is_diagonal[e] != 0) continue;
    double other = 0.0;
    for_sides(e, [&](std::int32_t p) { other = std::max(other, sharpest[p][0] == sharp[e] ? sharpest[p][1] : sharpest[p][0]); });
    const double own = knob(1, 1.0) * sharp[e] + knob(2, 0.0) * means.whole[e] + knob(3, 0.0) * means.near[e] + knob(4, 0.0) * std::max(wide[e]-sharp[e], 0.0);
    odds[e] = (own - knob(5, 50.0)) / knob(6, 12.0) + knob(7, -0.3) - knob(8, 2.0) * (openness(e) - mean_open);
    if (sharp[e] < other - 5.0) odds[e] -= knob(9, 1.5);
    if (degrees[e] < -20.0) odds[e] += knob(10, 0.5);
    if (reflection != nullptr && sharp[e] > 10.0) {
      const std::int32_t h = mesh.half_edge_of[e];
      if (reflection->sides[mesh.start(h)] == 0 && reflection->sides[mesh.end(h)] == 0) odds[e] += knob(11, 1.0);
    }
    if (is_marked[e] != 0) odds[e] += 4.0;
  }
  if (reflection != nullptr && reflection->is_exact) {
    const std::vector<double> own = odds;
    for (std::int32_t e = 0; index(e) < mesh.edge_count(); ++e) {
      const std::int32_t a = reflection->images[mesh.start(mesh.half_edge_of[e])];
      const std::int32_t b = reflection->images[mesh.end(mesh.half_edge_of[e])];
      const std::int32_t image = a < 0 || b < 0 ? -1 : mesh.edge_between(a, b);
      if (image >= 0 && polygons.is_diagonal[image] == polygons.is_diagonal[e]) odds[e] = 0.5 * (own[e] + own[image]);
    }
  }
  return odds;
}

}  // namespace seamwire::detail
