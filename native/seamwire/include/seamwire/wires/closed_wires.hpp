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

/// A closed cut across the faces, through one point: two of a field's shortest wires, to the ends of an edge, and that
/// edge. BentWire has a cut through two points.
struct ClosedWire {
  Wire wire;  ///< from the seed to the seed, which is both the first and the last point
  /// Whether the cut separates the surface. It does not if the loop runs around or through a handle, or once around a
  /// one-sided surface. It does not if faces at a non-manifold edge connect its sides.
  bool separates = true;
  /// The turn at the seed, in radians: 0 if the loop passes smoothly through it, pi if it turns back.
  double turn = 0.0;
  /// The half-edge of the embedding at whose ends the two wires end.
  std::int32_t half_edge = -1;
  std::weak_ptr<const void> mesh = {};  ///< DistanceField::mesh_id() of its field
};

/// Find the closed cuts through the seed of a field that the surface suggests.
///
/// Each cut consists of two shortest wires from the seed that meet on its cut locus. There, shortest wires that leave
/// the seed on different sides meet. A cut is better if it is short and turns little at the seed. A tree of the
/// vertices and a tree of the faces find the cut locus. docs/method/closed-cuts.md has the equations. In
/// concave_metric(), cuts come nearest to those that people draw.
///
/// - Wires may cross non-manifold and unorientable edges (SurfaceReport), but the two wires of a cut never meet at one.
/// - A cut that separates leaves at least 0.3 % of the area of its part of the surface on each side.
/// - A cut may run around a hole.
/// - Other parts of the surface, vertices without a face, and everything beyond the field's radius are ignored.
///
/// \param surface the surface
/// \param embedding an embedding of the surface
/// \param field distances over the embedding from one seed
/// \param count the largest number of cuts
/// \returns the cuts, best first. Empty if nothing suggests a cut. For example, no two wires meet on a plane. On a
///   sphere, or from the tip of a limb, wires in all directions meet in one place.
/// \throws InvalidInput if the field has several sources
/// \throws InvalidInput if the field is of another embedding, or the embedding of another surface, as far as sizes tell
/// \see Erickson and Whittlesey 2005, "Greedy Optimal Homotopy and Homology Generators", for the two trees
SEAMWIRE_API std::vector<ClosedWire> closed_wires(const Surface& surface, const Embedding& embedding,
                                                  const DistanceField& field, std::size_t count = 3, const Task& = {});

/// Identifies one of the closed cuts through a point in several metrics.
struct ClosedCutId {
  std::size_t metric = 0;  ///< the index of the metric
  std::size_t number = 0;  ///< the index of the cut, among the cuts of its metric

  /// Compare member by member.
  bool operator==(const ClosedCutId&) const = default;
};

/// Choose among the closed cuts through one point in several metrics.
///
/// The best cut of each metric comes first, in the order of the metrics. The other cuts follow, beginning with those of
/// the first metric. A cut is left out if its mean distance to an earlier cut is at most 3 % of its length.
///
/// \param metrics the cuts that closed_wires() found in each metric
/// \param count the largest number of cuts to choose
/// \returns the chosen cuts, in this order
/// \throws InvalidInput if a cut has no points
SEAMWIRE_API std::vector<ClosedCutId> choose_closed_wires(std::span<const std::vector<ClosedWire>> metrics,
                                                          std::size_t count = 3);

}  // namespace seamwire
