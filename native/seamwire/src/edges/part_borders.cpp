// SPDX-License-Identifier: GPL-3.0-or-later
#include "edges/part_borders.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <numeric>
#include <string>
#include <unordered_set>

#include "detail/csr.hpp"
#include "detail/half_edge.hpp"
#include "detail/index.hpp"
#include "surface/real_edges.hpp"

namespace seamwire::detail {

namespace {

/// Edges of a border. Longer borders go around so much that nobody wants them at once.
constexpr std::size_t kLongestBorder = 20'000;
/// Triangles of a flat face. Around larger ones nobody needs help.
constexpr std::size_t kLargestPlane = 50'000;
constexpr std::size_t kLargestWall = 10'000;
/// Two faces lie in a plane if the cosine between their normals is at least that of 1 degree.
constexpr double kInPlane = 0.99984769515639123916;
/// Two faces meet at a rim if it is below that of 65 degrees. The sides of a tube with six corners meet at 60 degrees.
constexpr double kSharp = 0.42261826174069943619;
/// A flat fan of at least so many faces is a lid.
constexpr std::int32_t kLidCorners = 8;
constexpr std::size_t kMostLids = 16;
/// The part of the area up to which a part inside of another one is a plug.
constexpr double kPlug = 0.02;
/// Faces around a vertex. How a chain turns at the middle of a larger fan is not known.
constexpr int kMostAround = 512;
/// A chain that turns so far within the surface comes back: up, over a rim, and down again.
constexpr double kBend = 0.75 * std::numbers::pi;
/// The part of its length within which it does so. Around two square faces in a row it takes a sixth.
constexpr double kShortWay = 0.165;
/// A chain that turns so far in all goes around a patch, and not around a limb.
constexpr double kCircle = 1.5 * std::numbers::pi;
constexpr std::size_t kFewEdges = 6;
/// Such a circle of few edges is tiny if the square of its length is below this part of the surface's area.
constexpr double kTiny = 0.2;

bool is_simple(const VertexChain& chain) {
  return chain.size() > 2 && std::unordered_set<std::int32_t>(chain.begin(), chain.end()).size() == chain.size();
}

/// Whether a closed chain turns back on a part of it that is at most `way` long.
bool doubles_back(std::span<const double> turns, std::span<const double> lengths, double way) {
  const std::size_t n = turns.size();
  std::vector<double> at(2 * n, 0.0), sums(2 * n + 1, 0.0);
  const double total = std::accumulate(lengths.begin(), lengths.end(), 0.0);
  for (std::size_t i = 1; i < n; ++i) at[i] = at[i - 1] + lengths[i - 1];
  for (std::size_t i = 0; i < n; ++i) at[n + i] = at[i] + total;
  for (std::size_t i = 0; i < 2 * n; ++i) sums[i + 1] = sums[i] + turns[i % n];
  for (std::size_t first = 0; first < n; ++first) {
    const double end = at[first] + way * (1.0 + 1e-9);
    for (std::size_t i = first; i < 2 * n && at[i] <= end; ++i) {
      if (std::abs(sums[i + 1] - sums[first]) >= kBend) return true;
    }
  }
  return false;
}

}  // namespace

std::vector<Edge> sides_of(std::span<const std::int32_t> chain, bool closed) {
  std::vector<Edge> sides;
  for (std::size_t i = 1; i < chain.size(); ++i) sides.push_back(ascending(chain[i - 1], chain[i]));
  if (closed && !chain.empty()) sides.push_back(ascending(chain.back(), chain.front()));
  return sides;
}

double length_of(const std::vector<Vector>& points, std::span<const Edge> edges) {
  double length = 0.0;
  for (const auto& [a, b] : edges) length += (points[b] - points[a]).norm();
  return length;
}

PartBorders::PartBorders(const Surface& surface, const EdgeAdjacency& adjacency)
    : surface_(surface), adjacency_(adjacency), mesh_(corner_fans(surface)) {
  for (const Triangle& t : mesh_.triangles) {
    const auto at = [&](std::size_t i) -> const Vector& { return surface.points()[mesh_.vertices[t[i]]]; };
    const Vector normal = (at(1) - at(0)).cross(at(2) - at(0));
    const double length = normal.norm();
    areas_.push_back(0.5 * length);
    normals_.push_back(length > 0.0 ? Vector(normal / length) : Vector::Zero());
  }
  area_ = std::accumulate(areas_.begin(), areas_.end(), 0.0);
}

void PartBorders::add_parts(std::span<const std::int32_t> labels) {
  if (labels.size() != surface_.face_count()) {
    throw InvalidInput("There are " + std::to_string(labels.size()) + " labels for " +
                       std::to_string(surface_.face_count()) + " triangles");
  }
  Parts parts;
  for (const std::int32_t face : mesh_.faces) {
    parts.labels.push_back(labels[face]);
    check_index(labels[face], labels.size(), "triangle " + std::to_string(face) + ": part", "triangles");
  }
  const std::int32_t count = parts.labels.empty() ? 0 : std::ranges::max(parts.labels) + 1;
  const Csr<std::int32_t> triangles(index(count), [&](const auto& visit) {
    for (std::int32_t t = 0; index(t) < parts.labels.size(); ++t) visit(parts.labels[t], t);
  });
  for (std::int32_t part = 0; part < count; ++part) {
    parts.regions.push_back(
        region_of(triangles[part], [&](std::int32_t triangle) { return parts.labels[triangle] == part; }));
    parts.areas.push_back(0.0);
    for (const std::int32_t t : triangles[part]) parts.areas.back() += areas_[t];
  }
  steps_.push_back(std::move(parts));
}

std::int32_t PartBorders::triangle_of(std::int32_t face) const {
  const auto at = std::ranges::lower_bound(mesh_.faces, face);
  return at != mesh_.faces.end() && *at == face ? static_cast<std::int32_t>(at - mesh_.faces.begin()) : -1;
}

std::vector<VertexChain> PartBorders::borders(const Edge& edge) const {
  const Edge own = ascending(edge[0], edge[1]);
  std::vector<VertexChain> found;
  for (const Parts& parts : steps_) {
    const std::size_t begin = found.size();
    for (const std::int32_t side : half_edges_of(edge)) {
      for (VertexChain& chain : borders_of(parts, side / 3)) {
        const std::vector<Edge> around = sides_of(chain, true);
        if (std::ranges::find(around, own) != around.end()) found.push_back(std::move(chain));
      }
    }
    std::ranges::stable_sort(std::span(found).subspan(begin), {}, [](const auto& chain) { return chain.size(); });
  }
  return found;
}

std::vector<std::vector<VertexChain>> PartBorders::around(std::int32_t triangle) const {
  std::vector<std::vector<VertexChain>> found;
  for (const Parts& parts : steps_) found.push_back(borders_of(parts, triangle));
  return found;
}

VertexChain PartBorders::plug_rim(std::int32_t triangle) const {
  for (const Parts& parts : steps_) {
    const std::int32_t part = parts.labels[triangle];
    if (parts.areas[part] > kPlug * area_ || parts.regions[part].borders.size() != 1) continue;
    const std::vector<VertexChain> own = borders_of(parts, triangle);
    if (!own.empty()) return own.front();
  }
  return {};
}

VertexChain PartBorders::flat_face(std::int32_t triangle) const {
  const Triangles plane = plane_around(triangle);
  VertexChain longest;
  double most = -1.0;
  for (const Numbers& border : region_of(plane.numbers, [&](std::int32_t t) { return plane.contains[t]; }).borders) {
    VertexChain chain = chain_of(border);
    const double length = length_of(surface_.points(), sides_of(chain, true));
    if (length <= most) continue;
    most = length;
    longest = std::move(chain);
  }
  return is_simple(longest) ? longest : VertexChain();
}

bool PartBorders::is_hairpin(std::span<const std::int32_t> chain) const {
  const std::vector<double> turned = turns(chain);
  std::vector<double> lengths;
  for (const Edge& side : sides_of(chain, true)) lengths.push_back(length_of(surface_.points(), {&side, 1}));
  const double length = std::accumulate(lengths.begin(), lengths.end(), 0.0);
  const bool is_tiny = chain.size() <= kFewEdges && length * length < kTiny * area_;
  return (is_tiny && std::abs(std::accumulate(turned.begin(), turned.end(), 0.0)) >= kCircle) ||
         doubles_back(turned, lengths, kShortWay * length);
}

std::vector<double> PartBorders::turns(std::span<const std::int32_t> chain) const {
  const std::size_t n = chain.size();
  const auto is_open = [&](std::int32_t a, std::int32_t b) {
    const std::int32_t there = half_edge(a, b), h = there < 0 ? half_edge(b, a) : there;
    return h >= 0 && is_boundary(h);
  };
  std::vector<double> found(n, 0.0);
  for (std::size_t i = 0; i < n; ++i) {
    const std::int32_t before = chain[(i + n - 1) % n], here = chain[i], after = chain[(i + 1) % n];
    const std::optional<double> left = angle(here, after, before), right = angle(here, before, after);
    if (left && right) {
      if (*left + *right > 0.0) found[i] = std::numbers::pi * (*right - *left) / (*right + *left);
    } else if ((left || right) && !(is_open(here, after) && is_open(before, here))) {
      found[i] = left ? std::numbers::pi - *left : *right - std::numbers::pi;
    }
  }
  return found;
}

template <class IsIn>
PartBorders::Region PartBorders::region_of(std::span<const std::int32_t> triangles, const IsIn& is_in) const {
  const auto is_inner = [&](std::int32_t h) { return mesh_.twins[h] >= 0 && is_in(mesh_.twins[h] / 3); };
  Numbers outer;
  std::unordered_set<std::int32_t> vertices;
  for (const std::int32_t t : triangles) {
    for (std::int32_t h = 3 * t; h < 3 * t + 3; ++h) {
      if (!is_inner(h)) outer.push_back(h);
      vertices.insert(tail(h));
    }
  }
  Region found;
  std::unordered_set<std::int32_t> left(outer.begin(), outer.end());
  for (const std::int32_t start : outer) {
    if (!left.contains(start)) continue;
    Numbers& border = found.borders.emplace_back();
    std::int32_t at = start;
    do {
      if (border.size() == kLongestBorder) return {};
      border.push_back(at);
      left.erase(at);
      // Around the tip, within the region, to the side that it ends at.
      for (at = next_in_face(at); is_inner(at);) at = next_in_face(mesh_.twins[at]);
    } while (at != start);
  }
  const std::ptrdiff_t faces = std::ssize(triangles), edges = (3 * faces + std::ssize(outer)) / 2;
  found.is_tube = found.borders.size() == 2 && std::ssize(vertices) - edges + faces == 0;
  return found;
}

/// The triangles that half-edges connect with one for which joins(half_edge) returns true, at most about `most`.
template <class Joins>
PartBorders::Triangles PartBorders::connected(std::int32_t triangle, const Joins& joins, std::size_t most) const {
  Triangles found{.numbers = {triangle}, .contains = std::vector<bool>(areas_.size()), .is_whole = true};
  found.contains[triangle] = true;
  for (std::size_t i = 0; i < found.numbers.size() && found.is_whole; ++i) {
    for (std::int32_t h = 3 * found.numbers[i]; h < 3 * found.numbers[i] + 3; ++h) {
      const std::int32_t beside = mesh_.twins[h] / 3;
      if (mesh_.twins[h] < 0 || found.contains[beside] || !joins(h)) continue;
      found.contains[beside] = true;
      found.numbers.push_back(beside);
    }
    found.is_whole = found.numbers.size() <= most;
  }
  std::ranges::sort(found.numbers);
  return found;
}

PartBorders::Triangles PartBorders::plane_around(std::int32_t triangle) const {
  Triangles plane = connected(
      triangle,
      [&](std::int32_t h) { return normals_[mesh_.twins[h] / 3].dot(normals_[triangle]) >= kInPlane || !is_real(h); },
      kLargestPlane);
  if (!plane.is_whole) plane = {.numbers = {}, .contains = std::vector<bool>(areas_.size()), .is_whole = true};
  return plane;
}

VertexChain PartBorders::chain_of(const Numbers& half_edges) const {
  VertexChain chain;
  for (const std::int32_t h : half_edges) chain.push_back(tail(h));
  return chain;
}

std::vector<VertexChain> PartBorders::borders_of(const Parts& parts, std::int32_t triangle) const {
  std::vector<VertexChain> found;
  for (const Numbers& border : parts.regions[parts.labels[triangle]].borders) {
    if (std::ranges::all_of(border, [&](std::int32_t h) { return is_boundary(h); })) continue;
    if (!std::ranges::all_of(border, [&](std::int32_t h) { return is_real(h); })) continue;
    if (VertexChain chain = chain_of(border); is_simple(chain)) found.push_back(std::move(chain));
  }
  return found;
}

template <class Visit>
void PartBorders::for_each_leaving(std::int32_t v, const Visit& visit) const {
  // Not std::ranges::equal_range: Clang 14 cannot compile it with GCC 12's library.
  const auto [begin, end] = std::equal_range(mesh_.vertices.begin(), mesh_.vertices.end(), v);
  for (auto fan = begin; fan != end; ++fan) {
    mesh_.for_each_leaving(static_cast<std::int32_t>(fan - mesh_.vertices.begin()), visit);
  }
}

std::int32_t PartBorders::half_edge(std::int32_t from, std::int32_t to) const {
  std::int32_t found = -1;
  for_each_leaving(from, [&](std::int32_t h) {
    if (found < 0 && tip(h) == to) found = h;
  });
  return found;
}

Numbers PartBorders::half_edges_of(const Edge& edge) const {
  Numbers found;
  for (const Edge& way : {edge, Edge{edge[1], edge[0]}}) {
    for_each_leaving(way[0], [&](std::int32_t h) {
      if (tip(h) == way[1]) found.push_back(h);
    });
  }
  std::ranges::sort(found);
  return found;
}

/// The face angle at a vertex from the edge to `first` to that to `last` on its left; nullopt where the faces end.
std::optional<double> PartBorders::angle(std::int32_t here, std::int32_t first, std::int32_t last) const {
  const Vector& middle = surface_.points()[here];
  double sum = 0.0;
  std::int32_t h = half_edge(here, first);
  for (int i = 0; i < kMostAround && h >= 0; ++i) {
    const std::int32_t back = previous_in_face(h);
    const Vector one = surface_.points()[tip(h)] - middle, two = surface_.points()[tail(back)] - middle;
    sum += std::atan2(one.cross(two).norm(), one.dot(two));
    if (tail(back) == last) return sum;
    h = mesh_.twins[back];
  }
  return std::nullopt;
}

const std::vector<VertexChain>* Tubes::rims(const Edge& edge) {
  const Numbers sides = borders_.half_edges_of(edge);
  if (borders_.steps_.empty() || sides.size() != 2) return nullptr;
  const PartBorders::Parts& parts = borders_.steps_.front();
  const std::int32_t own = sides[0] / 3, other = sides[1] / 3, part = parts.labels[own];
  if (parts.labels[other] != part) return nullptr;
  const auto [at, is_new] = parts_.try_emplace(part);
  if (is_new) at->second = rims_of(parts.regions[part]);
  const Rims* rims = &at->second;
  if (rims->empty() && borders_.borders_of(parts, own).empty() && wall(own) == wall(other)) {
    rims = &walls_[wall(own)];
  }
  return rims->empty() ? nullptr : rims;
}

std::vector<Edge> Tubes::beside(const Edge& edge) {
  std::vector<Edge> found;
  const Rims* const own = rims(edge);
  if (own == nullptr) return found;
  for (const std::int32_t end : edge) {
    Numbers leaving;
    borders_.for_each_leaving(end, [&](std::int32_t h) { leaving.push_back(h); });
    std::ranges::sort(leaving);
    for (const std::int32_t h : leaving) {
      const Edge other{end, borders_.tip(h)};
      if (ascending(end, other[1]) == ascending(edge[0], edge[1]) || !borders_.is_real(h)) continue;
      if (rims(other) == own) found.push_back(other);
    }
  }
  return found;
}

std::int32_t Tubes::wall(std::int32_t triangle) {
  if (wall_of_[triangle] < 0) {
    Rims rims;
    for (const std::int32_t t : find_wall(triangle, rims).numbers) {
      if (wall_of_[t] < 0) wall_of_[t] = static_cast<std::int32_t>(walls_.size());
    }
    walls_.push_back(std::move(rims));
  }
  return wall_of_[triangle];
}

/// The triangles of a triangle's wall, and both rims of the wall if it is a tube.
PartBorders::Triangles Tubes::find_wall(std::int32_t triangle, Rims& rims) const {
  const auto region = [&](const PartBorders::Triangles& some) {
    return rims_of(borders_.region_of(some.numbers, [&](std::int32_t t) { return some.contains[t]; }));
  };
  const auto is_smooth = [&](std::int32_t h) {
    return borders_.normals_[h / 3].dot(borders_.normals_[borders_.mesh_.twins[h] / 3]) >= kSharp ||
           !borders_.is_real(h);
  };
  PartBorders::Triangles found = borders_.connected(triangle, is_smooth, kLargestWall);
  if (found.is_whole) rims = region(found);
  if (!rims.empty() || !found.is_whole) return found;
  const std::vector<bool> is_lid = lids(found);
  if (is_lid[triangle]) {
    std::erase_if(found.numbers, [&](std::int32_t t) { return !is_lid[t]; });
    return found;
  }
  found = borders_.connected(
      triangle, [&](std::int32_t h) { return is_smooth(h) && !is_lid[borders_.mesh_.twins[h] / 3]; }, kLargestWall);
  rims = region(found);
  return found;
}

/// Which triangles lie on flat faces with a fan of many triangles in a wall.
std::vector<bool> Tubes::lids(const PartBorders::Triangles& wall) const {
  const Csr<std::int32_t> fans(borders_.surface_.vertex_count(), [&](const auto& visit) {
    for (const std::int32_t t : wall.numbers) {
      for (std::int32_t h = 3 * t; h < 3 * t + 3; ++h) visit(borders_.tail(h), t);
    }
  });
  // A lid's fan has the most triangles. Vertices of walls may have many, too.
  Numbers hubs;
  for (std::int32_t v = 0; index(v) < fans.row_count(); ++v) {
    if (std::ssize(fans[v]) >= kLidCorners) hubs.push_back(v);
  }
  std::ranges::stable_sort(hubs, std::ranges::greater(), [&](std::int32_t v) { return fans[v].size(); });
  hubs.resize(std::min(hubs.size(), kMostLids));
  std::vector<bool> is_lid(wall_of_.size());
  const std::vector<Vector>& normals = borders_.normals_;
  for (const std::int32_t hub : hubs) {
    const Vector& first = normals[fans[hub].front()];
    if (std::ranges::any_of(fans[hub], [&](std::int32_t t) { return normals[t].dot(first) < kInPlane; })) continue;
    for (const std::int32_t t : borders_.plane_around(fans[hub].front()).numbers) is_lid[t] = true;
  }
  return is_lid;
}

std::vector<VertexChain> Tubes::rims_of(const PartBorders::Region& region) const {
  Rims rims;
  for (const Numbers& border : region.borders) {
    if (region.is_tube) rims.push_back(borders_.chain_of(border));
  }
  return rims;
}

}  // namespace seamwire::detail
