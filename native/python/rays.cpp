// SPDX-License-Identifier: GPL-3.0-or-later
#include "seamwire/surface/ray_tree.hpp"

#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <array>
#include <memory>
#include <utility>

#include "arrays.hpp"
#include "gil.hpp"
#include "objects.hpp"
#include "watch.hpp"

namespace seamwire::python {

namespace {

Vector vector_from(const std::array<double, 3>& values) { return {values[0], values[1], values[2]}; }

}  // namespace

void bind_rays(py::module_& module) {
  py::class_<RayTree, Held<RayTree>>(module, "RayTree", R"(Finds the first triangle that a ray meets, from either side.

A tree is built on a thread of its own; until it is there every triangle is looked at, with the same answers.

Parameters
----------
points : (n, 3) array_like of float
triangles : (m, 3) array_like of int

Raises
------
ValueError
    Where an array has the wrong shape or type, or a triangle a vertex that is not there.
)")
      .def(py::init([](const py::object& points, const py::object& triangles) {
             auto own_points = points_from(points, "points");
             auto own_triangles = triangles_from(triangles, "triangles");
             const GilRelease released;
             return make_held<RayTree>(std::move(own_points), std::move(own_triangles));
           }),
           py::arg("points"), py::arg("triangles"))
      .def(
          "first_hit",
          [](const RayTree& tree, const std::array<double, 3>& origin,
             const std::array<double, 3>& direction) -> py::object {
            const auto look = [&] { return tree.first_hit(vector_from(origin), vector_from(direction)); };
            const RayHit hit = tree.ready() ? look() : without_gil(look);  // microseconds, or a look at all triangles
            return hit.triangle < 0 ? py::none().cast<py::object>() : py::make_tuple(hit.triangle, hit.distance);
          },
          py::arg("origin"), py::arg("direction"),
          "Return the triangle's number and how far away it is, in lengths of `direction`; None: there is none.")
      .def_property_readonly("ready", &RayTree::ready, "Whether the tree is built.")
      .def("wait", &RayTree::wait, py::call_guard<GilRelease>(), "Wait until the tree is built.");
}

}  // namespace seamwire::python
