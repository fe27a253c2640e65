// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "seamwire/api.hpp"
#include "seamwire/metric/metric.hpp"
#include "seamwire/surface/intrinsic_mesh.hpp"
#include "seamwire/surface/surface.hpp"
#include "seamwire/task.hpp"

namespace seamwire {

/// The measure for the priority of an invalid triangle, and for sigma.
enum class Perimeter { kMetric, kEuclidean };

/// How far the subdivision goes.
struct EmbedOptions {
  /// Sigma of Section 4.1: bisection stops once every invalid triangle left has a smaller perimeter, of the model
  /// scaled to the unit cube. 0: until none is left.
  double sigma = 0.0;
  Perimeter perimeter = Perimeter::kMetric;  ///< which triangle is bisected first, and what sigma is compared with
  /// At most this many triangles are added; what is invalid then becomes a hole. A larger cap never leaves more holes.
  std::size_t max_faces_added = 4'000'000;
  /// The mean relative error of distances to aim for, in [0, 1]: triangles are bisected until they resolve the metric
  /// that well. 0: only invalid triangles are bisected, as in the paper. The error is estimated, not proved (see
  /// Resolution).
  double max_error = 0.0;
  /// The caller's faces to embed, in any order; all others are left out, as if the surface ended there. Edges without a
  /// face stay. nullopt: all faces. The work is proportional to these faces, but all points are copied, because
  /// vertices keep their numbers. If one of the faces has no area, the work is that for all faces.
  std::optional<std::vector<std::int32_t>> faces = std::nullopt;
  /// The length in the metric that `max_error` compares the sizes of triangles with. 0 is the mean length of an edge of
  /// the faces to embed. Give the length of another embedding (Embedding::mean_edge_length) to refine in the same way.
  /// That is useful for a part of the surface, or for a changed metric.
  double mean_edge_length = 0.0;

