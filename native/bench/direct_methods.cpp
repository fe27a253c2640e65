// SPDX-License-Identifier: GPL-3.0-or-later
#include "direct_methods.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <numbers>
#include <queue>

#include "seamwire/errors.hpp"

namespace seamwire::bench {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// Each vertex is visited once, in the order of distances; a visit lowers those of others.
class Front {
 public:
  Front(std::size_t count, std::int32_t seed) : distances(count, kInfinity), accepted(count, 0) { lower(seed, 0.0); }

  bool lower(std::int32_t v, double distance) {
    if (accepted[v] || distance >= distances[v]) return false;
    queue_.emplace(distances[v] = distance, v);
    return true;
  }
  void run(const std::function<void(std::int32_t)>& visit) {
    while (!queue_.empty()) {
      const std::int32_t v = queue_.top().second;
      queue_.pop();
      if (accepted[v]) continue;
      accepted[v] = 1;
      visit(v);
    }
  }

  std::vector<double> distances;
  std::vector<char> accepted;

 private:
  using Entry = std::pair<double, std::int32_t>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue_;
};

double norm(const Eigen::Matrix3d& form, const Vector& v) { return std::sqrt(v.dot(form * v)); }

// The distance at p from a segment q with linear distances on it: the least of da + z (db - da) + |p - z q| over z in
// [0, 1]. qq, pq and pp are the products of p and q.
double from_segment(double da, double db, double qq, double pq, double pp) {
  const double slope = db - da;
  double z = slope > 0 ? 0.0 : 1.0;
  if (qq > slope * slope) {
    const double t = -slope * std::sqrt(std::max(0.0, qq * pp - pq * pq) / (qq - slope * slope));
    z = std::clamp((t + pq) / qq, 0.0, 1.0);
  }
  return da + z * slope + std::sqrt(std::max(0.0, pp - 2 * z * pq + z * z * qq));
}

// The least rotation that takes a unit normal to another one.
Eigen::Matrix3d rotation(const Vector& from, const Vector& to) {
  return Eigen::Quaterniond::FromTwoVectors(from, to).toRotationMatrix();
}

// Twins of half-edges by the vertices of their edges.
std::vector<std::int32_t> twins_of(const std::vector<Triangle>& triangles) {
  std::map<Edge, std::int32_t> half_edges;
  for (std::int32_t h = 0; h < static_cast<std::int32_t>(3 * triangles.size()); ++h) {
    half_edges[{triangles[h / 3][h % 3], triangles[h / 3][(h % 3 + 1) % 3]}] = h;
  }
  std::vector<std::int32_t> twins(3 * triangles.size(), -1);
  for (const auto& [edge, h] : half_edges) {
    const auto twin = half_edges.find({edge[1], edge[0]});
    if (twin != half_edges.end()) twins[h] = twin->second;
  }
  return twins;
}

}  // namespace

MetricSurface metric_surface(const Surface& surface, const Metric& metric) {
  const SurfaceReport& report = surface.report();
  if (!report.nonmanifold_edges.empty() || !report.unorientable_edges.empty() || !report.flipped_faces.empty() ||
      !report.degenerate_faces.empty() || !report.duplicate_faces.empty() || !surface.loose_edges().empty()) {
    throw InvalidInput("the direct methods want a manifold, oriented surface without loose edges");
  }
  MetricSurface result{surface.points(), surface.triangles(), twins_of(surface.triangles()), metric, {}, {}, {}};
  for (std::size_t v = 0; v < metric.size(); ++v) {
    const Vector& n = metric.normals[v];
    result.forms.push_back(metric.tensors[v] + normal_weight(metric.tensors[v]) * n * n.transpose());
  }
  result.neighbors.resize(metric.size());
  for (const Triangle& t : result.triangles) {
    result.face_forms.push_back((result.forms[t[0]] + result.forms[t[1]] + result.forms[t[2]]) / 3);
    for (std::size_t i = 0; i < 3; ++i) {
      result.neighbors[t[i]].insert(result.neighbors[t[i]].end(), {t[(i + 1) % 3], t[(i + 2) % 3]});
    }
  }
  for (auto& around : result.neighbors) {
    std::sort(around.begin(), around.end());
    around.erase(std::unique(around.begin(), around.end()), around.end());
  }
  return result;
}

