// SPDX-License-Identifier: GPL-3.0-or-later
#include "seamwire/wires/plane_section.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "detail/half_edge.hpp"
#include "detail/index.hpp"
#include "geodesics/placed_point.hpp"
#include "seamwire/errors.hpp"
#include "surface/corner_fans.hpp"
#include "surface/face_height.hpp"
#include "wires/polyline.hpp"

namespace seamwire {

using namespace detail;

namespace {

// The sine of the least angle between the direction and the line through the points.
constexpr double kLeastSine = 1e-9;

struct End {
  Vector place;
  std::int32_t vertex = -1;         // the caller's
  std::vector<std::int32_t> faces;  // of the corner fans: those that it lies in, or around the vertex
};

class Section {
 public:
  Section(const Surface& surface, const SurfacePoint& from, const SurfacePoint& to, const Vector& direction)
      : surface_(surface),
        fans_(corner_fans(surface)),
        from_(end(from, "from")),
        to_(end(to, "to")),
        is_last_(fans_.triangles.size(), 0) {
    for (const std::int32_t face : to_.faces) is_last_[face] = 1;
    if (!direction.allFinite()) throw InvalidInput("direction is not finite");
    const Vector between = to_.place - from_.place;
    if (between.isZero(0.0)) throw InvalidInput("both points are the same");
    const Vector normal = direction.stableNormalized().cross(between.stableNormalized());
    if (!(normal.norm() > kLeastSine)) {
      throw InvalidInput("direction has no length, or leads from one point to the other: it makes no plane with them");
    }
    heights_.reserve(surface.vertex_count());
    for (const Vector& p : surface.points()) heights_.push_back(normal.dot(p - from_.place));
    for (const End* at : {&from_, &to_}) {
      if (at->vertex != -1) heights_[at->vertex] = 0.0;
    }
  }

  // A vertex in the plane counts as on one side of it: then the curve is a chain of segments across faces. Which side
  // makes a difference where the curve runs along edges, or touches a vertex.
  PlaneSection shortest() {
    for (const std::int32_t face : from_.faces) {
      if (is_last_[face] != 0) return straight(face);
    }
    PlaneSection best;
    for (const bool is_zero_above : {true, false}) {
      is_zero_above_ = is_zero_above;
      for (const std::int32_t face : from_.faces) {
        for (std::int32_t side = 3 * face; side < 3 * face + 3; ++side) {
          // Over a side at the first vertex it only goes on around it, into a face that comes too.
          if (from_.vertex != -1 && (tail(side) == from_.vertex || head(side) == from_.vertex)) continue;
          if (!is_crossed(side)) continue;
          PlaneSection found = walk(face, side);
          if (found.length < best.length) best = std::move(found);
        }
      }
    }
    return best;
  }

 private:
  std::int32_t tail(std::int32_t half_edge) const { return fans_.vertices[fans_.tail(half_edge)]; }
  std::int32_t head(std::int32_t half_edge) const { return tail(next_in_face(half_edge)); }

  End end(const SurfacePoint& point, const std::string& what) const {
    End end;
    if (point.vertex >= 0) {
      check_index(point.vertex, surface_.vertex_count(), what + ": vertex");
      end.vertex = point.vertex;
    } else {
      check_index(point.face, surface_.face_count(), what + ": face", "faces");
      const std::array<double, 3> weights = checked_barycentric(point.barycentric, what);
      const Triangle& corners = surface_.triangles()[point.face];
      end.place = Vector::Zero();
      for (std::size_t i = 0; i < 3; ++i) {
        end.place += weights[i] * surface_.points()[corners[i]];
        if (weights[(i + 1) % 3] == 0.0 && weights[(i + 2) % 3] == 0.0) end.vertex = corners[i];
      }
      if (end.vertex == -1) {
        end.faces = half_edge_faces(surface_, {point.face});
        if (end.faces.empty()) return end;  // a face that was left out
        const std::int32_t face = end.faces.front();
        for (std::int32_t side = 3 * face; side < 3 * face + 3; ++side) {
          const std::int32_t apex = tail(next_in_face(next_in_face(side)));
          const auto corner = std::ranges::find(corners, apex) - corners.begin();
          // Where the edge lies in the plane but for rounding, the curve may run on its other side alone.
          if (weights[corner] != 0.0) continue;
          fans_.for_each_beyond(side, [&](std::int32_t other) { end.faces.push_back(other / 3); });
        }
        return end;
      }
    }
    end.place = surface_.points()[end.vertex];
    for (std::size_t f = 0; f < fans_.triangles.size(); ++f) {
      const auto side = static_cast<std::int32_t>(3 * f);
      if (tail(side) == end.vertex || tail(side + 1) == end.vertex || tail(side + 2) == end.vertex) {
        end.faces.push_back(side / 3);
      }
    }
    return end;
  }

