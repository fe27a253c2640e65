// SPDX-License-Identifier: GPL-3.0-or-later
#include "seams/thinning.hpp"

#include <algorithm>
#include <cstdint>
#include <utility>

#include "detail/index.hpp"

namespace seamwire {
namespace {

/// See thinned().
class Thinning {
 public:
  Thinning(const Surface& surface, const std::vector<std::int32_t>& images, const std::vector<Choice>& choices,
           CutPieces pieces, const SeamLimits& limits)
      : images_(images),
        choices_(choices),
        pieces_(std::move(pieces)),
        islands_(limits.islands),
        crumb_of_island_(limits.crumb_of_island),
        prices_(choices_.size()),
        freedoms_(choices_.size(), Freedom::kNeeded),
        is_there_(choices_.size(), 1),
        is_needed_(choices_.size(), 0) {
    for (const Piece& piece : pieces_.pieces()) crumb_ += limits.crumb * piece.area;
    for (std::size_t i = 0; i < choices_.size(); ++i) {
      prices_[i] = price(surface, choices_[i]);
    }
  }

  std::vector<Choice> run(const Task& task) {
    for (std::int32_t i = 0; index(i) < choices_.size(); ++i) freedoms_[i] = freedom(i);
    take_away(task);
    // Where pairs leave no such number, one of the last pair goes alone.
    is_paired_ = false;
    if (islands_ > 0 && pieces_.piece_count() > islands_) take_away(task);
    std::vector<Choice> kept;
    for (std::size_t i = 0; i < choices_.size(); ++i) {
      if (is_there_[i] != 0) kept.push_back(choices_[i]);
    }
    return kept;
  }

 private:
  void take_away(const Task& task) {
    std::ranges::fill(is_needed_, std::uint8_t{0});
    while (true) {
      const auto gone = static_cast<double>(std::ranges::count(is_there_, 0));
      task.check(gone / static_cast<double>(choices_.size() + 1));
      const std::int32_t dearest = find_dearest();
      if (dearest < 0) return;
      remove_with_images(dearest);
    }
  }

  /// Whether what a wire parts joins to discs within the limits; where it cuts nothing that others do not, it goes when
  /// all others have.
  enum class Freedom : std::uint8_t { kNeeded, kCutsNothing, kFree };
  Freedom freedom(std::int32_t i) const {
    if (choices_[i].is_kept) return Freedom::kNeeded;
    const std::vector<CutPieces::Joined> joined = pieces_.joined_without(i);
    if (joined.empty()) return Freedom::kCutsNothing;
    std::size_t fewer = 0;
    for (const CutPieces::Joined& one : joined) {
      fewer += one.pieces - 1;
      if (!is_allowed(one)) return Freedom::kNeeded;
    }
    const bool is_enough = islands_ > 0 && fewer > 0 && pieces_.piece_count() < islands_ + fewer;
    return is_enough ? Freedom::kNeeded : Freedom::kFree;
  }
  bool is_crumb(const CutPieces::Joined& joined) const {
    return joined.smallest < std::min(crumb_, crumb_of_island_ * joined.piece.area);
  }
  bool is_allowed(const CutPieces::Joined& joined) const {
    const Piece& piece = joined.piece;
    if (!piece.is_disc()) return false;
    const bool is_cut = joined.pieces == 1, is_limited = islands_ == 0 || is_cut;
    return !is_limited || piece.spread() <= piece.max_spread || (!is_cut && is_crumb(joined));
  }

  std::int32_t find_dearest() const {
    std::int32_t dearest = -1;
    for (std::int32_t i = 0; index(i) < choices_.size(); ++i) {
      if (is_there_[i] == 0 || is_needed_[i] != 0 || freedoms_[i] == Freedom::kNeeded) continue;
      if (dearest < 0 || std::pair(freedoms_[i], prices_[i]) > std::pair(freedoms_[dearest], prices_[dearest])) {
        dearest = i;
      }
    }
    return dearest;
  }

  void remove(std::int32_t wire) {
    const std::size_t before = pieces_.piece_count();
    const std::vector<CutPieces::Joined> joined = pieces_.remove(wire);
    is_there_[wire] = 0;
    std::ranges::fill(is_needed_, std::uint8_t{0});  // it may be another matter now
    const bool is_count_enough = islands_ > 0 && before != pieces_.piece_count();
    for (std::int32_t i = 0; index(i) < choices_.size(); ++i) {
      if (is_there_[i] == 0) continue;
      if (is_count_enough || pieces_.touches(i, wire, joined)) freedoms_[i] = freedom(i);
    }
  }

  /// Where an image has to stay, so has the wire, for now.
  void remove_with_images(std::int32_t wire) {
    const std::vector<std::int32_t> others = is_paired_ ? images_of(wire) : std::vector<std::int32_t>{};
    if (others.empty()) return remove(wire);
    const CutPieces pieces = pieces_;
    const std::vector<Freedom> freedoms = freedoms_;
    const std::vector<std::uint8_t> is_there = is_there_;
    const std::vector<std::uint8_t> is_needed = is_needed_;
    remove(wire);
    for (const std::int32_t other : others) {
      if (freedoms_[other] != Freedom::kNeeded) {
        remove(other);
        continue;
      }
      pieces_ = pieces;
      freedoms_ = freedoms;
      is_there_ = is_there;
      is_needed_ = is_needed;
      is_needed_[wire] = 1;
      for (const std::int32_t each : others) is_needed_[each] = 1;
      return;
    }
  }

  std::int32_t image(std::int32_t v) const { return images_.empty() || images_[v] < 0 ? v : images_[v]; }
  std::vector<std::int32_t> images_of(std::int32_t wire) const {
    const PlannedWire& own = choices_[wire].wire;
    const Ends ends = ends_of(image(own.from), image(own.to));
    std::vector<std::int32_t> found;
    for (std::int32_t i = 0; index(i) < choices_.size() && !images_.empty(); ++i) {
      if (i == wire || is_there_[i] == 0 || choices_[i].is_kept) continue;
      const PlannedWire& other = choices_[i].wire;
      if (ends_of(other.from, other.to) == ends) found.push_back(i);
    }
    return found;
  }

  const std::vector<std::int32_t>& images_;
  const std::vector<Choice>& choices_;
  CutPieces pieces_;
  const std::size_t islands_;
  const double crumb_of_island_;
  double crumb_ = 0.0;  ///< the area below which a piece is one
  std::vector<double> prices_;
  std::vector<Freedom> freedoms_;  ///< of those that are there
  std::vector<std::uint8_t> is_there_, is_needed_;
  bool is_paired_ = true;
};

}  // namespace

std::vector<Choice> thinned(const Surface& surface, const std::vector<std::int32_t>& images,
                            const std::vector<Choice>& choices, CutPieces pieces, const SeamLimits& limits,
                            const Task& task) {
  return Thinning(surface, images, choices, std::move(pieces), limits).run(task);
}

}  // namespace seamwire
