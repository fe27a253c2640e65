// SPDX-License-Identifier: GPL-3.0-or-later
#include "maps/packed_square.hpp"

#include <algorithm>
#include <bit>

namespace seamwire::detail {

namespace {

constexpr std::int32_t kWord = 64;

/// Sets the bits from `begin` to before `end`.
void set_bits(std::uint64_t* words, std::int32_t begin, std::int32_t end) {
  if (begin >= end) return;
  const std::int32_t first = begin / kWord, last = (end - 1) / kWord;
  const std::uint64_t low = ~std::uint64_t{0} << (begin % kWord);
  const std::uint64_t high = ~std::uint64_t{0} >> (kWord - 1 - (end - 1) % kWord);
  if (first == last) {
    words[first] |= low & high;
    return;
  }
  words[first] |= low;
  std::fill(words + first + 1, words + last, ~std::uint64_t{0});
  words[last] |= high;
}

/// Adds words to others, shifted down by two numbers of bits. Reads one more word than it writes. Returns the bits that
/// are set in all words now.
std::uint64_t add_shifted(const std::uint64_t* from, std::int32_t one, std::int32_t two, std::size_t count,
                          std::uint64_t* to) {
  const std::uint64_t *const a = from + one / kWord, *const b = from + two / kWord;
  const int low_a = one % kWord, low_b = two % kWord, high_a = kWord - 1 - low_a, high_b = kWord - 1 - low_b;
  std::uint64_t in_all = ~std::uint64_t{0};
  for (std::size_t i = 0; i < count; ++i) {
    to[i] |= (a[i] >> low_a) | ((a[i + 1] << 1) << high_a) | (b[i] >> low_b) | ((b[i + 1] << 1) << high_b);
    in_all &= to[i];
  }
  return in_all;
}

/// The longest run of bits that are not set below `size`.
std::int32_t longest_gap(const std::uint64_t* words, std::int32_t size) {
  std::int32_t longest = 0, begin = 0;
  const auto next = [&](std::int32_t from, std::uint64_t turned) {
    for (std::int32_t i = from / kWord; i * kWord < size; ++i) {
      std::uint64_t bits = words[i] ^ turned;
      if (i == from / kWord) bits &= ~std::uint64_t{0} << (from % kWord);
      if (bits != 0) return std::min(size, i * kWord + std::countr_zero(bits));
    }
    return size;
  };
  while (begin < size) {
    begin = next(begin, ~std::uint64_t{0});
    const std::int32_t end = next(begin, 0);
    longest = std::max(longest, end - begin);
    begin = end;
  }
  return longest;
}

}  // namespace

PackedSquare::PackedSquare(std::int32_t size)
    : size_(size),
      stride_(static_cast<std::size_t>(size) / kWord + 3),
      levels_(static_cast<std::size_t>(std::bit_width(static_cast<std::uint32_t>(size)))),
      words_(levels_ * static_cast<std::size_t>(size) * stride_),
      is_any_(static_cast<std::size_t>(size)),
      longest_(static_cast<std::size_t>(size), size),
      blocked_(stride_) {}

void PackedSquare::clear() {
  std::ranges::fill(is_any_, 0);
  std::ranges::fill(longest_, size_);
}

std::optional<std::int32_t> PackedSquare::free_column(const CellShape& shape, std::int32_t y) {
  ++steps_;
  // Most rows are ruled out by a run that is longer than all gaps there.
  for (const CellRun& run : shape.runs) {
    if (longest_[static_cast<std::size_t>(y + run.row)] < run.end - run.begin) return std::nullopt;
  }
  const std::int32_t last = size_ - shape.width;
  const std::size_t count = static_cast<std::size_t>(last / kWord + 1);
  std::fill_n(blocked_.begin(), count, 0);
  blocked_[count - 1] = ~std::uint64_t{0} << 1 << (last % kWord);
  for (const CellRun& run : shape.runs) {
    if (is_any_[static_cast<std::size_t>(y + run.row)] == 0) continue;
    const auto level = static_cast<std::size_t>(std::bit_width(static_cast<std::uint32_t>(run.end - run.begin)) - 1);
    steps_ += count;
    const std::uint64_t in_all =
        add_shifted(row(level, y + run.row), run.begin, run.end - (1 << level), count, blocked_.data());
    if (in_all == ~std::uint64_t{0}) return std::nullopt;
  }
  for (std::size_t i = 0; i < count; ++i) {
    if (~blocked_[i] != 0) return static_cast<std::int32_t>(i) * kWord + std::countr_one(blocked_[i]);
  }
  return std::nullopt;
}

void PackedSquare::take(const CellShape& shape, const Cell& cell) {
  std::int32_t low = size_, high = 0;
  for (const CellRun& run : shape.around) {
    const std::int32_t y = cell.y + run.row;
    if (y < 0 || y >= size_) continue;
    if (is_any_[static_cast<std::size_t>(y)] == 0) std::fill_n(row(0, y), stride_, 0);
    set_bits(row(0, y), std::max(0, cell.x + run.begin), std::min(size_, cell.x + run.end));
    is_any_[static_cast<std::size_t>(y)] = 1;
    low = std::min(low, y);
    high = std::max(high, y + 1);
  }
  steps_ += levels_ * stride_ * static_cast<std::size_t>(std::max(0, high - low));
  for (std::int32_t y = low; y < high; ++y) {
    for (std::size_t level = 1; level < levels_; ++level) {
      std::uint64_t* const to = row(level, y);
      const std::uint64_t* const from = row(level - 1, y);
      std::fill_n(to, stride_, 0);
      const std::int32_t half = 1 << (level - 1);
      const std::size_t shift = static_cast<std::size_t>(half / kWord);
      if (shift + 1 < stride_) add_shifted(from, 0, half, stride_ - shift - 1, to);
      for (std::size_t i = stride_ - shift - 1; i < stride_; ++i) to[i] |= from[i];
    }
    longest_[static_cast<std::size_t>(y)] = longest_gap(row(0, y), size_);
  }
}

}  // namespace seamwire::detail
