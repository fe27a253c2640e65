// SPDX-License-Identifier: GPL-3.0-or-later
#include "prices/border_odds.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <tuple>
#include <utility>

#include "detail/csr.hpp"
#include "detail/index.hpp"
#include "detail/infinity.hpp"
#include "detail/poll.hpp"
#include "detail/rounded.hpp"
#include "graph/disjoint_sets.hpp"
#include "maps/degrees_between.hpp"
#include "maps/quad_skew.hpp"
#include "tuning/constants.hpp"

namespace seamwire::detail {
namespace {

constexpr std::size_t kMostEdges = 24;  // around a vertex; lines end at the middle of larger fans

/// The box around some points that has the least diagonal of all directions. A box along the axes would depend on how
/// the points are turned.
class LeastBox {
 public:
  LeastBox(std::span<const Vector> points, std::span<const std::int32_t> chosen) {
    if (chosen.empty()) return;
    Vector middle = Vector::Zero();
    for (const std::int32_t v : chosen) middle += points[v] / static_cast<double>(chosen.size());
    Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
    for (const std::int32_t v : chosen) spread += (points[v] - middle) * (points[v] - middle).transpose();
    axes_ = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(spread).eigenvectors();
    if (chosen.size() <= kMostPoints) {
      for (const std::int32_t v : chosen) points_.push_back(points[v] - middle);
      return;
    }
    for (int i = 0; i < kDirections; ++i) {  // on a sphere, spread evenly (Fibonacci spiral)
      const double height = (2.0 * i + 1.0) / kDirections - 1.0, turn = i * std::numbers::pi * (3.0 - std::sqrt(5.0));
      const double radius = std::sqrt(1.0 - height * height);
      const Vector direction = axes_ * Vector(radius * std::cos(turn), radius * std::sin(turn), height);
      const auto along = [&](std::int32_t v) { return points[v].dot(direction); };
      points_.push_back(points[*std::ranges::max_element(chosen, {}, along)] - middle);
    }
  }

  double diagonal() const {
    if (points_.empty()) return 0.0;
    Eigen::Matrix3d best = axes_;
    double least = squared_diagonal(best);
    const auto turn = [&](const Eigen::Matrix3d& from, int axis, double angle) {
      const Eigen::Matrix3d turned = from * Eigen::AngleAxisd(angle, Vector::Unit(axis)).toRotationMatrix();
      const double squared = squared_diagonal(turned);
      if (!(squared < least)) return false;
      least = squared;
      best = turned;
      return true;
    };
    constexpr int kSteps = 12;
    for (int axis = 0; axis < 6; ++axis) {
      const Eigen::Matrix3d start = best;
      for (int step = 1; step < kSteps; ++step) turn(start, axis % 3, 0.5 * std::numbers::pi * step / kSteps);
    }
    constexpr double kFinest = 1e-6;
    for (double angle = 0.1; angle > kFinest;) {
      bool is_better = false;
      for (int axis = 0; axis < 3; ++axis) is_better = turn(best, axis, angle) || turn(best, axis, -angle) || is_better;
      if (!is_better) angle *= 0.5;
    }
    return std::sqrt(least);
  }

 private:
  static constexpr std::size_t kMostPoints = 400;
  static constexpr int kDirections = 120;

  double squared_diagonal(const Eigen::Matrix3d& axes) const {
    Eigen::AlignedBox3d box;
    for (const Vector& point : points_) box.extend(Vector(axes.transpose() * point));
    return box.diagonal().squaredNorm();
  }

  Eigen::Matrix3d axes_ = Eigen::Matrix3d::Identity();  // principal ones
  std::vector<Vector> points_;
};

class BendFinder {
 public:
  BendFinder(const PlanMesh& mesh, std::span<const FaceFrame> frames) : mesh_(mesh), frames_(frames) {}

  double degrees(std::int32_t e) const {
    const std::int32_t h = mesh_.half_edge_of[e], twin = mesh_.twins[h];
    const Vector &one = frames_[h / 3].normal, &other = frames_[twin / 3].normal;
    const double angle = degrees_between(one, other);
    const Vector along = mesh_.points[mesh_.tip(h)] - mesh_.points[mesh_.tail(h)];
    return one.cross(other).dot(along) < 0.0 ? -angle : angle;
  }

