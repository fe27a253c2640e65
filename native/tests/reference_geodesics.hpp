// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <numbers>
#include <queue>
#include <utility>
#include <vector>

#include "seamwire/surface/intrinsic_mesh.hpp"

/// Exact distances the plain way, to compare with. A shortest path is a chain of straight lines that bends at vertices
/// only. So this is Dijkstra's algorithm over the vertices. From each vertex at which a path may bend, all straight
/// lines are followed over the surface, triangle by triangle, as far as the farthest vertex can be. No window is ever
/// compared with another one, nothing is dropped but what is too far away.
namespace seamwire::reference {

inline constexpr double kInfinity = std::numeric_limits<double>::infinity();

struct Point2 {
  double x = 0.0, y = 0.0;
};
inline double cross(const Point2& a, const Point2& b) { return a.x * b.y - a.y * b.x; }
inline double norm(const Point2& a) { return std::hypot(a.x, a.y); }

class Geodesics {
 public:
  explicit Geodesics(const IntrinsicMesh& mesh)
      : mesh_(mesh), leaving_(count()), loose_(count()), is_source_(count(), false) {
    std::vector<double> angle(count(), 0.0);
    for (std::int32_t h = 0; h < 3 * static_cast<std::int32_t>(mesh.face_count()); ++h) {
      leaving_[index(mesh.tail(h))].push_back(h);
      const double a = length(h), b = length(previous(h)), c = length(next(h));
      angle[index(mesh.tail(h))] += std::acos(std::clamp((a * a + b * b - c * c) / (2 * a * b), -1.0, 1.0));
      if (mesh.twins[index(h)] < 0) is_source_[index(mesh.tail(h))] = is_source_[index(mesh.tip(h))] = true;
    }
    for (const LooseEdge& edge : mesh.loose_edges) {
      loose_[index(edge.a)].push_back({edge.b, edge.length});
      loose_[index(edge.b)].push_back({edge.a, edge.length});
    }
    for (std::size_t v = 0; v < count(); ++v) {
      // Several closed fans at one vertex: count the first one.
      std::size_t met = 0;
      if (!is_source_[v] && !leaving_[v].empty()) {
        std::int32_t h = leaving_[v].front();
        do {
          h = mesh.twins[index(previous(h))];
          ++met;
        } while (h != leaving_[v].front());
      }
      // A vertex more or less does no harm where the angle is a full turn: straight on is straight on.
      if (angle[v] > 2 * std::numbers::pi - 1e-9 || !loose_[v].empty() || met != leaving_[v].size()) {
        is_source_[v] = true;
      }
    }
  }

  std::vector<double> distances(std::int32_t seed) const {
    double farthest = 0.0;
    for (const double d : dijkstra(seed, false, 0.0)) {
      if (d < kInfinity) farthest = std::max(farthest, d);
    }
    return dijkstra(seed, true, farthest * (1 + 1e-9));
  }

 private:
  std::size_t count() const { return index(mesh_.vertex_count); }
  static std::size_t index(std::int32_t i) { return static_cast<std::size_t>(i); }
  static std::int32_t next(std::int32_t h) { return h % 3 == 2 ? h - 2 : h + 1; }
  static std::int32_t previous(std::int32_t h) { return h % 3 == 0 ? h + 2 : h - 1; }
  double length(std::int32_t h) const { return mesh_.lengths[index(h)]; }

  std::vector<double> dijkstra(std::int32_t seed, bool straight_lines, double reach) const {
    std::vector<double> result(count(), kInfinity);
    using Entry = std::pair<double, std::int32_t>;
    std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
    const auto lower = [&](std::int32_t v, double distance) {
      if (!(distance < result[index(v)])) return;
      result[index(v)] = distance;
      queue.emplace(distance, v);
    };
    lower(seed, 0.0);
    while (!queue.empty()) {
      const auto [distance, v] = queue.top();
      queue.pop();
      if (distance > result[index(v)]) continue;
      for (const std::int32_t h : leaving_[index(v)]) {
        lower(mesh_.tip(h), distance + length(h));
        lower(mesh_.apex(h), distance + length(previous(h)));
      }
      for (const auto& [to, edge_length] : loose_[index(v)]) lower(to, distance + edge_length);
      if (straight_lines && (v == seed || is_source_[index(v)])) {
        const double from = distance;
        follow_lines(v, reach - from, [&](std::int32_t to, double straight) { lower(to, from + straight); });
      }
    }
    return result;
  }

