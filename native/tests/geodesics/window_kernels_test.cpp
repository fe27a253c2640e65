// SPDX-License-Identifier: GPL-3.0-or-later
//
// Each kernel against its plain twin: the same thing said by sampling points, without the kernel's formulas. And all
// instruction sets give the same bits.
#include "geodesics/window_kernels.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <random>
#include <string>
#include <vector>

namespace seamwire {

using namespace detail;

namespace {

constexpr int kSamples = 400;
/// Rounding: lengths are around 1.
constexpr double kTolerance = 1e-9;

struct Point {
  double x, y;
};
double distance(const Point& a, const Point& b) { return std::hypot(a.x - b.x, a.y - b.y); }
Point between(const Point& a, const Point& b, double t) { return {a.x + t * (b.x - a.x), a.y + t * (b.y - a.y)}; }

/// Where the segment from a point below the base to one above it meets the base.
double on_base(const Point& below, const Point& above) {
  return between(below, above, -below.y / (above.y - below.y)).x;
}

double uniform(std::mt19937& random, double low, double high) {
  return std::uniform_real_distribution<double>(low, high)(random);
}

/// A list over a base, with room behind it whose content must not matter.
struct List {
  std::vector<double> b0, b1, x, y, distance;
  std::vector<std::int32_t> source;
  std::size_t count;

  List(std::mt19937& random, std::size_t size, double base) : count(size) {
    for (std::vector<double>* column : {&b0, &b1, &x, &y, &distance}) {
      column->assign(size + kPadding, std::numeric_limits<double>::quiet_NaN());
    }
    source.assign(size + kPadding, 0);
    for (std::size_t i = 0; i < size; ++i) {
      const double a = uniform(random, 0, base), b = uniform(random, 0, base);
      b0[i] = std::min(a, b);
      b1[i] = std::max(a, b);
      x[i] = uniform(random, -0.5, 1.5);
      y[i] = -uniform(random, 0.05, 1);
      distance[i] = uniform(random, 0, 0.5);
    }
  }
  Windows windows() { return {b0.data(), b1.data(), x.data(), y.data(), distance.data(), source.data()}; }
  Point at(std::size_t i) const { return {x[i], y[i]}; }
};

BaseTriangle any_triangle(std::mt19937& random) {
  return {uniform(random, 0.5, 1.5), uniform(random, -0.3, 1.3), uniform(random, 0.1, 1)};
}

/// The result of the kernels for a list, with room behind each column.
struct Made {
  std::vector<double> memory;
  std::vector<std::int64_t> alive;
  std::size_t stride;

