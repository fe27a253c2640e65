// SPDX-License-Identifier: GPL-3.0-or-later
#include "cut/joined_pieces.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <set>
#include <utility>

#include "cut/polygon_shape.hpp"
#include "cut/tolerances.hpp"
#include "surface/point_segment.hpp"

namespace seamwire::detail {
namespace {

/// Collects pieces, each once in either direction. Pieces in different polygons differ, except along a side.
class DistinctPieces {
 public:
  void add(const Piece& piece, bool is_on_side) {
    const auto [first, last] = std::minmax(piece.one, piece.two);
    if (known_.insert({first, last, is_on_side ? -1 : piece.polygon}).second) pieces.push_back(piece);
  }
  std::vector<Piece> pieces;

 private:
  std::set<std::array<std::int32_t, 3>> known_;
};

/// The ends of a piece, or of what it lies on: two vertices, or nothing.
std::optional<Edge> pair_of(const NodeTable& nodes, const Piece& piece) {
  Edge pair{-1, -1};
  for (const std::int32_t n : {piece.one, piece.two}) {
    for (const std::int32_t v : vertices_of(nodes[n])) {
      if (v == pair[0] || v == pair[1]) continue;
      if (pair[1] >= 0) return std::nullopt;
      pair[pair[0] < 0 ? 0 : 1] = v;
    }
  }
  if (pair[1] < 0) return std::nullopt;
  return Edge{std::min(pair[0], pair[1]), std::max(pair[0], pair[1])};
}

/// Lets nodes that are near each other between the same vertices be one.
std::vector<Piece> together(const NodeTable& nodes, std::span<const Piece> pieces) {
  std::map<std::int32_t, std::int32_t> same;
  for (const auto& [pair, own] : nodes_on_pairs(nodes, pieces)) {
    std::int32_t first = own.front();
    for (const std::int32_t n : own) {
      if (nodes[n].weights[1] - nodes[first].weights[1] > kCutNear) first = n;
      same[n] = first;
    }
  }
  std::map<std::pair<std::array<std::int32_t, 3>, std::int32_t>, std::vector<std::int32_t>> inside;
  for (const Piece& piece : pieces) {
    for (const std::int32_t n : {piece.one, piece.two}) {
      if (vertices_of(nodes[n]).size() < 3 || same.contains(n)) continue;
      std::vector<std::int32_t>& beside = inside[{nodes[n].vertices, nodes[n].polygon}];
      const auto first =
          std::ranges::find_if(beside, [&](std::int32_t other) { return is_near(nodes[n], nodes[other]); });
      same[n] = first == beside.end() ? n : *first;
      if (same[n] == n) beside.push_back(n);
    }
  }
  DistinctPieces kept;
  for (Piece piece : pieces) {
    for (std::int32_t* const n : {&piece.one, &piece.two}) {
      if (const auto found = same.find(*n); found != same.end()) *n = found->second;
    }
    if (piece.one != piece.two) kept.add(piece, false);
  }
  return std::move(kept.pieces);
}

/// Returns the pieces, cut where they cross others in the same polygon.
std::vector<Piece> crossed(const CutMesh& mesh, NodeTable& nodes, std::span<const Piece> pieces, const Task& task) {
  std::map<std::int32_t, std::vector<Piece>> by_polygon;
  for (const Piece& piece : pieces) by_polygon[piece.polygon].push_back(piece);
  std::vector<Piece> found;
  for (const auto& [polygon, own] : by_polygon) {
    if (own.size() == 1) {
      found.push_back(own.front());
      continue;
    }
    const PolygonShape shape(mesh, nodes, polygon);
    std::vector<std::vector<std::pair<double, std::int32_t>>> stops;
    std::vector<std::array<Vector, 2>> lines;
    for (const Piece& piece : own) {
      stops.push_back({{0.0, piece.one}, {1.0, piece.two}});
      lines.push_back({shape.seen(piece.one), shape.seen(piece.two)});
    }
    for (std::size_t i = 0; i < own.size(); ++i) {
      task.check(0.0);
      for (std::size_t j = i + 1; j < own.size(); ++j) {
        const Piece &a = own[i], &b = own[j];
        if (a.one == b.one || a.one == b.two || a.two == b.one || a.two == b.two) continue;
        const auto at = crossing_of(lines[i][0], lines[i][1], lines[j][0], lines[j][1]);
        if (!at) continue;
        const auto [s, t] = *at;
        // An end that lies near the other piece is where both meet.
        std::int32_t node = -1;
        for (const auto& [end, part] : {std::pair(a.one, s), {a.two, 1.0 - s}, {b.one, t}, {b.two, 1.0 - t}}) {
          if (node < 0 && part < kCutNear) node = end;
        }
        if (node < 0) {
          task.check(0.0);
          node = nodes.add(shape.node_at(lines[i][0] + s * (lines[i][1] - lines[i][0])));
        }
        stops[i].emplace_back(s, node);
        stops[j].emplace_back(t, node);
      }
    }
    for (auto& places : stops) {
      std::ranges::stable_sort(places, {}, &std::pair<double, std::int32_t>::first);
      for (std::size_t k = 1; k < places.size(); ++k) {
        if (places[k - 1].second != places[k].second)
          found.push_back({places[k - 1].second, places[k].second, polygon});
      }
    }
  }
  return found;
}

/// Returns the pieces, each once, those along an edge or a diagonal cut at the nodes of others that they pass.
std::vector<Piece> parted(const CutMesh& mesh, const NodeTable& nodes, std::span<const Piece> pieces) {
  const auto on_pairs = nodes_on_pairs(nodes, pieces);
  DistinctPieces kept;
  for (const Piece& piece : pieces) {
    const std::optional<Edge> pair = pair_of(nodes, piece);
    if (!pair) {
      kept.add(piece, false);
      continue;
    }
    const bool is_side = mesh.is_side(piece.polygon, (*pair)[0], (*pair)[1]);
    std::vector<std::int32_t> passed{piece.one, piece.two};
    const auto part = [&](std::int32_t n) { return weight_of(nodes[n], (*pair)[1]); };
    const auto [low, high] = std::minmax({part(piece.one), part(piece.two)});
    if (const auto passing = on_pairs.find({*pair, is_side ? -1 : piece.polygon}); passing != on_pairs.end()) {
      for (const std::int32_t n : passing->second) {
        if (n != piece.one && n != piece.two && low <= part(n) && part(n) <= high) passed.push_back(n);
      }
    }
    std::ranges::stable_sort(passed, {}, part);
    for (std::size_t i = 1; i < passed.size(); ++i) kept.add({passed[i - 1], passed[i], piece.polygon}, is_side);
  }
  return std::move(kept.pieces);
}

/// The numbers of the pieces beside each node.
std::map<std::int32_t, std::set<std::int32_t>> pieces_beside(std::span<const Piece> pieces) {
  std::map<std::int32_t, std::set<std::int32_t>> beside;
  for (std::int32_t number = 0; number < static_cast<std::int32_t>(pieces.size()); ++number) {
    beside[pieces[number].one].insert(number);
    beside[pieces[number].two].insert(number);
  }
  return beside;
}

std::vector<Piece> without(std::span<const Piece> pieces, const std::set<std::int32_t>& left_out) {
  std::vector<Piece> kept;
  for (std::int32_t number = 0; number < static_cast<std::int32_t>(pieces.size()); ++number) {
    if (!left_out.contains(number)) kept.push_back(pieces[number]);
  }
  return kept;
}

/// Pieces from a node on to where they branch or end.
struct Route {
  std::vector<std::int32_t> nodes;   ///< that they pass, including both ends
  std::vector<std::int32_t> pieces;  ///< their numbers
  std::vector<Vector> places;        ///< of the nodes
  double length = 0.0;
};

class SliverSearch {
 public:
  SliverSearch(const CutMesh& mesh, const NodeTable& nodes, std::span<const Piece> pieces, const CurveEnds& ends,
               const Task& task)
      : mesh_(mesh), nodes_(nodes), pieces_(pieces), ends_(ends), task_(task), beside_(pieces_beside(pieces)) {}