std::pair<Surface, Metric> refined(const Surface& surface, const Metric& metric, int levels) {
  std::vector<Vector> points = surface.points();
  std::vector<Triangle> triangles = surface.triangles();
  Metric fine = metric;
  for (int level = 0; level < levels; ++level) {
    std::map<Edge, std::int32_t> middles;
    const auto middle = [&](std::int32_t a, std::int32_t b) {
      if (a > b) std::swap(a, b);
      const auto [it, is_new] = middles.try_emplace({a, b}, static_cast<std::int32_t>(points.size()));
      if (is_new) {
        points.push_back((points[a] + points[b]) / 2);
        TensorAt at = midpoint_tensor({fine.normals[a], fine.tensors[a]}, {fine.normals[b], fine.tensors[b]});
        fine.normals.push_back(at.normal);
        fine.tensors.push_back(at.tensor);
      }
      return it->second;
    };
    std::vector<Triangle> finer;
    for (const auto& [a, b, c] : triangles) {
      const std::int32_t ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
      finer.insert(finer.end(), {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}});
    }
    triangles = std::move(finer);
  }
  return {Surface(std::move(points), std::move(triangles)), std::move(fine)};
}

std::vector<double> edge_dijkstra(const MetricSurface& s, std::int32_t seed) {
  Front front(s.points.size(), seed);
  front.run([&](std::int32_t a) {
    for (const std::int32_t b : s.neighbors[a]) {
      const Vector e = s.points[b] - s.points[a];
      front.lower(b, front.distances[a] + integrated_length(norm(s.forms[a], e), norm(s.forms[b], e)));
    }
  });
  return front.distances;
}

std::vector<double> steiner_dijkstra(const MetricSurface& s, std::int32_t seed, int per_edge) {
  std::vector<Vector> points = s.points;
  std::vector<Eigen::Matrix3d> forms = s.forms;
  // The points of each half-edge, from its tail to its tip, both among them; those of a face's three in its rows.
  std::vector<std::vector<std::int32_t>> on(3 * s.triangles.size());
  std::vector<std::vector<std::int32_t>> faces(points.size());
  for (std::int32_t h = 0; h < static_cast<std::int32_t>(on.size()); ++h) {
    if (s.twins[h] >= 0 && s.twins[h] < h) {
      on[h].assign(on[s.twins[h]].rbegin(), on[s.twins[h]].rend());
      for (int i = 1; i <= per_edge; ++i) faces[on[h][i]].push_back(h / 3);
    } else {
      const std::int32_t a = s.triangles[h / 3][h % 3], b = s.triangles[h / 3][(h % 3 + 1) % 3];
      on[h].push_back(a);
      for (int i = 1; i <= per_edge; ++i) {
        const double t = static_cast<double>(i) / (per_edge + 1);
        on[h].push_back(static_cast<std::int32_t>(points.size()));
        points.push_back((1 - t) * s.points[a] + t * s.points[b]);
        forms.push_back((1 - t) * s.forms[a] + t * s.forms[b]);
        faces.push_back({h / 3});
      }
      on[h].push_back(b);
    }
    faces[on[h].front()].push_back(h / 3);
  }
  Front front(points.size(), seed);
  front.run([&](std::int32_t a) {
    for (const std::int32_t f : faces[a]) {
      for (std::int32_t h = 3 * f; h < 3 * f + 3; ++h) {
        for (const std::int32_t b : on[h]) {
          if (front.accepted[b]) continue;
          const Vector e = points[b] - points[a];
          front.lower(b, front.distances[a] + integrated_length(norm(forms[a], e), norm(forms[b], e)));
        }
      }
    }
  });
  front.distances.resize(s.points.size());
  return front.distances;
}

