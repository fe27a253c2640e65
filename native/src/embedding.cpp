// SPDX-License-Identifier: GPL-3.0-or-later
#include "seamwire/embedding.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <queue>
#include <string>
#include <vector>

namespace seamwire {
namespace {

using VertexHandle = OpenMesh::VertexHandle;
using HalfedgeHandle = OpenMesh::HalfedgeHandle;
using EdgeHandle = OpenMesh::EdgeHandle;
using FaceHandle = OpenMesh::FaceHandle;

// A triangle is valid where its longest edge is shorter than the others together by this fraction: exact geodesics
// unfold it, and the square root in the unfolding leaves half of its digits.
constexpr double kSlack = 1e-10;
// Lengths that differ by less than this fraction are equal, so that rounding, which depends on the scale of the input,
// does not choose which edge to bisect.
constexpr double kEqual = 1e-9;
// A face lower than this fraction of its longest edge has no area. Bisecting it never ends: its parts have none either.
constexpr double kFlat = 1e-9;
// Times that all faces without an area are looked at, each time because some could be taken away the time before.
constexpr int kMendingPasses = 64;
// The paper's scheme may add this many triangles for each of the surface's, and this many in any case. Where it ends,
// it mostly ends below one for each.
constexpr std::size_t kBudget = 4, kLeastBudget = 20'000;
// Bisections of an original face, one of a part of a part, until newest-vertex bisection begins.
constexpr std::uint8_t kNewestDepth = 40;
// Splits between two reports of progress: about a millisecond.
constexpr std::size_t kReportEvery = 1024;

std::size_t index(OpenMesh::BaseHandle handle) { return static_cast<std::size_t>(handle.idx()); }

void check_metric(const Surface& surface, const Metric& metric) {
  const std::size_t n = surface.vertex_count();
  if (metric.tensors.size() != n || metric.normals.size() != n) {
    throw InvalidInput("metric of " + std::to_string(metric.size()) + " vertices for a surface of " +
                       std::to_string(n));
  }
  for (std::size_t v = 0; v < n; ++v) {
    if (!metric.tensors[v].allFinite() || !metric.normals[v].allFinite()) {
      throw InvalidInput("the metric at vertex " + std::to_string(v) + " is not finite");
    }
  }
}

enum class Scheme {
  kPaper,      ///< an invalid triangle and the neighbour behind its longest edge are bisected, whatever the neighbour
  kPropagate,  ///< the neighbour is first bisected until the common edge is the right one for it too
};

/// A copy of the surface's half-edge mesh, refined in place. OpenMesh's ranges leave out what was merged away.
class Refinement {
 public:
  Refinement(const Surface& surface, const Metric& metric, const EmbedOptions& options, Scheme scheme);

  /// False where more than `most` triangles would have to be added. Progress goes on from `progress`.
  bool run(const Task& task, std::size_t most, double& progress);
  Embedding result() const;

 private:
  struct Candidate {
    float perimeter;  // rounded, so that the scale of the input does not choose between equal ones
    std::int32_t face;

    // Of equal ones, the first.
    friend bool operator<(const Candidate& a, const Candidate& b) {
      return a.perimeter != b.perimeter ? a.perimeter < b.perimeter : a.face > b.face;
    }
  };

  void orient_normals();
  bool is_new(VertexHandle v) const { return index(v) >= fans_; }
  std::int32_t number(VertexHandle v) const;
  TensorAt tensor_at(VertexHandle v) const;
  double norm(VertexHandle at, const Vector& e) const;
  Vector vector(HalfedgeHandle h) const;
  double length(HalfedgeHandle h) const { return lengths_[index(mesh_.edge_handle(h))]; }
  double measure(HalfedgeHandle h) const;
  std::array<HalfedgeHandle, 3> sides(FaceHandle f) const;
  bool is_valid(FaceHandle f) const;
  bool is_flat(FaceHandle f) const;
  double perimeter(FaceHandle f) const;
  HalfedgeHandle longest(FaceHandle f) const;
  bool is_gone(FaceHandle f) const { return has_merged_ && mesh_.status(f).deleted(); }
  void mend();
  bool merge_ends(FaceHandle f);
  FaceHandle flip_longest(FaceHandle f);
  void consider(FaceHandle f);
  HalfedgeHandle refinement_edge(FaceHandle f) const;
  void begin_newest_vertex_bisection();
  bool refine(FaceHandle f, std::size_t most);
  void bisect(EdgeHandle e);

