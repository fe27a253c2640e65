// SPDX-License-Identifier: GPL-3.0-or-later
#include "seamwire/seams/seam_planner.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <iterator>
#include <limits>
#include <map>
#include <mutex>
#include <numbers>
#include <numeric>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <utility>

#include "detail/csr.hpp"
#include "detail/index.hpp"
#include "detail/indexed_heap.hpp"
#include "detail/text.hpp"
#include "seams/candidate_wires.hpp"
#include "seams/cut_pieces.hpp"
#include "seamwire/metric/metric.hpp"
#include "seamwire/surface/ray_tree.hpp"
#include "seamwire/surface/segments.hpp"

namespace seamwire {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// Seeds lie far from each other in the metric of this anisotropy, whatever the wires' own: where wires are drawn to
/// features strongly, seeds would gather on flat faces.
constexpr double kSeedAnisotropy = 10.0, kSeedClamp = 99.0;
/// A vertex without any feature is as good a seed as one on the strongest that is this much nearer.
constexpr double kPlainSeed = 0.3;
/// A wire counts as this much weaker where it strays through the cells of other seeds, beside wires of theirs.
constexpr double kStray = 5.0;
/// A wire in a deep hollow, and one that nobody sees, is worth so many times more than one on a bare ridge.
constexpr double kHollow = 1.0, kHidden = 1.0;
/// Concave curvature that is halfway to the deepest hollow, of the model scaled to the unit cube.
constexpr double kDeep = 8.0;
/// Pieces of less than this part of the surface are joined to others wherever that makes a disc.
constexpr double kCrumb = 0.004;
/// How much more the worst piece may be bent for fewer crumbs.
constexpr double kBentForCrumbs = 0.02;

/// The rank of each value, 0 to 1: not its size, for one sharp corner must not outweigh all soft ridges.
std::vector<double> ranks(const std::vector<double>& values) {
  std::vector<std::int32_t> order(values.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&](auto a, auto b) { return values[a] < values[b]; });
  std::vector<double> out(values.size());
  const auto last = static_cast<double>(std::max<std::size_t>(values.size(), 2) - 1);
  for (std::size_t i = 0; i < order.size(); ++i) out[order[i]] = static_cast<double>(i) / last;
  return out;
}

/// The seeds, and which of them each vertex is nearest to (Dijkstra, a seed at a time, as far as it is nearer than
/// those before). Steps are the sides of triangles, diagonals of polygons among them, and from a triangle's corner to
/// that behind the side opposite to it: near enough to distances to say where seeds go.
class SeedCells {
 public:
  SeedCells(const Surface& surface, const Metric& metric)
      : steps_(surface.vertex_count(),
               [&](const auto& visit) {
                 for_each_step(surface, [&](std::int32_t a, std::int32_t b) {
                   const double length = edge_length(surface, metric, a, b);
                   visit(a, Step{b, length});
                   visit(b, Step{a, length});
                 });
               }),
        distance_(surface.vertex_count(), kInfinity),
        cell_(surface.vertex_count(), -1),
        queue_(surface.vertex_count()) {}

  void add(std::int32_t seed) {
    const auto cell = static_cast<std::int32_t>(seeds_.size());
    seeds_.push_back(seed);
    relax(seed, 0.0, cell);
    while (!queue_.empty()) {
      const std::int32_t v = queue_.pop();
      for (const Step& step : steps_[v]) relax(step.to, distance_[v] + step.length, cell);
    }
  }
  const std::vector<std::int32_t>& seeds() const { return seeds_; }
  bool has(std::int32_t vertex) const { return std::ranges::find(seeds_, vertex) != seeds_.end(); }
  double distance(std::int32_t v) const { return distance_[v]; }
  std::int32_t cell(std::int32_t v) const { return cell_[v]; }

 private:
  struct Step {
    std::int32_t to;
    double length;
  };
  template <class Visit>
  static void for_each_step(const Surface& surface, const Visit& visit) {
    const auto corner = [&](std::int32_t h, std::int32_t i) {
      return surface.vertex_of_fan()[surface.face_fans()[h / 3][(h % 3 + i) % 3]];
    };
    for (std::int32_t h = 0; index(h) < surface.twins().size(); ++h) {
      const std::int32_t twin = surface.twins()[h];
      if (twin > h || twin < 0) visit(corner(h, 0), corner(h, 1));
      if (twin > h) visit(corner(h, 2), corner(twin, 2));
    }
    for (const auto& [a, b] : surface.loose_edges()) visit(a, b);
  }
  void relax(std::int32_t v, double distance, std::int32_t cell) {
    if (!(distance < distance_[v])) return;
    distance_[v] = distance;
    cell_[v] = cell;
    queue_.lower(v, distance);
  }