std::vector<double> short_term_vector_dijkstra(const MetricSurface& s, std::int32_t seed, int memory) {
  std::vector<std::int32_t> before(s.points.size(), -1);
  Front front(s.points.size(), seed);
  front.run([&](std::int32_t from) {
    for (const std::int32_t to : s.neighbors[from]) {
      if (front.accepted[to]) continue;
      // All turned to `to`, edge by edge: the sum of the edges, and the mean form along them by their lengths.
      Vector sum = Vector::Zero();
      Eigen::Matrix3d forms = Eigen::Matrix3d::Zero(), last = s.forms[to], turn = Eigen::Matrix3d::Identity();
      double lengths = 0.0, best = kInfinity;
      std::int32_t b = to;
      for (std::int32_t a = from, i = 0; a >= 0 && i < memory; b = a, a = before[a], ++i) {
        turn *= rotation(s.metric.normals[a], s.metric.normals[b]);
        const Vector e = turn * (s.points[b] - s.points[a]);
        const Eigen::Matrix3d form = turn * s.forms[a] * turn.transpose();
        sum += e;
        forms += e.norm() / 2 * (form + last);
        lengths += e.norm();
        last = form;
        best = std::min(best, front.distances[a] + norm(forms / lengths, sum));
      }
      if (front.lower(to, best)) before[to] = from;
    }
  });
  return front.distances;
}

