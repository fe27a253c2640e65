// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "detail/index.hpp"
#include "detail/infinity.hpp"
#include "detail/poll.hpp"

namespace seamwire::detail {

/// A rectangle in the plane, turned in any direction.
struct Strip {
  Eigen::Vector2d middle, axis, half;  // half: half of its size along the axis and across

  /// Whether the strips may be closer to each other than `reach`.
  bool is_near(const Strip& other, double reach) const {
    const double along = std::abs(axis.dot(other.axis)), across = std::abs(cross(axis, other.axis));
    const Eigen::Vector2d way = other.middle - middle;
    const auto reaches = [&](const Strip& one, const Strip& two) {
      return std::abs(one.axis.dot(way)) <= one.half.x() + along * two.half.x() + across * two.half.y() + reach &&
             std::abs(cross(one.axis, way)) <= one.half.y() + across * two.half.x() + along * two.half.y() + reach;
    };
    return reaches(*this, other) && reaches(other, *this);
  }
  bool is_near(const Eigen::Vector2d& point, double reach) const {
    const Eigen::Vector2d way = point - middle;
    return std::abs(axis.dot(way)) <= half.x() + reach && std::abs(cross(axis, way)) <= half.y() + reach;
  }

 private:
  static double cross(const Eigen::Vector2d& a, const Eigen::Vector2d& b) { return a.x() * b.y() - a.y() * b.x(); }
};

/// A tree of strips around items in their order: halves, quarters and so on (Ballard 1981). A strip lies along most of
/// its items, so that parallel items next to each other are told apart, in whatever direction they lie.
class StripTree {
 public:
  /// Items in a row, with the strip around them.
  struct Part {
    std::int32_t node, begin, end;
    bool is_item() const { return end - begin == 1; }
  };

  /// `points`: of the items, `of_each` of an item. An item lies along its first and last point.
  StripTree(std::span<const Eigen::Vector2d> points, std::size_t of_each, Poll& poll)
      : count_(points.size() / of_each) {
    if (count_ == 0) return;
    strips_.resize(2 * count_ - 1);
    build(root(), points, of_each, poll);
  }

  Part root() const { return {0, 0, static_cast<std::int32_t>(count_)}; }
  std::array<Part, 2> halves(const Part& part) const {
    const std::int32_t middle = part.begin + (part.end - part.begin) / 2;
    return {{{part.node + 1, part.begin, middle}, {part.node + 2 * (middle - part.begin), middle, part.end}}};
  }
  const Strip& strip(const Part& part) const { return strips_[index(part.node)]; }

 private:
  void build(const Part& part, std::span<const Eigen::Vector2d> points, std::size_t of_each, Poll& poll) {
    poll.next();
    const std::span own = points.subspan(index(part.begin) * of_each, index(part.end - part.begin) * of_each);
    // Directions are doubled, so that opposite ones are the same.
    double doubled_x = 0.0, doubled_y = 0.0;
    for (std::size_t i = 0; i < own.size(); i += of_each) {
      const Eigen::Vector2d way = own[i + of_each - 1] - own[i];
      const double length = way.norm();
      if (!(length > 0.0)) continue;
      doubled_x += (way.x() - way.y()) * ((way.x() + way.y()) / length);
      doubled_y += 2.0 * way.x() * (way.y() / length);
    }
    const double angle = 0.5 * std::atan2(doubled_y, doubled_x);
    const Eigen::Vector2d axis(std::cos(angle), std::sin(angle)), normal(-axis.y(), axis.x());
    Eigen::Vector2d low(kInfinity, kInfinity), high(-kInfinity, -kInfinity);
    for (const Eigen::Vector2d& point : own) {
      const Eigen::Vector2d way = point - own.front();
      const Eigen::Vector2d at(axis.dot(way), normal.dot(way));
      low = low.cwiseMin(at);
      high = high.cwiseMax(at);
    }
    const Eigen::Vector2d middle = 0.5 * (low + high);
    strips_[index(part.node)] = {own.front() + middle.x() * axis + middle.y() * normal, axis, 0.5 * (high - low)};
    if (part.is_item()) return;
    for (const Part& half : halves(part)) build(half, points, of_each, poll);
  }

  std::size_t count_ = 0;
  std::vector<Strip> strips_;  // a part, its first half with all its parts, its second half
};

/// Finds the items of two trees, or of one, that may be closer to each other than `reach`. `is_skipped(one, other)`
/// tells of two parts whether their items are of no interest.
template <class IsSkipped>
class ClosePairs {
 public:
  ClosePairs(const StripTree& one, const StripTree& other, double reach, const IsSkipped& is_skipped, Poll& poll)
      : one_(one), other_(other), reach_(reach), is_skipped_(is_skipped), poll_(poll) {}

  /// Calls visit(item, item of the other tree) for all pairs that may be so close, until it returns true; returns
  /// whether it did. Throws Cancelled.
  template <class Visit>
  bool any(const Visit& visit) const {
    if (&one_ == &other_) return any_within(one_.root(), visit);
    return any_between(one_.root(), other_.root(), visit);
  }

 private:
  template <class Visit>
  bool any_within(const StripTree::Part& part, const Visit& visit) const {
    if (part.end - part.begin < 2 || is_skipped_(part, part)) return false;
    const auto [first, second] = one_.halves(part);
    return any_within(first, visit) || any_within(second, visit) || any_between(first, second, visit);
  }
  template <class Visit>
  bool any_between(const StripTree::Part& one, const StripTree::Part& other, const Visit& visit) const {
    poll_.next();
    const Strip &strip = one_.strip(one), &other_strip = other_.strip(other);
    if (!strip.is_near(other_strip, reach_) || is_skipped_(one, other)) return false;
    if (one.is_item() && other.is_item()) return visit(one.begin, other.begin);
    if (other.is_item() || (!one.is_item() && strip.half.sum() > other_strip.half.sum())) {
      const auto [first, second] = one_.halves(one);
      return any_between(first, other, visit) || any_between(second, other, visit);
    }
    const auto [first, second] = other_.halves(other);
    return any_between(one, first, visit) || any_between(one, second, visit);
  }

  const StripTree &one_, &other_;
  double reach_;
  const IsSkipped& is_skipped_;
  Poll& poll_;
};

}  // namespace seamwire::detail
