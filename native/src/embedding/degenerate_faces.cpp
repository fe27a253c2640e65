// SPDX-License-Identifier: GPL-3.0-or-later
#include "embedding/degenerate_faces.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <numeric>

namespace seamwire {

namespace {

using VertexHandle = HalfEdgeMesh::VertexHandle;
using HalfedgeHandle = HalfEdgeMesh::HalfedgeHandle;
using EdgeHandle = HalfEdgeMesh::EdgeHandle;
using FaceHandle = HalfEdgeMesh::FaceHandle;

// A face lower than this fraction of its longest edge has no area. Bisecting it never ends: its parts have none either.
constexpr double kFlat = 1e-9;
// Lengths that differ by less than this fraction are equal: rounding depends on the scale of the input.
constexpr double kEqual = 1e-9;
// Times that all faces without an area are looked at, each time because some could be taken away the time before.
constexpr int kMendingPasses = 64;

}  // namespace

bool lacks_area(const Vector& a, const Vector& b, const Vector& c) {
  return !(a.cross(b).norm() > kFlat * std::max({a.squaredNorm(), b.squaredNorm(), c.squaredNorm()}));
}

Mending::Mending(const Surface& surface, const Metric& metric) : surface_(surface), metric_(metric) {
  const HalfEdgeMesh& given = surface.half_edges();
  const double scale = surface.scale();
  std::vector<FaceHandle> flat;
  for (const FaceHandle f : given.faces()) {
    const HalfedgeHandle h = given.halfedge_handle(f);
    const Vector &p = given.point(given.from_vertex_handle(h)), &q = given.point(given.to_vertex_handle(h)),
                 &r = given.point(given.to_vertex_handle(given.next_halfedge_handle(h)));
    if (lacks_area((q - p) * scale, (r - q) * scale, (p - r) * scale)) flat.push_back(f);
  }
  found_any_ = !flat.empty();
  if (!found_any_) return;
  mesh_ = given;
  origins_.resize(mesh_.n_faces());
  std::iota(origins_.begin(), origins_.end(), 0);
  const auto mended = [&](FaceHandle f) { return is_gone(f) || !is_flat(f); };
  const std::size_t before = flat.size();
  bool progress = before > 0;
  for (int pass = 0; progress && pass < kMendingPasses; ++pass) {
    progress = false;
    for (std::size_t i = 0, count = flat.size(); i < count; ++i) {
      if (mended(flat[i])) continue;
      if (merge_ends(flat[i])) {
        progress = true;
      } else if (const FaceHandle beyond = flip_longest(flat[i]); beyond.is_valid()) {
        progress = true;
        flat.push_back(beyond);
      }
    }
    std::erase_if(flat, mended);
    std::sort(flat.begin(), flat.end());
    flat.erase(std::unique(flat.begin(), flat.end()), flat.end());
  }
  taken_away_ = before - std::min(before, flat.size());
}

// Of the faces that are left, in their order.
std::vector<std::int32_t> Mending::origins() const {
  std::vector<std::int32_t> left;
  for (const FaceHandle f : mesh_.faces()) left.push_back(origins_[f.idx()]);
  return left;
}

// From the face's first corner on, as OpenMesh lists its vertices.
std::array<HalfedgeHandle, 3> Mending::sides(FaceHandle f) const {
  const HalfedgeHandle a = mesh_.halfedge_handle(f), b = mesh_.next_halfedge_handle(a);
  return {b, mesh_.next_halfedge_handle(b), a};
}

// A half-edge in the unit cube.
Vector Mending::vector(HalfedgeHandle h) const {
  return (mesh_.point(mesh_.to_vertex_handle(h)) - mesh_.point(mesh_.from_vertex_handle(h))) * surface_.scale();
}

bool Mending::is_flat(FaceHandle f) const {
  const auto [a, b, c] = sides(f);
  return lacks_area(vector(a), vector(b), vector(c));
}

// Merges the ends of the shortest edge if it is the reason why the face has no area.
bool Mending::merge_ends(FaceHandle f) {
  const auto by_length = [&](HalfedgeHandle a, HalfedgeHandle b) {
    return vector(a).squaredNorm() < vector(b).squaredNorm();
  };
  const auto all = sides(f);
  const auto [shortest, longest] = std::minmax_element(all.begin(), all.end(), by_length);
  if (vector(*shortest).norm() > kFlat * vector(*longest).norm()) return false;
  if (!has_merged_) {
    mesh_.request_vertex_status();
    mesh_.request_halfedge_status();
    mesh_.request_edge_status();
    mesh_.request_face_status();
    has_merged_ = true;
  }
  for (const HalfedgeHandle h : {*shortest, mesh_.opposite_halfedge_handle(*shortest)}) {
    const VertexHandle from = mesh_.from_vertex_handle(h), to = mesh_.to_vertex_handle(h);
    // A second edge between the two would become a loop.
    if (std::ranges::count(mesh_.vv_range(from), to) != 1 || !mesh_.is_collapse_ok(h)) continue;
    const std::int32_t a = surface_.vertex_of_fan()[from.idx()], b = surface_.vertex_of_fan()[to.idx()];
    merged_.push_back({a, b, edge_length(surface_, metric_, a, b)});
    mesh_.collapse(h);
    return true;
  }
  return false;
}

// Flips the longest edge if that leaves fewer faces without an area, or shorter edges; then, and only then, returns the
// face that was beyond it.
FaceHandle Mending::flip_longest(FaceHandle f) {
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
  const double flipped = (apex(opposite) - apex(h)).norm() * surface_.scale();
  if (is_flat(beyond) && !(flipped < vector(h).norm() * (1 - kEqual))) return FaceHandle();
  mesh_.flip(e);
  origins_[f.idx()] = origins_[beyond.idx()];
  return beyond;
}

}  // namespace seamwire
