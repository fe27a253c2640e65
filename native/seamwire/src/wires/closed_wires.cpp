// SPDX-License-Identifier: GPL-3.0-or-later
#include "seamwire/wires/closed_wires.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <optional>
#include <string>
#include <unordered_map>
#include <unordered_set>
#include <utility>
#include <vector>

#include "detail/index.hpp"
#include "detail/infinity.hpp"
#include "detail/poll.hpp"
#include "graph/cotree.hpp"
#include "graph/disjoint_sets.hpp"
#include "surface/exact_unit.hpp"
#include "wires/loop_parts.hpp"
#include "wires/path_position.hpp"
#include "wires/polyline.hpp"
#include "wires/spanning_tree.hpp"

namespace seamwire {

using namespace detail;

namespace {

/// Of the area of a part of the surface: what a loop has on its smaller side at least.
constexpr double kLeastArea = 0.003;
/// The direction of a wire is that of its beginning, so long, in the unit cube, but no more than this part of the wire.
constexpr double kBeginning = 0.02, kMostOfWire = 0.25;
/// What ln L of a loop may be more than the best J, for J to be asked for: J is ln L and at most 2.
constexpr double kFartherThanBest = 1.0;
/// A loop that turns more goes back the way it came.
constexpr double kMostTurn = 2.0;
/// How much a minimum of J lies below the pass to a lower one.
constexpr double kLeastPersistence = 0.05;
/// The least excess of the angles of a loop's triangle (the seed and the ends of the edge) over those of a flat
/// triangle. The excess is the curvature that the loop encloses (Gauss-Bonnet).
constexpr double kLeastExcess = 0.5;
/// Of a loop's length: how far the middles of its two halves are from each other at least, and two loops on average.
constexpr double kLeastWidth = 0.02, kLeastApart = 0.03;
/// Of a loop's length: how far from the place where its halves meet other wires are looked at, and how many at most.
constexpr double kAround = 0.03;
constexpr std::size_t kMostAround = 96;
/// Wires leave in all directions if no two that are neighbors are further apart.
constexpr double kLargestGap = std::numbers::pi / 3;
/// Points along a loop at which its distance from another one is measured.
constexpr std::size_t kSamples = 64;

/// A bijection that scatters numbers (the finalizer of SplitMix64, Steele, Lea, Flood, 2014).
std::uint64_t scattered(std::uint64_t x) {
  x += 0x9e3779b97f4a7c15U;
  x = (x ^ (x >> 30U)) * 0xbf58476d1ce4e5b9U;
  x = (x ^ (x >> 27U)) * 0x94d049bb133111ebU;
  return x ^ (x >> 31U);
}

/// A loop of the cut locus, by the edge at which its halves meet.
struct CutEdge {
  std::int32_t half_edge;
  double length;  // L, in the metric
  bool separates;
};

/// An edge that is not in the tree of the vertices, and the faces at it. It closes a loop of that tree.
struct Closing {
  std::uint64_t key;  // the longest first
  std::int32_t half_edge;
  std::int32_t a, b;
};

Vector point_at(const std::vector<Vector>& line, double distance) {
  for (std::size_t i = 1; i < line.size(); ++i) {
    const double step = (line[i] - line[i - 1]).norm();
    if (distance < step) return line[i - 1] + (distance / step) * (line[i] - line[i - 1]);
    distance -= step;
  }
  return line.back();
}

/// Faces at an edge with siblings count as one. Empty without such edges.
DisjointSets joined_over_siblings(const IntrinsicMesh& mesh, std::size_t count) {
  DisjointSets joined(mesh.siblings.empty() ? 0 : count);
  for (std::int32_t h = 0; index(h) < mesh.siblings.size(); ++h) {
    if (mesh.has_siblings(h)) joined.join(h / 3, mesh.siblings[h] / 3);
  }
  return joined;
}

/// The tree of the faces joins the faces of each part over edges that are not in the tree of the vertices. It is the
/// spanning tree whose L are largest. Each of its edges, and each edge that is in neither tree, closes a loop of the
/// tree of the vertices. The faces on one side of that loop are those below the edge in the tree of the faces. If an
/// edge of neither tree leads from one side to the other, the loop does not separate.
class FaceTree {
 public:
  /// The edges must be sorted by their keys, and outlive the tree. Areas are those of the faces.
  FaceTree(const std::vector<double>& areas, const std::vector<Closing>& closing, const Task& task)
      : closing_(closing),
        task_(task),
        faces_(areas.size()),
        tree_(
            areas.size(), closing.size(), [&](std::size_t i) { return std::pair(closing[i].a, closing[i].b); },
            Poll(task, 0.45, 0.55, closing.size())) {
    for (std::size_t f = 0; f < areas.size(); ++f) faces_[f].area = areas[f];
    for (const std::int32_t edge : tree_.crossed) {
      for (const std::int32_t f : {closing[edge].a, closing[edge].b}) {
        ++faces_[f].degree;
        faces_[f].edges ^= edge;
      }
    }
    for (const std::int32_t edge : tree_.generators) {
      const std::uint64_t hash = scattered(index(edge));
      faces_[closing[edge].a].crossing ^= hash;
      faces_[closing[edge].b].crossing ^= hash;
    }
  }

