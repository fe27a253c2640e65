// SPDX-License-Identifier: GPL-3.0-or-later
#include "parts/limbs.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <queue>
#include <span>
#include <tuple>
#include <utility>
#include <vector>

#include "detail/csr.hpp"
#include "detail/index.hpp"
#include "detail/infinity.hpp"
#include "detail/poll.hpp"
#include "graph/disjoint_sets.hpp"
#include "graph/shortest_paths.hpp"
#include "parts/limb_field.hpp"
#include "parts/minimum_cut.hpp"
#include "prices/plan_mesh.hpp"
#include "surface/real_edges.hpp"
#include "tuning/constants.hpp"

namespace seamwire::detail {
namespace {

/// Share of the highest cost of a join from which on limbs of the size of others stay, and by how much their areas may
/// differ.
constexpr double kAlikeCost = 0.5, kAlikeLimbs = 0.25;
constexpr double kDiagonal = 1e6;  // price of an edge along which no border may run

/// A border between two regions.
struct Border {
  double length = 0.0;
  double weight = 0.0;

  void add(const Border& more) {
    length += more.length;
    weight += more.weight;
  }
};

/// Joins the faces of a connected surface of area 1, the cheapest two regions first, until one region is left.
class LimbJoining {
 public:
  LimbJoining(std::span<const LimbFace> faces, std::span<const LimbLink> links, const LimbField& field)
      : places_(field.places), areas_(faces.size()), perimeters_(faces.size(), 0.0), borders_(faces.size()) {
    for (std::size_t f = 0; f < faces.size(); ++f) areas_[f] = faces[f].area;
    for (std::size_t i = 0; i < links.size(); ++i) {
      const Border border{.length = links[i].length, .weight = field.weights[i]};
      for (const auto& [a, b] : {std::pair(links[i].one, links[i].other), std::pair(links[i].other, links[i].one)}) {
        borders_[a][b].add(border);
        perimeters_[a] += border.length;
      }
    }
  }

  /// `first`: links whose faces are joined before all others.
  std::vector<LimbJoin> run(std::span<const LimbLink> first, Poll poll) {
    DisjointSets sets(borders_.size());
    for (const LimbLink& link : first) {
      const auto [one, other] = std::minmax({sets.find(link.one), sets.find(link.other)});
      if (!sets.join(one, other)) continue;
      join({.cost = 0.0, .one = one, .other = other});
    }
    for (std::int32_t a = 0; index(a) < borders_.size(); ++a) {
      poll.next();
      for (const auto& [b, border] : borders_[a]) {
        if (a < b) offer(a, b, border);
      }
    }
    while (!open_.empty()) {
      poll.next();
      const auto [cost, one, other] = open_.top();
      open_.pop();
      const auto found = borders_[one].find(other);
      if (found == borders_[one].end() || cost_of(one, other, found->second) != cost) continue;
      join({.cost = cost, .one = one, .other = other});
      for (const auto& [b, border] : borders_[one]) offer(std::min(one, b), std::max(one, b), border);
    }
    return std::move(joins_);
  }

 private:
  /// The work of spreading the difference of two regions over their border. It is the product of how far one protrudes
  /// and how narrow or concave the border is, and does not depend on the size of the surface.
  double cost_of(std::int32_t one, std::int32_t other, const Border& border) const {
    if (!(border.length > 0.0) || !(border.weight > 0.0)) return 0.0;
    const double a = areas_[one], b = areas_[other];
    const double apart = (places_.row(one) - places_.row(other)).squaredNorm() * a * b / (a + b) / border.length;
    const double openness = border.length / border.weight;
    const auto compactness = [&](std::int32_t r) {
      const double perimeter = perimeters_[r];
      return perimeter > 0.0 ? areas_[r] / (tuning::kLimbCompactness * perimeter * perimeter) : 1.0;
    };
    const double shape = std::min({1.0, compactness(one), compactness(other)});
    return apart * openness * openness * openness * shape * std::min(1.0, std::min(a, b) / tuning::kLimbArea);
  }

  void offer(std::int32_t one, std::int32_t other, const Border& border) {
    open_.emplace(cost_of(one, other, border), one, other);
  }

