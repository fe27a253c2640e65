// SPDX-License-Identifier: GPL-3.0-or-later
#include "seamwire_uv/parts/part_finder.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <iterator>
#include <map>
#include <numeric>
#include <optional>
#include <queue>
#include <span>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "detail/drop_repeats.hpp"
#include "detail/index.hpp"
#include "detail/infinity.hpp"
#include "detail/poll.hpp"
#include "detail/rounded.hpp"
#include "detail/text.hpp"
#include "graph/disjoint_sets.hpp"
#include "parts/figure.hpp"
#include "parts/limbs.hpp"
#include "parts/nets.hpp"
#include "parts/panels.hpp"
#include "parts/parting_cuts.hpp"
#include "parts/parts_between.hpp"
#include "parts/smoothed.hpp"
#include "prices/border_odds.hpp"
#include "prices/edge_prices.hpp"
#include "prices/plan_mesh.hpp"
#include "seamwire/errors.hpp"
#include "seamwire/task.hpp"
#include "seamwire_uv/parts/scanned_edges.hpp"
#include "slits/slit_plan.hpp"
#include "surface/real_edges.hpp"
#include "tuning/constants.hpp"

namespace seamwire {

using namespace detail;

namespace detail {

/// A region. Lengths are in diagonals of the piece of surface in which it lies, areas in squared diagonals.
struct Region {
  double area = 0.0;
  double least_area = 0.0;  ///< a smaller region joins a neighbor, unless a sharp rim encloses it
  std::int32_t image = -1;  ///< the region on the other side of a mirror plane; -1 if it has none
};

}  // namespace detail

namespace {

/// What lies between two regions, in the same units.
struct Link {
  double gain = 0.0;   ///< the log odds of the border times its length: what keeping it gains, and joining loses
  double sharp = 0.0;  ///< the same by the shape of the border alone, also where front and back meet
  double length = 0.0;
  double bend = 0.0;     ///< how many degrees the surface bends there, times the length
  bool is_kept = false;  ///< whether small regions must not join across it

  void add(const Link& other) {
    gain += other.gain;
    sharp += other.sharp;
    length += other.length;
    bend += other.bend;
    is_kept = is_kept || other.is_kept;
  }
};

struct RegionBorder {
  std::int32_t one = -1, other = -1;
  Link link;
};

/// container.clear() with looks at the task: freeing a million vectors or maps takes a while.
template <class Container>
void polled_clear(Container& container, const Task& task) {
  Poll poll(task);
  while (!container.empty()) {
    poll.next();
    container.erase(std::prev(container.end()));
  }
}

class Joining {
 public:
  Joining(std::span<const Region> regions, std::span<const RegionBorder> borders, const Task& task)
      : regions_(regions.begin(), regions.end()),
        parents_(regions.size()),
        links_(regions.size()),
        task_(task),
        poll_(task, 0.0, 1.0, borders.size() + 5 * regions.size(), Poll::kFewSteps) {
    std::iota(parents_.begin(), parents_.end(), 0);
    for (const RegionBorder& border : borders) {
      poll_.next();
      for (const auto& [a, b] : {std::pair(border.one, border.other), std::pair(border.other, border.one)}) {
        links_[a][b].add(border.link);
      }
    }
  }

  std::vector<std::int32_t> run() {
    join_gainful();
    join_small();
    std::vector<std::int32_t> found;
    for (std::size_t r = 0; r < parents_.size(); ++r) {
      poll_.next();
      found.push_back(root(static_cast<std::int32_t>(r)));
    }
    polled_clear(links_, task_);
    return found;
  }

 private:
  std::int32_t root(std::int32_t r) {
    while (parents_[r] != r) r = parents_[r] = parents_[parents_[r]];
    return r;
  }

  /// What joining two regions loses. It saves the price of a region.
  double loss(std::int32_t a, std::int32_t b, const Link& link) const {
    const bool is_enclosed = links_[a].size() == 1 || links_[b].size() == 1;
    return link.gain - (is_enclosed ? tuning::kEnclosedPrice : tuning::kPartPrice);
  }

  void offer(std::int32_t a, std::int32_t b, const Link& link) {
    const double lost = loss(a, b, link);
    if (lost < 0.0) open_.emplace(lost, std::min(a, b), std::max(a, b));
  }

  void join_gainful() {
    for (std::int32_t a = 0; index(a) < links_.size(); ++a) {
      poll_.next();
      for (const auto& [b, link] : links_[a]) {
        if (a < b) offer(a, b, link);
      }
    }
    while (!open_.empty()) {
      poll_.next();
      const auto [lost, a, b] = open_.top();
      open_.pop();
      if (parents_[a] != a || parents_[b] != b) continue;
      const auto found = links_[a].find(b);
      if (found == links_[a].end()) continue;
      if (loss(a, b, found->second) == lost) {
        join_both(a, b);
      } else if (found->second.gain - tuning::kPartPrice == lost) {
        offer(a, b, found->second);  // one of them has become enclosed
      }
    }
  }