  /// Between the normals of the faces that one reaches by going straight away from an edge on both sides.
  double wide_degrees(std::int32_t e, double distance) const {
    const std::int32_t h = mesh_.half_edge_of[e], twin = mesh_.twins[h];
    return degrees_between(normal_at(h, distance), normal_at(twin, distance));
  }

 private:
  /// The normal at a distance from the middle of a half-edge, in the plane across it.
  Vector normal_at(std::int32_t h, double distance) const {
    const Vector across = (mesh_.points[mesh_.tip(h)] - mesh_.points[mesh_.tail(h)]).normalized();
    Vector at = 0.5 * (mesh_.points[mesh_.tip(h)] + mesh_.points[mesh_.tail(h)]);
    const Vector middle = at;
    constexpr double kFlat = 1e-5;
    const double flat = kFlat * mesh_.lengths[mesh_.edge_of[h]];
    const auto height = [&](std::int32_t v) { return (mesh_.points[v] - middle).dot(across); };
    constexpr int kMostTriangles = 64;
    double gone = 0.0;
    for (int i = 0; i < kMostTriangles; ++i) {
      const std::int32_t first = 3 * (h / 3), k = h % 3;
      const std::int32_t tip = mesh_.apex(h);
      // Leave through the side whose ends lie on both sides of the plane.
      const double own = height(tip);
      const double end = height(mesh_.tip(h));
      // A corner on the plane counts as below it, though it is a little above by rounding.
      const bool is_next = (own > flat) != (end > flat);
      const std::int32_t side = first + (is_next ? (k + 1) % 3 : (k + 2) % 3);
      const double a = height(mesh_.tail(side)), b = height(mesh_.tip(side));
      const double t = a != b ? std::clamp(a / (a - b), 0.0, 1.0) : 0.5;
      const Vector to =
          mesh_.points[mesh_.tail(side)] + t * (mesh_.points[mesh_.tip(side)] - mesh_.points[mesh_.tail(side)]);
      gone += (to - at).norm();
      at = to;
      if (gone >= distance || mesh_.twins[side] < 0) break;
      h = mesh_.twins[side];
    }
    return frames_[h / 3].normal;
  }

