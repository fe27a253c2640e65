// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <optional>

#include "seamwire/geodesics/exact_geodesics.hpp"
#include "seamwire/wires/closed_wires.hpp"

namespace seamwire {

/// A closed cut through two points, as two wires.
struct BentWire {
  Wire there;  ///< from the seed to the second point
  Wire back;   ///< from the second point to the seed
};

/// Bends a closed cut, so that it leads through a second point as well: the shortest closed wire through both that
/// lies around what the cut lies around; docs/method.md, Section 6.
///
/// On either side of the cut the place deepest in it is taken out, a face or a hole. What is left has a double cover
/// in which a closed wire ends on the sheet it began on exactly where it crosses the lines from one place to the other
/// an even number of times. So the shortest wires from the seed on one sheet to the second point on both make, put
/// together, one that crosses them an odd number of times: it parts the two places, as the cut does. A cut that does
/// not separate is crossed once by a closed line instead, and nothing is taken out.
///
/// All of it depends on the cut alone, so that it is bent to one point after the other in the time of two traces.
class BentWires {
 public:
  /// From a cut that closed_wires() found with the same arguments; `geodesics` is of the embedding's mesh. Throws
  /// InvalidInput where the field has several sources, and where the cut does not lead through its seed. Throws it,
  /// too, where sizes show that embedding, geodesics or field do not belong together; Cancelled.
  BentWires(std::shared_ptr<const Surface> surface, std::shared_ptr<const Embedding> embedding,
            const ExactGeodesics& geodesics, const DistanceField& field, const ClosedWire& cut, const Task& task = {});
  ~BentWires();
  BentWires(BentWires&&) noexcept;             ///< leaves one that may only be destroyed
  BentWires& operator=(BentWires&&) noexcept;  ///< as moving

  /// The cut through a point of the embedding (EmbeddedPoints finds it) as well. Nothing where none leads there: from
  /// another part of the surface, or from the place that was taken out. Throws InvalidInput for a point that is none;
  /// Cancelled.
  std::optional<BentWire> through(const SurfacePoint& second, const Task& task = {}) const;

 private:
  struct Impl;
  std::unique_ptr<const Impl> impl_;
};

}  // namespace seamwire
