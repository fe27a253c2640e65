// SPDX-License-Identifier: GPL-3.0-or-later
#include <pybind11/pybind11.h>

#include <cstdint>
#include <utility>
#include <vector>

#include "arrays.hpp"
#include "rooms.hpp"
#include "seamwire/surface/segments.hpp"
#include "seamwire_uv/seams/missing_cuts.hpp"
#include "surface.hpp"
#include "watch.hpp"

namespace seamwire::python {
namespace {

py::array segments_of(const SurfaceObject& surface, const py::object& cut_edges) {
  const std::vector<Edge> cuts = edges_from(cut_edges, "cut_edges");
  return handed_over(without_gil([&] { return face_segments(*surface.surface, cuts); }));
}

py::array missing_cuts_of(const SurfaceObject& surface, const py::object& cut_edges, const py::object& segments) {
  const std::vector<Edge> cuts = edges_from(cut_edges, "cut_edges");
  const std::vector<std::int32_t> numbers = numbers_from(segments, "segments");
  return handed_over(without_gil([&] { return missing_cuts(*surface.surface, cuts, numbers); }));
}

void bind_segments(py::module_& module) {
  module.def("face_segments", &segments_of, py::arg("surface"), py::arg("cut_edges"),
             R"(Find the segments into which cuts along edges divide a surface.

Edges with three or more triangles, and edges whose triangles cannot be oriented alike, join nothing.

Parameters
----------
surface : Surface
cut_edges : (k, 2) array_like of int
    Vertex pairs. Pairs that are not real edges, such as diagonals of polygons, cut nothing.

Returns
-------
(m,) int32
    The segment of each triangle. Segment 0 has the most triangles, and so on.

Raises
------
ValueError
    If a vertex is out of range.
)");
  module.def("missing_cuts", &missing_cuts_of, py::arg("surface"), py::arg("cut_edges"), py::arg("segments"),
             R"(Count how many more cuts each segment needs before it can lie flat with little stretch.

Each cut leads from border to border. A segment without a border, such as a ball, needs another cut first to get one.
A hole in a nearly flat place needs no cut.
Edges with three or more triangles are borders. So are edges whose triangles cannot be oriented alike.

Parameters
----------
surface : Surface
cut_edges : (k, 2) array_like of int
    Vertex pairs, as for `face_segments`.
segments : (m,) array_like of int
    The segment of each triangle, as from `face_segments`.

Returns
-------
(count,) int32
    0 for a disc, and 1 for a tube or a closed ball. 2 for a disc with a handle, and 3 for a torus.

Raises
------
ValueError
    If a vertex is out of range, or the segments belong to another surface or to other cuts.
)");
}

}  // namespace

void bind_faces(py::module_& module) { bind_segments(module); }

}  // namespace seamwire::python
