// SPDX-License-Identifier: GPL-3.0-or-later
#include "slits/slit_tree.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <map>
#include <numeric>
#include <optional>
#include <queue>
#include <set>
#include <unordered_map>
#include <unordered_set>
#include <utility>

#include "detail/index.hpp"
#include "detail/infinity.hpp"
#include "detail/poll.hpp"
#include "detail/rounded.hpp"
#include "detail/run_on_threads.hpp"
#include "graph/cotree.hpp"
#include "graph/disjoint_sets.hpp"
#include "graph/shortest_paths.hpp"
#include "prices/border_odds.hpp"
#include "slits/flat_holes.hpp"
#include "slits/slit_paths.hpp"
#include "slits/slit_plan.hpp"
#include "tuning/constants.hpp"

namespace seamwire::detail {

IslandGraph::IslandGraph(const Island& island, std::span<const Vector> points, const Task& task)
    : areas(island.vertices.size(), 0.0) {
  Poll poll(task);
  const auto point = [&](const Triangle& t, std::size_t i) { return points[island.vertices[t[i % 3]]]; };
  for (const Triangle& t : island.triangles) {
    poll.next();
    const double area = 0.5 * (point(t, 1) - point(t, 0)).cross(point(t, 2) - point(t, 0)).norm();
    for (const std::int32_t v : t) areas[v] += rounded(area / 3.0);
  }
  neighbors = Csr<Neighbor>(island.vertices.size(), [&](const auto& visit) {
    for (std::size_t h = 0; h < island.twins.size(); ++h) {
      poll.next();
      const std::int32_t twin = island.twins[h];
      if (twin >= 0 && index(twin) < h) continue;
      const Triangle& t = island.triangles[h / 3];
      const std::size_t i = h % 3;
      const double length = rounded((point(t, i + 1) - point(t, i)).norm());
      visit(t[i], Neighbor{t[(i + 1) % 3], length});
      visit(t[(i + 1) % 3], Neighbor{t[i], length});
    }
  });
}

std::vector<double> IslandGraph::distances_from(std::int32_t vertex, const Task& task) const {
  Poll poll(task);
  std::vector<double> least(areas.size(), kInfinity);
  find_shortest_paths(std::array{vertex}, least, [&](std::int32_t v, const auto& step) {
    poll.next();
    for (const auto& [next, length] : neighbors[v]) step(next, length);
  });
  return least;
}

std::vector<double> IslandGraph::mean_distances(const Task& task) const {
  constexpr std::size_t kSamples = 48;
  constexpr std::size_t kSmall = 1000;  // fewer vertices are measured sooner than threads are started
  constexpr double kGolden = 0.6180339887498949;
  std::vector<double> until(areas.size());
  std::partial_sum(areas.begin(), areas.end(), until.begin());
  std::vector<std::vector<double>> distances(kSamples);
  const auto measure = [&](std::size_t i, const Task& own) {
    const double place = std::fmod((static_cast<double>(i) + 0.5) * kGolden, 1.0) * until.back();
    const auto at = std::min(until.end() - 1, std::lower_bound(until.begin(), until.end(), place));
    distances[i] = distances_from(static_cast<std::int32_t>(at - until.begin()), own);
  };
  if (areas.size() < kSmall) {
    for (std::size_t i = 0; i < kSamples; ++i) measure(i, task);
  } else {
    run_on_threads(
        kSamples, task, [](std::size_t done) { return static_cast<double>(done) / kSamples; }, measure);
  }
  std::vector<double> mean(areas.size(), 0.0);
  for (const std::vector<double>& one : distances) {
    for (std::size_t v = 0; v < mean.size(); ++v) mean[v] += one[v] / kSamples;
  }
  return mean;
}

std::vector<std::int32_t> IslandGraph::peaks(std::span<const double> heights, double prominence) const {
  std::vector<std::int32_t> order(heights.size());
  std::iota(order.begin(), order.end(), 0);
  std::ranges::stable_sort(order, std::ranges::greater(), [&](std::int32_t v) { return heights[v]; });
  // Flood from above: where two hills meet, the lower one's prominence is known.
  DisjointSets sets(heights.size());
  std::vector<std::int32_t> summit(heights.size(), -1);
  std::vector<std::pair<double, std::int32_t>> found;
  for (const std::int32_t v : order) {
    std::int32_t highest = v;
    for (const Neighbor& next : neighbors[v]) {
      const std::int32_t other = summit[sets.find(next.vertex)];
      if (other < 0 || sets.find(next.vertex) == sets.find(v)) continue;
      const std::int32_t lower = heights[other] > heights[highest] ? highest : other;
      if (lower != v && heights[lower] - heights[v] >= prominence) found.push_back({heights[lower], lower});
      highest = lower == highest ? other : highest;
      sets.join(v, next.vertex);
    }
    summit[sets.find(v)] = highest;
  }
  if (!order.empty() && heights[order.front()] - heights[order.back()] >= prominence) {
    found.push_back({heights[order.front()], order.front()});
  }
  std::ranges::sort(
      found, [](const auto& a, const auto& b) { return a.first != b.first ? a.first > b.first : a.second < b.second; });
  std::vector<std::int32_t> peaks;
  peaks.reserve(found.size());
  for (const auto& [height, v] : found) peaks.push_back(v);
  return peaks;
}

PieceBody::PieceBody(const SlitProblem& problem, std::int32_t piece, const Task& task)
    : size(rounded(std::sqrt(problem.by_piece[piece].area))),
      island(std::move(islands_of(problem, problem.is_seam, piece, task).front())),
      graph(island, problem.mesh->points, task) {
  for (const std::vector<std::int32_t>& loop : island.boundaries()) {
    std::vector<std::int32_t> vertices;
    for (const std::int32_t own : loop) vertices.push_back(island.vertices[own]);
    loops.push_back(std::move(vertices));
  }
}

std::int64_t PieceBody::genus() const { return (2 - island.euler_characteristic() - std::ssize(loops)) / 2; }

std::int32_t onto_plane(const SlitProblem& problem, const PieceBody& body, std::int32_t tip) {
  const Reflection& reflection = *problem.reflection;
  if (reflection.sides[tip] == 0) return tip;
  std::int32_t nearest = tip;
  double least = tuning::kApart * body.size;
  for (const std::int32_t v : body.island.vertices) {
    if (reflection.sides[v] != 0) continue;
    const double distance = (problem.mesh->points[v] - problem.mesh->points[tip]).norm();
    if (distance < least) {
      least = distance;
      nearest = v;
    }
  }
  return nearest;
}

std::vector<std::int32_t> find_tips(const SlitProblem& problem, const PieceBody& body,
                                    std::span<const double> distances) {
  std::vector<std::int32_t> vertices = body.island.vertices;
  std::ranges::sort(vertices);
  std::vector<std::int32_t> tips, images;
  for (const std::int32_t own : body.graph.peaks(distances, tuning::kTipProminence * body.size)) {
    std::int32_t tip = body.island.vertices[own];
    if (problem.reflection) {
      tip = onto_plane(problem, body, tip);
      const std::int32_t image = problem.reflection->images[tip];
      if (problem.reflection->sides[tip] < 0 && std::ranges::binary_search(vertices, image)) {
        images.push_back(image);
        continue;
      }
    }
    if (std::ranges::find(tips, tip) == tips.end()) tips.push_back(tip);
  }
  // Where several vertices are equally far, the two peaks of a pair need not be images of each other.
  const std::size_t count = tips.size();
  for (const std::int32_t image : images) {
    const bool is_known =
        std::ranges::any_of(tips.begin(), tips.begin() + static_cast<std::ptrdiff_t>(count), [&](std::int32_t tip) {
          return (problem.mesh->points[tip] - problem.mesh->points[image]).norm() < tuning::kTipProminence * body.size;
        });
    if (!is_known && std::ranges::find(tips, image) == tips.end()) tips.push_back(image);
  }
  return tips;
}

namespace {

/// Something that the tree may come to: any of some vertices.
struct Terminal {
  enum class Kind : std::uint8_t {
    kTip,
    kLoop,
    kHole,  ///< a loop that the tree need not reach
  };
  std::vector<std::int32_t> vertices;
  Kind kind = Kind::kTip;
  bool is_open = true;  ///< whether the tree has not reached it

