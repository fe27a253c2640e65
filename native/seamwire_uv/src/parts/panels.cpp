// SPDX-License-Identifier: GPL-3.0-or-later
#include "parts/panels.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <utility>

#include "detail/index.hpp"
#include "detail/poll.hpp"
#include "detail/rounded.hpp"
#include "graph/disjoint_sets.hpp"
#include "parts/minimum_cut.hpp"
#include "seamwire/surface/ray_tree.hpp"
#include "tuning/constants.hpp"

namespace seamwire::detail {
namespace {

constexpr double kAbove = 1e-3;  // rays start this far above a triangle, to miss its neighbors

/// The direction in which the area of each piece spreads least.
std::vector<Vector> thin_directions(const PanelProblem& problem, const Task& task) {
  const PlanMesh& mesh = problem.mesh;
  const std::size_t count = problem.sizes.of_piece.size();
  std::vector<Vector> middles(count, Vector::Zero());
  std::vector<Eigen::Matrix3d> spreads(count, Eigen::Matrix3d::Zero());
  const Poll poll(task);
  const auto visit = [&](const auto& add) {
    for (std::size_t f = 0; f < mesh.face_count(); ++f) {
      poll.at(f);
      const std::int32_t piece = problem.sizes.pieces.of_face[f];
      const double area = problem.sizes.of_piece[piece].area;
      if (area > 0.0) add(piece, mesh.triangles[f], problem.frames[f].area / area);
    }
  };
  visit([&](std::int32_t piece, const Triangle& t, double share) {
    for (const std::int32_t v : t) middles[piece] += share / 3.0 * mesh.points[v];
  });
  visit([&](std::int32_t piece, const Triangle& t, double share) {
    Vector sum = Vector::Zero();
    for (const std::int32_t v : t) {
      const Vector at = mesh.points[v] - middles[piece];
      spreads[piece] += share / 12.0 * at * at.transpose();
      sum += at;
    }
    spreads[piece] += share / 12.0 * sum * sum.transpose();
  });
  std::vector<Vector> found;
  for (const Eigen::Matrix3d& spread : spreads) {
    task.check(0.0);
    found.emplace_back(Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(spread).eigenvectors().col(0));
  }
  return found;
}

/// The direction to the front of each piece, and whether its polygons belong to the sides of their mirror images.
struct Directions {
  std::vector<Vector> of_piece;
  std::vector<std::uint8_t> is_mirrored;
};

Directions find_directions(const PanelProblem& problem, const Task& task) {
  const PieceSizes& sizes = problem.sizes;
  Directions found;
  if (problem.front) {
    found.of_piece.assign(sizes.of_piece.size(), problem.front->stableNormalized());
  } else {
    found.of_piece = thin_directions(problem, task);
  }
  found.is_mirrored.assign(found.of_piece.size(), 0);
  if (!problem.mirror) return found;
  const int axis = *problem.mirror;
  std::vector<std::int32_t> images(found.of_piece.size(), -1), piece_of(problem.polygons.count, -1);
  const Poll poll(task);
  for (std::size_t f = 0; f < problem.mesh.face_count(); ++f) {
    poll.at(f);
    piece_of[problem.polygons.of_face[f]] = sizes.pieces.of_face[f];
  }
  for (std::size_t p = 0; p < problem.images.size(); ++p) {
    if (problem.images[p] >= 0) images[piece_of[p]] = piece_of[problem.images[p]];
  }
  for (std::size_t p = 0; p < images.size(); ++p) {
    const std::int32_t image = images[p];
    if (image < 0) continue;
    Vector& direction = found.of_piece[p];
    if (!problem.front && index(image) != p) {
      found.is_mirrored[p] = 1;
      if (index(image) > p) continue;
      direction = found.of_piece[image];
      direction[axis] = -direction[axis];
    } else if (std::abs(direction[axis]) < std::numbers::sqrt2 / 2.0) {
      found.is_mirrored[p] = 1;
      direction[axis] = 0.0;
      direction.normalize();
    } else {
      direction = Vector::Unit(axis);  // the two sides are images of each other
    }
  }
  return found;
}

/// A connection of two nodes, over one edge.
struct PanelLink {
  std::int32_t edge = -1, one = -1, other = -1;
  double price = 0.0;
};

/// Divides the nodes of a mesh: polygons, with their mirror images.
class PanelCut {
 public:
  PanelCut(const PanelProblem& problem, const Task& task) : problem_(problem), task_(task) {
    find_nodes();
    find_links();
    lines_ = find_lines(problem.mesh, problem.polygons, task);
  }

