// SPDX-License-Identifier: GPL-3.0-or-later
#include "seamwire/edges/loop_offers.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <set>
#include <tuple>
#include <utility>

#include "detail/index.hpp"
#include "detail/infinity.hpp"
#include "edges/part_borders.hpp"
#include "edges/straight_ways.hpp"
#include "surface/point_segment.hpp"
#include "surface/real_edges.hpp"

namespace seamwire {

using namespace detail;

struct LoopOffers::Impl {
  Impl(std::shared_ptr<const Surface> of, std::shared_ptr<const EdgeAdjacency> with)
      : surface(std::move(of)), adjacency(std::move(with)), borders(*surface, *adjacency) {}

  std::shared_ptr<const Surface> surface;
  std::shared_ptr<const EdgeAdjacency> adjacency;
  PartBorders borders;
};

namespace {

using Sides = std::vector<Edge>;  // sorted
using Offers = std::vector<LoopOffer>;

/// How unlikely each kind is, in corners of a loop. Being of another kind than the last loop counts as a corner, too.
/// Fitted to the seams of artists, see docs/method/edges.md.
constexpr std::array kKindCosts{0.0, 0.2, 0.5, 0.7, 0.8};
constexpr double kLoopCrosses = 0.7, kStripCrosses = 0.2;
/// More corners and crossings tell no more.
constexpr std::int32_t kMostCorners = 3, kMostCrossings = 4;
/// Loops whose lengths differ by less count as equally long.
constexpr double kMuchShorter = 0.8;

Sides edges_of(const LoopOffer& offer) {
  Sides sides = sides_of(offer.vertices, offer.closed);
  std::ranges::sort(sides);
  return sides;
}

bool has_side(const LoopOffer& offer, const Edge& edge) {
  return std::ranges::binary_search(edges_of(offer), ascending(edge[0], edge[1]));
}

/// Leaves out offers that run along the same edges as an earlier one, and chains that are too short.
Offers distinct(Offers offers) {
  std::set<Sides> known;
  std::erase_if(offers, [&](const LoopOffer& offer) {
    Sides sides = edges_of(offer);
    for (const LoopOffer& other : offer.beside) std::ranges::copy(edges_of(other), std::back_inserter(sides));
    std::ranges::sort(sides);
    return offer.vertices.size() < (offer.closed ? 3 : 2) || !known.insert(std::move(sides)).second;
  });
  return offers;
}

class OfferSearch {
 public:
  OfferSearch(const Surface& surface, const EdgeAdjacency& adjacency, const PartBorders& borders,
              const LoopQuery& query)
      : points_(surface.points()),
        adjacency_(adjacency),
        surface_(surface),
        borders_(borders),
        query_(query),
        is_kept_(points_.size()),
        is_plane_(points_.size()),
        tubes_(borders) {
    const auto mark = [&](std::vector<bool>& marks, std::int32_t v, const char* what) {
      check_index(v, points_.size(), what);
      marks[v] = true;
    };
    for (const Edge& edge : query.kept) {
      for (const std::int32_t v : edge) mark(is_kept_, v, "kept: vertex");
      kept_.push_back(ascending(edge[0], edge[1]));
    }
    std::ranges::sort(kept_);
    for (const std::int32_t v : query.plane) mark(is_plane_, v, "plane: vertex");
    for (const std::int32_t v : query.shown) check_index(v, points_.size(), "shown: vertex");
    if (query.triangle >= 0) {
      check_index(query.triangle, surface.face_count(), "triangle", "triangles");
      triangle_ = borders.triangle_of(query.triangle);
    }
  }

  Offers find() {
    auto [offers, slit] = through(query_.picked);
    slits_.push_back(slit);
    add_face(offers, slit);
    add_crossing(offers);
    if (triangle_ >= 0 && !offers.empty()) add_parts(offers);
    return offers;
  }

 private:
  struct Found {
    Offers offers;
    Sides slit;  // the edges of the offer that slits the tube around the edge from rim to rim
  };