std::vector<double> ordered_upwind(const MetricSurface& s, std::int32_t seed) {
  const std::size_t count = s.points.size();
  // Of a vertex that has a distance: those within reach, by number, and the vectors from it to them.
  using Stencil = std::vector<std::pair<std::int32_t, Vector>>;
  std::vector<Stencil> stencils(count);
  std::vector<std::vector<std::int32_t>> watchers(count);  // whose stencils a vertex is in
  std::vector<std::int32_t> seen(count, -1);
  const auto search = [&](std::int32_t center) {
    double longest = 0.0;
    for (const std::int32_t b : s.neighbors[center]) {
      longest = std::max(longest, (s.points[b] - s.points[center]).norm());
    }
    const double reach = longest * anisotropy({s.metric.normals[center], s.metric.tensors[center]});
    Stencil stencil = {{center, Vector::Zero()}};
    seen[center] = center;
    for (std::size_t i = 0; i < stencil.size(); ++i) {
      const auto [a, to_a] = stencil[i];
      if (to_a.norm() > reach) continue;
      const Eigen::Matrix3d turn = rotation(s.metric.normals[a], s.metric.normals[center]);
      for (const std::int32_t b : s.neighbors[a]) {
        if (std::exchange(seen[b], center) == center) continue;
        stencil.emplace_back(b, to_a + turn * (s.points[b] - s.points[a]));
      }
    }
    std::sort(stencil.begin(), stencil.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
    for (const auto& [a, to_a] : stencil) watchers[a].push_back(center);
    stencils[center] = std::move(stencil);
  };
  const auto place = [&](std::int32_t center, std::int32_t v) -> const Vector* {
    const Stencil& stencil = stencils[center];
    const auto it = std::lower_bound(stencil.begin(), stencil.end(), v,
                                     [](const auto& entry, std::int32_t number) { return entry.first < number; });
    return it != stencil.end() && it->first == v ? &it->second : nullptr;
  };
  Front front(count, seed);
  const std::vector<double>& distances = front.distances;
  std::vector<std::size_t> open(count);  // neighbors that are not accepted: none behind the front
  for (std::size_t v = 0; v < count; ++v) open[v] = s.neighbors[v].size();
  // Whether the edge from an accepted vertex is of the front: the other end is accepted too, a third corner beside them
  // is not.
  const auto is_front = [&](std::int32_t a, std::int32_t b) {
    if (!front.accepted[b] || open[b] == 0) return false;
    for (const std::int32_t c : s.neighbors[a]) {
      if (!front.accepted[c] && std::binary_search(s.neighbors[b].begin(), s.neighbors[b].end(), c)) return true;
    }
    return false;
  };
  // From the segments of the front at `a`.
  const auto update = [&](std::int32_t to, std::int32_t a) {
    if (!front.accepted[a] || open[a] == 0 || front.accepted[to]) return;
    const Vector p = -*place(to, a), transformed = s.forms[to] * p;
    const double pp = p.dot(transformed);
    double best = kInfinity;
    bool is_alone = true;  // the seed, at first
    for (const std::int32_t b : s.neighbors[a]) {
      if (!is_front(a, b)) continue;
      is_alone = false;
      const Vector* at_b = place(to, b);
      if (at_b == nullptr) continue;
      const Vector q = p + *at_b;
      best = std::min(best, from_segment(distances[a], distances[b], q.dot(s.forms[to] * q), q.dot(transformed), pp));
    }
    if (is_alone) best = distances[a] + std::sqrt(pp);
    front.lower(to, best);
  };
  front.run([&](std::int32_t accepted) {
    for (const std::int32_t v : s.neighbors[accepted]) --open[v];
    for (const std::int32_t v : watchers[accepted]) update(v, accepted);
    for (const std::int32_t v : s.neighbors[accepted]) {
      if (front.accepted[v] || !stencils[v].empty()) continue;
      search(v);
      for (const auto& [a, to_a] : stencils[v]) update(v, a);
    }
    watchers[accepted] = {};
    stencils[accepted] = {};
  });
  return front.distances;
}

HeatMethod::HeatMethod(const MetricSurface& s, double steps) : triangles_(s.triangles) {
  std::vector<Eigen::Triplet<double>> laplacian, mass;
  double edges = 0.0;
  for (std::size_t f = 0; f < triangles_.size(); ++f) {
    const Triangle& t = triangles_[f];
    // The face in its form, laid out in the plane.
    const Vector e1 = s.points[t[1]] - s.points[t[0]], e2 = s.points[t[2]] - s.points[t[0]];
    const double a = norm(s.face_forms[f], e1), along = e1.dot(s.face_forms[f] * e2) / a;
    const double height = std::sqrt(std::max(1e-300, e2.dot(s.face_forms[f] * e2) - along * along));
    Eigen::Matrix<double, 2, 3> corners;
    corners << 0.0, a, along, 0.0, 0.0, height;
    const double area = a * height / 2;
    Eigen::Matrix<double, 2, 3> gradient;
    for (int i = 0; i < 3; ++i) {
      const Eigen::Vector2d e = corners.col((i + 2) % 3) - corners.col((i + 1) % 3);
      gradient.col(i) = Eigen::Vector2d(-e.y(), e.x()) / (2 * area);
      edges += e.norm() / (3 * static_cast<double>(triangles_.size()));
      mass.emplace_back(t[static_cast<std::size_t>(i)], t[static_cast<std::size_t>(i)], area / 3);
    }
    const Eigen::Matrix3d stiffness = area * gradient.transpose() * gradient;
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < 3; ++j) {
        laplacian.emplace_back(t[static_cast<std::size_t>(i)], t[static_cast<std::size_t>(j)], stiffness(i, j));
      }
    }
    gradients_.push_back(gradient);
    areas_.push_back(area);
  }
  const auto n = static_cast<Eigen::Index>(s.points.size());
  Eigen::SparseMatrix<double> l(n, n), m(n, n);
  l.setFromTriplets(laplacian.begin(), laplacian.end());
  m.setFromTriplets(mass.begin(), mass.end());
  heat_.compute(m + steps * edges * edges * l);
  // Constants have no gradient: a little mass makes the matrix definite, and is nothing beside the distances.
  poisson_.compute(l + 1e-8 * m);
  if (heat_.info() != Eigen::Success || poisson_.info() != Eigen::Success) {
    throw InvalidInput("the heat method's matrices cannot be factored");
  }
}

