// SPDX-License-Identifier: GPL-3.0-or-later
#include "seamwire/metric/scribble.hpp"

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "arrays.hpp"
#include "objects.hpp"
#include "watch.hpp"

namespace seamwire::python {

namespace {

template <class Get>
py::cpp_function array_of(const Get& get) {
  return [get](py::object self) { return view(get(self.cast<const Scribble&>()), self); };
}

std::optional<Follow> follow_from(const std::optional<std::string>& name) {
  if (!name) return std::nullopt;
  if (*name == "min") return Follow::kMin;
  if (*name == "max") return Follow::kMax;
  if (*name == "concave") return Follow::kConcave;
  throw InvalidInput("follow: expected 'min', 'max', 'concave' or None, got '" + *name + "'");
}

std::optional<Follow> meant_for(const std::string& acts_on) {
  if (acts_on == "both") return std::nullopt;
  if (acts_on == "min" || acts_on == "max" || acts_on == "concave") return follow_from(acts_on);
  throw InvalidInput("acts_on: expected 'both', 'min', 'max' or 'concave', got '" + acts_on + "'");
}

}  // namespace

void bind_scribble(py::module_& module) {
  py::class_<Scribble>(module, "Scribble", R"(A stroke drawn on a surface: wires near it run as it does.

Parameters
----------
points : (k, 3) array_like of float
    In the caller's coordinates, in drawing order; the first again at the end: closed. Points may be far apart.
faces, vertices : (k,) array_like of int, optional
    For each point the triangle it lies in, or the vertex it is at; -1: the other of the two says it.
eta : float
    The eigenvalues of the tensors along the stroke are eta and 1 / eta.
rings : int
    From that ring of vertices around the stroke on nothing changes.
radius : float, optional
    Instead of rings: from that distance on, in the caller's units.
attracts : bool
    False: crossing the stroke becomes short, and following it long.
acts_on : {'both', 'min', 'max', 'concave'}
    Which of the metrics it is meant for; 'both': whichever there are.

Raises
------
ValueError
    Where an array has the wrong shape or type. What else may be wrong is found when it is applied to a surface.
)")
      .def(py::init([](const py::object& points, const py::object& faces, const py::object& vertices, double eta,
                       int rings, std::optional<double> radius, bool attracts, const std::string& acts_on) {
             Scribble scribble;
             scribble.meant_for = meant_for(acts_on);
             scribble.points = points_from(points, "points");
             if (!faces.is_none()) scribble.faces = numbers_from(faces, "faces");
             if (!vertices.is_none()) scribble.vertices = numbers_from(vertices, "vertices");
             scribble.eta = eta;
             scribble.rings = rings;
             scribble.radius = radius;
             scribble.attracts = attracts;
             return scribble;
           }),
           py::arg("points"), py::arg("faces") = py::none(), py::arg("vertices") = py::none(), py::arg("eta") = 20.0,
           py::arg("rings") = 10, py::arg("radius") = py::none(), py::arg("attracts") = true,
           py::arg("acts_on") = "both")
      .def_property_readonly("points", array_of([](const auto& s) -> auto& { return s.points; }), "(k, 3) float64.")
      .def_property_readonly("faces", array_of([](const auto& s) -> auto& { return s.faces; }),
                             "(k,) int32; empty if not given.")
      .def_property_readonly("vertices", array_of([](const auto& s) -> auto& { return s.vertices; }),
                             "(k,) int32; empty if not given.")
      .def_property_readonly("eta", [](const Scribble& s) { return s.eta; })
      .def_property_readonly("rings", [](const Scribble& s) { return s.rings; })
      .def_property_readonly("radius", [](const Scribble& s) { return s.radius; })
      .def_property_readonly("attracts", [](const Scribble& s) { return s.attracts; })
      .def_property_readonly("acts_on", [](const Scribble& s) { return s.meant_for ? name_of(*s.meant_for) : "both"; })
      .def("__repr__", [](const Scribble& s) {
        return "<Scribble: " + std::to_string(s.points.size()) + " points, " + (s.attracts ? "attracts" : "repels") +
               ">";
      });

  module.def(
      "apply_scribbles",
      [](const SurfaceObject& surface, const MetricObject& metric, const std::vector<Scribble>& scribbles,
         const std::optional<std::string>& follow, const py::object& progress) {
        const std::optional<Follow> meant = follow_from(follow);
        return Watch(progress).run([&](const Task& task) {
          return make_held<MetricObject>(apply_scribbles(*surface.surface, metric.metric, scribbles, meant, task));
        });
      },
      py::arg("surface"), py::arg("metric"), py::arg("scribbles"), py::arg("follow") = py::none(),
      py::arg("progress") = py::none(),
      R"(The metric after scribbles, applied in their order (Section 5 of the paper).

The list alone decides: without scribbles the result is the metric itself, and where two cross the later wins along its
line.

Parameters
----------
surface : Surface
metric : Metric
    Of that surface.
scribbles : sequence of Scribble
follow : {'min', 'max'}, optional
    Takes only those meant for that metric.
progress : callable, optional
    Called now and then with the fraction done; returning False cancels.

Raises
------
ValueError
    Where a scribble has a point that is off the mesh, with its number, or wrong parameters, or the metric is of
    another surface.
Cancelled
)");
}

}  // namespace seamwire::python