  std::vector<std::uint8_t> run() {
    std::vector<double> shares(problem_.mesh.edge_count(), 1.0);
    for (int round = 0; round < tuning::kPanelRounds; ++round) {
      divide(shares);
      discount(shares);
    }
    join_small();
    std::vector<std::uint8_t> is_found(problem_.mesh.edge_count(), 0);
    for (const PanelLink& link : links_) is_found[link.edge] = side_[link.one] != side_[link.other] ? 1 : 0;
    return is_found;
  }

 private:
  void find_nodes() {
    const PlanMesh& mesh = problem_.mesh;
    const Directions directions = find_directions(problem_, task_);
    DisjointSets sets(problem_.polygons.count);
    const Poll poll(task_);
    for (std::size_t f = 0; !problem_.images.empty() && f < mesh.face_count(); ++f) {
      poll.at(f);
      const std::int32_t p = problem_.polygons.of_face[f], image = problem_.images[p];
      if (image >= 0 && directions.is_mirrored[problem_.sizes.pieces.of_face[f]] != 0) sets.join(p, image);
    }
    auto [of, count] = sets.numbering();
    node_of_ = std::move(of);
    facing_.assign(index(count), 0.0);
    areas_.assign(index(count), 0.0);
    const RayTree rays(mesh.points, mesh.triangles);
    rays.wait(task_);
    for (std::size_t f = 0; f < mesh.face_count(); ++f) {
      poll.at(f);
      const std::int32_t piece = problem_.sizes.pieces.of_face[f], node = node_of_[problem_.polygons.of_face[f]];
      const auto& [diagonal, area] = problem_.sizes.of_piece[piece];
      if (problem_.is_chosen[piece] == 0 || !(area > 0.0)) continue;
      const double share = rounded(problem_.frames[f].area / area);
      areas_[node] += share;
      const Vector &normal = problem_.frames[f].normal, &front = directions.of_piece[piece];
      const double facing = rounded_share(normal.dot(front));
      const auto& [a, b, c] = mesh.triangles[f];
      const Vector origin = (mesh.points[a] + mesh.points[b] + mesh.points[c]) / 3.0 + kAbove * diagonal * normal;
      if (!rays.is_met(origin, facing > 0.0 ? front : -front)) facing_[node] += share * facing;
    }
  }

  void find_links() {
    const PlanMesh& mesh = problem_.mesh;
    const Poll poll(task_);
    for (std::int32_t e = 0; index(e) < mesh.edge_count(); ++e) {
      poll.at(index(e));
      const std::int32_t h = mesh.half_edge_of[e], twin = mesh.twins[h];
      const std::int32_t piece = problem_.sizes.piece_of(mesh, e);
      if (twin < 0 || problem_.is_seam[e] != 0 || problem_.is_chosen[piece] == 0) continue;
      const std::int32_t one = node_of_[problem_.polygons.of_face[h / 3]];
      const std::int32_t other = node_of_[problem_.polygons.of_face[twin / 3]];
      const double diagonal = problem_.sizes.of_piece[piece].diagonal;
      if (one == other || !(diagonal > 0.0)) continue;
      links_.push_back({e, one, other, price_of_cut(problem_.odds[e]) * mesh.lengths[e] / diagonal});
    }
  }

  /// Finds the cheapest cut, for shares of the prices of edges.
  void divide(std::span<const double> shares) {
    const auto count = static_cast<std::int32_t>(facing_.size());
    MinimumCut cut(facing_.size() + 2);
    for (std::int32_t n = 0; n < count; ++n) {
      const double weight = tuning::kPanelFacing * std::abs(facing_[n]);
      if (weight > 0.0) cut.add(facing_[n] > 0.0 ? count : count + 1, n, weight);
    }
    for (const PanelLink& link : links_) cut.add(link.one, link.other, shares[link.edge] * link.price);
    side_ = cut.source_side(count, count + 1, task_);
  }

