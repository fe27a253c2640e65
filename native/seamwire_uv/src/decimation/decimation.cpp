// SPDX-License-Identifier: GPL-3.0-or-later
#include "decimation/decimation.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <set>
#include <tuple>
#include <unordered_map>
#include <utility>

#include "detail/drop_repeats.hpp"
#include "detail/index.hpp"
#include "detail/poll.hpp"
#include "slits/slit_paths.hpp"
#include "slits/slit_plan.hpp"
#include "surface/twins.hpp"
#include "tuning/constants.hpp"

namespace seamwire::detail {
namespace {

/// A quadratic function of a point: the sum of squared distances to planes, weighted.
struct Quadric {
  Eigen::Matrix3d a = Eigen::Matrix3d::Zero();
  Vector b = Vector::Zero();
  double c = 0.0;

  void add_plane(const Vector& normal, const Vector& through, double weight) {
    const double d = -normal.dot(through);
    a += weight * normal * normal.transpose();
    b += weight * d * normal;
    c += weight * d * d;
  }
  Quadric& operator+=(const Quadric& other) {
    a += other.a;
    b += other.b;
    c += other.c;
    return *this;
  }
  double at(const Vector& point) const { return point.dot(a * point) + 2.0 * b.dot(point) + c; }
};

/// The square of the length of a triangle's longest edge.
double longest_square(const std::array<Vector, 3>& corners) {
  const auto& [a, b, c] = corners;
  return std::max({(b - a).squaredNorm(), (c - b).squaredNorm(), (a - c).squaredNorm()});
}

/// A mesh whose edges are being collapsed.
class Collapsing {
 public:
  Collapsing(const PlanMesh& mesh, std::span<const std::uint8_t> is_seam, const Reflection* reflection,
             const Task& task)
      : mesh_(mesh),
        reflection_(reflection != nullptr && reflection->is_exact ? reflection : nullptr),
        triangles_(copied(mesh.triangles, task, 0.0)),
        is_gone_(mesh.face_count(), 0),
        first_corner_(mesh.vertex_count(), -1),
        valences_(mesh.vertex_count(), 0),
        listed_(mesh.vertex_count(), 0),
        version_(mesh.vertex_count(), 0),
        queue_poll_(task),
        left_(mesh.face_count()) {
    resize(next_corner_, 3 * mesh.face_count(), task, 0.0);
    resize(quadrics_, mesh.vertex_count(), task, 0.0);
    const Poll poll(task);
    for (std::int32_t f = 0; index(f) < mesh.face_count(); ++f) {
      poll.at(index(f));
      const FaceFrame frame = face_frame(mesh, triangles_[f]);
      for (std::int32_t i = 0; i < 3; ++i) {
        const std::int32_t v = triangles_[f][i];
        add_corner(v, 3 * f + i);
        quadrics_[v].add_plane(frame.normal, mesh.points[triangles_[f][0]], frame.area);
      }
    }
    for (std::int32_t e = 0; index(e) < mesh.edge_count(); ++e) {
      poll.at(index(e));
      if (is_seam[e] != 0 || mesh.is_boundary(e)) add_feature(mesh.half_edge_of[e]);
    }
    queue_all(poll);
  }

  void run(std::size_t goal, const Task& task) {
    const Poll poll(task, 0.0, 1.0, mesh_.vertex_count(), Poll::kFewSteps);
    for (std::size_t step = 0; left_ > goal && !queue_.empty(); ++step) {
      poll.at(step);
      const Entry entry = queue_.front();
      std::pop_heap(queue_.begin(), queue_.end());
      queue_.pop_back();
      if (!is_valid(entry)) continue;
      collapse_with_image(entry.from, entry.to);
      const Entry back = this->entry(entry.to, entry.from);
      if (is_valid(entry) && back < entry) push(back);
    }
    queue_ = {};  // result() needs memory too
  }

  DecimatedMesh result(const Task& task) const;

 private:
  struct Entry {
    double error = 0.0;
    std::int32_t from = -1, to = -1;
    std::int32_t version = 0;
    bool operator<(const Entry& other) const {  // least error on top, then lesser numbers
      return std::tie(other.error, other.from, other.to) < std::tie(error, from, to);
    }
  };

