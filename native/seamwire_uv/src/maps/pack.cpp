// SPDX-License-Identifier: GPL-3.0-or-later
#include "seamwire_uv/maps/pack.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <limits>
#include <numbers>
#include <numeric>
#include <optional>
#include <string>
#include <tuple>
#include <unordered_map>
#include <utility>

#include "detail/index.hpp"
#include "detail/infinity.hpp"
#include "detail/poll.hpp"
#include "detail/run_on_threads.hpp"
#include "maps/island_raster.hpp"
#include "maps/packed_square.hpp"
#include "maps/upright.hpp"

namespace seamwire {

using namespace detail;

namespace {

using Corners = std::array<Eigen::Vector2d, 3>;
using Placement = Eigen::Matrix<double, 2, 3>;

/// Cells along a side of the square, where the margin does not ask for more.
constexpr std::int32_t kCells = 510;
/// Cells of the finest raster along a cell of an attempt at the largest scale.
constexpr double kFineCells = 4.0;
constexpr double kMostMargin = 0.25;
/// The margin is at most this over the square root of the number of islands.
constexpr double kMarginOfMany = 0.15;
constexpr double kMostAspect = 1000.0;
/// Coordinates and lengths beyond these powers are not computed with.
constexpr double kLargest = 1e100, kSmallest = 1e-100;
/// An island that fills so much of the smallest rectangle around it lies along the axes.
constexpr double kRectangle = 0.97;
/// Directions within 90 degrees in which PackTurns::kAny tries islands.
constexpr int kDirections = 4;
/// Smaller islands, in parts of the area of all, are tried only along the axes.
constexpr double kLeastArea = 1.0 / 40.0;
/// A turn by quarters has to place an island lower by this part of the square.
constexpr std::int32_t kTurnCost = 64;
/// Shuffled attempts add up to this part of the square to where islands end, at random for each way to turn one.
constexpr double kTurnNoise = 0.3;
/// The scales of attempts differ by these factors: in the first search, and in the last.
constexpr double kWideStep = 1.01, kNarrowStep = 1.004;
/// Attempts made at the same time, and batches of them that may fail before the search ends.
constexpr std::size_t kBatch = 8, kMostFailed = 6;
/// Steps of PackedSquare after which no more attempts are made. A step takes about a nanosecond.
constexpr std::size_t kMostSteps = 60'000'000;
/// The turned islands that may be turned back.
constexpr std::size_t kMostTurnedBack = 64;
/// The scale that is lost at most if no island is turned.
constexpr double kUprightLoss = 1.002;

/// The size by which islands are ordered, the largest first.
enum class Order { kBox, kSide, kPerimeter, kArea };
/// The place that an island gets: with its lowest row, its highest row or its farthest row and column nearest to 0.
enum class Rule { kLowest, kLowestTop, kNearest };

constexpr std::array kOrders{Order::kBox, Order::kSide, Order::kPerimeter, Order::kArea};
constexpr std::array kRules{Rule::kLowest, Rule::kLowestTop, Rule::kNearest};

/// A sequence of numbers, the same on each machine (Steele, Lea and Flood 2014, SplitMix64).
class Dice {
 public:
  explicit Dice(std::uint64_t seed) : state_(seed) {}
  std::uint64_t bits() {
    std::uint64_t z = (state_ += 0x9e3779b97f4a7c15ULL);
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ULL;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebULL;
    return z ^ (z >> 31);
  }
  /// From 0 to 1.
  double next() { return static_cast<double>(bits() >> 11) * 0x1.0p-53; }

