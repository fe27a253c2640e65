// SPDX-License-Identifier: GPL-3.0-or-later
#include "embedding/bisection.hpp"

#include <Eigen/Geometry>
#include <numeric>
#include <utility>

#include "detail/prefetch.hpp"

namespace seamwire {
namespace {

using VertexHandle = OpenMesh::VertexHandle;
using HalfedgeHandle = OpenMesh::HalfedgeHandle;
using FaceHandle = OpenMesh::FaceHandle;

// Lengths that differ by less than this fraction are equal, so that rounding, which depends on the scale of the input,
// does not choose which edge to bisect.
constexpr double kEqual = 1e-9;
// Bisections of an original face, one of a part of a part, until newest-vertex bisection begins.
constexpr std::uint8_t kNewestDepth = 14;
// Bisections of an original face where the rest is left to fitting: few enough that no edge gets too short for that.
constexpr std::uint8_t kShallowDepth = 8;

// Faces whose corners memory is asked for in advance.
constexpr std::size_t kAhead = 8;

MetricNode node_of(const Vector& point, const Vector& n, const Eigen::Matrix3d& m) {
  const double w = normal_weight(m);
  return {point,
          {m(0, 0) + w * n.x() * n.x(), m(1, 1) + w * n.y() * n.y(), m(2, 2) + w * n.z() * n.z(),
           2 * (m(0, 1) + w * n.x() * n.y()), 2 * (m(0, 2) + w * n.x() * n.z()), 2 * (m(1, 2) + w * n.y() * n.z())}};
}

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
      number[h.idx()] = static_cast<std::int32_t>(half_edges.size());
      half_edges.push_back(h.idx());
    }
    flat.corners.push_back(corners);
  }
  for (const std::int32_t h : half_edges) flat.twins.push_back(number[h ^ 1]);
  return flat;
}

}  // namespace

bool keeps_numbers(const Surface& surface) {
  const auto& vertex_of_fan = surface.vertex_of_fan();
  return vertex_of_fan.size() == surface.vertex_count() && surface.half_edges().n_faces() == surface.face_count() &&
         std::adjacent_find(vertex_of_fan.begin(), vertex_of_fan.end()) == vertex_of_fan.end();
}

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
  mesh_ = has_mended_ ? flattened(mesh) : FlatMesh{surface.face_fans(), surface.twins()};
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
  nodes_ = std::make_unique_for_overwrite<MetricNode[]>(fans_);
  for (std::int32_t fan = 0; index(fan) < fans_; ++fan) set_node(fan);
  if (has_mended_) {
    for (std::int32_t f = 0; index(f) < faces_; ++f) {
      if (is_flat(f)) is_flat_origin_[origins_[f]] = true;
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
    for (const VertexHandle corner : v) normals[corner.idx()] += normal;
  }
  for (std::size_t fan = 0; fan < fans_; ++fan) {
    const std::int32_t v = vertex_of_fan_[fan];
    const bool is_shared =
        (fan > 0 && vertex_of_fan_[fan - 1] == v) || (fan + 1 < fans_ && vertex_of_fan_[fan + 1] == v);
    is_turned_[fan] = is_shared && normals[fan].dot(metric_.normals[v]) < 0;
  }
}

void Refinement::set_node(std::int32_t fan) {
  const std::size_t v = index(vertex_of_fan_[fan]);
  nodes_[fan] = node_of(surface_.points()[v], metric_.normals[v], metric_.tensors[v]);
}

TensorAt Refinement::tensor_at(std::int32_t v) const {
  if (index(v) >= fans_) return tensors_[index(v) - fans_];
  const std::size_t i = index(vertex_of_fan_[v]);
  const bool is_turned = !is_turned_.empty() && is_turned_[v];
  return {is_turned ? Vector(-metric_.normals[i]) : metric_.normals[i], metric_.tensors[i]};
}

void Refinement::measure_all() {
  const auto count = static_cast<std::int32_t>(mesh_.twins.size());
  lengths_.resize(mesh_.twins.size());
  for (std::int32_t h = 0; h < count; ++h) {
    if (const std::size_t ahead = index(h / 3) + kAhead; h % 3 == 0 && ahead < mesh_.corners.size()) {
      for (const std::int32_t v : mesh_.corners[ahead]) prefetch(&node(v));
    }
    const std::int32_t twin = mesh_.twins[h];
    lengths_[h] = twin >= 0 && twin < h ? lengths_[twin] : measure(h);
  }
}

