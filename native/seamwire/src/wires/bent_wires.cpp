// SPDX-License-Identifier: GPL-3.0-or-later
#include "seamwire/wires/bent_wires.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "detail/csr.hpp"
#include "detail/half_edge.hpp"
#include "detail/index.hpp"
#include "detail/infinity.hpp"
#include "detail/poll.hpp"
#include "geodesics/placed_point.hpp"
#include "wires/curve_check.hpp"
#include "wires/path_position.hpp"
#include "wires/spanning_tree.hpp"

namespace seamwire {

using namespace detail;

namespace {

/// Edges that have the two deepest places on different ends of a line over them, or that a closed line crosses.
struct Crossed {
  std::vector<std::uint8_t> edges;   ///< of EdgesAndHoles, whether the line crosses it
  std::vector<std::int32_t> places;  ///< where the line ends: faces, not holes
};

/// The edge that closes a cut. Throws InvalidInput unless the half-edge is the lowest of an edge.
std::int32_t edge_of_cut(const EdgesAndHoles& edges, std::int32_t half_edge) {
  if (!is_index(half_edge, edges.edge_of.size()) || edges.half_edge_of[edges.edge_of[half_edge]] != half_edge) {
    throw InvalidInput("the cut is of another embedding");
  }
  return edges.edge_of[half_edge];
}

/// Faces and holes around a closed cut, joined over edges that are not part of the tree of vertices it runs along. No
/// line leads over an edge with siblings.
class Sides {
 public:
  Sides(const IntrinsicMesh& mesh, const DistanceField& field, std::int32_t half_edge, const Task& task)
      : mesh_(mesh),
        edges_(mesh, task),
        is_in_tree_(spanning_tree(mesh, edges_, field.distances(), task)),
        cut_(edge_of_cut(edges_, half_edge)) {
    beside_ = Csr<std::int32_t>(edges_.face_count + edges_.hole_count, [&](const auto& visit) {
      const Poll filling(task, 0.3, 0.3, 1);
      for (std::int32_t e = 0; index(e) < edges_.edge_count(); ++e) {
        filling.at(index(e));
        for (const std::int32_t f : edges_.faces[e]) visit(f, e);
      }
    });
    sides_.assign(beside_.row_count(), 0);
    entered_over_.assign(beside_.row_count(), -1);
  }

  /// A line that crosses the cut once.
  Crossed line(const ExactGeodesics& geodesics, const Task& task) {
    const auto [left, right] = edges_.faces[cut_];
    flood(left, 1, task);
    Crossed found{.edges = std::vector<std::uint8_t>(edges_.edge_count(), 0), .places = {}};
    found.edges[cut_] = 1;
    if (sides_[right] != 0) {  // it does not separate
      walk(right, left, found.edges);
      return found;
    }
    flood(right, 2, task);
    const std::vector<double> depths = depths_of_vertices(geodesics, task);
    for (const std::int32_t from : {left, right}) {
      const std::int32_t place = deepest(depths, sides_[from], task);
      walk(place, from, found.edges);
      if (index(place) < edges_.face_count) found.places.push_back(place);
    }
    return found;
  }

  const std::vector<std::int32_t>& half_edges() const { return edges_.half_edge_of; }

