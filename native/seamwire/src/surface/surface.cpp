// SPDX-License-Identifier: GPL-3.0-or-later
#include "seamwire/surface/surface.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>
#include <numeric>
#include <optional>
#include <span>
#include <string>
#include <utility>

#include "detail/half_edge.hpp"
#include "detail/index.hpp"
#include "detail/infinity.hpp"
#include "detail/poll.hpp"
#include "detail/text.hpp"
#include "graph/disjoint_sets.hpp"
#include "surface/corner_fans.hpp"
#include "surface/face_height.hpp"

namespace seamwire {

using namespace detail;

namespace {

using Index = std::int32_t;

// A side is 3 f + i: of face f, from corner i to corner i + 1 (mod 3) in the caller's order. Corner 3 f + i is where it
// starts.
constexpr Index kNone = -1;

// Faces with three different corners, not glued yet.
struct Faces : TriangleConnectivity {
  std::vector<Index> source;  // the caller's numbers

  Index count() const { return static_cast<Index>(triangles.size()); }
  Index side_count() const { return 3 * count(); }
};

// Beyond these, squares of lengths overflow or vanish.
constexpr double kLargestCoordinate = 1e150;
constexpr double kShortestSide = 1e-150;

void check_points(const std::vector<Vector>& points, const Task& task) {
  if (points.size() > std::numeric_limits<Index>::max()) throw InvalidInput("too many vertices: at most 2^31 - 1");
  const Poll poll(task, 0.0, 0.0, points.size());
  for (std::size_t v = 0; v < points.size(); ++v) {
    poll.at(v);
    const bool is_finite = points[v].allFinite();
    if (is_finite && points[v].cwiseAbs().maxCoeff() <= kLargestCoordinate) continue;
    throw InvalidInput("vertex " + std::to_string(v) + " has a coordinate " +
                       (is_finite ? "above 1e150 in size" : "that is not finite"));
  }
}

template <std::size_t N>
void check_elements(const std::vector<std::array<Index, N>>& elements, const char* kind, std::size_t vertex_count,
                    const Task& task) {
  if (elements.size() > static_cast<std::size_t>(std::numeric_limits<Index>::max() / 6)) {
    throw InvalidInput("too many of: " + std::string(kind));
  }
  const Poll poll(task, 0.0, 0.0, elements.size());
  for (std::size_t e = 0; e < elements.size(); ++e) {
    poll.at(e);
    for (const Index v : elements[e]) {
      if (is_index(v, vertex_count)) continue;
      check_index(v, vertex_count, std::string(kind) + " " + std::to_string(e) + ": vertex");
    }
  }
}

void check_edges(const std::vector<Edge>& edges) {
  for (std::size_t e = 0; e < edges.size(); ++e) {
    if (edges[e][0] != edges[e][1]) continue;
    throw InvalidInput("edge " + std::to_string(e) + " joins vertex " + std::to_string(edges[e][0]) + " to itself");
  }
}

// Items that belong to edges, sorted by edge: buckets by the smaller vertex, sorted within by the larger one and then
// by item. Linear in practice, where sorting all of them by comparisons would take most of the time.
class ItemsByEdge {
 public:
  template <class EdgeOf>
  ItemsByEdge(std::size_t vertex_count, Index item_count, const Task& task, double progress, const EdgeOf& edge_of)
      : first_(vertex_count + 1, 0), task_(task) {
    const Poll poll(task, progress, progress, 1);
    for (Index i = 0; i < item_count; ++i) {
      poll.at(index(i));
      ++first_[std::ranges::min(edge_of(i))];
    }
    std::exclusive_scan(first_.begin(), first_.end(), first_.begin(), 0);
    resize(keys_, index(item_count), task, progress);
    std::vector<Index> end(first_);
    for (Index i = 0; i < item_count; ++i) {
      poll.at(index(i));
      const auto [a, b] = std::ranges::minmax(edge_of(i));
      keys_[end[a]++] = (static_cast<std::uint64_t>(b) << 32) | static_cast<std::uint64_t>(i);
    }
    for (std::size_t v = 0; v < vertex_count; ++v) {
      poll.at(v);
      std::sort(keys_.begin() + first_[v], keys_.begin() + first_[v + 1]);
    }
  }