std::int32_t Refinement::longest(std::int32_t f) const {
  std::int32_t best = 3 * f;
  for (const std::int32_t h : {3 * f + 1, 3 * f + 2}) {
    if (lengths_[h] > lengths_[best] * (1 + kEqual)) best = h;
  }
  return best;
}

void Refinement::consider(std::int32_t f) {
  if (is_valid(f)) return;
  if (is_flat(f)) {
    has_decayed_ = has_decayed_ || is_flat_origin_.empty() || !is_flat_origin_[origins_[f]];
    return;
  }
  const double p = perimeter(f);
  if (p < options_.sigma) return;
  if (scheme_ == Scheme::kFitAlone || (scheme_ == Scheme::kShallow && depth_[f] >= kShallowDepth)) return;
  if (scheme_ == Scheme::kPropagate && first_newest_ == 0 && depth_[f] >= kNewestDepth) {
    deferred_.push_back(f);
  } else {
    const std::uint64_t place = std::uint64_t(origins_[f]) << 32 | branch_[f];
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
    const Triangle& corners = mesh_.corners[f];
    const auto newest = static_cast<std::int32_t>(std::ranges::max_element(corners) - corners.begin());
    if (index(corners[newest]) >= first_newest_) return next(3 * f + newest);
  }
  const auto key = [&](std::int32_t h) {
    const std::int32_t twin = mesh_.twins[h];
    return std::pair(static_cast<float>(lengths_[h]), twin < 0 ? h : std::min(h, twin));
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
    const std::int32_t h = refinement_edge(chain_.back()), beyond = mesh_.twins[h];
    if (scheme_ != Scheme::kPaper && beyond >= 0 && refinement_edge(beyond / 3) != beyond) {
      chain_.push_back(beyond / 3);
      continue;
    }
    if (faces_added_ + (beyond < 0 ? 1 : 2) > most) return false;
    newest_bisections_ += first_newest_ > 0;
    if (states_.empty() || beyond < 0 || enter(origins_[beyond / 3])) {
      bisect(h);
    } else {
      conflicts_.insert(conflicts_.end(), {origins_[beyond / 3], origins_[h / 3]});
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
  const std::int32_t b = mesh_.tip(h), c = mesh_.tip(h1), outer = mesh_.twins[h1];
  mesh_.corners[f][h1 % 3] = middle;
  mesh_.corners.push_back({middle, b, c});
  mesh_.twins.insert(mesh_.twins.end(), {-1, outer, h1});
  mesh_.twins[h1] = 3 * g + 2;
  if (outer >= 0) mesh_.twins[outer] = 3 * g + 1;
  lengths_.insert(lengths_.end(), {0.0, lengths_[h1], 0.0});
  origins_.push_back(origins_[f]);
  if (depth_[f] < kNewestDepth) ++depth_[f];
  depth_.push_back(depth_[f]);
  // Nodes deeper than 31 have no number left in 32 bits: they are mixed, and seldom equal.
  const std::uint32_t branch = branch_[f];
  const std::uint32_t first = branch < 0x8000'0000U ? 2 * branch : branch * 0x9E37'79B1U | 0x8000'0000U;
  branch_[f] = first;
  branch_.push_back(first ^ 1U);
  ++faces_added_;
}

void Refinement::bisect(std::int32_t h) {
  const std::int32_t a = mesh_.tail(h), b = mesh_.tip(h), o = mesh_.twins[h];
  const auto middle = static_cast<std::int32_t>(fans_ + new_nodes_.size());
  tensors_.push_back(midpoint_tensor(tensor_at(a), tensor_at(b)));
  points_.emplace_back((node(a).point + node(b).point) / 2);
  new_nodes_.push_back(node_of(points_.back(), tensors_.back().normal, tensors_.back().tensor));
  const auto count = static_cast<std::int32_t>(mesh_.corners.size());
  if (watches_unfit_) note_unfit(h, o, false);
  halve(h, middle);
  if (o >= 0) {
    halve(o, middle);
    mesh_.twins[h] = 3 * (count + 1);
    mesh_.twins[3 * (count + 1)] = h;
    mesh_.twins[o] = 3 * count;
    mesh_.twins[3 * count] = o;
  }
  // Edges around the middle: the halves of the old one, and one on each side.
  for (const std::int32_t e : {h, 3 * count, 3 * count + 2}) set_length(e, measure(e));
  if (o >= 0) set_length(3 * (count + 1) + 2, measure(3 * (count + 1) + 2));
  if (watches_unfit_) note_unfit(h, o, true);
  consider(h / 3);
  consider(count);
  if (o >= 0) {
    consider(o / 3);
    consider(count + 1);
  }
}

std::size_t Refinement::count_unfit() const {
  std::size_t count = 0;
  for (std::int32_t f = 0; index(f) < mesh_.corners.size(); ++f) count += is_unfit(f) ? 1 : 0;
  return count;
}

void Refinement::watch_unfit() {
  watches_unfit_ = true;
  unfit_ = least_unfit_ = count_unfit();
  least_unfit_at_ = faces_added_;
}

// Before and after the bisection of the triangle of h, and of that of `beyond`, if it has one.
void Refinement::note_unfit(std::int32_t h, std::int32_t beyond, bool are_new) {
  const auto count = static_cast<std::int32_t>(mesh_.corners.size());
  std::size_t unfit = is_unfit(h / 3) ? 1 : 0;
  if (beyond >= 0) unfit += is_unfit(beyond / 3) ? 1 : 0;
  if (!are_new) {
    unfit_ -= unfit;
    return;
  }
  for (std::int32_t f = beyond < 0 ? count - 1 : count - 2; f < count; ++f) unfit += is_unfit(f) ? 1 : 0;
  unfit_ += unfit;
  if (unfit_ >= least_unfit_) return;
  least_unfit_ = unfit_;
  least_unfit_at_ = faces_added_;
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

Embedding Refinement::result() && {
  Embedding out;
  out.invalid_before = invalid_before_;
  out.faces_added = faces_added_;
  out.hit_cap = hit_cap_;
  out.newest_bisections = newest_bisections_;
  out.clamped_edges = clamped_edges_;
  out.worst_clamp = worst_clamp_;
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
    for (std::int32_t& f : origins_) f = surface_.face_of_half_edge_face()[f];
  }
  // Each edge of holes alone, once.
  const auto is_hole = [&](std::int32_t f) { return std::binary_search(holes.begin(), holes.end(), f); };
  for (const std::int32_t f : holes) {
    for (std::int32_t h = 3 * f; h < 3 * f + 3; ++h) {
      const std::int32_t twin = mesh_.twins[h];
      if (twin >= 0 && (twin < h || !is_hole(twin / 3))) continue;
      mesh.loose_edges.push_back({mesh_.tail(h), mesh_.tip(h), lengths_[h]});
    }
  }
  if (!holes.empty()) {
    std::vector<std::int32_t> moved(index(faces), -1);
    std::int32_t to = 0;
    for (std::int32_t f = 0; f < faces; ++f) {
      if (!is_hole(f)) moved[f] = to++;
    }
    for (std::int32_t f = 0; f < faces; ++f) {
      if (moved[f] < 0) continue;
      const std::size_t g = index(moved[f]);
      mesh_.corners[g] = mesh_.corners[f];
      origins_[g] = origins_[f];
      for (std::size_t i = 0; i < 3; ++i) {
        const std::int32_t twin = mesh_.twins[3 * index(f) + i];
        const std::int32_t beyond = twin < 0 ? -1 : moved[twin / 3];
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
    for (const std::int32_t v : triangle) reached[v] = true;
  }
  for (const LooseEdge& edge : mesh.loose_edges) reached[edge.a] = reached[edge.b] = true;
  std::vector<std::int32_t> out;
  for (const Triangle& triangle : surface_.triangles()) {
    for (const std::int32_t v : triangle) {
      if (reached[v]) continue;
      out.push_back(v);
      reached[v] = true;
    }
  }
  std::sort(out.begin(), out.end());
  return out;
}

}  // namespace seamwire
