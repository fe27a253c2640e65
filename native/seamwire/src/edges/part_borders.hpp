// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <span>
#include <unordered_map>
#include <vector>

#include "edges/edge_adjacency.hpp"
#include "seamwire/surface/surface.hpp"
#include "surface/corner_fans.hpp"

namespace seamwire::detail {

/// Numbers of vertices, or half-edges of CornerFans.
using Numbers = std::vector<std::int32_t>;
/// A closed chain of vertices, which does not repeat its first one.
using VertexChain = Numbers;

/// The edges of a chain, each with the smaller vertex first.
std::vector<Edge> sides_of(std::span<const std::int32_t> chain, bool closed);
double length_of(const std::vector<Vector>& points, std::span<const Edge> edges);

/// Finds the borders of parts and of flat faces, and closed chains that come back beside themselves.
///
/// Triangles are those of CornerFans. Borders that meet themselves are left out.
class PartBorders {
 public:
  /// The surface and its adjacency must outlive this.
  PartBorders(const Surface& surface, const EdgeAdjacency& adjacency);

  /// Adds one way to divide the surface into parts: the part of each of the caller's triangles. Throws InvalidInput.
  void add_parts(std::span<const std::int32_t> labels);

  /// The triangle of one of the caller's, or -1 if the surface left it out.
  std::int32_t triangle_of(std::int32_t face) const;

  /// The borders through an edge between parts beside it, for each way, shortest first.
  std::vector<VertexChain> borders(const Edge& edge) const;
  /// The borders of the part that a triangle belongs to, for each way.
  std::vector<std::vector<VertexChain>> around(std::int32_t triangle) const;
  /// The rim around the small part that a triangle belongs to, such as a button or a bung: the part has no other
  /// border.
  VertexChain plug_rim(std::int32_t triangle) const;
  /// The outer border of the flat face of a triangle: its polygon, and polygons around it in the same plane.
  VertexChain flat_face(std::int32_t triangle) const;

  /// Whether a closed chain doubles back within a short way, or is a tiny circle of few edges. How far it turns is
  /// measured within the surface: a ring over the rims of a thin plate goes straight on.
  bool is_hairpin(std::span<const std::int32_t> chain) const;
  /// How far a closed chain turns to the left at each vertex, in radians: the discrete geodesic curvature (Polthier and
  /// Schmies 1998). Zero along a boundary, and where the faces are no single fan.
  std::vector<double> turns(std::span<const std::int32_t> chain) const;

 private:
  friend class Tubes;
  /// The edges around a set of triangles, and whether the set is a tube with two rims.
  struct Region {
    std::vector<Numbers> borders;  ///< half-edges; none if one of them is too long
    bool is_tube = false;
  };
  struct Parts {
    Numbers labels;
    std::vector<Region> regions;
    std::vector<double> areas;
  };
  /// Some triangles, ascending, and whether each triangle is one of them.
  struct Triangles {
    Numbers numbers;
    std::vector<bool> contains;
    bool is_whole = false;  ///< false if the limit ended the search for more
  };

  template <class IsIn>
  Region region_of(std::span<const std::int32_t> triangles, const IsIn& is_in) const;
  template <class Joins>
  Triangles connected(std::int32_t triangle, const Joins& joins, std::size_t most) const;
  Triangles plane_around(std::int32_t triangle) const;

  VertexChain chain_of(const Numbers& half_edges) const;
  std::vector<VertexChain> borders_of(const Parts& parts, std::int32_t triangle) const;
  bool is_boundary(std::int32_t half_edge) const {
    return mesh_.twins[half_edge] < 0 && !mesh_.has_siblings(half_edge);
  }
  bool is_real(std::int32_t half_edge) const { return adjacency_.find(tail(half_edge), tip(half_edge)) >= 0; }
  std::int32_t tail(std::int32_t half_edge) const { return mesh_.vertices[mesh_.tail(half_edge)]; }
  std::int32_t tip(std::int32_t half_edge) const { return mesh_.vertices[mesh_.tip(half_edge)]; }
  /// Calls visit(h) for each half-edge that begins at a vertex.
  template <class Visit>
  void for_each_leaving(std::int32_t v, const Visit& visit) const;
  std::int32_t half_edge(std::int32_t from, std::int32_t to) const;
  Numbers half_edges_of(const Edge& edge) const;
  std::optional<double> angle(std::int32_t here, std::int32_t first, std::int32_t last) const;

  const Surface& surface_;
  const EdgeAdjacency& adjacency_;
  const CornerFans& mesh_;
  std::vector<Vector> normals_;  // of length one; of triangles without area zero
  std::vector<double> areas_;
  double area_ = 0.0;
  std::vector<Parts> steps_;
};

/// Finds the tubes that edges lie inside of. A tube is a part, an open piece, or in an undivided piece the wall up to
/// sharp edges, lids and the boundary.
class Tubes {
 public:
  explicit Tubes(const PartBorders& borders) : borders_(borders), wall_of_(borders.areas_.size(), -1) {}

  /// Both rims of the tube that an edge lies inside of, the same object for each edge of a tube; null without a tube.
  const std::vector<VertexChain>* rims(const Edge& edge);
  /// The edges that meet an edge inside of the same tube.
  std::vector<Edge> beside(const Edge& edge);

 private:
  using Rims = std::vector<VertexChain>;
  std::int32_t wall(std::int32_t triangle);
  PartBorders::Triangles find_wall(std::int32_t triangle, Rims& rims) const;
  std::vector<bool> lids(const PartBorders::Triangles& wall) const;
  Rims rims_of(const PartBorders::Region& region) const;

  const PartBorders& borders_;
  Numbers wall_of_;                               // per triangle, -1 if it is not known
  std::deque<Rims> walls_;                        // empty if a wall is no tube
  std::unordered_map<std::int32_t, Rims> parts_;  // the same
};

}  // namespace seamwire::detail
