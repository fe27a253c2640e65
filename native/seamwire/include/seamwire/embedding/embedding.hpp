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

/// How far the subdivision goes.
struct EmbedOptions {
  /// The largest number of triangles to add. Triangles that are then still invalid become holes. A larger cap never
  /// leaves more holes.
  std::size_t max_faces_added = 4'000'000;
  /// The mean relative error of distances to aim for, in [0, 1]. Triangles are bisected until they resolve the metric
  /// that well. The error is estimated, not proved (see Resolution). 0: only invalid triangles are bisected, as in the
  /// paper.
  double max_error = 0.01;
  /// The caller's faces to embed, in any order. All others are left out, as if the surface ended there. Edges without a
  /// face stay. nullopt: all faces.
  ///
  /// The work is proportional to the number of these faces, but all points are copied, because vertices keep their
  /// numbers. If one of the faces has no area, the work is that for all faces.
  std::optional<std::vector<std::int32_t>> faces = std::nullopt;
  /// The length that `max_error` compares the sizes of triangles with, in the metric; finite, 0 or more. 0: the mean
  /// length of an edge of the faces to embed.
  ///
  /// To refine a part of a surface, or a changed metric, in the same way as another embedding, give that embedding's
  /// Embedding::mean_edge_length.
  double mean_edge_length = 0.0;

  /// Compare member by member.
  friend bool operator==(const EmbedOptions&, const EmbedOptions&) = default;
};

/// How well the triangles of an embedding resolve the metric.
///
/// Within a triangle, the embedding's metric is the constant form that gives the three sides their lengths. The metric
/// that it approximates varies linearly between the forms at the corners.
struct Resolution {
  /// The least EmbedOptions::max_error that all triangles meet. An estimate of the mean relative error of distances,
  /// not a proved bound (docs/benchmarks/exactness.md).
  double estimated_error = 0.0;
  /// Number of triangles that miss `max_error`. They are 14 bisections deep, or the budget or the cap allows no more
  /// triangles.
  std::size_t unmet = 0;
};

/// A surface in an anisotropic metric, as a refined mesh with edge lengths.
///
/// The first vertices are the caller's, with their numbers. New vertices are midpoints of edges.
///
/// \see Zhuang et al. 2014, Section 4.1
struct Embedding {
  /// The valid triangles. What stayed invalid is a hole, whose edges remain as loose edges.
  IntrinsicMesh mesh;
  std::vector<Vector> points;             ///< per vertex of `mesh`: in the caller's coordinates
  std::vector<std::int32_t> source_face;  ///< per triangle of `mesh`: the caller's face that it lies in
  std::size_t invalid_before = 0;         ///< invalid triangles of the input, including triangles without an area
  std::size_t faces_added = 0;            ///< triangles that the subdivision added
  /// Bisections opposite the newest vertex. They take over where other schemes do not end.
  std::size_t newest_bisections = 0;
  /// Triangles left as holes: without an area, or beyond the cap.
  std::size_t invalid_left = 0;
  bool hit_cap = false;  ///< whether EmbedOptions::max_faces_added ended the subdivision
  /// Mean length of an edge of the embedded faces, in the metric, before any bisection. It is
  /// EmbedOptions::mean_edge_length if that is above 0.
  double mean_edge_length = 0.0;
  std::optional<Resolution> resolution;  ///< set if EmbedOptions::max_error is above 0
  /// Number of edges with a length that differs from the metric, because of length repair.
  std::size_t clamped_edges = 0;
  /// The largest factor, up or down, between such a length and the length in the metric; 1 or more.
  double worst_clamp = 1.0;
  /// Faces of the surface that were embedded, counted again each time one was begun anew. After re_embed(), only faces
  /// that the change has reached count.
  std::size_t faces_embedded = 0;
  bool is_local = false;                 ///< whether re_embed() can continue from this embedding
  std::vector<std::int32_t> hole_faces;  ///< the caller's faces that contain holes, ascending
  /// The caller's faces with an edge of `clamped_edges`, ascending.
  std::vector<std::int32_t> repaired_faces;
  /// The caller's vertices that have a face, but are in no valid triangle and on no loose edge.
  std::vector<std::int32_t> unreachable;
  EmbedOptions options;  ///< the options that the embedding was made with
};