  /// Calls visit(i, separates) for each edge i that closes a loop with enough area on both sides, or a loop that does
  /// not separate.
  template <class Visit>
  void for_each_loop(const Visit& visit) {
    const std::vector<Cut> cuts = take_leaves();
    const std::vector<double> whole = whole_areas();
    Poll poll(task_, 0.58, 0.6, cuts.size());
    for (const auto& [edge, hanging] : cuts) {
      poll.next();
      const bool separates = faces_[hanging].crossing == 0;
      const double all = whole[tree_.parts.find(hanging)];
      const double side = std::min(faces_[hanging].area, all - faces_[hanging].area);
      if (!separates || side >= kLeastArea * all) visit(edge, separates);
    }
    for (const std::int32_t edge : tree_.generators) visit(edge, false);
  }

 private:
  // Edges of the tree are found from its leaves on: a leaf has one, the sum (bit by bit) of all its edges.
  struct Face {
    double area = 0.0;
    std::uint64_t crossing = 0;
    std::int32_t degree = 0, edges = 0;
  };
  struct Cut {
    std::int32_t edge, hanging;
  };

  /// The edges of the tree, each with the face below it. Faces then have the areas of all below them.
  std::vector<Cut> take_leaves() {
    std::vector<Cut> cuts;
    cuts.reserve(faces_.size());
    Poll poll(task_, 0.55, 0.57, 2 * faces_.size());
    for (std::int32_t leaf = 0; index(leaf) < faces_.size(); ++leaf) {
      poll.next();
      for (std::int32_t f = leaf; faces_[f].degree == 1;) {
        poll.next();
        const std::int32_t edge = faces_[f].edges;
        const std::int32_t other = closing_[edge].a == f ? closing_[edge].b : closing_[edge].a;
        cuts.push_back({edge, f});
        faces_[f].degree = 0;
        --faces_[other].degree;
        faces_[other].edges ^= edge;
        faces_[other].area += faces_[f].area;
        faces_[other].crossing ^= faces_[f].crossing;
        f = other;
      }
    }
    return cuts;
  }

  /// For each part: what is left of it is a face that has the area of all.
  std::vector<double> whole_areas() {
    std::vector<double> whole(faces_.size(), 0.0);
    const Poll poll(task_, 0.57, 0.58, faces_.size());
    for (std::size_t f = 0; f < faces_.size(); ++f) {
      poll.at(f);
      double& of = whole[tree_.parts.find(static_cast<std::int32_t>(f))];
      of = std::max(of, faces_[f].area);
    }
    return whole;
  }

  const std::vector<Closing>& closing_;
  const Task& task_;
  std::vector<Face> faces_;
  Cotree tree_;
};

/// The mean distance of a loop's points from another one.
double mean_distance(const std::vector<Vector>& loop, const Polyline& other) {
  const double step = length_of(loop) / kSamples;
  double sum = 0.0;
  for (std::size_t i = 0; i < kSamples; ++i) {
    sum += other.distance(point_at(loop, step * static_cast<double>(i)), kInfinity);
  }
  return sum / kSamples;
}

/// Loops none of which is like an earlier one.
class DistinctLoops {
 public:
  /// Whether it is another one than those before, and one of them from here on.
  bool add(const std::vector<Vector>& loop) {
    const double apart = kLeastApart * length_of(loop);
    if (std::ranges::any_of(lines_, [&](const Polyline& l) { return mean_distance(loop, l) <= apart; })) return false;
    lines_.emplace_back(loop);
    return true;
  }