  std::set<std::int32_t> slivers() {
    std::set<std::int32_t> left_out;
    std::vector<std::int32_t> waiting;
    for (const auto& [node, own] : beside_) {
      if (own.size() > 2) waiting.push_back(node);
    }
    while (!waiting.empty()) {
      const std::int32_t start = waiting.back();
      waiting.pop_back();
      std::vector<Route> routes;
      for (const std::int32_t first : beside_[start]) {
        Route route = route_from(start, first);
        const std::int32_t end = route.nodes.back();
        if (end != start && !(ends_.contains(start) && ends_.contains(end))) routes.push_back(std::move(route));
      }
      const Route* const longer = longer_of_close(routes);
      if (longer == nullptr) continue;
      for (const std::int32_t number : longer->pieces) {
        beside_[pieces_[number].one].erase(number);
        beside_[pieces_[number].two].erase(number);
        left_out.insert(number);
      }
      waiting.push_back(start);
      waiting.push_back(longer->nodes.back());
    }
    return left_out;
  }

 private:
  Route route_from(std::int32_t start, std::int32_t first) const {
    Route route{.nodes = {start}, .pieces = {first}, .places = {}};
    for (;;) {
      const Piece& last = pieces_[route.pieces.back()];
      const std::int32_t here = last.one == route.nodes.back() ? last.two : last.one;
      route.nodes.push_back(here);
      const std::set<std::int32_t>& around = beside_.at(here);
      if (around.size() != 2 || here == start || ends_.contains(here)) break;
      route.pieces.push_back(*around.begin() == route.pieces.back() ? *around.rbegin() : *around.begin());
    }
    for (const std::int32_t n : route.nodes) {
      route.places.push_back(place_of(nodes_[n], mesh_));
      if (route.places.size() > 1) route.length += (route.places.back() - route.places[route.places.size() - 2]).norm();
    }
    return route;
  }