  /// Whether two regions are of one size, as mirror images are.
  bool are_alike(std::int32_t one, std::int32_t other) const {
    return std::abs(regions_[one].area - regions_[other].area) <= tuning::kAlikeAreas * regions_[one].area;
  }

  /// Joins two regions, and their mirror images.
  void join_both(std::int32_t a, std::int32_t b) {
    const std::int32_t a_image = image(a), b_image = image(b);
    const bool are_mirrored = a_image >= 0 && b_image >= 0 && are_alike(a, a_image) && are_alike(b, b_image);
    std::int32_t joined = join(a, b);
    if (!are_mirrored) return;
    const std::int32_t one = root(a_image), other = root(b_image);
    if (one != other && links_[one].contains(other)) {
      const std::int32_t mirrored = join(one, other);
      joined = root(joined);
      regions_[joined].image = mirrored;
      regions_[mirrored].image = joined;
    } else if (one == other) {
      regions_[joined].image = one;
      regions_[one].image = joined;
    }
  }
  std::int32_t image(std::int32_t r) { return regions_[r].image < 0 ? -1 : root(regions_[r].image); }

  std::int32_t join(std::int32_t a, std::int32_t b) {
    if (links_[a].size() < links_[b].size()) std::swap(a, b);
    parents_[b] = a;
    regions_[a].area += regions_[b].area;
    for (const auto& [c, link] : links_[b]) {
      if (c == a) continue;
      links_[c].erase(b);
      Link& sum = links_[a][c];
      sum.add(link);
      links_[c][a] = sum;
      offer(a, c, sum);
    }
    links_[a].erase(b);
    links_[b] = {};
    return a;
  }

  /// Whether a region is too small to stay, or a step of a chamfer.
  bool is_small(std::int32_t r) const {
    Link rim;
    for (const auto& [c, link] : links_[r]) rim.add(link);
    if (!(rim.length > 0.0)) return false;
    if (regions_[r].area < regions_[r].least_area && rim.sharp < tuning::kSharpRim * rim.length) return true;
    const bool is_step = rim.bend > tuning::kLeastStep * rim.length && rim.bend < tuning::kMostStep * rim.length;
    return is_step && 2.0 * regions_[r].area < tuning::kLeastPartWidth * rim.length;
  }

  /// The neighbor that a small region joins: the one with the least likely border.
  std::int32_t neighbor_of_small(std::int32_t r) const {
    if (!is_small(r)) return -1;
    std::int32_t best = -1;
    std::tuple<double, double> least;
    for (const auto& [c, link] : links_[r]) {
      if (link.is_kept || !(link.length > 0.0)) continue;
      const std::tuple own(link.gain / link.length, -regions_[c].area);
      if (best < 0 || own < least || (own == least && c < best)) {
        best = c;
        least = own;
      }
    }
    return best;
  }

  void join_small() {
    using Small = std::pair<double, std::int32_t>;
    std::priority_queue<Small, std::vector<Small>, std::greater<>> small;
    const auto add = [&](std::int32_t r) {
      if (neighbor_of_small(r) >= 0) small.emplace(regions_[r].area, r);
    };
    for (std::int32_t r = 0; index(r) < parents_.size(); ++r) {
      poll_.next();
      if (parents_[r] == r) add(r);
    }
    while (!small.empty()) {
      poll_.next();
      const auto [area, r] = small.top();
      small.pop();
      if (parents_[r] != r || regions_[r].area != area) continue;
      const std::int32_t neighbor = neighbor_of_small(r);
      if (neighbor < 0) continue;
      join_both(r, neighbor);
      const std::int32_t joined = root(r), mirrored = image(joined);
      add(joined);
      if (mirrored >= 0 && mirrored != joined) add(mirrored);
    }
  }