 private:
  std::vector<Polyline> lines_;
};

class CutLocus {
 public:
  CutLocus(const Surface& surface, const Embedding& embedding, const DistanceField& field, const Task& task)
      : surface_(surface),
        embedding_(embedding),
        mesh_(embedding.mesh),
        field_(field),
        task_(task),
        unit_(exact_unit(surface)),
        normal_(normal_at(field.sources().front())) {}

  std::vector<ClosedWire> best(std::size_t count) {
    std::vector<ClosedWire> loops;
    DistinctLoops distinct;
    for (const Rated& rated : minima(rate(find()))) {
      if (loops.size() == count) break;
      task_.check(0.9);
      if (rated.turn > kMostTurn) continue;
      std::optional<ClosedWire> next = loop(rated);
      if (next && distinct.add(next->wire.points)) loops.push_back(std::move(*next));
    }
    return loops;
  }

 private:
  struct Rated {
    CutEdge edge;
    double turn, cost;  // J
  };

  /// Of the triangles around a vertex, or of the one that a point is in.
  Vector normal_at(const SurfacePoint& seed) const {
    Vector sum = Vector::Zero();
    for (std::int32_t f = 0; index(f) < mesh_.face_count(); ++f) {
      const bool counts = seed.vertex < 0 ? f == seed.face : std::ranges::count(mesh_.triangles[f], seed.vertex) > 0;
      if (counts) sum += span(f);
    }
    const double length = sum.norm();
    return length > 0 ? Vector(sum / length) : Vector::Zero();
  }

  double distance(std::int32_t vertex) const { return field_.distances()[vertex]; }

  double length_over(std::int32_t half_edge) const {
    return distance(mesh_.tail(half_edge)) + distance(mesh_.tip(half_edge)) + mesh_.lengths[half_edge];
  }

  /// The edges that close loops, the longest first. `face_of` names the one that a face counts as.
  template <class FaceOf>
  std::vector<Closing> closing_edges(const EdgesAndHoles& edges, const FaceOf& face_of) const {
    const std::vector<std::uint8_t> is_in_tree = spanning_tree(mesh_, edges, field_.distances(), task_);
    std::vector<Closing> closing;
    closing.reserve(edges.edge_count());
    const Poll poll(task_, 0.25, 0.3, edges.edge_count());
    for (std::size_t e = 0; e < edges.edge_count(); ++e) {
      poll.at(e);
      const std::int32_t h = edges.half_edge_of[e];
      if (mesh_.has_siblings(h) || is_in_tree[e] != 0) continue;
      // Numbers that are not negative are ordered as their bits are. Half of them is more than enough.
      const std::uint64_t bits = std::bit_cast<std::uint64_t>(length_over(h)) >> 32U;
      const auto [face, beyond] = edges.faces[e];
      closing.push_back({(~bits << 32U) | e, h, face_of(face), face_of(beyond)});
    }
    polled_sort(closing, Poll(task_, 0.3, 0.3, 1), std::ranges::less(), &Closing::key);
    return closing;
  }

  /// The loops that the edges of neither tree, and those of the tree of the faces, close. No loop closes over an edge
  /// with siblings, and faces at such an edge count as one; loop() finds out whether what it offers does separate.
  std::vector<CutEdge> find() const {
    const EdgesAndHoles edges(mesh_, task_);
    const std::size_t face_count = edges.face_count + edges.hole_count;
    DisjointSets joined = joined_over_siblings(mesh_, face_count);
    const auto face_of = [&](std::int32_t face) { return mesh_.siblings.empty() ? face : joined.find(face); };
    const std::vector<Closing> closing = closing_edges(edges, face_of);
    task_.check(0.45);
    std::vector<double> areas(face_count, 0.0);
    const Poll poll(task_, 0.45, 0.45, edges.face_count);
    for (std::int32_t f = 0; index(f) < edges.face_count; ++f) {
      poll.at(index(f));
      areas[face_of(f)] += span(f).norm();
    }
    FaceTree tree(areas, closing, task_);
    std::vector<CutEdge> found;
    tree.for_each_loop([&](std::int32_t i, bool separates) {
      const std::int32_t h = closing[i].half_edge;
      const double length = length_over(h);
      if (std::isfinite(length)) found.push_back({h, length, separates});
    });
    task_.check(0.6);
    return found;
  }

