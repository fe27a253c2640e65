// SPDX-License-Identifier: GPL-3.0-or-later
#include "geodesics/intrinsic_delaunay.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <utility>

#include "detail/half_edge.hpp"
#include "detail/poll.hpp"
#include "geodesics/triangle_area.hpp"

namespace seamwire::detail {
namespace {

/// By how much, in parts of the mean edge, two sides of a triangle are longer together than the third.
constexpr double kLeastThickness = 1e-5;
/// An edge whose opposite cotangents add up to less is flipped. Rounding leaves less than this on a square grid.
constexpr double kFlipBelow = -1e-9;
/// Flips for each edge after which rounding must be at fault. Meshes in strong metrics take about one.
constexpr std::size_t kMostFlipsPerEdge = 50;

void thicken(std::vector<double>& lengths) {
  if (lengths.empty()) return;
  const double mean = std::accumulate(lengths.begin(), lengths.end(), 0.0) / static_cast<double>(lengths.size());
  double least = kLeastThickness * mean;
  for (std::size_t h = 0; h < lengths.size(); h += 3) {
    const double a = lengths[h], b = lengths[h + 1], c = lengths[h + 2];
    least = std::min({least, a + b - c, b + c - a, c + a - b});
  }
  for (double& length : lengths) length += kLeastThickness * mean - least;
}

class Flipper {
 public:
  explicit Flipper(IntrinsicMesh& mesh) : mesh_(mesh) {}

  void run(const Task& task) {
    const std::size_t count = mesh_.twins.size();
    std::vector<std::int32_t> open;
    std::vector<std::uint8_t> is_open(count, 0);
    const auto push = [&](std::int32_t h) {
      const std::int32_t twin = mesh_.twins[h];
      if (twin < 0) return;
      h = std::min(h, twin);
      if (is_open[h] != 0) return;
      is_open[h] = 1;
      open.push_back(h);
    };
    for (std::int32_t h = static_cast<std::int32_t>(count); h-- > 0;) push(h);
    Poll poll(task, 0.0, 1.0, 2 * open.size());
    std::size_t flips_left = kMostFlipsPerEdge * count;
    while (!open.empty() && flips_left > 0) {
      poll.next();
      const std::int32_t h = open.back();
      open.pop_back();
      is_open[h] = 0;
      const std::int32_t twin = mesh_.twins[h];
      if (twin < 0 || !(cotangent(h) + cotangent(twin) < kFlipBelow) || !flip(h)) continue;
      --flips_left;
      for (const std::int32_t face : {h / 3, twin / 3}) {
        for (std::int32_t side = 3 * face; side < 3 * face + 3; ++side) push(side);
      }
    }
  }

 private:
  /// Of the angle opposite to a half-edge.
  double cotangent(std::int32_t h) const {
    const double a = mesh_.lengths[h], b = mesh_.lengths[next_in_face(h)], c = mesh_.lengths[previous_in_face(h)];
    const double area = four_areas(a, b, c);
    return area > 0 ? (b * b + c * c - a * a) / area : (b * b + c * c > a * a ? 1e12 : -1e12);
  }

  /// Replaces an edge by the other diagonal of its two triangles. If they have no other diagonal, it changes nothing
  /// and returns false.
  bool flip(std::int32_t h) {
    const std::int32_t t = mesh_.twins[h];
    if (t / 3 == h / 3) return false;
    // The triangles (a, b, c) and (b, a, d) become (c, d, b) and (d, c, a).
    const std::int32_t bc = next_in_face(h), ca = previous_in_face(h), ad = next_in_face(t), db = previous_in_face(t);
    const double ab = mesh_.lengths[h];
    const auto apex = [&](double at_tail, double at_tip) {
      const double x = (ab * ab + at_tail * at_tail - at_tip * at_tip) / (2 * ab);
      return std::pair(x, four_areas(ab, at_tail, at_tip) / (2 * ab));
    };
    const auto [cx, cy] = apex(mesh_.lengths[ca], mesh_.lengths[bc]);
    const auto [dx, dy] = apex(mesh_.lengths[ad], mesh_.lengths[db]);
    const double cd = std::hypot(cx - dx, cy + dy);
    const auto is_triangle = [&](double one, double other) { return four_areas(cd, one, other) > 0; };
    if (!is_triangle(mesh_.lengths[bc], mesh_.lengths[db]) || !is_triangle(mesh_.lengths[ca], mesh_.lengths[ad])) {
      return false;
    }
    const std::int32_t f = 3 * (h / 3), g = 3 * (t / 3);
    const std::int32_t a = mesh_.tail(h), b = mesh_.tail(t), c = mesh_.tail(ca), d = mesh_.tail(db);
    const std::array<std::pair<std::int32_t, std::int32_t>, 4> moves{
        {{db, f + 1}, {bc, f + 2}, {ca, g + 1}, {ad, g + 2}}};
    std::array<std::int32_t, 4> twins{};
    std::array<double, 4> lengths{};
    for (std::size_t i = 0; i < 4; ++i) {
      lengths[i] = mesh_.lengths[moves[i].first];
      twins[i] = mesh_.twins[moves[i].first];
      for (const auto& [from, to] : moves) {
        if (mesh_.twins[moves[i].first] == from) twins[i] = to;
      }
    }
    for (std::size_t i = 0; i < 4; ++i) {
      const std::int32_t to = moves[i].second;
      mesh_.lengths[to] = lengths[i];
      mesh_.twins[to] = twins[i];
      if (twins[i] >= 0) mesh_.twins[twins[i]] = to;
    }
    mesh_.triangles[f / 3] = {c, d, b};
    mesh_.triangles[g / 3] = {d, c, a};
    mesh_.lengths[f] = mesh_.lengths[g] = cd;
    mesh_.twins[f] = g;
    mesh_.twins[g] = f;
    return true;
  }

  IntrinsicMesh& mesh_;
};

}  // namespace

IntrinsicMesh intrinsic_delaunay(const IntrinsicMesh& mesh, const Task& task) {
  task.check(0.0);
  IntrinsicMesh delaunay;
  delaunay.triangles = mesh.triangles;
  delaunay.twins = mesh.twins;
  delaunay.vertex_count = mesh.vertex_count;
  delaunay.lengths = mesh.lengths;
  task.check(0.0);
  thicken(delaunay.lengths);
  Flipper(delaunay).run(task);
  return delaunay;
}

}  // namespace seamwire::detail
