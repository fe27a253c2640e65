// SPDX-License-Identifier: GPL-3.0-or-later
#include "geodesics/geodesic_mesh.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "detail/insertion_map.hpp"
#include "detail/poll.hpp"
#include "detail/text.hpp"
#include "geodesics/triangle_area.hpp"

namespace seamwire::detail {
namespace {

/// A vertex that is flat up to rounding must not be a pseudo-source: every one of them would emit windows that nothing
/// needs. The error behind a vertex with 1e-7 too much is of second order, 1e-14 of the length.
constexpr double kFlatness = 1e-7;

/// A sum of angles, each from 0 to pi, as a product of complex numbers. Arctangents would take ten times as long.
class TotalAngle {
 public:
  void add(double cosine, double sine) {
    const bool was_past_half = is_past_half();
    const double c = cosine_ * cosine - sine_ * sine;
    sine_ = cosine_ * sine + sine_ * cosine;
    cosine_ = c;
    if (was_past_half && !is_past_half()) ++turns_;
  }
  /// Whether it is more than 2 pi, and not by rounding.
  bool is_beyond_flat() const { return turns_ > 1 || (turns_ == 1 && (is_past_half() || sine_ > kFlatness * cosine_)); }

 private:
  bool is_past_half() const { return sine_ < 0 || (sine_ == 0 && cosine_ < 0); }