  /// Whether two routes between the same nodes are so close that they enclose next to nothing.
  bool are_close(const Route& one, const Route& other) const {
    const auto is_in_other = [&other](std::int32_t number) {
      return std::ranges::find(other.pieces, number) != other.pieces.end();
    };
    if (std::ranges::any_of(one.pieces, is_in_other)) return false;
    const double widest = kWide * mean_height(one, other);
    const auto lies_along = [this, widest](const Route& here, const Route& there) {
      return std::ranges::all_of(here.places, [&](const Vector& place) {
        task_.check(0.0);
        for (std::size_t i = 1; i < there.places.size(); ++i) {
          if (to_segment(place, there.places[i - 1], there.places[i]).norm() <= widest) return true;
        }
        return false;
      });
    };
    return lies_along(one, other) && lies_along(other, one);
  }

  /// The mean height, over its longest side, of the triangles that two routes pass.
  double mean_height(const Route& one, const Route& other) const {
    std::set<std::int32_t> polygons;
    for (const Route* route : {&one, &other}) {
      for (const std::int32_t number : route->pieces) polygons.insert(pieces_[number].polygon);
    }
    double sum = 0.0;
    std::int32_t count = 0;
    for (const std::int32_t polygon : polygons) {
      const Rows rows = mesh_.rows_of(polygon);
      for (std::int32_t row = rows.first; row < rows.last; ++row) {
        const auto [a, b, c] = mesh_.corners_of_triangle(row);
        const double longest = std::max({(b - a).norm(), (c - b).norm(), (a - c).norm()});
        if (longest > 0.0) sum += (b - a).cross(c - a).norm() / longest;
        ++count;
      }
    }
    return sum / count;
  }

