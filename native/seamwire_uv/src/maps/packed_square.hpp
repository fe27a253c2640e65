// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace seamwire::detail {

/// Cells of a row, from `begin` to before `end`.
struct CellRun {
  std::int32_t row, begin, end;
  bool operator==(const CellRun&) const = default;
};

/// The cells that an island touches, with the lowest row and column 0.
struct CellShape {
  std::int32_t width = 0, height = 0;
  std::vector<CellRun> runs;    // disjoint, the most useful to rule places out first
  std::vector<CellRun> around;  // those cells and all that are nearer than the margin to them
  bool operator==(const CellShape&) const = default;
};

/// A place for a shape's lowest row and column.
struct Cell {
  std::int32_t x = 0, y = 0;
};

/// A square of cells, some of which are taken.
///
/// A run of n cells is free if the two runs of 2^k <= n cells at its ends are free. Each row stores for each k where
/// runs of 2^k cells are not free. So all places in a row are looked at together, 64 of them in one step.
class PackedSquare {
 public:
  explicit PackedSquare(std::int32_t size);

  std::int32_t size() const { return size_; }
  void clear();
  /// The first column at which a shape is free with its lowest row at `y`.
  std::optional<std::int32_t> free_column(const CellShape& shape, std::int32_t y);
  /// Takes a shape's cells and those around it.
  void take(const CellShape& shape, const Cell& cell);
  /// How many steps free_column() took so far.
  std::size_t steps() const { return steps_; }

 private:
  std::uint64_t* row(std::size_t level, std::int32_t y) {
    return words_.data() + (level * static_cast<std::size_t>(size_) + static_cast<std::size_t>(y)) * stride_;
  }

  std::int32_t size_;
  std::size_t stride_, levels_;
  std::vector<std::uint64_t> words_;
  std::vector<std::uint8_t> is_any_;   // of each row: whether a cell is taken
  std::vector<std::int32_t> longest_;  // of each row: the longest free run
  std::vector<std::uint64_t> blocked_;
  std::size_t steps_ = 0;
};

}  // namespace seamwire::detail