  void add_feature(std::int32_t half_edge);
  void add_corner(std::int32_t v, std::int32_t corner) {
    next_corner_[corner] = first_corner_[v];
    first_corner_[v] = corner;
    ++valences_[v];
    ++listed_[v];
  }
  /// Takes a removed triangle from a vertex. Its list is put in order when half of it is gone, so a step of a collapse
  /// does not depend on the number of triangles around the vertex.
  void drop_face(std::int32_t v) {
    --valences_[v];
    if (2 * valences_[v] >= listed_[v]) return;
    std::int32_t corner = std::exchange(first_corner_[v], -1);
    valences_[v] = listed_[v] = 0;
    while (corner >= 0) {
      const std::int32_t next = next_corner_[corner];
      if (is_gone_[corner / 3] == 0) add_corner(v, corner);
      corner = next;
    }
  }
  /// Whether a triangle around a vertex fulfills a condition.
  template <class Condition>
  bool any_face(std::int32_t v, const Condition& condition) const {
    for (std::int32_t corner = first_corner_[v]; corner >= 0; corner = next_corner_[corner]) {
      if (is_gone_[corner / 3] == 0 && condition(corner / 3)) return true;
    }
    return false;
  }
  bool has_corner(std::int32_t face, std::int32_t v) const {
    return std::ranges::find(triangles_[face], v) != triangles_[face].end();
  }
  bool are_neighbors(std::int32_t a, std::int32_t b) const {
    if (valences_[b] < valences_[a]) std::swap(a, b);
    return any_face(a, [&](std::int32_t f) { return has_corner(f, b); });
  }
  std::vector<std::int32_t> neighbors(std::int32_t v) const {
    std::vector<std::int32_t> found;
    any_face(v, [&](std::int32_t f) {
      for (const std::int32_t other : triangles_[f]) {
        if (other != v) found.push_back(other);
      }
      return false;
    });
    std::ranges::sort(found);
    drop_repeats(found);
    return found;
  }
  /// The neighbors of a vertex over boundary edges and seams.
  std::span<const std::int32_t> features(std::int32_t v) const {
    const auto found = features_.find(v);
    return found == features_.end() ? std::span<const std::int32_t>() : found->second;
  }
  bool is_feature(std::int32_t a, std::int32_t b) const {
    const std::span<const std::int32_t> of_a = features(a);
    return std::ranges::find(of_a, b) != of_a.end();
  }
  bool may_collapse(std::int32_t from, std::int32_t to) const;
  bool folds(std::int32_t from, std::int32_t to) const;
  void collapse(std::int32_t from, std::int32_t to);
  void collapse_with_image(std::int32_t from, std::int32_t to);
  Entry entry(std::int32_t from, std::int32_t to) const {
    Quadric sum = quadrics_[from];
    sum += quadrics_[to];
    const double error = std::max(sum.at(mesh_.points[to]), 0.0);
    return {error, from, to, version_[from] + version_[to]};
  }
  bool is_valid(const Entry& entry) const { return entry.version == version_[entry.from] + version_[entry.to]; }
  /// The collapse of an edge that comes first. The one in the other direction is queued once this one is not possible.
  Entry better_entry(std::int32_t a, std::int32_t b) const { return std::max(entry(a, b), entry(b, a)); }
  void queue_all(const Poll& poll) {
    // Never more entries are valid than there are edges, so push() seldom sorts out.
    queue_.reserve(mesh_.edge_count() + mesh_.edge_count() / 4 + 64);
    for (std::int32_t v = 0; index(v) < mesh_.vertex_count(); ++v) {
      poll.at(index(v));
      for (const std::int32_t other : neighbors(v)) {
        if (v < other) queue_.push_back(better_entry(v, other));
      }
    }
    make_heap();
  }
  void make_heap() {
    std::make_heap(queue_.begin(), queue_.end(), [&](const Entry& one, const Entry& other) {
      queue_poll_.next();
      return one < other;
    });
  }
  void push(const Entry& entry) {
    if (queue_.size() == queue_.capacity()) {
      // Most entries are of edges that have changed since.
      std::erase_if(queue_, [&](const Entry& old) {
        queue_poll_.next();
        return !is_valid(old);
      });
      make_heap();
    }
    queue_.push_back(entry);
    std::push_heap(queue_.begin(), queue_.end());
  }
  /// Queues the edges of a vertex again.
  void push_all(std::int32_t v) {
    for (const std::int32_t other : neighbors(v)) push(better_entry(v, other));
  }
  std::int32_t image(std::int32_t v) const { return reflection_ != nullptr ? reflection_->images[v] : v; }
  bool is_on_plane(std::int32_t v) const { return reflection_ != nullptr && reflection_->sides[v] == 0; }

