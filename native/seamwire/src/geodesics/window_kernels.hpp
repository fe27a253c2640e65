// SPDX-License-Identifier: GPL-3.0-or-later
//
// The arithmetic of the wavefront, on all windows of a list at once.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "geodesics/window_lists.hpp"
#include "numeric/instruction_sets.hpp"

namespace seamwire::detail {

/// A window narrower than this part of its edge is dropped: what is missed next to it is of second order in the width.
inline constexpr double kLeastWidth = 1e-12;
/// Two windows are compared once their overlap is this part of the narrower one: less is not worth the roots.
inline constexpr double kLeastOverlap = 0.5;
/// A window's path to the apex may bend closer to an end of the base than this fraction of it. It is then the path over
/// that end, whose length is known better from the end itself.
inline constexpr double kCornerWidth = 1e-9;

/// Kernels work on whole vectors: each array they read or write has this many entries more, of any value. WindowBlocks
/// adds them to lists.
inline constexpr std::size_t kPadding = WindowBlocks::kPadding;

/// Working memory, kept from list to list. Its contents are lost when it grows.
template <class T>
class Scratch {
 public:
  T* room_for(std::size_t count) {
    if (memory_.size() < count + kPadding) memory_.resize(2 * count + kPadding);
    return memory_.data();
  }

 private:
  std::vector<T> memory_;
};

/// The triangle that windows enter over its base, in the base's frame.
struct BaseTriangle {
  double base, apex_x, apex_y;
};

/// The side of it over which they leave.
struct Side {
  double length, cosine, sine;  ///< of the direction from its tail to its tip, as the next triangle sees them
  double at_tail, at_tip;       ///< distances that are known there
};

/// The sources of one window of each pair, unfolded, and their distances.
struct Sources {
  double *x, *y, *distance;

  void set(std::size_t k, const Windows& windows, std::size_t i) const {
    x[k] = windows.x[i];
    y[k] = windows.y[i];
    distance[k] = windows.distance[i];
  }
};

/// Pairs of windows that are neighbors in a list and both cover an interval of the base.
struct Pairs {
  static constexpr std::size_t kColumns = 10;
  double *begin, *end;  ///< the interval
  Sources left, right;
  double *left_until, *right_from;  ///< out: where the left one ceases and the right one begins to be the nearer one

  static Pairs in(double* room, std::size_t stride) {
    const auto column = [&](std::size_t i) { return room + i * stride; };
    return {column(0), column(1), {column(2), column(3), column(4)}, {column(5), column(6), column(7)},
            column(8), column(9)};
  }
};

/// The windows that result where windows cross a side. Their distances and sources do not change.
struct ChildWindows {
  static constexpr std::size_t kColumns = 4;
  double *b0, *b1, *x, *y;
  std::int64_t* alive;  ///< 1, or 0 where the window does not reach the side, or cannot matter there

  static ChildWindows in(double* room, std::size_t stride, std::int64_t* alive) {
    return {room, room + stride, room + 2 * stride, room + 3 * stride, alive};
  }
};

struct WindowKernels {
  /// Writes 1 at i where windows i and i + 1 overlap so much that comparing them pays, 0 elsewhere (past the last pair
  /// anything). Returns whether the middles of the windows ascend.
  bool (*find_overlaps)(const Windows& windows, std::size_t count, std::int64_t* overlaps);
  /// Where it cannot tell, left_until is `end` and right_from `begin`.
  void (*compare)(const Pairs& pairs, std::size_t count);
  /// The apex projections: where the line from each source to the apex meets the base's line. And the apex distances:
  /// those of the apex on the path through each window that is nearest to straight; infinite for paths over a corner.
  void (*find_apex_distances)(const Windows& windows, std::size_t count, const BaseTriangle& triangle,
                              double* projections, double* apex_distances);
  /// The windows that go on over the left side, of what of them is left of `split`; returns how many.
  std::size_t (*to_left)(const Windows& windows, std::size_t count, const double* projections, double split,
                         const Side& side, const ChildWindows& children);
  /// Over the right one, right of `split`.
  std::size_t (*to_right)(const Windows& windows, std::size_t count, const double* projections, double split,
                          const BaseTriangle& triangle, const Side& side, const ChildWindows& children);
};

const InstructionSets<WindowKernels>& window_kernels();

}  // namespace seamwire::detail
