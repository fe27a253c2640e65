// SPDX-License-Identifier: GPL-3.0-or-later
#include "embedding/degenerate_faces.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <map>
#include <numeric>
#include <tuple>
#include <utility>
#include <vector>

#include "detail/drop_repeats.hpp"
#include "detail/index.hpp"
#include "graph/disjoint_sets.hpp"
#include "surface/corner_fans.hpp"
#include "surface/exact_unit.hpp"
#include "surface/face_height.hpp"
#include "surface/half_edge_mesh.hpp"

namespace seamwire::detail {

namespace {

using VertexHandle = HalfEdgeMesh::VertexHandle;
using HalfedgeHandle = HalfEdgeMesh::HalfedgeHandle;
using EdgeHandle = HalfEdgeMesh::EdgeHandle;
using FaceHandle = HalfEdgeMesh::FaceHandle;

// Lengths that differ by less than this fraction are equal: rounding depends on the scale of the input.
constexpr double kEqual = 1e-9;
// Passes over the degenerate faces, each because some could be removed in the one before.
constexpr int kMostPasses = 64;

// OpenMesh's half-edges, but for those of deleted faces, in the order of faces, each from its first corner on, as
// OpenMesh lists them.
std::vector<HalfedgeHandle> half_edges_of_faces(const HalfEdgeMesh& mesh) {
  std::vector<HalfedgeHandle> half_edges;
  half_edges.reserve(3 * mesh.n_faces());
  for (const FaceHandle f : mesh.faces()) {
    const HalfedgeHandle last = mesh.halfedge_handle(f), first = mesh.next_halfedge_handle(last);
    half_edges.insert(half_edges.end(), {first, mesh.next_halfedge_handle(first), last});
  }
  return half_edges;
}

/// Removes degenerate faces from a mesh.
class DegenerateFaces {
 public:
  explicit DegenerateFaces(const Surface& surface)
      : surface_(surface),
        unit_(exact_unit(surface)),
        mesh_(half_edge_mesh(surface)),
        origins_(mesh_.n_faces()),
        vertex_of_fan_(corner_fans(surface).vertices),
        names_(corner_fans(surface).siblings.empty() ? 0 : mesh_.n_edges()),
        same_edges_(names_.size()) {
    std::iota(origins_.begin(), origins_.end(), 0);
    std::iota(names_.begin(), names_.end(), 0);
    join_siblings();
  }

  /// The faces given, in ascending order, and others that become degenerate.
  CleanedFans remove(std::vector<FaceHandle> degenerate) {
    const auto is_done = [&](FaceHandle f) { return is_removed(f) || !is_degenerate(f); };
    bool progress = !degenerate.empty();
    for (int pass = 0; progress && pass < kMostPasses; ++pass) {
      progress = false;
      for (std::size_t i = 0, count = degenerate.size(); i < count; ++i) {
        if (is_done(degenerate[i])) continue;
        if (collapse_needle(degenerate[i])) {
          progress = true;
        } else if (const FaceHandle beyond = flip_cap(degenerate[i]); beyond.is_valid()) {
          progress = true;
          degenerate.push_back(beyond);
        }
      }
      std::erase_if(degenerate, is_done);
      std::sort(degenerate.begin(), degenerate.end());
      drop_repeats(degenerate);
    }
    CleanedFans clean;
    flatten(clean);
    for (const FaceHandle f : mesh_.faces()) clean.origins.push_back(origins_[f.idx()]);
    for (std::size_t f = 0; f < clean.origins.size(); ++f) {
      clean.by_origin.emplace_back(clean.origins[f], static_cast<std::int32_t>(f));
    }
    std::ranges::sort(clean.by_origin);
    for (const FaceHandle f : degenerate) clean.degenerate.push_back(origins_[f.idx()]);
    std::ranges::sort(clean.degenerate);
    clean.vertices = std::move(vertex_of_fan_);
    if (!names_.empty()) relink_siblings(clean);
    clean.merged = std::move(merged_);
    return clean;
  }

 private:
  // The triangles that are left, and which of their half-edges are twins.
  void flatten(CleanedFans& flat) const {
    const std::vector<HalfedgeHandle> half_edges = half_edges_of_faces(mesh_);
    std::vector<std::int32_t> numbers(mesh_.n_halfedges(), -1);
    for (std::size_t h = 0; h < half_edges.size(); ++h) numbers[half_edges[h].idx()] = static_cast<std::int32_t>(h);
    flat.triangles.resize(half_edges.size() / 3);
    flat.twins.resize(half_edges.size());
    for (std::size_t h = 0; h < half_edges.size(); ++h) {
      flat.triangles[h / 3][h % 3] = mesh_.from_vertex_handle(half_edges[h]).idx();
      flat.twins[h] = numbers[half_edges[h].idx() ^ 1];
    }
  }