 private:
  std::uint64_t state_;
};

/// How an attempt goes.
struct Strategy {
  Order order;
  Rule rule;
  double shuffle = 0.0;  ///< sizes are multiplied by up to e to the power of this
  std::uint64_t seed = 0;
};

/// Strategies that find the scale roughly.
std::vector<Strategy> first_strategies() {
  std::vector<Strategy> all;
  for (const Rule rule : {Rule::kLowest, Rule::kLowestTop}) all.push_back({Order::kBox, rule});
  return all;
}

/// All orders and rules.
std::vector<Strategy> plain_strategies() {
  std::vector<Strategy> all;
  for (const Rule rule : kRules) {
    for (const Order order : kOrders) all.push_back({order, rule});
  }
  return all;
}

/// A batch of strategies that random numbers change.
std::vector<Strategy> shuffled_strategies(std::uint64_t first_seed) {
  std::vector<Strategy> all;
  for (std::uint64_t seed = first_seed; seed < first_seed + kBatch; ++seed) {
    Dice dice(seed);
    const Order order = kOrders[dice.bits() % kOrders.size()];
    const Rule rule = kRules[dice.bits() % kRules.size()];
    all.push_back({order, rule, dice.next(), dice.bits()});
  }
  return all;
}

/// A way to turn an island.
struct Way {
  Placement to_square;  // at scale 1, with the lowest coordinates 0
  double length = 0.0;  // of the longer side of the box around it there
};

/// An island in each way that it may be turned, except by another 180 degrees.
struct TurnedIsland {
  double area = 0.0;  // in the square at scale 1
  std::vector<Way> ways;
  std::vector<IslandRaster> rasters;  // of each way
};

/// The directions in which an island may lie.
std::vector<double> directions(std::span<const Corners> triangles, double area, bool is_small, PackTurns turns) {
  if (turns != PackTurns::kAny) return {0.0};
  std::vector<Point2> points;
  for (const Corners& triangle : triangles) points.insert(points.end(), triangle.begin(), triangle.end());
  const std::vector<Point2> hull = convex_hull(std::move(points));
  const auto sizes = [&](double angle) {
    const Eigen::Rotation2Dd turn(angle);
    Eigen::AlignedBox<double, 2> box;
    for (const Point2& p : hull) box.extend(turn * p);
    return Eigen::Vector2d(box.sizes());
  };
  const Point2 along = longest_direction(hull);
  const double angle = along.isZero() ? 0.0 : -std::atan2(along.y(), along.x());
  std::vector<double> found{angle};
  if (is_small || area >= kRectangle * sizes(angle).prod()) return found;
  for (int i = 1; i < kDirections; ++i) found.push_back(angle + i * std::numbers::pi / 2 / kDirections);
  // The direction with the smallest square around the island, which limits the scale of a large one.
  constexpr int kDegrees = 90;
  double smallest = sizes(angle).maxCoeff(), best = angle;
  for (int i = 1; i < kDegrees; ++i) {
    const double turned = angle + i * std::numbers::pi / 2 / kDegrees, size = sizes(turned).maxCoeff();
    if (size < smallest) std::tie(smallest, best) = std::pair(size, turned);
  }
  found.push_back(best);
  return found;
}

/// The turns that an attempt may give an island: none, those below 180 degrees, or all.
enum class Allowed { kNone, kHalf, kAll };

/// The shapes of islands at one scale. Equal shapes are stored once.
struct Shapes {
  std::vector<CellShape> distinct;
  std::vector<std::vector<std::int32_t>> of_island;  // per turn; -1 if it is like an earlier turn
};

/// Where an island lies.
struct Spot {
  std::int32_t turn = 0;
  Cell cell;
};

using Spots = std::optional<std::vector<Spot>>;

class Search {
 public:
  Search(const std::vector<TurnedIsland>& islands, std::int32_t cells, std::int32_t margin, PackTurns turns,
         const Task& task)
      : islands_(islands), margin_(margin), turns_(turns), squares_(kBatch, PackedSquare(cells)), task_(task) {}

  /// Searches the largest scale. Scales are parts of the largest one at which each island fits into the square.
  void run() {
    const bool may_turn = turns_ != PackTurns::kNone;
    const Allowed some = may_turn ? Allowed::kHalf : Allowed::kNone, all = may_turn ? Allowed::kAll : Allowed::kNone;
    const auto scale = [](int steps) { return std::pow(kWideStep, -steps); };
    int failed = -1, found = 0;
    while (!is_found(scale(found), first_strategies(), some)) {
      failed = found;
      found = 2 * found + 16;
    }
    while (found - failed > 1 && steps() < kMostSteps) {
      const int middle = (failed + found) / 2;
      (is_found(scale(middle), first_strategies(), some) ? found : failed) = middle;
    }
    std::vector<Strategy> next = plain_strategies();
    std::uint64_t seed = 1;
    for (std::size_t fails = 0; scale_ < 1.0 && fails < kMostFailed && steps() < kMostSteps; seed += kBatch) {
      fails = is_found(std::min(1.0, scale_ * kNarrowStep), next, all) ? 0 : fails + 1;
      next = shuffled_strategies(seed);
    }
    if (turns_ != PackTurns::kQuarters) return;
    if (!is_found(scale_ / kUprightLoss, plain_strategies(), Allowed::kNone)) turn_back();
  }