 private:
  std::int32_t beyond(std::int32_t edge, std::int32_t face) const {
    return edges_.faces[edge][0] == face ? edges_.faces[edge][1] : edges_.faces[edge][0];
  }
  void flood(std::int32_t from, std::uint8_t side, const Task& task) {
    std::vector<std::int32_t> front = {from};
    sides_[from] = side;
    const Poll poll(task, 0.3, 0.3, sides_.size());
    for (std::size_t next = 0; next < front.size(); ++next) {
      poll.at(next);
      for (const std::int32_t e : beside_[front[next]]) {
        const std::int32_t f = beyond(e, front[next]);
        if (is_in_tree_[e] != 0 || e == cut_ || sides_[f] != 0) continue;
        sides_[f] = side;
        entered_over_[f] = e;
        front.push_back(f);
      }
    }
  }
  /// Back the way that it was entered.
  void walk(std::int32_t face, std::int32_t to, std::vector<std::uint8_t>& crossed) const {
    while (face != to) {
      const std::int32_t e = entered_over_[face];
      crossed[e] = 1;
      face = beyond(e, face);
    }
  }
  /// Distances from the vertices that have both sides beside them: those of the cut.
  std::vector<double> depths_of_vertices(const ExactGeodesics& geodesics, const Task& task) const {
    std::vector<std::uint8_t> seen(index(mesh_.vertex_count), 0);
    const Poll poll(task, 0.3, 0.3, edges_.edge_count());
    for (std::size_t e = 0; e < edges_.edge_count(); ++e) {
      poll.at(e);
      const std::int32_t h = edges_.half_edge_of[e];
      for (const std::int32_t v : {mesh_.tail(h), mesh_.tip(h)}) {
        seen[v] = static_cast<std::uint8_t>(seen[v] | sides_[edges_.faces[e][0]] | sides_[edges_.faces[e][1]]);
      }
    }
    std::vector<SurfacePoint> sources;
    for (std::int32_t v = 0; v < mesh_.vertex_count; ++v) {
      if (seen[v] == 3) sources.push_back(SurfacePoint(v));
    }
    const DistanceField field = geodesics.solve(sources, {}, part_of(task, 0.3, 0.5));
    if (!field.fits(mesh_)) throw InvalidInput("the geodesics are of another embedding");
    return field.distances();
  }
  /// A face or a hole is as deep as what is nearest of it.
  std::int32_t deepest(const std::vector<double>& depths, std::uint8_t side, const Task& task) const {
    std::vector<double> least(sides_.size(), kInfinity);
    const Poll poll(task, 0.5, 0.5, edges_.edge_count());
    for (std::size_t e = 0; e < edges_.edge_count(); ++e) {
      poll.at(e);
      const std::int32_t h = edges_.half_edge_of[e];
      const double depth = std::min(depths[mesh_.tail(h)], depths[mesh_.tip(h)]);
      for (const std::int32_t f : edges_.faces[e]) least[f] = std::min(least[f], depth);
    }
    std::int32_t best = -1;
    for (std::int32_t f = 0; index(f) < sides_.size(); ++f) {
      if (sides_[f] == side && (best < 0 || least[f] > least[best])) best = f;
    }
    return best;
  }