  /// Twice the area, along the normal, in the unit of exact_unit().
  Vector span(std::int32_t face) const {
    const auto& [a, b, c] = mesh_.triangles[face];
    const Vector& p = embedding_.points[a];
    return (unit_ * (embedding_.points[b] - p)).cross(unit_ * (embedding_.points[c] - p));
  }

  std::vector<Vector> line(const IntrinsicPath& path) const {
    std::vector<Vector> points;
    points.reserve(path.points.size());
    for (const PathPoint& at : path.points) points.push_back(unit_ * position(embedding_, at));
    return points;
  }

  /// The path to a vertex that is reached.
  IntrinsicPath path_to(std::int32_t vertex) const { return field_.trace(vertex, task_).value(); }

  /// Of the beginning of a wire, in the tangent plane: unit, 0 where it has no length there.
  Vector direction(const IntrinsicPath& path) const {
    const std::vector<Vector> points = line(path);
    const double most = std::min(kBeginning * unit_ / surface_.scale(), kMostOfWire * length_of(points));
    Vector along = point_at(points, most) - points.front();
    along -= along.dot(normal_) * normal_;
    const double length = along.norm();
    return length > 0 ? Vector(along / length) : Vector::Zero();
  }

  const Vector& direction_to(std::int32_t vertex) {
    const auto [entry, is_new] = directions_.try_emplace(vertex);
    if (is_new) entry->second = direction(path_to(vertex));
    return entry->second;
  }

  double turn_of(const CutEdge& edge) {
    const Vector a = direction_to(mesh_.tail(edge.half_edge)), b = direction_to(mesh_.tip(edge.half_edge));
    if (a.isZero(0) || b.isZero(0)) return std::numbers::pi;
    return std::atan2(a.cross(b).norm(), -a.dot(b));
  }

  std::vector<Rated> rate(std::vector<CutEdge> edges) {
    const auto key = [](const CutEdge& edge) { return std::pair(edge.length, edge.half_edge); };
    polled_sort(edges, Poll(task_, 0.6, 0.6, 1), std::ranges::less(), key);
    std::vector<Rated> rated;
    double best = kInfinity;
    for (const CutEdge& edge : edges) {
      const double log = std::log(edge.length);
      if (log > best + kFartherThanBest) break;
      if (rated.size() % Poll::kFewSteps == 0) task_.check(0.6);
      const double turn = turn_of(edge), cost = log + 1.0 - std::cos(turn);
      rated.push_back({edge, turn, cost});
      best = std::min(best, cost);
    }
    return rated;
  }

  /// The minima of J, over edges of which those are neighbors that share a triangle: edges come in ascending J, and
  /// where one joins two sets, the higher minimum ends.
  std::vector<Rated> minima(std::vector<Rated> rated) const {
    std::ranges::sort(rated, {}, [](const Rated& r) { return std::pair(r.cost, r.edge.half_edge); });
    std::unordered_map<std::int32_t, std::int32_t> seen_at;  // one edge that has come of a triangle
    DisjointSets sets(rated.size());                         // named after the first, so the lowest, of each
    std::vector<std::uint8_t> is_lasting(rated.size(), 1);
    for (std::size_t i = 0; i < rated.size(); ++i) {
      const std::int32_t h = rated[i].edge.half_edge;
      for (const std::int32_t side : {h, mesh_.twins[h]}) {
        if (side < 0) continue;
        const auto number = static_cast<std::int32_t>(i);
        const auto [entry, is_first] = seen_at.try_emplace(side / 3, number);
        if (is_first) continue;
        const std::int32_t a = sets.find(entry->second), b = sets.find(number);
        if (a == b) continue;
        const std::int32_t higher = std::max(a, b);
        if (rated[i].cost - rated[higher].cost < kLeastPersistence) is_lasting[higher] = 0;
        sets.join(a, b);
      }
    }
    std::vector<Rated> lasting;
    for (std::size_t i = 0; i < rated.size(); ++i) {
      if (is_lasting[i] != 0) lasting.push_back(rated[i]);
    }
    return lasting;
  }