  double cosine_ = 1.0, sine_ = 0.0;  // of what is beyond whole turns
  std::size_t turns_ = 0;
};

/// How much shorter than the two other edges together the longest edge of a triangle is, in its own length. With less,
/// the place of the third corner is lost in rounding, and windows go astray behind it.
constexpr double kLeastSlack = 1e-13;

/// Lengths above this are refused, and meshes whose longest edge is shorter than the inverse. The square of a
/// triangle's area is a product of four lengths, which would overflow or underflow.
constexpr double kLongest = 1e76;

using seamwire::detail::text;
std::string text(std::int32_t number) { return std::to_string(number); }

void check_vertex(const IntrinsicMesh& mesh, std::int32_t vertex, const char* what, std::size_t number) {
  if (is_index(vertex, index(mesh.vertex_count))) return;
  check_index(vertex, index(mesh.vertex_count), std::string(what) + " " + std::to_string(number) + ": vertex");
}

void check_sizes(const IntrinsicMesh& mesh) {
  const auto half_edge_count = 3 * mesh.triangles.size();
  if (mesh.twins.size() != half_edge_count || mesh.lengths.size() != half_edge_count) {
    throw InvalidInput("twins and lengths must have 3 entries a triangle: " + std::to_string(mesh.triangles.size()) +
                       " triangles, " + std::to_string(mesh.twins.size()) + " twins, " +
                       std::to_string(mesh.lengths.size()) + " lengths");
  }
  if (!mesh.siblings.empty() && mesh.siblings.size() != half_edge_count) {
    throw InvalidInput("siblings must be empty or have 3 entries a triangle: " + std::to_string(mesh.triangles.size()) +
                       " triangles, " + std::to_string(mesh.siblings.size()) + " siblings");
  }
  if (!mesh.areas.empty() && mesh.areas.size() != mesh.triangles.size()) {
    throw InvalidInput("areas must be empty or have an entry a triangle: " + std::to_string(mesh.triangles.size()) +
                       " triangles, " + std::to_string(mesh.areas.size()) + " areas");
  }
}

/// The area that is given for a triangle, or 0.
double given_area(const IntrinsicMesh& mesh, std::size_t f) { return mesh.areas.empty() ? 0.0 : mesh.areas[f]; }

void check_corners(const IntrinsicMesh& mesh, std::size_t f) {
  for (const std::int32_t v : mesh.triangles[f]) check_vertex(mesh, v, "triangle", f);
}

void check_half_edge(const IntrinsicMesh& mesh, std::int32_t h) {
  const auto where = [&] { return "half-edge " + text(h) + " of triangle " + text(h / 3); };
  const double length = mesh.lengths[h];
  if (!(length > 0 && length <= kLongest)) {
    throw InvalidInput(where() + ": its length must be positive and at most 1e76, not " + text(length));
  }
  const std::int32_t twin = mesh.twins[h];
  if (twin == -1) return;
  if (twin < 0 || index(twin) >= mesh.twins.size() || twin == h || mesh.twins[twin] != h) {
    throw InvalidInput(where() + ": its twin, " + text(twin) + ", does not name it back");
  }
  if (twin < h) return;  // the rest is looked at from the other side
  if (mesh.tail(twin) != mesh.tip(h) || mesh.tip(twin) != mesh.tail(h)) {
    throw InvalidInput(where() + ": its twin, " + text(twin) +
                       ", does not run the other way between the same vertices");
  }
  if (mesh.lengths[twin] != length) {
    throw InvalidInput(where() + ": it is " + text(length) + " long, its twin, " + text(twin) + ", " +
                       text(mesh.lengths[twin]));
  }
}

/// Each half-edge with a sibling is the sibling of one other half-edge of its edge: so they form cycles.
void check_siblings(const IntrinsicMesh& mesh) {
  std::vector<bool> is_named(mesh.siblings.size(), false);
  for (std::int32_t h = 0; index(h) < mesh.siblings.size(); ++h) {
    const std::int32_t sibling = mesh.siblings[h];
    if (sibling == -1) continue;
    const auto fail = [&](const std::string& what) {
      throw InvalidInput("half-edge " + text(h) + " of triangle " + text(h / 3) + ": " + what);
    };
    if (mesh.twins[h] != -1) fail("it has a twin and a sibling");
    if (sibling < 0 || index(sibling) >= mesh.siblings.size() || sibling == h || mesh.siblings[sibling] == -1 ||
        is_named[sibling]) {
      fail("its sibling, " + text(sibling) + ", is not in a cycle with it");
    }
    is_named[sibling] = true;
    const std::int32_t tail = mesh.tail(h), tip = mesh.tip(h), to = mesh.tail(sibling), from = mesh.tip(sibling);
    const bool is_same_edge = (tail == to && tip == from) || (tail == from && tip == to);
    if (tail == tip || !is_same_edge) {
      fail("its sibling, " + text(sibling) + ", does not run between the same two vertices");
    }
    if (mesh.lengths[sibling] != mesh.lengths[h]) {
      fail("it is " + text(mesh.lengths[h]) + " long, its sibling, " + text(sibling) + ", " +
           text(mesh.lengths[sibling]));
    }
  }
}

void check_triangle_inequality(const IntrinsicMesh& mesh, std::size_t f) {
  const double a = mesh.lengths[3 * f], b = mesh.lengths[3 * f + 1], c = mesh.lengths[3 * f + 2];
  const double longest = std::max({a, b, c});
  const double slack = a + b + c - longest - longest;
  const double area = given_area(mesh, f);
  if (!(area >= 0 && area <= longest * longest)) {
    throw InvalidInput("triangle " + std::to_string(f) + ": an area of " + text(area) + " does not fit its lengths");
  }
  if (slack >= (area > 0 ? -kLeastSlack : kLeastSlack) * longest) return;
  throw InvalidInput("triangle " + std::to_string(f) + ": the lengths " + text(a) + ", " + text(b) + ", " + text(c) +
                     (slack < 0.0 ? " fail the triangle inequality" : " leave it no area"));
}

void check_longest(const IntrinsicMesh& mesh) {
  if (mesh.lengths.empty()) return;
  if (const double longest = *std::ranges::max_element(mesh.lengths); longest < 1.0 / kLongest) {
    throw InvalidInput("the longest edge must be at least 1e-76 long, not " + text(longest));
  }
}

/// If the longest edge is longer than 2 to this power, or shorter than the inverse, hops have a separate unit. The
/// number of vertices times 2^80 is still far below 2^128, where single precision ends.
constexpr int kMostHopExponent = 80;

/// Where more than one in so many faces has changed, building anew is no slower than patching.
constexpr std::size_t kFacesPerChange = 4;

/// Items that memory is asked for in advance.
constexpr std::size_t kAhead = 8;

}  // namespace

void check_mesh(const IntrinsicMesh& mesh, const Task& task) {
  check_sizes(mesh);
  const Poll corners(task, 0.0, 0.02, mesh.triangles.size());
  for (std::size_t f = 0; f < mesh.triangles.size(); ++f) {
    corners.at(f);
    check_corners(mesh, f);
  }
  const auto count = static_cast<std::int32_t>(mesh.twins.size());
  const Poll half_edges(task, 0.02, 0.08, mesh.twins.size());
  for (std::int32_t h = 0; h < count; ++h) {
    half_edges.at(index(h));
    check_half_edge(mesh, h);
  }
  check_siblings(mesh);
  const Poll lengths(task, 0.08, 0.1, mesh.triangles.size());
  for (std::size_t f = 0; f < mesh.triangles.size(); ++f) {
    lengths.at(f);
    check_triangle_inequality(mesh, f);
  }
  for (std::size_t i = 0; i < mesh.loose_edges.size(); ++i) {
    const LooseEdge& edge = mesh.loose_edges[i];
    check_vertex(mesh, edge.a, "loose edge", i);
    check_vertex(mesh, edge.b, "loose edge", i);
    if (!(edge.length >= 0 && edge.length <= kLongest)) {
      throw InvalidInput("loose edge " + std::to_string(i) + ": its length must be at least 0 and at most 1e76, not " +
                         text(edge.length));
    }
  }
  check_longest(mesh);
}

GeodesicMesh::GeodesicMesh(const IntrinsicMesh& mesh, const Task& task) {
  check_mesh(mesh, task);
  renumber(mesh, task);
  faces_.resize(external_face_.size());
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
    set_face(mesh, external_face_[f]);
    corners.push_back(faces_[f].corners);
  }

