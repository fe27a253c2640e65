// SPDX-License-Identifier: GPL-3.0-or-later
#include "live/closed_cut_search.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "live/candidates.hpp"
#include "seamwire/surface/surface.hpp"
#include "seamwire/surface/surface_point.hpp"
#include "seamwire/wires/wire.hpp"
#include "surface/exact_unit.hpp"

namespace seamwire::detail {
namespace {

/// A part of a wire, to the place where the next one begins.
struct WirePiece {
  Wire wire;         ///< from and to vertices: at a place between vertices, the corner of its face that is nearest
  SurfacePoint end;  ///< of the last piece not looked at
};

/// A place that lies in a face up to rounding; nothing where the face has no area.
std::optional<SurfacePoint> point_in_face(const Surface& surface, std::int32_t face, const Vector& place) {
  const auto& [a, b, c] = surface.triangles()[face];
  const std::vector<Vector>& points = surface.points();
  const Vector& origin = points[a];
  const auto from_a = [&](const Vector& p) { return Vector(exact_unit(surface) * (p - origin)); };
  const Vector u = from_a(points[b]), v = from_a(points[c]), w = from_a(place), normal = u.cross(v);
  const double area2 = normal.squaredNorm();
  if (!(area2 > 0)) return std::nullopt;
  const double at_b = w.cross(v).dot(normal) / area2, at_c = u.cross(w).dot(normal) / area2;
  std::array<double, 3> weights = {1.0 - at_b - at_c, at_b, at_c};
  double sum = 0.0;
  for (double& weight : weights) sum += weight = std::max(weight, 0.0);
  for (double& weight : weights) weight /= sum;
  return SurfacePoint{face, weights};
}

/// A wire cut into `count` pieces of about the same length, which begin and end within faces. There are fewer pieces if
/// the wire runs along edges without a face, or has no length. Its ends must be vertices.
std::vector<WirePiece> cut_in_pieces(const Surface& surface, const Wire& wire, std::size_t count) {
  std::vector<WirePiece> pieces;
  if (wire.points.size() < 2) return pieces;
  std::vector<double> steps;
  double whole = 0.0;
  for (std::size_t i = 1; i < wire.points.size(); ++i) {
    whole += (wire.points[i] - wire.points[i - 1]).norm();
    steps.push_back(whole);
  }
  Wire piece{.from = wire.from, .points = {wire.points[0]}, .vertices = {wire.vertices[0]}, .faces = {}};
  double begin = 0.0;
  const auto end_piece = [&](std::int32_t to, double at, const SurfacePoint& end) {
    piece.to = to;
    piece.length = whole > 0 ? wire.length * (at - begin) / whole : 0.0;
    piece.euclidean_length = at - begin;
    begin = at;
    pieces.push_back({std::exchange(piece, Wire{.from = to, .points = {}, .vertices = {}, .faces = {}}), end});
  };
  for (std::size_t i = 1; i < wire.points.size(); ++i) {
    const double from = i > 1 ? steps[i - 2] : 0.0, to = steps[i - 1];
    const std::int32_t face = wire.faces[i - 1];
    // At the first place at or after the one wanted: what is wanted may be along an edge without a face.
    const double wanted = whole * static_cast<double>(pieces.size() + 1) / static_cast<double>(count);
    if (pieces.size() + 1 < count && to > wanted && face >= 0) {
      const double t = std::clamp((wanted - from) / (to - from), 0.25, 0.75);  // within the face, not at its border
      const Vector place = (1.0 - t) * wire.points[i - 1] + t * wire.points[i];
      if (const std::optional<SurfacePoint> end = point_in_face(surface, face, place)) {
        piece.points.push_back(place);
        piece.vertices.push_back(-1);
        piece.faces.push_back(face);
        end_piece(nearest_vertex(surface, *end), from + t * (to - from), *end);
        piece.points.push_back(place);
        piece.vertices.push_back(-1);
      }
    }
    piece.points.push_back(wire.points[i]);
    piece.vertices.push_back(wire.vertices[i]);
    piece.faces.push_back(face);
  }
  end_piece(wire.to, whole, {});
  return pieces;
}

/// The number of closed wires to choose from.
constexpr std::size_t kClosedWires = 3;
/// The number of pieces of each: a piece that is shorter than half of the wire is the shortest way between its ends.
constexpr std::size_t kPiecesOfClosedWire = 3, kPiecesOfBentHalf = 2;

}  // namespace

ClosedCutSearch::ClosedCutSearch(const SurfaceContext& context, std::shared_ptr<MetricSet> metrics)
    : context_(context), metrics_(std::move(metrics)) {}

/// Waits for another thread that prepares the metric.
std::shared_ptr<const Prepared> ClosedCutSearch::prepared(std::size_t metric, const std::stop_token& stop) {
  return metrics_->prepared[metric]->get({.stop = stop, .progress = {}}, [&](const Task&) {
    return prepare(context_, Along::kSurface, *metrics_, metric, stop);
  });
}

/// Null if no wires begin at the point.
const ClosedCutSearch::InMetric* ClosedCutSearch::in_metric(const WireEnd& point, std::size_t metric,
                                                            const std::stop_token& stop) {
  if (!around_ || around_->through != point) {
    around_ = std::nullopt;  // the former one's memory first
    around_ = Around{.through = point, .in = {}};
    around_->in.resize(metrics_->count());
  }
  std::optional<InMetric>& in = around_->in[metric];
  if (!in) {
    const std::shared_ptr<const Prepared> by = prepared(metric, stop);
    const EmbeddedSurface& on = *by->embedded;
    const std::optional<SurfacePoint> seed = on.points().find(point_of(point), "through");
    if (!seed) return nullptr;
    const Task task{.stop = stop, .progress = {}};
    DistanceField field = on.geodesics().solve(*seed, task);
    std::vector<ClosedWire> cuts = closed_wires(on.surface(), on.embedding(), field, kClosedWires, task);
    in = InMetric{.prepared = by, .field = std::move(field), .cuts = std::move(cuts)};
  }
  return &*in;
}

/// The wires of the first metric can be seen while those of the next one are found.
LiveClosedWires ClosedCutSearch::through(const WireEnd& point, const std::stop_token& stop, const Show& show) {
  Cuts cuts(closing().size());
  LiveClosedWires found;
  for (std::size_t i = 0; i < closing().size(); ++i) {
    const InMetric* in = in_metric(point, closing()[i], stop);
    cuts[i] = in != nullptr ? in->cuts : std::vector<ClosedWire>();
    found = choose(point, cuts, stop);
    if (i + 1 < closing().size()) show(found);
  }
  found.final = true;
  return found;
}

LiveClosedWires ClosedCutSearch::choose(const WireEnd& point, const Cuts& cuts, const std::stop_token& stop) {
  LiveClosedWires found;
  for (const ClosedCutId& id : choose_closed_wires(cuts, kClosedWires)) {
    found.cuts.push_back(in_pieces(point, cuts[id.metric][id.number], id, stop));
  }
  return found;
}

LiveClosedWire ClosedCutSearch::in_pieces(const WireEnd& point, const ClosedWire& cut, const ClosedCutId& id,
                                          const std::stop_token& stop) {
  LiveClosedWire closed{
      .pieces = {}, .joints = {}, .separates = cut.separates, .turn = cut.turn, .length = cut.wire.length, .id = id};
  Wire wire = cut.wire;
  wire.from = wire.to = nearest_vertex(*context_.peek_surface(), point);
  add_pieces(closing()[id.metric], wire, kPiecesOfClosedWire, stop, closed);
  if (!closed.joints.empty()) closed.joints.pop_back();  // the last joint is the point itself
  return closed;
}

/// Adds the pieces of a wire, and where each ends.
void ClosedCutSearch::add_pieces(std::size_t metric, const Wire& wire, std::size_t count, const std::stop_token& stop,
                                 LiveClosedWire& closed) {
  const Task task{.stop = stop, .progress = {}};
  const std::shared_ptr<const Prepared> by = prepared(metric, stop);
  for (WirePiece& piece : cut_in_pieces(*by->surface, wire, count)) {
    closed.pieces.push_back(snapped_candidate(*by, std::move(piece.wire), task));
    closed.joints.push_back(piece.end);
  }
}

LiveClosedWires ClosedCutSearch::bent(const BendPlace& place, const std::stop_token& stop) {
  LiveClosedWires found{.cuts = {}, .final = true};
  const auto [metric, number] = place.cut;
  const InMetric* in = metric < closing().size() ? in_metric(place.through, closing()[metric], stop) : nullptr;
  if (in == nullptr || number >= in->cuts.size()) return found;
  const EmbeddedSurface& on = *in->prepared->embedded;
  const std::optional<SurfacePoint> second = on.points().find(point_of(place.second), "second");
  if (!second) return found;
  const Task task{.stop = stop, .progress = {}};
  const ClosedWire& cut = in->cuts[number];
  if (!around_->bent || around_->bent_cut != place.cut) {
    around_->bent = std::nullopt;  // its memory first
    around_->bent.emplace(context_.peek_surface(), on.shared_embedding(), on.geodesics(), in->field, cut, task);
    around_->bent_cut = place.cut;
  }
  std::optional<BentWire> bent = around_->bent->through(*second, task);
  if (bent) found.cuts.push_back(in_pieces(place, cut, *std::move(bent), stop));
  return found;
}

/// The halves run from the first point to the second and back, and each is in pieces.
LiveClosedWire ClosedCutSearch::in_pieces(const BendPlace& place, const ClosedWire& cut, BentWire bent,
                                          const std::stop_token& stop) {
  LiveClosedWire closed{.pieces = {},
                        .joints = {},
                        .separates = cut.separates,
                        .turn = cut.turn,
                        .length = bent.there.length + bent.back.length,
                        .id = place.cut};
  const Surface& surface = *context_.peek_surface();
  bent.there.from = bent.back.to = nearest_vertex(surface, place.through);
  bent.there.to = bent.back.from = nearest_vertex(surface, place.second);
  const std::size_t metric = closing()[place.cut.metric];
  for (const Wire* half : {&bent.there, &bent.back}) {
    add_pieces(metric, *half, kPiecesOfBentHalf, stop, closed);
    if (!closed.joints.empty()) closed.joints.back() = point_of(half == &bent.there ? place.second : place.through);
  }
  if (!closed.joints.empty()) closed.joints.pop_back();  // the last joint is the first point itself
  return closed;
}

}  // namespace seamwire::detail
