// SPDX-License-Identifier: GPL-3.0-or-later
#include "embedding/degenerate_faces.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <numeric>
#include <utility>

#include "surface/face_height.hpp"

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

/// Removes degenerate faces from a mesh.
class DegenerateFaces {
 public:
  DegenerateFaces(const Surface& surface, const Metric& metric)
      : surface_(surface), metric_(metric), mesh_(surface.half_edges()), origins_(mesh_.n_faces()) {
    std::iota(origins_.begin(), origins_.end(), 0);
  }

  /// The faces given, in ascending order, and others that become degenerate.
  CleanMesh remove(std::vector<FaceHandle> degenerate);

 private:
  std::array<HalfedgeHandle, 3> sides(FaceHandle f) const;
  Vector vector(HalfedgeHandle h) const;
  bool is_degenerate(FaceHandle f) const;
  bool is_removed(FaceHandle f) const { return has_collapsed_ && mesh_.status(f).deleted(); }
  bool collapse_needle(FaceHandle f);
  FaceHandle flip_cap(FaceHandle f);

  const Surface& surface_;
  const Metric& metric_;
  HalfEdgeMesh mesh_;
  std::vector<std::int32_t> origins_;
  std::vector<LooseEdge> merged_;
  bool has_collapsed_ = false;
};

CleanMesh DegenerateFaces::remove(std::vector<FaceHandle> degenerate) {
  const auto is_done = [&](FaceHandle f) { return is_removed(f) || !is_degenerate(f); };
  const std::size_t before = degenerate.size();
  bool progress = before > 0;
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
    degenerate.erase(std::unique(degenerate.begin(), degenerate.end()), degenerate.end());
  }
  CleanMesh clean;
  for (const FaceHandle f : mesh_.faces()) clean.origins.push_back(origins_[f.idx()]);
  clean.merged = std::move(merged_);
  clean.removed = before - std::min(before, degenerate.size());
  clean.mesh = std::move(mesh_);
  return clean;
}

// From the face's first corner on, as OpenMesh lists its vertices.
std::array<HalfedgeHandle, 3> DegenerateFaces::sides(FaceHandle f) const {
  const HalfedgeHandle a = mesh_.halfedge_handle(f), b = mesh_.next_halfedge_handle(a);
  return {b, mesh_.next_halfedge_handle(b), a};
}

// A half-edge in the unit cube.
Vector DegenerateFaces::vector(HalfedgeHandle h) const {
  return (mesh_.point(mesh_.to_vertex_handle(h)) - mesh_.point(mesh_.from_vertex_handle(h))) * surface_.scale();
}

bool DegenerateFaces::is_degenerate(FaceHandle f) const {
  const auto [a, b, c] = sides(f);
  return !has_area(vector(a), vector(b), vector(c));
}

// Collapses the shortest edge of a needle; false for other faces, and where that is impossible.
bool DegenerateFaces::collapse_needle(FaceHandle f) {
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

// Flips the longest edge of a cap if that leaves fewer degenerate faces, or shorter edges. Returns the face that was
// beyond it; an invalid handle where nothing was flipped.
FaceHandle DegenerateFaces::flip_cap(FaceHandle f) {
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
  if (is_degenerate(beyond) && !(flipped < vector(h).norm() * (1 - kEqual))) return FaceHandle();
  mesh_.flip(e);
  origins_[f.idx()] = origins_[beyond.idx()];
  return beyond;
}

}  // namespace

std::optional<CleanMesh> remove_degenerate_faces(const Surface& surface, const Metric& metric) {
  std::vector<FaceHandle> degenerate;
  for (const std::int32_t f : half_edge_faces(surface, surface.report().zero_area_faces)) degenerate.emplace_back(f);
  if (degenerate.empty()) return std::nullopt;
  return DegenerateFaces(surface, metric).remove(std::move(degenerate));
}

}  // namespace seamwire::detail