  const PlanMesh& mesh_;
  const Reflection* reflection_;
  std::vector<Triangle> triangles_;
  std::vector<std::uint8_t> is_gone_;
  // The corners at each vertex are a list, with some of faces that are gone.
  std::vector<std::int32_t> first_corner_, next_corner_;
  std::vector<std::int32_t> valences_, listed_;  // of each vertex: how many faces it has, and how many are in its list
  std::vector<Quadric> quadrics_;
  std::vector<std::int32_t> version_;
  std::unordered_map<std::int32_t, std::vector<std::int32_t>> features_;  // see features()
  std::vector<Entry> queue_;                                              // a heap
  Poll queue_poll_;
  std::size_t left_;
};

/// Notes that an edge has to stay on the boundary or a seam.
void Collapsing::add_feature(std::int32_t half_edge) {
  constexpr double kFeatureWeight = 10.0;  // of planes through boundaries and seams
  const std::int32_t a = mesh_.tail(half_edge), b = mesh_.tip(half_edge);
  features_[a].push_back(b);
  features_[b].push_back(a);
  const Vector along = mesh_.points[b] - mesh_.points[a];
  const Vector across = along.cross(face_frame(mesh_, mesh_.triangles[half_edge / 3]).normal);
  const double size = across.norm();
  if (!(size > 0.0)) return;
  for (const std::int32_t v : {a, b}) {
    quadrics_[v].add_plane(across / size, mesh_.points[a], kFeatureWeight * along.squaredNorm());
  }
}

/// Whether the topology allows it, and features and the mirror plane stay.
bool Collapsing::may_collapse(std::int32_t from, std::int32_t to) const {
  constexpr std::int32_t kMostMoved = 64, kFewFaces = 6;  // vertices with more faces have more than three neighbors
  if (is_on_plane(from) && !is_on_plane(to)) return false;
  const bool is_at_feature = !features(from).empty();
  if (is_at_feature && (features(from).size() != 2 || !is_feature(from, to))) return false;
  // Vertices with many triangles stay, and get no more of them: each collapse there takes long.
  if (valences_[from] > kMostMoved || valences_[to] > kMostMoved) return false;
  std::size_t shared = 0;
  any_face(from, [&](std::int32_t f) {
    if (has_corner(f, to)) ++shared;
    return false;
  });
  if (shared == 0) return false;
  std::vector<std::int32_t> common = neighbors(from);
  std::erase_if(common, [&](std::int32_t v) { return v == to || !are_neighbors(v, to); });
  // Link condition: the ends have only the corners of the edge's triangles in common.
  if (common.size() != shared) return false;
  // A feature may not be folded onto another one.
  if (std::ranges::any_of(common, [&](std::int32_t v) { return is_feature(from, v) && is_feature(to, v); }))
    return false;
  if (!is_at_feature && std::ranges::any_of(common, [&](std::int32_t v) {
        return valences_[v] <= kFewFaces && neighbors(v).size() <= 3;
      })) {
    return false;
  }
  return !folds(from, to);
}

/// Whether a triangle would turn over, or become needle-thin and thinner than it is.
bool Collapsing::folds(std::int32_t from, std::int32_t to) const {
  constexpr double kLeastCosine = 0.2, kLeastShape = 0.02;
  return any_face(from, [&](std::int32_t f) {
    const Triangle& t = triangles_[f];
    if (has_corner(f, to)) return false;
    std::array<Vector, 3> before, after;
    for (std::size_t i = 0; i < 3; ++i) {
      before[i] = mesh_.points[t[i]];
      after[i] = t[i] == from ? mesh_.points[to] : before[i];
    }
    const Vector was = (before[1] - before[0]).cross(before[2] - before[0]);
    const Vector is = (after[1] - after[0]).cross(after[2] - after[0]);
    const bool is_thin = is.norm() <= kLeastShape * longest_square(after);
    const bool is_thinner = is.norm() * longest_square(before) <= was.norm() * longest_square(after);
    return (is_thin && is_thinner) || was.dot(is) < kLeastCosine * was.norm() * is.norm();
  });
}

void Collapsing::collapse(std::int32_t from, std::int32_t to) {
  for (std::int32_t corner = std::exchange(first_corner_[from], -1); corner >= 0;) {
    const std::int32_t f = corner / 3, next = next_corner_[corner];
    Triangle& t = triangles_[f];
    if (is_gone_[f] == 0 && has_corner(f, to)) {
      is_gone_[f] = 1;
      --left_;
      for (const std::int32_t v : t) {
        if (v != from) drop_face(v);
      }
    } else if (is_gone_[f] == 0) {
      t[corner % 3] = to;
      add_corner(to, corner);
    }
    corner = next;
  }
  valences_[from] = listed_[from] = 0;
  if (const auto found = features_.extract(from)) {
    for (const std::int32_t other : found.mapped()) {
      std::erase(features_[other], from);
      if (other == to) continue;
      features_[other].push_back(to);
      features_[to].push_back(other);
    }
  }
  quadrics_[to] += quadrics_[from];
  ++version_[to];
  ++version_[from];
}

/// Collapses an edge and its mirror image, or neither.
void Collapsing::collapse_with_image(std::int32_t from, std::int32_t to) {
  if (valences_[from] == 0 || valences_[to] == 0 || !may_collapse(from, to)) return;
  const std::int32_t from_image = image(from), to_image = image(to);
  if (reflection_ == nullptr || from_image == from) {
    collapse(from, to);
    push_all(to);
    return;
  }
  if (from_image < 0 || to_image < 0 || valences_[from_image] == 0 || valences_[to_image] == 0) return;
  // The neighborhoods have to be apart: else one collapse changes what the other was checked for.
  const auto has_few = [&](std::int32_t v) { return neighbors(v).size() < 5; };
  if (are_neighbors(from, from_image) || (to == to_image && (has_few(from) || has_few(from_image)))) return;
  if (!may_collapse(from_image, to_image)) return;
  collapse(from, to);
  if (may_collapse(from_image, to_image)) collapse(from_image, to_image);
  push_all(to);
  if (to_image != to) push_all(to_image);
}

DecimatedMesh Collapsing::result(const Task& task) const {
  DecimatedMesh out;
  std::vector<std::int32_t> number(mesh_.vertex_count(), -1);
  for (std::int32_t v = 0; index(v) < mesh_.vertex_count(); ++v) {
    if (valences_[v] == 0) continue;
    number[v] = static_cast<std::int32_t>(out.vertices.size());
    out.vertices.push_back(v);
    out.mesh.points.push_back(mesh_.points[v]);
    out.mesh.sources.push_back(mesh_.sources[v]);
  }
  for (std::size_t f = 0; f < triangles_.size(); ++f) {
    if (is_gone_[f] != 0) continue;
    const Triangle& t = triangles_[f];
    out.mesh.triangles.push_back({number[t[0]], number[t[1]], number[t[2]]});
  }
  out.mesh.twins = twins_of(out.mesh.triangles, half_edges_by_edge(out.mesh.triangles));
  out.mesh.scale = mesh_.scale;
  connect(out.mesh, std::nullopt, task);
  for (const std::int32_t h : out.mesh.half_edge_of) {
    const bool is_inner = out.mesh.twins[h] >= 0;
    const std::int32_t a = out.vertices[out.mesh.tail(h)], b = out.vertices[out.mesh.tip(h)];
    out.is_seam.push_back(is_inner && is_feature(a, b) ? 1 : 0);
  }
  return out;
}

}  // namespace

DecimatedMesh decimate(const PlanMesh& mesh, std::span<const std::uint8_t> is_seam, const Reflection* reflection,
                       std::size_t triangles, const Task& task) {
  Collapsing collapsing(mesh, is_seam, reflection, task);
  collapsing.run(triangles, task);
  return collapsing.result(task);
}

namespace {

class Carrying {
 public:
  Carrying(const SlitProblem& simple, std::span<const std::int32_t> vertices, const SlitProblem& original,
           std::span<const Slit> slits, const Task& task)
      : simple_(simple),
        vertices_(vertices),
        original_(original),
        task_(task),
        spread_(simple.mesh->median_length),
        is_on_cut_(cut_of(original, {}, {}).is_on_cut) {
    for (const Slit& slit : slits) {
      for (const auto* chain : {&slit.path, &slit.image}) {
        if (!chain->empty()) starts_.insert(chain->front());
      }
    }
  }

