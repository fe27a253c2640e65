// SPDX-License-Identifier: GPL-3.0-or-later
#include "maps/island_raster.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <tuple>

namespace seamwire::detail {

namespace {

/// Cells that some points of may be rounded into.
constexpr double kRounding = 1e-9;

/// Rows of bits.
class Bitmap {
 public:
  Bitmap(std::int32_t width, std::int32_t height)
      : stride_(static_cast<std::size_t>(width) / 64 + 1), words_(stride_ * static_cast<std::size_t>(height)) {}

  void set(std::int32_t y, std::int32_t begin, std::int32_t end) {
    std::uint64_t* const row = &words_[static_cast<std::size_t>(y) * stride_];
    for (std::int32_t x = begin; x < end;) {
      const std::int32_t next = std::min(end, (x / 64 + 1) * 64);
      row[x / 64] |= (~std::uint64_t{0} >> (64 - (next - x))) << (x % 64);
      x = next;
    }
  }

  std::vector<CellRun> runs() const {
    std::vector<CellRun> found;
    const auto bits = static_cast<std::int32_t>(64 * stride_);
    for (std::size_t y = 0; y * stride_ < words_.size(); ++y) {
      const std::uint64_t* const row = &words_[y * stride_];
      const auto next = [&](std::int32_t from, std::uint64_t turned) {
        for (std::int32_t i = from / 64; i * 64 < bits; ++i) {
          std::uint64_t word = row[i] ^ turned;
          if (i == from / 64) word &= ~std::uint64_t{0} << (from % 64);
          if (word != 0) return i * 64 + std::countr_zero(word);
        }
        return bits;
      };
      for (std::int32_t begin = next(0, 0); begin < bits;) {
        const std::int32_t end = next(begin, ~std::uint64_t{0});
        found.push_back({static_cast<std::int32_t>(y), begin, end});
        begin = end < bits ? next(end, 0) : bits;
      }
    }
    return found;
  }

 private:
  std::size_t stride_;
  std::vector<std::uint64_t> words_;
};

/// Sorts runs such that few of them rule most places out: the longest first, then those of rows far from the rows
/// before.
void sort_by_use(std::vector<CellRun>& runs) {
  const auto spread = [](std::int32_t row) {  // the bits of a number in opposite order
    std::uint32_t turned = 0;
    for (int i = 0; i < 16; ++i) turned = 2 * turned + ((static_cast<std::uint32_t>(row) >> i) & 1U);
    return turned;
  };
  std::ranges::sort(runs, {}, [&](const CellRun& run) { return std::tuple(spread(run.row), run.begin); });
  const auto longest = std::ranges::max_element(runs, {}, [](const CellRun& run) { return run.end - run.begin; });
  std::rotate(runs.begin(), longest, longest + 1);
}

}  // namespace

IslandRaster::IslandRaster(std::span<const std::array<Eigen::Vector2d, 3>> triangles, Poll& poll) {
  for (const auto& triangle : triangles) {
    for (const Eigen::Vector2d& point : triangle) {
      width_ = std::max(width_, point.x());
      height_ = std::max(height_, point.y());
    }
  }
  const auto columns = static_cast<std::int32_t>(width_) + 1, rows = static_cast<std::int32_t>(height_) + 1;
  Bitmap map(columns, rows);
  for (const auto& triangle : triangles) {
    poll.next();
    const auto [low, high] = std::minmax({triangle[0].y(), triangle[1].y(), triangle[2].y()});
    const auto last = std::min(static_cast<std::int32_t>(high), rows - 1);
    for (auto y = static_cast<std::int32_t>(low); y <= last; ++y) {
      double left = width_, right = 0.0;
      for (std::size_t i = 0; i < 3; ++i) {
        const Eigen::Vector2d &a = triangle[i], &b = triangle[(i + 1) % 3];
        const double begin = std::max(std::min(a.y(), b.y()), static_cast<double>(y));
        const double end = std::min(std::max(a.y(), b.y()), y + 1.0);
        if (!(begin <= end)) continue;
        const double rise = b.y() - a.y(), slope = rise == 0.0 ? 0.0 : (b.x() - a.x()) / rise;
        const double one = rise == 0.0 ? a.x() : a.x() + (begin - a.y()) * slope;
        const double two = rise == 0.0 ? b.x() : a.x() + (end - a.y()) * slope;
        left = std::min({left, one, two});
        right = std::max({right, one, two});
      }
      map.set(y, std::max(0, static_cast<std::int32_t>(left - kRounding)),
              std::min(columns, static_cast<std::int32_t>(right + kRounding) + 1));
    }
  }
  runs_ = map.runs();
}

CellShape IslandRaster::shape(double factor, std::int32_t margin) const {
  const auto cells = [&](double fine) { return static_cast<std::int32_t>(std::ceil(fine * factor - kRounding)); };
  CellShape shape;
  shape.width = std::max(1, cells(width_));
  shape.height = std::max(1, cells(height_));
  Bitmap map(shape.width, shape.height);
  for (const CellRun& run : runs_) {
    const std::int32_t end = std::min(cells(run.row + 1.0), shape.height);
    const std::int32_t left = std::min(static_cast<std::int32_t>(run.begin * factor + kRounding), shape.width - 1);
    const std::int32_t right = std::clamp(cells(run.end), left + 1, shape.width);
    for (auto y = std::min(static_cast<std::int32_t>(run.row * factor + kRounding), shape.height - 1); y < end; ++y) {
      map.set(y, left, right);
    }
  }
  shape.runs = map.runs();
  Bitmap around(shape.width + 2 * margin, shape.height + 2 * margin);
  for (std::int32_t y = -margin; y <= margin; ++y) {
    // Cells whose rows and columns differ by 1 touch.
    const double up = std::max(0, std::abs(y) - 1), reach = std::sqrt(margin * margin - up * up);
    const auto side = margin == 0 ? 0 : static_cast<std::int32_t>(std::ceil(reach));
    for (const CellRun& run : shape.runs) {
      around.set(run.row + y + margin, run.begin - side + margin, run.end + side + margin);
    }
  }
  shape.around = around.runs();
  for (CellRun& run : shape.around) run = {run.row - margin, run.begin - margin, run.end - margin};
  sort_by_use(shape.runs);
  return shape;
}

CellShape turned_over(const CellShape& shape) {
  CellShape turned = shape;
  for (std::vector<CellRun>* const runs : {&turned.runs, &turned.around}) {
    for (CellRun& run : *runs) {
      run = {shape.height - 1 - run.row, shape.width - run.end, shape.width - run.begin};
    }
  }
  sort_by_use(turned.runs);
  return turned;
}

}  // namespace seamwire::detail
