// SPDX-License-Identifier: GPL-3.0-or-later
#include "seamwire/edges/fit_chain.hpp"

#include <algorithm>
#include <cstddef>
#include <functional>
#include <queue>
#include <string>
#include <unordered_map>
#include <utility>

#include "detail/drop_repeats.hpp"
#include "detail/index.hpp"
#include "detail/infinity.hpp"
#include "detail/poll.hpp"
#include "edges/edge_adjacency.hpp"
#include "surface/point_segment.hpp"

namespace seamwire {

using namespace detail;

namespace {

// The cost, and how far a step goes along the line: measured on artists' seams (docs/method/drawn-lines.md).
constexpr double kOffLine = 32.0;
constexpr double kTurning = 0.25;
constexpr double kBack = 1.0, kBackOfEdge = 0.5, kAhead = 2.0, kAheadOfEdge = 1.5;
// Vertices farther from the line than this many edges are left out: what is nearer is far cheaper.
constexpr double kCorridor = 1.5;
// Points nearer to each other than this part of h say nothing more about the line.
constexpr double kPointsPerEdge = 8.0;
// Two chains over one directed edge are compared only where they are as near to each other on the line as this many h:
// elsewhere the line comes by again.
constexpr double kSamePlace = 4.0;
// So that a line of any length, on a mesh of any fineness, is not searched for long.
constexpr std::size_t kMostLabels = 500'000;

/// A line, its points thinned, with its length up to each of them.
class Line {
 public:
  Line(std::span<const Vector> points, double spacing) {
    for (std::size_t i = 0; i < points.size(); ++i) {
      const double gap = points_.empty() ? 0.0 : (points[i] - points_.back()).norm();
      const bool is_end = i == 0 || i + 1 == points.size();
      if (!is_end && gap < spacing) continue;
      along_.push_back(points_.empty() ? 0.0 : along_.back() + gap);
      points_.push_back(points[i]);
      numbers_.push_back(static_cast<double>(i));
    }
  }

  struct Nearest {
    double squared;  ///< distance
    double along;    ///< the line's length up to there
  };
  /// The point of a part of the line that is nearest to p.
  Nearest nearest(const Vector& p, double from, double to) const {
    from = std::clamp(from, 0.0, length());
    to = std::clamp(to, from, length());
    Nearest best{kInfinity, from};
    for (std::size_t i = segment_at(from); i + 1 < points_.size(); ++i) {
      if (i > 0 && along_[i] > to) break;
      const double whole = along_[i + 1] - along_[i];
      const auto part = [&](double at) { return whole > 0 ? std::clamp((at - along_[i]) / whole, 0.0, 1.0) : 0.0; };
      const double x = std::clamp(nearest_on_segment(p, points_[i], points_[i + 1]), part(from), part(to));
      const double squared = (points_[i] + x * (points_[i + 1] - points_[i]) - p).squaredNorm();
      if (squared < best.squared) best = {squared, along_[i] + x * whole};
    }
    return best;
  }
  double length() const { return along_.back(); }
  /// A length along the line as the number of a point, and a part of the way to the next.
  double place(double along) const {
    const std::size_t i = segment_at(along);
    if (i + 1 == points_.size()) return numbers_[i];
    const double whole = along_[i + 1] - along_[i];
    const double x = whole > 0 ? std::clamp((along - along_[i]) / whole, 0.0, 1.0) : 0.0;
    return numbers_[i] + x * (numbers_[i + 1] - numbers_[i]);
  }

 private:
  std::size_t segment_at(double along) const {
    const auto after = std::ranges::upper_bound(along_, along);
    const auto i = static_cast<std::size_t>(after - along_.begin());
    return std::min(std::max<std::size_t>(i, 1) - 1, std::max<std::size_t>(points_.size(), 2) - 2);
  }

  std::vector<Vector> points_;
  std::vector<double> along_, numbers_;
};

class ChainFit {
 public:
  ChainFit(const Surface& surface, const EdgeAdjacency& adjacency, const DrawnLine& drawn, double h)
      : surface_(surface), adjacency_(adjacency), h_(h), line_(drawn.points, h / kPointsPerEdge) {}

