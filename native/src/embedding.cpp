// SPDX-License-Identifier: GPL-3.0-or-later
#include "seamwire/embedding.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <numeric>
#include <queue>
#include <string>
#include <utility>
#include <vector>

#include "mending.hpp"

namespace seamwire {
namespace {

using VertexHandle = OpenMesh::VertexHandle;
using HalfedgeHandle = OpenMesh::HalfedgeHandle;
using FaceHandle = OpenMesh::FaceHandle;

// A triangle is valid where its longest edge is shorter than the others together by this fraction: exact geodesics
// unfold it, and the square root in the unfolding leaves half of its digits.
constexpr double kSlack = 1e-10;
// Lengths that differ by less than this fraction are equal, so that rounding, which depends on the scale of the input,
// does not choose which edge to bisect.
constexpr double kEqual = 1e-9;
// The paper's scheme may add this many triangles for each of the surface's, and this many in any case. Where it ends,
// it mostly ends below one for each.
constexpr std::size_t kBudget = 4, kLeastBudget = 20'000;
// And propagation and newest-vertex bisection this many. Nearly all that end at all end far below.
constexpr std::size_t kLaterBudget = 16, kLeastLaterBudget = 200'000;
// Of the room that the triangle inequality leaves for the length of a fitted edge, the part kept free on either side.
constexpr double kRoom = 1.0 / 16;
// A triangle whose shortest edge is shorter than this fraction of its longest one leaves no room in double precision.
constexpr double kNeedle = 1e-8;
// Bisections of an original face, one of a part of a part, until newest-vertex bisection begins.
constexpr std::uint8_t kNewestDepth = 40;
// Bisections of an original face where the rest is left to fitting: few enough that no edge gets too short for that.
constexpr std::uint8_t kShallowDepth = 8;
// Splits between two reports of progress: about a millisecond.
constexpr std::size_t kReportEvery = 1024;

std::size_t index(std::int32_t i) { return static_cast<std::size_t>(i); }

void check_size(const Surface& surface, const Metric& metric) {
  const std::size_t n = surface.vertex_count();
  if (metric.tensors.size() != n || metric.normals.size() != n) {
    throw InvalidInput("metric of " + std::to_string(metric.size()) + " vertices for a surface of " +
                       std::to_string(n));
  }
}

void check_metric(const Surface& surface, const Metric& metric) {
  check_size(surface, metric);
  for (std::size_t v = 0; v < metric.size(); ++v) {
    if (!metric.tensors[v].allFinite() || !metric.normals[v].allFinite()) {
      throw InvalidInput("the metric at vertex " + std::to_string(v) + " is not finite");
    }
  }
}

std::size_t budget(const Surface& surface) { return std::max(kLeastBudget, kBudget * surface.face_count()); }
// Leaves room for fitting below the cap.
std::size_t later_budget(const Surface& surface, std::size_t cap) {
  return std::min(std::max(kLeastLaterBudget, kLaterBudget * surface.face_count()), cap / 4);
}

enum class Scheme {
  kPaper,      ///< an invalid triangle and the neighbour behind its longest edge are bisected, whatever the neighbour
  kPropagate,  ///< the neighbour is first bisected until the common edge is the right one for it too
  kShallow,    ///< the same, but no part deeper than kShallowDepth is bisected for its own sake
  kFitAlone,   ///< nothing is bisected for its own sake before fit()
};

// Where the quadratic form of the ambient norm (metric.hpp) is one matrix: M + sqrt(l1 l2) n n^T.
struct Node {
  Vector point;                // in the caller's coordinates
  std::array<double, 6> form;  // xx, yy, zz, 2 xy, 2 xz, 2 yz

  double norm(const Vector& e) const {
    const double x = e.x(), y = e.y(), z = e.z();
    const double squared =
        form[0] * x * x + form[1] * y * y + form[2] * z * z + form[3] * x * y + form[4] * x * z + form[5] * y * z;
    return std::sqrt(std::max(0.0, squared));
  }
};

Node node_of(const Vector& point, const Vector& n, const Eigen::Matrix3d& m) {
  const double w = normal_weight(m);
  return {point,
          {m(0, 0) + w * n.x() * n.x(), m(1, 1) + w * n.y() * n.y(), m(2, 2) + w * n.z() * n.z(),
           2 * (m(0, 1) + w * n.x() * n.y()), 2 * (m(0, 2) + w * n.x() * n.z()), 2 * (m(1, 2) + w * n.y() * n.z())}};
}

/// Triangles glued along their edges, in flat arrays: half-edge 3 f + i runs from corner i of triangle f to the next.
struct FlatMesh {
  std::vector<Triangle> corners;
  std::vector<std::int32_t> twins;

