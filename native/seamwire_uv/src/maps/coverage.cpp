// SPDX-License-Identifier: GPL-3.0-or-later
#include "maps/coverage.hpp"

#include <algorithm>
#include <utility>

#include "detail/drop_repeats.hpp"
#include "detail/index.hpp"
#include "detail/poll.hpp"

namespace seamwire::detail {
namespace {

using Point = Eigen::Vector2d;

/// How far beside a side the winding number is looked up, in tolerances, and how far along a part of the side. Both
/// points have to be covered twice.
constexpr std::array<std::array<double, 2>, 2> kBeside{{{2.0, 0.5}, {3.0, 0.382}}};

/// Twice the area of the triangle abc.
double turn(const Point& a, const Point& b, const Point& c) {
  return (b.x() - a.x()) * (c.y() - a.y()) - (b.y() - a.y()) * (c.x() - a.x());
}

/// How far along a side its nearest point to another point is, from 0 to 1.
double along(const OutlineSide& side, const Point& point) {
  const Point way = side.to - side.from;
  const double squared = way.squaredNorm();
  return squared > 0.0 ? std::clamp((point - side.from).dot(way) / squared, 0.0, 1.0) : 0.0;
}

double distance(const OutlineSide& side, const Point& point) {
  return (side.from + along(side, point) * (side.to - side.from) - point).norm();
}

enum class Meeting : std::uint8_t { kApart, kTouching, kCrossing };

Meeting meeting(const OutlineSide& one, const OutlineSide& other, double tolerance) {
  // Twice areas: positive and negative if the ends of one side are on both sides of the other.
  const std::array<double, 2> of_other{turn(one.from, one.to, other.from), turn(one.from, one.to, other.to)};
  const std::array<double, 2> of_one{turn(other.from, other.to, one.from), turn(other.from, other.to, one.to)};
  const auto parts = [](const std::array<double, 2>& turns, double least) {
    return (turns[0] > least && turns[1] < -least) || (turns[0] < -least && turns[1] > least);
  };
  if (parts(of_other, 0.0) && parts(of_one, 0.0)) {
    const bool is_deep = parts(of_other, tolerance * (one.to - one.from).norm()) &&
                         parts(of_one, tolerance * (other.to - other.from).norm());
    return is_deep ? Meeting::kCrossing : Meeting::kTouching;
  }
  const double least = std::min(std::min(distance(one, other.from), distance(one, other.to)),
                                std::min(distance(other, one.from), distance(other, one.to)));
  return least <= tolerance ? Meeting::kTouching : Meeting::kApart;
}

/// How often a side crosses the ray from a point to the right, upward.
int crossings(const Point& point, const Point& from, const Point& to) {
  if ((from.y() > point.y()) == (to.y() > point.y())) return 0;
  const bool rises = to.y() > from.y();
  if ((turn(from, to, point) > 0.0) != rises) return 0;
  return rises ? 1 : -1;
}

std::vector<Point> ends_of(std::span<const OutlineSide> sides) {
  std::vector<Point> ends;
  ends.reserve(2 * sides.size());
  for (const OutlineSide& side : sides) ends.insert(ends.end(), {side.from, side.to});
  return ends;
}

constexpr auto kSkipsNothing = [](const StripTree::Part&, const StripTree::Part&) { return false; };

/// Touches after which a list is sorted out, for each side. Where many sides meet, most of them are equal.
constexpr std::size_t kManyTouches = 64;

void sort_out(auto& touches) {
  std::ranges::sort(touches);
  drop_repeats(touches);
}

}  // namespace

/// A place on a side at which another one touches it.
struct PieceOutline::Touch {
  std::int32_t side;
  double along;
  auto operator<=>(const Touch&) const = default;
};

PieceOutline::PieceOutline(std::vector<OutlineSide> sides, std::span<const std::size_t> loop_sizes, const Point& inner,
                           double inner_reach, Poll& poll)
    : sides_(std::move(sides)), inner_(inner), inner_reach_(inner_reach), tree_(ends_of(sides_), 2, poll) {
  const auto length = [](const OutlineSide& side) { return (side.to - side.from).norm(); };
  for (const std::size_t size : loop_sizes) {
    const std::size_t begin = first_.size();
    first_.insert(first_.end(), size, static_cast<std::int32_t>(begin));
    const std::span loop = std::span(sides_).subspan(begin, size);
    const auto longest = std::ranges::max_element(loop, {}, length);
    longest_.push_back(static_cast<std::int32_t>(begin) + static_cast<std::int32_t>(longest - loop.begin()));
  }
}

/// Adds the places at which `other` touches `one`, and the ends of `one`.
void PieceOutline::add_touches(const OutlineSide& one, std::int32_t number, const OutlineSide& other, double tolerance,
                               Touches& touches) {
  const double least = tolerance / (one.to - one.from).norm();
  const auto add = [&](double part) {
    if (part > least && part < 1.0 - least) touches.push_back({number, part});
  };
  for (const Point* end : {&other.from, &other.to}) {
    if (distance(one, *end) <= tolerance) add(along(one, *end));
  }
  const double from = turn(other.from, other.to, one.from), to = turn(other.from, other.to, one.to);
  if ((from > 0.0) != (to > 0.0)) add(from / (from - to));
  touches.insert(touches.end(), {{number, 0.0}, {number, 1.0}});
}

int PieceOutline::winding(const StripTree::Part& part, const Point& point, double reach) const {
  const OutlineSide &first = sides_[index(part.begin)], &last = sides_[index(part.end - 1)];
  if (part.is_item()) return crossings(point, first.from, first.to);
  if (tree_.strip(part).is_near(point, reach)) {
    const auto [one, other] = tree_.halves(part);
    return winding(one, point, reach) + winding(other, point, reach);
  }
  // A closed curve in the strip does not wind around a point outside. So a chain counts as the line between its ends.
  const std::int32_t first_loop = first_[index(part.begin)], last_loop = first_[index(part.end - 1)];
  if (first_loop == last_loop) return crossings(point, first.from, last.to);
  return crossings(point, first.from, sides_[index(first_loop)].from) +
         crossings(point, sides_[index(last_loop)].from, last.to);
}

template <class CoversTwice>
bool PieceOutline::is_any_double(Touches touches, double tolerance, Poll& poll, const CoversTwice& covers_twice) const {
  for (const std::int32_t s : longest_) touches.insert(touches.end(), {{s, 0.0}, {s, 1.0}});
  // Between two touches of a side the number of times that the plane beside it is covered is the same everywhere.
  std::ranges::sort(touches);
  for (std::size_t i = 1; i < touches.size(); ++i) {
    poll.next();
    if (touches[i].side != touches[i - 1].side) continue;
    const OutlineSide& side = sides_[index(touches[i].side)];
    const double begin = touches[i - 1].along, part = touches[i].along - begin;
    const Point way = side.to - side.from;
    const double length = way.norm();
    if (!(part * length > tolerance)) continue;
    const auto is_double = [&](const std::array<double, 2>& beside) {
      const Point left = Point(-way.y(), way.x()) / length;
      return covers_twice(side.from + (begin + beside[1] * part) * way + beside[0] * tolerance * left);
    };
    if (std::ranges::all_of(kBeside, is_double)) return true;
  }
  return inner_reach_ > tolerance && covers_twice(inner_);
}

bool PieceOutline::overlaps(const PieceOutline& other, double tolerance, Poll& poll) const {
  const bool is_same = this == &other;
  Touches touches, of_another;
  Touches& of_other = is_same ? touches : of_another;
  const auto covers_twice = [&](const Point& point) {
    const int own = winding(point, tolerance);
    return is_same ? own > 1 : own != 0 && other.winding(point, tolerance) != 0;
  };
  const auto is_double = [&] {
    return is_any_double(touches, tolerance, poll, covers_twice) ||
           (!is_same && other.is_any_double(of_other, tolerance, poll, covers_twice));
  };
  // If the plane is covered many times, sides may touch each other very often. Then it is looked at before all is
  // known.
  std::size_t many = kManyTouches * (sides_.size() + other.sides_.size());
  const auto crosses = [&](std::int32_t s, std::int32_t t) {
    const OutlineSide &one = sides_[index(s)], &two = other.sides_[index(t)];
    if (is_same && (one.tail == two.tail || one.tail == two.tip || one.tip == two.tail || one.tip == two.tip)) {
      return false;
    }
    const Meeting meets = meeting(one, two, tolerance);
    if (meets != Meeting::kTouching) return meets == Meeting::kCrossing;
    add_touches(one, s, two, tolerance, touches);
    add_touches(two, t, one, tolerance, of_other);
    if (touches.size() + of_another.size() < many) return false;
    sort_out(touches);
    sort_out(of_another);
    many = std::max(many, 2 * (touches.size() + of_another.size()));
    return is_double();
  };
  return ClosePairs(tree_, other.tree_, tolerance, kSkipsNothing, poll).any(crosses) || is_double();
}

namespace {

/// Sorts pieces so that halves, quarters and so on lie together.
void sort_by_place(std::span<IslandPiece> pieces) {
  if (pieces.size() < 2) return;
  Point low = pieces.front().outline->strip().middle, high = low;
  for (const IslandPiece& piece : pieces) {
    low = low.cwiseMin(piece.outline->strip().middle);
    high = high.cwiseMax(piece.outline->strip().middle);
  }
  Eigen::Index axis = 0;
  (high - low).maxCoeff(&axis);
  const auto middle = pieces.begin() + static_cast<std::ptrdiff_t>(pieces.size() / 2);
  std::ranges::nth_element(pieces, middle, {},
                           [&](const IslandPiece& piece) { return piece.outline->strip().middle[axis]; });
  sort_by_place(pieces.first(pieces.size() / 2));
  sort_by_place(pieces.subspan(pieces.size() / 2));
}

/// A tree of pieces, which it sorts.
StripTree tree_of(std::span<IslandPiece> pieces, Poll& poll) {
  sort_by_place(pieces);
  std::vector<Point> corners;
  corners.reserve(4 * pieces.size());
  for (const IslandPiece& piece : pieces) {
    const Strip& strip = piece.outline->strip();
    const Point along = strip.half.x() * strip.axis, across = strip.half.y() * Point(-strip.axis.y(), strip.axis.x());
    corners.push_back(strip.middle - along - across);
    corners.push_back(strip.middle - along + across);
    corners.push_back(strip.middle + along + across);
    corners.push_back(strip.middle + along - across);
  }
  return {corners, 4, poll};
}

/// Which parts of a tree of pieces need no more looks.
class DoneParts {
 public:
  DoneParts(const StripTree& tree, std::span<const IslandPiece> pieces, const std::vector<std::uint8_t>& is_colliding)
      : tree_(tree), is_colliding_(is_colliding), island_(2 * pieces.size(), -1), are_known_(2 * pieces.size(), 0) {
    find_island(tree.root(), pieces);
  }
  /// Whether all pieces of two parts are of one island, or of islands that are known to collide.
  bool are_done(const StripTree::Part& one, const StripTree::Part& other) {
    const std::int32_t island = island_[index(one.node)];
    return (island >= 0 && island == island_[index(other.node)]) || (are_known(one) && are_known(other));
  }