  std::vector<Region> regions_;
  std::vector<std::int32_t> parents_;
  std::vector<std::map<std::int32_t, Link>> links_;
  const Task& task_;
  Poll poll_;
  using Offer = std::tuple<double, std::int32_t, std::int32_t>;
  std::priority_queue<Offer, std::vector<Offer>, std::greater<>> open_;
};

/// Joins regions, always the two that gain the most, as long as that gains anything, then small and narrow ones.
/// Returns for each region the joined region in which it is, named after one of them. Throws Cancelled.
std::vector<std::int32_t> joined_regions(std::span<const Region> regions, std::span<const RegionBorder> borders,
                                         const Task& task) {
  return Joining(regions, borders, task).run();
}

constexpr double kDefaultAmount = 0.5;
constexpr double kEditOdds = 1e6;               // of an edge that somebody has kept or dropped
constexpr double kJoined = 0.3, kParted = 0.9;  // of the work of find()

/// The constant that an amount of parts adds to all log odds.
double bias_of(double amount) {
  if (amount >= 0.5) return 2.0 * (amount - 0.5) * tuning::kBiasToSharp;
  return tuning::kBiasToOne * std::log(amount / (1.0 - amount));
}

/// The most that joining two limbs costs for an amount of limbs. `is_figure`: whether the shape has chosen limbs.
double most_cost(double amount, bool is_figure) {
  if (!(amount > 0.0)) return kInfinity;
  return is_figure ? tuning::kLimbCost * std::pow(tuning::kFigureRange, 1.0 - amount)
                   : tuning::kLimbCost * std::pow(tuning::kLimbRange, 1.0 - 2.0 * amount);
}

/// The mirror image of each polygon, by the images of its vertices; -1 without an image.
std::vector<std::int32_t> images_of(const PlanMesh& mesh, const Polygons& polygons, const Reflection& reflection,
                                    const Task& task) {
  Poll poll(task);
  std::vector<std::vector<std::int32_t>> corners(polygons.count);
  for (std::size_t f = 0; f < mesh.face_count(); ++f) {
    poll.next();
    std::vector<std::int32_t>& own = corners[polygons.of_face[f]];
    own.insert(own.end(), mesh.triangles[f].begin(), mesh.triangles[f].end());
  }
  std::map<std::vector<std::int32_t>, std::int32_t> by_corners;
  for (std::size_t p = 0; p < corners.size(); ++p) {
    poll.next();
    std::vector<std::int32_t>& own = corners[p];
    std::ranges::sort(own);
    drop_repeats(own);
    by_corners.emplace(own, static_cast<std::int32_t>(p));
  }
  std::vector<std::int32_t> images;
  for (std::vector<std::int32_t> own : corners) {
    poll.next();
    for (std::int32_t& v : own) v = reflection.images[v];
    std::ranges::sort(own);
    const auto found = by_corners.find(own);
    images.push_back(found == by_corners.end() ? -1 : found->second);
  }
  for (std::size_t p = 0; p < images.size(); ++p) {
    if (images[p] >= 0 && index(images[images[p]]) != p) images[p] = -1;
  }
  polled_clear(by_corners, task);
  polled_clear(corners, task);
  return images;
}

/// Each triangle as a separate polygon.
Polygons triangles_of(const PlanMesh& mesh) {
  Polygons triangles;
  triangles.count = mesh.face_count();
  triangles.of_face.resize(triangles.count);
  std::iota(triangles.of_face.begin(), triangles.of_face.end(), 0);
  return triangles;
}

/// Gives triangles on the lower side of a mirror plane the labels of their images. The image of label k is k plus the
/// number of triangles. If a label touches its image, the two become one.
void mirror_labels(const PlanMesh& mesh, const Reflection& reflection, std::vector<std::int32_t>& of_face,
                   const Task& task) {
  const auto shift = static_cast<std::int32_t>(of_face.size());
  const std::vector<std::int32_t> images = images_of(mesh, triangles_of(mesh), reflection, task);
  const std::vector<std::int32_t> before = of_face;
  Poll poll(task);
  std::vector<std::int32_t> known;  // in the order in which lower triangles without an image are reached
  for (std::int32_t f = 0; f < shift; ++f) {
    poll.next();
    int side = 0;
    for (const std::int32_t v : mesh.triangles[f]) side += reflection.sides[v];
    if (side >= 0) continue;
    of_face[f] = images[f] >= 0 ? before[images[f]] + shift : -1;
  }
  for (std::int32_t f = 0; f < shift; ++f) {
    if (of_face[f] >= 0) known.push_back(f);
  }
  for (std::size_t i = 0; i < known.size(); ++i) {
    poll.next();
    for (std::int32_t h = 3 * known[i]; h < 3 * known[i] + 3; ++h) {
      const std::int32_t twin = mesh.twins[h];
      if (twin < 0 || of_face[twin / 3] >= 0) continue;
      of_face[twin / 3] = of_face[known[i]];
      known.push_back(twin / 3);
    }
  }
  for (std::int32_t f = 0; f < shift; ++f) {
    if (of_face[f] < 0) of_face[f] = before[f];  // a piece without images
  }
  DisjointSets polygons(of_face.size());  // parts have whole polygons
  for (std::size_t e = 0; e < mesh.edge_count(); ++e) {
    const std::int32_t h = mesh.half_edge_of[e], twin = mesh.twins[h];
    if (mesh.is_real[e] == 0 && twin >= 0) polygons.join(h / 3, twin / 3);
  }
  for (std::int32_t f = 0; f < shift; ++f) of_face[f] = of_face[polygons.find(f)];
  DisjointSets sets(2 * of_face.size());
  for (std::int32_t h = 0; h < 3 * shift; ++h) {
    const std::int32_t twin = mesh.twins[h];
    if (twin >= 0 && of_face[h / 3] == of_face[twin / 3] + shift) sets.join(of_face[h / 3], of_face[twin / 3]);
  }
  for (std::int32_t& label : of_face) label = sets.find(label);
}

/// Marks the edge inside each pair of triangles that are mirrored, but not as a pair.
std::vector<std::uint8_t> unmirrored_pairs(const PlanMesh& mesh, const Polygons& polygons, const Reflection& reflection,
                                           const Task& task) {
  const std::vector<std::int32_t> images = images_of(mesh, polygons, reflection, task);
  const std::vector<std::int32_t> triangle_images = images_of(mesh, triangles_of(mesh), reflection, task);
  const Poll poll(task);
  std::vector<std::uint8_t> is_found(mesh.edge_count(), 0);
  for (std::size_t e = 0; e < is_found.size(); ++e) {
    poll.at(e);
    const std::int32_t h = mesh.half_edge_of[e], twin = mesh.twins[h];
    if (polygons.is_diagonal[e] == 0 || images[polygons.of_face[h / 3]] >= 0) continue;
    is_found[e] = triangle_images[h / 3] >= 0 && triangle_images[twin / 3] >= 0 ? 1 : 0;
  }
  return is_found;
}

}  // namespace

struct PartFinder::Impl {
  std::shared_ptr<const Surface> surface;
  PartOptions options;
  SlitProblem problem;  // with the existing seams; its pieces are found only to cut a part in two
  Polygons polygons;
  EdgeBends bends;
  PieceSizes sizes;
  std::vector<double> odds;             // of each edge
  std::vector<std::uint8_t> is_marked;  // the same: 1 where an artist expects a border
  std::vector<Region> regions;          // of each polygon
  std::optional<Limbs> limbs;
  bool may_smooth = true;
  std::unique_ptr<const Impl> smooth;                 // finds the limbs of a coarse mesh on its smoothed shape
  std::vector<std::int32_t> smooth_polygons;          // the polygon of each triangle there
  std::vector<std::uint8_t> is_panelled, is_between;  // pieces with panels; edges between front and back; or empty
  std::vector<double> open;  // of each vertex, how visible it is; only for a shape that has limbs