  Csr<Step> steps_;
  std::vector<double> distance_;
  std::vector<std::int32_t> cell_, seeds_;
  IndexedHeap queue_;
};

/// How much a wire is worth for where it runs: in hollows, and where nobody looks.
class Seclusion {
 public:
  explicit Seclusion(const Surface& surface, const Curvature& curvature)
      : surface_(surface), curvature_(curvature), rays_(surface.points(), surface.triangles()) {
    rays_.wait();
  }

  /// 1, and more the more hollow and hidden the wire is.
  double of(const std::vector<std::int32_t>& vertices) const {
    constexpr std::size_t kSamples = 24;
    const std::size_t step = std::max<std::size_t>(vertices.size() / kSamples, 1);
    double hollow = 0.0, hidden = 0.0, count = 0.0;
    for (std::size_t i = 0; i < vertices.size(); i += step, ++count) {
      hollow += hollow_at(vertices[i]);
      hidden += hidden_at(vertices[i]);
    }
    return (1.0 + kHollow * hollow / count) * (1.0 + kHidden * hidden / count);
  }

 private:
  double hollow_at(std::int32_t v) const {
    // Normals point outwards where k > 0 is convex.
    const double k1 = curvature_.k1[v], k2 = curvature_.k2[v];
    const double concave = std::max(-std::min(k1, k2), 0.0), convex = std::max({k1, k2, 0.0});
    return concave / (concave + convex + kDeep);
  }
  /// The part of the hemisphere above a vertex that the surface itself covers, weighted by the cosine.
  double hidden_at(std::int32_t v) const {
    constexpr int kRays = 24;
    constexpr double kAbove = 1e-3;  // of the model's size: away from the faces around the vertex
    const Vector& normal = curvature_.normals[v];
    if (normal.isZero()) return 0.0;
    const Vector x = normal.unitOrthogonal(), y = normal.cross(x);
    const Vector origin = surface_.points()[v] + kAbove / surface_.scale() * normal;
    int hits = 0;
    for (int i = 0; i < kRays; ++i) {
      // Points of a Fibonacci spiral on the disc, lifted to the hemisphere.
      const double radius = std::sqrt((i + 0.5) / kRays);
      const double turn = i * std::numbers::pi * (3.0 - std::sqrt(5.0));
      const Vector direction =
          radius * (std::cos(turn) * x + std::sin(turn) * y) + std::sqrt(std::max(1.0 - radius * radius, 0.0)) * normal;
      hits += rays_.first_hit(origin, direction).triangle >= 0 ? 1 : 0;
    }
    return static_cast<double>(hits) / kRays;
  }

  const Surface& surface_;
  const Curvature& curvature_;
  RayTree rays_;
};

/// A wire to choose from.
struct Choice {
  PlannedWire wire;
  double strength = 0.0;   ///< how well it follows features
  double seclusion = 1.0;  ///< Seclusion::of()

  double worth() const { return strength * seclusion; }
};

Choice make_choice(std::int32_t from, std::int32_t to, CandidateWire found, const Seclusion& seclusion) {
  const double secluded = found.vertices.empty() ? 1.0 : seclusion.of(found.vertices);
  return {.wire = {.from = from,
                   .to = to,
                   .follow = found.follow,
                   .vertices = std::move(found.vertices),
                   .points = std::move(found.points)},
          .strength = found.strength,
          .seclusion = secluded};
}

/// In the caller's units.
double length(const Surface& surface, const std::vector<std::int32_t>& chain) {
  double sum = 0.0;
  for (std::size_t i = 1; i < chain.size(); ++i) {
    sum += (surface.points()[chain[i]] - surface.points()[chain[i - 1]]).norm();
  }
  return sum;
}

/// What a wire costs: its length for its worth.
double price(const Surface& surface, const Choice& choice) {
  return length(surface, choice.wire.vertices) / choice.worth();
}

using Ends = std::pair<std::int32_t, std::int32_t>;
Ends ends_of(std::int32_t a, std::int32_t b) { return {std::min(a, b), std::max(a, b)}; }

