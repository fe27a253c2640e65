// SPDX-License-Identifier: GPL-3.0-or-later
#include "geodesics/geodesic_mesh.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <new>
#include <numbers>
#include <numeric>
#include <string>

#include "detail/text.hpp"

namespace seamwire {
namespace {

std::size_t index(std::int32_t i) { return static_cast<std::size_t>(i); }

/// A vertex that is flat up to rounding must not count as one that bends paths: every one of them would send out
/// windows that nothing needs. What is lost behind a vertex with 1e-7 too much is of second order, 1e-14 of the length.
constexpr double kFlatness = 1e-7;

/// Lengths computed from coordinates may miss the triangle inequality by rounding where the corners are in line.
constexpr double kRounding = 1e-12;

/// A step over an edge counts if it is shorter than this part of the way along two edges.
constexpr double kShortcut = 0.95;

using seamwire::text;
std::string text(std::int32_t number) { return std::to_string(number); }

void check_vertex(const IntrinsicMesh& mesh, std::int32_t vertex, const char* what, std::size_t number) {
  if (vertex < 0 || vertex >= mesh.vertex_count) {
    throw InvalidInput(std::string(what) + " " + std::to_string(number) + ": vertex " + text(vertex) +
                       " is out of range, there are " + text(mesh.vertex_count));
  }
}

void check(const IntrinsicMesh& mesh) {
  const auto half_edge_count = 3 * mesh.triangles.size();
  if (mesh.twins.size() != half_edge_count || mesh.lengths.size() != half_edge_count) {
    throw InvalidInput("twins and lengths must have 3 entries a triangle: " + std::to_string(mesh.triangles.size()) +
                       " triangles, " + std::to_string(mesh.twins.size()) + " twins, " +
                       std::to_string(mesh.lengths.size()) + " lengths");
  }
  for (std::size_t f = 0; f < mesh.triangles.size(); ++f) {
    for (const std::int32_t v : mesh.triangles[f]) check_vertex(mesh, v, "triangle", f);
  }
  const auto count = static_cast<std::int32_t>(half_edge_count);
  for (std::int32_t h = 0; h < count; ++h) {
    const auto where = [&] { return "half-edge " + text(h) + " of triangle " + text(h / 3); };
    const double length = mesh.lengths[index(h)];
    if (!(length > 0) || !std::isfinite(length)) {
      throw InvalidInput(where() + ": its length must be positive and finite, not " + text(length));
    }
    const std::int32_t twin = mesh.twins[index(h)];
    if (twin == -1) continue;
    if (twin < 0 || twin >= count || twin == h || mesh.twins[index(twin)] != h) {
      throw InvalidInput(where() + ": its twin, " + text(twin) + ", does not name it back");
    }
    if (twin < h) continue;  // the rest has been looked at from the other side
    if (mesh.tail(twin) != mesh.tip(h) || mesh.tip(twin) != mesh.tail(h)) {
      throw InvalidInput(where() + ": its twin, " + text(twin) +
                         ", does not run the other way between the same vertices");
    }
    if (mesh.lengths[index(twin)] != length) {
      throw InvalidInput(where() + ": it is " + text(length) + " long, its twin, " + text(twin) + ", " +
                         text(mesh.lengths[index(twin)]));
    }
  }
  for (std::size_t f = 0; f < mesh.triangles.size(); ++f) {
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

/// Rows of an adjacency: for each i, where its items begin, given how many it has in counts[i + 1].
void accumulate_rows(std::vector<std::int32_t>& counts) {
  std::partial_sum(counts.begin(), counts.end(), counts.begin());
}

}  // namespace

GeodesicMesh::GeodesicMesh(const IntrinsicMesh& mesh) {
  check(mesh);
  std::vector<std::int32_t> own_face(mesh.triangles.size(), -1);
  renumber(mesh, own_face);

  const auto entered_over = [&](std::int32_t original) {
    const std::int32_t twin = mesh.twins[index(original)];
    return twin < 0 ? -1 : 3 * own_face[index(twin / 3)] + twin % 3;
  };
  half_edges_.reserve(3 * original_face_.size());
  angle_.reserve(3 * original_face_.size());
  std::vector<Triangle> corners;
  corners.reserve(original_face_.size());
  for (std::size_t f = 0; f < original_face_.size(); ++f) {
    if (f + kAhead < original_face_.size()) {
      const std::size_t ahead = index(original_face_[f + kAhead]);
      prefetch(&mesh.lengths[3 * ahead]);
      prefetch(&mesh.twins[3 * ahead]);
      prefetch(&mesh.triangles[ahead]);
    }
    const std::int32_t face = original_face_[f];
    const double* lengths = &mesh.lengths[3 * index(face)];
    const double areas = four_areas(lengths[0], lengths[1], lengths[2]);
    const Triangle& triangle = mesh.triangles[index(face)];
    const Triangle& own =
        corners.emplace_back(Triangle{own_vertex(triangle[0]), own_vertex(triangle[1]), own_vertex(triangle[2])});
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

  list_out(corners);

  first_loose_.assign(vertex_count() + 1, 0);
  for (const LooseEdge& edge : mesh.loose_edges) {
    ++first_loose_[index(own_vertex(edge.a)) + 1];
    ++first_loose_[index(own_vertex(edge.b)) + 1];
  }
  accumulate_rows(first_loose_);
  loose_.resize(2 * mesh.loose_edges.size());
  std::vector<std::int32_t> free_slot(first_loose_.begin(), first_loose_.end() - 1);
  for (const LooseEdge& edge : mesh.loose_edges) {
    const std::int32_t a = own_vertex(edge.a), b = own_vertex(edge.b);
    loose_[index(free_slot[index(a)]++)] = {b, edge.length};
    loose_[index(free_slot[index(b)]++)] = {a, edge.length};
  }

  list_steps();
  find_bending_vertices();
}

void GeodesicMesh::list_out(const std::vector<Triangle>& corners) {
  first_out_.assign(vertex_count() + 1, 0);
  for (const Triangle& triangle : corners) {
    for (const std::int32_t v : triangle) ++first_out_[index(v) + 1];
  }
  accumulate_rows(first_out_);
  out_.resize(half_edges_.size());
  std::vector<std::int32_t> free_slot(first_out_.begin(), first_out_.end() - 1);
  std::int32_t h = 0;
  for (const Triangle& triangle : corners) {
    for (const std::int32_t v : triangle) out_[index(free_slot[index(v)]++)] = h++;
  }
}

/// What lengths are multiplied by to be those of steps: a power of two, 1 unless sums of them might leave the range of
/// single precision.
double GeodesicMesh::unit_of_steps() const {
  constexpr int kMostExponent = 80;  // 2^80 times the number of vertices is still far below 2^128
  double longest = 0.0;
  for (const HalfEdge& edge : half_edges_) longest = std::max(longest, edge.length);
  for (const Loose& edge : loose_) longest = std::max(longest, edge.length);
  if (longest == 0.0) return 1.0;
  const int exponent = std::ilogb(longest);
  return std::abs(exponent) > kMostExponent ? std::ldexp(1.0, -exponent) : 1.0;
}

void GeodesicMesh::list_steps() {
  first_step_.assign(vertex_count() + 1, 0);
  steps_.reserve(2 * half_edges_.size() + loose_.size());
  double sum = 0.0;
  std::size_t leaving = 0;  // in out_
  const double unit = unit_of_steps();
  const auto add = [&](std::int32_t to, double length) {
    const auto rounded = static_cast<float>(length * unit);
    steps_.push_back({to, rounded});
    sum += length * unit;
    longest_step_ = std::max(longest_step_, rounded);
  };
  for (std::int32_t v = 0; v < static_cast<std::int32_t>(vertex_count()); ++v) {
    for (const std::int32_t h : out(v)) {
      if (++leaving + 2 * kAhead < out_.size()) {
        prefetch(&half_edge(out_[leaving + 2 * kAhead]));
        if (const std::int32_t over = half_edge(out_[leaving + kAhead]).right; over >= 0) prefetch(&half_edge(over));
      }
      const HalfEdge& edge = half_edge(h);
      add(edge.tip, edge.length);
      // On the boundary nobody leaves v along the edge that arrives here.
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
    first_step_[index(v) + 1] = static_cast<std::int32_t>(steps_.size());
  }
  if (!steps_.empty()) mean_step_ = static_cast<float>(sum / static_cast<double>(steps_.size()));
}

/// Breadth first over the triangles, a component after the other; a face gets its number with its first vertex.
void GeodesicMesh::renumber(const IntrinsicMesh& mesh, std::vector<std::int32_t>& own_face) {
  const auto vertices = index(mesh.vertex_count);
  std::vector<std::int32_t> first(vertices + 1, 0), corners(3 * mesh.triangles.size());
  for (const Triangle& triangle : mesh.triangles) {
    for (const std::int32_t v : triangle) ++first[index(v) + 1];
  }
  accumulate_rows(first);
  std::vector<std::int32_t> free_slot(first.begin(), first.end() - 1);
  for (std::size_t f = 0; f < mesh.triangles.size(); ++f) {
    for (const std::int32_t v : mesh.triangles[f]) corners[index(free_slot[index(v)]++)] = static_cast<std::int32_t>(f);
  }

  own_vertex_.assign(vertices, -1);
  original_vertex_.reserve(vertices);
  original_face_.reserve(mesh.triangles.size());
  const auto number = [&](std::int32_t v) {
    if (own_vertex_[index(v)] >= 0) return;
    own_vertex_[index(v)] = static_cast<std::int32_t>(original_vertex_.size());
    original_vertex_.push_back(v);
  };
  std::size_t done = 0;
  for (std::int32_t root = 0; root < mesh.vertex_count; ++root) {
    number(root);
    for (; done < original_vertex_.size(); ++done) {
      const auto v = index(original_vertex_[done]);
      for (auto i = index(first[v]); i < index(first[v + 1]); ++i) {
        const std::int32_t face = corners[i];
        if (own_face[index(face)] >= 0) continue;
        own_face[index(face)] = static_cast<std::int32_t>(original_face_.size());
        original_face_.push_back(face);
        for (const std::int32_t corner : mesh.triangles[index(face)]) number(corner);
      }
    }
  }
}

void GeodesicMesh::find_bending_vertices() {
  bends_paths_.assign(vertex_count(), 0);
  for (std::int32_t v = 0; v < static_cast<std::int32_t>(vertex_count()); ++v) {
    const auto leaving = out(v);
    bool bends = !loose(v).empty();
    double angle = 0.0;
    for (const std::int32_t h : leaving) {
      angle += angle_[index(h)];
      bends = bends || twin(h) < 0 || half_edge(h).left < 0;
    }
    if (!bends && !leaving.empty()) {
      // Around one closed fan; whatever is not met belongs to another.
      std::size_t met = 0;
      std::int32_t h = leaving.front();
      do {
        h = half_edge(h).left;
        ++met;
      } while (h != leaving.front());
      bends = met != leaving.size();
    }
    bends_paths_[index(v)] = bends || angle > 2 * std::numbers::pi + kFlatness;
  }
}

MeshCutter::Numbers::Numbers(std::size_t count)
    : memory_(static_cast<std::int32_t*>(std::calloc(std::max<std::size_t>(count, 1), sizeof(std::int32_t)))) {
  if (!memory_) throw std::bad_alloc();
}

MeshPart MeshCutter::cut(std::span<const std::int32_t> vertices) {
  for (const std::int32_t v : used_vertices_) part_vertex_[v] = 0;
  for (const std::int32_t f : used_faces_) part_face_[f] = 0;
  used_vertices_.clear();
  used_faces_.clear();
  const auto use = [](std::int32_t item, Numbers& number, std::vector<std::int32_t>& used) {
    if (number[item] != 0) return;
    number[item] = 1;
    used.push_back(item);
  };
  for (const std::int32_t v : vertices) {
    use(v, part_vertex_, used_vertices_);
    for (const std::int32_t h : mesh_.out(v)) use(h / 3, part_face_, used_faces_);
  }
  // As in the whole mesh, so that what lies together there does so here.
  std::sort(used_faces_.begin(), used_faces_.end());
  for (std::size_t f = 0; f < used_faces_.size(); ++f) {
    part_face_[used_faces_[f]] = static_cast<std::int32_t>(f) + 1;
    for (const std::int32_t h : {3 * used_faces_[f], 3 * used_faces_[f] + 1, 3 * used_faces_[f] + 2}) {
      use(mesh_.half_edge(h).tail, part_vertex_, used_vertices_);
    }
  }
  std::sort(used_vertices_.begin(), used_vertices_.end());
  for (std::size_t v = 0; v < used_vertices_.size(); ++v) {
    part_vertex_[used_vertices_[v]] = static_cast<std::int32_t>(v) + 1;
  }

  const std::shared_ptr<GeodesicMesh> part(new GeodesicMesh);
  const auto entered = [&](std::int32_t h) {
    if (h < 0) return -1;
    const std::int32_t face = part_face_[h / 3] - 1;
    return face < 0 ? -1 : 3 * face + h % 3;
  };
  part->half_edges_.reserve(3 * used_faces_.size());
  part->angle_.reserve(3 * used_faces_.size());
  part->bends_paths_.resize(used_vertices_.size());
  for (std::size_t v = 0; v < used_vertices_.size(); ++v) {
    part->bends_paths_[v] = mesh_.bends_paths(used_vertices_[v]);
  }
  std::vector<Triangle> corners;
  corners.reserve(used_faces_.size());
  for (const std::int32_t face : used_faces_) {
    for (const std::int32_t h : {3 * face, 3 * face + 1, 3 * face + 2}) {
      GeodesicMesh::HalfEdge edge = mesh_.half_edge(h);
      edge.tail = part_vertex(edge.tail);
      edge.tip = part_vertex(edge.tip);
      edge.apex = part_vertex(edge.apex);
      edge.left = entered(edge.left);
      edge.right = entered(edge.right);
      if (edge.left < 0) part->bends_paths_[index(edge.tail)] = part->bends_paths_[index(edge.apex)] = 1;
      part->half_edges_.push_back(edge);
      part->angle_.push_back(mesh_.angle(h));
    }
    const auto* h = &part->half_edges_.back() - 2;
    corners.push_back({h[0].tail, h[1].tail, h[2].tail});
  }
  part->original_vertex_.resize(used_vertices_.size());
  std::iota(part->original_vertex_.begin(), part->original_vertex_.end(), 0);
  part->own_vertex_ = part->original_vertex_;
  part->original_face_.resize(used_faces_.size());
  std::iota(part->original_face_.begin(), part->original_face_.end(), 0);
  part->list_out(corners);
  part->first_loose_.assign(used_vertices_.size() + 1, 0);
  for (std::size_t v = 0; v < used_vertices_.size(); ++v) {
    for (const auto& [to, length] : mesh_.loose(used_vertices_[v])) {
      if (part_vertex(to) >= 0) part->loose_.push_back({part_vertex(to), length});
    }
    part->first_loose_[v + 1] = static_cast<std::int32_t>(part->loose_.size());
  }
  return {part, used_vertices_, used_faces_};
}

}  // namespace seamwire
