// SPDX-License-Identifier: GPL-3.0-or-later
#include "seamwire_uv/maps/place_islands.hpp"

#include <algorithm>
#include <bit>
#include <bitset>
#include <cmath>
#include <map>
#include <numeric>
#include <optional>
#include <string>
#include <utility>

#include "detail/drop_repeats.hpp"
#include "detail/index.hpp"
#include "detail/infinity.hpp"
#include "detail/poll.hpp"

namespace seamwire {

using namespace detail;

namespace {

using Eigen::AlignedBox2d;
using Eigen::Vector2d;
using Placement = Eigen::Matrix<double, 2, 3>;

/// Cells along a side of a unit square.
constexpr int kSide = 512;
constexpr double kRoom = 1.0 / kSide;

void check(const NewIslands& given, const std::vector<AlignedBox2d>& taken) {
  const auto check_size = [](const char* what, std::size_t size, std::size_t wanted) {
    if (size == wanted) return;
    throw InvalidInput(std::string(what) + " has " + std::to_string(size) + " items instead of " +
                       std::to_string(wanted));
  };
  check_size("after", given.after.size(), given.before.size());
  check_size("islands", given.islands.size(), given.triangles.size());
  if (!given.aspects.empty()) check_size("aspects", given.aspects.size(), given.areas.size());
  if (!given.straight.empty()) check_size("straight", given.straight.size(), given.areas.size());
  for (std::size_t t = 0; t < given.triangles.size(); ++t) {
    check_index(given.islands[t], given.areas.size(), "islands: number", "areas");
    for (const std::int32_t c : given.triangles[t]) {
      check_index(c, given.after.size(), "triangle " + std::to_string(t) + ": corner", "corners");
      if (!given.after[c].allFinite()) throw InvalidInput("corner " + std::to_string(c) + " has no finite UV");
    }
  }
  const auto is_area = [](double area) { return area >= 0.0 && std::isfinite(area); };
  if (!std::ranges::all_of(given.areas, is_area)) throw InvalidInput("areas: a value is negative or not finite");
  const auto is_aspect = [](double aspect) { return aspect >= 1e-3 && aspect <= 1e3; };
  if (!std::ranges::all_of(given.aspects, is_aspect)) throw InvalidInput("aspects: a value is not in 0.001 to 1000");
  const auto is_box = [](const AlignedBox2d& box) { return box.min().allFinite() && box.max().allFinite(); };
  if (!std::ranges::all_of(taken, is_box)) throw InvalidInput("taken: a box is not finite");
}

/// The cells of one unit square, with those that something touches.
class Square {
 public:
  explicit Square(Vector2d low) : low_(std::move(low)) {}

  void take(const AlignedBox2d& box) {
    const auto cell = [&](double value, int axis) {
      return static_cast<int>(std::clamp(std::floor((value - low_[axis]) * kSide), -1.0, 1.0 * kSide));
    };
    const int left = std::max(cell(box.min().x(), 0), 0), right = std::min(cell(box.max().x(), 0) + 1, kSide);
    const int bottom = std::max(cell(box.min().y(), 1), 0), top = std::min(cell(box.max().y(), 1) + 1, kSide);
    if (left >= right) return;
    const Row run = (~Row() >> (kSide - (right - left))) << left;
    for (int y = bottom; y < top; ++y) rows_[y] |= run;
  }