  /// The joined region is named after the first.
  void join(const LimbJoin& step) {
    const auto& [cost, one, other] = step;
    joins_.push_back(step);
    const double area = areas_[one] + areas_[other];
    places_.row(one) = (areas_[one] * places_.row(one) + areas_[other] * places_.row(other)) / area;
    areas_[one] = area;
    perimeters_[one] += perimeters_[other] - 2.0 * borders_[one][other].length;
    borders_[one].erase(other);
    for (const auto& [c, border] : borders_[other]) {
      if (c == one) continue;
      borders_[c].erase(other);
      Border& sum = borders_[one][c];
      sum.add(border);
      borders_[c][one] = sum;
    }
    borders_[other].clear();
  }

  Eigen::Matrix<double, Eigen::Dynamic, LimbField::kCoordinates, Eigen::RowMajor> places_;
  std::vector<double> areas_, perimeters_;
  std::vector<std::map<std::int32_t, Border>> borders_;
  std::vector<LimbJoin> joins_;
  using Offer = std::tuple<double, std::int32_t, std::int32_t>;
  std::priority_queue<Offer, std::vector<Offer>, std::greater<>> open_;
};

/// Joins parts that are too small to be limbs to the neighbor with the widest open border, smallest parts first.
/// `areas`: of the faces, in areas of their pieces.
void join_small(const PlanMesh& mesh, std::span<const double> areas, std::span<const double> weights,
                DisjointSets& sets, const Task& task) {
  Poll poll(task);
  std::vector<double> area_of(areas.size(), 0.0);
  std::map<std::int32_t, std::map<std::int32_t, double>> beside;
  for (std::size_t f = 0; f < areas.size(); ++f) area_of[sets.find(static_cast<std::int32_t>(f))] += areas[f];
  for (std::size_t e = 0; e < mesh.edge_count(); ++e) {
    poll.next();
    const std::int32_t h = mesh.half_edge_of[e], twin = mesh.twins[h];
    if (twin < 0) continue;
    const std::int32_t one = sets.find(h / 3), other = sets.find(twin / 3);
    if (one == other) continue;
    beside[one][other] += weights[e];
    beside[other][one] += weights[e];
  }
  std::priority_queue<std::pair<double, std::int32_t>, std::vector<std::pair<double, std::int32_t>>, std::greater<>>
      small;
  for (const auto& [part, others] : beside) {
    if (area_of[part] < tuning::kLeastPart) small.emplace(area_of[part], part);
  }
  while (!small.empty()) {
    poll.next();
    const auto [area, part] = small.top();
    small.pop();
    if (sets.find(part) != part || area_of[part] != area) continue;
    const auto& others = beside[part];
    if (others.empty()) continue;
    const auto widest = std::ranges::max_element(others, {}, [](const auto& pair) { return pair.second; });
    const std::int32_t neighbor = widest->first;
    sets.join(part, neighbor);
    const std::int32_t kept = sets.find(part), gone = kept == part ? neighbor : part;
    area_of[kept] = area_of[part] + area_of[neighbor];
    for (const auto& [c, weight] : beside[gone]) {
      beside[c].erase(gone);
      if (c == kept) continue;
      beside[kept][c] += weight;
      beside[c][kept] += weight;
    }
    beside.erase(gone);
    if (area_of[kept] < tuning::kLeastPart) small.emplace(area_of[kept], kept);
  }
}

/// Moves the border between each two parts to where it is shortest and most concave, within a band on both sides of it,
/// because borders of joined triangles are jagged. `distances`: between the triangles at each edge.
void smooth_borders(const PlanMesh& mesh, std::span<const double> distances, std::span<const double> weights,
                    std::vector<std::int32_t>& of_face, const Task& task) {
  Poll poll(task);
  constexpr Edge kNone{-1, -1};
  std::vector<Edge> nearest(of_face.size(), kNone);  // the two parts at the border that is nearest to each triangle
  std::vector<std::int32_t> at_border;
  for (std::size_t e = 0; e < mesh.edge_count(); ++e) {
    poll.next();
    const std::int32_t h = mesh.half_edge_of[e], twin = mesh.twins[h];
    if (twin < 0 || of_face[h / 3] == of_face[twin / 3]) continue;
    for (const std::int32_t f : {h / 3, twin / 3}) {
      if (nearest[f] != kNone) continue;
      nearest[f] = ascending(of_face[h / 3], of_face[twin / 3]);
      at_border.push_back(f);
    }
  }
  std::vector<double> depth(of_face.size(), kInfinity);  // of each triangle in its part
  std::vector<double> deepest(of_face.size(), 0.0);      // of each part
  find_shortest_paths(at_border, depth, [&](std::int32_t f, const auto& step) {
    poll.next();
    deepest[of_face[f]] = std::max(deepest[of_face[f]], depth[f]);
    for (std::int32_t h = 3 * f; h < 3 * f + 3; ++h) {
      const std::int32_t twin = mesh.twins[h];
      if (twin < 0 || of_face[twin / 3] != of_face[f]) continue;
      if (step(twin / 3, distances[mesh.edge_of[h]])) nearest[twin / 3] = nearest[f];
    }
  });
  // A triangle is in the band of its nearest border. Triangles that lie deeper in their part stay, so no part is lost.
  std::map<Edge, std::vector<std::int32_t>> band_of;
  for (std::int32_t f = 0; index(f) < of_face.size(); ++f) {
    if (depth[f] < std::min(tuning::kLimbBand, 0.5 * deepest[of_face[f]])) band_of[nearest[f]].push_back(f);
  }
  const std::vector<std::int32_t> before = of_face;
  std::vector<std::int32_t> number(of_face.size(), -1);  // of a triangle in its band
  for (const auto& [pair, band] : band_of) {
    for (std::size_t i = 0; i < band.size(); ++i) number[band[i]] = static_cast<std::int32_t>(i);
    const auto source = static_cast<std::int32_t>(band.size()), sink = source + 1;
    MinimumCut network(band.size() + 2);
    for (const std::int32_t f : band) {
      for (std::int32_t h = 3 * f; h < 3 * f + 3; ++h) {
        poll.next();
        const std::int32_t twin = mesh.twins[h], other = twin / 3;
        if (twin < 0 || std::ranges::find(pair, before[other]) == pair.end()) continue;
        const std::int32_t e = mesh.edge_of[h];
        const double price = mesh.is_real[e] != 0 ? weights[e] : kDiagonal;
        if (number[other] < 0) {
          network.add(number[f], before[other] == pair[0] ? source : sink, price);
        } else if (f < other) {
          network.add(number[f], number[other], price);
        }
      }
    }
    const std::vector<std::uint8_t> side = network.source_side(source, sink, task);
    for (std::size_t i = 0; i < band.size(); ++i) of_face[band[i]] = side[i] != 0 ? pair[0] : pair[1];
    for (const std::int32_t f : band) number[f] = -1;
  }
}

}  // namespace

Limbs::Limbs(const PlanMesh& mesh, std::span<const FaceFrame> frames, const Pieces& pieces, const Task& task)
    : mesh_(mesh),
      areas_(mesh.face_count(), 0.0),
      weights_(mesh.edge_count(), 0.0),
      distances_(mesh.edge_count(), 0.0),
      joins_(index(pieces.count)) {
  const Csr<std::int32_t> faces_of(index(pieces.count), [&](const auto& visit) {
    for (std::int32_t f = 0; index(f) < mesh.face_count(); ++f) visit(pieces.of_face[f], f);
  });
  const Csr<std::int32_t> edges_of(index(pieces.count), [&](const auto& visit) {
    for (std::int32_t e = 0; index(e) < mesh.edge_count(); ++e) {
      if (!mesh.is_boundary(e)) visit(pieces.of_face[mesh.half_edge_of[e] / 3], e);
    }
  });
  std::vector<std::int32_t> number(mesh.face_count(), -1);  // of a face in its piece
  double done = 0.0;
  for (std::int32_t p = 0; p < pieces.count; ++p) {
    double area = 0.0;
    for (const std::int32_t f : faces_of[p]) area += frames[f].area;
    const double share = static_cast<double>(faces_of[p].size()) / static_cast<double>(mesh.face_count());
    const Task own = part_of(task, done, done + share);
    done += share;
    if (!(area > 0.0)) {
      for (const std::int32_t f : faces_of[p]) joins_[p].push_back({.cost = 0.0, .one = faces_of[p][0], .other = f});
      continue;
    }
    const double scale = 1.0 / std::sqrt(area);
    std::vector<LimbFace> faces;
    for (const std::int32_t f : faces_of[p]) {
      number[f] = static_cast<std::int32_t>(faces.size());
      // No area is 0, so that means of places are defined.
      areas_[f] = std::max(frames[f].area / area, 1e-9 / static_cast<double>(faces_of[p].size()));
      Vector center = Vector::Zero();
      for (const std::int32_t v : mesh.triangles[f]) center += mesh.points[v] / 3.0;
      faces.push_back({.center = scale * center, .normal = frames[f].normal, .area = areas_[f]});
    }
    std::vector<LimbLink> links, diagonals;
    for (const std::int32_t e : edges_of[p]) {
      const std::int32_t h = mesh.half_edge_of[e], one = number[h / 3], other = number[mesh.twins[h] / 3];
      const Vector middle = 0.5 * scale * (mesh.points[mesh.tail(h)] + mesh.points[mesh.tip(h)]);
      const double distance = (faces[one].center - middle).norm() + (faces[other].center - middle).norm();
      links.push_back({.one = one, .other = other, .length = scale * mesh.lengths[e], .distance = distance});
      if (mesh.is_real[e] == 0) diagonals.push_back(links.back());
    }
    const LimbField field = limb_field(faces, links, part_of(own, 0.0, 0.8));
    for (std::size_t i = 0; i < links.size(); ++i) {
      weights_[edges_of[p][i]] = field.weights[i];
      distances_[edges_of[p][i]] = links[i].distance;
    }
    Poll poll(own, 0.8, 1.0, 4 * faces.size(), Poll::kFewSteps);
    joins_[p] = LimbJoining(faces, links, field).run(diagonals, poll);
    for (LimbJoin& join : joins_[p]) {
      join.one = faces_of[p][join.one];
      join.other = faces_of[p][join.other];
    }
  }
}

/// Makes the joins of a piece that cost up to `most`. A limb that would be joined for little less stays if a limb of
/// about its size stays, so that both ears are parts, or none is.
void Limbs::join_up_to(double most, std::span<const LimbJoin> joins, DisjointSets& sets) const {
  const auto end_of = [&](double limit) {
    return std::ranges::find_if(joins, [&](const LimbJoin& join) { return join.cost > limit; });
  };
  std::vector<double> sizes = areas_;  // of the sets, by what represents them
  const auto join = [&](DisjointSets& own, std::int32_t one, std::int32_t other) {
    const double size = sizes[own.find(one)] + sizes[own.find(other)];
    if (own.join(one, other)) sizes[own.find(one)] = size;
  };
  const auto last = end_of(most), doubtful = end_of(kAlikeCost * most);
  for (const auto& each : std::span(joins.begin(), std::min(doubtful, last))) join(sets, each.one, each.other);
  std::vector<double> kept;  // sizes of the limbs that stay anyway: of the smaller sides of later joins
  DisjointSets later = sets;
  const std::vector<double> before = sizes;
  for (auto each = doubtful; each != joins.end(); ++each) {
    if (each >= last) kept.push_back(std::min(sizes[later.find(each->one)], sizes[later.find(each->other)]));
    join(later, each->one, each->other);
  }
  sizes = before;
  for (auto each = doubtful; each < last; ++each) {
    const double size = std::min(sizes[sets.find(each->one)], sizes[sets.find(each->other)]);
    const auto is_alike = [&](double other) { return std::abs(size - other) <= kAlikeLimbs * other; };
    if (std::ranges::none_of(kept, is_alike)) join(sets, each->one, each->other);
  }
}

std::vector<std::int32_t> Limbs::find(double most, const Task& task) const {
  DisjointSets sets(mesh_.face_count());
  for (const std::vector<LimbJoin>& joins : joins_) join_up_to(most, joins, sets);
  join_small(mesh_, areas_, weights_, sets, task);
  std::vector<std::int32_t> of_face = sets.numbering().of;
  smooth_borders(mesh_, distances_, weights_, of_face, task);
  return of_face;
}

void join_exposed(const PlanMesh& mesh, std::span<const double> open, std::vector<std::int32_t>& of_face,
                  const Task& task) {
  struct View {
    double exposed = 0.0, length = 0.0;
  };
  while (true) {
    std::map<Edge, View> borders;
    const Poll poll(task);
    for (std::size_t e = 0; e < mesh.edge_count(); ++e) {
      poll.at(e);
      const std::int32_t h = mesh.half_edge_of[e], twin = mesh.twins[h];
      if (twin < 0 || of_face[h / 3] == of_face[twin / 3]) continue;
      View& border = borders[ascending(of_face[h / 3], of_face[twin / 3])];
      border.length += mesh.lengths[e];
      const double own = 0.5 * (open[mesh.tail(h)] + open[mesh.tip(h)]);
      if (own >= tuning::kExposed) border.exposed += mesh.lengths[e];
    }
    const auto share = [](const auto& pair) {
      const View& border = pair.second;
      return border.length > 0.0 ? border.exposed / border.length : 1.0;
    };
    const auto most = std::ranges::max_element(borders, {}, share);
    if (most == borders.end() || share(*most) <= tuning::kMostExposed) return;
    std::ranges::replace(of_face, most->first[1], most->first[0]);
  }
}

}  // namespace seamwire::detail