  bool is_goal() const { return is_open && kind != Kind::kHole; }
};

/// Whether a seam may run along one of a vertex' edges.
bool may_be_cut(const SlitProblem& problem, std::int32_t vertex) {
  return std::ranges::any_of(problem.mesh->neighbors[vertex],
                             [&](const PlanNeighbor& next) { return problem.prices.of_edge[next.edge] != kInfinity; });
}

/// The vertex of a closed piece at which its first slit starts: central and hidden, on the mirror plane if it crosses
/// the piece.
std::int32_t find_root(const SlitProblem& problem, const PieceBody& body, std::span<const double> distances) {
  const double least = *std::ranges::min_element(distances);
  const auto is_on_plane = [&](std::int32_t v) {
    return problem.reflection && problem.reflection->sides[v] == 0 && may_be_cut(problem, v);
  };
  const bool has_plane = std::ranges::any_of(body.island.vertices, is_on_plane);
  std::int32_t best = body.island.vertices.front();
  double least_price = kInfinity;
  for (std::size_t own = 0; own < body.island.vertices.size(); ++own) {
    const std::int32_t v = body.island.vertices[own];
    if (has_plane ? !is_on_plane(v) : !may_be_cut(problem, v)) continue;
    const double price = (least > 0.0 ? distances[own] / least : 1.0) + problem.prices.visibility[v];
    if (price < least_price) {
      least_price = price;
      best = v;
    }
  }
  return best;
}

/// Cuts along the shortest loops around and through the handles of a piece, from a root on its cut.
class HandleLoops {
 public:
  HandleLoops(const SlitProblem& problem, const PieceBody& body, std::int32_t root, const Task& task)
      : problem_(problem),
        island_(body.island),
        task_(task),
        poll_(task),
        price_(island_.vertices.size(), kInfinity),
        before_(price_.size(), -1) {
    root_ = static_cast<std::int32_t>(std::ranges::find(island_.vertices, root) - island_.vertices.begin());
    find_tree(root_);
  }