  const IntrinsicMesh& mesh_;
  const EdgesAndHoles edges_;
  const std::vector<std::uint8_t> is_in_tree_;
  const std::int32_t cut_;           // the edge that closes it
  Csr<std::int32_t> beside_;         // edges of faces and holes
  std::vector<std::uint8_t> sides_;  // of faces and holes: 1, 2, 0 for neither
  std::vector<std::int32_t> entered_over_;
};

/// Two sheets over a mesh without some of its faces. A vertex v is v on one sheet and v + n on the other, an edge leads
/// to the same sheet, or where the line crosses it to the other one. Of the faces that are left the k-th one is k on
/// the sheet of its first corner being the first one, and k + m else.
struct DoubleCover {
  DoubleCover(const IntrinsicMesh& below, const std::vector<std::int32_t>& half_edges, const Crossed& line,
              const Task& task)
      : vertex_count(below.vertex_count), number(below.face_count(), -1) {
    std::vector<std::uint8_t> is_crossed(3 * below.face_count(), 0);
    for (std::size_t e = 0; e < half_edges.size(); ++e) {
      is_crossed[half_edges[e]] = line.edges[e];
      if (const std::int32_t twin = below.twins[half_edges[e]]; twin >= 0) is_crossed[twin] = line.edges[e];
    }
    for (std::int32_t f = 0; index(f) < below.face_count(); ++f) {
      if (std::ranges::count(line.places, f) > 0) continue;
      number[f] = static_cast<std::int32_t>(kept.size());
      kept.push_back(f);
    }
    // Whether the beginning of a half-edge is on another sheet than the first corner of its face.
    const auto is_other = [&](std::int32_t h) {
      const std::int32_t first = h - h % 3;
      return h % 3 == 0 ? false : h % 3 == 1 ? is_crossed[first] != 0 : is_crossed[first] != is_crossed[first + 1];
    };
    const auto face_count = static_cast<std::int32_t>(kept.size());
    // What lies above a half-edge of an edge, on the sheet where a corner of its face at that edge is.
    const auto above = [&](std::int32_t h, std::int32_t corner, bool corner_is_other) {
      return 3 * (number[h / 3] + (corner_is_other != is_other(corner) ? face_count : 0)) + h % 3;
    };
    mesh.vertex_count = 2 * vertex_count;
    if (!below.siblings.empty()) mesh.siblings.reserve(6 * kept.size());
    Poll poll(task, 0.5, 0.55, 2 * kept.size());
    for (const bool other : {false, true}) {
      for (const std::int32_t f : kept) {
        poll.next();
        Triangle corners{};
        for (std::int32_t h = 3 * f; h < 3 * f + 3; ++h) {
          corners[index(h % 3)] = below.tail(h) + (is_other(h) != other ? vertex_count : 0);
          const std::int32_t twin = below.twins[h];
          mesh.lengths.push_back(below.lengths[h]);
          if (!below.siblings.empty()) {  // the next one that is left
            std::int32_t s = below.siblings[h];
            while (s >= 0 && s != h && number[s / 3] < 0) s = below.siblings[s];
            const bool tail_is_other = is_other(h) != other;
            const bool is_alone = s < 0 || s == h;
            mesh.siblings.push_back(
                is_alone ? -1 : above(s, below.tail(s) == below.tail(h) ? s : next_in_face(s), tail_is_other));
          }
          if (twin < 0 || number[twin / 3] < 0) {
            mesh.twins.push_back(-1);
            continue;
          }
          const bool twin_other =
              (is_other(next_in_face(h)) != other) != is_other(twin);  // they share a vertex of a sheet
          mesh.twins.push_back(3 * (number[twin / 3] + (twin_other ? face_count : 0)) + twin % 3);
        }
        mesh.triangles.push_back(corners);
        if (!below.areas.empty()) mesh.areas.push_back(below.areas[f]);
      }
      for (const LooseEdge& edge : below.loose_edges) {
        const std::int32_t shift = other ? vertex_count : 0;
        mesh.loose_edges.push_back({edge.a + shift, edge.b + shift, edge.length});
      }
    }
  }

  /// A point on either sheet; -1 where its face was taken out.
  SurfacePoint lifted(SurfacePoint point, bool other) const {
    if (point.vertex >= 0) {
      point.vertex += other ? vertex_count : 0;
    } else {
      point.face = number[point.face];
      if (point.face >= 0 && other) point.face += static_cast<std::int32_t>(kept.size());
    }
    return point;
  }

  /// What lies below a path.
  IntrinsicPath projected(IntrinsicPath path) const {
    const auto face_below = [this](std::int32_t f) { return kept[index(f) % kept.size()]; };
    for (PathPoint& at : path.points) {
      if (at.vertex >= 0) at.vertex %= vertex_count;
      if (at.half_edge >= 0) at.half_edge = 3 * face_below(at.half_edge / 3) + at.half_edge % 3;
      if (at.face >= 0) at.face = face_below(at.face);
    }
    for (std::int32_t& f : path.faces) {
      if (f >= 0) f = face_below(f);
    }
    return path;
  }