  /// What leads through an edge, the likeliest first.
  Found through(const LoopThrough& at) {
    const std::int32_t edge = adjacency_.checked(at.edge, "edge");
    for (const std::int32_t v : at.vertices) check_index(v, points_.size(), "loop: vertex");
    const Edge own = ascending(at.edge[0], at.edge[1]);
    Offers found{{LoopKind::kClosed, {at.vertices.begin(), at.vertices.end()}, true, own}};
    // An edge that is kept stops itself. What can be offered there is more than that.
    const bool is_taken = std::ranges::binary_search(kept_, own);
    const bool in_plane = is_plane_[own[0]] && is_plane_[own[1]];
    const auto is_stop = [&](std::int32_t v) { return !is_taken && (is_kept_[v] || (is_plane_[v] && !in_plane)); };
    const auto add = [&](LoopKind kind, EdgeLoop loop) {
      found.push_back({kind, std::move(loop.vertices), loop.closed, own});
    };
    if (!is_taken) {
      add(LoopKind::kStrip, edge_loop(adjacency_, edge, is_stop));
      add(LoopKind::kPast, straight_way(adjacency_, edge, is_stop));
    }
    const EdgeLoop whole = edge_loop(adjacency_, edge, [](std::int32_t) { return false; });
    add(LoopKind::kWhole, whole);
    Sides slit;
    if (std::optional<LoopOffer> way = slit_through(own, edge, is_stop)) {
      slit = edges_of(*way);
      found.push_back(std::move(*way));
    }
    for (VertexChain& border : borders_.borders(own)) found.push_back({LoopKind::kFlat, std::move(border), true, own});
    found = distinct(std::move(found));
    corners_ = at.corners;
    sort(found, slit);
    return {std::move(found), std::move(slit)};
  }

  /// The straight way that slits the tube around an edge, if the edge leads from rim to rim. Diagonals of a
  /// triangulated tube wind around it, so the shortest way through the edge or beside it is returned.
  template <class IsStop>
  std::optional<LoopOffer> slit_through(const Edge& own, std::int32_t edge, const IsStop& is_stop) {
    const std::vector<VertexChain>* const rims = tubes_.rims(own);
    if (rims == nullptr) return std::nullopt;
    const auto is_on = [](const VertexChain& rim, std::int32_t v) { return std::ranges::find(rim, v) != rim.end(); };
    std::vector<bool> is_end(points_.size());
    for (const VertexChain& rim : *rims) {
      for (const std::int32_t v : rim) is_end[v] = true;
    }
    const auto ends = [&](std::int32_t v) { return is_end[v] || is_stop(v); };
    const auto way = [&](std::int32_t from) -> std::optional<LoopOffer> {
      EdgeLoop found = straight_way(adjacency_, from, ends);
      if (found.closed || found.vertices.size() < 2) return std::nullopt;
      const std::int32_t first = found.vertices.front(), last = found.vertices.back();
      if (!ends(first) || !ends(last)) return std::nullopt;
      if (std::ranges::any_of(*rims, [&](const auto& rim) { return is_on(rim, first) && is_on(rim, last); })) {
        return std::nullopt;
      }
      const Edge through = ascending(adjacency_.tail(from), adjacency_.head(from));
      return LoopOffer{LoopKind::kStrip, std::move(found.vertices), false, through};
    };
    std::optional<LoopOffer> best = way(edge);
    if (!best) return best;
    // Of ways of the same length, that of the edge itself counts.
    const double length = length_of(points_, edges_of(*best));
    double least = 1.0;
    for (const Edge& other : tubes_.beside(own)) {
      std::optional<LoopOffer> beside = way(adjacency_.checked(other, "edge"));
      const double part = beside ? std::round(1e6 * length_of(points_, edges_of(*beside)) / length) / 1e6 : kInfinity;
      if (part >= least) continue;
      least = part;
      best = std::move(beside);
    }
    return best;
  }

  /// Puts the slit of a tube first, and hairpins last.
  void sort(Offers& offers, const Sides& slit) const {
    if (offers.size() < 2) return;
    std::vector<std::pair<std::tuple<bool, bool, double>, std::size_t>> order;
    for (std::size_t i = 0; i < offers.size(); ++i) {
      order.emplace_back(std::tuple(slit != edges_of(offers[i]), is_hairpin(offers[i]), unlikeliness(offers[i])), i);
    }
    std::ranges::sort(order);
    Offers sorted;
    for (const auto& [key, i] : order) sorted.push_back(std::move(offers[i]));
    offers = std::move(sorted);
  }