  /// One chain of mesh vertices for each loop that no keep-out area is in the way of: from the root around a handle, to
  /// the root or to a chain before. Closed lines of edges are taken in their place if they do not cost much more.
  std::vector<std::vector<std::int32_t>> find() {
    std::vector<std::pair<double, std::int32_t>> inner;  // half-edges with the lengths of their loops
    for (std::int32_t h = 0; index(h) < island_.twins.size(); ++h) {
      poll_.next();
      if (island_.twins[h] > h && !is_in_tree(h)) inner.push_back({-loop_price(h), h});
    }
    polled_sort(inner, Poll(task_));
    const auto sides = [&](std::size_t i) {
      return std::pair(inner[i].second / 3, island_.twins[inner[i].second] / 3);
    };
    const Cotree cotree(island_.triangles.size(), inner.size(), sides, Poll(task_));
    std::vector<std::pair<double, std::int32_t>> through;  // the half-edges that loops lead through
    for (const std::int32_t i : cotree.generators) {
      if (std::isfinite(inner[i].first)) through.emplace_back(-inner[i].first, inner[i].second);
    }
    std::vector<std::int32_t> crossed;  // half-edges of a tree of triangles
    for (const std::int32_t i : cotree.crossed) crossed.push_back(inner[i].second);
    std::ranges::reverse(through);
    std::vector<std::vector<std::int32_t>> loops = along_lines(through, crossed);
    if (!loops.empty()) return loops;
    for (const auto& [price, h] : through) loops.push_back(loop_through(h));
    return loops;
  }

  /// The vertex on the loops that is cheapest to reach from the root.
  std::int32_t start() {
    std::vector<std::pair<double, std::int32_t>> reached;
    std::unordered_map<std::int32_t, double> price;
    for (std::size_t own = 0; own < price_.size(); ++own) price.emplace(island_.vertices[own], price_[own]);
    for (const std::vector<std::int32_t>& loop : find()) {
      for (const std::int32_t v : loop) reached.emplace_back(price.at(v), v);
    }
    return reached.empty() ? island_.vertices[root_] : std::ranges::min(reached).second;
  }

  /// The cheapest chain of mesh vertices from the root to one of some own vertices.
  std::vector<std::int32_t> path_to(std::span<const std::int32_t> vertices) const {
    const auto price = [&](std::int32_t v) { return price_[v]; };
    std::vector<std::int32_t> path;
    for (std::int32_t v = *std::ranges::min_element(vertices, {}, price); v >= 0; v = before_[v]) {
      path.push_back(island_.vertices[v]);
    }
    std::ranges::reverse(path);
    return path;
  }

 private:
  double edge_price(std::int32_t h) const {
    if (island_.twins[h] < 0) return 0.0;
    const std::int32_t edge = problem_.mesh->edge_of[3 * island_.faces[h / 3] + h % 3];
    return problem_.prices.of_edge[edge];
  }
  double loop_price(std::int32_t h) const { return price_[island_.tail(h)] + price_[island_.tip(h)] + edge_price(h); }
  bool is_in_tree(std::int32_t h) const {
    return before_[island_.tail(h)] == island_.tip(h) || before_[island_.tip(h)] == island_.tail(h);
  }

  void find_tree(std::int32_t root) {
    const Csr<std::pair<std::int32_t, double>> neighbors(price_.size(), [&](const auto& visit) {
      for (std::int32_t h = 0; index(h) < island_.twins.size(); ++h) {
        poll_.next();
        const double price = edge_price(h);
        if ((island_.twins[h] >= 0 && island_.twins[h] < h) || !std::isfinite(price)) continue;
        visit(island_.tail(h), std::pair(island_.tip(h), price));
        visit(island_.tip(h), std::pair(island_.tail(h), price));
      }
    });
    find_shortest_paths(std::array{root}, price_, [&](std::int32_t v, const auto& step) {
      poll_.next();
      for (const auto& [next, price] : neighbors[v]) {
        if (step(next, price)) before_[next] = v;
      }
    });
  }

