// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>
#include <cstddef>

#include "metric/tangent_frame.hpp"
#include "seamwire/metric/curvature.hpp"

namespace seamwire::detail {

/// The second fundamental form in a frame: (mean + difference) u^2 + 2 mixed u v + (mean - difference) v^2. Turning the
/// frame by an angle leaves the mean, and turns (difference, mixed) back by twice that angle.
struct Form {
  double mean = 0.0, difference = 0.0, mixed = 0.0;
};

/// Gives a vertex the curvatures and directions of a form; where both curvatures are equal, directions stay.
inline void decompose(const TangentFrame& frame, const Form& form, std::size_t vertex, Curvature& curvature) {
  const double d = form.difference, m = form.mixed, radius = std::sqrt(d * d + m * m);
  const double signed_radius = form.mean < 0.0 ? -radius : radius;
  curvature.k1[vertex] = form.mean + signed_radius;
  curvature.k2[vertex] = form.mean - signed_radius;
  if (!(radius > 0.0)) return;
  // The direction of k1 is at half the angle of (d, m), or of (-d, -m) where the mean is negative.
  const double along = form.mean < 0.0 ? -d : d, across = form.mean < 0.0 ? -m : m;
  const double large = radius + std::abs(along), inverse = 1.0 / std::sqrt(2.0 * radius * large);
  const double c = (along < 0.0 ? across : large) * inverse, s = (along < 0.0 ? large : across) * inverse;
  const Vector v = frame.v();
  curvature.d1[vertex] = c * frame.u + s * v;
  curvature.d2[vertex] = c * v - s * frame.u;
}

}  // namespace seamwire::detail