  /// Whether a loop is a hairpin. Edge loops may be narrow, as around a mouth, and so may borders of parts.
  bool is_hairpin(const LoopOffer& offer) const {
    if (!offer.closed || offer.kind == LoopKind::kFlat) return false;
    EdgeLoop ring =
        edge_loop(adjacency_, adjacency_.checked(offer.through, "edge"), [](std::int32_t) { return false; });
    std::vector<std::int32_t> own = offer.vertices;
    std::ranges::sort(ring.vertices);
    std::ranges::sort(own);
    return !(ring.closed && ring.vertices == own) && borders_.is_hairpin(offer.vertices);
  }

  /// How unlikely an offer is, in corners of a loop. A chain across seams and wires is less likely, and the next loop
  /// is likely of the same kind as the last one.
  double unlikeliness(const LoopOffer& offer) const {
    std::span<const std::int32_t> inner = offer.vertices;
    if (!offer.closed) inner = inner.subspan(1, inner.size() - 2);
    const auto crossings = std::min<std::ptrdiff_t>(
        std::ranges::count_if(inner, [&](std::int32_t v) { return is_kept_[v]; }), kMostCrossings);
    const double cost = kKindCosts[static_cast<std::size_t>(offer.kind)] + (query_.last == offer.kind ? 0.0 : 1.0);
    if (offer.kind != LoopKind::kClosed && offer.kind != LoopKind::kFlat) {
      return cost + kStripCrosses * static_cast<double>(crossings);
    }
    const std::int32_t corners =
        offer.kind == LoopKind::kClosed ? corners_ : count_corners(surface_, adjacency_, offer.vertices);
    return cost + kLoopCrosses * static_cast<double>(crossings) + std::min(corners, kMostCorners);
  }

  /// Adds the border of the flat face under the cursor, even if the edge lies inside that face.
  void add_face(Offers& offers, const Sides& slit) {
    if (triangle_ < 0 || offers.empty()) return;
    std::optional<LoopOffer> face = border(borders_.flat_face(triangle_));
    if (!face || std::ranges::any_of(offers, [&](const auto& o) { return edges_of(o) == edges_of(*face); })) return;
    const bool is_last = borders_.is_hairpin(face->vertices);
    offers.push_back(std::move(*face));
    if (!is_last) sort(offers, slit);
  }

  /// Adds the loop that crosses the edge at the cursor: second, or first where edges are short.
  void add_crossing(Offers& offers) {
    if (!query_.crossing || offers.empty()) return;
    const double own = unlikeliness(offers.front());
    auto [found, slit] = through(*query_.crossing);
    slits_.push_back(slit);
    const auto at = std::ranges::find_if(found, [&](const LoopOffer& offer) {
      if (offer.kind == LoopKind::kFlat || has_side(offer, query_.picked.edge)) return false;
      const Sides sides = edges_of(offer);
      return std::ranges::none_of(offers, [&](const auto& o) { return edges_of(o) == sides; }) && !is_hairpin(offer);
    });
    if (at == found.end()) return;
    const bool is_first = query_.is_close_call && crossing_first(offers.front(), own, *at, unlikeliness(*at));
    at->kind = LoopKind::kCrossing;
    offers.insert(offers.begin() + (is_first ? 0 : 1), std::move(*at));
  }

  /// Whether the crossing loop comes first: the chosen direction, the likelier one, the shorter one, the last one.
  bool crossing_first(const LoopOffer& own, double own_cost, const LoopOffer& crossing, double crossing_cost) const {
    const bool follows = query_.shown.size() > 1 && follows_shown();
    if (query_.is_chosen && query_.shown.size() > 1) return follows;
    if (own_cost != crossing_cost) return crossing_cost < own_cost;
    const double own_length = length_of(points_, edges_of(own)),
                 crossing_length = length_of(points_, edges_of(crossing));
    if (std::min(own_length, crossing_length) < kMuchShorter * std::max(own_length, crossing_length)) {
      return crossing_length < own_length;
    }
    return follows;
  }

  /// Whether the crossing edge runs more like the last loop, where that is nearest, than the picked edge does.
  bool follows_shown() const {
    const Vector middle = middle_of(query_.picked.edge);
    std::size_t nearest = 1;
    double least = kInfinity;
    for (std::size_t i = 1; i < query_.shown.size(); ++i) {
      const double gap = distance_to_segment(middle, points_[query_.shown[i - 1]], points_[query_.shown[i]]);
      if (gap < least) nearest = i;
      least = std::min(least, gap);
    }
    const Vector along = points_[query_.shown[nearest]] - points_[query_.shown[nearest - 1]];
    const auto cosine = [&](const Edge& edge) {
      const Vector own = points_[edge[1]] - points_[edge[0]];
      const double size = own.norm() * along.norm();
      return size > 0.0 ? std::abs(own.dot(along)) / size : 0.0;
    };
    return cosine(query_.crossing->edge) > cosine(query_.picked.edge);
  }

