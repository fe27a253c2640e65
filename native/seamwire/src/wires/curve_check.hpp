// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "detail/index.hpp"
#include "seamwire/surface/surface.hpp"

namespace seamwire::detail {

/// Whether two points are the same but for rounding. Where an embedding has collapsed a needle, points move by up to
/// 2^-22 of the model's longest side; and far away from the origin, coordinates themselves are rounded.
inline bool is_same_place(const Surface& surface, const Vector& a, const Vector& b) {
  constexpr double kSame = 1e-6, kRounded = 1e-14;
  const double scale = surface.scale();
  const double apart = (scale * (a - b)).cwiseAbs().maxCoeff();
  return apart <= kSame || apart <= kRounded * (scale * a).cwiseAbs().maxCoeff();
}

/// Throws InvalidInput, which begins with `what`, where a curve does not run over a surface, segment by segment in the
/// faces given. A segment without a face (-1) runs along an edge.
inline void check_curve(const Surface& surface, std::span<const Vector> points, std::span<const std::int32_t> faces,
                        const std::string& what) {
  if (faces.size() + 1 != points.size()) {
    throw InvalidInput(what + std::to_string(points.size()) + " points, but " + std::to_string(faces.size()) +
                       " faces");
  }
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (!points[i].allFinite()) throw InvalidInput(what + "point " + std::to_string(i) + " is not finite");
  }
  for (std::size_t i = 0; i < faces.size(); ++i) {
    if (faces[i] == -1) continue;
    check_index(faces[i], surface.face_count(), what + "face", "faces");
    const auto& [a, b, c] = surface.triangles()[faces[i]];
    const Vector &p = surface.points()[a], &q = surface.points()[b], &r = surface.points()[c];
    const Vector low = p.cwiseMin(q).cwiseMin(r), high = p.cwiseMax(q).cwiseMax(r);
    for (const std::size_t end : {i, i + 1}) {
      const Vector nearest = points[end].cwiseMax(low).cwiseMin(high);  // in the face's box
      if (is_same_place(surface, points[end], nearest)) continue;
      throw InvalidInput(what + "point " + std::to_string(end) + " does not lie in face " + std::to_string(faces[i]));
    }
  }
}

}  // namespace seamwire::detail