  /// The low corner of the free rectangle of a size whose center is nearest to a place.
  std::optional<Vector2d> free_spot(const Vector2d& size, const Vector2d& center) const {
    const Vector2d cells = ((size.array() + 2.0 * kRoom) * kSide).ceil();
    if (!(cells.maxCoeff() <= kSide)) return std::nullopt;
    const int wide = static_cast<int>(cells.x()), tall = static_cast<int>(cells.y());
    const Vector2d wanted = (center - low_ - 0.5 * size).array() * kSide - 1.0;
    const auto nearest = [](double value, int last) {
      return static_cast<int>(std::clamp(std::round(value), 0.0, 1.0 * last));
    };
    const int u = nearest(wanted.x(), kSide - wide), v = nearest(wanted.y(), kSide - tall);
    double least = kInfinity;
    Vector2d found;
    for (int aside = 0; aside <= kSide; ++aside) {
      for (const int y : {v - aside, v + aside}) {
        const double beside = std::abs(y - wanted.y());
        if (y < 0 || y > kSide - tall || beside >= least) continue;
        const Row free = free_places(y, wide, tall);
        for (const int x : {free_below(free, u), free_from(free, u)}) {
          if (x < 0) continue;
          const double distance = std::hypot(x - wanted.x(), beside);
          if (distance >= least) continue;
          least = distance;
          found = Vector2d(x, y);
        }
      }
      if (aside - 1.0 > least) break;
    }
    if (least == kInfinity) return std::nullopt;
    return Vector2d(low_ + (found.array() * kRoom + kRoom).matrix());
  }

 private:
  using Row = std::bitset<kSide>;

  /// The cells of a row that are low corners of free rectangles.
  Row free_places(int y, int wide, int tall) const {
    Row row;
    for (int own = y; own < y + tall; ++own) row |= rows_[own];
    // A run of cells has a taken one if one of two shorter runs has one that cover it together.
    int length = 1;
    for (; 2 * length <= wide; length *= 2) row |= row >> length;
    row |= row >> (wide - length);
    return ~row & ~Row() >> (wide - 1);
  }
  /// The first cell from `x` on that is set, or -1.
  static int free_from(const Row& row, int x) {
    for (; x < kSide; x += 64) {
      const auto word = ((row >> x) & (~Row() >> (kSide - 64))).to_ullong();
      if (word != 0) return x + std::countr_zero(word);
    }
    return -1;
  }
  /// The last cell before `x` that is set, or -1.
  static int free_below(const Row& row, int x) {
    for (; x > 0; x -= 64) {
      const auto word = (row << (kSide - x) >> (kSide - 64)).to_ullong();
      if (word != 0) return x - 1 - std::countl_zero(word);
    }
    return -1;
  }

  Vector2d low_;
  std::vector<Row> rows_ = std::vector<Row>(kSide);
};

/// An island in its wanted size and rotation.
struct Fitted {
  Placement placement = Placement::Zero();
  AlignedBox2d box;
  Vector2d center = Vector2d::Zero();  // of the old place
};

class Placer {
 public:
  explicit Placer(const NewIslands& given) : given_(given), triangles_(given.areas.size()) {
    for (std::size_t t = 0; t < given.triangles.size(); ++t) triangles_[given.islands[t]].push_back(given.triangles[t]);
    for (std::size_t i = 0; i < triangles_.size(); ++i) fitted_.push_back(fitted(i));
  }

