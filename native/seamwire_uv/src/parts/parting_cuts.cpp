// SPDX-License-Identifier: GPL-3.0-or-later
#include "parts/parting_cuts.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <iterator>
#include <numeric>
#include <queue>
#include <set>
#include <span>
#include <utility>

#include "detail/csr.hpp"
#include "detail/index.hpp"
#include "detail/poll.hpp"
#include "graph/disjoint_sets.hpp"
#include "graph/edge_chains.hpp"
#include "maps/degrees_between.hpp"
#include "parts/minimum_cut.hpp"
#include "slits/slit_tree.hpp"
#include "surface/joined_faces.hpp"
#include "tuning/constants.hpp"

namespace seamwire::detail {
namespace {

constexpr double kLeastLink = 1e-9;  // of an edge without a length, which holds its triangles together all the same
constexpr std::size_t kMostBlocks = 2500;  // among which a cut is looked for before it is refined

/// The mirror images of edges if each of them has an image within a piece, otherwise nothing.
std::vector<std::int32_t> images_within(const SlitProblem& problem, std::span<const std::int32_t> edges,
                                        std::int32_t piece) {
  std::vector<std::int32_t> images;
  for (const std::int32_t edge : edges) {
    const std::int32_t image = image_of_edge(*problem.mesh, *problem.reflection, edge);
    if (image < 0 || problem.pieces.of_face[problem.mesh->half_edge_of[image] / 3] != piece) return {};
    images.push_back(image);
  }
  return images;
}

/// The piece that is the mirror image of another one; -1 if the piece has no image or is its own.
std::int32_t image_of(const SlitProblem& problem, std::int32_t piece) {
  if (!problem.reflection) return -1;
  const PlanMesh& mesh = *problem.mesh;
  for (const std::int32_t f : problem.by_piece[piece].faces) {
    for (std::int32_t h = 3 * f; h < 3 * f + 3; ++h) {
      if (mesh.twins[h] < 0 || problem.is_seam[mesh.edge_of[h]] != 0) continue;
      const std::int32_t image = image_of_edge(mesh, *problem.reflection, mesh.edge_of[h]);
      if (image < 0) continue;
      const std::int32_t other = problem.pieces.of_face[mesh.half_edge_of[image] / 3];
      return other == piece ? -1 : other;
    }
  }
  return -1;
}

/// A way to part a piece in two.
struct Halves {
  std::vector<std::uint8_t> side;  ///< of each triangle of the piece
  double price = 0.0;
  double share = 0.0;  ///< the smaller half's part of the area; 0 if the halves are more than two connected parts

  bool is_balanced() const { return share >= tuning::kLeastHalf; }
  /// Normalized cuts are cheap for the area that they part.
  double score() const { return price / share; }
};

/// Finds a balanced cut through one piece.
///
/// Candidates are minimum cuts between two connected seeds at opposite ends of the piece. "Opposite" is taken by
/// several functions on the piece, and the seeds have several sizes. The best candidate has the least price for the
/// area of its smaller half, as a normalized cut has (Shi and Malik 2000).
class Halving {
 public:
  Halving(const SlitProblem& problem, std::int32_t piece, const Task& task)
      : problem_(problem),
        task_(task),
        poll_(task),
        body_(problem, piece, task),
        count_(static_cast<std::int32_t>(island().triangles.size())) {
    for (std::int32_t k = 0; k < count_; ++k) all_ += area(k);
  }

  /// The edges of the best cut; empty if there is no cut.
  std::vector<std::int32_t> cut() {
    task_.check(0.0);
    Halves best;
    if (find_images()) {
      try_cuts(joined_blocks(true), 0.0, 0.5, best);
      try_plane(best);
    }
    if (!best.is_balanced()) {
      is_mirrored_ = false;
      try_cuts(joined_blocks(false), 0.5, 1.0, best);
    }
    std::vector<std::int32_t> found;
    if (!(best.share > 0.0)) return found;
    for_inner([&](std::int32_t h, std::int32_t k, std::int32_t other) {
      if (best.side[k] != best.side[other]) found.push_back(edge_of(h));
    });
    return found;
  }