  std::int32_t tail(std::int32_t h) const { return corners[index(h / 3)][index(h % 3)]; }
  std::int32_t tip(std::int32_t h) const { return corners[index(h / 3)][index((h + 1) % 3)]; }
};

std::int32_t next(std::int32_t h) { return h % 3 == 2 ? h - 2 : h + 1; }

// OpenMesh's faces in their order but for deleted ones, each from its first corner on, as OpenMesh lists them.
FlatMesh flattened(const HalfEdgeMesh& mesh) {
  FlatMesh flat;
  flat.corners.reserve(mesh.n_faces());
  flat.twins.reserve(3 * mesh.n_faces());
  std::vector<std::int32_t> number(mesh.n_halfedges(), -1);
  std::vector<std::int32_t> half_edges;
  half_edges.reserve(3 * mesh.n_faces());
  for (const FaceHandle f : mesh.faces()) {
    const HalfedgeHandle last = mesh.halfedge_handle(f), first = mesh.next_halfedge_handle(last);
    Triangle corners;
    std::size_t i = 0;
    for (const HalfedgeHandle h : {first, mesh.next_halfedge_handle(first), last}) {
      corners[i++] = mesh.from_vertex_handle(h).idx();
      number[index(h.idx())] = static_cast<std::int32_t>(half_edges.size());
      half_edges.push_back(h.idx());
    }
    flat.corners.push_back(corners);
  }
  for (const std::int32_t h : half_edges) flat.twins.push_back(number[index(h ^ 1)]);
  return flat;
}

// Whether all vertices and faces of the half-edge mesh have the caller's numbers.
bool keeps_numbers(const Surface& surface) {
  const auto& vertex_of_fan = surface.vertex_of_fan();
  return vertex_of_fan.size() == surface.vertex_count() && surface.half_edges().n_faces() == surface.face_count() &&
         std::adjacent_find(vertex_of_fan.begin(), vertex_of_fan.end()) == vertex_of_fan.end();
}

/// The surface's triangles, refined in place.
class Refinement {
 public:
  Refinement(const Surface& surface, const Metric& metric, const EmbedOptions& options, Scheme scheme);
  /// Goes on from an embedding of the surface in another metric, which must be `local`.
  Refinement(const Surface& surface, const Metric& metric, const EmbedOptions& options, Embedding&& old);

  /// False where more than `most` triangles would have to be added. Progress goes on from `progress`.
  bool run(const Task& task, std::size_t most, double& progress);
  /// Goes on where run() has returned false.
  bool work_off(const Task& task, std::size_t most, double& progress);
  /// The same for the triangles at vertices where the metric has changed from `former`, and what they lead to.
  bool run_changes(const Metric& former, const Task& task, std::size_t most);
  /// Bisects each triangle that is still invalid once more, with lengths that make its parts valid; false where some
  /// are left, because of the cap or rounding.
  bool fit(const Task& task, double progress);
  /// Whether an invalid part of a face with an area has become so flat that it cannot be bisected on.
  bool has_decayed() const { return has_decayed_; }
  std::size_t faces_added() const { return faces_added_; }
  Embedding result() &&;

 private:
  struct Candidate {
    float perimeter;  // rounded, so that the scale of the input does not choose between equal ones
    std::int32_t face;
    // Of equal ones, the first: in an order that knows the original face and the bisections of it alone, so that what
    // happens elsewhere on the surface does not decide.
    std::uint64_t place;

    friend bool operator<(const Candidate& a, const Candidate& b) {
      return a.perimeter != b.perimeter ? a.perimeter < b.perimeter : a.place > b.place;
    }
  };
  enum class State : std::uint8_t {
    kOriginal,  ///< as it was given
    kRunning,   ///< bisected, or to be looked at, in this run
    kKept,      ///< bisected in the former metric, and to stay so
  };

  void orient_normals(const HalfEdgeMesh& mesh);
  std::int32_t number(std::int32_t v) const {
    if (index(v) < fans_) return vertex_of_fan_[index(v)];
    return static_cast<std::int32_t>(index(v) - fans_ + surface_.vertex_count());
  }
  const Node& node(std::int32_t v) const { return index(v) < fans_ ? nodes_[index(v)] : new_nodes_[index(v) - fans_]; }
  void set_node(std::int32_t fan);
  TensorAt tensor_at(std::int32_t v) const;
  Vector vector(std::int32_t h) const {
    return (node(mesh_.tip(h)).point - node(mesh_.tail(h)).point) * surface_.scale();
  }
  double measure(std::int32_t h) const;
  void measure_all();
  bool is_valid(std::int32_t f) const;
  bool is_flat(std::int32_t f) const;
  double perimeter(std::int32_t f) const;
  std::int32_t longest(std::int32_t f) const;
  void consider(std::int32_t f);
  std::int32_t refinement_edge(std::int32_t f) const;
  void begin_newest_vertex_bisection();
  bool refine(std::int32_t f, std::size_t most);
  void bisect(std::int32_t h);
  std::int32_t fitting_edge(std::int32_t f) const;
  bool is_unfit(std::int32_t f) const;
  bool can_be_fitted(std::int32_t f) const;
  double fitted(std::int32_t h, double half, double next_side, double last_side) const;
  void halve(std::int32_t h, std::int32_t middle);
  void set_length(std::int32_t h, double length);
  std::vector<std::int32_t> changed_faces(const Metric& former) const;
  void reset(const std::vector<std::int32_t>& seeds);
  bool enter(std::int32_t face);
  bool is_given_valid(std::int32_t face, const Metric& metric) const;
  std::vector<std::int32_t> unreachable(const IntrinsicMesh& mesh) const;