std::vector<double> HeatMethod::solve(std::int32_t seed) const {
  const Eigen::Index n = heat_.rows();
  const Eigen::VectorXd heat = heat_.solve(Eigen::VectorXd::Unit(n, seed));
  Eigen::VectorXd divergence = Eigen::VectorXd::Zero(n);
  for (std::size_t f = 0; f < triangles_.size(); ++f) {
    const Triangle& t = triangles_[f];
    const Eigen::Vector2d away = -(gradients_[f] * Eigen::Vector3d(heat[t[0]], heat[t[1]], heat[t[2]])).normalized();
    const Eigen::Vector3d part = areas_[f] * gradients_[f].transpose() * away;
    for (std::size_t i = 0; i < 3; ++i) divergence[t[i]] += part[static_cast<Eigen::Index>(i)];
  }
  Eigen::VectorXd distances = poisson_.solve(divergence);
  distances.array() -= distances[seed];
  return {distances.begin(), distances.end()};
}

FastMarching::FastMarching(const IntrinsicMesh& mesh) : updates_(static_cast<std::size_t>(mesh.vertex_count)) {
  // Where the third corner of a triangle over a segment lies, to its left, by the lengths from both ends.
  const auto left_of = [](const Eigen::Vector2d& a, const Eigen::Vector2d& b, double from_a, double from_b) {
    const Eigen::Vector2d e = (b - a).normalized();
    const double length = (b - a).norm(), x = (length * length + from_a * from_a - from_b * from_b) / (2 * length);
    const double y = std::sqrt(std::max(0.0, from_a * from_a - x * x));
    return Eigen::Vector2d(a + x * e + y * Eigen::Vector2d(-e.y(), e.x()));
  };
  const auto next = [](std::int32_t h) { return h - h % 3 + (h % 3 + 1) % 3; };
  constexpr int kMostUnfolded = 100;
  for (std::int32_t h = 0; h < static_cast<std::int32_t>(mesh.twins.size()); ++h) {
    // `to` at the origin, opposite to the half-edge h from a to b.
    const std::int32_t to = mesh.apex(h);
    const double to_b = mesh.lengths[next(h)], to_a = mesh.lengths[next(next(h))];
    Eigen::Vector2d a(to_a, 0.0), b = left_of({0.0, 0.0}, a, to_b, mesh.lengths[h]);
    const Eigen::Vector2d first = a, last = b;
    std::int32_t across = h;
    if (first.dot(last) >= 0) {
      add(to, mesh.tail(h), mesh.tip(h), a, b);
      continue;
    }
    // Obtuse: unfolds over the side that the section of both acute angles meets, until a vertex lies in it.
    bool is_split = false;
    for (int i = 0; i < kMostUnfolded && mesh.twins[across] >= 0; ++i) {
      const std::int32_t twin = mesh.twins[across];  // from the right end to the left one
      const Eigen::Vector2d apex = left_of(b, a, mesh.lengths[next(next(twin))], mesh.lengths[next(twin)]);
      const std::int32_t vertex = mesh.apex(twin);
      if (apex.dot(first) >= 0 && apex.dot(last) >= 0) {
        add(to, mesh.tail(h), vertex, first, apex);
        add(to, vertex, mesh.tip(h), apex, last);
        is_split = true;
        break;
      }
      // The apex is too far to the side of the end it is at an obtuse angle from the other one.
      if (apex.dot(first) < 0) {
        b = apex;
        across = next(twin);  // from the left end to the apex
      } else {
        a = apex;
        across = next(next(twin));
      }
    }
    if (!is_split) add(to, mesh.tail(h), mesh.tip(h), first, last);
  }
  for (const LooseEdge& edge : mesh.loose_edges) {
    for (const auto& [from, to] : {std::pair(edge.a, edge.b), std::pair(edge.b, edge.a)}) {
      updates_[from].push_back({to, -1, {edge.length, 0.0}, {0.0, 0.0}});
    }
  }
}