  std::optional<Slit> carried(const Slit& slit) {
    Slit found{.path = chain(slit.path), .image = {}, .is_needed = slit.is_needed, .is_join = slit.is_join};
    if (found.path.size() < 2) return std::nullopt;
    if (!slit.image.empty() && original_.reflection && original_.reflection->is_exact) {
      found.image = mirrored_path(original_, found.path, is_on_cut_, task_);
    }
    occupy(found.path);
    if (!slit.image.empty() && found.image.empty()) found.image = chain(slit.image);
    occupy(found.image);
    return found;
  }

 private:
  void occupy(std::span<const std::int32_t> chain) {
    for (const std::int32_t v : chain) is_on_cut_[v] = 1;
  }

  /// Whether a part of a path is so bent that a chain near it might cut it short, as a loop around a handle is.
  bool is_bent(std::span<const std::int32_t> path) const {
    const Vector across = simple_.mesh->points[path.back()] - simple_.mesh->points[path.front()];
    return chain_length(*simple_.mesh, path) > tuning::kBent * across.norm();
  }

  /// Section by section, each to the next vertex at which another slit starts, or less where the path is bent.
  std::vector<std::int32_t> chain(std::span<const std::int32_t> path) const {
    std::vector<std::int32_t> whole;
    std::vector<std::uint8_t> barred = is_on_cut_;
    for (std::size_t begin = 0; begin + 1 < path.size();) {
      std::size_t end = begin + 1;
      while (end + 1 < path.size() && !starts_.contains(path[end])) ++end;
      while (end > begin + 1 && is_bent(path.subspan(begin, end - begin + 1))) end = begin + (end - begin + 1) / 2;
      const std::vector<std::int32_t> part = section(path.subspan(begin, end - begin + 1), barred);
      if (part.size() < 2) return {};
      // What came before is of no use if this section starts elsewhere on the cut.
      if (!whole.empty() && part.front() != whole.back()) whole.clear();
      whole.insert(whole.end(), part.begin() + (whole.empty() ? 0 : 1), part.end());
      for (const std::int32_t v : part) barred[v] = 1;
      begin = end;
    }
    return whole;
  }