  /// Closed lines of edges that cut all handles, the cheapest ones; none if there are no such lines, or they cost too
  /// much more than the loops through some half-edges. `crossed`: half-edges of a tree of all triangles.
  std::vector<std::vector<std::int32_t>> along_lines(std::span<const std::pair<double, std::int32_t>> through,
                                                     std::span<const std::int32_t> crossed) {
    using Sides = std::uint64_t;  // a bit for each loop
    if (through.empty() || through.size() > 64) return {};
    // A closed line parts the surface unless it crosses the path between both sides of some loop an odd number of
    // times.
    std::vector<std::vector<std::int32_t>> around(island_.triangles.size());
    for (const std::int32_t h : crossed) {
      around[h / 3].push_back(h);
      around[island_.twins[h] / 3].push_back(island_.twins[h]);
    }
    std::vector<std::int32_t> entered(island_.triangles.size(), -1), order{0};
    for (std::size_t k = 0; k < order.size(); ++k) {
      poll_.next();
      for (const std::int32_t h : around[order[k]]) {
        const std::int32_t next = island_.twins[h] / 3;
        if (next == 0 || entered[next] >= 0) continue;
        entered[next] = island_.twins[h];
        order.push_back(next);
      }
    }
    std::vector<Sides> crossings(problem_.mesh->edge_count(), 0);
    for (std::size_t i = 0; i < through.size(); ++i) {
      const std::int32_t h = through[i].second;
      crossings[edge_at(h)] ^= Sides{1} << i;
      for (std::int32_t f : {h / 3, island_.twins[h] / 3}) {
        for (; entered[f] >= 0; f = island_.twins[entered[f]] / 3) crossings[edge_at(entered[f])] ^= Sides{1} << i;
      }
    }
    std::vector<std::pair<double, std::vector<std::int32_t>>> lines = closed_lines();
    std::ranges::sort(lines);
    std::vector<Sides> known;  // of the chosen lines, each without the highest bits of those before
    std::vector<std::vector<std::int32_t>> chosen;
    double price = 0.0;
    for (const auto& [own_price, chain] : lines) {
      Sides sides = 0;
      for (std::size_t i = 1; i < chain.size(); ++i) {
        sides ^= crossings[problem_.mesh->edge_between(chain[i - 1], chain[i])];
      }
      for (const Sides other : known) sides = std::min(sides, sides ^ other);
      if (sides == 0) continue;
      known.push_back(sides);
      std::ranges::sort(known, std::ranges::greater());
      chosen.push_back(chain);
      price += own_price;
    }
    double least = 0.0;
    for (const auto& [own_price, h] : through) least += own_price;
    if (chosen.size() < through.size() || price > tuning::kLineDetour * least) return {};
    return chosen;
  }

  std::int32_t edge_at(std::int32_t h) const { return problem_.mesh->edge_of[3 * island_.faces[h / 3] + h % 3]; }

  /// The lines of edges inside of the island that are closed, with their prices.
  std::vector<std::pair<double, std::vector<std::int32_t>>> closed_lines() const {
    const PlanMesh& mesh = *problem_.mesh;
    std::vector<std::uint8_t> is_inner(mesh.edge_count(), 0);
    for (std::int32_t h = 0; index(h) < island_.twins.size(); ++h) {
      if (island_.twins[h] >= 0) is_inner[edge_at(h)] = 1;
    }
    const Polygons polygons = find_polygons(mesh, problem_.is_seam, task_);
    std::vector<std::pair<double, std::vector<std::int32_t>>> found;
    for (const std::vector<std::int32_t>& line : find_lines(mesh, polygons, task_)) {
      if (line.size() < 3 || std::ranges::any_of(line, [&](std::int32_t e) { return is_inner[e] == 0; })) continue;
      const auto ends = [&](std::int32_t e) {
        return std::array{mesh.tail(mesh.half_edge_of[e]), mesh.tip(mesh.half_edge_of[e])};
      };
      const auto [a, b] = ends(line[0]);
      const auto [c, d] = ends(line[1]);
      std::vector<std::int32_t> chain{a == c || a == d ? b : a};
      double price = 0.0;
      for (const std::int32_t e : line) {
        const auto [tail, tip] = ends(e);
        if (tail != chain.back() && tip != chain.back()) break;
        chain.push_back(tail == chain.back() ? tip : tail);
        price += problem_.prices.of_edge[e];
      }
      const bool is_closed = chain.size() == line.size() + 1 && chain.front() == chain.back();
      if (is_closed && std::isfinite(price)) found.emplace_back(price, std::move(chain));
    }
    return found;
  }

  std::vector<std::int32_t> loop_through(std::int32_t h) const {
    std::vector<std::int32_t> there, back;
    for (std::int32_t v = island_.tail(h); v >= 0; v = before_[v]) there.push_back(v);
    for (std::int32_t v = island_.tip(h); v >= 0; v = before_[v]) back.push_back(v);
    std::ranges::reverse(there);
    there.insert(there.end(), back.begin(), back.end());
    for (std::int32_t& v : there) v = island_.vertices[v];
    return there;
  }

