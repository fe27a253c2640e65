// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "seamwire/metric/metric.hpp"
#include "seamwire/surface/half_edge_mesh.hpp"
#include "seamwire/surface/intrinsic_mesh.hpp"
#include "seamwire/surface/surface.hpp"

namespace seamwire {

/// Whether a triangle with these sides has no area: it is lower than 1e-9 of its longest side.
bool lacks_area(const Vector& a, const Vector& b, const Vector& c);

/// Takes away faces without an area, across which no path could go, on a copy of the surface's half-edge mesh and
/// without a change to the surface.
class Mending {
 public:
  Mending(const Surface& surface, const Metric& metric);

  bool found_any() const { return found_any_; }
  const HalfEdgeMesh& mesh() const { return mesh_; }
  std::vector<std::int32_t> origins() const;
  const std::vector<LooseEdge>& merged() const { return merged_; }
  std::size_t taken_away() const { return taken_away_; }

 private:
  std::array<HalfEdgeMesh::HalfedgeHandle, 3> sides(HalfEdgeMesh::FaceHandle f) const;
  Vector vector(HalfEdgeMesh::HalfedgeHandle h) const;
  bool is_flat(HalfEdgeMesh::FaceHandle f) const;
  bool is_gone(HalfEdgeMesh::FaceHandle f) const { return has_merged_ && mesh_.status(f).deleted(); }
  bool merge_ends(HalfEdgeMesh::FaceHandle f);
  HalfEdgeMesh::FaceHandle flip_longest(HalfEdgeMesh::FaceHandle f);

  const Surface& surface_;
  const Metric& metric_;
  HalfEdgeMesh mesh_;
  bool found_any_ = false;
  std::vector<std::int32_t> origins_;
  std::vector<LooseEdge> merged_;  // between vertices at the same place, of which only the second has faces now
  bool has_merged_ = false;
  std::size_t taken_away_ = 0;
};

}  // namespace seamwire