  /// Lines from the origin between the directions `left` and `right` enter a triangle over the half-edge h, whose ends
  /// lie at `tail` and `tip`.
  struct Beam {
    std::int32_t h;
    Point2 tail, tip, left, right;
  };

  static Point2 mirrored(const Point2& p) { return {-p.x, p.y}; }

  /// Lets lines that leave a triangle over the half-edge h into every other triangle at its edge. Into one that lies on
  /// the same side of h as the triangle they leave they go as their mirror image.
  void enter(std::int32_t h, Beam beam, std::vector<Beam>& beams) const {
    beam.h = mesh_.twins[index(h)];
    if (beam.h >= 0) beams.push_back(beam);
    if (mesh_.siblings.empty() || mesh_.siblings[index(h)] < 0) return;
    for (std::int32_t s = mesh_.siblings[index(h)]; s != h; s = mesh_.siblings[index(s)]) {
      beam.h = s;
      if (mesh_.tail(s) == mesh_.tip(h)) {
        beams.push_back(beam);
      } else {
        beams.push_back({s, mirrored(beam.tip), mirrored(beam.tail), mirrored(beam.right), mirrored(beam.left)});
      }
    }
  }

  template <class Found>
  void follow_lines(std::int32_t v, double reach, const Found& found) const {
    std::vector<Beam> beams;
    for (const std::int32_t h : leaving_[index(v)]) {
      const double a = length(h), b = length(previous(h)), c = length(next(h));
      const double x = (a * a + b * b - c * c) / (2 * a);
      const Point2 tip{a, 0.0}, apex{x, std::sqrt(std::max(b * b - x * x, 0.0))};
      if (apex.y > 0) enter(next(h), {-1, apex, tip, apex, tip}, beams);
    }
    while (!beams.empty()) {
      const Beam beam = beams.back();
      beams.pop_back();
      const double base = length(beam.h), left_length = length(previous(beam.h)), right_length = length(next(beam.h));
      const Point2 along{(beam.tip.x - beam.tail.x) / base, (beam.tip.y - beam.tail.y) / base};
      // Where the outermost lines meet the edge, and the point of the edge between them that is nearest to the origin.
      const double line = cross(beam.tail, along);
      const double begin = cross(beam.left, beam.tail) / cross(along, beam.left);
      const double end = cross(beam.right, beam.tail) / cross(along, beam.right);
      const double nearest = std::clamp(-(beam.tail.x * along.x + beam.tail.y * along.y), begin, std::max(begin, end));
      if (!(line < 0) || !(begin < end) ||
          norm({beam.tail.x + nearest * along.x, beam.tail.y + nearest * along.y}) > reach) {
        continue;
      }
      const double x = (base * base + left_length * left_length - right_length * right_length) / (2 * base);
      const double y = std::sqrt(std::max(left_length * left_length - x * x, 0.0));
      const Point2 apex{beam.tail.x + x * along.x - y * along.y, beam.tail.y + x * along.y + y * along.x};
      const double right_of_left = cross(apex, beam.left), left_of_right = cross(beam.right, apex);
      const double rounding = 1e-12 * norm(apex);
      if (right_of_left > -rounding * norm(beam.left) && left_of_right > -rounding * norm(beam.right)) {
        found(mesh_.apex(beam.h), norm(apex));
      }
      if (right_of_left > 0) {
        enter(previous(beam.h), {-1, beam.tail, apex, beam.left, left_of_right > 0 ? apex : beam.right}, beams);
      }
      if (left_of_right > 0) {
        enter(next(beam.h), {-1, apex, beam.tip, right_of_left > 0 ? apex : beam.left, beam.right}, beams);
      }
    }
  }

  const IntrinsicMesh& mesh_;
  std::vector<std::vector<std::int32_t>> leaving_;
  std::vector<std::vector<std::pair<std::int32_t, double>>> loose_;
  std::vector<bool> is_source_;
};

}  // namespace seamwire::reference
