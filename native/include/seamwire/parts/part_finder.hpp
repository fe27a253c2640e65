// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "seamwire/api.hpp"
#include "seamwire/surface/surface.hpp"
#include "seamwire/task.hpp"

namespace seamwire {

/// Options of a PartFinder.
struct PartOptions {
  /// The axis, 0 to 2, along which a plane mirrors the surface, as in SeamPlannerOptions. On a symmetric surface parts
  /// are symmetric. -1 if they need not be.
  int mirror = -1;
  /// Edges where an artist expects a border, as vertex pairs: marked sharp, or between materials.
  std::vector<Edge> marked = {};
  /// Existing seams, as vertex pairs. They part the surface already.
  std::vector<Edge> seams = {};
};

/// What somebody has changed by hand. The edits count more than the shape.
struct PartEdits {
  std::vector<Edge> kept = {};            ///< edges that have to be borders
  std::vector<Edge> dropped = {};         ///< edges that must not be borders
  std::vector<std::int32_t> parted = {};  ///< a triangle for each part that is cut in two, one after another
};

/// The parts of a surface.
struct Parts {
  std::vector<std::int32_t> of_face;  ///< the part of each of the caller's triangles, as face_segments() numbers them
  std::size_t count = 0;              ///< how many parts there are
  /// The borders between parts, without the existing seams: chains of vertices along real edges, from junction to
  /// junction. A closed chain ends with its first vertex.
  std::vector<std::vector<std::int32_t>> borders;
};

/// Finds the parts that an artist would make islands of: the walls, lids and plugs of props and machines.
///
/// Each edge has log odds of being a border, by how sharp it is, on its own and along the line of edges that it
/// continues. Pairs of triangles that form a quad count as a quad. Two regions are joined if their common
/// edges are probably not a border. Small regions stay only if a sharp rim encloses them. Steps of a chamfer join a
/// neighbor.
///
/// Joining is greedy additive edge contraction: Keuper et al., "Efficient decomposition of image and mesh graphs by
/// lifted multicuts" (2015), section 5.1.
///
/// A smooth body is one part. Copies share the measured edges. find() may be called from several threads.
class SEAMWIRE_API PartFinder {
 public:
  /// Measures the edges. Throws InvalidInput for an axis or a vertex out of range; Cancelled.
  explicit PartFinder(std::shared_ptr<const Surface> surface, const PartOptions& options = {}, const Task& task = {});

  /// Finds parts. `amount`, from 0 to 1, says how many: 0 joins all that is connected, 1 parts at all sharp edges.
  /// Throws InvalidInput for another amount, and for a vertex or triangle out of range; Cancelled.
  Parts find(double amount = 0.5, const PartEdits& edits = {}, const Task& task = {}) const;

 private:
  struct Impl;
  std::shared_ptr<const Impl> impl_;
};

}  // namespace seamwire