  /// Points of the embedding on a sphere about the place on an edge at which wires over its ends are equally long.
  /// These are the points where the sphere crosses edges, points between them in each triangle, and points of the
  /// triangles at the edge towards their parts beyond the sphere.
  std::vector<SurfacePoint> around(std::int32_t half_edge, double radius) const {
    const auto point = [this](std::int32_t v) { return Vector(unit_ * embedding_.points[v]); };
    const std::int32_t a = mesh_.tail(half_edge), b = mesh_.tip(half_edge);
    const double along = std::clamp(0.5 + (distance(b) - distance(a)) / (2.0 * mesh_.lengths[half_edge]), 0.0, 1.0);
    const Vector center = (1.0 - along) * point(a) + along * point(b);
    std::vector<SurfacePoint> found;
    std::unordered_set<std::int32_t> seen;
    std::vector<std::int32_t> front;
    const auto enter = [&](std::int32_t h) {
      if (h >= 0 && seen.insert(h / 3).second) front.push_back(h / 3);
    };
    enter(half_edge);
    enter(mesh_.twins[half_edge]);
    const std::size_t first_faces = front.size();
    for (std::size_t next = 0; next < front.size(); ++next) {
      const std::int32_t face = front[next];
      std::vector<std::array<double, 3>> crossings;
      for (std::size_t i = 0; i < 3; ++i) {
        const std::int32_t h = 3 * face + static_cast<std::int32_t>(i);
        const Vector from = point(mesh_.tail(h)) - center, step = point(mesh_.tip(h)) - point(mesh_.tail(h));
        // |from + t step| = radius
        const double p = from.dot(step), q = step.squaredNorm(), r = from.squaredNorm() - radius * radius;
        const double root = p * p - q * r;
        if (!(root >= 0 && q > 0)) continue;
        const double low = (-p - std::sqrt(root)) / q, high = (-p + std::sqrt(root)) / q;
        if (low > 1 || high < 0) continue;
        mesh_.for_each_beyond(h, enter);
        for (const double t : {low, high}) {
          if (!(t > 0 && t < 1)) continue;
          std::array<double, 3> at{};
          at[i] = 1.0 - t;
          at[(i + 1) % 3] = t;
          crossings.push_back(at);
        }
      }
      for (const std::array<double, 3>& at : crossings) found.push_back({face, at});
      if (crossings.size() == 2) {
        std::array<double, 3> middle{};
        for (std::size_t i = 0; i < 3; ++i) middle[i] = 0.5 * (crossings[0][i] + crossings[1][i]);
        found.push_back({face, middle});
      }
      if (next >= first_faces) continue;
      const std::int32_t h = next == 0 ? half_edge : mesh_.twins[half_edge];
      const double apart = (point(mesh_.apex(h)) - center).norm();
      if (!(apart > radius)) continue;
      const double t = radius / apart, at_tail = next == 0 ? 1.0 - along : along;
      std::array<double, 3> at{};
      at[index(h % 3)] = (1.0 - t) * at_tail;
      at[index((h % 3 + 1) % 3)] = (1.0 - t) * (1.0 - at_tail);
      at[index((h % 3 + 2) % 3)] = t;
      found.push_back({face, at});
    }
    return found;
  }

  /// Whether wires to the places around an edge leave the seed in all directions. Then the loop over it is one of many.
  bool is_met_from_all_sides(std::int32_t half_edge, double radius) const {
    const std::vector<SurfacePoint> points = around(half_edge, radius);
    const std::size_t step = points.size() / kMostAround + 1;
    std::vector<Vector> directions;
    Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
    for (std::size_t i = 0; i < points.size(); i += step) {
      const std::optional<IntrinsicPath> path = field_.trace(points[i], task_);
      if (!path) continue;
      const Vector along = direction(*path);
      if (along.isZero(0)) return false;
      directions.push_back(along);
      spread += along * along.transpose();
    }
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(spread);
    std::vector<double> angles;
    angles.reserve(directions.size());
    for (const Vector& along : directions) {
      angles.push_back(std::atan2(along.dot(solver.eigenvectors().col(1)), along.dot(solver.eigenvectors().col(2))));
    }
    std::ranges::sort(angles);
    for (std::size_t i = 0; i < angles.size(); ++i) {
      const double next = i + 1 < angles.size() ? angles[i + 1] : angles.front() + 2.0 * std::numbers::pi;
      if (next - angles[i] > kLargestGap) return false;
    }
    return !angles.empty();
  }

