// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>

namespace seamwire::detail {

/// The area in which a map is worst. Means of energies leave it out, because the tips of slits are there.
class WorstArea {
 public:
  /// The share of the whole area that is left out.
  static constexpr double kShare = 1e-3;

  explicit WorstArea(double whole) : size_(kShare * whole) {}

  /// The part of a triangle's area that counts in the mean. Ask in descending order of energy.
  double counted(double area) {
    const double counted = std::clamp(left_out_ + area - size_, 0.0, area);
    left_out_ += area - counted;
    return counted;
  }
  /// The area that was left out up to now.
  double left_out() const { return left_out_; }

 private:
  double size_, left_out_ = 0.0;
};

}  // namespace seamwire::detail