  std::int32_t vertex_count;
  std::vector<std::int32_t> kept;    ///< the faces that are left
  std::vector<std::int32_t> number;  ///< of a face among them, -1
  IntrinsicMesh mesh;
};

Vector position(const Embedding& embedding, const SurfacePoint& point) {
  return detail::position(embedding,
                          PathPoint{.vertex = point.vertex, .face = point.face, .barycentric = point.barycentric});
}

bool is_same(const std::weak_ptr<const void>& one, const std::weak_ptr<const void>& other) {
  return !one.owner_before(other) && !other.owner_before(one);
}

Crossed line_across(const Surface& surface, const Embedding& embedding, const ExactGeodesics& geodesics,
                    const DistanceField& field, const ClosedWire& cut, const Task& task,
                    std::vector<std::int32_t>& half_edges) {
  check_embedding(surface, embedding);
  check_field(embedding, field);
  if (field.sources().size() != 1) {
    throw InvalidInput("a cut leads through one seed: the field has " + std::to_string(field.sources().size()));
  }
  if (!is_same(cut.mesh, field.mesh_id())) throw InvalidInput("the cut is of another embedding");
  Sides sides(embedding.mesh, field, cut.half_edge, task);
  const std::vector<Vector>& points = cut.wire.points;
  const Vector seed = position(embedding, field.sources().front());
  if (points.empty() || !is_same_place(surface, points.front(), seed) || !is_same_place(surface, points.back(), seed)) {
    throw InvalidInput("the cut does not lead through the seed of the field");
  }
  half_edges = sides.half_edges();
  return sides.line(geodesics, task);
}

}  // namespace

struct BentWires::Impl {
  std::shared_ptr<const Surface> surface;
  std::shared_ptr<const Embedding> embedding;
  DoubleCover cover;
  std::optional<DistanceField> field;  // nothing where the seed is in a face that was taken out
};

BentWires::BentWires(std::shared_ptr<const Surface> surface, std::shared_ptr<const Embedding> embedding,
                     const ExactGeodesics& geodesics, const DistanceField& field, const ClosedWire& cut,
                     const Task& task) {
  if (!surface || !embedding) throw InvalidInput("surface or embedding: there is none");
  std::vector<std::int32_t> half_edges;
  const Crossed line = line_across(*surface, *embedding, geodesics, field, cut, task, half_edges);
  const IntrinsicMesh& below = embedding->mesh;
  Impl made{.surface = std::move(surface),
            .embedding = std::move(embedding),
            .cover = DoubleCover(below, half_edges, line, task),
            .field = std::nullopt};
  const SurfacePoint seed = made.cover.lifted(field.sources().front(), false);
  if (seed.vertex >= 0 || seed.face >= 0) {
    const ExactGeodesics above(made.cover.mesh, part_of(task, 0.55, 0.7));
    made.field = above.solve(seed, part_of(task, 0.7, 1.0));
  }
  impl_ = std::make_unique<const Impl>(std::move(made));
}

BentWires::~BentWires() = default;
BentWires::BentWires(BentWires&&) noexcept = default;
BentWires& BentWires::operator=(BentWires&&) noexcept = default;

std::optional<BentWire> BentWires::through(const SurfacePoint& second, const Task& task) const {
  const auto& [surface, embedding, cover, field] = *impl_;
  if (second.vertex >= 0) {
    check_index(second.vertex, embedding->points.size(), "second: vertex");
  } else {
    check_index(second.face, embedding->mesh.face_count(), "second: face", "faces");
    checked_barycentric(second.barycentric, "second");
  }
  std::array<IntrinsicPath, 2> paths;
  for (const bool other : {false, true}) {
    const SurfacePoint to = cover.lifted(second, other);
    if (!field || (to.vertex < 0 && to.face < 0)) return std::nullopt;
    std::optional<IntrinsicPath> path = field->trace(to, task);
    if (!path || path->points.size() < 2) return std::nullopt;
    paths[other ? 1 : 0] = cover.projected(*std::move(path));
  }
  std::ranges::reverse(paths[1].points);
  std::ranges::reverse(paths[1].faces);
  return BentWire{.there = map_wire(*surface, *embedding, paths[0]), .back = map_wire(*surface, *embedding, paths[1])};
}

}  // namespace seamwire
