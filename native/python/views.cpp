// SPDX-License-Identifier: GPL-3.0-or-later
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "arrays.hpp"
#include "objects.hpp"
#include "seamwire/metric/crest_lines.hpp"
#include "seamwire/surface/isolines.hpp"
#include "seamwire/wires/plane_section.hpp"
#include "watch.hpp"

namespace seamwire::python {
namespace {

/// An array of rows of the same number of vectors each.
template <class Row>
py::array_t<double> rows_array(const std::vector<Row>& rows, std::vector<py::ssize_t> shape) {
  static_assert(sizeof(Vector) == 3 * sizeof(double) && sizeof(Row) % sizeof(Vector) == 0);
  return py::array_t<double>(std::move(shape), reinterpret_cast<const double*>(rows.data()));
}

py::array_t<double> pairs_array(const std::vector<std::array<Vector, 2>>& pairs) {
  return rows_array(pairs, {static_cast<py::ssize_t>(pairs.size()), 2, 3});
}

/// The semi-axes, the longer one first.
std::vector<std::array<Vector, 2>> semi_axes(const Metric& metric, bool is_reach) {
  std::vector<std::array<Vector, 2>> axes(metric.size());
  for (std::size_t v = 0; v < metric.size(); ++v) {
    const PrincipalAxes at = principal_axes({metric.normals[v], metric.tensors[v]});
    axes[v] = is_reach ? std::array<Vector, 2>{at.e2 / std::sqrt(at.l2), at.e1 / std::sqrt(at.l1)}
                       : std::array<Vector, 2>{at.l1 * at.e1, at.l2 * at.e2};
  }
  return axes;
}

py::array_t<double> ellipses(const MetricObject& metric, const std::string& of) {
  if (of != "norm" && of != "reach") throw InvalidInput("of: expected 'norm' or 'reach', got '" + of + "'");
  return pairs_array(without_gil([&] { return semi_axes(metric.metric, of == "reach"); }));
}

py::tuple isolines_of(const SurfaceObject& surface, const py::object& values, const py::object& levels) {
  const std::vector<double> own_values = values_from(values, "values"), own_levels = values_from(levels, "levels");
  Isolines lines = without_gil([&] { return isolines(*surface.surface, own_values, own_levels); });
  return py::make_tuple(pairs_array(lines.segments), handed_over(std::move(lines.faces)),
                        handed_over(std::move(lines.levels)));
}

Held<CrestLines> crest_lines_of(const SurfaceObject& surface, const CurvatureObject& curvature, double least_strength,
                                double least_drop, const py::object& progress) {
  return Watch(progress).run([&](const Task& task) {
    const CrestLineOptions options{.least_strength = least_strength, .least_drop = least_drop};
    return make_held<CrestLines>(crest_lines(*surface.surface, curvature.curvature, options, task));
  });
}

void bind_crest_lines(py::module_& module) {
  const auto array = [](auto member) {
    return py::cpp_function([member](py::object self) { return view(self.cast<const CrestLines&>().*member, self); });
  };
  py::class_<CrestLines, Held<CrestLines>>(module, "CrestLines", "Ridges and valleys, the strongest first.")
      .def_property_readonly(
          "points", array(&CrestLines::points),
          "(p, 3) float64: of all lines, one after the other. A closed line ends with its first point.")
      .def_property_readonly("edges", array(&CrestLines::edges), "(p, 2) int32: the edge that each point lies on.")
      .def_property_readonly("parts", array(&CrestLines::parts),
                             "(p,) float64: where on it, 0 at its first vertex, 1 at its second.")
      .def_property_readonly(
          "curvatures", array(&CrestLines::curvatures),
          "(p,) float64: k1 there, in 1 / side of the unit cube: above 0 along ridges, below along valleys.")
      .def_property_readonly("faces", array(&CrestLines::faces),
                             "(p,) int32: the triangle that leads to the next point; -1 for a line's last.")
      .def_property_readonly("starts", array(&CrestLines::starts),
                             "(k + 1,) int32: line i has the points starts[i] to starts[i + 1].")
      .def_property_readonly("strengths", array(&CrestLines::strengths),
                             "(k,) float64: the integral of |k1| along each, in radians; descending.")
      .def("__repr__", [](const CrestLines& lines) {
        return "<CrestLines: " + std::to_string(lines.strengths.size()) + " lines>";
      });
  module.def("crest_lines", &crest_lines_of, py::arg("surface"), py::arg("curvature"), py::arg("least_strength") = 1.0,
             py::arg("least_drop") = 0.15, py::arg("progress") = py::none(),
             R"(Ridges and valleys: the curves along which the surface bends most sharply across (Figures 5 and 11).

Yoshizawa, Belyaev, Seidel, "Fast and robust detection of crest lines on meshes" (2005), with derivatives of curvature
as in Rusinkiewicz (2004); docs/method.md says what is ours.

Parameters
----------
surface : Surface
curvature : Curvature
    Of that surface, best from `smoothed_curvatures`.
least_strength : float
    Of a line: the integral of |k1| along it, in radians. At least 0.
least_drop : float
    Of its points: by which share curvature has fallen one radius of curvature away on both sides, in [0, 1). With 0
    there are lines on cylinders and tori too, where noise decides.
progress : callable, optional
    Called now and then with the fraction done; returning False cancels.

Returns
-------
CrestLines

Raises
------
ValueError
    Where the curvature is of another surface, or a number is out of range.
Cancelled
)");
}

py::tuple plane_section_of(const SurfaceObject& surface, const py::object& from, const py::object& to,
                           const py::object& direction) {
  const SurfacePoint start = surface_point_from(from, *surface.surface, "from_point");
  const SurfacePoint end = surface_point_from(to, *surface.surface, "to_point");
  const std::vector<double> along = values_from(direction, "direction");
  if (along.size() != 3) {
    throw InvalidInput("direction: expected 3 numbers, got " + std::to_string(along.size()));
  }
  PlaneSection section =
      without_gil([&] { return plane_section(*surface.surface, start, end, Vector(along[0], along[1], along[2])); });
  return py::make_tuple(rows_array(section.points, {static_cast<py::ssize_t>(section.points.size()), 3}),
                        handed_over(std::move(section.faces)), section.length);
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
      const Wire wire = trace_wire(*on.surface, on.embedding, object.field, targets[i], task);
      points.insert(points.end(), wire.points.begin(), wire.points.end());
      starts.push_back(static_cast<std::int32_t>(points.size()));
      lengths.push_back(wire.length);
    }
    return true;
  });
  return py::make_tuple(rows_array(points, {static_cast<py::ssize_t>(points.size()), 3}),
                        handed_over(std::move(starts)), handed_over(std::move(lengths)));
}

}  // namespace