  double scale() const { return scale_; }
  const std::vector<Spot>& spots() const { return *spots_; }
  /// The shape of an island as it lies there.
  const CellShape& shape(std::size_t island) const { return shape(island, (*spots_)[island].turn); }

 private:
  std::size_t steps() const {
    return std::accumulate(squares_.begin(), squares_.end(), std::size_t{0},
                           [](std::size_t sum, const PackedSquare& square) { return sum + square.steps(); });
  }

  double progress() const { return std::min(1.0, static_cast<double>(steps()) / static_cast<double>(kMostSteps)); }

  Shapes shapes(double scale) const {
    Shapes found;
    std::unordered_map<std::uint64_t, std::vector<std::int32_t>> by_hash;
    const auto number = [&](CellShape&& shape) {
      std::uint64_t hash =
          Dice((static_cast<std::uint64_t>(shape.width) << 32U) + static_cast<std::uint64_t>(shape.height)).bits();
      for (const CellRun& run : shape.runs) {
        for (const std::int32_t item : {run.row, run.begin, run.end})
          hash = Dice(hash + static_cast<std::uint64_t>(item)).bits();
      }
      std::vector<std::int32_t>& alike = by_hash[hash];
      for (const std::int32_t other : alike) {
        if (found.distinct[index(other)] == shape) return other;
      }
      alike.push_back(static_cast<std::int32_t>(found.distinct.size()));
      found.distinct.push_back(std::move(shape));
      return alike.back();
    };
    for (const TurnedIsland& island : islands_) {
      task_.check(progress());
      std::vector<std::int32_t>& own = found.of_island.emplace_back();
      const auto add = [&](CellShape&& shape) {
        const std::int32_t shape_number = number(std::move(shape));
        own.push_back(std::ranges::find(own, shape_number) == own.end() ? shape_number : -1);
      };
      std::vector<CellShape> ways;
      for (const IslandRaster& raster : island.rasters) ways.push_back(raster.shape(scale / kFineCells, margin_));
      for (std::size_t i = 0, count = ways.size(); count > 1 && i < count; ++i) ways.push_back(turned_over(ways[i]));
      for (CellShape& way : ways) add(std::move(way));
    }
    return found;
  }

  /// Whether islands with half of the margin around them have less area than the square.
  bool has_room(const Shapes& shapes) const {
    const auto cells = [](const std::vector<CellRun>& runs) {
      return std::accumulate(runs.begin(), runs.end(), 0.0,
                             [](double sum, const CellRun& run) { return sum + run.end - run.begin; });
    };
    double sum = 0.0;
    for (const std::vector<std::int32_t>& own : shapes.of_island) {
      const CellShape& shape = shapes.distinct[index(own.front())];
      sum += 0.5 * (cells(shape.runs) + cells(shape.around)) - margin_ * margin_;
    }
    const double side = squares_.front().size() + margin_;
    return sum <= side * side;
  }

  /// Whether one of the strategies places all islands at a scale. Keeps the places.
  bool is_found(double scale, std::span<const Strategy> strategies, Allowed allowed) {
    Shapes shapes = this->shapes(scale);
    if (!has_room(shapes)) return false;
    for (std::size_t begin = 0; begin < strategies.size(); begin += kBatch) {
      const std::size_t count = std::min(kBatch, strategies.size() - begin);
      std::vector<Spots> found(count);
      const double fraction = progress();
      run_on_threads(
          count, task_, [&](std::size_t) { return fraction; },
          [&](std::size_t i, const Task& task) {
            found[i] = placed(shapes, strategies[begin + i], allowed, squares_[i], task);
          });
      const auto first = std::ranges::find_if(found, [](const Spots& spots) { return spots.has_value(); });
      if (first == found.end()) continue;
      spots_ = std::move(*first);
      shapes_ = std::move(shapes);
      scale_ = scale;
      return true;
    }
    return false;
  }