/// The image of a wire along edges; nullopt where it has none, or runs across the surface.
std::optional<Choice> mirrored(const Choice& choice, const Surface& surface, const SeamPlannerOptions& options) {
  if (options.images.empty() || options.along != Along::kEdges) return std::nullopt;
  Choice out = choice;
  const auto is_edge = [&](std::int32_t a, std::int32_t b) {
    return std::ranges::binary_search(surface.edges(), Edge{std::min(a, b), std::max(a, b)});
  };
  std::vector<std::int32_t>& chain = out.wire.vertices;
  for (std::size_t i = 0; i < chain.size(); ++i) {
    chain[i] = options.images[chain[i]];
    if (chain[i] < 0 || (i > 0 && !is_edge(chain[i - 1], chain[i]))) return std::nullopt;
    out.wire.points[i] = surface.points()[chain[i]];
  }
  out.wire.from = options.images[choice.wire.from];
  out.wire.to = options.images[choice.wire.to];
  return out;
}

/// The chains of choices, then the seams that stay, an edge each.
std::vector<std::vector<std::int32_t>> chains_of(const std::vector<Choice>& choices, const std::vector<Edge>& seams) {
  std::vector<std::vector<std::int32_t>> chains;
  chains.reserve(choices.size() + seams.size());
  for (const Choice& choice : choices) chains.push_back(choice.wire.vertices);
  for (const auto& [a, b] : seams) chains.push_back({a, b});
  return chains;
}

/// Places seeds and joins them by wires until these cut the surface into discs.
class Seeding {
 public:
  Seeding(const CandidateWires& wires, const Seclusion& seclusion, const SeamPlannerOptions& options, const Task& task)
      : wires_(wires),
        seclusion_(seclusion),
        options_(options),
        cells_(wires.surface(),
               feature_metric(wires.surface(), wires.curvature(), Follow::kMin,
                              {.max_anisotropy = kSeedAnisotropy, .clamp_percentile = kSeedClamp}, task)),
        feature_(ranks(wires.feature_strength())),
        is_used_(wires.surface().vertex_count(), 0) {
    for (const Triangle& t : wires.surface().face_fans()) {
      for (const std::int32_t fan : t) is_used_[wires.surface().vertex_of_fan()[fan]] = 1;
    }
  }

  std::vector<Choice> choices(const Task& task) {
    task.check(0.0);
    while (cells_.seeds().size() < options_.seeds && add_seed(is_used_)) task.check(0.0);
    const std::vector<double> no_limits(wires_.surface().face_count(), kInfinity);
    while (true) {
      std::vector<Choice> found = join(task);
      const CutPieces pieces(wires_.surface(), chains_of(found, options_.seams), no_limits);
      const std::vector<std::uint8_t> worst = pieces.vertices_of_worst(wires_.surface());
      if (worst.empty() || cells_.seeds().size() >= options_.most_seeds || !add_seed(worst)) return found;
    }
  }

 private:
  /// Where the farthest feature is, among some vertices, and at its mirror image; false where none is left.
  bool add_seed(const std::vector<std::uint8_t>& among) {
    double reach = 1.0;
    for (std::int32_t v = 0; index(v) < is_used_.size(); ++v) {
      if (std::isfinite(cells_.distance(v))) reach = std::max(reach, cells_.distance(v));
    }
    std::int32_t best = -1;
    double most = 0.0;
    for (std::int32_t v = 0; index(v) < is_used_.size(); ++v) {
      if (among[v] == 0 || is_used_[v] == 0 || cells_.distance(v) <= 0.0) continue;
      // Components without a seed come first.
      const double score = std::min(cells_.distance(v), 2.0 * reach) * (kPlainSeed + feature_[v]);
      if (score > most) {
        most = score;
        best = v;
      }
    }
    if (best < 0 || cells_.has(best)) return false;
    cells_.add(best);
    const std::int32_t image = options_.images.empty() ? -1 : options_.images[best];
    if (image >= 0 && image != best && is_used_[image] != 0 && !cells_.has(image)) cells_.add(image);
    return true;
  }