  const SlitProblem& problem_;
  const Island& island_;
  std::int32_t root_ = -1;  // an own vertex
  const Task& task_;
  Poll poll_;
  std::vector<double> price_;
  std::vector<std::int32_t> before_;
};

/// Slits along loops of handles. A loop that comes back to itself, or to a slit before, ends there.
std::vector<Slit> handle_slits(const SlitProblem& problem, const std::vector<std::vector<std::int32_t>>& loops) {
  std::vector<Slit> slits;
  std::set<std::int32_t> cut;
  for (const std::vector<std::int32_t>& loop : loops) {
    Slit slit{.path = {}, .image = {}, .is_needed = true};
    for (std::size_t i = 1; i < loop.size(); ++i) {
      const std::int32_t edge = problem.mesh->edge_between(loop[i - 1], loop[i]);
      if (edge < 0 || problem.mesh->is_boundary(edge) || problem.is_seam[edge] != 0 || !cut.insert(edge).second) {
        if (slit.path.size() > 1) slits.push_back(slit);
        slit.path.clear();
        continue;
      }
      if (slit.path.empty()) slit.path.push_back(loop[i - 1]);
      slit.path.push_back(loop[i]);
    }
    if (slit.path.size() > 1) slits.push_back(slit);
  }
  return slits;
}

/// Grows the tree in all pieces.
class TreeGrowth {
 public:
  TreeGrowth(const SlitProblem& problem, const TreeGoal& goal, const Task& task)
      : problem_(problem), is_on_cut_(problem.mesh->vertex_count(), 0), goal_(goal), task_(task) {}

  SlitTree grow() {
    for (std::int32_t p = 0; index(p) < problem_.by_piece.size(); ++p) {
      task_.check(0.0);
      begin_piece(p);
    }
    // The mirror image of a slit may lie in another piece, and may reach terminals there.
    for (std::size_t p = 0; p < states_.size(); ++p) reach_terminals(p);
    for (std::int32_t p = 0; index(p) < states_.size(); ++p) cut_uncut(p);
    for (const std::int32_t root : tree_.roots) trim_stub(root);
    for (Slit& slit : tree_.slits) lengthen_single_edge(slit);
    return std::move(tree_);
  }

 private:
  /// A piece, and how far its tree has grown.
  struct State {
    PieceBody body;
    std::vector<Terminal> terminals;
    std::unordered_map<std::int32_t, std::vector<std::size_t>> terminals_at;  ///< by vertex
    std::vector<std::int32_t> vertices;      ///< of its cut; boundary loops that are not reached yet are left out
    std::unordered_set<std::int32_t> is_in;  ///< the same
    bool has_cut = false;  ///< with its boundary; a single edge with both sides is too little for a map

    void add(Terminal terminal) {
      for (const std::int32_t v : terminal.vertices) terminals_at[v].push_back(terminals.size());
      terminals.push_back(std::move(terminal));
    }
  };

  void begin_piece(std::int32_t number) {
    State& state = states_.emplace_back(State{
        .body = PieceBody(problem_, number, task_), .terminals = {}, .terminals_at = {}, .vertices = {}, .is_in = {}});
    const PieceBody& body = state.body;
    const std::vector<double> distances = body.graph.mean_distances(task_);
    std::int32_t root = -1;
    std::vector<std::vector<std::int32_t>> loops = body.loops;
    if (goal_.keeps_holes) {
      for (std::vector<std::int32_t>& hole : leave_flat_holes(body, loops)) {
        state.add({std::move(hole), Terminal::Kind::kHole});
      }
    }
    if (goal_.has_tips) {
      for (std::vector<std::int32_t>& hole : leave_exposed_holes(number, body, distances, loops)) {
        state.add({std::move(hole), Terminal::Kind::kHole});
      }
    }
    if (loops.empty()) {
      root = find_root(problem_, body, distances);
      if (body.genus() > 0) root = HandleLoops(problem_, body, root, task_).start();
      tree_.roots.push_back(root);
      join(state, std::vector<std::int32_t>{root});
    } else {
      const auto length = [&](const auto& loop) { return rounded(loop_length(loop, problem_.mesh->points)); };
      std::ranges::stable_sort(loops, std::ranges::greater(), length);
      state.has_cut = loops.size() > 1 || loops.front().size() > 2;
      root = loops.front().front();
      for (std::size_t i = 1; i < loops.size(); ++i) state.add({loops[i], Terminal::Kind::kLoop});
      join(state, loops.front());
    }
    cut_handles(state, root);
    if (!goal_.has_tips) return;
    for (const std::int32_t tip : find_tips(problem_, body, distances)) {
      if (!state.is_in.contains(tip)) state.add({{tip}, Terminal::Kind::kTip});
    }
  }