  FittedChain find(std::int32_t begin, std::int32_t end, double begin_gap, double end_gap, const Task& task) {
    Poll poll(task, 0.0, 0.0, 1, Poll::kFewSteps);
    const auto [squared, along] = line_.nearest(point(begin), 0.0, 2.0 * begin_gap + h_);
    labels_.push_back({0.0, along, squared, -1, -1});
    open_.push({0.0, 0});
    const double ends_from = line_.length() - 2.0 * end_gap - h_;
    std::int32_t farthest = 0;
    while (!open_.empty() && labels_.size() < kMostLabels) {
      const std::int32_t number = open_.top().label;
      open_.pop();
      Label& label = labels_[number];
      if (label.settled) continue;
      label.settled = true;
      const std::int32_t v = label.edge < 0 ? begin : adjacency_.head(label.edge);
      if (v == end && label.along >= ends_from) return chain_to(number, begin);
      if (label.along > labels_[farthest].along) farthest = number;
      for (std::int32_t out = adjacency_.begin(v); out < adjacency_.end(v); ++out) {
        poll.next();
        relax(number, out, begin, point(end));
      }
    }
    return chain_to(farthest, begin);
  }

 private:
  /// A directed edge that a chain has arrived over, at a place on the line.
  struct Label {
    double cost;
    double along;    // the place nearest to the edge's head: the line's length up to there
    double squared;  // the head's distance from there
    std::int32_t edge;
    std::int32_t before;  // the label that it comes from; -1: the first
    bool settled = false;
  };
  struct Open {
    double bound;
    std::int32_t label;
    bool operator>(const Open& other) const { return bound != other.bound ? bound > other.bound : label > other.label; }
  };

  const Vector& point(std::int32_t v) const { return surface_.points()[v]; }

  void relax(std::int32_t from, std::int32_t over, std::int32_t begin, const Vector& goal) {
    const Label here = labels_[from];
    const std::int32_t v = here.edge < 0 ? begin : adjacency_.head(here.edge), w = adjacency_.head(over);
    const double length = (point(w) - point(v)).norm();
    const double low = here.along - kBack * h_ - kBackOfEdge * length;
    const double high = here.along + kAhead * h_ + kAheadOfEdge * length;
    const double widest = kCorridor * std::max(h_, length);
    const auto [squared, along] = line_.nearest(point(w), low, high);
    if (squared > widest * widest) return;
    const double middle = line_.nearest(0.5 * (point(v) + point(w)), low, high).squared;
    const double off = (here.squared + middle + squared) / 3.0;
    const double turn = here.edge < 0 ? 0.0 : adjacency_.turn(adjacency_.twin(here.edge), over);
    const double cost = here.cost + length * (1.0 + kOffLine * off / (h_ * h_)) + kTurning * h_ * turn;
    const auto bucket = static_cast<std::uint64_t>(std::min(1e9, along / (kSamePlace * h_)));
    const std::uint64_t key = bucket * adjacency_.directed_count() + static_cast<std::uint64_t>(over);
    const auto next = static_cast<std::int32_t>(labels_.size());
    const auto [known, is_new] = newest_.try_emplace(key, next);
    if (!is_new && !(cost < labels_[known->second].cost)) return;
    if (!is_new) labels_[known->second].settled = true;  // a cheaper one is there
    known->second = next;
    labels_.push_back({cost, along, squared, over, from});
    open_.push({cost + (goal - point(w)).norm(), next});
  }

  /// The chain up to a label, without what it passes both ways.
  FittedChain chain_to(std::int32_t label, std::int32_t begin) const {
    std::vector<std::int32_t> steps;
    for (; label >= 0; label = labels_[label].before) steps.push_back(label);
    std::ranges::reverse(steps);
    FittedChain chain;
    for (const std::int32_t step : steps) {
      const Label& at = labels_[step];
      const std::int32_t v = at.edge < 0 ? begin : adjacency_.head(at.edge);
      const std::size_t count = chain.vertices.size();
      if (count >= 2 && chain.vertices[count - 2] == v) {
        chain.vertices.pop_back();
        chain.places.pop_back();
        continue;
      }
      chain.vertices.push_back(v);
      chain.places.push_back(line_.place(at.along));
    }
    return chain.vertices.size() < 2 ? FittedChain{} : chain;
  }