  std::vector<Placement> place(const std::vector<AlignedBox2d>& taken, const Task& task) {
    Poll poll(task, 0.0, 1.0, fitted_.size(), 1);
    std::vector<AlignedBox2d> boxes = taken;
    std::map<std::pair<double, double>, Square> squares;
    std::vector<std::size_t> left_over;
    std::vector<std::size_t> order(fitted_.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::ranges::stable_sort(order, std::ranges::greater(), [&](std::size_t i) { return fitted_[i].box.volume(); });
    for (const std::size_t i : order) {
      poll.next();
      if (triangles_[i].empty()) continue;
      const Vector2d low = fitted_[i].center.array().floor();
      const auto [found, is_new] = squares.try_emplace({low.x(), low.y()}, low);
      Square& square = found->second;
      if (is_new) {
        for (const AlignedBox2d& box : boxes) square.take(box);
      }
      const std::optional<Vector2d> spot = square.free_spot(fitted_[i].box.sizes(), fitted_[i].center);
      if (!spot) {
        left_over.push_back(i);
        continue;
      }
      move(i, *spot);
      for (const Triangle& triangle : triangles_[i]) {
        AlignedBox2d box;
        for (const std::int32_t c : triangle) {
          box.extend(Vector2d(fitted_[i].placement * given_.after[c].homogeneous()));
        }
        square.take(box);
        boxes.push_back(box);
      }
    }
    double right = 1.0;
    for (const AlignedBox2d& box : boxes) right = std::max(right, box.max().x());
    place_beside(right, left_over);
    std::vector<Placement> placements;
    for (const Fitted& island : fitted_) placements.push_back(island.placement);
    return placements;
  }

 private:
  Fitted fitted(std::size_t i) const {
    std::vector<std::int32_t> corners;
    double area = 0.0;
    for (const Triangle& t : triangles_[i]) {
      corners.insert(corners.end(), t.begin(), t.end());
      const Vector2d a = given_.after[t[1]] - given_.after[t[0]], b = given_.after[t[2]] - given_.after[t[0]];
      area += 0.5 * std::abs(a.x() * b.y() - a.y() * b.x());
    }
    Fitted result;
    if (corners.empty()) return result;
    std::ranges::sort(corners);
    drop_repeats(corners);
    const auto count = static_cast<double>(corners.size());
    const bool had_place = std::ranges::all_of(corners, [&](std::int32_t c) { return given_.before[c].allFinite(); });
    const auto before = [&](std::int32_t c) -> Vector2d { return had_place ? given_.before[c] : Vector2d::Zero(); };
    Vector2d mean = Vector2d::Zero(), old_mean = Vector2d::Zero();
    AlignedBox2d old_box;
    for (const std::int32_t c : corners) {
      mean += given_.after[c] / count;
      old_mean += before(c) / count;
      old_box.extend(before(c));
    }
    result.center = old_box.center();
    // The turn that leaves least between the two: Kabsch in the plane.
    const double aspect = given_.aspects.empty() ? 1.0 : given_.aspects[i];
    double along = 0.0, across = 0.0;
    for (const std::int32_t c : corners) {
      const Vector2d now = given_.after[c] - mean;
      const Vector2d old = (before(c) - old_mean).cwiseProduct(Vector2d(aspect, 1.0));
      along += now.dot(old);
      across += now.x() * old.y() - now.y() * old.x();
    }
    const double length = std::hypot(along, across);
    Vector2d turn = length > 0.0 ? Vector2d(along / length, across / length) : Vector2d(1.0, 0.0);
    if (!given_.straight.empty() && given_.straight[i] != 0) {
      const bool lies = std::abs(turn.x()) >= std::abs(turn.y());
      turn = lies ? Vector2d(turn.x() > 0.0 ? 1.0 : -1.0, 0.0) : Vector2d(0.0, turn.y() > 0.0 ? 1.0 : -1.0);
    }
    const double wanted = given_.areas[i];
    const double scale = area > 0.0 && wanted > 0.0 ? std::sqrt(wanted * aspect / area) : 1.0;
    Eigen::Matrix2d linear;
    linear << turn.x(), -turn.y(), turn.y(), turn.x();
    linear *= scale;
    linear.row(0) /= aspect;
    result.placement << linear, -linear * mean;
    for (const std::int32_t c : corners) {
      result.box.extend(Vector2d(result.placement * given_.after[c].homogeneous()));
    }
    return result;
  }

  void move(std::size_t i, const Vector2d& low) {
    const Vector2d by = low - fitted_[i].box.min();
    fitted_[i].placement.col(2) += by;
    fitted_[i].box.translate(by);
  }

  /// In columns as high as the square.
  void place_beside(double right, const std::vector<std::size_t>& left_over) {
    double left = right + 4.0 * kRoom, bottom = 0.0, widest = 0.0;
    for (const std::size_t i : left_over) {
      const Vector2d size = fitted_[i].box.sizes();
      if (bottom > 0.0 && bottom + size.y() > 1.0) {
        left += widest + 4.0 * kRoom;
        bottom = widest = 0.0;
      }
      move(i, {left, bottom});
      bottom += size.y() + 4.0 * kRoom;
      widest = std::max(widest, size.x());
    }
  }

  const NewIslands& given_;
  std::vector<std::vector<Triangle>> triangles_;
  std::vector<Fitted> fitted_;
};

}  // namespace

std::vector<Placement> place_islands(const NewIslands& islands, const std::vector<AlignedBox2d>& taken,
                                     const Task& task) {
  check(islands, taken);
  return Placer(islands).place(taken, task);
}

}  // namespace seamwire