  const CellShape& shape(std::size_t island, std::int32_t turn) const {
    return shapes_.distinct[index(shapes_.of_island[island][index(turn)])];
  }

  /// Turns islands back, the largest first, where they fit without a turn while all others stay.
  void turn_back() {
    std::vector<std::size_t> turned;
    for (std::size_t i = 0; i < islands_.size(); ++i) {
      if ((*spots_)[i].turn != 0) turned.push_back(i);
    }
    std::ranges::stable_sort(turned, std::ranges::greater(), [&](std::size_t i) { return islands_[i].area; });
    if (turned.size() > kMostTurnedBack) turned.resize(kMostTurnedBack);
    PackedSquare& square = squares_.front();
    for (const std::size_t i : turned) {
      task_.check(progress());
      const CellShape& upright = shape(i, 0);
      if (upright.width > square.size()) continue;
      square.clear();
      for (std::size_t other = 0; other < islands_.size(); ++other) {
        const Spot& spot = (*spots_)[other];
        if (other != i) square.take(shape(other, spot.turn), spot.cell);
      }
      for (std::int32_t y = 0; y + upright.height <= square.size(); ++y) {
        const std::optional<std::int32_t> x = square.free_column(upright, y);
        if (!x) continue;
        (*spots_)[i] = {0, {*x, y}};
        break;
      }
    }
  }

