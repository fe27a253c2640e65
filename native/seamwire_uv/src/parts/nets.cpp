// SPDX-License-Identifier: GPL-3.0-or-later
#include "parts/nets.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <map>
#include <numeric>
#include <optional>
#include <queue>
#include <tuple>
#include <utility>

#include "detail/index.hpp"
#include "detail/poll.hpp"
#include "detail/rounded.hpp"
#include "graph/disjoint_sets.hpp"
#include "maps/island_map.hpp"
#include "tuning/constants.hpp"

namespace seamwire::detail {
namespace {

using Corners = std::array<Point2, 3>;

double cross(const Point2& one, const Point2& other) { return one.x() * other.y() - one.y() * other.x(); }

/// A turn and a move in the plane.
struct Motion {
  Point2 turn{1.0, 0.0}, move{0.0, 0.0};

  Point2 operator()(const Point2& p) const {
    return {turn.x() * p.x() - turn.y() * p.y() + move.x(), turn.y() * p.x() + turn.x() * p.y() + move.y()};
  }
};

/// The motion that brings one segment onto another one, middle on middle.
Motion motion_between(const std::array<Point2, 2>& from, const std::array<Point2, 2>& to) {
  const Point2 a = from[1] - from[0], b = to[1] - to[0];
  Point2 turn(a.dot(b), cross(a, b));
  const double size = turn.norm();
  turn = size > 0.0 ? Point2(turn / size) : Point2(1.0, 0.0);
  Motion motion{turn, Point2::Zero()};
  motion.move = 0.5 * (to[0] + to[1]) - motion(0.5 * (from[0] + from[1]));
  return motion;
}

/// A region, unfolded.
struct Panel {
  std::vector<std::int32_t> faces;
  std::vector<std::size_t> rims;
  double area = 0.0;
  int lowest = 1, highest = -1;  ///< on which sides of the mirror plane it has vertices

  bool is_across() const { return lowest < 0 && highest > 0; }
};

/// A chain of edges between two panels.
struct PanelRim {
  std::array<std::int32_t, 2> panels{-1, -1};
  std::vector<std::int32_t> half_edges;  ///< of the first panel
  double length = 0.0;
  Vector center = Vector::Zero();
  bool is_across = false;
  bool may_fold = true;

  std::int32_t other(std::int32_t panel) const { return panels[0] == panel ? panels[1] : panels[0]; }
};

/// The nets of one connected piece.
class PieceNet {
 public:
  /// `flat` and `is_laid` have an item for each triangle of the mesh.
  PieceNet(const NetProblem& problem, std::vector<Corners>& flat, std::vector<std::uint8_t>& is_laid, double diagonal,
           const Task& task)
      : problem_(problem),
        mesh_(problem.mesh),
        flat_(flat),
        is_laid_(is_laid),
        gap_(tuning::kNetGap * diagonal),
        task_(task) {}

  /// Marks the folds, if the piece opens as a net.
  void find(std::span<const std::int32_t> faces, std::vector<std::uint8_t>& is_fold) {
    if (!find_panels(faces)) return;
    find_rims();
    if (!std::ranges::all_of(panels_, [&](const Panel& panel) { return unfold(panel); })) return;
    place({});
    if (placed_count_ < panels_.size()) return;
    if (!parting_.empty()) place(parting_);
    for (const std::size_t r : folds_) {
      for (const std::int32_t h : rims_[r].half_edges) is_fold[mesh_.edge_of[h]] = 1;
    }
  }

 private:
  std::int32_t panel_at(std::int32_t half_edge) const {
    const auto at = panel_of_.find(problem_.region_of[half_edge / 3]);
    return at == panel_of_.end() ? -1 : at->second;
  }

  bool find_panels(std::span<const std::int32_t> faces) {
    for (const std::int32_t f : faces) {
      const auto [at, is_new] = panel_of_.emplace(problem_.region_of[f], static_cast<std::int32_t>(panels_.size()));
      if (is_new && panels_.size() == tuning::kMostPanels) return false;
      if (is_new) panels_.emplace_back();
      Panel& panel = panels_[at->second];
      panel.faces.push_back(f);
      panel.area += face_frame(mesh_, mesh_.triangles[f]).area;
      for (const std::int32_t v : mesh_.triangles[f]) {
        if (problem_.reflection == nullptr) continue;
        panel.lowest = std::min<int>(panel.lowest, problem_.reflection->sides[v]);
        panel.highest = std::max<int>(panel.highest, problem_.reflection->sides[v]);
      }
    }
    return panels_.size() > 1;
  }