 private:
  struct Link {
    std::int32_t block = -1;
    double price = 0.0;
  };
  /// Sets of triangles, each of which stays on one side of every cut.
  struct Blocks {
    std::vector<std::int32_t> of_triangle;
    std::vector<double> areas;  // of each block
    Csr<Link> links;            // of each block
    std::size_t count() const { return areas.size(); }
  };
  static constexpr std::int32_t kFree = -1, kSource = 0, kSink = 1;

  const Island& island() const { return body_.island; }
  std::int32_t edge_of(std::int32_t h) const { return problem_.mesh->edge_of[3 * island().faces[h / 3] + h % 3]; }
  double area(std::int32_t k) const { return std::max(problem_.areas[island().faces[k]], 1e-12); }

  /// Calls visit(half-edge, triangle, other triangle) for each edge inside of the piece.
  template <class Visit>
  void for_inner(const Visit& visit) const {
    for (std::int32_t h = 0; h < 3 * count_; ++h) {
      poll_.at(index(h));
      if (island().twins[h] > h) visit(h, h / 3, island().twins[h] / 3);
    }
  }

  /// Finds which triangles are mirror images of each other. Returns whether the piece is its own image.
  bool find_images() {
    if (!problem_.reflection) return false;
    const PlanMesh& mesh = *problem_.mesh;
    std::vector<std::int32_t> own(mesh.face_count(), -1);
    for (std::int32_t k = 0; k < count_; ++k) own[island().faces[k]] = k;
    std::size_t with = 0, without = 0;
    for_inner([&](std::int32_t h, std::int32_t k, std::int32_t other) {
      if (problem_.prices.of_edge[edge_of(h)] == kInfinity)
        return;  // a diagonal has no image if its quad is divided anew
      const std::int32_t image = image_of_half_edge(3 * island().faces[k] + h % 3);
      const std::int32_t twin = image < 0 ? -1 : mesh.twins[image];
      if (twin < 0 || own[image / 3] < 0 || own[twin / 3] < 0) {
        ++without;
        return;
      }
      ++with;
      images_.emplace_back(k, own[image / 3]);
      images_.emplace_back(other, own[twin / 3]);
    });
    is_mirrored_ = static_cast<double>(with) >= tuning::kExactImages * static_cast<double>(with + without);
    return is_mirrored_ && with > 0;
  }

  /// The half-edge at the mirror image of a half-edge, within the image of its triangle; -1 without an image.
  std::int32_t image_of_half_edge(std::int32_t h) const {
    const PlanMesh& mesh = *problem_.mesh;
    const std::int32_t edge = image_of_edge(mesh, *problem_.reflection, mesh.edge_of[h]);
    if (edge < 0) return -1;
    const std::int32_t found = mesh.half_edge_of[edge];
    // Mirroring turns triangles over.
    return mesh.tail(found) == problem_.reflection->images[mesh.tip(h)] ? found : mesh.twins[found];
  }

  /// Joins the triangles that no seam may part, and mirror images.
  Blocks joined_blocks(bool with_images) const {
    DisjointSets sets(island().triangles.size());
    for_inner([&](std::int32_t h, std::int32_t k, std::int32_t other) {
      if (problem_.prices.of_edge[edge_of(h)] == kInfinity) sets.join(k, other);
    });
    if (with_images) {
      for (const auto& [k, image] : images_) sets.join(k, image);
    }
    std::vector<std::int32_t> set_of;
    for (std::int32_t k = 0; k < count_; ++k) set_of.push_back(sets.find(k));
    return blocks_of(set_of);
  }

