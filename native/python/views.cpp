// SPDX-License-Identifier: GPL-3.0-or-later
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <string>
#include <utility>
#include <vector>

#include "arrays.hpp"
#include "held.hpp"
#include "metric.hpp"
#include "picks.hpp"
#include "rooms.hpp"
#include "seamwire/metric/crest_lines.hpp"
#include "seamwire/surface/isolines.hpp"
#include "seamwire/wires/plane_section.hpp"
#include "surface.hpp"
#include "watch.hpp"

namespace seamwire::python {
namespace {

void bind_crest_lines_class(py::module_& module) {
  py::class_<CrestLines, Held<CrestLines>>(module, "CrestLines", "Ridges and valleys, the strongest first.")
      .def_property_readonly("points", array_of<CrestLines>(&CrestLines::points),
                             "(p, 3) float64: the points of all lines, one line after the other. A closed line repeats "
                             "its first point.")
      .def_property_readonly("edges", array_of<CrestLines>(&CrestLines::edges),
                             "(p, 2) int32: the edge that each point lies on.")
      .def_property_readonly("t", array_of<CrestLines>(&CrestLines::t),
                             "(p,) float64: the position on that edge, from 0 at its first vertex to 1 at its second.")
      .def_property_readonly("curvatures", array_of<CrestLines>(&CrestLines::curvatures),
                             "(p,) float64: k1, in 1 / unit of the points. Above 0 on ridges, below 0 in valleys.")
      .def_property_readonly("faces", array_of<CrestLines>(&CrestLines::faces),
                             "(p,) int32: the triangle between a point and the next; -1 for a line's last point.")
      .def_property_readonly("starts", array_of<CrestLines>(&CrestLines::starts),
                             "(k + 1,) int32: line i has the points starts[i] to starts[i + 1].")
      .def_property_readonly("strengths", array_of<CrestLines>(&CrestLines::strengths),
                             "(k,) float64: the integral of |k1| along each line, in radians; descending.")
      .def("__repr__", [](const CrestLines& lines) {
        return "<CrestLines: " + std::to_string(lines.strengths.size()) + " lines>";
      });
}

Held<CrestLines> find_crest_lines(const SurfaceObject& surface, const CurvatureObject& curvature, double least_strength,
                                  double least_drop, const py::object& progress) {
  return Watch(progress).run([&](const Task& task) {
    const CrestLineOptions options{.least_strength = least_strength, .least_drop = least_drop};
    return make_held<CrestLines>(crest_lines(*surface.surface, curvature.curvature, options, task));
  });
}

void bind_crest_lines(py::module_& module) {
  module.def("crest_lines", &find_crest_lines, py::arg("surface"), py::arg("curvature"),
             py::arg("least_strength") = 1.0, py::arg("least_drop") = 0.15, py::arg("progress") = py::none(),
             R"(Find ridges and valleys: the curves across which the surface bends most sharply (Figures 5 and 11).

Parameters
----------
surface : Surface
curvature : Curvature
    Of that surface, best from `smoothed_curvatures`.
least_strength : float
    At least 0. The smallest integral of |k1| along a line, in radians.
least_drop : float
    In [0, 1). The smallest relative drop of the larger curvature at one radius of curvature on both sides. With 0,
    noise creates lines on cylinders and tori.
progress : callable, optional
    Called repeatedly with the fraction done. Returning False cancels.

Returns
-------
CrestLines

Raises
------
ValueError
    If the curvature belongs to another surface, or a number is out of range.
Cancelled

References
----------
Yoshizawa, Belyaev, Seidel, "Fast and robust detection of crest lines on meshes" (2005), with derivatives of curvature
as in Rusinkiewicz (2004). docs/method/curvature.md describes the differences.
)");
}

py::tuple find_isolines(const SurfaceObject& surface, const py::object& values, const py::object& levels) {
  const std::vector<double> own_values = values_from(values, "values"), own_levels = values_from(levels, "levels");
  Isolines lines = without_gil([&] { return isolines(*surface.surface, own_values, own_levels); });
  return py::make_tuple(copied(lines.segments), handed_over(std::move(lines.faces)),
                        handed_over(std::move(lines.levels)));
}

void bind_isolines(py::module_& module) {
  module.def("isolines", &find_isolines, py::arg("surface"), py::arg("values"), py::arg("levels"),
             R"(Find where a function on a surface has given values. The function is linear on each triangle.

Parameters
----------
surface : Surface
values : (n,) array_like of float
    The function's values at the vertices. Triangles with an infinite value are left out.
levels : (l,) array_like of float
    Finite, ascending.

Returns
-------
segments : (k, 2, 3) float64
    Straight pieces, each across one triangle, in the caller's coordinates. Neighbors share their ends.
faces : (k,) int32
    The triangle that each piece lies in.
levels : (k,) int32
    The number of each piece's level.

Raises
------
ValueError
    If the number of values differs from the number of vertices, a value is not a number, or the levels are not finite
    and ascending.
)");
}

py::tuple find_plane_section(const SurfaceObject& surface, const py::object& from, const py::object& to,
                             const py::object& direction) {
  const SurfacePoint start = surface_point_from(from, *surface.surface, "from_point");
  const SurfacePoint end = surface_point_from(to, *surface.surface, "to_point");
  const Vector along = vector_from(direction, "direction");
  PlaneSection section = without_gil([&] { return plane_section(*surface.surface, start, end, along); });
  return py::make_tuple(copied(section.points), handed_over(std::move(section.faces)), section.length);
}

void bind_plane_section(py::module_& module) {
  module.def("plane_section", &find_plane_section, py::arg("surface"), py::arg("from_point"), py::arg("to_point"),
             py::arg("direction"), R"(Find the curve in which a plane cuts a surface between two of its points.

The plane contains both points and a direction. With the direction of a view, the curve is straight in that view. The
curve is straight in each triangle, and exact except for rounding.

Parameters
----------
surface : Surface
from_point, to_point : int, or (int, (3,) array_like)
    Vertices, or triangles with barycentric coordinates.
direction : (3,) array_like of float
    In the caller's coordinates, of any length.

Returns
-------
points : (p, 3) float64
    In the caller's coordinates, including both points. If there are two ways, the shorter one. (0, 3) if the plane's
    curve through one point ends or closes before it reaches the other point.
faces : (p - 1,) int32
    The triangle that each segment lies in.
length : float
    In the caller's units; inf if there is no such curve.

Raises
------
ValueError
    If a point is not on the surface, the points are equal, or the direction leads from one point to the other.
)");
}

}  // namespace

void bind_views(py::module_& module) {
  bind_crest_lines_class(module);
  bind_crest_lines(module);
  bind_isolines(module);
  bind_plane_section(module);
}

}  // namespace seamwire::python
