// SPDX-License-Identifier: GPL-3.0-or-later
#include "maps/island_map.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <set>
#include <string>
#include <utility>

#include "detail/index.hpp"
#include "detail/infinity.hpp"
#include "maps/outline.hpp"
#include "maps/symmetric_dirichlet.hpp"
#include "maps/tutte.hpp"
#include "numeric/block_cholesky.hpp"

namespace seamwire::detail {
namespace {

/// In the first phase no triangle's energy may exceed this. The phase ends once a step promises less than the second
/// number: some triangles may stay above the limit in the best map.
constexpr double kEnergyOfMovedShapes = 20.0, kEndOfFirstPhase = 0.1;
/// A step ends at this part of the way to the first flip, or to the first contact of the outline.
constexpr double kPartOfWay = 0.9;
/// Armijo's condition: the energy has to fall by this part of what the gradient promises.
constexpr double kSufficientDecrease = 1e-4;
constexpr int kMostHalvings = 40;
constexpr double kLongestStep = 4.0;  // times Newton's
/// The barrier begins at this part of the square root of the island's area, or of the mean outline edge.
constexpr double kReachOfArea = 0.003, kReachOfEdge = 0.25;
/// A map whose outline has a barrier of less than this energy is a good start with the barrier.
constexpr double kBarrierOfStart = 0.5;
/// Pairs closer than this part of the barrier's reach touch in the start. Their vertices move by the second part of the
/// way to the middle of their triangles.
constexpr double kTouchingPart = 1e-3, kPartedBy = 0.02;
/// Crossings not deeper than this, in the unit of maps, come from the two sides of a slit that is closed in the map.
/// measure_map() ignores crossings of twice that depth.
constexpr double kTouchingDepth = 5e-7;
/// Crossings of a start with the barrier are less deep.
constexpr double kStartDepth = 1e-8;
/// The projection to a plane is a start if its energy is below this: the island is flat.
constexpr double kFlatEnergy = 4.01;
/// Added to the matrix's diagonal, as a part of its mean: the energy does not change with translations.
constexpr double kLeastRegularization = 1e-9;

/// The points of own vertices, with coordinates between -2 and 2. The unit is a power of two, so that conversion is
/// exact.
struct LocalPoints {
  std::vector<Vector> points;
  double unit = 1.0;  // of the caller's
};

LocalPoints local_points(const Island& island, std::span<const Vector> points) {
  LocalPoints local;
  const Vector& origin = points[index(island.vertices.front())];
  double reach = 0.0;
  for (const std::int32_t v : island.vertices) {
    local.points.emplace_back(points[index(v)] - origin);
    reach = std::max(reach, local.points.back().cwiseAbs().maxCoeff());
  }
  if (reach >= std::numeric_limits<double>::min()) local.unit = std::ldexp(1.0, std::ilogb(reach));
  for (Vector& p : local.points) p /= local.unit;
  return local;
}

/// The data of an island before it is mapped.
class Problem {
 public:
  Problem(const Island& island, std::span<const Vector> points, const Task& task)
      : island_(island),
        local_(local_points(island, points)),
        boundaries_(island.boundaries()),
        energy_(island.triangles, local_.points),
        edges_(island_edges(island)) {
    find_outer_loop();
    task.check(0.0);
    analyse(task);
    task.check(0.0);
    double length = 0.0;
    std::size_t count = 0;
    for (const std::vector<std::int32_t>& loop : boundaries_) {
      length += loop_length(loop, local_.points);
      count += loop.size();
    }
    const double mean = length / static_cast<double>(count) / energy_.unit();
    outline_.emplace(boundaries_, std::min(kReachOfArea * std::sqrt(energy_.area()), kReachOfEdge * mean));
  }

  double unit() const { return local_.unit * energy_.unit(); }
  const Outline& outline() const { return *outline_; }
  SymmetricDirichlet& energy() { return energy_; }
  BlockCholesky& solver() { return *solver_; }
  std::span<const TriangleBlocks> blocks() const { return blocks_; }
  std::size_t vertex_count() const { return island_.vertices.size(); }