  /// Makes blocks of sets, each of which has the number of its first triangle.
  Blocks blocks_of(const std::vector<std::int32_t>& set_of) const {
    Blocks blocks;
    blocks.of_triangle.assign(set_of.size(), -1);
    for (std::int32_t k = 0; k < count_; ++k) {
      std::int32_t& block = blocks.of_triangle[set_of[k]];
      if (block < 0) {
        block = static_cast<std::int32_t>(blocks.count());
        blocks.areas.push_back(0.0);
      }
      blocks.of_triangle[k] = block;
      blocks.areas[block] += area(k);
    }
    blocks.links = Csr<Link>(blocks.count(), [&](const auto& visit) {
      for_inner([&](std::int32_t h, std::int32_t k, std::int32_t other) {
        const std::int32_t one = blocks.of_triangle[k], two = blocks.of_triangle[other];
        if (one == two) return;
        const double price = problem_.prices.of_edge[edge_of(h)];
        visit(one, Link{two, price});
        visit(two, Link{one, price});
      });
    });
    return blocks;
  }

  /// Tries cuts between both ends of several functions. If there are many blocks, the cuts run between larger ones, and
  /// the best cut is refined.
  void try_cuts(const Blocks& blocks, double begin, double end, Halves& best) const {
    const Task task = part_of(task_, begin, end);
    Blocks coarse = blocks;
    while (coarse.count() > kMostBlocks) {
      task.check(0.0);
      Blocks next = joined_in_pairs(coarse);
      if (10 * next.count() > 9 * coarse.count()) break;
      coarse = std::move(next);
    }
    if (coarse.count() < 2) return;
    Halves found;
    task.check(kJoined);
    const std::vector<std::vector<double>> all = functions(task);
    const std::size_t tries = std::max<std::size_t>(all.size() * tuning::kSeedShares.size(), 1);
    const double step = (kTried - kCoarse) / static_cast<double>(tries);
    double done = kCoarse;
    for (const std::vector<double>& function : all) {
      const std::vector<double> places = means(coarse, function);
      for (const double share : tuning::kSeedShares) {
        try_cut(coarse, places, share, part_of(task, done, done + step), found);
        done += step;
      }
    }
    if (found.share > 0.0 && coarse.count() < blocks.count()) {
      const double blocks_of_coarse = static_cast<double>(blocks.count()) / static_cast<double>(coarse.count());
      refine(blocks, static_cast<int>(3.0 * std::sqrt(blocks_of_coarse)), part_of(task, kTried, 1.0), found);
    }
    keep_better(std::move(found), best);
  }

  /// Joins each block with the neighbor that is hardest to part from it for its size (heavy-edge matching, Karypis and
  /// Kumar 1998).
  Blocks joined_in_pairs(const Blocks& blocks) const {
    const double most = 4.0 * all_ / static_cast<double>(kMostBlocks);
    std::vector<std::int32_t> mate(blocks.count(), -1);
    std::vector<Link> sums;
    for (std::int32_t b = 0; index(b) < blocks.count(); ++b) {
      poll_.at(index(b));
      if (mate[b] >= 0) continue;
      mate[b] = b;
      sums.clear();
      for (const Link& link : blocks.links[b]) {
        if (mate[link.block] >= 0 || blocks.areas[b] + blocks.areas[link.block] > most) continue;
        const auto same = std::ranges::find(sums, link.block, &Link::block);
        if (same == sums.end()) {
          sums.push_back(link);
        } else {
          same->price += link.price;
        }
      }
      if (sums.empty()) continue;
      const auto strength = [&](const Link& link) { return link.price / blocks.areas[link.block]; };
      const std::int32_t other = std::ranges::max_element(sums, {}, strength)->block;
      mate[b] = other;
      mate[other] = b;
    }
    std::vector<std::int32_t> first(blocks.count(), -1), set_of;
    for (std::int32_t k = 0; k < count_; ++k) {
      const std::int32_t b = blocks.of_triangle[k], name = std::min(b, mate[b]);
      if (first[name] < 0) first[name] = k;
      set_of.push_back(first[name]);
    }
    return blocks_of(set_of);
  }

