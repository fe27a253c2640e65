// SPDX-License-Identifier: GPL-3.0-or-later
#include "surface.hpp"

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <optional>
#include <string>

#include "arrays.hpp"
#include "held.hpp"
#include "rooms.hpp"
#include "watch.hpp"

namespace seamwire::python {
namespace {

struct ReportObject {
  std::shared_ptr<const Surface> surface;
};

/// An attribute that is a list of elements in the report.
template <class Elements>
py::cpp_function elements(Elements SurfaceReport::*member) {
  return array_of<ReportObject>([member](const ReportObject& r) -> auto& { return r.surface->report().*member; });
}

std::string text_of_report(const ReportObject& object) {
  const SurfaceReport& report = object.surface->report();
  std::string text = "<SurfaceReport: " + std::to_string(report.components) + " components, " +
                     std::to_string(report.boundary_edges) + " boundary edges";
  const auto add = [&](std::size_t count, const char* what) {
    if (count > 0) text += ", " + std::to_string(count) + " " + what;
  };
  add(report.nonmanifold_edges.size(), "non-manifold edges");
  add(report.unorientable_edges.size(), "unorientable edges");
  add(report.flipped_faces.size(), "flipped faces");
  add(report.zero_area_faces.size(), "zero-area faces");
  add(report.low_faces.size() - report.zero_area_faces.size(), "faces too low to have a direction");
  add(report.degenerate_faces.size(), "degenerate faces");
  add(report.duplicate_faces.size(), "duplicate faces");
  add(report.isolated_vertices.size(), "isolated vertices");
  return text + ">";
}

void bind_surface_report(py::module_& module) {
  py::class_<ReportObject, Held<ReportObject>>(
      module, "SurfaceReport", "Unusual parts of a surface's input. The surface works in spite of them.")
      .def_property_readonly(
          "nonmanifold_edges", elements(&SurfaceReport::nonmanifold_edges),
          "(k, 2) int32: edges with three or more faces. Wires cross them; curvature and islands end there.")
      .def_property_readonly("unorientable_edges", elements(&SurfaceReport::unorientable_edges),
                             "(k, 2) int32: edges whose faces cannot be oriented alike. Wires cross them; curvature "
                             "and islands end there.")
      .def_property_readonly("flipped_faces", elements(&SurfaceReport::flipped_faces),
                             "(k,) int32: faces that were turned over to agree with their neighbors.")
      .def_property_readonly("zero_area_faces", elements(&SurfaceReport::zero_area_faces),
                             "(k,) int32: faces lower than 1e-9 of their longest side. They are kept, but embeddings "
                             "remove them or leave holes.")
      .def_property_readonly("low_faces", elements(&SurfaceReport::low_faces),
                             "(k,) int32: faces lower than 2^-22 of the unit cube, including those without area. They "
                             "are kept, but normals and curvature ignore them.")
      .def_property_readonly("degenerate_faces", elements(&SurfaceReport::degenerate_faces),
                             "(k,) int32: faces with two equal corners. They are left out; their edges stay.")
      .def_property_readonly("duplicate_faces", elements(&SurfaceReport::duplicate_faces),
                             "(k,) int32: faces with the three vertices of an earlier face. They are left out.")
      .def_property_readonly("isolated_vertices", elements(&SurfaceReport::isolated_vertices),
                             "(k,) int32: vertices in no face and no edge.")
      .def_property_readonly(
          "boundary_edges", [](const ReportObject& r) { return r.surface->report().boundary_edges; },
          "int: how many edges have one face.")
      .def_property_readonly(
          "components", [](const ReportObject& r) { return r.surface->report().components; },
          "int: how many parts edges connect. Isolated vertices do not count.")
      .def("__repr__", &text_of_report);
}

std::shared_ptr<SurfaceObject> make_surface(const py::object& points, const py::object& triangles,
                                            const py::object& edges, const py::object& progress) {
  auto p = points_from(points, "points");
  auto t = triangles_from(triangles, "triangles");
  auto e = edges.is_none() ? std::nullopt : std::optional(edges_from(edges, "edges"));
  return Watch(progress).run([&](const Task& task) {
    return std::shared_ptr<SurfaceObject>(
        make_held<SurfaceObject>(std::make_shared<const Surface>(std::move(p), std::move(t), std::move(e), task)));
  });
}

std::string text_of_surface(const SurfaceObject& object) {
  const Surface& surface = *object.surface;
  return "<Surface: " + std::to_string(surface.vertex_count()) + " vertices, " + std::to_string(surface.face_count()) +
         " triangles, " + std::to_string(surface.edges().size()) + " edges>";
}

void bind_surface_class(py::module_& module) {
  py::class_<SurfaceObject, std::shared_ptr<SurfaceObject>>(module, "Surface", R"(A triangle mesh in any condition.

A surface may have boundaries, several components, isolated vertices, zero-area and duplicate faces, mixed orientation,
and edges with three or more faces. `report` lists them. Vertices and faces keep the caller's numbers.

Parameters
----------
points : (n, 3) array_like of float
    Finite coordinates.
triangles : (m, 3) array_like of int
    Vertex numbers, of any integer type.
edges : (e, 2) array_like of int, optional
    The real edges, if the triangles come from polygons, and edges without a face. None: every edge of a triangle.
progress : callable, optional
    Called repeatedly with the fraction done. Returning False cancels.

Raises
------
ValueError
    If an array has the wrong shape or type, or there is no edge. Also if a coordinate is not finite, a vertex number is out
    of range, or an edge joins a vertex to itself. The message names the element. Also if the longest side of the
    bounding box is below 1e-150, but not 0.
Cancelled
)")
      .def(py::init(&make_surface), py::arg("points"), py::arg("triangles"), py::arg("edges") = py::none(),
           py::arg("progress") = py::none())
      .def_property_readonly("points",
                             array_of<SurfaceObject>([](const auto& s) -> auto& { return s.surface->points(); }),
                             "(n, 3) float64: as given.")
      .def_property_readonly("triangles",
                             array_of<SurfaceObject>([](const auto& s) -> auto& { return s.surface->triangles(); }),
                             "(m, 3) int32: as given.")
      .def_property_readonly("edges",
                             array_of<SurfaceObject>([](const auto& s) -> auto& { return s.surface->edges(); }),
                             "(e, 2) int32: the real edges, each once, sorted. The smaller vertex comes first.")
      .def_property_readonly(
          "scale", [](const SurfaceObject& s) { return s.surface->scale(); },
          "float: the caller's coordinates times this number fit the unit cube.")
      .def_property_readonly(
          "report", [](const SurfaceObject& s) { return ReportObject{s.surface}; },
          "SurfaceReport: unusual parts of the input.")
      .def("__repr__", &text_of_surface);
}

}  // namespace

void check_size(const char* what, std::size_t size, const Surface& surface) {
  if (size == surface.vertex_count()) return;
  throw InvalidInput(std::string(what) + " of " + std::to_string(size) + " vertices given for a surface of " +
                     std::to_string(surface.vertex_count()));
}

void bind_surface(py::module_& module) {
  bind_surface_report(module);
  bind_surface_class(module);
}

}  // namespace seamwire::python