  /// Chains of edges between two panels: edges that meet in a vertex belong to one chain.
  void find_rims() {
    std::map<std::array<std::int32_t, 2>, std::vector<std::int32_t>> between;
    for (std::int32_t p = 0; index(p) < panels_.size(); ++p) {
      for (const std::int32_t f : panels_[p].faces) {
        for (std::int32_t h = 3 * f; h < 3 * f + 3; ++h) {
          const std::int32_t other = mesh_.twins[h] < 0 ? -1 : panel_at(mesh_.twins[h]);
          if (other > p) between[{p, other}].push_back(h);
        }
      }
    }
    for (const auto& [panels, half_edges] : between) {
      std::map<std::int32_t, std::size_t> at_vertex;
      DisjointSets sets(half_edges.size());
      for (std::size_t k = 0; k < half_edges.size(); ++k) {
        for (const std::int32_t v : {mesh_.tail(half_edges[k]), mesh_.tip(half_edges[k])}) {
          const auto [at, is_new] = at_vertex.emplace(v, k);
          if (!is_new) sets.join(static_cast<std::int32_t>(k), static_cast<std::int32_t>(at->second));
        }
      }
      std::map<std::int32_t, PanelRim> chains;
      for (std::size_t k = 0; k < half_edges.size(); ++k) {
        PanelRim& rim = chains[sets.find(static_cast<std::int32_t>(k))];
        const std::int32_t h = half_edges[k], e = mesh_.edge_of[h];
        rim.panels = panels;
        rim.half_edges.push_back(h);
        rim.length += mesh_.lengths[e];
        rim.center += 0.5 * mesh_.lengths[e] * (mesh_.points[mesh_.tail(h)] + mesh_.points[mesh_.tip(h)]);
        rim.may_fold = rim.may_fold && problem_.may_fold[e] != 0;
        if (problem_.is_parting[e] != 0) parting_.push_back(panels);
      }
      for (auto& [root, rim] : chains) {
        if (rim.length > 0.0) rim.center /= rim.length;
        if (problem_.reflection != nullptr) {
          const double away = rim.center[problem_.reflection->axis] - problem_.reflection->offset;
          rim.is_across = std::abs(away) < gap_;
        }
        for (const std::int32_t p : panels) panels_[p].rims.push_back(rims_.size());
        rims_.push_back(std::move(rim));
      }
    }
  }

  Point2 at(std::int32_t half_edge, bool is_tip) const {
    return flat_[half_edge / 3][index((half_edge + (is_tip ? 1 : 0)) % 3)];
  }

  /// Lays the triangles of a panel side by side in the plane. Returns whether they fit together everywhere.
  bool unfold(const Panel& panel) {
    const Poll poll(task_);
    std::vector<std::int32_t> open{panel.faces.front()};
    lay_first(open.front());
    is_laid_[open.front()] = 1;
    for (std::size_t k = 0; k < open.size(); ++k) {
      poll.at(k);
      for (std::int32_t h = 3 * open[k]; h < 3 * open[k] + 3; ++h) {
        const std::int32_t twin = mesh_.twins[h];
        if (twin < 0 || problem_.region_of[twin / 3] != problem_.region_of[h / 3]) continue;
        if (std::exchange(is_laid_[twin / 3], std::uint8_t{1}) == 0) {
          lay_beside(h);
          open.push_back(twin / 3);
        } else if ((at(h, false) - at(twin, true)).norm() > gap_ || (at(h, true) - at(twin, false)).norm() > gap_) {
          return false;
        }
      }
    }
    return open.size() == panel.faces.size();
  }

  void lay_first(std::int32_t f) {
    const Vector& a = mesh_.points[mesh_.triangles[f][0]];
    const Vector along = mesh_.points[mesh_.triangles[f][1]] - a, to = mesh_.points[mesh_.triangles[f][2]] - a;
    const double length = along.norm();
    const double x = length > 0.0 ? to.dot(along) / length : 0.0;
    const double y = length > 0.0 ? to.cross(along).norm() / length : to.norm();
    flat_[f] = {Point2(0.0, 0.0), Point2(length, 0.0), Point2(x, y)};
  }