  /// Looks for a cheaper cut near the best one, some blocks to both sides.
  void refine(const Blocks& blocks, int rings, const Task& task, Halves& best) const {
    std::vector<std::int32_t> owner(blocks.count(), kFree), band;
    std::vector<std::uint8_t> is_in_band(blocks.count(), 0);
    const auto add = [&](std::int32_t b) {
      if (is_in_band[b] == 0) band.push_back(b);
      is_in_band[b] = 1;
    };
    for (std::int32_t k = 0; k < count_; ++k) owner[blocks.of_triangle[k]] = best.side[k] != 0 ? kSource : kSink;
    for (std::int32_t b = 0; index(b) < blocks.count(); ++b) {
      for (const Link& link : blocks.links[b]) {
        if (owner[b] != owner[link.block]) add(b);
      }
    }
    for (std::size_t first = 0; rings > 0; --rings) {
      for (const std::size_t last = band.size(); first < last; ++first) {
        for (const Link& link : blocks.links[band[first]]) add(link.block);
      }
    }
    for (const std::int32_t b : band) owner[b] = kFree;
    cut_between(blocks, std::move(owner), task, best);
  }

  /// Functions at the piece's vertices that rise from one end of it to another.
  std::vector<std::vector<double>> functions(const Task& task) const {
    std::vector<std::vector<double>> found;
    const auto rise = [&](const std::vector<double>& from, const std::vector<double>& to) {
      std::vector<double>& own = found.emplace_back(from);
      for (std::size_t v = 0; v < own.size(); ++v) own[v] -= to[v];
    };
    const std::vector<std::int32_t> choice = ends();
    if (choice.empty()) return found;
    const auto farthest = [&](const std::vector<double>& away) {
      return *std::ranges::max_element(choice, {}, [&](std::int32_t own) { return away[own]; });
    };
    const auto from = [&](std::int32_t own) { return body_.graph.distances_from(own, task); };
    const std::vector<double> first = from(farthest(from(choice.front()))), last = from(farthest(first));
    rise(first, last);
    std::vector<double> nearest(first.size());
    for (std::size_t v = 0; v < nearest.size(); ++v) nearest[v] = std::min(first[v], last[v]);
    const std::vector<double> beside = from(farthest(nearest));
    rise(beside, from(farthest(beside)));
    for (const Vector& axis : axes()) {
      std::vector<double>& own = found.emplace_back();
      for (const std::int32_t v : island().vertices) own.push_back(problem_.mesh->points[v].dot(axis));
    }
    return found;
  }

  /// The vertices among which the ends of the piece are looked for. If the cut is symmetric, these lie on the mirror
  /// plane or in triangles that it crosses, so that each half is connected.
  std::vector<std::int32_t> ends() const {
    std::vector<std::int32_t> found(island().vertices.size());
    std::iota(found.begin(), found.end(), 0);
    if (!is_mirrored_) return found;
    std::vector<std::uint8_t> is_in_middle(found.size(), 0);
    for (const Triangle& triangle : island().triangles) {
      const auto [least, most] = sides_of(triangle);
      for (const std::int32_t own : triangle) {
        if (side_of(own) == 0 || (least < 0 && most > 0)) is_in_middle[own] = 1;
      }
    }
    std::erase_if(found, [&](std::int32_t own) { return is_in_middle[own] == 0; });
    return found;
  }

  /// On which side of the mirror plane a vertex lies: -1, 0 or 1.
  int side_of(std::int32_t own) const { return problem_.reflection->sides[island().vertices[own]]; }
  std::pair<int, int> sides_of(const Triangle& triangle) const {
    return std::minmax({side_of(triangle[0]), side_of(triangle[1]), side_of(triangle[2])});
  }

  /// The principal axes of the piece.
  std::array<Vector, 3> axes() const {
    Vector middle = Vector::Zero();
    const auto center = [&](std::int32_t k) {
      Vector sum = Vector::Zero();
      for (const std::int32_t own : island().triangles[k]) sum += problem_.mesh->points[island().vertices[own]];
      return Vector(sum / 3.0);
    };
    for (std::int32_t k = 0; k < count_; ++k) middle += area(k) / all_ * center(k);
    Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
    for (std::int32_t k = 0; k < count_; ++k) {
      const Vector away = center(k) - middle;
      spread += area(k) * away * away.transpose();
    }
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(spread);
    const Eigen::Matrix3d& vectors = solver.eigenvectors();
    return {vectors.col(0), vectors.col(1), vectors.col(2)};
  }

