// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>
#include <vector>

#include "seamwire/surface/vector.hpp"
#include "surface/box_tree.hpp"

namespace seamwire::detail {

/// The length of the polyline through points.
double length_of(std::span<const Vector> points);

/// A line of straight segments, which tells how far points and edges are from it, by a tree of boxes over its segments.
class Polyline {
 public:
  /// At least one point.
  explicit Polyline(const std::vector<Vector>& points);

  /// Distance from p, which is known to be at most `bound`.
  double distance(const Vector& p, double bound) const;

  /// Integral of the distance along the edge from a to b, at which it is `at_a` and `at_b`.
  double integral(const Vector& a, const Vector& b, double at_a, double at_b) const;

  /// No more than integral() of an edge of that length.
  static double least_integral(double length, double at_a, double at_b);

 private:
  struct Segment {
    Vector from, along;
    double per_length2;  // 0: it is a point
  };

  static double squared_distance(double x, double y, double z, const Segment& s);

  std::vector<Segment> segments_;
  BoxTree tree_;  // of the segments in their order
};

}  // namespace seamwire::detail