/// Embed a surface in a metric.
///
/// Triangles that violate the triangle inequality are *invalid*. They are bisected at the midpoint of their longest
/// edge in the metric, the largest perimeter first, until no invalid triangle is left. Lengths use ambient_norm(). All
/// faces at an edge are bisected together, even if there are three or more, or if they cannot have the same
/// orientation.
///
/// This may not end. Beyond a budget of four triangles for each triangle of the surface (at least 20,000), or the cap,
/// schemes that end replace it. The result has at most 1.5 times the triangles that the first scheme would make if it
/// ended. docs/method/embedding.md describes the schemes.
///
/// With a `max_error`, valid triangles that do not resolve the metric are bisected too, and edges are also measured at
/// their middles. If the cap does not allow all triangles to become valid, the schemes above follow.
///
/// Triangles without an area are removed first: needles by collapsing their shortest edge, caps by flipping their
/// longest edge. One end of a collapsed edge then has no triangle, but a loose edge of length 0 to the other end. If
/// neither is possible, the triangle becomes a hole.
///
/// Every edge of a hole that no valid triangle has becomes a loose edge. So parts that edges of the input connect stay
/// connected.
///
/// \param surface the surface
/// \param metric a metric of its vertices
/// \param options how far the subdivision goes
/// \returns the embedding
/// \throws InvalidInput if the metric and the surface differ in size, a tensor is invalid (Metric::tensors), or an
///   option is out of range
/// \see Zhuang et al. 2014, Section 4.1
SEAMWIRE_API Embedding embed(const Surface& surface, const Metric& metric, const EmbedOptions& options = {},
                             const Task& = {});

/// Embed a surface in a changed metric, starting from its embedding in the former one.
///
/// This is faster than embed() only if the EmbedOptions::max_error of both is 0.
///
/// Only triangles around vertices where the metrics differ are bisected anew, and triangles that these bisections
/// reach. The result is that of embed(surface, metric, options), except for the numbers of new vertices and triangles
/// and for Embedding::mean_edge_length, see below.
/// Apart from these triangles, the cost is one comparison of the metrics, vertex by vertex, and one copy of `old`.
///
/// This is embed() if `old` is not local (Embedding::is_local), or if the normals of the metrics differ. An embedding
/// is not local in these cases:
///
/// - It has holes, a `max_error`, or only some faces.
/// - Another scheme than the first one contributed to it.
/// - The surface has degenerate faces, or is not manifold and oriented.
///
/// Unless the options give a mean edge length, sizes are compared with that of `old`. So a stroke does not change what
/// `max_error` means elsewhere.
///
/// \param surface the surface
/// \param former the metric of `old`
/// \param metric the changed metric
/// \param old the embedding of the same surface in `former`, with the same options
/// \param options the options of `old`
/// \returns the embedding in the changed metric
/// \throws InvalidInput if `old` is of another surface, as far as its size tells, or embed() rejects an argument
SEAMWIRE_API Embedding re_embed(const Surface& surface, const Metric& former, const Metric& metric,
                                const Embedding& old, const EmbedOptions& options = {}, const Task& = {});

/// Find the faces that are invalid in a metric before any bisection, including faces without an area.
///
/// embed() has to bisect these faces. Embedding::invalid_before is their number.
///
/// \param surface the surface
/// \param metric a metric of its vertices
/// \returns the caller's faces, ascending
/// \throws InvalidInput if the metric and the surface differ in size, or a tensor is invalid (Metric::tensors)
SEAMWIRE_API std::vector<std::int32_t> invalid_faces(const Surface& surface, const Metric& metric);

}  // namespace seamwire