  set_siblings(mesh);
  out_ = leaving(vertex_count(), corners, task);
  list_loose_edges(mesh);
  measure_edges();
  find_pseudo_sources(task);
}

/// Numbers have to be known.
void GeodesicMesh::set_face(const IntrinsicMesh& mesh, std::int32_t external) {
  const auto twin_of = [&](std::int32_t original) {
    const std::int32_t twin = mesh.twins[original];
    return twin < 0 ? -1 : 3 * internal_face_[twin / 3] + twin % 3;
  };
  const double* lengths = &mesh.lengths[3 * index(external)];
  const double area = given_area(mesh, index(external));
  const Triangle& triangle = mesh.triangles[external];
  faces_.edit(index(internal_face_[external])) = {
      .lengths = {lengths[0], lengths[1], lengths[2]},
      .four_areas = area > 0 ? 4 * area : four_areas(lengths[0], lengths[1], lengths[2]),
      .corners = {internal_vertex(triangle[0]), internal_vertex(triangle[1]), internal_vertex(triangle[2])},
      .twins = {twin_of(3 * external), twin_of(3 * external + 1), twin_of(3 * external + 2)}};
}

void GeodesicMesh::set_siblings(const IntrinsicMesh& mesh) {
  const auto internal = [&](std::int32_t h) { return 3 * internal_face_[h / 3] + h % 3; };
  siblings_.assign(mesh.siblings.size(), -1);
  bool is_any = false;
  for (std::int32_t h = 0; index(h) < mesh.siblings.size(); ++h) {
    if (mesh.siblings[h] < 0) continue;
    siblings_[internal(h)] = internal(mesh.siblings[h]);
    is_any = true;
  }
  if (!is_any) siblings_.clear();
}

void GeodesicMesh::list_loose_edges(const IntrinsicMesh& mesh) {
  loose_ = Csr<Loose>(vertex_count(), [&](const auto& visit) {
    for (const LooseEdge& edge : mesh.loose_edges) {
      const std::int32_t a = internal_vertex(edge.a), b = internal_vertex(edge.b);
      visit(a, {b, edge.length});
      visit(b, {a, edge.length});
    }
  });
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

void GeodesicMesh::measure_edges() {
  double sum = 0.0, longest = 0.0;
  const auto measure = [&](double length) {
    sum += length;
    longest = std::max(longest, length);
  };
  for (std::size_t f = 0; f < faces_.size(); ++f) std::ranges::for_each(faces_[f].lengths, measure);
  for (const Loose& edge : loose_.items()) measure(edge.length);
  if (longest == 0.0) return;
  const int exponent = std::ilogb(longest);
  hop_unit_ = std::abs(exponent) > kMostHopExponent ? std::ldexp(1.0, -exponent) : 1.0;
  mean_edge_ = static_cast<float>(hop_unit_ * sum / static_cast<double>(half_edge_count() + loose_.items().size()));
  longest_hop_ = static_cast<float>(2.0 * hop_unit_ * longest);
}

/// Breadth first over the triangles, a component after the other; a face gets its number with its first vertex.
void GeodesicMesh::renumber(const IntrinsicMesh& mesh, const Task& task) {
  const auto vertices = index(mesh.vertex_count);
  Poll listing(task, 0.1, 0.2, 2 * mesh.triangles.size());
  const Csr<std::int32_t> faces_of(vertices, [&](const auto& visit) {
    for (std::size_t f = 0; f < mesh.triangles.size(); ++f) {
      listing.next();
      for (const std::int32_t v : mesh.triangles[f]) visit(v, static_cast<std::int32_t>(f));
    }
  });
  internal_vertex_.assign(vertices, -1);
  internal_face_.assign(mesh.triangles.size(), -1);
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
        if (internal_face_[face] >= 0) continue;
        internal_face_[face] = static_cast<std::int32_t>(external_face_.size());
        external_face_.push_back(face);
        for (const std::int32_t corner : mesh.triangles[face]) give_number(corner);
      }
    }
  }
}

