// SPDX-License-Identifier: GPL-3.0-or-later
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <array>
#include <cstdint>
#include <utility>
#include <vector>

#include "arrays.hpp"
#include "held.hpp"
#include "rooms.hpp"
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

}  // namespace

void bind_rays(py::module_& module) {
  bind_nearest(module);
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
