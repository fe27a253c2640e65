// SPDX-License-Identifier: GPL-3.0-or-later
#include "seamwire/surface/mirror_partners.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <string>
#include <unordered_map>
#include <utility>

#include "detail/drop_repeats.hpp"
#include "detail/half_edge.hpp"
#include "detail/index.hpp"
#include "detail/poll.hpp"
#include "seamwire/surface/nearest_points.hpp"
#include "seamwire/surface/triangle_connectivity.hpp"
#include "surface/twins.hpp"

namespace seamwire {

using namespace detail;

namespace {

/// Larger coordinates are no places: their squares would not be finite.
constexpr double kLargestPlace = 1e100;
/// How far from its image a vertex may be if no edges are known.
constexpr double kTolerance = 2e-5;
/// This part of an edge is less than half of the shortest edge at a vertex, and a quarter of an edge in a regular grid
/// of quads.
constexpr double kReach = 0.5;
/// How far in any case, as part of a vertex' coordinates: they are single precision, and have been transformed.
constexpr double kPlaceRounding = 1e-6;

bool is_place(const Vector& p) { return (p.array().abs() < kLargestPlace).all(); }

/// How far each vertex may be from its mirror image.
std::vector<double> reach_of(std::span<const Vector> points, const std::optional<std::vector<Edge>>& edges) {
  std::vector<double> reach(points.size(), kTolerance);
  if (!edges) return reach;
  std::vector<double> sums(points.size(), 0.0);
  for (const auto& [a, b] : *edges) {
    const double square = (points[a] - points[b]).squaredNorm(),
                 least = kPlaceRounding * points[a].cwiseAbs().maxCoeff();
    // An edge without a length tells nothing, and neither does one without places.
    if (!(square > least * least) || !std::isfinite(square)) continue;
    for (const std::int32_t v : {a, b}) sums[v] += 1.0 / square;
  }
  for (std::size_t v = 0; v < points.size(); ++v) {
    const double length = sums[v] > 0.0 ? 1.0 / std::sqrt(sums[v]) : 0.0;
    reach[v] = std::max(kReach * length, is_place(points[v]) ? kPlaceRounding * points[v].cwiseAbs().maxCoeff() : 0.0);
  }
  return reach;
}

std::vector<std::int32_t> partners_by_place(std::span<const Vector> points, const MirrorOptions& options,
                                            const Task& task) {
  std::vector<Vector> images(points.begin(), points.end());
  for (Vector& image : images) {
    for (int axis = 0; axis < 3; ++axis) {
      if (options.axes[axis]) image[axis] = -image[axis];
    }
  }
  const std::vector<std::int32_t> near = nearest_vertices(points, images, reach_of(points, options.edges), task);
  std::vector<std::int32_t> partners(points.size(), -1);
  // The search finds the first of several vertices in one place. The partner of the second one is the second of those
  // whose first one is the partner of the first, and so on: halves that mirror each other mostly have the same order.
  std::vector<std::pair<std::int32_t, std::int32_t>> others;  // the first one there, and another one
  for (std::int32_t v = 0; index(v) < points.size(); ++v) {
    const std::int32_t back = near[v] < 0 ? -1 : near[near[v]];
    if (back == v) partners[v] = near[v];
    if (back >= 0 && back != v && points[back] == points[v]) others.emplace_back(back, v);
  }
  std::ranges::sort(others);
  const auto first_of = [&](std::int32_t first) {
    return std::ranges::lower_bound(others, first, {}, &std::pair<std::int32_t, std::int32_t>::first);
  };
  for (auto at = others.begin(); at != others.end(); ++at) {
    const auto twin = first_of(near[at->second]);
    const auto rank = at - first_of(at->first);
    if (rank >= others.end() - twin || twin[rank].first != near[at->second]) continue;
    partners[at->second] = twin[rank].second;
  }
  return partners;
}

/// Grows partners over the polygons of a mesh.
class Growth {
 public:
  Growth(std::span<const Triangle> triangles, std::vector<Edge> edges, std::size_t vertex_count)
      : sides_(half_edges_by_edge(triangles)), vertex_count_(vertex_count) {
    mesh_.triangles.assign(triangles.begin(), triangles.end());
    mesh_.twins = twins_of(triangles, sides_);
    for (Edge& edge : edges) edge = ascending(edge[0], edge[1]);
    std::ranges::sort(edges);
    is_real_.resize(sides_.size());
    for (const auto& [edge, h] : sides_) is_real_[h] = std::ranges::binary_search(edges, edge);
    side_counts_.assign(sides_.size(), 0);
    for (std::int32_t h = 0; index(h) < sides_.size(); ++h) count_sides(h);
  }