  /// Puts the borders of the part under the cursor first, if the cursor is inside a face. At an edge inside a small
  /// part, such as a bung, the rim of the part comes first. Otherwise the nearest border comes first, then the slit of
  /// a tube, then all borders at once, each of the others, and the borders of finer and coarser parts.
  void add_parts(Offers& offers) {
    Offers found;
    const auto add = [&](std::optional<LoopOffer> offer) {
      if (offer) found.push_back(std::move(*offer));
    };
    if (!query_.is_inside) {
      const std::optional<LoopOffer> rim = border(borders_.plug_rim(triangle_));
      if (!rim || has_side(*rim, query_.picked.edge)) return;
      add(rim);
    } else {
      std::vector<std::vector<VertexChain>> around = borders_.around(triangle_);
      for (auto& chains : around) {
        std::ranges::stable_sort(chains, {}, [&](const VertexChain& chain) { return nearest_side(chain).second; });
      }
      if (around.empty() || around.front().empty()) return;
      Offers own;
      for (const VertexChain& chain : around.front()) own.push_back(*border(chain));
      found.push_back(own.front());
      std::ranges::copy_if(offers, std::back_inserter(found), [&](const LoopOffer& offer) {
        return std::ranges::find(slits_, edges_of(offer)) != slits_.end();
      });
      if (own.size() > 1) {
        found.push_back(own.front());
        found.back().beside.assign(own.begin() + 1, own.end());
      }
      found.insert(found.end(), own.begin() + 1, own.end());
      for (const auto& chains : std::span(around).subspan(1)) {
        if (!chains.empty()) add(border(chains.front()));
      }
    }
    found.insert(found.end(), offers.begin(), offers.end());
    offers = distinct(std::move(found));
  }

  /// A border as an offer of the picked edge, along which it need not run; nullopt without a border.
  std::optional<LoopOffer> border(VertexChain chain) const {
    if (chain.empty()) return std::nullopt;
    const Edge own = ascending(query_.picked.edge[0], query_.picked.edge[1]);
    const Sides sides = sides_of(chain, true);
    const Edge through = std::ranges::find(sides, own) != sides.end() ? own : nearest_side(chain).first;
    return LoopOffer{LoopKind::kFlat, std::move(chain), true, through};
  }

  /// The edge of a closed chain that is nearest to the middle of the picked edge, and how far away it is.
  std::pair<Edge, double> nearest_side(const VertexChain& chain) const {
    const Vector middle = middle_of(query_.picked.edge);
    std::pair<Edge, double> best{{-1, -1}, kInfinity};
    for (const Edge& side : sides_of(chain, true)) {
      const double gap = distance_to_segment(middle, points_[side[0]], points_[side[1]]);
      if (gap < best.second) best = {side, gap};
    }
    return best;
  }

  Vector middle_of(const Edge& edge) const { return 0.5 * (points_[edge[0]] + points_[edge[1]]); }

  const std::vector<Vector>& points_;
  const EdgeAdjacency& adjacency_;
  const Surface& surface_;
  const PartBorders& borders_;
  const LoopQuery& query_;
  Sides kept_;
  std::vector<bool> is_kept_, is_plane_;
  Tubes tubes_;
  std::int32_t triangle_ = -1;
  std::int32_t corners_ = 0;  // of the closed chain in the metric
  std::vector<Sides> slits_;
};

}  // namespace

LoopOffers::LoopOffers(std::shared_ptr<const Surface> surface, std::shared_ptr<const EdgeAdjacency> adjacency) {
  adjacency->check_size(*surface);
  impl_ = std::make_shared<Impl>(std::move(surface), std::move(adjacency));
}

void LoopOffers::add_parts(std::span<const std::int32_t> labels) { impl_->borders.add_parts(labels); }

std::vector<LoopOffer> LoopOffers::find(const LoopQuery& query) const {
  return OfferSearch(*impl_->surface, *impl_->adjacency, impl_->borders, query).find();
}

std::vector<std::vector<std::int32_t>> LoopOffers::borders(const Edge& edge) const {
  impl_->adjacency->checked(edge, "edge");
  return impl_->borders.borders(edge);
}

}  // namespace seamwire