 private:
  /// The island of all pieces of a part, or -1.
  std::int32_t find_island(const StripTree::Part& part, std::span<const IslandPiece> pieces) {
    std::int32_t& island = island_[index(part.node)];
    if (part.is_item()) return island = pieces[index(part.begin)].island;
    const auto [one, other] = tree_.halves(part);
    const std::int32_t first = find_island(one, pieces), second = find_island(other, pieces);
    return island = first == second ? first : -1;
  }
  bool are_known(const StripTree::Part& part) {
    std::uint8_t& known = are_known_[index(part.node)];
    if (known != 0) return true;
    const std::int32_t island = island_[index(part.node)];
    const auto [one, other] = tree_.halves(part);
    const bool is_now = island >= 0 ? is_colliding_[index(island)] != 0 : are_known(one) && are_known(other);
    known = is_now ? 1 : 0;
    return is_now;
  }

  const StripTree& tree_;
  const std::vector<std::uint8_t>& is_colliding_;
  std::vector<std::int32_t> island_;     // of each node
  std::vector<std::uint8_t> are_known_;  // of each node: a part of which all islands collide
};

}  // namespace

bool do_any_overlap(std::span<IslandPiece> pieces, double tolerance, Poll& poll) {
  if (pieces.size() < 2) return false;
  const StripTree tree = tree_of(pieces, poll);
  return ClosePairs(tree, tree, tolerance, kSkipsNothing, poll).any([&](std::int32_t i, std::int32_t j) {
    return pieces[index(i)].outline->overlaps(*pieces[index(j)].outline, tolerance, poll);
  });
}

void mark_colliding(std::span<IslandPiece> pieces, double tolerance, std::vector<std::uint8_t>& is_colliding,
                    Poll& poll) {
  if (pieces.size() < 2) return;
  const StripTree tree = tree_of(pieces, poll);
  DoneParts done(tree, pieces, is_colliding);
  const auto is_skipped = [&](const StripTree::Part& one, const StripTree::Part& other) {
    return done.are_done(one, other);
  };
  ClosePairs(tree, tree, tolerance, is_skipped, poll).any([&](std::int32_t i, std::int32_t j) {
    const auto& [one, island] = pieces[index(i)];
    const auto& [other, other_island] = pieces[index(j)];
    if (one->overlaps(*other, tolerance, poll)) {
      is_colliding[index(island)] = is_colliding[index(other_island)] = 1;
    }
    return false;
  });
}

}  // namespace seamwire::detail
