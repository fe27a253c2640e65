// SPDX-License-Identifier: GPL-3.0-or-later
//
// Embedding again after a change of the metric: the faces where it has changed are made what they were before any
// bisection, and refined anew.
#include <algorithm>
#include <utility>

#include "detail/index.hpp"
#include "embedding/bisection.hpp"

namespace seamwire {
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
      nodes_(std::make_unique_for_overwrite<MetricNode[]>(fans_)),
      new_nodes_(old.points.size() - fans_),
      tensors_(new_nodes_.size()),
      states_(faces_, State::kOriginal),
      points_(std::move(old.points)),
      invalid_before_(old.invalid_before),
      faces_added_(mesh_.corners.size() - faces_) {
  for (std::size_t f = faces_; f < origins_.size(); ++f) states_[origins_[f]] = State::kKept;
}

std::vector<std::int32_t> Refinement::changed_faces(const Metric& former) const {
  std::vector<std::int32_t> faces;
  for (std::size_t v = 0; v < fans_; ++v) {
    if (former.tensors[v] == metric_.tensors[v]) continue;
    for (const auto f : surface_.half_edges().vf_range(OpenMesh::VertexHandle(static_cast<int>(v)))) {
      faces.push_back(f.idx());
    }
  }
  std::sort(faces.begin(), faces.end());
  faces.erase(std::unique(faces.begin(), faces.end()), faces.end());
  return faces;
}

// Ready to take part in this run; false for a face that was bisected before it and has to be made anew.
bool Refinement::enter(std::int32_t face) {
  State& state = states_[face];
  if (state == State::kKept) return false;
  if (state == State::kOriginal) {
    for (const std::int32_t fan : mesh_.corners[face]) set_node(fan);
    state = State::kRunning;
    running_.push_back(face);
  }
  return true;
}

// Makes faces what they were before any bisection, and with them those that they are bisected together with: two faces
// whose common edge is bisected. In doing so it moves triangles and vertices together.
void Refinement::reset(const std::vector<std::int32_t>& seeds) {
  // The parts of each face but the first: of a face the last one made, and of a part the one before it.
  std::vector<std::int32_t> last_part(faces_, -1), part_before(origins_.size() - faces_);
  for (std::size_t f = faces_; f < origins_.size(); ++f) {
    part_before[f - faces_] = std::exchange(last_part[origins_[f]], static_cast<std::int32_t>(f));
  }

  struct Outer {
    std::int32_t inside, outside;
  };
  std::vector<Outer> sides;  // every unbisected side of a face to reset, and what is beyond it
  std::vector<bool> is_reset(faces_, false);
  std::vector<std::int32_t> faces;
  const auto add = [&](std::int32_t face) {
    if (!is_reset[face]) faces.push_back(face);
    is_reset[face] = true;
  };
  for (const std::int32_t face : seeds) add(face);
  for (std::size_t done = 0; done < faces.size();) {  // add() makes it grow
    const std::int32_t face = faces[done++];
    const Triangle& corners = surface_.face_fans()[face];
    std::array<std::int32_t, 3> whole{-1, -1, -1};
    const auto look = [&](std::int32_t part) {
      for (std::int32_t h = 3 * part; h < 3 * part + 3; ++h) {
        for (std::size_t side = 0; side < 3; ++side) {
          if (mesh_.tail(h) == corners[side] && mesh_.tip(h) == corners[(side + 1) % 3]) {
            whole[side] = h;
          }
        }
      }
    };
    look(face);
    for (std::int32_t part = last_part[face]; part >= 0; part = part_before[index(part) - faces_]) look(part);
    for (std::size_t side = 0; side < 3; ++side) {
      if (whole[side] >= 0) {
        sides.push_back({3 * face + static_cast<std::int32_t>(side), mesh_.twins[whole[side]]});
      } else if (const std::int32_t twin = surface_.twins()[3 * index(face) + side]; twin >= 0) {
        add(twin / 3);
      }
    }
  }
  std::erase_if(sides, [&](const Outer& side) { return side.outside < 0 || is_reset[origins_[side.outside / 3]]; });
  for (const std::int32_t face : faces) {
    mesh_.corners[face] = surface_.face_fans()[face];
    std::copy_n(surface_.twins().begin() + std::ptrdiff_t{3} * face, 3, mesh_.twins.begin() + std::ptrdiff_t{3} * face);
    branch_[face] = 1;
    states_[face] = State::kOriginal;
  }
  for (const auto& [inside, outside] : sides) {
    mesh_.twins[inside] = outside;
    mesh_.twins[outside] = inside;
  }

  // The parts of those faces go.
  std::size_t to = faces_;
  for (std::size_t f = faces_; f < origins_.size(); ++f) {
    if (is_reset[origins_[f]]) continue;
    mesh_.corners[to] = mesh_.corners[f];
    origins_[to] = origins_[f];
    branch_[to] = branch_[f];
    for (std::size_t i = 0; i < 3; ++i) {
      lengths_[3 * to + i] = lengths_[3 * f + i];
      const std::int32_t twin = mesh_.twins[3 * f + i];
      mesh_.twins[3 * to + i] = twin;
      if (twin >= 0) mesh_.twins[twin] = static_cast<std::int32_t>(3 * to + i);
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
    if (std::exchange(last_part[face], -1) >= 0) kept.push_back(face);
  }
  for (std::size_t f = faces_; f < to; ++f) kept.push_back(static_cast<std::int32_t>(f));
  std::vector<std::int32_t> renumbered(new_nodes_.size(), -1);
  for (const std::int32_t f : kept) {
    for (const std::int32_t v : mesh_.corners[f]) {
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
    for (std::int32_t& v : mesh_.corners[f]) {
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
    for (const std::int32_t face : running_) states_[face] = State::kOriginal;
    running_.clear();
    for (std::size_t f = faces_; f < origins_.size(); ++f) states_[origins_[f]] = State::kKept;
    seeds = std::exchange(conflicts_, {});
  }
}

// Whether an original triangle is valid in a metric.
bool Refinement::is_given_valid(std::int32_t face, const Metric& metric) const {
  const auto [a, b, c] = surface_.face_fans()[face];
  std::array lengths{edge_length(surface_, metric, a, b), edge_length(surface_, metric, b, c),
                     edge_length(surface_, metric, c, a)};
  std::ranges::sort(lengths);
  return lengths[2] < (lengths[0] + lengths[1]) * (1 - kSlack);
}

}  // namespace seamwire