  /// The mean of a function over each block.
  std::vector<double> means(const Blocks& blocks, const std::vector<double>& function) const {
    std::vector<double> found(blocks.count(), 0.0);
    for (std::int32_t k = 0; k < count_; ++k) {
      double sum = 0.0;
      for (const std::int32_t own : island().triangles[k]) sum += function[own];
      found[blocks.of_triangle[k]] += area(k) * sum / 3.0;
    }
    for (std::size_t b = 0; b < found.size(); ++b) found[b] /= blocks.areas[b];
    return found;
  }

  /// Tries the cheapest cut between seeds of a share of the area each, where a function is least and greatest.
  void try_cut(const Blocks& blocks, const std::vector<double>& places, double share, const Task& task,
               Halves& best) const {
    task.check(0.0);
    std::vector<std::int32_t> owner(blocks.count(), kFree);
    grow(blocks, places, share, 1.0, kSource, owner);
    give_pockets(blocks, kSource, owner);
    grow(blocks, places, share, -1.0, kSink, owner);
    cut_between(blocks, std::move(owner), task, best);
  }

  /// Tries the cheapest cut between the blocks that have an owner.
  void cut_between(const Blocks& blocks, std::vector<std::int32_t> owner, const Task& task, Halves& best) const {
    std::int32_t nodes = 2;
    for (std::int32_t& own : owner) own = own == kFree ? nodes++ : own;
    for (const std::int32_t seed : {kSource, kSink}) {
      if (std::ranges::find(owner, seed) == owner.end()) return;
    }
    MinimumCut network(index(nodes));
    for (std::int32_t b = 0; index(b) < blocks.count(); ++b) {
      for (const Link& link : blocks.links[b]) {
        if (b >= link.block || owner[b] == owner[link.block]) continue;
        network.add(owner[b], owner[link.block], std::max(link.price, kLeastLink));
      }
    }
    const std::vector<std::uint8_t> is_source = network.source_side(kSource, kSink, task);
    std::vector<std::uint8_t> side;
    for (const std::int32_t block : blocks.of_triangle) side.push_back(is_source[owner[block]]);
    offer(std::move(side), best);
  }

  /// Gives connected blocks to a seed, in the order of `sign` times a function, until they have a share of the area.
  void grow(const Blocks& blocks, const std::vector<double>& places, double share, double sign, std::int32_t seed,
            std::vector<std::int32_t>& owner) const {
    using Next = std::pair<double, std::int32_t>;
    std::priority_queue<Next, std::vector<Next>, std::greater<>> open;
    std::vector<std::uint8_t> is_seen(owner.size(), 0);
    Next first{kInfinity, -1};
    for (std::int32_t b = 0; index(b) < owner.size(); ++b) {
      if (owner[b] < 0) first = std::min(first, Next{sign * places[b], b});
    }
    if (first.second < 0) return;
    open.push(first);
    is_seen[first.second] = 1;
    double sum = 0.0;
    while (!open.empty() && sum < share * all_) {
      const std::int32_t b = open.top().second;
      open.pop();
      if (sum > 0.0 && sum + blocks.areas[b] > (1.0 - tuning::kLeastHalf) * all_) continue;
      owner[b] = seed;
      sum += blocks.areas[b];
      for (const Link& link : blocks.links[b]) {
        if (owner[link.block] >= 0 || is_seen[link.block] != 0) continue;
        is_seen[link.block] = 1;
        open.emplace(sign * places[link.block], link.block);
      }
    }
  }

  /// Gives a seed all connected regions of free blocks but the largest.
  void give_pockets(const Blocks& blocks, std::int32_t seed, std::vector<std::int32_t>& owner) const {
    DisjointSets regions(owner.size());
    for (std::int32_t b = 0; index(b) < owner.size(); ++b) {
      for (const Link& link : blocks.links[b]) {
        if (owner[b] < 0 && owner[link.block] < 0) regions.join(b, link.block);
      }
    }
    std::vector<double> sizes(owner.size(), 0.0);
    for (std::int32_t b = 0; index(b) < owner.size(); ++b) {
      if (owner[b] < 0) sizes[regions.find(b)] += blocks.areas[b];
    }
    const auto largest = static_cast<std::int32_t>(std::ranges::max_element(sizes) - sizes.begin());
    for (std::int32_t b = 0; index(b) < owner.size(); ++b) {
      if (owner[b] < 0 && regions.find(b) != largest) owner[b] = seed;
    }
  }