void FastMarching::add(std::int32_t to, std::int32_t a, std::int32_t b, const Eigen::Vector2d& at_a,
                       const Eigen::Vector2d& at_b) {
  updates_[a].push_back({to, b, -at_a, at_b - at_a});
  updates_[b].push_back({to, a, -at_b, at_a - at_b});
}

std::vector<double> FastMarching::solve(std::int32_t seed) const {
  Front front(updates_.size(), seed);
  front.run([&](std::int32_t a) {
    for (const Update& u : updates_[a]) {
      double distance = front.distances[a] + u.target.norm();
      if (u.other >= 0 && front.accepted[u.other]) {
        distance = from_segment(front.distances[a], front.distances[u.other], u.segment.squaredNorm(),
                                u.target.dot(u.segment), u.target.squaredNorm());
      }
      front.lower(u.to, distance);
    }
  });
  return front.distances;
}

namespace {

// Finds the direct geodesics of the saddle vertex graph, from one vertex after another. Windows spread from the vertex,
// the nearest first, and are filtered as in Xin and Wang, "Improving Chen and Han's Algorithm on the Discrete Geodesic
// Problem" (2009). The saddle vertices in the disc emit windows too. These show which geodesics are not direct.
class DirectGeodesics {
 public:
  explicit DirectGeodesics(const IntrinsicMesh& mesh)
      : mesh_(mesh),
        leaving_(static_cast<std::size_t>(mesh.vertex_count)),
        is_saddle_(leaving_.size(), 0),
        found_(leaving_.size()),
        nearest_(mesh.twins.size()) {
    // More than 2 pi by less than this is rounding.
    constexpr double kFlatness = 1e-7;
    std::vector<double> angles(leaving_.size(), 0.0);
    for (std::int32_t h = 0; h < static_cast<std::int32_t>(mesh.twins.size()); ++h) {
      const double base = mesh.lengths[h], left = mesh.lengths[previous(h)], right = mesh.lengths[next(h)];
      const double x = (base * base + left * left - right * right) / (2 * base);
      apexes_.emplace_back(x, std::sqrt(std::max(0.0, left * left - x * x)));
      leaving_[mesh.tail(h)].push_back(h);
      angles[mesh.tail(h)] += std::atan2(apexes_.back().y(), x);
      if (mesh.twins[h] < 0) is_saddle_[mesh.tail(h)] = is_saddle_[mesh.tip(h)] = 1;
    }
    for (std::size_t v = 0; v < angles.size(); ++v) {
      if (angles[v] > 2 * std::numbers::pi + kFlatness) is_saddle_[v] = 1;
    }
  }

  // Calls visit(to, length) for each vertex with a direct geodesic among the `disc` vertices nearest to `seed`.
  template <class Visit>
  void run(std::int32_t seed, int disc, const Visit& visit) {
    for (const std::int32_t v : touched_) found_[v] = {};
    for (const std::int32_t h : split_) nearest_[h] = {};
    touched_.clear();
    split_.clear();
    events_ = {};
    relax(seed, 0.0, false);
    for (int passed = -1; passed < disc && !events_.empty();) {
      const Event event = events_.top();
      events_.pop();
      if (event.vertex < 0) {
        cross(event.window);
        continue;
      }
      Found& found = found_[event.vertex];
      if (std::exchange(found.is_passed, true)) continue;
      ++passed;
      if (found.is_direct) visit(event.vertex, found.distance);
      if (event.vertex == seed || is_saddle_[event.vertex]) emit(event.vertex, event.vertex == seed);
    }
  }