  const Surface& surface_;
  const Metric& metric_;
  const EmbedOptions& options_;
  Scheme scheme_;
  const std::vector<std::int32_t>& vertex_of_fan_;
  std::size_t fans_;   // vertices of the surface's half-edge mesh
  std::size_t faces_;  // triangles before the first bisection
  FlatMesh mesh_;
  std::vector<double> lengths_;        // per half-edge
  std::vector<std::int32_t> origins_;  // per triangle: the face of the surface's half-edge mesh that it lies in
  std::vector<std::uint32_t>
      branch_;                       // per triangle: which part of that it is, as the number of a node of a binary tree
  std::vector<std::uint8_t> depth_;  // per triangle: bisections since the original face, up to kNewestDepth
  std::unique_ptr<Node[]> nodes_;    // per fan
  std::vector<Node> new_nodes_;
  std::vector<TensorAt> tensors_;         // of the new vertices
  std::vector<bool> is_turned_;           // per fan: its side is the other one than its vertex's normal's; empty: none
  std::size_t first_newest_ = 0;          // vertices from here on are of newest-vertex bisection; 0: it has not begun
  std::vector<std::int32_t> deferred_;    // invalid triangles left to newest-vertex bisection
  std::vector<std::int32_t> chain_;       // triangles to bisect, the last one first
  std::priority_queue<Candidate> queue_;  // invalid triangles that may be bisected; entries grow stale
  std::vector<LooseEdge> merged_;
  std::vector<State> states_;            // per face of the surface's half-edge mesh, for a run of changes
  std::vector<std::int32_t> conflicts_;  // faces that were kept and should not have been
  std::vector<std::int32_t> running_;    // faces with State::kRunning
  std::vector<Vector> points_;           // in the caller's coordinates, the caller's first
  bool has_mended_ = false, has_decayed_ = false;
  std::vector<bool> is_flat_origin_;  // per face of the surface's half-edge mesh: it has no area; empty: none is
  std::size_t invalid_before_ = 0;
  std::size_t faces_added_ = 0;
  bool hit_cap_ = false;
};

Refinement::Refinement(const Surface& surface, const Metric& metric, const EmbedOptions& options, Scheme scheme)
    : surface_(surface),
      metric_(metric),
      options_(options),
      scheme_(scheme),
      vertex_of_fan_(surface.vertex_of_fan()),
      fans_(vertex_of_fan_.size()),
      points_(surface.points()) {
  const Mending mending(surface, metric);
  has_mended_ = mending.found_any();
  const HalfEdgeMesh& mesh = has_mended_ ? mending.mesh() : surface.half_edges();
  orient_normals(mesh);
  mesh_ = flattened(mesh);
  faces_ = mesh_.corners.size();
  if (has_mended_) {
    origins_ = mending.origins();
    merged_ = mending.merged();
    invalid_before_ = mending.taken_away();
    is_flat_origin_.assign(surface.half_edges().n_faces(), false);
  } else {
    origins_.resize(faces_);
    std::iota(origins_.begin(), origins_.end(), 0);
  }
  branch_.assign(faces_, 1);
  depth_.assign(faces_, 0);
  nodes_ = std::make_unique_for_overwrite<Node[]>(fans_);
  for (std::int32_t fan = 0; index(fan) < fans_; ++fan) set_node(fan);
  if (has_mended_) {
    for (std::int32_t f = 0; index(f) < faces_; ++f) {
      if (is_flat(f)) is_flat_origin_[index(origins_[index(f)])] = true;
    }
  }
  measure_all();
}

// A vertex has one normal, but its fans need not agree on which side of the surface is outside: where a one-sided
// surface is cut they cannot. Normals in the middle of edges are means, so they must be of one side.
void Refinement::orient_normals(const HalfEdgeMesh& mesh) {
  if (std::adjacent_find(vertex_of_fan_.begin(), vertex_of_fan_.end()) == vertex_of_fan_.end()) return;  // ascending
  is_turned_.assign(fans_, false);
  std::vector<Vector> normals(fans_, Vector::Zero());
  for (const FaceHandle f : mesh.faces()) {
    std::array<VertexHandle, 3> v;
    std::size_t i = 0;
    for (const VertexHandle corner : mesh.fv_range(f)) v[i++] = corner;
    const Vector normal = (mesh.point(v[1]) - mesh.point(v[0])).cross(mesh.point(v[2]) - mesh.point(v[0]));
    for (const VertexHandle corner : v) normals[index(corner.idx())] += normal;
  }
  for (std::size_t fan = 0; fan < fans_; ++fan) {
    const std::int32_t v = vertex_of_fan_[fan];
    const bool is_shared =
        (fan > 0 && vertex_of_fan_[fan - 1] == v) || (fan + 1 < fans_ && vertex_of_fan_[fan + 1] == v);
    is_turned_[fan] = is_shared && normals[fan].dot(metric_.normals[index(v)]) < 0;
  }
}

void Refinement::set_node(std::int32_t fan) {
  const std::size_t v = index(vertex_of_fan_[index(fan)]);
  nodes_[index(fan)] = node_of(surface_.points()[v], metric_.normals[v], metric_.tensors[v]);
}

TensorAt Refinement::tensor_at(std::int32_t v) const {
  if (index(v) >= fans_) return tensors_[index(v) - fans_];
  const std::size_t i = index(vertex_of_fan_[index(v)]);
  const bool is_turned = !is_turned_.empty() && is_turned_[index(v)];
  return {is_turned ? Vector(-metric_.normals[i]) : metric_.normals[i], metric_.tensors[i]};
}

// Length of an edge in the metric, from both of its ends.
double Refinement::measure(std::int32_t h) const {
  const Node &a = node(mesh_.tail(h)), &b = node(mesh_.tip(h));
  const Vector e = (b.point - a.point) * surface_.scale();
  return integrated_length(a.norm(e), b.norm(e));
}

void Refinement::measure_all() {
  const auto count = static_cast<std::int32_t>(mesh_.twins.size());
  lengths_.resize(mesh_.twins.size());
  for (std::int32_t h = 0; h < count; ++h) {
    const std::int32_t twin = mesh_.twins[index(h)];
    lengths_[index(h)] = twin >= 0 && twin < h ? lengths_[index(twin)] : measure(h);
  }
}

void Refinement::set_length(std::int32_t h, double length) {
  lengths_[index(h)] = length;
  if (const std::int32_t twin = mesh_.twins[index(h)]; twin >= 0) lengths_[index(twin)] = length;
}

bool Refinement::is_valid(std::int32_t f) const {
  const double *l = &lengths_[3 * index(f)], most = std::max({l[0], l[1], l[2]});
  return most < (l[0] + l[1] + l[2] - most) * (1 - kSlack);
}

bool Refinement::is_flat(std::int32_t f) const {
  return lacks_area(vector(3 * f), vector(3 * f + 1), vector(3 * f + 2));
}

double Refinement::perimeter(std::int32_t f) const {
  const double* l = &lengths_[3 * index(f)];
  if (options_.perimeter == Perimeter::kMetric) return l[0] + l[1] + l[2];
  return vector(3 * f).norm() + vector(3 * f + 1).norm() + vector(3 * f + 2).norm();
}

std::int32_t Refinement::longest(std::int32_t f) const {
  std::int32_t best = 3 * f;
  for (const std::int32_t h : {3 * f + 1, 3 * f + 2}) {
    if (lengths_[index(h)] > lengths_[index(best)] * (1 + kEqual)) best = h;
  }
  return best;
}

void Refinement::consider(std::int32_t f) {
  if (is_valid(f)) return;
  if (is_flat(f)) {
    has_decayed_ = has_decayed_ || is_flat_origin_.empty() || !is_flat_origin_[index(origins_[index(f)])];
    return;
  }
  const double p = perimeter(f);
  if (p < options_.sigma) return;
  if (scheme_ == Scheme::kFitAlone || (scheme_ == Scheme::kShallow && depth_[index(f)] >= kShallowDepth)) return;
  if (scheme_ == Scheme::kPropagate && first_newest_ == 0 && depth_[index(f)] >= kNewestDepth) {
    deferred_.push_back(f);
  } else {
    const std::uint64_t place = std::uint64_t(origins_[index(f)]) << 32 | branch_[index(f)];
    queue_.push({static_cast<float>(p), f, place});
  }
}

// The mesh as it stands becomes the starting triangulation.
void Refinement::begin_newest_vertex_bisection() {
  first_newest_ = fans_ + new_nodes_.size();
  std::vector<std::int32_t> deferred;
  deferred.swap(deferred_);
  std::sort(deferred.begin(), deferred.end());
  deferred.erase(std::unique(deferred.begin(), deferred.end()), deferred.end());
  for (const std::int32_t f : deferred) consider(f);
}

// Where a triangle is to be bisected. Once newest-vertex bisection has begun: opposite its newest vertex; else, and for
// triangles of the starting triangulation, at its longest edge. Edges are in one strict order, that of their rounded
// lengths and then of their numbers, so a chain of neighbours with ever longer edges ends.
std::int32_t Refinement::refinement_edge(std::int32_t f) const {
  if (scheme_ == Scheme::kPaper) return longest(f);
  if (first_newest_ > 0) {
    const Triangle& corners = mesh_.corners[index(f)];
    const auto newest = static_cast<std::int32_t>(std::ranges::max_element(corners) - corners.begin());
    if (index(corners[index(newest)]) >= first_newest_) return next(3 * f + newest);
  }
  const auto key = [&](std::int32_t h) {
    const std::int32_t twin = mesh_.twins[index(h)];
    return std::pair(static_cast<float>(lengths_[index(h)]), twin < 0 ? h : std::min(h, twin));
  };
  std::int32_t best = 3 * f;
  for (const std::int32_t h : {3 * f + 1, 3 * f + 2}) {
    if (key(h) > key(best)) best = h;
  }
  return best;
}

// Bisects a face, and before it those that the scheme wants bisected first; false where that takes too many triangles.
bool Refinement::refine(std::int32_t f, std::size_t most) {
  chain_.assign(1, f);
  while (!chain_.empty()) {
    const std::int32_t h = refinement_edge(chain_.back()), beyond = mesh_.twins[index(h)];
    if (scheme_ != Scheme::kPaper && beyond >= 0 && refinement_edge(beyond / 3) != beyond) {
      chain_.push_back(beyond / 3);
      continue;
    }
    if (faces_added_ + (beyond < 0 ? 1 : 2) > most) return false;
    if (states_.empty() || beyond < 0 || enter(origins_[index(beyond / 3)])) {
      bisect(h);
    } else {
      conflicts_.insert(conflicts_.end(), {origins_[index(beyond / 3)], origins_[index(h / 3)]});
    }
    chain_.pop_back();
  }
  return true;
}

// The triangle of a half-edge from a to b keeps its half at a; that at b becomes a new triangle, whose first half-edge
// runs from the middle to b.
void Refinement::halve(std::int32_t h, std::int32_t middle) {
  const std::int32_t f = h / 3, h1 = next(h);
  const auto g = static_cast<std::int32_t>(mesh_.corners.size());
  const std::int32_t b = mesh_.tip(h), c = mesh_.tip(h1), outer = mesh_.twins[index(h1)];
  mesh_.corners[index(f)][index(h1 % 3)] = middle;
  mesh_.corners.push_back({middle, b, c});
  mesh_.twins.insert(mesh_.twins.end(), {-1, outer, h1});
  mesh_.twins[index(h1)] = 3 * g + 2;
  if (outer >= 0) mesh_.twins[index(outer)] = 3 * g + 1;
  lengths_.insert(lengths_.end(), {0.0, lengths_[index(h1)], 0.0});
  origins_.push_back(origins_[index(f)]);
  if (depth_[index(f)] < kNewestDepth) ++depth_[index(f)];
  depth_.push_back(depth_[index(f)]);
  // Nodes deeper than 31 have no number left in 32 bits: they are mixed, and seldom equal.
  const std::uint32_t branch = branch_[index(f)];
  const std::uint32_t first = branch < 0x8000'0000U ? 2 * branch : branch * 0x9E37'79B1U | 0x8000'0000U;
  branch_[index(f)] = first;
  branch_.push_back(first ^ 1U);
  ++faces_added_;
}

void Refinement::bisect(std::int32_t h) {
  const std::int32_t a = mesh_.tail(h), b = mesh_.tip(h), o = mesh_.twins[index(h)];
  const auto middle = static_cast<std::int32_t>(fans_ + new_nodes_.size());
  tensors_.push_back(midpoint_tensor(tensor_at(a), tensor_at(b)));
  points_.emplace_back((node(a).point + node(b).point) / 2);
  new_nodes_.push_back(node_of(points_.back(), tensors_.back().normal, tensors_.back().tensor));
  const auto count = static_cast<std::int32_t>(mesh_.corners.size());
  halve(h, middle);
  if (o >= 0) {
    halve(o, middle);
    mesh_.twins[index(h)] = 3 * (count + 1);
    mesh_.twins[index(3 * (count + 1))] = h;
    mesh_.twins[index(o)] = 3 * count;
    mesh_.twins[index(3 * count)] = o;
  }
  // Edges around the middle: the halves of the old one, and one on each side.
  for (const std::int32_t e : {h, 3 * count, 3 * count + 2}) set_length(e, measure(e));
  if (o >= 0) set_length(3 * (count + 1) + 2, measure(3 * (count + 1) + 2));
  consider(h / 3);
  consider(count);
  if (o >= 0) {
    consider(o / 3);
    consider(count + 1);
  }
}

bool Refinement::run(const Task& task, std::size_t most, double& progress) {
  for (std::int32_t f = 0; index(f) < faces_; ++f) {
    if (is_valid(f)) continue;
    ++invalid_before_;
    consider(f);
  }
  task.check(progress);
  return work_off(task, most, progress);
}

bool Refinement::work_off(const Task& task, std::size_t most, double& progress) {
  for (std::size_t steps = 0;;) {
    if (queue_.empty()) {
      if (deferred_.empty()) return true;
      begin_newest_vertex_bisection();
      continue;
    }
    const Candidate next = queue_.top();
    queue_.pop();
    // A face changes when a neighbour is bisected, and is queued again if it is still invalid.
    if (static_cast<float>(perimeter(next.face)) != next.perimeter || is_valid(next.face)) continue;
    if (!refine(next.face, most)) {
      queue_.push(next);
      hit_cap_ = most == options_.max_faces_added;
      return false;
    }
    if (++steps % kReportEvery == 0) {
      // How many are still to come is not known; each queued triangle needs one at least.
      const auto done = static_cast<double>(steps);
      progress = std::max(progress, done / (done + static_cast<double>(queue_.size())));
      task.check(progress);
    }
  }
}

// Edges are in one strict order, that of their lengths and then of their numbers.
std::int32_t Refinement::fitting_edge(std::int32_t f) const {
  const auto key = [&](std::int32_t h) {
    const std::int32_t twin = mesh_.twins[index(h)];
    return std::pair(lengths_[index(h)], twin < 0 ? h : std::min(h, twin));
  };
  return std::ranges::max(std::array{3 * f, 3 * f + 1, 3 * f + 2}, {}, key);
}

// Invalid, and neither left out for sigma nor a part of a face without an area.
bool Refinement::is_unfit(std::int32_t f) const {
  if (is_valid(f) || perimeter(f) < options_.sigma) return false;
  return is_flat_origin_.empty() || !is_flat_origin_[index(origins_[index(f)])];
}

bool Refinement::can_be_fitted(std::int32_t f) const {
  const double *l = &lengths_[3 * index(f)], least = std::min({l[0], l[1], l[2]});
  return is_unfit(f) && least > kNeedle * std::max({l[0], l[1], l[2]});
}

// The length of the edge h from the middle of an edge to the apex: as measured, but within what the triangle inequality
// leaves between the edge's halves and the other two sides.
double Refinement::fitted(std::int32_t h, double half, double next_side, double last_side) const {
  const double low = std::max(std::abs(half - next_side), std::abs(half - last_side));
  const double high = half + std::min(next_side, last_side), room = kRoom * (high - low), length = measure(h);
  return room > 0 ? std::clamp(length, low + room, high - room) : length;
}

bool Refinement::fit(const Task& task, double progress) {
  std::vector<std::int32_t> todo;
  for (std::int32_t f = 0; index(f) < mesh_.corners.size(); ++f) {
    if (can_be_fitted(f)) todo.push_back(f);
  }
  for (std::size_t i = 0; i < todo.size(); ++i) {
    if ((i + 1) % kReportEvery == 0) task.check(progress);
    if (!can_be_fitted(todo[i])) continue;
    chain_.assign(1, todo[i]);
    while (!chain_.empty()) {
      const std::int32_t h = fitting_edge(chain_.back()), o = mesh_.twins[index(h)];
      // An invalid neighbour can be fitted at its longest edge only, which is longer than this one.
      if (o >= 0 && can_be_fitted(o / 3) && fitting_edge(o / 3) != o) {
        chain_.push_back(o / 3);
        continue;
      }
      if (faces_added_ + 2 > options_.max_faces_added) {
        hit_cap_ = true;
        return false;
      }
      const auto side = [&](std::int32_t from, int steps) {
        for (; steps > 0; --steps) from = next(from);
        return lengths_[index(from)];
      };
      const double half = lengths_[index(h)] / 2, b = side(h, 1), c = side(h, 2);
      const double d = o < 0 ? 0.0 : side(o, 1), e = o < 0 ? 0.0 : side(o, 2);
      const auto count = static_cast<std::int32_t>(mesh_.corners.size());
      bisect(h);
      set_length(h, half);
      set_length(3 * count, half);
      set_length(3 * count + 2, fitted(3 * count + 2, half, b, c));
      if (o >= 0) set_length(3 * count + 5, fitted(3 * count + 5, half, d, e));
      // Rounding may leave one of them invalid.
      for (const std::int32_t part : {h / 3, count, o < 0 ? count : o / 3, o < 0 ? count : count + 1}) {
        if (can_be_fitted(part)) todo.push_back(part);
      }
      chain_.pop_back();
    }
  }
  std::int32_t f = 0;
  while (index(f) < mesh_.corners.size() && !is_unfit(f)) ++f;
  return index(f) == mesh_.corners.size();
}

Embedding Refinement::result() && {
  Embedding out;
  out.invalid_before = invalid_before_;
  out.faces_added = faces_added_;
  out.hit_cap = hit_cap_;
  IntrinsicMesh& mesh = out.mesh;
  mesh.vertex_count = static_cast<std::int32_t>(points_.size());
  const auto faces = static_cast<std::int32_t>(mesh_.corners.size());
  std::vector<std::int32_t> holes;
  for (std::int32_t f = 0; f < faces; ++f) {
    if (!is_valid(f)) holes.push_back(f);
  }
  out.invalid_left = holes.size();
  const bool is_plain = keeps_numbers(surface_);
  if (!is_plain) {
    for (Triangle& corners : mesh_.corners) {
      for (std::int32_t& v : corners) v = number(v);
    }
    for (std::int32_t& f : origins_) f = surface_.face_of_half_edge_face()[index(f)];
  }
  // Each edge of holes alone, once.
  const auto is_hole = [&](std::int32_t f) { return std::binary_search(holes.begin(), holes.end(), f); };
  for (const std::int32_t f : holes) {
    for (std::int32_t h = 3 * f; h < 3 * f + 3; ++h) {
      const std::int32_t twin = mesh_.twins[index(h)];
      if (twin >= 0 && (twin < h || !is_hole(twin / 3))) continue;
      mesh.loose_edges.push_back({mesh_.tail(h), mesh_.tip(h), lengths_[index(h)]});
    }
  }
  if (!holes.empty()) {
    std::vector<std::int32_t> moved(index(faces), -1);
    std::int32_t to = 0;
    for (std::int32_t f = 0; f < faces; ++f) {
      if (!is_hole(f)) moved[index(f)] = to++;
    }
    for (std::int32_t f = 0; f < faces; ++f) {
      if (moved[index(f)] < 0) continue;
      const std::size_t g = index(moved[index(f)]);
      mesh_.corners[g] = mesh_.corners[index(f)];
      origins_[g] = origins_[index(f)];
      for (std::size_t i = 0; i < 3; ++i) {
        const std::int32_t twin = mesh_.twins[3 * index(f) + i];
        const std::int32_t beyond = twin < 0 ? -1 : moved[index(twin / 3)];
        mesh_.twins[3 * g + i] = beyond < 0 ? -1 : 3 * beyond + twin % 3;
        lengths_[3 * g + i] = lengths_[3 * index(f) + i];
      }
    }
    mesh_.corners.resize(index(to));
    origins_.resize(index(to));
    mesh_.twins.resize(3 * index(to));
    lengths_.resize(3 * index(to));
  }
  mesh.triangles = std::move(mesh_.corners);
  mesh.twins = std::move(mesh_.twins);
  mesh.lengths = std::move(lengths_);
  out.source_face = std::move(origins_);
  out.points = std::move(points_);
  mesh.loose_edges.insert(mesh.loose_edges.end(), merged_.begin(), merged_.end());
  for (const auto& [a, b] : surface_.loose_edges()) {
    mesh.loose_edges.push_back({a, b, edge_length(surface_, metric_, a, b)});
  }
  out.is_local = is_plain && holes.empty() && !has_mended_ && scheme_ == Scheme::kPaper;
  if (!out.is_local) out.unreachable = unreachable(mesh);
  return out;
}

// Vertices of a triangle that no path leads to.
std::vector<std::int32_t> Refinement::unreachable(const IntrinsicMesh& mesh) const {
  std::vector<bool> reached(index(mesh.vertex_count), false);
  for (const Triangle& triangle : mesh.triangles) {
    for (const std::int32_t v : triangle) reached[index(v)] = true;
  }
  for (const LooseEdge& edge : mesh.loose_edges) reached[index(edge.a)] = reached[index(edge.b)] = true;
  std::vector<std::int32_t> out;
  for (const Triangle& triangle : surface_.triangles()) {
    for (const std::int32_t v : triangle) {
      if (reached[index(v)]) continue;
      out.push_back(v);
      reached[index(v)] = true;
    }
  }
  std::sort(out.begin(), out.end());
  return out;
}

// Where an original triangle lies in the surface's half-edge mesh: its corners, and the twins of its half-edges.
struct Given {
  Triangle corners;
  std::array<std::int32_t, 3> twins;
};

Given given(const HalfEdgeMesh& mesh, std::int32_t face) {
  Given out;
  const HalfedgeHandle last = mesh.halfedge_handle(FaceHandle(face)), first = mesh.next_halfedge_handle(last);
  std::size_t i = 0;
  for (const HalfedgeHandle h : {first, mesh.next_halfedge_handle(first), last}) {
    out.corners[i] = mesh.from_vertex_handle(h).idx();
    const HalfedgeHandle opposite = mesh.opposite_halfedge_handle(h);
    if (mesh.is_boundary(opposite)) {
      out.twins[i++] = -1;
      continue;
    }
    const FaceHandle beyond = mesh.face_handle(opposite);
    const HalfedgeHandle its_last = mesh.halfedge_handle(beyond);
    const int at = opposite == its_last ? 2 : opposite == mesh.next_halfedge_handle(its_last) ? 0 : 1;
    out.twins[i++] = 3 * beyond.idx() + at;
  }
  return out;
}

Refinement::Refinement(const Surface& surface, const Metric& metric, const EmbedOptions& options, Embedding&& old)
    : surface_(surface),
      metric_(metric),
      options_(options),
      scheme_(Scheme::kPaper),
      vertex_of_fan_(surface.vertex_of_fan()),
      fans_(vertex_of_fan_.size()),
      faces_(surface.face_count()),
      mesh_{std::move(old.mesh.triangles), std::move(old.mesh.twins)},
      lengths_(std::move(old.mesh.lengths)),
      origins_(std::move(old.source_face)),
      branch_(mesh_.corners.size(), 1),
      depth_(mesh_.corners.size(), 0),
      nodes_(std::make_unique_for_overwrite<Node[]>(fans_)),
      new_nodes_(old.points.size() - fans_),
      tensors_(new_nodes_.size()),
      states_(faces_, State::kOriginal),
      points_(std::move(old.points)),
      invalid_before_(old.invalid_before),
      faces_added_(mesh_.corners.size() - faces_) {
  for (std::size_t f = faces_; f < origins_.size(); ++f) states_[index(origins_[f])] = State::kKept;
}

std::vector<std::int32_t> Refinement::changed_faces(const Metric& former) const {
  std::vector<std::int32_t> faces;
  for (std::size_t v = 0; v < fans_; ++v) {
    if (former.tensors[v] == metric_.tensors[v]) continue;
    for (const FaceHandle f : surface_.half_edges().vf_range(VertexHandle(static_cast<int>(v)))) {
      faces.push_back(f.idx());
    }
  }
  std::sort(faces.begin(), faces.end());
  faces.erase(std::unique(faces.begin(), faces.end()), faces.end());
  return faces;
}

// Ready to take part in this run; false for a face that was bisected before it and has to be made anew.
bool Refinement::enter(std::int32_t face) {
  State& state = states_[index(face)];
  if (state == State::kKept) return false;
  if (state == State::kOriginal) {
    for (const std::int32_t fan : mesh_.corners[index(face)]) set_node(fan);
    state = State::kRunning;
    running_.push_back(face);
  }
  return true;
}

// Makes faces what they were before any bisection, and with them those that they are bisected together with: two faces
// whose common edge is bisected. In doing so it moves triangles and vertices together.
void Refinement::reset(const std::vector<std::int32_t>& seeds) {
  const HalfEdgeMesh& mesh = surface_.half_edges();
  // The parts of each face but the first: of a face the last one made, and of a part the one before it.
  std::vector<std::int32_t> last_part(faces_, -1), part_before(origins_.size() - faces_);
  for (std::size_t f = faces_; f < origins_.size(); ++f) {
    part_before[f - faces_] = std::exchange(last_part[index(origins_[f])], static_cast<std::int32_t>(f));
  }

  struct Outer {
    std::int32_t inside, outside;
  };
  std::vector<Outer> sides;  // every unbisected side of a face to reset, and what is beyond it
  std::vector<bool> is_reset(faces_, false);
  std::vector<std::int32_t> faces;
  const auto add = [&](std::int32_t face) {
    if (!is_reset[index(face)]) faces.push_back(face);
    is_reset[index(face)] = true;
  };
  for (const std::int32_t face : seeds) add(face);
  for (std::size_t done = 0; done < faces.size();) {  // add() makes it grow
    const std::int32_t face = faces[done++];
    const Given original = given(mesh, face);
    std::array<std::int32_t, 3> whole{-1, -1, -1};
    const auto look = [&](std::int32_t part) {
      for (std::int32_t h = 3 * part; h < 3 * part + 3; ++h) {
        for (std::size_t side = 0; side < 3; ++side) {
          if (mesh_.tail(h) == original.corners[side] && mesh_.tip(h) == original.corners[(side + 1) % 3]) {
            whole[side] = h;
          }
        }
      }
    };
    look(face);
    for (std::int32_t part = last_part[index(face)]; part >= 0; part = part_before[index(part) - faces_]) look(part);
    for (std::size_t side = 0; side < 3; ++side) {
      if (whole[side] >= 0) {
        sides.push_back({3 * face + static_cast<std::int32_t>(side), mesh_.twins[index(whole[side])]});
      } else if (original.twins[side] >= 0) {
        add(original.twins[side] / 3);
      }
    }
  }
  std::erase_if(
      sides, [&](const Outer& side) { return side.outside < 0 || is_reset[index(origins_[index(side.outside / 3)])]; });
  for (const std::int32_t face : faces) {
    const Given original = given(mesh, face);
    mesh_.corners[index(face)] = original.corners;
    std::ranges::copy(original.twins, mesh_.twins.begin() + std::ptrdiff_t{3} * face);
    branch_[index(face)] = 1;
    states_[index(face)] = State::kOriginal;
  }
  for (const auto& [inside, outside] : sides) {
    mesh_.twins[index(inside)] = outside;
    mesh_.twins[index(outside)] = inside;
  }

  // The parts of those faces go.
  std::size_t to = faces_;
  for (std::size_t f = faces_; f < origins_.size(); ++f) {
    if (is_reset[index(origins_[f])]) continue;
    mesh_.corners[to] = mesh_.corners[f];
    origins_[to] = origins_[f];
    branch_[to] = branch_[f];
    for (std::size_t i = 0; i < 3; ++i) {
      lengths_[3 * to + i] = lengths_[3 * f + i];
      const std::int32_t twin = mesh_.twins[3 * f + i];
      mesh_.twins[3 * to + i] = twin;
      if (twin >= 0) mesh_.twins[index(twin)] = static_cast<std::int32_t>(3 * to + i);
    }
    ++to;
  }
  mesh_.corners.resize(to);
  mesh_.twins.resize(3 * to);
  lengths_.resize(3 * to);
  origins_.resize(to);
  branch_.resize(to);
  depth_.resize(to);
  faces_added_ = to - faces_;

  // And the vertices that nothing else has. Bisecting leaves a face's first part at the face's own place.
  std::vector<std::int32_t> kept;
  for (std::size_t f = faces_; f < origins_.size(); ++f) {
    const std::int32_t face = origins_[f];
    if (std::exchange(last_part[index(face)], -1) >= 0) kept.push_back(face);
  }
  for (std::size_t f = faces_; f < to; ++f) kept.push_back(static_cast<std::int32_t>(f));
  std::vector<std::int32_t> renumbered(new_nodes_.size(), -1);
  for (const std::int32_t f : kept) {
    for (const std::int32_t v : mesh_.corners[index(f)]) {
      if (index(v) >= fans_) renumbered[index(v) - fans_] = 0;
    }
  }
  std::size_t count = 0;
  for (std::size_t v = 0; v < renumbered.size(); ++v) {
    if (renumbered[v] < 0) continue;
    renumbered[v] = static_cast<std::int32_t>(fans_ + count);
    new_nodes_[count] = new_nodes_[v];
    tensors_[count] = tensors_[v];
    points_[fans_ + count++] = points_[fans_ + v];
  }
  new_nodes_.resize(count);
  tensors_.resize(count);
  points_.resize(fans_ + count);
  for (const std::int32_t f : kept) {
    for (std::int32_t& v : mesh_.corners[index(f)]) {
      if (index(v) >= fans_) v = renumbered[index(v) - fans_];
    }
  }

  for (const std::int32_t face : faces) enter(face);
  for (const std::int32_t face : faces) {
    for (std::int32_t h = 3 * face; h < 3 * face + 3; ++h) set_length(h, measure(h));
  }
  for (const std::int32_t face : faces) consider(face);
}

bool Refinement::run_changes(const Metric& former, const Task& task, std::size_t most) {
  std::vector<std::int32_t> seeds = changed_faces(former);
  for (const std::int32_t face : seeds) {
    invalid_before_ += is_given_valid(face, former);
    invalid_before_ -= is_given_valid(face, metric_);
  }
  double progress = 0;
  while (true) {
    reset(seeds);
    if (!work_off(task, most, progress)) return false;
    if (conflicts_.empty()) return true;
    // All else is done. What took part in a conflict begins anew, both sides of it together.
    for (const std::int32_t face : running_) states_[index(face)] = State::kOriginal;
    running_.clear();
    for (std::size_t f = faces_; f < origins_.size(); ++f) states_[index(origins_[f])] = State::kKept;
    seeds = std::exchange(conflicts_, {});
  }
}

// Whether an original triangle is valid in a metric.
bool Refinement::is_given_valid(std::int32_t face, const Metric& metric) const {
  const auto [a, b, c] = given(surface_.half_edges(), face).corners;
  std::array lengths{edge_length(surface_, metric, a, b), edge_length(surface_, metric, b, c),
                     edge_length(surface_, metric, c, a)};
  std::ranges::sort(lengths);
  return lengths[2] < (lengths[0] + lengths[1]) * (1 - kSlack);
}

}  // namespace

Embedding embed(const Surface& surface, const Metric& metric, const EmbedOptions& options, const Task& task) {
  check_metric(surface, metric);
  if (!(options.sigma >= 0)) throw InvalidInput("sigma is " + std::to_string(options.sigma) + ", not 0 or more");
  task.check(0);
  double progress = 0;
  const auto done = [&](Refinement&& refinement) {
    Embedding out = std::move(refinement).result();
    task.check(1);
    return out;
  };
  Refinement paper(surface, metric, options, Scheme::kPaper);
  const std::size_t first_most = std::min(budget(surface), options.max_faces_added);
  const bool ends = paper.run(task, first_most, progress);
  if (ends ? !paper.has_decayed() : first_most == options.max_faces_added) return done(std::move(paper));

  const std::size_t most = later_budget(surface, options.max_faces_added);
  for (const Scheme scheme : {Scheme::kPropagate, Scheme::kShallow}) {
    Refinement refinement(surface, metric, options, scheme);
    if (!refinement.run(task, most, progress) || !refinement.fit(task, progress)) continue;
    // It may take half as many triangles again as the paper's scheme, which, had it been let, might have ended by now.
    const std::size_t papers_share = refinement.faces_added() * 2 / 3;
    if (!ends && papers_share > first_most && paper.work_off(task, papers_share, progress) && !paper.has_decayed()) {
      return done(std::move(paper));
    }
    return done(std::move(refinement));
  }
  Refinement fitting(surface, metric, options, Scheme::kFitAlone);
  fitting.run(task, most, progress);
  fitting.fit(task, progress);
  return done(std::move(fitting));
}

Embedding re_embed(const Surface& surface, const Metric& former, const Metric& metric, Embedding old,
                   const EmbedOptions& options, const Task& task) {
  check_size(surface, former);
  check_metric(surface, metric);
  const std::size_t faces = surface.face_count();
  const bool fits = old.points.size() >= surface.vertex_count() &&
                    old.mesh.face_count() + old.invalid_left >= surface.half_edges().n_faces() + old.faces_added &&
                    std::ranges::all_of(old.source_face, [&](std::int32_t f) { return f >= 0 && index(f) < faces; });
  if (!fits) throw InvalidInput("the former embedding is of another surface");
  if (!old.is_local || former.normals != metric.normals) return embed(surface, metric, options, task);
  task.check(0);
  {
    Refinement changes(surface, metric, options, std::move(old));
    if (changes.run_changes(former, task, std::min(budget(surface), options.max_faces_added)) &&
        !changes.has_decayed()) {
      Embedding out = std::move(changes).result();
      task.check(1);
      return out;
    }
  }
  return embed(surface, metric, options, task);
}

}  // namespace seamwire