  /// Tries the cut along the mirror plane, if edges lie there.
  void try_plane(Halves& best) const {
    std::vector<std::uint8_t> side;
    for (const Triangle& triangle : island().triangles) {
      const auto [least, most] = sides_of(triangle);
      if (least < 0 && most > 0) return;
      side.push_back(most > 0 ? 1 : 0);
    }
    offer(std::move(side), best);
  }

  /// Keeps a cut if it is better than the best one.
  void offer(std::vector<std::uint8_t> side, Halves& best) const {
    Halves own{.side = std::move(side), .price = 0.0, .share = 0.0};
    DisjointSets parts(island().triangles.size());
    std::int32_t part_count = count_;
    for_inner([&](std::int32_t h, std::int32_t k, std::int32_t other) {
      if (own.side[k] != own.side[other]) {
        own.price += problem_.prices.of_edge[edge_of(h)];
      } else if (parts.join(k, other)) {
        --part_count;
      }
    });
    if (part_count != 2 || own.price == kInfinity) return;
    double source = 0.0;
    for (std::int32_t k = 0; k < count_; ++k) source += own.side[k] != 0 ? area(k) : 0.0;
    own.share = std::min(source, all_ - source) / all_;
    keep_better(std::move(own), best);
  }

  static void keep_better(Halves own, Halves& best) {
    if (!(own.share > 0.0)) return;
    const bool is_better =
        own.is_balanced() == best.is_balanced() ? best.share == 0.0 || own.score() < best.score() : own.is_balanced();
    if (is_better) best = std::move(own);
  }

  static constexpr double kJoined = 0.4, kCoarse = 0.6, kTried = 0.9;  // of the work of try_cuts()