 private:
  // A part of an edge that the source sees in a straight line over unfolded triangles. The half-edge runs from the
  // origin along the x-axis. Lines enter its triangle, which is above. The source is below.
  struct Window {
    std::int32_t half_edge = -1;
    bool is_direct = false;  // the source is the seed
    double begin = 0.0, end = 0.0;
    Eigen::Vector2d source = Eigen::Vector2d::Zero();
    double offset = 0.0;  // the distance of the source
  };
  struct Event {
    double distance;
    std::int32_t vertex;  // -1: the window
    Window window;
    bool operator>(const Event& other) const { return distance > other.distance; }
  };
  struct Found {
    double distance = kInfinity;
    bool is_direct = false, is_passed = false;
  };
  // The shortest line over a half-edge to its apex, and where it crosses the half-edge.
  struct Nearest {
    double distance = kInfinity, at = 0.0;
  };
  // A path that is shorter by less than this part is the same one, up to rounding.
  static constexpr double kTie = 1 - 1e-12;
  // A line may miss the end of a window by this part of the edge, because of rounding.
  static constexpr double kMiss = 1e-10;

  static std::int32_t next(std::int32_t h) { return h - h % 3 + (h + 1) % 3; }
  static std::int32_t previous(std::int32_t h) { return next(next(h)); }
  static double cross_product(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
    return a.x() * b.y() - a.y() * b.x();
  }

  void relax(std::int32_t v, double distance, bool is_direct) {
    Found& found = found_[v];
    if (found.is_passed || distance >= found.distance) return;
    if (found.distance == kInfinity) touched_.push_back(v);
    found.distance = distance;
    found.is_direct = is_direct;
    events_.push({distance, v, {}});
  }

  void emit(std::int32_t v, bool is_seed) {
    const double offset = found_[v].distance;
    for (const std::int32_t h : leaving_[v]) {
      const std::int32_t opposite = next(h);
      relax(mesh_.tip(h), offset + mesh_.lengths[h], is_seed);
      relax(mesh_.apex(h), offset + mesh_.lengths[previous(h)], is_seed);
      const double length = mesh_.lengths[opposite];
      const Eigen::Vector2d& apex = apexes_[opposite];
      push({mesh_.twins[opposite], is_seed, 0.0, length, {length - apex.x(), -apex.y()}, offset});
    }
  }

  // Adds a window, unless paths over an end of its edge are shorter.
  void push(const Window& window) {
    const auto& [h, is_direct, begin, end, source, offset] = window;
    if (h < 0 || !(begin < end) || !(source.y() < 0)) return;
    const auto to = [&, &from = source, &before = offset](double x) {
      return before + std::hypot(from.x() - x, from.y());
    };
    if (found_[mesh_.tail(h)].distance + end < to(end) * kTie) return;
    if (found_[mesh_.tip(h)].distance + mesh_.lengths[h] - begin < to(begin) * kTie) return;
    events_.push({to(std::clamp(source.x(), begin, end)), -1, window});
  }