  // Siblings are the half-edges of one edge that are left, if they still have the same ends.
  void relink_siblings(CleanedFans& flat) {
    using Key = std::tuple<std::int32_t, Edge, std::int32_t>;  // name, ends, half-edge
    std::vector<Key> open;
    const std::vector<HalfedgeHandle> half_edges = half_edges_of_faces(mesh_);
    for (std::int32_t h = 0; index(h) < flat.twins.size(); ++h) {
      if (flat.twins[h] >= 0) continue;
      const auto [a, b] = std::minmax({flat.vertices[flat.tail(h)], flat.vertices[flat.tip(h)]});
      open.emplace_back(same_edges_.find(names_[half_edges[h].idx() / 2]), Edge{a, b}, h);
    }
    std::ranges::sort(open);
    flat.siblings.assign(flat.twins.size(), -1);
    const auto edge = [](const Key& key) { return std::pair(std::get<0>(key), std::get<1>(key)); };
    for (auto from = open.begin(); from != open.end();) {
      const auto to = std::find_if(from, open.end(), [&](const Key& key) { return edge(key) != edge(*from); });
      for (auto at = from; to - from > 1 && at != to; ++at) {
        flat.siblings[std::get<2>(*at)] = std::get<2>(at + 1 == to ? *from : *(at + 1));
      }
      from = to;
    }
  }

  // From the face's first corner on, as OpenMesh lists its vertices.
  std::array<HalfedgeHandle, 3> sides(FaceHandle f) const {
    const HalfedgeHandle a = mesh_.halfedge_handle(f), b = mesh_.next_halfedge_handle(a);
    return {b, mesh_.next_halfedge_handle(b), a};
  }

  std::int32_t vertex(VertexHandle fan) const { return vertex_of_fan_[fan.idx()]; }

  // The corner fans of a vertex that have faces.
  std::vector<VertexHandle> fans_of(std::int32_t vertex) const {
    std::vector<VertexHandle> fans;
    const auto add = [&](VertexHandle fan) {
      const bool is_left = !mesh_.status(fan).deleted() && !mesh_.is_isolated(fan);
      if (is_left && this->vertex(fan) == vertex) fans.push_back(fan);
    };
    const std::vector<std::int32_t>& all = corner_fans(surface_).vertices;
    // Not std::ranges::equal_range: Clang 14 cannot read what libstdc++ 12 returns.
    const auto [begin, end] = std::equal_range(all.begin(), all.end(), vertex);
    for (auto at = begin; at != end; ++at) add(VertexHandle(static_cast<int>(at - all.begin())));
    if (const auto more = fans_merged_.find(vertex); more != fans_merged_.end())
      std::ranges::for_each(more->second, add);
    return fans;
  }

  // A half-edge in the unit of exact_unit().
  Vector vector(HalfedgeHandle h) const {
    return (mesh_.point(mesh_.to_vertex_handle(h)) - mesh_.point(mesh_.from_vertex_handle(h))) * unit_;
  }

  bool is_degenerate(FaceHandle f) const {
    const auto [a, b, c] = sides(f);
    return !has_area(vector(a), vector(b), vector(c));
  }

  bool is_removed(FaceHandle f) const { return has_collapsed_ && mesh_.status(f).deleted(); }

  // The edges of all faces at one edge of the surface are one.
  void join_siblings() {
    if (names_.empty()) return;
    const std::vector<HalfedgeHandle> half_edges = half_edges_of_faces(mesh_);
    const std::vector<std::int32_t>& siblings = corner_fans(surface_).siblings;
    for (std::size_t h = 0; h < siblings.size(); ++h) {
      if (siblings[h] >= 0) same_edges_.join(half_edges[h].idx() / 2, half_edges[index(siblings[h])].idx() / 2);
    }
  }

  // The half-edges from the corner fans of one vertex to those of another.
  std::vector<HalfedgeHandle> edges_between(std::int32_t from, std::int32_t to) const {
    std::vector<HalfedgeHandle> edges;
    for (const VertexHandle fan : fans_of(from)) {
      for (const HalfedgeHandle h : mesh_.voh_range(fan)) {
        if (vertex(mesh_.to_vertex_handle(h)) == to) edges.push_back(h);
      }
    }
    return edges;
  }

  bool can_collapse(HalfedgeHandle h) {
    if (!mesh_.is_collapse_ok(h)) return false;
    // A second edge between the two would become a loop.
    return std::ranges::count(mesh_.vv_range(mesh_.from_vertex_handle(h)), mesh_.to_vertex_handle(h)) == 1;
  }