  /// Takes out and returns the flat_holes() of all loops of a piece.
  std::vector<std::vector<std::int32_t>> leave_flat_holes(const PieceBody& body,
                                                          std::vector<std::vector<std::int32_t>>& loops) const {
    const std::vector<std::uint8_t> is_flat =
        flat_holes(body.island, problem_.mesh->points, body.island.boundaries(), task_);
    std::vector<std::vector<std::int32_t>> holes, left;
    for (std::size_t i = 0; i < loops.size(); ++i) (is_flat[i] != 0 ? holes : left).push_back(std::move(loops[i]));
    loops = std::move(left);
    return holes;
  }

  /// The length of a loop without the edges that it passes on both sides, as it does around an open seam.
  double one_sided_length(const std::vector<std::int32_t>& loop) const {
    std::map<std::int32_t, int> times;
    double length = 0.0;
    for (std::size_t i = 0; i < loop.size(); ++i) {
      const std::int32_t edge = problem_.mesh->edge_between(loop[i], loop[(i + 1) % loop.size()]);
      if (edge >= 0) ++times[edge];
    }
    for (const auto& [edge, count] : times) length += count == 1 ? problem_.mesh->lengths[edge] : 0.0;
    return length;
  }

  /// Whether a loop is a hole in a wider surface, as an eye or an open seam is, and not the end of a tube.
  bool is_hole(std::int32_t number, const std::vector<std::int32_t>& loop) const {
    const double length = one_sided_length(loop);
    if (!(length > 0.0)) return true;
    const PlanMesh& mesh = *problem_.mesh;
    Poll poll(task_);
    // Around most loops little of the mesh is near, so distances are kept only where the search comes.
    using Entry = std::pair<double, std::int32_t>;
    std::priority_queue<Entry, std::vector<Entry>, std::greater<>> open;
    std::unordered_map<std::int32_t, double> least;
    std::unordered_set<std::int32_t> is_done;
    for (const std::int32_t v : loop) {
      if (least.emplace(v, 0.0).second) open.emplace(0.0, v);
    }
    double area = 0.0;
    while (!open.empty() && open.top().first < length) {
      poll.next();
      const auto [away, v] = open.top();
      open.pop();
      if (!is_done.insert(v).second) continue;
      for (const auto& [next, edge] : mesh.all_neighbors[v]) {
        // The last corner to be reached adds its triangle.
        for (const std::int32_t h : {mesh.half_edge_of[edge], mesh.twins[mesh.half_edge_of[edge]]}) {
          if (h < 0 || mesh.tail(h) != v || problem_.pieces.of_face[h / 3] != number) continue;
          if (is_done.contains(mesh.tip(h)) && is_done.contains(mesh.apex(h))) area += problem_.areas[h / 3];
        }
        const double further = away + mesh.lengths[edge];
        const auto [known, is_new] = least.emplace(next, further);
        if (!is_new && !(further < known->second)) continue;
        known->second = further;
        open.emplace(further, next);
      }
      if (area > tuning::kLeastAround * length * length) return true;
    }
    return false;
  }

  /// Takes out and returns the holes that a slit from the hidden middle of the piece could only reach through an
  /// exposed place. An eye stays a hole of its island.
  std::vector<std::vector<std::int32_t>> leave_exposed_holes(std::int32_t number, const PieceBody& body,
                                                             std::span<const double> distances,
                                                             std::vector<std::vector<std::int32_t>>& loops) const {
    const std::vector<std::uint8_t>& exposed = problem_.prices.is_exposed;
    if (loops.empty() || std::ranges::none_of(body.island.vertices, [&](std::int32_t v) { return exposed[v] != 0; })) {
      return {};
    }
    std::vector<std::uint8_t> from(problem_.mesh->vertex_count(), 0);
    from[find_root(problem_, body, distances)] = 1;
    const SlitFinder finder(problem_, from, from, task_);
    std::vector<std::vector<std::int32_t>> holes;
    std::erase_if(loops, [&](std::vector<std::int32_t>& loop) {
      if (!is_hole(number, loop)) return false;
      const std::int32_t nearest = cheapest(finder, loop).second;
      const std::optional<Slit> slit = nearest < 0 ? std::nullopt : finder.slit_to(nearest);
      const bool is_left = slit && is_exposed(problem_, *slit);
      if (is_left) holes.push_back(std::move(loop));
      return is_left;
    });
    return holes;
  }

