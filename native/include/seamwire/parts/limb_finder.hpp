// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>

#include "seamwire/api.hpp"
#include "seamwire/parts/part_finder.hpp"
#include "seamwire/surface/surface.hpp"
#include "seamwire/task.hpp"

namespace seamwire {

/// Finds the limbs of a surface: head, legs, arms and body of a figure, as people see them.
///
/// A limb is joined to the rest over a short or concave border. Each connected piece is divided by itself, and sizes
/// are relative to it. One search finds the parts for all amounts. A larger amount divides parts further, and moves
/// borders a little.
///
/// Copies share the search. Several threads may call find() at once.
///
/// \see Katz and Tal 2003, "Hierarchical mesh decomposition using fuzzy clustering and cuts", for distances that grow
///   at concave edges; Liu and Zhang 2004, "Segmentation of 3D meshes through spectral clustering", for eigenvectors
class SEAMWIRE_API LimbFinder {
 public:
  /// Search a surface.
  ///
  /// \param surface the surface, not null
  /// \param task progress and cancellation
  /// \throws InvalidInput if the surface is null
  /// \throws Cancelled if the task is cancelled
  explicit LimbFinder(std::shared_ptr<const Surface> surface, const Task& task = {});

  /// Return the limbs for an amount.
  ///
  /// \param amount how many, from 0 to 1: 0 joins everything that is connected, 0.5 suits most figures
  /// \param task progress and cancellation
  /// \returns the parts and their borders
  /// \throws InvalidInput if the amount is out of range
  /// \throws Cancelled if the task is cancelled
  Parts find(double amount = 0.5, const Task& task = {}) const;
  /// Return the share of the area that lies in flat faces, from 0 to 1. Machine parts have flat faces, figures do not.
  ///
  /// A triangle is flat if its bend to each neighbor, over the distance of their centers, is below 0.3 radians per root
  /// of the area of its piece.
  double flat_share() const;

 private:
  struct Impl;
  std::shared_ptr<const Impl> impl_;
};

}  // namespace seamwire