  /// Lays the triangle on the other side of a half-edge.
  void lay_beside(std::int32_t h) {
    const std::int32_t twin = mesh_.twins[h], f = twin / 3;
    lay_first(f);
    const Motion motion = motion_between({at(twin, false), at(twin, true)}, {at(h, true), at(h, false)});
    for (Point2& corner : flat_[f]) corner = motion(corner);
  }

  /// The motion that brings a panel to a placed one on the other side of a rim; nullopt if their rims differ.
  std::optional<Motion> attachment(const PanelRim& rim, std::int32_t panel) const {
    const bool is_first = rim.panels[0] == panel;
    const auto sides = [&](std::int32_t h, bool own) -> std::array<Point2, 2> {
      const bool takes_first = own == is_first;
      const std::int32_t side = takes_first ? h : mesh_.twins[h];
      return {at(side, !takes_first), at(side, takes_first)};
    };
    const std::int32_t longest =
        *std::ranges::max_element(rim.half_edges, {}, [&](std::int32_t h) { return mesh_.lengths[mesh_.edge_of[h]]; });
    const Motion motion = motion_between(sides(longest, true), sides(longest, false));
    for (const std::int32_t h : rim.half_edges) {
      const auto own = sides(h, true), other = sides(h, false);
      for (std::size_t i = 0; i < 2; ++i) {
        if ((motion(own[i]) - other[i]).norm() > gap_) return std::nullopt;
      }
    }
    return motion;
  }

  /// The largest number of rims between a panel and any other one; infinite if one cannot be reached.
  std::size_t eccentricity(std::int32_t from) const {
    std::vector<std::size_t> away(panels_.size(), panels_.size());
    std::vector<std::int32_t> open{from};
    away[from] = 0;
    for (std::size_t k = 0; k < open.size(); ++k) {
      for (const std::size_t r : panels_[open[k]].rims) {
        const std::int32_t next = rims_[r].other(open[k]);
        if (!rims_[r].may_fold || away[next] < panels_.size()) continue;
        away[next] = away[open[k]] + 1;
        open.push_back(next);
      }
    }
    return *std::ranges::max_element(away);
  }

  /// The central panel of those that are not placed: near to all others, on the mirror plane, and large. Equal ones are
  /// told apart by their numbers, so that the net does not depend on how the mesh is turned.
  std::int32_t root() const {
    using Key = std::tuple<std::size_t, bool, double, std::int32_t>;
    std::optional<Key> best;
    for (std::int32_t p = 0; index(p) < panels_.size(); ++p) {
      if (is_placed_[p] != 0) continue;
      const Key key{eccentricity(p), !panels_[p].is_across(), -rounded(panels_[p].area), p};
      if (!best || key < *best) best = key;
    }
    return std::get<3>(*best);
  }

  /// Attaches panels to each other. `parting`: pairs of panels that must lie in separate islands.
  void place(std::span<const std::array<std::int32_t, 2>> parting) {
    is_placed_.assign(panels_.size(), 0);
    islands_ = DisjointSets(panels_.size());
    folds_.clear();
    placed_count_ = 0;
    do {
      place_island(parting);
    } while (!parting.empty() && placed_count_ < panels_.size());
  }

  void place_island(std::span<const std::array<std::int32_t, 2>> parting) {
    // By depth, symmetry and length.
    using Key = std::tuple<std::size_t, bool, double, std::size_t, std::int32_t>;
    std::priority_queue<Key, std::vector<Key>, std::greater<>> open;
    const auto reach = [&](std::int32_t p, std::size_t depth) {
      is_placed_[p] = 1;
      ++placed_count_;
      for (const std::size_t r : panels_[p].rims) {
        const PanelRim& rim = rims_[r];
        const std::int32_t next = rim.other(p);
        if (!rim.may_fold || is_placed_[next] != 0) continue;
        open.emplace(depth + 1, panels_[next].is_across() && !rim.is_across, -rounded(rim.length), r, next);
      }
    };
    reach(root(), 0);
    while (!open.empty()) {
      task_.check(0.0);
      const auto [depth, is_aside, length, r, next] = open.top();
      open.pop();
      const std::int32_t placed = rims_[r].other(next);
      if (is_placed_[next] != 0 || must_part(placed, next, parting)) continue;
      const std::optional<Motion> motion = attachment(rims_[r], next);
      if (!motion) continue;
      for (const std::int32_t f : panels_[next].faces) {
        for (Point2& corner : flat_[f]) corner = (*motion)(corner);
      }
      if (covers_others(next, placed)) continue;
      islands_.join(placed, next);
      folds_.push_back(r);
      reach(next, depth);
    }
  }

