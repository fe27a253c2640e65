// SPDX-License-Identifier: GPL-3.0-or-later
#include "seamwire/metric/scribble.hpp"

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <optional>
#include <string>
#include <vector>

#include "arrays.hpp"
#include "held.hpp"
#include "metric.hpp"
#include "names.hpp"
#include "rooms.hpp"
#include "surface.hpp"
#include "watch.hpp"

namespace seamwire::python {

namespace {

std::optional<MetricKind> find_kind(const std::string& name) {
  for (const MetricKind kind : {MetricKind::kMin, MetricKind::kMax, MetricKind::kConcave, MetricKind::kEuclidean}) {
    if (name == name_of(kind)) return kind;
  }
  return std::nullopt;
}

std::optional<MetricKind> metric_kind(const std::optional<std::string>& name) {
  const std::optional<MetricKind> kind = name ? find_kind(*name) : std::nullopt;
  if (!name || kind) return kind;
  throw InvalidInput("follow: expected 'min', 'max', 'concave', 'euclidean' or None, got '" + *name + "'");
}

std::optional<MetricKind> kind_acted_on(const std::string& acts_on) {
  const std::optional<MetricKind> kind = find_kind(acts_on);
  if (kind || acts_on == "both") return kind;
  throw InvalidInput("acts_on: expected 'both', 'min', 'max', 'concave' or 'euclidean', got '" + acts_on + "'");
}

Scribble make_scribble(const py::object& points, const py::object& faces, const py::object& vertices, double eta,
                       int rings, std::optional<double> radius, bool attracts, const std::string& acts_on) {
  Scribble scribble;
  scribble.acts_on = kind_acted_on(acts_on);
  scribble.points = points_from(points, "points");
  if (!faces.is_none()) scribble.faces = numbers_from(faces, "faces");
  if (!vertices.is_none()) scribble.vertices = numbers_from(vertices, "vertices");
  scribble.eta = eta;
  scribble.rings = rings;
  scribble.radius = radius;
  scribble.attracts = attracts;
  return scribble;
}

void bind_scribble_class(py::module_& module) {
  py::class_<Scribble>(module, "Scribble", R"(A stroke drawn on a surface. Wires near it follow it.

Parameters
----------
points : (k, 3) array_like of float
    In the caller's coordinates, in drawing order. A closed stroke repeats its first point. Points may be far apart.
faces, vertices : (k,) array_like of int, optional
    The triangle that each point lies in, or its vertex. -1 in one of them if the other names the place.
eta : float
    The eigenvalues of the tensors along the stroke are eta and 1 / eta.
rings : int
    The stroke changes the metric within fewer rings of vertices than this.
radius : float, optional
    Use this distance in place of rings, in the caller's units.
attracts : bool
    False makes wires that cross the stroke short, and wires that follow it long.
acts_on : {'both', 'min', 'max', 'concave', 'euclidean'}
    The kind of metrics that the stroke changes, as `MetricSpec.kind`. 'both': every metric.

Raises
------
ValueError
    If an array has the wrong shape or type. Everything else is checked when the stroke is applied to a surface.
)")
      .def(py::init(&make_scribble), py::arg("points"), py::arg("faces") = py::none(), py::arg("vertices") = py::none(),
           py::arg("eta") = 20.0, py::arg("rings") = 10, py::arg("radius") = py::none(), py::arg("attracts") = true,
           py::arg("acts_on") = "both")
      .def_property_readonly("points", array_of<Scribble>(&Scribble::points), "(k, 3) float64.")
      .def_property_readonly("faces", array_of<Scribble>(&Scribble::faces), "(k,) int32: empty if not given.")
      .def_property_readonly("vertices", array_of<Scribble>(&Scribble::vertices), "(k,) int32: empty if not given.")
      .def_property_readonly("eta", [](const Scribble& s) { return s.eta; })
      .def_property_readonly("rings", [](const Scribble& s) { return s.rings; })
      .def_property_readonly("radius", [](const Scribble& s) { return s.radius; })
      .def_property_readonly("attracts", [](const Scribble& s) { return s.attracts; })
      .def_property_readonly("acts_on", [](const Scribble& s) { return s.acts_on ? name_of(*s.acts_on) : "both"; })
      .def("__repr__", [](const Scribble& s) {
        return "<Scribble: " + std::to_string(s.points.size()) + " points, " + (s.attracts ? "attracts" : "repels") +
               ">";
      });
}

Held<MetricObject> apply(const SurfaceObject& surface, const MetricObject& metric, const py::object& scribbles,
                         const std::optional<std::string>& follow, const py::object& progress) {
  const std::vector<Scribble> strokes = objects_from<Scribble>(scribbles, "scribbles", "Scribble");
  const std::optional<MetricKind> meant = metric_kind(follow);
  return Watch(progress).run([&](const Task& task) {
    return make_held<MetricObject>(apply_scribbles(*surface.surface, metric.metric, strokes, meant, task));
  });
}

void bind_apply_scribbles(py::module_& module) {
  module.def("apply_scribbles", &apply, py::arg("surface"), py::arg("metric"), py::arg("scribbles"),
             py::arg("follow") = py::none(), py::arg("progress") = py::none(),
             R"(Change a metric by strokes (Section 5 of the paper).

Strokes are applied in order. Where two strokes cross, the later one decides along its line. Without strokes the result
equals the metric.

Parameters
----------
surface : Surface
metric : Metric
    Of that surface.
scribbles : sequence of Scribble
follow : {'min', 'max', 'concave', 'euclidean'}, optional
    Apply only the strokes that act on metrics of this kind.
progress : callable, optional
    Called repeatedly with the fraction done. Returning False cancels.

Returns
-------
Metric

Raises
------
ValueError
    If a point of a stroke is not on the surface, a parameter is out of range, or the metric belongs to another surface.
    The message has the numbers of the stroke and of the point.
Cancelled
)");
}

}  // namespace

void bind_scribble(py::module_& module) {
  bind_scribble_class(module);
  bind_apply_scribbles(module);
}

}  // namespace seamwire::python
