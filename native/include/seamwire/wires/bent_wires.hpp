// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <optional>

#include "seamwire/api.hpp"
#include "seamwire/geodesics/exact_geodesics.hpp"
#include "seamwire/wires/closed_wires.hpp"

namespace seamwire {

/// A closed cut through two points, as two wires.
struct BentWire {
  Wire there;  ///< from the seed to the second point
  Wire back;   ///< from the second point to the seed
};

/// Bends a closed cut, so that it leads through a second point as well. The result is the shortest closed wire through
/// both points that runs around the same thing as the cut. docs/method/closed-cuts.md.
///
/// The place deepest on each side of the cut, a face or a hole, is removed, and a line joins the two places. The rest
/// has a double cover: a closed wire ends on the sheet that it began on if it crosses the line an even number of times.
/// The shortest wires lead from the seed on one sheet to the second point on both sheets. Together they cross the line
/// an odd number of times, so they separate the two places, as the cut does. If the cut does not separate the surface,
/// a closed line crosses it once instead, and nothing is removed.
///
/// The double cover depends on the cut only. So the cut can be bent to many points, each in the time of two traces.
class SEAMWIRE_API BentWires {
 public:
  /// From a cut that closed_wires() found with the same arguments; `geodesics` is of the embedding's mesh. Throws
  /// InvalidInput where the field has several sources, and where the cut does not lead through its seed. Throws it,
  /// too, where sizes show that embedding, geodesics or field do not belong together; Cancelled.
  BentWires(std::shared_ptr<const Surface> surface, std::shared_ptr<const Embedding> embedding,
            const ExactGeodesics& geodesics, const DistanceField& field, const ClosedWire& cut, const Task& task = {});
  ~BentWires();
  BentWires(BentWires&&) noexcept;             ///< leaves one that may only be destroyed
  BentWires& operator=(BentWires&&) noexcept;  ///< as moving

  /// Finds the cut that also leads through a second point of the embedding (EmbeddedPoints finds such points). Returns
  /// nullopt if no cut leads there: from another part of the surface, or from the place that was taken out. Throws
  /// InvalidInput if the point is not on the embedding; Cancelled.
  std::optional<BentWire> through(const SurfacePoint& second, const Task& task = {}) const;

 private:
  struct Impl;
  std::unique_ptr<const Impl> impl_;
};

}  // namespace seamwire
