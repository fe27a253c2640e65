// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "detail/poll.hpp"
#include "maps/packed_square.hpp"

namespace seamwire::detail {

/// The cells that an island touches in one fine raster, from which the cells of coarser ones follow.
class IslandRaster {
 public:
  /// `triangles`: in fine cells, none below or left of 0.
  IslandRaster(std::span<const std::array<Eigen::Vector2d, 3>> triangles, Poll& poll);

  double width() const { return width_; }
  double height() const { return height_; }
  /// The shape in cells that are 1 / `factor` fine cells large. All cells closer than `margin` cells are around it.
  CellShape shape(double factor, std::int32_t margin) const;

 private:
  double width_ = 0.0, height_ = 0.0;
  std::vector<CellRun> runs_;  // by row
};

/// The shape turned by 180 degrees.
CellShape turned_over(const CellShape& shape);

}  // namespace seamwire::detail