  /// Wires between seeds whose cells touch; those that are known already are not found again.
  std::vector<Choice> join(const Task& task) {
    std::set<Ends> wanted;
    for (const auto& [a, b] : wires_.surface().edges()) {
      const std::int32_t one = cells_.cell(a), other = cells_.cell(b);
      if (one >= 0 && other >= 0 && one != other) wanted.insert({ends_of(one, other), image(ends_of(one, other))});
    }
    std::map<std::int32_t, CandidateWires::Fan> missing;
    for (const auto& [one, other] : wanted) {
      if (known_.contains({one, other})) continue;
      missing.try_emplace(one, CandidateWires::Fan{cells_.seeds()[one], {}})
          .first->second.to.push_back(cells_.seeds()[other]);
    }
    std::vector<CandidateWires::Fan> fans;
    fans.reserve(missing.size());
    for (const auto& [cell, fan] : missing) fans.push_back(fan);
    std::vector<std::vector<CandidateWire>> found = wires_.find(fans, task);
    std::size_t i = 0;
    for (const auto& [cell, fan] : missing) {
      for (std::size_t k = 0; k < fan.to.size(); ++k) {
        const auto other = std::ranges::find(cells_.seeds(), fan.to[k]) - cells_.seeds().begin();
        known_[{cell, static_cast<std::int32_t>(other)}] =
            make_choice(fan.from, fan.to[k], std::move(found[i][k]), seclusion_);
      }
      ++i;
    }
    for (const Ends& pair : wanted) {
      // Of chains of edges that are as short as each other, both sides shall have the same.
      if (image(pair) <= pair) continue;
      if (auto same = mirrored(known_.at(pair), wires_.surface(), options_)) known_.at(image(pair)) = std::move(*same);
    }
    std::vector<Choice> all;
    for (const Ends& pair : wanted) {
      Choice choice = known_.at(pair);
      if (choice.wire.vertices.size() < 2) continue;
      const auto strays = std::ranges::count_if(choice.wire.vertices, [&](std::int32_t v) {
        return cells_.cell(v) != pair.first && cells_.cell(v) != pair.second;
      });
      choice.strength /= 1.0 + kStray * static_cast<double>(strays) / static_cast<double>(choice.wire.vertices.size());
      all.push_back(std::move(choice));
    }
    return all;
  }

  /// The cells of the images of two seeds; those of the seeds themselves where one has none.
  Ends image(const Ends& pair) const {
    if (options_.images.empty()) return pair;
    const auto cell = [&](std::int32_t of) {
      const auto seed = std::ranges::find(cells_.seeds(), options_.images[cells_.seeds()[of]]);
      return seed == cells_.seeds().end() ? -1 : static_cast<std::int32_t>(seed - cells_.seeds().begin());
    };
    const Ends other = ends_of(cell(pair.first), cell(pair.second));
    return other.first < 0 || other.first == other.second ? pair : other;
  }

  const CandidateWires& wires_;
  const Seclusion& seclusion_;
  const SeamPlannerOptions& options_;
  SeedCells cells_;
  std::vector<double> feature_;
  std::vector<std::uint8_t> is_used_;
  std::map<Ends, Choice> known_;  // by the numbers of their seeds
};

/// How many vertices two chains have in common from an end on that both have.
std::size_t common_at_ends(std::vector<std::int32_t> one, std::vector<std::int32_t> other) {
  std::size_t count = 0;
  for (int i = 0; i < 4; ++i) {
    const auto differ = std::ranges::mismatch(one, other);
    count += static_cast<std::size_t>(differ.in1 - one.begin());
    std::ranges::reverse(i % 2 == 0 ? one : other);
  }
  return count;
}

/// Those whose chains of edges meet where their curves do, at seeds; of two others the one that is worth more. What
/// edges enclose, curves then enclose too.
std::vector<Choice> meeting_at_seeds(std::vector<Choice> choices) {
  std::ranges::stable_sort(choices, std::greater<>(), &Choice::worth);
  std::vector<Choice> taken;
  std::map<std::int32_t, std::vector<std::size_t>> through;
  for (Choice& choice : choices) {
    const std::vector<std::int32_t>& chain = choice.wire.vertices;
    std::map<std::size_t, std::size_t> contacts;
    for (const std::int32_t v : chain) {
      for (const std::size_t other : through[v]) ++contacts[other];
    }
    const bool meets_between = std::ranges::any_of(contacts, [&](const auto& contact) {
      return contact.second > common_at_ends(chain, taken[contact.first].wire.vertices);
    });
    if (meets_between) continue;
    for (const std::int32_t v : chain) through[v].push_back(taken.size());
    taken.push_back(std::move(choice));
  }
  return taken;
}

