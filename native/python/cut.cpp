// SPDX-License-Identifier: GPL-3.0-or-later
#include "seamwire/cut/plan_cuts.hpp"

#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "arrays.hpp"
#include "picks.hpp"
#include "rooms.hpp"
#include "watch.hpp"

namespace seamwire::python {
namespace {

/// The library checks numbers, once it knows the mesh.
constexpr std::size_t kAnyCount = std::numeric_limits<std::int32_t>::max();

CutCurve make_curve(const py::object& points, const py::object& start, const py::object& end, const py::object& faces,
                    const py::object& image_of) {
  CutCurve curve{.points = points_from(points, "points"), .start = place_from(start, kAnyCount, kAnyCount, "start")};
  if (!end.is_none()) curve.end = place_from(end, kAnyCount, kAnyCount, "end");
  if (!faces.is_none()) curve.faces = numbers_from(faces, "faces");
  if (!image_of.is_none()) curve.image_of = number_from(image_of, "image_of");
  return curve;
}

void bind_curve(py::module_& module) {
  py::class_<CutCurve>(module, "CutCurve", R"(A curve to be cut into a mesh, see `plan_cuts`.

Parameters
----------
points : (k, 3) array_like of float
    At least two, on the mesh or near it.
start : int or (int, (3,) array_like)
    Where it begins: a vertex, or a triangle and barycentric coordinates. If the first point does not lie there, a
    vertex only names the polygons in which the curve may begin.
end : int or (int, (3,) array_like), optional
    Where it ends. None: wherever the last point lies.
faces : (k - 1,) array_like of int, optional
    The triangle that each segment lies in. If the curve does not run there, they are found instead.
image_of : int, optional
    The number of an earlier curve that this one is a mirror image of. It is skipped if that one is left out.

Raises
------
ValueError
    If a value has another form.
)")
      .def(py::init(&make_curve), py::arg("points"), py::arg("start"), py::arg("end") = py::none(),
           py::arg("faces") = py::none(), py::arg("image_of") = py::none())
      .def("__repr__",
           [](const CutCurve& curve) { return "<CutCurve: " + std::to_string(curve.points.size()) + " points>"; });
}

template <class T, std::size_t N>
py::array node_values(const py::object& self, std::array<T, N> CutNode::*member) {
  const std::vector<CutNode>& nodes = self.cast<const CutPlan&>().nodes;
  const T* data = nodes.empty() ? nullptr : (nodes.front().*member).data();
  return view(data, {static_cast<py::ssize_t>(nodes.size()), N}, {sizeof(CutNode), sizeof(T)}, self);
}

py::array node_polygons(const py::object& self) {
  const std::vector<CutNode>& nodes = self.cast<const CutPlan&>().nodes;
  const std::int32_t* data = nodes.empty() ? nullptr : &nodes.front().polygon;
  return view(data, {static_cast<py::ssize_t>(nodes.size())}, {sizeof(CutNode)}, self);
}

py::list splits_of(const CutPlan& plan) {
  py::list splits;
  for (const EdgeSplit& split : plan.splits) {
    splits.append(py::make_tuple(py::make_tuple(split.edge[0], split.edge[1]), split.nodes));
  }
  return splits;
}

py::list across_of(const py::object& self) {
  py::list across;
  for (const PolygonCuts& own : self.cast<const CutPlan&>().across) {
    across.append(py::make_tuple(own.polygon, view(own.cuts, self), own.is_folded));
  }
  return across;
}

py::list left_out_of(const CutPlan& plan) {
  py::list left_out;
  for (const UncutCurve& uncut : plan.left_out) left_out.append(py::make_tuple(uncut.curve, uncut.vertex));
  return left_out;
}

py::object node_at(const CutPlan& plan, const py::object& corners, const py::object& barycentric) {
  const Vector weights = vector_from(barycentric, "barycentric");
  const std::int32_t node = plan.node_at(triangle_from(corners, "corners"), {weights.x(), weights.y(), weights.z()});
  return node < 0 ? py::none() : py::object(py::int_(node));
}

void bind_plan(py::module_& module) {
  py::class_<CutPlan>(module, "CutPlan", "The changes to a mesh that cut curves into it, see `plan_cuts`.")
      .def_property_readonly(
          "vertices", [](const py::object& self) { return node_values(self, &CutNode::vertices); },
          "(k, 3) int32: the vertices between which each node lies, ascending. Unused ones are -1, and come last.")
      .def_property_readonly(
          "weights", [](const py::object& self) { return node_values(self, &CutNode::weights); },
          "(k, 3) float64: the weight of each of these vertices. The sum is 1.")
      .def_property_readonly("polygons", &node_polygons,
                             "(k,) int32: the polygon that each node lies inside. -1 if it is a vertex or lies on an "
                             "edge.")
      .def_property_readonly("splits", &splits_of,
                             "list of ((int, int), list of int): the edges that get new vertices, the smaller vertex\n"
                             "first, and the nodes on each, from that vertex on.")
      .def_property_readonly("along", array_of<CutPlan>(&CutPlan::along),
                             "(s, 2) int32: cuts between two neighboring vertices or nodes of one edge.")
      .def_property_readonly(
          "across", &across_of,
          "list of (int, (s, 2) int32, bool): each polygon that is cut, and the cuts from node to\n"
          "node inside it. True if the polygon is folded or has no area. Its cuts were planned on a\n"
          "regular polygon then.")
      .def_property_readonly("left_out", &left_out_of,
                             "list of (int, int): the curves that do not run over the mesh, without their images, and\n"
                             "a vertex near where each leaves the mesh.")
      .def("node_at", &node_at, py::arg("corners"), py::arg("barycentric"), R"(Find the node at a point of a triangle.

Parameters
----------
corners : (3,) array_like of int
    The vertices of the triangle.
barycentric : (3,) array_like of float

Returns
-------
int or None
    The node there, or the one that was moved away from there. None if no cut passes.

Raises
------
ValueError
    If an array has the wrong shape or type.
)")
      .def("__repr__", [](const CutPlan& plan) {
        return "<CutPlan: " + std::to_string(plan.splits.size()) + " edges and " + std::to_string(plan.across.size()) +
               " polygons are cut>";
      });
}

CutPlan make_cut_plan(const py::object& points, const py::object& triangles, const py::object& polygons,
                      const py::object& curves, const py::object& progress) {
  const std::vector<Vector> own_points = points_from(points, "points");
  const std::vector<Triangle> own_triangles = triangles_from(triangles, "triangles");
  const std::vector<std::int32_t> own_polygons = numbers_from(polygons, "polygons");
  const std::vector<CutCurve> own_curves = objects_from<CutCurve>(curves, "curves", "CutCurve");
  return Watch(progress).run([&](const Task& task) {
    return plan_cuts({.points = own_points, .triangles = own_triangles, .polygons = own_polygons}, own_curves, task);
  });
}

}  // namespace

void bind_cut(py::module_& module) {
  bind_curve(module);
  bind_plan(module);
  module.def("plan_cuts", &make_cut_plan, py::arg("points"), py::arg("triangles"), py::arg("polygons"),
             py::arg("curves"), py::arg("progress") = py::none(),
             R"(Plan how to cut curves into polygons.

If a curve ends inside a polygon and no other curve continues from there, it is cut only as far as the last edge that it
crosses. Curves that cross or run close to each other meet in common nodes. A cut that passes a vertex or an edge at
less than 0.05, as a fraction of an edge's length or a triangle's height, goes through it.

Parameters
----------
points : (n, 3) array_like of float
triangles : (m, 3) array_like of int
    The polygons, cut into triangles.
polygons : (m,) array_like of int
    The polygon of each triangle, ascending.
curves : sequence of CutCurve
progress : callable, optional
    Called repeatedly with the fraction done. Returning False cancels.

Returns
-------
CutPlan

Raises
------
ValueError
    If sizes do not fit, a number is out of range, or the triangles of a polygon do not form a polygon.
Cancelled
)");
}

}  // namespace seamwire::python