  // Calls visit(edge, items) for each edge in sorted order, with its items in ascending order. The task is told
  // `progress`.
  template <class Visit>
  void for_each_edge(double progress, const Visit& visit) const {
    std::vector<Index> items;
    const Poll poll(task_, progress, progress, 1);
    for (std::size_t v = 0; v + 1 < first_.size(); ++v) {
      poll.at(v);
      for (Index k = first_[v]; k < first_[v + 1];) {
        const auto w = static_cast<Index>(keys_[k] >> 32);
        items.clear();
        for (; k < first_[v + 1] && static_cast<Index>(keys_[k] >> 32) == w; ++k) {
          items.push_back(static_cast<Index>(keys_[k] & 0xffffffff));
        }
        visit(Edge{static_cast<Index>(v), w}, std::span<const Index>(items));
      }
    }
  }

 private:
  std::vector<Index> first_;
  std::vector<std::uint64_t> keys_;
  const Task& task_;
};

ItemsByEdge sides_by_edge(std::size_t vertex_count, const Faces& faces, const Task& task) {
  return {vertex_count, faces.side_count(), task, 0.15, [&](Index side) {
            return Edge{faces.tail(side), faces.tip(side)};
          }};
}

std::vector<Edge> sorted_unique(std::size_t vertex_count, const std::vector<Edge>& edges, const Task& task) {
  const ItemsByEdge by_edge(vertex_count, static_cast<Index>(edges.size()), task, 0.35,
                            [&](Index e) { return edges[e]; });
  std::vector<Edge> unique;
  unique.reserve(edges.size());
  by_edge.for_each_edge(0.35, [&](const Edge& edge, std::span<const Index>) { unique.push_back(edge); });
  return unique;
}

std::vector<Edge> merged(const std::vector<Edge>& a, const std::vector<Edge>& b) {
  std::vector<Edge> both;
  both.reserve(a.size() + b.size());
  std::ranges::set_union(a, b, std::back_inserter(both));
  return both;
}

// Leaves out faces with less than three different corners; what edges they have go to `stray_edges`.
Faces proper_faces(const std::vector<Triangle>& triangles, std::vector<Index>& degenerate,
                   std::vector<Edge>& stray_edges, const Task& task) {
  Faces faces;
  faces.triangles.reserve(triangles.size());
  faces.source.reserve(triangles.size());
  const Poll poll(task, 0.0, 0.1, triangles.size());
  for (std::size_t f = 0; f < triangles.size(); ++f) {
    poll.at(f);
    const auto [a, b, c] = triangles[f];
    if (a != b && b != c && c != a) {
      faces.triangles.push_back(triangles[f]);
      faces.source.push_back(static_cast<Index>(f));
      continue;
    }
    degenerate.push_back(static_cast<Index>(f));
    if (a != b) {
      stray_edges.push_back({a, b});
    } else if (b != c) {
      stray_edges.push_back({b, c});
    }
  }
  return faces;
}

// Faces on the same three vertices as an earlier one: they meet it at every edge, so one edge's faces tell.
std::vector<bool> find_duplicates(const Faces& faces, const ItemsByEdge& by_edge, bool& found) {
  std::vector<bool> duplicate(faces.triangles.size(), false);
  std::vector<std::pair<Index, Index>> apexes;
  found = false;
  by_edge.for_each_edge(0.2, [&](const Edge&, std::span<const Index> sides) {
    if (sides.size() < 2) return;
    apexes.clear();
    for (const Index side : sides) apexes.emplace_back(faces.apex(side), side / 3);
    std::ranges::sort(apexes);
    for (std::size_t i = 1; i < apexes.size(); ++i) {
      if (apexes[i].first != apexes[i - 1].first) continue;
      duplicate[apexes[i].second] = found = true;
    }
  });
  return duplicate;
}

// Two polygons may have a triangle in common and differ elsewhere. Without it, a polygon would be torn. So duplicates
// stay in polygons that have other triangles too. The triangles of a polygon follow each other, so at a diagonal of
// several polygons each side meets the next one of the list.
void keep_in_polygons(const Faces& faces, const ItemsByEdge& by_edge, const std::vector<Edge>& real,
                      std::vector<bool>& duplicate) {
  DisjointSets polygons(faces.triangles.size());
  by_edge.for_each_edge(0.25, [&](const Edge& edge, std::span<const Index> sides) {
    if (sides.size() % 2 != 0 || std::ranges::binary_search(real, edge)) return;
    for (std::size_t i = 0; i < sides.size(); i += 2) polygons.join(sides[i] / 3, sides[i + 1] / 3);
  });
  std::vector<bool> has_other(faces.triangles.size(), false);
  for (Index f = 0; f < faces.count(); ++f) {
    if (!duplicate[f]) has_other[polygons.find(f)] = true;
  }
  for (Index f = 0; f < faces.count(); ++f) {
    if (has_other[polygons.find(f)]) duplicate[f] = false;
  }
}

void remove_faces(Faces& faces, const std::vector<bool>& remove, std::vector<Index>& removed) {
  std::size_t kept = 0;
  for (std::size_t f = 0; f < faces.triangles.size(); ++f) {
    if (remove[f]) {
      removed.push_back(faces.source[f]);
      continue;
    }
    faces.triangles[kept] = faces.triangles[f];
    faces.source[kept++] = faces.source[f];
  }
  faces.triangles.resize(kept);
  faces.source.resize(kept);
}

// The side glued to each side; none at edges with one face, or with more than two. Where more than one face meets at
// an edge that is not glued, the next side of that edge, in a cycle; empty without such edges.
struct Gluing {
  std::vector<Index> twin;
  std::vector<Index> sibling;
  std::vector<Edge> carried;  // edges that faces have, sorted
  /// Whether a side lies inside a polygon: its edge is not real. Empty: all edges are real.
  std::vector<bool> is_inside;
};

void link_siblings(Gluing& gluing, std::span<const Index> sides) {
  if (gluing.sibling.empty()) gluing.sibling.assign(gluing.twin.size(), kNone);
  for (std::size_t i = 0; i < sides.size(); ++i) gluing.sibling[sides[i]] = sides[(i + 1) % sides.size()];
}

void glue_pair(Gluing& gluing, Index one, Index other) {
  gluing.twin[one] = other;
  gluing.twin[other] = one;
}

// Glues the sides of a diagonal. Two polygons with the same two corners may each have it. The triangles of a polygon
// follow each other, so each side meets the next one of the list.
bool glue_diagonals(const Faces& faces, std::span<const Index> sides, Gluing& gluing) {
  for (std::size_t i = 0; i < sides.size(); i += 2) {
    if (i + 1 == sides.size() || faces.tail(sides[i]) != faces.tip(sides[i + 1])) return false;
  }
  for (std::size_t i = 0; i < sides.size(); i += 2) glue_pair(gluing, sides[i], sides[i + 1]);
  return true;
}

// `real`: the real edges, sorted; nullptr: all are real.
Gluing glue(const Faces& faces, const ItemsByEdge& by_edge, const std::vector<Edge>* real, SurfaceReport& report) {
  Gluing gluing;
  gluing.twin.assign(faces.side_count(), kNone);
  gluing.carried.reserve(faces.triangles.size() * 3 / 2);
  if (real != nullptr) gluing.is_inside.assign(faces.side_count(), false);
  std::size_t next = 0;
  by_edge.for_each_edge(0.3, [&](const Edge& edge, std::span<const Index> sides) {
    gluing.carried.push_back(edge);
    if (real != nullptr) {
      while (next < real->size() && (*real)[next] < edge) ++next;
      const bool is_diagonal = next == real->size() || (*real)[next] != edge;
      for (const Index side : sides) gluing.is_inside[side] = is_diagonal;
      if (is_diagonal && sides.size() > 2 && glue_diagonals(faces, sides, gluing)) return;
    }
    if (sides.size() == 1) ++report.boundary_edges;
    if (sides.size() > 2) {
      report.nonmanifold_edges.push_back(edge);
      link_siblings(gluing, sides);
    }
    if (sides.size() == 2) glue_pair(gluing, sides[0], sides[1]);
  });
  return gluing;
}

// Which faces to turn over so that glued faces agree. The triangles of a polygon are reached together, so that the
// surface is never cut inside a polygon. Then faces that agree as given are reached before others, so that where the
// surface is one-sided it is cut along edges where the caller's orientation breaks already. Of a component the
// orientation with more area is kept.
std::vector<bool> find_flips(const Faces& faces, const Gluing& gluing, const std::vector<double>& areas,
                             const Task& task) {
  const std::vector<Index>& twin = gluing.twin;
  const Index count = faces.count();
  std::vector<bool> flipped(count, false);
  Index agreed = 0;  // every side before it agrees with its twin as given
  const Poll comparing(task, 0.55, 0.55, 1);
  while (agreed < faces.side_count() && (twin[agreed] < agreed || faces.tail(agreed) == faces.tip(twin[agreed]))) {
    comparing.at(index(agreed));
    ++agreed;
  }
  if (agreed == faces.side_count()) return flipped;
  std::vector<bool> visited(count, false);
  std::vector<Index> component;
  std::vector<Index> agreeing;     // stack of faces whose neighbors are to be looked at
  std::vector<Index> disagreeing;  // sides to cross once no agreeing face is left
  Poll poll(task, 0.55, 0.6, index(count));
  for (Index start = 0; start < count; ++start) {
    if (visited[start]) continue;
    component.clear();
    disagreeing.clear();
    double area[2] = {0.0, 0.0};
    std::size_t number[2] = {0, 0};
    const auto reach_triangle = [&](Index face, bool flip) {
      visited[face] = true;
      flipped[face] = flip;
      area[flip] += areas[face];
      ++number[flip];
      component.push_back(face);
      agreeing.push_back(face);
    };
    const auto reach = [&](Index face, bool flip) {
      std::size_t next_reached = component.size();
      reach_triangle(face, flip);
      if (gluing.is_inside.empty()) return;
      for (; next_reached < component.size(); ++next_reached) {
        const Index reached = component[next_reached];
        for (Index side = 3 * reached; side < 3 * reached + 3; ++side) {
          const Index other = twin[side];
          if (other == kNone || !gluing.is_inside[side] || visited[other / 3]) continue;
          reach_triangle(other / 3, flipped[reached] != (faces.tail(side) != faces.tip(other)));
        }
      }
    };
    reach(start, false);
    for (std::size_t next = 0;;) {
      while (!agreeing.empty()) {
        poll.next();
        const Index face = agreeing.back();
        agreeing.pop_back();
        for (Index side = 3 * face; side < 3 * face + 3; ++side) {
          const Index other = twin[side];
          if (other == kNone || visited[other / 3]) continue;
          if (faces.tail(side) == faces.tip(other)) {
            reach(other / 3, flipped[face]);
          } else {
            disagreeing.push_back(side);
          }
        }
      }
      while (next < disagreeing.size() && visited[twin[disagreeing[next]] / 3]) ++next;
      if (next == disagreeing.size()) break;
      reach(twin[disagreeing[next]] / 3, !flipped[disagreeing[next] / 3]);
    }
    const bool even = std::abs(area[0] - area[1]) <= 1e-9 * (area[0] + area[1]);  // equal but for rounding
    if (even ? number[1] > number[0] : area[1] > area[0]) {
      for (const Index face : component) flipped[face] = !flipped[face];
    }
  }
  return flipped;
}

// Cuts the glued pairs that the flips cannot make agree.
void cut_unorientable(const Faces& faces, const std::vector<bool>& flipped, Gluing& gluing, std::vector<Edge>& cut) {
  for (Index side = 0; side < faces.side_count(); ++side) {
    const Index other = gluing.twin[side];
    if (other < side) continue;
    const bool agree_as_given = faces.tail(side) == faces.tip(other);
    if (agree_as_given == (flipped[side / 3] == flipped[other / 3])) continue;
    const Index a = faces.tail(side);
    const Index b = faces.tip(side);
    cut.push_back({std::min(a, b), std::max(a, b)});
    gluing.twin[side] = gluing.twin[other] = kNone;
    link_siblings(gluing, std::array{side, other});
  }
  std::ranges::sort(cut);
}

// Corners of one vertex whose faces are glued to each other around it. Fans are numbered in the order of their
// vertices, so on a clean mesh the numbers of fans and vertices agree.
struct Fans {
  std::vector<Index> of_corner;
  std::vector<Index> vertex;
};

Fans find_fans(std::size_t vertex_count, const Faces& faces, const std::vector<Index>& twin, const Task& task) {
  Fans fans;
  fans.of_corner.assign(faces.side_count(), kNone);
  std::vector<Index> vertex_found;  // by order of discovery
  const Poll finding(task, 0.6, 0.65, index(faces.side_count()));
  for (Index start = 0; start < faces.side_count(); ++start) {
    finding.at(index(start));
    if (fans.of_corner[start] != kNone) continue;
    const Index vertex = faces.tail(start);
    const auto fan = static_cast<Index>(vertex_found.size());
    vertex_found.push_back(vertex);
    fans.of_corner[start] = fan;
    // A corner's vertex is on the side that starts there and on the one before: around it both ways.
    for (Index leave : {start, previous_in_face(start)}) {
      while (twin[leave] != kNone) {
        const Index enter = twin[leave];
        const bool at_tail = faces.tail(enter) == vertex;
        const Index corner = at_tail ? enter : next_in_face(enter);
        if (fans.of_corner[corner] != kNone) break;
        fans.of_corner[corner] = fan;
        leave = at_tail ? previous_in_face(enter) : corner;
      }
    }
  }
  std::vector<Index> number(vertex_count + 1, 0);
  for (const Index v : vertex_found) ++number[v];
  std::exclusive_scan(number.begin(), number.end(), number.begin(), 0);
  std::vector<Index> renumbered(vertex_found.size());
  fans.vertex.resize(vertex_found.size());
  for (std::size_t fan = 0; fan < vertex_found.size(); ++fan) {
    renumbered[fan] = number[vertex_found[fan]]++;
    fans.vertex[renumbered[fan]] = vertex_found[fan];
  }
  Poll renumbering(task, 0.65, 0.7, fans.of_corner.size());
  for (Index& fan : fans.of_corner) {
    renumbering.next();
    fan = renumbered[fan];
  }
  return fans;
}

// A face that is turned over has its sides in the other order.
void list_faces(const Gluing& gluing, const std::vector<bool>& flipped, const Fans& fans, CornerFans& out,
                const Task& task) {
  const std::vector<Index>& twin = gluing.twin;
  const auto turned_over = [&](Index side) { return flipped[side / 3] ? side / 3 * 3 + 2 - side % 3 : side; };
  resize(out.triangles, twin.size() / 3, task, 0.8);
  resize(out.twins, twin.size(), task, 0.8);
  resize(out.leaving, fans.vertex.size(), task, 0.8);
  const Poll poll(task, 0.8, 1.0, twin.size());
  for (Index side = 0; side < static_cast<Index>(twin.size()); ++side) {
    poll.at(index(side));
    const Index h = turned_over(side), fan = fans.of_corner[flipped[side / 3] ? next_in_face(side) : side];
    out.triangles[h / 3][h % 3] = fan;
    out.twins[h] = twin[side] == kNone ? -1 : turned_over(twin[side]);
    out.leaving[fan] = h;
  }
  resize(out.siblings, gluing.sibling.size(), task, 1.0);
  const Poll listing(task, 1.0, 1.0, out.siblings.size());
  for (Index side = 0; side < static_cast<Index>(out.siblings.size()); ++side) {
    listing.at(index(side));
    out.siblings[turned_over(side)] = gluing.sibling[side] == kNone ? -1 : turned_over(gluing.sibling[side]);
  }
}

std::vector<bool> vertices_in_use(std::size_t vertex_count, const Faces& faces, const std::vector<Edge>& edges) {
  std::vector<bool> used(vertex_count, false);
  for (const Triangle& corners : faces.triangles) {
    for (const Index v : corners) used[v] = true;
  }
  for (const Edge& edge : edges) {
    for (const Index v : edge) used[v] = true;
  }
  return used;
}

double unit_cube_scale(const std::vector<Vector>& points, const std::vector<bool>& used) {
  Vector low = Vector::Constant(kInfinity);
  Vector high = -low;
  for (std::size_t v = 0; v < points.size(); ++v) {
    if (!used[v]) continue;
    low = low.cwiseMin(points[v]);
    high = high.cwiseMax(points[v]);
  }
  const double side = (high - low).maxCoeff();
  if (side > 0.0 && side < kShortestSide) {
    throw InvalidInput("the longest side of the box around the mesh is " + text(side) +
                       ": it must be 0, or at least 1e-150");
  }
  return side > 0.0 ? 1.0 / side : 1.0;
}

// Areas on the unit cube's scale, 0 where a triangle has none; and a report of the faces without one, and of low ones.
std::vector<double> face_areas(const std::vector<Vector>& points, const Faces& faces, double scale,
                               SurfaceReport& report, const Task& task) {
  std::vector<double> areas;
  areas.reserve(faces.triangles.size());
  Poll poll(task, 0.5, 0.55, faces.triangles.size());
  for (const auto& [a, b, c] : faces.triangles) {
    poll.next();
    const Vector ab = scale * (points[b] - points[a]);
    const Vector bc = scale * (points[c] - points[b]);
    const Vector ca = scale * (points[a] - points[c]);
    const double longest = std::max({ab.squaredNorm(), bc.squaredNorm(), ca.squaredNorm()});
    const double squared_cross = ab.cross(bc).squaredNorm();
    const Index source = faces.source[areas.size()];
    const bool is_flat = !has_area(ab, bc, ca);
    areas.push_back(is_flat ? 0.0 : 0.5 * std::sqrt(squared_cross));
    if (is_flat) report.zero_area_faces.push_back(source);
    if (is_flat || squared_cross < kLeastHeight * kLeastHeight * longest) report.low_faces.push_back(source);
  }
  return areas;
}

std::size_t count_components(const std::vector<bool>& used, std::initializer_list<const std::vector<Edge>*> edges,
                             const Task& task) {
  DisjointSets sets(used.size());
  auto count = static_cast<std::size_t>(std::ranges::count(used, true));
  for (const std::vector<Edge>* list : edges) {
    Poll poll(task, 0.45, 0.45, list->size());
    for (const auto& [a, b] : *list) {
      poll.next();
      count -= sets.join(a, b) ? 1 : 0;
    }
  }
  return count;
}

}  // namespace

Surface::Surface(std::vector<Vector> points, std::vector<Triangle> triangles, std::optional<std::vector<Edge>> edges,
                 const Task& task)
    : points_(std::move(points)), triangles_(std::move(triangles)) {
  check_points(points_, task);
  check_elements(triangles_, "triangle", points_.size(), task);
  if (edges) {
    check_elements(*edges, "edge", points_.size(), task);
    check_edges(*edges);
  }

  task.check(0.0);
  std::vector<Edge> stray_edges;
  Faces faces = proper_faces(triangles_, report_.degenerate_faces, stray_edges, task);
  std::optional<ItemsByEdge> by_edge(sides_by_edge(points_.size(), faces, task));
  task.check(0.2);
  bool has_duplicates = false;
  std::vector<bool> duplicate = find_duplicates(faces, *by_edge, has_duplicates);
  if (edges) edges_ = sorted_unique(points_.size(), *edges, task);
  if (has_duplicates) {
    if (edges) keep_in_polygons(faces, *by_edge, edges_, duplicate);
    remove_faces(faces, duplicate, report_.duplicate_faces);
    by_edge.emplace(sides_by_edge(points_.size(), faces, task));
  }
  task.check(0.3);
  Gluing gluing = glue(faces, *by_edge, edges ? &edges_ : nullptr, report_);

  task.check(0.35);
  stray_edges = sorted_unique(points_.size(), stray_edges, task);
  if (!edges) edges_ = merged(gluing.carried, stray_edges);
  // A polygon's triangulation may run through edges that are not real: those of faces left out connect all the same.
  const std::vector<Edge> connecting = merged(edges_, stray_edges);
  if (connecting.empty() && faces.triangles.empty()) throw InvalidInput("the mesh is empty: it has no edge");
  std::ranges::set_difference(connecting, gluing.carried, std::back_inserter(loose_edges_));

  task.check(0.4);
  const std::vector<bool> used = vertices_in_use(points_.size(), faces, connecting);
  scale_ = unit_cube_scale(points_, used);
  for (std::size_t v = 0; v < used.size(); ++v) {
    if (!used[v]) report_.isolated_vertices.push_back(static_cast<Index>(v));
  }
  report_.components = count_components(used, {&gluing.carried, &loose_edges_}, task);

  task.check(0.5);
  const std::vector<double> areas = face_areas(points_, faces, scale_, report_, task);
  task.check(0.55);
  const std::vector<bool> flipped = find_flips(faces, gluing, areas, task);
  for (Index f = 0; f < faces.count(); ++f) {
    if (flipped[f]) report_.flipped_faces.push_back(faces.source[f]);
  }
  cut_unorientable(faces, flipped, gluing, report_.unorientable_edges);

  task.check(0.6);
  Fans fans = find_fans(points_.size(), faces, gluing.twin, task);
  task.check(0.7);
  auto inside = std::make_shared<CornerFans>();
  list_faces(gluing, flipped, fans, *inside, task);
  inside->vertices = std::move(fans.vertex);
  inside->faces = std::move(faces.source);
  fans_ = std::move(inside);
}

}  // namespace seamwire