/// Takes wires away until each that is left is needed, mirror images together: the longest for its worth first, as
/// Kruskal's algorithm turned round finds a shortest tree.
class Thinning {
 public:
  /// `images`: as SeamPlannerOptions. `pieces`: those of the choices and of the seams that stay.
  Thinning(const Surface& surface, const std::vector<std::int32_t>& images, const std::vector<Choice>& choices,
           CutPieces pieces, std::size_t islands)
      : images_(images),
        choices_(choices),
        pieces_(std::move(pieces)),
        islands_(islands),
        prices_(choices_.size()),
        freedoms_(choices_.size(), Freedom::kNeeded),
        is_there_(choices_.size(), 1),
        is_needed_(choices_.size(), 0) {
    for (const Piece& piece : pieces_.pieces()) area_ += piece.area;
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
  bool is_allowed(const CutPieces::Joined& joined) const {
    const Piece& piece = joined.piece;
    if (!piece.is_disc()) return false;
    const bool is_cut = joined.pieces == 1, is_limited = islands_ == 0 || is_cut;
    return !is_limited || piece.spread() <= piece.max_spread || (!is_cut && joined.smallest < kCrumb * area_);
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
      const PlannedWire& other = choices_[i].wire;
      if (i != wire && is_there_[i] != 0 && ends_of(other.from, other.to) == ends) found.push_back(i);
    }
    return found;
  }

  const std::vector<std::int32_t>& images_;
  const std::vector<Choice>& choices_;
  CutPieces pieces_;
  const std::size_t islands_;
  double area_ = 0.0;
  std::vector<double> prices_;
  std::vector<Freedom> freedoms_;  ///< of those that are there
  std::vector<std::uint8_t> is_there_, is_needed_;
  bool is_paired_ = true;
};

/// How good a set of wires is, but for their length.
struct Quality {
  explicit Quality(const CutPieces& pieces) {
    for (const Piece& piece : pieces.pieces()) crumb += kCrumb * piece.area;
    for (const Piece& piece : pieces.pieces()) {
      if (piece.area < crumb) {
        ++crumbs;
      } else {
        bent = std::max(bent, piece.spread() - piece.max_spread);
      }
      not_discs += piece.is_disc() ? 0 : 1;
    }
  }

  double crumb = 0.0;  ///< the area below which a piece is one
  std::size_t crumbs = 0, not_discs = 0;
  double bent = 0.0;  ///< by how much the spread of normals exceeds what is allowed, at most
};

/// A seed where two wires meet and nothing else is.
struct Joint {
  std::array<std::size_t, 2> wires;  ///< by their numbers
  Ends ends;                         ///< their other ends, which differ
};
using Joints = std::map<std::int32_t, Joint>;  // by the vertices of the seeds

Joints joints_of(const std::vector<Choice>& wires, const std::vector<Edge>& seams) {
  std::map<std::int32_t, std::vector<std::size_t>> ending;
  std::set<std::int32_t> passed;
  for (const auto& [a, b] : seams) passed.insert({a, b});
  for (std::size_t i = 0; i < wires.size(); ++i) {
    const PlannedWire& wire = wires[i].wire;
    ending[wire.from].push_back(i);
    ending[wire.to].push_back(i);
    for (const std::int32_t v : wire.vertices) {
      if (v != wire.from && v != wire.to) passed.insert(v);
    }
  }
  const auto other_end = [](const PlannedWire& wire, std::int32_t end) {
    return wire.from == end ? wire.to : wire.from;
  };
  Joints joints;
  for (const auto& [seed, meeting] : ending) {
    if (meeting.size() != 2 || passed.contains(seed)) continue;
    const Ends ends = ends_of(other_end(wires[meeting[0]].wire, seed), other_end(wires[meeting[1]].wire, seed));
    if (ends.first != ends.second) joints.insert({seed, {{meeting[0], meeting[1]}, ends}});
  }
  return joints;
}

}  // namespace

struct SeamPlanner::Impl {
  Impl(std::shared_ptr<const Surface> on, const SeamPlannerOptions& with, const Task& task)
      : options(with),
        wires(std::move(on), with.along, with.strength, task),
        seclusion(wires.surface(), wires.curvature()),
        choices(Seeding(wires, seclusion, options, task).choices(task)) {}

  const Surface& surface() const { return wires.surface(); }
  CutPieces pieces(const std::vector<Choice>& of, std::span<const double> max_spreads) const {
    return CutPieces(surface(), chains_of(of, options.seams), max_spreads);
  }
  std::vector<Choice> swept(std::vector<Choice> best, const SeamLimits& limits, std::span<const double> max_spreads,
                            const Task& task) const;
  std::vector<std::vector<Choice>> shortened(const Choice& wire, const std::vector<Choice>& others,
                                             const Task& task) const;
  std::map<Ends, Choice> direct_wires(const std::set<Ends>& pairs, const Task& task) const;
  std::vector<Choice> straightened(std::vector<Choice> best, const SeamLimits& limits,
                                   std::span<const double> max_spreads, const Task& task) const;
  std::optional<std::vector<Choice>> without_joint(const std::vector<Choice>& wires, const Joints& joints,
                                                   std::int32_t joint, const std::map<Ends, Choice>& direct) const;