  /// Returns the partners, from those by place. Partners by place stay where growth does not lead.
  std::vector<std::int32_t> partners(const std::vector<std::int32_t>& by_place, const Task& task) {
    constexpr std::size_t kTrials = 6;
    constexpr double kCredible = 0.5;   // the part of the pairs by place that growth has to find where it leads
    constexpr double kWellGrown = 0.9;  // the part of all pairs by place from which on no further edge is tried
    std::vector<Pair> known;
    for (std::int32_t h = 0; index(h) < sides_.size(); ++h) {
      const std::int32_t from = by_place[mesh_.tip(h)], to = by_place[mesh_.tail(h)];
      if (from < 0 || to < 0 || side_counts_[h] == 0) continue;
      const std::int32_t image = between(from, to);
      if (image >= 0) known.emplace_back(h, image);
    }
    std::vector<std::int32_t> best(vertex_count_, -1);
    const auto told = std::ranges::count_if(by_place, [](std::int32_t v) { return v >= 0; });
    std::ptrdiff_t most = 0;
    // In a pose, some edges happen to be where the image of another one would be. What grows from them disagrees with
    // places elsewhere, and soon meets itself.
    const std::size_t trials = std::min(kTrials, known.size());
    for (std::size_t i = 0; i < trials; ++i) {
      const std::size_t at = trials == 1 ? 0 : i * (known.size() - 1) / (trials - 1);
      std::vector<std::int32_t> grown(vertex_count_, -1);
      grow({known[at]}, grown, task);
      std::ptrdiff_t came = 0, agreed = 0;
      for (std::size_t v = 0; v < vertex_count_; ++v) {
        came += by_place[v] >= 0 && grown[v] >= 0 ? 1 : 0;
        agreed += by_place[v] >= 0 && grown[v] == by_place[v] ? 1 : 0;
      }
      if (agreed > most && static_cast<double>(agreed) > kCredible * static_cast<double>(came)) {
        most = agreed;
        best = std::move(grown);
      }
      if (static_cast<double>(most) >= kWellGrown * static_cast<double>(told)) break;
    }
    // Other parts of the mesh, from every edge whose place tells something.
    grow(std::move(known), best, task);
    std::vector<std::int32_t> all = best;
    for (std::size_t v = 0; v < vertex_count_; ++v) {
      if (best[v] < 0 && by_place[v] >= 0 && best[by_place[v]] < 0) all[v] = by_place[v];
    }
    return all;
  }

 private:
  using Pair = std::pair<std::int32_t, std::int32_t>;  // a half-edge and its image, or -1
  /// Where faces meet wrongly, a walk around a polygon may not come to an end.
  static constexpr std::size_t kMostSides = 4096;

  /// The half-edge beside another one in its polygon, past the diagonals; -1 where the polygon is not closed.
  template <class Step>
  std::int32_t beside(std::int32_t h, const Step& step) const {
    for (std::size_t i = 0; i < kMostSides && h >= 0; ++i) {
      h = step(h);
      if (is_real_[h]) return h;
      h = mesh_.twins[h];
    }
    return -1;
  }
  std::int32_t following(std::int32_t h) const { return beside(h, next_in_face); }
  std::int32_t preceding(std::int32_t h) const { return beside(h, previous_in_face); }

  /// Counts the half-edges of a polygon. The rims of holes have no polygon, and count 0.
  void count_sides(std::int32_t h) {
    if (side_counts_[h] != 0 || !is_real_[h]) return;
    std::vector<std::int32_t> around{h};
    for (std::int32_t at = following(h); at != h; at = following(at)) {
      if (at < 0 || around.size() == kMostSides) return;
      around.push_back(at);
    }
    for (const std::int32_t side : around) side_counts_[side] = static_cast<std::int32_t>(around.size());
  }

  std::int32_t between(std::int32_t from, std::int32_t to) const {
    const Edge edge = ascending(from, to);
    for (auto at = std::ranges::lower_bound(sides_, edge, {}, &HalfEdgesByEdge::value_type::first);
         at != sides_.end() && at->first == edge; ++at) {
      if (mesh_.tail(at->second) == from) return at->second;
    }
    return -1;
  }

  /// Enters the partners of all vertices that half-edges and their images lead to, unless they have others. Goes on in
  /// rings, so that of two ways to a vertex the shorter one counts.
  void grow(std::vector<Pair> ring, std::vector<std::int32_t>& partners, const Task& task) const {
    std::vector<std::int32_t> image_of(sides_.size(), -1);
    const Poll poll(task, 0.0, 0.0, 1, 1);
    for (std::size_t count = 0; !ring.empty(); ++count) {
      poll.at(count);
      std::erase_if(ring, [&](const Pair& pair) {
        const auto [h, image] = pair;
        return h < 0 || image < 0 || image_of[h] >= 0 || image_of[image] >= 0 || side_counts_[h] != side_counts_[image];
      });
      std::ranges::stable_sort(ring, {}, &Pair::first);
      drop_repeats(ring, &Pair::first);
      enter(ring, partners);
      std::erase_if(ring, [&](const Pair& pair) {
        const auto [h, image] = pair;
        return partners[mesh_.tail(h)] != mesh_.tip(image) || partners[mesh_.tip(h)] != mesh_.tail(image);
      });
      for (const auto& [h, image] : ring) image_of[h] = image;
      for (const auto& [h, image] : ring) image_of[image] = h;
      std::vector<Pair> next;
      for (const auto& [h, image] : ring) next.emplace_back(following(h), preceding(image));
      for (const auto& [h, image] : ring) next.emplace_back(preceding(h), following(image));
      for (const auto& [h, image] : ring) next.emplace_back(mesh_.twins[h], mesh_.twins[image]);
      ring = std::move(next);
    }
  }