bool GeodesicMesh::may_bend(std::int32_t vertex) const {
  const auto leaving = out(vertex);
  bool bends = !loose(vertex).empty();
  TotalAngle angle;
  for (const std::int32_t h : leaving) {
    const HalfEdge edge = half_edge(h);
    angle.add(edge.apex_x / edge.left_length, edge.apex_y / edge.left_length);
    bends = bends || twin(h) < 0 || edge.left < 0;
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
  return bends || angle.is_beyond_flat();
}

void GeodesicMesh::find_pseudo_sources(const Task& task) {
  is_pseudo_source_.assign(vertex_count(), 0);
  const Poll poll(task, 0.9, 1.0, vertex_count());
  for (std::int32_t v = 0; v < static_cast<std::int32_t>(vertex_count()); ++v) {
    poll.at(index(v));
    is_pseudo_source_[v] = may_bend(v) ? kPseudoSource : 0;
  }
  for (std::int32_t h = 0; index(h) < siblings_.size(); ++h) {
    if (siblings_[h] < 0) continue;
    for (const std::int32_t v : {half_edge(h).tail, half_edge(h).tip}) is_pseudo_source_[v] |= kBranching;
  }
}

namespace {

bool is_same_face(const IntrinsicMesh& one, const IntrinsicMesh& other, std::size_t f) {
  const auto same = [f](const auto& a, const auto& b) {
    return a[3 * f] == b[3 * f] && a[3 * f + 1] == b[3 * f + 1] && a[3 * f + 2] == b[3 * f + 2];
  };
  return one.triangles[f] == other.triangles[f] && same(one.twins, other.twins) && same(one.lengths, other.lengths) &&
         given_area(one, f) == given_area(other, f);
}

bool are_same(const std::vector<LooseEdge>& these, const std::vector<LooseEdge>& those) {
  return std::ranges::equal(these, those, [](const LooseEdge& a, const LooseEdge& b) {
    return a.a == b.a && a.b == b.b && a.length == b.length;
  });
}

/// Makes the numbers of `count` items out of those of some others, external from internal ones and back. An item keeps
/// its internal number, but where there are fewer than before: then the last ones take those that have become free.
/// Returns the external numbers of these.
std::vector<std::int32_t> resize_numbers(std::vector<std::int32_t>& external, std::vector<std::int32_t>& internal,
                                         std::size_t count) {
  std::vector<std::int32_t> free, moved;
  for (std::size_t item = count; item < internal.size(); ++item) {
    if (index(internal[item]) < count) free.push_back(internal[item]);
  }
  for (std::size_t number = count; number < external.size(); ++number) {
    const std::int32_t item = external[number];
    if (index(item) >= count) continue;
    internal[item] = free[moved.size()];
    external[internal[item]] = item;
    moved.push_back(item);
  }
  const std::size_t former = std::min(count, external.size());
  external.resize(count);
  internal.resize(count);
  for (std::size_t item = former; item < count; ++item) {
    external[item] = internal[item] = static_cast<std::int32_t>(item);
  }
  return moved;
}

}  // namespace

std::optional<GeodesicMesh> GeodesicMesh::patched(const IntrinsicMesh& before, const IntrinsicMesh& mesh,
                                                  const Task& task) const {
  check_sizes(before);
  check_sizes(mesh);
  if (3 * before.triangles.size() != half_edge_count() || index(before.vertex_count) != vertex_count()) {
    throw InvalidInput("the former mesh is not the one that the geodesics were made from");
  }
  const std::size_t count = mesh.triangles.size(), former_count = before.triangles.size();
  const std::size_t common = std::min(count, former_count), most = count / kFacesPerChange;
  if (std::max(count, former_count) - common > most) return std::nullopt;
  if (!are_same(before.loose_edges, mesh.loose_edges)) return std::nullopt;
  if (!before.siblings.empty() || !mesh.siblings.empty()) return std::nullopt;
  const auto vertices = index(mesh.vertex_count), former_vertices = vertex_count();

  // Entries that differ from before, because their numbers changed, or because they or what they name get another
  // internal number.
  InsertionMap faces;
  const Poll comparing(task, 0.0, 0.5, common);
  for (std::size_t f = 0; f < common; ++f) {
    comparing.at(f);
    if (is_same_face(before, mesh, f)) continue;
    faces.insert(static_cast<std::int32_t>(f));
    if (faces.numbers().size() > most) return std::nullopt;
  }
  for (std::size_t f = common; f < count; ++f) faces.insert(static_cast<std::int32_t>(f));
  std::vector<std::int32_t> former_faces;  // those that are no more what they were
  for (const std::int32_t f : faces.numbers()) {
    if (index(f) < former_count) former_faces.push_back(f);
  }
  for (std::size_t f = common; f < former_count; ++f) former_faces.push_back(static_cast<std::int32_t>(f));
  for (const std::int32_t f : faces.numbers()) check_corners(mesh, index(f));

  GeodesicMesh out;  // rows of half-edges are copied when they are patched
  out.faces_ = faces_;
  out.is_pseudo_source_ = is_pseudo_source_;
  out.external_vertex_ = external_vertex_;
  out.internal_vertex_ = internal_vertex_;
  out.external_face_ = external_face_;
  out.internal_face_ = internal_face_;
  for (const std::int32_t f : resize_numbers(out.external_face_, out.internal_face_, count)) faces.insert(f);
  const std::vector<std::int32_t> moved_vertices = resize_numbers(out.external_vertex_, out.internal_vertex_, vertices);
  for (const std::int32_t v : moved_vertices) {
    for (const std::int32_t h : this->out(internal_vertex(v))) {
      if (const std::int32_t f = external_face_[h / 3]; index(f) < count) faces.insert(f);
    }
  }
  // And the faces around, for what they name.
  const auto add_neighbors = [&](const IntrinsicMesh& of, std::int32_t f) {
    for (std::int32_t h = 3 * f; h < 3 * f + 3; ++h) {
      if (const std::int32_t twin = of.twins[h]; twin >= 0 && index(twin / 3) < count) faces.insert(twin / 3);
    }
  };
  const std::size_t own = faces.numbers().size();
  for (const std::int32_t f : former_faces) add_neighbors(before, f);
  for (std::size_t i = 0; i < own; ++i) add_neighbors(mesh, faces.numbers()[i]);

  for (const std::int32_t f : faces.numbers()) {
    for (std::int32_t h = 3 * f; h < 3 * f + 3; ++h) check_half_edge(mesh, h);
  }
  for (const std::int32_t f : faces.numbers()) check_triangle_inequality(mesh, index(f));
  check_longest(mesh);

  out.faces_.resize(count);
  InsertionMap around;  // internal numbers of the vertices of all these faces
  for (const std::int32_t f : faces.numbers()) {
    out.set_face(mesh, f);
    for (const std::int32_t v : mesh.triangles[f]) around.insert(out.internal_vertex(v));
  }
  for (const std::int32_t f : former_faces) {
    for (const std::int32_t v : before.triangles[f]) {
      if (index(v) < vertices) around.insert(out.internal_vertex(v));
    }
  }
  for (std::size_t v = former_vertices; v < vertices; ++v) around.insert(static_cast<std::int32_t>(v));
  out.list_loose_edges(mesh);
  for (const std::int32_t v : moved_vertices) {
    around.insert(out.internal_vertex(v));
    for (const Loose& edge : out.loose(out.internal_vertex(v))) around.insert(edge.to);
  }
  std::vector<std::int32_t> rows = around.numbers();
  std::ranges::sort(rows);
  task.check(0.6);
  out.patch_rows(*this, faces.numbers(), rows);
  out.measure_edges();
  out.is_pseudo_source_.resize(vertices);
  for (const std::int32_t v : rows) out.is_pseudo_source_[v] = out.may_bend(v) ? kPseudoSource : 0;
  return out;
}

/// Rows of half-edges: made anew for some vertices, ascending, whose faces, by external numbers, may be
/// others; the rest is that of the former mesh.
void GeodesicMesh::patch_rows(const GeodesicMesh& former, const std::vector<std::int32_t>& faces,
                              const std::vector<std::int32_t>& vertices) {
  std::vector<std::pair<std::int32_t, std::int32_t>> leaving;  // vertex, half-edge
  std::vector<bool> is_new(faces_.size(), false);
  for (const std::int32_t face : faces) {
    const std::int32_t own = internal_face_[face];
    is_new[own] = true;
    for (std::int32_t h = 3 * own; h < 3 * own + 3; ++h) leaving.emplace_back(half_edge(h).tail, h);
  }
  for (const std::int32_t v : vertices) {
    if (index(v) >= former.vertex_count()) continue;
    for (const std::int32_t h : former.out(v)) {
      if (index(h) < half_edge_count() && !is_new[h / 3]) leaving.emplace_back(v, h);
    }
  }
  std::ranges::sort(leaving);
  auto next = leaving.begin();
  out_ = former.out_.with_rows(vertex_count(), vertices, [&](std::int32_t v, const auto& add) {
    for (; next != leaving.end() && next->first == v; ++next) add(next->second);
  });
}

}  // namespace seamwire::detail