  /// The projection to the plane that an island lies in; empty if the island is not flat.
  std::vector<double> projection(const Task& task) const {
    Vector normal = Vector::Zero();
    for (const auto& [a, b, c] : island_.triangles) normal += (point(b) - point(a)).cross(point(c) - point(a));
    if (!(normal.norm() > 0.0)) return {};
    normal.normalize();
    const Vector along = normal.unitOrthogonal(), across = normal.cross(along);
    std::vector<double> map;
    map.reserve(2 * local_.points.size());
    for (const Vector& p : local_.points) {
      for (const Vector* axis : {&along, &across}) map.push_back(p.dot(*axis) / energy_.unit());
    }
    const bool is_flat = energy_.energy(map) < kFlatEnergy && !outline_->covers_twice(map, kTouchingDepth, task);
    return is_flat ? map : std::vector<double>{};
  }
  /// The better one of Tutte's embeddings on a circle and, for a long island, on a rectangle.
  std::vector<double> tutte(const Task& task) {
    TutteOutline outline{.outer = outer_, .area = energy_.area()};
    const auto embed = [&] { return tutte_embedding(island_, local_.points, boundaries_, outline, *solver_, task); };
    const std::vector<double> map = embed();
    const double unit = energy_.unit();
    outline.ends = long_ends(island_, local_.points, boundaries_[outer_], energy_.area() * unit * unit);
    if (!outline.ends) return map;
    outline.ends->length /= unit;
    const std::vector<double> other = embed();
    return mean_logarithm(other) < mean_logarithm(map) ? other : map;
  }
  /// The mean of the centers of each vertex's triangles.
  std::vector<Point2> middles_around(std::span<const double> map) const {
    std::vector<Point2> middles(vertex_count(), Point2::Zero());
    std::vector<double> counts(vertex_count(), 0.0);
    for (const Triangle& t : island_.triangles) {
      Point2 center = Point2::Zero();
      for (const std::int32_t v : t) center += Point2(map[2 * index(v)], map[2 * index(v) + 1]) / 3.0;
      for (const std::int32_t v : t) {
        middles[index(v)] += center;
        counts[index(v)] += 1.0;
      }
    }
    for (std::size_t v = 0; v < middles.size(); ++v) middles[v] /= counts[v];
    return middles;
  }
  /// Makes room in the matrix for the pairs.
  void make_room_for(const std::vector<Outline::Pair>& pairs, const Task& task) {
    const std::size_t before = added_.size();
    for (const auto& [vertex, a, b] : pairs) {
      for (const std::int32_t other : {a, b}) added_.insert({std::min(vertex, other), std::max(vertex, other)});
    }
    if (added_.size() == before) return;
    edges_.resize(own_edges_);
    edges_.insert(edges_.end(), added_.begin(), added_.end());
    analyse(task);
  }

 private:
  const Vector& point(std::int32_t v) const { return local_.points[index(v)]; }

  /// Of the energies of a map's triangles, over the area. A few bad triangles are mended soon, and must not decide.
  double mean_logarithm(std::span<const double> map) const {
    if (map.empty()) return kInfinity;
    const std::vector<double> energies = energy_.energies(map);
    double sum = 0.0;
    for (std::size_t k = 0; k < energies.size(); ++k) sum += energy_.weights()[k] * std::log(energies[k]);
    return sum;
  }

  void find_outer_loop() {
    own_edges_ = edges_.size();
    if (boundaries_.empty() || island_.euler_characteristic() != 2 - std::ssize(boundaries_)) {
      throw InvalidInput("the island with triangle " + std::to_string(island_.faces.front()) +
                         " is neither a disc nor a disc with holes");
    }
    const std::int32_t outer = outer_loop(boundaries_, local_.points);
    if (outer < 0) {
      throw InvalidInput("the island with triangle " + std::to_string(island_.faces.front()) +
                         " has no boundary loop of three or more edges");
    }
    outer_ = index(outer);
  }

  void analyse(const Task& task) {
    solver_.emplace(island_.vertices.size(), edges_, task);
    blocks_.resize(island_.triangles.size());
    const auto turned = [](const BlockEntry& entry) { return BlockEntry{entry.offset, entry.column, entry.row}; };
    for (std::int32_t h = 0; index(h) < island_.twins.size(); ++h) {
      const Triangle& t = island_.triangles[h / 3];
      const std::int32_t twin = island_.twins[h];
      blocks_[h / 3][h % 3] = solver_->block(t[h % 3], t[h % 3]);
      blocks_[h / 3][3 + h % 3] =
          twin >= 0 && twin < h ? turned(blocks_[twin / 3][3 + twin % 3]) : solver_->block(t[h % 3], t[(h + 1) % 3]);
    }
  }