  bool is_above(std::int32_t v) const { return is_zero_above_ ? heights_[v] >= 0.0 : heights_[v] > 0.0; }
  bool is_crossed(std::int32_t half_edge) const { return is_above(tail(half_edge)) != is_above(head(half_edge)); }

  Vector crossing(std::int32_t half_edge) const {
    std::int32_t a = tail(half_edge), b = head(half_edge);
    // Always from below, so that both faces at an edge have the same point.
    if (is_above(a)) std::swap(a, b);
    if (heights_[a] == 0.0) return surface_.points()[a];
    if (heights_[b] == 0.0) return surface_.points()[b];
    const double part = heights_[a] / (heights_[a] - heights_[b]);
    return surface_.points()[a] + part * (surface_.points()[b] - surface_.points()[a]);
  }

  void add(PlaneSection& section, const Vector& place, std::int32_t face) const {
    if (place == section.points.back()) return;
    section.points.push_back(place);
    section.faces.push_back(fans_.faces[face]);
  }

  // Within a face that has both points: it may lie in the plane as a whole, and is crossed nowhere then.
  PlaneSection straight(std::int32_t face) const {
    return {
        .points = {from_.place, to_.place}, .faces = {fans_.faces[face]}, .length = (to_.place - from_.place).norm()};
  }

  // A curve that has come to a face and leaves it over one of its sides.
  struct Branch {
    PlaneSection section;
    std::int32_t face, side;
    double length = 0.0;
  };

  // The shortest curve from the first point out of a face over one of its sides. The curve forks at edges with three or
  // more faces. Of branches that enter the same face there over the same edge, only those that are shorter than each
  // one before go on.
  PlaneSection walk(std::int32_t first, std::int32_t side) const {
    PlaneSection best;
    std::map<std::int32_t, double> least;  // by the half-edge entered
    std::vector<Branch> branches(1);
    branches.front().section.points.push_back(from_.place);
    branches.front().face = first;
    branches.front().side = side;
    while (!branches.empty()) {
      Branch branch = std::move(branches.back());
      branches.pop_back();
      follow(first, branch, [&](std::int32_t entered) {
        const auto [at, is_new] = least.try_emplace(entered, branch.length);
        if (!is_new && !(branch.length < at->second)) return;
        at->second = branch.length;
        branches.push_back({branch.section, entered / 3, next_side(entered), branch.length});
      });
      if (branch.section.length < best.length) best = std::move(branch.section);
    }
    return best;
  }

  // The side over which the curve leaves a face that it entered.
  std::int32_t next_side(std::int32_t entered) const {
    return is_crossed(next_in_face(entered)) ? next_in_face(entered) : next_in_face(next_in_face(entered));
  }

  // To the second point, which gives the curve a length, or to where it ends or forks: then calls enter(half_edge) for
  // each half-edge over which it may go on.
  template <class Enter>
  void follow(std::int32_t first, Branch& branch, const Enter& enter) const {
    while (true) {
      const std::int32_t side = branch.side;
      if (to_.vertex == -1 && is_last_[branch.face] != 0) break;
      add(branch.section, crossing(side), branch.face);
      if (to_.vertex != -1 && (tail(side) == to_.vertex || head(side) == to_.vertex)) break;
      const std::int32_t twin = fans_.twins[side];
      if (twin == -1) {
        branch.length = length_of(branch.section.points);
        fans_.for_each_beyond(side, enter);
        return;
      }
      if (twin / 3 == first) return;
      branch.face = twin / 3;
      branch.side = next_side(twin);
    }
    add(branch.section, to_.place, branch.face);
    branch.section.length = length_of(branch.section.points);
  }

  const Surface& surface_;
  const CornerFans& fans_;
  End from_, to_;
  std::vector<std::uint8_t> is_last_;  // of each face of the corner fans: 1 if the second point lies in it
  std::vector<double> heights_;
  bool is_zero_above_ = true;
};

}  // namespace

PlaneSection plane_section(const Surface& surface, const SurfacePoint& from, const SurfacePoint& to,
                           const Vector& direction) {
  return Section(surface, from, to, direction).shortest();
}

}  // namespace seamwire