  std::vector<std::size_t> ordered(const Shapes& shapes, const Strategy& strategy) const {
    std::vector<double> sizes(islands_.size());
    Dice dice(strategy.seed);
    for (std::size_t i = 0; i < sizes.size(); ++i) {
      const CellShape& shape = shapes.distinct[index(shapes.of_island[i][0])];
      const double width = shape.width, height = shape.height;
      switch (strategy.order) {
        case Order::kBox:
          sizes[i] = width * height;
          break;
        case Order::kSide:
          sizes[i] = std::max(width, height) + 1e-3 * std::min(width, height);
          break;
        case Order::kPerimeter:
          sizes[i] = width + height;
          break;
        case Order::kArea:
          sizes[i] = islands_[i].area;
          break;
      }
      sizes[i] *= std::exp(strategy.shuffle * dice.next());
    }
    std::vector<std::size_t> order(sizes.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::ranges::stable_sort(order, std::ranges::greater(), [&](std::size_t i) { return sizes[i]; });
    return order;
  }

  /// The places of all islands, placed one by one; nullopt if one has no place.
  Spots placed(const Shapes& shapes, const Strategy& strategy, Allowed allowed, PackedSquare& square,
               const Task& task) const {
    constexpr std::pair kNowhere(std::numeric_limits<std::int32_t>::max(), std::numeric_limits<std::int32_t>::max());
    const std::int32_t size = square.size(), turn_cost = turns_ == PackTurns::kQuarters ? size / kTurnCost : 0;
    std::vector<Spot> spots(islands_.size());
    // Rows below these have no place for the shape: what has no room once has none later.
    std::vector<std::int32_t> lowest(shapes.distinct.size(), 0);
    square.clear();
    Poll poll(task, Poll::kFewSteps);
    Dice dice(strategy.seed);
    for (const std::size_t i : ordered(shapes, strategy)) {
      auto best = kNowhere;
      const std::vector<std::int32_t>& turns = shapes.of_island[i];
      const std::size_t last = allowed == Allowed::kAll    ? turns.size()
                               : allowed == Allowed::kHalf ? (turns.size() + 1) / 2
                                                           : 1;
      for (std::size_t turn = 0; turn < last; ++turn) {
        if (turns[turn] < 0) continue;
        const CellShape& shape = shapes.distinct[index(turns[turn])];
        std::int32_t& first = lowest[index(turns[turn])];
        const std::int32_t cost =
            (turn == 0 ? 0 : turn_cost) + static_cast<std::int32_t>(kTurnNoise * strategy.shuffle * dice.next() * size);
        bool is_first = true;
        for (std::int32_t y = first; shape.width <= size && y + shape.height <= size; ++y) {
          poll.next();
          const auto score = [&](std::int32_t x) {
            switch (strategy.rule) {
              case Rule::kLowest:
                return std::pair(y + cost, x);
              case Rule::kLowestTop:
                return std::pair(y + shape.height + cost, x);
              default:
                return std::pair(std::max(x + shape.width, y + shape.height) + cost, x + y);
            }
          };
          if (score(0) >= best) break;
          const std::optional<std::int32_t> x = square.free_column(shape, y);
          if (!x) {
            if (is_first) first = y + 1;
            continue;
          }
          is_first = false;
          if (score(*x) < best) {
            best = score(*x);
            spots[i] = {static_cast<std::int32_t>(turn), {*x, y}};
          }
          if (strategy.rule != Rule::kNearest) break;
        }
      }
      if (best == kNowhere) return std::nullopt;
      square.take(shapes.distinct[index(turns[index(spots[i].turn)])], spots[i].cell);
    }
    return spots;
  }

  const std::vector<TurnedIsland>& islands_;
  std::int32_t margin_;
  PackTurns turns_;
  std::vector<PackedSquare> squares_;
  const Task& task_;
  double scale_ = 0.0;
  Shapes shapes_;
  Spots spots_;
};

/// The triangles of each island.
std::vector<std::vector<Corners>> triangles_by_island(std::span<const Corners> uvs,
                                                      std::span<const std::int32_t> islands, const Task& task) {
  if (islands.size() != uvs.size()) {
    throw InvalidInput("islands has " + std::to_string(islands.size()) + " items: there are " +
                       std::to_string(uvs.size()) + " triangles");
  }
  std::vector<std::vector<Corners>> own;
  const Poll poll(task, 0.0, 0.0, uvs.size());
  for (std::size_t f = 0; f < uvs.size(); ++f) {
    poll.at(f);
    check_index(islands[f], uvs.size(), "islands: number", "triangles");
    for (const Eigen::Vector2d& uv : uvs[f]) {
      if (uv.allFinite() && uv.cwiseAbs().maxCoeff() <= kLargest) continue;
      throw InvalidInput("triangle " + std::to_string(f) + " has a UV that is not finite, or beyond 1e100");
    }
    if (index(islands[f]) >= own.size()) own.resize(index(islands[f]) + 1);
    own[index(islands[f])].push_back(uvs[f]);
  }
  return own;
}

void check_options(const PackOptions& options, std::size_t count) {
  if (!(options.margin >= 0.0 && options.margin <= kMostMargin)) {
    throw InvalidInput("margin is not between 0 and 0.25");
  }
  if (!options.aspects.empty() && options.aspects.size() != count) {
    throw InvalidInput("aspects has " + std::to_string(options.aspects.size()) + " items: there are " +
                       std::to_string(count) + " islands");
  }
  for (const double aspect : options.aspects) {
    if (!(aspect >= 1.0 / kMostAspect && aspect <= kMostAspect)) {
      throw InvalidInput("an aspect is not between 0.001 and 1000");
    }
  }
}

double area_of(std::span<const Corners> triangles) {
  double area = 0.0;
  for (const Corners& t : triangles) {
    const Eigen::Vector2d one = t[1] - t[0], two = t[2] - t[0];
    area += 0.5 * std::abs(one.x() * two.y() - one.y() * two.x());
  }
  return area;
}

/// An island in its directions. Rasters are still missing.
TurnedIsland turned(std::span<const Corners> triangles, double aspect, bool is_small, PackTurns turns) {
  const double area = area_of(triangles);
  std::vector<Eigen::Matrix2d> matrices;
  for (const double angle : directions(triangles, area, is_small, turns)) {
    matrices.push_back(Eigen::Rotation2Dd(angle).toRotationMatrix());
  }
  if (turns != PackTurns::kNone) {
    for (std::size_t i = 0, count = matrices.size(); i < count; ++i) {
      matrices.push_back(Eigen::Matrix2d{{0.0, -1.0}, {1.0, 0.0}} * matrices[i]);
    }
  }
  TurnedIsland island{.area = area / aspect, .ways = {}, .rasters = {}};
  const Eigen::Vector2d origin = triangles.front()[0];
  for (const Eigen::Matrix2d& matrix : matrices) {
    const Eigen::Matrix2d map = Eigen::Vector2d(1.0 / aspect, 1.0).asDiagonal() * matrix;
    Eigen::AlignedBox<double, 2> box;
    for (const Corners& triangle : triangles) {
      for (const Eigen::Vector2d& p : triangle) box.extend(map * (p - origin));
    }
    Way& way = island.ways.emplace_back();
    way.to_square << map, -box.min() - map * origin;
    way.length = box.sizes().maxCoeff();
  }
  return island;
}

/// The raster of triangles after a map. `fine`: the size of its cells.
IslandRaster raster_of(std::vector<Corners> triangles, const Placement& map, double fine, Poll& poll) {
  for (Corners& triangle : triangles) {
    for (Eigen::Vector2d& p : triangle) p = ((map.leftCols<2>() * p + map.col(2)) / fine).cwiseMax(0.0);
  }
  return IslandRaster(triangles, poll);
}

}  // namespace

Packing pack_islands(std::span<const Corners> uvs, std::span<const std::int32_t> islands, const PackOptions& options,
                     const Task& task) {
  const std::vector<std::vector<Corners>> own = triangles_by_island(uvs, islands, task);
  check_options(options, own.size());
  Packing packing;
  packing.placements.resize(own.size(), Placement::Zero());
  std::vector<std::size_t> numbers;  // of the islands with triangles
  std::vector<TurnedIsland> all;
  double total = 0.0, longest = 0.0;
  const double area = area_of(uvs);
  for (std::size_t i = 0; i < own.size(); ++i) {
    if (own[i].empty()) continue;
    task.check(0.0);
    numbers.push_back(i);
    const bool is_small = area_of(own[i]) < kLeastArea * area;
    all.push_back(turned(own[i], options.aspects.empty() ? 1.0 : options.aspects[i], is_small, options.turns));
    total += all.back().area;
    longest = std::max(longest, std::ranges::min(all.back().ways, {}, &Way::length).length);
  }
  if (numbers.empty()) return packing;
  if (!(longest >= kSmallest)) longest = 1.0;

  const double of_many = kMarginOfMany / std::sqrt(static_cast<double>(numbers.size()));
  const double least =
      std::min(1.0 / kCells, of_many);  // smaller cells take much memory, and larger ones too few islands
  const double margin = options.margin > 0.0 ? std::min(std::max(options.margin, least), of_many) : 0.0;
  const auto margin_cells = static_cast<std::int32_t>(std::ceil(kCells * margin));
  const double cell = margin > 0.0 ? margin / margin_cells : least;
  const auto cells = static_cast<std::int32_t>((1.0 - margin) / cell + 1e-9);
  const double most = std::min(1.0 / std::sqrt(total), cell * cells / longest);

  Poll poll(task);
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    // At less than half of the scale there is room in shorter ways.
    std::erase_if(all[i].ways, [&](const Way& way) { return way.length > 2.0 * longest; });
    for (const Way& way : all[i].ways) {
      all[i].rasters.push_back(raster_of(own[numbers[i]], way.to_square, cell / (most * kFineCells), poll));
    }
  }
  Search search(all, cells, margin_cells, options.turns, task);
  search.run();

  packing.scale = most * search.scale();
  packing.used = total * packing.scale * packing.scale;
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    const Spot& spot = search.spots()[i];
    const std::size_t count = all[i].ways.size();
    Placement placement = packing.scale * all[i].ways[index(spot.turn) % count].to_square;
    if (index(spot.turn) >= count) {
      placement = -placement;
      placement.col(2) += cell * Eigen::Vector2d(search.shape(i).width, search.shape(i).height);
    }
    placement.col(2) += cell * Eigen::Vector2d(spot.cell.x, spot.cell.y) + Eigen::Vector2d::Constant(0.5 * margin);
    packing.placements[numbers[i]] = placement;
  }
  return packing;
}

}  // namespace seamwire