  const Surface& surface_;
  const Metric& metric_;
  const EmbedOptions& options_;
  Scheme scheme_;
  HalfEdgeMesh mesh_;
  std::size_t fans_;               // vertices of the surface's half-edge mesh
  std::vector<bool> is_turned_;    // per fan: its side of the surface is the other one than its vertex's normal's
  std::vector<TensorAt> tensors_;  // of the new vertices
  std::vector<double> weights_;    // normal_weight() of the tensor of every vertex
  std::vector<double> lengths_;    // per edge
  std::vector<std::int32_t> source_face_;  // per face
  std::vector<std::uint8_t> depth_;        // per face: bisections since the original face, up to kNewestDepth
  std::size_t first_newest_ = 0;           // vertices from here on are of newest-vertex bisection; 0: it has not begun
  std::vector<std::int32_t> deferred_;     // invalid triangles left to newest-vertex bisection
  std::vector<FaceHandle> chain_;          // triangles to bisect, the last one first
  std::priority_queue<Candidate> queue_;   // invalid triangles that may be bisected; entries grow stale
  std::vector<LooseEdge> merged_;          // between vertices at the same place, of which only the second has faces now
  bool has_merged_ = false;
  std::size_t invalid_before_ = 0;
  std::size_t faces_added_ = 0;
  bool hit_cap_ = false;
};

Refinement::Refinement(const Surface& surface, const Metric& metric, const EmbedOptions& options, Scheme scheme)
    : surface_(surface),
      metric_(metric),
      options_(options),
      scheme_(scheme),
      mesh_(surface.half_edges()),
      fans_(mesh_.n_vertices()),
      source_face_(surface.face_of_half_edge_face()) {
  weights_.reserve(fans_);
  for (const std::int32_t v : surface.vertex_of_fan()) {
    weights_.push_back(normal_weight(metric.tensors[static_cast<std::size_t>(v)]));
  }
  orient_normals();
  mend();
  depth_.assign(source_face_.size(), 0);
  lengths_.resize(mesh_.n_edges());
  for (const EdgeHandle e : mesh_.edges()) lengths_[index(e)] = measure(mesh_.halfedge_handle(e, 0));
}

// A vertex has one normal, but its fans need not agree on which side of the surface is outside: where a one-sided
// surface is cut they cannot. Normals in the middle of edges are means, so they must be of one side.
void Refinement::orient_normals() {
  is_turned_.assign(fans_, false);
  const auto& vertex_of_fan = surface_.vertex_of_fan();  // ascending
  if (std::adjacent_find(vertex_of_fan.begin(), vertex_of_fan.end()) == vertex_of_fan.end()) return;
  std::vector<Vector> normals(fans_, Vector::Zero());
  for (const FaceHandle f : mesh_.faces()) {
    const auto [a, b, c] = sides(f);
    const Vector normal = vector(a).cross(vector(b));
    for (const HalfedgeHandle h : {a, b, c}) normals[index(mesh_.from_vertex_handle(h))] += normal;
  }
  for (std::size_t fan = 0; fan < fans_; ++fan) {
    const std::int32_t v = vertex_of_fan[fan];
    const bool is_shared = (fan > 0 && vertex_of_fan[fan - 1] == v) || (fan + 1 < fans_ && vertex_of_fan[fan + 1] == v);
    is_turned_[fan] = is_shared && normals[fan].dot(metric_.normals[static_cast<std::size_t>(v)]) < 0;
  }
}

std::int32_t Refinement::number(VertexHandle v) const {
  return is_new(v) ? static_cast<std::int32_t>(surface_.vertex_count() + index(v) - fans_)
                   : surface_.vertex_of_fan()[index(v)];
}

TensorAt Refinement::tensor_at(VertexHandle v) const {
  if (is_new(v)) return tensors_[index(v) - fans_];
  const auto i = static_cast<std::size_t>(surface_.vertex_of_fan()[index(v)]);
  return {is_turned_[index(v)] ? Vector(-metric_.normals[i]) : metric_.normals[i], metric_.tensors[i]};
}

double Refinement::norm(VertexHandle at, const Vector& e) const {
  const auto i = is_new(at) ? index(at) - fans_ : static_cast<std::size_t>(surface_.vertex_of_fan()[index(at)]);
  const Eigen::Matrix3d& m = is_new(at) ? tensors_[i].tensor : metric_.tensors[i];
  const Vector& n = is_new(at) ? tensors_[i].normal : metric_.normals[i];
  const double out = n.dot(e);
  return std::sqrt(std::max(0.0, e.dot(m * e) + weights_[index(at)] * out * out));
}

// A half-edge in the unit cube.
Vector Refinement::vector(HalfedgeHandle h) const {
  return (mesh_.point(mesh_.to_vertex_handle(h)) - mesh_.point(mesh_.from_vertex_handle(h))) * surface_.scale();
}

// Length of an edge in the metric, from both of its ends.
double Refinement::measure(HalfedgeHandle h) const {
  const Vector e = vector(h);
  return integrated_length(norm(mesh_.from_vertex_handle(h), e), norm(mesh_.to_vertex_handle(h), e));
}

// From the face's first corner on, as OpenMesh lists its vertices.
std::array<HalfedgeHandle, 3> Refinement::sides(FaceHandle f) const {
  const HalfedgeHandle a = mesh_.halfedge_handle(f), b = mesh_.next_halfedge_handle(a);
  return {b, mesh_.next_halfedge_handle(b), a};
}

bool Refinement::is_valid(FaceHandle f) const {
  const auto [h0, h1, h2] = sides(f);
  const double a = length(h0), b = length(h1), c = length(h2);
  const double most = std::max({a, b, c});
  return most < (a + b + c - most) * (1 - kSlack);
}

bool Refinement::is_flat(FaceHandle f) const {
  const auto [h0, h1, h2] = sides(f);
  const Vector a = vector(h0), b = vector(h1), c = vector(h2);
  return !(a.cross(b).norm() > kFlat * std::max({a.squaredNorm(), b.squaredNorm(), c.squaredNorm()}));
}

double Refinement::perimeter(FaceHandle f) const {
  const auto [h0, h1, h2] = sides(f);
  if (options_.perimeter == Perimeter::kMetric) return length(h0) + length(h1) + length(h2);
  return vector(h0).norm() + vector(h1).norm() + vector(h2).norm();
}

HalfedgeHandle Refinement::longest(FaceHandle f) const {
  const auto [h0, h1, h2] = sides(f);
  HalfedgeHandle best = h0;
  for (const HalfedgeHandle h : {h1, h2}) {
    if (length(h) > length(best) * (1 + kEqual)) best = h;
  }
  return best;
}

// Takes away faces without an area, across which no path could go, without a change to the surface: of one with two
// corners at the same place the two are merged, and of one with a corner on the opposite edge that edge is flipped, so
// that the face beyond it, of which the corner is a point too, is split there.
void Refinement::mend() {
  std::vector<FaceHandle> flat;
  for (const FaceHandle f : mesh_.faces()) {
    if (is_flat(f)) flat.push_back(f);
  }
  const auto mended = [&](FaceHandle f) { return is_gone(f) || !is_flat(f); };
  const std::size_t before = flat.size();
  bool progress = before > 0;
  for (int pass = 0; progress && pass < kMendingPasses; ++pass) {
    progress = false;
    for (std::size_t i = 0, count = flat.size(); i < count; ++i) {
      if (mended(flat[i])) continue;
      if (merge_ends(flat[i])) {
        progress = true;
      } else if (const FaceHandle beyond = flip_longest(flat[i]); beyond.is_valid()) {
        progress = true;
        flat.push_back(beyond);
      }
    }
    std::erase_if(flat, mended);
    std::sort(flat.begin(), flat.end());
    flat.erase(std::unique(flat.begin(), flat.end()), flat.end());
  }
  invalid_before_ = before - std::min(before, flat.size());
}

// Merges the ends of the shortest edge if it is the reason why the face has no area.
bool Refinement::merge_ends(FaceHandle f) {
  const auto by_length = [&](HalfedgeHandle a, HalfedgeHandle b) {
    return vector(a).squaredNorm() < vector(b).squaredNorm();
  };
  const auto all = sides(f);
  const auto [shortest, longest] = std::minmax_element(all.begin(), all.end(), by_length);
  if (vector(*shortest).norm() > kFlat * vector(*longest).norm()) return false;
  if (!has_merged_) {
    mesh_.request_vertex_status();
    mesh_.request_halfedge_status();
    mesh_.request_edge_status();
    mesh_.request_face_status();
    has_merged_ = true;
  }
  for (const HalfedgeHandle h : {*shortest, mesh_.opposite_halfedge_handle(*shortest)}) {
    const VertexHandle from = mesh_.from_vertex_handle(h), to = mesh_.to_vertex_handle(h);
    // A second edge between the two would become a loop.
    if (std::ranges::count(mesh_.vv_range(from), to) != 1 || !mesh_.is_collapse_ok(h)) continue;
    merged_.push_back({number(from), number(to), measure(h)});
    mesh_.collapse(h);
    return true;
  }
  return false;
}

// Flips the longest edge if that leaves fewer faces without an area, or shorter edges; then, and only then, returns the
// face that was beyond it.
FaceHandle Refinement::flip_longest(FaceHandle f) {
  HalfedgeHandle h = sides(f)[0];
  for (const HalfedgeHandle side : sides(f)) {
    if (vector(side).squaredNorm() > vector(h).squaredNorm()) h = side;
  }
  const HalfedgeHandle opposite = mesh_.opposite_halfedge_handle(h);
  const EdgeHandle e = mesh_.edge_handle(h);
  if (mesh_.is_boundary(opposite) || !mesh_.is_flip_ok(e)) return FaceHandle();
  const FaceHandle beyond = mesh_.face_handle(opposite);
  const auto apex = [&](HalfedgeHandle side) {
    return mesh_.point(mesh_.to_vertex_handle(mesh_.next_halfedge_handle(side)));
  };
  const double flipped = (apex(opposite) - apex(h)).norm() * surface_.scale();
  if (is_flat(beyond) && !(flipped < vector(h).norm() * (1 - kEqual))) return FaceHandle();
  mesh_.flip(e);
  source_face_[index(f)] = source_face_[index(beyond)];
  return beyond;
}

void Refinement::consider(FaceHandle f) {
  if (is_valid(f) || is_flat(f)) return;
  const double p = perimeter(f);
  if (p < options_.sigma) return;
  if (scheme_ == Scheme::kPropagate && first_newest_ == 0 && depth_[index(f)] >= kNewestDepth) {
    deferred_.push_back(f.idx());
  } else {
    queue_.push({static_cast<float>(p), f.idx()});
  }
}

// The mesh as it stands becomes the starting triangulation.
void Refinement::begin_newest_vertex_bisection() {
  first_newest_ = mesh_.n_vertices();
  std::vector<std::int32_t> deferred;
  deferred.swap(deferred_);
  std::sort(deferred.begin(), deferred.end());
  deferred.erase(std::unique(deferred.begin(), deferred.end()), deferred.end());
  for (const std::int32_t f : deferred) consider(FaceHandle(f));
}

// Where a triangle is to be bisected. Once newest-vertex bisection has begun: opposite its newest vertex; else, and for
// triangles of the starting triangulation, at its longest edge. Edges are in one strict order, that of their rounded
// lengths and then of their numbers, so a chain of neighbours with ever longer edges ends.
HalfedgeHandle Refinement::refinement_edge(FaceHandle f) const {
  if (scheme_ == Scheme::kPaper) return longest(f);
  const std::array<HalfedgeHandle, 3> all = sides(f);
  if (first_newest_ > 0) {
    for (const HalfedgeHandle h : all) {
      const HalfedgeHandle b = mesh_.next_halfedge_handle(h);
      const VertexHandle apex = mesh_.to_vertex_handle(b);
      const VertexHandle newest = std::max({apex, mesh_.from_vertex_handle(h), mesh_.to_vertex_handle(h)});
      if (apex == newest && index(newest) >= first_newest_) return h;
    }
  }
  const auto key = [&](HalfedgeHandle h) {
    return std::pair(static_cast<float>(length(h)), mesh_.edge_handle(h).idx());
  };
  HalfedgeHandle best = all[0];
  for (const HalfedgeHandle h : {all[1], all[2]}) {
    if (key(h) > key(best)) best = h;
  }
  return best;
}

// Bisects a face, and before it those that the scheme wants bisected first; false where that takes too many triangles.
bool Refinement::refine(FaceHandle f, std::size_t most) {
  chain_.assign(1, f);
  while (!chain_.empty()) {
    const HalfedgeHandle h = refinement_edge(chain_.back()), beyond = mesh_.opposite_halfedge_handle(h);
    const bool is_boundary = mesh_.is_boundary(beyond);
    if (scheme_ == Scheme::kPropagate && !is_boundary) {
      const FaceHandle neighbour = mesh_.face_handle(beyond);
      if (refinement_edge(neighbour) != beyond) {
        chain_.push_back(neighbour);
        continue;
      }
    }
    if (faces_added_ + (is_boundary ? 1 : 2) > most) return false;
    bisect(mesh_.edge_handle(h));
    chain_.pop_back();
  }
  return true;
}

void Refinement::bisect(EdgeHandle e) {
  const HalfedgeHandle h = mesh_.halfedge_handle(e, 0), o = mesh_.halfedge_handle(e, 1);
  const VertexHandle a = mesh_.from_vertex_handle(h), b = mesh_.to_vertex_handle(h);
  // The new faces come in this order (OpenMesh's TriConnectivity::split).
  for (const HalfedgeHandle side : {h, o}) {
    if (mesh_.is_boundary(side)) continue;
    const std::size_t f = index(mesh_.face_handle(side));
    source_face_.push_back(source_face_[f]);
    if (depth_[f] < kNewestDepth) ++depth_[f];
    depth_.push_back(depth_[f]);
    ++faces_added_;
  }
  tensors_.push_back(midpoint_tensor(tensor_at(a), tensor_at(b)));
  weights_.push_back(normal_weight(tensors_.back().tensor));
  const VertexHandle p(mesh_.add_vertex((mesh_.point(a) + mesh_.point(b)) / 2).idx());
  mesh_.split(e, p);

  lengths_.resize(mesh_.n_edges());
  const HalfedgeHandle first = mesh_.halfedge_handle(p);
  HalfedgeHandle out = first;
  do {
    lengths_[index(mesh_.edge_handle(out))] = measure(out);
    out = mesh_.next_halfedge_handle(mesh_.opposite_halfedge_handle(out));
  } while (out != first);
  do {
    if (!mesh_.is_boundary(out)) consider(mesh_.face_handle(out));
    out = mesh_.next_halfedge_handle(mesh_.opposite_halfedge_handle(out));
  } while (out != first);
}

bool Refinement::run(const Task& task, std::size_t most, double& progress) {
  for (const FaceHandle f : mesh_.faces()) {
    if (!is_valid(f)) ++invalid_before_;
    consider(f);
  }
  task.check(progress);
  for (std::size_t steps = 0;;) {
    if (queue_.empty()) {
      if (deferred_.empty()) return true;
      begin_newest_vertex_bisection();
      continue;
    }
    const Candidate next = queue_.top();
    queue_.pop();
    const FaceHandle f(next.face);
    // A face changes when a neighbour is bisected, and is queued again if it is still invalid.
    if (static_cast<float>(perimeter(f)) != next.perimeter || is_valid(f)) continue;
    if (!refine(f, most)) {
      hit_cap_ = true;
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

Embedding Refinement::result() const {
  Embedding out;
  const std::size_t callers = surface_.vertex_count(), added = mesh_.n_vertices() - fans_;
  out.points.reserve(callers + added);
  out.points = surface_.points();
  for (std::size_t v = fans_; v < mesh_.n_vertices(); ++v) {
    out.points.push_back(mesh_.point(VertexHandle(static_cast<int>(v))));
  }
  out.invalid_before = invalid_before_;
  out.faces_added = faces_added_;
  out.hit_cap = hit_cap_;

  IntrinsicMesh& mesh = out.mesh;
  mesh.vertex_count = static_cast<std::int32_t>(callers + added);
  mesh.triangles.reserve(mesh_.n_faces());
  mesh.lengths.reserve(3 * mesh_.n_faces());
  out.source_face.reserve(mesh_.n_faces());
  std::vector<std::int32_t> renumbered(mesh_.n_halfedges(), -1);
  for (const FaceHandle f : mesh_.faces()) {
    if (!is_valid(f)) {
      ++out.invalid_left;
      continue;
    }
    Triangle triangle;
    std::size_t i = 0;
    for (const HalfedgeHandle h : sides(f)) {
      renumbered[index(h)] = static_cast<std::int32_t>(mesh.lengths.size());
      mesh.lengths.push_back(length(h));
      triangle[i++] = number(mesh_.from_vertex_handle(h));
    }
    mesh.triangles.push_back(triangle);
    out.source_face.push_back(source_face_[index(f)]);
  }
  mesh.twins.resize(mesh.lengths.size());
  for (const HalfedgeHandle h : mesh_.halfedges()) {
    const std::int32_t i = renumbered[index(h)];
    if (i >= 0) mesh.twins[static_cast<std::size_t>(i)] = renumbered[index(mesh_.opposite_halfedge_handle(h))];
  }

  for (const EdgeHandle e : mesh_.edges()) {
    const HalfedgeHandle h = mesh_.halfedge_handle(e, 0), o = mesh_.halfedge_handle(e, 1);
    if (renumbered[index(h)] >= 0 || renumbered[index(o)] >= 0) continue;
    mesh.loose_edges.push_back(
        {number(mesh_.from_vertex_handle(h)), number(mesh_.to_vertex_handle(h)), lengths_[index(e)]});
  }
  mesh.loose_edges.insert(mesh.loose_edges.end(), merged_.begin(), merged_.end());
  for (const auto& [a, b] : surface_.loose_edges()) {
    mesh.loose_edges.push_back({a, b, edge_length(surface_, metric_, a, b)});
  }

  std::vector<bool> reached(callers + added, false);
  for (const Triangle& triangle : mesh.triangles) {
    for (const std::int32_t v : triangle) reached[static_cast<std::size_t>(v)] = true;
  }
  for (const LooseEdge& edge : mesh.loose_edges) {
    reached[static_cast<std::size_t>(edge.a)] = reached[static_cast<std::size_t>(edge.b)] = true;
  }
  for (const Triangle& triangle : surface_.triangles()) {
    for (const std::int32_t v : triangle) {
      if (reached[static_cast<std::size_t>(v)]) continue;
      out.unreachable.push_back(v);
      reached[static_cast<std::size_t>(v)] = true;
    }
  }
  std::sort(out.unreachable.begin(), out.unreachable.end());
  return out;
}

}  // namespace

Embedding embed(const Surface& surface, const Metric& metric, const EmbedOptions& options, const Task& task) {
  check_metric(surface, metric);
  if (!(options.sigma >= 0)) throw InvalidInput("sigma is " + std::to_string(options.sigma) + ", not 0 or more");
  task.check(0);
  double progress = 0;
  const auto done = [&](const Refinement& refinement) {
    Embedding out = refinement.result();
    task.check(1);
    return out;
  };
  const std::size_t budget = std::max(kLeastBudget, kBudget * surface.face_count());
  {
    Refinement paper(surface, metric, options, Scheme::kPaper);
    const std::size_t most = std::min(budget, options.max_faces_added);
    if (paper.run(task, most, progress) || most == options.max_faces_added) return done(paper);
  }
  Refinement propagating(surface, metric, options, Scheme::kPropagate);
  propagating.run(task, options.max_faces_added, progress);
  return done(propagating);
}

}  // namespace seamwire
