// SPDX-License-Identifier: GPL-3.0-or-later
#include "geodesics/submesh.hpp"

#include <algorithm>
#include <numeric>

namespace seamwire::detail {

void SubmeshCutter::number(std::span<const std::int32_t> vertices) {
  for (const std::int32_t v : used_vertices_) part_vertex_[v] = 0;
  for (const std::int32_t f : used_faces_) part_face_[f] = 0;
  used_vertices_.clear();
  used_faces_.clear();
  const auto use = [](std::int32_t item, ZeroedArray<std::int32_t>& number, std::vector<std::int32_t>& used) {
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
}

Submesh SubmeshCutter::cut(std::span<const std::int32_t> vertices) {
  number(vertices);
  const std::shared_ptr<GeodesicMesh> part(new GeodesicMesh);
  const auto own_half_edge = [&](std::int32_t h) {
    if (h < 0) return -1;
    const std::int32_t face = part_face_[h / 3] - 1;
    return face < 0 ? -1 : 3 * face + h % 3;
  };
  part->faces_.resize(used_faces_.size());
  part->is_pseudo_source_.resize(used_vertices_.size());
  for (std::size_t v = 0; v < used_vertices_.size(); ++v) {
    part->is_pseudo_source_[v] = mesh_.is_pseudo_source_[used_vertices_[v]];
  }
  if (mesh_.has_siblings()) part->siblings_.assign(part->half_edge_count(), -1);
  std::vector<Triangle> corners;
  corners.reserve(used_faces_.size());
  for (std::size_t own = 0; own < used_faces_.size(); ++own) {
    const std::int32_t face = used_faces_[own];
    GeodesicMesh::Face copy = mesh_.faces_[index(face)];
    for (std::int32_t& v : copy.corners) v = part_vertex(v);
    for (std::size_t i = 0; i < 3; ++i) {
      copy.twins[i] = own_half_edge(copy.twins[i]);
      if (copy.twins[i] < 0) {
        for (const std::int32_t v : {copy.corners[i], copy.corners[(i + 1) % 3]}) {
          part->is_pseudo_source_[v] |= GeodesicMesh::kPseudoSource;
        }
      }
      const std::int32_t h = 3 * face + static_cast<std::int32_t>(i);
      if (mesh_.sibling(h) >= 0) {  // the next one of those that are inside
        std::int32_t other = mesh_.sibling(h);
        while (own_half_edge(other) < 0) other = mesh_.sibling(other);
        if (other != h) part->siblings_[3 * own + i] = own_half_edge(other);
      }
    }
    corners.push_back(copy.corners);
    part->faces_.edit(own) = copy;
  }
  part->external_vertex_.resize(used_vertices_.size());
  std::iota(part->external_vertex_.begin(), part->external_vertex_.end(), 0);
  part->internal_vertex_ = part->external_vertex_;
  part->external_face_.resize(used_faces_.size());
  std::iota(part->external_face_.begin(), part->external_face_.end(), 0);
  part->internal_face_ = part->external_face_;
  part->out_ = GeodesicMesh::leaving(used_vertices_.size(), corners, {});
  for (const std::int32_t v : used_vertices_) {
    for (const auto& [to, length] : mesh_.loose(v)) {
      if (part_vertex(to) >= 0) part->loose_.push({part_vertex(to), length});
    }
    part->loose_.end_row();
  }
  return {part, used_vertices_, used_faces_};
}

}  // namespace seamwire::detail
