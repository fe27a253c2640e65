// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "seamwire/api.hpp"
#include "seamwire/wires/wire.hpp"

namespace seamwire {

/// A closed cut through the seed of a field: two of its shortest wires, to the ends of an edge, and that edge.
struct ClosedWire {
  Wire wire;              ///< from the seed to the seed, which is its first point and again its last one
  bool separates = true;  ///< false: the surface stays in one piece, the loop runs around or through a handle, or once
                          ///< around a one-sided surface, or faces at a non-manifold edge connect its sides
  double turn = 0.0;  ///< at the seed, in radians: 0 where the loop goes smoothly through it, pi where it turns back
  std::int32_t half_edge = -1;          ///< of the embedding: the edge at whose ends the two wires end
  std::weak_ptr<const void> mesh = {};  ///< DistanceField::mesh() of its field
};

/// Finds the closed cuts through the seed of a field over `embedding` that the surface suggests, at most `count`, best
/// first. docs/method/closed-cuts.md has the equations.
///
/// Each cut consists of two shortest wires from the seed that meet on its cut locus. There, shortest wires that leave
/// the seed on different sides meet. A cut is better if it is short and turns little at the seed. A tree of the
/// vertices and a tree of the faces find the cut locus: Erickson and Whittlesey, "Greedy Optimal Homotopy and Homology
/// Generators" (2005).
///
/// Wires may cross non-manifold and unorientable edges (SurfaceReport), but the two that meet never do so at such an
/// edge. A loop that separates has at least 0.3 % of the area of its part of the surface on either side. A hole counts
/// as something that a loop may run around. The result is empty if nothing suggests a cut. On a plane no two wires
/// meet; on a sphere, or from the tip of a limb, wires in all directions meet in one place. Other parts of the surface,
/// vertices without a face and everything beyond the field's radius are ignored. In `concave_metric()` loops are
/// nearest to those that people draw.
///
/// Throws InvalidInput if the field has several sources or is of another embedding, or if the embedding is not one of
/// the surface, as far as sizes tell; Cancelled.
SEAMWIRE_API std::vector<ClosedWire> closed_wires(const Surface& surface, const Embedding& embedding,
                                                  const DistanceField& field, std::size_t count = 3,
                                                  const Task& task = {});

/// One of the closed cuts through a point in several metrics.
struct ClosedCutId {
  std::size_t metric = 0;  ///< the metric's number
  std::size_t number = 0;  ///< the cut's among those of the metric

  bool operator==(const ClosedCutId&) const = default;  ///< whether both are the same
};

/// Chooses at most `count` of the closed cuts that closed_wires() found through one point in several metrics. The best
/// cut of each metric comes first, in the order of the metrics. The other cuts follow, those of the first metric first.
/// A cut that is like an earlier one, on average within 3 % of its length, is left out. Throws InvalidInput for a cut
/// without points.
SEAMWIRE_API std::vector<ClosedCutId> choose_closed_wires(std::span<const std::vector<ClosedWire>> metrics,
                                                          std::size_t count = 3);

}  // namespace seamwire