  /// The chain of the original's edges along a part of a path. If other slits are in its way, it starts at the last
  /// one.
  std::vector<std::int32_t> section(std::span<const std::int32_t> path, std::span<const std::uint8_t> barred) const {
    std::vector<Vector> line;
    for (const std::int32_t v : path) line.push_back(simple_.mesh->points[v]);
    const std::int32_t from = vertices_[path.front()], to = vertices_[path.back()];
    const auto along = [&](std::span<const std::uint8_t> without) {
      return chain_along(*original_.mesh, line, spread_, from, to, without, original_.prices, task_);
    };
    std::vector<std::int32_t> chain = along(barred);
    if (!chain.empty() && chain_length(*original_.mesh, chain) < tuning::kDetour * chain_length(*simple_.mesh, path))
      return chain;
    chain = along(std::vector<std::uint8_t>(barred.size(), 0));
    for (std::size_t i = chain.size(); i-- > 1;) {
      if (barred[chain[i - 1]] == 0) continue;
      chain.erase(chain.begin(), chain.begin() + static_cast<std::ptrdiff_t>(i) - 1);
      break;
    }
    return chain;
  }

  const SlitProblem& simple_;
  std::span<const std::int32_t> vertices_;
  const SlitProblem& original_;
  const Task& task_;
  double spread_;
  std::vector<std::uint8_t> is_on_cut_;
  std::set<std::int32_t> starts_;
};

}  // namespace

std::vector<Slit> carried_slits(const SlitProblem& simple, std::span<const std::int32_t> vertices,
                                const SlitProblem& original, std::span<const Slit> slits, const Task& task) {
  Carrying carrying(simple, vertices, original, slits, task);
  std::vector<Slit> carried;
  for (const Slit& slit : slits) {
    std::optional<Slit> one = carrying.carried(slit);
    if (one) carried.push_back(std::move(*one));
  }
  return carried;
}

}  // namespace seamwire::detail
