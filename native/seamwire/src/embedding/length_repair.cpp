// SPDX-License-Identifier: GPL-3.0-or-later
#include "embedding/length_repair.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "detail/half_edge.hpp"
#include "detail/poll.hpp"
#include "embedding/bisection.hpp"

namespace seamwire::detail {
namespace {

// Of the interval that the triangle inequality leaves for the length of a new edge, the part kept free at either end.
constexpr double kMargin = 1.0 / 16;
// A triangle whose shortest edge is shorter than this fraction of its longest one leaves no interval in double
// precision.
constexpr double kNeedle = 1e-8;

// Whether a triangle is invalid without being a part of a degenerate face.
bool needs_length_repair(const BisectedMesh& mesh, std::int32_t f) {
  return !mesh.is_valid(f) && !mesh.is_of_degenerate_face(f);
}

bool is_repairable(const BisectedMesh& mesh, std::int32_t f) {
  const double *l = &mesh.lengths[3 * index(f)], least = std::min({l[0], l[1], l[2]});
  return needs_length_repair(mesh, f) && least > kNeedle * std::max({l[0], l[1], l[2]});
}

// Edges are in one strict order, that of their lengths and then of their numbers.
std::int32_t longest_edge(const BisectedMesh& mesh, std::int32_t f) {
  const auto key = [&](std::int32_t h) { return std::pair(mesh.lengths[h], first_of_edge(mesh, h)); };
  return std::ranges::max(std::array{3 * f, 3 * f + 1, 3 * f + 2}, {}, key);
}

// Sets the length of the edge h from the middle of an edge to the apex. The measured length is clamped so that the
// triangle inequality holds with the edge's halves and the other two sides.
void set_clamped_length(BisectedMesh& mesh, std::int32_t h, double half, double next_side, double last_side,
                        LengthRepair& repair) {
  const double low = std::max(std::abs(half - next_side), std::abs(half - last_side));
  const double high = half + std::min(next_side, last_side), margin = kMargin * (high - low);
  const double measured = mesh.measure(h);
  const double length = margin > 0 ? std::clamp(measured, low + margin, high - margin) : measured;
  mesh.set_length(h, length);
  if (length == measured) return;
  ++repair.clamped_edges;
  repair.faces.push_back(mesh.origins[h / 3]);
  repair.worst_clamp = std::max({repair.worst_clamp, length / measured, measured / length});
}

// A triangle at an edge, and its sides after that edge.
struct Side {
  std::int32_t face;
  double next, last;
};

// Bisects an edge, halves its length and clamps those of the new edges. The triangles there are `sides`.
void bisect_clamped(BisectedMesh& mesh, std::int32_t h, const std::vector<Side>& sides, LengthRepair& repair) {
  const double half = mesh.lengths[h] / 2;
  const auto count = static_cast<std::int32_t>(mesh.face_count());
  mesh.bisect(h);
  mesh.set_length(h, half);
  mesh.set_length(3 * count, half);
  std::int32_t inner = 3 * count + 2;
  for (const Side& side : sides) {
    set_clamped_length(mesh, inner, half, side.next, side.last, repair);
    inner += 3;
  }
}

}  // namespace

LengthRepair repair_lengths(BisectedMesh& mesh, const EmbedOptions& options, const Task& task, double progress) {
  LengthRepair repair;
  std::vector<std::int32_t> todo;
  const Poll poll(task, progress, progress, mesh.face_count());
  for (std::int32_t f = 0; index(f) < mesh.face_count(); ++f) {
    poll.at(index(f));
    if (is_repairable(mesh, f)) todo.push_back(f);
  }
  std::vector<std::int32_t> chain;  // triangles to bisect, the last one first
  std::vector<Side> sides;
  for (std::size_t i = 0; i < todo.size(); ++i) {
    if ((i + 1) % kBisectionsBetweenChecks == 0) task.check(progress);
    if (!is_repairable(mesh, todo[i])) continue;
    chain.assign(1, todo[i]);
    while (!chain.empty()) {
      const std::int32_t h = longest_edge(mesh, chain.back());
      // An invalid neighbor can be repaired at its longest edge only, which is longer than this one.
      std::int32_t before = -1;
      sides.clear();
      const auto look_at = [&](std::int32_t side) {
        const std::int32_t next = next_in_face(side);
        sides.push_back({side / 3, mesh.lengths[next], mesh.lengths[next_in_face(next)]});
        if (before >= 0 || side == h || !is_repairable(mesh, side / 3)) return;
        if (longest_edge(mesh, side / 3) != side) before = side / 3;
      };
      look_at(h);
      mesh.for_each_beyond(h, look_at);
      if (before >= 0) {
        chain.push_back(before);
        continue;
      }
      if (mesh.faces_added() + std::max<std::size_t>(2, sides.size()) > options.max_faces_added) {
        repair.is_complete = false;
        repair.hit_cap = true;
        return repair;
      }
      auto part = static_cast<std::int32_t>(mesh.face_count());
      bisect_clamped(mesh, h, sides, repair);
      // Rounding may leave one of them invalid.
      for (const Side& side : sides) {
        for (const std::int32_t f : {side.face, part++}) {
          if (is_repairable(mesh, f)) todo.push_back(f);
        }
      }
      chain.pop_back();
    }
  }
  for (std::int32_t f = 0; repair.is_complete && index(f) < mesh.face_count(); ++f) {
    repair.is_complete = !needs_length_repair(mesh, f);
  }
  return repair;
}

}  // namespace seamwire::detail