  /// Whether a rim that parts lies between the islands of two panels.
  bool must_part(std::int32_t one, std::int32_t other, std::span<const std::array<std::int32_t, 2>> parting) {
    const auto a = islands_.find(one), b = islands_.find(other);
    return std::ranges::any_of(parting, [&](const auto& panels) {
      const auto c = islands_.find(panels[0]), d = islands_.find(panels[1]);
      return (a == c && b == d) || (a == d && b == c);
    });
  }

  /// Whether a panel lies on top of a placed one of the same island.
  bool covers_others(std::int32_t panel, std::int32_t island) {
    for (std::int32_t p = 0; index(p) < panels_.size(); ++p) {
      if (is_placed_[p] != 0 && islands_.find(p) == islands_.find(island) &&
          cover_each_other(panels_[p], panels_[panel])) {
        return true;
      }
    }
    return false;
  }

  bool cover_each_other(const Panel& one, const Panel& other) const {
    const Poll poll(task_);
    Eigen::AlignedBox2d box;
    for (const std::int32_t f : other.faces) {
      for (const Point2& corner : flat_[f]) box.extend(corner);
    }
    for (std::size_t k = 0; k < one.faces.size(); ++k) {
      poll.at(k);
      const Corners& a = flat_[one.faces[k]];
      Eigen::AlignedBox2d own;
      for (const Point2& corner : a) own.extend(corner);
      if (!own.intersects(box)) continue;
      for (const std::int32_t f : other.faces) {
        if (overlap(a, flat_[f])) return true;
      }
    }
    return false;
  }

  /// Whether two triangles share more than a rim. A line parts them otherwise, along a side of one of them.
  bool overlap(const Corners& one, const Corners& other) const {
    for (const auto& [a, b] : {std::pair(&one, &other), std::pair(&other, &one)}) {
      for (std::size_t i = 0; i < 3; ++i) {
        const Point2 from = (*a)[i], along = (*a)[(i + 1) % 3] - from;
        const double length = along.norm();
        if (!(length > 0.0)) return false;
        const auto is_outside = [&](const Point2& p) { return cross(along, p - from) <= 2.0 * gap_ * length; };
        if (std::ranges::all_of(*b, is_outside)) return false;
      }
    }
    return true;
  }

  const NetProblem& problem_;
  const PlanMesh& mesh_;
  std::vector<Corners>& flat_;
  std::vector<std::uint8_t>& is_laid_;
  double gap_;  // that unfolded triangles may leave between them
  const Task& task_;
  std::map<std::int32_t, std::int32_t> panel_of_;  // by region
  std::vector<Panel> panels_;
  std::vector<PanelRim> rims_;
  std::vector<std::array<std::int32_t, 2>> parting_;
  std::vector<std::uint8_t> is_placed_;
  std::size_t placed_count_ = 0;
  DisjointSets islands_{0};
  std::vector<std::size_t> folds_;  // rims
};

}  // namespace

std::vector<std::uint8_t> find_folds(const NetProblem& problem, const Task& task) {
  const PlanMesh& mesh = problem.mesh;
  std::vector<std::uint8_t> is_fold(mesh.edge_count(), 0);
  std::vector<Corners> flat(mesh.face_count());
  std::vector<std::uint8_t> is_laid(mesh.face_count(), 0);
  std::vector<std::vector<std::int32_t>> faces(index(problem.pieces.count));
  const Poll poll(task);
  for (std::int32_t f = 0; index(f) < mesh.face_count(); ++f) {
    poll.at(index(f));
    faces[problem.pieces.of_face[f]].push_back(f);
  }
  for (std::size_t p = 0; p < faces.size(); ++p) {
    task.check(0.0);
    if (problem.diagonals[p] > 0.0)
      PieceNet(problem, flat, is_laid, problem.diagonals[p], task).find(faces[p], is_fold);
  }
  return is_fold;
}

}  // namespace seamwire::detail
