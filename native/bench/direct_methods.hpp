// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCholesky>
#include <cstdint>
#include <utility>
#include <vector>

#include "seamwire/metric/metric.hpp"
#include "seamwire/surface/intrinsic_mesh.hpp"
#include "seamwire/surface/surface.hpp"

/// Plain versions of the methods that Section 2.3 of the paper argues against, for comparison. Each gives the distances
/// from one seed at all vertices. Distances are infinite at vertices that it does
/// not reach.
namespace seamwire::bench {

/// A surface with a metric, as these methods read it. All read the same one: a quadratic form at each vertex, the
/// ambient reading of metric.hpp, in between linear.
struct MetricSurface {
  std::vector<Vector> points;  ///< of the surface
  std::vector<Triangle> triangles;
  std::vector<std::int32_t> twins;          ///< per half-edge, as in IntrinsicMesh
  Metric metric;                            ///< at the vertices
  std::vector<Eigen::Matrix3d> forms;       ///< at the vertices: the ambient form, also along the normal
  std::vector<Eigen::Matrix3d> face_forms;  ///< the mean of those at the corners
  std::vector<std::vector<std::int32_t>> neighbors;
};
/// Throws InvalidInput where the surface is not manifold, or not oriented as it is given, or has degenerate or
/// duplicate faces, or edges without a face.
MetricSurface metric_surface(const Surface& surface, const Metric& metric);

/// Every triangle cut into four, `levels` times, in its plane; tensors between others as the paper's subdivision has
/// them (midpoint_tensor()). The first vertices are the given ones.
std::pair<Surface, Metric> refined(const Surface& surface, const Metric& metric, int levels);

/// Dijkstra along edges.
std::vector<double> edge_dijkstra(const MetricSurface& surface, std::int32_t seed);

/// Dijkstra over faces, between `per_edge` points on each edge and the vertices: Lanthier, Maheshwari, Sack,
/// "Approximating Weighted Shortest Paths on Polyhedral Surfaces" (1997); a segment's length is integrated_length().
std::vector<double> steiner_dijkstra(const MetricSurface& surface, std::int32_t seed, int per_edge);

/// Campen, Heistermann, Kobbelt, "Practical Anisotropic Geodesy" (2013): Dijkstra along edges, but the length of the
/// last up to `memory` edges is that of their sum, of which the shortest counts. Each edge, and its form, is turned by
/// the least rotations from vertex to vertex along the path to its end. The sum cuts corners where the surface bends.
std::vector<double> short_term_vector_dijkstra(const MetricSurface& surface, std::int32_t seed, int memory);

/// Sethian, Vladimirsky, "Ordered Upwind Methods for Static Hamilton-Jacobi Equations" (2003). A vertex takes its
/// distance, by its own form, from segments of the accepted front. It looks as far as the longest edge beside it times
/// the anisotropy of its own tensor, which the bound needs. The paper takes the largest anisotropy of all, which makes
/// vertices where the metric is round look over features. Vectors there are sums of edges, turned to its normal.
std::vector<double> ordered_upwind(const MetricSurface& surface, std::int32_t seed);

/// Crane, Weischedel, Wardetzky, "Geodesics in Heat" (2013), with the Laplacian of the faces in their forms; time step:
/// the square of the mean edge length in the metric, times `steps`. Where angles are obtuse in the metric heat falls
/// below zero around a seed, unless the step is a longer one.
class HeatMethod {
 public:
  /// Factors both matrices. Throws InvalidInput where one cannot be.
  explicit HeatMethod(const MetricSurface& surface, double steps = 1.0);
  std::vector<double> solve(std::int32_t seed) const;

 private:
  using Solver = Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>>;
  std::vector<Triangle> triangles_;
  std::vector<Eigen::Matrix<double, 2, 3>> gradients_;  // a face: those of the hat functions of its corners
  std::vector<double> areas_;
  Solver heat_, poisson_;
};

/// Kimmel, Sethian, "Computing Geodesic Paths on Manifolds" (1998), on edge lengths: fast marching, obtuse corners
/// split by unfolding what lies opposite.
class FastMarching {
 public:
  explicit FastMarching(const IntrinsicMesh& mesh);
  std::vector<double> solve(std::int32_t seed) const;

 private:
  // The vertex `to` takes a distance from the segment from a vertex to `other`: as vectors in the plane, `target` goes
  // from there to it, `segment` to `other`.
  struct Update {
    std::int32_t to, other;
    Eigen::Vector2d target, segment;
  };
  void add(std::int32_t to, std::int32_t a, std::int32_t b, const Eigen::Vector2d& at_a, const Eigen::Vector2d& at_b);

  std::vector<std::vector<Update>> updates_;  // a vertex: those that its distance allows
};

/// Ying, Wang, He, "Saddle Vertex Graph (SVG): A Novel Solution to the Discrete Geodesic Problem" (2013), on edge
/// lengths. The graph joins vertices whose geodesic is direct, which means that it passes no other vertex. Geodesics
/// bend at saddle vertices only, so each is a chain of direct ones, and Dijkstra on the graph finds it. For speed, each
/// vertex is joined only to others among the `disc` vertices nearest to it. With all vertices, distances are exact.
class SaddleVertexGraph {
 public:
  /// Finds the disc of each vertex. Loose edges are ignored.
  SaddleVertexGraph(const IntrinsicMesh& mesh, int disc);
  std::vector<double> solve(std::int32_t seed) const;

 private:
  struct Arc {
    std::int32_t to;
    double length;
  };
  std::vector<std::vector<Arc>> arcs_;  // per vertex
};

}  // namespace seamwire::bench