  /// Member by member.
  friend bool operator==(const EmbedOptions&, const EmbedOptions&) = default;
};

/// How well the triangles of an embedding resolve the metric. Within a triangle, the embedding's metric is the constant
/// form that gives the three sides their lengths; the metric it approximates varies linearly between the forms at the
/// corners.
struct Resolution {
  /// The EmbedOptions::max_error that the worst triangle meets. Measured, not proved: the mean error of distances was
  /// at most about this on the models of docs/benchmarks/exactness.md.
  double estimated_error = 0.0;
  /// Triangles that miss the max_error, because they are 14 bisections deep, or because as many triangles were added
  /// as the budget or the cap allows.
  std::size_t unmet = 0;
  /// Eta, the largest |ln| of the ratio between a vector's length at a corner of a triangle and in the triangle.
  /// Proved: without holes, distances are within a factor of e^eta of those in a metric that varies linearly. It varies
  /// in each triangle of the embedding, between the forms at its corners.
  double largest_deviation = 0.0;
};

/// A surface in an anisotropic metric, as a refined mesh with edge lengths (Section 4.1). The first vertices are the
/// caller's, with their numbers; new ones are midpoints of edges.
struct Embedding {
  IntrinsicMesh mesh;  ///< the valid triangles; what stayed invalid is a hole, whose edges are still there to run along
  std::vector<Vector> points;             ///< in the caller's coordinates, one a vertex of `mesh`
  std::vector<std::int32_t> source_face;  ///< the caller's face that each triangle of `mesh` lies in
  std::size_t invalid_before = 0;         ///< invalid triangles of the input, those without an area among them
  std::size_t faces_added = 0;            ///< by the subdivision
  std::size_t newest_bisections = 0;      ///< of newest-vertex bisection, where the other schemes are left for it
  std::size_t invalid_left = 0;  ///< holes: faces without an area, smaller ones than sigma, or what the cap leaves
  bool hit_cap = false;          ///< max_faces_added ended the subdivision
  /// Of the faces embedded, in the metric, before any bisection, or EmbedOptions::mean_edge_length if that is given.
  double mean_edge_length = 0.0;
  std::optional<Resolution> resolution;  ///< set if EmbedOptions::max_error is above 0
  /// Edges that length repair gave another length than the metric does; and the largest factor, up or down, between the
  /// two lengths.
  std::size_t clamped_edges = 0;
  double worst_clamp = 1.0;  ///< that factor, 1 or more
  /// Faces of the surface that were embedded, counted again where that was begun anew: all, or after re_embed() those
  /// that the change has reached.
  std::size_t faces_embedded = 0;
  bool is_local = false;                     ///< re_embed() can go on from it: see there
  std::vector<std::int32_t> hole_faces;      ///< the caller's faces in which holes lie, ascending
  std::vector<std::int32_t> repaired_faces;  ///< those with an edge that length repair gave another length, ascending
  std::vector<std::int32_t>
      unreachable;       ///< the caller's vertices in a face, but in no valid triangle and on no edge to run along
  EmbedOptions options;  ///< those it was made with
};

/// Embeds a surface in a metric (Section 4.1 of the paper).
///
/// Bisects invalid triangles, which fail the triangle inequality, at the midpoint of their longest edge in the metric.
/// The largest perimeter comes first, until none is left. Lengths are those of the ambient reading of the norm
/// (metric.hpp). All faces at an edge are bisected together, also where there are three or more, or where they cannot
/// be oriented alike.
///
/// If that takes more than four times the surface's triangles, and 20 000, or the cap, it begins anew with schemes that
/// end: longest-edge propagation, newest-vertex bisection deep below a face, and length repair. Length repair bisects
/// an invalid triangle once more and gives its new edges lengths that make the parts valid. The result has at most one
/// and a half times the triangles of the first scheme if that ends (docs/method/embedding.md).
///
/// With a `max_error`, longest-edge propagation also bisects valid triangles that do not resolve the metric, and edges
/// are measured with their middles. If the cap does not allow all triangles to become valid, the schemes above follow.
///
/// Degenerate triangles, which have no area, are removed first: needles by collapsing their shortest edge, caps by
/// flipping their longest edge. One end of a collapsed edge then has no triangle, but a loose edge of length 0 to the
/// other end. A degenerate triangle that allows neither becomes a hole. Every edge of a hole that no valid triangle has
/// is a loose edge, so that what the input's edges connect stays connected.
///
/// \param metric a metric of the surface's vertices
/// \param task cancels, and is told the fraction done
/// \throws InvalidInput if the metric and the surface differ in size, a tensor is not finite, or an option is out of
/// range
/// \throws Cancelled
SEAMWIRE_API Embedding embed(const Surface& surface, const Metric& metric, const EmbedOptions& options = {},
                             const Task& task = {});

/// Embeds a surface in another metric, from its embedding in a former one. Only triangles around vertices where the two
/// metrics differ are bisected anew. The result is that of embed(surface, metric, options), except for the numbers of
/// new vertices and triangles. The bisections of a triangle depend only on the triangles that are bisected together
/// with it. So these are made anew too, and the triangles that they then reach. Otherwise the cost is comparing the
/// metrics, vertex by vertex.
///
/// If `old` is not local, or the normals of the metrics differ, this is embed(). An embedding is not local if it has
/// holes, a `max_error`, only some faces, or the work of another scheme than the first, or if the surface has
/// degenerate faces or is not manifold and oriented. Sizes are compared with the mean edge length of `old` unless the
/// options give one, so a stroke does not change what `max_error` means elsewhere. `old` must be of the same surface,
/// the metric `former` and the same options. Throws InvalidInput if it cannot be, and what embed() throws.
SEAMWIRE_API Embedding re_embed(const Surface& surface, const Metric& former, const Metric& metric, Embedding old,
                                const EmbedOptions& options = {}, const Task& task = {});

/// The caller's faces that are invalid in a metric before any bisection, those without an area among them, ascending:
/// what embed() has to bisect, Embedding::invalid_before of them. Throws InvalidInput where metric and surface differ
/// in size, or a tensor is not finite.
SEAMWIRE_API std::vector<std::int32_t> invalid_faces(const Surface& surface, const Metric& metric);

}  // namespace seamwire
