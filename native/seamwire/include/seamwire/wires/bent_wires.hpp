// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <optional>

#include "seamwire/api.hpp"
#include "seamwire/geodesics/exact_geodesics.hpp"
#include "seamwire/wires/closed_wires.hpp"

namespace seamwire {

/// A closed cut across the faces, through two points: a ClosedWire that was bent to a second point. It has two wires.
struct BentWire {
  Wire there;  ///< from the seed to the second point
  Wire back;   ///< from the second point to the seed
};

/// Bends a closed cut, so that it also leads through a second point.
///
/// The result is the shortest closed wire through both points that runs around the same thing as the cut. The deepest
/// place on each side of the cut, a face or a hole, is removed, and a line joins the two places. The rest has a double
/// cover. There, a closed wire ends on the sheet where it began if it crosses the line an even number of times.
///
/// The shortest wires lead from the seed on one sheet to the second point on both sheets. Together they cross the line
/// an odd number of times, so they separate the two places, as the cut does. If the cut does not separate the surface,
/// a closed line crosses it once instead, and nothing is removed. See docs/method/closed-cuts.md.
///
/// The double cover depends on the cut only. So each point that a cut is bent to takes only the time of two traces.
class SEAMWIRE_API BentWires {
 public:
  /// Prepare the bending of a cut that closed_wires() found.
  ///
  /// \param surface the surface, not null
  /// \param embedding the embedding of the cut, not null
  /// \param geodesics the solver on the embedding's mesh
  /// \param field the field of the cut
  /// \param cut the cut
  /// \throws InvalidInput if the surface or the embedding is null, or the field has several sources
  /// \throws InvalidInput if the cut does not lead through the seed of the field, or is of another embedding
  /// \throws InvalidInput if sizes show that embedding, geodesics and field do not belong together
  BentWires(std::shared_ptr<const Surface> surface, std::shared_ptr<const Embedding> embedding,
            const ExactGeodesics& geodesics, const DistanceField& field, const ClosedWire& cut, const Task& = {});
  ~BentWires();
  BentWires(BentWires&&) noexcept;             ///< the other object may then only be destroyed or assigned to
  BentWires& operator=(BentWires&&) noexcept;  ///< the other object may then only be destroyed or assigned to

  /// Find the cut that also leads through a second point.
  ///
  /// \param second a point of the embedding, which EmbeddedPoints finds
  /// \returns the cut. nullopt if no cut leads there, because the point is on another part of the surface or at a place
  ///   that was removed.
  /// \throws InvalidInput if the point is not on the embedding
  std::optional<BentWire> through(const SurfacePoint& second, const Task& = {}) const;

 private:
  struct Impl;
  std::unique_ptr<const Impl> impl_;
};

}  // namespace seamwire
