// SPDX-License-Identifier: GPL-3.0-or-later
#include "seamwire_uv/parts/scanned_edges.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "detail/csr.hpp"
#include "detail/index.hpp"
#include "detail/infinity.hpp"
#include "maps/quad_skew.hpp"
#include "seamwire/errors.hpp"
#include "tuning/constants.hpp"

namespace seamwire {

using namespace detail;

namespace {

using Tensor = Eigen::Matrix3d;

Vector unit(const Vector& v) {
  const double length = v.norm();
  return length > 0.0 ? Vector(v / length) : Vector::Zero();
}

/// An edge between two triangles.
struct Hinge {
  std::int32_t start = -1, end = -1;
  std::array<std::int32_t, 2> faces{-1, -1}, tips{-1, -1};  ///< the triangles, and their corners off the edge
  double length = 0.0;
  double bend = 0.0;  ///< the angle between the triangles in radians, positive on ridges and negative in valleys
  Vector along = Vector::Zero(), beside = Vector::Zero();
  bool is_diagonal = false;  ///< of a quad
};

/// The edges of a mesh, and what tells who placed them.
class EdgeSigns {
 public:
  EdgeSigns(std::span<const Vector> points, std::span<const Triangle> triangles, std::span<const std::int32_t> polygons)
      : points_(points), triangles_(triangles), is_open_(points.size(), 0) {
    find_hinges();
    for (Hinge& hinge : hinges_) measure(hinge);
    std::erase_if(hinges_, [](const Hinge& hinge) { return !(hinge.length > 0.0); });
    mark_diagonals(polygons);
  }

  /// The standard deviation of the logarithms of the lengths of the edges.
  double spread() const;
  /// The share of regular vertices inside the mesh, or 1 if all vertices lie on the border. They have six edges, or
  /// four edges beside the diagonals if all their faces are quads.
  double regular() const;
  /// The share of the area in triangles that lie in a plane with each of their neighbors.
  double flat() const;
  /// How well edges run along or across the bends of the surface: 1 if all do, 0 if their directions are random, -1 if
  /// all run halfway between. Strong bends count more, and diagonals of quads do not count. It is 1 without bends.
  ///
  /// The curvature tensor of an edge sums the bends of the edges around it (Cohen-Steiner and Morvan, Restricted
  /// Delaunay triangulations and normal cycle, 2003). The difference of its two curvatures is the weight of the edge.
  double follows() const;

 private:
  void find_hinges();
  void measure(Hinge& hinge) const;
  void mark_diagonals(std::span<const std::int32_t> polygons);
  Vector area_normal(std::int32_t face) const {
    const auto& [a, b, c] = triangles_[face];
    return (points_[b] - points_[a]).cross(points_[c] - points_[a]);
  }

