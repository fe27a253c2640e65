// SPDX-License-Identifier: GPL-3.0-or-later
#include "wires.hpp"

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <optional>
#include <string>
#include <utility>

#include "arrays.hpp"
#include "held.hpp"
#include "names.hpp"
#include "picks.hpp"
#include "rooms.hpp"
#include "seamwire/wires/closed_wires.hpp"
#include "seamwire/wires/snap.hpp"
#include "seamwire/wires/wire.hpp"
#include "surface.hpp"
#include "watch.hpp"

namespace seamwire::python {
namespace {

void bind_wire(py::module_& module) {
  py::class_<Wire>(module, "Wire", "A geodesic across a surface.")
      .def_readonly("from_vertex", &Wire::from, "int: the vertex where it begins; -1 if that point is not a vertex.")
      .def_readonly("to_vertex", &Wire::to, "int: the vertex where it ends; -1 if that point is not a vertex.")
      .def_property_readonly("points", array_of<Wire>(&Wire::points), "(p, 3) float64: in the caller's coordinates.")
      .def_property_readonly("faces", array_of<Wire>(&Wire::faces),
                             "(p - 1,) int32: the triangle that each segment lies in; -1 along an edge without a face.")
      .def_readonly("length", &Wire::length, "float: the length in the metric, in the unit of the points.")
      .def_readonly("euclidean_length", &Wire::euclidean_length,
                    "float: the Euclidean length, in the unit of the points.")
      .def("__repr__", [](const Wire& w) {
        return "<Wire: from " + std::to_string(w.from) + " to " + std::to_string(w.to) + ", " +
               std::to_string(w.points.size()) + " points, length " + number(w.length) + ">";
      });
}

void bind_closed_wire(py::module_& module) {
  py::class_<ClosedWire>(module, "ClosedWire", "A closed cut through a seed.")
      .def_property_readonly("points", array_of<ClosedWire>([](const ClosedWire& w) -> auto& { return w.wire.points; }),
                             "(p, 3) float64: in the caller's coordinates. The first and the last point are the seed.")
      .def_property_readonly("faces", array_of<ClosedWire>([](const ClosedWire& w) -> auto& { return w.wire.faces; }),
                             "(p - 1,) int32: the triangle that each segment lies in; -1 along an edge without a face.")
      .def_property_readonly(
          "length", [](const ClosedWire& w) { return w.wire.length; },
          "float: the length in the metric, in the unit of the points.")
      .def_property_readonly(
          "euclidean_length", [](const ClosedWire& w) { return w.wire.euclidean_length; },
          "float: the Euclidean length, in the unit of the points.")
      .def_readonly("separates", &ClosedWire::separates,
                    "bool: whether the cut divides the surface into two parts. False if it runs around or through a "
                    "handle.")
      .def_readonly("turn", &ClosedWire::turn,
                    "float: the turn at the seed, in radians. 0 if the cut is smooth there, pi if it turns back.")
      .def("__repr__", [](const ClosedWire& w) {
        return "<ClosedWire: " + std::to_string(w.wire.points.size()) + " points, length " + number(w.wire.length) +
               (w.separates ? ", separates>" : ", around a handle>");
      });
}

py::object bend_through(const BentObject& object, const py::object& second, const py::object& progress) {
  const EmbeddingObject& on = *object.embedding;
  const SurfacePoint place = place_from(second, on.surface->vertex_count(), on.surface->face_count(), "second");
  std::optional<BentWire> bent =
      Watch(progress).run([&](const Task& task) { return object.bent.through(on.find(place, "second"), task); });
  if (!bent) return py::none();
  return py::make_tuple(std::move(bent->there), std::move(bent->back));
}

void bind_bent_wires(py::module_& module) {
  py::class_<BentObject, Held<BentObject>>(module, "BentWires", "A closed cut that can be bent to a second point.")
      .def("through", &bend_through, py::arg("second"), py::arg("progress") = py::none(),
           R"(Find the shortest closed wire through both points that goes around what the cut goes around.

Parameters
----------
second : int or (int, (3,) array_like)
    A vertex, or a face and three barycentric coordinates.
progress : callable, optional
    Called repeatedly with 0. Returning False cancels.

Returns
-------
(Wire, Wire) or None
    From the seed to the second point, and back. None if no such wire leads there.

Raises
------
ValueError
    If the point is not part of the surface, its face has no area, or the embedding has a hole there.
Cancelled
)");
}

py::array snap(const SurfaceObject& surface, const Wire& wire, const py::object& progress) {
  return handed_over(
      Watch(progress).run([&](const Task& task) { return snap_to_edges(*surface.surface, wire, task); }));
}

void bind_snap_to_edges(py::module_& module) {
  module.def("snap_to_edges", &snap, py::arg("surface"), py::arg("wire"), py::arg("progress") = py::none(),
             R"(Find the path of real edges that stays closest to a wire, from its start to its end.

Candidates run along edges of the faces that the wire crosses, and of their neighbors. The path has the least integral
of its distance to the wire.

Parameters
----------
surface : Surface
wire : Wire
    On that surface.
progress : callable, optional
    Called repeatedly with the fraction done. Returning False cancels.

Returns
-------
(k,) int32
    Vertices, each once. Empty if there is no such path.

Raises
------
ValueError
    If the wire is not on the surface.
Cancelled
)");
}

}  // namespace

void bind_wires(py::module_& module) {
  bind_wire(module);
  bind_closed_wire(module);
  bind_bent_wires(module);
  bind_snap_to_edges(module);
}

}  // namespace seamwire::python