  const Island& island_;
  LocalPoints local_;
  std::vector<std::vector<std::int32_t>> boundaries_;
  SymmetricDirichlet energy_;
  std::vector<Edge> edges_;  // the island's own ones, then those that the barrier needs
  std::size_t own_edges_ = 0;
  std::set<Edge> added_;
  std::size_t outer_ = 0;
  std::optional<Outline> outline_;
  std::optional<BlockCholesky> solver_;
  std::vector<TriangleBlocks> blocks_;
};

double dot(std::span<const double> a, std::span<const double> b) {
  double sum = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += a[i] * b[i];
  return sum;
}

/// Newton's method on one map.
class Minimizer {
 public:
  Minimizer(Problem& problem, std::vector<double> map, bool has_barrier, const MapOptions& options, const Task& task)
      : problem_(problem), map_(std::move(map)), has_barrier_(has_barrier), options_(options), task_(task) {}

  /// Both phases.
  void run() {
    while (steps_ < options_.max_steps && problem_.energy().move_rest_shapes(map_, kEnergyOfMovedShapes) > 0) {
      if (!step() || decrement_ < kEndOfFirstPhase) break;
    }
    problem_.energy().move_rest_shapes(map_, kInfinity);
    while (steps_ < options_.max_steps && !is_finished_) {
      is_finished_ =
          !step() || decrement_ < options_.tolerance || energy_ - kReserve * decrement_ > options_.worse_than;
    }
  }
  const std::vector<double>& map() const { return map_; }
  /// The last map without a barrier that is a good start with one; empty without such a map.
  const std::vector<double>& last_apart() const { return last_apart_; }
  std::size_t steps() const { return steps_; }
  bool is_finished() const { return is_finished_; }

 private:
  /// How many times the quadratic model's decrease may still come.
  static constexpr double kReserve = 10.0;

  /// Between pieces of work that take some milliseconds at 100,000 triangles. How many steps are left is not known.
  void check() const { task_.check(static_cast<double>(steps_) / (static_cast<double>(steps_) + 10.0)); }

  double energy_of(std::span<const double> map) const {
    const double energy = problem_.energy().energy(map);
    return has_barrier_ && std::isfinite(energy) ? energy + problem_.outline().energy(map) : energy;
  }

  void add_barrier(std::vector<double>& gradient) {
    const std::vector<Outline::Pair> pairs = problem_.outline().close_pairs(map_, 1.0);
    std::vector<double>& values = problem_.solver().values();
    for (const Outline::Pair& pair : pairs) {
      const Outline::Slope slope = problem_.outline().slope(pair, map_);
      const std::array<std::int32_t, 3> vertices{pair.vertex, pair.a, pair.b};
      const auto &g = slope.of_distance, &t = slope.turning;
      for (std::size_t k = 0; k < 3; ++k) {
        for (std::size_t c = 0; c < 2; ++c) gradient[2 * index(vertices[k]) + c] += slope.first * g[2 * k + c];
        for (std::size_t l = 0; l <= k; ++l) {
          const BlockEntry at = problem_.solver().block(vertices[k], vertices[l]);
          for (std::size_t r = 0; r < 2; ++r) {
            for (std::size_t c = 0; c < 2; ++c) {
              values[at.offset + r * at.row + c * at.column] +=
                  slope.second * g[2 * k + r] * g[2 * l + c] + t[2 * k + r] * t[2 * l + c];
            }
          }
        }
      }
    }
  }

