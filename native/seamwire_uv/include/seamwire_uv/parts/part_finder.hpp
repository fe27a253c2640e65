// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "seamwire/surface/surface.hpp"
#include "seamwire/surface/vector.hpp"
#include "seamwire/task.hpp"
#include "seamwire_uv/api.hpp"

namespace seamwire {

/// What separates parts.
enum class PartsBy {
  kRims,    ///< sharp edges, as around the walls, lids and plugs of props and machines
  kLimbs,   ///< narrow and concave places, as between head, arms and body of a figure
  kPanels,  ///< the sides, as between front and back of a shirt, and sharp edges
  /// As is best for the shape. Figures have few limbs: at most 8 % of their area is flat, and they are scans, sculpts,
  /// or soft shapes whose rims take off details only. Up to 1,000 quads are smoothed first. A connected piece has
  /// panels if at most 15 % of the edge length bends by more than 30 degrees, and at least three boundaries are open.
  /// Everything else has rims.
  kShape,
};

/// Options of a PartFinder.
struct PartOptions {
  /// What separates parts. Limbs do not depend on `marked`.
  PartsBy by = PartsBy::kRims;
  /// For kShape: whether the edges come from a scan; nullopt: as has_scanned_edges says. From 20,000 triangles, a mesh
  /// counts as a sculpt anyway.
  std::optional<bool> is_scan = std::nullopt;
  /// For rims: whether flat faces that unfold into the plane together are one part, as those of a box.
  bool has_nets = true;
  /// The direction to the viewer. Limbs that kShape finds have no borders around a face there. For kPanels it is the
  /// direction to the front; nullopt: where each piece is thinnest, as for kShape. On a symmetric mesh the direction to
  /// the front is turned into the mirror plane, or across it if that is nearer.
  std::optional<Vector> front = std::nullopt;
  /// The axis, 0 (x) to 2 (z), in whose direction the surface is mirrored, as in SeamPlannerOptions. Rims are then
  /// symmetric wherever the triangles are mirrored. Limbs are symmetric if at least 95 % of the edges are mirrored.
  /// PartEdits::parted has an exception. -1: parts need not be symmetric.
  int mirror = -1;
  /// Edges where an artist expects a border, as vertex pairs, for each kind of mark: edges that are marked sharp, edges
  /// between materials. A kind counts only on connected pieces where it marks at most 80 % of the inner edges. Marks
  /// that are everywhere, as on a flat-shaded mesh, say nothing.
  std::vector<std::vector<Edge>> marked = {};
  /// Existing seams, as vertex pairs. They separate parts already.
  std::vector<Edge> seams = {};
};

/// Changes made by hand. They outweigh the shape.
struct PartEdits {
  std::vector<Edge> kept = {};     ///< edges that must be borders
  std::vector<Edge> dropped = {};  ///< edges that must not be borders
  /// A triangle of each part to cut in two, one after another. The cut through a symmetric part is symmetric if such a
  /// cut leaves each half a fifth of the area.
  std::vector<std::int32_t> parted = {};
};

/// The parts of a surface.
struct Parts {
  std::vector<std::int32_t> of_face;  ///< the part of each of the caller's triangles, numbered as in face_segments()
  std::size_t count = 0;              ///< number of parts
  /// The borders between parts, without the existing seams: chains of vertices along real edges, from junction to
  /// junction. A closed chain ends with its first vertex.
  std::vector<std::vector<std::int32_t>> borders;
};

/// Finds the parts of which an artist would make islands: the walls, lids and plugs of props and machines, or the limbs
/// of figures.
///
/// Each edge has log odds of being a border. They depend on how sharp it is, on its own and along the line of edges
/// that it continues. Pairs of triangles that form a quad count as a quad. Two regions are joined if their common edges
/// are probably not a border. A small region stays only if a sharp rim encloses it. Steps of a chamfer join a neighbor.
/// A smooth body is one part.
///
/// Limbs are joined over short or concave borders. Each connected piece is divided separately. Sizes are
/// relative to the piece. A larger amount divides limbs further, and moves borders a little.
///
/// Copies share the measured edges. Several threads may call find() at once.
///
/// \see Keuper et al. 2015, "Efficient decomposition of image and mesh graphs by lifted multicuts", Section 5.1, for
///   the greedy additive edge contraction
/// \see Katz and Tal 2003, "Hierarchical mesh decomposition using fuzzy clustering and cuts", for distances that grow
///   at concave edges
/// \see Liu and Zhang 2004, "Segmentation of 3D meshes through spectral clustering", for eigenvectors
class SEAMWIRE_UV_API PartFinder {
 public:
  /// Measure the edges of a surface.
  ///
  /// \param surface the surface, not null
  /// \param options what is known about parts
  /// \throws InvalidInput if the surface is null, an axis or a vertex is out of range, or the front is no
  ///   direction
  explicit PartFinder(std::shared_ptr<const Surface> surface, const PartOptions& options = {}, const Task& = {});

  /// Find parts.
  ///
  /// \param amount how many, from 0 to 1: 0 joins everything that is connected, 1 separates parts at all sharp edges
  /// \param edits changes made by hand
  /// \returns the parts and their borders
  /// \throws InvalidInput if the amount, a vertex or a triangle is out of range
  Parts find(double amount = 0.5, const PartEdits& edits = {}, const Task& = {}) const;
  /// Return what separates parts: rims, limbs or panels. Panels that kShape has on some pieces count.
  PartsBy by() const;

 private:
  struct Impl;
  std::shared_ptr<const Impl> impl_;
};

}  // namespace seamwire