  const PlanMesh& mesh_;
  std::span<const FaceFrame> frames_;
};

/// The mean of a value over the line of each edge.
std::vector<double> means_along(const PlanMesh& mesh, const std::vector<std::vector<std::int32_t>>& lines,
                                const std::vector<double>& values, const Task& task) {
  Poll poll(task);
  std::vector<double> means = values;
  for (const std::vector<std::int32_t>& line : lines) {
    poll.next();
    double sum = 0.0, length = 0.0;
    for (const std::int32_t e : line) {
      sum += mesh.lengths[e] * values[e];
      length += mesh.lengths[e];
    }
    if (!(length > 0.0)) continue;
    for (const std::int32_t e : line) means[e] = sum / length;
  }
  return means;
}

/// Calls visit(polygon) for the polygons on both sides of an edge.
template <class Visit>
void for_sides(const PlanMesh& mesh, const Polygons& polygons, std::int32_t e, const Visit& visit) {
  const std::int32_t h = mesh.half_edge_of[e], twin = mesh.twins[h];
  visit(polygons.of_face[h / 3]);
  if (twin >= 0) visit(polygons.of_face[twin / 3]);
}

/// For each edge the sharpest other edge of the polygons on both sides.
std::vector<double> sharpest_beside(const PlanMesh& mesh, const Polygons& polygons, std::span<const double> sharp,
                                    const Task& task) {
  const Poll poll(task);
  std::vector<std::array<double, 2>> sharpest(polygons.count, {0.0, 0.0});
  std::vector<std::int32_t> edge(polygons.count, -1);
  for (std::int32_t e = 0; index(e) < mesh.edge_count(); ++e) {
    poll.at(index(e));
    if (polygons.is_diagonal[e] != 0) continue;
    for_sides(mesh, polygons, e, [&](std::int32_t p) {
      auto& [most, second] = sharpest[p];
      if (edge[p] < 0 || sharp[e] > most) {
        second = std::exchange(most, sharp[e]);
        edge[p] = e;
      } else {
        second = std::max(second, sharp[e]);
      }
    });
  }
  std::vector<double> beside(mesh.edge_count(), 0.0);
  for (std::int32_t e = 0; index(e) < mesh.edge_count(); ++e) {
    poll.at(index(e));
    for_sides(mesh, polygons, e,
              [&](std::int32_t p) { beside[e] = std::max(beside[e], edge[p] == e ? sharpest[p][1] : sharpest[p][0]); });
  }
  return beside;
}

/// Whether the surface bends on alike at the opposite edges of both polygons beside an edge, as around a tube.
std::vector<std::uint8_t> are_round(const PlanMesh& mesh, const Polygons& polygons, std::span<const double> bends,
                                    const Task& task) {
  const Poll poll(task);
  const Csr<std::int32_t> around(polygons.count, [&](const auto& visit) {
    for (std::int32_t e = 0; index(e) < mesh.edge_count(); ++e) {
      poll.at(index(e));
      if (polygons.is_diagonal[e] == 0) for_sides(mesh, polygons, e, [&](std::int32_t p) { visit(p, e); });
    }
  });
  const auto share_vertex = [&](std::int32_t one, std::int32_t other) {
    const std::int32_t g = mesh.half_edge_of[one], h = mesh.half_edge_of[other];
    return mesh.tail(g) == mesh.tail(h) || mesh.tail(g) == mesh.tip(h) || mesh.tip(g) == mesh.tail(h) ||
           mesh.tip(g) == mesh.tip(h);
  };
  std::vector<std::uint8_t> found(mesh.edge_count(), 0);
  for (std::int32_t e = 0; index(e) < mesh.edge_count(); ++e) {
    poll.at(index(e));
    if (polygons.is_diagonal[e] != 0 || mesh.is_boundary(e)) continue;
    bool is_round = true;
    for_sides(mesh, polygons, e, [&](std::int32_t p) {
      is_round = is_round && around[p].size() == 4 && std::ranges::any_of(around[p], [&](std::int32_t other) {
                   const double ratio = bends[other] / bends[e];
                   return !share_vertex(e, other) && ratio > 1.0 / tuning::kAlikeBends && ratio < tuning::kAlikeBends;
                 });
    });
    found[e] = is_round ? 1 : 0;
  }
  return found;
}

/// How open each edge is to the sky, less the mean over its piece.
std::vector<double> openness_of(const PlanMesh& mesh, const PieceSizes& sizes, std::span<const double> ambient,
                                const Task& task) {
  const Poll poll(task);
  std::vector<double> openness, sums(sizes.of_piece.size(), 0.0), lengths = sums;
  for (std::int32_t e = 0; index(e) < mesh.edge_count(); ++e) {
    poll.at(index(e));
    const std::int32_t h = mesh.half_edge_of[e];
    openness.push_back(0.5 * (ambient[mesh.tail(h)] + ambient[mesh.tip(h)]));
    sums[sizes.piece_of(mesh, e)] += mesh.lengths[e] * openness.back();
    lengths[sizes.piece_of(mesh, e)] += mesh.lengths[e];
  }
  for (std::int32_t e = 0; index(e) < mesh.edge_count(); ++e) {
    poll.at(index(e));
    const std::int32_t piece = sizes.piece_of(mesh, e);
    if (lengths[piece] > 0.0) openness[e] -= sums[piece] / lengths[piece];
  }
  return openness;
}

/// Gives edges that are mirror images of each other the mean of their values.
void make_symmetric(const PlanMesh& mesh, const Polygons& polygons, const Reflection& reflection,
                    std::vector<double>& values, const Task& task) {
  const Poll poll(task);
  const std::vector<double> own = values;
  for (std::int32_t e = 0; index(e) < mesh.edge_count(); ++e) {
    poll.at(index(e));
    const std::int32_t image = image_of_edge(mesh, reflection, e);
    if (image >= 0 && polygons.is_diagonal[image] == polygons.is_diagonal[e]) values[e] = 0.5 * (own[e] + own[image]);
  }
}

}  // namespace

Polygons find_polygons(const PlanMesh& mesh, std::span<const std::uint8_t> is_border, const Task& task) {
  Poll poll(task);
  DisjointSets sets(mesh.face_count());
  std::vector<std::uint8_t> is_alone(mesh.face_count(), 1);
  for (std::int32_t e = 0; index(e) < mesh.edge_count(); ++e) {
    const std::int32_t h = mesh.half_edge_of[e], twin = mesh.twins[h];
    poll.next();
    if (mesh.is_real[e] != 0 || twin < 0) continue;
    sets.join(h / 3, twin / 3);
    is_alone[h / 3] = is_alone[twin / 3] = 0;
  }
  std::vector<std::tuple<double, std::int32_t>> pairs;
  for (std::int32_t e = 0; index(e) < mesh.edge_count(); ++e) {
    const std::int32_t h = mesh.half_edge_of[e], twin = mesh.twins[h];
    poll.next();
    if (twin < 0 || is_alone[h / 3] == 0 || is_alone[twin / 3] == 0) continue;
    if (!is_border.empty() && is_border[e] != 0) continue;
    const double skew = quad_skew(
        {mesh.points[mesh.tail(h)], mesh.points[mesh.apex(twin)], mesh.points[mesh.tip(h)], mesh.points[mesh.apex(h)]});
    if (skew != kInfinity) pairs.emplace_back(skew, e);
  }
  polled_sort(pairs, Poll(task));
  for (const auto& [skew, e] : pairs) {
    poll.next();
    const std::int32_t h = mesh.half_edge_of[e], twin = mesh.twins[h];
    if (is_alone[h / 3] == 0 || is_alone[twin / 3] == 0) continue;
    sets.join(h / 3, twin / 3);
    is_alone[h / 3] = is_alone[twin / 3] = 0;
  }
  auto [of_face, count] = sets.numbering();
  Polygons found{.of_face = std::move(of_face), .is_diagonal = {}, .count = index(count)};
  for (const std::int32_t h : mesh.half_edge_of) {
    const std::int32_t twin = mesh.twins[h];
    found.is_diagonal.push_back(twin >= 0 && found.of_face[h / 3] == found.of_face[twin / 3] ? 1 : 0);
  }
  return found;
}

bool take_apart(const PlanMesh& mesh, std::span<const std::uint8_t> is_apart, Polygons& polygons, const Task& task) {
  const Poll poll(task);
  const auto is_of_polygon = [&](std::int32_t f) {
    const auto is_inner = [&](std::int32_t h) { return mesh.is_real[mesh.edge_of[h]] == 0 && mesh.twins[h] >= 0; };
    return is_inner(3 * f) || is_inner(3 * f + 1) || is_inner(3 * f + 2);
  };
  const std::size_t before = polygons.count;
  for (std::int32_t e = 0; index(e) < mesh.edge_count(); ++e) {
    const std::int32_t h = mesh.half_edge_of[e];
    poll.at(index(e));
    if (is_apart[e] == 0 || polygons.is_diagonal[e] == 0 || is_of_polygon(h / 3)) continue;
    polygons.is_diagonal[e] = 0;
    polygons.of_face[h / 3] = static_cast<std::int32_t>(polygons.count++);
  }
  return polygons.count > before;
}

std::vector<std::vector<std::int32_t>> find_lines(const PlanMesh& mesh, const Polygons& polygons, const Task& task) {
  Poll poll(task, Poll::kFewSteps);
  const auto sides = [&](std::int32_t e) {
    const std::int32_t h = mesh.half_edge_of[e], twin = mesh.twins[h];
    return std::array{polygons.of_face[h / 3], twin < 0 ? -1 : polygons.of_face[twin / 3]};
  };
  const auto share_polygon = [&](std::int32_t one, std::int32_t other) {
    const auto [a, b] = sides(one);
    const auto [c, d] = sides(other);
    return a == c || a == d || (b >= 0 && (b == c || b == d));
  };
  // The edge on which each edge goes on: at the start of its half-edge, and at the end.
  std::vector<std::array<std::int32_t, 2>> next(mesh.edge_count(), {-1, -1});
  std::vector<PlanNeighbor> around;
  std::vector<std::int32_t> choice;
  const auto end_at = [&](std::int32_t e, std::int32_t v) { return mesh.tail(mesh.half_edge_of[e]) == v ? 0 : 1; };
  for (std::int32_t v = 0; index(v) < mesh.vertex_count(); ++v) {
    poll.next();
    around.clear();
    for (const PlanNeighbor& neighbor : mesh.neighbors[v]) {
      if (polygons.is_diagonal[neighbor.edge] == 0) around.push_back(neighbor);
    }
    if (around.size() > kMostEdges) continue;
    choice.assign(around.size(), -1);
    for (std::size_t i = 0; i < around.size(); ++i) {
      const Vector in = mesh.points[v] - mesh.points[around[i].vertex];
      double least = tuning::kMostTurn;
      for (std::size_t k = 0; k < around.size(); ++k) {
        if (k == i) continue;
        const double turn = degrees_between(in, mesh.points[around[k].vertex] - mesh.points[v]);
        const bool is_opposite =
            around.size() == 4 && !mesh.is_boundary(around[i].edge) && !share_polygon(around[i].edge, around[k].edge);
        if (is_opposite && turn < tuning::kOverVertex) {
          choice[i] = static_cast<std::int32_t>(k);
          break;
        }
        if (turn < least) {
          least = turn;
          choice[i] = static_cast<std::int32_t>(k);
        }
      }
    }
    for (std::size_t i = 0; i < around.size(); ++i) {
      if (choice[i] >= 0 && index(choice[choice[i]]) == i) {
        next[around[i].edge][end_at(around[i].edge, v)] = around[choice[i]].edge;
      }
    }
  }
  std::vector<std::uint8_t> is_taken(mesh.edge_count(), 0);
  std::vector<std::vector<std::int32_t>> lines;
  for (std::int32_t first = 0; index(first) < mesh.edge_count(); ++first) {
    poll.next();
    if (polygons.is_diagonal[first] != 0 || is_taken[first] != 0) continue;
    is_taken[first] = 1;
    std::vector<std::int32_t> edges{first};
    for (const int end : {0, 1}) {
      std::int32_t e = first;
      const std::int32_t h = mesh.half_edge_of[first];
      std::int32_t v = end == 0 ? mesh.tail(h) : mesh.tip(h);
      for (;;) {
        const std::int32_t following = next[e][end_at(e, v)];
        if (following < 0 || is_taken[following] != 0) break;
        is_taken[following] = 1;
        edges.push_back(following);
        e = following;
        const std::int32_t own = mesh.half_edge_of[e];
        v = mesh.tail(own) == v ? mesh.tip(own) : mesh.tail(own);
      }
      if (end == 0) std::ranges::reverse(edges);
    }
    lines.push_back(std::move(edges));
  }
  return lines;
}

PieceSizes measure_pieces(const PlanMesh& mesh, std::span<const FaceFrame> frames, const Task& task) {
  PieceSizes sizes{find_pieces(mesh, std::vector<std::uint8_t>(mesh.edge_count(), 0), task), {}};
  std::vector<std::vector<std::int32_t>> vertices(index(sizes.pieces.count));
  sizes.of_piece.resize(vertices.size());
  std::vector<std::uint8_t> is_known(mesh.vertex_count(), 0);
  const Poll poll(task);
  for (std::size_t f = 0; f < mesh.face_count(); ++f) {
    poll.at(f);
    const std::int32_t piece = sizes.pieces.of_face[f];
    for (const std::int32_t v : mesh.triangles[f]) {
      if (std::exchange(is_known[v], std::uint8_t{1}) == 0) vertices[piece].push_back(v);
    }
    sizes.of_piece[piece].area += frames[f].area;
  }
  for (std::size_t p = 0; p < vertices.size(); ++p) {
    task.check(0.0);
    sizes.of_piece[p].area = rounded(sizes.of_piece[p].area);
    sizes.of_piece[p].diagonal = rounded(LeastBox(mesh.points, vertices[p]).diagonal());
  }
  return sizes;
}

EdgeBends bends_over_edges(const PlanMesh& mesh, std::span<const FaceFrame> frames, const Polygons& polygons,
                           const PieceSizes& sizes, const Task& task) {
  EdgeBends found{std::vector<double>(mesh.edge_count(), 0.0), std::vector<double>(mesh.edge_count(), 0.0)};
  const BendFinder bends(mesh, frames);
  const Poll poll(task, Poll::kFewSteps);
  for (std::int32_t e = 0; index(e) < mesh.edge_count(); ++e) {
    poll.at(index(e));
    if (mesh.is_boundary(e) || polygons.is_diagonal[e] != 0) continue;
    found.own[e] = bends.degrees(e);
    found.wide[e] = bends.wide_degrees(e, tuning::kWideReach * sizes.of_piece[sizes.piece_of(mesh, e)].diagonal);
  }
  return found;
}

double sharp_share(const PlanMesh& mesh, const EdgeBends& bends) {
  double sharp = 0.0, all = 0.0;
  for (std::size_t e = 0; e < mesh.edge_count(); ++e) {
    const double bend = mesh.lengths[e] * std::abs(bends.own[e]);
    all += bend;
    if (std::abs(bends.own[e]) > tuning::kSharpDegrees) sharp += bend;
  }
  return all > 0.0 ? sharp / all : 0.0;
}

std::vector<double> border_odds(const PlanMesh& mesh, const Polygons& polygons, const PieceSizes& sizes,
                                const EdgeBends& bends, std::span<const double> ambient,
                                std::span<const std::uint8_t> is_marked, const Reflection* reflection, double on_plane,
                                const Task& task) {
  std::vector<double> sharp;
  for (const double bend : bends.own) sharp.push_back(std::abs(bend));
  const std::vector<double> on_line = means_along(mesh, find_lines(mesh, polygons, task), sharp, task);
  const std::vector<double> beside = sharpest_beside(mesh, polygons, sharp, task);
  const std::vector<std::uint8_t> is_round = are_round(mesh, polygons, bends.own, task);
  const std::vector<double> openness = openness_of(mesh, sizes, ambient, task);
  const auto is_on_plane = [&](std::int32_t e) {
    const std::int32_t h = mesh.half_edge_of[e];
    return reflection != nullptr && reflection->sides[mesh.tail(h)] == 0 && reflection->sides[mesh.tip(h)] == 0;
  };
  std::vector<double> odds(mesh.edge_count(), -kInfinity);
  const Poll poll(task);
  for (std::int32_t e = 0; index(e) < mesh.edge_count(); ++e) {
    poll.at(index(e));
    if (polygons.is_diagonal[e] != 0) continue;
    const double wider = std::clamp(bends.wide[e] - sharp[e], 0.0, tuning::kMostSteps * sharp[e]);
    const double bend =
        sharp[e] + tuning::kLineShare * on_line[e] + (is_round[e] != 0 ? 0.0 : tuning::kWideShare * wider);
    odds[e] = (bend - tuning::kEvenDegrees) / tuning::kDegreesOfOdds - tuning::kOpenness * openness[e];
    if (sharp[e] < beside[e] - tuning::kSharperBy) odds[e] -= tuning::kBesideSharper;
    if (bends.own[e] < -tuning::kConcaveDegrees) odds[e] += tuning::kConcave;
    if (is_on_plane(e) && is_round[e] == 0) odds[e] += on_plane;
    if (is_marked[e] != 0) odds[e] += tuning::kMarked;
  }
  if (reflection != nullptr && reflection->is_exact) make_symmetric(mesh, polygons, *reflection, odds, task);
  return odds;
}

double price_of_cut(double odds) { return std::log1p(std::exp(-std::max(odds, -tuning::kMostOdds))); }

}  // namespace seamwire::detail
