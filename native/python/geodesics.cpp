// SPDX-License-Identifier: GPL-3.0-or-later
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "arrays.hpp"
#include "detail/index.hpp"
#include "detail/poll.hpp"
#include "embedding.hpp"
#include "held.hpp"
#include "picks.hpp"
#include "rooms.hpp"
#include "seamwire/geodesics/exact_geodesics.hpp"
#include "seamwire/wires/closed_wires.hpp"
#include "seamwire/wires/wire.hpp"
#include "watch.hpp"
#include "wires.hpp"

namespace seamwire::python {
namespace {

/// A distance field, with the embedding it refers to, and the name of its method.
struct FieldObject {
  std::shared_ptr<const EmbeddingObject> embedding;
  DistanceField field;
  std::string method;
};

using FieldClass = py::class_<FieldObject, Held<FieldObject>>;

py::array distances_of(const py::object& self) {
  const auto& object = self.cast<const FieldObject&>();
  const auto count = static_cast<py::ssize_t>(object.embedding->surface->vertex_count());
  return view(object.field.distances().data(), {count}, {sizeof(double)}, self);
}

std::optional<Wire> trace(const FieldObject& object, const py::object& vertex, const py::object& progress) {
  const EmbeddingObject& on = *object.embedding;
  const std::int32_t target = vertex_from(vertex, on.surface->vertex_count(), "vertex");
  return Watch(progress).run(
      [&](const Task& task) { return trace_wire(*on.surface, on.embedding, object.field, target, task); });
}

py::tuple trace_many(const FieldObject& object, const py::object& vertices, const py::object& progress) {
  const EmbeddingObject& on = *object.embedding;
  const std::vector<std::int32_t> targets = numbers_from(vertices, "vertices");
  std::vector<Vector> points;
  std::vector<std::int32_t> starts{0};
  std::vector<double> lengths;
  Watch(progress).run([&](const Task& task) {
    for (std::size_t i = 0; i < targets.size(); ++i) {
      task.check(static_cast<double>(i) / static_cast<double>(targets.size()));
      detail::check_index(targets[i], on.surface->vertex_count(), "vertex");
      const std::optional<Wire> wire = trace_wire(*on.surface, on.embedding, object.field, targets[i], task);
      if (wire) points.insert(points.end(), wire->points.begin(), wire->points.end());
      starts.push_back(static_cast<std::int32_t>(points.size()));
      lengths.push_back(wire ? wire->length : std::numeric_limits<double>::infinity());
    }
    return true;
  });
  return py::make_tuple(copied(points), handed_over(std::move(starts)), handed_over(std::move(lengths)));
}

void bind_distances(FieldClass& field) {
  field
      .def_property_readonly(
          "seed", [](const FieldObject& f) { return f.field.seed(); },
          "int: the vertex that distances start from; -1 for several seeds, or a seed that is not a vertex.")
      .def_property_readonly(
          "radius", [](const FieldObject& f) { return f.field.radius(); },
          "float: the distance at which the solver stopped, or inf. Larger distances are inf.")
      .def_property_readonly(
          "method", [](const FieldObject& f) { return f.method; },
          "str: 'exact' or 'heat', the method that computed the distances.")
      .def_property_readonly("distances", &distances_of,
                             "(n,) float64: the distance of each of the surface's vertices, in the metric. inf if no "
                             "path reaches the vertex.")
      .def("__repr__", [](const FieldObject& f) {
        return "<DistanceField: from " + std::to_string(f.field.seed()) + " to " +
               std::to_string(f.embedding->surface->vertex_count()) + " vertices>";
      });
}

void bind_traces(FieldClass& field) {
  field.def("trace", &trace, py::arg("vertex"), py::arg("progress") = py::none(),
            R"(Trace the path from the seed to a vertex.

The path of an exact field is the shortest one. The path of a heat field is locally shortest.

Parameters
----------
vertex : int
progress : callable, optional
    Called repeatedly with 0. Returning False cancels.

Returns
-------
Wire or None
    In an exact field, its length is the vertex's distance. None if the vertex is unreachable.

Raises
------
ValueError
    If the vertex is out of range.
Cancelled
)");
  field.def("trace_many", &trace_many, py::arg("vertices"), py::arg("progress") = py::none(),
            R"(Trace the paths from the seed to several vertices, as `trace` does (Figure 1).

Parameters
----------
vertices : (k,) array_like of int
progress : callable, optional
    Called repeatedly with the fraction done. Returning False cancels.

Returns
-------
points : (p, 3) float64
    The points of all paths, one path after the other, in the caller's coordinates.
starts : (k + 1,) int32
    Path i has the points starts[i] to starts[i + 1]. It has no points if its vertex is unreachable.
lengths : (k,) float64
    Lengths in the metric; inf if the vertex is unreachable.

Raises
------
ValueError
    If a vertex is out of range.
Cancelled
)");
}

double distance_to(const FieldObject& object, const py::object& face, const py::object& barycentric,
                   const py::object& progress) {
  const EmbeddingObject& on = *object.embedding;
  const SurfacePoint point = face_point_from(face, barycentric, on.surface->face_count(), "point");
  return Watch(progress).run([&](const Task& task) { return object.field.distance(on.find(point, "point"), task); });
}

std::optional<Wire> trace_to(const FieldObject& object, const py::object& face, const py::object& barycentric,
                             const py::object& progress) {
  const EmbeddingObject& on = *object.embedding;
  const SurfacePoint point = face_point_from(face, barycentric, on.surface->face_count(), "point");
  return Watch(progress).run([&](const Task& task) {
    return trace_wire(*on.surface, on.embedding, object.field, on.find(point, "point"), task);
  });
}

void bind_points_of_faces(FieldClass& field) {
  field.def("distance", &distance_to, py::arg("face"), py::arg("barycentric"), py::arg("progress") = py::none(),
            R"(Compute the distance of any point of a face.

In an exact field, the distance is exact on the embedding. In a heat field, it is
interpolated from the corners, or straight on the face of a seed.

Parameters
----------
face : int
    A triangle of the surface.
barycentric : (3,) array_like
    One coordinate for each corner, 0 or more, with the sum 1. A coordinate of exactly 0 puts the point on the edge
    opposite to that corner.
progress : callable, optional
    Called repeatedly with 0. Returning False cancels.

Returns
-------
float
    In the metric; inf if no path leads there, or beyond the field's radius.

Raises
------
ValueError
    If the face is out of range or has no area, the coordinates are invalid, or the embedding has a hole there.
Cancelled
)");
  field.def("trace_to", &trace_to, py::arg("face"), py::arg("barycentric"), py::arg("progress") = py::none(),
            R"(Trace the path from the nearest seed to any point of a face, as `trace` does.

Parameters
----------
face, barycentric, progress
    As for `distance`.

Returns
-------
Wire or None
    As from `trace`. The number of an end that is not a vertex is -1.

Raises
------
ValueError
    As `distance`.
Cancelled
)");
}

std::vector<ClosedWire> find_closed_wires(const FieldObject& object, const py::object& count,
                                          const py::object& progress) {
  const std::size_t most = count_from(count, "count");
  const EmbeddingObject& on = *object.embedding;
  return Watch(progress).run(
      [&](const Task& task) { return closed_wires(*on.surface, on.embedding, object.field, most, task); });
}

Held<BentObject> bend(const FieldObject& object, const ClosedWire& cut, const py::object& progress) {
  return Watch(progress).run([&](const Task& task) {
    const EmbeddingObject& on = *object.embedding;
    return make_held<BentObject>(BentObject{
        .embedding = object.embedding,
        .bent = BentWires(on.surface, on.embedded.shared_embedding(), on.geodesics(task), object.field, cut, task)});
  });
}

void bind_closed_cuts(FieldClass& field) {
  field.def("closed_wires", &find_closed_wires, py::arg("count") = 3, py::arg("progress") = py::none(),
            R"(Find the closed cuts through the seed that the surface suggests, best first.

Each cut consists of two shortest wires and the edge of the embedding at whose ends they meet on the far side. Good cuts
are short and turn little at the seed. In a `concave_metric` they are nearest to the cuts that people draw.

Parameters
----------
count : int
    The largest number of cuts to return, at least 0.
progress : callable, optional
    Called repeatedly with the fraction done. Returning False cancels.

Returns
-------
list of ClosedWire
    Empty if the surface suggests no cut. Examples are planes, and spheres, where all wires meet in one place.

Raises
------
ValueError
    If the field has several seeds, or count is negative.
Cancelled

References
----------
docs/method/closed-cuts.md.
)");
  field.def("bend", &bend, py::arg("cut"), py::arg("progress") = py::none(),
            R"(Prepare a closed wire of the field, so that it can be bent to a second point.

Parameters
----------
cut : ClosedWire
    A result of `closed_wires`.
progress : callable, optional
    Called repeatedly with the fraction done. Returning False cancels.

Returns
-------
BentWires

Raises
------
ValueError
    If the cut does not lead through the seed of the field.
Cancelled
)");
}

/// The options of a solve, and its seeds, still as points of the surface.
struct Solve {
  std::vector<SurfacePoint> seeds;
  SolveOptions options;
};

Solve solve_from(const Surface& surface, const py::object& seed, const py::object& targets,
                 const std::optional<double>& max_distance) {
  Solve solve{.seeds = surface_points_from(seed, surface, "seed"), .options = {}};
  if (!targets.is_none()) solve.options.targets = surface_points_from(targets, surface, "target");
  if (max_distance) solve.options.max_distance = *max_distance;
  if (solve.seeds.empty()) throw InvalidInput("seed: expected at least one");
  return solve;
}

Held<FieldObject> make_field(const std::shared_ptr<EmbeddingObject>& embedding, const py::object& seed,
                             const py::object& progress, const py::object& targets,
                             const std::optional<double>& max_distance, const std::string& method) {
  const bool by_heat = method == "heat";
  if (!by_heat && method != "exact") throw InvalidInput("method: expected 'exact' or 'heat', got '" + method + "'");
  Solve solve = solve_from(*embedding->surface, seed, targets, max_distance);
  return Watch(progress).run([&](const Task& task) {
    // Factoring takes longer than a solve.
    const double prepared = by_heat ? 0.8 : 0.0;
    const Task first = detail::part_of(task, 0.0, prepared), last = detail::part_of(task, prepared, 1.0);
    const DistanceMethod& solver =
        by_heat ? static_cast<const DistanceMethod&>(embedding->heat_geodesics(first)) : embedding->geodesics(first);
    for (SurfacePoint& point : solve.seeds) point = embedding->find(point, "seed");
    for (SurfacePoint& point : solve.options.targets) point = embedding->find(point, "target");
    return make_held<FieldObject>(FieldObject{embedding, solver.solve(solve.seeds, solve.options, last), method});
  });
}

void bind_distance_field(py::module_& module) {
  module.def("distance_field", &make_field, py::arg("embedding"), py::arg("seed"), py::arg("progress") = py::none(),
             py::arg("targets") = py::none(), py::arg("max_distance") = py::none(), py::arg("method") = "exact",
             R"(Compute distances over an embedding from a point, or from the nearest of several points.

Distances are exact on the embedding, or approximated by the heat method.

Parameters
----------
embedding : Embedding
    The first call with each method builds a solver, and the embedding keeps it.
seed : int, (int, (3,) array_like), or sequence of int or (int, (3,) array_like)
    A vertex of the surface, or a triangle and barycentric coordinates, as for `DistanceField.distance`; or several.
progress : callable, optional
    Called repeatedly with the fraction done. Returning False cancels.
targets : int, (int, (3,) array_like), or sequence of int or (int, (3,) array_like), optional
    Stop when the distances and paths of these points are known. Other distances may be missing (inf). The heat method
    does not stop.
max_distance : float, optional
    At least 0. Stop at this distance; larger distances are inf.
method : {'exact', 'heat'}
    'exact' propagates windows. 'heat' solves two linear systems with matrices that the first call factors. Each
    further call with any seeds then takes about the same time.

Returns
-------
DistanceField

Raises
------
ValueError
    If a seed or a target is out of range, has wrong coordinates, or lies in a hole of the embedding, or if
    max_distance or method is not valid.
Cancelled

References
----------
docs/method/heat.md.
)");
}

}  // namespace

void bind_geodesics(py::module_& module) {
  FieldClass field(module, "DistanceField", "Distances from a seed to every vertex.");
  bind_distances(field);
  bind_traces(field);
  bind_points_of_faces(field);
  bind_closed_cuts(field);
  bind_distance_field(module);
}

}  // namespace seamwire::python