  /// The share of their price that edges cost in the next round: less, the more of their line lies on the cut.
  void discount(std::vector<double>& shares) const {
    const PlanMesh& mesh = problem_.mesh;
    std::vector<double> used(mesh.edge_count(), 0.0);
    for (const PanelLink& link : links_) {
      const double diagonal = problem_.sizes.of_piece[problem_.sizes.piece_of(mesh, link.edge)].diagonal;
      if (side_[link.one] != side_[link.other]) used[link.edge] = mesh.lengths[link.edge] / diagonal;
    }
    for (const std::vector<std::int32_t>& line : lines_) {
      double length = 0.0;
      for (const std::int32_t e : line) length += used[e];
      for (const std::int32_t e : line) shares[e] = 1.0 / (1.0 + length / tuning::kPanelLine);
    }
  }

  /// Gives small connected parts of a side to the other side, each before its larger neighbors.
  void join_small() {
    const std::size_t count = areas_.size();
    for (bool is_done = false; !is_done;) {
      task_.check(0.0);
      is_done = true;
      DisjointSets sets(count);
      for (const PanelLink& link : links_) {
        if (side_[link.one] == side_[link.other]) sets.join(link.one, link.other);
      }
      std::vector<double> areas(count, 0.0);
      for (std::int32_t n = 0; index(n) < count; ++n) areas[sets.find(n)] += areas_[n];
      std::vector<std::uint8_t> is_joined(count, 0), has_smaller(count, 0);
      for (const PanelLink& link : links_) {
        if (side_[link.one] == side_[link.other]) continue;
        const std::int32_t one = sets.find(link.one), other = sets.find(link.other);
        const bool is_smaller = std::pair(areas[one], one) < std::pair(areas[other], other);
        has_smaller[is_smaller ? other : one] = 1;
        is_joined[is_smaller ? one : other] = 1;
      }
      for (std::int32_t n = 0; index(n) < count; ++n) {
        const std::int32_t part = sets.find(n);
        if (is_joined[part] == 0 || has_smaller[part] != 0 || areas[part] >= tuning::kLeastOfPanels) continue;
        side_[n] = side_[n] != 0 ? 0 : 1;
        is_done = false;
      }
    }
  }

  const PanelProblem& problem_;
  const Task& task_;
  std::vector<std::int32_t> node_of_;  // of each polygon
  std::vector<double> facing_;         // of each node: the area that the front sees, less what the back sees
  std::vector<double> areas_;          // of each node, in areas of its piece
  std::vector<PanelLink> links_;
  std::vector<std::vector<std::int32_t>> lines_;
  std::vector<std::uint8_t> side_;  // of each node: 1 in front
};

}  // namespace

std::vector<std::uint8_t> find_garments(const PlanMesh& mesh, const Polygons& polygons, const PieceSizes& sizes,
                                        const EdgeBends& bends, const Task& task) {
  std::vector<double> sharp(sizes.of_piece.size(), 0.0), all = sharp;
  std::vector<std::int32_t> boundaries(sizes.of_piece.size(), 0);
  DisjointSets loops(mesh.vertex_count());
  const Poll poll(task);
  for (std::int32_t e = 0; index(e) < mesh.edge_count(); ++e) {
    poll.at(index(e));
    const std::int32_t h = mesh.half_edge_of[e], piece = sizes.piece_of(mesh, e);
    if (mesh.is_boundary(e)) {
      boundaries[piece] += loops.join(mesh.tail(h), mesh.tip(h)) ? 0 : 1;  // the last edge of each loop
    } else if (polygons.is_diagonal[e] == 0) {
      all[piece] += mesh.lengths[e];
      if (std::abs(bends.own[e]) > tuning::kSharpDegrees) sharp[piece] += mesh.lengths[e];
    }
  }
  std::vector<std::uint8_t> found;
  for (std::size_t p = 0; p < sharp.size(); ++p) {
    found.push_back(boundaries[p] >= tuning::kGarmentBoundaries && sharp[p] <= tuning::kGarmentSharp * all[p] ? 1 : 0);
  }
  return found;
}

std::vector<std::uint8_t> find_panels(const PanelProblem& problem, const Task& task) {
  return PanelCut(problem, task).run();
}

}  // namespace seamwire::detail