  /// The loop over an edge, where it is one that the surface suggests.
  std::optional<ClosedWire> loop(const Rated& rated) {
    const std::int32_t h = rated.edge.half_edge;
    IntrinsicPath path = path_to(mesh_.tail(h));
    const IntrinsicPath back = path_to(mesh_.tip(h));
    const std::vector<Vector> there = line(path), other = line(back);
    const double length_there = length_of(there), length_other = length_of(other);
    const double edge = (other.back() - there.back()).norm(), whole = length_there + edge + length_other;
    const Vector middle = point_at(there, length_there / 2), other_middle = point_at(other, length_other / 2);
    if (!((middle - other_middle).norm() >= kLeastWidth * whole)) return std::nullopt;
    const auto angle_to = [&](const Vector& along, const std::vector<Vector>& wire, double length) {
      const double most = std::min(kBeginning * unit_ / surface_.scale(), kMostOfWire * length);
      const Vector back_along = point_at(wire, length - most) - wire.back();
      return std::atan2(along.cross(back_along).norm(), along.dot(back_along));
    };
    const Vector along = other.back() - there.back();
    const double excess = angle_to(along, there, length_there) + angle_to(-along, other, length_other) - rated.turn;
    if (!(excess >= kLeastExcess)) return std::nullopt;
    if (is_met_from_all_sides(h, kAround * whole)) return std::nullopt;
    bool separates = rated.edge.separates;
    if (!mesh_.siblings.empty()) {
      if (!parts_) parts_.emplace(mesh_, field_.distances(), task_);
      const std::vector<std::uint8_t> side = parts_->side_of(h, task_);
      double area = 0.0, all = 0.0;
      for (std::int32_t f = 0; index(f) < mesh_.face_count(); ++f) {
        if (side[f] == LoopParts::kElsewhere) continue;
        const double of_face = span(f).norm();
        all += of_face;
        if (side[f] == LoopParts::kLeft) area += of_face;
      }
      separates = std::ranges::find(side, LoopParts::kRight) != side.end();
      if (separates && std::min(area, all - area) < kLeastArea * all) return std::nullopt;
    }
    path.points.insert(path.points.end(), back.points.rbegin(), back.points.rend());
    path.faces.push_back(h / 3);
    path.faces.insert(path.faces.end(), back.faces.rbegin(), back.faces.rend());
    path.length += mesh_.lengths[h] + back.length;
    return ClosedWire{
        .wire = map_wire(surface_, embedding_, path), .separates = separates, .turn = rated.turn, .half_edge = h};
  }

  const Surface& surface_;
  const Embedding& embedding_;
  const IntrinsicMesh& mesh_;
  const DistanceField& field_;
  const Task& task_;
  const double unit_;    // of lengths and areas here, see exact_unit()
  const Vector normal_;  // at the seed: unit, or 0
  std::unordered_map<std::int32_t, Vector> directions_;
  std::optional<LoopParts> parts_;  // where edges have siblings
};

}  // namespace

std::vector<ClosedWire> closed_wires(const Surface& surface, const Embedding& embedding, const DistanceField& field,
                                     std::size_t count, const Task& task) {
  check_embedding(surface, embedding);
  check_field(embedding, field);
  if (field.sources().size() != 1) {
    throw InvalidInput("closed wires lead through one seed: the field has " + std::to_string(field.sources().size()));
  }
  if (count == 0) return {};
  const RisingProgress rising(task);
  std::vector<ClosedWire> best = CutLocus(surface, embedding, field, rising.task()).best(count);
  for (ClosedWire& cut : best) cut.mesh = field.mesh_id();
  return best;
}

std::vector<ClosedCutId> choose_closed_wires(std::span<const std::vector<ClosedWire>> metrics, std::size_t count) {
  for (const std::vector<ClosedWire>& cuts : metrics) {
    if (std::ranges::any_of(cuts, [](const ClosedWire& cut) { return cut.wire.points.empty(); })) {
      throw InvalidInput("a closed cut has no points");
    }
  }
  std::vector<ClosedCutId> order;
  for (std::size_t metric = 0; metric < metrics.size(); ++metric) {
    if (!metrics[metric].empty()) order.push_back({.metric = metric, .number = 0});
  }
  for (std::size_t metric = 0; metric < metrics.size(); ++metric) {
    for (std::size_t i = 1; i < metrics[metric].size(); ++i) order.push_back({.metric = metric, .number = i});
  }
  std::vector<ClosedCutId> chosen;
  DistinctLoops distinct;
  for (const ClosedCutId& choice : order) {
    if (chosen.size() == count) break;
    if (distinct.add(metrics[choice.metric][choice.number].wire.points)) chosen.push_back(choice);
  }
  return chosen;
}

}  // namespace seamwire
