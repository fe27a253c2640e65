// SPDX-License-Identifier: GPL-3.0-or-later
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <array>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "arrays.hpp"
#include "held.hpp"
#include "rooms.hpp"
#include "seamwire/surface/mirror_partners.hpp"
#include "seamwire/surface/nearest_points.hpp"
#include "seamwire/surface/ray_tree.hpp"
#include "watch.hpp"

namespace seamwire::python {
namespace {

Held<RayTree> make_tree(const py::object& points, const py::object& triangles) {
  auto own_points = points_from(points, "points");
  auto own_triangles = triangles_from(triangles, "triangles");
  const GilRelease released;
  return make_held<RayTree>(std::move(own_points), std::move(own_triangles));
}

py::object first_hit(const RayTree& tree, const py::object& origin, const py::object& direction) {
  const Vector from = vector_from(origin, "origin"), along = vector_from(direction, "direction");
  const auto look = [&] { return tree.first_hit(from, along); };
  // The tree answers within microseconds. Without the tree, all triangles are tested.
  const RayHit hit = tree.ready() ? look() : without_gil(look);
  return hit.triangle < 0 ? py::none().cast<py::object>() : py::make_tuple(hit.triangle, hit.distance);
}

Held<NearestPoints> make_nearest(const py::object& points, const py::object& triangles, const py::object& progress) {
  auto own_points = points_from(points, "points");
  auto own_triangles = triangles_from(triangles, "triangles");
  return Watch(progress).run([&](const Task& task) {
    return make_held<NearestPoints>(std::move(own_points), std::move(own_triangles), task);
  });
}

py::tuple find_nearest(const NearestPoints& nearest, const py::object& places, const py::object& normals,
                       const py::object& progress) {
  const std::vector<Vector> own_places = points_from(places, "places");
  std::vector<Vector> own_normals;
  if (!normals.is_none()) own_normals = points_from(normals, "normals");
  const std::vector<NearestPoint> found =
      Watch(progress).run([&](const Task& task) { return nearest.find(own_places, own_normals, task); });
  std::vector<std::int32_t> triangles;
  std::vector<Vector> points;
  std::vector<double> distances;
  for (const NearestPoint& one : found) {
    triangles.push_back(one.triangle);
    points.push_back(one.point);
    distances.push_back(one.distance);
  }
  return py::make_tuple(handed_over(std::move(triangles)), handed_over(std::move(points)),
                        handed_over(std::move(distances)));
}

void bind_nearest(py::module_& module) {
  py::class_<NearestPoints, Held<NearestPoints>>(module, "NearestPoints", R"(Finds the nearest points of triangles.

Parameters
----------
points : (n, 3) array_like of float
triangles : (m, 3) array_like of int
progress : callable, optional
    Called repeatedly with the fraction done. Returning False cancels.

Raises
------
ValueError
    If there is no triangle, a triangle has a vertex that does not exist, or a coordinate is not finite.
Cancelled
)")
      .def(py::init(&make_nearest), py::arg("points"), py::arg("triangles"), py::arg("progress") = py::none())
      .def("find", &find_nearest, py::arg("places"), py::arg("normals") = py::none(), py::arg("progress") = py::none(),
           R"(Find the point that is nearest to each place.

Parameters
----------
places : (k, 3) array_like of float
normals : (k, 3) array_like of float, optional
    Triangles that face away from these do not count, unless all do.
progress : callable, optional
    Called repeatedly with the fraction done. Returning False cancels.

Returns
-------
triangles : (k,) int32
points : (k, 3) float64
distances : (k,) float64

Raises
------
ValueError
    If there are not as many normals as places, or a coordinate is not finite.
Cancelled
)");
}

py::array nearest_vertices_of(const py::object& points, const py::object& places, const py::object& reach) {
  const std::vector<Vector> own_points = points_from(points, "points"), own_places = points_from(places, "places");
  const bool is_one = py::isinstance<py::float_>(reach) || py::isinstance<py::int_>(reach);
  const std::vector<double> own_reach =
      is_one ? std::vector<double>(own_places.size(), reach.cast<double>()) : values_from(reach, "reach");
  return handed_over(Watch(py::none()).run([&](const Task& task) {
    return nearest_vertices(own_points, own_places, own_reach, task);
  }));
}

py::array mirror_partners_of(const py::object& points, const py::object& axes, const py::object& edges,
                             const py::object& triangles) {
  const std::vector<Vector> own_points = points_from(points, "points");
  MirrorOptions options{.axes = {false, false, false}, .edges = {}, .triangles = {}};
  for (const std::int32_t axis : numbers_from(axes, "axes")) {
    if (axis < 0 || axis > 2) throw InvalidInput("axes: expected 0, 1 or 2, got " + std::to_string(axis));
    options.axes[static_cast<std::size_t>(axis)] = true;
  }
  if (!edges.is_none()) options.edges = edges_from(edges, "edges");
  if (!triangles.is_none()) options.triangles = triangles_from(triangles, "triangles");
  return handed_over(
      Watch(py::none()).run([&](const Task& task) { return mirror_partners(own_points, options, task); }));
}

void bind_partners(py::module_& module) {
  module.def("nearest_vertices", &nearest_vertices_of, py::arg("points"), py::arg("places"), py::arg("reach"),
             R"(Find the nearest vertex of each place, within a distance.

Parameters
----------
points : (n, 3) array_like of float
    The vertices. Vertices that are not finite are never found.
places : (k, 3) array_like of float
    A place that is not finite has no nearest vertex.
reach : float or (k,) array_like of float
    How far away a vertex may be: one distance, or one for each place.

Returns
-------
(k,) int32
    The vertex, usually the first of several at the same distance, or -1.

Raises
------
ValueError
    If an array has the wrong shape or type, or there are not as many distances as places.
)");
  module.def("mirror_partners", &mirror_partners_of, py::arg("points"), py::arg("axes"), py::arg("edges") = py::none(),
             py::arg("triangles") = py::none(),
             R"(Find the vertex that is the mirror image of each vertex.

Partners are one to one: each vertex is the partner of its partner. By place, each is the nearest to the mirror image of
the other. Vertices in one place have different partners.

Parameters
----------
points : (n, 3) array_like of float
    The vertices. Vertices that are not finite have no partners.
axes : (a,) array_like of int
    The coordinates that change their sign: 0, 1 or 2.
edges : (e, 2) array_like of int, optional
    The edges of the mesh. A vertex may be as far from its partner's image as half of (sum of 1 / l^2)^(-1/2), over the
    lengths l of its edges. None: as far as 2e-5.
triangles : (m, 3) array_like of int, optional
    Triangles with one orientation. If given, partners are grown over the polygons that `edges` bound, from edges whose
    ends have partners by place. This finds the partners of a mesh in a pose.

Returns
-------
(n,) int32
    The partner of each vertex, or -1.

Raises
------
ValueError
    If an array has the wrong shape or type, or a vertex or an axis is out of range.
)");
}

}  // namespace

void bind_rays(py::module_& module) {
  bind_nearest(module);
  bind_partners(module);
  py::class_<RayTree, Held<RayTree>>(module, "RayTree", R"(Finds the first triangle that a ray meets, from either side.

A tree is built in the background. Before it is built, each query tests all triangles and has the same answer.

Parameters
----------
points : (n, 3) array_like of float
triangles : (m, 3) array_like of int

Raises
------
ValueError
    If an array has the wrong shape or type, or a triangle has a vertex that does not exist.
)")
      .def(py::init(&make_tree), py::arg("points"), py::arg("triangles"))
      .def("first_hit", &first_hit, py::arg("origin"), py::arg("direction"),
           R"(Find the first triangle that a ray meets.

Parameters
----------
origin, direction : (3,) array_like of float

Returns
-------
(int, float) or None
    The triangle's number, and its distance in lengths of `direction`. None if the ray meets no triangle.

Raises
------
ValueError
    If an array has the wrong shape or type.
)")
      .def_property_readonly("ready", &RayTree::ready, "bool: whether the tree is built.")
      .def(
          "wait", [](const RayTree& tree) { tree.wait(); }, py::call_guard<GilRelease>(),
          "Wait until the tree is built.");
}

}  // namespace seamwire::python