  /// Makes the ends of half-edges and of their images partners if both are free, and no pair before has one of them.
  void enter(std::span<const Pair> ring, std::vector<std::int32_t>& partners) const {
    std::vector<Edge> pairs;
    for (const auto& [h, image] : ring) {
      for (const auto& [v, other] : {Pair{mesh_.tail(h), mesh_.tip(image)}, Pair{mesh_.tip(h), mesh_.tail(image)}}) {
        if (partners[v] < 0 && partners[other] < 0) pairs.push_back(ascending(v, other));
      }
    }
    std::ranges::sort(pairs);
    drop_repeats(pairs);
    std::unordered_map<std::int32_t, std::size_t> first;
    for (std::size_t i = 0; i < pairs.size(); ++i) {
      for (const std::int32_t v : pairs[i]) first.emplace(v, i);
    }
    for (std::size_t i = 0; i < pairs.size(); ++i) {
      const auto [v, other] = pairs[i];
      if (first[v] != i || first[other] != i) continue;
      partners[v] = other;
      partners[other] = v;
    }
  }

  HalfEdgesByEdge sides_;
  TriangleConnectivity mesh_;
  std::size_t vertex_count_;
  std::vector<bool> is_real_;
  std::vector<std::int32_t> side_counts_;
};

}  // namespace

std::vector<std::int32_t> nearest_vertices(std::span<const Vector> points, std::span<const Vector> places,
                                           std::span<const double> reach, const Task& task) {
  if (places.size() != reach.size()) {
    throw InvalidInput("There are " + std::to_string(places.size()) + " places, but " + std::to_string(reach.size()) +
                       " distances");
  }
  // A search would look at each of many vertices in one place, so only the first one is kept.
  std::vector<std::int32_t> rows;
  for (std::int32_t v = 0; index(v) < points.size(); ++v) {
    if (is_place(points[v])) rows.push_back(v);
  }
  const auto key = [&](std::int32_t v) { return std::array{points[v].x(), points[v].y(), points[v].z()}; };
  polled_sort(rows, Poll(task), {}, [&](std::int32_t v) { return std::pair(key(v), v); });
  drop_repeats(rows, key);
  std::ranges::sort(rows);
  std::vector<std::int32_t> found(places.size(), -1), asked;
  std::vector<Vector> kept, given;
  for (std::int32_t i = 0; index(i) < places.size(); ++i) {
    if (!is_place(places[i])) continue;
    asked.push_back(i);
    given.push_back(places[i]);
  }
  if (rows.empty() || asked.empty()) return found;
  std::vector<Triangle> corners;
  for (const std::int32_t v : rows) {
    const auto corner = static_cast<std::int32_t>(kept.size());
    corners.push_back({corner, corner, corner});
    kept.push_back(points[v]);
  }
  const std::vector<NearestPoint> nearest =
      NearestPoints(std::move(kept), std::move(corners), task).find(given, {}, task);
  for (std::size_t i = 0; i < asked.size(); ++i) {
    if (nearest[i].distance <= reach[asked[i]]) found[asked[i]] = rows[nearest[i].triangle];
  }
  return found;
}

std::vector<std::int32_t> mirror_partners(std::span<const Vector> points, const MirrorOptions& options,
                                          const Task& task) {
  const auto check = [&](const auto& rows, const std::string& what) {
    for (std::size_t i = 0; i < rows.size(); ++i) {
      for (const std::int32_t v : rows[i]) {
        if (!is_index(v, points.size())) check_index(v, points.size(), what + std::to_string(i) + ": vertex");
      }
    }
  };
  if (options.edges) check(*options.edges, "edge ");
  if (!options.triangles) return partners_by_place(points, options, task);
  check(*options.triangles, "triangle ");
  // Over several axes, the partner is that over the first one of the partner over the others.
  std::vector<std::int32_t> partners;
  MirrorOptions over = options;
  std::optional<Growth> growth;
  for (int axis = 2; axis >= 0; --axis) {
    if (!options.axes[axis]) continue;
    over.axes = {axis == 0, axis == 1, axis == 2};
    if (!growth) growth.emplace(*options.triangles, options.edges.value_or(std::vector<Edge>()), points.size());
    std::vector<std::int32_t> own = growth->partners(partners_by_place(points, over, task), task);
    for (std::int32_t& v : partners) v = v < 0 ? -1 : own[v];
    if (partners.empty()) partners = std::move(own);
  }
  return partners.empty() ? partners_by_place(points, options, task) : partners;
}

}  // namespace seamwire
