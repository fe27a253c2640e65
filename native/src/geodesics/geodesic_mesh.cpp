// SPDX-License-Identifier: GPL-3.0-or-later
#include "geodesics/geodesic_mesh.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>

#include "detail/poll.hpp"
#include "detail/text.hpp"

namespace seamwire {
namespace {

/// A vertex that is flat up to rounding must not be a pseudo-source: every one of them would emit windows that nothing
/// needs. What is lost behind a vertex with 1e-7 too much is of second order, 1e-14 of the length.
constexpr double kFlatness = 1e-7;

/// Lengths computed from coordinates may miss the triangle inequality by rounding where the corners are in line.
constexpr double kRounding = 1e-12;

/// There is a hop over an edge if it is shorter than this part of the path along two edges.
constexpr double kShortcut = 0.95;

using seamwire::text;
std::string text(std::int32_t number) { return std::to_string(number); }

void check_vertex(const IntrinsicMesh& mesh, std::int32_t vertex, const char* what, std::size_t number) {
  if (is_index(vertex, index(mesh.vertex_count))) return;
  check_index(vertex, index(mesh.vertex_count), std::string(what) + " " + std::to_string(number) + ": vertex");
}

void check(const IntrinsicMesh& mesh, const Task& task) {
  const auto half_edge_count = 3 * mesh.triangles.size();
  if (mesh.twins.size() != half_edge_count || mesh.lengths.size() != half_edge_count) {
    throw InvalidInput("twins and lengths must have 3 entries a triangle: " + std::to_string(mesh.triangles.size()) +
                       " triangles, " + std::to_string(mesh.twins.size()) + " twins, " +
                       std::to_string(mesh.lengths.size()) + " lengths");
  }
  const Poll corners(task, 0.0, 0.02, mesh.triangles.size());
  for (std::size_t f = 0; f < mesh.triangles.size(); ++f) {
    corners.at(f);
    for (const std::int32_t v : mesh.triangles[f]) check_vertex(mesh, v, "triangle", f);
  }
  const auto count = static_cast<std::int32_t>(half_edge_count);
  const Poll half_edges(task, 0.02, 0.08, half_edge_count);
  for (std::int32_t h = 0; h < count; ++h) {
    half_edges.at(index(h));
    const auto where = [&] { return "half-edge " + text(h) + " of triangle " + text(h / 3); };
    const double length = mesh.lengths[h];
    if (!(length > 0) || !std::isfinite(length)) {
      throw InvalidInput(where() + ": its length must be positive and finite, not " + text(length));
    }
    const std::int32_t twin = mesh.twins[h];
    if (twin == -1) continue;
    if (twin < 0 || twin >= count || twin == h || mesh.twins[twin] != h) {
      throw InvalidInput(where() + ": its twin, " + text(twin) + ", does not name it back");
    }
    if (twin < h) continue;  // the rest has been looked at from the other side
    if (mesh.tail(twin) != mesh.tip(h) || mesh.tip(twin) != mesh.tail(h)) {
      throw InvalidInput(where() + ": its twin, " + text(twin) +
                         ", does not run the other way between the same vertices");
    }
    if (mesh.lengths[twin] != length) {
      throw InvalidInput(where() + ": it is " + text(length) + " long, its twin, " + text(twin) + ", " +
                         text(mesh.lengths[twin]));
    }
  }
  const Poll lengths(task, 0.08, 0.1, mesh.triangles.size());
  for (std::size_t f = 0; f < mesh.triangles.size(); ++f) {
    lengths.at(f);
    const double a = mesh.lengths[3 * f], b = mesh.lengths[3 * f + 1], c = mesh.lengths[3 * f + 2];
    const double longest = std::max({a, b, c});
    if (longest - (a + b + c - longest) > kRounding * longest) {
      throw InvalidInput("triangle " + std::to_string(f) + ": the lengths " + text(a) + ", " + text(b) + ", " +
                         text(c) + " fail the triangle inequality");
    }
  }
  for (std::size_t i = 0; i < mesh.loose_edges.size(); ++i) {
    const LooseEdge& edge = mesh.loose_edges[i];
    check_vertex(mesh, edge.a, "loose edge", i);
    check_vertex(mesh, edge.b, "loose edge", i);
    if (!(edge.length >= 0) || !std::isfinite(edge.length)) {
      throw InvalidInput("loose edge " + std::to_string(i) + ": its length must be finite and not negative, not " +
                         text(edge.length));
    }
  }
}

/// Four times the area of a triangle. W. Kahan, "Miscalculating area and angles of a needle-like triangle".
double four_areas(double a, double b, double c) {
  if (a < b) std::swap(a, b);
  if (a < c) std::swap(a, c);
  if (b < c) std::swap(b, c);
  const double product = (a + (b + c)) * (c - (a - b)) * (c + (a - b)) * (a + (b - c));
  return std::sqrt(std::max(product, 0.0));
}

/// Where the apex stands over the base, from its tail: (left^2 + base^2 - right^2) / (2 base), with the difference
/// taken between the two that are nearest to each other.
double foot(double base, double left, double right) {
  const double square = std::abs(base - right) < std::abs(left - right) ? left * left + (base - right) * (base + right)
                                                                        : base * base + (left - right) * (left + right);
  return square / (2 * base);
}

/// Items that memory is asked for in advance.
constexpr std::size_t kAhead = 8;

}  // namespace

GeodesicMesh::GeodesicMesh(const IntrinsicMesh& mesh, const Task& task) {
  check(mesh, task);
  std::vector<std::int32_t> internal_face(mesh.triangles.size(), -1);
  renumber(mesh, internal_face, task);

  const auto entered_over = [&](std::int32_t original) {
    const std::int32_t twin = mesh.twins[original];
    return twin < 0 ? -1 : 3 * internal_face[twin / 3] + twin % 3;
  };
  half_edges_.reserve(3 * external_face_.size());
  angle_.reserve(3 * external_face_.size());
  std::vector<Triangle> corners;
  corners.reserve(external_face_.size());
  const Poll poll(task, 0.3, 0.6, external_face_.size());
  for (std::size_t f = 0; f < external_face_.size(); ++f) {
    poll.at(f);
    if (f + kAhead < external_face_.size()) {
      const std::size_t ahead = index(external_face_[f + kAhead]);
      prefetch(&mesh.lengths[3 * ahead]);
      prefetch(&mesh.twins[3 * ahead]);
      prefetch(&mesh.triangles[ahead]);
    }
    const std::int32_t face = external_face_[f];
    const double* lengths = &mesh.lengths[3 * index(face)];
    const double areas = four_areas(lengths[0], lengths[1], lengths[2]);
    const Triangle& triangle = mesh.triangles[face];
    const Triangle& own = corners.emplace_back(
        Triangle{internal_vertex(triangle[0]), internal_vertex(triangle[1]), internal_vertex(triangle[2])});
    const std::array entered{entered_over(3 * face), entered_over(3 * face + 1), entered_over(3 * face + 2)};
    for (std::size_t i = 0; i < 3; ++i) {
      const std::size_t after = (i + 1) % 3, before = (i + 2) % 3;
      const HalfEdge& h = half_edges_.emplace_back(HalfEdge{.length = lengths[i],
                                                            .apex_x = foot(lengths[i], lengths[before], lengths[after]),
                                                            .apex_y = areas / (2 * lengths[i]),
                                                            .left_length = lengths[before],
                                                            .right_length = lengths[after],
                                                            .tail = own[i],
                                                            .tip = own[after],
                                                            .apex = own[before],
                                                            .left = entered[before],
                                                            .right = entered[after]});
      angle_.push_back(std::atan2(h.apex_y, h.apex_x));
    }
  }

  out_ = leaving(vertex_count(), corners, task);
  loose_ = Csr<Loose>(vertex_count(), [&](const auto& visit) {
    for (const LooseEdge& edge : mesh.loose_edges) {
      const std::int32_t a = internal_vertex(edge.a), b = internal_vertex(edge.b);
      visit(a, {b, edge.length});
      visit(b, {a, edge.length});
    }
  });
  list_hops(task);
  find_pseudo_sources(task);
  internal_face_ = std::move(internal_face);
}

/// For each vertex the half-edges that leave it.
Csr<std::int32_t> GeodesicMesh::leaving(std::size_t vertex_count, const std::vector<Triangle>& corners,
                                        const Task& task) {
  Poll poll(task, 0.6, 0.7, 2 * corners.size());
  return Csr<std::int32_t>(vertex_count, [&](const auto& visit) {
    std::int32_t h = 0;
    for (const Triangle& triangle : corners) {
      poll.next();
      for (const std::int32_t v : triangle) visit(v, h++);
    }
  });
}

/// What lengths are multiplied by to give those of hops: a power of two; 1, unless sums of them might leave the range
/// of single precision.
double GeodesicMesh::unit_of_hops() const {
  constexpr int kMostExponent = 80;  // 2^80 times the number of vertices is still far below 2^128
  double longest = 0.0;
  for (const HalfEdge& edge : half_edges_) longest = std::max(longest, edge.length);
  for (const Loose& edge : loose_.items()) longest = std::max(longest, edge.length);
  if (longest == 0.0) return 1.0;
  const int exponent = std::ilogb(longest);
  return std::abs(exponent) > kMostExponent ? std::ldexp(1.0, -exponent) : 1.0;
}

void GeodesicMesh::list_hops(const Task& task) {
  hops_.reserve(vertex_count(), 2 * half_edges_.size() + loose_.items().size());
  double sum = 0.0;
  const std::vector<std::int32_t>& all = out_.items();
  std::size_t leaving = 0;  // of `all`, half-edges looked at
  const double unit = unit_of_hops();
  const auto add = [&](std::int32_t to, double length) {
    const auto rounded = static_cast<float>(length * unit);
    hops_.push({to, rounded});
    sum += length * unit;
    longest_hop_ = std::max(longest_hop_, rounded);
  };
  const Poll poll(task, 0.7, 0.9, vertex_count());
  for (std::int32_t v = 0; v < static_cast<std::int32_t>(vertex_count()); ++v) {
    poll.at(index(v));
    for (const std::int32_t h : out(v)) {
      if (++leaving + 2 * kAhead < all.size()) {
        prefetch(&half_edge(all[leaving + 2 * kAhead]));
        if (const std::int32_t over = half_edge(all[leaving + kAhead]).right; over >= 0) prefetch(&half_edge(over));
      }
      const HalfEdge& edge = half_edge(h);
      add(edge.tip, edge.length);
      // On the boundary no half-edge leaves v along the edge that arrives here.
      if (edge.left < 0) add(edge.apex, half_edge(previous(h)).length);
      if (edge.right < 0) continue;
      // Over the opposite edge, from below it in the frame of the half-edge entered.
      const HalfEdge& over = half_edge(edge.right);
      const HalfEdge& back = half_edge(next(h));
      const double x = over.length - back.apex_x, y = -back.apex_y;
      const double dx = over.apex_x - x, dy = over.apex_y - y, foot = x * dy - dx * y;  // times dy, which is positive
      if (!(foot > 0 && foot < over.length * dy)) continue;
      const double length = std::sqrt(dx * dx + dy * dy);
      const double around = std::min(edge.length + over.right_length, edge.left_length + over.left_length);
      if (length < kShortcut * around) add(over.apex, length);
    }
    for (const auto& [to, length] : loose(v)) add(to, length);
    hops_.end_row();
  }
  if (const std::size_t count = hops_.items().size(); count > 0) {
    mean_hop_ = static_cast<float>(sum / static_cast<double>(count));
  }
}

/// Breadth first over the triangles, a component after the other; a face gets its number with its first vertex.
void GeodesicMesh::renumber(const IntrinsicMesh& mesh, std::vector<std::int32_t>& internal_face, const Task& task) {
  const auto vertices = index(mesh.vertex_count);
  Poll listing(task, 0.1, 0.2, 2 * mesh.triangles.size());
  const Csr<std::int32_t> faces_of(vertices, [&](const auto& visit) {
    for (std::size_t f = 0; f < mesh.triangles.size(); ++f) {
      listing.next();
      for (const std::int32_t v : mesh.triangles[f]) visit(v, static_cast<std::int32_t>(f));
    }
  });
  internal_vertex_.assign(vertices, -1);
  external_vertex_.reserve(vertices);
  external_face_.reserve(mesh.triangles.size());
  const auto give_number = [&](std::int32_t v) {
    if (internal_vertex_[v] >= 0) return;
    internal_vertex_[v] = static_cast<std::int32_t>(external_vertex_.size());
    external_vertex_.push_back(v);
  };
  std::size_t done = 0;
  const Poll numbering(task, 0.2, 0.3, vertices);
  for (std::int32_t root = 0; root < mesh.vertex_count; ++root) {
    give_number(root);
    for (; done < external_vertex_.size(); ++done) {
      numbering.at(done);
      for (const std::int32_t face : faces_of[external_vertex_[done]]) {
        if (internal_face[face] >= 0) continue;
        internal_face[face] = static_cast<std::int32_t>(external_face_.size());
        external_face_.push_back(face);
        for (const std::int32_t corner : mesh.triangles[face]) give_number(corner);
      }
    }
  }
}

void GeodesicMesh::find_pseudo_sources(const Task& task) {
  is_pseudo_source_.assign(vertex_count(), 0);
  const Poll poll(task, 0.9, 1.0, vertex_count());
  for (std::int32_t v = 0; v < static_cast<std::int32_t>(vertex_count()); ++v) {
    poll.at(index(v));
    const auto leaving = out(v);
    bool bends = !loose(v).empty();
    double angle = 0.0;
    for (const std::int32_t h : leaving) {
      angle += angle_[h];
      bends = bends || twin(h) < 0 || half_edge(h).left < 0;
    }
    if (!bends && !leaving.empty()) {
      // Around one closed umbrella; whatever is not met belongs to another.
      std::size_t met = 0;
      std::int32_t h = leaving.front();
      do {
        h = half_edge(h).left;
        ++met;
      } while (h != leaving.front());
      bends = met != leaving.size();
    }
    is_pseudo_source_[v] = bends || angle > 2 * std::numbers::pi + kFlatness;
  }
}

}  // namespace seamwire