  // Merges a vertex into another one at its place, with all its corner fans: in those that have an edge to the other
  // one, by collapsing that edge. False where that is impossible.
  bool merge(std::int32_t from, std::int32_t to) {
    if (from == to) return false;
    const std::vector<HalfedgeHandle> edges = edges_between(from, to);
    if (!std::ranges::all_of(edges, [&](HalfedgeHandle h) { return can_collapse(h); })) return false;
    merged_.push_back({from, to});
    // What has been collapsed may make a later edge impossible to collapse: then its fan keeps its vertex.
    for (const HalfedgeHandle h : edges) {
      if (can_collapse(h)) collapse(h);
    }
    const std::vector<VertexHandle> fans_left = fans_of(from);
    for (const VertexHandle fan : fans_left) {
      const auto is_to = [&](VertexHandle neighbor) { return vertex(neighbor) == to; };
      if (std::ranges::any_of(mesh_.vv_range(fan), is_to)) continue;
      vertex_of_fan_[fan.idx()] = to;
      mesh_.set_point(fan, surface_.points()[to]);
      fans_merged_[to].push_back(fan);
    }
    return true;
  }

  // Collapses a half-edge. The two other sides of each face at it become one edge.
  void collapse(HalfedgeHandle h) {
    for (const HalfedgeHandle side : {h, mesh_.opposite_halfedge_handle(h)}) {
      if (names_.empty() || mesh_.is_boundary(side)) continue;
      const HalfedgeHandle next = mesh_.next_halfedge_handle(side), last = mesh_.next_halfedge_handle(next);
      same_edges_.join(names_[next.idx() / 2], names_[last.idx() / 2]);
    }
    mesh_.collapse(h);
  }

  // Collapses the shortest edge of a needle; false for other faces, and where that is impossible.
  bool collapse_needle(FaceHandle f) {
    const auto by_length = [&](HalfedgeHandle a, HalfedgeHandle b) {
      return vector(a).squaredNorm() < vector(b).squaredNorm();
    };
    const auto all = sides(f);
    const auto [shortest, longest] = std::minmax_element(all.begin(), all.end(), by_length);
    if (vector(*shortest).norm() > kNoArea * vector(*longest).norm()) return false;
    if (!has_collapsed_) {
      mesh_.request_vertex_status();
      mesh_.request_halfedge_status();
      mesh_.request_edge_status();
      mesh_.request_face_status();
      has_collapsed_ = true;
    }
    const HalfedgeHandle h = *shortest;
    const std::int32_t a = vertex(mesh_.from_vertex_handle(h)), b = vertex(mesh_.to_vertex_handle(h));
    return merge(a, b) || merge(b, a);
  }

  // Flips the longest edge of a cap if that leaves fewer degenerate faces, or shorter edges. Returns the face that was
  // beyond it; an invalid handle where nothing was flipped.
  FaceHandle flip_cap(FaceHandle f) {
    HalfedgeHandle h = sides(f)[0];
    for (const HalfedgeHandle side : sides(f)) {
      if (vector(side).squaredNorm() > vector(h).squaredNorm()) h = side;
    }
    const HalfedgeHandle opposite = mesh_.opposite_halfedge_handle(h);
    const EdgeHandle e = mesh_.edge_handle(h);
    if (mesh_.is_boundary(opposite) || !mesh_.is_flip_ok(e)) return FaceHandle();
    const FaceHandle beyond = mesh_.face_handle(opposite);
    const auto apex = [&](HalfedgeHandle side) {
      return mesh_.point(mesh_.to_vertex_handle(mesh_.next_halfedge_handle(side)));
    };
    const double flipped = (apex(opposite) - apex(h)).norm() * unit_;
    if (is_degenerate(beyond) && !(flipped < vector(h).norm() * (1 - kEqual))) return FaceHandle();
    mesh_.flip(e);
    if (!names_.empty()) names_[e.idx()] = same_edges_.add();
    origins_[f.idx()] = origins_[beyond.idx()];
    return beyond;
  }

  const Surface& surface_;
  const double unit_;
  HalfEdgeMesh mesh_;
  std::vector<std::int32_t> origins_;
  std::vector<std::int32_t> vertex_of_fan_;
  std::map<std::int32_t, std::vector<VertexHandle>> fans_merged_;  // those that a vertex has from others
  std::vector<std::int32_t> names_;                                // per edge: a number in the sets; empty: no siblings
  DisjointSets same_edges_;
  std::vector<Edge> merged_;
  bool has_collapsed_ = false;
};

}  // namespace

std::shared_ptr<const CleanedFans> cleaned_fans(const Surface& surface, const Task& task) {
  if (surface.report().zero_area_faces.empty()) return nullptr;
  std::vector<FaceHandle> degenerate;
  for (const std::int32_t f : half_edge_faces(surface, surface.report().zero_area_faces)) degenerate.emplace_back(f);
  if (degenerate.empty()) return nullptr;
  return corner_fans(surface).cleaned->get(
      task, [&](const Task&) { return DegenerateFaces(surface).remove(std::move(degenerate)); });
}

}  // namespace seamwire::detail