  const SeamPlannerOptions options;
  const CandidateWires wires;
  const Seclusion seclusion;
  const std::vector<Choice> choices;

 private:
  mutable std::mutex known_direct_mutex;
  mutable std::map<Ends, Choice> known_direct;
};

/// Lets wires start on others where they ran beside them, as long as that leaves fewer crumbs and pieces as good.
std::vector<Choice> SeamPlanner::Impl::swept(std::vector<Choice> best, const SeamLimits& limits,
                                             std::span<const double> max_spreads, const Task& task) const {
  CutPieces cut = pieces(best, max_spreads);
  Quality quality(cut);
  std::vector<Choice> order = best;
  std::stable_sort(order.begin(), order.end(),
                   [](const Choice& a, const Choice& b) { return a.strength < b.strength; });
  for (const Choice& wire : order) {
    if (quality.crumbs == 0) break;
    const auto place = std::ranges::find(best, wire.wire.vertices, [](const Choice& c) { return c.wire.vertices; });
    if (place == best.end() || !cut.has_beside(static_cast<std::int32_t>(place - best.begin()), quality.crumb))
      continue;
    std::vector<Choice> others = best;
    others.erase(others.begin() + (place - best.begin()));
    // An image that runs as the wire does is shortened with it.
    const std::optional<Choice> image = mirrored(wire, surface(), options);
    const auto has_course = [](const Choice& choice, const std::vector<std::int32_t>& course) {
      const std::vector<std::int32_t>& own = choice.wire.vertices;
      return own == course || std::equal(own.begin(), own.end(), course.rbegin(), course.rend());
    };
    const bool has_image =
        image && !has_course(wire, image->wire.vertices) &&
        std::erase_if(others, [&](const Choice& other) { return has_course(other, image->wire.vertices); }) > 0;
    for (const std::vector<Choice>& parts : shortened(wire, others, task)) {
      std::vector<Choice> trial = others;
      trial.insert(trial.end(), parts.begin(), parts.end());
      for (const Choice& part : parts) {
        if (!has_image) break;
        if (const std::optional<Choice> other = mirrored(part, surface(), options)) trial.push_back(*other);
      }
      CutPieces trial_cut = pieces(trial, max_spreads);
      const Quality now(trial_cut);
      if (trial_cut.piece_count() >= limits.islands && now.crumbs < quality.crumbs &&
          now.not_discs <= quality.not_discs && now.bent <= quality.bent + kBentForCrumbs) {
        quality = now;
        cut = std::move(trial_cut);
        best = std::move(trial);
        break;
      }
    }
  }
  return best;
}

/// A wire between the vertices where it meets others, each time without one of these stretches.
std::vector<std::vector<Choice>> SeamPlanner::Impl::shortened(const Choice& wire, const std::vector<Choice>& others,
                                                              const Task& task) const {
  std::set<std::int32_t> drawn;
  std::set<Ends> shared;
  for (const auto& [a, b] : options.seams) {
    drawn.insert({a, b});
    shared.insert(ends_of(a, b));
  }
  for (const Choice& other : others) {
    const std::vector<std::int32_t>& chain = other.wire.vertices;
    drawn.insert(chain.begin(), chain.end());
    for (std::size_t i = 1; i < chain.size(); ++i) shared.insert(ends_of(chain[i - 1], chain[i]));
  }
  const std::vector<std::int32_t>& chain = wire.wire.vertices;
  std::vector<std::size_t> contacts;
  for (std::size_t i = 0; i < chain.size(); ++i) {
    if (i == 0 || i + 1 == chain.size() || drawn.contains(chain[i])) contacts.push_back(i);
  }
  if (contacts.size() < 3) return {};
  std::vector<CandidateWires::Fan> fans;
  for (std::size_t i = 1; i < contacts.size(); ++i) {
    const std::size_t a = contacts[i - 1], b = contacts[i];
    if (b - a == 1 && shared.contains(ends_of(chain[a], chain[b]))) continue;
    fans.push_back({chain[a], {chain[b]}});
  }
  std::vector<Choice> stretches;
  std::vector<std::vector<CandidateWire>> found = wires.find(fans, task);
  stretches.reserve(fans.size());
  for (std::size_t i = 0; i < fans.size(); ++i) {
    stretches.push_back(make_choice(fans[i].from, fans[i].to.front(), std::move(found[i].front()), seclusion));
  }
  std::vector<std::vector<Choice>> ways;
  for (std::size_t left_out = 0; left_out < stretches.size(); ++left_out) {
    std::vector<Choice> parts;
    for (std::size_t i = 0; i < stretches.size(); ++i) {
      if (i != left_out && stretches[i].wire.vertices.size() > 1) parts.push_back(stretches[i]);
    }
    ways.push_back(std::move(parts));
  }
  return ways;
}