  const Surface& surface_;
  const EdgeAdjacency& adjacency_;
  double h_;
  Line line_;
  std::vector<Label> labels_;
  std::unordered_map<std::uint64_t, std::int32_t> newest_;  // by directed edge and place
  std::priority_queue<Open, std::vector<Open>, std::greater<>> open_;
};

/// The median length of the edges at the corners of the line's faces; 0 without edges.
double median_edge(const Surface& surface, const EdgeAdjacency& adjacency, const DrawnLine& line) {
  std::vector<std::int32_t> vertices;
  std::int32_t last = -1;
  for (const std::int32_t face : line.faces) {
    if (std::exchange(last, face) == face) continue;
    for (const std::int32_t v : surface.triangles()[face]) vertices.push_back(v);
  }
  std::ranges::sort(vertices);
  drop_repeats(vertices);
  std::vector<double> lengths;
  for (const std::int32_t v : vertices) {
    for (std::int32_t e = adjacency.begin(v); e < adjacency.end(v); ++e) {
      lengths.push_back((surface.points()[adjacency.head(e)] - surface.points()[v]).norm());
    }
  }
  if (lengths.empty()) return 0.0;
  const auto middle = lengths.begin() + static_cast<std::ptrdiff_t>(lengths.size() / 2);
  std::ranges::nth_element(lengths, middle);
  return *middle;
}

/// The vertex with an edge that is nearest to a point, among the corners of its face and the vertices beside them; -1
/// where none has edges.
std::int32_t nearest_vertex(const Surface& surface, const EdgeAdjacency& adjacency, const Vector& p,
                            std::int32_t face) {
  std::int32_t best = -1;
  double least = kInfinity;
  const auto look = [&](std::int32_t v) {
    const double squared = (surface.points()[v] - p).squaredNorm();
    if (adjacency.begin(v) == adjacency.end(v) || !(squared < least)) return;
    least = squared;
    best = v;
  };
  for (const std::int32_t v : surface.triangles()[face]) {
    look(v);
    for (std::int32_t e = adjacency.begin(v); e < adjacency.end(v); ++e) look(adjacency.head(e));
  }
  return best;
}

}  // namespace

FittedChain fit_chain(const Surface& surface, const EdgeAdjacency& adjacency, const DrawnLine& line,
                      std::optional<std::int32_t> begin, std::optional<std::int32_t> end, const Task& task) {
  adjacency.check_size(surface);
  const std::size_t count = line.points.size();
  if (line.faces.size() != count) {
    throw InvalidInput("line: " + std::to_string(count) + " points, but " + std::to_string(line.faces.size()) +
                       " faces");
  }
  for (std::size_t i = 0; i < count; ++i) {
    if (!line.points[i].allFinite()) throw InvalidInput("line: point " + std::to_string(i) + " is not finite");
    check_index(line.faces[i], surface.face_count(), "line: point " + std::to_string(i) + ": face", "faces");
  }
  for (const auto& v : {begin, end}) {
    if (v) check_index(*v, surface.vertex_count(), "line: vertex");
  }
  if (count < 2) return {};
  const double h = median_edge(surface, adjacency, line);
  const std::int32_t from =
      begin ? *begin : nearest_vertex(surface, adjacency, line.points.front(), line.faces.front());
  const std::int32_t to = end ? *end : nearest_vertex(surface, adjacency, line.points.back(), line.faces.back());
  if (!(h > 0.0) || from < 0 || to < 0) return {};
  const auto gap = [&](std::int32_t v, const Vector& p) { return (surface.points()[v] - p).norm(); };
  return ChainFit(surface, adjacency, line, h)
      .find(from, to, gap(from, line.points.front()), gap(to, line.points.back()), task);
}

}  // namespace seamwire
