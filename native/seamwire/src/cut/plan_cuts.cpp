// SPDX-License-Identifier: GPL-3.0-or-later
#include "seamwire/cut/plan_cuts.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <set>
#include <string>
#include <tuple>
#include <utility>

#include "cut/cut_mesh.hpp"
#include "cut/joined_pieces.hpp"
#include "cut/nodes.hpp"
#include "cut/polygon_shape.hpp"
#include "cut/walk.hpp"
#include "detail/index.hpp"
#include "detail/poll.hpp"

namespace seamwire {

using namespace detail;

namespace {

using Chain = std::vector<std::int32_t>;
using CutSet = std::set<std::pair<std::int32_t, std::int32_t>>;

void check_point(const TriangulatedPolygons& mesh, const SurfacePoint& point, const std::string& what) {
  if (point.vertex >= 0) {
    check_index(point.vertex, mesh.points.size(), what + ": vertex");
    return;
  }
  check_index(point.face, mesh.triangles.size(), what + ": triangle", "triangles");
  double sum = 0.0;
  for (const double weight : point.barycentric) sum += weight >= 0.0 ? weight : -2.0;
  if (!(std::abs(sum - 1.0) <= 1e-9)) {
    throw InvalidInput(what + ": barycentric coordinates must be 0 or more, and their sum 1");
  }
}

void check_curve(const TriangulatedPolygons& mesh, std::span<const CutCurve> curves, std::size_t number) {
  const CutCurve& curve = curves[number];
  const std::string name = "curve " + std::to_string(number);
  if (curve.points.size() < 2) throw InvalidInput(name + ": expected two points or more");
  for (const Vector& point : curve.points) {
    if (!point.allFinite()) throw InvalidInput(name + ": a coordinate is not finite");
  }
  check_point(mesh, curve.start, name + ": start");
  if (curve.end) check_point(mesh, *curve.end, name + ": end");
  if (!curve.faces.empty() && curve.faces.size() + 1 != curve.points.size()) {
    throw InvalidInput(name + ": expected " + std::to_string(curve.points.size() - 1) + " triangles, or none");
  }
  if (curve.image_of != -1) check_index(curve.image_of, number, name + ": image of curve", "earlier curves");
}

/// Leads cuts straight over a polygon, without vertices inside, where they hardly bend and nothing is in the way.
class Straightener {
 public:
  Straightener(const PolygonShape& shape, const NodeTable& nodes, std::span<const Cut> cuts, const Task& task)
      : shape_(shape), nodes_(nodes), task_(task) {
    for (const auto& [one, two] : cuts) {
      beside_[one].push_back(two);
      beside_[two].push_back(one);
    }
    for (const auto& [node, neighbors] : beside_) {
      if (neighbors.size() == 2 && !shape.is_on_rim(node)) inner_.insert(node);
    }
    for (const auto& [one, two] : cuts) {
      if (!inner_.contains(one) && !inner_.contains(two)) kept_.insert(key(one, two));
    }
  }

  std::vector<Cut> straightened() {
    std::vector<Chain> waiting = chains();
    for (const Chain& chain : waiting) for_each_cut(chain, [this](const auto& cut) { bent_.insert(cut); });
    while (!waiting.empty()) {
      task_.check(0.0);
      const Chain chain = std::move(waiting.back());
      waiting.pop_back();
      for_each_cut(chain, [this](const auto& cut) { bent_.erase(cut); });
      const auto line = key(chain.front(), chain.back());
      if (chain.size() == 2) {
        kept_.insert(line);
        continue;
      }
      const std::ptrdiff_t farthest = shape_.farthest(chain);
      if (farthest < 0 && (kept_.contains(line) || is_free(chain.front(), chain.back()))) {
        kept_.insert(line);
        continue;
      }
      const auto middle = farthest < 0 ? static_cast<std::ptrdiff_t>(chain.size() / 2) : farthest;
      waiting.emplace_back(chain.begin(), chain.begin() + middle + 1);
      waiting.emplace_back(chain.begin() + middle, chain.end());
      for_each_cut(chain, [this](const auto& cut) { bent_.insert(cut); });
    }
    std::vector<Cut> cuts;
    for (const auto& [one, two] : kept_) cuts.push_back({one, two});
    return cuts;
  }

 private:
  static std::pair<std::int32_t, std::int32_t> key(std::int32_t one, std::int32_t two) { return std::minmax(one, two); }
  template <class Visit>
  static void for_each_cut(std::span<const std::int32_t> chain, const Visit& visit) {
    for (std::size_t i = 1; i < chain.size(); ++i) visit(key(chain[i - 1], chain[i]));
  }

  /// The chains over inner nodes, the longest last.
  std::vector<Chain> chains() const {
    std::set<Chain> known;
    std::vector<Chain> found;
    for (const auto& [node, neighbors] : beside_) {
      if (inner_.contains(node)) continue;
      for (const std::int32_t following : neighbors) {
        if (!inner_.contains(following)) continue;
        Chain chain = chain_from(node, following);
        if (chain.front() != chain.back() && known.insert(chain).second) found.push_back(std::move(chain));
      }
    }
    std::ranges::stable_sort(found, {}, &Chain::size);
    return found;
  }

