// SPDX-License-Identifier: GPL-3.0-or-later
#include <pybind11/pybind11.h>

#include <utility>
#include <vector>

#include "arrays.hpp"
#include "rooms.hpp"
#include "seamwire/parameterization/place_islands.hpp"
#include "watch.hpp"

namespace seamwire::python {
namespace {

void bind_place_islands(py::module_& module) {
  module.def(
      "place_islands",
      [](const py::object& before, const py::object& after, const py::object& triangles, const py::object& islands,
         const py::object& areas, const py::object& taken, const py::object& aspects, const py::object& straight,
         const py::object& progress) {
        NewIslands own{.before = places_from(before, "before"),
                       .after = places_from(after, "after"),
                       .triangles = triangles_from(triangles, "triangles"),
                       .islands = numbers_from(islands, "islands"),
                       .areas = values_from(areas, "areas")};
        if (!aspects.is_none()) own.aspects = values_from(aspects, "aspects");
        if (!straight.is_none()) own.straight = flags_from(straight, "straight");
        const std::vector<Eigen::AlignedBox2d> boxes = boxes_from(taken, "taken");
        return handed_over(
            Watch(progress).run([&](const Task& task) { return place_islands(own, boxes, task); }));
      },
      py::arg("before"), py::arg("after"), py::arg("triangles"), py::arg("islands"), py::arg("areas"), py::kw_only(),
      py::arg("taken") = py::tuple(), py::arg("aspects") = py::none(), py::arg("straight") = py::none(),
      py::arg("progress") = py::none(),
      R"(Find a place for new islands among parts of a UV map that stay.

Each island is turned as it was, and gets the nearest free place of its former unit square. Islands for which that
square has no room lie to the right of everything.

Parameters
----------
before : (c, 2) array_like of float
    Each corner's UV in the old map. An island with a UV that is not finite had no place.
after : (c, 2) array_like of float
    Each corner's place now, of any scale, as the image shows it: u is multiplied by the aspect. Finite for the corners
    of triangles.
triangles : (t, 3) array_like of int
    Corners.
islands : (t,) array_like of int
    The island of each triangle, numbered from 0.
areas : (k,) array_like of float
    The wanted area of each island in the map. 0 keeps its scale.
taken : (b, 4) array_like of float, optional
    Boxes around what stays: low u, low v, high u, high v.
aspects : (k,) array_like of float, optional
    As in `pack_islands`.
straight : (k,) array_like of bool, optional
    Whether an island's sides run along the axes, and stay so.
progress : callable, optional
    Called repeatedly with the fraction done. Returning False cancels.

Returns
-------
(k, 2, 3) float64
    The map of each island to its place, as `Packing.placements`.

Raises
------
ValueError
    If an array has the wrong shape or type, or a value is out of range or not finite.
Cancelled
)");
}

}  // namespace

void bind_islands(py::module_& module) { bind_place_islands(module); }

}  // namespace seamwire::python
