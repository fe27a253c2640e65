// SPDX-License-Identifier: GPL-3.0-or-later
#include <pybind11/pybind11.h>

#include <cstdint>
#include <utility>
#include <vector>

#include "arrays.hpp"
#include "objects.hpp"
#include "seamwire/seams/missing_cuts.hpp"
#include "seamwire/surface/segments.hpp"
#include "seamwire/surface/triangulate.hpp"
#include "watch.hpp"

namespace seamwire::python {

void bind_faces(py::module_& module) {
  module.def(
      "face_segments",
      [](const SurfaceObject& surface, const py::object& cut_edges) {
        const std::vector<Edge> cuts = edges_from(cut_edges, "cut_edges");
        return handed_over(without_gil([&] { return face_segments(*surface.surface, cuts); }));
      },
      py::arg("surface"), py::arg("cut_edges"), R"(The segments into which cuts along edges part a surface.

Parameters
----------
surface : Surface
cut_edges : (k, 2) array_like of int
    Vertex pairs; those that are no real edges, as the diagonals of polygons, cut nothing.

Returns
-------
(m,) int32
    A number for each triangle: 0 in the segment of the most triangles, and so on.

Raises
------
ValueError
    Where a vertex is out of range.
)");
  module.def(
      "missing_cuts",
      [](const SurfaceObject& surface, const py::object& cut_edges, const py::object& segments) {
        const std::vector<Edge> cuts = edges_from(cut_edges, "cut_edges");
        const std::vector<std::int32_t> numbers = numbers_from(segments, "segments");
        return handed_over(without_gil([&] { return missing_cuts(*surface.surface, cuts, numbers); }));
      },
      py::arg("surface"), py::arg("cut_edges"), py::arg("segments"),
      R"(How many more cuts each segment needs to become a disc.

Each cut leads from border to border. A segment without a border, like a ball, needs another cut first to get one. Edges
with three or more triangles are borders.

Parameters
----------
surface : Surface
cut_edges : (k, 2) array_like of int
    Vertex pairs, as for `face_segments`.
segments : (m,) array_like of int
    The segment of each triangle, as `face_segments` returns it.

Returns
-------
(count,) int32
    0 for a disc, 1 for a tube, a Moebius strip or a closed ball, 2 for a disc with a handle, 3 for a torus.

Raises
------
ValueError
    Where a vertex is out of range, or the segments are of another surface or of other cuts.
)");
  module.def(
      "cut_polygons",
      [](const py::object& points, const py::object& corners, const py::object& sizes) {
        const std::vector<Vector> own_points = points_from(points, "points");
        const std::vector<std::int32_t> own_corners = numbers_from(corners, "corners");
        const std::vector<std::int32_t> own_sizes = numbers_from(sizes, "sizes");
        Triangulation cut = without_gil([&] { return triangulate(own_points, own_corners, own_sizes); });
        return py::make_tuple(handed_over(std::move(cut.triangles)), handed_over(std::move(cut.polygons)));
      },
      py::arg("points"), py::arg("corners"), py::arg("sizes"),
      R"(Triangles and quads cut into triangles, as Blender cuts them.

A quad is cut from its first corner to its third, unless one of the two triangles would lie on the other.

Parameters
----------
points : (n, 3) array_like of float
corners : (c,) array_like of int
    Vertices, polygon by polygon.
sizes : (p,) array_like of int
    How many corners each polygon has, 3 or 4.

Returns
-------
triangles : (m, 3) int32
    In the order of the polygons, turned the same way.
polygons : (m,) int32
    The polygon of each triangle.

Raises
------
ValueError
    For other sizes, where they do not add up to the number of corners, and for a vertex out of range.
)");
}

}  // namespace seamwire::python