  /// Fills `gradient` and factors the Hessian.
  void factor(std::vector<double>& gradient) {
    if (has_barrier_) problem_.make_room_for(problem_.outline().close_pairs(map_, 2.0), task_);
    for (double regularization = kLeastRegularization;; regularization *= 1e3) {
      BlockCholesky& solver = problem_.solver();
      solver.clear();
      std::fill(gradient.begin(), gradient.end(), 0.0);
      problem_.energy().add_derivatives(map_, problem_.blocks(), gradient, solver.values());
      if (has_barrier_) add_barrier(gradient);
      check();
      double sum = 0.0;
      const auto diagonal = [&](std::int32_t v) {
        const BlockEntry at = solver.block(v, v);
        return std::array<double*, 2>{&solver.values()[at.offset], &solver.values()[at.offset + at.row + at.column]};
      };
      const auto count = static_cast<std::int32_t>(problem_.vertex_count());
      for (std::int32_t v = 0; v < count; ++v) {
        for (const double* value : diagonal(v)) sum += *value;
      }
      const double added = regularization * sum / (2.0 * count);
      for (std::int32_t v = 0; v < count; ++v) {
        for (double* value : diagonal(v)) *value += added;
      }
      if (solver.factor(task_) || regularization > 1.0) return;
    }
  }

  /// One Newton step with a line search. Returns whether the energy has fallen.
  bool step() {
    check();
    std::vector<double> gradient(map_.size());
    energy_ = energy_of(map_);
    factor(gradient);
    std::vector<double> direction(gradient);
    for (double& value : direction) value = -value;
    check();
    problem_.solver().solve(direction);
    check();
    const double slope = dot(gradient, direction);
    decrement_ = -0.5 * slope;
    ++steps_;
    if (!(slope < 0.0) || !std::isfinite(slope)) return false;
    return search(direction, slope);
  }

  /// Moves along a direction as far as the energy falls. The step is halved until the energy falls enough. Or it is
  /// doubled as long as that lowers the energy further, because the projected Hessian is often too stiff.
  bool search(const std::vector<double>& direction, double slope) {
    double most = std::min(kLongestStep, kPartOfWay * problem_.energy().first_flip(map_, direction));
    if (has_barrier_) most = kPartOfWay * problem_.outline().first_contact(map_, direction, most / kPartOfWay);
    std::vector<double> next(map_.size()), farther(map_.size());
    const auto move = [&](double length, std::vector<double>& to) {
      check();
      for (std::size_t i = 0; i < map_.size(); ++i) to[i] = map_[i] + length * direction[i];
      return energy_of(to);
    };
    double length = std::min(1.0, most), energy = move(length, next);
    for (int halvings = 0; !(energy <= energy_ + kSufficientDecrease * length * slope); ++halvings) {
      if (halvings == kMostHalvings) return false;
      length *= 0.5;
      energy = move(length, next);
    }
    while (2.0 * length <= most && length >= 1.0) {
      length *= 2.0;
      const double lower = move(length, farther);
      if (!(lower < energy)) break;
      energy = lower;
      next.swap(farther);
    }
    const bool falls = energy < energy_;
    map_.swap(next);
    energy_ = energy;
    keep_if_apart();
    return falls;
  }

  void keep_if_apart() {
    if (has_barrier_ || !options_.keep_apart) return;
    if (!(problem_.outline().energy(map_) < kBarrierOfStart)) return;
    if (problem_.outline().covers_twice(map_, kStartDepth, task_)) return;
    last_apart_ = map_;
  }

  Problem& problem_;
  std::vector<double> map_, last_apart_;
  bool has_barrier_;
  const MapOptions& options_;
  const Task& task_;
  std::size_t steps_ = 0;
  bool is_finished_ = false;
  double energy_ = 0.0, decrement_ = 0.0;
};

/// `steps`: those of a solve before.
IslandMap result_of(Problem& problem, const Minimizer& solved, std::size_t steps, bool overlaps) {
  const std::vector<double>& map = solved.map();
  IslandMap result;
  result.energy = problem.energy().energy(map);
  result.overlaps = overlaps;
  result.steps = steps + solved.steps();
  result.is_finished = solved.is_finished();
  result.uvs.reserve(map.size() / 2);
  for (std::size_t i = 0; i < map.size(); i += 2) {
    result.uvs.emplace_back(map[i] * problem.unit(), map[i + 1] * problem.unit());
  }
  return result;
}

/// A map in the unit of its energy.
struct MeasuredMap {
  SymmetricDirichlet energy;
  std::vector<double> map;

  MeasuredMap(const Island& island, std::span<const Vector> points, std::span<const Point2> uvs)
      : MeasuredMap(island, local_points(island, points), uvs) {}