  const SlitProblem& problem_;
  const Task& task_;
  Poll poll_;
  PieceBody body_;
  std::int32_t count_;  // triangles
  double all_ = 0.0;    // their area
  std::vector<std::pair<std::int32_t, std::int32_t>> images_;
  bool is_mirrored_ = false;
};

/// Marked edges as slits that have to stay. Chains end where more or fewer than two of the edges meet.
std::vector<Slit> slits_along(const PlanMesh& mesh, std::span<const std::uint8_t> is_marked) {
  std::vector<Edge> marked;
  for (std::int32_t e = 0; index(e) < mesh.edge_count(); ++e) {
    if (is_marked[e] == 0 || mesh.is_real[e] == 0) continue;
    marked.push_back({mesh.tail(mesh.half_edge_of[e]), mesh.tip(mesh.half_edge_of[e])});
  }
  std::vector<Slit> slits;
  EdgeChains chains(mesh.vertex_count(), marked);
  for (const std::vector<std::int32_t>& chain : chains.all([](std::int32_t) { return false; })) {
    std::ranges::move(needed_slits(chain), std::back_inserter(slits));
  }
  return slits;
}

/// Marks the rims of regions in some pieces. Triangles on both sides of an edge belong to the same region if the
/// surface bends there by less than `degrees`.
void mark_rims(const SlitProblem& problem, std::span<const std::int32_t> pieces, double degrees,
               std::vector<std::uint8_t>& is_marked, const Task& task) {
  const PlanMesh& mesh = *problem.mesh;
  const std::vector<FaceFrame> frames = face_frames(mesh, task);
  DisjointSets regions(mesh.face_count());
  std::vector<double> areas(mesh.face_count(), 0.0);
  std::vector<std::size_t> corners(mesh.face_count(), 0);
  Poll poll(task);
  for (const std::int32_t p : pieces) {
    const SlitProblem::Piece& piece = problem.by_piece[p];
    std::vector<std::int32_t> inner;  // half-edges between two triangles of the piece
    for (const std::int32_t f : piece.faces) {
      poll.next();
      for (std::int32_t h = 3 * f; h < 3 * f + 3; ++h) {
        const std::int32_t twin = mesh.twins[h], edge = mesh.edge_of[h];
        if (twin < h || problem.is_seam[edge] != 0) continue;
        inner.push_back(h);
        const Vector &one = frames[f].normal, &other = frames[twin / 3].normal;
        const bool is_smooth = !one.isZero() && !other.isZero() && degrees_between(one, other) < degrees;
        if (is_smooth || problem.prices.of_edge[edge] == kInfinity) regions.join(f, twin / 3);
      }
    }
    for (const std::int32_t f : piece.faces) areas[regions.find(f)] += problem.areas[f];
    for (const std::int32_t h : inner) {
      const std::int32_t one = regions.find(h / 3), other = regions.find(mesh.twins[h] / 3);
      if (one == other) continue;
      ++corners[one];
      ++corners[other];
    }
    const auto is_large = [&](std::int32_t region) {
      return corners[region] >= tuning::kManyCorners && areas[region] >= tuning::kLeastRimmed * piece.area;
    };
    for (const std::int32_t h : inner) {
      const std::int32_t one = regions.find(h / 3), other = regions.find(mesh.twins[h] / 3);
      if (one != other && (is_large(one) || is_large(other))) is_marked[mesh.edge_of[h]] = 1;
    }
  }
}

}  // namespace

bool mark_half(const SlitProblem& problem, std::int32_t piece, std::vector<std::uint8_t>& is_marked, const Task& task) {
  const std::vector<std::int32_t> cut = Halving(problem, piece, task).cut();
  for (const std::int32_t edge : cut) is_marked[edge] = 1;
  const std::int32_t image = image_of(problem, piece);
  if (image >= 0) {
    for (const std::int32_t edge : images_within(problem, cut, image)) is_marked[edge] = 1;
  }
  return !cut.empty();
}

std::vector<Slit> rim_cuts(const SlitProblem& problem, std::span<const std::int32_t> pieces, const Task& task) {
  std::vector<std::uint8_t> is_marked(problem.mesh->edge_count(), 0);
  for (const double degrees : {tuning::kFlatBelow, tuning::kSharpDegrees}) {
    mark_rims(problem, pieces, degrees, is_marked, task);
  }
  return slits_along(*problem.mesh, is_marked);
}

std::size_t count_blocks(const SlitProblem& problem) {
  DisjointSets blocks = joined_faces(*problem.mesh, [&](std::int32_t h) {
    const std::int32_t edge = problem.mesh->edge_of[h];
    return problem.is_seam[edge] == 0 && problem.prices.of_edge[edge] == kInfinity;
  });
  return index(blocks.numbering().count);
}

std::vector<Slit> halving_cuts(SlitProblem problem, std::size_t count, const Task& task) {
  std::vector<std::uint8_t> is_marked(problem.mesh->edge_count(), 0);
  const Task own = part_of(task, 0.0, 0.0);
  // A piece that could not be halved is not tried again as long as it has the same triangles.
  std::set<std::pair<std::int32_t, std::size_t>> whole;  // by first triangle and number of triangles
  const auto is_halved = [&](std::int32_t p) {
    const std::vector<std::int32_t>& faces = problem.by_piece[p].faces;
    if (whole.contains({faces.front(), faces.size()})) return false;
    if (mark_half(problem, p, is_marked, own)) return true;
    whole.emplace(faces.front(), faces.size());
    return false;
  };
  while (index(problem.pieces.count) < count) {
    std::vector<std::int32_t> order(problem.by_piece.size());
    std::iota(order.begin(), order.end(), 0);
    std::ranges::stable_sort(order, std::ranges::greater(), [&](std::int32_t p) { return problem.by_piece[p].area; });
    if (std::ranges::none_of(order, is_halved)) break;
    for (std::size_t e = 0; e < is_marked.size(); ++e) problem.is_seam[e] |= is_marked[e];
    find_pieces_of(problem, own);
  }
  return slits_along(*problem.mesh, is_marked);
}

}  // namespace seamwire::detail