  /// Cuts the handles of a piece. A seam around a handle is two boundary loops with the same vertices: these are
  /// joined.
  void cut_handles(const State& state, std::int32_t root) {
    const PieceBody& body = state.body;
    std::vector<std::vector<std::int32_t>> reached_loops;  // loops on the cut
    for (std::vector<std::int32_t>& loop : body.island.boundaries()) {
      const auto is_on_cut = [&](std::int32_t own) { return state.is_in.contains(body.island.vertices[own]); };
      if (std::ranges::any_of(loop, is_on_cut)) reached_loops.push_back(std::move(loop));
    }
    if (body.genus() == 0 && reached_loops.size() < 2) return;
    HandleLoops handles(problem_, body, root, task_);
    std::vector<std::vector<std::int32_t>> chains;
    if (body.genus() > 0) chains = handles.find();
    for (const std::vector<std::int32_t>& loop : reached_loops) chains.push_back(handles.path_to(loop));
    for (Slit& slit : handle_slits(problem_, chains)) add(std::move(slit));
  }

  std::vector<std::uint8_t> flags(const State& state) const {
    std::vector<std::uint8_t> from(problem_.mesh->vertex_count(), 0);
    for (const std::int32_t v : state.vertices) from[v] = 1;
    return from;
  }

  /// Adds vertices to the cut of a piece, and the loops and tips that are reached by that. A second slit to a hole
  /// would part the piece.
  void join(State& state, std::vector<std::int32_t> vertices) {
    while (!vertices.empty()) {
      const std::int32_t v = vertices.back();
      vertices.pop_back();
      is_on_cut_[v] = 1;
      if (!state.is_in.insert(v).second) continue;
      state.vertices.push_back(v);
      const auto at = state.terminals_at.find(v);
      if (at == state.terminals_at.end()) continue;
      for (const std::size_t i : at->second) {
        Terminal& terminal = state.terminals[i];
        if (std::exchange(terminal.is_open, false)) {
          vertices.insert(vertices.end(), terminal.vertices.begin(), terminal.vertices.end());
        }
      }
    }
  }

  /// The piece in which a chain lies.
  State& state_at(std::span<const std::int32_t> chain) {
    const std::int32_t edge = problem_.mesh->edge_between(chain[0], chain[1]);
    return states_[problem_.pieces.of_face[problem_.mesh->half_edge_of[edge] / 3]];
  }

  void add_chain(const std::vector<std::int32_t>& chain) {
    State& state = state_at(chain);
    state.has_cut = true;
    join(state, chain);
  }

  /// Adds a slit to the tree, and its image unless that would start away from the tree or lead back to it.
  void add(Slit slit) {
    add_chain(slit.path);
    if (slit.image.size() > 1) {
      const bool has_start = state_at(slit.image).is_in.contains(slit.image.front());
      if (!has_start || is_on_cut_[slit.image.back()] != 0) slit.image.clear();
    }
    if (!slit.image.empty()) add_chain(slit.image);
    slit.is_join = !slit.is_needed && problem_.is_rim[slit.path.back()] != 0;
    tree_.slits.push_back(std::move(slit));
  }

  /// Finds slits within a piece. Seams around it lie in other pieces too.
  SlitFinder finder_in(std::size_t number) const {
    std::vector<std::uint8_t> is_outside(problem_.mesh->edge_count(), 1);
    for (const std::int32_t f : problem_.by_piece[number].faces) {
      for (std::int32_t i = 0; i < 3; ++i) is_outside[problem_.mesh->edge_of[3 * f + i]] = 0;
    }
    return {problem_, flags(states_[number]), is_on_cut_, task_, 1.0, std::move(is_outside)};
  }

  /// The vertex of a tip or loop that is cheapest to reach, with its price.
  std::pair<double, std::int32_t> cheapest(const SlitFinder& finder, std::span<const std::int32_t> vertices) const {
    const auto is_on_plane = [&](std::int32_t v) { return problem_.reflection && problem_.reflection->sides[v] == 0; };
    // A loop across the mirror plane is reached on the plane, for a slit elsewhere and its image would part it.
    const bool has_plane = std::ranges::any_of(vertices, is_on_plane);
    std::pair<double, std::int32_t> best{kInfinity, -1};
    for (const std::int32_t v : vertices) {
      if (!has_plane || is_on_plane(v)) best = std::min(best, {finder.price_to(v), v});
    }
    return best;
  }