/// The wires between pairs of seeds; those that former plans needed are known.
std::map<Ends, Choice> SeamPlanner::Impl::direct_wires(const std::set<Ends>& pairs, const Task& task) const {
  std::map<Ends, Choice> out;
  std::vector<CandidateWires::Fan> missing;
  {
    const std::scoped_lock lock(known_direct_mutex);
    for (const Ends& ends : pairs) {
      if (const auto known = known_direct.find(ends); known != known_direct.end()) {
        out.insert(*known);
      } else {
        missing.push_back({ends.first, {ends.second}});
      }
    }
  }
  std::vector<std::vector<CandidateWire>> found = wires.find(missing, task);
  for (std::size_t i = 0; i < missing.size(); ++i) {
    const std::int32_t from = missing[i].from, to = missing[i].to.front();
    out.insert({{from, to}, make_choice(from, to, std::move(found[i].front()), seclusion)});
  }
  const std::scoped_lock lock(known_direct_mutex);
  known_direct.insert(out.begin(), out.end());
  return out;
}

/// Lets one direct wire take the place of two that meet at a joint, where it costs less and leaves pieces as good.
std::vector<Choice> SeamPlanner::Impl::straightened(std::vector<Choice> best, const SeamLimits& limits,
                                                    std::span<const double> max_spreads, const Task& task) const {
  std::size_t piece_count = 0;
  std::optional<Quality> quality;
  std::map<Ends, Choice> direct;
  std::set<std::pair<std::int32_t, Ends>> tried;
  const auto is_as_good = [&](const std::vector<Choice>& trial) {
    if (!limits.may_start_on_others && meeting_at_seeds(trial).size() != trial.size()) return false;
    const CutPieces cut = pieces(trial, max_spreads);
    const Quality now(cut);
    return cut.piece_count() == piece_count && now.crumbs <= quality->crumbs && now.not_discs <= quality->not_discs &&
           now.bent <= std::max(quality->bent, 0.0);
  };
  // All that can be tried with the wires that are known, before more are found: those are found on several threads.
  const auto straighten_one = [&] {
    const Joints joints = joints_of(best, options.seams);
    for (const auto& [joint, at] : joints) {
      task.check(0.0);
      if (!direct.contains(at.ends) || !tried.insert({joint, at.ends}).second) continue;
      std::optional<std::vector<Choice>> trial = without_joint(best, joints, joint, direct);
      if (!trial || !is_as_good(*trial)) continue;
      best = std::move(*trial);
      return true;
    }
    return false;
  };
  while (true) {
    std::set<Ends> missing;
    for (const auto& [joint, at] : joints_of(best, options.seams)) {
      if (!direct.contains(at.ends)) missing.insert(at.ends);
    }
    if (missing.empty()) return best;
    direct.merge(direct_wires(missing, task));
    if (!quality) {
      const CutPieces cut = pieces(best, max_spreads);
      piece_count = cut.piece_count();
      quality.emplace(cut);
    }
    while (straighten_one()) continue;
  }
}