  void prepare(const Task& task);
  double odds_of(std::int32_t edge) const;  // with those of front and back
  bool has_limbs() const { return limbs || smooth; }
  bool has_figure(std::span<const FaceFrame> frames, const Task& task) const;
  void smooth_figure(std::span<const FaceFrame> frames, const Task& task);
  void divide_panels(std::span<const FaceFrame> frames, const Task& task);
  std::vector<Region> regions_of(const Polygons& own, const Task& task) const;
  std::vector<std::uint8_t> marked(const std::vector<Edge>& edges, const char* name, const Task& task) const;
  std::vector<std::uint8_t> telling_marks(const Task& task) const;
  std::vector<std::uint8_t> edited(const std::vector<Edge>& edges, const char* name, const Task& task) const;
  std::vector<std::int32_t> joined(double amount, std::span<const std::uint8_t> is_kept, const PartEdits& edits,
                                   const Task& task) const;
  std::vector<std::uint8_t> folds(std::span<const std::int32_t> region_of, double amount,
                                  std::span<const std::uint8_t> is_kept, const Task& task) const;
  std::vector<std::int32_t> smooth_limbs(double amount, const Task& task) const;
  std::vector<std::int32_t> joined_limbs(double amount, const PartEdits& edits, const Task& task) const;
  /// Edges of the mesh: 1 for each.
  struct Borders {
    std::vector<std::uint8_t> is_border;  ///< borders between parts, and existing seams
    std::vector<std::uint8_t> is_rim;     ///< borders at rims, which may lie inside of a net
  };
  Borders borders(double amount, const PartEdits& edits, const Task& task) const;
};

void PartFinder::Impl::prepare(const Task& task) {
  if (options.mirror < -1 || options.mirror > 2) {
    throw InvalidInput("mirror is " + std::to_string(options.mirror) + ", not an axis from 0 to 2, or -1");
  }
  if (options.front && !(options.front->allFinite() && !options.front->isZero(0.0))) {
    throw InvalidInput("front is not a direction: it has no length, or is not finite");
  }
  problem.mesh = std::make_shared<const PlanMesh>(plan_mesh(*surface, task));
  const PlanMesh& mesh = *problem.mesh;
  problem.is_seam = marked(options.seams, "seams", task);
  if (options.mirror >= 0) problem.reflection = find_reflection(mesh, options.mirror, part_of(task, 0.0, 0.2));
  const std::vector<FaceFrame> frames = face_frames(mesh, task);
  sizes = measure_pieces(mesh, frames, task);
  is_marked = telling_marks(task);
  std::vector<double> size_at(mesh.vertex_count(), 0.0);  // the root of the area of each vertex's piece
  const Poll poll(task);
  for (std::size_t f = 0; f < mesh.face_count(); ++f) {
    poll.at(f);
    for (const std::int32_t v : mesh.triangles[f]) size_at[v] = std::sqrt(sizes.of_piece[sizes.pieces.of_face[f]].area);
  }
  const Visibility visibility =
      find_visibility(mesh, std::nullopt, part_of(task, 0.2, 0.8), size_at, tuning::kMostLooks);
  std::vector<std::uint8_t> is_border = problem.is_seam;
  for (std::size_t e = 0; e < is_border.size(); ++e) is_border[e] |= is_marked[e];
  polygons = find_polygons(mesh, is_border, task);
  if (problem.reflection) {
    take_apart(mesh, unmirrored_pairs(mesh, polygons, *problem.reflection, task), polygons, task);
  }
  bends = bends_over_edges(mesh, frames, polygons, sizes, task);
  odds = border_odds(mesh, polygons, sizes, bends, visibility.ambient, is_marked, problem.mirror(), tuning::kOnPlane,
                     task);
  regions = regions_of(polygons, task);
  if (options.by == PartsBy::kShape) {
    if (!options.is_scan) options.is_scan = has_scanned_edges(mesh.points, mesh.triangles, polygons.of_face);
    smooth_figure(frames, part_of(task, 0.8, 0.85));
  }
  if (options.by == PartsBy::kLimbs ||
      (options.by == PartsBy::kShape && !smooth && has_figure(frames, part_of(task, 0.85, 0.85)))) {
    limbs.emplace(mesh, frames, sizes.pieces, part_of(task, 0.85, 0.95));
    if (options.by == PartsBy::kShape) {
      const Visibility seen =
          options.front ? find_visibility(mesh, options.front, part_of(task, 0.95, 0.95), size_at, tuning::kMostLooks)
                        : visibility;
      open = openness(mesh, seen, problem.reflection, frames);
    }
  }
  task.check(0.95);
  if (options.by == PartsBy::kPanels || (options.by == PartsBy::kShape && !has_limbs())) {
    divide_panels(frames, part_of(task, 0.95, 1.0));
  }
  for (std::int32_t e = 0; index(e) < mesh.edge_count(); ++e) {
    poll.at(index(e));
    problem.prices.of_edge.push_back(mesh.is_real[e] == 0 ? kInfinity : price_of_cut(odds_of(e)) * mesh.lengths[e]);
  }
}

/// Whether the shape asks for limbs.
bool PartFinder::Impl::has_figure(std::span<const FaceFrame> frames, const Task& task) const {
  const PlanMesh& mesh = *problem.mesh;
  if (!is_round(mesh, frames, sizes, task)) return false;
  if (*options.is_scan || mesh.face_count() >= tuning::kLeastSculpt) return true;
  if (std::ranges::count(find_garments(mesh, polygons, sizes, bends, task), 1) > 0) return false;
  const std::vector<std::uint8_t> none(mesh.edge_count(), 0);
  return is_soft(mesh, frames, sizes, bends, joined(kDefaultAmount, none, {}, task), task);
}

/// Finds limbs on the smoothed shape of a coarse mesh of quads if that shape is a figure. All edges of a coarse mesh
/// are sharp, so they do not tell which features matter. A mesh of triangles is what its author sees.
void PartFinder::Impl::smooth_figure(std::span<const FaceFrame> frames, const Task& task) {
  const PlanMesh& mesh = *problem.mesh;
  if (!may_smooth || *options.is_scan || polygons.count > tuning::kMostCoarse || !is_round(mesh, frames, sizes, task))
    return;
  std::vector<std::uint8_t> is_triangle(polygons.count, 1);
  for (std::size_t e = 0; e < mesh.edge_count(); ++e) {
    if (mesh.is_real[e] == 0) is_triangle[polygons.of_face[mesh.half_edge_of[e] / 3]] = 0;
  }
  const auto triangles = static_cast<double>(std::ranges::count(is_triangle, 1));
  if (triangles > tuning::kMostTriangular * static_cast<double>(polygons.count)) return;
  Smoothed shape = smoothed(mesh, polygons, part_of(task, 0.0, 0.1));
  auto found = std::make_unique<Impl>();
  found->surface = std::move(shape.surface);
  found->may_smooth = false;
  found->options = {.by = PartsBy::kShape, .is_scan = false, .front = options.front, .mirror = options.mirror};
  found->prepare(part_of(task, 0.1, 1.0));
  if (!found->limbs) return;
  smooth = std::move(found);
  smooth_polygons = std::move(shape.polygons);
}

/// Makes borders of the edges between front and back.
void PartFinder::Impl::divide_panels(std::span<const FaceFrame> frames, const Task& task) {
  const PlanMesh& mesh = *problem.mesh;
  const std::vector<std::uint8_t> is_chosen = options.by == PartsBy::kPanels
                                                  ? std::vector<std::uint8_t>(sizes.of_piece.size(), 1)
                                                  : find_garments(mesh, polygons, sizes, bends, task);
  std::vector<std::int32_t> images;
  for (const Region& region : regions) images.push_back(region.image);
  if (options.by == PartsBy::kShape && std::ranges::count(is_chosen, 1) == 0) return;
  const std::optional<int> mirror = problem.reflection ? std::optional(problem.reflection->axis) : std::nullopt;
  // A viewer is anywhere, but the front of clothes is where they are thin.
  const std::optional<Vector> front = options.by == PartsBy::kPanels ? options.front : std::nullopt;
  is_between =
      find_panels({mesh, polygons, sizes, frames, odds, problem.is_seam, images, mirror, front, is_chosen}, task);
  is_panelled = is_chosen;
  regions = regions_of(polygons, task);
}

double PartFinder::Impl::odds_of(std::int32_t edge) const {
  const bool is_panel = !is_between.empty() && is_between[edge] != 0;
  return is_panel ? std::max(odds[edge], 0.0) + tuning::kMostOdds : odds[edge];
}

/// A region for each polygon.
std::vector<Region> PartFinder::Impl::regions_of(const Polygons& own, const Task& task) const {
  const PlanMesh& mesh = *problem.mesh;
  const std::vector<FaceFrame> frames = face_frames(mesh, task);
  const Poll poll(task);
  std::vector<Region> found(own.count);
  for (std::size_t f = 0; f < mesh.face_count(); ++f) {
    poll.at(f);
    const auto& [diagonal, area] = sizes.of_piece[sizes.pieces.of_face[f]];
    if (!(diagonal > 0.0)) continue;
    Region& region = found[own.of_face[f]];
    region.area += rounded(frames[f].area) / (diagonal * diagonal);
    const bool has_panels = !is_panelled.empty() && is_panelled[sizes.pieces.of_face[f]] != 0;
    region.least_area = (has_panels ? tuning::kLeastOfPanels : tuning::kLeastPart) * area / (diagonal * diagonal);
  }
  if (!problem.reflection) return found;
  const std::vector<std::int32_t> images = images_of(mesh, own, *problem.reflection, task);
  for (std::size_t p = 0; p < images.size(); ++p) found[p].image = images[p];
  return found;
}

/// Marks edges of the mesh.
std::vector<std::uint8_t> PartFinder::Impl::marked(const std::vector<Edge>& edges, const char* name,
                                                   const Task& task) const {
  for (const Edge& edge : edges) {
    for (const std::int32_t v : edge) check_index(v, surface->vertex_count(), std::string(name) + ": vertex");
  }
  return marked_edges(*problem.mesh, edges, task);
}

/// The marked edges of the mesh, without kinds of marks on pieces where nearly all edges have them.
std::vector<std::uint8_t> PartFinder::Impl::telling_marks(const Task& task) const {
  const PlanMesh& mesh = *problem.mesh;
  const Poll poll(task);
  const auto is_inner = [&](std::int32_t e) { return mesh.is_real[e] != 0 && !mesh.is_boundary(e); };
  std::vector<std::uint8_t> found(mesh.edge_count(), 0);
  for (const std::vector<Edge>& kind : options.marked) {
    const std::vector<std::uint8_t> is_marked = marked(kind, "marked", task);
    std::vector<double> with(sizes.of_piece.size(), 0.0), all = with;
    for (std::int32_t e = 0; index(e) < mesh.edge_count(); ++e) {
      poll.at(index(e));
      if (!is_inner(e)) continue;
      all[sizes.piece_of(mesh, e)] += 1.0;
      with[sizes.piece_of(mesh, e)] += is_marked[e] != 0 ? 1.0 : 0.0;
    }
    for (std::int32_t e = 0; index(e) < mesh.edge_count(); ++e) {
      poll.at(index(e));
      const std::int32_t piece = sizes.piece_of(mesh, e);
      if (is_marked[e] != 0 && with[piece] <= tuning::kMarkedEverywhere * all[piece]) found[e] = 1;
    }
  }
  return found;
}

/// Marks edges of the mesh and their mirror images.
std::vector<std::uint8_t> PartFinder::Impl::edited(const std::vector<Edge>& edges, const char* name,
                                                   const Task& task) const {
  const std::vector<std::uint8_t> own = marked(edges, name, task);
  if (!problem.reflection) return own;
  std::vector<std::uint8_t> both = own;
  const Poll poll(task);
  for (std::int32_t e = 0; index(e) < own.size(); ++e) {
    poll.at(index(e));
    const std::int32_t image = own[e] != 0 ? image_of_edge(*problem.mesh, *problem.reflection, e) : -1;
    if (image >= 0) both[image] = 1;
  }
  return both;
}

/// The region of each triangle.
std::vector<std::int32_t> PartFinder::Impl::joined(double amount, std::span<const std::uint8_t> is_kept,
                                                   const PartEdits& edits, const Task& task) const {
  const PlanMesh& mesh = *problem.mesh;
  const std::vector<std::uint8_t> is_dropped = edited(edits.dropped, "dropped", task);
  // Two triangles with a kept edge between them are no quad.
  Polygons own_polygons = polygons;
  const bool is_apart = take_apart(mesh, is_kept, own_polygons, task);
  const Poll poll(task);
  const double bias = amount > 0.0 ? bias_of(amount) : -kInfinity;
  std::vector<RegionBorder> found;
  found.reserve(mesh.edge_count());
  for (std::int32_t e = 0; index(e) < mesh.edge_count(); ++e) {
    const std::int32_t h = mesh.half_edge_of[e], twin = mesh.twins[h];
    poll.at(index(e));
    if (twin < 0 || problem.is_seam[e] != 0 || own_polygons.is_diagonal[e] != 0) continue;
    double own = std::clamp(odds_of(e) + bias, -tuning::kMostOdds, tuning::kMostOdds);
    double sharp = std::clamp(odds[e] + bias, -tuning::kMostOdds, tuning::kMostOdds);
    if (is_dropped[e] != 0) own = sharp = -kEditOdds;
    if (is_kept[e] != 0) own = sharp = kEditOdds;
    const double diagonal = sizes.of_piece[sizes.piece_of(mesh, e)].diagonal;
    const double length = diagonal > 0.0 ? mesh.lengths[e] / diagonal : 0.0;
    found.push_back({own_polygons.of_face[h / 3],
                     own_polygons.of_face[twin / 3],
                     {own * length, sharp * length, length, std::abs(bends.own[e]) * length, is_kept[e] != 0}});
  }
  const std::vector<std::int32_t> of_polygon =
      joined_regions(is_apart ? regions_of(own_polygons, task) : regions, found, task);
  std::vector<std::int32_t> of_face;
  for (const std::int32_t p : own_polygons.of_face) of_face.push_back(of_polygon[p]);
  return of_face;
}

/// Marks the edges over which regions of a net stay together.
std::vector<std::uint8_t> PartFinder::Impl::folds(std::span<const std::int32_t> region_of, double amount,
                                                  std::span<const std::uint8_t> is_kept, const Task& task) const {
  const PlanMesh& mesh = *problem.mesh;
  const double bias = amount > 0.0 ? bias_of(amount) : -kInfinity;
  std::vector<std::uint8_t> may_fold, is_parting;
  for (std::size_t e = 0; e < mesh.edge_count(); ++e) {
    const double own = odds[e] + bias - (is_marked[e] != 0 ? tuning::kMarked : 0.0);
    may_fold.push_back(problem.is_seam[e] == 0 && own < tuning::kMostOdds ? 1 : 0);
    const bool is_panel = !is_between.empty() && is_between[e] != 0;
    is_parting.push_back(is_kept[e] != 0 || is_marked[e] != 0 || is_panel ? 1 : 0);
  }
  std::vector<double> diagonals;
  for (const PieceSize& size : sizes.of_piece) diagonals.push_back(size.diagonal);
  return find_folds({.mesh = mesh,
                     .pieces = sizes.pieces,
                     .diagonals = diagonals,
                     .region_of = region_of,
                     .may_fold = may_fold,
                     .is_parting = is_parting,
                     .reflection = problem.mirror()},
                    task);
}

/// The limb of each triangle by the smoothed shape: that of the largest share of its polygon.
std::vector<std::int32_t> PartFinder::Impl::smooth_limbs(double amount, const Task& task) const {
  const PlanMesh& shape = *smooth->problem.mesh;
  const std::vector<std::int32_t> limb_of = smooth->joined_limbs(amount, {}, task);
  std::vector<std::map<std::int32_t, double>> areas(polygons.count);  // by limb
  for (std::size_t f = 0; f < shape.face_count(); ++f) {
    areas[smooth_polygons[shape.faces[f]]][limb_of[f]] += face_frame(shape, shape.triangles[f]).area;
  }
  std::map<std::int32_t, std::int32_t> first_of;  // a triangle of each limb, which names it
  std::vector<std::int32_t> found;
  for (std::int32_t f = 0; index(f) < polygons.of_face.size(); ++f) {
    const auto& own = areas[polygons.of_face[f]];
    const auto most = std::ranges::max_element(own, {}, [](const auto& item) { return item.second; });
    found.push_back(first_of.try_emplace(most == own.end() ? -1 : most->first, f).first->second);
  }
  return found;
}

/// The limb of each triangle, by any numbers.
std::vector<std::int32_t> PartFinder::Impl::joined_limbs(double amount, const PartEdits& edits,
                                                         const Task& task) const {
  const PlanMesh& mesh = *problem.mesh;
  const std::vector<std::uint8_t> is_dropped = edited(edits.dropped, "dropped", task);
  std::vector<std::int32_t> of_face =
      limbs ? limbs->find(most_cost(amount, !open.empty()), task) : smooth_limbs(amount, task);
  if (problem.reflection && problem.reflection->is_exact) mirror_labels(mesh, *problem.reflection, of_face, task);
  if (!open.empty()) join_exposed(mesh, open, of_face, task);
  DisjointSets sets(2 * of_face.size());
  for (std::size_t e = 0; e < is_dropped.size(); ++e) {
    const std::int32_t h = mesh.half_edge_of[e], twin = mesh.twins[h];
    if (is_dropped[e] != 0 && twin >= 0) sets.join(of_face[h / 3], of_face[twin / 3]);
  }
  for (std::int32_t& label : of_face) label = sets.find(label);
  return of_face;
}

PartFinder::Impl::Borders PartFinder::Impl::borders(double amount, const PartEdits& edits, const Task& task) const {
  const PlanMesh& mesh = *problem.mesh;
  const Task joining = part_of(task, 0.0, kJoined);
  const std::vector<std::uint8_t> is_kept = edited(edits.kept, "kept", task);
  const std::vector<std::int32_t> region_of =
      has_limbs() ? joined_limbs(amount, edits, joining) : joined(amount, is_kept, edits, joining);
  std::vector<std::uint8_t> is_fold(mesh.edge_count(), 0);
  if (!has_limbs() && options.has_nets) is_fold = folds(region_of, amount, is_kept, part_of(task, 0.0, kJoined));
  Borders found{problem.is_seam, std::vector<std::uint8_t>(mesh.edge_count(), 0)};
  std::vector<std::uint8_t>& is_border = found.is_border;
  const Poll poll(task);
  for (std::int32_t e = 0; index(e) < mesh.edge_count(); ++e) {
    poll.at(index(e));
    const std::int32_t h = mesh.half_edge_of[e], twin = mesh.twins[h];
    if (twin < 0) continue;
    found.is_rim[e] = region_of[h / 3] != region_of[twin / 3] && is_fold[e] == 0 ? 1 : 0;
    if (is_kept[e] != 0 || found.is_rim[e] != 0) is_border[e] = 1;
  }
  if (edits.parted.empty()) return found;
  SlitProblem parted = problem;
  const std::vector<std::uint8_t> is_dropped = edited(edits.dropped, "dropped", task);
  for (std::size_t e = 0; e < is_dropped.size(); ++e) {
    if (is_dropped[e] != 0) parted.prices.of_edge[e] = kInfinity;
  }
  const double step = (kParted - kJoined) / static_cast<double>(edits.parted.size());
  double done = kJoined;
  for (const std::int32_t face : edits.parted) {
    const Task cutting = part_of(task, done, done + step);
    check_index(face, surface->face_count(), "parted", "triangles");
    const auto own = std::ranges::find(mesh.faces, face);
    if (own == mesh.faces.end()) continue;
    parted.is_seam = is_border;
    find_pieces_of(parted, task);
    std::vector<std::uint8_t> is_cut(mesh.edge_count(), 0);
    mark_half(parted, parted.pieces.of_face[own - mesh.faces.begin()], is_cut, cutting);
    for (std::size_t e = 0; e < is_cut.size(); ++e) is_border[e] |= is_cut[e];
    done += step;
  }
  return found;
}

PartsBy PartFinder::by() const {
  if (impl_->has_limbs()) return PartsBy::kLimbs;
  return !impl_->is_panelled.empty() ? PartsBy::kPanels : PartsBy::kRims;
}

PartFinder::PartFinder(std::shared_ptr<const Surface> surface, const PartOptions& options, const Task& task) {
  if (!surface) throw InvalidInput("surface is null");
  auto impl = std::make_shared<Impl>();
  impl->surface = std::move(surface);
  impl->options = options;
  impl->prepare(RisingProgress(task).task());
  impl_ = std::move(impl);
}

Parts PartFinder::find(double amount, const PartEdits& edits, const Task& task) const {
  if (!(amount >= 0.0 && amount <= 1.0)) {
    throw InvalidInput("amount is " + text(amount) + ", not from 0 to 1");
  }
  const RisingProgress rising(task);
  const Task& own = rising.task();
  const Impl& impl = *impl_;
  const std::vector<std::uint8_t>& is_seam = impl.problem.is_seam;
  auto [is_border, is_rim] = impl.borders(amount, edits, own);
  for (std::size_t e = 0; e < is_border.size(); ++e) is_border[e] = is_border[e] != 0 && is_seam[e] == 0 ? 1 : 0;
  return parts_between(*impl.surface, *impl.problem.mesh, is_border, is_rim, impl.options.seams,
                       part_of(own, kParted, 1.0));
}

}  // namespace seamwire