  /// The chain over inner nodes that begins at a node. It is the same from both its ends.
  Chain chain_from(std::int32_t start, std::int32_t following) const {
    Chain chain{start, following};
    while (inner_.contains(chain.back())) {
      const Chain& ends = beside_.at(chain.back());
      chain.push_back(ends[0] == chain[chain.size() - 2] ? ends[1] : ends[0]);
    }
    Chain reversed(chain.rbegin(), chain.rend());
    const auto comes_first = [this](std::int32_t one, std::int32_t other) {
      return std::tie(nodes_[one].vertices, nodes_[one].weights) <
             std::tie(nodes_[other].vertices, nodes_[other].weights);
    };
    return std::ranges::lexicographical_compare(reversed, chain, comes_first) ? reversed : chain;
  }

  /// Whether the straight line between two nodes lies inside, and meets no other cut.
  bool is_free(std::int32_t one, std::int32_t two) const {
    if (!shape_.holds_line(one, two)) return false;
    const Vector a = shape_.seen(one), b = shape_.seen(two);
    for (const CutSet* cuts : {&kept_, &bent_}) {
      for (const auto& [c, d] : *cuts) {
        if (c == one || c == two || d == one || d == two) continue;
        if (crossing_of(a, b, shape_.seen(c), shape_.seen(d))) return false;
      }
    }
    return true;
  }

  const PolygonShape& shape_;
  const NodeTable& nodes_;
  const Task& task_;
  std::map<std::int32_t, Chain> beside_;  // the neighbors of each node
  std::set<std::int32_t> inner_;          // the nodes inside the polygon where a cut only bends
  CutSet kept_, bent_;                    // the cuts that stay, and those still to be straightened
};

/// Numbers the nodes that edits name, each once.
class UsedNodes {
 public:
  UsedNodes(const NodeTable& nodes, CutPlan& plan) : nodes_(nodes), plan_(plan) {}
  Cut operator()(const Cut& cut) { return {number(cut[0]), number(cut[1])}; }
  /// The number of a node; -1 if no edit names it.
  std::int32_t known(std::int32_t node) const {
    const auto found = number_of_.find(node);
    return found == number_of_.end() ? -1 : found->second;
  }

 private:
  std::int32_t number(std::int32_t node) {
    const auto [found, is_new] = number_of_.try_emplace(node, static_cast<std::int32_t>(plan_.nodes.size()));
    if (is_new) plan_.nodes.push_back(nodes_[node]);
    return found->second;
  }

  const NodeTable& nodes_;
  CutPlan& plan_;
  std::map<std::int32_t, std::int32_t> number_of_;
};

/// Tells cuts along edges from those across polygons.
void sort_out(const CutMesh& mesh, const NodeTable& nodes, std::span<const Piece> pieces, CutPlan& plan,
              const Task& task) {
  UsedNodes used(nodes, plan);
  std::map<std::int32_t, std::vector<Cut>> across;
  for (const Piece& piece : pieces) {
    if (is_along_side(mesh, nodes, piece)) {
      plan.along.push_back(used({piece.one, piece.two}));
    } else {
      across[piece.polygon].push_back({piece.one, piece.two});
    }
  }
  for (const auto& [polygon, cuts] : across) {
    const PolygonShape shape(mesh, nodes, polygon);
    PolygonCuts own{.polygon = polygon, .cuts = {}, .is_folded = shape.is_folded()};
    for (const Cut& cut : Straightener(shape, nodes, cuts, task).straightened()) own.cuts.push_back(used(cut));
    plan.across.push_back(std::move(own));
  }
  for (const auto& [pair, own] : nodes_on_pairs(nodes, pieces)) {
    EdgeSplit split{.edge = pair.first, .nodes = {}};
    for (const std::int32_t node : own) {
      if (pair.second < 0 && used.known(node) >= 0) split.nodes.push_back(used.known(node));
    }
    if (!split.nodes.empty()) plan.splits.push_back(std::move(split));
  }
}

}  // namespace

std::int32_t CutPlan::node_at(const Triangle& corners, const std::array<double, 3>& barycentric) const {
  const CutNode wanted = node_between(corners, barycentric, kCutNear);
  const auto found = std::ranges::find_if(nodes, [&wanted](const CutNode& node) { return is_near(node, wanted); });
  return found == nodes.end() ? -1 : static_cast<std::int32_t>(found - nodes.begin());
}

CutPlan plan_cuts(const TriangulatedPolygons& mesh, std::span<const CutCurve> curves, const Task& given) {
  constexpr double kWalked = 0.5;  // of the work
  const RisingProgress rising(given);
  const Task& task = rising.task();
  const CutMesh faces(mesh);
  for (std::size_t number = 0; number < curves.size(); ++number) check_curve(mesh, curves, number);
  CutPlan plan;
  NodeTable nodes;
  CurveEnds ends(nodes);
  std::vector<Piece> pieces;
  for (std::int32_t number = 0; index(number) < curves.size(); ++number) {
    task.check(kWalked * number / static_cast<double>(curves.size()));
    const CutCurve& curve = curves[number];
    const auto is_original = [&curve](const UncutCurve& uncut) { return uncut.curve == curve.image_of; };
    if (std::ranges::any_of(plan.left_out, is_original)) continue;
    const Walk walk = walk_along(faces, curve, nodes, task);
    if (walk.left_near >= 0) {
      plan.left_out.push_back({.curve = number, .vertex = walk.left_near});
      continue;
    }
    const std::vector<Piece> own = without_detours(walk.pieces);
    ends.add(own);
    pieces.insert(pieces.end(), own.begin(), own.end());
  }
  task.check(kWalked);
  pieces = joined(faces, nodes, std::move(pieces), task);
  pieces = without_slivers(faces, nodes, pieces, ends, task);
  sort_out(faces, nodes, without_spurs(nodes, pieces, ends), plan, task);
  return plan;
}

}  // namespace seamwire