/// The wires with direct ones in place of those that meet at a joint, and at its image; nullopt where that costs more.
std::optional<std::vector<Choice>> SeamPlanner::Impl::without_joint(const std::vector<Choice>& wires,
                                                                    const Joints& joints, std::int32_t joint,
                                                                    const std::map<Ends, Choice>& direct) const {
  const Joint& own = joints.at(joint);
  std::vector<std::size_t> gone(own.wires.begin(), own.wires.end());
  std::vector<Choice> come{direct.at(own.ends)};
  const std::int32_t image = options.images.empty() ? -1 : options.images[joint];
  if (image >= 0 && image != joint) {
    const auto other = joints.find(image);
    const Ends ends = ends_of(options.images[own.ends.first], options.images[own.ends.second]);
    if (other == joints.end() || other->second.ends != ends || !direct.contains(ends)) return std::nullopt;
    for (const std::size_t wire : other->second.wires) {
      if (std::ranges::find(gone, wire) != gone.end()) return std::nullopt;  // one after the other then
      gone.push_back(wire);
    }
    std::optional<Choice> same = mirrored(come.front(), surface(), options);
    come.push_back(same ? std::move(*same) : direct.at(ends));
  }
  double before = 0.0, after = 0.0;
  for (const std::size_t wire : gone) before += price(surface(), wires[wire]);
  for (const Choice& choice : come) {
    if (choice.wire.vertices.size() < 2) return std::nullopt;
    after += price(surface(), choice);
  }
  if (!(after < before)) return std::nullopt;
  std::vector<Choice> trial;
  for (std::size_t i = 0; i < wires.size(); ++i) {
    if (std::ranges::find(gone, i) == gone.end()) trial.push_back(wires[i]);
  }
  trial.insert(trial.end(), come.begin(), come.end());
  return trial;
}

SeamPlanner::SeamPlanner(std::shared_ptr<const Surface> surface, const SeamPlannerOptions& options, const Task& task) {
  if (!surface) throw InvalidInput("surface: there is none");
  check_strength(options.strength);
  if (options.seeds < 1) throw InvalidInput("seeds is 0, not 1 or more");
  if (options.most_seeds < options.seeds) {
    throw InvalidInput("most_seeds is " + std::to_string(options.most_seeds) + ", less than seeds, " +
                       std::to_string(options.seeds));
  }
  const std::size_t count = surface->vertex_count();
  if (!options.images.empty() && options.images.size() != count) {
    throw InvalidInput("images has " + std::to_string(options.images.size()) + " items: there are " +
                       std::to_string(count) + " vertices");
  }
  for (const std::int32_t v : options.images) {
    if (v != -1) check_index(v, count, "images: vertex");
  }
  for (const Edge& edge : options.seams) {
    for (const std::int32_t v : edge) check_index(v, count, "seams: vertex");
  }
  impl_ = std::make_shared<const Impl>(std::move(surface), options, task);
}

SeamPlan SeamPlanner::plan(const SeamLimits& limits, const Task& task) const {
  const auto check = [](double spread, const std::string& name) {
    if (!(spread >= 0.0)) throw InvalidInput(name + " is " + text(spread) + ", not a number of at least 0");
  };
  check(limits.max_spread, "max_spread");
  const Surface& surface = impl_->surface();
  std::vector<double> max_spreads = limits.max_spreads;
  if (max_spreads.empty()) max_spreads.assign(surface.face_count(), limits.max_spread);
  if (max_spreads.size() != surface.face_count()) {
    throw InvalidInput("max_spreads has " + std::to_string(max_spreads.size()) + " items: there are " +
                       std::to_string(surface.face_count()) + " triangles");
  }
  for (std::size_t f = 0; f < max_spreads.size(); ++f) check(max_spreads[f], "max_spreads[" + std::to_string(f) + "]");

  const std::vector<Choice> among = limits.may_start_on_others ? impl_->choices : meeting_at_seeds(impl_->choices);
  CutPieces all = impl_->pieces(among, max_spreads);
  std::vector<Choice> kept = Thinning(surface, impl_->options.images, among, std::move(all), limits.islands).run(task);
  if (limits.may_start_on_others) kept = impl_->swept(std::move(kept), limits, max_spreads, task);
  if (limits.are_straightened) kept = impl_->straightened(std::move(kept), limits, max_spreads, task);
  SeamPlan plan;
  const CutPieces pieces = impl_->pieces(kept, max_spreads);
  plan.not_discs = Quality(pieces).not_discs;
  std::vector<Edge> cuts = impl_->options.seams;
  for (Choice& choice : kept) {
    const std::vector<std::int32_t>& chain = choice.wire.vertices;
    for (std::size_t i = 1; i < chain.size(); ++i) cuts.push_back({chain[i - 1], chain[i]});
    plan.cost += price(surface, choice);
    plan.wires.push_back(std::move(choice.wire));
  }
  plan.islands = face_segments(surface, cuts);
  for (const std::int32_t island : plan.islands) plan.island_count = std::max(plan.island_count, index(island) + 1);
  return plan;
}

}  // namespace seamwire