  // The window sees the apex, and parts of both sides.
  void cross(const Window& window) {
    const auto& [h, is_direct, begin, end, source, offset] = window;
    const double base = mesh_.lengths[h], left = mesh_.lengths[previous(h)], right = mesh_.lengths[next(h)];
    const Eigen::Vector2d& apex = apexes_[h];
    const Eigen::Vector2d tip(base, 0.0);
    if (!(apex.y() > 0)) return;
    // Where the line to the apex meets the base. Lines on its left go to the left side.
    const double middle = cross_product(source, apex) / (apex.y() - source.y());
    bool sees_left = begin < middle, sees_right = middle < end;
    if (begin - kMiss * base <= middle && middle <= end + kMiss * base) {
      const double distance = offset + (apex - source).norm();
      relax(mesh_.apex(h), distance, is_direct);
      // One angle, one split (Chen and Han, 1990): lines that cross a shorter line to the apex are not shortest paths.
      Nearest& nearest = nearest_[h];
      if (nearest.distance < distance * kTie) {
        sees_left = sees_left && nearest.at >= middle;
        sees_right = sees_right && nearest.at <= middle;
      } else if (distance < nearest.distance) {
        if (nearest.distance == kInfinity) split_.push_back(h);
        nearest = {distance, middle};
      }
    }
    // How far along a side, from 0 at the base to 1 at the apex, a line from `from` over x on the base meets it. The
    // side begins at the origin.
    const auto along = [](double x, const Eigen::Vector2d& from, const Eigen::Vector2d& to) {
      return std::clamp(x * from.y() / ((x - from.x()) * to.y() + from.y() * to.x()), 0.0, 1.0);
    };
    // Whether paths over the vertex opposite to a side are shorter, at the end of the window that is next to the base.
    const auto is_longer = [&, &from = source, &before = offset](std::int32_t v, const Eigen::Vector2d& corner,
                                                                 const Eigen::Vector2d& at) {
      return found_[v].distance + (at - corner).norm() < (before + (at - from).norm()) * kTie;
    };
    if (sees_left) {
      const double first = along(begin, source, apex), last = middle < end ? 1.0 : along(end, source, apex);
      const Eigen::Vector2d u = apex / left;
      if (!is_longer(mesh_.tip(h), tip, first * apex)) {
        push({mesh_.twins[previous(h)],
              is_direct,
              first * left,
              last * left,
              {source.dot(u), cross_product(u, source)},
              offset});
      }
    }
    if (sees_right) {
      // As on the left, in the mirror image.
      const Eigen::Vector2d mirrored_source(base - source.x(), source.y()), mirrored_apex(base - apex.x(), apex.y());
      const double first = along(base - end, mirrored_source, mirrored_apex);
      const double last = begin < middle ? 1.0 : along(base - begin, mirrored_source, mirrored_apex);
      const Eigen::Vector2d u = (tip - apex) / right, from = source - apex;
      if (!is_longer(mesh_.tail(h), {0.0, 0.0}, tip + first * (apex - tip))) {
        push({mesh_.twins[next(h)],
              is_direct,
              (1 - last) * right,
              (1 - first) * right,
              {from.dot(u), cross_product(u, from)},
              offset});
      }
    }
  }

  const IntrinsicMesh& mesh_;
  std::vector<Eigen::Vector2d> apexes_;  // per half-edge, in its frame
  std::vector<std::vector<std::int32_t>> leaving_;
  std::vector<char> is_saddle_;
  std::vector<Found> found_;
  std::vector<Nearest> nearest_;               // per half-edge
  std::vector<std::int32_t> touched_, split_;  // entries of found_ and nearest_ to reset
  std::priority_queue<Event, std::vector<Event>, std::greater<>> events_;
};

}  // namespace

SaddleVertexGraph::SaddleVertexGraph(const IntrinsicMesh& mesh, int disc)
    : arcs_(static_cast<std::size_t>(mesh.vertex_count)) {
  DirectGeodesics geodesics(mesh);
  for (std::int32_t v = 0; v < mesh.vertex_count; ++v) {
    geodesics.run(v, disc, [&](std::int32_t to, double length) {
      arcs_[v].push_back({to, length});
      arcs_[to].push_back({v, length});
    });
  }
  // Some geodesics were found from both ends.
  for (std::vector<Arc>& arcs : arcs_) {
    std::sort(arcs.begin(), arcs.end(),
              [](const Arc& a, const Arc& b) { return std::pair(a.to, a.length) < std::pair(b.to, b.length); });
    const auto is_same = [](const Arc& a, const Arc& b) { return a.to == b.to; };
    arcs.erase(std::unique(arcs.begin(), arcs.end(), is_same), arcs.end());
    arcs.shrink_to_fit();
  }
}

std::vector<double> SaddleVertexGraph::solve(std::int32_t seed) const {
  Front front(arcs_.size(), seed);
  front.run([&](std::int32_t a) {
    for (const auto& [to, length] : arcs_[a]) front.lower(to, front.distances[a] + length);
  });
  return front.distances;
}

}  // namespace seamwire::bench