  explicit Made(std::size_t size)
      : memory(ChildWindows::kColumns * (size + kPadding), 0.0), alive(size + kPadding, 0), stride(size + kPadding) {}
  ChildWindows children() { return ChildWindows::in(memory.data(), stride, alive.data()); }
};

class WindowKernelsOn : public testing::TestWithParam<const WindowKernels*> {
 protected:
  const WindowKernels& kernels = *GetParam();
  std::mt19937 random{7};
};

TEST_P(WindowKernelsOn, OverlapsAndOrderAreThoseOfTheIntervals) {
  for (int round = 0; round < 200; ++round) {
    List list(random, 1 + random() % 20, 1.0);
    if (round % 2 == 0) {
      std::sort(list.b0.begin(), list.b0.begin() + static_cast<std::ptrdiff_t>(list.count));
      for (std::size_t i = 0; i < list.count; ++i) list.b1[i] = list.b0[i] + 0.1;
    }
    std::vector<std::int64_t> overlaps(list.count + kPadding);
    std::vector<double> middles;
    for (std::size_t i = 0; i < list.count; ++i) middles.push_back(list.b0[i] + list.b1[i]);
    EXPECT_EQ(kernels.find_overlaps(list.windows(), list.count, overlaps.data()),
              std::is_sorted(middles.begin(), middles.end()));
    for (std::size_t i = 0; i + 1 < list.count; ++i) {
      const double shared = std::min(list.b1[i], list.b1[i + 1]) - std::max(list.b0[i], list.b0[i + 1]);
      const double narrower = std::min(list.b1[i] - list.b0[i], list.b1[i + 1] - list.b0[i + 1]);
      EXPECT_EQ(overlaps[i], shared > kLeastOverlap * narrower ? 1 : 0);
    }
  }
}

TEST_P(WindowKernelsOn, WindowsAreCutToWhereTheyAreNearer) {
  int cuts = 0, borders = 0;
  for (int round = 0; round < 500; ++round) {
    const std::size_t count = 1 + random() % 9, stride = count + kPadding;
    std::vector<double> room(Pairs::kColumns * stride, std::numeric_limits<double>::quiet_NaN());
    const Pairs pairs = Pairs::in(room.data(), stride);
    for (std::size_t k = 0; k < count; ++k) {
      pairs.begin[k] = uniform(random, 0, 0.5);
      pairs.end[k] = uniform(random, 0.5, 1);
      pairs.left.x[k] = uniform(random, -0.5, 1.5);
      pairs.left.y[k] = -uniform(random, 0.01, 1);
      pairs.left.distance[k] = uniform(random, 0, 0.5);
      // Often in line with the left one and a point of the base: there the difference of the distances turns.
      pairs.right.x[k] = uniform(random, -0.5, 1.5);
      pairs.right.y[k] = -uniform(random, 0.01, 1);
      if (k % 2 == 0) {
        const Point source =
            between({uniform(random, 0, 1), 0.0}, {pairs.left.x[k], pairs.left.y[k]}, uniform(random, 0.3, 2));
        pairs.right.x[k] = source.x;
        pairs.right.y[k] = source.y;
      }
      const Point left{pairs.left.x[k], pairs.left.y[k]}, right{pairs.right.x[k], pairs.right.y[k]}, middle{0.5, 0};
      pairs.right.distance[k] =
          pairs.left.distance[k] + distance(left, middle) - distance(right, middle) + uniform(random, -0.1, 0.1);
      if (k % 3 == 0) {  // both are equally far at an end, but for rounding
        const Point tie{round % 2 == 0 ? pairs.begin[k] : pairs.end[k], 0};
        pairs.right.distance[k] = pairs.left.distance[k] + distance(left, tie) - distance(right, tie);
      }
    }
    kernels.compare(pairs, count);
    for (std::size_t k = 0; k < count; ++k) {
      const Point left{pairs.left.x[k], pairs.left.y[k]}, right{pairs.right.x[k], pairs.right.y[k]};
      const double begin = pairs.begin[k], end = pairs.end[k];
      const auto more = [&](double b) {  // by how much the left one is farther
        return pairs.left.distance[k] + distance(left, {b, 0}) - pairs.right.distance[k] - distance(right, {b, 0});
      };
      double most = -1, least = 1;
      for (int s = 0; s <= kSamples; ++s) {
        const double b = std::min(begin + (end - begin) * s / kSamples, end);
        if (b > pairs.left_until[k]) {
          EXPECT_GE(more(b), -kTolerance);
        }
        if (b < pairs.right_from[k]) {
          EXPECT_LE(more(b), kTolerance);
        }
        most = std::max(most, more(b));
        least = std::min(least, more(b));
      }
      EXPECT_GE(pairs.left_until[k], begin);
      EXPECT_LE(pairs.right_from[k], end);
      // Nothing that can be cut is left.
      if (most < -kTolerance) {
        EXPECT_EQ(pairs.right_from[k], end);
      }
      if (least > kTolerance) {
        EXPECT_EQ(pairs.left_until[k], begin);
      }
      cuts += most < -kTolerance || least > kTolerance;
      if (more(begin) < -kTolerance && more(end) > kTolerance) {
        EXPECT_EQ(pairs.left_until[k], pairs.right_from[k]);
        EXPECT_NEAR(more(pairs.left_until[k]), 0, kTolerance);
        ++borders;
      }
    }
  }
  EXPECT_GT(cuts, 100);
  EXPECT_GT(borders, 100);
}

TEST_P(WindowKernelsOn, TheWayToTheApexIsTheShortestThroughTheWindow) {
  for (int round = 0; round < 100; ++round) {
    const BaseTriangle triangle = any_triangle(random);
    const Point apex{triangle.apex_x, triangle.apex_y};
    List list(random, 1 + random() % 20, triangle.base);
    std::vector<double> projections(list.count + kPadding), apex_distances(list.count + kPadding);
    kernels.find_apex_distances(list.windows(), list.count, triangle, projections.data(), apex_distances.data());
    for (std::size_t i = 0; i < list.count; ++i) {
      EXPECT_NEAR(projections[i], on_base(list.at(i), apex), kTolerance);
      double shortest = std::numeric_limits<double>::infinity();
      for (int s = 0; s <= kSamples; ++s) {
        const Point through{list.b0[i] + (list.b1[i] - list.b0[i]) * s / kSamples, 0};
        shortest = std::min(shortest, list.distance[i] + distance(list.at(i), through) + distance(through, apex));
      }
      EXPECT_LE(apex_distances[i], shortest + kTolerance);
      // The nearest sample is half a step off; a way's second derivative there is below 1 / 0.05 + 1 / 0.1.
      const double half = (list.b1[i] - list.b0[i]) / kSamples / 2;
      EXPECT_GE(apex_distances[i], shortest - 15 * half * half - kTolerance);
    }
  }
}

TEST_P(WindowKernelsOn, WaysOverACornerAreLeftToTheCorner) {
  const BaseTriangle triangle{1.0, 0.5, 0.5};
  List list(random, 3, 1.0);
  for (std::size_t i = 0; i < 3; ++i) list.b0[i] = 0.0, list.b1[i] = 1.0, list.y[i] = -0.1;
  list.x[0] = -3.0;  // the straight line passes left of the base
  list.x[1] = 3.0;
  list.x[2] = 0.5;
  std::vector<double> projections(3 + kPadding), apex_distances(3 + kPadding);
  kernels.find_apex_distances(list.windows(), 3, triangle, projections.data(), apex_distances.data());
  EXPECT_EQ(apex_distances[0], std::numeric_limits<double>::infinity());
  EXPECT_EQ(apex_distances[1], std::numeric_limits<double>::infinity());
  EXPECT_NEAR(apex_distances[2], list.distance[2] + 0.6, kTolerance);
}

/// Whether a child covers what the window sees of a side, and only dies where it does not matter.
void expect_children(const List& list, const std::vector<double>& begins, const std::vector<double>& ends,
                     const BaseTriangle& triangle, const Point& tail, const Point& tip, const Side& side, Made& made,
                     std::size_t count_made) {
  const ChildWindows children = made.children();
  std::size_t alive = 0;
  for (std::size_t i = 0; i < list.count; ++i) {
    const Point source = list.at(i);
    double first = std::numeric_limits<double>::infinity(), last = -first;
    for (int s = 0; s <= kSamples; ++s) {
      const double t = side.length * s / kSamples, b = on_base(source, between(tail, tip, t / side.length));
      const bool is_seen = b > begins[i] && b < ends[i];
      if (is_seen) first = std::min(first, t), last = std::max(last, t);
      if (children.alive[i] == 0) continue;
      EXPECT_NEAR(distance({children.x[i], children.y[i]}, {t, 0}),
                  distance(source, between(tail, tip, t / side.length)), kTolerance);
      const bool is_at_border = std::min(std::abs(b - begins[i]), std::abs(b - ends[i])) < kTolerance;
      const bool is_at_end = s == 0 || s == kSamples;
      if (!is_at_border && !is_at_end) {
        EXPECT_EQ(is_seen, t > children.b0[i] && t < children.b1[i]);
      }
    }
    alive += static_cast<std::size_t>(children.alive[i]);
    const double d = list.distance[i];
    const auto far = [&](double t) { return d + distance(source, between(tail, tip, t / side.length)); };
    if (children.alive[i] != 0) {
      EXPECT_LT(children.y[i], 0);
      EXPECT_GE(children.b0[i], 0);
      EXPECT_LE(children.b1[i], side.length);
      EXPECT_LE(far(children.b1[i]), side.at_tail + children.b1[i] + kTolerance);
      EXPECT_LE(far(children.b0[i]), side.at_tip + side.length - children.b0[i] + kTolerance);
    } else if (first < last) {
      // It is seen over more than a step, but an end of the side knows a shorter way: then over all that is seen.
      EXPECT_TRUE(far(last) > side.at_tail + last - 2 * side.length / kSamples ||
                  far(first) > side.at_tip + side.length - first - 2 * side.length / kSamples)
          << triangle.base << " " << i;
    }
  }
  EXPECT_EQ(count_made, alive);
}

TEST_P(WindowKernelsOn, ChildrenAreWhatWindowsSeeOfASide) {
  std::size_t alive = 0, all = 0;
  for (int round = 0; round < 100; ++round) {
    const BaseTriangle triangle = any_triangle(random);
    const Point apex{triangle.apex_x, triangle.apex_y}, tail{0, 0}, tip{triangle.base, 0};
    List list(random, 1 + random() % 20, triangle.base);
    const double split = uniform(random, 0, triangle.base);
    std::vector<double> projections(list.count + kPadding), apex_distances(list.count + kPadding);
    kernels.find_apex_distances(list.windows(), list.count, triangle, projections.data(), apex_distances.data());
    const double at_apex = uniform(random, 0.2, 2), at_tail = uniform(random, 0.2, 2), at_tip = uniform(random, 0.2, 2);
    const auto side = [&](const Point& from, const Point& to, double at_from, double at_to) {
      const double length = distance(from, to);
      return Side{length, (to.x - from.x) / length, (to.y - from.y) / length, at_from, at_to};
    };
    std::vector<double> begins = list.b0, ends = list.b1;
    for (std::size_t i = 0; i < list.count; ++i) ends[i] = std::min(ends[i], split);
    Made left(list.count), right(list.count);
    const Side left_side = side(tail, apex, at_tail, at_apex), right_side = side(apex, tip, at_apex, at_tip);
    std::size_t made =
        kernels.to_left(list.windows(), list.count, projections.data(), split, left_side, left.children());
    expect_children(list, begins, ends, triangle, tail, apex, left_side, left, made);
    alive += made;
    ends = list.b1;
    for (std::size_t i = 0; i < list.count; ++i) begins[i] = std::max(begins[i], split);
    made =
        kernels.to_right(list.windows(), list.count, projections.data(), split, triangle, right_side, right.children());
    expect_children(list, begins, ends, triangle, apex, tip, right_side, right, made);
    alive += made;
    all += 2 * list.count;
  }
  EXPECT_GT(alive, all / 20);
}

INSTANTIATE_TEST_SUITE_P(WindowKernels, WindowKernelsOn, testing::ValuesIn(window_kernels().usable()),
                         [](const auto& test) { return std::string(test.index == 0 ? "Plain" : "Avx2"); });

TEST(WindowKernels, AllGiveTheSameBits) {
  std::mt19937 random(3);
  for (int round = 0; round < 200; ++round) {
    const BaseTriangle triangle = any_triangle(random);
    List list(random, 1 + random() % 40, triangle.base);
    const double split = uniform(random, 0, triangle.base);
    const Side side{1.0, 0.6, 0.8, uniform(random, 0, 2), uniform(random, 0, 2)};
    const auto results = [&](const WindowKernels& kernels) {
      const std::size_t size = list.count, stride = size + kPadding;
      std::vector<double> out(2 * stride);
      kernels.find_apex_distances(list.windows(), size, triangle, out.data(), out.data() + stride);
      const std::vector<double> projections(out.begin(), out.begin() + static_cast<std::ptrdiff_t>(stride));
      std::vector<double> kept(projections.begin(), projections.begin() + static_cast<std::ptrdiff_t>(size));
      kept.insert(kept.end(), out.begin() + static_cast<std::ptrdiff_t>(stride),
                  out.begin() + static_cast<std::ptrdiff_t>(stride + size));
      const auto keep = [&](Made& made) {
        for (std::size_t column = 0; column < ChildWindows::kColumns; ++column) {
          for (std::size_t i = 0; i < size; ++i) {
            if (made.alive[i] != 0) kept.push_back(made.memory[column * made.stride + i]);
          }
        }
      };
      Made left(size), right(size);
      kernels.to_left(list.windows(), size, projections.data(), split, side, left.children());
      keep(left);
      kernels.to_right(list.windows(), size, projections.data(), split, triangle, side, right.children());
      keep(right);
      std::vector<double> room(Pairs::kColumns * stride, 0.0);
      const Pairs pairs = Pairs::in(room.data(), stride);
      for (std::size_t i = 0; i + 1 < size; ++i) {
        pairs.end[i] = 1.0;
        pairs.left.x[i] = list.x[i];
        pairs.left.y[i] = list.y[i];
        pairs.left.distance[i] = list.distance[i];
        pairs.right.x[i] = list.x[i + 1];
        pairs.right.y[i] = list.y[i + 1];
        pairs.right.distance[i] = list.distance[i + 1];
      }
      kernels.compare(pairs, size - 1);
      for (std::size_t i = 0; i + 1 < size; ++i) {
        kept.push_back(pairs.left_until[i]);
        kept.push_back(pairs.right_from[i]);
      }
      return kept;
    };
    const std::vector<const WindowKernels*> usable = window_kernels().usable();
    const std::vector<double> plain = results(*usable.front());
    for (const WindowKernels* variant : usable) {
      const std::vector<double> own = results(*variant);
      ASSERT_EQ(plain.size(), own.size());
      EXPECT_EQ(std::memcmp(plain.data(), own.data(), plain.size() * sizeof(double)), 0);
    }
  }
}

}  // namespace
}  // namespace seamwire