  /// Lets the tree of a piece reach its loops and tips, always the one that is cheapest to reach (Takahashi and
  /// Matsuyama 1980). One search from the tree goes on as the tree grows.
  void reach_terminals(std::size_t number) {
    State& state = states_[number];
    if (std::ranges::none_of(state.terminals, &Terminal::is_goal)) return;
    SlitFinder finder = finder_in(number);
    std::vector<std::pair<double, std::int32_t>> nearest(state.terminals.size(), {kInfinity, -1});
    std::set<std::pair<std::pair<double, std::int32_t>, std::size_t>> open;
    const auto look_at = [&](std::size_t i) {
      open.erase({nearest[i], i});
      if (!state.terminals[i].is_goal()) return;
      nearest[i] = cheapest(finder, state.terminals[i].vertices);
      if (nearest[i].second >= 0) open.emplace(nearest[i], i);
    };
    for (std::size_t i = 0; i < nearest.size(); ++i) look_at(i);
    while (!open.empty()) {
      task_.check(0.0);
      const auto [reached, which] = *open.begin();
      open.erase(open.begin());
      Terminal& terminal = state.terminals[which];
      if (!terminal.is_goal()) continue;
      std::optional<Slit> slit = finder.slit_to(reached.second);
      const bool is_loop = terminal.kind == Terminal::Kind::kLoop;
      if (!slit || (!is_loop && is_exposed(problem_, *slit))) {  // out of reach, or through an exposed place
        terminal.is_open = false;
        continue;
      }
      slit->is_needed = is_loop;
      const std::size_t known = state.vertices.size();
      join(state, terminal.vertices);
      add(std::move(*slit));
      std::set<std::size_t> changed;
      for (const std::int32_t v : finder.start_from(std::span(state.vertices).subspan(known))) {
        const auto at = state.terminals_at.find(v);
        if (at != state.terminals_at.end()) changed.insert(at->second.begin(), at->second.end());
      }
      for (const std::size_t i : changed) look_at(i);
    }
  }

  /// A piece without a cut gets a slit to the point farthest from where its tree begins.
  void cut_uncut(std::int32_t number) {
    const State& state = states_[number];
    const PieceBody& body = state.body;
    if (state.has_cut) return;
    const SlitFinder finder = finder_in(index(number));
    const std::vector<double> away = edge_distances(*problem_.mesh, state.vertices, task_);
    std::int32_t farthest = -1;
    for (const std::int32_t v : body.island.vertices) {
      if (std::isfinite(finder.price_to(v)) && (farthest < 0 || away[v] > away[farthest])) farthest = v;
    }
    if (farthest < 0) return;
    const std::int32_t moved = problem_.reflection ? onto_plane(problem_, body, farthest) : farthest;
    if (std::isfinite(finder.price_to(moved))) farthest = moved;
    std::optional<Slit> slit = finder.slit_to(farthest);
    if (slit) add(std::move(*slit));
  }

  /// If only one slit starts at a root, removes the part before its first branch.
  void trim_stub(std::int32_t root) {
    Slit* only = nullptr;
    std::ptrdiff_t meeting = 0;  // how many chains' vertices are the root
    for (Slit& slit : tree_.slits) {
      meeting += std::ranges::count(slit.path, root) + std::ranges::count(slit.image, root);
      if (slit.path.front() == root) only = &slit;
    }
    if (only == nullptr || meeting > 1) return;
    const auto starts_at = [&](std::int32_t v) {
      return std::ranges::any_of(tree_.slits, [&](const Slit& other) {
        return (&other != only && other.path.front() == v) || (!other.image.empty() && other.image.front() == v);
      });
    };
    for (std::size_t i = 1; i < only->path.size(); ++i) {
      if (!starts_at(only->path[i])) continue;
      std::ranges::replace(tree_.roots, root, only->path[i]);
      only->path.erase(only->path.begin(), only->path.begin() + static_cast<std::ptrdiff_t>(i));
      if (only->path.size() < 2) tree_.slits.erase(tree_.slits.begin() + (only - tree_.slits.data()));
      return;
    }
  }

  /// A closed piece that is cut along one edge has an outline of two edges, and no map. It is cut along one edge more.
  void lengthen_single_edge(Slit& slit) {
    if (slit.path.size() != 2 || !slit.image.empty()) return;
    const std::int32_t edge = problem_.mesh->edge_between(slit.path[0], slit.path[1]);
    const std::int32_t piece = problem_.pieces.of_face[problem_.mesh->half_edge_of[edge] / 3];
    const auto is_elsewhere = [&](const Slit& other) {
      return &other == &slit || std::ranges::count(pieces_of(problem_, other), piece) == 0;
    };
    if (!states_[piece].body.loops.empty() || !std::ranges::all_of(tree_.slits, is_elsewhere)) return;
    std::int32_t next = -1;
    double least = kInfinity;
    for (const PlanNeighbor& neighbor : problem_.mesh->neighbors[slit.path[1]]) {
      if (neighbor.vertex == slit.path[0] || !(problem_.prices.of_edge[neighbor.edge] < least)) continue;
      least = problem_.prices.of_edge[neighbor.edge];
      next = neighbor.vertex;
    }
    if (next >= 0) slit.path.push_back(next);
  }

  const SlitProblem& problem_;
  std::vector<State> states_;
  std::vector<std::uint8_t> is_on_cut_;  // of any piece
  SlitTree tree_;
  const TreeGoal& goal_;
  const Task& task_;
};

}  // namespace

SlitTree grow_tree(const SlitProblem& problem, const TreeGoal& goal, const Task& task) {
  return TreeGrowth(problem, goal, task).grow();
}

}  // namespace seamwire::detail