void bind_views(py::module_& module) {
  bind_crest_lines(module);
  module.attr("Metric").cast<py::class_<MetricObject, Held<MetricObject>>>().def(
      "ellipses", &ellipses, py::arg("of") = "norm", R"(The ellipse of the norm at each vertex (Figures 2, 3 and 6).

Parameters
----------
of : {'norm', 'reach'}
    'norm': l1 e1 and l2 e2 of eq. 2, as the paper's figures have them: long across the direction that paths follow.
    'reach': e2 / sqrt(l2) and e1 / sqrt(l1), how far a path of length 1 leads: long along that direction.

Returns
-------
(n, 2, 3) float64
    The two semi-axes, the longer one first, of the model scaled to the unit cube; zero at vertices without a face.

Raises
------
ValueError
    For another `of`.
)");
  module.def("isolines", &isolines_of, py::arg("surface"), py::arg("values"), py::arg("levels"),
             R"(Where a function on a surface, linear on each triangle, has given values.

Parameters
----------
surface : Surface
values : (n,) array_like of float
    At its vertices. Triangles with an infinite one are left out.
levels : (l,) array_like of float
    Finite, ascending.

Returns
-------
segments : (k, 2, 3) float64
    Straight pieces across one triangle each, in the caller's coordinates; neighbors have the same ends.
faces : (k,) int32
    The triangle that each lies in.
levels : (k,) int32
    Which of the levels it is at.

Raises
------
ValueError
    For values of another number of vertices, one that is no number, and levels that are not finite and ascending.
)");
  module.def("plane_section", &plane_section_of, py::arg("surface"), py::arg("from_point"), py::arg("to_point"),
             py::arg("direction"), R"(The curve in which a plane cuts a surface between two points of it.

The plane goes through both points and along a direction: with that of a view, the curve is straight in the view. Straight
in each triangle, exact but for rounding.

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
    In the caller's coordinates, both points among them; of two ways around the shorter one. (0, 3) where the plane's
    curve through one point ends, or is closed, before it comes to the other.
faces : (p - 1,) int32
    The triangle that each segment lies in.
length : float
    In the caller's units; inf where there is no such curve.

Raises
------
ValueError
    Where a point is none of the surface, the points are the same, or the direction leads from one to the other.
)");
  module.def(
      "invalid_faces",
      [](const SurfaceObject& surface, const MetricObject& metric) {
        return handed_over(without_gil([&] { return invalid_faces(*surface.surface, metric.metric); }));
      },
      py::arg("surface"), py::arg("metric"),
      R"(The triangles that are invalid in a metric before any bisection (Section 4.1; Figures 7 and 9).

Returns
-------
(k,) int32
    Ascending, those without an area among them: what `embed` has to bisect.

Raises
------
ValueError
    Where the metric is of another surface.
)");
  module.def(
      "metric_lengths",
      [](const SurfaceObject& object, const MetricObject& metric) {
        return handed_over(without_gil([&] {
          const Surface& surface = *object.surface;
          if (metric.metric.size() != surface.vertex_count()) throw InvalidInput("metric: it is of another surface");
          std::vector<double> lengths;
          lengths.reserve(surface.edges().size());
          for (const auto& [a, b] : surface.edges()) lengths.push_back(edge_length(surface, metric.metric, a, b));
          return lengths;
        }));
      },
      py::arg("surface"), py::arg("metric"),
      R"(The lengths of a surface's edges in a metric (eq. 2), before any bisection.

Returns
-------
(e,) float64
    Of `Surface.edges`, of the model scaled to the unit cube.

Raises
------
ValueError
    Where the metric is of another surface.
)");
  module.attr("DistanceField")
      .cast<py::class_<FieldObject, Held<FieldObject>>>()
      .def("trace_many", &trace_many, py::arg("vertices"), py::arg("progress") = py::none(),
           R"(The shortest paths from the seed to several vertices (Figure 1).

Parameters
----------
vertices : (k,) array_like of int
progress : callable, optional
    Called now and then with the fraction done; returning False cancels.

Returns
-------
points : (p, 3) float64
    Of all paths, one after the other, in the caller's coordinates.
starts : (k + 1,) int32
    Path i has the points starts[i] to starts[i + 1]; none where its vertex is unreachable.
lengths : (k,) float64
    In the metric; inf where the vertex is unreachable.

Raises
------
ValueError
    Where a vertex is out of range.
Cancelled
)");
}

}  // namespace seamwire::python
