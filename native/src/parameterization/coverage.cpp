// SPDX-License-Identifier: GPL-3.0-or-later
#include "parameterization/coverage.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "detail/index.hpp"
#include "detail/poll.hpp"

namespace seamwire::detail {
namespace {

using Point = Eigen::Vector2d;

/// Where the reference point of a cell is in it. Maps that people make have corners at simpler places.
constexpr std::array<double, 2> kReference{0.414213562, 0.577215665};
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

/// A place on a side at which another one touches it.
struct Touch {
  std::int32_t side;
  double along;
  auto operator<=>(const Touch&) const = default;
};

/// Adds the places between the ends of a side at which another one touches it.
void add_touches(const OutlineSide& one, std::int32_t number, const OutlineSide& other, double tolerance,
                 std::vector<Touch>& touches) {
  const double least = tolerance / (one.to - one.from).norm();
  const auto add = [&](double part) {
    if (part > least && part < 1.0 - least) touches.push_back({number, part});
  };
  for (const Point* end : {&other.from, &other.to}) {
    if (distance(one, *end) <= tolerance) add(along(one, *end));
  }
  const double from = turn(other.from, other.to, one.from), to = turn(other.from, other.to, one.to);
  if ((from > 0.0) != (to > 0.0)) add(from / (from - to));
}

}  // namespace

void mark_longest(std::span<OutlineSide> loop) {
  const auto length = [](const OutlineSide& side) { return (side.to - side.from).norm(); };
  const auto longest = std::ranges::max_element(loop, {}, length);
  if (longest != loop.end()) longest->is_longest = true;
}

Coverage::Coverage(std::vector<OutlineSide> sides, std::vector<InnerPoint> inner, double tolerance, const Task& task)
    : sides_(std::move(sides)), inner_(std::move(inner)), tolerance_(tolerance), task_(task) {
  Box all;
  for (const OutlineSide& side : sides_) {
    all.add(side.from.data(), tolerance_);
    all.add(side.to.data(), tolerance_);
  }
  if (sides_.empty()) all.add(Point(0.0, 0.0).data());
  low_ = all.low;
  const std::array<double, 2> extent{all.high[0] - all.low[0], all.high[1] - all.low[1]};
  const auto count = static_cast<double>(std::max<std::size_t>(sides_.size(), 1));
  const double cell =
      std::max(std::sqrt(extent[0]) * std::sqrt(extent[1] / count), std::max(extent[0], extent[1]) / count);
  for (std::size_t k = 0; k < 2; ++k) {
    counts_[k] = cell > 0.0 ? std::clamp(static_cast<std::int32_t>(extent[k] / cell), 1, 1 << 15) : 1;
    cell_[k] = extent[k] > 0.0 ? extent[k] / counts_[k] : 1.0;
  }
  cells_ = Csr<std::int32_t>(index(counts_[0]) * index(counts_[1]), [&](const auto& visit) {
    const Poll poll(task_, 0.0, 0.0, sides_.size());
    for (std::size_t s = 0; s < sides_.size(); ++s) {
      poll.at(s);
      for_each_cell(sides_[s], [&](std::int32_t cell_number) { visit(cell_number, static_cast<std::int32_t>(s)); });
    }
  });
  sum_up_references();
}

std::array<std::int32_t, 2> Coverage::cell_of(const Point& point) const {
  std::array<std::int32_t, 2> cell{};
  for (std::size_t k = 0; k < 2; ++k) {
    const double at = (point[static_cast<Eigen::Index>(k)] - low_[k]) / cell_[k];
    cell[k] = static_cast<std::int32_t>(std::clamp(at, 0.0, counts_[k] - 1.0));
  }
  return cell;
}

Point Coverage::reference(std::int32_t column, std::int32_t row) const {
  return {low_[0] + (column + kReference[0]) * cell_[0], low_[1] + (row + kReference[1]) * cell_[1]};
}

/// Visits the cells that a side passes through, and those closer to it than the tolerance.
template <class Visit>
void Coverage::for_each_cell(const OutlineSide& side, const Visit& visit) const {
  const bool rises = side.from.y() <= side.to.y();
  const Point& bottom = rises ? side.from : side.to;
  const Point& top = rises ? side.to : side.from;
  const double height = top.y() - bottom.y();
  const std::int32_t first = cell_of(bottom - Point(0.0, tolerance_))[1],
                     last = cell_of(top + Point(0.0, tolerance_))[1];
  const auto x_at = [&](double y) {
    const double part = height > 0.0 ? std::clamp((y - bottom.y()) / height, 0.0, 1.0) : 0.0;
    return bottom.x() + part * (top.x() - bottom.x());
  };
  for (std::int32_t row = first; row <= last; ++row) {
    double begin = bottom.x(), end = top.x();
    if (height > 2.0 * tolerance_ && first < last) {
      begin = x_at(low_[1] + row * cell_[1] - tolerance_);
      end = x_at(low_[1] + (row + 1) * cell_[1] + tolerance_);
    }
    if (begin > end) std::swap(begin, end);
    const std::int32_t from = cell_of({begin - tolerance_, 0.0})[0], to = cell_of({end + tolerance_, 0.0})[0];
    for (std::int32_t column = from; column <= to; ++column) visit(row * counts_[0] + column);
  }
}

void Coverage::sum_up_references() {
  references_.assign(index(counts_[0]) * index(counts_[1]), 0);
  for (const auto& side : sides_) {
    const double bottom = std::min(side.from.y(), side.to.y()), top = std::max(side.from.y(), side.to.y());
    for (std::int32_t row = cell_of({0.0, bottom})[1]; row <= cell_of({0.0, top})[1]; ++row) {
      const double y = reference(0, row).y();
      if ((side.from.y() > y) == (side.to.y() > y)) continue;
      const double x =
          side.from.x() + (y - side.from.y()) / (side.to.y() - side.from.y()) * (side.to.x() - side.from.x());
      const double column = std::ceil((x - low_[0]) / cell_[0] - kReference[0]);
      if (!(column < counts_[0])) continue;
      references_[index(row) * index(counts_[0]) + static_cast<std::size_t>(std::max(0.0, column))] +=
          side.from.y() > side.to.y() ? 1 : -1;
    }
  }
  for (std::size_t i = 0; i < references_.size(); ++i) {
    if (i % index(counts_[0]) != 0) references_[i] += references_[i - 1];
  }
}

int Coverage::winding(const Point& point) const {
  const auto [column, row] = cell_of(point);
  const Point known = reference(column, row);
  const std::int32_t cell = row * counts_[0] + column;
  int winding = references_[index(cell)];
  for (const std::int32_t s : cells_[cell]) {
    const OutlineSide& side = sides_[index(s)];
    if ((turn(known, point, side.from) > 0.0) == (turn(known, point, side.to) > 0.0)) continue;
    winding += (turn(side.from, side.to, point) > 0.0 ? 1 : 0) - (turn(side.from, side.to, known) > 0.0 ? 1 : 0);
  }
  return winding;
}

std::vector<std::int32_t> Coverage::groups_at(const Point& point) const {
  const auto [column, row] = cell_of(point);
  std::vector<std::int32_t> crossed;
  for (std::int32_t c = column; c < counts_[0]; ++c) {
    for (const std::int32_t s : cells_[row * counts_[0] + c]) {
      const OutlineSide& side = sides_[index(s)];
      if ((side.from.y() > point.y()) == (side.to.y() > point.y())) continue;
      const bool rises = side.to.y() > side.from.y();
      if ((turn(side.from, side.to, point) > 0.0) == rises) crossed.push_back(s);
    }
  }
  std::ranges::sort(crossed);
  crossed.erase(std::unique(crossed.begin(), crossed.end()), crossed.end());
  std::vector<std::pair<std::int32_t, int>> windings;
  for (const std::int32_t s : crossed) {
    const OutlineSide& side = sides_[index(s)];
    windings.emplace_back(side.group, side.to.y() > side.from.y() ? 1 : -1);
  }
  std::ranges::sort(windings);
  std::vector<std::int32_t> groups;
  for (std::size_t i = 0; i < windings.size();) {
    const std::int32_t group = windings[i].first;
    int sum = 0;
    for (; i < windings.size() && windings[i].first == group; ++i) sum += windings[i].second;
    if (sum != 0) groups.push_back(group);
  }
  return groups;
}

Coverage::Meeting Coverage::meeting(const OutlineSide& one, const OutlineSide& other) const {
  if (one.tail == other.tail || one.tail == other.tip || one.tip == other.tail || one.tip == other.tip) {
    return Meeting::kApart;
  }
  Box box, other_box;
  for (const Point* end : {&one.from, &one.to}) box.add(end->data(), tolerance_);
  for (const Point* end : {&other.from, &other.to}) other_box.add(end->data());
  if (!box.meets(other_box)) return Meeting::kApart;
  // Twice areas: positive and negative if the ends of one side are on both sides of the other.
  const std::array<double, 2> of_other{turn(one.from, one.to, other.from), turn(one.from, one.to, other.to)};
  const std::array<double, 2> of_one{turn(other.from, other.to, one.from), turn(other.from, other.to, one.to)};
  const auto parts = [](const std::array<double, 2>& turns, double least) {
    return (turns[0] > least && turns[1] < -least) || (turns[0] < -least && turns[1] > least);
  };
  if (parts(of_other, 0.0) && parts(of_one, 0.0)) {
    const bool is_deep = parts(of_other, tolerance_ * (one.to - one.from).norm()) &&
                         parts(of_one, tolerance_ * (other.to - other.from).norm());
    return is_deep ? Meeting::kCrossing : Meeting::kTouching;
  }
  const double least = std::min(std::min(distance(one, other.from), distance(one, other.to)),
                                std::min(distance(other, one.from), distance(other, one.to)));
  return least <= tolerance_ ? Meeting::kTouching : Meeting::kApart;
}

template <class IsRelevant, class Crossing, class Look>
bool Coverage::find(const IsRelevant& is_relevant, const Crossing& crossing, const Look& look) const {
  std::vector<Touch> touches;
  std::vector<std::uint8_t> is_touched(sides_.size(), 0);
  std::vector<std::int32_t> seen_from(sides_.size(), -1);
  Poll poll(task_, 0.0, 0.0, 1);
  const auto try_pair = [&](std::int32_t s, std::int32_t t) {
    const OutlineSide& one = sides_[index(s)];
    const OutlineSide& other = sides_[index(t)];
    if (!is_relevant(one, other)) return false;
    const Meeting meets = meeting(one, other);
    if (meets == Meeting::kCrossing) return crossing(one, other);
    if (meets == Meeting::kApart) return false;
    is_touched[index(s)] = is_touched[index(t)] = 1;
    add_touches(one, s, other, tolerance_, touches);
    add_touches(other, t, one, tolerance_, touches);
    return false;
  };
  for (std::int32_t s = 0; index(s) < sides_.size(); ++s) {
    bool is_found = false;
    for_each_cell(sides_[index(s)], [&](std::int32_t cell) {
      const std::span<const std::int32_t> here = cells_[cell];
      for (auto t = std::ranges::upper_bound(here, s); t != here.end() && !is_found; ++t) {
        poll.next();
        if (std::exchange(seen_from[index(*t)], s) != s) is_found = try_pair(s, *t);
      }
    });
    if (is_found) return true;
  }
  for (std::size_t s = 0; s < sides_.size(); ++s) {
    if (sides_[s].is_longest) is_touched[s] = 1;
  }
  // Between two touches of a side the number of times that the plane beside it is covered is the same everywhere.
  for (std::int32_t s = 0; index(s) < sides_.size(); ++s) {
    if (is_touched[index(s)] != 0) touches.insert(touches.end(), {{s, 0.0}, {s, 1.0}});
  }
  std::ranges::sort(touches);
  for (std::size_t i = 1; i < touches.size(); ++i) {
    poll.next();
    if (touches[i].side != touches[i - 1].side) continue;
    const OutlineSide& side = sides_[index(touches[i].side)];
    const double begin = touches[i - 1].along, part = touches[i].along - begin;
    const Point way = side.to - side.from;
    const double length = way.norm();
    if (!(part * length > tolerance_)) continue;
    std::array<Point, 2> points;
    for (std::size_t k = 0; k < 2; ++k) {
      points[k] = side.from + (begin + kBeside[k][1] * part) * way +
                  kBeside[k][0] * tolerance_ / length * Point(-way.y(), way.x());
    }
    if (look(points)) return true;
  }
  for (const auto& [place, group, reach] : inner_) {
    poll.next();
    if (reach > tolerance_ && look(std::array<Point, 1>{place})) return true;
  }
  return false;
}

bool Coverage::is_double() const {
  return find([](const auto&, const auto&) { return true; }, [](const auto&, const auto&) { return true; },
              [&](std::span<const Point> points) {
                return std::ranges::all_of(points, [&](const Point& point) { return winding(point) > 1; });
              });
}

void Coverage::mark_colliding(std::vector<std::uint8_t>& is_colliding) const {
  const auto is_known = [&](std::int32_t group) { return is_colliding[index(group)] != 0; };
  find(
      [&](const OutlineSide& one, const OutlineSide& other) {
        return one.group != other.group && !(is_known(one.group) && is_known(other.group));
      },
      [&](const OutlineSide& one, const OutlineSide& other) {
        is_colliding[index(one.group)] = is_colliding[index(other.group)] = 1;
        return false;
      },
      [&](std::span<const Point> points) {
        for (const Point& point : points) {
          if (winding(point) < 2) return false;
        }
        std::vector<std::int32_t> groups = groups_at(points.front());
        for (const Point& point : points.subspan(1)) {
          const std::vector<std::int32_t> others = groups_at(point);
          std::erase_if(groups, [&](std::int32_t group) { return !std::ranges::binary_search(others, group); });
        }
        if (groups.size() < 2) return false;
        for (const std::int32_t group : groups) is_colliding[index(group)] = 1;
        return false;
      });
}

}  // namespace seamwire::detail