  std::span<const Vector> points_;
  std::span<const Triangle> triangles_;
  std::vector<Hinge> hinges_;
  std::vector<std::uint8_t> is_open_;  // vertices at edges with other than two triangles
};

void EdgeSigns::find_hinges() {
  /// The other end of an edge, and the corner off it.
  using Side = std::array<std::int32_t, 2>;
  const Csr<Side> sides(points_.size(), [&](const auto& visit) {
    for (std::int32_t f = 0; index(f) < triangles_.size(); ++f) {
      for (std::int32_t i = 0; i < 3; ++i) {
        const std::int32_t one = triangles_[f][(i + 1) % 3], other = triangles_[f][(i + 2) % 3];
        visit(std::min(one, other), Side{std::max(one, other), 3 * f + i});
      }
    }
  });
  std::vector<Side> row;
  for (std::int32_t low = 0; index(low) < points_.size(); ++low) {
    row.assign(sides[low].begin(), sides[low].end());
    std::ranges::sort(row);
    for (std::size_t begin = 0, end = 0; begin < row.size(); begin = end) {
      while (end < row.size() && row[end][0] == row[begin][0]) ++end;
      if (end - begin != 2) {
        is_open_[low] = is_open_[row[begin][0]] = 1;
        continue;
      }
      const std::int32_t here = row[begin][1], there = row[begin + 1][1];
      hinges_.push_back({.start = triangles_[here / 3][(here + 1) % 3],
                         .end = triangles_[here / 3][(here + 2) % 3],
                         .faces = {here / 3, there / 3},
                         .tips = {triangles_[here / 3][here % 3], triangles_[there / 3][there % 3]}});
    }
  }
}

void EdgeSigns::measure(Hinge& hinge) const {
  constexpr double kUnbent = 1e-3;  // rounding bends flat faces
  const Vector edge = points_[hinge.end] - points_[hinge.start];
  const Vector here = unit(area_normal(hinge.faces[0]));
  const Triangle& other = triangles_[hinge.faces[1]];
  const auto at = std::ranges::find(other, hinge.start) - other.begin();
  const bool is_turned = other[(at + 1) % 3] == hinge.end;  // both triangles have the edge in the same direction
  const Vector there = (is_turned ? -1.0 : 1.0) * unit(area_normal(hinge.faces[1]));
  hinge.length = edge.norm();
  hinge.along = unit(edge);
  hinge.beside = unit((here + there).cross(hinge.along));
  const double angle = 2.0 * std::asin(std::min(0.5 * (there - here).norm(), 1.0));
  const bool is_ridge = here.dot(points_[hinge.tips[1]] - points_[hinge.start]) <= 0.0;
  if (angle > kUnbent) hinge.bend = is_ridge ? angle : -angle;
}

void EdgeSigns::mark_diagonals(std::span<const std::int32_t> polygons) {
  std::vector<double> skews;
  std::vector<double> best(triangles_.size(), kInfinity);
  for (const Hinge& hinge : hinges_) {
    skews.push_back(
        quad_skew({points_[hinge.start], points_[hinge.tips[0]], points_[hinge.end], points_[hinge.tips[1]]}));
    for (const std::int32_t f : hinge.faces) best[f] = std::min(best[f], skews.back());
  }
  // Two triangles are a quad if neither has a better partner.
  for (std::size_t h = 0; h < hinges_.size(); ++h) {
    const auto [one, other] = hinges_[h].faces;
    const bool is_inner = !polygons.empty() && polygons[one] == polygons[other];
    hinges_[h].is_diagonal = is_inner || (skews[h] < kInfinity && skews[h] <= std::min(best[one], best[other]));
  }
}

double EdgeSigns::spread() const {
  double sum = 0.0, squares = 0.0;
  for (const Hinge& hinge : hinges_) sum += std::log(hinge.length);
  const double mean = sum / static_cast<double>(hinges_.size());
  for (const Hinge& hinge : hinges_) squares += std::pow(std::log(hinge.length) - mean, 2);
  return hinges_.empty() ? 0.0 : std::sqrt(squares / static_cast<double>(hinges_.size()));
}

double EdgeSigns::regular() const {
  std::vector<int> edges(points_.size(), 0), sides(points_.size(), 0);
  std::vector<std::uint8_t> is_alone(triangles_.size(), 1);
  for (const Hinge& hinge : hinges_) {
    for (const std::int32_t v : {hinge.start, hinge.end}) {
      ++edges[v];
      if (!hinge.is_diagonal) ++sides[v];
    }
    if (hinge.is_diagonal) is_alone[hinge.faces[0]] = is_alone[hinge.faces[1]] = 0;
  }
  for (std::size_t f = 0; f < triangles_.size(); ++f) {
    if (is_alone[f] == 0) continue;
    for (const std::int32_t v : triangles_[f]) sides[v] = 0;
  }
  std::size_t inside = 0, of_six = 0, of_four = 0;
  for (std::size_t v = 0; v < points_.size(); ++v) {
    if (edges[v] == 0 || is_open_[v] != 0) continue;
    ++inside;
    if (edges[v] == 6) ++of_six;
    if (sides[v] == 4) ++of_four;
  }
  return inside == 0 ? 1.0 : static_cast<double>(std::max(of_six, of_four)) / static_cast<double>(inside);
}

double EdgeSigns::flat() const {
  std::vector<double> most(triangles_.size(), 0.0);
  for (const Hinge& hinge : hinges_) {
    for (const std::int32_t f : hinge.faces) most[f] = std::max(most[f], std::abs(hinge.bend));
  }
  double flat = 0.0, all = 0.0;
  for (std::int32_t f = 0; index(f) < triangles_.size(); ++f) {
    const double area = area_normal(f).norm();
    all += area;
    if (most[f] < tuning::kInPlane) flat += area;
  }
  return all > 0.0 ? flat / all : 1.0;
}

double EdgeSigns::follows() const {
  std::vector<Tensor> own(points_.size(), Tensor::Zero());
  for (const Hinge& hinge : hinges_) {
    const Tensor part = hinge.bend * hinge.length * hinge.along * hinge.along.transpose();
    own[hinge.start] += part;
    own[hinge.end] += part;
  }
  std::vector<Tensor> near = own;
  for (const Hinge& hinge : hinges_) {
    near[hinge.start] += own[hinge.end];
    near[hinge.end] += own[hinge.start];
  }
  double sum = 0.0, weights = 0.0;
  for (const Hinge& hinge : hinges_) {
    if (hinge.is_diagonal) continue;
    const Tensor tensor = near[hinge.start] + near[hinge.end];
    const double difference = hinge.along.dot(tensor * hinge.along) - hinge.beside.dot(tensor * hinge.beside);
    const double weight = std::hypot(difference, 2.0 * hinge.along.dot(tensor * hinge.beside));
    if (!(weight > 0.0)) continue;
    // Four times the angle between the edge and the bend: its cosine is 1 along it and across it, -1 halfway between.
    sum += weight * (2.0 * std::pow(difference / weight, 2) - 1.0);
    weights += weight;
  }
  return weights > 0.0 ? sum / weights : 1.0;
}

/// A part of a mesh.
struct Sample {
  std::vector<Vector> points;
  std::vector<Triangle> triangles;
  std::vector<std::int32_t> polygons;
};

/// The triangles in bands across the longest side of a large mesh, about tuning::kMostJudged.
Sample sampled(std::span<const Vector> points, std::span<const Triangle> triangles,
               std::span<const std::int32_t> polygons) {
  Eigen::AlignedBox3d box;
  for (const Triangle& triangle : triangles) box.extend(points[triangle[0]]);
  Eigen::Index axis = 0;
  box.sizes().maxCoeff(&axis);
  std::vector<double> places;
  const std::size_t step = triangles.size() / tuning::kMostJudged;
  for (std::size_t f = 0; f < triangles.size(); f += step) places.push_back(points[triangles[f][0]][axis]);
  std::ranges::sort(places);
  std::vector<double> bounds;
  const double share = static_cast<double>(tuning::kMostJudged) / static_cast<double>(triangles.size());
  for (int band = 0; band < tuning::kBands; ++band) {
    for (const double side : {0.5 - 0.5 * share, 0.5 + 0.5 * share}) {
      const double at = (band + side) / tuning::kBands * static_cast<double>(places.size());
      bounds.push_back(places[std::min(static_cast<std::size_t>(at), places.size() - 1)]);
    }
  }
  Sample sample;
  std::vector<std::int32_t> numbers(points.size(), -1);
  for (std::size_t f = 0; f < triangles.size(); ++f) {
    const double place = points[triangles[f][0]][axis];
    if ((std::ranges::upper_bound(bounds, place) - bounds.begin()) % 2 == 0) continue;
    for (const std::int32_t v : triangles[f]) {
      if (numbers[v] >= 0) continue;
      numbers[v] = static_cast<std::int32_t>(sample.points.size());
      sample.points.push_back(points[v]);
    }
    const auto& [a, b, c] = triangles[f];
    sample.triangles.push_back({numbers[a], numbers[b], numbers[c]});
    if (!polygons.empty()) sample.polygons.push_back(polygons[f]);
  }
  return sample;
}

/// Whether more than half of the polygons have several triangles.
bool are_mostly_quads(std::span<const std::int32_t> polygons) {
  std::vector<std::int32_t> sorted(polygons.begin(), polygons.end());
  std::ranges::sort(sorted);
  std::size_t count = 0, quads = 0;
  for (std::size_t begin = 0, end = 0; begin < sorted.size(); begin = end) {
    while (end < sorted.size() && sorted[end] == sorted[begin]) ++end;
    ++count;
    if (end - begin > 1) ++quads;
  }
  return 2 * quads > count;
}

}  // namespace

bool has_scanned_edges(std::span<const Vector> points, std::span<const Triangle> triangles,
                       std::span<const std::int32_t> polygons) {
  if (!polygons.empty() && polygons.size() != triangles.size()) {
    throw InvalidInput("polygons: expected one for each of " + std::to_string(triangles.size()) + " triangles, got " +
                       std::to_string(polygons.size()));
  }
  for (std::size_t f = 0; f < triangles.size(); ++f) {
    for (const std::int32_t v : triangles[f]) {
      if (!is_index(v, points.size())) check_index(v, points.size(), "triangle " + std::to_string(f) + ": vertex");
    }
  }
  if (triangles.size() < tuning::kLeastScan || are_mostly_quads(polygons)) return false;
  Sample sample;
  if (triangles.size() > tuning::kMostJudged) {
    sample = sampled(points, triangles, polygons);
    points = sample.points, triangles = sample.triangles, polygons = sample.polygons;
  }
  const EdgeSigns signs(points, triangles, polygons);
  const double spread = signs.spread();
  if (spread < tuning::kUniform && signs.regular() < tuning::kRegular) return true;
  return spread < tuning::kUneven && signs.follows() < tuning::kFollows && signs.flat() < tuning::kFlatSides;
}

}  // namespace seamwire
