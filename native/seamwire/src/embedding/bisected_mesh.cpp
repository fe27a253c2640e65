// SPDX-License-Identifier: GPL-3.0-or-later
#include "embedding/bisected_mesh.hpp"

#include <Eigen/Geometry>
#include <numeric>
#include <tuple>
#include <utility>

#include "detail/drop_repeats.hpp"
#include "detail/half_edge.hpp"
#include "detail/poll.hpp"
#include "detail/prefetch.hpp"
#include "embedding/degenerate_faces.hpp"
#include "metric/tangent_frame.hpp"
#include "surface/corner_fans.hpp"
#include "surface/face_height.hpp"

namespace seamwire::detail {
namespace {

// A length in a metric that differs from the one in space by this fraction or less does so by rounding.
constexpr double kSameLength = 1e-12;

// Faces whose corners memory is asked for in advance.
constexpr std::size_t kAhead = 8;

// For each half-edge, the next one in its cycle that is left, -1 if there is no other. `moved`: the new number of each,
// -1 for those that are not left; `next` is in the old numbers, the result in the new ones.
std::vector<std::int32_t> left_of_cycles(const std::vector<std::int32_t>& next, const std::vector<std::int32_t>& moved,
                                         std::size_t count) {
  std::vector<std::int32_t> left(next.empty() ? 0 : count, -1);
  for (std::int32_t h = 0; index(h) < next.size(); ++h) {
    if (moved[h] < 0 || next[h] < 0) continue;
    std::int32_t other = next[h];
    while (moved[other] < 0) other = next[other];
    if (other != h) left[moved[h]] = moved[other];
  }
  return left;
}

}  // namespace

bool are_lengths_of(const double* lengths, const std::array<Vector, 3>& sides) {
  for (std::size_t i = 0; i < 3; ++i) {
    const double in_space = sides[i].norm();
    if (!(std::abs(lengths[i] - in_space) <= kSameLength * in_space)) return false;
  }
  return has_area(sides[0], sides[1], sides[2]);
}

bool keeps_numbers(const Surface& surface) {
  const auto& vertex_of_fan = corner_fans(surface).vertices;
  return vertex_of_fan.size() == surface.vertex_count() && corner_fans(surface).face_count() == surface.face_count() &&
         std::adjacent_find(vertex_of_fan.begin(), vertex_of_fan.end()) == vertex_of_fan.end();
}

EmbeddingInput::EmbeddingInput(const Surface& on, const Metric& by, const EmbedOptions& with)
    : surface(on), metric(by), options(with) {
  if (!options.faces) return;
  std::vector<std::int32_t> selected = *options.faces;
  for (const std::int32_t face : selected) check_index(face, surface.face_count(), "faces: face", "faces");
  std::ranges::sort(selected);
  drop_repeats(selected);
  faces = half_edge_faces(surface, selected);
  callers_faces = std::move(selected);
}

BisectedMesh::BisectedMesh(const EmbeddingInput& input, const Task& task, double progress, EdgeRule rule)
    : surface(input.surface),
      metric(input.metric),
      unit_(exact_unit(input.surface)),
      rule_(rule),
      callers_faces_(input.callers_faces),
      vertex_of_fan_(corner_fans(surface).vertices),
      points_(copied(surface.points(), task, progress)) {
  take_faces(input, task, progress);
  fans_ = vertex_of_fan_.size();
  given_faces_ = triangles.size();
  orient_normals();
  branches.assign(given_faces_, 1);
  depths.assign(given_faces_, 0);
  nodes_ = std::make_unique_for_overwrite<MetricNode[]>(fans_);
  const Poll poll(task, progress, progress, fans_);
  for (std::int32_t fan = 0; index(fan) < fans_; ++fan) {
    poll.at(index(fan));
    set_node(fan);
  }
  if (cleaned_) {
    is_degenerate_origin_.assign(corner_fans(surface).triangles.size(), false);
    for (std::int32_t f = 0; index(f) < given_faces_; ++f) {
      if (is_degenerate(f)) is_degenerate_origin_[origins[f]] = true;
    }
  }
  measure_all(task, progress);
  if (input.options.mean_edge_length > 0) mean_edge_length_ = input.options.mean_edge_length * unit_;
}

// The triangles, before any bisection.
void BisectedMesh::take_faces(const EmbeddingInput& input, const Task& task, double progress) {
  const std::vector<std::int32_t> zero_area = half_edge_faces(surface, surface.report().zero_area_faces);
  const auto has_area = [&](std::int32_t f) { return !std::ranges::binary_search(zero_area, f); };
  if (!input.faces || !std::ranges::all_of(*input.faces, has_area)) {
    cleaned_ = cleaned_fans(surface, part_of(task, progress, progress));
  }
  if (cleaned_) {
    vertex_of_fan_ = cleaned_->vertices;
    for (const auto& [from, to] : cleaned_->merged)
      merged_.push_back({from, to, edge_length(surface, metric, from, to)});
    const auto is_embedded = [&](std::int32_t f) {
      return !input.faces || std::ranges::binary_search(*input.faces, f);
    };
    const auto removed =
        std::ranges::count_if(zero_area, is_embedded) - std::ranges::count_if(cleaned_->degenerate, is_embedded);
    degenerate_faces_removed = static_cast<std::size_t>(std::max<std::ptrdiff_t>(0, removed));
    if (!input.faces) {
      take_all(*cleaned_, task, progress);
      origins = copied(cleaned_->origins, task, progress);
      return;
    }
    std::vector<std::int32_t> selected;
    for (const std::int32_t f : *input.faces) {
      const auto first = std::ranges::lower_bound(cleaned_->by_origin, std::pair(f, 0));
      for (auto at = first; at != cleaned_->by_origin.end() && at->first == f; ++at) selected.push_back(at->second);
    }
    std::ranges::sort(selected);
    select(*cleaned_, selected);
    for (const std::int32_t f : selected) origins.push_back(cleaned_->origins[f]);
  } else if (input.faces) {
    select(corner_fans(surface), *input.faces);
    origins = *input.faces;
  } else {
    take_all(corner_fans(surface), task, progress);
    origins.resize(triangles.size());
    std::iota(origins.begin(), origins.end(), 0);
  }
}

void BisectedMesh::take_all(const TriangleConnectivity& all, const Task& task, double progress) {
  triangles = copied(all.triangles, task, progress);
  twins = copied(all.twins, task, progress);
  siblings = copied(all.siblings, task, progress);
}

// Makes half-edges of one edge siblings.
void BisectedMesh::link(const std::vector<std::int32_t>& cycle) {
  for (std::size_t i = 0; i < cycle.size(); ++i) {
    siblings[cycle[i]] = cycle.size() == 1 ? -1 : cycle[(i + 1) % cycle.size()];
  }
}

// Takes some of all triangles, by ascending numbers, and numbers them and their corner fans from 0 on.
void BisectedMesh::select(const TriangleConnectivity& all, const std::vector<std::int32_t>& faces) {
  for (const std::int32_t f : faces) {
    selected_fans_.insert(selected_fans_.end(), all.triangles[f].begin(), all.triangles[f].end());
  }
  std::ranges::sort(selected_fans_);
  drop_repeats(selected_fans_);
  const auto place = [](const std::vector<std::int32_t>& in, std::int32_t number) {
    const auto at = std::ranges::lower_bound(in, number);
    return at != in.end() && *at == number ? static_cast<std::int32_t>(at - in.begin()) : -1;
  };
  for (const std::int32_t f : faces) {
    Triangle& triangle = triangles.emplace_back(all.triangles[f]);
    for (std::int32_t& fan : triangle) fan = place(selected_fans_, fan);
    for (std::int32_t h = 3 * f; h < 3 * f + 3; ++h) {
      const std::int32_t twin = all.twins[h], beyond = twin < 0 ? -1 : place(faces, twin / 3);
      twins.push_back(beyond < 0 ? -1 : 3 * beyond + twin % 3);
    }
  }
  if (!all.siblings.empty()) {
    siblings.assign(twins.size(), -1);
    for (std::int32_t h = 0; index(h) < siblings.size(); ++h) {
      const std::int32_t first = 3 * faces[h / 3] + h % 3;
      for (std::int32_t s = all.siblings[first]; s >= 0 && s != first; s = all.siblings[s]) {
        const std::int32_t face = place(faces, s / 3);
        if (face < 0) continue;
        siblings[h] = 3 * face + s % 3;
        break;
      }
    }
  }
  for (const std::int32_t fan : selected_fans_) vertex_of_selected_.push_back(vertex_of_fan_[fan]);
  vertex_of_fan_ = vertex_of_selected_;
}

BisectedMesh::BisectedMesh(const Surface& on, const Metric& by, const Embedding& old, const Task& task)
    : TriangleConnectivity{.triangles = copied(old.mesh.triangles, task, 0.0),
                           .twins = copied(old.mesh.twins, task, 0.0),
                           .siblings = copied(old.mesh.siblings, task, 0.0)},
      surface(on),
      metric(by),
      lengths(copied(old.mesh.lengths, task, 0.0)),
      origins(copied(old.source_face, task, 0.0)),
      branches(triangles.size(), 1),
      depths(triangles.size(), 0),
      unit_(exact_unit(on)),
      vertex_of_fan_(corner_fans(on).vertices),
      fans_(vertex_of_fan_.size()),
      given_faces_(on.face_count()),
      nodes_(std::make_unique_for_overwrite<MetricNode[]>(fans_)),
      new_nodes_(old.points.size() - fans_),
      tensors_(new_nodes_.size()),
      points_(copied(old.points, task, 0.0)),
      mean_edge_length_(old.mean_edge_length * unit_) {
  for (double& length : lengths) length *= unit_;
}

BisectedMesh::MetricNode BisectedMesh::node_of(const Vector& point, const Vector& n, const Eigen::Matrix3d& m) {
  const double w = normal_weight(m);
  return {point,
          {m(0, 0) + w * n.x() * n.x(), m(1, 1) + w * n.y() * n.y(), m(2, 2) + w * n.z() * n.z(),
           2 * (m(0, 1) + w * n.x() * n.y()), 2 * (m(0, 2) + w * n.x() * n.z()), 2 * (m(1, 2) + w * n.y() * n.z())}};
}

// A vertex has one normal, but its fans need not agree on which side of the surface is outside: where a one-sided
// surface is cut they cannot. Normals in the middle of edges are means, so they must be of one side.
void BisectedMesh::orient_normals() {
  const std::vector<std::int32_t>& all = corner_fans(surface).vertices;
  const auto is_shared = [&](std::size_t fan) {
    const std::size_t i = callers_faces_ ? index(selected_fans_[fan]) : fan;
    return (i > 0 && all[i - 1] == all[i]) || (i + 1 < all.size() && all[i + 1] == all[i]);  // ascending
  };
  bool any = false;
  for (std::size_t fan = 0; fan < fans_ && !any; ++fan) any = is_shared(fan);
  if (!any) return;
  is_turned_.assign(fans_, false);
  std::vector<Vector> normals(fans_, Vector::Zero());
  for (const Triangle& fans : triangles) {
    const auto point = [&](std::size_t i) -> const Vector& { return surface.points()[vertex_of_fan_[fans[i]]]; };
    const Vector normal = (point(1) - point(0)).cross(point(2) - point(0));
    for (const std::int32_t fan : fans) normals[fan] += normal;
  }
  for (std::size_t fan = 0; fan < fans_; ++fan) {
    is_turned_[fan] = is_shared(fan) && normals[fan].dot(metric.normals[vertex_of_fan_[fan]]) < 0;
  }
}

void BisectedMesh::set_node(std::int32_t fan) {
  const std::size_t v = index(vertex_of_fan_[fan]);
  nodes_[fan] = node_of(surface.points()[v], metric.normals[v], metric.tensors[v]);
}

Vector BisectedMesh::normal(std::int32_t v) const {
  if (index(v) >= fans_) return tensors_[index(v) - fans_].normal;
  const Vector& n = metric.normals[vertex_of_fan_[v]];
  return !is_turned_.empty() && is_turned_[v] ? Vector(-n) : n;
}

TensorAt BisectedMesh::tensor_at(std::int32_t v) const {
  if (index(v) >= fans_) return tensors_[index(v) - fans_];
  return {normal(v), metric.tensors[vertex_of_fan_[v]]};
}

// That of the mean of the forms at the edge's ends, each turned by the least rotation onto the middle's normal. Instead
// of the form the edge is turned, the other way.
double BisectedMesh::norm_in_middle(std::int32_t h, const Vector& e) const {
  const std::pair<Vector, Vector> normals = end_normals(h);
  const Vector &a = normals.first, &b = normals.second, sum = a + b;
  const double length = sum.norm();
  if (a.isZero(0) || b.isZero(0) || length * length < 2 * kOppositeNormals) return ambient_norm(midpoint(h), e);
  const Vector n = sum / length;
  const double out = e.dot(n), c = 1 + length / 2;  // 1 + a.n, and 1 + b.n
  const auto turned = [&](const Vector& to) { return Vector(e - e.dot(n + to) / c * (n + to) + 2 * out * to); };
  const double at_a = node(tail(h)).norm(turned(a)), at_b = node(tip(h)).norm(turned(b));
  return std::sqrt((at_a * at_a + at_b * at_b) / 2);
}

double BisectedMesh::measure_with_middle(std::int32_t h) const {
  const MetricNode &a = node(tail(h)), &b = node(tip(h));
  const Vector e = (b.point - a.point) * unit_;
  const double at_a = a.norm(e), at_b = b.norm(e);
  const double middle = norm_in_middle(h, e);
  const double halves = (integrated_length(at_a, middle) + integrated_length(middle, at_b)) / 2;
  return (4 * halves - integrated_length(at_a, at_b)) / 3;
}

void BisectedMesh::measure_all(const Task& task, double progress) {
  const auto count = static_cast<std::int32_t>(twins.size());
  resize(lengths, twins.size(), task, progress);
  const Poll poll(task, progress, progress, twins.size());
  double sum = 0;
  std::size_t edges = 0;
  for (std::int32_t h = 0; h < count; ++h) {
    poll.at(index(h));
    if (const std::size_t ahead = index(h / 3) + kAhead; h % 3 == 0 && ahead < triangles.size()) {
      for (const std::int32_t v : triangles[ahead]) prefetch(&node(v));
    }
    if (const std::int32_t first = first_of_edge(*this, h); first < h) {
      lengths[h] = lengths[first];
    } else {
      lengths[h] = measure(h);
      sum += lengths[h];
      ++edges;
    }
  }
  mean_edge_length_ = edges == 0 ? 0.0 : sum / static_cast<double>(edges);
}

bool BisectedMesh::is_as_in_space(std::int32_t f) const {
  return are_lengths_of(&lengths[3 * index(f)], {vector(3 * f), vector(3 * f + 1), vector(3 * f + 2)});
}

bool BisectedMesh::is_degenerate(std::int32_t f) const {
  return !has_area(vector(3 * f), vector(3 * f + 1), vector(3 * f + 2));
}

std::int32_t BisectedMesh::external_vertex(std::int32_t v) const {
  if (index(v) < fans_) return vertex_of_fan_[v];
  const std::size_t i = index(v) - fans_;
  return static_cast<std::int32_t>(surface.vertex_count() + (number_of_new_.empty() ? i : index(number_of_new_[i])));
}

// The triangle of a half-edge from a to b keeps its half at a; that at b becomes a new triangle, whose first half-edge
// runs from the middle to b.
void BisectedMesh::halve(std::int32_t h, std::int32_t middle) {
  const std::int32_t f = h / 3, h1 = next_in_face(h);
  const auto g = static_cast<std::int32_t>(triangles.size());
  const std::int32_t b = tip(h), c = tip(h1), outer = twins[h1];
  triangles[f][h1 % 3] = middle;
  triangles.push_back({middle, b, c});
  twins.insert(twins.end(), {-1, outer, h1});
  twins[h1] = 3 * g + 2;
  if (outer >= 0) twins[outer] = 3 * g + 1;
  if (!siblings.empty()) {
    siblings.insert(siblings.end(), {-1, siblings[h1], -1});
    if (has_siblings(h1)) {
      std::int32_t before = h1;
      while (siblings[before] != h1) before = siblings[before];
      siblings[before] = 3 * g + 1;
      siblings[h1] = -1;
    }
  }
  lengths.insert(lengths.end(), {0.0, lengths[h1], 0.0});
  origins.push_back(origins[f]);
  if (depths[f] < kMostDepth) ++depths[f];
  depths.push_back(depths[f]);
  // Nodes deeper than 31 have no number left in 32 bits: they are mixed, and seldom equal.
  const std::uint32_t branch = branches[f];
  const std::uint32_t first = branch < 0x8000'0000U ? 2 * branch : branch * 0x9E37'79B1U | 0x8000'0000U;
  branches[f] = first;
  branches.push_back(first ^ 1U);
}

// The normals at the ends of an edge. Faces at an edge with siblings need not agree on the sides of these: then they
// are taken to be within a right angle of each other.
std::pair<Vector, Vector> BisectedMesh::end_normals(std::int32_t h) const {
  const Vector a = normal(tail(h)), b = normal(tip(h));
  if (!has_siblings(h) || a.dot(b) >= 0) return {a, b};
  bool all_agree = true;
  for_each_beyond(h, [&](std::int32_t s) { all_agree = all_agree && normal(tail(s)).dot(normal(tip(s))) < 0; });
  return {a, all_agree ? b : Vector(-b)};
}

// The tensor in the middle of an edge.
TensorAt BisectedMesh::midpoint(std::int32_t h) const {
  const auto [a, b] = end_normals(h);
  return midpoint_tensor({a, tensor_at(tail(h)).tensor}, {b, tensor_at(tip(h)).tensor});
}

// Each triangle gets a separate middle, with the normal on that side.
void BisectedMesh::bisect_siblings(std::int32_t h) {
  std::vector<std::int32_t> sides{h}, at_start, at_end;
  for_each_beyond(h, [&](std::int32_t other) { sides.push_back(other); });
  const TensorAt middle = midpoint(h);
  const auto count = static_cast<std::int32_t>(triangles.size());
  const std::int32_t start = external_vertex(tail(h));
  const auto number = static_cast<std::int32_t>(points_.size() - surface.vertex_count());
  points_.emplace_back((node(tail(h)).point + node(tip(h)).point) / 2);
  for (const std::int32_t side : sides) {
    const Vector outside = tensor_at(tail(side)).normal + tensor_at(tip(side)).normal;
    const auto own = static_cast<std::int32_t>(vertex_count());
    tensors_.push_back({outside.dot(middle.normal) < 0 ? Vector(-middle.normal) : middle.normal, middle.tensor});
    new_nodes_.push_back(node_of(points_.back(), middle.normal, middle.tensor));
    number_of_new_.push_back(number);
    const bool is_from_start = external_vertex(tail(side)) == start;
    const auto half = static_cast<std::int32_t>(3 * triangles.size());
    halve(side, own);
    (is_from_start ? at_start : at_end).push_back(side);
    (is_from_start ? at_end : at_start).push_back(half);
  }
  link(at_start);
  link(at_end);
  for (const std::int32_t half : {h, 3 * count}) set_length(half, measure(half));
  for (std::int32_t g = count; index(g) < triangles.size(); ++g) set_length(3 * g + 2, measure(3 * g + 2));
}

void BisectedMesh::bisect(std::int32_t h) {
  if (has_siblings(h)) return bisect_siblings(h);
  const std::int32_t o = twins[h];
  const auto middle = static_cast<std::int32_t>(vertex_count());
  tensors_.push_back(midpoint(h));
  if (!siblings.empty()) number_of_new_.push_back(static_cast<std::int32_t>(points_.size() - surface.vertex_count()));
  points_.emplace_back((node(tail(h)).point + node(tip(h)).point) / 2);
  new_nodes_.push_back(node_of(points_.back(), tensors_.back().normal, tensors_.back().tensor));
  const auto half = static_cast<std::int32_t>(3 * triangles.size());  // from the middle to b
  const std::int32_t beyond_half = half + 3;                          // from the middle to a, if there is a triangle
  halve(h, middle);
  if (o >= 0) {
    halve(o, middle);
    twins[h] = beyond_half;
    twins[beyond_half] = h;
    twins[o] = half;
    twins[half] = o;
  }
  // Edges around the middle: the halves of the old one, and one on each side.
  for (const std::int32_t e : {h, half, half + 2}) set_length(e, measure(e));
  if (o >= 0) set_length(beyond_half + 2, measure(beyond_half + 2));
}

std::vector<std::int32_t> BisectedMesh::undo(const std::vector<std::int32_t>& seeds) {
  // The parts of each face but the first: of a face the last one made, and of a part the one before it.
  std::vector<std::int32_t> last_part(given_faces_, -1), part_before(origins.size() - given_faces_);
  for (std::size_t f = given_faces_; f < origins.size(); ++f) {
    part_before[f - given_faces_] = std::exchange(last_part[origins[f]], static_cast<std::int32_t>(f));
  }

  struct Outer {
    std::int32_t inside, outside;
  };
  std::vector<Outer> sides;  // every unbisected side of a face to undo, and what is beyond it
  std::vector<bool> is_undone(given_faces_, false);
  std::vector<std::int32_t> faces;
  const auto add = [&](std::int32_t face) {
    if (!is_undone[face]) faces.push_back(face);
    is_undone[face] = true;
  };
  for (const std::int32_t face : seeds) add(face);
  for (std::size_t done = 0; done < faces.size();) {  // add() makes it grow
    const std::int32_t face = faces[done++];
    const Triangle& given = corner_fans(surface).triangles[face];
    std::array<std::int32_t, 3> whole{-1, -1, -1};
    const auto look = [&](std::int32_t part) {
      for (std::int32_t h = 3 * part; h < 3 * part + 3; ++h) {
        for (std::size_t side = 0; side < 3; ++side) {
          if (tail(h) == given[side] && tip(h) == given[(side + 1) % 3]) {
            whole[side] = h;
          }
        }
      }
    };
    look(face);
    for (std::int32_t part = last_part[face]; part >= 0; part = part_before[index(part) - given_faces_]) look(part);
    for (std::size_t side = 0; side < 3; ++side) {
      if (whole[side] >= 0) {
        sides.push_back({3 * face + static_cast<std::int32_t>(side), twins[whole[side]]});
      } else if (const std::int32_t twin = corner_fans(surface).twins[3 * index(face) + side]; twin >= 0) {
        add(twin / 3);
      }
    }
  }
  std::erase_if(sides, [&](const Outer& side) { return side.outside < 0 || is_undone[origins[side.outside / 3]]; });
  for (const std::int32_t face : faces) {
    triangles[face] = corner_fans(surface).triangles[face];
    std::copy_n(corner_fans(surface).twins.begin() + std::ptrdiff_t{3} * face, 3,
                twins.begin() + std::ptrdiff_t{3} * face);
    branches[face] = 1;
    depths[face] = 0;
  }
  for (const auto& [inside, outside] : sides) {
    twins[inside] = outside;
    twins[outside] = inside;
  }
  remove_parts(is_undone);
  remove_unused_vertices();
  return faces;
}

// Removes the triangles, but the first ones, of some faces of the surface. The last of the others take their numbers,
// so that most keep theirs.
void BisectedMesh::remove_parts(const std::vector<bool>& is_undone) {
  std::size_t end = origins.size();
  const auto drop_last = [&] {
    while (end > given_faces_ && is_undone[origins[end - 1]]) --end;
  };
  drop_last();
  for (std::size_t to = given_faces_; to < end; ++to) {
    if (!is_undone[origins[to]]) continue;
    const std::size_t f = --end;
    triangles[to] = triangles[f];
    origins[to] = origins[f];
    branches[to] = branches[f];
    depths[to] = depths[f];
    for (std::size_t i = 0; i < 3; ++i) {
      lengths[3 * to + i] = lengths[3 * f + i];
      const std::int32_t twin = twins[3 * f + i];
      twins[3 * to + i] = twin;
      if (twin >= 0) twins[twin] = static_cast<std::int32_t>(3 * to + i);
    }
    drop_last();
  }
  triangles.resize(end);
  twins.resize(3 * end);
  lengths.resize(3 * end);
  origins.resize(end);
  branches.resize(end);
  depths.resize(end);
}

// The last ones that are used take the numbers of those that are not.
void BisectedMesh::remove_unused_vertices() {
  std::vector<std::int32_t> kept;  // all triangles of bisected faces; the first part of a face has the face's number
  std::vector<bool> has_parts(given_faces_, false);
  for (std::size_t f = given_faces_; f < origins.size(); ++f) {
    kept.push_back(static_cast<std::int32_t>(f));
    if (!has_parts[origins[f]]) kept.push_back(origins[f]);
    has_parts[origins[f]] = true;
  }
  std::vector<std::int32_t> renumbered(new_nodes_.size(), -1);
  for (const std::int32_t f : kept) {
    for (const std::int32_t v : triangles[f]) {
      if (index(v) >= fans_) renumbered[index(v) - fans_] = 0;
    }
  }
  std::size_t count = renumbered.size();
  for (std::size_t v = 0;; ++v) {
    while (count > v && renumbered[count - 1] < 0) --count;
    if (v == count) break;
    std::size_t from = v;
    if (renumbered[v] < 0) {
      from = --count;
      new_nodes_[v] = new_nodes_[from];
      tensors_[v] = tensors_[from];
      points_[fans_ + v] = points_[fans_ + from];
    }
    renumbered[from] = static_cast<std::int32_t>(fans_ + v);
  }
  new_nodes_.resize(count);
  tensors_.resize(count);
  points_.resize(fans_ + count);
  for (const std::int32_t f : kept) {
    for (std::int32_t& v : triangles[f]) {
      if (index(v) >= fans_) v = renumbered[index(v) - fans_];
    }
  }
}

Embedding BisectedMesh::to_embedding(bool is_scheme_local) && {
  Embedding out;
  out.faces_added = faces_added();
  out.faces_embedded = callers_faces_ ? given_faces_ : corner_fans(surface).triangles.size();
  out.mean_edge_length = mean_edge_length_ / unit_;  // a power of two: no digit changes, here and below
  IntrinsicMesh& mesh = out.mesh;
  mesh.vertex_count = static_cast<std::int32_t>(points_.size());
  std::vector<std::int32_t> holes;
  for (std::int32_t f = 0; index(f) < triangles.size(); ++f) {
    if (has_room(f)) continue;
    if (is_as_in_space(f)) {
      mesh.areas.resize(triangles.size(), 0.0);
      mesh.areas[f] = area(vector(3 * f), vector(3 * f + 1), vector(3 * f + 2));
    } else {
      holes.push_back(f);
    }
  }
  std::size_t kept = 0;
  for (std::size_t f = 0, hole = 0; f < mesh.areas.size(); ++f) {
    if (hole < holes.size() && index(holes[hole]) == f) {
      ++hole;
    } else {
      mesh.areas[kept++] = mesh.areas[f];
    }
  }
  mesh.areas.resize(kept);
  out.invalid_left = holes.size();
  const bool is_plain = !callers_faces_ && keeps_numbers(surface);
  if (!is_plain) {
    for (Triangle& triangle : triangles) {
      for (std::int32_t& v : triangle) v = external_vertex(v);
    }
    for (std::int32_t& f : origins) f = corner_fans(surface).faces[f];
  }
  for (const std::int32_t f : holes) out.hole_faces.push_back(origins[f]);
  std::ranges::sort(out.hole_faces);
  drop_repeats(out.hole_faces);
  // Each edge of holes alone, once.
  const auto is_hole = [&](std::int32_t f) { return std::binary_search(holes.begin(), holes.end(), f); };
  for (const std::int32_t f : holes) {
    for (std::int32_t h = 3 * f; h < 3 * f + 3; ++h) {
      bool is_listed = false;
      for_each_beyond(h, [&](std::int32_t o) { is_listed = is_listed || o < h || !is_hole(o / 3); });
      if (!is_listed) mesh.loose_edges.push_back({tail(h), tip(h), lengths[h] / unit_});
    }
  }
  if (!holes.empty()) remove_triangles(holes);
  make_twins_of_pairs();
  mesh.triangles = std::move(triangles);
  mesh.twins = std::move(twins);
  mesh.siblings = std::move(siblings);
  mesh.lengths = std::move(lengths);
  for (double& length : mesh.lengths) length /= unit_;
  for (double& area : mesh.areas) area /= unit_ * unit_;
  out.source_face = std::move(origins);
  out.points = std::move(points_);
  mesh.loose_edges.insert(mesh.loose_edges.end(), merged_.begin(), merged_.end());
  for (const auto& [a, b] : surface.loose_edges()) {
    mesh.loose_edges.push_back({a, b, edge_length(surface, metric, a, b)});
  }
  out.is_local = is_scheme_local && is_plain && holes.empty() && !cleaned_;
  if (!out.is_local) out.unreachable = unreachable(mesh);
  return out;
}

// The remaining triangles keep their order.
void BisectedMesh::remove_triangles(const std::vector<std::int32_t>& sorted) {
  const auto count = static_cast<std::int32_t>(triangles.size());
  std::vector<std::int32_t> moved(triangles.size(), 0);
  for (const std::int32_t f : sorted) moved[f] = -1;
  std::int32_t to = 0;
  for (std::int32_t& f : moved) {
    if (f == 0) f = to++;
  }
  if (!siblings.empty()) {
    std::vector<std::int32_t> moved_half_edges(twins.size());
    for (std::int32_t h = 0; index(h) < twins.size(); ++h) {
      moved_half_edges[h] = moved[h / 3] < 0 ? -1 : 3 * moved[h / 3] + h % 3;
    }
    siblings = left_of_cycles(siblings, moved_half_edges, 3 * index(to));
  }
  for (std::int32_t f = 0; f < count; ++f) {
    if (moved[f] < 0) continue;
    const std::size_t g = index(moved[f]);
    triangles[g] = triangles[f];
    origins[g] = origins[f];
    for (std::size_t i = 0; i < 3; ++i) {
      const std::int32_t twin = twins[3 * index(f) + i];
      const std::int32_t beyond = twin < 0 ? -1 : moved[twin / 3];
      twins[3 * g + i] = beyond < 0 ? -1 : 3 * beyond + twin % 3;
      lengths[3 * g + i] = lengths[3 * index(f) + i];
    }
  }
  triangles.resize(index(to));
  origins.resize(index(to));
  twins.resize(3 * index(to));
  lengths.resize(3 * index(to));
}

// Two half-edges of an edge that run in opposite ways are twins. The corners are numbered as in the embedding.
void BisectedMesh::make_twins_of_pairs() {
  bool has_any = false;
  for (std::int32_t h = 0; index(h) < siblings.size(); ++h) {
    const std::int32_t other = siblings[h];
    if (other < 0) continue;
    if (siblings[other] != h || tail(h) == tail(other)) {
      has_any = true;
      continue;
    }
    twins[h] = other;
    twins[other] = h;
    siblings[h] = siblings[other] = -1;
  }
  if (!has_any) siblings.clear();
}

// Vertices of a triangle that no path leads to.
std::vector<std::int32_t> BisectedMesh::unreachable(const IntrinsicMesh& mesh) const {
  std::vector<bool> reached(index(mesh.vertex_count), false);
  for (const Triangle& triangle : mesh.triangles) {
    for (const std::int32_t v : triangle) reached[v] = true;
  }
  for (const LooseEdge& edge : mesh.loose_edges) reached[edge.a] = reached[edge.b] = true;
  std::vector<std::int32_t> out;
  const auto look_at = [&](const Triangle& triangle) {
    for (const std::int32_t v : triangle) {
      if (!reached[v]) out.push_back(v);
      reached[v] = true;
    }
  };
  if (callers_faces_) {
    for (const std::int32_t f : *callers_faces_) look_at(surface.triangles()[f]);
  } else {
    for (const Triangle& triangle : surface.triangles()) look_at(triangle);
  }
  std::sort(out.begin(), out.end());
  return out;
}

}  // namespace seamwire::detail