  /// Returns the longer one of the first two close routes between the same nodes; null without such routes.
  const Route* longer_of_close(std::span<const Route> routes) const {
    for (std::size_t i = 0; i < routes.size(); ++i) {
      for (std::size_t j = i + 1; j < routes.size(); ++j) {
        if (routes[i].nodes.back() != routes[j].nodes.back() || !are_close(routes[i], routes[j])) continue;
        return routes[j].length > routes[i].length ? &routes[j] : &routes[i];
      }
    }
    return nullptr;
  }

  const CutMesh& mesh_;
  const NodeTable& nodes_;
  std::span<const Piece> pieces_;
  const CurveEnds& ends_;
  const Task& task_;
  std::map<std::int32_t, std::set<std::int32_t>> beside_;
};

}  // namespace

void CurveEnds::add(std::span<const Piece> pieces) {
  std::vector<std::int32_t> passed;
  for (const Piece& piece : pieces) {
    passed.push_back(piece.one);
    passed.push_back(piece.two);
  }
  std::erase_if(passed, [this](std::int32_t n) { return nodes_[n].polygon >= 0; });
  if (passed.empty()) return;
  for (const std::int32_t n : {passed.front(), passed.back()}) at_[nodes_[n].vertices].push_back(n);
}

bool CurveEnds::contains(std::int32_t node) const {
  const auto found = at_.find(nodes_[node].vertices);
  if (found == at_.end()) return false;
  return std::ranges::any_of(found->second, [&](std::int32_t end) { return is_near(nodes_[node], nodes_[end]); });
}

std::vector<Piece> without_detours(std::span<const Piece> pieces) {
  std::vector<Piece> kept;
  std::map<std::int32_t, std::size_t> number_at;
  for (const Piece& piece : pieces) {
    number_at.try_emplace(piece.one, kept.size());
    kept.push_back(piece);
    const auto found = number_at.find(piece.two);
    if (found == number_at.end() || found->second == 0) continue;  // at 0 a closed curve ends where it began
    const std::size_t before = found->second;
    for (std::size_t i = before; i < kept.size(); ++i) {
      if (kept[i].one != piece.two) number_at.erase(kept[i].one);
    }
    kept.resize(before);
  }
  return kept;
}

std::vector<Piece> joined(const CutMesh& mesh, NodeTable& nodes, std::vector<Piece> pieces, const Task& task) {
  pieces = crossed(mesh, nodes, together(nodes, pieces), task);
  return parted(mesh, nodes, together(nodes, pieces));
}

std::vector<Piece> without_slivers(const CutMesh& mesh, const NodeTable& nodes, std::span<const Piece> pieces,
                                   const CurveEnds& ends, const Task& task) {
  return without(pieces, SliverSearch(mesh, nodes, pieces, ends, task).slivers());
}

std::vector<Piece> without_spurs(const NodeTable& nodes, std::span<const Piece> pieces, const CurveEnds& ends) {
  std::map<std::int32_t, std::set<std::int32_t>> beside = pieces_beside(pieces);
  const auto is_loose = [&](std::int32_t n) {
    return beside[n].size() == 1 && vertices_of(nodes[n]).size() > 1 && !ends.contains(n);
  };
  std::vector<std::int32_t> waiting;
  for (const auto& [node, own] : beside) {
    if (is_loose(node)) waiting.push_back(node);
  }
  std::set<std::int32_t> left_out;
  while (!waiting.empty()) {
    const std::int32_t node = waiting.back();
    waiting.pop_back();
    if (beside[node].empty()) continue;
    const std::int32_t number = *beside[node].begin();
    left_out.insert(number);
    for (const std::int32_t end : {pieces[number].one, pieces[number].two}) {
      beside[end].erase(number);
      if (is_loose(end)) waiting.push_back(end);
    }
  }
  return without(pieces, left_out);
}

bool is_along_side(const CutMesh& mesh, const NodeTable& nodes, const Piece& piece) {
  const std::optional<Edge> pair = pair_of(nodes, piece);
  return pair && mesh.is_side(piece.polygon, (*pair)[0], (*pair)[1]);
}

}  // namespace seamwire::detail