 private:
  MeasuredMap(const Island& island, const LocalPoints& local, std::span<const Point2> uvs)
      : energy(island.triangles, local.points) {
    map.reserve(2 * uvs.size());
    for (const Point2& uv : uvs) {
      for (const double value : uv) map.push_back(value / (local.unit * energy.unit()));
    }
  }
};

/// A start whose outline touches nothing: vertices of the outline that touch it move towards the middle of their
/// triangles, so that the two sides of a slit part. Returns nothing if that is not enough.
std::vector<double> parted(Problem& problem, const std::vector<double>& start, const Task& task) {
  std::vector<double> map = start;
  const std::vector<Point2> middles = problem.middles_around(start);
  for (const Outline::Pair& pair : problem.outline().close_pairs(start, kTouchingPart)) {
    const Point2& middle = middles[index(pair.vertex)];
    for (std::size_t k = 0; k < 2; ++k) {
      const std::size_t at = 2 * index(pair.vertex) + k;
      map[at] = start[at] + kPartedBy * (middle[static_cast<Eigen::Index>(k)] - start[at]);
    }
  }
  const bool is_fine = std::isfinite(problem.energy().energy(map)) && std::isfinite(problem.outline().energy(map)) &&
                       !problem.outline().covers_twice(map, kStartDepth, task);
  return is_fine ? map : std::vector<double>{};
}

/// `may_repeat`: whether the start's outline does not cross itself, so that a barrier can keep it so.
IslandMap minimize(Problem& problem, const std::vector<double>& start, bool may_repeat, const MapOptions& options,
                   const Task& task) {
  Minimizer free(problem, start, false, options, task);
  free.run();
  const bool overlaps = problem.outline().covers_twice(free.map(), kTouchingDepth, task);
  // A barrier only adds to the energy.
  const bool is_hopeless = problem.energy().energy(free.map()) > options.worse_than;
  const bool repeats = overlaps && !is_hopeless && may_repeat && options.keep_apart;
  std::vector<double> other_start = repeats ? free.last_apart() : std::vector<double>{};
  if (repeats && other_start.empty()) other_start = parted(problem, start, task);
  if (other_start.empty()) return result_of(problem, free, 0, overlaps);
  Minimizer apart(problem, other_start, true, options, task);
  apart.run();
  return result_of(problem, apart, free.steps(), problem.outline().covers_twice(apart.map(), kTouchingDepth, task));
}

}  // namespace

IslandMap map_island(const Island& island, std::span<const Vector> points, const MapOptions& options,
                     const Task& task) {
  Problem problem(island, points, task);
  std::vector<double> start = problem.projection(task);
  if (start.empty()) start = problem.tutte(task);
  if (start.empty()) return {.uvs = {}, .energy = kInfinity, .overlaps = false, .steps = 0};
  return minimize(problem, start, true, options, task);
}

IslandMap continue_map(const Island& island, std::span<const Vector> points, std::span<const Point2> uvs,
                       const MapOptions& options, const Task& task) {
  if (uvs.size() != island.vertices.size()) {
    throw InvalidInput("the start of an island has " + std::to_string(uvs.size()) + " UVs: there are " +
                       std::to_string(island.vertices.size()) + " vertices");
  }
  Problem problem(island, points, task);
  std::vector<double> start;
  start.reserve(2 * uvs.size());
  for (const Point2& uv : uvs) {
    for (const double value : uv) start.push_back(value / problem.unit());
  }
  if (!std::isfinite(problem.energy().energy(start))) {
    throw InvalidInput("the start of an island has a triangle that is flipped or has no area");
  }
  return minimize(problem, start, !problem.outline().covers_twice(start, kTouchingDepth, task), options, task);
}

double mean_energy(const Island& island, std::span<const Vector> points, std::span<const Point2> uvs) {
  const MeasuredMap measured(island, points, uvs);
  return measured.energy.energy(measured.map);
}

std::vector<double> triangle_energies(const Island& island, std::span<const Vector> points,
                                      std::span<const Point2> uvs) {
  const MeasuredMap measured(island, points, uvs);
  return measured.energy.energies(measured.map);
}

}  // namespace seamwire::detail
